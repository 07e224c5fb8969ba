"""Pull-off of a sphere from a soft flat, on the grid and in closed form.

A sphere comes down on an elastic half-space and is pulled off again. With a short range of the
attraction the contact is JKR-like: it snaps in, draws out a neck and snaps off; the loop between
both branches is the energy lost. With a long range it is DMT-like and nearly reversible. The
closed forms of Maugis and Dugdale are drawn beside the states of the grid.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np

import contactkit as ck
from contactkit.adhesion import maugis_dugdale
from contactkit.adhesion.parameters import AdhesionScales, scales
from contactkit.plot import adhesion as curves
from contactkit.plot import style as plot
from contactkit.units import um

RADIUS, WORK, MODULUS = 100.0 * um, 0.05, 1e6  # [m], [J/m2], E* [Pa]
UNITS: AdhesionScales = scales(RADIUS, WORK, MODULUS)


def scene(transition: float) -> ck.ContactScene:
    """Sphere of a Maugis parameter [-], which sets the range of the attraction."""
    modulus = 4.0 / 3.0 * MODULUS
    stress = 0.5 * transition * (math.pi * WORK * modulus**2 / RADIUS) ** (1.0 / 3.0)
    rubber = ck.Material(name="rubber", young_modulus=0.75 * MODULUS, poisson_ratio=0.5)
    law = ck.DugdaleAttraction(work_of_adhesion=WORK, range=WORK / stress)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=rubber), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=5.0 * UNITS.radius, periodic=False),
        loading=ck.Approach(approach=0.0),
        effects=(ck.HalfSpace(), ck.Adhesion(law=law)),
    )


def closed_form(transition: float, approach: float) -> float:
    """Load [N] of Maugis and Dugdale in contact at an approach [m]."""
    limits = maugis_dugdale.limits(transition)
    gap = -approach / UNITS.approach
    return maugis_dugdale.at_gap(gap, transition, limits).load * UNITS.load


def main(out: Path, grid: int = 64) -> float:
    """Draw the curves; return the pull-off force of the JKR-like sphere over the closed form."""
    figure, axes = plot.figure(1, 2, size=(11.0, 4.6))
    levels = UNITS.approach * np.concatenate([[-4.0], np.linspace(-1.3, 0.3, 13)])
    for ax, transition in zip(axes, (0.5, 2.0), strict=True):
        curve = ck.pull_off_curve(ck.plan(scene(transition), ck.Accuracy(grid=grid)), levels)
        curves.pull_off_curve(curve, ax)
        limits = maugis_dugdale.limits(transition)
        exact = np.linspace(limits.release.approach, 0.3, 60) * UNITS.approach
        loads = [closed_form(transition, one) * 1e6 for one in exact]
        ax.plot(exact / um, loads, "k--", lw=1.0, label="Maugis-Dugdale")
        ax.set_xlim(-1.5 * UNITS.approach / um, 0.32 * UNITS.approach / um)
        plot.title(ax, f"sphere on rubber, Maugis parameter {transition:g}")
        plot.legend(ax, loc="lower left")
    plot.letters(axes)
    plot.save(figure, out / "sphere_pull_off")
    return -curve.pull_off_force / (limits.pull_off.load * UNITS.load)


if __name__ == "__main__":
    sys.stdout.write(f"{main(Path('out/examples')):.4f} of the closed form\n")
