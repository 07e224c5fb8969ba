"""Quantities that functions take: numbers, arrays, or texts with a unit."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import DescriptionError
from .units import parse_quantity

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = [
    "angles",
    "check_shapes",
    "listed",
    "non_negative",
    "plain",
    "positive",
    "positive_or_inf",
    "quantity",
    "single",
]


def quantity(name: str, given: ArrayLike | str, unit: str) -> Array:
    """Return a quantity as an array of floats in its SI unit, a single number as one of no axes.

    Parameters
    ----------
    name : str
        The argument, as ``function(argument)``.
    given : float, array_like or str
        A number or numbers in `unit`, a text with its own unit, or a sequence with texts.
    unit : str
        SI unit.

    Raises
    ------
    DescriptionError
        If it is no number.

    Examples
    --------
    >>> float(quantity("squeeze_time(radius)", "3 mm", "m"))
    0.003
    >>> quantity("load_curve(loads)", ["5 mN", 0.01], "N").tolist()
    [0.005, 0.01]
    """
    if np.ma.is_masked(given):
        cure = "leave these out, such as by x[~x.mask]"
        raise DescriptionError(name, "masked ones", "be numbers without a mask", hint=cure)
    if isinstance(given, str):
        return np.asarray(parse_quantity(given, unit, name))
    if isinstance(given, list | tuple) and any(isinstance(one, str) for one in given):
        given = [parse_quantity(one, unit, name) for one in given]
    try:
        found = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise DescriptionError(name, given, "be a number", unit=unit) from None
    if given is None or np.asarray(given).dtype == np.bool_:
        raise DescriptionError(name, given, "be a number", unit=unit)
    return found


def _checked(
    holds: Callable[[Array], Any], expected: str
) -> Callable[[str, ArrayLike | str, str], Array]:
    def check(name: str, given: ArrayLike | str, unit: str) -> Array:
        found = quantity(name, given, unit)
        wrong = ~np.asarray(holds(found))
        if wrong.any():
            raise DescriptionError(name, float(found[wrong].flat[0]), expected, unit=unit)
        return found

    return check


def listed(name: str, given: ArrayLike | str, unit: str) -> Array:
    """As `quantity`, one value or more along one axis; refuses what is not finite.

    Raises
    ------
    DescriptionError
        If there is no value, one that is not finite, or more than one axis.
    """
    found = np.atleast_1d(quantity(name, given, unit))
    if found.ndim != 1 or not found.size or not np.isfinite(found).all():
        raise DescriptionError(name, given, "be a sequence of finite numbers", unit=unit)
    return found


def positive_values(name: str, given: ArrayLike | str, unit: str) -> Array:
    """As `listed`; refuses what is not positive.

    Raises
    ------
    DescriptionError
        If there is no value, more than one axis, or one that is not positive and finite.
    """
    found = listed(name, given, unit)
    if not (found > 0.0).all():
        raise DescriptionError(name, given, "be positive and finite numbers", unit=unit)
    return found


positive = _checked(lambda x: (x > 0.0) & np.isfinite(x), "be positive and finite")
"""As `quantity`; refuses what is not positive and finite."""

positive_or_inf = _checked(lambda x: x > 0.0, "be positive, or inf")
"""As `quantity`; refuses what is not positive; inf is allowed."""

non_negative = _checked(lambda x: (x >= 0.0) & np.isfinite(x), "be zero or positive, and finite")
"""As `quantity`; refuses what is negative or not finite."""


def single(name: str, given: float | str, unit: str) -> float:
    """Return one positive number in its SI unit; as `positive`, and refuses an array."""
    if not isinstance(given, str) and np.ndim(given):
        raise DescriptionError(name, given, "be a single number", unit=unit)
    return float(positive(name, given, unit))


def check_shapes(function: str, *arrays: Array) -> None:
    """Refuse arrays that do not broadcast.

    Raises
    ------
    DescriptionError
        With their shapes.
    """
    try:
        np.broadcast_shapes(*(one.shape for one in arrays))
    except ValueError:
        shapes = [one.shape for one in arrays if one.ndim]
        raise DescriptionError(
            function, shapes, "be given numbers, or arrays of shapes that broadcast"
        ) from None


def angles(name: str, given: Any) -> tuple[Array, Array]:
    """Return the contact angles [rad] on the lower and the upper body; one is that of both.

    Raises
    ------
    DescriptionError
        If one is no angle from 0 to pi; a number that may be in degrees gets that as its cure.

    Examples
    --------
    >>> [round(float(angle), 3) for angle in angles("bridge_force(contact_angles)", "60 deg")]
    [1.047, 1.047]
    """
    pair = tuple(given) if isinstance(given, tuple | list) else (given, given)
    if len(pair) != 2:
        raise DescriptionError(name, given, "be one angle, or a pair: (lower, upper)", unit="rad")
    found = [quantity(name, one, "rad") for one in pair]
    for one in found:
        wrong = ~((one >= 0.0) & (one <= math.pi))
        if wrong.any():
            bad = float(one[wrong].flat[0])
            hint = f"was it in degrees? then write '{bad:g} deg'" if math.pi < bad <= 180.0 else ""
            raise DescriptionError(name, bad, "lie between 0 and pi", unit="rad", hint=hint)
    return found[0], found[1]


def plain(values: Any) -> float | Array:
    """Return a float for an array without axes, else the array."""
    found = np.asarray(values)
    return found if found.ndim else float(found)
