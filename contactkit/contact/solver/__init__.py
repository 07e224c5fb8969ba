"""Solver of the contact problem: active set with a sparse inverse on nested grids.

blocks             Long waves of the preconditioner: one unknown for every block of pixels.
convolution        Displacement of a surface under a pressure map, by fast Fourier transforms.
dense              Direct solution on few moving pixels, where gathering the whole map would cost mo
grids              Preparation of the nested grids: everything of a contact solve that the heights d
inner              Correction of the pressure on the pixels that may move, so that the gap becomes l
loops_numba        Passes of the active-set method compiled by numba: the functions of `active_set_l
loops_numpy        Passes of the active-set method over maps and over the pixels that may move, on n
optimality         How far a pressure map is from solving the contact problem, whoever computed it.
outer              Primal-dual active set on one grid of the contact problem.
patch              The operator of a lone map on no more than the patch where pixels move.
press              Contact of a rough rigid body with an elastic solid whose pressure may be capped.
problem            The contact problem in its own units: checked, made dimensionless, and given back
reference_solvers  Two plain contact solvers, to check the fast one by and to fall back on.
sparse_inverse     A sparse factor of the inverse of the operator between the pixels that may move.
stencil            A three by three stencil that undoes the operator for waves as short as a few pix
transfer           Nested grids of a height map: which there are, and how maps travel between them.
two_level          Preconditioner for many moving pixels: a stencil for the short waves, blocks for
warm_start         Pressures to start from, extrapolated from those under the loads before.
"""
