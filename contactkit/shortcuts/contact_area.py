"""Real area of contact of a rough surface under a pressure: `contact_area`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..arguments import single
from ..contact.press import press
from ..scene.materials import Material

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ..scene.topography import Topography
    from ..scene.window import Edges

__all__ = ["contact_area"]


def contact_area(
    heights: ArrayLike | Topography,
    pixel_size: float | str | tuple[float | str, float | str] | None,
    pressure: float | str,
    modulus: float | str,
    *,
    hardness: Any = None,
    periodic: Edges | None = None,
) -> float:
    r"""Real area of contact of a rough surface pressed on a flat [m2].

    .. math:: A = \int [p > 0] \, dA, \qquad
              \frac{1}{E^*} = \frac{1 - \nu_1^2}{E_1} + \frac{1 - \nu_2^2}{E_2}

    The contact is solved by `press`, for half-spaces of the contact modulus E*; what it finds
    beside the area (pressure, gap, validity) is returned by `press` itself.

    Parameters
    ----------
    heights : array_like (ny, nx), or topography
        Heights [m] of the rough surface, peaks up, as in `press`.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx). None with a topography.
    pressure : float
        Mean pressure over the map [Pa].
    modulus : float
        Contact modulus E* of both bodies [Pa].
    hardness : float or array (ny, nx), optional
        Upper bound of the pressure [Pa]; None: elastic.
    periodic : bool, "x" or "y", optional
        As in `press`.

    Returns
    -------
    float
        Area [m2], edge-corrected: `ContactResult.corrected_contact_area`. Divided by the area of
        the map it is the fraction in contact.

    Raises
    ------
    DescriptionError
        If an argument is out of range.
    InfeasibleError
        If the hardness cannot carry the load.

    Warns
    -----
    ValidityWarning
        If the map does not resolve the contact, or another number of `press` is out of range.

    Notes
    -----
    Linear elastic half-spaces in frictionless contact without adhesion; small slopes. At small
    loads the area of a Gaussian surface is about :math:`\sqrt{2\pi}\, p A_0/E^* h'`.

    Examples
    --------
    >>> import numpy as np
    >>> import contactkit as ck
    >>> x = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    >>> waves = 1e-8 * np.cos(x)[None, :] * np.cos(x)[:, None]
    >>> area = ck.contact_area(waves, 1e-6 / 64, pressure="500 MPa", modulus="100 GPa")
    >>> f"{area:.2e} m2 of 1e-12 m2"
    '2.12e-13 m2 of 1e-12 m2'
    """
    contact_modulus = single("contact_area(modulus)", modulus, "Pa")
    mean = single("contact_area(pressure)", pressure, "Pa")
    solid = Material(young_modulus=contact_modulus, poisson_ratio=0.0)
    result = press(heights, pixel_size, solid, mean, hardness, periodic)
    return result.corrected_contact_area
