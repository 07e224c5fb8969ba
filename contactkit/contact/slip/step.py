r"""Implicit step of Coulomb friction under a fixed pressure.

From the tractions q_0 of the last step to those of the next one:

.. math:: \min_q \tfrac12 (q - q_0)^T H (q - q_0) - D \cdot \sum (q - q_0), \qquad |q| \le \mu p

for an increment D of the rigid displacement; its multiplier is the slip of the step, along q. Along
a direction in which the force is imposed, the sum of q is given and D is the multiplier. A
displacement v by other causes than tractions, such as a change of the pressure, adds v (q - q_0).

The method is a primal-dual active set with exact projections: given which pixels slip, and along
what, the others follow from a linear problem, solved roughly by preconditioned conjugate gradients;
the result is projected back into the bound. An iteration that does not lower the energy is
shortened, and at last replaced by a step along the gradient, which always does.

======  =======================================================
symbol  meaning
======  =======================================================
x       increment q - q_0 [Pa], (k, n)
u       H x + v: displacement of the step [m], (k, n)
g       u - D: minus the slip of the step [m], (k, n)
A       directions in which the force is imposed, (k, m)
======  =======================================================
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .discs import FreeDirections, lengths, onto_discs, onto_discs_and_sum, towards
from .operator import TangentialOperator

__all__ = ["Control", "Increment", "solve_step", "stiffness"]

Array = NDArray[np.float64]
# Of 1043 steps on hostile paths (stiff and soft films, two components, coupling) two take more than
# 60 iterations, and one more than these: 122.
_MOST_ITERATIONS = 120
_MOST_INNER = 100  # the longest of 5790 linear solutions takes 33: beyond, H is not definite
# By halves, before a step along the gradient. On the same paths 3 save 7 % of the applications,
# but a very stiff film stalls; 12 take twice as many, as a failed direction is paid for that long.
_SHORTENINGS = 6
_FULL = 1e-13  # of the force of full sliding: nearer to it is full sliding
_STIFFNESS = 1e-5  # reduction of the residual, whose square is the error of the stiffness
_ROUND_OFF = 1e-13  # of the displacement under the largest tractions: less cannot be measured


class Control(NamedTuple):
    """Imposed forces and displacements of a step.

    `along` (k, m) are orthonormal directions in which the sum of the tractions becomes `total` (m)
    [Pa]; in the others the rigid displacement grows by `displacement` (k) [m]. `caused` (k, n) is
    the displacement of the lower body past the upper one by other causes than tractions [m].
    """

    along: Array
    total: Array
    displacement: Array
    caused: Array | None = None


class Increment(NamedTuple):
    """Result of a step.

    `traction` (k, n) [Pa], increment of the rigid displacement (k) [m], slip of the step (k, n)
    [m], which pixels slip (n), the residual over the displacement of the step, iterations and
    applications of H.
    """

    traction: Array
    displacement: Array
    slip: Array
    slips: NDArray[np.bool_]
    residual: float
    iterations: int
    applications: int


class _State(NamedTuple):
    """Tractions of an iteration, the displacement and the energy of their increment."""

    q: Array
    u: Array
    energy: float
    slips: NDArray[np.bool_]


class _Step:
    """One step: everything that stays while it is iterated."""

    def __init__(
        self, operator: TangentialOperator, bound: Array, before: Array, control: Control
    ) -> None:
        self.operator, self.bound, self.before, self.control = operator, bound, before, control
        self.along = control.along
        across = np.eye(len(before)) - self.along @ self.along.T
        self.given = across @ control.displacement
        self.caused = control.caused if control.caused is not None else np.zeros((len(before), 1))
        largest = float(bound.max(initial=0.0))
        # Of a displacement beyond full sliding the tractions take no notice.
        imposed = float(np.abs(self.given).max()) + float(np.abs(self.caused).max(initial=0.0))
        self.least = min(imposed, 2.0 * largest * operator.own)

    def floor(self, q: Array) -> float:
        """Round-off of the displacement between two tractions [m]."""
        largest = max(float(lengths(one).max(initial=0.0)) for one in (q, self.before))
        return _ROUND_OFF * largest * self.operator.largest

    def state(self, q: Array, slips: NDArray[np.bool_]) -> _State:
        x = q - self.before
        u = self.operator(x) + self.caused
        energy = 0.5 * float(np.vdot(x, u + self.caused)) - float(self.given @ x.sum(axis=1))
        return _State(q, u, energy, slips)

    def directions(self, state: _State) -> tuple[FreeDirections, Array]:
        """Free directions, and the reduced displacement g: its slip points along the traction."""
        normal = _unit(state.q)
        slips = state.slips
        for _ in range(3):
            g = state.u - self._rigid(state, slips, normal)[:, None]
            outward = -(g * normal).sum(axis=0)
            kept = state.slips & (outward >= 0.0)
            if np.array_equal(kept, slips):
                break
            slips = kept
        safe = np.maximum(self.bound, np.finfo(float).tiny)
        curvature = np.where(slips, np.maximum(outward, 0.0) / safe, 0.0)
        return FreeDirections(slips, normal, curvature), g

    def _rigid(self, state: _State, slips: NDArray[np.bool_], normal: Array) -> Array:
        """Rigid displacement: as imposed, or as the free pixels have it."""
        if self.along.shape[1] == 0:
            return self.given
        free = FreeDirections(slips, normal, np.zeros(slips.size))
        ones = free.uniform(self.along)
        gram = np.einsum("ikn,jkn->ij", ones, ones)
        n = slips.size
        if np.linalg.eigvalsh(gram)[0] > 1e-9 * n:
            rest = state.u - self.given[:, None]
            return np.asarray(
                self.given + self.along @ np.linalg.solve(gram, np.einsum("ikn,kn->i", ones, rest))
            )
        # Nothing sticks: the least displacement at which every pixel slips along its traction.
        rest = self.along.T @ (state.u - self.given[:, None])
        direction = self.along.T @ state.q.sum(axis=1)
        size = float(np.linalg.norm(direction))
        mean = rest.mean(axis=1)
        if size > 0.0:
            unit = direction / size
            mean = mean + unit * (float((unit @ rest).max()) - float(unit @ mean))
        return np.asarray(self.given + self.along @ mean)

    def violation(self, q: Array, g: Array) -> float:
        """Change of the tractions by a step along the gradient, as a displacement [m]."""
        own = self.operator.own
        return float(lengths(q - onto_discs(q - g / own, self.bound)).max()) * own

    def project(self, q: Array) -> Array:
        return onto_discs_and_sum(q, self.bound, self.along, self.control.total)


def solve_step(
    operator: TangentialOperator,
    bound: Array,
    before: Array,
    control: Control,
    rtol: float,
    start: Array | None = None,
) -> Increment:
    """Solve one implicit step.

    Parameters
    ----------
    operator : TangentialOperator
        H between the pixels in contact.
    bound : ndarray (n,)
        mu p [Pa].
    before : ndarray (k, n)
        Tractions of the last step [Pa].
    control : Control
        What is imposed.
    rtol : float
        Largest violation of a condition, over the largest elastic displacement of the step.
    start : ndarray (k, n), optional
        Tractions nearby to begin with [Pa].

    Returns
    -------
    Increment
        With a residual above `rtol` if the iterations stagnate.
    """
    first, step = operator.count, _Step(operator, bound, before, control)
    if _slides(control, bound):
        return _full_sliding(step)
    q = start if start is not None else towards(before, bound, control.along, control.total)
    q = step.project(q) if start is not None or control.along.shape[1] else q
    state = step.state(q, _at_bound(q, bound))
    best, last, changed = np.inf, np.inf, 1.0
    for iteration in range(1, _MOST_ITERATIONS + 1):
        free, g = step.directions(state)
        scale = max(float(np.abs(state.u).max()), step.least)
        found = step.violation(state.q, g)
        floor = step.floor(state.q)
        allowed = max(rtol * scale, floor)
        if found < best:
            best, end = (
                found,
                (state, free, g, found / max(scale, floor / rtol, np.finfo(float).tiny)),
            )
        if found <= allowed:
            break
        reduction = 0.1 if changed > 0.05 else max(min(0.05, 0.3 * allowed / found), 1e-10)
        if 0.0 < changed <= 0.05:
            reduction = max(reduction, 0.01)
        direction = _newton(step, free, g, reduction)
        new = _advance(step, state, free, g, direction)
        changed = float(np.mean(new.slips != free.slip))
        if new.energy >= state.energy and found >= 0.5 * last and iteration > 60:
            break  # round-off
        state, last = new, found
    state, free, g, residual = end
    slip = np.where(free.slip, -g, 0.0)
    rigid = (state.u - g)[:, 0] if g.size else step.given
    used = operator.count - first
    return Increment(state.q, rigid, slip, free.slip, residual, iteration, used)


def _slides(control: Control, bound: Array) -> bool:
    """Whether the imposed force is that of full sliding."""
    largest = float(bound.sum())
    return float(np.linalg.norm(control.total)) >= largest * (1.0 - _FULL)


def _full_sliding(step: _Step) -> Increment:
    """State at the onset of full sliding: the least displacement at which every pixel slips.

    Of two components it is a limit: the transverse slip, which vanishes against a growing
    displacement, is left out.
    """
    total = step.control.total
    e = step.along @ (total / max(float(np.linalg.norm(total)), np.finfo(float).tiny))
    state = step.state(e[:, None] * step.bound, np.ones(step.bound.size, dtype=bool))
    along = e @ state.u
    rigid = max(float(along.max()), float(e @ step.given))
    slip = e[:, None] * (rigid - along)
    displacement = step.given + (rigid - float(e @ step.given)) * e
    return Increment(state.q, displacement, slip, state.slips, 0.0, 1, 1)


def _unit(q: Array) -> Array:
    size = lengths(q)
    return np.asarray(q / np.where(size > 0.0, size, 1.0))


def _at_bound(q: Array, bound: Array) -> NDArray[np.bool_]:
    return np.asarray(lengths(q) >= bound * (1.0 - 1e-14))


def _advance(
    step: _Step, state: _State, free: FreeDirections, g: Array, direction: Array
) -> _State:
    """Take a step, shortened until it lowers the energy; along the gradient if that fails."""
    noise = 1e-14 * abs(state.energy) + np.finfo(float).tiny
    length = 1.0
    for _ in range(_SHORTENINGS):
        trial = state.q + length * direction
        slips = lengths(trial) >= step.bound
        slips |= free.slip
        trial = np.where(free.slip, _on_circle(trial, step.bound), trial)
        q = step.project(trial)
        new = step.state(q, slips & _at_bound(q, step.bound) | _at_bound(q, step.bound))
        if new.energy <= state.energy + noise:
            return new
        length *= 0.5
    q = step.project(state.q - g / step.operator.largest)
    return step.state(q, _at_bound(q, step.bound))


def _on_circle(q: Array, bound: Array) -> Array:
    return _unit(q) * bound


def _newton(step: _Step, free: FreeDirections, g: Array, reduction: float) -> Array:
    """Change of the free tractions that makes g vanish there, with the sums as they are."""
    along = step.along
    if along.shape[1] == 0 and step.operator.is_singular and not free.slip.any():
        # No displacement opposes a uniform traction: half of the pixels reach their bound.
        return np.asarray(_unit(-g.mean(axis=1, keepdims=True)) * np.median(step.bound))
    operator = step.operator
    ones = free.uniform(along)
    # Across a small disc the curved bound is stiffer than the solid.
    weight = 1.0 / np.sqrt(1.0 + free.curvature / operator.own)

    def inverse(r: Array) -> Array:
        return np.asarray(free.keep(weight * operator.inverse(weight * r)))

    shaped = np.array([inverse(one) for one in ones]).reshape(ones.shape)
    gram = np.einsum("ikn,jkn->ij", ones, shaped)
    regular = len(gram) == 0 or np.linalg.eigvalsh(gram)[0] > 1e-12 * np.trace(gram)

    def precondition(r: Array) -> Array:
        z = inverse(r)
        if len(gram) and regular:
            z -= np.tensordot(np.linalg.solve(gram, np.einsum("ikn,kn->i", ones, z)), shaped, 1)
        return np.asarray(z)

    x = np.zeros_like(g)
    if not regular:
        return x
    r = -free.keep(g)
    z = precondition(r)
    d, rz = z, float(np.vdot(r, z))
    target = reduction**2 * rz
    for _ in range(_MOST_INNER):
        if not rz > target or rz <= 0.0:
            break
        hd = free.keep(operator(d) + free.added(d))
        curvature = float(np.vdot(d, hd))
        if curvature <= 0.0:
            break
        x = x + (rz / curvature) * d
        r = r - (rz / curvature) * hd
        z = precondition(r)
        new = float(np.vdot(r, z))
        d, rz = z + (new / rz) * d, new
    return x


def stiffness(operator: TangentialOperator, increment: Increment, bound: Array) -> float:
    """Tangent stiffness over the area of a pixel [Pa/m], as what sticks now stays so.

    The sum of the tractions along the first component for a unit displacement along it.
    """
    k, n = increment.traction.shape
    along = np.zeros((k, 0))
    control = Control(along, np.zeros(0), np.eye(k)[0])
    step = _Step(operator, bound, increment.traction, control)
    outward = (increment.slip * _unit(increment.traction)).sum(axis=0)
    safe = np.maximum(bound, np.finfo(float).tiny)
    free = FreeDirections(
        increment.slips, _unit(increment.traction), np.where(increment.slips, outward / safe, 0.0)
    )
    if increment.slips.all() and k == 1:
        return 0.0
    if operator.is_singular and not increment.slips.any():
        return np.inf
    g = np.zeros((k, n))
    g[0] = -1.0
    return float(_newton(step, free, g, _STIFFNESS)[0].sum())
