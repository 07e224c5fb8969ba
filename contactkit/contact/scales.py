"""Reference scales of a contact: those of a rough surface, or of a round body."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..scene.scales import Scale, Scales, scales_of
from .grid import holes_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.scenes import ContactScene

__all__ = ["contact_scales"]


def contact_scales(scene: ContactScene, heights: NDArray[np.float64], area: float) -> Scales:
    """Scales of a contact, by unit.

    Parameters
    ----------
    scene : ContactScene
        The bodies.
    heights : ndarray (ny, nx)
        Heights of both bodies together [m].
    area : float
        Area of the window [m2].

    Notes
    -----
    Pressures are divided by the reduced modulus E* of the substrates (of the lowest layers on a
    rigid base), the instantaneous one of materials that relax, so that structures on one substrate
    share it. Where a body is a sphere or a
    paraboloid, rough or not, lengths are divided by its relative radius R, areas by R^2, forces
    by E* R^2, energies by E* R^3; elsewhere by the rms height and the area A of the window, E* A
    and E* A rms.
    """
    modulus = 1.0 / sum(
        1.0 / stack.materials[-1].at_rate(math.inf).plane_strain_modulus
        for stack in scene.interface.stacks
    )
    curvature = sum(body.surface.body_curvature for body in scene.interface.bodies)
    if curvature > 0.0:
        length, area = Scale(1.0 / curvature, "R", "relative radius of the bodies"), curvature**-2.0
        square, text = "R^2", "square of the relative radius"
    else:
        holes = holes_of(scene)
        rms = float((heights if holes is None else heights[~holes]).std())
        length, square, text = Scale(rms, "rms", "rms height"), "A", "area of the window"
    force = modulus * area
    return scales_of(
        {
            "Pa": Scale(modulus, "E*", "reduced modulus of the substrates"),
            "m": length,
            "m2": Scale(area, square, text),
            "N": Scale(force, f"E* {square}", f"reduced modulus times {text}"),
            "J": Scale(
                force * length.value,
                f"E* {square} {length.name}",
                f"reduced modulus times {text} times {length.definition}",
            ),
        }
    )
