"""Tables of plain values to scene objects: quantities by their units, kinds by their names."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from importlib import resources
from pathlib import Path
from typing import Any, Literal, NamedTuple, TypeVar, get_args

import attrs
import cattrs
from cattrs.gen import make_dict_structure_fn, override

from .. import data
from ..errors import DescriptionError, nearest
from ..kinds import (
    CONTACT_EFFECTS,
    KINDS,
    LOADINGS,
    SEPARATION_EFFECTS,
    SLIDING_EFFECTS,
    SOLIDS,
)
from ..liquids.liquid import Liquid
from ..registry import Registries, Registry, family_of
from ..scene.interface import Body, Interface
from ..scene.loading import Loading
from ..scene.materials import Material, RigidBase, Solid, Stack
from ..scene.meniscus import Meniscus
from ..scene.scenes import ContactScene, Scene
from ..scene.surfaces import Surface
from ..units import parse_quantity
from ..validators import check_text
from .meniscus_amount import AMOUNT_KEYS, amount_of, check_flat, with_amount
from .toml_lines import line_of, lines_of_keys
from .unstructure import unstructure, with_arrays

__all__ = [
    "FileError",
    "FileProblem",
    "field_value",
    "library_names",
    "load_liquid",
    "load_material",
    "read_part",
    "renamed",
    "resolved",
    "structure",
    "telling_lines",
    "unstructure",
    "with_arrays",
]

_T = TypeVar("_T")


# Keys of earlier files, and their replacements.
_RENAMED = {
    "opening": """[loading] with kind = "imposed-speed", "imposed-force" or "imposed-time\"""",
    "pressing": """[loading] with kind = "pressing" (a pressure or a force) or "approach\"""",
    "tension": "strength, the tension at which the full film cavitates",
    "sliding": """[loading] with kind = "sliding\"""",
    "damping": """the planform of a body: upper = { shape = "flat", planform = { shape = "ring", """
    """... } }""",
    "tear_time": "inception_time",
    "heal_time": "reformation_time",
    "n_tears": "n_inceptions",
    "n_heals": "n_reformations",
    "tension_limits": "strengths and cavity_pressures [Pa]: two numbers say how a liquid cavitates",
}


# Fields that became fields of a choice, or the choice itself, by effect and key.
_MOVED = {
    ("MeniscusForce", "pulled"): 'profile = { kind = "as-published", pulled = ... }',
    ("MeniscusForce", "radius"): 'profile = { kind = "as-published", radius = ... }',
    ("Rupture", "criterion"): 'gap = "limit" or "zero-neck", in place of a length',
    ("HardnessLimit", "hardness"): 'rule = { kind = "constant", hardness = ... }',
    ("HardnessLimit", "shift"): 'rule = { kind = "continuous", shift = ... }',
    ("HardnessLimit", "displacement"): 'rule = { kind = "continuous", displacement = ... }',
}


def _moved(kind: type, key: str) -> str:
    """Name the replacement of a field that a class had before; empty if there is none."""
    now = _MOVED.get((kind.__name__, key))
    return f"it is now {now}" if now else ""


def renamed(key: str) -> str:
    """Name the replacement of a key of earlier files, or nearly so; empty if it never was one."""
    import difflib  # for this alone

    former = difflib.get_close_matches(key, _RENAMED, n=1, cutoff=0.85)
    if not former:
        return ""
    return f"{'it' if former[0] == key else former[0]} is now {_RENAMED[former[0]]}"


def _owners(kind: type, key: str) -> str:
    """Name the kinds beside one, of the same family, that have a key; empty if none has."""
    registry = KINDS.of(kind)
    if registry is None or not registry.name_of(kind):
        return ""
    names = [name for name, one in registry.by_name.items() if key in _keys(one)]
    return f"it belongs to {' or '.join(names)}; " if names else ""


