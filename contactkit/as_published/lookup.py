"""Equations of the source by number: printed value, erratum, corrected value.

For reproduction only: elsewhere contactkit uses a printed equation that is wrong only if a scene
specifies ``"as-published"``.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from ..errors import ConvergenceError, DescriptionError, InfeasibleError
from .arguments import PublishedFormula, PublishedValue, checked_arguments, numbered
from .capillary_and_viscous import ROWS
from .contact import CONTACT_ROWS
from .corrected import refuse_wide_film
from .printed.errata import ERRATA
from .sliding import SLIDING_ROWS

__all__ = ["PUBLISHED", "TABLE_4_1", "PublishedFormula", "PublishedValue", "erratum", "published"]


def _order(number: str) -> tuple[bool, str, int, str]:
    """Chapters, then appendices, then what has a name: each by its numbers."""
    chapter, _, rest = number.rpartition(".")
    digits = "".join(c for c in rest if c.isdigit())
    return (" " in number, chapter, int(digits or 0), number)


PUBLISHED: Mapping[str, PublishedFormula] = MappingProxyType(
    {
        row.number: row
        for row in sorted((*CONTACT_ROWS, *ROWS, *SLIDING_ROWS), key=lambda row: _order(row.number))
    }
)
"""The printed equations with a numerical value, by number."""

TABLE_4_1: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "flats, static meniscus force": ("3.5",),
        "flats, meniscus force": ("3.11",),
        "flats, viscous force": ("3.19",),
        "sphere, static meniscus force": ("3.10", "3.6", "3.7", "3.8"),
        "sphere, meniscus force": ("3.12",),
        "sphere, viscous force": ("3.26", "3.27"),
        "N menisci, apart": ("3.13", "3.28"),
        "N menisci, side by side, flats": ("3.14a", "3.29a"),
        "N asperities, side by side": ("3.14b", "3.29b"),
        "division, meniscus force": ("3.33", "3.35"),
        "division, viscous force": ("3.34", "3.36"),
        "sliding flats, viscous force": ("3.53", "3.57", "3.61"),
        "sliding sphere, viscous force": ("3.56", "3.57", "3.59"),
    }
)
"""Rows of Table 4.1 of the source, with their equation numbers."""


def erratum(number: str) -> str:
    """Erratum of a printed equation; empty if it is correct.

    Examples
    --------
    >>> erratum("3.22")
    ''
    """
    formula = _formula(number)
    found = (ERRATA.get(n, "") for n in formula.errata or (formula.number,))
    return " ".join(text for text in found if text)


def published(number: str, /, **arguments: Any) -> PublishedValue:
    r"""Value of an equation of the source as printed, its erratum, and the corrected value.

    Parameters
    ----------
    number : str
        Number of the equation, such as ``"3.19"``; `PUBLISHED` lists them all. ``"2.41"`` is the
        fit of the hardness of one layer, ``"2.41a"`` and ``"2.41b"`` one and two layers by the
        criteria that follow it, ``"zero wavenumber"`` the datum of their displacement, and
        ``"zero neck"`` the break distance of section 3.2.1.4.
    **arguments : float or str
        Arguments of the equation by name, in SI units; ``PUBLISHED[number].signature`` lists them
        with their units. Angles in radians.

    Returns
    -------
    PublishedValue
        The printed value, the corrected value and its model, and the erratum; ``corrected`` is None
        where there is none, such as where no bridge is stable.

    Raises
    ------
    DescriptionError
        If there is no such equation, or an argument is missing, unknown or invalid.
    InfeasibleError
        Where the printed equation has no finite value.

    Notes
    -----
    The viscous forces "at break" of the source are impulses over the separation time. Resistance
    and attraction are positive, unlike some printed signs.

    References
    ----------
    .. [1] Equation numbers of chapters 2 and 3 and of Appendix A; Table 4.1 lists the most
       important ones of chapter 3, see `TABLE_4_1`.

    Examples
    --------
    >>> found = published("3.19", radius=100e-9, gap_start=2e-9, gap_end=180e-9,
    ...                   separation_time=1e-7, viscosity=0.89e-3)
    >>> print(str(found).rpartition("\n")[0])
    Eq. (3.19) viscous force on flats at rupture: 5.24189e-07 N as printed
      corrected: 2.62127e-07 N, impulse over time of a film of constant volume
    >>> found.erratum.partition(",")[0], round(found.relative_error, 3)
    ('It is the impulse over the separation time', 1.0)
    >>> PUBLISHED["3.22"].signature
    'sphere_radius [m], gap [m], film_height [m], speed [m/s], viscosity [Pa.s]'
    """
    formula = _formula(number)
    given = checked_arguments(formula, arguments)
    value = _printed(formula, given)
    corrected, by = _corrected(formula, given, value)
    return PublishedValue(
        formula.number, formula.name, value, formula.unit, corrected, erratum(number), by
    )


def _formula(number: str) -> PublishedFormula:
    key = number.strip().removeprefix("Eq.").strip(" ()") if isinstance(number, str) else number
    if key in PUBLISHED:
        return PUBLISHED[key]
    several = [n for n in PUBLISHED if isinstance(key, str) and n[:-1] == key]
    hint = f"did you mean {' or '.join(several)}?" if several else ""
    raise DescriptionError(
        "published, number", number, f"be one of {', '.join(PUBLISHED)}", hint=hint
    )


def _printed(formula: PublishedFormula, given: Mapping[str, Any]) -> float:
    try:
        value = _value(formula.printed, given)
    except (ConvergenceError, InfeasibleError) as reason:
        text = f"{numbered(formula.number)} has no value: {reason}"
        raise InfeasibleError(str(reason) if formula.number in str(reason) else text) from None
    if not (math.isfinite(value) or (formula.may_be_infinite and value == math.inf)):
        named = ", ".join(f"{name} = {value}" for name, value in given.items())
        raise InfeasibleError(f"{numbered(formula.number)} has no finite value for {named}")
    return value


def _corrected(
    formula: PublishedFormula, given: Mapping[str, Any], value: float
) -> tuple[float | None, str]:
    """Corrected value, or None with the reason why the consistent model has none."""
    try:
        if not formula.any_film:
            refuse_wide_film(given)
        found = value if formula.right is None else _value(formula.right, given)
    except (ConvergenceError, DescriptionError, InfeasibleError) as reason:
        return None, str(reason)  # also of a volume that is too large to be held
    if not (math.isfinite(found) or (formula.may_be_infinite and found == math.inf)):
        return None, f"no finite value of the model for these arguments ({formula.by})"
    return found, formula.by


def _value(function: Callable[..., Any], given: Mapping[str, Any]) -> float:
    """Value of a function; nan where it divides by zero or a number is too large to be held."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of numpy, which returns inf or nan
        try:
            return float(function(*given.values()))
        except (ZeroDivisionError, OverflowError):
            return math.nan
