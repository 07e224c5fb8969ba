"""Validity numbers of results, under the name that scenes and their effects use."""

from ..validity import ValidityNumber, warn

__all__ = ["ValidityNumber", "warn"]
