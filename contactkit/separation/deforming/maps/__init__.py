"""Deforming bodies with surfaces that have heights: films on a grid.

cells  Cells of the film: outline, heights of both bodies, halved resolution.
film   Film on these cells, and what a plan states of it.
run    The motion on two grids, and its result.
"""
