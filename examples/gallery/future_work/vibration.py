"""Vibration of the bodies while a film opens: viscous force, cavity and meniscus."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.plot import gallery as plot
from contactkit.units import deg, um

PAGE = Page(
    name="vibration",
    title="A gap that vibrates while it opens",
    claim="Section 3.4 names oscillation of high frequency as a means against meniscus and "
    "viscous forces; section 3.5 leaves it to future work.",
    verdict="Vibration leaves the impulse of a film that stays whole as it is. A film that "
    "cavitates on opening is rectified: its mean force falls, and pushes the bodies apart "
    "once the amplitude is large. The meniscus force, convex in the gap, rises on the "
    "mean by a quarter of its second derivative times the amplitude squared; but the "
    "meniscus breaks earlier. Beyond contactkit: inertia of the liquid, waves in the "
    "bodies.",
    choices="Oil of 0.1 Pa.s and 30 mN/m, discs of 1 mm, from 5 to 10 um at 10 um/s; 60 Hz. "
    "Cavitated film: bears 0.1 MPa, truncated pressure. Meniscus: 1 pl, 60/60 degrees, "
    "under a sphere of 1 mm, from 1 to 2 um and to its end at 2 um/s.",
    grid="8 amplitudes; every cycle by Gauss quadrature",
)
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
START, END, SPEED, FREQUENCY = 5 * um, 10 * um, 10e-6, 60.0
STRENGTH = 1e5
BRIDGE_START, BRIDGE_SPEED, VOLUME = 1 * um, 2e-6, 1e-15
SHAPE = (60 * deg, 60 * deg, 0.0, 1e3)  # angles, curvatures


def compute(draft: bool = False) -> dict[str, Any]:
    """Mean forces and impulses over the amplitude, some cycles in time, and the bridge."""
    n = 4 if draft else 8
    amplitudes = np.linspace(0.0, 4.4 * um, n)
    tension = ck.TensionLimit(strength=STRENGTH, cavity="truncated")
    whole = [_opened(a, ck.ViscousForce()) for a in amplitudes.tolist()]
    cavitated = [_opened(a, ck.ViscousForce(), tension) for a in amplitudes.tolist()]
    shown = cavitated[n // 2]
    part = shown.time < 4.0 / FREQUENCY
    small = np.linspace(0.0, 0.9 * um, n)
    bridges = [_bridge(a) for a in small.tolist()]
    ends = [_bridge(a, far=20 * um).time[-1] for a in small.tolist()]
    return {
        "amplitudes": amplitudes,
        "whole": np.array([run.of(ck.ViscousForce).impulse for run in whole]),
        "cavitated": np.array([run.of(ck.ViscousForce).impulse for run in cavitated]),
        "time": shown.time[part],
        "pull": shown["viscous_force"][part],
        "newtonian": shown["newtonian_force"][part],
        "small": small,
        "rise": np.array([0.0, *map(_rise, bridges[1:])]),
        "convex": np.array(_convexity()),
        "limit": np.array(_limit()),
        "ends": np.array(ends),
    }


def _simulated(scene: ck.SeparationScene) -> Any:
    with warnings.catch_warnings():
        # Truncated cavities forget where they were, as the page states.
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.simulate(ck.plan(scene))


def _shaken(amplitude: float, phase: float = 0.0) -> ck.Vibration | None:
    if not amplitude:
        return None
    return ck.Vibration(amplitude=amplitude, frequency=FREQUENCY, phase=phase)


def _opened(amplitude: float, *effects: Any) -> Any:
    """Film of oil between discs, flooded up to their rim."""
    face = ck.Flat(radius=1e-3)
    scene = ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=OIL, volume=math.pi * 1e-6 * START)
        ),
        loading=ck.ImposedSpeed(
            initial_gap=START, final_gap=END, speed=SPEED, vibration=_shaken(amplitude)
        ),
        effects=effects,
    )
    return _simulated(scene)


def _bridge(amplitude: float, far: float = 2 * BRIDGE_START) -> Any:
    """Meniscus under a sphere, by its exact force; broken beyond its limit of stability."""
    film = ck.Meniscus(
        liquid=OIL, volume=VOLUME, contact_angle_lower=60 * deg, contact_angle_upper=60 * deg
    )
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=film),
        loading=ck.ImposedSpeed(
            initial_gap=BRIDGE_START,
            final_gap=far,
            speed=BRIDGE_SPEED,
            # Begun at an extreme, a cycle adds no term of first order in amplitude times speed.
            vibration=_shaken(amplitude, 0.5 * math.pi),
        ),
        effects=(ck.MeniscusForce(),),
    )
    return _simulated(scene)


def _convexity() -> float:
    """Quarter of the mean second derivative of the meniscus force over the opening [N/m2]."""
    slopes = bridge(np.array([BRIDGE_START, 2 * BRIDGE_START]), VOLUME, *SHAPE).stiffness
    return float(0.03 * (slopes[1] - slopes[0]) / BRIDGE_START / 4.0)


def _rise(run: Any) -> float:
    """Mean pull less that without the vibration [N]."""
    found = run.scalars()
    return float(found["mean_pull"][0] - found["mean_steady_pull"][0])


def _limit() -> float:
    """Gap at which the meniscus breaks [m]."""
    return float(stability_limit(VOLUME, *SHAPE).gap)


def draw(data: Data) -> plot.Figure:
    """Some cycles, impulses over the amplitude, mean force and end of the meniscus."""
    figure, panels = plot.figure(2, 2, size=(10.0, 7.4))
    cycles, impulse, mean, end = panels.flat
    time = 1e3 * data["time"]
    cycles.plot(time, data["newtonian"], **plot.series(1, marker=""), label="whole film")
    cycles.plot(
        time, data["pull"], **plot.series(0, marker="", lw=1.2), label="film that cavitates"
    )
    cycles.set(xlabel="time [ms]", ylabel="viscous force [N]")
    cycles.legend(fontsize=8)
    amplitudes = data["amplitudes"] / um
    duration = (END - START) / SPEED
    for i, (name, label) in enumerate(
        (("cavitated", "film that cavitates"), ("whole", "whole film"))
    ):
        impulse.plot(amplitudes, data[name] / duration, **plot.series(i), label=label)
    impulse.axhline(0.0, color="0.5", lw=0.8)
    impulse.set(xlabel="amplitude [um]", ylabel="mean viscous force [N]")
    impulse.legend(fontsize=8)
    small = data["small"] / um
    rise = data["rise"]
    mean.plot(small, 1e6 * rise, **plot.series(0, ls=""), label="computed")
    fine = np.linspace(0.0, 0.9, 50)
    law = 1e6 * float(data["convex"]) * (fine * um) ** 2
    mean.plot(fine, law, **plot.series(2, marker=""), label="$a^2 F''/4$")
    mean.set(xlabel="amplitude [um]", ylabel="rise of the mean meniscus force [uN]")
    mean.legend(fontsize=8)
    end.plot(small, data["ends"], **plot.series(0), label="computed")
    reached = (float(data["limit"]) - BRIDGE_START - fine * um) / BRIDGE_SPEED
    end.plot(fine, reached, **plot.series(2, marker=""), label="mean gap + amplitude at the limit")
    end.set(xlabel="amplitude [um]", ylabel="time to rupture [s]")
    end.legend(fontsize=8)
    plot.letters(
        list(panels.flat),
        [
            f"viscous force, {data['amplitudes'][data['amplitudes'].size // 2] / um:.1f} um",
            "mean viscous force",
            "meniscus: mean force",
            "meniscus: its end",
        ],
    )
    return figure


def check(data: Data) -> list[Check]:
    """Impulse of a whole film, rectified force, mean force and end of the meniscus."""
    whole, cavitated, small = data["whole"], data["cavitated"], data["small"]
    off = float(np.abs(whole / whole[0] - 1.0).max())
    rise = data["rise"]
    law = float(data["convex"]) * small**2
    near = int(np.flatnonzero(small <= 0.4 * um)[-1])
    early = data["ends"] - (float(data["limit"]) - BRIDGE_START - small) / BRIDGE_SPEED
    return [
        Check(
            "a film that stays whole keeps its impulse at every amplitude, to 1e-6",
            off < 1e-6,
            f"changes by at most {off:.1e}",
        ),
        Check(
            "that of a film that cavitates falls with every amplitude, and turns into a push",
            bool(np.all(np.diff(cavitated) < 0.0) and cavitated[-1] < 0.0 < cavitated[0]),
            ", ".join(f"{2.0 * v:.3g}" for v in cavitated) + " N on the mean",
        ),
        Check(
            "no pull exceeds strength times area; pushes do, by far",
            bool(
                data["pull"].max() <= STRENGTH * np.pi * 1e-6 * (1 + 1e-9)
                and data["pull"].min() < -2.0 * STRENGTH * np.pi * 1e-6
            ),
            f"{data['pull'].max():.3f} and {data['pull'].min():.2f} N",
        ),
        Check(
            "small amplitudes raise the mean meniscus force by a^2 F''/4, to 10 %",
            bool(np.all(np.abs(rise[1 : near + 1] / law[1 : near + 1] - 1.0) < 0.1)),
            f"{1e9 * rise[near]:.3g} against {1e9 * law[near]:.3g} nN at {small[near] / um:.2g} um",
        ),
        Check(
            "larger ones raise it by more",
            bool(np.all(np.diff(rise[1:] / law[1:]) > 0.0)),
            ", ".join(f"{v:.2f}" for v in rise[1:] / law[1:]) + " of a^2 F''/4",
        ),
        Check(
            "the meniscus breaks when the mean gap and the amplitude reach its limit, to a cycle",
            bool(np.all(np.abs(early) < 1.5 / FREQUENCY)),
            f"{data['ends'][0]:.3f} to {data['ends'][-1]:.3f} s",
        ),
    ]


def table(data: Data) -> Table:
    """Mean viscous forces over the amplitude."""
    rows = zip(data["amplitudes"] / um, 2.0 * data["whole"], 2.0 * data["cavitated"], strict=True)
    return Table(
        ("amplitude [um]", "whole film [N]", "film that cavitates [N]"),
        [tuple(map(float, row)) for row in rows],
    )


if __name__ == "__main__":
    run_page(__file__)
