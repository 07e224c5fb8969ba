"""Write generated pages, tables and pictures of docs: ``python docs/scripts/pages.py [PAGE ...]``.

Without names all of them, some hours; ``--list`` prints what each writes and how long it takes.
`make pages` is the same, `make pages PAGES="films demands"` writes some. A page whose script fails
is named at the end, and the others are written.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

SCRIPTS = Path(__file__).parent
ROOT = SCRIPTS.parents[1]


class Page(NamedTuple):
    """Files that are written below docs/, the minutes it takes on one core, and the commands."""

    writes: str
    minutes: float
    commands: tuple[tuple[str, ...], ...]

    @property
    def scripts(self) -> tuple[str, ...]:
        """The script of each command, a file or a folder of docs/scripts."""
        return tuple(command[0] for command in self.commands)


def _measured(name: str) -> tuple[tuple[str, ...], ...]:
    return ((f"measure_{name}.py", "--write"),)


PAGES: Mapping[str, Page] = {
    "tables": Page(
        "tables of keys, ports, formulas and names on all pages", 0.2, (("tables.py",),)
    ),
    "architecture": Page("img/architecture.png", 0.1, (("architecture.py",),)),
    "injector": Page(
        "injector*.md, hosts.md: delays, errors of steps", 2, (("injector", "--write"),)
    ),
    "bridges": Page("bridges.md: errors of closures", 0.5, _measured("bridges")),
    "films": Page("img/: pictures of films.md", 0.5, (("film_pictures.py",),)),
    "deforming": Page(
        "img/deforming-pull.png; fmu-native.md: exactness of FMUs of deforming bodies",
        1,
        (("deforming",), ("deforming/fmus.py", "--write")),
    ),
    "gradients": Page("img/gradient-*.png", 0.2, (("gradients",),)),
    "adhesion": Page("adhesion.md: levels of a curve, and its picture", 5, _measured("adhesion")),
    "pictures": Page(
        "img/: figures of shipped scenes and examples; head-disk*.md",
        20,
        (("pictures.py",),),
    ),
    "sensitivity": Page(
        "img/tornado-*; injector.md, micromirror.md: their tables", 7, (("sensitivity.py",),)
    ),
    "demands": Page("demands/: accuracy and cost, hard cases, effects", 12, (("demands",),)),
    "peers": Page(
        "demands/: what `make bench` left in out/bench",
        0.2,
        (("demands/peers_data.py",), ("demands", "--draw", "accuracy-and-cost")),
    ),
    "large-maps": Page(
        "demands/: what tests/benchmarks/peers/large.py left in out/bench",
        0.2,
        (("demands/large_data.py",), ("demands", "--draw", "accuracy-and-cost")),
    ),
    "tutorials": Page("tutorials/: pages, figures and notebooks", 2, (("tutorials",),)),
    "gallery": Page(
        "gallery/: all pages at full size, kept in out/gallery", 240, (("gallery.py",),)
    ),
}


def listed() -> str:
    """Names with minutes and what is written, a line for each."""
    width = max(map(len, PAGES))
    return "\n".join(f"{n:{width}s} {p.minutes:6g} min  {p.writes}" for n, p in PAGES.items())


def write(name: str) -> bool:
    """Run the commands of a page; whether all of them succeeded."""
    begun = time.perf_counter()
    done = all(
        subprocess.run(
            [sys.executable, str(SCRIPTS / script), *more], cwd=ROOT, check=False
        ).returncode
        == 0
        for script, *more in PAGES[name].commands
    )
    minutes = (time.perf_counter() - begun) / 60.0
    sys.stdout.write(f"{name}: {'written' if done else 'FAILED'}, {minutes:.1f} min\n")
    return done


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the pages that are named, or all."""
    ask = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    ask.add_argument("pages", nargs="*", metavar="PAGE", help="of those of --list")
    ask.add_argument("--list", action="store_true", help="print names, minutes and what is written")
    given = ask.parse_args(arguments)
    if unknown := [name for name in given.pages if name not in PAGES]:
        ask.error(f"there is no page {', '.join(unknown)}; there are\n{listed()}")
    if given.list:
        sys.stdout.write(f"{listed()}\n")
        return 0
    failed = [name for name in given.pages or PAGES if not write(name)]
    if failed:
        sys.stderr.write(f"failed: {', '.join(failed)}\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
