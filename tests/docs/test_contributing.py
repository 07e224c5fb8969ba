"""The examples of CONTRIBUTING, registered as it says: all that follows from a class is there."""

import importlib.util
import math
import re
import sys
from contextlib import suppress
from pathlib import Path

import attrs
import loadings
import numpy as np
import pytest

import contactkit as ck
from contactkit.fmu.native.film import prepared_film
from contactkit.kinds import CONTACT_EFFECTS, SEPARATION_EFFECTS
from contactkit.plot import separation as separation_plot

ROOT = Path(__file__).parents[2]
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
FACE = ck.Flat(radius=1e-3)
VOLTAGE = 50.0


def example(class_name, folder):
    """Module of the block of CONTRIBUTING that defines a class; a file, as an effect is one."""
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (block,) = [one for one in blocks if f"class {class_name}(" in one]
    path = folder / f"contributed_{class_name.lower()}.py"
    path.write_text(block, encoding="utf-8")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("contributed")


@pytest.fixture(scope="module")
def plates(folder):
    """The module of the force."""
    module = example("ElectrostaticForce", folder)
    with SEPARATION_EFFECTS.including(module.ElectrostaticForce):
        yield module
    del sys.modules[module.__name__]


@pytest.fixture(scope="module")
def tables():
    """The script that writes the tables of the docs."""
    pytest.importorskip("pythonfmu")
    scripts = ROOT / "docs" / "scripts"
    sys.path.insert(0, str(scripts))
    import tables

    sys.path.remove(str(scripts))
    return tables


def scene(*effects, upper=FACE, **loading):
    meniscus = ck.Meniscus(liquid=OIL, volume=1e-11)
    imposed = loading or {"speed": 1e-3}
    return ck.SeparationScene(
        interface=ck.Interface(lower=FACE, upper=upper, meniscus=meniscus),
        loading=loadings.imposed(initial_gap=1e-6, final_gap=1e-5, **imposed),
        effects=effects,
    )


@pytest.fixture(scope="module")
def made(plates):
    return scene(plates.ElectrostaticForce(voltage=VOLTAGE), ck.ViscousForce(closure="flooded"))


@pytest.fixture(scope="module")
def result(made):
    return ck.simulate(ck.plan(made))


def attraction(gap):
    return 0.5 * 8.8541878128e-12 * math.pi * FACE.radius**2 * (VOLTAGE / gap) ** 2


# A force -------------------------------------------------------------------------------------


def test_its_curve_has_its_name_unit_and_label(result):
    column = result.plan.columns["electrostatic_force"]
    assert (column.unit, column.label) == ("N", "electrostatic force")
    np.testing.assert_allclose(result["electrostatic_force"], attraction(result.gap), rtol=1e-14)


def test_its_impulse_is_the_time_integral_of_its_curve(result):
    value, unit = result.scalars()["electrostatic_impulse"]
    assert unit == "N.s"
    # The trapezoidal rule on 200 steps of the logarithm of the gap, h^2 f''/12 = 2e-4.
    trapezoid = np.trapezoid(result["electrostatic_force"], result.time)
    assert value == pytest.approx(trapezoid, rel=3e-4)
    # Exactly: eps_0 A U^2/(2 v) (1/h_0 - 1/h_1).
    first, last = result.gap[[0, -1]]
    assert value == pytest.approx(attraction(1.0) / 1e-3 * (1 / first - 1 / last), rel=1e-9)


def test_its_impulse_in_a_motion_balances_the_momentum(plates):
    moved = ck.simulate(
        ck.plan(
            scene(
                plates.ElectrostaticForce(voltage=VOLTAGE),
                ck.ViscousForce(),
                force=0.5,
                mass=1e-4,
            )
        )
    )
    numbers = {name: value for name, (value, _) in moved.scalars().items()}
    assert numbers["electrostatic_impulse"] > 0.0
    resisted = numbers["electrostatic_impulse"] + numbers["viscous_impulse"]
    momentum = 1e-4 * numbers["release_speed"]
    assert 0.5 * numbers["release_time"] - resisted == pytest.approx(momentum, rel=1e-5)


