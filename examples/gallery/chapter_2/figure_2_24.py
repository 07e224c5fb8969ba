"""Fig. 2.24: meniscus force over the load, hardness of homogeneous bodies and of layers."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_panel, labelled
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.24",
    title="Meniscus force over the load, hardness",
    claim="Hardness changes the meniscus force in the elastic-plastic regime only. A soft "
    "interlayer (IV') lowers it significantly, a hard one (V') raises it a little.",
    verdict="The first sentence holds, and the changes are small: the plastic area is a small "
    "part of the contact. A soft interlayer changes the force less than soft layers do; "
    "hard ones change nothing.",
    choices="Continuous hardness rule, layers of one rms height; film as in Fig. 2.23, reported "
    "only.",
    grid=rough.FINE,
    seeds="1 to 5: median and range",
)
LOADS = (1e-5, 4e-5, 1e-4, 4e-4, 1e-3, 4e-3)
HOMOGENEOUS = (1.0, 0.5, 2.0)
COLUMNS = ("relative_meniscus_force", "meniscus_force", "plastic_fraction")
STRUCTURES = list(rough.STRUCTURES)


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Forces (structures, seeds, loads), and those of homogeneous bodies."""
    sampling, surface = rough.fine(draft), rough.SURFACES[0]
    film = ck.FilmMeniscus(film_thickness=1.0 * rough.NM)
    stacks = [rough.body((1.0, 1.0), h, 1.0 * rough.NM) for h in rough.STRUCTURES.values()]
    cases = [(surface, stack) for stack in stacks]
    layered = rough.curves(cases, sampling, LOADS, COLUMNS, ck.HardnessLimit(), film)
    single = [
        rough.curves(
            cases[:1],
            sampling,
            LOADS,
            COLUMNS,
            ck.HardnessLimit(rule=ck.ConstantHardness(hardness=h * rough.HARDNESS)),
            film,
        )
        for h in HOMOGENEOUS
    ]
    plain = {f"plain_{n}": np.concatenate([one[n] for one in single]) for n in COLUMNS}
    second = [
        pressed(sampling, Case(load, thickness=1e-9, hardness=hardness)).film_force()
        for load, hardness in ((1e-5, 5e9), (4e-3, 2.5e9))
    ]
    return layered | plain | {"second": np.array(second)}


def draw(data: Data) -> plot.Figure:
    """Relative force, and the change against I'."""
    figure, axes = plot.figure(2, 2, size=(8.2, 6.2))
    for row, prefix, labels in (
        (axes[0], "plain_", [f"homogeneous, {h:g} $H_3$" for h in HOMOGENEOUS]),
        (axes[1], "", labelled(rough.HARD_MEANING, "'")),
    ):
        draw_panel(row[0], LOADS, COLUMNS[0], data[prefix + COLUMNS[0]], labels)
        change = 100.0 * (rough.ratios(data[prefix + COLUMNS[1]]) - 1.0)
        for i, label in enumerate(labels):
            plot.band(row[1], LOADS, change[i], i, label)
        row[1].set(xscale="log", xlabel="$p_n/E_3$", ylabel="change of the force [%]")
        row[0].legend(fontsize=7)
    plot.letters(axes.ravel(), ("homogeneous", "against $H_3$", "layers", "against I'"))
    return figure


def check(data: Data) -> list[Check]:
    """Elastic regime, plastic regime, interlayers."""
    change = rough.ratios(data["meniscus_force"]) - 1.0
    plain = rough.ratios(data["plain_meniscus_force"]) - 1.0
    elastic = data["plain_plastic_fraction"].max(axis=0) == 0.0
    most = float(np.abs(plain[:, elastic]).max(initial=0.0))
    middle = np.median(change[..., -1], axis=1)
    ii, iii, iv, v = (STRUCTURES.index(name) for name in ("II", "III", "IV", "V"))
    return [
        Check(
            "where nothing is plastic the force does not depend on the hardness",
            bool(most < 1e-3),
            f"changes by at most {100.0 * most:.1e} % at {int(elastic.sum())} points",
        ),
        Check(
            "a body half as hard has a bit more meniscus force up to 1e-3 E3, in the median, and "
            "less at 4e-3 E3, each surface",
            bool((np.median(plain[1], axis=0)[1:5] > 0.0).all() and (plain[1, :, -1] < 0.0).all()),
            f"{rough.spread(100.0 * plain[1, :, 1:5])} %, then "
            f"{rough.spread(100.0 * plain[1, :, -1])} %",
        ),
        Check(
            "up to 1e-3 E3 layers change the force by less than 5 % (the source: significantly)",
            bool((np.abs(change[..., :-1]) < 0.05).all()),
            f"at most {100.0 * np.abs(change[..., :-1]).max():.2f} %",
        ),
        Check(
            "at 4e-3 E3, medians: IV' changes it less than II', V' and III' by less than 0.1 %",
            bool(
                abs(middle[iv]) < abs(middle[ii])
                and abs(middle[iii]) < 1e-3
                and abs(middle[v]) < 1e-3
            ),
            ", ".join(
                f"{STRUCTURES[k]}' {rough.spread(100.0 * change[k, :, -1])} %"
                for k in (ii, iii, iv, v)
            ),
        ),
        agree(
            "force of a homogeneous body at 1e-5 E3, and of one half as hard at 4e-3",
            [data["plain_meniscus_force"][0, 0, 0], data["plain_meniscus_force"][1, 0, -1]],
            data["second"],
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
