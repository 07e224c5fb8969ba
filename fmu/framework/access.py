"""Reading and writing the variables of a slave, and telling the host what went wrong.

Masters call these functions several times in every step, so the usual case is a look-up in a
table; whatever falls out of the table is sorted out afterwards.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from .ports import Port, Value, find_port
from .tables import Settable, Tables

__all__ = ["PortAccess"]


class PortAccess(Fmi2Slave):  # type: ignore[misc]  # pythonfmu has no types
    """The part of a slave that holds the values of its ports; see `slave.PortSlave`."""

    ports: ClassVar[tuple[Port, ...]] = ()
    baked: ClassVar[Mapping[str, Value]] = {}
    data: ClassVar[Mapping[str, Any]] = {}  # tables of this build
    log_categories: ClassVar[dict[str, str]] = Fmi2Slave.log_categories | {
        "logEvents": "What happened in the model, such as a release or a rupture.",
        "logCoupling": "Doubts about the coupling, such as steps that are too long.",
    }
    _tables: ClassVar[Tables] = Tables(())

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        if "ports" in cls.__dict__:  # one that inherits them shares their tables
            cls._tables = Tables(cls.ports)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.values: dict[str, Any] = self.start_values()
        self.failure = ""
        self._open: Mapping[str, Settable] = self._tables.settable
        self._follows = False  # outputs answer to what is set without a step in between
        self._stale = False  # and something was set since they last did
        self._phase = ""
        self._given = set(self.baked)  # variables that were given a value

    @classmethod
    def start_values(cls) -> dict[str, Value]:
        """Start value of every port, baked values included."""
        values = {port.name: port.read(port.start) for port in cls.ports}
        for name, value in cls.baked.items():
            values[name] = find_port(cls.ports, name).read(value)
        return values

    def event(self, message: str) -> None:
        """Log something that happened in the model, in category ``logEvents``."""
        self.log(message, Fmi2Status.ok, "logEvents")

    def warn_coupling(self, message: str) -> None:
        """Log a doubt about the coupling, in category ``logCoupling``."""
        self.log(message, Fmi2Status.warning, "logCoupling")

    def log(
        self, msg: str, status: Any = Fmi2Status.ok, category: str | None = None, debug: Any = None
    ) -> None:
        """Log a message; hosts hand it to ``printf``, so percent signs are doubled."""
        text = msg.replace("%", "%%").encode(errors="replace").decode()
        super().log(text, status, category, debug)

    def _fail(self, message: str) -> None:
        if not self.failure:  # the first failure explains those that follow
            self.failure = message
            self._open = self._tables.closed
            self.log(message, Fmi2Status.error, "logStatusError")

    def _follow(self) -> None:
        """Bring outputs up to date with what was set; filled in by `slave.PortSlave`."""

    def get_real(self, vrs: Sequence[int]) -> list[float]:
        """Values of real variables."""
        try:
            if self._stale:
                self._follow()
            values, names = self.values, self._tables.names["real"]
            return [values[names[reference]] for reference in vrs]
        except (KeyError, KeyboardInterrupt):
            return self._get_known("real", vrs, 0.0)

    def get_integer(self, vrs: Sequence[int]) -> list[int]:
        """Values of integer and enumeration variables."""
        try:
            if self._stale:
                self._follow()
            values, names = self.values, self._tables.names["integer"]
            return [int(values[names[reference]]) for reference in vrs]
        except (KeyError, KeyboardInterrupt):
            return self._get_known("integer", vrs, 0)

    def get_boolean(self, vrs: Sequence[int]) -> list[bool]:
        """Values of boolean variables."""
        try:
            if self._stale:
                self._follow()
            values, names = self.values, self._tables.names["boolean"]
            return [bool(values[names[reference]]) for reference in vrs]
        except (KeyError, KeyboardInterrupt):
            return self._get_known("boolean", vrs, False)

    def get_string(self, vrs: Sequence[int]) -> list[str]:
        """Refuse: no port is a string."""
        return self._get_known("string", vrs, "") if vrs else []

    def _get_known(self, kind: str, vrs: Sequence[int], nothing: Any) -> list[Any]:
        """Values of those that exist; pythonfmu needs an answer for the others, too."""
        names = self._tables.names.get(kind, {})
        unknown = [reference for reference in vrs if reference not in names]
        odd = f"value reference {unknown[0]} is not a {kind} variable" if unknown else "interrupted"
        self._fail(f"{odd}; reset the FMU and keep to the variables of its model description")
        return [self.values.get(names.get(reference, ""), nothing) for reference in vrs]

    def set_real(self, vrs: Sequence[int], values: Sequence[float]) -> None:
        """Set real inputs, or parameters before initialization ends."""
        own, settable = self.values, self._open["real"]
        try:
            for reference, value in zip(vrs, values, strict=True):
                name, low, high = settable[reference]
                if not low <= value <= high:  # nan is not, either
                    self._refuse("real", vrs, values)
                    return
                own[name] = value
        except (KeyError, KeyboardInterrupt):
            self._refuse("real", vrs, values)
        self._stale = self._follows
        if self._open is self._tables.settable:
            self._given.update(settable[reference][0] for reference in vrs if reference in settable)

    def set_integer(self, vrs: Sequence[int], values: Sequence[int]) -> None:
        """Set integer and enumeration inputs, or parameters before initialization ends."""
        self._set_checked("integer", vrs, values)

    def set_boolean(self, vrs: Sequence[int], values: Sequence[bool]) -> None:
        """Set boolean inputs, or parameters before initialization ends."""
        self._set_checked("boolean", vrs, [bool(value) for value in values])

    def set_string(self, vrs: Sequence[int], values: Sequence[str]) -> None:
        """Refuse: no port is a string."""
        if vrs:
            self._refuse("string", vrs, values)

    def _set_checked(self, kind: str, vrs: Sequence[int], values: Sequence[int]) -> None:
        settable = self._open[kind]
        for reference, value in zip(vrs, values, strict=True):
            if reference not in settable or not self._tables.ports[reference].allows(value):
                self._refuse(kind, vrs, values)
                return
            self.values[settable[reference][0]] = value
        self._stale = self._follows

    def _refuse(self, kind: str, vrs: Sequence[int], values: Sequence[Any]) -> None:
        if self.failure:
            return
        for reference, value in zip(vrs, values, strict=True):
            reason = self._tables.refusal(kind, reference, value, self._phase)
            if reason:
                self._fail(reason)
                return
        self._fail("interrupted; reset the FMU")
