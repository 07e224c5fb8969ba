"""Containers of topographies: to the last bit and back, and as SurfaceTopography has them."""

from __future__ import annotations

import contextlib
import gc
import json
import zipfile

import numpy as np
import pytest
from refusals import refuses

import contactkit as ck
from contactkit.analyses.heights import surface_heights
from contactkit.errors import DescriptionError

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

RNG = np.random.default_rng(1)
HEIGHTS = 1e-9 * RNG.normal(size=(6, 10))
HOLES = RNG.random((6, 10)) < 0.1
PERIODIC = ck.Heights(heights=HEIGHTS, pixel_size=(1.1e-8, 0.7e-8), is_periodic=True)
HOLEY = ck.Heights(heights=np.ma.MaskedArray(HEIGHTS, HOLES), pixel_size=1e-8)
SOLID = ck.Material(name="solid", young_modulus=1e9, poisson_ratio=0.3)


def scene(surface):
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=SOLID), upper=ck.Body(surface=surface)),
        window=ck.Window(),
        loading=ck.Pressing(pressure=5e7),
        effects=(ck.HalfSpace(),),
    )


@pytest.fixture
def container(tmp_path):
    return ck.write_surfaces(tmp_path / "scans.zip", {"all": PERIODIC, "holey": HOLEY})


def same(one, other):
    assert one.pixel_size == other.pixel_size
    assert one.is_periodic is other.is_periodic
    if other.holes is None:
        assert one.holes is None
        np.testing.assert_array_equal(one.heights, other.heights)
    else:
        np.testing.assert_array_equal(one.holes, other.holes)
        np.testing.assert_array_equal(one.heights[~one.holes], other.heights[~other.holes])


# Alone --------------------------------------------------------------------------------------------


def test_surfaces_come_back_to_the_last_bit(container):
    found = ck.read_surfaces(container)
    assert list(found) == ["all", "holey"]
    same(found["all"], PERIODIC)
    size = HOLEY.pixel_size
    same(found["holey"], ck.Heights(heights=np.ma.MaskedArray(HEIGHTS, HOLES),
                                    pixel_size=(size, size)))  # fmt: skip


def test_the_same_surfaces_give_the_same_bytes(container, tmp_path):
    again = ck.write_surfaces(tmp_path / "b" / "scans.zip", ck.read_surfaces(container))
    assert again.read_bytes() == container.read_bytes()


@pytest.mark.hard
@pytest.mark.parametrize("scale", [1e-300, 1e-12, 1.0, 1e5])
def test_heights_and_sizes_of_any_magnitude_are_kept(tmp_path, scale):
    given = ck.Heights(heights=scale * HEIGHTS, pixel_size=(1e-6 / 3.0, scale * 1e-3 / 7.0))
    same(ck.read_surfaces(ck.write_surfaces(tmp_path / "a.zip", {"a": given}))["a"], given)


def test_files_and_random_surfaces_are_written(tmp_path):
    np.save(tmp_path / "map.npy", HEIGHTS)
    measured = ck.Measured(path=tmp_path / "map.npy", pixel_size=1e-8, unit="m", detrend="mean")
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=1e-6, cutoff=2e-7)
    made = surface_heights(rough, ck.Window(width=1e-6), ck.Accuracy(grid=16))
    file = ck.write_surfaces(tmp_path / "a.zip", {"file": measured, "random": made})
    found = ck.read_surfaces(file)
    np.testing.assert_array_equal(found["file"].heights, measured.as_heights().heights)
    assert abs(found["file"].heights.mean()) < 1e-24  # without the mean
    np.testing.assert_array_equal(found["random"].heights, made.heights)
    assert found["random"].is_periodic is True


def test_surfaces_of_a_container_are_an_ensemble_of_a_study(container):
    surfaces = list(ck.read_surfaces(container).values())
    periodic = [surfaces[0], ck.Heights(heights=2.0 * HEIGHTS, pixel_size=surfaces[0].pixel_size,
                                        is_periodic=True)]  # fmt: skip
    made = ck.study(scene(periodic[0]), {"interface.upper.surface": periodic})
    alone = [ck.solve(ck.plan(scene(one))).contact_area for one in periodic]
    np.testing.assert_allclose(made["contact_area"], alone, rtol=1e-12)
    assert alone[0] > 1.05 * alone[1]


