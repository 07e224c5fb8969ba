"""Stress under a loaded, sheared square: against the program CONTACT."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RectBivariateSpline

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.stress.planes import planes
from contactkit.elasticity.stress.tractions import Tractions
from contactkit.gallery.measured.cases import case
from contactkit.plot import gallery as plot

PAGE = Page(
    name="contact-square",
    title="Stress under a loaded and sheared square, by the program CONTACT",
    claim="CONTACT (E. Vollebregt, after Kalker 1990, Fig. 5.20; as stored in eve70a/CONTACT, "
    "Apache-2.0) prints the six stresses at points below a square of pressure 1 and "
    "traction 0.999.",
    verdict="Agrees to all six digits at every depth from 0.1 of the side on. The map is read as "
    "uniform on its pixels, as CONTACT reads its elements.",
    grid="pixels of 0.02 of the side, on a window of 6.4 sides",
)
CASE = case("contact_subsurface")
NAMES = ("xx", "xy", "xz", "yy", "yz", "zz")
ORDER = (0, 3, 4, 1, 5, 2)  # of the components of a plane
SHIFT = (1e-4, 2e-4)  # of the square in CONTACT


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Stresses at the points of CONTACT, and along a line for the figure."""
    printed = np.array(CASE["axis"] + CASE["rows"])
    printed = printed[printed[:, 2] > 0.0]
    printed = printed[np.argsort(printed[:, 2], kind="stable")]
    pixel = 0.025 if draft else 0.02
    count = round(6.4 / pixel)
    along = (np.arange(count) - 0.5 * count + 0.5) * pixel
    inside = (np.abs(along) < 0.5).astype(float)
    square = np.outer(inside, inside)
    shear, poisson = CASE["shear_modulus"], CASE["poisson_ratio"]
    load = Tractions((pixel, pixel), square, x=0.999 * square)
    below = planes(
        load,
        Layers([2.0 * shear * (1.0 + poisson)], [poisson]),
        np.unique(printed[:, 2]).tolist(),
        mean="free",
        reading="uniform",
    )
    ours, lines = np.zeros((len(printed), 6)), {}
    for plane in below:
        at = printed[:, 2] == plane.depth
        x, y = (printed[at, i] - SHIFT[i] for i in (0, 1))
        splines = [RectBivariateSpline(along, along, plane.stress[i]) for i in ORDER]
        ours[at] = np.column_stack([spline.ev(y, x) for spline in splines])
        if plane.depth in DRAWN:
            line = np.linspace(-1.5, 1.5, 301)
            side = np.full(line.size, -0.4 - SHIFT[1])
            lines[f"line_{plane.depth:g}"] = np.array([s.ev(side, line) for s in splines])
    return {"stress": ours, "printed": printed, **lines}


DRAWN = (0.1, 0.5)


def draw(data: Data) -> plot.Figure:
    """Stresses along a line below the square, and what is left over the depth."""
    figure, axes = plot.figure(1, 3, size=(11.0, 4.3))
    printed = data["printed"]
    line = np.linspace(-1.5, 1.5, 301) + SHIFT[0]
    for ax, depth in zip(axes[:2], DRAWN, strict=True):
        at = (printed[:, 2] == depth) & (printed[:, 1] == -0.4) & (np.abs(printed[:, 0]) < 1.5)
        for k, i in enumerate((0, 2, 5)):
            style = plot.series(k)
            ax.plot(
                line, data[f"line_{depth:g}"][i], **style | {"marker": ""},
                label=rf"$\sigma_{{{NAMES[i]}}}$",
            )  # fmt: skip
            ax.plot(
                printed[at, 0], printed[at, 3 + i], **style | {"ls": "", "mfc": "none", "ms": 5}
            )
        low, high = ax.get_ylim()
        ax.set(xlabel="$x$ / side [-]", ylabel="stress / pressure [-]")
        ax.set_ylim(low, high + 0.45 * (high - low))
        ax.axvspan(-0.5, 0.5, color="0.93", zorder=0)
        ax.legend(title="line: contactkit\nmarker: CONTACT", fontsize=8, loc="upper right")
    off = np.abs(data["stress"] - printed[:, 3:])
    depths = np.unique(printed[:, 2])
    for i, name in enumerate(NAMES):
        worst = [max(off[printed[:, 2] == z, i].max(), 1e-8) for z in depths]
        axes[2].loglog(depths, worst, **plot.series(i), label=rf"$\sigma_{{{name}}}$")
    axes[2].axhline(5e-7, color="0.5", lw=0.8, label="half of the last digit")
    axes[2].set(xlabel="depth / side [-]", ylabel="largest difference / pressure [-]")
    axes[2].set_ylim(5e-9, 1e-3)
    axes[2].legend(ncols=2, fontsize=8, loc="upper right")
    titles = [f"depth {z:g}, $y = -0.4$" for z in DRAWN]
    plot.letters(axes, (*titles, "what is left"))
    return figure


def check(data: Data) -> list[Check]:
    """Agreement with what is printed, by depth."""
    printed = data["printed"]
    off = np.abs(data["stress"] - printed[:, 3:])
    shallow = printed[:, 2] < 0.15
    return [
        Check(
            "from a depth of 0.2 sides on every stress has the six digits that CONTACT prints",
            bool(off[~shallow].max() < 2e-6),
            f"at most {off[~shallow].max():.1e} of the pressure at {np.sum(~shallow)} points",
        ),
        Check(
            "at a depth of 0.1 sides they agree to 2 in 10 000 of the pressure",
            bool(off[shallow].max() < 2e-4),
            f"at most {off[shallow].max():.1e} at {np.sum(shallow)} points between pixels",
        ),
    ]


def table(data: Data) -> Table:
    """Stresses on the axis."""
    printed = data["printed"]
    rows = []
    for row, ours in zip(printed, data["stress"], strict=True):
        if row[0] == 1e-5 and row[1] == 1e-5:
            pairs = [f"{ours[i]:.6f} / {row[3 + i]:.6f}" for i in (0, 2, 3, 5)]
            rows.append((float(row[2]), *pairs))
    names = [f"sigma_{NAMES[i]}, contactkit / CONTACT" for i in (0, 2, 3, 5)]
    return Table(("depth / side", *names), rows)


if __name__ == "__main__":
    run_page(__file__)
