"""Levels of adhesion curves of maps, and their picture: ``measure_adhesion.py --write``."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

import numpy as np
from measured_blocks import measure
from PIL import Image
from validation_tables import grid

import contactkit as ck
from contactkit.benchmarks.contact_studies import adhesive_sphere
from contactkit.plot import adhesion as curves
from contactkit.plot import style as plot

IMG = Path(__file__).parents[1] / "img"
WORK, MODULUS = 0.05, 1e9
SOLID = ck.Material(young_modulus=MODULUS, poisson_ratio=0.0)
LEVELS = {
    "isolated": (-12e-9, 2e-9),
    "periodic": (-4e-9, 0.0),
    "periodic, 100 nm on a rigid base": (-8e-9, 2e-9),
}


def scene(
    surface: object, law: object, window: ck.Window, solid: object = SOLID
) -> ck.ContactScene:
    """A rigid surface on a soft flat."""
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),  # type: ignore[arg-type]
        window=window,
        loading=ck.Approach(approach=0.0),
        effects=(ck.LayeredHalfSpace(), ck.Adhesion(law=law)),  # type: ignore[arg-type]
    )


def rough(
    rms: float, pixels: int = 64, count: int = 17, *, edges: str = "periodic"
) -> ck.PullOffCurve:
    """Curve of a self-affine map of eight pixels per shortest wave."""
    on_base = ck.Stack(
        layers=(ck.Layer(material=SOLID, thickness=1e-7),), substrate=ck.RigidBase(bonded=True)
    )
    width = pixels * 8e-9
    surface = ck.SelfAffineRoughness(rms=rms, hurst=0.8, rolloff=0.5 * width, cutoff=64e-9, seed=3)
    law = ck.ExponentialAttraction(work_of_adhesion=WORK, range=1e-9)
    window = ck.Window(width=width, periodic=edges != "isolated")
    solid = on_base if "base" in edges else SOLID
    plan = ck.plan(scene(surface, law, window, solid), ck.Accuracy(grid=pixels))
    low, high = LEVELS[edges]
    levels = np.linspace(low - rms, high, count)
    return ck.pull_off_curve(plan, levels)


def steps() -> str:
    """Change of the loads with the number of steps, and where the loop is lost."""
    rows = []
    for edges in LEVELS:
        rms = 2e-9 if edges == "isolated" else 0.6e-9
        found = {n: rough(rms, 48, n, edges=edges) for n in (9, 33)}
        row = [edges]
        for name in ("approaching", "separating"):
            fine, other = getattr(found[33], name), getattr(found[9], name)
            there = [int(np.argmin(np.abs(fine.approach - one))) for one in other.approach]
            same = np.abs(fine.approach[there] - other.approach) < 1e-15
            change = np.abs(fine.load[there] - other.load)[same].max() / np.abs(fine.load).max()
            row.append(f"{change:.0e}")
        one = found[33]
        row.append(f"{100 * sum(jump.energy_lost for jump in one.jumps) / one.loop_energy:.0f} %")
        rows.append(row)
    head = ["window", "approach, 9 or 33 levels", "separation", "of the loop in jumps"]
    return grid(head, rows)


def pictures() -> None:
    """Draw a sphere and a rough map."""
    figure, (left, right) = plot.figure(1, 2, size=(11.0, 4.6))
    curves.pull_off_curve(adhesive_sphere(2.0, 64), left)
    plot.title(left, "sphere, Maugis parameter 2")
    curves.pull_off_curve(rough(0.6e-9, 64, 25), right)
    plot.title(right, "rough map, rms slope 0.02")
    for ax in (left, right):
        plot.legend(ax, loc="lower left")
    picture = IMG / "adhesion-loops.png"
    plot.letters((left, right))
    plot.save(figure, picture)
    with Image.open(picture) as drawn:
        drawn.convert("RGB").quantize(128, Image.Quantize.MAXCOVERAGE, 1).save(picture)


TABLES = {"steps": steps}

if __name__ == "__main__":
    warnings.simplefilter("ignore", ck.ValidityWarning)
    sys.exit(measure(TABLES, "adhesion ", pictures))
