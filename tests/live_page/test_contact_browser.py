"""The page of a contact in a headless browser: what it shows is what was solved."""

from __future__ import annotations

import re

import numpy as np
import pytest
from attrs import evolve
from contact_pages import Read, ball, pre, rough, solved
from test_page_browser import BROWSER, numbers, shown

import contactkit as ck
from contactkit.live_page.page import write_page

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(BROWSER is None, reason="no chromium: apt-get install chromium"),
]
NAME = "rough</script><b id=evil><!--<script>"  # a name that is HTML stays a name
FINE = ck.Accuracy(grid=48, rtol=1e-6)
# What a reader would do and save, written into the page: a finger on the middle of the map, two
# cells to the right by the keyboard, then the files.
PROBE = """<script>addEventListener("load", () => {
const wait = setInterval(() => {
  if (!document.body.dataset.ready) return;
  clearInterval(wait);
  const note = (id, text) => {
    const pre = document.createElement("pre");
    pre.id = id, pre.textContent = text;
    document.body.append(pre);
  };
  note("opened", by("here").textContent + " | " + by("top").textContent);
  if (!location.hash.includes("y=5")) {
    const at = view.svg.getBoundingClientRect();
    const clientX = at.left + view.left + view.w / 2 + 1;
    const clientY = at.top + view.top + view.h / 2 - 1;
    view.svg.dispatchEvent(new PointerEvent("pointerdown", { clientX, clientY }));
    for (let i = 0; i < 2; i++)
      view.svg.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
  }
  const at = sectionsNow();
  note("point", [at.column, at.row, at.value].join());
  note("values", Array.from(valuesNow()).join());
  note("flags", Array.from(flagsNow()).join());
  writeAddress();
  note("address", location.hash);
  note("sections", sectionsText());
  note("loads", numbersText());
  note("saved-toml", data.scene ? sceneNow() : "");
  const middle = view.canvas.getContext("2d").getImageData(
    Math.floor(view.canvas.width / 2), Math.floor(view.canvas.height / 2), 1, 1).data;
  note("saved-csv", Array.from(middle).join());
}, 20);
});</script></body>"""


def written(scene, folder, **given):
    path = write_page(scene, folder / "contact.html", **given)
    path.write_text(path.read_text("utf-8").replace("</body>", PROBE), "utf-8")
    return path


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    scene = evolve(rough(), name=NAME)
    return written(scene, tmp_path_factory.mktemp("page"), accuracy=FINE, loads=3)


def test_it_fetches_nothing(page):
    text = page.read_text("utf-8")
    assert not re.search(r"(src|href)=[\"']?(https?:)?//", text)
    assert "fetch(" not in text
    assert page.stat().st_size < 250_000
    assert text.count("<b id") == 0


def test_it_shows_the_contact_under_its_load(page, tmp_path):
    dom, made = shown(page, tmp_path), Read(page.read_text("utf-8"))
    assert "mean pressure 200 MPa: " in dom
    for name, value in numbers(dom).items():
        assert value == made.numbers()[name], name
    values = np.array(pre(dom, "values").split(","), dtype=float).reshape(48, 48)
    right, half_a_step = made.map("pressure")
    assert values == pytest.approx(right, rel=1e-12)
    assert values == pytest.approx(np.asarray(solved(rough(), FINE).pressure), abs=half_a_step)
    bits = np.array(pre(dom, "flags").split(","), dtype=int).reshape(48, 48)
    assert ((bits & 1 == 1) == made.flags("contact")).all()
    column, row, value = (float(one) for one in pre(dom, "point").split(","))
    assert (column, row) == (26, 24), "the middle, and two cells to the right"
    assert value == values[24, 26]
    opened = pre(dom, "opened")
    assert opened.partition(" | ")[0] in opened.partition("ring: maximum ")[2]


def test_the_address_moves_load_map_and_point(page, tmp_path):
    dom = shown(page, tmp_path, "#map=gap&load=1e8&x=2.1e-6&y=5.1e-6")
    assert "mean pressure 100 MPa: " in dom
    gap = solved(rough(pressure=1e8), FINE).gap
    column, row, value = (float(one) for one in pre(dom, "point").split(","))
    assert (column, row) == (12, 30)
    step = np.ptp(gap) / 2000.0
    assert value == pytest.approx(gap[int(row), int(column)], abs=1.01 * step)
    lines = [one.split(",") for one in pre(dom, "sections").splitlines()]
    assert lines[0] == ["x [m]", "gap [m]", "y [m]", "gap [m]"]
    table = np.array(lines[1:], dtype=float)
    assert table[:, 1] == pytest.approx(gap[int(row)], abs=1.01 * step)
    assert table[:, 3] == pytest.approx(gap[:, int(column)], abs=1.01 * step)
    loads = [one.split(",") for one in pre(dom, "loads").splitlines()]
    assert loads[0][0] == "mean pressure [Pa]"
    assert [float(one[0]) for one in loads[1:]] == [5e7, 1e8, 2e8]
    path = tmp_path / "saved.toml"
    path.write_text(pre(dom, "saved-toml"), "utf-8")
    assert ck.load_scene(path) == evolve(rough(pressure=1e8), name=NAME)


def test_the_colour_of_a_cell_is_that_of_its_value(tmp_path):
    """The middle of a ball carries the maximum: the brightest colour of the scale."""
    page = written(ball(), tmp_path, accuracy=ck.Accuracy(grid=33), loads=1)
    red, green, blue, _ = (int(one) for one in pre(shown(page, tmp_path), "saved-csv").split(","))
    assert (red, green, blue) == pytest.approx((253, 231, 37), abs=8)


def test_planes_of_stress_have_a_slider(tmp_path):
    effect = ck.SubsurfaceStress(depths=(0.0, 3e-6), window=8.0)
    page = written(ball(effect), tmp_path, accuracy=ck.Accuracy(grid=32), loads=1)
    dom = shown(page, tmp_path, "#map=von_mises&plane=1&y=5")
    made = Read(page.read_text("utf-8"))
    values = np.array(pre(dom, "values").split(","), dtype=float).reshape(32, 32)
    assert values == pytest.approx(made.map("von_mises", plane=1)[0], rel=1e-12)
    assert "3 \u00b5m deep, steel" in dom
    assert "plane=1" in pre(dom, "address")
