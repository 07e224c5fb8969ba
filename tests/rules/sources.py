"""Syntax trees of Python files, parsed once for all rules."""

from __future__ import annotations

import ast
import functools

__all__ = ["tree"]


@functools.cache
def tree(path):
    """Syntax tree of a file; whoever asks for it leaves it as it is."""
    return ast.parse(path.read_text(encoding="utf-8"))
