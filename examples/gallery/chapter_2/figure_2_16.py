"""Figs. 2.16 to 2.18: maximum stress over friction, structures I to V, low load."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_runs, labelled
from contactkit.gallery.chapter_2.stress_maps import NAMES, map_figure, maps, maxima, stacked
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.16-2.18",
    title="Maximum stress over friction, structures I to V",
    claim="Friction raises the maximum stresses, little at first for von Mises and shear "
    "stress, and moves them to the surface at 0.5. Stiff layers have the higher stress, "
    "compliant layers and interlayers the lower. With layers of one rms height their "
    "effect fades with friction.",
    verdict="The growth and the move to the surface hold. The effect of thin layers does not "
    "fade: their tension stays 1.6 to 1.8 times that of I. A compliant interlayer raises "
    "the tension without friction; with 0.5 finer grids do not agree on the sign.",
    choices="Coefficients 0, 0.1, 0.3, 0.5, superposed on the frictionless pressure (Goodman). "
    "Tension is uncertain by 30 %, its ratios between structures by 10 to 20 % "
    "([refinement](grid-refinement.md)).",
    grid=rough.WIDE,
    seeds="1 to 5; maps of seed 1 with 0.5, layers of one rms height",
)
FRICTIONS, LOAD, HEIGHTS, CROP = (0.0, 0.1, 0.3, 0.5), 4e-6, (1.0, 10.0), 0.6e-6
STRUCTURES = list(rough.STRUCTURES)
MEASURES = ("von Mises", "tension", r"$|\sigma_{xz}|$")


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Maxima (heights, structures, seeds, coefficients, 3); maps of the first seed."""
    sampling, surface = rough.wide(draft), rough.SURFACES[0]
    best, shown, depths = [], [], []
    for height in HEIGHTS:
        for moduli in rough.STRUCTURES.values():
            stack = rough.body(moduli, (1.0, 1.0), height * surface.rms)
            for seed in sampling.seeds:
                run = ck.solve(rough.plan(surface, stack, sampling, seed, ck.HardnessLimit()))
                best.append(maxima(run, FRICTIONS))
                if seed == sampling.seeds[0]:
                    pixels = round(CROP / sampling.width * sampling.pixels)
                    made = maps(run, pixels, FRICTIONS[-1])
                    depths.append(made["depths"])
                    if height == HEIGHTS[0]:
                        shown.append(made)
    shape = (len(HEIGHTS), len(STRUCTURES), len(sampling.seeds), len(FRICTIONS), len(NAMES))
    every = np.array(depths).reshape(len(HEIGHTS), len(STRUCTURES), len(NAMES))
    iii = STRUCTURES.index("III")
    second = [
        pressed(sampling, Case(4e-6, name, thickness)).stress(every[i, k], 0.5)
        for name, thickness, i, k in (("I", 10e-9, 1, 0), ("III", 1e-9, 0, iii))
    ]
    found = {"stress": np.array(best).reshape(shape), "deepest": every}
    return stacked(shown) | found | {"second": np.array(second)}


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """Maps; maxima over friction, thin layers above."""
    titles = [f"{name}:\n{text}" for name, text in rough.MEANING.items()]
    figure, axes = plot.figure(2, 3, size=(8.6, 5.6), sharex=True)
    for row, height, values in zip(axes, HEIGHTS, data["stress"], strict=True):
        for k, (ax, name) in enumerate(zip(row, MEASURES, strict=True)):
            draw_runs(ax, FRICTIONS, values[..., k] / 1e9, labelled(rough.MEANING))
            ax.set(ylabel=f"max. {name} [GPa]", ylim=(0.0, None))
            ax.set_title(rf"$h_1 = h_2 = {height:g}\,\sigma$", fontsize=9, loc="left")
    for ax in axes[-1]:
        ax.set_xlabel("coefficient of friction [-]")
    plot.shared(figure, axes[0, 0])
    return map_figure(data, titles, CROP), figure


