"""Native FMUs of a film between bodies that deform: a spring in series, or the film on rings.

Below a displacement beta by the film over its gap of 0.02 the bodies may stand for a spring in
series with the film of rigid ones (`separation.deforming.maxwell`); above, the state of the FMU is
the film on rings with its cavities, and the matrix of displacements is in the tables. Scenes on
maps have none: their film is a field of some 10 000 cells with contacts and cavities.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal, NamedTuple

from attrs import evolve

from ...errors import DescriptionError, PlanError
from ...lubrication.elastohydrodynamic.mesh import RingMesh, disc_nodes, graded_nodes
from ...lubrication.elastohydrodynamic.motion import SmoothGap
from ...scene.loading import ImposedForce, ImposedSpeed, PressAndPull
from ...scene.scenes import SeparationScene
from ...separation.deforming.checks import is_on_rings
from ...separation.deforming.effects import ElasticBodies, SolidContact
from ...separation.deforming.maxwell import HOLDS_TO, series_error, series_stiffness
from ...separation.deforming.plan import DeformingPlan, plan_deforming
from ...separation.effects.meniscus import MeniscusForce
from ...separation.plan import plan
from ...units import quantity_text
from ..framework.ports import STEP_LIMIT, TOLERANCE, Port, Value
from .film import FINE, liquid_over_temperature
from .models import native_model
from .ports import with_temperature
from .records import Bodies, LiquidTable, Matrix, RingCavity, Rings, Series
from .tables import tabulate

__all__ = [
    "DEFORMING",
    "DeformingFilm",
    "Exactness",
    "deforming_film",
    "exactness_of",
    "free_ports",
]

DEFORMING = {"stiction-mass": "deforming-mass", "stiction-force": "deforming-force"}
"""Models of films between bodies that deform, by those between rigid ones."""

HOLDS_RINGS = 10.0
"""beta up to which the film on rings is taken: beyond, the bodies deform out to its rim."""

LIGHTEST = 0.5
"""Damping of the film over that of the mass on the spring, c/sqrt(k m), up to which these hold.

