"""A film on a grid and its states: pressure, liquid fraction, forces, volumes and power."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import Attribute, field, frozen

from ...units import si
from ...validators import Described, finite, non_negative, optional, part, positive, refuse
from .face import RESERVOIR, Face

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...validity import ValidityNumber
    from .discretisation import Balance

    Array = NDArray[np.floating[Any]]

__all__ = ["GridFilm", "GridFilmState", "HoleState"]


@frozen(kw_only=True, eq=False, slots=False)
class GridFilm(Described):
    """Liquid between two faces, and what it does under tension.

    Parameters
    ----------
    face : Face
        Planform, reservoirs and pockets.
    viscosity : float
        Dynamic viscosity [Pa.s].
    ambient : float
        Pressure on the outside of the faces [Pa], from the same zero as those of the reservoirs.
    drop : float
        Pressure in a cavity, as a drop below ambient [Pa]; by default infinite: the film never
        cavitates.
    tensile_strength : float, optional
        Tension below ambient at which an intact film cavitates [Pa], inf for one that never does.
        By default that of the cavity, `drop`.
    compressibility : float
        Compressibility of the liquid in the gap [1/Pa]; a film without a reservoir needs it.
    density : float, optional
        Density of the liquid [kg/m3], for the Reynolds number among `GridFilmState.validity`.

    Notes
    -----
    Two pressures: an intact film cavitates at ambient - tensile_strength; from then on the liquid
    that is connected with the spot holds no less than the cavity pressure, until it is full again.
    """

    face: Face = field(validator=part(Face))
    viscosity: float = field(validator=positive, metadata=si("Pa.s"))
    ambient: float = field(default=0.0, validator=finite, metadata=si("Pa"))
    drop: float = field(default=math.inf, metadata=si("Pa"))
    tensile_strength: float | None = field(default=None, metadata=si("Pa"))
    compressibility: float = field(default=0.0, validator=non_negative, metadata=si("1/Pa"))
    density: float | None = field(default=None, validator=optional(positive), metadata=si("kg/m3"))

    @drop.validator
    def _check_drop(self, attribute: Attribute[float], value: Any) -> None:
        if value == math.inf:
            return
        finite(self, attribute, value)
        least = self.ambient - min(self.ambient, self.lowest_reservoir)
        if value < least:
            cure = f"the lowest pressure around the film is {least:g} Pa below ambient"
            raise refuse(self, attribute, value, "lead below the pressure around the film", cure)

    @tensile_strength.validator
    def _check_strength(self, attribute: Attribute[Any], value: Any) -> None:
        if value is None or value == math.inf:
            return
        non_negative(self, attribute, value)
        if value < self.drop * (1.0 - 1e-12):
            cure = "a film that cavitates earlier has a cavity of a higher pressure: lower the drop"
            expected = f"be at least the drop to the cavity, {self.drop:g}"
            raise refuse(self, attribute, value, expected, cure)

    @property
    def lowest_reservoir(self) -> float:
        """Lowest pressure of the reservoirs [Pa]; ambient without any."""
        around = self.face.pressure[self.face.owner == RESERVOIR]
        return float(around.min()) if around.size else self.ambient

    @property
    def floor(self) -> float:
        """Pressure in a cavity [Pa], from the zero of `ambient`."""
        return self.ambient - self.drop

    @property
    def strength(self) -> float:
        """Tension below ambient at which an intact film cavitates [Pa]."""
        return self.drop if self.tensile_strength is None else self.tensile_strength


class HoleState(NamedTuple):
    """A hole of a face at one instant."""

    area: float
    """Area [m2]."""
    pressure: float
    """Pressure [Pa]."""
    flow: float
    """Volume flow out of the hole into the film [m3/s]."""
    force: float
    """Force of its pressure on the face, (ambient - p) times area, that resists separation [N]."""


@frozen(kw_only=True, eq=False, slots=False)
class GridFilmState:
    """Film at one instant.

    Parameters
    ----------
    film : GridFilm
        The film.
    gap : ndarray, shape (ny, nx)
        Gap [m].
    pressure : ndarray, shape (ny, nx)
        Pressure [Pa]; outside the film that of the reservoirs.
    liquid_fraction : ndarray, shape (ny, nx)
        Fraction theta of the gap that is liquid [-], 1 where the film is full.
    balance : Balance, optional
        The discrete film that was solved; None for a film at rest that has not moved yet.
    excess : ndarray, optional
        Flow gained between the rim and the sides of its cells (`Rim.excess`) [m3/s].
    beside_cavity : ndarray of bool, shape (ny, nx)
        Where liquid is connected with a cavity.
    lower_velocity, upper_velocity : tuple of float
        Tangential velocities of the walls along x and y [m/s].
    iterations : int
        Newton (active-set) iterations on this grid.
    residual : float
        Largest error of the volume balance over its largest term [-].
    time : float
        Time [s].
    """

    film: GridFilm
    gap: Array = field(repr=False)
    pressure: Array = field(repr=False)
    liquid_fraction: Array = field(repr=False)
    balance: Balance | None = field(default=None, repr=False)
    excess: Array | None = field(default=None, repr=False)
    beside_cavity: NDArray[np.bool_] = field(repr=False)
    lower_velocity: tuple[float, float] = (0.0, 0.0)
    upper_velocity: tuple[float, float] = (0.0, 0.0)
    iterations: int = 0
    residual: float = 0.0
    time: float = 0.0

    def _integral(self, values: Array) -> float:
        return float(values[self.film.face.loaded].sum()) * self.film.face.cell_area

    @cached_property
    def force(self) -> float:
        """Force of the film that resists separation [N].

        The integral of ambient - p over film and pockets; `pad_force` counts holes as well.
        """
        return self._integral(self.film.ambient - self.pressure)

    @cached_property
    def pad_force(self) -> float:
        """Force on the whole pad that resists separation [N]: film, pockets and holes."""
        return self.force + sum(hole.force for hole in self.holes)

    @cached_property
    def holes(self) -> tuple[HoleState, ...]:
        """Each `Hole` of the face, in the order they were given in: its flow and its force."""
        made, flow = self.film.face.holes, self._flow_at_rim
        ambient = self.film.ambient
        beyond = None if self.balance is None else self.balance.mesh.rim.beyond
        return tuple(
            HoleState(
                area,
                pressure,
                0.0 if beyond is None else float(flow[np.isin(beyond, cells)].sum()),
                (ambient - pressure) * area,
            )
            for area, pressure, cells in made
        )

    @cached_property
    def inflow(self) -> float:
        """Net volume flow into the film through all reservoirs and holes [m3/s]."""
        if self.balance is None:
            return 0.0
        return float(self._flow_at_rim[self.balance.mesh.rim_number < 0].sum())

    @cached_property
    def _flow_at_rim(self) -> Array:
        """Volume flow into the film through each side of the rim [m3/s]."""
        balance = self.balance
        if balance is None:
            return np.zeros(0)
        rim, p, theta = balance.mesh.rim, self.pressure.ravel(), self.liquid_fraction.ravel()
        driven = balance.outer * (p[rim.beyond] - p[rim.cell])
        outward = balance.carried[1] * rim.sign
        carried = np.where(outward > 0.0, outward * theta[rim.cell], outward)
        flow: Array = driven - carried
        return flow if self.excess is None else flow + self.excess

    @cached_property
    def torque(self) -> tuple[float, float]:
        """Moments of ambient - p with the arms x and y, about the origin of the grid [N.m]."""
        face, pull = self.film.face, self.film.ambient - self.pressure
        return self._integral(pull * face.x), self._integral(pull * face.y)

    @property
    def centre_of_pressure(self) -> tuple[float, float]:
        """Place (x, y) where the force acts [m]; the centroid of the film without a force."""
        force, (about_x, about_y) = self.force, self.torque
        if force == 0.0:
            face, ones = self.film.face, np.ones(self.gap.shape)
            area = self._integral(ones)
            return self._integral(face.x * ones) / area, self._integral(face.y * ones) / area
        return about_x / force, about_y / force

    @cached_property
    def liquid_volume(self) -> float:
        """Volume of liquid in the film and its pockets [m3]."""
        volume = self._integral(self.liquid_fraction * self.gap)
        for number, (more, _) in enumerate(self.film.face.pockets, start=1):
            held = self.liquid_fraction[self.film.face.owner == number]
            volume += more * float(held.mean()) if held.size else 0.0
        return volume

    @cached_property
    def void_volume(self) -> float:
        """Volume of the cavities [m3]."""
        return self._integral((1.0 - self.liquid_fraction) * self.gap)

    @property
    def cavity_area(self) -> float:
        """Area of the cells with voids [m2]."""
        return self._integral((self.liquid_fraction < 1.0).astype(float))

    @property
    def dissipation(self) -> float:
        r"""Power that flow under pressure dissipates [W].

        Notes
        -----
        :math:`\int h^3/(12\eta) |\nabla p|^2 dA`, as the sum over the sides of the cells. Without
        sliding, and with all reservoirs at ambient, force times opening speed is this plus
        (ambient - cavity pressure) times the growth of the void volume.
        """
        if self.balance is None:
            return 0.0
        mesh, p = self.balance.mesh, self.pressure.ravel()
        inside = p[mesh.sides.high] - p[mesh.sides.low]
        rim = p[mesh.rim.beyond] - p[mesh.rim.cell]
        power = float(self.balance.inner @ inside**2 + self.balance.outer @ rim**2)
        return power if self.excess is None else power + float(self.excess @ rim)

    @cached_property
    def validity(self) -> tuple[ValidityNumber, ...]:
        """Numbers that state whether the film is in the range of its model.

        Tension in the liquid, slope and thickness of the gap, slenderness, inertia, grid.
        """
        from .validity import film_numbers

        return film_numbers(self)

    @property
    def pressure_gradient(self) -> tuple[Array, Array]:
        """Pressure gradient in each cell along y and x, the mean of those at its sides [Pa/m]."""
        return _gradient(self)

    @property
    def shear_force(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Tangential forces (x, y) of the film on the lower and on the upper wall [N]."""
        lower, upper = self.shear_traction
        return (
            (self._integral(lower[0]), self._integral(lower[1])),
            (self._integral(upper[0]), self._integral(upper[1])),
        )

    @property
    def shear_traction(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        r"""Tangential traction (x, y) of the film on the lower and on the upper wall [Pa].

        Notes
        -----
        :math:`\mp \eta \theta (u_2 - u_1)/h - (h/2) \nabla p` on the upper (-) and lower (+) wall:
        fingers of liquid in a cavity carry shear as the film does, by the liquid fraction.
        """
        slope_y, slope_x = self.pressure_gradient
        couette = self.film.viscosity * self.liquid_fraction / self.gap
        inside = self.film.face.loaded
        walls = []
        for sign in (1.0, -1.0):
            parts = []
            for axis, slope in ((0, slope_x), (1, slope_y)):
                shear = self.upper_velocity[axis] - self.lower_velocity[axis]
                parts.append(np.where(inside, sign * couette * shear - 0.5 * self.gap * slope, 0.0))
            walls.append((parts[0], parts[1]))
        return walls[0], walls[1]


def _gradient(state: GridFilmState) -> tuple[Array, Array]:
    """Pressure gradient in each cell along y and x: means of those at its two sides [Pa/m]."""
    slopes = np.zeros((2, state.pressure.size))
    if state.balance is None:
        zero = np.zeros(state.pressure.shape)
        return zero, zero
    mesh, p = state.balance.mesh, state.pressure.ravel()
    size = np.array(state.film.face.pixel_size)
    slope = (p[mesh.sides.high] - p[mesh.sides.low]) / size[mesh.sides.axis]
    np.add.at(slopes, (mesh.sides.axis, mesh.sides.low), 0.5 * slope)
    np.add.at(slopes, (mesh.sides.axis, mesh.sides.high), 0.5 * slope)
    at_rim = mesh.rim.sign * (p[mesh.rim.beyond] - p[mesh.rim.cell]) / mesh.rim.distance
    np.add.at(slopes, (mesh.rim.axis, mesh.rim.cell), 0.5 * at_rim)
    return slopes[0].reshape(state.pressure.shape), slopes[1].reshape(state.pressure.shape)
