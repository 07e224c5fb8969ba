"""Containers of measured topographies: the ZIP files of SurfaceTopography, contact.engineering.

A container holds surfaces, and of each several topographies: maps of different size and place, and
line scans. ``index.json``, or ``meta.yml`` in older ones, names them and the file of each.
"""

from __future__ import annotations

import hashlib
import json
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any, Literal, NamedTuple

import numpy as np

from .._version import __version__
from ..errors import DescriptionError
from ..extras import require
from ..reading.archives import checked_archive, member
from ..reading.texts import check_plain, from_json
from .height_maps import HeightMap, checked_heights
from .instrument_files import read_instrument
from .map_fields import LineScanError, length_unit
from .netcdf_maps import netcdf_of, read_netcdf

__all__ = ["LineScans", "container_of", "read_container", "write_container"]

LineScans = Literal["refused", "left out"]

_INDEX, _OLDER, _README = "index.json", "meta.yml", "README.txt"
_NETCDF = "squeezed-netcdf"
_EPOCH = (1980, 1, 1, 0, 0, 0)  # the same bytes each time
_Maps = dict[str, HeightMap]


class _Topography(NamedTuple):
    """A topography as the index of a container has it, and its place there."""

    name: str
    files: Mapping[str, Any]
    size: Any
    unit: Any
    place: tuple[int, int]


def container_of(surfaces: Mapping[str, Mapping[str, HeightMap]]) -> Iterator[tuple[str, bytes]]:
    """Yield the members of a container, each with its name.

    Parameters
    ----------
    surfaces : mapping
        Height maps by their names, by the name of the surface that they are of.
    """
    listed, number = [], 0
    for surface, maps in surfaces.items():
        entries = []
        for name, one in maps.items():
            file = f"topography{number}.nc"
            number += 1
            yield file, netcdf_of(one._replace(source=name))
            entries.append(_entry(name, file, one))
        listed.append({"name": surface, "topographies": entries})
    versions = {"contactkit": __version__}
    index = json.dumps({"versions": versions, "surfaces": listed}, indent=1, ensure_ascii=True)
    yield _INDEX, index.encode()
    yield _OLDER, index.encode()  # JSON is YAML
    text = f"{number} topographies of {len(listed)} surfaces in metres, by contactkit.\n"
    yield _README, text.encode()


def _entry(name: str, file: str, one: HeightMap) -> dict[str, Any]:
    """Entry of a height map in the index."""
    (ny, nx), (dy, dx) = one.heights.shape, one.pixel_size
    return {
        "name": name,
        "datafile": {_NETCDF: file},
        "size": [nx * dx, ny * dy],
        "unit": "m",
        "is_periodic": bool(one.is_periodic),
    }


