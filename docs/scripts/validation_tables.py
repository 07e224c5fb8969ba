"""Tables of the validation page: printed equations, and this code against values from elsewhere."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

import contactkit as ck
from contactkit.as_published.printed import common as published
from contactkit.capillary.arc import bridge as bridge_arc
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.lubrication import squeeze_film as squeeze

DOCS = Path(__file__).parents[1]


def grid(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Markdown table."""
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def division_table() -> str:
    """Optimal and maximum number of menisci, and the critical area, of the source's flat films."""
    water = ck.Liquid(name="water", surface_tension=0.072, viscosity=0.89e-3)
    rows = []
    for height in (2, 3, 4, 5, 6):
        gap, angle = height * 1e-9, math.pi / 3
        film = ck.Meniscus(
            liquid=water, volume=1e-12 * gap, contact_angle_lower=angle, contact_angle_upper=angle
        )
        scene = ck.SeparationScene(
            interface=ck.Interface(meniscus=film),
            loading=ck.ImposedTime(initial_gap=gap, final_gap=1e-3, time=1e-7),
            effects=(ck.MeniscusForce(), ck.ViscousForce()),
        )
        exact = ck.divide_meniscus(scene, (1,))
        printed = ck.divide_meniscus(scene, (1,), law="as-published")
        areas = [
            ck.critical_meniscus(scene, law=law).area * 1e12 for law in ("as-published", "exact")
        ]
        rows.append(
            (
                f"{height}",
                f"{printed.best_count}",
                f"{exact.best_count}",
                f"{exact.max_stable_count}",
                *(f"{area:.4f}" for area in areas),
            )
        )
    head = (
        "h0 [nm]",
        "optimal N, as printed",
        "optimal N, exact",
        "maximum stable N, exact",
        "critical area, as printed [um2]",
        "critical area, exact [um2]",
    )
    return grid(head, rows)


def divided_force_table() -> str:
    """Number of menisci at which the force between the source's flats is greatest."""
    water = ck.Liquid(name="water", surface_tension=0.072)
    rows = []
    for lower, upper in ((60, 60), (0, 0), (20, 40), (0, 60)):
        angles = {
            "contact_angle_lower": math.radians(lower),
            "contact_angle_upper": math.radians(upper),
        }
        gap = 2e-9
        film = ck.Meniscus(liquid=water, volume=1e-12 * gap, **angles)
        scene = ck.SeparationScene(
            interface=ck.Interface(meniscus=film),
            loading=ck.ImposedTime(initial_gap=gap, final_gap=1e-3, time=1e-7),
            effects=(ck.MeniscusForce(),),
        )
        whole = ck.divide_meniscus(scene, (1,))
        most = whole.max_stable_count
        counts = sorted({max(round(most * i / 200), 1) for i in range(1, 201)})
        force = ck.divide_meniscus(scene, counts).meniscus_force
        top = int(force.argmax())
        one, last = float(whole.meniscus_force[0]), float(force[-1])
        rows.append(
            (
                f"{lower}/{upper}",
                f"{most}",
                f"{counts[top] / most:.2f}",
                f"{float(force[top]) / one:.3f}",
                f"{last / one:.3f}",
            )
        )
    head = ("angles [deg]", "N_max", "greatest force at N/N_max", "over one", "at N_max, over one")
    return grid(head, rows)


def nano_table() -> str:
    """The sphere of section 3.2.3: volumes, breaks and mean viscous forces, by this code."""
    radius, gap, angle, duration, viscosity = 100e-9, 1e-9, math.pi / 3, 1e-7, 0.89e-3
    shape = (angle, angle, 0.0, 1.0 / radius)
    rows = []
    for s0, far, force in zip(
        (2, 3, 4, 5, 6), (39, 58, 73, 87, 99), (0.1976, 0.4826, 0.7487, 0.9861, 1.1974), strict=True
    ):
        circle = math.sqrt(2.0 * radius * (s0 * 1e-9 - gap))
        volume = arc_sphere.volume(gap, circle, *shape, profile="parabola")
        end = float(arc_sphere.zero_neck_gap(volume, *shape, profile="parabola"))

        def neck(at: float, volume: float = volume) -> float:
            return float(arc_sphere.solve(at, volume, *shape, profile="parabola").neck)

        almost = brentq(lambda at: neck(at) - 0.55e-9, gap, end * (1.0 - 1e-9))
        impulse = squeeze.sphere_impulse_conserved(radius, s0 * 1e-9, gap, far * 1e-9, viscosity)
        rows.append(
            (
                f"{s0}",
                f"{volume * 1e27:.2f}",
                f"{far}",
                f"{end * 1e9:.3f}",
                f"{almost * 1e9:.2f}",
                f"{neck(far * 1e-9) * 1e9:.3f}",
                f"{force:.4f}",
                f"{impulse / duration * 1e9:.5f}",
            )
        )
    head = (
        "s0 [nm]",
        "volume [nm3]",
        "printed break, unit put right [nm]",
        "neck 0 at [nm]",
        "neck 0.55 nm at [nm]",
        "neck at the printed break [nm]",
        "printed mean viscous force [nN]",
        "recomputed [nN]",
    )
    return grid(head, rows)