A mass at rest that is pulled at once has its force right to 1.4 % of the pull with it, to 3.7 %
with 1, where it begins to swing on the spring, to 19 % with 3 and to 63 % with 10: the bodies
answer by many modes, not by one.
"""

# What n rings leave of the force, over its largest in a pull: 10/n^2 at beta = 0.1, 11.6/n^2 at 10,
# with a rim at 8 widths of the pressure; beyond, rings are as many per decade.
_LEFT, _NEAR_RIM = 12.0, 8.0
# What cavities add, with 32 to 112 rings: 1.2e-3 of the force at most, where they open at their own
# pressure. A liquid of more strength ruptures at an instant that rings have to some parts in 100,
# and its force falls at once: 60 rings have the largest to 0.035, 32 to 0.07, beta 0.1 to 10.
_CAVITIES, _RUPTURES = 1.5e-3, 0.035
# Error if nothing is asked for: 60 rings, and 1 ms an internal step.
_USUAL = 3.4e-3
_FEWEST, _MOST = 24, 128  # that still show the pressure; of 8 ms an internal step
# Displacement over the gap, by the force and the gap that there are, up to which steps on rings are
# taken: a pull at beta = 10 reaches 2.3, where its gap is smallest, and a press to five gaps 2.1.
_SOFTEST = 3.0
# Internal steps of a step of the host, on rings some 2 s, of a spring 0.02 s: a pull takes 50-100.
_RING_STEPS, _SERIES_STEPS = 1000, 2000
# Below, with 60 rings, round-off hides the error of a step: 1e-9 is never met.
_LEAST_RTOL = 1e-8
_ROUNDED = 1.0 + 1e-9  # of a beta that was meant to be the bound
_LOWEST = 1e-3  # gap over that at the start from which the damping of rigid bodies is tabulated
_FAR = 100.0  # final gaps to which it is


class Exactness(NamedTuple):
    """Film of an FMU of bodies that deform, and its error.

    Attributes
    ----------
    film : {"series", "rings"}
        Rigid bodies in series with a spring, or the film on rings.
    beta : float or None
        Displacement by the film over the gap, of the scene; None where its pull is an input alone.
    rings : int
        0 of a spring.
    error : float
        Of the largest force of a pull, in parts of it.
    text : str
        All this in a sentence.
    """

    film: Literal["series", "rings"]
    beta: float | None
    rings: int
    error: float
    text: str


class DeformingFilm(NamedTuple):
    """Tables of an FMU, how exact they are, and the plan they were made of."""

    bodies: Bodies
    exactness: Exactness
    plan: DeformingPlan
    liquid: LiquidTable | None = None
    """Laws of the liquid over the temperature, where that is a variable."""


def exactness_of(
    scene: SeparationScene, film_rtol: float | None = None, mass: float | None = None
) -> Exactness:
    """Film that the FMU of a scene with `ElasticBodies` holds, and how exact it is.

    Parameters
    ----------
    scene : SeparationScene
        With `ElasticBodies`.
    film_rtol : float, optional
        Error of the largest force that the film on rings shall have; if not given, a spring may
        do.
    mass : float, optional
        Of the bodies [kg], where it is inside of the FMU.

    Raises
    ------
    PlanError
        If no FMU holds the scene.
    """
    made, beta = _planned(scene)
    return _exactness(made, beta, film_rtol, mass)


def deforming_film(
    scene: SeparationScene, film_rtol: float | None = None, mass: float | None = None
) -> DeformingFilm:
    """Tables of the film of a scene with `ElasticBodies`; arguments as in `exactness_of`.

    Raises
    ------
    PlanError
        If no FMU holds the scene.
    """
    made, beta = _planned(scene)
    film, exactness = made.film, _exactness(made, beta, film_rtol, mass)
    stiffness, rings = _stiffness(made), None
    if exactness.film == "rings" and isinstance(film, SmoothGap):  # `_check` refuses maps
        rings = _rings(film, made.modulus, exactness.rings)
    bodies = Bodies(
        gap=film.gap,
        stiffness=stiffness,
        widens=math.isfinite(film.radius),
        ratio=stiffness * film.gap / _unit_force(made),
        series=_series(scene, film.viscosity) if exactness.film == "series" else None,
        rings=rings,
    )
    return DeformingFilm(bodies, exactness, made, liquid_over_temperature(scene, ("viscosity",)))


def _planned(scene: SeparationScene) -> tuple[DeformingPlan, float | None]:
    """Plan of the scene, and its beta; None where it does not pull."""
    _check(scene)
    loading = scene.loading
    if isinstance(loading, ImposedForce) and loading.force <= 0.0:
        # The pull is an input of an FMU, and may be 0 in its scene.
        return plan_deforming(evolve(scene, loading=evolve(loading, force=1.0))), None
    made, pressed = plan_deforming(scene), 0.0
    if isinstance(loading, PressAndPull):
        pressed = loading.press / _unit_force(made)
    return made, max(made.numbers.beta, pressed)


def _check(scene: SeparationScene) -> None:
    for name in ("lower", "upper"):
        surface = getattr(scene.interface, name).surface
        if surface.curvature is None:
            raise PlanError(
                f"no FMU holds ElasticBodies on a {type(surface).__name__}, "
                f"interface.{name}.surface: its film is a field on a map, of some 10 000 cells "
                "with their own contacts and cavities, and a step takes a second; run the scene "
                "itself, ck.simulate, or give a Flat, a Sphere or a Paraboloid"
            )
    if not is_on_rings(scene):
        raise PlanError(
            "no FMU holds ElasticBodies on a face that is no even disc: its film is a field on a "
            "map, and a step takes a second; run the scene itself, ck.simulate, or give a Flat "
            "without planform, recesses, holes, relief and tilt"
        )
    for kind, why in (
        (SolidContact, "asperities that carry"),
        (MeniscusForce, "a rim that moves"),
    ):
        if scene.effect(kind) is not None:
            raise PlanError(
                f"no FMU holds {kind.__name__} beside ElasticBodies: {why} between bodies that "
                "deform; leave it out, or run the scene itself, ck.simulate"
            )


def _exactness(
    made: DeformingPlan, beta: float | None, asked: float | None, mass: float | None
) -> Exactness:
    if beta is not None and beta > HOLDS_RINGS:
        raise PlanError(
            f"no FMU holds beta = {beta:.3g}: beyond {HOLDS_RINGS:g} the bodies deform out to the "
            "rim of the film; run the scene itself, ck.simulate, or pull less"
        )
    is_stiff = beta is not None and beta <= HOLDS_TO * _ROUNDED and _has_spring(made, mass)
    is_stiff = is_stiff and math.isinf(made.film.cavity)
    if beta is not None and is_stiff and asked is None:
        return _as_series(made, beta)
    return _as_rings(made, beta, asked or _USUAL)


def _has_spring(made: DeformingPlan, mass: float | None) -> bool:
    """Whether the bodies have a known spring, on which the mass does not ring."""
    if any(stack.layers for stack in made.scene.interface.stacks):
        return False
    return (
        mass is None
        or made.rigid_damping <= LIGHTEST * math.sqrt(_stiffness(made) * mass) * _ROUNDED
    )


def _unit_force(made: DeformingPlan) -> float:
    """Force of a film between rigid bodies at the speed at which beta = 1 [N]."""
    return made.rigid_force / made.numbers.beta


def _stiffness(made: DeformingPlan) -> float:
    return series_stiffness(made.film.radius, made.film.width, made.modulus)


def _as_series(made: DeformingPlan, beta: float) -> Exactness:
    error, stiffness = series_error(beta), quantity_text(_stiffness(made), "N/m")
    answer = quantity_text(made.rigid_damping / _stiffness(made), "s")
    text = (
        f"rigid bodies in series with a spring of {stiffness}, for beta = {beta:.2g}: the largest "
        f"force of a pull is right to {error:.2g}, the force to 5 % of it while it builds up; "
        f"motions that change within {answer} or less need the film on rings (film_rtol)"
    )
    return Exactness("series", beta, 0, error, text)


def _as_rings(made: DeformingPlan, beta: float | None, asked: float) -> Exactness:
    film, stretch = made.film, 1.0
    if math.isfinite(film.radius):
        stretch = max(math.asinh(film.rim / film.width) / math.asinh(_NEAR_RIM), 1.0)
    wanted = math.sqrt(_LEFT / asked) * stretch
    if wanted > _MOST:
        least = _LEFT * (stretch / _MOST) ** 2
        raise DescriptionError(
            "film_rtol", asked, f"be {least:.2g} at least", hint=f"an FMU holds {_MOST} rings"
        )
    rings = max(4 * math.ceil(wanted / 4.0), _FEWEST)
    error = _LEFT * (stretch / rings) ** 2
    of = "" if beta is None else f" for beta = {beta:.2g}"
    if isinstance(film, SmoothGap) and math.isfinite(film.cavity):
        error, of = error + _CAVITIES, f"{of}, with cavities"
        if film.strength > film.cavity:
            error, of = max(error, _RUPTURES), f"{of} that open at once, where it ruptures"
    text = f"the film on {rings} rings{of}: the force is right to {error:.2g} of its largest"
    return Exactness("rings", beta, rings, error, text)


def _series(scene: SeparationScene, viscosity: float) -> Series:
    """Damping of the film between rigid bodies."""
    effects = tuple(one for one in scene.effects if not isinstance(one, ElasticBodies))
    gap, final = scene.loading.initial_gap, scene.loading.final_gap
    # Any loading that rigid bodies may have: none is in the damping.
    opens = ImposedSpeed(speed=gap, initial_gap=gap, final_gap=final)  # [m/s], in 1 s
    rigid = plan(evolve(scene, effects=effects, loading=opens), FINE).film
    edges = (_LOWEST * gap, _FAR * final)
    return Series(damping=tabulate(lambda h: rigid.damping(h) / viscosity, edges))


def _rings(film: SmoothGap, modulus: float, count: int) -> Rings:
    rim, is_flat = film.rim / film.width, math.isinf(film.radius)
    nodes = disc_nodes(count, rim) if is_flat else graded_nodes(count, rim)
    pressure = modulus * film.gap / film.width  # by it the bodies are displaced by about the gap
    compliance = film.compliance(nodes * film.width) * (pressure / film.gap)
    curvature = film.width**2 / (film.radius * film.gap)
    return Rings(
        width=film.width,
        pressure=pressure,
        radius=tuple(nodes.tolist()),
        relief=tuple((0.5 * curvature * nodes**2).tolist()),
        area=tuple(RingMesh(nodes).areas.tolist()),
        compliance=Matrix(entry=tuple(compliance.ravel().tolist())),
        cavity=_cavity(film, pressure),
    )


def _cavity(film: SmoothGap, pressure: float) -> RingCavity | None:
    if math.isinf(film.cavity):
        return None
    strength = max(film.strength, film.cavity)
    return RingCavity(tension=film.cavity / pressure, strength=strength / pressure)


def free_ports(film: DeformingFilm, model: str) -> tuple[Port, ...]:
    """Variables of the FMU of a film, with what the scene gives their starts."""
    made, exactness = film.plan, film.exactness
    loading, gap = made.scene.loading, made.film.gap
    own = loading if isinstance(loading, ImposedForce) else None
    on_rings = exactness.film == "rings"
    starts: Mapping[str, Value] = {
        "h": gap,
        "h0": gap,
        "eta": made.film.viscosity,
        "beta_max": _SOFTEST if on_rings else HOLDS_TO,
        "h_rel": loading.final_gap,
        "k_s": own.stiffness if own else 0.0,
        STEP_LIMIT: _RING_STEPS if on_rings else _SERIES_STEPS,
    }
    return tuple(
        _within(evolve(port, start=starts.get(port.name, port.start)), gap, on_rings=on_rings)
        for port in with_temperature(native_model(model).ports, film.liquid, made.scene)
    )


def _within(port: Port, gap: float, *, on_rings: bool) -> Port:
    """Port within what the tables hold: rings are as fine as the pressure at a gap is narrow."""
    if port.name == "h":
        return evolve(port, nominal=10.0 ** math.floor(math.log10(gap)))
    if port.name == "h0":
        low, high = (0.5 * gap, 2.0 * gap) if on_rings else (_LOWEST * gap, None)
        return evolve(port, exclusive=False, minimum=low, maximum=high)
    if port.name == TOLERANCE and on_rings:
        return evolve(port, minimum=_LEAST_RTOL)
    if port.name == "beta_max":
        return evolve(port, maximum=_SOFTEST if on_rings else 1.0)
    return port