def _tagged(known: Registry[Any] | Registries[Any], tag: str) -> Callable[[Any, Any], Any]:
    """Structure a table by the name of its kind under `tag`; kinds may be registered later."""

    def hook(value: Any, _: Any) -> Any:
        if isinstance(value, str) and getattr(known, "plain", False):
            value = {tag: value}
        if not isinstance(value, Mapping):
            raise DescriptionError(tag, value, f"be a table with a key {tag!r}")
        rest = dict(value)
        kind = _found(known, rest.pop(tag, None), tag)
        # A class that is its own base would come here again, without its name.
        return (
            _attrs_class(kind)(rest, kind) if _is_base(kind) else _CONVERTER.structure(rest, kind)
        )

    return hook


def _found(known: Registry[Any] | Registries[Any], name: Any, tag: str) -> type:
    """Find a kind; the message names the family that has one of this name, or how to add one."""
    try:
        return known.find(name, tag)
    except DescriptionError as error:
        if not isinstance(name, str) or not error.hint.startswith("known"):
            raise
        names = dict.fromkeys(one.family for one in KINDS._registries() if one.get(name))
        cure = f"it is a {' and a '.join(names)}" if names else error.hint + _OWN
        raise DescriptionError(tag, name, error.expected, hint=cure) from None


_OWN = "; one of your own: ck.register, and on the command line --plugin FILE.py"


def _of_family(base: type) -> Callable[[Any, Any], Any]:
    """Structure a table of a family, whose base class is the type of a field."""
    registry = KINDS.of(base)
    assert registry is not None
    return _tagged(registry, registry.tag)


def _is_choice(kind: Any) -> bool:
    """Whether a type is one of some words or an object of a family."""
    return any(map(_is_base, get_args(kind))) and any(get_args(one) for one in get_args(kind))


def _choice(kind: Any) -> Callable[[Any, Any], Any]:
    """Structure a word as it is, which the field checks, and a table by its kind."""
    table = _of_family(next(filter(_is_base, get_args(kind))))
    return lambda value, target: value if isinstance(value, str) else table(value, target)


def _is_base(kind: Any) -> bool:
    """Whether a type is the base class of a family."""
    return isinstance(kind, type) and "family" in vars(kind) and bool(family_of(kind))


def _quantity(kind: type, attribute: attrs.Attribute[Any]) -> Callable[[Any, Any], Any]:
    unit, field = attribute.metadata["unit"], f"{kind.__name__}.{attribute.name}"
    cure = attribute.metadata.get("in_file")
    # Words allowed in place of a number, such as "vapour".
    words = [w for one in get_args(attribute.type) for w in get_args(one) if isinstance(w, str)]
    # Classes allowed there, such as the law of a property.
    tables = [one for one in get_args(attribute.type) if attrs.has(one)]

    def hook(value: Any, target: Any) -> Any:
        if getattr(value, "ndim", 0):
            return value
        if cure is not None:
            raise DescriptionError(field, value, "be an array in hand", unit=unit, hint=cure)
        if isinstance(value, Mapping) and tables:
            return _CONVERTER.structure(value, tables[0])
        if value in words or isinstance(value, bool) or (unit == "-" and isinstance(value, int)):
            return value
        if isinstance(value, list | tuple):
            return tuple(hook(item, target) for item in value)
        if attribute.type is int and isinstance(value, str):
            return value  # which the class reads itself
        return parse_quantity(value, unit, field)

    return hook


