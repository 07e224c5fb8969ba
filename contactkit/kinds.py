"""Every kind that a scene may be made of, by its name in files: effects, surfaces, laws, loadings.

One line for each class. A class is imported when a scene names it or a list shows it, so that a
scene brings along what it calls for and no more.
"""

from __future__ import annotations

from typing import Any, TypeVar

from .registry import Registries, Registry

__all__ = [
    "ATTRACTION_LAWS",
    "CONTACT_EFFECTS",
    "CONTACT_LOADINGS",
    "EFFECTS",
    "FACE_HOLES",
    "HARDNESS_RULES",
    "KINDS",
    "LOADINGS",
    "MENISCUS_PROFILES",
    "PLANFORMS",
    "RHEOLOGY_LAWS",
    "SEPARATION_EFFECTS",
    "SEPARATION_LOADINGS",
    "SLIDING_EFFECTS",
    "SLIDING_LOADINGS",
    "SLIDING_SCENE_EFFECTS",
    "SOLIDS",
    "SURFACES",
    "TEMPERATURE_LAWS",
    "register",
]

K = TypeVar("K", bound=type)


def _effects(
    family: str, homes: dict[str, str], group: str = "contactkit.effects"
) -> Registry[Any]:
    return Registry(
        family,
        homes,
        tag="effect",
        what="effect",
        group=group,
        role="a role such as SeparationForce or Observer",
        attribute="name",
    )


def _loadings(family: str, homes: dict[str, str]) -> Registry[Any]:
    return Registry(
        family,
        homes,
        tag="kind",
        what="loading",
        group="contactkit.loadings",
        role="a loading such as ContactLoading",
    )


SEPARATION_EFFECTS: Registry[Any] = _effects(
    "separation effect",
    {
        "meniscus-force": "separation.effects.meniscus:MeniscusForce",
        "viscous-force": "separation.effects.viscous:ViscousForce",
        "tension-limit": "separation.effects.viscous:TensionLimit",
        "shear-limit": "separation.effects.viscous:ShearLimit",
        "rupture": "separation.effects.rupture:Rupture",
        "van-der-waals-force": "separation.effects.adhesion:VanDerWaalsForce",
        "adhesive-contact": "separation.effects.adhesion:AdhesiveContact",
        "asperity-menisci": "separation.effects.asperities:AsperityMenisci",
        "liquid-weight": "separation.wetting.weight:LiquidWeight",
        "landau-levich-film": "separation.wetting.landau_levich:LandauLevichFilm",
        "cox-voinov-angle": "separation.wetting.cox_voinov:CoxVoinovAngle",
        "trouton-force": "separation.wetting.trouton:TroutonForce",
        "dynamic-rupture": "separation.wetting.rupture:DynamicRupture",
        "elastic-bodies": "separation.deforming.effects:ElasticBodies",
        "solid-contact": "separation.deforming.effects:SolidContact",
    },
)
SLIDING_EFFECTS: Registry[Any] = _effects(
    "sliding effect",
    {
        "couette-force": "separation.sliding.effects:CouetteForce",
        "contact-angle-hysteresis": "separation.sliding.effects:ContactAngleHysteresis",
    },
)
SLIDING_SCENE_EFFECTS: Registries[Any] = Registries(
    SLIDING_EFFECTS,
    _effects("separation effect", {"shear-limit": SEPARATION_EFFECTS.homes["shear-limit"]}, ""),
)
"""Effects that a sliding scene may list: one of a separation acts there too."""
CONTACT_EFFECTS: Registry[Any] = _effects(
    "contact effect",
    {
        "half-space": "contact.effects.elasticity:HalfSpace",
        "layered-half-space": "contact.effects.elasticity:LayeredHalfSpace",
        "hardness-limit": "contact.effects.plasticity:HardnessLimit",
        "adhesion": "contact.effects.adhesion:Adhesion",
        "plastic-history": "contact.effects.plastic_history:PlasticHistory",
        "viscoelasticity": "contact.effects.viscoelasticity:Viscoelasticity",
        "friction-traction": "contact.effects.friction:FrictionTraction",
        "friction-coupling": "contact.effects.friction:FrictionCoupling",
        "partial-slip": "contact.effects.partial_slip:PartialSlip",
        "subsurface-stress": "contact.effects.stress:SubsurfaceStress",
        "film-meniscus": "contact.effects.film:FilmMeniscus",
        "island-bridges": "contact.effects.island_bridges:IslandBridges",
    },
)
EFFECTS: Registries[Any] = Registries(SEPARATION_EFFECTS, SLIDING_EFFECTS, CONTACT_EFFECTS)
"""All effects."""

