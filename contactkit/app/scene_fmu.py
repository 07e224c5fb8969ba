"""FMU that holds a scene, by its kind, and the start values to bake in."""

from __future__ import annotations

from functools import singledispatch

from ..accuracy import Accuracy
from ..errors import PlanError
from ..export.report import FmuStart
from ..scene.scenes import ContactScene, Scene, SeparationScene

__all__ = ["fmu_start"]


@singledispatch
def fmu_start(scene: Scene, accuracy: Accuracy) -> FmuStart:
    """Return the name of the FMU of a scene, and its start values.

    Raises
    ------
    PlanError
        If no FMU holds such a scene, or this one.
    """
    kind = type(scene).__name__.removesuffix("Scene").lower()
    raise PlanError(f"no FMU holds a {kind} scene; an FMU needs a scene with an opening")


@fmu_start.register
def _(scene: SeparationScene, accuracy: Accuracy) -> FmuStart:
    from ..fmu.slaves.stiction_mass import mass_values
    from ..separation.deforming.effects import ElasticBodies

    if scene.effect(ElasticBodies) is not None:
        raise PlanError(
            "the Python FMUs have films between rigid bodies, and this scene has ElasticBodies: "
            "build it --native, as contactkit.fmu.native.build.build_native"
        )
    return FmuStart("stiction-mass", mass_values(scene))


@fmu_start.register
def _(scene: ContactScene, accuracy: Accuracy) -> FmuStart:
    from ..analyses.load_displacement.solve import load_displacement

    try:
        curve = load_displacement(scene, accuracy=accuracy)
        return FmuStart("contact-stop", {"curve": curve})
    except PlanError as error:
        raise PlanError(
            "of a contact scene the FMU contact-stop is built, whose tables are its "
            f"load-displacement curve, force and areas over the approach; {error}"
        ) from error
