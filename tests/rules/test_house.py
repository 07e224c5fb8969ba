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
import sys
import typing
from collections import Counter
from importlib.util import find_spec
from pathlib import Path

import attrs
import numpy as np
import pytest
from sources import tree

import contactkit as ck
from contactkit.contact.effects.base import (
    Attraction,
    Compliance,
    ContactEffect,
    DisplacementTerm,
    LoadHistory,
    LoadTerm,
    Observer,
    PressureBound,
)
from contactkit.kinds import TEMPERATURE_LAWS
from contactkit.separation.effects.base import (
    CoupledEffect,
    Effect,
    FilmEnd,
    FilmLimit,
    MovingAngle,
    SeparationEffect,
    SeparationForce,
    VolumeLoss,
)
from contactkit.separation.sliding.effects import SlidingForce

# Rules of the house, as lint is: 30 s of `make test`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SOURCES = ("contactkit", "fmu", "models", "examples")
MOST_LINES_OF_A_FUNCTION = 60  # as the formatter lays them out
MOST_ARGUMENTS = 8
# A contact in one call, for those who have an array, and a fit: all but the first few are optional.
IN_ONE_CALL = {"press", "fit"}
MOST_FILES_IN_A_FOLDER = 25

SCENE_OBJECTS = [
    ck.Accuracy,
    ck.AsperityPopulation,
    ck.Body,
    ck.CombinedSurface,
    ck.ContactScene,
    ck.DugdaleAttraction,
    ck.ExponentialAttraction,
    ck.Flat,
    ck.GaussianRoughness,
    ck.HardnessMap,
    ck.AsPublished,
    ck.ConstantHardness,
    ck.ContinuousHardness,
    ck.LiteralHardness,
    ck.MaterialHardness,
    ck.Heights,
    ck.Interface,
    ck.Layer,
    ck.LennardJonesAttraction,
    ck.Liquid,
    ck.Material,
    ck.Measured,
    ck.Meniscus,
    ck.Approach,
    ck.ImposedForce,
    ck.ImposedSpeed,
    ck.ImposedTime,
    ck.PressAndPull,
    ck.Paraboloid,
    ck.Pressing,
    ck.SelfAffineRoughness,
    ck.SeparationScene,
    ck.Sliding,
    ck.SlidingScene,
    ck.Sphere,
    ck.SpringSlider,
    ck.RigidBase,
    ck.Stack,
    ck.TangentialStep,
    ck.TransverselyIsotropicMaterial,
    ck.Vibration,
    ck.ViscoelasticMaterial,
    ck.Wave,
    ck.Difference,
    ck.Disc,
    ck.Ellipse,
    ck.FineRoughness,
    ck.Image,
    ck.ImageFile,
    ck.Intersection,
    ck.Polygon,
    ck.Rectangle,
    ck.Ring,
    ck.Sector,
    ck.Union,
    ck.Recess,
    ck.SealedHole,
    ck.Vent,
    ck.Planform,
    ck.Window,
]
DESCRIBED = [*SCENE_OBJECTS, *ck.EFFECTS, *TEMPERATURE_LAWS]


def python_files():
    return sorted(path for folder in SOURCES for path in (ROOT / folder).rglob("*.py"))


def label(path):
    return path.relative_to(ROOT).as_posix()


def trees():
    """Syntax trees of every file, by its label."""
    return {label(path): tree(path) for path in python_files()}


def offenders(found):
    """What of a rule's findings, by label, is not empty: a rule holds where this is empty."""
    return {where: what for where, what in found.items() if what}


# Units --------------------------------------------------------------------------------------


def has_number(annotation):
    """Whether a type has float or int in it, at any depth."""
    if annotation in (float, int):
        return True
    return any(has_number(part) for part in typing.get_args(annotation))


def resolved(kind):
    """Fields of a class with their types; attrs resolves these once, for the converter too."""
    # What modules import for checkers alone; a map of numbers is an Array, with its unit.
    names = dict.fromkeys(("Map", "Mask"), typing.Any)
    return attrs.fields(attrs.resolve_types(kind, localns=names))


def without_unit(kind):
    """Fields of a class that hold numbers and name no unit."""
    annotations = {}
    for owner in reversed(kind.__mro__):
        annotations |= vars(owner).get("__annotations__", {})
    return [
        a.name
        for a in resolved(kind)
        if (has_number(a.type) or annotations[a.name] == "Map") and not a.metadata.get("unit")
    ]


def test_every_number_carries_its_unit():
    assert offenders({kind.__name__: without_unit(kind) for kind in DESCRIBED}) == {}


