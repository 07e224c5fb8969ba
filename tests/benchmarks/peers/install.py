# ruff: noqa: T201
"""An interpreter for each peer: ``python install.py FOLDER``, as `make peers` does.

A peer that does not install leaves its reason in ``FOLDER/NAME.refused``, which the benchmark
prints; remove the file to try again.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

HINTS = {
    "aspher": (
        "built from source: needs a C++ compiler and Eigen 3.4 (Debian: libeigen3-dev; or "
        "CPLUS_INCLUDE_PATH and CMAKE_PREFIX_PATH set to a tree that has it)"
    ),
    "slippy": (
        "its releases refuse Python 3.11 and newer: needs a python3.10 on the PATH "
        "(of pyenv: PYENV_VERSION that names one)"
    ),
}


def requirements(name):
    """Lines of peers.txt under the heading of a peer, and the interpreter it names."""
    lines = (Path(__file__).parent / "peers.txt").read_text(encoding="utf-8").splitlines()
    begin = lines.index(f"[{name}]") + 1
    end = next((i for i in range(begin, len(lines)) if lines[i].startswith("[")), len(lines))
    given = [line for line in lines[begin:end] if line and not line.startswith("#")]
    version = next((line.split()[1] for line in given if line.startswith("python ")), None)
    return [line.split() for line in given if not line.startswith("python ")], version


def names():
    """Every peer in peers.txt."""
    lines = (Path(__file__).parent / "peers.txt").read_text(encoding="utf-8").splitlines()
    return [line.strip("[]") for line in lines if line.startswith("[")]


def install(folder, name):
    """Make the environment of a peer; the reason if that fails, or None."""
    home, steps = folder / name, requirements(name)
    base = f"python{steps[1]}" if steps[1] else sys.executable
    if shutil.which(base) is None or call([base, "-c", "pass"]):
        return f"no {base} that runs here. {HINTS.get(name, '')}"
    shutil.rmtree(home, ignore_errors=True)
    asked = [[base, "-m", "venv", str(home)]]
    pip = [str(home / "bin" / "python"), "-m", "pip", "--disable-pip-version-check", "--quiet"]
    asked += [[*pip, "install", *line] for line in steps[0]]
    asked.append([str(home / "bin" / "python"), "-c", f"import {name}"])
    for command in asked:
        reason = call(command)
        if reason:
            return f"{reason}. {HINTS.get(name, '')}".strip()
    return None


def call(command):
    """Run a command; what it complained of if it failed, or None."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=1800)
    if done.returncode == 0:
        return None
    lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip()]
    errors = [line for line in lines if "rror" in line] or lines or [f"exit {done.returncode}"]
    return errors[-1]


def main(folder):
    """Install what is not there yet."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in names():
        refused, made = folder / f"{name}.refused", folder / name / ".made"
        if made.exists() or refused.exists():
            continue
        print(f"installing {name} ...", flush=True)
        reason = install(folder, name)
        if reason is None:
            made.touch()
        else:
            refused.write_text(reason + "\n", encoding="utf-8")
            print(f"  not installed: {reason}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
