"""What holds for every separation: scaling, symmetry, division of time, files that come back."""

from __future__ import annotations

import math

import attrs
import loadings
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import contactkit as ck
from contactkit.separation.motion.state import start
from contactkit.units import celsius, parse_quantity, parse_unit

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


def decades(low, high):
    return st.floats(low, high).map(lambda x: 10.0**x)


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


FORCES = (ck.MeniscusForce(profile=ck.AsPublished(radius="disc")), ck.ViscousForce())
LIMITED = (*FORCES, ck.TensionLimit(strength=1e5, cavity="truncated"), ck.ShearLimit(strength=1e6))


@attrs.frozen
class Film:
    """Parameters of an oil film between flats, in SI units."""

    gap: float = 1e-6
    final_gap: float = 1e-5
    radius: float = 1e-3
    fill: float = 1.0  # of the gap between the faces
    viscosity: float = 0.1
    tension: float = 0.03
    angle: float = 0.3
    count: int = 1
    sphere: float | None = None

    def scene(self, *effects, **loading):
        face = ck.Flat(radius=self.radius)
        lower = ck.Sphere(radius=self.sphere) if self.sphere else face
        motion = {"initial_gap": self.gap, "final_gap": self.final_gap} | loading
        return ck.SeparationScene(
            interface=ck.Interface(
                lower=lower,
                upper=face,
                meniscus=ck.Meniscus(
                    liquid=ck.Liquid(
                        name="oil", viscosity=self.viscosity, surface_tension=self.tension
                    ),
                    volume=self.fill * math.pi * self.radius**2 * self.gap,
                    contact_angle_lower=self.angle,
                    contact_angle_upper=self.angle,
                    count=self.count,
                ),
            ),
            loading=loadings.imposed(**motion),
            effects=effects or FORCES,
        )

    def plan(self, *effects, **loading):
        return ck.plan(self.scene(*effects, **(loading or {"speed": 1.0})))


films = st.builds(
    Film,
    gap=decades(-8.0, -5.0),
    radius=decades(-4.0, -2.0),
    fill=st.floats(0.2, 3.0),
    viscosity=decades(-4.0, 2.0),
    tension=st.floats(0.02, 0.08),
    angle=st.floats(0.0, 1.5),
    final_gap=st.just(1e-3),
)


# Forces -------------------------------------------------------------------------------------


@given(film=films, speed=decades(-9.0, 1.0), open_by=st.floats(1.0, 10.0))
def test_a_film_without_limits_resists_opening_as_it_resists_closing(film, speed, open_by):
    force = film.plan().film.viscous_force
    gap = film.gap * open_by
    assert force(gap, -speed) == (-force(gap, speed)[0], ck.LimitKind.NONE)


@given(film=films, speed=decades(-9.0, 1.0))
def test_tension_acts_on_opening_only(film, speed):
    """Closing, the pressure rises: the film is as strong as without the limit."""
    free, limited = (
        film.plan(),
        film.plan(*FORCES, ck.TensionLimit(strength=10.0, cavity="truncated")),
    )
    assert limited.film.viscous_force(film.gap, -speed) == free.film.viscous_force(film.gap, -speed)


@given(film=films, speed=decades(-9.0, 1.0), thicker=decades(-3.0, 3.0))
def test_the_viscous_force_is_proportional_to_viscosity(film, speed, thicker):
    other = attrs.evolve(film, viscosity=thicker * film.viscosity)
    one, two = (f.plan().film.viscous_force(film.gap, speed)[0] for f in (film, other))
    assert two == approx(thicker * one, 1e-13)


@given(film=films, speed=decades(-12.0, 3.0), open_by=st.floats(1.0, 50.0))
def test_limits_take_force_away_and_never_turn_it(film, speed, open_by):
    gap = film.gap * open_by
    newtonian = film.plan().film.viscous_force(gap, speed)[0]
    left, acting = film.plan(*LIMITED).film.viscous_force(gap, speed)
    assert 0.0 < left <= newtonian
    assert (acting is ck.LimitKind.NONE) == (left == newtonian)


