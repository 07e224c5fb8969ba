"""Two plain contact solvers, to check the fast one by and to fall back on.

Both take a prepared `Press` for its operator and give back the same `Solution`.

Sign convention: pressure, heights and displacement positive into the solid.

======  ==================================================================
symbol  meaning
======  ==================================================================
g       reduced gap ``G p - h``, the gradient of the energy
d       search direction on the pixels that may move
======  ==================================================================
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import scipy.optimize
from numpy.typing import NDArray

from .optimality import Optimality, height_scale, optimality
from .problem import Problem, fit, project

__all__ = ["Iterate", "conjugate_gradient", "quasi_newton"]

Floats = NDArray[np.float64]
Progress = Callable[[int, float], None] | None
GRADIENT_EVERY = 25  # a projected gradient step this often makes the convergence a theorem


class Iterate(NamedTuple):
    """Dimensionless pressures (flat) and displacement with how good they are.

    optimality : level, residual and energy bound; relative : residual over the height scale
    scale : the height scale; history : (step, relative)
    """

    pressure: Floats
    displacement: Floats
    optimality: Optimality
    relative: float
    scale: float
    history: tuple[tuple[int, float], ...]

    def certificate(self, load: float) -> float:
        """Bound of the energy error over load and height scale."""
        return self.optimality.gap_energy / (load * self.scale) if load > 0.0 else 0.0


def graded(p: Floats, u: Floats, problem: Problem) -> tuple[Optimality, float, float]:
    """Optimality of a dimensionless iterate, its residual over the height scale, and that scale.

    Examples
    --------
    >>> flat = Problem(np.zeros((1, 2)), 2.0, None, np.array([np.inf]), 1.0, 1.0, 0.0)
    >>> graded(np.ones(2), np.ones(2), flat)[1]
    0.0
    """
    h = problem.heights.ravel()
    found = optimality(p, u, h, problem.cap, problem.level)
    scale = height_scale(h, u, flat=1.0)
    return found, found.residual / scale, scale


def _movable(p: Floats, g: Floats, level: float, cap: Floats) -> NDArray[np.bool_]:
    """Pixels between the bounds, and those at a bound that want to leave it."""
    return ((p > 0.0) | (g < level)) & ((p < cap) | (g > level)) & (cap > 0.0)


def conjugate_gradient(
    apply: Callable[[Floats], Floats],
    problem: Problem,
    start: Floats,
    steepest: float,
    rtol: float = 1e-8,
    max_iterations: int = 5000,
    progress: Progress = None,
) -> Iterate:
    """Conjugate gradients on the contact, clipped to the bounds, that cannot fail to converge.

    A step that would raise the energy is replaced by a projected gradient step of length
    ``1 / steepest``, and so is every 25th: the energy then falls at every step, and at those steps
    by at least a fixed part of what the optimality conditions leave.

    Parameters
    ----------
    apply : callable
        ``G p`` on flat dimensionless arrays.
    problem : Problem
        Dimensionless problem.
    start : ndarray (n,)
        First pressures; made admissible first.
    steepest : float
        Largest eigenvalue of ``G`` or a bound of it.
    rtol : float
        Largest violation to accept, over `height_scale`.
    max_iterations : int
        Steps at most.
    progress : callable, optional
        Called with the step and its relative residual.

    Returns
    -------
    Iterate
        With ``relative > rtol`` if the steps ran out.

    Examples
    --------
    >>> wedge = Problem(np.array([[1.0, -1.0]]), 1.0, None, np.array([np.inf]), 1.0, 1.0, 0.0)
    >>> conjugate_gradient(lambda p: p, wedge, np.ones(2), 1.0).pressure
    array([1., 0.])
    """
    h, cap = problem.heights.ravel(), problem.cap
    lifted = h + (problem.level or 0.0)  # what the energy of a prescribed level is taken from
    p = fit(start, problem)
    u = apply(p)
    d, strength, before = np.zeros_like(p), 0.0, np.zeros(p.size, bool)
    history: list[tuple[int, float]] = []
    for step in range(max_iterations + 1):
        found, relative, scale = graded(p, u, problem)
        history.append((step, relative))
        if progress is not None:
            progress(step, relative)
        if relative <= rtol or step == max_iterations:
            break
        g = u - h
        moving = _movable(p, g, found.level, cap)
        r = np.where(moving, found.level - g, 0.0)
        if problem.load is not None:
            r[moving] -= r[moving].mean()
        rr = float(r @ r)
        same = np.array_equal(moving, before) and strength > 0.0
        d = r + (rr / strength) * d if same else r
        before, strength = moving, rr
        q = apply(d)
        curvature = float(d @ q)
        energy = float(p @ (0.5 * u - lifted))
        trial = fit(p + (float(r @ d) / curvature) * d, problem) if curvature > 0.0 else p
        moved = apply(trial)
        if step % GRADIENT_EVERY == GRADIENT_EVERY - 1 or not (
            float(trial @ (0.5 * moved - lifted)) < energy - 1e-14 * abs(energy)
        ):
            trial = project(p - (g - (problem.level or 0.0)) / steepest, problem)
            moved = apply(trial)
            strength = 0.0
        p, u = trial, moved
    return Iterate(p, u, found, relative, scale, tuple(history))


def quasi_newton(
    apply: Callable[[Floats], Floats],
    problem: Problem,
    start: Floats,
    steepest: float,
    rtol: float = 1e-8,
    max_iterations: int = 5000,
    progress: Progress = None,
) -> Iterate:
    """L-BFGS-B of scipy; a prescribed load enters by an augmented Lagrangian.

    Parameters and return value are those of `conjugate_gradient`. Slower and less exact (some 1e-6
    of the rms height in practice), but of quite another make, which is what a check needs.

    References
    ----------
    .. [1] R. H. Byrd, P. Lu, J. Nocedal, C. Zhu, SIAM J. Sci. Comput. 16 (1995) 1190-1208.

    Examples
    --------
    >>> wedge = Problem(np.array([[1.0, -1.0]]), 1.0, None, np.array([np.inf]), 1.0, 1.0, 0.0)
    >>> quasi_newton(lambda p: p, wedge, np.ones(2), 1.0).pressure.round(6)
    array([1., 0.])
    """
    h, load = problem.heights.ravel(), problem.load
    level = 0.0 if problem.level is None else problem.level
    weight = steepest / h.size if load is not None else 0.0
    p = fit(start, problem)
    history: list[tuple[int, float]] = []
    excess = np.inf

    def energy(p: Floats) -> tuple[float, Floats]:
        u = apply(p)
        excess = float(p.sum()) - (load or 0.0)
        value = 0.5 * float(p @ u) - float(h @ p) - level * excess + 0.5 * weight * excess**2
        return value, u - h - level + weight * excess

    bounds = scipy.optimize.Bounds(np.zeros(h.size), np.broadcast_to(problem.cap, h.shape))
    options: dict[str, Any] = {"maxiter": max_iterations, "maxfun": 2 * max_iterations}
    options |= {"maxcor": 20, "ftol": 1e-16, "gtol": 0.1 * rtol}
    for sweep in range(40 if load is not None else 1):
        least: Any = scipy.optimize.minimize  # its stubs know no bounded method with a gradient
        answer = least(energy, p, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
        p = np.asarray(answer.x)
        if load is not None:
            last, excess = excess, float(p.sum()) - load
            level -= weight * excess
            weight *= 4.0 if abs(excess) > 0.1 * abs(last) else 1.0
        admissible = fit(p, problem)
        u = apply(admissible)
        found, relative, scale = graded(admissible, u, problem)
        history.append((sweep, relative))
        if progress is not None:
            progress(sweep, relative)
        if relative <= rtol:
            break
    return Iterate(admissible, u, found, relative, scale, tuple(history))
