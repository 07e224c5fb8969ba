"""Kernels replaced by ones that raise, and a pairwise choice of the cases to try them on."""

from __future__ import annotations

import ast
import functools
import importlib
import importlib.util
import inspect
import itertools
import pkgutil
import sys

import attrs

# The physics, and the solvers and integrators; the tools of `numerics` are anybody's.
ROOMS = (
    "adhesion",
    "as_published.printed",
    "capillary",
    "contact.slip",
    "contact.solver",
    "elasticity",
    "lubrication",
    "roughness",
    "separation.integrator",
)


class PoisonError(Exception):
    """A kernel was called that no effect of the scene owns."""


@functools.cache
def kernels():
    """Public functions of the rooms, by room, module and name."""
    found = {}
    for room in ROOMS:
        package = importlib.import_module(f"contactkit.{room}")
        paths = getattr(package, "__path__", None)
        inside = pkgutil.walk_packages(paths, f"contactkit.{room}.") if paths else ()
        for name in [package.__name__, *(info.name for info in inside)]:
            module = importlib.import_module(name)
            for public in getattr(module, "__all__", ()):
                value = getattr(module, public)
                is_own = getattr(value, "__module__", "") == name
                if callable(value) and not isinstance(value, type) and is_own:
                    found[f"{name.removeprefix('contactkit.')}.{public}"] = value
    return found


def matches(name, patterns):
    """Whether a name is among the patterns, in which `*` stands for the rest of a name."""
    return any(
        name.startswith(p.removesuffix("*")) if p.endswith("*") else name == p for p in patterns
    )


def imported_by(kind):
    """Patterns of what the module of an effect imports from the rooms, at its head or later."""
    module = sys.modules[kind.__module__]
    package = module.__name__.rpartition(".")[0]
    found = set()
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.ImportFrom):
            base = importlib.util.resolve_name("." * node.level + (node.module or ""), package)
            names = [base, *(f"{base}.{alias.name}" for alias in node.names)]
            found |= {name.removeprefix("contactkit.") for name in names}
    known = {name.rpartition(".")[0] for name in kernels()}
    return {f"{name}.*" for name in found & known}


def with_needed_fields(kind):
    """An effect of which only what must be given is given: one of each unit."""
    needed = [a.name for a in attrs.fields(kind) if a.default is attrs.NOTHING]
    return kind(**dict.fromkeys(needed, 1.0))


def ours():
    """Modules of contactkit that are loaded."""
    return [m for name, m in sys.modules.items() if name.startswith("contactkit") and m]


@functools.cache
def places(_loaded):
    """Module and attribute of each place that a kernel has been imported to, by its name."""
    names, found = {id(value): name for name, value in kernels().items()}, {}
    for module in ours():
        for attribute, value in vars(module).items():
            if id(value) in names:
                found.setdefault(names[id(value)], []).append((module, attribute))
    return found


def poison(monkeypatch, names):
    """Replace kernels by ones that raise, wherever they have been imported to."""
    found = places(frozenset(map(id, ours())))
    for name in names:
        for module, attribute in found.get(name, ()):
            if getattr(module, attribute) is kernels()[name]:
                monkeypatch.setattr(module, attribute, _raising(name))


def poison_all_but(monkeypatch, patterns):
    """Replace every kernel that matches none of the patterns."""
    poison(monkeypatch, [name for name in kernels() if not matches(name, patterns)])


@functools.cache
def _raising(name):
    @functools.wraps(kernels()[name])
    def raises(*_args, **_kwargs):
        raise PoisonError(name)

    return raises


def survives(monkeypatch, name, run):
    """Whether a run reaches its end without one kernel: the negative control of the poison."""
    with monkeypatch.context() as patched:
        poison(patched, [name])
        try:
            run()
        except PoisonError as error:
            return str(error) != name
        return True


def unknown(patterns):
    """Patterns that match no kernel."""
    return [p for p in sorted(patterns) if not any(matches(name, {p}) for name in kernels())]


def product_of(factors):
    """Every choice of one level per factor, as a dictionary."""
    for levels in itertools.product(*factors.values()):
        yield dict(zip(factors, levels, strict=True))


def pairwise(cases):
    """A few of the cases (dictionaries) that hold every pair of levels any of them holds.

    Greedy, in the order of the cases: the next is the first of those with most pairs not yet held.
    An absent effect is a level too, so that each effect runs at least once without each other one.
    """
    levels, bits, pairs = {}, {}, []  # a bit for each pair: this runs whenever tests are collected
    for case in cases:
        held = [levels.setdefault(level, len(levels)) for level in case.items()]
        numbers = (bits.setdefault(p, len(bits)) for p in itertools.combinations(held, 2))
        pairs.append(sum(1 << number for number in numbers))
    missing, chosen = (1 << len(bits)) - 1, []
    while missing:
        best = max(range(len(cases)), key=lambda i: (pairs[i] & missing).bit_count())
        missing &= ~pairs[best]
        chosen.append(cases[best])
    return chosen


def by_kind(effects):
    """Factors of a product of effects: each kind absent, or in one of its choices."""
    grouped = itertools.groupby(effects, type)
    return {kind.name: [None, *choices] for kind, choices in grouped}


def label(value):
    """Name of a case in the list of tests."""
    if isinstance(value, str):
        return value
    return "+".join("-".join(str(part) for part in (e.name, *_choices(e))) for e in value)


def _choices(effect):
    for attribute in attrs.fields(type(effect)):
        value = getattr(effect, attribute.name)
        if value != attribute.default:
            yield value
