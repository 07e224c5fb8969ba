"""Page of accuracy and cost: error over CPU time of every solver and scene, and of peers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from contactkit.benchmarks.separation_studies import PRESETS
from contactkit.benchmarks.table import STUDIES
from contactkit.work_precision import Point

from .page import conditions, load, machine, number, picture, table
from .presets import presets_of

__all__ = ["ANALYSES", "NAME", "draw", "measure", "page"]

NAME = "accuracy-and-cost"
DEVICES = ("fuel-injector", "micromirror", "bridges")
ANALYSES: Mapping[str, tuple[str, str]] = {
    "adhesion_curve": ("roots to 1e-13", "tests/adhesion/test_adhesion_values.py"),
    "critical_meniscus": ("a root to round-off", "tests/capillary/test_division.py"),
    "divide_meniscus": ("closed forms", "tests/capillary/test_division.py"),
    "divide_sliding": ("a scene, exact", "tests/separation/sliding/test_sliding_scenes.py"),
    "humidity_curve": ("bridges to 1e-12", "tests/capillary/test_humidity.py"),
    "load_displacement": (
        "solves of `load_curve`, with a monotone interpolation whose error it reports",
        "tests/contact/effects/test_plastic_history.py",
    ),
    **dict.fromkeys(
        ("pull_off_over_speed", "release_over", "stiction_table"),
        (
            "runs of `simulate`, each with its own error",
            "tests/analyses/test_deforming_analyses.py",
        ),
    ),
    "modulus_curve": (
        "three meshes, extrapolated: 4e-5",
        "tests/lubrication/elastohydrodynamic/test_reference_cases.py",
    ),
    "stream_study": (
        "points of `study`, one by one",
        "tests/studies/test_study_stream.py",
    ),
    "stick_slip": ("closed forms of each phase", "tests/contact/slip/test_stick_slip.py"),
}
"""Public functions on scenes and plans without a tolerance of their own."""
_PEERS = ("aspher", "SlipPY", "tamaas", "ContactMechanics")


def measure() -> dict[str, Any]:
    """Measure scenes and solvers; the peers are measured by `make bench`."""
    return {
        "measured": machine(),
        "presets": presets_of(),
        "studies": {name: points_of(name) for name in STUDIES},
    }


def points_of(name: str) -> list[dict[str, Any]]:
    """Measure a study of the table; points as data, with seconds where these are compared."""
    study = STUDIES[name]
    return [_as_data(point, study.is_timed) for point in study.points()]


def _as_data(point: Point, is_timed: bool) -> dict[str, Any]:
    return {
        "method": point.method,
        "setting": point.label,
        "error": point.error if math.isfinite(point.error) else None,
        "seconds": point.seconds if is_timed and math.isfinite(point.seconds) else None,
        "counts": dict(point.counts),
        "is_model": point.is_model,
    }


def page(data: Mapping[str, Any]) -> str:
    """The page as Markdown."""
    parts = [
        "# Accuracy and cost",
        "What a digit of accuracy costs in CPU time, for every solver and every shipped scene, and "
        "for other programs on the same problems. *Error* is relative, against the solution named "
        "above each table; it is that of the numerics. Whether a model holds is another matter: "
        "each result prints its ranges of validity.",
        "![Error over CPU time: solvers of a contact, a film, presets, other programs]"
        f"({NAME}.png)",
        "## Presets",
        "`Accuracy.draft`, `Accuracy.standard` (without a choice) and `Accuracy.reference`: error "
        "and CPU seconds of plan and run. The last columns are what the grid of the scene leaves, "
        "by `discretisation_error`: where they are larger than the error of the tolerance, a finer "
        "grid helps and a tighter tolerance does not. The pressures of `tip-landing` are the "
        "same to the last bit: 99 % of the pixels in contact are at the hardness.",
        _presets(data["presets"]),
        "The devices (`fuel-injector`, `micromirror`) are governed by their communication step and "
        "the bridges by their profile: see below.",
        "## Solvers",
        *(_study(name, data["studies"][name]) for name in STUDIES),
        "## Without a tolerance",
        "These are closed forms, roots to round-off, or solves of the functions above.",
        table(
            ("function", "its numbers are", "error kept by"),
            ((f"`{name}`", what, f"`{test}`") for name, (what, test) in ANALYSES.items()),
        ),
        *_peers(load("peers")),
        "## How it was made",
        "`make pages PAGES=demands` measures everything but other programs, which `make bench` "
        "does (`docs/demands/peers.json`); `python docs/scripts/demands accuracy-and-cost --draw` "
        "makes the page from the data, `docs/demands/accuracy-and-cost.json`. `contactkit cost "
        "NAME` measures a study of this page (`contactkit/benchmarks/table.py`) or a scene of "
        "yours. [More on accuracy](../accuracy.md) explains the solvers and their errors.",
        conditions(data["measured"]),
    ]
    return "\n\n".join(parts) + "\n"


def _presets(found: Mapping[str, Any]) -> str:
    rows = []
    for name, one in found.items():
        cells = [cell for label in PRESETS for cell in _pair(one[label])]
        grid = one.get("grid") or {}
        cells += [number(grid.get(key)) for key in ("max_pressure", "contact_area")]
        rows.append((name, one["quantity"], *cells))
    heads = [cell for label in PRESETS for cell in (label, "seconds")]
    grids = ("grid: maximum pressure", "grid: contact area")
    return table(("scene", "error of the", *heads, *grids), rows)


def _pair(point: Mapping[str, Any]) -> tuple[str, str]:
    return number(point["error"]), _seconds(point["seconds"])


def _seconds(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.2g}" if value >= 1e-3 else f"{value:.1e}"


def _study(name: str, points: list[dict[str, Any]]) -> str:
    study = STUDIES[name]
    rows = []
    for p in points:
        counts = ", ".join(f"{n} {unit}" for unit, n in p["counts"].items())
        method = p["method"] + (" (another model)" if p["is_model"] else "")
        error = "refused" if p["error"] is None else number(p["error"])
        rows.append((method, p["setting"], error, _seconds(p["seconds"]), counts))
    heads = ("method", "setting", "error", "CPU seconds", "work")
    used = ", ".join(f"`{one}`" for one in study.solvers)
    text = f"For {used}; error against {study.judge}. `contactkit cost {name}` measures it."
    return "\n\n".join((f"### {study.title}", text, table(heads, rows)))


def _peers(found: Mapping[str, Any]) -> list[str]:
    """Sections on other programs."""
    features = [
        (
            row["what"],
            str(row["n"]),
            "-" if row["convolutions"] is None else str(row["convolutions"]),
            _seconds(row["seconds"]),
            number(row["error"]),
            row["peer"],
            _seconds(row["peer_seconds"]),
            number(row["peer_error"]),
            f"{'> ' * row['is_bound']}{row['peer_seconds'] / row['seconds']:.1f}",
        )
        for row in found["features"]["rows"]
    ]
    contacts = [
        (
            f"{row['surface']}, {row['edges']}",
            *(str(row[key]) for key in ("n", "area", "threads", "convolutions")),
            _seconds(row["plain"]),
            _seconds(row["fast"]),
            *(_seconds(row["peers"].get(peer)) for peer in _PEERS),
        )
        for row in found["contacts"]["rows"]
    ]
    setup = [
        (
            f"{row['surface']}, {row['edges']}",
            str(row["n"]),
            *(_seconds(row[key]) for key in ("plain", "fast", "aspher")),
            f"{row['aspher'] / row['plain']:.1f}",
            f"{row['aspher'] / row['fast']:.1f}",
        )
        for row in found["with_setup"]["rows"]
    ]
    heads = ("what", "pixels a side", "convolutions", "CPU s", "error", "peer", "its CPU s")
    case = ("surface, edges", "pixels a side")
    more = ("contact [%]", "threads", "convolutions", "plain", "fast")
    return [
        "## Other programs",
        "The same contacts by tamaas, SlipPY, aspher, ContactMechanics and reynoldsflow, all from "
        "PyPI. Errors are violations of the conditions of contact or slip, by an independent "
        "operator, over the rms roughness; those of leakage the difference of both fluxes. "
        f"{found['features']['conditions'][0].upper()}{found['features']['conditions'][1:]}.",
        table((*heads, "its error", "its seconds over ours"), features),
        "Single rough contacts, CPU seconds of the solve alone; *fast* is with numba and ducc0. "
        "Seconds of peers follow from ratios of two digits. A dash: not run, or not accurate "
        f"enough. {found['contacts']['conditions']}.",
        table((*case, *more, *_PEERS), contacts),
        f"With set-up, CPU seconds: {found['with_setup']['conditions']}. The goals (2 everywhere "
        "without `fast`; with it 3 at 256 pixels and 5 from 512 on) are missed on periodic maps "
        "of 256, and of 512 with `fast`.",
        table((*case, "plain", "fast", "aspher", "aspher / plain", "aspher / fast"), setup),
    ]


# Picture ----------------------------------------------------------------------------------------

_COLOURS = ("#1f4e79", "#c1440e", "#2a9d8f", "#e9a23b", "#6a4c93")
_MARKS = "os^Dv"


def _curves(ax: Any, points: list[dict[str, Any]]) -> None:
    """Error over seconds, a line for each method; other models are left out."""
    methods = dict.fromkeys(p["method"] for p in points if not p["is_model"])
    for method, colour, mark in zip(methods, _COLOURS, _MARKS, strict=False):
        some = [p for p in points if p["method"] == method and p["error"] and p["seconds"]]
        xs, ys = [p["seconds"] for p in some], [p["error"] for p in some]
        ax.plot(xs, ys, color=colour, marker=mark, ms=5, label=method)


def draw(data: Mapping[str, Any]) -> None:
    """Contact, film, presets, peers."""
    from contactkit.plot import style as plot

    made, axes = plot.figure(2, 2, size=(10.5, 8.4))
    _curves(axes[0, 0], data["studies"]["contact-methods"])
    _curves(axes[0, 1], data["studies"]["film"])
    for (name, one), colour, mark in zip(data["presets"].items(), _COLOURS, _MARKS, strict=False):
        points = [one[label] for label in PRESETS]
        xs, ys = [p["seconds"] for p in points], [max(p["error"], 1e-16) for p in points]
        axes[1, 0].plot(xs, ys, color=colour, marker=mark, ms=5, label=name)
    for row in load("peers")["features"]["rows"]:
        if row["peer_error"] is None:
            continue
        ends = [row["seconds"], row["peer_seconds"]], [row["error"], row["peer_error"]]
        axes[1, 1].plot(*ends, color="0.8", lw=1.0, zorder=1)
        axes[1, 1].plot(ends[0][0], ends[1][0], "o", color=_COLOURS[0], ms=5)
        axes[1, 1].plot(ends[0][1], ends[1][1], "s", color=_COLOURS[1], ms=5)
    axes[1, 1].plot([], [], "o", color=_COLOURS[0], label="contactkit")
    axes[1, 1].plot([], [], "s", color=_COLOURS[1], label="other program, same problem")
    titles = (
        "(a) rough contact, 256 x 256: pressure",
        "(b) film: release time",
        "(c) scenes: draft, standard, reference",
        "(d) other programs",
    )
    for ax, title in zip(axes.flat, titles, strict=True):
        ax.set(xscale="log", yscale="log", xlabel="CPU time [s]", ylabel="relative error")
        plot.title(ax, title)
        plot.legend(ax, fontsize=8)
    plot.plain_log(axes[0, 1].xaxis)
    picture(made, NAME)
