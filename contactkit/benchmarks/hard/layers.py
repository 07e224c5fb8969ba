"""Hard cases of layered solids: thick layers, contrasts of a million, stiff films under load."""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal, localcontext

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm, null_space

from ...contact.solver.contact_solver import ContactSolver
from ...elasticity import layered
from ..references.tables import reference
from .case import Found
from .contacts import gradient, polonsky_keer, rough, violation

__all__ = ["incompressible", "stiff_film", "thick"]

Array = NDArray[np.float64]


def transfer_matrix(
    alpha: float, young: Sequence[float], poisson: Sequence[float], thickness: Sequence[float]
) -> float:
    """Normal compliance C by products of the layers' transfer matrices (Thomson and Haskell).

    The state is (U, W, T, S): displacements along and into the solid, shear and normal stress.
    Its two solutions that decay in the substrate are carried up through each layer by the
    exponential of the layer's matrix, and combined so that the surface has no shear.
    """

    def rates(e: float, nu: float) -> Array:
        shear = 0.5 * e / (1.0 + nu)
        lame = 2.0 * shear * nu / (1.0 - 2.0 * nu)
        wide = lame + 2.0 * shear
        stiff = 4.0 * shear * (lame + shear) / wide
        return np.array(
            [
                [0.0, -alpha, 1.0 / shear, 0.0],
                [alpha * lame / wide, 0.0, 0.0, 1.0 / wide],
                [alpha**2 * stiff, 0.0, 0.0, -alpha * lame / wide],
                [0.0, 0.0, alpha, 0.0],
            ]
        )

    lowest = rates(young[-1], poisson[-1]) + alpha * np.eye(4)
    states = null_space(lowest @ lowest, rcond=1e-10)[:, :2]
    for e, nu, h in zip(young[-2::-1], poisson[-2::-1], thickness[::-1], strict=True):
        states = expm(-h * rates(e, nu)) @ states
    weights = np.array([states[2, 1], -states[2, 0]])  # no shear at the surface
    _, down, _, normal = states @ weights
    return float(-down / normal)


def thick() -> Found:
    """Both methods at the wavenumbers of the disk, in the table of 60 digits."""
    one = reference("layered")["stacks"]["disk_table2.1"]  # [1/nm], [1/GPa]
    alpha, _, _, exact, _ = np.array(one["rows"]).T
    elastic = one["young_modulus"], one["poisson_ratio"], one["thickness"]
    ours = layered.compliance(alpha, *elastic).C
    with np.errstate(all="ignore"):
        naive = np.array([_or_nan(float(a), *elastic) for a in alpha])
    good = np.abs(naive / exact - 1.0) < 1e-2  # not so where it is not a number
    shortest = 2e3 * math.pi / alpha[good].max()  # the table is in nanometres
    return Found(
        None,
        f"overflow at {alpha.size - int(good.sum())} of {alpha.size} wavenumbers: of waves of "
        f"{shortest / 1e3:.2g} nm and longer alone there is a number",
        float(np.abs(ours / exact - 1.0).max()),
        f"all {alpha.size} wavenumbers",
    )


def _or_nan(alpha: float, *elastic: Sequence[float]) -> float:
    try:
        return transfer_matrix(alpha, *elastic)
    except (ValueError, np.linalg.LinAlgError, OverflowError):
        return math.nan


def incompressible() -> Found:
    """A rubber film on a rigid base under a wave far longer than it is thick."""
    x = 1e-8  # wavenumber times thickness, E = h = 1
    front = 2.0 * (1.0 - 0.25) / x
    naive = front * (math.sinh(2.0 * x) - 2.0 * x) / (math.cosh(2.0 * x) + 2.0 * x * x + 1.0)
    ours = float(layered.compliance([x], [1.0], [0.5], [1.0], "bonded").C[0])
    with localcontext(prec=60):
        two = 2 * Decimal(x)
        odd = two**3 / 6 + two**5 / 120 + two**7 / 5040
        even = 2 + two**2 / 2 + two**4 / 24 + two**2 / 2
        exact = float(Decimal("1.5") / Decimal(x) * odd / even)
    return Found(
        abs(naive / exact - 1.0),
        f"{naive:.3g} h/E",
        abs(ours / exact - 1.0),
        f"{ours:.3g} h/E",
    )


def stiff_film() -> Found:
    """A film a thousand times as stiff as its ground, pressed on roughness."""
    n, contrast, thickness, mean = 64, 1e3, 0.01, 0.02
    heights = rough(n)
    elastic = 0.91 * np.array([contrast, 1.0]), [0.3, 0.3], [thickness]

    def make(shape: tuple[int, int], pixel: tuple[float, float]) -> Array:
        return layered.normal_symbol(shape, pixel, *elastic)

    symbol = make((n, n), (1.0 / n, 1.0 / n))
    pressure = gradient(heights, symbol, mean, 2000)
    _, standard = polonsky_keer(heights, symbol, mean, 2000)
    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), make, periodic=True, fast=False)
    ours = solver.solve(heights, mean_pressure=mean)
    return Found(
        violation(pressure, heights, symbol, mean),
        f"stopped after 2000 convolutions (Polonsky and Keer's gradients take {standard})",
        violation(ours.pressure, heights, symbol, mean),
        f"{ours.n_applications} convolutions",
    )
