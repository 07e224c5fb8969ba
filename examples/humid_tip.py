"""A sphere on a flat in moist air: force of the meniscus that condenses between them.

In contact the force hardly depends on the humidity, as long as the meniscus is thin compared with
the sphere. At a gap of a third of a nanometre there is no meniscus in dry air. Compares the exact
bridge, at the pressure of Kelvin's equation, with the law of a thin film, Eq. (3.7).
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.units import nm

if TYPE_CHECKING:
    from contactkit.analyses.humidity_curve import HumidityCurve

HUMIDITIES = [0.05 + 0.01 * i for i in range(93)]
WATER = ck.load_liquid("water")
WETTING = 2.0  # sum of the cosines of both contact angles


def curve(radius: float, gap: float, humidities: list[float]) -> HumidityCurve:
    """Force over humidity at a constant gap [m], contact angles of zero."""
    film = ck.Meniscus(liquid=WATER)
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=radius), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=100 * nm, speed=1e-6),
        effects=(ck.MeniscusForce(),),
    )
    return ck.humidity_curve(scene, humidities)


def classical(radius: float) -> float:
    """Force of a thin meniscus on a touching sphere [N], independent of the humidity."""
    tension = WATER.at(293.15).surface_tension
    assert tension is not None
    return 2.0 * math.pi * radius * tension * WETTING


def main(out: Path) -> float:
    """Draw the forces; return that on a touching sphere of 100 Kelvin radii over 4 pi R gamma."""
    figure, ax = plot.figure()
    for radius, name in ((20 * nm, "limit"), (100 * nm, "meniscus"), (1000 * nm, "gap")):
        for gap, style in ((0.0, "-"), (0.3 * nm, "--")):
            found = curve(radius, gap, HUMIDITIES)
            label = f"sphere of {radius / nm:g} nm" + (", touching" if not gap else ", 0.3 nm away")
            ratio = found.force / classical(radius)
            ax.plot(
                100.0 * found.relative_humidity, ratio, style, color=plot.COLORS[name], label=label
            )
    ax.plot(
        [100.0 * h for h in HUMIDITIES],
        [max(1.0 - 0.3 * nm / height, 0.0) for height in found.meniscus_height],
        "k:",
        label="thin film, Eq. (3.7), 0.3 nm away",
    )
    ax.set(xlabel="relative humidity [%]", ylabel="force over 4 pi R gamma", ylim=(0.0, 1.05))
    plot.title(ax, "Water that condenses under a sphere at 20 degC")
    plot.legend(ax, loc="lower right")
    plot.save(figure, out / "humid_tip")
    radius = 100.0 * float(curve(1000 * nm, 0.0, [0.5]).kelvin_radius[0])
    return float(curve(radius, 0.0, [0.5]).force[0]) / classical(radius)


if __name__ == "__main__":
    sys.stdout.write(f"{main(Path('out/examples')):.5f} of the classical force\n")
