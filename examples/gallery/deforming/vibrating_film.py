"""Moduli of a film without a rim, on half-spaces and layers, by two methods that share no code."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.optimize import brentq

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.deforming.soft_spheres import (
    GAP,
    RADIUS,
    VISCOSITY,
    bonded_layer,
    half_space,
    wet_sphere,
)
from contactkit.gallery.second_method.unbounded_film import UnboundedFilm, bonded
from contactkit.plot import gallery as plot

PAGE = Page(
    name="vibrating-film",
    title="A vibrating film by two methods: half-spaces, and layers on a rigid base",
    claim="The moduli of a film between a sphere and a plane are one function of D/D_c, with "
    "D_c = 8 R (eta omega/E*)^(2/3): viscous above, and below it of the bodies alone "
    "(Leroy and Charlaix 2011; Leroy et al. 2012; Villey et al. 2013).",
    verdict="Met, and two methods agree to 6e-4 from 100 to 0.03 D_c, and to 4e-4 on layers of a "
    "half and four widths of the pressure. The plateau is |G| = 5.478 E*^(2/3) (eta "
    "omega)^(1/3) R, at 30.00 degrees; both moduli are equal at 0.2673 D_c.",
    choices="R = 5 mm, D = 1 um, 0.1 Pa.s, E* = 1 MPa; rim at 400 sqrt(R D), of layers at 100. "
    "The second method is Galerkin's in the whole plane. The numbers are two solutions of "
    "the equations, no measurement.",
    grid="120 to 360 rings, three meshes; 32 functions",
)
E_STAR = 1e6  # [Pa]
DISTANCES = (100.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03)  # over D_c
LAYERS = ((0.3, 0.5), (0.3, 4.0), (0.5, 0.5), (0.5, 4.0))  # Poisson's ratio, thickness over width
FUNCTIONS = 32


def _frequency(distance: float) -> float:
    """Parameter eta omega/E* (R/D)^1.5 at D/D_c."""
    return float((8.0 * distance) ** -1.5)


def _ours(scene: Any, distances: Any) -> Any:
    """G' and G'' of contactkit over 6 pi eta omega R^2/D."""
    rates = np.array([_frequency(one) for one in distances]) * E_STAR * (GAP / RADIUS) ** 1.5
    curve = ck.modulus_curve(scene, (rates / VISCOSITY / math.tau).tolist())
    rigid = 6.0 * math.pi * rates * RADIUS**2 / GAP
    return np.array([curve.storage_modulus, curve.loss_modulus]) / rigid


def _second(distance: float, layer: Any = None) -> complex:
    """The same without a rim, by the second method; lengths are over sqrt(R D)."""
    frequency = _frequency(distance)
    film = UnboundedFilm(FUNCTIONS, math.sqrt(2.0 * max(1.0, 1.0 / distance)), layer)
    return film.modulus(1.0, frequency) / (6.0 * math.pi * frequency)


def _excess(distance: float) -> float:
    both = _second(distance)
    return both.real - both.imag


def compute(draft: bool = False) -> dict[str, Any]:
    """Moduli by both methods; those of the second on a fine curve, and its plateau."""
    fine = np.geomspace(300.0, 0.01, 20 if draft else 60)
    layers = LAYERS[1::2] if draft else LAYERS
    ours = np.array(
        [
            _ours(wet_sphere(bonded_layer(E_STAR, ratio, part), 100.0), (1.0,))[:, 0]
            for ratio, part in layers
        ]
    )
    other = [_second(1.0, (bonded(ratio), part)) for ratio, part in layers]
    return {
        "fine": fine,
        "curve": np.array([_second(x) for x in fine]),
        "distances": np.array(DISTANCES),
        "ours": _ours(wet_sphere(half_space(E_STAR), 400.0), DISTANCES),
        "second": np.array([_second(x) for x in DISTANCES]),
        "layers": np.array(layers),
        "layers_ours": ours,
        "layers_second": np.array(other),
        # E* = R = eta omega = 1, without a gap
        "plateau": np.array([UnboundedFilm(40, 4.0).modulus(0.0, 1.0)]),
        "equal": np.array([brentq(_excess, 0.1, 1.0, xtol=1e-6)]),
    }


