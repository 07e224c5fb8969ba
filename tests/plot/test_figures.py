"""Figures of results as methods: what is listed, what is refused, units of the axes, files."""

from __future__ import annotations

import subprocess
import sys
import warnings

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.analyses.subsurface import MEASURES
from contactkit.kinds import CONTACT_EFFECTS

style = pytest.importorskip("contactkit.plot.style")

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7.5e9)
HARD = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=2e9))
OIL = ck.Liquid(name="oil", viscosity=0.01, surface_tension=0.03, density=870.0)
# figures of effects: what else a scene lists for them
OF_EFFECTS = {
    ck.SubsurfaceStress: (),
    ck.PartialSlip: (),
    ck.PlasticHistory: (HARD,),
    ck.Viscoelasticity: (),
}
LISTED = {
    ck.SubsurfaceStress: ck.SubsurfaceStress(depths=(0.0, 1e-7, 2e-7, 4e-7)),
    ck.PartialSlip: ck.PartialSlip(coefficient=0.3, path=(ck.TangentialStep(ratio=0.5),)),
    ck.PlasticHistory: ck.PlasticHistory(pressures=(800e6,)),
    ck.Viscoelasticity: ck.Viscoelasticity(times=(1.0, 3.0), pressures=(1e8,), steps=2),
}


@pytest.fixture(autouse=True)
def _quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        yield


# Solids that effects need.
SOLIDS = {
    ck.Viscoelasticity: ck.ViscoelasticMaterial(
        young_modulus=210e9, fractions=(0.5,), times=(1.0,), poisson_ratio=0.3
    ),
}


def contact(*effects, scale=1.0):
    wave = np.cos(2.0 * np.pi * np.arange(16) / 16)
    heights = 5e-9 * scale * wave * wave[:, None]
    solid = next((SOLIDS[type(one)] for one in effects if type(one) in SOLIDS), STEEL)
    body = ck.Body(surface=ck.Heights(heights=heights, pixel_size=1e-7 * scale), solid=solid)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=body, upper=ck.Flat()),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=500e6),
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.plan(scene)


def film(loading, *effects, gap=5e-6):
    face = ck.Flat(radius=600.0 * gap)
    meniscus = ck.Meniscus(liquid=OIL, volume=0.8e6 * gap**3)
    interface = ck.Interface(lower=face, upper=face, meniscus=meniscus)
    effects = effects or (ck.MeniscusForce(), ck.ViscousForce())
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects)


PULLED = ck.ImposedSpeed(initial_gap=5e-6, final_gap=25e-6, speed=0.01)


@pytest.fixture(scope="module")
def pressed():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.solve(contact())


def drawn(ax, folder):
    """The file of a figure, and the labels of its axes and colour bars."""
    path = style.save(ax.figure, folder / "figure.png", dpi=30)
    assert path.stat().st_size > 500
    return [text for one in ax.figure.axes for text in (one.get_xlabel(), one.get_ylabel())]


@pytest.mark.parametrize("kind", OF_EFFECTS, ids=lambda kind: kind.name)
def test_a_figure_of_an_effect_is_there_with_it_and_refused_without(kind, pressed, tmp_path):
    result = ck.solve(contact(LISTED[kind], *OF_EFFECTS[kind]))
    assert kind.figures
    assert set(kind.figures) <= set(result.plot.available) & set(dir(result.plot))
    assert not set(kind.figures) & (set(pressed.plot.available) | set(dir(pressed.plot)))
    for name in (one for one in kind.figures if not one.endswith("_3d")):
        assert all("[" in one for one in drawn(getattr(result.plot, name)(), tmp_path) if one)
        with pytest.raises(ck.NotSimulatedError, match=f"add {kind.__name__}"):
            getattr(pressed.plot, name)()


def test_every_figure_that_an_effect_declares_is_a_method():
    from contactkit.plot.accessors.contact import ContactFigures

    declared = {kind: kind.figures for kind in CONTACT_EFFECTS if kind.figures}
    assert set(declared) == set(OF_EFFECTS)
    for names in declared.values():
        assert all(callable(getattr(ContactFigures, name)) for name in names)


