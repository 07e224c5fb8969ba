"""Height maps in formats of instruments, read by SurfaceTopography in a process of its own.

Some of its formats are read by compiled code that ends its process on a damaged file, as that of
MATLAB files does (scipy), or takes any time or memory. A process of its own has limits of both, and
what ends it is an error here.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import DescriptionError
from ..reading.archives import checked_archive
from ..reading.arrays import read_map
from ..reading.limits import check_size, limit_of
from ..reading.texts import from_json, read_text

__all__ = [
    "ANSWER",
    "HEIGHTS",
    "MATRICES",
    "Channel",
    "read_instrument",
    "unreadable",
]

Pair = tuple[float, float]

MATRICES = (".csv", ".txt", ".dat", ".tsv", ".asc")
"""Endings of files of text that need no extra."""

ANSWER, HEIGHTS = "answer.json", "heights.npy"
"""Files in which the process answers."""

_REQUEST = "request.json"
_CODE = f"""
import json, sys
with open(sys.argv[1] + "/{_REQUEST}", encoding="utf-8") as file:
    request = json.load(file)
sys.path[:] = request.pop("path")
from {__package__}.instrument_channels import answer
answer(sys.argv[1], **request)
"""


class Channel(NamedTuple):
    """Heights [m], pixel size [m], source and periodicity of a channel of an instrument file."""

    heights: NDArray[np.float64]
    pixel_size: Pair
    source: str
    is_periodic: bool | None


def read_instrument(
    file: Path,
    size: Pair | None,
    unit: str | None,
    channel: int | None,
    place: tuple[int, int] | None = None,
) -> Channel:
    """Read a channel of a file of an instrument, with what the file does not state.

    Parameters
    ----------
    file : Path
        The file.
    size : (float, float) or None
        Size of a pixel (dy, dx) [m].
    unit : str or None
        Unit of the heights.
    channel : int or None
        Index of the map in a file with several.
    place : (int, int), optional
        Of a container: indices of the surface and of its topography.

    Raises
    ------
    DescriptionError
        If SurfaceTopography is not installed, or cannot read the file within the limits.
    """
    with file.open("rb") as content:
        if zipfile.is_zipfile(content):
            with checked_archive(content, str(file)) as packed:  # it unpacks to what may be read
                names = packed.namelist()
            if place is None and not {"index.json", "meta.yml"}.isdisjoint(names):
                cure = f"it is a container: ck.read_surfaces({file.name!r}) has its maps"
                raise DescriptionError("HeightMap.path", str(file), "be one map", hint=cure)
    if importlib.util.find_spec("SurfaceTopography") is None:
        raise DescriptionError(
            "HeightMap.path",
            str(file),
            f"end in .npy, .xyz, {', '.join(MATRICES)}, or be .sdf as text",
            hint="files of instruments and binary .sdf need pip install contactkit[maps]",
        )
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        _ask(Path(folder), file, {"size": size, "unit": unit, "channel": channel, "place": place})
        return _answered(Path(folder), file)


def _ask(folder: Path, file: Path, given: dict[str, Any]) -> None:
    """Let a process read the file and write its answer into a folder."""
    path = [one or os.getcwd() for one in sys.path]
    request = {"path": path, "file": str(file.absolute()), **given}
    (folder / _REQUEST).write_text(json.dumps(request), encoding="utf-8")
    seconds = limit_of("SECONDS")
    try:
        done = subprocess.run(
            [sys.executable, "-I", "-c", _CODE, str(folder)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise DescriptionError(
            "HeightMap.path",
            str(file),
            f"be read within {seconds} s",
            hint=f"if it is meant, set CONTACTKIT_MAX_SECONDS={10 * seconds}",
        ) from None
    if done.returncode:
        why = done.stderr.decode(errors="replace").strip().rpartition("\n")[2][:200]
        raise unreadable(file, f"its reader ended with status {done.returncode} {why}".strip())


def _answered(folder: Path, file: Path) -> Channel:
    found = from_json(read_text(folder / ANSWER, "TEXT_BYTES"), file.name)
    if "refused" in found:
        raise DescriptionError(**found["refused"])
    if "unreadable" in found:
        raise unreadable(file, found["unreadable"])
    with (folder / HEIGHTS).open("rb") as content:
        heights = read_map(content, check_size(folder / HEIGHTS), file.name)
    dy, dx = found["pixel_size"]
    return Channel(heights, (dy, dx), found["source"], found["is_periodic"])


def unreadable(file: Path, why: str) -> DescriptionError:
    """Refusal of a file that SurfaceTopography does not read, and the cure."""
    cure = "export it as text or npy from the instrument's software"
    return DescriptionError(
        "HeightMap.path",
        str(file),
        "be in a format that SurfaceTopography reads",
        hint=f"{cure} ({' '.join(why.split())})",
    )
