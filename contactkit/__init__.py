"""Meniscus and viscous forces that resist separating wetted surfaces.

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
  on   meniscus-force  capillary force of the meniscus (profile='arc', pulled='lower')
  on   viscous-force   viscous force of the film (Reynolds) (closure='volume-conserving')
  on   tension-limit   the liquid cannot be pulled below a given pressure (tension=1000000.0, ambient_pressure=101325.0, cavity='clipped')
  off  shear-limit     wall shear stress bounded by a limiting shear strength
  off  rupture         the film breaks at a gap
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .accuracy import Accuracy
from .effects import EFFECTS, MeniscusForce, Rupture, ShearLimit, TensionLimit, ViscousForce
from .errors import (
    ContactkitError,
    ConvergenceError,
    DescriptionError,
    InfeasibleError,
    NotSimulatedError,
    PlanError,
    ValidityWarning,
)
from .interface import Interface, Meniscus, Opening
from .liquids import Liquid
from .motion import advance
from .motion_state import FilmStatus, LimitKind, MotionState, Pull
from .plan import Plan, plan
from .scene import SeparationScene
from .surfaces import Flat, Sphere

if TYPE_CHECKING:
    from .archive import load_result, save_result
    from .io import load_liquid, load_scene, save_scene
    from .separation import simulate

__version__ = "0.1.0"

__all__ = [
    "EFFECTS", "Accuracy", "ContactkitError", "ConvergenceError", "DescriptionError",
    "FilmStatus", "Flat", "InfeasibleError", "Interface", "LimitKind", "Liquid", "Meniscus",
    "MeniscusForce", "MotionState", "NotSimulatedError", "Opening", "Plan", "PlanError", "Pull",
    "Rupture", "SeparationScene", "ShearLimit", "Sphere", "TensionLimit", "ValidityWarning",
    "ViscousForce", "advance", "load_liquid", "load_result", "load_scene", "plan", "save_result",
    "save_scene", "simulate",
]  # fmt: skip

# What needs numpy or cattrs is imported when it is first asked for.
_LATER = {
    "simulate": "separation",
    "load_liquid": "io",
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
