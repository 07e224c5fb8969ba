"""Moduli of a film between bodies that deform, against their closed limits and scaling laws."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot

PAGE = Page(
    name="film-moduli",
    title="Storage and loss modulus of a film between bodies that deform",
    claim="A sphere that vibrates over a flat in a liquid: far above D_c = 8 R (eta "
    "omega/E*)^(2/3) the loss modulus is 6 pi eta omega R^2/D, and the storage modulus "
    "grows as omega^2; far below, both grow as omega^(1/3), at a phase of 30 degrees "
    "(Leroy and Charlaix 2011). A thin layer deforms in proportion to the pressure if "
    "compressible, to its Laplacian if not.",
    verdict="Met: the limits to some parts in 1e4; the phase is within a degree of 30 at 1/1000 "
    "of D_c. A layer of 0.05 of the width of the pressure is 0.1 % off the limit of a "
    "thin one where compressible, 1 % where not.",
    choices="R = 5 mm, D = 1 um, 0.1 Pa.s; the closed forms of the storage moduli are ours. "
    "Measured curves could not be read.",
    grid="120 to 360 rings, three meshes",
)
R, GAP, VISCOSITY = 5e-3, 1e-6, 0.1
WIDTH = math.sqrt(R * GAP)
THIN = (0.2, 0.1, 0.05)  # thickness of a layer over the width of the pressure
MODULUS = 1e6  # of layers [Pa]


def _scene(solid: Any, radius: float, upper: Any) -> Any:
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat(radius=radius), solid=solid),
            upper=upper,
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=VISCOSITY)),
        ),
        loading=ck.ImposedSpeed(speed=1e-9, initial_gap=GAP, final_gap=3.0 * GAP),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def _half_space(modulus: float) -> Any:
    return ck.Material(young_modulus=0.75 * modulus, poisson_ratio=0.5)


def _layer(thickness: float, ratio: float) -> Any:
    layer = ck.Layer(
        material=ck.Material(young_modulus=MODULUS, poisson_ratio=ratio), thickness=thickness
    )
    return ck.Stack(layers=(layer,), substrate=ck.RigidBase(bonded=True))


def _thin(thickness: float, ratio: float, omega: float) -> float:
    """Storage modulus of a sphere on a thin layer [N/m].

    Of the pressure p = 3 eta omega R z/h^2, int p C p dA/z^2, with C = t (1 + nu)(1 - 2 nu)/(E (1 -
    nu)) or, of an incompressible layer, -t^3/(3 G) times the Laplacian.
    """
    square = (VISCOSITY * omega) ** 2
    if ratio == 0.5:
        return 2.4 * math.pi * square * R**2 * thickness**3 / (MODULUS / 3.0) / GAP**4
    local = thickness * (1.0 + ratio) * (1.0 - 2.0 * ratio) / (MODULUS * (1.0 - ratio))
    return 6.0 * math.pi * local * square * R**3 / GAP**3


def compute(draft: bool = False) -> dict[str, Any]:
    """Moduli over D/D_c, of a flat, and on layers."""
    distances = np.geomspace(300.0, 1e-3, 12 if draft else 40)
    modulus = 1e6
    rates = (GAP / (8.0 * R * distances)) ** 1.5 * modulus / VISCOSITY
    ball = ck.Sphere(radius=R)
    curve = ck.modulus_curve(
        _scene(_half_space(modulus), 400.0 * WIDTH, ball), (rates / math.tau).tolist()
    )
    loss = 6.0 * math.pi * VISCOSITY * rates * R**2 / GAP
    storage = 27.0 * math.pi**3 / 2.0**3.5 * (VISCOSITY * rates) ** 2 * R**3.5 / modulus / GAP**2.5
    slow = 1e-3
    flat = ck.modulus_curve(_scene(_half_space(1e9), 1e-4, ck.Flat(radius=1e-4)), [slow / math.tau])
    exact = 512.0 / 35.0 * (VISCOSITY * slow) ** 2 * 1e-28 / 1e9 / GAP**6
    parts = THIN[:2] if draft else THIN
    layers = []
    for ratio in (0.3, 0.5):
        for part in parts:
            scene = _scene(_layer(part * WIDTH, ratio), 12.0 * WIDTH, ball)
            found = float(ck.modulus_curve(scene, [slow / math.tau]).storage_modulus[0])
            layers.append(found / _thin(part * WIDTH, ratio, slow))
    return {
        "distances": distances,
        "storage": curve.storage_modulus / loss,
        "loss": curve.loss_modulus / loss,
        "stiff": storage / loss,
        "flat": np.array([flat.storage_modulus[0] / exact]),
        "parts": np.array(parts),
        "layers": np.array(layers).reshape(2, len(parts)),
    }


def draw(data: Data) -> plot.Figure:
    """Moduli over the gap, phase, thin layers."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    x = data["distances"]
    left.loglog(x, data["loss"], **plot.series(0, marker=""), label="G''")
    left.loglog(x, data["storage"], **plot.series(1, marker=""), label="G'")
    left.loglog(x, data["stiff"], "--", color="0.5", lw=0.9, label="G' of stiff bodies")
    left.axhline(1.0, color="0.5", lw=0.8)
    left.set(
        xlabel="$D/D_c$ [-]", ylabel=r"modulus over $6 \pi \eta \omega R^2/D$ [-]", ylim=(1e-5, 5.0)
    )
    left.legend(fontsize=8)
    phase = np.degrees(np.arctan2(data["loss"], data["storage"]))
    middle.semilogx(x, phase, **plot.series(0, marker=""))
    for level in (30.0, 90.0):
        middle.axhline(level, color="0.5", lw=0.8)
    middle.set(xlabel="$D/D_c$ [-]", ylabel="phase [degrees]")
    for i, name in enumerate(("nu = 0.3", "nu = 0.5")):
        right.plot(data["parts"], data["layers"][i], **plot.series(i), label=name)
    right.axhline(1.0, color="0.5", lw=0.8)
    right.set(
        xlabel=r"$t/\sqrt{R D}$ [-]", ylabel="G' over that of a thin layer [-]", xlim=(0.0, None)
    )
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("moduli", "phase", "thin layers"))
    return figure


