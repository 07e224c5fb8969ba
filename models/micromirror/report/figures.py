"""The micromirror's figures: its side view, the flips, the lift-off, release and force law."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np

from ....plot import style as plot
from ....separation.effects.meniscus import MeniscusForce
from ..coupling import FREE, couple
from ..release import Release, landing
from ..scene import MicromirrorScene
from ..tip_film import pressure_law, tip_law
from .cosimulation import MirrorRun
from .sketch import sketch

__all__ = ["draw"]

_PLUS, _MINUS = plot.SERIES[1][0], plot.SERIES[2][0]
_PALE = 0.35  # what rings after the tip is free, behind what decides
_RINGING = 30.0  # [us] after a pulse, in which the mirror comes to rest but for a hundredth


def draw(
    scene: MicromirrorScene, run: MirrorRun, found: Sequence[Release], out: Path
) -> tuple[Path, ...]:
    """Draw every figure into a folder."""
    return (
        sketch(scene, run.plan, out),
        _flips(scene, run, out),
        _first_flip(scene, run, out),
        _lift_off(scene, out),
        _release(scene, found, out),
        _law(scene, found, out),
    )


def _flips(scene: MicromirrorScene, run: MirrorRun, out: Path) -> Path:
    """Tilt over all flips, and each of them from its pulse, on each other."""
    made, (over, each) = plot.figure(1, 2, (10.0, 4.2), width_ratios=(3, 2))
    time, tilt = run.coupled["time"] * 1e6, np.degrees(run.coupled["tilt"])
    over.plot(time, tilt, color=_PLUS, lw=0.8)
    edge = math.degrees(scene.mirror.tips.landing_tilt)
    for level in (edge, -edge):
        for ax in (over, each):
            ax.axhline(level, color="0.6", lw=0.8, ls=":")
    over.set(xlabel="time [us]", ylabel="tilt [deg]")
    plot.title(over, f"{scene.mirror.waveform.flips} flips (dotted: unbent tips touch)")
    wave = scene.mirror.waveform
    for i in range(min(wave.flips, len(plot.SERIES))):
        since = time - 1e6 * (wave.start_delay + i * wave.period)
        near = (since > -1.0) & (since < min(_RINGING, 1e6 * wave.period))
        colour, line, _ = plot.SERIES[i]
        sign = 1.0 if i % 2 == 0 else -1.0
        each.plot(since[near], sign * tilt[near], color=colour, ls=line, label=f"flip {i + 1}")
    each.set(xlabel="time since the pulse [us]")
    plot.title(each, "each flip; those back, mirrored")
    plot.legend(each)
    plot.letters((over, each))
    return plot.save(made, out / "flips")


def _first_flip(scene: MicromirrorScene, run: MirrorRun, out: Path) -> Path:
    """First flip from just before its pulse: voltages, tilt, gaps, forces of the tips."""
    wave, signals = scene.mirror.waveform, run.coupled
    made, (volts, tilt, gap, force) = plot.figure(4, 1, (8.0, 10.0), sharex=True)
    time = (signals["time"] - wave.start_delay) * 1e6
    for side, color, label in (("plus", _PLUS, "side +"), ("minus", _MINUS, "side -")):
        volts.plot(time, np.abs(signals[f"volts_{side}"]), color=color, label=label)
        gap.plot(time, signals[f"gap_{side}"] * 1e9, color=color, label=label)
        pull, free = signals[f"force_{side}"] * 1e9, signals[f"state_{side}"] == FREE
        force.plot(time, pull, color=color, alpha=_PALE, lw=0.6)
        force.plot(time, np.where(free, np.nan, pull), color=color, label=label)
    tilt.plot(time, np.degrees(signals["tilt"]), color="k", label="FMUs")
    n = len(run.monolithic.time)
    tilt.plot(
        time[:n:12],
        np.degrees(run.monolithic.unknowns[0, ::12]),
        "o",
        ms=3.5,
        mfc="none",
        color="#e9a23b",
        label="monolithic model, to the first touch",
    )
    plot.legend(tilt)
    volts.set_ylabel("voltage over\nelectrode [V]")
    tilt.set_ylabel("tilt [deg]")
    gap.set(ylabel="gap under a tip [nm]", yscale="log")
    plot.plain_log(gap.yaxis)
    force.set(ylabel="force of the tips\non the mirror [nN]", xlabel="time since the pulse [us]")
    force.axhline(0.0, color="0.3", lw=0.6)
    volts.set_xlim(-1.0, 25.0)
    text = f"first flip at {100 * scene.study.humidity:g} % relative humidity"
    plot.title(volts, text)
    plot.title(
        force, "up: tips hold the side down; down: bent tips push it up; pale: they ring free"
    )
    plot.shared_legend(made, gap)
    plot.letters((volts, tilt, gap, force))
    return plot.save(made, out / "first-flip")


def _chosen(scene: MicromirrorScene) -> list[float]:
    """Pick up to five humidities of the study, from end to end."""
    all_of = list(scene.study.humidities) or [scene.study.humidity]
    n = min(5, len(all_of))
    return [all_of[round(i * (len(all_of) - 1) / max(n - 1, 1))] for i in range(n)]


def _lift_off(scene: MicromirrorScene, out: Path) -> Path:
    """Gap and force of a tip as it leaves, at several humidities, by the spring alone."""
    made, axes = plot.figure(2, 2, (10.0, 6.6), sharex="col", sharey="row")
    pulse = abs(scene.mirror.waveform.reset_voltage)
    for column, reset in enumerate((None, pulse)):
        gap, force = axes[0][column], axes[1][column]
        mirror, last = scene.first_flip(reset), 0.5e-6
        for humidity, (color, line, _) in zip(_chosen(scene), cycle(plot.SERIES), strict=False):
            motion = couple(
                mirror,
                scene.tips(tip_law(scene.tip, humidity)),
                scene.loading.stiffness,
                scene.start,
                1.5e-6,
                0.25 * scene.study.communication_step,
            )
            time = motion["time"] * 1e6
            label = f"{100 * humidity:g} %"
            free = motion["state_plus"] == FREE
            left = int(free.argmax()) if free.any() else len(free)
            for ax, name in ((gap, "gap_plus"), (force, "force_plus")):
                value = motion[name] * 1e9
                ax.plot(time[:left], value[:left], color=color, ls=line, label=label)
                ax.plot(time[left:], value[left:], color=color, lw=0.8, alpha=_PALE)
                ax.plot(time[left : left + 1], value[left : left + 1], "o", color=color, ms=4)
            last = max(last, float(motion["time"][free.argmax()]) if free.any() else 1e-6)
        gap.set_yscale("log")
        plot.plain_log(gap.yaxis)
        gap.set_xlim(0.0, (last + 0.2e-6) * 1e6)
        force.set_xlabel(f"time since the {'end of the bias' if reset is None else 'pulse'} [us]")
        ending = "bias off, spring alone" if reset is None else f"reset pulse of {reset:g} V"
        plot.title(gap, ending)
    axes[0][0].set_ylabel("gap under a tip [nm]")
    axes[1][0].set_ylabel("force of the tips\non the mirror [nN]")
    plot.note(axes[1][0], "dots: the tip is free; pale: it rings", axes[1][0].get_ylim()[0])
    plot.shared_legend(made, axes[0][0])
    plot.letters(axes.flat)
    return plot.save(made, out / "lift-off")


def _release(scene: MicromirrorScene, found: Sequence[Release], out: Path) -> Path:
    """Adhesion and smallest pulse against humidity."""
    made, (force, volts) = plot.figure(2, 1, (7.5, 7.5), sharex=True)
    x = np.array([100 * one.adhesion.humidity for one in found])
    n = scene.mirror.tips.per_side
    parts = [[one.adhesion.solid_force, one.adhesion.meniscus_force] for one in found]
    solid, meniscus = (np.array(parts).reshape(-1, 2).T * n * 1e9).tolist()
    force.stackplot(
        x,
        solid,
        meniscus,
        labels=["van der Waals", "meniscus"],
        colors=[plot.COLORS["spring"], plot.COLORS["meniscus"]],
        alpha=0.6,
    )
    preload = landing(scene).preload * 1e9
    force.axhline(preload, color="k", ls="--", lw=1.0, label="preload of the bent tips")
    force.set_ylabel("force that holds the tips [nN]")
    plot.legend(force, loc="upper left")
    plot.title(force, f"{n} tips of a side, while landed")
    smallest = [one.reset_voltage for one in found]
    volts.plot(x, smallest, "o-", color=plot.COLORS["magnet"], label="smallest pulse that releases")
    wave = scene.mirror.waveform
    volts.axhline(abs(wave.reset_voltage), color="0.4", ls=":", label="pulse of the scene")
    volts.axhline(abs(wave.bias_voltage), color="0.4", ls="--", lw=0.9, label="bias")
    freed = [not math.isnan(one.alone) for one in found]
    across = volts.get_xaxis_transform()
    volts.fill_between(
        x,
        0,
        1,
        where=freed,
        transform=across,
        facecolor="none",
        edgecolor="0.8",
        hatch="//",
        lw=0,
        zorder=0,
        label="spring alone releases",
    )
    volts.set(xlabel="relative humidity [%]", ylabel="reset pulse [V]")
    plot.title(volts, f"reset pulse of {wave.reset_time * 1e6:g} us")
    plot.legend(volts, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)
    plot.letters((force, volts))
    return plot.save(made, out / "release-against-humidity")


def _law(scene: MicromirrorScene, found: Sequence[Release], out: Path) -> Path:
    """Force on one tip over the gap: condensed and conserved, and at the vapour's pressure."""
    made, ax = plot.figure(size=(8.0, 5.0))
    start = scene.loading.initial_gap
    wet = [one.adhesion for one in found if one.adhesion.volume > 0.0]
    widest = max((held.break_gap for held in wet), default=10.0 * start)
    gaps = np.geomspace(start, 1.1 * widest, 160)
    picked = wet[:: max(1, math.ceil(len(wet) / 4))]
    for held, (color, *_) in zip(picked, cycle(plot.SERIES), strict=False):
        law = tip_law(scene.tip, held.humidity).film.laws[MeniscusForce]
        some = gaps[gaps < held.break_gap]
        forces = [law.force(float(gap), 0.0) * 1e9 for gap in some]
        label = f"{100 * held.humidity:g} %"
        ax.plot(some * 1e9, forces, color=color, label=f"meniscus, {label}, volume kept")
        ax.plot(some[-1] * 1e9, forces[-1], "x", color=color, ms=7, mew=1.8)
        at_pressure = pressure_law(scene.tip, held.humidity, gaps)
        kept = at_pressure > 0.0
        ax.plot(gaps[kept] * 1e9, at_pressure[kept] * 1e9, "--", color=color, lw=1.1)
    dry = tip_law(scene.tip, 0.0).film
    ax.plot(
        gaps * 1e9,
        [dry.static_force(float(g)) * 1e9 for g in gaps],
        ":",
        color=plot.COLORS["spring"],
        label="van der Waals",
    )
    _load_line(ax, scene, gaps)
    ax.plot([], [], "--", color="0.4", lw=1.1, label="dashed: pressure of the vapour kept")
    ax.plot([], [], "x", color="0.4", label="meniscus breaks")
    ax.set(xscale="log", xlabel="gap under a tip [nm]", ylabel="force on one tip [nN]")
    ax.set_ylim(0.0, None)
    plot.plain_log(ax.xaxis)
    plot.title(ax, "adhesion of a tip over its gap")
    plot.legend(ax, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return plot.save(made, out / "force-gap")


def _load_line(ax: Any, scene: MicromirrorScene, gaps: Any) -> None:
    """Draw how little the spring of a tip gives way over the range of the meniscus."""
    preload = landing(scene).preload / scene.mirror.tips.per_side
    line = preload - scene.loading.stiffness * (gaps - gaps[0])
    kept = line > 0.0
    ax.plot(
        gaps[kept] * 1e9,
        line[kept] * 1e9,
        "-",
        color="0.5",
        lw=1.0,
        label="spring of a tip, bent back as far",
    )
