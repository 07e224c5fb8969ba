"""Real area of contact over the load, beside the theories of rough contact and their ranges.

A self-affine surface, 512 x 512 pixels with 16 to the shortest wave, is pressed on a half-space
from a hundredth of area to full contact. Persson's theory is exact at full contact and 30 % low at
a hundredth, where that of Bush, Gibson and Thomas, the limit of small loads, is 10 % high.
"""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

import numpy as np

import contactkit as ck
from contactkit.analyses.area_over_load import area_over_load
from contactkit.plot import roughness as roughness_plot
from contactkit.plot import style as plot
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine
from contactkit.units import GPa, nm

PIXELS, PIXEL, SLOPE = 512, 1 * nm, 0.1
RUBBER = ck.Material(young_modulus=0.75 * GPa, poisson_ratio=0.5)  # E* = 1 GPa
LOADS = (0.004, 0.008, 0.016, 0.03, 0.06, 0.12, 0.25, 0.45, 0.7, 1.0, 1.4)  # over E* h'


def surface() -> np.ndarray:
    """Heights [m] with waves of 128 down to 16 nm and an rms slope of a tenth."""
    spectrum = SelfAffineSpectrum(0.8, 0.25 * PIXELS * PIXEL, 16 * nm)
    return self_affine(
        (PIXELS, PIXELS), (PIXEL, PIXEL), None, spectrum, 3, "sample", rms_slope=SLOPE
    )


def main(out: Path) -> float:
    """Draw area over load; return the area over that of Persson at the largest load [-]."""
    heights = surface()
    with warnings.catch_warnings():
        # The spots of the smallest load are few pixels wide, and nothing yields here.
        warnings.simplefilter("ignore", ck.ValidityWarning)
        pressed = [
            ck.press(heights, PIXEL, RUBBER, x * SLOPE * GPa, rtol=1e-6) for x in sorted(LOADS)
        ]
    found = area_over_load(pressed)
    figure, axes = plot.figure(1, 2, size=(11.0, 4.8))
    roughness_plot.area_and_theories(found, axes)
    plot.letters(axes)
    plot.save(figure, out / "area_and_theories")
    return float(found.corrected[-1] / found.theories["Persson"][-1])


if __name__ == "__main__":
    sys.stdout.write(f"area over Persson's at full contact: {main(Path('out/examples')):.4f}\n")
