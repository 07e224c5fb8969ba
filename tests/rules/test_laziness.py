"""What an import brings along, and what runs where numpy is not installed."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from selection import quick

HEAVY = {"numpy", "scipy", "matplotlib", "fmpy", "pythonfmu", "numba", "cattrs", "tomli_w", "tqdm"}
MOST_MODULES = 70  # of contactkit itself; attrs and the standard library add some 45


def python(code, *arguments):
    """Run code in a fresh interpreter; give back what it prints as JSON."""
    environment = {**os.environ, "PYTHONWARNINGS": "error", "MPLBACKEND": "agg"}
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        capture_output=True,
        text=True,
        env=environment,
        check=False,
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


RUN = """
import json, sys, warnings
import contactkit as ck
from contactkit.planning import run

warnings.simplefilter("ignore")
found = []
scene = ck.load_scene(sys.argv[1])
found.append(sorted(sys.modules))
run(ck.plan(scene, ck.Accuracy(grid=16) if hasattr(scene, "window") else None))
found.append(sorted(sys.modules))
print(json.dumps(found))
"""
OIL_FILM = """
effects = [{ effect = "meniscus-force" }, { effect = "viscous-force" },
           { effect = "tension-limit", strength = 1e5 }]
[interface.lower]
shape = "flat"
radius = "1 mm"
[interface.upper]
shape = "flat"
radius = "1 mm"
[interface.meniscus]
volume = 1e-11
liquid = { name = "oil", viscosity = 0.1, surface_tension = 0.03 }
[loading]
kind = "imposed-speed"
speed = "1 mm/s"
initial_gap = "2 um"
final_gap = "10 um"
"""
DRY_CONTACT = """
effects = [{ effect = "half-space" }]
[interface.lower]
solid = { name = "steel", young_modulus = "210 GPa", poisson_ratio = 0.3 }
[interface.upper]
shape = "gaussian-roughness"
rms = "1 nm"
correlation_length = "0.2 um"
cutoff = "0.15 um"
[window]
width = "1 um"
[loading]
kind = "pressing"
pressure = "10 MPa"
"""
# Rooms that a scene file does not call for, from its reading to the end of its run.
UNUSED = {
    "oil film": (OIL_FILM, {"contact", "elasticity", "roughness", "adhesion", "analyses"}),
    "dry contact": (
        DRY_CONTACT,
        {"separation", "capillary", "lubrication", "adhesion", "as_published", "analyses"},
    ),
}
# What of the rooms that it does call for a scene does without.
LEFT_OUT = {
    "oil film": {"separation.effects.adhesion", "separation.face.cavity"},
    "dry contact": {
        *(f"contact.effects.{name}" for name in ("film", "stress", "adhesion", "island_bridges")),
        *(
            "contact.plastic_history",
            "contact.patches",
            "contact.slip.load_path",
            "elasticity.stress",
        ),
        *("roughness.spectra", "roughness.statistics", "roughness.contact_theories"),
    },
}


@pytest.mark.parametrize("name", quick(UNUSED, 0))
def test_a_scene_brings_the_rooms_it_calls_for_and_no_other(name, tmp_path):
    text, rooms = UNUSED[name]
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    for modules in python(RUN, str(tmp_path / "scene.toml")):
        ours = {m.partition(".")[2] for m in modules if m.startswith("contactkit.")}
        assert {m for m in ours if m.split(".")[0] in rooms} == set()
        assert {
            m for m in ours for left in LEFT_OUT[name] if f"{m}.".startswith(f"{left}.")
        } == set()
        assert len(ours) > 30  # else nothing was brought at all


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
