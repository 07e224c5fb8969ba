"""Pages for the customer's three demands, their data and pictures: ``python docs/scripts/demands``.

page           Parts shared by all pages: data in JSON, tables in Markdown, pictures, the machine.
hard_case      A hard case: why it is hard, a naive method, our method, and the errors of both.
hard_layers    Hard cases of layered solids: thick layers, incompressible and stiff films.
hard_contacts  Hard cases of rough contacts: all pixels, hardness, offsets, edges, adhesion.
hard_films     Hard cases of films in motion: stiff films, small openings, thin lenses.
hard_bridges   Hard cases of liquid bridges: right angles, rupture, pinned contact lines.
hard_cases     Page of the hard cases.
cost           Cost of a scene: CPU seconds, peak memory and counts of plan and run.
effect_scenes  A scene for each effect, with it and without it, and the formula of the effect.
accuracy_studies  Error over cost of each solver, and of each shipped scene by the presets.
accuracy       Page of accuracy and cost: error over CPU time of solvers, scenes and peers.
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
