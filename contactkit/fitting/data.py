"""Measured curves and measured bounds: what a fit compares with the results of a scene."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from attrs import field, frozen

from ..errors import DescriptionError
from ..frozen import FrozenDict
from ..units import Scale, parse_difference, parse_quantity, parse_scale
from ..validators import Described

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["NUISANCES", "MeasuredBound", "MeasuredCurve", "by_curve"]

NUISANCES = ("shift", "zero", "scale", "stiffness")
"""Nuisances of a curve: of its axis, of its quantity (two), and of the spring in between."""


def _array(value: Any) -> Floats:
    try:
        # A masked value is nan, which is refused with its index.
        found = np.array(np.ma.filled(np.ma.array(value, dtype=np.float64), np.nan))
    except (TypeError, ValueError) as error:
        hint = f"{error}; units go into units=, such as ('um', 'mN')"
        raise DescriptionError("MeasuredCurve", value, "hold numbers", hint=hint) from None
    found.flags.writeable = False
    return found


def _frozen_map(value: Any) -> FrozenDict[str, Any]:
    if not isinstance(value, Mapping):
        expected = "be a mapping of paths to values, such as {'loading.speed': '10 um/s'}"
        raise DescriptionError("sets", value, expected)
    return FrozenDict(value)


@frozen(kw_only=True, eq=False)
class MeasuredCurve(Described):
    r"""A measured quantity over an axis, with its noise and the nuisances of the instrument.

    A reading :math:`y` at the position :math:`x` of the instrument is compared with the quantity
    :math:`q` of the scene at its axis :math:`a`,

    .. math:: y = \text{scale}\; q(a) + \text{zero}, \qquad
        a + q(a)/\text{stiffness} = x + \text{shift}.

    Each nuisance is a number, or is fitted if it is a `Range` or a `Prior`. A spring that is softer
    than the fall of the force jumps over the states that are not stable, as a cantilever does at
    snap-in and pull-off: the curve follows the branch it is on to its end.

    Parameters
    ----------
    over : str
        What the curve is over: a column of the result, such as ``gap``, whose curve is read at the
        positions; or the path of a field of the scene, such as ``temperature`` or ``loading.rest``,
        which is then set to each position, a run for each.
    at : array_like (n,)
        Positions, in ``units[0]``.
    quantity : str
        Column of the result (over a column) or number of it (over a path).
    values : array_like (n,)
        Readings, in ``units[1]``.
    units : (str, str)
        Units of `at` and `values`, such as ``"um"`` or ``"degC"``; SI if not given.
    noise : float, str, array_like or None
        Standard deviation of the readings: a number or an array in ``units[1]``, a text with a
        unit, or in percent of each reading. None: the same for all readings of the curve, estimated
        from the residuals; ``"proportional"``: estimated as a fraction of each reading.
    weights : array_like (n,), optional
        Factors on the squares of the residuals.
    sets : mapping of str to object
        Fields of the scene, by path, that this curve was measured with: a speed, a temperature.
    branch : {"rising", "falling"}, optional
        Part of a result whose axis turns back: where it rises or where it falls.
    beyond : {"refuse", "hold"}
        Beyond the last point of the run the curve is refused, or its last value is kept.
    shift : float, str, Range or Prior
        Added to the positions, in ``units[0]``: contact point, offset of the gap.
    zero : float, str, Range or Prior
        Reading where the quantity is zero, in ``units[1]``: zero of the load.
    scale : float, Range or Prior
        Reading over quantity, of the calibration [-].
    stiffness : float, str, Range or Prior
        Stiffness of the spring between the drive, whose position is measured, and the body [N/m].
        The speed of the body is taken to be that of the drive.
    name : str
        Name of the curve in tables and figures.

    Raises
    ------
    DescriptionError
        If lengths differ, a number is not finite, a unit is unknown, or the noise is not positive.

    Examples
    --------
    >>> import contactkit as ck
    >>> curve = ck.MeasuredCurve(over="gap", at=[1.0, 2.0], quantity="pull", values=[30.0, 20.0],
    ...     units=("um", "mN"), noise="2 %", shift=ck.Range("-50 nm", "50 nm"))
    >>> curve.y.tolist(), curve.deviation("N").tolist()
    ([0.03, 0.02], [0.0006, 0.0004])
    """

    over: str
    at: Floats = field(converter=_array, repr=False)
    quantity: str
    values: Floats = field(converter=_array, repr=False)
    units: tuple[str, str] = ("", "")
    noise: Any = None
    weights: Any = field(default=None, repr=False)
    sets: Mapping[str, Any] = field(factory=FrozenDict, converter=_frozen_map)
    branch: Literal["rising", "falling"] | None = None
    beyond: Literal["refuse", "hold"] = "refuse"
    shift: Any = 0.0
    zero: Any = 0.0
    scale: Any = 1.0
    stiffness: Any = math.inf
    name: str = "data"

    def __attrs_post_init__(self) -> None:
        label = f"MeasuredCurve({self.name})"
        if self.at.ndim != 1 or self.at.shape != self.values.shape or not self.at.size:
            found = f"{self.at.shape} and {self.values.shape}"
            raise DescriptionError(label, found, "have as many positions as values, at least one")
        for what, array in (("at", self.at), ("values", self.values)):
            wrong = np.flatnonzero(~np.isfinite(array))
            if wrong.size:
                hint = f"{wrong.size} of {array.size} are none, the first at index {wrong[0]}; "
                raise DescriptionError(
                    f"{label}.{what}",
                    float(array[wrong[0]]),
                    "be finite numbers",
                    hint=f"{hint}leave out these rows: a fit does not guess them",
                )
        for what, one, known in (
            ("branch", self.branch, (None, "rising", "falling")),
            ("beyond", self.beyond, ("refuse", "hold")),
        ):
            if one not in known:
                choices = " or ".join(repr(k) for k in known if k)
                raise DescriptionError(f"{label}.{what}", one, f"be {choices}")
        if not isinstance(self.units, tuple | list) or len(self.units) != 2:
            raise DescriptionError(f"{label}.units", self.units, "be two, such as ('um', 'mN')")
        self._scales()

    def _scales(self) -> tuple[Scale, Scale]:
        return parse_scale(self.units[0]), parse_scale(self.units[1])

    @property
    def x(self) -> Floats:
        """Positions in SI units."""
        scale = self._scales()[0]
        return np.asarray(self.at * scale.factor + scale.zero)

    @property
    def y(self) -> Floats:
        """Readings in SI units."""
        scale = self._scales()[1]
        return np.asarray(self.values * scale.factor + scale.zero)

    @property
    def is_estimated(self) -> bool:
        """Whether the noise is estimated from the residuals."""
        return self.noise is None or (isinstance(self.noise, str) and self.noise == "proportional")

    def deviation(self, unit: str) -> Floats:
        """Standard deviation of each reading, weights included, in the SI unit of the quantity.

        Of a noise that is estimated, its shape: 1, or the size of the reading.

        Raises
        ------
        DescriptionError
            If it is not positive, or in another unit.
        """
        size, factor = np.abs(self.y), self._scales()[1].factor
        noise, label = self.noise, f"MeasuredCurve({self.name}).noise"
        if noise is None:
            found = np.ones_like(size)
        elif isinstance(noise, str) and noise == "proportional":
            found = size
        elif isinstance(noise, str) and noise.strip().endswith("%"):
            found = size * parse_quantity(noise, "-", label)
        elif isinstance(noise, str):
            found = np.full_like(size, parse_difference(noise, unit, label))
        else:
            found = np.broadcast_to(_array(noise), size.shape) * factor
        if not np.all(np.isfinite(found) & (found > 0.0)):
            hint = "a relative noise needs readings that are not zero; give one with a unit"
            raise DescriptionError(label, noise, "be positive and finite", hint=hint)
        return np.asarray(found / np.sqrt(self._weights(size.shape)))

    def _weights(self, shape: tuple[int, ...]) -> Floats:
        if self.weights is None:
            return np.ones(shape)
        found = _array(self.weights)
        if found.shape != shape or not np.all(np.isfinite(found) & (found > 0.0)):
            label = f"MeasuredCurve({self.name}).weights"
            hint = "leave out what is to have no weight"
            raise DescriptionError(label, self.weights, "be positive, one a reading", hint=hint)
        return found

    @property
    def fitted(self) -> dict[str, Any]:
        """Nuisances that are sought, by name: those with a `Range`, a pair or a `Prior`."""
        known = {name: getattr(self, name) for name in NUISANCES}
        return {n: one for n, one in known.items() if isinstance(one, tuple | list)}

    def nuisance(self, name: str, units: tuple[str, str]) -> float:
        """Value of a nuisance that is given, in SI units; `units` are those of axis and quantity.

        Raises
        ------
        DescriptionError
            If it is not finite or positive, or in another unit.
        """
        given, label = getattr(self, name), f"MeasuredCurve({self.name}).{name}"
        unit, factor = self.nuisance_unit(name, units)
        value = parse_difference(given, unit, label)
        value = value if isinstance(given, str) else value * factor
        if math.isnan(value) or (value <= 0.0 and name in ("scale", "stiffness")):
            raise DescriptionError(label, given, "be positive", unit=unit)
        if math.isinf(value) and name != "stiffness":
            raise DescriptionError(label, given, "be finite", unit=unit)
        return value

    def nuisance_unit(self, name: str, units: tuple[str, str]) -> tuple[str, float]:
        """SI unit of a nuisance, and the factor of numbers to it."""
        if name == "stiffness":
            return "N/m", 1.0
        if name == "scale":
            return "-", 1.0
        i = 0 if name == "shift" else 1
        return units[i], self._scales()[i].factor


@frozen(kw_only=True)
class MeasuredBound(Described):
    """A number of the result that is known to lie above or below a value, such as a jump.

    Parameters
    ----------
    quantity : str
        Number of the result: ``break_time``, ``pull_off_force``, ``release_time``.
    least, most : float or str, optional
        Ends, in SI units or as texts with a unit: a jump between two readings lies between their
        positions. At least one of the two.
    noise : float or str
        Standard deviation of the ends; a violation counts by its square in these units, as one
        reading.
    sets : mapping of str to object
        Fields of the scene, by path, as of a `MeasuredCurve`.
    name : str
        Name in tables.

    Raises
    ------
    DescriptionError
        If no end is given, the ends do not rise, or the noise is not positive.

    Examples
    --------
    >>> import contactkit as ck
    >>> ck.MeasuredBound(quantity="release_time", least="2 ms", noise="0.1 ms").name
    'bound'
    """

    quantity: str
    least: Any = None
    most: Any = None
    noise: Any
    sets: Mapping[str, Any] = field(factory=FrozenDict, converter=_frozen_map)
    name: str = "bound"

    def __attrs_post_init__(self) -> None:
        if self.least is None and self.most is None:
            raise DescriptionError("MeasuredBound", "none", "have an end: least, most or both")

    def ends(self, unit: str) -> tuple[float, float, float]:
        """Least, most and noise in the SI unit of the quantity.

        Raises
        ------
        DescriptionError
            If a unit is another one, the ends do not rise, or the noise is not positive.
        """
        label = f"MeasuredBound({self.name})"
        low, high = (
            limit if one is None else parse_quantity(one, unit, f"{label}.{what}")
            for what, one, limit in (
                ("least", self.least, -math.inf),
                ("most", self.most, math.inf),
            )
        )
        noise = parse_quantity(self.noise, unit, f"{label}.noise")
        if not low <= high:
            raise DescriptionError(label, (self.least, self.most), "have ends that rise", unit=unit)
        if not (math.isfinite(noise) and noise > 0.0):
            raise DescriptionError(f"{label}.noise", self.noise, "be positive", unit=unit)
        return low, high, noise


def by_curve(curves: Sequence[MeasuredCurve], rows: Floats) -> list[Floats]:
    """Rows of the residuals of a fit: those of each curve, and last those of bounds and priors."""
    return np.split(rows, np.cumsum([curve.values.size for curve in curves]))
