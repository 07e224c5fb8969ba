"""The numbers of an adhesive contact and its law, made only for scenes that call for one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ...adhesion import dmt, jkr, maugis_dugdale
from ...adhesion import parameters as adhesion_scales
from ...adhesion.parameters import cohesive_stress
from .base import ForceLaw

__all__ = [
    "AdhesionNumbers",
    "ContactState",
    "cohesive_stress",
    "law",
    "numbers",
    "states_at_loads",
]

_NOTHING = 1e-8  # share of the pull-off force: a jump that no result shows


class AdhesionNumbers(NamedTuple):
    """What an adhesive contact of one sphere comes to.

    `transition_parameter` is that of Maugis [-] and `tabor_parameter` that of Tabor [-], both
    None where no stress of attraction is known. `pull_off_force` is the largest pull, at which a
    dead weight tears the bodies apart [N]; `release_gap` and `release_force` are where they let go
    of a stiff puller [m, N].
    """

    model: str
    radius: float
    work_of_adhesion: float
    reduced_modulus: float
    strength: float | None
    transition_parameter: float | None
    tabor_parameter: float | None
    pull_off_force: float
    release_gap: float
    release_force: float

    @property
    def units(self) -> adhesion_scales.AdhesionScales:
        """Units in which the kernels speak."""
        return adhesion_scales.scales(self.radius, self.work_of_adhesion, self.reduced_modulus)


class ContactState(NamedTuple):
    """A contact at rest: load [N], approach, contact radius and radius of the attraction [m].

    The last is the contact radius where the model gives the attraction no edge of its own.
    """

    load: float
    approach: float
    contact_radius: float
    cohesive_radius: float


def numbers(
    model: str, radius: float, work: float, modulus: float, strength: float | None
) -> AdhesionNumbers:
    """Numbers of a contact of a relative radius [m], work [J/m2], modulus and strength [Pa]."""
    units = adhesion_scales.scales(radius, work, modulus)
    transition = tabor = None
    if strength is not None:
        transition = float(adhesion_scales.transition_parameter(radius, work, modulus, strength))
        tabor = transition / adhesion_scales.TRANSITION_OVER_TABOR
    if model == "jkr":
        pull_off, gap, last = jkr.PULL_OFF_FORCE, jkr.LAST_GAP, jkr.LAST_FORCE
    else:
        assert transition is not None  # lacks() has asked for a stress
        if model == "dmt":
            pull_off, gap, last = dmt.PULL_OFF_FORCE, float(dmt.reach(transition)), 0.0
        else:
            found = maugis_dugdale.limits(transition)
            pull_off = -found.pull_off.load
            gap, last = -found.release.approach, -found.release.load
    return AdhesionNumbers(
        model, radius, work, modulus, strength, transition, tabor,
        pull_off * units.load, gap * units.approach, last * units.load,
    )  # fmt: skip


def law(found: AdhesionNumbers, count: int, start: float) -> ForceLaw:
    """Pull of `count` equal contacts that hold on from a gap `start` [m] on."""
    units = found.units
    most, length = count * float(units.load), float(units.approach)
    if found.model == "jkr":
        return ForceLaw(
            lambda gap, speed: -most * jkr.load(jkr.radius_at_gap(gap / length)),
            release=found.release_gap,
            rejoin=start,
        )
    transition = found.transition_parameter
    assert transition is not None  # lacks() has asked for a stress
    reach = float(dmt.reach(transition)) * length
    if found.model == "dmt":
        most *= dmt.PULL_OFF_FORCE
        return ForceLaw(lambda gap, speed: most * max(1.0 - gap / reach, 0.0), (reach,))
    bounds = maugis_dugdale.limits(transition)
    touch = -bounds.touch.approach * length

    def force(gap: float, speed: float) -> float:
        return -most * maugis_dugdale.at_gap(gap / length, transition, bounds).load

    kinks = (touch,) if touch < found.release_gap else ()
    if found.release_force < _NOTHING * found.pull_off_force:  # ends without a jump, as with DMT
        end = found.release_gap
        return ForceLaw(lambda gap, v: force(gap, v) if gap < end else 0.0, (*kinks, end))
    return ForceLaw(force, kinks, release=found.release_gap, rejoin=max(start, reach))


def states_at_loads(found: AdhesionNumbers, loads: Sequence[float]) -> list[ContactState]:
    """States of one contact that rests under loads [N] of at least minus the pull-off force."""
    units, transition = found.units, found.transition_parameter

    def of_jkr(load: float) -> tuple[float, float, float]:
        a = jkr.radius_at_load(load)
        return a, a, jkr.approach(a)

    def of_dmt(load: float) -> tuple[float, float, float]:
        a = float(dmt.radius_at_load(max(load, -dmt.PULL_OFF_FORCE)))
        return a, a, a * a

    if found.model == "maugis-dugdale":
        assert transition is not None  # lacks() has asked for a stress
        bounds = maugis_dugdale.limits(transition)

        def at(load: float) -> tuple[float, float, float]:
            state = maugis_dugdale.at_load(load, transition, bounds)
            return state.contact_radius, state.cohesive_radius, state.approach

    else:
        at = of_jkr if found.model == "jkr" else of_dmt
    states = []
    for load in loads:
        a, c, approach = at(load / units.load)
        state = load, approach * units.approach, a * units.radius, c * units.radius
        states.append(ContactState(*state))
    return states
