"""Every way of coupling a mass to a film, on three films: harmless, stiff, and very stiff.

Error of the release time, steps and seconds of each, and what became of those that fail: an
error that is raised is one thing, a smooth answer that is wrong another.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from attrs import field, frozen

from ...accuracy import Accuracy
from ...errors import ContactkitError
from ...separation.motion.advance import internal_step
from ...separation.motion.state import start
from ...separation.plan import plan
from ...units import si

if TYPE_CHECKING:
    from ...fmu.master.couple import Scheme

__all__ = ["CASES", "WAYS", "Case", "Run", "Way", "runs"]

Way = Literal[
    "jacobi",
    "gauss-seidel",
    "end-point",
    "impulse",
    "impulse, adaptive",
    "mass inside, held",
    "mass inside",
]
"""How film and mass are put together."""

WAYS: tuple[Way, ...] = (
    "jacobi",
    "gauss-seidel",
    "end-point",
    "impulse",
    "impulse, adaptive",
    "mass inside, held",
    "mass inside",
)
_COUNTS = (3, 10, 30, 100, 300, 1000)
_INSIDE = (1, 3, 10, 30, 100, 300)
_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
_QUICK = 0.2  # seconds below which a run is timed once more
_BEYOND = 1.2  # share of the release time up to which a fixed step goes on
_JUST_BEYOND = 1.002  # where a mass inside gets a steady pull, which leaves no doubt


@frozen(kw_only=True)
class Case:
    """A mass of 20 g on a spring of 5 N/mm, pulled off a film by up to 40 N to 100 um.

    Parameters
    ----------
    name : str
        What it stands for.
    gap, radius : float
        Gap at the start and radius of the faces [m].
    viscosity : float
        Of the film [Pa.s].
    volume : float
        Of the film [m3]; 0: a bath.
    rise_time : float
        With which the pull rises [s]; 0: it is there at once.
    """

    name: str
    gap: float = field(metadata=si("m"))
    radius: float = field(metadata=si("m"))
    viscosity: float = field(metadata=si("Pa.s"))
    volume: float = field(metadata=si("m3"))
    rise_time: float = field(default=0.0, metadata=si("s"))

    @property
    def values(self) -> dict[str, float | str]:
        """Start values of the film FMUs."""
        return {
            "h0": self.gap,
            "R": self.radius,
            "eta": self.viscosity,
            "V": self.volume,
            "gamma": 0.03,
            "theta1": 0.2,
            "theta2": 0.2,
            "meniscus_law": "PUBLISHED",
        }

    def pull(self, time: float) -> float:
        """Pull [N] at a time [s]."""
        return 40.0 if self.rise_time == 0.0 else -40.0 * math.expm1(-time / self.rise_time)

    @property
    def stable_step(self) -> float:
        """Longest step [s] with which forces can be exchanged: m/c at the start."""
        return MASS * self.gap**3 / (1.5 * math.pi * self.viscosity * self.radius**4)


MASS, _SPRING, _END = 0.02, 5e3, 1e-4  # [kg], [N/m], [m]
_DISC = math.pi * 3.175e-3**2
CASES = (
    Case(name="20 um, warm, in a bath", gap=20e-6, radius=3.175e-3, viscosity=0.01, volume=0.0),
    Case(
        name="5 um, cold",
        gap=5e-6,
        radius=3.175e-3,
        viscosity=0.1,
        volume=_DISC * 5e-6,
        rise_time=0.2e-3,
    ),
    Case(
        name="10 nm",
        gap=10e-9,
        radius=0.5e-3,
        viscosity=0.1,
        volume=math.pi * 0.5e-3**2 * 10e-9,
    ),
)


@frozen(kw_only=True)
class Run:
    """One way with one setting: what it took, and how wrong it is.

    `error` is that of the release time [-], inf if nothing was released though it should have been,
    nan if the run ended with an error; then `problem` is its message.
    """

    way: Way
    steps: int
    seconds: float = field(metadata=si("s"))
    error: float
    problem: str = ""


def runs(case: Case, film: Path, mass: Path, most: int = 1000) -> tuple[float, tuple[Run, ...]]:
    """Release time of a case [s], and every way to it with up to `most` steps."""
    exact = _whole(case)
    found = [
        _measure(way, steps, run, exact)
        for way, steps, run in _settings(case, film, mass, exact, most)
    ]
    return exact, tuple(found)


def _whole(case: Case) -> float:
    """Release time [s] of film and mass as one system, by scipy."""
    from ...fmu.slaves.stiction_mass import PORTS, MeniscusLaw, scene_of
    from ...models.injector.monolithic import simulate

    values = {port.name: port.start for port in PORTS} | case.values
    values |= {"m": MASS, "k_s": _SPRING, "h_rel": _END, "meniscus_law": MeniscusLaw.PUBLISHED}
    made = plan(scene_of(values), Accuracy())
    state = start(made)
    while state.release_time < 0.0:  # how far to go: on from there the mass would swing for long
        state = internal_step(made, state, case.pull, 100.0)
    whole = simulate(made, case.pull, 1.0001 * state.release_time, rtol=1e-11)
    return whole.cycles[0].release_time


_Found = tuple[float, int, float]  # release time, steps, seconds


def _settings(
    case: Case, film: Path, mass: Path, exact: float, most: int
) -> Iterator[tuple[Way, int, Callable[[], _Found]]]:
    end = near = _BEYOND * exact
    if case.rise_time == 0.0:
        near = _JUST_BEYOND * exact
    schemes: tuple[Scheme, ...] = ("jacobi", "gauss-seidel", "end-point", "impulse")
    for scheme in schemes:
        for n in (n for n in _COUNTS if n <= most):
            yield scheme, n, partial(_coupled, case, film, end, scheme=scheme, step=end / n)
    for tolerance in _TOLERANCES:
        yield "impulse, adaptive", 0, partial(_coupled, case, film, end, tolerance=tolerance)
    for n in (n for n in _INSIDE if n <= most):
        yield "mass inside, held", n, partial(_inside, case, mass, near, n, linear=False)
        yield "mass inside", n, partial(_inside, case, mass, near, n, linear=True)


def _measure(way: Way, steps: int, run: Callable[[], _Found], exact: float) -> Run:
    """Run a way once, and again if that was quick; `steps` are those asked for, 0 if none were."""
    try:
        release, taken, seconds = run()
        if seconds < _QUICK:
            seconds = min(seconds, run()[2])
    except ContactkitError as trouble:
        return Run(way=way, steps=steps, seconds=math.nan, error=math.nan, problem=str(trouble))
    error = abs(release / exact - 1.0) if release >= 0.0 else math.inf
    return Run(way=way, steps=steps or taken, seconds=seconds, error=error)


def _coupled(
    case: Case,
    film: Path,
    end: float,
    *,
    scheme: Scheme = "impulse",
    step: float | None = None,
    tolerance: float = 1e-3,
) -> _Found:
    """Mass outside; what the master would refuse is let through."""
    from ...fmu.master.couple import Mass, couple

    found = couple(
        film,
        Mass(mass=MASS, stiffness=_SPRING),
        case.pull,
        end,
        release_gap=_END,
        scheme=scheme,
        step=step,
        tolerance=tolerance,
        film_start=case.values,
        refuse=False,
    )
    return found.release_time, found.n_steps, found.seconds


def _inside(case: Case, mass: Path, end: float, n: int, *, linear: bool) -> _Found:
    """Mass inside the FMU: it is given the pull, held over a step or as a straight line."""
    from ...fmu.framework.instance import Instance

    length = end / n
    with Instance(mass) as one:
        one.start({**case.values, "m": MASS, "k_s": _SPRING, "h_rel": _END}, end)
        inputs, release = one.references("F_ext", "dF_ext"), one.references("t_release")
        begun = clock.perf_counter()
        for i in range(n):
            first, last = case.pull(i * length), case.pull((i + 1) * length)
            one.set(inputs, [first, (last - first) / length if linear else 0.0])
            one.step(i * length, length)
            if one.get(release)[0] >= 0.0:
                break
        seconds = clock.perf_counter() - begun
        return one.get(release)[0], i + 1, seconds
