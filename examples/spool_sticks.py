"""Release time of a spool from an oil film under a constant pull, over temperature.

Without a tensile limit of the oil: the closed form for a massless spool as a line, the motion of a
spool of 20 g as dots. The mass has little influence, the temperature a large one.
"""

from __future__ import annotations

import math
import sys
import warnings
from pathlib import Path

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.units import celsius, um

PULL = 40.0  # [N]
GAP, FAR, RADIUS = 5 * um, 25 * um, 3.175e-3  # [m]


def scene(degrees: float) -> ck.SeparationScene:
    """Spool of a diesel injector on its end cap, in engine oil."""
    face = ck.Flat(radius=RADIUS)
    oil = ck.load_liquid("engine-oil-15w-40")
    film = ck.Meniscus(liquid=oil, volume=math.pi * RADIUS**2 * GAP)
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=ck.ImposedForce(initial_gap=GAP, final_gap=FAR, force=PULL, mass=0.02),
        effects=(ck.ViscousForce(),),
        temperature=celsius(degrees),
    )


def main(out: Path) -> float:
    """Draw both over temperature; return the maximum difference relative to the motion [-]."""
    degrees = [-20.0 + 10.0 * i for i in range(11)]
    motion, closed = [], []
    for value in degrees:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ck.ValidityWarning)  # the rim breaks up into fingers
            result = ck.simulate(ck.plan(scene(value)))
        motion.append(result.state.release_time)
        closed.append(result.of(ck.ViscousForce).time_at_constant_force())
    figure, ax = plot.figure()
    ax.plot(degrees, [t * 1e3 for t in closed], color=plot.COLORS["viscous"], label="closed form")
    ax.plot(degrees, [t * 1e3 for t in motion], "o", color=plot.COLORS["gap"], label="20 g spool")
    ax.set(xlabel="oil temperature [degC]", ylabel="release time [ms]", yscale="log")
    plot.plain_log(ax.yaxis)
    plot.title(ax, f"{PULL:g} N against an oil film of {GAP / um:g} um without a tensile limit")
    plot.legend(ax)
    plot.save(figure, out / "spool_sticks")
    return max(abs(c / m - 1.0) for c, m in zip(closed, motion, strict=True))


if __name__ == "__main__":
    sys.stdout.write(f"maximum difference: {100 * main(Path('out/examples')):.2g} %\n")
