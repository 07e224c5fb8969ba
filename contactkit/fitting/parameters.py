"""Parameters of a fit: paths of a scene and nuisances, their bounds, scaling and prior."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from attrs import frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..studies.paths import axes, check_apart, joined, value_at
from ..studies.sensitivity import Range
from ..units import parse_difference, parse_quantity

__all__ = ["Parameter", "Prior", "by_path", "nuisance_parameter", "scene_parameters"]

# Ratio of the ends from which a parameter is fitted by its logarithm: over a decade or more a step
# that suits the upper end is as large as the lower one.
_WIDE = 10.0
# Standard deviations of a prior within which its parameter is sought; beyond lies 6e-7 of it.
_DEVIATIONS = 5.0
# Least value of a positive parameter with a wide prior, as a fraction of its most probable one:
# below zero most fields are refused.
_LEAST = 0.01


class Prior(NamedTuple):
    """Value of a parameter that is known from elsewhere, with its standard deviation.

    It counts as one more datum; the parameter stays within 5 standard deviations.

    Parameters
    ----------
    value : float or str
        Most probable value, in SI units or as a text with a unit.
    deviation : float or str
        Standard deviation, in SI units, as a text with a unit or in percent of the value.
    reason : str
        Where it is known from: a rheometer, a datasheet, the calibration of a spring.

    Examples
    --------
    >>> Prior("0.1 Pa.s", "5 %", "rheometer").deviation
    '5 %'
    """

    value: Any
    deviation: Any
    reason: str = ""


@frozen
class Parameter:
    """A number that is sought between two bounds.

    Attributes
    ----------
    name : str
        Its path, paths separated by commas that have one value, or the name of a nuisance.
    paths : tuple of str
        Where it goes in the scene; empty for a nuisance.
    unit : str
        SI unit.
    low, high, start : float
        Bounds, and where the search starts.
    prior : (float, float) or None
        Most probable value and standard deviation, if it is known from elsewhere.
    reason : str
        Why the range or the prior is plausible.
    """

    name: str
    paths: tuple[str, ...]
    unit: str
    low: float
    high: float
    start: float
    prior: tuple[float, float] | None = None
    reason: str = ""

    @property
    def is_log(self) -> bool:
        """Whether the logarithm is fitted: the range spans a decade or more."""
        return self.low > 0.0 and self.high >= _WIDE * self.low

    @property
    def short(self) -> str:
        """End of its path, for tables and figures."""
        return self.name.partition(",")[0].rpartition(".")[2]

    def scaled(self, value: float) -> float:
        """Coordinate of a value: its logarithm, or its place in the range from 0 to 1.

        Examples
        --------
        >>> Parameter("a", (), "m", 1.0, 3.0, 1.0).scaled(2.0)
        0.5
        """
        if self.is_log:
            return math.log(value)
        return (value - self.low) / (self.high - self.low)

    def value(self, place: float) -> float:
        """Value of a coordinate, within the bounds to the last bit.

        Examples
        --------
        >>> Parameter("a", (), "m", 1.0, 100.0, 1.0).value(0.0)
        1.0
        """
        found = math.exp(place) if self.is_log else self.low + place * (self.high - self.low)
        return min(max(found, self.low), self.high)

    def slope(self, place: float) -> float:
        """Derivative of the value to the coordinate."""
        return self.value(place) if self.is_log else self.high - self.low

    @property
    def ends(self) -> tuple[float, float]:
        """Coordinates of the bounds."""
        return self.scaled(self.low), self.scaled(self.high)


def scene_parameters(
    scene: Any, accuracy: Accuracy, given: Mapping[Any, Any]
) -> tuple[Parameter, ...]:
    """Parse the parameters of a fit that are fields of its scene.

    Parameters
    ----------
    scene : object
        The scene, or the device, that the paths refer to.
    accuracy : Accuracy
        Settings of its runs.
    given : mapping of str or tuple of str to Range or Prior
        By path as in `study`; several paths have one value.

    Raises
    ------
    DescriptionError
        If a path does not exist, is no number, is given twice or inside another, or a range is
        empty.

    Examples
    --------
    >>> import contactkit as ck
    >>> film = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    >>> both = ("contact_angle_lower", "contact_angle_upper")
    >>> made = scene_parameters(film, ck.Accuracy(), {
    ...     "liquid.viscosity": ck.Range("10 mPa.s", "1 Pa.s"), both: ck.Range("5 deg", "20 deg")})
    >>> [(one.name, one.is_log, one.start) for one in made][0]
    ('liquid.viscosity', True, 0.1)
    """
    if not isinstance(given, Mapping):
        raise DescriptionError("parameters", given, "be a mapping of paths to ranges")
    found = tuple(_of_scene(scene, accuracy, joined(k, "parameters"), v) for k, v in given.items())
    check_apart([path for one in found for path in one.paths], "parameters")
    return found


def _of_scene(scene: Any, accuracy: Accuracy, name: str, given: Any) -> Parameter:
    origin = f"parameters[{name!r}]"
    low, high, prior, reason = _ends_of(origin, given)
    paths = [path.strip() for path in name.split(",")]
    units, values = set[str](), list[Any]()
    for path in paths:
        (axis,) = axes(scene, accuracy, {path: [low] if high is None else [low, high]})
        units.add(axis.units[0])
        values = [row[0] for row in axis.values]
    for one in values:
        if isinstance(one, bool) or not isinstance(one, float):
            hint = "names and whole numbers cannot be fitted: compare fits of scenes with each"
            raise DescriptionError(origin, one, "be a real number", hint=hint)
    if len(units) > 1:
        raise DescriptionError(origin, ", ".join(sorted(units)), "have paths of one unit")
    unit, now = units.pop(), value_at(scene, accuracy, paths[0])
    start = now if isinstance(now, float) else None
    if high is None:
        return _of_prior(name, tuple(paths), unit, values[0], prior, reason)
    return _of_range(name, tuple(paths), unit, (values[0], values[1]), start, reason)


def _ends_of(origin: str, given: Any) -> tuple[Any, Any, Any, str]:
    """Ends of a range, or the value of a prior without a second end and its deviation."""
    if isinstance(given, Prior):
        return given.value, None, given.deviation, given.reason
    if isinstance(given, tuple | list) and 2 <= len(given) <= 3:
        made = Range(*given)
        return made.low, made.high, None, made.reason
    raise DescriptionError(origin, given, "be a Range, a pair (low, high) or a Prior")


def _of_range(
    name: str,
    paths: tuple[str, ...],
    unit: str,
    ends: tuple[float, float],
    start: float | None,
    reason: str,
) -> Parameter:
    low, high = ends
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        hint = "give finite ends: nothing is sought without bounds"
        raise DescriptionError(f"parameters[{name!r}]", ends, "rise", unit=unit, hint=hint)
    made = Parameter(name, paths, unit, low, high, low, reason=reason)
    bottom, top = made.ends
    inside = start is not None and low < start < high
    value = start if inside and start is not None else made.value(0.5 * (bottom + top))
    return Parameter(name, paths, unit, low, high, value, reason=reason)


def _of_prior(
    name: str, paths: tuple[str, ...], unit: str, value: float, given: Any, reason: str
) -> Parameter:
    origin = f"parameters[{name!r}].deviation"
    if isinstance(given, str) and given.strip().endswith("%"):
        deviation = abs(value) * parse_quantity(given, "-", origin)
    else:
        deviation = parse_difference(given, unit, origin)
    if not (math.isfinite(deviation) and deviation > 0.0):
        raise DescriptionError(origin, given, "be positive and finite", unit=unit)
    low, high = value - _DEVIATIONS * deviation, value + _DEVIATIONS * deviation
    if value > 0.0:
        low = max(low, _LEAST * value)
    return Parameter(name, paths, unit, low, high, value, (value, deviation), reason)


_NEUTRAL = {"shift": 0.0, "zero": 0.0, "scale": 1.0}


def nuisance_parameter(name: str, unit: str, given: Any, factor: float = 1.0) -> Parameter:
    """Parse a nuisance that is sought; numbers are times `factor` in its SI unit.

    The search starts from no shift and a scale of 1 where the range has them.

    Raises
    ------
    DescriptionError
        If the range is empty, or a unit is another one.
    """
    origin = f"nuisance[{name!r}]"
    low, high, deviation, reason = _ends_of(origin, given)

    def number(value: Any) -> float:
        found = parse_difference(value, unit, origin)
        return found if isinstance(value, str) else factor * found

    if high is None:
        is_relative = isinstance(deviation, str) and deviation.strip().endswith("%")
        spread = deviation if is_relative else number(deviation)
        return _of_prior(name, (), unit, number(low), spread, reason)
    start = _NEUTRAL.get(name.rpartition(".")[2])
    return _of_range(name, (), unit, (number(low), number(high)), start, reason)


def by_path(parameters: tuple[Parameter, ...], values: tuple[float, ...]) -> Iterator[Any]:
    """Pairs of path and value of the parameters that are fields of the scene."""
    for one, value in zip(parameters, values, strict=True):
        yield from ((path, value) for path in one.paths)