def write_container(path: Path, surfaces: Mapping[str, Mapping[str, HeightMap]]) -> None:
    """Write a container to a file."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in container_of(surfaces):
            packed.writestr(zipfile.ZipInfo(name, _EPOCH), content, zipfile.ZIP_DEFLATED)


def read_container(file: Path, line_scans: LineScans = "refused") -> dict[str, _Maps]:
    """Read all maps of a container, by the name of their surface and their own.

    A topography without its processed form in netCDF is read by SurfaceTopography (extra ``maps``)
    with the scale and the trend that the container states.

    Raises
    ------
    DescriptionError
        If it is no container, holds a line scan that is not to be left out, or a map is no map.
    """
    with file.open("rb") as content, checked_archive(content, file.name) as packed:
        found: dict[str, _Maps] = {}
        for surface, topographies in _index(packed, file.name):
            maps = found.setdefault(_unused(surface, found), {})
            for one in topographies:
                try:
                    read = _map(packed, one, file)
                except LineScanError:
                    if line_scans == "refused":
                        raise
                    continue
                maps[_unused(one.name, maps)] = read._replace(source=one.name)
    if not any(found.values()):
        raise DescriptionError("container", file.name, "hold a map of heights")
    return found


def _line_scan(one: _Topography, file: Path) -> LineScanError:
    return LineScanError(
        f"topography {one.name!r} of {file.name}",
        "a line scan",
        "be a map",
        hint="a profile along a line is not a surface; leave it out by line_scans='left out'",
    )


def _map(packed: zipfile.ZipFile, one: _Topography, file: Path) -> HeightMap:
    """A map of a container [m], with its checksum."""
    if isinstance(one.size, list) and len(one.size) == 1:
        raise _line_scan(one, file)
    netcdf = one.files.get(_NETCDF)
    if isinstance(netcdf, str):
        content = member(packed, netcdf, "BYTES", file.name)
        try:
            found = read_netcdf(content, f"{file.name}, {netcdf}")
        except LineScanError:
            raise _line_scan(one, file) from None
        found, digest = _sized(found, one), hashlib.sha256(content).hexdigest()
    else:
        require("SurfaceTopography", f"{one.name!r} of {file.name}, which is in a raw format,")
        heights, size, name, flag = read_instrument(file, None, None, None, one.place)
        found, digest = HeightMap(heights, size, name, "", flag), ""
    heights = checked_heights(found.heights, Path(one.name), holes=True)
    return found._replace(heights=heights, checksum=digest)


def _sized(found: HeightMap, one: _Topography) -> HeightMap:
    """The map with the pixel size of the index, where that of the netCDF file is that to 7 digits.

    SurfaceTopography 1.27 writes lengths in single precision there, in full in the index.
    """
    if not (isinstance(one.size, list) and len(one.size) == 2 and isinstance(one.unit, str)):
        return found
    if not all(isinstance(length, int | float) for length in one.size):
        return found
    factor = length_unit(one.unit.replace("\N{GREEK SMALL LETTER MU}", "u"), Path(one.name))
    (ny, nx), (width, height) = found.heights.shape, one.size
    pair = (factor * height / ny, factor * width / nx)
    is_rounded = np.allclose(pair, found.pixel_size, rtol=1e-6, atol=0.0) and not np.allclose(
        pair, found.pixel_size, rtol=1e-12, atol=0.0
    )
    return found._replace(pixel_size=pair) if is_rounded else found


def _unused(name: str, taken: Mapping[str, Any]) -> str:
    """A name that is not taken: with a number where it is."""
    made, number = name, 2
    while made in taken:
        made, number = f"{name} ({number})", number + 1
    return made


# Index --------------------------------------------------------------------------------------------


def _index(packed: zipfile.ZipFile, where: str) -> list[tuple[str, list[_Topography]]]:
    names = packed.namelist()
    if _INDEX in names:
        index = from_json(member(packed, _INDEX, "TEXT_BYTES", where), f"{where}, {_INDEX}")
    elif _OLDER in names:
        index = _yaml(member(packed, _OLDER, "TEXT_BYTES", where), f"{where}, {_OLDER}")
    else:
        raise DescriptionError(
            "container", where, f"hold {_INDEX} or {_OLDER}", hint=f"it holds {names[:5]}"
        )
    surfaces = _listed(index, "surfaces", where)
    return [
        (
            _text(surface, "name", f"surface {i}"),
            [
                _topography(one, (i, j), where)
                for j, one in enumerate(_listed(surface, "topographies", where))
            ],
        )
        for i, surface in enumerate(surfaces)
    ]


def _topography(entry: Any, place: tuple[int, int], where: str) -> _Topography:
    files = entry.get("datafile") if isinstance(entry, dict) else None
    if isinstance(files, str):  # the oldest ones
        files = {"original": files}
    if not isinstance(files, dict):
        raise DescriptionError(f"{where}, topography {place[1]}", entry, "name its datafile")
    name = next((one for one in files.values() if isinstance(one, str)), "topography")
    return _Topography(
        _text(entry, "name", PurePosixPath(name).name),
        files,
        entry.get("size"),
        entry.get("unit"),
        place,
    )


def _listed(table: Any, key: str, where: str) -> list[Any]:
    found = table.get(key) if isinstance(table, dict) else None
    if not isinstance(found, list):
        raise DescriptionError(f"{where}, {key}", found, "be a list")
    return found


def _text(table: Any, key: str, other: str) -> str:
    found = table.get(key) if isinstance(table, dict) else None
    return found if isinstance(found, str) and found.strip() else other


def _yaml(content: bytes, where: str) -> Any:
    """Plain values of a text of YAML, which JSON is; without anchors, whose copies may explode."""
    try:
        return from_json(content, where)
    except DescriptionError:
        require("yaml", f"{where}, in YAML,")
    import yaml

    class Loader(yaml.SafeLoader):  # type: ignore[misc]  # which has no types
        def compose_node(self, parent: Any, index: Any) -> Any:
            if self.check_event(yaml.AliasEvent):
                raise yaml.YAMLError("it has aliases")
            return super().compose_node(parent, index)

    Loader.add_constructor("tag:yaml.org,2002:python/tuple", Loader.construct_yaml_seq)
    try:
        found = yaml.load(content, Loader=Loader)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        hint = " ".join(str(error).split())[:200]
        raise DescriptionError("file", where, "hold YAML", hint=hint) from None
    check_plain(found, where)
    return found
