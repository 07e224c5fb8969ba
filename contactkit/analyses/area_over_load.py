"""Real area of contact over the load, beside the theories of rough contact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from attrs import field, frozen

from ..contact.effects.base import Attraction
from ..contact.effects.elasticity import HalfSpace
from ..contact.result import ContactResult
from ..errors import DescriptionError
from ..frozen import FrozenDict
from ..roughness import contact_theories
from ..roughness.contact_theories import RANGES, Range, in_range
from ..roughness.statistics import Summits, SurfaceStatistics, summits, surface_statistics
from ..scene.curve import Curve, Shown
from ..units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["AreaOverLoad", "area_over_load"]


_SOURCES = {
    "Persson": "Persson 2001",
    "Bush, Gibson and Thomas": "Bush, Gibson and Thomas 1975",
    "Greenwood and Williamson": "Greenwood and Williamson 1966",
}


@frozen(eq=False, kw_only=True)
class AreaOverLoad(Curve):
    """Solved contacts of one surface under several loads, and what theories give for them.

    Attributes
    ----------
    mean_pressure : ndarray, shape (n,)
        Mean pressures [Pa], ascending.
    counted : ndarray, shape (n,)
        Fractions of the window in contact [-], as pixel counts.
    corrected : ndarray, shape (n,)
        The same, edge-corrected [-] (`ContactResult.corrected_contact_area`).
    theories : mapping of str to ndarray (n,)
        Fractions [-] by the names of `ranges`, at the same pressures, also outside of them; nan
        where a theory gives more than 1, which is no fraction. Columns of their names in small
        letters, such as ``persson``.
    contact_modulus : float
        Contact modulus E* [Pa].
    statistics : SurfaceStatistics
        Statistics of the heights of both bodies together.
    summits : Summits
        Their summits.
    """

    axis: ClassVar[str] = "mean_pressure"
    title: ClassVar[str] = "area of contact over the load"

    mean_pressure: Floats = field(repr=False, metadata=si("Pa"))
    counted: Floats = field(repr=False, metadata=si("-"))
    corrected: Floats = field(repr=False, metadata=si("-"))
    theories: Mapping[str, Floats] = field(repr=False)
    contact_modulus: float = field(metadata=si("Pa"))
    statistics: SurfaceStatistics = field(repr=False)
    summits: Summits = field(repr=False)

    @property
    def shown(self) -> Shown:
        """See `Curve.shown`."""
        return {"area": (("counted", "corrected", *map(_column, self.theories)), "")}

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`: those of the theories; the fit is contactkit's own."""
        return tuple(_SOURCES[name] for name in self.theories if name in _SOURCES)

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the columns by name, each with its unit."""
        return super().table() | {_column(n): (one, "-") for n, one in self.theories.items()}

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the contact modulus and the rms slope that pressures are taken over."""
        return super().scalars() | {"rms_slope": (self.statistics.rms_slope, "-")}

    @property
    def ranges(self) -> Mapping[str, Range]:
        """Fractions [-] between which each theory holds, and how well, by its name."""
        return FrozenDict({name: RANGES[name] for name in self.theories})

    @property
    def theories_in_range(self) -> Mapping[str, Floats]:
        """Fractions [-] of the theories, nan outside the range of each."""
        return FrozenDict({name: in_range(name, one) for name, one in self.theories.items()})

    @property
    def reduced_pressure(self) -> Floats:
        """Mean pressure over E* h' [-]."""
        return np.asarray(self.mean_pressure / (self.contact_modulus * self.statistics.rms_slope))

    def fractions_at(self, reduced_pressure: Floats) -> Mapping[str, Floats]:
        """Fractions [-] of the theories at other pressures over E* h' [-], as `theories`."""
        scale = self.contact_modulus * self.statistics.rms_slope
        return _theories(
            reduced_pressure * scale, self.contact_modulus, self.statistics, self.summits
        )


