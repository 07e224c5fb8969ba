"""Eqs. (2.17)-(2.34) and Appendix B: the layered half-space of the source, as printed and right."""

from __future__ import annotations

from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.elasticity.layered import compliance
from contactkit.gallery.chapter_2.printed_layers import (
    COMPONENTS,
    Solid,
    Wave,
    by_elimination,
    by_matching,
    field,
    surface,
)
from contactkit.gallery.second_method import layers
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import gallery as plot

PAGE = Page(
    name="layered-equations",
    title="Displacement and stress of two layers, as printed and right",
    claim="Potentials of Papkovich and Neuber, with coefficients from two systems for each "
    "wavenumber, are the displacements and stresses of two layers on a substrate.",
    verdict="With every erratum put right the equations have the displacement of this package to "
    "round-off, and stresses that follow from it by Hooke's law. As printed most errata "
    "change the displacement of the surface by tens of per cent, all together by an order "
    "of magnitude.",
    choices="Errata one at a time, the others right. Structure IV (moduli 1, 0.5, 1; nu = 0.3) "
    "and one of unlike nu (2, 0.5, 1; 0.2, 0.4, 0.3), layers of 0.7 and 1.1, friction of "
    "0.3; oblique waves. B,1 is zero.",
    grid="13 wavenumbers, alpha (h1 + h2) from 0.3 to 3",
)
CASES = {
    "IV": Solid((1.0, 0.5, 1.0), (0.3, 0.3, 0.3), (0.7, 1.1)),
    "unlike nu": Solid((2.0, 0.5, 1.0), (0.2, 0.4, 0.3), (0.7, 1.1)),
}
OF_SURFACE = (
    "2.34",
    "2.24 row 3",
    "2.24 row 4",
    "2.25 row 2",
    "2.26 2.27",
    "2.28",
    "k5-k7",
    "k8",
    "k14",
    "k17 k18",
    "k19",
    "k21 k22",
    "k23 k24",
    "k25 k26",
    "Rc Rd",
    "R2",
    "R6",
    "R8",
    "R9",
    "R10",
)
OF_FIELD = {  # errata of (2.19) and (2.20), and the component they change
    "u_eta": "uy",
    "u_z": "uz",
    "sxx": "sxx",
    "syy": "syy",
    "szz": "szz",
    "sxy": "sxy",
    "syz sxz": "sxz",
}


