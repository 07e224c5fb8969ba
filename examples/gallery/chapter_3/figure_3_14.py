"""Fig. 3.14: meniscus and viscous force over the area, and the area at which they are equal."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.as_published.printed.common import meniscus_flat_3_11
from contactkit.as_published.printed.viscous import viscous_flat_3_19
from contactkit.gallery.chapter_3.films import (
    GAMMA,
    HEIGHTS,
    SHADES,
    TIME,
    VISCOSITY,
    angles,
    flats,
    heights_legend,
    key,
    ratio_text,
    volume,
)
from contactkit.gallery.second_method import bridges
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import disc_impulse_conserved
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm, um, us

PAGE = Page(
    name="3.14",
    title="Forces over the meniscus area, and the critical area",
    claim="Both forces grow with the area, the viscous one faster, so that it is the larger one "
    "above a critical area. That area grows with the separation time and the height, and as the "
    "contact angles fall.",
    verdict="It holds. As printed the critical areas are half of the right ones, since the "
    "printed impulse is twice that of a film that keeps its volume.",
    grid="41 areas, 7 separation times",
    choices="Rupture far away for the viscous force, as its end hardly matters (Fig. 3.10).",
)

PAIRS = ((60, 60), (0, 60))
AREAS = np.geomspace(1e-3, 10.0, 41) * um**2
TIMES = np.geomspace(1e-9, 1e-3, 7)
LAWS: tuple[str, str] = ("exact", "as-published")


def compute(draft: bool = False) -> dict[str, Any]:
    """Forces over the area; critical areas over the separation time."""
    radii = np.sqrt(AREAS / math.pi)
    data: dict[str, Any] = {}
    for pair in PAIRS:
        for i, height in enumerate(HEIGHTS.tolist()):
            liquid = np.array([volume(height, pair, x) for x in radii.tolist()])
            data[f"forces_{key(pair)}_{i}"] = np.array(
                [
                    flats(height, liquid, pair).exact,
                    meniscus_flat_3_11(radii, height, GAMMA, *angles(pair)),
                    disc_impulse_conserved(AREAS * height, height, 1.0, VISCOSITY) / TIME,
                    viscous_flat_3_19(radii, height, 1.0, TIME, VISCOSITY),
                ]
            )
        times = TIMES[::2] if draft else TIMES
        found = [
            [[_critical(height, pair, time, law) for time in times.tolist()] for law in LAWS]
            for height in HEIGHTS.tolist()
        ]
        data |= {f"critical_{key(pair)}": np.array(found), "times": times}
    return data


def _critical(height: float, pair: tuple[int, int], time: float, law: Any) -> float:
    """Area [m2] at which the mean viscous force equals the meniscus force."""
    lower, upper = angles(pair)
    water = ck.Liquid(name="water", surface_tension=GAMMA, viscosity=VISCOSITY)
    film = ck.Meniscus(liquid=water, contact_angle_lower=lower, contact_angle_upper=upper)
    scene = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=height, final_gap=1e-3, time=time),
        effects=(ck.MeniscusForce(), ck.ViscousForce()),
    )
    return ck.critical_meniscus(scene, law=law).area


def draw(data: dict[str, Any]) -> Figure:
    """Forces over the area, and critical areas over the time."""
    figure, panels = plot.figure(1, 2, size=(9.6, 4.8))
    left, right = panels
    for i, color in enumerate(SHADES):
        exact, _, kept, _ = data[f"forces_60_60_{i}"] / nm
        left.plot(AREAS / um**2, exact, color=color)
        left.plot(AREAS / um**2, kept, "--", color=color)
        for pair, sign in zip(PAIRS if i in (0, 4) else (), "os", strict=False):
            right_area, printed = data[f"critical_{key(pair)}"][i] / um**2
            look = {"marker": sign, "color": color, "mfc": "none", "ms": 4}
            right.plot(data["times"] / us, right_area, **look)
            right.plot(data["times"] / us, printed, ":", **look)
    left.set(xscale="log", yscale="log", xlabel="meniscus area [µm²]", ylabel="force [nN]")
    heights_legend(left, [("meniscus", "-"), ("viscous, mean over 0.1 us", "--")], loc="upper left")
    right.set(xscale="log", yscale="log", xlabel="separation time [us]")
    right.set_ylabel("critical area [µm²]")
    for label, style in (
        ("60/60 deg", "o"),
        ("0/60 deg", "s"),
        ("exact", "-"),
        ("printed, (3.11) and (3.19)", ":"),
    ):
        right.plot([], [], style, color="0.2", mfc="none", label=label)
    plot.legend(right, fontsize=8, loc="upper left")
    letters(list(panels), ["60/60 deg, $t_s$ = 0.1 us", "equal forces, $h_0$ = 2 and 6 nm"])
    return figure


def check(data: dict[str, Any]) -> list[Check]:
    """Exponents of the area; trends of the critical area and how far the printed one is off."""
    like, unlike = (data[f"critical_{key(pair)}"] for pair in PAIRS)
    exact, printed = like[:, 0], like[:, 1]
    at = int(np.argmin(np.abs(data["times"] - TIME)))
    curve = data["forces_60_60_0"]
    slopes = [np.diff(np.log(row)) / np.diff(np.log(AREAS)) for row in (curve[0], curve[2])]

    def listed(values: Any) -> str:
        return ", ".join(f"{v / um**2:.4f}" for v in values)

    return [
        Check(
            "the meniscus force grows nearly with the area, the viscous with its square",
            bool(np.all((slopes[0] > 0.9) & (slopes[0] < 1.0)) and np.allclose(slopes[1], 2.0)),
            f"exponents {ratio_text(slopes[0])} and {ratio_text(slopes[1])}",
        ),
        Check(
            "the critical area grows with the separation time",
            bool(np.all(np.diff(exact, axis=1) > 0.0)),
            f"2 nm: {listed(exact[0])} um2",
        ),
        Check(
            "it grows with the height",
            bool(np.all(np.diff(exact, axis=0) > 0.0)),
            f"at 0.1 us {listed(exact[:, at])} um2",
        ),
        Check(
            "it is larger for 0/60 than for 60/60 degrees, as a smaller angle pulls harder",
            bool(np.all(unlike > like)),
            f"{ratio_text((unlike[:, 0] / exact).ravel())} times",
        ),
        Check(
            "as printed it is half of that of the exact bridge and a film of constant volume",
            bool(np.all(np.abs(exact / printed - 1.96)[:, at] < 0.03)),
            f"{ratio_text((exact / printed).ravel())} times over all times; printed at 0.1 us "
            f"{listed(printed[:, at])} um2",
        ),
        agree(
            "forces of 60/60 at 1e-3 um2, 2 nm",
            [curve[0, 0], curve[2, 0]],
            [
                bridges.film_force(math.sqrt(1e-15 / math.pi), 2e-9, 60, 60),
                bridges.disc_impulse(1e-15 * 2e-9, 2e-9) / 1e-7,
            ],
        ),
        agree(
            "critical area of 60/60 and 0/60 at 0.1 us, 2 nm",
            [exact[0, at], unlike[0, 0, at]],
            [bridges.equal_area(2e-9, 60, 60), bridges.equal_area(2e-9, 0, 60)],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
