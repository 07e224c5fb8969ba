"""Modelica packages around FMUs: their text, and what a compiler makes of them.

The compiler has no standard library: `library/Modelica` states the classes that the wrappers use,
with the names and equations of that library.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from native_scenes import HAS_CC, SCENES

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")

from contactkit.cli import main  # noqa: E402
from contactkit.errors import DescriptionError  # noqa: E402
from contactkit.fmu.contents.reference_check import check_references  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.modelica.package import modelica_package, write_modelica  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.python import build as building  # noqa: E402

LIBRARY = Path(__file__).with_name("library")
FORCES = ("stiction-force", "valve-drive", "tip-contact", "contact-stop")
MODELS = ("stiction-mass", *FORCES)
needs_cc = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")


@pytest.fixture(scope="module")
def fmus(shelf):
    """Python FMUs by the names of their models."""
    return {name: shelf(building.build, name) for name in MODELS}


@pytest.fixture(scope="module")
def film(shelf):
    """Native FMU of a flooded film, in a version of FMI."""

    def of(fmi=2):
        options = {"platforms": [local()], "compiler": "cc", "model": "stiction-force"}
        return shelf(build_native, SCENES["flooded"], fmi=fmi, **options)

    return of


@pytest.fixture
def compiled(tmp_path):
    """Compile models by rumoca, beside what the wrappers use of the standard library."""
    rumoca = pytest.importorskip("rumoca", reason="pip install contactkit[test-all]")

    def of(text, name):
        place = tmp_path / f"{name.partition('.')[0]}.mo"
        place.write_text(text)
        return rumoca.Session(roots=[str(LIBRARY)]).load(str(place), model=name)

    return of


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_every_model_has_a_wrapper(name, fmus):
    text = modelica_package(fmus[name], "Film")
    assert text.startswith("package Film ")
    assert text.endswith("end Film;\n")
    for part in ("block Interface", "block StandIn", "model Wrapper", "model Example"):
        assert text.count(f"{part} ") == 1
    assert text.count("Interfaces.PartialCompliant") == (name in FORCES)
    for opening, closing in ("()", "{}"):
        assert text.count(opening) == text.count(closing)
    found = fmpy.read_model_description(str(fmus[name]))
    for variable in found.modelVariables:
        real = variable.causality == "parameter" and variable.type == "Real"
        declared = re.findall(rf"parameter \S+ {variable.name}\b.*? = (\S+) ", text)
        assert declared == ([repr(float(variable.start))] * 2 if real else []), variable.name


@needs_cc
@pytest.mark.slow
def test_both_versions_of_fmi_have_the_same_wrapper(film):
    assert modelica_package(film(2), "Film") == modelica_package(film(3), "Film")


@pytest.mark.slow
def test_units_and_ranges_are_those_of_the_fmu(fmus):
    text = modelica_package(fmus["stiction-mass"], "Film")
    assert 'parameter Modelica.Units.SI.Length h0(min=0.0, displayUnit="um") = 5e-06 ' in text
    assert 'parameter Real gamma(final unit="N/m", min=0.0, displayUnit="mN/m") = 0.03 ' in text
    assert "Set in the FMU itself, as they are no real numbers: " in text


@pytest.mark.slow
@pytest.mark.parametrize("name", ["two words", "1st", "model", "class", "../Film", ""])
def test_a_name_that_modelica_does_not_allow_is_refused(name, fmus):
    with pytest.raises(DescriptionError, match="no word of Modelica"):
        modelica_package(fmus["stiction-mass"], name)


@pytest.mark.slow
def test_what_is_no_fmu_of_contactkit_is_refused(toy_fmu, tmp_path, fmus):
    with pytest.raises(DescriptionError, match="be of a model with flanges: stiction-force, "):
        modelica_package(toy_fmu, "Toy")
    (tmp_path / "text.fmu").write_text("no archive")
    with pytest.raises(DescriptionError, match="zip archive"):
        modelica_package(tmp_path / "text.fmu", "Text")
    with pytest.raises(DescriptionError, match=r"end in \.mo"):
        write_modelica(fmus["stiction-mass"], tmp_path / "film.txt")
    assert [path.name for path in tmp_path.iterdir()] == ["text.fmu"]


@pytest.mark.parametrize("call", [lambda file: modelica_package(file, "Film"), check_references])
def test_a_scene_is_refused_with_the_cure(call, tmp_path):
    (tmp_path / "film.toml").write_text("")
    cure = re.escape("contactkit fmu build film.toml --out film.fmu")
    with pytest.raises(DescriptionError, match=rf"be an FMU, which is a zip archive.*{cure}"):
        call(tmp_path / "film.toml")


def test_a_name_is_that_of_the_file(tmp_path):
    with pytest.raises(DescriptionError, match=r"begin with no digit.*--out"):
        write_modelica(tmp_path / "film.fmu", tmp_path / "2film.mo")


@pytest.mark.slow
def test_the_command_writes_it(fmus, tmp_path, capsys):
    out = tmp_path / "Film.mo"
    assert main(["fmu", "modelica", str(fmus["stiction-force"]), "--out", str(out)]) == 0
    assert out.read_text() == modelica_package(fmus["stiction-force"], "Film")
    assert "Film.Wrapper" in capsys.readouterr().out


# By a compiler --------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", FORCES)
def test_a_force_element_resists_as_its_stand_in(name, fmus, compiled):
    """A pull of 40 N against a damper of 100 N.s/m and a spring: signs of all flanges."""
    text = modelica_package(fmus[name], "Film")
    found = compiled(text, "Film.Example").simulate(t=(0.0, 1e-3), dt=1e-5)
    lag, pace = 0.02 / 100.0, 40.0 / 100.0
    speed = pace * -math.expm1(-1e-3 / lag)  # without the spring, which takes 4 %
    assert found["mass.v"][-1] == pytest.approx(speed, rel=0.05)
    assert found["film.speed"][-1] == pytest.approx(found["mass.v"][-1], rel=1e-12)
    assert found["film.f"][-1] == pytest.approx(100.0 * found["mass.v"][-1], rel=1e-12)
    held = 40.0 - found["film.f"][-1] - found["spring.f"][-1]
    assert found["mass.a"][-1] == pytest.approx(held / 0.02, rel=1e-9)


@pytest.mark.slow
def test_a_body_moves_as_its_stand_in(fmus, compiled):
    """A mass on a spring, pulled: the force into the flange opens."""
    text = modelica_package(fmus["stiction-mass"], "Film")
    found = compiled(text, "Film.Example").simulate(t=(0.0, 1e-3), dt=1e-5)
    pace, rest = math.sqrt(5e3 / 0.02), 40.0 / 5e3
    gone = rest * (1.0 - math.cos(pace * 1e-3))  # the spring of the example begins at 1e-5 m or so
    moved = found["film.flange_b.s"][-1] - found["film.flange_b.s"][0]
    assert moved == pytest.approx(gone, rel=1e-2)
    assert found["film.fmu.v"][-1] == pytest.approx(rest * pace * math.sin(pace * 1e-3), rel=1e-2)


STEFAN = """
block Stefan "Stefan's law of a flooded disc"
  extends Film.Interface;
  constant Real pi = 3.141592653589793;
  parameter Modelica.Units.SI.Length R = 3.175e-3;
