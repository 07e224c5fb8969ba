"""The FMU ``stiction-force``: a liquid film for a tool that owns the mass; motion in, force out.

The film is stiff, so a tool that takes the force of one step into the next needs steps below m/c,
and beyond them it may end with a smooth and wrong answer. The FMU knows both sides: it gives that
step, the force the film had on its way beside the one at the end, and raises a flag where they
differ. A master that exchanges impulses is not bound by it: see `contactkit.fmu.master.couple`.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from enum import IntEnum
from typing import Any, ClassVar, NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...separation.cavity.events import inception, is_inception
from ...separation.cavity.law import CavityLaw
from ...separation.cavity.stages import Spot, force_at
from ...separation.cavity.state import FULL, Cavity, Phase, restored_cavity
from ...separation.effects.base import FilmStatus, LimitKind
from ...separation.integrator.radau import Forces
from ...separation.plan import Film, Plan, plan
from ..framework.ports import (
    Port,
    choice_port,
    find_port,
    grouped,
    input_port,
    output_port,
    size_port,
)
from ..framework.slave import PortSlave
from . import stiction_mass
from .film_travel import Travel, travel
from .moving_travel import is_moving, moving_travel
from .rheology import RHEOLOGY
from .tension import TENSIONS
from .wetting import WETTING

__all__ = ["Exchange", "StictionForce"]


class Exchange(IntEnum):
    """Quantity that the tool exchanges with the film: forces step by step, or impulses."""

    FORCE = 1
    IMPULSE = 2


_MOTION = ("h", "v")
_FILM = ("h0", "R", "V", "N", "h_break")
_LAW = ("gamma", "theta1", "theta2", "meniscus_law", "weight", "rho")
# The speed decides where a film breaks, too, and beyond there is no force.
_END = ("v", "eta", "slip", "slip_from", "a_break", "n_Ca")
_MENISCUS = ("h", *_FILM, *_LAW, *_END)
_MOVED = ("gamma", "theta1", "theta2", "meniscus_law", "slip", "slip_from", "trouton")
_LIMITS = (*TENSIONS, "tau_lim", *RHEOLOGY)
_VISCOUS = (*_MOTION, *_FILM, "eta", *_LIMITS, *_MOVED, "a_break", "n_Ca")
_ALL = tuple(dict.fromkeys((*_VISCOUS, *_MENISCUS)))
_KEPT = (
    "h0",
    "h_break",
    "rewet",
    "R",
    "eta",
    "gamma",
    "theta1",
    "theta2",
    "V",
    "N",
    "meniscus_law",
    *_LIMITS,
    *WETTING,
)
_DOUBT = 0.2  # coupling error beyond which the flag is raised
_SLOW = 1e-9  # speed [m/s] at which a liquid is as at rest: one that thins is stiffest there
_SAME = 1e-9  # gaps closer than this, relatively, are one
_ENDLESS = sys.float_info.max  # a step without bound: hosts choke on infinity


_GROUPS = {
    "geometry": ("h0", "R"),
    "liquid": ("V", "N", "eta", "gamma", "theta1", "theta2", "meniscus_law", "h_break", "rewet"),
    "motion": ("m_ref", "exchange"),
    "limits": (*TENSIONS, "tau_lim"),
    "rheology": RHEOLOGY,
    "wetting": WETTING,
}


def _of_mass(name: str, depends_on: tuple[str, ...] = (), rate_of: str | None = None) -> Port:
    """Output of ``stiction-mass``, which here follows other variables."""
    return evolve(find_port(stiction_mass.PORTS, name), depends_on=depends_on, rate_of=rate_of)


_PORTS = (
    input_port(
        "h",
        "m",
        "gap, at the end of the step to come",
        start=5e-6,
        minimum=0.0,
        exclusive=True,
        display_unit="um",
        nominal=1e-6,
    ),
    input_port("v", "m/s", "opening speed there", nominal=0.1),
    _of_mass("F", _ALL),
    _of_mass("F_m", _MENISCUS, rate_of="J_m"),
    _of_mass("F_v", _VISCOUS, rate_of="J"),
    output_port("c", "N.s/m", "damping dF/dv", _VISCOUS, minimum=0.0, nominal=1e8),
    output_port("k", "N/m", "stiffness dF/dh", _ALL, nominal=1e7),
    _of_mass("J"),
    _of_mass("J_m"),
    output_port("F_mean", "N", "mean of F over the last step", nominal=10.0),
    output_port(
        "coupling_error",
        "-",
        "what F_mean differs by from F, over what moves the mass",
        minimum=0.0,
        nominal=0.1,
    ),
    output_port(
        "H_stable",
        "s",
        "longest communication step for exchanging forces: m_ref/c",
        (*_VISCOUS, "m_ref"),
        minimum=0.0,
        nominal=1e-6,
    ),
    output_port(
        "in_doubt",
        "-",
        "last step longer than H_stable, or coupling_error above 0.2",
        kind="boolean",
    ),
    output_port("n_doubt", "-", "number of steps in doubt so far", kind="integer", minimum=0),
    _of_mass("state", _MENISCUS),
    _of_mass("limit", _VISCOUS),
    output_port(
        "h_above",
        "m",
        "next gap above at which a force is not smooth; 0: none",
        _MENISCUS,
        display_unit="um",
        minimum=0.0,
        nominal=1e-6,
    ),
    output_port(
        "h_below",
        "m",
        "next gap below at which a force is not smooth; 0: none",
        _MENISCUS,
        display_unit="um",
        minimum=0.0,
        nominal=1e-6,
    ),
    _of_mass("t_break"),
    _of_mass("n_break"),
    _of_mass("r_cav", _VISCOUS),
    _of_mass("V_void"),
    _of_mass("V_left", _MENISCUS),
    size_port("m_ref", "kg", "mass that the tool moves", 0.02, "g", exclusive=True),
    choice_port(
        "exchange", "what the tool exchanges; impulses need no stable step", Exchange.FORCE
    ),
    *(find_port(stiction_mass.PORTS, name) for name in _KEPT),
)

PORTS = grouped(_PORTS, _GROUPS)


class _Memory(NamedTuple):
    """What the film remembers: where the last step ended, and what happened so far."""

    gap: float
    damping: float
    static: float
    volume_fraction: float = 1.0
    broken: bool = False
    cavity: Cavity = FULL


class StictionForce(PortSlave):
    """Evaluates the forces of a plan, and integrates them along the way of each step."""

    ports: ClassVar[tuple[Port, ...]] = PORTS
    summary = "Liquid film between two flats: meniscus and viscous force, and doubts of coupling"
    experiment: ClassVar[Mapping[str, float]] = {
        "startTime": 0.0,
        "stopTime": 1e-3,
        "stepSize": 1e-6,
        "tolerance": 1e-4,
    }

    plan: Plan
    memory: _Memory

    @classmethod
    def check_start(cls, values: Mapping[str, Any]) -> None:
        """See `PortSlave.check_start`."""
        stiction_mass.check_gaps(values)

    def prepare(self) -> None:
        """See `PortSlave.prepare`."""
        start = self.values["h0"]
        # The mass is the tool's: whatever `scene_of` wants to know about it plays no part.
        rest = {"m": 1.0, "v0": 0.0, "k_s": 0.0, "h_min": 0.0, "h_rel": 2.0 * start}
        self.plan = plan(stiction_mass.scene_of(self.values | rest), Accuracy())
        film = self.plan.film
        self.memory = _Memory(start, film.damping(start, _SLOW), film.static_force(start))
        self.values.update(
            J=0.0,
            J_m=0.0,
            F_mean=0.0,
            coupling_error=0.0,
            in_doubt=False,
            n_doubt=0,
            t_break=-1.0,
            n_break=0,
        )
        self.refresh()

    def refresh(self) -> None:
        """See `PortSlave.refresh`: forces follow the motion at once."""
        values = self.values
        gap, speed = values["h"], values["v"]
        film = self._film()
        end = film.end_at(gap, speed) if film is not None else 0.0
        if film is None or gap >= end * (1.0 - _SAME):
            values.update(
                F=0.0,
                F_m=0.0,
                F_v=0.0,
                c=0.0,
                k=0.0,
                r_cav=0.0,
                V_void=0.0,
                V_left=0.0,
                H_stable=_ENDLESS,
                h_above=0.0,
                state=int(FilmStatus.BROKEN),
                limit=int(LimitKind.NONE),
                h_below=values["h0"] if values["h0"] < gap and values["rewet"] > 0.0 else 0.0,
            )
            return
        found, edge = self._forces(film, gap, speed)
        damping = found.viscous_by_speed
        whole = gap <= film.full_gap * (1.0 + _SAME)
        values.update(
            F=found.static + found.viscous,
            F_m=found.static,
            F_v=found.viscous,
            c=damping,
            k=found.static_by_gap + found.viscous_by_gap,
            r_cav=edge,
            V_void=values["N"] * self.memory.cavity.void,
            V_left=values["V"] * self.memory.volume_fraction,
            H_stable=values["m_ref"] / damping if damping > 0.0 else _ENDLESS,
            state=int(FilmStatus.FULL if whole else FilmStatus.BRIDGE),
            limit=int(film.acting_limit(found)),
        )
        above = below = 0.0
        for mark in (*film.kinks, end):  # they ascend
            if mark < gap * (1.0 - _SAME):
                below = mark
            elif mark > gap * (1.0 + _SAME):
                above = mark if mark < math.inf else 0.0
                break
        values["h_above"], values["h_below"] = above, below

    def _forces(self, film: Film, gap: float, speed: float) -> tuple[Forces, float]:
        """Forces with a cavity whose edge and rim stay, and the radius of the edge [m], or 0."""
        found, law, before = film.forces(gap, speed), film.cavity, self.memory.gap
        cavity = self.memory.cavity
        if not isinstance(law, CavityLaw):  # others are refused when an FMU is built
            return found, 0.0
        if is_inception(law, cavity, gap, speed):
            cavity, before = inception(law, gap, speed), gap
        if cavity.phase is Phase.FULL:
            return found, 0.0
        rim, _ = law.rim(before, cavity.void)
        edge = cavity.fraction * rim
        held = force_at(law, Spot(cavity.fraction, edge, rim, 0.0, 0.0, 0.0), gap, speed)
        static, by_gap, *_ = found
        return Forces(static, by_gap, *held, LimitKind.TENSION), math.sqrt(edge)

    def advance(self, time: float, step: float) -> None:
        """See `PortSlave.advance`: the motion that was set is where the step ends."""
        before, values = self.memory, self.values
        film, done = self._go(step)
        self.memory = self._remember(film, time, step, done)
        self.refresh()
        values["J"] += done.viscous
        values["J_m"] += done.static
        values["F_mean"] = (done.viscous + done.static) / step
        self._doubt(step, before.damping)
        if film is not None and self._film() is None:
            self.event(f"film broke at t = {values['t_break']:.9g} s")
        elif (now := self.memory.cavity.phase) is not (was := before.cavity.phase):
            if was is Phase.FULL:
                self.event(f"film cavitated at t = {time + done.changed * step:.9g} s")
            elif now is Phase.FULL:
                self.event(f"film reformed at t = {time + done.changed * step:.9g} s")

    def _go(self, step: float) -> tuple[Film | None, Travel]:
        """Film along the step, and what it gives there; one that re-wets, from h0 on."""
        before, film, gap = self.memory, self._film(), self.values["h"]
        if film is not None and is_moving(self.plan):
            return film, moving_travel(self.plan, before.volume_fraction, before.gap, gap, step)
        if film is not None:
            return film, travel(film, before.gap, gap, step, before.static, before.cavity)
        start, rewet = self.values["h0"], self.values["rewet"]
        if rewet > 0.0 and gap < start < before.gap:
            film = self.plan.film_with(rewet)
            if start < film.end * (1.0 - _SAME):
                rest = step * (start - gap) / (before.gap - gap)
                if is_moving(self.plan):
                    return film, moving_travel(self.plan, rewet, start, gap, rest)
                return film, travel(film, start, gap, rest)
        return None, Travel(0.0, 0.0, 1.0)

    def _film(self) -> Film | None:
        memory = self.memory
        return self.plan.remaining_film(
            memory.volume_fraction, broken=memory.broken, detached=False
        )

    def _remember(self, film: Film | None, time: float, step: float, done: Travel) -> _Memory:
        values = self.values
        gap, broken, fraction = values["h"], self.memory.broken, self.memory.volume_fraction
        if film is not None and self._breaks(film, done):
            broken = True
            values["t_break"], values["n_break"] = time + done.broken * step, values["n_break"] + 1
        elif broken and gap <= values["h0"] * (1.0 + _SAME) and values["rewet"] > 0.0:
            fraction = values["rewet"]
            broken = self.plan.film_with(fraction).end <= gap
        if is_moving(self.plan) and film is not None:
            fraction = done.part
        if broken:
            return _Memory(gap, 0.0, 0.0, fraction, True)
        now = self.plan.film_with(fraction)
        static = done.last if now is film else now.static_force(gap)
        return _Memory(gap, now.damping(gap, _SLOW), static, fraction, False, done.cavity)

    def _breaks(self, film: Film, done: Travel) -> bool:
        """Whether a film that was whole is broken at the end of a step."""
        gap, speed = self.values["h"], self.values["v"]
        if done.broken < 1.0:
            return True
        if is_moving(self.plan):
            film = self.plan.film_with(done.part)
        return bool(gap >= film.end_at(gap, speed) * (1.0 - _SAME))

    def _doubt(self, step: float, damping: float) -> None:
        """Compare the force at the end with that on the way, and the step with m/c."""
        values = self.values
        mass, gone = values["m_ref"], values["F_mean"]
        scale = max(abs(values["F"]), abs(gone), mass * abs(values["v"]) / step)
        error = abs(values["F"] - gone) / scale if scale > 0.0 else 0.0
        values["coupling_error"] = error
        was, stiffest = values["in_doubt"], max(damping, self.memory.damping)
        unstable = step * stiffest > mass
        doubt = values["exchange"] == Exchange.FORCE and (unstable or error > _DOUBT)
        values["in_doubt"], values["n_doubt"] = doubt, values["n_doubt"] + doubt
        if doubt and not was:
            self.warn_coupling(_warning(step, mass / stiffest if unstable else 0.0, error))

    def hidden_state(self) -> Mapping[str, Any]:
        """See `PortSlave.hidden_state`."""
        return {"memory": self.memory._asdict()}

    def restore_hidden_state(self, hidden: Mapping[str, Any]) -> None:
        """See `PortSlave.restore_hidden_state`."""
        memory = _Memory(**hidden["memory"])
        self.memory = memory._replace(cavity=restored_cavity(memory.cavity))


def _warning(step: float, stable: float, error: float) -> str:
    cure = (
        "use the FMU stiction-mass, which has the mass inside and needs no short steps, or a "
        "master that exchanges impulses (contactkit.fmu.master.couple)"
    )
    if stable:
        return (
            f"the communication step of {step:.3g} s exceeds {stable:.3g} s = m_ref/c, the longest "
            f"with which this film can be coupled by its force; take a tenth of that, or {cure}"
        )
    return (
        f"the force at the end of the step differs from that on its way by {error:.0%} of what "
        f"moves the mass; take shorter steps than {step:.3g} s, or {cure}"
    )
