"""The file of a fuel injector: film and spool, the valve that pulls, and what they are run at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from attrs import evolve, field, frozen

from ...errors import DescriptionError
from ...scene.interface import Interface
from ...scene.loading import ImposedForce
from ...scene.scenes import SeparationScene
from ...separation.effects.base import SeparationEffect
from ...separation.effects.viscous import TensionLimit
from ...units import celsius, si
from ...validators import as_tuple, finite, part, positive
from ..device import Device
from .valve import Valve

if TYPE_CHECKING:
    from ...analyses.load_displacement.curve import LoadDisplacementCurve

__all__ = ["InjectorScene", "Study", "end_stop_faces"]


def _all_positive(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    for value in values:
        positive(study, attribute, value)


def _all_finite(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    for value in values:
        finite(study, attribute, value)


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
    strengths : tuple of float
        Tensile strengths of the oil [Pa], drops below ambient pressure, over which a figure shows
        the delay.
    cavity_pressures : tuple of float
        Pressures in the cavity once the oil has cavitated [Pa], absolute, that the figures compare,
        beside an oil that goes on to sustain its strength. Below zero: a tension.
    ambient_pressures : tuple of float
        Pressures of the oil around the face [Pa], absolute, over which a figure shows the delay.
    communication_step : float
        Communication step of the co-simulation [s].
    """

    temperatures: tuple[float, ...] = field(
        converter=tuple, validator=_temperatures, metadata=si("K")
    )
    strengths: tuple[float, ...] = field(
        default=(), converter=tuple, validator=_all_positive, metadata=si("Pa")
    )
    cavity_pressures: tuple[float, ...] = field(
        default=(), converter=tuple, validator=_all_finite, metadata=si("Pa")
    )
    ambient_pressures: tuple[float, ...] = field(
        default=(), converter=tuple, validator=_all_positive, metadata=si("Pa")
    )
    communication_step: float = field(validator=positive, metadata=si("s"))


@frozen(kw_only=True)
class InjectorScene(Device):
    """A separation scene whose pull comes from a valve, and the temperatures to run it at."""

    reported_by: ClassVar[str] = f"{__package__}.report.run"

    name: str = "fuel injector"
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    interface: Interface = field(validator=part(Interface))
    loading: ImposedForce = field(validator=part(ImposedForce))
    effects: tuple[SeparationEffect, ...] = field(converter=as_tuple)
    valve: Valve
    study: Study

    @property
    def tension_limit(self) -> TensionLimit | None:
        """Tension limit of the file; None if its oil never cavitates."""
        return next((e for e in self.effects if isinstance(e, TensionLimit)), None)

    def separation(
        self,
        temperature: float,
        *,
        cavitates: bool = True,
        strength: float | None = None,
        cavity_pressure: float | None = None,
        ambient_pressure: float | None = None,
    ) -> SeparationScene:
        """Film of the injector at a temperature [K].

        Parameters
        ----------
        temperature : float
            Temperature of the oil [K].
        cavitates : bool
            Whether the oil cavitates as the file says; if not, it never does.
        strength : float, optional
            Another tensile strength [Pa] than that of the file.
        cavity_pressure : float, optional
            Another pressure in the cavity [Pa], absolute. Never below that at which the whole oil
            cavitates, so that -inf is an oil that goes on to sustain its strength.
        ambient_pressure : float, optional
            Another pressure of the oil around the face [Pa], absolute. The oil cavitates at the
            same absolute pressure as in the file, unless a strength is given.
        """

        def evolved(limit: TensionLimit) -> TensionLimit:
            around = limit.ambient_pressure if ambient_pressure is None else ambient_pressure
            same = limit.tension + (around - limit.ambient_pressure)
            bears = same if strength is None else strength
            found: dict[str, Any] = {"ambient_pressure": around, "strength": bears}
            if limit.cavity == "mass-conserving":
                held = limit.cavity_pressure if cavity_pressure is None else cavity_pressure
                found["cavity_pressure"] = None if held is None else max(held, around - bears)
            return evolve(limit, **found)

        effects = tuple(
            evolved(e) if isinstance(e, TensionLimit) else e
            for e in self.effects
            if cavitates or not isinstance(e, TensionLimit)
        )
        return SeparationScene(
            name=self.name,
            temperature=temperature,
            interface=self.interface,
            loading=self.loading,
            effects=effects,
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
