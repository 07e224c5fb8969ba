"""`PortSlave`: an FMI 2.0 co-simulation slave whose variables are a table of ports.

pythonfmu hands every call of the host to Python as it comes. A Python exception that leaves a
callback is fatal there and frees the instance, and the next call crashes the host. So nothing is
raised here. A step that cannot be taken is discarded: its reason is logged, nothing has changed,
and a shorter one may do. Any other failure is logged with its cure and remembered: outputs stay at
their last good values, and every later step is answered with ``fmi2Discard`` until the host resets
the slave or goes back to an earlier state.
"""

from __future__ import annotations

import sys
import traceback
from abc import abstractmethod
from collections.abc import Callable, Mapping
from itertools import pairwise
from math import inf, isfinite
from typing import Any, ClassVar
from xml.etree.ElementTree import Element

from pythonfmu import __version__ as pythonfmu_version
from pythonfmu.enums import Fmi2Status

from ...errors import ContactkitError
from .access import PortAccess
from .description import Description, model_description
from .places import Place, in_parameters
from .ports import STEP_LIMIT, TOLERANCE, Value
from .state import Phase, Snapshot, check_state, from_bytes, plain, to_bytes

__all__ = ["PortSlave"]

_CURE = "reset the FMU, or go back to an earlier state"
_STEPPING = Phase.STEPPING  # looked up once
_CLOCK = 16.0 * sys.float_info.epsilon  # fraction of the time by which two clocks may differ
_REST = 1e-9  # fraction of a step up to which another is put off, as masters end with round-off
_OFF = 1e-6  # fraction of a step by which it may start or end off its time


