"""Elasticity: layered half-spaces, point and patch loads, stresses.

depths           Planes at depth in a layered half-space, with a side where they lie on an interface
influence        Influence coefficients of isolated contacts: pixels of pressure on a half-space, la
layer_recursion  One elastic layer in Fourier space: its compliance climbed upward, its tractions le
layer_stack      Materials of a layered half-space: what they must be, and its compliance to the lon
layered          Surface compliance of an elastic layered half-space in Fourier space, without a mat
layered_fields   Elastic states on planes at depth in a layered half-space, one wavenumber at a time
love             Uniform pressure on a rectangle of a half-space: Love's influence coefficients.
point_load       Surface displacement of a layered half-space under a point load: a table over the r
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_names

if TYPE_CHECKING:
    from .layered import compliance

__all__ = ["compliance"]

__getattr__ = lazy_names(__name__, {"compliance": "layered"})
