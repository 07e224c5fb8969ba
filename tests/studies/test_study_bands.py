"""Studies over seeds and over reference scales: medians and bands, dimensionless columns."""

from __future__ import annotations

import csv
import math

import numpy as np
import pytest

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

ACCURACY = ck.Accuracy(grid=32, rtol=1e-8)
SEED, LOAD = "interface.upper.surface.seed", "loading.pressure"
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)


def contact(*effects):
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.25e-7)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=ck.Body(surface=rough)),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e8),
        effects=(ck.HalfSpace(), *effects),
    )


@pytest.fixture(scope="module")
def seeded():
    with pytest.warns(ck.ValidityWarning):
        return ck.study(contact(), {SEED: [1, 2, 3, 4], LOAD: [5e7, 1e8, 2e8]}, ACCURACY)


def test_a_band_goes_from_the_least_to_the_greatest_of_the_seeds(seeded):
    made = seeded.bands()
    runs = seeded.column("max_pressure").reshape(4, 3)
    for end, of in (("", np.median), ("_mean", np.mean), ("_low", np.min), ("_high", np.max)):
        column = made.column(f"max_pressure{end}")
        assert column.tolist() == pytest.approx(of(runs, axis=0).tolist(), rel=1e-14)
        assert made.unit(f"max_pressure{end}") == "Pa"
    assert made.shape == (3,)
    assert made.paths == ((LOAD,),)
    assert made.column(LOAD).tolist() == [5e7, 1e8, 2e8]
    assert made.column("runs").tolist() == [4.0] * 3
    assert made.column("seconds").sum() == pytest.approx(seeded.column("seconds").sum())
    assert made.column("n_solves").tolist() == [4] * 3
    assert [p.status for p in made.points] == ["converged"] * 3
    (line,) = made.lines("loading")
    assert (line.columns["contact_area_low"] < line.columns["contact_area_high"]).all()


def test_the_order_of_the_parameters_does_not_matter(seeded):
    turned = ck.study(contact(), {LOAD: [5e7, 1e8, 2e8], SEED: [1, 2, 3, 4]}, ACCURACY)
    for name in ("contact_area", "contact_area_low", "contact_area_high"):
        wanted = seeded.bands().column(name)
        assert turned.bands().column(name) == pytest.approx(wanted, rel=1e-6)


def test_any_parameter_may_be_banded_and_seeds_alone_are_one_point(seeded):
    over = seeded.bands(LOAD)
    assert over.paths == ((SEED,),)
    assert over.column(SEED).tolist() == [1, 2, 3, 4]
    loads = over.column("mean_pressure_low"), over.column("mean_pressure_high")
    assert loads[0] == pytest.approx([5e7] * 4)
    assert loads[1] == pytest.approx([2e8] * 4)
    one = ck.study(contact(), {SEED: [1, 2]}, ACCURACY).bands()
    assert one.shape == (1,)
    assert "runs" in one.table().splitlines()[0]
    assert len(one.lines()) == 1


def test_runs_without_a_solution_are_left_out_and_counted():
    scene = contact(ck.HardnessLimit())
    made = ck.study(scene, {SEED: [1, 2, 3], LOAD: [1e8, 3e10]}, ACCURACY).bands()
    assert made.column("runs").tolist() == [3.0, 0.0]
    assert [p.status for p in made.points] == ["converged", "infeasible"]
    assert math.isnan(made.column("contact_area")[1])
    assert math.isnan(made.column("contact_area_high")[1])
    assert "point 1: load" in made.table()
    some = ck.study(scene, {LOAD: [1e8, 3e10], SEED: [1]}, ACCURACY).bands(LOAD)
    assert some.points[0].status == "1 of 2 solved"
    assert some.column("contact_area_low") == some.column("contact_area_high")


def test_a_study_without_seeds_has_no_bands():
    plain = ck.study(contact(), {LOAD: [1e8]}, ACCURACY)
    with pytest.raises(ck.DescriptionError, match=r"varies loading\.pressure; for bands vary a"):
        plain.bands()
    with pytest.raises(ck.DescriptionError, match="over must be a parameter of the study"):
        plain.bands("loading.force")


# Reference scales -----------------------------------------------------------------------------