def field_value(kind: type, name: str, value: Any) -> Any:
    """Read a value of a field as in a file: quantities with units, objects by their names.

    Parameters
    ----------
    kind : type
        Class that has the field.
    name : str
        Name of the field.
    value : object
        Value to read; an object of contactkit, or None, is returned unchanged.

    Examples
    --------
    >>> from contactkit.scene.materials import Layer
    >>> field_value(Layer, "thickness", "5 nm")
    5e-09
    >>> field_value(Layer, "material", "dlc").name
    'diamond-like carbon'
    """
    resolved(kind)
    attribute: attrs.Attribute[Any] = getattr(attrs.fields(kind), name)
    if value is None or attrs.has(type(value)):
        return value
    if "unit" in attribute.metadata:
        return _quantity(kind, attribute)(value, attribute.type)
    if attribute.type in (bool, str):
        return _CONVERTER.structure(value, attribute.type)
    is_object = any(attrs.has(one) for one in get_args(attribute.type) or (attribute.type,))
    if is_object and isinstance(value, str | Mapping | list):
        try:
            if name == "effects":
                return _effects(kind)(value, None)
            return _CONVERTER.structure(value, attribute.type)  # type: ignore[arg-type]
        except cattrs.ClassValidationError as error:
            raise FileError(f"{kind.__name__}.{name}", _problems(error)) from None
    return value


def resolved(kind: type) -> None:
    """Resolve the types of the fields of a class, also those imported for type checkers only."""
    attrs.resolve_types(kind, localns={"Map": Any, "Mask": Any})


class _ContactEffect:
    """Type of an effect in a file of a contact, for the converter."""


class _SeparationEffect:
    """Type of an effect in a file of a separation or a sliding, for the converter."""


def _effects(kind: type) -> Callable[[Any, Any], Any]:
    """Structure the effects of a scene: those that its kind of scene may list."""
    listed: Any = _ContactEffect if issubclass(kind, ContactScene) else _SeparationEffect
    return lambda value, _: _CONVERTER.structure(value, tuple[listed, ...])


def _attrs_class(kind: type, more: tuple[str, ...] = ()) -> Callable[[Any, Any], Any]:
    """Structure an attrs class: quantities with units; unknown keys refused with a suggestion.

    Keys of `more` may be suggested besides; who calls the hook has taken them out.
    """
    resolved(kind)
    hooks = {
        a.name: override(struct_hook=_quantity(kind, a))
        for a in attrs.fields(kind)
        if "unit" in a.metadata
    }
    if issubclass(kind, Scene):
        hooks["effects"] = override(struct_hook=_effects(kind))
    inner: Callable[[Any, Any], Any] = make_dict_structure_fn(kind, _CONVERTER, **hooks)  # type: ignore[arg-type]
    known = [a.alias for a in attrs.fields(kind) if a.init and a.name[0] != "_"]

    def hook(value: Any, target: Any) -> Any:
        if not isinstance(value, Mapping):
            raise DescriptionError(kind.__name__, value, "be a table")
        unknown = [
            DescriptionError(
                f"{kind.__name__}.{key}",
                value[key],
                "be a known key",
                hint=_moved(kind, key)
                or renamed(key)
                or _owners(kind, key) + nearest(key, (*known, *more)),
            )
            for key in value
            if key not in known
        ]
        return _made(
            lambda: inner({key: value[key] for key in value if key in known}, target),
            unknown,
            kind,
            lambda: _refused(kind, value),
        )

    return hook


def _made(
    make: Callable[[], Any],
    unknown: Sequence[Exception],
    kind: type,
    more: Callable[[], Iterable[Exception]] = tuple,
) -> Any:
    """Make the object of a table, or refuse all that is wrong with it.

    Beside an unknown key, one that is missing may be the same one. `more` finds what the first
    mistake kept from being seen.
    """
    try:
        made = make()
    except cattrs.ClassValidationError as error:
        found = [one for one in error.exceptions if not (unknown and isinstance(one, KeyError))]
        found = [*unknown, *found]
        said = {str(one) for one in found}
        found += [one for one in more() if str(one) not in said]
        raise cattrs.ClassValidationError(error.message, found, kind) from None
    if len(unknown) == 1:
        raise unknown[0]
    if unknown:
        raise cattrs.ClassValidationError("unknown keys", unknown, kind)
    return made


