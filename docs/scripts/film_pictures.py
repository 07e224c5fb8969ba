"""Pictures of films on faces, of docs/films.md: ``film_pictures.py``; half a minute."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from PIL import Image, ImageSequence

import contactkit as ck
from contactkit.lubrication import reynolds
from contactkit.lubrication.reynolds.face import Face

R, OIL = 3.175e-3, 0.1
DISC = ck.Disc(radius=R)
IMG = Path(__file__).parents[1] / "img"


def holed_face(cells: int) -> Face:
    """A disc with a vent in its middle and three holes around it."""
    turns = (0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0)
    places = [(0.6 * R * math.cos(t), 0.6 * R * math.sin(t)) for t in turns]
    holes = [reynolds.Hole(shape=ck.Disc(radius=0.2 * R))]
    holes += [reynolds.Hole(shape=ck.Disc(radius=0.08 * R, centre=p)) for p in places]
    return reynolds.rasterise(DISC, cells, holes=holes)


def pulled_disc() -> ck.SeparationResult:
    """Disc of 20 g that is pulled off a film of 5 um with 40 N, and cavitates at 10 bar."""
    scene = ck.SeparationScene(
        interface=ck.Interface(
            upper=ck.Flat(planform=DISC),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=OIL)),
        ),
        loading=ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        effects=(
            ck.ViscousForce(),
            ck.TensionLimit(strength=1e6, cavity_pressure=101_325.0 - 1e6),
        ),
    )
    return ck.simulate(ck.plan(scene))


def shrink(path: Path, colours: int = 64) -> None:
    """Give all pictures of an animation one palette: what stays is then written once."""
    with Image.open(path) as film:
        frames, pause = [one.convert("RGB") for one in ImageSequence.Iterator(film)], film.info
    whole = Image.new("RGB", (frames[0].width, frames[0].height * 3))
    for i, k in enumerate((0, len(frames) // 2, len(frames) - 1)):
        whole.paste(frames[k], (0, i * frames[0].height))
    palette = whole.quantize(colours, Image.Quantize.MAXCOVERAGE, 1)
    small = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames]
    small[0].save(path, save_all=True, append_images=small[1:], duration=pause["duration"], loop=0)


def pictures() -> None:
    """Draw the pictures of the page."""
    from contactkit.plot import film as film_plot

    film = reynolds.GridFilm(face=holed_face(128), viscosity=OIL, drop=1e6)
    period = 1e-3

    def gap(t: float) -> float:
        return 1.2e-5 - 4e-6 * math.cos(2.0 * math.pi * t / period)

    times = list(np.linspace(0.0, period, 101))
    states = list(reynolds.follow_gap(film, gap, times))
    shown = [states[i] for i in (3, 30, 60, 72)]
    film_plot.instants(shown).savefig(IMG / "film-instants.png")
    film_plot.animate(states[1:76:3], IMG / "film-opening.gif", rate=8)
    shrink(IMG / "film-opening.gif")
    quarter = reynolds.rasterise(DISC, 64, window=(0.0, R, 0.0, R))
    film = reynolds.GridFilm(face=quarter, viscosity=OIL, drop=1e6)
    pulled = pulled_disc()
    times, gaps = pulled["time"], pulled["gap"]
    steps = list(reynolds.follow_gap(film, lambda t: float(np.interp(t, times, gaps)), times))
    film_plot.opening(steps, copies=4)[0].figure.savefig(IMG / "film-pull.png")
    for name in ("film-instants", "film-pull"):
        picture = IMG / f"{name}.png"
        with Image.open(picture) as drawn:
            drawn.convert("RGB").quantize(128, Image.Quantize.MAXCOVERAGE, 1).save(picture)


if __name__ == "__main__":
    pictures()