@pytest.mark.slow
def test_what_a_contact_can_draw_is_drawn_with_units_by_size(pressed, tmp_path):
    names = [name for name in pressed.plot.available if name != "map"]
    more = {"surface_3d", "explore", "pressure_close_up"}
    assert {"pressure", "gap", "displacement", "heights", "areas", "section"} | more == set(names)
    bars = {"pressure": "GPa", "gap": "nm", "displacement": "nm", "heights": "nm"}
    for name in sorted(set(names) - more):
        labels = drawn(getattr(pressed.plot, name)(), tmp_path)
        assert labels[0] == "x [µm]", name
        if name in bars:
            assert labels[-1].endswith(f"[{bars[name]}]"), name
    large = ck.solve(contact(scale=1e3)).plot
    assert drawn(large.heights(), tmp_path)[0] == "x [mm]"
    assert large.section().get_ylabel() == "height [µm]"


def test_figures_draw_on_given_axes_and_return_them(pressed):
    figure, (left, right) = style.figure(1, 2)
    assert pressed.plot.pressure(ax=left) is left
    assert pressed.plot.section(row=3, ax=right) is right
    assert left.figure is figure


def test_maps_of_effects_are_drawn_by_their_names(tmp_path):
    result = ck.solve(contact(HARD))
    image = result.plot.map("plastic").images[0].get_array()
    np.testing.assert_array_equal(image, result.of(ck.HardnessLimit).is_plastic)
    with pytest.raises(ck.DescriptionError, match=r"be one of pressure, gap.*overlap"):
        result.plot.map("residual_depth")
    with pytest.raises(ck.DescriptionError, match="be a row of the map, 0 to 15"):
        result.plot.section(row=16)


def test_a_close_up_of_the_pressure_has_its_maximum_in_the_middle():
    result = ck.solve(contact())
    ax = result.plot.pressure_close_up()
    shown = ax.images[0].get_array()
    assert shown.shape == (9, 9)
    assert shown[4, 4] == shown.max()
    factor = {"[GPa]": 1e9, "[MPa]": 1e6}[ax.images[0].colorbar.ax.get_ylabel().split()[-1]]
    assert shown.max() * factor == pytest.approx(result.max_pressure)
    assert ax.get_xlim() == pytest.approx((-450.0, 450.0))
    assert ax.get_xlabel() == "x from the maximum pressure [nm]"


def test_a_map_of_the_gap_shows_the_contact(pressed):
    ax = pressed.plot.gap()
    np.testing.assert_array_equal(~ax.images[-1].get_array().mask, pressed.contact)
    assert [one.get_text() for one in ax.get_legend().get_texts()] == ["contact"]
    assert pressed.plot.displacement().get_legend() is None


def test_a_section_of_stress_says_whose_maximum_it_marks():
    """With friction the largest stress is rarely in the row of the largest pressure."""
    rough = ck.GaussianRoughness(rms=2e-9, correlation_length=2e-7, cutoff=2e-7, seed=3)
    wave = contact()
    for keep in ("section", "planes"):
        scene = attrs.evolve(
            wave.scene,
            interface=ck.Interface(lower=ck.Body(surface=rough, solid=STEEL), upper=ck.Flat()),
            window=ck.Window(width=1e-6),
            effects=(
                ck.HalfSpace(),
                ck.SubsurfaceStress(keep=keep),
                ck.FrictionTraction(coefficient=0.5),
            ),
        )
        result = ck.solve(ck.plan(scene, ck.Accuracy(grid=32)))
        ax = result.plot.stress("tension")
        part = result.of(ck.SubsurfaceStress)
        marked = float(ax.get_lines()[-2].get_ydata()[0]) * 1e-9
        whole = part.maxima["tension"]
        own = float(MEASURES["tension"](part.section).max())
        assert own < 0.99 * whole.value
        (text,) = (one.get_text() for one in ax.get_legend().get_texts())
        if keep == "planes":
            assert marked == pytest.approx(whole.z)
            assert text == f"maximum of the window: {whole.value / 1e9:.3g} GPa"
            assert ax.get_xlabel() == "x from the maximum stress [nm]"
        else:
            first, second = text.split("\n")
            assert first == f"maximum of the section: {own / 1e9:.3g} GPa"
            assert f"in the window {whole.value / 1e9:.3g} GPa" in second


