"""Contact solver: pressure between two bounds by a primal-dual active set on nested grids.

Minimise ``p'Gp/2 - h'p`` over ``0 <= p <= bound`` with the load or the rigid-body approach
prescribed. Coarser grids only provide the initial guess of the next finer one (nested iteration);
on the finest the active-set method runs to the tolerance.

Sign convention: z into the solid; pressure, heights (peaks up, towards the solid) and displacement
positive into it; the gap is ``displacement - heights - rigid_approach``.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from ...errors import ConvergenceError, DescriptionError, InfeasibleError
from ...numerics.fft import Edges
from .active_set import SetOutcome, improve
from .convolution import SymbolMaker
from .first_guess import first_guess
from .linear_response import linear_response
from .loops_numpy import dot
from .nested_grids import bytes_of, prepare
from .problem import ContactProblem, Solution, coarser, fit, known_pressure, pose
from .reference_solvers import Iterate, conjugate_gradient, quasi_newton
from .transfer import prolong
from .warm_start import FARTHEST_HELD, Start, initial_pressure

__all__ = ["ContactSolver", "Response", "Solution"]

Floats = NDArray[np.float64]
REFERENCE: dict[str, Callable[..., Iterate]] = {  # the fallback, or the method itself
    "active-set": conjugate_gradient,
    "conjugate-gradient": conjugate_gradient,
    "quasi-newton": quasi_newton,
}
# On coarser grids, which only provide the initial guess of the next: at 0.1 the finest takes 6 %
# more applications, at 5e-3 3 % fewer, for more on the coarse ones (the contacts of the room, on
# 128 x 128 pixels).
COARSE_RTOL = 2e-2
AT_BOUND = 1e-9  # fraction of the bound by which an extrapolation misses it in round-off
MOST_STEPS = 400  # of the fallback: it has converged by then, or it is not worth its time
MOST_AT_BOUND = 0.3  # fraction of the contact up to which pixels are free to take up a far load


class Response(NamedTuple):
    """Pressures of a linear response (ny, nx), zero on other pixels, and what it took.

    `shift` is the constant by which the displacement exceeds the wanted one [m].
    """

    pressure: Floats
    shift: float
    n_applications: int


class ContactSolver:
    """Contact solver of one grid and solid, for any heights, load and pressure bound.

    Reuse it for load curves and outer iterations: only `solve` is repeated, from the previous
    pressures as `start`.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(ny, nx)``, at least 2 x 2, any numbers.
    pixel_size : tuple of float
        ``(dy, dx)`` [m].
    make_symbol : callable
        ``make(shape, pixel_size)`` gives the real symbol [m/Pa] of any grid of the same window:
        periodic on the half spectrum ``(ny, nx // 2 + 1)``, at wavenumber 0 zero if the mean plane
        of the surface is the datum of displacements; otherwise the transform of the even influence
        coefficients on the doubled map, ``(2 ny, nx + 1)``, doubled across alone if the window
        repeats along one axis.
    periodic : bool, "x" or "y"
        Whether the window repeats, or along which axis alone; otherwise the contact is isolated.
    threads : int
        Threads of the transforms and of the compiled loops.
    fast : bool, optional
        Whether numba and ducc0 are required or refused; None uses them if installed.

    Attributes
    ----------
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa].

    Raises
    ------
    DescriptionError
        For an impossible shape, pixel or symbol.

    Notes
    -----
    Some 25 to 45 applications of the operator to 1e-8, whatever the number of pixels, the load or
    the bound, for a half-space and for films. Of 1296 contacts of films up to a million times
    stiffer or softer than their ground, under up to 1e5 times a usual load, with and without a
    bound, none took more than 110, and none needed the fallback. The method is new; it
    follows the primal-dual active set of [1]_ and the cascadic multigrid of [2]_.

    A solver owns its work arrays: threads that share one wait for each other.

    References
    ----------
    .. [1] M. Hintermueller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2002) 865-888.
    .. [2] F. A. Bornemann, P. Deuflhard, Numer. Math. 75 (1996) 135-152.

    Examples
    --------
    A wave of height 1 nm and length 64 nm under half the pressure that flattens it (Westergaard):

    >>> def half_space(shape, pixel_size):
    ...     qy = 2 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
    ...     qx = 2 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1])
    ...     q = np.hypot(qy, qx)
    ...     return np.divide(2.0, 1e9 * q, out=np.zeros_like(q), where=q > 0)
    >>> solver = ContactSolver((8, 64), (1e-9, 1e-9), half_space, periodic=True, fast=False)
    >>> wave = 1e-9 * np.cos(2 * np.pi * (np.arange(64) + 0.5) / 64) * np.ones((8, 1))
    >>> flattening = np.pi * 1e9 / 64
    >>> solution = solver.solve(wave, mean_pressure=0.5 * flattening)
    >>> solution.converged, float(np.mean(solution.pressure > 0.0))
    (True, 0.5)
    """

    def __init__(
        self,
        shape: tuple[int, int],
        pixel_size: tuple[float, float],
        make_symbol: SymbolMaker,
        periodic: Edges,
        threads: int = 1,
        fast: bool | None = None,
    ) -> None:
        if len(shape) != 2 or min(shape) < 2:
            raise DescriptionError("shape", shape, "be at least 2 x 2 pixels")
        if not all(np.isfinite(d) and d > 0.0 for d in pixel_size):
            raise DescriptionError("pixel_size", pixel_size, "be positive and finite", unit="m")
        if threads < 1:
            raise DescriptionError("threads", threads, "be at least 1")
        self.shape = (int(shape[0]), int(shape[1]))
        self.pixel_size = (float(pixel_size[0]), float(pixel_size[1]))
        self.periodic = periodic
        self.threads = int(threads)
        with scipy.fft.set_workers(self.threads):
            self.grids, self.self_influence = prepare(
                self.shape, self.pixel_size, make_symbol, periodic, self.threads, fast
            )
        self._lock = threading.Lock()

    @contextmanager
    def _at_work(self) -> Iterator[None]:
        """Have the work arrays alone, and everything on the threads of the solver."""
        loops = self.grids[0].loops
        with self._lock, scipy.fft.set_workers(self.threads), loops.on_threads(self.threads):
            yield

    @property
    def nbytes(self) -> int:
        """Memory that the nested grids hold [bytes]."""
        return bytes_of(self.grids)

    def displacement(self, pressure: Floats) -> Floats:
        """Displacement under any pressure map, of zero mean if periodic [m].

        Raises
        ------
        DescriptionError
            If the map has another shape.
        """
        p = np.asarray(pressure, dtype=np.float64)
        if p.shape != self.shape:
            raise DescriptionError("pressure", p.shape, f"have the shape {self.shape}")
        fine = self.grids[0]
        with self._at_work():
            fine.pressure[...] = p
            fine.displace(True)
            return fine.gap * self.self_influence

    @property
    def uniform_compliance(self) -> float:
        """Mean displacement of a periodic map per mean pressure [m/Pa].

        Zero if its mean plane is the datum, and for incompressible layers on a base.
        """
        return self.grids[0].uniform * self.self_influence

    def solve(
        self,
        heights: Floats,
        *,
        mean_pressure: float | None = None,
        rigid_approach: float | None = None,
        bound: float | Floats | None = None,
        rtol: float = 1e-8,
        start: Start | None = None,
        max_iterations: int = 5000,
        method: str = "active-set",
    ) -> Solution:
        """Pressure under a given load or rigid-body approach.

        Parameters
        ----------
        heights : ndarray (ny, nx), may be masked
            Rigid rough body, peaks up [m]. Masked pixels are holes, which carry no load.
        mean_pressure, rigid_approach : float, optional
            Load over the area of the map [Pa], or approach of the zero plane of the heights [m]:
            exactly one of them.
        bound : float or ndarray (ny, nx), optional
            Upper bound of the pressure of a pixel [Pa].
        rtol : float
            Largest violation of a contact condition to accept, over `optimality.height_scale` [-].
        start : ndarray (ny, nx) or sequence of (float, ndarray), optional
            Initial pressures [Pa], instead of those of the nested grids; or pairs of mean pressure
            (rigid-body approach, if that is prescribed) and pressures of earlier solutions, the
            best first, to be extrapolated. Not used far from them, or where much of the contact
            is at its bound: the nested grids are the better start there.
        max_iterations : int
            Maximum number of iterations of a reference method; the fallback takes at most 400.
        method : {"active-set", "conjugate-gradient", "quasi-newton"}
            The last two are slow reference methods.

        Returns
        -------
        Solution
            With `converged` false where the tolerance is not reached.

        Raises
        ------
        DescriptionError
            For impossible heights, loads, bounds or starts.
        InfeasibleError
            If the bound cannot carry the load, or no load brings a periodic map to the approach.
        """
        if np.shape(heights) != self.shape:
            raise DescriptionError("heights", np.shape(heights), f"have the shape {self.shape}")
        if method not in REFERENCE:
            raise DescriptionError("method", method, f"be one of {', '.join(REFERENCE)}")
        if not (np.isfinite(rtol) and rtol > 0.0):
            raise DescriptionError("rtol", rtol, "be positive and finite")
        problem = pose(heights, self.self_influence, mean_pressure, rigid_approach, bound)
        self._refuse_closed_gap(problem)
        with self._at_work():
            begun = time.perf_counter()
            started = self._reset(problem, start, mean_pressure, rigid_approach)
            p = known_pressure(problem)
            if p is not None:
                self.grids[0].pressure[...] = p
            elif not started:
                self._from_coarse_grids(problem)
            if method == "active-set":
                outcome = improve(self.grids[0], problem, rtol, started)
                fallback = not outcome.relative <= rtol
            else:
                outcome, fallback = SetOutcome(0.0, np.inf, 0.0, 0, ()), False
            if fallback:
                max_iterations = min(max_iterations, MOST_STEPS)
            if fallback or method != "active-set":
                solver = REFERENCE[method]
                if fallback:
                    solver = partial(solver, near_inverse=self._near_inverse(problem))
                outcome = self._by_reference(solver, problem, outcome, rtol, max_iterations)
            return self._solution(problem, outcome, rtol, fallback, begun)

    def response(
        self, free: NDArray[np.bool_], right: Floats, total: float | None, rtol: float = 1e-10
    ) -> Response:
        """Pressures on some pixels that displace these as given, and no others of them.

        The linear equations of a contact whose pixels in contact stay what they are, and as they
        are symmetric its adjoint equations.

        Parameters
        ----------
        free : ndarray (ny, nx) of bool
            The pixels.
        right : ndarray (ny, nx)
            Wanted displacement there [m], up to a constant if the sum is given.
        total : float, optional
            Sum of the pressures [Pa]; None: no constant is free.
        rtol : float
            Residual over the size of the right-hand side.

        Raises
        ------
        ConvergenceError
            If the residual stays above ten times the tolerance.
        """
        at, own = np.flatnonzero(free), self.self_influence
        with self._at_work():
            for grid in self.grids:
                grid.reset()
            given = np.asarray(right, dtype=np.float64).ravel()[at] / own
            found = linear_response(self.grids[0], at, given, total, rtol)
            n = self.grids[0].applications()
        if not found.residual <= 10.0 * rtol:
            raise ConvergenceError(
                f"the linear equations of the contact are solved to {found.residual:.2g} of their "
                f"right-hand side, not to {rtol:g}: round-off of a stiff film; ask for less"
            )
        return Response(found.pressure.reshape(self.shape), found.shift * own, n)

    def _refuse_closed_gap(self, problem: ContactProblem) -> None:
        """No load closes the whole gap of a periodic map whose mean displacement is zero."""
        if (
            self.periodic is True
            and not self.grids[0].uniform
            and problem.approach is not None
            and problem.approach >= 0.0
            and np.all(np.isinf(problem.upper))
        ):
            raise InfeasibleError(
                "the approach reaches the mean plane of the heights, where the gap of a periodic "
                "map is closed under any load; prescribe the load instead"
            )

    def _reset(
        self,
        problem: ContactProblem,
        start: Start | None,
        mean_pressure: float | None,
        rigid_approach: float | None,
    ) -> bool:
        """Reset the counters; whether a good initial guess is on the finest grid."""
        for grid in self.grids:
            grid.reset()
        if start is None:
            return False
        imposed = rigid_approach if mean_pressure is None else mean_pressure
        is_load = mean_pressure is not None
        initial = initial_pressure(start, imposed or 0.0, is_load, self.shape)
        if initial is None:
            return False
        is_far = initial.distance > FARTHEST_HELD
        if is_far and self.grids[0].is_stiff and np.isfinite(initial.distance):
            return False
        p = initial.pressure.ravel() / problem.pressure
        at = np.flatnonzero(p)
        bound = np.broadcast_to(problem.upper, p.shape)[at]
        at_bound = p[at] > bound * (1.0 - AT_BOUND)
        p[at] = np.where(at_bound, bound, p[at])
        p = fit(p, problem)
        self.grids[0].pressure[...] = p.reshape(self.shape)
        n_at_bound = max(np.count_nonzero(at_bound), np.count_nonzero(p[at] >= bound))
        return bool(n_at_bound <= MOST_AT_BOUND * at.size or not is_far)

    def _from_coarse_grids(self, problem: ContactProblem) -> None:
        """Nested iteration: solve roughly on ever finer grids, for a guess on the finest."""
        problems = [problem]
        for grid in self.grids[1:]:
            problems.append(coarser(problems[-1], grid.pressure.shape))
        p = first_guess(self.grids[-1], problems[-1])
        for grid, coarse in zip(self.grids[::-1], problems[::-1], strict=True):
            shape = grid.pressure.shape
            if p.shape == shape:
                grid.pressure[...] = p
            else:
                prolong(p, shape, grid.pressure)
            if np.isfinite(coarse.upper).any():
                flat = grid.pressure.ravel()
                np.minimum(flat, coarse.upper, out=flat)
            if coarse is not problem:
                improve(grid, coarse, COARSE_RTOL)
                p = grid.pressure

    def _near_inverse(
        self, problem: ContactProblem
    ) -> Callable[[NDArray[np.intp], Floats], Floats]:
        """The sparse inverse of the finest grid, made anew when the free pixels change."""
        metric = self.grids[0].metric

        def apply(at: NDArray[np.intp], r: Floats) -> Floats:
            if not np.array_equal(metric.at, at):
                metric.prepare(at, problem.load is not None)
            return np.asarray(metric(r), np.float64)

        return apply

    def _by_reference(
        self,
        method: Callable[..., Iterate],
        problem: ContactProblem,
        outcome: SetOutcome,
        rtol: float,
        max_iterations: int,
    ) -> SetOutcome:
        """Finish, or solve entirely, by a reference method."""
        fine = self.grids[0]

        def apply(p: Floats) -> Floats:
            fine.pressure[...] = p.reshape(self.shape)
            fine.displace(True)
            return fine.gap.ravel().copy()

        first = fine.pressure.ravel().copy()
        done = method(apply, problem, first, fine.steepest, rtol, max_iterations)
        fine.pressure[...] = done.pressure.reshape(self.shape)
        fine.gap[...] = done.displacement.reshape(self.shape) - problem.heights
        load = float(done.pressure.sum())
        return outcome._replace(
            approach=done.optimality.approach,
            relative=done.relative,
            certificate=done.certificate(load),
            history=outcome.history + done.history,
            is_stalled=done.is_stalled,
        )

    def _solution(
        self,
        problem: ContactProblem,
        outcome: SetOutcome,
        rtol: float,
        fallback: bool,
        begun: float,
    ) -> Solution:
        fine = self.grids[0]
        p, u = fine.pressure, fine.gap  # work arrays: the last use of the gap
        u += problem.heights
        unit = problem.pressure * problem.length * self.pixel_size[0] * self.pixel_size[1]
        offset = problem.datum / problem.length
        at = np.flatnonzero(p)  # few pixels, of large maps
        weight, total = p.ravel()[at], float(p.sum())
        energy = dot(weight, 0.5 * u.ravel()[at] - problem.heights.ravel()[at])
        # In the memory of the dimensionless heights, whose last use this is.
        displacement = np.multiply(u, problem.length, out=problem.heights)
        count = fine.applications()
        coarse = sum(g.applications() for g in self.grids[1:])
        coarse += sum(g.two_level.applications() for g in self.grids if g.two_level is not None)
        vectors = at.size * (5 * 4 + 3 * np.dtype(np.intp).itemsize)
        held = bytes_of(self.grids) + problem.heights.nbytes + 2 * p.nbytes + vectors
        padded = p.nbytes * (1 if self.periodic is True else 2 if self.periodic else 4)
        carried = problem.load is None or abs(total - problem.load) <= 1e-9 * problem.load
        return Solution(
            pressure=p * problem.pressure,
            displacement=displacement,
            rigid_approach=outcome.approach * problem.length - problem.datum,
            converged=bool(outcome.relative <= rtol and carried),
            kkt=outcome.relative,
            certificate=outcome.certificate,
            energy=(energy - offset * total) * unit,
            n_applications=count,
            n_ffts=2 * count,
            n_coarse=coarse,
            n_outer=outcome.steps,
            history=outcome.history,
            seconds=time.perf_counter() - begun,
            fallback=fallback,
            is_stalled=outcome.is_stalled and not outcome.relative <= rtol,
            memory_arrays=held / padded,
        )
