"""Surfaces and stress in three dimensions, and the interactive look at a map."""

from __future__ import annotations

import subprocess
import sys
import warnings

import numpy as np
import pytest

import contactkit as ck
from contactkit.errors import MissingExtraError

pytest.importorskip("matplotlib")

CARBON = ck.Layer(
    material=ck.Material(name="carbon", young_modulus=140e9, poisson_ratio=0.25), thickness=50e-9
)
STACK = ck.Stack(
    layers=(CARBON,), substrate=ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
)


def contact(*effects, masked=False):
    y, x = np.mgrid[:12, :16] * 1e-7
    heights = -0.5 * ((x - 5e-7) ** 2 + (y - 4e-7) ** 2) / 2e-5
    if masked:
        heights = np.ma.masked_where((x < 1.5e-7) & (y < 1.5e-7), heights)
    lower = ck.Body(surface=ck.Heights(heights=heights, pixel_size=1e-7), solid=STACK)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=lower, upper=ck.Flat()),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=50e6),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.solve(ck.plan(scene))


@pytest.fixture(scope="module")
def stressed():
    depths = (0.0, 2e-8, 5e-8, 1e-7, 2e-7, 5e-7)
    return contact(ck.SubsurfaceStress(depths=depths, keep="planes"))


@pytest.fixture
def view3d():
    pytest.importorskip("pyvista")
    from contactkit.plot import view3d

    return view3d


def test_the_mesh_of_a_surface_has_its_pixels_in_place(stressed, view3d):
    mesh = view3d.surface_mesh(stressed, stretch=2.0)
    assert mesh.active_scalars_name == "pressure"
    points = np.asarray(mesh.points)
    # pixel (3, 5) lies where x = 5.5 and y = 3.5 pixels
    i = int(np.argmin(np.hypot(points[:, 0] - 5.5e-7, points[:, 1] - 3.5e-7)))
    assert mesh.point_data["pressure"][i] == stressed.pressure[3, 5]
    assert points[i, 2] == pytest.approx(-2.0 * stressed.gap[3, 5], abs=1e-15)
    heights = view3d.surface_mesh(stressed, "displacement", "heights")
    i = int(np.argmin(np.hypot(points[:, 0] - 2.5e-7, points[:, 1] - 9.5e-7)))
    assert heights.points[i, 2] == pytest.approx(stressed.heights[9, 2], rel=1e-6)
    assert heights.point_data["displacement"][i] == stressed.displacement[9, 2]


def test_holes_have_no_surface(view3d):
    result = contact(masked=True)
    mesh = view3d.surface_mesh(result)
    assert int(np.isnan(mesh.points[:, 2]).sum()) == int(result.holes.sum()) == 4


def test_the_grid_of_stress_has_all_planes_with_depth_downwards(stressed, view3d):
    part = stressed.of(ck.SubsurfaceStress)
    grid = view3d.stress_grid(stressed, "tresca")
    assert grid.dimensions == (16, 12, len(part.depth))
    assert np.all(np.diff(grid.z) > 0.0)
    values = np.asarray(grid.point_data["tresca"])
    top = np.asarray(grid.points)[int(values.argmax())]
    maximum = part.maxima["tresca"]
    assert values.max() == pytest.approx(maximum.value, rel=1e-9)
    assert -top[2] == pytest.approx(maximum.z, abs=1e-12)


def test_what_is_not_there_is_refused(stressed, view3d):
    with pytest.raises(ck.DescriptionError, match=r"be one of pressure, gap"):
        view3d.surface_mesh(stressed, "temperature")
    with pytest.raises(ck.DescriptionError, match="be above 0"):
        view3d.surface_mesh(stressed, stretch=0.0)
    with pytest.raises(ck.NotSimulatedError, match=r"add SubsurfaceStress"):
        contact().plot.stress_3d()
    with pytest.raises(ck.NotSimulatedError, match=r'keep="planes"'):
        contact(ck.SubsurfaceStress(depths=(0.0, 1e-7))).plot.stress_3d()
    with pytest.raises(ck.DescriptionError, match="be one of von_mises"):
        view3d.stress_grid(stressed, "mises")


