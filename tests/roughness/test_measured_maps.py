"""Measured maps as surfaces: what a file or a topography object states about them is honoured."""

from __future__ import annotations

import gc
import tracemalloc
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.errors import DescriptionError
from contactkit.roughness import height_maps
from contactkit.roughness.instrument_channels import read_channel
from contactkit.scene.window import Grid

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
Y, X = np.mgrid[:24, :32] / 16.0
HEIGHTS = 1e-9 * np.cos(2.0 * np.pi * X) * np.cos(2.0 * np.pi * Y) + 1e-10 * X


class Topography:
    """As SurfaceTopography makes them: heights [x, y] and sizes (along x, along y) in a unit."""

    def __init__(self, unit="nm", is_periodic=False, **changed):
        self.unit, self.is_periodic = unit, is_periodic
        self.physical_sizes = (320.0, 480.0)
        self._heights = 1e9 * HEIGHTS.T
        vars(self).update(changed)

    def heights(self):
        return self._heights


def scene(surface, **window):
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=surface),
        window=ck.Window(**window),
        loading=ck.Pressing(pressure=50e6),
        effects=(ck.HalfSpace(),),
    )


# Topography objects -------------------------------------------------------------------------


@pytest.mark.parametrize("is_periodic", [True, False])
def test_a_topography_is_pressed_as_it_states(is_periodic):
    result = ck.press(Topography(is_periodic=is_periodic), None, STEEL, 50e6)
    grid = result.plan.grid
    assert grid.periodic is is_periodic
    assert grid.pixel_size == pytest.approx((20e-9, 10e-9), rel=1e-12)
    np.testing.assert_allclose(result.heights, HEIGHTS, rtol=1e-12)
    given = ck.press(HEIGHTS, (20e-9, 10e-9), STEEL, 50e6, periodic=is_periodic)
    np.testing.assert_allclose(result.pressure, given.pressure, rtol=1e-6, atol=1.0)


def test_a_topography_is_a_surface_of_a_scene():
    made = ck.plan(scene(Topography()))
    assert made.grid.periodic is False
    assert "not periodic" in str(made)
    np.testing.assert_allclose(made.heights, HEIGHTS, rtol=1e-12)
    body = ck.Body(surface=Topography(is_periodic=True), solid=STEEL)
    assert ck.plan(scene(body)).grid.periodic is True


def test_of_two_surfaces_one_that_does_not_repeat_decides():
    both = ck.CombinedSurface(
        parts=(
            ck.Heights(heights=HEIGHTS, pixel_size=10e-9, is_periodic=True),
            ck.Heights(heights=HEIGHTS, pixel_size=10e-9, is_periodic=False),
        )
    )
    assert ck.plan(scene(both)).grid.periodic is False
    unknown = ck.Heights(heights=HEIGHTS, pixel_size=10e-9)
    assert ck.plan(scene(unknown)).grid.periodic is True


@pytest.mark.parametrize("states", [True, False, None])
def test_any_map_may_be_an_isolated_contact(states):
    surface = Topography(is_periodic=states)
    assert ck.plan(scene(surface, periodic=False)).grid.periodic is False
    assert ck.press(surface, None, STEEL, 5e7, periodic=False).plan.grid.periodic is False


def test_a_map_that_does_not_repeat_is_not_pressed_as_if_it_did():
    message = r"Window\.periodic must be False or left out: Heights states that .* is_periodic=True"
    surface = Topography(is_periodic=False)
    with pytest.raises(DescriptionError, match=message):
        ck.plan(scene(surface, periodic=True))
    with pytest.raises(DescriptionError, match=message):
        ck.press(surface, None, STEEL, 5e7, periodic=True)


def test_an_isolated_map_cites_the_patch_of_love_and_keeps_it(tmp_path):
    result = ck.solve(ck.plan(scene(Topography())))
    assert "Love" in result.cite()
    again = ck.load_result(result.save(tmp_path / "map"))
    assert again.plan.grid.periodic is False
    assert again.cite() == result.cite()
    assert again.plan.scene == result.plan.scene or again.plan.scene.window.periodic is False


