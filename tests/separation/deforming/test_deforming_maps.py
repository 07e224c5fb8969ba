"""Separations of deforming bodies with heights: films on maps as scenes."""

import math
import pickle

import attrs
import numpy as np
import pytest

import contactkit as ck

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
GEL = ck.Material(name="gel", young_modulus=353553.39 * 0.75, poisson_ratio=0.5)
PULL = ck.ImposedSpeed(speed=1e-5, initial_gap=1e-6, final_gap=4e-6)
RIM = 8.0 * math.sqrt(5e-3 * 1e-6)
BALL = ck.Sphere(radius=5e-3)
SQUARE = ck.Flat(planform=ck.Rectangle(length=2.0 * RIM, width=2.0 * RIM))
ROUGH = ck.SelfAffineRoughness(rms=1e-7, hurst=0.8, rolloff=RIM, cutoff=RIM / 3.0, seed=3)
# Coarse grids of few cells a wave: the tests compare at the same grid, or with a wide tolerance.
COARSE = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")


def scene(*effects, loading=PULL, upper=None, lower=SQUARE, solid=GEL, liquid=OIL):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=lower, solid=solid),
            upper=upper or ck.CombinedSurface(parts=(BALL, ROUGH)),
            meniscus=ck.Meniscus(liquid=liquid),
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


def ran(made, grid, rtol=1e-2, **more):
    return ck.simulate(ck.plan(made, ck.Accuracy(grid=grid, film_rtol=rtol)), **more)


@pytest.fixture(scope="module")
def pulled():
    """A film that ruptures, on 20 x 20 cells."""
    limit = ck.TensionLimit(strength=3e3, cavity_pressure=101325.0 - 3e3)
    with pytest.warns(ck.ValidityWarning):
        return ran(scene(limit), 20, rtol=2e-2, fields_at=(0.05, 0.2))


def test_the_plan_chooses_the_map_and_states_its_numbers():
    text = str(ck.plan(scene(ck.SolidContact(cutoff=1e-7)), ck.Accuracy(grid=24)))
    for words in (
        "engine: film on a map of deforming bodies",
        "24 x 24 cells of 47.1",
        "cells in the width of the pressure, 4 in the shortest wave",
        "rms 80.1",
        "beta = 1",
        "D/D_c = 0.125",
        "h_c/h = 0.1",
    ):
        assert words in text
    smooth = attrs.evolve(
        scene(),
        interface=attrs.evolve(scene().interface, upper=BALL, lower=ck.Body(solid=GEL)),
    )
    assert "axisymmetric film" in str(ck.plan(smooth))


def test_liquid_and_energy_are_kept(pulled):
    numbers = pulled.numbers
    assert numbers["liquid_error"] < 1e-12
    assert numbers["energy_error"] < 0.01
    assert pulled["void_volume"].max() > 1e-15
    assert "ruptured" in pulled.message
    assert pulled["largest_tension"].max() < 3e3 * (1.0 + 1e-6)


def test_maps_are_those_of_the_curves(pulled):
    """Forces and smallest gaps of the maps, at the times asked for exactly."""
    assert {0.05, 0.2} <= set(pulled.fields["time"].tolist())
    shown = pulled.maps(0.2)
    assert shown.time == 0.2
    k = pulled["time"].tolist().index(0.2)
    area = float(np.diff(shown.x)[0] * np.diff(shown.y)[0])
    force = -area * (shown.film_pressure + shown.solid_pressure).sum(dtype=float)
    assert force == pytest.approx(pulled["pull"][k], rel=1e-5)
    assert shown.gap[shown.inside].min() == pytest.approx(pulled["smallest_gap"][k], rel=1e-5)
    part = pulled.section(0.2)
    row = int(np.abs(shown.y).argmin())
    assert part.gap == pytest.approx(shown.gap[row][shown.inside[row]], rel=1e-6)
    assert part.radius == pytest.approx(shown.x[shown.inside[row]], abs=1e-9 * RIM)
    assert (shown.liquid[shown.inside] < 1.0).any()


def test_files_and_copies(pulled, tmp_path):
    for copy in (ck.load_result(pulled.save(tmp_path / "r")), pickle.loads(pickle.dumps(pulled))):
        assert str(copy) == str(pulled)
        assert copy["pull"].tolist() == pulled["pull"].tolist()
        for one, other in zip(copy.maps(0.2), pulled.maps(0.2), strict=True):
            assert np.array_equal(one, other)


