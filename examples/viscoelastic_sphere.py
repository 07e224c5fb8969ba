"""A sphere on rubber: creep under a held load, loss of a press and release, pull-off over speed.

Creep is that of Lee and Radok, the release that of Ting. With adhesion a contact that has relaxed
holds several times the pull-off force of an elastic one, the more the faster it is pulled.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.elasticity.prony import creep_compliance, creep_of, relaxation_modulus
from contactkit.plot import style as plot
from contactkit.reference.viscoelastic import Triangle, creep_radius, triangular_approach
from contactkit.units import MPa, mm

RADIUS, FORCE, DEPTH = 1 * mm, 1e-4, 1e-6  # [m], [N], [m]
RUBBER = ck.ViscoelasticMaterial(
    name="rubber", young_modulus=10 * MPa, fractions=(0.5, 0.4), times=(0.1, 1.0), poisson_ratio=0.5
)
WORK, TIP = 0.05, 1e-4  # work of adhesion [J/m2], radius of the tip [m]
PULL_OFF = 1.5 * math.pi * WORK * TIP  # of an elastic tip (JKR) [N]
CLOSE, APART = 4e-7, -2.2e-6  # approaches of the tip before and after the pull [m]
SECONDS = (1e3, 100.0, 30.0, 10.0, 1.0, 0.1, 1e-2)  # of the pull


def solved(radius: float, width: float, loading: Any, *effects: Any, grid: int) -> Any:
    """History of a rigid sphere on the rubber, isolated."""
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=RUBBER), upper=ck.Body(surface=ck.Paraboloid(radius=radius))
        ),
        window=ck.Window(width=width, periodic=False),
        loading=loading,
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=grid))).of(ck.Viscoelasticity)


def creep(ax: Any) -> None:
    """Contact radius under a load that is held, next to the closed form."""
    held = ck.Viscoelasticity(times=np.logspace(-3, 2, 21), steps=1)
    part = solved(RADIUS, 110e-6, ck.Pressing(force=FORCE), held, grid=128)
    t = np.logspace(-3, 2, 100)
    compliance = creep_compliance(creep_of(RUBBER.relaxation), t)
    exact = creep_radius(FORCE, RADIUS, RUBBER.poisson_ratio, compliance)
    ax.semilogx(t, 1e6 * exact, color="k", lw=1.0, label="Lee and Radok")
    radius = np.sqrt(part.contact_area / math.pi)
    ax.plot(part.time[2:], 1e6 * radius[2:], "o", color="#0072b2", ms=4.0, label="128 x 128 pixels")
    ax.set(xlabel="time [s]", ylabel="contact radius [µm]")
    plot.title(ax, "A load of 100 µN, held")
    plot.legend(ax, loc="upper left")


def release(ax: Any) -> float:
    """Loads of a press and a release at one speed; the largest deviation from Ting [-]."""
    worst = 0.0
    for turn, colour, line in ((10.0, "#0072b2", "-"), (0.3, "#d55e00", "--")):
        back = ck.Viscoelasticity(times=(turn, 2.0 * turn), approaches=DEPTH, steps=32)
        part = solved(RADIUS, 84e-6, ck.Approach(approach=0.0), back, grid=96)
        path = Triangle(DEPTH / turn, turn)
        exact = np.array(
            [
                triangular_approach(
                    t, path, RADIUS, 0.5, lambda lag: relaxation_modulus(RUBBER.relaxation, lag)
                ).load
                for t in part.time[1:]
            ]
        )
        worst = max(worst, float(np.abs(part.load[1:] - exact).max() / exact.max()))
        lost = part.dissipated_energy[-1] / part.external_work.max()
        label = f"{turn:g} s in, {turn:g} s out, {lost:.0%} of the work dissipated"
        ax.plot(1e9 * part.approach, 1e6 * part.load, line, color=colour, label=label)
        ax.plot(1e9 * part.approach[1::4], 1e6 * exact[::4], "k.", ms=4.0)
    ax.plot([], [], "k.", ms=4.0, label="Ting")
    ax.set(xlabel="approach [nm]", ylabel="load [µN]", ylim=(None, 1.45 * ax.get_ylim()[1]))
    plot.title(ax, "Pressed in and released")
    plot.legend(ax, loc="upper left")
    return worst


def pull_off(ax: Any) -> None:
    """Pull-off force of a tip that has been at rest, over the speed of the pull."""
    law = ck.DugdaleAttraction(work_of_adhesion=WORK, range=4e-7, end_width=2e-7)
    path = np.linspace(CLOSE, APART, 33)
    forces = []
    for seconds in SECONDS:
        pull = 1100.0 + seconds * np.arange(1, 33) / 32
        history = ck.Viscoelasticity(
            times=(1000.0, 1100.0, *pull), approaches=(CLOSE, *path[:-1]), steps=1
        )
        adhesion = ck.Adhesion(law=law)
        part = solved(TIP, 74e-6, ck.Approach(approach=APART), adhesion, history, grid=48)
        forces.append(-part.load.min() / PULL_OFF)
    speeds = (CLOSE - APART) / np.array(SECONDS)
    ax.semilogx(1e6 * speeds, forces, "o-", color="#0072b2")
    ax.axhline(1.0, color="0.5", lw=1.0, ls=":", label="elastic: JKR")
    ax.set(xlabel="speed of the pull [µm/s]", ylabel=r"pull-off force over $1.5\,\pi w R$ [-]")
    ax.set(ylim=(0.0, None))
    plot.title(ax, "Adhesion, pulled after a rest")
    plot.legend(ax, loc="upper left")


def main(out: Path) -> float:
    """Draw creep, release and pull-off; return the largest deviation from Ting, over the load."""
    figure, axes = plot.figure(1, 3, size=(15.0, 4.6))
    creep(axes[0])
    worst = release(axes[1])
    pull_off(axes[2])
    plot.letters(axes)
    plot.save(figure, out / "viscoelastic_sphere")
    return worst


if __name__ == "__main__":
    sys.stdout.write(f"largest deviation from Ting: {main(Path('out/examples')):.1e}\n")
