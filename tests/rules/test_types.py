"""What a type checker sees of the public names: the class of a scene decides, no unions."""

from __future__ import annotations

import inspect
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import contactkit as ck

ROOT = Path(__file__).parents[2]

# A line of a user's program, and the type that a checker reveals.
REVEALED = {
    "ck.plan(touch)": "ContactPlan",
    "ck.plan(film)": "Plan",
    "ck.plan(slide)": "SlidingPlan",
    "ck.solve(ck.plan(touch))": "ContactResult",
    "ck.simulate(ck.plan(film))": "SeparationResult",
    "ck.simulate(ck.plan(slide))": "SlidingResult",
    "pressed.plan.scene": "ContactScene",
    "pulled.plan.scene": "SeparationScene",
    "pulled.state": "MotionState",
    "pressed.contact_area": "float",
    "pressed.of(ck.HardnessLimit)": "PlasticPart",
    "pressed.of(ck.PlasticHistory)": "PlasticHistoryPart",
    "pressed.of(ck.Viscoelasticity)": "ViscoelasticityPart",
    "pressed.of(ck.SubsurfaceStress)": "StressPart",
    "pressed.of(ck.FilmMeniscus)": "FilmPart",
    "pressed.of(ck.IslandBridges)": "IslandPart",
    "pressed.of(ck.FrictionTraction)": "FrictionPart",
    "pressed.of(ck.Adhesion)": "AdhesionPart",
    "pulled.of(ck.MeniscusForce)": "ForcePart",
    "pulled.of(ck.ViscousForce)": "ViscousPart",
    "pulled.of(ck.AsperityMenisci)": "AsperityPart",
    "pulled.of(ck.AdhesiveContact)": "AdhesionPart",
    "pulled.of(ck.TensionLimit)": "LimitPart",
    "slid.of(ck.CouetteForce)": "CouettePart",
    "touch.effect(ck.HardnessLimit)": "HardnessLimit | None",
    "ck.study(touch, {}).results[0]": "ContactResult | None",
    "ck.study(film, {}).results[0]": "SeparationResult | None",
    "ck.study(slide, {}).results[0]": "SlidingResult | None",
    'ck.load_scene("a.toml", ck.ContactScene)': "ContactScene",
    "ck.load_result(path, ck.SeparationResult)": "SeparationResult",
    "ck.press([[0.0]], 1e-9, steel, 1e6)": "ContactResult",
    "ck.pull_off_curve(ck.plan(touch), [0.0, 1e-9])": "PullOffCurve",
    "ck.load_displacement(touch)": "LoadDisplacementCurve",
    "ck.read_curve(path)": "SavedCurve",
    'ck.capillary_force("10 um", 0.7)': "float",
    "ck.squeeze_time(1.0, 1e-3, 0.1, 1e-6)": "float",
}
HEAD = """\
from pathlib import Path
import contactkit as ck
def of(touch: ck.ContactScene, film: ck.SeparationScene, slide: ck.SlidingScene) -> None:
    pressed, pulled = ck.solve(ck.plan(touch)), ck.simulate(ck.plan(film))
    slid, steel, path = ck.simulate(ck.plan(slide)), ck.load_material("dlc"), Path("a.npz")
"""
WRONG = {  # what a checker refuses
    "ck.simulate(film)": "call-overload",
    "ck.solve(ck.plan(film))": "arg-type",
    "pulled.viscus_force": "attr-defined",
    "pressed.of(ck.ViscousForce)": "arg-type",
    "ck.Flat(radios=1.0)": "call-arg",
}


@pytest.fixture
def program(tmp_path):
    """A user's program, with a line for each expression, beside the package as it is installed."""
    (tmp_path / "contactkit").mkdir()
    parts = [*(ROOT / "contactkit").iterdir(), ROOT / "fmu", ROOT / "models"]
    for part in (*parts, ROOT / "examples" / "gallery"):
        (tmp_path / "contactkit" / part.name).symlink_to(part)
    lines = [f"    reveal_type({line})" for line in REVEALED] + [f"    {line}" for line in WRONG]
    path = tmp_path / "program.py"
    path.write_text(HEAD + "\n".join(lines) + "\n")
    return path


