"""Measure the injector, and write docs/injector.md and docs/hosts.md with ``--write``.

Two minutes, and a C compiler. Names select some of the tables.
"""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from measured_blocks import measure

from contactkit.errors import ValidityWarning
from injector import coupling, delays

TABLES = {
    "hosts": coupling.hosts,
    "oils": delays.oils_table,
    "pressures": delays.pressure_table,
    "closing": delays.closing_table,
    "refilling": delays.refilling_table,
}

if __name__ == "__main__":
    warnings.simplefilter("ignore", ValidityWarning)
    sys.exit(measure(TABLES, "injector-"))
