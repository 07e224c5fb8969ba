"""Forces of one's own that depend on the speed: in motions, curves, impulses, files and FMUs.

The references solve the equation of motion with scipy, with the film of two discs written out.
"""

import json
import math
from itertools import pairwise
from typing import ClassVar

import attrs
import numpy as np
import pytest
from attrs import field, frozen
from scipy.integrate import quad, solve_ivp
from selection import quick

import contactkit as ck
from contactkit.fmu.native.film import moving, prepared_film
from contactkit.kinds import SLIDING_EFFECTS
from contactkit.scene.column import Column
from contactkit.separation.effects.base import ForceLaw, SeparationForce
from contactkit.separation.sliding.effects import SlideLaw, SlidingForce
from contactkit.units import si

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

VISCOSITY, VOLUME, RADIUS, MASS, PULL = 1e-3, 1e-11, 1e-3, 1e-3, 1.0
START, END = 4e-6, 1e-4
SPEED = 1e-2


@frozen(kw_only=True)
class Brake(SeparationForce):
    """Resistance b + c v + q v |v|."""

    name: ClassVar[str] = "brake"
    summary: ClassVar[str] = "brake"
    column: ClassVar[Column] = Column("brake_force", "N", "brake")
    needs_film: ClassVar[bool] = False
    sources = ("nobody",)

    rest: float = field(default=0.0, metadata=si("N"))
    linear: float = field(default=0.0, metadata=si("N.s/m"))
    square: float = 0.0

    def force(self, speed):
        return self.rest + (self.linear + self.square * np.abs(speed)) * speed

    def prepare(self, prepared):
        return ForceLaw(lambda gap, speed: float(self.force(speed)))


LINEAR, SQUARE = Brake(linear=100.0), Brake(square=1000.0)
ALL = Brake(rest=0.2, linear=5.0, square=2000.0)
BRAKES = pytest.mark.parametrize("brake", [LINEAR, SQUARE, ALL], ids=["linear", "square", "all"])


def imposed(**changes):
    given = {"force": PULL, "mass": MASS, "initial_gap": START, "final_gap": END}
    return ck.ImposedForce(**given | changes)


def scene(loading, *effects):
    oil = ck.Liquid(name="oil", viscosity=VISCOSITY, surface_tension=0.03)
    face = ck.Flat(radius=RADIUS)
    film = ck.Meniscus(liquid=oil, volume=VOLUME)
    interface = ck.Interface(lower=face, upper=face, meniscus=film)
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects)


def run(loading, *effects, **accuracy):
    made = ck.Accuracy(**accuracy) if accuracy else None
    return ck.simulate(ck.plan(scene(loading, *effects), made))


def film_damping(gap):
    """Viscous force per speed of two discs: Stefan's, of the volume or full to the rim."""
    square = min(VOLUME / (math.pi * gap), RADIUS**2)
    return 1.5 * math.pi * VISCOSITY * square**2 / gap**3


def reference(brake, with_film, stiffness=0.0):
    """Time, speed, impulse of the brake and dissipated work at release."""

    def rates(time, y):
        gap, speed = y[:2]
        held, film = float(brake.force(speed)), film_damping(gap) * speed if with_film else 0.0
        net = PULL - stiffness * (gap - START) - held - film
        return [speed, net / MASS, held, (held - brake.rest + film) * speed]

    def released(time, y):
        return y[0] - END

    released.terminal = True
    begin = [START, 0.0, 0.0, 0.0]
    found = solve_ivp(
        rates, (0.0, 1.0), begin, method="Radau", rtol=1e-11, atol=1e-20, events=released
    )
    return found.t[-1], *found.y[1:, -1]


# Motion under a pull --------------------------------------------------------------------------


@BRAKES
@pytest.mark.parametrize("with_film", quick([True, False], 0))
def test_release_impulse_and_work_are_those_of_a_reference_solution(brake, with_film):
    film = (ck.ViscousForce(),) if with_film else ()
    result = run(imposed(), *film, brake, time_rtol=1e-9)
    time, speed, impulse, work = reference(brake, with_film)
    assert result.state.release_time == pytest.approx(time, rel=1e-8)
    assert result.state.release_speed == pytest.approx(speed, rel=1e-8)
    assert result.of(Brake).impulse == pytest.approx(impulse, rel=1e-8)
    assert result.state.dissipated_work == pytest.approx(work, rel=1e-8)


