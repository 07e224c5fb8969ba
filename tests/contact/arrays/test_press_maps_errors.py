"""Refusals of `press_maps` and their messages."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest
from libraries import SOLID, rough, strict_library, torch_library

import contactkit as ck
from contactkit.contact.arrays.namespace import Space
from contactkit.errors import MissingExtraError

pytestmark = pytest.mark.errors

H = np.array([rough(16, seed) for seed in range(2)])
KNOWN = {"pixel_size": 1.0 / 16, "stack": SOLID, "mean_pressure": 1e6}
REFUSED = [
    ({"heights": np.zeros((2, 1, 8))}, r"press_maps\(heights\).*at least 2 x 2"),
    ({"heights": np.zeros(8)}, r"press_maps\(heights\).*at least 2 x 2"),
    ({"heights": np.zeros((0, 8, 8))}, r"press_maps\(heights\).*at least 2 x 2"),
    ({"heights": np.full((2, 8, 8), np.nan)}, r"press_maps\(heights\).*finite"),
    ({"heights": np.full((2, 8, 8), 1e200)}, r"press_maps\(heights\).*below 1e\+140"),
    ({"heights": np.ma.masked_greater(H, 0.0)}, r"press_maps\(heights\).*a hardness of 0"),
    ({"heights": "rough.npy"}, r"press_maps\(heights\).*array API"),
    ({"pixel_size": 0.0}, r"press_maps\(pixel_size\).*positive"),
    ({"pixel_size": (1.0, 1.0, 1.0)}, r"press_maps\(pixel_size\).*positive"),
    ({"pixel_size": None}, r"press_maps\(pixel_size\).*positive"),
    ({"pixel_size": "10 Pa"}, r"press_maps\(pixel_size\)"),
    ({"stack": "steel"}, r"press_maps\(stack\).*Material"),
    ({"mean_pressure": -1.0}, r"press_maps\(mean_pressure\).*0 or positive"),
    ({"mean_pressure": np.inf}, r"press_maps\(mean_pressure\).*finite"),
    ({"mean_pressure": [1.0, 2.0, 3.0]}, r"press_maps\(mean_pressure\).*an array \(2,\)"),
    ({"mean_pressure": "5 nm"}, r"press_maps\(mean_pressure\)"),
    ({"mean_pressure": [None, 1.0]}, r"press_maps\(mean_pressure\).*finite"),
    ({"mean_pressure": {1.0}}, r"press_maps\(mean_pressure\).*a number or an array"),
    ({"mean_pressure": None}, "given one without the other"),
    ({"approach": 1e-3}, "given one without the other"),
    ({"hardness": -1.0}, r"press_maps\(hardness\).*0 or positive"),
    ({"hardness": np.ones((8, 8))}, r"press_maps\(hardness\).*an array \(16, 16\)"),
    ({"hardness": 1e5}, "exceeds what the hardness can carry, 100000 Pa"),
    ({"periodic": "z"}, r"press_maps\(periodic\).*True, False"),
    ({"rtol": 0.0}, r"press_maps\(rtol\).*at least 2.2e-15"),
    ({"mean_pressure": None, "approach": 1.0}, "reaches the mean plane"),
]


@pytest.mark.parametrize(("given", "says"), REFUSED)
def test_refused(given, says):
    """The same for arrays of numpy and of another library."""
    given = {"heights": H, **KNOWN, **given}
    with pytest.raises((ck.ContactkitError, ck.DescriptionError), match=says):
        ck.press_maps(**given)
    heights = given["heights"]
    if type(heights) is np.ndarray:
        library = strict_library()
        with pytest.raises(ck.ContactkitError, match=says):
            ck.press_maps(**{**given, "heights": library.take(heights)})


@pytest.mark.parametrize(
    "library", [strict_library, pytest.param(torch_library, marks=pytest.mark.slow)]
)
def test_a_tolerance_that_round_off_keeps_from_is_stated(library):
    """Those that reach it are in the result, and so is what the others reached."""
    library = library()
    heights, loads = library.take(H), library.take(np.array([1e13, 0.0]))
    given = {"mean_pressure": loads, "periodic": False, "rtol": 1e-14}
    with pytest.raises(ck.ConvergenceError, match="1 of 2 maps are solved to") as raised:
        ck.press_maps(heights, 1.0 / 16, SOLID, **given)
    result = raised.value.result
    assert library.give(result.converged).tolist() == [False, True]
    assert 1e-14 < library.give(result.kkt)[0] < 1e-8
    assert library.give(result.mean_pressure) == pytest.approx([1e13, 0.0])


def test_other_precisions_are_refused():
    pytest.importorskip("array_api_compat")
    xs = pytest.importorskip("array_api_strict")
    with pytest.raises(ck.DescriptionError, match=r"press_maps\(heights\).*float64, or of float32"):
        ck.press_maps(xs.asarray(H, dtype=xs.complex128), **KNOWN)
    with pytest.raises(ck.DescriptionError, match=r"at least 1\.2e-06 in this"):
        ck.press_maps(xs.asarray(H, dtype=xs.float32), rtol=1e-8, **KNOWN)


@pytest.mark.slow
def test_a_tensor_with_a_gradient_is_refused():
    """It would record every iteration, to no use: the set of pixels in contact has no slope."""
    heights = torch_library().take(H).requires_grad_()
    with pytest.raises(ck.DescriptionError, match=r"be detached.*result.gradient"):
        ck.press_maps(heights, **KNOWN)


def test_extra_is_named(monkeypatch):
    xs = pytest.importorskip("array_api_strict")
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"pip install contactkit\[arrays\]"):
        ck.press_maps(xs.asarray(H), **KNOWN)


def test_numpy_needs_no_extra(monkeypatch):
    """Nor does it import one."""
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    monkeypatch.setitem(__import__("sys").modules, "array_api_compat", None)
    found = ck.press_maps(H.tolist(), **KNOWN)
    assert found.converged.all()
    assert found.mean_pressure == pytest.approx(1e6)
    single = ck.press_maps(H.astype(np.float32), **KNOWN)
    assert single.pressure.dtype == np.float32
    assert isinstance(single, type(found))
    assert not isinstance(found, Space)
