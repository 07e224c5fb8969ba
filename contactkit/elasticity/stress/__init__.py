"""Subsurface stress under a map of pressure and traction.

tractions  Maps of tractions; normal displacement under tangential ones.
planes     Stresses on planes at depth.
reading    Reading of a map between its pixels: trigonometric, uniform, spline.
measures   Equivalent stresses: von Mises, Tresca, principal stresses, interface shear.
maxima     Maxima of these measures and their locations.
periodic   Stresses on one plane, mode by mode of a periodic map.
strips     Grids of a map that repeats along one axis.
isolated   Grids of a map, and removal of periodic images for isolated contacts.
"""
