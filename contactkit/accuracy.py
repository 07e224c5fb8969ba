"""Numerical settings of a plan: tolerances, grids, solver. Physics belongs to the scene."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from typing import Any, ClassVar, Literal

from attrs import Attribute, evolve, field, frozen

from .reading.limits import check_limit
from .units import si
from .validators import Described, as_number, as_pair, as_whole, choice, count, optional, refuse

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


_LEVELS: dict[str, dict[str, Any]] = {
    "draft": {
        "time_rtol": 1e-5,
        "points": 50,
        "curve_rtol": 1e-2,
        "max_steps": 100_000,
        "film_rtol": 1e-2,
        "grid": None,
        "rtol": 1e-4,
        "method": "active-set",
        "max_iterations": 10_000,
        "threads": 1,
    },
}
_LEVELS["standard"] = _LEVELS["draft"] | {
    "time_rtol": 1e-8,
    "points": 200,
    "curve_rtol": 1e-3,
    "film_rtol": 1e-3,
    "rtol": 1e-8,
}
_LEVELS["reference"] = _LEVELS["draft"] | {
    "time_rtol": 1e-11,
    "points": 1000,
    "curve_rtol": 1e-4,
    "film_rtol": 1e-4,
    "rtol": 1e-10,
}
# In place of a setting that is not given; the class fills in that of the level.
_OF_LEVEL: Any = None


@frozen(kw_only=True)
class Accuracy(Described):
    """Numerical settings of a plan, by a level.

    The first five are of separations, of which a sliding reads `points` and `curve_rtol`; the
    others are of contacts. A loading and an effect state which they read (`Loading.reads`,
    `Effect.reads`): a setting that is given and that nothing of the scene reads is refused when it
    is planned; those of the level fit every scene.

    Parameters
    ----------
    level : {"draft", "standard", "reference"}
        Level of the settings that are not given; `Accuracy.draft` is ``Accuracy(level="draft")``.
    time_rtol : float
        Tolerance of the local error of a time step, relative to the gap, the speed, the momentum
        transferred and the viscous impulse [-]. Of a thousand random pulls, release times and
        impulses were within it, release speeds and last forces within twice. A mass that swings on
        its spring before the release multiplies the error. By level 1e-5, 1e-8, 1e-11.
    points : int
        Points of a curve over the gap (imposed speed or time). By level 50, 200, 1000.
    curve_rtol : float
        Largest distance of the motion from a straight line between neighbouring points of a curve
        of a separation, relative to the gap for the gap and to its range for each other curve [-].
        Points are added where they are needed and left out where they are not. By level 1e-2, 1e-3,
        1e-4.
    max_steps : int
        Maximum number of time steps of an integration; 100 000 at each level.
    film_rtol : float
        Error of the force of a film that is solved on a grid, of a face without a closed form [-];
        it decides how many cells there are. Of a separation. By level 1e-2, 1e-3, 1e-4.
    grid : int or (int, int), optional
        Pixels of the window of a contact, (ny, nx) or one number for both. None: those of the
        measured surface, else 256. Also the cells over the film of `ElasticBodies` on a map; None:
        those of the measured surface, else eight in the shortest wave, 64 to 512.
    rtol : float
        Maximum violation of the contact conditions, relative to the rms height of the surface
        [-]: overlap, or a gap under pressure. The tolerance of the outer iterations (hardness,
        friction, film) is 100 `rtol`, relative to the quantity they change. By level 1e-4, 1e-8,
        1e-10.
    method : {"active-set", "quasi-newton", "conjugate-gradient"}
        Solver of the contact; the last two are references for comparison. Active-set at each level.
    max_iterations : int
        Maximum number of iterations of a reference solver of the contact; 10 000 at each level.
    threads : int
        Threads of the Fourier transforms of a contact; 1 at each level.

    Examples
    --------
    >>> Accuracy.standard.time_rtol, Accuracy(level="draft", grid=64).rtol
    (1e-08, 0.0001)
    """

    level: Literal["draft", "standard", "reference"] = field(
        default="standard", validator=choice(*_LEVELS), eq=False
    )
    time_rtol: float = field(
        default=_OF_LEVEL, converter=as_number, validator=optional(_tolerance), metadata=si("-")
    )
    points: int = field(
        default=_OF_LEVEL, converter=as_whole, validator=optional(_points), metadata=si("-")
    )
    curve_rtol: float = field(
        default=_OF_LEVEL, converter=as_number, validator=optional(_curve_error), metadata=si("-")
    )
    max_steps: int = field(
        default=_OF_LEVEL, converter=as_whole, validator=optional(count), metadata=si("-")
    )
    film_rtol: float = field(
        default=_OF_LEVEL, converter=as_number, validator=optional(_curve_error), metadata=si("-")
    )

    grid: int | tuple[int, int] | None = field(
        default=None, converter=_as_grid, validator=_grid, metadata=si("-")
    )
    rtol: float = field(
        default=_OF_LEVEL, converter=as_number, validator=optional(_tolerance), metadata=si("-")
    )
    method: Literal["active-set", "quasi-newton", "conjugate-gradient"] = field(
        default=_OF_LEVEL,
        validator=optional(choice("active-set", "quasi-newton", "conjugate-gradient")),
    )
    max_iterations: int = field(
        default=_OF_LEVEL, converter=as_whole, validator=optional(count), metadata=si("-")
    )
    threads: int = field(
        default=_OF_LEVEL, converter=as_whole, validator=optional(count), metadata=si("-")
    )
    # Level and names of the settings that were given, which `evolve` and files hand on; None: every
    # setting that is not None was given.
    _origin: tuple[str, frozenset[str]] | None = field(default=None, repr=False, eq=False)

    def __attrs_post_init__(self) -> None:
        """Fill in the settings of the level, and note which others were given."""
        level, names = self._origin or ("", frozenset())
        before, usual, given = _LEVELS.get(level), _LEVELS[self.level], set(names)
        for name, value in usual.items():
            own = getattr(self, name)
            # A copy with changes comes with every value: one that its level has not was given.
            if own is not None and (before is None or own != before[name]):
                given.add(name)
            if name not in given:
                object.__setattr__(self, name, value)
        object.__setattr__(self, "_origin", (self.level, frozenset(given)))

    @property
    def given(self) -> frozenset[str]:
        """Names of the settings that were given beside the level."""
        return self._origin[1] if self._origin else frozenset()

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

    @property
    def values(self) -> dict[str, Any]:
        """All settings by name, those of the level among them."""
        return {name: getattr(self, name) for name in _LEVELS[self.level]}

    def with_given(self, names: Iterable[str]) -> Accuracy:
        """Return the same, its settings of these names given though they have their usual value."""
        return evolve(self, origin=(self.level, self.given.union(names) - {"level"}))

    def unread(self, read: Container[str]) -> str:
        """Name of a setting that is given and is not among those that are read; or empty."""
        return next((n for n in self.values if n in self.given and n not in read), "")

    def saved(self) -> dict[str, Any]:
        """The settings as plain values for a file: all of them, the level, which were given."""
        return self.values | {"level": self.level, "given": sorted(self.given)}

    @classmethod
    def of_file(cls, saved: Mapping[str, Any]) -> Accuracy:
        """Return what `saved` gave; a file of before version 0.2 names no level: the nearest."""
        values = dict(saved)
        if "level" not in values:
            same = {
                level: sum(value == values.get(name) for name, value in usual.items())
                for level, usual in _LEVELS.items()
            }
            values |= {"level": max(same, key=same.__getitem__), "given": ()}
        origin = (values["level"], frozenset(values.pop("given")))
        return cls(**values, origin=origin)

    draft: ClassVar[Accuracy]
    standard: ClassVar[Accuracy]
    reference: ClassVar[Accuracy]


Accuracy.draft = Accuracy(level="draft")
Accuracy.standard = Accuracy()
Accuracy.reference = Accuracy(level="reference")
