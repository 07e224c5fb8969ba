"""The rules of the house: units, sources, docstrings, short modules, no machine in the files."""

from __future__ import annotations

import ast
import doctest
import functools
import importlib
import inspect
import pkgutil
import re
import subprocess
import typing
from pathlib import Path

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.effects.base import (
    Compliance,
    ContactEffect,
    DisplacementTerm,
    LoadTerm,
    Observer,
    PressureCap,
)
from contactkit.liquids.liquid import LAWS
from contactkit.separation.effects.base import (
    Effect,
    FilmEnd,
    FilmLimit,
    SeparationEffect,
    SeparationForce,
)
from contactkit.separation.sliding.effects import SlidingForce

ROOT = Path(__file__).parents[2]
SOURCES = ("contactkit", "fmu", "models", "examples")
MOST_LINES_OF_A_FUNCTION = 75  # as the formatter lays them out

NOUNS = [
    ck.Accuracy,
    ck.AsperityPopulation,
    ck.Body,
    ck.CombinedSurface,
    ck.ContactInterface,
    ck.ContactScene,
    ck.Flat,
    ck.GaussianRoughness,
    ck.HardnessMap,
    ck.Heights,
    ck.Interface,
    ck.Layer,
    ck.Liquid,
    ck.Material,
    ck.Measured,
    ck.Meniscus,
    ck.Opening,
    ck.Paraboloid,
    ck.Pressing,
    ck.SelfAffineRoughness,
    ck.SeparationScene,
    ck.Sliding,
    ck.SlidingScene,
    ck.Sphere,
    ck.Stack,
    ck.Vibration,
    ck.Wave,
    ck.Window,
]
DESCRIBED = [*NOUNS, *ck.EFFECTS, *LAWS]


def python_files():
    return sorted(path for folder in SOURCES for path in (ROOT / folder).rglob("*.py"))


def label(path):
    return path.relative_to(ROOT).as_posix()


each_file = pytest.mark.parametrize("path", python_files(), ids=label)


@functools.cache
def tree_of(path):
    return ast.parse(path.read_text(encoding="utf-8"))


# Units --------------------------------------------------------------------------------------


def has_number(annotation):
    """Whether a type has float or int in it, at any depth."""
    if annotation in (float, int):
        return True
    return any(has_number(part) for part in typing.get_args(annotation))


def resolved(kind):
    """Fields of a noun with their types; attrs resolves these once, for the converter too."""
    # What modules import for checkers alone; a map of numbers is an Array, with its unit.
    names = {"SeparationEffect": SeparationEffect, "ContactEffect": ContactEffect}
    names["Map"] = typing.Any
    return attrs.fields(attrs.resolve_types(kind, localns=names))


@pytest.mark.parametrize("kind", DESCRIBED, ids=lambda kind: kind.__name__)
def test_every_number_carries_its_unit(kind):
    annotations = {}
    for owner in reversed(kind.__mro__):
        annotations |= vars(owner).get("__annotations__", {})
    bare = [
        a.name
        for a in resolved(kind)
        if (has_number(a.type) or annotations[a.name] == "Map") and not a.metadata.get("unit")
    ]
    assert bare == []


def test_every_noun_is_described():
    """Every public class with fields is in the list above."""
    public = [getattr(ck, name) for name in ck.__all__]
    nouns = {kind for kind in public if isinstance(kind, type) and attrs.has(kind)}
    # While running, not described.
    made = {ck.Plan, ck.ContactPlan, ck.SlidingPlan, ck.MotionState, ck.Pull}
    assert nouns - made <= {*DESCRIBED}


@pytest.mark.parametrize("kind", DESCRIBED, ids=lambda kind: kind.__name__)
def test_every_unit_is_of_the_international_system(kind):
    """A factor of 1, so that a number without a unit means what the code takes it for."""
    for a in attrs.fields(kind):
        if "unit" in a.metadata:
            assert ck.units.parse_unit(a.metadata["unit"]).factor == 1.0, a.name


def test_a_number_without_a_unit_would_be_seen():
    @attrs.frozen
    class Bare:
        length: float | None = None

    assert has_number(attrs.fields(attrs.resolve_types(Bare)).length.type)


# Effects ------------------------------------------------------------------------------------


REQUIRED = {
    ck.ShearLimit: {"strength": 1e6},
    ck.VanDerWaalsForce: {"hamaker_constant": 1e-19},
    ck.AdhesiveContact: {"work_of_adhesion": 0.05, "reduced_modulus": 1e9},
    ck.FrictionTraction: {"coefficient": 0.2},
    ck.FilmMeniscus: {"film_thickness": 1e-9},
    ck.ContactAngleHysteresis: {"advancing_lower": 1.0, "receding_lower": 0.8},
    ck.AsperityMenisci: {"asperities": ck.AsperityPopulation(density=1e12, radius=1e-6)},
}


def examples_of(kind):
    """One object of an effect for each of its choices."""
    needed = REQUIRED.get(kind, {})
    yield kind(**needed)
    for a in resolved(kind):
        for choice in typing.get_args(a.type):
            for value in typing.get_args(choice) or (choice,):
                if isinstance(value, str):
                    yield kind(**{**needed, a.name: value})