@given(film=films, open_by=st.floats(1.1, 10.0), closure=st.sampled_from(["f", "v"]))
def test_the_force_is_the_slope_of_the_impulse(film, open_by, closure):
    """Virtual work of the film: its impulse is a potential, c(h) = dPhi/dh."""
    effect = ck.ViscousForce(closure={"f": "flooded", "v": "volume-conserving"}[closure])
    law = film.plan(effect).film.laws[ck.ViscousForce]
    gap = film.gap * open_by
    assume(all(abs(gap / kink - 1.0) > 1e-3 for kink in law.kinks))
    step = 1e-4 * gap
    slope = (law.impulse(film.gap, gap + step) - law.impulse(film.gap, gap - step)) / (2.0 * step)
    # Central difference: 35 (dh/h)^2/6 at most, and rounding of a large impulse, 1e-16/1e-4.
    assert slope == approx(
        law.force(gap, 1.0), 1e-6 + 1e-11 * law.impulse(film.gap, gap) / (law.force(gap, 1.0) * gap)
    )


@given(film=films, first=st.floats(1.1, 5.0), second=st.floats(1.1, 5.0))
def test_the_impulse_adds_up_along_the_way(film, first, second):
    impulse = film.plan().film.laws[ck.ViscousForce].impulse
    middle, end = film.gap * first, film.gap * first * second
    parts = impulse(film.gap, middle) + impulse(middle, end)
    assert parts == approx(impulse(film.gap, end), 1e-12)
    assert impulse(end, film.gap) == -impulse(film.gap, end)


@given(film=films, count=st.integers(2, 100_000), speed=decades(-9.0, 1.0))
def test_dividing_a_film_divides_its_viscous_force(film, count, speed):
    """N films of V/N: N (x/sqrt(N))^4 = x^4/N."""
    one, many = (
        attrs.evolve(film, count=n).plan().film.viscous_force(2.0 * film.gap, speed)[0]
        for n in (1, count)
    )
    assert many == approx(one / count, 1e-12)


@given(film=films, count=st.integers(2, 100_000))
def test_dividing_a_film_keeps_its_laplace_force_and_lengthens_its_rim(film, count):
    """The wetted area stays, the rim grows as sqrt(N)."""
    gap = 2.0 * film.gap

    def meniscus(angle, n):
        return attrs.evolve(film, angle=angle, count=n).plan().film.static_force(gap)

    # At 0 degrees the rim does not pull.
    laplace = meniscus(0.0, 1)
    assert meniscus(0.0, count) == approx(laplace, 1e-12)
    fraction = math.cos(film.angle)
    rim = meniscus(film.angle, 1) - laplace * fraction
    # The rim is a difference of the two forces, so that it is known to their rounding.
    assert meniscus(film.angle, count) - laplace * fraction == pytest.approx(
        math.sqrt(count) * rim, abs=1e-12 * count * laplace
    )


@given(film=films, size=decades(-3.0, 3.0), speed=decades(-9.0, 1.0))
def test_a_film_of_another_size_has_the_force_of_its_dimensions(film, size, speed):
    """All lengths and the speed times s: F_v as s^2 at the same viscosity; F_m as s at the same
    surface tension."""
    other = attrs.evolve(
        film, gap=size * film.gap, radius=size * film.radius, final_gap=size * film.final_gap
    )
    one, two = film.plan().film, other.plan().film
    gap = 3.0 * film.gap
    assert two.viscous_force(size * gap, size * speed)[0] == approx(
        size**2 * one.viscous_force(gap, speed)[0], 1e-12
    )
    assert two.static_force(size * gap) == approx(size * one.static_force(gap), 1e-12)


# Motion -------------------------------------------------------------------------------------


def released(film, *effects, **loading):
    result = ck.simulate(ck.plan(film.scene(*effects, **loading)))
    assert result.status == "released"
    return result.state