SURFACES: Registry[Any] = Registry(
    "surface",
    {
        "flat": "scene.surfaces:Flat",
        "sphere": "scene.surfaces:Sphere",
        "paraboloid": "scene.surfaces:Paraboloid",
        "wave": "scene.surfaces:Wave",
        "gaussian-roughness": "scene.rough_surfaces:GaussianRoughness",
        "self-affine-roughness": "scene.rough_surfaces:SelfAffineRoughness",
        "measured": "scene.rough_surfaces:Measured",
        "heights": "scene.rough_surfaces:Heights",
        "combined": "scene.rough_surfaces:CombinedSurface",
    },
    tag="shape",
    group="contactkit.surfaces",
    role="Surface",
)
SOLIDS: Registry[Any] = Registry(
    "solid",
    {
        "material": "scene.materials:Material",
        "viscoelastic": "scene.solids.viscoelastic:ViscoelasticMaterial",
        "transversely-isotropic": "scene.solids.transverse:TransverselyIsotropicMaterial",
        "stack": "scene.materials:Stack",
    },
    tag="kind",
    group="contactkit.solids",
    role="Solid",
    naming=("material", "stack"),
)
"""What bodies are made of. A `Layer` is a part of a stack, and a `RigidBase` one of the three
conditions below layers that the elasticity of layered half-spaces knows (an endless substrate,
bonded, frictionless): neither is a kind, as another one would need an influence function first."""
SEPARATION_LOADINGS: Registry[Any] = _loadings(
    "separation loading",
    {
        "imposed-speed": "scene.loading:ImposedSpeed",
        "imposed-force": "scene.loading:ImposedForce",
        "imposed-time": "scene.loading:ImposedTime",
        "press-and-pull": "scene.loading:PressAndPull",
    },
)
CONTACT_LOADINGS: Registry[Any] = _loadings(
    "contact loading",
    {"pressing": "scene.loading:Pressing", "approach": "scene.loading:Approach"},
)
SLIDING_LOADINGS: Registry[Any] = _loadings("sliding loading", {"sliding": "scene.loading:Sliding"})
LOADINGS: Registries[Any] = Registries(SEPARATION_LOADINGS, CONTACT_LOADINGS, SLIDING_LOADINGS)
TEMPERATURE_LAWS: Registry[Any] = Registry(
    "temperature law",
    {
        "walther": "liquids.viscosity:WaltherViscosity",
        "vogel": "liquids.viscosity:VogelViscosity",
        "linear-surface-tension": "liquids.temperature_laws:LinearSurfaceTension",
        "iapws-surface-tension": "liquids.water:IapwsSurfaceTension",
        "linear-density": "liquids.temperature_laws:LinearDensity",
        "kell-water-density": "liquids.water:KellWaterDensity",
    },
    tag="law",
    group="contactkit.temperature_laws",
    role="TemperatureLaw",
)
RHEOLOGY_LAWS: Registry[Any] = Registry(
    "rheology law",
    {
        "barus": "liquids.rheology.pressure:BarusViscosity",
        "roelands": "liquids.rheology.pressure:RoelandsViscosity",
        "power-law": "liquids.rheology.shear:PowerLawViscosity",
        "carreau": "liquids.rheology.shear:CarreauViscosity",
        "eyring": "liquids.rheology.shear:EyringViscosity",
        "dowson-higginson": "liquids.rheology.density:DowsonHigginsonDensity",
    },
    tag="law",
    role="PressureViscosity, ShearViscosity or PressureDensity",
)
"""Laws of pressure and shear. Films know how each of these flows, and no other: no group."""
ATTRACTION_LAWS: Registry[Any] = Registry(
    "attraction law",
    {
        "exponential": "contact.effects.attraction_laws:ExponentialAttraction",
        "dugdale": "contact.effects.attraction_laws:DugdaleAttraction",
        "lennard-jones": "contact.effects.attraction_laws:LennardJonesAttraction",
    },
    tag="law",
    group="contactkit.attraction_laws",
    role="AttractionLaw",
)

