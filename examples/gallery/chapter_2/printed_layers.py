"""Potentials of the source for two layers on a substrate, Eqs. (2.17)-(2.34), as printed or right.

One wavenumber at a time. Every erratum has a name, and every function takes the names of those
that are kept as printed; without any, the equations are right. The derivatives B,1 of the source
enter only as A + i B,1 and are set to zero.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["COMPONENTS", "Solid", "Wave", "by_elimination", "by_matching", "field", "surface"]

Array = NDArray[np.complex128]
Names = Sequence[str]
IsPrinted = Callable[[str], bool]

COMPONENTS = ("ux", "uy", "uz", "sxx", "syy", "szz", "sxy", "syz", "sxz")


class Solid(NamedTuple):
    """Shear moduli and Poisson's ratios of both layers and the substrate, thicknesses."""

    G: tuple[float, float, float]
    nu: tuple[float, float, float]
    h: tuple[float, float]


class Wave(NamedTuple):
    """Wavenumbers along x and y, and the traction along x of unit pressure."""

    xi: float
    eta: float
    friction: float

    @property
    def alpha(self) -> float:
        """Radial wavenumber."""
        return float(np.hypot(self.xi, self.eta))


def field(
    c: Array, z: float, wave: Wave, G: float, nu: float, printed: Names = ()
) -> dict[str, complex]:
    """Displacements (2.19) and stresses (2.20) of coefficients A, A-, B, B-, C, C- at a depth."""
    xi, eta, a = wave.xi, wave.eta, wave.alpha
    down, up = np.exp(-a * z), np.exp(a * z)
    sa, sb, sc = (c[i] * down + c[i + 1] * up for i in (0, 2, 4))
    da, db, dc = (c[i] * down - c[i + 1] * up for i in (0, 2, 4))
    i = 1j
    signs = {name: -1.0 if name in printed else 1.0 for name in ("u_eta", "u_z", "sxx")}
    shear = 1.0 if "syz sxz" in printed else i  # of the first terms
    lost = {n: (sb if n in printed else 0.0) for n in ("sxx", "syy", "szz")}  # "B" for "B,1"
    return {
        "ux": (i * xi * sa - 4 * (1 - nu) * sb + xi**2 * z / a * db + i * z * xi * sc) / (2 * G),
        "uy": (i * eta * sa + signs["u_eta"] * xi * eta * z / a * db + i * eta * z * sc) / (2 * G),
        "uz": (
            -a * da
            + signs["u_z"] * i * z * xi * sb
            - i * xi / a * db
            - (3 - 4 * nu) * sc
            - z * a * dc
        )
        / (2 * G),
        "sxx": -(xi**2) * sa
        + signs["sxx"] * 2 * i * (nu - 2) * xi * sb
        + i * xi**3 * z / a * db
        + 2 * a * nu * dc
        - z * xi**2 * sc
        - i * xi**2 * lost["sxx"],
        "syy": -(eta**2) * sa
        - 2 * i * nu * xi * sb
        + i * z * eta ** (3 if "syy" in printed else 2) * xi / a * db
        + 2 * a * nu * dc
        - z * eta**2 * sc
        - i * eta**2 * lost["syy"],
        "szz": a**2 * sa
        + 2 * i * (1 - nu) * xi * sb
        - i * z * a * xi * db
        + z * a**2 * sc
        + 2 * (1 - nu) * a * dc
        - i * a**2 * lost["szz"],
        "sxy": -xi * eta * sa
        - 2 * i * eta * (1 - nu) * (xi if "sxy" in printed else 1.0) * sb
        + i * xi**2 * eta * z / a * db
        - z * xi * eta * sc,
        "syz": -shear * a * eta * da
        + xi * eta * (db / a - z * sb)
        - i * eta * ((1 - 2 * nu) * sc + z * a * dc),
        "sxz": -shear * a * xi * da
        - xi**2 * z * sb
        + (2 * a * (1 - nu) + xi**2 / a) * db
        - i * xi * ((1 - 2 * nu) * sc + z * a * dc),
    }


def surface(c: Array, wave: Wave, G: float, nu: float, printed: Names = ()) -> complex:
    """Displacement uz of the surface, Eq. (2.34)."""
    both = c[4] - c[5] if "2.34" in printed else c[4] + c[5]
    a = wave.alpha
    rest = -a * (c[0] - c[1]) - 1j * wave.xi / a * (c[2] - c[3])
    return complex((rest - (3 - 4 * nu) * both) / (2 * G))


