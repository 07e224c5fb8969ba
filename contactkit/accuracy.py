"""Numerical settings of a plan: tolerances, grids, solver. Physics belongs to the scene."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from attrs import Attribute, field, frozen

from .reading.limits import check_limit
from .units import si
from .validators import Described, as_number, as_pair, as_whole, choice, count, refuse

__all__ = ["Accuracy"]


def _tolerance(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 1e-11 <= value <= 0.1:
        raise refuse(owner, attribute, value, "lie between 1e-11 and 0.1")


def _curve_error(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 1e-6 <= value <= 0.1:
        raise refuse(owner, attribute, value, "lie between 1e-6 and 0.1")


def _as_grid(value: Any) -> Any:
    made = as_pair(value)
    return tuple(as_whole(n) for n in made) if isinstance(made, tuple) else as_whole(made)


def _grid(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if value is None:
        return
    for item in value if isinstance(value, tuple) else (value,):
        if isinstance(item, bool) or not isinstance(item, int) or item < 2:
            raise refuse(owner, attribute, value, "be a whole number of at least 2, or (ny, nx)")
    if isinstance(value, tuple) and len(value) != 2:
        raise refuse(owner, attribute, value, "be one number or a pair (ny, nx)")
    n = value[0] * value[1] if isinstance(value, tuple) else value * value
    check_limit("PIXELS", n, f"grid = {value}", "Accuracy.grid")


def _points(owner: object, attribute: Attribute[Any], value: Any) -> None:
    count(owner, attribute, value)
    check_limit("POINTS", value, f"points = {value}", "Accuracy.points")


_READ_BY = {
    "separation": ("time_rtol", "points", "curve_rtol", "max_steps", "film_rtol"),
    "contact": ("grid", "rtol", "method", "max_iterations"),
}


@frozen(kw_only=True)
class Accuracy(Described):
    """Numerical settings of a plan; the first five apply to separation, the others to contact.

    Parameters
    ----------
    time_rtol : float
        Tolerance of the local error of a time step, relative to the gap, the speed, the momentum
        transferred and the viscous impulse [-]. Of a thousand random pulls, release times and
        impulses were within it, release speeds and last forces within twice. A mass that swings on
        its spring before the release multiplies the error.
    points : int
        Points of a curve over the gap (imposed speed or time).
    curve_rtol : float
        Largest distance of the motion from a straight line between neighbouring points of a curve
        of a separation, relative to the gap for the gap and to its range for each other curve [-].
        Points are added where they are needed and left out where they are not.
    max_steps : int
        Maximum number of time steps of an integration.
    film_rtol : float
        Error of the force of a film that is solved on a grid, of a face without a closed form [-];
        it decides how many cells there are. Of a separation.
    grid : int or (int, int), optional
        Pixels of the window of a contact, (ny, nx) or one number for both. None: those of the
        measured surface, else 256. Also the cells over the film of `ElasticBodies` on a map; None:
        those of the measured surface, else eight in the shortest wave, 64 to 512.
    rtol : float
        Maximum violation of the contact conditions, relative to the rms height of the surface
        [-]: overlap, or a gap under pressure. The tolerance of the outer iterations (hardness,
        friction, film) is 100 `rtol`, relative to the quantity they change.
    method : {"active-set", "quasi-newton", "conjugate-gradient"}
        Solver of the contact; the last two are references for comparison.
    max_iterations : int
        Maximum number of iterations of a reference solver of the contact.
    threads : int
        Threads of the Fourier transforms.

    Examples
    --------
    >>> Accuracy.standard.time_rtol
    1e-08
    """

    time_rtol: float = field(
        default=1e-8, converter=as_number, validator=_tolerance, metadata=si("-")
    )
    points: int = field(default=200, converter=as_whole, validator=_points, metadata=si("-"))
    curve_rtol: float = field(
        default=1e-3, converter=as_number, validator=_curve_error, metadata=si("-")
    )
    max_steps: int = field(default=100_000, converter=as_whole, validator=count, metadata=si("-"))
    film_rtol: float = field(
        default=1e-3, converter=as_number, validator=_curve_error, metadata=si("-")
    )

    grid: int | tuple[int, int] | None = field(
        default=None, converter=_as_grid, validator=_grid, metadata=si("-")
    )
    rtol: float = field(default=1e-8, converter=as_number, validator=_tolerance, metadata=si("-"))
    method: Literal["active-set", "quasi-newton", "conjugate-gradient"] = field(
        default="active-set", validator=choice("active-set", "quasi-newton", "conjugate-gradient")
    )
    max_iterations: int = field(
        default=10_000, converter=as_whole, validator=count, metadata=si("-")
    )
    threads: int = field(default=1, converter=as_whole, validator=count, metadata=si("-"))

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels (ny, nx) of a window without a measured surface."""
        if isinstance(self.grid, tuple):
            return self.grid
        n = self.grid if self.grid is not None else 256
        return (n, n)

    @property
    def outer_rtol(self) -> float:
        """Tolerance of the outer iterations, relative to the quantity they change [-]."""
        return min(100.0 * self.rtol, 0.1)

    def foreign(self, kind: Literal["contact", "separation"], *, takes_grid: bool = False) -> str:
        """Name of a setting that scenes of a kind do not read and that no level has; or empty.

        A level, such as `draft`, sets both kinds, and fits either. Some separations take `grid`.
        """
        levels = (Accuracy.draft, Accuracy.standard, Accuracy.reference)
        return next(
            (
                name
                for name in _READ_BY["separation" if kind == "contact" else "contact"]
                if not (takes_grid and name == "grid")
                and all(getattr(self, name) != getattr(level, name) for level in levels)
            ),
            "",
        )

    draft: ClassVar[Accuracy]
    standard: ClassVar[Accuracy]
    reference: ClassVar[Accuracy]


Accuracy.draft = Accuracy(time_rtol=1e-5, points=50, curve_rtol=1e-2, film_rtol=1e-2, rtol=1e-4)
Accuracy.standard = Accuracy()
Accuracy.reference = Accuracy(
    time_rtol=1e-11, points=1000, curve_rtol=1e-4, film_rtol=1e-4, rtol=1e-10
)
