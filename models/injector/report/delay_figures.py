"""Release delays of the fuel injector over what its oil does: figures by the monolithic model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ....plot import style as plot
from ....separation.effects.viscous import TensionLimit
from ....units import bar, celsius
from ..delays import delay
from ..scene import InjectorScene
from .cosimulation import InjectorRun
from .cycles import cycles, held_pressure

__all__ = ["delays_over_pressure", "delays_over_strength", "delays_over_temperature"]

# Of Okabe and Ito: told apart by those who see few colours.
_SUSTAINED, _NEVER = "#d55e00", "#000000"
_PRESSURES = ("#0072b2", "#56b4e9", "#cc79a7", "#009e73")
_COLD_TO_WARM = ("#0072b2", "#009e73", "#d55e00", "#cc79a7", "#56b4e9")
_RTOL = 1e-5  # of delays that are drawn


class _Curve(NamedTuple):
    """Delays of one kind of oil: label, oil as in `InjectorScene.separation`, style."""

    label: str
    oil: dict[str, Any]
    style: dict[str, Any]


_SUSTAINING = _Curve(
    "goes on to sustain its strength",
    {"cavity_pressure": -math.inf},
    {"color": _SUSTAINED, "ls": "--"},
)
_NEVER_CAVITATES = _Curve(
    "oil that never cavitates", {"cavitates": False}, {"color": _NEVER, "ls": ":"}
)


def delays_over_temperature(
    scene: InjectorScene, runs: Sequence[InjectorRun], out: Path, dry: float
) -> Path:
    """Release delay over temperature, for several pressures in the cavity."""
    made, ax = plot.figure(size=(9.0, 5.0))
    limit, span = scene.tension_limit, scene.study.temperatures
    temperatures = sorted({*np.linspace(min(span), max(span), 5).tolist(), *span})
    x = [t - celsius(0.0) for t in temperatures]
    across, longest = ax.get_xaxis_transform(), dry
    for curve in _curves_over_temperature(scene, limit):
        delays = [delay(scene, t, rtol=_RTOL, **curve.oil) for t in temperatures]
        never = [one for one, d in zip(x, delays, strict=True) if math.isnan(d)]
        longest = max([longest, *(d for d in delays if not math.isnan(d))])
        lost = {"color": curve.style["color"], "ls": "none", "marker": "x", "ms": 7}
        if len(never) == len(x):
            ax.plot([], [], label=f"{curve.label}:\nnot released within the pulse", **lost)
            continue
        ax.plot(x, [d * 1e3 for d in delays], label=curve.label, **curve.style)
        ax.plot(never, [0.97] * len(never), transform=across, **lost)
    for run in runs:
        after = cycles(run, scene)[0].delay * 1e3
        ax.plot(run.temperature - celsius(0.0), after, "o", color="k", mfc="none")
    ax.plot([], [], "o", color="k", mfc="none", label="FMU pair")
    ax.axhline(dry * 1e3, color="0.5", ls=(0, (1, 3)), lw=0.8)
    plot.note(ax, "dry spool", dry * 1e3, below=True)
    ax.set(ylim=(0.0, 1.4e3 * longest), xlabel="oil temperature [degC]")
    ax.set_ylabel("release delay after energising [ms]")
    bears = f", oil that cavitates at {limit.tension / bar:g} bar" if limit is not None else ""
    plot.title(ax, f"release delay over temperature{bears}")
    plot.legend(ax, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return plot.save(made, out / "delay-against-temperature")


def _curves_over_temperature(scene: InjectorScene, limit: TensionLimit | None) -> list[_Curve]:
    if limit is None:
        return [_NEVER_CAVITATES]
    if limit.cavity != "mass-conserving":
        return [_Curve("as in the scene", {}, {"color": _PRESSURES[0]}), _NEVER_CAVITATES]
    # Those that differ from an oil that sustains its strength.
    lowest = limit.ambient_pressure - limit.tension + 0.01 * limit.tension
    return [
        *(c for c in _held(scene) if c.oil["cavity_pressure"] > lowest),
        _SUSTAINING,
        _NEVER_CAVITATES,
    ]


def _held(scene: InjectorScene) -> list[_Curve]:
    """A curve for each pressure in the cavity."""
    return [
        _Curve(f"cavity at {p / bar:g} bar", {"cavity_pressure": p}, {"color": color})
        for p, color in zip(scene.study.cavity_pressures, _PRESSURES, strict=False)
    ]


def _draw(
    ax: Any, scene: InjectorScene, curve: _Curve, x: Sequence[float], delays: Sequence[float]
) -> None:
    """A curve of delays, with crosses at the end of the pulse where there is no release."""
    pulse, color = scene.valve.profile.on_time * 1e3, curve.style["color"]
    # The crosses of several curves share their places: the earlier ones are the larger.
    size = max(14 - 2 * len(ax.lines), 5)
    ax.plot(x, [d * 1e3 for d in delays], label=curve.label, **curve.style)
    never = [one for one, d in zip(x, delays, strict=True) if math.isnan(d)]
    ax.plot(never, [pulse] * len(never), "x", color=color, ms=size, mew=1.6)


def _finish(ax: Any, scene: InjectorScene, dry: float) -> None:
    pulse = scene.valve.profile.on_time * 1e3
    ax.plot([], [], "x", color="k", label="not released within the pulse")
    for height, text in ((pulse, "end of the current pulse"), (dry * 1e3, "dry spool")):
        ax.axhline(height, color="0.5", ls=(0, (1, 3)), lw=0.8)
        plot.note(ax, text, height, below=True)
    ax.set_ylabel("release delay after energising [ms]")
    ax.set_yscale("log")
    ax.set_ylim(0.85e3 * dry if dry > 0.0 else None, 1.25 * pulse)
    plot.plain_log(ax.yaxis)


def delays_over_strength(
    scene: InjectorScene, limit: TensionLimit, out: Path, dry: float, pull: float
) -> Path:
    """Release delay over the strength of the oil, for several pressures in the cavity."""
    span = scene.study.temperatures
    shown = sorted({min(span), max(span)})
    n = len(shown)
    made, axes = plot.figure(1, n, (5.2 * n, 5.0), sharey=True, squeeze=False)
    area = math.pi * scene.interface.rim_radius**2
    whole = 2.0 * pull / area / bar
    for ax, temperature in zip(axes[0], shown, strict=True):
        for curve in (*_held(scene), _SUSTAINING):
            strengths = _strengths(scene, limit.ambient_pressure - curve.oil["cavity_pressure"])
            delays = [
                delay(scene, temperature, strength=s, rtol=_RTOL, **curve.oil) for s in strengths
            ]
            marked = curve._replace(style=curve.style | {"marker": "."})
            _draw(ax, scene, marked, [s / bar for s in strengths], delays)
        _finish(ax, scene, dry)
        _threshold(ax, whole, "beyond, no pull on a\nresting spool cavitates", 0.6)
        ax.set_xlabel("strength of the oil, below ambient pressure [bar]")
        plot.title(ax, f"oil at {temperature - celsius(0.0):+.0f} degC")
    for ax in axes[0][1:]:
        ax.set_ylabel("")
    plot.shared_legend(made, axes[0][0])
    plot.letters(axes.flat)
    return plot.save(made, out / "delay-against-strength")


def delays_over_pressure(
    scene: InjectorScene, limit: TensionLimit, out: Path, dry: float, pull: float
) -> Path:
    """Release delay over the pressure around the face, for each temperature of the study."""
    made, ax = plot.figure(size=(9.0, 5.0))
    around = sorted(scene.study.ambient_pressures)
    for temperature, color in zip(scene.study.temperatures, _COLD_TO_WARM, strict=False):
        delays = [delay(scene, temperature, ambient_pressure=p, rtol=_RTOL) for p in around]
        label = f"oil at {temperature - celsius(0.0):+.0f} degC"
        curve = _Curve(label, {}, {"color": color, "marker": "."})
        _draw(ax, scene, curve, [p / bar for p in around], delays)
    _finish(ax, scene, dry)
    held = held_pressure(scene, limit, pull) / bar
    _threshold(ax, held, "the cavity holds\nthe whole pull", 0.7)
    ax.axvline(limit.ambient_pressure / bar, color="0.5", lw=0.8, ls=":")
    ax.set_xlabel("pressure of the oil around the face, absolute [bar]")
    lowest = (limit.ambient_pressure - limit.tension) / bar
    plot.title(
        ax,
        f"release delay over the pressure around the face (dotted: the scene's)\noil that "
        f"cavitates at {lowest:.3g} bar, cavity at {limit.pressure_in_cavity / bar:.3g} bar",
    )
    plot.legend(ax, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return plot.save(made, out / "delay-against-pressure")


def _threshold(ax: Any, x: float, text: str, height: float) -> None:
    """Mark a place on the axis, with words to its left at a part of the height."""
    ax.axvline(x, color="0.5", lw=0.8, ls="-.")
    ax.annotate(
        text,
        (x, height),
        xytext=(-4, 0),
        textcoords="offset points",
        ha="right",
        fontsize=8,
        xycoords=("data", "axes fraction"),
        color="0.4",
    )


def _strengths(scene: InjectorScene, drop: float) -> list[float]:
    """Strengths [Pa] of the study that an oil with a pressure drop of its cavity can have."""
    found = sorted(scene.study.strengths)
    if math.isinf(drop):
        return found
    return sorted({drop, *(s for s in found if s >= drop)})
