"""Rough contacts of chapter 2 with the numbers of the captions, solved by the second method.

Moduli, hardness, tension and angles stand here once more, as the captions have them: a page that
gives its own solver another one disagrees with what is computed here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contactkit.app.gallery.page import Check
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.second_method import contact, layers

__all__ = ["Case", "Solved", "agree", "hardness_of_layers", "pressed", "pressed_layers"]

Array = NDArray[Any]
E3, NU, H3 = 100e9, 0.3, 5e9  # of the substrate [Pa], [-], [Pa]
MODULI = {  # of the layers over E3
    "I": (1.0, 1.0),
    "II": (0.5, 0.5),
    "III": (2.0, 2.0),
    "IV": (1.0, 0.5),
    "V": (1.0, 2.0),
}
SURFACES = ((1e-9, 0.5e-6), (10e-9, 0.5e-6), (1e-9, 0.05e-6))  # rms height and beta* [m]
TENSION, ANGLE = 0.07275, math.pi / 3.0  # water [N/m], both contact angles [rad]


class Case(NamedTuple):
    """A contact of a caption: mean pressure over E3, structure, thickness of a layer [m], ..."""

    load: float
    structure: str = "I"
    thickness: float = 10e-9
    surface: int = 0
    hardness: float = H3  # [Pa]


class Solved(NamedTuple):
    """A contact by the second method."""

    pressure: Array
    gap: Array
    displacement: Array
    sampling: rough.Sampling
    solid: layers.Layers

    @property
    def max_pressure(self) -> float:
        """Largest pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def fraction(self) -> float:
        """Area of contact over that of the window."""
        return float((self.pressure > 0.0).mean())

    @property
    def max_displacement(self) -> float:
        """Largest displacement against its mean [m]."""
        return float(self.displacement.max())

    def plastic_fraction(self, hardness: float = H3) -> float:
        """Area at a hardness [Pa] over that of the window."""
        return float((self.pressure >= hardness * (1.0 - 1e-9)).mean())

    def film_force(self, film: float = 1e-9) -> float:
        """Laplace pressure times the area out of contact with a gap below that of a film [N]."""
        wet = (self.pressure <= 0.0) & (self.gap <= film)
        area = float(wet.mean()) * self.sampling.width**2
        return TENSION * 2.0 * math.cos(ANGLE) / film * area

    def stress(self, depths: Iterable[float], friction: float = 0.0) -> list[float]:
        """Largest von Mises stress, tension and s_xz [Pa], each on the plane of its depth [m]."""
        found = []
        for k, depth in enumerate(depths):
            sides = (
                (1.0,)
                if depth <= 0.0 or self.solid.moduli[0] == self.solid.moduli[1]
                else (-1.0, 1.0)
            )
            planes = [
                layers.stress(
                    self.pressure, self.sampling.width, self.solid, float(depth), friction, side
                )
                for side in sides
            ]
            found.append(max(layers.maxima(plane)[k] for plane in planes))
        return found


@lru_cache(maxsize=16)  # pages ask again; 6 MB each on 512 x 512 pixels
def pressed(sampling: rough.Sampling, case: Case, more: float = 0.0) -> Solved:
    """Solve a case on the surface of the first seed; `more` [Pa] is added to its load."""
    rms, length = SURFACES[case.surface]
    kind, body = rough.Rough(rms, length), rough.body((1.0, 1.0), (1.0, 1.0), case.thickness)
    heights = np.asarray(rough.plan(kind, body, sampling, sampling.seeds[0]).heights)
    moduli = tuple(E3 * ratio for ratio in (*MODULI[case.structure], 1.0))
    solid = layers.Layers(moduli, NU, (case.thickness, case.thickness))
    symbol = layers.compliance(sampling.pixels, sampling.width, solid)
    mean = case.load * E3 + more
    p, gap = contact.pressed(heights, symbol, mean, case.hardness)
    moved = np.fft.ifft2(symbol * np.fft.fft2(p)).real
    return Solved(p, gap, moved, sampling, solid)


def hardness_of_layers(displacement: float, thickness: float, is_inner: bool = False) -> float:
    """Hardness [Pa] at a displacement [m] where both layers, or the inner one, are half as hard.

    Eq. (2.41) for each interface from 0.3 of its depth on, written out for ratios of 2 and 1/2; an
    upper interface has no less weight above it than a lower one (structures II' and IV').
    """
    outer, inner = (max(displacement / depth - 0.3, 0.0) for depth in (thickness, 2.0 * thickness))
    soft = math.exp(-0.5 * inner**1.8)
    if not is_inner:
        return H3 * (1.0 - 0.5 * soft)
    top = math.exp(-(2.0**0.1) * outer**1.1)
    return H3 * (1.0 + 0.5 * top - 0.5 * max(soft, top))


def pressed_layers(
    sampling: rough.Sampling, load: float, thickness: float, is_inner: bool = False
) -> tuple[float, Solved]:
    """Hardness [Pa] and contact of structure II' or, with `is_inner`, IV' under a load over E3.

    The displacement hardly depends on the hardness: two steps from that of I' give the hardness to
    0.3 % at 4e-3 E3, and better at lower loads.
    """
    found, hardness = pressed(sampling, Case(load, thickness=thickness)), H3
    for _ in range(2):
        hardness = hardness_of_layers(found.max_displacement, thickness, is_inner)
        found = pressed(sampling, Case(load, thickness=thickness, hardness=hardness))
    return hardness, found


def agree(what: str, ours: Any, second: Any, within: float = 0.01) -> Check:
    """Check that numbers of a page are those of the second method."""
    one, two = np.ravel(np.asarray(ours, float)), np.ravel(np.asarray(second, float))
    off = float(np.abs(one / two - 1.0).max())
    return Check(
        f"{what}: as by a second method, to {100.0 * within:g} %",
        bool(off < within),
        f"largest difference {100.0 * off:.1e} %",
    )
