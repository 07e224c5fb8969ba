"""Contact of a height map given as an array: `press`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, get_args

import numpy as np
from attrs import evolve

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..roughness.height_maps import Trend, detrended, tilt_of
from ..scene.interface import Body, Interface
from ..scene.loading import Pressing
from ..scene.materials import Material, Solid, Stack
from ..scene.rough_surfaces import Heights
from ..scene.scenes import ContactScene
from ..scene.topography import Topography, as_surface, is_topography
from ..scene.window import Edges, Window
from ..units import parse_quantity
from ..validity import warn
from .effects.base import ContactEffect
from .effects.elasticity import HalfSpace, LayeredHalfSpace
from .effects.hardness_rules import ConstantHardness, HardnessMap
from .effects.plasticity import HardnessLimit
from .plan import plan_contact
from .result import ContactResult
from .solve import solve_unwarned

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["number_of", "pixel_size_of", "press"]


def press(
    heights: ArrayLike | Topography,
    pixel_size: float | str | tuple[float | str, float | str] | None,
    stack: Stack | Material,
    mean_pressure: float | str,
    hardness: float | str | NDArray[np.float64] | None = None,
    periodic: Edges | None = None,
    rtol: float = 1e-8,
    threads: int = 1,
    detrend: Trend = "none",
) -> ContactResult:
    """Press a rigid rough body on a flat solid.

    A number may be a text with its unit: ``"100 MPa"``.

    The heights are taken as given unless `detrend` says what to take off; the message of the result
    states the tilt they have.

    Parameters
    ----------
    heights : array_like (ny, nx), or topography
        Heights [m] of the rough body that faces the flat, peaks up; or a topography object of
        SurfaceTopography, which has a unit, a size and a flag of periodicity. Masked pixels are
        holes: they carry no load, and `gap` means nothing there.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx). None with a topography.
    stack : Material, Stack or another Solid
        Solid of the flat: layers on a substrate, or a half-space.
    mean_pressure : float
        Mean pressure over the map [Pa].
    hardness : float or array (ny, nx), optional
        Upper bound of the pressure [Pa]; None: elastic.
    periodic : bool, "x" or "y", optional
        Whether the map repeats beyond its edges, or along which axis alone; if not, an isolated
        contact. None: it repeats, unless a topography states that it does not.
    rtol : float
        Largest violation of the contact conditions over the rms height [-].
    threads : int
        Threads of the transforms.
    detrend : {"none", "mean", "tilt", "curvature"}
        What is taken off the heights by least squares over the pixels that are no holes.

    Returns
    -------
    ContactResult
        With ``pressure``, ``gap``, ``displacement``, ``holes`` (ny, nx), ``contact_area``,
        ``status``, ``work`` and, with a hardness, ``plastic_area``.

    Raises
    ------
    DescriptionError
        If the map has one row, a height is not finite, or a number is impossible.
    InfeasibleError
        If the hardness cannot carry the load.

    Warns
    -----
    ValidityWarning
        For each number of `ContactResult.validity` that is out of its range.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    >>> heights = 1e-8 * np.cos(x)[None, :] * np.ones((64, 1))
    >>> steel = Material(young_modulus=210e9, poisson_ratio=0.3)
    >>> result = press(heights, 1e-6 / 64, steel, 1e9)
    >>> result.status, round(result.contact_fraction, 2)
    ('converged', 0.23)
    """
    if not isinstance(stack, Solid):
        raise DescriptionError(
            "press(stack)",
            stack,
            "be a Stack or a Material: the solid of the flat",
            hint=f"one of the library is ck.load_material({stack!r})"
            if isinstance(stack, str)
            else "",
        )
    flat = Body(solid=stack)
    layered = flat.stack is not None and bool(flat.stack.layers)
    effects: list[ContactEffect[Any]] = [LayeredHalfSpace() if layered else HalfSpace()]
    if hardness is not None:
        is_map = np.ndim(hardness) > 0
        given = HardnessMap(hardness) if is_map else number_of(hardness, "Pa", "hardness")
        effects.append(HardnessLimit(rule=ConstantHardness(hardness=given)))
    surface = _level(_surface(heights, pixel_size), detrend)
    scene = ContactScene(
        interface=Interface(lower=Body(solid=stack), upper=Body(surface=surface)),
        window=Window(periodic=periodic),
        loading=Pressing(pressure=number_of(mean_pressure, "Pa", "mean_pressure")),
        effects=tuple(effects),
    )
    result = solve_unwarned(plan_contact(scene, Accuracy(rtol=rtol, threads=threads)))
    warn(result.validity)
    said = f"{_holes(surface)}; {_tilt(surface, detrend)}"
    return evolve(result, message=f"{result.message}{said}")


def number_of(given: Any, unit: str, name: str, of: str = "press") -> float:
    """Take numbers of numpy as well as Python's, and texts with a unit.

    Examples
    --------
    >>> number_of("2 um", "m", "pixel_size")
    2e-06
    """
    value = given if isinstance(given, str) else float(given)
    return parse_quantity(value, unit, f"{of}({name})")


def pixel_size_of(given: Any, of: str = "press") -> float | tuple[float, float]:
    """Size of a pixel [m], or of (dy, dx).

    Examples
    --------
    >>> pixel_size_of(("1 um", 2e-6))
    (1e-06, 2e-06)
    """
    if np.ndim(given) > 1:
        raise DescriptionError(
            f"{of}(pixel_size)",
            f"an array of shape {np.shape(given)}",
            "be one length, or a pair (dy, dx)",
            unit="m",
            hint="the order is heights, pixel_size, stack",
        )
    if np.ndim(given) == 0:
        return number_of(given, "m", "pixel_size", of)
    return tuple(number_of(one, "m", "pixel_size", of) for one in given)  # type: ignore[return-value]


def _surface(heights: Any, pixel_size: Any) -> Heights:
    if not is_topography(heights):
        size: Any = None  # refused there
        if pixel_size is not None:
            size = pixel_size_of(pixel_size)
        return Heights(heights=heights, pixel_size=size)
    if pixel_size is not None:
        raise DescriptionError(
            "press(pixel_size)", pixel_size, "be None: the topography has its size", unit="m"
        )
    made: Heights = as_surface(heights)
    return made


def _level(surface: Heights, trend: Trend) -> Heights:
    """Take a trend off heights; what holes are filled with is no part of it."""
    if trend not in get_args(Trend):
        names = ", ".join(map(repr, get_args(Trend)))
        raise DescriptionError("press(detrend)", trend, f"be one of {names}")
    if trend == "none":
        return surface
    holes = surface.holes
    known = surface.heights if holes is None else np.where(holes, np.nan, surface.heights)
    return evolve(surface, heights=np.ma.masked_invalid(detrended(known, trend)))


def _holes(surface: Heights) -> str:
    if surface.holes is None:
        return ""
    return f"; {int(surface.holes.sum())} masked pixels carry no load, their gap is not known"


def _tilt(surface: Heights, trend: Trend) -> str:
    """State the tilt that is left in a map: the rise of the plane that fits it best."""
    if trend in ("tilt", "curvature"):
        return f"heights less their {trend}"
    rise, rms = tilt_of(surface.heights)
    over = f", {rise / rms:.2g} of the rms height" if rms > 1e-9 * rise else ""
    return f"heights as given: no tilt removed, theirs rises by {rise:.2g} m over the window{over}"
