"""Figs. 2.19 to 2.21: maximum stress over friction, hardness of layers I' to V', higher load."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_runs, labelled
from contactkit.gallery.chapter_2.stress_maps import NAMES, map_figure, maps, maxima, stacked
from contactkit.gallery.second_method.anchors import Case, agree, pressed, pressed_layers
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.19-2.21",
    title="Maximum stress over friction, hardness of layers",
    claim="As with stiffness: friction raises the stresses and moves them to the surface; hard "
    "layers have the higher stress, soft layers and interlayers the lower. Beyond yield "
    "von Mises and shear stress grow from low friction on.",
    verdict="The order of soft and hard layers holds where the contact yields; at the printed "
    "load it hardly does. The growth with friction is that of the elastic case. What "
    "interlayers do follows from the hardness rule (Fig. 2.15).",
    choices="Continuous rule. Loads 1e-5 E3 as printed, and 1e-3 E3, at which all but hard layers "
    "yield. Tension is uncertain by 30 %, its ratios between structures by 10 to 20 % "
    "([refinement](grid-refinement.md)).",
    grid=rough.FINE,
    seeds="1 to 5; maps of seed 1 with 0.5 at 1e-3 E3, layers of one rms height, 0.5 um",
)
FRICTIONS, CROP = (0.0, 0.1, 0.3, 0.5), 0.5e-6
CASES = ((1.0, 1e-5), (1.0, 1e-3), (10.0, 1e-3))  # height of the layers over rms, load over E3
STRUCTURES = list(rough.STRUCTURES)
MEASURES = ("von Mises", "tension", r"$|\sigma_{xz}|$")


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Maxima (cases, structures, seeds, coefficients, 3), pressures; maps of the first seed."""
    sampling, surface = rough.fine(draft), rough.SURFACES[0]
    seeds = sampling.seeds
    best, peak, shown = [], [], []
    for height, load in CASES:
        for ratios in rough.STRUCTURES.values():
            stack = rough.body((1.0, 1.0), ratios, height * surface.rms)
            for seed in seeds:
                made = rough.plan(surface, stack, sampling, seed, ck.HardnessLimit())
                run = ck.solve(made.with_loading(ck.Pressing(pressure=load * rough.MODULUS)))
                best.append(maxima(run, FRICTIONS))
                peak.append(run.max_pressure)
                if seed == seeds[0] and (height, load) == CASES[1]:
                    pixels = round(CROP / sampling.width * sampling.pixels)
                    shown.append(maps(run, pixels, FRICTIONS[-1]))
    shape = (len(CASES), len(STRUCTURES), len(seeds))
    low, high = (pressed(sampling, Case(load, thickness=1e-9)) for load in (1e-5, 1e-3))
    return stacked(shown) | {
        "second_pressure": np.array([low.max_pressure, high.max_pressure]),
        "second_soft": np.array(
            [pressed_layers(sampling, 1e-3, 1e-9, is_inner)[0] for is_inner in (False, True)]
        ),
        "second_stress": np.array(high.stress(shown[0]["depths"], 0.5)),
        "stress": np.array(best).reshape(*shape, len(FRICTIONS), len(NAMES)),
        "pressure": np.array(peak).reshape(shape),
    }


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """Maps; maxima over friction of each case."""
    labels = labelled(rough.HARD_MEANING, "'")
    figure, axes = plot.figure(3, 3, size=(8.6, 7.6), sharex=True)
    for row, (height, load), values in zip(axes, CASES, data["stress"], strict=True):
        for k, (ax, name) in enumerate(zip(row, MEASURES, strict=True)):
            draw_runs(ax, FRICTIONS, values[..., k] / 1e9, labels)
            ax.set(ylabel=f"max. {name} [GPa]", ylim=(0.0, None))
            ax.set_title(
                rf"$h$ = {height:g} $\sigma$, $p_n$ = {load:g} $E_3$", fontsize=9, loc="left"
            )
    for ax in axes[-1]:
        ax.set_xlabel("coefficient of friction [-]")
    plot.shared(figure, axes[0, 0])
    return map_figure(data, [label.replace(": ", ":\n") for label in labels], CROP), figure


def check(data: Data) -> list[Check]:
    """The printed load, orders beyond yield, growth with friction."""
    mises, peak = data["stress"][..., 0], data["pressure"] / rough.HARDNESS
    ii, iii = STRUCTURES.index("II"), STRUCTURES.index("III")
    others = [i for i, name in enumerate(STRUCTURES) if name != "II"]
    low = rough.ratios(mises[0])[others]
    growth = data["stress"][:, :, :, 3] / data["stress"][:, :, :, 0]
    elastic, plastic = np.median(growth[0, 0], axis=0), np.median(growth[1, 0], axis=0)
    medians = np.median(mises, axis=2)
    steps = np.diff(data["stress"], axis=3) / data["stress"][..., :1, :]
    return [
        Check(
            "at the printed load, medians: all structures but II' have the stress of I' to 5 %",
            bool((np.abs(np.median(low, axis=1) - 1.0) < 0.05).all()),
            f"{rough.spread(low)}; maximum pressure of I' {rough.spread(peak[0, 0])} of H3",
        ),
        Check(
            "at 1e-3 E3 von Mises, medians, each coefficient and thickness: II' < I' < III'",
            bool(
                (medians[1:, ii] < medians[1:, 0]).all()
                and (medians[1:, 0] < medians[1:, iii]).all()
            ),
            f"II' {rough.spread(medians[1:, ii] / medians[1:, 0])}, "
            f"III' {rough.spread(medians[1:, iii] / medians[1:, 0])} of I'",
        ),
        Check(
            "at 1e-3 E3 structure I' is at its hardness",
            bool((np.abs(peak[1, 0] - 1.0) < 1e-3).all()),
            f"maximum pressure {rough.spread(peak[1, 0])} of H3",
        ),
        Check(
            "von Mises grows from friction 0 to 0.5 by a factor that yielding changes by less than "
            "a quarter",
            bool(abs(plastic[0] / elastic[0] - 1.0) < 0.25),
            f"{elastic[0]:.2f} times at 1e-5 E3, {plastic[0]:.2f} times at 1e-3 E3",
        ),
        Check(
            "all three maxima grow with every step of friction from 0.1 on; from 0 to 0.1 they may "
            "fall, by less than 15 %",
            bool((steps[:, :, :, 1:] > -0.01).all() and (steps[:, :, :, 0] > -0.15).all()),
            f"to 0.5: {', '.join(rough.spread(growth[..., k]) for k in range(3))} times",
        ),
        agree(
            "pressure of I' at 1e-5 and 1e-3 E3",
            data["pressure"][:2, 0, 0],
            data["second_pressure"],
        ),
        agree(
            "hardness of II' and IV' at 1e-3 E3",
            data["pressure"][1, [1, 3], 0],
            data["second_soft"],
        ),
        agree(
            "von Mises, tension, s_xz of I' at 1e-3 E3 with friction of 0.5",
            data["stress"][1, 0, 0, 3],
            data["second_stress"],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