def expected():
    """Line number of each expression."""
    begin = HEAD.count("\n") + 1
    return {begin + i: line for i, line in enumerate([*REVEALED, *WRONG])}


def short(text):
    """A type without the modules of its parts; a named tuple by its name."""
    text = re.sub(r"\b(?:\w+\.)+(\w+)", r"\1", text)
    return re.sub(r"tuple\[.*fallback=(\w+)\]", r"\1", text)


def first_arguments():
    """Name and annotation of the first argument of each public function, and all its arguments."""
    for name in ck.__all__:
        function = getattr(ck, name)
        if inspect.isfunction(function):
            given = list(inspect.signature(function).parameters.values())
            if given:
                yield name, given[0].name, str(given[0].annotation), {one.name for one in given}


def test_the_first_argument_is_a_plan_that_is_solved_or_a_scene_that_is_planned():
    """The rule of the API page: what takes a plan has no accuracy beside it."""
    wrong = []
    for function, name, kind, arguments in first_arguments():
        if kind.endswith("Plan"):
            is_right = name == "plan" and "accuracy" not in arguments
        elif "Scene" in kind:
            is_right = name == ("wetted" if "Result" in kind else "scene")
        else:
            is_right = name not in ("plan", "scene") or kind == "Any"  # of a device, too
        wrong += [] if is_right else [function]
    assert wrong == []


def test_counts_have_one_name_and_no_public_function_returns_any():
    found = {name: getattr(ck, name) for name in ck.__all__}
    functions = {name: one for name, one in found.items() if inspect.isfunction(one)}
    untyped = [n for n, f in functions.items() if f.__annotations__.get("return") in (None, "Any")]
    assert untyped == []
    counted = {"number", "count", "counts", "slips", "unloadings", "refinements", "vary", "answer"}
    taken = {n: counted & set(inspect.signature(f).parameters) for n, f in functions.items()}
    del taken["published"]  # the number of an equation
    assert not any(taken.values()), taken


@pytest.mark.slow
def test_mypy_sees_what_a_result_holds(program):
    """With what `make lint` left in its cache: without, the package takes 15 s."""
    pytest.importorskip("mypy")
    settings = ["--config-file", str(ROOT / "pyproject.toml")]
    settings += ["--cache-dir", str(ROOT / "build" / "typed" / ".mypy_cache")]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *settings, program.name],
        cwd=program.parent,
        env={"PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    lines, seen = expected(), {}
    for number, said in re.findall(r"program\.py:(\d+): (?:note|error): (.*)", done.stdout):
        seen.setdefault(lines.get(int(number)), said)
    quoted = {line: re.search(r"\"(.*)\"", said) for line, said in seen.items()}
    revealed = {line: short(quoted[line][1]) for line in REVEALED if quoted.get(line)}
    assert revealed == REVEALED, done.stdout
    taken = [line for line, kind in WRONG.items() if f"[{kind}]" not in seen.get(line, "")]
    assert taken == []


@pytest.mark.slow
def test_pyright_sees_the_same(program):
    name = shutil.which("pyright") or shutil.which("basedpyright")
    if name is None:
        pytest.skip("neither pyright nor basedpyright is installed")
    settings = {"extraPaths": [str(ROOT)], "include": [program.name], "typeCheckingMode": "basic"}
    (program.parent / "pyrightconfig.json").write_text(json.dumps(settings))
    done = subprocess.run(
        [name, "--outputjson", "--pythonpath", sys.executable],
        cwd=program.parent,
        capture_output=True,
        text=True,
        check=False,
    )
    try:
        found = json.loads(done.stdout)["generalDiagnostics"]
    except (json.JSONDecodeError, KeyError):
        pytest.skip(f"{name} does not run here: {(done.stderr or done.stdout)[-200:]}")
    lines, revealed, refused = expected(), {}, set()
    for one in found:
        line = lines.get(one["range"]["start"]["line"] + 1)
        if match := re.search(r"is \"(.*)\"", one["message"]):
            revealed[line] = short(match[1])
        if one["severity"] == "error":
            refused.add(line)
    assert {line: revealed.get(line) for line in REVEALED} == REVEALED
    assert refused >= set(WRONG)
