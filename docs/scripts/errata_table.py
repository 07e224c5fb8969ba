"""Errata of chapter 3 with their effects, evaluated, and the checks that show them."""

from __future__ import annotations

import math
from collections.abc import Mapping

from validation_tables import grid

from contactkit.as_published.lookup import PUBLISHED, published
from contactkit.as_published.printed.errata import ERRATA
from contactkit.gallery.chapter_3.table_4_1 import FLATS, SPHERE

VALUES = "tests/as_published/test_published_values.py"
FORMULAS = "tests/as_published/test_published_formulas.py"
OTHERS: Mapping[str, float] = {  # arguments that Table 4.1 does not need
    "kelvin_radius": 2e-9,
    "molar_volume": 1.8e-5,
    "temperature": 293.15,
    "relative_humidity": 0.5,
    "height": 1.5e-9,
    "speed": 1e-3,
    "position": 50e-9,
    "travel": 50e-9,
}
NAMES: Mapping[str, str] = {"3.14": "3.14b"}  # of the entry of `published`

# Effects that no value of the equation shows: what it is called, its sign, its use.
SAID: Mapping[str, str] = {
    "3.3": "-200: the sign",
    "3.18": "-200: the sign",
    "3.21": "-200: the sign",
    "3.25": "0 as a mean over the time; the force at the start is 50 to 109 times it between flats",
    "3.26": "0 as a mean over the time; no force at rupture",
    "3.39": "the sign of the curvature",
    "3.40": "as (3.23)",
    "3.41": "the sign of the curvature",
    "zero neck": "+40 to +1400 of the gap",
    "3.44": "dimension",
    "3.51": "notation",
    "3.53": "0 as a mean over the time; the force at the start is +136",
    "3.59": "-98 of 100 asperities, -99.9 of 1e4",
    "3.61": "0 at a given time; -99 at a given speed, 1e4 menisci",
}


def _page(slug: str, statement: str) -> str:
    kind, _, digits = slug.partition("-")
    name = {"figure": "Fig.", "table": "Table", "section": "Section"}[kind]
    number = digits.replace("-0", "-").replace("-", ".")
    return f"[{name} {number}](gallery/{slug}.md): *{statement}*"


CHECKS: Mapping[str, str] = {
    "3.3": f"`{VALUES}::test_what_differs_has_an_erratum_and_what_has_none_agrees`",
    "3.5": f"`{VALUES}::test_flats_3_11_beside_the_exact_bridge`",
    "3.7": f"`{VALUES}::test_thin_film_force_3_7_is_right_where_the_film_is_thin`",
    "3.10": f"`{VALUES}::test_static_force_of_table_4_1_counts_the_surface_tension_twice`",
    "3.11": _page("figure-3-09", "a few per cent off at the start, and a factor near rupture"),
    "3.12": _page("figure-3-11", "at 1 nm the printed force is 29 to 46 % too large"),
    "3.14": f"`{VALUES}::test_asperities_whose_menisci_overlap_have_no_right_value`",
    "3.18": f"`{FORMULAS}::test_3_19_is_the_integral_of_3_18_at_constant_radius`",
    "3.19": _page("figure-3-10", "twice that of a film that keeps its volume"),
    "3.21": f"`{VALUES}::test_what_differs_has_an_erratum_and_what_has_none_agrees`",
    "3.23": f"`{VALUES}::test_what_differs_has_an_erratum_and_what_has_none_agrees`",
    "3.25": _page("figure-3-10", "at constant speed it starts at 4 (h_s - h0)/h0 times its mean"),
    "3.26": f"`{FORMULAS}::test_3_26_is_the_integral_of_3_22_at_constant_volume`",
    "3.27": _page("figure-3-13", "Eq. (3.27) is zero for 2 nm and 41 to 56 % too large"),
    "3.33": _page("figure-3-15", "Eq. (3.33) is 40 % too large at 1e4 menisci of 6 nm"),
    "3.34": _page("table-4-1", "viscous forces between flats are twice those"),
    "3.35": _page("figure-3-15", "the rise is far below the root of N of Eq. (3.35)"),
    "3.37": f"`{VALUES}::test_what_differs_has_an_erratum_and_what_has_none_agrees`",
    "3.39": "`tests/capillary/test_arc_hard.py::test_repelled_pair_turns_from_push_to_pull`",
    "3.40": "`tests/capillary/test_arc_values.py"
    "::test_volume_is_that_of_the_circle_turned_about_the_axis`",
    "3.41": "`tests/capillary/test_arc_properties.py"
    "::test_contact_radius_is_continuous_where_the_arc_is_straight`",
    "zero neck": _page("section-3-2-3", "the exact bridge breaks at less than a third of them"),
    "3.42": _page("figure-3-09", "Eq. (3.42) does not make the heights one curve"),
    "3.43": f"`{FORMULAS}::test_dimensionless_3_42_and_3_43`",
    "3.44": f"`{VALUES}::test_every_equation_answers`",
    "3.51": "`tests/lubrication/test_sliding.py::test_the_overlap_is_what_a_grid_counts`",
    "3.53": _page("figure-3-18", "the force at the start is 3 pi/4 times that"),
    "3.55": f"`{VALUES}::test_what_differs_has_an_erratum_and_what_has_none_agrees`",
    "3.56": _page("figure-3-18", "Eq. (3.56) is too low for a sphere"),
    "3.59": _page("figure-3-21", "asperities at a given time: N^(1/4), not N^(-1/2)"),
    "3.61": _page("figure-3-21", "at a given speed: N^(1/2) for asperities, N^0 for menisci"),
}


def _effect(number: str) -> str:
    """Change by the erratum in per cent, for the films of Table 4.1."""
    if number in SAID:
        return SAID[number]
    name = NAMES.get(number, number)
    needed = PUBLISHED[name].arguments
    film = (SPHERE if "sphere_radius" in needed else FLATS) | OTHERS
    found = published(name, **{one: film[one] for one in needed if one in film})
    if found.corrected is None or not math.isfinite(found.value):
        raise ValueError(f"({number}) has no two values: {found.corrected_by}")
    off = 100.0 * (found.value - found.corrected) / abs(found.corrected)
    return f"{off:+.2g}" if abs(off) < 10.0 else f"{off:+.0f}"


def errata_table() -> str:
    """Errata of the printed equations of chapter 3."""
    head = ("equation", "what is printed, and what is right", "effect [%]", "check")
    rows = [
        (n if " " in n else f"({n})", text, _effect(n), CHECKS[n])
        for n, text in ERRATA.items()
        if n.startswith("3.") or n == "zero neck"
    ]
    return grid(head, rows)
