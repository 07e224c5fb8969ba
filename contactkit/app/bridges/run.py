"""Liquid bridges by their closures: how far the arc and the printed equations are off.

``contactkit run bridges`` prints the errors over the way to rupture, ``contactkit cost bridges``
draws them against time. A bridge is its contact angles and, under a sphere, its filling.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from attrs import field, frozen

from ...errors import DescriptionError, PlanError
from ...files.scenes import structure
from ...units import si
from ...validators import angle, as_tuple, count, fraction, optional, positive
from ..report import Report

__all__ = ["BridgeCase", "Bridges", "open_device"]

Progress = Callable[[float], None]


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
class Bridges:
    """Bridges to be judged, as the command line runs them.

    Parameters
    ----------
    bridges : tuple of BridgeCase
        The bridges.
    gaps : int
        Points of the force curve that is timed.
    reach : float
        How far the curve goes, as a share of the exact limit [-].
    """

    name: str = "liquid bridges"
    bridges: tuple[BridgeCase, ...] = field(converter=as_tuple)
    gaps: int = field(default=200, validator=count, metadata=si("-"))
    reach: float = field(default=0.95, validator=fraction, metadata=si("-"))

    def plan_text(self) -> str:
        """See `Runnable.plan_text`."""
        lines = [f"{self.name}: exact, arc, and as published (Eqs. (3.11), (3.12), zero neck)"]
        lines += [f"  {case.label}" for case in self.bridges]
        lines.append("reference: Legendre's integrals; Orr, Scriven and Rivas 1975")
        return "\n".join(lines)

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Runnable.run`."""
        from .errors import error_report

        return error_report(self, out, progress)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Runnable.cost`."""
        from ..cost.bridges import bridge_cost

        return bridge_cost(self, out, error, progress)

    def fmu_start(self) -> tuple[str, Mapping[str, Any]]:
        """See `Runnable.fmu_start`."""
        raise PlanError("bridges are compared, not moved: they have no FMU; a separation has one")


def open_device(tables: Mapping[str, Any], origin: str) -> Bridges:
    """Read the bridges of a scene file."""
    return structure(dict(tables), Bridges, origin)
