"""Page of accuracy and cost: what a digit more costs, error over CPU time of every study, peers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from contactkit.benchmarks.table import STUDIES, AccuracyStudy
from contactkit.plot.axis_units import in_prose
from contactkit.work_precision import Point

from .page import conditions, folded, load, machine, number, picture, table

__all__ = ["ANALYSES", "NAME", "digit", "draw", "measure", "page", "points_of", "shown"]

NAME = "accuracy-and-cost"
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

Points = Sequence[Mapping[str, Any]]

# What the picture of a half shows, left over tolerances and right over grids and steps: study,
# method, name in the picture.
_CURVES: Mapping[str, tuple[Sequence[tuple[str, str, str]], ...]] = {
    "contact": (
        (
            ("contact-methods", "active-set", "rough contact (default method)"),
            ("contact-methods", "conjugate-gradient", "the same by conjugate gradients"),
            ("contact-presets", "head-disk", "head-disk scene, presets"),
            ("curve", "maximum pressure", "curve of 20 loads"),
            ("slip", "tolerance at 64 x 64", "partial slip"),
        ),
        (
            ("hertz", "maximum pressure", "sphere: maximum pressure"),
            ("lines", "cylinder, one-axis window", "cylinder: maximum pressure"),
            ("contact-area", "edge-corrected area", "rough contact: area"),
            ("adhesion", "Maugis parameter 1", "sphere: pull-off"),
            ("slip", "grid, to Mindlin", "sphere: partial slip"),
        ),
    ),
    "separation": (
        (
            ("film", "contactkit motion", "film of the README"),
            ("film", "monolithic, scipy Radau", "the same by scipy"),
            ("releases", "case B", "cold film, presets"),
            ("releases", "case D", "film of 10 nm, presets"),
            ("releases", "case E", "film with a tension limit, presets"),
        ),
        (
            ("film-faces", "disc under a dome", "film on a face: force"),
            ("film-cavities", "3 times the onset", "cavity on a face: force"),
            ("injector-release", "FMU pair, pull a straight line", "injector, pair of FMUs"),
            ("mirror-release", "tips in this process", "micromirror, tips"),
            ("fmu-releases", "case B", "cold film, FMU in a host"),
        ),
    ),
}
_PANELS = {
    "contact": ("(a) over the tolerance", "(b) over the grid"),
    "separation": ("(a) over the tolerance", "(b) over cells or communication steps"),
}


def measure() -> dict[str, Any]:
    """Measure all studies; the peers are measured by `make bench`."""
    return {"measured": machine(), "studies": {name: points_of(name) for name in STUDIES}}


def points_of(name: str) -> list[dict[str, Any]]:
    """Measure a study of the table; points as data."""
    return [_as_data(point) for point in STUDIES[name].points()]


def _as_data(point: Point) -> dict[str, Any]:
    return {
        "method": point.method,
        "setting": point.label,
        "error": point.error if math.isfinite(point.error) else None,
        "seconds": point.seconds if math.isfinite(point.error) else None,
        "counts": dict(point.counts),
        "is_model": point.is_model,
    }


def shown(points: Points) -> list[Point]:
    """The points of a study from data, errors that are missing as nan."""
    nan = math.nan
    return [
        Point(
            p["method"],
            p["setting"],
            nan if p["error"] is None else p["error"],
            nan if p["seconds"] is None else p["seconds"],
            p["counts"],
            is_model=p["is_model"],
        )
        for p in points
    ]


def _curve(points: Points, method: str) -> tuple[np.ndarray, np.ndarray]:
    """Seconds and errors of a method, where it has both."""
    some = [p for p in points if p["method"] == method and p["error"] and p["seconds"]]
    return np.array([p["seconds"] for p in some]), np.array([p["error"] for p in some])


def digit(points: Points, method: str) -> float:
    """Factor of the CPU time for one digit more, by least squares through the logarithms."""
    seconds, errors = _curve(points, method)
    return float(10.0 ** np.polyfit(-np.log10(errors), np.log10(seconds), 1)[0])


def _costs(factor: float) -> str:
    """A factor of the CPU time in words."""
    if factor < 1.95:
        return f"{max(100.0 * (factor - 1.0), 0.0):.0f} % more"
    return f"{factor:.0f} times" if factor > 9.5 else f"{factor:.1f} times"


def _span(points: Points, method: str) -> str:
    """From which error at which cost to which a method goes."""
    seconds, errors = _curve(points, method)
    return ", ".join(_at(errors[i], seconds[i]) for i in (np.argmax(errors), np.argmin(errors)))


def _contact(studies: Mapping[str, Points]) -> str:
    rough, sphere = studies["contact-methods"], studies["hertz"]
    return (
        "**Contact: a digit more of the pressure of a rough contact costs "
        f"{_costs(digit(rough, 'active-set'))} CPU time** on its grid "
        f"({_span(rough, 'active-set')}, 256 x 256 pixels); a digit more against the exact "
        "solution is bought with pixels, at "
        f"{_costs(digit(sphere, 'maximum pressure'))} the CPU time "
        f"(sphere: {_span(sphere, 'maximum pressure')})."
    )


def _separation(studies: Mapping[str, Points]) -> str:
    film, grid = studies["film"], studies["film-faces"]
    return (
        "**Separation: a digit more of the release time of a film costs "
        f"{_costs(digit(film, 'contactkit motion'))} CPU time** "
        f"({_span(film, 'contactkit motion')}); where the film is on a grid, a digit more of its "
        f"force costs {_costs(digit(grid, 'disc under a dome'))} the CPU time "
        f"({_span(grid, 'disc under a dome')})."
    )


def page(data: Mapping[str, Any]) -> str:
    """The page as Markdown."""
    studies, peers = data["studies"], load("peers")
    parts = [
        "# Accuracy and cost",
        _contact(studies),
        f"![Contact: error over CPU time, over the tolerance and over the grid]({NAME}.png)",
        _separation(studies),
        "![Separation: error over CPU time, over the tolerance and over cells or steps]"
        f"({NAME}-separation.png)",
        _peer_sentence(peers),
        "*Error* is relative, and that of the numerics; whether a model holds, each result prints "
        "with its ranges of validity. *Seconds* are CPU time on one thread. A digit's cost is the "
        "slope of the logarithms over all settings of a method; where there is none, the settings "
        "are solids, shapes or sizes. `contactkit cost NAME` measures a study and prints every "
        f"setting (as in the [data]({NAME}.json)), `contactkit cost FILE` a scene of yours. "
        "[Why the errors are what they are](../accuracy.md).",
    ]
    for half in ("contact", "separation"):
        some = [(one, studies[name]) for name, one in STUDIES.items() if one.half == half]
        head = ("study: error of, against", "largest and least error", "a digit more")
        notes = [f"- `{one.name}`: {one.note}" for one, _ in some if one.note]
        parts += [f"## {half.capitalize()}", table(head, (_summary(*each) for each in some))]
        parts.append("\n".join(notes))
    parts += [
        *_peers(peers),
        *_large(load("large-maps")),
        "## Functions without a tolerance",
        "\n".join(f"- {names}: {what}" for what, names in _untoleranced().items()),
        "## Measured",
        conditions(data["measured"]),
    ]
    return in_prose("\n\n".join(parts) + "\n")


def _untoleranced() -> Mapping[str, str]:
    """Functions of `ANALYSES`, by what their numbers are."""
    found: dict[str, list[str]] = {}
    for name, (what, _) in ANALYSES.items():
        found.setdefault(what, []).append(f"`{name}`")
    return {what: ", ".join(names) for what, names in found.items()}


def _seconds(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.2g}" if value >= 1e-3 else f"{value:.1e}"


def _summary(study: AccuracyStudy, points: Points) -> tuple[str, ...]:
    """A study: what its settings span, and what a digit costs where they buy digits."""
    title = f"`{study.name}`: {study.title}; {study.quantity} against {study.judge}"
    method = study.digits
    some = [p for p in points if p["error"] is not None and not p["is_model"]]
    some = [p for p in some if p["method"] == method and p["error"]] if method else some
    some.sort(key=lambda p: -p["error"])
    span = "; ".join(
        f"{_at(p['error'], p['seconds'])} ({p['setting']})" for p in (some[0], some[-1])
    )
    return title, span, _costs(digit(points, method)) if method else "-"


def _at(error: float, seconds: float) -> str:
    return f"{number(error)} in {_seconds(seconds)} s"


# Other programs ---------------------------------------------------------------------------------

_PEERS = ("aspher", "SlipPY", "tamaas", "ContactMechanics", "reynoldsflow")


def peer_ratios(found: Mapping[str, Any]) -> list[float]:
    """Seconds of the fastest accurate peer over ours, row by row."""
    return [ratio for ratio in map(peer_ratio, found["rows"]) if ratio is not None]


def peer_ratio(row: Mapping[str, Any]) -> float | None:
    """Seconds of the fastest accurate peer over ours; none if there is no such peer."""
    good = [peer["seconds"] for peer in row["peers"].values() if peer["is_good"]]
    return min(good) / row["seconds"] if good else None


def _peer_sentence(found: Mapping[str, Any]) -> str:
    ratios = peer_ratios(found)
    return (
        f"**Other programs take {min(ratios):.1f} to {max(ratios):.0f} times as long, "
        f"{np.median(ratios):.1f} times in the middle,** on {len(ratios)} problems that both "
        "solve: [the table](#other-programs)."
    )


def _peers(found: Mapping[str, Any]) -> list[str]:
    """The section on other programs."""
    rows = []
    for row in found["rows"]:
        ratio = peer_ratio(row)
        own = f"{_seconds(row['seconds'])} ({number(row['error'])})"
        over = "-" if ratio is None else f"{ratio:.1f}"
        rows.append((f"{row['what']}, {row['n']}", own, fastest(row["peers"]), over))
    return [
        "## Other programs",
        "The same problems by contactkit and by other programs from PyPI, side by side, in one "
        f"run ({found['conditions']}).",
        f"![CPU seconds of contactkit and of other programs, problem by problem]({NAME}-peers.png)",
        "CPU seconds on one thread, and in brackets the error: violation of the conditions of "
        "contact or slip, by an independent operator, over the rms roughness; of leakage the "
        "difference of both fluxes. *Other* is the fastest program that is accurate to 1e-8 "
        "(adhesion: 1e-6); *>*: none is, and it would take longer still. Rough contacts with "
        "set-up. Areas, forces and plastic volumes agree to six digits. For slip coupled to the "
        "pressure by Coulomb's law and for slip on layers no other package was found. "
        "[All programs, and contactkit without numba and ducc0](peers.json).",
        folded(
            "The table: seconds of both, and their ratio",
            table(("problem, pixels a side", "contactkit", "other", "times"), rows),
        ),
        *found["left_out"],
    ]


def _large(found: Mapping[str, Any]) -> list[str]:
    """The section on large maps."""
    rows = []
    for row in found["small"]:
        cells = [_beside(row.get(name)) for name in ("fast", "plain", "aspher")]
        over = "-"
        if "aspher" in row and "fast" in row:
            over = f"{row['aspher']['seconds'] / row['fast']['seconds']:.1f}"
        rows.append((f"{row['n']}, {row['boundary']}", *cells, over))
    whole: dict[tuple[int, str], dict[int, Mapping[str, Any]]] = {}
    for row in found["large"]:
        whole.setdefault((row["n"], row["boundary"]), {})[row["threads"]] = row
    return [
        "## Large maps",
        "A rough contact of 5 %, to 1e-8 of the rms roughness, in one run "
        f"({found['conditions']}). A *map* is 8 bytes for each pixel. CPU seconds on one thread "
        "with set-up, and in brackets the memory of the solver in maps:",
        table(("pixels a side", "contactkit", "without the extra", "aspher", "times"), rows),
        "A whole run on a file: it is read, planned and solved, and the result is kept, on one "
        "thread and on two. Memory is the largest resident size of the process over that of its "
        "imports. aspher states that it solves 16384 x 16384 isolated pixels; here "
        "[8192 x 8192 is the limit as delivered](../compared.md).",
        table(
            ("pixels a side", "wall time [s]", "two threads [s]", "gain", "memory", "in maps"),
            (_whole(*one) for one in whole.items()),
        ),
        *_LIMITS,
    ]


# Measured on 27 November 2026, CPU seconds of one thread by part: what limits the numbers above.
_LIMITS = (
    "**Threads.** Of the CPU time of a run on 2048 x 2048 pixels transforms take 47 % (isolated: "
    "64 %), loops over pixels 14 % (7 %), and the compliance 1 % (5 %): these are spread over the "
    "threads, each of which takes whole rows and strips of columns, so that a convolution of a "
    "large map is the same to the last bit on any number of them. The rest is serial: the file, "
    "the first touch of memory, sums and copies of maps. Two threads could gain 1.45 (1.6), and on "
    "idle cores gain what the table says: they take up to 15 % more CPU time together, for memory "
    "that they share and for the lock of Python between pieces, which were not told apart. Where "
    "`OMP_NUM_THREADS` holds ducc0 to one they gain less.",
    "**Single precision** carries most of the work at any tolerance: 28 of 32 convolutions of a "
    "periodic contact of 1024 x 1024 pixels to 1e-8, all of them to 1e-2. The four in double "
    "precision take 7 % of the time (isolated: 20 %), and their memory serves the others "
    "meanwhile. Without any the contact conditions can be met to 6e-7, which moves pressures by "
    "4e-6 of the largest; a contact to 1e-4 would take 3 % less time (13 %). It is not done: "
    "looser residuals reach the iterations around a contact, and one under attraction then "
    "differed by 6 % between two orientations of the same window.",
    "**256 x 256 pixels** at five times the speed of aspher would leave 9 ms. The transforms of "
    "28 convolutions, with those of coarser grids, and the set-up take as much: it would need "
    "fewer convolutions.",
)


def _beside(one: Mapping[str, Any] | None) -> str:
    return "-" if one is None else f"{_seconds(one['seconds'])} ({one['maps']:.1f})"


def _whole(case: tuple[int, str], by: Mapping[int, Mapping[str, Any]]) -> tuple[str, ...]:
    """Seconds on one and on two threads, their ratio, and the most memory of both."""
    done = {threads: row for threads, row in by.items() if "failed" not in row}
    wall = {threads: row["wall"] for threads, row in done.items()}
    gain = f"{wall[1] / wall[2]:.2f}" if {1, 2} <= set(wall) else "-"
    most = max(done.values(), key=lambda row: row["bytes"], default=None)
    memory = (
        ("-", "-") if most is None else (f"{most['bytes'] / 1e9:.2g} GB", f"{most['maps']:.1f}")
    )
    seconds = (_seconds(wall.get(threads)) for threads in (1, 2))
    return (f"{case[0]}, {case[1]}", *seconds, gain, *memory)


def fastest(peers: Mapping[str, Mapping[str, Any]]) -> str:
    """The fastest accurate peer, or the fastest of those that are not."""
    name, peer = min(peers.items(), key=lambda one: (not one[1]["is_good"], one[1]["seconds"]))
    error = "" if peer["error"] is None else f" ({number(peer['error'])})"
    return f"{name} {'' if peer['is_good'] else '> '}{_seconds(peer['seconds'])}{error}"


# Pictures ---------------------------------------------------------------------------------------


def draw(data: Mapping[str, Any]) -> None:
    """A picture of each half, and one of other programs."""
    _draw_half(data["studies"], "contact", NAME)
    _draw_half(data["studies"], "separation", f"{NAME}-separation")
    _draw_peers(load("peers")["rows"])


def _draw_half(studies: Mapping[str, Points], half: str, name: str) -> None:
    from contactkit.plot import style as plot

    made, axes = plot.figure(1, 2, size=(10.5, 5.2))
    for ax, curves, title in zip(axes, _CURVES[half], _PANELS[half], strict=True):
        for i, (study, method, label) in enumerate(curves):
            seconds, errors = _curve(studies[study], method)
            ax.plot(seconds, errors, label=label, **plot.series(i, ms=5))
        ax.set(xscale="log", yscale="log", xlabel="CPU time [s]", ylabel="relative error")
        plot.title(ax, title)
        plot.plain_log(ax.xaxis)
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), frameon=False, fontsize=9)
    picture(made, name)


def _draw_peers(rows: Iterable[Mapping[str, Any]]) -> None:
    from contactkit.plot import style as plot

    listed = list(rows)[::-1]
    made, ax = plot.figure(size=(9.5, 0.32 * len(listed) + 1.4))
    own, *others = plot.SERIES
    looks = dict(zip(_PEERS, others, strict=False))
    for y, row in enumerate(listed):
        ends = [row["seconds"], *(peer["seconds"] for peer in row["peers"].values())]
        ax.plot([min(ends), max(ends)], [y, y], color="0.85", lw=1.5, zorder=1)
        ax.plot(row["seconds"], y, "o", color=own[0], ms=6, zorder=3)
        for name, peer in row["peers"].items():
            colour, _, mark = looks[name]
            fill = colour if peer["is_good"] else "white"
            ax.plot(peer["seconds"], y, mark, color=colour, mfc=fill, ms=6, zorder=2)
    ax.plot([], [], "o", color=own[0], label="contactkit")
    for name, (colour, _, mark) in looks.items():
        ax.plot([], [], mark, color=colour, label=name)
    ax.plot([], [], "s", color="0.4", mfc="white", label="open: not accurate enough")
    ax.set_yticks(range(len(listed)), [f"{row['what']}, {row['n']}" for row in listed], fontsize=9)
    ax.set(xscale="log", xlabel="CPU time [s]")
    ax.grid(False, axis="y")
    plot.shared_legend(made, ax)
    picture(made, f"{NAME}-peers")
