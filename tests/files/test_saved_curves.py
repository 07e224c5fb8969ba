"""Saved curves: what is read back, to the last bit, and what is refused."""

from __future__ import annotations

import json

import attrs
import numpy as np
import pytest
from matplotlib import pyplot as plt

import contactkit as ck
from contactkit.scene.curve import Curve

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")  # coarse grids

SOFT = ck.Material(young_modulus=1e9, poisson_ratio=0.3)


def _contact(**more):
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=SOFT), upper=ck.Body(surface=ck.Paraboloid(radius=1e-6))
        ),
        window=ck.Window(width=2e-7, periodic=False),
        **more,
    )


def _load_curve():
    scene = _contact(loading=ck.Pressing(force=1e-8), effects=(ck.HalfSpace(),))
    return ck.load_curve(ck.plan(scene, ck.Accuracy(grid=16)), loads=[1e-8, 2e-8])


def _pull_off():
    law = ck.ExponentialAttraction(work_of_adhesion=0.05, range=5e-9)
    scene = _contact(
        loading=ck.Approach(approach=0.0), effects=(ck.HalfSpace(), ck.Adhesion(law=law))
    )
    return ck.pull_off_curve(ck.plan(scene, ck.Accuracy(grid=16)), [-4e-9, 0.0, 2e-9])


def _stick_slip():
    slider = ck.SpringSlider(
        load=1.0,
        static_coefficient=0.5,
        kinetic_coefficient=0.3,
        stiffness=100.0,
        speed=1e-3,
        mass=1e-3,
    )
    return ck.stick_slip(slider, n_slips=2)


def _adhesion():
    film = ck.Meniscus(liquid=ck.Liquid(name="air"))
    rubber = ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e9)
    scene = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1e-5), meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-6, speed=1e-6),
        effects=(rubber,),
    )
    return ck.adhesion_curve(scene, [0.0, 1e-6])


def _study():
    scene = _contact(loading=ck.Pressing(force=1e-8), effects=(ck.HalfSpace(),))
    return ck.study(scene, {"loading.force": [1e-8, 2e-8]}, ck.Accuracy(grid=16))


CURVES = {
    "load": _load_curve,
    "pull-off": _pull_off,
    "stick-slip": _stick_slip,
    "adhesion": _adhesion,
}


@pytest.mark.parametrize("name", CURVES)
def test_a_curve_is_read_back_to_the_last_bit(name, tmp_path):
    curve = CURVES[name]()
    again = ck.read_curve(curve.save(tmp_path / name))
    assert isinstance(again, Curve)
    assert list(again.table()) == list(curve.table())
    for column, (values, unit) in curve.table().items():
        assert again[column].tobytes() == np.asarray(values).tobytes()
        assert again.unit(column) == unit
    assert again.scalars() == curve.scalars()
    for same in ("title", "axis", "status", "message", "validity", "shown"):
        assert getattr(again, same) == getattr(curve, same), same
    assert (again.cite(), str(again)) == (curve.cite(), str(curve))
    assert again.contents().remarks == curve.contents().remarks
    assert again.parts.keys() == curve.parts.keys()
    assert again.to_xarray().equals(curve.to_xarray())


def test_a_curve_that_was_read_saves_to_the_same(tmp_path):
    first = ck.read_curve(_pull_off().save(tmp_path / "first"))
    again = ck.read_curve(first.save(tmp_path / "again"))
    assert again.parts == first.parts
    jumps = _pull_off().jumps
    assert [one["before"] for one in again.parts["jumps"]] == [one.before for one in jumps]
    assert again.parts["approaching"]["load"] == tuple(_pull_off().approaching.load.tolist())


def test_a_curve_that_was_read_has_its_figures(tmp_path):
    again = ck.read_curve(_load_curve().save(tmp_path / "load"))
    assert set(_load_curve().shown) <= set(again.plot.available)
    ax = again.plot.area()
    ys = ax.lines[0].get_ydata()
    assert ys[1] / ys[0] == pytest.approx(again["contact_area"][1] / again["contact_area"][0])
    plt.close(ax.figure)


def test_a_study_offers_what_a_curve_offers():
    study = _study()
    assert (study.status, study.scalars()["n_points"]) == ("complete", (2, "-"))
    total = sum(point.n_operator_applications for point in study.points)
    assert study.scalars()["n_operator_applications"] == (total, "-")
    assert study.message == "2 points over force; 2 with notes"
    first = ck.plan(_contact(loading=ck.Pressing(force=1e-8), effects=(ck.HalfSpace(),)))
    assert study.cite() == first.cite() != ""
    assert "n_points" in str(study)
    assert set(study.plot.number.__self__.pictures()) == set(study.telling())


