"""What an import brings along, and what runs where numpy is not installed."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

HEAVY = {"numpy", "scipy", "matplotlib", "fmpy", "pythonfmu", "numba", "cattrs", "tomli_w", "tqdm"}
MOST_MODULES = 70  # of contactkit itself; attrs and the standard library add some 45


def python(code):
    """Run code in a fresh interpreter; give back what it prints as JSON."""
    environment = {**os.environ, "PYTHONWARNINGS": "error", "MPLBACKEND": "agg"}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


# What one interpreter imports, a step after the other: what a step brings is all up to there.
STEPS = {
    "contactkit": "import contactkit as ck",
    "inside an FMU": """
import contactkit.separation.plan, contactkit.separation.motion.advance
import contactkit.separation.effects.meniscus, contactkit.separation.effects.viscous
import contactkit.separation.effects.rupture, contactkit.liquids.liquid
import contactkit.capillary.arc.flat, contactkit.lubrication.squeeze_film
import contactkit.lubrication.film_limits, contactkit.separation.integrator.radau""",
    "separation": "ck.simulate",
    "contact": """
ck.solve, ck.press, ck.load_scene, ck.study
import contactkit.contact.result, contactkit.contact.grid""",
    "all but plots": """
ck.save_result
import contactkit.files.contact_results, contactkit.work_precision, contactkit.cli""",
}


@pytest.fixture(scope="module")
def brought():
    """Modules that are there after each of the steps."""
    code = "import json, sys; before, after = set(sys.modules), {}\n"
    for name, step in STEPS.items():
        code += f"{step}\nafter[{name!r}] = sorted(set(sys.modules) - before)\n"
    return python(code + "print(json.dumps(after))")


def roots(modules):
    return {name.split(".")[0] for name in modules}


def test_importing_contactkit_stays_small(brought):
    modules = brought["contactkit"]
    assert roots(modules) & HEAVY == set()
    assert len([m for m in modules if m.startswith("contactkit")]) <= MOST_MODULES
    assert len(modules) <= 2 * MOST_MODULES


def test_what_runs_inside_an_fmu_needs_no_numpy(brought):
    assert roots(brought["inside an FMU"]) & HEAVY == set()


def test_the_control_sees_what_is_heavy(brought):
    """`simulate` needs numpy: if this finds none, the tests above prove nothing."""
    assert "numpy" in roots(brought["separation"])


def test_no_extra_is_brought_along_by_the_library(brought):
    """Neither by the import nor by a contact that runs without it."""
    extras = {"numba", "ducc0", "SurfaceTopography", "distributed", "pandas", "xarray"}
    assert roots(brought["contact"]) & extras == set()


def test_a_contact_brings_no_loop_and_no_statistics_it_does_not_call_for(brought):
    """Neither the histories of loads nor spectra, patches and theories of rough surfaces."""
    unused = (
        *("contact.plastic_history", "contact.patches", "analyses.area_over_load"),
        *("roughness.spectra", "roughness.statistics", "roughness.contact_theories"),
    )
    assert {f"contactkit.{name}" for name in unused} & set(brought["contact"]) == set()


def test_only_plot_brings_matplotlib(brought):
    assert "matplotlib" not in roots(brought["all but plots"])


WITHOUT_NUMPY = """
import json, sys
for name in ("numpy", "scipy", "cattrs"):
    sys.modules[name] = None  # importing it raises
import warnings
import contactkit as ck
from contactkit.separation.motion.state import outputs, start

oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
face = ck.Flat(radius=1e-3)
film = ck.Meniscus(liquid=oil, volume=3e-12, contact_angle_lower=0.2, contact_angle_upper=0.2)
found = []
for meniscus in (ck.MeniscusForce(), ck.MeniscusForce(profile="as-published")):
    for cavity in ("truncated", "reynolds"):
        made = ck.plan(ck.SeparationScene(
            interface=ck.Interface(lower=face, upper=face, meniscus=film),
            loading=ck.ImposedForce(initial_gap=1e-6, final_gap=1e-5, force=10.0, mass=1e-3),
            effects=(meniscus, ck.ViscousForce(), ck.ShearLimit(strength=1e6), ck.Rupture(gap=5e-6),
                     ck.TensionLimit(strength=1e6, cavity=cavity)),
        ))
        state = ck.advance(made, start(made), ck.Pull(10.0), 0.01)
        outputs(made, state, 10.0)
        found.append([state.release_time, state.break_time])
print(json.dumps(found))
"""


def test_a_film_between_flats_moves_without_numpy():
    """The interpreter a host embeds need not have it: release and rupture are found without."""
    for release, rupture in python(WITHOUT_NUMPY):
        assert 0.0 < rupture < release < 0.01
