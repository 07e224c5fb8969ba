"""The FMU ``contact-stop``: rough faces that meet at an end stop; gap in, force out.

The contact was solved when the FMU was built (`contactkit.load_displacement`); what it carries are
tables. Force and areas follow the gap at once; the one thing remembered is the largest approach,
which decides the unloading curve of a plastic contact. It is remembered when a step is accepted, so
a host that goes back to an earlier state undoes what was pressed since.

The force is never negative: it pushes the body out of the stop, so at a stop that is met on the
way up (``side = ABOVE``) it closes, as ``F_stop`` of ``valve-drive``, and at one that is met on
the way down it opens.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import Any, ClassVar, NamedTuple

from pythonfmu.enums import Fmi2Status

from ...analyses.load_displacement.curve import Branch, CurvePoint, LoadDisplacementCurve
from ...analyses.load_displacement.impact import in_series
from ...errors import DescriptionError
from ..framework.ports import Port, choice_port, grouped, input_port, output_port, size_port
from ..framework.slave import PortSlave

__all__ = ["ContactStop", "StopSide"]


class StopSide(IntEnum):
    """From where the stop is met: as the gap grows, or as it closes."""

    ABOVE = 1
    BELOW = 2


_PLACE = ("h", "h_touch", "side")
_STATIC = (*_PLACE, "scale", "k_body", "d_max0")
_ALL = (*_STATIC, "v", "d_stop")


_GROUPS = {
    "geometry": ("h_touch", "side", "scale"),
    "solids": ("k_body", "d_stop", "d_max0"),
}

_PORTS = (
    input_port("h", "m", "gap, at the end of the step to come", display_unit="um", nominal=1e-5),
    input_port("v", "m/s", "opening speed there", nominal=0.1),
    output_port(
        "F",
        "N",
        "force that pushes out of the stop, never negative",
        _ALL,
        minimum=0.0,
        nominal=100.0,
    ),
    output_port(
        "F_el",
        "N",
        "the same without damping: what the tables give",
        _STATIC,
        minimum=0.0,
        nominal=100.0,
    ),
    output_port("k", "N/m", "stiffness: growth of F_el with the approach", _STATIC, nominal=1e8),
    output_port(
        "c", "N.s/m", "damping: growth of F with the speed of approach", _ALL, nominal=100.0
    ),
    output_port(
        "contact_area",
        "m2",
        "area of contact",
        _STATIC,
        display_unit="mm2",
        minimum=0.0,
        nominal=1e-8,
    ),
    output_port(
        "plastic_area",
        "m2",
        "area that has yielded so far",
        _STATIC,
        display_unit="mm2",
        minimum=0.0,
        nominal=1e-8,
    ),
    output_port(
        "d",
        "m",
        "approach of the faces from first touch, < 0 apart",
        _STATIC,
        display_unit="um",
        nominal=1e-7,
    ),
    output_port(
        "d_max",
        "m",
        "largest approach so far, at the end of a step",
        ("d_max0",),
        display_unit="um",
        nominal=1e-7,
    ),
    output_port(
        "d_res",
        "m",
        "approach at which they detach after it",
        ("d_max0",),
        display_unit="um",
        minimum=0.0,
        nominal=1e-7,
    ),
    output_port("W", "J", "work dissipated by plasticity since the start", nominal=1e-6),
    output_port("W_d", "J", "work dissipated by damping since the start", nominal=1e-6),
    output_port(
        "state",
        "-",
        "branch of the contact",
        _STATIC,
        kind="enumeration",
        enumeration=Branch,
        start=Branch.FREE,
    ),
    output_port(
        "n_beyond", "-", "number of steps that ended beyond the tables", kind="integer", minimum=0
    ),
    size_port("h_touch", "m", "gap at which the faces touch", 25e-6, display_unit="um"),
    choice_port("side", "from where the stop is met", StopSide.ABOVE),
    size_port("scale", "-", "number of windows, or spots, side by side", 1.0, exclusive=True),
    size_port(
        "k_body",
        "N/m",
        "stiffness of the bodies behind the faces; 0: rigid",
        0.0,
        display_unit="N/um",
    ),
    size_port("d_stop", "s/m", "damping, F = F_el (1 + d_stop x speed of approach)", 0.0),
    size_port("d_max0", "m", "largest approach the faces have had before", 0.0, display_unit="um"),
)

PORTS = grouped(_PORTS, _GROUPS)


class _Memory(NamedTuple):
    """What a stop remembers: largest approach, where the last step ended, and the damping there."""

    largest: float
    depth: float
    faces: float
    damping: float
    beyond: bool


class ContactStop(PortSlave):
    """Looks up the tables of a contact, and remembers how far it was pressed."""

    ports: ClassVar[tuple[Port, ...]] = PORTS
    summary = "Rough faces that meet at an end stop: force over approach, plastic or not"
    experiment: ClassVar[Mapping[str, float]] = {
        "startTime": 0.0,
        "stopTime": 1e-3,
        "stepSize": 1e-6,
    }

    curve: LoadDisplacementCurve
    memory: _Memory
    dissipated_before: float
    answered: tuple[tuple[float, float, float], tuple[CurvePoint, float]] | None

    def prepare(self) -> None:
        """See `PortSlave.prepare`."""
        values = self.values
        if "curve" not in self.data:
            raise DescriptionError(
                "contact-stop",
                "no tables",
                "be built by contactkit.fmu.python.build, which makes them",
            )
        self.curve = LoadDisplacementCurve.from_data(self.data["curve"]).scaled(values["scale"])
        if values["d_max0"] > self.curve.max_approach:
            expected = f"not exceed {self.curve.max_approach:.6g} m, where the tables end"
            raise DescriptionError("d_max0", values["d_max0"], expected, unit="m")
        self.memory, self.answered = _Memory(values["d_max0"], 0.0, 0.0, 0.0, False), None
        self.dissipated_before = self.curve.dissipated_work(values["d_max0"])
        values.update(W=0.0, W_d=0.0, n_beyond=0)
        point, _ = self._show()
        self.memory = self._memory(values["d_max0"], point)
        self._remember()

    def refresh(self) -> None:
        """See `PortSlave.refresh`: the faces answer to the gap at once, and forget it again."""
        self._show()

    def _depth(self) -> tuple[float, float]:
        """Approach of the bodies [m], and its speed [m/s]."""
        values = self.values
        sign = 1.0 if values["side"] == StopSide.ABOVE else -1.0
        return sign * (values["h"] - values["h_touch"]), sign * values["v"]

    def _show(self) -> tuple[CurvePoint, float]:
        values, memory = self.values, self.memory
        asked = values["h"], values["v"], memory.largest
        if self.answered is not None and self.answered[0] == asked:
            return self.answered[1]  # the outputs are those: a host reads, then steps
        found = self._look_up()
        self.answered = asked, found
        return found

    def _look_up(self) -> tuple[CurvePoint, float]:
        values, (depth, speed) = self.values, self._depth()
        point, faces = in_series(
            self.curve,
            depth,
            self.memory.largest,
            values["k_body"],
            beyond=True,
            near=self.memory.faces,
        )
        gain = max(1.0 + values["d_stop"] * speed, 0.0)
        values.update(
            F=point.force * gain,
            F_el=point.force,
            k=point.stiffness,
            c=point.force * values["d_stop"] if gain > 0.0 else 0.0,
            contact_area=point.contact_area,
            plastic_area=point.plastic_area,
            d=faces,
            state=int(point.branch),
        )
        return point, faces

    def _memory(self, largest: float, point: CurvePoint) -> _Memory:
        depth, damping = self._depth()[0], self.values["F"] - point.force
        beyond = point.branch is Branch.BEYOND
        return _Memory(largest, max(depth, 0.0), self.values["d"], damping, beyond)

    def _remember(self) -> None:
        curve, largest = self.curve, self.memory.largest
        # The area of the loop that a host sees. Between the solved unloading curves it may fall by
        # a thousandth of the work, as the tables give that back.
        work = curve.dissipated_work(largest) - self.dissipated_before
        self.values.update(d_max=largest, d_res=curve.residual(largest), W=work)

    def advance(self, time: float, step: float) -> None:
        """See `PortSlave.advance`: the gap that was set is where the step ends."""
        before, values = self.memory, self.values
        point, faces = self._show()
        self.memory = now = self._memory(
            max(before.largest, min(faces, self.curve.max_approach)), point
        )
        if now.largest > before.largest:
            self._remember()
        values["W_d"] += 0.5 * (before.damping + now.damping) * (now.depth - before.depth)
        values["n_beyond"] += now.beyond
        if now.beyond and not before.beyond:
            self.log(
                f"the faces are pressed by {faces:.4g} m at t = {time + step:.9g} s, beyond "
                f"{self.curve.max_approach:.4g} m where their tables end: the force goes on along "
                "its tangent; build the FMU with larger loads",
                Fmi2Status.warning,
                "logStatusWarning",
            )

    def hidden_state(self) -> Mapping[str, Any]:
        """See `PortSlave.hidden_state`."""
        return {"memory": list(self.memory)}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        """See `PortSlave.restore_hidden_state`."""
        self.memory, self.answered = _Memory(*hidden["memory"]), None
