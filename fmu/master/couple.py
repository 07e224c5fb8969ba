"""The master for a tool that owns the mass: couples it to the FMU ``stiction-force``.

A film is so stiff that its force, carried from one step into the next, needs steps below m/c:
1e-7 s at 5 um, 1e-12 s at 10 nm. Longer ones do not fail, they give a smooth and wrong answer. So
impulses are exchanged here instead, with the FMU rolled back until mass and film agree; the
steps are adaptive, and cut at kinks, rupture and release. Forces are exchanged only where that
is stable, and refused where it is not.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attrs import field, frozen

from ...errors import ConvergenceError, DescriptionError
from ...units import si
from ...validators import finite, non_negative, positive
from .adaptive import Goal, Walk
from .fixed import FixedWalk
from .impulse_step import Body, Point
from .sides import DrivePull, FilmSide, Fmu, GivenPull
from .steps import AdaptiveSteps, FixedSteps

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["AdaptiveSteps", "Coupled", "FixedSteps", "Fmu", "Mass", "couple"]

_NAMES = ("h", "v", "F_ext", "F", "F_m", "J")


_ADAPTIVE = AdaptiveSteps()


@frozen(kw_only=True)
class Mass:
    """The body that the master moves.

    Parameters
    ----------
    mass : float
        Moving mass [kg].
    stiffness : float
        Stiffness of a spring that pulls back towards the gap at the start [N/m].
    speed : float
        Opening speed at the start [m/s].
    rest_gap : float
        Gap [m] at which asperities stop closing, at most that of the start; 0: none.
    """

    mass: float = field(validator=positive, metadata=si("kg"))
    stiffness: float = field(default=0.0, validator=non_negative, metadata=si("N/m"))
    speed: float = field(default=0.0, validator=finite, metadata=si("m/s"))
    rest_gap: float = field(default=0.0, validator=non_negative, metadata=si("m"))


@frozen(eq=False)
class Coupled:
    """Result of a coupled run.

    Attributes
    ----------
    time : ndarray
        Ends of the steps, the start included [s].
    columns : mapping of str to ndarray
        At these times gap ``h`` [m], speed ``v`` [m/s], pull ``F_ext`` [N], force of the film ``F``
        [N] and of its meniscus ``F_m`` [N], viscous impulse ``J`` [N.s].
    release_time : float
        When the gap first came to the release gap [s]; nan if it did not.
    break_time : float
        Time of the latest rupture [s]; nan if the film did not break.
    log : tuple of str
        Messages of the FMUs.
    n_steps, n_rejected, n_calls : int
        Steps, rejected tries, and calls of the film.
    seconds : float
        CPU time of the steps [s].
    """

    time: NDArray[np.float64]
    columns: Mapping[str, NDArray[np.float64]] = field(repr=False)
    release_time: float
    break_time: float
    log: tuple[str, ...] = field(repr=False)
    n_steps: int
    n_rejected: int
    n_calls: int
    seconds: float

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return the column of a name."""
        return self.columns[name]


