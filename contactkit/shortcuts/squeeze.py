"""Time that a constant force takes to open or close a viscous film between flats."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, overload

import numpy as np

from ..arguments import check_shapes, plain, positive, positive_or_inf
from ..errors import DescriptionError
from ..lubrication.squeeze_film import disc_impulse_conserved, disc_impulse_flooded

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["squeeze_time"]

Closure = Literal["flooded", "volume-conserving"]


@overload
def squeeze_time(
    force: float | str,
    radius: float | str,
    viscosity: float | str,
    initial_gap: float | str,
    final_gap: float | str = ...,
    *,
    closure: Closure = ...,
) -> float: ...


@overload
def squeeze_time(
    force: ArrayLike | str,
    radius: ArrayLike | str,
    viscosity: ArrayLike | str,
    initial_gap: ArrayLike | str,
    final_gap: ArrayLike | str = ...,
    *,
    closure: Closure = ...,
) -> float | NDArray[np.float64]: ...


def squeeze_time(
    force: ArrayLike | str,
    radius: ArrayLike | str,
    viscosity: ArrayLike | str,
    initial_gap: ArrayLike | str,
    final_gap: ArrayLike | str = math.inf,
    *,
    closure: Closure = "flooded",
) -> float | NDArray[np.float64]:
    r"""Time that a constant force takes to move round flats through a viscous film [s].

    .. math:: t = \frac{1}{F} \left|\int F_v \, dt\right|
              = \frac{3\pi\eta r^4}{4 F} \left|\frac{1}{h_0^2} - \frac{1}{h_1^2}\right|

    Stefan's equation, the viscous force alone: the impulse of `lubrication.squeeze_film` over the
    force, as ``ViscousForce`` in a scene with ``ImposedForce`` and no mass. A force that pulls
    opens the gap, the same force pressing closes it in the same time.

    Parameters
    ----------
    force : float or array_like
        Force that pulls the flats apart, or presses them together [N].
    radius : float or array_like
        Radius r of the film at the initial gap [m].
    viscosity : float or array_like
        Dynamic viscosity [Pa.s].
    initial_gap, final_gap : float or array_like
        Distance of the flats at start and end [m]; the final one may be smaller, and inf when the
        flats are pulled apart.
    closure : {"flooded", "volume-conserving"}
        Whether the film keeps its radius, as flooded flats do, or its volume:
        :math:`t = \frac{3\pi\eta r^4}{8 F} h_0^2 |h_0^{-4} - h_1^{-4}|`.

    Returns
    -------
    float or ndarray
        Time [s], of the broadcast shape. Numbers may be texts with a unit.

    Raises
    ------
    DescriptionError
        If an argument is not positive; a gap of 0 is not reached in any time.

    Notes
    -----
    Newtonian, incompressible film between rigid flats without inertia, r/h > 5 and a reduced
    Reynolds number below 1; without the meniscus and without cavitation, which sets in where the
    mean tension F/(pi r^2) exceeds about half an atmosphere. `SeparationScene` includes them.

    Examples
    --------
    A plate of 6.35 mm pulled off a film of oil of 2 um by 40 N:

    >>> import contactkit as ck
    >>> round(ck.squeeze_time(40.0, "3.175 mm", "0.1 Pa.s", "2 um"), 4)
    0.1496
    """
    where = "squeeze_time"
    pull = positive(f"{where}(force)", force, "N")
    r = positive(f"{where}(radius)", radius, "m")
    eta = positive(f"{where}(viscosity)", viscosity, "Pa.s")
    first = positive(f"{where}(initial_gap)", initial_gap, "m")
    last = positive_or_inf(f"{where}(final_gap)", final_gap, "m")
    check_shapes(where, pull, r, eta, first, last)
    if closure not in ("flooded", "volume-conserving"):
        expected = "be 'flooded' or 'volume-conserving'"
        raise DescriptionError(f"{where}(closure)", closure, expected)
    if closure == "flooded":
        impulse = disc_impulse_flooded(r, first, last, eta)
    else:
        impulse = disc_impulse_conserved(math.pi * r**2 * first, first, last, eta)
    return plain(np.abs(impulse) / pull)
