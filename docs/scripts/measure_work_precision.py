"""Error over work of the solvers beyond a single contact: ``measure_work_precision.py --write``.

Partial slip, coupled slip, adhesion, loading history, load curve, line contact and sheets: error
against a closed form, or the finest setting where there is none, over convolutions (applications of
the operators). Prints the points; ``--write`` draws docs/img/work-precision-contact.png. Names
select some of the panels, which are printed only: ``... slip adhesion``. Some minutes.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping
from pathlib import Path

from PIL import Image

import contactkit as ck
from contactkit.benchmarks.table import STUDIES
from contactkit.plot import style as plot
from contactkit.work_precision import Point

PICTURE = Path(__file__).parents[1] / "img" / "work-precision-contact.png"
COLORS, MARKERS = ("#0077bb", "#ee7733", "#009988", "#cc3311"), "osD^"
TITLES = {  # of the panels, by the names of the studies
    "slip": "partial slip of a sphere: displacement",
    "coupled": "coupled slip of a pressed sphere",
    "adhesion": "adhesion: pull-off force of a sphere",
    "history": "plastic load cycle of a sphere",
    "curve": "load curve of a rough map",
    "lines": "maximum pressure (beside: convolutions)",
}
OVER_PIXELS = "lines"  # others are over convolutions
Lines = Mapping[str, list[Point]]


def lines_of(name: str) -> Lines:
    """Points of a study by method."""
    found: dict[str, list[Point]] = {}
    for point in STUDIES[name].points():
        found.setdefault(point.method, []).append(point)
    return found


def place(name: str, point: Point) -> tuple[float, str]:
    """Abscissa of a point, and the text beside it."""
    work = point.counts["convolutions"]
    if name == OVER_PIXELS:
        return float(point.label.split()[0]), f"{work}"
    return float(work), point.label


def draw(found: Mapping[str, Lines]) -> None:
    """Draw all panels."""
    figure, axes = plot.figure(2, 3, size=(14.0, 8.4))
    for ax, (name, curves) in zip(axes.flat, found.items(), strict=False):
        labelled = set()
        for (label, points), color, marker in zip(curves.items(), COLORS, MARKERS, strict=False):
            work = [place(name, p)[0] for p in points]
            error = [p.error for p in points]
            ax.plot(work, error, color=color, marker=marker, label=label)
            for point, offset in ((points[0], (7, 3)), (points[-1], (7, -11))):
                x, text = place(name, point)
                if (text, x) in labelled:
                    continue
                labelled.add((text, x))
                ax.annotate(
                    text,
                    (x, point.error),
                    xytext=offset,
                    textcoords="offset points",
                    color="0.3",
                    fontsize=8,
                )
        over = "pixels across the window" if name == OVER_PIXELS else "convolutions"
        ax.set(xscale="log", yscale="log", xlabel=over, ylabel="relative error")
        ax.margins(x=0.25, y=0.12)
        plot.plain_log(ax.xaxis)
        plot.title(ax, TITLES[name])
        plot.legend(ax, loc="best", fontsize=8)
    plot.letters(axes.flat)
    plot.save(figure, PICTURE)
    with Image.open(PICTURE) as drawn:
        small = drawn.convert("RGB").quantize(64, dither=Image.Dither.NONE)
    small.save(PICTURE, optimize=True)


def main(asked: list[str]) -> int:
    """Measure, print and draw."""
    names = [name for name in asked if name != "--write"] or list(TITLES)
    if unknown := sorted(set(names) - set(TITLES)):
        raise SystemExit(f"there is no {', '.join(unknown)}; there are {', '.join(TITLES)}")
    found = {}
    for name in names:
        found[name] = lines_of(name)
        for label, points in found[name].items():
            row = "; ".join(f"{p.label}: {p.counts['convolutions']}, {p.error:.1e}" for p in points)
            sys.stdout.write(f"{name}, {label}: {row}\n")
            sys.stdout.flush()
    if "--write" in asked and set(names) == set(TITLES):  # one picture of all panels
        draw(found)
    return 0


if __name__ == "__main__":
    warnings.simplefilter("ignore", ck.ValidityWarning)
    sys.exit(main(sys.argv[1:]))
