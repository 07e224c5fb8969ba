"""Hard cases of films in motion: stiff films, small openings, thin lenses."""

from __future__ import annotations

import contextlib
import json
import math
from decimal import Decimal, localcontext
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.lubrication import couette_flat
from contactkit.lubrication import squeeze_film as squeeze

from .hard_case import Found, HardCase

__all__ = ["CASES"]

DATA = Path(__file__).parents[3] / "tests" / "data"
RELEASE = json.loads((DATA / "release.json").read_text(encoding="utf-8"))


def release_scene(case: dict[str, Any]) -> ck.SeparationScene:
    """A mass pulled off a film, as in tests/data/release.json."""
    face = ck.Flat(radius=case["R"])
    oil = ck.Liquid(name="oil", viscosity=case["eta"], surface_tension=case["gamma"])
    film = ck.Meniscus(
        liquid=oil,
        volume=case["V"] or None,
        contact_angle_lower=case["theta"],
        contact_angle_upper=case["theta"],
    )
    loading = ck.ImposedForce(
        initial_gap=case["h0"],
        final_gap=case["h_rel"],
        force=case["F0"],
        mass=case["m"],
        stiffness=case["k_s"],
        rise_time=case["tau"],
    )
    effects = [ck.MeniscusForce(profile=ck.AsPublished(radius="disc")), ck.ViscousForce()]
    if case["dp_cav"]:
        effects.append(ck.TensionLimit(strength=case["dp_cav"], cavity="truncated"))
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=loading,
        effects=tuple(effects),
    )


def slopes(case: dict[str, Any], gap: float, speed: float) -> float:
    """Acceleration of the mass: pull, spring, Stefan's force and the meniscus of a drop."""
    volume, cosine = case["V"], math.cos(case["theta"])
    square = volume / (math.pi * gap) if volume else case["R"] ** 2
    viscous = 1.5 * math.pi * case["eta"] * square**2 * speed / gap**3
    neck = math.sqrt(square)
    meniscus = (
        math.pi
        * case["gamma"]
        * (2.0 * square * cosine / gap + 2.0 * neck * math.sin(case["theta"]))
    )
    spring = case["k_s"] * (gap - case["h0"])
    return (case["F0"] - spring - viscous - meniscus) / case["m"]


def stiff_film() -> Found:
    """A mass on a film of 10 nm under a step of the pull, case D."""
    case, exact = RELEASE["D"]["case"], RELEASE["D"]["values"]["t_rel"]
    gap, speed, steps = case["h0"], 0.0, 0
    step = exact / 1e6
    while 0.0 < gap < case["h_rel"] and abs(speed) < 1e9:
        gap, speed = gap + step * speed, speed + step * slopes(case, gap, speed)
        steps += 1
    made = ck.plan(release_scene(case))
    ours = ck.simulate(made)
    assert ours.state is not None
    return Found(
        None,
        f"a gap of {gap:.1e} m at a speed of {speed:.1e} m/s after {steps} of a million steps",
        abs(ours.state.release_time / exact - 1.0),
        f"{ours.state.release_time:.6f} s in {ours.work.n_steps} steps",
    )


def explicit_steps() -> Found:
    """The same film by an explicit method with error control."""
    case, exact = RELEASE["D"]["case"], RELEASE["D"]["values"]["t_rel"]
    most = 20_000

    class Enough(Exception):
        """The number of evaluations is spent."""

    count, reached = 0, 0.0

    def right(t: float, y: np.ndarray) -> list[float]:
        nonlocal count, reached
        count += 1
        reached = max(reached, t)
        if count >= most:
            raise Enough
        return [y[1], slopes(case, max(y[0], 1e-12), y[1])]

    with contextlib.suppress(Enough):
        solve_ivp(right, (0.0, exact), [case["h0"], 0.0], rtol=1e-6, atol=1e-15)
    ours = ck.simulate(ck.plan(release_scene(case)))
    assert ours.state is not None
    return Found(
        None,
        f"{count} evaluations to get to {reached:.0e} s of {exact:.3g} s",
        abs(ours.state.release_time / exact - 1.0),
        f"{ours.work.n_evaluations} evaluations for all of it",
    )


def small_opening() -> Found:
    """The impulse of a film that opens by a billionth of its gap."""
    start, end = 1e-6, 1e-6 * (1.0 + 1e-9)
    naive = 0.75 * math.pi * 0.1 * 1e-12 * (1.0 / start**2 - 1.0 / end**2)
    ours = float(squeeze.disc_impulse_flooded(1e-3, start, end, 0.1))
    with localcontext(prec=60):
        a, b = Decimal(start), Decimal(end)
        fall = float(1 / a**2 - 1 / b**2)
    exact = 0.75 * math.pi * 0.1 * 1e-12 * fall
    return Found(
        abs(naive / exact - 1.0),
        f"{naive:.8g} N.s",
        abs(ours / exact - 1.0),
        f"{ours:.8g} N.s",
    )