def _columns(k: int, z: float, wave: Wave, solid: Solid, names: Names) -> Array:
    """What each coefficient of body k adds to components at a depth; the substrate has three."""
    kept = (0, 1, 2, 3, 4, 5) if k < 2 else (0, 2, 4)
    unit = np.eye(6, dtype=complex)
    found = [field(unit[j], z, wave, solid.G[k], solid.nu[k]) for j in kept]
    return np.array([[one[name] for one in found] for name in names])


def by_matching(solid: Solid, wave: Wave) -> list[Array]:
    """Coefficients of the three bodies from surface and interfaces at once, 15 equations.

    Both wavenumbers must not be zero: one of the equations would be empty.
    """
    matrix, right = np.zeros((15, 15), complex), np.zeros(15, complex)
    matrix[:3, :6] = _columns(0, 0.0, wave, solid, ("szz", "sxz", "syz"))
    right[:2] = -1.0, wave.friction
    passed = ("ux", "uy", "uz", "szz", "sxz", "syz")
    for k in (0, 1):
        rows = slice(3 + 6 * k, 9 + 6 * k)
        width = 6 if k == 0 else 3
        matrix[rows, 6 * k : 6 * k + 6] = _columns(k, solid.h[k], wave, solid, passed)
        matrix[rows, 6 * k + 6 : 6 * k + 6 + width] = -_columns(k + 1, 0.0, wave, solid, passed)
    scale = np.abs(matrix).max(axis=1)
    found = np.linalg.solve(matrix / scale[:, None], right / scale)
    last = np.zeros(6, complex)
    last[[0, 2, 4]] = found[12:]
    return [found[:6], found[6:12], last]


def _friction(solid: Solid, wave: Wave, printed: Names) -> Array:
    """Coefficients B of the bodies, Eq. (2.24)."""
    G, nu, (h1, h2), a = solid.G, solid.nu, solid.h, wave.alpha
    n = [1.0 - v for v in nu]
    e1, e2 = np.exp(a * h1), np.exp(a * h2)
    third = 1.0 / e1 if "2.24 row 3" in printed else e1
    last = n[1] if "2.24 row 4" in printed else n[2]
    rows = [
        [2 * a * n[0], -2 * a * n[0], 0, 0, 0],
        [-4 * n[0] / e1 / G[0], -4 * n[0] * e1 / G[0], 4 * n[1] / G[1], 4 * n[1] / G[1], 0],
        [2 * a * n[0] / e1, -2 * a * n[0] * third, -2 * a * n[1], 2 * a * n[1], 0],
        [0, 0, -4 * n[1] / e2 / G[1], -4 * n[1] * e2 / G[1], 4 * last / G[2]],
        [0, 0, 2 * a * n[1] / e2, -2 * a * n[1] * e2, -2 * a * n[2]],
    ]
    return np.asarray(np.linalg.solve(np.array(rows, complex), [wave.friction, 0, 0, 0, 0]))


def _right_sides(solid: Solid, wave: Wave, b: Array, is_printed: IsPrinted) -> Array:
    """R1 to R10 of Appendix B."""
    (G1, G2, G3), (n1, n2, n3), (h1, h2), a, xi = *solid[:3], wave.alpha, wave.xi
    b1, c1, b2, c2, b3 = b
    lower, upper = b1 * np.exp(-a * h1), c1 * np.exp(a * h1)
    lower2, upper2 = b2 * np.exp(-a * h2), c2 * np.exp(a * h2)
    last2 = c1 * np.exp(a * h2) if is_printed("R8") else upper2
    r = np.zeros(11, complex)
    r[1] = -(1 + 2j * xi * (1 - n1) * (b1 + c1)) / a
    r[2] = (1j if is_printed("R2") else -1j) * xi / a * (b1 - c1)
    r[3] = 1j * xi * h1 / (a * G1) * (lower - upper)
    r[4] = (
        -1j * xi * ((b2 - c2) / (a * G2) + h1 * (lower + upper) / G1 - (lower - upper) / (a * G1))
    )
    r[5] = -1j * xi * ((lower - upper) / a - h1 * (lower + upper) - (b2 - c2) / a)
    r[6] = (
        1j
        * xi
        / a
        * (2 * (1 - n2) * (b2 + c2) - 2 * (1 - n1) * (lower + upper) + a * h1 * (lower - upper))
    )
    if is_printed("R6"):
        r[6] = -2j * xi / a * (1 - n2) * (b2 + c2 - lower - upper)
    r[7] = 1j * xi * h2 / (a * G2) * (lower2 - upper2)
    r[8] = -1j * xi * (b3 / (a * G3) + h2 * (lower2 + upper2) / G2 - (lower2 - last2) / (a * G2))
    r[9] = -1j * xi * ((lower2 - upper2) / a - h2 * (lower2 + upper2) - b3 / a)
    if is_printed("R9"):
        r[9] = 0.0
    r[10] = (
        1j
        * xi
        / a
        * (2 * (1 - n3) * b3 - 2 * (1 - n2) * (lower2 + upper2) + a * h2 * (lower2 - upper2))
    )
    if is_printed("R10"):
        r[10] = -r[10]
    return r


