"""Pulls of soft spheres off a film: from rigid bodies to bodies that deform beyond the gap."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot
from contactkit.separation.deforming.maxwell import series_pull, series_stiffness

PAGE = Page(
    name="soft-pull",
    title="A soft sphere pulled off a film",
    claim="One number governs film and bodies, beta = eta v R^1.5/(E* h^2.5), pi/4 of the "
    "elasticity parameter of Davis, Serayssol and Hinch (1986). Where it is small the "
    "force is 6 pi eta R^2 v/h at once; where it is large the bodies follow the pull "
    "before the gap opens, in a short time.",
    verdict="Met: pulls of the same beta are the same though every property differs; the largest "
    "force falls from that of rigid bodies to 0.16 of it at beta = 10, as a first program "
    "has it to half a per cent. Rigid bodies in series with a spring have the beginning "
    "of it. The gap on the axis shrinks before it opens.",
    choices="R = 5 mm, h = 1 um, 0.1 Pa.s, 10 um/s, from rest, flooded to 8 sqrt(R h).",
    grid="24 to 48 rings, three meshes",
)
R, GAP, VISCOSITY, SPEED = 5e-3, 1e-6, 0.1, 1e-5
RIM = 8.0  # sqrt(R h)
# Largest force over that of rigid bodies, by an axisymmetric program of our own with 48 elements.
DRAFTED = {0.01: 0.843, 0.03: 0.765, 0.1: 0.645, 0.3: 0.514, 1.0: 0.369, 3.0: 0.253, 10.0: 0.158}


def _scene(beta: float, radius: float = R, gap: float = GAP, viscosity: float = VISCOSITY) -> Any:
    modulus = viscosity * SPEED * radius**1.5 / (beta * gap**2.5)
    solid = ck.Material(young_modulus=0.91 * modulus, poisson_ratio=0.3)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat(radius=RIM * math.sqrt(radius * gap)), solid=solid),
            upper=ck.Sphere(radius=radius),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=viscosity)),
        ),
        loading=ck.ImposedSpeed(
            speed=SPEED, initial_gap=gap, final_gap=gap * (1.5 + 8.0 * beta**0.5)
        ),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def _pulled(scene: Any, draft: bool) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # tension: no cavity opens here
        return ck.simulate(ck.plan(scene, ck.Accuracy(film_rtol=5e-3 if draft else 1e-3)))


def _in_series(beta: float, times: Any) -> Any:
    modulus = VISCOSITY * SPEED * R**1.5 / (beta * GAP**2.5)

    def damping(gap: float) -> float:
        rim = gap + 0.5 * RIM**2 * GAP
        inner = 1.0 / gap - 1.0 / rim - (rim - gap) / rim**2
        return 6.0 * math.pi * VISCOSITY * R**2 * inner

    def spring(gap: float) -> float:
        return series_stiffness(R, math.sqrt(R * gap), modulus)

    return series_pull(damping, spring, GAP, SPEED, times)


def compute(draft: bool = False) -> dict[str, Any]:
    """Force and gap on the axis over time, each over that of rigid bodies at the start."""
    rigid = 6.0 * math.pi * VISCOSITY * R**2 * SPEED / GAP
    betas = (0.01, 1.0, 10.0) if draft else tuple(DRAFTED)
    data: dict[str, Any] = {"betas": np.array(betas)}
    for i, beta in enumerate(betas):
        found = _pulled(_scene(beta), draft)
        data |= {
            f"time_{i}": found["time"] * SPEED / GAP,
            f"force_{i}": found["pull"] / rigid,
            f"centre_{i}": found["centre_gap"] / GAP,
            f"series_{i}": _in_series(beta, found["time"]) / rigid,
        }
        data[f"peak_{i}"] = np.array([found.scalars()["pull_off_force"][0] / rigid])
    other = _pulled(_scene(1.0, radius=1e-4, gap=2e-8, viscosity=1e-2), draft)
    scale = 6.0 * math.pi * 1e-2 * 1e-4**2 * SPEED / 2e-8
    data["other_peak"] = np.array([other.scalars()["pull_off_force"][0] / scale])
    plan = ck.plan(_scene(1.0))
    theta = 0.91 / (math.pi * plan.scene.interface.lower.solid.young_modulus)
    data["eps_over_beta"] = np.array(
        [4.0 * theta * VISCOSITY * R**1.5 * SPEED / GAP**2.5 / plan.numbers.beta]
    )
    return data


def draw(data: Data) -> plot.Figure:
    """Force over time, gap on the axis, largest force over beta."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    betas = data["betas"]
    for i, beta in enumerate(betas):
        look = plot.series(i, marker="", lw=1.3)
        left.plot(data[f"time_{i}"], data[f"force_{i}"], **look, label=rf"$\beta$ = {beta:g}")
        middle.plot(data[f"time_{i}"], data[f"centre_{i}"], **look)
    left.plot(data["time_0"], data["series_0"], "--", color="0.4", lw=0.9, label="spring in series")
    left.set(xlabel="$v t/h$ [-]", ylabel=r"force over $6 \pi \eta R^2 v/h$ [-]", xlim=(0.0, 12.0))
    left.legend(fontsize=8)
    middle.set(xlabel="$v t/h$ [-]", ylabel="gap on the axis over h [-]", xlim=(0.0, 12.0))
    middle.set_ylim(0.5, 4.0)
    peaks = [float(data[f"peak_{i}"][0]) for i in range(len(betas))]
    first = plot.series(0, ls="")
    right.semilogx(list(DRAFTED), list(DRAFTED.values()), **first, label="first program")
    right.semilogx(betas, peaks, **plot.series(1, marker=""), label="contactkit")
    series = [float(data[f"series_{i}"].max()) for i in range(len(betas))]
    right.semilogx(betas, series, "--", color="0.4", lw=0.9, label="spring in series")
    right.set(xlabel=r"$\beta$ [-]", ylabel="largest force [-]", ylim=(0.0, 1.0))
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("force", "gap on the axis", "largest force"))
    return figure


