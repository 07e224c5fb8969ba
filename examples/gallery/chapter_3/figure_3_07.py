"""Fig. 3.7: meridians of menisci between separating flats, exact and in the circular approximation.

The source states that unlike contact angles break first and that unlike hydrophobic surfaces break
first of all. Both hold by its criterion, the closed neck of the arc; by the limit of stability the
second does not.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.capillary.arc.profile import arc_profile
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.profile import profile
from contactkit.gallery.chapter_3.films import PAIRS, angles, break_gaps, key, volume
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm

PAGE = Page(
    name="3.7",
    title="Menisci between separating flats",
    claim="A meniscus of 100 nm radius and 2 nm height between flats breaks earlier if the "
    "contact angles of the two bodies differ; the pair 180/120 degrees breaks before all "
    "others.",
    verdict="The first statement holds. The second rests on the closed neck of the arc: a bridge "
    "loses its stability at a third to a half of that gap, and by the exact limit 0/60 "
    "degrees break before 180/120.",
    grid="101 points along each meridian; exact volume of the arc at 2 nm",
)

GAP = 2 * nm
STEPS = (0.0, 0.25, 0.6, 1.0)  # of the way from the initial gap to the exact limit
COLORS = ("#440154", "#3b528b", "#21918c", "#d9a400")


def compute(draft: bool = False) -> dict[str, Any]:
    """Meridians at some gaps up to the exact limit, and the arc shortly before its neck closes."""
    count = 41 if draft else 101
    data: dict[str, Any] = {}
    for pair in PAIRS:
        liquid = volume(GAP, pair)
        limit, closed = break_gaps(liquid, pair)
        data[f"limits_{key(pair)}"] = np.array([limit, closed])
        gaps = [GAP + (limit * (1.0 - 1e-7) - GAP) * step for step in STEPS]
        curves = []
        for gap in gaps:
            exact = profile(bridge(gap, liquid, *angles(pair)), count)
            curves.append([*exact, *arc_profile(gap, liquid, *angles(pair), count=count)])
        far = arc_profile(closed * (1.0 - 1e-6), liquid, *angles(pair), count=count)
        data[f"gaps_{key(pair)}"] = np.array(gaps)
        data[f"curves_{key(pair)}"] = np.array(curves)
        data[f"last_arc_{key(pair)}"] = np.array(far)
    return data


def draw(data: dict[str, Any]) -> Figure:
    """One panel for each pair of angles, all to the same scale."""
    figure, panels = plot.figure(2, 2, size=(9.6, 9.2), sharex=True, sharey=True)
    for ax, pair in zip(panels.flat, PAIRS, strict=True):
        limit, closed = data[f"limits_{key(pair)}"]
        for gap, curve, color in zip(
            data[f"gaps_{key(pair)}"], data[f"curves_{key(pair)}"], COLORS, strict=True
        ):
            r, z, r_arc, z_arc = curve / nm
            label = f"{gap / nm:.3g} nm" + (", limit" if gap > 0.99 * limit else "")
            ax.plot(*_both(r, z), color=color, label=label)
            ax.plot(*_both(r_arc, z_arc), "--", color=color, lw=1.2)
        label = f"{closed / nm:.3g} nm, neck\nof the arc closed"
        ax.plot(*_both(*data[f"last_arc_{key(pair)}"] / nm), ":", color="0.3", label=label)
        ax.set(aspect="equal", xlim=(-105.0, 105.0), ylim=(0.0, 190.0))
        plot.legend(ax, fontsize=8, loc="upper left", title="gap: exact solid,\narc dashed")
    letters(list(panels.flat), [f"{p[0]}/{p[1]} deg" for p in PAIRS])
    for ax in panels[:, 0]:
        ax.set_ylabel("height [nm]")
    for ax in panels[1]:
        ax.set_xlabel("radius [nm]")
    return figure


def _both(r: Any, z: Any) -> tuple[Any, Any]:
    """Both sides of a meridian as one line."""
    return np.concatenate((r, [np.nan], -r)), np.concatenate((z, [np.nan], z))


def check(data: dict[str, Any]) -> list[Check]:
    """Order of the rupture gaps, and how far the two criteria are apart."""
    limits = {pair: data[f"limits_{key(pair)}"] / nm for pair in PAIRS}
    exact, closed = ({p: float(v[i]) for p, v in limits.items()} for i in (0, 1))

    def measured(of: dict[tuple[int, int], float]) -> str:
        return ", ".join(f"{p[0]}/{p[1]}: {v:.1f} nm" for p, v in of.items())

    unlike = [exact[0, 60] < exact[60, 60], exact[180, 120] < exact[120, 120]]
    arcs = [closed[0, 60] < closed[60, 60], closed[180, 120] < closed[120, 120]]
    scale = {p: limits[p][0] * nm / volume(GAP, p) ** (1.0 / 3.0) for p in PAIRS}
    off = [
        float(np.abs(c[0] - c[2]).max() / c[0].max())
        for p in PAIRS
        for c in data[f"curves_{key(p)}"][[1, 3]]
    ]
    early, late = max(off[::2]), max(off[1::2])
    return [
        Check(
            "unlike angles break earlier, exactly and by the neck of the arc",
            all(unlike + arcs),
            measured(exact),
        ),
        Check(
            "180/120 breaks first by the closed neck of the arc",
            min(closed, key=closed.__getitem__) == (180, 120),
            measured(closed),
        ),
        Check(
            "by the exact limit 0/60 breaks before 180/120, against the source",
            exact[0, 60] < exact[180, 120],
            ", ".join(f"{p[0]}/{p[1]}: {float(v):.3f} V^(1/3)" for p, v in scale.items()),
        ),
        Check(
            "the meridian of the arc is within 2 % at a quarter of the way, not at the limit",
            early < 0.02 < late,
            f"up to {100 * early:.1f} % of the radius, and {100 * late:.0f} %",
        ),
        agree(
            "gap at which the neck of the arc of 60/60 closes",
            data["limits_60_60"][1],
            bridges.closed_gap(bridges.arc_volume(100e-9, 2e-9, 60, 60), 60, 60),
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