def test_maps_of_a_contact_are_surfaces(tmp_path):
    result = ck.solve(ck.plan(scene(PERIODIC)))
    deformed = ck.surface_from(result)
    assert deformed.is_periodic is True
    assert deformed.pixel_size == PERIODIC.pixel_size
    level = deformed.heights + result.gap  # the rigid plane
    np.testing.assert_allclose(level, level[0, 0], rtol=0.0, atol=1e-16)
    assert np.ptp(deformed.heights) < 0.97 * np.ptp(HEIGHTS)  # pressed flatter
    maps = {of: ck.surface_from(result, of) for of in ("gap", "heights", "displacement")}
    file = ck.write_surfaces(tmp_path / "maps.zip", maps, name="contact")
    np.testing.assert_array_equal(ck.read_surfaces(file)["gap"].heights, result.gap)


def test_two_topographies_of_one_name_are_both_kept(container, tmp_path):
    index = changed(container, lambda found: found["surfaces"][0]["topographies"][1].update(
        name="all"))  # fmt: skip
    assert list(ck.read_surfaces(index)) == ["all", "all (2)"]


# With SurfaceTopography ---------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::ResourceWarning")  # files that it leaves to the collector
def test_surface_topography_reads_what_is_written(container):
    containers = pytest.importorskip("SurfaceTopography.Container.IO")

    def read():
        (found,) = containers.read_container(str(container))
        return [
            (one.heights(), one.physical_sizes, one.unit, one.is_periodic)
            for one in (found[0], found[1])
        ]

    (whole, sizes, unit, periodic), (holey, *_, isolated) = read()
    gc.collect()
    np.testing.assert_array_equal(whole, HEIGHTS.T)
    assert (unit, periodic, isolated) == ("m", True, False)
    assert sizes == pytest.approx((7e-8, 6.6e-8), rel=1e-15)
    np.testing.assert_array_equal(np.ma.getmaskarray(holey), HOLES.T)


def test_a_container_of_surface_topography_is_read(tmp_path):
    surfaces = pytest.importorskip("SurfaceTopography")
    containers = pytest.importorskip("SurfaceTopography.Container.IO")
    from SurfaceTopography.Container.SurfaceContainer import InMemorySurfaceContainer

    micro = surfaces.Topography(
        1e6 * HEIGHTS.T, physical_sizes=(0.07, 0.066), unit="µm", info={"name": "fine"}
    )
    nano = surfaces.Topography(
        np.ma.MaskedArray(1e9 * HEIGHTS.T, HOLES.T), (100.0, 60.0), unit="nm", periodic=True
    )
    line = surfaces.UniformLineScan(np.arange(5.0), (1.0,), unit="nm", info={"name": "stylus"})
    uneven = surfaces.NonuniformLineScan([0.0, 1.0, 3.0], [0.0, 1.0, 0.0], unit="nm")
    sets = [InMemorySurfaceContainer([micro, nano]), InMemorySurfaceContainer([line, uneven])]
    containers.write_containers(sets[:1], str(tmp_path / "maps.zip"))
    found = list(ck.read_surfaces(tmp_path / "maps.zip").values())
    np.testing.assert_allclose(found[0].heights, HEIGHTS, rtol=1e-12)
    assert found[0].pixel_size == pytest.approx((1.1e-8, 0.7e-8), rel=1e-14)
    assert (found[0].is_periodic, found[1].is_periodic) == (False, True)
    np.testing.assert_array_equal(found[1].holes, HOLES)
    assert found[1].pixel_size == pytest.approx((1e-8, 1e-8), rel=1e-14)
    containers.write_containers(sets, str(tmp_path / "both.zip"))
    refuses(lambda: ck.read_surfaces(tmp_path / "both.zip"), "'stylus'", "be a map", "left out")
    maps = ck.read_surfaces(tmp_path / "both.zip", line_scans="left out")
    assert len(maps) == 2
    assert next(iter(maps)) == "surface0, fine"


