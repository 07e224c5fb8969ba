"""Fig. 1.2: adhesion of a pin of 2 mm to a flat over the humidity."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters, series
from contactkit.units import celsius, mm, nm

PAGE = Page(
    name="1.2",
    title="Adhesion of a pin over the humidity",
    claim="The adhesion of a ferrite pin of 2 mm to a ferrite flat in moist nitrogen (measured "
    "by others) rises with humidity; at saturation it is that of the meniscus equation.",
    verdict="The force of a smooth sphere, 4 pi R gamma = 1.8 mN, does not depend on humidity. "
    "What rises is the part of it that a rough pin reaches: menisci fill the clearance "
    "that its asperities keep only once they are higher, above 80 % for 5 nm and 95 % for "
    "20 nm. All clearances tend to the same force at saturation. The measured points are "
    "lost.",
    grid="150 humidities from 5 to 99.95 %",
    choices="Water at 20 degC that wets fully; clearances of 2 to 20 nm.",
)

RADIUS = 2 * mm
GAPS = np.array([0.0, 2.0, 5.0, 20.0]) * nm
WATER = ck.load_liquid("water")


def compute(draft: bool = False) -> dict[str, Any]:
    """Exact force of the condensed meniscus over the humidity, at each clearance."""
    dry = np.geomspace(0.95, 0.0005, 40 if draft else 150)
    humidity = 1.0 - dry
    forces = []
    for gap in GAPS.tolist():
        film = ck.Meniscus(liquid=WATER)
        scene = ck.SeparationScene(
            interface=ck.Interface(upper=ck.Sphere(radius=RADIUS), meniscus=film),
            loading=ck.ImposedSpeed(initial_gap=gap, final_gap=1e-3, speed=1e-6),
            effects=(ck.MeniscusForce(),),
            temperature=celsius(20.0),
        )
        found = ck.humidity_curve(scene, humidity.tolist())
        forces.append(found.force)
    return {"humidity": humidity, "force": np.array(forces), "height": found.meniscus_height}


def _saturated() -> float:
    """Force [N] of the meniscus equation, Eq. (3.6) with angles of zero."""
    tension = WATER.at(celsius(20.0)).surface_tension
    assert tension is not None
    return 4.0 * math.pi * RADIUS * tension


def draw(data: dict[str, Any]) -> Figure:
    """Force over humidity, and over what is left to saturation."""
    figure, panels = plot.figure(1, 2, size=(9.6, 4.6), sharey=True)
    humidity = data["humidity"]
    for i, (gap, force) in enumerate(zip(GAPS, data["force"], strict=True)):
        label = f"clearance {gap / nm:g} nm" if gap else "smooth, touching"
        for ax, x in zip(panels, (100.0 * humidity, 100.0 * (1.0 - humidity)), strict=True):
            ax.plot(x, force * 1e3, label=label, **series(i, marker=None))
    for ax in panels:
        ax.axhline(_saturated() * 1e3, color="0.5", lw=0.8)
        ax.axhspan(0.67, 0.87, color="0.92", label="load of the experiment")
    panels[0].set(xlabel="relative humidity [%]", ylabel="meniscus force [mN]", ylim=(0.0, 2.0))
    panels[1].set(xscale="log", xlabel="100 % less relative humidity [%]")
    panels[1].invert_xaxis()
    panels[0].annotate(r"$4\pi R\gamma$", (6.0, _saturated() * 1e3 + 0.02), fontsize=9)
    plot.legend(panels[1], fontsize=8, loc="lower right")
    letters(list(panels), ["over the humidity", "towards saturation"])
    return figure


def check(data: dict[str, Any]) -> list[Check]:
    """The plateau of a smooth pin, the rise of a rough one, and saturation."""
    humidity, force = data["humidity"], data["force"] / _saturated()
    half = [float(np.interp(0.5, f, humidity)) for f in force[1:]]
    at_95 = humidity < 0.95
    return [
        Check(
            "a smooth pin has the force of saturation at every humidity",
            bool(np.all(np.abs(force[0][at_95] - 1.0) < 0.01)),
            f"{force[0][at_95].min():.4f} to {force[0][at_95].max():.4f} of 4 pi R gamma",
        ),
        Check(
            "with a clearance it rises with the humidity, up to 99 %",
            bool(np.all(np.diff(force[1:, humidity < 0.99], axis=1) >= 0.0)),
            f"half of it at {', '.join(f'{100 * h:.0f}' for h in half)} %",
        ),
        Check(
            "towards saturation all clearances have the force of the meniscus equation to 3 %",
            bool(np.all(np.abs(force[:, -1] - 1.0) < 0.03)),
            f"{', '.join(f'{f:.3f}' for f in force[:, -1])} of {_saturated() * 1e3:.2f} mN",
        ),
        Check(
            "that force exceeds the load of the experiment",
            _saturated() > 0.87e-3,
            f"{_saturated() * 1e3:.2f} mN against 0.67 to 0.87 mN",
        ),
        agree(
            "force of the smooth pin at 95 %, 4 pi R gamma",
            np.interp(0.95, humidity, data["force"][0]),
            4.0 * math.pi * 2e-3 * 72.74e-3,
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
