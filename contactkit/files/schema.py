"""JSON Schema of scene files, by which editors complete and check them."""

from __future__ import annotations

import inspect
import re
import types
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import attrs

from ..accuracy import Accuracy
from ..kinds import (
    CONTACT_EFFECTS,
    KINDS,
    LOADINGS,
    SEPARATION_EFFECTS,
    SLIDING_SCENE_EFFECTS,
    SOLIDS,
)
from ..liquids.liquid import Liquid
from ..registry import Registries, Registry, family_of
from ..scene.interface import Body
from ..scene.loading import ContactLoading, Sliding
from ..scene.materials import Material, RigidBase, Solid, Stack
from ..scene.meniscus import Meniscus
from ..scene.scenes import ContactScene, Scene, SeparationScene, SlidingScene
from ..scene.surfaces import Surface
from ..units import quantity_pattern
from .meniscus_amount import AMOUNT_KEYS, AMOUNT_UNITS
from .parameter_texts import parameter_texts
from .structure import library_names, resolved

__all__ = ["scene_schema"]

Part = dict[str, Any]
"""A schema of a value."""

_EXAMPLES = {
    "m": "5 um",
    "m2": "1 um2",
    "m3": "0.1 mm3",
    "m/s": "1 mm/s",
    "m2/s": "105 mm2/s",
    "s": "1 ms",
    "Hz": "1 kHz",
    "kg": "20 g",
    "kg/m3": "880 kg/m3",
    "N": "40 N",
    "N/m": "30 mN/m",
    "Pa": "20 MPa",
    "Pa.s": "1 mPa.s",
    "J/m2": "50 mJ/m2",
    "J": "1e-19 J",
    "K": "20 degC",
    "rad": "60 deg",
}
_SCENES: tuple[tuple[type[Scene], Any], ...] = (
    (ContactScene, CONTACT_EFFECTS),
    (SlidingScene, SLIDING_SCENE_EFFECTS),
    (SeparationScene, SEPARATION_EFFECTS),
)
_STUDY: Part = {
    "description": "Values of a study by dotted path, such as `loading.pressure`, in quotes; all "
    "combinations are run. Paths with commas vary together: a row of values for each.",
    "type": "object",
    "additionalProperties": {"type": "array", "minItems": 1},
}


def scene_schema(devices: Mapping[str, type] | None = None) -> dict[str, Any]:
    """JSON Schema (draft 7) of scene files of every kind, as editors of TOML read it.

    It is made from the fields of the classes, their units, texts and defaults, and the names of
    all kinds: those of contactkit, registered ones, those of installed packages. A key that the
    reader refuses is refused, and so are a kind that is not known, a number in place of a word, a
    text without a unit or in the wrong one.

    Parameters
    ----------
    devices : mapping of str to type, optional
        Classes of devices by their names in files; none without it.

    Returns
    -------
    dict
        The schema, of plain values.

    Notes
    -----
    Left to the reader, and to ``contactkit check``: ranges of numbers; keys that exclude each
    other, such as a volume and a pressure of the liquid; the dimension of a product of units; a
    whole number written as ``2.0``; what the physics of a scene asks for; the paths of a study.

    Examples
    --------
    >>> made = scene_schema()
    >>> layer = made["definitions"]["Layer"]
    >>> layer["required"], layer["properties"]["thickness"]["description"]
    (['material', 'thickness'], 'How thick it is [m]. A number in m, or a text such as "5 um".')
    """
    made = _Definitions()
    contact, sliding, separation = (made.scene(kind, effects) for kind, effects in _SCENES)
    cases = [(_is_contact(), contact), (_loading_among(Sliding), sliding)]
    if devices:
        cases.insert(0, (_has("device"), made.tagged("device", devices, "device")))
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Scene file of contactkit",
        "type": "object",
        **_either(cases, separation),
        "anyOf": [made.any_scene(), {}],
        "definitions": made.parts,
    }