def sphere_impulse() -> Found:
    """The impulse on a sphere whose film is hardly higher than its gap, Eq. (3.26)."""
    low, high = 1e-9, 1e-9 * (1.0 + 1e-6)
    ours = float(squeeze.sphere_impulse_conserved(5e-3, high, low, math.inf, 0.1))
    front = 6.0 * math.pi * 0.1 * 25e-6
    q = high / low
    naive = front * (2.0 * math.log(1.0 + q) - math.log(4.0 * q))
    with localcontext(prec=60):
        ratio = Decimal(high) / Decimal(low)
        exact = front * float(2 * (1 + ratio).ln() - (4 * ratio).ln())
    return Found(
        abs(naive / exact - 1.0),
        f"{naive:.4g} N.s",
        abs(ours / exact - 1.0),
        f"{ours:.8g} N.s",
    )


def thin_lens() -> Found:
    """The area of two wetted circles that overlap by 1e-12 of their radius."""
    travel = 2.0 - 1e-12
    q = 0.5 * travel
    naive = 2.0 * (math.acos(q) - q * math.sqrt(1.0 - q * q))
    ours = float(couette_flat.lens_area(1.0, travel))
    with localcontext(prec=60):
        left = 1 - Decimal(q)
        # half = arccos(1 - left) by its series; the area is 2 half - sin(2 half)
        half = (2 * left).sqrt() * (1 + left / 12 + 3 * left**2 / 160)
        x = 2 * half
        exact = float(x**3 / 6 - x**5 / 120 + x**7 / 5040)
    return Found(
        abs(naive / exact - 1.0),
        f"{naive:.4g} x^2",
        abs(ours / exact - 1.0),
        f"{ours:.4g} x^2",
    )


CASES = (
    HardCase(
        key="stiff-film",
        half="separation",
        title="A mass on an oil film of 10 nm",
        why="The film answers a speed within 1e-12 s, the mass is released after 2 s.",
        naive="explicit Euler, a million steps",
        ours="implicit Runge-Kutta (Radau IIA of order 5) in a coordinate in which the impulse of "
        "the film is nearly linear",
        judge="two other codes that agree to 1e-9",
        tested="tests/separation/test_motion_hard.py",
        holds=1e-8,
        fails=math.inf,
        run=stiff_film,
    ),
    HardCase(
        key="stiff-film-adaptive",
        half="separation",
        title="The same film with error control",
        why="Stability, not accuracy, bounds the steps of an explicit method.",
        naive="Runge and Kutta's method of order 5 with adaptive steps (scipy, RK45)",
        ours="the same implicit method",
        judge="two other codes that agree to 1e-9",
        tested="tests/separation/test_motion_hard.py",
        holds=1e-8,
        fails=math.inf,
        run=explicit_steps,
    ),
    HardCase(
        key="small-opening",
        half="separation",
        title="The impulse of an opening by a billionth of the gap",
        why="A small communication step of a stiff film: the impulse is the difference of two "
        "numbers that agree in nine digits.",
        naive="1/h0^2 - 1/h1^2",
        ours="the difference as a product of factors that do not cancel",
        judge="60 digits",
        tested="tests/separation/test_film_hard.py",
        holds=1e-14,
        fails=1e-9,
        run=small_opening,
    ),
    HardCase(
        key="sphere-impulse",
        half="separation",
        title="A sphere whose film is hardly higher than its gap",
        why="The closed form of the source, Eq. (3.26), is a difference of logarithms of "
        "second order in what is left.",
        naive="ln (1 + q)^2 - ln 4q",
        ours="one log1p of a sum of positive terms",
        judge="60 digits",
        tested="tests/separation/test_separation_section5.py",
        holds=1e-8,
        fails=1e-5,
        run=sphere_impulse,
    ),
    HardCase(
        key="thin-lens",
        half="separation",
        title="Sliding circles that hardly overlap",
        why="The area falls as the 3/2 power of the overlap, its two terms as the 1/2 power.",
        naive="arccos q - q sqrt(1 - q^2)",
        ours="the angle by arctan2 of factors, and its sine taken off by a series",
        judge="series in 60 digits",
        tested="tests/separation/sliding/test_sliding_hard.py",
        holds=1e-12,
        fails=1e-6,
        run=thin_lens,
    ),
)
