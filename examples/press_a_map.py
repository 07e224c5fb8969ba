"""A measured map pressed on coated steel: contact area with and without the coating.

The map is generated here in the form of an instrument: heights in an array, and the pixel size. A
stiff coating thinner than the waves of the roughness cannot spread the load, a thicker one does.
Coatings thinner than a pixel of the map, 20 nm, are warned about.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import contactkit as ck
from contactkit.plot import contact as contact_plot
from contactkit.plot import style as plot
from contactkit.units import GPa, nm, um

PIXELS, PIXEL = 128, 20 * nm
STEEL = ck.load_material("bearing-steel")
COATING = ck.load_material("dlc-hard")
PRESSURE = 0.2 * GPa


def measured() -> np.ndarray:
    """Heights [m] of a rough face, peaks up: waves of 2.56 um down to 160 nm, rms 2 nm."""
    rng = np.random.default_rng(5)
    heights = np.zeros((PIXELS, PIXELS))
    y, x = np.mgrid[:PIXELS, :PIXELS] / PIXELS
    for ky in range(17):
        for kx in range(-16, 17):
            k = np.hypot(ky, kx)
            if 1.0 <= k <= 16.0:
                phase = rng.uniform(0.0, 2.0 * np.pi)
                heights += k**-1.8 * np.cos(2.0 * np.pi * (ky * y + kx * x) + phase)
    return heights * (2 * nm / heights.std())


def coated(thickness: float) -> ck.Stack:
    """Steel under a hard coating."""
    return ck.Stack(layers=(ck.Layer(material=COATING, thickness=thickness),), substrate=STEEL)


def main(out: Path) -> float:
    """Draw contact over thickness; return the maximum relative error of the two limits [-].

    A coating of zero thickness has the contact of steel, an infinite one that of the coating.
    """
    heights = measured()
    thicknesses = [4 * nm * 2.0**i for i in range(10)]
    found = [ck.press(heights, PIXEL, coated(h), PRESSURE) for h in thicknesses]
    ends = [ck.press(heights, PIXEL, solid, PRESSURE) for solid in (STEEL, COATING)]
    figure, (left, right) = plot.figure(1, 2, size=(11.0, 4.6))
    contact_plot.pressure(found[3], left)
    plot.title(left, f"Pressure on a coating of {thicknesses[3] / nm:.0f} nm")
    contact = [100.0 * result.contact_fraction for result in found]
    right.plot([h / um for h in thicknesses], contact, "o-", label="coated steel")
    for result, style, label in zip(ends, ("--", ":"), ("steel", "coating"), strict=True):
        right.axhline(100.0 * result.contact_fraction, ls=style, color="k", lw=1.0, label=label)
    right.set(xscale="log", xlabel="thickness of the coating [um]", ylabel="contact [%]")
    plot.plain_log(right.xaxis)
    plot.title(right, "Contact at a mean pressure of 0.2 GPa")
    plot.legend(right)
    plot.letters((left, right))
    plot.save(figure, out / "press_a_map")
    thin, thick = (ck.press(heights, PIXEL, coated(h), PRESSURE) for h in (1e-3 * nm, 1e3 * um))
    pairs = zip((thin, thick), ends, strict=True)
    return max(abs(one.max_pressure / end.max_pressure - 1.0) for one, end in pairs)


if __name__ == "__main__":
    sys.stdout.write(f"limits met to {main(Path('out/examples')):.1g}\n")
