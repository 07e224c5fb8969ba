"""Two reference solvers: projected conjugate gradients, also the fallback, and L-BFGS-B.

Both take the operator as a function and the dimensionless problem.

Sign convention: pressure, heights and displacement positive into the solid.

======  ==================================================================
symbol  meaning
======  ==================================================================
g       reduced gap ``G p - h``, the gradient of the energy
d       search direction on the free pixels
======  ==================================================================
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import scipy.optimize
from numpy.typing import NDArray

from .optimality import Optimality, height_scale, optimality
from .problem import ContactProblem, fit, project

__all__ = ["Iterate", "conjugate_gradient", "quasi_newton"]

Floats = NDArray[np.float64]
Progress = Callable[[int, float], None] | None
NearInverse = Callable[[NDArray[np.intp], Floats], Floats] | None
GRADIENT_EVERY = 25  # a projected gradient step this often makes the convergence a theorem
PLAIN_STEPS = 8  # without the preconditioner, after a step by it that would raise the energy
MAX_SWEEPS = 100  # multipliers of the load
PATIENCE = 6  # sweeps within which the residual must have halved


class Iterate(NamedTuple):
    """Dimensionless pressures (flat) and displacement, with their optimality.

    optimality : approach, residual and energy bound; relative : residual over the height scale
    scale : the height scale; history : (step, relative)
    is_stalled : whether round-off ended the steps
    """

    pressure: Floats
    displacement: Floats
    optimality: Optimality
    relative: float
    scale: float
    history: tuple[tuple[int, float], ...] = ()
    is_stalled: bool = False

    def certificate(self, load: float) -> float:
        """Bound of the energy error over load and height scale."""
        return self.optimality.energy_gap / (load * self.scale) if load > 0.0 else 0.0


def _graded(p: Floats, u: Floats, problem: ContactProblem) -> Iterate:
    """Optimality of dimensionless pressures and their displacement."""
    h = problem.heights.ravel()
    found = optimality(p, u, h, problem.upper, problem.approach)
    scale = height_scale(h, u, problem.flat)
    return Iterate(p, u, found, found.residual / scale, scale)


def _violation(one: Iterate) -> float:
    return one.relative


def _free(p: Floats, g: Floats, approach: float, upper: Floats) -> NDArray[np.bool_]:
    """Free pixels: between the bounds, or at a bound with a gradient away from it."""
    return ((p > 0.0) | (g < approach)) & ((p < upper) | (g > approach)) & (upper > 0.0)


def conjugate_gradient(
    apply: Callable[[Floats], Floats],
    problem: ContactProblem,
    start: Floats,
    steepest: float,
    rtol: float = 1e-8,
    max_iterations: int = 5000,
    progress: Progress = None,
    near_inverse: NearInverse = None,
) -> Iterate:
    """Projected conjugate gradients with guaranteed convergence.

    A step that would raise the energy is replaced by a projected gradient step of length
    ``1 / steepest``, and so is every 25th: the energy then falls at every step, and at those steps
    by at least a fixed part of the violation of the optimality conditions. Where not even such a
    step lowers the energy, the pressures are exact to round-off.

    Parameters
    ----------
    apply : callable
        ``G p`` on flat dimensionless arrays.
    problem : ContactProblem
        Dimensionless problem.
    start : ndarray (n,)
        Initial pressures, projected on the feasible set.
    steepest : float
        Largest eigenvalue of ``G`` or a bound of it.
    rtol : float
        Largest violation to accept, over `height_scale`.
    max_iterations : int
        Steps at most.
    progress : callable, optional
        Called with the step and its relative residual.
    near_inverse : callable, optional
        Preconditioner: changes of the pressures of some pixels, by their indices, that nearly give
        them a displacement; symmetric and positive definite on any set of pixels.

    Returns
    -------
    Iterate
        The best of all steps; with ``relative > rtol`` if they ran out or stalled.

    Examples
    --------
    >>> heights, unbounded = np.array([[1.0, -1.0]]), np.array([np.inf])
    >>> wedge = ContactProblem(heights, 1.0, None, unbounded, 1.0, 1.0, 0.0)
    >>> conjugate_gradient(lambda p: p, wedge, np.ones(2), 1.0).pressure
    array([1., 0.])
    """
    h, upper = problem.heights.ravel(), problem.upper
    p = fit(start, problem)
    u = apply(p)
    best = _graded(p, u, problem)
    d, r, strength, before = np.zeros_like(p), np.zeros_like(p), 0.0, np.zeros(p.size, bool)
    history: list[tuple[int, float]] = []
    is_stalled, resume = False, 0  # the step from which on the preconditioner is used

    def rise(q: Floats, v: Floats) -> float:
        """Energy of q minus that of p, from their difference: each has a larger round-off."""
        return float((q - p) @ (0.5 * (u + v) - h - approach))

    for step in range(max_iterations + 1):
        found = _graded(p, u, problem)
        best = min(best, found, key=_violation)
        history.append((step, found.relative))
        if progress is not None:
            progress(step, found.relative)
        if found.relative <= rtol or is_stalled or step == max_iterations:
            break
        g, approach = u - h, found.optimality.approach
        free = _free(p, g, approach, upper)
        last, r = r, np.where(free, approach - g, 0.0)
        if problem.load is not None:
            r[free] -= r[free].mean()
        near = near_inverse if step >= resume else None
        z = _preconditioned(near, free, r, problem.load is not None)
        same = np.array_equal(free, before) and strength > 0.0
        # As r.z over that before, but for what projections and single precision have changed.
        d = z + max(float((r - last) @ z) / strength, 0.0) * d if same else z
        before, strength = free, float(r @ z)
        curvature = float(d @ apply(d))
        trial = fit(p + (float(r @ d) / curvature) * d, problem) if curvature > 0.0 else p
        moved = apply(trial)
        if step % GRADIENT_EVERY == GRADIENT_EVERY - 1 or not rise(trial, moved) < 0.0:
            trial = project(p - (g - (problem.approach or 0.0)) / steepest, problem)
            moved = apply(trial)
            is_stalled = not rise(trial, moved) < 0.0
            strength, resume = 0.0, step + PLAIN_STEPS
        p, u = trial, moved
    return best._replace(history=tuple(history), is_stalled=is_stalled)


def _preconditioned(
    near_inverse: NearInverse, free: NDArray[np.bool_], r: Floats, load_fixed: bool
) -> Floats:
    """Changes of the free pixels that nearly take up the residual, of zero sum if the load is."""
    if near_inverse is None:
        return r
    at, z = np.flatnonzero(free), np.zeros_like(r)
    z[at] = near_inverse(at, r[at])
    if load_fixed:
        k = near_inverse(at, np.ones(at.size))
        z[at] -= k * (z[at].sum() / k.sum())
    return z


def _minimised(
    apply: Callable[[Floats], Floats],
    p: Floats,
    g: Floats,
    upper: Floats,
    weight: float,
    gtol: float,
    max_iterations: int,
) -> tuple[Floats, int]:
    """Pressures that L-BFGS-B finds from `p`, whose gradient is `g`, and the steps it took.

    The unknown is the change of the pressures, and the objective the change of the energy. The
    energy itself is exact to 1e-16 of its size only, and with it the pressures to 1e-8 of theirs.
    """

    def gain(d: Floats) -> tuple[float, Floats]:
        q = apply(d) + weight * float(d.sum())
        return float(d @ (g + 0.5 * q)), g + q

    minimize: Any = scipy.optimize.minimize  # its stubs lack bounds with a gradient
    answer = minimize(
        gain,
        np.zeros_like(p),
        jac=True,
        method="L-BFGS-B",
        bounds=scipy.optimize.Bounds(-p, upper - p),
        options={
            "maxcor": 20,
            "ftol": 0.0,
            "gtol": gtol,
            "maxiter": max_iterations,
            "maxfun": 2 * max_iterations,
        },
    )
    return np.clip(p + answer.x, 0.0, upper), int(answer.nit)


def quasi_newton(
    apply: Callable[[Floats], Floats],
    problem: ContactProblem,
    start: Floats,
    steepest: float,
    rtol: float = 1e-8,
    max_iterations: int = 5000,
    progress: Progress = None,
) -> Iterate:
    """L-BFGS-B of scipy; a prescribed load enters by an augmented Lagrangian.

    Parameters and return value are those of `conjugate_gradient`, except that `progress` is called
    with the number of the sweep, one minimisation under one multiplier and penalty. It is slower,
    but an independent check.

    References
    ----------
    .. [1] R. H. Byrd, P. Lu, J. Nocedal, C. Zhu, SIAM J. Sci. Comput. 16 (1995) 1190-1208.
    .. [2] J. Nocedal, S. J. Wright, Numerical Optimization, 2nd ed., Springer 2006, section 17.4.

    Examples
    --------
    >>> heights, unbounded = np.array([[1.0, -1.0]]), np.array([np.inf])
    >>> wedge = ContactProblem(heights, 1.0, None, unbounded, 1.0, 1.0, 0.0)
    >>> quasi_newton(lambda p: p, wedge, np.ones(2), 1.0).pressure.round(6)
    array([1., 0.])
    """
    h, load = problem.heights.ravel(), problem.load
    approach = 0.0 if problem.approach is None else problem.approach
    weight = steepest / h.size if load is not None else 0.0
    round_off = 1e-15 * float(np.abs(h).max())
    p = fit(start, problem)
    best = _graded(p, apply(p), problem)
    history: list[tuple[int, float]] = []
    excess, steps, halved, is_stalled = np.inf, 0, 0, False
    for sweep in range(MAX_SWEEPS):
        missing = float(p.sum()) - load if load is not None else 0.0
        g = apply(p) - h - approach + weight * missing
        gtol = 0.1 * rtol * best.scale
        p, taken = _minimised(apply, p, g, problem.upper, weight, gtol, max_iterations - steps)
        steps += taken
        is_settled = True
        if load is not None:
            last, excess = excess, float(p.sum()) - load
            shift = weight * excess
            approach -= shift
            is_settled = abs(shift) <= max(gtol, round_off) or abs(excess) <= 1e-14 * load
            weight *= 1.0 if is_settled or abs(excess) <= 0.1 * abs(last) else 4.0
        admissible = fit(p, problem)
        found = _graded(admissible, apply(admissible), problem)
        history.append((sweep, found.relative))
        if progress is not None:
            progress(sweep, found.relative)
        halved = sweep if found.relative < 0.5 * best.relative else halved
        best = min(best, found, key=_violation)
        is_stalled = is_settled and sweep - halved >= PATIENCE
        if best.relative <= rtol or is_stalled or steps >= max_iterations:
            break
    return best._replace(history=tuple(history), is_stalled=is_stalled)
