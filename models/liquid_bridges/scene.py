"""The file of a comparison of closures of liquid bridges: contact angles, and the filling.

Every bridge is scaled to unit volume, so no liquid is named.
"""

from __future__ import annotations

import math
from typing import ClassVar

from attrs import field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import angle, as_tuple, count, fraction, optional, positive
from ..device import Device

__all__ = ["BridgeCase", "Bridges"]


@frozen(kw_only=True)
class BridgeCase:
    """One bridge, up to its size.

    Parameters
    ----------
    contact_angle_lower, contact_angle_upper : float
        Contact angles [rad]; on the lower body the one further from a right angle.
    filling : float, optional
        Volume over the cube of the radius of the sphere above the flat [-]. None: between flats.
    """

    contact_angle_lower: float = field(validator=angle, metadata=si("rad"))
    contact_angle_upper: float = field(validator=angle, metadata=si("rad"))
    filling: float | None = field(default=None, validator=optional(positive), metadata=si("-"))

    def __attrs_post_init__(self) -> None:
        lower, upper = self.contact_angle_lower, self.contact_angle_upper
        sphere = self.filling is not None and lower + upper > math.pi
        if lower + upper == math.pi or sphere:
            raise DescriptionError(
                "BridgeCase.contact_angle_upper",
                upper,
                f"not add up to pi with contact_angle_lower = {lower:g}, nor to more under a "
                f"sphere",
                unit="rad",
                hint="the reference knows no such bridge",
            )
        if abs(math.cos(lower)) < abs(math.cos(upper)):
            raise DescriptionError(
                "BridgeCase.contact_angle_lower",
                lower,
                f"be further from a right angle than contact_angle_upper = {upper:g}",
                unit="rad",
                hint="between flats the two may be swapped",
            )

    @property
    def curvature(self) -> float:
        """Curvature of the upper body times the cube root of the volume [-]; 0 for a flat."""
        return 0.0 if self.filling is None else self.filling ** (1.0 / 3.0)

    @property
    def label(self) -> str:
        """Short name: bodies, filling, angles in degrees."""
        pair = (self.contact_angle_lower, self.contact_angle_upper)
        angles = "/".join(f"{math.degrees(one):.4g}" for one in pair)
        bodies = "flats" if self.filling is None else f"sphere V/R^3 = {self.filling:g}"
        return f"{bodies}, {angles} deg"


@frozen(kw_only=True)
class Bridges(Device):
    """Bridges whose closures are compared.

    Parameters
    ----------
    bridges : tuple of BridgeCase
        The bridges.
    gaps : int
        Points of the force curve that is timed.
    reach : float
        End of the curve over the exact limit [-].
    """

    reported_by: ClassVar[str] = f"{__package__}.report.run"

    name: str = "liquid bridges"
    bridges: tuple[BridgeCase, ...] = field(converter=as_tuple)
    gaps: int = field(default=200, validator=count, metadata=si("-"))
    reach: float = field(default=0.95, validator=fraction, metadata=si("-"))
