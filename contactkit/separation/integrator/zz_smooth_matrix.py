"""The matrix of the stages of `smooth_step`, and its inverse on the eigenvectors of the method.

The equations of the stages, linear about the start, have the matrix x + y A + z A^2 with the A of
the method and three numbers x, y and z. Its eigenvectors are those of A, which never change.
"""

from __future__ import annotations

from typing import Any

from .radau import NODES
from .radau_short import GAMMA0, MATRIX

__all__ = ["Matrix", "Problem", "Stages", "Three", "inverse", "moved", "moved_by_powers", "still"]

Three = tuple[float, float, float]
Matrix = tuple[float, float, float, float, float]
Stages = tuple[Three, Three, Three, Three]
"""Rates, coordinates, shares by which the gap grows, and speeds over the gap."""

Problem = tuple[
    float, float, float, float, float, float, float, float, float, float, float, float, Any
]
"""Numbers, by their place:

0 mass times gap; 1 rate of the start; 2 length of the step; 3 s; 4 slope of the viscous force
over the rate; 5 that over the coordinate; 6 viscous force and 7 net force without it, at the
start; 8 rate of the pull; 9 slope of spring and static force over the share of the gap; 10 half
the second derivative of that force; 11 n if the viscous force falls, as s is that of the gap;
12 limit that acts, with its force and the gap
"""

_C1, _C2, _ = NODES
(_A11, _A12, _A13), (_A21, _A22, _A23), (_A31, _A32, _A33) = MATRIX

# A has a real eigenvalue and a pair; each has a projection, a column times a row.
_REAL = 1.0 / GAMMA0
_PART = 0.5 * (0.6 - _REAL)
_PAIR = complex(_PART, (1.0 / (60.0 * _REAL) - _PART * _PART) ** 0.5)
_PAIR_X, _PAIR_Y = _PAIR.real, _PAIR.imag
_PAIR2_X, _PAIR2_Y = (_PAIR * _PAIR).real, (_PAIR * _PAIR).imag


def _projection(one: complex, a: complex, b: complex) -> tuple[list[complex], list[complex]]:
    """Column and row whose product projects on the eigenvector of `one` of three eigenvalues."""
    left, right = (
        [[MATRIX[i][j] - (other if i == j else 0.0) for j in range(3)] for i in range(3)]
        for other in (a, b)
    )
    scale = (one - a) * (one - b)
    found = [
        [sum(left[i][k] * right[k][j] for k in range(3)) / scale for j in range(3)]
        for i in range(3)
    ]
    return [line[2] / found[2][2] for line in found], found[2]


_column, _row = _projection(_REAL, _PAIR, _PAIR.conjugate())
_U1, _U2, _ = (part.real for part in _column)
_W1, _W2, _W3 = (part.real for part in _row)
_column, _row = _projection(_PAIR, _REAL, _PAIR.conjugate())
_P1, _P2, _ = (part.real for part in _column)
_Q1, _Q2, _ = (part.imag for part in _column)
_X1, _X2, _X3 = (2.0 * part.real for part in _row)  # twice: for the other one of the pair
_Y1, _Y2, _Y3 = (2.0 * part.imag for part in _row)


def _powers(row: Three) -> Three:
    """A row times the first three powers of the nodes."""
    one, two, three = (
        sum(part * node**n for part, node in zip(row, NODES, strict=True)) for n in (1, 2, 3)
    )
    return one, two, three


_W_1, _W_2, _W_3 = _powers((_W1, _W2, _W3))
_X_1, _X_2, _X_3 = _powers((_X1, _X2, _X3))
_Y_1, _Y_2, _Y_3 = _powers((_Y1, _Y2, _Y3))


