"""The models of the kernel: one description of each, which Python and C follow.

A variable is added or removed where the model lists its ports (``PORTS`` of its module in
`contactkit.fmu.slaves`): model descriptions, the file of an FMU, and the names, numbers and
enumerations of the kernel follow from it. A model is added by one line here and its `ck_kind` in C.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import Literal

from attrs import frozen

from ...errors import DescriptionError
from ..framework.ports import Port
from ..framework.slave import PortSlave
from ..slaves.contact_stop import ContactStop
from ..slaves.deforming import DeformingForce, DeformingMass
from ..slaves.stiction_force import StictionForce
from ..slaves.stiction_mass import StictionMass
from ..slaves.tip_contact import TipContact
from ..slaves.valve_drive import ValveDrive
from .records import Bodies, Faces, FilmTables

__all__ = [
    "DISCRETE",
    "INDICATORS",
    "MODELS",
    "TEMPERATURE",
    "NativeModel",
    "VARIABLES",
    "enumerations",
    "native_model",
]


TEMPERATURE = Port(
    "T",
    "K",
    causality="parameter",
    label="temperature of the liquid; eta and gamma follow its laws where this is changed",
    start=293.15,
    minimum=0.0,
    exclusive=True,
    display_unit="degC",
    nominal=300.0,
    group="liquid",
)
"""Variable of a film whose liquid has laws over the temperature."""


INDICATORS: Mapping[str, str] = {
    "z_film": "gap over that at which the film breaks, or wets the bodies again, less 1",
    "z_solids": "gap over that at which the solids detach, or touch again, less 1",
    "z_kink": "distance to the nearest gap at which a force is not smooth, over that gap",
    "z_outputs": "-1 where state or limit have to change, else 1",
}
"""Event indicators of model exchange by their names, in their order in the kernel."""


@frozen(kw_only=True)
class NativeModel:
    """A model of the kernel: its variables, and what its file holds besides them."""

    name: str
    slave: type[PortSlave]
    """Its Python FMU, of which it has the variables that its tables leave free."""
    summary: str
    has_film: bool
    faces: Literal["never", "maybe", "always"] = "never"
    deforms: bool = False
    """Whether it has bodies that deform, with a film of their own."""

    takes_temperature: bool = False
    """Whether its liquid may follow its laws over the temperature."""

    exchanges: bool = False
    """Whether it has model exchange, with the event indicators of `INDICATORS`."""

    @property
    def identifier(self) -> str:
        """Name of its library, so that a host may load several."""
        return self.name.replace("-", "_")

    @property
    def ports(self) -> tuple[Port, ...]:
        """Variables that it may have."""
        more = (TEMPERATURE,) if self.takes_temperature else ()
        return *(port for port in self.slave.ports if not port.tabulated), *more

    def check(
        self, tables: FilmTables | None, faces: Faces | None, bodies: Bodies | None = None
    ) -> None:
        """Refuse a file without what the model steps, or with more.

        Raises
        ------
        DescriptionError
            Naming the record.
        """
        expected = {"never": faces is None, "maybe": True, "always": faces is not None}
        if (tables is not None) is not self.has_film:
            raise DescriptionError(f"tables of {self.name}", tables, self._must(self.has_film))
        if (bodies is not None) is not self.deforms:
            raise DescriptionError(f"bodies of {self.name}", bodies, self._must(self.deforms))
        if not expected[self.faces]:
            must = self._must(self.faces == "always")
            raise DescriptionError(f"faces of {self.name}", faces, must)

    @staticmethod
    def _must(be: bool) -> str:
        return "be given" if be else "be None: the model has none"


_ALL = (
    NativeModel(
        name="stiction-mass",
        slave=StictionMass,
        summary=StictionMass.summary,
        has_film=True,
        takes_temperature=True,
    ),
    NativeModel(
        name="stiction-force",
        slave=StictionForce,
        summary="Liquid film between two bodies: forces, impulses and doubts of coupling",
        has_film=True,
        takes_temperature=True,
        exchanges=True,
    ),
    NativeModel(
        name="valve-drive",
        slave=ValveDrive,
        summary=ValveDrive.summary,
        has_film=False,
        faces="maybe",
    ),
    NativeModel(
        name="contact-stop",
        slave=ContactStop,
        summary=ContactStop.summary,
        has_film=False,
        faces="always",
    ),
    NativeModel(
        name="tip-contact",
        slave=TipContact,
        summary=TipContact.summary.partition(" (")[0],  # what Python needs
        has_film=True,
        faces="maybe",
    ),
    NativeModel(
        name="deforming-mass",
        slave=DeformingMass,
        summary=DeformingMass.summary,
        has_film=False,
        deforms=True,
        takes_temperature=True,
    ),
    NativeModel(
        name="deforming-force",
        slave=DeformingForce,
        summary=DeformingForce.summary,
        has_film=False,
        deforms=True,
        takes_temperature=True,
    ),
)
MODELS: Mapping[str, NativeModel] = {model.name: model for model in _ALL}
"""Models of the kernel by their names, in the order of their numbers there."""

_PORTS = tuple(port for model in _ALL for port in model.ports)

VARIABLES = tuple(dict.fromkeys(port.name for port in _PORTS))
"""Names of all variables there may be, in the order of their numbers in the kernel."""

DISCRETE = tuple(
    dict.fromkeys(
        port.name
        for port in _PORTS
        if port.causality == "output" and port.variability == "discrete"
    )
)
"""Names of the outputs that change at events only."""


def enumerations() -> tuple[type[IntEnum], ...]:
    """Enumerations of the variables, each once."""
    found = dict.fromkeys(port.enumeration for port in _PORTS)
    return tuple(one for one in found if one is not None)


def native_model(name: str) -> NativeModel:
    """Model of a name.

    Raises
    ------
    DescriptionError
        If there is none.
    """
    if name not in MODELS:
        raise DescriptionError("model", name, "be " + " or ".join(map(repr, MODELS)))
    return MODELS[name]
