"""Fig. 3.12: meniscus and viscous forces between flats over the contact angles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.common import meniscus_flat_3_11
from contactkit.as_published.printed.viscous import viscous_flat_3_19
from contactkit.capillary.exact.bridge import bridge
from contactkit.gallery.chapter_3.films import (
    GAMMA,
    HEIGHTS,
    RADIUS,
    SHADES,
    TIME,
    VISCOSITY,
    break_gaps,
    flats,
    heights_legend,
    ratio_text,
    volume,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import disc_impulse_conserved
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import deg, nm

PAGE = Page(
    name="3.12",
    title="Forces between flats over the contact angles",
    claim="A larger contact angle lowers the attraction of wetting films and raises the "
    "repulsion of non-wetting ones; with unlike angles the force lies between those of "
    "the two like pairs. The viscous force hardly depends on the angles.",
    verdict="It holds for the exact bridge at every pair of angles. Eq. (3.11) itself rises up to "
    "1.1 to 3.4 degrees, tan(theta) = h/x. The viscous map is flat but for two corners: "
    "where one body is wetted and the other not at all the film breaks after a few "
    "nanometres (7 % lower at 7.5/180 degrees, as printed 15 %).",
    grid="19 angles along each axis of the lines, 25 x 25 pairs in the maps",
    choices="Circle of 100 nm on the lower body, which is pulled. The viscous film is a disc of "
    "this circle; the arc has 0.6 to 1.5 times its volume in the two corners.",
)

FIXED = ((60, np.linspace(0.0, 90.0, 19)), (120, np.linspace(90.0, 180.0, 19)))  # [deg]


def compute(draft: bool = False) -> dict[str, Any]:
    """Forces at the start over one angle, and over both for h0 = 2 nm."""
    data: dict[str, Any] = {}
    for upper, lowers in FIXED:
        forces, impulses = [], []
        for height in HEIGHTS.tolist():
            for lower in lowers.tolist():
                pair = (lower, upper)
                liquid = volume(height, pair)
                force = flats(height, liquid, pair)
                forces.append([float(force.exact), float(force.printed)])
                impulses.append(_at_rupture(height, pair))
        shape = (len(HEIGHTS), len(lowers), 2)
        data[f"meniscus_{upper}"] = np.array(forces).reshape(shape)
        data[f"viscous_{upper}"] = np.array(impulses).reshape(shape)
    degrees = np.linspace(0.0, 180.0, 13 if draft else 25)
    small = np.linspace(0.0, 6.0, 61)
    near = [
        [meniscus_flat_3_11(RADIUS, h, GAMMA, one * deg, one * deg) for one in small.tolist()]
        for h in HEIGHTS.tolist()
    ]
    found = {"degrees": degrees, "map": _map(degrees), "small": small, "near": np.array(near)}
    return data | found | {"viscous_map": _viscous_map(degrees)}


def _map(degrees: Any) -> Any:
    """Exact force [N] at the start for each pair; nan for 0/180 degrees, without a bridge."""
    height = float(HEIGHTS[0])
    one, two = (part.ravel() for part in np.meshgrid(degrees, degrees, indexing="ij"))
    there = np.abs(one - two) < 180.0
    pairs = zip(one[there].tolist(), two[there].tolist(), strict=True)
    liquid = np.array([volume(height, pair) for pair in pairs])
    force = np.full(one.shape, np.nan)
    force[there] = GAMMA * bridge(height, liquid, one[there] * deg, two[there] * deg).force
    return force.reshape(len(degrees), len(degrees))


def _viscous_map(degrees: Any) -> Any:
    """Impulse over time [N] at rupture for each pair, right and as printed; nan for 0/180."""
    height = float(HEIGHTS[0])
    found = np.full((2, len(degrees), len(degrees)), np.nan)
    for i, one in enumerate(degrees.tolist()):
        for k, two in enumerate(degrees.tolist()):
            if abs(one - two) < 180.0:
                found[:, i, k] = _at_rupture(height, (one, two))
    return found


def _at_rupture(height: float, pair: tuple[float, float]) -> list[float]:
    """Impulse over time [N] up to the exact rupture, and Eq. (3.19) up to the closed neck."""
    limit, closed = break_gaps(volume(height, pair), pair)
    return [
        disc_impulse_conserved(math.pi * RADIUS**2 * height, height, limit, VISCOSITY) / TIME,
        viscous_flat_3_19(RADIUS, height, closed, TIME, VISCOSITY),
    ]


def draw(data: dict[str, Any]) -> Figure:
    """Forces over one angle, maps over both, and the printed force at small angles."""
    figure, panels = plot.figure(3, 2, size=(9.6, 12.0))
    (force, viscous), (both, flat), (printed, small) = panels
    for upper, lowers in FIXED:
        for i, color in enumerate(SHADES):
            for column, style in ((0, "-"), (1, ":")):
                force.plot(lowers, data[f"meniscus_{upper}"][i, :, column] / nm, style, color=color)
                viscous.plot(
                    lowers, data[f"viscous_{upper}"][i, :, column] / nm, style, color=color
                )
    for ax in (force, viscous):
        ax.axvline(90.0, color="0.5", lw=0.8)
        ax.set(xlabel=r"$\theta_1$ [deg]", xticks=range(0, 181, 30))
        ax.text(45.0, 0.93, r"$\theta_2$ = 60 deg", transform=ax.get_xaxis_transform(), ha="center")
        ax.text(135.0, 0.93, "120 deg", transform=ax.get_xaxis_transform(), ha="center")
    force.axhline(0.0, color="0.5", lw=0.6)
    force.set(ylabel="meniscus force [nN]", ylim=(-1900.0, 2300.0))
    heights_legend(force, [("exact", "-"), ("printed (3.11)", ":")], loc="lower left")
    viscous.set(yscale="log", ylabel="impulse over $t_s$ at rupture [nN]", ylim=(8.0, 1100.0))
    plot.plain_log(viscous.yaxis)
    for label, style in (("volume kept, exact rupture", "-"), ("printed (3.19)", ":")):
        viscous.plot([], [], style, color="0.2", label=label)
    plot.legend(viscous, fontsize=8, loc="lower left")
    degrees, exact = data["degrees"], data["map"] / nm
    drawn = both.contourf(degrees, degrees, exact, np.arange(-2400, 2401, 300), cmap="PuOr_r")
    lines = both.contour(
        degrees, degrees, exact, np.arange(-2400, 2401, 600), colors="k", linewidths=0.7
    )
    both.clabel(lines, fontsize=8, fmt="%g")
    figure.colorbar(drawn, ax=both, label="exact meniscus force [nN]")
    for ax, values in zip((flat, printed), data["viscous_map"] / nm, strict=True):
        _draw_viscous(figure, ax, degrees, values)
    for ax in (both, flat, printed):
        ax.set(xlabel=r"$\theta_2$ [deg]", ylabel=r"$\theta_1$ [deg]", aspect="equal")
        ax.set(xticks=range(0, 181, 60), yticks=range(0, 181, 60))
    for i, color in enumerate(SHADES):
        curve = data["near"][i]
        small.plot(data["small"], curve / curve[0], ":", color=color)
        top = int(np.argmax(curve))
        small.plot(data["small"][top], curve[top] / curve[0], "o", color=color, ms=4)
    small.set(xlabel=r"$\theta_1 = \theta_2$ [deg]", ylabel="Eq. (3.11) over its value at 0 deg")
    letters(
        list(panels.flat),
        [
            "one angle fixed",
            "one angle fixed",
            "meniscus, $h_0$ = 2 nm",
            "viscous, $h_0$ = 2 nm",
            "viscous as printed, $h_0$ = 2 nm",
            "maximum of the printed force",
        ],
    )
    return figure


def _draw_viscous(figure: Figure, ax: Any, degrees: Any, values: Any) -> None:
    """Map of an impulse over time [nN], over its largest value."""
    percent = 100.0 * values / np.nanmax(values)
    levels = [94.0, 95.0, 96.0, 97.0, 98.0, 99.0, 99.5, 99.9, 100.0]
    style = {"levels": levels, "cmap": "cividis", "norm": plot.mpl.colors.BoundaryNorm(levels, 256)}
    drawn = ax.contourf(degrees, degrees, percent, extend="min", **style)
    lines = ax.contour(degrees, degrees, percent, [99.0, 99.9], colors="k", linewidths=0.7)
    ax.clabel(lines, fontsize=8, fmt="%g")
    text = f"impulse over $t_s$, % of {np.nanmax(values):.1f} nN"
    figure.colorbar(drawn, ax=ax, label=text, ticks=levels)


def check(data: dict[str, Any]) -> list[Check]:
    """Signs of the trends over the whole map, the printed maximum, the viscous force."""
    degrees, exact = data["degrees"], data["map"]
    along = np.concatenate(
        [np.diff(exact, axis=axis)[np.isfinite(np.diff(exact, axis=axis))] for axis in (0, 1)]
    )
    like = np.diag(exact)
    low, high = np.minimum.outer(like, like), np.maximum.outer(like, like)
    inside = (exact >= low) & (exact <= high)
    wet, dry = degrees <= 90.0, degrees >= 90.0
    same = np.eye(len(degrees), dtype=bool)
    good = [bool((inside | same)[np.ix_(part, part)].all()) for part in (wet, dry)]
    tops = [float(data["small"][int(np.argmax(c))]) for c in data["near"]]
    known = [math.degrees(math.atan(h / RADIUS)) for h in HEIGHTS.tolist()]
    viscous = [data[f"viscous_{upper}"] for upper, _ in FIXED]
    change = max(float(np.ptp(v[..., 0], axis=1).max() / v[..., 0].max()) for v in viscous)
    printed = float(np.max(1.0 - viscous[1][:, -1, 1] / viscous[1][:, 0, 1]))
    spread = data["meniscus_60"][:, :, 0]
    return [
        Check(
            "the exact force falls with either contact angle, everywhere",
            bool(np.all(along < 0.0)),
            f"{along.size} differences of the map",
        ),
        Check(
            "of unlike angles, all below or all above 90 degrees, it lies between the like pairs",
            all(good),
            f"{sum(int(part.sum()) * (int(part.sum()) - 1) for part in (wet, dry))} pairs",
        ),
        Check(
            "a larger angle brings the forces of the heights together",
            bool(np.ptp(spread[:, -1]) < np.ptp(spread[:, 0])),
            f"2 less 6 nm: {np.ptp(spread[:, 0]) / nm:.0f} nN at 0 deg, "
            f"{np.ptp(spread[:, -1]) / nm:.0f} nN at 90 deg",
        ),
        Check(
            "Eq. (3.11) has its maximum at tan(theta) = h/x, not at 0 deg",
            all(abs(t - k) < 0.11 for t, k in zip(tops, known, strict=True)),
            f"{ratio_text(tops)} deg for 2 to 6 nm",
        ),
        Check(
            "the viscous impulse at rupture depends on the angles by less than 1 %",
            change < 0.01,
            f"up to {100 * change:.2g} %; as printed {100 * printed:.2g} % less at 180 deg",
        ),
        *_of_viscous_map(data),
        agree(
            "exact force of 0/60, and impulse over the time, 2 and 6 nm",
            [data["meniscus_60"][[0, 4], 0, 0], data["viscous_60"][[0, 4], 0, 0]],
            [
                [bridges.film_force(100e-9, h, 0, 60) for h in (2e-9, 6e-9)],
                [bridges.disc_impulse(math.pi * 1e-14 * h, h) / 1e-7 for h in (2e-9, 6e-9)],
            ],
        ),
    ]


def _of_viscous_map(data: dict[str, Any]) -> list[Check]:
    """How flat the map of the viscous force is, and where it is not."""
    degrees = data["degrees"]
    right, printed = (one / np.nanmax(one) - 1.0 for one in data["viscous_map"])
    near = np.abs(np.subtract.outer(degrees, degrees)) < 151.0
    at = [int(np.argmin(np.abs(degrees - one))) for one in (0.0, 60.0)]
    pairs = [(i, k) for i in at for k in at]
    second = [
        0.75 * math.pi * bridges.VISCOSITY * 1e-28 / bridges.TIME * (1.0 / 4e-18 - 1.0 / closed**2)
        for closed in (
            bridges.closed_gap(bridges.arc_volume(1e-7, 2e-9, *pair), *pair)
            for pair in ((degrees[i], degrees[k]) for i, k in pairs)
        )
    ]
    low, corner = float(right[near].min()), float(np.nanmin(right))
    return [
        Check(
            "over all pairs less than 150 degrees apart the viscous impulse is the same to 0.2 %",
            low > -0.002,
            f"least {100.0 * low:+.2g} %, printed {100.0 * float(printed[near].min()):+.2g} %",
        ),
        Check(
            "it falls where one body is wetted and the other is not: the film breaks at once",
            corner < 5.0 * low and bool(np.abs(_place(right, degrees)) > 151.0),
            f"least {100.0 * corner:+.2g} %, printed {100.0 * float(np.nanmin(printed)):+.2g} %, "
            f"{_place(right, degrees):.3g} degrees apart",
        ),
        agree(
            "map of the printed viscous force at 0/0, 0/60, 60/0 and 60/60, gap of a closed neck",
            [data["viscous_map"][1][pair] for pair in pairs],
            second,
        ),
    ]


def _place(values: Any, degrees: Any) -> float:
    """Difference of the two angles [deg] where a map has its least value."""
    one, two = np.unravel_index(int(np.nanargmin(values)), values.shape)
    return float(degrees[two] - degrees[one])


if __name__ == "__main__":
    run_page(__file__)
