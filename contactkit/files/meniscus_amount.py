"""Amount of liquid that a file gives by a contact radius, or by a coverage, at a gap."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from attrs import evolve

from ..errors import DescriptionError
from ..scene.interface import Interface
from ..scene.meniscus import Meniscus
from ..units import parse_quantity

__all__ = ["AMOUNT_KEYS", "AMOUNT_UNITS", "amount_of", "check_flat", "with_amount"]


class _Form(NamedTuple):
    """Keys that must be there, with their units, and those that may."""

    needed: Mapping[str, str]
    optional: tuple[str, ...] = ()


_FORMS = {
    "radius": _Form({"radius": "m", "at_gap": "m"}, ("body", "profile")),
    "coverage": _Form({"coverage": "-", "area": "m2", "at_gap": "m"}),
}
_FIELDS = ("volume", "pressure", "relative_humidity")
_CURES = {
    "at_gap": 'the gap at which that holds, such as at_gap = "2 nm"',
    "area": 'the area of the face, such as area = "1 um2"',
}

AMOUNT_KEYS = ("radius", "at_gap", "body", "profile", "coverage", "area")
"""Keys of a meniscus in a file, beside the fields of `Meniscus`."""
AMOUNT_UNITS = {key: unit for form in _FORMS.values() for key, unit in form.needed.items()}
"""Units of those that are quantities; the others are words."""


def amount_of(table: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of a table that give the amount by a radius or a coverage; empty if none does.

    Raises
    ------
    DescriptionError
        If they contradict each other or a field of `Meniscus`, or if one is missing.
    """
    given = {key: table[key] for key in AMOUNT_KEYS if key in table}
    if not given:
        return {}
    ways = [key for key in (*_FORMS, *_FIELDS) if key in table]
    if len(ways) > 1:
        raise DescriptionError(
            "Meniscus",
            ways,
            "be given one of volume [m3], pressure [Pa], relative_humidity [-], radius [m] and "
            "coverage [-]",
            hint="each of them is the amount of liquid: leave out all but one",
        )
    form = _FORMS.get(ways[0]) if ways else None
    if form is None:
        key = next(iter(given))
        expected = "come with radius [m], or with coverage [-] and area [m2]"
        raise DescriptionError(f"Meniscus.{key}", given[key], expected)
    for key, unit in form.needed.items():
        if key not in given:
            field, expected = f"Meniscus.{key}", f"be given with {ways[0]}"
            raise DescriptionError(field, None, expected, unit=unit, hint=_CURES[key])
    for key in given:
        if key not in (*form.needed, *form.optional):
            expected = f"be left out with {ways[0]}"
            raise DescriptionError(f"Meniscus.{key}", given[key], expected)
    return given


def with_amount(meniscus: Meniscus, given: Mapping[str, Any]) -> Meniscus:
    """Give a meniscus the volume of a radius or a coverage at a gap.

    Parameters
    ----------
    meniscus : Meniscus
        Its liquid, contact angles and count.
    given : mapping
        What `amount_of` found.
    """
    by_radius = "radius" in given
    form = _FORMS["radius" if by_radius else "coverage"]
    size: dict[str, Any] = {key: given[key] for key in form.optional if key in given}
    for key, unit in form.needed.items():
        size[key] = parse_quantity(given[key], unit, f"Meniscus.{key}")
    make = Meniscus.from_radius if by_radius else Meniscus.from_coverage
    made = make(
        liquid=meniscus.liquid,
        contact_angle_lower=meniscus.contact_angle_lower,
        contact_angle_upper=meniscus.contact_angle_upper,
        count=meniscus.count,
        **size,
    )
    return evolve(meniscus, volume=made.volume)


def check_flat(table: Mapping[str, Any], interface: Interface) -> None:
    """Refuse a radius or a coverage at a gap where the bodies are no flats.

    Raises
    ------
    DescriptionError
        If a body is round or rough.
    """
    meniscus = table.get("meniscus")
    given = amount_of(meniscus) if isinstance(meniscus, Mapping) else {}
    if given and not interface.is_flat:
        key = "radius" if "radius" in given else "coverage"
        raise DescriptionError(
            f"Meniscus.{key}",
            given[key],
            "be given between two flats, whose gap is the same everywhere",
            hint="give interface.meniscus.volume [m3]",
        )
