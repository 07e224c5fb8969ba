"""Parts shared by all pages: data in JSON, tables in Markdown, pictures, the machine."""

from __future__ import annotations

import json
import math
import os
import platform
import re
import time
from collections.abc import Iterable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from contactkit.files.scenes import write_whole

__all__ = [
    "SHOWN",
    "conditions",
    "folded",
    "load",
    "machine",
    "number",
    "picture",
    "store",
    "table",
    "write",
]

SHOWN = Path(__file__).parents[2] / "demands"
"""Folder of the pages, their data and pictures: docs/demands/."""
COLOURS = 64  # of a picture, so that it stays small


def machine() -> dict[str, str]:
    """Date, processor and versions, without a name of the machine."""
    versions = []
    for name in ("contactkit", "numpy", "scipy", "numba", "ducc0"):
        try:
            versions.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            versions.append(f"no {name}")
    return {
        "date": time.strftime("%Y-%m-%d", time.gmtime()),
        "processor": f"{os.cpu_count()} shared cores of a {_clock()}{platform.machine()} server",
        "load": f"{os.getloadavg()[0]:.0f}" if hasattr(os, "getloadavg") else "unknown",
        "versions": f"Python {platform.python_version()}, {', '.join(versions)}",
    }


def _clock() -> str:
    """Clock rate as Linux reports it, or nothing."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return ""
    found = re.search(r"cpu MHz\s*:\s*([\d.]+)", text)
    return f"{float(found[1]) / 1e3:.1f} GHz " if found else ""


def conditions(measured: Mapping[str, str]) -> str:
    """A sentence that names when and on what the numbers of a page were measured."""
    load = f", load average {measured['load']}" if "load" in measured else ""
    return (
        f"Measured {measured['date']} on {measured['processor']}{load}, one thread; "
        f"{measured['versions']}. Errors and counts hold on any machine, and tests compute them "
        "again; seconds are CPU time of the process, the least of several runs, and differ "
        "between machines."
    )


def number(value: float | None, digits: int = 1) -> str:
    """Error in powers of ten, or a dash."""
    if value is None:
        return "-"
    return "0" if value == 0.0 else f"{value:.{digits - 1}e}"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Markdown table."""
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def folded(title: str, text: str) -> str:
    """Text that a reader unfolds."""
    return f'<details markdown="1">\n<summary>{title}</summary>\n\n{text}\n\n</details>'


def load(name: str) -> dict[str, Any]:
    """Committed data of a page."""
    found: dict[str, Any] = json.loads((SHOWN / f"{name}.json").read_text(encoding="utf-8"))
    return found


def store(name: str, data: Mapping[str, Any]) -> None:
    """Write the data of a page; floats to four digits, what is not finite as null."""
    SHOWN.mkdir(exist_ok=True)
    text = json.dumps(_plain(data), indent=1, allow_nan=False)
    write(SHOWN / f"{name}.json", text + "\n")


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    if isinstance(value, float):
        return float(f"{value:.4g}") if math.isfinite(value) else None
    return value


def write(path: Path, text: str) -> None:
    """Write a text file, completely or not at all."""
    with write_whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def picture(made: Any, name: str) -> None:
    """Save a figure as a small PNG beside the pages."""
    from PIL import Image

    from contactkit.plot import style as plot

    path = plot.save(made, SHOWN / name)
    with Image.open(path) as image:
        small = image.convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, 1)
    small.save(path, optimize=True)
