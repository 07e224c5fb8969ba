"""Stick-slip of a wet slider that is driven through a spring."""

from __future__ import annotations

import math
import warnings
from typing import Any

import attrs
import numpy as np
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.numerics.roots import bracketed_root
from contactkit.plot import gallery as plot
from contactkit.units import deg, nm, um

PAGE = Page(
    name="stick-slip",
    title="A wet slider driven through a spring",
    claim="Future work of sections 2.4 and 3.5: stick-slip, vibration induced by friction, with "
    "springs and dampers.",
    verdict="Menisci add to the load: they raise the force at which the slider breaks away, and "
    "its slips, by far more if they rupture while it moves. The film shortens the "
    "overshoot, and above a speed or a damping the slider slides on steadily. Beyond "
    "contactkit: friction that ages at rest or depends on the speed, motion normal to the "
    "faces, wear.",
    choices="10 mg under 20 mN, friction 0.3 at rest and 0.2 in motion, spring of 50 N/m drawn at "
    "1 mm/s. 100 menisci of a lubricant (30 mN/m, 50 mPa.s) of 5 um at 20 nm, 60/60 "
    "degrees, at rest and in motion alike, or ruptured in motion.",
    grid="5 slips; 40 speeds",
)
BLOCK = ck.SpringSlider(
    load=0.02,
    static_coefficient=0.3,
    kinetic_coefficient=0.2,
    stiffness=50.0,
    speed=1e-3,
    mass=1e-5,
)
COUNT, RADIUS, GAP = 100, 5 * um, 20 * nm


def _film() -> tuple[float, float]:
    """Meniscus force [N] and drag over speed [N.s/m] of all menisci."""
    oil = ck.Liquid(name="lubricant", viscosity=0.05, surface_tension=0.03)
    film = ck.Meniscus(
        liquid=oil,
        volume=COUNT * math.pi * RADIUS**2 * GAP,
        contact_angle_lower=60 * deg,
        contact_angle_upper=60 * deg,
        count=COUNT,
    )
    apart = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedTime(initial_gap=GAP, final_gap=2 * GAP, time=1.0),
        effects=(ck.MeniscusForce(),),
    )
    along = ck.SlidingScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.Sliding(gap=GAP, speed=1.0),
        effects=(ck.CouetteForce(),),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # their lines are pinned here
        force = float(ck.simulate(ck.plan(apart))["meniscus_force"][0])
        return force, float(ck.simulate(ck.plan(along))["couette_force"][0])


def _sliders(force: float, drag: float) -> dict[str, ck.SpringSlider]:
    return {
        "dry": BLOCK,
        "menisci": attrs.evolve(BLOCK, meniscus_force=force),
        "menisci, drag": attrs.evolve(BLOCK, meniscus_force=force, damping=drag),
        "ruptured in motion, drag": attrs.evolve(
            BLOCK, meniscus_force=force, moving_meniscus_force=0.0, damping=drag
        ),
    }


def compute(draft: bool = False) -> dict[str, Any]:
    """Force over time of each slider, slips over the speed, and a slip by another integrator."""
    force, drag = _film()
    sliders = _sliders(force, drag)
    speeds = np.geomspace(1e-4, 10.0, 12 if draft else 40)
    data: dict[str, Any] = {"film": np.array([force, drag]), "speeds": speeds}
    for i, slider in enumerate(sliders.values()):
        motion = ck.stick_slip(slider)
        data[f"run_{i}"] = np.array([motion.time, motion.force])
        data[f"slip_{i}"] = np.array([motion.slip_time, *motion.events[0][2:5]])
        data[f"drop_{i}"] = np.array([_drop(slider, v) for v in speeds.tolist()])
    wet = sliders["menisci, drag"]
    data["other"] = np.array(_integrated(wet))
    data["last"] = np.array(_last_speed(wet))
    ratios = np.linspace(0.0, 1.2, 13 if draft else 49)
    critical = 2.0 * math.sqrt(wet.stiffness * wet.mass)
    data["damping"] = np.array(
        [ratios, [_drop(attrs.evolve(wet, damping=s * critical), 1e-3) for s in ratios.tolist()]]
    )
    return data


def _drop(slider: ck.SpringSlider, speed: float) -> float:
    """Fall of the spring's force in a slip at another speed [N]; 0 if it slides steadily."""
    events = ck.stick_slip(attrs.evolve(slider, speed=speed), n_slips=1).events
    return events[0].force_before - events[0].force_after if events else 0.0


def _last_speed(slider: ck.SpringSlider) -> float:
    """Speed above which there is no stick-slip [m/s]."""
    found = bracketed_root(lambda v: 1.0 if _drop(slider, math.exp(v)) else -1.0, -9.0, 3.0)
    return math.exp(found)