def test_stress_is_drawn_to_scale_over_linear_depth_with_its_maximum():
    result = ck.solve(contact(ck.SubsurfaceStress()))
    ax = result.plot.stress()
    mark, _ = ax.get_lines()
    maximum = result.of(ck.SubsurfaceStress).maxima["von_mises"]
    assert mark.get_ydata()[0] * 1e-9 == pytest.approx(maximum.z)
    assert (ax.get_aspect(), ax.get_yscale(), ax.yaxis_inverted()) == (1.0, "linear", True)
    assert ax.get_ylabel() == "depth [nm]"
    near = result.plot.stress("tresca", depth=2e-7)
    assert near.get_ylim() == pytest.approx((200.0, 0.0))
    thin = result.plot.stress(depth=2e-8)  # less than a pixel
    assert (thin.get_ylim(), thin.get_aspect()) == (pytest.approx((20.0, 0.0)), "auto")
    assert len(thin.collections) > 0
    with pytest.raises(ck.DescriptionError, match="be one of von_mises, sqrt_j2"):
        result.plot.stress("mises")
    with pytest.raises(ck.DescriptionError, match="lie below the first plane"):
        result.plot.stress(depth=0.0)


def test_a_plan_of_a_contact_draws_heights_and_layers(tmp_path):
    plan = contact()
    assert plan.plot.available == ("heights", "stack")
    assert drawn(plan.plot.heights(), tmp_path)[-1] == "height [nm]"
    assert "steel" in plan.plot.stack().texts[0].get_text()
    with pytest.raises(
        ck.PlanError, match=r"the upper body is rigid: give interface\.upper\.solid"
    ):
        plan.plot.upper_stack()


@pytest.mark.parametrize(("gap", "lengths"), [(5e-6, "µm"), (50e-9, "nm")])
def test_a_separation_draws_what_it_determines(gap, lengths, tmp_path):
    loading = ck.ImposedSpeed(initial_gap=gap, final_gap=5.0 * gap, speed=1e-3)
    result = ck.simulate(ck.plan(film(loading, gap=gap)))
    assert result.plot.available == ("curves", "gap", "forces", "scaled")
    force = drawn(result.plot.forces(), tmp_path)
    assert force[0] == f"gap [{lengths}]"
    lines = {one.get_label(): one.get_ydata() for one in result.plot.forces().get_lines()}
    top, line = result["pull"].max(), lines["pull"].max()
    prefix = force[1].removeprefix("force [").removesuffix("N]")
    assert top / line == pytest.approx({"": 1.0, "m": 1e-3, "µ": 1e-6, "k": 1e3}[prefix])
    assert drawn(result.plot.gap(), tmp_path) == [
        "time [µs]" if gap < 1e-6 else "time [ms]",
        f"gap [{lengths}]",
    ]
    with pytest.raises(ck.NotSimulatedError, match="nothing vibrates"):
        result.plot.cycles()


