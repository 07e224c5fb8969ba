"""Fits of devices: what their report states is compared, fields of their scene are sought."""

from __future__ import annotations

import attrs
import pytest
from refusals import refuses

import contactkit as ck
from contactkit.export.report import Report
from contactkit.models.device import Device
from contactkit.units import si


class BalanceReport:
    """Report of a balance: its deflection under a load."""

    def run(self, scene, out, progress):
        progress(1.0)
        return Report({"deflection": (scene.load / scene.stiffness, "m"), "state": ("up", "-")}, "")


@attrs.frozen(kw_only=True)
class Balance(Device):
    """A spring with a load."""

    name: str = "balance"
    stiffness: float = attrs.field(default=1.0, metadata=si("N/m"))
    load: float = attrs.field(default=1.0, metadata=si("N"))

    @property
    def report(self):
        return BalanceReport()


CURVE = ck.MeasuredCurve(
    over="load", at=[1.0, 2.0, 4.0], quantity="deflection", values=[0.51, 0.99, 2.01],
    units=("N", "m"), noise="1 %",
)  # fmt: skip


def test_a_device_is_fitted_by_what_its_report_states(tmp_path):
    found = ck.fit(Balance(), CURVE, {"stiffness": ck.Range("0.1 N/m", "10 N/m")})
    assert found["stiffness"].value == pytest.approx(2.0, rel=0.02)
    assert found.scene.stiffness == found["stiffness"].value
    assert found.curves[0].units == ("N", "m")
    again = ck.read_fit(found.save(tmp_path / "fit"))
    assert again.scene is None
    assert str(again) == str(found)


def test_what_is_no_number_of_a_report_is_refused():
    data = attrs.evolve(CURVE, quantity="state")
    refuses(lambda: ck.fit(Balance(), data, {"stiffness": (0.1, 10.0)}), "be a number", "'up'")
    data = attrs.evolve(CURVE, quantity="deflexion")
    refuses(lambda: ck.fit(Balance(), data, {"stiffness": (0.1, 10.0)}), "did you mean")