def draw(data: Data) -> plot.Figure:
    """Moduli over the gap, differences, layers."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    for i, (name, part) in enumerate((("G'", "real"), ("G''", "imag"))):
        look = plot.series(i, marker="", lw=1.2)
        left.loglog(data["fine"], getattr(data["curve"], part), **look, label=f"{name}, 2nd method")
        ours = plot.series(i, ls="")
        left.loglog(data["distances"], data["ours"][i], **ours, label=f"{name}, contactkit")
        off = data["ours"][i] / getattr(data["second"], part) - 1.0
        middle.loglog(data["distances"], np.abs(off), **plot.series(i), label=name)
        other = getattr(data["layers_second"], part)
        right.semilogy(
            np.abs(data["layers_ours"][:, i] / other - 1.0), **plot.series(i, ls=""), label=name
        )
    left.set(xlabel="$D/D_c$ [-]", ylabel=r"modulus over $6 \pi \eta \omega R^2/D$ [-]")
    left.legend(fontsize=8)
    middle.set(xlabel="$D/D_c$ [-]", ylabel="difference of the methods [-]", ylim=(1e-8, 1e-1))
    middle.legend(fontsize=8)
    names = [rf"$\nu$ {ratio:g}" + "\n" + f"t = {part:g}" for ratio, part in data["layers"]]
    right.set_xticks(range(len(names)), names)
    right.set(
        ylabel="difference of the methods [-]", ylim=(1e-8, 1e-1), xlim=(-0.5, len(names) - 0.5)
    )
    right.set_xlabel(r"layers at $D = D_c$, thickness over $\sqrt{R D}$ [-]")
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("moduli", "half-spaces", "layers"))
    return figure


def check(data: Data) -> list[Check]:
    """Agreement, plateau, equal moduli."""
    second = np.array([data["second"].real, data["second"].imag])
    off = np.abs(data["ours"] / second - 1.0)
    layers = np.array([data["layers_second"].real, data["layers_second"].imag]).T
    thin = np.abs(data["layers_ours"] / layers - 1.0)
    plateau = complex(data["plateau"][0])
    phase = math.degrees(math.atan2(plateau.imag, plateau.real))
    equal = float(data["equal"][0])
    stiff = 27.0 * math.pi**3 / 2.0**3.5 / (6.0 * math.pi) * _frequency(100.0)
    first = float(data["second"][0].real) / stiff
    return [
        Check(
            "contactkit has the moduli of the second method from 100 to 0.03 D_c to 1 in 1000",
            bool(off.max() < 1e-3),
            f"G' {off[0].max():.1e}, G'' {off[1].max():.1e}",
        ),
        Check(
            "and those of layers, compressible and not, to 1 in 1000",
            bool(thin.max() < 1e-3),
            f"G' {thin[:, 0].max():.1e}, G'' {thin[:, 1].max():.1e}",
        ),
        Check(
            "the second method has the closed storage modulus of stiff bodies to 1 %",
            bool(abs(first - 1.0) < 1e-2),
            f"{100.0 * (first - 1.0):+.3f} % at 100 D_c",
        ),
        Check(
            "and far below D_c a plateau of 5.48 E*^(2/3) (eta omega)^(1/3) R at 30 degrees",
            bool(abs(abs(plateau) / 5.478 - 1.0) < 1e-3 and abs(phase - 30.0) < 0.02),
            f"{abs(plateau):.4f} at {phase:.3f} degrees",
        ),
        Check(
            "both moduli are equal at 0.2673 D_c",
            bool(abs(equal / 0.2673 - 1.0) < 1e-3),
            f"{equal:.5f} D_c",
        ),
    ]


def table(data: Data) -> Table:
    """Moduli over 6 pi eta omega R^2/D, by both methods."""
    rows = [
        (float(x), float(ours[0]), float(g.real), float(ours[1]), float(g.imag))
        for x, ours, g in zip(data["distances"], data["ours"].T, data["second"], strict=True)
    ]
    return Table(("D/D_c", "G'", "G' without rim", "G''", "G'' without rim"), rows)


if __name__ == "__main__":
    run_page(__file__)