def test_a_saved_map_needs_its_file_no_more(tmp_path):
    """Also a scene whose heights come from a file that was deleted since."""
    x = np.linspace(-RIM, RIM, 16)
    np.save(tmp_path / "heights.npy", 1e-7 * np.cos(8.0 * x / RIM)[:, None] * np.ones(16))
    measured = ck.Measured(path=tmp_path / "heights.npy", pixel_size=RIM / 8.0, unit="m")
    made = scene(upper=ck.CombinedSurface(parts=(BALL, measured)), lower=ck.Flat())
    short = attrs.evolve(made, loading=attrs.evolve(PULL, final_gap=1.05e-6))
    with pytest.warns(ck.ValidityWarning):
        found = ran(short, None)
    saved = found.save(tmp_path / "r")
    (tmp_path / "heights.npy").unlink()
    copy = ck.load_result(saved)
    assert copy.maps(0.0).gap.tolist() == found.maps(0.0).gap.tolist()
    assert "16 x 16 cells" in str(copy.plan)


def test_figures_are_drawn(pulled, tmp_path):
    pytest.importorskip("matplotlib")
    assert {"loop", "sections", "regions", "field", "animate"} <= set(pulled.plot.available)
    for draw in pulled.plot.pictures().values():
        assert draw().get_xlabel()
    assert pulled.plot.field("film_pressure", 0.2).get_xlabel().startswith("x")
    with pytest.raises(ck.DescriptionError, match="be one of gap, film_pressure"):
        pulled.plot.field("depth")
    with pytest.raises(ck.DescriptionError, match=r"end in \.gif"):
        pulled.plot.animate(tmp_path / "film.mp4")


@pytest.mark.slow
def test_an_animation_has_a_picture_for_each_map(pulled, tmp_path):
    pytest.importorskip("matplotlib")
    image = pytest.importorskip("PIL.Image")
    with image.open(pulled.plot.animate(tmp_path / "film.gif")) as film:
        assert film.n_frames == len(pulled.fields["time"])


@pytest.mark.slow
@COARSE
def test_a_smooth_sphere_is_that_of_rings():
    """The same film by the two engines, a sphere in a disc: a sum of one part has no round apex."""
    disc = ck.Flat(radius=RIM)
    rings = ck.simulate(ck.plan(scene(upper=BALL, lower=disc)))
    found = ran(scene(upper=ck.CombinedSurface(parts=(BALL,)), lower=disc), 64, rtol=4e-3)
    expected = np.interp(found["time"], rings["time"], rings["pull"])
    off = np.abs(found["pull"] - expected).max() / rings["pull"].max()
    assert off < 0.02
    assert 0.3 * off < found.error < 3.0 * off
    gaps = np.interp(found["time"], rings["time"], rings["centre_gap"])
    assert np.abs(found["centre_gap"] - gaps).max() < 0.03 * gaps.max()


@pytest.mark.slow
@COARSE
def test_stiff_bodies_are_those_of_reynolds():
    """A tilted face with a relief, by the solver of rigid films; both grids are off by some 1 %."""
    x = np.linspace(0.0, 6.0, 33)
    relief = ck.Heights(heights=1e-7 * np.sin(x)[None, :] * np.cos(x)[:, None], pixel_size=3e-6)
    face = ck.Flat(planform=ck.Rectangle(length=1e-4, width=8e-5), tilt=(4e-3, 2e-3), relief=relief)
    loading = attrs.evolve(PULL, initial_gap=5e-7, final_gap=1e-6)
    stiff = ck.Material(young_modulus=1e15, poisson_ratio=0.3)
    made = scene(upper=face, lower=ck.Flat(), solid=stiff, loading=loading)
    found = ran(made, 48, rtol=4e-3)
    rigid = attrs.evolve(
        made,
        interface=attrs.evolve(made.interface, lower=ck.Body()),
        effects=(ck.ViscousForce(),),
    )
    law = ck.plan(rigid)
    later = found["time"] > 0.0
    expected = law.force(found["gap"][later], 1e-5)
    assert found["pull"][later] == pytest.approx(expected, rel=0.015)


