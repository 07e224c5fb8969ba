"""Readers of files, valid files for each, and what an object that was read must be like."""

from __future__ import annotations

import functools
import importlib.util
import io
import json
import math
import numbers
import tempfile
import warnings
import zipfile
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.errors import DescriptionError
from contactkit.files.results import to_bytes
from contactkit.fmu.contents.packing import write_archive
from contactkit.fmu.contents.reference_check import read_references
from contactkit.fmu.contents.references import ReferenceRun, reference_files
from contactkit.fmu.contents.ssp import Component
from contactkit.fmu.framework import state as fmu_state
from contactkit.models.library import bundled_scenes
from contactkit.reading.images import read_coverage
from contactkit.roughness.height_maps import read_height_map
from contactkit.studies.store import Store
from contactkit.units import parse_quantity, parse_unit


class Reader(NamedTuple):
    """Valid files by their names, the call that reads one, and a check of what it returns."""

    seeds: Mapping[str, bytes]
    read: Callable[[Path], Any]
    check: Callable[[Any], None]


def readers() -> dict[str, Callable[[], Reader]]:
    """Readers by name; each is made when it is called."""
    return {
        "scene": _scenes,
        "result": _results,
        "curve": _curves,
        "fit": _fits,
        "measured curve": _measured,
        "map": _maps,
        "container": _containers,
        "image": _images,
        "fmu": _fmus,
        "ssp": _components,
        "reference": _references,
        "study": _points,
        "study file": _study_files,
        "state": _states,
        "quantity": _quantities,
    } | ({"instrument": _instruments} if has_instruments() else {})


# Scenes --------------------------------------------------------------------------------------


def _scenes() -> Reader:
    folder = resources.files(ck.data) / "templates"
    seeds = {one.name: one.read_bytes() for one in folder.iterdir() if one.name.endswith("toml")}
    seeds |= {path.name: path.read_bytes() for path in bundled_scenes().values()}
    return Reader(seeds, lambda path: open_scene(str(path)), _check_scene)


def _check_scene(opened: Any) -> None:
    """What was read is written and read again as the same, if a file can hold it."""
    scene = opened.scene
    assert isinstance(opened.name, str)
    if not isinstance(scene, ck.ContactScene | ck.SeparationScene | ck.SlidingScene):
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "again.toml"
        try:
            ck.save_scene(scene, path)
        except ck.ContactkitError:
            return
        assert ck.load_scene(path) == scene


# Results -------------------------------------------------------------------------------------


@functools.cache
def _results() -> Reader:
    steel = ck.Material(young_modulus=2e11, poisson_ratio=0.3)
    pressed = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=steel), upper=ck.Wave(amplitude=1e-9, wavelength=1e-6)
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e7),
        effects=(ck.HalfSpace(), ck.FrictionTraction(coefficient=0.1)),
    )
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    film = ck.Interface(
        lower=ck.Flat(radius=1e-3),
        upper=ck.Flat(radius=1e-3),
        meniscus=ck.Meniscus(liquid=oil, volume=1e-12),
    )
    opening = ck.ImposedForce(force=10.0, mass=0.01, initial_gap=1e-6, final_gap=2e-6)
    effects = (ck.MeniscusForce(), ck.ViscousForce())
    opened = ck.SeparationScene(interface=film, loading=opening, effects=effects)
    slid = ck.SlidingScene(
        interface=film, loading=ck.Sliding(gap=1e-6, speed=1e-3), effects=(ck.CouetteForce(),)
    )
    coarse = ck.Accuracy(time_rtol=1e-4)
    made = {
        "contact": ck.solve(ck.plan(pressed, ck.Accuracy(grid=8))),
        "separation": ck.simulate(ck.plan(opened, coarse)),
        "sliding": ck.simulate(ck.plan(slid, ck.Accuracy(points=20))),
    }
    return Reader({f"{n}.npz": to_bytes(one) for n, one in made.items()}, _loaded, _check_result)


def _loaded(path: Path) -> Any:
    return ck.load_result(path)


