"""Rough surfaces: random and measured height maps, and their statistics.

elementary           Heights of simple shapes: waves, spheres, paraboloids.
random_surfaces      Random rough surfaces: exponential autocorrelation, self-affine.
height_maps          Measured height maps: reading, validation, detrending, holes.
text_maps            Maps as text: rows or points, below a header of Gwyddion or WSxM.
map_fields           Sizes and units of a map, which its file states or the caller.
surface_data_file    Surface data files of ISO 25178-71 in their text form.
instrument_files     Formats of instruments, read by SurfaceTopography in a process of its own.
instrument_channels  One channel of such a file: what the process does.
netcdf_maps          Maps in netCDF 3, as SurfaceTopography has them.
containers           Containers of topographies of SurfaceTopography and contact.engineering.
spectra              Power spectral densities of maps and profiles; moments.
statistics           Roughness parameters, summits, bearing curve, autocorrelation.
highest_point        Highest point of a surface between its pixels.
contact_theories     Area over load: Persson; Bush, Gibson and Thomas; Greenwood and Williamson.
"""
