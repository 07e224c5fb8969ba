"""Tables of menisci: how many are best, and the arc against the exact bridge."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import contactkit as ck
from contactkit.capillary.arc import sphere as arc_sphere

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
                f"{printed.best_count} / {exact.best_count}",
                f"{exact.max_stable_count}",
                " / ".join(f"{area:.3f}" for area in areas),
            )
        )
    head = (
        "$h_0$ [nm]",
        "optimal $N$, printed / exact",
        "maximum stable $N$",
        "critical area, printed / exact [µm²]",
    )
    return grid(head, rows)


def _reference(group: str) -> list[dict[str, Any]]:
    text = (DOCS.parent / "tests" / "data" / "separation.json").read_text("utf-8")
    cases: list[dict[str, Any]] = json.loads(text)[group]
    return cases


def _bodies(case: Mapping[str, Any]) -> str:
    curved = sum(case[key] > 0.0 for key in ("kappa1", "kappa2"))
    return ("flats", "sphere on flat", "two spheres")[curved]


def _angles(case: Mapping[str, Any]) -> str:
    return f"{case['theta1_deg']:g}/{case['theta2_deg']:g}°"


def _shape(case: Mapping[str, Any]) -> tuple[float, float, float, float]:
    angles = math.radians(case["theta1_deg"]), math.radians(case["theta2_deg"])
    return (*angles, case["kappa1"], case["kappa2"])


def limit_table() -> str:
    """Gap at which the neck of the arc closes, against the exact limit of stability."""
    rows = []
    for case in _reference("exact_limit"):
        end = float(arc_sphere.zero_neck_gap(case["V"], *_shape(case)))
        limit = case["D_limit"]
        where = f"{_bodies(case)}, {_angles(case)}, {case['V']:g}"
        rows.append((where, f"{limit:.4f}", f"{end:.4f}", f"{end / limit:.1f}"))
    head = ("bodies, angles, volume", "exact limit", "neck of the arc closes", "ratio")
    return grid(head, rows)
