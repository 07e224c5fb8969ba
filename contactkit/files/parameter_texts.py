"""Texts of the parameters in the docstring of a class or a function, for tables and editors."""

from __future__ import annotations

import inspect
import re
from typing import Any

__all__ = ["parameter_texts"]


def parameter_texts(owner: Any) -> dict[str, str]:
    """Texts of the parameters in the docstring of a class, of its bases, or of a function.

    Parameters
    ----------
    owner : type or function
        What has a numpydoc section ``Parameters``. Without docstrings (``python -OO``) there are
        no texts.

    Returns
    -------
    dict of str to str
        Text by name, in Markdown.

    Examples
    --------
    >>> from contactkit.scene.materials import Layer
    >>> parameter_texts(Layer)["thickness"]
    'How thick it is [m].'
    """
    found: dict[str, str] = {}
    for one in getattr(owner, "__mro__", (owner,)):
        # Of a class its own docstring, not that of a base.
        held = vars(one) if isinstance(one, type) else {"__doc__": one.__doc__}
        text = inspect.cleandoc(held.get("__doc__") or "")
        part = re.search(r"^Parameters\n-+\n(.*?)(?=^\w[\w ]*\n-+\n|\Z)", text, re.M | re.S)
        for entry in re.split(r"\n(?=\S)", part[1]) if part else ():
            head, _, body = entry.partition("\n")
            meaning = re.sub(r":math:`([^`]+)`", r"$\1$", " ".join(body.split()))
            meaning = meaning.replace("``", "`")
            for name in head.partition(" : ")[0].split(", "):
                if meaning and not text.startswith("See "):
                    found.setdefault(name, meaning)
    return found
