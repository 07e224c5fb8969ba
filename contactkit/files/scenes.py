"""Scene files: TOML, read whole or refused with every reason."""

from __future__ import annotations

import os
import tomllib
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..errors import DescriptionError
from ..scene.contact_scene import ContactScene
from ..scene.scenes import SeparationScene, SlidingScene
from .structure import FileError, load_liquid, load_material, nearest, structure, unstructure
from .zz_humid_tables import without_humidity

__all__ = [
    "load_liquid", "load_material", "load_scene", "nearest", "read_tables", "save_scene",
    "scene_kind", "structure", "unstructure", "write_whole",
]  # fmt: skip


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
