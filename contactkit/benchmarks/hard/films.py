"""Hard cases of films in motion: stiff films, small openings, thin lenses."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping
from decimal import Decimal, localcontext
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from ...lubrication import couette_flat
from ...lubrication import squeeze_film as squeeze
from ...separation.plan import plan
from ...separation.simulate import simulate
from ..releases import release_cases, release_scene
from .case import Found

__all__ = ["explicit_steps", "small_opening", "sphere_impulse", "stiff_film", "thin_lens"]


def slopes(case: Mapping[str, Any], gap: float, speed: float) -> float:
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
    return float((case["F0"] - spring - viscous - meniscus) / case["m"])


def stiff_film() -> Found:
    """A mass on a film of 10 nm under a step of the pull, case D."""
    case, exact = release_cases()["D"]["case"], release_cases()["D"]["values"]["t_rel"]
    gap, speed, steps = case["h0"], 0.0, 0
    step = exact / 1e6
    while 0.0 < gap < case["h_rel"] and abs(speed) < 1e9:
        gap, speed = gap + step * speed, speed + step * slopes(case, gap, speed)
        steps += 1
    ours = simulate(plan(release_scene("D")))
    return Found(
        None,
        f"a gap of {gap:.1e} m at a speed of {speed:.1e} m/s after {steps} of a million steps",
        abs(ours.state.release_time / exact - 1.0),
        f"{ours.state.release_time:.6f} s in {ours.work.n_steps} steps",
    )


def explicit_steps() -> Found:
    """The same film by an explicit method with error control."""
    case, exact = release_cases()["D"]["case"], release_cases()["D"]["values"]["t_rel"]
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
    ours = simulate(plan(release_scene("D")))
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
