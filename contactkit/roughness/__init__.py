"""Rough surfaces: spectra, random fields, statistics, measured height maps.

elementary     Heights of simple bodies: waves, balls, paraboloids.
height_maps    Measured height maps: reads files, and says of a map that cannot be used why, and the
random_fields  Periodic random surfaces: a sum of waves with given mean squares and seeded random ph
roughness      Height maps made by a recipe: random surfaces from their spectrum; with them, simple
spectra        Correlation and spectrum of a height map.
statistics     What a height map is like, in numbers: heights, slopes, curvatures, correlation, spec
"""