class _Definitions:
    """Schemas of classes, each made once, and references to them."""

    def __init__(self) -> None:
        self.parts: dict[str, Part] = {}
        self._open: list[str] = []  # families of which a kind is being made
        self._special: Mapping[Any, Callable[[], Part]] = {
            Liquid: self._liquid,
            Material: self._material,
            Solid: self._solid,
            Body: self._body,
            Meniscus: self._meniscus,
        }

    def scene(self, kind: type[Scene], effects: Registry[Any] | Registries[Any]) -> Part:
        """Schema of a file of one kind of scene."""

        def make() -> Part:
            made = self._fields(kind)
            listed = made["properties"]["effects"]
            listed["items"] = self.tagged("effect", effects.by_name, kind.__name__)
            made["properties"] |= {"accuracy": self._value(Accuracy), "study": _STUDY}
            return made

        return self._defined(kind.__name__, make)

    def any_scene(self) -> Part:
        """The keys of every kind of file, for completion alone, each once."""
        found: dict[str, list[Part]] = {}
        for name in [n for n in self.parts if n.startswith("device-") or n.endswith("Scene")]:
            for key, part in self.parts[name]["properties"].items():
                listed = found.setdefault(key, [])
                listed += [part] if part not in listed else []
        return {
            "properties": {
                key: parts[0] if len(parts) == 1 else {"anyOf": parts}
                for key, parts in found.items()
            }
        }

    def tagged(
        self, tag: str, kinds: Mapping[str, type], family: str, optional: Sequence[str] = ()
    ) -> Part:
        """Schema of a table that names its kind; it has the keys of that kind."""
        parts = {}
        for name, kind in kinds.items():
            if not _is_array(kind):
                home = KINDS.of(kind)
                make = partial(self._kind, tag, name, kind, name not in optional)
                parts[name] = self._defined(f"{home.family if home else family} {name}", make)
        cases = [(_names(tag, [name]), part) for name, part in parts.items()]
        known = {"properties": {tag: {"enum": list(parts)}}}
        return {"type": "object", "required": [tag]} | _either(cases, refused=known)

    def _kind(self, tag: str, name: str, kind: type, needs_tag: bool) -> Part:
        made = self._fields(kind)
        made["properties"] = {tag: {"const": name}} | made["properties"]
        if needs_tag:
            made["required"] = [tag, *made.get("required", ())]
        return made

    def _defined(self, name: str, make: Callable[[], Part]) -> Part:
        """Reference to a definition, made if it is new; of recursive kinds, too."""
        name = re.sub(r"[^\w]+", "-", name)
        if name not in self.parts:
            self.parts[name] = {}
            self.parts[name] |= make()
        return {"$ref": f"#/definitions/{name}"}

    def _fields(self, kind: type) -> Part:
        """Schema of a table with the fields of a class."""
        resolved(kind)
        texts = parameter_texts(kind)
        fields = [a for a in attrs.fields(kind) if a.init and a.name[0] != "_"]
        needed = [a.alias for a in fields if a.default is attrs.NOTHING]
        return {
            "description": inspect.cleandoc(kind.__doc__ or "").partition("\n")[0],
            "type": "object",
            "properties": {a.alias: self._field(a, texts.get(a.name, "")) for a in fields},
            **({"required": needed} if needed else {}),
            "additionalProperties": False,
        }

    def _field(self, attribute: attrs.Attribute[Any], text: str) -> Part:
        unit = attribute.metadata.get("unit", "")
        made = _described(self._value(attribute.type, unit), _text(text, unit))
        value = attribute.default
        is_plain = isinstance(value, bool | int | float | str) and value != ""
        return made | ({"default": value} if is_plain else {})

    def _value(self, kind: Any, unit: str = "") -> Part:
        """Schema of a value of a type; quantities have a unit."""
        members = _members(kind)
        if unit:
            return self._quantity(members, unit)
        words = [word for one in members for word in _words(one)]
        tables = [one for one in members if not _words(one)]
        if not tables:
            return {"enum": words}
        if set(tables) == {Material, RigidBase}:
            base = self._value(RigidBase)
            return _either([(_has("bonded"), base)], self._material())
        (table,) = tables
        if words:
            return _either([({"type": ["string", "boolean"]}, {"enum": words})], self._value(table))
        return self._plain(table)

    def _plain(self, kind: Any) -> Part:
        """Schema of a value of one type without a unit."""
        if get_origin(kind) is tuple:
            return {"type": "array", "items": self._value(get_args(kind)[0])}
        if kind in self._special:
            return self._special[kind]()
        if kind is str:
            return {"type": "string"}
        if attrs.has(kind):
            if family_of(kind):
                return self._family(kind)
            return self._defined(kind.__name__, lambda: self._fields(kind))
        return {"type": ["string", "object"]}  # of any type: what a class reads itself

    def _family(self, base: type, unit: str = "") -> Part:
        """Schema of a table of a family: of the kinds that are of a class, and give a unit."""
        registry = KINDS.of(base)
        assert registry is not None
        kinds = {
            name: kind
            for name, kind in registry.by_name.items()
            if issubclass(kind, base) and (not unit or getattr(kind, "unit", "") == unit)
        }

        def make() -> Part:
            made = self.tagged(registry.tag, kinds, registry.family)
            if not registry.plain:
                return made
            names = [name for name, kind in kinds.items() if not _required(kind)]
            return _either([(_TEXT, {"enum": names})], made)

        def inner() -> Part:
            # Not without properties: Taplo would never end on a reference to it with a text.
            rest = {key: part for key, part in make().items() if key != "anyOf"}
            names = [name for name, kind in kinds.items() if not _is_array(kind)]
            return rest | {"properties": {registry.tag: {"enum": names}}}

        name = f"{base.__name__} {unit}".strip()
        if name not in self._open:
            self._open.append(name)
            made = self._defined(name, make)
            self._open.remove(name)
            return made
        # Taplo lists the keys of all tables below: with planforms in planforms in surfaces on
        # surfaces its language server hung; without completion of the inner ones it takes 0.7 s.
        return self._defined(f"{name} inside", inner)

    def _quantity(self, members: Sequence[Any], unit: str) -> Part:
        """Schema of a number, a text with its unit, a list of them, a word, or a law."""
        words = [word for one in members for word in _words(one)]
        numbers = [one for one in members if one in (int, float)]
        lists = [one for one in members if get_origin(one) is tuple]
        tables = [one for one in members if attrs.has(one) and not _is_array(one)]
        if words and not numbers:
            return {"enum": words}
        # A class takes one value in place of a list of any length.
        numbers = numbers or [
            one for many in lists if ... in get_args(many) for one in _members(get_args(many)[0])
        ]
        made: Part = _number(numbers, unit, words, is_whole=members == [int])
        for one in lists:
            made["type"].append("array")
            first, *more = get_args(one)
            made["items"] = self._value(first, unit)
            if ... not in more:
                made |= {"minItems": 1 + len(more), "maxItems": 1 + len(more)}
        if words:
            made["anyOf"] = [{"enum": words}, {}]
        if tables:
            law = self._family(tables[0], unit) if family_of(tables[0]) else self._value(tables[0])
            made["type"].append("object")
            made |= _either([({"type": "object"}, law)])
        return made

    def _liquid(self) -> Part:
        made = self._defined("Liquid", lambda: self._fields(Liquid))
        return _either([(_TEXT, {"enum": list(library_names("liquids.toml"))})], made)

    def _material(self) -> Part:
        return self._solids(Material, list(library_names("materials.toml")))

    def _solid(self) -> Part:
        return self._solids(Solid, [*library_names("materials.toml"), "rigid"])

    def _solids(self, base: type, words: list[str]) -> Part:
        """Schema of a solid by its name or as a table, of which keys alone tell some kinds."""
        kinds = {name: kind for name, kind in SOLIDS.by_name.items() if issubclass(kind, base)}

        def make() -> Part:
            named = self.tagged(SOLIDS.tag, kinds, SOLIDS.family, SOLIDS.implied)
            cases = [(_TEXT, {"enum": words}), (_has(SOLIDS.tag), named)]
            if Stack in kinds.values():
                layered = {"anyOf": [_has(key) for key in ("substrate", "layers")]}
                cases.append((layered, {"$ref": "#/definitions/solid-stack"}))
            return _either(cases, {"$ref": "#/definitions/solid-material"})

        return self._defined(f"{base.__name__}", make)

    def _body(self) -> Part:
        return self._defined(
            "Body",
            lambda: _either(
                [(_has("shape"), self._value(Surface))],
                self._defined("Body with a solid", lambda: self._fields(Body)),
            ),
        )

    def _meniscus(self) -> Part:
        """Schema of a meniscus, with the keys that files alone have."""

        def make() -> Part:
            made = self._fields(Meniscus)
            for form in (Meniscus.from_radius, Meniscus.from_coverage):
                hints, texts = get_type_hints(form), parameter_texts(form)
                for key in (key for key in AMOUNT_KEYS if key in hints):
                    unit = AMOUNT_UNITS.get(key, "")
                    value = self._value(hints[key], unit)
                    made["properties"].setdefault(
                        key, _described(value, _text(texts.get(key, ""), unit))
                    )
            return made

        return self._defined("Meniscus", make)