class PortSlave(PortAccess):
    """An FMI 2.0 slave made of its table of `ports` and the hooks of its subclass.

    A subclass defines `ports`, reads and writes `values` by name, and fills in `prepare` and
    `advance`; if anything changes that is not in `values`, also `hidden_state` and
    `restore_hidden_state`. Hooks may raise; the head of this module says what happens then.

    Attributes
    ----------
    ports : tuple of Port
        Every variable of the FMU, in order.
    summary : str
        One line on the model, for tools.
    places : mapping of str to Place
        Fields of a scene that parameters stand for, by which messages call them.
    experiment : mapping
        ``startTime``, ``stopTime``, ``stepSize``, ``tolerance`` to suggest to a tool.
    build : str
        Hash of the FMU this class was built for.
    made_with : str
        Version of contactkit that built it.
    baked : mapping
        Start values that replace those of the ports.
    values : dict
        The value of every port, by name.
    time, start_time : float
        End of the last step, and where the host started [s].
    stop_time, tolerance : float or None
        What the host announced, if it did.
    failure : str
        What went wrong; empty as long as all is well.
    """

    summary: ClassVar[str] = ""
    places: ClassVar[Mapping[str, Place]] = {}
    experiment: ClassVar[Mapping[str, float]] = {}
    build: ClassVar[str] = "0" * 64
    made_with: ClassVar[str] = ""  # pythonfmu has a `version` of its own

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.time = self.start_time = 0.0
        self.stop_time: float | None = None
        self.tolerance: float | None = None
        self._prepared: tuple[Any, ...] | None = None  # the parameters `prepare` last ran with
        self._last_step = 0.0
        self._enter(Phase.INSTANTIATED)

    # hooks -----------------------------------------------------------------------------------

    @classmethod
    def check_start(cls, values: Mapping[str, Value]) -> None:
        """Refuse start values that contradict each other, when an FMU is built.

        Raises
        ------
        DescriptionError
            Naming the two.
        """

    def prepare(self) -> None:
        """Build what follows from the parameters, and set the outputs at the start.

        Called with all values in range when initialization ends; before that also whenever a
        tool reads outputs, and after a state was restored: so it starts from `values` alone.
        """

    @abstractmethod
    def advance(self, time: float, step: float) -> None:
        """Go from `time` to ``time + step`` [s] and set the outputs there.

        What it changes besides `values` is replaced, not changed in place: where it raises, all
        attributes are put back.
        """

    def refresh(self) -> None:
        """Let outputs follow inputs set since the last step, where they depend on them."""

    def hidden_state(self) -> Mapping[str, Any]:
        """Everything that changes besides `values`: numbers, texts, None, and lists of these."""
        return {}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        """Restore what `hidden_state` gave; `values` and `prepare` are done already."""

    # life cycle ------------------------------------------------------------------------------

    def _enter(self, phase: Phase) -> None:
        self._phase: Phase = phase
        tables = self._tables
        if self.failure or phase is Phase.TERMINATED:
            self._open = tables.closed
        else:
            self._open = tables.inputs if phase is Phase.STEPPING else tables.settable
        has_feedthrough = type(self).refresh is not PortSlave.refresh
        self._stale = phase is Phase.INITIALIZATION
        self._follows = self._stale or (has_feedthrough and phase is Phase.STEPPING)

    def _is_in(self, phase: Phase, call: str) -> bool:
        if self._phase is not phase:
            self._fail(f"{call} belongs to phase {phase}, the FMU is {self._phase}; reset it")
        return self._phase is phase

    def _attempt(self, name: str, hook: Callable[..., None]) -> bool:
        """Run a hook; on trouble put everything back as it was, and fail."""
        error = self._try(hook)
        if error is not None:
            self._fail(f"{name} at t = {self.time!r} s: {self._explain(error)}; {_CURE}")
        return error is None

    def _try(self, hook: Callable[..., None], *given: float) -> BaseException | None:
        values, owned = self.values, self.__dict__.copy()
        saved = values.copy()
        try:
            hook(*given)
            self._tables.check_outputs(values)
        except BaseException as error:  # noqa: BLE001  # even an interrupt would crash the host
            self.__dict__.update(owned)
            values.clear()
            values.update(saved)
            return error
        return None

    def _explain(self, error: BaseException) -> str:
        """Message of an error: its own words if it is ours, else with a traceback.

        Numbers that leave the range of floats are no defect: Python raises where C has inf.
        """
        if isinstance(error, ContactkitError):
            text = in_parameters(self.places, str(error))
            if TOLERANCE not in self.values:  # what is integrated has a tolerance of its own
                text = text.replace("; loosen Accuracy.time_rtol", "")
            text = text.replace("Accuracy.time_rtol", TOLERANCE)
            return text.replace("Accuracy.max_steps", STEP_LIMIT)
        if isinstance(error, ArithmeticError):
            return f"the forces are no finite numbers ({error}); give less extreme values"
        trace = "".join(traceback.format_exception(error))
        return f"unexpected {type(error).__name__}: {error}\n{trace}"

    def _discard(self, reason: str) -> bool:
        """Log why a step is not taken; nothing has changed, and another one may be."""
        self.log(reason, Fmi2Status.discard, "logStatusError")
        return False

    def _follow(self) -> None:
        self._stale = False
        if self.failure:
            return
        if self._phase is Phase.STEPPING:
            self._attempt("direct feedthrough", self.refresh)
            return
        error = self._try(self.prepare)
        if error is not None:  # a tool may still be half way through its parameters
            reason = f"no outputs yet: {self._explain(error)}"
            self.log(reason, Fmi2Status.warning, "logStatusWarning")

    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Note what the host announces: no step goes beyond the stop time."""
        if not self._is_in(Phase.INSTANTIATED, "setupExperiment"):
            return
        if not isfinite(start_time):
            self._fail(f"start time must be finite [s], got {start_time!r}; reset the FMU")
        elif stop_time is not None and not stop_time >= start_time:
            self._fail(
                f"stop time must not come before the start time {start_time!r} s, got "
                f"{stop_time!r} s; reset the FMU"
            )
        elif tolerance is not None and not 0.0 <= tolerance < inf:
            self._fail(
                f"tolerance must be a finite number above 0, got {tolerance!r}; reset the FMU"
            )
        else:
            self.time = self.start_time = start_time
            self.stop_time, self.tolerance = stop_time, tolerance
            self._take_tolerance(tolerance or 0.0)

    def _take_tolerance(self, tolerance: float) -> None:
        """Take the tolerance of the host for `rtol`, unless that was set; 0: there is none."""
        port = next((port for port in self.ports if port.name == TOLERANCE), None)
        if port is None or not tolerance or TOLERANCE in self._given:
            return
        low, high = port.limits
        self.values[TOLERANCE] = taken = min(max(tolerance, low), high)
        if taken != tolerance:
            self.log(
                f"the tolerance of the experiment, {tolerance:g}, is none that {TOLERANCE} may "
                f"have: {taken:g} is taken",
                Fmi2Status.warning,
                "logStatusWarning",
            )

    def enter_initialization_mode(self) -> None:
        """From here on outputs answer to what was set."""
        if self._is_in(Phase.INSTANTIATED, "enterInitializationMode"):
            self._enter(Phase.INITIALIZATION)

    def exit_initialization_mode(self) -> None:
        """Fix the parameters and prepare the model with them."""
        if (
            self._is_in(Phase.INITIALIZATION, "exitInitializationMode")
            and not self.failure
            and self._attempt("initialization", self.prepare)
        ):
            self._prepared = self._tables.parameters(self.values)
            self._enter(Phase.STEPPING)

    def terminate(self) -> None:
        """End the simulation; outputs can still be read."""
        self._enter(Phase.TERMINATED)

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance by one communication step; False makes pythonfmu answer ``fmi2Discard``."""
        if self.failure or not self._is_in(_STEPPING, "doStep"):
            return False
        time, last, lag = self.time, self._last_step, current_time - self.time
        clock, off = _CLOCK * abs(time), _OFF * abs(step_size)
        nothing = max(clock, _REST * last)
        if not (abs(lag) <= nothing + off and isfinite(step_size)) or (
            step_size < -max(clock, _OFF * last)
        ):
            self._fail(
                f"a step must start at t = {time!r} s, where the last one ended, and go "
                f"forward, got a start of {current_time!r} s and a length of {step_size!r} s; to "
                "go back set an earlier FMU state, or reset the FMU"
            )
            return False
        end = current_time + step_size
        if self.stop_time is not None and end > self.stop_time + nothing + off:
            return self._discard(
                f"a step to t = {end!r} s goes beyond the stop time of the experiment, "
                f"{self.stop_time!r} s; take a shorter one"
            )
        # What was put off is done with the next step; else clocks differ by their round-off.
        length = step_size + lag if abs(lag) > clock else step_size
        if length <= nothing:  # masters end with a step of rounding size, even backwards
            if end == current_time and step_size > _OFF * last:
                return self._discard(
                    f"a step of {step_size!r} s vanishes in the round-off of the time "
                    f"{current_time!r} s; take a longer one, or start the clock at 0"
                )
            return True
        if (error := self._try(self.advance, current_time, length)) is not None:
            reason = f"step of {length!r} s from t = {time!r} s: {self._explain(error)}"
            if isinstance(error, ContactkitError | ArithmeticError):
                return self._discard(f"{reason}; or take shorter steps from there")
            self._fail(f"{reason}; {_CURE}")
            return False
        self.time, self._last_step, self._stale = end, length, False
        return True

    # state and description -------------------------------------------------------------------

    @classmethod
    def _identity(cls) -> str:
        return f"{cls.__name__} {cls.build}"

    def _get_fmu_state(self) -> Snapshot:
        state = Snapshot(
            build=self._identity(),
            phase=str(self._phase),
            prepared=self._prepared is not None,
            stale=self._stale,
            failure=self.failure,
            time=self.time,
            start_time=self.start_time,
            stop_time=self.stop_time,
            values=self.values.copy(),
            hidden={},  # numbers all: `check_outputs` has seen to it
        )
        try:
            if self._prepared is not None:
                state["hidden"] = plain(self.hidden_state())
        except BaseException as error:  # noqa: BLE001  # see _try
            self._fail(f"state: {self._explain(error)}; {_CURE}")
        return state

    def _set_fmu_state(self, state: Any) -> None:
        saved = self.values.copy()
        try:
            if type(state) is not Snapshot or state["build"] != self._identity():
                check_state(state, self._identity(), self.ports)
            self._restore(state)
        except BaseException as error:  # noqa: BLE001  # see _try
            self.values = saved
            self._fail(f"state: {self._explain(error)}; {_CURE}")

    def _restore(self, state: Mapping[str, Any]) -> None:
        phase = Phase(state["phase"])
        self.time, self.start_time = state["time"], state["start_time"]
        self.stop_time = state["stop_time"]
        self.values.clear()
        self.values.update(state["values"])
        if state["prepared"]:
            parameters = self._tables.parameters(self.values)
            if parameters != self._prepared:
                self.prepare()
                self._prepared = parameters
                self.values.clear()
                self.values.update(state["values"])
            self.restore_hidden_state(plain(state["hidden"]))
        else:
            self._prepared = None
        self.failure = state["failure"]
        self._enter(phase)
        self._stale = state["stale"]

    @staticmethod
    def _fmu_state_to_bytes(state: Mapping[str, Any]) -> bytes:
        return to_bytes(plain(state))

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        return from_bytes(state)

    def to_xml(self, model_options: Mapping[str, str] | None = None) -> Element:
        """Model description, written from the ports; pythonfmu's options are all decided."""
        return model_description(
            Description(
                identifier=self.modelName,
                guid="-".join(self.build[i:j] for i, j in pairwise((0, 8, 12, 16, 20, 32))),
                tool=f"contactkit with PythonFMU {pythonfmu_version}",
                summary=self.summary,
                ports=self.ports,
                start=self.start_values(),
                log_categories=self.log_categories,
                experiment=self.experiment,
                version=self.made_with,
                needs_python=True,
            )
        )