def by_elimination(solid: Solid, wave: Wave, printed: Names = ()) -> Array:
    """Coefficients of the first layer by Eqs. (2.24)-(2.31) and Appendix B.

    Parameters
    ----------
    solid, wave
        Layers, and wavenumber with the traction.
    printed : sequence of str
        Errata that are kept as printed.
    """
    is_printed = set(printed).__contains__
    b = _friction(solid, wave, printed)
    r = _right_sides(solid, wave, b, is_printed)
    shear, normal = _interface(solid, wave, r, is_printed)
    a, n1 = wave.alpha, solid.nu[0]
    factors = (1 - n1, 2 * (1 - n1)) if is_printed("2.25 row 2") else (1 - 2 * n1, 1 - 2 * n1)
    rows = [[a, a, 2 * (1 - n1), -2 * (1 - n1)], [a, -a, *factors], shear[:4], normal[:4]]
    matrix = np.array(rows, complex)
    scale = np.abs(matrix).max(axis=1)
    ends = np.array([r[1], r[2], -shear[4], -normal[4]])
    A, upper_a, C, upper_c = np.linalg.solve(matrix / scale[:, None], ends / scale)
    return np.array([A, upper_a, b[0], b[1], C, upper_c])


def _jumps(solid: Solid, wave: Wave, is_printed: IsPrinted) -> list[float]:
    """k1 to k7 of Appendix B; the first entry is empty."""
    (G1, G2, _), (n1, n2, _), (h1, _), a = *solid, wave.alpha
    g12 = G1 / G2
    k1, k2 = (h1 / g12 - h1 - s * 2 * (1 - n1) / a for s in (1, -1))
    k3, k4 = (((3 - 4 * n1) / a + s * h1) / g12 - (1 - 2 * n1) / a - s * h1 for s in (1, -1))
    other = 3 - 4 * (n1 if is_printed("k5-k7") else n2)
    front = (3 - 4 * n2) * (1 - 2 * n2) / (2 * (n2 - 1))
    k5 = front * (1 / (g12 * other) - 1 / (1 - 2 * n2))
    k6, k7 = (
        front
        / a
        * ((3 - 4 * n1 + s * a * h1) / (g12 * other) - (1 - 2 * n1 + s * a * h1) / (1 - 2 * n2))
        for s in (1, -1)
    )
    return [0.0, k1, k2, k3, k4, k5, k6, k7]


def _second_layer(
    solid: Solid, wave: Wave, k: Sequence[float], r: Array, is_printed: IsPrinted
) -> Array:
    """A2, A2-, C2 and C2- from A1, A1-, C1, C1- and 1, Eqs. (2.26)-(2.29)."""
    (G1, G2, _), (_, n2, _), (h1, _), a = *solid, wave.alpha
    inverse, jump = G2 / G1, G2 / G1 - 1
    sign = -1 if is_printed("k8") else 1
    front = (3 - 4 * n2) * (1 - 2 * n2) / (2 * a * (n2 - 1))
    k8 = front * (G2 * r[4] / (3 - 4 * n2) + sign * r[5] / (1 - 2 * n2))
    r3 = -r[3] / G2 if is_printed("2.26 2.27") else -G2 * r[3]
    rest, t = G2 * r[4] + r[5], a / (4 * (n2 - 1))
    h = h1 * inverse
    across = (2 * jump, 0) if is_printed("2.28") else (0, 2 * jump)
    rows = np.array(
        [
            [inverse + k[5], inverse - k[5], h + k[6], h + k[7], r3 + k8],
            [inverse - k[5], inverse + k[5], h - k[6], h - k[7], r3 - k8],
            [*across, k[1] - k[3], k[2] - k[4], -G2 * r[3] + (r[6] - rest) / a],
            [2 * jump, 0, k[1] + k[3], k[2] + k[4], -G2 * r[3] + (r[6] + rest) / a],
        ]
    )
    down, up = np.exp(-a * h1), np.exp(a * h1)
    powers = np.array([down, up, down, up, 1.0])
    return np.asarray(rows * powers * np.array([[0.5], [0.5], [t], [-t]]))


