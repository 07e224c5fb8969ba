"""Fig. 2.1b: pressure under a rigid sphere on one layer, over the ratio of moduli."""

from __future__ import annotations

import numpy as np

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2.layered_sphere import A0, P0, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.1b",
    title="Pressure under a sphere on one layer",
    claim="Against the homogeneous body, a stiffer layer makes the contact smaller and the "
    "pressure higher, a more compliant one the reverse.",
    verdict="Holds. The curves agree with an independent calculation of many digits for the ratios "
    "0.5, 1, 2 and 4.",
    choices="Thickness of the layer: the contact radius of the homogeneous body, a0. Poisson's "
    "ratio 0.3, no friction.",
    grid="161 x 161 pixels on 3.2 a0, not periodic",
)
RATIOS = (0.25, 0.5, 1.0, 2.0, 4.0)
WIDTH = 3.2
# Maximum pressure and contact radius over those of Hertz, from an independent calculation.
EXACT = {
    0.5: (0.70468227, 1.20660765),
    1.0: (1.0, 1.0),
    2.0: (1.47543690, 0.81847754),
    4.0: (2.28346598, 0.65808788),
}


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Pressure along a diameter for each ratio of moduli."""
    pixels = 65 if draft else 161
    runs = [pressed(ratio, pixels, WIDTH) for ratio in RATIOS]
    return {
        "x": WIDTH * ((np.arange(pixels) + 0.5) / pixels - 0.5),
        "pressure": np.array([run.pressure[pixels // 2] / P0 for run in runs]),
        "radius": np.array([np.sqrt(run.corrected_contact_area / np.pi) / A0 for run in runs]),
    }


def draw(data: Data) -> plot.Figure:
    """Profiles of the pressure."""
    figure, ax = plot.figure(size=(6.5, 4.2))
    numbers = (4, 1, 0, 2, 3)  # of the series: the homogeneous body black
    for ratio, p, i in zip(RATIOS, data["pressure"], numbers, strict=True):
        ax.plot(data["x"], p, label=f"$E_1/E_2$ = {ratio:g}", **plot.series(i, marker=""))
    ax.set(xlabel="$x/a_0$ [-]", ylabel="pressure / $p_0$ of Hertz [-]", xlim=(-1.6, 1.6))
    ax.set_ylim(0.0, None)
    ax.legend()
    return figure


def check(data: Data) -> list[Check]:
    """Ordering, and agreement with the independent calculation."""
    peak, radius = data["pressure"].max(axis=1), data["radius"]
    rows = [
        (RATIOS.index(ratio), p, a) for ratio, (p, a) in EXACT.items()
    ]  # index, maximum pressure, radius
    off_p = max(abs(peak[i] / p - 1.0) for i, p, _ in rows)
    off_a = max(abs(radius[i] / a - 1.0) for i, _, a in rows)
    return [
        Check(
            "the stiffer the layer, the higher the maximum pressure",
            bool(np.all(np.diff(peak) > 0.0)),
            ", ".join(f"{p:.3f}" for p in peak) + " p0",
        ),
        Check(
            "the stiffer the layer, the smaller the contact radius",
            bool(np.all(np.diff(radius) < 0.0)),
            ", ".join(f"{a:.3f}" for a in radius) + " a0",
        ),
        Check(
            "maximum pressures are those of an independent calculation to 2 in 1000",
            bool(off_p < 2e-3),
            f"largest difference {off_p:.1e}",
        ),
        Check(
            "contact radii are those of an independent calculation to 1 %",
            bool(off_a < 1e-2),
            f"largest difference {off_a:.1e}",
        ),
    ]


def table(data: Data) -> Table:
    """Maximum pressure and contact radius of each ratio."""
    peak = data["pressure"].max(axis=1)
    rows = list(zip(RATIOS, map(float, peak), map(float, data["radius"]), strict=True))
    return Table(("E1/E2", "maximum pressure / p0", "contact radius / a0"), rows)


if __name__ == "__main__":
    run_page(__file__)
