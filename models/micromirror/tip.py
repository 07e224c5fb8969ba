r"""One spring tip between a moving root and its landing site: a mass, a spring, a film.

.. math::
    m\ddot h = F - F_{film}(h, \dot h), \qquad F = k\,(h_0 + z - h) + c\,(\dot z - \dot h)

The root at height z belongs to somebody else (the mirror) and is steadily accelerated within a
step; F is what the tip pulls it down with. The tip has four states of motion in turn:

* landed: at the gap :math:`h_0` that roughness keeps open, until F exceeds the force of the film;
* held by what acts between tip and site: stepped by `separation.motion.advance`, without c, since
  the liquid damps more than the metal;
* free, once the film has broken and the gap is `free_gap`, where solids no longer attract: a
  damped oscillator under a steady acceleration, in closed form;
* landing again at :math:`h_0`: inelastic, and the film is there again, as it condenses.

With a `TipStop` the site deforms: the apex leaves a residual indentation and bounces, as
`contactkit.models.micromirror.tip_impact` says. The gap then counts from the residual
indentation, and a tip in contact is at the gap :math:`h_0` less what it has sunk below that.

So a tip may have any mass, a film any stiffness, and a step any length: the internal steps follow
their own error. Left out: attraction of a free tip before it lands, without a `TipStop` a bounce of
its apex (its root bounces on the spring), and sliding along the site, some nanometres as it bends.
Plain floats only: this also runs inside an FMU, though the law of a sphere needs numpy there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...errors import ConvergenceError, DescriptionError
from ...scene.scenes import SeparationScene
from ...separation.motion.advance import internal_step, step_cost
from ...separation.motion.state import MotionState, acting_film, outputs
from ...separation.plan import Plan, plan
from .flight import Flight, Root, landing_time
from .tip_impact import Contact, Impact, ImpactEnd, TipStop, follow_impact, rest_depth

__all__ = [
    "TipState",
    "TipStop",
    "advance_tip",
    "attraction",
    "contact_of",
    "film_force",
    "free_gap",
    "free_start",
    "landed_start",
    "pressed",
    "tip_force",
    "tip_plan",
]


class TipState(NamedTuple):
    """Everything a tip remembers; its impulse on the root [N.s], its losses [J], its events.

    The rest is that of a compliant site, see `TipStop`: whether an impact goes on, the approach of
    the faces, or the residual indentation while they are apart, and the maximum approach [m],
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
    residual: float = 0.0
    largest: float = 0.0
    peak: float = 0.0

    @property
    def time(self) -> float:
        """Time [s]."""
        return self.motion.time

    @property
    def gap(self) -> float:
        """Gap under the tip [m]."""
        return self.motion.gap - (self.depth - self.residual)

    @property
    def on_site(self) -> bool:
        """Whether the tip rests on its site or strikes it."""
        return self.motion.in_contact or self.touching


def free_gap(plan: Plan) -> float:
    """Gap [m] beyond which a tip is free: `final_gap`, or where the film breaks beyond."""
    end = plan.film.end
    return max(plan.scene.imposed_force.final_gap, end if math.isfinite(end) else 0.0)


def tip_plan(scene: SeparationScene, accuracy: Accuracy | None = None) -> Plan:
    """Plan of a tip, whose laws are known up to the gap at which it is free.

    A tip is held up to the end of its film, even beyond `final_gap`; laws of a sphere, however,
    are only made up to twice that gap.
    """
    made = plan(scene, accuracy)
    loading = made.scene.imposed_force
    if free_gap(made) <= loading.final_gap:
        return made
    further = evolve(loading, final_gap=free_gap(made))
    return plan(evolve(made.scene, loading=further), made.accuracy)


def landed_start(
    plan: Plan, time: float = 0.0, *, stop: TipStop | None = None, height: float = 0.0
) -> TipState:
    """State of a tip that rests on its landing site; one that gives by the height of the root."""
    state = TipState(MotionState(time, plan.scene.imposed_force.initial_gap, 0.0, in_contact=True))
    if stop is None:
        return state
    depth = rest_depth(contact_of(plan, stop, state, Root(height, time=time)), 0.0, time)
    return pressed(stop, state, depth, depth)


def free_start(plan: Plan, height: float, speed: float = 0.0, time: float = 0.0) -> TipState:
    """State of an unbent tip whose root is at a height [m] and moves at a speed [m/s]."""
    gap = plan.scene.imposed_force.initial_gap + height
    return TipState(MotionState(time, gap, speed, broken=True, armed=False), free=True)


def tip_force(plan: Plan, damping: float, state: TipState, height: float, speed: float) -> float:
    """Force [N] with which a tip pulls its root down, that being at a height and a speed."""
    loading, motion = plan.scene.imposed_force, state.motion
    force = loading.stiffness * (loading.initial_gap + height - motion.gap + state.depth)
    return force + damping * (speed - motion.speed) if state.free else force


def film_force(plan: Plan, state: TipState) -> float:
    """Force on a tip from its site [N]; positive holds the tip down."""
    if state.free:
        return 0.0
    if state.touching:
        return attraction(plan, state)
    return outputs(plan, state.motion, 0.0).film


