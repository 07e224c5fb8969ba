"""Loading history of plasticity: loads before the load of the scene, with a residual shape."""

from __future__ import annotations

import itertools
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from attrs import Attribute, field, frozen

from ...units import si
from ...validators import as_tuple, as_whole, count, non_negative
from ...validity import ValidityNumber
from .base import Array, LoadHistory, PressureBound, Scalar, SolvedContact, listed_loadings
from .plasticity import MOST_PLASTIC

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.loading import ContactLoading
    from ...scene.scenes import ContactScene

    Floats = NDArray[np.float64]
    Map = NDArray[np.float64]

_CURVES = (
    ("load", "N"),
    ("approach", "m"),
    ("contact_area", "m2"),
    ("plastic_area", "m2"),
    ("elastic_energy", "J"),
    ("plastic_work", "J"),
    ("external_work", "J"),
    ("residual_volume", "m3"),
    ("hardness", "Pa"),
)

__all__ = ["PlasticHistory", "PlasticHistoryPart"]

# Of the work of the load. A ball that is pressed in and unloaded has 0.075 with two steps to each
# load, 0.027 with four, 0.009 with eight: what the trapezoidal rule leaves, more steps cure.
_HIGHEST_IMBALANCE = 0.1


class PlasticHistoryPart(NamedTuple):
    """States of a loading history, from first touch on, and the shape that it leaves.

    Arrays (n,) hold one value for each state, of which the first is the undeformed contact at
    first touch and the last the contact of the scene's loading.
    """

    load: Floats
    """Normal force [N]."""
    approach: Floats
    """Rigid-body approach from first touch of the undeformed surfaces [m]."""
    contact_area: Floats
    """Real area of contact [m2], as a count of pixels under pressure."""
    plastic_area: Floats
    """Area that is at the hardness [m2]; zero while unloading."""
    elastic_energy: Floats
    """Elastic energy of the bodies [J], recovered on unloading."""
    plastic_work: Floats
    """Work dissipated by plastic flow so far [J]: hardness times the plastic volume."""
    external_work: Floats
    """Work of the load so far [J], by the trapezoidal rule over the states."""
    residual_volume: Floats
    """Plastic volume so far [m3]."""
    hardness: Floats
    """Hardness [Pa]; the mean over the window of one that differs between pixels."""
    residual_depth: Map
    """Depth (ny, nx) by which the surfaces have been deformed plastically [m]: the heights less
    it are the shape without load, which has no residual stress in this model."""

    @property
    def cycle_losses(self) -> tuple[float, ...]:
        """Hysteresis loss [J] of each closed cycle: from a minimum of the load to the next."""
        ends = _minima(self.load)
        return tuple(float(self.plastic_work[b] - self.plastic_work[a]) for a, b in ends)

    @property
    def work_error(self) -> float:
        """Imbalance of work and energy over the work of the load [-]: the trapezoids' error."""
        work = float(abs(self.external_work).max())
        left = self.external_work - self.elastic_energy - self.plastic_work
        return float(abs(left).max()) / work if work > 0.0 else 0.0


def _minima(load: Floats) -> list[tuple[int, int]]:
    """Pairs of states between which the load rises and falls back."""
    ends, is_falling = [0], False
    for i in range(1, len(load)):
        if load[i] > load[i - 1] and is_falling:
            ends.append(i - 1)
        if load[i] != load[i - 1]:
            is_falling = bool(load[i] < load[i - 1])
    return list(itertools.pairwise([*ends, len(load) - 1] if is_falling else ends))


def _loads(owner: Any, attribute: Attribute[Any], value: Any) -> None:
    for one in value:
        non_negative(owner, attribute, one)


def _plastic_fraction(part: PlasticHistoryPart) -> float | None:
    touching = part.contact_area > 0.0
    if not touching.any():
        return None
    return float((part.plastic_area[touching] / part.contact_area[touching]).max())


