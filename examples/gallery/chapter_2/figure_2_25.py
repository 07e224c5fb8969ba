"""Fig. 2.25: meniscus force over the load for the three surfaces."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_over_first, draw_panel, labelled
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.25",
    title="Meniscus force over the load, three surfaces",
    claim="A rougher surface, of larger rms height or shorter beta*, has a lower relative meniscus "
    "force; it is more sensitive to the rms height.",
    verdict="Holds. Most of the effect of the rms height is in the height of the menisci, which "
    "the caption ties to it. The text has beta* of 0.05 um for the surface of 10 nm, the "
    "caption 0.5 um, which is taken.",
    choices="Layers of 1 nm; film and menisci as high as the rms height.",
    grid="256 x 256 pixels on 5 um; shortest wave 156 nm = 8 pixels",
    seeds=rough.SEEDS,
)
LOADS = (4e-6, 1e-5, 4e-5, 1e-4, 4e-4, 1e-3)
NAME = "relative_meniscus_force"


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Relative force (surfaces, structures, seeds, loads); with a film of 1 nm on 10 nm too."""
    sampling = rough.Sampling(5.0 * rough.UM, 256, (1, 2) if draft else (1, 2, 3, 4, 5))
    stacks = [rough.body(m, (1.0, 1.0), 1.0 * rough.NM) for m in rough.STRUCTURES.values()]
    found = []
    for surface, film in ((s, s.rms) for s in rough.SURFACES):
        cases = [(surface, stack) for stack in stacks]
        effect = ck.FilmMeniscus(film_thickness=film)
        run = rough.curves(cases, sampling, LOADS, (NAME,), ck.HardnessLimit(), effect)
        found.append(run[NAME])
    rougher = [(rough.SURFACES[1], stacks[0])]
    thin = ck.FilmMeniscus(film_thickness=1.0 * rough.NM)
    same = rough.curves(rougher, sampling, LOADS, (NAME,), ck.HardnessLimit(), thin)
    load = 4e-6 * 100e9 * sampling.width**2
    second = [
        pressed(sampling, Case(4e-6, "I", 1e-9, i)).film_force(film) / load
        for i, film in enumerate((1e-9, 10e-9, 1e-9))
    ]
    return {"relative": np.array(found), "thin_film": same[NAME][0], "second": np.array(second)}


def draw(data: Data) -> plot.Figure:
    """A panel for each surface, on one scale."""
    figure, axes = plot.figure(2, 3, size=(9.0, 6.2), sharey="row")
    values, labels = data["relative"], labelled(rough.MEANING)
    for column, runs, surface in zip(axes.T, values, rough.SURFACES, strict=True):
        draw_panel(column[0], LOADS, NAME, runs, labels)
        draw_over_first(column[1], LOADS, runs, labels)
        column[0].set_title(str(surface), fontsize=9, loc="left")
        column[0].set_ylim(0.5 * values.min(), 2.0 * values.max())
    for ax in axes[:, 1:].ravel():
        ax.set_ylabel("")
    plot.shared(figure, axes[0, 0])
    return figure


def check(data: Data) -> list[Check]:
    """Surfaces against the first, structure by structure."""
    values = data["relative"]
    high, short = values[1] / values[0], values[2] / values[0]
    return [
        Check(
            "medians at each load and structure: lower for both rougher surfaces",
            bool((np.median(high, axis=1) < 1.0).all() and (np.median(short, axis=1) < 1.0).all()),
            f"10 nm {rough.spread(high)}, 0.05 um {rough.spread(short)} of the first",
        ),
        Check(
            "the rms height matters more, each structure, seed and load",
            bool((high < short).all()),
            f"10 nm {rough.spread(high)}, 0.05 um {rough.spread(short)}",
        ),
        Check(
            "the relative force falls with the load on each surface",
            bool((np.diff(np.median(values, axis=2), axis=-1) < 0.0).all()),
            f"first surface, I: {rough.spread(values[0, 0, :, 0])} to "
            f"{rough.spread(values[0, 0, :, -1])}",
        ),
        agree("force of I over the load of 4e-6 E3", values[:, 0, 0, 0], data["second"]),
    ]


def table(data: Data) -> Table:
    """Medians of structure I; the surface of 10 nm with a film of 1 nm too."""
    rows = [
        (
            s.rms / rough.NM,
            s.length / rough.UM,
            s.rms / rough.NM,
            *map(float, np.median(runs[0], 0)),
        )
        for s, runs in zip(rough.SURFACES, data["relative"], strict=True)
    ]
    rows.append((10.0, 0.5, 1.0, *map(float, np.median(data["thin_film"], axis=0))))
    head = ("rms [nm]", "beta* [um]", "film [nm]", *(f"p = {load:g} E3" for load in LOADS))
    return Table(head, rows)


if __name__ == "__main__":
    run_page(__file__)
