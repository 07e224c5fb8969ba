"""Numerical tools that must run without numpy, and those of contacts: fixed points, transforms.

An FMU carries the first into hosts where scipy is missing; elsewhere scipy does.

roots           Bracketed roots: false position, Newton, bisection of a condition, balances.
quadrature      Gauss-Legendre and Gauss-Lobatto rules on the unit interval.
step_size       Step-size control: the next length of a step from the error of the last one.
events          Events inside a step: which is met first, and the step that ends there.
radau_tableau   Numbers of the methods Radau IIA: nodes, weights, estimate of the error.
three           Linear systems of three equations, for the stages of a step.
cubic_spline    A cubic spline through points.
monotone_cubic  Curves through points that keep the order of their values.
lines           Points of curves between which straight lines are right.
fixed_point     Fixed points of expensive maps: accelerated, evaluated no better than needed.
blas            Linear algebra of small matrices on one thread.
fft_pieces      Convolution of a map piece by piece, each thread taking whole pieces.
fft             Real two-dimensional transforms: scipy.fft always, ducc0 where it is installed.
"""
