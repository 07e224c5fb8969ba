"""Exact axisymmetric liquid bridges (Delaunay surfaces) and their stability limits.

at_pressure      Liquid bridge of given pressure between two bodies, as a vapour holds it.
bridge           Capillary bridge between two bodies, exactly: the front door.
chart            Gap, volume and pressure of a bridge as functions of two numbers, with derivatives,
continuation     The curve of bridges with free ends, followed by its arc length up to its limit.
delaunay         Meridians of constant mean curvature between two contact lines: closed but for two
free_ends        Bridges with free ends, for those whose phases no chart covers, and the curve throu
newton           Newton iteration for bridges between curved bodies, and the curve of one volume up
pressure_branch  Bridges of given pressure, as a vapour sets it: starts, and the curve up to its lim
profile          The meridian of a liquid bridge as a curve, from the numbers told about it.
result           What is told about a bridge, gathered from the unknowns of its solution.
solve            Bridges at many points at once: a first try for each, and the curve of its kind for
stability        Where a liquid bridge of given volume ends: fold, tilt or detachment.
volume_branch    The curve of bridges of one volume, from thin to the limit of stability.
"""