def check(data: Data) -> list[Check]:
    """Growth with friction, places, structures, thin layers."""
    stress = data["stress"]
    mises, tension = stress[..., 0], stress[..., 1]
    steps = np.diff(stress, axis=3) / stress[..., :1, :]
    low = mises[..., 1] / mises[..., 0] - 1.0
    high = mises[..., 3] / mises[..., 2] - 1.0
    ii, iii, iv = (STRUCTURES.index(name) for name in ("II", "III", "IV"))
    thin, thick = (rough.ratios(tension[k]) for k in (0, 1))
    above = rough.ratios(mises[0])
    return [
        Check(
            "all three maxima grow with every step of friction from 0.1 on; from 0 to 0.1 they may "
            "fall, by less than 15 %",
            bool((steps[:, :, :, 1:] > -0.01).all() and (steps[:, :, :, 0] > -0.15).all()),
            f"von Mises from 0 to 0.5: {rough.spread(mises[..., 3] / mises[..., 0])} times",
        ),
        Check(
            "von Mises grows by less from 0 to 0.1 than from 0.3 to 0.5, each surface",
            bool((low < high).all()),
            f"{rough.spread(100.0 * low)} % and {rough.spread(100.0 * high)} %",
        ),
        Check(
            "with 0.5 the greatest tension is at the surface; in thin layers there or at their "
            "interfaces, at most 2 nm deep",
            bool(
                (data["deepest"][1, :, 1] == 0.0).all()
                and (data["deepest"][0, :, 1] < 2.1e-9).all()
            ),
            f"thin layers: {(data['deepest'][0, :, 1] * 1e9).round(1)} nm",
        ),
        Check(
            "von Mises with thick layers, each surface and coefficient: II below I, III above",
            bool((mises[1, ii] < mises[1, 0]).all() and (mises[1, iii] > mises[1, 0]).all()),
            f"II {rough.spread(mises[1, ii] / mises[1, 0])}, "
            f"III {rough.spread(mises[1, iii] / mises[1, 0])}",
        ),
        Check(
            "tension of thin stiff layers stays above 1.4 times that of I at every coefficient "
            "(the source: fades)",
            rough.all_above(thin[iii], 1.4),
            f"0: {rough.spread(thin[iii][..., 0])}, 0.5: {rough.spread(thin[iii][..., 3])}",
        ),
        Check(
            "von Mises of thin stiff layers: within 5 % of I without friction, more than 1.1 times "
            "with 0.5",
            bool(
                (np.abs(above[iii][..., 0] - 1.0) < 0.05).all() and (above[iii][..., 3] > 1.1).all()
            ),
            f"{rough.spread(above[iii][..., 0])} and {rough.spread(above[iii][..., 3])}",
        ),
        Check(
            "a thick compliant interlayer does not lower the tension, in the median (the source: "
            "lowers)",
            bool((np.median(thick[iv], axis=0) > 0.99).all()),
            f"0: {rough.spread(thick[iv][..., 0])}, 0.5: {rough.spread(thick[iv][..., 3])}",
        ),
        *_against_second(data),
    ]


def _against_second(data: Data) -> list[Check]:
    """Numbers of the page by the second method."""
    stress, iii = data["stress"], STRUCTURES.index("III")
    return [
        agree(
            "von Mises, tension, s_xz with friction of 0.5, thick I and thin III",
            [stress[1, 0, 0, 3], stress[0, iii, 0, 3]],
            data["second"],
        ),
    ]


def table(data: Data) -> Table:
    """Medians over those of I, without friction and with 0.5."""
    rows = [
        (
            height,
            name,
            FRICTIONS[m],
            *(float(np.median(rough.ratios(data["stress"][i])[j, :, m, k])) for k in range(3)),
        )
        for i, height in enumerate(HEIGHTS)
        for j, name in enumerate(STRUCTURES)
        for m in (0, 3)
    ]
    head = ("h/rms", "structure", "mu", "von Mises / I", "tension / I", "sigma_xz / I")
    return Table(head, rows)


if __name__ == "__main__":
    run_page(__file__)