def _check_result(result: Any) -> None:
    for name, (value, unit) in result.scalars().items():
        assert isinstance(value, numbers.Real), (name, value)
        assert isinstance(unit, str), (name, unit)
    assert to_bytes(result)
    assert str(result)
    assert isinstance(result.status, str)


def _curves() -> Reader:
    film = ck.Meniscus(liquid=ck.Liquid(name="air"))
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1e-5), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-6, speed=1e-6),
        effects=(ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e9),),
    )
    slider = ck.SpringSlider(
        load=1.0, static_coefficient=0.5, kinetic_coefficient=0.3, stiffness=100.0, speed=1e-3
    )
    made = {
        "sphere": ck.adhesion_curve(scene, [0.0, 1e-6]),
        "slips": ck.stick_slip(slider, n_slips=2),
    }
    with tempfile.TemporaryDirectory() as folder:
        saved = {n: one.save(Path(folder) / n).read_bytes() for n, one in made.items()}
    return Reader({f"{n}.npz": one for n, one in saved.items()}, ck.read_curve, _check_curve)


def _check_curve(curve: Any) -> None:
    for name, (values, unit) in curve.table().items():
        assert len(curve[name]) == len(values)
        assert isinstance(unit, str), (name, unit)
    assert str(curve)
    assert curve.contents().remarks["status"] == curve.status


def _fits() -> Reader:
    oil = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=oil),
        loading=ck.ImposedSpeed(initial_gap=1e-6, final_gap=1e-5, speed=1e-5),
        effects=(ck.ViscousForce(),),
    )
    given = {"over": "gap", "quantity": "viscous_force", "values": [1e-5, 5e-6, 2e-6]}
    curve = ck.MeasuredCurve(at=[2e-6, 4e-6, 9e-6], **given)
    made = ck.fit(scene, curve, {"interface.meniscus.liquid.viscosity": (1e-3, 10.0)})
    with tempfile.TemporaryDirectory() as folder:
        saved = made.save(Path(folder) / "fit").read_bytes()
    return Reader({"fit.npz": saved}, ck.read_fit, _check_fit)


def _check_fit(fit: Any) -> None:
    for name, (value, unit) in fit.scalars().items():
        assert isinstance(value, numbers.Real), (name, value)
        assert isinstance(unit, str), (name, unit)
    assert str(fit)
    assert isinstance(fit.cite(), str)
    assert fit.contents().rows == ("parameter",)


def _measured() -> Reader:
    plain = b"gap [um],force [mN]\n1.0,30\n2.0,20\n# a remark\n4.0,9.5e0\n"
    quoted = b'"gap (um)";"force (mN)"\n1.0;30\n2.0;20\n'
    read = functools.partial(ck.read_measured_curve, over="gap", quantity="force")
    return Reader({"plain.csv": plain, "quoted.csv": quoted}, read, _check_measured)


def _check_measured(curve: Any) -> None:
    assert np.isfinite(curve.x).all()
    assert curve.x.shape == curve.y.shape
    assert isinstance(curve.units[0], str)


# Height maps ---------------------------------------------------------------------------------

_HEIGHTS = np.array([[0.0, 1.0, 2.0, 0.5], [3.0, 4.0, 5.5, 1.0], [0.1, 0.2, 0.3, 0.4]])
_SDF = """aISO-1.0
ManufacID = me
NumPoints = 4
NumProfiles = 3
Xscale = 1e-9
Yscale = 2e-9
Zscale = 1e-9
Zresolution = -1
Compression = 0
DataType = 7
CheckType = 0
*
0 1 2 0.5 3 4 5.5 1 0.1 0.2 0.3 0.4
*
"""


def _maps() -> Reader:
    file = io.BytesIO()
    np.save(file, _HEIGHTS)
    rows = "\n".join(", ".join(map(str, row)) for row in _HEIGHTS.tolist())
    points = "\n".join(f"{j} {i} {_HEIGHTS[i, j]}" for i in range(3) for j in range(4))
    seeds = {
        "a.npy": file.getvalue(),
        "a.csv": f"# a map\n{rows}\n".encode(),
        "a.txt": rows.replace(",", " ").encode(),
        "a.xyz": points.encode(),
        "a.sdf": _SDF.encode(),
    }
    return Reader(seeds, _read_map, _check_map)


