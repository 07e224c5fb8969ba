r"""Landing of a spring tip on its site: force, dissipated work and rebound.

`contactkit.models.micromirror.tip` lets a tip land without a bounce of its apex, on a site that
is rigid. Here the site deforms by its `LoadDisplacementCurve`; the energy of one impact decides,

.. math:: \tfrac12 m v^2 + w = W(d_m), \qquad e^2 = 1 - D / \tfrac12 m v^2

with w the work of the attraction, on loading and unloading, and D the dissipated work. The apex
stays if the plastic work takes the whole kinetic energy. Left out: energy carried away by waves in
the tip, and vapour that condenses while it touches. Approaches below a nanometre are those of a
few atoms, where hardness and elasticity of the bulk do not hold.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ...accuracy import Accuracy
from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...analyses.load_displacement.impact import impact
from ...analyses.load_displacement.solve import load_displacement
from ...contact.effects.elasticity import HalfSpace
from ...contact.effects.plasticity import HardnessLimit
from ...errors import DescriptionError, InfeasibleError, PlanError
from ...scene.interface import Body, Interface
from ...scene.loading import Approach
from ...scene.materials import Material
from ...scene.scenes import ContactScene, SeparationScene
from ...scene.surfaces import Paraboloid
from ...scene.window import Window

__all__ = ["TipLanding", "land", "tip_faces"]

_ALUMINIUM = Material(  # a sputtered film; the hardness is an assumption
    name="aluminium film", young_modulus=70e9, poisson_ratio=0.33, hardness=1.2e9
)


class TipLanding(NamedTuple):
    """One landing of an apex."""

    approach: float
    """Largest approach of apex and site [m]."""
    force: float
    """Largest force between them [N]."""
    dissipated_work: float
    """Work that plasticity takes [J]."""
    restitution: float
    """Speed at which the apex leaves over that at which it came [-]; 0: it stays."""


def tip_faces(
    tip: SeparationScene,
    most: float,
    *,
    material: Material = _ALUMINIUM,
    accuracy: Accuracy | None = None,
) -> LoadDisplacementCurve:
    """Curve of the apex of a tip on its site, up to an approach [m]; both of one material.

    Raises
    ------
    PlanError
        If the tip has no round apex.
    InfeasibleError
        If it is too blunt, or the approach too deep, for a paraboloid: beyond R/5.
    """
    curvature = tip.interface.upper.surface.curvature
    if not curvature:
        raise PlanError("a landing needs the radius of the apex: interface.upper as a sphere")
    radius = 1.0 / curvature
    if not 0.0 < most <= 0.2 * radius:
        raise InfeasibleError(
            f"an approach of {most:g} m is beyond a fifth of the radius {radius:g} m, where "
            "small slopes end; ask for less"
        )
    scene = ContactScene(
        interface=Interface(
            lower=Body(solid=material),
            upper=Body(surface=Paraboloid(radius=radius), solid=material),
        ),
        window=Window(width=3.2 * math.sqrt(2.0 * radius * most), periodic=False),
        loading=Approach(approach=most),
        effects=(HalfSpace(), HardnessLimit(rule="material")),
    )
    return load_displacement(scene, points=24, decades=3.0, accuracy=accuracy or Accuracy(grid=128))


def land(
    faces: LoadDisplacementCurve, mass: float, speed: float, attraction: float = 0.0
) -> TipLanding:
    """One landing of a tip, by its energy.

    Parameters
    ----------
    faces : LoadDisplacementCurve
        Apex on site, as `tip_faces` makes it.
    mass, speed : float
        Of the tip as it lands [kg], [m/s].
    attraction : float
        Work to pull the apex off its site without a film [J], as `mirror_film.adhesion` gives it.

    Raises
    ------
    InfeasibleError
        If the curve ends before the tip is at rest.
    DescriptionError
        If a number is impossible.

    Examples
    --------
    >>> faces = LoadDisplacementCurve(
    ...     approach=(1e-9, 2e-9), force=(1e-7, 3e-7), contact_area=(1e-17, 2e-17),
    ...     plastic_area=(0.0, 0.0), elastic_limit=2e-9, nominal_area=1e-13)
    >>> land(faces, 4e-16, 0.2).restitution
    1.0
    """
    if not (math.isfinite(attraction) and attraction >= 0.0):
        expected = "be zero or positive, and finite"
        raise DescriptionError("land(attraction)", attraction, expected, unit="J")
    kinetic = 0.5 * mass * speed * speed
    # The attraction brings its work with it: the impact is that of a faster tip.
    found = impact(faces, mass, math.sqrt(speed * speed + 2.0 * attraction / mass))
    left = max(kinetic - found.dissipated_work, 0.0)
    return TipLanding(found.approach, found.force, found.dissipated_work, math.sqrt(left / kinetic))
