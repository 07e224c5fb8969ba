"""A sphere that approaches soft layers in a liquid: dimples, forces above those of rigid bodies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from attrs import evolve

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.deforming.soft_spheres import (
    GAP,
    RADIUS,
    SPEED,
    VISCOSITY,
    WIDTH,
    bonded_layer,
    half_space,
    modulus_of,
    plan,
    wet_sphere,
)
from contactkit.gallery.second_method.unbounded_film import UnboundedFilm, bonded
from contactkit.lubrication.elastohydrodynamic.drive import Imposed
from contactkit.lubrication.elastohydrodynamic.motion import Phase, move
from contactkit.plot import gallery as plot

PAGE = Page(
    name="soft-approach",
    title="A sphere approaches soft layers in a liquid",
    claim="A sphere that drains a liquid from over an elastic film makes a dimple in it; on a "
    "thinner film the rigid base suppresses it, and the bodies come closer. At a given "
    "thickness of the liquid the force exceeds that of rigid bodies (Wang, Dhong and "
    "Frechette 2015; Wang, Tan and Frechette 2017, for incompressible layers).",
    verdict="Met, and two methods agree to 2e-3 in the force, 1e-3 in the gap. At ten times the "
    "force at the start the dimple is 5 % of the least gap on a half-space, under 1 % on "
    "a layer of twice the width of the pressure, and none on thinner ones; the force is "
    "2.2 to 2.6 times that of rigid bodies at the gap on the axis.",
    choices="beta = 0.03, nu = 0.5, constant speed from h = 1 um, R = 5 mm; rim at 60 sqrt(R h). "
    "The second method is Galerkin's in the whole plane. Abstracts read: no measured "
    "number is compared.",
    grid="48 to 64 rings, three meshes; 28 functions",
)
BETA, RIM, FORCE = 0.03, 60.0, 10.0
THICKNESSES = (math.inf, 2.0, 1.0, 0.5)  # over sqrt(R h)
# Rigid gaps over h at the end, beyond which the force exceeds ten times that at the start.
ENDS = {math.inf: -2.6, 2.0: -1.1, 1.0: -0.6, 0.5: -0.3}
FUNCTIONS = 28


def _second(thickness: float, end: float) -> Any:
    """Approach by the second method; lengths over sqrt(R h), gaps over h."""
    layer = None if math.isinf(thickness) else (bonded(0.5), thickness)
    film = UnboundedFilm(FUNCTIONS, 1.5, layer)
    return film.move(1.0, -BETA, (1.0 - end) / BETA, change=0.03)


def _ours(thickness: float, end: float) -> Any:
    modulus = modulus_of(BETA)
    is_deep = math.isinf(thickness)
    solid = half_space(modulus) if is_deep else bonded_layer(modulus, 0.5, thickness)
    film = plan(wet_sphere(solid, RIM)).film
    # The plan is of an opening at a speed: here the same film closes at it.
    closes = Imposed(lambda time: GAP - SPEED * time)
    times = np.linspace(0.0, (1.0 - end) * GAP / SPEED, 41)[1:].tolist()
    return move(evolve(film), [Phase(lambda *_: closes, times)], speed=SPEED)


def _at_force(thrust: Any, *curves: Any) -> Any:
    """Values of curves where the thrust is `FORCE`."""
    return np.array([np.interp(FORCE, thrust, one) for one in curves])


def compute(draft: bool = False) -> dict[str, Any]:
    """Thrust over that of rigid bodies at the start, and gaps, by both methods; sections."""
    rigid = 6.0 * math.pi * VISCOSITY * RADIUS**2 * SPEED / GAP
    parts = THICKNESSES[::2] if draft else THICKNESSES
    data: dict[str, Any] = {"parts": np.array(parts)}
    for i, part in enumerate(parts):
        found = _ours(part, ENDS[part])
        columns = found.columns
        other = _second(part, ENDS[part])
        thrust = other.thrust / (6.0 * math.pi * BETA)
        least, axis = other.gaps.min(axis=1), other.gaps[:, -1]
        ours = -columns["pull"] / rigid
        rigid_gap = columns["gap"] / GAP
        begun = rigid_gap < 0.8  # the force of bodies that set off at once builds up before
        dimple = np.array([one.gap[0] / one.gap.min() - 1.0 for one in found.profiles])
        section = found.profiles[int(np.abs(ours - FORCE).argmin())]
        near = section.radius < 4.0 * WIDTH
        data |= {
            f"thrust_{i}": ours,
            f"axis_{i}": columns["centre_gap"] / GAP,
            f"other_thrust_{i}": thrust,
            f"other_axis_{i}": axis,
            f"radius_{i}": section.radius[near] / WIDTH,
            f"section_{i}": section.gap[near] / GAP,
            f"at_{i}": _at_force(ours, columns["centre_gap"] / GAP, dimple, rigid_gap),
            f"other_at_{i}": _at_force(thrust, axis, axis / least - 1.0, other.gap),
            f"off_{i}": (ours / np.interp(-rigid_gap, -other.gap, thrust + 1e-30) - 1.0)[begun],
            f"same_{i}": np.interp([-ENDS[THICKNESSES[-1]]], -rigid_gap, columns["centre_gap"])
            / GAP,
        }
    return data


def _label(part: float) -> str:
    return "half-space" if math.isinf(part) else rf"t = {part:g} $\sqrt{{R h}}$"


def draw(data: Data) -> plot.Figure:
    """Force over the gap, sections, dimple."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    for i, part in enumerate(data["parts"]):
        line, points = plot.series(i, marker="", lw=1.2), plot.series(i, ls="", ms=4)
        left.loglog(data[f"other_axis_{i}"][1:], data[f"other_thrust_{i}"][1:], **line)
        some = slice(1, None, 4)
        left.loglog(
            data[f"axis_{i}"][some], data[f"thrust_{i}"][some], **points, label=_label(part)
        )
        middle.plot(data[f"radius_{i}"], data[f"section_{i}"], **line)
        right.plot([i], [100.0 * data[f"at_{i}"][1]], **points)
    gaps = np.array([0.1, 1.0])
    left.loglog(gaps, 1.0 / gaps, "--", color="0.5", lw=0.9, label="rigid bodies")
    left.set(
        xlabel="gap on the axis over h [-]",
        ylabel=r"force over $6 \pi \eta R^2 v/h$ [-]",
        xlim=(0.08, 1.1),
        ylim=(0.5, 40.0),
    )
    left.legend(fontsize=8)
    middle.set(xlabel=r"$r/\sqrt{R h}$ [-]", ylabel="gap over h, at 10 times the force [-]")
    middle.set_ylim(0.0, 1.5)
    right.set_xticks(range(len(data["parts"])), [_label(one) for one in data["parts"]], fontsize=8)
    count = len(data["parts"])
    right.set(ylabel="depth of the dimple over the least gap [%]", xlim=(-0.5, count - 0.5))
    plot.letters((left, middle, right), ("force", "sections", "dimple"))
    return figure


