"""Result of a separation of deforming bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from attrs import field, frozen

from ...errors import NotSimulatedError
from ...lubrication.elastohydrodynamic.motion import SmoothGap
from ...scene.scales import Scale, Scales, scales_of
from ...validity import ValidityNumber
from ..curve_result import CurveResult, Work
from .plan import DeformingPlan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

__all__ = ["MAPS", "SECTIONS", "DeformingResult", "Maps", "Section"]

SECTIONS = {
    "radius": "m",
    "gap": "m",
    "film_pressure": "Pa",
    "solid_pressure": "Pa",
    "liquid": "-",
}
"""Fields of a section and their units."""


MAPS = {"gap": "m", "film_pressure": "Pa", "solid_pressure": "Pa", "liquid": "-"}
"""Maps of a film on a map, and their units."""


class Section(NamedTuple):
    """Section through the film at a time [s]: arrays over the rings, of a map along x.

    Radii [m], of a map x from the axis; gaps [m], pressures of film and solids over ambient [Pa],
    part of the gap that is full of liquid [-].
    """

    time: float
    radius: Any
    gap: Any
    film_pressure: Any
    solid_pressure: Any
    liquid: Any


class Maps(NamedTuple):
    """Maps of a film at a time [s], arrays (ny, nx) over the cells at x and y [m].

    Gap [m], pressures of film and solids over ambient [Pa], part of the gap that is full of liquid
    [-]; all 0 where `inside` has no film.
    """

    time: float
    x: Any
    y: Any
    inside: Any
    gap: Any
    film_pressure: Any
    solid_pressure: Any
    liquid: Any


@frozen(eq=False)
class DeformingResult(CurveResult):
    """Curves, sections and numbers of a separation of deforming bodies.

    Attributes
    ----------
    plan : DeformingPlan
        What was run.
    status : str
        ``released`` or ``time limit``.
    message : str
        The same as a sentence.
    columns : mapping of str to ndarray
        Curves over ``time``, read-only.
    sections : mapping of str to ndarray
        `SECTIONS` at each time, (n_times, n_rings); `section` gives those of one time. Of a map
        along the row of cells through the axis.
    fields : mapping of str to ndarray
        Of a map, `MAPS` at some of the times, (n_maps, ny, nx) in single precision, and these times
        as ``time``; `maps` gives those of one time. Empty of rings.
    numbers : mapping of str to float
        Numbers of `scalars` by their names; nan for events that did not occur.
    validity : tuple of ValidityNumber
        Whether the models were inside their ranges.
    work : Work
        What it cost, of the finest mesh.
    """

    cure: ClassVar[str] = "see result.columns"

    plan: DeformingPlan = field(repr=False)
    status: str
    message: str
    columns: Mapping[str, Curve] = field(repr=False)
    sections: Mapping[str, Curve] = field(repr=False)
    fields: Mapping[str, NDArray[Any]] = field(repr=False)
    numbers: Mapping[str, float] = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    work: Work

    @property
    def gap(self) -> Curve:
        """Gap of the undeformed bodies [m]."""
        return self["gap"]

    @property
    def pull(self) -> Curve:
        """Pull [N]; negative while the bodies are pressed."""
        return self["pull"]

    @property
    def error(self) -> float:
        """Estimated error of the pull over its largest value [-]."""
        return self.numbers["force_error"]

    @property
    def lines(self) -> str:
        """See `CurveResult.lines`."""
        if not self.fields:
            return f"points are right to {self.error:.1g} of the largest pull, by three meshes"
        return (
            f"points are right to {self.error:.1g} of the largest pull, or gap, by a second run on "
            "half the cells in each direction and with twice the steps"
        )

    def section(self, time: float) -> Section:
        """Section through the film at the point of the curves next to a time [s]."""
        known = self["time"]
        k = int(abs(known - time).argmin())
        return Section(float(known[k]), *(self.sections[name][k] for name in SECTIONS))

    def maps(self, time: float) -> Maps:
        """Maps of the film at the kept time next to a time [s].

        Raises
        ------
        NotSimulatedError
            If the film was solved on rings: it has sections.
        """
        film = self.plan.film
        if isinstance(film, SmoothGap):
            raise NotSimulatedError(
                "no maps: the film of smooth round bodies is solved on rings; see result.section"
            )
        known = self.fields["time"]
        k = int(abs(known - time).argmin())
        x, y, inside = film.places
        return Maps(float(known[k]), x, y, inside, *(self.fields[name][k] for name in MAPS))

    def of(self, kind: Any) -> Any:
        """Return the effect of a kind, which shows in the curves; refuse one that is not listed."""
        return self.plan.listed(kind)

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        return {name: (value, _UNITS[name]) for name, value in self.numbers.items()}

    @property
    def scales(self) -> Scales:
        """Initial gap, the force of rigid bodies at the start, and the time of the pull."""
        film, force = self.plan.film, self.plan.rigid_force
        return scales_of(
            {
                "m": Scale(film.gap, "h0", "initial gap"),
                "N": Scale(force, "F0", "force of rigid bodies pulled from the initial gap"),
                "J": Scale(force * film.gap, "F0 h0", "force of rigid bodies times the gap"),
            }
        )


_UNITS = {
    "pull_off_force": "N",
    "pull_off_time": "s",
    "snap_off_time": "s",
    "release_time": "s",
    "smallest_gap": "m",
    "work_of_separation": "J",
    "hysteresis_loss": "J",
    "largest_contact_force": "N",
    "largest_tension": "Pa",
    "trapped_volume": "m3",
    "rupture_time": "s",
    "force_over_rigid": "-",
    "beta": "-",
    "force_error": "-",
    "energy_error": "-",
    "liquid_error": "-",
}