def check(data: Data) -> list[Check]:
    """Limits."""
    stiff = data["storage"][0] / data["stiff"][0], data["loss"][0]
    ratio = data["loss"][-1] / data["storage"][-1]
    slope = np.gradient(np.log(data["loss"]), np.log(data["distances"]))[-2]
    cross = float(np.interp(0.0, np.log(data["storage"] / data["loss"]), np.log(data["distances"])))
    thin = data["layers"] - 1.0
    return [
        Check(
            "far above D_c the loss modulus is 6 pi eta omega R^2/D to 1 in 1000",
            bool(abs(stiff[1] - 1.0) < 1e-3),
            f"{100 * (stiff[1] - 1.0):+.3f} %",
        ),
        Check(
            "and the storage modulus that of the first pressure on half-spaces to 1 %",
            bool(abs(stiff[0] - 1.0) < 1e-2),
            f"{100 * (stiff[0] - 1.0):+.2f} % at {data['distances'][0]:g} D_c",
        ),
        Check(
            "far below D_c the phase is 30 degrees, G''/G' = 1/sqrt 3",
            bool(abs(math.sqrt(3.0) * ratio - 1.0) < 0.03),
            f"sqrt 3 G''/G' = {math.sqrt(3.0) * ratio:.4f}",
        ),
        Check(
            "and moduli grow as omega^(1/3): over that of rigid bodies in proportion to D/D_c",
            bool(abs(slope - 1.0) < 0.02),
            f"exponent of D/D_c {slope:.3f}",
        ),
        Check(
            "both moduli are equal near D_c, between 0.2 and 0.5 of it",
            bool(0.2 < math.exp(cross) < 0.5),
            f"at {math.exp(cross):.3f} D_c",
        ),
        Check(
            "a flat of stiff bodies has 512/35 to 1 in 1000",
            bool(abs(data["flat"][0] - 1.0) < 1e-3),
            f"{100 * (data['flat'][0] - 1.0):+.4f} %",
        ),
        Check(
            "layers come to the limits of thin ones, compressible and not",
            bool(
                (np.abs(thin[:, -1]) < 0.6 * data["parts"][-1]).all()
                and (np.abs(thin[:, -1]) < np.abs(thin[:, 0])).all()
            ),
            f"nu = 0.3: {100 * thin[0, -1]:+.1f} %, nu = 0.5: {100 * thin[1, -1]:+.1f} % at a "
            f"thickness of {data['parts'][-1]:g} widths",
        ),
    ]


def table(data: Data) -> Table:
    """Moduli over those of rigid bodies at some gaps."""
    rows = zip(data["distances"], data["storage"], data["loss"], strict=True)
    return Table(("D/D_c", "G'", "G''"), [tuple(map(float, r)) for r in rows][::3])


if __name__ == "__main__":
    run_page(__file__)