@pytest.mark.parametrize("kind", ck.EFFECTS, ids=lambda kind: kind.__name__)
def test_every_effect_says_what_it_is_and_where_it_comes_from(kind):
    assert re.fullmatch(r"[a-z]+(-[a-z]+)*", kind.name)
    assert kind.summary
    assert inspect.getdoc(kind)
    for effect in examples_of(kind):
        assert effect.sources, effect
        assert all(isinstance(source, str) and source.strip() for source in effect.sources)


ROLES = (
    SeparationForce,
    SlidingForce,
    FilmLimit,
    FilmEnd,
    Compliance,
    PressureCap,
    LoadTerm,
    DisplacementTerm,
    Observer,
)


@pytest.mark.parametrize("kind", ck.EFFECTS, ids=lambda kind: kind.__name__)
def test_every_effect_is_final_and_plays_one_role(kind):
    assert kind.__subclasses__() == []
    assert sum(issubclass(kind, role) for role in ROLES) == 1
    assert issubclass(kind, SeparationEffect) != issubclass(kind, ContactEffect)
    assert attrs.fields(kind) is not None
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        next(examples_of(kind)).name = "other"


def leaves(kind):
    below = kind.__subclasses__()
    return {kind} if not below else set().union(*(leaves(sub) for sub in below))


def test_every_effect_is_in_the_registry():
    concrete = {
        kind
        for kind in leaves(Effect)
        if not inspect.isabstract(kind) and kind.__module__.startswith("contactkit.")
    }
    assert concrete == set(ck.EFFECTS)
    assert len({kind.name for kind in ck.EFFECTS}) == len(ck.EFFECTS)


def test_every_public_name_exists():
    for name in ck.__all__:
        assert getattr(ck, name) is not None
    assert sorted(ck.__all__) == ck.__all__
    assert set(ck.__all__) <= set(dir(ck))


# Files --------------------------------------------------------------------------------------


def functions(tree):
    return [
        node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    ]


def lines_of(function):
    """Lines of a function, its docstring not counted."""
    body = function.body
    says = body[0] if ast.get_docstring(function, clean=False) is not None else None
    docstring = says.end_lineno - says.lineno + 1 if says is not None else 0
    return function.end_lineno - function.lineno + 1 - docstring


@each_file
def test_no_function_is_longer_than_a_screen(path):
    long = {f.name: lines_of(f) for f in functions(tree_of(path))}
    assert {n: lines for n, lines in long.items() if lines > MOST_LINES_OF_A_FUNCTION} == {}


def undocumented(tree):
    """Public functions and classes of a module, and public methods of those, that say nothing."""

    def visit(body, owner):
        for node in body:
            if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                continue
            if node.name.startswith("_"):
                continue
            decorators = {ast.unparse(d).split(".")[-1] for d in node.decorator_list}
            if not ast.get_docstring(node) and not decorators & {"overload", "setter", "validator"}:
                yield owner + node.name
            if isinstance(node, ast.ClassDef):
                yield from visit(node.body, f"{owner}{node.name}.")

    return list(visit(tree.body, ""))


@each_file
def test_everything_public_has_a_docstring(path):
    assert ast.get_docstring(tree_of(path))
    assert undocumented(tree_of(path)) == []


def test_a_missing_docstring_would_be_seen():
    source = "class A:\n    '''A.'''\n    def f(self): pass\n    def _g(self): pass\ndef h(): pass"
    assert undocumented(ast.parse(source)) == ["A.f", "h"]


# A place on somebody's disk; what follows /tmp must be a name, so that prose may speak of /tmp.
MACHINE = re.compile(r"(?<![\w.~:/-])/(?:root|work|home|Users)/\w|(?<![\w.~:/-])/tmp/\w")


def committed_files():
    """Files that are or would be committed."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    return [ROOT / name for name in listed.stdout.split("\0") if name]


def test_no_file_names_a_place_on_a_machine():
    found = []
    for path in committed_files():
        if not path.is_file() or path == Path(__file__):
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        found += [f"{label(path)}: {match[0]}" for match in MACHINE.finditer(text)]
    assert found == []


@pytest.mark.parametrize(
    ("text", "seen"),
    [
        (f"open('/{'root'}/x')", True),
        (f"/{'work'}/main", True),
        (f"cd /{'tmp'}/abc", True),
        ("https://example.org/work/x", False),
        ("in /tmp or so", False),
        ("a/work/b", False),
    ],
)
def test_a_place_on_a_machine_would_be_seen(text, seen):
    assert bool(MACHINE.search(text)) is seen


# Doctests -----------------------------------------------------------------------------------


def module_names():
    import contactkit.fmu
    import contactkit.models

    names = ["contactkit"]
    for package in (ck, contactkit.fmu, contactkit.models):
        names += [
            info.name for info in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
        ]
    return sorted(set(names))


@pytest.mark.filterwarnings("default")  # an example may show a warning, and says so in its text
@pytest.mark.parametrize("name", module_names())
def test_the_examples_in_docstrings_hold(name):
    module = importlib.import_module(name)
    with np.printoptions(legacy=False):
        failed, _ = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_there_are_examples_to_hold():
    finder = doctest.DocTestFinder(exclude_empty=True)
    examples = [
        example
        for name in module_names()
        for test in finder.find(importlib.import_module(name))
        for example in test.examples
    ]
    assert len(examples) > 100