def _refused(kind: type, value: Mapping[str, Any]) -> Iterator[DescriptionError]:
    """Refusals of single fields of a table, each by the validator of its class."""
    owner: Any = object.__new__(kind)  # for its name: it has no fields
    for one in attrs.fields(kind):
        if one.alias not in value:
            continue
        # Wrong in itself, which was found, or in relation to other fields.
        with suppress(
            AttributeError, TypeError, ValueError, LookupError, cattrs.BaseValidationError
        ):
            try:
                given, converter = field_value(kind, one.name, value[one.alias]), one.converter
                if not isinstance(given, str):
                    check_text(kind.__name__, one, given)
                if one.validator is not None:
                    one.validator(owner, one, given if converter is None else converter(given))
            except FileError:
                continue  # of a table in it, which states its own
            except DescriptionError as refusal:
                yield refusal


def _liquid(value: Any, _: Any) -> Liquid:
    if isinstance(value, str):
        return load_liquid(value)
    made: Liquid = _LIQUID(value, Liquid)
    return made


def _material(value: Any, _: Any) -> Material:
    if isinstance(value, str):
        return load_material(value)
    made: Material = _of_kind(value) if _has_kind(value) else _MATERIAL(value, Material)
    return made


def _meniscus(value: Any, _: Any) -> Meniscus:
    """A table of a meniscus; its amount may be a radius or a coverage at a gap."""
    given = amount_of(value) if isinstance(value, Mapping) else {}
    rest = {key: value[key] for key in value if key not in given} if given else value
    made: Meniscus = _MENISCUS(rest, Meniscus)
    return with_amount(made, given) if given else made


def _interface(value: Any, _: Any) -> Interface:
    made: Interface = _INTERFACE(value, Interface)
    check_flat(value, made)
    return made


def _body(value: Any, _: Any) -> Body:
    """A table of a surface and a solid, or of a surface alone for a rigid body."""
    if isinstance(value, Mapping) and "shape" in value:
        if "solid" in value or "surface" in value:
            cure = "a body with a solid has its shape under surface: surface = { shape = ... }"
            raise DescriptionError("Body.shape", value["shape"], "stand alone", hint=cure)
        return Body(surface=_CONVERTER.structure(value, Surface))
    if not isinstance(value, Mapping):
        expected = "be a table with a key 'shape', or with surface and solid"
        raise DescriptionError("Body", value, expected)
    made: Body = _BODY(value, Body)
    return made


def _loading(value: Any, wanted: type[Loading]) -> Loading:
    """A table with the kind of a loading, and the fields of that kind only."""
    known = KINDS.of(wanted) or LOADINGS
    if not isinstance(value, Mapping):
        expected = f"name a loading: {' or '.join(map(repr, known.by_name))}"
        raise DescriptionError("loading", value, f"be a table with a key 'kind', to {expected}")
    given, fields = value.get("kind"), {key: value[key] for key in value if key != "kind"}
    kind = known.get(given) if isinstance(given, str) else None
    if kind is None:
        expected = f"name a loading: {' or '.join(map(repr, known.by_name))}"
        fits = [name for name, one in known.by_name.items() if fields.keys() <= _keys(one)]
        hint = f"its keys are those of kind = {' or '.join(map(repr, fits))}" if fits else ""
        raise DescriptionError("loading.kind", given, expected, hint=hint)
    unknown = list[Exception]()
    for key in sorted(fields.keys() - _keys(kind)):
        owners = [name for name, one in LOADINGS.by_name.items() if key in _keys(one)]
        hint = f"it belongs to {' or '.join(owners)}; " if owners else ""
        hint += nearest(key, sorted(_keys(kind)))
        expected = f"be a key of {given}"
        unknown.append(DescriptionError(f"loading.{key}", fields.pop(key), expected, hint=hint))
    made: Loading = _made(lambda: _attrs_class(kind)(fields, kind), unknown, kind)
    return made


