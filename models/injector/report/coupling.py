"""Coupling schemes of a mass and a film, on three films: non-stiff, stiff, and very stiff.

Error of the release time, steps and seconds of each, and how the others fail: with an error
message, or with a smooth answer that is wrong.
"""

from __future__ import annotations

import math
import tempfile
import time as clock
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

from attrs import field, frozen

from ....accuracy import Accuracy
from ....errors import ContactkitError
from ....plot import style as plot
from ....separation.motion.advance import internal_step
from ....separation.motion.state import start
from ....separation.plan import plan
from ....units import si

if TYPE_CHECKING:
    from ....fmu.master.couple import AdaptiveSteps, FixedSteps
    from ....fmu.master.steps import Scheme

__all__ = [
    "CASES",
    "SCHEMES",
    "Case",
    "Coupling",
    "Run",
    "coupling_figure",
    "coupling_picture",
    "runs",
]

Coupling = Literal[
    "jacobi",
    "gauss-seidel",
    "implicit-force",
    "impulse",
    "impulse, adaptive",
    "mass inside, held",
    "mass inside",
]
"""How film and mass are put together."""

SCHEMES: tuple[Coupling, ...] = get_args(Coupling)
# Abscissae of the figure, half a decade apart: communication steps to the release with the film and
# with the mass inside an FMU, and tolerances.
_COUNTS = (3, 10, 30, 100, 300, 1000)
_INSIDE = (1, 3, 10, 30, 100, 300)
_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
_QUICK = 0.2  # seconds below which a run is timed once more
_BEYOND = 1.2  # times the release time, up to which a fixed step goes on
_JUST_BEYOND = 1.002  # where a mass inside gets a steady pull, which leaves no doubt


# Okabe and Ito's colours, which the colour-blind tell apart; a mark of its own for each scheme.
_LOOKS: dict[Coupling, tuple[str, str, str]] = {
    "jacobi": ("#D55E00", "o", "forces, explicit (Jacobi)"),
    "gauss-seidel": ("#E69F00", "s", "forces, explicit (Gauss-Seidel)"),
    "implicit-force": ("#CC79A7", "v", "forces, implicit"),
    "impulse": ("#56B4E9", "^", "impulses, fixed steps"),
    "impulse, adaptive": ("#0072B2", "D", "impulses, adaptive steps"),
    "mass inside, held": ("#999999", "P", "mass inside the FMU, pull held"),
    "mass inside": ("#009E73", "*", "mass inside the FMU, pull a line"),
}
_LOW, _WRONG, _HIGH = 1e-12, 0.3, 1e4  # where errors are drawn, and from where they are wrong
_KNOWN = 3e-11  # how well the release time itself is known
_STRIP = 30.0  # where runs that end with an error message are drawn
_LAST = 3e3  # steps shown
_DARK = "#8a3c00"


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
        Of the film [m3]; 0: flooded.
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
    Case(name="20 um, warm, flooded", gap=20e-6, radius=3.175e-3, viscosity=0.01, volume=0.0),
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
    """One scheme with one setting: what it took, and how wrong it is.

    `error` is that of the release time [-], inf if nothing was released though it should have been,
    nan if the run ended with an error; then `problem` is its message.
    """

    scheme: Coupling
    steps: int
    seconds: float = field(metadata=si("s"))
    error: float
    problem: str = ""


def runs(case: Case, film: Path, mass: Path, most: int = 1000) -> tuple[float, tuple[Run, ...]]:
    """Release time of a case [s], and every scheme to it with up to `most` steps."""
    exact = _monolithic(case)
    found = [
        _measure(scheme, steps, run, exact)
        for scheme, steps, run in _settings(case, film, mass, exact, most)
    ]
    return exact, tuple(found)


def _monolithic(case: Case) -> float:
    """Release time [s] of film and mass by the monolithic model."""
    from ....fmu.slaves.stiction_mass import PORTS, MeniscusLaw, scene_of
    from ..monolithic import simulate

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
) -> Iterator[tuple[Coupling, int, Callable[[], _Found]]]:
    end = near = _BEYOND * exact
    if case.rise_time == 0.0:
        near = _JUST_BEYOND * exact
    from ....fmu.master.couple import AdaptiveSteps, FixedSteps

    schemes: tuple[Scheme, ...] = ("jacobi", "gauss-seidel", "implicit-force", "impulse")
    for scheme in schemes:
        for n in (n for n in _COUNTS if n <= most):
            yield (
                scheme,
                n,
                partial(
                    _coupled,
                    case,
                    film,
                    end,
                    FixedSteps(step=end / n, scheme=scheme, refuse_unstable=False),
                ),
            )
    for tolerance in _TOLERANCES:
        yield (
            "impulse, adaptive",
            0,
            partial(_coupled, case, film, end, AdaptiveSteps(tolerance=tolerance)),
        )
    for n in (n for n in _INSIDE if n <= most):
        yield "mass inside, held", n, partial(_inside, case, mass, near, n, linear=False)
        yield "mass inside", n, partial(_inside, case, mass, near, n, linear=True)


