"""The page in a headless browser: what it shows is what a run of the scene gives."""

from __future__ import annotations

import re
import shutil
import subprocess
import warnings
from html import unescape

import numpy as np
import pytest
from attrs import evolve
from page_scenes import film
from wasm import MISSING

import contactkit as ck
from contactkit.live_page.page import write_page

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(BROWSER is None, reason="no chromium: apt-get install chromium"),
    pytest.mark.skipif("ziglang" in MISSING, reason="ziglang not installed: contactkit[native]"),
]
FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-sync"),
    *("--disable-background-networking", "--disable-component-update", "--dump-dom"),
    "--host-resolver-rules=MAP * ~NOTFOUND",
)
# What a reader would save by the buttons, written into the page.
NAME = "film</script><b id=evil><!--<script>"  # a name that is HTML stays a name
PROBE = """<script>addEventListener("load", () => {
const wait = setInterval(() => {
  if (!document.body.dataset.ready) return;
  clearInterval(wait);
  const at = charts[0].svg.getBoundingClientRect();
  const middle = { clientX: at.left + at.width / 2 };
  if (charts[0].shown.length) charts[0].svg.dispatchEvent(new PointerEvent("pointermove", middle));
  for (const [id, text] of [["saved-toml", sceneNow()], ["saved-csv", curves()]]) {
    const pre = document.createElement("pre");
    pre.id = id, pre.textContent = text;
    document.body.append(pre);
  }
}, 20);
});</script></body>"""


def shown(page, profile, address=""):
    """The page as the browser has it once it has computed.

    Its clock may run out while a busy machine still unpacks the kernel: then it is opened again.
    """
    for budget in (5_000, 30_000, 120_000):
        flags = (*FLAGS, f"--virtual-time-budget={budget}", f"--user-data-dir={profile}")
        done = subprocess.run(
            [BROWSER, *flags, page.as_uri() + address],
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        if 'id="saved-csv"' in done.stdout:
            return done.stdout
    status = re.search(r'<p id="status".*?</p>', done.stdout)
    return pytest.fail(f"the page did not compute: {status and status[0]}")


def numbers(dom):
    pairs = re.findall(r'id="n-(\w+)" data-value="([^"]*)"', dom)
    return {name: float(value) for name, value in pairs}


def validity(dom):
    pairs = re.findall(r'data-value="([^"]*)" data-number="([^"]*)"', dom)
    return {name: float(value) for value, name in pairs}


def pre(dom, name):
    return unescape(re.search(rf'<pre id="{name}">(.*?)</pre>', dom, re.DOTALL)[1])


def simulated(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ck.simulate(ck.plan(scene))


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    scene = evolve(film(), name=NAME)
    path = write_page(scene, tmp_path_factory.mktemp("page") / "film.html")
    path.write_text(path.read_text("utf-8").replace("</body>", PROBE), "utf-8")
    return path


def assert_shows(dom, result, rtol):
    found = {name: value for name, (value, _) in result.scalars().items()}
    mine = numbers(dom)
    for name in ("release_time", "release_speed", "peak_force", "dissipated_work"):
        assert mine[name] == pytest.approx(found[name], rel=rtol), name
    known = {one.name: one.value for one in result.validity}
    for name, value in validity(dom).items():
        assert value == pytest.approx(known[name], rel=0.05), name
    assert len(validity(dom)) >= 8


def test_it_fetches_nothing(page):
    text = page.read_text("utf-8")
    assert not re.search(r"(src|href)=[\"']?(https?:)?//", text)
    assert "import(" not in text
    assert "fetch(" not in text
    assert page.stat().st_size < 500_000
    assert text.count("<!--") == text.count("<b id") == 0


def test_the_page_shows_the_run_of_its_scene(page, tmp_path):
    dom = shown(page, tmp_path)
    assert_shows(dom, simulated(film()), 1e-10)
    assert "released after 147.8 µs" in dom
    assert "validity: out of range: viscous over capillary pressure" in dom
    hovered = re.findall(r"</svg> [^<]*<b>([^<]+)</b>", dom)
    assert len(hovered) >= 4, "values under the pointer"
    rows = np.array(
        [line.split(",") for line in pre(dom, "saved-csv").splitlines()[1:]], dtype=float
    )
    assert rows[-1, 0] == pytest.approx(numbers(dom)["release_time"])
    assert rows[-1, 1] == pytest.approx(25e-6)


@pytest.mark.parametrize(
    ("address", "changed", "exact"),
    [
        (
            "#force=80&mass=0.05&temperature=313.15",
            {"force": 80.0, "mass": 0.05, "temperature": 313.15},
            1e-4,
        ),
        (
            "#volume=2.2e-10&radius=0.0026&angle=0.7",
            {"volume": 2.2e-10, "radius": 2.6e-3, "angle": 0.7},
            0.0,
        ),
    ],
    ids=["kernel and liquid", "geometry"],
)
def test_the_address_moves_the_scene(page, tmp_path, address, changed, exact):
    dom = shown(page, tmp_path, address)
    scene = film(**changed)
    stated = float(re.search(r"forces are within ([\d.e-]+)", dom)[1])
    assert_shows(dom, simulated(scene), exact or stated)
    path = tmp_path / "saved.toml"
    path.write_text(pre(dom, "saved-toml"), "utf-8")
    assert ck.load_scene(path) == evolve(scene, name=NAME)


def test_what_the_kernel_refuses_the_page_says(page, tmp_path):
    dom = shown(page, tmp_path, "#initial_gap=1.4e-5&final_gap=7e-6")
    assert re.search(
        r'id="status"[^>]*class="bad">gap at release must exceed gap at the start', dom
    )
    assert numbers(dom) == {}
