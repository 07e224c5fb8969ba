"""Fig. 2.15: hardness of layers, structures I' to V': the literal and the continuous rule."""

from __future__ import annotations

from itertools import product

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.elasticity.hardness_rules import (
    effective_hardness,
    effective_hardness_literal,
)
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_panel, labelled
from contactkit.gallery.chapter_2.stress_maps import map_figure, maps, stacked
from contactkit.gallery.second_method.anchors import Case, agree, pressed, pressed_layers
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.15",
    title="Hardness of layers: the rule of the source and a continuous one",
    claim="In the elastic-plastic regime soft layers (II') give less displacement, pressure and "
    "stress and more contact, hard ones (III') the reverse; so do interlayers (IV', V'). "
    "The maximum pressure can be above the hardness of the top layer. Hard layers do not "
    "yield.",
    verdict="The order of soft and hard layers holds under both rules. What interlayers do is the "
    "rule: its criteria compare the displacement with 0.3 h2, not 0.3 (h1 + h2), so that "
    "beyond 0.3 nm the literal one forgets the top layer: IV' falls to 0.528, V' rises to "
    "1.752 of H3. The continuous rule has that to a lesser degree at first. Displacement "
    "hardly depends on hardness.",
    choices="The largest displacement, from the mean of the surface, sets one hardness for all "
    "pixels. Loads from 1e-5 to 4e-3 E3; maps at 1e-3 E3.",
    grid=rough.FINE,
    seeds="1 to 5: median and range; points without a solution are left out; maps of seed 1",
)
RULES = ("literal", "continuous")
LOADS = (1e-5, 4e-5, 1e-4, 2e-4, 4e-4, 1e-3, 2e-3, 4e-3)
COLUMNS = ("max_pressure", "contact_fraction", "plastic_fraction", "max_displacement", "hardness")
MAP_LOAD, CROP = 1e-3, 0.5e-6
NAMES = list(rough.STRUCTURES)