def _integrated(slider: ck.SpringSlider) -> tuple[float, float]:
    """Time [s] and length [m] of a slip by another integrator."""

    def rate(time: float, y: Any) -> list[float]:
        pull = slider.static_friction + slider.stiffness * (slider.speed * time - y[0])
        drag = slider.damping * y[1]
        return [y[1], (pull - slider.kinetic_friction - drag) / slider.mass]

    def at_rest(time: float, y: Any) -> float:
        return float(y[1]) if time > 1e-5 else 1.0

    at_rest.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rate, (0.0, 1.0), (0.0, 0.0), rtol=1e-10, atol=1e-14, events=at_rest)
    return float(found.t[-1]), float(found.y[0, -1])


def draw(data: Data) -> plot.Figure:
    """Force of the spring over time, fall of the force over speed and damping."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.6, 4.4))
    names = list(_sliders(1.0, 1.0))
    for i, name in enumerate(names):
        time, force = data[f"run_{i}"]
        look = plot.series(i, marker="")
        left.plot(1e3 * time, 1e3 * force, **look, label=name)
        fall = np.where(data[f"drop_{i}"] > 0.0, data[f"drop_{i}"], np.nan)
        middle.plot(data["speeds"], 1e3 * fall, **look, label=name)
    left.set(xlabel="time [ms]", ylabel="force of the spring [mN]", xlim=(0.0, 900.0))
    left.set_ylim(None, 13.0)
    left.legend(fontsize=8, loc="upper right", ncols=2)
    middle.axvline(float(data["last"]), color="0.5", lw=0.8, ls=":")
    middle.set(xscale="log", xlabel="speed of the spring's end [m/s]", ylabel="fall in a slip [mN]")
    middle.set_ylim(0.0, None)
    ratio, fall = data["damping"]
    right.plot(ratio, 1e3 * fall, **plot.series(2, marker="."), label="1 mm/s, with menisci")
    wet = float(data["film"][1]) / (2.0 * math.sqrt(BLOCK.stiffness * BLOCK.mass))
    right.axvline(wet, color="0.5", lw=0.8, ls=":", label="films as given")
    right.set(xlabel="damping over critical damping [-]", ylabel="fall in a slip [mN]")
    right.set_ylim(0.0, None)
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("five slips", "over the speed", "over the damping"))
    return figure


def check(data: Data) -> list[Check]:
    """Effect of menisci and drag on the slips, and the end of stick-slip."""
    force, drag = (float(v) for v in data["film"])
    slips = [data[f"slip_{i}"] for i in range(4)]
    dry, held, damped, ruptured = (float(s[1] - s[2]) for s in slips)
    ratio, fall = data["damping"]
    last = float(data["last"])
    time, length = data["other"]
    return [
        Check(
            "menisci raise the force at which the slider breaks away by mu_s times theirs",
            bool(abs(slips[1][1] - slips[0][1] - 0.3 * force) < 1e-12),
            f"{1e3 * slips[0][1]:.2f} to {1e3 * slips[1][1]:.2f} mN, meniscus force "
            f"{1e3 * force:.2f} mN",
        ),
        Check(
            "slips grow as load and menisci do, in films by far more if menisci rupture in motion",
            bool(abs(held / dry - 1.0 - force / BLOCK.load) < 1e-9 and ruptured > 1.5 * damped),
            f"fall of the force {1e3 * dry:.2f} and {1e3 * held:.2f} mN; with drag "
            f"{1e3 * damped:.2f} and, ruptured, {1e3 * ruptured:.2f} mN",
        ),
        Check(
            "the drag of the films shortens the slip",
            damped < 0.9 * held,
            f"{1e3 * held:.2f} to {1e3 * damped:.2f} mN, "
            f"{100 * drag / (2 * math.sqrt(BLOCK.stiffness * BLOCK.mass)):.0f} % of critical",
        ),
        Check(
            "a slip with drag is that of another integrator, to 1e-6",
            bool(abs(time / slips[2][0] - 1.0) < 1e-6 and abs(length / slips[2][3] - 1.0) < 1e-6),
            f"{1e3 * time:.5f} ms, {length / um:.3f} um",
        ),
        Check(
            "with drag the slider does not stick above some speed; without there is no such speed",
            bool(
                np.all((data["drop_2"] > 0.0) == (data["speeds"] < last))
                and np.all(data["drop_1"] > 0.0)
            ),
            f"{last:.3g} m/s",
        ),
        Check(
            "at critical damping there is no stick-slip, and before it less with more",
            bool(np.all(fall[ratio >= 1.0] == 0.0) and np.all(np.diff(fall) <= 1e-12)),
            f"ends at {ratio[fall > 0.0].max():.3g} of critical damping",
        ),
    ]


def table(data: Data) -> Table:
    """Numbers of one slip of each slider."""
    rows = []
    for i, name in enumerate(_sliders(1.0, 1.0)):
        taken, before, after, length = (float(v) for v in data[f"slip_{i}"])
        rows.append([name, 1e3 * before, 1e3 * after, length / um, 1e3 * taken])
    head = ("slider", "breaks away [mN]", "sticks again [mN]", "slip [um]", "takes [ms]")
    return Table(head, rows)


if __name__ == "__main__":
    run_page(__file__)
