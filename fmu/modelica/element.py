"""Parts of a mechanical model: an FMU's variables by their roles, and the signs of its force.

A force element gives a force for the motion of its two flanges. Modelica's `PartialCompliant` has
``s_rel = flange_b.s - flange_a.s`` and a force ``f`` that is positive where the element pulls its
flanges together, as a stretched spring does; a film that resists opening does the same. A body
moves under the force at its one flange.
"""

from __future__ import annotations

import re
from typing import Any, Literal

from attrs import frozen

from ...errors import DescriptionError

__all__ = ["Element", "element_of"]


@frozen(kw_only=True)
class Element:
    """An FMU as a part of a mechanical model."""

    kind: Literal["force", "body"]
    about: str
    gap: str
    speed: str
    force: str
    sign: int = 1
    """Of a force element: 1 where its force pulls the flanges together, -1 where it pushes."""

    acceleration: str | None = None
    rate: str | None = None
    """Of a body: input for the rate of the force."""

    @property
    def inputs(self) -> tuple[str, ...]:
        """Inputs of the FMU."""
        motion = (self.gap, self.speed, self.acceleration)
        named = (self.force, self.rate) if self.kind == "body" else motion
        return tuple(name for name in named if name is not None)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Outputs of the FMU that the wrapper uses."""
        return (self.gap, self.speed) if self.kind == "body" else (self.force,)


_FILM = Element(kind="force", about="liquid film between two bodies", gap="h", speed="v", force="F")
_BODY = Element(
    kind="body",
    about="body held by a liquid film on a fixed one",
    gap="h",
    speed="v",
    force="F_ext",
    rate="dF_ext",
)
_STOP = Element(kind="force", about="rough end stop", gap="h", speed="v", force="F")
_TIPS = Element(
    kind="force",
    about="spring tips between a root and their site",
    gap="z",
    speed="vz",
    acceleration="az",
    force="F",
)
_DRIVE = Element(
    kind="force",
    about="solenoid valve that pushes its spool off",
    gap="h",
    speed="v",
    force="F_ext",
    sign=-1,
)
_ELEMENTS = {
    "stiction_force": _FILM,
    "deforming_force": _FILM,
    "stiction_mass": _BODY,
    "deforming_mass": _BODY,
    "contact_stop": _STOP,
    "tip_contact": _TIPS,
    "valve_drive": _DRIVE,
}


def element_of(model: Any) -> Element:
    """Part of a mechanical model that an FMU is.

    Parameters
    ----------
    model : fmpy.model_description.ModelDescription
        Its model description.

    Raises
    ------
    DescriptionError
        If it is none of contactkit, or lacks a variable.
    """
    causalities = {variable.name: variable.causality for variable in model.modelVariables}
    # Python FMUs are named as their classes, StictionMass.
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", model.modelName).lower()
    found = _ELEMENTS.get(name)
    if found is None:
        known = ", ".join(one.replace("_", "-") for one in _ELEMENTS)
        raise DescriptionError(
            "FMU",
            model.modelName,
            f"be of a model with flanges: {known}",
            hint="build one with contactkit fmu build",
        )
    needed = dict.fromkeys(found.inputs, "input") | dict.fromkeys(found.outputs, "output")
    missing = [name for name, causality in needed.items() if causalities.get(name) != causality]
    if missing:
        raise DescriptionError(
            "FMU", model.modelName, f"have its variables: it lacks {', '.join(missing)}"
        )
    return _turned(found, model) if found is _STOP else found


def _turned(stop: Element, model: Any) -> Element:
    """End stop on its side: one that is met on the way down pushes the bodies apart."""
    from attrs import evolve

    from ..slaves.contact_stop import StopSide

    (side,) = (v for v in model.modelVariables if v.name == "side")
    return evolve(stop, sign=-1) if int(side.start) == StopSide.BELOW else stop
