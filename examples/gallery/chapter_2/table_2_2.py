"""Table 2.2: what layers do to pressure, area, meniscus force and stress, computed."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.stress_maps import maxima
from contactkit.gallery.second_method.anchors import Case, Solved, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="Table 2.2",
    title="What layers do, computed",
    claim="Arrows for compliant, stiff, soft and hard layers and interlayers against the "
    "homogeneous body; a compliant interlayer is ideal for lower wear.",
    verdict="Directions agree for stiffness but for the size of some: the pressure of IV falls by "
    "a little more than a tenth, one arrow and not two, and the tension rises where the "
    "source has the stress fall. For hardness the source's arrows of area and film force "
    "are far too large: where a small part of the contact is plastic they do not change at"
    " all; and what interlayers do there is the source's rule of hardness (Fig. 2.15).",
    choices="Thresholds on the median change against I: below 3 % none, up to 20 % one arrow, "
    "beyond two. Stiffness: layers of 10 rms heights at 4e-6 E3, shortest wave 156 nm. Hardness: "
    "layers of one rms height at 1e-3 E3, shortest wave 39 nm, continuous rule. Friction is read "
    "from the area, wear from the stress."
    " Tension is that of eight pixels for the shortest wave: uncertain by 30 %, its ratios "
    "between structures by 10 to 20 % (page Refinement)."
    " The area at the lowest load is that of a few spots: Fig. 2.10 adds it over the loads. "
    "The columns of friction, wear and suggestion follow in the source from those of area and "
    "stress; its arrows of wear of soft and hard layers (plastic contact easy or hard) are "
    "those of the plastic area, Figs. 2.14 and 2.15.",
    grid=f"stiffness: {rough.WIDE}; hardness: {rough.FINE}",
    seeds="1 to 5, each against structure I on the same surface",
)
NONE, ONE = 0.03, 0.2
QUANTITIES = ("max pressure", "contact area", "meniscus force", "von Mises", "tension")
STRUCTURES = list(rough.STRUCTURES)[1:]
# Arrows of the source: maximum pressure, contact area, meniscus force, maximum stress.
SOURCE = {
    ("stiffness", "II"): (-2, 2, 2, -2),
    ("stiffness", "III"): (2, -1, -2, 1),
    ("stiffness", "IV"): (-2, 1, 1, -2),
    ("stiffness", "V"): (1, -1, -1, 1),
    ("hardness", "II"): (-1, 2, 2, -2),
    ("hardness", "III"): (2, -1, -1, 1),
    ("hardness", "IV"): (-2, 1, 1, -2),
    ("hardness", "V"): (1, -1, -1, 2),
}


def numbers(stack: ck.Stack, sampling: rough.Sampling, load: float, seed: int) -> list[float]:
    """The quantities of one contact."""
    effects = (ck.HardnessLimit(), ck.FilmMeniscus(film_thickness=1.0 * rough.NM))
    made = rough.plan(rough.SURFACES[0], stack, sampling, seed, *effects)
    run = ck.solve(made.with_loading(ck.Pressing(pressure=load * rough.MODULUS)))
    mises, tension, _ = maxima(run, (0.0,))[0]
    force = run.of(ck.FilmMeniscus).force
    return [run.max_pressure, run.contact_area, force, float(mises), float(tension)]


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Changes (effects, structures, seeds, quantities) against I."""
    found, first = [], []
    for sampling, load, stacks in (
        (rough.wide(draft), 4e-6, [(m, (1.0, 1.0), 10.0) for m in rough.STRUCTURES.values()]),
        (rough.fine(draft), 1e-3, [((1.0, 1.0), h, 1.0) for h in rough.STRUCTURES.values()]),
    ):
        made = [rough.body(m, h, t * rough.NM) for m, h, t in stacks]
        values = [[numbers(s, sampling, load, seed) for seed in sampling.seeds] for s in made]
        found.append(rough.ratios(np.array(values))[1:] - 1.0)
        first.append([np.array(values)[k, 0, :3] for k in (0, 3)])
    cases = [
        [pressed(rough.wide(draft), Case(4e-6, name)) for name in ("I", "IV")],
        [pressed(rough.fine(draft), Case(1e-3, thickness=1e-9))],
    ]
    second = [[_numbers(one) for one in ones] for ones in cases]
    return {
        "change": np.array(found),
        "first": np.array([*first[0], first[1][0]]),
        "second": np.array([*second[0], *second[1]]),
    }


