"""Units of axes: those in which a quantity of some size reads best, and labels with them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from ..units import readable_unit

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["axis_label", "axis_unit", "in_print", "in_prose", "readable", "scaled"]

_SI = ("N", "Pa", "m", "m2", "m3", "s", "J", "N.s", "Pa.s", "m/s", "N/m", "rad")  # not the scales
_PRINT = str.maketrans({"2": "²", "3": "³", "4": "⁴", ".": "·"})


def in_print(unit: str) -> str:
    """Name of a unit in the letters of print.

    Examples
    --------
    >>> in_print("um2"), in_print("N.s"), in_print("deg"), in_print("degC"), in_print("mohm")
    ('µm²', 'N·s', '°', '°C', 'mΩ')
    """
    if unit.startswith("deg"):
        return "°" + unit.removeprefix("deg")
    known = unit.translate(_PRINT).replace("ohm", "Ω")
    return "µ" + known[1:] if known.startswith("u") else known


# What is not prose: blocks and words of code, formulas, targets of links, comments.
_CODE = re.compile(
    r"(```.*?```|`[^`\n]+`|\$\$.*?\$\$|\$[^$\n]+\$|\]\([^)\s]*\)|<!--.*?-->)", re.DOTALL
)
_LETTERS = (
    (re.compile(r"(?<![\w\\])u(?=(?:m[23]?|s|N|J|Pa)\b)"), "µ"),
    (re.compile(r"(?<![\w\\])([nµmc]?m)2(?!\w)"), r"\1²"),
    (re.compile(r"(?<![\w\\])([nµmc]?m)3(?!\w)"), r"\1³"),
    (re.compile(r"(?<=\d) deg(?:rees)?\b|\bdeg(?=C?\b)"), "°"),
    (re.compile(r"\b([kmµnp]?(?:N|Pa))\.(s|m)\b"), r"\1·\2"),
    (re.compile(r"(?<=N·m)\.(?=s\b)|(?<=\bkg)\.(?=m²)"), "·"),
    (re.compile(r"(?<=\d )(m?)ohm\b"), r"\1Ω"),
)


def in_prose(text: str) -> str:
    """Markdown with its units in the letters of print; code, formulas and links stay as they are.

    Examples
    --------
    >>> in_prose("0.1 mm3 of 2 Pa.s at 60 degrees and 20 degC, `um` in a file, 5 um/s")
    '0.1 mm³ of 2 Pa·s at 60° and 20 °C, `um` in a file, 5 µm/s'
    """
    parts = _CODE.split(text)
    for i in range(0, len(parts), 2):
        for pattern, letters in _LETTERS:
            parts[i] = pattern.sub(letters, parts[i])
    return "".join(parts)


def axis_unit(size: float, unit: str) -> tuple[float, str]:
    """Factor and name of the unit of an axis for a quantity of some size in an SI unit.

    As `units.readable_unit`, with the letters of print.

    Examples
    --------
    >>> axis_unit(2e-5, "m"), axis_unit(0.5, "rad")
    ((1e-06, 'µm'), (0.017453292519943295, '°'))
    """
    factor, name = readable_unit(size, unit)
    return factor, in_print(name)


def readable(unit: str, values: Any) -> tuple[float, str]:
    """Factor and name of the unit in which values in an SI unit, or in that of a scale, read best.

    Examples
    --------
    >>> readable("N", [2e-9, 3e-8]), readable("m2", [4e-12]), readable("E* A", [1e-6])
    ((1e-09, 'nN'), (1e-12, 'µm²'), (1.0, 'E* A'))
    """
    known = np.abs(np.asarray(values, dtype=float))
    top = float(known[np.isfinite(known)].max(initial=0.0))
    return axis_unit(top, unit) if unit in _SI else (1.0, unit)


def scaled(values: ArrayLike, unit: str) -> tuple[NDArray[np.float64], str]:
    """Values in the unit in which the largest of them reads best, and the name of that unit.

    Examples
    --------
    >>> scaled([0.0, 2e-8], "N")
    (array([ 0., 20.]), 'nN')
    """
    factor, name = readable(unit, values)
    return np.asarray(values, dtype=float) / factor, name


def axis_label(label: str, unit: str) -> str:
    """Label of an axis with the name of its unit, none for a pure number.

    Examples
    --------
    >>> axis_label("gap", "µm"), axis_label("number of menisci", "-")
    ('gap [µm]', 'number of menisci')
    """
    return label if unit in ("-", "") else f"{label} [{unit}]"
