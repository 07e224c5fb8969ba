"""Free boundary: menisci by the equation of Young and Laplace in place of arcs of a circle."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.capillary.arc.profile import arc_profile
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.profile import profile
from contactkit.gallery.chapter_3.films import (
    GAMMA,
    RADIUS,
    sphere_break_gaps,
    sphere_volume,
)
from contactkit.plot import gallery as plot
from contactkit.units import deg, nm

PAGE = Page(
    name="exact-menisci",
    title="Menisci with a free boundary",
    claim="Future work of section 3.5: menisci whose boundary is free in place of arcs of a "
    "circle with prescribed ends.",
    verdict="It is the default of this package. A free boundary has one mean curvature: along the "
    "arc it varies, by some per cent at first and to a multiple of its mean near rupture, "
    "so that the force of the arc depends on the section. The exact bridge ends where it "
    "loses stability, at a third of the gap at which the arc closes. Beyond contactkit: "
    "evaporation during the opening, rims pinned at edges, the flow while the bridge "
    "breaks.",
    choices="Sphere of the source, 100 nm, at 1 nm, water, 60/60 degrees, film of 4 nm.",
    grid="201 points of each meridian; 60 gaps",
)
ANGLE, START, HEIGHT = 60 * deg, 1 * nm, 4 * nm
PLACES = (0.0, 0.5, 0.98)  # of the way from the start to the limit


def compute(draft: bool = False) -> dict[str, Any]:
    """Meridians, mean curvature along them, and force through each section."""
    n = 20 if draft else 60
    liquid = sphere_volume(START, HEIGHT)
    shape = (ANGLE, ANGLE, 0.0, 1.0 / RADIUS)
    limit, closed = sphere_break_gaps(liquid)
    data: dict[str, Any] = {"limit": np.array(limit), "closed": np.array(closed)}
    for i, place in enumerate(PLACES):
        gap = START + place * (limit - START)
        r, z = profile(bridge(gap, liquid, *shape), 201)
        data[f"exact_{i}"] = np.array([r, z])
        data[f"arc_{i}"] = np.array(arc_profile(gap, liquid, *shape, count=201))
    gaps = np.linspace(START, limit * (1.0 - 1e-9), n)
    found = [_spread(arc_profile(gap, liquid, *shape, count=201)) for gap in gaps.tolist()]
    exact = bridge(gaps, liquid, *shape)
    least, greatest, low, high = np.array(found).T
    return data | {
        "gaps": gaps,
        "curvature": np.array([least, greatest]),
        "force": GAMMA * np.array([low, high]),
        "exact": GAMMA * exact.force,
        "pressure": exact.pressure,
        "shooting": np.array(_shooting(bridge(gaps[n // 2], liquid, *shape))),
    }


def _of(meridian: Any) -> tuple[Any, Any]:
    """Pressure over tension [1/m] and force over tension [m] at the sections of an arc."""
    r, z = meridian
    # Circle through the points: r^2 + z^2 = 2 a r + 2 b z + c.
    rows = np.stack((2.0 * r, 2.0 * z, np.full_like(r, r[0]))).T
    a, b, c = np.linalg.lstsq(rows / r[0], (r**2 + z**2) / r[0], rcond=None)[0]
    bend = 1.0 / np.sqrt(a**2 + b**2 + c * r[0])
    sine = (a - r) * bend  # of the angle of the meridian to the flat, at a neck
    return sine / r - bend, np.pi * r * sine + np.pi * r**2 * bend


def _spread(meridian: Any) -> tuple[float, float, float, float]:
    """Least and greatest pressure over tension along an arc, and force over tension."""
    mean, force = _of(meridian)
    return float(mean.min()), float(mean.max()), float(force.min()), float(force.max())


def _shooting(state: Any) -> tuple[float, float]:
    """Radius of the contact circle on the sphere, by integration from the flat and as solved."""
    pressure, length = float(state.pressure), float(state.arc_lower + state.arc_upper)

    def rate(_: float, y: Any) -> list[float]:
        r, _, angle = y  # of the meridian to the flat
        return [np.cos(angle), np.sin(angle), pressure - np.sin(angle) / r]

    start = [float(state.radius_lower), 0.0, np.pi - ANGLE]
    found = solve_ivp(rate, (0.0, length), start, rtol=1e-11, atol=1e-20)
    return float(found.y[0, -1]), float(state.radius_upper)


def draw(data: Data) -> plot.Figure:
    """Meridians, pressure along them, force through their sections."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.4))
    names = ("at the start", "half way", "at 98 % of the way")
    for i, name in enumerate(names):
        look = plot.series(i, marker="", ls="-")
        for kind, line in (("exact", "-"), ("arc", "--")):
            r, z = data[f"{kind}_{i}"] / nm
            left.plot(r, z, **(look | {"ls": line}), label=name if kind == "exact" else None)
    left.plot([], [], "--", color="0.3", label="arc")
    left.set(xlabel="radius [nm]", ylabel="height [nm]", xlim=(0.0, None))
    left.legend(fontsize=8)
    gaps = data["gaps"] / nm
    style = plot.series(1, marker="", ls="-")
    tension = 1e-6 * GAMMA
    middle.fill_between(gaps, *(data["curvature"] * tension), color=style["color"], alpha=0.3, lw=0)
    middle.plot([], [], lw=8, alpha=0.3, color=style["color"], label="arc: along its meridian")
    middle.plot(gaps, data["pressure"] * tension, **plot.series(0, marker=""), label="exact")
    middle.set(xlabel="gap [nm]", ylabel="Laplace pressure [MPa]")
    right.fill_between(gaps, *(data["force"] / nm), color=style["color"], alpha=0.3, lw=0)
    right.plot([], [], lw=8, alpha=0.3, color=style["color"], label="arc: by the section")
    right.plot(gaps, data["exact"] / nm, **plot.series(0, marker=""), label="exact")
    right.set(xlabel="gap [nm]", ylabel="meniscus force [nN]", ylim=(0.0, None))
    middle.legend(fontsize=8)
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("meridians", "pressure", "force"))
    return figure