def _containers() -> Reader:
    with tempfile.TemporaryDirectory() as folder:
        one = ck.Heights(heights=np.ma.masked_equal(_HEIGHTS, 3.0), pixel_size=1e-9)
        content = ck.write_surfaces(Path(folder) / "a.zip", {"a": one, "b": one}).read_bytes()

    def check(found: Any) -> None:
        assert found
        for surface in found.values():
            _check_map(surface)

    return Reader({"a.zip": content}, ck.read_surfaces, check)


def _images() -> Reader:
    from PIL import Image

    grey, array, drawn = (
        np.array([[0, 51, 255], [0, 255, 255]], np.uint8),
        io.BytesIO(),
        io.BytesIO(),
    )
    np.save(array, grey / 255.0)
    Image.fromarray(grey).save(drawn, "PNG")

    def check(found: Any) -> None:
        assert found.ndim == 2
        assert found.dtype == np.float64
        assert ((found >= 0.0) & (found <= 1.0)).all()

    seeds = {"a.npy": array.getvalue(), "a.png": drawn.getvalue()}
    return Reader(seeds, lambda path: read_coverage(str(path)), check)


def has_instruments() -> bool:
    """Whether the package that reads files of instruments is here."""
    return importlib.util.find_spec("SurfaceTopography") is not None


def _instruments() -> Reader:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a package that it may do without
        from SurfaceTopography import Topography
    from scipy.io import savemat

    made = Topography(_HEIGHTS.T.copy(), (4e-9, 3e-9), unit="m")
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for ending, write in (
            ("x3p", made.to_x3p),
            ("gwy", made.to_gwy),
            ("nc", made.to_netcdf),
            ("mat", lambda path: savemat(path, {"heights": _HEIGHTS})),
        ):
            path = Path(folder) / f"a.{ending}"
            write(str(path))
            found[path.name] = path.read_bytes()
    return Reader(found, _read_map, _check_map)


def _read_map(path: Path) -> Any:
    given = {"pixel_size": 1e-9, "unit": "nm"}
    itself = {".xyz": {"unit": "nm"}, ".sdf": {}, ".x3p": {}, ".gwy": {}, ".nc": {}}
    return read_height_map(path, **itself.get(path.suffix, given))


def _check_map(found: Any) -> None:
    assert found.heights.ndim == 2
    assert min(found.heights.shape) >= 2
    assert found.heights.dtype == np.float64
    assert np.isfinite(found.heights).all()
    assert np.abs(found.heights).max() <= 1e60
    assert all(math.isfinite(size) and 0.0 < size <= 1e60 for size in found.pixel_size)


# FMUs ----------------------------------------------------------------------------------------

DESCRIPTION = b"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="lag" guid="{1}" generationTool="none">
  <CoSimulation modelIdentifier="lag" canHandleVariableCommunicationStepSize="true"/>
  <UnitDefinitions><Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit></UnitDefinitions>
  <ModelVariables>
    <ScalarVariable name="u" valueReference="0" causality="input"><Real start="0" unit="N"/>
    </ScalarVariable>
    <ScalarVariable name="k" valueReference="1" causality="parameter" variability="fixed">
      <Real start="2.5" unit="N"/></ScalarVariable>
    <ScalarVariable name="y" valueReference="2" causality="output"><Real unit="N"/>
    </ScalarVariable>
  </ModelVariables>
  <ModelStructure><Outputs><Unknown index="3"/></Outputs></ModelStructure>
</fmiModelDescription>
"""


def fmu(description: bytes = DESCRIPTION, more: Mapping[str, bytes] | None = None) -> bytes:
    """Archive of an FMU without a library."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("modelDescription.xml", description)
        for name, content in (more or {"resources/a.txt": b"a"}).items():
            packed.writestr(name, content)
    return made.getvalue()