def _numbers(found: Solved) -> list[float]:
    """Largest pressure [Pa], area [m2] and film force [N] by the second method."""
    return [
        found.max_pressure,
        found.fraction * found.sampling.width**2,
        found.film_force(),
    ]


def arrows(change: float) -> int:
    """Number of arrows of a change, negative downwards."""
    size = 0 if abs(change) < NONE else 1 if abs(change) < ONE else 2
    return size if change > 0.0 else -size


def shown(count: int) -> str:
    """Arrows as text."""
    return "none" if count == 0 else ("up " if count > 0 else "down ") + "I" * abs(count)


def draw(data: Data) -> plot.Figure:
    """Median changes with their range."""
    figure, axes = plot.figure(1, 2, size=(8.6, 4.2))
    for ax, effect, change in zip(axes, ("stiffness", "hardness"), data["change"], strict=True):
        at = np.arange(len(QUANTITIES))
        for i, (name, values) in enumerate(zip(STRUCTURES, change, strict=True)):
            middle, x = np.median(values, axis=0), at + 0.18 * (i - 1.5)
            reach = [middle - values.min(axis=0), values.max(axis=0) - middle]
            style = plot.series(i + 1) | {"ls": "", "ms": 5}
            prime = "'" if effect == "hardness" else ""
            ax.errorbar(x, 100.0 * middle, 100.0 * np.array(reach), label=name + prime, **style)
        for limit in (NONE, -NONE, ONE, -ONE):
            ax.axhline(100.0 * limit, color="0.6", lw=0.7, ls=":")
        ax.set_xticks(at, [q.replace(" ", "\n") for q in QUANTITIES], fontsize=8)
        ax.set(ylabel="change against I [%]")
        ax.legend(fontsize=8, loc="upper left" if effect == "stiffness" else "lower right")
    plot.letters(axes, ("stiffness of layers", "hardness of layers"))
    return figure


def check(data: Data) -> list[Check]:
    """Directions against the source; what disagrees."""
    medians = np.median(data["change"], axis=2)
    ours = {
        (effect, name): [arrows(float(x)) for x in medians[i, k]]
        for i, effect in enumerate(("stiffness", "hardness"))
        for k, name in enumerate(STRUCTURES)
    }
    stiff = [k for k in SOURCE if k[0] == "stiffness"]
    opposite = [k for k in SOURCE for a, b in zip(ours[k], SOURCE[k], strict=False) if a * b < 0]
    soft = np.abs(data["change"][1][..., 1:3]).max()
    return [
        Check(
            "stiffness: every direction of pressure, area and von Mises is that of the source",
            all(a * b > 0 for k in stiff for a, b in zip(ours[k][:2], SOURCE[k][:2], strict=True))
            and all(ours[k][3] * SOURCE[k][3] > 0 for k in stiff),
            "; ".join(f"{k[1]} {ours[k]}" for k in stiff),
        ),
        Check(
            "no arrow of pressure, area, film force or von Mises points against the source",
            not opposite,
            f"{len(opposite)} do",
        ),
        Check(
            "a compliant interlayer raises the tension, in the median (the source: stress falls)",
            bool(medians[0, STRUCTURES.index("IV"), 4] > NONE),
            f"{100.0 * medians[0, STRUCTURES.index('IV'), 4]:+.0f} %",
        ),
        Check(
            "hardness changes area and meniscus force by less than 5 % (the source: up to two "
            "arrows)",
            bool(soft < 0.05),
            f"at most {100.0 * soft:.2f} %",
        ),
        agree("pressure, area, force of I, IV and I'", data["first"], data["second"]),
    ]


def table(data: Data) -> Table:
    """Arrows of ours beside those of the source."""
    medians = np.median(data["change"], axis=2)
    rows = []
    for i, effect in enumerate(("stiffness", "hardness")):
        for k, name in enumerate(STRUCTURES):
            source = (*SOURCE[effect, name], SOURCE[effect, name][3])
            cells = [
                f"{100.0 * x:+.1f} %: {shown(arrows(float(x)))} (source {shown(s)})"
                for x, s in zip(medians[i, k], source, strict=True)
            ]
            rows.append((effect, name, *cells))
    return Table(("effect", "structure", *QUANTITIES), rows)


if __name__ == "__main__":
    run_page(__file__)
