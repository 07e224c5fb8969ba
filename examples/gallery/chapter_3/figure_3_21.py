"""Fig. 3.21: viscous force of a slide over the number of asperities, or of menisci."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.sliding import (
    sliding_flat_divided_3_61,
    sliding_sphere_divided_3_59,
)
from contactkit.gallery.chapter_3.films import SHADES, TIME, VISCOSITY, ratio_text
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.couette_flat import flat_impulse
from contactkit.lubrication.couette_sphere import sphere_impulse as one_impulse
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm, um

PAGE = Page(
    name="3.21",
    title="Viscous force of a slide over the number of asperities",
    claim="The viscous force of N asperities and of N menisci falls as the inverse root of N; "
    "roughness is a means against it.",
    verdict="Reversed for asperities: N (R/sqrt(N))^(3/2) is N^(1/4), not N^(-1/2), so that the "
    "force rises, at 10^4 asperities to a thousand times the printed one. For menisci "
    "N^(-1/2) holds at a given time; at a given speed their number has no effect, and "
    "that of asperities acts as N^(1/2).",
    grid="13 numbers from 1 to 1e4",
    choices="Asperities 10 nm away; speed of the last panels: that of one meniscus at 0.1 us.",
)

LARGE, GAP = 50 * um, 10 * nm
HEIGHTS = np.array([100.0, 200.0, 300.0, 400.0, 500.0]) * nm

sphere_impulse = np.vectorize(one_impulse, otypes=[float])


def compute(draft: bool = False) -> dict[str, Any]:
    """Mean forces [N] of all asperities and all menisci, at a given time and at a given speed."""
    numbers = np.geomspace(1.0, 1e4, 5 if draft else 13)
    n, heights = numbers[None, :], HEIGHTS[:, None]
    small = LARGE / np.sqrt(n)
    rough = n * np.asarray(sphere_impulse(small, GAP, heights, VISCOSITY)) / TIME
    menisci = small + 0.0 * heights
    smooth = n * np.asarray(flat_impulse(menisci, heights, 2.0 * menisci, VISCOSITY)) / TIME
    # at a given speed a small meniscus takes less time than t_s: as its travel
    return {
        "numbers": numbers,
        "rough": rough,
        "smooth": smooth,
        "rough_at_speed": rough * n**0.25,
        "smooth_at_speed": smooth * n**0.5,
        "printed_rough": sliding_sphere_divided_3_59(LARGE, GAP, heights, TIME, VISCOSITY, n),
        "printed_smooth": sliding_flat_divided_3_61(LARGE, heights, TIME, VISCOSITY, n),
        "overlap": (LARGE / (2.0 * (HEIGHTS - GAP))) ** 2,
    }


def draw(data: dict[str, Any]) -> Figure:
    """At a given time beside the printed laws, and at a given speed."""
    figure, panels = plot.figure(2, 2, size=(9.6, 8.2), sharex=True, sharey="row")
    numbers = data["numbers"]
    for i, (height, color) in enumerate(zip(HEIGHTS, SHADES, strict=True)):
        label = f"$h_0$ = {height / nm:g} nm"
        for column, name in enumerate(("rough", "smooth")):
            apart = numbers <= data["overlap"][i] if name == "rough" else numbers > 0.0
            for row, kind in enumerate((name, f"{name}_at_speed")):
                ax = panels[row, column]
                ax.plot(numbers, data[kind][i] * 1e6, color=color, lw=0.8)
                shown = np.where(apart, data[kind][i] * 1e6, np.nan)
                ax.plot(numbers, shown, color=color, label=label)
            panels[0, column].plot(numbers, data[f"printed_{name}"][i] * 1e6, ":", color=color)
    for ax in panels.flat:
        ax.set(xscale="log", yscale="log")
    for ax, text in zip(panels[1], ("asperities", "menisci"), strict=True):
        ax.set_xlabel(f"number of {text}")
    for ax in panels[:, 0]:
        ax.set_ylabel("mean viscous force [uN]")
    panels[0, 0].plot([], [], ":", color="0.2", label="as printed")
    panels[0, 0].plot([], [], color="0.2", lw=0.8, label="neighbours overlap")
    handles = panels[0, 0].get_legend_handles_labels()
    panels[0, 1].legend(*handles, frameon=False, fontsize=8, loc="lower left", ncols=2)
    letters(
        list(panels.flat),
        [
            "asperities, $t_s$ = 0.1 us",
            "menisci, $t_s$ = 0.1 us",
            "asperities, given speed",
            "menisci, given speed",
        ],
    )
    return figure


def check(data: dict[str, Any]) -> list[Check]:
    """Powers of N, and the factor between the printed and the right law."""
    logs = np.log(data["numbers"])

    def power(name: str) -> Any:
        return np.diff(np.log(data[name]), axis=1) / np.diff(logs)

    factor = data["rough"][:, -1] / data["rough"][:, 0] * math.sqrt(1e4)
    above = data["smooth"][:, 0] / data["rough"][:, 0]
    return [
        Check(
            "asperities at a given time: N^(1/4), not N^(-1/2)",
            bool(np.allclose(power("rough"), 0.25, atol=1e-6)),
            f"exponent {power('rough').mean():.4f}, printed {power('printed_rough').mean():.4f}",
        ),
        Check(
            "at 1e4 asperities the printed law is off by a factor of 1000",
            bool(np.allclose(factor, 1000.0, rtol=1e-4)),
            f"{ratio_text(factor)} times",
        ),
        Check(
            "menisci at a given time: N^(-1/2), as printed",
            bool(np.allclose(data["smooth"], data["printed_smooth"], rtol=1e-9)),
            f"exponent {power('smooth').mean():.4f}",
        ),
        Check(
            "at a given speed: N^(1/2) for asperities, N^0 for menisci",
            bool(
                np.allclose(power("rough_at_speed"), 0.5, atol=1e-6)
                and np.allclose(power("smooth_at_speed"), 0.0, atol=1e-9)
            ),
            f"{power('rough_at_speed').mean():.4f}, {power('smooth_at_speed').mean():.4f}",
        ),
        Check(
            "the film between smooth faces has the larger force for N = 1",
            bool(np.all(above > 50.0)),
            f"{ratio_text(above)} times",
        ),
        Check(
            "of high films the menisci of neighbours overlap before N = 1e4",
            bool(data["overlap"][-1] < 1e4),
            f"from N = {', '.join(f'{n:.0f}' for n in data['overlap'])}",
        ),
        agree(
            "impulse of one meniscus over the time, 100 and 500 nm",
            data["smooth"][[0, 4], 0],
            [bridges.lens_impulse(50e-6, h) / 1e-7 for h in (100e-9, 500e-9)],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
