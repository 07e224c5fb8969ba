"""Adhesion: the attraction of two surfaces across their gap, by a law of finite range."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from attrs import field, frozen

from ...validators import part
from ...validity import ValidityNumber
from .attraction_laws import AttractionLaw, TensionLaw
from .base import Array, AttractedContact, Attraction, Scalar, SolvedContact, effects_of
from .elasticity import contact_modulus

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import ContactScene
    from .base import Map

__all__ = ["Adhesion", "AdhesionPart"]

# A pixel is unstable by itself from 1 on. Pull-off of a sphere is 0.5 % off at 0.6, 9 % at 1.1.
_MOST_TRAPPING = 0.5
# Attraction of a rough map that hardly touches, over that of a grid so fine that it stays: up to
# 0.3 % off below 1, 1 % at 1.2, 2 to 3 % at 2 to 3, and 17 % at 5.6.
_MOST_STEP = 1.0
# The same fraction of 2 pi R w is attraction beyond the window, of an exponential law on a ball:
# its tension and its work fall alike over the gap.
_MOST_AT_EDGE = 0.05
_MOST_TENSION = 1e8  # over E*: the net pressure, a difference of tensions, keeps eight digits of E*


class AdhesionPart(NamedTuple):
    """Attraction in a solved contact.

    Attributes
    ----------
    tension : ndarray (ny, nx)
        Tension of the attraction [Pa]; in contact that of a closed gap. The pressure of the result
        is the net one: that of contact less this tension.
    is_contact : ndarray (ny, nx)
        Pixels in contact, where the pressure may be negative.
    contact_area, attracted_area : float
        Area in contact, and area in contact or apart by less than the range [m2].
    elastic_energy, adhesive_energy : float
        Energy of the elastic bodies, and of the attraction, zero far apart [J].
    tabor_parameter : float or None
        Tabor parameter of the map [-], with a radius of 2 over the rms Laplacian of the heights;
        None where nothing is attracted, or the heights are flat.
    trapping_number : float
        Steepest fall of the tension over the gap times the influence of a pixel on itself [-].
    step_over_range : float or None
        Pixel times rms slope over the range [-]; None where nothing is attracted.
    edge_tension : float
        Largest tension at the edge of an isolated window over the largest of the law [-].
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa].
    n_contacts : int
        Number of contacts that were solved for this state.
    """

    tension: Map
    is_contact: NDArray[np.bool_]
    contact_area: float
    attracted_area: float
    elastic_energy: float
    adhesive_energy: float
    tabor_parameter: float | None
    trapping_number: float
    step_over_range: float | None
    edge_tension: float
    self_influence: float
    n_contacts: int

    @property
    def energy(self) -> float:
        """Elastic and adhesive energy together [J]; a stable state is a minimum of it."""
        return self.elastic_energy + self.adhesive_energy


@frozen(kw_only=True)
class Adhesion(Attraction[AdhesionPart]):
    r"""Attraction of the surfaces across their gap, from JKR-like to DMT-like.

    .. math:: p = q - \tau(g), \qquad q \ge 0, \quad g \ge 0, \quad q \, g = 0

    A contact under adhesion may have several states. Without a `start` the solve finds that of
    an approach from far apart; from the result of a smaller gap it finds that of a separation.
    `contactkit.pull_off_curve` follows both.

    Parameters
    ----------
    law : AttractionLaw
        `ExponentialAttraction`, `DugdaleAttraction` or `LennardJonesAttraction`.

    Notes
    -----
    The branches of an isolated contact, of bodies on a rigid base, and of any contact under a load
    do not depend on the steps of the path, as a tension anywhere narrows every gap. At an imposed
    approach in a periodic window on half-spaces far pixels lift each other: long steps then may end
    in other states (by 37 % of the largest load at most, measured), which `pull_off_curve` halves
    until they do not.
    """

    takes_relaxation: ClassVar[bool] = True
    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "adhesion"
    summary: ClassVar[str] = "attraction of the surfaces across their gap"
    records: ClassVar[tuple[type, ...]] = (AdhesionPart,)
    arrays: ClassVar[tuple[Array, ...]] = (Array("tension", "Pa", attrgetter("tension")),)
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("attracted_area", "m2", attrgetter("attracted_area")),
        Scalar("elastic_energy", "J", attrgetter("elastic_energy")),
        Scalar("adhesive_energy", "J", attrgetter("adhesive_energy")),
        Scalar("tabor_parameter", "-", attrgetter("tabor_parameter")),
        Scalar("trapping_number", "-", attrgetter("trapping_number")),
    )

    law: AttractionLaw = field(validator=part(AttractionLaw))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            self.law.source,
            "convex-concave iteration on the tension: Yuille and Rangarajan 2003",
            "Tabor parameter: Tabor 1977; radius 2 over the rms Laplacian",
        )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        missing = [
            f"no {type(effect).__name__} beside it: where liquid fills the gap, the solids do not "
            "attract each other as they do across air; give the film by "
            "DugdaleAttraction.from_meniscus, or leave one of them out"
            for effect in effects_of(scene)
            if not effect.takes_tension
        ]
        highest = _MOST_TENSION * contact_modulus(scene)
        tension = self.law.work_of_adhesion / self.law.range
        if tension > highest:
            missing.append(
                f"a tension of at most {_MOST_TENSION:g} E* = {highest:.3g} Pa, and "
                f"work_of_adhesion/range is {tension:.3g} Pa: the net pressure would be round-off; "
                "check the units of range and work_of_adhesion"
            )
        return tuple(missing)

    def prepare(self, self_influence: float) -> TensionLaw:
        """See `Attraction.prepare`."""
        return self.law.on_grid(self_influence)

    def attracted_of(self, part: AdhesionPart) -> AttractedContact:
        """See `Attraction.attracted_of`."""
        return AttractedContact(part.tension, part.is_contact, part.self_influence, part.n_contacts)

    def observe_attracted(
        self, contact: SolvedContact, attracted: AttractedContact
    ) -> AdhesionPart:
        """See `Attraction.observe_attracted`."""
        import numpy as np

        law, area = self.prepare(attracted.self_influence), contact.grid.pixel_area
        near = attracted.touching | (contact.gap < law.reach)
        elastic = 0.5 * float(np.einsum("ij,ij->", contact.pressure, contact.displacement))
        tension = attracted.tension
        curvature, step = self._shape(contact, near)
        return AdhesionPart(
            tension=tension,
            is_contact=attracted.touching,
            contact_area=int(attracted.touching.sum()) * area,
            attracted_area=int(near.sum()) * area,
            elastic_energy=elastic * area,
            adhesive_energy=float(law.energy(contact.gap).sum()) * area,
            tabor_parameter=self._tabor(contact, curvature),
            trapping_number=law.steepest * attracted.self_influence,
            step_over_range=step,
            edge_tension=_largest_at_edges(tension, contact.grid.repeats) / law.strength,
            self_influence=attracted.self_influence,
            n_contacts=attracted.n_contacts,
        )

    def _shape(
        self, contact: SolvedContact, near: NDArray[np.bool_]
    ) -> tuple[float | None, float | None]:
        """Rms curvature [1/m], and step of a pixel over the range, around what is attracted."""
        from ...roughness.statistics import rms_curvature, rms_slope

        if not near.any():
            return None, None
        heights, periodic = contact.displacement - contact.gap, contact.grid.periodic
        if contact.bounded is not None:
            heights += contact.bounded.overlap
        if not periodic:  # beyond what is attracted the shape does not matter
            heights = heights[_around(near)]
        pixel = contact.grid.pixel_size
        curvature = rms_curvature(heights, pixel, periodic) if min(heights.shape) > 2 else None
        step = max(pixel) * rms_slope(heights, pixel, periodic) / self.law.range
        return curvature, step

    def _tabor(self, contact: SolvedContact, curvature: float | None) -> float | None:
        from ...adhesion.parameters import tabor_parameter

        if not curvature:
            return None
        radius, law = 1.0 / curvature, self.law
        modulus = contact_modulus(contact.scene)
        return float(tabor_parameter(radius, law.work_of_adhesion, modulus, law.range))

    def validity(self, contact: SolvedContact, part: AdhesionPart) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        cure = self.law.cure_of_trapping(part.trapping_number, _MOST_TRAPPING)
        found = [
            ValidityNumber(
                name="trapping number of the attraction",
                value=part.trapping_number,
                high=_MOST_TRAPPING,
                detail="above, the edge of a contact hangs on single pixels and the hysteresis is "
                f"that of the grid; use a finer Accuracy.grid, or {cure}",
                source="max|dtension/dgap| x influence of a pixel on itself; measured",
            ),
            ValidityNumber(
                name="step of a pixel over the range",
                value=part.step_over_range,
                high=_MOST_STEP,
                detail="nothing is attracted"
                if part.step_over_range is None
                else "above, the gap beside a contact passes the range within a pixel; use a finer "
                "Accuracy.grid, or a longer range",
                source="pixel x rms slope/range; measured",
            ),
        ]
        if not contact.grid.periodic:
            found.append(
                ValidityNumber(
                    name="tension at the edge of the window",
                    value=part.edge_tension,
                    high=_MOST_AT_EDGE,
                    detail="over the largest tension; the attraction beyond the window is left "
                    "out: widen the window",
                )
            )
        return tuple(found)


def _largest_at_edges(tension: Map, repeats: tuple[bool, bool]) -> float:
    """Largest tension [Pa] at the edges beyond which nothing repeats."""
    lines = zip((tension, tension.T), repeats, strict=True)
    edges = [across[[0, -1]] for across, does_repeat in lines if not does_repeat]
    return max((float(edge.max()) for edge in edges), default=0.0)


def _around(near: NDArray[np.bool_]) -> tuple[slice, slice]:
    """Rectangle of some pixels, with two lines of pixels around it."""
    import numpy as np

    lines = (np.flatnonzero(near.any(axis=axis)) for axis in (1, 0))
    rows, columns = (slice(max(int(at[0]) - 2, 0), int(at[-1]) + 3) for at in lines)
    return rows, columns
