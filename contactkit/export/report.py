"""Report of a run of the command line, and the FMU that holds a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["FmuStart", "Report"]


class Report(NamedTuple):
    """Report of a run: numbers with their units, and text to read.

    `write` writes the files of numbers, then `draw` the pictures; each returns its files. They are
    called after the numbers have been printed, which a full disk then does not take away. None
    without a folder to write to.
    """

    scalars: Mapping[str, tuple[Any, str]]
    text: str
    write: Callable[[], Sequence[Path]] | None = None
    draw: Callable[[], Sequence[Path]] | None = None


class FmuStart(NamedTuple):
    """Name of the FMU that holds a scene, and the start values to bake in.

    `film` is the scene of the film of a device, which a native FMU takes as it is.
    """

    name: str
    values: Mapping[str, Any]
    film: Any = None
