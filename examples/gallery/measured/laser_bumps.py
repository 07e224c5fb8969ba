"""Stiction of a slider on laser bumps over the real area of contact: what Gui et al. measured."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import gallery as plot

PAGE = Page(
    name="laser-bumps",
    title="Stiction on laser bumps has a minimum over the real area",
    claim="Gui, Kuo, Marchon and Rauch (IEEE Trans. Magn. 32, 1996, 932; abstract read), on "
    "disks with regular laser bumps: stiction over the real area of contact has a "
    "minimum, as the model of Gui and Marchon (1995) foretold.",
    verdict="Met in kind: many bumps each carry a meniscus of 1.2 to 2 times 4 pi R gamma, so "
    "that stiction falls with their number; few are pressed in until the liquid spans the "
    "gap between them and pulls on the whole area. The least stiction is where it is "
    "about to: a meniscus force of 0.64, 0.24 and 0.10 times the load for bumps of 8, 10 "
    "and 14 nm, 27 times beyond. It is a corner, not a smooth minimum, and the flooded "
    "slider presses the bumps flat. The closed form of Maugis foretells forces to 3 %.",
    choices="All numbers are ours: R = 200 um, heights of 8, 10 and 14 nm, E* = 100 GPa, 300 kPa "
    "on the face of the slider, gamma = 24 mN/m, 0 degrees, gaps below 6 nm wet. One bump "
    "in a periodic cell. Second method: the sphere of Maugis (1992).",
    grid="cells of 8 to 80 um, pixels of 0.1 um to 16 um and of 0.2 um beyond",
)
MODULUS, RADIUS, HEIGHTS = 1e11, 200e-6, (8e-9, 10e-9, 14e-9)  # [Pa], [m]
LOAD, GAMMA, WET = 300e3, 0.024, 6e-9  # [Pa], [N/m], [m]
SPACINGS = tuple(1e-6 * s for s in (8, 10, 12, 14, 16, 20, 24, 28, 32, 36, 40, 46, 54, 64, 80))
TALL = tuple(1e-9 * h for h in (7, 8, 9, 10, 11, 12, 14, 16, 20))  # heights at the spacings AT
AT = (20e-6, 36e-6)
CAPTION = (1e11, 200e-6, 300e3, 0.024, 6e-9)  # E*, R, load, gamma and gap of the second method


def _cell(spacing: float, height: float, pixel: float) -> Any:
    """Heights of a cap in the middle of its cell [m]."""
    n = 2 * round(0.5 * spacing / pixel)
    axis = (np.arange(n) - n // 2) * (spacing / n)
    return np.maximum(height - (axis[:, None] ** 2 + axis**2) / (2.0 * RADIUS), 0.0)


def _solved(spacing: float, height: float, pixel: float = 0.0) -> list[float]:
    """Fraction in contact, meniscus force over load, gap at the corner of the cell [m]."""
    heights = _cell(spacing, height, pixel or (0.1e-6 if spacing < 17e-6 else 0.2e-6))
    law = ck.DugdaleAttraction.from_meniscus(
        surface_tension=GAMMA, contact_angle_lower=0.0, contact_angle_upper=0.0, height=WET
    )
    solid = ck.Material(young_modulus=0.75 * MODULUS, poisson_ratio=0.5)
    bump = ck.Heights(heights=heights, pixel_size=spacing / heights.shape[0])
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=bump)),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=LOAD),
        effects=(ck.LayeredHalfSpace(), ck.Adhesion(law=law)),
    )
    result = ck.solve(ck.plan(scene))
    area = result.corrected_contact_area / spacing**2
    pull = float(result.of(ck.Adhesion).tension.mean())
    return [area, pull / LOAD, float(result.gap[0, 0])]


def _maugis(spacing: float, height: float) -> list[float]:
    """The same of one bump by Maugis and Dugdale, under its part of the load."""
    modulus, radius, load, gamma, wet = CAPTION
    tension = 2.0 * gamma / wet
    force = load * spacing**2

    def opening(m: float, a: float) -> float:
        """Gap at the edge of the liquid, m contact radii a off, less that of the liquid."""
        root, angle = math.sqrt(m * m - 1.0), math.acos(1.0 / m)
        dry = a * a / (math.pi * radius) * (root + (m * m - 2.0) * angle)
        return dry + 4.0 * tension * a / (math.pi * modulus) * (root * angle - m + 1.0) - wet

    def edge(a: float) -> float:
        return float(brentq(opening, 1.0, 1e3, (a,)))

    def excess(a: float) -> float:
        m = edge(a)
        pull = 2.0 * tension * a * a * (math.sqrt(m * m - 1.0) + m * m * math.acos(1.0 / m))
        return 4.0 * modulus * a**3 / (3.0 * radius) - pull - force

    a = float(brentq(excess, 1e-3 * radius, 1e-1 * radius))
    m = edge(a)
    pull = tension * math.pi * (m * a) ** 2 / force
    sunk = a * a / radius - 2.0 * tension * a * math.sqrt(m * m - 1.0) / modulus
    return [math.pi * (a / spacing) ** 2, pull, height - sunk]


def _edge(height: float) -> float:
    """Spacing [m] at which bumps have sunk by their height less the wet gap."""
    return float(
        brentq(lambda s: _maugis(s, height)[2] - CAPTION[4], SPACINGS[0], 2.0 * SPACINGS[-1])
    )


def compute(draft: bool = False) -> dict[str, Any]:
    """States over spacing and height, by both methods."""
    spacings = np.array(SPACINGS[4::2] if draft else SPACINGS)
    heights = HEIGHTS[1:2] if draft else HEIGHTS
    found: dict[str, Any] = {"spacings": spacings, "heights": np.array(heights)}
    with warnings.catch_warnings():
        # Flooded cells are in contact but for few pixels.
        warnings.simplefilter("ignore", ck.ValidityWarning)
        found["states"] = np.array([[_solved(float(s), h) for s in spacings] for h in heights])
        found["maugis"] = np.array([[_maugis(float(s), h) for s in spacings] for h in heights])
        found["edges"] = np.array([_edge(h) for h in heights])
        found["fine"] = np.array([_solved(s, HEIGHTS[1], 0.1e-6) for s in AT])
        found["tall"] = np.array(
            [[_solved(s, h)[1] for h in (TALL[::4] if draft else TALL)] for s in AT]
        )
    return found


def _is_flooded(data: Data) -> NDArray[np.bool_]:
    return np.asarray(data["states"][:, :, 1] > 10.0)


def draw(data: Data) -> plot.Figure:
    """Stiction over the real area, the density and the height of the bumps."""
    figure, (area, number, tall) = plot.figure(1, 3, size=(14.0, 4.4))
    density = 1e-6 / data["spacings"] ** 2
    flooded = _is_flooded(data)
    for i, height in enumerate(data["heights"]):
        state, label = data["states"][i], f"{1e9 * height:g} nm"
        before = np.where(flooded[i], data["maugis"][i][:, 0], state[:, 0])
        area.loglog(100.0 * before, state[:, 1], **plot.series(i), label=label)
        number.loglog(density, state[:, 1], **plot.series(i), label=label)
        number.axvline(1e-6 / data["edges"][i] ** 2, ls=":", lw=0.8, color=plot.series(i)["color"])
    maugis = data["maugis"][0]
    area.loglog(
        100.0 * maugis[:, 0], maugis[:, 1], "--", color="0.4", lw=1.0, label="Maugis, none flooded"
    )
    area.annotate("flooded", (0.11, 32.0), fontsize=8, color="0.3")
    area.set_xticks([0.1, 0.2, 0.5, 1.0], ["0.1", "0.2", "0.5", "1"])
    densities = (200, 500, 1000, 2000, 5000, 10000)
    number.set_xticks(densities, [str(one) for one in densities])
    for ax in (area, number):
        ax.xaxis.set_minor_formatter("")
    area.set(
        xlabel="real area of contact of the bumps [%]",
        ylabel="meniscus force/load [-]",
        ylim=(0.05, 60.0),
    )
    area.legend(fontsize=8, loc="upper right")
    number.set(xlabel="bumps per mm²", ylabel="meniscus force/load [-]", ylim=(0.05, 60.0))
    number.legend(fontsize=8, loc="upper right")
    heights = TALL if data["tall"].shape[1] == len(TALL) else TALL[::4]
    for i, (spacing, row) in enumerate(zip(AT, data["tall"], strict=True)):
        name = f"{1e6 * spacing:g} um apart"
        tall.semilogy(1e9 * np.array(heights), row, **plot.series(i), label=name)
    tall.set(xlabel="height of the bumps [nm]", ylabel="meniscus force/load [-]", ylim=(0.05, 60.0))
    tall.legend(fontsize=8)
    titles = ("over the real area, before flooding", "over the density; dotted, by Maugis")
    plot.letters((area, number, tall), (*titles, "over the height"))
    return figure


def check(data: Data) -> list[Check]:
    """The minimum, where it is, and both of its sides."""
    return [*_minimum(data), *_sides(data)]


def _minimum(data: Data) -> list[Check]:
    flooded, pulls = _is_flooded(data), data["states"][:, :, 1]
    least = pulls.argmin(axis=1)
    found = [(data["states"][i, k], data["spacings"][k]) for i, k in enumerate(least)]
    inside = (least > 0) & (least < pulls.shape[1] - 1)
    first = flooded.argmax(axis=1)
    brackets = [(data["spacings"][k - 1], data["spacings"][k]) for k in first]
    return [
        Check(
            "stiction is least at a density between the most and the fewest bumps",
            bool(np.all(inside)),
            "; ".join(
                f"{1e9 * h:g} nm: force {state[1]:.3f} of the load at {1e6 * s:.0f} um, "
                f"{100.0 * state[0]:.3f} % of the area"
                for h, (state, s) in zip(data["heights"], found, strict=True)
            ),
        ),
        Check(
            "it is the last state before the liquid floods the cell",
            bool(np.all(least == first - 1)),
            ", ".join(f"{pulls[i, k]:.1f} times the load" for i, k in enumerate(first)) + " after",
        ),
        Check(
            "which happens at the spacing where Maugis' bumps have sunk to the wet gap",
            bool(
                all(
                    low < edge < high
                    for edge, (low, high) in zip(data["edges"], brackets, strict=True)
                )
            ),
            "; ".join(
                f"{1e6 * edge:.1f} in {1e6 * low:.0f} to {1e6 * high:.0f} um"
                for edge, (low, high) in zip(data["edges"], brackets, strict=True)
            ),
        ),
    ]


def _sides(data: Data) -> list[Check]:
    flooded = _is_flooded(data)
    pulls, maugis = data["states"][:, :, 1], data["maugis"][:, :, 1]
    wide = ~flooded & (data["spacings"] >= 15e-6)
    off = np.abs(pulls / maugis - 1.0)[wide].max()
    _, radius, load, gamma, wet = CAPTION
    bumps = (pulls * load * data["spacings"] ** 2 / (4.0 * math.pi * radius * gamma))[~flooded]
    whole = 2.0 * gamma / wet / load
    short, far = data["tall"]
    return [
        Check(
            "forces of separate bumps are those of Maugis' sphere to 3 %",
            bool(off < 0.03),
            f"at most {100.0 * off:.1f} % from 16 um on; a bump pulls with {bumps.min():.2f} to "
            f"{bumps.max():.2f} times 4 pi R gamma",
        ),
        agree(
            "area and force at 20 um, pixels of 0.1 um",
            data["fine"][0][:2],
            _maugis(AT[0], HEIGHTS[1])[:2],
        ),
        Check(
            "a flooded cell is pulled by the Laplace pressure on its whole area",
            bool(np.all(np.abs(pulls[flooded] / whole - 1.0) < 0.01)),
            f"{pulls[flooded].min():.2f} to {pulls[flooded].max():.2f} for {whole:.2f} times",
        ),
        Check(
            "over the height: flooded below, and nearly constant above, at any spacing",
            bool(short[0] > 10.0 and far[0] > 10.0 and np.ptp(short[-2:]) < 0.02 * short[-1]),
            ", ".join(f"{x:.3g}" for x in short) + "; " + ", ".join(f"{x:.3g}" for x in far),
        ),
    ]


def table(data: Data) -> Table:
    """States over the spacing of bumps of one height."""
    i = len(data["heights"]) // 2
    rows = [
        (
            float(1e6 * s),
            float(1e-6 / s**2),
            float(100.0 * state[0]),
            float(state[1]),
            float(maugis[1]),
            float(1e9 * state[2]),
        )
        for s, state, maugis in zip(
            data["spacings"], data["states"][i], data["maugis"][i], strict=True
        )
    ]
    names = ("spacing [um]", "bumps/mm2", "area [%]", "force/load", "by Maugis", "gap between [nm]")
    return Table(names, rows)


if __name__ == "__main__":
    run_page(__file__)
