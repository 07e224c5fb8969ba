"""Limits of the size of a file and of what it announces, and the variables that raise them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

from ..errors import DescriptionError

__all__ = ["LIMITS", "Limit", "check_limit", "check_size", "limit_of"]

_PREFIX = "CONTACTKIT_MAX_"


class Limit(NamedTuple):
    """A limit: its default, its unit, what it bounds, and the most that may be set if any."""

    value: int
    unit: str
    what: str
    most: int | None = None

    def text(self, number: float) -> str:
        """A number with the unit of the limit."""
        if self.unit != "bytes":
            return f"{number:,.0f} {self.unit}".rstrip()
        for factor, name in ((2**40, "TiB"), (2**30, "GiB"), (2**20, "MiB"), (2**10, "KiB")):
            if number >= factor:
                return f"{number / factor:.4g} {name}"
        return f"{number:.0f} bytes"


LIMITS = {
    "SCENE_BYTES": Limit(2**20, "bytes", "scene file"),
    "TEXT_BYTES": Limit(2**25, "bytes", "text inside another file: JSON header, XML description"),
    "BYTES": Limit(2**31, "bytes", "result, height map or FMU, packed and unpacked"),
    "RATIO": Limit(200, "", "size of an archive unpacked over packed, above 16 MiB"),
    "MEMBERS": Limit(10_000, "files", "archive"),
    # Parsers call themselves for each level: Python ends them at some 340 tables inside each other.
    "DEPTH": Limit(64, "levels", "tables, lists or elements inside each other", most=128),
    "CELL_BYTES": Limit(2**20, "bytes", "text or row in a file of a study"),
    "PIXELS": Limit(2**26, "pixels", "height map, or grid of a contact"),
    "SECONDS": Limit(300, "s", "time to read a height map in a format of an instrument"),
    "POINTS": Limit(10**6, "points", "study, or curve over the gap"),
}
"""Limits by name; the environment variable ``CONTACTKIT_MAX_`` and the name sets another."""


def limit_of(name: str) -> int:
    """Value of a limit, from the environment if it is set there.

    Raises
    ------
    DescriptionError
        If the environment variable is no positive whole number, or more than can be read.

    Examples
    --------
    >>> limit_of("MEMBERS")
    10000
    """
    variable = _PREFIX + name
    given = os.environ.get(variable)
    if given is None:
        return LIMITS[name].value
    try:
        found = int(float(given)) if len(given) < 40 else 0
    except (ValueError, OverflowError):
        found = 0
    most = LIMITS[name].most
    if found < 1 or (most is not None and found > most):
        ends = "such as 4e9" if most is None else f"at most {most}, which is what can be read"
        raise DescriptionError(variable, given, f"be a positive whole number, {ends}")
    return found


def check_limit(name: str, found: float, where: str, field: str = "file") -> None:
    """Refuse what exceeds a limit: the message has both numbers, and how to raise the limit.

    Parameters
    ----------
    name : str
        Name of the limit, of `LIMITS`.
    found : float
        What the file holds or announces, in the unit of the limit.
    where : str
        The file, or what is in it.
    field : str
        What the message begins with.

    Raises
    ------
    DescriptionError
        If it exceeds the limit.

    Examples
    --------
    >>> check_limit("MEMBERS", 10**5, "a.fmu")
    Traceback (most recent call last):
    contactkit.errors.DescriptionError: file must have at most 10,000 files (a.fmu has 100,000 \
files), got 'a.fmu'; if it is meant, set CONTACTKIT_MAX_MEMBERS=100000
    """
    most = limit_of(name)
    if found <= most:
        return
    found = min(found, 10**30)  # what is announced may be beyond any float
    limit = LIMITS[name]
    what = "unpack to at most" if name == "RATIO" else "have at most"
    times = " times its size" if name == "RATIO" else ""
    hint = f"if it is meant, set {_PREFIX}{name}={found:.0f}"
    if limit.most is not None and found > limit.most:
        hint = f"at most {limit.text(limit.most)} can be read, with {_PREFIX}{name}={limit.most}"
    raise DescriptionError(
        field,
        where,
        f"{what} {limit.text(most)}{times} ({where} has {limit.text(found)})",
        hint=hint,
    )


def check_size(path: Path, name: str = "BYTES") -> int:
    """Size of a regular file [bytes], refused above a limit.

    Raises
    ------
    DescriptionError
        If it is larger.
    OSError
        If it cannot be looked at.
    """
    size = path.stat().st_size
    check_limit(name, size, str(path))
    return size