def test_columns_in_units_of_their_scales(seeded):
    made = seeded.dimensionless()
    scales = seeded.scales
    assert made.unit(LOAD) == "E*"
    assert made.unit("load") == "E* A"
    assert made.unit("seconds") == "s"
    assert made.unit(SEED) == "-"
    assert made.column(LOAD) == pytest.approx(seeded.column(LOAD) / scales["Pa"].value)
    assert made.column("contact_area") == pytest.approx(seeded.column("contact_fraction"))
    assert made.column("seconds").tolist() == seeded.column("seconds").tolist()
    # Each surface by its own rms height.
    rms = [point.scales["m"].value for point in seeded.points]
    assert len(set(rms)) == 4
    assert made.column("approach") * rms == pytest.approx(seeded.column("approach"))
    assert "[E* A]" in made.table("load")
    banded = made.bands()
    assert banded.unit("load_low") == "E* A"
    with pytest.raises(ck.DescriptionError, match="dimensionless before its bands"):
        banded.dimensionless()


def test_scales_come_from_the_store_too(tmp_path, seeded):
    vary = {SEED: [1, 2], LOAD: [5e7, 1e8]}
    first = ck.study(contact(), vary, ACCURACY, store=tmp_path)
    again = ck.study(contact(), vary, ACCURACY, store=tmp_path)
    assert again.n_solved == 0
    assert [p.scales for p in again.points] == [p.scales for p in first.points]
    assert again.dimensionless().column("load").tolist() == (
        first.dimensionless().column("load").tolist()
    )


def test_a_point_without_a_solution_has_only_nan():
    made = ck.study(contact(ck.HardnessLimit()), {LOAD: [1e8, 3e10]}, ACCURACY).dimensionless()
    assert np.isnan(made.column(LOAD)).tolist() == [False, True]
    assert np.isnan(made.column("contact_area")).tolist() == [False, True]
    assert made.points[1].status == "infeasible"


def test_scales_of_two_kinds_are_refused(film_scene):
    scene = film_scene(ck.MeniscusForce(), upper=ck.Sphere(radius=1e-2), film={"volume": 1e-15})
    mixed = ck.study(scene, {"loading.initial_gap": [0.0, 1e-6]}, ck.Accuracy.draft)
    with pytest.raises(ck.DescriptionError, match=r"scale of \[m\] must be the same"):
        mixed.dimensionless()


def test_separations_collapse_over_their_scales(film_scene):
    """Viscosity and speed drop out of the numbers of a film that keeps its similarity."""
    scene = film_scene(ck.MeniscusForce(), ck.ViscousForce(), film={"volume": 1e-12})
    vary = {
        "interface.meniscus.liquid.viscosity, loading.speed": [(0.1, 1e-6), (0.2, 5e-7)],
    }
    made = ck.study(scene, vary, ck.Accuracy(points=20))
    assert np.ptp(made.column("viscous_impulse")) > 0.0
    scaled = made.dimensionless()
    for name in ("viscous_impulse", "peak_force", "meniscus_impulse"):
        assert np.ptp(scaled.column(name)) < 1e-9 * scaled.column(name).max(), name
    assert scaled.unit("loading.speed") == "h0/t0"


def test_a_parameter_that_is_its_own_scale_stays_in_si(film_scene):
    scene = film_scene(ck.MeniscusForce(), film={"volume": 1e-12})
    made = ck.study(scene, {"loading.initial_gap": [1e-6, 2e-6]}, ck.Accuracy.draft).dimensionless()
    assert made.unit("loading.initial_gap") == "m"
    assert made.column("loading.initial_gap").tolist() == [1e-6, 2e-6]
    assert made.unit("peak_force") == "F0"


def test_files_have_all_columns(tmp_path, seeded):
    for made, name in ((seeded, "all"), (seeded.dimensionless().bands(), "bands")):
        made.save_csv(tmp_path / name)
        with (tmp_path / f"{name}.csv").open(encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        assert head == [*(f"{n} [{made.units[n]}]" for n in made.units), "status", "message"]
        assert len(rows) == len(made.points)
        again = ck.read_curve(made.save(tmp_path / name))
        one = "load" if name == "all" else "load_low"
        assert again[one].tolist() == made.column(one).tolist()
        assert again.units == {"status": "-"} | dict(made.units)
        assert again.parts["shape"] == made.shape
        assert again.parts["paths"] == made.paths
        assert again.scalars() == made.scalars()
        assert (again.status, again.message, again.cite()) == (
            made.status,
            made.message,
            made.cite(),
        )
    assert again.unit("load_high") == "E* A"


def test_objects_are_written_as_text(tmp_path):
    made = ck.study(contact(), {"interface.lower.solid": ["ni-p", STEEL]}, ACCURACY)
    again = ck.read_curve(made.save(tmp_path / "solids"))
    assert again["interface.lower.solid"].tolist() == ["Ni-P", "steel"]
