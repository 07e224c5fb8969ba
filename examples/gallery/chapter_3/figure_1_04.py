"""Fig. 1.4: meniscus and van der Waals force on a sphere over its distance from a flat."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactkit as ck
from contactkit.adhesion.van_der_waals import sphere_force
from contactkit.app.gallery.page import Check, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.capillary.exact.bridge import bridge_at_pressure
from contactkit.capillary.kelvin import kelvin_radius
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters, series
from contactkit.units import celsius, deg, nm

PAGE = Page(
    name="1.4",
    title="Meniscus against van der Waals force",
    claim="The meniscus force, for several humidities and radii, exceeds the van der Waals "
    "force beyond a distance of about 0.5 nm.",
    verdict="It does from 0.2 nm up to where the meniscus breaks: 1.3 nm at 50 % and 8 nm at 90 % "
    "humidity on a large sphere, 3 nm there on one of 10 nm. At 10 % it breaks below 0.4 "
    "nm, and the statement is wrong.",
    grid="400 distances from 0.1 to 30 nm",
    choices="Water at 20 degC, 20 degrees, Hamaker's constant 1e-19 J; cut-off 0.165 nm marked. "
    "Kelvin's equation below 1 nm treats a few molecules.",
)

RADII = np.array([10.0, 100.0, 1000.0]) * nm
HUMIDITIES = np.array([0.1, 0.5, 0.9])
ANGLE, HAMAKER, CUT = 20 * deg, 1e-19, 0.165 * nm


def compute(draft: bool = False) -> dict[str, Any]:
    """Both forces over the distance; nan where the meniscus has broken."""
    gaps = np.geomspace(0.1 * nm, 30 * nm, 100 if draft else 400)
    water = ck.load_liquid("water").at(celsius(20.0))
    tension = water.surface_tension
    assert tension is not None
    assert water.density is not None
    volume = 18.015e-3 / water.density  # [m3/mol]
    kelvin = kelvin_radius(tension, volume, celsius(20.0), HUMIDITIES)
    meniscus = [
        [
            tension
            * bridge_at_pressure(gaps, -1.0 / k, ANGLE, ANGLE, 0.0, 1.0 / r, beyond="nan").force
            for k in kelvin.tolist()
        ]
        for r in RADII.tolist()
    ]
    solids = [sphere_force(gaps, HAMAKER, 1.0 / r) for r in RADII.tolist()]
    return {
        "gaps": gaps,
        "kelvin": kelvin,
        "meniscus": np.array(meniscus),
        "solids": np.array(solids),
    }


def draw(data: dict[str, Any]) -> Figure:
    """Forces on the middle sphere; ratio of the forces for all radii at 50 %."""
    figure, (left, right) = plot.figure(1, 2, size=(9.6, 4.6))
    gaps = data["gaps"] / nm
    for j, humidity in enumerate(HUMIDITIES):
        look = series(j + 1, marker=None)
        left.plot(
            gaps, data["meniscus"][1, j] / nm, label=f"meniscus, {100 * humidity:g} %", **look
        )
        for i, radius in enumerate(RADII):
            shade = look | {"lw": (0.8, 1.4, 2.4)[i]}
            label = f"{radius / nm:g} nm, {100 * humidity:g} %" if j == 1 else None
            right.plot(gaps, data["meniscus"][i, j] / data["solids"][i], label=label, **shade)
    left.plot(gaps, data["solids"][1] / nm, color="k", label="van der Waals")
    for ax in (left, right):
        ax.axvline(CUT / nm, color="0.5", lw=0.8)
        ax.set(xscale="log", yscale="log", xlabel="distance [nm]")
        plot.plain_log(ax.xaxis)
    left.set(ylabel="force on a sphere of 100 nm [nN]", ylim=(0.01, 1000.0))
    right.axhline(1.0, color="0.5", lw=0.8)
    right.set(ylabel="meniscus over van der Waals force", ylim=(0.3, 1e4))
    plot.legend(left, fontsize=8)
    plot.legend(right, fontsize=8, loc="upper center")
    letters([left, right], ["sphere of 100 nm", "thin to thick: 10, 100, 1000 nm"])
    return figure


def table(data: dict[str, Any]) -> Table:
    """Range of distances in which the meniscus force is the larger one."""
    rows = []
    for i, radius in enumerate(RADII):
        for j, humidity in enumerate(HUMIDITIES):
            low, high = _range(data, i, j)
            rows.append(
                [radius / nm, 100 * humidity, 2 * np.cos(ANGLE) * data["kelvin"][j] / nm, low, high]
            )
    head = ["radius [nm]", "humidity [%]", "height of the meniscus [nm]", "from [nm]", "to [nm]"]
    return Table(head, [[float(v) for v in row] for row in rows])


def _range(data: dict[str, Any], i: int, j: int) -> tuple[float, float]:
    """First and last distance [nm] at which the meniscus force is the larger one; nan if none."""
    larger = np.flatnonzero(data["meniscus"][i, j] > data["solids"][i])
    if not larger.size:
        return np.nan, np.nan
    gaps = data["gaps"] / nm
    return float(gaps[larger[0]]), float(gaps[larger[-1]])


def _thin_film(radius: float, gap: float, humidity: float) -> float:
    """Force [N] of a film much thinner than wide, 4 pi R gamma cos(theta) less that of its gap.

    Its curvature along the circle, which is left out, is 1.5 % of it here.
    """
    kelvin = 72.74e-3 * 18.05e-6 / (8.314 * 293.15 * -np.log(humidity))
    cosine = np.cos(np.radians(20.0))
    return float(4.0 * np.pi * radius * 72.74e-3 * cosine * (1.0 - 0.5 * gap / (kelvin * cosine)))


def check(data: dict[str, Any]) -> list[Check]:
    """Distances between which the meniscus force is the larger one."""
    ranges = {(i, j): _range(data, i, j) for i in range(3) for j in range(3)}
    heights = 2.0 * np.cos(ANGLE) * data["kelvin"] / nm
    moist = [ranges[i, j] for i in range(3) for j in (1, 2)]
    ends = [ranges[i, j][1] / heights[j] for i in range(3) for j in range(3)]
    return [
        Check(
            "at 50 and 90 % the meniscus force is the larger one at 0.5 nm",
            all(low < 0.5 < high for low, high in moist),
            f"from {min(r[0] for r in moist):.2f} to {max(r[0] for r in moist):.2f} nm on",
        ),
        Check(
            "on the largest sphere it ends at 0.75 to 0.95 of the height of Kelvin's equation",
            all(0.75 < end < 0.95 for end in ends[6:]),
            f"{min(ends[6:]):.2f} to {max(ends[6:]):.2f} of them; 10 nm: from {min(ends):.2f} on",
        ),
        Check(
            "at 10 % it ends below 0.5 nm, so that the statement needs moist air",
            all(ranges[i, 0][1] < 0.5 for i in range(3)),
            f"{', '.join(f'{ranges[i, 0][1]:.2f}' for i in range(3))} nm",
        ),
        agree(
            "at 0.2 nm on 1 um and 50 %: van der Waals force, meniscus of a thin film",
            [
                float(np.interp(0.2 * nm, data["gaps"], one))
                for one in (data["solids"][2], data["meniscus"][2, 1])
            ],
            [1e-19 * 1e-6 / (6.0 * 0.2e-9**2), _thin_film(1e-6, 0.2e-9, 0.5)],
            0.02,
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
