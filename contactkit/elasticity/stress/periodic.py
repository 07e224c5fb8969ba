"""Stresses on one plane of a layered solid, mode by mode of a periodic map of tractions.

Conventions as in `layered`: z into the solid, tension positive, ``exp(+i (xi x + eta y))`` carries
a mode, components ordered xx, yy, zz, xy, xz, yz (then the displacements x, y, z).

The states of a plane depend on the length of the wave vector alone and are evaluated once for each
length.  Modes with alpha z beyond the cut-off are omitted, with the rows and columns of the
transforms that contain no other.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from ..layered_fields import PlaneStates, unit_stresses

__all__ = [
    "Grid",
    "Modes",
    "UnitFields",
    "grid_of_modes",
    "into_space",
    "of_pressure",
    "of_traction",
    "on_modes",
    "spectrum",
    "table_of",
    "within",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Indices = NDArray[np.intp]

IMAGINARY = (4, 5, 6, 7)  # components a quarter of a wavelength out of phase with the load
SWAPPED = (1, 0, 2, 3, 5, 4, 7, 6, 8)  # component after exchange of x and y


class Modes(NamedTuple):
    """Half plane of modes of a periodic grid, or the part below the cut-off of a plane.

    `length` are the distinct wavenumbers, ascending, without zero; `rank` is the index of each mode
    among them from 1 (0 is the mean).  `x` and `y` are the direction cosines of the wave vector,
    zero at the Nyquist wavenumber of an even grid, where an odd function has no mode; `xx` and
    `yy` are their squares.
    """

    shape: tuple[int, int]
    length: Array
    rows: Indices
    rank: Indices
    x: Array
    y: Array
    xx: Array
    yy: Array


class Grid(NamedTuple):
    """A periodic grid, and the window of it that is wanted."""

    modes: Modes
    pixel_size: tuple[float, float]
    window: tuple[int, int]


def grid_of_modes(shape: tuple[int, int], pixel_size: tuple[float, float]) -> Modes:
    """All modes of the real transform of a periodic grid.

    Examples
    --------
    >>> modes = grid_of_modes((4, 4), (0.25, 0.25))
    >>> print((modes.length / (2 * np.pi)).round(3), modes.rank.shape)
    [1.    1.414 2.    2.236 2.828] (4, 3)
    """
    (ny, nx), (dy, dx) = shape, pixel_size
    ky = 2.0 * np.pi / (ny * dy) * np.arange(ny // 2 + 1.0)
    kx = 2.0 * np.pi / (nx * dx) * np.arange(nx // 2 + 1.0)
    length, rank = np.unique(np.hypot(ky[:, None], kx), return_inverse=True)
    back = slice((ny - 1) // 2, 0, -1)
    rank = rank.reshape(ky.size, kx.size)
    rank, signed = np.concatenate([rank, rank[back]]), np.concatenate([ky, -ky[back]])
    # Squares keep the Nyquist waves that an odd function loses: sigma_xx of such a wave is real.
    over = 1.0 / np.where(rank == 0, 1.0, length[rank])
    x, y = kx * over, signed[:, None] * over
    xx, yy = x * x, y * y
    if nx % 2 == 0:
        x[:, -1] = 0.0
    if ny % 2 == 0:
        y[ny // 2] = 0.0
    return Modes(shape, length[1:], np.arange(ny), rank, x, y, xx, yy)


def within(modes: Modes, count: int, pixel_size: tuple[float, float]) -> Modes:
    """Modes in the smallest box around the `count` longest waves.

    Examples
    --------
    >>> modes = within(grid_of_modes((8, 8), (1.0, 1.0)), 1, (1.0, 1.0))
    >>> modes.rows.tolist(), modes.rank.tolist()
    ([0, 1, 7], [[0, 1], [1, 2], [1, 2]])
    """
    if count >= modes.length.size:
        return modes
    (ny, nx), (dy, dx) = modes.shape, pixel_size
    longest = modes.length[count - 1] * (1.0 + 1e-12) if count else 0.0
    up = min(int(longest * ny * dy / (2.0 * np.pi)), ny // 2)
    across = min(int(longest * nx * dx / (2.0 * np.pi)), nx // 2) + 1
    down = min(up, (ny - 1) // 2)
    rows = np.concatenate([np.arange(up + 1), np.arange(ny - down, ny)])
    if rows.size == ny and across == modes.rank.shape[1]:
        return modes
    x, y, xx, yy = (a[rows, :across] for a in modes[4:])
    return Modes(modes.shape, modes.length, rows, modes.rank[rows, :across], x, y, xx, yy)


def spectrum(values: Array, shape: tuple[int, int], workers: int | None = None) -> Complex:
    """Real transform of a map, padded with zeros to a grid.

    Examples
    --------
    >>> spectrum(np.ones((2, 2)), (2, 4)).real.tolist()
    [[4.0, 2.0, 0.0], [0.0, 0.0, 0.0]]
    """
    rows = scipy.fft.rfft(values, n=shape[1], axis=1, workers=workers)
    return scipy.fft.fft(rows, n=shape[0], axis=0, workers=workers, overwrite_x=True)


def into_space(
    values: Complex, modes: Modes, window: tuple[int, int], workers: int | None = None
) -> Array:
    """Real map from a spectrum on some of the modes, restricted to a window at the origin.

    Examples
    --------
    >>> modes = grid_of_modes((2, 4), (1.0, 1.0))
    >>> into_space(spectrum(np.ones((2, 2)), (2, 4)), modes, (2, 2)).tolist()
    [[1.0, 1.0], [1.0, 1.0]]
    """
    if values.shape[0] < modes.shape[0]:
        full = np.zeros((modes.shape[0], values.shape[1]), dtype=np.complex128)
        full[modes.rows] = values
        values = full
    # Columns first: rows outside of the window are cut before they are transformed.
    rows = scipy.fft.ifft(values, axis=0, workers=workers, overwrite_x=True)[: window[0]]
    return scipy.fft.irfft(rows, n=modes.shape[1], axis=1, workers=workers)[:, : window[1]]


class UnitFields(NamedTuple):
    """Fields per unit load, a column for each wavenumber.

    Rows LL, TT, S, T, U, W for a unit `pressure`; the same and V, Q, uV for a unit `traction`.
    """

    pressure: Array
    traction: Array


def table_of(states: PlaneStates, length: Array, *, displacement: bool) -> UnitFields:
    """Table of the fields of a plane per unit load.

    Zeros are inserted before and after the wavenumbers, for the mean and the omitted ones.

    Examples
    --------
    >>> from ..layered_fields import plane_states
    >>> states = next(plane_states([1.0], [1.0], [0.3], [], [0.0]))
    >>> print(table_of(states, np.ones(1), displacement=True)[0][4:, 1].round(2))
    [0.52 1.82]
    """
    pressure, traction, transverse = unit_stresses(states)
    alpha = length[: transverse.size]
    unit = 1.0 / (2.0 * states.shear_modulus * alpha) if displacement else np.zeros(alpha.size)
    loads = []
    for stress, state in ((pressure, states.pressure), (traction, states.traction)):
        U, W, T, S = state
        loads.append([*stress, S, T, U * unit, W * unit])
    shear = [transverse, states.transverse[1], 2.0 * unit * transverse]
    # The zeros at both ends serve rank 0, the mean, and with mode="clip" all ranks above the last.
    tables = np.zeros((2, 9, alpha.size + 2))
    tables[0, :6, 1:-1] = loads[0]
    tables[1, :, 1:-1] = loads[1] + shear
    return UnitFields(tables[0, :6], tables[1])


def on_modes(tables: UnitFields, modes: Modes, *, tractions: bool) -> UnitFields:
    """Fields per unit load on each mode, (6, ...) and (9, ...), zero for the mean.

    Without `tractions` their table is left as it is.

    Examples
    --------
    >>> modes, tables = grid_of_modes((1, 4), (1.0, 1.0)), np.arange(4.0)[None]
    >>> on_modes(UnitFields(tables, tables), modes, tractions=False).pressure.tolist()
    [[[0.0, 1.0, 2.0]]]
    """
    pressure, traction = tables
    if tractions:
        traction = np.take(traction, modes.rank, axis=1, mode="clip")
    return UnitFields(np.take(pressure, modes.rank, axis=1, mode="clip"), traction)


def of_pressure(k: int, fields: Array, modes: Modes) -> Array:
    """Symbol of component k for a pressure, without its factor i; 0 to 5 stresses, then x, y, z.

    Parameters
    ----------
    k : int
        Component.
    fields : ndarray (6, ...)
        `UnitFields.pressure` on the modes.
    modes : Modes
        On which the symbol is wanted.

    Examples
    --------
    On the surface sigma_zz is the pressure, with the other sign:

    >>> from ..layered_fields import plane_states
    >>> modes = grid_of_modes((1, 4), (1.0, 1.0))
    >>> states = next(plane_states(modes.length, [1.0], [0.3], [], [0.0]))
    >>> tables = table_of(states, modes.length, displacement=False)
    >>> fields = on_modes(tables, modes, tractions=False)
    >>> of_pressure(2, fields.pressure, modes).round(3).tolist()
    [[0.0, -1.0, -1.0]]
    """
    x, y, xx, yy = modes.x, modes.y, modes.xx, modes.yy
    rows: list[Array] = list(fields)
    LL, TT, S, T, U, W = rows
    match k:
        case 0:
            return LL * xx + TT * yy
        case 1:
            return LL * yy + TT * xx
        case 2:
            return S
        case 3:
            return (LL - TT) * x * y
        case 4 | 5:
            return T * (x if k == 4 else y)
        case 6 | 7:
            return U * (x if k == 6 else y)
        case _:
            return W


def of_traction(k: int, fields: Array, modes: Modes, along: Literal["x", "y"]) -> Array:
    """Symbol of component k for a traction along an axis, without its factors of i.

    Parameters
    ----------
    k, modes
        As in `of_pressure`.
    fields : ndarray (9, ...)
        `UnitFields.traction` on the modes.
    along : {"x", "y"}
        Axis of the traction.

    Examples
    --------
    On the surface sigma_xz is the traction, with the other sign:

    >>> from ..layered_fields import plane_states
    >>> modes = grid_of_modes((1, 4), (1.0, 1.0))
    >>> states = next(plane_states(modes.length, [1.0], [0.3], [], [0.0]))
    >>> tables = table_of(states, modes.length, displacement=False)
    >>> fields = on_modes(tables, modes, tractions=True)
    >>> of_traction(4, fields.traction, modes, "x").round(3).tolist()
    [[0.0, -1.0, -1.0]]
    """
    x, y, xx, yy = modes.x, modes.y, modes.xx, modes.yy
    if along == "y":
        k, x, y, xx, yy = SWAPPED[k], y, x, yy, xx
    rows: list[Array] = list(fields)
    LL, TT, S, T, U, W, V, Q, uV = rows
    match k:
        case 0:
            return x * (LL * xx + (TT - 2.0 * V) * yy)
        case 1:
            return x * ((LL + 2.0 * V) * yy + TT * xx)
        case 2:
            return x * S
        case 3:
            return y * ((LL - TT + V) * xx - V * yy)
        case 4:
            return T * xx + Q * yy
        case 5:
            return x * y * (T - Q)
        case 6:
            return U * xx + uV * yy
        case 7:
            return x * y * (U - uV)
        case _:
            return x * W