def area_over_load(results: Sequence[ContactResult]) -> AreaOverLoad:
    """Collect the area of solved contacts over their load, and evaluate the theories beside it.

    Parameters
    ----------
    results : sequence of ContactResult
        Contacts of the same bodies under loads above zero, with `HalfSpace`.

    Raises
    ------
    DescriptionError
        If there is none, or what is no contact; if one carries no load, or the bodies differ or
        are layered.

    Notes
    -----
    The theories are of elastic half-spaces without adhesion; each holds in its range,
    `AreaOverLoad.ranges`: compare with `AreaOverLoad.theories_in_range`. With a `HardnessLimit`
    solved areas are larger.

    Examples
    --------
    >>> import contactkit as ck
    >>> from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine
    >>> spectrum = SelfAffineSpectrum(0.8, 16e-9, 8e-9)
    >>> heights = self_affine((64, 64), (1e-9, 1e-9), None, spectrum, 1, rms_slope=0.1)
    >>> steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    >>> found = area_over_load([ck.press(heights, 1e-9, steel, p) for p in (1e9, 4e9)])
    >>> persson = found.theories["Persson"]
    >>> bool((persson < found.corrected).all()), bool((found.corrected < found.counted).all())
    (True, True)
    """
    _check_kind(results)
    if not results:
        raise DescriptionError("area_over_load.results", "none", "be one contact or more")
    ordered = sorted(results, key=lambda one: one.mean_pressure)
    first = ordered[0]
    for one in ordered:
        _check(one, first)
    grid = first.plan.grid
    modulus = 1.0 / sum(
        1.0 / stack.materials[0].plane_strain_modulus for stack in first.plan.scene.interface.stacks
    )
    numbers = surface_statistics(first.heights, grid.pixel_size, periodic=grid.periodic)
    tops = summits(first.heights, grid.pixel_size, periodic=grid.periodic)
    pressure = np.array([one.mean_pressure for one in ordered])
    return AreaOverLoad(
        mean_pressure=pressure,
        counted=np.array([one.contact_fraction for one in ordered]),
        corrected=np.array([one.corrected_contact_area / grid.area for one in ordered]),
        theories=_theories(pressure, modulus, numbers, tops),
        contact_modulus=modulus,
        statistics=numbers,
        summits=tops,
    )


def _check_kind(given: object) -> None:
    """Refuse what is no sequence of contacts."""
    name = "area_over_load.results"
    if isinstance(given, ContactResult):
        cure = "put it in a list: area_over_load([result])"
        raise DescriptionError(name, "one contact", "be a sequence", hint=cure)
    if not isinstance(given, Sequence):
        raise DescriptionError(name, given, "be a sequence of ContactResult")
    for one in given:
        if not isinstance(one, ContactResult):
            raise DescriptionError(name, one, "be contacts, ContactResult")


def _check(result: ContactResult, first: ContactResult) -> None:
    if not result.load > 0.0:
        raise DescriptionError("area_over_load.results", "a contact without load", "carry a load")
    if result.plan.scene.effect(Attraction) is not None:
        raise DescriptionError(
            "area_over_load.results", "an adhesive contact", "be without adhesion, as the theories"
        )
    if result.holes is not None:
        raise DescriptionError(
            "area_over_load.results", "a surface with holes", "have heights at every pixel"
        )
    if not result.has(HalfSpace):
        raise DescriptionError(
            "area_over_load.results", "a layered contact", "be of half-spaces, as the theories are"
        )
    if not np.array_equal(result.heights, first.heights):
        raise DescriptionError(
            "area_over_load.results", "contacts of several surfaces", "be of one surface"
        )


def _column(theory: str) -> str:
    """Name of the column of a theory."""
    return theory.lower().replace(",", "").replace(" ", "_")


def _theories(
    pressure: Floats, modulus: float, statistics: SurfaceStatistics, tops: Summits
) -> Mapping[str, Floats]:
    slope = statistics.rms_slope
    found = {
        "Persson": contact_theories.persson_area(pressure, modulus, slope),
        "Bush, Gibson and Thomas": contact_theories.bush_gibson_thomas(pressure, modulus, slope),
        "fit of slope 2": contact_theories.interpolated_area(pressure, modulus, slope),
    }
    if tops.rms_height > 0.0:  # summits of one height are no Gaussian population
        found["Greenwood and Williamson"] = contact_theories.greenwood_williamson_area(
            pressure, modulus, tops
        )
    return FrozenDict({k: np.where(one > 1.0, np.nan, one) for k, one in found.items()})
