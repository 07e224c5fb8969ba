"""Tornado figures of the devices: ``python docs/scripts/sensitivity.py``.

Sweeps the assumptions of the fuel injector, the micromirror and the head on the disk over the
ranges of `models/*/assumptions.py`. Writes figures to
``docs/img/``, every answer as CSV to ``docs/img/data/``, and tables where a page has them. Minutes;
``--draw`` draws the kept answers again.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable, Mapping
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

from matplotlib.ticker import MaxNLocator, PercentFormatter
from measured_blocks import write_blocks
from PIL import Image
from validation_tables import grid

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.models.head_disk import assumptions as head_disk
from contactkit.models.injector import assumptions as injector
from contactkit.models.injector.delays import closing_lag, residual_gap, sticking_time
from contactkit.models.micromirror import assumptions as micromirror
from contactkit.models.micromirror.release import humidity_limit, voltage_needed
from contactkit.plot.axis_units import in_prose
from contactkit.plot.style import save
from contactkit.scene.description import value_text
from contactkit.studies.paths import value_at
from contactkit.studies.sensitivity import Influence, Sensitivity

IMG = Path(__file__).parents[1] / "img"
DISK = {
    "contact_fraction": "real area of contact, fraction of the window",
    "plastic_fraction": "plastic area, fraction of the window",
    "meniscus_force": "force of the menisci [mN]",
}
SHOWN = 0.02  # of the largest finite change; the table leaves out what moves the answer less


class Case(NamedTuple):
    """A tornado figure: scene, ranges, the answer, its unit, and what it means to have none."""

    scene: Any
    ranges: Mapping[str, ck.Range]
    names: Mapping[str, str]
    answer: str | Callable[[Any], float]
    unit: str | None
    missing: str
    accuracy: ck.Accuracy | None = None
    n: int = 5
    heading: str = ""

    @property
    def percent(self) -> bool:
        """Whether the answer is a fraction, to be read in per cent."""
        return isinstance(self.answer, str) and self.answer.endswith("fraction")


def cases() -> dict[str, Case]:
    """Tornado figures by the names of their files."""
    valve = open_scene("fuel-injector").scene
    late = injector.sustaining(valve)
    mirror = open_scene("micromirror").scene
    ranges, held, names = injector.RANGES, injector.RANGES_SUSTAINED, injector.NAMES
    never = "never released"
    humid = "relative humidity at which the springs alone fail"
    tips = (micromirror.RANGES, micromirror.NAMES)
    return {
        "injector-sticking": Case(valve, ranges, names, sticking_time, "s", never),
        "injector-sticking-sustained": Case(late, held, names, sticking_time, "s", never),
        "injector-closing": Case(valve, ranges, names, closing_lag, "s", "never opened"),
        "injector-standoff": Case(valve, ranges, names, residual_gap, "m", ""),
        "mirror-voltage": Case(mirror, *tips, voltage_needed, "V", "no voltage"),
        "mirror-humidity": Case(mirror, *tips, humidity_limit, "-", "sticks dry", heading=humid),
        **{f"disk-{answer.replace('_', '-')}": _disk(answer) for answer in DISK},
    }


def _disk(answer: str) -> Case:
    """A number of the contact of head and disk; the ends of each range alone, 2 s each."""
    device = open_scene("head-disk")
    lean = head_disk.without_stresses(device.scene)
    ranges, names = head_disk.RANGES, head_disk.NAMES
    return Case(lean, ranges, names, answer, None, "", device.accuracy, 2, DISK[answer])


def table(found: Sensitivity, names: Mapping[str, str]) -> str:
    """Assumptions with their ranges, and the answers at both ends."""
    swings = [one.swing(found.base) for one in found.influences if not one.has_gaps]
    least = SHOWN * max(swings)

    def text(answer: float) -> str:
        return "none" if answer != answer else value_text(answer, found.quantity_unit)

    rows = [
        (
            names[one.path],
            f"{value_text(one.values[0], one.unit)} ... {value_text(one.values[-1], one.unit)}",
            f"{text(one.results[0])} ... {text(one.results[-1])}",
        )
        for one in found.influences
        if one.swing(found.base) >= least
    ]
    rest = [names[one.path] for one in found.influences if one.swing(found.base) < least]
    below = f"\n\nLess than {SHOWN:.0%} of the largest: {', '.join(rest)}." if rest else ""
    table = grid(("assumption", "range", "answer"), rows)
    return in_prose(f"As it is: {text(found.base)}.\n\n{table}{below}")


def kept(name: str, one: Case) -> Sensitivity:
    """The answers that were written into docs/img/data."""
    with (IMG / "data" / f"tornado-{name}.csv").open(newline="", encoding="utf-8") as file:
        heads, (_, _, _, base, *_), *rows = csv.reader(file)
    quantity, _, unit = heads[3].removesuffix("]").rpartition(" [")
    influences = []
    for path, group in groupby(rows, key=itemgetter(0)):
        _, texts, units, results, messages, reasons = zip(*group, strict=True)
        found = Influence(
            path,
            units[0],
            value_at(one.scene, one.accuracy or ck.Accuracy(), path.partition(",")[0].strip()),
            tuple(float(text) if units[0] else text for text in texts),
            tuple(map(float, results)),
            messages,
            reasons[0],
        )
        influences.append(found)
    return Sensitivity(quantity, unit, float(base), tuple(influences))


def main() -> int:
    """Compute the cases named on the command line, or all; with ``--draw`` draw what is kept."""
    blocks = {}
    known = cases()
    is_drawn, names = "--draw" in sys.argv, [one for one in sys.argv[1:] if one != "--draw"]
    for name in names or known:
        one = known[name]
        if is_drawn:
            draw(kept(name, one), name, one)
            continue
        found = ck.sensitivity(
            one.scene, one.ranges, one.answer, one.accuracy, n=one.n, unit=one.unit
        )
        draw(found, name, one)
        found.save_csv(IMG / "data" / f"tornado-{name}")
        blocks[f"tornado {name}"] = table(found, one.names)
        sys.stdout.write(f"{found}\n\n")
    drawn_alone = [] if is_drawn else write_blocks(blocks)
    sys.stdout.write(f"without a table: {', '.join(drawn_alone) or 'none'}\n")
    return 0


def draw(found: Sensitivity, name: str, one: Case) -> None:
    """Draw a figure, small by a palette."""
    ax = found.plot.tornado(names=one.names, missing=one.missing, most=11)
    if one.heading:
        ax.set_xlabel(one.heading)
    if one.percent:
        ax.xaxis.set_major_locator(MaxNLocator(5))
        ax.xaxis.set_major_formatter(PercentFormatter(1.0))
    path = save(ax.figure, IMG / f"tornado-{name}")
    with Image.open(path) as figure:
        figure.convert("RGB").quantize(128, Image.Quantize.MAXCOVERAGE, 1).save(path, optimize=True)


if __name__ == "__main__":
    sys.exit(main())
