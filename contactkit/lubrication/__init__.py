"""Lubrication: squeeze films, Couette films, cavitation and shear limits.

constant_force    Time that a constant pull takes to open a film against viscosity and Laplace press
couette_flat      Sliding at a held gap: the drag of a liquid film on two bodies that move past each
couette_reynolds  A sphere that slides along a flat inside a round meniscus: drag by Reynolds' equat
couette_sphere    A sphere that slides over a film at a held gap: drag over the lens of the wetted c
dimensionless     Numbers that say whether a model is inside its range. Floats or arrays; nothing is
film_limits       What a liquid cannot carry: tension below a given pressure, shear above a given st
squeeze_film      Squeeze film: the viscous force that resists opening a gap full of liquid.
"""
