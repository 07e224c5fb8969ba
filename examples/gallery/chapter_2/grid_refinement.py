"""Influence of grid and shortest wave: the same physics refined, and the same caption refined."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.plot import gallery as plot

PAGE = Page(
    name="Refinement",
    title="The grid refined: at fixed physics, and at a fixed caption",
    claim="The source states rms height, beta* and window, and neither grid nor shortest wave; "
    "4e-6 E3 is called elastic and 1e-5 E3 elastic-plastic.",
    verdict="With the shortest wave fixed, eight pixels for it give the maximum pressure to some "
    "per cent. With the shortest wave tied to the pixel, as in the source, pressure grows and "
    "area falls with every finer grid and nothing converges: whether a load is elastic is a "
    "property of the grid. Where these pages state a regime, they state the shortest wave.",
    grid="(a) shortest wave 0.625 um on 10 um, 2 to 32 pixels for it; (b) 128 to 1024 pixels on "
    "10 um, shortest wave 8 pixels",
    seeds="1 to 5: median, and a band from the least to the greatest",
)
WIDTH, LOADS = 10.0 * rough.UM, (4e-6, 1e-4)
FIXED, PER_WAVE = 0.625 * rough.UM, (2, 4, 8, 16, 32)
COLUMNS = ("max_pressure", "contact_fraction")


def solved(pixels: int, shortest: float, seed: int) -> list[list[float]]:
    """Maximum pressure over H3 and area at the loads."""
    surface = rough.SURFACES[0]
    roughness = ck.GaussianRoughness(
        rms=surface.rms, correlation_length=surface.length, cutoff=shortest, seed=seed
    )
    solid = ck.Material(young_modulus=rough.MODULUS, poisson_ratio=rough.POISSON)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(surface=roughness, solid=solid), upper=ck.Flat()),
        window=ck.Window(width=WIDTH),
        loading=ck.Pressing(pressure=1e6),
        effects=(ck.HalfSpace(),),
    )
    made = ck.plan(scene, ck.Accuracy(grid=pixels, rtol=1e-5))
    curve = ck.load_curve(made, pressures=[load * rough.MODULUS for load in LOADS])
    return [list(curve.columns[name]) for name in COLUMNS]


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Arrays (seeds, grids, columns, loads) of both refinements."""
    seeds = (1, 2) if draft else (1, 2, 3, 4, 5)
    waves = PER_WAVE[:4] if draft else PER_WAVE
    grids = (128, 256, 512) if draft else (128, 256, 512, 1024)
    fixed = [[solved(round(WIDTH / FIXED) * n, FIXED, s) for n in waves] for s in seeds]
    tied = [[solved(n, 8.0 * WIDTH / n, s) for n in grids] for s in seeds]
    return {
        "per_wave": np.array(waves),
        "grids": np.array(grids),
        "fixed": np.array(fixed),
        "tied": np.array(tied),
    }


def draw(data: Data) -> plot.Figure:
    """Pressure and area, for both refinements."""
    figure, axes = plot.figure(2, 2, size=(8.2, 6.0))
    for row, name, x, label in (
        (axes[0], "fixed", data["per_wave"], "pixels for the shortest wave"),
        (axes[1], "tied", data["grids"], "pixels along a side"),
    ):
        for i, load in enumerate(LOADS):
            text = f"$p_n$ = {load:g} $E_3$"
            plot.band(row[0], x, data[name][:, :, 0, i] / rough.HARDNESS, i, text)
            plot.band(row[1], x, 100.0 * data[name][:, :, 1, i], i, text)
        row[0].set(ylabel="max. pressure / $H_3$", ylim=(0.0, None))
        row[1].set(ylabel="contact area [%]", yscale="log")
        plot.plain_log(row[1].yaxis)
        for ax in row:
            ax.set(xscale="log", xlabel=label)
            ax.set_xticks(x, [str(n) for n in x])
            ax.minorticks_off()
    axes[0, 0].legend(fontsize=8)
    titles = ("wave fixed", "wave fixed", "wave of 8 pixels", "wave of 8 pixels")
    plot.letters(axes.ravel(), titles)
    return figure


def check(data: Data) -> list[Check]:
    """Convergence at fixed physics, none at a fixed caption."""
    at = list(data["per_wave"]).index(8)
    fine = data["fixed"][:, -1]
    off = np.median(np.abs(data["fixed"][:, at] / fine - 1.0), axis=0)
    coarse = np.median(np.abs(data["fixed"][:, 0] / fine - 1.0), axis=0)
    grow = np.median(data["tied"][:, 1:, 0] / data["tied"][:, :-1, 0], axis=0)
    fall = np.median(data["tied"][:, 1:, 1] / data["tied"][:, :-1, 1], axis=0)
    return [
        Check(
            "eight pixels for the shortest wave: maximum pressure to 8 % in the median",
            bool((off[0] < 0.08).all()),
            f"{(100 * off[0]).round(1)} % against {data['per_wave'][-1]} pixels",
        ),
        Check(
            "two pixels are worse than eight",
            bool((coarse[0] > off[0]).all()),
            f"{(100 * coarse[0]).round(1)} %",
        ),
        Check(
            "wave of eight pixels: the pressure grows with every finer grid, by 15 % or more",
            bool((grow > 1.15).all()),
            f"factors {grow.min():.2f} to {grow.max():.2f}",
        ),
        Check(
            "and the area falls, at the higher load",
            bool((fall[:, 1] < 1.0).all()),
            f"factors {fall[:, 1].min():.2f} to {fall[:, 1].max():.2f}",
        ),
    ]


def table(data: Data) -> Table:
    """Medians of both refinements."""
    rows = [
        (what, int(n), *(float(x) for x in np.median(values[:, i, 0], axis=0) / rough.HARDNESS))
        for what, ns, values in (
            ("pixels for a wave of 0.625 um", data["per_wave"], data["fixed"]),
            ("pixels along a side, 8 for the wave", data["grids"], data["tied"]),
        )
        for i, n in enumerate(ns)
    ]
    return Table(("refined", "n", *(f"max. pressure / H3, {load:g} E3" for load in LOADS)), rows)


if __name__ == "__main__":
    run_page(__file__)
