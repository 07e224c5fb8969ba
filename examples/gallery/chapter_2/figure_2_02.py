"""Fig. 2.2: stress below a sphere on one layer, with friction, in sections to scale."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.analyses.subsurface import MEASURES, stress_below
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2.layered_sphere import A0, P0, pressed
from contactkit.plot import gallery as plot
from contactkit.plot.stress import draw_section

PAGE = Page(
    name="2.2",
    title="Stress below a sphere on one layer, with friction",
    claim="A stiffer layer leads to higher maximum stress, a more compliant one to lower, whatever "
    "the friction. Friction raises the maximum and moves it towards the surface.",
    verdict="Holds, but with little friction the maximum lies below the surface and moves along x "
    "rather than up; at 0.5 it is at the surface, at the trailing edge. Drawn is the "
    "square root of J2, which the source's Appendix A calls the stress of von Mises.",
    choices="Thickness a0, the contact radius of Hertz on the substrate; Poisson's ratio 0.3; "
    "ratios 0.5, 1, 2, coefficients 0, 0.25, 0.5. The sphere slides to the right.",
    grid="97 x 97 pixels on 3.2 a0, not periodic; 21 planes down to 1.6 a0",
)
RATIOS, FRICTIONS, WIDTH = (0.5, 1.0, 2.0), (0.0, 0.25, 0.5), 3.2
LEVELS = [0.05 * i for i in range(17)]
# Largest sqrt(J2)/p0 by an independent calculation, and where: (x, z)/a0.
EXACT = np.array(
    [
        [0.2641256, 0.2753377, 0.3871550],
        [0.3579808, 0.3738883, 0.5523416],
        [0.4929602, 0.5288368, 0.8273036],
    ]
)


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Sections of sqrt(J2), and maxima by a search over depth, for all ratios and coefficients."""
    pixels = 65 if draft else 97
    depths = tuple(A0 * z for z in (*np.linspace(0.0, 1.0, 15), *np.linspace(1.1, 1.6, 6)))
    sections, maxima, places = [], [], []
    for ratio in RATIOS:
        run = pressed(ratio, pixels, WIDTH)
        for mu in FRICTIONS:
            friction = ck.FrictionTraction(coefficient=mu)
            part = stress_below(run, ck.SubsurfaceStress(depths=depths), friction)
            best = stress_below(run, friction=friction).maxima["sqrt_j2"]
            sections.append(MEASURES["sqrt_j2"](part.section) / P0)
            maxima.append(best.value / P0)
            places.append((best.x / A0 + 0.5 * WIDTH / pixels - 0.5 * WIDTH, best.z / A0))
    shape = (len(RATIOS), len(FRICTIONS))
    return {
        "x": WIDTH * ((np.arange(pixels) + 0.5) / pixels - 0.5),
        "z": part.depth / A0,
        "layer": part.layer,
        "section": np.array(sections).reshape(*shape, *sections[0].shape),
        "maximum": np.array(maxima).reshape(shape),
        "place": np.array(places).reshape(*shape, 2),
    }


def draw(data: Data) -> plot.Figure:
    """Nine sections: ratios down, friction across."""
    figure, axes = plot.figure(3, 3, size=(8.2, 5.0), sharex=True, sharey=True)
    for i, ratio in enumerate(RATIOS):
        for j, mu in enumerate(FRICTIONS):
            ax = axes[i, j]
            at = (data["x"], data["z"], data["layer"], data["section"][i, j])
            draw_section(*at, ax, levels=LEVELS)
            (x, z), best = data["place"][i, j], data["maximum"][i, j]
            text = rf"$\mu$ = {mu:g}: {best:.3f} at ({x:.2f}, {z:.2f})"
            ax.set_title(text, fontsize=8, loc="left")
            ax.set_xlim(-1.6, 1.6)
        axes[i, 0].set_ylabel(f"$E_1/E_2$ = {ratio:g}\n$z/a_0$ [-]")
    for ax in axes[-1]:
        ax.set_xlabel("$x/a_0$ [-]")
    plot.colour_bar(
        figure, axes, LEVELS, r"$\sqrt{J_2}/p_0$; circle: its maximum, dashed: interface"
    )
    return figure


def check(data: Data) -> list[Check]:
    """Orderings, and agreement with the independent calculation."""
    best, place = data["maximum"], data["place"]
    inside = np.abs(best[:, :2] / EXACT[:, :2] - 1.0).max()
    edge = np.abs(best[:, 2] / EXACT[:, 2] - 1.0).max()
    text = "; ".join(", ".join(f"{v:.3f}" for v in row) for row in best)
    return [
        Check(
            "the stiffer the layer, the higher the maximum, at each coefficient",
            bool((np.diff(best, axis=0) > 0.0).all()),
            text,
        ),
        Check(
            "the more friction, the higher the maximum, for each layer",
            bool((np.diff(best, axis=1) > 0.0).all()),
            text,
        ),
        Check(
            "with a coefficient of 0.5 the maximum is at the surface, behind the centre",
            bool((place[:, 2, 1] == 0.0).all() and (place[:, 2, 0] < 0.0).all()),
            f"z/a0 {place[:, 2, 1].round(2)}, x/a0 {place[:, 2, 0].round(2)}",
        ),
        Check(
            "friction of 0.25 moves the maximum along x, by more than it moves it up",
            bool((np.abs(place[:, 1, 0]) > np.abs(place[:, 1, 1] - place[:, 0, 1])).all()),
            f"x/a0 {place[:, 1, 0].round(2)}, z/a0 {place[:, 1, 1].round(2)}",
        ),
        Check(
            "maxima below the surface are those of an independent calculation to 2 %",
            bool(inside < 0.02),
            f"largest difference {100.0 * inside:.2f} %",
        ),
        Check(
            "maxima at the trailing edge are those of an independent calculation to 8 %: a cusp, "
            "which a grid approaches as the square root of the pixel",
            bool(edge < 0.08),
            f"largest difference {100.0 * edge:.1f} %",
        ),
    ]


def table(data: Data) -> Table:
    """Maximum of each case beside that of the independent calculation."""
    best = data["maximum"]
    rows = [
        (ratio, mu, *map(float, (best[i, j], EXACT[i, j], *data["place"][i, j])))
        for i, ratio in enumerate(RATIOS)
        for j, mu in enumerate(FRICTIONS)
    ]
    return Table(("E1/E2", "mu", "sqrt(J2)/p0", "independent", "x/a0", "z/a0"), rows)


if __name__ == "__main__":
    run_page(__file__)
