"""States of a contact along a tangential load path, under a fixed pressure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import InfeasibleError
from .operator import TangentialOperator, tangential_operator
from .states import PartialSlipPart, Zone
from .step import Control, Increment, solve_step, stiffness

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...elasticity.layer_stack import Layers
    from ...scene.loading import TangentialStep
    from ...scene.window import Grid

    Map = NDArray[np.float64]

__all__ = ["FrictionLaw", "follow"]

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


class _Numbers(NamedTuple):
    """Numbers of a state, or of all of them, in the order of `PartialSlipPart`."""

    force: Any
    displacement: Any
    transverse_force: Any
    transverse_displacement: Any
    dissipated_work: Any
    stiffness: Any
    stick_fraction: Any


def follow(
    pressure: Map,
    grid: Grid,
    stacks: tuple[Layers, ...],
    path: tuple[TangentialStep, ...],
    law: FrictionLaw,
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

    Raises
    ------
    InfeasibleError
        If a force exceeds the friction of full sliding.
    """
    run = _Path(pressure, grid, stacks, law)
    maps = []
    for number, step in enumerate(path):
        run.take(number, step)
        maps.append((*run.tractions(), run.zones()))
    numbers = _Numbers(*np.array(run.states, dtype=np.float64).T)
    traction_x, traction_y, zones = (np.array(one) for one in zip(*maps, strict=True))
    part = PartialSlipPart(
        *numbers,
        np.array(run.steps),
        traction_x,
        traction_y,
        zones,
        run.residual,
        run.operator.count if run.operator is not None else 0,
    )
    for one in part:
        if isinstance(one, np.ndarray):
            one.flags.writeable = False
    return part


class _Path:
    """Contact on its way along a load path."""

    def __init__(
        self, pressure: Map, grid: Grid, stacks: tuple[Layers, ...], law: FrictionLaw
    ) -> None:
        self.grid, self.law = grid, law
        self.touching = pressure > 0.0
        self.bound = law.coefficient * pressure[self.touching]
        self.q = np.zeros((law.components, self.bound.size))
        self.rigid = np.zeros(law.components)
        self.slips = np.zeros(self.bound.size, dtype=bool)
        self.work, self.residual = 0.0, 0.0
        self.operator: TangentialOperator | None = None
        if self.bound.any():
            self.operator = tangential_operator(
                grid, self.touching, stacks, law.direction, law.components
            )
        else:
            self.slips[:] = True  # without friction nothing sticks
        start = Increment(self.q, self.rigid, 0.0 * self.q, self.slips, 0.0, 0, 0)
        self.steps = [-1]
        self.states = [self._numbers(start)]

    @property
    def largest_force(self) -> float:
        """Friction of full sliding [N]."""
        return float(self.bound.sum()) * self.grid.pixel_area

    def take(self, number: int, step: TangentialStep) -> None:
        """Take all sub-steps of a step of the path."""
        angle = 0.0 if step.direction is None else step.direction - self.law.direction
        e = np.array([np.cos(angle), np.sin(angle)])[: self.law.components]
        is_force, target = self._target(number, step)
        start = float(e @ self._force() if is_force else e @ self.rigid)
        for i in range(1, step.steps + 1):
            value = target if i == step.steps else start + (target - start) * i / step.steps
            self._advance(e, value, is_force)
            self.steps.append(number)

    def _force(self) -> Map:
        return np.asarray(self.q.sum(axis=1) * self.grid.pixel_area)

    def _target(self, number: int, step: TangentialStep) -> tuple[bool, float]:
        """Whether a step imposes a force, and its target [N] or [m]."""
        if step.displacement is not None:
            return False, step.displacement
        largest = self.largest_force
        if step.ratio is not None:
            return True, step.ratio * largest
        target = step.force or 0.0
        if abs(target) > largest * (1.0 + _ROUND_OFF):
            raise InfeasibleError(
                f"PartialSlip.path[{number}].force = {target:.6g} N exceeds the friction of full "
                f"sliding, {self.law.coefficient:g} times the load: {largest:.6g} N; impose a "
                "displacement, a smaller force, or a ratio between -1 and 1"
            )
        return True, float(np.clip(target, -largest, largest))

    def _advance(self, e: Map, value: float, is_force: bool) -> None:
        """Take one sub-step to a force [N] or a displacement [m] along e."""
        operator, k = self.operator, self.law.components
        change = 0.0 * e if is_force else (value - float(e @ self.rigid)) * e
        if operator is None:
            self.rigid = self.rigid + change
            start = Increment(self.q, change, 0.0 * self.q, self.slips, 0.0, 0, 0)
            self.states.append(self._numbers(start))
            return
        across = np.array([-e[1], e[0]]) if k == 2 else np.zeros(1)
        columns = [e] if is_force else []
        totals = [value / self.grid.pixel_area] if is_force else []
        if k == 2 and not self.law.guided:
            columns, totals = [*columns, across], [*totals, 0.0]
        along = np.array(columns).reshape(len(columns), k).T
        control = Control(along, np.array(totals), change)
        done = solve_step(operator, self.bound, self.q, control, self.law.rtol)
        self.q, self.slips = done.traction, done.slips
        self.rigid = self.rigid + done.displacement
        self.work += float(np.vdot(done.traction, done.slip)) * self.grid.pixel_area
        self.residual = max(self.residual, done.residual)
        self.states.append(self._numbers(done))

    def _numbers(self, done: Increment) -> _Numbers:
        force, rigid = self._force(), self.rigid
        slope = 0.0
        if self.operator is not None:
            slope = stiffness(self.operator, done, self.bound) * self.grid.pixel_area
        two = self.law.components == 2
        return _Numbers(
            float(force[0]),
            float(rigid[0]),
            float(force[1]) if two else 0.0,
            float(rigid[1]) if two else 0.0,
            self.work,
            slope,
            float(np.mean(~done.slips)) if done.slips.size else 0.0,
        )

    def tractions(self) -> tuple[Map, Map]:
        """Tractions along x and y [Pa], (ny, nx)."""
        c, s = np.cos(self.law.direction), np.sin(self.law.direction)
        along, across = self.q[0], self.q[1] if len(self.q) == 2 else 0.0
        found = []
        for values in (c * along - s * across, s * along + c * across):
            one = np.zeros(self.grid.shape)
            one[self.touching] = values
            found.append(one)
        return found[0], found[1]

    def zones(self) -> NDArray[np.int8]:
        """Zone of each pixel, (ny, nx)."""
        found = np.zeros(self.grid.shape, dtype=np.int8)
        forward = np.where(self.q[0] >= 0.0, int(Zone.SLIP), int(Zone.REVERSE_SLIP))
        found[self.touching] = np.where(self.slips, forward, int(Zone.STICK))
        return found
