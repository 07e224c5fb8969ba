r"""Film under a sphere between bodies that deform, without a rim, by Galerkin's method.

The second method of the pages on films between bodies that deform; it shares no code with
contactkit. In units in which R, E* and the viscosity are 1 the pressure is
:math:`p = \sum_j c_j f_j`, with :math:`f_j = s^4 P_j(2 s - 1)`, :math:`s = (1 + r^2/l^2)^{-1/2}`
and P_j those of Legendre: functions that fall off as the pressure of a rigid sphere does, to all
orders. The film obeys

.. math::
    M \dot c + K(h)\,c + b \dot z = 0, \qquad
    M_{ij} = \frac{4}{\pi} \int_0^\infty g_i g_j\,dt, \qquad
    K_{ij} = \frac{1}{12} \int h^3 f_i' f_j' r\,dr, \qquad b_i = \int f_i r\,dr

where :math:`g_j(t) = \int_0^\infty f_j(\sqrt{t^2 + y^2})\,dy` is Abel's transform: half-spaces are
displaced by :math:`w = (4/\pi) \int_0^r g\,dt/\sqrt{r^2 - t^2}` (Copson 1947). All integrands but
those of h^3 are polynomials of a cosine. Layers on a rigid base add the difference of their
compliance to that of half-spaces, by Hankel's transform. Motions take the steps of third order of
Alexander (1977), each short enough that no gap changes by more than `change` of itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.special import j0

Array = NDArray[np.float64]

# Alexander's method with three stages: its diagonal is the root of a cubic.
_D = 0.43586652150845906
_STAGES = np.array(
    [
        [_D, 0.0, 0.0],
        [0.5 * (1.0 - _D), _D, 0.0],
        [-1.5 * _D**2 + 4.0 * _D - 0.25, 1.5 * _D**2 - 5.0 * _D + 1.25, _D],
    ]
)


def _points(n: int, low: float, high: float) -> tuple[Array, Array]:
    x, weights = legendre.leggauss(n)
    return low + 0.5 * (high - low) * (x + 1.0), 0.5 * (high - low) * weights


def _panels(n: int, edges: Array) -> tuple[Array, Array]:
    both = [_points(n, a, b) for a, b in pairwise(edges)]
    return np.concatenate([x for x, _ in both]), np.concatenate([w for _, w in both])


def _functions(n: int, s: Array) -> Array:
    """f_j at s, a row for each j."""
    return s**4 * legendre.legvander(2.0 * s - 1.0, n - 1).T


def _slopes(n: int, s: Array) -> Array:
    """df_j/ds."""
    values = legendre.legvander(2.0 * s - 1.0, n - 1).T
    by = np.zeros_like(values)
    for j in range(1, n):
        by[j] = (2 * j - 1) * values[j - 1] + (by[j - 2] if j > 1 else 0.0)
    found: Array = 4.0 * s**3 * values + 2.0 * s**4 * by
    return found


def _abel(n: int, s: Array) -> Array:
    """g_j over l where 1 + t^2/l^2 = s^-2."""
    angle, weights = _points(n + 10, 0.0, 0.5 * math.pi)
    c = np.cos(angle)
    values = _functions(n, np.multiply.outer(s, c).ravel()).reshape(n, len(s), len(c))
    found: Array = values @ (weights / c**2) / s
    return found


def bonded(ratio: float) -> Callable[[Array], Array]:
    """Compliance of a layer bonded to a rigid base over that of a half-space, of q t."""
    k = 3.0 - 4.0 * ratio

    def found(z: Array) -> Array:
        e = np.exp(-2.0 * z)
        top = k * (1.0 - e**2) - 4.0 * z * e
        answer: Array = top / (k * (1.0 + e**2) + (4.0 * z**2 + 1.0 + k * k) * e)
        return answer

    return found


class Motion(NamedTuple):
    """Rigid gap, its rate, thrust of the film over time; gaps at the radii of the film, in rows."""

    time: Array
    gap: Array
    speed: Array
    thrust: Array
    gaps: Array


class UnboundedFilm:
    """Film under a sphere; lengths over R, pressures over E*.

    Parameters
    ----------
    n : int
        Functions.
    length : float
        Of the functions: that of the pressure of a rigid sphere is ``sqrt(2 h)``.
    layer : (callable, float), optional
        Compliance over that of a half-space, and thickness.
    n_points : int
        Of the integrals over the film.
    """

    def __init__(
        self,
        n: int,
        length: float,
        layer: tuple[Callable[[Array], Array], float] | None = None,
        n_points: int = 240,
    ) -> None:
        self.n, self.length, self.layer = n, length, layer
        s, weights = _points(n_points, 0.0, 1.0)
        self.s, self.radius = s, length * np.sqrt(s**-2 - 1.0)
        area = length**2 * weights / s**3
        self.b = _functions(n, s) @ area
        self.slopes = _slopes(n, s) * (-self.radius / length**2 * s**3) * np.sqrt(area)
        angle, weights = _points(4 * n + 16, 0.0, 0.5 * math.pi)
        g = _abel(n, np.cos(angle))
        self.matrix = 4.0 / math.pi * length**3 * (g * (weights / np.cos(angle) ** 2)) @ g.T
        self._moments = self._of_layer() if layer else None
        if self._moments is not None:
            _, weighted, moments = self._moments
            self.matrix += (moments * weighted) @ moments.T

    def _of_layer(self) -> tuple[Array, Array, Array]:
        """Wavenumbers, weights of the difference of compliances, Hankel's transforms of f_j."""
        assert self.layer is not None
        compliance, thickness = self.layer
        highest = 18.0 / thickness  # where half-space and layer differ by 1e-14
        q, weights = _panels(12, np.append(0.0, np.geomspace(1e-5, 1.0, 30)) * highest)
        near, far = 40.0 * self.length, 3000.0 * self.length
        edges = np.linspace(0.0, near, 400 + int(near * highest / 6.0))
        t, steps = _panels(12, np.append(edges, np.geomspace(near, far, 200)[1:]))
        g = _abel(self.n, 1.0 / np.hypot(1.0, t / self.length)) * self.length * steps
        moments = 2.0 / math.pi * np.array([g @ np.cos(one * t) for one in q]).T
        return q, 2.0 * weights * (compliance(q * thickness) - 1.0), moments

    def displacements(self) -> Array:
        """Displacement at the radii by each function, in rows."""
        found = np.empty((self.n, len(self.s)))
        y, weights = _points(80, 0.0, 1.0)
        for i, s in enumerate(self.s):
            most = math.asinh(0.5 * math.pi / s)
            angle = s * np.sinh(most * y)
            by = most * weights * s * np.cosh(most * y)
            at = np.hypot(np.sin(angle), s * np.cos(angle))
            found[:, i] = 4.0 / math.pi * self.length * s * (_abel(self.n, at) / at**2) @ by
        if self._moments is not None:
            q, weighted, moments = self._moments
            found += (moments * weighted) @ j0(np.multiply.outer(q, self.radius))
        return found

    def modulus(self, gap: float, frequency: float) -> complex:
        """G' + i G'' over E* R, of eta omega/E*."""
        h = gap + 0.5 * self.radius**2
        flow = (self.slopes * (h**3 / 12.0)) @ self.slopes.T
        c = np.linalg.solve(flow + 1j * frequency * self.matrix, -1j * frequency * self.b)
        return complex(-2.0 * math.pi * self.b @ c)

    def move(
        self,
        gap: float,
        speed: float,
        end: float,
        *,
        mass: float = math.inf,
        change: float = 0.05,
        until: Callable[[float, float], bool] = lambda *_: False,
    ) -> Motion:
        """Motion from rest of the film, at a speed or of a mass that starts with it.

        Parameters
        ----------
        gap, speed, end : float
            Rigid gap and its rate at the start, and the last time, over R, E*/eta and eta/E*.
        mass : float
            Over eta^2 R/E*; inf: the speed is imposed.
        change : float
            Of a gap over itself in a step.
        until : callable
            Of the rigid gap and its rate: whether to end.
        """
        steps = _Steps(self, mass)
        now = np.concatenate([np.zeros(self.n), [gap, speed]])
        time, length = 0.0, 1e-5 * end
        rows, gaps = [(time, gap, speed, 0.0)], [steps.gap(now)]
        while time < end * (1.0 - 1e-12):
            length = min(length, end - time)
            found = steps.take(now, length)
            moved = math.inf
            if found is not None:
                moved = float(np.abs(steps.gap(found) / gaps[-1] - 1.0).max())
            if found is None or moved > 2.0 * change:
                length *= 0.4
                continue
            time, now = time + length, found
            rows.append((time, *now[self.n :], float(steps.thrust @ now[: self.n])))
            gaps.append(steps.gap(now))
            if until(*now[self.n :]):
                break
            length *= min(1.5, max(0.5, 0.8 * change / max(moved, 1e-12)))
        t, z, speeds, thrusts = np.array(rows).T
        return Motion(t, z, speeds, thrusts, np.array(gaps))


