"""The FMU ``stiction-mass``: a mass held by a liquid film; a force in, motion out.

The film is far too stiff to be coupled to a mass in another tool: c/m reaches 1e12 1/s. So the
mass is inside, and `contactkit.separation.motion.advance` integrates both, with its own error
control, however long the communication step is.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import IntEnum
from typing import Any, ClassVar

from attrs import evolve

from ...accuracy import Accuracy
from ...errors import DescriptionError, PlanError
from ...liquids.liquid import Liquid
from ...scene.interface import Interface
from ...scene.loading import ImposedForce
from ...scene.meniscus import Meniscus
from ...scene.scenes import SeparationScene
from ...scene.surfaces import Flat
from ...separation.effects.base import FilmStatus, LimitKind, SeparationEffect, effects_of
from ...separation.effects.meniscus import AsPublished, MeniscusForce
from ...separation.effects.rupture import Rupture
from ...separation.effects.viscous import ShearLimit, TensionLimit, ViscousForce
from ...separation.motion.advance import advance
from ...separation.motion.state import MotionState, Pull, outputs, restored_state, start
from ...separation.plan import Plan, plan
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
from .rheology import (
    RHEOLOGY,
    RHEOLOGY_PORTS,
    SLIP_PLACES,
    check_rheology,
    has_rheology,
    is_rheological,
    rheology_values,
    with_laws,
    with_rheology,
)
from .tension import TENSIONS, as_written, tension_limit, tension_values
from .wetting import WETTING, WETTING_PORTS, check_wetting, wetting_effects, wetting_values

__all__ = ["MeniscusLaw", "StictionMass", "check_gaps", "mass_values", "scene_of"]


class MeniscusLaw(IntEnum):
    """Law of the meniscus force."""

    NONE = 1
    EXACT = 2
    ARC = 3
    PUBLISHED = 4


_SHAPE = ("h0", "R", "V", "N")
_MENISCUS = (*_SHAPE, "gamma", "theta1", "theta2", "meniscus_law", "weight", "rho")
# Beside the viscous force the speed adds what it changes of the angles of the meniscus.
_MOVED = ("gamma", "theta1", "theta2", "meniscus_law", "slip", "slip_from", "trouton")
_VISCOUS = (*_SHAPE, "v0", "eta", *TENSIONS, "tau_lim", *RHEOLOGY, *_MOVED)
_ALL = tuple(dict.fromkeys((*_MENISCUS, *_VISCOUS)))


_GROUPS = {
    "geometry": ("h0", "R"),
    "liquid": ("V", "N", "eta", "gamma", "theta1", "theta2", "meniscus_law", "h_break", "rewet"),
    "motion": ("m", "v0", "k_s", "h_rel", "h_min"),
    "limits": (*TENSIONS, "tau_lim"),
    "rheology": RHEOLOGY,
    "wetting": WETTING,
    "numerics": ("rtol", "max_steps"),
}

_PORTS = (
    input_port("F_ext", "N", "pull on the mass, positive opens", nominal=10.0),
    input_port(
        "dF_ext", "N/s", "rate of the pull during the next step; 0 holds it constant", nominal=1e5
    ),
    output_port("h", "m", "gap", ("h0",), display_unit="um", nominal=1e-6),
    output_port("v", "m/s", "opening speed", ("v0",), nominal=0.1, rate_of="h"),
    output_port("F", "N", "force of the film, positive resists opening", _ALL, nominal=10.0),
    output_port("F_m", "N", "meniscus force, positive resists opening", _MENISCUS, nominal=10.0),
    output_port(
        "F_v",
        "N",
        "viscous force after the limits, positive resists opening",
        _VISCOUS,
        nominal=10.0,
    ),
    output_port("J", "N.s", "viscous impulse since the start", nominal=1e-2),
    output_port("J_m", "N.s", "meniscus impulse since the start", nominal=1e-2),
    output_port("W", "J", "work dissipated in the film since the start", nominal=1e-4),
    output_port(
        "state",
        "-",
        "state of the film",
        (*_MENISCUS, "k_s", "h_min", "v0"),
        kind="enumeration",
        enumeration=FilmStatus,
        start=FilmStatus.FULL,
    ),
    output_port(
        "limit",
        "-",
        "limit of the liquid that acts",
        _VISCOUS,
        kind="enumeration",
        enumeration=LimitKind,
        start=LimitKind.NONE,
    ),
    output_port(
        "t_break",
        "s",
        "time of the latest rupture, -1 before",
        start=-1.0,
        nominal=1e-3,
        at_events=True,
    ),
    output_port(
        "t_release",
        "s",
        "time of the latest release, at h_rel, -1 before",
        start=-1.0,
        nominal=1e-3,
        at_events=True,
    ),
    output_port("F_peak", "N", "largest force of the film so far", minimum=0.0, nominal=10.0),
    output_port("n_break", "-", "number of ruptures so far", kind="integer", minimum=0),
    output_port("n_release", "-", "number of releases so far", kind="integer", minimum=0),
    output_port(
        "r_cav", "m", "radius of the cavity", _VISCOUS, display_unit="mm", minimum=0.0, nominal=1e-3
    ),
    output_port("V_void", "m3", "void in the film", display_unit="mm3", minimum=0.0, nominal=1e-10),
    output_port(
        "V_left",
        "m3",
        "volume of the liquid that is left in the film; 0 for a flooded one",
        ("V",),
        display_unit="mm3",
        minimum=0.0,
        nominal=1e-10,
        tabulated=True,
    ),
    size_port("m", "kg", "moving mass", 0.02, "g", exclusive=True),
    size_port("h0", "m", "gap at the start", 5e-6, "um", exclusive=True),
    Port("v0", "m/s", causality="parameter", label="opening speed at the start", start=0.0),
    size_port("k_s", "N/m", "stiffness of a spring that pulls back towards h0", 0.0),
    size_port("h_rel", "m", "gap at which the bodies are released", 1e-4, "um", exclusive=True),
    size_port("h_min", "m", "gap at which asperities stop closing; 0: none", 0.0, "um"),
    size_port("h_break", "m", "gap at which the film breaks; 0: where the bridge does", 0.0, "um"),
    size_port(
        "rewet",
        "-",
        "fraction of V that is there when the bodies return",
        1.0,
        maximum=1.0,
        tabulated=True,
    ),
    size_port("R", "m", "radius of the faces", 3.175e-3, "mm", exclusive=True, tabulated=True),
    size_port("eta", "Pa.s", "dynamic viscosity of the liquid", 0.1, "mPa.s", exclusive=True),
    size_port("gamma", "N/m", "surface tension; 0: no meniscus force", 0.03, "mN/m"),
    size_port(
        "theta1",
        "rad",
        "contact angle on the fixed body",
        0.2,
        "deg",
        maximum=math.pi,
        tabulated=True,
    ),
    size_port(
        "theta2",
        "rad",
        "contact angle on the moving body",
        0.2,
        "deg",
        maximum=math.pi,
        tabulated=True,
    ),
    size_port(
        "V", "m3", "volume of the liquid; 0: full to the rim (flooded)", 0.0, "mm3", tabulated=True
    ),
    Port(
        "N",
        "-",
        causality="parameter",
        label="number of equal menisci",
        kind="integer",
        start=1,
        minimum=1,
        tabulated=True,
    ),
    choice_port("meniscus_law", "meniscus force that acts", MeniscusLaw.EXACT, tabulated=True),
    size_port("dp_cav", "Pa", "tension at which the pressure is cut off; 0: no limit", 0.0, "bar"),
    size_port(
        "dp_inception",
        "Pa",
        "tensile strength of the liquid; 0: it does not cavitate",
        0.0,
        "bar",
    ),
    size_port(
        "dp_hold", "Pa", "ambient pressure less that in the cavity; 0: as dp_inception", 0.0, "bar"
    ),
    size_port("tau_lim", "Pa", "limiting shear strength of the liquid; 0: no limit", 0.0, "MPa"),
    *RHEOLOGY_PORTS,
    *WETTING_PORTS,
    tolerance(1e-8),
    step_limit(PYTHON_STEPS),
)

PORTS = grouped(_PORTS, _GROUPS)


PLACES: Mapping[str, Place] = {
    "m": Place("loading.mass"),
    "h0": Place("loading.initial_gap"),
    "v0": Place("loading.initial_speed"),
    "k_s": Place("loading.stiffness"),
    "h_rel": Place("loading.final_gap"),
    "h_min": Place("loading.rest_gap"),
    "rewet": Place("interface.meniscus.rewetting"),
    "R": Place(("interface.lower.surface.radius", "interface.upper.surface.radius")),
    "eta": Place("interface.meniscus.liquid.viscosity"),
    "gamma": Place("interface.meniscus.liquid.surface_tension", nothing=0.0),
    "theta1": Place("interface.meniscus.contact_angle_lower"),
    "theta2": Place("interface.meniscus.contact_angle_upper"),
    "V": Place("interface.meniscus.volume", nothing=0.0),
    "N": Place("interface.meniscus.count"),
    "meniscus_law": Place(
        "profile",
        MeniscusForce,
        nothing=MeniscusLaw.NONE,
        words={
            MeniscusLaw.EXACT: "exact",
            MeniscusLaw.ARC: "arc",
            MeniscusLaw.PUBLISHED: AsPublished(radius="disc"),
        },
    ),
    **SLIP_PLACES,
    "tau_lim": Place("strength", ShearLimit, nothing=0.0),
    "h_break": Place("gap", Rupture, nothing=0.0),
    "rho": Place("interface.meniscus.liquid.density", nothing=0.0),
}
"""Where each parameter of the film and the mass stands in a scene, but for its tension limit."""

_FILM = SeparationScene(
    interface=Interface(
        lower=Flat(radius=1.0),
        upper=Flat(radius=1.0),
        meniscus=Meniscus(liquid=Liquid(name="liquid of the FMU", viscosity=1.0)),
    ),
    loading=ImposedForce(
        initial_gap=1.0, final_gap=2.0, force=0.0, mass=1.0
    ),  # the pull is an input
    effects=(ViscousForce(),),
)
"""Scene whose fields the parameters fill in."""


_OFF = {"h_break": 0.0}
_OFF |= {port.name: port.start for port in (*RHEOLOGY_PORTS, *WETTING_PORTS)}
"""What rheology and wetting depend on, where they are off."""


def check_gaps(values: Mapping[str, Any]) -> None:
    """Refuse gaps, or tensions, of a film that contradict each other; those there are.

    Raises
    ------
    DescriptionError
        Naming the two.
    """
    check_wetting({name: values.get(name, start) for name, start in _OFF.items()})
    check_rheology({name: values.get(name, start) for name, start in _OFF.items()})
    tension_limit({name: values.get(name, 0.0) for name in (*TENSIONS, "tau_lim")})
    start = values["h0"]
    if values.get("h_rel", math.inf) <= start:
        raise DescriptionError("h_rel", values["h_rel"], f"exceed h0 = {start:g} m", unit="m")
    if values.get("h_min", 0.0) > start:
        raise DescriptionError("h_min", values["h_min"], f"not exceed h0 = {start:g} m", unit="m")
    if 0.0 < values["h_break"] <= start or math.isinf(values["h_break"]):
        expected = f"be 0 or exceed h0 = {start:g} m"
        raise DescriptionError("h_break", values["h_break"], expected, unit="m")


def scene_of(values: Mapping[str, Any]) -> SeparationScene:
    """Scene that the parameters of the FMU describe.

    Raises
    ------
    DescriptionError
        If two parameters contradict each other.
    """
    check_gaps(values)
    limit = tension_limit(values)
    values = {**_OFF, **values}
    law = values["meniscus_law"] if values["gamma"] > 0.0 else MeniscusLaw.NONE
    made = write(PLACES, _FILM, {**values, "meniscus_law": MeniscusLaw(law)})
    if has_rheology(values):
        made = _with_laws(made, values)
    more = (*filter(None, (limit,)), *wetting_effects(values))
    return evolve(made, effects=(*made.effects, *more)) if more else made


def _with_laws(scene: SeparationScene, values: Mapping[str, Any]) -> SeparationScene:
    """Scene whose liquid has the laws of the parameters, all of which its film follows."""
    interface, meniscus = scene.interface, scene.meniscus
    liquid = with_laws(meniscus.liquid, values)
    interface = evolve(interface, meniscus=evolve(meniscus, liquid=liquid))
    return with_rheology(evolve(scene, interface=interface))


def mass_values(scene: SeparationScene) -> dict[str, Any]:
    """Parameters of the FMU ``stiction-mass`` for a scene.

    Raises
    ------
    PlanError
        If the FMU cannot represent the scene; says what stands against it.
    """
    interface, loading = scene.interface, scene.loading
    needs = {
        "two flats": interface.is_flat,
        "a face with a radius [m]": math.isfinite(interface.rim_radius),
        "even discs": interface.has_discs,
        "loading = ImposedForce(...) with a mass [kg]": isinstance(loading, ImposedForce)
        and loading.mass is not None,
    }
    against = [reason for reason, holds in needs.items() if not holds]
    if against:
        raise PlanError(f"the Python FMU stiction-mass needs {'; '.join(against)}; {_CURE}")
    settled = _same_form(scene)
    liquid = scene.meniscus.liquid.at(scene.temperature)
    values = read(PLACES, settled, liquid) | tension_values(scene.effect(TensionLimit))
    values |= wetting_values(scene)
    if is_rheological(scene):
        values |= rheology_values(scene)
    numbers = {port.name: port.read(values.get(port.name, port.start)) for port in PORTS}
    lost = differences(settled, scene_of(numbers), _NOT_HELD)
    if lost:
        raise PlanError(f"the Python FMU stiction-mass has {'; '.join(map(str, lost))}; {_CURE}")
    return values


_CURE = "change the scene, or add --native, which takes any scene with a mass"
_NOT_HELD = (
    "name",
    "temperature",  # the liquid is that of it
    "interface.meniscus.liquid",
    "loading.force",  # the pull is an input
    "loading.rise_time",
    "loading.time_limit",
)
"""Fields of a scene that are no part of the FMU."""


def _same_form(scene: SeparationScene) -> SeparationScene:
    """Scene written as the parameters write it: one rim, and no rupture beside the exact bridge."""
    interface, film = scene.interface, scene.effect(MeniscusForce)
    rim = Flat(radius=interface.rim_radius)
    is_exact = film is not None and film.form == "exact"
    effects: list[SeparationEffect] = []
    for effect in effects_of(scene):
        if isinstance(effect, TensionLimit):
            effects += filter(None, (as_written(effect),))
        elif isinstance(effect, ViscousForce):
            effects.append(evolve(effect, rheology="all" if is_rheological(scene) else None))
        elif not (is_exact and effect == Rupture()):  # the exact bridge breaks by itself
            effects.append(effect)
    interface = evolve(
        interface,
        lower=evolve(interface.lower, surface=rim),
        upper=evolve(interface.upper, surface=rim),
    )
    return evolve(scene, interface=interface, effects=tuple(effects))


class StictionMass(PortSlave):
    """Steps the same plan, with the same step of time, as a script would."""

    ports: ClassVar[tuple[Port, ...]] = PORTS
    places: ClassVar[Mapping[str, Place]] = PLACES
    summary = "Mass held by a liquid film: meniscus and viscous force, limits, rupture, re-wetting"
    experiment: ClassVar[Mapping[str, float]] = {
        "startTime": 0.0,
        "stopTime": 1e-2,
        "stepSize": 1e-5,
    }

    plan: Plan
    state: MotionState
    _pull = Pull(0.0)  # the last one, which a pull that stays takes again

    @classmethod
    def check_start(cls, values: Mapping[str, Any]) -> None:
        """See `PortSlave.check_start`."""
        check_gaps(values)

    def prepare(self) -> None:
        """See `PortSlave.prepare`."""
        values = self.values
        self.plan = plan(
            scene_of(values), Accuracy(time_rtol=values["rtol"], max_steps=values["max_steps"])
        )
        self.state = start(self.plan)
        self._show(0.0)

    def advance(self, time: float, step: float) -> None:
        """See `PortSlave.advance`."""
        before, values = self.state, self.values  # its time counts from the start
        pull = self._pull
        if pull.force != values["F_ext"] or pull.rate or values["dF_ext"]:
            self._pull = pull = Pull(values["F_ext"], values["dF_ext"], before.time)
        self.state = state = advance(self.plan, before, pull, step)
        self._show(pull(state.time))
        if state.n_releases > before.n_releases:
            self.event(f"released at t = {values['t_release']:.9g} s")
        if state.n_breaks > before.n_breaks:
            self.event(f"film broke at t = {values['t_break']:.9g} s")
        begin = self.start_time
        if state.n_inceptions > before.n_inceptions:
            self.event(f"film cavitated at t = {begin + state.inception_time:.9g} s")
        if state.n_reformations > before.n_reformations:
            self.event(f"film reformed at t = {begin + state.reformation_time:.9g} s")

    def _show(self, pull: float) -> None:
        values, state = self.values, self.state
        shown = outputs(self.plan, state, pull)
        values["F"], values["F_m"], values["F_v"] = shown.film, shown.static, shown.viscous
        values["state"], values["limit"] = int(shown.status), int(shown.limit)
        values["r_cav"], values["V_void"] = shown.cavity_radius, shown.void
        left = 0.0 if state.broken else state.volume_fraction
        values["V_left"] = values["V"] * left
        values["h"], values["v"] = state.gap, state.speed
        values["J"] = state.impulses["viscous_impulse"]
        values["J_m"] = state.impulses.get("meniscus_impulse", 0.0)
        values["W"], values["F_peak"] = state.dissipated_work, state.peak_force
        begin = self.start_time
        values["t_break"] = begin + state.break_time if state.n_breaks else -1.0
        values["t_release"] = begin + state.release_time if state.n_releases else -1.0
        values["n_break"], values["n_release"] = state.n_breaks, state.n_releases

    def hidden_state(self) -> Mapping[str, Any]:
        """See `PortSlave.hidden_state`."""
        return {"motion": self.state._asdict()}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        """See `PortSlave.restore_hidden_state`."""
        self.state = restored_state(hidden["motion"])
