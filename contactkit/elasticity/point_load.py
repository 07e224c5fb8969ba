r"""Surface displacement of a layered solid under a point load, tabulated over the radius.

Pressure positive in compression, displacement positive into the solid. The displacement of the
surface at the radius r under a unit force is

.. math:: g(r) = \frac{1}{2\pi} \int_0^\infty \alpha C(\alpha) J_0(\alpha r)\,d\alpha
               = \frac{T(r)}{2\pi r},

where T varies from C_inf, twice the compliance of the top layer, at r = 0 to C_s of the substrate
far away, which is zero on a rigid base. In the logarithms of wavenumber and radius both alpha C and
T are smooth for all thicknesses and contrasts, and the transform is a convolution, evaluated mode
by mode:

.. math:: \int_0^\infty \alpha^{i\omega} r J_0(\alpha r)\,d\alpha = r^{-i\omega}\,
          2^{i\omega}\, \frac{\Gamma((1 + i\omega)/2)}{\Gamma((1 - i\omega)/2)},

of modulus one, so that no digits are lost. The step of alpha C from C_s to C_inf is subtracted
first, as that of exp(-alpha c), whose T is known.

============  ===========================================================  =========
symbol        quantity                                                     unit
============  ===========================================================  =========
T_k           r^(2k+1) (1/r d/dr)^k (T/r) = (D - 2k + 1) ... (D - 1) T     1/Pa
D             r d/dr                                                       -
I             mean of T over radii from 0 to r                             1/Pa
C_s, C_inf    limits of alpha C for long and short waves                   1/Pa
c             scale of the step that is subtracted                         m
============  ===========================================================  =========
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.special import loggamma

from . import layered
from .layer_stack import Base

__all__ = [
    "ORDERS",
    "Place",
    "PointLoad",
    "Radii",
    "Response",
    "cubic",
    "locate",
    "mean_to",
    "table",
    "table_of",
]

ORDERS = 5
"""Number of functions T_0, T_1 ... that are tabulated."""

# Modes in the logarithm of the wavenumber are below round-off at a frequency of 45 for layers of
# any contrast; more steps would only add noise to the derivatives.
_STEP = np.log(10.0) / 40.0
# Steps of the radius per step of the wavenumber. What the cubics between them leave of a
# coefficient falls with the fourth power: 2e-8 with 6, 1e-9 with 12, 4e-11 with 24, at contrasts up
# to 100; the table grows in proportion, and takes half as long again with 48.
_FINER = 24
# The range of alpha H and alpha h_1. Stacks whose moduli differ a million times need 1e-20 below
# (1e-13 leaves 3e-11 of the largest coefficient, 1e-8 4e-6); above, 1e4 to 1e20 agree to 4e-13.
# Both are wider, as they only lengthen a table of some ms.
_BELOW, _ABOVE = 1e-26, 1e16


class PointLoad(NamedTuple):
    """Cubics in the logarithm of the radius, on equal steps.

    Attributes
    ----------
    start : float
        Logarithm of the minimum radius.
    step : float
        Step of the logarithm.
    derivatives : ndarray, shape (ORDERS, 4, n_steps)
        Coefficients, constant first, of T_0 .. T_4 in the fraction of the step [1/Pa].
    mean : ndarray, shape (4, n_steps)
        Coefficients of the mean I.
    """

    start: float
    step: float
    derivatives: NDArray[np.float64]
    mean: NDArray[np.float64]


def table(
    young_modulus: NDArray[np.float64],
    poisson_ratio: NDArray[np.float64],
    thickness: NDArray[np.float64],
    min_radius: float,
    max_radius: float,
    base: Base | None = None,
) -> PointLoad:
    """Tabulate the displacement under a point load over a range of radii.

    Parameters
    ----------
    young_modulus, poisson_ratio : ndarray, shape (n_layers + 1,)
        Of the layers, top first, and of the substrate [Pa], [-].
    thickness : ndarray, shape (n_layers,)
        Of the layers [m]; at least one.
    min_radius, max_radius : float
        Ends of the table [m].
    base : {"bonded", "frictionless"}, optional
        Rigid base in place of a substrate.

    Returns
    -------
    PointLoad

    Notes
    -----
    The range of wavenumbers is so wide that the truncation error is below round-off: at the upper
    end T tends to C_inf like r / h_1 at the corresponding radii, at the lower end alpha C tends to
    C_s like alpha H times the contrast of moduli. The error of T is about 1e-14 of the larger of
    C_s and C_inf: ten digits remain far from a load on a layer a million times softer than the
    substrate.

    References
    ----------
    .. [1] A. J. S. Hamilton, Mon. Not. R. Astron. Soc. 312 (2000) 257-284, Appendix B: Hankel
       transforms on logarithms.

    Examples
    --------
    Far from a point load a layer is not felt: T tends to 2 (1 - nu^2) / E of the substrate.

    >>> E, nu, h = np.array([4.0, 1.0]), np.array([0.3, 0.3]), np.array([1.0])
    >>> load = table(E, nu, h, 1e-3, 1e4)
    >>> ends = load.derivatives[0, 0, [0, -1]]
    >>> [round(float(end), 3) for end in ends]
    [0.456, 1.82]
    """
    plane_compliance = 2.0 * (1.0 - poisson_ratio**2) / young_modulus

    def normal(alpha: NDArray[np.float64]) -> NDArray[np.float64]:
        return alpha * layered.compliance(alpha, young_modulus, poisson_ratio, thickness, base).C

    far = 0.0 if base else float(plane_compliance[-1])
    response = Response(normal, float(plane_compliance[0]), far)
    return table_of(response, thickness, Radii(min_radius, max_radius))


class Response(NamedTuple):
    """Wavenumber times a compliance [1/Pa], as a function of the wavenumber [1/m].

    `short` and `long` are its limits for short and for long waves.
    """

    at: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    short: float
    long: float


class Radii(NamedTuple):
    """Ends of a table [m]."""

    minimum: float
    maximum: float


def table_of(response: Response, thickness: NDArray[np.float64], radii: Radii) -> PointLoad:
    """Tabulate T of any compliance of a layered half-space, as `table` does that of the normal one.

    Parameters
    ----------
    response : Response
        Wavenumber times compliance [1/Pa].
    thickness : ndarray, shape (n_layers,)
        Of the layers [m]; at least one.
    radii : Radii
        Ends of the table [m].
    """
    c_inf, c_s = response.short, response.long
    scale = float(np.sum(thickness))
    low = min(_BELOW / scale, 0.1 / radii.maximum)
    high = max(_ABOVE / float(thickness[0]), 10.0 / radii.minimum)
    count = fft.next_fast_len(int(np.ceil(np.log(high / low) / _STEP)), real=True)
    # The Hankel transform is a convolution in logarithms of wavenumber and radius: one FFT gives
    # all radii over forty decades, with an error relative to T at every one. What is transformed is
    # the response less one whose transform is known (exp(-alpha H)), so that it vanishes at both
    # ends.
    alpha = low * np.exp(_STEP * np.arange(count))
    rest = response.at(alpha) - (c_inf + (c_s - c_inf) * np.exp(-alpha * scale))
    start = np.log(radii.minimum) - 2.0 * _STEP
    n_radii = int(np.ceil((np.log(radii.maximum) - start) * _FINER / _STEP)) + 2 * _FINER
    step = _STEP / _FINER
    radius = np.exp(start + step * np.arange(n_radii))
    modes = _modes(rest, np.log(low) + start)
    orders, mean = _rest_over_radius(modes, count, n_radii)
    root = np.hypot(radius, scale)
    ratio = radius / root
    for k in range(ORDERS + 1):
        odd = float(np.prod(np.arange(1.0, 2 * k, 2)))
        orders[k] += (-1) ** k * odd * (c_inf + (c_s - c_inf) * ratio ** (2 * k + 1))
    mean += c_inf + (c_s - c_inf) * radius / (root + scale)
    slopes = [orders[k + 1] + (2 * k + 1) * orders[k] for k in range(ORDERS)]
    cubics = [_hermite(orders[k], slopes[k], step) for k in range(ORDERS)]
    return PointLoad(start, step, np.array(cubics), _hermite(mean, orders[0] - mean, step))


def mean_to(load: PointLoad, radius: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean of T over radii from 0 to `radius` [1/Pa], from the table."""
    return cubic(load.mean, *locate(load, np.log(radius)))