def check(data: Data) -> list[Check]:
    """Agreement, dimples, forces over those of rigid bodies."""
    n = len(data["parts"])
    ours, other = (np.array([data[f"{name}_{i}"] for i in range(n)]) for name in ("at", "other_at"))
    off = np.abs(ours[:, 0] / other[:, 0] - 1.0)
    dimples, same = ours[:, 1], np.array([float(data[f"same_{i}"][0]) for i in range(n)])
    over = FORCE * ours[:, 0]
    forces = [float(np.abs(data[f"off_{i}"]).max()) for i in range(n)]
    return [
        Check(
            "at ten times the force at the start gaps are those of the second method to 1 %",
            bool(off.max() < 1e-2),
            ", ".join(
                f"{one:.4f} and {two:.4f}" for one, two in zip(ours[:, 0], other[:, 0], strict=True)
            ),
        ),
        Check(
            "forces over the approach are those of the second method to 5 in 1000",
            bool(max(forces) < 5e-3),
            ", ".join(f"{100.0 * one:.2f} %" for one in forces),
        ),
        Check(
            "a half-space has a dimple before contact, as by the second method to 1 % of the gap",
            bool(dimples[0] > 0.03 and abs(dimples[0] - other[0, 1]) < 0.01),
            f"{100.0 * dimples[0]:.2f} and {100.0 * other[0, 1]:.2f} %",
        ),
        Check(
            "thinner layers suppress it",
            bool((np.diff(dimples) <= 0.0).all() and dimples[-1] < 1e-3),
            ", ".join(f"{100.0 * one:.2f} %" for one in dimples),
        ),
        Check(
            "and leave less liquid at the same place of the bodies",
            bool((np.diff(same) < 0.0).all()),
            ", ".join(f"{one:.3f}" for one in same) + f" of h at {ENDS[THICKNESSES[-1]]:g} h",
        ),
        Check(
            "at the same gap on the axis the force exceeds that of rigid bodies",
            bool((over > 1.5).all()),
            ", ".join(f"{one:.2f}" for one in over) + " times",
        ),
    ]


def table(data: Data) -> Table:
    """Gaps over h at ten times the force at the start."""
    rows = []
    for i, part in enumerate(data["parts"]):
        axis, dimple, rigid = map(float, data[f"at_{i}"])
        rows.append(("half-space" if math.isinf(part) else f"{part:g}", axis, dimple, rigid))
    return Table(("thickness", "gap on the axis", "dimple over the least gap", "rigid gap"), rows)


if __name__ == "__main__":
    run_page(__file__)
