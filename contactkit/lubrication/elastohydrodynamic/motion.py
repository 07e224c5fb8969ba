"""Motion of smooth bodies with a film between them, in SI units, with its error.

Curves are those of three meshes, extrapolated (Richardson): the method is of second order in the
elements, and what the two extrapolations differ by is the estimate of the error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from attrs import evolve, frozen
from numpy.typing import NDArray

from ...numerics.blas import one_thread
from .drive import Drive, Driven, Imposed
from .follow import Control, State, Track, begun, follow
from .mesh import RingMesh, disc_nodes, graded_nodes
from .wet_gap import Fields, WetGap, at_rest

__all__ = ["Motion", "Phase", "Profile", "SmoothGap", "end_time", "move", "with_times"]

Array = NDArray[np.float64]

# Of the difference of two extrapolations, which is 15 times the error if that is of fourth order:
# measured in tests/lubrication/elastohydrodynamic, errors are 0.02 to 0.2 of it. At the edge of a
# cavity or a contact the order is lower, and all of it is taken.
_SMOOTH = 0.25
# First step over the span, and over the time in which the gap changes by itself, which a limit of
# time may exceed by far: transients that are shorter are not resolved.
_FIRST, _FIRST_IN_UNITS = 1e-5, 1e-3
# Extremes over the nodes and sums over sets of nodes: of no order in the elements.
_OF_ONE_MESH = frozenset({"smallest_gap", "largest_tension", "contact_area"})
# Rim over the width of the pressure up to which 48 elements give 1e-4; beyond, as many per decade.
_NEAR_RIM = 8.0
_SAME = 1e-12  # times over the last one that differ by round-off


@frozen(eq=False)
class SmoothGap:
    """Two smooth bodies of revolution with a film, at rest.

    Parameters
    ----------
    radius : float
        Radius of curvature R of the gap [m]; inf: flat.
    rim : float
        Radius of the film [m]: flooded beyond, or the meniscus at the start.
    gap : float
        Gap of the undeformed bodies on the axis [m].
    viscosity : float
        [Pa.s]
    compliance : callable
        Displacement at nodes [m] by their pressures [m/Pa]; of half-spaces if the rim moves.
    cavity : float
        Tension of a cavity, ambient less its pressure [Pa]; inf: none opens.
    strength : float
        Tension at which the whole film ruptures [Pa]; not below `cavity` in effect.
    cutoff : float
        Gap at which asperities touch [m]; 0: none do.
    wetting : float or None
        Surface tension times the sum of the cosines [N/m] of a meniscus at the rim; None: flooded.
    """

    radius: float
    rim: float
    gap: float
    viscosity: float
    compliance: Callable[[Array], Array]
    cavity: float = math.inf
    strength: float = 0.0
    cutoff: float = 0.0
    wetting: float | None = None

    @property
    def width(self) -> float:
        """Width of the pressure [m]: of a sphere sqrt(R h), of a flat its radius."""
        return min(math.sqrt(self.radius * self.gap), self.rim)


class Phase(NamedTuple):
    """Part of a motion.

    `drive` gives what moves the bodies, in SI units, of the rigid gap [m] and the time [s] at the
    start of the phase; it lasts until the last of `times` [s], or until a rigid gap [m].
    """

    drive: Callable[[float, float], Drive]
    times: Sequence[float]
    until: float = math.inf


class Profile(NamedTuple):
    """Section through the film at a time: radii [m], gap [m], film and solid pressure [Pa].

    `liquid` is the part of the gap that is full [-].
    """

    time: float
    radius: Array
    gap: Array
    film_pressure: Array
    solid_pressure: Array
    liquid: Array


class Motion(NamedTuple):
    """Curves of a motion, by their names, and their error.

    Attributes
    ----------
    columns : mapping of str to ndarray
        Over the times [s] of ``time``.
    profiles : list of Profile
        At all these times, of the finest mesh.
    end_times : list of float
        Times at which the phases ended [s].
    is_over : bool
        Whether the last phase ended at its gap, and not at its last time.
    rupture_time : float
        When the film first ruptured, or a cavity opened [s]; nan: it did not.
    error : float
        Estimated error of the force, over its largest [-].
    n_steps, n_rejected, n_iterations : int
        Of the finest mesh.
    """

    columns: Mapping[str, Array]
    profiles: list[Profile]
    end_times: list[float]
    is_over: bool
    rupture_time: float
    error: float
    n_steps: int
    n_rejected: int
    n_iterations: int


class _Units(NamedTuple):
    """Units of length, gap, time, pressure and force, in which the viscosity is 1."""

    length: float
    gap: float
    time: float
    pressure: float
    force: float


class _Run(NamedTuple):
    """One mesh: its gap and states, ends of phases, ruptures, counts."""

    gap: WetGap
    states: list[State]
    ends: list[float]
    ruptures: list[float]
    counts: tuple[int, int, int]


@one_thread()
def move(
    film: SmoothGap,
    phases: Sequence[Phase],
    *,
    speed: float,
    elements: int = 0,
    tolerance: float = 1e-4,
) -> Motion:
    """Follow the motion of smooth bodies.

    Parameters
    ----------
    film : SmoothGap
        At rest: flooded and without pressure, or a meniscus in equilibrium with its rim.
    phases : sequence of Phase
        One after the other.
    speed : float
        A speed that is characteristic [m/s]: it sets the units of the iteration, no result.
    elements : int
        Of the finest mesh, a multiple of 4. 0: 48, with cavities or contact 64, and more where the
        rim lies beyond 8 widths of the pressure.
    tolerance : float
        Of a step, see `Control`.

    Raises
    ------
    StepFailedError
        If a step cannot be solved: a gap closes where nothing can touch.

    Notes
    -----
    Measured (``tests/lubrication/elastohydrodynamic``): 1e-4 of the largest force of smooth pulls
    and approaches at beta of 1e-3 to 10, 9e-4 with a cavity, 5e-4 with a contact, whose own force
    is right to 1.5 % where most of it is gone. Gaps in the instant of snap-off, at beta = 10, are
    right to 3 %. A smooth pull takes 0.4 s of CPU, the others 2 to 4 s.
    """
    elements = elements or _elements(film)
    units = _units(film, speed)
    middle = _run(film, units, phases, elements // 2, tolerance)
    times = np.unique([state.time for state in middle.states])
    given = with_times(phases, times * units.time)
    others = [_run(film, units, given, n, tolerance) for n in (elements // 4, elements)]
    runs = [others[0], middle, others[1]]
    common = _common(runs, times)
    tables = [_table(run, common, units) for run in runs]
    columns = {name: _extrapolated(name, *tables[1:]) for name in tables[0]}
    before = {name: _extrapolated(name, *tables[:2]) for name in tables[0]}
    fine = runs[-1]
    return Motion(
        {**columns, "time": common * units.time},
        [_profile(fine.gap, state, units) for state in _at(fine, common)],
        [
            float(_richardson(*ends)) * units.time
            for ends in zip(*(r.ends for r in runs[1:]), strict=True)
        ],
        fine.states[-1].fields.rigid_gap * units.gap >= phases[-1].until,
        _rupture(runs, units),
        _error(columns, before),
        *fine.counts,
    )


def _is_smooth(film: SmoothGap) -> bool:
    return math.isinf(film.cavity) and not film.cutoff


def _elements(film: SmoothGap) -> int:
    stretch = 1.0
    if film.wetting is None and math.isfinite(film.radius):
        stretch = max(math.asinh(film.rim / film.width) / math.asinh(_NEAR_RIM), 1.0)
    return 4 * math.ceil((12 if _is_smooth(film) else 16) * stretch)


def _units(film: SmoothGap, speed: float) -> _Units:
    length, gap = film.width, film.gap
    time = gap / abs(speed)
    pressure = film.viscosity * length**2 / (gap**2 * time)
    return _Units(length, gap, time, pressure, pressure * length**2)


def _prepared(film: SmoothGap, units: _Units, elements: int) -> tuple[WetGap, State]:
    """Gap in the units of the iteration, and its state at rest."""
    rim = film.rim / units.length
    curvature = units.length**2 / (film.radius * units.gap)
    moves = film.wetting is not None
    if moves:
        nodes = disc_nodes(elements, 1.0)
    elif math.isinf(film.radius):
        nodes = disc_nodes(elements, rim)
    else:
        nodes = graded_nodes(elements, rim)
    gap = WetGap(
        RingMesh(nodes),
        0.5 * curvature * nodes**2,
        film.compliance(nodes * units.length) * (units.pressure / units.gap),
        Imposed(lambda _: 1.0),
        tension=film.wetting / (units.pressure * units.gap) if film.wetting is not None else None,
        floor=-film.cavity / units.pressure,
        cutoff=film.cutoff / units.gap,
    )
    return gap, begun(gap, _bridge(gap, rim) if moves else at_rest(gap, 1.0))


def _bridge(gap: WetGap, rim: float) -> Fields:
    """A meniscus of uniform pressure that is in equilibrium with its rim."""
    tension = gap.tension or 0.0
    drawn = rim * float(gap.compliance[-1].sum())
    height = 1.0 + rim**2 * float(gap.shape[-1])
    # p (height - drawn p) = tension; the root that is that of rigid bodies where they are stiff.
    root = height * height - 4.0 * drawn * tension
    if root < 0.0:
        raise ArithmeticError("the meniscus has drawn the bodies together at the start")
    pressure = 2.0 * tension / (height + math.sqrt(root))
    none = np.zeros(len(gap.shape))
    now = Fields(none - pressure, none, none, 1.0, 0.0, rim, 0.0)
    return now._replace(content=gap.gap(now))


def _drive(drive: Drive, units: _Units) -> Drive:
    """A drive in SI units, in those of the iteration."""
    t, h, f = units.time, units.gap, units.force
    if isinstance(drive, Imposed):
        return Imposed(lambda time: drive.gap(time * t) / h)
    return Driven(
        lambda time: drive.force(time * t) / f,
        drive.mass * h / (t * t * f),
        drive.stiffness * h / f,
        lambda time: drive.spring_end(time * t) / h,
    )


def _run(
    film: SmoothGap, units: _Units, phases: Sequence[Phase], elements: int, tolerance: float
) -> _Run:
    gap, state = _prepared(film, units, elements)
    smooth = _is_smooth(film)
    tracks: list[Track] = []
    ends: list[float] = []
    for phase in phases:
        drive = phase.drive(state.fields.rigid_gap * units.gap, state.time * units.time)
        moved = evolve(gap, drive=_drive(drive, units))
        times = [state.time, *(t / units.time for t in phase.times if t / units.time > state.time)]
        span = times[-1] - times[0]
        control = Control(
            tolerance,
            3 if smooth else 2,
            film.strength / units.pressure,
            min(_FIRST, _FIRST_IN_UNITS / span),
        )
        track = follow(moved, state, times, control, every_step=True, until=phase.until / units.gap)
        state = track.states[-1]
        ends.append(end_time(track.states, phase.until / units.gap))
        tracks.append(track)
    states = [one for track in tracks for one in track.states]
    ruptures = [time for track in tracks for time in track.rupture_times]
    counts = (
        sum(track.n_steps for track in tracks),
        sum(track.n_rejected for track in tracks),
        sum(track.n_iterations for track in tracks),
    )
    return _Run(gap, states, ends, ruptures, counts)


def end_time(states: Sequence[Any], until: float) -> float:
    """Time at which a phase ended: in the last step of its states, on the cubic through them."""
    end = states[-1]
    if end.fields.rigid_gap < until or len(states) < 2:
        return float(end.time)
    start = states[-2]
    length = end.time - start.time
    low, high = 0.0, 1.0
    for _ in range(60):
        s = 0.5 * (low + high)
        a, b = start.fields, end.fields
        gap = (
            (1.0 + 2.0 * s) * (1.0 - s) ** 2 * a.rigid_gap
            + s * (1.0 - s) ** 2 * length * a.speed
            + s * s * (3.0 - 2.0 * s) * b.rigid_gap
            + s * s * (s - 1.0) * length * b.speed
        )
        low, high = (s, high) if gap < until else (low, s)
    return float(start.time + high * length)


def with_times(phases: Sequence[Phase], times: Array) -> list[Phase]:
    """The same phases, with a step that ends at each of some times [s]."""
    found = []
    for phase in phases:
        own = np.asarray(phase.times, dtype=np.float64)
        # The same time in other units differs by round-off: no step may be so short.
        new = [t for t in times if t <= own[-1] and np.abs(own - t).min() > _SAME * own[-1]]
        found.append(phase._replace(times=sorted([*new, *own])))
    return found


def _common(runs: Sequence[_Run], times: Array) -> Array:
    """Times at which every mesh has a state, to round-off of their units."""
    found = [np.array([state.time for state in run.states]) for run in runs]
    kept = [t for t in times if all(np.abs(one - t).min() <= _SAME * times[-1] for one in found)]
    return np.array(kept)


def _at(run: _Run, times: Array) -> list[State]:
    """Last state of each time: that after a rupture."""
    own = np.array([state.time for state in run.states])
    places = np.searchsorted(own, times + _SAME * times[-1], side="right") - 1
    return [run.states[k] for k in places]


def _table(run: _Run, times: Array, units: _Units) -> dict[str, Array]:
    """Curves of a mesh in SI units."""
    rows = [_row(run.gap, state, units) for state in _at(run, times)]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _row(gap: WetGap, state: State, units: _Units) -> dict[str, float]:
    now = state.fields
    h = gap.gap(now)
    energy, volume = units.force * units.gap, units.gap * units.length**2
    area = units.length**2
    ones = np.ones(len(h))
    return {
        "gap": now.rigid_gap * units.gap,
        "speed": now.speed * units.gap / units.time,
        "centre_gap": float(h[0]) * units.gap,
        "mean_gap": gap.volume(h, now.rim) / gap.volume(ones, now.rim) * units.gap,
        "smallest_gap": float(h.min()) * units.gap,
        "film_force": -gap.thrust(now.pressure, now.rim) * units.force,
        "contact_force": gap.thrust(now.solid, now.rim) * units.force,
        "pull": -gap.thrust(now.pressure + now.solid, now.rim) * units.force,
        "largest_tension": -float(now.pressure.min()) * units.pressure,
        "rim_radius": now.rim * float(gap.mesh.nodes[-1]) * units.length,
        "contact_area": gap.thrust(state.sets.contact.astype(float), now.rim) * area,
        "void_volume": gap.volume(h - now.content, now.rim) * volume,
        "liquid_volume": gap.volume(now.content, now.rim) * volume,
        "elastic_energy": gap.elastic_energy(now) * energy,
        "work": state.work * energy,
        "dissipated_energy": state.dissipated * energy,
    }


def _profile(gap: WetGap, state: State, units: _Units) -> Profile:
    now = state.fields
    h = gap.gap(now)
    return Profile(
        state.time * units.time,
        now.rim * gap.mesh.nodes * units.length,
        h * units.gap,
        now.pressure * units.pressure,
        now.solid * units.pressure,
        np.minimum(now.content / h, 1.0),
    )


def _extrapolated(name: str, coarse: Mapping[str, Array], fine: Mapping[str, Array]) -> Array:
    return fine[name] if name in _OF_ONE_MESH else _richardson(coarse[name], fine[name])


def _richardson(coarse: Array | float, fine: Array | float) -> Array:
    found: Array = np.asarray(fine + (fine - coarse) / 3.0)
    return found


def _error(columns: Mapping[str, Array], before: Mapping[str, Array]) -> float:
    """Estimated error of the force over its largest."""
    smooth = not columns["void_volume"].any() and not columns["contact_force"].any()
    largest = float(np.abs(columns["pull"]).max())
    if largest == 0.0:
        return 0.0
    differ = float(np.abs(columns["pull"] - before["pull"]).max()) / largest
    return _SMOOTH * differ if smooth else differ


def _rupture(runs: Sequence[_Run], units: _Units) -> float:
    """When the film ruptured, or the first cavity opened."""
    if all(run.ruptures for run in runs[1:]):
        return float(_richardson(*(run.ruptures[0] for run in runs[1:]))) * units.time
    opened = (s.time for s in runs[-1].states if s.ruptured or s.sets.void.any())
    return next(opened, math.nan) * units.time
