"""Two bodies, and the liquid between them.

Conventions, stated once: `lower` lies below and `upper` above; the gap is positive when open and
is the shortest distance between the bodies; a height points out of its own body; pressure is
positive in compression; z points down into the lower body; arrays are ``[y, x]`` and stresses
``[component, y, x]``, components xx, yy, zz, xy, xz, yz, tension positive. A slider that moves
along +x drags the lower body along +x. Contact angles are measured through the liquid; a force
of the liquid is positive when it resists separation.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from attrs import evolve, field, frozen

from ..errors import DescriptionError, PlanError
from ..validators import Described, optional, part
from .materials import Solid, Stack
from .meniscus import Meniscus
from .surfaces import Flat, OwnGrid, Surface, one_grid
from .topography import as_surface

if TYPE_CHECKING:
    from ..accuracy import Accuracy

__all__ = ["Body", "Interface", "own_grid"]


@frozen(kw_only=True)
class Body(Described):
    """A surface, and the solid below it.

    Parameters
    ----------
    surface : Surface
        Its surface, smooth or rough; flat if not given. A topography object of SurfaceTopography
        is taken as `Heights`.
    solid : Material, Stack, another Solid or None
        A homogeneous solid, a stack of layers, or a solid of one's own. None: rigid.
    """

    surface: Surface = field(factory=Flat, converter=as_surface, validator=part(Surface))
    solid: Solid | None = field(default=None, validator=optional(part(Solid)))

    @property
    def stack(self) -> Stack | None:
        """The solid as a stack; None if rigid."""
        made: Any = None if self.solid is None else self.solid.stack
        if not isinstance(made, Stack | None):
            kind = type(self.solid).__name__
            raise PlanError(f"{kind}.stack must be a Stack, the solid in layers; got {made!r}")
        return made

    @property
    def elastic_stack(self) -> Stack:
        """The solid as a stack; a rigid body is refused."""
        if self.stack is None:
            raise PlanError("a rigid body has no stress: give its solid, a Material or a Stack")
        return self.stack


def as_body(value: Any) -> Any:
    """Take a bare surface, or a topography, for a rigid body of that surface."""
    surface = as_surface(value)
    return Body(surface=surface) if isinstance(surface, Surface) else value


@frozen(kw_only=True)
class Interface(Described):
    """Two bodies, and the meniscus between them.

    Parameters
    ----------
    lower, upper : Body or Surface
        The bodies; a surface stands for a rigid body of that surface.
    meniscus : Meniscus, optional
        The liquid between them: of a separation and a sliding, and of a contact whose effects ask
        for it.

    Examples
    --------
    >>> from contactkit.scene.surfaces import Sphere
    >>> Interface(upper=Sphere(radius=1e-6)).curvature
    1000000.0
    """

    lower: Body = field(factory=Body, converter=as_body, validator=part(Body))
    upper: Body = field(factory=Body, converter=as_body, validator=part(Body))
    meniscus: Meniscus | None = field(default=None, validator=optional(part(Meniscus)))

    @property
    def bodies(self) -> tuple[Body, Body]:
        """The bodies, the lower first."""
        return self.lower, self.upper

    @property
    def stacks(self) -> tuple[Stack, ...]:
        """Stacks of the bodies that deform, the lower first."""
        return tuple(body.stack for body in self.bodies if body.stack is not None)

    def at_rate(self, rate: float) -> Interface:
        """Interface of elastic bodies, of the moduli at a rate [1/s]; see `Material.at_rate`."""
        if not any(stack.relaxes for stack in self.stacks):
            return self
        lower, upper = (
            body if body.stack is None else evolve(body, solid=body.stack.at_rate(rate))
            for body in self.bodies
        )
        return evolve(self, lower=lower, upper=upper)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures of the lower and the upper body at their apexes [1/m]."""
        return _curvature(self.lower.surface), _curvature(self.upper.surface)

    @property
    def curvature(self) -> float:
        """Relative curvature 1/R of the two bodies at their apexes [1/m]; 0 for two flats."""
        lower, upper = self.curvatures
        return lower + upper

    @property
    def is_flat(self) -> bool:
        """Whether both bodies are flat."""
        return all(isinstance(body.surface, Flat) for body in self.bodies)

    @property
    def faces(self) -> tuple[Flat, ...]:
        """Faces of the flat bodies, the lower first."""
        return tuple(body.surface for body in self.bodies if isinstance(body.surface, Flat))

    @property
    def has_discs(self) -> bool:
        """Whether each flat body is an even disc, or an even face without end."""
        return all(face.is_disc for face in self.faces)

    @property
    def rim_radius(self) -> float:
        """Radius of the smaller face [m], beyond which the film cannot spread; inf if none.

        Of a face that is no disc the radius of a disc of the same area.
        """
        return min((face.equal_radius for face in self.faces), default=math.inf)

    @property
    def sphere_radius(self) -> float:
        """Relative radius R of the two bodies at their apexes [m]; inf for two flats."""
        return 1.0 / self.curvature if self.curvature else math.inf


def _curvature(surface: Surface) -> float:
    if surface.curvature is None:
        raise PlanError(f"{type(surface).__name__} has no round apex; give a Flat or a Sphere")
    return surface.curvature


def own_grid(interface: Interface, accuracy: Accuracy) -> OwnGrid | None:
    """Grid of the height maps of the bodies; None if there is no map.

    Raises
    ------
    DescriptionError
        If two surfaces bring different grids, or `Accuracy.grid` is another.
    """
    brought = frozenset[OwnGrid]().union(*(body.surface.own_grids for body in interface.bodies))
    own = one_grid(brought, "Interface", "surfaces", "resample one of the maps")
    if own is not None and accuracy.grid is not None and accuracy.shape != own[0]:
        raise DescriptionError(
            "Accuracy.grid", accuracy.grid, f"be that of the height map, {own[0]}, or left out"
        )
    return own
