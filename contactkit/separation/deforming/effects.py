"""Effects of bodies that deform while a film is between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Attribute, field, frozen

from ...units import nm, si
from ...validators import positive, refuse
from ..effects.base import CoupledEffect

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene

__all__ = ["ElasticBodies", "SolidContact"]

# Below it a liquid has no viscosity of its own, and no asperity is so low: an atom.
_ATOM = 0.2 * nm


@frozen(kw_only=True)
class ElasticBodies(CoupledEffect):
    r"""Bodies that the pressures of film, meniscus and contact deform elastically.

    The film, the deformation of both solids and the motion are solved together: on rings if both
    bodies are smooth and round, a sphere, a paraboloid or a flat disc against a flat, and else on a
    map, of faces of any outline with rough or measured surfaces. Half-spaces, layers on a
    substrate, layers on a rigid base. A meniscus of given volume or pressure takes rings and
    half-spaces.

    Notes
    -----
    It matters where :math:`\beta = \eta v R^{3/2}/(E^* h^{5/2})`, printed with a plan, exceeds
    about 1e-3; at 1 the largest force of a pull is 0.37 of that of rigid bodies. On rings forces
    are right to 1e-4 of their largest, with cavities and contacts 1e-3; on 128 x 128 cells of a map
    to some 1e-2, by the square of a cell; a result states its own error. Small strains: pressures
    up to a tenth of E*.
    """

    name: ClassVar[str] = "elastic-bodies"
    summary: ClassVar[str] = "the bodies deform under the pressure of film, meniscus and contact"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "Davis, Serayssol and Hinch 1986: film and elastic sphere together",
            "Johnson 1985, Eq. 3.29: displacement under rings of pressure",
        )

    @property
    def takes_solids(self) -> bool:
        """See `SeparationEffect.takes_solids`."""
        return True

    def reads(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.reads`: elements, or cells, by the tolerance; those of a map may be given."""
        return ("film_rtol", "grid")


@frozen(kw_only=True)
class SolidContact(CoupledEffect):
    """Asperities that carry the bodies where their gap falls to a cut-off.

    Where they touch, the liquid between the asperities still flows as a film of that gap, so that a
    contact under liquid fills and drains. Without it smooth bodies with liquid between them never
    touch: how soon and how much they do is a statement on the cut-off.

    Parameters
    ----------
    cutoff : float
        Gap at which the asperities touch [m]: about three times their rms height.
    """

    name: ClassVar[str] = "solid-contact"
    summary: ClassVar[str] = "asperities carry the bodies at a cut-off gap"

    cutoff: float = field(validator=positive, metadata=si("m"))

    @cutoff.validator
    def _of_an_atom(self, attribute: Attribute[Any], value: float) -> None:
        if value < _ATOM:
            raise refuse(self, attribute, value, "be 2e-10 m at least, the size of an atom")

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("hard contact without friction at a cut-off gap; Johnson 1985, section 13",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        if scene.effect(ElasticBodies) is None:
            return ("ElasticBodies() beside it: rigid bodies have ImposedForce(rest_gap=...)",)
        return ()
