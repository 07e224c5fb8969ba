"""Rigid sphere on a half-space with one layer: one solve, in units of Hertz on the substrate."""

from __future__ import annotations

import contactkit as ck
from contactkit.reference import hertz

MODULUS, POISSON = 100e9, 0.3  # of the substrate
RADIUS, LOAD = 1e-3, 1.0  # sphere [m], load [N]
PLANE_STRAIN = MODULUS / (1.0 - POISSON**2)
HERTZ = hertz.sphere(LOAD, RADIUS, PLANE_STRAIN)
P0, A0 = HERTZ.peak_pressure, HERTZ.contact_radius  # what pressures and lengths are given in


def pressed(
    ratio: float, pixels: int, width: float, *effects: ck.scene.effect.Effect
) -> ck.ContactResult:
    """Solve the sphere on a layer of thickness a0 whose modulus is `ratio` that of the substrate.

    `width` of the window is in contact radii a0.
    """
    layer = ck.Material(young_modulus=ratio * MODULUS, poisson_ratio=POISSON)
    base = ck.Material(young_modulus=MODULUS, poisson_ratio=POISSON)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(
                solid=ck.Stack(layers=(ck.Layer(material=layer, thickness=A0),), substrate=base)
            ),
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS)),
        ),
        window=ck.Window(width=width * A0, periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=pixels)))
