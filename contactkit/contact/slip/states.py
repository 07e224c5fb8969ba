"""Results of partial slip: numbers of every state of a load path, and maps at the ends of steps."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...errors import DescriptionError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["PartialSlipPart", "SlipCoupling", "Zone"]


class Zone(IntEnum):
    """State of a pixel: `REVERSE_SLIP` is slip against the direction of the load."""

    OPEN = 0
    STICK = 1
    SLIP = 2
    REVERSE_SLIP = 3


class SlipCoupling(NamedTuple):
    """Effect and cost of the coupling of normal and tangential displacements.

    `displacement` (ny, nx) is the normal displacement by the tractions at the end of the path [m].
    `pressure_change` is the largest change of the pressure by them over its maximum [-],
    `area_change` the change of the contact area over that without them [-]. `step_error` is the
    error of the tractions after pressing by its steps, rms over that of their bound, estimated by
    fewer of them [-]; None for a single one. `contacts` counts the contacts solved, `applications`
    those of the coupling between normal and tangential displacements, `pressing_steps` the steps in
    which the bodies were pressed together (None in files of earlier versions).
    """

    displacement: Map
    pressure_change: float
    area_change: float
    step_error: float | None
    contacts: int
    applications: int
    pressing_steps: int | None = None


class PartialSlipPart(NamedTuple):
    """States of a contact along its tangential load path.

    The first state is that before any tangential load; each further one ends a sub-step. Along the
    direction of the load: `force` [N] on the lower body and `displacement` [m] of the upper body
    against the lower, from the datum of the contact; `transverse_force` and
    `transverse_displacement` across it. `dissipated_work` [J] has been dissipated since the start.
    `stiffness` [N/m] is that of further loading, the transverse displacement held: infinite for a
    periodic window that sticks everywhere. `stick_fraction` is the part of the contact that sticks
    [-]. `step` is the step of the path that a state belongs to, from 0, and -1 for the first.

    Maps at the end of each step of the path, n of them: `traction_x` and `traction_y` on the lower
    body [Pa], and `zones`, the `Zone` of each pixel, (n, ny, nx).

    `residual` is the largest violation of a condition over the displacement of its step [-];
    `applications` counts the operator. `coupling` is there for coupled displacements; then the
    first state is that after pressing, whose tractions do work already.
    """

    force: Map
    displacement: Map
    transverse_force: Map
    transverse_displacement: Map
    dissipated_work: Map
    stiffness: Map
    stick_fraction: Map
    step: NDArray[np.int_]
    traction_x: Map
    traction_y: Map
    zones: NDArray[np.int8]
    residual: float
    applications: int
    coupling: SlipCoupling | None = None

    def end_of(self, step: int) -> int:
        """State at the end of a step of the path; -1 is the last step, as in a tuple.

        Raises
        ------
        DescriptionError
            If the path has no such step.
        """
        last = int(self.step[-1])
        wanted = step + last + 1 if step < 0 else step
        if not 0 <= wanted <= last:
            raise DescriptionError(
                "PartialSlipPart.end_of(step)", step, f"be a step of the path, 0 to {last}"
            )
        return int(np.flatnonzero(self.step == wanted)[-1])

    def energy_loss(self, first: int, last: int) -> float:
        """Work dissipated [J] between the ends of two steps of the path: the loss of a cycle.

        It is the sum of traction times slip over the pixels, which for one component is exact for
        monotonic loading whatever the number of sub-steps, unlike the polygon of force and
        displacement.
        """
        return float(
            self.dissipated_work[self.end_of(last)] - self.dissipated_work[self.end_of(first)]
        )