equation
  F = 1.5*pi*eta*R^4*v/h^3;
end Stefan;
model Pulled
  extends Film.Example(redeclare block Imported = Stefan);
end Pulled;
"""


@needs_cc
@pytest.mark.slow
def test_a_film_in_modelica_moves_as_the_fmu_does(film, shelf, compiled):
    """The wrapper around Stefan's law, against model exchange of the FMU of that film."""
    import exchange_host as exchange

    text = modelica_package(film(), "Film")
    inside = STEFAN.replace("Film.", "").replace("Pulled", "Moved").strip()
    before = "  annotation (uses("  # of the package: its last element
    assert text.count(before) == 1
    text = text.replace(before, f"{inside}\n{before}")
    found = compiled(text, "Film.Moved").simulate(t=(0.0, 3e-4), dt=1e-6)
    held = exchange.Film(shelf.unpacked(film()), gamma=0.0)

    def acceleration(time, gap, force):
        return (40.0 - 5e3 * (gap - 20e-6) - force) / 0.02

    body = exchange.Pulled(held, acceleration, gap=20e-6)
    body.run(3e-4)
    assert body.state[0] > 1.1 * 20e-6
    assert found["mass.s"][-1] == pytest.approx(body.state[0], rel=1e-3)
    assert found["film.f"][-1] == pytest.approx(held.get("F"), rel=5e-3)
    held.close()


@pytest.mark.slow
def test_a_compiler_refuses_a_wrapper_without_the_block(fmus, compiled):
    """It simulates nothing in place of the FMU unless told so."""
    text = modelica_package(fmus["stiction-force"], "Film")
    text = text.replace("Wrapper film(redeclare block Fmu = Imported);", "Wrapper film;")
    with pytest.raises(Exception, match=r"unbalanced|partial"):
        compiled(text, "Film.Example")
