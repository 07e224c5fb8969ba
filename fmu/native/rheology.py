"""Films whose viscosity follows pressure and shear, as the tables that the C kernel reads.

The force of such a film is that at the viscosity at rest times a ratio of gap and speed. Films that
keep their rim, films that draw in, and those in which the fastest shear is at the rim, or inside it
under a sphere, have tables of their own: the ratio has a kink between them. A film on a face that
is no disc is one stretch.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ...errors import ConvergenceError, PlanError
from ...lubrication.flow_laws.carreau import Carreau
from ...lubrication.flow_laws.eyring import Eyring
from ...lubrication.flow_laws.newtonian import Newtonian
from ...lubrication.flow_laws.power_law import PowerLaw
from ...lubrication.flow_laws.pressure_laws import Barus
from ...numerics.roots import bracketed_root
from ...scene.scenes import SeparationScene
from ...separation.effects.prepared import PreparedScene
from ...separation.rheology.changes import PARTS, film_of
from ...separation.rheology.face import FaceRheology, resolved
from ...separation.rheology.film import RheologicalFilm
from ...separation.rheology.prepared_film import PreparedFilm
from ..slaves.rheology import is_rheological
from .ratios import TOLERANCE, Axes, Units, ratio
from .records import Ratio, Rheology, Scaling, Stretch

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = [
    "FASTEST",
    "AnyFilm",
    "check_face",
    "film_in_hosts",
    "nearest_gap",
    "rheological_film",
    "rheology_record",
    "scaling_of",
]

AnyFilm = RheologicalFilm | FaceRheology


FASTEST = 10.0
"""Speed [m/s] at a third of the gap at the start, up to which the tables go there.

