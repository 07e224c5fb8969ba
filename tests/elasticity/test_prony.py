"""Prony series: creep against the convolution, complex moduli, fits; creep of layers."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.elasticity.creep_symbol import common_times
from contactkit.elasticity.prony import (
    PronySeries,
    creep_compliance,
    creep_of,
    fit_prony,
    modulus_at_rate,
    relaxation_modulus,
    storage_and_loss,
)
from contactkit.errors import DescriptionError

SERIES = {
    "standard linear solid": PronySeries(1e6, [3e6], [2.0]),
    "three terms": PronySeries(2e5, [1e8, 5e6, 1e6], [1e-3, 0.3, 40.0]),
    "a millionth": PronySeries(1.0, [1e6], [1.0]),
    "hardly any": PronySeries(1e9, [1.0, 1e-3], [1.0, 1.001]),
    "twelve decades": PronySeries(1e5, [1e6] * 13, np.logspace(-9, 3, 13)),
}

OMEGA = np.logspace(-2, 2, 9)


@pytest.mark.parametrize("series", SERIES.values(), ids=SERIES)
def test_creep_and_relaxation_are_reciprocal_at_every_rate(series):
    creep = creep_of(series)
    rates = np.concatenate([[0.0], np.logspace(-12, 12, 49)])
    compliance = creep.instantaneous + (1.0 / (1.0 + np.outer(rates, creep.times))) @ (
        creep.compliances
    )
    np.testing.assert_allclose(compliance * modulus_at_rate(series, rates), 1.0, rtol=1e-12)
    assert (creep.compliances > 0.0).all()


def test_creep_solves_the_convolution():
    """A step of stress: the integral of E over the rate of J is 1 at all times."""
    series = SERIES["three terms"]
    creep = creep_of(series)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    for t in (1e-3, 0.1, 10.0):
        lag = 0.5 * t * (1.0 + nodes) ** 2 / 2.0  # denser at the start
        by = 0.5 * t * (1.0 + nodes) * weights
        slope = np.exp(-lag[:, None] / creep.times) @ (creep.compliances / creep.times)
        at_once = creep.instantaneous * float(relaxation_modulus(series, t))
        stress = at_once + float((relaxation_modulus(series, t - lag) * slope) @ by)
        assert stress == pytest.approx(1.0, rel=1e-6)
    assert float(creep_compliance(creep, 1e9)) == pytest.approx(1.0 / series.equilibrium)


def test_loss_is_the_work_of_a_cycle():
    """pi E'' times the square of the strain, from the stress of a sine by its own terms."""
    series, frequency = SERIES["three terms"], 5.0
    storage, loss = storage_and_loss(series, [frequency])
    moduli, times = np.array(series.moduli), np.array(series.times)
    phase = np.linspace(0.0, 2.0 * math.pi, 4001)
    rate = 1j * frequency
    stress = (series.equilibrium + moduli @ (rate * times / (1.0 + rate * times))) * np.exp(
        1j * phase
    )
    strain_rate = np.cos(phase)
    work = np.trapezoid(stress.imag * strain_rate, phase)
    assert work == pytest.approx(math.pi * loss[0], rel=1e-6)
    assert stress.imag[1000] == pytest.approx(storage[0])


def test_a_fit_finds_the_moduli_of_a_table():
    series = PronySeries(1e6, [4e6, 2e6, 3e6], [0.01, 1.0, 100.0])
    omega = np.logspace(-4, 4, 33)
    fit = fit_prony(omega, *storage_and_loss(series, omega))
    assert fit.largest_error < 1e-9
    t = np.logspace(-4, 4, 9)
    np.testing.assert_allclose(
        relaxation_modulus(fit.series, t), relaxation_modulus(series, t), rtol=1e-6
    )
    # Of times between those of the fit; an error of 20 % in the loss is seen.
    other = PronySeries(1e6, [9e6], [0.37])
    storage, loss = storage_and_loss(other, omega)
    near, far = fit_prony(omega, storage, loss), fit_prony(omega, storage, 1.2 * loss)
    assert near.error < 0.02
    assert near.largest_error < 0.06
    assert far.error > 0.04
    assert far.error <= far.largest_error


def test_a_table_in_texts_is_that_in_numbers():
    table = [1.0, 10.0], ["1.1 MPa", 2.1e6], ["200 kPa", "0.2 MPa"]
    assert fit_prony(*table).error == fit_prony([1, 10], [1.1e6, 2.1e6], [2e5, 2e5]).error


def test_a_table_that_no_solid_has_is_pointed_out():
    storage, loss = storage_and_loss(PronySeries(1e6, [9e6], [1.0]), OMEGA)
    given = {"name": "gel", "poisson_ratio": 0.5}
    made = ck.ViscoelasticMaterial.from_table(OMEGA, storage, loss, **given)
    assert made.instantaneous.young_modulus == pytest.approx(1e7, rel=1e-6)
    with pytest.warns(ck.ValidityWarning, match="Prony series over the modulus.*the order is"):
        ck.ViscoelasticMaterial.from_table(storage, loss, OMEGA, **given)
    noise = 1.0 + 0.1 * np.random.default_rng(6).standard_normal((2, OMEGA.size))
    ck.ViscoelasticMaterial.from_table(OMEGA, *(noise * (storage, loss)), **given)


@pytest.mark.errors
@pytest.mark.parametrize(
    ("table", "said"),
    [
        (([1.0, -1.0], [1.0, 1.0], [1.0, 1.0]), "frequency"),
        (
            ([1.0, 2.0], [1.0, 0.0], [1.0, 1.0]),
            r"storage\) must be positive.*got 0.0.*index 1",
        ),
        (([1.0, 2.0], [1.0, 1.0], ["1 MPa", "1 m"]), r"loss\).*converts to Pa"),
        (([1.0, 2.0], np.ma.masked_greater([1.0, 2.0], 1.0), [1.0, 1.0]), "without a mask"),
        (([1.0, 2.0], [1.0, 1.0], [1.0]), "one length"),
        (([], [], []), "frequency"),
        ((OMEGA, OMEGA**2 / (1.0 + OMEGA**2), OMEGA / (1.0 + OMEGA**2)), "plateau at low"),
    ],
)
def test_a_table_that_cannot_be_fitted_is_refused(table, said):
    with pytest.raises(DescriptionError, match=said):
        fit_prony(*table)


@pytest.mark.parametrize("decades", [0.001, 0.3, 2.0, 5.0])
def test_common_times_meet_any_exponential_between_them(decades):
    longest = 10.0**decades
    made = common_times(1.0, longest)
    rates = np.concatenate([[np.inf, 0.0], made.rates])
    t = np.logspace(-2, decades + 2, 60)
    for time in np.geomspace(1.0, longest, 13):
        terms = made.matrix @ (1.0 / (1.0 + rates * time))
        assert terms.sum() == pytest.approx(1.0, abs=1e-8)  # both limits
        found = np.exp(-t[:, None] / made.times) @ terms
        np.testing.assert_allclose(found, np.exp(-t / time), atol=2e-4)
