"""Effects of one's own, registered or installed as entry points: known everywhere, or refused."""

import re
import subprocess
import sys
import tomllib
import warnings

import pytest
import tomli_w
from attrs import frozen

import contactkit as ck
from contactkit import installed
from contactkit.contact.effects.base import Observer, Scalar
from contactkit.fmu.native.film import prepared_film
from contactkit.scene.column import Column
from contactkit.separation.effects.base import ForceLaw, SeparationForce

STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
WEIGHT = '''
from typing import ClassVar

from attrs import field, frozen

from contactkit.scene.column import Column
from contactkit.separation.effects.base import ForceLaw, SeparationForce
from contactkit.units import si
from contactkit.validators import positive


@frozen(kw_only=True)
class Weight(SeparationForce):
    """Weight of the upper body.

    Parameters
    ----------
    mass : float
        Its mass [kg].
    """

    name: ClassVar[str] = "weight"
    summary: ClassVar[str] = "weight of the upper body"
    column: ClassVar[Column] = Column("weight", "N", "weight")
    needs_film: ClassVar[bool] = False
    sources = ("Newton 1687",)
    mass: float = field(validator=positive, metadata=si("kg"))

    def prepare(self, prepared):
        return ForceLaw(lambda gap, speed: 9.81 * self.mass)
'''


def separation(*effects):
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=1e-3)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-11)
        ),
        loading=ck.ImposedForce(initial_gap=1e-6, final_gap=1e-5, force=0.0, mass=1e-3),
        effects=(ck.ViscousForce(), *effects),
    )


def contact(*effects):
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=STEEL), upper=ck.Wave(amplitude=1e-6, wavelength=1e-3)
        ),
        window=ck.Window(width=1e-3),
        loading=ck.Pressing(pressure=1e7),
        effects=(ck.HalfSpace(), *effects),
    )


def least_gap():
    """The same class, as a cell of a notebook that is run again defines it."""

    @frozen(kw_only=True)
    class LeastGap(Observer[float]):
        """Least distance of the surfaces."""

        name = "least-gap"
        summary = "least distance of the surfaces"
        scalars = (Scalar("least_gap", "m", float),)
        sources = ("a minimum over the window",)

        def observe(self, contact):
            return float(contact.gap.min())

    return LeastGap


LeastGap = least_gap()


