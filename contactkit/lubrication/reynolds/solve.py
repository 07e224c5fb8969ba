"""Solution of a film: pressure at an instant, steady sliding, and a step in time with memory."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ...errors import DescriptionError, InfeasibleError
from ...validity import warn
from .complementarity import (
    ComplementarityProblem,
    Solution,
    solve_active_set,
    solve_fischer_burmeister,
)
from .discretisation import Balance, checked_gap, discretise, mesh_of, per_unknown
from .face import Face, block_means
from .film import GridFilm, GridFilmState
from .linear_systems import choose_solver
from .validity import warn_new

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .mesh import Mesh

    Array = NDArray[np.floating[Any]]

__all__ = [
    "at_rest",
    "carried_rate",
    "solve_pressure",
    "steady_film",
    "step_film",
    "unchecked_pressure",
    "unchecked_step",
]

# An edge of a cavity that moves by some cells settles within this, one that moves far is found on
# the coarser grid. Six steps of a pull and a steady film on 320 x 240 cells solve for 2.8 million
# cells in all; with 1 or 8, 3.1 million, without coarser grids 2.95.
PATIENCE = 4
"""Iterations of the active set before a coarser grid is asked for a better guess."""
# Below, the active set itself settles in a few solutions: 4 to 64 cost the same.
SMALLEST_GRID = 16
"""Cells along the longer side below which no coarser grid is asked."""
_AT_REST = (0.0, 0.0)  # walls that do not slide [m/s]

Velocity = tuple[float, float]


class Task(NamedTuple):
    """Task of one solution, as maps that a coarser grid takes too."""

    film: GridFilm
    face: Face
    gap: Array
    growth: Array
    """Volume that a full film would gain over area and time [m/s]."""
    floor: Array
    """Least pressure [Pa]."""
    fraction: Array
    """Liquid fraction before the step; where it is 1 is the guess of the full cells."""
    pressure: Array
    """Pressure before the step, for the compressibility [Pa]."""
    velocity: Velocity
    dt: float
    has_memory: bool
    """Whether voids store liquid and are carried; else the floor is that of Swift and Stieber."""
    solver: str | None
    full: NDArray[np.bool_] | None = None
    """Guess of the full cells; None: those that are full before the step."""


def at_rest(film: GridFilm, gap: ArrayLike, liquid_fraction: ArrayLike = 1.0) -> GridFilmState:
    """A film before it moves: ambient pressure, full or with a given cavity.

    Parameters
    ----------
    film : GridFilm
        The film.
    gap : array_like, shape () or (ny, nx)
        Gap [m].
    liquid_fraction : array_like, shape () or (ny, nx)
        Fraction of the gap that is liquid [-].

    Raises
    ------
    DescriptionError
        If a gap is not positive, or a fraction not between 0 and 1.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Rectangle
    >>> face = rasterise(Rectangle(length=1e-3, width=1e-3), 18)
    >>> round(at_rest(GridFilm(face=face, viscosity=0.1), 1e-6).liquid_volume, 18)
    1e-12
    """
    face = film.face
    height = checked_gap(face, gap)
    fraction = np.asarray(liquid_fraction, dtype=float)
    if fraction.shape not in ((), face.shape):
        expected = f"be one number or have the shape {face.shape} of the grid"
        raise DescriptionError("liquid_fraction", fraction.shape, expected)
    if not ((fraction >= 0.0) & (fraction <= 1.0)).all():
        worst = float(fraction.flat[np.argmax(np.abs(fraction - 0.5))])
        raise DescriptionError("liquid_fraction", worst, "lie between 0 and 1")
    fraction = np.where(face.loaded, fraction, 1.0)
    has_cavity = (fraction < 1.0).any() and math.isfinite(film.drop)
    state = GridFilmState(
        film=film,
        gap=height,
        pressure=np.where(face.loaded, film.ambient, face.pressure),
        liquid_fraction=fraction,
        beside_cavity=face.loaded & bool(has_cavity),
    )
    warn(state.validity)
    return state


def solve_pressure(
    film: GridFilm,
    gap: ArrayLike,
    rate: ArrayLike = 0.0,
    *,
    lower_velocity: Velocity = _AT_REST,
    upper_velocity: Velocity = _AT_REST,
    solver: str | None = None,
) -> GridFilmState:
    r"""Pressure of a full film at an instant.

    Parameters
    ----------
    film : GridFilm
        The film. With a cavity pressure it is the floor of the pressure (Swift and Stieber): no
        memory, and liquid is lost where the floor ends.
    gap : array_like, shape () or (ny, nx)
        Gap [m].
    rate : array_like, shape () or (ny, nx)
        Rate of change of the gap at a fixed place [m/s]: normal speed, tilt rate, and what walls
        carry along (`carried_rate`).
    lower_velocity, upper_velocity : tuple of float
        Tangential velocities of the walls along x and y [m/s].
    solver : str, optional
        Linear solver: "superlu", "cholmod", "amg"; see `choose_solver`.

    Returns
    -------
    GridFilmState
        Pressure, force, torque and traction; `liquid_fraction` is 1.

    Raises
    ------
    DescriptionError
        If a gap is not positive or a map has the wrong shape.
    InfeasibleError
        If some liquid has no way to a reservoir.

    Notes
    -----
    Finite volumes of second order: the force of a disc of 256 cells is exact to 4e-5. Valid for
    slopes of the gap below 0.1, a film far thinner than wide, and small inertia.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> from contactkit.lubrication.squeeze_film import disc_force
    >>> face = rasterise(Disc(radius=3.175e-3), 64)
    >>> state = solve_pressure(GridFilm(face=face, viscosity=0.1), 1e-5, 1e-5)
    >>> abs(state.force / disc_force(3.175e-3, 1e-5, 1e-5, 0.1) - 1.0) < 1e-3
    True
    """
    velocities = (lower_velocity, upper_velocity)
    state = unchecked_pressure(film, gap, rate, velocities, solver)
    warn(state.validity)
    return state


def unchecked_pressure(
    film: GridFilm,
    gap: ArrayLike,
    rate: ArrayLike = 0.0,
    velocities: tuple[Velocity, Velocity] = (_AT_REST, _AT_REST),
    solver: str | None = None,
    full: NDArray[np.bool_] | None = None,
) -> GridFilmState:
    """See `solve_pressure`, without its numbers of validity: of unit films.

    `full` is a guess of the cells without a cavity, (ny, nx).
    """
    face = film.face
    lower_velocity, upper_velocity = velocities
    height = checked_gap(face, gap)
    floor = film.floor
    task = Task(
        film=film,
        face=face,
        gap=height,
        growth=_rate_map(face, rate),
        floor=np.full(face.shape, floor),
        fraction=np.ones(face.shape),
        pressure=face.pressure,
        velocity=_sum(lower_velocity, upper_velocity),
        dt=math.inf,
        has_memory=False,
        solver=solver,
        full=full,
    )
    balance, found = _solve(task)
    state = _state(task, balance, found._replace(void=np.zeros_like(found.void)))
    return evolve(state, lower_velocity=lower_velocity, upper_velocity=upper_velocity)


def steady_film(
    film: GridFilm,
    gap: ArrayLike,
    *,
    lower_velocity: Velocity = _AT_REST,
    upper_velocity: Velocity = _AT_REST,
    solver: str | None = None,
) -> GridFilmState:
    """Steady state of a sliding film, mass-conserving where it cavitates.

    Parameters
    ----------
    film : GridFilm
        The film; without a cavity pressure it stays full.
    gap, lower_velocity, upper_velocity, solver
        See `solve_pressure`.

    Raises
    ------
    DescriptionError
        If a gap is not positive, or nothing slides.
    InfeasibleError
        If some liquid has no way to a reservoir.

    Notes
    -----
    The tensile strength is not used: a film that has slid long enough has cavitated.
    """
    face = film.face
    velocity = _sum(lower_velocity, upper_velocity)
    if not any(velocity):
        cure = "without sliding a film at rest has ambient pressure: `solve_pressure`"
        raise DescriptionError("velocity", velocity, "not be zero", unit="m/s", hint=cure)
    task = Task(
        film=film,
        face=face,
        gap=checked_gap(face, gap),
        growth=np.zeros(face.shape),
        floor=np.full(face.shape, film.floor),
        fraction=np.ones(face.shape),
        pressure=face.pressure,
        velocity=velocity,
        dt=math.inf,
        has_memory=True,
        solver=solver,
    )
    balance, found = _solve(task)
    state = _state(task, balance, found)
    state = evolve(state, lower_velocity=lower_velocity, upper_velocity=upper_velocity)
    warn(state.validity)
    return state


def step_film(
    state: GridFilmState,
    gap: ArrayLike,
    dt: float,
    *,
    lower_velocity: Velocity = _AT_REST,
    upper_velocity: Velocity = _AT_REST,
    solver: str | None = None,
) -> GridFilmState:
    r"""Film after a step in time: mass-conserving, with the memory of where it has cavitated.

    Parameters
    ----------
    state : GridFilmState
        State before the step (`at_rest`, or the result of a step).
    gap : array_like, shape () or (ny, nx)
        Gap after the step [m].
    dt : float
        Length of the step [s].
    lower_velocity, upper_velocity, solver
        See `solve_pressure`.

    Returns
    -------
    GridFilmState
        State after the step. The volume of liquid has changed by dt times its `inflow`, to
        round-off.

    Raises
    ------
    DescriptionError
        If a gap or the step is not positive.
    InfeasibleError
        If some liquid has no way to a reservoir and is not compressible.

    Notes
    -----
    Backward Euler on :math:`\theta h`, with cavities of Jakobsson, Floberg and Olsson as a
    complementarity problem. First order in the step, and in the cell where a cavity shrinks; of
    second order in the cell while it grows. A step in which an intact film reaches its tensile
    strength is repeated with the cavity pressure as the floor of the connected liquid.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=3.175e-3), 32)
    >>> film = GridFilm(face=face, viscosity=0.1, drop=1e6)
    >>> before = at_rest(film, 5e-6)
    >>> after = step_film(before, 6e-6, 1e-5)
    >>> gained = after.liquid_volume - before.liquid_volume
    >>> abs(gained - 1e-5 * after.inflow) < 1e-13 * before.liquid_volume
    True
    """
    velocities = (lower_velocity, upper_velocity)
    after = unchecked_step(state, gap, dt, velocities, solver)
    before = {number.name for number in state.validity if number.is_valid is False}
    warn_new(after.validity, before)
    return after


def unchecked_step(
    state: GridFilmState,
    gap: ArrayLike,
    dt: float,
    velocities: tuple[Velocity, Velocity] = (_AT_REST, _AT_REST),
    solver: str | None = None,
    full: NDArray[np.bool_] | None = None,
) -> GridFilmState:
    """See `step_film`, without its numbers of validity: of trial steps.

    `full` is a guess of the cells without a cavity, (ny, nx).
    """
    film, face = state.film, state.film.face
    lower_velocity, upper_velocity = velocities
    if not (0.0 < dt < math.inf):
        raise DescriptionError("dt", dt, "be positive and finite", unit="s")
    height = checked_gap(face, gap)
    task = Task(
        film=film,
        face=face,
        gap=height,
        # To be filled: the gap after the step less the liquid before it. Voids close first.
        growth=(height - state.liquid_fraction * state.gap) / dt,
        floor=_floors(film, state.beside_cavity),
        fraction=state.liquid_fraction,
        pressure=state.pressure,
        velocity=_sum(lower_velocity, upper_velocity),
        dt=dt,
        has_memory=True,
        solver=solver,
        full=full,
    )
    beside = state.beside_cavity
    balance, found = _solve(task)
    count = found.iterations
    new_beside = _beside_cavity(balance.mesh, face, found.void)
    if film.strength > film.drop and (new_beside & ~beside).any():
        # The strength is that of the intact film: the cavity has its own pressure at once.
        beside = beside | new_beside
        task = task._replace(floor=_floors(film, beside))
        balance, found = _solve(task)
        count += found.iterations
        # Cavitated in this step, even where the liquid has closed again.
        new_beside = _beside_cavity(balance.mesh, face, found.void)
    after = _state(task, balance, found._replace(iterations=count))
    return evolve(
        after,
        beside_cavity=new_beside,
        time=state.time + dt,
        lower_velocity=lower_velocity,
        upper_velocity=upper_velocity,
    )


def carried_rate(
    face: Face,
    lower_heights: ArrayLike = 0.0,
    lower_velocity: Velocity = _AT_REST,
    upper_heights: ArrayLike = 0.0,
    upper_velocity: Velocity = _AT_REST,
) -> Array:
    r"""Rate of change of the gap because walls carry their roughness along [m/s].

    Parameters
    ----------
    face : Face
        The face.
    lower_heights, upper_heights : array_like, shape () or (ny, nx)
        Heights s of both walls [m]; the gap is z + s_upper - s_lower.
    lower_velocity, upper_velocity : tuple of float
        Velocities along x and y [m/s].

    Notes
    -----
    :math:`\dot h = \mathbf u_1 \cdot \nabla s_1 - \mathbf u_2 \cdot \nabla s_2`, by central
    differences. Transport by the mean of the wall velocities is in the balance already.

    Examples
    --------
    >>> import numpy as np
    >>> from contactkit.lubrication.reynolds.face import face_from_mask
    >>> face = face_from_mask(np.ones((2, 8), bool), 0.5, periodic=(False, True))
    >>> wave = np.sin(np.pi * face.x / 2) + 0.0 * face.y
    >>> float(carried_rate(face, upper_heights=wave, upper_velocity=(2.0, 0.0))[0, 0].round(3))
    -2.828
    """
    rate = np.zeros(face.shape)
    for heights, velocity, sign in (
        (lower_heights, lower_velocity, 1.0),
        (upper_heights, upper_velocity, -1.0),
    ):
        given = np.broadcast_to(np.asarray(heights, dtype=float), face.shape)
        for axis in (0, 1):
            if face.shape[axis] > 1 and velocity[1 - axis]:
                edge = "wrap" if face.periodic[axis] else "reflect"
                pad = [(1, 1) if k == axis else (0, 0) for k in (0, 1)]
                if edge == "wrap":
                    wide = np.pad(given, pad, mode="wrap")
                else:
                    wide = np.pad(given, pad, mode="reflect", reflect_type="odd")
                slope = np.gradient(wide, face.pixel_size[axis], axis=axis)
                inner = [slice(1, -1) if k == axis else slice(None) for k in (0, 1)]
                rate += sign * velocity[1 - axis] * slope[tuple(inner)]
    return rate


def _sum(first: Velocity, second: Velocity) -> Velocity:
    for name, velocity in (("lower_velocity", first), ("upper_velocity", second)):
        if len(velocity) != 2 or not all(math.isfinite(u) for u in velocity):
            raise DescriptionError(name, velocity, "be two finite numbers (x, y)", unit="m/s")
    return first[0] + second[0], first[1] + second[1]


def _rate_map(face: Face, rate: ArrayLike) -> Array:
    given = np.asarray(rate, dtype=float)
    if given.shape not in ((), face.shape):
        expected = f"be one number or have the shape {face.shape} of the grid"
        raise DescriptionError("rate", given.shape, expected, unit="m/s")
    if not np.isfinite(given).all():
        raise DescriptionError("rate", "nan or inf", "be finite", unit="m/s")
    return np.array(np.broadcast_to(given, face.shape))


def _floors(film: GridFilm, beside: NDArray[np.bool_]) -> Array:
    """Least pressure of each cell: that of a cavity where the liquid has cavitated."""
    return np.where(beside, film.floor, film.ambient - film.strength)


def _beside_cavity(mesh: Mesh, face: Face, void: Array) -> NDArray[np.bool_]:
    """Cells whose liquid is connected with a cavity."""
    has_void = np.zeros(mesh.is_enclosed.size, bool)
    has_void[mesh.region[void > 0.0]] = True
    beside = np.zeros(mesh.number.size, bool)
    beside[mesh.loaded] = has_void[mesh.region[mesh.number[mesh.loaded]]]
    return beside.reshape(face.shape)


def _at_unknowns(mesh: Mesh, values: NDArray[Any]) -> NDArray[Any]:
    """Values of a map at the unknowns; where cells share one, that of the last cell."""
    found = np.zeros(mesh.size, dtype=values.dtype)
    found[mesh.number[mesh.loaded]] = values.ravel()[mesh.loaded]
    return found


def _problem(task: Task) -> tuple[Balance, ComplementarityProblem]:
    film, face = task.film, task.face
    balance = discretise(face, task.gap, film.viscosity, task.velocity, film.compressibility)
    mesh = balance.mesh
    deficit = per_unknown(mesh, task.growth, face.cell_area) - balance.source
    excess = _excess(task, mesh)
    deficit -= np.bincount(mesh.number[mesh.rim.cell], weights=excess, minlength=mesh.size)
    held = mesh.rim_number >= 0
    deficit += np.bincount(mesh.rim_number[held], weights=excess[held], minlength=mesh.size)
    conductances, storage = balance.conductances, mesh.area
    if task.has_memory:
        extra = balance.volume - per_unknown(mesh, task.gap, face.cell_area)
        storage = balance.volume / task.dt
        deficit += extra / task.dt * (1.0 - _at_unknowns(mesh, task.fraction))
    if math.isfinite(task.dt) and balance.compliance.any():
        from scipy.sparse import diags_array

        soft = balance.compliance / task.dt
        conductances = (conductances + diags_array(soft)).tocsr()
        deficit -= soft * (_at_unknowns(mesh, task.pressure) - balance.reference)
    elif mesh.is_enclosed.any() and not (task.has_memory and not math.isfinite(task.dt)):
        raise InfeasibleError(
            "a film that no reservoir reaches has no unique pressure; give a rim inside the grid "
            "(a level that is negative somewhere), a Hole, or steps with a compressibility [1/Pa]"
        )
    drop = balance.reference - _at_unknowns(mesh, task.floor)
    transport = balance.transport if task.has_memory else None
    solver = choose_solver(task.solver, mesh.size)
    return balance, ComplementarityProblem(conductances, storage, transport, deficit, drop, solver)


def _excess(task: Task, mesh: Mesh) -> Array:
    """Flow that full cells take up between the middle of their way to the rim and their sides."""
    is_full, rim = _is_full(task).ravel(), mesh.rim
    both = is_full[rim.cell] & is_full[rim.beyond]  # an emptied pocket has none to give
    gain = np.where(both, task.growth.ravel()[rim.cell], 0.0)
    return rim.excess * gain * task.face.cell_area


def _is_full(task: Task) -> NDArray[np.bool_]:
    """Guess of the full cells."""
    return task.fraction >= 1.0 - 1e-12


def _solve(task: Task) -> tuple[Balance, Solution]:
    """Active set from the guess; then from that of a coarser grid; then Fischer-Burmeister."""
    balance, problem = _problem(task)
    full = _at_unknowns(balance.mesh, _is_full(task) if task.full is None else task.full)
    is_small = max(task.face.shape) < SMALLEST_GRID
    found = solve_active_set(problem, full, 99 if is_small else PATIENCE)
    count = found.iterations
    if not found.settled and not is_small:
        guess = _guess_from_coarser(task)
        full = full if guess is None else _at_unknowns(balance.mesh, guess)
        found = solve_active_set(problem, full, 99)
        count += found.iterations
    if not found.settled:
        found = solve_fischer_burmeister(problem, found)
        count += found.iterations
    return balance, found._replace(iterations=count)


def _guess_from_coarser(task: Task) -> NDArray[np.bool_] | None:
    """Full cells as the next coarser grid has them; None if that has lost its reservoirs."""
    face, gap = task.face.coarse, block_means(task.gap)
    if not face.inside.any() or mesh_of(face, gap).is_enclosed.any():
        return None
    coarse = task._replace(
        face=face,
        gap=gap,
        growth=block_means(task.growth),
        floor=_every_second(task.floor),
        # Outside the planform all is full, and so are cells that are partly outside.
        fraction=block_means(task.fraction),
        pressure=block_means(task.pressure),
        full=None if task.full is None else block_means(task.full * 1.0) >= 0.5,
    )
    balance, found = _solve(coarse)
    full = np.ones(face.level.size, bool)
    mesh = balance.mesh
    full[mesh.loaded] = (found.void <= 0.0)[mesh.number[mesh.loaded]]
    finer = full.reshape(face.shape)
    for axis in (0, 1):
        if task.face.shape[axis] > 1:
            finer = np.repeat(finer, 2, axis)
    ny, nx = task.face.shape
    return finer[:ny, :nx]


def _every_second(values: Array) -> Array:
    return values[tuple(slice(None, None, 2) if n > 1 else slice(None) for n in values.shape)]


def _state(task: Task, balance: Balance, found: Solution) -> GridFilmState:
    face, mesh = task.face, balance.mesh
    pressure, fraction = face.pressure.copy().ravel(), np.ones(face.level.size)
    which = mesh.number[mesh.loaded]
    pressure[mesh.loaded] = found.q[which] + balance.reference
    fraction[mesh.loaded] = 1.0 - found.void[which]
    pressure, fraction = pressure.reshape(face.shape), fraction.reshape(face.shape)
    beside = np.zeros(face.shape, bool)
    return GridFilmState(
        film=task.film,
        gap=task.gap,
        pressure=pressure,
        liquid_fraction=fraction,
        balance=balance,
        excess=_excess(task, mesh),
        beside_cavity=beside,
        iterations=found.iterations,
        time=0.0 if math.isinf(task.dt) else task.dt,
    )