@pytest.mark.parametrize("unit", ["um", "\N{MICRO SIGN}m", "\N{GREEK SMALL LETTER MU}m"])
def test_the_unit_of_a_topography_may_be_a_micrometre(unit):
    made = ck.plan(scene(Topography(unit, physical_sizes=(0.32, 0.48), _heights=1e6 * HEIGHTS.T)))
    np.testing.assert_allclose(made.heights, HEIGHTS, rtol=1e-12)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"unit": None}, r"topography\.unit must be a unit of length, got None"),
        ({"unit": "Pa"}, r"topography\.unit must be a unit of length, got 'Pa'"),
        ({"physical_sizes": None}, r"topography\.physical_sizes must be two lengths"),
        ({"physical_sizes": (1.0,), "_heights": np.zeros(4)}, "profile along a line"),
        (
            {"_heights": np.ma.masked_less(1e9 * HEIGHTS.T, 99.0)},
            r"Heights\.holes must leave pixels that carry load",
        ),
    ],
)
def test_a_topography_that_is_no_map(changed, message):
    with pytest.raises(DescriptionError, match=message):
        ck.press(Topography(**changed), None, STEEL, 50e6)


def test_the_size_of_a_topography_is_not_given_twice():
    with pytest.raises(DescriptionError, match=r"press\(pixel_size\) must be None"):
        ck.press(Topography(), 1e-9, STEEL, 50e6)


# Files --------------------------------------------------------------------------------------


@pytest.mark.parametrize("states", [True, False, None])
def test_a_file_that_states_whether_it_repeats_is_believed(tmp_path, monkeypatch, states):
    """By any reader: what it found is replaced here."""
    np.save(tmp_path / "map.npy", HEIGHTS)
    original = height_maps.read_height_map
    monkeypatch.setattr(
        height_maps,
        "read_height_map",
        lambda *args, **named: original(*args, **named)._replace(is_periodic=states),
    )
    surface = ck.Measured(path=str(tmp_path / "map.npy"), pixel_size=10e-9, unit="m")
    assert ck.plan(scene(surface)).grid.periodic is (states is not False)
    repeats = evolve(surface, is_periodic=True)  # known better than by the file
    assert ck.plan(scene(repeats, periodic=True)).grid.periodic is True
    assert ck.plan(scene(repeats)).grid.periodic is True
    alone = evolve(surface, is_periodic=False)
    assert ck.plan(scene(alone)).grid.periodic is False
    with pytest.raises(DescriptionError, match=r"map\.npy states that it does not repeat"):
        ck.plan(scene(alone, periodic=True))


def test_an_instrument_file_states_whether_it_repeats():
    """The flag of a channel is that of the map."""
    channel = SimpleNamespace(
        dim=2,
        name="height",
        unit="m",
        physical_sizes=(3.0, 2.0),
        nb_grid_pts=(3, 2),
        index=0,
        is_periodic=True,
    )
    made = SimpleNamespace(pixel_size=(1.0, 1.0), heights=lambda: np.zeros((3, 2)))
    made.to_unit = lambda unit: made
    reader = SimpleNamespace(
        format=lambda: "toy",
        channels=[channel],
        default_channel=channel,
        topography=lambda **named: made,
    )
    path = SimpleNamespace(name="a.toy", suffix=".toy")
    assert read_channel(reader, path, None, None, None).is_periodic is True
    channel.is_periodic = None
    assert read_channel(reader, path, None, None, None).is_periodic is None


SDF = """aISO-1.0
ManufacID   = of ours
CreateDate  = 221120262200
ModDate     = 221120262200
NumPoints   = 4
NumProfiles = 3
Xscale      = 2e-6
Yscale      = 5.0E-06
Zscale      = 1e-9
Zresolution = -1
Compression = 0
DataType    = 7
CheckType   = 0
*
0 1 2 3
10 11 12 13 20
21 22
-23.5
*
somebody, on a rainy day
*
"""
ROWS = 1e-9 * np.array([[0, 1, 2, 3], [10, 11, 12, 13], [20, 21, 22, -23.5]])


@pytest.fixture
def sdf(tmp_path):
    def write(text=SDF):
        path = tmp_path / "map.sdf"
        path.write_bytes(text if isinstance(text, bytes) else text.encode("latin-1"))
        return path

    return write


@pytest.mark.parametrize(
    "text",
    [
        SDF,
        SDF.replace("\n", "\r\n"),
        SDF.replace("aISO-1.0", "aBCR-1.0"),
        SDF.replace("aISO-1.0", "aISO-2.0"),
        SDF.replace("aISO-1.0", "aNPL-V1.0").replace("ManufacID", "ManuFacID"),
        SDF.replace("of ours", "M\xfcller").replace("NumPoints ", "NUMPOINTS"),
        SDF.partition("somebody")[0],
        SDF.rpartition("*\nsomebody")[0],
        SDF.replace("CheckType   = 0", "CheckType   = 0 ; none"),
    ],
)
def test_a_surface_data_file_brings_its_sizes(sdf, text):
    found = height_maps.read_height_map(sdf(text))
    np.testing.assert_allclose(found.heights, ROWS, rtol=1e-14)
    assert found.pixel_size == (5e-6, 2e-6)
    assert found.source == "map.sdf"
    assert found.is_periodic is None


