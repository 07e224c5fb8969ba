"""Contact solver: primal-dual active set, preconditioned conjugate gradients, nested grids.

contact_solver      Entry point: any heights, load and pressure bound on one grid and solid.
problem             The dimensionless problem, its feasible set, and the solution in SI units.
optimality          Optimality (KKT) conditions: residual and duality gap of any pressure.
active_set          Active-set iterations (semismooth Newton) on one grid.
state               State of the iterations: pressure, reduced gap, approach and violation.
truncated_set       Truncated active set, for half-spaces and layers of moderate contrast.
projected_set       Projected active set, for stiff films.
projection          Projection onto bounds in the metric of a sparse inverse.
reduced_system      Linear system of the free pixels: Cholesky factor, or conjugate gradients.
linear_response     Equations of a solved contact once more, with another right-hand side.
conjugate_gradient  Preconditioned conjugate gradients, in place.
sparse_inverse      Preconditioner: factorised sparse approximate inverse.
cell_inverse        The same under stiff films: long waves carried by cells in contact.
two_level           Preconditioner: a stencil for short waves, coarse blocks for long ones.
first_guess         First guess of the pressure on the coarsest grid.
nested_grids        Operators and preconditioners of the nested grids.
transfer            Restriction and prolongation between the grids.
warm_start          Pressures extrapolated from those under the previous loads.
idle_memory         Memory of arrays that are idle, lent to others meanwhile.
unit_response       Displacement of a map under unit pressure on its first pixel.
convolution         Displacement under a pressure map by fast Fourier transforms.
loops_numpy         Loops over pixels in numpy.
loops_numba         The same loops compiled.
reference_solvers   Conjugate gradients with bounds and L-BFGS-B, as checks and as the fallback.

What the thresholds of these modules are worth was measured over 19 contacts of one rough surface,
solved to 1e-8: half-spaces, soft coatings and stiff ones of 3 to 100 000 times the modulus of the
substrate, periodic, isolated and in strips, with a hardness and without, 3 to 81 % of the map in
contact. They take 479 applications of the operator on 128 x 128 pixels, 556 on 256 x 256; where a
comment says what other values take, it is of these sums. Thresholds that change nothing are guards.
"""
