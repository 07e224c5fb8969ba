"""Fig. 3.20: viscous force of a slide over its time, and over the gap that the source sets to 0."""

from __future__ import annotations

from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.sliding import sliding_flat_3_53, sliding_sphere_3_56
from contactkit.gallery.chapter_3.films import (
    HEIGHTS,
    RADIUS,
    SHADES,
    VISCOSITY,
    heights_legend,
    ratio_text,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.couette_sphere import sphere_impulse as one_impulse
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm, us

PAGE = Page(
    name="3.20",
    title="Viscous force of a slide over its time",
    claim="The viscous force goes with the inverse of the separation time; that of a sphere "
    "that touches the flat is far smaller than that of flats.",
    verdict="The mean of the impulse goes as 1/t_s exactly. Of a touching sphere Eq. (3.56) is "
    "finite only because it takes the thickness at the rim everywhere: the impulse grows "
    "as the logarithm of the gap. At 0.3 nm it is two to three times the printed one; the "
    "order of sphere and flats stays.",
    grid="closed forms; 41 gaps from 0.01 to 1 nm",
    choices="Panel (b) starts from a gap of 0.3 nm.",
)

TIMES = np.geomspace(1e-9, 1e-5, 5)
CUT = 0.3 * nm

sphere_impulse = np.vectorize(one_impulse, otypes=[float])


def compute(draft: bool = False) -> dict[str, Any]:
    """Impulses [N.s] of each height, between flats and over the gap of a sphere."""
    gaps = np.geomspace(0.01 * nm, 1 * nm, 11 if draft else 41)
    return {
        "flats": sliding_flat_3_53(RADIUS, HEIGHTS, 1.0, VISCOSITY),
        "printed": sliding_sphere_3_56(RADIUS, 0.0, HEIGHTS, 1.0, VISCOSITY),
        "sphere": sphere_impulse(RADIUS, CUT, HEIGHTS, VISCOSITY),
        "gaps": gaps,
        "over_gap": np.array([sphere_impulse(RADIUS, gaps, h, VISCOSITY) for h in HEIGHTS]),
    }


def draw(data: dict[str, Any]) -> Figure:
    """Mean forces over the time, and the impulse of a sphere over its gap."""
    figure, panels = plot.figure(1, 3, size=(11.0, 4.4))
    for i, color in enumerate(SHADES):
        for ax, name in zip(panels, ("flats", "sphere"), strict=False):
            ax.plot(TIMES / us, data[name][i] / TIMES / nm, color=color)
        panels[1].plot(TIMES / us, data["printed"][i] / TIMES / nm, ":", color=color)
        ratio = data["over_gap"][i] / data["printed"][i]
        panels[2].plot(data["gaps"] / nm, ratio, color=color)
    for ax in panels[:2]:
        ax.set(xscale="log", yscale="log", xlabel="separation time [us]", ylim=(1e-4, 3e3))
    panels[0].set_ylabel("impulse over the time [nN]")
    panels[1].plot([], [], ":", color="0.2", label="printed (3.56), $D_0 = 0$")
    panels[2].axhline(1.0, color="0.5", lw=0.8)
    panels[2].set(
        xscale="log", xlabel="gap $D_0$ [nm]", ylabel="impulse over that of (3.56), $D_0 = 0$"
    )
    heights_legend(panels[0], [], fontsize=8)
    plot.legend(panels[1], fontsize=8)
    letters(list(panels), ["flats", "sphere, 0.3 nm away", "sphere: no limit at $D_0$ = 0"])
    return figure


def check(data: dict[str, Any]) -> list[Check]:
    """Order of sphere and flats, and the logarithm of the gap."""
    gaps, over = data["gaps"], data["over_gap"]
    steps = np.diff(over, axis=1) / np.diff(np.log(gaps))
    first = steps[:, 0]  # per e-fold of the gap, at the smallest gaps
    radii = np.sqrt(2.0 * RADIUS * HEIGHTS)
    known = -2.0 * np.pi * VISCOSITY * RADIUS * radii  # its axis is over liquid for a travel x
    return [
        Check(
            "a sphere has far less than flats",
            bool(np.all(data["flats"] / data["sphere"] > 3.0)),
            f"{ratio_text(data['flats'] / data['sphere'])} times less",
        ),
        Check(
            "at 0.3 nm the impulse of the sphere is two to three times the printed one at D0 = 0",
            bool(np.all(data["sphere"] / data["printed"] > 1.8)),
            f"{ratio_text(data['sphere'] / data['printed'])} times",
        ),
        Check(
            "it has no limit as the gap closes: the same is added for each decade",
            bool(np.all(np.abs(steps[:, 0] / steps[:, 2] - 1.0) < 0.1) and np.all(first < 0.0)),
            f"{-first[0] * np.log(10.0) / data['printed'][0]:.2f} times the printed one (2 nm)",
        ),
        Check(
            "its slope over the logarithm is 2 pi eta R x: the axis is over liquid half the way",
            bool(np.allclose(first / known, 1.0, atol=0.01)),
            f"{ratio_text(first / known)} of it",
        ),
        agree(
            "impulse of flats, 2 and 6 nm",
            data["flats"][[0, 4]],
            [bridges.lens_impulse(100e-9, h) for h in (2e-9, 6e-9)],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
