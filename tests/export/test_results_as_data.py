"""Results as datasets of xarray, data frames of pandas, netCDF files and HTML."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.errors import MissingExtraError
from contactkit.export.contents import Contents
from contactkit.kinds import CONTACT_EFFECTS

xarray = pytest.importorskip("xarray")
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7.5e9)


def contact(*effects, heights=None, solid=STEEL, pressure=500e6, **window):
    if heights is None:
        wave = np.cos(2.0 * np.pi * np.arange(16) / 16)
        heights = 5e-9 * wave * wave[:, None]
    lower = ck.Body(surface=ck.Heights(heights=heights, pixel_size=1e-7), solid=solid)
    scene = ck.ContactScene(
        name="a wave",
        interface=ck.Interface(lower=lower, upper=ck.Flat()),
        window=ck.Window(periodic=True, **window),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene))


def film(**changed):
    face = ck.Flat(radius=3e-3)
    oil = ck.Liquid(name="oil", viscosity=0.01, surface_tension=0.03, density=870.0)
    given = {"initial_gap": 5e-6, "final_gap": 25e-6, "force": 40.0, "mass": 0.02} | changed
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-10)
        ),
        loading=ck.ImposedForce(**given),
        effects=(ck.MeniscusForce(), ck.ViscousForce()),
    )


@pytest.fixture(scope="module")
def pressed():
    return contact(ck.HardnessLimit(rule=ck.ConstantHardness(hardness=2e9)))


def test_maps_are_over_the_centres_of_pixels_with_their_units(pressed):
    found = pressed.to_xarray()
    assert found.pressure.dims == ("y", "x")
    assert np.array_equal(found.pressure, pressed.pressure)
    assert found.x.values[[0, -1]] == pytest.approx([0.5e-7, 15.5e-7])
    units = {name: found[name].attrs["units"] for name in ("x", "pressure", "gap", "load")}
    assert units == {"x": "m", "pressure": "Pa", "gap": "m", "load": "N"}
    assert float(found["load"]) == pressed.load
    assert found.attrs["status"] == pressed.status


def test_what_an_effect_adds_is_there_and_nothing_else(pressed):
    with_limit, without = pressed.to_xarray(), contact().to_xarray()
    assert np.array_equal(with_limit.plastic, pressed.of(ck.HardnessLimit).is_plastic)
    assert with_limit.plastic.any()
    assert "plastic" not in without
    assert "overlap" not in without


def test_stress_below_has_its_components_and_depths():
    result = contact(ck.SubsurfaceStress(depths=(0.0, 1e-7), keep="planes"))
    found = result.to_xarray()
    part = result.of(ck.SubsurfaceStress)
    at = found.stress.sel(component="zz").isel(plane=0)
    assert np.array_equal(at, part.planes[2, 0])
    assert at.values == pytest.approx(-result.pressure, abs=1e-6 * result.max_pressure)
    assert found.plane_depth.values.tolist() == part.depth.tolist()


def test_heights_and_gaps_of_holes_are_missing():
    heights = 1e-9 * np.cos(2.0 * np.pi * np.arange(16) / 16) * np.ones((16, 1))
    masked = np.ma.masked_where(np.arange(256).reshape(16, 16) == 37, heights)
    found = contact(heights=masked).to_xarray()
    assert int(np.isnan(found.gap).sum()) == 1
    assert bool(np.isnan(found.heights[2, 5]))
    assert float(found.pressure[2, 5]) == 0.0


@pytest.mark.parametrize("kind", list(CONTACT_EFFECTS), ids=lambda kind: kind.name)
def test_arrays_of_effects_have_names_of_their_own_and_units(kind):
    names = [one.name for one in kind.arrays]
    numbers = {one.name for one in kind.scalars}
    assert len(set(names)) == len(names)
    assert not numbers & set(names)
    assert all(one.unit for one in kind.arrays)


def test_tractions_zones_and_histories_come_along():
    path = (ck.TangentialStep(ratio=0.5), ck.TangentialStep(ratio=-0.5))
    found = contact(ck.PartialSlip(coefficient=0.3, path=path)).to_xarray()
    assert found.slip_zone.dims == ("step", "y", "x")
    assert found.sizes["step"] == 2
    assert found.slip_force.dims == ("state",)
    hard = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=2e9))
    history = ck.PlasticHistory(pressures=(800e6,))
    found = contact(hard, history).to_xarray()
    assert found.residual_depth.dims == ("y", "x")
    assert found.history_plastic_work.dims == ("state",)


def test_a_netcdf_file_gives_everything_back(pressed, tmp_path):
    path = tmp_path / "contact.nc"
    pressed.to_xarray().to_netcdf(path, engine="scipy")
    with xarray.open_dataset(path, engine="scipy") as read:
        assert np.array_equal(read.pressure, pressed.pressure)
        assert read.pressure.attrs == {"units": "Pa", "long_name": "pressure"}
        assert read.plastic.dtype == bool


def test_a_frame_of_maps_has_a_row_for_each_pixel(pressed):
    frame = pressed.to_dataframe()
    assert len(frame) == 256
    assert frame.pressure.to_numpy() == pytest.approx(pressed.pressure.ravel())
    assert frame.x[:2].to_list() == pytest.approx([0.5e-7, 1.5e-7])
    assert frame.y[:2].to_list() == pytest.approx([0.5e-7, 0.5e-7])
    assert frame.attrs["units"]["overlap"] == "m"
    assert "load" not in frame  # a number of the whole: in the dataset


def test_curves_of_a_separation_are_over_time():
    result = ck.simulate(ck.plan(film()))
    found = result.to_xarray()
    assert found.gap.dims == ("time",)
    assert set(result.columns) <= set(found.variables)
    assert float(found.release_time) == result.scalars()["release_time"][0]
    middle = float(found.gap.interp(time=[0.5 * result.time[-1]])[0])
    assert 5e-6 < middle < 25e-6
    assert result.to_dataframe().gap.iloc[-1] == result.gap[-1]


def test_a_separation_without_times_is_over_points():
    scene = film()
    loading = ck.ImposedTime(initial_gap=5e-6, final_gap=25e-6, time=1e-3)
    scene = ck.SeparationScene(
        interface=scene.interface, loading=loading, effects=(ck.MeniscusForce(),)
    )
    result = ck.simulate(ck.plan(scene))
    found = result.to_xarray()
    axis = "time" if "time" in result.columns else "point"
    assert found.gap.dims == (axis,)


def test_a_study_has_its_parameters_as_axes():
    vary = {
        "loading.mass": ["10 g", "20 g"],
        "loading.force, loading.time_limit": [(30.0, 10.0), (40.0, 20.0), (50.0, 30.0)],
    }
    study = ck.study(film(), vary)
    found = study.to_xarray()
    assert found.sizes == {"mass": 2, "force": 3}
    assert found.mass.values.tolist() == [0.01, 0.02]
    assert found.time_limit.dims == ("force",)
    assert found.time_limit.values.tolist() == [10.0, 20.0, 30.0]
    times = study.column("release_time").reshape(2, 3)
    assert np.array_equal(found.release_time, times)
    one = found.release_time.sel(mass=0.02, force=40.0)
    assert float(one) == times[1, 1]
    frame = study.to_dataframe()
    assert len(frame) == 6
    assert frame.query("mass == 0.02 and force == 40").release_time.item() == times[1, 1]
    assert frame.attrs["units"]["force"] == "N"


def test_points_that_no_parameter_orders_are_numbered():
    """As those of a Latin hypercube: along the first parameter an index would be unsorted."""
    vary = {"loading.force, loading.mass": [(30.0, 0.01), (50.0, 0.02), (40.0, 0.03)]}
    study = ck.study(film(), vary)
    found = study.to_xarray()
    assert found.sizes == {"point": 3}
    assert found.mass.dims == ("point",)
    assert (
        float(found.release_time.where(found.force == 50.0, drop=True)[0])
        == (study.column("release_time")[1])
    )


def test_a_parameter_is_named_as_in_tables_or_by_its_path():
    study = ck.study(film(), {"loading.mass": [0.01, 0.02], "loading.force": [30.0, 40.0]})
    for name in ("mass", "loading.mass", "loading.m"):
        assert study.path_of(name) == "loading.mass"
    with pytest.raises(ck.DescriptionError, match="over must be one of mass, force, got 'rms'"):
        study.path_of("rms")


def test_values_that_are_no_numbers_are_given_by_their_names():
    study = ck.study(film(), {"interface.meniscus.liquid": ["water", "engine-oil-15w-40"]})
    found = study.to_xarray()
    assert found.liquid.values.tolist() == ["water", "engine oil SAE 15W-40"]


def curves():
    water = ck.Meniscus(liquid=ck.load_liquid("water"), volume=1e-21)
    made = ck.plan(contact().plan.scene)
    yield ck.load_curve(made, pressures=[1e7, 2e7])
    yield ck.humidity_curve(
        ck.SeparationScene(
            interface=ck.Interface(upper=ck.Sphere(radius=1e-6), meniscus=water),
            loading=ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-8, speed=1e-6),
            effects=(ck.MeniscusForce(),),
        ),
        [0.3, 0.5],
    )
    block = {"load": 1.0, "static_coefficient": 0.4, "kinetic_coefficient": 0.3}
    yield ck.stick_slip(ck.SpringSlider(stiffness=1e3, speed=1e-3, **block))
    yield ck.load_displacement(made.scene, loads=[1e-6, 1e-5, 1e-4])


def test_curves_are_datasets_and_frames_too():
    for curve in curves():
        held = curve.contents()
        assert isinstance(held, Contents)
        found, frame = curve.to_xarray(), curve.to_dataframe()
        assert set(held.quantities) == set(found.variables)
        assert all("units" in one.attrs for one in found.variables.values())
        assert len(frame) == found.sizes[held.rows[0]]


def test_a_notebook_shows_numbers_with_readable_units():
    scene = film()
    result = ck.simulate(ck.plan(scene))
    text = result._repr_html_()
    assert "<td>peak force</td>" in text
    assert " N</td>" in text
    plan = result.plan._repr_html_()
    assert "viscous-force" in plan
    assert "off:" in plan
    assert "initial gap 5 um" in scene._repr_html_()
    assert "<pre>" in ck.study(scene, {"loading.force": [40.0]})._repr_html_()


def test_html_escapes_what_users_write():
    scene = ck.SeparationScene(
        **{
            "interface": film().interface,
            "loading": film().loading,
            "effects": film().effects,
            "name": "<script>",
        }
    )
    assert "<script>" not in scene._repr_html_()


def test_a_scene_prints_what_is_given_and_not_its_defaults():
    text = str(film())
    assert "loading  ImposedForce: initial gap 5 um, final gap 25 um, force 40 N, mass 20 g" in text
    assert "volume 0.1 mm3" in text
    assert "time limit" not in text


@pytest.mark.parametrize("package", ["xarray", "pandas"])
def test_without_the_extra_the_error_names_it(package, pressed, monkeypatch):
    import importlib.util

    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *more: None if name == package else find(name)
    )
    convert = pressed.to_xarray if package == "xarray" else pressed.to_dataframe
    with pytest.raises(MissingExtraError, match=r"contactkit\[data\]"):
        convert()
