"""Contact of rough layered surfaces, and the forces that resist separating wetted ones.

Scene -> Plan -> Result: describe bodies, liquid, loading and effects in a scene, `plan` it, and
`simulate` the plan (a separation or a sliding) or `solve` it (a contact).

Examples
--------
>>> import contactkit as ck
>>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
>>> face = ck.Flat(radius=3.175e-3)
>>> film = ck.Meniscus(liquid=oil, volume=1.583e-10)
>>> scene = ck.SeparationScene(
...     interface=ck.Interface(lower=face, upper=face, meniscus=film),
...     loading=ck.ImposedSpeed(speed=0.04, initial_gap=5e-6, final_gap=25e-6),
...     effects=(ck.MeniscusForce(), ck.ViscousForce(), ck.TensionLimit(strength=1e6)),
... )
>>> print(ck.plan(scene))
separation: speed imposed, gap 5e-06 m to 2.5e-05 m
  on   meniscus-force      capillary force of the meniscus (profile='exact')
  on   viscous-force       viscous force of the film (Reynolds) (closure='volume-conserving')
  on   tension-limit       the liquid cavitates at a tension and leaves a cavity (strength=1000000.0, ambient_pressure=101325.0, cavity='mass-conserving')
  off  shear-limit         wall shear stress bounded by a limiting shear strength
  off  rupture             the film breaks at a gap
  off  van-der-waals-force van der Waals attraction of the solids
  off  adhesive-contact    adhesion of a sphere that has touched
  off  asperity-menisci    menisci at the summits of a rough face
  off  liquid-weight       weight of the liquid in the bridge
  off  landau-levich-film  liquid that a receding line leaves behind (Landau-Levich)
  off  cox-voinov-angle    contact angle that depends on the speed of the line (Cox-Voinov)
  off  trouton-force       extensional stress of the column of liquid (Trouton)
  off  dynamic-rupture     rupture distance that grows with speed
  off  elastic-bodies      the bodies deform under the pressure of film, meniscus and contact
  off  solid-contact       asperities carry the bodies at a cut-off gap
  the liquid cavitates 10 bar below ambient, a cavity is 1.01325 bar below it
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._lazy import lazy_names
from ._version import __version__ as __version__

if TYPE_CHECKING:
    from .accuracy import Accuracy
    from .analyses.adhesion_curve import adhesion_curve
    from .analyses.deforming.modulus import modulus_curve
    from .analyses.deforming.pull_off_speed import pull_off_over_speed
    from .analyses.deforming.release import release_over
    from .analyses.deforming.stiction import stiction_table
    from .analyses.division import critical_meniscus, divide_meniscus
    from .analyses.humidity_curve import humidity_curve
    from .analyses.load_curve import load_curve
    from .analyses.load_displacement.solve import load_displacement
    from .analyses.pull_off import pull_off_curve
    from .analyses.stick_slip import SpringSlider, stick_slip
    from .as_published.lookup import PUBLISHED, published
    from .citing.cite import cite
    from .contact.arrays.press_maps import press_maps
    from .contact.discretisation import discretisation_error
    from .contact.effects.adhesion import Adhesion
    from .contact.effects.attraction_laws import (
        DugdaleAttraction,
        ExponentialAttraction,
        LennardJonesAttraction,
    )
    from .contact.effects.elasticity import HalfSpace, LayeredHalfSpace
    from .contact.effects.film import FilmMeniscus
    from .contact.effects.friction import FrictionCoupling, FrictionTraction
    from .contact.effects.hardness_rules import (
        ConstantHardness,
        ContinuousHardness,
        HardnessMap,
        LiteralHardness,
        MaterialHardness,
    )
    from .contact.effects.island_bridges import IslandBridges
    from .contact.effects.partial_slip import PartialSlip
    from .contact.effects.plastic_history import PlasticHistory
    from .contact.effects.plasticity import HardnessLimit
    from .contact.effects.stress import SubsurfaceStress
    from .contact.effects.viscoelasticity import Viscoelasticity
    from .contact.functionals import Functional, Slopes
    from .contact.plan import ContactPlan
    from .contact.press import press
    from .contact.result import ContactResult
    from .contact.solve import solve
    from .errors import (
        ContactkitError,
        ConvergenceError,
        DescriptionError,
        InfeasibleError,
        InstalledKindWarning,
        NotSimulatedError,
        PlanError,
        ValidityWarning,
    )
    from .files.curves import SavedCurve, read_curve
    from .files.results import load_result, save_result
    from .files.scenes import load_liquid, load_material, load_scene, save_scene
    from .files.surfaces import read_surfaces, surface_from, to_topography, write_surfaces
    from .fitting.compare import compare_fits
    from .fitting.data import MeasuredBound, MeasuredCurve
    from .fitting.fit import fit
    from .fitting.fit_file import read_fit
    from .fitting.force_curves import read_force_curve, write_force_curve
    from .fitting.parameters import Prior
    from .fitting.readers import read_measured_curve
    from .fitting.result import Fit
    from .kinds import EFFECTS, KINDS, register
    from .liquids.liquid import Liquid
    from .planning import plan
    from .scene.asperity_population import AsperityPopulation
    from .scene.faces import Recess, SealedHole, Vent
    from .scene.gradient import Gradient
    from .scene.interface import Body, Interface
    from .scene.loading import (
        Approach,
        ImposedForce,
        ImposedSpeed,
        ImposedTime,
        PressAndPull,
        Pressing,
        Sliding,
        TangentialStep,
        Vibration,
    )
    from .scene.materials import Layer, Material, RigidBase, Stack
    from .scene.meniscus import Meniscus
    from .scene.planforms import (
        Difference,
        Disc,
        Ellipse,
        Image,
        ImageFile,
        Intersection,
        Planform,
        Polygon,
        Rectangle,
        Ring,
        Sector,
        Union,
        equilateral_triangle,
    )
    from .scene.rough_surfaces import (
        CombinedSurface,
        GaussianRoughness,
        Heights,
        Measured,
        SelfAffineRoughness,
    )
    from .scene.scenes import ContactScene, SeparationScene, SlidingScene
    from .scene.solids.transverse import TransverselyIsotropicMaterial
    from .scene.solids.viscoelastic import ViscoelasticMaterial
    from .scene.surfaces import FineRoughness, Flat, Paraboloid, Sphere, Wave
    from .scene.window import Window
    from .separation.deforming.effects import ElasticBodies, SolidContact
    from .separation.deforming.plan import DeformingPlan
    from .separation.deforming.result import DeformingResult
    from .separation.effects.adhesion import AdhesiveContact, VanDerWaalsForce
    from .separation.effects.asperities import AsperityMenisci
    from .separation.effects.base import FilmStatus, LimitKind
    from .separation.effects.meniscus import AsPublished, MeniscusForce
    from .separation.effects.rupture import Rupture
    from .separation.effects.viscous import ShearLimit, TensionLimit, ViscousForce
    from .separation.motion.advance import advance
    from .separation.motion.state import MotionState, Pull
    from .separation.plan import Plan
    from .separation.results import SeparationResult
    from .separation.simulate import simulate
    from .separation.sliding.effects import ContactAngleHysteresis, CouetteForce
    from .separation.sliding.plan import SlidingPlan, divide_sliding
    from .separation.sliding.result import SlidingResult
    from .separation.wetting.cox_voinov import CoxVoinovAngle
    from .separation.wetting.landau_levich import LandauLevichFilm
    from .separation.wetting.rupture import DynamicRupture
    from .separation.wetting.trouton import TroutonForce
    from .separation.wetting.weight import LiquidWeight
    from .shortcuts.contact_area import contact_area
    from .shortcuts.menisci import bridge_force, capillary_force
    from .shortcuts.squeeze import squeeze_time
    from .studies.estimate import plan_study
    from .studies.sensitivity import Range, sensitivity
    from .studies.sobol import sobol_indices
    from .studies.stream import stream_study
    from .studies.study import study
    from .studies.study_file import StudyFile


# Every name is imported at its first use, so that `import contactkit` is fast.
_HOMES = {
    "Accuracy": "accuracy",
    "Adhesion": "contact.effects.adhesion",
    "AdhesiveContact": "separation.effects.adhesion",
    "Approach": "scene.loading",
    "AsPublished": "separation.effects.meniscus",
    "AsperityMenisci": "separation.effects.asperities",
    "AsperityPopulation": "scene.asperity_population",
    "Body": "scene.interface",
    "CombinedSurface": "scene.rough_surfaces",
    "ContactAngleHysteresis": "separation.sliding.effects",
    "ContactPlan": "contact.plan",
    "ContactResult": "contact.result",
    "ContactScene": "scene.scenes",
    "ContactkitError": "errors",
    "ConvergenceError": "errors",
    "CouetteForce": "separation.sliding.effects",
    "DescriptionError": "errors",
    "Difference": "scene.planforms",
    "Disc": "scene.planforms",
    "DugdaleAttraction": "contact.effects.attraction_laws",
    "DynamicRupture": "separation.wetting.rupture",
    "EFFECTS": "kinds",
    "Ellipse": "scene.planforms",
    "ExponentialAttraction": "contact.effects.attraction_laws",
    "FilmMeniscus": "contact.effects.film",
    "FilmStatus": "separation.effects.base",
    "FineRoughness": "scene.surfaces",
    "Fit": "fitting.result",
    "Flat": "scene.surfaces",
    "FrictionCoupling": "contact.effects.friction",
    "FrictionTraction": "contact.effects.friction",
    "Functional": "contact.functionals",
    "GaussianRoughness": "scene.rough_surfaces",
    "Gradient": "scene.gradient",
    "HalfSpace": "contact.effects.elasticity",
    "HardnessLimit": "contact.effects.plasticity",
    "ConstantHardness": "contact.effects.hardness_rules",
    "ContinuousHardness": "contact.effects.hardness_rules",
    "LiquidWeight": "separation.wetting.weight",
    "LiteralHardness": "contact.effects.hardness_rules",
    "MaterialHardness": "contact.effects.hardness_rules",
    "HardnessMap": "contact.effects.hardness_rules",
    "Heights": "scene.rough_surfaces",
    "Image": "scene.planforms",
    "ImageFile": "scene.planforms",
    "ImposedForce": "scene.loading",
    "ImposedSpeed": "scene.loading",
    "ImposedTime": "scene.loading",
    "PressAndPull": "scene.loading",
    "InfeasibleError": "errors",
    "InstalledKindWarning": "errors",
    "Interface": "scene.interface",
    "Intersection": "scene.planforms",
    "IslandBridges": "contact.effects.island_bridges",
    "KINDS": "kinds",
    "LandauLevichFilm": "separation.wetting.landau_levich",
    "Layer": "scene.materials",
    "LayeredHalfSpace": "contact.effects.elasticity",
    "LennardJonesAttraction": "contact.effects.attraction_laws",
    "LimitKind": "separation.effects.base",
    "Liquid": "liquids.liquid",
    "Material": "scene.materials",
    "Measured": "scene.rough_surfaces",
    "MeasuredBound": "fitting.data",
    "MeasuredCurve": "fitting.data",
    "Meniscus": "scene.meniscus",
    "MeniscusForce": "separation.effects.meniscus",
    "MotionState": "separation.motion.state",
    "NotSimulatedError": "errors",
    "PUBLISHED": "as_published.lookup",
    "Paraboloid": "scene.surfaces",
    "PartialSlip": "contact.effects.partial_slip",
    "Plan": "separation.plan",
    "PlanError": "errors",
    "Planform": "scene.planforms",
    "PlasticHistory": "contact.effects.plastic_history",
    "Polygon": "scene.planforms",
    "Pressing": "scene.loading",
    "Prior": "fitting.parameters",
    "Pull": "separation.motion.state",
    "Range": "studies.sensitivity",
    "Recess": "scene.faces",
    "Rectangle": "scene.planforms",
    "RigidBase": "scene.materials",
    "Ring": "scene.planforms",
    "Rupture": "separation.effects.rupture",
    "SavedCurve": "files.curves",
    "SealedHole": "scene.faces",
    "Sector": "scene.planforms",
    "SelfAffineRoughness": "scene.rough_surfaces",
    "SeparationResult": "separation.results",
    "CoxVoinovAngle": "separation.wetting.cox_voinov",
    "DeformingPlan": "separation.deforming.plan",
    "DeformingResult": "separation.deforming.result",
    "ElasticBodies": "separation.deforming.effects",
    "SolidContact": "separation.deforming.effects",
    "SeparationScene": "scene.scenes",
    "ShearLimit": "separation.effects.viscous",
    "Sliding": "scene.loading",
    "SlidingPlan": "separation.sliding.plan",
    "SlidingResult": "separation.sliding.result",
    "SlidingScene": "scene.scenes",
    "Slopes": "contact.functionals",
    "Sphere": "scene.surfaces",
    "SpringSlider": "analyses.stick_slip",
    "Stack": "scene.materials",
    "StudyFile": "studies.study_file",
    "SubsurfaceStress": "contact.effects.stress",
    "TangentialStep": "scene.loading",
    "TensionLimit": "separation.effects.viscous",
    "TransverselyIsotropicMaterial": "scene.solids.transverse",
    "TroutonForce": "separation.wetting.trouton",
    "Union": "scene.planforms",
    "ValidityWarning": "errors",
    "VanDerWaalsForce": "separation.effects.adhesion",
    "Vent": "scene.faces",
    "Vibration": "scene.loading",
    "ViscoelasticMaterial": "scene.solids.viscoelastic",
    "Viscoelasticity": "contact.effects.viscoelasticity",
    "ViscousForce": "separation.effects.viscous",
    "Wave": "scene.surfaces",
    "Window": "scene.window",
    "adhesion_curve": "analyses.adhesion_curve",
    "advance": "separation.motion.advance",
    "bridge_force": "shortcuts.menisci",
    "capillary_force": "shortcuts.menisci",
    "cite": "citing.cite",
    "compare_fits": "fitting.compare",
    "contact_area": "shortcuts.contact_area",
    "critical_meniscus": "analyses.division",
    "discretisation_error": "contact.discretisation",
    "divide_meniscus": "analyses.division",
    "divide_sliding": "separation.sliding.plan",
    "equilateral_triangle": "scene.planforms",
    "fit": "fitting.fit",
    "humidity_curve": "analyses.humidity_curve",
    "load_curve": "analyses.load_curve",
    "load_displacement": "analyses.load_displacement.solve",
    "load_liquid": "files.scenes",
    "load_material": "files.scenes",
    "load_result": "files.results",
    "load_scene": "files.scenes",
    "plan": "planning",
    "plan_study": "studies.estimate",
    "press": "contact.press",
    "press_maps": "contact.arrays.press_maps",
    "published": "as_published.lookup",
    "pull_off_curve": "analyses.pull_off",
    "modulus_curve": "analyses.deforming.modulus",
    "pull_off_over_speed": "analyses.deforming.pull_off_speed",
    "read_surfaces": "files.surfaces",
    "release_over": "analyses.deforming.release",
    "stiction_table": "analyses.deforming.stiction",
    "read_curve": "files.curves",
    "read_fit": "fitting.fit_file",
    "read_force_curve": "fitting.force_curves",
    "read_measured_curve": "fitting.readers",
    "register": "kinds",
    "save_result": "files.results",
    "save_scene": "files.scenes",
    "sensitivity": "studies.sensitivity",
    "simulate": "separation.simulate",
    "sobol_indices": "studies.sobol",
    "solve": "contact.solve",
    "squeeze_time": "shortcuts.squeeze",
    "stick_slip": "analyses.stick_slip",
    "stream_study": "studies.stream",
    "study": "studies.study",
    "surface_from": "files.surfaces",
    "to_topography": "files.surfaces",
    "write_force_curve": "fitting.force_curves",
    "write_surfaces": "files.surfaces",
}

__all__ = [
    "Accuracy",
    "Adhesion",
    "AdhesiveContact",
    "Approach",
    "AsPublished",
    "AsperityMenisci",
    "AsperityPopulation",
    "Body",
    "CombinedSurface",
    "ConstantHardness",
    "ContactAngleHysteresis",
    "ContactPlan",
    "ContactResult",
    "ContactScene",
    "ContactkitError",
    "ContinuousHardness",
    "ConvergenceError",
    "CouetteForce",
    "CoxVoinovAngle",
    "DeformingPlan",
    "DeformingResult",
    "DescriptionError",
    "Difference",
    "Disc",
    "DugdaleAttraction",
    "DynamicRupture",
    "EFFECTS",
    "ElasticBodies",
    "Ellipse",
    "ExponentialAttraction",
    "FilmMeniscus",
    "FilmStatus",
    "FineRoughness",
    "Fit",
    "Flat",
    "FrictionCoupling",
    "FrictionTraction",
    "Functional",
    "GaussianRoughness",
    "Gradient",
    "HalfSpace",
    "HardnessLimit",
    "HardnessMap",
    "Heights",
    "Image",
    "ImageFile",
    "ImposedForce",
    "ImposedSpeed",
    "ImposedTime",
    "InfeasibleError",
    "InstalledKindWarning",
    "Interface",
    "Intersection",
    "IslandBridges",
    "KINDS",
    "LandauLevichFilm",
    "Layer",
    "LayeredHalfSpace",
    "LennardJonesAttraction",
    "LimitKind",
    "Liquid",
    "LiquidWeight",
    "LiteralHardness",
    "Material",
    "MaterialHardness",
    "Measured",
    "MeasuredBound",
    "MeasuredCurve",
    "Meniscus",
    "MeniscusForce",
    "MotionState",
    "NotSimulatedError",
    "PUBLISHED",
    "Paraboloid",
    "PartialSlip",
    "Plan",
    "PlanError",
    "Planform",
    "PlasticHistory",
    "Polygon",
    "PressAndPull",
    "Pressing",
    "Prior",
    "Pull",
    "Range",
    "Recess",
    "Rectangle",
    "RigidBase",
    "Ring",
    "Rupture",
    "SavedCurve",
    "SealedHole",
    "Sector",
    "SelfAffineRoughness",
    "SeparationResult",
    "SeparationScene",
    "ShearLimit",
    "Sliding",
    "SlidingPlan",
    "SlidingResult",
    "SlidingScene",
    "Slopes",
    "SolidContact",
    "Sphere",
    "SpringSlider",
    "Stack",
    "StudyFile",
    "SubsurfaceStress",
    "TangentialStep",
    "TensionLimit",
    "TransverselyIsotropicMaterial",
    "TroutonForce",
    "Union",
    "ValidityWarning",
    "VanDerWaalsForce",
    "Vent",
    "Vibration",
    "ViscoelasticMaterial",
    "Viscoelasticity",
    "ViscousForce",
    "Wave",
    "Window",
    "adhesion_curve",
    "advance",
    "bridge_force",
    "capillary_force",
    "cite",
    "compare_fits",
    "contact_area",
    "critical_meniscus",
    "discretisation_error",
    "divide_meniscus",
    "divide_sliding",
    "equilateral_triangle",
    "fit",
    "humidity_curve",
    "load_curve",
    "load_displacement",
    "load_liquid",
    "load_material",
    "load_result",
    "load_scene",
    "modulus_curve",
    "plan",
    "plan_study",
    "press",
    "press_maps",
    "published",
    "pull_off_curve",
    "pull_off_over_speed",
    "read_curve",
    "read_fit",
    "read_force_curve",
    "read_measured_curve",
    "read_surfaces",
    "register",
    "release_over",
    "save_result",
    "save_scene",
    "sensitivity",
    "simulate",
    "sobol_indices",
    "solve",
    "squeeze_time",
    "stick_slip",
    "stiction_table",
    "stream_study",
    "study",
    "surface_from",
    "to_topography",
    "write_force_curve",
    "write_surfaces",
]

__getattr__ = lazy_names(__name__, _HOMES)


def __dir__() -> list[str]:
    return [*globals(), *_HOMES]