@frozen(kw_only=True)
class PlasticHistory(LoadHistory[PlasticHistoryPart]):
    r"""Loads that a plastic contact has carried before the load of the scene, up and down.

    The surfaces are deformed step by step: where the pressure reaches the hardness, the overlap of
    the elastic surfaces is added to a residual depth :math:`w_p`, and the next step presses the
    heights less it. Below the largest load so far the contact is elastic, so that reloading
    dissipates nothing and meets the loading curve where it was left:

    .. math:: \int P\,d\delta = \tfrac12 \int p\,u\,dA + \int H\,dw_p\,dA

    Parameters
    ----------
    pressures : tuple of float
        Mean pressures over the window [Pa], in this order, each followed by the next and the last
        by the loading of the scene; between them lies a straight path.
    forces : tuple of float
        The same as normal forces [N].
    approaches : tuple of float
        The same as approaches from first touch of the undeformed surfaces [m], where the scene
        imposes an approach.
    steps : int
        Number of equal steps from each of these to the next. The states do not depend on it for a
        constant hardness; the work of the load has the error of the trapezoidal rule (0.06 % for
        40 steps of a sphere).

    Notes
    -----
    Needs a `HardnessLimit` beside it. A hardness that depends on depth is that of the greatest
    displacement so far, so that unloading does not change it; the residual depth is not added to
    the displacement, as a second loading to the same load would then flow again. Left out:
    pile-up, residual stress, hardening, reverse flow, time. After unloading the surfaces conform
    over the area that was plastic, so that a gap may be zero without pressure: contact is where
    there is pressure.
    """

    takes_holes: ClassVar[bool] = True
    has_gradient: ClassVar[bool] = True
    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "plastic-history"
    summary: ClassVar[str] = "loads before, whose plastic deformation stays"
    figures: ClassVar[tuple[str, ...]] = ("force_approach", "residual_depth")
    records: ClassVar[tuple[type, ...]] = (PlasticHistoryPart,)
    arrays: ClassVar[tuple[Array, ...]] = (
        Array("residual_depth", "m", attrgetter("residual_depth")),
        *(Array(f"history_{name}", unit, attrgetter(name), ("state",)) for name, unit in _CURVES),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("plastic_work", "J", lambda part: float(part.plastic_work[-1])),
        Scalar("elastic_energy", "J", lambda part: float(part.elastic_energy[-1])),
        Scalar("residual_volume", "m3", lambda part: float(part.residual_volume[-1])),
        Scalar("max_residual_depth", "m", lambda part: float(part.residual_depth.max())),
    )

    pressures: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_loads, metadata=si("Pa")
    )
    forces: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_loads, metadata=si("N")
    )
    approaches: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_loads, metadata=si("m")
    )
    steps: int = field(default=8, converter=as_whole, validator=count, metadata=si("-"))

    sources = ("elastic-perfectly plastic contact with residual heights, own formulation",)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        missing = []
        if not any(isinstance(effect, PressureBound) for effect in scene.effects):
            missing.append("HardnessLimit() beside it: without a hardness nothing deforms for good")
        given = [bool(one) for one in (self.pressures, self.forces, self.approaches)]
        if sum(given) != 1:
            missing.append("exactly one of pressures [Pa], forces [N] and approaches [m]")
        elif self.approaches and scene.loading.imposed_approach is None:
            missing.append("loading = Approach(...) with approaches, or pressures or forces")
        elif not self.approaches and scene.loading.imposed_approach is not None:
            missing.append("loading = Pressing(...) with pressures or forces, or approaches")
        return tuple(missing)

    def loadings(self) -> tuple[ContactLoading, ...]:
        """See `LoadHistory.loadings`."""
        return listed_loadings(self.pressures, self.forces, self.approaches)

    def observe(self, contact: SolvedContact) -> None:
        """See `ContactEffect.observe`: the part is made with the solve itself."""

    def validity(
        self, contact: SolvedContact, part: PlasticHistoryPart
    ) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        is_shared = contact.attracted is not None or contact.frictional is not None
        return (
            ValidityNumber(
                name="fraction of the contact at the hardness, over its history",
                value=_plastic_fraction(part),
                high=MOST_PLASTIC,
                detail="the volume that plastic flow displaces is left out, and elasticity carries "
                "the rest of the load; lower the loads, or take the area as load over hardness",
            ),
            ValidityNumber(
                name="imbalance of work and energy over the loading history",
                value=None if is_shared else part.work_error,
                high=_HIGHEST_IMBALANCE,
                detail="adhesion or friction takes a part of the work that is not counted"
                if is_shared
                else "error of external_work by the trapezoidal rule, over the work of the load; "
                "the states are not affected; use more steps",
            ),
        )
