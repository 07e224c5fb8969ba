"""The temperature of the liquid as a variable of native FMUs: the laws of the scene's liquid."""

from __future__ import annotations

import attrs
import pytest
from native_scenes import DROP, HAS_CC, scene

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck  # noqa: E402
from contactkit.errors import DescriptionError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.native.film import liquid_over_temperature  # noqa: E402

ONE = {"platforms": [local()], "compiler": "cc"}
OIL = ck.load_liquid("engine-oil-15w-40")
PULL = 40.0


def of_oil(made, **changes):
    """The same scene with an oil whose properties follow laws."""
    film = attrs.evolve(made.interface.meniscus, liquid=OIL)
    return attrs.evolve(made, interface=attrs.evolve(made.interface, meniscus=film), **changes)


@pytest.fixture(scope="module")
def film(shelf):
    """A film between flats at 20 degC, as a scene and as an FMU."""
    made = of_oil(scene(volume=DROP, stiffness=0.0))

    def make(folder):
        build_native(made, folder / "film.fmu", **ONE)

    return made, shelf.folder("native film with a temperature", make) / "film.fmu"


def run(fmu, **start):
    return fmpy.simulate_fmu(
        str(fmu), start_values={"F_ext": PULL, **start}, stop_time=2.0, output_interval=1e-2
    )


@pytest.mark.parametrize("celsius", [-20.0, 20.0, 80.0, 150.0])
def test_a_film_follows_the_laws_of_its_liquid(film, celsius):
    made, fmu = film
    loading = attrs.evolve(made.loading, force=PULL)
    there = attrs.evolve(made, temperature=273.15 + celsius, loading=loading)
    with pytest.warns(ck.ValidityWarning):
        expected = ck.simulate(ck.plan(there)).state
    found = run(fmu, T=273.15 + celsius)
    assert found["t_release"][-1] == pytest.approx(expected.release_time, rel=1e-7)
    assert found["F_peak"][-1] == pytest.approx(expected.peak_force, rel=1e-6)


def test_its_viscosity_and_tension_are_those_of_the_laws(film):
    """At rest and at a speed, against the laws themselves: 230 K of oil, a factor of 2000."""
    _, fmu = film
    rest = {t: run(fmu, T=t)["F_m"][0] for t in (260.0, 400.0)}
    moving = {t: run(fmu, T=t, v0=1e-6)["F_v"][0] for t in (260.0, 400.0)}
    cold, hot = OIL.at(260.0), OIL.at(400.0)
    assert rest[260.0] / rest[400.0] == pytest.approx(
        cold.surface_tension / hot.surface_tension, rel=1e-6
    )
    ratio = cold.viscosity / hot.viscosity
    assert ratio > 300.0
    assert moving[260.0] / moving[400.0] == pytest.approx(ratio, rel=1e-5)


def test_the_description_has_its_range_and_its_unit(film):
    _, fmu = film
    ports = {one.name: one for one in fmpy.read_model_description(str(fmu)).modelVariables}
    temperature = ports["T"]
    assert (temperature.unit, temperature.displayUnit) == ("K", "degC")
    assert float(temperature.start) == 293.15
    assert float(temperature.min) == pytest.approx(253.15)
    assert float(temperature.max) == pytest.approx(423.15)


def test_a_viscosity_beside_it_is_refused_and_one_of_them_is_not(film):
    _, fmu = film
    with pytest.raises(Exception, match="ExitInitializationMode failed"):
        run(fmu, T=300.0, eta=0.1)
    with pytest.raises(Exception, match="failed"):
        run(fmu, T=500.0)
    assert run(fmu, eta=0.1)["F_peak"][-1] > 0.0


def test_bodies_that_deform_follow_it(tmp_path):
    made = ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(
                surface=ck.Flat(radius=1e-3),
                solid=ck.Material(young_modulus=1e9, poisson_ratio=0.3),
            ),
            upper=ck.Sphere(radius=5e-3),
            meniscus=ck.Meniscus(liquid=OIL),
        ),
        loading=ck.ImposedSpeed(speed=1e-6, initial_gap=1e-6, final_gap=2e-6),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )
    fmu = build_native(made, tmp_path / "soft.fmu", model="stiction-force", **ONE)

    def force(celsius):
        found = fmpy.simulate_fmu(
            str(fmu),
            start_values={"T": 273.15 + celsius, "v": 1e-7},
            stop_time=1e-2,
            output_interval=1e-2,
            output=["F"],
        )
        return found["F"][-1]

    ratio = OIL.at(353.15).viscosity / OIL.at(313.15).viscosity
    assert force(80.0) / force(40.0) == pytest.approx(ratio, rel=2e-2)


VAPOUR = ck.TensionLimit(strength="vapour")


@pytest.mark.parametrize(
    "made",
    [
        scene(volume=DROP),  # a liquid without laws
        attrs.evolve(of_oil(scene(volume=DROP)), temperature=450.0),  # outside its laws
        of_oil(scene(volume=DROP, effects=(ck.ViscousForce(), VAPOUR))),
        of_oil(scene(volume=DROP, effects=(ck.MeniscusForce(), ck.LiquidWeight(body="lower")))),
    ],
)
def test_where_more_than_two_properties_follow_it_is_no_variable(made):
    assert liquid_over_temperature(made, ("viscosity", "surface_tension")) is None


def test_to_set_it_where_it_is_no_variable_is_refused_with_the_cure(tmp_path):
    with pytest.raises(DescriptionError, match=r"T must be left out: the FMU has no laws"):
        build_native(scene(volume=DROP), tmp_path / "x.fmu", start={"T": "80 degC"}, **ONE)
    made = build_native(
        of_oil(scene(volume=DROP, stiffness=0.0)),
        tmp_path / "hot.fmu",
        start={"T": "80 degC"},
        **ONE,
    )
    text = {one.name: one.start for one in fmpy.read_model_description(str(made)).modelVariables}
    assert float(text["T"]) == pytest.approx(353.15)
