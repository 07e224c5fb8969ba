"""Table 2.2: what layers do to pressure, area, meniscus force and stress, computed."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.stress_maps import maxima
from contactkit.gallery.second_method.anchors import Case, Solved, agree, pressed, pressed_layers
from contactkit.plot import gallery as plot

PAGE = Page(
    name="Table 2.2",
    title="What layers do, computed",
    claim="Arrows for compliant, stiff, soft and hard layers and interlayers against the "
    "homogeneous body; a compliant interlayer is ideal for lower wear.",
    verdict="Directions agree for stiffness but for the size of some: the pressure of IV falls by "
    "a little more than a tenth, one arrow and not two, and the tension rises where the "
    "source has the stress fall. For hardness the arrows of area and film force are far "
    "too large, and those of interlayers are the source's rule (Fig. 2.15).",
    choices="Median change against I: below 3 % none, up to 20 % one arrow, beyond two. "
    "Stiffness: layers of 10 rms heights at 4e-6 E3, shortest wave 156 nm. Hardness: "
    "layers of one rms height at 1e-3 E3, 39 nm, continuous rule. Friction goes with the "
    "area, wear with the stress of von Mises, for hardness with the plastic area. A "
    "suggestion is borne out if friction or wear, whichever it names, has the sign it "
    "needs. Tension is uncertain by 30 %, its ratios between structures by 10 to 20 % "
    "([refinement](grid-refinement.md)).",
    grid=f"stiffness: {rough.WIDE}; hardness: {rough.FINE}",
    seeds="1 to 5, each against structure I on the same surface",
)
NONE, ONE = 0.03, 0.2
QUANTITIES = ("max pressure", "contact area", "meniscus force", "von Mises", "tension")
STRUCTURES = list(rough.STRUCTURES)[1:]
# Arrows of the source: maximum pressure, area, meniscus force, maximum stress, friction, wear.
SOURCE = {
    ("stiffness", "II"): (-2, 2, 2, -2, 2, -2),
    ("stiffness", "III"): (2, -1, -2, 1, -1, 2),
    ("stiffness", "IV"): (-2, 1, 1, -2, 1, -2),
    ("stiffness", "V"): (1, -1, -1, 1, -1, 1),
    ("hardness", "II"): (-1, 2, 2, -2, 2, 2),
    ("hardness", "III"): (2, -1, -1, 1, -1, -2),
    ("hardness", "IV"): (-2, 1, 1, -2, 1, -2),
    ("hardness", "V"): (1, -1, -1, 2, -1, 1),
}
SUGGESTED = {  # by the source, in our words; the signs of friction and wear that it needs
    ("stiffness", "II"): ("avoid", (1, 0)),
    ("stiffness", "III"): ("less friction", (-1, 0)),
    ("stiffness", "IV"): ("less wear", (0, -1)),
    ("stiffness", "V"): ("a bit less friction", (-1, 0)),
    ("hardness", "II"): ("avoid", (0, 1)),
    ("hardness", "III"): ("less friction and wear", (-1, -1)),
    ("hardness", "IV"): ("less wear", (0, -1)),
    ("hardness", "V"): ("no benefit", (0, 1)),
}


def numbers(stack: ck.Stack, sampling: rough.Sampling, load: float, seed: int) -> list[float]:
    """The quantities of one contact."""
    effects = (ck.HardnessLimit(), ck.FilmMeniscus(film_thickness=1.0 * rough.NM))
    made = rough.plan(rough.SURFACES[0], stack, sampling, seed, *effects)
    run = ck.solve(made.with_loading(ck.Pressing(pressure=load * rough.MODULUS)))
    mises, tension, _ = maxima(run, (0.0,))[0]
    force = run.of(ck.FilmMeniscus).force
    plastic = float(run.of(ck.HardnessLimit).is_plastic.sum())
    return [run.max_pressure, run.contact_area, force, float(mises), float(tension), plastic]


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Changes (effects, structures, seeds, quantities) against I; plastic pixels of hardness."""
    found, first, plastic = [], [], np.array([])
    for sampling, load, stacks in (
        (rough.wide(draft), 4e-6, [(m, (1.0, 1.0), 10.0) for m in rough.STRUCTURES.values()]),
        (rough.fine(draft), 1e-3, [((1.0, 1.0), h, 1.0) for h in rough.STRUCTURES.values()]),
    ):
        made = [rough.body(m, h, t * rough.NM) for m, h, t in stacks]
        values = np.array(
            [[numbers(s, sampling, load, seed) for seed in sampling.seeds] for s in made]
        )
        plastic = values[..., 5].sum(axis=1)
        found.append(rough.ratios(values[..., :5])[1:] - 1.0)
        first.append(values[:, 0, :3])
    cases = [
        [pressed(rough.wide(draft), Case(4e-6, name)) for name in ("I", "IV")],
        [
            pressed(rough.fine(draft), Case(1e-3, thickness=1e-9)),
            pressed_layers(rough.fine(draft), 1e-3, 1e-9)[1],
        ],
    ]
    second = [[_numbers(one) for one in ones] for ones in cases]
    return {
        "change": np.array(found),
        "plastic": plastic,
        "first": np.array([*first[0][[0, 3]], *first[1][:2]]),
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
    opposite = [
        k for k in SOURCE for a, b in zip(ours[k][:4], SOURCE[k][:4], strict=True) if a * b < 0
    ]
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
        *_of_suggestions(data),
        agree("pressure, area, force of I, IV, I' and II'", data["first"], data["second"]),
    ]


