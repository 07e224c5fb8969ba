"""Elastohydrodynamic films: deformation, cavities, contact; moving rims of axisymmetric bodies.

mesh      Rings: nodes, areas, conductances.
drive     An imposed gap, or forces on a mass with a spring.
wet_gap   Film, contact and motion as equations of one unknown, in units of viscosity 1.
step      One implicit step: Radau IIA, semismooth Newton, error estimate.
progress  Steps that end at given times; the rupture of a film stronger than a cavity.
follow    Adaptive steps of bodies on rings.
motion    Motion of smooth bodies in SI units, extrapolated from three meshes.
maps      Films on a grid: rough and measured surfaces.
response  Storage and loss modulus over the frequency.
"""
