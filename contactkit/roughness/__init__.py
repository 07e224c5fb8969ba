"""Rough surfaces: random and measured height maps, and their statistics.

elementary       Heights of simple shapes: waves, spheres, paraboloids.
random_surfaces  Random rough surfaces: exponential autocorrelation, self-affine; resolved variance.
height_maps      Measured height maps: reading, validation, detrending.
statistics       Roughness parameters, bearing fraction, autocorrelation, spectrum and its moments.
"""
