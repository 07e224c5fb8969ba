"""The head-disk interface over the load, in one call.

The scene of the package on a smaller window, with the effects of a load curve only. A study
starts each contact from the previous solution. The contact area grows somewhat slower than the
load; the meniscus force is a quarter of a small load, but little of a large one. A draft: its grid
has 2.6 pixels per shortest wave, 8 are wanted, and the result warns of that.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.plot import style as plot
from contactkit.units import MPa, um


def main(out: Path) -> float:
    """Draw contact area and meniscus force; return the exponent of area over load [-]."""
    opened = open_scene("head-disk").scene
    wanted = (ck.LayeredHalfSpace, ck.HardnessLimit, ck.FilmMeniscus)
    scene = evolve(
        opened,
        window=evolve(opened.window, width=4 * um),
        effects=tuple(e for e in opened.effects if isinstance(e, wanted)),
    )
    loads = {"loading.pressure": [1 * MPa * 2.0**i for i in range(8)]}
    curve = ck.study(scene, loads, ck.Accuracy(grid=128))
    pressure = curve.column("loading.pressure") / MPa
    contact, film = curve.column("contact_fraction"), curve.column("relative_meniscus_force")
    figure, (left, right) = plot.figure(1, 2, size=(11.0, 4.6))
    left.plot(pressure, 100.0 * contact, "o-", ms=3.5)
    left.plot(
        pressure, 100.0 * contact[-1] * pressure / pressure[-1], "k--", lw=1.0, label="~ load"
    )
    left.set(xscale="log", yscale="log", xlabel="mean pressure [MPa]", ylabel="contact [%]")
    right.plot(pressure, film, "o-", ms=3.5)
    right.set(xscale="log", xlabel="mean pressure [MPa]", ylabel="meniscus force / load [-]")
    right.set_ylim(0.0, None)
    for ax in (left, right):
        plot.plain_log(ax.xaxis)
    plot.title(left, "Head on disk: real area of contact")
    plot.title(right, "Meniscus force of a film of water, 1 nm")
    plot.legend(left)
    plot.save(figure, out / "head_disk_load_curve")
    return float(np.polyfit(np.log(pressure), np.log(contact), 1)[0])


if __name__ == "__main__":
    sys.stdout.write(f"contact ~ load^{main(Path('out/examples')):.3f}\n")
