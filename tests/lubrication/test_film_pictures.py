"""Pictures of films: what they show, and what they refuse."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.errors import DescriptionError
from contactkit.lubrication import reynolds

# Their tensions and grids are chosen for the numbers, not for a liquid.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

film_plot = pytest.importorskip("contactkit.plot.film")
R = 3.175e-3


@pytest.fixture(scope="module")
def steps():
    """A quarter of a disc that opens ever faster."""
    face = reynolds.rasterise(ck.Disc(radius=R), 16, window=(0.0, R, 0.0, R))
    film = reynolds.GridFilm(face=face, viscosity=0.1, drop=1e6)
    times = np.linspace(0.0, 2e-4, 11)
    return list(reynolds.follow_gap(film, lambda t: 5e-6 + 125.0 * t * t, times))


def test_maps_show_the_film_alone(steps):
    state = steps[-1]
    ax = film_plot.pressure(state)
    shown = ax.images[0].get_array()
    assert np.array_equal(np.ma.getmaskarray(shown), ~state.film.face.inside)
    assert shown.min() == pytest.approx(-10.0)
    assert "mm" in ax.get_xlabel()
    whole = film_plot.liquid_fraction(state, mirror=(True, True)).images[0].get_array()
    assert whole.shape == (32, 32)
    assert np.array_equal(whole[16:, 16:], whole[15::-1, 15::-1])


def test_a_cavity_has_another_colour_than_a_low_pressure(steps):
    state = steps[-1]
    ax = film_plot.pressure(state)
    void = state.film.face.loaded & (state.liquid_fraction < 1.0)
    assert 0.1 < void.mean() < 0.9
    assert np.array_equal(~np.ma.getmaskarray(ax.images[1].get_array()), void)
    lowest, cavity = (one.cmap(one.norm(-10.0)) for one in ax.images[:2])
    assert max(abs(a - b) for a, b in zip(lowest, cavity, strict=True)) > 0.5
    assert [one.get_text() for one in ax.get_legend().get_texts()] == ["cavity, at -10 bar"]
    full = reynolds.solve_pressure(
        reynolds.GridFilm(face=state.film.face, viscosity=0.1), 5e-6, 0.1
    )
    assert film_plot.pressure(full).get_legend() is None


def test_a_round_edge_is_drawn_round(steps):
    """On 16 cells the edge of the film is a staircase; it is covered up to the circle."""
    ax = film_plot.pressure(steps[0])
    edge = ax.collections[-1].get_paths()[0].vertices
    away = np.hypot(*edge.T)
    assert np.ptp(away) < 0.02 * R * 1e3
    assert away.mean() == pytest.approx(R * 1e3, rel=0.01)


def test_instants_have_one_scale(steps):
    made = film_plot.instants([steps[0], steps[-1]], mirror=(True, True))
    limits = {ax.images[0].get_clim() for ax in made.axes[:2]}
    assert len(limits) == 1
    assert made.axes[0].get_title() != made.axes[1].get_title()


def test_an_opening_shows_gap_force_and_cavity(steps):
    axes = film_plot.opening(steps, copies=4)
    time, force = axes[1].lines[0].get_data()
    assert time[-1] == pytest.approx(steps[-1].time * 1e3)
    assert force[-1] == 4.0 * steps[-1].force
    cavity = axes[2].lines[0].get_ydata()
    assert 0.5 < cavity.max() < R * 1e3


@pytest.mark.slow
def test_an_animation_has_a_picture_for_each_state(steps, tmp_path):
    image = pytest.importorskip("PIL.Image")
    states = steps[:: len(steps) // 3]
    made = film_plot.animate(states, tmp_path / "opening.gif", mirror=(True, True), copies=4)
    with image.open(made) as shown:
        assert shown.n_frames == len(states)


def test_bad_input_is_refused(steps, tmp_path):
    with pytest.raises(DescriptionError, match=r"end in \.gif"):
        film_plot.animate(steps, tmp_path / "film.png")
    with pytest.raises(DescriptionError, match="two or more states"):
        film_plot.animate([], tmp_path / "film.gif")
    with pytest.raises(DescriptionError, match="two or more steps"):
        film_plot.opening([])
    with pytest.raises(DescriptionError, match="one or more states"):
        film_plot.instants([])
