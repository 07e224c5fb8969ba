"""Reading of a map of tractions between its pixels, and the short waves that its edges have.

A reading is a kernel: the map is the sum of its pixels, each times the kernel around it.

trigonometric  The polynomial of waves through the pixels. Exact for waves longer than two pixels;
               the edge of a contact leaves ripples along whole rows and columns, which are larger
               than the stress there.
uniform        Each pixel uniform, as in Love's patch. No ripples; steps between pixels.
spline         The cubic spline through the pixels, of fourth order (Unser 1999). Off a contact it
               falls by a factor of four from pixel to pixel.

The last two have waves shorter than two pixels. At a depth of some pixels they have decayed; above,
the symbols of a plane are their sum over all aliases. They are split in two parts:

* the long waves, by a filter W = (1 + s + s^2/2 + s^3/6) exp(-s), s = (k w)^2/2, which is zero at
  the Nyquist frequency and flat (1 - O(k^8)) where the symbols are not smooth, at k = 0;
* the rest, which acts over a few pixels only: it is summed on the waves of a small window of pixels
  and interpolated to those of the map, by trigonometric interpolation.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError
from .periodic import Modes, UnitFields, grid_of_modes, of_pressure, of_traction, on_modes

__all__ = ["READINGS", "Reading", "Shallow", "ShortWaves", "kernel_transform"]

Array = NDArray[np.float64]
Pair = tuple[float, float]
Reading = Literal["trigonometric", "uniform", "spline"]

READINGS: tuple[Reading, ...] = ("trigonometric", "uniform", "spline")
# Errors over the largest pressure, of a Hertzian load 11 pixels in radius at depths of 0 to 6
# pixels, under a layer 100 times as stiff.

# Pixels from the centre over which the rest acts; a power of two. 16 leave 1e-6, 8 leave 8e-4, and
# 32 take five times as long.
REACH = 16
# Waves of a small window over those of its pixels, in each direction: 16 leave 1e-11, 8 leave 1e-3
# as the filter EDGE then ends outside of them. 32 take 2.7 times as long.
FINER = 16
# Width w of the filter in pixels: 4e-6 at the Nyquist frequency. Narrower, long waves alias (3e-5
# at 1.5, 4e-3 at 1); wider, the rest reaches farther than REACH (4e-5 at 3).
FILTER = 2.0
# Width in pixels of the same filter that ends the sum over aliases: it smooths what is shallower
# than itself. Uniform pixels are off by 3e-4 at a quarter of a pixel, a spline by 1e-5; with 0.3 by
# 1e-2 and 4e-4. 0.1 would leave a tenth of that; below, FINER has too few waves (5e-3 at the
# surface with 0.05).
EDGE = 0.15
# Depth in pixels down to which aliases are summed: (1 + k) exp(-k) = 1e-5 at the Nyquist frequency,
# k = pi SHALLOW. 2 leave 2e-4; from 3 on what changes is the filter's 7e-7.
SHALLOW = 4.5
_SERIAL = 2**18  # multiplications up to which OpenBLAS uses one thread; see `_product`
# components that are odd in x and in y, for a pressure
_ODD_X, _ODD_Y = (3, 4), (3, 5)


def kernel_transform(reading: Reading, phase: Array) -> Array:
    """Transform of the kernel along one axis, over the phase k dx [rad].

    Examples
    --------
    >>> kernel_transform("uniform", np.array([0.0, np.pi])).round(6).tolist()
    [1.0, 0.63662]
    >>> kernel_transform("spline", np.array([0.0, np.pi, 2 * np.pi])).round(6).tolist()
    [1.0, 0.492767, 0.0]
    """
    if reading == "trigonometric":
        return np.ones_like(phase)
    if reading == "uniform":
        return np.sinc(phase / (2.0 * np.pi))
    if reading != "spline":
        raise DescriptionError("planes.reading", reading, f"be one of {', '.join(READINGS)}")
    # That of the B-spline, over what makes it go through the pixels.
    through: Array = np.sinc(phase / (2.0 * np.pi)) ** 4 * 3.0 / (2.0 + np.cos(phase))
    return through


class _Axis(NamedTuple):
    """Interpolation along one axis, of even and of odd functions.

    `even_in`, `odd_in` (reach + 1, n) are from the waves of the small window to pixels, `even_out`
    and `odd_out` (m, reach + 1) from pixels to the waves of the map that are not negative.
    """

    even_in: Array
    odd_in: Array
    even_out: Array
    odd_out: Array

    def inwards(self, odd: bool) -> Array:
        """Matrix to the pixels."""
        return self.odd_in if odd else self.even_in

    def outwards(self, odd: bool) -> Array:
        """Matrix from the pixels."""
        return self.odd_out if odd else self.even_out


class ShortWaves:
    """The waves of a reading that are shorter than two pixels, for the modes of a map.

    Parameters
    ----------
    reading : {"uniform", "spline"}
        How the map is read.
    modes : Modes
        Of the grid of the map.
    pixel_size : (dy, dx)
        [m].

    Attributes
    ----------
    depth : float
        Depth [m] from which on they have decayed.
    length : ndarray
        Wavenumbers [1/m] at which the states of a plane are wanted, ascending.
    kernel : ndarray
        Transform of the kernel on the modes of the map.
    """

    def __init__(self, reading: Reading, modes: Modes, pixel_size: Pair) -> None:
        (ny, nx), (dy, dx) = modes.shape, pixel_size
        ky = 2.0 * np.pi / ny * np.minimum(np.arange(ny), np.arange(ny, 0, -1))
        kx = 2.0 * np.pi / nx * np.arange(nx // 2 + 1.0)
        self.depth = SHALLOW * max(pixel_size)
        self.kernel = kernel_transform(reading, ky)[:, None] * kernel_transform(reading, kx)
        self.long = self.kernel * _filter(FILTER, ky, kx)
        side = 2 * REACH * FINER
        waves = grid_of_modes((side, side), (dy / FINER, dx / FINER))
        self.waves, self.length = _box(waves, side // 2 + 1, side // 2 + 1), waves.length
        self._step = np.pi / REACH / np.array([dy, dx])
        k = np.pi / REACH * np.arange(side // 2 + 1.0)
        along = kernel_transform(reading, k)
        self.weight = along[:, None] * along * (_filter(EDGE, k, k) - _filter(FILTER, k, k))
        self.y, self.x = _axis(k, ky[: ny // 2 + 1]), _axis(k, kx)

    def on_plane(self, tables: UnitFields, reached: Modes, *, tractions: bool) -> Shallow:
        """Symbols of a plane on the modes it reaches, from its fields at the wavenumbers."""
        count = tables.pressure.shape[1] - 2
        longest = self.length[count - 1] * (1.0 + 1e-12)
        up, across = (int(n) + 1 for n in np.minimum(longest / self._step, REACH * FINER))
        waves = _box(self.waves, up, across)
        return Shallow(self, waves, on_modes(tables, waves, tractions=tractions), reached)


class Shallow(NamedTuple):
    """Symbols of a shallow plane, summed over the aliases of each mode."""

    short: ShortWaves
    waves: Modes
    fields: UnitFields
    reached: Modes

    def pressure(self, k: int, symbol: Array) -> Array:
        """Symbol of component k for a pressure, from that without aliases."""
        rest = of_pressure(k, self.fields.pressure, self.waves)
        return self._sum(symbol, rest, odd_x=k in _ODD_X, odd_y=k in _ODD_Y)

    def traction(self, k: int, symbol: Array, along: Literal["x", "y"]) -> Array:
        """Symbol of component k for a traction along an axis, from that without aliases."""
        rest = of_traction(k, self.fields.traction, self.waves, along)
        odd_x, odd_y = (k in _ODD_X) != (along == "x"), (k in _ODD_Y) != (along == "y")
        return self._sum(symbol, rest, odd_x=odd_x, odd_y=odd_y)

    def _sum(self, symbol: Array, rest: Array, *, odd_x: bool, odd_y: bool) -> Array:
        short, (rows, across) = self.short, symbol.shape
        up, down = rows // 2 + 1, (rows - 1) // 2
        high, wide = rest.shape
        pixels = _product(short.y.inwards(odd_y)[:, :high], rest * short.weight[:high, :wide])
        pixels = _product(pixels, short.x.inwards(odd_x)[:, :wide].T)
        along_x = _product(pixels, short.x.outwards(odd_x)[:across].T)
        added = _product(short.y.outwards(odd_y)[:up], along_x)
        total: Array = symbol * short.long[self.reached.rows, :across]
        total[:up] += added
        total[up:] += (-added if odd_y else added)[down:0:-1]
        return total


def _box(modes: Modes, up: int, across: int) -> Modes:
    """Modes of the first rows and columns."""
    x, y, xx, yy = (one[:up, :across] for one in modes[4:])
    rank = modes.rank[:up, :across]
    return Modes(modes.shape, modes.length, modes.rows[:up], rank, x, y, xx, yy)


def _product(a: Array, b: Array) -> Array:
    """Product of matrices in parts that BLAS multiplies on one thread.

    Starting its threads takes ten times as long as these products.
    """
    width = max(1, _SERIAL // a.size)
    if b.shape[1] <= width:
        return np.asarray(a @ b)
    product = np.empty((a.shape[0], b.shape[1]))
    for start in range(0, b.shape[1], width):
        part = slice(start, start + width)
        product[:, part] = a @ b[:, part]
    return product


def _filter(width: float, ky: Array, kx: Array) -> Array:
    """Filter of long waves; `width` in pixels, phases in [rad]."""
    s = 0.5 * width**2 * (ky[:, None] ** 2 + kx**2)
    passed: Array = (1.0 + s * (1.0 + s * (0.5 + s / 6.0))) * np.exp(-s)
    return passed


def _axis(waves: Array, wanted: Array) -> _Axis:
    at = np.arange(REACH + 1.0)
    twice = np.where((at == 0.0) | (at == REACH), 1.0, 2.0)
    both = np.where(waves == 0.0, 1.0, 2.0) / (2.0 * REACH)
    return _Axis(
        np.cos(np.multiply.outer(at, waves)) * both,
        np.sin(np.multiply.outer(at, waves)) * both,
        np.cos(np.multiply.outer(wanted, at)) * twice,
        np.sin(np.multiply.outer(wanted, at)) * twice,
    )
