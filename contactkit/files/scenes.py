"""Scene files: TOML, read whole or refused with every reason."""

from __future__ import annotations

import os
import tomllib
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import attrs

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..scene.contact_scene import ContactScene
from ..scene.meniscus import Meniscus
from ..scene.scenes import SeparationScene, SlidingScene
from ..units import parse_quantity
from .structure import (
    FileError,
    field_value,
    load_liquid,
    load_material,
    nearest,
    structure,
    unstructure,
)

__all__ = [
    "load_liquid",
    "load_material",
    "load_scene",
    "nearest",
    "ContactFile",
    "read_contact",
    "read_tables",
    "save_scene",
    "scene_kind",
    "structure",
    "unstructure",
    "without_humidity",
    "write_whole",
]

_KEY = "relative_humidity"


def without_humidity(tables: Mapping[str, Any], origin: str) -> Mapping[str, Any]:
    """Tables in which ``interface.meniscus.relative_humidity`` has become its ``pressure``.

    Kelvin's equation is taken at the ``temperature`` of the scene; see `Meniscus.from_humidity`.
    What has no such key comes back as it is.

    Parameters
    ----------
    tables : mapping
        As read from a scene file.
    origin : str
        Where they come from, for messages.

    Raises
    ------
    DescriptionError
        If a pressure or a volume stands beside the humidity, or it is not a share.
    InfeasibleError
        At no vapour, where nothing condenses, and at saturation, where all is flooded.

    Examples
    --------
    >>> water = {"name": "water", "density": 998.2, "molar_mass": 0.018015}
    >>> tables = {"interface": {"meniscus": {"liquid": water, "relative_humidity": "50 %"}}}
    >>> f"{without_humidity(tables, 'moist.toml')['interface']['meniscus']['pressure']:.4g}"
    '-9.361e+07'
    """
    interface = tables.get("interface")
    meniscus = interface.get("meniscus") if isinstance(interface, Mapping) else None
    if not isinstance(interface, Mapping) or not isinstance(meniscus, Mapping):
        return tables
    if _KEY not in meniscus:
        return tables
    where = f"  at interface.meniscus.{_KEY}"
    for other in ("volume", "pressure"):
        if other in meniscus:
            raise FileError(origin, f"give {_KEY} or {other}, not both{where}")
    if "liquid" not in meniscus:
        return tables  # what is missing is said with everything else
    temperature = attrs.fields(SeparationScene).temperature.default
    assert temperature is not None  # the room
    if "temperature" in tables:
        temperature = float(field_value(SeparationScene, "temperature", tables["temperature"]))
    share = parse_quantity(meniscus[_KEY], "-", f"{origin}: interface.meniscus.{_KEY}")
    condensed = Meniscus.from_humidity(
        liquid=field_value(Meniscus, "liquid", meniscus["liquid"]),
        relative_humidity=share,
        temperature=temperature,
    )
    left = {key: value for key, value in meniscus.items() if key != _KEY}
    return {
        **tables,
        "interface": {**interface, "meniscus": {**left, "pressure": condensed.pressure}},
    }


class ContactFile(NamedTuple):
    """What a file of a contact scene holds: the scene, its accuracy, and what a study varies."""

    scene: ContactScene
    accuracy: Accuracy
    vary: Mapping[str, list[Any]]


def read_contact(tables: Mapping[str, Any], origin: str) -> ContactFile:
    """Read a contact scene with its tables ``accuracy`` and ``study``, if it has them.

    Raises
    ------
    DescriptionError
        Listing every mistake and where it is.
    """
    rest = dict(tables)
    accuracy = structure(rest.pop("accuracy", {}), Accuracy, f"{origin}, accuracy")
    study = rest.pop("study", {})
    if not isinstance(study, Mapping) or not all(isinstance(v, list) for v in study.values()):
        raise DescriptionError(
            f"{origin}, study", study, "be a table of lists", hint='"pressing.pressure" = [...]'
        )
    return ContactFile(structure(rest, ContactScene, origin), accuracy, study)


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
        raise FileError(path.name, f"not TOML: {error}") from None
    except OSError as error:
        raise DescriptionError("file", str(path), "be readable", hint=str(error)) from None


def scene_kind(
    tables: Mapping[str, Any],
) -> type[SeparationScene] | type[SlidingScene] | type[ContactScene]:
    """Kind of scene that tables describe: what is pressed, or has a window, is a contact."""
    if "sliding" in tables and "opening" not in tables:
        return SlidingScene
    is_pressed = "pressing" in tables or ("window" in tables and "opening" not in tables)
    return ContactScene if is_pressed else SeparationScene


def load_scene(path: str | Path) -> SeparationScene | SlidingScene | ContactScene:
    """Read a scene from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file; its tables are the fields of `ContactScene` if there is one called
        ``pressing``, of `SlidingScene` if there is one called ``sliding``, else of
        `SeparationScene`. Quantities may carry a unit. In place of its volume or pressure a
        meniscus may have a ``relative_humidity``, taken at the temperature of the scene.

    Raises
    ------
    DescriptionError
        Listing every mistake in the file and where it is.
    """
    tables = read_tables(path)
    name = Path(path).name
    return structure(without_humidity(tables, name), scene_kind(tables), name)


def save_scene(scene: SeparationScene | SlidingScene | ContactScene, path: str | Path) -> Path:
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
