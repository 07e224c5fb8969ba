"""Ports: what the variables of an FMU are called, mean, and may be.

One table of ports gives the FMU its variables, a CSV file its header and a plot its labels.
All values are in SI units; a display unit only says how a tool should show them.
"""

from __future__ import annotations

import difflib
import math
import re
import sys
from collections.abc import Mapping, Sequence
from enum import IntEnum
from typing import Any, Literal, NamedTuple

from attrs import Attribute, evolve, field, frozen

from ...errors import DescriptionError
from ...units import parse_quantity, parse_unit

__all__ = [
    "Causality",
    "Kind",
    "NATIVE_STEPS",
    "PYTHON_STEPS",
    "Port",
    "STEP_LIMIT",
    "TOLERANCE",
    "Value",
    "Variability",
    "choice_port",
    "display_conversion",
    "find_port",
    "grouped",
    "input_port",
    "output_port",
    "size_port",
    "start_value",
    "step_limit",
    "tabulated_size",
    "tolerance",
]

Causality = Literal["input", "output", "parameter"]
Kind = Literal["real", "integer", "boolean", "enumeration"]
Variability = Literal["fixed", "discrete", "continuous"]
Value = float | int | bool

_LARGEST = {"real": sys.float_info.max, "integer": 2**31 - 1}  # the range of FMI's own types
_SMALLEST = {"real": -sys.float_info.max, "integer": -(2**31)}
_TYPES: dict[str, type[float | int | bool]] = {"real": float, "boolean": bool}


class Limits(NamedTuple):
    """Smallest and largest number that a variable accepts, both included."""

    low: float
    high: float


