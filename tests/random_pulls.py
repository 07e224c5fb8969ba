"""Random pulls of a mass on a squeeze film, and a solution with no code of contactkit.

``python tests/random_pulls.py`` solves the thousand pulls of each test anew (80 s) and keeps the
solutions in tests/data.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

import contactkit as ck

__all__ = ["Pulled", "Released", "as_step", "exact", "kept", "pulls", "scene_of", "units"]

KEPT = Path(__file__).parent / "data" / "pulls.npz"
BEFORE = 0.999  # of the time of release, where a communication step ends
FACE, GAP, OIL, PULL = 3.175e-3, 5e-6, 0.1, 40.0


class Pulled(NamedTuple):
    """A pull, without dimensions: times over c0 h0/F, gaps over h0, speeds over F/c0."""

    exponent: int  # of the film: 3 flooded, 5 of fixed volume
    inertia: float  # m v/(F t) at the start
    opening: float
    rise: float  # of the pull; 0: a step
    spring: float  # its force at release over the pull


class Released(NamedTuple):
    """Time and speed at release; gap, speed and acceleration a little before."""

    time: float
    speed: float
    before: tuple[float, float, float]


def pulls(count, seed=1):
    """Pulls over 18 decades of inertia, openings of 1.01 to 30, with rise time or spring or not.

    Not with a slow rise and a spring: such a mass swings, or hangs on its spring, and a small error
    of its time is a large one of its speed.
    """
    rng = np.random.default_rng(seed)
    made = []
    for _ in range(count):
        rise = 10.0 ** rng.uniform(-6.0, 1.5) if rng.random() < 0.4 else 0.0
        spring = rng.uniform(0.02, 0.9) if rng.random() < 0.4 else 0.0
        made.append(
            Pulled(
                exponent=3 if rng.random() < 0.5 else 5,
                inertia=10.0 ** rng.uniform(-12.0, 6.0),
                opening=1.0 + 10.0 ** rng.uniform(-2.0, math.log10(29.0)),
                rise=rise if not spring else min(rise, 1e-2),
                spring=spring,
            )
        )
    return made


def exact(pull):
    """Motion to release by LSODA of scipy, in the logarithm of the gap, to some 1e-11."""
    n, inertia, rise = pull.exponent, pull.inertia, pull.rise
    stiffness = pull.spring / (pull.opening - 1.0)
    end = math.log(pull.opening)

    def slope(time, y):
        x, speed = y
        force = -math.expm1(-time / rise) if rise else 1.0
        net = force - stiffness * math.expm1(x) - speed * math.exp(-n * x)
        return [speed * math.exp(-x), net / inertia]

    def slopes(_time, y):
        x, speed = y
        held = -stiffness * math.exp(x) + n * speed * math.exp(-n * x)
        first = [-speed * math.exp(-x), math.exp(-x)]
        return [first, [held / inertia, -math.exp(-n * x) / inertia]]

    def there(_time, y):
        return y[0] - end

    there.terminal, there.direction = True, 1.0
    found = solve_ivp(
        slope,
        (0.0, 1e12),
        [0.0, 0.0],
        "LSODA",
        jac=slopes,
        events=there,
        dense_output=True,
        rtol=1e-12,
        atol=[1e-14, 1e-30],
        first_step=1e-3 * min(inertia, math.sqrt(inertia), rise or 1.0, 1.0),
    )
    time = float(found.t_events[0][0])
    x, speed = found.sol(BEFORE * time)
    before = math.exp(x), float(speed), float(slope(BEFORE * time, (x, speed))[1])
    return Released(time, float(found.y_events[0][0][1]), before)


def as_step(pull):
    """The pull as a step: an FMU has no rise time of its own."""
    return pull._replace(rise=0.0)


def kept(name):
    """Solutions that are kept: of pulls with a rise ("pulls"), or of steps ("steps")."""
    with np.load(KEPT) as data:
        return [Released(row[0], row[1], tuple(row[2:])) for row in data[name].tolist()]


def units():
    """Time [s] and speed [m/s] of the numbers without dimensions, and the damping at the start."""
    damping = 1.5 * math.pi * OIL * FACE**4 / GAP**3
    return damping * GAP / PULL, PULL / damping, damping


def scene_of(pull):
    """The same pull of a disc with an oil film."""
    time, speed, _ = units()
    volume = math.pi * FACE**2 * GAP if pull.exponent == 5 else None
    face = ck.Flat(radius=FACE)
    meniscus = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=OIL), volume=volume)
    loading = ck.ImposedForce(
        initial_gap=GAP,
        final_gap=GAP * pull.opening,
        force=PULL,
        mass=pull.inertia * PULL * time / speed,
        rise_time=pull.rise * time,
        stiffness=pull.spring * PULL / (GAP * (pull.opening - 1.0)),
        time_limit=1e6 * time * max(1.0, math.sqrt(pull.inertia)),
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=meniscus),
        loading=loading,
        effects=(ck.ViscousForce(),),
    )


if __name__ == "__main__":
    solved = {
        "pulls": [exact(pull) for pull in pulls(1000, seed=1)],
        "steps": [exact(as_step(pull)) for pull in pulls(1000, seed=2)],
    }
    rows = {name: [(*r[:2], *r.before) for r in found] for name, found in solved.items()}
    np.savez_compressed(KEPT, **rows)