class Place(NamedTuple):
    """Steps of the table, and the fractions of these steps."""

    step: NDArray[np.intp]
    fraction: NDArray[np.float64]


def locate(load: PointLoad, log_radius: NDArray[np.float64]) -> Place:
    """Step of the table in which a logarithm of a radius lies, and the fraction of the step."""
    place = (log_radius - load.start) / load.step
    index = place.astype(np.intp)
    place -= index
    return Place(index, place)


def cubic(
    coefficients: NDArray[np.float64], index: NDArray[np.intp], fraction: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Value of the cubics `coefficients` (4, n_steps) of step `index` at a `fraction` of it."""
    value: NDArray[np.float64] = coefficients[3].take(index)
    for row in coefficients[2::-1]:
        value *= fraction
        value += row.take(index)
    return value


def _modes(rest: NDArray[np.float64], shift: float) -> NDArray[np.complex128]:
    """Fourier modes of T of a response, over logarithms of radii that begin at exp(shift)/alpha."""
    modes = fft.rfft(rest) / rest.size
    omega = 2.0 * np.pi * np.arange(modes.size) / (rest.size * _STEP)
    phase = omega * (np.log(2.0) - shift) + 2.0 * loggamma(0.5 + 0.5j * omega).imag
    modes *= np.exp(1j * phase)
    if rest.size % 2 == 0:
        modes[-1] = 0.0  # the Nyquist mode is ambiguous between the samples
    return np.asarray(modes.conj())  # r^(-i omega): the sum over modes is an inverse transform


def _rest_over_radius(
    modes: NDArray[np.complex128], count: int, n_radii: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """T_0 .. T_5 and the mean I of the modes, on `n_radii` steps."""
    derivative = 2j * np.pi * np.arange(modes.size) / (count * _STEP)
    length = count * _FINER

    def sample(spectrum: NDArray[np.complex128]) -> NDArray[np.float64]:
        values = fft.irfft(spectrum, length) * length
        return np.asarray(np.resize(values, n_radii))

    orders = np.empty((ORDERS + 1, n_radii))
    spectrum = modes
    for k in range(ORDERS + 1):
        orders[k] = sample(spectrum)
        spectrum = spectrum * (derivative - (2 * k + 1))
    return orders, sample(modes / (1.0 + derivative))


def _hermite(
    value: NDArray[np.float64], slope: NDArray[np.float64], step: float
) -> NDArray[np.float64]:
    """Cubics through values and slopes on equal steps, in the fraction of the step."""
    rise, left, right = np.diff(value), step * slope[:-1], step * slope[1:]
    return np.array([value[:-1], left, 3.0 * rise - 2.0 * left - right, left + right - 2.0 * rise])
