"""Errata of chapter 3 with their effects, evaluated, and the pages that show them."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from validation_tables import grid

from contactkit.as_published.lookup import PUBLISHED, published
from contactkit.as_published.printed.errata import ERRATA
from contactkit.gallery.chapter_3.table_4_1 import FLATS, SPHERE
from contactkit.plot.axis_units import in_prose

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


# Pages of the gallery that show the effect.
SHOWN: Mapping[str, str] = {
    "3.11": "figure-3-09",
    "3.12": "figure-3-11",
    "3.19": "figure-3-10",
    "3.25": "figure-3-10",
    "3.27": "figure-3-13",
    "3.33": "figure-3-15",
    "3.34": "table-4-1",
    "3.35": "figure-3-15",
    "zero neck": "section-3-2-3",
    "3.42": "figure-3-09",
    "3.53": "figure-3-18",
    "3.56": "figure-3-18",
    "3.59": "figure-3-21",
    "3.61": "figure-3-21",
}

# Formulas of the errata, which are plain text in messages, as they are set on the page.
SET: Mapping[str, str] = {
    "r1 (cos theta1 + cos theta2)": r"$r_1 (\cos\theta_1 + \cos\theta_2)$",
    "1 - D / sqrt(D^2 + V / (pi R))": r"$1 - D/\sqrt{D^2 + V/(\pi R)}$",
    "x_c = r1": "$x_c = r_1$",
    "n = R / (2 (s - D))": "$n = R/(2 (s - D))$",
    "x_n0 = 50 h0": "$x_{n0} = 50 h_0$",
    "x_n0": "$x_{n0}$",
    "H(x^2)": "$H(x^2)$",
    "H^2(x)": "$H^2(x)$",
    "gap D_s": "gap $D_s$",
    "the D in": "the $D$ in",
    "H_0 is the height s_0": "$H_0$ is the height $s_0$",
    "ln((D0 + H0)^2 / (4 D0 H0))": r"$\ln\frac{(D_0 + H_0)^2}{4 D_0 H_0}$",
    "H0 = 2 D0": "$H_0 = 2 D_0$",
    "H0 = 3 to 6 D0": "$H_0$ = 3 to 6 $D_0$",
    "1e-2 R^3": "$10^{-2} R^3$",
    "theta1 + theta2 = 180 deg": r"$\theta_1 + \theta_2$ = 180°",
    "eta v / h0": r"$\eta v/h_0$",
    "Its D should read L": "Its $D$ should read $L$",
    "3 pi / 4 times": r"$3 \pi/4$ times",
    "s - D = R/2": "$s - D = R/2$",
    "41 % at R,": "41 % at $R$,",
    "1 - D/s instead of ln(s/D)": r"$1 - D/s$ instead of $\ln(s/D)$",
    "N (R / sqrt(N))^(3/2) is N^(1/4), not N^(-1/2)": r"$N (R/\sqrt N)^{3/2}$ is $N^{1/4}$, not "
    "$N^{-1/2}$",
    "as N^(1/2).": "as $N^{1/2}$.",
    "x/h = ": "$x/h$ = ",
}


_PLAIN = re.compile("|".join(re.escape(plain) for plain in sorted(SET, key=len, reverse=True)))


def _set(text: str) -> str:
    """An erratum with its formulas set."""
    return in_prose(_PLAIN.sub(lambda found: SET[found[0]], text))


def _name(number: str) -> str:
    name = number if " " in number else f"({number})"
    return f"[{name}](gallery/{SHOWN[number]}.md)" if number in SHOWN else name


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
    head = ("equation", "what is printed, and what is right", "effect [%]")
    rows = [
        (_name(n), _set(text), in_prose(_effect(n)))
        for n, text in ERRATA.items()
        if n.startswith("3.") or n == "zero neck"
    ]
    return grid(head, rows)
