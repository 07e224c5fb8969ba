"""The variables of ``deforming-mass`` and ``deforming-force``: films between bodies that deform.

They are native alone: the kernel in C steps the film and the bodies together (`native.deforming`),
and no Python FMU does.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from attrs import evolve

from ...errors import DescriptionError, PlanError
from ..framework.ports import (
    NATIVE_STEPS,
    Port,
    find_port,
    grouped,
    input_port,
    output_port,
    size_port,
    step_limit,
    tolerance,
)
from ..framework.slave import PortSlave
from . import stiction_force, stiction_mass

__all__ = ["DeformingForce", "DeformingMass"]


def _of_mass(name: str, **changed: Any) -> Port:
    """Variable of ``stiction-mass``; none of its outputs follows another without a step."""
    port = find_port(stiction_mass.PORTS, name)
    depends = port.depends_on and tuple(one for one in port.depends_on if one == "h0")
    return evolve(port, depends_on=depends, **changed)


_RIGID = "gap of the undeformed bodies"
_AXIS = output_port(
    "h_axis", "m", "gap of the film on the axis", ("h0",), display_unit="um", nominal=1e-6
)
_BETA = output_port(
    "beta", "-", "displacement of the bodies by the film over its gap", minimum=0.0, nominal=0.01
)
_PARAMETERS = (
    _of_mass("h0"),
    _of_mass("eta"),
    size_port("beta_max", "-", "value of beta up to which steps are taken", 0.02),
    tolerance(1e-5),
    step_limit(NATIVE_STEPS),
)
_GROUPS = {
    "geometry": ("h0",),
    "liquid": ("eta",),
    "limits": ("beta_max",),
    "numerics": ("rtol", "max_steps"),
}

MASS_PORTS = grouped(
    (
        _of_mass("F_ext"),
        _of_mass("dF_ext"),
        _of_mass("h", label=_RIGID),
        evolve(_of_mass("v"), depends_on=()),
        _of_mass("F"),
        _of_mass("J", label="impulse of the film since the start"),
        _of_mass("W"),
        _AXIS,
        _BETA,
        _of_mass("t_release"),
        _of_mass("F_peak"),
        _of_mass("n_release"),
        _of_mass("m"),
        _of_mass("k_s"),
        _of_mass("h_rel"),
        *_PARAMETERS,
    ),
    {**_GROUPS, "motion": ("m", "k_s", "h_rel")},
)

_MOTION = ("h", "v")
FORCE_PORTS = grouped(
    (
        evolve(
            find_port(stiction_force.PORTS, "h"),
            label=f"{_RIGID}, at the end of the step to come",
            minimum=None,
            exclusive=False,
        ),
        input_port("v", "m/s", "opening speed there", nominal=0.1),
        evolve(_of_mass("F"), depends_on=_MOTION),
        output_port("c", "N.s/m", "dF/dv over the last step", nominal=1e8),
        output_port("k", "N/m", "dF/dh over the last step", nominal=1e7),
        _of_mass("J", label="impulse of the film since the start"),
        find_port(stiction_force.PORTS, "F_mean"),
        _of_mass("W"),
        _AXIS,
        _BETA,
        *_PARAMETERS,
    ),
    _GROUPS,
)


class _Deforming(PortSlave):
    """Variables of an FMU in C."""

    experiment: ClassVar[Mapping[str, float]] = {
        "startTime": 0.0,
        "stopTime": 1e-2,
        "stepSize": 1e-4,
    }

    def prepare(self) -> None:
        """See `PortSlave.prepare`."""
        raise PlanError("films between bodies that deform have no Python FMU; build it --native")

    def advance(self, time: float, step: float) -> None:
        """See `PortSlave.advance`."""
        self.prepare()


class DeformingMass(_Deforming):
    """A mass held by a film that deforms the bodies; a pull in, motion out."""

    ports: ClassVar[tuple[Port, ...]] = MASS_PORTS
    summary = "Mass held by a liquid film between bodies that deform"

    @classmethod
    def check_start(cls, values: Mapping[str, Any]) -> None:
        """See `PortSlave.check_start`."""
        start = values["h0"]
        if values["h_rel"] <= start:
            raise DescriptionError("h_rel", values["h_rel"], f"exceed h0 = {start:g} m", unit="m")


class DeformingForce(_Deforming):
    """The film for a tool that owns the mass; motion in, force out."""

    ports: ClassVar[tuple[Port, ...]] = FORCE_PORTS
    summary = "Liquid film between bodies that deform, for a tool that owns the mass"