def test_the_result_gives_what_it_did(result, plates):
    part = result.of(plates.ElectrostaticForce)
    np.testing.assert_array_equal(part.force, result["electrostatic_force"])
    assert part.impulse == result.impulses["electrostatic_impulse"]
    assert part.column == plates.ElectrostaticForce.column


def test_the_pull_has_it(result):
    total = result["electrostatic_force"] + result["viscous_force"]
    np.testing.assert_allclose(result.pull, total, rtol=1e-14)


def test_a_result_lists_what_it_offers(result):
    offered = set(dir(result))
    assert {"columns", "gap", "impulses", "of", "scalars", "cite", "save"} <= offered
    for name in offered:
        with suppress(ck.NotSimulatedError):  # of another scene
            getattr(result, name)
    assert not hasattr(result, "electrostatic_force")  # a column is an item, not an attribute


def test_its_line_in_a_figure_has_its_label_and_colour(result, plates):
    ax = separation_plot.forces(result)
    (line,) = [one for one in ax.get_lines() if one.get_label() == "electrostatic force"]
    ratio = line.get_ydata() / result["electrostatic_force"]  # in the unit of the axis
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-12)
    assert line.get_color() == plates.ElectrostaticForce.column.color
    figure = ax.get_figure()
    legends = [ax.get_legend(), *figure.legends]
    shown = [text.get_text() for one in legends if one for text in one.get_texts()]
    assert "electrostatic force" in shown


def test_a_scene_and_a_result_with_it_come_back_from_files(made, result, plates, tmp_path):
    path = ck.save_scene(made, tmp_path / "plates.toml")
    assert 'effect = "electrostatic-force"' in path.read_text("utf-8")
    assert ck.load_scene(path) == made
    again = ck.load_result(ck.save_result(result, tmp_path / "plates"))
    assert again.plan.scene == made
    assert again.scalars() == result.scalars()
    np.testing.assert_array_equal(again["electrostatic_force"], result["electrostatic_force"])
    part = again.of(plates.ElectrostaticForce)
    assert part.impulse == result.of(plates.ElectrostaticForce).impulse


def test_a_plan_prints_it_and_cites_its_source(result, plates):
    assert "on   electrostatic-force" in str(result.plan)
    assert "electrostatic-force: plate capacitor" in result.cite()
    without = ck.plan(scene(ck.ViscousForce()))
    assert "off  electrostatic-force" in str(without)
    with pytest.raises(ck.NotSimulatedError, match=r"add ElectrostaticForce\(\.\.\.\)"):
        without.listed(plates.ElectrostaticForce)


def test_what_it_lacks_and_wrong_choices_are_messages(plates):
    ball = scene(plates.ElectrostaticForce(voltage=1.0), upper=ck.Sphere(radius=1e-3))
    with pytest.raises(ck.PlanError, match="ElectrostaticForce needs two flats"):
        ck.plan(ball)
    with pytest.raises(ck.DescriptionError, match=r"voltage must be positive .*\[V\].* got 0"):
        plates.ElectrostaticForce(voltage=0.0)


def test_the_tables_of_the_docs_have_a_line_of_it(plates, tables):
    effects, keys = tables.TABLES["effects"](), tables.TABLES["effect keys"]()
    (line,) = [row for row in effects.splitlines() if "`electrostatic-force`" in row]
    assert all(word in line for word in ("`ElectrostaticForce`", "| force |", "attraction"))
    assert '**`effect = "electrostatic-force"`**' in keys
    assert "| `voltage` | required | Difference of the potentials [V]. |" in keys


