"""Real area of contact of rough surfaces: against the law quoted from Pastewka and Robbins."""

from __future__ import annotations

import warnings

import numpy as np
from scipy.special import erf

import contactkit as ck
from contactkit.analyses.area_over_load import area_over_load
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine

PAGE = Page(
    name="rough-area",
    title="Real area of contact of self-affine surfaces",
    claim="A/A0 = erf(sqrt(pi) p/(E* g)), g the rms gradient: a factor kappa of 2 at small "
    "loads (quoted from Pastewka and Robbins, Appl. Phys. Lett. 108, 2016, 221601; made "
    "for rough spheres). Simulations have 2.0 to 2.5, Persson's theory 1.60, that of "
    "Bush, Gibson and Thomas 2.51.",
    verdict="Met to a round number: 10 to 15 % below our areas at 1 % of contact, the same at a "
    "fifth, 7 % above at two thirds. Our kappa at the smallest load is 2.3.",
    choices="Hurst exponent 0.8, rms gradient 0.1, waves from a fifth of the window to an "
    "eightieth. Areas are corrected at their edges.",
    grid="1024 x 1024 pixels, periodic, 12.8 to the shortest wave",
    seeds="1 to 5",
)
LOADS = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4)  # p/(E* g)
GRADIENT, MODULUS, PIXEL = 0.1, 1e9, 1e-9


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Area of each seed under each load."""
    pixels, seeds = (512, 2) if draft else (1024, 5)
    rubber = ck.Material(young_modulus=0.75 * MODULUS, poisson_ratio=0.5)
    spectrum = SelfAffineSpectrum(0.8, pixels / 5.0 * PIXEL, pixels / 80.0 * PIXEL)
    areas, persson = [], np.zeros(len(LOADS))
    for seed in range(1, seeds + 1):
        size, pixel = (pixels, pixels), (PIXEL, PIXEL)
        heights = self_affine(size, pixel, None, spectrum, seed, "sample", rms_slope=GRADIENT)
        with warnings.catch_warnings():
            # The spots of the smallest loads are few pixels wide, and nothing yields here.
            warnings.simplefilter("ignore", ck.ValidityWarning)
            pressed = [ck.press(heights, PIXEL, rubber, p * GRADIENT * MODULUS) for p in LOADS]
        found = area_over_load(pressed)
        areas.append(found.corrected)
        persson = found.theories["Persson"]
    return {"area": np.array(areas), "persson": persson}


def _law() -> np.ndarray:
    return np.asarray(erf(np.sqrt(np.pi) * np.array(LOADS)))


def draw(data: Data) -> plot.Figure:
    """Area over the load, and over what the law says."""
    figure, (ax, ratio) = plot.figure(1, 2, size=(9.5, 4.2))
    load = np.array(LOADS)
    fine = np.geomspace(0.003, 0.6, 100)
    plot.band(ax, load, data["area"], 0, "contactkit, all seeds", ls="")
    lines = (
        ("quoted law", erf(np.sqrt(np.pi) * fine), 1),
        ("Persson", erf(np.sqrt(2.0) * fine), 2),
        ("Bush, Gibson, Thomas", np.sqrt(2.0 * np.pi) * fine, 3),
    )
    for name, area, i in lines:
        ax.loglog(fine, area, **plot.series(i, marker=""), label=name)
    ax.set(xlabel=r"$p/(E^* g)$ [-]", ylabel="fraction of area in contact [-]", ylim=(0.004, 1.5))
    ax.legend(fontsize=9, loc="upper left")
    plot.band(ratio, load, data["area"] / load, 0, "contactkit, all seeds")
    for name, area, i in lines:
        ratio.semilogx(fine, area / fine, **plot.series(i, marker=""), label=name)
    ratio.set(xlabel=r"$p/(E^* g)$ [-]", ylabel=r"area $\times\ E^* g/p$ [-]", ylim=(1.3, 2.9))
    plot.letters((ax, ratio), ("area", "its factor, kappa at small loads"))
    return figure


def check(data: Data) -> list[Check]:
    """Distance of the law, and place between the theories."""
    mean = data["area"].mean(axis=0)
    off = mean / _law() - 1.0
    kappa = data["area"][:, 0] / LOADS[0]
    return [
        Check(
            "areas are those of the quoted law to a sixth",
            bool(np.abs(off).max() < 1.0 / 6.0),
            ", ".join(f"{100 * x:+.0f}" for x in off) + " % at " + ", ".join(map(str, LOADS)),
        ),
        Check(
            "at a tenth to a fifth of area they agree to 5 %",
            bool(np.abs(off[3:5]).max() < 0.06),
            f"{100 * off[3]:+.1f} and {100 * off[4]:+.1f} %",
        ),
        Check(
            "mean kappa at the smallest load lies between Persson and Bush, Gibson, Thomas",
            bool(1.596 < kappa.mean() < 2.507),
            f"{kappa.min():.2f} to {kappa.max():.2f}, mean {kappa.mean():.2f}",
        ),
        Check(
            "areas are above Persson's at every load",
            bool(np.all(mean > data["persson"])),
            ", ".join(f"{a:.3f}/{b:.3f}" for a, b in zip(mean, data["persson"], strict=True)),
        ),
    ]


def table(data: Data) -> Table:
    """Areas in per cent, with their spread over seeds."""
    mean, law = data["area"].mean(axis=0), _law()
    spread = data["area"].std(axis=0)
    columns = (LOADS, 100 * mean, 100 * spread, 100 * law)
    rows = [tuple(map(float, row)) for row in zip(*columns, strict=True)]
    return Table(("p/(E* g)", "area [%]", "spread of seeds", "quoted law [%]"), rows)


if __name__ == "__main__":
    run_page(__file__)
