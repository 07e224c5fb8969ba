"""Ecos: the release of case A, forces exchanged, the injector's SSP, and what it does not say."""

from __future__ import annotations

import re
import shutil
import zipfile

import pytest

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

from hosts_ecos import compiled_quickly, ecos, run, why_not
from hosts_fmus import HERE, Cases, reference
from native_scenes import HAS_CC

from contactkit.app.system import write_system
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.master.injector import cosimulate

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(why_not()), reason=why_not() or "it is there"),
]
needs_cc = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
KINDS = [
    "python",
    pytest.param("native 2", marks=needs_cc),
    pytest.param("native 3", marks=needs_cc),
]
KIND = "native 2" if HAS_CC else "python"  # where any will do
DOCS = HERE.parents[1] / "docs" / "hosts.md"


@pytest.fixture(scope="module", autouse=True)
def quickly():
    with compiled_quickly():
        yield


@pytest.fixture(scope="module")
def fmu(shelf):
    return Cases(shelf)


@pytest.mark.parametrize("kind", KINDS)
def test_case_a_by_two_instances_and_again_after_a_reset(fmu, tmp_path, kind):
    """From two files: of one file Ecos unloads the library while its first instance lives."""
    film = fmu(kind, "stiction-mass")
    other = shutil.copy(film, tmp_path / "other.fmu")
    *runs, said = ecos(
        1e-5,
        50,
        ["film.t_release", "film.n_release", "other.t_release"],
        {"film": film, "other": other},
        start={"film.F_ext": 40.0, "other.F_ext": 80.0},
        again=True,
    )
    for found in runs:
        assert found["film.t_release"] == pytest.approx(reference("A"), rel=2e-7)
        assert found["film.n_release"] == 1
        assert found["other.t_release"] == pytest.approx(2.517292e-4, rel=1e-6)  # as in fmpy
    asks = 'Function "fmi3GetVersion" is not provided by this FMU.' in said
    skips = "Variable named 'state' is of unsupported type, skipping." in said
    assert asks == skips == (kind == "native 3")  # as docs/hosts.md says


@pytest.mark.parametrize(("step", "error"), [(1e-5, -1.6e-4), (1e-4, -9.4e-4)])
def test_pull_and_spring_in_another_fmu(fmu, step, error):
    """As in libcosim; a step that is a quarter of the release itself does no harm."""
    found = ecos(
        step,
        round(5e-4 / step),
        ["film.t_release"],
        {"drive": fmu("helper", "Drive"), "film": fmu(KIND, "stiction-mass", k_s=0.0)},
        ["drive.F_ext -> film.F_ext", "film.h -> drive.h"],
    )
    assert found["film.t_release"] / reference("A") - 1.0 == pytest.approx(error, rel=0.1)


WIRES = ("body.h -> film.h", "body.v -> film.v", "film.F -> body.F")


def test_forces_exchanged(fmu):
    """Case A, the harmless one: seventy times the error at the same step."""
    found = ecos(
        1e-5,
        50,
        ["body.t_release", "film.n_doubt"],
        {"body": fmu("helper", "Body"), "film": fmu(KIND, "stiction-force")},
        WIRES,
    )
    assert found["body.t_release"] / reference("A") - 1.0 == pytest.approx(-1.1e-2, rel=0.1)
    assert found["film.n_doubt"] == 0


@pytest.mark.parametrize("step", [1e-5, 1e-4])
def test_forces_exchanged_that_are_nonsense_are_called_so(fmu, step):
    """Case B far beyond the stable step: much too early, or at 100 us stopped dead for good."""
    found = ecos(
        step,
        round(1e-3 / step),
        ["body.t_release", "film.n_doubt"],
        {"body": fmu("helper", "Body", "B"), "film": fmu(KIND, "stiction-force", "B")},
        WIRES,
    )
    assert found["body.t_release"] < 0.1 * reference("B")
    assert found["film.n_doubt"] > 0


def test_a_refused_start_value_gives_no_release(fmu):
    """Ecos goes on as if nothing was; all that is seen is a gap of nothing and no release."""
    found = ecos(
        1e-5,
        50,
        ["film.h", "film.t_release", "film.n_release"],
        {"film": fmu(KIND, "stiction-mass")},
        start={"film.F_ext": 40.0, "film.h0": -1.0},
    )
    assert found["film.h"] == 0.0
    assert found["film.t_release"] == -1.0
    assert found["film.n_release"] == 0


# The injector -------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def injector(tmp_path_factory):
    """The SSP, and its release."""
    folder = tmp_path_factory.mktemp("injector")
    native = {"native": True, "platforms": [local()], "compiler": "cc"} if HAS_CC else {}
    path = write_system("fuel-injector", folder / "valve.ssp", **native)
    with zipfile.ZipFile(path) as packed:
        packed.extractall(folder)
    fmus = [folder / "resources" / f"{name}.fmu" for name in ("valve_drive", "stiction_mass")]
    found = cosimulate(*fmus, 2e-3, 2e-6)
    return path, found["t_release"][-1], found["F_peak"][-1]


@pytest.mark.parametrize(("step", "error"), [(2e-6, -4.8e-6), (5e-6, -3.5e-5)])
def test_the_injector_as_an_ssp(injector, step, error):
    """Both FMUs step at once, so the pull is the straight line of the step before."""
    path, release, peak = injector
    assert release == pytest.approx(1.342186e-3, rel=2e-6)
    read = ["mass.t_release", "mass.F_peak", "mass.n_release"]
    found = ecos(step, round(2e-3 / step), read, ssp=path)
    assert found["mass.t_release"] / release - 1.0 == pytest.approx(error, rel=0.3)
    assert found["mass.F_peak"] == pytest.approx(peak, rel=1e-5)
    assert found["mass.n_release"] == 1


def test_the_injector_takes_the_values_that_are_bound(injector, tmp_path):
    """A mass changed in the structure alone reaches the FMU."""
    changed = tmp_path / "changed.ssp"
    with zipfile.ZipFile(injector[0]) as old, zipfile.ZipFile(changed, "w") as new:
        for name in old.namelist():
            content, before = old.read(name), b'<ssv:Real unit="kg" value="0.02" />'
            assert before in content or not name.endswith(".ssd")
            new.writestr(name, content.replace(before, before.replace(b"0.02", b"0.04")))
    assert ecos(1e-5, 2, ["mass.m"], ssp=changed)["mass.m"] == 0.04


@needs_cc
def test_the_example_of_the_page(fmu, tmp_path):
    shutil.copy(fmu("native 2", "stiction-mass"), tmp_path / "film.fmu")
    code = re.search(r"\*\*Ecos\*\*.*?```py\n(.*?)```", DOCS.read_text("utf-8"), re.S)[1]
    done = run(code, folder=tmp_path)
    assert float(done.stdout.splitlines()[-1]) == pytest.approx(reference("A"), rel=2e-7), done
