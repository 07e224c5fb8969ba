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
  on   tension-limit       the liquid cannot be pulled below a given pressure (tension=1000000.0, ambient_pressure=101325.0, cavity='clipped')
  off  shear-limit         wall shear stress bounded by a limiting shear strength
  off  rupture             the film breaks at a gap
  off  van-der-waals-force van der Waals attraction of the solids
  off  adhesive-contact    adhesion of a sphere that has touched
  off  asperity-menisci    menisci at the summits of a rough face
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .accuracy import Accuracy
from .asperity_population import AsperityPopulation
from .bodies import Body, ContactInterface, Pressing, Window
from .contact_plan import ContactPlan
from .contact_scene import ContactScene
from .effects import (
    AdhesiveContact,
    AsperityMenisci,
    MeniscusForce,
    Rupture,
    ShearLimit,
    TensionLimit,
    VanDerWaalsForce,
    ViscousForce,
)
from .effects.elasticity import HalfSpace, LayeredHalfSpace
from .effects.film import FilmMeniscus
from .effects.friction import FrictionCoupling, FrictionTraction
from .effects.island_bridges import IslandBridges
from .effects.plasticity import HardnessLimit, HardnessMap
from .effects.registry import EFFECTS
from .effects.sliding import ContactAngleHysteresis, CouetteForce
from .effects.stress import SubsurfaceStress
from .errors import (
    ContactkitError,
    ConvergenceError,
    DescriptionError,
    InfeasibleError,
    NotSimulatedError,
    PlanError,
    ValidityWarning,
)
from .interface import Interface, Meniscus, Opening, Sliding, Vibration
from .liquids import Liquid
from .materials import Layer, Material, Stack
from .motion import advance
from .motion_state import FilmStatus, LimitKind, MotionState, Pull
from .plan import Plan
from .planner import plan
from .scene import SeparationScene, SlidingScene
from .surfaces import Flat, Sphere
from .topography import (
    CombinedSurface,
    GaussianRoughness,
    Heights,
    Measured,
    Paraboloid,
    SelfAffineRoughness,
    Wave,
)

if TYPE_CHECKING:
    from .adhesion_curves import adhesion_curve
    from .archive import load_result, save_result
    from .contact import solve
    from .divide import critical_meniscus, divide_meniscus
    from .humidity_curves import humidity_curve
    from .io import load_liquid, load_material, load_scene, save_scene
    from .press_map import press
    from .published_formulas import PUBLISHED, published
    from .separation import simulate
    from .sliding_plan import SlidingPlan, divide_sliding
    from .stop_curves import stop_curve
    from .studies import study

__version__ = "0.1.0"

__all__ = [
    "EFFECTS", "PUBLISHED", "Accuracy", "AdhesiveContact",
    "AsperityMenisci", "AsperityPopulation", "Body", "CombinedSurface", "ContactAngleHysteresis", "ContactInterface", "ContactPlan",
    "ContactScene", "ContactkitError", "ConvergenceError", "CouetteForce", "DescriptionError", "FilmMeniscus",
    "FilmStatus", "Flat", "FrictionCoupling", "FrictionTraction", "GaussianRoughness",
    "HalfSpace", "HardnessLimit", "HardnessMap", "Heights", "InfeasibleError", "Interface", "IslandBridges",
    "Layer", "LayeredHalfSpace", "LimitKind", "Liquid", "Material", "Measured", "Meniscus",
    "MeniscusForce", "MotionState", "NotSimulatedError", "Opening", "Paraboloid", "Plan",
    "PlanError", "Pressing", "Pull", "Rupture", "SelfAffineRoughness", "SeparationScene",
    "ShearLimit", "Sliding", "SlidingPlan", "SlidingScene", "Sphere", "Stack", "SubsurfaceStress", "TensionLimit", "ValidityWarning",
    "VanDerWaalsForce", "Vibration", "ViscousForce", "Wave", "Window", "adhesion_curve", "advance",
    "critical_meniscus", "divide_meniscus", "divide_sliding", "humidity_curve", "load_liquid", "load_material", "load_result",
    "load_scene", "plan", "press", "published", "save_result", "save_scene", "simulate", "solve",
    "stop_curve", "study",
]  # fmt: skip

# What needs numpy or cattrs is imported when it is first asked for.
_LATER = {
    "adhesion_curve": "adhesion_curves",
    "critical_meniscus": "divide",
    "divide_meniscus": "divide",
    "humidity_curve": "humidity_curves",
    "simulate": "separation",
    "SlidingPlan": "sliding_plan",
    "divide_sliding": "sliding_plan",
    "solve": "contact",
    "stop_curve": "stop_curves",
    "press": "press_map",
    "PUBLISHED": "published_formulas",
    "published": "published_formulas",
    "study": "studies",
    "load_liquid": "io",
    "load_material": "io",
    "load_result": "archive",
    "load_scene": "io",
    "save_result": "archive",
    "save_scene": "io",
}


def __getattr__(name: str) -> Any:
    if name in _LATER:
        from importlib import import_module

        return getattr(import_module(f".{_LATER[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
