r"""Rupture history of a film: the gap at which the edge of the cavity passed each radius.

Nothing flows within a cavity between faces that move apart, so that the liquid there stays what it
was when the edge passed: :math:`\theta h = h_b(y)`, with :math:`y = r^2`. The void up to an edge is

.. math:: W = \pi \int_0^y (h - h_b) \, dy' = \pi y h - M(y)

While the edge recedes each step of time adds a piece, in which y and h_b are cubics of a parameter
from 0 to 1: over y alone h_b would have a square root where the edge turns. Plain floats only.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

__all__ = [
    "Edge",
    "RuptureHistory",
    "cut",
    "edge_of",
    "grown",
    "piece_at",
    "outermost",
    "piece_along",
    "liquid_within",
    "void_within",
]

Piece = tuple[float, ...]
"""Coefficients of y (4, [m2]) and of h_b (4, [m]) in the parameter, and M at its start [m3]."""
RuptureHistory = tuple[Piece, ...]
"""Pieces from the centre outwards."""

# Pieces that are kept. Of an edge that receded in 400 steps over a gap that swung, its square is
# off by 6e-6 of that of the rim with 64, by 1e-4 with 32 and 1e-7 with 128; each step copies them
# all, and the C kernel reserves room for as many.
_MOST = 64


class Edge(NamedTuple):
    """Edge of a cavity: the square of its radius [m2], and the gap at which it was there [m]."""

    square: float
    rupture_gap: float


def piece_at(square: float, gap: float) -> Piece:
    """Piece from the centre to an edge, where the film ruptured at once at one gap [m]."""
    return (0.0, square, 0.0, 0.0, gap, 0.0, 0.0, 0.0, 0.0)


def piece_along(before: float, squares: Sequence[float], gaps: Sequence[float]) -> Piece:
    """Piece through the start of a step and its three stages.

    Parameters
    ----------
    before : float
        Liquid within the edge at the start, M [m3].
    squares, gaps : sequence of 4 floats
        Square of the radius of the edge [m2], and the gap [m], at the parameters of `NODES`.
    """
    return (*_cubic(squares), *_cubic(gaps), before)


_R6 = math.sqrt(6.0)
_NODES = (0.0, (4.0 - _R6) / 10.0, (4.0 + _R6) / 10.0, 1.0)


def _cubic(f: Sequence[float]) -> tuple[float, float, float, float]:
    """Coefficients of the cubic through values at the start of a step and its stages."""
    x = _NODES
    d1 = [(f[i + 1] - f[i]) / (x[i + 1] - x[i]) for i in range(3)]
    d2 = [(d1[i + 1] - d1[i]) / (x[i + 2] - x[i]) for i in range(2)]
    d = (d2[1] - d2[0]) / x[3]
    c = d2[0] - d * (x[0] + x[1] + x[2])
    return f[0], d1[0] - d2[0] * x[1] + d * x[1] * x[2], c, d


def _square(piece: Piece, t: float) -> float:
    return piece[0] + t * (piece[1] + t * (piece[2] + t * piece[3]))


def _gap(piece: Piece, t: float) -> float:
    return piece[4] + t * (piece[5] + t * (piece[6] + t * piece[7]))


def _rate(piece: Piece, t: float) -> float:
    return piece[1] + t * (2.0 * piece[2] + 3.0 * t * piece[3])


def _liquid(piece: Piece, t: float) -> float:
    r"""Liquid M up to a parameter [m3], :math:`\pi \int h_b \, dy`; exact."""
    _, y1, y2, y3, h0, h1, h2, h3, before = piece
    y2, y3 = 2.0 * y2, 3.0 * y3  # of the slope
    total = (h3 * y3) / 6.0
    total = total * t + (h2 * y3 + h3 * y2) / 5.0
    total = total * t + (h1 * y3 + h2 * y2 + h3 * y1) / 4.0
    total = total * t + (h0 * y3 + h1 * y2 + h2 * y1) / 3.0
    total = total * t + (h0 * y2 + h1 * y1) / 2.0
    return before + math.pi * t * (total * t + h0 * y1)


def liquid_within(history: RuptureHistory) -> float:
    """Liquid within the outermost edge that is remembered, M [m3]."""
    return _liquid(history[-1], 1.0) if history else 0.0


def outermost(history: RuptureHistory) -> float:
    """Square of the radius of the outermost edge that is remembered [m2]."""
    return _square(history[-1], 1.0) if history else 0.0


def void_within(history: RuptureHistory, gap: float) -> float:
    """Void within the outermost edge that is remembered [m3], at a gap [m]."""
    return math.pi * gap * _square(history[-1], 1.0) - liquid_within(history)


def edge_of(history: RuptureHistory, gap: float, void: float) -> Edge:
    """Edge of the cavity of a given void [m3] at a gap [m].

    The outermost one that is remembered if the void is not smaller than that holds, as where the
    film has just ruptured; none (0) if there is no void in a gap that has opened since.
    """
    if not history:
        return Edge(0.0, gap)
    if void <= 0.0 < void_within(history, gap):
        return Edge(0.0, history[0][4])
    index, t = _place(history, gap, void)
    piece = history[index]
    return Edge(_square(piece, t), _gap(piece, t))


def _place(history: RuptureHistory, gap: float, void: float) -> tuple[int, float]:
    """Index of the piece in which the edge is, and the parameter there."""
    reach, index, last = math.pi * gap, 0, len(history) - 1
    while index < last:  # by halves: beyond a rupture gap as wide as the present one liquid is back
        middle = (index + last + 1) // 2
        start = history[middle]
        if start[4] < gap and reach * start[0] - start[8] < void:
            index = middle
        else:
            last = middle - 1
    piece = history[index]
    below = reach * piece[0] - piece[8] - void
    above = reach * _square(piece, 1.0) - _liquid(piece, 1.0) - void
    if above <= 0.0:
        return index, 1.0
    if below >= 0.0:
        return index, 0.0
    low, high, t = 0.0, 1.0, below / (below - above)
    for _ in range(60):
        miss = reach * _square(piece, t) - _liquid(piece, t) - void
        low, high = (t, high) if miss < 0.0 else (low, t)
        slope = math.pi * _rate(piece, t) * (gap - _gap(piece, t))
        guess = t - miss / slope if slope > 0.0 else -1.0
        guess = guess if low < guess < high else 0.5 * (low + high)
        if abs(miss) <= 1e-16 * void:
            break
        t, step = guess, guess - t
        if abs(step) <= 1e-12:
            break
    return index, t


def cut(history: RuptureHistory, gap: float, void: float) -> RuptureHistory:
    """Forget the ruptures beyond the edge of a cavity of a given void [m3] at a gap [m]."""
    if not history:
        return ()
    index, t = _place(history, gap, void)
    piece = history[index]
    scales = (1.0, t, t * t, t * t * t)
    shorter = [c * scale for c, scale in zip(piece[:8], scales + scales, strict=True)]
    return (*history[:index], (*shorter, piece[8]))


def grown(history: RuptureHistory, piece: Piece) -> RuptureHistory:
    """History with one more piece; where there are too many, two become one.

    The one that stands for two neighbours has their ends and their liquid, so that no volume is
    lost; they are those over which radius and gap change least.
    """
    history = (*history, piece)
    if len(history) <= _MOST:
        return history
    ends = [(one[0], one[4]) for one in history] + [(_square(piece, 1.0), _gap(piece, 1.0))]

    def lost(i: int) -> float:
        (low, begin), (high, end) = ends[i], ends[i + 2]
        return (high - low) * abs(end - begin)

    index = min(range(len(history) - 1), key=lost)
    first, second = history[index : index + 2]
    return (*history[:index], _joined(first, second), *history[index + 2 :])


def _joined(first: Piece, second: Piece) -> Piece:
    """Piece that stands for two neighbours and holds their liquid, in which y and h_b ascend.

    h_b is straight, and y a cubic that is flat at one end; where that cannot hold the liquid, the
    far end of h_b moves in: a gap beyond that of the rupture would be a void below zero.
    """
    low, high = first[0], _square(second, 1.0)
    begin, end = first[4], _gap(second, 1.0)
    liquid, width = _liquid(second, 1.0) - first[8], high - low
    mean = liquid / (math.pi * width) if width > 0.0 else 0.5 * (begin + end)
    share = (mean - begin) / (end - begin) if end != begin else 0.5
    bend = min(max(4.0 * share - 2.0, -1.0), 1.0)
    if share < 0.25:
        end = begin + 4.0 * (mean - begin)
    elif share > 0.75:
        begin = end - 4.0 * (end - mean)
    along = (1.0 - bend, 0.0, bend) if bend >= 0.0 else (1.0 - 2.0 * bend, 3.0 * bend, -bend)
    return (low, *(width * one for one in along), begin, end - begin, 0.0, 0.0, first[8])
