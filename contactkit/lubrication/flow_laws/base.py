r"""Flow law of a liquid in a thin film: flux between parallel walls over the pressure gradient.

The stress is linear across the film, and the shear rate a function of the stress, so that one
function of the wall stress says all (Weissenberg and Rabinowitsch). Without slip

.. math:: \Gamma = \frac{6 q}{h^2} = \frac{3}{\tau_w^2}\int_0^{\tau_w}
          \tau \, \dot\gamma(\tau) \, d\tau, \qquad \tau_w = \frac h2 \frac{dp}{dx}

and slip adds :math:`6 (b/h) \dot\gamma(\tau_w)`. Gamma is the wall shear rate of a Newtonian
liquid of that flux. A pressure divides the shear rate at a given stress by the factor M(p) of the
viscosity (superposition at constant stress, Bair): fluxes scale with 1/M.

=======  ==============================================  =====
symbol   quantity                                        unit
=======  ==============================================  =====
q        flux per width                                  m2/s
h        gap                                             m
b        slip length                                     m
tau_w    wall stress                                     Pa
M        viscosity over that at ambient pressure         -
=======  ==============================================  =====

References
----------
Rabinowitsch (1929); Bird, Armstrong and Hassager, Dynamics of Polymeric Liquids 1, sections 4.2
and 10.2; Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics, for the superposition.
"""

from __future__ import annotations

import abc
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import Attribute, field, frozen

from ...units import si
from ...validators import non_negative, refuse
from .gap_flow import GapFlow, WallFlow, alike, positive_root, unlike
from .pressure_laws import PressureLaw

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["FlowLaw", "arrays", "plain"]


def _pair(value: Any) -> Any:
    """One slip length for both walls."""
    return (value, value) if isinstance(value, int | float | str) else tuple(value)


