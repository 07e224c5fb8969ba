"""Second method: a plain contact solver, layers, bridges and films, apart from those of contactkit.

contact  Pressure of a periodic rough contact by conjugate gradients with two bounds.
layers   Displacement and stress of layers on a half-space, one linear system for each wavenumber.
bridges  Liquid bridges and viscous films of chapter 3, by shooting and quadrature.
unbounded_film  A film without a rim between bodies that deform, by Galerkin's method.
anchors  Rough contacts of chapter 2 with the numbers of the captions, solved by both.
"""
