"""Figs. 2.10 and 2.11: pressure, area and displacement over the load, structures I to V."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_over_first, draw_panel, labelled
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.10-2.11",
    title="Pressure, area and displacement over the load, layers of 10 rms heights",
    claim="Compliant layers (II) lower the maximum pressure and enlarge area and displacement, "
    "stiff ones (III) the reverse; interlayers (IV, V) do the same to a lesser degree, "
    "and the area of IV is roughly that of I. Plastic contact comes first with stiff "
    "layers; beyond it the displacement stays.",
    verdict="The orderings hold on every surface. Two statements do not: the area of IV is larger "
    "by a tenth and more, and displacement goes on growing beyond the first yield, as "
    "other spots carry the load.",
    choices="Loads up to 1e-2 E3, so that all surfaces flow. The area at one load is that of a "
    "few spots and moves by a pixel; only the area added over the loads is stated.",
    grid=rough.WIDE,
    seeds=rough.SEEDS,
)
LOADS = (4e-6, 1e-5, 4e-5, 1e-4, 4e-4, 1e-3, 4e-3, 1e-2)
COLUMNS = ("max_pressure", "contact_fraction", "plastic_fraction", "max_displacement")
NAMES = list(rough.STRUCTURES)


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Columns (surfaces, structures, seeds, loads)."""
    sampling, hard = rough.wide(draft), ck.HardnessLimit()
    found = []
    for surface in rough.SURFACES:
        stacks = [
            rough.body(ratios, (1.0, 1.0), 10.0 * surface.rms)
            for ratios in rough.STRUCTURES.values()
        ]
        cases = [(surface, stack) for stack in stacks]
        found.append(rough.curves(cases, sampling, LOADS, COLUMNS, hard))
    alone = [pressed(sampling, Case(4e-6, name)) for name in NAMES]
    full = pressed(sampling, Case(1e-3, surface=1, thickness=100e-9))
    second = {
        "second": np.array([[c.max_pressure, c.fraction, c.max_displacement] for c in alone]).T,
        "second_plastic": np.array([full.max_pressure, full.plastic_fraction()]),
    }
    return {name: np.array([one[name] for one in found]) for name in COLUMNS} | second


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """Three numbers for three surfaces; the displacement."""
    figure, axes = plot.figure(5, 3, size=(8.6, 11.0), sharex=True)
    labels = labelled(rough.MEANING)
    for row, name in zip(axes[[0, 2, 4]], COLUMNS[:3], strict=True):
        for ax, values in zip(row, data[name], strict=True):
            draw_panel(ax, LOADS, name, values, labels)
    for row, name in zip(axes[[1, 3]], COLUMNS[:2], strict=True):
        for ax, values in zip(row, data[name], strict=True):
            draw_over_first(ax, LOADS, values, labels)
            ax.set_ylabel(f"{'pressure' if name == COLUMNS[0] else 'area'} over that of I")
    for row in axes:
        for ax in row[1:]:
            ax.set_ylabel("")
        for ax in row if row is not axes[-1] else ():
            ax.set_xlabel("")
    for ax, surface in zip(axes[0], rough.SURFACES, strict=True):
        ax.set_title(str(surface), fontsize=9, loc="left")
    plot.shared(figure, axes[0, 0])
    second, (left, right) = plot.figure(1, 2, size=(8.2, 3.8))
    moved = data["max_displacement"][0]
    draw_panel(left, LOADS, "max_displacement", moved, labels)
    draw_over_first(right, LOADS, moved, labels)
    left.set_title(str(rough.SURFACES[0]), fontsize=9, loc="left")
    plot.shared(second, left)
    return figure, second


def _order(values: np.ndarray, names: str, loads: slice) -> tuple[bool, str]:
    """Whether structures stand in an order, from the least, on each surface; and the medians."""
    rows = [values[:, NAMES.index(name)][..., loads] for name in names.split()]
    over = [rough.spread(row / values[:, 0][..., loads]) for row in rows]
    holds = all(bool((a < b).all()) for a, b in pairwise(rows))
    return holds, ", ".join(f"{n} {o}" for n, o in zip(names.split(), over, strict=True))


def check(data: Data) -> list[Check]:
    """Orderings at the printed loads on the surface that is elastic there; beyond yield."""
    printed = slice(0, 3)
    peak, area, moved = (
        data[n][:1] for n in ("max_pressure", "contact_fraction", "max_displacement")
    )
    checks = [
        Check(
            f"{what} at the printed loads, on each surface: {' < '.join(o.split())}",
            *_order(v, o, printed),
        )
        for what, v, o in (
            ("maximum pressure", peak, "II IV I V III"),
            ("maximum displacement", moved, "III V I IV II"),
        )
    ]
    total = area[..., :4].sum(axis=-1, keepdims=True)  # of few spots at the lowest load
    checks.append(
        Check(
            "contact area, added over the loads up to 1e-4: III < V < I < IV < II",
            *_order(total, "III V I IV II", slice(0, 1)),
        )
    )
    iv = total[0, NAMES.index("IV")] / total[0, 0]
    checks.append(
        Check(
            "the area of IV is larger than that of I by more than 3 % (the source: roughly equal)",
            rough.all_above(iv, 1.03),
            rough.spread(iv),
        )
    )
    plastic = data["plastic_fraction"]
    ii, one, iii = (plastic[1:, NAMES.index(n)].sum(axis=-1) for n in ("II", "I", "III"))
    checks.append(
        Check(
            "plastic area, added over the loads: II < I < III on both rougher surfaces",
            bool((ii < one).all() and (one < iii).all()),
            f"III over I {rough.spread(iii / one)}",
        )
    )
    first = data["max_pressure"][:, :, :, 2] / rough.HARDNESS
    checks.append(
        Check(
            "at 4e-5 E3 the surface of 10 nm is at the hardness in every structure, the first in "
            "none",
            rough.all_above(first[1], 0.999) and rough.all_below(first[0], 0.9),
            f"maximum pressure over hardness: {rough.spread(first[1])}, {rough.spread(first[0])}",
        )
    )
    grows = data["max_displacement"][1][..., -1] / data["max_displacement"][1][..., 2]
    checks.append(
        Check(
            "beyond the first yield the displacement goes on growing (the source: it stays)",
            rough.all_above(grows, 1.5),
            f"surface of 10 nm, from 4e-5 to 1e-2 E3: {rough.spread(grows)} times",
        )
    )
    return [*checks, *_against_second(data)]


def _against_second(data: Data) -> list[Check]:
    """Numbers of the page by the second method."""
    ours = [data[n][0, :, 0, 0] for n in ("max_pressure", "contact_fraction", "max_displacement")]
    flows = [data[n][1, 0, 0, 5] for n in ("max_pressure", "plastic_fraction")]
    return [
        agree("pressure, area, displacement of I to V at 4e-6 E3", ours, data["second"]),
        agree(
            "hardness and plastic area of I at 1e-3 E3, 10 nm", flows, data["second_plastic"], 0.02
        ),
    ]


def table(data: Data) -> Table:
    """Medians of the first surface at the printed loads."""
    rows = [
        (name, LOADS[k], *(float(np.median(data[c][0, i, :, k])) * f for c, f in _UNITS))
        for i, name in enumerate(NAMES)
        for k in range(3)
    ]
    head = ("structure", "p/E3", "max. pressure/E3", "area [%]", "max. displacement [nm]")
    return Table(head, rows)


_UNITS = (("max_pressure", 1e-11), ("contact_fraction", 100.0), ("max_displacement", 1e9))


if __name__ == "__main__":
    run_page(__file__)