def test_a_native_fmu_tabulates_it(plates):
    """Its table alone: a force that falls as h^-2 is a constant times h^-2, from two nodes."""
    alone = scene(plates.ElectrostaticForce(voltage=VOLTAGE), force=1.0, mass=1e-3)
    (film,) = prepared_film(alone).tables.films
    (law,) = film.laws
    (piece,) = law.table.pieces
    assert (law.scale, law.rate, law.needs_film, law.kinks) == (0, 0, False, ())
    assert not law.table.stays
    assert (law.end, law.release, law.recontact) == (math.inf, math.inf, 0.0)
    assert (piece.power, len(piece.x)) == (2, 2)
    assert piece.y == pytest.approx([attraction(1.0)] * 2, rel=1e-12)


@pytest.mark.slow
@pytest.mark.usefixtures("kernels_compiled_once")
def test_a_native_fmu_answers_as_the_plan(made, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    from contactkit.fmu.framework.toolchain import local
    from contactkit.fmu.native.build import build_native

    moving = attrs.evolve(made, loading=scene(force=0.0, mass=1e-3).loading)
    film = ck.plan(moving).film
    path = build_native(moving, tmp_path / "plates.fmu", platforms=[local()])
    for speed in (0.0, 1e-3):
        start = {"v0": speed}
        found = fmpy.simulate_fmu(
            str(path), start_values=start, stop_time=1e-9, output=["h", "v", "F_m", "F_v"]
        )
        gap, now = float(found["h"][0]), float(found["v"][0])
        assert found["F_m"][0] == pytest.approx(film.static_force(gap), rel=1e-9)
        assert film.static_force(gap) == pytest.approx(attraction(gap), rel=1e-12)
        assert found["F_v"][0] == pytest.approx(film.viscous_force(gap, now)[0], rel=1e-9)


# An end of the film, and an effect of a contact ----------------------------------------------


def test_an_end_of_the_film_ends_it_in_results_files_and_native_fmus(folder, tables, tmp_path):
    module = example("LianRupture", folder)
    with SEPARATION_EFFECTS.including(module.LianRupture):
        made = scene(
            ck.ViscousForce(), module.LianRupture(), upper=ck.Sphere(radius=1e-2), speed=1e-3
        )
        volume, lian = 1e-11, module.lian_distance
        made = attrs.evolve(made, loading=attrs.evolve(made.loading, final_gap=1e-3))
        with pytest.warns(ck.ValidityWarning, match="slenderness"):
            result = ck.simulate(ck.plan(made))
        assert result.plan.film.end == lian(volume, 0.0)
        broken = result.gap > lian(volume, 0.0)
        assert result.gap[-1] == lian(volume, 0.0)
        assert not broken.any()
        assert ck.load_scene(ck.save_scene(made, tmp_path / "lian.toml")) == made
        assert "| end of the film |" in tables.TABLES["effects"]()
        moving = attrs.evolve(made, loading=scene(force=0.0, mass=1e-3).loading)
        assert prepared_film(moving).tables.films[0].breaks == lian(volume, 0.0)


def test_an_observer_of_a_contact_has_its_number_everywhere(folder, tables, tmp_path):
    module = example("MeanGap", folder)
    wave = ck.Wave(amplitude=1e-6, wavelength=1e-3)
    steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    with CONTACT_EFFECTS.including(module.MeanGap):
        made = ck.ContactScene(
            interface=ck.Interface(lower=ck.Body(solid=steel), upper=wave),
            window=ck.Window(width=1e-3),
            loading=ck.Pressing(pressure=1e7),
            effects=(ck.HalfSpace(), module.MeanGap()),
        )
        result = ck.solve(ck.plan(made, ck.Accuracy(grid=64)))
        mean = result.of(module.MeanGap)
        assert mean == result.gap.mean()
        assert result.scalars()["mean_gap"] == (mean, "m")
        assert ck.load_scene(ck.save_scene(made, tmp_path / "wave.toml")) == made
        again = ck.load_result(ck.save_result(result, tmp_path / "wave"))
        assert again.of(module.MeanGap) == mean
        assert "`MeanGap`" in tables.TABLES["contact effects"]()
