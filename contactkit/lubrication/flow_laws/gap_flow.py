"""Flow between two walls from that of two half films, with slip at either; roots of flow laws."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from ...errors import ConvergenceError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["GapFlow", "WallFlow", "alike", "positive_root", "unlike"]

_MOST = 200  # iterations: Newton's method takes 3 to 12, halving of a bracket over 300 decades 60


class WallFlow(NamedTuple):
    """Flow of a half film, from the plane without stress to a wall; arrays of one shape."""

    stress: Array
    """Stress at the wall [Pa]."""
    rate: Array
    """Shear rate at the wall [1/s]."""
    mean_rate: Array
    """Mean shear rate of the half film, its velocity over its height [1/s]."""
    apparent_rate: Array
    """Rate Gamma of its flux without slip [1/s]."""
    stress_slope: Array
    """d ln(stress)/d ln(parameter) [-]."""
    rate_slope: Array
    """d ln(rate)/d ln(parameter) [-]."""


class HalfFilms(Protocol):
    """Half films of a law, over its parameter; see `FlowLaw`."""

    def wall_flow(self, parameter: Array) -> WallFlow:
        """Flow of a half film."""

    def of_stress(self, stress: Array) -> Array:
        """Parameter of a wall stress [Pa]."""


class GapFlow(NamedTuple):
    """Flow between two walls at ambient pressure; arrays of one shape."""

    drive: Array
    """Half the gap times the pressure gradient, the mean of both wall stresses [Pa]."""
    rate: Array
    """Rate Gamma of the flux with slip, 6 q/h^2 [1/s]."""
    wall_stress: Array
    """Larger of both wall stresses [Pa]."""
    wall_rate: Array
    """Larger shear rate at a wall [1/s]."""
    mean_rate: Array
    """Mean magnitude of the shear rate over the gap [1/s]."""
    drive_slope: Array
    """d ln(drive)/d ln(parameter) [-]."""
    rate_slope: Array
    """d ln(rate)/d ln(parameter) [-]."""

    @property
    def exponent(self) -> Array:
        """Slope d ln(drive)/d ln(rate): 1 of a Newtonian liquid, n of a power law."""
        return self.drive_slope / self.rate_slope


def alike(flow: WallFlow, slip_ratio: Array) -> GapFlow:
    """Flow between two walls of one slip length over gap, b/h [-]."""
    slip = 6.0 * slip_ratio * flow.rate
    rate = flow.apparent_rate + slip
    rise = (3.0 * flow.rate - 2.0 * flow.apparent_rate) * flow.stress_slope
    slope = (rise + slip * flow.rate_slope) / rate
    return GapFlow(
        flow.stress, rate, flow.stress, flow.rate, flow.mean_rate, flow.stress_slope, slope
    )


def unlike(law: HalfFilms, flow: WallFlow, less: Array, more: Array) -> GapFlow:
    r"""Flow between walls of two slip lengths over gap, at the flow of the half with less slip.

    The plane without stress lies where both halves have one velocity, with
    :math:`S = \tau_1 + \tau_2` and :math:`C` the mean rates:

    .. math:: \frac{b_1}{h} \dot\gamma_1 + \frac{\tau_1 C_1}{S}
              = \frac{b_2}{h} \dot\gamma_2 + \frac{\tau_2 C_2}{S}
    """
    is_known = np.isfinite(flow.rate) & np.isfinite(flow.apparent_rate)  # else too large a trial

    def residual(parameter: Array) -> tuple[Array, Array]:
        other = law.wall_flow(parameter)
        (one, one_by), (two, two_by) = _velocities(flow, other, less, more)
        # Both velocities as logarithms: of Eyring's law they are exponentials of the stress.
        slope = two_by / two - one_by / one
        return np.where(is_known, np.log(one / two), 0.0), np.where(is_known, slope, 1.0)

    # The plane of a Newtonian liquid, and a stress that is never the larger one.
    start = law.of_stress(flow.stress * (1.0 + 2.0 * less) / (1.0 + 2.0 * more))
    other = law.wall_flow(positive_root(residual, start))
    (_, one_by), (_, two_by) = _velocities(flow, other, less, more)
    # The plane of both velocities: the same from the other half gives the slopes over this one.
    (_, two_by_this), (_, one_by_this) = _velocities(other, flow, more, less)
    follows = (one_by_this - two_by_this) / (two_by - one_by)
    both = flow.stress + other.stress
    weight, beside = flow.stress / both, other.stress / both
    slip = 6.0 * (less * flow.rate * weight + more * other.rate * beside)
    inner = 2.0 * (weight**2 * flow.apparent_rate + beside**2 * other.apparent_rate)
    drive_slope = weight * flow.stress_slope + beside * other.stress_slope * follows
    # From tau_i (b_i/h) rate_i and the moments of the rate, whose slope is tau_i^2 rate_i.
    slope = slip * -drive_slope - 2.0 * inner * drive_slope
    for one, part, ratio, factor in (
        (flow, weight, less, np.ones_like(follows)),
        (other, beside, more, follows),
    ):
        by = 6.0 * ratio * one.rate * part * (one.stress_slope + one.rate_slope)
        slope = slope + factor * (by + 6.0 * part**2 * one.rate * one.stress_slope)
    rate = slip + inner
    mean = weight * flow.mean_rate + beside * other.mean_rate
    return GapFlow(0.5 * both, rate, flow.stress, flow.rate, mean, drive_slope, slope / rate)


def _velocities(
    one: WallFlow, other: WallFlow, less: Array, more: Array
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Velocities of both halves over the gap, each with its slope over ln(parameter of `other`)."""
    both = one.stress + other.stress
    weight, beside = one.stress / both, other.stress / both
    of_one, of_other = weight * one.mean_rate, beside * other.mean_rate
    # The mean rate times the stress has the rate as its slope.
    by_one = -of_one * beside * other.stress_slope
    by_other = more * other.rate * other.rate_slope
    by_other = by_other + (other.rate - of_other) * beside * other.stress_slope
    return (less * one.rate + of_one, by_one), (more * other.rate + of_other, by_other)


def positive_root(residual: Callable[[Array], tuple[Array, Array]], start: Array) -> Array:
    """Root of functions that fall over a positive variable: Newton in its logarithm, bracketed.

    Parameters
    ----------
    residual : callable
        Value, positive below the root, and minus its slope over the logarithm, of an array.
    start : ndarray
        Positive first guess.

    Raises
    ------
    ConvergenceError
        If it does not settle.

    Examples
    --------
    >>> root = positive_root(lambda x: (np.log(2.0 / x**2), 2.0 + 0.0 * x), np.array([1e3]))
    >>> round(float(root[0] ** 2), 14)
    2.0
    """
    x = np.array(start, dtype=float)
    low, high = np.zeros_like(x), np.full_like(x, np.inf)
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        for _ in range(_MOST):
            value, slope = residual(x)
            low, high = np.where(value > 0.0, x, low), np.where(value < 0.0, x, high)
            step = np.clip(value / slope, -3.0, 3.0)  # at most a factor of 20 a step
            step = np.where(np.isfinite(step), step, -1.0)  # too large a stress overflows
            settled = np.abs(step) <= 1e-8  # whose square is round-off
            moved = x * np.exp(step)
            middle = np.sqrt(np.maximum(low, 1e-300)) * np.sqrt(np.minimum(high, 1e300))
            x = np.where(settled | ((moved > low) & (moved < high)), moved, middle)
            if settled.all():
                return x
    raise ConvergenceError("the flow law has no wall stress for this flux", x)
