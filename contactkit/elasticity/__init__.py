"""Elasticity: layered half-spaces, point and patch loads, stresses.

layered          Surface compliance of a layered half-space in Fourier space.
layer_stack      Validated materials of a layered half-space; its compliance for long waves
                 (`small_wavenumber_constant`) and under uniform pressure (`uniform_compliance`).
layer_recursion  Recursion over one layer: compliance upward, tractions downward.
layered_fields   Displacements and tractions on planes at depth, in Fourier space.
depths           Planes at depth: layer, and side of an interface.
love             Uniform pressure on a rectangle: Love's influence coefficients.
point_load       Surface displacement under a point load, tabulated over the radius.
influence        Influence coefficients of non-periodic contacts.
isolated_map     Displacement of maps without periodic images, and of waves.
one_axis         Influence coefficients of windows that repeat along one axis.
transverse_isotropy
                 Transversely isotropic solids: constants, roots, and the modulus of the normal
                 compliance of a half-space.
transverse_layers
                 Normal compliance of transversely isotropic layers in Fourier space.
transverse_symbols
                 The same in windows of any kind.
prony            Relaxation modulus as a Prony series: creep, complex modulus, fit.
creep_symbol     Creep of a layered solid at every wavenumber, from its compliance at some rates.
rings            Displacement under axisymmetric pressures that are linear between rings.
hardness_rules   Hardness of a layered solid over the depth of indentation.
tangential       Tangential displacement under tangential tractions, on a grid.
tangential_one_axis
                 The same in windows that repeat along one axis.
stress           Subsurface stress under a map of pressure and traction.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_names

if TYPE_CHECKING:
    from .layered import compliance

__all__ = ["compliance"]

__getattr__ = lazy_names(__name__, {"compliance": "layered"})
