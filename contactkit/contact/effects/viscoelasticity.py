"""Viscoelasticity: loads of a contact over time, on bodies whose moduli relax."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from attrs import Attribute, field, frozen

from ...units import si
from ...validators import as_tuple, as_whole, count, finite, non_negative, refuse
from ...validity import ValidityNumber
from .base import Array, Attraction, LoadHistory, Scalar, SolvedContact, listed_loadings

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.loading import ContactLoading
    from ...scene.scenes import ContactScene

    Floats = NDArray[np.float64]

_CURVES = (
    ("time", "s"),
    ("load", "N"),
    ("approach", "m"),
    ("contact_area", "m2"),
    ("max_pressure", "Pa"),
    ("elastic_energy", "J"),
    ("dissipated_energy", "J"),
    ("external_work", "J"),
)

__all__ = ["Viscoelasticity", "ViscoelasticityPart"]

# Of the work of the loads. The steps of the tests have 0.002 to 0.04; a path of one step to each
# load has 0.1 and more, with an area 3 % off.
_HIGHEST_IMBALANCE = 0.05


class ViscoelasticityPart(NamedTuple):
    """States of a viscoelastic contact, from first touch on; arrays (n,), one value for each.

    The first is the undeformed contact at first touch, the last the contact of the scene's loading.
    """

    time: Floats
    """Time from the beginning [s]; two states at one time are the sides of a jump of the load."""
    load: Floats
    """Normal force [N]."""
    approach: Floats
    """Rigid-body approach from first touch of the undeformed surfaces [m]."""
    contact_area: Floats
    """Real area of contact [m2], as a count of pixels."""
    max_pressure: Floats
    """Maximum of the pressure [Pa]."""
    elastic_energy: Floats
    """Elastic energy of the bodies [J], of which a part is recovered on unloading."""
    dissipated_energy: Floats
    """Energy that the bodies have dissipated so far [J]."""
    external_work: Floats
    """Work of the load so far [J], by the trapezoidal rule over the states; over a jump of the load
    the change of the elastic energy, which is exact without `Adhesion`."""
    pressures: Floats
    """Pressure [Pa] at each of `Viscoelasticity.maps_at`, (m, ny, nx)."""

    @property
    def work_error(self) -> float:
        """Imbalance of work and energy over the work of the load [-]: the error of the steps."""
        work = float(abs(self.external_work).max())
        left = self.external_work - self.elastic_energy - self.dissipated_energy
        return float(abs(left).max()) / work if work > 0.0 else 0.0


def _each_finite(owner: Any, attribute: Attribute[Any], value: Any) -> None:
    for one in value:
        finite(owner, attribute, one)


def _in_order(owner: Any, attribute: Attribute[Any], value: Any) -> None:
    for one in value:
        non_negative(owner, attribute, one)
    if not value or list(value) != sorted(value):
        raise refuse(owner, attribute, value, "be times in order, at least one")


@frozen(kw_only=True)
class Viscoelasticity(LoadHistory[ViscoelasticityPart]):
    r"""Loads of a contact over time, on bodies of `ViscoelasticMaterial`, alone or in layers.

    The bodies are undeformed until the time 0. Without loads that of the scene is applied at once
    and held (creep, or relaxation at an imposed approach); otherwise the path is straight from
    nothing through each load at its time to that of the scene at the last time:

    .. math:: \hat u(q, t) = \int_0^t \hat C(q, t - t')\, \dot{\hat p}(q, t')\, dt'

    with the compliance of the layers from their moduli in the Laplace transform. Each step is the
    elastic contact problem of the solver, whatever else the scene lists, with the compliance over a
    step of linear pressure, on heights less what the history displaces.

    Parameters
    ----------
    times : tuple of float
        Times [s] of the loads, in order, the last that of the loading of the scene. Of equal times
        the load jumps; a first time of 0 is a jump at the start. Without loads the states of a
        held load to be solved.
    pressures : tuple of float
        Mean pressures over the window [Pa] at all times but the last.
    forces : tuple of float
        The same as normal forces [N].
    approaches : tuple of float
        The same as approaches from first touch of the undeformed surfaces [m], where the scene
        imposes an approach.
    steps : int
        Equal steps from each time to the next; the error falls with their square, at the edge of a
        growing contact with their power 1.5.
    maps_at : tuple of float
        Times, some of `times`, of which the maps of the pressure are kept.

    Notes
    -----
    Contact area and pressure may rise and fall at any time. Homogeneous bodies have the exact
    retardation times of their material; layers that relax differently have common ones, which meet
    both elastic limits exactly, and times in between to 1e-5 of the creep. Steps much longer than
    the relaxation times swing at a held approach, and dissipate too much: `work_error` shows it,
    and times equally spaced in their logarithm avoid it. Beside `Adhesion` the
    loss of the solids makes the pull-off depend on the speed. Left out: a Poisson's ratio that
    changes with time, nonlinear and plastic flow, heat, inertia.
    """

    takes_holes: ClassVar[bool] = True
    takes_relaxation: ClassVar[bool] = True
    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "viscoelasticity"
    summary: ClassVar[str] = "loads over time, on bodies whose moduli relax"
    figures: ClassVar[tuple[str, ...]] = ("time_curves", "load_loop")
    records: ClassVar[tuple[type, ...]] = (ViscoelasticityPart,)
    arrays: ClassVar[tuple[Array, ...]] = (
        *(Array(f"history_{name}", unit, attrgetter(name), ("state",)) for name, unit in _CURVES),
        Array(
            "history_pressure",
            "Pa",
            lambda part: part.pressures if len(part.pressures) else None,
            ("map", "y", "x"),
        ),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("time", "s", lambda part: float(part.time[-1])),
        Scalar("elastic_energy", "J", lambda part: float(part.elastic_energy[-1])),
        Scalar("dissipated_energy", "J", lambda part: float(part.dissipated_energy[-1])),
        Scalar("external_work", "J", lambda part: float(part.external_work[-1])),
    )

    times: tuple[float, ...] = field(converter=as_tuple, validator=_in_order, metadata=si("s"))
    pressures: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_each_finite, metadata=si("Pa")
    )
    forces: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_each_finite, metadata=si("N")
    )
    approaches: tuple[float, ...] = field(
        default=(), converter=as_tuple, validator=_each_finite, metadata=si("m")
    )
    steps: int = field(default=8, converter=as_whole, validator=count, metadata=si("-"))
    maps_at: tuple[float, ...] = field(default=(), converter=as_tuple, metadata=si("s"))

    sources = (
        "elastic-viscoelastic correspondence: Lee 1955; contact: Lee and Radok 1960, Ting 1966",
        "recursive convolution of a Prony series, pressure linear in a step: own formulation",
    )

    @maps_at.validator
    def _among_times(self, attribute: Attribute[Any], value: tuple[Any, ...]) -> None:
        if not set(value) <= set(self.times):
            raise refuse(self, attribute, value, "be some of times")

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        missing, held = [], scene.loading.imposed_approach is not None
        if not any(stack.relaxes for stack in scene.interface.stacks):
            missing.append("a ViscoelasticMaterial in a body: elastic ones do not depend on time")
        given = [one for one in (self.pressures, self.forces, self.approaches) if one]
        if len(given) > 1:
            missing.append("at most one of pressures [Pa], forces [N] and approaches [m]")
        elif given and len(given[0]) != len(self.times) - 1:
            missing.append(
                f"a load at each of the {len(self.times)} times but the last, which is that of the "
                f"loading of the scene, got {len(given[0])}"
            )
        elif given and bool(self.approaches) != held:
            kind = "Pressing(...)" if held else "Approach(...)"
            loads = "pressures or forces" if held else "approaches"
            missing.append(f"loading = {kind} with {loads}")
        return tuple(missing)

    def loadings(self) -> tuple[ContactLoading, ...]:
        """See `LoadHistory.loadings`."""
        return listed_loadings(self.pressures, self.forces, self.approaches)

    def observe(self, contact: SolvedContact) -> None:
        """See `ContactEffect.observe`: the part is made with the solve itself."""

    def validity(
        self, contact: SolvedContact, part: ViscoelasticityPart
    ) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        is_shared = contact.scene.effect(Attraction) is not None
        return (
            ValidityNumber(
                name="imbalance of work and energy over the loads in time",
                value=None if is_shared or math.isnan(part.work_error) else part.work_error,
                high=_HIGHEST_IMBALANCE,
                detail="adhesion takes a part of the work that is not counted"
                if is_shared
                else "error of the time steps, over the work of the load; use more steps",
            ),
        )