def _keys(kind: type) -> set[str]:
    return {a.alias for a in attrs.fields(kind) if a.init}


def _bool(value: Any, _: Any) -> bool:
    """Only true and false: any string would count as true."""
    if not isinstance(value, bool):
        raise DescriptionError("value", value, "be true or false")
    return value


def _edges(value: Any, _: Any) -> Any:
    """true, false, or the axis along which a window repeats; the window checks which."""
    return value


def _has_kind(value: Any) -> bool:
    return isinstance(value, Mapping) and SOLIDS.tag in value


def _of_kind(value: Any) -> Any:
    """A solid of the kind that a table names; keys alone tell those of contactkit apart."""
    return _tagged(SOLIDS, SOLIDS.tag)(value, None)


def _solid(value: Any, _: Any) -> Solid | None:
    """A material, by name or as a table; a stack, which has a substrate; another kind; "rigid"."""
    if value is None or value == "rigid":
        return None
    if _has_kind(value):
        solid: Solid = _of_kind(value)
        return solid
    if isinstance(value, Mapping) and ("substrate" in value or "layers" in value):
        stack: Stack = _CONVERTER.structure(value, Stack)
        return stack
    return _material(value, Material)


def _carrier(value: Any, _: Any) -> Material | RigidBase:
    """What carries layers: a material, by name or as a table; or a base, bonded or not."""
    if isinstance(value, Mapping) and "bonded" in value:
        base: RigidBase = _CONVERTER.structure(value, RigidBase)
        return base
    return _material(value, Material)


def _as_text(value: Any, _: Any) -> Any:
    """A text; what is none is refused by its field, where cattrs would write it as one."""
    return value


_CONVERTER = cattrs.Converter()
_CONVERTER.register_structure_hook(bool, _bool)
_CONVERTER.register_structure_hook(str, _as_text)
_CONVERTER.register_structure_hook_factory(attrs.has, _attrs_class)
_CONVERTER.register_structure_hook_factory(_is_base, _of_family)
_CONVERTER.register_structure_hook_factory(_is_choice, _choice)
_CONVERTER.register_structure_hook(_ContactEffect, _tagged(CONTACT_EFFECTS, "effect"))
_CONVERTER.register_structure_hook(
    _SeparationEffect, _tagged(Registries(SEPARATION_EFFECTS, SLIDING_EFFECTS), "effect")
)
for _matches, _hook in (
    (lambda kind: kind is Liquid, _liquid),
    (lambda kind: kind is Material, _material),
    (lambda kind: kind == Solid | None, _solid),
    (lambda kind: kind == Material | RigidBase, _carrier),
    (lambda kind: kind == bool | Literal["x", "y"] | None, _edges),
    (lambda kind: kind is Body, _body),
    (lambda kind: kind is Meniscus, _meniscus),
    (lambda kind: kind is Interface, _interface),
    (lambda kind: isinstance(kind, type) and issubclass(kind, Loading), _loading),
):
    _CONVERTER.register_structure_hook_func(_matches, _hook)
# After the hooks, which these use for their fields.
_LIQUID, _MATERIAL, _BODY = _attrs_class(Liquid), _attrs_class(Material), _attrs_class(Body)
_MENISCUS, _INTERFACE = _attrs_class(Meniscus, AMOUNT_KEYS), _attrs_class(Interface)


def structure(tables: Mapping[str, Any], kind: type[_T], origin: str) -> _T:
    """Build an attrs object from tables.

    Parameters
    ----------
    tables : mapping
        As read from a TOML file.
    kind : type
        Attrs class to build.
    origin : str
        Where the tables come from, for messages.

    Raises
    ------
    DescriptionError
        Listing every mistake and where it is.
    """
    made, problems = read_part(tables, kind)
    if made is None:
        raise FileError(origin, problems)
    return made


