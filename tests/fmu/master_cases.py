"""The release cases as the master takes them."""

from __future__ import annotations

import math

from contactkit.fmu.master.couple import AdaptiveSteps, Fmu, Mass, couple


def ramp(force, time):
    """Pull that rises to a force with a time constant; a step for 0."""
    return (lambda t: force) if time == 0.0 else lambda t: -force * math.expm1(-t / time)


def film_values(case):
    kept = ("h0", "R", "eta", "gamma", "V", "dp_cav", "tau_lim")
    angles = {"theta1": case["theta"], "theta2": case["theta"]}
    return {name: case[name] for name in kept} | angles | {"meniscus_law": "PUBLISHED"}


def release(film, case, until, steps=None, start=None, **more):
    return couple(
        Fmu(film, film_values(case) | (start or {})),
        Mass(mass=case["m"], stiffness=case["k_s"]),
        ramp(case["F0"], case["tau"]),
        until,
        release_gap=case["h_rel"],
        steps=steps or AdaptiveSteps(),
        **more,
    )
