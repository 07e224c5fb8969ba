"""Films that cavitate: exact cases of discs, and start values of FMUs for them."""

from __future__ import annotations

import json
import math
from pathlib import Path

from contactkit.fmu.slaves.stiction_mass import MeniscusLaw

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[1] / "data" / "film.json").read_text())["cases"]
}
PULLED = [name for name in CASES if name.startswith("pull_") and "jfo" in name]
OSCILLATION = CASES["oscillating_disc_0.005"]


def pulled(case):
    """Start values of a case in which a disc is pulled apart."""
    given = case["inputs"]
    volume = math.pi * given["radius"] ** 2 * given["initial_gap"]
    return {
        "R": given["radius"],
        "h0": given["initial_gap"],
        "h_rel": given["final_gap"],
        "eta": given["viscosity"],
        "m": given["mass"],
        "V": 0.0 if given["rim"].startswith("flooded") else volume,
        "meniscus_law": MeniscusLaw.NONE,
        "dp_inception": given.get("tension") or given["tension_to_nucleate"],
        "dp_hold": given.get("tension_of_cavity") or 0.0,
    }


def oscillating(time):
    """Gap [m] and speed [m/s] of the oscillating disc."""
    given = OSCILLATION["inputs"]
    mean, amplitude = given["gap_mean"], given["gap_amplitude"]
    rate = 2.0 * math.pi * given["frequency"]
    phase = rate * time
    return mean - amplitude * math.cos(phase), amplitude * rate * math.sin(phase)


def film_values(**more):
    """Start values of the film of the oscillating disc."""
    given = OSCILLATION["inputs"]
    gap = oscillating(0.0)[0]
    return {
        "R": given["radius"],
        "h0": gap,
        "h": gap,
        "eta": given["viscosity"],
        "meniscus_law": MeniscusLaw.NONE,
        "dp_inception": given["p_out"],
        **more,
    }
