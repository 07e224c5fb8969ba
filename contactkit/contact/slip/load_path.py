"""States of a contact along a tangential load path, under a given pressure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import InfeasibleError
from .operator import TangentialOperator, tangential_operator
from .states import PartialSlipPart, SlipCoupling, Zone
from .step import Control, Increment, solve_step, stiffness

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...elasticity.layer_stack import Layers
    from ...scene.loading import TangentialStep
    from ...scene.window import Grid

    Map = NDArray[np.float64]

__all__ = [
    "Friction",
    "FrictionLaw",
    "Imposed",
    "Record",
    "SlipState",
    "Taken",
    "follow",
    "sub_steps",
]

_ROUND_OFF = 1e-12  # by which a force may exceed full sliding


class FrictionLaw(NamedTuple):
    """Coefficient of friction [-], direction of the load [rad] and how the contact is solved.

    `components` of the traction are 1 or 2; `guided` holds the transverse displacement.
    """

    coefficient: float
    direction: float
    components: int
    guided: bool
    rtol: float


class SlipState(NamedTuple):
    """A contact between two sub-steps.

    `pressure` [Pa], (ny, nx); `traction` [Pa] along the load and across it, (k, ny, nx); `rigid`
    displacement of the upper body against the lower [m], (k,); which pixels slipped last, (ny, nx);
    `work` dissipated so far [J].
    """

    pressure: Map
    traction: Map
    rigid: Map
    slips: NDArray[np.bool_]
    work: float


class Imposed(NamedTuple):
    """Load or displacement imposed on a sub-step along the unit vector `along`, (k,).

    The target is a force [N], the displacement of the upper body [m], or the force over that of
    full sliding [-]. `is_free` means no force across `along`, instead of no displacement.
    """

    kind: str
    value: float
    along: Map
    is_free: bool

    @property
    def frees_across(self) -> bool:
        """Whether there is a component across, on which no force acts."""
        return self.is_free and len(self.along) == 2

    def control(self, state: SlipState, bound: Map, pixel_area: float) -> Control:
        """Forces and displacements of a step from a state, under a bound of the tractions [Pa]."""
        k, e = len(self.along), self.along
        columns: list[Map] = []
        totals: list[float] = []
        displacement = 0.0 * e
        if self.kind == "displacement":
            displacement = (self.value - float(e @ state.rigid)) * e
        else:
            scale = float(bound.sum()) if self.kind == "ratio" else 1.0 / pixel_area
            columns, totals = [e], [self.value * scale]
        if self.frees_across:
            columns, totals = [*columns, np.array([-e[1], e[0]])], [*totals, 0.0]
        along = np.array(columns).reshape(len(columns), k).T
        return Control(along, np.array(totals), displacement)


class Taken(NamedTuple):
    """A sub-step that has been solved: the state after it, its increment, operator and bound."""

    state: SlipState
    increment: Increment
    operator: TangentialOperator | None
    bound: Map


class Friction:
    """Coulomb friction between two bodies in a window.

    Parameters
    ----------
    grid : Grid
        Pixels of the window.
    stacks : tuple of Layers
        The deforming bodies.
    law : FrictionLaw
        Friction, and how it is solved.
    threads : int, optional
        Of the transforms.

    Attributes
    ----------
    applications : int
        Applications of the tangential compliance.
    """

    def __init__(
        self, grid: Grid, stacks: tuple[Layers, ...], law: FrictionLaw, threads: int | None = None
    ) -> None:
        self.grid, self.law, self._stacks, self._threads = grid, law, stacks, threads or 1
        self._operator: TangentialOperator | None = None
        self._counted = 0

    @property
    def applications(self) -> int:
        """See the class."""
        return self._counted + (self._operator.count if self._operator is not None else 0)

    def at_rest(self, pressure: Map) -> SlipState:
        """State without tractions under a pressure [Pa]."""
        k, bound = self.law.components, self.law.coefficient * pressure
        slips = np.zeros(pressure.shape, dtype=bool)
        if not bound.any():
            slips = pressure > 0.0  # without friction nothing sticks
        return SlipState(pressure, np.zeros((k, *pressure.shape)), np.zeros(k), slips, 0.0)

    def largest_force(self, pressure: Map) -> float:
        """Friction of full sliding [N]."""
        return self.law.coefficient * float(pressure.sum()) * self.grid.pixel_area

    def between(self, touching: NDArray[np.bool_]) -> TangentialOperator:
        """Compliance between pixels in contact, made anew where they outgrow the last one."""
        made = self._operator.between(touching) if self._operator is not None else None
        if made is None:
            self._counted = self.applications
            law = self.law
            made = tangential_operator(
                self.grid, touching, self._stacks, law.direction, law.components, self._threads
            )
            self._operator = made
        return made

    def rest(self, state: SlipState) -> Taken:
        """A state as it is: the step that changes nothing."""
        touching = state.pressure > 0.0
        bound, q = self.law.coefficient * state.pressure[touching], state.traction[:, touching]
        increment = Increment(q, 0.0 * state.rigid, 0.0 * q, state.slips[touching], 0.0, 0, 0)
        return Taken(state, increment, self.between(touching) if bound.any() else None, bound)

    def holds(self, state: SlipState, imposed: Imposed) -> bool:
        """Whether a state is what a sub-step imposes, so that nothing changes."""
        e, sums = imposed.along, state.traction.sum(axis=(1, 2)) * self.grid.pixel_area
        largest = self.largest_force(state.pressure)
        if imposed.kind == "displacement":
            missing = abs(imposed.value - float(e @ state.rigid))
            is_there = missing <= _ROUND_OFF * abs(imposed.value)
        else:
            wanted = imposed.value * (largest if imposed.kind == "ratio" else 1.0)
            is_there = abs(wanted - float(e @ sums)) <= _ROUND_OFF * largest
        across = abs(float(e[0] * sums[1] - e[1] * sums[0])) if imposed.frees_across else 0.0
        return is_there and across <= _ROUND_OFF * largest

    def take(
        self,
        state: SlipState,
        pressure: Map,
        imposed: Imposed,
        caused: Map | None = None,
        start: Taken | None = None,
        rtol: float | None = None,
    ) -> Taken:
        """Solve a sub-step from a state to another pressure and load.

        Parameters
        ----------
        state : SlipState
            Before the step.
        pressure : ndarray (ny, nx)
            At its end [Pa].
        imposed : Imposed
            Force or displacement at its end.
        caused : ndarray (k, ny, nx), optional
            Displacement by the change of the pressure [m], of the lower body past the upper one.
        start : Taken, optional
            Solution of a step nearby, to begin with.
        rtol : float, optional
            Tolerance of the step; None: that of the law.
        """
        touching, pixel = pressure > 0.0, self.grid.pixel_area
        bound = self.law.coefficient * pressure[touching]
        control = imposed.control(state, bound, pixel)
        if not bound.any():
            made = self.at_rest(pressure)
            made = made._replace(rigid=state.rigid + control.displacement, work=state.work)
            return self.rest(made)
        operator = self.between(touching)
        if caused is not None:
            here = caused[:, touching] - self._released(state, touching)
            control = control._replace(caused=here)
        before = state.traction[:, touching]
        guess = None if start is None else _rescaled(start, pressure)[:, touching]
        done = solve_step(operator, bound, before, control, rtol or self.law.rtol, guess)
        traction, slips = np.zeros_like(state.traction), np.zeros(pressure.shape, dtype=bool)
        traction[:, touching], slips[touching] = done.traction, done.slips
        # While the pressure changes, a pixel that slips carries the mean of its bounds.
        weight = 0.5 * (1.0 + state.pressure[touching] / pressure[touching])
        work = state.work + float(np.vdot(weight * done.traction, done.slip)) * pixel
        after = SlipState(pressure, traction, state.rigid + done.displacement, slips, work)
        return Taken(after, done, operator, bound)

    def _released(self, state: SlipState, touching: NDArray[np.bool_]) -> Map | float:
        """Displacement by the tractions of pixels that have left the contact."""
        left = (state.pressure > 0.0) & ~touching
        if not (state.traction * left).any():
            return 0.0
        either = left | touching
        u = np.zeros_like(state.traction)
        u[:, either] = self.between(either)((state.traction * left)[:, either])
        return u[:, touching]


def _rescaled(start: Taken, pressure: Map) -> Map:
    """Tractions of a solution whose pressure has changed: at the bound where they slipped."""
    state = start.state
    factor = np.divide(
        pressure, state.pressure, out=np.ones_like(pressure), where=state.slips & (pressure > 0.0)
    )
    return np.asarray(state.traction * factor)


def sub_steps(
    friction: Friction, number: int, step: TangentialStep, state: SlipState
) -> Iterator[Imposed]:
    """Sub-steps of a step of a load path that begins at a state.

    Raises
    ------
    InfeasibleError
        If its force exceeds the friction of full sliding.
    """
    law = friction.law
    angle = 0.0 if step.direction is None else step.direction - law.direction
    e = np.array([np.cos(angle), np.sin(angle)])[: law.components]
    kind, target = _target(friction, number, step, state.pressure)
    start = float(e @ state.rigid)
    if kind != "displacement":
        start = float(e @ state.traction.sum(axis=(1, 2))) * friction.grid.pixel_area
    if kind == "ratio":
        start /= friction.largest_force(state.pressure) or 1.0
    for i in range(1, step.steps + 1):
        value = target if i == step.steps else start + (target - start) * i / step.steps
        yield Imposed(kind, value, e, not law.guided)


def _target(
    friction: Friction, number: int, step: TangentialStep, pressure: Map
) -> tuple[str, float]:
    """What a step imposes, and its target [N], [m] or [-]."""
    if step.displacement is not None:
        return "displacement", step.displacement
    if step.ratio is not None:
        return "ratio", step.ratio
    largest, target = friction.largest_force(pressure), step.force or 0.0
    if abs(target) > largest * (1.0 + _ROUND_OFF):
        raise InfeasibleError(
            f"PartialSlip.path[{number}].force = {target:.6g} N exceeds the friction of full "
            f"sliding, {friction.law.coefficient:g} times the load: {largest:.6g} N; impose a "
            "displacement, a smaller force, or a ratio between -1 and 1"
        )
    return "force", float(np.clip(target, -largest, largest))


def follow(
    pressure: Map,
    grid: Grid,
    stacks: tuple[Layers, ...],
    path: tuple[TangentialStep, ...],
    law: FrictionLaw,
    threads: int | None = None,
) -> PartialSlipPart:
    """Follow a tangential load path under a fixed pressure.

    Parameters
    ----------
    pressure : ndarray (ny, nx)
        [Pa].
    grid : Grid
        Pixels of the window.
    stacks : tuple of Layers
        The deforming bodies.
    path : tuple of TangentialStep
        Steps, each of some sub-steps.
    law : FrictionLaw
        Friction, and how it is solved.
    threads : int, optional
        Of the transforms.

    Raises
    ------
    InfeasibleError
        If a force exceeds the friction of full sliding.
    """
    friction = Friction(grid, stacks, law, threads)
    taken = friction.rest(friction.at_rest(pressure))
    record = Record(friction, taken)
    for number, step in enumerate(path):
        for imposed in sub_steps(friction, number, step, taken.state):
            if not friction.holds(taken.state, imposed):
                taken = friction.take(taken.state, pressure, imposed)
            record.add(number, taken)
        record.end_step(taken.state)
    return record.part()


class _Numbers(NamedTuple):
    """Numbers of a state, or of all of them, in the order of `PartialSlipPart`."""

    force: Any
    displacement: Any
    transverse_force: Any
    transverse_displacement: Any
    dissipated_work: Any
    stiffness: Any
    stick_fraction: Any


class Record:
    """States of a load path, as they become the part of a result.

    Parameters
    ----------
    friction : Friction
        Between the bodies.
    first : Taken
        State before the tangential load.
    """

    def __init__(self, friction: Friction, first: Taken) -> None:
        self._friction = friction
        self._steps: list[int] = []
        self._numbers: list[_Numbers] = []
        self._maps: list[tuple[Map, Map, NDArray[np.int8]]] = []
        self._residual = 0.0
        self.add(-1, first)

    def add(self, step: int, taken: Taken) -> None:
        """Add the state after a sub-step."""
        self._steps.append(step)
        self._residual = max(self._residual, taken.increment.residual)
        state, area, two = taken.state, self._friction.grid.pixel_area, len(taken.state.rigid) == 2
        force, slope = taken.increment.traction.sum(axis=1) * area, 0.0
        if taken.operator is not None:
            slope = stiffness(taken.operator, taken.increment, taken.bound) * area
        slips = taken.increment.slips
        self._numbers.append(
            _Numbers(
                float(force[0]),
                float(state.rigid[0]),
                float(force[1]) if two else 0.0,
                float(state.rigid[1]) if two else 0.0,
                state.work,
                slope,
                float(np.mean(~slips)) if slips.size else 0.0,
            )
        )

    def end_step(self, state: SlipState) -> None:
        """Add the maps at the end of a step of the path."""
        angle = self._friction.law.direction
        c, s = np.cos(angle), np.sin(angle)
        along = state.traction[0]
        across = state.traction[1] if len(state.traction) == 2 else 0.0
        zones = np.where(along >= 0.0, int(Zone.SLIP), int(Zone.REVERSE_SLIP))
        zones = np.where(state.slips, zones, int(Zone.STICK))
        zones = np.where(state.pressure > 0.0, zones, int(Zone.OPEN)).astype(np.int8)
        self._maps.append((c * along - s * across, s * along + c * across, zones))

    def part(self, coupling: SlipCoupling | None = None) -> PartialSlipPart:
        """Return the part; its arrays are read-only."""
        numbers = _Numbers(*np.array(self._numbers, dtype=np.float64).T)
        traction_x, traction_y, zones = (np.array(one) for one in zip(*self._maps, strict=True))
        part = PartialSlipPart(
            *numbers,
            np.array(self._steps),
            traction_x,
            traction_y,
            zones,
            self._residual,
            self._friction.applications,
            coupling,
        )
        for one in part:
            if isinstance(one, np.ndarray):
                one.flags.writeable = False
        return part
