"""What a spring tip remembers, how it starts, and the forces on it; see `mirror_tip`.

Plain floats only: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ...separation.motion.state import MotionState, outputs
from ...separation.plan import Plan
from .flight import Root
from .tip_impact import Contact, TipStop, rest_depth

__all__ = [
    "TipState", "attraction", "contact_of", "film_force", "free_gap", "free_start",
    "landed_start", "pressed", "tip_force",
]  # fmt: skip


class TipState(NamedTuple):
    """Everything a tip remembers; its impulse on the root [N.s], its losses [J], its events.

    The rest is that of a site that gives, see `TipStop`: whether a blow goes on, the approach of
    the faces, or the dent that is left while they are apart, and the largest approach so far [m],
    the largest force of the site [N].
    """

    motion: MotionState
    free: bool = False
    impulse: float = 0.0
    landing_loss: float = 0.0
    n_landings: int = 0
    landing_time: float = -1.0
    free_time: float = -1.0
    touching: bool = False
    depth: float = 0.0
    dent: float = 0.0
    largest: float = 0.0
    peak: float = 0.0

    @property
    def time(self) -> float:
        """Time [s]."""
        return self.motion.time

    @property
    def gap(self) -> float:
        """Gap under the tip [m]."""
        return self.motion.gap - (self.depth - self.dent)

    @property
    def on_site(self) -> bool:
        """Whether the tip rests on its site or strikes it."""
        return self.motion.held or self.touching


def free_gap(plan: Plan) -> float:
    """Gap [m] beyond which a tip is free: `Opening.final_gap`, or where the film breaks beyond."""
    end = plan.film.end
    return max(plan.scene.opening.final_gap, end if math.isfinite(end) else 0.0)


def landed_start(
    plan: Plan, time: float = 0.0, *, stop: TipStop | None = None, height: float = 0.0
) -> TipState:
    """State of a tip that rests on its landing site; one that gives by the height of the root."""
    state = TipState(MotionState(time, plan.scene.opening.initial_gap, 0.0, held=True))
    if stop is None:
        return state
    depth = rest_depth(contact_of(plan, stop, state, Root(height, time=time)), 0.0, time)
    return pressed(stop, state, depth, depth)


def free_start(plan: Plan, height: float, speed: float = 0.0, time: float = 0.0) -> TipState:
    """State of an unbent tip whose root is at a height [m] and moves at a speed [m/s]."""
    gap = plan.scene.opening.initial_gap + height
    return TipState(MotionState(time, gap, speed, broken=True, armed=False), free=True)


def tip_force(plan: Plan, damping: float, state: TipState, height: float, speed: float) -> float:
    """Force [N] with which a tip pulls its root down, that being at a height and a speed."""
    opening, motion = plan.scene.opening, state.motion
    force = opening.stiffness * (opening.initial_gap + height - motion.gap + state.depth)
    return force + damping * (speed - motion.speed) if state.free else force


def film_force(plan: Plan, state: TipState) -> tuple[float, float]:
    """Force on a tip from its site [N], and its viscous part; positive holds the tip down."""
    if state.free:
        return 0.0, 0.0
    if state.touching:
        return attraction(plan, state), 0.0
    found = outputs(plan, state.motion, 0.0)
    return found.film, found.viscous


def attraction(plan: Plan, state: TipState) -> float:
    """Force of film and solids at touch [N]."""
    motion = state.motion
    film = plan.film_left(motion.share, broken=motion.broken, detached=motion.detached)
    return film.static_force(plan.scene.opening.initial_gap) if film is not None else 0.0


def contact_of(plan: Plan, stop: TipStop, state: TipState, root: Root) -> Contact:
    """Tip that touches, with a root that moves."""
    opening = plan.scene.opening
    held = attraction(plan, state)
    return Contact(stop, held, opening.stiffness, opening.mass or 0.0, root)


def pressed(stop: TipStop, state: TipState, depth: float, largest: float) -> TipState:
    """Remember how deep the faces were pressed, and the dent that it leaves."""
    largest = max(largest, state.largest)
    peak = max(state.peak, stop.curve.force_at(depth, largest)[0] if depth > 0.0 else 0.0)
    dent = stop.curve.residual(largest)
    return state._replace(depth=depth, dent=dent, largest=largest, peak=peak)
