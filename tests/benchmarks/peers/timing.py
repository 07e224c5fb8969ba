"""Seconds and memory of a solver, in its own process."""

from __future__ import annotations

import resource
import sys
import time
from pathlib import Path


def peak_memory():
    """Largest resident size so far [bytes].

    ``ru_maxrss`` is no use where a child inherits its parent's, as on Linux; there the kernel's own
    mark is read.
    """
    try:
        status = Path("/proc/self/status").read_text(encoding="ascii")
        return 1024 * int(status.split("VmHWM:")[1].split()[0])
    except (OSError, IndexError):
        unit = 1 if sys.platform == "darwin" else 1024
        return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def forget_peak():
    """Let the mark start again from what is resident now, where the system can."""
    try:
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    except OSError:
        return


def timed(function, *arguments):
    """Result, CPU seconds and wall seconds."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = function(*arguments)
    return result, time.process_time() - cpu, time.perf_counter() - wall


def goes_on(count, seconds, job):
    """Whether to repeat: short solves more often, long ones hardly."""
    if seconds > job["budget"] / 10.0:
        return False
    return count < job["repeats"] or (seconds < 1.0 and count < 5 * job["repeats"])