def couple(
    film: str | Path | Fmu,
    mass: Mass,
    pull: Callable[[float], float] | float | str | Path | Fmu,
    stop_time: float,
    *,
    release_gap: float = math.inf,
    jumps: Sequence[float] = (),
    steps: AdaptiveSteps | FixedSteps = _ADAPTIVE,
) -> Coupled:
    """Couple a mass to a film FMU, from rest at the gap of the film to a gap or a time.

    Parameters
    ----------
    film : path or Fmu
        An FMU of FMI 2.0 with the variables of ``stiction-force``. Motion, mass and exchange are
        the master's, and no start values.
    mass : Mass
        What the film holds.
    pull : callable, float, path or Fmu
        Pull [N] on the mass at a time [s], smooth but at `jumps`; a steady one; or an FMU with the
        variables of ``valve-drive``.
    stop_time : float
        Where to end at the latest [s].
    release_gap : float
        Gap [m] at which the run ends as soon as it is reached; inf: at `stop_time` only.
    jumps : sequence of float
        Times at which the pull jumps or has a kink [s].
    steps : AdaptiveSteps or FixedSteps
        Communication steps, and what is exchanged in them.

    Returns
    -------
    Coupled
        It ends at the release or at `stop_time`, nowhere else; with `FixedSteps` the release is
        interpolated within the last one.

    Raises
    ------
    InfeasibleError
        If forces are to be exchanged with a step beyond the stable one, m/c for ``"jacobi"`` and
        2 m/c for ``"gauss-seidel"``; names that step, and the FMU that needs none.
    ConvergenceError
        If an FMU does not accept a step, or the final time is not reached.
    DescriptionError
        If an argument is not possible, a pull is not finite, or a file is not such an FMU.
    ContactkitError
        If an FMU cannot be loaded here, or refuses a start value; with what it said.

    Notes
    -----
    Measured from 10 nm to 20 um: each tolerance from 1e-2 to 1e-5 is met by the release time, and
    1e-6 in the release cases. Impulses give a method of third order; where a limit of the liquid
    may act the film is asked for forces, and it is of fifth.
    """
    _check(stop_time, release_gap)
    breaks = tuple(sorted(_checked("jumps", time, "be finite", unit="s") for time in jumps))
    part = Fmu.of(film)
    with ExitStack() as stack:
        side = stack.enter_context(FilmSide(Path(part.path)))
        source = _source(pull, stop_time, stack)
        explicit = isinstance(steps, FixedSteps) and steps.scheme in ("gauss-seidel", "jacobi")
        exchange = "FORCE" if explicit else "IMPULSE"
        there = side.begin(part.start, mass.mass, mass.speed, exchange)
        body = Body(mass.mass, mass.stiffness, side.first_gap, mass.rest_gap)
        if mass.rest_gap > body.rest:
            expected = f"not exceed the gap at the start, {body.rest:g} m"
            raise DescriptionError("Mass.rest_gap", mass.rest_gap, expected, unit="m")
        if release_gap <= body.rest:
            expected = f"exceed the gap at the start, {body.rest:g} m"
            raise DescriptionError("release_gap", release_gap, expected, unit="m")
        first = Point(0.0, body.rest, mass.speed, mass.mass * mass.speed, 0.0, there)
        goal = Goal(stop_time, release_gap, breaks)
        walk: Walk | FixedWalk = (
            FixedWalk(side, source, body, first, goal, steps)
            if isinstance(steps, FixedSteps)
            else Walk(side, source, body, first, goal, steps.tolerance)
        )
        begun = clock.process_time()
        _go(walk, goal, math.inf if isinstance(steps, FixedSteps) else steps.max_steps)
        log = side.log + (source.log if isinstance(source, DrivePull) else [])
        return _result(walk, side.calls + side.asked, tuple(log), clock.process_time() - begun)


def _source(
    pull: Callable[[float], float] | float | str | Path | Fmu,
    stop_time: float,
    stack: ExitStack,
) -> GivenPull | DrivePull:
    """What pulls the mass, ready to go."""
    if isinstance(pull, str | Path | Fmu):
        given = Fmu.of(pull)
        drive = stack.enter_context(DrivePull(Path(given.path)))
        drive.start(given.start, stop_time)
        return drive
    if callable(pull):
        return GivenPull(pull)
    steady = _checked("pull", pull, "be finite, a function of time, or the path of an FMU", "N")
    return GivenPull(lambda time: steady)


def _checked(name: str, value: Any, expected: str, unit: str = "") -> float:
    """A finite number, or the error that names it."""
    if isinstance(value, Real) and math.isfinite(value):
        return float(value)
    raise DescriptionError(name, value, expected, unit=unit)


def _check(stop_time: float, release_gap: Any) -> None:
    if not _checked("stop_time", stop_time, "be positive and finite", "s") > 0.0:
        raise DescriptionError("stop_time", stop_time, "be positive and finite", unit="s")
    if not (isinstance(release_gap, int | float) and release_gap > 0.0):
        raise DescriptionError("release_gap", release_gap, "be positive", unit="m")


def _go(walk: Walk | FixedWalk, goal: Goal, max_steps: float) -> None:
    """Step to the final time or the release, whichever comes first."""
    while not walk.is_done:
        if len(walk.points) > max_steps:
            break
        walk.step()
    last = walk.points[-1].time
    if walk.release_time < 0.0 and abs(last - goal.stop_time) > 1e-9 * goal.stop_time:
        raise ConvergenceError(
            f"{len(walk.points) - 1} steps led to {last:g} s, not to {goal.stop_time:g} s nor to "
            f"the release; loosen the tolerance or raise max_steps"
        )


def _result(walk: Walk | FixedWalk, calls: int, log: tuple[str, ...], seconds: float) -> Coupled:
    import numpy as np

    rows = [
        (p.time, p.gap, p.speed, pull, p.film.force, p.film.static, p.film.impulse)
        for p, pull in zip(walk.points, walk.pulls, strict=True)
    ]
    table = np.array(rows)
    table.flags.writeable = False
    columns = {name: table[:, i + 1] for i, name in enumerate(_NAMES)}
    return Coupled(
        table[:, 0],
        columns,
        _reached(walk.release_time),
        _reached(walk.points[-1].film.broken_at),
        log,
        len(walk.points) - 1,
        walk.n_rejected,
        calls,
        seconds,
    )


def _reached(time: float) -> float:
    """Time [s] of an event; nan for one that did not happen, which an FMU gives as -1."""
    return time if time >= 0.0 else math.nan