def _slip(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Check each of the two slip lengths."""
    if len(value) != 2:
        raise refuse(owner, attribute, value, "be one slip length, or those of both walls")
    for one in value:
        non_negative(owner, attribute, one)


@frozen(kw_only=True)
class FlowLaw(abc.ABC):
    """Relation of flux, gap, pressure gradient and pressure in a thin film.

    Parameters
    ----------
    slip_length : float or tuple of float
        Navier's slip length b of both walls, or of the lower and the upper one [m]: the liquid
        slips along a wall at b times its shear rate there.
    pressure_law : PressureLaw, optional
        Viscosity over pressure. None: as at ambient pressure.

    Notes
    -----
    Fluxes and gradients are magnitudes; of either sign they are odd functions. Arguments are floats
    or arrays that broadcast; they are not checked. The gap is positive. Accurate to 1e-14 unless a
    law says otherwise.
    """

    slip_length: tuple[float, float] = field(
        default=(0.0, 0.0), converter=_pair, validator=_slip, metadata=si("m")
    )
    pressure_law: PressureLaw | None = None

    @property
    def is_newtonian_at_rest(self) -> bool:
        """Whether the viscosity has a finite limit, and not 0, at low shear rates."""
        return True

    @abc.abstractmethod
    def wall_flow(self, parameter: Array) -> WallFlow:
        """Flow of a half film at ambient pressure at the parameter of the law, positive."""

    @abc.abstractmethod
    def start(self, apparent_rate: Array) -> Array:
        """Parameter near that of an apparent rate [1/s]."""

    @abc.abstractmethod
    def of_stress(self, stress: Array) -> Array:
        """Parameter of a wall stress [Pa]."""

    def gradient(self, flux: ArrayLike, gap: ArrayLike, pressure: ArrayLike = 0.0) -> Any:
        """Pressure gradient [Pa/m] that drives a flux per width.

        Parameters
        ----------
        flux : float or ndarray, shape (...)
            Flux per width [m2/s].
        gap : float or ndarray, shape (...)
            Distance of the walls [m].
        pressure : float or ndarray, shape (...)
            Pressure relative to ambient [Pa].

        Returns
        -------
        float or ndarray, shape (...)
            Gradient [Pa/m].

        Examples
        --------
        >>> from contactkit.lubrication.flow_laws.newtonian import Newtonian
        >>> round(Newtonian(viscosity=0.1).gradient(1e-9, 1e-5), 3)
        1200000.0
        """
        flow = self.flow(flux, gap, pressure)
        return plain(np.sign(flux) * (2.0 * flow.drive / np.asarray(gap)))

    def flux(self, gradient: ArrayLike, gap: ArrayLike, pressure: ArrayLike = 0.0) -> Any:
        """Flux per width [m2/s] that a pressure gradient [Pa/m] drives; the inverse of `gradient`.

        Examples
        --------
        >>> from contactkit.lubrication.flow_laws.newtonian import Newtonian
        >>> law = Newtonian(viscosity=0.1, slip_length=1e-6)
        >>> round(law.flux(law.gradient(1e-9, 1e-5), 1e-5) * 1e9, 12)
        1.0
        """
        g, h, p = arrays(gradient, gap, pressure)
        flow = self.driven(np.abs(g) * h * 0.5, h)
        return plain(np.sign(g) * flow.rate * h * h / 6.0 / self.multiplier(p))

    def wall_stress(self, flux: ArrayLike, gap: ArrayLike, pressure: ArrayLike = 0.0) -> Any:
        """Larger wall stress [Pa] at a flux per width [m2/s]; arguments of `gradient`."""
        return plain(self.flow(flux, gap, pressure).wall_stress)

    def wall_shear_rate(self, flux: ArrayLike, gap: ArrayLike, pressure: ArrayLike = 0.0) -> Any:
        """Larger shear rate at a wall [1/s]; arguments of `gradient`."""
        return plain(self.flow(flux, gap, pressure).wall_rate / self.multiplier(pressure))

    def mean_shear_rate(self, flux: ArrayLike, gap: ArrayLike, pressure: ArrayLike = 0.0) -> Any:
        """Mean magnitude of the shear rate over the gap [1/s]; arguments of `gradient`."""
        return plain(self.flow(flux, gap, pressure).mean_rate / self.multiplier(pressure))

    def multiplier(self, pressure: ArrayLike) -> Any:
        """Viscosity at a pressure [Pa] over that at ambient pressure [-]."""
        return 1.0 if self.pressure_law is None else self.pressure_law.multiplier(pressure)

    def flow(self, flux: ArrayLike, gap: ArrayLike, pressure: ArrayLike = 0.0) -> GapFlow:
        """Flow at a flux; its rates are those at ambient pressure. Arguments of `gradient`."""
        q, h, p = arrays(flux, gap, pressure)
        rate = np.abs(q) * (6.0 / (h * h)) * self.multiplier(p)
        moves = rate > 0.0
        target = np.where(moves, rate, 1.0)

        def residual(parameter: Array) -> tuple[Array, Array]:
            found = self.at(parameter, h)
            return np.log(target / found.rate), found.rate_slope

        largest = np.maximum(*self.slip_length) / h
        start = self.start(target / (1.0 + 6.0 * np.minimum(largest, 0.5)))
        return _at_rest(self.at(positive_root(residual, start), h), moves)

    def driven(self, drive: Array, gap: Array) -> GapFlow:
        """Flow at ambient pressure under half the gap times the gradient [Pa]."""
        moves = drive > 0.0
        target = np.where(moves, drive, 1.0)
        if self.slip_length[0] == self.slip_length[1]:
            return _at_rest(self.at(self.of_stress(target), gap), moves)

        def residual(parameter: Array) -> tuple[Array, Array]:
            found = self.at(parameter, gap)
            return np.log(target / found.drive), found.drive_slope

        return _at_rest(self.at(positive_root(residual, self.of_stress(target)), gap), moves)

    def at(self, parameter: Array, gap: Array) -> GapFlow:
        """Flow at ambient pressure at the parameter of the half film of the wall with less slip."""
        less, more = sorted(self.slip_length)
        flow = self.wall_flow(parameter)
        if less == more:
            return alike(flow, less / gap)
        return unlike(self, flow, less / gap, more / gap)


def arrays(*values: ArrayLike) -> list[Array]:
    """Arguments as arrays of one shape."""
    return list(np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in values)))


def plain(value: Any) -> Any:
    """A float of an array of no dimensions."""
    return value.item() if np.ndim(value) == 0 else value


def _at_rest(flow: GapFlow, moves: Any) -> GapFlow:
    """The flow, zero where nothing moves; exponents stay."""
    if moves.all():
        return flow
    drive, rate, stress, at_wall, mean = (np.where(moves, part, 0.0) for part in flow[:5])
    return GapFlow(drive, rate, stress, at_wall, mean, flow.drive_slope, flow.rate_slope)
