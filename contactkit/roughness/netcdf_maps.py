"""Height maps in netCDF 3, as SurfaceTopography and contact.engineering write and read them.

Heights are indexed [x, y] and have, as the coordinates, a unit of length; sizes and the flag of
periodicity are attributes of the coordinates. Points that were not measured have a mask of their
own. Metadata are a text of JSON. scipy reads and writes the format, so that no extra is needed.
"""

from __future__ import annotations

import io
import json
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactkitError, DescriptionError
from ..reading.archives import UNREADABLE
from ..reading.limits import check_limit
from ..reading.texts import from_json
from ..units import parse_unit
from .height_maps import HeightMap
from .map_fields import LineScanError

__all__ = ["netcdf_of", "read_netcdf"]

Pair = tuple[float, float]

_OWN = "contactkit"  # key of what the format has no place for, to the last bit


def netcdf_of(height_map: HeightMap) -> bytes:
    """Return a height map as the content of a netCDF file, in metres.

    Parameters
    ----------
    height_map : HeightMap
        Heights (ny, nx) [m], nan where there are none, and pixel size (dy, dx) [m].
    """
    from scipy.io import netcdf_file

    heights = np.asarray(height_map.heights, dtype=np.float64).T
    missing = ~np.isfinite(heights)
    (nx, ny), (dy, dx) = heights.shape, height_map.pixel_size
    own = {"pixel_size": [dy, dx], "is_periodic": height_map.is_periodic}
    content = io.BytesIO()
    file: Any = netcdf_file(content, "w", version=2)
    with file:
        file.json = json.dumps({"name": height_map.source, _OWN: own})
        for name, n, pixel in (("x", nx, dx), ("y", ny, dy)):
            file.createDimension(name, n)
            axis = file.createVariable(name, "f8", (name,))
            # As a number of numpy: of Python's floats scipy writes half the digits.
            axis.length, axis.unit = np.float64(n * pixel), "m"
            axis.periodic = int(bool(height_map.is_periodic))
            axis[:] = np.arange(n) * pixel
        values = file.createVariable("heights", "f8", ("x", "y"))
        values.unit = "m"
        values[:] = np.where(missing, 0.0, heights)
        if missing.any():
            file.createVariable("mask", "b", ("x", "y"))[:] = missing
        file.flush()
        return content.getvalue()


def read_netcdf(content: bytes, where: str) -> HeightMap:
    """Read a height map from the content of a netCDF file, in metres; nan where nothing is known.

    Raises
    ------
    DescriptionError
        If it is no netCDF 3 file, or no map of heights with sizes and a unit of length.
    LineScanError
        If it is a profile along a line.
    """
    from scipy.io import netcdf_file

    try:
        with netcdf_file(io.BytesIO(content), "r", mmap=False) as file:
            variables = {name: _read(one) for name, one in file.variables.items()}
            attributes = getattr(file, "json", b"{}")
    except ContactkitError:
        raise
    except (*UNREADABLE, AssertionError) as error:
        hint = f"{type(error).__name__}: {error}"[:200]
        raise DescriptionError("file", where, "be netCDF 3 with a map", hint=hint) from None
    raw, given = variables.get("heights", (np.zeros(0), {}))
    if raw.ndim == 1 and raw.size:
        raise LineScanError("file", where, "hold a map", hint="it is a profile along a line")
    x, y = (variables.get(name, (None, {}))[1] for name in "xy")
    if raw.ndim != 2 or raw.dtype.kind not in "fi" or not {"length"} <= set(x) & set(y):
        raise DescriptionError("file", where, "hold heights over x and y with their lengths")
    check_limit("PIXELS", raw.size, where)
    factor = _metres(given.get("unit", x.get("unit")), where)
    heights = (factor * np.asarray(raw, dtype=np.float64)).T
    if "mask" in variables:
        heights = _masked(heights, variables["mask"][0].T, where)
    size = (_size(y, heights.shape[0], factor, where), _size(x, heights.shape[1], factor, where))
    info = from_json(attributes, where)
    name = info.get("name", where) if isinstance(info, dict) else where
    flag = bool(np.all(x.get("periodic", 0) != 0))
    return _exact(HeightMap(heights, size, str(name), "", flag), info)


def _read(variable: Any) -> tuple[NDArray[Any], dict[str, Any]]:
    """Numbers and attributes of a variable."""
    names = ("unit", "length", "periodic")
    return np.array(variable[...]), {
        name: getattr(variable, name) for name in names if hasattr(variable, name)
    }


def _metres(unit: Any, where: str) -> float:
    """Length of a unit [m]; the format has texts in ASCII, "um" for the micrometre."""
    if isinstance(unit, bytes):
        found = parse_unit(unit.decode("utf-8", "replace"))
        if dict(found.dimension) == {"m": 1}:
            return found.factor
    raise DescriptionError(f"{where}, unit", unit, "be a unit of length")


def _masked(heights: NDArray[np.float64], mask: NDArray[Any], where: str) -> NDArray[np.float64]:
    if mask.shape != heights.shape:
        raise DescriptionError(where, f"a mask of shape {mask.shape}", "fit its heights")
    return np.where(mask != 0, math.nan, heights)


def _size(axis: dict[str, Any], n: int, factor: float, where: str) -> float:
    """Size of a pixel along an axis [m]."""
    length = np.asarray(axis["length"], dtype=np.float64)
    if length.size != 1 or not (np.isfinite(length).all() and (length > 0.0).all()):
        raise DescriptionError(f"{where}, length", axis["length"], "be positive and finite")
    return factor * float(length.ravel()[0]) / n


def _exact(found: HeightMap, info: Any) -> HeightMap:
    """Pixel size to the last bit and the flag, where contactkit wrote the file."""
    own = info.get(_OWN) if isinstance(info, dict) else None
    if not isinstance(own, dict):
        return found
    pixel: Any = own.get("pixel_size")
    flag = own.get("is_periodic")
    same = (
        isinstance(pixel, list)
        and len(pixel) == 2
        and all(isinstance(one, float) for one in pixel)
        and np.allclose(pixel, found.pixel_size, rtol=1e-12, atol=0.0)
    )
    size = (pixel[0], pixel[1]) if same else found.pixel_size
    is_periodic = None if flag is None and not found.is_periodic else found.is_periodic
    return found._replace(pixel_size=size, is_periodic=is_periodic)
