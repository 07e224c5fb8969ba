"""One channel of an instrument file, read by SurfaceTopography: what the process does.

`instrument_files` starts it.
"""

from __future__ import annotations

import contextlib
import json
import math
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import DescriptionError
from ..reading.limits import check_limit, limit_of
from .instrument_files import ANSWER, HEIGHTS, Channel
from .map_fields import given_twice, length_unit, needed

__all__ = ["answer", "read_channel"]

Pair = tuple[float, float]

_UNMARKED = ("hgt", "nms")


def answer(
    folder: str,
    file: str,
    size: list[float] | None,
    unit: str | None,
    channel: int | None,
    place: list[int] | None = None,
) -> None:
    """Read a channel and write heights and fields, or the error, into a folder."""
    _bound_memory()
    pair = None if size is None else (size[0], size[1])
    said: dict[str, Any]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a reader, about properties checked below
            if place is not None:
                found = _of_container(file, *place)
            else:
                from SurfaceTopography import open_topography

                with open_topography(file) as reader:
                    found = read_channel(reader, Path(file), pair, unit, channel)
        heights = np.ma.filled(found.heights.astype(np.float64), np.nan)
        np.save(Path(folder, HEIGHTS), np.ascontiguousarray(heights))
        said = found._asdict() | {"heights": HEIGHTS}
    except DescriptionError as error:
        names = ("field", "value", "expected", "unit", "hint")
        fields = {name: getattr(error, name) for name in names}
        said = {"refused": json.loads(json.dumps(fields, default=str))}
    except Exception as error:  # noqa: BLE001 some twenty readers, which raise what they like
        said = {"unreadable": f"{type(error).__name__}: {error}"[:200]}
    Path(folder, ANSWER).write_text(json.dumps(said), encoding="utf-8")


def _of_container(file: str, surface: int, index: int) -> Channel:
    """Read a topography of a container, with the scale and the trend that it states."""
    from SurfaceTopography.Container.IO import CEReader

    found = CEReader(file).container(surface)[index]
    if found.dim != 2:
        raise DescriptionError(
            "topography", index, "be a map", hint="a profile along a line is not a surface"
        )
    check_limit("PIXELS", math.prod(found.nb_grid_pts), file)
    found = found.to_unit("m")
    dx, dy = found.pixel_size
    heights = np.ma.asarray(found.heights()).T  # there, arrays are [x, y]
    return Channel(heights, (float(dy), float(dx)), Path(file).name, bool(found.is_periodic))


def _bound_memory() -> None:
    """Bound the address space of this process, where the system can."""
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        most = 4 * limit_of("BYTES")
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def read_channel(
    reader: Any, file: Path, size: Pair | None, unit: str | None, channel: int | None
) -> Channel:
    """Read a channel of an open file, with what the file does not state.

    Raises
    ------
    DescriptionError
        If there is no such channel, it is no map of heights or too large, or a size or a unit is
        missing or given twice.
    """
    # These readers accept any file of some length, as the format has no signature.
    if reader.format() in _UNMARKED and file.suffix.lower() != f".{reader.format()}":
        raise DescriptionError(
            "HeightMap.path",
            str(file),
            "be in a format that says what it is",
            hint=f"it looks like {reader.format()!r}, but only by its length",
        )
    channels = reader.channels
    if channel is not None and not 0 <= channel < len(channels):
        names = ", ".join(f"{i}: {c.name}" for i, c in enumerate(channels))
        raise DescriptionError("HeightMap.channel", channel, f"be one of {names}")
    info = channels[channel] if channel is not None else reader.default_channel
    if info.dim != 2 or not getattr(info, "is_height_channel", True):
        raise DescriptionError(
            "HeightMap.channel",
            info.name,
            f"be a map of heights in {file.name}",
            hint="a profile along a line is not a surface; a phase or a voltage is not a height",
        )
    if info.unit is not None and unit is not None:
        raise given_twice("unit", unit, file)
    if info.physical_sizes is not None and size is not None:
        raise given_twice("pixel_size", size, file)
    check_limit("PIXELS", math.prod(info.nb_grid_pts), str(file))
    given: dict[str, Any] = {}
    factor = 1.0
    if info.unit is None:
        factor, given["unit"] = length_unit(unit, file), "m"  # numbers are converted below
    if info.physical_sizes is None:
        dy, dx = needed(size, "pixel_size", "1e-9 [m]", file)
        nx, ny = info.nb_grid_pts
        given["physical_sizes"] = (nx * dx, ny * dy)  # needed there, but not used here
    found = reader.topography(channel_index=info.index, **given).to_unit("m")
    if size is None:
        size = (factor * float(found.pixel_size[1]), factor * float(found.pixel_size[0]))
    heights = factor * np.ma.asarray(found.heights()).T  # there, arrays are [x, y]
    name = f"{file.name}, {info.name}" if len(channels) > 1 else file.name
    flag = getattr(info, "is_periodic", None)
    return Channel(heights, size, name, None if flag is None else bool(flag))