At other gaps they go to that times their units of the speed.
"""

_NEARER = 1.0 / 3.0  # of the gap at the start: a mass that closes meets thinner films
_SMALLEST = 1e-13  # [m]
_FAR_NEARER, _NEARER_BY_TABLE = 1e-3, 0.03  # of the gap at the start
_NEARER_ON_FACE = 0.1  # the reach of the table of `FaceFilm`
_CORRECTED = 1e9
"""Rate of shear [1/s] beyond which the correction of an estimate stays, which no law was measured
at."""
_ONSET = 1e-7  # of a logarithm, below which it goes on as a power of the speed
_SLOWEST = 18.0  # decades of the speed in which the onset is looked for
_NEAREST = math.log(1e3)  # ln r/(1 - r): speeds 1e-3 below a pole
_NEAREST_ON_FACE = math.log(30.0)  # where groups of cells leave 1e-4; 2e-3 at 1e-3 of the pole
_SOLID = 10.0  # logarithm of a viscosity over that at rest, beyond which no film is driven out
_COSTLY = 2e-5  # error of a ratio, each of which takes 1 ms or more
_BISECTIONS = 36  # from decades of the speed to 1e-10 of it
_LEVEL = 0.999  # of the gap at which a film that keeps its height at the rim ends


def rheological_film(prepared: PreparedScene[SeparationScene]) -> AnyFilm | None:
    """Film of a scene with all of the rheology of its liquid; None of a Newtonian one."""
    if not is_rheological(prepared.scene):
        return None
    return film_of(prepared, tuple(part.name for part in PARTS))


def check_face(film: AnyFilm) -> None:
    """Refuse a film on a face that is no disc which tables do not hold.

    With pressure and shear together its estimate and its solution close as fast as they can at
    speeds of their own, and its tables would take minutes.

    Raises
    ------
    PlanError
        With the cure.
    """
    is_newtonian, has_pressure = isinstance(film.law, Newtonian), film.law.pressure_law is not None
    if isinstance(film, RheologicalFilm) or is_newtonian or not has_pressure:
        return
    raise PlanError(
        "on a face that is no disc a native FMU knows a viscosity over pressure or one over shear, "
        "not pressure_viscosity beside shear_viscosity; leave one of them out of the liquid, or "
        'both by ViscousForce(rheology="newtonian"), or run the scene with ck.simulate'
    )


def scaling_of(film: AnyFilm) -> Scaling:
    """Argument of the ratio of a film whose viscosity at rest is another one.

    A liquid that thins at a rate of shear has a ratio of the speed; one that thins at a stress or
    thickens with pressure, of speed times viscosity, as that sets stresses. A pressure that is
    truncated is a stress, too. Both together, and Roelands' law, whose exponent is of the
    viscosity, have a table for one viscosity alone.
    """
    law, pressure = film.law, film.law.pressure_law
    if isinstance(law, Newtonian | Eyring) and (pressure is None or isinstance(pressure, Barus)):
        return Scaling.STRESS
    by_rate = isinstance(law, Carreau | PowerLaw) and pressure is None
    return Scaling.SPEED if by_rate and math.isinf(film.strength) else Scaling.NONE


def nearest_gap(film: AnyFilm, start: float) -> float:
    """Smallest gap [m] of the tables of a film, for motions from a gap [m] on.

    The ratios of most films between flats are of one variable, and known at any gap.
    """
    one_variable = film.has_one_variable or _is_flat_newtonian(film)
    far = one_variable and math.isinf(film.strength)
    nearer = _NEARER_BY_TABLE if isinstance(film, RheologicalFilm) else _NEARER_ON_FACE
    return max(_SMALLEST, (_FAR_NEARER if far else nearer) * start)


def film_in_hosts(prepared: PreparedFilm, lowest: float, start: float) -> PreparedFilm:
    """Film whose grids are fine enough for any motion from a gap [m] on, down to a lowest [m].

    On a face that is no disc those of a scene are of the motion that its loading lets expect.
    """
    film = prepared.film
    if isinstance(film, RheologicalFilm):
        return prepared
    near = max(lowest, _NEARER * start)
    fastest = min(FASTEST * film.shear_per_speed(near), _CORRECTED)
    path = [(gap, fastest / film.shear_per_speed(gap)) for gap in (near, start)]
    film = resolved(film, path, film.full.rtol, fastest)
    return evolve(prepared, film=film)


def rheology_record(prepared: PreparedFilm, gaps: tuple[float, float], start: float) -> Rheology:
    """Ratios of the forces of a film between two gaps [m], for motions from a gap [m] on.

    Raises
    ------
    ConvergenceError
        If a ratio is too rough for a table.
    """
    film = prepared.film
    high = min(gaps[1], _LEVEL * film.shape.level)
    marks = [gaps[0], *(h for h in _marks(film, gaps[0], high) if gaps[0] < h < high), high]
    fast = max(gaps[0], _NEARER * start)
    stretches = [_stretch(prepared, ends, fast) for ends in pairwise(marks)]
    return Rheology(scaling=scaling_of(film), viscosity=film.viscosity, stretches=tuple(stretches))


def _marks(film: AnyFilm, low: float, high: float) -> list[float]:
    """Gaps [m] at which the ratio has a kink."""
    shape, found = film.shape, list[float]()
    if isinstance(film, FaceRheology):
        return found
    if 0.0 < shape.full_gap < math.inf:
        found.append(shape.full_gap)
    sphere = shape.sphere_radius
    if math.isfinite(sphere):
        # The fastest shear is at a height of 4/3 of the gap, where the film reaches as far.
        def beyond(gap: float) -> float:
            return min(shape.height(gap), 1e3) - 4.0 / 3.0 * gap

        ends = [low, *(h for h in found if low < h < high), high]
        found += [
            bracketed_root(beyond, *pair) for pair in pairwise(ends) if _changes(beyond, *pair)
        ]
    return sorted(found)


def _changes(function: Callable[[float], float], low: float, high: float) -> bool:
    return function(low) * function(high) < 0.0


def _stretch(prepared: PreparedFilm, gaps: tuple[float, float], fast: float) -> Stretch:
    film = prepared.film
    has_pressure = film.law.pressure_law is not None
    return Stretch(
        high=gaps[1],
        opening=_full(film, gaps, fast),
        closing=_closing(film, gaps) if has_pressure else None,
        cavity=_cavity(prepared, gaps, fast) if math.isfinite(film.strength) else None,
    )


def _full(film: AnyFilm, gaps: tuple[float, float], fast: float) -> Ratio:
    """Logarithm of the force over the linear one, while the film opens."""
    units = Units(lambda rows: _unit(film, rows))
    function = _logarithm(film, 1.0)
    highest = math.log(FASTEST) - float(_unit(film, np.array([fast]))[0])
    return ratio(function, units, _axes(film, function, units, gaps, highest), _rtol(film))


def _rtol(film: AnyFilm) -> float:
    """Error of a table: pressure and shear together take some 3 ms for each of its nodes.

    On a face the film is known by groups of cells and cubics, which are no smoother.
    """
    both = film.law.pressure_law is not None and not isinstance(film.law, Newtonian)
    return _COSTLY if both or isinstance(film, FaceRheology) else TOLERANCE


def _unit(film: AnyFilm, gaps: Floats) -> Floats:
    """Logarithms of speeds [m/s]: of a shear of 1 1/s, or where pressure alone counts, of 1/alpha.

    That pressure is the one on the axis at the viscosity at rest.
    """
    law = film.law
    if law.pressure_law is None or not isinstance(law, Newtonian):
        return -np.log([film.shear_per_speed(h) for h in gaps.tolist()])
    return np.asarray(-np.log(law.pressure_law.coefficient * film.linear_pressures(gaps)))


def _logarithm(film: AnyFilm, sign: float) -> Callable[[Floats, Floats], Floats]:
    def logarithm(gap: Floats, speed: Floats) -> Floats:
        force, linear = film.forces(gap, sign * speed)
        return np.asarray(np.log(np.abs(force / linear)))

    return _of_one(logarithm) if film.has_one_variable or _is_flat_newtonian(film) else logarithm


def _of_one(
    function: Callable[[Floats, Floats], Floats],
) -> Callable[[Floats, Floats], Floats]:
    """Function that is one at each ratio of speed and unit, whatever the gap."""
    return lambda gap, speed: np.broadcast_to(function(gap[:, :1], speed[:, :1]), gap.shape)


def _is_flat_newtonian(film: AnyFilm) -> bool:
    """Whether the ratio is of the highest pressure alone."""
    return isinstance(film.law, Newtonian) and film.is_even


def _axes(
    film: AnyFilm,
    function: Callable[[Floats, Floats], Floats],
    units: Units,
    gaps: tuple[float, float],
    highest: float,
) -> Axes:
    """Axes from where a ratio begins to matter to the highest logarithm of the speed."""
    rows = np.array([gaps[0], math.sqrt(gaps[0] * gaps[1]), gaps[1]])
    trial = highest - math.log(10.0) * np.arange(_SLOWEST, -0.1, -0.5)
    logs = trial - np.logaddexp(0.0, trial) if units.is_pole else trial
    speed = np.exp(logs + units.logarithm(rows)[:, None])
    seen = np.abs(function(np.broadcast_to(rows[:, None], speed.shape).T, speed.T).T)
    matters = (seen > _ONSET).any(axis=0)
    first = max(int(np.argmax(matters)) - 1, 0) if matters.any() else trial.size - 4
    first = min(first, trial.size - 4)
    lowest, steep = float(trial[first]), seen[1, first + 1] / max(seen[1, first], 1e-300)
    kink = None if units.is_pole else _kink(film)
    if kink is not None and kink > lowest and kink < highest - 1.0:
        return Axes(gaps, (kink, highest), 1.0)
    fade = math.log(steep) / (trial[1] - trial[0]) if 1.0 < steep < 1e30 else 1.0
    return Axes(gaps, (lowest, highest), min(max(fade, 0.1), 10.0))


def _kink(film: AnyFilm) -> float | None:
    """Logarithm of the unit shear rate [1/s] at which a power law begins; None if not known."""
    law = film.law
    is_plain = max(law.slip_length) == 0.0 and law.pressure_law is None
    if not (isinstance(law, PowerLaw) and is_plain and law.plateau_viscosity):
        return None
    begins = math.log(law.plateau_stress / law.plateau_viscosity)
    if isinstance(film, RheologicalFilm):
        return begins
    return begins - math.log(film.fastest_shear) if film.has_one_variable else None


def _closing(film: AnyFilm, gaps: tuple[float, float]) -> Ratio:
    """The same while it closes: up to the speed at which no pressure drives the liquid out."""
    units = Units(lambda rows: _pole(film, rows), is_pole=True)
    function = _logarithm(film, -1.0)
    highest = _NEAREST_ON_FACE if isinstance(film, FaceRheology) else _NEAREST
    return ratio(function, units, _axes(film, function, units, gaps, highest), _rtol(film))


def _pole(film: AnyFilm, gaps: Floats) -> Floats:
    """Logarithms of the speeds [m/s] from which on films cannot close, but as if solidified.

    What a Newtonian liquid's pressure would be at a constant viscosity is the same at all of them
    (Barus' transformation).
    """
    if isinstance(film.law, Newtonian) and gaps.size > 1:
        first = gaps[:1]
        return _unit(film, gaps) + (_pole(film, first) - _unit(film, first))
    slow = _unit(film, gaps) - 10.0
    fast = slow.copy()

    while (fine := _closes(film, gaps, fast)).any():
        slow, fast = np.where(fine, fast, slow), np.where(fine, fast + 3.0, fast)
    for _ in range(_BISECTIONS):
        middle = 0.5 * (slow + fast)
        fine = _closes(film, gaps, middle)
        slow, fast = np.where(fine, middle, slow), np.where(fine, fast, middle)
    return slow


def _closes(film: AnyFilm, gaps: Floats, logs: Floats) -> Any:
    """Whether films close without solidifying, at logarithms of speeds [m/s]."""
    pressure_law = film.law.pressure_law
    assert pressure_law is not None
    try:
        highest = film.peak_pressures(gaps, -np.exp(logs))
        known = np.where(np.isfinite(highest), highest, 0.0)
        return np.isfinite(highest) & (pressure_law.logarithm(known)[0] < _SOLID)
    except ConvergenceError:  # next to the pole of one of them
        pairs = zip(gaps, logs, strict=True)
        one = gaps.size == 1
        return np.array([not one and _closes(film, *np.atleast_1d(*pair))[0] for pair in pairs])


def _cavity(prepared: PreparedFilm, gaps: tuple[float, float], fast: float) -> Ratio:
    """Logarithm of the truncated force over that of the full film, from inception on."""
    film, onset = prepared.film, prepared.inception_speed(gaps)
    assert isinstance(film, RheologicalFilm)  # others are refused
    units = Units(lambda rows: np.log([onset(h) for h in rows.tolist()]))
    highest = math.log(FASTEST / onset(min(max(fast, gaps[0]), gaps[1])))

    def logarithm(gap: Floats, speed: Floats) -> Floats:
        left, full = film.bounded_and_full(gap, speed)
        return np.asarray(np.log(left / full))

    function = _of_one(logarithm) if _is_flat_newtonian(film) else logarithm
    return ratio(function, units, Axes(gaps, (0.0, max(highest, 3.0)), 1.0), _COSTLY)