def still(problem: Problem) -> Stages:
    """Stages at the rate of the start."""
    _, r, dt, s, *_ = problem
    q1, q2, q3, power = _C1 * dt * r, _C2 * dt * r, dt * r, -1.0 / s
    b1, b2, b3 = 1.0 - s * q1, 1.0 - s * q2, 1.0 - s * q3
    e1, e2, e3 = b1**power, b2**power, b3**power
    shares = e1 - 1.0, e2 - 1.0, e3 - 1.0
    return (r, r, r), (q1, q2, q3), shares, (r * e1 / b1, r * e2 / b2, r * e3 / b3)


def inverse(problem: Problem) -> Matrix:
    """Inverse of the matrix of the stages on the eigenvectors of A, its size, and its changes.

    The last is what a round leaves of what was left before it, over the change of the gap.
    """
    inertia, r0, dt, s, drag, swing, _, _, _, stiff, half, n, _ = problem
    g = (1.0 + s) * inertia
    y, z = dt * (g * r0 + drag), dt * dt * (stiff + swing)
    a = inertia + y * _PAIR_X + z * _PAIR2_X
    b = y * _PAIR_Y + z * _PAIR2_Y
    size, weight = a * a + b * b, inertia + _REAL * y
    change = dt * dt * ((1.0 + s) * abs(stiff) + 2.0 * abs(half))
    curved = 2.0 * (g + change + n * dt * drag * (1.0 + abs(r0 * dt))) / weight
    return 1.0 / (weight + z * _REAL * _REAL), a / size, b / size, weight, curved


def moved_by_powers(problem: Problem, matrix: Matrix, rate: float, left: Three) -> Stages | None:
    """Do as `moved` from one rate [1/s], where what is left [N.s] is a polynomial of the node.

    `left` has the coefficients of its first three powers.
    """
    a, b, c = left
    return _turned(
        problem, matrix, (rate, rate, rate), a * _W_1 + b * _W_2 + c * _W_3,
        a * _X_1 + b * _X_2 + c * _X_3, a * _Y_1 + b * _Y_2 + c * _Y_3,
    )  # fmt: skip


def moved(problem: Problem, matrix: Matrix, rates: Three, left: Three) -> Stages | None:
    """Stages after a round of Newton's from rates [1/s] with so much left of the momentum [N.s].

    None if the gap changes by more than the coordinate can say.
    """
    a, b, c = left
    return _turned(
        problem, matrix, rates, _W1 * a + _W2 * b + _W3 * c,
        _X1 * a + _X2 * b + _X3 * c, _Y1 * a + _Y2 * b + _Y3 * c,
    )  # fmt: skip


def _turned(
    problem: Problem, matrix: Matrix, rates: Three, w: float, x: float, y: float
) -> Stages | None:
    """Stages after a round whose momentum left over, on the eigenvectors, is w and x + iy."""
    dt, s = problem[2:4]
    (one, a, b, _, _), (r1, r2, r3) = matrix, rates
    w, x, y = one * w, a * x + b * y, a * y - b * x
    r1, r2, r3 = r1 - (_U1 * w + _P1 * x - _Q1 * y), r2 - (_U2 * w + _P2 * x - _Q2 * y), r3 - w - x
    q1 = dt * (_A11 * r1 + _A12 * r2 + _A13 * r3)
    q2 = dt * (_A21 * r1 + _A22 * r2 + _A23 * r3)
    q3 = dt * (_A31 * r1 + _A32 * r2 + _A33 * r3)
    if not (-0.9 < s * q1 < 0.9 and -0.9 < s * q2 < 0.9 and -0.9 < s * q3 < 0.9):
        return None
    if s == -1.0:  # the coordinate is the gap
        return (r1, r2, r3), (q1, q2, q3), (q1, q2, q3), (r1, r2, r3)
    b1, b2, b3, power = 1.0 - s * q1, 1.0 - s * q2, 1.0 - s * q3, -1.0 / s
    e1, e2, e3 = b1**power, b2**power, b3**power
    shares = e1 - 1.0, e2 - 1.0, e3 - 1.0
    return (r1, r2, r3), (q1, q2, q3), shares, (r1 * e1 / b1, r2 * e2 / b2, r3 * e3 / b3)
