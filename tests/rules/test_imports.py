"""Imports point one way: each room imports from the floors below it, never from its own floor."""

import ast
import functools
import sys
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from sources import tree

from contactkit._lazy import ABOVE

# Rules of the house, as lint is: 3 s of `make test`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
FOLDERS = {
    "contactkit": "contactkit",
    "contactkit.fmu": "fmu",
    "contactkit.gallery": "examples/gallery",
    "contactkit.models": "models",
}

# From the ground up. Rooms on one floor do not know each other.
FLOORS = [
    ["reference", "errors", "frozen", "_lazy", "_version"],
    ["units", "extras", "validity", "installed"],
    ["registry"],
    ["kinds"],
    ["arguments", "validators", "work_precision", "numerics", "export", "reading"],
    ["accuracy", "elasticity", "capillary", "lubrication", "adhesion", "roughness"],
    ["as_published"],
    ["data"],
    ["liquids"],
    ["scene"],
    ["contact", "separation"],
    ["planning"],
    ["files", "citing"],
    ["analyses", "shortcuts"],
    ["studies"],
    ["fitting"],
    ["plot"],
    ["models"],
    ["fmu"],
    ["live_page"],
    ["benchmarks"],
    ["models report"],
    ["app"],
    ["gallery", "local_app"],
    ["commands"],
    ["cli"],
    ["__main__"],
]
FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
# Names of packages, kinds, the figures of a room, an optional package, what an FMU carries, a
# plugin of the command line, what plans and runs a kind of scene, a device and its report.
IMPORT_BY_NAME = {
    "contactkit.benchmarks.hard.case",
    "contactkit.benchmarks.table",
    "contactkit.app.plugin",
    "contactkit.models.device",
    "contactkit.models.library",
    "contactkit.planning",
    "contactkit._lazy",
    "contactkit.registry",
    "contactkit.plot.accessors.base",
    "contactkit.numerics.fft",
    "contactkit.fmu.python.build",
}
ONE_IMPORTER = {"matplotlib": "plot", "mpl_toolkits": "plot"}


def _modules():
    found = {}
    for package, folder in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            found[".".join((package, *(p for p in parts if p != "__init__")))] = path
    return found


MODULES = _modules()


def room(name):
    """Room of a module; the reports of devices run FMUs, whose models are below these."""
    parts = name.split(".")
    if parts[1:2] == ["models"] and parts[3:4] == ["report"]:
        return "models report"
    return parts[1] if "." in name else ""


def is_for_types(node):
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


def imports(name, source, known=MODULES, with_types=True):
    """Modules that a module imports, at its head, later, or for types alone; full names."""
    is_package = name in known and known[name].name == "__init__.py"
    parents = name.split(".") if is_package else name.split(".")[:-1]

    def visit(node):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = parents[: len(parents) - node.level + 1] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            for alias in node.names:
                full = f"{base}.{alias.name}"
                yield full if full in known else base
        if isinstance(node, ast.expr):
            return
        for child in ast.iter_child_nodes(node):
            if with_types or not is_for_types(node) or child in node.orelse:
                yield from visit(child)

    return set(visit(source if isinstance(source, ast.Module) else ast.parse(source)))


@functools.cache
def all_imports(with_types=True):
    """What each module imports."""
    return {
        name: imports(name, tree(path), with_types=with_types) for name, path in MODULES.items()
    }


def against_the_stream(name, targets):
    """Targets in a room that is not below that of a module."""
    here = FLOOR.get(room(name), -1)
    return sorted(
        target
        for target in targets
        if target.startswith("contactkit.")
        and room(target) != room(name)
        and not FLOOR.get(room(target), len(FLOORS)) < here
    )


def test_every_room_has_its_floor():
    assert {room(name) for name in MODULES} - {""} == set(FLOOR)


