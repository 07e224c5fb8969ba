"""The page of errata: every check it names exists; effects that no page of the gallery shows."""

from __future__ import annotations

import ast
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from contactkit.elasticity.layered import compliance
from contactkit.elasticity.stress.measures import max_principal_stress, sqrt_j2, tresca, von_mises
from contactkit.gallery.chapter_3.films import PAIRS, break_gaps, volume
from contactkit.reference import hamilton, hertz

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "errata.md"


CHECKS = tomllib.loads(Path(__file__).with_name("errata_checks.toml").read_text("utf-8"))["row"]


def entries():
    """Rows of the tables whose last column is the effect."""
    is_errata, found = False, []
    for line in PAGE.read_text("utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split(" | ")]
        if not line.startswith("| "):
            is_errata = is_errata and line.startswith("|---")
        elif cells[0] in {"equation", "where"}:
            is_errata = cells[-1] == "effect [%]"
        elif is_errata:
            found.append(cells)
    return found


ENTRIES = entries()


@cache
def statements(page):
    """Those of the checks of a page of the gallery."""
    text = (PAGE.parent / page).read_text("utf-8")
    checks = text.partition("<summary>Checks")[2].partition("</details>")[0]
    return [line.split(" | ")[0] for line in checks.splitlines() if line.startswith("| ")]


@cache
def functions(file):
    tree = ast.parse((ROOT / file).read_text("utf-8"))
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def test_every_entry_has_a_check_and_an_effect():
    """In the same order; a page that shows an entry is the one that its name links to."""
    assert len(ENTRIES) > 100
    assert [row[0] for row in ENTRIES if not row[-1]] == []
    named = [
        f"[{check['of']}]({check['page']})" if "page" in check else check["of"] for check in CHECKS
    ]
    assert [row[0] for row in ENTRIES] == named


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check["of"][:40])
def test_a_check_that_is_named_is_there(check):
    if "page" in check:
        assert any(check["says"] in one for one in statements(check["page"])), check
    else:
        file, _, name = check["test"].partition("::")
        assert name in functions(file), f"{file} has no {name}"


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_friction_moves_the_surface_by_a_fraction_of_the_compliance(nu):
    """(2.34), (2.36): the part that drops out is mu (1 - 2 nu)/(2 (1 - nu)) of the rest."""
    found = compliance(2.0, [1.0], [nu], [])
    fraction = float(found.F12 / found.C)
    assert fraction == pytest.approx((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)))


def gauss_mean(n):
    """Mean of 1/alpha over the cell from -1 to 1 by a product rule of n x n points."""
    x, w = np.polynomial.legendre.leggauss(n)
    return float(w @ (1.0 / np.hypot(x[:, None], x)) @ w) / 4.0


@pytest.mark.parametrize(("n", "off"), [(4, -0.164), (8, -0.085), (64, -0.011)])
def test_gauss_points_miss_the_singularity_at_the_origin(n, off):
    exact = 2.0 * np.log(1.0 + np.sqrt(2.0))
    assert gauss_mean(n) / exact - 1.0 == pytest.approx(off, abs=0.003)


def test_a_point_and_a_patch_are_not_the_same_load():
    """Self-influence in p dx/E* from the wavenumbers that a grid has: 1.122, 0.945 and 0.817."""
    n = 1200
    x = (np.arange(n) + 0.5) / n  # of pi/dx, one quarter
    alpha = np.hypot(x[:, None], x)
    patch = np.sinc(x[:, None] / 2.0) * np.sinc(x / 2.0)
    found = [float((2.0 * weight / alpha).mean()) / np.pi for weight in (1.0, patch, patch**2)]
    np.testing.assert_allclose(found, [1.1222, 0.9447, 0.8170], atol=2e-3)


