"""What is printed where: quiet, verbose, mistakes of the command line, completion."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import warnings

import pytest

from contactkit.cli import main
from contactkit.commands.terminal import progress

SCENE = """\
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.upper]
shape = "flat"
[interface.meniscus]
liquid = "water"
volume = "0.1 mm3"
[loading]
kind = "imposed-speed"
initial_gap = "5 um"
final_gap = "50 um"
speed = "1 mm/s"
[[effects]]
effect = "viscous-force"
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "film.toml"
    path.write_text(SCENE)
    return str(path)


def test_quiet_prints_errors_and_json_only(scene, tmp_path, capsys):
    out = str(tmp_path / "out")
    for words in (["run", scene, "--out", out, "--report"], ["check", scene], ["plan", scene]):
        assert main([*words, "--quiet"]) == 0
        assert capsys.readouterr() == ("", "")
    assert main(["run", scene, "-q", "--json"]) == 0
    assert "viscous_impulse" in json.loads(capsys.readouterr().out)
    assert main(["run", "nothing.toml", "-q"]) == 2
    assert capsys.readouterr().err.startswith("contactkit: file must exist")


def test_quiet_hides_warnings(scene, capsys, monkeypatch):
    from contactkit.app.scenes import OpenedScene

    def warn(_):
        warnings.warn("a remark", UserWarning, stacklevel=1)
        return "plan"

    monkeypatch.setattr(OpenedScene, "plan_text", warn)
    for words, printed in ((["-q"], ""), ([], "contactkit: warning: a remark\n")):
        with warnings.catch_warnings():
            warnings.simplefilter("always")
            assert main(["plan", scene, *words]) == 0
        assert capsys.readouterr().err == printed


def test_verbose_names_wall_and_cpu_time_of_each_step(scene, tmp_path, capsys):
    assert main(["run", scene, "--out", str(tmp_path / "out"), "-v"]) == 0
    found = capsys.readouterr()
    line = r"^contactkit: (.+): \d+\.\d\d s wall time, \d+\.\d\d s CPU time$"
    steps = re.findall(line, found.err, re.M)
    assert steps == ["imports and scene", "run separation", "figures"]
    assert re.search(r" evaluations, \d+\.\d+ s wall time", found.out)


def test_seconds_of_a_cost_table_are_labelled_cpu_time():
    from contactkit.work_precision import Point, WorkPrecision

    table = WorkPrecision("force", 1.0, 1e-9, (Point("a", "b", 0.0, 1.0, {}),)).table()
    assert "CPU time" in table


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["rnu"], "no command 'rnu'; did you mean 'run'?; see contactkit --help"),
        (["fmu", "bild"], "did you mean 'build'?; see contactkit fmu --help"),
        (["fmu"], "see contactkit fmu --help"),
        (["run"], "Missing argument 'SCENE'; see contactkit run --help"),
        (["run", "a", "b"], "see contactkit run --help"),
        (["run", "a", "--jsno"], "--json"),
        (["cost", "a", "--error", "small"], "'small' is not a valid float"),
        (["study", "a", "--workers", "1.5"], "'1.5' is not a valid integer"),
        (["--jsno"], "see contactkit --help"),
        (["completion"], "Missing argument 'SHELL'"),
    ],
)
def test_a_command_line_that_cannot_be_understood_is_one_line(capsys, words, message):
    with pytest.raises(SystemExit, match="2"):
        main(words)
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("contactkit: ")
    assert message in printed.err
    assert printed.err.count("\n") == 1


@pytest.mark.parametrize("words", [["--help"], ["run", "-h"], ["fmu", "build", "--help"]])
def test_help_is_printed(capsys, words):
    with pytest.raises(SystemExit, match="0"):
        main(words)
    assert "Usage: contactkit" in capsys.readouterr().out


def test_without_a_command_help_is_printed_and_the_status_is_that_of_a_mistake(capsys):
    assert main([]) == 2
    assert "Commands:" in capsys.readouterr().out


def test_help_cuts_no_sentence_short(capsys):
    for words in (["--help"], ["fmu", "--help"]):
        with pytest.raises(SystemExit):
            main(words)
        lines = capsys.readouterr().out.splitlines()[1:]  # but that of the usage
        assert [one for one in lines if one.endswith("...")] == []


def completions(capsys, monkeypatch, *words):
    """What bash is offered for the last of some words."""
    monkeypatch.setenv("_CONTACTKIT_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", " ".join(["contactkit", *words]))
    monkeypatch.setenv("COMP_CWORD", str(len(words)))
    assert main() == 0
    monkeypatch.delenv("_CONTACTKIT_COMPLETE")
    return [line.partition(",")[2] for line in capsys.readouterr().out.split()]


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (["p"], ["plan", "page"]),
        (["ap"], ["app"]),
        (["app", "con"], ["contact-stop", "con"]),
        (["run", "fuel"], ["fuel-injector", "fuel"]),  # the last: a file that begins so
        (["run", "--over"], ["--overwrite"]),
        (["list", "li"], ["liquids"]),
        (["new", "s"], ["separation", "sliding"]),
        (["fmu", "build", "valve"], ["valve-drive", "valve"]),
        (["fmu", "build", "a", "--fmi", ""], ["2", "3"]),
        (["completion", ""], ["bash", "zsh", "fish"]),
        (["run", "fuel-injector", "--set", "valve.spring.p"], ["valve.spring.preload="]),
        (["run", "nothing", "--set", "valve"], []),
    ],
)
def test_a_shell_completes(capsys, monkeypatch, words, offered):
    assert completions(capsys, monkeypatch, *words) == offered


def test_paths_of_a_scene_are_those_that_can_be_set(scene, capsys, monkeypatch):
    offered = completions(capsys, monkeypatch, "run", scene, "--set", "")
    assert {"loading.speed=", "effects.viscous-force.closure=", "accuracy.rtol="} <= set(offered)
    for one in ("interface.lower.surface.radius=", "interface.meniscus.liquid="):
        assert one in offered


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_of_a_shell_is_printed(capsys, shell):
    assert main(["completion", shell]) == 0
    assert f"_CONTACTKIT_COMPLETE={shell}_complete" in capsys.readouterr().out


def test_a_shell_unknown_is_refused(capsys):
    assert main(["completion", "bsh"]) == 2
    assert "did you mean 'bash'?" in capsys.readouterr().err


@pytest.mark.slow
def test_bash_completes_by_the_script_it_evaluates(tmp_path):
    """In the shell itself, with the command that is installed."""
    folder = os.path.dirname(sys.executable)
    script = (
        'eval "$(contactkit completion bash)"; COMP_WORDS=(contactkit new sl); COMP_CWORD=2; '
        '_contactkit_completion contactkit; echo "${COMPREPLY[@]}"'
    )
    done = subprocess.run(
        ["bash", "-c", script],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"},
    )
    assert done.stdout.strip() == "sliding"


def test_progress_that_was_shown_ends_at_its_end(monkeypatch, capsys):
    """Also where the last report is far from it; what takes no second shows none."""
    import io
    import time

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    monkeypatch.setattr(sys, "stderr", shown := Terminal())
    with progress("quick") as update:
        update(0.5)
    assert shown.getvalue() == ""
    with progress("slow") as update:
        time.sleep(1.2)
        update(0.4)
    found = [int(one) for one in re.findall(r"(\d+) %", shown.getvalue())]
    assert found == [40, 100]
