"""Layered half-space under wheels: against ELLEA1, BISAR, KENLAYER and GAMES."""

from __future__ import annotations

from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.measured.cases import case
from contactkit.gallery.measured.round_loads import fields, strains
from contactkit.plot import gallery as plot

PAGE = Page(
    name="layered-programs",
    title="Layered half-space under one and two wheels, by four other programs",
    claim="Programs for pavements print stresses, displacements and strains under uniform round "
    "loads on three bonded layers. ELLEA1 (E. Levenberg, DTU 2016), in its output as "
    "stored with ALVA (Apache-2.0); BISAR, KENLAYER and GAMES, quoted there from the "
    "AMADEUS report (2000).",
    verdict="Agrees to what they print. What is left of ELLEA1 is below 2e-4 of the largest "
    "stress, near the surface, where it prints 1.0998 MPa under a load of 1.1 MPa. The "
    "strains lie within the spread of the three programs but for BISAR's vertical strain "
    "half-way between two wheels, off by 0.7 %.",
    choices="The surface itself is left out: the integral over wavenumbers does not converge "
    "there. The horizontal strain under two wheels is the one across their line.",
    grid="51 depths; quadrature over 3000 to 9000 wavenumbers each",
)
ELLEA = ("ellea1_singledepth", "ellea1_dualdepth", "ellea1_halfspace")
TITLES = ("one wheel, three layers", "two wheels, three layers", "one wheel, half-space")
LAYERS = ((0.005, 0.15), (0.15, 0.75), (0.75, 1.05))  # drawn [m]
PROGRAMS = ("BISAR", "KENLAYER", "GAMES")
SINGLE, DUAL = "amadeus_single_wheel", "amadeus_dual_wheel"


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Fields at the depths that the programs print."""
    found = {}
    for name in ELLEA:
        given = case(name)
        rows = np.array(given["rows"])[1:]  # but the surface
        ours = fields(given, rows[:, 0], ["-"] * len(rows), 0.0)
        found[name] = np.column_stack([-ours[:, :3], ours[:, 3]])
        found[f"{name}_printed"] = rows
    for name in ELLEA[:2]:
        for layer, (top, bottom) in enumerate(LAYERS):
            z = np.linspace(top, bottom, 12 if draft else 40)
            sides = ["+"] * (len(z) - 1) + ["-"]
            found[f"{name}_line_{layer}"] = np.column_stack(
                [z, -fields(case(name), z, sides, 0.0)[:, :3]]
            )
    for name, places in ((SINGLE, (0.0, 0.1508)), (DUAL, (0.17, 0.0))):
        found[name] = np.array([_strains(case(name), x) for x in places]).ravel()
        found[f"{name}_printed"] = np.array([case(name)[program] for program in PROGRAMS], float)
    return found


def _strains(given: dict[str, Any], x: float) -> list[float]:
    """Strain along the surface at the bottom of the first layer, vertical ones below interfaces."""
    first, second = np.cumsum(given["thickness_m"])
    ours = fields(given, [first, first, second], ["-", "+", "+"], x)
    layers = list(zip(given["young_modulus_Pa"], given["poisson_ratio"], strict=True))
    above, below, base = (
        strains(stress, *layer) for stress, layer in zip(ours[:, :3], layers, strict=True)
    )
    along = above[0 if len(given["load_centres_m"]) == 1 else 1]
    return [-1e6 * float(value) for value in (along, below[2], base[2])]


def draw(data: Data) -> plot.Figure:
    """Stresses over depth, and what is left between the programs."""
    figure, axes = plot.figure(1, 3, size=(10.5, 4.6))
    labels = (r"$\sigma_x$", r"$\sigma_y$", r"$\sigma_z$")
    for ax, name in zip(axes[:2], ELLEA[:2], strict=True):
        printed = data[f"{name}_printed"]
        for i, label in enumerate(labels):
            if name == ELLEA[0] and i == 1:
                continue  # the same as along x
            style = plot.series(i)
            for layer in range(len(LAYERS)):
                z, *ours = data[f"{name}_line_{layer}"].T
                line = style | {"marker": "", "label": label if layer == 0 else None}
                ax.plot(ours[i] / 1e6, z, **line)
            dots = style | {"ls": "", "ms": 4.5, "mfc": "none"}
            ax.plot(printed[:, 1 + i] / 1e6, printed[:, 0], **dots)
        for depth in (0.15, 0.75):
            ax.axhline(depth, color="0.6", lw=0.8)
        ax.set(xlabel="stress, compression positive [MPa]", ylabel="depth [m]", ylim=(1.03, 0.0))
        ax.legend(title="line: contactkit,\nmarker: ELLEA1", loc="lower right")
    axes[0].get_legend().get_texts()[0].set_text(r"$\sigma_x = \sigma_y$")
    ax = axes[2]
    for i, (name, title) in enumerate(zip(ELLEA, TITLES, strict=True)):
        printed = data[f"{name}_printed"]
        worst = np.abs(data[name][:, :3] - printed[:, 1:4]).max(axis=1)
        ax.semilogx(np.maximum(worst, 1.0), printed[:, 0], **plot.series(i), label=title)
    ax.axvline(50.0, color="0.5", lw=0.8, label="half of its last digit")
    ax.set(xlabel="largest difference of a stress [Pa]", ylabel="depth [m]", ylim=(1.03, 0.0))
    ax.set_xlim(1.0, 1e6)
    ax.legend(loc="center right", fontsize=8)
    plot.letters(axes, ("one wheel", "two wheels, between them", "what is left"))
    return figure


def check(data: Data) -> list[Check]:
    """Agreement with what is printed."""
    stress = max(np.abs(data[n][:, :3] - data[f"{n}_printed"][:, 1:4]).max() for n in ELLEA)
    is_deep = data[f"{ELLEA[0]}_printed"][:, 0] > 0.19
    deep = max(np.abs(data[n][:, :3] - data[f"{n}_printed"][:, 1:4])[is_deep].max() for n in ELLEA)
    largest = max(np.abs(data[f"{n}_printed"][:, 1:4]).max() for n in ELLEA)
    moved = max(np.abs(data[n][:, 3] - data[f"{n}_printed"][:, 4]).max() for n in ELLEA)
    single, printed = data[SINGLE], data[f"{SINGLE}_printed"]
    outside = np.maximum(printed.min(0) - single, single - printed.max(0)).max()
    dual, others = data[DUAL], data[f"{DUAL}_printed"]
    apart = np.abs(dual - others)
    return [
        Check(
            "stresses are those of ELLEA1 to 2 in 10 000 of the largest",
            bool(stress < 2e-4 * largest),
            f"at most {stress:.0f} Pa of {largest / 1e6:.2f} MPa, at 51 depths",
        ),
        Check(
            "deeper than 0.19 m they agree to one unit of its last digit, 100 Pa, and rounding",
            bool(deep < 150.0),
            f"at most {deep:.0f} Pa",
        ),
        Check(
            "displacements are those of ELLEA1 to its last digit and a bit",
            bool(moved < 1.5e-7),
            f"at most {moved:.2g} m; it prints 1e-7 m",
        ),
        Check(
            "strains under one wheel lie between those of BISAR, KENLAYER and GAMES, within 0.1e-6",
            bool(outside < 0.1),
            f"at most {max(outside, 0.0):.2f}e-6 outside",
        ),
        Check(
            "strains under two wheels are those of KENLAYER and GAMES, rounded",
            bool(np.nanmax(apart[1:]) < 0.5),
            f"at most {np.nanmax(apart[1:]):.2f}e-6 off, of whole numbers",
        ),
        Check(
            "BISAR agrees too, but for one strain by a unit",
            bool(np.sum(apart[0] > 0.5) == 1 and np.nanmax(apart[0]) < 1.5),
            f"at most {np.nanmax(apart[0]):.2f}e-6 off",
        ),
    ]


def table(data: Data) -> Table:
    """Strains of the pavement, in 1e-6."""
    places = ("below the centre", "below the edge"), ("below one wheel", "half-way")
    kinds = ("along, first layer", "vertical, second layer", "vertical, ground")
    rows = []
    for name, where in zip((SINGLE, DUAL), places, strict=True):
        for i, value in enumerate(data[name]):
            others = [float(v) if np.isfinite(v) else "-" for v in data[f"{name}_printed"][:, i]]
            rows.append((f"{where[i // 3]}, {kinds[i % 3]}", *others, float(round(value, 2))))
    return Table(("strain [1e-6], compression positive", *PROGRAMS, "contactkit"), rows)


if __name__ == "__main__":
    run_page(__file__)