def check(data: Data) -> list[Check]:
    """Pressure and force of the arc along its meridian, and independence of the exact bridge."""
    low, high = data["curvature"]
    scatter = (high - low) / np.abs(data["pressure"])
    weak, strong = data["force"]
    width = (strong - weak) / data["exact"]
    radius, solved = data["shooting"]
    limit, end = float(data["limit"]) / nm, float(data["closed"]) / nm
    return [
        Check(
            "an independent integration of the meridian ends where the exact bridge does",
            bool(abs(radius / solved - 1.0) < 1e-7),
            f"{radius / nm:.6f} and {solved / nm:.6f} nm on the sphere, half way",
        ),
        Check(
            "along the arc the pressure varies, from the start on",
            bool(np.all(scatter > 0.01)),
            f"by {100 * scatter[0]:.1f} % of it at the start",
        ),
        Check(
            "the force of the arc depends on its section, by more than a tenth near the limit",
            bool(width[-1] > 0.1),
            f"by {100 * width[0]:.1f} % at the start, {100 * width[-1]:.0f} % at the limit",
        ),
        Check(
            "the exact force lies between those of the sections at the start",
            bool(weak[0] < data["exact"][0] < strong[0]),
            f"{weak[0] / nm:.2f}, {data['exact'][0] / nm:.2f}, {strong[0] / nm:.2f} nN",
        ),
        Check(
            "the exact bridge breaks at less than a third of the gap at which the arc closes",
            limit < end / 3.0,
            f"{limit:.1f} and {end:.1f} nm",
        ),
    ]


def table(data: Data) -> Table:
    """Forces at some gaps."""
    rows = [
        [float(v) / nm for v in (data["gaps"][i], data["exact"][i], *data["force"][:, i])]
        for i in np.linspace(0, data["gaps"].size - 1, 5).astype(int)
    ]
    return Table(("gap [nm]", "exact [nN]", "arc, least [nN]", "arc, greatest [nN]"), rows)


if __name__ == "__main__":
    run_page(__file__)
