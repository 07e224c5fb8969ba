"""What the page for maintainers shows: problems, marks, a program of their own."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import contactkit as ck

ROOT = Path(__file__).parents[2]
PEERS = ROOT / "tests/benchmarks/peers"


def run(script, *arguments):
    """What a script prints."""
    command = [sys.executable, str(PEERS / script), *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


@pytest.fixture(scope="module")
def problems(tmp_path_factory):
    folder = tmp_path_factory.mktemp("problems")
    run("exchange.py", "write", folder)
    return folder


def answer(folder, one):
    """Pressures over the modulus, by the public functions."""
    n = one["pixels"]
    heights = np.fromfile(folder / f"{one['name']}.bin", dtype="<f8").reshape(n, n)
    solid = ck.Material(name="any", young_modulus=1e9, poisson_ratio=0.0)
    bound = one["largest_pressure"]
    found = ck.press(
        heights,
        1.0 / n,
        solid,
        mean_pressure=1e9 * one["mean_pressure"],
        hardness=None if bound is None else 1e9 * bound,
        periodic=one["periodic"],
    )
    return found.pressure / 1e9


def marks(problems, answers):
    """Words after the name of each problem."""
    lines = run("exchange.py", "grade", problems, answers).splitlines()[1:-1]
    return {line.split()[0]: line.split()[1:] for line in lines}


def test_our_answers_are_good_and_wrong_ones_are_not(problems, tmp_path):
    asked = json.loads((problems / "problems.json").read_text("utf-8"))["problems"]
    assert len(asked) == 7
    small = [one for one in asked if one["pixels"] <= 256]
    for one in small:
        answer(problems, one).astype("<f8").tofile(tmp_path / f"{one['name']}.bin")
    found = marks(problems, tmp_path)
    assert {one["name"] for one in small} == {name for name in found if "good" in found[name]}
    assert found["free-512"] == ["no", "answer"]

    wrong = tmp_path / "wrong"
    wrong.mkdir()
    name = "periodic-128"
    np.save(wrong / f"{name}.npy", 1.3 * np.fromfile(tmp_path / f"{name}.bin").reshape(128, 128))
    (_, load, *rest) = marks(problems, wrong)[name]
    assert float(load) == pytest.approx(0.3)
    assert "good" not in rest


def test_a_program_of_a_reader_takes_part(tmp_path):
    text = (ROOT / "docs/maintainers.md").read_text("utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (tmp_path / "mine.py").write_text(block, encoding="utf-8")
    options = ["--sizes", 32, "--boundaries", "periodic", "--threads", 1, "--only", "mine"]
    run("compare.py", "--program", tmp_path / "mine.py", "--out", tmp_path, *options)
    (row,) = json.loads((tmp_path / "contact.json").read_text("utf-8"))["contest"]
    assert row["solver"] == "mine"
    assert row["iterations"] == 20
    assert row["kkt"] > 1e-3  # twenty fixed steps are not enough