def test_every_scene_object_is_described():
    """Every public class with fields is in the list above."""
    public = [getattr(ck, name) for name in ck.__all__]
    scene_objects = {kind for kind in public if isinstance(kind, type) and attrs.has(kind)}
    # While running, not described.
    made = {ck.Plan, ck.ContactPlan, ck.SlidingPlan, ck.MotionState, ck.Pull}
    made |= {ck.DeformingPlan, ck.DeformingResult, ck.Gradient}
    made |= {ck.MeasuredCurve, ck.MeasuredBound, ck.Fit}  # data, in units of their own; a result
    made |= {ck.SeparationResult, ck.ContactResult, ck.SlidingResult, ck.SavedCurve}
    assert scene_objects - made <= {*DESCRIBED}


def test_every_unit_is_of_the_international_system():
    """A factor of 1, so that a number without a unit means what the code takes it for."""
    scaled = {
        kind.__name__: [
            a.name
            for a in attrs.fields(kind)
            if "unit" in a.metadata and ck.units.parse_unit(a.metadata["unit"]).factor != 1.0
        ]
        for kind in DESCRIBED
    }
    assert offenders(scaled) == {}


def test_a_number_without_a_unit_would_be_seen():
    @attrs.frozen
    class Bare:
        length: float | None = None

    assert without_unit(Bare) == ["length"]


# Effects ------------------------------------------------------------------------------------


REQUIRED = {
    ck.ShearLimit: {"strength": 1e6},
    ck.VanDerWaalsForce: {"hamaker_constant": 1e-19},
    ck.AdhesiveContact: {"work_of_adhesion": 0.05, "reduced_modulus": 1e9},
    ck.FrictionTraction: {"coefficient": 0.2},
    ck.PartialSlip: {"coefficient": 0.2, "path": (ck.TangentialStep(ratio=0.5),)},
    ck.FilmMeniscus: {"film_thickness": 1e-9},
    ck.Adhesion: {"law": ck.ExponentialAttraction(work_of_adhesion=0.05, range=1e-9)},
    ck.ContactAngleHysteresis: {"advancing_lower": 1.0, "receding_lower": 0.8},
    ck.AsperityMenisci: {"asperities": ck.AsperityPopulation(density=1e12, radius=1e-6)},
}


def examples_of(kind):
    """One object of an effect for each of its choices."""
    given = [a.name for a in attrs.fields(kind) if a.default is attrs.NOTHING]
    needed = REQUIRED.get(kind, dict.fromkeys(given, 1.0))
    yield kind(**needed)
    for a in resolved(kind):
        for choice in typing.get_args(a.type):
            for value in typing.get_args(choice) or (choice,):
                if isinstance(value, str):
                    yield kind(**{**needed, a.name: value})


def unexplained(kind):
    """What an effect leaves unsaid about itself."""
    if not re.fullmatch(r"[a-z]+(-[a-z]+)*", kind.name):
        yield f"name {kind.name!r}"
    if not kind.summary:
        yield "summary"
    if not inspect.getdoc(kind):
        yield "docstring"
    for effect in examples_of(kind):
        given = [isinstance(source, str) and source.strip() for source in effect.sources]
        if not given or not all(given):
            yield f"sources of {effect}"


def test_every_effect_says_what_it_is_and_where_it_comes_from():
    assert offenders({kind.__name__: [*unexplained(kind)] for kind in ck.EFFECTS}) == {}


ROLES = (
    SeparationForce,
    SlidingForce,
    FilmLimit,
    FilmEnd,
    CoupledEffect,
    MovingAngle,
    VolumeLoss,
    Compliance,
    PressureBound,
    LoadHistory,
    LoadTerm,
    DisplacementTerm,
    Attraction,
    Observer,
)


def is_frozen(kind):
    try:
        next(examples_of(kind)).name = "other"
    except attrs.exceptions.FrozenInstanceError:
        return True
    return False


def test_every_effect_is_final_frozen_and_plays_one_role():
    wrong = {
        kind.__name__: {
            "subclasses": [sub.__name__ for sub in below(kind)],
            "roles": [role.__name__ for role in ROLES if issubclass(kind, role)],
            "halves": issubclass(kind, SeparationEffect) + issubclass(kind, ContactEffect),
            "frozen": is_frozen(kind),
        }
        for kind in ck.EFFECTS
    }
    assert {
        name: found
        for name, found in wrong.items()
        if found["subclasses"]
        or len(found["roles"]) != 1
        or found["halves"] != 1
        or not found["frozen"]
    } == {}


def below(kind):
    """Subclasses of a class in contactkit; other tests have their own."""
    return [sub for sub in kind.__subclasses__() if sub.__module__.startswith("contactkit.")]