def test_a_surface_data_file_needs_no_extra_and_is_pressed(sdf, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    made = ck.plan(scene(ck.Measured(path=str(sdf()), detrend="none")))
    assert made.grid.shape == (3, 4)
    np.testing.assert_allclose(made.heights, ROWS, rtol=1e-14)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("20\n", "BAD\n", r"must be finite in every pixel of map\.sdf .*first at \[2, 0\]"),
        ("21 22", "21 x2", r"be numbers or BAD in map\.sdf"),
        ("21 22", "21", r"must be 12 in map\.sdf: 3 profiles of 4 points, got '11 heights'"),
        ("NumProfiles = 3", "NumProfiles = 1", "profile along a line is not a surface"),
        ("NumPoints   = 4", "NumPoints   = 4.5", r"numpoints must be a whole number"),
        ("NumPoints   = 4\n", "", r"numpoints must be a number, got None"),
        ("Xscale      = 2e-6", "Xscale      = 0", r"xscale must be a positive, finite length"),
        ("Yscale      = 5.0E-06", "Yscale = nan", r"yscale must be a positive, finite length"),
        ("Zscale      = 1e-9", "Zscale = big", r"zscale must be a number, got 'big'"),
        ("Compression = 0", "Compression = 1", r"compression must be 0, got '1'; save"),
        ("CheckType   = 0", "CheckType = 2", r"checktype must be 0"),
        ("ModDate     = 221120262200", "rubbish", r"header must be a line key = value"),
        ("*", "", r"one asterisk"),
    ],
)
def test_a_surface_data_file_that_is_no_map(sdf, old, new, message):
    assert old in SDF
    with pytest.raises(DescriptionError, match=message):
        height_maps.read_height_map(sdf(SDF.replace(old, new)))


@pytest.mark.parametrize("given", [{"unit": "nm"}, {"pixel_size": 1e-6}])
def test_what_a_surface_data_file_states_is_not_given_twice(sdf, given):
    with pytest.raises(DescriptionError, match=r"must be left out: map\.sdf contains it"):
        height_maps.read_height_map(sdf(), **given)


