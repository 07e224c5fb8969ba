"""Scene files: TOML, read whole or refused with every reason."""

from __future__ import annotations

import difflib
import os
import tomllib
import uuid
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

import attrs
import cattrs
from cattrs.gen import make_dict_structure_fn, override

from .effects import EFFECTS, SeparationEffect
from .errors import DescriptionError
from .liquids import LAWS, Liquid
from .scene import SeparationScene
from .surfaces import Flat, Sphere
from .temperature_laws import TemperatureLaw
from .units import parse_quantity

__all__ = [
    "load_liquid", "load_scene", "nearest", "read_tables", "save_scene",
    "structure", "unstructure", "write_whole",
]  # fmt: skip

_T = TypeVar("_T")

_SHAPES: dict[str, type] = {"flat": Flat, "sphere": Sphere}
_TAGS: tuple[tuple[str, dict[str, type]], ...] = (
    ("shape", _SHAPES),
    ("effect", {kind.name: kind for kind in EFFECTS}),
    ("law", {kind.kind: kind for kind in LAWS}),
)


def nearest(name: object, known: list[str]) -> str:
    """Hint at the nearest of the known names, or list them."""
    close = difflib.get_close_matches(str(name), known, n=1, cutoff=0.5)
    return f"did you mean {close[0]!r}?" if close else f"known: {', '.join(known)}"


def _tagged(tag: str, kinds: Mapping[str, type]) -> Callable[[Any, Any], Any]:
    """Structure a table by the kind it names under `tag`."""

    def hook(value: Any, _: Any) -> Any:
        if not isinstance(value, Mapping):
            raise DescriptionError(tag, value, f"be a table with a key {tag!r}")
        rest = dict(value)
        name = rest.pop(tag, None)
        if name not in kinds:
            raise DescriptionError(
                tag, name, "name a known kind", hint=nearest(name, sorted(kinds))
            )
        return _CONVERTER.structure(rest, kinds[name])

    return hook


def _quantity(kind: type, attribute: attrs.Attribute[Any]) -> Callable[[Any, Any], Any]:
    unit, field = attribute.metadata["unit"], f"{kind.__name__}.{attribute.name}"

    def hook(value: Any, _: Any) -> Any:
        if isinstance(value, Mapping):
            return _law(value, TemperatureLaw)
        if value == "vapour" or isinstance(value, bool) or (unit == "-" and isinstance(value, int)):
            return value
        if isinstance(value, list):
            return tuple(parse_quantity(item, unit, field) for item in value)
        return parse_quantity(value, unit, field)

    return hook


def _attrs_class(kind: type) -> Callable[[Any, Any], Any]:
    """Structure an attrs class: quantities by their units, unknown keys refused with a guess."""
    attrs.resolve_types(kind, localns={"SeparationEffect": SeparationEffect})
    hooks = {
        a.name: override(struct_hook=_quantity(kind, a))
        for a in attrs.fields(kind)
        if "unit" in a.metadata
    }
    inner: Callable[[Any, Any], Any] = make_dict_structure_fn(kind, _CONVERTER, **hooks)  # type: ignore[arg-type]
    known = [a.alias for a in attrs.fields(kind) if a.init]

    def hook(value: Any, target: Any) -> Any:
        if not isinstance(value, Mapping):
            raise DescriptionError(kind.__name__, value, "be a table")
        for key in value:
            if key not in known:
                raise DescriptionError(
                    f"{kind.__name__}.{key}",
                    value[key],
                    "be a known key",
                    hint=nearest(key, known),
                )
        return inner(value, target)

    return hook


def _liquid(value: Any, _: Any) -> Liquid:
    if isinstance(value, str):
        return load_liquid(value)
    made: Liquid = _LIQUID(value, Liquid)
    return made


_CONVERTER = cattrs.Converter()
_CONVERTER.register_structure_hook_factory(attrs.has, _attrs_class)
_LIQUID = _attrs_class(Liquid)
_CONVERTER.register_structure_hook_func(lambda kind: kind is Liquid, _liquid)
_CONVERTER.register_structure_hook_func(lambda kind: kind == Flat | Sphere, _tagged(*_TAGS[0]))
_CONVERTER.register_structure_hook_func(lambda kind: kind is SeparationEffect, _tagged(*_TAGS[1]))
_law = _tagged(*_TAGS[2])


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
    try:
        return _CONVERTER.structure(tables, kind)
    except DescriptionError as error:
        raise DescriptionError(origin, kind.__name__, f"describe a scene; {error}") from None
    except cattrs.ClassValidationError as error:
        found = cattrs.transform_error(error, format_exception=_say)
        reasons = "\n  ".join(
            reason.replace(" @ $", "  at ", 1).replace("at .", "at ") for reason in found
        )
        raise _not_a_scene(origin, reasons) from None


class _FileError(DescriptionError):
    """A file with mistakes: the message is the list of them."""

    def __init__(self, origin: str, reasons: str) -> None:
        super().__init__(origin, "", "be right")
        self.args = (f"{origin} cannot be used:\n  {reasons}",)


def _not_a_scene(origin: str, reasons: str) -> DescriptionError:
    return _FileError(origin, reasons)


def _say(error: BaseException, _: type | None) -> str:
    if isinstance(error, KeyError):
        return f"missing key {error.args[0]!r}"
    return str(error)


def read_tables(path: str | Path) -> dict[str, Any]:
    """Read a TOML file.

    Raises
    ------
    DescriptionError
        If the file does not exist or is not TOML.
    """
    path = Path(path)
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise DescriptionError("file", str(path), "exist") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise _FileError(path.name, f"not TOML: {error}") from None
    except OSError as error:
        raise DescriptionError("file", str(path), "be readable", hint=str(error)) from None


def load_scene(path: str | Path) -> SeparationScene:
    """Read a scene from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file; its tables are the fields of `SeparationScene`, quantities may carry a unit.

    Raises
    ------
    DescriptionError
        Listing every mistake in the file and where it is.
    """
    return structure(read_tables(path), SeparationScene, Path(path).name)


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
    text = resources.files(f"{__package__}.models").joinpath("liquids.toml").read_text("utf-8")
    tables = tomllib.loads(text)
    if name not in tables:
        raise DescriptionError(
            "liquid", name, "be a liquid of the library", hint=nearest(name, sorted(tables))
        )
    return structure(tables[name], Liquid, f"liquids.toml, {name}")


def unstructure(value: Any) -> Any:
    """Turn attrs objects into tables of plain values; what is at its default is left out."""
    if attrs.has(type(value)):
        table: dict[str, Any] = {}
        for tag, kinds in _TAGS:
            names = [name for name, kind in kinds.items() if type(value) is kind]
            table |= dict.fromkeys([tag], names[0]) if names else {}
        for a in attrs.fields(type(value)):
            item = getattr(value, a.name)
            if a.init and item is not None and item != a.default:
                table[a.alias] = unstructure(item)
        return table
    if isinstance(value, tuple | list):
        return [unstructure(item) for item in value]
    return value


def save_scene(scene: SeparationScene, path: str | Path) -> Path:
    """Write a scene to a TOML file, in SI units; `load_scene` gives the same scene back."""
    import tomli_w

    text = tomli_w.dumps(unstructure(scene))
    with write_whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return Path(path)


@contextmanager
def write_whole(path: str | Path) -> Iterator[Path]:
    """Give a temporary path beside `path` and move it there at the end: never half a file."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    # Not tempfile: its files are private, and these are to be as readable as any other.
    temporary = path.with_name(f".{path.stem}-{uuid.uuid4().hex[:8]}{path.suffix}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