def _measure(scheme: Coupling, steps: int, run: Callable[[], _Found], exact: float) -> Run:
    """Run a scheme once, and again if that was quick; `steps` of 0 stands for adaptive steps."""
    try:
        release, taken, seconds = run()
        if seconds < _QUICK:
            seconds = min(seconds, run()[2])
    except ContactkitError as trouble:
        return Run(
            scheme=scheme, steps=steps, seconds=math.nan, error=math.nan, problem=str(trouble)
        )
    error = abs(release / exact - 1.0) if release >= 0.0 else math.inf
    return Run(scheme=scheme, steps=steps or taken, seconds=seconds, error=error)


def _coupled(case: Case, film: Path, end: float, steps: AdaptiveSteps | FixedSteps) -> _Found:
    """Mass outside; what the master would refuse is let through."""
    from ....fmu.master.couple import Fmu, Mass, couple

    found = couple(
        Fmu(film, case.values),
        Mass(mass=MASS, stiffness=_SPRING),
        case.pull,
        end,
        release_gap=_END,
        steps=steps,
    )
    return found.release_time, found.n_steps, found.seconds


def _inside(case: Case, mass: Path, end: float, n: int, *, linear: bool) -> _Found:
    """Mass inside the FMU: it is given the pull, held over a step or as a straight line."""
    from ....fmu.framework.instance import Instance

    length = end / n
    with Instance(mass) as one:
        one.start({**case.values, "m": MASS, "k_s": _SPRING, "h_rel": _END}, end)
        inputs, release = one.references("F_ext", "dF_ext"), one.references("t_release")
        begun = clock.process_time()
        for i in range(n):
            first, last = case.pull(i * length), case.pull((i + 1) * length)
            one.set(inputs, [first, (last - first) / length if linear else 0.0])
            one.step(i * length, length)
            if one.get(release)[0] >= 0.0:
                break
        seconds = clock.process_time() - begun
        return one.get(release)[0], i + 1, seconds


def coupling_picture(out: Path) -> Path:
    """Draw all schemes on all cases, with the FMUs ``stiction-force`` and ``stiction-mass``.

    The film of the injector lies between the first two cases.
    """
    from ....fmu.python.build import build

    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        film = build("stiction-force", Path(folder))
        mass = build("stiction-mass", Path(folder))
        return coupling_figure([(case, *runs(case, film, mass)) for case in CASES], out)


def coupling_figure(found: Sequence[tuple[Case, float, Sequence[Run]]], out: Path) -> Path:
    """Draw the schemes for some cases, a row for each: over steps, and over seconds.

    Parameters
    ----------
    found : sequence of (case, release time [s], runs)
        From `runs`.
    out : Path
        Folder of the picture.
    """
    made, axes = plot.figure(
        len(found), 2, size=(9.6, 4.1 * len(found) + 0.8), sharey=True, squeeze=False
    )
    for row, (case, release, runs) in zip(axes, found, strict=True):
        for ax, of in zip(row, ("steps", "seconds"), strict=True):
            for scheme in SCHEMES:
                _line(ax, [run for run in runs if run.scheme == scheme], scheme, of)
            _dress(ax, of)
        stable = release / case.stable_step
        plot.title(row[0], f"{case.name}: released after {_time(release)}")
        _limit(row[0], stable, case.stable_step)
        row[0].set_ylabel("relative error of the release time")
    _names(axes[-1, 0])
    for ax in axes[0]:
        _bands(ax)
    plot.letters(axes.flat)
    plot.shared_legend(made, axes[0, 0])
    return plot.save(made, out / "coupling")


