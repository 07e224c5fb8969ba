"""FMUs that pages of devices offer: those of the scene, which a host could load."""

from __future__ import annotations

import zipfile
from functools import partial
from io import BytesIO

import pytest
from wasm import MISSING

from contactkit.fmu.framework.toolchain import local
from contactkit.live_page import fmu_files
from contactkit.models.library import bundled_device

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif("ziglang" in MISSING, reason="ziglang not installed: contactkit[native]"),
]


@pytest.mark.parametrize(
    ("device", "models"),
    [
        ("fuel-injector", {"x-valve.fmu": "valve_drive", "x-film.fmu": "stiction_mass"}),
        ("micromirror", {"x-tips.fmu": "tip_contact"}),
    ],
)
def test_a_device_offers_its_parts(device, models, monkeypatch):
    for build in ("build_native", "build_native_drive", "build_native_tip"):
        here = partial(getattr(fmu_files, build), platforms=[local()])
        monkeypatch.setattr(fmu_files, build, here)
    found = fmu_files.fmu_files(bundled_device(device), "x")
    assert found.keys() == models.keys()
    for name, identifier in models.items():
        with zipfile.ZipFile(BytesIO(found[name])) as archive:
            described = archive.read("modelDescription.xml").decode()
        assert f'modelIdentifier="{identifier}"' in described