@pytest.mark.slow
@COARSE
def test_rest_without_end_is_the_contact_solver():
    """Pressures of the dry contact at the same load, and its conditions to 1e-8 of the rms."""
    n, side, load = 16, 2.4e-4, 4e-5
    x = 2.0 * math.pi * (np.arange(n) - n // 2) / n
    rough = ck.Heights(
        heights=1e-7 * (np.cos(2 * x)[:, None] * np.sin(3 * x) + np.cos(x + 1.0)[:, None]),
        pixel_size=side / n,
    )
    thin = attrs.evolve(OIL, viscosity=1e-3)
    loading = ck.PressAndPull(press=load, rest=1e4, force=1e-4, initial_gap=1e-6, final_gap=1.1e-6)
    made = scene(
        ck.SolidContact(cutoff=1e-7), loading=loading, upper=rough, lower=ck.Flat(), liquid=thin
    )
    found = ran(made, None, fields_at=(1e4,))
    dry = ck.solve(
        ck.plan(
            ck.ContactScene(
                interface=attrs.evolve(made.interface, meniscus=None),
                window=ck.Window(periodic=False),
                loading=ck.Pressing(force=load),
                effects=(ck.HalfSpace(),),
            )
        )
    )
    shown = found.maps(1e4)
    scale = dry.pressure.max()
    assert shown.solid_pressure == pytest.approx(dry.pressure, abs=2e-6 * scale)
    assert np.abs(shown.film_pressure).max() < 1e-6 * scale
    k = found["time"].tolist().index(1e4)
    gap, solid = found.sections["gap"][k], found.sections["solid_pressure"][k]
    rms = float(rough.heights.std())
    assert gap.min() > 1e-7 - 1e-8 * rms
    assert np.abs(gap - 1e-7)[solid > 0.0].max() < 1e-8 * rms
    assert (solid >= 0.0).all()
    assert found["contact_force"][k] == pytest.approx(load, rel=1e-6)


@pytest.mark.slow
@COARSE
def test_rough_contact_under_a_pull():
    """From rest in contact: asperities are pressed harder before they part; limits lie around."""
    stiff = attrs.evolve(GEL, young_modulus=10.0 * GEL.young_modulus)
    loading = ck.PressAndPull(press=3e-4, rest=30.0, speed=1e-5, initial_gap=1e-6, final_gap=2e-6)
    found = ran(scene(ck.SolidContact(cutoff=3e-7), loading=loading, solid=stiff), 24)
    time, contact, pull = found["time"], found["contact_force"], found["pull"]
    rested = int(np.abs(time - 30.0).argmin())
    assert pull[rested] == pytest.approx(-3e-4, rel=1e-6)
    assert contact.max() > 1.03 * contact[rested] > 0.0
    assert pull[contact.argmax()] > pull[rested]
    assert found.numbers["energy_error"] < 0.01
    assert found.status == "released"
    from contactkit.separation.deforming.limits import rigid_limit, static_limit

    at_rest = static_limit(found.plan, float(found["gap"][rested]), 2e-6)
    assert -at_rest.force[0] == pytest.approx(3e-4, rel=0.05)
    rigid = rigid_limit(found.plan, 1e-6, 2e-6)
    assert (np.diff(rigid.force) < 0.0).all()
    assert rigid.force[0] == pytest.approx(found.plan.rigid_force, rel=0.2)


@pytest.mark.slow
@COARSE
def test_contacts_in_a_cavity_settle():
    """They hold what the cut-off holds, whether they are full or not: no reason to change.

    Changing by round-off took up to 19 iterations of Newton on these cells.
    """
    loading = ck.PressAndPull(press=3e-4, rest=30.0, speed=1e-5, initial_gap=1e-6, final_gap=3e-6)
    limit = ck.TensionLimit(strength=1.5e3, cavity_pressure=101325.0 - 1.5e3)
    found = ran(scene(ck.SolidContact(cutoff=3e-7), limit, loading=loading), 32)
    both = (found["void_volume"] > 0.0) & (found["contact_area"] > 0.0)
    assert both.sum() > 4
    assert found.work.n_evaluations <= 3.6 * 2 * found.work.n_steps
    assert found.numbers["liquid_error"] < 1e-14
    assert found.numbers["energy_error"] < 0.01


@pytest.mark.slow
@COARSE
def test_a_force_releases_a_mass_on_a_spring():
    """Impulse of all forces is the momentum; a weak spring holds the gap."""
    loading = ck.ImposedForce(
        force=2e-4, mass=0.1, stiffness=20.0, initial_gap=1e-6, final_gap=4e-6, time_limit=2.0
    )
    found = ran(scene(loading=loading), 20, rtol=2e-3)
    time, gap = found["time"], found["gap"]
    force = 2e-4 - found["pull"] - 20.0 * (gap - 1e-6)
    momentum = 0.1 * found["speed"][-1]
    assert np.trapezoid(force, time) == pytest.approx(momentum, abs=0.02 * 2e-4 * time[-1])
    assert found.status == "released"


@pytest.mark.slow
def test_a_study_varies_it():
    made = attrs.evolve(scene(), loading=attrs.evolve(PULL, final_gap=1.2e-6))
    with pytest.warns(ck.ValidityWarning):
        study = ck.study(
            made, {"loading.speed": [1e-6, 1e-5]}, accuracy=ck.Accuracy(grid=12, film_rtol=0.05)
        )
    slow, fast = study.column("pull_off_force")
    assert slow < fast
