"""What is pressed together: two bodies, perhaps a liquid between them, and the window looked at.

Conventions, stated once: `lower` lies below and `upper` above; a height points out of its own
body; pressure is positive in compression, the gap positive when open; z points down into the
lower body; arrays are ``[y, x]`` and stresses ``[component, y, x]``, components xx, yy, zz, xy,
xz, yz, tension positive. A slider that moves along +x drags the lower body along +x.
"""

from __future__ import annotations

from typing import Any

from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..units import si
from ..validators import finite, optional, part, positive, refuse
from .interface import Meniscus
from .materials import Material, Stack
from .shapes import Flat
from .topography import SHAPES, CombinedSurface, Topography

__all__ = ["Body", "ContactInterface", "Pressing", "Window"]


@frozen(kw_only=True)
class Body:
    """A body in contact: its surface, and what it is made of.

    Parameters
    ----------
    surface : shape
        Its surface, smooth or rough; flat if not given.
    solid : Material, Stack or None
        A homogeneous solid or a stack of layers. None: rigid.
    """

    surface: Topography = field(factory=Flat, validator=part(*SHAPES, CombinedSurface))
    solid: Material | Stack | None = field(default=None, validator=optional(part(Material, Stack)))

    @property
    def stack(self) -> Stack | None:
        """The solid as a stack; None if rigid."""
        return Stack(substrate=self.solid) if isinstance(self.solid, Material) else self.solid


@frozen(kw_only=True)
class ContactInterface:
    """Two bodies to be pressed together, and the liquid between them, if any.

    Parameters
    ----------
    lower, upper : Body
        The bodies. At least one of them is not rigid.
    meniscus : Meniscus, optional
        The liquid, for the effects that ask for it.
    """

    lower: Body = field(validator=part(Body))
    upper: Body = field(factory=Body, validator=part(Body))
    meniscus: Meniscus | None = field(default=None, validator=optional(part(Meniscus)))

    def __attrs_post_init__(self) -> None:
        if self.lower.solid is None and self.upper.solid is None:
            raise DescriptionError(
                "ContactInterface.lower.solid",
                None,
                "be a Material or a Stack where the upper body is rigid",
                hint="two rigid bodies touch in points; give one of them a material",
            )

    @property
    def stacks(self) -> tuple[Stack, ...]:
        """Stacks of the bodies that deform, the lower first."""
        return tuple(s for s in (self.lower.stack, self.upper.stack) if s is not None)


@frozen(kw_only=True)
class Window:
    """The part of the interface that is looked at.

    Parameters
    ----------
    width : float, optional
        Its size along x [m]. None: that of a measured surface.
    height : float, optional
        Its size along y [m]. None: as along x.
    periodic : bool
        Whether the surfaces repeat beyond the edges. If not, the bodies extend without load
        beyond the window: an isolated contact.
    """

    width: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    height: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    periodic: bool = field(default=True, validator=part(bool))


_IMPOSED = ("pressure", "force", "approach")


@frozen(kw_only=True)
class Pressing:
    """How the bodies are pressed together. Exactly one of the three is imposed.

    Parameters
    ----------
    pressure : float, optional
        Mean pressure over the window [Pa].
    force : float, optional
        Normal force on the window [N].
    approach : float, optional
        Rigid approach of the bodies from first touch [m]. Without neighbours (a window that is
        not periodic) it is that of points far away; in a periodic window it is that of the mean
        planes of the deformed surfaces.
    """

    pressure: float | None = field(default=None, validator=optional(finite), metadata=si("Pa"))
    force: float | None = field(default=None, validator=optional(finite), metadata=si("N"))
    approach: float | None = field(default=None, validator=optional(finite), metadata=si("m"))

    @pressure.validator
    @force.validator
    def _not_pulled(self, attribute: Attribute[Any], value: Any) -> None:
        if value is not None and value < 0.0:
            raise refuse(
                self, attribute, value, "be zero or positive", "a pull is a matter of separation"
            )

    def __attrs_post_init__(self) -> None:
        given = [name for name in _IMPOSED if getattr(self, name) is not None]
        if len(given) != 1:
            raise DescriptionError(
                "Pressing",
                given or "none",
                "be given exactly one of pressure [Pa], force [N] or approach [m]",
            )

    def mean_pressure(self, area: float) -> float | None:
        """Mean pressure [Pa] over a window of an area [m2]; None if the approach is imposed."""
        if self.force is not None:
            return self.force / area
        return self.pressure
