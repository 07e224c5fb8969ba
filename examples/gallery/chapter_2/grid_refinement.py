"""Influence of grid and shortest wave: the same physics refined, and the same caption refined."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.stress_maps import maxima
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="Refinement",
    title="The grid refined: at fixed physics, and at a fixed caption",
    claim="The source states rms height, beta* and window, and neither grid nor shortest wave; "
    "4e-6 E3 is called elastic and 1e-5 E3 elastic-plastic.",
    verdict="With the shortest wave fixed, eight pixels for it give the maximum pressure to some "
    "per cent. With the shortest wave tied to the pixel, as in the source, nothing "
    "converges: whether a load is elastic is a property of the grid. Tension converges "
    "last, at the edge of a spot: eight pixels leave it too low by a fifth to a third. Of "
    "these pages tension is uncertain by 30 %, what layers do to it by 10 to 20 %; "
    "pressure, area and von Mises by 1 to 8 %.",
    grid="(a) shortest wave 0.625 um on 10 um, 2 to 32 pixels for it; (b) 128 to 1024 pixels on "
    "10 um, shortest wave 8 pixels; stress: shortest wave 156 nm on 2.5 um, 8 to 32 pixels for it",
    seeds="1 to 5: median, and a band from the least to the greatest",
)
WIDTH, LOADS = 10.0 * rough.UM, (4e-6, 1e-4)
FIXED, PER_WAVE = 0.625 * rough.UM, (2, 4, 8, 16, 32)
COLUMNS = ("max_pressure", "contact_fraction")
STRESSED, FRICTIONS, FINER = ("I", "III", "IV"), (0.0, 0.5), (8, 16, 32)


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


def stressed(sampling: rough.Sampling, name: str, per_wave: int, seed: int) -> list[float]:
    """Largest pressure [Pa] of a structure; von Mises, tension for each friction; displacement."""
    surface = rough.SURFACES[0]
    stack = rough.body(rough.STRUCTURES[name], (1.0, 1.0), 10.0 * surface.rms)
    made = rough.plan(surface, stack, sampling, seed, ck.HardnessLimit())
    pixels = sampling.pixels // FINER[0] * per_wave
    run = ck.solve(ck.plan(made.scene, ck.Accuracy(grid=pixels, rtol=1e-5)))
    return [run.max_pressure, *maxima(run, FRICTIONS)[:, :2].ravel(), run.max_displacement]


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Arrays (seeds, grids, columns, loads) of both refinements."""
    seeds = (1, 2) if draft else (1, 2, 3, 4, 5)
    waves = PER_WAVE[:4] if draft else PER_WAVE
    grids = (128, 256, 512) if draft else (128, 256, 512, 1024)
    fixed = [[solved(round(WIDTH / FIXED) * n, FIXED, s) for n in waves] for s in seeds]
    tied = [[solved(n, 8.0 * WIDTH / n, s) for n in grids] for s in seeds]
    small = rough.Sampling(2.5 * rough.UM, 128, seeds)
    stress = [
        [
            [stressed(small, name, n, s) for name in STRESSED]
            for n in (FINER[:2] if draft else FINER)
        ]
        for s in seeds
    ]
    second, stiff = pressed(small, Case(4e-6)), pressed(small, Case(4e-6, "III"))
    return {
        "stress": np.array(stress),
        "second": np.array(
            [second.max_pressure, *second.stress((0.0, 0.0), 0.5), stiff.max_pressure]
        ),
        "second_moved": np.array(stiff.max_displacement),
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
        *_of_stress(data["stress"]),
        agree(
            "pressure of I, its von Mises and tension with friction of 0.5, pressure of III",
            [*data["stress"][0, 0, 0, [0, 3, 4]], data["stress"][0, 0, 1, 0]],
            data["second"],
        ),
        agree("displacement of III", data["stress"][0, 0, 1, 5], data["second_moved"]),
    ]


def _of_stress(stress: np.ndarray) -> list[Check]:
    """What a finer grid does to the greatest stresses, and to what layers do to them."""
    over = np.median(stress[:, 0] / stress[:, -1], axis=0)  # coarse over fine: structures, numbers
    ratio = np.median(stress[..., 1:, :] / stress[..., :1, :], axis=0)  # grids, III and IV
    change = np.abs(ratio[0] / ratio[-1] - 1.0)
    return [
        Check(
            "eight pixels for the shortest wave: von Mises to 10 %, medians of I, III and IV",
            bool((np.abs(over[:, [1, 3]] - 1.0) < 0.1).all()),
            f"over the finest grid: {over[:, [1, 3]].round(3).tolist()} (mu = 0, 0.5)",
        ),
        Check(
            "the tension is too low by up to 40 %, medians of I, III and IV",
            bool(((over[:, [2, 4]] > 0.6) & (over[:, [2, 4]] < 1.05)).all()),
            f"over the finest grid: {over[:, [2, 4]].round(3).tolist()} (mu = 0, 0.5)",
        ),
        Check(
            "what layers do to the tension changes by up to 30 %, to von Mises by less than 10 %",
            bool((change[:, [2, 4]] < 0.3).all() and (change[:, [1, 3]] < 0.1).all()),
            f"tension over I, mu = 0 and 0.5: III {_listed(ratio[:, 0, [2, 4]])}, "
            f"IV {_listed(ratio[:, 1, [2, 4]])}, coarse to fine",
        ),
    ]


def _listed(values: np.ndarray) -> str:
    """Numbers of each friction over the grids."""
    return " and ".join(", ".join(f"{x:.2f}" for x in one) for one in values.T)


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
    medians = np.median(data["stress"], axis=0) / 1e9
    rows += [
        (
            f"greatest tension of {name} [GPa], mu = 0 and 0.5; pixels for a wave of 0.156 um",
            n,
            *two,
        )
        for i, name in enumerate(STRESSED)
        for n, two in zip(FINER, medians[:, i][:, [2, 4]].tolist(), strict=False)
    ]
    return Table(("refined", "n", *(f"max. pressure / H3, {load:g} E3" for load in LOADS)), rows)


if __name__ == "__main__":
    run_page(__file__)
