"""Contact of rough layered surfaces, and the forces that resist separating wetted ones.

Scene -> Plan -> Result: describe what is there and which physics it calls for, `plan` it, and
`simulate` the plan.

Examples
--------
>>> import contactkit as ck
>>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
>>> face = ck.Flat(radius=3.175e-3)
>>> film = ck.Meniscus(liquid=oil, volume=1.583e-10)
>>> scene = ck.SeparationScene(
...     interface=ck.Interface(lower=face, upper=face, meniscus=film),
...     opening=ck.Opening(initial_gap=5e-6, final_gap=25e-6, speed=0.04),
...     effects=(ck.MeniscusForce(), ck.ViscousForce(), ck.TensionLimit(tension=1e6)),
... )
>>> print(ck.plan(scene))
separation: speed imposed, gap 5e-06 m to 2.5e-05 m
  on   meniscus-force      capillary force of the meniscus (profile='exact', pulled='lower')
  on   viscous-force       viscous force of the film (Reynolds) (closure='volume-conserving')
  on   tension-limit       the liquid cannot be pulled below a given pressure (tension=1000000.0, ambient_pressure=101325.0, cavity='truncated')
  off  shear-limit         wall shear stress bounded by a limiting shear strength
  off  rupture             the film breaks at a gap
  off  van-der-waals-force van der Waals attraction of the solids
  off  adhesive-contact    adhesion of a sphere that has touched
  off  asperity-menisci    menisci at the summits of a rough face
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._lazy import lazy_names

if TYPE_CHECKING:
    from .accuracy import Accuracy
    from .analyses.adhesion_curve import adhesion_curve
    from .analyses.division import critical_meniscus, divide_meniscus
    from .analyses.humidity_curve import humidity_curve
    from .analyses.load_displacement.solve import load_displacement
    from .as_published.lookup import PUBLISHED, published
    from .contact.effects.elasticity import HalfSpace, LayeredHalfSpace
    from .contact.effects.film import FilmMeniscus
    from .contact.effects.friction import FrictionCoupling, FrictionTraction
    from .contact.effects.island_bridges import IslandBridges
    from .contact.effects.plasticity import HardnessLimit, HardnessMap
    from .contact.effects.stress import SubsurfaceStress
    from .contact.plan import ContactPlan
    from .contact.press import press
    from .contact.solve import solve
    from .effects import EFFECTS
    from .errors import (
        ContactkitError,
        ConvergenceError,
        DescriptionError,
        InfeasibleError,
        NotSimulatedError,
        PlanError,
        ValidityWarning,
    )
    from .files.results import load_result, save_result
    from .files.scenes import load_liquid, load_material, load_scene, save_scene
    from .liquids.liquid import Liquid
    from .planning import plan
    from .scene.asperity_population import AsperityPopulation
    from .scene.bodies import Body, ContactInterface, Pressing, Window
    from .scene.contact_scene import ContactScene
    from .scene.interface import Interface, Meniscus, Opening, Sliding, Vibration
    from .scene.materials import Layer, Material, Stack
    from .scene.scenes import SeparationScene, SlidingScene
    from .scene.shapes import Flat, Sphere
    from .scene.topography import (
        CombinedSurface,
        GaussianRoughness,
        Heights,
        Measured,
        Paraboloid,
        SelfAffineRoughness,
        Wave,
    )
    from .separation.effects.registry import (
        AdhesiveContact,
        AsperityMenisci,
        MeniscusForce,
        Rupture,
        ShearLimit,
        TensionLimit,
        VanDerWaalsForce,
        ViscousForce,
    )
    from .separation.motion.advance import advance
    from .separation.motion.state import FilmStatus, LimitKind, MotionState, Pull
    from .separation.plan import Plan
    from .separation.simulate import simulate
    from .separation.sliding.effects import ContactAngleHysteresis, CouetteForce
    from .separation.sliding.plan import SlidingPlan, divide_sliding
    from .studies.study import study

__version__ = "0.1.0"

# Every name is imported when it is first asked for: `import contactkit` costs next to nothing.
_HOMES = {
    "Accuracy": "accuracy",
    "AdhesiveContact": "separation.effects.registry",
    "AsperityMenisci": "separation.effects.registry",
    "AsperityPopulation": "scene.asperity_population",
    "Body": "scene.bodies",
    "CombinedSurface": "scene.topography",
    "ContactAngleHysteresis": "separation.sliding.effects",
    "ContactInterface": "scene.bodies",
    "ContactPlan": "contact.plan",
    "ContactScene": "scene.contact_scene",
    "ContactkitError": "errors",
    "ConvergenceError": "errors",
    "CouetteForce": "separation.sliding.effects",
    "DescriptionError": "errors",
    "EFFECTS": "effects",
    "FilmMeniscus": "contact.effects.film",
    "FilmStatus": "separation.motion.state",
    "Flat": "scene.shapes",
    "FrictionCoupling": "contact.effects.friction",
    "FrictionTraction": "contact.effects.friction",
    "GaussianRoughness": "scene.topography",
    "HalfSpace": "contact.effects.elasticity",
    "HardnessLimit": "contact.effects.plasticity",
    "HardnessMap": "contact.effects.plasticity",
    "Heights": "scene.topography",
    "InfeasibleError": "errors",
    "Interface": "scene.interface",
    "IslandBridges": "contact.effects.island_bridges",
    "Layer": "scene.materials",
    "LayeredHalfSpace": "contact.effects.elasticity",
    "LimitKind": "separation.motion.state",
    "Liquid": "liquids.liquid",
    "Material": "scene.materials",
    "Measured": "scene.topography",
    "Meniscus": "scene.interface",
    "MeniscusForce": "separation.effects.registry",
    "MotionState": "separation.motion.state",
    "NotSimulatedError": "errors",
    "Opening": "scene.interface",
    "PUBLISHED": "as_published.lookup",
    "Paraboloid": "scene.topography",
    "Plan": "separation.plan",
    "PlanError": "errors",
    "Pressing": "scene.bodies",
    "Pull": "separation.motion.state",
    "Rupture": "separation.effects.registry",
    "SelfAffineRoughness": "scene.topography",
    "SeparationScene": "scene.scenes",
    "ShearLimit": "separation.effects.registry",
    "Sliding": "scene.interface",
    "SlidingPlan": "separation.sliding.plan",
    "SlidingScene": "scene.scenes",
    "Sphere": "scene.shapes",
    "Stack": "scene.materials",
    "SubsurfaceStress": "contact.effects.stress",
    "TensionLimit": "separation.effects.registry",
    "ValidityWarning": "errors",
    "VanDerWaalsForce": "separation.effects.registry",
    "Vibration": "scene.interface",
    "ViscousForce": "separation.effects.registry",
    "Wave": "scene.topography",
    "Window": "scene.bodies",
    "adhesion_curve": "analyses.adhesion_curve",
    "advance": "separation.motion.advance",
    "critical_meniscus": "analyses.division",
    "divide_meniscus": "analyses.division",
    "divide_sliding": "separation.sliding.plan",
    "humidity_curve": "analyses.humidity_curve",
    "load_liquid": "files.scenes",
    "load_material": "files.scenes",
    "load_result": "files.results",
    "load_scene": "files.scenes",
    "plan": "planning",
    "press": "contact.press",
    "published": "as_published.lookup",
    "save_result": "files.results",
    "save_scene": "files.scenes",
    "simulate": "separation.simulate",
    "solve": "contact.solve",
    "load_displacement": "analyses.load_displacement.solve",
    "study": "studies.study",
}

__all__ = [
    "Accuracy",
    "AdhesiveContact",
    "AsperityMenisci",
    "AsperityPopulation",
    "Body",
    "CombinedSurface",
    "ContactAngleHysteresis",
    "ContactInterface",
    "ContactPlan",
    "ContactScene",
    "ContactkitError",
    "ConvergenceError",
    "CouetteForce",
    "DescriptionError",
    "EFFECTS",
    "FilmMeniscus",
    "FilmStatus",
    "Flat",
    "FrictionCoupling",
    "FrictionTraction",
    "GaussianRoughness",
    "HalfSpace",
    "HardnessLimit",
    "HardnessMap",
    "Heights",
    "InfeasibleError",
    "Interface",
    "IslandBridges",
    "Layer",
    "LayeredHalfSpace",
    "LimitKind",
    "Liquid",
    "Material",
    "Measured",
    "Meniscus",
    "MeniscusForce",
    "MotionState",
    "NotSimulatedError",
    "Opening",
    "PUBLISHED",
    "Paraboloid",
    "Plan",
    "PlanError",
    "Pressing",
    "Pull",
    "Rupture",
    "SelfAffineRoughness",
    "SeparationScene",
    "ShearLimit",
    "Sliding",
    "SlidingPlan",
    "SlidingScene",
    "Sphere",
    "Stack",
    "SubsurfaceStress",
    "TensionLimit",
    "ValidityWarning",
    "VanDerWaalsForce",
    "Vibration",
    "ViscousForce",
    "Wave",
    "Window",
    "adhesion_curve",
    "advance",
    "critical_meniscus",
    "divide_meniscus",
    "divide_sliding",
    "humidity_curve",
    "load_displacement",
    "load_liquid",
    "load_material",
    "load_result",
    "load_scene",
    "plan",
    "press",
    "published",
    "save_result",
    "save_scene",
    "simulate",
    "solve",
    "study",
]

__getattr__ = lazy_names(__name__, _HOMES)


def __dir__() -> list[str]:
    return [*globals(), *_HOMES]
