"""Scenes of the tests of live pages."""

from __future__ import annotations

import contactkit as ck

OIL = ck.load_liquid("engine-oil-15w-40")
WATER = ck.load_liquid("water")


def film(volume=0.16e-9, temperature=293.15, radius=3.175e-3, angle=0.0, cavity=True, **loading):
    """The film of README.md, whose values can be changed."""
    face = ck.Flat(radius=radius)
    given = {"initial_gap": 5e-6, "final_gap": 25e-6, "force": 40.0, "mass": 0.02} | loading
    limit = (ck.TensionLimit(strength=1e6),) if cavity else ()
    meniscus = ck.Meniscus(
        liquid=OIL, volume=volume, contact_angle_lower=angle, contact_angle_upper=angle
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=meniscus),
        temperature=temperature,
        loading=ck.ImposedForce(**given),
        effects=(ck.MeniscusForce(), ck.ViscousForce(), *limit),
        name="film of a page",
    )
