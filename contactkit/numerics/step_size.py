"""Step-size control: the next length of a step from the error of the last one."""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["StepSize"]


class StepSize(NamedTuple):
    """The elementary controller of Hairer and Wanner (1996), section IV.8.

    An error of a step, over its tolerance, is taken to grow with the `order`-th power of the
    length. Plain floats: this runs inside FMUs.

    Examples
    --------
    >>> control = StepSize(order=4)
    >>> round(control.shorter(1.0, 16.0), 6), round(control.following(1.0, 1.0 / 16.0), 6)
    (0.45, 1.8)
    """

    order: float  # [-]
    safety: float = 0.9  # of the length that would just meet the tolerance
    shrink: float = 0.1  # at most, after a step whose error is too large
    grow: float = 8.0  # at most, from one step to the next
    unsolved: float = 0.25  # after a step that could not be solved at all

    def shorter(self, length: float, error: float) -> float:
        """Length to try after a step whose error is too large, or not finite: not solved."""
        if not error < math.inf:
            return length * self.unsolved
        return float(length * max(self.shrink, self.safety * error ** (-1.0 / self.order)))

    def following(self, length: float, error: float, planned: float = 0.0) -> float:
        """Length of the next step.

        Not shorter than the `planned` one if that was cut short, by an event or the end of a span,
        and then met its tolerance at once: `planned` is 0 where it was not.
        """
        # An error of zero, or one that its power underflows, must not divide: below this it is
        # `grow`.
        least = (self.safety / self.grow) ** self.order
        grown = self.grow if error <= least else self.safety * error ** (-1.0 / self.order)
        return float(max(length * grown, planned))
