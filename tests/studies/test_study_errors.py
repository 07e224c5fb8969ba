"""What a study and a file of a contact refuse, and what they say to that."""

from __future__ import annotations

import re

import numpy as np
import pytest

import contactkit as ck
from contactkit.contact import chain
from contactkit.files import contact_results as contact_archive
from contactkit.studies import run as study_run

pytestmark = [
    pytest.mark.errors,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
ACCURACY = ck.Accuracy(grid=16, rtol=1e-4)


def contact(*effects, surface=None, **lower):
    wave = ck.Wave(amplitude=1e-8, wavelength=1e-6)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(**{"solid": STEEL} | lower), upper=ck.Body(surface=surface or wave)
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e9),
        effects=(ck.HalfSpace(), *effects),
    )


def refuses(action, *parts, error=ck.DescriptionError):
    with pytest.raises(error) as caught:
        action()
    for part in parts:
        assert re.search(re.escape(part), str(caught.value)), (part, str(caught.value))


# What is varied -----------------------------------------------------------------------------


@pytest.fixture
def nothing_solved(monkeypatch):
    """Refusals come before any work."""

    def solve(*arguments, **named):
        raise AssertionError("something was solved")

    monkeypatch.setattr(chain, "solve_unwarned", solve)
    monkeypatch.setattr(study_run, "unprepared_plan", solve)


PATHS = {
    "loading.presure": ("did you mean 'loading.pressure'?", "pressure, force"),
    "pressing.pressure": ("it is now [loading]", "interface, window, loading, effects"),
    "loadin.pressure": ("did you mean 'loading'?", "interface, window, loading, effects"),
    "interface.lower.solid.young_moduli": ("'interface.lower.solid.young_modulus'", "poisson"),
    "interface.lower.solid.layers.0.thickness": ("'interface.lower.solid' is a Material",),
    "interface.upper.surface.rms": ("is a Wave, with amplitude, wavelength",),
    "effects.friction-tracton.coefficient": (
        "did you mean 'effects.friction-traction'?",
        "half-space, friction-traction",
    ),
    "effects.0.coefficient": ("'effects' has the items half-space",),
    "loading.pressure.value": ("must end at 'loading.pressure'", "that is 1000000000.0"),
    "accuracy.rtoll": ("did you mean 'accuracy.rtol'?", "grid, rtol"),
    "accuracy": ("such as 'accuracy.rtol'",),
    "interface.meniscus.volume": ("must end at 'interface.meniscus'", "that is None"),
    "": ("there are accuracy, name",),
}


@pytest.mark.parametrize("path", PATHS)
def test_a_path_that_leads_nowhere_is_put_right(nothing_solved, path):
    scene = contact(ck.FrictionTraction(coefficient=0.1))
    refuses(lambda: ck.study(scene, {path: [1.0]}, ACCURACY), repr(path), *PATHS[path])


@pytest.mark.parametrize(
    ("vary", "parts"),
    [
        ({}, ("parameters must name at least one field", "{}")),
        ("loading.pressure", ("parameters must name at least one field",)),
        (
            {("loading.pressure", 2): [(1e6, 2)]},
            ("parameters must be named by a path, or by a tuple",),
        ),
        ({(): [()]}, ("parameters must be named by a path, or by a tuple of paths",)),
        (
            {"loading.pressure": []},
            ("parameters['loading.pressure'] must have at least one value",),
        ),
        ({"loading.pressure": "5 MPa"}, ("must be a sequence of values", "'5 MPa'")),
        ({"loading.pressure": 5e6}, ("must be a sequence of values", "5000000.0")),
        ({"loading.pressure": ["5 nm"]}, ("Pressing.pressure must be in a unit", "Pa")),
        ({"loading.pressure": [1e6, float("nan")]}, ("Pressing.pressure must be a finite number",)),
        ({"loading.force": [1e-3]}, ("exactly one of pressure", "force")),
        ({"interface.lower.solid": ["stel"]}, ("be a material of the library", "stel")),
        ({"accuracy.rtol": [2.0]}, ("Accuracy.rtol must lie between",)),
        ({"accuracy.method": ["active"]}, ("Accuracy.method must be one of",)),
        (
            {"interface.lower.solid": [STEEL], "interface.lower.solid.young_modulus": [1e9]},
            ("not lie inside 'interface.lower.solid'",),
        ),
    ],
)
def test_what_cannot_be_varied_is_refused_before_any_solve(nothing_solved, vary, parts):
    refuses(lambda: ck.study(contact(), vary, ACCURACY), *parts)


