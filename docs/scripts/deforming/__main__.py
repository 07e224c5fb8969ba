"""Pictures of films between deforming bodies: `python docs/scripts/deforming`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

import contactkit as ck
from contactkit.plot.style import SERIES

IMG = Path(__file__).parents[2] / "img"
RADIUS, GAP, VISCOSITY, SPEED = 5e-3, 1e-6, 0.1, 1e-5


def scene(
    beta: float, loading: object, *effects: object, widths: float = 8.0
) -> ck.SeparationScene:
    """Return a sphere on a soft flat, flooded to some widths of its pressure."""
    modulus = VISCOSITY * SPEED * RADIUS**1.5 / (beta * GAP**2.5)
    soft = ck.Material(name="soft", young_modulus=0.75 * modulus, poisson_ratio=0.5)
    face = ck.Flat(radius=widths * (RADIUS * GAP) ** 0.5)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=face, solid=soft),
            upper=ck.Sphere(radius=RADIUS),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=VISCOSITY)),
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


def pulls(ax: plt.Axes) -> None:
    """Draw pulls at constant speed over the displacement, from stiff to soft."""
    for beta, (color, style, _) in zip((0.01, 0.1, 1.0, 10.0), SERIES, strict=False):
        end = GAP * (1.0 + (4.0 if beta < 5.0 else 9.5))
        loading = ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=end)
        found = ck.simulate(ck.plan(scene(beta, loading)))
        rigid = found.numbers["pull_off_force"] / found.numbers["force_over_rigid"]
        moved = found["gap"] / GAP - 1.0
        ax.plot(moved, found["pull"] / rigid, color=color, ls=style, label=f"beta = {beta:g}")
    ax.set(xlabel="displacement / initial gap", ylabel="pull / that of rigid bodies", ylim=(0, 1))
    ax.legend(frameon=False)


def cycle(ax: plt.Axes) -> None:
    """Draw the forces of a pair that is pressed, rests and is pulled."""
    loading = ck.PressAndPull(
        press=3e-4, rest=30.0, speed=SPEED, initial_gap=GAP, final_gap=4.0 * GAP
    )
    made = scene(0.1, loading, ck.SolidContact(cutoff=0.3 * GAP))
    ck.simulate(ck.plan(made)).plot.loop(ax=ax)


def moduli(ax: plt.Axes) -> None:
    """Draw the moduli over the frequency, with the limits of bodies that hardly deform."""
    loading = ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=2.0 * GAP)
    curve = ck.modulus_curve(scene(0.1, loading, widths=70.0), np.geomspace(1e-2, 1e4, 49))
    for name, color in (("storage", "#1f4e79"), ("loss", "#c1440e")):
        ax.loglog(curve.frequency, curve[f"{name}_modulus"], color=color, label=f"{name} modulus")
        ax.loglog(curve.frequency, curve[f"stiff_{name}"], color=color, ls=":", lw=1.0)
    ax.set(xlabel="frequency [Hz]", ylabel="modulus [N/m]", ylim=(1e-2, 1e6))
    ax.legend(frameon=False)


if __name__ == "__main__":
    figure, axes = plt.subplots(2, 2, figsize=(9.0, 7.0), layout="constrained")
    pulls(axes[0, 0])
    slow = ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=10.5 * GAP)
    ck.simulate(ck.plan(scene(10.0, slow))).plot.sections(ax=axes[0, 1])
    cycle(axes[1, 0])
    moduli(axes[1, 1])
    figure.savefig(IMG / "deforming-pull.png", dpi=110)