def test_the_tolerance_of_time_holds_for_a_brake_too():
    time = reference(ALL, True)[0]
    for rtol in (1e-4, 1e-6, 1e-8):
        result = run(imposed(), ck.ViscousForce(), ALL, time_rtol=rtol)
        assert result.state.release_time == pytest.approx(time, rel=10.0 * rtol)


@BRAKES
def test_curves_are_the_force_at_the_speed_of_each_point(brake):
    result = run(imposed(), ck.ViscousForce(), brake)
    np.testing.assert_allclose(result["brake_force"], brake.force(result["speed"]), rtol=1e-12)
    assert result["brake_force"].max() > 0.3
    trapezoid = np.trapezoid(result["brake_force"], result.time)
    assert result.of(Brake).impulse == pytest.approx(trapezoid, rel=1e-2)
    film = np.array([film_damping(gap) for gap in result.gap]) * result["speed"]
    np.testing.assert_allclose(result["viscous_force"], film, rtol=1e-9)
    outer = result.state.peak_force
    assert outer >= (result["brake_force"] + result["viscous_force"]).max() * (1.0 - 1e-6)


def test_momentum_is_conserved_with_a_film_that_cavitates():
    cavitates = ck.TensionLimit(strength=1e4)
    result = run(imposed(), ck.ViscousForce(), cavitates, Brake(linear=5.0))
    assert result["void_volume"].max() > 0.0
    given = PULL * result.state.release_time
    taken = result.of(Brake).impulse + result.of(ck.ViscousForce).impulse
    assert given - taken == pytest.approx(MASS * result.state.release_speed, rel=1e-5)
    np.testing.assert_allclose(result["brake_force"], 5.0 * result["speed"], rtol=1e-12)


def test_a_spring_that_holds_a_braked_mass_is_reported():
    result = run(imposed(stiffness=2e4, time_limit=1.0), ck.ViscousForce(), LINEAR)
    assert result.status == "stuck"
    assert "spring" in result.message


def test_a_pull_below_what_a_brake_holds_at_rest_is_stuck_and_names_it():
    made = ck.plan(scene(imposed(force=0.1), ck.ViscousForce(), ALL))
    result = ck.simulate(made, throw=False)
    assert result.status == "stuck"
    assert "0.2 N of the brake" in result.message


def test_a_mass_that_is_pushed_by_its_own_motion_is_not_called_held():
    pushed = Brake(linear=-2.0)  # energy comes from it
    result = run(imposed(stiffness=1.2e4, time_limit=0.05), pushed)
    assert result.status == "released"


# Imposed motions ------------------------------------------------------------------------------


@BRAKES
def test_along_a_speed_curve_impulse_and_plan_agree(brake):
    loading = ck.ImposedSpeed(speed=SPEED, initial_gap=START, final_gap=END)
    result = run(loading, ck.ViscousForce(), brake)
    force = float(brake.force(SPEED))
    np.testing.assert_allclose(result["brake_force"], force, rtol=1e-12)
    assert result.of(Brake).impulse == pytest.approx(force * (END - START) / SPEED, rel=1e-9)
    alone = ck.plan(scene(loading, brake))
    assert alone.force(2.0 * START, SPEED) == pytest.approx(force, rel=1e-12)
    pull = result["brake_force"] + result["viscous_force"]
    np.testing.assert_allclose(result["pull"], pull, rtol=1e-12)


def test_a_vibration_changes_the_impulse_of_a_square_brake_alone():
    shaken = ck.Vibration(amplitude=5e-7, frequency=500.0)
    loading = ck.ImposedSpeed(speed=1e-4, initial_gap=START, final_gap=1e-5, vibration=shaken)
    linear, square = run(loading, LINEAR), run(loading, SQUARE)
    duration = (1e-5 - START) / 1e-4
    pace = math.tau * 500.0

    def force(time):
        return float(SQUARE.force(1e-4 + 5e-7 * pace * math.cos(pace * time)))

    edges = np.linspace(0.0, duration, 61)
    parts = [quad(force, a, b, epsrel=1e-10)[0] for a, b in pairwise(edges)]
    assert linear.of(Brake).impulse == pytest.approx(100.0 * (1e-5 - START), rel=1e-9)
    assert square.of(Brake).impulse == pytest.approx(math.fsum(parts), rel=1e-3)