def stacks() -> list[ck.Stack]:
    """Structures I' to V', layers of 1 nm."""
    return [rough.body((1.0, 1.0), h, 1.0 * rough.NM) for h in rough.STRUCTURES.values()]


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Columns (rules, structures, seeds, loads), maps of both rules, the rules themselves."""
    sampling, surface = rough.fine(draft), rough.SURFACES[0]
    seeds = sampling.seeds
    found: dict[str, list[np.ndarray]] = {name: [] for name in COLUMNS}
    shown = []
    for rule, stack, seed in product(RULES, stacks(), seeds):
        limit = ck.HardnessLimit(rule="literal" if rule == "literal" else "continuous")
        made = rough.plan(surface, stack, sampling, seed, limit)
        pressures = [load * rough.MODULUS for load in LOADS]
        study = ck.study(made.scene, {"loading.pressure": pressures}, made.accuracy)
        for name in COLUMNS:
            found[name].append(study.column(name))
        if rule == "continuous" and seed == seeds[0]:
            run = ck.solve(made.with_loading(ck.Pressing(pressure=MAP_LOAD * rough.MODULUS)))
            shown.append(maps(run, round(CROP / sampling.width * sampling.pixels)))
    shape = (len(RULES), len(NAMES), len(seeds), len(LOADS))
    u = np.linspace(0.0, 6.0, 601) * rough.NM
    rules = [
        [
            rule(u, s.young_moduli, [m.hardness or 0.0 for m in s.materials], s.thicknesses)
            for s in stacks()
        ]
        for rule in (effective_hardness_literal, effective_hardness)
    ]
    curves = {name: np.array(values).reshape(shape) for name, values in found.items()}
    low, high = (pressed(sampling, Case(load, thickness=1e-9)) for load in (1e-5, 1e-3))
    hardness, soft = pressed_layers(sampling, LOADS[-1], 1e-9)
    second = {
        "second_soft": np.array([hardness, soft.max_displacement, soft.plastic_fraction(hardness)]),
        "second_moved": np.array([low.max_displacement, high.max_displacement]),
        "second_area": np.array([low.fraction, high.fraction]),
        "second_pressure": np.array([low.max_pressure, high.max_pressure]),
    }
    drawn = {"u": u, "rules": np.array(rules) / rough.HARDNESS}
    return stacked(shown) | curves | drawn | second


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """The rules, displacement, pressure and areas under both; maps."""
    labels = labelled(rough.HARD_MEANING, "'")
    figure, axes = plot.figure(2, 4, size=(10.0, 5.2))
    for row, rule, curves, i in zip(axes, RULES, data["rules"], (0, 1), strict=True):
        for k, (label, curve) in enumerate(zip(labels, curves, strict=True)):
            row[0].plot(data["u"] / rough.NM, curve, label=label, **plot.series(k, marker=""))
        row[0].set(ylabel=f"{rule}\n$H_e/H_3$", xlabel="displacement [nm]", ylim=(0.0, 2.1))
        for ax, name in zip(
            row[1:], ("max_displacement", "max_pressure", "plastic_fraction"), strict=True
        ):
            draw_panel(ax, LOADS, name, data[name][i], labels)
    plot.shared(figure, axes[0, 0])
    titles = [label.replace(": ", ":\n") for label in labels]
    return figure, map_figure(data, titles, CROP)


def check(data: Data) -> list[Check]:
    """Orderings under both rules, the jumps, the points without a solution."""
    ii, iii, iv, v = (NAMES.index(name) for name in ("II", "III", "IV", "V"))
    checks = []
    for i, rule in enumerate(RULES):
        soft, one, hard = (
            np.nanmedian(data["max_pressure"][i][k][:, -3:], axis=0) for k in (ii, 0, iii)
        )
        checks.append(
            Check(
                f"{rule}: maximum pressure from 1e-3 E3 on, medians: II' < I' < III'",
                bool((soft < one).all() and (one < hard).all()),
                f"II' {rough.spread(soft / one)}, III' {rough.spread(hard / one)} of I'",
            )
        )
        soft, one = (np.nansum(data["plastic_fraction"][i][k], axis=-1) for k in (ii, 0))
        checks.append(
            Check(
                f"{rule}: plastic area, added over the loads: larger in II' than in I'",
                bool((soft > one).all()),
                f"{rough.spread(soft / one)} times",
            )
        )
    jumps = np.abs(np.diff(data["rules"], axis=-1)).max(axis=-1)
    failed = np.isnan(data["max_pressure"]).sum(axis=(2, 3))
    peak = data["max_pressure"][0]
    same = max(float(np.abs(peak[a] / peak[b] - 1.0).max()) for a, b in ((ii, iv), (iii, v)))
    return [
        *checks,
        Check(
            "IV' and V' jump by more than 0.4 H3 by the literal rule, by the other less than 0.02",
            bool((jumps[0, [iv, v]] > 0.4).all() and (jumps[1] < 0.02).all()),
            f"literal {jumps[0].round(3)}, continuous at most {jumps[1].max():.3f} H3",
        ),
        Check(
            "after the jump IV' has 0.528 and V' 1.752 of H3",
            bool(
                abs(data["rules"][0, iv, 31] - 0.528) < 0.01
                and abs(data["rules"][0, v, 31] - 1.752) < 0.01
            ),
            f"{data['rules'][0, iv, 31]:.3f} and {data['rules'][0, v, 31]:.3f} at 0.31 nm",
        ),
        Check(
            "both rules have a solution at every load: the displacement is beyond the jump",
            bool((failed == 0).all()),
            f"points without one: literal {failed[0].tolist()}, continuous {failed[1].tolist()} of "
            f"{data['max_pressure'][0, 0].size} for I' to V'",
        ),
        Check(
            "literal rule: II' and IV' are one, and III' and V': the top layer is forgotten",
            bool(same < 1e-3),
            f"maximum pressures differ by at most {same:.0e}; least displacement "
            f"{data['max_displacement'].min() * 1e9:.2f} nm, jump at 0.30 nm",
        ),
        _areas(data),
        *_against_second(data),
    ]


def _areas(data: Data) -> Check:
    """How little the contact areas differ."""
    area = np.nanmedian(data["contact_fraction"][1][:, :, -1], axis=1)
    return Check(
        "contact areas differ by less than 20 % under the largest load",
        bool((np.abs(area / area[0] - 1.0) < 0.2).all()),
        ", ".join(f"{n}' {100.0 * a:.1f} %" for n, a in zip(NAMES, area, strict=True)),
    )


def _against_second(data: Data) -> list[Check]:
    """Numbers of the page by the second method."""
    return [
        *(
            agree(f"{what} of I' at 1e-5 and 1e-3 E3", data[name][1, 0, 0, [0, 5]], data[second])
            for what, name, second in (
                ("displacement", "max_displacement", "second_moved"),
                ("area", "contact_fraction", "second_area"),
                ("pressure, at the higher load the hardness", "max_pressure", "second_pressure"),
            )
        ),
        agree(
            "hardness and displacement of II' at 4e-3 E3",
            [data[n][1, 1, 0, -1] for n in ("hardness", "max_displacement")],
            data["second_soft"][:2],
        ),
        agree(
            "plastic area of II' at 4e-3 E3",
            data["plastic_fraction"][1, 1, 0, -1],
            data["second_soft"][2],
            0.02,
        ),
    ]


def table(data: Data) -> Table:
    """Effective hardness that the contact has, over H3, medians of both rules."""
    values = np.nanmedian(data["hardness"] / rough.HARDNESS, axis=2)
    rows = [
        (f"{name}'", rule, *(float(x) for x in values[i, k]))
        for k, name in enumerate(NAMES)
        for i, rule in enumerate(RULES)
        if name != "I"
    ]
    return Table(("structure", "rule", *(f"p = {load:g} E3" for load in LOADS)), rows)


if __name__ == "__main__":
    run_page(__file__)