def test_the_binary_form_needs_the_extra(sdf, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    with pytest.raises(DescriptionError, match=r"\.sdf as text.*binary \.sdf need pip install"):
        height_maps.read_height_map(sdf(b"bISO-1.0" + bytes(200)))


# Tilt ---------------------------------------------------------------------------------------


def test_press_leaves_the_tilt_and_reports_it():
    level = height_maps.detrended(HEIGHTS)
    tilted = level + 1e-10 * X
    rise = 1e-10 * (X.max() - X.min())
    result = ck.press(tilted, 1e-8, STEEL, 50e6, periodic=False)
    np.testing.assert_array_equal(result.heights, tilted)
    assert "no tilt removed" in result.message
    assert f"rises by {rise:.2g} m over the window, {rise / level.std():.2g} of" in result.message
    none = ck.press(level, 1e-8, STEEL, 50e6).message
    assert float(none.partition("rises by ")[2].split()[0]) < 1e-9 * rise
    flat = ck.press(np.zeros((4, 4)), 1e-8, STEEL, 50e6)
    assert flat.message.endswith("rises by 0 m over the window")


@pytest.mark.parametrize("trend", ["mean", "tilt", "curvature"])
def test_a_trend_is_that_of_the_pixels_that_are_no_holes(trend):
    """Against least squares over these pixels."""
    rng = np.random.default_rng(2)
    rough = 1e-10 * rng.standard_normal(X.shape) + 3e-10 * X - 1e-10 * Y * Y + 5e-9
    holes = rng.random(X.shape) < 0.3
    holes[:, :5] = True
    terms = {"mean": [X**0], "tilt": [X**0, X, Y]}
    terms["curvature"] = [*terms["tilt"], X * X, Y * Y, X * Y]
    a = np.column_stack([term[~holes] for term in terms[trend]])
    fit, *_ = np.linalg.lstsq(a, rough[~holes], rcond=None)
    found = height_maps.detrended(np.where(holes, np.nan, rough), trend)
    assert np.isnan(found[holes]).all()
    np.testing.assert_allclose(found[~holes], rough[~holes] - a @ fit, atol=1e-14 * 5e-9 * 1e3)


def test_a_trend_without_holes_is_the_same_as_with_none_of_them():
    found = height_maps.detrended(HEIGHTS, "curvature")
    known = np.ones(HEIGHTS.shape, dtype=bool)
    same = height_maps._detrended_around_holes(HEIGHTS, known, "curvature")
    np.testing.assert_allclose(same, found, atol=1e-13 * np.abs(HEIGHTS).max())


def test_half_precision_is_refused():
    """Heights of 50 nm are multiples of 60 nm there."""
    with pytest.raises(DescriptionError, match=r"heights must be of float32.*float16.*convert"):
        ck.Heights(heights=HEIGHTS.astype(np.float16), pixel_size=1e-6)


@pytest.mark.parametrize("holes", ["masked", "fill"])
def test_a_measured_map_with_holes_and_tilt_is_pressed_as_the_level_array(tmp_path, holes):
    lost = np.zeros(X.shape, dtype=bool)
    lost[3:6, 10:13] = True
    np.save(tmp_path / "a.npy", np.where(lost, np.nan, HEIGHTS + 2e-8 * X))
    path = str(tmp_path / "a.npy")
    measured = ck.Measured(path=path, pixel_size=1e-8, unit="m", holes=holes)
    found = ck.solve(ck.plan(scene(measured, periodic=False)))
    level = height_maps.detrended(np.where(lost, np.nan, HEIGHTS + 2e-8 * X))
    given = np.ma.masked_invalid(level) if holes == "masked" else height_maps.filled(level)
    same = ck.press(given, 1e-8, STEEL, 50e6, periodic=False)
    np.testing.assert_allclose(found.pressure, same.pressure, rtol=1e-6, atol=1.0)
    assert (found.pressure[lost] == 0.0).all() or holes == "fill"
    with pytest.raises(DescriptionError, match='holes="masked"'):
        ck.plan(scene(evolve(measured, holes="refused"), periodic=False))


def test_press_takes_off_a_tilt_beside_holes():
    lost = X > 1.2
    tilted = np.ma.array(HEIGHTS + 2e-8 * X, mask=lost)
    found = ck.press(tilted, 1e-8, STEEL, 50e6, periodic=False, detrend="tilt")
    level = np.ma.masked_invalid(height_maps.detrended(np.ma.filled(tilted, np.nan)))
    same = ck.press(level, 1e-8, STEEL, 50e6, periodic=False)
    np.testing.assert_array_equal(found.pressure, same.pressure)
    assert found.message.endswith("heights less their tilt")
    with pytest.raises(DescriptionError, match=r"press\(detrend\) must be one of 'none', 'mean'"):
        ck.press(tilted, 1e-8, STEEL, 50e6, detrend="plane")


def test_a_plane_is_all_tilt():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        plane = ck.press(1e-10 * X, 1e-8, STEEL, 50e6, periodic=False)
    assert plane.message.endswith("over the window")


# Memory -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["npy", "npy, columns first, single", "csv"])
@pytest.mark.parametrize("trend", ["tilt", "none"])
def test_a_map_is_read_in_pieces(tmp_path, kind, trend):
    """Beside the map itself, levelled and turned, there is never another one of its size."""
    n = 1024 if kind.startswith("npy") else 256
    y, x = np.mgrid[:n, :n] / n
    heights = 1e-9 * (np.sin(40.0 * x * y) + x)
    path = tmp_path / f"map.{kind[:3]}"
    if kind == "csv":
        np.savetxt(path, heights, fmt="%.6e", delimiter=",")
    else:
        np.save(path, heights if kind == "npy" else np.asfortranarray(heights, np.float32))
    grid = Grid((n, n), (1e-8, 1e-8), False)

    def surface():
        given = {"pixel_size": 1e-8, "unit": "m", "detrend": trend, "flipped": True}
        return ck.Measured(path=str(path), **given)

    surface().heights_on(grid)  # imports are no part of it
    gc.collect()
    tracemalloc.start()
    try:
        read = surface()
        found = read.heights_on(grid)
        held, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    expected = -height_maps.detrended(heights, trend)
    np.testing.assert_allclose(found, expected, atol=1e-6 * np.ptp(heights))
    assert held < 1.1 * heights.nbytes
    assert peak < (1.8 if kind.startswith("npy") else 2.0) * heights.nbytes


def test_a_read_only_map_is_shared_and_any_other_copied():
    given = HEIGHTS.copy()
    assert ck.Heights(heights=given, pixel_size=1e-8).heights is not given
    given.flags.writeable = False
    surface = ck.Heights(heights=given, pixel_size=1e-8)
    assert surface.heights is given
    view = given[:]  # of memory that its owner may write into again
    assert not np.shares_memory(ck.Heights(heights=view, pixel_size=1e-8).heights, given)
    assert ck.press(given, 1e-8, STEEL, 50e6).heights is given