_TEXT: Part = {"type": "string"}


def _either(
    cases: Sequence[tuple[Part, Part]], otherwise: Part | None = None, refused: Part | None = None
) -> Part:
    """Schema of the first case whose condition holds; else `otherwise`, or what refuses the value.

    Of conditions the message is about the key that is wrong, not about all cases; but Taplo does
    not complete from them, so that the cases are also listed beside one that always holds.
    """
    chain: Part = otherwise or refused or {}
    for condition, part in reversed(cases):
        chain = {"if": condition, "then": part} | ({"else": chain} if chain else {})
    listed = [part for _, part in cases] + ([otherwise] if otherwise else [])
    return {"anyOf": [*listed, {}], **chain}


def _has(key: str) -> Part:
    """Condition that a value is a table with a key."""
    return {"type": "object", "required": [key]}


def _names(tag: str, names: Sequence[str]) -> Part:
    """Condition that a table names one of some kinds."""
    return _has(tag) | {"properties": {tag: {"enum": list(names)}}}


def _loading_among(base: type) -> Part:
    """Condition that a scene has a loading of some class."""
    names = [name for name, kind in LOADINGS.by_name.items() if issubclass(kind, base)]
    return _has("loading") | {"properties": {"loading": _names("kind", names)}}


def _is_contact() -> Part:
    """Condition of a contact: its loading; with none that is known, a window."""
    window = _has("window") | {"not": _loading_among(object)}
    return {"anyOf": [_loading_among(ContactLoading), window]}