def test_within_a_time_only_what_the_gaps_give_is_known():
    loading = ck.ImposedTime(time=1e-3, initial_gap=START, final_gap=END)
    result = run(loading, LINEAR)
    assert result.of(Brake).impulse == pytest.approx(100.0 * (END - START), rel=1e-12)
    assert "brake_force" not in result.columns
    still = run(loading, Brake(rest=0.2))
    np.testing.assert_array_equal(still["brake_force"], 0.2)
    for brake in (SQUARE, ALL, Brake(rest=0.2, linear=1.0)):
        with pytest.raises(ck.PlanError, match="Brake needs a speed or a force imposed"):
            run(loading, brake)


def test_without_a_mass_a_linear_brake_sets_the_speed():
    result = run(imposed(mass=None), LINEAR)
    assert result.state.release_time == pytest.approx(100.0 * (END - START) / PULL, rel=1e-7)
    for brake in (SQUARE, Brake(rest=0.2)):
        with pytest.raises(ck.PlanError, match=r"needs loading.mass \[kg\]"):
            run(imposed(mass=None), brake)


# What a law may say of itself ------------------------------------------------------------------


@frozen(kw_only=True)
class Declared(Brake):
    """The same, with slopes of its own, or a word on the speed."""

    rate: str = "any"
    has_slopes: bool = False

    def prepare(self, prepared):
        def slopes(gap, speed):
            return 0.0, self.linear + 2.0 * self.square * abs(speed)

        law = super().prepare(prepared).force
        return ForceLaw(law, slopes=slopes if self.has_slopes else None, rate=self.rate)


def test_slopes_of_ones_own_take_no_more_steps_and_give_the_same():
    given = {"rest": 0.2, "linear": 5.0, "square": 2000.0}
    exact = run(imposed(), ck.ViscousForce(), Declared(**given, has_slopes=True))
    found = run(imposed(), ck.ViscousForce(), Declared(**given))
    assert exact.state.release_time == pytest.approx(found.state.release_time, rel=1e-7)
    assert exact.work.n_evaluations == pytest.approx(found.work.n_evaluations, rel=0.05)


def test_wrong_slopes_cost_steps_and_not_the_right_force():
    """The slopes are used: with those of another force the iteration does not end."""

    class Wrong(Declared):
        def prepare(self, prepared):
            law = super().prepare(prepared)
            return attrs.evolve(law, slopes=lambda gap, speed: (0.0, 1e2))

    right = run(imposed(), Declared(linear=5.0, has_slopes=True))
    wrong = run(imposed(), Wrong(linear=5.0))
    assert wrong.work.n_evaluations > 1.5 * right.work.n_evaluations


@pytest.mark.parametrize(("brake", "rate"), [(SQUARE, "proportional"), (LINEAR, "none")])
def test_a_word_that_the_force_does_not_keep_is_refused(brake, rate):
    given = {"linear": brake.linear, "square": brake.square}
    with pytest.raises(ck.PlanError, match=f'Declared: its ForceLaw says rate="{rate}"'):
        ck.plan(scene(imposed(), Declared(**given, rate=rate)))


# Files and FMUs --------------------------------------------------------------------------------


@pytest.fixture
def known():
    with ck.EFFECTS.including():
        ck.register(Brake)
        yield


def test_scene_and_result_come_back_from_files(known, tmp_path):
    made = scene(imposed(), ck.ViscousForce(), ALL)
    assert ck.load_scene(ck.save_scene(made, tmp_path / "brake.toml")) == made
    result = ck.simulate(ck.plan(made))
    again = ck.load_result(ck.save_result(result, tmp_path / "brake"))
    np.testing.assert_array_equal(again["brake_force"], result["brake_force"])
    assert again.of(Brake).impulse == result.of(Brake).impulse
    assert json.dumps(again.scalars()) == json.dumps(result.scalars())


def test_the_python_fmu_refuses_it_by_name():
    from contactkit.fmu.slaves.stiction_mass import mass_values

    with pytest.raises(ck.ContactkitError, match=r"[Bb]rake.*native"):
        mass_values(scene(imposed(), ck.ViscousForce(), LINEAR))


