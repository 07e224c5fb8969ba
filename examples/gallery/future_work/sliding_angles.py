"""Contact angles in sliding: advancing and receding angle beside the viscous drag."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_3.films import GAMMA, RADIUS, VISCOSITY
from contactkit.plot import gallery as plot
from contactkit.units import deg, nm

PAGE = Page(
    name="sliding-angles",
    title="Contact angles in tangential separation",
    claim="The tangential separation of the source leaves contact angles to future work.",
    verdict="A meniscus that slides holds the body back by k gamma w (cos theta_r - cos theta_a), "
    "w its width. This force does not depend on the speed, so that below 0.2 m/s between "
    "the flats of the source and 1 m/s under its sphere, for a hysteresis of 20 degrees, "
    "it exceeds the drag. Beyond contactkit: angles that depend on the speed, the shape "
    "of the sheared meniscus.",
    choices="Water, flats with a meniscus of 100 nm at 2 nm, a sphere of 100 nm at 1 nm with a "
    "film of 2 nm; mean angle 60 degrees, hysteresis on one body; k = 2/pi. Valid for eta "
    "v/gamma below 1, or 80 m/s.",
    grid="200 points along the slide; hysteresis from 0 to 60 degrees",
)
MEAN = 60.0  # [deg]
HYSTERESIS = (5.0, 10.0, 20.0, 40.0)  # [deg]
WATER = ck.Liquid(name="water", viscosity=VISCOSITY, surface_tension=GAMMA)
FILMS = {"flats": (2 * nm, 2 * nm), "sphere": (1 * nm, 2 * nm)}  # gap, height of the film


def compute(draft: bool = False) -> dict[str, Any]:
    """Forces along the slide, and over the hysteresis."""
    data: dict[str, Any] = {"hysteresis": np.linspace(0.0, 60.0, 7 if draft else 25)}
    for name in FILMS:
        for i, degrees in enumerate(HYSTERESIS):
            run = _slid(name, degrees)
            data[f"{name}_{i}"] = np.array([run.travel, run["hysteresis_force"]])
            data[f"work_{name}_{i}"] = np.array(run.of(ck.ContactAngleHysteresis).work)
        data[f"drag_{name}"] = np.array([run.travel, run["couette_force"]])  # at 1 m/s
        data[f"area_{name}"] = np.array(run["overlap_area"][0])
        data[f"start_{name}"] = np.array(
            [_slid(name, d)["hysteresis_force"][0] for d in data["hysteresis"][1:].tolist()]
        )
    return data


def _slid(name: str, degrees: float) -> Any:
    """Slide at 1 m/s with a hysteresis on the lower body [deg]."""
    gap, height = FILMS[name]
    upper = ck.Sphere(radius=RADIUS) if name == "sphere" else ck.Flat()
    volume = RADIUS * math.pi * (height**2 - gap**2 if name == "sphere" else RADIUS * gap)
    scene = ck.SlidingScene(
        interface=ck.Interface(upper=upper, meniscus=ck.Meniscus(liquid=WATER, volume=volume)),
        loading=ck.Sliding(gap=gap, speed=1.0),
        effects=(
            ck.CouetteForce(),
            ck.ContactAngleHysteresis(
                advancing_lower=(MEAN + 0.5 * degrees) * deg,
                receding_lower=(MEAN - 0.5 * degrees) * deg,
            ),
        ),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # nanometres
        return ck.simulate(ck.plan(scene))


def draw(data: Data) -> plot.Figure:
    """Forces along the slide, forces over the speed, speed at which they are equal."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.4))
    for i, degrees in enumerate(HYSTERESIS):
        travel, force = data[f"flats_{i}"] / nm
        left.plot(travel, force, **plot.series(i + 1, marker=""), label=f"{degrees:g} deg")
    travel, drag = data["drag_flats"] / nm
    left.plot(travel, 0.2 * drag, **plot.series(0, marker=""), label="drag at 0.2 m/s")
    left.set(xlabel="travel [nm]", ylabel="force between flats [nN]", ylim=(0.0, 7.8))
    left.legend(fontsize=8, title="hysteresis", title_fontsize=8, ncols=2, loc="upper right")
    speed = np.geomspace(1e-3, 10.0, 40)
    for j, name in enumerate(FILMS):
        dragged = float(data[f"drag_{name}"][1, 0]) / nm * speed
        held = float(data[f"{name}_2"][1, 0]) / nm
        look = plot.series(j, marker="")
        middle.loglog(speed, dragged, **(look | {"ls": "-"}), label=f"{name}: drag")
        middle.loglog(
            speed, np.full_like(speed, held), **(look | {"ls": "--"}), label=f"{name}: 20 deg"
        )
        right.plot(
            data["hysteresis"][1:], _equal(data, name), **plot.series(j, marker=""), label=name
        )
    middle.set(xlabel="speed [m/s]", ylabel="force at the start [nN]")
    middle.legend(fontsize=8)
    right.set(xlabel="hysteresis [deg]", ylabel="speed of equal forces [m/s]", ylim=(0.0, None))
    right.legend(fontsize=8)
    plot.letters(
        (left, middle, right), ("along the slide", "over the speed", "where both are equal")
    )
    return figure


