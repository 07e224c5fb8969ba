"""Section 3.2.3: the break distances and viscous forces that the source validates itself with."""

from __future__ import annotations

from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.viscous import viscous_sphere_3_26
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.gallery.chapter_3.films import (
    HEIGHTS,
    RADIUS,
    SHADES,
    TIME,
    VISCOSITY,
    angles,
    heights_legend,
    ratio_text,
    sphere_break_gaps,
    sphere_volume,
)
from contactkit.numerics.roots import bracketed_root
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm

PAGE = Page(
    name="Section 3.2.3",
    title="Break distances and viscous forces of a sphere",
    claim="Break distances of 3.9 to 9.9 x 10^4 nm for heights of 2 to 6 nm give by Eq. (3.26) "
    "the viscous forces of the numerical model, which validates it.",
    verdict="The five forces follow to all digits, but from any break distance above 12 to 38 nm. "
    "The distances must be 39 to 99 nm, a unit misprinted. The neck of the arc closes at "
    "45 to 104 nm; the printed ones are those of a neck of 0.5 to 0.7 nm. The exact "
    "bridge breaks at 13 to 28 nm.",
    grid="100 gaps for the necks",
    choices="Gap of 1 nm, 60/60 degrees, volume of the revolved arc under the paraboloid.",
)

START = 1 * nm
PRINTED_BREAKS = np.array([39.0, 58.0, 73.0, 87.0, 99.0]) * nm
PRINTED_FORCES = np.array([0.1976, 0.4826, 0.7487, 0.9861, 1.1974]) * nm  # nN


def compute(draft: bool = False) -> dict[str, Any]:
    """Necks over the gap, the three break distances, and the force over the end of Eq. (3.26)."""
    n = 40 if draft else 100
    rows, necks, forces = [], [], []
    for height, printed, force in zip(
        HEIGHTS.tolist(), PRINTED_BREAKS.tolist(), PRINTED_FORCES.tolist(), strict=True
    ):
        liquid = sphere_volume(START, height)
        limit, closed = sphere_break_gaps(liquid)
        gaps = np.geomspace(START, closed * (1.0 - 1e-9), n)
        necks.append([gaps, _neck(gaps, liquid)])
        ends = np.geomspace(1.01 * START, 1e5 * nm, n)
        forces.append([ends, [_force(height, end) for end in ends.tolist()]])
        enough = _enough(height, force)
        at_printed = float(_neck(np.array([printed]), liquid)[0])
        rows.append([liquid, limit, closed, printed, at_printed, _force(height, printed), enough])
    return {"rows": np.array(rows), "necks": np.array(necks), "forces": np.array(forces)}


def _enough(height: float, force: float) -> float:
    """Gap [m] from which on Eq. (3.26) rounds to a printed force."""
    least = force - 0.5e-4 * nm  # half a unit of the last digit
    return bracketed_root(lambda end: _force(height, end) - least, 2 * nm, 90 * nm, 1e-9 * nm)


def _neck(gaps: Any, liquid: float) -> Any:
    """Neck radius [m] of the arc."""
    body = (*angles((60, 60)), 0.0, 1.0 / RADIUS)
    return arc_sphere.solve(gaps, liquid, *body, profile="parabola").neck


def _force(height: float, end: float) -> float:
    """Eq. (3.26) [N] up to a gap."""
    return float(viscous_sphere_3_26(RADIUS, START, height, end, TIME, VISCOSITY))


def draw(data: dict[str, Any]) -> Figure:
    """Necks with the three criteria; forces over the end of the integral."""
    figure, (left, right) = plot.figure(1, 2, size=(9.6, 4.8))
    for i, color in enumerate(SHADES):
        _, limit, _, printed, at_printed, force, enough = data["rows"][i] / nm
        gaps, neck = data["necks"][i] / nm
        left.plot(gaps, neck, color=color)
        left.plot(limit, np.interp(limit, gaps, neck), "o", color=color)
        left.plot(printed, at_printed, "x", color=color, ms=7)
        right.plot(*data["forces"][i] / nm, color=color)
        right.plot(printed, force, "x", color=color, ms=7)
        right.plot(enough, force, "|", color=color, ms=14)
    left.set(xscale="log", yscale="log", xlabel="gap [nm]", ylabel="neck radius of the arc [nm]")
    left.set(ylim=(0.1, 60.0))
    right.set(xscale="log", xlabel="gap $D_s$ at rupture [nm]", ylabel="Eq. (3.26) [nN]")
    heights_legend(left, [("exact limit", "o"), ("printed distance", "x")], symbol="$s_0$")
    for label, sign in (("printed distance", "x"), ("enough for the printed digits", "|")):
        right.plot([], [], sign, color="0.2", ms=8, label=label)
    plot.legend(right, fontsize=8, loc="center right")
    letters(
        [left, right], ["necks and three break distances", "the force does not tell them apart"]
    )
    return figure


def table(data: dict[str, Any]) -> Table:
    """Break distances and forces."""
    scale = np.array([nm**3, nm, nm, nm, nm, nm, nm])
    rows = [
        [f"{h / nm:g}", *map(float, row / scale)]
        for h, row in zip(HEIGHTS, data["rows"], strict=True)
    ]
    head = ["s0 [nm]", "volume [nm3]", "exact limit [nm]", "neck closed [nm]", "printed [nm]"]
    return Table([*head, "neck at the printed [nm]", "Eq. (3.26) [nN]", "enough D_s [nm]"], rows)


def check(data: dict[str, Any]) -> list[Check]:
    """Printed forces, what they need, and the three break distances."""
    _, limit, closed, printed, neck, force, enough = data["rows"].T / nm
    return [
        Check(
            "the printed viscous forces follow to all digits",
            bool(np.allclose(force, PRINTED_FORCES / nm, atol=0.6e-4)),
            f"{', '.join(f'{f:.4f}' for f in force)} nN",
        ),
        Check(
            "they follow from any break distance above less than half of the printed one",
            bool(np.all(enough < 0.5 * printed)),
            f"{', '.join(f'{e:.0f}' for e in enough)} nm are enough",
        ),
        Check(
            "the neck of the arc closes at 45.2 to 104.1 nm",
            bool(np.allclose(closed, [45.204, 63.077, 78.090, 91.605, 104.123], atol=2e-3)),
            f"{', '.join(f'{c:.2f}' for c in closed)} nm",
        ),
        Check(
            "the printed distances are shorter, with a neck of 0.5 to 0.7 nm left",
            bool(np.all((neck > 0.5) & (neck < 0.7))),
            f"{', '.join(f'{n:.3f}' for n in neck)} nm",
        ),
        Check(
            "the exact bridge breaks at less than a third of them",
            bool(np.all(limit < printed / 3.0)),
            f"{', '.join(f'{x:.2f}' for x in limit)} nm, {ratio_text(printed / limit)} times",
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
