"""Rough surfaces: random and measured height maps, and their statistics.

elementary         Heights of simple shapes: waves, spheres, paraboloids.
random_surfaces    Random rough surfaces: exponential autocorrelation, self-affine.
height_maps        Measured height maps: reading, validation, detrending.
surface_data_file  Surface data files of ISO 25178-71 in their text form.
spectra            Power spectral densities of maps and profiles; moments.
statistics         Roughness parameters, summits, bearing curve, autocorrelation.
contact_theories   Area over load after Persson, Bush, Gibson and Thomas, Greenwood and Williamson.
"""
