"""Pages for the customer's three demands, their data and pictures: ``python docs/scripts/demands``.

page           Parts shared by all pages: data in JSON, tables in Markdown, pictures, the machine.
hard_cases     Page of the hard cases.
effect_scenes  A scene for each effect, with it and without it, and the formula of the effect.
large_data     Data of large maps, from what their benchmark left.
accuracy       Page of accuracy and cost: what a digit more costs, all studies, other programs.
effects        Page of the effects: role, formula, source, validity, cost, scenes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from types import ModuleType

__all__ = ["PAGES"]


def _module(name: str) -> Callable[[], ModuleType]:
    return lambda: import_module(f"demands.{name}")


PAGES: Mapping[str, Callable[[], ModuleType]] = {
    "accuracy-and-cost": _module("accuracy"),
    "hard-cases": _module("hard_cases"),
    "effects": _module("effects"),
}
"""Modules of the pages, with ``measure() -> data``, ``page(data) -> text``, ``draw(data)``."""