def _interface(solid: Solid, wave: Wave, r: Array, is_printed: IsPrinted) -> tuple[Array, Array]:
    """Third and fourth row of (2.25), shear and normal stress, with what is not an unknown last."""
    (_, G2, G3), (_, n2, n3), (h1, h2), a = *solid, wave.alpha
    k = _jumps(solid, wave, is_printed)
    second = _second_layer(solid, wave, k, r, is_printed)
    g23, last = G2 / G3, 3 - 4 * n3
    down, up = np.exp(-a * h2), np.exp(a * h2)
    k9 = G3 * (a * r[7] + r[8]) / last
    k10, k11 = (2 * a * h2 - 3 + 4 * n2) / (g23 * last), (3 - 4 * n2) / (g23 * last)
    k12 = a * (1 - 1 / g23) * down
    k13 = (-a - a / g23 + (1 - 2 * n3) * 2 * a / (g23 * last)) * up
    power = np.exp(-a * h1) if is_printed("k14") else down
    k14 = (1 - 2 * n2 + a * h2 - a * h2 / g23 - (1 - 2 * n3) * k11) * power
    k15 = (1 - 2 * n2 - a * h2 - a * h2 / g23 + (1 - 2 * n3) * k10) * up
    k16 = (a - a / g23 + (1 - n3) * 4 * a / (g23 * last)) * up
    factor = 1 - 2 * n3 if is_printed("k17 k18") else 2 * (1 - n3)
    k17 = (2 * (1 - n2) + a * h2 - a * h2 / g23 - factor * k11) * down
    k18 = (-2 * (1 - n2) + a * h2 - a * h2 / g23 + factor * k10) * up
    found = []
    for kb, kc, kd in ((k13, k14, k15), (k16, k17, k18)):
        row = np.array([k12, kb, kc, kd]) @ second
        if is_printed("Rc Rd"):  # no alpha in two terms, and k14 or k18 with the other sign
            lost = (kc, kc if kb == k13 else -kd)
            row[4] = k12 * second[0, 4] + kb * second[1, 4]
            row[4] += (lost[0] * second[2, 4] + lost[1] * second[3, 4]) / a
        found.append(row)
    shear, normal = found
    _exchange(shear, normal, (k12, k13, k15, k16), (solid, wave, k), is_printed)
    shear[4] += a * G3 * r[7] - (1 - 2 * n3) * k9 - r[9]
    normal[4] += a * G3 * r[7] - 2 * (1 - n3) * k9 - r[10]
    return shear, normal


def _exchange(
    shear: Array,
    normal: Array,
    of_rows: tuple[float, float, float, float],
    case: tuple[Solid, Wave, Sequence[float]],
    is_printed: IsPrinted,
) -> None:
    """Put what is printed for other factors into k19 to k26."""
    k12, k13, k15, k16 = of_rows
    solid, wave, k = case
    a, n2, h1 = wave.alpha, solid.nu[1], solid.h[0]
    inverse = solid.G[1] / solid.G[0]
    down, up = np.exp(-a * h1), np.exp(a * h1)
    if is_printed("k19"):  # k13 for k15
        shear[0] += (k13 - k15) * a / (2 * (1 - n2)) * (inverse - 1) * down
    if is_printed("k21 k22"):  # k5 for k6 and k7
        shear[2] += (k12 - k13) * (k[5] - k[6]) / 2 * down
        shear[3] += (k12 - k13) * (k[5] - k[7]) / 2 * up
    if is_printed("k23 k24"):  # h1/G12 for 1/G12
        normal[0] += (k12 + k16) / 2 * (h1 - 1) * inverse * down
        normal[1] += k12 / 2 * (h1 - 1) * inverse * up
    if is_printed("k25 k26"):  # 1/G12 for h1/G12, and k5 for k6
        normal[2] += k16 / 2 * ((1 - h1) * inverse - k[5] + k[6]) * down
        normal[3] += k16 / 2 * (1 - h1) * inverse * up