def test_without_pyvista_the_extra_is_named(stressed, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(MissingExtraError, match=r"needs pyvista.*contactkit\[view3d\]"):
        stressed.plot.surface_3d()


@pytest.mark.parametrize(
    ("low", "high"), [(-141.0, 156.2), (0.000995, 7.51), (-7.4, -0.0), (0.0, 0.0)]
)
def test_steps_on_axes_in_three_dimensions_are_round(low, high, view3d):
    steps = view3d.round_steps(low, high)
    assert steps[0] <= low <= high <= steps[-1]
    assert 2 <= len(steps) <= 8
    assert all(len(f"{one:g}".strip("-").replace(".", "").strip("0")) <= 2 for one in steps)
    apart = np.diff(steps)
    assert apart.min() > 0.0
    np.testing.assert_allclose(apart, apart[0])


@pytest.mark.slow
def test_views_are_drawn_without_a_screen(stressed, view3d, tmp_path):
    """In a process of their own: a graphics library that fails ends it."""
    code = "import pyvista as pv; v = pv.Plotter(off_screen=True); v.add_mesh(pv.Cube());"
    probe = [sys.executable, "-c", f"{code} v.screenshot(r'{tmp_path / 'probe.png'}')"]
    if subprocess.run(probe, capture_output=True, check=False).returncode != 0:
        pytest.skip("VTK cannot draw off-screen on this machine: no EGL, no OSMesa")
    for name, view in (
        ("surface", stressed.plot.surface_3d(off_screen=True)),
        ("stress", stressed.plot.stress_3d(off_screen=True)),
    ):
        from PIL import Image

        path = view3d.save_view(view, tmp_path / f"{name}.png")
        with Image.open(path) as picture:
            pixels = np.asarray(picture.convert("RGB").resize((60, 40))).reshape(-1, 3)
        assert len(np.unique(pixels, axis=0)) > 30
    with pytest.raises(ck.DescriptionError, match=r"end in \.png"):
        view3d.save_view(stressed.plot.surface_3d(off_screen=True), tmp_path / "view.pdf")


@pytest.fixture
def _without_windows():
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    before = mpl.get_backend()
    plt.switch_backend("agg")
    yield
    plt.close("all")
    plt.switch_backend(before)


@pytest.mark.slow
@pytest.mark.usefixtures("_without_windows")
def test_sections_follow_the_mouse_and_a_click_holds_them(stressed):
    from matplotlib.backend_bases import MouseEvent

    look = stressed.plot.explore()
    assert stressed.pressure[look.row, look.column] == stressed.max_pressure

    def mouse(name, row, column):
        ax = look.figure.axes[0]
        place = ax.transData.transform(((column + 0.5) * 0.1, (row + 0.5) * 0.1))  # [µm]
        look.figure.canvas.callbacks.process(name, MouseEvent(name, look.figure.canvas, *place))

    look.figure.canvas.draw()
    mouse("motion_notify_event", 3, 5)
    assert (look.row, look.column) == (3, 5)
    shown = look.figure.axes[1].get_lines()[0].get_ydata()
    np.testing.assert_allclose(
        shown / shown.max(), stressed.pressure[3] / stressed.pressure[3].max()
    )
    mouse("button_press_event", 3, 5)
    mouse("motion_notify_event", 8, 2)
    assert (look.row, look.column) == (3, 5)
    mouse("button_press_event", 8, 2)
    assert (look.row, look.column) == (8, 2)


@pytest.mark.slow
@pytest.mark.usefixtures("_without_windows")
def test_a_slider_goes_through_the_planes_of_stress(stressed):
    look = stressed.plot.explore(measure="von_mises")
    look.slider.set_val(2)
    image = look.figure.axes[0].images[0].get_array()
    ratio = image.max() / look._maps[2].max()
    assert ratio == pytest.approx(1.0)
    assert look.slider.valtext.get_text() == "50 nm"
    value = image[look.row, look.column]
    assert look.figure.axes[0].get_title(loc="left").startswith(f"{value:.4g} MPa at x = ")
    assert look.figure.axes[0].get_title(loc="left").endswith(" µm, 50 nm deep")
    assert stressed.plot.explore("gap").slider is None
    with pytest.raises(ck.DescriptionError, match="be one of pressure"):
        stressed.plot.explore("temperature")
    with pytest.raises(ck.NotSimulatedError, match="add SubsurfaceStress"):
        contact().plot.explore(measure="von_mises")
