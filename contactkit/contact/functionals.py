r"""Numbers of a contact that have a gradient, with their slopes.

A functional J depends on pressure p, displacement u = C p, heights h and rigid-body approach
:math:`\delta`. Those here are smooth as long as no pixel comes into contact or leaves it; counts of
pixels, as the contact area, are not, and `participation_area` takes the place of that.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..errors import DescriptionError, nearest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .result import ContactResult

    Map = NDArray[np.float64]

__all__ = ["FUNCTIONALS", "Functional", "Slopes", "functional"]


class Slopes(NamedTuple):
    """Slopes of a functional, each with the others held: maps (ny, nx), or None for zero.

    `pressure` [unit/Pa], `displacement` and `heights` [unit/m] of each pixel, and `approach`, that
    of the zero plane of the heights [unit/m].
    """

    pressure: Map | None = None
    displacement: Map | None = None
    heights: Map | None = None
    approach: float = 0.0


class Functional(NamedTuple):
    """A number of a contact and its slopes, to ask for its gradient.

    Parameters
    ----------
    name, unit : str
        Of the number.
    value : callable
        The number of a `ContactResult`.
    slopes : callable
        Its `Slopes` in a `ContactResult`.

    Examples
    --------
    The mean of the squared pressure:

    >>> squared = Functional(
    ...     "mean_square_pressure",
    ...     "Pa2",
    ...     lambda result: float((result.pressure**2).mean()),
    ...     lambda result: Slopes(pressure=2.0 * result.pressure / result.pressure.size),
    ... )
    >>> squared.unit
    'Pa2'
    """

    name: str
    unit: str
    value: Callable[[ContactResult], float]
    slopes: Callable[[ContactResult], Slopes]


def functional(of: str | Functional) -> Functional:
    """Return a functional by its name, or one's own as it is.

    Raises
    ------
    DescriptionError
        If there is none of the name, or the number has no gradient.
    """
    if isinstance(of, Functional):
        return of
    if of in FUNCTIONALS:
        return FUNCTIONALS[of]
    if of in _COUNTS:
        raise DescriptionError(
            "of",
            of,
            "have a gradient: it counts pixels, and steps where one comes into contact",
            hint="participation_area is smooth, or give a Functional of your own",
        )
    known = ", ".join(FUNCTIONALS)
    raise DescriptionError(
        "of", of, f"be one of {known}, or a Functional", hint=nearest(str(of), FUNCTIONALS)
    )


def _peak(values: Map, where: NDArray[np.bool_] | None = None) -> Map:
    """One at the largest value of a map, among some of its pixels."""
    found = np.zeros(values.shape)
    shown = values if where is None else np.where(where, values, -np.inf)
    found[np.unravel_index(int(np.argmax(shown)), values.shape)] = 1.0
    return found


def _open(result: ContactResult) -> Map:
    """Pixels that are apart, over the number of all."""
    apart = (result.gap > 0.0) & ~result.contact
    return apart / apart.size


def _of_mean_gap(result: ContactResult) -> Slopes:
    apart = _open(result)
    return Slopes(displacement=apart, heights=-apart, approach=-float(apart.sum()))


def _of_energy(result: ContactResult) -> Slopes:
    pixel, p = result.plan.grid.pixel_area, result.pressure
    half = 0.5 * pixel * p
    by_pressure = pixel * (0.5 * result.displacement - result.heights)
    return Slopes(pressure=by_pressure, displacement=half, heights=-pixel * p)


def _of_elastic_energy(result: ContactResult) -> Slopes:
    half = 0.5 * result.plan.grid.pixel_area
    return Slopes(pressure=half * result.displacement, displacement=half * result.pressure)


def _participation(result: ContactResult) -> float:
    p = result.pressure
    square = float((p * p).sum())
    return float(p.sum()) ** 2 / square * result.plan.grid.pixel_area if square > 0.0 else 0.0


def _of_participation(result: ContactResult) -> Slopes:
    p, pixel = result.pressure, result.plan.grid.pixel_area
    total, square = float(p.sum()), float((p * p).sum())
    if not square > 0.0:
        return Slopes()
    return Slopes(pressure=2.0 * pixel * total / square * (1.0 - total / square * p))


def _elastic_energy(result: ContactResult) -> float:
    product = np.einsum("ij,ij->", result.pressure, result.displacement)
    return 0.5 * float(product) * result.plan.grid.pixel_area


def _uniform(value: float, result: ContactResult) -> Slopes:
    return Slopes(pressure=np.full(result.pressure.shape, value))


_ALL = (
    Functional(
        "load", "N", lambda r: r.load, lambda result: _uniform(result.plan.grid.pixel_area, result)
    ),
    Functional(
        "mean_pressure",
        "Pa",
        lambda r: r.mean_pressure,
        lambda result: _uniform(1.0 / result.pressure.size, result),
    ),
    Functional(
        "max_pressure",
        "Pa",
        lambda r: r.max_pressure,
        lambda result: Slopes(pressure=_peak(result.pressure)),
    ),
    Functional(
        "approach",
        "m",
        lambda r: r.approach,
        lambda result: Slopes(heights=_peak(result.heights), approach=1.0),
    ),
    Functional("rigid_approach", "m", lambda r: r.rigid_approach, lambda _: Slopes(approach=1.0)),
    Functional(
        "max_displacement",
        "m",
        lambda r: r.max_displacement,
        lambda result: Slopes(displacement=_peak(result.displacement, result.contact)),
    ),
    Functional("mean_gap", "m", lambda r: float((r.gap * (~r.contact)).mean()), _of_mean_gap),
    Functional("energy", "J", lambda r: r.energy, _of_energy),
    Functional("elastic_energy", "J", _elastic_energy, _of_elastic_energy),
    Functional("participation_area", "m2", _participation, _of_participation),
)
FUNCTIONALS = {one.name: one for one in _ALL}
"""Functionals by their names.

`participation_area` is ``(sum p)^2 / sum p^2`` times the area of a pixel: the area of contact if
the pressure is uniform there, 8/9 of it under a sphere. `mean_gap` is that of the pixels apart
over the whole window, `energy` the complementary energy that the contact minimises.
"""
_COUNTS = {
    "contact_area",
    "contact_fraction",
    "corrected_contact_area",
    "plastic_area",
    "wetted_area",
    "film_force",
    "n_menisci",
}