def attraction(plan: Plan, state: TipState) -> float:
    """Force of film and solids at touch [N]."""
    motion = state.motion
    film = acting_film(plan, motion)
    return film.static_force(plan.scene.imposed_force.initial_gap) if film is not None else 0.0


def contact_of(plan: Plan, stop: TipStop, state: TipState, root: Root) -> Contact:
    """Tip that touches, with a root that moves."""
    loading = plan.scene.imposed_force
    held = attraction(plan, state)
    return Contact(stop, held, loading.stiffness, loading.moving_mass, root)


def pressed(stop: TipStop, state: TipState, depth: float, largest: float) -> TipState:
    """Remember how deep the faces were pressed, and the residual indentation."""
    largest = max(largest, state.largest)
    peak = max(state.peak, stop.curve.force_at(depth, largest)[0] if depth > 0.0 else 0.0)
    residual = stop.curve.residual(largest)
    return state._replace(depth=depth, residual=residual, largest=largest, peak=peak)


# Cost of a piece of the motion beside its steps, in internal steps, for Accuracy.max_steps: a piece
# without any, as a landing, is not free, or a tip that bounces at rest would never be given up.
_PIECE = 3


def advance_tip(
    plan: Plan,
    damping: float,
    state: TipState,
    root: Root,
    dt: float,
    stop: TipStop | None = None,
) -> TipState:
    """Advance a tip by `dt` [s] while its root moves on.

    Parameters
    ----------
    plan : Plan
        Film of one tip; the mass and the stiffness of its `ImposedForce` are those of the tip.
    damping : float
        Damping of the free tip [N.s/m].
    state : TipState
        Where it starts.
    root : Root
        How the root moves, from the time of `state` on.
    dt : float
        Length of the step [s].
    stop : TipStop, optional
        What the apex meets; without one it lands for good on a rigid site.

    Raises
    ------
    DescriptionError
        If `dt` is negative or not finite.
    ConvergenceError
        If no internal step meets the tolerance of the plan.
    InfeasibleError
        If the apex is pressed beyond the end of the curve of `stop`.
    """
    if not (math.isfinite(dt) and dt >= 0.0):
        raise DescriptionError("advance_tip(dt)", dt, "be zero or positive, and finite", unit="s")
    root = root._replace(time=state.time)
    end = state.time + dt
    cost = 0.0
    while cost <= plan.accuracy.max_steps:
        left, before = end - state.time, state
        if left <= 1e-13 * max(abs(end), dt):
            return state._replace(motion=state.motion._replace(time=end))
        over = root._replace(height=root.height + state.residual)  # over the residual indentation
        if stop is not None and state.touching:
            state = _strike(plan, stop, state, root, end, plan.accuracy.max_steps + 1 - cost)
        elif stop is not None and state.motion.in_contact:
            state = _rest(plan, stop, state, root, _one(plan, state, over, end))
        elif state.free:
            there = over.after(state.time - root.time)
            state = _fly(plan, damping, state, there, left, stop is not None)
        else:
            state = _one(plan, state, over, end, stop is not None)
        cost += _cost(plan, before, state)
    raise ConvergenceError(
        f"{plan.accuracy.max_steps} internal steps led from {root.time:g} s to {state.time:g} s, "
        f"not to {end:g} s; loosen Accuracy.time_rtol or raise Accuracy.max_steps",
        state,
    )


def _cost(plan: Plan, before: TipState, after: TipState) -> float:
    """Cost of a piece of the motion, in internal steps: a swing of a free tip is one."""
    if before.free:
        loading = plan.scene.imposed_force
        frequency = math.sqrt(loading.stiffness / loading.moving_mass) / (2.0 * math.pi)
        return _PIECE + (after.time - before.time) * frequency
    steps = after.motion.n_steps - before.motion.n_steps  # of an impact, or one
    return _PIECE + steps + step_cost(before.motion, after.motion)


def _one(plan: Plan, state: TipState, root: Root, end: float, gives: bool = False) -> TipState:
    """Take one internal step while the tip has landed or its film acts."""
    before, loading = state.motion, plan.scene.imposed_force

    def pull(time: float) -> float:
        return loading.stiffness * root.height_at(time)

    after = internal_step(plan, before, pull, end)
    elapsed, origin = after.time - before.time, loading.initial_gap
    first = pull(before.time) - loading.stiffness * (before.gap - origin)
    last = pull(after.time) - loading.stiffness * (after.gap - origin)
    impulse = 0.5 * elapsed * (first + last)
    # What the trapezoid misses: the slopes at its ends differ by the spring times this speed.
    bent, twelfth = root.acceleration * elapsed, elapsed * elapsed * loading.stiffness / 12.0
    if before.in_contact:
        impulse -= twelfth * bent
    else:
        mass = loading.moving_mass
        film = sum(
            impulse - before.impulses.get(name, 0.0) for name, impulse in after.impulses.items()
        )
        # Where it lands its speed is lost: the momentum says what it was.
        speed = before.speed + (impulse - film) / mass if after.in_contact else after.speed
        impulse += twelfth * (speed - before.speed - bent)
        if after.in_contact:
            speed = before.speed + (impulse - film) / mass
            strikes = gives and speed < 0.0
            loss = 0.0 if strikes else 0.5 * mass * speed * speed
            state = _landed(state, loss, after.time)
            if strikes:
                after = after._replace(in_contact=False, speed=speed)
                state = state._replace(touching=True)
    if after.speed > 0.0 and after.gap >= free_gap(plan) * (1.0 - 1e-9):
        state = state._replace(free=True, free_time=after.time)
    return state._replace(motion=after, impulse=state.impulse + impulse)