def _fmus() -> Reader:
    from contactkit.fmu.framework.instance import _described

    def check(found: Any) -> None:
        assert found.coSimulation.modelIdentifier.isidentifier()

    return Reader({"a.fmu": fmu()}, _described, check)


def _components() -> Reader:
    def read(path: Path) -> Any:
        return Component(name="a", source=path.name, fmu=path.read_bytes()).model()

    def check(root: Any) -> None:
        assert root.tag

    return Reader({"a.fmu": fmu()}, read, check)


def _references() -> Reader:
    """Reference results in an FMU: the archive, and each of its files."""
    rows = {"time": [0.0, 0.5, 1.0], "u": [2.0, 2.0, 1e-300]}
    run = ReferenceRun(
        name="pull",
        description="by hand",
        stop_time=1.0,
        step=0.5,
        stimuli=rows,
        references={"time": [0.5, 1.0], "y": [0.0, -4.0]},
        tolerance=1e-6,
    )

    def check(found: Any) -> None:
        for one in found:
            assert 0.0 < one.step <= one.stop_time < math.inf
            for column in (*one.stimuli.values(), *one.references.values()):
                assert all(map(math.isfinite, column))

    with tempfile.TemporaryDirectory() as folder:
        path = write_archive(reference_files(run), Path(folder) / "a.fmu")
        seeds = {"a.fmu": path.read_bytes()}
    return Reader(seeds, read_references, check)


# Plain values --------------------------------------------------------------------------------


def _points() -> Reader:
    point = {
        "values": {"loading.pressure": "1e6"},
        "status": "converged",
        "message": "",
        "scalars": {"contact_fraction": ["0.25", "-"], "approach": ["inf", "m"]},
        "scales": {"Pa": ["1e6", "E*", "reduced modulus"]},
        "seconds": 0.5,
        "counts": {"n_operator_applications": 12},
        "notes": ["a note"],
    }

    def read(path: Path) -> Any:
        return Store(path.parent).read(path.stem, {})

    def check(found: Any) -> None:
        assert all(isinstance(value, float) for value, _ in found.scalars.values())
        assert all(isinstance(count, int) for count in found.counts.values())

    return Reader({"a.json": json.dumps(point).encode()}, read, check)


def _study_files() -> Reader:
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
    face = ck.Flat(radius=1e-3)
    scene = ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-12)
        ),
        loading=ck.ImposedTime(time=1e-3, initial_gap=1e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )
    with tempfile.TemporaryDirectory() as folder:
        made = ck.stream_study(scene, {"loading.time": [1e-3, 2e-3]}, Path(folder) / "a")
        content = made.path.read_bytes()

    def check(found: Any) -> None:
        for name in (*found.units, "status"):
            assert len(found.column(name)) == found.n_points
        list(found.failed())

    return Reader({"a.sqlite": content}, ck.StudyFile, check)


def _states() -> Reader:
    from contactkit.fmu.slaves.valve_drive import ValveDrive

    values = {port.name: 0.0 if port.start is None else port.start for port in ValveDrive.ports}
    taken = {
        "build": "b",
        "phase": "stepping",
        "prepared": True,
        "stale": False,
        "failure": "",
        "time": 0.5,
        "start_time": 0.0,
        "stop_time": None,
        "values": values,
        "hidden": {"a": 1.0},
    }

    def read(path: Path) -> Any:
        found = fmu_state.from_bytes(path.read_bytes())
        fmu_state.check_state(found, "b", ValveDrive.ports)
        return found

    def check(found: Any) -> None:
        assert math.isfinite(found["time"])

    return Reader({"a.json": fmu_state.to_bytes(taken)}, read, check)


def _quantities() -> Reader:
    def read(path: Path) -> Any:
        try:
            text = path.read_text("utf-8")
        except UnicodeDecodeError:
            raise DescriptionError("text", path.name, "be UTF-8") from None
        parse_unit(text.partition(" ")[2])
        return parse_quantity(text, "m")

    def check(found: Any) -> None:
        assert isinstance(found, float)

    return Reader({"a": b"2.5 nm", "b": b"-1.5e-3 um", "c": b"1 N.m^2/N/m"}, read, check)
