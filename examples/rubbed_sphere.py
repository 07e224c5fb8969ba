"""A sphere rubbed to and fro: traction, stick and slip, and the energy that a cycle dissipates.

The tangential force stays below friction times load, so that the centre of the contact sticks
(Cattaneo, Mindlin); the slipping annulus dissipates energy in every cycle (Mindlin, Deresiewicz).
"""

from __future__ import annotations

import sys
from pathlib import Path

import contactkit as ck
from contactkit.plot import slip as slip_plot
from contactkit.plot import style as plot
from contactkit.reference import partial_slip
from contactkit.units import GPa, mm

RADIUS, FORCE, FRICTION = 1 * mm, 1.0, 0.3  # [m], [N], [-]
GLASS = ck.Material(name="glass", young_modulus=70 * GPa, poisson_ratio=0.3)


def main(out: Path) -> float:
    """Draw traction, zones and loop; return the loss of a cycle over that of the closed form."""
    radius = (0.75 * FORCE * RADIUS / GLASS.plane_strain_modulus) ** (1.0 / 3.0)
    path = tuple(ck.TangentialStep(ratio=r, steps=n) for r, n in ((0.8, 8), (-0.8, 16), (0.8, 16)))
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=GLASS), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=2.4 * radius, periodic=False),
        loading=ck.Pressing(force=FORCE),
        effects=(ck.HalfSpace(), ck.PartialSlip(coefficient=FRICTION, path=path)),
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=96)))
    part = result.of(ck.PartialSlip)
    figure, (left, middle, right) = plot.figure(1, 3, size=(13.5, 4.4))
    slip_plot.traction_profile(result, left)
    plot.title(left, "Traction along the centre line")
    slip_plot.slip_zones(result, middle, step=1)
    plot.title(middle, "Zones after the reversal")
    slip_plot.hysteresis(result, right)
    plot.title(right, "Force over displacement")
    plot.letters((left, middle, right))
    plot.save(figure, out / "rubbed_sphere")
    modulus = 0.5 * GLASS.young_modulus / (1.0 + GLASS.poisson_ratio) / (2.0 - GLASS.poisson_ratio)
    sphere = partial_slip.Sphere(FORCE, FRICTION, radius, modulus)
    return part.energy_loss(0, 2) / partial_slip.cycle_loss(sphere, 0.8 * FRICTION * FORCE)


if __name__ == "__main__":
    sys.stdout.write(f"loss of a cycle over theory: {main(Path('out/examples')):.5f}\n")
