"""Numbers that Python and C share: each is in a table here, and is the same on both sides."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
KERNEL = ROOT / "fmu/native/kernel"
DEFINED = re.compile(r"^#define (\w+) (\(?-?\.?\d[^\n]*?)u?(?:\s*/\*.*)?$", re.MULTILINE)

# File of the kernel: names in C, and where Python has the same number.
SHARED = {
    "step_size.h": (
        "contactkit/numerics/step_size.py",
        {f"CK_{n.upper()}": f"StepSize.{n}" for n in ("safety", "shrink", "grow", "unsolved")},
    ),
    "step.c": (
        "contactkit/separation/integrator/radau.py",
        "MOST_ITERATIONS LINEAR FAR RISING FAST TRAVEL IMPULSE",
    ),
    "motion.c": (
        "contactkit/separation/motion/advance.py",
        {"NOTHING": "_NO_GAP"},
        "NO_FORCE FOOT NO_TIME MOST_REJECTED",
        "contactkit/separation/motion/events.py",
        {"SAME": "SAME"},
        "contactkit/separation/motion/cavity.py",
        {"TURN": "_EVENT"},
        "contactkit/separation/integrator/dense_output.py",
        "SHORT",
    ),
    "model.c": ("fmu/framework/slave.py", "REST OFF"),
    "force.c": (
        "fmu/slaves/stiction_force.py",
        "SAME DOUBT",
        "fmu/slaves/film_travel.py",
        "VOID",
    ),
    "faces.c": (
        "contactkit/analyses/load_displacement/impact.py",
        "CLOSE",
        "contactkit/analyses/load_displacement/curve.py",
        "SAME",
    ),
    "coil.c": (
        "models/injector/coil.py",
        {"MOST_STEPS": "MOST_STEPS", "RTOL": "_FLUX_RTOL"},
        "KNEE",
    ),
    "drive.c": ("fmu/slaves/valve_drive.py", "MOST_SWITCHINGS"),
    "cavities/cavity.h": (
        "contactkit/lubrication/rupture_history.py",
        {"CK_RUPTURE_PIECES": "_MOST"},
    ),
    "cavities/disc.c": (
        "contactkit/lubrication/disc_cavity.py",
        "NARROW",
        "contactkit/separation/cavity/stages.py",
        "SMALLEST MOST_ITERATIONS ENOUGH",
    ),
    "cavities/events.c": (
        "contactkit/separation/cavity/events.py",
        "REFORMED NOTHING SAME SHALLOW RECEDES",
        "contactkit/numerics/events.py",
        "MOST_TRIALS QUICK MOST_SECANTS",
    ),
    "cavities/path.c": ("contactkit/separation/cavity/path.py", "FIRST EVENT"),
    "cavities/grid.c": (
        "contactkit/separation/face/cavity.py",
        {"REFORMED": "_FILLED"},
        "SAME INNER PER_STEP",
        "fmu/native/grid.py",
        {"MOST_CELLS": "MOST_CELLS", "MOST_FILL": "MOST_FILL"},
    ),
    "cavities/law.c": (
        "contactkit/separation/face/cavity.py",
        {"REFORMED": "_FILLED"},
        "PER_STEP",
        "contactkit/separation/motion/advance.py",
        {"DISC_COST": "_CAVITY_COST"},
    ),
    "cavities/obstacle.c": (
        "contactkit/lubrication/reynolds/complementarity.py",
        {"ROUND_OFF": "ROUND_OFF"},
    ),
    "deforming/stages.c": (
        "contactkit/lubrication/elastohydrodynamic/step.py",
        {"MOST_ITERATIONS": "_MOST"},
        "SOLVED STALLED CONTRACTION LEAST_GAP",
        "contactkit/lubrication/elastohydrodynamic/follow.py",
        "EXTRAPOLATED",
    ),
    "deforming/deforming.c": (
        "contactkit/lubrication/elastohydrodynamic/follow.py",
        {
            "FIRST": "Control.first",
            "LOCATED": "located",
            "AFTER_RUPTURE": "after_rupture",
            "SAFETY": "StepSize(safety)",
            "GROW": "StepSize(grow)",
        },
    ),
    "rheology/rheology.c": ("fmu/native/ratios.py", "DEGREE"),
    "tips/impact.c": (
        "models/micromirror/tip_impact.py",
        {"PARTS": "_OUT_PIECES", "GROW": "StepSize(grow)", "UNSOLVED": "StepSize(unsolved)"},
    ),
    "tips/tip.c": ("models/micromirror/tip.py", "PIECE"),
    "tips/tip.h": ("models/micromirror/flight.py", {"CK_MOST_SWINGS": "_MOST_SWINGS"}),
}
# Numbers that C alone needs: how it reads files and hosts, where it is another algorithm than
# Python's, and constants of mathematics.
OWN = {
    "model.c": "HEAD",
    "film.c": "WIDEST MOST_PANELS NARROW DEEPEST",
    "root.h": "CK_MOST_EVALUATIONS",
    "data.c": "MOST_NUMBERS",
    "derivative.c": "STEP",
    "faces.c": "ROUNDS",
    "limits.c": "ROUND_OFF",
    "force.c": "MOST_STOPS MOST_COST",
    "drive.c": "MU0 MOST_STEPS CLOSE",
    "step.c": "R6",
    "fmi/host.c": "SLOTS",
    "cavities/cavity.h": "CK_PI",
    "cavities/grid.c": "FULL WITHIN",
    "cavities/obstacle.c": "TIED MOST_SETS MANY_SETS",
    "cavities/factor.c": "SINGULAR",
    "cavities/law.c": "CELLS_PER_COST",
    "rheology/rheology.c": "EDGE NEAR",
    "tips/flight.c": "PI",
    "tips/impact.c": "SAME SAME_FRACTION",
    "deforming/bodies.c": "R6 MOST_RINGS",
    "deforming/rings.c": "TWO_PI",
    "deforming/stages.c": "NO_PART NO_FORCE REFINED",
    "deforming/deforming.c": "LIGHTEST NO_LENGTH",
}


def number(text):
    """Value of a number, or of arithmetic of numbers, as Python and C write it; None of others."""
    try:
        return eval(compile(text, "number", "eval"), {"__builtins__": {}})
    except (NameError, SyntaxError, TypeError):
        return None


def defined(text):
    """Numbers that a source of C defines, by name."""
    found = {name: number(value.strip()) for name, value in DEFINED.findall(text)}
    return {name: value for name, value in found.items() if value is not None}


@cache
def in_python(path):
    """Numbers of a module, defaults of its classes, and what it gives to the control of steps."""
    found = {}
    for node in ast.walk(ast.parse((ROOT / path).read_text("utf-8"))):
        if isinstance(node, ast.ClassDef):
            inside = [one for one in node.body if isinstance(one, ast.AnnAssign) and one.value]
            found |= {f"{node.name}.{one.target.id}": one.value for one in inside}
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple):
            if isinstance(node.value, ast.Tuple):
                names = [getattr(one, "id", "") for one in node.targets[0].elts]
                found |= dict(zip(names, node.value.elts, strict=False))
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found.setdefault(node.targets[0].id, node.value)
        elif isinstance(node, ast.Call) and getattr(node.func, "id", "") == "StepSize":
            found |= {f"StepSize({one.arg})": one.value for one in node.keywords}
    return {name: number(ast.unparse(value)) for name, value in found.items()}


def pairs(said):
    """Name in C, file of Python and name there, of an entry of the table."""
    path = ""
    for one in said:
        if isinstance(one, dict):
            yield from ((here, path, there) for here, there in one.items())
        elif one.endswith(".py"):
            path = one
        else:
            yield from ((name, path, f"_{name}") for name in one.split())


@pytest.mark.parametrize("source", SHARED)
def test_a_number_is_the_same_in_python_and_c(source):
    here = defined((KERNEL / source).read_text("utf-8"))
    unlike = {
        name: (here.get(name), in_python(path).get(there))
        for name, path, there in pairs(SHARED[source])
        if here.get(name) is None or here[name] != in_python(path).get(there)
    }
    assert unlike == {}


def test_every_number_of_c_is_shared_or_its_own():
    """A new one needs a line in one of the tables above."""
    found, listed = set(), set()
    for path in sorted([*KERNEL.rglob("*.c"), *KERNEL.rglob("*.h")]):
        source = path.relative_to(KERNEL).as_posix()
        found |= {(source, name) for name in defined(path.read_text("utf-8"))}
    for source, said in SHARED.items():
        listed |= {(source, name) for name, _, _ in pairs(said)}
    listed |= {(source, name) for source, names in OWN.items() for name in names.split()}
    assert found == listed


def test_another_number_would_be_seen():
    text = "#define A 1e-3 /* of B */\n#define B (2.0 * 3.0)\n#define C 16u\n#define D (1.0 / A)\n"
    assert defined(text) == {"A": 1e-3, "B": 6.0, "C": 16}
    assert in_python("contactkit/numerics/step_size.py")["StepSize.grow"] == 8.0
