"""Flow of a film on a map: against the sparse matrix, differences, and factors."""

import numpy as np
import pytest
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import LinearOperator, gmres, spsolve
from wet_maps import CASES, disc, square, wet_map

from contactkit.errors import ConvergenceError, DescriptionError
from contactkit.lubrication.elastohydrodynamic.maps.flow import FlowSlopes, Sides
from contactkit.lubrication.elastohydrodynamic.maps.multigrid import Multigrid
from contactkit.lubrication.elastohydrodynamic.maps.wet_map import WetMap
from contactkit.lubrication.reynolds.discretisation import untied_mesh
from contactkit.lubrication.reynolds.face import face_from_level

ETA = 0.1


def film(shape, seed=1):
    """Sides of a disc or a square, with a pressure at the rim, and a rough gap and a pressure."""
    face = (disc(14, 7e-4) if shape == "disc" else square(12, 6e-4))[0]
    face.pressure[...] = 50.0
    sides, rng = Sides(face, untied_mesh(face)), np.random.default_rng(seed)
    n = sides.mesh.size
    return sides, 1e-6 * np.exp(rng.normal(0.0, 0.7, n)), 1e3 * rng.normal(size=n)


@pytest.mark.parametrize("shape", ["disc", "square"])
def test_flow_is_that_of_the_matrix(shape):
    sides, gap, pressure = film(shape)
    flow = sides.flow(gap, ETA)
    expected = sides.matrix(gap, ETA) @ (pressure - 50.0)
    assert flow.out(pressure) == pytest.approx(expected, abs=1e-13 * np.abs(expected).max())
    dissipated, inflow = flow.power(pressure)
    assert dissipated == pytest.approx(float(expected @ (pressure - 50.0)), rel=1e-12)
    assert inflow == pytest.approx(-float(flow.out(pressure).sum()), rel=1e-9)


@pytest.mark.parametrize("shape", ["disc", "square"])
def test_slopes_are_differences(shape):
    sides, gap, pressure = film(shape)
    slopes = FlowSlopes(sides.flow(gap, ETA), gap, pressure)
    _, widened, changed = film(shape, seed=2)
    step = 1e-5

    def out(at):
        return sides.flow(gap + at * widened, ETA).out(pressure + at * changed)

    expected = (out(step) - out(-step)) / (2.0 * step)
    assert slopes(changed, widened) == pytest.approx(expected, abs=1e-8 * np.abs(expected).max())


def rough_system(ny, nx, seed=1):
    """Conductances that vary by a thousand, springs, outlets at the edges, and a cavity."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:ny, :nx]
    k = np.exp(3.0 * np.sin(0.3 * x + rng.uniform(0.0, 6.0)) * np.cos(0.2 * y) + rng.normal(0, 0.3))
    along_x, along_y = (2.0 * a * b / (a + b) for a, b in ((k[:, :-1], k[:, 1:]), (k[:-1], k[1:])))
    springs, outlets = 3e-2 * np.exp(rng.normal(size=(ny, nx))), np.zeros((ny, nx))
    outlets[:, 0] += 2.0 * k[:, 0]
    outlets[0] += 2.0 * k[0]
    void = (x - 0.6 * nx) ** 2 + (y - 0.5 * ny) ** 2 < (0.15 * nx) ** 2
    for along, low, high in (
        (along_x, np.s_[:, :-1], np.s_[:, 1:]),
        (along_y, np.s_[:-1], np.s_[1:]),
    ):
        lost = np.where(void[low] | void[high], along, 0.0)
        along -= lost
        outlets[low] += lost
        outlets[high] += lost
    springs[void] = outlets[void] = 0.0
    return along_x, along_y, springs, outlets, ~void


def matrix_of(along_x, along_y, springs, outlets, full):
    cell = np.arange(full.size).reshape(full.shape)
    i = np.concatenate([cell[:, :-1].ravel(), cell[:-1].ravel()])
    j = np.concatenate([cell[:, 1:].ravel(), cell[1:].ravel()])
    c = np.concatenate([along_x.ravel(), along_y.ravel()])
    beside = coo_array((c, (i, j)), shape=(full.size, full.size)).tocsr()
    beside = beside + beside.T
    whole = diags_array((springs + outlets).ravel() + beside.sum(axis=1)) - beside
    kept = np.flatnonzero(full.ravel())
    return whole.tocsr()[kept][:, kept].tocsc(), kept


@pytest.mark.parametrize("shape", [(64, 64), (53, 101), (1, 90), (9, 7)])
def test_a_cycle_is_nearly_the_inverse(shape):
    """Iterations of GMRES, and the solution of factors; grids of odd numbers, in one row, small.

    With conductances of coarser cells twice as large it takes 10 to 12, and 9 if cells leak that
    are left out.
    """
    given = rough_system(*shape)
    matrix, kept = matrix_of(*given)
    cycle = Multigrid(*given[:4])

    def inverse(rows):
        right = np.zeros(shape, np.float32)
        right.ravel()[kept] = rows
        return cycle(right).ravel()[kept].astype(float) / cycle.unit

    right, count = np.random.default_rng(3).normal(size=len(kept)) + 1.0, []
    found, _ = gmres(
        LinearOperator(matrix.shape, lambda y: matrix @ inverse(y)),
        right,
        rtol=1e-4,
        restart=25,
        maxiter=1,
        callback=count.append,
        callback_type="pr_norm",
    )
    assert len(count) <= 7
    expected = spsolve(matrix, right)
    assert inverse(found) == pytest.approx(expected, abs=1e-3 * np.abs(expected).max())


def test_a_film_without_an_outlet_is_refused():
    none = np.zeros((4, 4))
    with pytest.raises(ConvergenceError, match="no unique pressure"):
        Multigrid(np.ones((4, 3)), np.ones((3, 4)), none, none)


def test_a_film_without_a_rim_is_refused():
    made = wet_map(CASES["rough_sphere_pull"], 12)
    level = np.ones(made.face.shape)
    level[0] = level[-1] = -1.0
    face = face_from_level(level, made.face.pixel_size, periodic=(False, True))
    with pytest.raises(DescriptionError, match="periodic"):
        WetMap(face, made.shape, ETA, made.deformation, made.drive)
