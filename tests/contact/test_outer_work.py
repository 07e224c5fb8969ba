"""Cost of the outer iteration: contacts solved, and operator applications over one contact."""

import pytest

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

THIN = ck.Stack(
    layers=(
        ck.Layer(
            material=ck.Material(young_modulus=3e11, poisson_ratio=0.2, hardness=3e9),
            thickness=2e-9,
        ),
    ),
    substrate=ck.Material(young_modulus=7e10, poisson_ratio=0.2, hardness=3e8),
)
ROUGH = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=5e-8, seed=1)
WATER = ck.Meniscus(
    liquid=ck.Liquid(name="water", surface_tension=0.072, viscosity=1e-3),
    contact_angle_lower=0.2,
    contact_angle_upper=0.2,
)
COUPLING = (ck.FrictionTraction(coefficient=0.5), ck.FrictionCoupling())
LIMIT = ck.HardnessLimit()
LOCAL = ck.HardnessLimit(rule=ck.ContinuousHardness(displacement="local"))
STICKY = ck.Adhesion(law=ck.ExponentialAttraction(work_of_adhesion=0.05, range=1e-9))
FILM = ck.FilmMeniscus(film_thickness=1.5e-9, self_consistent=True)


def work(*effects, pressure):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=THIN), upper=ck.Body(surface=ROUGH), meniscus=WATER
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=48))).work


# Effects, pressure [Pa], contacts solved and applications over those of one contact, as measured.
CASES = {
    "one hardness": ((LIMIT,), 2.5e8, 4, 3.8),
    "local hardness": ((LOCAL,), 1.5e8, 8, 4.8),
    "coupling": (COUPLING, 1e8, 6, 2.3),
    "adhesion": ((STICKY,), 1e8, 8, 2.4),
    "local hardness, coupling": ((LOCAL, *COUPLING), 1.5e8, 12, 6.3),
    "one hardness, coupling": ((LIMIT, *COUPLING), 1.5e8, 18, 6.3),
    "local hardness, coupling, adhesion": ((LOCAL, *COUPLING, STICKY), 1.5e8, 15, 8.3),
    "film, coupling": ((FILM, *COUPLING), 1e8, 22, 12.0),
}


@pytest.mark.parametrize("case", CASES)
def test_unknowns_take_few_more_contacts_than_one(case):
    effects, pressure, solves, ratio = CASES[case]
    alone, taken = work(pressure=pressure), work(*effects, pressure=pressure)
    assert solves / 2 <= taken.n_solves <= 1.2 * solves + 1
    assert taken.n_operator_applications <= 1.2 * ratio * alone.n_operator_applications
