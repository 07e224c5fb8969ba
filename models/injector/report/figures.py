"""Figures of the fuel injector: gaps in um, times in ms, forces in N."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ....plot import style as plot
from ....separation.effects.base import LimitKind
from ....units import bar
from ..scene import InjectorScene
from ..valve import energising_times
from .cosimulation import InjectorRun
from .cycles import cycles
from .delay_figures import delays_over_pressure, delays_over_strength, delays_over_temperature

__all__ = ["draw"]

# Of Okabe and Ito: told apart by those who see few colours, and in grey.
_GIVEN, _SUSTAINED, _PULL = "#0072b2", "#d55e00", "#009e73"


def draw(
    scene: InjectorScene, runs: Sequence[InjectorRun], out: Path, dry: float, pull: float
) -> tuple[Path, ...]:
    """Draw every figure into a folder; with the dry delay [s] and the largest pull [N]."""
    files = [_balance(scene, run, out) for run in runs if not run.sustained]
    files += [_zoom(scene, runs, out), _cycle(scene, runs, out)]
    files.append(delays_over_temperature(scene, runs, out, dry))
    limit = scene.tension_limit
    if limit is not None and limit.cavity == "mass-conserving":
        if scene.study.ambient_pressures:
            files.append(delays_over_pressure(scene, limit, out, dry, pull))
        if scene.study.strengths:
            files.append(delays_over_strength(scene, limit, out, dry, pull))
    return tuple(files)


def _line(run: InjectorRun) -> dict[str, Any]:
    """Line style of the oil of a run."""
    return {"color": _SUSTAINED, "ls": "--"} if run.sustained else {"color": _GIVEN, "ls": "-"}


def _oil(scene: InjectorScene, run: InjectorRun) -> str:
    """Oil of a run, for a legend."""
    limit = scene.tension_limit
    if limit is None:
        return "oil that never cavitates"
    if run.sustained:
        return f"goes on to sustain {limit.tension / bar:g} bar once cavitated"
    held = limit.pressure_in_cavity / bar
    return f"cavitates at {limit.tension / bar:g} bar, cavity at {held:.3g} bar"


def _mark_cavitated(ax: Any, run: InjectorRun, time: Any, **more: Any) -> None:
    """Mark where the film is cavitated by a bar along the bottom."""
    acts = run.coupled["limit"] == LimitKind.TENSION
    across = ax.get_xaxis_transform()
    look = {"color": plot.COLORS["limit"], "lw": 0, "zorder": 0}
    ax.fill_between(time, 0, 0.03, where=acts, transform=across, **look, **more)


def _gap(ax: Any, scene: InjectorScene, run: InjectorRun, time: Any) -> None:
    """Draw the gap, and where the spool meets the asperities and the stop."""
    ax.plot(time, run.coupled["h"] * 1e6, color=plot.COLORS["gap"])
    for gap, text in ((scene.loading.rest_gap, "at rest"), (scene.valve.stop.gap, "stop")):
        ax.axhline(gap * 1e6, color="0.6", lw=0.8, ls=":")
        plot.note(ax, text, gap * 1e6)
    ax.set_ylabel("gap at the end cap [um]")


def _forces(ax: Any, run: InjectorRun, time: Any) -> None:
    """Draw what opens as positive and what holds as negative; the stop, which rings, behind.

    Beyond the largest force of the magnet the ordinate is logarithmic: impacts are far larger.
    """
    signals = run.coupled
    for name, label, color, sign in (
        ("F_mag", "magnet, opens", "magnet", 1.0),
        ("F_spring", "return spring", "spring", -1.0),
        ("F_stop", "opposite stop", "stop", -1.0),
        ("F_v", "viscous film", "viscous", -1.0),
        ("F_m", f"meniscus (at most {signals['F_m'].max():.1f} N)", "meniscus", -1.0),
    ):
        if name == "F_m" and not signals[name].any():
            continue
        behind = {"lw": 0.7, "zorder": 1.5} if name == "F_stop" else {}
        ax.plot(time, sign * signals[name], color=plot.COLORS[color], label=label, **behind)
    top = 1.15 * float(signals["F_mag"].max())
    deepest = max(top, 1.3 * float(signals["F_stop"].max()))
    ax.set_yscale("symlog", linthresh=top, linscale=2.0)
    ax.set_ylim(-deepest, top)
    step = 10.0 ** math.floor(math.log10(top))
    n, every = int(top / step), 2 if top > 3.0 * step else 1
    inside = [k * step for k in range(-(n - n % every), n + 1, every)]
    tens = [-(10.0**k) for k in range(1, 9) if top < 10.0**k <= deepest]
    ax.set_yticks([*tens, *inside])
    ax.yaxis.set_major_formatter("{x:g}")
    ax.minorticks_off()
    ax.axhline(0.0, color="0.3", lw=0.6)
    ax.set_ylabel("force on the spool [N]")


def _balance(scene: InjectorScene, run: InjectorRun, out: Path) -> Path:
    """First cycle: gap, speed and forces; left its opening alone, where forces change fast."""
    made, axes = plot.figure(3, 2, (12.0, 8.0), sharey="row", sharex="col", squeeze=False)
    profile = scene.valve.profile
    time = (run.coupled.time - profile.start_delay) * 1e3
    first = cycles(run, scene)[0].delay
    opening = profile.on_time if math.isnan(first) else min(2.0 * first, profile.on_time)
    ends = (opening * 1e3, min(profile.period * 1e3, float(time[-1])))
    for (gap, speed, force), end in zip(axes.T, ends, strict=True):
        shown = (time > -0.05 * end) & (time < end)
        _gap(gap, scene, run, time)
        speed.plot(time, run.coupled["v"], color=plot.COLORS["speed"])
        _forces(force, run, time)
        for ax in (gap, force):
            _mark_cavitated(ax, run, time, label="film cavitated" if ax is force else None)
        force.set(xlabel="time since energising [ms]", xlim=(-0.05 * end, end))
        gap.set_ylim(0.0, 1.15e6 * float(run.coupled["h"][shown].max()))
    for ax in axes[:, 1]:
        ax.set_ylabel("")
    axes[1, 0].set_ylabel("speed of the spool [m/s]")
    plot.shared_legend(made, axes[2, 0])
    head = f"{scene.name}, oil at {run.label}"
    forces = "up opens, down holds; logarithmic beyond the magnet"
    plot.letters(axes.flat, (f"{head}: opening", "first cycle", "", "", forces, ""))
    return plot.save(made, out / f"force-balance_{run.name}")


def _by_temperature(runs: Sequence[InjectorRun]) -> dict[float, list[InjectorRun]]:
    found: dict[float, list[InjectorRun]] = {}
    for run in runs:
        found.setdefault(run.temperature, []).append(run)
    return found


def _void_percent(scene: InjectorScene, run: InjectorRun) -> Any:
    """Void over the volume between the faces [%]."""
    area = math.pi * scene.interface.rim_radius**2
    return 100.0 * run.coupled["V_void"] / (area * run.coupled["h"])


def _zoom(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path) -> Path:
    """First release at each temperature: gap, force of the film, and radius of the cavity."""
    columns = _by_temperature(runs)
    made, axes = plot.figure(
        3, len(columns), (4.2 * len(columns), 8.0), sharey="row", sharex=True, squeeze=False
    )
    start, rim = energising_times(scene.valve.profile)[0], scene.interface.rim_radius
    delays = [cycles(run, scene)[0].delay for run in runs]
    span = 1.15e3 * max([d for d in delays if not math.isnan(d)] or [scene.valve.profile.on_time])
    highest = 0.0
    for (gap, force, cavity), same in zip(axes.T, columns.values(), strict=True):
        for run in same:
            signals, time = run.coupled, (run.coupled.time - start) * 1e3
            style = _line(run) | {"label": _oil(scene, run)}
            gap.plot(time, signals["h"] * 1e6, **style)
            force.plot(time, signals["F"], **style)
            cavity.plot(time, signals["r_cav"] * 1e3, **style)
            _mark_release(gap, scene, cycles(run, scene)[0].delay, run)
        # Of the run that takes longer: of the other, the stop holds the spool by then.
        pulled = same[-1].coupled["F_mag"] - same[-1].coupled["F_spring"]
        force.plot(time, pulled, color=_PULL, ls=":", label="pull of magnet less spring")
        highest = max(highest, float(pulled[time < span].max()))
        plot.title(gap, f"oil at {same[0].label}")
        cavity.axhline(rim * 1e3, color="0.5", lw=0.8)
        plot.note(cavity, "rim", rim * 1e3, below=True)
        cavity.set_xlabel("time since energising [ms]")
    first = axes[:, 0]
    first[0].set_xlim(-0.03 * span, span)
    first[0].set_ylim(0.0, 1.15e6 * scene.valve.stop.gap)
    first[1].set_ylim(-0.05 * highest, 1.1 * highest)
    first[2].set_ylim(0.0, 1.08e3 * rim)
    for ax, label in zip(
        first, ("gap at the end cap [um]", "force [N]", "radius of the cavity [mm]"), strict=True
    ):
        ax.set_ylabel(label)
    plot.shared_legend(made, axes[1][0])
    plot.letters(axes.flat)
    return plot.save(made, out / "release-zoom")


def _mark_release(ax: Any, scene: InjectorScene, after: float, run: InjectorRun) -> None:
    """Point and number of a release, where there is one."""
    if math.isnan(after):
        return
    place, color = (after * 1e3, scene.loading.final_gap * 1e6), _line(run)["color"]
    ax.plot(*place, "o", color=color, ms=5)
    ax.annotate(
        f"{after * 1e3:.3f} ms",
        place,
        xytext=(-7, 4),
        textcoords="offset points",
        ha="right",
        color=color,
        fontsize=9,
        bbox={"fc": "w", "ec": "none", "pad": 0.5},
    )


def _cycle(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path) -> Path:
    """First cycles at each temperature: gap, and how much of it is void."""
    columns, profile = _by_temperature(runs), scene.valve.profile
    made, axes = plot.figure(
        2, len(columns), (4.2 * len(columns), 6.0), sharey="row", sharex=True, squeeze=False
    )
    for (gap, void), same in zip(axes.T, columns.values(), strict=True):
        for run in same:
            time = (run.coupled.time - profile.start_delay) * 1e3
            style = _line(run) | {"label": _oil(scene, run)}
            gap.plot(time, run.coupled["h"] * 1e6, **style)
            void.plot(time, _void_percent(scene, run), **style)
        plot.title(gap, f"oil at {same[0].label}")
        for ax in (gap, void):
            for n in range(min(2, profile.cycles)):
                begin = n * profile.period * 1e3
                pulse = {"label": "current pulse"} if n == 0 else {}
                ax.axvspan(begin, begin + profile.on_time * 1e3, color="0.92", zorder=0, **pulse)
        gap.axhline(scene.loading.rest_gap * 1e6, color="0.4", lw=0.8, ls=":")
        void.set_xlabel("time since energising [ms]")
        void.set_xlim(-0.5, min(2, profile.cycles) * profile.period * 1e3)
    axes[0][0].set_ylabel("gap at the end cap [um]\n(dotted: closed)")
    axes[1][0].set_ylabel("void in the gap [%]")
    axes[0][0].set_ylim(bottom=0.0)
    axes[1][0].set_ylim(0.0, 100.0)
    plot.shared_legend(made, axes[0][0])
    plot.letters(axes.flat)
    return plot.save(made, out / "one-cycle")
