"""Maps of other array libraries against the solver of numpy and closed forms."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from libraries import (
    COATED,
    E_STAR,
    LIBRARIES,
    SHEET,
    SOLID,
    pressed,
    rough,
    strict_library,
    torch_library,
)

import contactkit as ck

SIX = np.array([rough(32, seed) for seed in range(6)]).reshape(2, 3, 32, 32)
# Loads at which the solver is tried, and which strain the solids more than elasticity allows.
beyond_small_strains = pytest.mark.filterwarnings("ignore:peak pressure over E*")
LOADS = np.array([[0.0, 1e4, 1e6], [1e7, 5e7, 5e8]])  # none to full contact
APPROACHES = np.array([[0.0, 1e-5, -1e-3], [1e-4, 1e-3, 1.5e-3]])


@pytest.fixture(params=LIBRARIES)
def library(request):
    return request.param()


def agrees(library, found, known, rtol=1e-6):
    """Pressures over the highest of each map, gaps over its heights; real area, load, residual."""
    p, gap = library.give(found.pressure), library.give(found.gap)
    scale = np.maximum(known.pressure.max(axis=(-2, -1), keepdims=True), 1e-300)
    assert np.abs(p - known.pressure).max() <= rtol * known.pressure.max()
    assert (np.abs(p - known.pressure) / scale).max() <= 100.0 * rtol
    assert np.abs(gap - known.gap).max() <= rtol * known.heights.std()
    area = library.give(found.contact_fraction)
    assert np.array_equal(np.round(area, 12), np.round(known.contact_fraction, 12))
    assert library.give(found.mean_pressure) == pytest.approx(known.mean_pressure, rel=rtol)
    assert library.give(found.rigid_approach) == pytest.approx(
        known.rigid_approach, rel=rtol, abs=rtol * known.heights.std()
    )
    assert library.give(found.converged).all()
    assert library.give(found.kkt).max() <= 1e-8


@beyond_small_strains
@pytest.mark.parametrize("periodic", [True, False, "x"])
def test_loads_from_none_to_full_contact(library, periodic):
    found, known = pressed(library, SIX, SOLID, mean_pressure=LOADS, periodic=periodic)
    assert known.contact_fraction.min() == 0.0
    assert known.contact_fraction.max() == (
        1.0 if periodic is True else pytest.approx(1.0, abs=0.1)
    )
    agrees(library, found, known)


@beyond_small_strains
@pytest.mark.parametrize("solid", [COATED, SHEET], ids=["hard film", "sheet on a base"])
@pytest.mark.parametrize("periodic", [True, False])
def test_layers(library, solid, periodic):
    found, known = pressed(library, SIX[1], solid, mean_pressure=LOADS[1], periodic=periodic)
    agrees(library, found, known)


@pytest.mark.parametrize("periodic", [True, False])
def test_approaches(library, periodic):
    found, known = pressed(library, SIX, SOLID, approach=APPROACHES, periodic=periodic)
    assert known.mean_pressure[0, 0] == known.mean_pressure[0, 2] == 0.0 < known.mean_pressure[0, 1]
    agrees(library, found, known)


@pytest.mark.parametrize("periodic", [True, False])
def test_bound(library, periodic):
    """A number, of which most of the contact is at the bound; the whole map is."""
    loads = np.array([3e4, 1e7, 2e7])
    given = {"mean_pressure": loads, "hardness": 2e7, "periodic": periodic}
    found, known = pressed(library, SIX[0], SOLID, **given)
    at_bound = (known.pressure >= 2e7).mean(axis=(-2, -1))
    assert at_bound[0] < 0.1 < at_bound[1] < at_bound[2] == 1.0
    agrees(library, found, known)


def test_bound_of_each_pixel(library):
    """A map with holes, where nothing is carried, and one bound for each map."""
    bound = np.full((32, 32), 1e8)
    bound[3:9], bound[:, 20:] = 0.0, 3e8
    found, known = pressed(library, SIX[1], SOLID, mean_pressure=5e7, hardness=bound)
    agrees(library, found, known)
    assert (library.give(found.pressure)[:, 3:9, :20] == 0.0).all()
    each = np.stack([bound, 2.0 * bound, np.where(bound > 0.0, np.inf, 0.0)])
    found, known = pressed(library, SIX[1], SOLID, mean_pressure=5e7, hardness=each)
    agrees(library, found, known)


def test_odd_sides_and_long_pixels(library):
    """Grids that do not halve; the coarser ones cover the same window."""
    h = rough(75, 3, ny=37)[None]
    found, known = pressed(library, h, SOLID, mean_pressure=1e7, periodic=False)
    agrees(library, found, known)
    with library.strictly():
        found = ck.press_maps(library.take(h), ("1 mm", 3e-3), SOLID, mean_pressure="10 MPa")
    agrees(library, found, ck.press_maps(h, (1e-3, 3e-3), SOLID, mean_pressure=1e7))


@beyond_small_strains
def test_one_map_is_as_in_a_batch(library):
    found, _ = pressed(library, SIX, SOLID, mean_pressure=LOADS)
    alone, _ = pressed(library, SIX[1, 0], SOLID, mean_pressure=1e7)
    assert alone.pressure.shape == (32, 32)
    assert alone.kkt.shape == alone.mean_pressure.shape == ()
    one = library.give(found.pressure)[1, 0]
    assert library.give(alone.pressure) == pytest.approx(one, abs=1e-7 * one.max())
    assert abs(int(alone.n_applications) - int(found.n_applications[1, 0])) <= 2


@beyond_small_strains
def test_single_precision(library):
    """In float32 throughout: pressures to 1e-3 of the highest, at the tolerance of float32."""
    found, known = pressed(library, SIX, SOLID, single=True, mean_pressure=LOADS)
    assert found.pressure.dtype == found.rigid_approach.dtype == library.single([1.0]).dtype
    assert library.give(found.kkt).max() <= 1e-4
    error = np.abs(library.give(found.pressure) - known.pressure).max(axis=(-2, -1))
    assert (error <= 1e-3 * known.pressure.max(axis=(-2, -1))).all()
    assert library.give(found.mean_pressure) == pytest.approx(known.mean_pressure, rel=1e-5)


def test_sphere_is_that_of_hertz(library):
    """Load, peak and approach over the radius of contact; 12 pixels to it."""
    n, R, a = 48, 1.0, 0.25
    x = (np.arange(n) - n // 2 + 0.5) / n
    h = -(x[:, None] ** 2 + x**2) / (2.0 * R)
    force = 4.0 * E_STAR * a**3 / (3.0 * R)
    with library.strictly():
        found = ck.press_maps(library.take(h), 1.0 / n, SOLID, mean_pressure=force, periodic=False)
    area = float(found.contact_fraction)
    assert area == pytest.approx(np.pi * a**2, rel=0.05)  # pixels cut by its edge count
    assert library.give(found.pressure).max() == pytest.approx(2.0 * E_STAR * a / np.pi, rel=0.01)
    assert float(found.rigid_approach) == pytest.approx(a**2 / R, rel=0.01)


@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_wave_is_that_of_westergaard(library, fraction):
    """The contact covers the part ``(2/pi) arcsin sqrt(p/p*)`` of the wave, p* = pi E* A/lambda."""
    n = 128
    wave = 1e-3 * np.cos(2.0 * np.pi * (np.arange(n) + 0.5) / n) * np.ones((2, 1))
    flattening = np.pi * E_STAR * 1e-3
    load = fraction * flattening
    with library.strictly():
        found = ck.press_maps(library.take(wave), 1.0 / n, SOLID, mean_pressure=load)
    width = 2.0 / np.pi * np.arcsin(np.sqrt(fraction))
    assert float(found.contact_fraction) == pytest.approx(width, abs=2.0 / n)
    peak = library.give(found.pressure).max()
    assert peak == pytest.approx(2.0 * flattening * np.sqrt(fraction), rel=0.01)


@pytest.mark.filterwarnings("ignore:rms slope")  # of heights of any size
@beyond_small_strains
def test_full_contact_is_a_wave_of_pressure(library):
    """Beyond flattening the pressure is its mean plus p* cos, and the surfaces touch."""
    n = 64
    wave = np.cos(2.0 * np.pi * (np.arange(n) + 0.5) / n) * np.ones((3, 4, 1))
    heights = wave * np.array([1e-9, 1e-3, 1e3])[:, None, None]
    mean = 1.5 * np.pi * E_STAR * np.array([1e-9, 1e-3, 1e3])
    with library.strictly():
        given = library.take(heights), 1.0 / n, SOLID
        found = ck.press_maps(*given, mean_pressure=library.take(mean))
    p = library.give(found.pressure) / mean[:, None, None]
    assert p == pytest.approx(1.0 + wave / 1.5, abs=1e-7)


@pytest.mark.hard
def test_one_pixel(library):
    """A column that alone touches carries all, and moves by its self influence."""
    h = np.zeros((2, 16, 16))
    h[:, 5, 7] = 1e-3
    loads = np.array([1e3, 1e-3])
    found, known = pressed(library, h, SOLID, mean_pressure=loads, periodic=False)
    agrees(library, found, known)
    p = library.give(found.pressure)
    assert p[:, 5, 7] == pytest.approx(256.0 * loads)
    love = 4.0 / np.pi * np.log(1.0 + np.sqrt(2.0)) / 16.0 / E_STAR  # 2/E* of a square patch
    moved = library.give(found.displacement)[:, 5, 7]
    # The gap is rounded as the heights are, 1.8e-20 m in the displacement of 1.6e-11 m.
    rounded = np.finfo(float).eps * h.max()
    assert moved == pytest.approx(p[:, 5, 7] * love, rel=1e-12, abs=rounded)


@pytest.mark.hard
def test_flat_maps(library):
    """The load sets the only length; a uniform pressure on a periodic map, peaks at the edges."""
    for periodic in (True, False):
        found, known = pressed(
            library,
            np.full((2, 8, 8), 3e-3),
            SOLID,
            mean_pressure=np.array([0.0, 1e6]),
            periodic=periodic,
        )
        p = library.give(found.pressure)
        assert p == pytest.approx(known.pressure, rel=1e-6)
        assert library.give(found.rigid_approach) == pytest.approx(known.rigid_approach, abs=1e-9)


@beyond_small_strains
@pytest.mark.hard
@pytest.mark.parametrize("contrast", [1e-6, 1e6])
def test_films_of_any_stiffness(library, contrast):
    """A million times the modulus of the ground or a millionth of it."""
    film = ck.Layer(
        material=ck.Material(young_modulus=1e9 * contrast, poisson_ratio=0.3), thickness=0.01
    )
    stack = ck.Stack(layers=(film,), substrate=SOLID)
    found, known = pressed(library, SIX[0, :2], stack, mean_pressure=np.array([1e4, 1e7]))
    agrees(library, found, known, rtol=1e-5)


@pytest.mark.hard
def test_smallest_maps(library):
    """Two pixels a side, and a strip."""
    for shape in ((2, 2), (2, 40)):
        h = 1e-3 * np.random.default_rng(1).standard_normal((3, *shape))
        for periodic in (True, False):
            found, known = pressed(library, h, SOLID, mean_pressure=1e5, periodic=periodic)
            agrees(library, found, known)


def test_deep_in_a_bound(library):
    """Approaches beyond the mean plane are feasible where the pressure is bounded."""
    found, known = pressed(
        library, SIX[0], SOLID, approach=np.array([1e-3, 1e-2, 1.0]), hardness=1e8
    )
    assert known.mean_pressure[2] == 1e8
    agrees(library, found, known)


UNITS = [
    ({"heights": 1e6}, "rms slope"),
    ({"mean_pressure": 1e6}, "peak pressure over"),
    ({"pixel_size": 1e6}, "rms slope"),
]


@pytest.mark.errors
@pytest.mark.parametrize(("factor", "named"), UNITS)
def test_a_mistaken_unit_is_pointed_out(library, factor, named):
    """By the numbers of `press`, of the worst map."""
    h, p, size = SIX[0] * 1e-3, np.array([2e4, 1e4, 3e4]), 1e-3 / 32
    h, p, size = (
        value * factor.get(name, 1.0)
        for name, value in (("heights", h), ("mean_pressure", p), ("pixel_size", size))
    )
    with pytest.warns(ck.ValidityWarning, match=named), library.strictly():
        found = ck.press_maps(library.take(h), size, SOLID, mean_pressure=library.take(p))
    with warnings.catch_warnings(action="ignore"):
        alone = [ck.press(one, size, SOLID, float(x)).validity for one, x in zip(h, p, strict=True)]
    known = [(one.name, one.value) for each in alone for one in each if one.value is not None]
    for number in found.validity:
        expected = pytest.approx(number.value, rel=1e-4)
        assert any(name == number.name and value == expected for name, value in known), number


def test_edges_that_do_not_fit_are_pointed_out(library):
    """The ridge of a tilted map along the edges that repeat, as of `press`; not along others."""
    h = SIX[0] * 1e-3 + np.linspace(0.0, 3e-5, 32)
    for periodic in (True, "x", "y", False):
        with warnings.catch_warnings(record=True) as said, library.strictly():
            warnings.simplefilter("always")
            ck.press_maps(library.take(h), 1e-3 / 32, SOLID, mean_pressure=1e4, periodic=periodic)
        jumps = [one for one in said if "jump at the edge" in str(one.message)]
        assert len(jumps) == (periodic in (True, "x"))


def test_nothing_but_flags_reaches_the_host():
    """The arrays stay on a device that numpy cannot read, and results are on it."""
    library = strict_library()
    found, _ = pressed(library, SIX[0], SOLID, mean_pressure=1e6)
    assert str(found.pressure.device).endswith("('device1')")
    with pytest.raises(RuntimeError, match="device1"):
        np.asarray(found.pressure)


@pytest.mark.slow
def test_flags_read_each_iteration():
    """Three flags for an application at most; nothing else is read, whatever the maps."""
    library = torch_library()
    import torch
    from torch.overrides import TorchFunctionMode

    class Reads(TorchFunctionMode):
        """Counts what brings numbers to the host."""

        count = 0

        def __torch_function__(self, function, types, args=(), kwargs=None):
            name = getattr(function, "__name__", "")
            if name in {"__bool__", "__float__", "__int__", "item", "tolist", "cpu", "numpy"}:
                self.count += 1
            return function(*args, **(kwargs or {}))

    counts = []
    for maps in (SIX[0, :1], np.concatenate([SIX[0]] * 4)):
        with Reads() as reads:
            found = ck.press_maps(library.take(maps), 1.0 / 32, SOLID, mean_pressure=1e7)
        counts.append(reads.count)
        assert 0 < reads.count <= 3 * int(torch.max(found.n_applications)) + 12
    assert counts[1] <= 2 * counts[0]
