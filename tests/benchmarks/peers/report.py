"""Tables of the contact benchmark."""

from __future__ import annotations

import os
import subprocess
import time
from importlib import metadata

from cases import TARGET

PATHS = ("plain", "fast")  # of contactkit: without and with numba and ducc0


def goal(path, n):
    """How many times faster than the best peer a path is to be on a map of n x n pixels."""
    if path == "plain":
        return 2.0
    return 3.0 if n < 512 else 5.0


def conditions():
    """When, on what, and how busy that was."""
    load = "/".join(f"{one:.1f}" for one in os.getloadavg()) if hasattr(os, "getloadavg") else "?"
    said = subprocess.run(
        ["git", "describe", "--always", "--dirty"], capture_output=True, text=True, check=False
    )
    releases = []
    for name in ("numpy", "scipy", "numba", "ducc0"):
        try:
            releases.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            releases.append(f"no {name}")
    return (
        f"{time.strftime('%Y-%m-%d %H:%M %Z')}, commit {said.stdout.strip() or 'unknown'}, "
        f"{os.cpu_count()} cores, load average {load}, {', '.join(releases)}"
    )


def of_case(row):
    """Name of the case of a row."""
    return (
        f"{row['surface']} {row['n']} {row['boundary']} {row['area']} %, {row['threads']} thread"
        + ("s" if row["threads"] > 1 else "")
    )


def arrays(row):
    """Memory in double arrays of the (padded) grid."""
    padded = 8 * row["n"] ** 2 * (1 if row["boundary"] == "periodic" else 4)
    return row["memory"] / padded


def line(row):
    """One row as it is printed on the way."""
    head = f"{of_case(row)}: {row['solver']}"
    if "failed" in row:
        return f"{head}: {row['failed']}"
    return (
        f"{head}: {row['seconds']:.3f} s CPU ({row['wall']:.3f} s, setup {row['setup']:.3f} s), "
        f"{row['iterations']} iterations, kkt {row['kkt']:.0e} at tol {row['tolerance']:.0e}, "
        f"{row['memory'] / 1e6:.0f} MB"
    )


def grouped(rows):
    """Rows by case, in order."""
    cases = {}
    for row in rows:
        cases.setdefault(of_case(row), []).append(row)
    return cases


def good(row):
    """Whether the answer counts: accurate enough, and of the right load."""
    return "failed" not in row and row["kkt"] <= TARGET and row["load_error"] <= TARGET


def is_ours(row):
    """Whether it is a good answer of contactkit."""
    return row["solver"] in PATHS and good(row)


def table(rows):
    """Everything measured, with the time of each solver over that of ours."""
    text = [
        "| case | solver | CPU s | wall s | setup s | iterations | KKT | tolerance | MB | arrays "
        "| x plain | x fast |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for name, some in grouped(rows).items():
        ours = {row["solver"]: row["seconds"] for row in some if is_ours(row)}
        for row in some:
            if "failed" in row:
                text.append(f"| {name} | {row['solver']} | {row['failed']} |" + " |" * 9)
                continue
            over = (
                f"{row['seconds'] / ours[o]:.1f}" if o in ours else "-" for o in ("plain", "fast")
            )
            cells = [
                name,
                row["solver"],
                f"{row['seconds']:.3f}",
                f"{row['wall']:.3f}",
                f"{row['setup']:.3f}",
                f"{row['iterations']}",
                f"{row['kkt']:.0e}" + ("" if good(row) else " MISSED"),
                f"{row['tolerance']:.0e}",
                f"{row['memory'] / 1e6:.0f}",
                f"{arrays(row):.1f}",
                *over,
            ]
            text.append("| " + " | ".join(cells) + " |")
    return "\n".join(text)


def verdict(rows):
    """The best peer of each case over each of our paths, prepared and with setup counted."""
    text = [
        "| case | best peer | CPU s | plain (goal 2) | fast (goal 3 at 256, 5 from 512 on) "
        "| fast, setup counted | fast, wall |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, some in grouped(rows).items():
        theirs = [row for row in some if row["solver"] not in PATHS and "failed" not in row]
        peers = [row for row in theirs if good(row)]
        at_least = "" if peers else ">"  # none got there: so long they took for less
        peers = peers or theirs
        ours = {row["solver"]: row for row in some if is_ours(row)}
        if not peers or not ours:
            continue
        best = min(peers, key=lambda row: row["seconds"])
        cells = [name, best["solver"], f"{at_least}{best['seconds']:.3f}"]
        for path in PATHS:
            ratio = best["seconds"] / ours[path]["seconds"] if path in ours else None
            mark = "" if ratio is None or ratio >= goal(path, best["n"]) else " missed"
            cells.append("-" if ratio is None else f"{at_least}{ratio:.1f}{mark}")
        if "fast" in ours:
            mine = ours["fast"]
            whole = min(row["seconds"] + row["setup"] for row in peers)
            cells.append(f"{whole / (mine['seconds'] + mine['setup']):.1f}")
            cells.append(f"{min(row['wall'] for row in peers) / mine['wall']:.1f}")
        else:
            cells += ["-", "-"]
        text.append("| " + " | ".join(cells) + " |")
    return "\n".join(text)
