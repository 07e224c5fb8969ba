"""Imports point one way. The table below is the picture of the architecture, executable."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = {"contactkit": "contactkit", "contactkit.fmu": "fmu", "contactkit.models": "models"}

# A module may import what stands above it, and within a package its neighbours.
CHAIN = [
    ["reference.*"],
    ["errors"],
    ["units", "columns"],
    ["checks", "kernels.*"],
    ["published_arguments"],
    ["published_right", "published_right_viscous"],
    ["published_rows", "published_rows_sliding"],
    ["published_formulas"],
    ["temperature_laws"],
    ["viscosity_laws", "water_laws"],
    ["liquids", "surfaces", "materials", "imposed"],
    ["meniscus", "asperity_population"],
    ["interface", "accuracy", "topography"],
    ["bodies"],
    ["scene", "contact_scene"],
    ["effects.*"],
    ["tables"],
    ["height_texts"],
    ["height_maps"],
    ["realise"],
    ["film_laws", "vibration_path"],
    ["plan", "division_laws"],
    ["divide"],
    ["contact_plan", "sliding_plan"],
    ["planner"],
    ["motion_state"],
    ["motion_events", "step_problem"],
    ["motion_smooth"],
    ["motion", "validity", "constant_force", "errata_notes"],
    ["result_parts"],
    ["results", "contact_engine"],
    ["sliding_result"],
    ["slide_curves"],
    ["contact_outer"],
    ["contact_film"],
    ["contact_result"],
    ["humidity_curves"],
    ["contact"],
    ["stop_ways"],
    ["stop_tables"],
    ["stop_impact", "stop_curves"],
    ["converter"],
    ["humid_tables"],
    ["curves", "io", "workprecision", "press_map", "adhesion_curves"],
    ["vibration_curves"],
    ["separation"],
    ["contact_archive"],
    ["archive"],
    ["study_paths"],
    ["study_store"],
    ["study_table"],
    ["study_run"],
    ["studies"],
    ["plot"],
    ["contact_plot"],
    ["models.*", "fmu.*"],
    ["cli"],
    ["__main__"],
]
KERNELS_MAY = ("contactkit.kernels", "contactkit.errors", "contactkit.units")
NUMERICS = {"numpy", "scipy"}


def _modules():
    found = {}
    for package, folder in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            found[".".join((package, *(p for p in parts if p != "__init__")))] = path
    return found


MODULES = _modules()
INSIDE = [name for name in MODULES if name != "contactkit"]  # the front door imports what it shows


def imports(name, source, known=MODULES):
    """(target, whether inside a function) of each import but those for the type checker alone."""
    is_package = name in known and known[name].name == "__init__.py"
    parents = name.split(".") if is_package else name.split(".")[:-1]

    def visit(node, lazy):
        if isinstance(node, ast.Import):
            yield from ((alias.name, lazy) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = parents[: len(parents) - node.level + 1] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            for alias in node.names:
                full = f"{base}.{alias.name}"
                yield (full if full in known else base), lazy
        is_for_types = isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
        lazy = lazy or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        for child in node.orelse if is_for_types else ast.iter_child_nodes(node):
            yield from visit(child, lazy)

    return list(visit(ast.parse(source), False))


def imports_of(name):
    return imports(name, MODULES[name].read_text(encoding="utf-8"))


def place(name):
    """Row of a module in the chain, and the package within which neighbours may be imported."""
    short = name.removeprefix("contactkit.")
    for row, names in enumerate(CHAIN):
        for entry in names:
            package = entry.removesuffix(".*")
            if short == entry or (
                entry.endswith(".*") and (short == package or short.startswith(package + "."))
            ):
                return row, package
    return None


def is_allowed(name, target):
    if not target.startswith("contactkit"):
        return True
    if target == "contactkit":  # its version number
        return True
    here, there = place(name), place(target)
    return there is not None and (there[0] < here[0] or here[1] == there[1])


def violations(name, found):
    return [target for target, _ in found if not is_allowed(name, target)]


@pytest.mark.parametrize("name", INSIDE)
def test_every_module_has_its_place_in_the_chain(name):
    assert name.startswith("contactkit.reference") or place(name) is not None


@pytest.mark.parametrize("name", [n for n in INSIDE if not n.startswith("contactkit.reference")])
def test_imports_point_one_way(name):
    found = imports_of(name)
    if name.startswith(("contactkit.fmu", "contactkit.models")):
        # The devices and their FMUs may know each other, the device the FMU only when it is asked.
        found = [
            (t, lazy)
            for t, lazy in found
            if not (name.startswith("contactkit.fmu") and t.startswith("contactkit.models"))
            and not (lazy and t.startswith("contactkit.fmu"))
        ]
    assert violations(name, found) == []


@pytest.mark.parametrize("name", [n for n in INSIDE if n.startswith("contactkit.kernels")])
def test_a_kernel_knows_kernels_errors_and_units_only(name):
    inside = [t for t, _ in imports_of(name) if t.startswith("contactkit")]
    assert [t for t in inside if not t.startswith(KERNELS_MAY)] == []


@pytest.mark.parametrize("name", [n for n in INSIDE if n.startswith("contactkit.reference.")])
def test_a_reference_shares_no_code_with_what_it_checks(name):
    targets = {t.split(".")[0] for t, _ in imports_of(name)}
    assert "contactkit" not in targets
    assert targets - NUMERICS <= {"__future__", "collections", "math", "typing"}


CORE = [n for n in INSIDE if not n.startswith(("contactkit.fmu", "contactkit.models"))]


@pytest.mark.parametrize("name", CORE)
def test_the_physics_knows_nothing_of_fmi_or_of_devices(name):
    """Except the command line, and that only once a command asks for it."""
    for target, lazy in imports_of(name):
        if target.startswith(("contactkit.fmu", "contactkit.models", "pythonfmu", "fmpy")):
            assert name == "contactkit.cli", target
            assert lazy, target


@pytest.mark.parametrize("name", MODULES)
def test_only_plot_imports_matplotlib(name):
    drawn = [t for t, _ in imports_of(name) if t.split(".")[0] in ("matplotlib", "mpl_toolkits")]
    assert drawn == [] or name == "contactkit.plot"


@pytest.mark.parametrize("name", MODULES)
def test_the_front_door_is_not_used_from_inside(name):
    """`from contactkit import x` inside would close a circle; `__version__` is a plain string."""
    tree = ast.parse(MODULES[name].read_text(encoding="utf-8"))
    level = name.count(".") + (MODULES[name].name == "__init__.py")
    used = [
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        and (node.module == "contactkit" or (node.module is None and node.level == level))
        for alias in node.names
        if f"contactkit.{alias.name}" not in MODULES
    ]
    assert name == "contactkit" or set(used) <= {"__version__"}


# Does the rule itself see? -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "source", "seen"),
    [
        ("contactkit.plan", "from .results import Work", ["contactkit.results"]),
        ("contactkit.plan", "from . import results", ["contactkit.results"]),
        ("contactkit.plan", "import contactkit.plot", ["contactkit.plot"]),
        ("contactkit.plan", "def f():\n    from .motion import advance", ["contactkit.motion"]),
        ("contactkit.separation.effects.viscous", "from ..plan import Plan", ["contactkit.plan"]),
        ("contactkit.interface", "from .scene import SeparationScene", ["contactkit.scene"]),
        ("contactkit.plan", "from .scene import SeparationScene", []),
        ("contactkit.separation.effects.viscous", "from .film_shape import FilmShape", []),
        ("contactkit.scene", "if TYPE_CHECKING:\n    from .plan import Plan", []),
        ("contactkit.contact_plan", "from .contact import solve", ["contactkit.contact"]),
        ("contactkit.contact.effects.stress", "from ..contact_scene import ContactScene", []),
        ("contactkit.contact.effects.stress", "from ..contact_engine import Engine",
         ["contactkit.contact_engine"]),
        ("contactkit.bodies", "from .effects import film", ["contactkit.contact.effects.film"]),
        ("contactkit.scene", "if TYPE_CHECKING:\n    pass\nelse:\n    from .plan import Plan",
         ["contactkit.plan"]),
    ],
)  # fmt: skip
def test_the_rule_sees_an_import_against_the_stream(name, source, seen):
    assert violations(name, imports(name, source)) == seen
