"""The window of a contact, and its grid of pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from attrs import Attribute, field, frozen

from ..units import si
from ..validators import Described, optional, positive, refuse

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Axis", "Edges", "Grid", "Window"]

Axis = Literal["x", "y"]
Edges = bool | Axis
"""Whether surfaces repeat beyond the edges: along both axes, along one of them, or not."""


def _edges(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if not (value is None or isinstance(value, bool) or value in ("x", "y")):
        raise refuse(owner, attribute, value, 'be True, False, "x" or "y"')


@frozen(kw_only=True)
class Window(Described):
    """The part of the interface that is looked at.

    Parameters
    ----------
    width : float, optional
        Its size along x [m]. None: that of a measured surface.
    height : float, optional
        Its size along y [m]. None: as along x.
    periodic : bool, "x" or "y", optional
        Whether the surfaces repeat beyond the edges. If not, the bodies extend without load
        beyond the window: an isolated contact. "x" or "y": they repeat along that axis alone, as
        of a line contact. None: they repeat, unless a measured surface states that it does not.
    """

    width: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    height: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    periodic: bool | Literal["x", "y"] | None = field(default=None, validator=_edges)


class Grid(NamedTuple):
    """Pixels of a window: counts (ny, nx), sizes (dy, dx) [m], periodic or not.

    `periodic` is along both axes; `along` is the axis of a window that repeats along one alone.
    """

    shape: tuple[int, int]
    pixel_size: tuple[float, float]
    periodic: bool
    along: Axis | None = None

    @property
    def edges(self) -> Edges:
        """Whether it repeats: along both axes, along one of them, or not."""
        return self.along or self.periodic

    @property
    def repeats(self) -> tuple[bool, bool]:
        """Whether it repeats along y, and along x."""
        return self.edges in (True, "y"), self.edges in (True, "x")

    def from_centre(self) -> tuple[Map, Map]:
        """Distances y (ny, 1) and x (1, nx) [m] of the pixels from that in the middle."""
        import numpy as np

        y, x = (
            np.asarray((np.arange(n) - n // 2) * d, dtype=np.float64)
            for n, d in zip(self.shape, self.pixel_size, strict=True)
        )
        return y[:, None], x[None, :]

    @property
    def area(self) -> float:
        """Area of the window [m2]."""
        return self.shape[0] * self.pixel_size[0] * self.shape[1] * self.pixel_size[1]

    @property
    def pixel_area(self) -> float:
        """Area of a pixel [m2]."""
        return self.pixel_size[0] * self.pixel_size[1]
