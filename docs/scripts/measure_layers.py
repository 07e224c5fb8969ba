"""Cost of layers relative to the half-space: ``measure_layers.py --write``.

Geometric means over two kinds of roughness, three seeds and three loads, 256 x 256 pixels.
"""

from __future__ import annotations

import sys
import time
from typing import NamedTuple

import numpy as np
from measured_blocks import measure
from validation_tables import grid

import contactkit as ck

N, WIDTH, MODULUS = 256, 2e-6, 1e11
STACKS = {  # modulus over that of the substrate, thickness over the window
    "half-space": (),
    "film of 2, 0.001": ((2.0, 0.001),),
    "film of 3, 0.01": ((3.0, 0.01),),
    "film of 0.1, 0.01": ((0.1, 0.01),),
    "disk of Table 2.1": ((2.0, 2.5e-4), (2.714, 1.25e-3), (1.857, 0.5)),
    "twenty graded layers, 3 to 1": tuple((3.0 - i / 10.0, 0.002) for i in range(20)),
    "film of 10, 0.01": ((10.0, 0.01),),
    "film of 10, 0.001": ((10.0, 0.001),),
    "plate of 1000, 0.001": ((1000.0, 0.001),),
}


class Cost(NamedTuple):
    """Operator applications and CPU seconds of a solve."""

    applications: int
    seconds: float


def stack(layers: tuple[tuple[float, float], ...]) -> ck.Stack:
    """Layers of one Poisson's ratio."""

    def material(ratio: float) -> ck.Material:
        return ck.Material(young_modulus=ratio * MODULUS, poisson_ratio=0.3)

    made = tuple(ck.Layer(material=material(e), thickness=h * WIDTH) for e, h in layers)
    return ck.Stack(layers=made, substrate=material(1.0))


def solved(solid: ck.Stack, rough: object, pressure: float) -> Cost:
    """One solve, its setup left out."""
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=rough)),
        window=ck.Window(width=WIDTH),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(),),
    )
    made = ck.plan(scene, ck.Accuracy(grid=N))
    ck.solve(made)
    begun = time.process_time()
    run = ck.solve(made)
    return Cost(run.work.n_operator_applications, time.process_time() - begun)


def layers_table() -> str:
    """Operator applications and seconds of each stack relative to the half-space."""
    costs: dict[str, list[Cost]] = {name: [] for name in STACKS}
    for seed in (1, 2, 3):
        for rough in (
            ck.SelfAffineRoughness(
                rms=1e-9, hurst=0.8, rolloff=WIDTH / 4, cutoff=8 * WIDTH / N, seed=seed
            ),
            ck.GaussianRoughness(
                rms=1e-9, correlation_length=WIDTH / 20, cutoff=2 * WIDTH / N, seed=seed
            ),
        ):
            for pressure in (2e7, 1.2e8, 6e8):
                for name, layers in STACKS.items():
                    costs[name].append(solved(stack(layers), rough, pressure))
    base = np.array(costs["half-space"])
    rows = []
    for name, found in costs.items():
        each = np.array(found)
        counts, seconds = np.exp(np.log(each / base).mean(0))
        shown = f"{each[:, 0].mean():.0f} (at most {each[:, 0].max():.0f})"
        rows.append([name, shown, f"{counts:.2f}", f"{seconds:.2f}"])
    heads = ["stack", "operator applications", "over the half-space", "seconds over the half-space"]
    return grid(heads, rows)


if __name__ == "__main__":
    sys.exit(measure({"layers": layers_table}))