HARDNESS_RULES: Registry[Any] = Registry(
    "hardness rule",
    {
        "continuous": "contact.effects.hardness_rules:ContinuousHardness",
        "literal": "contact.effects.hardness_rules:LiteralHardness",
        "material": "contact.effects.hardness_rules:MaterialHardness",
        "constant": "contact.effects.hardness_rules:ConstantHardness",
    },
    tag="kind",
    group="contactkit.hardness_rules",
    role="HardnessRule",
    naming="plain",
)
MENISCUS_PROFILES: Registry[Any] = Registry(
    "meniscus profile",
    {"as-published": "separation.effects.meniscus:AsPublished"},
    tag="kind",
    role="AsPublished",
    naming="plain",
)
PLANFORMS: Registry[Any] = Registry(
    "planform",
    {
        "disc": "scene.planforms:Disc",
        "ring": "scene.planforms:Ring",
        "rectangle": "scene.planforms:Rectangle",
        "ellipse": "scene.planforms:Ellipse",
        "sector": "scene.planforms:Sector",
        "polygon": "scene.planforms:Polygon",
        "image": "scene.planforms:Image",
        "image-file": "scene.planforms:ImageFile",
        "union": "scene.planforms:Union",
        "intersection": "scene.planforms:Intersection",
        "difference": "scene.planforms:Difference",
    },
    tag="shape",
    group="contactkit.planforms",
    role="Planform",
)
FACE_HOLES: Registry[Any] = Registry(
    "face hole",
    {"vent": "scene.faces:Vent", "sealed-hole": "scene.faces:SealedHole"},
    tag="kind",
    role="FaceHole",
)
KINDS: Registries[Any] = Registries(
    EFFECTS,
    SURFACES,
    SOLIDS,
    LOADINGS,
    TEMPERATURE_LAWS,
    RHEOLOGY_LAWS,
    ATTRACTION_LAWS,
    HARDNESS_RULES,
    MENISCUS_PROFILES,
    PLANFORMS,
    FACE_HOLES,
)
"""All kinds of all families."""


def register(kind: K) -> K:
    """Register a class of your own: an effect, a surface, a solid, a law or a loading.

    It is then planned, saved, loaded and varied by studies like those of contactkit. In a session
    it lasts until Python ends; a package declares it as an entry point instead, and everyone who
    installs the package has it, on the command line too::

        [project.entry-points."contactkit.surfaces"]
        cone = "indenters.shapes:Cone"  # its name in files = "module:class"

    The groups are ``contactkit.effects``, ``.surfaces``, ``.solids``, ``.loadings``,
    ``.temperature_laws``, ``.attraction_laws``, ``.hardness_rules`` and ``.planforms``.

    Parameters
    ----------
    kind : type
        The class; its base class says what it is, and its ``name`` (of an effect) or ``kind`` must
        be new. May be used as a decorator, above that of attrs.

    Returns
    -------
    type
        The same class.

    Raises
    ------
    DescriptionError
        If it is of no family, is not complete, or another class has its name.

    Examples
    --------
    >>> import numpy as np
    >>> from attrs import field, frozen
    >>> import contactkit as ck
    >>> from contactkit.scene.surfaces import Surface
    >>> from contactkit.units import si
    >>> @frozen(kw_only=True)
    ... class Cone(Surface):
    ...     kind = "cone"
    ...     slope: float = field(metadata=si("-"))
    ...
    ...     def heights_on(self, grid):
    ...         return -self.slope * np.hypot(*grid.from_centre())
    >>> with ck.KINDS.including():  # for the length of this example
    ...     made = ck.register(Cone)
    ...     ck.KINDS.find("cone") is made
    True
    """
    return KINDS.register(kind)
