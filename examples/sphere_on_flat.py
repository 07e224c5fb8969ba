"""A sphere of 100 nm on a flat, a few nanometres of water between them.

Reproduces the mean viscous forces of the source's section 3.2.3 (opening within 0.1 us), and
compares the meniscus force of the arc with Eq. (3.12) as printed, whose second curvature has the
wrong sign.
"""

from __future__ import annotations

import math
import sys
import warnings
from pathlib import Path

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.units import deg, nm, us

RADIUS, GAP = 100 * nm, 1 * nm
HEIGHTS = (2, 3, 4, 5, 6)  # height of the film at its rim [nm]
BREAKS = (39, 58, 73, 87, 99)  # gaps of rupture in the source [nm]
PRINTED = (0.1976, 0.4826, 0.7487, 0.9861, 1.1974)  # mean viscous force in the source [nN]


def result(height: float, far: float, profile: str) -> ck.SeparationResult:
    """Opening within 0.1 us; the volume follows from the height of the film, Eq. (3.23)."""
    water = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
    film = ck.Meniscus(
        liquid=water,
        volume=math.pi * RADIUS * (height**2 - GAP**2),
        contact_angle_lower=60 * deg,
        contact_angle_upper=60 * deg,
    )
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=RADIUS), meniscus=film),
        loading=ck.ImposedTime(initial_gap=GAP, final_gap=far, time=0.1 * us),
        effects=(ck.MeniscusForce(profile=profile), ck.ViscousForce()),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # 1 nm: not a continuum
        return ck.simulate(ck.plan(scene))


def main(out: Path) -> float:
    """Draw the meniscus forces; return the maximum error of the five mean viscous forces [-]."""
    figure, ax = plot.figure()
    worst = 0.0
    for height, far, printed in zip(HEIGHTS, BREAKS, PRINTED, strict=True):
        arc = result(height * nm, far * nm, "arc")
        mean = arc.of(ck.ViscousForce).mean_force() * 1e9
        worst = max(worst, abs(mean / printed - 1.0))
        if height in (2, 6):
            published = result(height * nm, far * nm, "as-published")
            color = plot.COLORS["meniscus" if height == 2 else "gap"]
            for one, style, label in (
                (arc, "-", "arc"),
                (published, "--", "Eq. (3.12) as printed"),
            ):
                ax.plot(
                    one.gap * 1e9,
                    one["meniscus_force"] * 1e9,
                    style,
                    color=color,
                    label=f"film of {height} nm, {label}",
                )
    ax.set(xlabel="gap [nm]", ylabel="meniscus force [nN]", xscale="log")
    plot.plain_log(ax.xaxis)
    plot.title(ax, "Water between a sphere of 100 nm and a flat, 60/60 deg")
    plot.legend(ax)
    plot.save(figure, out / "sphere_on_flat")
    return worst


if __name__ == "__main__":
    sys.stdout.write(f"maximum difference: {100 * main(Path('out/examples')):.2g} %\n")
