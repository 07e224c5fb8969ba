"""Printed equations of rough contact, chapter 2 and Appendix A: formula, arguments, correction.

The elasticity of chapter 2 is not among them: its errata, listed in the documentation, leave
systems of equations that have no solution.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

from .arguments import PublishedFormula as Row
from .printed import contact as printed

__all__ = ["CONTACT_ROWS"]

# Correlation lengths (of the decay to a tenth, Eq. 2.42) up to which repetitions are summed: what
# is left out is below 1e-17. The number of terms grows with its square.
_REACH = 17.0
_FIT = "1 + (H1/H2 - 1) exp(-(u/h)^m (E1/E2)^n (H1/H2)^p)"


def _fit(*given: float) -> float:
    from ..elasticity.hardness_rules import layer_on_substrate

    return float(layer_on_substrate(*given))


def _literal(n_layers: int, displacement: float, *given: float) -> float:
    """The criteria of the source, of the displacement from its datum."""
    from ..elasticity.hardness_rules import effective_hardness_literal

    *layers, datum = given
    return float(effective_hardness_literal(displacement + datum, *_split(n_layers, layers)))


def _continuous(n_layers: int, displacement: float, *given: float) -> float:
    """The rule without jumps, of the displacement from the mean of the surface."""
    from ..elasticity.hardness_rules import effective_hardness

    *layers, _ = given
    return float(effective_hardness(displacement, *_split(n_layers, layers)))


def _split(n_layers: int, given: list[float]) -> tuple[list[float], list[float], list[float]]:
    """Young's moduli, hardness and thicknesses of thicknesses, moduli and hardness in a row."""
    n = n_layers
    return given[n : 2 * n + 1], given[2 * n + 1 :], given[:n]


def _mean_displacement(mean_pressure: float, window: float, reduced_modulus: float) -> float:
    return 4.0 * math.asinh(1.0) / math.pi * mean_pressure * window / reduced_modulus


def _autocorrelation(
    rms: float, length_x: float, length_y: float, x: float, y: float, period: float
) -> float:
    """Sum over the repetitions of a window, of heights of zero mean."""
    if period == math.inf:
        return printed.autocorrelation_2_42(rms, length_x, length_y, x, y)
    x, y = math.remainder(x, period), math.remainder(y, period)
    i, j = (1 + math.ceil(_REACH * length / period) for length in (length_x, length_y))
    total = sum(
        printed.autocorrelation_2_42(1.0, length_x, length_y, abs(x + m * period), y + n * period)
        for m in range(-i, i + 1)
        for n in range(-j, j + 1)
    )
    decay_x, decay_y = length_x / 2.3 / period, length_y / 2.3 / period
    return rms * rms * (total - 2.0 * math.pi * decay_x * decay_y)


def _film_force(
    area: float, height: float, tension: float, lower: float, upper: float, _number: float
) -> float:
    from ..capillary.film_islands import film_force

    return float(film_force(area, tension, lower, upper, height))


def _of_bridges(
    area: float, height: float, tension: float, lower: float, upper: float, number: float
) -> float:
    from .corrected import meniscus_flat

    radius = math.sqrt(area / (math.pi * number))
    return number * meniscus_flat(radius, height, tension, lower, upper)


def _measure(name: str) -> Callable[..., float]:
    """A measure of stress of six components xx, yy, zz, xy, xz, yz."""

    def value(*stress: float) -> float:
        import numpy as np

        from ..elasticity.stress import measures

        function: Any = getattr(measures, name)
        return float(function(np.array(stress)))

    return value


def _in_plane(xx: float, yy: float, _zz: float, xy: float, _xz: float, _yz: float) -> float:
    return printed.in_plane_stress_a_2(xx, yy, xy)


_MODULI = ("young_modulus", "young_modulus_below")
_HARDNESS = ("hardness", "hardness_below")
_STRESS = tuple(f"stress_{ij}" for ij in ("xx", "yy", "zz", "xy", "xz", "yz"))
_RULE = "continuous rule of HardnessLimit (shift 0.3), of the displacement from the mean"

CONTACT_ROWS: tuple[Row, ...] = (
    Row(
        "2.41",
        "hardness of one layer",
        f"H2 ({_FIT})",
        ("displacement", "thickness", *_MODULI, *_HARDNESS),
        "Pa",
        lambda u, h, *materials: _fit(u, *materials, h),
        by="as printed, a fit that holds from depth zero on",
    ),
    Row(
        "2.41a",
        "effective hardness of one layer",
        "H1 for u < 0.3 h, else Eq. (2.41)",
        ("displacement", "thickness", *_MODULI, *_HARDNESS, "datum"),
        "Pa",
        partial(_literal, 1),
        partial(_continuous, 1),
        _RULE,
    ),
    Row(
        "2.41b",
        "effective hardness of two layers",
        "H1 for u < 0.3 h1, else Eq. (2.41) of H1, H2 for u < 0.3 h2, else of H2, H3",
        (
            "displacement",
            "thickness",
            "thickness_below",
            *_MODULI,
            "young_modulus_substrate",
            *_HARDNESS,
            "hardness_substrate",
            "datum",
        ),
        "Pa",
        partial(_literal, 2),
        partial(_continuous, 2),
        _RULE,
        ("2.41a", "2.41b"),
    ),
    Row(
        "zero wavenumber",
        "mean displacement of a periodic window",
        "64-point quadrature of 2/(E* alpha) over the cell at the origin, times p",
        ("mean_pressure", "window", "reduced_modulus"),
        "m",
        printed.mean_displacement_of_64_points,
        _mean_displacement,
        "mean of 2/(E* alpha) over the cell, 8 ln(1 + sqrt 2)/(2 pi) p L/E*",
    ),
    Row(
        "2.42",
        "autocorrelation of the heights",
        "sigma^2 exp(-2.3 sqrt((k/beta_x)^2 + (l/beta_y)^2))",
        (
            "rms",
            "correlation_length_x",
            "correlation_length_y",
            "offset_x",
            "offset_y",
            "period",
        ),
        "m2",
        printed.autocorrelation_2_42,
        _autocorrelation,
        "sum over the repetitions of the window, for heights of zero mean",
    ),
    Row(
        "2.43",
        "meniscus force of a film on a rough surface",
        "gamma (cos theta1 + cos theta2) A_m/h_m",
        (
            "meniscus_area",
            "meniscus_height",
            "surface_tension",
            "angle_lower",
            "angle_upper",
            "number",
        ),
        "N",
        _film_force,
        _of_bridges,
        "exact bridges of this height and area, N equal circles without contact inside",
    ),
    Row(
        "A.1",
        "stress of von Mises",
        "sqrt(J2), J2 = ((xx - yy)^2 + (yy - zz)^2 + (zz - xx)^2)/6 + xy^2 + yz^2 + xz^2",
        _STRESS,
        "Pa",
        _measure("sqrt_j2"),
        _measure("von_mises"),
        "sqrt(3 J2)",
    ),
    Row(
        "A.2",
        "principal tensile stress",
        "(xx + yy)/2 + sqrt((xx - yy)^2 + 4 xy^2)/2",
        _STRESS,
        "Pa",
        _in_plane,
        _measure("max_principal_stress"),
        "largest principal stress of the tensor",
    ),
)
"""Rows of `PUBLISHED` of chapter 2 and Appendix A."""
