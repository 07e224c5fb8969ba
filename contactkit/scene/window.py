"""The window of a contact, and its grid of pixels."""

from __future__ import annotations

from typing import NamedTuple

from attrs import field, frozen

from ..units import si
from ..validators import Described, optional, part, positive

__all__ = ["Grid", "Window"]


@frozen(kw_only=True)
class Window(Described):
    """The part of the interface that is looked at.

    Parameters
    ----------
    width : float, optional
        Its size along x [m]. None: that of a measured surface.
    height : float, optional
        Its size along y [m]. None: as along x.
    periodic : bool, optional
        Whether the surfaces repeat beyond the edges. If not, the bodies extend without load
        beyond the window: an isolated contact. None: they repeat, unless a measured surface
        states that it does not.
    """

    width: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    height: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    periodic: bool | None = field(default=None, validator=optional(part(bool)))


class Grid(NamedTuple):
    """Pixels of a window: counts (ny, nx), sizes (dy, dx) [m], periodic or not."""

    shape: tuple[int, int]
    pixel_size: tuple[float, float]
    periodic: bool

    @property
    def area(self) -> float:
        """Area of the window [m2]."""
        return self.shape[0] * self.pixel_size[0] * self.shape[1] * self.pixel_size[1]

    @property
    def pixel_area(self) -> float:
        """Area of a pixel [m2]."""
        return self.pixel_size[0] * self.pixel_size[1]