@pytest.mark.slow
def test_raw_data_of_a_container_is_read_as_the_container_states(container, tmp_path):
    pytest.importorskip("SurfaceTopography")
    file = tmp_path / "raw.zip"
    entry = {
        "name": "raw",
        "datafile": {"original": "scan.txt"},
        "size": [100.0, 60.0],
        "unit": "nm",
        "is_periodic": True,
        "detrend_mode": "center",
        "height_scale": 2.0,
    }
    with zipfile.ZipFile(file, "w") as packed:
        rows = "\n".join(" ".join(map(repr, map(float, row))) for row in 1e9 * HEIGHTS)
        packed.writestr("scan.txt", rows)
        packed.writestr("meta.yml", json.dumps({"surfaces": [{"topographies": [entry]}]}))
    found = ck.read_surfaces(file)["raw"]
    assert found.pixel_size == pytest.approx((1e-8, 1e-8), rel=1e-12)
    np.testing.assert_allclose(found.heights.std(), 2.0 * HEIGHTS.std(), rtol=1e-9)
    assert abs(found.heights.mean()) < 1e-20
    assert found.is_periodic is True


def test_a_topography_and_back_is_the_same_surface():
    pytest.importorskip("SurfaceTopography")
    from contactkit.scene.topography import as_surface

    made = ck.to_topography(PERIODIC, info={"name": "one"})
    assert made.info["name"] == "one"
    back = as_surface(made)
    np.testing.assert_array_equal(back.heights, HEIGHTS)
    assert back.pixel_size == pytest.approx(PERIODIC.pixel_size, rel=1e-15)
    assert back.is_periodic is True
    nano = ck.to_topography(HOLEY, unit="nm")
    assert (nano.unit, nano.has_undefined_data) == ("nm", True)
    np.testing.assert_allclose(nano.physical_sizes, (100.0, 60.0), rtol=1e-12)
    np.testing.assert_allclose(nano.heights()[~HOLES.T], 1e9 * HEIGHTS.T[~HOLES.T], rtol=1e-12)
    refuses(lambda: ck.to_topography(PERIODIC, unit="N"), "be a unit of length")


def test_the_index_of_an_older_container_is_in_yaml(container, tmp_path):
    pytest.importorskip("yaml")
    index = members(container)["index.json"].decode()
    entry = json.loads(index)["surfaces"][0]["topographies"][0]
    size = "".join(f"\n    - {one!r}" for one in entry["size"])
    text = (
        "surfaces:\n- name: old\n  topographies:\n  - name: first\n    is_periodic: true\n"
        f"    unit: m\n    size: !!python/tuple{size}\n"
        "    datafile: {squeezed-netcdf: topography0.nc}\n"
    )
    file = packed(tmp_path / "old.zip", members(container), {"meta.yml": text.encode()},
                  without="index.json")  # fmt: skip
    same(ck.read_surfaces(file)["first"], PERIODIC)
    for hostile in ("a: &x [1]\nb: *x\n", "a: !!python/object/apply:os.getcwd []\n", "a: [1\n"):
        bad = packed(tmp_path / "bad.zip", members(container), {"meta.yml": hostile.encode()},
                     without="index.json")  # fmt: skip
        refuses(lambda bad=bad: ck.read_surfaces(bad), "hold YAML", "meta.yml")


# Refusals -----------------------------------------------------------------------------------------


def members(file):
    with zipfile.ZipFile(file) as found:
        return {name: found.read(name) for name in found.namelist()}


def packed(path, parts, more, without=""):
    with zipfile.ZipFile(path, "w") as made:
        for name, content in (parts | more).items():
            if name != without:
                made.writestr(name, content)
    return path


