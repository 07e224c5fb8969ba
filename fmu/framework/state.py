"""The state of a slave as plain data: taken, written as bytes, checked when it comes back.

A state is a mapping of JSON values. It names the build it was taken from, so that a state of
other code or of other start values is refused instead of half understood.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Any

from ...errors import DescriptionError
from .ports import Port

__all__ = ["Phase", "Snapshot", "check_state", "from_bytes", "plain", "to_bytes"]

_FIELDS = {
    "build",
    "phase",
    "prepared",
    "stale",
    "failure",
    "time",
    "start_time",
    "stop_time",
    "values",
    "hidden",
}
_CURE = "take the state from this FMU, and keep its bytes unchanged"


class Phase(StrEnum):
    """Phase in the life cycle of an FMU."""

    INSTANTIATED = "instantiated"
    INITIALIZATION = "initialization"
    STEPPING = "stepping"
    TERMINATED = "terminated"


class Snapshot(dict[str, Any]):
    """A state taken in this process by this code, which needs no checking when restored."""


def plain(value: Any) -> Any:
    """Copy of JSON data in Python's own types; anything else is refused.

    Raises
    ------
    DescriptionError
        If the value could not be written to a file and read back.
    """
    if value is None or type(value) in (float, int, bool, str):
        return value
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    for kind in (str, int, float):  # members of enumerations derive from these
        if isinstance(value, kind):
            return kind(value)
    if hasattr(value, "item") and getattr(value, "ndim", 1) == 0:  # a scalar of numpy
        return value.item()
    raise DescriptionError("hidden state", value, "be numbers, texts, true, false or None")


def to_bytes(state: Mapping[str, Any]) -> bytes:
    """JSON bytes of a state; floats come back exactly, infinity included."""
    return json.dumps(state, separators=(",", ":")).encode()


def from_bytes(data: bytes) -> dict[str, Any]:
    """State of JSON bytes; what cannot be read becomes a state that `check_state` refuses."""
    try:
        state = json.loads(data)
    except (ValueError, RecursionError) as error:
        return {"unreadable": str(error)}
    return state if isinstance(state, dict) else {"unreadable": f"a {type(state).__name__}"}


def check_state(state: Any, build: str, ports: Sequence[Port]) -> None:
    """Refuse a state that is malformed or was taken from another build.

    Raises
    ------
    DescriptionError
        Saying what is wrong with it.
    """
    if not isinstance(state, dict) or set(state) != _FIELDS:
        what = state.get("unreadable", "other fields") if isinstance(state, dict) else state
        raise DescriptionError("FMU state", what, "be one of this FMU", hint=_CURE)
    if state["build"] != build:
        raise DescriptionError("FMU state", state["build"], f"be of build {build}", hint=_CURE)
    for name in ("time", "start_time"):
        if not isinstance(state[name], float) or not math.isfinite(state[name]):
            raise DescriptionError(f"{name} of the FMU state", state[name], "be finite", hint=_CURE)
    stop = state["stop_time"]
    if not (stop is None or isinstance(stop, float)):
        raise DescriptionError("stop_time of the FMU state", stop, "be a number", hint=_CURE)
    if state["phase"] not in list(Phase):
        raise DescriptionError("phase of the FMU state", state["phase"], "be known", hint=_CURE)
    types = {
        "prepared": bool,
        "stale": bool,
        "failure": str,
        "values": dict,
        "hidden": dict,
    }
    for name, kind in types.items():
        if not isinstance(state[name], kind):
            expected = f"be a {kind.__name__}"
            raise DescriptionError(f"{name} of the FMU state", state[name], expected, hint=_CURE)
    names = {port.name for port in ports}
    if set(state["values"]) != names:
        odd = sorted(set(state["values"]) ^ names)
        raise DescriptionError("FMU state", odd, "hold every variable, and no other", hint=_CURE)
    for port in ports:
        _check_value(port, state["values"][port.name])


def _check_value(port: Port, value: Any) -> None:
    if port.causality != "output":
        port.read(value)
        return
    fine = isinstance(value, bool) is (port.kind == "boolean") and isinstance(value, int | float)
    if not fine or not (math.isfinite(value) or port.allows(value)):
        raise DescriptionError(f"{port.name} of the FMU state", value, f"be a {port.kind}")
