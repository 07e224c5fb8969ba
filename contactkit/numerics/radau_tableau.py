"""Numbers of the method Radau IIA with three stages: nodes, weights, estimate of the error.

References
----------
Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.8.
"""

from __future__ import annotations

import math

__all__ = ["BACK", "BACK_SLOPE", "END_SLOPE", "ERROR", "GAMMA", "NODES", "STAGES", "WEIGHTS"]

_R6 = math.sqrt(6.0)
NODES = ((4.0 - _R6) / 10.0, (4.0 + _R6) / 10.0, 1.0)
STAGES = (
    ((88.0 - 7.0 * _R6) / 360.0, (296.0 - 169.0 * _R6) / 1800.0, (-2.0 + 3.0 * _R6) / 225.0),
    ((296.0 + 169.0 * _R6) / 1800.0, (88.0 + 7.0 * _R6) / 360.0, (-2.0 - 3.0 * _R6) / 225.0),
    ((16.0 - _R6) / 36.0, (16.0 + _R6) / 36.0, 1.0 / 9.0),
)
WEIGHTS = STAGES[2]
GAMMA = 3.0 + 3.0 ** (2.0 / 3.0) - 3.0 ** (1.0 / 3.0)
"""Real eigenvalue of the inverse of `STAGES`."""
ERROR = ((-13.0 - 7.0 * _R6) / 3.0, (-13.0 + 7.0 * _R6) / 3.0, -1.0 / 3.0)
"""Weights of the increments of the stages in the estimate of the error."""
BACK = ((2.0 + 3.0 * _R6) / 6.0, (2.0 - 3.0 * _R6) / 6.0, 1.0 / 3.0)
"""Weights of the stages in what a parabola through them is at the start."""
BACK_SLOPE = ((8.0 - 13.0 * _R6) / 6.0, (8.0 + 13.0 * _R6) / 6.0, -8.0 / 3.0)
"""The same of its slope there, over the length of the step."""
END_SLOPE = (-2.0 + 7.0 * _R6 / 6.0, -2.0 - 7.0 * _R6 / 6.0, 4.0)
"""The same of its slope at the end."""