@pytest.mark.slow
@given(length=decades(-1.0, 1.0), force=decades(-2.0, 2.0), time=decades(-2.0, 2.0))
def test_a_motion_scales_with_its_lengths_forces_and_times(length, force, time):
    """Choose units of length, force and time: every quantity follows from its dimensions."""
    film = Film(gap=2e-6, final_gap=2e-5)
    drive = {"force": 5.0, "mass": 1e-3, "stiffness": 1e3, "rise_time": 1e-4}
    one = released(film, *LIMITED, **drive)
    scaled = attrs.evolve(
        film,
        gap=length * film.gap,
        final_gap=length * film.final_gap,
        radius=length * film.radius,
        viscosity=film.viscosity * force * time / length**2,
        tension=min(film.tension * force / length, 10.0),
    )
    assume(film.tension * force / length < 10.0)
    stress = force / length**2
    limits = (
        ck.TensionLimit(strength=1e5 * stress, cavity="truncated"),
        ck.ShearLimit(strength=1e6 * stress),
    )
    two = released(
        scaled,
        *FORCES,
        *limits,
        force=force * drive["force"],
        mass=drive["mass"] * force * time**2 / length,
        stiffness=drive["stiffness"] * force / length,
        rise_time=time * drive["rise_time"],
    )
    # Both are solved to 1e-8 per step, and may choose other steps where times are rounded.
    assert two.release_time == approx(time * one.release_time, 1e-6)
    assert two.release_speed == approx(length / time * one.release_speed, 1e-6)
    assert two.impulses["viscous_impulse"] == approx(
        force * time * one.impulses["viscous_impulse"], 1e-6
    )
    assert two.dissipated_work == approx(force * length * one.dissipated_work, 1e-5)
    assert two.peak_force == approx(force * one.peak_force, 1e-6)


@pytest.mark.slow
@given(
    parts=st.lists(st.floats(0.01, 1.0), min_size=2, max_size=12),
    gap=decades(-8.0, -5.0),
    viscosity=decades(-3.0, 1.0),
)
def test_a_span_of_time_may_be_divided_at_will(parts, gap, viscosity):
    film = Film(gap=gap, final_gap=100.0 * gap, viscosity=viscosity)
    made = film.plan(force=20.0, mass=0.01)
    time = ck.simulate(made).state.release_time
    assume(time > 0.0)
    span, pull = 0.8 * time, ck.Pull(20.0, rate=1.0 / time)
    whole = ck.advance(made, start(made), pull, span)
    state = start(made)
    for part in parts:
        state = ck.advance(made, state, pull, span * part / sum(parts))
    # 200 steps of 1e-8, and towards the release the gap answers an error ten times over.
    assert state.gap == approx(whole.gap, 5e-5)
    assert state.dissipated_work == approx(whole.dissipated_work, 5e-5)
    for name, impulse in whole.impulses.items():
        assert state.impulses[name] == approx(impulse, 5e-5), name
    # While the film rules the speed follows from it; its error is of the momentum delivered.
    assert 0.01 * state.speed == pytest.approx(0.01 * whole.speed, abs=1e-7 * whole.applied_impulse)


@given(
    gap=decades(-8.0, -5.0),
    viscosity=decades(-4.0, 1.0),
    force=st.floats(1.0, 100.0),
    rise=st.sampled_from([0.0, 1e-4]),
)
def test_momentum_is_conserved_by_every_motion(gap, viscosity, force, rise):
    film = Film(gap=gap, final_gap=1e-4, viscosity=viscosity, radius=5e-4, tension=1e-3)
    holding = film.plan().film.static_force(gap)
    assume(force > 2.0 * holding)
    state = released(film, *LIMITED, force=force, mass=0.02, rise_time=rise)
    time = state.release_time
    applied_impulse = force * (time + (rise * math.expm1(-time / rise) if rise else 0.0))
    kept = 0.02 * state.release_speed + sum(state.impulses.values())
    # Some hundred steps of 1e-8, of which those over the onset of a limit are estimated less well.
    assert kept == approx(applied_impulse, 1e-5)


# Files --------------------------------------------------------------------------------------

lengths, positives = decades(-9.0, -1.0), decades(-6.0, 6.0)
angles = st.floats(0.0, math.pi)
liquids = st.builds(
    ck.Liquid,
    name=st.text(st.characters(exclude_categories=("Cc", "Cs")), max_size=20),
    surface_tension=st.floats(1e-3, 1.0),
    viscosity=positives,
    density=st.none() | positives,
    source=st.sampled_from(["", 'a "quoted" µ source']),
)
menisci = st.builds(
    ck.Meniscus,
    liquid=liquids,
    volume=st.none() | decades(-20.0, -6.0),
    contact_angle_lower=angles,
    contact_angle_upper=angles,
    count=st.integers(1, 10**6),
    rewetting=st.floats(0.0, 1.0),
)
faces = st.builds(ck.Flat, radius=st.none() | lengths) | st.builds(ck.Sphere, radius=lengths)
interfaces = st.builds(ck.Interface, lower=faces, upper=faces, meniscus=menisci)


