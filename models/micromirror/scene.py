"""Scene of a micromirror: one tip and its film, the mirror, settings of its runs."""

from __future__ import annotations

from typing import Any, ClassVar

from attrs import evolve, field, frozen

from ...errors import DescriptionError
from ...scene.interface import Interface
from ...scene.loading import ImposedForce
from ...scene.scenes import SeparationScene
from ...separation.effects.base import SeparationEffect
from ...separation.plan import Plan
from ...units import celsius, si
from ...validators import as_tuple, fraction, part, positive
from ..device import Device
from .coupling import LocalTip, TipSides
from .flight import Root
from .mirror import Attitude, Mirror, electrode_volts, landed_tilt, root_height
from .tip import TipStop, contact_of, free_start, landed_start
from .tip_film import tip_law
from .tip_impact import rest_depth

__all__ = ["MicromirrorScene", "MirrorStudy"]

_ITERATIONS = 8  # each brings the tilt at rest nearer by the ratio of tip and site, some 1 %


def _humidities(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    for value in values:
        _humidity(study, attribute, value)


def _humidity(study: object, attribute: Any, value: float) -> None:
    fraction(study, attribute, value)
    if value == 1.0:
        raise DescriptionError(
            f"MirrorStudy.{attribute.name}",
            value,
            "be less than 1",
            hint="at saturation all is flooded",
        )


@frozen(kw_only=True)
class MirrorStudy:
    """Settings of the runs of the micromirror.

    Parameters
    ----------
    humidity : float
        Relative humidity of the run over time [-].
    humidities : tuple of float
        Relative humidities at which release is looked for [-].
    largest_reset : float
        Largest reset voltage that is tried [V].
    patience : float
        Longest time without a voltage [s] in which release is looked for.
    communication_step : float
        Communication step of the co-simulation [s].
    """

    humidity: float = field(validator=_humidity, metadata=si("-"))
    humidities: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_humidities, metadata=si("-")
    )
    largest_reset: float = field(validator=positive, metadata=si("V"))
    patience: float = field(validator=positive, metadata=si("s"))
    communication_step: float = field(validator=positive, metadata=si("s"))


@frozen(kw_only=True)
class MicromirrorScene(Device):
    """Everything the file of a micromirror says; `interface` and `loading` are those of one tip."""

    reported_by: ClassVar[str] = f"{__package__}.report.run"

    interface: Interface = field(validator=part(Interface))
    loading: ImposedForce = field(validator=part(ImposedForce))
    effects: tuple[SeparationEffect, ...] = field(converter=as_tuple)
    mirror: Mirror = field(validator=part(Mirror))
    study: MirrorStudy = field(validator=part(MirrorStudy))
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    name: str = "micromirror"

    def __attrs_post_init__(self) -> None:
        loading = self.loading
        if loading.rest_gap != loading.initial_gap:
            raise DescriptionError(
                "ImposedForce.rest_gap",
                loading.rest_gap,
                f"equal initial_gap = {loading.initial_gap:g} m",
                unit="m",
                hint="a tip that has landed rests on its roughness",
            )
        if loading.mass is None or loading.stiffness == 0.0:
            name, unit = ("mass", "kg") if loading.mass is None else ("stiffness", "N/m")
            value = getattr(loading, name)
            raise DescriptionError(
                f"ImposedForce.{name}", value, "be that of a spring tip", unit=unit
            )

    @property
    def tip(self) -> SeparationScene:
        """Scene of one tip, before any liquid has condensed."""
        return SeparationScene(
            name=self.name,
            temperature=self.temperature,
            interface=self.interface,
            loading=self.loading,
            effects=self.effects,
        )

    @property
    def start(self) -> Attitude:
        """Tilt [rad] and rate [rad/s] of the mirror that rests under its bias."""
        volts = electrode_volts(self.mirror.waveform, -1.0)
        tilt, stop = landed_tilt(self.mirror, self.loading.stiffness, volts), self.stop
        if stop is None:
            return Attitude(tilt, 0.0)
        for _ in range(_ITERATIONS):
            # An elastic site makes the spring of a tip softer by the approach of the apex.
            height, depth = self._sunk(stop, tilt)
            softer = self.loading.stiffness * (1.0 + depth / height)
            tilt = landed_tilt(self.mirror, softer, volts)
        return Attitude(tilt, 0.0)

    def _sunk(self, stop: TipStop, tilt: float) -> tuple[float, float]:
        """Height [m] of the root of a landed tip, and its approach [m] at the humidity of runs."""
        made, height = (
            tip_law(self.tip, self.study.humidity),
            root_height(self.mirror.tips, tilt, 1.0),
        )
        contact = contact_of(made, stop, landed_start(made), Root(height))
        return height, rest_depth(contact, 0.0, 0.0)

    @property
    def stop(self) -> TipStop | None:
        """Faces of apex and site; None on a rigid site."""
        faces = self.mirror.tips.faces
        if faces is None:
            return None
        from ..end_stop.solve import solved

        return TipStop(solved(faces), self.mirror.tips.landing_damping)

    def tips(self, made: Plan) -> TipSides[LocalTip]:
        """Tips of both sides at the start: the side + landed, the side - free."""
        tips, (tilt, _), stop = self.mirror.tips, self.start, self.stop
        landed = landed_start(made, stop=stop, height=root_height(tips, tilt, 1.0))
        far = free_start(made, root_height(tips, tilt, -1.0))
        return TipSides(
            LocalTip(made, tips.damping, tips.per_side, landed, stop),
            LocalTip(made, tips.damping, tips.per_side, far, stop),
        )

    def first_flip(self, reset_voltage: float | None) -> Mirror:
        """Mirror that is released at time 0, by a reset voltage [V]; None: by the spring alone."""
        wave = self.mirror.waveform
        reset = {"reset_voltage": 0.0, "reset_time": 0.0}
        if reset_voltage is not None:
            signed = -reset_voltage if wave.bias_voltage < 0.0 else reset_voltage
            reset = {"reset_voltage": signed, "reset_time": wave.reset_time}
        wait = self.study.patience
        changed = evolve(wave, start_delay=0.0, flips=1, release_time=wait, period=1.0, **reset)
        return evolve(self.mirror, waveform=changed)
