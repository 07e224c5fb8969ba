"""The picture of all ways of coupling: error against steps and seconds, and where each fails."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ...plot import separation as plot
from .coupling_schemes import WAYS, Case, Run, Way

__all__ = ["coupling_figure"]

# Okabe and Ito's colours, which the colour-blind tell apart; a mark of its own for each way.
_LOOKS: dict[Way, tuple[str, str, str]] = {
    "jacobi": ("#D55E00", "o", "forces, explicit (Jacobi)"),
    "gauss-seidel": ("#E69F00", "s", "forces, explicit (Gauss-Seidel)"),
    "end-point": ("#CC79A7", "v", "forces, implicit at the end point"),
    "impulse": ("#56B4E9", "^", "impulses, fixed steps"),
    "impulse, adaptive": ("#0072B2", "D", "impulses, steps by their error"),
    "mass inside, held": ("#999999", "P", "mass inside the FMU, pull held"),
    "mass inside": ("#009E73", "*", "mass inside the FMU, pull a line"),
}
_LOW, _WRONG, _HIGH = 1e-12, 0.3, 1e4  # where errors are drawn, and from where they are lies
_KNOWN = 3e-11  # how well the release time itself is known
_STRIP = 30.0  # where runs that end with an error message are drawn
_LAST = 3e3  # steps shown
_DARK = "#8a3c00"


def coupling_figure(found: Sequence[tuple[Case, float, Sequence[Run]]], out: Path) -> Path:
    """Draw the ways for some cases: steps above, seconds below.

    Parameters
    ----------
    found : sequence of (case, release time [s], runs)
        From `coupling_ways.runs`.
    out : Path
        Folder of the picture.
    """
    made, axes = plot.figure(2, len(found), size=(4.4 * len(found), 9.0), sharey=True)
    for column, (case, release, runs) in enumerate(found):
        for ax, of in zip(axes[:, column], ("steps", "seconds"), strict=True):
            for way in WAYS:
                _line(ax, [run for run in runs if run.way == way], way, of)
            _dress(ax, of)
        stable = release / case.stable_step
        plot.title(axes[0, column], f"{case.name}: released after {_time(release)}")
        _limit(axes[0, column], stable, case.stable_step)
    _names(axes[0, -1])
    for ax in axes[:, 0]:
        _bands(ax)
        ax.set_ylabel("relative error of the release time")
    plot.shared_legend(made, axes[0, 0])
    return plot.save(made, out / "coupling")


def _line(ax: Any, runs: Sequence[Run], way: Way, of: str) -> None:
    """One way: a line where it is right, hollow marks where it lies, crosses where it stops."""
    color, marker, label = _LOOKS[way]
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
    # All lies are of some 100 %: they are set side by side, so that none hides another.
    place = {"jacobi": 3.0, "gauss-seidel": 0.9}.get(way, 1.6)
    lies = [(getattr(run, of), place) for run in runs if run.error > _WRONG]
    if lies:
        ax.plot(
            *zip(*lies, strict=True),
            ls="none",
            color=color,
            marker=marker,
            ms=7,
            mfc="white",
            mew=1.8,
            zorder=4,
        )
    if of == "steps":
        row = WAYS.index(way)
        stops = [(run.steps, _STRIP * 2.0**row) for run in runs if run.problem]
        if stops:
            ax.plot(*zip(*stops, strict=True), ls="none", color=color, marker="x", ms=7, mew=2.0)


def _dress(ax: Any, of: str) -> None:
    """Bands of the lies, of what stops, and of what is not known better."""
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
    """Name the ways where they lie far apart, on the stiffest film."""
    names: tuple[tuple[float, float, Way, str], ...] = (
        (1.3, 1.3e3, "end-point", "implicit forces: lose their root"),
        (1.3, 0.012, "impulse", "impulses,\nfixed steps"),
        (30.0, 3e-5, "impulse, adaptive", "impulses, steps by their error"),
        (1.3, 1.5e-10, "mass inside", "mass inside the FMU"),
    )
    for x, y, way, text in names:
        ax.text(x, y, text, fontsize=9, color=_LOOKS[way][0], weight="bold", va="center")


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
