"""Properties of a liquid over the temperature, for kernels: cubics through their logarithms."""

from __future__ import annotations

import math
import warnings

from attrs import frozen

from ..errors import ValidityWarning
from .liquid import Liquid
from .temperature_laws import TemperatureLaw

__all__ = ["LiquidTable", "liquid_table"]

_PROPERTIES = ("viscosity", "surface_tension", "density")
_FINER = 8  # places between two nodes at which the error is measured
_NODES = 65  # of an oil over 170 K: the viscosity to 1e-6


@frozen
class LiquidTable:
    """Logarithms of the properties of a liquid at equally spaced temperatures."""

    low: float
    high: float
    logs: dict[str, list[float]]
    error: float
    """Largest relative error between the temperatures [-], measured."""

    def at(self, name: str, temperature: float) -> float:
        """A property at a temperature [K]: the cubic through the four nearest nodes."""
        return math.exp(_cubic(self.logs[name], self.low, self.high, temperature))


def _cubic(values: list[float], low: float, high: float, x: float) -> float:
    """Lagrange's cubic through the four nodes around x, as in JavaScript and C."""
    place = (x - low) / (high - low) * (len(values) - 1)
    first = min(max(int(place) - 1, 0), len(values) - 4)
    t, (a, b, c, d) = place - first, values[first : first + 4]
    return (
        -a * (t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0
        + b * t * (t - 2.0) * (t - 3.0) / 2.0
        - c * t * (t - 1.0) * (t - 3.0) / 2.0
        + d * t * (t - 1.0) * (t - 2.0) / 6.0
    )


def liquid_table(liquid: Liquid) -> LiquidTable | None:
    """Properties over the range that all laws of a liquid were fitted in; None if it has no law."""
    given = (getattr(liquid, name) for name in (*_PROPERTIES, "kinematic_viscosity"))
    laws = [law for law in given if isinstance(law, TemperatureLaw)]
    if not laws:
        return None
    low = max(law.temperature_min for law in laws)
    high = min(law.temperature_max for law in laws)

    def logs(count: int) -> dict[str, list[float]]:
        places = [low + (high - low) * i / (count - 1) for i in range(count)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # round-off at the ends
            states = [liquid.at(place) for place in places]
        known = {name: [state.given(name) for state in states] for name in _PROPERTIES}
        return {
            name: [math.log(value) for value in values if value is not None]
            for name, values in known.items()
            if None not in values
        }

    fine = logs(_FINER * (_NODES - 1) + 1)
    coarse = {name: values[::_FINER] for name, values in fine.items()}
    count = len(next(iter(fine.values()))) - 1
    error = max(
        abs(_cubic(coarse[name], low, high, low + (high - low) * i / count) - value)
        for name, values in fine.items()
        for i, value in enumerate(values)
    )
    return LiquidTable(low, high, coarse, error)