def test_a_study_cites_what_any_of_its_effects_takes():
    film = ck.Meniscus(liquid=ck.load_liquid("water"), volume=1e-20)
    scene = ck.SeparationScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=5e-9, final_gap=6e-9, speed=1e-6),
        effects=(ck.MeniscusForce(),),
    )
    profiles = {"effects.meniscus-force.profile": ["exact", "arc"]}
    cited = ck.study(scene, profiles, ck.Accuracy.draft).cite().splitlines()
    each = [
        ck.plan(attrs.evolve(scene, effects=(ck.MeniscusForce(profile=profile),))).cite()
        for profile in ("exact", "arc")
    ]
    assert set(cited) == {line for text in each for line in text.splitlines()}
    assert each[0] != each[1]


def test_a_study_with_a_failed_point_is_incomplete(tmp_path):
    scene = _contact(loading=ck.Pressing(force=1e-8), effects=(ck.HalfSpace(),))
    hard = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e8))
    scene = attrs.evolve(scene, effects=(*scene.effects, hard))
    study = ck.study(scene, {"loading.force": [1e-8, 1e-2]}, ck.Accuracy(grid=16))
    assert (study.status, study.scalars()["n_failed"]) == ("incomplete", (1, "-"))
    again = ck.read_curve(study.save(tmp_path / "study"))
    assert again.status == "incomplete"
    assert again["status"].tolist() == [point.status for point in study.points]
    assert np.isnan(again["contact_area"][1])


def test_a_file_of_before_is_read(header, tmp_path):
    found, columns = header
    for name in ("kind", "validity", "parts", "shown"):
        found.pop(name)
    again = ck.read_curve(_write(tmp_path / "before", found, **columns))
    assert again["load"].tolist() == columns["load"].tolist()
    assert (again.parts, again.validity) == ({}, ())


# Refused --------------------------------------------------------------------------------------


def _write(path, header, **columns):
    np.savez(path, header=np.array(json.dumps(header)), **columns)
    return path.with_suffix(".npz")


@pytest.fixture
def header(tmp_path):
    with np.load(_adhesion().save(tmp_path / "good")) as file:
        return json.loads(str(file["header"])), {n: file[n] for n in file if n != "header"}


BROKEN = {
    "another kind": lambda h, _: h.update(kind="contact"),
    "no axis": lambda h, _: (h.pop("kind"), h.pop("axis")),
    "no units": lambda h, _: h.pop("units"),
    "a unit too few": lambda h, _: h["units"].pop("load"),
    "a unit that is no text": lambda h, _: h["units"].update(load=1),
    "a scalar that is text": lambda h, _: h["scalars"].update(release_gap=["x", "m"]),
    "a title that is no text": lambda h, _: h.update(title=3),
    "sources that are no text": lambda h, _: h.update(references=["a"]),
    "a range that is text": lambda h, _: h.update(
        validity=[{"name": "a", "value": "b", "low": 0, "high": 1, "detail": "", "source": ""}]
    ),
    "figures of nothing": lambda h, _: h.update(shown={"area": [["area"], ""]}),
    "columns of two lengths": lambda _, c: c.update(load=np.zeros(7)),
    "a column of two axes": lambda _, c: c.update({n: np.zeros((2, 2)) for n in c}),
    "parts that are a number": lambda h, _: h.update(parts=1),
}


@pytest.mark.errors
@pytest.mark.parametrize("name", BROKEN)
def test_what_is_no_curve_is_refused(name, header, tmp_path):
    found, columns = header
    BROKEN[name](found, columns)
    with pytest.raises(ck.DescriptionError, match="be a curve of contactkit"):
        ck.read_curve(_write(tmp_path / "broken", found, **columns))


@pytest.mark.errors
def test_a_result_is_no_curve_and_names_its_reader(tmp_path):
    result = ck.solve(
        ck.plan(
            _contact(loading=ck.Pressing(force=1e-8), effects=(ck.HalfSpace(),)),
            ck.Accuracy(grid=16),
        )
    )
    path = result.save(tmp_path / "contact")
    with pytest.raises(ck.DescriptionError, match="load_result reads results"):
        ck.read_curve(path)
    with pytest.raises(ck.DescriptionError, match="read_curve"):
        ck.load_result(_adhesion().save(tmp_path / "curve"))
    with pytest.raises(ck.DescriptionError, match="be a curve of contactkit"):
        ck.read_curve(tmp_path / "none.npz")
