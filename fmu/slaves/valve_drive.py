"""The FMU ``valve-drive``: coil, return spring and opposite stop of a spool valve.

It takes the motion of the spool and gives the pull on it; mass and film are in the FMU
``stiction-mass``. The coil is integrated inside, with the voltage switched where it switches and
the gap running on at the speed it has, so a step may be as long as that is a fair guess. What is
left is the error of the coupling: spring and stop answer to a gap that is one step old, which is
stable for steps below ``2 sqrt(m/k_stop)`` and good to some per cent of an impact on the stop at a
tenth of that.

The stop is a spring, or, where the build was given a ``curve``, the rough faces of that curve
with the spring ``k_stop`` behind them; such a stop remembers how far it was pressed.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any, ClassVar

from pythonfmu.enums import Fmi2Status

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...errors import DescriptionError, InfeasibleError
from ...models.injector import valve as law
from ..framework.places import Place, read, write
from ..framework.ports import Port, Value, grouped, input_port, output_port, size_port
from ..framework.slave import PortSlave

__all__ = ["ValveDrive", "drive_values", "valve_of"]

_SPRING = ("k_spring", "F_preload")
_STOP = ("h_stop", "k_stop", "d_stop")
# Of the voltage in one step of the host: the coil is solved from one to the next in some 10 us, and
# a host waits a second.
_MOST_SWITCHINGS = 100_000


PLACES: Mapping[str, Place] = {
    "R_coil": Place("coil.resistance"),
    "N_turns": Place("coil.turns"),
    "A_pole": Place("coil.pole_area"),
    "g_air": Place("coil.air_gap"),
    "g_iron": Place("coil.iron_gap"),
    "B_sat": Place("coil.saturation", nothing=0.0),
    "k_spring": Place("spring.stiffness"),
    "F_preload": Place("spring.preload"),
    "h_stop": Place("stop.gap"),
    "k_stop": Place("stop.stiffness"),
    "d_stop": Place("stop.damping"),
    "t_delay": Place("profile.start_delay"),
    "T_period": Place("profile.period"),
    "t_on": Place("profile.on_time"),
    "U_boost": Place("profile.boost_voltage"),
    "t_boost": Place("profile.boost_time"),
    "U_hold": Place("profile.hold_voltage"),
    "U_off": Place("profile.off_voltage"),
    "n_cycles": Place("profile.cycles"),
}
"""Where each parameter stands in a `Valve`."""


_GROUPS = {
    "magnet": ("R_coil", "N_turns", "A_pole", "g_air", "g_iron", "B_sat"),
    "spring": ("k_spring", "F_preload"),
    "stop": ("h_stop", "k_stop", "d_stop"),
    "voltage": (
        "t_delay",
        "T_period",
        "t_on",
        "n_cycles",
        "U_boost",
        "t_boost",
        "U_hold",
        "U_off",
    ),
}

_PORTS = (
    input_port(
        "h", "m", "gap between spool and end cap", start=5e-6, display_unit="um", nominal=1e-5
    ),
    input_port("v", "m/s", "speed of the spool, > 0 opens", nominal=0.1),
    output_port(
        "F_ext", "N", "net pull on the spool, > 0 opens", ("h", "v", *_SPRING, *_STOP), nominal=40.0
    ),
    output_port("dF_ext", "N/s", "mean slope of F_ext in the last step", nominal=1e5),
    output_port("F_mag", "N", "force of the magnet, > 0 opens", minimum=0.0, nominal=40.0),
    output_port("F_spring", "N", "force of the spring, > 0 closes", ("h", *_SPRING), nominal=10.0),
    output_port(
        "F_stop",
        "N",
        "force of the opposite stop, > 0 closes",
        ("h", "v", *_STOP),
        minimum=0.0,
        nominal=100.0,
    ),
    output_port("i", "A", "current", ("h",), nominal=1.0),
    output_port(
        "u",
        "V",
        "voltage of the driver",
        (
            "t_delay",
            "T_period",
            "t_on",
            "t_boost",
            "U_boost",
            "U_hold",
            "U_off",
            "n_cycles",
        ),
        nominal=10.0,
        at_events=True,
    ),
    output_port("flux", "Wb", "flux linkage", minimum=0.0, nominal=1e-3, display_unit="mWb"),
    size_port("R_coil", "ohm", "resistance of the circuit", 1.0, exclusive=True),
    Port(
        "N_turns",
        "-",
        causality="parameter",
        label="turns",
        kind="integer",
        start=40,
        minimum=1,
    ),
    size_port("A_pole", "m2", "area of each of the two poles", 50e-6, "mm2", exclusive=True),
    size_port("g_air", "m", "air gap at each pole while h = 0", 105e-6, "um", exclusive=True),
    size_port("g_iron", "m", "length of air that resists as the iron", 20e-6, "um", exclusive=True),
    size_port("B_sat", "T", "saturation of the iron, 0 = none", 1.8),
    size_port("k_spring", "N/m", "stiffness of the return spring", 2e4, "N/mm"),
    size_port("F_preload", "N", "force of the spring while h = 0", 15.0),
    size_port("h_stop", "m", "gap at which the stop is met", 25e-6, "um", exclusive=True),
    size_port("k_stop", "N/m", "stiffness of the stop", 1e8, "N/um", exclusive=True),
    size_port("d_stop", "s/m", "damping of the stop, k x (1 + d v)", 5.0),
    size_port("t_delay", "s", "time of the first energising", 1e-3, "ms"),
    size_port("T_period", "s", "time between energisings", 10e-3, "ms", exclusive=True),
    size_port("t_on", "s", "length of an energising", 4e-3, "ms", exclusive=True),
    size_port("U_boost", "V", "voltage that builds up the current", 12.0, exclusive=True),
    size_port("t_boost", "s", "for how long", 0.25e-3, "ms"),
    size_port("U_hold", "V", "voltage for the rest of the on time", 5.2),
    Port(
        "U_off",
        "V",
        causality="parameter",
        label="voltage against which the current ends",
        start=-12.0,
        maximum=0.0,
    ),
    Port(
        "n_cycles",
        "-",
        causality="parameter",
        label="number of cycles",
        kind="integer",
        start=5,
        minimum=1,
    ),
)

PORTS = grouped(_PORTS, _GROUPS)


class ValveDrive(PortSlave):
    """Drive of a spool valve; the numbers are those of ``models/injector/fuel_injector.toml``."""

    places: ClassVar[Mapping[str, Place]] = PLACES
    summary = "Electromagnet, return spring and opposite stop of a spool valve"
    experiment: ClassVar[Mapping[str, float]] = {
        "startTime": 0.0,
        "stopTime": 51e-3,
        "stepSize": 5e-6,
    }
    ports: ClassVar[tuple[Port, ...]] = PORTS

    @classmethod
    def check_start(cls, values: Mapping[str, Value]) -> None:
        """See `PortSlave.check_start`."""
        for name, bound in (("t_boost", "t_on"), ("t_on", "T_period")):
            if values[name] > values[bound]:
                expected = f"not exceed {bound} = {values[bound]:g} s"
                raise DescriptionError(name, values[name], expected, unit="s")
        if values["h_stop"] >= values["g_air"]:
            raise DescriptionError(
                "h_stop",
                values["h_stop"],
                f"be less than g_air = {values['g_air']:g} m",
                unit="m",
                hint="else the armature meets the poles before the spool meets the stop",
            )

    def prepare(self) -> None:
        """See `PortSlave.prepare`."""
        self.check_start(self.values)
        self.valve = valve_of(self.values)
        faces = self.data.get("curve")
        self.faces = LoadDisplacementCurve.from_data(faces) if faces is not None else None
        self.largest = 0.0
        self.values |= {"flux": 0.0, "dF_ext": 0.0, "F_mag": 0.0}
        self.values["u"] = law.voltage(self.valve.profile, self.start_time)
        self.refresh()

    def refresh(self) -> None:
        """See `PortSlave.refresh`: spring, stop and current answer to gap and speed at once."""
        self._follow_gap(self.values["h"], self.values["v"])

    def _stop(self, gap: float, speed: float) -> law.StopForce:
        """Force of the stop, and the approach of its faces if it has any."""
        if self.faces is None:
            return law.StopForce(law.stop_force(self.valve.stop, gap, speed), 0.0)
        return law.rough_stop_force(self.valve.stop, self.faces, self.largest, gap, speed)

    def _follow_gap(self, gap: float, speed: float) -> None:
        values, valve = self.values, self.valve
        flux = values["flux"]
        values["i"] = law.current(valve.coil, flux, gap)
        values["F_spring"] = law.spring_force(valve.spring, gap)
        values["F_stop"] = self._stop(gap, speed).force
        values["F_ext"] = law.pull(valve, flux, gap, speed, values["F_stop"])

    def advance(self, time: float, step: float) -> None:
        """See `PortSlave.advance`: the gap runs on at its speed."""
        values, valve = self.values, self.valve
        gap, speed, flux = values["h"], values["v"], values["flux"]
        stopping, faces = self._stop(gap, speed)
        before, end = law.pull(valve, flux, gap, speed, stopping), time + step
        # What is remembered is where the spool was, not where it may be at the end of the step.
        known, self.largest = self.largest, max(self.largest, faces)
        if self.faces is not None and known <= self.faces.max_approach < faces:
            self.log(
                f"the rough end-stop faces are pressed by {faces:.6g} m at t = {time:.9g} s, "
                f"beyond {self.faces.max_approach:.6g} m where their tables end: the force goes on "
                "along its tangent; give the stop a larger area, or faces solved to larger loads",
                Fmi2Status.warning,
                "logStatusWarning",
            )
        _check_switchings(valve.profile, step)
        # Counted from the begin of the step: late in a run the clock is coarse.
        marks = [mark - time for mark in law.switching_times(valve.profile, time, end)]
        steps = law.StepCount()  # of the whole step: 1 to 2 s at most
        for start, stop in pairwise([0.0, *(mark for mark in marks if mark < step), step]):
            applied = law.voltage(valve.profile, time + 0.5 * (start + stop))
            here = gap + speed * start
            flux = law.advance_flux(valve.coil, flux, here, speed, applied, stop - start, steps)
        values["flux"], values["F_mag"] = flux, law.magnet_force(valve.coil, flux)
        values["u"] = law.voltage(valve.profile, end)
        self._follow_gap(gap + speed * step, speed)
        values["dF_ext"] = (values["F_ext"] - before) / step

    def hidden_state(self) -> Mapping[str, Any]:
        """See `PortSlave.hidden_state`."""
        return {"largest": self.largest}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        """See `PortSlave.restore_hidden_state`."""
        self.largest = hidden["largest"]


def _check_switchings(profile: law.DriveProfile, step: float) -> None:
    """Refuse a step with more switchings of the voltage than can be followed in a second or so."""
    count = 3.0 * min(profile.cycles, step / profile.period)
    if count > _MOST_SWITCHINGS:
        raise InfeasibleError(
            f"a step of {step:g} s holds {count:.3g} switchings of the voltage, with T_period = "
            f"{profile.period:g} s, and at most {_MOST_SWITCHINGS} are followed in one step"
        )


_VALVE = law.Valve(
    coil=law.Coil(resistance=1.0, turns=1, pole_area=1.0, air_gap=2.0, iron_gap=1.0),
    spring=law.Spring(stiffness=1.0, preload=1.0),
    stop=law.Stop(gap=1.0, stiffness=1.0),
    profile=law.DriveProfile(
        period=1.0, on_time=1.0, boost_voltage=1.0, boost_time=1.0, hold_voltage=1.0
    ),
)
"""Valve whose fields the parameters fill in."""


def valve_of(values: Mapping[str, Any]) -> law.Valve:
    """Valve that the parameters of the FMU describe; the inverse of `drive_values`."""
    return write(PLACES, _VALVE, values)


def drive_values(valve: law.Valve) -> dict[str, Any]:
    """Start values of the FMU for a valve; the curve of rough end-stop faces is not among them."""
    return read(PLACES, valve)
