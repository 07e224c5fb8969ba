"""Plausible sizes of a contact: numbers that a mistaken unit puts out of their range.

A mistaken prefix is a factor of a thousand or more. Each bound lies well beyond what is built or
measured, so that it is passed by a slip of a unit and hardly by a contact.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..validity import ValidityNumber
from .effects.base import Attraction, SolvedContact
from .effects.elasticity import contact_modulus
from .solver.optimality import ROUNDED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["FLATTEST", "LIGHTEST_PEAK", "check_sizes", "is_even"]

FLATTEST = 1e-6
"""Rms slope [-]: optical flats and lenses under a light load have ten times as much."""
LIGHTEST_PEAK = 1e-6
"""Peak pressure over E* [-]: that of a ball is 2/pi times contact radius over radius."""
_LIGHTEST = 1e-9  # mean pressure over E* [-]: 200 Pa on steel, the weight of a plate of 3 mm
_SOFTEST, _STIFFEST = 1e3, 2e12  # Young's modulus [Pa]: gelatine, twice diamond
_NARROWEST, _WIDEST = 1e-9, 1.0  # side of the window [m]: some atoms, a machine's face


def is_even(heights: Map) -> bool:
    """Whether heights (ny, nx) [m] are a plane parallel to that of contact, but for round-off."""
    highest, lowest = float(heights.max()), float(heights.min())  # without a map of sizes
    return highest - lowest <= ROUNDED * max(highest, -lowest)


def check_sizes(contact: SolvedContact, *, even: bool) -> tuple[ValidityNumber, ...]:
    """Evaluate the sizes of a solved contact that its slope and peak pressure do not show.

    Parameters
    ----------
    contact : SolvedContact
        The solved contact.
    even : bool
        Whether the heights of both bodies together are even; see `is_even`.
    """
    found = [_modulus(contact), _window(contact)]
    loading = contact.scene.loading
    is_pressed = loading.imposed_approach is None and float(contact.pressure.sum()) > 0.0
    # A load on an isolated window is one over no area, and even faces may rest on each other.
    pulled = contact.scene.effect(Attraction) is not None
    if is_pressed and contact.grid.edges and not pulled and not even:
        found.append(_mean_pressure(contact))
    return tuple(found)


def _modulus(contact: SolvedContact) -> ValidityNumber:
    materials = [m for stack in contact.scene.interface.stacks for m in stack.materials]
    moduli = [(value, material.name) for material in materials for value in material.young_moduli]
    softest, stiffest = min(moduli), max(moduli)
    value, name = stiffest if stiffest[0] > _STIFFEST else softest
    return ValidityNumber(
        name="Young's modulus [Pa]",
        value=value,
        low=_SOFTEST,
        high=_STIFFEST,
        detail=f"of {name!r}; from gelatine to twice that of diamond; check its unit: 210 GPa "
        "are 210e9 Pa",
    )


def _window(contact: SolvedContact) -> ValidityNumber:
    sides = [n * d for n, d in zip(contact.grid.shape, contact.grid.pixel_size, strict=True)]
    pixel = max(contact.grid.pixel_size)
    return ValidityNumber(
        name="side of the window [m]",
        value=max(sides) if max(sides) > _WIDEST else min(sides),
        low=_NARROWEST,
        high=_WIDEST,
        detail=f"its pixels are {pixel:.3g} m; from some atoms to the face of a machine; check the "
        "unit of the window or the pixel size: 1 um is 1e-6 m",
    )


def _mean_pressure(contact: SolvedContact) -> ValidityNumber:
    modulus, mean = contact_modulus(contact.scene), float(contact.pressure.mean())
    return ValidityNumber(
        name="mean pressure over E*",
        value=mean / modulus,
        low=_LIGHTEST,
        detail=f"{mean:.3g} Pa on E* = {modulus:.3g} Pa is less than a thin plate weighs; check "
        "the unit of the load: 1 MPa is 1e6 Pa",
    )
