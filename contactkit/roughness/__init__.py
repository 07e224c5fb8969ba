"""Rough surfaces: spectra, random fields, statistics, measured height maps.

roughness      Random rough surfaces: exponential autocorrelation, self-affine.
random_fields  Periodic Gaussian random fields from a spectrum.
elementary     Heights of simple shapes: waves, spheres, paraboloids.
height_maps    Measured height maps: reading, validation, detrending.
statistics     Heights, slopes, curvatures, bearing area of a map.
spectra        Autocorrelation and power spectral density of a map.
"""