def nano_force_table() -> str:
    """Meniscus force on the same sphere at the start: the arc, and as published."""
    radius, angle, tension = 100e-9, math.pi / 3, 0.072
    shape, exact = (angle, angle, 0.0, 1.0 / radius), (22.51, 28.64, 31.19, 32.38, 32.95)
    rows = []
    for s0, right in zip((2, 3, 4, 5, 6), exact, strict=True):
        circle = math.sqrt(2.0 * radius * (s0 - 1.0) * 1e-9)
        volume = arc_sphere.volume(1e-9, circle, *shape, profile="parabola")
        state = arc_sphere.solve(1e-9, volume, *shape, profile="parabola")
        arc = tension * float(state.force) * 1e9
        printed = float(np.asarray(published.meniscus_sphere_3_12(state, tension, angle))) * 1e9
        off = [f"{100.0 * (force / right - 1.0):+.1f}" for force in (arc, printed)]
        rows.append((f"{s0}", f"{right:.2f}", f"{arc:.2f}", off[0], f"{printed:.2f}", off[1]))
    head = (
        "s0 [nm]",
        "exact [nN]",
        "arc [nN]",
        "off by [%]",
        "Eq. (3.12) as printed [nN]",
        "off by [%]",
    )
    return grid(head, rows)


def _reference(group: str) -> list[dict[str, Any]]:
    text = (DOCS.parent / "tests" / "data" / "separation.json").read_text("utf-8")
    cases: list[dict[str, Any]] = json.loads(text)[group]
    return cases


def _bodies(case: Mapping[str, Any]) -> str:
    curved = sum(case[key] > 0.0 for key in ("kappa1", "kappa2"))
    return ("flats", "sphere on flat", "two spheres")[curved]


def _shape(case: Mapping[str, Any]) -> tuple[float, float, float, float]:
    angles = math.radians(case["theta1_deg"]), math.radians(case["theta2_deg"])
    return (*angles, case["kappa1"], case["kappa2"])


def exact_table() -> str:
    """Force of the arc against the exact bridge, with the published one between flats."""
    rows = []
    for case in _reference("exact_bridge"):
        shape, gap, volume = _shape(case), case["D"], case["V"]
        right = case["F_over_gamma"]
        state = bridge_arc.arc_bridge(gap, volume, *shape)
        forces = [float(state.force)]
        if _bodies(case) == "flats":
            radius = float(state.radius_lower)
            forces.append(float(published.meniscus_flat_3_11(radius, gap, 1.0, *shape[:2])))
        off = [f"{100.0 * (force - right) / abs(right):+.2f}" for force in forces]
        where = f"{case['theta1_deg']:g}/{case['theta2_deg']:g}", f"{volume:g}", f"{gap:.3g}"
        rows.append((_bodies(case), *where, f"{right:.6g}", *off, *[""] * (2 - len(off))))
    head = ("bodies", "angles [deg]", "volume", "gap", "exact force", "arc [%]", "Eq. (3.11) [%]")
    return grid(head, rows)


def limit_table() -> str:
    """Gap at which the neck of the arc closes, against the exact limit of stability."""
    rows = []
    for case in _reference("exact_limit"):
        angles = f"{case['theta1_deg']:g}/{case['theta2_deg']:g}"
        end = float(arc_sphere.zero_neck_gap(case["V"], *_shape(case)))
        limit = case["D_limit"]
        rows.append(
            (
                _bodies(case),
                angles,
                f"{case['V']:g}",
                f"{limit:.4f}",
                f"{end:.4f}",
                f"{end / limit:.1f}",
            )
        )
    head = ("bodies", "angles [deg]", "volume", "exact limit", "neck of the arc closes", "ratio")
    return grid(head, rows)
