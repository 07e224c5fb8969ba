"""Solvers in processes of their own: interpreters, threads, what they print or why they fail."""

from __future__ import annotations

import json
import os
import subprocess

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def interpreter(folder, name):
    """Interpreter of a peer that install.py made, and why there is none."""
    python, refused = folder / name / "bin" / "python", folder / f"{name}.refused"
    if refused.exists():
        return None, refused.read_text(encoding="utf-8").strip()
    if not python.exists():
        return None, "not installed; make peers does"
    return str(python.absolute()), ""  # not resolved: it is a link to its base


def answer(command, threads=1, limit=None):
    """What a command prints on a number of threads, and why it failed, after at most `limit` s."""
    try:
        done = subprocess.run(
            [str(one) for one in command],
            capture_output=True,
            text=True,
            check=False,
            timeout=limit,
            env=os.environ | dict.fromkeys(_THREADS, str(threads)),
        )
    except subprocess.TimeoutExpired:
        return "", f"not done after {limit:.0f} s"
    if done.returncode:
        last = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        return "", last[-1][:100]
    return done.stdout, ""


def rows(python, script, name, options):
    """Lists that ``script --serve name`` prints, a line each, on one thread; why there are none."""
    text, reason = answer([python, script, "--serve", name, *options])
    return [json.loads(line) for line in text.splitlines() if line.startswith("[")], reason
