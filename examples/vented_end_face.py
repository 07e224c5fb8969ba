"""A spool with a hole through its end face: release over its size, for an oil that never cavitates.

The valve of the fuel injector pulls a spool whose end is a ring, vented in the middle: a `Flat`
whose planform is a `Ring`. Beside it the pressure on such a face with four more vents, from
Reynolds' equation.
"""

from __future__ import annotations

import math
import sys
import warnings
from pathlib import Path

from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.lubrication import reynolds
from contactkit.models.injector.monolithic import simulate
from contactkit.models.injector.scene import InjectorScene
from contactkit.plot import film as film_plot
from contactkit.plot import style as plot
from contactkit.units import celsius, mm, um

RADIUS, GAP = 3.175 * mm, 5 * um  # [m]
HOLES = (0.0, 0.01, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0)  # radius [mm]


def ring(injector: InjectorScene, temperature: float, hole: float) -> ck.SeparationScene:
    """Film of a face with a vented hole of a radius [m] in its middle; 0: none."""
    film = injector.separation(temperature, cavitates=False)
    face = ck.Flat(radius=RADIUS)
    if hole > 0.0:
        face = ck.Flat(planform=ck.Ring(radius=RADIUS, hole_radius=hole))
    bodies = evolve(film.interface, lower=ck.Flat(), upper=face)
    return evolve(film, interface=bodies, effects=(ck.ViscousForce(),))


def delay(injector: InjectorScene, temperature: float, hole: float) -> float:
    """Release delay [s] since energising, at a temperature [K]; nan if it is not released."""
    found = simulate(
        ck.plan(ring(injector, temperature, hole)),
        injector.valve,
        injector.first_pulse_end,
        rtol=1e-6,
        until_release=True,
    )
    release = next((e.time for e in found.events if e.what == "released"), math.nan)
    return release - injector.valve.profile.start_delay


def vented_face() -> reynolds.GridFilmState:
    """Pressure on a face with one vent in the middle and four around it, opening at 0.1 mm/s."""
    at = [
        (0.0, 0.0),
        *((2.0 * mm * x, 2.0 * mm * y) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))),
    ]
    vents = [reynolds.Hole(shape=ck.Disc(radius=0.25 * mm, centre=one)) for one in at]
    face = reynolds.rasterise(ck.Disc(radius=RADIUS), 160, holes=vents)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # 24 bar of tension: it never cavitates
        return reynolds.solve_pressure(reynolds.GridFilm(face=face, viscosity=0.1), GAP, 1e-4)


def main(out: Path) -> float:
    """Draw both; return by how much a hole of 1 mm lowers the damping [-]."""
    injector = open_scene("fuel-injector").scene
    figure, (left, right) = plot.figure(1, 2, size=(10.5, 4.2))
    film_plot.pressure(vented_face(), left)
    plot.title(left, "five vents, gap 5 um, 0.1 mm/s")
    for degrees, color, style in zip(
        (40, 60, 80), ("#0072b2", "#000000", "#d55e00"), ("o-", "s--", "^:"), strict=True
    ):
        delays = [1e3 * delay(injector, celsius(degrees), hole * mm) for hole in HOLES]
        right.plot(HOLES, delays, style, color=color, label=f"oil at {degrees} degC", ms=4)
    right.set(
        xlabel="radius of the vent in the middle [mm]",
        ylabel="release delay [ms]",
        ylim=(0.0, 4.2),
    )
    right.axhline(4.0, color="#7f7f7f", lw=0.8, ls=":")
    right.annotate("end of the current pulse", (0.02, 4.03), fontsize=8, color="#606060")
    plot.title(right, "a ring with a vent, oil that never cavitates")
    plot.legend(right, loc="upper right", bbox_to_anchor=(1.0, 0.93))
    plot.letters((left, right))
    plot.save(figure, out / "vented_end_face")
    vented, whole = (
        ck.plan(ring(injector, celsius(60.0), hole)).force(GAP, 1e-4) for hole in (1.0 * mm, 0.0)
    )
    return 1.0 - vented / whole


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        sys.stdout.write(f"a hole of 1 mm takes {main(Path('out/examples')):.0%} of the damping\n")
