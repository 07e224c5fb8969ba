"""Table 4.1: every printed equation evaluated beside the right value, with its erratum."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.as_published.lookup import PUBLISHED, TABLE_4_1, erratum, published
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure
from contactkit.units import deg, nm

PAGE = Page(
    name="Table 4.1",
    title="The equations of chapter 3, evaluated",
    claim="A summary of the equations of meniscus and viscous forces of flats, spheres, rough "
    "surfaces and divided films, in normal and tangential separation.",
    verdict="For the source's own films half of them are within some per cent, the others off by "
    "more than a tenth, most by a factor of two and more: see the "
    "[errata](../errata.md#chapter-3-separation). All viscous forces are impulses over a "
    "time.",
    grid="one value for each argument",
    choices="Films of section 3.2.3: water, 60/60 degrees, flats with a meniscus of 100 nm at 2 "
    "nm, a sphere of 100 nm at 1 nm with a film of 2 nm, 0.1 us, 100 menisci; filling angle 8 "
    "degrees.",
)

FLATS: dict[str, Any] = {
    "surface_tension": 0.072,
    "angle_lower": 60 * deg,
    "angle_upper": 60 * deg,
    "angle": 60 * deg,
    "radius": 100 * nm,
    "gap": 2 * nm,
    "number": 100,
    "gap_start": 2 * nm,
    "gap_end": 180 * nm,
    "separation_time": 1e-7,
    "viscosity": 0.89e-3,
    "force": 1e-9,
}
SPHERE: dict[str, Any] = FLATS | {
    "sphere_radius": 100 * nm,
    "immersion": 1 * nm,
    "filling_angle": 8 * deg,
    "volume": 927.316 * nm**3,
    "film_height": 2 * nm,
    "gap": 1 * nm,
    "gap_start": 1 * nm,
    "gap_end": 39 * nm,
}
NUMBERS = tuple((case, number) for case, numbers in TABLE_4_1.items() for number in numbers)


def compute(draft: bool = False) -> dict[str, Any]:
    """Printed and corrected value of each equation; nan where there is no corrected one."""
    found = []
    for _, number in NUMBERS:
        names = PUBLISHED[number].arguments
        film = SPHERE if "sphere_radius" in names else FLATS
        one = published(number, **{name: film[name] for name in names if name in film})
        found.append([one.value, math.nan if one.corrected is None else one.corrected])
    return {"values": np.array(found)}


def draw(data: dict[str, Any]) -> Figure:
    """Printed over right value of each equation."""
    figure, ax = plot.figure(size=(9.6, 7.2))
    printed, right = data["values"].T
    places = np.arange(len(NUMBERS))
    ratio = np.where(printed > 0.0, printed / right, np.nan)
    good = np.abs(ratio - 1.0) < 0.05
    for rows, color, sign, label in (
        (good, "#0072b2", "o", "within 5 %"),
        (~good & np.isfinite(ratio), "#d55e00", "s", "off by more"),
    ):
        ax.plot(ratio[rows], places[rows], sign, color=color, label=label)
        ax.hlines(places[rows], 1.0, ratio[rows], color=color, lw=1.2)
    for i in np.flatnonzero(~np.isfinite(ratio)):
        ax.plot(0.012, places[i], "<", color="#d55e00")
        ax.annotate("0 as printed", (0.014, places[i]), fontsize=8, va="center")
    ax.axvline(1.0, color="0.5", lw=0.8)
    ax.set_yticks(places, [f"({number}) {case}" for case, number in NUMBERS], fontsize=8)
    ax.invert_yaxis()
    ax.set(xscale="log", xlim=(0.01, 4.0), xlabel="printed over right value")
    plot.plain_log(ax.xaxis)
    plot.legend(ax, loc="upper left")
    return figure


def table(data: dict[str, Any]) -> Table:
    """Printed and right values."""
    rows = []
    for (case, number), (printed, right) in zip(NUMBERS, data["values"], strict=True):
        off = 100.0 * (printed - right) / abs(right)
        rows.append([f"({number}) {case}", float(printed), float(right), f"{off:+.1f}"])
    return Table(["equation", "as printed [N]", "right [N]", "off by [%]"], rows)


def check(data: dict[str, Any]) -> list[Check]:
    """Every equation has both values, and the errors that the errata state are found."""
    values = {number: row for (_, number), row in zip(NUMBERS, data["values"], strict=True)}
    off = {number: float(v[0] / v[1] - 1.0) for number, v in values.items()}

    def listed(*numbers: str) -> str:
        return ", ".join(f"({n}) {100 * off[n]:+.1f} %" for n in numbers)

    wrong = {n for n, error in off.items() if abs(error) > 0.05}
    return [
        Check(
            "every equation of the table has a printed and a corrected value",
            bool(np.all(np.isfinite(data["values"]))),
            f"{len(NUMBERS)} entries, {len(values)} equations",
        ),
        Check(
            "every equation that is off by more than 5 % has an erratum",
            all(erratum(number) for number in wrong),
            f"{len(wrong)} of {len(values)}: {', '.join(n for n in values if n in wrong)}",
        ),
        Check(
            "viscous forces between flats are twice those of a film that keeps its volume",
            all(abs(off[n] - 1.0) < 0.01 for n in ("3.19", "3.29a", "3.34", "3.36")),
            listed("3.19", "3.29a", "3.34", "3.36"),
        ),
        Check(
            "Eq. (3.12) is 29 % too large, Eq. (3.27) is zero for a film of two gaps",
            abs(off["3.12"] - 0.286) < 0.002 and values["3.27"][0] == 0.0,
            listed("3.12", "3.27"),
        ),
        Check(
            "of 100 sliding asperities Eq. (3.59) is too small, by 45 times",
            abs(values["3.59"][1] / values["3.59"][0] / 44.8 - 1.0) < 0.01,
            f"{values['3.59'][1] / values['3.59'][0]:.1f} times",
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
