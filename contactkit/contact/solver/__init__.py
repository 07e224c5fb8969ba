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
convolution         Displacement under a pressure map by fast Fourier transforms.
loops_numpy         Loops over pixels in numpy.
loops_numba         The same loops compiled.
reference_solvers   Conjugate gradients with bounds and L-BFGS-B, as checks and as the fallback.
"""
