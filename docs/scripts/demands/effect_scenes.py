"""A scene for each effect, with it and without it, and the formula of the effect."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from attrs import evolve

import contactkit as ck
from contactkit.benchmarks.rough_studies import rough_steel as contact
from contactkit.benchmarks.separation_studies import film_scene as disc

__all__ = ["ENTRIES", "Entry"]

DEG = math.pi / 180.0


class Entry(NamedTuple):
    """Formula of an effect, what the scene is, the scene with the effect and without it.

    `without` is None where the effect cannot be left out; `instead` names what takes its place.
    """

    formula: str
    what: str
    scene: Any
    without: Any
    accuracy: ck.Accuracy = ck.Accuracy()
    instead: str = "nothing"


def _less(scene: Any, kind: type) -> Any:
    """The scene without an effect."""
    return evolve(scene, effects=tuple(e for e in scene.effects if not isinstance(e, kind)))


def _entry(formula: str, what: str, scene: Any, kind: type, **more: Any) -> Entry:
    return Entry(formula, what, scene, _less(scene, kind), **more)


# Contact ------------------------------------------------------------------------------------

STEEL = ck.load_material("bearing-steel")
COATED = ck.Stack(
    layers=(ck.Layer(material=ck.load_material("dlc"), thickness=20e-9),), substrate=STEEL
)
WATER = ck.Meniscus(
    liquid=ck.load_liquid("water"), contact_angle_lower=60.0 * DEG, contact_angle_upper=60.0 * DEG
)
MAP = ck.Accuracy(grid=256)
ROUGH_MAP = "steel under a rough flat, 2 um wide, 256 x 256 pixels, 200 MPa"


def ball(*effects: Any) -> ck.ContactScene:
    """A rigid sphere on a soft half-space, isolated."""
    soft = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=1e8)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=soft), upper=ck.Body(surface=ck.Paraboloid(radius=1e-6))
        ),
        window=ck.Window(width=240e-9, periodic=False),
        loading=ck.Pressing(force=5e-7),
        effects=(ck.HalfSpace(), *effects),
    )


POLYMER = ck.ViscoelasticMaterial(
    name="polymer", young_modulus=1e9, fractions=0.9, times=1.0, poisson_ratio=0.4
)
HALF, FRICTION = ck.HalfSpace(), ck.FrictionTraction(coefficient=0.3)
ATTRACTION = ck.Adhesion(law=ck.ExponentialAttraction(work_of_adhesion=0.05, range=5e-9))
SLIP = ck.PartialSlip(coefficient=0.3, path=(ck.TangentialStep(ratio=0.6),))
CREEP = ck.Viscoelasticity(times=(0.1, 1.0, 10.0), steps=2)
HISTORY = ck.PlasticHistory(pressures=(4e8,), steps=4)

CONTACTS: Mapping[type, Entry] = {
    ck.HalfSpace: Entry(
        r"C(\alpha) = \frac{2}{E^* \alpha}, \qquad \frac{1}{E^*} = \frac{1 - \nu_1^2}{E_1} + "
        r"\frac{1 - \nu_2^2}{E_2}",
        ROUGH_MAP,
        contact(HALF),
        None,
        MAP,
        "one compliance is needed",
    ),
    ck.LayeredHalfSpace: Entry(
        r"C(\alpha) = \frac{2 (1 - \nu^2)}{E \alpha}\, c(\alpha h_1, \alpha h_2, \ldots)",
        ROUGH_MAP + ", coated with 20 nm of DLC",
        contact(ck.LayeredHalfSpace(), solid=COATED),
        contact(HALF),
        MAP,
        "`half-space` without the coating",
    ),
    ck.HardnessLimit: _entry(
        r"0 \le p \le H",
        ROUGH_MAP,
        contact(HALF, ck.HardnessLimit(rule=ck.ConstantHardness(hardness=7.5e9))),
        ck.HardnessLimit,
        accuracy=MAP,
    ),
    ck.Adhesion: _entry(
        r"p = q - \tau(g), \qquad q \ge 0, \quad g \ge 0, \quad q \, g = 0",
        "a sphere of 1 um, 64 x 64 pixels, 0.05 J/m2 over 5 nm",
        ball(ATTRACTION),
        ck.Adhesion,
        accuracy=ck.Accuracy(grid=64),
    ),
    ck.PlasticHistory: _entry(
        r"w_p \leftarrow w_p + \text{overlap where } p = H, \qquad \int P\,d\delta = \tfrac12 "
        r"\int p\,u\,dA + \int H\,dw_p\,dA",
        ROUGH_MAP + ", after 400 MPa in four steps",
        contact(HALF, ck.HardnessLimit(rule=ck.ConstantHardness(hardness=7.5e9)), HISTORY),
        ck.PlasticHistory,
        accuracy=MAP,
    ),
    ck.Viscoelasticity: Entry(
        r"\hat u(t) = \int_0^t \hat C(\alpha, t - t')\, \dot{\hat p}(t')\, dt', \qquad "
        r"\hat C(\alpha, s) = C(\alpha; E_j(s))",
        "a rough flat on a polymer, 2 um wide, 256 x 256 pixels, 1 MPa held for 10 s",
        contact(HALF, CREEP, solid=POLYMER, pressure=1e6),
        contact(HALF, solid=POLYMER.instantaneous, pressure=1e6),
        MAP,
        "the instantaneous modulus",
    ),
    ck.FrictionTraction: _entry(
        r"q = \mu p",
        ROUGH_MAP,
        contact(HALF, FRICTION),
        ck.FrictionTraction,
        accuracy=MAP,
    ),
    ck.FrictionCoupling: _entry(
        r"\hat u_z = C \hat p + \mu F_{12} \frac{i \xi}{\alpha} \hat p",
        ROUGH_MAP + ", sliding with 0.3",
        contact(HALF, FRICTION, ck.FrictionCoupling()),
        ck.FrictionCoupling,
        accuracy=MAP,
    ),
    ck.PartialSlip: _entry(
        r"\min_q \tfrac12 (q - q_0)^T H (q - q_0) - D \sum (q - q_0), \qquad |q| \le \mu p",
        ROUGH_MAP + ", drawn to 0.6 of the force of full sliding",
        contact(HALF, SLIP),
        ck.PartialSlip,
        accuracy=MAP,
    ),
    ck.SubsurfaceStress: _entry(
        r"\hat\sigma_{ij}(\xi, \eta, z) = S_{ij}(\xi, \eta, z)\, \hat p + "
        r"T_{ij}(\xi, \eta, z)\, \hat q",
        ROUGH_MAP + ", depths by themselves",
        contact(HALF, ck.SubsurfaceStress()),
        ck.SubsurfaceStress,
        accuracy=MAP,
    ),
    ck.FilmMeniscus: _entry(
        r"F_m = \frac{\gamma (\cos\theta_1 + \cos\theta_2)}{h_m} \, A_m",
        ROUGH_MAP + ", a film of water of 1 nm",
        contact(HALF, ck.FilmMeniscus(film_thickness=1e-9)),
        ck.FilmMeniscus,
        accuracy=MAP,
    ),
    ck.IslandBridges: _entry(
        r"F = \sum_i F_{bridge}(D_i, V_i, \theta_1, \theta_2, R_i)",
        ROUGH_MAP + ", a film of water of 1 nm",
        contact(HALF, ck.IslandBridges(film_thickness=1e-9)),
        ck.IslandBridges,
        accuracy=MAP,
    ),
}

# Separation ---------------------------------------------------------------------------------

OIL = ck.load_liquid("engine-oil-15w-40")
DISC = "a disc of 3.175 mm pulled by 40 N off 0.16 mm3 of engine oil, from 5 to 25 um"
TIP = "a sphere of 1 um drawn off a flat at 1 um/s, with 1e-22 m3 of water"


def tip(*effects: Any, gap: float = 0.4e-9) -> ck.SeparationScene:
    """A sphere drawn off a flat at a given speed, from a gap [m]."""
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Flat(), upper=ck.Sphere(radius=1e-6), meniscus=evolve(WATER, volume=1e-22)
        ),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=20e-9, speed=1e-6),
        effects=effects,
    )


ASPERITIES = ck.AsperityMenisci(
    asperities=ck.AsperityPopulation(density=1e12, radius=1e-6),
    law="identical",
    meniscus_height=100e-9,
)


def faces(*effects: Any) -> ck.SeparationScene:
    """A rough face, wet at its summits, drawn off a flat."""
    face = ck.Flat(radius=50e-6)
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=WATER),
        loading=ck.ImposedSpeed(initial_gap=10e-9, final_gap=50e-9, speed=1e-6),
        effects=effects,
    )


MENISCUS, VISCOUS = ck.MeniscusForce(), ck.ViscousForce()
TENSION, SHEAR = ck.TensionLimit(strength=1e6), ck.ShearLimit(strength=1e5)
VDW = ck.VanDerWaalsForce(hamaker_constant=1e-19)
TOUCHING = ck.AdhesiveContact(work_of_adhesion=0.05, reduced_modulus=1e11)


def gel(loading: Any, *effects: Any) -> ck.SeparationScene:
    """A rigid lens of 5 mm on a gel, flooded with an oil."""
    soft = ck.Material(young_modulus=1e6, poisson_ratio=0.5)
    oil = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(solid=soft), upper=ck.Sphere(radius=5e-3), meniscus=oil
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), VISCOUS, *effects),
    )


LENS = "a rigid lens of 5 mm on a gel of 1 MPa in oil, "
DRAWN = ck.ImposedSpeed(speed=1e-5, initial_gap=1e-6, final_gap=5e-6)
PRESSED = ck.PressAndPull(press=1e-4, rest=5.0, speed=1e-5, initial_gap=1e-6, final_gap=5e-6)

BRIDGE = "1 mm3 of an oil of 1 Pa.s between spheres of 4 mm, drawn from 50 um to 1.3 mm at 0.5 mm/s"


def bridge(effect: Any, angle: float = 0.0) -> ck.SeparationScene:
    """A bridge of a thick oil between two spheres, drawn out."""
    oil = ck.Liquid(name="oil", viscosity=1.0, surface_tension=0.021, density=965.0)
    ball = ck.Sphere(radius=4e-3)
    film = ck.Meniscus(
        liquid=oil, volume=1e-9, contact_angle_lower=angle, contact_angle_upper=angle
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=ball, upper=ball, meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=50e-6, final_gap=1.3e-3, speed=5e-4),
        effects=(MENISCUS, VISCOUS, effect),
    )


SEPARATIONS: Mapping[type, Entry] = {
    ck.ElasticBodies: _entry(
        r"h = z + \frac{r^2}{2R} + C * (p + p_c)",
        LENS + "drawn apart from 1 um to 5 um at 10 um/s",
        gel(DRAWN),
        ck.ElasticBodies,
        instead="rigid bodies",
    ),
    ck.SolidContact: _entry(
        r"0 \le p_c \perp h - h_c \ge 0",
        LENS + "pressed by 0.1 mN for 5 s, drawn apart; asperities of 0.2 um",
        gel(PRESSED, ck.SolidContact(cutoff=2e-7)),
        ck.SolidContact,
    ),
    ck.MeniscusForce: _entry(
        r"F = 2 \pi \gamma\, x \sin\varphi - \pi x^2 \Delta p",
        DISC,
        disc(MENISCUS, VISCOUS),
        ck.MeniscusForce,
    ),
    ck.ViscousForce: _entry(
        r"F = \frac{3 \pi}{2} \eta \frac{r^4 \dot h}{h^3} \text{ (flats)}, \qquad "
        r"F = 6 \pi \eta R^2 \left(1 - \frac{D}{H}\right)^2 \frac{\dot D}{D} \text{ (sphere)}",
        DISC,
        disc(MENISCUS, VISCOUS),
        ck.ViscousForce,
    ),
    ck.TensionLimit: _entry(
        r"p \ge p_{ambient} - \sigma_t \text{ before it cavitates}, \qquad p \ge p_c "
        r"\text{ in the cavity after it}",
        DISC + ", strength of 10 bar",
        disc(VISCOUS, TENSION),
        ck.TensionLimit,
    ),
    ck.ShearLimit: _entry(
        r"|\tau| \le \tau_L",
        DISC + ", limiting shear strength of 0.1 MPa",
        disc(VISCOUS, SHEAR),
        ck.ShearLimit,
    ),
    ck.Rupture: _entry(
        r"F_{film} = 0 \text{ for } h > h_{break}",
        DISC + ", breaks at 15 um",
        disc(VISCOUS, ck.Rupture(gap=15e-6)),
        ck.Rupture,
    ),
    ck.VanDerWaalsForce: _entry(
        r"F = \frac{A R}{6 D^2} \text{ (sphere)}, \qquad F = \frac{A r^2}{6 h^3} \text{ (flats)}",
        TIP,
        tip(MENISCUS, VDW),
        ck.VanDerWaalsForce,
    ),
    ck.AdhesiveContact: _entry(
        r"P = a^3 - \lambda (a s + c^2 \varphi), \qquad \delta = a^2 - \tfrac43 \lambda s",
        TIP,
        tip(MENISCUS, TOUCHING, gap=0.15e-9),
        ck.AdhesiveContact,
    ),
    ck.AsperityMenisci: _entry(
        r"F = \int_D^{D + h_m} F_{bridge}(z - D)\, n\, \phi(z)\, dz",
        "a face of 50 um with 1e12 asperities/m2, drawn from 10 to 50 nm",
        faces(VDW, ASPERITIES),
        ck.AsperityMenisci,
    ),
    ck.LiquidWeight: _entry(
        r"\Delta F = \rho g V \frac{d z_c}{dh}",
        BRIDGE,
        bridge(ck.LiquidWeight()),
        ck.LiquidWeight,
    ),
    ck.LandauLevichFilm: _entry(
        r"\frac{dV}{dt} = -\sum 2 \pi r U e, \qquad e = \frac{1.34}{\kappa} Ca^{2/3}",
        BRIDGE,
        bridge(ck.LandauLevichFilm()),
        ck.LandauLevichFilm,
    ),
    ck.CoxVoinovAngle: _entry(
        r"G(\theta_d) = G(\theta_0) + Ca \ln\frac{L}{\lambda}, \qquad G \approx \frac{\theta^3}{9}",
        BRIDGE + ", contact angles of 40 deg",
        bridge(ck.CoxVoinovAngle(), angle=40.0 * DEG),
        ck.CoxVoinovAngle,
    ),
    ck.TroutonForce: _entry(
        r"F = 3 \eta \frac{A^2}{V} \dot h",
        BRIDGE,
        bridge(ck.TroutonForce()),
        ck.TroutonForce,
    ),
    ck.DynamicRupture: _entry(
        r"h_r = h_s (1 + Ca^{1/2})",
        BRIDGE,
        bridge(ck.DynamicRupture()),
        ck.DynamicRupture,
    ),
}

# Sliding ------------------------------------------------------------------------------------

DRAWN = "a disc of 3 mm on 0.1 mm3 of engine oil, 5 um high, drawn at 10 mm/s"
PINNED = ck.ContactAngleHysteresis(advancing_lower=60.0 * DEG, receding_lower=20.0 * DEG)


def sliding(*effects: Any) -> ck.SlidingScene:
    """A disc drawn along a wetted face."""
    face = ck.Flat(radius=3e-3)
    film = ck.Meniscus(liquid=OIL, volume=0.1e-9)
    return ck.SlidingScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=ck.Sliding(gap=5e-6, speed=1e-2),
        effects=effects,
    )


SLIDINGS: Mapping[type, Entry] = {
    ck.CouetteForce: _entry(
        r"F = \eta \frac{v}{h} A(L)", DRAWN, sliding(ck.CouetteForce(), PINNED), ck.CouetteForce
    ),
    ck.ContactAngleHysteresis: _entry(
        r"F = k \gamma w (\cos\theta_r - \cos\theta_a)",
        DRAWN,
        sliding(ck.CouetteForce(), PINNED),
        ck.ContactAngleHysteresis,
    ),
}

ENTRIES: Mapping[type, Entry] = {**SEPARATIONS, **SLIDINGS, **CONTACTS}
"""Every registered effect."""
