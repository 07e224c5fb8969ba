"""Fig. 1.3: force over the time in which a lens is pulled out of a pool of castor oil."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.second_method.anchors import agree
from contactkit.lubrication.squeeze_film import sphere_impulse_flooded
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters, series
from contactkit.units import mm, um

PAGE = Page(
    name="1.3",
    title="A lens pulled out of castor oil",
    claim="The force needed to pull a glass lens out of castor oil (measured by others at 18 "
    "and 22 degC) falls with the time taken; slope times viscosity does not depend on the "
    "temperature: the film is Newtonian.",
    verdict="It is the impulse of a Newtonian film: under a constant pull t = 6 pi eta R^2 "
    "ln(D1/D0)/F, a line through zero whose slope times the viscosity is the same for "
    "every oil. The simulated pulls keep that to six digits.",
    grid="7 pulls at each of two temperatures, each simulated",
    choices="Lens of 10 mm radius, from 1 to 100 um (source: not stated). Viscosity between 2.42, "
    "0.986 and 0.451 Pa.s at 10, 20 and 30 degC (CRC Handbook).",
)

RADIUS, GAPS = 10 * mm, (1 * um, 100 * um)
DEGREES = (18.0, 22.0)
KNOWN = np.array([[10.0, 20.0, 30.0], [2.42, 0.986, 0.451]])  # degC, Pa.s


def viscosity(degrees: float) -> float:
    """Viscosity of castor oil [Pa.s]: parabola of its logarithm through three values."""
    return float(np.exp(np.polyval(np.polyfit(KNOWN[0], np.log(KNOWN[1]), 2), degrees)))


def compute(draft: bool = False) -> dict[str, Any]:
    """Release time [s] for each pull [N] at both temperatures."""
    pulls = np.geomspace(0.1, 10.0, 3 if draft else 7)
    times = [[_time(viscosity(degrees), pull) for pull in pulls.tolist()] for degrees in DEGREES]
    return {
        "pulls": pulls,
        "times": np.array(times),
        "viscosity": np.array([viscosity(one) for one in DEGREES]),
    }


def _time(value: float, pull: float) -> float:
    """Time [s] in which a lens without mass is pulled from the first gap to the last."""
    oil = ck.Liquid(name="castor oil", viscosity=value)
    lens = ck.Interface(upper=ck.Sphere(radius=RADIUS), meniscus=ck.Meniscus(liquid=oil))
    scene = ck.SeparationScene(
        interface=lens,
        loading=ck.ImposedForce(initial_gap=GAPS[0], final_gap=GAPS[1], force=pull),
        effects=(ck.ViscousForce(),),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        state = ck.simulate(ck.plan(scene)).state
    assert state is not None
    return state.release_time


def draw(data: dict[str, Any]) -> Figure:
    """Force over time, and its inverse times the viscosity."""
    figure, (left, right) = plot.figure(1, 2, size=(9.6, 4.4))
    fine = np.geomspace(data["times"].min(), data["times"].max(), 60)
    for i, (degrees, value) in enumerate(zip(DEGREES, data["viscosity"], strict=True)):
        impulse = sphere_impulse_flooded(RADIUS, math.inf, *GAPS, value)
        look = series(i)
        name = f"{degrees:g} degC, {value:.2f} Pa.s"
        left.plot(data["times"][i], data["pulls"], look["marker"], color=look["color"], label=name)
        left.plot(fine, impulse / fine, ls=look["ls"], color=look["color"])
        right.plot(
            data["times"][i], value / data["pulls"], look["marker"], color=look["color"], label=name
        )
    right.plot(
        fine, value * fine / impulse, color="0.4", lw=1.0, label=r"$t/(6\pi R^2\,\ln(D_1/D_0))$"
    )
    left.set(xscale="log", yscale="log", xlabel="time of separation [s]", ylabel="force [N]")
    right.set(xlabel="time of separation [s]", ylabel="viscosity per newton of pull [Pa·s/N]")
    plot.legend(left, fontsize=8)
    plot.legend(right, fontsize=8)
    letters([left, right], ["marks: simulated, lines: impulse over time", "one line for both"])
    return figure


def _lagrange(degrees: float) -> float:
    """Viscosity [Pa.s] once more, by weights of the three values."""
    t = (degrees - 20.0) / 10.0
    weights = (0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0))
    return float(math.prod(v**w for v, w in zip((2.42, 0.986, 0.451), weights, strict=True)))


def check(data: dict[str, Any]) -> list[Check]:
    """Force times time over viscosity is one number; that of the closed form."""
    number = data["times"] * data["pulls"] / data["viscosity"][:, None]
    known = sphere_impulse_flooded(RADIUS, math.inf, *GAPS, 1.0)
    ratio = float(data["viscosity"][0] / data["viscosity"][1])
    slope = np.diff(np.log(data["times"])) / np.diff(np.log(data["pulls"]))
    return [
        Check(
            "force times time over viscosity is the same at both temperatures and all pulls",
            bool(np.ptp(number) / number.mean() < 1e-6),
            f"{number.min():.5f} to {number.max():.5f} m2",
        ),
        Check(
            "it is 6 pi R^2 ln(D1/D0)",
            bool(np.allclose(number, known, rtol=1e-6)),
            f"{known:.5f} m2",
        ),
        Check(
            "the force goes with the inverse of the time",
            bool(np.allclose(slope, -1.0, atol=1e-6)),
            f"exponent {slope.mean():.5f}",
        ),
        Check(
            "4 degC change the force by two fifths",
            1.3 < ratio < 1.5,
            f"{ratio:.2f} times",
        ),
        agree(
            "force times time at 18 and 22 degC, viscosity by Lagrange's parabola",
            data["times"][:, 0] * data["pulls"][0],
            [6.0 * math.pi * 1e-4 * math.log(100.0) * _lagrange(one) for one in (18.0, 22.0)],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
