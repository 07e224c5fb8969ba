"""Meniscus or viscous force: which one dominates the separation of two wetted flats.

Compares the two impulses of opening a film at constant speed. Each is proportional to one property
of the liquid, so that one simulation per gap is enough for the map.
"""

from __future__ import annotations

import math
import sys
import warnings
from pathlib import Path

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.units import um

RADIUS, SPEED, TENSION = 1e-3, 1e-3, 0.03  # [m], [m/s], [N/m]


def equal_viscosity(gap: float) -> float:
    """Viscosity [Pa.s] at which both impulses of opening a film tenfold are equal."""
    face = ck.Flat(radius=RADIUS)
    oil = ck.Liquid(name="oil", viscosity=1.0, surface_tension=TENSION)
    film = ck.Meniscus(liquid=oil, volume=math.pi * RADIUS**2 * gap)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=gap, final_gap=10.0 * gap, speed=SPEED),
        effects=(ck.MeniscusForce(), ck.ViscousForce()),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # at 1 Pa.s, not on the line of the map
        result = ck.simulate(ck.plan(scene, ck.Accuracy.draft))
    return result.of(ck.MeniscusForce).impulse / result.of(ck.ViscousForce).impulse


def main(out: Path) -> float:
    """Draw the map; return the viscosity [Pa.s] of equal impulses at 10 um."""
    gaps = [0.1 * um * 10.0 ** (0.1 * i) for i in range(31)]
    equal = [equal_viscosity(gap) for gap in gaps]
    viscosities = [10.0 ** (-4.0 + 0.2 * i) for i in range(26)]
    fraction = [[1.0 / (1.0 + line / eta) for line in equal] for eta in viscosities]
    figure, ax = plot.figure()
    drawn = ax.contourf(
        [gap / um for gap in gaps], viscosities, fraction, 10, cmap="RdYlBu_r", alpha=0.7
    )
    ax.plot([gap / um for gap in gaps], equal, "k--", label="equal impulses")
    for name, viscosity in (("engine oil, 20 degC", 0.27), ("water", 1e-3)):
        ax.axhline(viscosity, color="k", lw=0.6)
        ax.annotate(name, (0.12, 1.2 * viscosity), fontsize=9)
    ax.set(xscale="log", yscale="log", xlabel="gap at the start [um]", ylabel="viscosity [Pa.s]")
    plot.plain_log(ax.xaxis)
    figure.colorbar(drawn, ax=ax, label="viscous fraction of the impulse")
    plot.title(ax, "Plates of 2 mm opened tenfold at 1 mm/s")
    ax.set_ylim(viscosities[0], viscosities[-1])
    plot.legend(ax, loc="lower right")
    plot.save(figure, out / "which_force_holds")
    return equal_viscosity(10.0 * um)


if __name__ == "__main__":
    sys.stdout.write(f"equal impulses at 10 um: {main(Path('out/examples')):.3g} Pa.s\n")
