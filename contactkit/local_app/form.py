"""A scene as a form: what can be chosen, the widgets of what is chosen, and the tables they make.

A form begins with a scene. `choices_of` lists the kinds that can be taken instead, `parts_of` the
fields of those taken, and `tables_of` makes the tables of a scene file from the texts, which are
read as a scene file is. What a form does not show stays as it is in the scene.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from functools import cache
from typing import Any

import attrs
from attrs import field, frozen

from ..accuracy import Accuracy
from ..app.scenes import OpenedScene
from ..errors import ContactkitError, DescriptionError
from ..files.scenes import read_scene
from ..files.structure import FileError, library_names, load_liquid, load_material
from ..files.unstructure import unstructure
from ..kinds import (
    CONTACT_EFFECTS,
    CONTACT_LOADINGS,
    SEPARATION_EFFECTS,
    SEPARATION_LOADINGS,
    SURFACES,
)
from ..liquids.liquid import Liquid
from ..scene.interface import Body
from ..scene.materials import Layer, Material, Stack
from ..scene.meniscus import Meniscus
from ..scene.rough_surfaces import Measured
from ..scene.scenes import ContactScene, SeparationScene
from ..scene.surfaces import Flat
from ..scene.window import Window
from .widgets import Widget, is_complete, value_of_text, widgets_of

__all__ = [
    "AS_GIVEN",
    "EFFECTS",
    "NONE",
    "OWN",
    "RIGID",
    "Choice",
    "Made",
    "Part",
    "choices_of",
    "made_of",
    "parts_of",
    "placed",
    "tables_of",
    "with_problem",
]

EFFECTS = "effects"
"""Path of the choice of effects, of which several are taken."""
RIGID, OWN, NONE, AS_GIVEN = "rigid", "of your own", "none", "as in the scene"
"""Choices of a solid, a layer or a liquid beside the names of the library."""

_LAYERS = 2  # of a body; more are for scene files, whose stack stays as it is
_BODIES = ("lower", "upper")
# Which of them it is follows from the layers.
_ELASTIC = ("half-space", "layered-half-space")
_OF_A_FILM = ("flat", "sphere")
_OF_FILMS = ("radius", "crown_radius")  # of a flat; a contact reads neither
_SAID = ("name", "source")  # of a material, kept as they are
_OF_A_FILE = ("path", "checksum")  # of a map that was opened


@frozen(kw_only=True)
class Choice:
    """A choice of a kind, by its name in scene files.

    `chosen` is a name; of effects it is a tuple of names.
    """

    path: str
    label: str
    options: tuple[str, ...]
    chosen: Any


@frozen(kw_only=True)
class Part:
    """A part of a form: the widgets of one object, and what else its table holds.

    `kind` is the class whose fields they are, if they are of one.
    """

    path: str
    title: str
    widgets: tuple[Widget, ...] = ()
    kind: type | None = None
    rest: Any = field(factory=dict)


@frozen(kw_only=True)
class Made:
    """A scene that a form made, or the problems that kept it from being made.

    `problems` are messages by the path of a widget; the empty path has those of the whole.
    """

    opened: OpenedScene | None
    tables: Mapping[str, Any]
    problems: Mapping[str, Sequence[str]]


# What is chosen -------------------------------------------------------------------------------


def choices_of(start: OpenedScene) -> tuple[Choice, ...]:
    """Choices of a form for a scene: bodies, liquid, loading, effects.

    Examples
    --------
    >>> from contactkit.app.scenes import open_scene
    >>> [c.chosen for c in choices_of(open_scene("contact-stop")) if c.path == "loading"]
    ['pressing']
    """
    scene = start.scene
    is_contact = isinstance(scene, ContactScene)
    found = [choice for side in _BODIES for choice in _of_body(scene, side)]
    found.append(_of_liquid(scene))
    loadings = CONTACT_LOADINGS if is_contact else SEPARATION_LOADINGS
    named = [name for name, kind in loadings.by_name.items() if is_complete(kind)]
    found.append(_choice("loading", "loading", named, loadings.name_of(type(scene.loading))))
    known = CONTACT_EFFECTS if is_contact else SEPARATION_EFFECTS
    given = tuple(effect.name for effect in scene.effects if effect.name not in _ELASTIC)
    offered = [n for n, kind in known.by_name.items() if n in given or is_complete(kind)]
    options = tuple(name for name in offered if name not in _ELASTIC)
    found.append(Choice(path=EFFECTS, label="effects", options=options, chosen=given))
    return tuple(found)


def _choice(path: str, label: str, options: Sequence[str], chosen: str) -> Choice:
    """A choice whose start is among its options, as what is given if it has no name there."""
    shown = chosen if chosen in options else AS_GIVEN
    more = () if shown in options else (AS_GIVEN,)
    return Choice(path=path, label=label, options=(*more, *options), chosen=shown)


def _of_body(scene: Any, side: str) -> Iterator[Choice]:
    body, path = getattr(scene.interface, side), f"interface.{side}"
    kinds = SURFACES.by_name
    if not isinstance(scene, ContactScene):
        kinds = {name: kinds[name] for name in _OF_A_FILM}
    shapes = [name for name, kind in kinds.items() if is_complete(kind)]
    chosen = SURFACES.name_of(type(body.surface))
    yield _choice(f"{path}.surface", f"{side} surface", shapes, chosen)
    solids = (RIGID, OWN, *_materials())
    yield _choice(f"{path}.solid", f"{side} solid", solids, _substrate_name(body))
    if isinstance(scene, ContactScene):
        stack = body.stack
        layers = stack.layers if stack is not None else ()
        for i in range(_LAYERS):
            name = _name_of(layers[i].material) if i < len(layers) else NONE
            options = (NONE, *_materials())
            yield _choice(f"{path}.solid.layers.{i}", f"layer {i + 1}, {side}", options, name)


def _substrate_name(body: Body) -> str:
    """Choice that stands for the solid of a body; empty if none does."""
    if body.solid is None:
        return RIGID
    if type(body.solid) is Material:  # not one with more fields than the form has
        return _name_of(body.solid) or OWN
    if not isinstance(body.solid, Stack) or body.solid.name or body.solid.base is not None:
        return ""
    layers = body.solid.layers
    is_shown = len(layers) <= _LAYERS and all(_name_of(one.material) for one in layers)
    return _name_of(body.solid.substrate) if is_shown else ""


def _name_of(material: object) -> str:
    """Name of a material in the library; empty if it is not of it."""
    return next((name for name, one in _materials().items() if one == material), "")


@cache
def _materials() -> dict[str, Material]:
    """Materials of the library by name; its file is read once for each of them."""
    return {name: load_material(name) for name in library_names("materials.toml")}


@cache
def _liquids() -> dict[str, Liquid]:
    return {name: load_liquid(name) for name in library_names("liquids.toml")}


def _of_liquid(scene: Any) -> Choice:
    meniscus, known = scene.interface.meniscus, _liquids()
    chosen = NONE
    if meniscus is not None:
        chosen = next((name for name, one in known.items() if one == meniscus.liquid), "")
    return _choice("interface.meniscus.liquid", "liquid", (NONE, *known), chosen)


# The widgets of what is chosen ----------------------------------------------------------------


def parts_of(start: OpenedScene, chosen: Mapping[str, Any]) -> tuple[Part, ...]:
    """Parts of a form for what is chosen, by the paths of `choices_of`."""
    scene, given = start.scene, unstructure(start.scene)
    whole = isinstance(scene, ContactScene)
    taken = {choice.path: choice.chosen for choice in choices_of(start)} | dict(chosen)
    found = [part for side in _BODIES for part in _body_parts(scene, given, side, taken)]
    found += _liquid_parts(scene, given, taken["interface.meniscus.liquid"])
    if isinstance(scene, ContactScene):
        widgets = widgets_of(Window, "window", scene.window)
        found.append(Part(path="window", title="window", widgets=widgets, kind=Window))
    loadings = CONTACT_LOADINGS if whole else SEPARATION_LOADINGS
    found.append(
        _kind_part(loadings, "loading", taken["loading"], scene.loading, given.get("loading"))
    )
    found += _effect_parts(scene, given, taken)
    needs_heat = not whole or taken["interface.meniscus.liquid"] != NONE
    if needs_heat:
        heat = (w for w in widgets_of(type(scene), "", scene) if w.path == "temperature")
        found.append(Part(path="", title="temperature", widgets=tuple(heat), kind=type(scene)))
    settings = {"level", "grid"} if whole else {"level"}
    hidden = {one.name for one in attrs.fields(Accuracy)} - settings
    widgets = widgets_of(Accuracy, "accuracy", start.accuracy, hidden)
    rest = {n: start.accuracy.values[n] for n in start.accuracy.given - settings}
    found.append(Part(path="accuracy", title="accuracy", widgets=widgets, kind=Accuracy, rest=rest))
    return tuple(found)


def _kind_part(
    registry: Any, path: str, name: str, owner: object, given: Any, is_contact: bool = False
) -> Part:
    """Part of an object of a family: of a chosen kind, or as it is given."""
    title = path.removeprefix("interface.").replace(".", ", ")
    if name == AS_GIVEN:
        return Part(path=path, title=title, rest=deepcopy(given))
    kind = registry.find(name)
    same = owner if type(owner) is kind else None
    hidden = _OF_FILMS if kind is Flat and is_contact else ()
    hidden = _OF_A_FILE if kind is Measured and same is not None else hidden
    widgets = widgets_of(kind, path, same, hidden)
    shown = {widget.path.removeprefix(f"{path}.").partition(".")[0] for widget in widgets}
    kept = {} if same is None else {k: v for k, v in (given or {}).items() if k not in shown}
    tag = getattr(registry, "tag", "effect")
    return Part(path=path, title=title, widgets=widgets, kind=kind, rest=kept | {tag: name})


def _body_parts(
    scene: Any, given: Mapping[str, Any], side: str, taken: Mapping[str, Any]
) -> Iterator[Part]:
    path, body = f"interface.{side}", getattr(scene.interface, side)
    table = given.get("interface", {}).get(side, {})
    surface = table if body.solid is None else table.get("surface", {})
    chosen, contact = taken[f"{path}.surface"], isinstance(scene, ContactScene)
    yield _kind_part(SURFACES, f"{path}.surface", chosen, body.surface, surface, contact)
    name = taken[f"{path}.solid"]
    if name == RIGID:
        return
    place, title = f"{path}.solid", f"{side}, solid"
    if name == AS_GIVEN:
        yield Part(path=place, title=title, rest=deepcopy(table.get("solid")))
        return
    layers = [taken.get(f"{place}.layers.{i}", NONE) for i in range(_LAYERS)]
    names = [layer for layer in layers if layer != NONE]
    below = f"{place}.substrate" if names else place
    own = body.solid if type(body.solid) is Material and name == OWN else None
    widgets = list(_thicknesses(body, place, names))
    if name == OWN:
        widgets += widgets_of(Material, below, own, skip=_SAID)
    said = {} if own is None else unstructure(own)
    rest: Any = {k: said[k] for k in _SAID if k in said} if name == OWN else name
    if names:
        stacked = [{"material": layer} for layer in names]
        rest = {"layers": stacked, "substrate": rest}
    yield Part(path=place, title=title, widgets=tuple(widgets), kind=Material, rest=rest)


def _thicknesses(body: Body, place: str, names: Sequence[str]) -> Iterator[Widget]:
    stack = body.stack
    layers = stack.layers if stack is not None else ()
    for i, name in enumerate(names):
        same = layers[i] if i < len(layers) and _name_of(layers[i].material) == name else None
        (widget,) = widgets_of(Layer, f"{place}.layers.{i}", same, skip=("material",))
        yield attrs.evolve(widget, label=f"thickness of {name}")


def _liquid_parts(scene: Any, given: Mapping[str, Any], name: str) -> Iterator[Part]:
    if name == NONE:
        return
    meniscus = scene.interface.meniscus
    table = given.get("interface", {}).get("meniscus", {})
    widgets = widgets_of(Meniscus, "interface.meniscus", meniscus)
    liquid = table.get("liquid") if name == AS_GIVEN else name
    yield Part(
        path="interface.meniscus",
        title="liquid",
        widgets=widgets,
        kind=Meniscus,
        rest={"liquid": liquid},
    )


def _effect_parts(scene: Any, given: Mapping[str, Any], taken: Mapping[str, Any]) -> Iterator[Part]:
    is_contact = isinstance(scene, ContactScene)
    known = CONTACT_EFFECTS if is_contact else SEPARATION_EFFECTS
    names = list(taken[EFFECTS])
    if is_contact:
        names.insert(0, _elasticity(scene, taken))
    tables = {one["effect"]: one for one in given.get("effects", ())}
    for name in names:
        owner = next((effect for effect in scene.effects if effect.name == name), None)
        part = _kind_part(known, f"{EFFECTS}.{name}", name, owner, tables.get(name))
        yield attrs.evolve(part, title=name.replace("-", " "), rest=part.rest | {"effect": name})


def _elasticity(scene: Any, taken: Mapping[str, Any]) -> str:
    """Elasticity that the solids call for: with layers, or without."""
    for side in _BODIES:
        place = f"interface.{side}.solid"
        if taken[place] == AS_GIVEN and getattr(scene.interface, side).stack.layers:
            return _ELASTIC[1]
        has_layers = any(taken.get(f"{place}.layers.{i}", NONE) != NONE for i in range(_LAYERS))
        if taken[place] not in (AS_GIVEN, RIGID) and has_layers:
            return _ELASTIC[1]
    return _ELASTIC[0]


# The scene ------------------------------------------------------------------------------------


def tables_of(parts: Sequence[Part], values: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a scene file from the texts of widgets, which are by path.

    A text that is not given is that of the start; one that says the default is left out.
    """
    tables: dict[str, Any] = {EFFECTS: []}
    for part in parts:
        if part.path:
            _put(tables, part.path, deepcopy(part.rest))
        for widget in part.widgets:
            text = values.get(widget.path, widget.value)
            value = value_of_text(widget, text)
            shown = ("yes" if text else "no") if isinstance(text, bool) else str(text).strip()
            if value is not None and (widget.is_required or shown != widget.default):
                _put(tables, widget.path, value)
    accuracy = tables.get("accuracy")
    if not accuracy:
        tables.pop("accuracy", None)
    return tables