@frozen
class Port:
    """One variable of an FMU.

    Parameters
    ----------
    name : str
        Name in the FMU; letters, digits, underscores and dots.
    unit : str
        SI unit of the values, ``-`` for none.
    causality : {"input", "output", "parameter"}
        Inputs change while stepping, parameters are fixed when initialization ends.
    label : str
        What the variable is, in words.
    kind : {"real", "integer", "boolean", "enumeration"}
        Type of the values.
    enumeration : type of IntEnum, optional
        The members, for kind ``enumeration``.
    start : float, int or bool, optional
        Value before anything was set or calculated: if not given zero, ``False`` or the first
        member of the enumeration.
    minimum, maximum : float, optional
        Allowed range. An infinite value is allowed only if a bound is infinite.
    exclusive : bool
        The bounds themselves are refused. XML can only say "from 0", the slave says "above 0".
    nominal : float, optional
        A typical size, for a tool that scales its tolerances.
    display_unit : str, optional
        Unit to show the values in, such as ``um``, ``mPa.s``, ``deg``, ``bar`` or ``degC``.
    group : str
        Group of parameters that it belongs to in a dialog; set by `grouped`.
    rate_of : str, optional
        Name of the variable whose derivative by time it is.
    at_events : bool
        A real output that changes at events only, such as the time of a rupture.
    tabulated : bool
        In a native FMU the tables of its scene hold it, or have no such thing, so that it is no
        variable there.
    depends_on : tuple of str, optional
        Inputs and parameters that an output follows without a step in between; ``()`` says
        none. If not given, a tool has to assume all of them.

    Raises
    ------
    DescriptionError
        If the description contradicts itself.

    Examples
    --------
    >>> gap = Port("h0", "m", causality="parameter", label="gap at the start", start=1e-6,
    ...            minimum=0.0, exclusive=True, display_unit="um")
    >>> gap.heading
    'h0 [m]'
    >>> gap.allows(0.0), gap.allows(1e-9), gap.allows(float("nan"))
    (False, True, False)
    """

    name: str = field()
    unit: str = field()
    causality: Causality = field(kw_only=True)
    label: str = field(kw_only=True)
    kind: Kind = field(kw_only=True, default="real")
    enumeration: type[IntEnum] | None = field(kw_only=True, default=None)
    minimum: float | None = field(kw_only=True, default=None)
    maximum: float | None = field(kw_only=True, default=None)
    exclusive: bool = field(kw_only=True, default=False)
    nominal: float | None = field(kw_only=True, default=None)
    display_unit: str | None = field(kw_only=True, default=None)
    group: str = field(kw_only=True, default="")
    rate_of: str | None = field(kw_only=True, default=None)
    at_events: bool = field(kw_only=True, default=False)
    tabulated: bool = field(kw_only=True, default=False)
    depends_on: tuple[str, ...] | None = field(kw_only=True, default=None)
    start: Value = field(kw_only=True)

    @start.default
    def _first(self) -> Value:
        if self.enumeration is not None:
            return min(self.enumeration)
        return _TYPES.get(self.kind, int)()

    @name.validator
    def _check_name(self, _: Attribute[str], value: str) -> None:
        if not re.fullmatch(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*", value, re.ASCII):
            raise DescriptionError("Port.name", value, "be made of letters, digits, _ and dots")

    @enumeration.validator
    def _check_enumeration(self, _: Attribute[Any], value: type[IntEnum] | None) -> None:
        if (self.kind == "enumeration") != (value is not None):
            expected = "be given for kind 'enumeration', and for no other"
            raise DescriptionError(f"Port {self.name!r}.enumeration", value, expected)

    @depends_on.validator
    def _check_depends_on(self, _: Attribute[Any], value: tuple[str, ...] | None) -> None:
        if value is not None and self.causality != "output":
            expected = "be left out, except for outputs"
            raise DescriptionError(f"Port {self.name!r}.depends_on", value, expected)

    @start.validator
    def _check_start(self, _: Attribute[Any], value: Value) -> None:
        self.read(value)
        display_conversion(self.unit, self.display_unit or self.unit)
        if self.unit != "-" and self.kind != "real":
            raise DescriptionError(f"Port {self.name!r}.unit", self.unit, "be '-' unless real")

    @property
    def variability(self) -> Variability:
        """Variability of the variable, in the words of both versions of FMI."""
        if self.causality == "parameter":
            return "fixed"
        return "discrete" if self.kind != "real" or self.at_events else "continuous"

    @property
    def heading(self) -> str:
        """Name and unit, as the head of a column or an axis."""
        return self.name if self.unit == "-" else f"{self.name} [{self.unit}]"

    @property
    def limits(self) -> Limits:
        """Smallest and largest number the slave accepts, both included."""
        if self.kind == "boolean":
            return Limits(False, True)
        if self.enumeration is not None:
            return Limits(min(self.enumeration), max(self.enumeration))
        low = _SMALLEST[self.kind] if self.minimum is None else self.minimum
        high = _LARGEST[self.kind] if self.maximum is None else self.maximum
        if self.exclusive and self.minimum is not None:
            low = low + 1 if self.kind == "integer" else math.nextafter(low, math.inf)
        if self.exclusive and self.maximum is not None:
            high = high - 1 if self.kind == "integer" else math.nextafter(high, -math.inf)
        return Limits(low, high)

    @property
    def expectation(self) -> str:
        """Condition on a value, in words that follow "must"."""
        if self.kind == "boolean":
            return "be true or false"
        if self.enumeration is not None:
            return "be " + " or ".join(f"{int(m)} ({m.name})" for m in self.enumeration)
        bounds = []
        if self.minimum is not None:
            bounds.append(f"{'above' if self.exclusive else 'at least'} {self.minimum:g}")
        if self.maximum is not None:
            bounds.append(f"{'below' if self.exclusive else 'at most'} {self.maximum:g}")
        number = "whole" if self.kind == "integer" else "finite"
        return f"be a {number} number {' and '.join(bounds)}".rstrip()

    def allows(self, value: float) -> bool:
        """Whether a number lies in the allowed range; never for nan."""
        if self.enumeration is not None:
            return value in [int(member) for member in self.enumeration]
        low, high = self.limits
        return low <= value <= high

    def read(self, value: object) -> Value:
        """Turn a value into the type of this port; a member of an enumeration may be named.

        Raises
        ------
        DescriptionError
            If the value is of another type or out of range.
        """
        given = value
        if self.enumeration is not None and isinstance(value, str):
            value = self.enumeration.__members__.get(value)
        if isinstance(value, bool) is (self.kind == "boolean") and isinstance(value, int | float):
            whole = self.kind in ("real", "boolean") or value % 1 == 0  # False for inf and nan
            if whole and self.allows(value):
                return _TYPES.get(self.kind, int)(value)
        unit = "" if self.unit == "-" else self.unit
        raise DescriptionError(self.name, given, self.expectation, unit=unit)


def input_port(name: str, unit: str, label: str, **more: Any) -> Port:
    """Input of a slave; `more` are parameters of `Port`.

    Examples
    --------
    >>> input_port("v", "m/s", "opening speed", nominal=0.1).causality
    'input'
    """
    return Port(name, unit, causality="input", label=label, **more)


def output_port(
    name: str, unit: str, label: str, depends_on: tuple[str, ...] = (), **more: Any
) -> Port:
    """Output of a slave, with what it follows without a step in between; `more` as in `Port`.

    Examples
    --------
    >>> output_port("F_spring", "N", "force of the spring", ("h",)).depends_on
    ('h',)
    """
    return Port(name, unit, causality="output", label=label, depends_on=depends_on, **more)


def size_port(
    name: str, unit: str, label: str, start: float, display_unit: str | None = None, **more: Any
) -> Port:
    """Parameter that is zero or positive; `more` as in `Port`, `exclusive` refuses zero.

    Examples
    --------
    >>> size_port("m", "kg", "moving mass", 0.02, "g", exclusive=True).expectation
    'be a finite number above 0'
    """
    return Port(
        name,
        unit,
        causality="parameter",
        label=label,
        start=start,
        minimum=0.0,
        display_unit=display_unit,
        **more,
    )


def tabulated_size(
    name: str, unit: str, label: str, start: float = 0.0, shown: str | None = None, **more: Any
) -> Port:
    """As `size_port`, of what a native FMU has in its tables; off by default."""
    return size_port(name, unit, label, start, shown, tabulated=True, **more)


def choice_port(name: str, label: str, start: IntEnum, **more: Any) -> Port:
    """Parameter that is one of an enumeration; `more` as in `Port`.

    Examples
    --------
    >>> class Law(IntEnum):
    ...     NONE = 1
    ...     EXACT = 2
    >>> choice_port("law", "law that holds", Law.NONE).start
    <Law.NONE: 1>
    """
    return Port(
        name,
        "-",
        causality="parameter",
        kind="enumeration",
        enumeration=type(start),
        label=label,
        start=start,
        **more,
    )


TOLERANCE = "rtol"
"""Parameter that the tolerance of an experiment stands for, unless it is set."""

STEP_LIMIT = "max_steps"
"""Parameter that bounds the internal steps of one communication step."""

PYTHON_STEPS, NATIVE_STEPS = 30_000, 100_000
"""What it is if it is not set: at most some seconds in Python (1.5 s of a tip), 0.1 to 0.2 s in C.

In one step of 1 s a pull on a stiff film takes 100 to 250, one at which it cavitates 5000, and 80
swings on a spring 20 000; three to five times as many with ``rtol = 1e-11``.
"""


def tolerance(start: float) -> Port:
    """Parameter `rtol`, the relative tolerance of the steps inside an FMU.

    Below 1e-11 round-off hides the error that is controlled.
    """
    return Port(
        TOLERANCE,
        "-",
        causality="parameter",
        label="tolerance of an internal step; that of the experiment if not set",
        start=start,
        minimum=1e-11,
        maximum=0.1,
    )


def step_limit(start: int) -> Port:
    """Parameter `max_steps`: bounds what one step of the host may cost, in internal steps.

    One while a film is cavitated counts as twenty, as it costs.
    """
    return Port(
        STEP_LIMIT,
        "-",
        causality="parameter",
        label="most internal steps of one communication step, one of a cavitated film counts as 20",
        kind="integer",
        start=start,
        minimum=1,
        maximum=1_000_000_000,
    )


class Conversion(NamedTuple):
    """Factor and offset from a unit to the unit that is shown."""

    factor: float
    offset: float


def display_conversion(unit: str, display_unit: str) -> Conversion:
    """Factor and offset from a unit to the unit that is shown.

    Raises
    ------
    DescriptionError
        If the two units do not measure the same thing.

    Examples
    --------
    >>> display_conversion("Pa.s", "mPa.s")
    Conversion(factor=1000.0, offset=0.0)
    >>> display_conversion("K", "degC").offset
    -273.15
    """
    if (unit, display_unit) == ("K", "degC"):
        return Conversion(1.0, -273.15)
    own, shown = parse_unit(unit), parse_unit(display_unit)
    if own.dimension != shown.dimension:
        raise DescriptionError("display unit", display_unit, f"measure the same as {unit}")
    # without the round-off of the division
    return Conversion(float(f"{own.factor / shown.factor:.15g}"), 0.0)


_FORMER = {"dp_tear": "dp_inception"}  # variables of earlier FMUs, as start values may name them


def find_port(ports: Sequence[Port], name: str) -> Port:
    """Return the port of that name.

    Raises
    ------
    DescriptionError
        If there is none; the nearest name is suggested.
    """
    for port in ports:
        if port.name == name:
            return port
    if name in _FORMER:
        raise DescriptionError("port", name, f"be {_FORMER[name]!r}, its name now")
    names = [port.name for port in ports]
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    hint = f"did you mean {near[0]!r}?" if near else "there are " + ", ".join(names)
    raise DescriptionError("port", name, "be a variable of this FMU", hint=hint)


def grouped(ports: Sequence[Port], groups: Mapping[str, Sequence[str]]) -> tuple[Port, ...]:
    """Ports whose parameters are in groups, and in their order, as a dialog shows them.

    Parameters
    ----------
    ports : sequence of Port
        Inputs and outputs keep their order, and come first.
    groups : mapping of str to sequence of str
        Names of the parameters in each group.

    Raises
    ------
    DescriptionError
        If a parameter is in no group, or a name is none of a parameter.
    """
    others = [port for port in ports if port.causality != "parameter"]
    left = {port.name: port for port in ports if port.causality == "parameter"}
    names = [name for members in groups.values() for name in members]
    if set(names) != set(left) or len(names) != len(left):
        odd = sorted(set(names) ^ set(left))
        raise DescriptionError("grouped(groups)", odd, "name every parameter once, and no other")
    for group, members in groups.items():
        others += [evolve(left[name], group=group) for name in members]
    return tuple(others)


def start_value(ports: Sequence[Port], name: str, value: Value | str) -> Value:
    """Start value of a variable that is no output; a text carries its unit."""
    port = find_port(ports, name)
    if port.causality == "output":
        raise DescriptionError(name, value, "be left to the model, because it is an output")
    if isinstance(value, str) and port.kind == "real":
        return port.read(parse_quantity(value, port.unit, name))
    return port.read(value)
