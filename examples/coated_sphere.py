"""A ball on coated steel, at rest and sliding: stress in the coating and in the steel.

Maximum von Mises stress in the coating and below it, over the thickness. A thin coating does not
change the stress in the steel, and sliding doubles that in the coating. Only a coating as thick
as the contact (37 um) reduces the stress in the steel. A coating thinner than a pixel, 2.5 um, is
warned about: the pressure follows it on long waves only.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.reference import hertz
from contactkit.units import GPa, mm, um

RADIUS, LOAD, FRICTION = 3 * mm, 5.0, 0.2
STEEL = ck.load_material("bearing-steel")
COATING = ck.load_material("dlc-hard")


def pressed(thickness: float | None, friction: float, pixels: int = 36) -> ck.ContactResult:
    """Rigid ball on steel, coated or uncoated; stress down to two contact radii."""
    radius = hertz.sphere(LOAD, RADIUS, STEEL.plane_strain_modulus).contact_radius
    layers = () if thickness is None else (ck.Layer(material=COATING, thickness=thickness),)
    depths = tuple(radius * float(z) for z in np.linspace(0.0, 1.4, 15) ** 2)
    slid = (ck.FrictionTraction(coefficient=friction),) if friction else ()
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Stack(layers=layers, substrate=STEEL)),
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS)),
        ),
        window=ck.Window(width=2.4 * radius, periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(ck.LayeredHalfSpace(), *slid, ck.SubsurfaceStress(depths=depths, window=16.0)),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=pixels)))


def maximum(run: ck.ContactResult, layer: int) -> float:
    """Maximum von Mises stress [Pa] on the planes in a layer."""
    part = run.of(ck.SubsurfaceStress)
    return float(part.largest_von_mises[part.layer == layer].max())


def main(out: Path) -> float:
    """Draw the stresses; return the uncoated maximum over Hertz's pressure [-]."""
    thicknesses = [1.0 * um * 2.0**i for i in range(7)]
    figure, (left, right) = plot.figure(1, 2, size=(11.0, 4.6))
    for friction, color in ((0.0, plot.COLORS["gap"]), (FRICTION, plot.COLORS["meniscus"])):
        runs = [pressed(h, friction) for h in thicknesses]
        for ax, layer in ((left, 0), (right, 1)):
            values = [maximum(run, layer) / GPa for run in runs]
            label = f"mu = {friction:g}"
            ax.plot([h / um for h in thicknesses], values, "o-", ms=3.5, color=color, label=label)
        uncoated = pressed(None, friction).of(ck.SubsurfaceStress).maxima["von_mises"].value
        right.axhline(uncoated / GPa, ls="--", lw=1.0, color=color)
    for ax, title in ((left, "in the coating"), (right, "in the steel (dashed: uncoated)")):
        ax.set(xscale="log", xlabel="thickness of the coating [um]")
        ax.set_ylabel("maximum von Mises stress [GPa]")
        plot.plain_log(ax.xaxis)
        plot.title(ax, f"Ball of 3 mm, 5 N: {title}")
    plot.legend(left)
    plot.letters((left, right))
    plot.save(figure, out / "coated_sphere")
    exact = hertz.sphere(LOAD, RADIUS, STEEL.plane_strain_modulus).peak_pressure
    value = pressed(None, 0.0).of(ck.SubsurfaceStress).maxima["von_mises"].value
    return float(value / exact)


if __name__ == "__main__":
    sys.stdout.write(f"von Mises over p0: {main(Path('out/examples')):.4f} (Hertz: 0.6200)\n")
