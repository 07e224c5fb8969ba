"""Pictures of the how-to on gradients: ``python docs/scripts/gradients``."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt

import contactkit as ck
from contactkit.plot import style
from contactkit.studies.sobol import SobolIndices
from contactkit.units import GPa, nm, um

IMG = Path(__file__).parents[2] / "img"
NAMES = {
    "interface.upper.surface.rms": "rms height",
    "interface.lower.solid.substrate.young_modulus": "modulus of the substrate",
    "interface.lower.solid.layers.0.material.young_modulus": "modulus of the coating",
    "interface.lower.solid.layers.0.thickness": "thickness of the coating",
    "interface.lower.solid.substrate.poisson_ratio": "Poisson's ratio of the substrate",
    "loading.approach": "approach",
}


def contact() -> ck.ContactResult:
    """Solve the coated contact of the page."""
    coating = ck.Material(young_modulus=200 * GPa, poisson_ratio=0.2)
    steel = ck.load_material("bearing-steel")
    coated = ck.Stack(layers=(ck.Layer(material=coating, thickness=50 * nm),), substrate=steel)
    rough = ck.SelfAffineRoughness(rms=5 * nm, hurst=0.8, rolloff=1 * um, cutoff=200 * nm, seed=2)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=coated), upper=ck.Body(surface=rough)),
        window=ck.Window(width=2 * um),
        loading=ck.Approach(approach=15 * nm),
        effects=(ck.LayeredHalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=128)))


def sobol() -> SobolIndices:
    """Vary the assumptions of a pull all at once."""
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=1e-3)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedForce(force=1.0, mass=1e-3, initial_gap=5e-6, final_gap=2e-5),
        effects=(ck.ViscousForce(),),
    )
    ranges = {
        "interface.meniscus.liquid.viscosity": ck.Range("0.05 Pa.s", "0.2 Pa.s", "grades"),
        "loading.initial_gap": ck.Range("4 um", "7 um", "waviness"),
        "loading.force": ck.Range(0.8, 1.5, "spring"),
        "loading.mass": ck.Range("0.5 g", "2 g", "armature"),
    }
    return ck.sobol_indices(scene, ranges, "release_time", ck.Accuracy.draft, n=64)


def main() -> None:
    """Draw both pictures."""
    result = contact()
    gradient = result.gradient("load", ("heights", *NAMES))
    made, axes = style.figure(1, 2, (10.5, 4.2))
    left, right = axes
    result.plot.pressure(ax=left)
    gradient.plot.heights(ax=right)
    left.set_title("pressure")
    right.set_title("what the height of each pixel adds to the load")
    style.save(made, IMG / "gradient-map.png")
    plt.close(made)
    made, axes = style.figure(1, 2, (11.5, 3.4))
    left, right = axes
    gradient.plot.relative(ax=left, names=NAMES)
    sobol().plot.indices(ax=right)
    style.save(made, IMG / "gradient-bars.png")
    plt.close(made)


if __name__ == "__main__":
    main()
