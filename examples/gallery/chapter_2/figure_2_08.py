"""Fig. 2.8: heights of the three surfaces, and what a grid can hold of them."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.analyses.heights import SurfaceHeights, surface_heights
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2.rough_contact import NM, SURFACES, UM, Rough
from contactkit.plot import gallery as plot
from contactkit.plot.roughness import height_map
from contactkit.roughness.statistics import surface_statistics

PAGE = Page(
    name="2.8",
    title="Three rough surfaces",
    claim="Gaussian surfaces with an exponential autocorrelation, on 20 x 20 um2: rms height 1 nm "
    "with beta* of 0.5 um, 10 nm with 0.5 um, and 1 nm with 0.05 um.",
    verdict="Heights and lengths are as stated. beta* is the length to a tenth, not the decay "
    "length. The rms slope is no property of the surface: it grows as the shortest wave "
    "falls. With a beta* of 0.05 um the surface is white noise on 256 pixels.",
    choices="Shortest wave: two pixels in the pictures, as in the source; eight in all that "
    "follows.",
    grid="1024 x 1024 pixels on 20 um",
    seeds="1 to 5; pictures are a corner of 5 um of seed 1",
)
WINDOW = ck.Window(width=20.0 * UM)


def made(surface: Rough, pixels: int, shortest: float, seed: int) -> SurfaceHeights:
    """Heights on a grid; `shortest` wave in pixels."""
    rough = ck.GaussianRoughness(
        rms=surface.rms,
        correlation_length=surface.length,
        cutoff=shortest * WINDOW.width / pixels if WINDOW.width else 0.0,
        seed=seed,
    )
    return surface_heights(rough, WINDOW, ck.Accuracy(grid=pixels))


def correlation(found: SurfaceHeights) -> np.ndarray:
    """Autocorrelation along x over that at no distance, from the power spectrum."""
    power = np.abs(np.fft.fft(found.heights, axis=1)) ** 2
    whole: np.ndarray = np.fft.ifft(power.mean(axis=0)).real
    whole /= whole[0]
    return whole


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Maps, autocorrelations and rms slopes."""
    pixels, seeds = (512, (1, 2)) if draft else (1024, (1, 2, 3, 4, 5))
    maps, lengths, rms = [], [], []
    for surface in SURFACES:
        runs = [made(surface, pixels, 2.0, seed) for seed in seeds]
        maps.append(runs[0].heights[: pixels // 4, : pixels // 4].astype(np.float32))
        lengths.append([correlation(run)[: pixels // 8] for run in runs])
        rms.append([run.heights.std() for run in runs])
    grids = [n for n in (128, 256, 512, 1024) if n <= pixels]
    slopes = [
        [
            surface_statistics(made(s, n, 8.0, 1).heights, 20.0 * UM / n, periodic=True).rms_slope
            for n in grids
        ]
        for s in SURFACES
    ]
    return {
        "maps": np.array(maps),
        "distance": np.arange(pixels // 8) * 20.0 * UM / pixels,
        "correlation": np.array(lengths),
        "rms": np.array(rms),
        "grids": np.array(grids),
        "slopes": np.array(slopes),
    }


def draw(data: Data) -> plot.Figure:
    """Maps above; autocorrelation and slope below."""
    figure, axes = plot.figure(2, 3, size=(8.4, 5.4))
    for ax, heights, surface in zip(axes[0], data["maps"], SURFACES, strict=True):
        pixel = 5.0 * UM / len(heights)
        height_map(SurfaceHeights(heights, (pixel, pixel), True), ax, 4.0 * surface.rms)
        ax.set_title(str(surface), fontsize=8, loc="left")
    acf, slope, note = axes[1]
    x = data["distance"] / UM
    for i, (runs, surface) in enumerate(zip(data["correlation"], SURFACES, strict=True)):
        if i != 1:  # that of 10 nm is that of 1 nm
            plot.band(acf, x, runs, i, rf"$\beta^*$ = {surface.length / UM:g} um", marker="")
        slope.plot(data["grids"], data["slopes"][i], label=str(surface), **plot.series(i))
    acf.axhline(0.1, color="0.5", lw=0.8)
    acf.set(xlim=(0.0, 1.0), xlabel="distance [um]", ylabel="autocorrelation [-]")
    acf.legend(fontsize=8)
    slope.set(xscale="log", yscale="log", xlabel="pixels along a side", ylabel="rms slope [-]")
    slope.set_xticks(data["grids"], [str(n) for n in data["grids"]])
    slope.minorticks_off()
    note.axis("off")
    note.legend(*slope.get_legend_handles_labels(), loc="center left", fontsize=8)
    slope.set_title("shortest wave of 8 pixels", fontsize=9, loc="left")
    return figure


def check(data: Data) -> list[Check]:
    """Heights, lengths, slopes."""
    off = np.abs(data["rms"] / np.array([[s.rms] for s in SURFACES]) - 1.0).max()
    at = int(np.argmin(np.abs(data["distance"] - 0.5 * UM)))
    tenth = data["correlation"][0][:, at]
    grow = data["slopes"][:, 1:] / data["slopes"][:, :-1]
    next_pixel = np.exp(-2.3 * (20.0 / 256) / 0.05)
    return [
        Check(
            "rms heights are those stated, to 5 %", bool(off < 0.05), f"off by {100 * off:.1f} %"
        ),
        Check(
            "the autocorrelation at beta* = 0.5 um is a tenth, to 0.05, for each seed",
            bool((np.abs(tenth - 0.1) < 0.05).all()),
            ", ".join(f"{v:.3f}" for v in tenth),
        ),
        Check(
            "the rms slope grows with every finer grid, by 1.2 at least",
            bool((grow > 1.2).all()),
            "from " + ", ".join(f"{s[0]:.3f} to {s[-1]:.3f}" for s in data["slopes"]),
        ),
        Check(
            "on 256 pixels of 78 nm neighbours of the third surface are not correlated",
            bool(next_pixel < 0.05),
            f"autocorrelation at one pixel {next_pixel:.3f}",
        ),
    ]


def table(data: Data) -> Table:
    """Slopes over the grid."""
    rows = [
        (s.rms / NM, s.length / UM, *map(float, slopes))
        for s, slopes in zip(SURFACES, data["slopes"], strict=True)
    ]
    head = ("rms [nm]", "beta* [um]", *(f"rms slope, {n} pixels" for n in data["grids"]))
    return Table(head, rows)


if __name__ == "__main__":
    run_page(__file__)