@pytest.fixture
def registry():
    """All effects, as they were before."""
    with ck.EFFECTS.including():
        yield ck.EFFECTS


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Function that installs a package with entry points, for the length of a test."""
    count = iter(range(9))

    def put(source, entries):
        package = f"plates{next(count)}"
        (tmp_path / f"{package}.py").write_text(source, encoding="utf-8")
        info = tmp_path / f"{package}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
        lines = "\n".join(f"{name} = {package}:{target}" for name, target in entries.items())
        (info / "entry_points.txt").write_text(f"[contactkit.effects]\n{lines}\n")
        monkeypatch.syspath_prepend(tmp_path)
        installed.forget_installed()
        return package

    yield put
    for i in range(9):
        sys.modules.pop(f"plates{i}", None)
    monkeypatch.undo()
    installed.forget_installed()


# Registered in a session ----------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_a_registered_effect_is_in_plans_files_results_and_studies(registry, tmp_path):
    assert ck.register(LeastGap) is LeastGap
    assert registry.find("least-gap") is LeastGap
    scene = contact(LeastGap())
    accuracy = ck.Accuracy(grid=32)
    assert "off  least-gap" in str(ck.plan(contact(), accuracy))
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "wave.toml")) == scene
    result = ck.solve(ck.plan(scene, accuracy))
    again = ck.load_result(ck.save_result(result, tmp_path / "wave"))
    assert again.of(LeastGap) == result.of(LeastGap) == result.gap.min()
    loads = {"loading.pressure": ["1 MPa", "2 MPa"]}
    study = ck.study(scene, loads, accuracy, store=tmp_path / "points", keep_maps=True)
    assert study.unit("least_gap") == "m"
    stored = ck.study(scene, loads, accuracy, store=tmp_path / "points", keep_maps=True)
    assert stored.n_solved == 0
    assert stored.results[1].of(LeastGap) == study.results[1].of(LeastGap)


def test_a_class_that_is_defined_again_replaces_the_former(registry):
    n = len(registry)
    ck.register(LeastGap)
    again = least_gap()
    ck.register(again)
    assert registry.find("least-gap") is again
    assert len(registry) == n + 1


def made(base=SeparationForce, decorate=True, **body):
    """A class of an effect with something wrong."""
    body = {
        "name": "weight",
        "summary": "weight",
        "column": Column("weight", "N", "weight"),
        "sources": ("Newton 1687",),
        "prepare": lambda self, prepared: ForceLaw(lambda gap, speed: 1.0),
    } | body
    kind = type("Weight", (base,), {k: v for k, v in body.items() if v is not None})
    return frozen(kw_only=True)(kind) if decorate else kind


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        (
            made(name="meniscus-force"),
            r"Weight.name must be .* no other effect has, .*MeniscusForce",
        ),
        (made(name="half-space"), r"no other effect has, .*HalfSpace has it"),
        (made(name="couette-force"), r"no other effect has, .*CouetteForce has it"),
        (made(name="My Force"), r"small letters and hyphens"),
        (made(name=None), "Weight needs name"),
        (made(column=None), "Weight needs column"),
        (made(prepare=None), "Weight needs prepare"),
        (made(decorate=False), r"decorate Weight with @attrs.frozen"),
        (ck.Layer, "give a class whose base class is a role"),
        (ck.ViscousForce(), "give a class whose base class is a role"),
    ],
)
def test_what_is_no_effect_or_has_a_name_twice_is_refused(registry, kind, message):
    before = list(registry)
    with pytest.raises(ck.DescriptionError, match=message):
        ck.register(kind)
    assert list(registry) == before


def file_with_weight(folder):
    """A scene file that lists the installed effect."""
    path = ck.save_scene(separation(), folder / "film.toml")
    tables = tomllib.loads(path.read_text("utf-8"))
    tables["effects"].append({"effect": "weight", "mass": "2 g"})
    path.write_text(tomli_w.dumps(tables), encoding="utf-8")
    return path


# Installed --------------------------------------------------------------------------------------


def test_an_installed_effect_is_known_everywhere(install, tmp_path, capsys):
    package = install(WEIGHT, {"weight": "Weight"})
    scene = ck.load_scene(file_with_weight(tmp_path))
    kind = sys.modules[package].Weight
    assert kind in ck.EFFECTS
    assert scene.effects[1] == kind(mass=2e-3)
    plan = ck.plan(scene)
    assert plan.force(1e-6) == pytest.approx(9.81 * 2e-3)
    assert "off  weight" in str(ck.plan(separation()))
    _viscous, weight = prepared_film(scene).tables.films[0].laws  # of a native FMU
    assert weight.table.pieces[0].y == pytest.approx([9.81 * 2e-3] * 2)
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "again.toml")) == scene
    from contactkit import cli

    assert cli.main(["list", "effects"]) in (0, None)
    assert re.search(
        r"^weight +separation +weight of the upper body$", capsys.readouterr().out, re.M
    )


def test_only_the_effect_that_a_file_names_is_imported(install):
    package = install(WEIGHT, {"weight": "Weight"})
    assert ck.EFFECTS.find("viscous-force") is ck.ViscousForce
    ck.plan(separation())
    assert package not in sys.modules
    ck.EFFECTS.find("weight")
    assert package in sys.modules


@pytest.mark.parametrize(
    ("source", "entries", "problem"),
    [
        ("import absent_package", {"weight": "Weight"}, "ModuleNotFoundError: .*absent_package"),
        (WEIGHT, {"weight": "Wait"}, "AttributeError: .*Wait"),
        (WEIGHT, {"heft": "Weight"}, "its name is 'weight', and that of its entry point must be"),
        ("Weight = 3", {"weight": "Weight"}, "give a class whose base class is a role"),
        (
            WEIGHT.replace('"weight"', '"rupture"'),
            {"rupture": "Weight"},
            "there is another effect of this",
        ),
        ("raise SystemError('no licence')", {"weight": "Weight"}, "SystemError: no licence"),
    ],
)
def test_a_broken_entry_point_is_a_warning_and_nothing_else(install, source, entries, problem):
    package = install(source, entries)
    with pytest.warns(ck.InstalledKindWarning, match=rf"{package!r} .* cannot be used: {problem}"):
        text = str(ck.plan(separation()))
    assert "off  weight" not in text
    assert "off  rupture" in text
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        str(ck.plan(separation()))  # said once


def test_a_file_that_names_a_broken_effect_says_what_is_broken(install, tmp_path):
    package = install("import absent_package", {"weight": "Weight"})
    path = file_with_weight(tmp_path)
    with (
        pytest.warns(ck.InstalledKindWarning),
        pytest.raises(
            ck.DescriptionError, match=rf"{package!r} .*No module named 'absent_package'"
        ),
    ):
        ck.load_scene(path)


def test_an_installed_effect_and_the_same_registered_are_one(install, registry):
    package = install(WEIGHT, {"weight": "Weight"})
    n = len(registry)
    ck.register(sys.modules[package].Weight)
    assert len(registry) == n
    with pytest.raises(ck.DescriptionError, match=r"no other effect has, .*Weight has it"):
        ck.register(made())


def test_importing_contactkit_looks_for_no_entry_points():
    code = (
        "import sys, contactkit as ck; ck.Flat(radius=1.0); ck.plan; ck.EFFECTS; "
        "from contactkit.installed import _entries; "
        "print(_entries.cache_info().currsize, 'importlib.metadata' in sys.modules)"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split()[0] == "0"