def leaves(kind):
    under = below(kind)
    return {kind} if not under else set().union(*(leaves(sub) for sub in under))


def test_every_effect_is_in_the_registry():
    concrete = {
        kind
        for kind in leaves(Effect)
        if not inspect.isabstract(kind)
        and kind.__module__.startswith("contactkit.")
        and hasattr(sys.modules[kind.__module__], kind.__name__)  # none of an example
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


def test_no_function_is_longer_than_a_screen():
    long = {
        where: {
            f"{function.name} ({lines} lines)"
            for function in functions(tree)
            if (lines := lines_of(function)) > MOST_LINES_OF_A_FUNCTION
        }
        for where, tree in trees().items()
    }
    assert offenders(long) == {}


def arguments_of(function):
    """How many arguments a function takes; the instance or class is none."""
    given = function.args
    names = [a.arg for a in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
    return len(names) - (names[:1] in (["self"], ["cls"]))


def test_no_function_takes_too_many_arguments():
    wide = {
        where: {
            f"{function.name} ({count} arguments)"
            for function in functions(tree)
            if (count := arguments_of(function)) > MOST_ARGUMENTS + (function.name in IN_ONE_CALL)
        }
        for where, tree in trees().items()
    }
    assert offenders(wide) == {}


def test_too_many_arguments_would_be_seen():
    source = "class A:\n    def f(self, a, b=1, *args, c, d=2, **more): pass"
    assert [arguments_of(function) for function in functions(ast.parse(source))] == [4]


def test_no_folder_is_crowded():
    kept = Counter(
        path.relative_to(ROOT).parent.as_posix()
        for path in committed_files()
        if path.suffix in (".py", ".c", ".h") and path.is_file()
    )
    crowded = {folder: n for folder, n in kept.items() if n > MOST_FILES_IN_A_FOLDER}
    assert crowded == {}


ENTRY = re.compile(r"(?m)^([a-z]\w*)(?: +[^a-z\s]|$)")  # of a table of contents: name, sentence


def unlike_the_contents(room):
    """Modules of a room that its table of contents does not list, and entries without one."""
    contents = ast.get_docstring(trees()[label(room / "__init__.py")])
    listed = set(ENTRY.findall("\n".join(contents.splitlines()[1:])))
    modules = {path.stem for path in room.glob("*.py") if not path.name.startswith("_")}
    modules |= {path.parent.name for path in room.glob("*/__init__.py")}
    return sorted((modules - {"data"}) ^ (listed - {"data"}))


def test_a_room_lists_its_modules():
    """As a table of contents, one line per module; the library itself has its public names."""
    rooms = {path.parent for path in python_files() if path.name == "__init__.py"}
    rooms.discard(ROOT / "contactkit")
    assert offenders({label(room): unlike_the_contents(room) for room in rooms}) == {}


def undocumented(tree):
    """The module, its public functions, classes and public methods, where they say nothing."""

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

    return [*([] if ast.get_docstring(tree) else ["the module"]), *visit(tree.body, "")]


def test_everything_public_has_a_docstring():
    assert offenders({where: undocumented(tree) for where, tree in trees().items()}) == {}


def test_a_missing_docstring_would_be_seen():
    source = "class A:\n    '''A.'''\n    def f(self): pass\n    def _g(self): pass\ndef h(): pass"
    assert undocumented(ast.parse(source)) == ["the module", "A.f", "h"]


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


def test_a_place_on_a_machine_would_be_seen():
    seen = [f"open('/{'root'}/x')", f"/{'work'}/main", f"cd /{'tmp'}/abc"]
    innocent = [f"https://example.org/{'work'}/x", f"in /{'tmp'} or so", f"a/{'work'}/b"]
    assert [text for text in (*seen, *innocent) if MACHINE.search(text)] == seen


# Constants ----------------------------------------------------------------------------------


def is_numeric(value):
    """Whether an expression is made of numbers only: a number, arithmetic of them, a tuple."""
    if isinstance(value, ast.Constant):
        return isinstance(value.value, int | float) and not isinstance(value.value, bool)
    if isinstance(value, ast.UnaryOp):
        return is_numeric(value.operand)
    if isinstance(value, ast.BinOp):
        return is_numeric(value.left) and is_numeric(value.right)
    return isinstance(value, ast.Tuple) and bool(value.elts) and all(map(is_numeric, value.elts))


def without_a_reason(source, body=None):
    """Numeric constants of a module without a comment on their line, above their block, or a text.

    A block is a run of lines without an empty one; a text is a string right below the constant.
    """
    lines, body = source.splitlines(), body or ast.parse(source).body
    found = []
    for node, following in zip(body, [*body[1:], None], strict=True):
        value = getattr(node, "value", None)
        if not isinstance(node, ast.Assign | ast.AnnAssign) or not is_numeric(value):
            continue
        first = node.lineno - 1
        while first > 0 and lines[first - 1].strip() and not lines[first - 1].startswith("#"):
            first -= 1
        has_comment = first > 0 and lines[first - 1].startswith("#")
        has_comment |= any("#" in line for line in lines[node.lineno - 1 : node.end_lineno])
        below = getattr(following, "value", None)
        has_comment |= isinstance(below, ast.Constant) and isinstance(below.value, str)
        if not has_comment:
            found.append(ast.unparse(node).partition(" =")[0])
    return found


def test_every_constant_says_why():
    """A comment says what it balances and what set it; a constant that balances nothing goes."""
    bare = {
        label(path): without_a_reason(path.read_text(encoding="utf-8"), tree(path).body)
        for path in python_files()
        if not label(path).startswith("examples/")
    }
    assert offenders(bare) == {}, "constants without a comment above them or on their line"


def test_a_constant_without_a_reason_would_be_seen():
    source = "A = 1.0  # of B\n\nB = 2.0\n# both\nC = 3.0\nD = -(2**3), 4\n\nE = 5\n'text'\n\nF = 6"
    assert without_a_reason(source) == ["B", "F"]


DEFINED = re.compile(r"#define (\w+) [-(]*\.?\d")


def defined_without_a_reason(source):
    """Numbers that C code defines without a comment on their line or above their block."""
    found, is_explained = [], False
    for line in source.splitlines():
        number = DEFINED.match(line)
        # A comment that ends above a line speaks of it, and of the rest of its block.
        is_explained = bool(line.strip()) and (is_explained or line.rstrip().endswith("*/"))
        if number and "/*" not in line and not is_explained:
            found.append(number[1])
    return found


def test_every_number_of_the_kernel_says_why():
    bare = {
        label(path): defined_without_a_reason(path.read_text(encoding="utf-8"))
        for pattern in ("*.c", "*.h")
        for path in sorted((ROOT / "fmu").rglob(pattern))
    }
    assert offenders(bare) == {}, "numbers without a comment above them or on their line"


def test_a_number_of_c_without_a_reason_would_be_seen():
    source = (
        "#define A 1 /* of B */\n\n#define B (2.0 * C)\n\n/* both */\n#define D 3\n#define E .5"
    )
    assert defined_without_a_reason(source) == ["B"]


# Doctests -----------------------------------------------------------------------------------


# The page of the local app; `make test` has no extra app.
NEEDS_MARIMO = {f"contactkit.local_app.{one}" for one in ("elements", "layout", "notebook")}


@functools.cache
def module_names():
    import contactkit.fmu
    import contactkit.gallery
    import contactkit.models

    names = ["contactkit"]
    for package in (ck, contactkit.fmu, contactkit.gallery, contactkit.models):
        names += [
            info.name for info in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
        ]
    return sorted(set(names) - NEEDS_MARIMO if find_spec("marimo") is None else set(names))


def room(name):
    return ".".join(name.split(".")[:2])


@functools.cache
def examples_in(name):
    """Docstrings of a module that hold examples; nine of ten hold none, and cost 1 ms each."""
    return [t for t in doctest.DocTestFinder().find(importlib.import_module(name)) if t.examples]


@pytest.mark.filterwarnings("default")  # an example may show a warning, and names it in its text
@pytest.mark.parametrize("place", sorted({room(name) for name in module_names()}))
def test_the_examples_in_docstrings_hold(place, capsys):
    failed = {}
    for name in module_names():
        if room(name) == place:
            runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
            with np.printoptions(legacy=False):
                for test in examples_in(name):
                    runner.run(test)
            failed[name] = capsys.readouterr().out if runner.failures else ""
    assert offenders(failed) == {}


def test_there_are_examples_to_hold():
    assert sum(len(test.examples) for name in module_names() for test in examples_in(name)) > 100


# Beside the rooms of the package: top-level folders, and what holds for the repository as a whole.
NO_ROOMS = {"benchmarks", "data", "demand_pages", "docs", "fmu", "fuzz", "gallery", "models"}
NO_ROOMS |= {"references", "rules"}


def test_tests_lie_in_the_room_of_what_they_test():
    rooms = {path.parent.name for path in (ROOT / "contactkit").glob("*/__init__.py")}
    folders = {
        path.relative_to(ROOT / "tests").parts[0]
        for path in committed_files()
        if path.is_relative_to(ROOT / "tests") and path.parent != ROOT / "tests"
    }
    assert folders - rooms - NO_ROOMS == set()
