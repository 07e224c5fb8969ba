"""Random rough surfaces drawn apart: menisci at summits of unlike heights."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.ndimage import maximum_filter

import contactkit as ck
from contactkit.analyses.heights import surface_heights
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.capillary.asperity_bridges import force_curve, gaussian_average
from contactkit.capillary.exact.at_pressure import bridge_at_pressure
from contactkit.capillary.film_islands import islands
from contactkit.capillary.island_bridges import curvature_of_area, measure_islands, summit_curvature
from contactkit.plot import gallery as plot
from contactkit.units import deg, nm

PAGE = Page(
    name="rough-separation",
    title="Random rough surfaces drawn apart",
    claim="Rough surfaces of chapter 3 are equal spheres of one height; future work of section "
    "3.5: random rough surfaces.",
    verdict="Summits of a random surface detach one after the other. At first touch some per cent "
    "of them hold a meniscus: as many equal asperities of one height have a hundred times "
    "the force. Summits of normal heights (Greenwood and Williamson) have the force of "
    "the map within a factor of two, in the median. Beyond contactkit: films that flow "
    "between menisci, menisci that merge.",
    choices="Rigid surface of rms 1 nm, correlation length 0.2 um, shortest wave 40 nm, over a "
    "flat; water, 60/60 degrees, at a pressure whose menisci end at 1 nm, an exact bridge "
    "on each island. Separation counts from first touch.",
    grid="512 x 512 pixels on 2 um, eight to the shortest wave",
    seeds="1 to 5: median, and a band from the least to the greatest",
)
GAMMA, ANGLE, HEIGHT, RMS, WIDTH = 0.072, 60 * deg, 1 * nm, 1 * nm, 2e-6
PRESSURE = -2.0 * np.cos(ANGLE) / HEIGHT  # over the tension [1/m]
PART = np.linspace(0.0, 1.2, 25)  # separation over the height of a meniscus


def compute(draft: bool = False) -> dict[str, Any]:
    """Force per area of each seed over the separation, by the map and by populations."""
    seeds = range(1, 3 if draft else 6)
    found = [_surface(seed) for seed in seeds]
    names = ("islands", "film", "population", "equal", "summits")
    return {name: np.array([one[name] for one in found]) for name in names}


def _surface(seed: int) -> dict[str, Any]:
    """Forces per area [Pa] of one surface over the separation from first touch."""
    rough = ck.GaussianRoughness(rms=RMS, correlation_length=0.2e-6, cutoff=40e-9, seed=seed)
    heights = surface_heights(rough, ck.Window(width=WIDTH), ck.Accuracy(grid=512)).heights
    pixel, area = WIDTH / heights.shape[0], WIDTH**2
    places = np.argwhere(heights == maximum_filter(heights, 3, mode="wrap"))
    curvature = summit_curvature(heights, places, (pixel, pixel), (True, True))
    tops = heights[places[:, 0], places[:, 1]]
    curve = force_curve(PRESSURE, (ANGLE, ANGLE), float(curvature.mean()), 1e-6)
    first, density = float(heights.max()), len(places) / area
    rows = []
    for part in PART.tolist():
        gap = first + part * HEIGHT - heights
        separation = first + part * HEIGHT - float(tops.mean())
        average = gaussian_average(curve.force, curve.reach, separation, float(tops.std()))
        single = float(curve.force(np.array(part * HEIGHT))) if part * HEIGHT < curve.reach else 0.0
        rows.append(
            (
                _bridges(gap, heights, pixel) / area,
                -PRESSURE * float((gap < HEIGHT).mean()),
                density * average,
                density * single,
            )
        )
    one, film, population, equal = GAMMA * np.array(rows).T
    reached = float((tops > first - curve.reach).mean())
    return {
        "islands": one,
        "film": film,
        "population": population,
        "equal": equal,
        "summits": np.array([len(places), reached]),
    }


def _bridges(gap: Any, heights: Any, pixel: float) -> float:
    """Force over tension [m] of the exact bridges on the islands of a gap map."""
    names, n = islands(gap < HEIGHT, True)
    if n == 0:
        return 0.0
    # One pixel has no area that stands for a sphere.
    found = measure_islands(names, n, gap, np.zeros(gap.shape, bool), heights, pixel**2)
    curvature = curvature_of_area(found, HEIGHT)
    held = (found.area > 4.0 * pixel**2) & np.isfinite(curvature)
    state = bridge_at_pressure(
        found.gap[held], PRESSURE, ANGLE, ANGLE, 0.0, curvature[held], beyond="nan"
    )
    return float(np.nansum(state.force))


def draw(data: Data) -> plot.Figure:
    """Force per area over the separation, on both scales."""
    figure, (left, right) = plot.figure(1, 2, size=(10.4, 4.4))
    separation = PART * HEIGHT / nm
    names = {
        "islands": "exact bridges on the map",
        "film": "Laplace pressure times area",
        "population": "summits of normal heights",
        "equal": "summits of one height",
    }
    for i, (name, label) in enumerate(names.items()):
        for ax in (left, right):
            if name == "equal" and ax is right:
                continue
            plot.band(ax, separation, data[name] / 1e6, i, label, marker="")
    left.set(yscale="log", ylim=(1e-3, 300.0), xlabel="separation from first touch [nm]")
    left.set_ylabel("meniscus force over area [MPa]")
    right.set(xlabel="separation from first touch [nm]", ylim=(0.0, None))
    right.set_ylabel("meniscus force over area [MPa]")
    left.legend(fontsize=8, loc="upper right")
    plot.letters((left, right), ("all", "the random surfaces"))
    return figure


def check(data: Data) -> list[Check]:
    """Detachment of the random surface, against equal summits and populations."""
    islands_, equal = data["islands"], data["equal"]
    start = islands_[:, 0]
    ratio = equal[:, 0] / start
    work = np.trapezoid(islands_, PART * HEIGHT, axis=1)
    alike = data["population"][:, 0] / start
    count, reached = data["summits"].T
    film = data["film"][:, 0] / start
    half = np.array([np.interp(-0.5, -one / one[0], PART) for one in islands_]) * HEIGHT / nm

    def spread(values: Any, unit: str = "") -> str:
        return f"{np.median(values):.3g} ({values.min():.3g} to {values.max():.3g}){unit}"

    return [
        Check(
            "the force falls with the separation, each surface",
            bool(np.all(np.diff(islands_, axis=1) <= 1e-9 * start[:, None])),
            f"at first touch {spread(start / 1e6, ' MPa')}, half of it at {spread(half, ' nm')}",
        ),
        Check(
            "at first touch fewer than a tenth of the summits hold a meniscus",
            bool(np.all(reached < 0.1)),
            f"{spread(100 * reached, ' %')} of {spread(count)}",
        ),
        Check(
            "summits of one height have more than five times the force at first touch",
            bool(np.all(ratio > 5.0)),
            f"{spread(ratio)} times",
        ),
        Check(
            "summits of normal heights have that of the map within a factor of two, in the median",
            bool(0.5 < np.median(alike) < 2.0),
            f"{spread(alike)} times",
        ),
        Check(
            "Laplace pressure times area is larger than the exact bridges, by less than twice",
            bool(np.all((film > 1.0) & (film < 2.0))),
            f"{spread(film)} times",
        ),
        Check(
            "surfaces differ: their work of separation by more than a fifth",
            bool(work.max() > 1.2 * work.min()),
            f"{spread(1e3 * work, ' mJ/m2')}",
        ),
    ]


def table(data: Data) -> Table:
    """Medians of the forces per area [MPa]."""
    rows = []
    for i in range(0, PART.size, 6):
        values = (
            np.median(data[n][:, i]) / 1e6 for n in ("islands", "film", "population", "equal")
        )
        rows.append([float(PART[i] * HEIGHT / nm), *map(float, values)])
    head = (
        "separation [nm]",
        "bridges on the map",
        "pressure times area",
        "normal heights",
        "equal",
    )
    return Table(head, rows)


if __name__ == "__main__":
    run_page(__file__)
