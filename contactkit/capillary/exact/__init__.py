"""Exact axisymmetric liquid bridges (Delaunay surfaces) and their stability limits.

bridge           Bridge of given volume; lateral stability.
at_pressure      Bridge of given pressure, in equilibrium with a vapour.
stability        Stability limit of a bridge: fold, pitchfork or detachment.
result           Forces, radii, shape and stiffness of solved bridges.
profile          Meridian curve of a solved bridge.
solve            Solution at many points: direct Newton iteration, then the branch.
delaunay         Delaunay surfaces between two contact lines.
chart            Gap and volume as explicit functions of two coordinates, with derivatives.
newton           Newton iteration in these coordinates.
volume_branch    Branch of bridges of one volume, up to the stability limit.
pressure_branch  Branch of bridges of one pressure, up to its limit.
free_ends        Bridges outside the chart: the arc lengths of both ends as unknowns.
continuation     Pseudo-arclength continuation of such bridges.
"""
