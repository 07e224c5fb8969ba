r"""Creep of the bodies of a contact: compliance at a rate, over a time step, and its history.

.. math:: \hat u(t) = \hat C_e\, \hat p(t) - \sum_k c_k\, \hat y_k(t), \qquad
          \dot y_k = \dot{\hat p} - y_k/\lambda_k

With C_e at equilibrium and :math:`c_k` the terms of the creep of each wavenumber
(`elasticity.creep_symbol`). Over a step dt in which the pressure is linear the recursion is exact,

.. math:: y_k' = e^{-x} y_k + \varphi\,(\hat p' - \hat p), \qquad
          \varphi = (1 - e^{-x})/x, \quad x = dt/\lambda_k

so that the new displacement is that of an elastic contact of compliance
:math:`C_e - \sum c_k \varphi_k`, on heights less what the history displaces. A step of no duration
has the instantaneous compliance.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy.fft
from attrs import evolve

from ..elasticity.creep_symbol import CommonTimes, common_times
from ..elasticity.prony import CreepSeries, PronySeries, creep_of
from ..scene.scenes import ContactScene
from ..scene.window import Grid
from .effects.base import Compliance
from .prepared import PreparedInterface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.materials import Stack
    from .effects.base import SymbolMaker

    Map = NDArray[np.float64]
    Spectrum = NDArray[np.complex128]
    Shape = tuple[int, int]
    Pixel = tuple[float, float]

__all__ = ["CreepHistory", "CreepResponse", "Terms"]

# Durations whose solvers are kept: a path of equal steps has one, and its jumps another.
_KEPT = 4
# Of dt/lambda. Below, the last coefficient of `_losses` is a series: its terms cancel to the third
# power. Both are then right to 1e-9.
_SMALL = 0.01


class Terms(NamedTuple):
    """Symbol at equilibrium [m/Pa], and of each term of the creep [m/Pa], (n, ...)."""

    equilibrium: Map
    terms: Map


class _Mixed(NamedTuple):
    """Creep of layers that relax differently: fitted on common times."""

    common: CommonTimes


class CreepResponse:
    """Compliance of both bodies of a contact as a function of time.

    Bodies whose materials all relax alike, such as half-spaces, have the exact retardation times of
    their material; layers that do not are fitted on common times.

    Parameters
    ----------
    scene : ContactScene
        Its bodies, of which some are viscoelastic, and its compliance.
    grid : Grid
        Pixels of the window.

    Attributes
    ----------
    times : ndarray (n,)
        Retardation times of the terms [s].
    """

    def __init__(self, scene: ContactScene, grid: Grid) -> None:
        self._scene, self._grid = scene, grid
        self._bodies = [_creep(stack) for stack in scene.interface.stacks]
        self.times = np.concatenate([_times(one) for one in self._bodies])
        self._made: dict[tuple[Shape, Pixel], Terms] = {}

    def over(self, duration: float) -> SymbolMaker:
        """Maker of the symbol of both bodies [m/Pa] over a step of a duration [s].

        The instantaneous one of no duration, that at equilibrium of an infinite one.
        """
        grown = weights(duration, self.times)[1]

        def symbol(shape: Shape, pixel_size: Pixel) -> Map:
            made = self.on(shape, pixel_size)
            return made.equilibrium - np.tensordot(grown, made.terms, 1)

        return symbol

    def on(self, shape: Shape, pixel_size: Pixel) -> Terms:
        """Terms on a grid, made once."""
        key = (shape, pixel_size)
        if key not in self._made:
            self._made[key] = self._terms(shape, pixel_size)
        return self._made[key]

    def _terms(self, shape: Shape, pixel_size: Pixel) -> Terms:
        slow, fast = (self._makers(rate) for rate in (0.0, math.inf))
        rests: list[Map] = []
        terms: list[Map] = []
        for i, body in enumerate(self._bodies):
            at_once, rest = fast[i](shape, pixel_size), slow[i](shape, pixel_size)
            if isinstance(body, CreepSeries):
                ratios = body.compliances / body.instantaneous
                terms.append(ratios[:, None, None] * at_once)
            elif body is not None:
                # Added up one by one: all symbols together are as large as the terms.
                columns = body.common.matrix.T[:, :, None, None]
                found = columns[0] * at_once + columns[1] * rest
                for column, rate in zip(columns[2:], body.common.rates, strict=True):
                    found += column * self._makers(float(rate))[i](shape, pixel_size)
                terms.append(found)
            rests.append(rest)
        return Terms(np.sum(rests, axis=0), np.concatenate(terms))

    def _makers(self, rate: float) -> tuple[SymbolMaker, ...]:
        scene = evolve(self._scene, interface=self._scene.interface.at_rate(rate))
        return scene.demand(Compliance).prepare(scene, self._grid)


def _creep(stack: Stack) -> CreepSeries | _Mixed | None:
    """How a body creeps: as its material, as a mixture, or not at all."""
    series = [material.relaxation for material in stack.materials]
    relaxing = [one for one in series if one is not None]
    if not relaxing:
        return None
    creeps = [creep_of(one) for one in relaxing]
    if len({None if one is None else _shape_of(one) for one in series}) == 1:
        return creeps[0]
    shortest = min(float(np.min(one.times)) for one in relaxing)
    return _Mixed(common_times(shortest, max(float(one.times.max()) for one in creeps)))


def _shape_of(series: PronySeries) -> tuple[object, ...]:
    """Relaxation times, and moduli over that at equilibrium: alike where materials differ by E."""
    ratios = np.asarray(series.moduli) / series.equilibrium
    return tuple(series.times), tuple(f"{one:.12g}" for one in ratios)  # type: ignore[arg-type]


def _times(body: CreepSeries | _Mixed | None) -> Map:
    if body is None:
        return np.zeros(0)
    return body.times if isinstance(body, CreepSeries) else body.common.times


def weights(duration: float, times: Map) -> tuple[Map, Map]:
    """Decay ``exp(-x)`` and growth ``(1 - exp(-x))/x`` of each term over a step, ``x = dt/lambda``.

    Examples
    --------
    >>> [one.tolist() for one in weights(0.0, np.array([1.0]))]
    [[1.0], [1.0]]
    >>> [one.tolist() for one in weights(math.inf, np.array([1.0]))]
    [[0.0], [0.0]]
    """
    x = duration / times
    grown = np.ones_like(x)
    np.divide(-np.expm1(-x), x, out=grown, where=x > 0.0)
    return np.exp(-x), grown


def _losses(duration: float, times: Map) -> tuple[Map, Map, Map]:
    """Integral of y^2 over t/lambda in a step, as coefficients of y^2, y dp and dp^2."""
    x = duration / times
    gone = -np.expm1(-x)
    twice = -0.5 * np.expm1(-2.0 * x)
    long = np.maximum(x, _SMALL)
    exact = (x - 2.0 * gone + twice) / long**2
    short = np.minimum(x, _SMALL)
    series = short * (1.0 / 3.0 - short * (1.0 / 4.0 - short * (7.0 / 60.0 - short / 24.0)))
    return twice, gone * weights(duration, times)[1], np.where(x < _SMALL, series, exact)


class CreepHistory:
    """Memory of the bodies of a contact: the pressures that they have carried.

    Parameters
    ----------
    interface : PreparedInterface
        Of the undeformed bodies.
    response : CreepResponse
        How they creep.

    Attributes
    ----------
    stored : float
        Elastic energy in the bodies [J].
    dissipated : float
        Energy that they have dissipated so far [J].
    """

    def __init__(self, interface: PreparedInterface, response: CreepResponse) -> None:
        self._interface, self._response = interface, response
        grid = interface.grid
        self._symbol = response.on(grid.shape, grid.pixel_size)
        shape = self._symbol.equilibrium.shape
        self._states: Spectrum = np.zeros((response.times.size, *shape), dtype=np.complex128)
        self._pressure: Spectrum = np.zeros(shape, dtype=np.complex128)
        self._solvers: dict[float, PreparedInterface] = {}
        # Of the softest contact, so that laws which the grid softens are the same at each step.
        self._self_influence = interface.with_compliances((response.over(math.inf),)).self_influence
        self._once = self._symbol.equilibrium - self._symbol.terms.sum(axis=0)
        self.stored = self.dissipated = 0.0

    def displacement(self, duration: float) -> Map:
        """Displacement [m] that the history alone causes after a step of a duration [s]."""
        decay, grown = weights(duration, self._response.times)
        total = np.zeros_like(self._pressure)
        for c, y, d, g in zip(self._symbol.terms, self._states, decay, grown, strict=True):
            total += c * (g * self._pressure - d * y)
        return self._map(total)

    def interface_after(self, duration: float) -> PreparedInterface:
        """Contact at the end of a step of a duration [s]: elastic, on heights of the history."""
        key = float(f"{duration:.12g}")
        if key not in self._solvers:
            while len(self._solvers) >= _KEPT:
                del self._solvers[next(iter(self._solvers))]
            made = self._interface.with_compliances((self._response.over(duration),))
            self._solvers[key] = made.with_self_influence(self._self_influence)
        heights = self._interface.heights - self.displacement(duration)
        return self._solvers[key].with_heights(heights)

    def advance(self, duration: float, pressure: Map) -> None:
        """Take the pressure [Pa] at the end of a step of a duration [s] into the history."""
        times = self._response.times
        change = self._spectrum(pressure) - self._pressure
        decay, grown = weights(duration, times)
        lost = 0.0
        rows = zip(self._symbol.terms, self._states, strict=True)
        coefficients = np.transpose(_losses(duration, times))
        for (c, y), (of_y, of_both, of_change), d, g in zip(
            rows, coefficients, decay, grown, strict=True
        ):
            lost += of_y * self._work(c, y, y)
            lost += of_both * self._work(c, y, change) + of_change * self._work(c, change, change)
            y *= d
            y += g * change
        self._pressure += change
        self.dissipated += lost
        self.stored = 0.5 * self._work(self._once, self._pressure, self._pressure)
        for c, y in zip(self._symbol.terms, self._states, strict=True):
            strained = self._pressure - y
            self.stored += 0.5 * self._work(c, strained, strained)

    # On the doubled map of an isolated contact everything beyond the window is zero ---------------

    def _padded(self) -> Shape:
        ny, nx = self._interface.grid.shape
        along_y, along_x = self._interface.grid.repeats
        return ny if along_y else 2 * ny, nx if along_x else 2 * nx

    def _spectrum(self, pressure: Map) -> Spectrum:
        return np.asarray(scipy.fft.rfft2(pressure, self._padded()))

    def _map(self, spectrum: Spectrum) -> Map:
        ny, nx = self._interface.grid.shape
        found: Map = scipy.fft.irfft2(spectrum, self._padded())[:ny, :nx]
        return np.ascontiguousarray(found)

    def _work(self, symbol: Map, one: Spectrum, other: Spectrum) -> float:
        """Integral of one pressure times the displacement of another [J], by Parseval's theorem."""
        rows, columns = self._padded()
        density = symbol * (one.real * other.real + one.imag * other.imag)
        twice = 2.0 * float(density.sum()) - float(density[:, 0].sum())
        if columns % 2 == 0:
            twice -= float(density[:, -1].sum())
        return twice / (rows * columns) * self._interface.grid.pixel_area
