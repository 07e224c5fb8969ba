"""Viscoelastic materials: a modulus that relaxes over time, by a Prony series."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Attribute, field, frozen

from ...errors import DescriptionError, PlanError
from ...units import si
from ...validators import as_tuple, positive, refuse
from ...validity import ValidityNumber, warn
from ..materials import Material, needs_time

if TYPE_CHECKING:
    from ...elasticity.prony import PronySeries
    from ...elasticity.transverse_isotropy import PlaneConstants

__all__ = ["ViscoelasticMaterial"]

# Most tables with columns in another order are missed by 0.45 and more; noise of a tenth by up to
# 0.12, a spectrum of one line between the times of the series by up to 0.05.
_LARGEST_MISFIT = 0.15


def _ascending(owner: Any, attribute: Attribute[Any], value: Any) -> None:
    for one in value:
        positive(owner, attribute, one)
    if not value or list(value) != sorted(set(value)):
        raise refuse(owner, attribute, value, "be times in ascending order, at least one")


def _leave_some(owner: Any, attribute: Attribute[Any], value: Any) -> None:
    for one in value:
        positive(owner, attribute, one)
    if math.fsum(value) >= 1.0:
        raise refuse(
            owner,
            attribute,
            value,
            "add up to less than 1",
            "the rest is the modulus at equilibrium; a liquid, which has none, is not supported",
        )


@frozen(kw_only=True)
class ViscoelasticMaterial(Material):
    r"""An isotropic, linear viscoelastic material of constant Poisson's ratio.

    .. math:: E(t) = E_0 \left(1 - \sum_i g_i \left(1 - e^{-t/\tau_i}\right)\right)

    Contacts take it with `Viscoelasticity` among their effects; everything else refuses it, as one
    elastic modulus would be a guess: `instantaneous` and `equilibrium` are its elastic limits.

    Parameters
    ----------
    name : str
        What it is, for tables and figures.
    young_modulus : float
        Instantaneous Young's modulus E_0 [Pa].
    fractions : tuple of float
        Fractions g_i of it that relax [-], positive, together below 1.
    times : tuple of float
        Their relaxation times [s], ascending.
    poisson_ratio : float
        Poisson's ratio [-], the same at all times: right for rubber, which stays nearly
        incompressible; a polymer that passes its glass transition goes from 0.35 to 0.5.
    hardness : float, optional
        Indentation hardness [Pa]; see `Material`.
    source : str
        Where the numbers come from, and their spread.

    Examples
    --------
    >>> rubber = ViscoelasticMaterial(
    ...     name="rubber", young_modulus=4e6, fractions=0.75, times=2.0, poisson_ratio=0.5)
    >>> rubber.equilibrium.young_modulus, rubber.at_rate(0.5).young_modulus
    (1000000.0, 2500000.0)
    """

    kind: ClassVar[str] = "viscoelastic"

    fractions: tuple[float, ...] = field(
        converter=as_tuple, validator=_leave_some, metadata=si("-")
    )
    times: tuple[float, ...] = field(converter=as_tuple, validator=_ascending, metadata=si("s"))

    def __attrs_post_init__(self) -> None:
        if len(self.fractions) != len(self.times):
            raise DescriptionError(
                "ViscoelasticMaterial.times",
                self.times,
                f"be as many as the {len(self.fractions)} fractions",
                unit="s",
            )

    @property
    def relaxation(self) -> PronySeries:
        """Relaxation modulus E(t) as a Prony series of moduli [Pa]."""
        from ...elasticity.prony import PronySeries

        moduli = [self.young_modulus * one for one in self.fractions]
        rest = self.young_modulus * math.fsum((1.0, *(-one for one in self.fractions)))
        return PronySeries(rest, moduli, self.times)

    def at_rate(self, rate: float) -> Material:
        """Elastic material of the modulus ``s`` times the Laplace transform of E(t), s the rate.

        Parameters
        ----------
        rate : float
            Real rate s [1/s]: 0 at equilibrium, inf at once.
        """
        from ...elasticity.prony import modulus_at_rate

        return Material(
            name=self.name,
            young_modulus=float(modulus_at_rate(self.relaxation, rate)),
            poisson_ratio=self.poisson_ratio,
            hardness=self.hardness,
            source=self.source,
        )

    @property
    def instantaneous(self) -> Material:
        """Elastic material of fast loading, of Young's modulus E_0."""
        return self.at_rate(math.inf)

    @property
    def equilibrium(self) -> Material:
        """Elastic material of slow loading, after all relaxation."""
        return self.at_rate(0.0)

    @property
    def plane_strain_modulus(self) -> float:
        """Refused, as it depends on time: see `instantaneous` and `equilibrium`."""
        raise PlanError(needs_time(self))

    @property
    def plane_constants(self) -> PlaneConstants:
        """Refused, as they depend on time."""
        raise PlanError(needs_time(self))

    @classmethod
    def from_series(cls, series: PronySeries, **given: Any) -> ViscoelasticMaterial:
        """Material of a relaxation modulus as a Prony series of moduli.

        Parameters
        ----------
        series : PronySeries
            Equilibrium modulus [Pa], moduli [Pa] and relaxation times [s], in tension
            (``E = 2 G (1 + nu)`` of those in shear).
        **given
            Other fields, at least `poisson_ratio`.

        Examples
        --------
        >>> from contactkit.elasticity.prony import PronySeries
        >>> made = ViscoelasticMaterial.from_series(
        ...     PronySeries(1e6, [3e6], [2.0]), poisson_ratio=0.5)
        >>> made.young_modulus, made.fractions
        (4000000.0, (0.75,))
        """
        moduli = [float(one) for one in as_tuple(series.moduli)]
        total = series.equilibrium + math.fsum(moduli)
        fractions = tuple(one / total for one in moduli)
        times = tuple(float(one) for one in as_tuple(series.times))
        return cls(young_modulus=total, fractions=fractions, times=times, **given)

    @classmethod
    def from_table(
        cls,
        frequency: Sequence[float],
        storage: Sequence[float],
        loss: Sequence[float],
        terms_per_decade: float = 2.0,
        **given: Any,
    ) -> ViscoelasticMaterial:
        """Material of measured storage and loss moduli, by `elasticity.prony.fit_prony`.

        The error of the fit is stated in `source`, over the absolute modulus; a `ValidityWarning`
        is issued where its root mean square exceeds 0.15.

        Parameters
        ----------
        frequency : array_like, shape (m,)
            Angular frequencies [rad/s]: 2 pi times those in hertz.
        storage, loss : array_like, shape (m,)
            Storage and loss moduli in tension [Pa], of a rubber three times those in shear;
            numbers, or texts such as ``"1.2 MPa"``.
        terms_per_decade : float
            Relaxation times to a decade of frequency [-].
        **given
            Other fields, at least `poisson_ratio`.

        Raises
        ------
        DescriptionError
            If the table has no equilibrium modulus, or holds what is not positive.

        Examples
        --------
        >>> omega, storage, loss = [0.1, 1.0, 10.0], [1.1e6, 1.6e6, 2.1e6], [2e5, 5e5, 2e5]
        >>> made = ViscoelasticMaterial.from_table(
        ...     omega, storage, loss, name="gel", poisson_ratio=0.5)
        >>> made.source
        'Prony series of 3 terms, fitted to 3 points: rms error 1.66%, largest 2.19%'
        """
        from ...elasticity.prony import fit_prony

        fit = fit_prony(frequency, storage, loss, terms_per_decade)
        error = (
            f"Prony series of {len(as_tuple(fit.series.times))} terms, fitted to {len(frequency)} "
            f"points: rms error {fit.error:.2%}, largest {fit.largest_error:.2%}"
        )
        missed = ValidityNumber(
            name="rms error of the Prony series over the modulus",
            value=fit.error,
            high=_LARGEST_MISFIT,
            detail="no relaxing solid has this table, or it has too few points to a decade; the "
            "order is frequency [rad/s], storage, loss [Pa]",
        )
        warn([missed])
        source = "; ".join(one for one in (given.pop("source", ""), error) if one)
        return cls.from_series(fit.series, source=source, **given)
