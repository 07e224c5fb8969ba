"""Gap maps of a face: flat, tilted, domed, wavy, with recesses, or with a height map.

A gap is a plain array ``[y, x]`` in metres, so that own maps are added to it; the functions here
return such arrays on the cells of a face.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from attrs import field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import Described, finite, positive

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .face import Face, Outline

    Array = NDArray[np.floating[Any]]

__all__ = ["Deepening", "Waviness", "gap_map"]


class Deepening(Protocol):
    """A region that is deeper than the rest, such as a `contactkit.scene.faces.Recess`."""

    @property
    def shape(self) -> Outline:
        """Its outline."""

    @property
    def depth(self) -> float:
        """Depth below the face [m]."""


@frozen(kw_only=True)
class Waviness(Described):
    """A sinusoidal wave of a face.

    Parameters
    ----------
    amplitude : float
        Amplitude [m].
    wavelength : float
        Wavelength [m].
    angle : float
        Angle from x to the direction in which it varies [rad].
    phase : float
        Phase at the origin [rad]; 0: the gap is widest there.
    """

    amplitude: float = field(validator=positive, metadata=si("m"))
    wavelength: float = field(validator=positive, metadata=si("m"))
    angle: float = field(default=0.0, validator=finite, metadata=si("rad"))
    phase: float = field(default=0.0, validator=finite, metadata=si("rad"))


def gap_map(
    face: Face,
    gap: float,
    *,
    tilt: tuple[float, float] = (0.0, 0.0),
    dome_radius: float = math.inf,
    waves: Sequence[Waviness] = (),
    recesses: Sequence[Deepening] = (),
    heights: ArrayLike = 0.0,
) -> Array:
    r"""Gap between two faces [m].

    .. math:: h = h_0 + t_x x + t_y y + \frac{x^2 + y^2}{2 R} + \sum_i a_i \cos(k_i x' +
              \varphi_i) + \text{depth} - s

    Parameters
    ----------
    face : Face
        The face.
    gap : float
        Gap h_0 at the origin, without the rest [m].
    tilt : tuple of float
        Slopes along x and y [-].
    dome_radius : float
        Radius of curvature R of a dome [m]; negative for a hollow one.
    waves : sequence of Waviness
        Waves.
    recesses : sequence of Deepening
        Recesses; where they overlap, the deepest counts.
    heights : array_like, shape () or (ny, nx)
        Heights s of both faces towards each other [m], such as measured roughness.

    Raises
    ------
    DescriptionError
        If the gap is not positive somewhere (but for solid cells), or a map has the wrong shape.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=1e-3), 32)
    >>> tilted = gap_map(face, 1e-5, tilt=(1e-3, 0.0))
    >>> bool((tilted[:, -1] > tilted[:, 0]).all())
    True
    """
    from .discretisation import checked_gap

    given = np.asarray(heights, dtype=float)
    if given.shape not in ((), face.shape):
        expected = f"be one number or have the shape {face.shape} of the grid"
        raise DescriptionError("gap_map.heights", given.shape, expected, unit="m")
    if dome_radius == 0.0 or math.isnan(dome_radius):
        raise DescriptionError("gap_map.dome_radius", dome_radius, "not be zero", unit="m")
    x, y = face.x, face.y
    result = gap + tilt[0] * x + tilt[1] * y + (x * x + y * y) / (2.0 * dome_radius) - given
    for wave in waves:
        along = math.cos(wave.angle) * x + math.sin(wave.angle) * y
        turns = 2.0 * math.pi / wave.wavelength
        result = result + wave.amplitude * np.cos(turns * along + wave.phase)
    depth = np.zeros(face.shape)
    for recess in recesses:
        covered = np.broadcast_to(recess.shape.level(x, y) > 0.0, face.shape)
        if not (covered & face.inside).any():
            cure = "give smaller cells, or leave it out"
            raise DescriptionError("recess.shape", recess.shape, "cover a cell", hint=cure)
        depth = np.where(covered, np.maximum(depth, recess.depth), depth)
    return checked_gap(face, result + depth)
