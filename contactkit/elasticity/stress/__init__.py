"""Subsurface stress under a map of pressure and tangential traction.

planes    Stresses on planes at depth.
measures  Equivalent stresses: von Mises, Tresca, principal stresses, interface shear.
maxima    Maxima of these measures and their locations.
periodic  Stresses on one plane, mode by mode of a periodic map.
isolated  Removal of periodic images, for isolated contacts.
"""