def test_numbers_of_workers_and_scenes_are_checked(nothing_solved):
    vary = {"loading.pressure": [1e9]}
    for workers in (0, -1, 1.5, True):
        refuses(lambda n=workers: ck.study(contact(), vary, workers=n), "workers must be a whole")


def test_a_plan_is_no_scene():
    kinds = "be a ContactScene, a SeparationScene or a"
    refuses(lambda: ck.study(ck.plan(contact(), ACCURACY), {"loading.pressure": [1e9]}), kinds)


def test_effects_that_do_not_fit_are_refused_before_any_solve(nothing_solved):
    refuses(
        lambda: ck.study(contact(ck.HardnessLimit()), {"loading.pressure": [1e9]}, ACCURACY),
        "HardnessLimit needs hardness [Pa] of 'steel'",
        error=ck.PlanError,
    )


def test_a_study_of_refused_points_only_is_refused():
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1e-8)
    refuses(
        lambda: ck.study(contact(surface=rough), {"loading.pressure": [1e8, 2e8]}, ACCURACY),
        "every point of the study is refused",
        "at least two pixels",
        error=ck.PlanError,
    )


def test_an_unknown_column_gets_a_guess():
    study = ck.study(contact(), {"loading.pressure": [1e9]}, ACCURACY)
    refuses(lambda: study.column("contact_aria"), "did you mean 'contact_area'?")
    refuses(lambda: study.unit("pressure"), "column must be one of the study")
    refuses(lambda: study.table("lod"), "did you mean 'load'?")


def test_an_error_that_is_not_ours_is_not_swallowed(monkeypatch):
    def solve(*arguments, **named):
        raise ZeroDivisionError("a bug")

    monkeypatch.setattr(chain, "solve_unwarned", solve)
    with pytest.raises(
        ck.ContactkitError, match=r"every point .* failed: ZeroDivisionError: a bug"
    ):
        ck.study(contact(), {"loading.pressure": [1e9, 2e9]}, ACCURACY)


DIES = """
import os, sys
import contactkit as ck
from contactkit.contact import chain

sys.path.insert(0, sys.argv[1])
import test_study_errors as scenes

chain.solve_unwarned = lambda *arguments, **named: os._exit(1)  # in the workers too
if __name__ == "__main__":
    try:
        ck.study(scenes.contact(), {"loading.pressure": [1e9, 2e9]}, scenes.ACCURACY, workers=2)
    except ck.ContactkitError as error:
        print(error)
"""


@pytest.mark.slow
def test_a_worker_that_dies_is_reported(tmp_path):
    import subprocess
    import sys
    from pathlib import Path

    script = tmp_path / "dies.py"
    script.write_text(DIES, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script), str(Path(__file__).parent)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert "a worker process ended before its points did" in done.stdout, done.stderr
    assert "__main__" in done.stdout


# Files --------------------------------------------------------------------------------------

HEIGHTS = ck.Heights(heights=np.zeros((4, 4)), pixel_size=1e-9)


@pytest.mark.parametrize(
    ("scene", "parts"),
    [
        (
            contact(surface=HEIGHTS),
            ("Heights.heights must not be an array", "(4, 4)", ".npy", "Measured(path="),
        ),
        (
            contact(surface=ck.CombinedSurface(parts=(HEIGHTS,))),
            ("Heights.heights must not be an array",),
        ),
        (
            contact(
                ck.HardnessLimit(
                    rule=ck.ConstantHardness(hardness=ck.HardnessMap(np.full((4, 4), 1e9)))
                )
            ),
            ("HardnessMap.values must not be an array", "result files"),
        ),
    ],
)
def test_an_array_has_no_place_in_a_scene_file(tmp_path, scene, parts):
    refuses(lambda: ck.save_scene(scene, tmp_path / "scene.toml"), *parts)
    assert list(tmp_path.iterdir()) == []


