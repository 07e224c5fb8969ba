"""The file of a fuel injector: film and spool, the valve that pulls, and what they are run at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from attrs import evolve, field, frozen

from ...errors import DescriptionError
from ...scene.interface import Interface
from ...scene.loading import ImposedForce
from ...scene.scenes import SeparationScene
from ...separation.effects.registry import SeparationEffect, TensionLimit
from ...units import celsius, si
from ...validators import as_tuple, part, positive
from .valve import Valve

if TYPE_CHECKING:
    from ...analyses.load_displacement.curve import LoadDisplacementCurve

__all__ = ["InjectorScene", "Study", "end_stop_faces"]


def _all_positive(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    for value in values:
        positive(study, attribute, value)


def _temperatures(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    if not values:
        raise DescriptionError(
            "Study.temperatures", values, "name at least one temperature", unit="K"
        )
    _all_positive(study, attribute, values)


@frozen(kw_only=True)
class Study:
    """Settings of the runs of the injector.

    Parameters
    ----------
    temperatures : tuple of float
        Temperatures of the oil [K].
    tension_limits : tuple of float
        Tensions [Pa] the figure of the delays compares, beside none.
    communication_step : float
        Communication step of the co-simulation [s].
    """

    temperatures: tuple[float, ...] = field(
        converter=tuple, validator=_temperatures, metadata=si("K")
    )
    tension_limits: tuple[float, ...] = field(
        default=(), converter=tuple, validator=_all_positive, metadata=si("Pa")
    )
    communication_step: float = field(validator=positive, metadata=si("s"))


@frozen(kw_only=True)
class InjectorScene:
    """A separation scene whose pull comes from a valve, and the temperatures to run it at."""

    name: str = "fuel injector"
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    interface: Interface = field(validator=part(Interface))
    loading: ImposedForce = field(validator=part(ImposedForce))
    effects: tuple[SeparationEffect, ...] = field(converter=as_tuple)
    valve: Valve
    study: Study

    def separation(
        self, temperature: float, *, limited: bool = True, tension: float | None = None
    ) -> SeparationScene:
        """Film of the injector at a temperature [K].

        Without its tension limit if not `limited`, with another tension [Pa] if one is given.
        """
        kept = tuple(e for e in self.effects if limited or not isinstance(e, TensionLimit))
        if tension is not None:
            kept = tuple(
                evolve(e, strength=tension) if isinstance(e, TensionLimit) else e for e in kept
            )
        return SeparationScene(
            name=self.name,
            temperature=temperature,
            interface=self.interface,
            loading=self.loading,
            effects=kept,
        )

    @property
    def first_pulse_end(self) -> float:
        """Time at which the first current pulse ends [s]."""
        return self.valve.profile.start_delay + self.valve.profile.on_time

    @property
    def stop_time(self) -> float:
        """Time at which the last cycle ends [s]."""
        profile = self.valve.profile
        return profile.start_delay + profile.cycles * profile.period


def end_stop_faces(valve: Valve) -> LoadDisplacementCurve | None:
    """Load-displacement curve of the rough faces of the end stop, if it has any."""
    if valve.stop.faces is None:
        return None
    from ..end_stop.solve import solved

    return solved(valve.stop.faces)