def _put(tables: dict[str, Any], path: str, value: Any) -> None:
    """Set a value by its path: an effect by its name, an item of a list by its number."""
    at: Any = tables
    *before, last = path.split(".")
    for i, segment in enumerate(before):
        if segment == EFFECTS and i == 0:
            at = at[EFFECTS]
        elif isinstance(at, list):
            at = at[int(segment)] if segment.isdecimal() else _effect_in(at, segment)
        else:
            below = at.setdefault(segment, {})
            if not isinstance(below, dict | list):  # a kind by its plain name
                tag = "law" if segment == "law" else "kind"
                below = at[segment] = {tag: below}
            at = below
    if isinstance(at, list):
        at.append(value)
    else:
        at[last] = value


def _effect_in(effects: list[Any], name: str) -> Any:
    return next(one for one in effects if one["effect"] == name)


def made_of(start: OpenedScene, parts: Sequence[Part], values: Mapping[str, Any]) -> Made:
    """Make the scene of a form; each problem has the path of the widget it belongs to."""
    tables = tables_of(parts, values)
    problems: dict[str, list[str]] = {}
    for part in parts:
        for widget in part.widgets:
            if widget.is_required and not str(values.get(widget.path, widget.value)).strip():
                unit = f" [{widget.unit}]" if widget.unit not in ("", "-") else ""
                range_ = f", which must {widget.expected}{unit}" if widget.expected else ""
                problems.setdefault(widget.path, []).append(f"give the {widget.label}{range_}")
    kind = ContactScene if isinstance(start.scene, ContactScene) else SeparationScene
    try:
        opened = OpenedScene(*read_scene({"name": start.scene.name} | tables, kind, "the form"))
    except ContactkitError as error:
        for path, text in placed(error, parts):
            if path not in problems and not (problems and "missing key" in text):
                problems.setdefault(path, []).append(text)
        return Made(opened=None, tables=tables, problems=problems)
    return Made(opened=opened, tables=tables, problems={})


