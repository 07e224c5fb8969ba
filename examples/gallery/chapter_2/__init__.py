"""Figures and tables of chapter 2: contact of rough layered surfaces, dry and wet.

figure_2_01     Pressure under a sphere on a layered half-space.
layered_sphere  One solve of a sphere on one layer.
"""
