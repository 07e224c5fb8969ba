"""Columns of a run, read at the positions of an instrument: through a spring, along a branch."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from ..errors import DescriptionError
from .data import MeasuredCurve
from .outcomes import Outcome, branch_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["ReadOff", "read_off"]

# Part of the range of a run beyond its ends that counts as its end: round-off of units.
_ROUND_OFF = 1e-9


class ReadOff(NamedTuple):
    """A column at positions (n,), its slopes over them, and which of them lie beyond the run."""

    values: Floats
    slopes: Floats
    is_held: NDArray[np.bool_]


def read_off(outcome: Outcome, curve: MeasuredCurve, x: Floats, stiffness: float) -> ReadOff:
    """Column of a run at the positions of the drive, which a spring connects with the body.

    Raises
    ------
    DescriptionError
        If what is compared is no column, or positions lie beyond the run.
    """
    return _read_off(*_columns(outcome, curve), x, stiffness, curve)


def _columns(outcome: Outcome, curve: MeasuredCurve) -> tuple[Floats, Floats]:
    axis, column = outcome.found[curve.over], outcome.found[curve.quantity]
    if isinstance(axis, float) or isinstance(column, float) or axis.shape != column.shape:
        one = curve.over if isinstance(axis, float) else curve.quantity
        hint = "numbers of a result are compared over a field of the scene, by its path"
        raise DescriptionError("curve", one, "be a column of the result", hint=hint)
    part = branch_of(axis, curve.branch, curve.over)
    return axis[part], column[part]


def _read_off(
    axis: Floats, column: Floats, x: Floats, stiffness: float, curve: MeasuredCurve
) -> ReadOff:
    at = axis + column / stiffness
    rises = axis[-1] >= axis[0]
    at = at if rises else -at
    wanted = x if rises else -x
    # States behind the furthest so far are not stable: the spring jumps over them.
    reached = np.maximum.accumulate(at)
    stays = np.concatenate([[True], at[1:] > reached[:-1]])
    before = np.concatenate([stays[1:] & ~stays[:-1], [False]]) & ~stays  # last one before a jump
    at, column = _jumped(at, column, stays, before)
    low, high = float(at[0]), float(at[-1])
    margin = _ROUND_OFF * max(high - low, abs(high), abs(low))
    outside = (wanted < low - margin) | (wanted > high + margin)
    if outside.any() and curve.beyond == "refuse":
        sign = 1.0 if rises else -1.0
        data = f"{x.min():.6g} to {x.max():.6g}"
        ends = sorted((sign * low, sign * high))
        raise DescriptionError(
            f"MeasuredCurve({curve.name}).at",
            data,
            f"lie within the run, whose {curve.over} goes from {ends[0]:.6g} to {ends[1]:.6g}",
            hint="let the loading go further on both sides, by the range of shift as well; or "
            "beyond='hold'",
        )
    values, slopes = _interpolated(at, column, np.clip(wanted, low, high))
    slopes[outside] = 0.0
    return ReadOff(values, slopes if rises else -slopes, outside)


def _jumped(
    at: Floats, column: Floats, stays: NDArray[np.bool_], before: NDArray[np.bool_]
) -> tuple[Floats, Floats]:
    """Stable states, with a second point at the position of each jump."""
    if stays.all():
        return at, column
    landed = np.flatnonzero(stays[1:] & ~stays[:-1]) + 1
    left = [int(np.flatnonzero(stays[:i])[-1]) for i in landed]
    values = column.copy()
    position = at.copy()
    for i, j in zip(landed, left, strict=True):
        # The state where the branch beyond reaches the position of the jump.
        part = (at[j] - at[i - 1]) / (at[i] - at[i - 1])
        values[i - 1] = column[i - 1] + part * (column[i] - column[i - 1])
        position[i - 1] = at[j]
    kept = stays | before
    return position[kept], values[kept]


def _interpolated(at: Floats, column: Floats, wanted: Floats) -> tuple[Floats, Floats]:
    """Monotone cubic through the points of each piece between jumps, and its slopes.

    It has no overshoot at a kink.
    """
    breaks = np.flatnonzero(np.diff(at) <= 0.0) + 1
    found, slopes = np.empty_like(wanted), np.zeros_like(wanted)
    starts, ends = [0, *breaks], [*breaks, at.size]
    piece = (
        np.searchsorted(at[breaks], wanted, side="right")
        if len(breaks)
        else np.zeros(wanted.size, dtype=int)
    )
    for k, (first, end) in enumerate(zip(starts, ends, strict=True)):
        mine = piece == k
        if not mine.any():
            continue
        xs, ys = at[first:end], column[first:end]
        inside = np.clip(wanted[mine], xs[0], xs[-1])
        if xs.size == 1:
            found[mine] = ys[0]
            continue
        line = PchipInterpolator(xs, ys)
        found[mine], slopes[mine] = line(inside), line(inside, 1)
    return found, slopes
