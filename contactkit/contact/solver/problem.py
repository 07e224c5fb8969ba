"""The contact problem in its own units: checked, made dimensionless, and given back in SI.

Minimise ``p'Gp/2 - h'p`` over ``0 <= p <= cap`` with either the sum of the pressures or the rigid
approach prescribed. Lengths are divided by the rms height and pressures by the pressure that sinks
one pixel by it, so that metres and nanometres take the same steps.

Sign convention: pressure, heights and displacement positive into the solid; ``u - h - level`` is
the gap.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError, InfeasibleError
from .transfer import restrict

__all__ = [
    "Problem",
    "Solution",
    "clip_to_load",
    "coarser",
    "fit",
    "known_pressure",
    "pose",
    "project",
]

Floats = NDArray[np.float64]


class Solution(NamedTuple):
    """Answer of a contact solve, in SI units.

    Attributes
    ----------
    pressure : ndarray (ny, nx)
        [Pa]
    displacement : ndarray (ny, nx)
        Of the surface, into the solid; of zero mean if periodic [m].
    level : float
        Rigid approach of the zero plane of the heights [m]; the gap is
        ``displacement - heights - level``.
    converged : bool
        Whether `kkt` is at most the tolerance asked for.
    kkt : float
        Largest violation of a contact condition over the map, relative to `height_scale`.
    certificate : float
        Bound of the energy error, over load times `height_scale`.
    energy : float
        ``p'Gp/2 - h'p`` times the pixel area [J].
    n_applications, n_ffts, n_coarse, n_outer : int
        Applications of the operator on the full grid; transforms on it; applications on all
        coarser grids; active sets tried on the full grid.
    history : tuple of (int, float)
        Applications so far and `kkt`, once per active set of the full grid.
    seconds : float
        Wall time.
    fallback : bool
        Whether the safeguarded conjugate gradients had to finish the work.
    is_stalled : bool
        Whether round-off ended the steps above the tolerance: more of them would gain nothing.
    memory_arrays : float
        Memory held, in maps of the (padded) grid in double precision.
    """

    pressure: Floats
    displacement: Floats
    level: float
    converged: bool
    kkt: float
    certificate: float
    energy: float
    n_applications: int
    n_ffts: int
    n_coarse: int
    n_outer: int
    history: tuple[tuple[int, float], ...]
    seconds: float
    fallback: bool
    is_stalled: bool
    memory_arrays: float


class Problem(NamedTuple):
    """The dimensionless problem: unit self influence, rms height 1, heights of zero mean.

    heights : (ny, nx); load : sum of the pressures, or None; level : rigid approach, or None
    cap : (1,) or (ny nx,) upper bounds, ``inf`` for none
    length, pressure, datum : units [m], [Pa] and the mean height [m] that was taken off
    """

    heights: Floats
    load: float | None
    level: float | None
    cap: Floats
    length: float
    pressure: float
    datum: float


def _checked_cap(cap: float | Floats | None, shape: tuple[int, ...]) -> Floats:
    if cap is None:
        return np.array([np.inf])
    bound = np.asarray(cap, dtype=np.float64)
    if bound.ndim and bound.shape != shape:
        raise DescriptionError("cap", bound.shape, f"be one number or a map of shape {shape}")
    if np.any(np.isnan(bound)) or np.any(bound < 0.0):
        raise DescriptionError("cap", float(np.min(bound)), "be zero or positive", unit="Pa")
    return bound.ravel().copy() if bound.ndim else bound.reshape(1)


def _check_load(mean_pressure: float, bound: Floats) -> None:
    if not np.isfinite(mean_pressure) or mean_pressure < 0.0:
        raise DescriptionError(
            "mean_pressure", mean_pressure, "be zero or positive, and finite", unit="Pa"
        )
    most = float(bound.mean())
    if mean_pressure > most * (1.0 + 1e-12):
        raise InfeasibleError(
            f"a mean pressure of {mean_pressure:.6g} Pa exceeds what the cap can carry, "
            f"{most:.6g} Pa over the whole map"
        )


def pose(
    heights: Floats,
    self_influence: float,
    mean_pressure: float | None = None,
    level: float | None = None,
    cap: float | Floats | None = None,
) -> Problem:
    """Check the description of a contact problem and make it dimensionless.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Rigid rough body, peaks up [m].
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa].
    mean_pressure, level : float, optional
        Load over the area of the map [Pa] or rigid approach [m]: exactly one of them.
    cap : float or ndarray (ny, nx), optional
        Largest pressure a pixel carries [Pa].

    Raises
    ------
    DescriptionError
        For heights that are not finite or not a map, and for impossible loads and caps.
    InfeasibleError
        If the load exceeds what the cap allows.

    Examples
    --------
    >>> round(pose(np.array([[1e-9, 3e-9], [1e-9, 3e-9]]), 1e-19, mean_pressure=1e9).load, 9)
    0.4
    """
    h = np.asarray(heights, dtype=np.float64)
    if h.ndim != 2 or min(h.shape) < 2:
        raise DescriptionError("heights", h.shape, "be a map of at least 2 x 2 pixels")
    if not np.all(np.isfinite(h)):
        raise DescriptionError("heights", "nan or inf", "be finite everywhere", unit="m")
    if (mean_pressure is None) == (level is None):
        raise DescriptionError(
            "mean_pressure, level", (mean_pressure, level), "be given one without the other"
        )
    bound = _checked_cap(cap, h.shape)
    if mean_pressure is not None:
        _check_load(mean_pressure, bound)
    elif level is None or not np.isfinite(level):
        raise DescriptionError("level", level, "be finite", unit="m")
    datum = float(h.mean())
    length = float(h.std())
    is_flat = length <= 1e-9 * float(np.abs(h).max())
    if is_flat:  # the load sets the only length there is
        length = self_influence * mean_pressure if mean_pressure else abs((level or 0.0) + datum)
        length = length or 1.0
    unit = length / self_influence
    return Problem(
        heights=np.zeros_like(h) if is_flat else (h - datum) / length,
        load=None if mean_pressure is None else mean_pressure / unit * h.size,
        level=None if level is None else (level + datum) / length,
        cap=bound / unit,
        length=length,
        pressure=unit,
        datum=datum,
    )


def clip_to_load(trial: Floats, cap: Floats, load: float) -> Floats:
    """Nearest pressures between 0 and `cap` that sum to `load`: shift all, then clip.

    The shift is found by Newton's method on the piecewise linear sum, kept inside a bracket.

    Parameters
    ----------
    trial : ndarray (n,)
        Any pressures.
    cap : ndarray (1,) or (n,)
        Upper bounds.
    load : float
        Sum to reach, at most the sum of the bounds.

    Examples
    --------
    >>> clip_to_load(np.array([-1.0, 1.0, 3.0]), np.array([np.inf]), 3.0)
    array([0. , 0.5, 2.5])
    """
    peak = float(trial.max())
    low = float((trial - np.minimum(cap, load)).min()) - load / trial.size
    high, shift = peak, float(trial.sum() - load) / trial.size
    for _ in range(200):
        shift = shift if low < shift < high else 0.5 * (low + high)
        clipped = np.clip(trial - shift, 0.0, cap)
        excess = float(clipped.sum()) - load
        if abs(excess) <= 1e-15 * load or high - low <= 1e-15 * max(abs(low), abs(high)):
            break
        low, high = (shift, high) if excess > 0.0 else (low, shift)
        slope = np.count_nonzero((clipped > 0.0) & (clipped < cap))
        shift += excess / slope if slope else np.inf
    return clipped


def project(trial: Floats, problem: Problem) -> Floats:
    """Nearest admissible pressures to `trial`, flat arrays.

    Examples
    --------
    >>> flat = Problem(np.zeros((1, 2)), None, 0.0, np.array([1.0]), 1.0, 1.0, 0.0)
    >>> project(np.array([-1.0, 2.0]), flat)
    array([0., 1.])
    """
    if problem.load is None:
        return np.clip(trial, 0.0, problem.cap)
    return clip_to_load(trial, problem.cap, problem.load)


def fit(trial: Floats, problem: Problem) -> Floats:
    """Admissible pressures near `trial` that leave bare pixels bare: clip, then scale.

    Only if the pixels in between cannot make up for the load is the nearest admissible map taken.

    Examples
    --------
    >>> pair = Problem(np.zeros((1, 3)), 3.0, None, np.array([np.inf]), 1.0, 1.0, 0.0)
    >>> fit(np.array([-1.0, 0.0, 2.0]), pair)
    array([0., 0., 3.])
    """
    p = np.clip(trial, 0.0, problem.cap)
    if problem.load is None:
        return p
    for _ in range(20):
        missing = problem.load - float(p.sum())
        if abs(missing) <= 4e-16 * problem.load:
            return p
        free = (p > 0.0) & (p < problem.cap)
        share = float(p[free].sum())
        if share <= 0.0 or share + missing <= 0.0:
            break
        p = np.where(free, np.minimum(p * (1.0 + missing / share), problem.cap), p)
    return p if abs(missing) <= 1e-12 * problem.load else project(p, problem)


def known_pressure(problem: Problem) -> float | Floats | None:
    """Pressures that need no solving: none at all, or the cap everywhere.

    Examples
    --------
    >>> known_pressure(Problem(np.ones((2, 2)), 8.0, None, np.array([2.0]), 1.0, 1.0, 0.0))
    array([[2.]])
    """
    if problem.load == 0.0:
        return 0.0
    if problem.level is not None and problem.level <= -float(problem.heights.max()):
        return 0.0
    carried = float(problem.cap.mean()) * problem.heights.size
    if problem.load is not None and problem.load >= carried * (1.0 - 1e-12):
        return problem.cap.reshape(problem.heights.shape if problem.cap.size > 1 else (1, 1))
    return None


def coarser(problem: Problem, shape: tuple[int, int]) -> Problem:
    """The problem on a coarser grid of the same window: same load per area, same level.

    Examples
    --------
    >>> fine = Problem(np.ones((2, 2)), 8.0, None, np.array([9.0]), 1.0, 1.0, 0.0)
    >>> coarser(fine, (1, 1)).load
    2.0
    """
    heights = restrict(problem.heights, shape)
    cap, load = problem.cap, problem.load
    if cap.size > 1:
        cap = restrict(cap.reshape(problem.heights.shape), shape).ravel()
    if load is not None:
        load *= heights.size / problem.heights.size
    return problem._replace(heights=heights, load=load, cap=cap)