def _waves(n: int) -> list[Wave]:
    return [Wave(0.8 * a, 0.6 * a, 0.3) for a in (np.geomspace(0.3, 3.0, n) / 1.8).tolist()]


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Relative change of the surface, or of a component in the second layer, by each erratum."""
    waves = _waves(5 if draft else 13)
    on_surface, within, agreement, all_wrong = [], [], [], []
    for solid in CASES.values():
        G, nu = solid.G[0], solid.nu[0]
        for wave in waves:
            right = surface(by_elimination(solid, wave), wave, G, nu)
            agreement.append([abs(right / _reference(solid, wave) - 1.0), _hooke(solid, wave)])
            on_surface.append(
                [
                    abs(surface(by_elimination(solid, wave, [n]), wave, G, nu, [n]) / right - 1.0)
                    for n in OF_SURFACE
                ]
            )
            wrong = by_elimination(solid, wave, OF_SURFACE)
            all_wrong.append(abs(surface(wrong, wave, G, nu, OF_SURFACE) / right))
            within.append(_within(solid, wave))
    shape = (len(CASES), len(waves), -1)
    plain = Wave(1e-6, 1.0, 0.0)
    first = CASES["IV"]
    moved = surface(by_elimination(first, plain), plain, first.G[0], first.nu[0])
    return {
        "moved": np.array(moved.real),
        "surface": np.array(on_surface).reshape(shape),
        "field": np.array(within).reshape(shape),
        "agreement": np.array(agreement).reshape(shape),
        "all": np.array(all_wrong).reshape(shape[:2]),
    }


def _reference(solid: Solid, wave: Wave) -> complex:
    """Displacement of the surface by the recursion of this package."""
    E = [2.0 * g * (1.0 + v) for g, v in zip(solid.G, solid.nu, strict=True)]
    found = compliance(wave.alpha, E, solid.nu, solid.h)
    return complex(found.C + 1j * wave.xi / wave.alpha * found.F12 * wave.friction)


def _within(solid: Solid, wave: Wave) -> list[float]:
    """Change of a component amid the second layer, over the largest stress or displacement."""
    c, z = by_matching(solid, wave)[1], 0.5 * solid.h[1]
    one = (wave, solid.G[1], solid.nu[1])
    right = field(c, z, *one)
    sizes = {
        kind: max(abs(right[n]) for n in COMPONENTS if n.startswith(kind)) for kind in ("u", "s")
    }
    return [
        abs(field(c, z, *one, printed=[name])[which] - right[which]) / sizes[which[0]]
        for name, which in OF_FIELD.items()
    ]


def _hooke(solid: Solid, wave: Wave) -> float:
    """Largest difference of the stresses (2.20) and those of the strains of (2.19)."""
    c, z, step = by_matching(solid, wave)[1], 0.5 * solid.h[1], 1e-4
    G, nu = solid.G[1], solid.nu[1]
    u, above, below = (field(c, z + s * step, wave, G, nu) for s in (0, 1, -1))
    ex, ey, ez = 1j * wave.xi, 1j * wave.eta, 0.5 / step
    dx, dy, dz = (ez * (above[n] - below[n]) for n in ("ux", "uy", "uz"))
    volume = 2.0 * G * nu / (1.0 - 2.0 * nu) * (ex * u["ux"] + ey * u["uy"] + dz)
    strain = {
        "sxx": volume + 2.0 * G * ex * u["ux"],
        "syy": volume + 2.0 * G * ey * u["uy"],
        "szz": volume + 2.0 * G * dz,
        "sxy": G * (ex * u["uy"] + ey * u["ux"]),
        "syz": G * (dy + ey * u["uz"]),
        "sxz": G * (dx + ex * u["uz"]),
    }
    size = max(abs(v) for v in strain.values())
    return max(abs(v - u[n]) for n, v in strain.items()) / size


def _largest(data: Data) -> dict[str, np.ndarray]:
    """Largest effect of each erratum in per cent, one number for each case."""
    both = np.concatenate((data["surface"], data["field"]), axis=2)
    return dict(zip((*OF_SURFACE, *OF_FIELD), 100.0 * both.max(axis=1).T, strict=True))


def draw(data: Data) -> plot.Figure:
    """Largest effect of each erratum."""
    figure, ax = plot.figure(size=(7.2, 7.6))
    found = _largest(data)
    places = np.arange(len(found))
    for i, case in enumerate(CASES):
        size = [max(float(v[i]), 0.1) for v in found.values()]
        look = plot.series(i + 1, ls="", ms=6)
        ax.plot(size, places, **look, label=case)
    ax.set_yticks(places, [_name(name) for name in found], fontsize=8)
    ax.invert_yaxis()
    ax.axhline(len(OF_SURFACE) - 0.5, color="0.5", lw=0.8)
    ax.set(
        xscale="log",
        xlim=(0.08, 2000.0),
        xlabel="largest change [%]: above of the surface, below of a component in layer 2",
    )
    ax.grid(axis="y", lw=0.3)
    ax.plot([], [], " ", label="0.1: that or less")
    plot.plain_log(ax.xaxis)
    ax.legend(fontsize=9, loc="lower left")
    return figure


def _name(erratum: str) -> str:
    """Number of an erratum in the source."""
    names = {"u_eta": "(2.19) u_eta", "u_z": "(2.19) u_z"}
    if erratum in OF_FIELD:
        return names.get(erratum, f"(2.20) {erratum}")
    if erratum.startswith("2."):
        number, _, rest = erratum.partition(" ")
        return f"({number}), ({rest})" if rest.startswith("2.") else f"({number}) {rest}".strip()
    return f"App. B {erratum}"


def check(data: Data) -> list[Check]:
    """Agreement of the right equations, and what each erratum does."""
    off, hooke = (float(data["agreement"][..., i].max()) for i in (0, 1))
    found = _largest(data)
    first, second = (np.array([v[i] for v in found.values()]) for i in (0, 1))

    def sizes(*names: str) -> str:
        return ", ".join(f"{_name(n)} {found[n][0]:.3g} and {found[n][1]:.3g} %" for n in names)

    many = sum(max(found[n]) > 10.0 for n in OF_SURFACE)
    none = [n for n in found if max(found[n]) < 0.1]
    return [
        Check(
            "put right, the printed elimination has the displacement of this package to round-off",
            off < 1e-9,
            f"largest difference {off:.1e}",
        ),
        Check(
            "put right, the stresses (2.20) follow from the displacements (2.19) by Hooke's law",
            hooke < 1e-6,
            f"largest difference {hooke:.1e} of the largest stress",
        ),
        Check(
            "more than half of the errata of the surface change it by more than 10 %",
            many > len(OF_SURFACE) / 2,
            f"{many} of {len(OF_SURFACE)}",
        ),
        Check(
            "no erratum is without effect",
            not none and bool(np.all(np.maximum(first, second) > 0.1)),
            "least: " + sizes(min(found, key=lambda n: max(found[n]))),
        ),
        Check(
            "(2.24) row 4 and k5-k7 do nothing where all nu are equal",
            max(found["2.24 row 4"][0], found["k5-k7"][0]) < 1e-8,
            sizes("2.24 row 4", "k5-k7"),
        ),
        Check(
            "with all errata at once the displacement is off by a factor of ten at some wavenumber",
            bool(np.abs(np.log10(data["all"])).max() > 1.0),
            f"{data['all'].min():.2g} to {data['all'].max():.2g} times",
        ),
        agree(
            "displacement of IV under a wave of unit wavenumber, without friction",
            data["moved"],
            layers.of_waves(np.array([1.0]), layers.Layers((2.6, 1.3, 2.6), 0.3, (0.7, 1.1))),
            1e-6,
        ),
    ]


def table(data: Data) -> Table:
    """Largest effect of each erratum."""
    rows: list[Any] = []
    for name, (one, two) in _largest(data).items():
        of = "surface" if name in OF_SURFACE else f"{OF_FIELD[name]} in layer 2"
        rows.append([_name(name), of, f"{one:.2g}", f"{two:.2g}"])
    return Table(["erratum", "changes", "IV [%]", "unlike nu [%]"], rows)


if __name__ == "__main__":
    run_page(__file__)
