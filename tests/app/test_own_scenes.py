"""A kind of scene from outside: plan, run, page, study and figures come for free."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
import pytest
from attrs import field, frozen

import contactkit as ck
from contactkit import planning
from contactkit.app.run import draw_result
from contactkit.app.scenes import OpenedDevice, OpenedScene, open_scene
from contactkit.app.study import StudyOptions
from contactkit.export.report import Report
from contactkit.models import library
from contactkit.models.device import Device
from contactkit.registry import Registry
from contactkit.scene.effect import Effect
from contactkit.scene.loading import Loading
from contactkit.scene.plan import ScenePlan
from contactkit.scene.result import Result
from contactkit.scene.scenes import Scene
from contactkit.units import si


@frozen(kw_only=True)
class FreeFall(Loading):
    kind: ClassVar[str] = "free-fall"
    summary: ClassVar[str] = "falls freely"

    height: float = field(metadata=si("m"))


@frozen(kw_only=True)
class Gravity(Effect):
    family: ClassVar[str] = "fall effect"
    name: ClassVar[str] = "gravity"
    summary: ClassVar[str] = "weight"
    sources: ClassVar[tuple[str, ...]] = ("Galileo 1638",)

    acceleration: float = field(default=9.81, metadata=si("m/s2"))


FALL_EFFECTS: Registry[Any] = Registry("fall effect", {}, tag="name", attribute="name")
FALL_EFFECTS.own[Gravity.name] = Gravity


@frozen(kw_only=True)
class FallScene(Scene):
    loading: FreeFall


@frozen
class FallPlan(ScenePlan):
    known_effects: ClassVar[Any] = FALL_EFFECTS
    title: ClassVar[str] = "a body falls"

    scene: FallScene
    accuracy: ck.Accuracy


@frozen(eq=False)
class FallResult(Result):
    status: ClassVar[str] = "landed"
    message: ClassVar[str] = "it has landed"
    validity: ClassVar[tuple[Any, ...]] = ()
    scales: ClassVar[dict[str, Any]] = {}
    notes: ClassVar[tuple[str, ...]] = ("drag of the air is left out",)

    plan: FallPlan
    columns: dict[str, Any]
    work: Any

    def of(self, kind):
        return self.plan.listed(kind)

    def scalars(self):
        return {"fall_time": (float(self.columns["time"][-1]), "s")}

    def unit(self, name):
        return {"time": "s", "height": "m", "speed": "m/s"}[name]

    def _refuse(self, name):
        pass

    def contents(self):
        from contactkit.scene.tabular import curve_contents

        known = {name: (values, self.unit(name)) for name, values in self.columns.items()}
        return curve_contents("time", known, self.plan.title, self.scalars())


def run_fall(plan):
    from contactkit.separation.curve_result import Work

    height = plan.scene.loading.height
    g = plan.scene.effects[0].acceleration
    time = np.linspace(0.0, np.sqrt(2.0 * height / g), 21)
    columns = {"time": time, "height": height - 0.5 * g * time**2, "speed": g * time}
    return FallResult(plan, columns, Work(20, 0, 21, 0.0))


@pytest.fixture
def scene(monkeypatch):
    monkeypatch.setattr(planning, "_KINDS", dict(planning._KINDS))
    planning.register_scene(
        FallScene, plan=lambda s, a: FallPlan(s, a or ck.Accuracy()), run=run_fall
    )
    body = ck.Interface(upper=ck.Sphere(radius=1e-3))
    return FallScene(interface=body, loading=FreeFall(height=4.905), effects=(Gravity(),))


def test_it_is_planned_run_written_and_drawn(scene, tmp_path):
    report = OpenedScene(scene).run(tmp_path, lambda done: None)
    assert report.scalars["fall_time"] == (pytest.approx(1.0), "s")
    for text in ("a body falls", "on   gravity", "fall_time", "drag of the air", "20 steps"):
        assert text in report.text
    assert [path.name for path in report.write()] == ["result.csv"]
    pytest.importorskip("matplotlib")
    assert {path.name for path in report.draw()} == {"height.png", "speed.png"}


def test_its_study_varies_what_its_scene_has(scene, tmp_path):
    vary = {"loading.height": [1.0, 4.0]}
    report = OpenedScene(scene, parameters=vary).study(tmp_path, lambda done: None, StudyOptions())
    assert report.text.startswith("study:\nheight [m]")
    short, long = report.scalars["fall_time"][0]
    assert long == pytest.approx(2.0 * short)


def test_what_it_has_not_is_refused_with_words(scene):
    with pytest.raises(ck.PlanError, match="no FMU holds a fall scene"):
        OpenedScene(scene).fmu_start()
    with pytest.raises(ck.PlanError, match="cost has nothing to weigh: a fall"):
        OpenedScene(scene).cost(None, lambda done: None, 1e-6)
    with pytest.raises(ck.PlanError, match="is registered already"):
        planning.register_scene(FallScene, plan=FallPlan, run=run_fall)


@pytest.mark.slow
def test_an_own_effect_is_drawn_by_a_run(tmp_path):
    """Its map has no figure of its own."""
    pytest.importorskip("matplotlib")
    steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
        ),
        window=ck.Window(width=30e-6, periodic=False),
        loading=ck.Pressing(force=0.2),
        effects=(ck.HalfSpace(), ck.FrictionTraction(coefficient=0.3)),
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=32)))
    names = {path.stem for path in draw_result(result, tmp_path)}
    assert {"pressure", "areas", "stack", "traction-x"} <= names


@frozen(kw_only=True)
class Bell(Device):
    reported_by: ClassVar[str] = __name__

    name: str = "bell"
    strikes: int = 1


def plan_text(scene):
    return f"{scene.name}: {scene.strikes} strikes"


def run(scene, out, progress):
    return Report({"strikes": (scene.strikes, "-")}, plan_text(scene))


def test_a_device_brings_its_report(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "_DEVICES", dict(library._DEVICES))
    library.register_device("bell", f"{__name__}:Bell")
    file = tmp_path / "bell.toml"
    file.write_text('device = "bell"\nstrikes = 3\n')
    opened = open_scene(str(file))
    assert isinstance(opened, OpenedDevice)
    assert opened.plan_text() == "bell: 3 strikes"
    assert opened.run(None, print).scalars == {"strikes": (3, "-")}
    with pytest.raises(ck.PlanError, match="bell is a device"):
        opened.study(None, print, StudyOptions())
    with pytest.raises(ck.DescriptionError, match="be new"):
        library.register_device("bell", "other:Bell")