def _landed(state: TipState, loss: float, time: float) -> TipState:
    return state._replace(
        landing_loss=state.landing_loss + loss,
        n_landings=state.n_landings + 1,
        landing_time=time,
    )


def _flight(plan: Plan, damping: float, state: TipState, root: Root) -> Flight:
    loading, motion = plan.scene.imposed_force, state.motion
    mass = loading.moving_mass
    decay = 0.5 * damping / mass
    square = loading.stiffness / mass - decay * decay
    if square <= 0.0:
        critical = 2.0 * math.sqrt(loading.stiffness * mass)
        raise DescriptionError(
            "SpringTips.damping",
            damping,
            f"be less than critical, {critical:g} N.s/m",
            unit="N.s/m",
        )
    frequency, rest = math.sqrt(square), -mass * root.acceleration / loading.stiffness
    cosine = motion.gap - loading.initial_gap - root.height - rest
    sine = (motion.speed - root.speed + decay * cosine) / frequency
    return Flight(rest, decay, frequency, cosine, sine)


def _fly(
    plan: Plan, damping: float, state: TipState, root: Root, left: float, gives: bool
) -> TipState:
    """Let a free tip swing for a time [s], or until it lands."""
    loading, motion = plan.scene.imposed_force, state.motion
    flight = _flight(plan, damping, state, root)
    lands = landing_time(flight, root, left)
    elapsed = left if lands is None else lands
    (bend, rate), there = flight.at(elapsed), root.after(elapsed)
    gap, speed = loading.initial_gap + there.height + bend, there.speed + rate
    mass = loading.moving_mass
    impulse = mass * (speed - motion.speed)
    state = state._replace(
        motion=motion._replace(time=motion.time + elapsed, gap=gap, speed=speed, step=0.0),
        impulse=state.impulse + impulse,
    )
    return state if lands is None else _touch(plan, state, gives)


def _touch(plan: Plan, state: TipState, gives: bool) -> TipState:
    """Land after a flight: the tip stops, or strikes a compliant site; its film is there again."""
    loading, motion = plan.scene.imposed_force, state.motion
    fraction = plan.scene.meniscus.rewetting
    wets = fraction > 0.0
    moved = motion._replace(
        gap=loading.initial_gap,
        speed=motion.speed if gives else 0.0,
        in_contact=not gives,
        broken=not wets,
        volume_fraction=fraction if wets else motion.volume_fraction,
        armed=True,
        detached=False,
    )
    loss = 0.0 if gives else 0.5 * loading.moving_mass * motion.speed * motion.speed
    return _landed(state, loss, motion.time)._replace(motion=moved, free=False, touching=gives)


def _strike(
    plan: Plan, stop: TipStop, state: TipState, root: Root, end: float, most_steps: float
) -> TipState:
    """Follow an impact until it is over, or the step."""
    motion = state.motion
    begin = Impact(motion.time, state.depth, -motion.speed, state.largest, peak=state.peak)
    rtol = plan.accuracy.time_rtol
    contact = contact_of(plan, stop, state, root)
    found = follow_impact(contact, begin, end, rtol, math.ceil(most_steps))
    moved = motion._replace(
        time=found.time,
        speed=-found.speed,
        in_contact=found.end is ImpactEnd.REST,
        step=0.0,
        n_steps=motion.n_steps + found.n_steps,
    )
    return state._replace(
        motion=moved,
        touching=found.end is ImpactEnd.TIME,
        impulse=state.impulse + found.impulse,
        landing_loss=state.landing_loss + found.dissipated,
        depth=found.depth,
        residual=stop.curve.residual(found.largest),
        largest=found.largest,
        peak=found.peak,
    )


def _rest(plan: Plan, stop: TipStop, before: TipState, root: Root, after: TipState) -> TipState:
    """Let the faces follow the spring while a tip rests; its impulse, by Simpson's rule."""
    contact, largest, depth = contact_of(plan, stop, before, root), before.largest, before.depth
    forces, state = [], after
    for fraction in (0.0, 0.5, 1.0):
        time = before.time + fraction * (after.time - before.time)
        depth = rest_depth(contact, largest, time, depth)
        state = pressed(stop, state, depth, depth)
        largest = state.largest
        forces.append(contact.stiffness * (root.height_at(time) + depth))
    mean = (forces[0] + 4.0 * forces[1] + forces[2]) / 6.0
    impulse = before.impulse + (after.time - before.time) * mean
    if not after.motion.in_contact:  # it leaves the residual indentation
        state = state._replace(depth=state.residual)
    return state._replace(impulse=impulse)