@st.composite
def all_loadings(draw):
    first = draw(lengths)
    gaps = {"initial_gap": first, "final_gap": first * draw(st.floats(1.001, 1e3))}
    imposed = draw(st.sampled_from([{"speed": 0.1}, {"time": 1e-3}, {"force": 40.0, "mass": 1.0}]))
    if "force" not in imposed:
        return loadings.imposed(**gaps, **imposed)
    return ck.ImposedForce(
        **gaps,
        force=draw(st.sampled_from([40.0, -3.0])),
        mass=draw(st.none() | positives),
        stiffness=draw(st.floats(0.0, 1e6)),
        rise_time=draw(st.floats(0.0, 1.0)),
        initial_speed=draw(st.floats(-1.0, 1.0)),
        rest_gap=draw(st.sampled_from([0.0, first])),
        time_limit=draw(positives),
    )


effects = st.tuples(
    st.builds(
        ck.MeniscusForce,
        profile=st.just("arc")
        | st.builds(
            ck.AsPublished,
            pulled=st.sampled_from(["lower", "upper"]),
            radius=st.sampled_from(["arc", "disc"]),
        ),
    ),
    st.builds(ck.ViscousForce, closure=st.sampled_from(["volume-conserving", "flooded"])),
    st.builds(
        ck.TensionLimit,
        strength=st.just("vapour") | positives,
        ambient_pressure=positives,
        cavity=st.sampled_from(["mass-conserving", "truncated", "reynolds"]),
    ),
    st.builds(ck.ShearLimit, strength=positives),
    st.builds(ck.Rupture, gap=st.sampled_from(["limit", "zero-neck"]) | lengths),
)
scenes = st.builds(
    ck.SeparationScene,
    interface=interfaces,
    loading=all_loadings(),
    effects=effects.flatmap(lambda all_five: st.lists(st.sampled_from(all_five), unique=True)),
    temperature=st.floats(200.0, 500.0),
    name=st.text(st.characters(exclude_categories=("Cc", "Cs")), max_size=20),
)


@given(scene=scenes)
def test_a_scene_written_to_a_file_comes_back_the_same(tmp_path_factory, scene):
    path = tmp_path_factory.getbasetemp() / "scene.toml"
    ck.save_scene(scene, path)
    assert ck.load_scene(path) == scene


@given(
    value=st.floats(allow_nan=False, allow_infinity=False),
    unit=st.sampled_from(["m", "N", "Pa", "Pa.s", "kg/m3", "N.s/m", "m2/s", "m/s", "K", "-"]),
)
def test_a_number_written_with_its_unit_comes_back_the_same(value, unit):
    text = repr(value) if unit == "-" else f"{value!r} {unit}"
    assert parse_quantity(text, unit) == value
    assert parse_quantity(value, unit) == value


@given(
    value=decades(-12.0, 12.0),
    names=st.sampled_from(
        [
            ("nm", "m", 1e-9),
            ("µm", "m", 1e-6),
            ("mN/m", "N/m", 1e-3),
            ("cSt", "m2/s", 1e-6),
            ("mPa.s", "Pa.s", 1e-3),
            ("bar", "Pa", 1e5),
            ("deg", "rad", math.pi / 180.0),
            ("mm3", "m3", 1e-9),
            ("kN*s/m", "N.s/m", 1e3),
            ("g/cm^3", "kg/m3", 1e3),
            ("%", "-", 1e-2),
        ]
    ),
)
def test_a_unit_scales_what_it_is_written_behind(value, names):
    written, unit, factor = names
    assert parse_quantity(f"{value!r} {written}", unit) == approx(value * factor, 1e-15)


@given(value=st.floats(-273.15, 1e4))
def test_degrees_celsius_are_kelvins_from_another_zero(value):
    assert parse_quantity(f"{value!r} degC", "K") == celsius(value)
    assert parse_quantity(f"{value!r} °C", "K") == celsius(value)


@given(power=st.integers(-4, 4).filter(bool))
def test_the_power_of_a_unit_is_the_power_of_its_factor(power):
    unit = parse_unit(f"mm^{power}")
    assert unit.factor == approx(1e-3**power, 1e-15)
    assert dict(unit.dimension) == {"m": power}
