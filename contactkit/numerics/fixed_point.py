"""Fixed points of expensive maps: one iteration, accelerated, evaluated no better than needed.

The unknown is a tuple of arrays, its blocks. A map that takes a solve of its own is evaluated to a
tolerance: loosely while the blocks still change much, exactly at the end.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Blocks = tuple[NDArray[np.float64], ...]

__all__ = ["Accelerator", "Anderson", "Evaluation", "FixedPoint", "Momentum", "Plain", "settle"]

# Measured over 16 contacts with hardness, coupling of friction and adhesion (1,824 applications of
# the operator in 213 contacts); where a count is given, the number was varied. The other four are
# guards.
#
# Of the change of the unknown, the change that the error of the next evaluation may cause. Tighter
# solves digits that change again (0.03: 7 % more applications, 2 % fewer contacts); looser lets
# errors steer the acceleration (0.3: 7 % more contacts, a steep local hardness takes a third more).
_INNER = 0.1
# A map may enlarge the errors of its evaluation, as stiff films do: then the change swings instead
# of falling. After `_PATIENCE` evaluations without a smaller change the ratio falls by `_TIGHTER`.
# Two tighten too early (Dugdale's law 14 % more); fifteen change nothing but the hardest films.
_PATIENCE = 5
# The factor by which the ratio falls guards against a map that would take many such falls, and the
# least ratio against solves ever tighter of a map that does not contract at all.
_TIGHTER = 0.3
_LEAST_INNER = 1e-3
# Contraction expected of the first step: it decides when an evaluation is made exact in the hope
# that it is the last. It changes no count.
_CONTRACTION = 0.1
# Contraction relied on at most: it guards against an exact evaluation far from the end, after two
# changes of which the second happened to be small.
_FASTEST = 1e-3
# Estimates, of which the smallest counts, of the part of the error that an iteration removes: they
# guard the stated error of slow iterations, next to jumps.
_MEMORY = 5
# Smallest of those that counts: it guards against a tolerance of nothing, which no change meets,
# where an image runs ahead of its unknown.
_SLOWEST = 1e-3


class Evaluation(NamedTuple):
    """Images of the blocks of an unknown, and how good they are.

    `changes` are the distances of images and blocks over their scales [-], `scales` those scales.
    A change below `floor` is that of an evaluation that cannot be any better. `is_exact`: evaluated
    to the tolerance of the answer; `is_failed`: not evaluated at all, the iteration ends.
    """

    images: Blocks
    changes: tuple[float, ...]
    scales: tuple[float, ...]
    floor: float = 0.0
    is_exact: bool = True
    is_failed: bool = False


class FixedPoint(NamedTuple):
    """Blocks of the last evaluation, and whether they agree with their images.

    `changes` are the last distances over the scales [-], `n_evaluations` their number.
    """

    values: Blocks
    changes: tuple[float, ...]
    is_settled: bool
    n_evaluations: int


class Accelerator(Protocol):
    """Choice of the next blocks from those evaluated so far."""

    def next(self, values: Blocks, images: Blocks, scales: tuple[float, ...]) -> Blocks:
        """Return the blocks to evaluate next."""
        ...


class Plain:
    """Images become the next blocks: slow, and monotonic where the map is."""

    def next(self, values: Blocks, images: Blocks, scales: tuple[float, ...]) -> Blocks:
        """See `Accelerator.next`."""
        return images


class Anderson:
    """Blocks at which the last evaluations, were the map linear, would agree best with images.

    Evaluations before a residual that has grown are dropped, as the map was another one there.

    References
    ----------
    D. G. Anderson, J. ACM 12 (1965) 547; H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715.
    """

    # With a memory of two, secants, a friction coupling of 3 does not settle; three take 4 % more
    # applications, six 3 % fewer and four maps more. The growth decides nothing from 1.2 to 5.
    def __init__(self, memory: int = 4, growth: float = 2.0) -> None:
        self._memory, self._growth = memory, growth
        self._history: list[tuple[Blocks, Blocks]] = []
        self._last = math.inf

    def next(self, values: Blocks, images: Blocks, scales: tuple[float, ...]) -> Blocks:
        """See `Accelerator.next`."""
        missed = tuple(one - other for one, other in zip(images, values, strict=True))
        size = max(
            float(np.abs(one).max(initial=0.0)) / scale
            for one, scale in zip(missed, scales, strict=True)
        )
        kept = self._history[1 - self._memory :] if size < self._growth * self._last else []
        self._history, self._last = [*kept, (missed, images)], size
        turned = [
            tuple(now - then for now, then in zip(missed, one, strict=True)) for one, _ in kept
        ]
        if not turned:
            return images
        gram = np.array([[_product(a, b, scales) for b in turned] for a in turned])
        right = np.array([_product(a, missed, scales) for a in turned])
        shares = np.linalg.lstsq(gram, right, rcond=1e-10)[0]
        made = tuple(one.copy() for one in images)
        for share, (_, others) in zip(shares, kept, strict=True):
            for block, image, other in zip(made, images, others, strict=True):
                block -= share * (image - other)
        return made


class Momentum:
    """Steps that carry on in their direction, and start afresh whenever the iterates turn round.

    For maps that are monotonic, whose iterates only rise or only fall: they stay on the side of the
    fixed point that they come from, which an extrapolation by Anderson's method may leave.

    References
    ----------
    Y. Nesterov, Soviet Math. Dokl. 27 (1983) 372; B. O'Donoghue, E. Candes, Found. Comput. Math. 15
    (2015) 715 (restarts).
    """

    def __init__(self) -> None:
        self._before: Blocks | None = None
        self._age = 0

    def next(self, values: Blocks, images: Blocks, scales: tuple[float, ...]) -> Blocks:
        """See `Accelerator.next`."""
        before = values if self._before is None else self._before
        missed = tuple(one - other for one, other in zip(images, values, strict=True))
        step = tuple(one - other for one, other in zip(images, before, strict=True))
        self._age = 0 if _product(missed, step, scales) <= 0.0 else self._age + 1
        self._before = images
        ahead = max(self._age - 1, 0) / (self._age + 2.0)
        return tuple(one + ahead * by for one, by in zip(images, step, strict=True))


class _Forcing:
    """Change that the error of the next evaluation may cause: of a map that must contract."""

    def __init__(self) -> None:
        self._inner = _INNER
        self._least, self._age, self._last = math.inf, 0, math.inf

    def allowed(self, change: float, tolerance: float) -> float:
        """Return it after a change; zero where the next is expected to be within a tolerance."""
        self._age = 0 if change < self._least else self._age + 1
        self._least = min(change, self._least)
        if self._age >= _PATIENCE:
            self._inner, self._age = max(_TIGHTER * self._inner, _LEAST_INNER), 0
        known = math.isfinite(self._last) and self._last > 0.0
        contraction = min(max(change / self._last, _FASTEST), 1.0) if known else _CONTRACTION
        self._last = change
        return 0.0 if contraction * change <= tolerance else self._inner * change


class _Rate:
    """Part of the error that an iteration removes at least, from pairs of evaluations."""

    def __init__(self) -> None:
        self._last: tuple[Blocks, Blocks] | None = None
        self._rates: list[float] = []

    def after(self, values: Blocks, images: Blocks, scales: tuple[float, ...]) -> float:
        """Return the smallest of the last estimates; 1 before there is any."""
        missed = tuple(one - other for one, other in zip(images, values, strict=True))
        if self._last is not None:
            before, missed_before = self._last
            step = tuple(one - other for one, other in zip(values, before, strict=True))
            turned = tuple(one - other for one, other in zip(missed, missed_before, strict=True))
            square = _product(step, step, scales)
            found = -_product(step, turned, scales) / square if square > 0.0 else 1.0
            self._rates = [*self._rates[1 - _MEMORY :], min(max(found, _SLOWEST), 1.0)]
        self._last = values, missed
        return min(self._rates, default=1.0)


def _product(one: Blocks, other: Blocks, scales: tuple[float, ...]) -> float:
    """Scalar product of blocks, each over its scale."""
    parts = zip(one, other, scales, strict=True)
    return sum(float(np.vdot(a, b)) / scale**2 for a, b, scale in parts)


def settle(
    evaluate: Callable[[Blocks, float], Evaluation],
    start: Blocks,
    accelerators: tuple[tuple[slice, Accelerator], ...],
    tolerance: float,
    *,
    admit: Callable[[Blocks, Blocks], Blocks] = lambda blocks, images: blocks,
    max_iterations: int = 60,
) -> FixedPoint:
    """Find blocks that agree with their images.

    Parameters
    ----------
    evaluate : callable
        ``evaluate(blocks, allowed)`` gives their images, with an error that changes them by
        `allowed` of their scales at most [-]; infinite for the first, zero for an exact evaluation.
    start : tuple of ndarray
        First blocks.
    accelerators : tuple of (slice, Accelerator)
        Which blocks are accelerated together, and how.
    tolerance : float
        Error of the blocks over their scales [-]: the last change, over the part of the error that
        an iteration removes.
    admit : callable, optional
        ``admit(blocks, images)`` moves accelerated blocks to where the map is defined.
    max_iterations : int
        Maximum number of evaluations.

    Examples
    --------
    >>> def cosine(blocks, allowed):
    ...     image = np.cos(blocks[0])
    ...     return Evaluation((image,), (float(abs(image - blocks[0])[0]),), (1.0,))
    >>> found = settle(cosine, (np.ones(1),), ((slice(None), Anderson()),), 1e-12)
    >>> round(float(found.values[0][0]), 10), found.n_evaluations < 12
    (0.7390851332, True)
    """
    values, allowed = start, math.inf
    forcing, rate = _Forcing(), _Rate()
    for n in range(1, max_iterations + 1):
        found = evaluate(values, 0.0 if n == max_iterations else allowed)
        change = max(found.changes, default=0.0)
        # What agrees has no direction to learn from, and its scale may be that of nothing at all.
        is_same = change == 0.0
        slowest = 1.0 if is_same else rate.after(values, found.images, found.scales)
        is_settled = change <= max(tolerance * slowest, min(found.floor, tolerance))
        if found.is_failed or (is_settled and found.is_exact) or n == max_iterations:
            return FixedPoint(values, found.changes, is_settled and not found.is_failed, n)
        allowed = 0.0 if is_settled else forcing.allowed(change, tolerance * slowest)
        if is_same:
            values = found.images
            continue
        taken: Blocks = ()
        for where, accelerator in accelerators:
            taken += accelerator.next(values[where], found.images[where], found.scales[where])
        values = admit(taken, found.images)
    raise ValueError("max_iterations must be positive")
