"""Fig. 3.16: forces over the number of asperities, and of menisci of a divided film."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.common import meniscus_divided_3_33
from contactkit.as_published.printed.viscous import viscous_sphere_3_26
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.gallery.chapter_3.films import (
    GAMMA,
    PAIRS,
    TIME,
    VISCOSITY,
    angles,
    break_gaps,
    flats,
    key,
    sphere,
    sphere_break_gaps,
    sphere_volume,
    volume,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import disc_impulse_conserved
from contactkit.plot import style as plot
from contactkit.plot.gallery import SERIES, Figure, letters
from contactkit.units import nm, um

PAGE = Page(
    name="3.16",
    title="Many asperities, many menisci",
    claim="On 100 x 100 um2 the force of N asperities rises with N, and their viscous force "
    "hardly changes. Of a smooth film of N menisci the attraction rises slightly, the "
    "repulsion falls slightly, the viscous force falls fast. A few asperities have far "
    "smaller forces than a smooth film.",
    verdict="It holds. The force of wetting asperities goes nearly with the root of N; the "
    "repulsion grows faster. Their viscous impulse goes with N^0, that of the film with "
    "1/N. The drop at 180/120 degrees that the source notes does not appear.",
    grid="17 numbers n x n from 1 to 1e4",
    choices="Height 100 nm; asperities 10 nm away at the start (source: not stated), the film "
    "fills a circle of 50 um radius.",
)

SIDE, HEIGHT, START = 100 * um, 100 * nm, 10 * nm
LARGE = 0.5 * SIDE


def compute(draft: bool = False) -> dict[str, Any]:
    """Forces of all asperities and of all menisci together, exact and as printed."""
    roots = sorted({round(n) for n in np.geomspace(1.0, 100.0, 7 if draft else 17).tolist()})
    numbers = np.array(roots) ** 2
    data: dict[str, Any] = {"numbers": numbers}
    for pair in PAIRS:
        rough = np.array([_asperities(n, pair) for n in roots])
        smooth = np.array([_menisci(n, pair) for n in roots])
        data |= {f"rough_{key(pair)}": rough.T, f"smooth_{key(pair)}": smooth.T}
    return data


def _asperities(n: int, pair: tuple[int, int]) -> list[float]:
    """Forces [N] of n x n asperities: exact, printed (3.12), impulse over time, printed."""
    radius = LARGE / n
    liquid = sphere_volume(START, HEIGHT, pair, radius)
    forces, _ = sphere(START, liquid, pair, radius)
    limit, _ = sphere_break_gaps(liquid, pair, radius)
    closed = arc_sphere.zero_neck_gap(liquid, *angles(pair), 0.0, 1.0 / radius)
    viscous = [
        float(viscous_sphere_3_26(radius, START, HEIGHT, end, TIME, VISCOSITY))
        for end in (limit, closed)
    ]
    return [n * n * one for one in (float(forces.exact), float(forces.printed), *viscous)]


def _menisci(n: int, pair: tuple[int, int]) -> list[float]:
    """Forces [N] of n x n menisci of a film: exact, printed (3.33), impulse over time, printed."""
    liquid = volume(HEIGHT, pair, LARGE) / (n * n)
    exact = n * n * float(flats(HEIGHT, liquid, pair).exact)
    printed = meniscus_divided_3_33(LARGE, HEIGHT, GAMMA, *angles(pair), n * n)
    disc = math.pi * (LARGE / n) ** 2 * HEIGHT
    limit, closed = break_gaps(liquid, pair)
    kept = n * n * disc_impulse_conserved(disc, HEIGHT, limit, VISCOSITY) / TIME
    whole = 0.75 * math.pi * VISCOSITY * LARGE**4 / (n * n * TIME)
    return [exact, float(printed), float(kept), whole * (HEIGHT**-2 - closed**-2)]


UNITS = {  # of the panels: kind, row
    ("rough", 0): (1e-3, "mN"),
    ("smooth", 0): (1e-3, "mN"),
    ("rough", 1): (1e-6, "uN"),
    ("smooth", 1): (1e-3, "mN"),
}


def draw(data: dict[str, Any]) -> Figure:
    """Meniscus and viscous forces of asperities and of a divided film."""
    figure, panels = plot.figure(2, 2, size=(9.6, 8.4), sharex=True)
    for pair, (color, _, sign) in zip(PAIRS, SERIES, strict=False):
        for column, kind in enumerate(("rough", "smooth")):
            found = np.abs(data[f"{kind}_{key(pair)}"])
            for row in (0, 1):
                ax, look = panels[row, column], {"color": color, "marker": sign, "ms": 3.5}
                exact, printed = found[2 * row : 2 * row + 2] / UNITS[kind, row][0]
                label = f"{pair[0]}/{pair[1]} deg" + (", repels" if pair[0] > 90 else "")
                ax.plot(data["numbers"], exact, **look, label=label)
                ax.plot(data["numbers"], printed, ":", color=color)
    for ax in panels.flat:
        ax.set(xscale="log", yscale="log")
    for ax, text in zip(panels[1], ("asperities", "menisci"), strict=True):
        ax.set_xlabel(f"number of {text}")
    plot.plain_log(panels[0, 1].yaxis)
    for (kind, row), (_, unit) in UNITS.items():
        what = "viscous impulse over $t_s$" if row else "meniscus force, absolute"
        panels[row, ("rough", "smooth").index(kind)].set_ylabel(f"{what} [{unit}]")
    panels[0, 0].plot([], [], ":", color="0.2", label="as printed")
    plot.legend(panels[0, 0], fontsize=8)
    panels[1, 0].set_ylim(*_around(panels[1, 0]))
    plot.plain_log(panels[1, 0].yaxis)
    letters(
        list(panels.flat),
        ["asperities, meniscus", "smooth, meniscus", "asperities, viscous", "smooth, viscous"],
    )
    return figure


def _around(ax: Any) -> tuple[float, float]:
    """Limits of a logarithmic axis, at least a decade."""
    low, high = ax.get_ylim()
    middle = (low * high) ** 0.5
    return min(low, middle / 4.0), max(high, middle * 4.0)


def check(data: dict[str, Any]) -> list[Check]:
    """Powers of N, trends, and asperities against a smooth film."""
    numbers = data["numbers"]
    rough = {pair: data[f"rough_{key(pair)}"] for pair in PAIRS}
    smooth = {pair: data[f"smooth_{key(pair)}"] for pair in PAIRS}
    wet, dry = PAIRS[:2], PAIRS[2:]
    rises = {p: float(r[0, -1] / r[0, 0]) for p, r in rough.items()}
    viscous = {p: float(r[2, -1] / r[2, 0]) for p, r in rough.items()}
    film = {p: float(s[0, -1] / s[0, 0]) for p, s in smooth.items()}
    slope = np.diff(np.log(smooth[60, 60][2])) / np.diff(np.log(numbers))

    def listed(of: dict[tuple[int, int], float]) -> str:
        return ", ".join(f"{p[0]}/{p[1]}: {v:.3g}" for p, v in of.items())

    at = int(np.argmin(np.abs(numbers - 1000)))
    roots = {p: float(rough[p][0, at] / rough[p][0, 0] / numbers[at] ** 0.5) for p in wet}
    few = {p: float(abs(smooth[p][0, 0] / rough[p][0, 0])) for p in PAIRS}
    drag = {p: float(smooth[p][2, 0] / rough[p][2, 0]) for p in PAIRS}
    return [
        Check(
            "asperities: the force grows with N, attraction and repulsion",
            all(np.all(np.diff(np.abs(r[0])) > 0.0) for r in rough.values()),
            f"from 1 to 1e4: {listed(rises)} times",
        ),
        Check(
            "of wetting films it follows the root of N up to 1e3",
            all(0.8 < one < 1.1 for one in roots.values()),
            f"{listed(roots)} of it at N = {numbers[at]}",
        ),
        Check(
            "asperities: the viscous impulse hardly depends on N",
            all(0.85 < v < 1.02 for v in viscous.values()),
            f"{listed(viscous)} times",
        ),
        Check(
            "smooth: attraction rises slightly, repulsion falls slightly",
            all(1.0 < film[p] < 1.5 for p in wet) and all(0.5 < film[p] < 1.0 for p in dry),
            f"{listed(film)} times",
        ),
        Check(
            "smooth: the viscous impulse falls as 1/N",
            bool(np.allclose(slope, -1.0, atol=0.01)),
            f"exponent {slope.min():.4f} to {slope.max():.4f}",
        ),
        Check(
            "one asperity has far smaller forces than a smooth film",
            min(few.values()) > 50.0 and min(drag.values()) > 1e4,
            f"meniscus {listed(few)} times less, viscous {min(drag.values()):.2g} times and more",
        ),
        agree(
            "one meniscus of 60/60: force and impulse over the time; impulse of one asperity",
            [smooth[60, 60][0, 0], smooth[60, 60][2, 0], rough[60, 60][2, 0]],
            [
                bridges.film_force(50e-6, 100e-9, 60, 60),
                bridges.disc_impulse(math.pi * 2.5e-9 * 100e-9, 100e-9) / 1e-7,
                bridges.sphere_impulse(50e-6, 10e-9, 100e-9) / 1e-7,
            ],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