def _line(ax: Any, runs: Sequence[Run], scheme: Coupling, of: str) -> None:
    """One scheme: a line where it is right, hollow marks if wrong, crosses if it fails."""
    color, marker, label = _LOOKS[scheme]
    good = sorted((getattr(run, of), max(run.error, _LOW)) for run in runs if run.error <= _WRONG)
    size = 10 if marker == "*" else 6
    ax.plot(
        *zip(*good, strict=True) if good else ([], []),
        "-",
        color=color,
        marker=marker,
        ms=size,
        lw=1.8,
        label=label,
        zorder=3,
    )
    # All wrong answers are off by some 100 %: side by side, none hides another.
    place = {"jacobi": 3.0, "gauss-seidel": 0.9}.get(scheme, 1.6)
    wrong = [(getattr(run, of), place) for run in runs if run.error > _WRONG]
    if wrong:
        ax.plot(
            *zip(*wrong, strict=True),
            ls="none",
            color=color,
            marker=marker,
            ms=7,
            mfc="white",
            mew=1.8,
            zorder=4,
        )
    if of == "steps":
        row = SCHEMES.index(scheme)
        stops = [(run.steps, _STRIP * 2.0**row) for run in runs if run.problem]
        if stops:
            ax.plot(*zip(*stops, strict=True), ls="none", color=color, marker="x", ms=7, mew=2.0)


def _dress(ax: Any, of: str) -> None:
    """Bands of wrong answers, of error messages, and of the error of the reference."""
    ax.axhspan(_WRONG, 10.0, color="#D55E00", alpha=0.10, lw=0)
    ax.axhspan(10.0, _HIGH, color="0.5", alpha=0.12, lw=0)
    ax.axhspan(_LOW, _KNOWN, color="0.5", alpha=0.12, lw=0)
    ax.axhline(1e-3, color="0.45", lw=0.8, ls=(0, (4, 3)))
    ax.set(xscale="log", yscale="log", ylim=(_LOW, _HIGH))
    ax.set_yticks([10.0**k for k in range(-12, 1, 2)])
    ax.set_xlabel("communication steps" if of == "steps" else "seconds")
    if of == "steps":
        ax.set_xlim(0.8, _LAST)


def _bands(ax: Any) -> None:
    """Say what the bands are."""
    across = ax.get_yaxis_transform()
    for height, text, color in (
        (4e3, "stops with an error message", "0.25"),
        (4.0, "silently wrong by about 100 %", _DARK),
        (1.3e-3, "0.1 %", "0.35"),
        (6e-12, "error of the reference", "0.35"),
    ):
        low = text == "0.1 %"
        ax.text(
            0.98,
            height,
            text,
            ha="right",
            va="bottom" if low else "top",
            fontsize=8.5,
            color=color,
            transform=across,
        )


def _names(ax: Any) -> None:
    """Name the schemes where their lines are far apart, on the stiffest film."""
    names: tuple[tuple[float, float, Coupling, str], ...] = (
        (1.3, 1.3e3, "implicit-force", "implicit forces: lose their root"),
        (1.3, 0.012, "impulse", "impulses,\nfixed steps"),
        (30.0, 3e-5, "impulse, adaptive", "impulses, adaptive steps"),
        (1.3, 1.5e-10, "mass inside", "mass inside the FMU"),
    )
    for x, y, scheme, text in names:
        ax.text(x, y, text, fontsize=9, color=_LOOKS[scheme][0], weight="bold", va="center")


def _limit(ax: Any, stable: float, step: float) -> None:
    """Where explicit coupling becomes stable."""
    words = f"explicit: stable from\n{_number(stable)} steps on\n(m/c = {_time(step)})"
    if stable < _LAST:
        ax.axvline(stable, color="#D55E00", lw=1.2, ls=":")
        ax.text(stable * 1.15, 1e-9, words, fontsize=8.5, color=_DARK, va="center")
        return
    ax.annotate(
        words,
        xy=(1.0, 0.22),
        xytext=(0.66, 0.22),
        xycoords="axes fraction",
        fontsize=8.5,
        color=_DARK,
        va="center",
        ha="center",
        arrowprops={"arrowstyle": "->", "color": "#D55E00", "lw": 1.4},
    )


def _number(value: float) -> str:
    if value < 1e4:
        return f"{value:.0f}"
    mantissa, power = f"{value:.0e}".split("e")
    return rf"${mantissa}\times 10^{{{int(power)}}}$"


def _time(seconds: float) -> str:
    units = ((1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns"), (1e-12, "ps"))
    unit, name = next((pair for pair in units if seconds >= 0.999 * pair[0]), units[-1])
    return f"{seconds / unit:.3g} {name}"