def test_a_film_that_cavitates_at_once_is_drawn_over_time():
    effects = (ck.ViscousForce(), ck.TensionLimit(strength=1e6))
    thrown = ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02)
    result = ck.simulate(ck.plan(film(thrown, *effects)))
    force, time, acts = result["viscous_force"], result["time"], result["limit"] > 1.0
    ax = result.plot.forces()
    line = next(one for one in ax.get_lines() if one.get_label() == "viscous force")
    x, y = line.get_data()
    assert len(x) == len(time)
    assert (ax.get_xlabel(), ax.get_xscale()) == ("time", "log")
    labels = [one.get_text() for one in ax.get_xticklabels()]
    assert {one.split()[-1] for one in labels if one} >= {"ns", "µs"}
    shown = (x >= ax.get_xlim()[0]) & (x <= ax.get_xlim()[1]) & (y <= ax.get_ylim()[1])
    assert shown[int(force.argmax())]  # the peak is on the panel, and not on its frame
    peak = ax.transData.transform((x[int(force.argmax())], 0.0))
    assert 0.05 < ax.transAxes.inverted().transform(peak)[0] < 0.95
    (bar,) = ax.collections
    ends = bar.get_paths()[0].vertices[:, 0] * time[-1] / x[-1]
    assert (ends.min(), ends.max()) == pytest.approx((time[acts][0], time[acts][-1]))
    assert bar.get_paths()[0].vertices[:, 1].max() < 0.05  # nothing else is shaded
    release = next(one for one in ax.get_lines() if one.get_label() == "release")
    assert release.get_xdata()[0] * time[-1] / x[-1] == pytest.approx(result.state.release_time)
    gap = result.plot.forces(over="gap")
    assert (gap.get_xlabel(), gap.get_xscale()) == ("gap [µm]", "log")
    with pytest.raises(ck.DescriptionError, match=r"forces\.over must be gap or time"):
        result.plot.forces(over="speed")


def test_a_film_that_cavitates_at_a_given_speed_is_drawn_over_the_gap():
    effects = (ck.ViscousForce(), ck.TensionLimit(strength=1e4, cavity="truncated"))
    ax = ck.simulate(ck.plan(film(PULLED, *effects))).plot.forces()
    assert ax.get_xlabel() == "gap [µm]"
    assert [one.get_label() for one in ax.collections] == ["limit of the liquid acts"]


def test_curves_of_one_unit_are_drawn_over_any_other():
    result = ck.simulate(ck.plan(film(PULLED)))
    ax = result.plot.curves("meniscus_force", "viscous_force", over="gap")
    assert (ax.get_xlabel(), ax.get_ylabel().partition(" [")[0]) == ("gap [µm]", "force")
    assert len(ax.get_legend().get_texts()) == 2
    with pytest.raises(ck.DescriptionError, match=r"have one unit.*a figure for each"):
        result.plot.curves("gap", "viscous_force")
    with pytest.raises(ck.DescriptionError, match="did you mean 'viscous_force'"):
        result.plot.curves("viscous_forc")
    with pytest.raises(ck.DescriptionError, match="be some of"):
        result.plot.curves()


def test_a_sliding_and_a_film_of_imposed_time_are_drawn(tmp_path):
    face = ck.Flat(radius=1e-4)
    wet = ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=OIL, volume=1e-15))
    slide = ck.SlidingScene(
        interface=wet, loading=ck.Sliding(gap=1e-7, speed=1e-3), effects=(ck.CouetteForce(),)
    )
    found = ck.simulate(ck.plan(slide)).plot
    assert found.available == ("curves", "forces", "scaled")
    assert all("[" in one for one in drawn(found.forces(), tmp_path))
    loading = ck.ImposedTime(initial_gap=5e-6, final_gap=25e-6, time=1e-3)
    timed = ck.simulate(ck.plan(film(loading, ck.ViscousForce())))
    assert "forces" not in timed.plot.available
    with pytest.raises(ck.NotSimulatedError, match="impose a speed or a force"):
        timed.plot.forces()


def test_curves_of_analyses_are_drawn(tmp_path):
    curve = ck.load_curve(contact(), pressures=[1e8, 3e8], rtol=1e-5)
    assert drawn(curve.plot.area(), tmp_path) == ["load [µN]", "contact area [µm²]"]
    assert drawn(curve.plot.load(), tmp_path)[0] == "approach [nm]"
    block = ck.SpringSlider(
        load=1e-3, static_coefficient=0.3, kinetic_coefficient=0.2, stiffness=10.0, speed=1e-4
    )
    slip = ck.stick_slip(block)
    assert drawn(slip.plot.force(), tmp_path)[1] == "force of the spring [µN]"


