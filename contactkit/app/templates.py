"""Commented scene files to begin with, one for each kind of scene."""

from __future__ import annotations

from importlib import resources

from .. import data
from ..errors import DescriptionError, nearest

__all__ = ["KINDS", "template"]

KINDS = ("contact", "separation", "sliding")
"""Kinds of scenes that have a template."""


def template(kind: str) -> str:
    """Return the text of a scene file that runs as it is.

    Raises
    ------
    DescriptionError
        If there is none of that kind.

    Examples
    --------
    >>> template("separation").splitlines()[0]
    '# Two wetted faces pulled apart. Numbers without a unit are in SI units.'
    """
    if kind not in KINDS:
        raise DescriptionError("kind", kind, "be a kind of scene", hint=nearest(kind, KINDS))
    return resources.files(data).joinpath("templates", f"{kind}.toml").read_text("utf-8")
