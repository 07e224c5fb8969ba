"""Figs. 3.18 and 3.19: viscous force over the sliding of flats, and of a sphere on a flat."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.sliding import (
    sliding_flat_3_53,
    sliding_number_3_62,
    sliding_number_3_63,
    sliding_sphere_3_56,
)
from contactkit.gallery.chapter_3.films import (
    HEIGHTS,
    RADIUS,
    SHADES,
    TIME,
    VISCOSITY,
    heights_legend,
    ratio_text,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm

PAGE = Page(
    name="3.18-3.19",
    title="Viscous force over a slide",
    claim="The viscous force rises over the slide to its value when the overlap is gone. "
    "Between flats a lower film has the larger one, under a sphere the smaller; a sphere "
    "has far less than flats.",
    verdict="The orders hold. What rises is the impulse so far over the time; the force at "
    "constant speed is greatest at the start, 3 pi/4 times the printed value between "
    "flats, and falls to zero. Under a sphere Eq. (3.56) takes the thickness at the rim "
    "everywhere: the impulse is 42 to 127 % larger with a gap of 1 nm, infinite with "
    "none.",
    grid="200 points of the travel, simulated",
    choices="The sphere is 1 nm away; the caption states no gap.",
)

GAP = 1 * nm

Film = tuple[Any, float, float, float]
"""Upper surface, volume of liquid [m3], gap [m] and radius of the film [m]."""


def compute(draft: bool = False) -> dict[str, Any]:
    """Travel, impulse so far over the time, and force at constant speed, for each height."""
    data: dict[str, Any] = {}
    points = 60 if draft else 200
    for i, height in enumerate(HEIGHTS.tolist()):
        radius = math.sqrt(2.0 * RADIUS * (height - GAP))
        liquid = math.pi * RADIUS * (height - GAP) * (height + GAP)
        flats: Film = (ck.Flat(), math.pi * RADIUS**2 * height, height, RADIUS)
        sphere: Film = (ck.Sphere(radius=RADIUS), liquid, GAP, radius)
        for name, film in (("flats", flats), ("sphere", sphere)):
            data[f"{name}_{i}"] = _slide(film, points)
    data["printed_flats"] = sliding_flat_3_53(RADIUS, HEIGHTS, TIME, VISCOSITY)
    data["printed_sphere"] = sliding_sphere_3_56(RADIUS, GAP, HEIGHTS, TIME, VISCOSITY)
    return data


def _slide(film: Film, points: int) -> Any:
    """Travel [m], impulse so far over the time [N], force [N] at constant speed."""
    upper, liquid, gap, radius = film
    water = ck.Liquid(name="water", viscosity=VISCOSITY, surface_tension=0.072)
    found = []
    for imposed in ({"time": TIME}, {"speed": 2.0 * radius / TIME}):
        scene = ck.SlidingScene(
            interface=ck.Interface(upper=upper, meniscus=ck.Meniscus(liquid=water, volume=liquid)),
            loading=ck.Sliding(gap=gap, **imposed),
            effects=(ck.CouetteForce(),),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ck.ValidityWarning)  # nanometres: not a continuum
            found.append(ck.simulate(ck.plan(scene, ck.Accuracy(points=points))))
    within, steady = found
    return np.array([within.travel, within["couette_impulse"] / TIME, steady["couette_force"]])


def draw(data: dict[str, Any]) -> Figure:
    """Impulse so far over the time with the printed totals; the force itself."""
    figure, panels = plot.figure(2, 2, size=(9.6, 8.2))
    numbers = {"flats": sliding_number_3_62, "sphere": sliding_number_3_63}
    for column, (name, number) in enumerate(numbers.items()):
        for i, color in enumerate(SHADES):
            travel, mean, force = data[f"{name}_{i}"]
            top, bottom = panels[:, column]
            top.plot(travel / nm, mean / nm, color=color)
            top.plot(travel[-1] / nm, data[f"printed_{name}"][i] / nm, "x", color=color, ms=7)
            bottom.plot(travel / nm, number(force, RADIUS, TIME, VISCOSITY), color=color)
        top.set(xlabel="travel [nm]", ylabel="impulse so far over $t_s$ [nN]", ylim=(0.0, None))
        bottom.set(xlabel="travel [nm]", ylim=(0.0, None))
    panels[1, 0].set_ylabel(r"$t_s F/(\eta x^2)$, Eq. (3.62)")
    panels[1, 1].set_ylabel(r"$t_s F/(\eta R^2)$, Eq. (3.63)")
    heights_legend(panels[0, 0], [("printed, whole slide", "x")], fontsize=8)
    letters(
        list(panels.flat),
        ["flats", "sphere, 1 nm away", "flats, force at constant speed", "sphere, the same"],
    )
    return figure


def check(data: dict[str, Any]) -> list[Check]:
    """Trends over the travel, totals against the printed ones, orders of the heights."""
    flats, spheres = ([data[f"{n}_{i}"] for i in range(len(HEIGHTS))] for n in ("flats", "sphere"))
    total = {
        n: np.array([c[1, -1] for c in cs]) for n, cs in (("flats", flats), ("sphere", spheres))
    }
    first = np.array([c[2, 0] for c in flats])
    printed = data["printed_sphere"]
    low = total["sphere"] / printed
    ends = [float(c[0, -1]) / nm for c in spheres]
    return [
        Check(
            "the impulse so far rises, the force at constant speed falls, from start to end",
            all(
                np.all(np.diff(c[1]) > 0.0) and np.all(np.diff(c[2]) < 0.0)
                for c in (*flats, *spheres)
            ),
            "10 slides",
        ),
        Check(
            "between flats the whole impulse over the time is Eq. (3.53)",
            bool(np.allclose(total["flats"], data["printed_flats"], rtol=1e-9)),
            f"{', '.join(f'{v / nm:.3f}' for v in total['flats'])} nN",
        ),
        Check(
            "the force at the start is 3 pi/4 times that",
            bool(np.allclose(first / total["flats"], 0.75 * math.pi, rtol=1e-9)),
            f"{first[0] / total['flats'][0]:.4f} times",
        ),
        Check(
            "Eq. (3.56) is too low for a sphere: its film is thinner than at the rim",
            bool(np.all(low > 1.3)),
            f"right over printed {', '.join(f'{v:.3f}' for v in low)}",
        ),
        Check(
            "a lower film has the larger impulse between flats, the smaller one under a sphere",
            bool(np.all(np.diff(total["flats"]) < 0.0) and np.all(np.diff(total["sphere"]) > 0.0)),
            f"sphere {', '.join(f'{v / nm:.4f}' for v in total['sphere'])} nN",
        ),
        Check(
            "a sphere has far less than flats",
            bool(np.all(total["flats"] / total["sphere"] > 5.0)),
            f"{ratio_text(total['flats'] / total['sphere'])} times less",
        ),
        Check(
            "the travel to the end is 2 x between flats, and grows with the height under a sphere",
            bool(np.all(np.diff(ends) > 0.0)),
            f"flats 200 nm, sphere {', '.join(f'{e:.1f}' for e in ends)} nm",
        ),
        agree(
            "impulse of flats over the time, 2 and 6 nm",
            total["flats"][[0, 4]],
            [bridges.lens_impulse(100e-9, h) / 1e-7 for h in (2e-9, 6e-9)],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
