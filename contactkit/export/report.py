"""Report of a run of the command line, and the FMU that holds a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..validity import ValidityNumber

__all__ = ["FmuStart", "Report", "validity_lines"]


class Report(NamedTuple):
    """Report of a run: numbers with their units, and text to read.

    `write` writes the files of numbers, then `draw` the pictures; each returns its files. They are
    called after the numbers have been printed, which a full disk then does not take away. None
    without a folder to write to. `validity` has the numbers of validity of a device, each with the
    case that it belongs to.
    """

    scalars: Mapping[str, tuple[Any, str]]
    text: str
    write: Callable[[], Sequence[Path]] | None = None
    draw: Callable[[], Sequence[Path]] | None = None
    validity: Sequence[tuple[str, ValidityNumber]] = ()


class FmuStart(NamedTuple):
    """Name of the FMU that holds a scene, and the start values to bake in.

    `film` is the scene of the film of a device, which a native FMU takes as it is.
    """

    name: str
    values: Mapping[str, Any]
    film: Any = None


def validity_lines(found: Sequence[tuple[str, ValidityNumber]]) -> list[str]:
    """Numbers of validity that were evaluated, a line for each case.

    Examples
    --------
    >>> bond = ValidityNumber(name="Bond number", value=0.2, high=0.1, detail="gravity is left out")
    >>> validity_lines([("20 degC", bond)])
    ['validity, 20 degC: Bond number 0.2 OUT OF RANGE']
    """
    lines = dict[str, list[str]]()
    for case, number in found:
        if number.value is not None:
            verdict = "ok" if number.is_valid else "OUT OF RANGE"
            lines.setdefault(case, []).append(f"{number.name} {number.value:.2g} {verdict}")
    return [f"validity, {case}: {', '.join(numbers)}" for case, numbers in lines.items()]
