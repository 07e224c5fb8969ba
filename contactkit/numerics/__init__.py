"""Numerical tools that must run without numpy, and the FFT backends.

cubic_spline    A cubic spline through points, without numpy: for laws that run where numpy is missi
fft             Real two-dimensional transforms behind one small interface: scipy.fft always, ducc0
monotone_cubic  Curves through measured or solved points that keep the order of their values, withou
quadrature      Gauss-Legendre quadrature on the unit interval, without numpy.
roots           A bracketed root of a function of one float, for kernels that run where scipy does n
"""