def placed(error: ContactkitError, parts: Sequence[Part]) -> Iterator[tuple[str, str]]:
    """Messages of an error, each with the path of the widget that it is about; empty for none."""
    if isinstance(error, FileError):
        for one in error.problems:
            yield _place(one.text, one.place, parts), one.text
    else:
        name = error.field if isinstance(error, DescriptionError) else ""
        yield _place(name, "", parts), str(error)


def _place(text: str, place: str, parts: Sequence[Part]) -> str:
    """Path of the widget that a message begins with, ``Class.field``; empty if there is none."""
    owner, _, key = text.partition(" ")[0].rpartition(".")
    widgets = [(part.kind, widget.path) for part in parts for widget in part.widgets]
    named = [(kind, path) for kind, path in widgets if path.rpartition(".")[2] == key]
    of_class = [path for kind, path in named if kind is not None and kind.__name__ == owner]
    found = of_class or [path for _, path in named]
    near = [path for path in found if place and path.startswith(place)]
    return (near or found or [""])[0]


def with_problem(
    problems: Mapping[str, Sequence[str]], error: ContactkitError | None, parts: Sequence[Part]
) -> dict[str, list[str]]:
    """The problems of a form and one that was found later, each by the path of its widget."""
    found = {path: list(texts) for path, texts in problems.items()}
    for path, text in placed(error, parts) if error is not None else ():
        found.setdefault(path, []).append(text)
    return found
