"""Force law of the exact bridge between flats, tabulated once per pair of contact angles.

force_law  Force as a tabulated function of the gap, without numpy.
family     The bridges as a one-parameter family, dimensionless.
sampling   Adaptive sampling of the family for a spline.
"""
