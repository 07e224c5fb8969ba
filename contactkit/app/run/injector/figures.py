"""Figures of the fuel injector: gaps in um, times in ms, forces in N."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from typing import Any

from ....models.injector.scene import InjectorScene
from ....models.injector.valve import energising_times
from ....plot import separation as plot
from ....separation.effects.base import LimitKind
from ....units import bar, celsius
from .cosimulation import InjectorRun
from .cycles import cycles, delays_over_temperature, stem

__all__ = ["draw"]

_OIL = ("#264653", "#2a9d8f", "#e9a23b", "#e76f51", "#8a1c1c")


def draw(
    scene: InjectorScene, runs: Sequence[InjectorRun], out: Path, dry: float
) -> tuple[Path, ...]:
    """Draw every figure into a folder."""
    limited = [run for run in runs if run.limited]
    files = [_balance(scene, run, out) for run in limited]
    files.append(_zoom(scene, limited, out))
    files.append(_delays(scene, runs, out, dry))
    if len(limited) < len(runs):
        files.append(_limit(scene, runs, out))
    return tuple(files)


def _shade(ax: Any, run: InjectorRun, time: Any, **more: Any) -> None:
    """Shade where the tension limit acts."""
    acts = run.coupled["limit"] == LimitKind.TENSION
    across = ax.get_xaxis_transform()
    ax.fill_between(
        time,
        0,
        1,
        where=acts,
        transform=across,
        color=plot.COLORS["limit"],
        alpha=0.35,
        lw=0,
        **more,
    )


def _gap(ax: Any, scene: InjectorScene, run: InjectorRun, time: Any) -> None:
    """Draw the gap, and where the spool meets the asperities and the stop."""
    ax.plot(time, run.coupled["h"] * 1e6, color=plot.COLORS["gap"])
    for gap, text in ((scene.loading.rest_gap, "at rest"), (scene.valve.stop.gap, "stop")):
        ax.axhline(gap * 1e6, color="0.6", lw=0.8, ls=":")
        ax.annotate(
            text,
            (0.0, gap * 1e6),
            xycoords=("axes fraction", "data"),
            xytext=(4, 3),
            textcoords="offset points",
            color="0.4",
            fontsize=8,
        )
    ax.set_ylabel("gap at the end cap [um]")


def _forces(ax: Any, run: InjectorRun, time: Any) -> None:
    """Draw what opens as positive and what holds as negative."""
    signals = run.coupled
    for name, label, color, sign in (
        ("F_mag", "magnet, opens", "magnet", 1.0),
        ("F_spring", "return spring", "spring", -1.0),
        ("F_stop", "opposite stop", "stop", -1.0),
        ("F_v", "viscous film", "viscous", -1.0),
        ("F_m", f"meniscus (at most {signals['F_m'].max():.1f} N)", "meniscus", -1.0),
    ):
        ax.plot(time, sign * signals[name], color=plot.COLORS[color], label=label)
    top = 1.15 * float(signals["F_mag"].max())
    ax.set_ylim(-top, top)
    ax.axhline(0.0, color="0.3", lw=0.6)
    ax.set_ylabel("force on the spool [N]")


def _balance(scene: InjectorScene, run: InjectorRun, out: Path) -> Path:
    made, (gap, speed, force) = plot.figure(3, 1, (9.0, 8.0), sharex=True)
    time = run.coupled.time * 1e3
    _gap(gap, scene, run, time)
    plot.title(gap, f"{scene.name}, oil at {run.label}: {scene.valve.profile.cycles} firing cycles")
    speed.plot(time, run.coupled["v"], color=plot.COLORS["speed"])
    speed.set_ylabel("speed of the spool [m/s]")
    _forces(force, run, time)
    for ax in (gap, force):
        _shade(ax, run, time, label="tension limit acts" if ax is force else None)
    plot.shared_legend(made, force)
    plot.title(force, "forces: up opens, down holds (impacts on the stop are cut off)")
    force.set_xlabel("time [ms]")
    return plot.save(made, out / f"force-balance_{stem(run.temperature)}")


def _mark_events(ax: Any, run: InjectorRun, start: float, span: float) -> None:
    """Mark the first rupture and the first release within `span` [ms] of energising."""
    for name, label, color in (
        ("t_break", "film breaks", plot.COLORS["viscous"]),
        ("t_release", "released", "0.3"),
    ):
        when = float(run.coupled[name][run.coupled.time <= start + 1e-3 * span][-1])
        if when > 0.0:
            ax.axvline((when - start) * 1e3, color=color, lw=0.9, ls="--", label=label)


def _zoom(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path) -> Path:
    """First release at each temperature, gap above forces, from just before energising."""
    made, axes = plot.figure(2, len(runs), (4.2 * len(runs), 6.5), sharey="row", squeeze=False)
    start = energising_times(scene.valve.profile)[0]
    for column, run in enumerate(runs):
        gap, force = axes[0][column], axes[1][column]
        time = (run.coupled.time - start) * 1e3
        first = cycles(run, scene)[0].delay
        span = (1.5 * first if not math.isnan(first) else scene.valve.profile.on_time) * 1e3
        _gap(gap, scene, run, time)
        _forces(force, run, time)
        for ax in (gap, force):
            _shade(ax, run, time, label="tension limit acts" if ax is force else None)
            ax.set_xlim(-0.05 * span, span)
            _mark_events(ax, run, start, span)
        ending = "never released" if math.isnan(first) else f"released after {first * 1e3:.3f} ms"
        plot.title(gap, f"oil at {run.label}: {ending}")
        force.set_xlabel("time since energising [ms]")
        if column:
            gap.set_ylabel("")
            force.set_ylabel("")
    plot.shared_legend(made, axes[1][0])
    return plot.save(made, out / "release-zoom")


def _delays(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path, dry: float) -> Path:
    """Release delay over temperature, for several tensile strengths of the oil."""
    made, ax = plot.figure(size=(9.0, 5.0))
    pulse = scene.valve.profile.on_time * 1e3
    curves: list[tuple[str, bool, float | None]] = [
        (f"tensile strength {t / bar:g} bar", True, t) for t in scene.study.tension_limits
    ]
    if not curves and any(run.limited for run in runs):
        curves = [("with the tension limit", True, None)]
    curves.append(("no tension limit", False, None))
    sizes = range(4 * len(curves) + 2, 2, -4)
    for (label, limited, tension), color, size in zip(curves, cycle(_OIL), sizes, strict=False):
        temperatures, delays = delays_over_temperature(scene, limited=limited, tension=tension)
        x = [t - celsius(0.0) for t in temperatures]
        ax.plot(x, [d * 1e3 for d in delays], "-", color=color, label=label)
        never = [t for t, d in zip(x, delays, strict=True) if math.isnan(d)]
        # The crosses of several curves share their places: the earlier ones are the larger.
        ax.plot(never, [pulse] * len(never), "x", color=color, ms=size, mew=1.6)
    for run in runs:
        delay = cycles(run, scene)[0].delay * 1e3
        ax.plot(run.temperature - celsius(0.0), delay, "o", color="k", mfc="none")
    ax.plot([], [], "o", color="k", mfc="none", label="FMU pair")
    ax.plot([], [], "x", color="k", label="not released within the pulse (colour of its curve)")
    ax.axhline(pulse, color="0.5", ls="--", lw=0.8, label="end of the current pulse")
    ax.axhline(dry * 1e3, color="0.5", ls=":", label="dry spool: magnet, spring, mass")
    ax.set(xlabel="oil temperature [degC]", ylabel="release delay after energising [ms]")
    ax.set_yscale("log")
    ax.set_ylim(0.8 * dry * 1e3, 1.2 * pulse)
    plot.plain_log(ax.yaxis)
    plot.title(ax, f"{scene.name}: release delay against temperature")
    plot.legend(ax, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return plot.save(made, out / "delay-against-temperature")


def _limit(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path) -> Path:
    """First pulse at each temperature, with and without the tension limit."""
    profile = scene.valve.profile
    temperatures = list(dict.fromkeys(run.temperature for run in runs))
    n = len(temperatures)
    made, axes = plot.figure(1, n, (4.2 * n, 4.4), sharey=True, squeeze=False)
    for run in runs:
        ax = axes[0][temperatures.index(run.temperature)]
        ax.plot(
            (run.coupled.time - profile.start_delay) * 1e3,
            run.coupled["h"] * 1e6,
            "-" if run.limited else "--",
            color=_OIL[1] if run.limited else _OIL[3],
            label="with the tension limit" if run.limited else "without it",
        )
        plot.title(ax, f"oil at {run.label}")
    for ax in axes[0]:
        ax.axvspan(0.0, profile.on_time * 1e3, color="0.93", zorder=0, label="current pulse")
        ax.set_xlim(-0.1 * profile.on_time * 1e3, 1.6 * profile.on_time * 1e3)
        ax.set_xlabel("time since energising [ms]")
    axes[0][0].set_ylabel("gap at the end cap [um]")
    plot.shared_legend(made, axes[0][0])
    return plot.save(made, out / "tension-limit")