def test_tables_of_a_native_fmu_hold_what_it_is_at_rest_and_per_speed():
    brake = Brake(rest=0.2, linear=5.0)
    (film,) = prepared_film(moving(scene(imposed(), brake), None)).tables.films
    at_rest, per_speed = film.laws
    for law, rate, level in ((at_rest, "AT_REST", 0.2), (per_speed, "PER_SPEED", 5.0)):
        (piece,) = law.table.pieces
        assert (law.rate.name, piece.power) == (rate, 0)
        np.testing.assert_allclose(piece.y, level, rtol=1e-12)


@pytest.mark.parametrize("brake", [SQUARE, ALL], ids=["square", "all"])
def test_what_is_not_linear_has_no_native_form_and_a_cure(brake):
    made = moving(scene(imposed(), ck.ViscousForce(), brake), None)
    with pytest.raises(ck.PlanError, match=r"Brake has no native form.*not linear.*ck\.simulate"):
        prepared_film(made)


@pytest.mark.slow
@pytest.mark.usefixtures("kernels_compiled_once")
@pytest.mark.parametrize("cavitates", [False, True])
@pytest.mark.parametrize("rest", [0.0, 0.2])
def test_a_native_fmu_moves_as_the_plan(rest, cavitates, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    from contactkit.fmu.framework.toolchain import local
    from contactkit.fmu.native.build import build_native

    limit = (ck.TensionLimit(strength=1e4),) if cavitates else ()
    made = scene(imposed(), ck.ViscousForce(), *limit, Brake(rest=rest, linear=5.0))
    path = build_native(made, tmp_path / "brake.fmu", platforms=[local()])
    result = ck.simulate(ck.plan(made))
    end = result.state.release_time
    found = fmpy.simulate_fmu(
        str(path),
        start_values={"F_ext": PULL},
        stop_time=0.9 * end,
        output_interval=0.9 * end,
        output=["h", "v", "F_m", "F_v", "W", "J"],
    )[-1]
    there = ck.simulate(ck.plan(attrs.evolve(made, loading=imposed(time_limit=0.9 * end))))
    state = there.state
    assert found["h"] == pytest.approx(state.gap, rel=1e-5)
    assert found["v"] == pytest.approx(state.speed, rel=1e-5)
    assert found["F_m"] == pytest.approx(rest, abs=1e-12)
    viscous = there["viscous_force"][-1] + 5.0 * state.speed
    assert found["F_v"] == pytest.approx(viscous, rel=1e-4)
    assert found["W"] == pytest.approx(state.dissipated_work, rel=1e-4)


# Along the bodies ------------------------------------------------------------------------------


@frozen(kw_only=True)
class SquareDrag(SlidingForce):
    """Drag q v^2 along the bodies."""

    name: ClassVar[str] = "square-drag"
    summary: ClassVar[str] = "drag of the square of the speed"
    column: ClassVar[Column] = Column("square_force", "N", "square drag")
    sources = ("nobody",)
    square: float = 3.0

    def prepare(self, prepared):
        return SlideLaw(lambda travel, speed: self.square * speed**2 + 0.0 * travel)


def slid(**loading):
    oil = ck.Liquid(name="oil", viscosity=VISCOSITY, surface_tension=0.03)
    face = ck.Flat(radius=RADIUS)
    film = ck.Meniscus(liquid=oil, volume=VOLUME)
    interface = ck.Interface(lower=face, upper=face, meniscus=film)
    return ck.SlidingScene(
        interface=interface, loading=ck.Sliding(gap=START, **loading), effects=(SquareDrag(),)
    )


def test_a_drag_along_the_bodies_follows_the_speed_and_needs_one():
    with SLIDING_EFFECTS.including(SquareDrag):
        result = ck.simulate(ck.plan(slid(speed=0.1)))
        with pytest.raises(ck.PlanError, match=r"SquareDrag needs loading.speed \[m/s\]"):
            ck.plan(slid(time=1e-2))
    np.testing.assert_allclose(result["square_force"], 3.0 * 0.1**2, rtol=1e-12)
    length = float(result["travel"][-1])
    assert result.of(SquareDrag).impulse == pytest.approx(3.0 * 0.1 * length, rel=1e-9)
