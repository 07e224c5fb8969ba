"""The FMU ``tip-contact``: spring tips on a landing site; motion of their root in, force out.

A condensed meniscus between a tip and its site is a spring of some 100 N/m with a snap in it, on
a mass of some 1e-16 kg: nanoseconds, which no other tool should have to step. So the tips, their
springs and their film are inside, stepped as `contactkit.models.micromirror.tip` does, and what
crosses the interface is the soft spring of the tip. A host that gives height, speed and
acceleration of the root at the start of a step and takes the mean force over the step exchanges
impulse without loss; the force at the end, which follows height and speed at once, serves a host
that cannot.

Built with a ``curve``, a `LoadDisplacementCurve` of one apex on its site, the site deforms: tips
impact, rebound and leave a residual indentation. Without one they land for good on a rigid site.

The tips start landed where the root starts at height 0 or below, else free and unbent. The law of
the meniscus under a sphere is prepared with numpy, so the host's Python needs numpy (and scipy),
unless V is 0.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import IntEnum
from typing import Any, ClassVar

from attrs import evolve

from ...accuracy import Accuracy
from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...errors import DescriptionError, PlanError
from ...liquids.liquid import Liquid
from ...models.micromirror.flight import Root
from ...models.micromirror.tip import (
    TipState,
    TipStop,
    advance_tip,
    film_force,
    free_start,
    landed_start,
    tip_force,
    tip_plan,
)
from ...scene.interface import Interface
from ...scene.loading import ImposedForce
from ...scene.meniscus import Meniscus
from ...scene.scenes import SeparationScene
from ...scene.surfaces import Flat, Sphere
from ...separation.effects.adhesion import VanDerWaalsForce
from ...separation.effects.meniscus import MeniscusForce
from ...separation.effects.viscous import ViscousForce
from ...separation.motion.state import restored_state
from ...separation.plan import Plan
from ..framework.places import Place, differences, read, write
from ..framework.ports import (
    PYTHON_STEPS,
    Port,
    choice_port,
    grouped,
    input_port,
    output_port,
    size_port,
    step_limit,
    tolerance,
)
from ..framework.slave import PortSlave

__all__ = ["TipContact", "TipLaw", "TipStatus", "check_tip"]


class TipStatus(IntEnum):
    """State of a tip."""

    LANDED = 1
    HELD = 2
    FREE = 3


class TipLaw(IntEnum):
    """Profile of the meniscus."""

    EXACT = 1
    ARC = 2


_FILM = ("z", "h0", "R", "A_H", "gamma", "theta1", "theta2", "V", "profile")
_SITE = (*_FILM, "k")  # how deep a tip that starts landed presses a compliant site


_GROUPS = {
    "geometry": ("N", "R", "h0", "h_free"),
    "liquid": ("V", "eta", "gamma", "theta1", "theta2", "profile"),
    "solids": ("A_H", "d_stop"),
    "motion": ("m", "k", "c"),
    "numerics": ("rtol", "max_steps"),
}

_PORTS = (
    input_port(
        "z",
        "m",
        "height of the root over where an unbent tip lands",
        display_unit="um",
        nominal=1e-6,
    ),
    input_port("vz", "m/s", "speed of the root, > 0 lifts", nominal=0.1),
    input_port("az", "m/s2", "acceleration of the root in the next step", nominal=1e6),
    output_port(
        "F",
        "N",
        "force of all tips on the root, > 0 holds it down",
        (*_SITE, "N", "vz", "c"),
        display_unit="nN",
        nominal=1e-7,
    ),
    output_port("F_mean", "N", "mean of F over the last step", display_unit="nN", nominal=1e-7),
    output_port("h", "m", "gap under a tip", _SITE, display_unit="nm", nominal=1e-8),
    output_port("v", "m/s", "speed of a tip", ("vz",), nominal=0.1),
    output_port(
        "F_film",
        "N",
        "force on one tip from its site, > 0 holds",
        _FILM,
        display_unit="nN",
        nominal=1e-7,
    ),
    output_port("J", "N.s", "impulse of all tips on the root since the start", nominal=1e-13),
    output_port("W_visc", "J", "work dissipated in the films of all tips", nominal=1e-16),
    output_port("W_land", "J", "energy dissipated in all landings, of all tips", nominal=1e-17),
    output_port(
        "state", "-", "what the tips do", ("z",), kind="enumeration", enumeration=TipStatus
    ),
    output_port(
        "t_break",
        "s",
        "time of the latest rupture, -1 before",
        start=-1.0,
        nominal=1e-6,
        at_events=True,
    ),
    output_port(
        "t_free",
        "s",
        "time at which the tips were free for the last time, -1 before",
        start=-1.0,
        nominal=1e-6,
        at_events=True,
    ),
    output_port(
        "t_land",
        "s",
        "time of the latest landing, -1 before",
        start=-1.0,
        nominal=1e-6,
        at_events=True,
    ),
    output_port("n_break", "-", "number of ruptures so far", kind="integer", minimum=0),
    output_port("n_land", "-", "number of landings so far", kind="integer", minimum=0),
    output_port(
        "d",
        "m",
        "approach of apex and site, or their residual indentation; 0 if rigid",
        _SITE,
        display_unit="nm",
        nominal=1e-9,
    ),
    output_port(
        "d_max",
        "m",
        "largest approach of a tip so far; 0 if rigid",
        _SITE,
        display_unit="nm",
        minimum=0.0,
        nominal=1e-9,
    ),
    output_port(
        "F_max",
        "N",
        "largest force of the site on a tip so far; 0 if rigid",
        _SITE,
        display_unit="nN",
        minimum=0.0,
        nominal=1e-7,
    ),
    output_port(
        "W_plastic", "J", "work that yielding took, of all tips", (*_SITE, "N"), nominal=1e-17
    ),
    Port(
        "N",
        "-",
        causality="parameter",
        label="number of equal tips",
        kind="integer",
        start=2,
        minimum=1,
    ),
    size_port("m", "kg", "mass of one tip", 4e-16, exclusive=True),
    size_port("k", "N/m", "stiffness of one tip", 1.0, exclusive=True),
    size_port("c", "N.s/m", "damping of one tip while it is free", 2e-10),
    size_port(
        "h0", "m", "gap that roughness keeps open under a landed tip", 4e-10, "nm", exclusive=True
    ),
    size_port(
        "h_free", "m", "gap beyond which solids do not attract a tip", 5e-8, "nm", exclusive=True
    ),
    size_port("R", "m", "radius of the apex of a tip", 1e-7, "nm", exclusive=True, tabulated=True),
    size_port("A_H", "J", "Hamaker constant; 0: no van der Waals force", 1e-19, tabulated=True),
    size_port("V", "m3", "volume of the liquid under one tip; 0: dry", 0.0, tabulated=True),
    size_port("gamma", "N/m", "surface tension of the liquid", 0.0727, "mN/m", exclusive=True),
    size_port("eta", "Pa.s", "viscosity of the liquid; 0: no viscous force", 1e-3, "mPa.s"),
    size_port(
        "theta1",
        "rad",
        "contact angle on the landing site",
        0.7,
        "deg",
        maximum=math.pi,
        tabulated=True,
    ),
    size_port(
        "theta2", "rad", "contact angle on the tip", 0.7, "deg", maximum=math.pi, tabulated=True
    ),
    choice_port("profile", "profile of the meniscus", TipLaw.EXACT, tabulated=True),
    size_port("d_stop", "s/m", "damping of the site over its force; needs a curve", 0.0),
    tolerance(1e-7),
    step_limit(PYTHON_STEPS),
)

PORTS = grouped(_PORTS, _GROUPS)


PLACES: Mapping[str, Place] = {
    "m": Place("loading.mass"),
    "k": Place("loading.stiffness"),
    "h0": Place(("loading.initial_gap", "loading.rest_gap")),
    "h_free": Place("loading.final_gap"),
    "R": Place("interface.upper.surface.radius"),
    "V": Place("interface.meniscus.volume", nothing=0.0),
    "gamma": Place("interface.meniscus.liquid.surface_tension"),
    "eta": Place("interface.meniscus.liquid.viscosity", nothing=0.0),
    "theta1": Place("interface.meniscus.contact_angle_lower"),
    "theta2": Place("interface.meniscus.contact_angle_upper"),
    "profile": Place("profile", MeniscusForce, words={TipLaw.EXACT: "exact", TipLaw.ARC: "arc"}),
    "A_H": Place("hamaker_constant", VanDerWaalsForce, nothing=0.0),
}
"""Where each parameter of a tip stands in its scene."""

_TIP = SeparationScene(
    interface=Interface(
        lower=Flat(),
        upper=Sphere(radius=1.0),
        meniscus=Meniscus(liquid=Liquid(name="liquid of the FMU", surface_tension=1.0)),
    ),
    loading=ImposedForce(
        initial_gap=1.0, final_gap=2.0, force=0.0, mass=1.0
    ),  # what pulls is the root
    effects=(),
)
"""Scene whose fields the parameters fill in."""


def tip_scene(values: Mapping[str, Any]) -> SeparationScene:
    """Scene of one tip that the parameters of the FMU describe.

    Raises
    ------
    DescriptionError
        If two parameters contradict each other, or nothing acts on the tip.
    """
    if values["h_free"] <= values["h0"]:
        expected = f"exceed h0 = {values['h0']!r} m"
        raise DescriptionError("h_free", values["h_free"], expected, unit="m")
    is_wet = values["V"] > 0.0
    places = PLACES if is_wet else {n: p for n, p in PLACES.items() if p.effect != MeniscusForce}
    scene = write(places, _TIP, {**values, "profile": TipLaw(values["profile"])})
    if is_wet and values["eta"] > 0.0:
        meniscus, *others = scene.effects
        scene = evolve(scene, effects=(meniscus, ViscousForce(), *others))
    if not scene.effects:
        raise DescriptionError(
            "V", 0.0, "be positive, or A_H [J]", unit="m3", hint="else nothing holds a tip"
        )
    return scene


def check_tip(values: Mapping[str, Any], *, has_curve: bool) -> None:
    """Refuse damping that a tip or its site cannot have.

    Raises
    ------
    DescriptionError
        Naming the parameter.
    """
    critical, damping = 2.0 * math.sqrt(values["k"] * values["m"]), values["d_stop"]
    if not values["c"] < critical:
        expected = f"be less than critical, {critical:.9g} N.s/m"
        raise DescriptionError("c", values["c"], expected, unit="N.s/m")
    if damping > 0.0 and not has_curve:
        raise DescriptionError(
            "d_stop", damping, "be 0 on a rigid site", unit="s/m", hint="build the FMU with a curve"
        )


def tip_values(tip: SeparationScene) -> dict[str, Any]:
    """Start values of the FMU for a scene of one tip.

    Raises
    ------
    PlanError
        If the FMU cannot represent the scene; says what stands against it.
    """
    loading, surfaces = tip.loading, (tip.interface.lower.surface, tip.interface.upper.surface)
    needs = {
        "a flat below and a sphere above": [type(s) for s in surfaces] == [Flat, Sphere],
        "loading = ImposedForce(...) with a mass [kg]": isinstance(loading, ImposedForce)
        and loading.mass is not None,
    }
    if against := [reason for reason, holds in needs.items() if not holds]:
        raise PlanError(f"the FMU tip-contact needs {'; '.join(against)}")
    settled = _same_form(tip)
    values = read(PLACES, settled, tip.meniscus.liquid.at(tip.temperature))
    if tip.effect(ViscousForce) is None:
        values["eta"] = 0.0
    if tip.effect(MeniscusForce) is None:
        del values["profile"]
    numbers = {port.name: port.read(values.get(port.name, port.start)) for port in PORTS}
    if lost := differences(settled, tip_scene(numbers), _NOT_HELD):
        raise PlanError(f"the FMU tip-contact has {'; '.join(map(str, lost))}; change the scene")
    return values


_NOT_HELD = (
    "name",
    "temperature",  # the liquid is that of it
    "interface.meniscus.liquid",
    "loading.force",  # what pulls is the root
    "loading.rise_time",
    "loading.time_limit",
)
"""Fields of a scene that are no part of the FMU."""


def _same_form(tip: SeparationScene) -> SeparationScene:
    """Scene written as the parameters write it: no liquid that nothing reads."""
    meniscus = tip.meniscus
    if tip.effect(MeniscusForce) is None and tip.effect(ViscousForce) is None:
        meniscus = evolve(meniscus, volume=None, pressure=None, relative_humidity=None)
    return evolve(tip, interface=evolve(tip.interface, meniscus=meniscus))


class TipContact(PortSlave):
    """Steps the tips of one side; numbers of ``models/micromirror/micromirror.toml``."""

    ports: ClassVar[tuple[Port, ...]] = PORTS
    places: ClassVar[Mapping[str, Place]] = PLACES
    summary = (
        "Spring tips on a landing site: meniscus, van der Waals and viscous force, snap-off and "
        "landing (needs numpy and scipy unless V = 0)"
    )
    experiment: ClassVar[Mapping[str, float]] = {
        "startTime": 0.0,
        "stopTime": 2e-5,
        "stepSize": 2e-8,
    }

    plan: Plan
    state: TipState
    stop: TipStop | None

    def prepare(self) -> None:
        """See `PortSlave.prepare`."""
        values = self.values
        accuracy = Accuracy(time_rtol=values["rtol"], max_steps=values["max_steps"])
        self.plan = tip_plan(tip_scene(values), accuracy)
        check_tip(values, has_curve="curve" in self.data)
        self.stop = self._site()
        if values["z"] <= 0.0:
            self.state = landed_start(self.plan, stop=self.stop, height=values["z"])
        else:
            self.state = free_start(self.plan, values["z"], values["vz"])
        values["F_mean"] = 0.0
        self.refresh()
        self._show()

    def _site(self) -> TipStop | None:
        """Faces of apex and site, if the build has a curve of them."""
        if "curve" not in self.data:
            return None
        curve = LoadDisplacementCurve.from_data(self.data["curve"])
        return TipStop(curve, self.values["d_stop"])

    def refresh(self) -> None:
        """See `PortSlave.refresh`: the springs answer to height and speed at once."""
        self._pull_root(self.values["z"], self.values["vz"])

    def _pull_root(self, height: float, speed: float) -> None:
        values = self.values
        one = tip_force(self.plan, values["c"], self.state, height, speed)
        values["F"] = values["N"] * one

    def advance(self, time: float, step: float) -> None:
        """See `PortSlave.advance`."""
        values, before = self.values, self.state  # its time counts from the start
        root = Root(values["z"], values["vz"], values["az"], before.time)
        self.state = advance_tip(self.plan, values["c"], before, root, step, self.stop)
        values["F_mean"] = values["N"] * (self.state.impulse - before.impulse) / step
        there = root.after(step)
        self._pull_root(there.height, there.speed)
        self._show()
        if self.state.motion.n_breaks > before.motion.n_breaks:
            self.event(f"film broke at t = {values['t_break']:.9g} s")
        if self.state.n_landings > before.n_landings:
            self.event(f"landed at t = {values['t_land']:.9g} s")

    def _clock(self, time: float) -> float:
        """Time of the host [s] for one since the start; -1 stays."""
        return self.start_time + time if time >= 0.0 else -1.0

    def _show(self) -> None:
        state, motion, n = self.state, self.state.motion, self.values["N"]
        stop = self.stop
        taken = stop.curve.dissipated_work(state.largest) if stop is not None else 0.0
        status = TipStatus.FREE if state.free else TipStatus.HELD
        self.values.update(
            h=state.gap,
            v=motion.speed,
            F_film=film_force(self.plan, state),
            J=n * state.impulse,
            W_visc=n * motion.dissipated_work,
            W_land=n * state.landing_loss,
            state=int(TipStatus.LANDED if state.on_site else status),
            t_break=self._clock(motion.break_time),
            t_free=self._clock(state.free_time),
            t_land=self._clock(state.landing_time),
            n_break=motion.n_breaks,
            n_land=state.n_landings,
            d=state.depth,
            d_max=state.largest,
            F_max=state.peak,
            W_plastic=n * taken,
        )

    def hidden_state(self) -> Mapping[str, Any]:
        """See `PortSlave.hidden_state`."""
        tip = self.state._asdict()
        return {"tip": tip, "motion": tip.pop("motion")._asdict()}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        """See `PortSlave.restore_hidden_state`."""
        self.state = TipState(restored_state(hidden["motion"]), **hidden["tip"])
