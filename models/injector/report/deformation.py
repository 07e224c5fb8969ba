"""Whether end cap and spool of the injector deform: the number, and the release with and without.

The pull on a spool that stays on its end cap is taken as constant at its largest; the film is that
of a whole round face, and a cavity opens at its own pressure, as the engine of deforming bodies
has no force that jumps there.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from attrs import evolve

from ....errors import ConvergenceError, InfeasibleError, PlanError
from ....lubrication.elastohydrodynamic.motion import SmoothGap
from ....scene.interface import Body
from ....scene.loading import ImposedForce
from ....scene.materials import Material
from ....scene.scenes import SeparationScene
from ....separation.deforming.effects import ElasticBodies
from ....separation.deforming.plan import plan_deforming
from ....separation.deforming.run import pull_apart
from ....separation.effects.viscous import TensionLimit, ViscousForce
from ....separation.plan import plan
from ....separation.simulate import simulate
from ..scene import InjectorScene

__all__ = ["Deformation", "deformation", "deformation_numbers"]

# Assumption: the scene names no material. Through-hardened steel, as of the library.
_STEEL = Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
_MATTERS = 0.02  # of the release, less than what the oil's viscosity is known to


class Deformation(NamedTuple):
    """Release under the largest pull, constant from the start.

    beta, displacement by the film over the gap [-]; times of release [s] of bodies that deform and
    of rigid ones.
    """

    beta: float
    release: float
    rigid_release: float

    @property
    def change(self) -> float:
        """Change of the time of release by the deformation [-]."""
        return self.release / self.rigid_release - 1.0


def deformation(scene: InjectorScene, force: float) -> Deformation:
    """Deformation of steel bodies under a force [N], at the temperature of the scene.

    Raises
    ------
    PlanError, InfeasibleError, ConvergenceError
        If the engine of deforming bodies cannot have this film, or needs a map for it.
    """
    soft, rigid = _films(scene, force)
    made = plan_deforming(soft)
    if not isinstance(made.film, SmoothGap):
        # A report takes a second; a film on a map half a minute.
        raise PlanError(
            "faces that are not round are solved on a map, some 30 s: simulate the film of "
            "`scene.separation` with ElasticBodies"
        )
    found = pull_apart(made).numbers["release_time"]
    stiff = simulate(plan(rigid)).scalars()["release_time"][0]
    return Deformation(made.numbers.beta, found, stiff)


def _films(scene: InjectorScene, force: float) -> tuple[SeparationScene, SeparationScene]:
    given, limit = scene.loading, scene.tension_limit
    made = scene.separation(scene.temperature)
    film: list[Any] = [
        ViscousForce() if isinstance(one, ViscousForce) else one
        for one in made.effects
        if not isinstance(one, TensionLimit)
    ]
    if limit is not None:
        drop, held = limit.cavity_drop, limit.pressure_in_cavity
        film.append(evolve(limit, strength=drop, cavity_pressure=held))
    pull = ImposedForce(
        force=force, mass=given.mass, initial_gap=given.initial_gap, final_gap=given.final_gap
    )
    rigid = evolve(made, loading=pull, effects=tuple(film))
    interface = made.interface
    faces = evolve(
        interface,
        lower=Body(surface=interface.lower.surface, solid=_STEEL),
        upper=Body(surface=interface.upper.surface, solid=_STEEL),
    )
    return evolve(rigid, interface=faces, effects=(ElasticBodies(), *film)), rigid


def deformation_numbers(
    scene: InjectorScene, force: float
) -> tuple[list[str], dict[str, tuple[Any, str]]]:
    """Lines and scalars of the report."""
    try:
        found = deformation(scene, force)
    except (PlanError, InfeasibleError, ConvergenceError) as error:
        return [f"deformation of end cap and spool: not evaluated, {error}"], {}
    verdict = "matters" if abs(found.change) > _MATTERS else "does not matter"
    lines = [
        f"deformation of end cap and spool {verdict}: the film displaces them by {found.beta:.1e} "
        f"of the gap; a steady {force:.1f} N releases after {found.release * 1e3:.4f} ms, from "
        f"rigid bodies after {found.rigid_release * 1e3:.4f} ms ({found.change:+.2%}); assumed: "
        "steel of 210 GPa, whole round faces, a cavity that opens at its own pressure"
    ]
    return lines, {
        "deformation_over_gap": (found.beta, "-"),
        "release_change_by_deformation": (found.change, "-"),
    }
