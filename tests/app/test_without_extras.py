"""Every command on an installation without the extras: numbers first, one line, no traceback."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys

import pytest

from contactkit.cli import main
from contactkit.errors import MissingExtraError
from contactkit.extras import require

FILM = """\
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.meniscus]
volume = "0.1 mm3"
[interface.meniscus.liquid]
name = "oil"
viscosity = "10 mPa.s"
surface_tension = "30 mN/m"
density = "870 kg/m3"
"""
SCENES = {
    "film.toml": FILM
    + """
[loading]
kind = "imposed-force"
initial_gap = "5 um"
final_gap = "50 um"
force = "40 N"
mass = "20 g"
[[effects]]
effect = "viscous-force"
""",
    "slide.toml": FILM
    + """
[loading]
kind = "sliding"
gap = "5 um"
speed = "1 mm/s"
[[effects]]
effect = "couette-force"
""",
    "touch.toml": """\
[interface.lower]
solid = "bearing-steel"
[interface.upper]
shape = "paraboloid"
radius = "1 mm"
[window]
width = "100 um"
periodic = false
[loading]
kind = "pressing"
force = "1 N"
[[effects]]
effect = "half-space"
[accuracy]
grid = 24
[study]
"loading.force" = ["1 N", "2 N"]
""",
}
PLOT, FMU = "pip install contactkit[plot]", "pip install contactkit[fmu]"
# Command: what it prints and writes, and the extra it names.
COMMANDS = {
    "run film.toml --out film": ("release_time", {"result.npz", "result.csv"}, PLOT),
    "run film.toml --json --out json": ('"release_time"', {"result.npz", "result.csv"}, PLOT),
    "run slide.toml --out slide": ("couette_impulse", {"result.npz", "result.csv"}, PLOT),
    "run touch.toml --out touch": (
        "study:",
        {"study.csv", "study.npz", "result.npz"},
        PLOT,
    ),
    "run film.toml": ("release_time", set(), ""),
    "cost film.toml --out cost": ("known to", {"cost.csv"}, PLOT),
    "cost touch.toml --out costs": ("effects up to", {"cost.csv"}, PLOT),
    "plan fuel-injector": ("valve-drive", set(), ""),
    "plan micromirror": ("tip-contact", set(), ""),
    "plan head-disk": ("subsurface-stress", set(), ""),
    "run fuel-injector --out injector": ("", set(), FMU),
    "cost fuel-injector --out injector": ("", set(), FMU),
    "run micromirror --out mirror": ("", set(), FMU),
    "fmu build film.toml --out fmus/f.fmu": ("", set(), FMU),
    "fmu build film.toml --native --out fmus/f.fmu": ("", set(), FMU),
    "fmu build stiction-mass --out fmus/f.fmu": ("", set(), FMU),
    "fmu system --out fmus/f.ssp": ("", set(), FMU),
    "fmu modelica f.fmu --out fmus/F.mo": ("", set(), FMU),
    "fmu crosscheck --out fmus": ("", set(), FMU),
}
SCRIPT = """
import contextlib, functools, io, json, sys
extras = "matplotlib mpl_toolkits pythonfmu fmpy ziglang numba ducc0 SurfaceTopography distributed"
sys.modules.update(dict.fromkeys(extras.split()))  # None: as if not installed
import contactkit.benchmarks.contact as contact, contactkit.benchmarks.separation as separation
separation.TOLERANCES = separation.TOLERANCES[:1]
separation.sweep = functools.partial(separation.sweep, repeats=0)
contact._TOLERANCES = {"active-set": (1e-2,)}
from contactkit.cli import main
found = {}
for command in json.loads(sys.argv[1]):
    with (contextlib.redirect_stdout(io.StringIO()) as out,
          contextlib.redirect_stderr(io.StringIO()) as err):
        status = main(command.split())
    found[command] = status, out.getvalue(), err.getvalue()
print(json.dumps(found))
"""


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """All commands in one process in which no optional package can be imported."""
    folder = tmp_path_factory.mktemp("bare")
    for name, text in SCENES.items():
        (folder / name).write_text(text)
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, json.dumps(list(COMMANDS))],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder, json.loads(done.stdout)


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_numbers_and_files_come_first_and_one_line_names_the_extra(bare, command):
    folder, found = bare
    status, out, err = found[command]
    printed, files, extra = COMMANDS[command]
    assert "Traceback" not in out + err
    assert printed in out
    assert status == (0 if printed else 2)
    lines = [line for line in err.splitlines() if line.startswith("contactkit: ")]
    assert len(lines) == bool(extra)
    assert all(line.endswith(extra) for line in lines)
    if "--out" in command:
        target = folder / command.split()[-1]
        record = {"contactkit.json"} if files else set()
        assert {path.name for path in target.glob("*")} == files | record


def test_a_package_that_is_missing_is_named_with_its_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "fmpy", None)
    with pytest.raises(MissingExtraError, match=r"checking an FMU needs fmpy.*contactkit\[fmu\]"):
        require("fmpy", "checking an FMU")


def test_pictures_without_matplotlib_name_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "contactkit.plot.style", raising=False)
    with pytest.raises(MissingExtraError, match=r"needs matplotlib.*contactkit\[plot\]"):
        importlib.import_module("contactkit.plot.style")


def test_an_import_that_fails_for_another_reason_is_a_defect(monkeypatch, capsys):
    monkeypatch.setattr(
        "contactkit.app.scenes.open_scene", lambda name: __import__("contactkit.nowhere")
    )
    assert main(["plan", "head-disk"]) == 70
    assert "a defect of contactkit, ModuleNotFoundError" in capsys.readouterr().err


@pytest.mark.parametrize("out", ["file", "file/in/it"])
def test_a_folder_that_cannot_be_is_refused_before_the_work(tmp_path, out, capsys):
    (tmp_path / "file").write_text("")
    assert main(["run", "fuel-injector", "--out", str(tmp_path / out)]) == 2
    assert "--out must be a folder that can be written to" in capsys.readouterr().err


def test_a_defect_is_one_line_and_its_traceback_a_switch_away(monkeypatch, capsys):
    def broken(name):
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr("contactkit.app.scenes.open_scene", broken)
    assert main(["plan", "head-disk"]) == 70
    error = capsys.readouterr().err
    assert error.startswith("contactkit: a defect of contactkit, ZeroDivisionError")
    assert "--traceback" in error
    assert error.count("\n") == 1
    with pytest.raises(ZeroDivisionError):
        main(["plan", "head-disk", "--traceback"])