TEXT = """
effects = [{effect = "layered-half-space"}]
[interface.lower.solid]
substrate = "ni-p"
layers = [{material = "dlc", thickness = "5 nm"}]
[interface.upper.surface]
shape = "gaussian-roughness"
rms = "1 nm"
correlation_length = "50 nm"
cutoff = "20 nm"
[window]
width = "1 um"
periodic = true
[loading]
kind = "pressing"
pressure = "10 MPa"
"""


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("pressure =", "presure =", ("presure", "did you mean 'pressure'?", "at loading")),
        ('"dlc"', '"dcl"', ("dcl", "did you mean 'dlc'?", "layers[0]")),
        ('"ni-p"', '"rigid"', ("be a material of the library", "substrate")),
        ("thickness", "thicknes", ("Layer.thicknes", "did you mean 'thickness'?")),
        ("layers =", "layer =", ("Stack.layer", "did you mean 'layers'?")),
        ('"layered-half-space"', '"layered"', ("'layered-half-space'", "effects[0]")),
        ('"gaussian-roughness"', '"gausian"', ("did you mean 'gaussian-roughness'?",)),
        ("rms", "rmss", ("did you mean 'rms'?",)),
        ('"1 um"', '"1 Pa"', ("Window.width must be in a unit that converts to m",)),
        ("true", '"false"', ("must be True, False", "'false'", "at window")),
        ('"10 MPa"', '"10 MPa"\nforce = "1 N"', ("exactly one of pressure",)),
    ],
)
def test_a_mistake_in_a_scene_file_is_found_and_put_right(tmp_path, old, new, parts):
    path = tmp_path / "slider.toml"
    path.write_text(TEXT, encoding="utf-8")
    assert ck.load_scene(path).loading.pressure == 1e7
    assert old in TEXT
    path.write_text(TEXT.replace(old, new), encoding="utf-8")
    refuses(lambda: ck.load_scene(path), "slider.toml cannot be used", *parts)


def test_heights_in_a_scene_file_are_refused_with_a_cure(tmp_path):
    path = tmp_path / "scene.toml"
    table = 'shape = "heights"\nheights = [[0.0, 1.0], [0.0, 1.0]]\npixel_size = 1e-9\n[window]'
    text = re.sub(r'shape = "gaussian.*?\[window\]', table, TEXT, flags=re.S)
    path.write_text(text, encoding="utf-8")
    refuses(lambda: ck.load_scene(path), "Heights.heights must be an array in hand", ".npy")


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    result = ck.solve(ck.plan(contact(ck.FrictionTraction(coefficient=0.1)), ACCURACY))
    return ck.save_result(result, tmp_path_factory.mktemp("saved") / "contact.npz")


@pytest.mark.parametrize("fraction", [0.0, 0.01, 0.5, 0.9, 0.999])
def test_a_result_that_was_cut_short_is_refused(tmp_path, saved, fraction):
    whole = saved.read_bytes()
    path = tmp_path / "cut.npz"
    path.write_bytes(whole[: int(fraction * len(whole))])
    refuses(lambda: ck.load_result(path), "file must be a result of contactkit", "cut.npz")


@pytest.mark.parametrize("at", [0.3, 0.6])
def test_a_result_with_a_damaged_byte_is_refused(tmp_path, saved, at):
    data = bytearray(saved.read_bytes())
    first = int(at * len(data))
    data[first : first + 64] = bytes(b ^ 0xFF for b in data[first : first + 64])
    path = tmp_path / "damaged.npz"
    path.write_bytes(bytes(data))
    refuses(lambda: ck.load_result(path), "file must be a result of contactkit")


@pytest.mark.parametrize("drop", ["pressure", "friction-traction.traction_x"])
def test_a_result_without_one_of_its_arrays_is_refused(tmp_path, saved, drop):
    with np.load(saved) as file:
        arrays = {name: file[name] for name in file.files if name != drop}
    path = tmp_path / "less.npz"
    np.savez(path, **arrays)
    refuses(lambda: ck.load_result(path), "file must be a result of contactkit", drop)


def test_an_array_that_is_no_result_is_refused(tmp_path):
    np.save(tmp_path / "map.npy", np.zeros((4, 4)))
    refuses(lambda: ck.load_result(tmp_path / "map.npy"), "file must be a result of contactkit")
    np.savez(tmp_path / "other.npz", values=np.zeros(3))
    refuses(lambda: ck.load_result(tmp_path / "other.npz"), "file must be a result of contactkit")


def test_a_part_that_has_no_place_in_a_file_is_not_left_out_silently():
    with pytest.raises(TypeError, match="of an effect: a set has no place in a result file"):
        contact_archive._encode({"of an effect": {1, 2}}["of an effect"], "of an effect", {})