def test_a_study_is_drawn_over_its_parameters(tmp_path):
    scene = contact().scene
    study = ck.study(scene, {"loading.pressure": [1e8, 2e8]}, ck.Accuracy(rtol=1e-5))
    ax = study.plot.number("contact_area")
    assert drawn(ax, tmp_path) == ["pressure [MPa]", "contact area [µm²]"]
    np.testing.assert_allclose(ax.get_lines()[0].get_xdata(), [100.0, 200.0])
    with pytest.raises(ck.DescriptionError, match=r"be one of pressure"):
        study.plot.number("contact_area", over="liquid")


@pytest.mark.parametrize(
    ("suffix", "start"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")]
)
def test_the_suffix_chooses_the_kind_of_file(suffix, start, tmp_path):
    def write(name):
        figure, ax = style.figure()
        ax.plot([0.0, 1.0], label="a line")
        return style.save(figure, tmp_path / f"{name}.{suffix}").read_bytes()

    assert write("one").startswith(start)
    assert write("one") == write("two")
    with pytest.raises(ck.DescriptionError, match=r"end in \.png, \.pdf or \.svg"):
        style.save(style.figure()[0], tmp_path / "figure.jpg")
    assert not (tmp_path / "figure.jpg").exists()


def test_units_are_saved_in_the_letters_of_print(tmp_path):
    figure, (left, right) = style.figure(1, 2)
    left.set(xlabel="time [us]", ylabel="tilt [deg]")
    right.set(xlabel="5 um at 20 degC, 60/60 deg", ylabel="bus, degrees and medium")
    left.set_title("first", loc="left")
    style.letters(ax for ax in (left, right))
    style.save(figure, tmp_path / "figure.png", dpi=30)
    assert (left.get_xlabel(), left.get_ylabel()) == ("time [µs]", "tilt [°]")
    assert right.get_xlabel() == "5 µm at 20 °C, 60/60°"
    assert right.get_ylabel() == "bus, degrees and medium"
    assert [ax.get_title(loc="left") for ax in (left, right)] == ["(a) first", "(b)"]


def test_matplotlib_comes_with_the_first_figure_alone():
    code = (
        "import sys, numpy as np, contactkit as ck\n"
        "sys.modules['numba'] = None  # whose loops take seconds to load\n"
        "steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)\n"
        "r = ck.press(1e-9 * np.eye(8), 1e-7, steel, mean_pressure=1e6)\n"
        "assert 'matplotlib' not in sys.modules\n"
        "r.plot\n"
        "assert 'matplotlib' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-W", "ignore", "-c", code], check=True)


def test_errors_of_closures_are_written_beside_their_cost():
    from contactkit.plot.cost import closures
    from contactkit.work_precision import Point, WorkPrecision

    points = (
        Point("exact", "flats, 0/0 deg, 200 gaps", 3e-14, 3e-5, {}),
        Point("exact", "flats, 0/0 deg, 200 gaps, first time", 3e-14, 5e-5, {}),
        Point("exact", "flats, 0/0 deg, one gap", 2e-16, 2e-3, {}),
        Point("arc", "flats, 0/0 deg, 200 gaps", 0.0604, 8e-8, {}, is_model=True),
        Point("arc", "sphere V/R^3 = 0.01, 200 gaps", 1.36, 7e-6, {}, is_model=True),
    )
    found = WorkPrecision("force", 1.0, 1e-12, points)
    names = ["flats, 0/0 deg", "sphere V/R^3 = 0.01"]
    ax = closures(found, style.figure()[1], names)
    assert sorted(one.get_text() for one in ax.texts) == ["136 %", "6 %", "exact", "exact"]
    assert ax.get_yticklabels()[0].get_text() == "flats, 0/0°"
    places = {round(one.xy[1]): one.get_text() for one in ax.texts if one.get_text() != "exact"}
    assert places == {0: "6 %", 1: "136 %"}
    assert ax.get_xlabel() == "seconds per gap; beside them: error of the force"
