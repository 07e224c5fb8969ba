"""Fig. 3.13: viscous force over the separation time, against the meniscus force."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.viscous import (
    viscous_flat_3_19,
    viscous_sphere_3_26,
    viscous_sphere_3_27,
)
from contactkit.gallery.chapter_3.films import (
    HEIGHTS,
    RADIUS,
    SHADES,
    VISCOSITY,
    break_gaps,
    flats,
    heights_legend,
    sphere,
    sphere_break_gaps,
    sphere_volume,
    volume,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import disc_impulse_conserved
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm, us

PAGE = Page(
    name="3.13",
    title="Viscous force over the separation time",
    claim="The viscous force falls steeply with the separation time and exceeds the meniscus "
    "force if that is short enough.",
    verdict="What is drawn is an impulse over the time: it falls as 1/t_s. It exceeds the "
    "meniscus force at the start below 7 to 23 ns between flats of 100 nm, below 1 to 8 "
    "ns under a sphere, not at the source's 0.1 us. Eq. (3.27), for rupture far away, is "
    "zero for 2 nm and 41 to 56 % too large above.",
    grid="closed forms",
    choices="60/60 degrees. For a touching sphere the impulse counts from a gap of 0.3 nm.",
)

PAIR, GAP = (60, 60), 1 * nm
CUTS = (0.3 * nm, 0.165 * nm)
TIMES = np.geomspace(1e-10, 1e-4, 61)


def compute(draft: bool = False) -> dict[str, Any]:
    """Impulses [N.s] up to rupture, and meniscus forces [N] at the start, for each height."""
    columns: dict[str, list[Any]] = {name: [] for name in ("flats", "touching", "apart")}
    for height in HEIGHTS.tolist():
        liquid = volume(height, PAIR)
        limit, closed = break_gaps(liquid, PAIR)
        found = flats(height, liquid, PAIR)
        columns["flats"].append(
            [
                disc_impulse_conserved(math.pi * RADIUS**2 * height, height, limit, VISCOSITY),
                viscous_flat_3_19(RADIUS, height, closed, 1.0, VISCOSITY),
                float(found.exact),
                float(found.printed),
            ]
        )
        for name, start in (("touching", 0.0), ("apart", GAP)):
            liquid = sphere_volume(start, height)
            limit, _ = sphere_break_gaps(liquid)
            forces, _ = sphere(start, liquid)
            cuts = CUTS if name == "touching" else (GAP,)
            rise = (height - start) * (height + start)
            right = [_lifted(cut, (rise + cut**2) ** 0.5, limit) for cut in cuts]
            other = (
                right[1]
                if name == "touching"
                else viscous_sphere_3_27(RADIUS, GAP, height, 1.0, VISCOSITY)
            )
            columns[name].append([right[0], other, float(forces.exact), float(forces.printed)])
    return {name: np.array(rows) for name, rows in columns.items()}


def _lifted(start: float, height: float, end: float) -> float:
    return float(viscous_sphere_3_26(RADIUS, start, height, end, 1.0, VISCOSITY))


def draw(data: dict[str, Any]) -> Figure:
    """Mean viscous force over the time; dashes: the meniscus force at the start."""
    figure, panels = plot.figure(1, 3, size=(11.0, 4.4), sharey=True)
    for ax, rows in zip(panels, data.values(), strict=True):
        for (right, other, meniscus, _), color in zip(rows, SHADES, strict=True):
            ax.plot(TIMES / us, right / TIMES / nm, color=color)
            if other > 0.0:
                ax.plot(TIMES / us, other / TIMES / nm, ":", color=color)
            ax.plot(TIMES[[0, -1]] / us, [meniscus / nm] * 2, "--", color=color, lw=0.9)
            ax.plot(right / meniscus / us, meniscus / nm, "o", color=color, ms=4)
        ax.axvline(0.1, color="0.5", lw=0.8)
        ax.set(xscale="log", yscale="log", xlabel="separation time [us]", ylim=(1e-3, 1e5))
    panels[0].set_ylabel("impulse over the time [nN]")
    heights_legend(
        panels[0],
        [("viscous", "-"), ("meniscus, at the start", "--"), ("printed (3.19)", ":")],
        loc="lower left",
        fontsize=7.5,
    )
    for ax, text in ((panels[1], "from 0.165 nm"), (panels[2], "printed limit (3.27)")):
        ax.plot([], [], ":", color="0.2", label=text)
        plot.legend(ax, fontsize=8)
    letters(list(panels), ["flats", "touching sphere, from 0.3 nm", "sphere 1 nm away"])
    return figure


def table(data: dict[str, Any]) -> Table:
    """Times at which the mean viscous force equals the meniscus force."""
    rows = [
        [
            f"{h / nm:g}",
            *(float(data[name][i, 0] / data[name][i, 2] * 1e9) for name in data),
            float(data["touching"][i, 1] / data["touching"][i, 0]),
        ]
        for i, h in enumerate(HEIGHTS)
    ]
    heads = [f"{name}: equal forces at t_s [ns]" for name in data]
    return Table(["height [nm]", *heads, "touching: from 0.165 over from 0.3 nm"], rows)


def check(data: dict[str, Any]) -> list[Check]:
    """Larger force at 0.1 us, error of Eq. (3.27), effect of the cut-off."""
    times = {name: rows[:, 0] / rows[:, 2] for name, rows in data.items()}
    printed = data["flats"][:, 1] / data["flats"][:, 3]
    apart = data["apart"]
    limit = apart[:, 1] / apart[:, 0] - 1.0
    cut = data["touching"][:, 1] / data["touching"][:, 0]

    def listed(values: Any, scale: float = 1e9) -> str:
        return ", ".join(f"{scale * v:.3g}" for v in values)

    return [
        Check(
            "at 0.1 us the meniscus force is the larger one, in all three cases",
            all(np.all(t < 0.1 * us) for t in times.values()),
            "; ".join(f"{n}: equal at {listed(t)} ns" for n, t in times.items()),
        ),
        Check(
            "between flats the printed pair of forces is equal at nearly twice the time",
            bool(np.all(np.abs(printed / times["flats"] / 1.95 - 1.0) < 0.05)),
            f"{listed(printed)} ns",
        ),
        Check(
            "Eq. (3.27) is zero for 2 nm and 41 to 56 % too large for 3 to 6 nm",
            abs(limit[0] + 1.0) < 1e-12 and bool(np.all((limit[1:] > 0.40) & (limit[1:] < 0.565))),
            f"{listed(limit, 100.0)} %",
        ),
        Check(
            "the cut-off of a touching sphere changes its impulse by a third and more",
            bool(cut.max() > 1.3),
            f"0.165 for 0.3 nm: {listed(cut, 1.0)} times",
        ),
        Check(
            "under a sphere a higher film has the larger impulse, between flats the smaller",
            bool(np.all(np.diff(apart[:, 0]) > 0.0) and np.all(np.diff(data["flats"][:, 0]) < 0.0)),
            f"sphere 1 nm away {listed(apart[:, 0], 1e16)} e-16 N.s",
        ),
        agree(
            "impulses between flats and under a sphere 1 nm away, force between flats, 2 nm",
            [data["flats"][0, 0], apart[0, 0], data["flats"][0, 2]],
            [
                bridges.disc_impulse(math.pi * 1e-14 * 2e-9, 2e-9),
                bridges.sphere_impulse(100e-9, 1e-9, 2e-9),
                bridges.film_force(100e-9, 2e-9, 60, 60),
            ],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
