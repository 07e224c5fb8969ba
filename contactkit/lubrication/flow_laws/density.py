"""Density over pressure: Dowson and Higginson."""

from __future__ import annotations

from typing import Any

__all__ = ["dowson_higginson"]


def dowson_higginson(
    pressure: Any, compressibility: Any = 0.6e-9, stiffening: Any = 1.7e-9
) -> tuple[Any, Any]:
    r"""Density over that at ambient pressure, and its slope over the pressure.

    .. math:: \frac{\rho}{\rho_0} = 1 + \frac{c \, p}{1 + d \, p}

    Parameters
    ----------
    pressure : float or ndarray
        Pressure relative to ambient [Pa].
    compressibility : float
        c [1/Pa], at ambient pressure; the default is of mineral oils.
    stiffening : float
        d [1/Pa].

    Returns
    -------
    ratio, slope : float or ndarray
        Ratio [-] and its slope [1/Pa].

    Notes
    -----
    Fitted to oils between 0 and 0.4 GPa. In tension the compressibility stays that at ambient
    pressure, the law's tangent: its fraction has a pole at -1/d. The flux of a squeezed film leaves
    compression out; it is small where the largest relative change of the density is.

    References
    ----------
    Dowson and Higginson (1966), Elasto-Hydrodynamic Lubrication; Hamrock, Fundamentals of Fluid
    Film Lubrication, Eq. (4.19).

    Examples
    --------
    >>> ratio, slope = dowson_higginson(1e9)
    >>> round(ratio, 4), round(slope * 1e9, 4)
    (1.2222, 0.0823)
    >>> dowson_higginson(-1e6)[0]
    0.9994
    """
    above = 0.5 * (pressure + abs(pressure))
    below = pressure - above
    wide = 1.0 + stiffening * above
    ratio = 1.0 + compressibility * (above / wide + below)
    return ratio, compressibility / (wide * wide)
