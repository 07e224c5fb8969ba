r"""Viscous forces of chapter 3 as printed, by equation number, for reproduction only.

Conventions: forces in N, positive when they resist separation, so that the minus signs printed in
Eqs. (3.18), (3.19) and (3.34) are dropped. The viscous force "at break" is an impulse over the
separation time. The correct forms are in `lubrication.squeeze_film`.
"""

from __future__ import annotations

import math
from typing import Any

from ...errors import InfeasibleError

__all__ = [
    "viscous_divided_3_34",
    "viscous_flat_3_18",
    "viscous_flat_3_19",
    "viscous_number_3_43",
    "viscous_sphere_3_22",
    "viscous_sphere_3_26",
    "viscous_sphere_3_27",
]


def _open(gap: Any, number: str) -> None:
    smallest = gap.min(initial=math.inf) if hasattr(gap, "min") else gap
    if not smallest > 0.0:
        raise InfeasibleError(
            f"Eq. ({number}) has no finite value at a gap of zero: it grows as the gap falls"
        )


def _log1p(x: Any) -> Any:
    if isinstance(x, float | int):
        return math.log1p(x)
    import numpy as np

    return np.log1p(x)


def viscous_flat_3_18(radius: Any, gap: Any, speed: Any, viscosity: Any) -> Any:
    r"""Viscous force [N] on opening flats, :math:`3\pi\eta x^4\dot h/(2h^3)`, Eq. (3.18).

    Stefan's law, correct for x/h > 5; viscosity [Pa.s], speed [m/s], positive on opening.

    Examples
    --------
    >>> round(viscous_flat_3_18(1.0, 1.0, 2.0, 1.0) / math.pi, 12)
    3.0
    """
    return 1.5 * math.pi * viscosity * radius**4 * speed / gap**3


def viscous_flat_3_19(
    radius: Any, gap_start: Any, gap_end: Any, separation_time: Any, viscosity: Any
) -> Any:
    r"""Impulse of opening flats over the separation time [N], Eq. (3.19); `gap_end` may be inf.

    .. math:: \frac{3\pi\eta x^4}{4 t_s}\Bigl(\frac{1}{h_0^2} - \frac{1}{h_s^2}\Bigr)

    An average over time, at constant radius: not an instantaneous force.

    Examples
    --------
    >>> round(viscous_flat_3_19(100e-9, 2e-9, math.inf, 1e-7, 0.89e-3) * 1e9, 6)
    524.253274
    """
    ratio = gap_start / gap_end
    open_ended = 0.75 * math.pi * viscosity * radius**4 / (separation_time * gap_start**2)
    return open_ended * (1.0 - ratio) * (1.0 + ratio)


def viscous_divided_3_34(
    radius: Any, gap_start: Any, gap_end: Any, separation_time: Any, viscosity: Any, number: Any
) -> Any:
    """Impulse over time [N] of a film divided into equal menisci, Eq. (3.34).

    That of Eq. (3.19) over the number, with the rupture gap of the smaller menisci.

    Examples
    --------
    >>> whole = viscous_flat_3_19(1.0, 1.0, 2.0, 1.0, 1.0)
    >>> viscous_divided_3_34(1.0, 1.0, 2.0, 1.0, 1.0, 4) / whole
    0.25
    """
    return viscous_flat_3_19(radius, gap_start, gap_end, separation_time, viscosity) / number


def viscous_sphere_3_22(
    sphere_radius: Any, gap: Any, film_height: Any, speed: Any, viscosity: Any
) -> Any:
    r"""Viscous force [N] on a sphere, :math:`6\pi\eta R^2(1-D/H)^2\dot D/D`, Eq. (3.22).

    Correct for thin films; `film_height` H [m] is the film height at the rim.

    Examples
    --------
    >>> round(viscous_sphere_3_22(1.0, 1.0, 2.0, 1.0, 1.0) / math.pi, 12)
    1.5
    """
    _open(gap, "3.22")
    open_fraction = (film_height - gap) / film_height
    return (
        6.0 * math.pi * viscosity * sphere_radius**2 * open_fraction * open_fraction * speed / gap
    )


def viscous_sphere_3_26(
    sphere_radius: Any,
    gap_start: Any,
    film_height: Any,
    gap_end: Any,
    separation_time: Any,
    viscosity: Any,
) -> Any:
    r"""Impulse of a lifted sphere over the separation time [N], Eq. (3.26); `gap_end` may be inf.

    .. math::
        \frac{6\pi\eta R^2}{t_s}\ln\frac{D_s(D_0+H_0)^2 S}{D_0H_0(D_s+S)^2}, \qquad
        S = \sqrt{H_0^2 - D_0^2 + D_s^2}

    written as a difference of ``log1p``, which is accurate also for films hardly thicker than the
    gap. The integral of Eq. (3.22) at constant volume: an average over time, not a force.

    Raises
    ------
    InfeasibleError
        For a gap of zero at the start, where it is infinite.

    Examples
    --------
    >>> force = viscous_sphere_3_26(100e-9, 1e-9, 2e-9, 39e-9, 1e-7, 0.89e-3)
    >>> round(force * 1e9, 6)
    0.197594
    """
    _open(gap_start, "3.26")
    rest = (film_height - gap_start) * (film_height + gap_start)
    end = (rest + gap_end**2) ** 0.5
    first = (film_height - gap_start) ** 2 / (4.0 * gap_start * film_height)
    last = (rest / (end + gap_end)) ** 2 / (4.0 * gap_end * end)
    scale = 6.0 * math.pi * viscosity * sphere_radius**2 / separation_time
    return scale * (_log1p(first) - _log1p(last))


def viscous_sphere_3_27(
    sphere_radius: Any, gap_start: Any, film_height: Any, separation_time: Any, viscosity: Any
) -> Any:
    r"""Printed, incorrect limit of Eq. (3.26) for rupture far away [N], Eq. (3.27).

    .. math:: \frac{6\pi\eta R^2}{t_s}\ln\frac{H_0}{2 D_0}

    Raises
    ------
    InfeasibleError
        For a gap of zero at the start, where it is infinite.

    Examples
    --------
    >>> viscous_sphere_3_27(100e-9, 1e-9, 2e-9, 1e-7, 0.89e-3)
    0.0
    """
    _open(gap_start, "3.27")
    scale = 6.0 * math.pi * viscosity * sphere_radius**2 / separation_time
    return scale * _log1p((film_height - 2.0 * gap_start) / (2.0 * gap_start))


def viscous_number_3_43(
    force: Any, radius: Any, gap_start: Any, separation_time: Any, viscosity: Any
) -> Any:
    r"""Dimensionless viscous force, :math:`4t_sh_0^2F_v/(3\pi\eta x_{n0}^4)`, Eq. (3.43).

    Examples
    --------
    >>> far = viscous_flat_3_19(1.0, 1.0, math.inf, 1.0, 1.0)
    >>> round(viscous_number_3_43(far, 1.0, 1.0, 1.0, 1.0), 12)
    1.0
    """
    scale = 3.0 * math.pi * viscosity * radius**4
    return 4.0 * separation_time * gap_start**2 * force / scale