def check(data: Data) -> list[Check]:
    """Mapping, similarity, limits."""
    betas = data["betas"].tolist()
    peaks = [float(data[f"peak_{i}"][0]) for i in range(len(betas))]
    off = [peak / DRAFTED[beta] - 1.0 for beta, peak in zip(betas, peaks, strict=True)]
    one, last = betas.index(1.0), len(betas) - 1
    series = float(data["series_0"].max()) / peaks[0] - 1.0
    least = [float(data[f"centre_{i}"].min()) for i in range(len(betas))]
    rate = np.diff(data[f"centre_{last}"]) / np.diff(data[f"time_{last}"])
    return [
        Check(
            "eps of Davis, Serayssol and Hinch is 4/pi of beta",
            bool(abs(data["eps_over_beta"][0] * math.pi / 4.0 - 1.0) < 1e-9),
            f"{data['eps_over_beta'][0]:.6f}",
        ),
        Check(
            "beta alone decides: other radius, gap, liquid and modulus, the same largest force",
            bool(abs(data["other_peak"][0] / peaks[one] - 1.0) < 2e-3),
            f"{peaks[one]:.4f} and {float(data['other_peak'][0]):.4f} at beta = 1",
        ),
        Check(
            "the largest force falls with beta, as the first program has it to 1 %",
            bool(np.all(np.diff(peaks) < 0.0) and max(map(abs, off)) < 1e-2),
            ", ".join(f"{100 * one:+.2f}" for one in off) + " %",
        ),
        Check(
            "at beta = 0.01 rigid bodies in series with a spring have it to 2 %",
            bool(abs(series) < 0.02),
            f"{100 * series:+.2f} %",
        ),
        Check(
            "the gap on the axis shrinks before it opens, the more so the softer up to beta = 10",
            bool(np.all(np.diff(least) < 0.0) and least[-1] < 0.75),
            ", ".join(f"{value:.3f}" for value in least),
        ),
        Check(
            "at beta = 10 it then opens faster than the bodies part",
            bool(rate.max() > 1.5),
            f"{rate.max():.2f} times as fast",
        ),
    ]


def table(data: Data) -> Table:
    """Largest force over that of rigid bodies."""
    rows = [
        (beta, float(data[f"peak_{i}"][0]), DRAFTED[beta], float(data[f"series_{i}"].max()))
        for i, beta in enumerate(data["betas"].tolist())
    ]
    return Table(("beta", "contactkit", "first program", "spring in series"), rows)


if __name__ == "__main__":
    run_page(__file__)
