"""Fig. 3.15: a film divided into N equal menisci: both forces, the optimum, and where it ends."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_3.films import (
    GAMMA,
    HEIGHTS,
    SHADES,
    TIME,
    VISCOSITY,
    angles,
    heights_legend,
    key,
    ratio_text,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm, um

PAGE = Page(
    name="3.15",
    title="A film divided into N menisci",
    claim="Dividing 1 um2 of film raises the meniscus force, by the root of N if the menisci "
    "are small, and lowers the viscous force as 1/N; the sum has a minimum at a few "
    "hundred.",
    verdict="The few hundred hold for 2 nm; from 5 nm on the minimum is below a hundred. For 0/60 "
    "it exists only if the body of 60 degrees is pulled, against Fig. 3.9. Eq. (3.33) "
    "rises without end where the exact force levels off or falls again, and gives numbers "
    "for menisci that do not exist: at 6 nm at most 80 000 bridges of 60/60 degrees are "
    "stable, 14 000 of 0/60.",
    grid="41 numbers from 1 to 1e5",
    choices="1 um2, not the radius of 100 nm of the caption, which has 0.031 um2.",
)

AREA = 1 * um**2
PAIRS = ((60, 60), (0, 60))
PULLED = ((0.001, 60), (60, 0.001))  # 0 deg is 0.001 deg in the source; the first body is pulled
LAWS: tuple[str, str] = ("exact", "as-published")


def compute(draft: bool = False) -> dict[str, Any]:  # a draft is as large
    """Both forces over the number of menisci, the optimum and the maximum stable number."""
    counts = sorted({round(n) for n in np.geomspace(1.0, 1e5, 41).tolist()})
    data: dict[str, Any] = {"counts": np.array(counts)}
    for pair in PAIRS:
        numbers = []
        for i, height in enumerate(HEIGHTS.tolist()):
            for law in LAWS:
                found = _divided(height, pair, counts, law)
                rows = np.full((2, len(counts)), np.nan)
                rows[:, : len(found.n_menisci)] = found.meniscus_force, found.viscous_force
                data[f"{law}_{key(pair)}_{i}"] = rows
                numbers.append([found.best_count, found.max_stable_count])
        data[f"numbers_{key(pair)}"] = np.array(numbers).reshape(len(HEIGHTS), 2, 2)
    data["numbers_pulled"] = np.array(
        [
            [_divided(h, pair, counts[:1], "as-published").best_count for pair in PULLED]
            for h in HEIGHTS.tolist()
        ]
    )
    return data


def _divided(height: float, pair: tuple[float, float], counts: list[int], law: Any) -> Any:
    """Division of 1 um2 of film of a height."""
    lower, upper = angles(pair)
    water = ck.Liquid(name="water", surface_tension=GAMMA, viscosity=VISCOSITY)
    film = ck.Meniscus(
        liquid=water, volume=AREA * height, contact_angle_lower=lower, contact_angle_upper=upper
    )
    scene = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=height, final_gap=1e-3, time=TIME),
        effects=(ck.MeniscusForce(), ck.ViscousForce()),
    )
    return ck.divide_meniscus(scene, counts, law=law)


def draw(data: dict[str, Any]) -> Figure:
    """Meniscus forces of both pairs, viscous forces, sums with their minima."""
    figure, panels = plot.figure(2, 2, size=(9.6, 8.2), sharex=True)
    counts = data["counts"]
    for i, color in enumerate(SHADES):
        for law, style in zip(LAWS, ("-", ":"), strict=True):
            for ax, pair in zip(panels[0], PAIRS, strict=True):
                ax.plot(counts, data[f"{law}_{key(pair)}_{i}"][0] * 1e6, style, color=color)
            meniscus, viscous = data[f"{law}_60_60_{i}"] * 1e6
            panels[1, 0].plot(counts, viscous, style, color=color)
            panels[1, 1].plot(counts, meniscus + viscous, style, color=color)
            best = data["numbers_60_60"][i, LAWS.index(law), 0]
            least = np.interp(np.log(best), np.log(counts), meniscus + viscous)
            mark = {"mfc": color if law == "exact" else "none", "color": color, "ms": 5}
            panels[1, 1].plot(best, least, "o", **mark)
    for ax in panels.flat:
        ax.set(xscale="log", yscale="log")
    for ax in panels[0]:
        ax.set(ylabel="meniscus force [uN]", ylim=(8.0, 300.0))
        plot.plain_log(ax.yaxis)
    panels[1, 0].set(xlabel="number of menisci", ylabel="viscous force, mean [uN]")
    panels[1, 1].set(xlabel="number of menisci", ylabel="sum [uN]")
    plot.plain_log(panels[1, 1].yaxis)
    heights_legend(panels[0, 0], [("exact", "-"), ("printed (3.33), (3.34)", ":")], ncols=2)
    letters(list(panels.flat), ["60/60 deg", "0/60 deg", "60/60 deg", "60/60 deg, dots: minimum"])
    return figure


def table(data: dict[str, Any]) -> Table:
    """Optimal and maximum stable numbers."""
    rows = []
    for pair in PAIRS:
        for height, (exact, printed) in zip(HEIGHTS, data[f"numbers_{key(pair)}"], strict=True):
            rows.append([f"{pair[0]}/{pair[1]}", f"{height / nm:g}", *exact, printed[0]])
    for other, found in zip(PULLED, data["numbers_pulled"].T, strict=True):
        for height, printed in zip(HEIGHTS, found, strict=True):
            rows.append([f"{other[0]:g}/{other[1]:g}", f"{height / nm:g}", "-", "-", printed])
    head = ["angles [deg]", "h0 [nm]", "optimal N", "maximum stable N", "optimal N as printed"]
    return Table(head, rows)


def check(data: dict[str, Any]) -> list[Check]:
    """Powers of N, optima, ends of stability, and the error of Eq. (3.33)."""
    counts = data["counts"]
    like, unlike = (data[f"numbers_{key(pair)}"] for pair in PAIRS)
    pulled = data["numbers_pulled"]
    exact, viscous = data["exact_60_60_0"]
    printed = data["as-published_60_60_4"][0]
    right = data["exact_60_60_4"][0]
    slopes = np.diff(np.log(viscous)) / np.diff(np.log(counts))
    rise = float(exact[np.isfinite(exact)][-1] / exact[0])
    drop = data["exact_0_60_4"][0]
    drop = drop[np.isfinite(drop)]
    at = int(np.argmin(np.abs(counts - 10_000)))
    return [
        Check(
            "the exact meniscus force of 60/60 rises with N, the viscous one falls as 1/N",
            bool(np.all(np.diff(exact) > 0.0) and np.all(np.abs(slopes + 1.0) < 0.1)),
            f"2 nm: {rise:.2f} times at 1e5; exponent {ratio_text(slopes)}",
        ),
        Check(
            "the rise is far below the root of N of Eq. (3.35)",
            rise < 0.02 * 1e5**0.5,
            f"{rise:.2f} against {1e5**0.5:.0f} times",
        ),
        Check(
            "the optimum is a few hundred for 2 nm, below a hundred for 5 and 6 nm",
            200 < like[0, 0, 0] < 400 and bool(np.all(like[3:, 0, 0] < 100)),
            f"exact {', '.join(map(str, like[:, 0, 0]))}; printed "
            f"{', '.join(map(str, like[:, 1, 0]))}",
        ),
        Check(
            "at 6 nm the bridges cease to be stable before 1e5, against the range of the figure",
            bool(like[4, 0, 1] < 100_000 and unlike[4, 0, 1] < 20_000),
            f"60/60: {like[4, 0, 1]}, 0/60: {unlike[4, 0, 1]}",
        ),
        Check(
            "of 0/60 the exact force has a maximum and falls beyond",
            bool(drop.max() > 1.05 * drop[-1]),
            f"6 nm: {drop[-1] / drop.max():.2f} of the maximum at the last N",
        ),
        Check(
            "Eq. (3.33) is 40 % too large at 1e4 menisci of 6 nm",
            0.3 < printed[at] / right[at] - 1.0 < 0.5,
            f"{100 * (printed[at] / right[at] - 1.0):.0f} % at N = {counts[at]}",
        ),
        Check(
            "0/60 as printed: a few hundred if the body of 60 deg is pulled; if that of 0 deg is, "
            "as in Fig. 3.9, no optimum at all, or with the 0.001 deg of the source far above",
            bool(
                np.all(np.abs(pulled[:, 1] / like[:, 1, 0] - 1.0) < 0.02)
                and np.all(pulled[:, 0] > 50_000)
                and np.all(unlike[:, 1, 0] == unlike[:, 1, 1])
            ),
            f"2 to 6 nm: {', '.join(map(str, pulled[:, 1]))}; with 0.001 deg pulled "
            f"{', '.join(map(str, pulled[:, 0]))}; with 0 deg the last arc that exists, "
            f"{', '.join(map(str, unlike[:, 1, 0]))}",
        ),
        *_against_second(data),
    ]


def _against_second(data: dict[str, Any]) -> list[Check]:
    """Numbers of the page by the second method."""
    exact, viscous = data["exact_60_60_0"]
    return [
        agree(
            "forces of one meniscus of 60/60, 2 nm",
            [exact[0], viscous[0]],
            [
                bridges.bridge_force(1e-12 * 2e-9, 2e-9, 60, 60),
                bridges.disc_impulse(1e-12 * 2e-9, 2e-9) / 1e-7,
            ],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
