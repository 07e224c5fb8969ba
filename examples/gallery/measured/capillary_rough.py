"""Rough solids pulled together by condensed water: against what Persson 2008 states."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf, ndtr

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine
from contactkit.roughness.statistics import rms_slope

PAGE = Page(
    name="capillary-rough",
    title="Rough solids pulled together by capillary bridges",
    claim="B.N.J. Persson (J. Phys.: Condens. Matter 20, 2008, 315007, arXiv:0805.0684; "
    "abstract read): with capillary bridges of a height d_K hard solids have most real "
    "contact at d_K of about 3 rms heights, soft solids at very small d_K. The work of "
    "adhesion is largest at d_K far above the rms height, and then 2 gamma cos(theta).",
    verdict="Met, as far as an abstract can be. The hardest solid has most contact at 3.1 to 3.6 "
    "rms heights; a fifth of its modulus moves that to 2.1. The work comes near 2 gamma "
    "cos(theta) slowly: 97 % of it take 100 rms heights.",
    choices="gamma = 72 mN/m, 30 degrees, rms height 1 nm, Hurst exponent 0.8, waves from a "
    "quarter of the window of 256 nm to a sixteenth, E* = 100, 20 and 1 GPa, all ours. "
    "DugdaleAttraction.from_meniscus: every gap below d_K is wet. No outer load. Heights "
    "d_K below half the rms height are left out. Statistics: p = 2 gamma cos(theta)/d_K "
    "times the wet fraction of a normal distribution of gaps.",
    grid="192 x 192 pixels, periodic; 128 x 128 for the softest",
    seeds="1 to 3",
)
GAMMA, ANGLE, RMS, WIDTH = 0.072, math.radians(30.0), 1e-9, 256e-9
WORK = 2.0 * GAMMA * math.cos(ANGLE)
MODULI = (1e11, 2e10, 1e9)  # E* [Pa]
HEIGHTS = (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 7.0, 10.0, 30.0, 100.0)  # d_K over the rms
SOFT = (0.5, 0.7, 1.0, 2.0, 3.0, 10.0, 30.0, 100.0)  # of the softest
FILLED = 30.0  # no gap of any of the solids is wider


def _solid(modulus: float) -> ck.Material:
    return ck.Material(young_modulus=0.75 * modulus, poisson_ratio=0.5)


def _surface(pixels: int, seed: int) -> Any:
    pixel = WIDTH / pixels
    spectrum = SelfAffineSpectrum(0.8, WIDTH / 4.0, WIDTH / 16.0)
    return self_affine((pixels, pixels), (pixel, pixel), RMS, spectrum, seed, "sample")


def _wet(surface: Any, modulus: float, height: float) -> tuple[float, float, float, float]:
    """Contact, share that is wet, work of adhesion over 2 gamma cos(theta), mean gap over rms."""
    law = ck.DugdaleAttraction.from_meniscus(
        surface_tension=GAMMA,
        contact_angle_lower=ANGLE,
        contact_angle_upper=ANGLE,
        height=height * RMS,
    )
    rough = ck.Heights(heights=surface, pixel_size=WIDTH / surface.shape[0])
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=_solid(modulus)), upper=ck.Body(surface=rough)),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=0.0),
        effects=(ck.LayeredHalfSpace(), ck.Adhesion(law=law)),
    )
    result = ck.solve(ck.plan(scene))
    part, area = result.of(ck.Adhesion), WIDTH**2
    work = -part.energy / area / WORK
    gap = float(result.gap.mean()) / RMS
    return part.contact_area / area, part.attracted_area / area, work, gap


def _dry(surface: Any, modulus: float, pressure: float) -> tuple[float, float, float]:
    """Contact, mean gap over rms and elastic energy over 2 gamma cos(theta), without liquid."""
    pressed = ck.press(surface, WIDTH / surface.shape[0], _solid(modulus), pressure)
    energy = 0.5 * float((pressed.pressure * pressed.displacement).mean())
    return pressed.contact_fraction, float(pressed.gap.mean()) / RMS, energy / WORK


def _flattening(surface: Any, modulus: float) -> float:
    """Elastic energy per area of a surface pressed flat over 2 gamma cos(theta)."""
    n = surface.shape[0]
    wave = 2.0 * math.pi * np.fft.fftfreq(n, WIDTH / n)
    power = np.abs(np.fft.fft2(surface) / n**2) ** 2
    return float(modulus / 4.0 * (np.hypot(wave[:, None], wave) * power).sum() / WORK)


def _by_statistics(surface: Any, heights: Any) -> Any:
    """Area of contact over the height of the liquid, of the hardest solid."""
    slope = rms_slope(surface, (WIDTH / surface.shape[0],) * 2, True)
    loads = np.geomspace(1e-3, 2.0, 7) * WORK / (3.0 * RMS)
    gaps = np.array([_dry(surface, MODULI[0], float(load))[1] for load in loads])
    fine = np.geomspace(loads[0], loads[-1], 4000)
    gap = np.interp(np.log(fine), np.log(loads), gaps)
    areas = []
    for height in heights:
        pulled = WORK / (height * RMS) * ndtr(height - gap)
        load = fine[int(np.argmax(pulled < fine))]  # the first balance from far apart
        areas.append(erf(math.sqrt(math.pi) * load / (MODULI[0] * slope)))
    return np.array(areas)


def compute(draft: bool = False) -> dict[str, Any]:
    """States of three solids over the height of the liquid, and their limits without it."""
    seeds = (1,) if draft else (1, 2, 3)
    data: dict[str, Any] = {}
    with warnings.catch_warnings():
        # The smallest spots are few pixels wide, and nothing yields here.
        warnings.simplefilter("ignore", ck.ValidityWarning)
        for i, modulus in enumerate(MODULI):
            is_soft = i == len(MODULI) - 1
            surfaces = [_surface(128 if draft or is_soft else 192, seed) for seed in seeds]
            heights = SOFT if is_soft else HEIGHTS
            states = [[_wet(one, modulus, d) for d in heights] for one in surfaces]
            limits = [_dry(one, modulus, WORK / (FILLED * RMS)) for one in surfaces]
            data |= {
                f"heights_{i}": np.array(heights),
                f"states_{i}": np.array(states),
                f"filled_{i}": np.array(limits),
                f"flat_{i}": np.array([_flattening(one, modulus) for one in surfaces]),
            }
            if i == 0:
                statistics = [_by_statistics(one, heights) for one in surfaces]
                data["statistics"] = np.array(statistics)
    return data


def _maximum(heights: Any, areas: Any) -> float:
    """Height of most contact: top of a parabola over log d_K; the first where it only falls."""
    top = int(np.argmax(areas))
    if top == 0:
        return float(heights[0])
    a, b, _ = np.polyfit(np.log(heights[top - 1 : top + 2]), areas[top - 1 : top + 2], 2)
    return math.exp(-0.5 * b / a)


def draw(data: Data) -> plot.Figure:
    """Contact and work of adhesion over the height of the liquid."""
    figure, (left, right) = plot.figure(1, 2, size=(10.0, 4.3))
    for i, modulus in enumerate(MODULI):
        heights, states = data[f"heights_{i}"], data[f"states_{i}"].mean(axis=0)
        label = f"$E^*$ = {modulus / 1e9:g} GPa"
        left.loglog(heights, states[:, 0], **plot.series(i), label=label)
        right.semilogx(heights, states[:, 2], **plot.series(i), label=label)
    statistics = data["statistics"].mean(axis=0)
    left.loglog(data["heights_0"], statistics, "--", color="0.3", lw=1.0, label="statistics")
    left.axvline(3.0, color="0.6", lw=0.8)
    left.annotate("Persson:\nabout 3", (3.15, 0.08), fontsize=8, color="0.3")
    left.set(xlabel=r"$d_K/h_{rms}$ [-]", ylabel="fraction of area in contact [-]")
    left.set_ylim(2e-4, 20.0)
    left.legend(fontsize=8, loc="upper right")
    right.axhline(1.0, color="0.6", lw=0.8)
    right.set(xlabel=r"$d_K/h_{rms}$ [-]", ylim=(0.0, 1.08))
    right.set_ylabel(r"work of adhesion/($2\gamma\,\cos\theta$) [-]")
    right.legend(fontsize=8, loc="lower right")
    plot.letters((left, right), ("real contact", "work of adhesion"))
    return figure


def check(data: Data) -> list[Check]:
    """Maxima of the contact, what statistics have, and limits of the work."""
    return [*_most_contact(data), *_compared_with_statistics(data), *_limits(data)]


def _states(data: Data) -> list[NDArray[np.float64]]:
    """States of each solid over the height of the liquid, the mean of the seeds."""
    return [data[f"states_{i}"].mean(axis=0) for i in range(len(MODULI))]


def _most_contact(data: Data) -> list[Check]:
    states = _states(data)
    tops = [_maximum(data[f"heights_{i}"], one[:, 0]) for i, one in enumerate(states)]
    hardest = [_maximum(data["heights_0"], one[:, 0]) for one in data["states_0"]]
    top = _maximum(data["heights_0"], data["statistics"].mean(axis=0))
    return [
        Check(
            "hard solids have most contact at about 3 rms heights: 2.5 to 3.5",
            bool(abs(tops[0] - 3.0) < 0.5),
            f"{tops[0]:.2f}, of seeds " + ", ".join(f"{x:.2f}" for x in hardest),
        ),
        Check(
            "statistics have it there to a tenth",
            bool(abs(top / tops[0] - 1.0) < 0.1),
            f"{top:.2f}",
        ),
        Check(
            "the softer the solids, the lower the liquid of most contact",
            bool(np.all(np.diff(tops) < 0.0) and tops[-1] < 1.0),
            ", ".join(f"{x:.2f}" for x in tops),
        ),
        Check(
            "soft solids are then in nearly complete contact",
            bool(states[-1][0, 0] > 0.95),
            f"{100 * states[-1][0, 0]:.1f} % of the area",
        ),
    ]


def _compared_with_statistics(data: Data) -> list[Check]:
    heights, each = data["heights_0"], data["states_0"]
    around = (heights >= 2.0) & (heights <= 5.0)
    share = (data["statistics"].mean(axis=0) / each.mean(axis=0)[:, 0])[around]
    normal = ndtr(heights - each[..., 3]) - each[..., 1]
    return [
        Check(
            "areas by statistics are 13 to 35 % low from 2 to 5 rms heights",
            bool(np.all((share > 0.65) & (share < 0.87))),
            ", ".join(f"{x:.2f}" for x in share),
        ),
        Check(
            "the wet share is that of a normal distribution about the mean gap to 0.03",
            bool(np.abs(normal).max() < 0.03),
            f"{np.abs(normal).max():.3f} at most",
        ),
    ]


def _limits(data: Data) -> list[Check]:
    last = len(MODULI) - 1
    soft, flat = data[f"states_{last}"][:, 0], data[f"flat_{last}"]
    drawn = soft[:, 2] - (1.0 - flat)
    off, apart = _off_when_filled(data)
    states = _states(data)
    ends = [float(one[-1, 2]) for one in states]
    return [
        Check(
            "work of complete contact is 1 less the energy that flattens all waves, E* q h^2/4, to "
            "0.01",
            bool(np.abs(drawn).max() < 0.01),
            f"{float(soft[:, 2].mean()):.4f} for {1.0 - float(flat.mean()):.4f}",
        ),
        Check(
            f"liquid that fills all gaps, d_K = {FILLED:g} rms heights, is a load of "
            "2 gamma cos(theta)/d_K on dry solids: the same contact to 0.1 %",
            bool(off < 1e-3),
            f"{100 * off:.3f} %",
        ),
        Check(
            "and the work is 1 less mean gap over d_K and elastic energy of these, to 1e-4",
            bool(apart < 1e-4),
            f"{apart:.1e}",
        ),
        Check(
            "work grows with d_K towards 2 gamma cos(theta), above 96 % at 100 rms heights",
            bool(all(np.all(np.diff(one[:, 2]) > 0.0) for one in states) and min(ends) > 0.96),
            ", ".join(f"{x:.3f}" for x in ends),
        ),
    ]


def _off_when_filled(data: Data) -> tuple[float, float]:
    """Relative error of the contact, and error of the work, where liquid fills all gaps."""
    areas, works = [], []
    for i in range(len(MODULI)):
        at = int(np.argmin(np.abs(data[f"heights_{i}"] - FILLED)))
        state, dry = data[f"states_{i}"][:, at], data[f"filled_{i}"]
        areas.append(np.abs(state[:, 0] / dry[:, 0] - 1.0).max())
        works.append(np.abs(state[:, 2] - (1.0 - dry[:, 1] / FILLED - dry[:, 2])).max())
    return float(max(areas)), float(max(works))


def table(data: Data) -> Table:
    """Contact and work of the hardest solid, and contact by statistics."""
    states = data["states_0"].mean(axis=0)
    columns = (
        data["heights_0"],
        100.0 * states[:, 0],
        100.0 * data["statistics"].mean(axis=0),
        states[:, 1],
        states[:, 2],
    )
    rows = [tuple(map(float, row)) for row in zip(*columns, strict=True)]
    names = ("d_K/h_rms", "contact [%]", "by statistics [%]", "wet share", "work/(2 gamma cos)")
    return Table(names, rows)


if __name__ == "__main__":
    run_page(__file__)