def read_part(
    tables: Any, kind: type[_T], place: str = ""
) -> tuple[_T, list[FileProblem]] | tuple[None, list[FileProblem]]:
    """Build an object from the tables at a place of a file: the object, or all mistakes."""
    try:
        return _CONVERTER.structure(tables, kind), []
    except DescriptionError as error:
        return None, [FileProblem(str(error), place)]
    except cattrs.ClassValidationError as error:
        found = _problems(error)
    return None, [FileProblem(text, ".".join(filter(None, (place, at)))) for text, at in found]


def _problems(error: cattrs.ClassValidationError) -> list[FileProblem]:
    """Mistakes of a description, and the paths of what they belong to."""
    found = [one.partition(" @ $") for one in cattrs.transform_error(error, format_exception=_say)]
    return [FileProblem(text, place.lstrip(".")) for text, _, place in found]


class FileProblem(NamedTuple):
    """A mistake in a file, and the path of the table or key that it belongs to."""

    text: str
    place: str = ""

    def text_with_line(self, lines: dict[str, int]) -> str:
        """Mistake and place, with the line where that is known."""
        if not self.place:
            return self.text
        key = self.text.partition(" ")[0].rpartition(".")[2]
        inside = f"{self.place}.{key}"
        number = line_of(lines, inside if inside in lines else self.place)
        return f"{self.text}  at {self.place}" + (f", line {number}" if number else "")


_MOST_LISTED = 50  # errors of a file, in lines of a screen; a hostile file may have millions


class FileError(DescriptionError):
    """A file with errors, which the message lists."""

    def __init__(self, origin: str, problems: Sequence[FileProblem], text: str = "") -> None:
        super().__init__(origin, "", "be right")
        self.problems = tuple(problems)
        lines = lines_of_keys(text)
        shown = [problem.text_with_line(lines) for problem in problems[:_MOST_LISTED]]
        if len(problems) > _MOST_LISTED:
            shown.append(f"and {len(problems) - _MOST_LISTED} more")
        listed = "\n  ".join(shown)
        self.args = (f"{origin} cannot be used:\n  {listed}",)


@contextmanager
def telling_lines(path: Path) -> Iterator[None]:
    """Add the lines of a file to the mistakes that are found in it."""
    try:
        yield
    except FileError as error:
        text = path.read_text(encoding="utf-8", errors="replace")
        raise FileError(error.field, error.problems, text) from None


def _say(error: BaseException, _: type | None) -> str:
    if isinstance(error, KeyError):
        return f"missing key {error.args[0]!r}"
    return str(error)


def load_liquid(name: str) -> Liquid:
    """Load a liquid of the library by its name, such as ``"engine-oil-15w-40"`` or ``"water"``.

    Raises
    ------
    DescriptionError
        If there is no such liquid.

    Examples
    --------
    >>> round(load_liquid("water").at(298.15).viscosity * 1e3, 5)
    0.89044
    """
    return _of_library(name, Liquid, "liquids.toml")


def load_material(name: str) -> Material:
    """Load a material of the library by its name, such as ``"dlc"`` or ``"al2o3-tic"``.

    Raises
    ------
    DescriptionError
        If there is no such material.

    Examples
    --------
    >>> load_material("dlc").young_modulus
    140000000000.0
    """
    return _of_library(name, Material, "materials.toml")


def library_names(file: str) -> tuple[str, ...]:
    """Names of the liquids or materials in a file of the library."""
    return tuple(_library(file))


def _library(file: str) -> dict[str, Any]:
    return tomllib.loads(resources.files(data).joinpath(file).read_text("utf-8"))


def _of_library(name: str, kind: type[_T], file: str) -> _T:
    tables, what = _library(file), kind.__name__.lower()
    if name not in tables:
        raise DescriptionError(
            what, name, f"be a {what} of the library", hint=nearest(name, sorted(tables))
        )
    return structure(tables[name], kind, f"{file}, {name}")
