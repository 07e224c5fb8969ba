"""Contact of many maps, or of maps on another device: one solver for any array library.

Written against the Python array API standard. The namespace and the device are those of the
heights, taken once at the entry; maps have any number of leading axes, ``(..., ny, nx)``, which
share the compliance and the transforms and converge each on its own. Pixels in contact are masks
of the whole grid: no shape depends on the data, and of the data only the question whether any map
goes on reaches the host.

press_maps   Entry point: maps of NumPy, PyTorch, CuPy ..., pressed on one solid.
given        Input, checked: maps, loads, bound.
result       Pressures, displacements, approaches, residuals, one for each map.
validity     Slope, peak pressure and edges of the worst map.
namespace    Array library, device and precision of the heights.
operator     Displacement under pressures, and about its inverse, on one grid.
problem      The dimensionless problem of all maps.
iterations   Primal-dual active set and conjugate gradients, a mask for each choice.
nested       First guesses from coarser grids.
"""