def test_rooms_import_only_from_the_floors_below():
    wrong = {n: against_the_stream(n, t) for n, t in all_imports().items() if n != "contactkit"}
    assert {name: targets for name, targets in wrong.items() if targets} == {}


def test_there_are_no_circles():
    graph = {
        name: {target for target in targets if target in MODULES and target != name}
        for name, targets in all_imports().items()
    }
    del graph["contactkit"]
    for targets in graph.values():
        targets.discard("contactkit")
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))


def test_a_package_lists_its_modules_and_imports_nothing():
    """An FMU carries what is imported; only names that come later, when asked for, are offered."""
    allowed = {"__future__", "typing", "contactkit._lazy", "contactkit._version"}
    wrong = {
        name: sorted(all_imports(with_types=False)[name] - allowed)
        for name, path in MODULES.items()
        if path.name == "__init__.py" and name != "contactkit.fmu.python.guard"
    }
    assert {name: targets for name, targets in wrong.items() if targets} == {}


def test_rooms_above_are_called_by_name_in_one_place():
    """`_lazy.ABOVE` lists what a room below offers of one above, so that no import is hidden."""
    texts = {name: path.read_text("utf-8") for name, path in MODULES.items()}
    by_name = {n for n, t in texts.items() if "import_module(" in t or "_lazy import named" in t}
    assert by_name == IMPORT_BY_NAME
    assert {f"contactkit.{module}" for module in ABOVE.values()} <= set(MODULES)


def test_nobody_inside_imports_from_a_package():
    """A name comes from its module: what a package offers is for users."""
    packages = {n for n, path in MODULES.items() if path.name == "__init__.py"}
    packages -= {"contactkit.fmu.python.guard"}
    allowed = {"contactkit", "contactkit.data", "contactkit.models"}  # its version; its files
    wrong = {n: sorted((t & packages) - allowed) for n, t in all_imports().items()}
    assert {name: targets for name, targets in wrong.items() if targets} == {}


def test_references_share_no_code_with_what_they_check():
    allowed = {"numpy", "scipy", *sys.stdlib_module_names}
    wrong = {
        name: sorted({t.split(".")[0] for t in targets} - allowed)
        for name, targets in all_imports().items()
        if room(name) == "reference"
    }
    assert {name: targets for name, targets in wrong.items() if targets} == {}


def test_one_room_draws_and_one_speaks_fmi():
    wrong = {
        name: sorted(
            root
            for root in {t.split(".")[0] for t in targets}
            if ONE_IMPORTER.get(root, room(name)) != room(name)
            or (root in ("pythonfmu", "fmpy") and room(name) not in ("fmu", "app"))
        )
        for name, targets in all_imports().items()
    }
    assert {name: roots for name, roots in wrong.items() if roots} == {}


@pytest.mark.parametrize(
    ("name", "source", "seen"),
    [
        (
            "contactkit.scene.liquid",
            "from ..contact.result import Work",
            ["contactkit.contact.result"],
        ),
        (
            "contactkit.contact.plan",
            "from ..separation import plan",
            ["contactkit.separation.plan"],
        ),
        (
            "contactkit.contact.plan",
            "def f():\n    from ..files import scenes",
            ["contactkit.files.scenes"],
        ),
        ("contactkit.contact.plan", "import contactkit.plot", ["contactkit.plot"]),
        ("contactkit.contact.plan", "from .solve import solve", []),
        ("contactkit.contact.plan", "from ..scene.interface import Interface", []),
        (
            "contactkit.scene.scenes",
            "if TYPE_CHECKING:\n    from ..contact.plan import x",
            ["contactkit.contact.plan"],
        ),
        (
            "contactkit.scene.scenes",
            "if TYPE_CHECKING:\n    pass\nelse:\n    from ..contact.plan import x",
            ["contactkit.contact.plan"],
        ),
    ],
)
def test_the_rule_sees_an_import_against_the_stream(name, source, seen):
    assert against_the_stream(name, imports(name, source)) == seen