def _friction_and_wear(data: Data) -> dict[tuple[str, str], tuple[int, int]]:
    """Arrows of friction, as the area, and of wear, as von Mises or the plastic area."""
    medians, plastic = np.median(data["change"], axis=2), _plastic(data)
    return {
        (effect, name): (
            arrows(float(medians[i, k, 1])),
            arrows(float(plastic[k] if effect == "hardness" else medians[i, k, 3])),
        )
        for i, effect in enumerate(("stiffness", "hardness"))
        for k, name in enumerate(STRUCTURES)
    }


def _plastic(data: Data) -> np.ndarray:
    """Change of the plastic area of all surfaces against I', which counts as a pixel at least."""
    changed: np.ndarray = data["plastic"][1:] / max(data["plastic"][0], 1.0) - 1.0
    return changed


def _borne_out(needs: tuple[int, int], found: tuple[int, int]) -> bool:
    """Whether friction and wear have the signs that a suggestion needs."""
    return all(a == 0 or a * b > 0 for a, b in zip(needs, found, strict=True))


def _of_suggestions(data: Data) -> list[Check]:
    """Which suggestions of the source rest on what is computed."""
    found, plastic = _friction_and_wear(data), _plastic(data)
    stand = {key: _borne_out(needs, found[key]) for key, (_, needs) in SUGGESTED.items()}
    return [
        Check(
            "stiffness: all four suggestions rest on our arrows of area and von Mises",
            all(ok for (effect, _), ok in stand.items() if effect == "stiffness"),
            "; ".join(f"{n} {list(v)}" for (e, n), v in found.items() if e == "stiffness"),
        ),
        Check(
            "hardness: soft layers have more plastic area, hard ones less, as the source states; "
            "so do soft and hard interlayers, against its arrows of wear",
            bool((plastic[[0, 2]] > ONE).all() and (plastic[[1, 3]] < -ONE).all()),
            ", ".join(f"{n}' {100.0 * x:+.0f} %" for n, x in zip(STRUCTURES, plastic, strict=True)),
        ),
        Check(
            "hardness: of the suggestions only that against soft layers rests on our arrows, that "
            "for hard layers for its half of wear",
            [stand["hardness", n] for n in STRUCTURES] == [True, False, False, False]
            and found["hardness", "III"][1] < 0,
            "; ".join(f"{n}' {list(v)}" for (e, n), v in found.items() if e == "hardness"),
        ),
    ]


def table(data: Data) -> Table:
    """Arrows of ours beside those of the source."""
    medians, found = np.median(data["change"], axis=2), _friction_and_wear(data)
    rows = []
    for i, effect in enumerate(("stiffness", "hardness")):
        for k, name in enumerate(STRUCTURES):
            source = (*SOURCE[effect, name][:4], SOURCE[effect, name][3])
            cells = [
                f"{100.0 * x:+.1f} %: {shown(arrows(float(x)))} (source {shown(s)})"
                for x, s in zip(medians[i, k], source, strict=True)
            ]
            more = [
                f"{shown(a)} (source {shown(b)})"
                for a, b in zip(found[effect, name], SOURCE[effect, name][4:], strict=True)
            ]
            text, needs = SUGGESTED[effect, name]
            stands = "yes" if _borne_out(needs, found[effect, name]) else "no"
            prime = "'" if effect == "hardness" else ""
            rows.append((effect, name + prime, *cells, *more, f"{text}: {stands}"))
    head = ("friction, as the area", "wear", "suggested by the source: borne out")
    return Table(("effect", "structure", *QUANTITIES, *head), rows)


if __name__ == "__main__":
    run_page(__file__)
