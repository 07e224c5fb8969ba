"""A sphere loaded beyond its hardness, unloaded and loaded again: hysteresis and residual shape.

The hardness is 0.6 of the maximum pressure of Hertz, so that the centre of the contact is plastic.
The first loading dissipates work; unloading and every reloading up to the same load are elastic.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import contactkit as ck
from contactkit.plot import plastic_history as history_plot
from contactkit.plot import style as plot
from contactkit.units import GPa, mm

RADIUS, FORCE = 1 * mm, 1.0  # [m], [N]
STEEL = ck.Material(name="steel", young_modulus=210 * GPa, poisson_ratio=0.3)


def main(out: Path) -> float:
    """Draw loop and residual depth; return dissipated work R/(P a2), elastic Hertz radius a [-]."""
    contact_radius = (0.75 * FORCE * RADIUS / STEEL.plane_strain_modulus) ** (1.0 / 3.0)
    hertz = 1.5 * FORCE / (math.pi * contact_radius**2)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=STEEL), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=3.2 * contact_radius, periodic=False),
        loading=ck.Pressing(force=FORCE),
        effects=(
            ck.HalfSpace(),
            ck.HardnessLimit(rule=ck.ConstantHardness(hardness=0.6 * hertz)),
            ck.PlasticHistory(forces=(0.5 * FORCE, 0.0, FORCE, 0.0), steps=12),
        ),
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=96)))
    part = result.of(ck.PlasticHistory)
    figure, (left, right) = plot.figure(1, 2, size=(11.0, 4.6))
    history_plot.force_approach(result, left)
    plot.title(left, "Half the load, none, the full load, none, the full load")
    history_plot.residual_depth(result, right)
    plot.title(right, "Residual depth")
    plot.letters((left, right))
    plot.save(figure, out / "loading_history")
    return float(part.plastic_work[-1] * RADIUS / (FORCE * contact_radius**2))


if __name__ == "__main__":
    sys.stdout.write(f"work dissipated, in P a2/R: {main(Path('out/examples')):.4f}\n")