class _Steps:
    """Rows A y' = r(y) of the unknowns c, z and z', and a step of them."""

    def __init__(self, film: UnboundedFilm, mass: float) -> None:
        n = film.n
        self.n, self.slopes = n, film.slopes
        self.shape, self.displaced = 0.5 * film.radius**2, film.displacements()
        self.thrust, self.is_free = 2.0 * math.pi * film.b, math.isfinite(mass)
        self.left: Array = np.zeros((n + 2, n + 2))
        self.left[:n, :n], self.left[:n, n] = film.matrix, film.b
        self.left[n, n], self.left[n + 1, n + 1] = 1.0, mass if self.is_free else 1.0

    def gap(self, now: Array) -> Array:
        found: Array = now[self.n] + self.shape + now[: self.n] @ self.displaced
        return found

    def rate(self, now: Array) -> tuple[Array, Array]:
        n, h = self.n, self.gap(now)
        slope = now[:n] @ self.slopes
        flow, by = h**3 / 12.0, self.slopes * (0.25 * h**2 * slope)
        value, jacobian = np.zeros(n + 2), np.zeros((n + 2, n + 2))
        value[:n], value[n] = -self.slopes @ (flow * slope), now[n + 1]
        jacobian[:n, :n] = -(self.slopes * flow) @ self.slopes.T - by @ self.displaced.T
        jacobian[:n, n], jacobian[n, n + 1] = -by.sum(axis=1), 1.0
        if self.is_free:
            value[n + 1], jacobian[n + 1, :n] = self.thrust @ now[:n], self.thrust
        return value, jacobian

    def take(self, start: Array, length: float) -> Array | None:
        """End of a step; None if a gap closes or Newton's method does not converge."""
        now, rates = start.copy(), list[Array]()
        for row, diagonal in zip(_STAGES, np.diag(_STAGES), strict=True):
            known = self.left @ start
            for weight, rate in zip(row, rates, strict=False):
                known = known + length * weight * rate
            found = self._stage(now, known, length * diagonal)
            if found is None:
                return None
            now = found
            rates.append(self.rate(now)[0])
        return now

    def _stage(self, now: Array, known: Array, length: float) -> Array | None:
        for _ in range(12):
            if self.gap(now).min() <= 0.0:
                return None
            value, jacobian = self.rate(now)
            right = known + length * value - self.left @ now
            moved: Any = np.linalg.solve(self.left - length * jacobian, right)
            now = now + moved
            if np.abs(moved).max() < 1e-9 * np.abs(now).max():
                return now if self.gap(now).min() > 0.0 else None
        return None
