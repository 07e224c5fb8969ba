"""Surfaces and maps of results as topographies: containers, and objects of SurfaceTopography."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..contact.result import ContactResult
from ..errors import DescriptionError, nearest
from ..extras import require
from ..reading.limits import check_size
from ..reading.named_files import existing
from ..roughness.containers import LineScans, read_container, write_container
from ..roughness.height_maps import HeightMap
from ..roughness.map_fields import length_unit
from ..scene.rough_surfaces import Heights, Measured
from ..scene.topography import Topography, as_surface
from .scenes import write_whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["read_surfaces", "surface_from", "to_topography", "write_surfaces"]

_MAPS = ("heights", "displacement", "gap", "deformed")


def read_surfaces(
    path: str | PathLike[str], *, line_scans: LineScans = "refused"
) -> dict[str, Heights]:
    """Read the maps of a container of SurfaceTopography or contact.engineering.

    Each is a surface of a scene; a study over them is one over measurements:
    ``ck.study(scene, {"interface.upper.surface": list(read_surfaces("scans.zip").values())})``.

    Parameters
    ----------
    path : path
        A ZIP file with ``index.json`` or ``meta.yml``. Maps in the form that both programs call
        squeezed need no extra, raw data of instruments ``contactkit[maps]``.
    line_scans : {"refused", "left out"}
        Whether a profile along a line, which is no surface, is a mistake.

    Returns
    -------
    dict of str to Heights
        Surfaces by the names of the topographies, after that of their surface if there are several.
        Heights [m]; points that were not measured are holes; no trend is taken off.

    Raises
    ------
    DescriptionError
        If it is no container, or a topography is no map, is too large, or has no unit.
    MissingExtraError
        If what a topography needs is not installed.

    Examples
    --------
    >>> import tempfile
    >>> waves = Heights(heights=[[0.0, 1e-9], [1e-9, 0.0]], pixel_size=1e-8, is_periodic=True)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = write_surfaces(Path(folder) / "waves.zip", {"fine": waves})
    ...     again = read_surfaces(file)
    >>> list(again), again["fine"].pixel_size, again["fine"].is_periodic
    (['fine'], (1e-08, 1e-08), True)
    """
    if line_scans not in ("refused", "left out"):
        raise DescriptionError("line_scans", line_scans, "be 'refused' or 'left out'")
    file = existing(path, "container")
    check_size(file)
    if not zipfile.is_zipfile(file):
        cure = "a file of one map is a surface: ck.Measured(path=...)"
        raise DescriptionError("container", str(path), "be a ZIP file of topographies", hint=cure)
    found = read_container(file, line_scans)
    several = len(found) > 1
    return {
        f"{surface}, {name}" if several else name: _surface(one)
        for surface, maps in found.items()
        for name, one in maps.items()
    }


def write_surfaces(
    path: str | PathLike[str], surfaces: Mapping[str, Any], *, name: str = ""
) -> Path:
    """Write surfaces to a container that SurfaceTopography and contact.engineering read.

    Heights are in metres, to the last bit; holes, sizes and the flag of periodicity go with them. A
    surface of which it is not known whether it repeats is written as one that does not. The file
    appears when it is whole, and needs no extra.

    Parameters
    ----------
    path : path
        The ZIP file to write.
    surfaces : mapping of str to Heights, Measured, SurfaceHeights or topography
        By the names they shall have. Maps of a result are made surfaces by `surface_from`, random
        roughness by `contactkit.analyses.heights.surface_heights`.
    name : str
        Name of the surface that they are topographies of; default: that of the file.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If there is none, or one has no heights of its own.
    """
    target = Path(path)
    if target.suffix.lower() != ".zip":
        raise DescriptionError("path", str(path), "end in .zip")
    if not isinstance(surfaces, Mapping) or not surfaces:
        raise DescriptionError("surfaces", surfaces, "be surfaces by their names, one at least")
    maps = {str(key): _height_map(key, one) for key, one in surfaces.items()}
    with write_whole(target) as temporary:
        write_container(temporary, {name or target.stem: maps})
    return target


def surface_from(result: ContactResult, of: str = "deformed") -> Heights:
    r"""Return a map of a solved contact as a surface.

    Parameters
    ----------
    result : ContactResult
        The contact.
    of : {"deformed", "heights", "displacement", "gap"}
        Heights of both bodies together as deformed, :math:`h - u`, or as they are; displacement
        :math:`u`, gap [m]. A pressure is no height: ``result.to_xarray()`` has it with its unit.

    Raises
    ------
    DescriptionError
        If it is no such map.

    Examples
    --------
    >>> import contactkit as ck
    >>> wave = ck.Wave(amplitude=1e-9, wavelength=1e-6)
    >>> solid = ck.Material(name="solid", young_modulus=1e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(lower=ck.Body(solid=solid), upper=wave),
    ...     window=ck.Window(width=1e-6),
    ...     loading=ck.Pressing(pressure=1e6),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> pressed = ck.solve(ck.plan(scene, ck.Accuracy(grid=32)))
    >>> level = (surface_from(pressed).heights + pressed.gap).ravel()
    >>> bool(abs(level - level[0]).max() < 1e-15)
    True
    """
    if not isinstance(result, ContactResult):
        raise DescriptionError("result", result, "be the result of a contact")
    if of not in _MAPS:
        hint = nearest(of, _MAPS)
        if of == "pressure":
            hint = "a pressure is no height; result.to_xarray().to_netcdf(path) has its unit"
        raise DescriptionError("of", of, f"be one of {', '.join(_MAPS)}", hint=hint)
    heights = result.heights - result.displacement if of == "deformed" else getattr(result, of)
    grid = result.plan.grid
    if result.holes is not None:
        heights = np.ma.MaskedArray(heights, result.holes)
    return Heights(heights=heights, pixel_size=grid.pixel_size, is_periodic=grid.periodic)


def to_topography(
    surface: Any, *, unit: str = "m", info: Mapping[str, Any] | None = None
) -> Topography:
    """Return a surface as a topography of SurfaceTopography (extra ``maps``).

    Parameters
    ----------
    surface : Heights, Measured, SurfaceHeights or topography
        As of `write_surfaces`.
    unit : str
        Unit of lengths and heights there; those in metres are exact.
    info : mapping, optional
        Metadata of the topography, such as a name.

    Returns
    -------
    SurfaceTopography.Topography
        Heights [x, y], masked in holes, with sizes, unit and flag of periodicity.

    Raises
    ------
    MissingExtraError
        If SurfaceTopography is not installed.
    DescriptionError
        If the surface has no heights of its own, or the unit is no unit of length.
    """
    require("SurfaceTopography", "a topography")
    import SurfaceTopography

    one = _height_map("surface", surface)
    (ny, nx), (dy, dx) = one.heights.shape, one.pixel_size
    heights = np.ma.masked_invalid(one.heights.T)
    found: Any = SurfaceTopography.Topography(
        heights if np.ma.is_masked(heights) else heights.data.copy(),
        physical_sizes=(nx * dx, ny * dy),
        unit="m",
        periodic=bool(one.is_periodic),
        info=dict(info or {}),
    )
    length_unit(unit, Path("topography"))  # refuses what is no unit of length
    made: Topography = found if unit == "m" else found.to_unit(unit)
    return made


def _surface(one: HeightMap) -> Heights:
    return Heights(
        heights=np.ma.masked_invalid(one.heights),
        pixel_size=one.pixel_size,
        is_periodic=one.is_periodic,
    )


def _height_map(name: object, surface: Any) -> HeightMap:
    """Heights of a surface with nan in its holes."""
    found: Any = as_surface(surface)
    if isinstance(found, Measured):
        found = found.as_heights()
    if isinstance(found, Heights):
        heights: NDArray[np.float64] = found.heights
        if found.holes is not None:
            heights = np.where(found.holes, np.nan, heights)
    elif isinstance(getattr(found, "heights", None), np.ndarray) and hasattr(found, "pixel_size"):
        heights = np.ma.filled(found.heights.astype(np.float64), np.nan)
    else:
        is_array = isinstance(surface, np.ndarray | list | tuple)
        raise DescriptionError(
            f"surfaces[{name!r}]",
            f"an array of shape {np.shape(surface)}" if is_array else surface,
            "be a surface with heights of its own",
            hint="give its pixels a size: ck.Heights(heights=..., pixel_size=...)"
            if is_array
            else "make them by contactkit.analyses.heights.surface_heights(surface, window)",
        )
    size = found.pixel_size
    pair = (size[0], size[1]) if isinstance(size, tuple) else (size, size)
    return HeightMap(heights, pair, str(name), "", found.is_periodic)
