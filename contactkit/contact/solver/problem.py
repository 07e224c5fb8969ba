"""The contact problem in dimensionless form, its feasible set, and the solution in SI units.

Minimise ``p'Gp/2 - h'p`` over ``0 <= p <= upper`` with either the sum of the pressures or the
rigid-body approach prescribed. Lengths are divided by the rms height and pressures by the pressure
that displaces one pixel by it, so that metres and nanometres take the same steps.

Sign convention: pressure, heights and displacement positive into the solid; ``u - h - approach``
is the gap.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError, InfeasibleError
from .optimality import ROUNDED
from .transfer import restrict

__all__ = [
    "ContactProblem",
    "Solution",
    "clip_to_load",
    "coarser",
    "fit",
    "known_pressure",
    "pose",
    "project",
]

Floats = NDArray[np.float64]
SMALLEST, LARGEST = 1e-140, 1e140  # heights [m] whose squares neither overflow nor underflow


class Solution(NamedTuple):
    """Solution of a contact problem in SI units.

    Attributes
    ----------
    pressure : ndarray (ny, nx)
        [Pa]
    displacement : ndarray (ny, nx)
        Of the surface, into the solid; of zero mean if periodic [m].
    rigid_approach : float
        Rigid-body approach of the zero plane of the heights [m]; the gap is
        ``displacement - heights - rigid_approach``.
    converged : bool
        Whether `kkt` is at most the tolerance.
    kkt : float
        Largest violation of a contact condition over the map, relative to `height_scale`.
    certificate : float
        Bound of the energy error, over load times `height_scale`.
    energy : float
        ``p'Gp/2 - h'p`` times the pixel area [J].
    n_applications, n_ffts, n_coarse, n_outer : int
        Applications of the operator on the full grid; transforms on it; applications on all
        coarser grids; active-set iterations on the full grid.
    history : tuple of (int, float)
        Number of applications and `kkt`, once per active-set iteration on the full grid.
    seconds : float
        Wall time.
    fallback : bool
        Whether the safeguarded conjugate gradient method had to finish the work.
    is_stalled : bool
        Whether round-off ended the steps above the tolerance: more of them would gain nothing.
    memory_arrays : float
        Memory held, in maps of the (padded) grid in double precision.
    """

    pressure: Floats
    displacement: Floats
    rigid_approach: float
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


class ContactProblem(NamedTuple):
    """The dimensionless problem: unit self influence, rms height 1, heights of zero mean.

    heights : (ny, nx); load : sum of the pressures, or None
    approach : rigid-body approach of the zero plane, or None
    upper : (1,) or (ny nx,) upper bounds, ``inf`` for none; 0 in holes
    length, pressure, datum : units [m], [Pa] and the mean height [m] that was taken off
    """

    heights: Floats
    load: float | None
    approach: float | None
    upper: Floats
    length: float
    pressure: float
    datum: float

    @property
    def flat(self) -> float:
        """Displacement of a single pixel under the mean pressure, as `height_scale` takes it."""
        return max(1.0, (self.load or 0.0) / self.heights.size)


def _without_holes(heights: Floats) -> tuple[Floats, Floats | None]:
    """Heights with holes filled by the mean of the others, and a bound that keeps these free."""
    if not isinstance(heights, np.ma.MaskedArray):
        return np.asarray(heights, dtype=np.float64), None
    holes = np.ma.getmaskarray(heights)
    if holes.all() and holes.size:
        raise DescriptionError("heights", "a mask over all pixels", "have pixels that may touch")
    filled = np.array(np.ma.getdata(heights), dtype=np.float64)
    filled[holes] = filled[~holes].mean() if holes.any() else 0.0
    return filled, np.where(holes, 0.0, np.inf).ravel() if holes.any() else None


def _checked_bound(bound: float | Floats | None, shape: tuple[int, ...]) -> Floats:
    if bound is None:
        return np.array([np.inf])
    upper = np.asarray(bound, dtype=np.float64)
    if upper.ndim and upper.shape != shape:
        raise DescriptionError("bound", upper.shape, f"be one number or a map of shape {shape}")
    if np.any(np.isnan(upper)) or np.any(upper < 0.0):
        raise DescriptionError("bound", float(np.min(upper)), "be zero or positive", unit="Pa")
    return upper.ravel().copy() if upper.ndim else upper.reshape(1)


def _check_load(mean_pressure: float, upper: Floats) -> None:
    if not np.isfinite(mean_pressure) or mean_pressure < 0.0:
        raise DescriptionError(
            "mean_pressure", mean_pressure, "be zero or positive, and finite", unit="Pa"
        )
    highest = float(upper.mean())
    if mean_pressure > highest * (1.0 + 1e-12):
        raise InfeasibleError(
            f"a mean pressure of {mean_pressure:.6g} Pa exceeds what the bound can carry, "
            f"{highest:.6g} Pa over the whole map"
        )


def pose(
    heights: Floats,
    self_influence: float,
    mean_pressure: float | None = None,
    rigid_approach: float | None = None,
    bound: float | Floats | None = None,
) -> ContactProblem:
    """Check a contact problem and make it dimensionless.

    Parameters
    ----------
    heights : ndarray (ny, nx), may be masked
        Rigid rough body, peaks up [m]. Masked pixels are holes, which carry no load.
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa].
    mean_pressure, rigid_approach : float, optional
        Load over the area of the map [Pa], or approach of the zero plane of the heights [m]:
        exactly one of them.
    bound : float or ndarray (ny, nx), optional
        Upper bound of the pressure of a pixel [Pa].

    Raises
    ------
    DescriptionError
        For heights that are not finite or not a map, and for impossible loads and bounds.
    InfeasibleError
        If the load exceeds what the bound allows.

    Examples
    --------
    >>> round(pose(np.array([[1e-9, 3e-9], [1e-9, 3e-9]]), 1e-19, mean_pressure=1e9).load, 9)
    0.4
    """
    h, room = _without_holes(heights)
    if h.ndim != 2 or min(h.shape) < 2:
        raise DescriptionError("heights", h.shape, "be a map of at least 2 x 2 pixels")
    if not np.all(np.isfinite(h)):
        raise DescriptionError("heights", "nan or inf", "be finite everywhere", unit="m")
    if not float(np.abs(h).max()) < LARGEST:
        raise DescriptionError(
            "heights", float(np.abs(h).max()), f"be below {LARGEST:g}", unit="m", hint="check units"
        )
    if (mean_pressure is None) == (rigid_approach is None):
        raise DescriptionError(
            "mean_pressure, rigid_approach",
            (mean_pressure, rigid_approach),
            "be given one without the other",
        )
    upper = _checked_bound(bound, h.shape)
    upper = upper if room is None else np.minimum(upper, room)
    if mean_pressure is not None:
        _check_load(mean_pressure, upper)
    elif rigid_approach is None or not np.isfinite(rigid_approach):
        raise DescriptionError("rigid_approach", rigid_approach, "be finite", unit="m")
    pressed = self_influence * (mean_pressure or 0.0)
    rounded = ROUNDED * max(float(np.abs(h).max()), pressed)
    datum = float(h.mean())
    h = h - datum
    h -= float(h.mean())  # what the mean of heights far from zero lost to round-off
    length = float(h.std())
    if length <= max(rounded, SMALLEST):  # flat: the load sets the only length there is
        h[...] = 0.0
        length = pressed or abs((rigid_approach or 0.0) + datum) or 1.0
    unit = length / self_influence
    h /= length
    with np.errstate(over="ignore"):  # a bound out of reach is none
        upper = upper / unit
    return ContactProblem(
        heights=h,
        load=None if mean_pressure is None else mean_pressure / unit * h.size,
        approach=None if rigid_approach is None else (rigid_approach + datum) / length,
        upper=upper,
        length=length,
        pressure=unit,
        datum=datum,
    )


def clip_to_load(trial: Floats, upper: Floats, load: float) -> Floats:
    """Project pressures on the feasible set: shift all alike, then clip to the bounds.

    The shift is found by Newton's method on the piecewise linear sum, kept inside a bracket.

    Parameters
    ----------
    trial : ndarray (n,)
        Any pressures.
    upper : ndarray (1,) or (n,)
        Upper bounds.
    load : float
        Sum to reach, at most the sum of the bounds.

    Examples
    --------
    >>> clip_to_load(np.array([-1.0, 1.0, 3.0]), np.array([np.inf]), 3.0)
    array([0. , 0.5, 2.5])
    """
    peak = float(trial.max())
    low = float((trial - np.minimum(upper, load)).min()) - load / trial.size
    high, shift = peak, float(trial.sum() - load) / trial.size
    for _ in range(200):
        shift = shift if low < shift < high else 0.5 * (low + high)
        p = np.clip(trial - shift, 0.0, upper)
        excess = float(p.sum()) - load
        if abs(excess) <= 1e-15 * load or high - low <= 1e-15 * max(abs(low), abs(high)):
            break
        low, high = (shift, high) if excess > 0.0 else (low, shift)
        slope = np.count_nonzero((p > 0.0) & (p < upper))
        shift += excess / slope if slope else np.inf
    return p if abs(excess) <= 1e-13 * load else _topped_up(p, trial, upper, load)


def _topped_up(p: Floats, trial: Floats, upper: Floats, load: float) -> Floats:
    """Restore a load that no shift reaches because the trial dwarfs it: highest pixels first."""
    order = np.argsort(-trial, kind="stable")
    room = np.broadcast_to(np.minimum(upper, load), p.shape)[order]
    before = np.concatenate([[0.0], np.cumsum(room)[:-1]])
    made = np.zeros_like(p)
    made[order] = np.clip(load - before, 0.0, room)
    return made


def project(trial: Floats, problem: ContactProblem) -> Floats:
    """Nearest feasible pressures to `trial`, flat arrays.

    Examples
    --------
    >>> flat = ContactProblem(np.zeros((1, 2)), None, 0.0, np.array([1.0]), 1.0, 1.0, 0.0)
    >>> project(np.array([-1.0, 2.0]), flat)
    array([0., 1.])
    """
    if problem.load is None:
        return np.clip(trial, 0.0, problem.upper)
    return clip_to_load(trial, problem.upper, problem.load)


def fit(trial: Floats, problem: ContactProblem) -> Floats:
    """Feasible pressures near `trial` without new contact pixels: clip, then scale to the load.

    Only if the free pixels cannot make up for the load is the nearest feasible map taken.

    Examples
    --------
    >>> pair = ContactProblem(np.zeros((1, 3)), 3.0, None, np.array([np.inf]), 1.0, 1.0, 0.0)
    >>> fit(np.array([-1.0, 0.0, 2.0]), pair)
    array([0., 0., 3.])
    """
    p = np.clip(trial, 0.0, problem.upper)
    if problem.load is None:
        return p
    at = np.flatnonzero(p)
    upper = np.broadcast_to(problem.upper, p.shape)[at]
    for _ in range(20):
        q = p[at]
        missing = problem.load - float(q.sum())
        if abs(missing) <= 4e-16 * problem.load:
            return p
        free = q < upper
        carried = float(q[free].sum())
        if carried <= 0.0 or carried + missing <= 0.0:
            break
        p[at] = np.where(free, np.minimum(q * (1.0 + missing / carried), upper), q)
    return p if abs(missing) <= 1e-12 * problem.load else project(p, problem)


def known_pressure(problem: ContactProblem) -> float | Floats | None:
    """Pressures that need no solve: none at all, or the bound everywhere.

    Examples
    --------
    >>> known_pressure(ContactProblem(np.ones((2, 2)), 8.0, None, np.array([2.0]), 1.0, 1.0, 0.0))
    array([[2.]])
    """
    if problem.load == 0.0:
        return 0.0
    if problem.approach is not None and problem.approach <= -float(problem.heights.max()):
        return 0.0
    carried = float(problem.upper.mean()) * problem.heights.size
    if problem.load is not None and problem.load >= carried * (1.0 - 1e-12):
        return problem.upper.reshape(problem.heights.shape if problem.upper.size > 1 else (1, 1))
    return None


def coarser(problem: ContactProblem, shape: tuple[int, int]) -> ContactProblem:
    """The problem on a coarser grid of the same window: same mean pressure, same approach.

    Examples
    --------
    >>> fine = ContactProblem(np.ones((2, 2)), 8.0, None, np.array([9.0]), 1.0, 1.0, 0.0)
    >>> coarser(fine, (1, 1)).load
    2.0
    """
    heights = restrict(problem.heights, shape)
    upper, load = problem.upper, problem.load
    if upper.size > 1:
        upper = restrict(upper.reshape(problem.heights.shape), shape).ravel()
    if load is not None:
        load *= heights.size / problem.heights.size
    return problem._replace(heights=heights, load=load, upper=upper)
