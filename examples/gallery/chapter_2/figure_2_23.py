"""Fig. 2.23: meniscus force over the load, structures I to V, thick and thin layers."""

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
    name="2.23",
    title="Meniscus force over the load, structures I to V",
    claim="The relative meniscus force falls with the load. It is lower for stiff layers, "
    "higher for compliant ones; a compliant interlayer lowers it by more than compliant "
    "layers do. Layers of one rms height change it little.",
    verdict="The trends with load, stiffness and thickness hold up to 1e-4 E3; beyond, contact "
    "takes the room of the film, and the order reverses. A compliant interlayer raises "
    "the force. At the printed loads the film pulls harder than the load; added to it, it "
    "is many times larger still.",
    choices="Water, 60 degrees, film and menisci of 1 nm. As published: reported only. "
    "Self-consistent: added to the load.",
    grid="256 x 256 pixels on 5 um; shortest wave 156 nm = 8 pixels",
    seeds=rough.SEEDS,
)
LOADS = (4e-6, 1e-5, 4e-5, 1e-4, 4e-4, 1e-3)
HEIGHTS = (10.0, 1.0)
STRUCTURES = list(rough.STRUCTURES)


def sampling(draft: bool) -> rough.Sampling:
    """Sampling of contacts with a film."""
    return rough.Sampling(5.0 * rough.UM, 256, (1, 2) if draft else (1, 2, 3, 4, 5))


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Forces (heights, structures, seeds, loads); those that add to the load for I, II and III."""
    surface, hard = rough.SURFACES[0], ck.HardnessLimit()
    film = ck.FilmMeniscus(film_thickness=1.0 * rough.NM)
    pulls = ck.FilmMeniscus(film_thickness=1.0 * rough.NM, self_consistent=True)
    columns = ("relative_meniscus_force", "meniscus_force", "max_displacement")
    found = []
    for height in HEIGHTS:
        stacks = [
            rough.body(m, (1.0, 1.0), height * surface.rms) for m in rough.STRUCTURES.values()
        ]
        cases = [(surface, stack) for stack in stacks]
        found.append(rough.curves(cases, sampling(draft), LOADS, columns, hard, film))
        if height == HEIGHTS[0]:
            both = rough.curves(cases[:3], sampling(draft), LOADS, columns, hard, pulls)
    made = {name: np.array([one[name] for one in found]) for name in columns}
    every = made | {f"consistent_{name}": both[name] for name in columns}
    moved = pressed(sampling(draft), Case(1e-4, "III")).max_displacement
    return every | {
        "second": _second(sampling(draft), both["meniscus_force"][0, 0, 2]),
        "second_moved": np.array(moved),
    }


def _second(sampling: rough.Sampling, pull: float) -> np.ndarray:
    """Film force [N] of I, III and thin IV; of I under a load that a film force [N] adds to."""
    found = [
        pressed(sampling, Case(load, name, thickness)).film_force()
        for load, name, thickness in (
            (4e-6, "I", 10e-9),
            (1e-4, "III", 10e-9),
            (1e-4, "IV", 1e-9),
        )
    ]
    return np.array([*found, pressed(sampling, Case(4e-5), pull / sampling.width**2).film_force()])


def draw(data: Data) -> plot.Figure:
    """Relative force of thick and thin layers, force, and with the film added to the load."""
    figure, axes = plot.figure(2, 3, size=(10.0, 6.2))
    labels = labelled(rough.MEANING)
    name = "relative_meniscus_force"
    draw_panel(axes[0, 0], LOADS, name, data[name][0], labels)
    draw_panel(axes[0, 1], LOADS, name, data[name][1], labels)
    draw_panel(axes[0, 2], LOADS, "meniscus_force", data["meniscus_force"][0], labels)
    for ax, values in zip(axes[1], data[name], strict=False):
        draw_over_first(ax, LOADS, values, labels)
    ax = axes[1, 2]
    draw_panel(ax, LOADS, name, data[name][0, :1], ["I, reported only"])
    plot.band(ax, LOADS, data[f"consistent_{name}"][0], 2, "I, adds to the load")
    plot.log_above_zero(ax, [data[name][0, 0], data[f"consistent_{name}"][0]])
    ax.legend(fontsize=8)
    titles = (
        "$h = 10\\,\\sigma$",
        "$h = \\sigma$",
        "$h = 10\\,\\sigma$",
        "$h = 10\\,\\sigma$, against I",
        "$h = \\sigma$, against I",
        "structure I, film reported or added",
    )
    plot.letters(axes.ravel(), titles)
    plot.shared(figure, axes[0, 0])
    return figure


def check(data: Data) -> list[Check]:
    """Trends with the load, structures, thickness; size of the force."""
    relative, force = data["relative_meniscus_force"], data["meniscus_force"]
    ii, iii, iv, v = (STRUCTURES.index(name) for name in ("II", "III", "IV", "V"))
    thick, thin = (rough.ratios(force[i]) for i in (0, 1))
    middle = np.median(thick, axis=1)
    narrow, wide = (np.median((one[ii] - one[iii])[:, :4]) for one in (thin, thick))
    both = data["consistent_meniscus_force"][0] / force[0, 0]
    return [
        Check(
            "medians: the relative force falls with every load; the force grows up to 4e-4 E3",
            bool(
                (np.diff(np.median(relative, axis=2), axis=-1) < 0.0).all()
                and (np.diff(np.median(force, axis=2)[..., :5], axis=-1) > 0.0).all()
            ),
            f"I: {rough.spread(relative[0, 0, :, 0])} to {rough.spread(relative[0, 0, :, -1])}",
        ),
        Check(
            "thick layers, medians up to 1e-4 E3: II and IV above I, III and V below",
            bool((middle[[ii, iv], :4] > 1.0).all() and (middle[[iii, v], :4] < 1.0).all()),
            ", ".join(f"{STRUCTURES[k]} {rough.spread(thick[k][:, :4])}" for k in (ii, iii, iv, v)),
        ),
        Check(
            "at 1e-3 E3 the order is the reverse: contact leaves less room for the film",
            bool(middle[ii, -1] < 1.0 < middle[iii, -1]),
            f"II {middle[ii, -1]:.3f}, III {middle[iii, -1]:.3f}",
        ),
        Check(
            "a compliant interlayer raises the force, up to 1e-4 E3, by less than compliant layers "
            "(the source: it lowers it)",
            bool((middle[iv, :4] > 1.0).all() and (middle[iv, :4] < middle[ii, :4]).all()),
            f"IV {rough.spread(thick[iv][:, :4])}, II {rough.spread(thick[ii][:, :4])}",
        ),
        Check(
            "with layers of one rms height III and II differ by less than a third of what they do "
            "with ten",
            bool(narrow < wide / 3.0),
            f"{narrow:.3f} against {wide:.3f} of I, up to 1e-4 E3",
        ),
        Check(
            "at the lowest load the film pulls harder than the load",
            rough.all_above(relative[..., 0]),
            f"{rough.spread(relative[..., 0])} times",
        ),
        Check(
            "a film that adds to the load pulls more than 4 times as hard at the lowest load",
            rough.all_above(both[:, 0], 4.0),
            f"{rough.spread(both[:, 0])} times; at the highest load {rough.spread(both[:, -1])}",
        ),
        *_against_second(data),
    ]


def _against_second(data: Data) -> list[Check]:
    """Numbers of the page by the second method."""
    force, iii, iv = data["meniscus_force"], STRUCTURES.index("III"), STRUCTURES.index("IV")
    return [
        agree(
            "force of I at 4e-6 E3, of III and thin IV at 1e-4, of I added to a load of 4e-5",
            [
                force[0, 0, 0, 0],
                force[0, iii, 0, 3],
                force[1, iv, 0, 3],
                data["consistent_meniscus_force"][0, 0, 2],
            ],
            data["second"],
        ),
        agree(
            "displacement of III at 1e-4 E3",
            data["max_displacement"][0, iii, 0, 3],
            data["second_moved"],
        ),
    ]


def table(data: Data) -> Table:
    """Medians of the relative force."""
    name = "relative_meniscus_force"
    rows = [
        (height, structure, *(float(x) for x in np.median(data[name][i, j], axis=0)))
        for i, height in enumerate(HEIGHTS)
        for j, structure in enumerate(STRUCTURES)
    ]
    rows += [
        ("10, adds to the load", structure, *(float(x) for x in np.median(one, axis=0)))
        for structure, one in zip(STRUCTURES, data[f"consistent_{name}"], strict=False)
    ]
    return Table(("h/rms", "structure", *(f"p = {load:g} E3" for load in LOADS)), rows)


if __name__ == "__main__":
    run_page(__file__)
