"""Numerical tools that must run without numpy, and the FFT backends.

An FMU carries them into hosts where scipy is missing; elsewhere scipy does.

roots           Bracketed roots: false position, Newton, and bisection of a condition.
quadrature      Gauss-Legendre and Gauss-Lobatto rules on the unit interval.
step_size       Step-size control: the next length of a step from the error of the last one.
events          Events inside a step: which is met first, and the step that ends there.
three           Linear systems of three equations, for the stages of a step.
cubic_spline    A cubic spline through points.
monotone_cubic  Curves through points that keep the order of their values.
lines           Points of curves between which straight lines are right.
fft             Real two-dimensional transforms: scipy.fft always, ducc0 where it is installed.
"""
