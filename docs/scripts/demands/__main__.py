"""Measure, and write the pages: ``python docs/scripts/demands [PAGE ...] [--draw]``.

Without names all pages, some minutes; ``--draw`` makes pages and pictures from the committed data
without measuring. `make pages PAGES=demands` is the same.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from contactkit.errors import ValidityWarning
from demands import PAGES
from demands.page import SHOWN, load, store, write


def main() -> int:
    """Write the pages that are asked for."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("pages", nargs="*", metavar="PAGE", help=f"of {', '.join(PAGES)}")
    ask.add_argument("--draw", action="store_true", help="from the committed data")
    given = ask.parse_args()
    if unknown := sorted(set(given.pages) - set(PAGES)):
        ask.error(f"no page {', '.join(unknown)}; there are {', '.join(PAGES)}")
    warnings.simplefilter("ignore", ValidityWarning)  # what is hard is often out of range
    for name in given.pages or PAGES:
        module = PAGES[name]()
        if not given.draw:
            sys.stdout.write(f"measuring {name}\n")
            store(name, module.measure())
        data = load(name)
        write(SHOWN / f"{name}.md", module.page(data))
        module.draw(data)
        sys.stdout.write(f"{SHOWN / name}.md\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