def hertz_sinks(cell, n=256, across=16):
    """Displacement under a Hertz contact on a periodic grid over the exact one; cell at alpha 0."""
    x = (np.arange(n) - n // 2) * across / n
    p = hertz.pressure(np.hypot(x[:, None], x), 1.0, 1.0)
    p *= 2.0 / 3.0 * np.pi / (p.sum() * (across / n) ** 2)
    q = 2.0 * np.pi * np.fft.fftfreq(n, across / n)
    alpha = np.hypot(q[:, None], q)
    alpha[0, 0] = 1.0
    symbol = 2.0 / alpha
    symbol[0, 0] = cell * 2.0 / (2.0 * np.pi / across) * 2.0
    u = np.fft.ifft2(np.fft.fft2(p) * symbol).real[n // 2, n // 2]
    return u / (np.pi / 2.0) - 1.0


@pytest.mark.parametrize(
    ("cell", "off"),
    [(2.0 * np.log(1.0 + np.sqrt(2.0)), -0.010), (gauss_mean(8), -0.018), (0.0, -0.10)],
)
def test_the_datum_of_a_window_of_eight_diameters(cell, off):
    assert hertz_sinks(cell) == pytest.approx(off, abs=0.004)


@pytest.mark.parametrize(("beta", "negative"), [(0.1, 0.0), (0.5, 2.4e-3), (1.0, 1.3e-2)])
def test_the_nearest_image_has_a_negative_variance(beta, negative):
    """(2.42) on a periodic window of side 1."""
    n = 256
    x = np.minimum(np.arange(n), n - np.arange(n)) / n
    spectrum = np.fft.fft2(np.exp(-2.3 * np.hypot(x[:, None], x) / beta)).real
    found = -spectrum[spectrum < 0.0].sum() / spectrum.sum()
    assert found == pytest.approx(negative, rel=0.05, abs=1e-12)


def test_a_grid_of_256_resolves_a_quarter_of_the_third_surface():
    wave = np.pi / (20.0 / 256) * 0.05 / 2.3  # highest wavenumber times decay length
    assert 1.0 - (1.0 + wave**2) ** -0.5 == pytest.approx(0.25, abs=0.005)
    assert np.exp(-2.3) == pytest.approx(0.1, rel=0.01)


@pytest.mark.parametrize(
    ("mu", "greatest", "printed"), [(0.0, 0.310, 0.214), (0.25, 0.325, 0.286), (0.5, 0.530, 0.500)]
)
def test_the_shear_of_the_source_is_not_the_greatest(mu, greatest, printed):
    x, z = np.meshgrid(np.linspace(-1.3, 1.3, 261), np.linspace(0.0, 1.2, 241))
    stress = hamilton.stress(x, np.zeros_like(x), z, 1.0, 1.0, 0.3, mu)
    assert np.abs(stress[4]).max() == pytest.approx(printed, abs=0.003)
    assert tresca(stress).max() == pytest.approx(greatest, abs=0.003)


def test_the_stress_of_the_figures_is_the_root_of_j2():
    """(A.1) on the axis under a sphere: 0.358 p0, where the stress of von Mises has 0.620."""
    z = np.linspace(0.3, 0.7, 401)
    stress = hamilton.stress(np.zeros_like(z), np.zeros_like(z), z, 1.0, 1.0, 0.3)
    assert sqrt_j2(stress).max() == pytest.approx(0.358, abs=1e-3)
    assert von_mises(stress).max() == pytest.approx(0.620, abs=1e-3)


def test_the_principal_stress_of_the_plane_is_that_of_the_tensor_at_the_surface():
    """(A.2): the same at z = 0, less below, where sxz does not vanish."""
    x = np.linspace(-1.5, 1.5, 301)
    for z, same in ((0.0, True), (0.3, False)):
        s = hamilton.stress(x, np.zeros_like(x), np.full_like(x, z), 1.0, 1.0, 0.3, 0.0)
        plane = 0.5 * (s[0] + s[1]) + np.hypot(0.5 * (s[0] - s[1]), s[3])
        off = np.abs(plane - max_principal_stress(s))[np.abs(x) > 1.0].max()
        assert (off < 1e-12) == same


def test_the_printed_radius_of_the_sphere_is_a_thousandth():
    """Fig. 2.3: 14.7 N on a rigid sphere and a half-space of G = 79.2 GPa, nu = 0.3."""
    stiff = 2.0 * 79.2e9 / (1.0 - 0.3)
    found = [(6.0 * 14.7 * stiff**2 / (np.pi**3 * r**2)) ** (1.0 / 3.0) for r in (1.37e-5, 1.37e-2)]
    np.testing.assert_allclose(found, [91.9e9, 0.919e9], rtol=1e-3)
    young = 2.0 * 79.2e9 * 1.3
    assert found[0] / young == pytest.approx(0.45, abs=0.01)


def test_the_printed_moduli_of_the_sphere_are_none():
    """Fig. 2.3: E/(2 G) - 1 is Poisson's ratio."""
    found = [e / (2.0 * g) - 1.0 for e, g in ((4.11, 100.0), (0.929, 79.2))]
    np.testing.assert_allclose(found, [-0.98, -0.99], atol=5e-3)


def test_the_two_lengths_of_the_second_surface_are_two_surfaces():
    """Fig. 2.25: slopes of the exponential autocorrelation of 0.5 and 0.05 um, waves of 156 nm."""
    top = 2.0 * np.pi / 156.25

    def slope(length):
        def spectrum(q):
            return (1.0 + (q * length / 2.3) ** 2) ** -1.5

        power = [quad(lambda q, n=n: q**n * spectrum(q), 0.0, top)[0] for n in (1, 3)]
        return np.sqrt(power[1] / power[0])

    assert slope(50.0) / slope(500.0) == pytest.approx(2.05, abs=0.01)


def test_the_separation_time_is_not_that_of_the_injector():
    """Section 3.4: 500 us at 40 mm/s; section 3.2.4: 0.1 us at some metres per second."""
    travel = 500e-6 * 40e-3
    assert travel == pytest.approx(20e-6)
    assert travel / 0.1e-6 == pytest.approx(200.0)  # m/s
    assert pytest.approx(5000.0) == 500e-6 / 0.1e-6


def test_the_height_matters_alike_for_the_break_of_every_pair():
    ratios = []
    for pair in PAIRS:
        low, high = (break_gaps(volume(h, pair), pair)[0] for h in (2e-9, 6e-9))
        ratios.append(high / low)
    np.testing.assert_allclose(ratios, 3.0 ** (1.0 / 3.0), rtol=0.02)
    assert max(ratios) / min(ratios) < 1.04


def test_a_mirror_fills_its_pitch():
    """Section 3.4: a pitch of 13 um."""
    pitch = 13.0**2  # um2
    assert 12.0**2 / pitch == pytest.approx(0.85, abs=0.01)
    assert 12.0 / pitch == pytest.approx(0.07, abs=0.005)