def _number(kinds: Sequence[Any], unit: str, words: Sequence[str], *, is_whole: bool) -> Part:
    """Schema of a number or a text; of a whole number only what is of this type alone is read."""
    if not kinds:
        return {"type": []}
    if float not in kinds:
        text = {"pattern": r"^\s*[-+]?\d{1,18}\s*$"} if is_whole else {}
        return {"type": ["integer", *(["string"] if is_whole else [])], **text}
    pattern = quantity_pattern(unit)
    if words:
        pattern = f"{pattern}|^(?:{'|'.join(words)})$"
    return {"type": ["number", "string"], "pattern": pattern}


def _members(kind: Any) -> list[Any]:
    """Types of a union, without None; a type alone."""
    is_union = get_origin(kind) in (Union, types.UnionType)
    return [one for one in (get_args(kind) if is_union else (kind,)) if one is not types.NoneType]


def _words(kind: Any) -> tuple[Any, ...]:
    """Values of a type of a few values."""
    return get_args(kind) if get_origin(kind) is Literal else (True, False) if kind is bool else ()


def _required(kind: type) -> list[str]:
    return [a.alias for a in attrs.fields(kind) if a.init and a.default is attrs.NOTHING]


def _is_array(kind: type) -> bool:
    """Whether a class needs an array, which no scene file holds."""
    return any("in_file" in a.metadata and a.default is attrs.NOTHING for a in attrs.fields(kind))


def _text(text: str, unit: str) -> str:
    """Text of a field with the unit of its numbers, and an example of a text."""
    if unit in ("", "-"):
        return text
    example = _EXAMPLES.get(unit, f"2.5 {unit}")
    return f'{text} A number in {unit}, or a text such as "{example}".'.strip()


def _described(made: Part, text: str) -> Part:
    """A schema with a text; beside a reference draft 7 reads nothing."""
    if not text:
        return dict(made)
    return {"description": text, **({"allOf": [made]} if "$ref" in made else made)}
