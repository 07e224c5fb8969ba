"""The documentation that travels in an FMU: its variables as a page, and the licences."""

from __future__ import annotations

import html
import importlib.metadata
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from ..errors import ContactkitError
from .ports import Port, Value

__all__ = ["index_page", "license_text"]

_STYLE = (
    "body{font:15px sans-serif;margin:2em;max-width:70em}table{border-collapse:collapse}"
    "th,td{border:1px solid #bbb;padding:.3em .6em;text-align:left;vertical-align:top}"
)
_HEAD = ("name", "unit", "shown in", "causality", "type", "start", "allowed", "description")


def index_page(
    title: str,
    summary: str,
    ports: Sequence[Port],
    start: Mapping[str, Value],
    requires: Iterable[str],
) -> str:
    """HTML page that lists the variables of an FMU."""
    rows = "\n".join(_row(_cells(port, start[port.name]), "td") for port in ports)
    needs = ", ".join(sorted(requires)) or "nothing else"
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{html.escape(title)}</title><style>{_STYLE}</style></head>
<body>
<h1>{html.escape(title)}</h1>
<p>{html.escape(summary)}</p>
<p>FMI 2.0 for co-simulation, written by contactkit. It runs in a Python interpreter on the host
computer (3.11 or later), which besides the files in this FMU needs: {html.escape(needs)}. All
values are in SI units, angles in radians; the unit in the third column is only for showing.</p>
<p>Parameters are set before initialization ends. A value that is out of range is refused: the
message in category <code>logStatusError</code> says why, and steps are discarded until the FMU is
reset or set back to an earlier state.</p>
<table>
{_row(_HEAD, "th")}
{rows}
</table>
</body>
</html>
"""


def _row(cells: Iterable[str], tag: str) -> str:
    return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"


def _cells(port: Port, start: Value) -> list[str]:
    shown = port.enumeration(int(start)).name if port.enumeration else str(start).lower()
    return [
        port.name,
        "" if port.unit == "-" else port.unit,
        port.display_unit or "",
        port.causality,
        port.kind,
        "" if port.causality == "output" else shown,
        port.expectation.removeprefix("be ") if port.causality != "output" else "",
        port.label,
    ]


def license_text(distribution: str, beside: Path | None = None) -> str:
    """Licence of an installed distribution.

    Parameters
    ----------
    distribution : str
        Its name, as pip knows it.
    beside : Path, optional
        Where the text lies if the distribution is not installed but run from its sources.

    Raises
    ------
    ContactkitError
        If there is none: code must not be passed on without it.
    """
    try:
        files = importlib.metadata.files(distribution) or []
    except importlib.metadata.PackageNotFoundError:
        files = []
    for path in files:
        if path.name.upper().startswith(("LICENSE", "LICENCE")):
            return path.read_text(encoding="utf-8")
    if beside is not None and beside.exists():
        return beside.read_text(encoding="utf-8")
    raise ContactkitError(f"no licence of {distribution!r} found; reinstall {distribution}")
