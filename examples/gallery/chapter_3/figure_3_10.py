"""Fig. 3.10: viscous force over the separation of flats: impulse over time, and the force."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.viscous import viscous_flat_3_19, viscous_number_3_43
from contactkit.gallery.chapter_3.films import (
    HEIGHTS,
    PAIRS,
    RADIUS,
    SHADES,
    TIME,
    VISCOSITY,
    break_gaps,
    heights_legend,
    key,
    ratio_text,
    separations,
    volume,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import disc_force, disc_impulse_conserved
from contactkit.plot import style as plot
from contactkit.plot.gallery import SERIES, Figure, letters
from contactkit.units import nm

PAGE = Page(
    name="3.10",
    title="Viscous force over the separation of flats",
    claim="The viscous force rises with the separation up to its value at the break; a lower "
    "film has the larger one; the contact angles matter little.",
    verdict="What rises is the impulse so far over the time of the whole separation. The force "
    "itself falls, at constant speed as the fifth power of the gap, from 50 to 109 times "
    "its mean. The printed film keeps its radius although it keeps its volume; drawn in, "
    "it delivers half of that impulse. The angles matter little, as 94 % of the impulse "
    "is reached at twice the initial gap.",
    grid="120 gaps from h0 to the limit of stability and the closed neck, four pairs of angles",
    choices="The film is a disc of the volume pi x^2 h0; constant speed in panel (c).",
)


_MEAN = "impulse so far over $t_s$ [nN]"
_FILMS = (2e-9, 3e-9, 4e-9, 5e-9, 6e-9)  # of the caption once more, for the second method


def compute(draft: bool = False) -> dict[str, Any]:
    """Impulse over time up to each gap, force at constant speed, and values at rupture."""
    data: dict[str, Any] = {}
    for i, height in enumerate(HEIGHTS.tolist()):
        limit, closed = break_gaps(volume(height, PAIRS[0]), PAIRS[0])
        gaps = separations(height, [closed], 40 if draft else 120)
        liquid = math.pi * RADIUS**2 * height
        speed = (limit - height) / TIME
        radius = np.sqrt(liquid / (math.pi * gaps))
        data[f"curve_{i}"] = np.array(
            [
                gaps,
                viscous_flat_3_19(RADIUS, height, gaps, TIME, VISCOSITY),
                disc_impulse_conserved(liquid, height, gaps, VISCOSITY) / TIME,
                disc_force(radius, gaps, speed, VISCOSITY),
            ]
        )
        data[f"limit_{i}"] = np.array([limit, closed])
    for pair in PAIRS:
        for i, height in enumerate(HEIGHTS.tolist()):
            data[f"{key(pair)}_{i}"] = _so_far(height, pair, 40 if draft else 120)
        at_break = []
        for height in HEIGHTS.tolist():
            limit, closed = break_gaps(volume(height, pair), pair)
            liquid = math.pi * RADIUS**2 * height
            right = disc_impulse_conserved(liquid, height, limit, VISCOSITY) / TIME
            at_break.append([viscous_flat_3_19(RADIUS, height, closed, TIME, VISCOSITY), right])
        data[f"break_{key(pair)}"] = np.array(at_break)
    return data


def _so_far(height: float, pair: tuple[int, int], n: int) -> Any:
    """Gaps up to the closed neck, impulse over time as printed and right; nan when broken."""
    limit, closed = break_gaps(volume(height, pair), pair)
    gaps = separations(height, sorted({limit, closed}), n)
    printed = viscous_flat_3_19(RADIUS, height, gaps, TIME, VISCOSITY)
    right = disc_impulse_conserved(math.pi * RADIUS**2 * height, height, gaps, VISCOSITY) / TIME
    return np.array([gaps, printed, np.where(gaps <= limit, right, np.nan)])


def draw(data: dict[str, Any]) -> tuple[Figure, Figure]:
    """Impulse and force of 60/60 degrees; the panels of the source."""
    return _overview(data), _pairs(data)


def _pairs(data: dict[str, Any]) -> Figure:
    """Impulse so far of all pairs, and its number, wetting ones on the left."""
    figure, panels = plot.figure(2, 2, size=(9.6, 8.4), sharex=True)
    for column, pairs in zip(panels.T, (PAIRS[:2], PAIRS[2:]), strict=True):
        for pair, sign, wide in zip(pairs, ("o", "s"), (1.0, 2.2), strict=True):
            for i, color in enumerate(SHADES):
                gaps, *both = data[f"{key(pair)}_{i}"]
                for values, style in zip(both, (":", "-"), strict=True):
                    number = viscous_number_3_43(values, RADIUS, HEIGHTS[i], TIME, VISCOSITY)
                    last = int(np.flatnonzero(np.isfinite(values))[-1])
                    for ax, shown in zip(column, (number, values / nm), strict=True):
                        x = (gaps - gaps[0]) / nm
                        ax.plot(x, shown, style, color=color, lw=0.7 * wide)
                        ax.plot(x[last], shown[last], sign, color=color, ms=5, mfc="none")
        for ax, label in zip(column, ("number of Eq. (3.43)", _MEAN), strict=True):
            ax.set(xscale="log", xlim=(0.02, 300.0), xlabel="separation [nm]", ylabel=label)
        column[0].set_ylim(0.0, 1.05)
        column[1].set(yscale="log", ylim=(0.3, 1000.0))
        for pair, sign in zip(pairs, ("o", "s"), strict=True):
            label = f"rupture, {pair[0]}/{pair[1]} deg"
            column[0].plot([], [], sign, color="0.2", mfc="none", label=label)
        plot.legend(column[0], fontsize=8, loc="upper left")
    styles = [("volume kept, exact rupture", "-"), ("printed, closed neck", ":")]
    heights_legend(panels[1, 0], styles, loc="lower right")
    names = ("wetting, dimensionless", "wetting", "non-wetting, dimensionless", "non-wetting")
    letters(list(panels.T.flat), list(names))
    return figure


def _overview(data: dict[str, Any]) -> Figure:
    """Impulse over time, the number of Eq. (3.43), the force itself, values at rupture."""
    figure, panels = plot.figure(2, 2, size=(9.6, 8.0))
    (mean, number), (force, at_break) = panels
    for i, color in enumerate(SHADES):
        gaps, printed, right, instant = data[f"curve_{i}"]
        delta, height = (gaps - gaps[0]) / nm, HEIGHTS[i]
        inside = gaps <= data[f"limit_{i}"][0]
        mean.plot(delta, printed / nm, ":", color=color)
        mean.plot(delta[inside], right[inside] / nm, color=color)
        for values, style in ((printed, ":"), (np.where(inside, right, np.nan), "-")):
            shown = viscous_number_3_43(values, RADIUS, height, TIME, VISCOSITY)
            number.plot(delta, shown, style, color=color)
        force.plot(delta[inside], instant[inside] / nm, color=color)
        total = printed[-1] / nm
        force.plot([0.02, 300.0], [total, total], ":", color=color, lw=1.0)
    for pair, (color, _, marker) in zip(PAIRS, SERIES, strict=False):
        printed, right = data[f"break_{key(pair)}"].T / nm
        label = f"{pair[0]}/{pair[1]} deg"
        at_break.plot(HEIGHTS / nm, right, marker=marker, color=color, label=label, mfc="none")
        at_break.plot(HEIGHTS / nm, printed, ":", marker=marker, color=color, mfc="none")
    for ax in (mean, number, force):
        ax.set(xscale="log", xlim=(0.02, 300.0), xlabel="separation [nm]")
    mean.set(yscale="log", ylabel=_MEAN, ylim=(0.3, 1000.0))
    number.set(ylabel="number of Eq. (3.43)", ylim=(0.0, 1.05))
    force.set(yscale="log", ylabel="viscous force [nN]", ylim=(1e-3, 3e5))
    at_break.set(yscale="log", ylabel="impulse over $t_s$ at rupture [nN]", xlabel="$h_0$ [nm]")
    at_break.plot([], [], "-", color="0.2", label="volume kept, exact rupture")
    at_break.plot([], [], ":", color="0.2", label="printed, closed neck")
    plot.plain_log(at_break.yaxis)
    plot.legend(at_break, fontsize=8)
    heights_legend(mean, [("volume kept", "-"), ("printed (3.19)", ":")], loc="lower right")
    styles = [("force, constant speed", "-"), ("printed value at rupture", ":")]
    for label, style in styles:
        force.plot([], [], style, color="0.2", label=label)
    plot.legend(force, fontsize=8, loc="lower left")
    titles = ["60/60 deg", "60/60 deg, dimensionless", "60/60 deg, the force itself", "rupture"]
    letters(list(panels.flat), titles)
    return figure


def check(data: dict[str, Any]) -> list[Check]:
    """Trends over the separation; factors between the printed and the corrected values."""
    curves = [data[f"curve_{i}"] for i in range(len(HEIGHTS))]
    limits = [data[f"limit_{i}"][0] for i in range(len(HEIGHTS))]
    rises = all(np.all(np.diff(c[1]) > 0.0) and np.all(np.diff(c[2]) > 0.0) for c in curves)
    slopes = [np.diff(np.log(c[3])) / np.diff(np.log(c[0])) for c in curves]
    twice = [float(np.interp(2.0 * c[0, 0], c[0], c[2]) / c[2, -1]) for c in curves]
    first = [
        float(c[3, 0] / np.interp(limit, c[0], c[2]))
        for c, limit in zip(curves, limits, strict=True)
    ]
    known = [4.0 * (limit - h) / h for limit, h in zip(limits, HEIGHTS.tolist(), strict=True)]
    breaks = {pair: data[f"break_{key(pair)}"] for pair in PAIRS}
    same = max(float(np.abs(b[:, 1] / breaks[60, 60][:, 1] - 1.0).max()) for b in breaks.values())
    printed = max(
        float(np.abs(b[:, 0] / breaks[60, 60][:, 0] - 1.0).max()) for b in breaks.values()
    )
    at = breaks[60, 60]
    return [
        Check("the impulse so far rises with the separation, by either law", rises, "5 heights"),
        Check(
            "the force itself falls with the fifth power of the gap",
            all(np.allclose(s, -5.0, atol=1e-6) for s in slopes),
            "exponent -5.000",
        ),
        Check(
            "at constant speed it starts at 4 (h_s - h0)/h0 times its mean over the separation",
            bool(np.allclose(first, known, rtol=1e-3)),
            f"{ratio_text(first)} times, largest for the lowest film",
        ),
        Check(
            "the printed value at rupture is twice that of a film that keeps its volume",
            all(1.95 < r < 2.0 for r in at[:, 0] / at[:, 1]),
            f"{ratio_text(at[:, 0] / at[:, 1])} times; 2 nm: {at[0, 0] / nm:.1f} against "
            f"{at[0, 1] / nm:.1f} nN",
        ),
        Check(
            "a lower film has the larger impulse, nearly as 1/h0^2",
            bool(np.all(np.diff(at[:, 1]) < 0.0)) and abs(at[0, 1] / at[4, 1] / 9.0 - 1.0) < 0.01,
            f"2 against 6 nm: {at[0, 1] / at[4, 1]:.2f} times",
        ),
        Check(
            "the contact angles change the value at rupture by less than 2 %",
            same < 0.02 and printed < 0.03,
            f"up to {100 * same:.2g} % (as printed {100 * printed:.2g} %)",
        ),
        Check(
            "94 % of the impulse is reached at twice the initial gap",
            all(abs(t - 15.0 / 16.0) < 0.01 for t in twice),
            f"{ratio_text(twice)} of the whole",
        ),
        _unlike(data),
        *_of_closed_necks(data),
        agree(
            "impulse over the time at rupture, 60/60",
            at[:, 1],
            [bridges.disc_impulse(math.pi * 1e-14 * h, h) / 1e-7 for h in _FILMS],
        ),
    ]


def _ends(data: dict[str, Any], row: int) -> Any:
    """Last gaps [m] of the curves of a law, (pairs, heights)."""
    curves = [[data[f"{key(pair)}_{i}"] for i in range(len(HEIGHTS))] for pair in PAIRS]
    return np.array([[c[0][np.isfinite(c[row])].max() for c in one] for one in curves])


def _unlike(data: dict[str, Any]) -> Check:
    """Unlike pairs end first, by either end."""
    rows = [_ends(data, row) for row in (1, 2)]
    return Check(
        "the film of unlike angles breaks before that of like ones, at every height, by the closed "
        "neck and by the exact limit",
        all(bool((one[1] < one[0]).all() and (one[3] < one[2]).all()) for one in rows),
        "; ".join(
            f"{name} 0/60 at {one[1, 0] / one[0, 0]:.2f} of the gap of 60/60, 180/120 at "
            f"{one[3, 0] / one[2, 0]:.2f} of 120/120"
            for name, one in zip(("closed neck:", "exact:"), rows, strict=True)
        ),
    )


def _of_closed_necks(data: dict[str, Any]) -> list[Check]:
    """Ends of the printed curves, and the values there, by the second method."""
    ours = _ends(data, 1)[:, [0, 4]]
    films = [(pair, h) for pair in PAIRS for h in (2e-9, 6e-9)]
    gaps = [bridges.closed_gap(bridges.arc_volume(1e-7, h, *pair), *pair) for pair, h in films]
    last = [[data[f"{key(pair)}_{i}"][1, -1] for i in (0, 4)] for pair in PAIRS]
    scale = 0.75 * math.pi * bridges.VISCOSITY * 1e-28 / bridges.TIME
    second = [scale * (h**-2 - gap**-2) for (_, h), gap in zip(films, gaps, strict=True)]
    return [
        agree("gap of the closed neck, four pairs, 2 and 6 nm", ours, gaps),
        agree("printed impulse over the time at the closed neck", last, second),
    ]


if __name__ == "__main__":
    run_page(__file__)
