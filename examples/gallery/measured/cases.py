"""Cases that others have computed or measured, with source, licence and status of each."""

from __future__ import annotations

import functools
import json
from importlib import resources
from typing import Any

__all__ = ["case"]


@functools.cache
def _cases() -> dict[str, dict[str, Any]]:
    text = resources.files(__package__).joinpath("measurements.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, Any]] = json.loads(text)
    return found


def case(name: str) -> dict[str, Any]:
    """Return a case of ``measurements.json`` by its name.

    Examples
    --------
    >>> case("contact_hertz_grid")["elements_in_contact"]
    177
    """
    return _cases()[name]
