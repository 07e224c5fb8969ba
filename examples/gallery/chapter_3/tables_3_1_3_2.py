"""Tables 3.1 and 3.2: arrows computed over all pairs of states, beside those of the source."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.capillary.many_menisci import max_stable_count
from contactkit.gallery.chapter_3.films import (
    GAMMA,
    HEIGHTS,
    RADIUS,
    TIME,
    VISCOSITY,
    angles,
    volume,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import disc_impulse_conserved
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import deg, nm

PAGE = Page(
    name="Tables 3.1, 3.2",
    title="Trends of the forces, computed",
    claim="Table 3.1: at one height the attraction of wetting films falls and the repulsion of "
    "non-wetting ones rises with the angles; a higher film has the smaller force. The "
    "viscous force falls with the height and hardly depends on the angles. Table 3.2: "
    "more menisci raise the meniscus force and lower the viscous one.",
    verdict="Every arrow of Table 3.1 is found, for the exact bridge, and every cell that it "
    "leaves open is of both signs. Table 3.2 holds for 60/60 degrees: of liquids that wet "
    "better the force falls again before the bridges break, and of non-wetting ones the "
    "repulsion falls from the start.",
    grid="5 heights from 2 to 6 nm, 5 x 5 pairs of angles, all pairs of states; 49 numbers N",
    choices="An arrow is set if every pair of states that changes as the cell states changes "
    "the force by more than 0.5 % in that direction; 'not much' if none does by 1 %; else "
    "'mixed'.",
)

WET = (10.0, 30.0, 50.0, 70.0, 85.0)
DRY = (95.0, 110.0, 130.0, 150.0, 170.0)
ROWS = ("fixed", "up", "down")  # of the height
COLUMNS = ("= up", "= down", "up, down", "down, up", "up, up", "down, down")  # of both angles
SOURCE = {  # arrows of Table 3.1 by the rows and columns above; n/a where the source has n/a
    "attraction": ("du--du", "d---d-", "-u---u"),
    "repulsion": ("ud--ud", "-d---d", "u---u-"),
    "viscous": ("nnnnnn", "dddddd", "uuuuuu"),
}
SIGNS = {"u": "rises", "d": "falls", "n": "not much", "-": "mixed"}
MARKS = {"u": "\u2191", "d": "\u2193", "n": "\u2248", "-": "\u2195"}
DIVIDED = ((60, 60), (45, 45), (0, 0), (0, 60), (120, 120), (180, 120))


def compute(draft: bool = False) -> dict[str, Any]:
    """Forces of all states, and forces of a divided film over the number of menisci."""
    data: dict[str, Any] = {}
    for name, degrees in (("attraction", WET), ("repulsion", DRY)):
        states = np.array(list(itertools.product(HEIGHTS.tolist(), degrees, degrees)))
        height, lower, upper = states.T
        liquid = np.array([volume(h, (a, b)) for h, a, b in states.tolist()])
        force = GAMMA * bridge(height, liquid, lower * deg, upper * deg).force
        ends = [
            float(stability_limit(v, a * deg, b * deg).gap)
            for v, (_, a, b) in zip(liquid.tolist(), states.tolist(), strict=True)
        ]
        disc = math.pi * RADIUS**2 * height
        viscous = disc_impulse_conserved(disc, height, np.array(ends), VISCOSITY) / TIME
        data |= {f"states_{name}": states, name: np.abs(force), f"viscous_{name}": viscous}
    for pair in DIVIDED:
        data[f"divided_{pair[0]}_{pair[1]}"] = _divided(pair, 13 if draft else 49)
    return data


def _divided(pair: tuple[int, int], n: int) -> Any:
    """Numbers of menisci up to the last stable one, exact force and impulse over time, of 1 um2."""
    height, liquid = 2 * nm, 1e-12 * 2 * nm
    lower, upper = angles(pair)
    limit = float(stability_limit(liquid, lower, upper).gap)
    last = max_stable_count(height, limit)
    counts = np.unique(np.round(np.geomspace(1.0, last, n)))
    force = counts * GAMMA * bridge(height, liquid / counts, lower, upper).force
    impulse = counts * disc_impulse_conserved(
        liquid / counts, height, limit * counts ** (-1.0 / 3.0), VISCOSITY
    )
    return np.array([counts, force, impulse / TIME])


def arrows(states: Any, force: Any) -> tuple[str, ...]:
    """Arrows of a table: a text of six signs for each of three rows."""
    first, second = (i.ravel() for i in np.indices((len(states), len(states))))
    steps = np.sign(states[second] - states[first])
    change = force[second] / force[first] - 1.0
    like = (np.abs(states[:, 1] - states[:, 2]) == 0.0)[[first, second]].all(0)
    wanted = (
        (1, 1, True),
        (-1, -1, True),
        (1, -1, False),
        (-1, 1, False),
        (1, 1, False),
        (-1, -1, False),
    )
    rows = []
    for step in (0, 1, -1):
        signs = ""
        for one, two, is_like in wanted:
            here = (steps == (step, one, two)).all(1) & (like if is_like else True)
            signs += _sign(change[here])
        rows.append(signs)
    return tuple(rows)


def _sign(change: Any) -> str:
    if np.all(np.abs(change) < 0.01):
        return "n"
    if np.all(change > 0.005):
        return "u"
    return "d" if np.all(change < -0.005) else "-"


def _found(data: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    """Arrows of the three parts of Table 3.1; the viscous ones over both kinds of films."""
    found = {
        name: arrows(data[f"states_{name}"], data[name]) for name in ("attraction", "repulsion")
    }
    viscous = [arrows(data[f"states_{n}"], data[f"viscous_{n}"]) for n in found]
    both = tuple(
        "".join(a if a == b else "-" for a, b in zip(*row, strict=True))
        for row in zip(*viscous, strict=True)
    )
    return {**found, "viscous": both}


def draw(data: dict[str, Any]) -> Figure:
    """Arrows of Table 3.1, ours and of the source, and the forces of Table 3.2 over N."""
    figure, panels = plot.figure(2, 2, size=(10.0, 7.6))
    colors = {"u": "#f4a582", "d": "#92c5de", "n": "#eeeeee", "-": "#ffffff"}
    for ax, (name, rows) in zip(panels.flat, _found(data).items(), strict=False):
        for i, row in enumerate(rows):
            for j, sign in enumerate(row):
                ax.add_patch(plot.Rectangle((j, i), 1, 1, fc=colors[sign], ec="0.6"))
                theirs = SOURCE[name][i][j]
                ax.text(j + 0.35, i + 0.5, MARKS[sign], ha="center", va="center", fontsize=15)
                text = "n/a" if theirs == "-" else MARKS[theirs]
                ax.text(
                    j + 0.74,
                    i + 0.5,
                    f"({text})",
                    ha="center",
                    va="center",
                    fontsize=9,
                    color="0.3",
                )
        ax.set(xlim=(0, 6), ylim=(3, 0))
        ax.set_xticks(
            np.arange(6) + 0.5,
            [
                "like\n\u2191",
                "like\n\u2193",
                *(
                    f"unlike\n{a}{b}"
                    for a, b in ("\u2191\u2193", "\u2193\u2191", "\u2191\u2191", "\u2193\u2193")
                ),
            ],
            fontsize=8,
        )
        ax.set_yticks(np.arange(3) + 0.5, ["h0 fixed", "h0 \u2191", "h0 \u2193"])
        ax.grid(visible=False)
        ax.tick_params(length=0)
    last = panels[1, 1]
    for pair, color in zip(
        DIVIDED, ("#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"), strict=True
    ):
        counts, force, _ = data[f"divided_{pair[0]}_{pair[1]}"]
        last.plot(counts, force / force[0], color=color, label=f"{pair[0]}/{pair[1]} deg")
        last.plot(counts[-1], force[-1] / force[0], "x", color=color)
    last.set(
        xscale="log",
        xlabel="number of menisci N",
        ylabel="meniscus force over that of one",
    )
    last.axhline(0.0, color="0.5", lw=0.6)
    plot.legend(last, fontsize=8)
    letters(
        list(panels.flat),
        [
            "attraction: computed (source)",
            "repulsion: computed (source)",
            "viscous: computed (source)",
            "Table 3.2: 1 um2 at 2 nm, cross: last stable N",
        ],
    )
    return figure


def table(data: dict[str, Any]) -> Table:
    """All arrows of Table 3.1, computed and of the source."""
    rows = []
    for name, found in _found(data).items():
        for height, ours, theirs in zip(ROWS, found, SOURCE[name], strict=True):
            for column, one, other in zip(COLUMNS, ours, theirs, strict=True):
                stated = "n/a" if other == "-" else SIGNS[other]
                rows.append([name, height, column, SIGNS[one], stated])
    return Table(["force", "height", "angles", "computed", "source"], rows)


def check(data: dict[str, Any]) -> list[Check]:
    """Arrows one by one, and Table 3.2 for each pair of angles."""
    found = _found(data)
    cells = [(name, i, j) for name in found for i in range(3) for j in range(6)]
    stated = [c for c in cells if SOURCE[c[0]][c[1]][c[2]] != "-"]
    open_ = [c for c in cells if SOURCE[c[0]][c[1]][c[2]] == "-"]
    wrong = [c for c in stated if found[c[0]][c[1]][c[2]] != SOURCE[c[0]][c[1]][c[2]]]
    left = [c for c in open_ if found[c[0]][c[1]][c[2]] != "-"]
    ends = {p: data[f"divided_{p[0]}_{p[1]}"] for p in DIVIDED}
    tops = {p: float(d[1].max() / d[1, 0]) for p, d in ends.items()}
    lower = {p: float(np.interp(1e3, d[0], d[0] * d[2]) / d[2, 0]) for p, d in ends.items()}
    last = {p: float(d[1, -1] / d[1, 0]) for p, d in ends.items()}

    def listed(of: dict[tuple[int, int], float]) -> str:
        return ", ".join(f"{p[0]}/{p[1]}: {v:.2f}" for p, v in of.items())

    return [
        Check(
            "Table 3.1: every arrow of the source is found",
            not wrong,
            f"{len(stated)} arrows, other: {wrong or 'none'}",
        ),
        Check(
            "Table 3.1: every cell left open is of both signs",
            not left,
            f"{len(open_)} cells, other: {left or 'none'}",
        ),
        Check(
            "Table 3.2: more menisci raise the attraction of 60/60 up to the last stable number",
            bool(np.all(np.diff(ends[60, 60][1]) > 0.0)),
            f"at the last: {listed(last)} times that of one",
        ),
        Check(
            "of 0/0 and 0/60 it falls again before the bridges break",
            all(tops[p] > 1.1 * last[p] for p in ((0, 0), (0, 60))),
            f"greatest: {listed(tops)} times",
        ),
        Check(
            "the repulsion of non-wetting films falls with N; that of 120/120 turns to attraction",
            all(np.all(np.diff(ends[p][1]) > 0.0) for p in DIVIDED[4:]) and last[120, 120] < 0.0,
            f"120/120: {last[120, 120]:.2f}, 180/120: {last[180, 120]:.2g} of one",
        ),
        Check(
            "Table 3.2: more menisci lower the viscous impulse, for all angles",
            all(bool(np.all(np.diff(d[2]) < 0.0)) for d in ends.values()),
            f"at 1000: {listed(lower)} of one over N",
        ),
        *_against_second(data),
    ]


def _against_second(data: dict[str, Any]) -> list[Check]:
    """Numbers of the page by the second method."""
    ends = {p: data[f"divided_{p[0]}_{p[1]}"] for p in DIVIDED}
    return [
        agree(
            "force and impulse over the time of one meniscus of 60/60, 1 um2 at 2 nm",
            ends[60, 60][1:, 0],
            [
                bridges.bridge_force(1e-12 * 2e-9, 2e-9, 60, 60),
                bridges.disc_impulse(1e-12 * 2e-9, 2e-9) / 1e-7,
            ],
        ),
        agree(
            "force and impulse over the time of 10/10 deg, circle of 100 nm at 2 nm",
            [data["attraction"][0], data["viscous_attraction"][0]],
            [
                bridges.film_force(100e-9, 2e-9, 10, 10),
                bridges.disc_impulse(math.pi * 1e-14 * 2e-9, 2e-9) / 1e-7,
            ],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
