"""Fig. 2.13: structures I to V with layers as thin as the rms height: maps and load curves."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_over_first, draw_panel, labelled
from contactkit.gallery.chapter_2.stress_maps import map_figure, maps, maxima, stacked
from contactkit.gallery.second_method.anchors import Case, Solved, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.13",
    title="Layered structures, layers of one rms height",
    claim="II lowers pressure and stress, III raises them; IV lowers them comparably to II, V "
    "makes no significant difference. Differences are smaller than with layers ten times "
    "as thick.",
    verdict="Differences in pressure are small: 2 nm of layers below spots ten times as wide. IV "
    "lowers the pressure by half of what II does, and V raises it by as much. Tension is "
    "the exception: even a thin stiff layer carries far more of it.",
    choices="Load curves up to 1e-2 E3. Tension is uncertain by 30 %, its ratios between "
    "structures by 10 to 20 % ([refinement](grid-refinement.md)).",
    grid=rough.WIDE,
    seeds="1 to 5; maps of seed 1 around the highest pressure, at 1e-5 E3",
)
LOADS, MAP_LOAD, CROP = (4e-6, 1e-5, 4e-5, 1e-4, 4e-4, 1e-3, 4e-3, 1e-2), 1e-5, 0.6e-6
COLUMNS = ("max_pressure", "contact_fraction", "plastic_fraction")
STRUCTURES = list(rough.STRUCTURES)


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Curves and maxima of thin layers, maps of the first seed; curves of thick ones."""
    sampling, surface, hard = rough.wide(draft), rough.SURFACES[0], ck.HardnessLimit()
    thin, thick = (
        [rough.body(m, (1.0, 1.0), h * surface.rms) for m in rough.STRUCTURES.values()]
        for h in (1.0, 10.0)
    )
    shown, best = [], []
    for stack in thin:
        for seed in sampling.seeds:
            made = rough.plan(surface, stack, sampling, seed, hard)
            run = ck.solve(made.with_loading(ck.Pressing(pressure=MAP_LOAD * rough.MODULUS)))
            best.append(maxima(run, (0.0,))[0])
            if seed == sampling.seeds[0]:
                shown.append(maps(run, round(CROP / sampling.width * sampling.pixels)))
    curves = rough.curves([(surface, one) for one in thin], sampling, LOADS, COLUMNS, hard)
    others = rough.curves([(surface, one) for one in thick], sampling, LOADS[:3], COLUMNS, hard)
    stress = np.array(best).reshape(len(thin), len(sampling.seeds), -1)
    iii = STRUCTURES.index("III")
    thin_iii = pressed(sampling, Case(1e-5, "III", 1e-9))
    second = {
        "second": np.array([[c.max_pressure, c.fraction] for c in _cases(sampling)]).T,
        "second_stress": np.array(thin_iii.stress(shown[iii]["depths"])),
    }
    more = {"stress": stress, "thick_pressure": others["max_pressure"]}
    return stacked(shown) | curves | more | second


def _cases(sampling: rough.Sampling) -> list[Solved]:
    """Structure I under the lowest and the highest load, by the second method."""
    return [pressed(sampling, Case(load, "I", 1e-9)) for load in (4e-6, 1e-2)]


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """Maps; load curves."""
    titles = [f"{name}:\n{text}" for name, text in rough.MEANING.items()]
    figure, axes = plot.figure(2, 2, size=(8.2, 6.2))
    labels = labelled(rough.MEANING)
    for column, name in zip(axes.T, COLUMNS[:2], strict=True):  # nothing yields
        draw_panel(column[0], LOADS, name, data[name], labels)
        draw_over_first(column[1], LOADS, data[name], labels)
    plot.shared(figure, axes[0, 0])
    return map_figure(data, titles, CROP), figure


def check(data: Data) -> list[Check]:
    """Orderings; how small the differences are."""
    ii, iii, iv, v = (STRUCTURES.index(name) for name in ("II", "III", "IV", "V"))
    peak = rough.ratios(data["max_pressure"][..., :3])
    thick = rough.ratios(data["thick_pressure"])
    mises, tension = (rough.ratios(data["stress"][..., k]) for k in (0, 1))
    medians = np.median(peak, axis=(1, 2)) - 1.0
    text = ", ".join(f"{STRUCTURES[k]} {rough.spread(peak[k])}" for k in (ii, iii, iv, v))
    spread_thin, spread_thick = (np.median(one[iii] - one[ii]) for one in (peak, thick))
    return [
        Check(
            "maximum pressure at the printed loads, medians: II < IV < I < V < III",
            bool(medians[ii] < medians[iv] < 0.0 < medians[v] < medians[iii]),
            text,
        ),
        Check(
            "IV lowers the pressure and V raises it by about as much, to a factor of two (the "
            "source: only IV matters)",
            bool(0.5 < -medians[v] / medians[iv] < 2.0),
            f"{100.0 * medians[iv]:+.1f} % and {100.0 * medians[v]:+.1f} %",
        ),
        Check(
            "pressures of III and II differ less than with layers ten times as thick, by 4 or more",
            bool(spread_thick > 4.0 * spread_thin),
            f"{100.0 * spread_thin:.1f} % against {100.0 * spread_thick:.1f} % of I",
        ),
        Check(
            "von Mises: every structure within 10 % of I, in the median",
            bool((np.abs(np.median(mises, axis=1) - 1.0) < 0.1).all()),
            ", ".join(f"{STRUCTURES[k]} {rough.spread(mises[k])}" for k in (ii, iii, iv, v)),
        ),
        Check(
            "tension on each surface: more than 1.3 times that of I in III, less than 0.8 in II",
            rough.all_above(tension[iii], 1.3) and rough.all_below(tension[ii], 0.8),
            f"III {rough.spread(tension[iii])}, II {rough.spread(tension[ii])}",
        ),
        agree(
            "pressure and area of I at 4e-6 and 1e-2 E3",
            [data[n][0, 0, [0, -1]] for n in ("max_pressure", "contact_fraction")],
            data["second"],
        ),
        agree("von Mises, tension, s_xz of III", data["maxima"][iii], data["second_stress"]),
    ]


if __name__ == "__main__":
    run_page(__file__)