def _equal(data: Data, name: str) -> Any:
    """Speed [m/s] below which the contact angles hold back more than the drag."""
    return data[f"start_{name}"] / data[f"drag_{name}"][1, 0]


def check(data: Data) -> list[Check]:
    """Independence of the speed, work per area, and the speed of equal forces."""
    tension = 2.0 / math.pi * GAMMA
    per_area, expected = [], []
    for i, degrees in enumerate(HYSTERESIS):
        ends = [math.cos((MEAN + s * 0.5 * degrees) * deg) for s in (-1, 1)]
        expected.append(tension * (ends[0] - ends[1]))
        per_area.append(
            [float(data[f"work_{name}_{i}"]) / float(data[f"area_{name}"]) for name in FILMS]
        )
    off = np.abs(np.array(per_area) / np.array(expected)[:, None] - 1.0).max()
    equal = {
        name: float(np.interp(20.0, data["hysteresis"][1:], _equal(data, name))) for name in FILMS
    }
    starts = data["start_flats"]
    small = starts[0] / (tension * 2 * RADIUS * math.radians(data["hysteresis"][1]))
    falls = [data[f"{name}_{i}"][1] for name in FILMS for i in range(len(HYSTERESIS))]
    return [
        Check(
            "work over the area that is laid bare is k gamma (cos theta_r - cos theta_a)",
            bool(off < 1e-9),
            ", ".join(f"{1e3 * e:.2f}" for e in expected) + " mJ/m2, for flats and sphere",
        ),
        Check(
            "the force falls along the slide, with the width of the overlap",
            all(bool(np.all(np.diff(f) < 1e-22)) for f in falls),
            f"{len(falls)} slides",
        ),
        Check(
            "it grows with the hysteresis, at first in proportion",
            bool(np.all(np.diff(starts) > 0.0) and abs(small / math.sin(MEAN * deg) - 1.0) < 0.01),
            f"{starts[0] / nm:.3f} to {starts[-1] / nm:.2f} nN",
        ),
        Check(
            "20 degrees hold back more than the drag below 0.2 (flats) and 1 m/s (sphere), to 5 %",
            bool(abs(equal["flats"] / 0.2 - 1) < 0.05 and abs(equal["sphere"] - 1.0) < 0.05),
            f"{equal['flats']:.2f} m/s between flats, {equal['sphere']:.2f} m/s under a sphere",
        ),
    ]


def table(data: Data) -> Table:
    """Forces at the start and speeds at which the drag equals them."""
    rows = []
    for name in FILMS:
        for i, degrees in enumerate(HYSTERESIS):
            force = float(data[f"{name}_{i}"][1, 0])
            speed = force / float(data[f"drag_{name}"][1, 0])
            rows.append([name, degrees, force / nm, speed])
    return Table(("bodies", "hysteresis [deg]", "force [nN]", "drag equal at [m/s]"), rows)


if __name__ == "__main__":
    run_page(__file__)
