"""Rigid plane on a rough body with two layers: surfaces, structures and loads of chapter 2.

The source prints neither grid, nor seeds, nor the shortest wave, without which an exponential
autocorrelation has no finite slope. Here the shortest wave is eight pixels long.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

import contactkit as ck
from contactkit.contact.effects.base import ContactEffect

MODULUS, POISSON = 100e9, 0.3  # of the substrate, E3
HARDNESS = 0.05 * MODULUS  # of the substrate, H3
NM, UM = 1e-9, 1e-6
STRUCTURES: Mapping[str, tuple[float, float]] = {  # of both layers over that of the substrate
    "I": (1.0, 1.0),
    "II": (0.5, 0.5),
    "III": (2.0, 2.0),
    "IV": (1.0, 0.5),
    "V": (1.0, 2.0),
}
MEANING = {
    "I": "homogeneous",
    "II": "compliant layers",
    "III": "stiff layers",
    "IV": "compliant interlayer",
    "V": "stiff interlayer",
}
HARD_MEANING = {
    "I": "homogeneous",
    "II": "soft layers",
    "III": "hard layers",
    "IV": "soft interlayer",
    "V": "hard interlayer",
}
WATER = ck.Meniscus(
    liquid=ck.Liquid(name="water", surface_tension=0.07275),
    contact_angle_lower=math.pi / 3.0,
    contact_angle_upper=math.pi / 3.0,
)


class Rough(NamedTuple):
    """A kind of surface: rms height and length beta* of its autocorrelation [m]."""

    rms: float
    length: float

    def __str__(self) -> str:
        return rf"$\sigma$ = {self.rms / NM:g} nm, $\beta^*$ = {self.length / UM:g} um"


SURFACES = (Rough(1.0 * NM, 0.5 * UM), Rough(10.0 * NM, 0.5 * UM), Rough(1.0 * NM, 0.05 * UM))


class Sampling(NamedTuple):
    """Window [m], pixels along a side, and seeds of a statistical figure."""

    width: float
    pixels: int
    seeds: tuple[int, ...]

    @property
    def shortest(self) -> float:
        """Shortest wave [m]: eight pixels."""
        return 8.0 * self.width / self.pixels


def wide(draft: bool) -> Sampling:
    """Sampling of elastic contacts: shortest wave 156 nm."""
    if draft:
        return Sampling(5.0 * UM, 256, (1, 2))
    return Sampling(10.0 * UM, 512, (1, 2, 3, 4, 5))


WIDE = "512 x 512 pixels on 10 um, a quarter of the printed window; shortest wave 156 nm = 8 pixels"


def fine(draft: bool) -> Sampling:
    """Sampling of contacts that yield: shortest wave 39 nm."""
    if draft:
        return Sampling(1.25 * UM, 256, (1, 2))
    return Sampling(2.5 * UM, 512, (1, 2, 3, 4, 5))


FINE = "512 x 512 pixels on 2.5 um; shortest wave 39 nm = 8 pixels"
SEEDS = "1 to 5: median, and a band from the least to the greatest"


def body(moduli: Sequence[float], hardness: Sequence[float], thickness: float) -> ck.Stack:
    """Stack of two layers of a thickness [m]; ratios to the substrate."""

    def material(e: float, h: float) -> ck.Material:
        return ck.Material(young_modulus=e * MODULUS, poisson_ratio=POISSON, hardness=h * HARDNESS)

    layers = tuple(
        ck.Layer(material=material(e, h), thickness=thickness)
        for e, h in zip(moduli, hardness, strict=True)
    )
    return ck.Stack(layers=layers, substrate=material(1.0, 1.0))


def plan(
    surface: Rough,
    stack: ck.Stack,
    sampling: Sampling,
    seed: int,
    *effects: ContactEffect[Any],
    rtol: float = 1e-5,
) -> ck.ContactPlan:
    """Plan of a contact under the least printed load."""
    rough = ck.GaussianRoughness(
        rms=surface.rms,
        correlation_length=surface.length,
        cutoff=sampling.shortest,
        seed=seed,
    )
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(surface=rough, solid=stack), upper=ck.Flat(), meniscus=WATER
        ),
        window=ck.Window(width=sampling.width),
        loading=ck.Pressing(pressure=4e-6 * MODULUS),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.plan(scene, ck.Accuracy(grid=sampling.pixels, rtol=rtol))


def curves(
    cases: Sequence[tuple[Rough, ck.Stack]],
    sampling: Sampling,
    loads: Sequence[float],
    columns: Sequence[str],
    *effects: ContactEffect[Any],
) -> dict[str, np.ndarray]:
    """Numbers of contacts under mean pressures over E3: arrays (cases, seeds, loads) by column."""
    found = [
        [
            ck.load_curve(
                plan(surface, stack, sampling, seed, *effects),
                pressures=[load * MODULUS for load in loads],
            )
            for seed in sampling.seeds
        ]
        for surface, stack in cases
    ]
    return {
        name: np.array([[curve.columns[name] for curve in seeds] for seeds in found])
        for name in columns
    }


def ratios(values: np.ndarray, first: int = 0) -> np.ndarray:
    """Values (cases, seeds, ...) over those of one case on the same surface."""
    over: np.ndarray = values / values[first : first + 1]
    return over


def spread(values: np.ndarray) -> str:
    """Median of several surfaces, and its range, as text."""
    return f"{np.median(values):.3g} ({values.min():.3g} to {values.max():.3g})"


def all_above(values: np.ndarray, limit: float = 1.0) -> bool:
    """Whether every value lies above a limit."""
    return bool((values > limit).all())


def all_below(values: np.ndarray, limit: float = 1.0) -> bool:
    """Whether every value lies below a limit."""
    return bool((values < limit).all())