def changed(file, change):
    """The container with its index changed."""
    parts = members(file)
    index = json.loads(parts["index.json"])
    change(index)
    return packed(file.with_name("changed.zip"), parts, {"index.json": json.dumps(index)})


def first(index):
    return index["surfaces"][0]["topographies"][0]


@pytest.mark.errors
@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (lambda index: index.pop("surfaces"), ("surfaces", "be a list")),
        (lambda index: index["surfaces"][0].clear(), ("topographies", "be a list")),
        (lambda index: first(index).pop("datafile"), ("topography 0", "name its datafile")),
        (lambda index: first(index).update(size=[1.0]), ("'all'", "be a map", "left out")),
        (
            lambda index: first(index)["datafile"].update({"squeezed-netcdf": "none.nc"}),
            ("have a member none.nc",),
        ),
        (lambda index: index.update(surfaces=[]), ("hold a map of heights",)),
        (lambda index: first(index).update(unit="K"), ("be a unit of length",)),
    ],
)
def test_an_index_that_is_wrong_is_refused(container, change, parts):
    refuses(lambda: ck.read_surfaces(changed(container, change)), *parts)


@pytest.mark.errors
def test_files_that_are_no_container_are_refused(container, tmp_path):
    (tmp_path / "text.zip").write_text("nothing")
    refuses(lambda: ck.read_surfaces(tmp_path / "text.zip"), "be a ZIP file", "ck.Measured(path")
    refuses(lambda: ck.read_surfaces(tmp_path / "none.zip"), "none.zip")
    empty = packed(tmp_path / "empty.zip", {"a.txt": b""}, {})
    refuses(lambda: ck.read_surfaces(empty), "hold index.json or meta.yml", "a.txt")
    whole = members(container)
    for cut in (0, 3, 40, 200, len(whole["topography0.nc"]) // 2):
        broken = packed(
            tmp_path / "b.zip", whole, {"topography0.nc": whole["topography0.nc"][:cut]}
        )
        refuses(lambda broken=broken: ck.read_surfaces(broken), "topography0.nc")
    measured = ck.Measured(path=container)
    refuses(measured.as_heights, "be one map", "it is a container: ck.read_surfaces(")
    refuses(lambda: ck.read_surfaces(container, line_scans="kept"), "be 'refused' or 'left out'")


@pytest.mark.errors
def test_a_damaged_netcdf_file_never_ends_in_another_error(container, tmp_path):
    whole = members(container)
    content = whole["topography1.nc"]
    for at in range(0, min(len(content), 900), 17):
        broken = content[:at] + bytes([content[at] ^ 0x5A]) + content[at + 1 :]
        file = packed(tmp_path / "b.zip", whole, {"topography1.nc": broken})
        with contextlib.suppress(DescriptionError):
            ck.read_surfaces(file)


@pytest.mark.errors
@pytest.mark.parametrize(
    ("surfaces", "parts"),
    [
        ({}, ("be surfaces by their names",)),
        (PERIODIC, ("be surfaces by their names",)),
        ({"flat": ck.Flat()}, ("surfaces['flat']", "heights of its own", "surface_heights")),
        ({"number": 3.0}, ("heights of its own",)),
        ({"array": np.zeros((3, 4))}, ("got 'an array of shape (3, 4)'", "ck.Heights(heights=")),
    ],
)
def test_what_is_no_surface_is_not_written(tmp_path, surfaces, parts):
    refuses(lambda: ck.write_surfaces(tmp_path / "a.zip", surfaces), *parts)
    assert not list(tmp_path.iterdir())


@pytest.mark.errors
def test_names_of_files_and_maps_are_checked(tmp_path):
    refuses(lambda: ck.write_surfaces(tmp_path / "a.npz", {"a": PERIODIC}), "end in .zip")
    result = ck.solve(ck.plan(scene(PERIODIC)))
    refuses(lambda: ck.surface_from(result, "pressure"), "no height", "to_xarray")
    refuses(lambda: ck.surface_from(result, "gaps"), "did you mean 'gap'")
    refuses(lambda: ck.surface_from(PERIODIC), "be the result of a contact")
