"""The page in a headless browser: what it shows is what a run of the scene gives."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
import warnings
from functools import partial
from html import unescape

import numpy as np
import pytest
from attrs import evolve
from page_scenes import film
from wasm import MISSING

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.live_page import mirror_page
from contactkit.live_page.page import write_page
from contactkit.models.injector.delays import (
    closing_delay,
    closing_lag,
    delay,
    residual_gap,
    sticking_time,
)
from contactkit.models.library import bundled_device
from contactkit.models.micromirror.release import humidity_limit, landing, release, smallest_reset
from contactkit.models.micromirror.tip_film import adhesion, tip_law

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
  if (view.settled && shown.rows.length && !document.body.dataset.swept) return;
  const at = charts[0].svg.getBoundingClientRect();
  const middle = { clientX: at.left + at.width / 2 };
  if (charts[0].shown.length) charts[0].svg.dispatchEvent(new PointerEvent("pointermove", middle));
  clearInterval(wait);
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


SAVE_FMU = """<script>function fmuSaved() {
  let saved = "";
  const was = save, hex = (byte) => byte.toString(16).padStart(2, "0");
  save = (name, content) => { saved = `${name} ${Array.from(content, hex).join("")}`; };
  document.querySelector("#fmus button").click();
  save = was;
  return saved;
}
"""


def test_the_fmu_in_a_page_is_that_of_the_scene(tmp_path, monkeypatch):
    """As built for this computer; the button saves the bytes of `build_native`."""
    here = partial(build_native, platforms=[local()])
    monkeypatch.setattr("contactkit.live_page.fmu_files.build_native", here)
    scene = film(volume=None, cavity=False)  # no tables over a grid but of the radius
    scene = evolve(scene, effects=(ck.ViscousForce(),))
    page = write_page(scene, tmp_path / "film.html", fmu=True)
    probe = PROBE.replace("curves()]]", "curves()], ['saved-fmu', fmuSaved()]]").replace(
        "<script>", SAVE_FMU, 1
    )
    page.write_text(page.read_text("utf-8").replace("</body>", probe), "utf-8")
    name, content = pre(shown(page, tmp_path), "saved-fmu").split()
    assert name == "film-of-a-page.fmu"
    assert bytes.fromhex(content) == here(scene, tmp_path / "own.fmu").read_bytes()


@pytest.fixture(scope="module")
def injector(tmp_path_factory):
    path = write_page(bundled_device("fuel-injector"), tmp_path_factory.mktemp("page") / "v.html")
    path.write_text(path.read_text("utf-8").replace("</body>", PROBE), "utf-8")
    return path


def test_the_page_of_an_injector_shows_its_delays(injector, tmp_path):
    scene = bundled_device("fuel-injector")
    dom = shown(injector, tmp_path)
    mine = numbers(dom)
    assert mine["release_delay"] == pytest.approx(delay(scene, scene.temperature), rel=1e-4)
    assert mine["sticking_time"] == pytest.approx(sticking_time(scene), rel=1e-3)
    assert mine["closing_delay"] == pytest.approx(closing_delay(scene), abs=2e-6)
    assert mine["closing_lag"] == pytest.approx(closing_lag(scene), abs=5e-7)  # 4 us
    assert mine["residual_gap"] == pytest.approx(residual_gap(scene), rel=3e-3)
    # At the flip the drop in the cavity holds the pull for the whole pulse, and a little below not.
    flip = mine["flip_pressure"] * 1e5
    assert math.isnan(delay(scene, scene.temperature, ambient_pressure=1.005 * flip))
    assert delay(scene, scene.temperature, ambient_pressure=0.995 * flip) > 2e-3
    assert dom.count('class="chart"') == 6


def test_the_address_moves_the_injector_and_its_file(injector, tmp_path):
    address = "#ambient=1200000&tension=600000&cavity=-200000&temperature=353.15"
    dom = shown(injector, tmp_path, address + "&radius=0.0029&coil_turns=42&initial_gap=0.000004")
    path = tmp_path / "saved.toml"
    path.write_text(pre(dom, "saved-toml"), "utf-8")
    scene = open_scene(str(path)).scene
    limit = scene.tension_limit
    assert (limit.ambient_pressure, limit.tension) == (1.2e6, 1.8e6)
    assert limit.pressure_in_cavity == pytest.approx(-2e5)
    assert scene.interface.rim_radius == 0.0029
    assert (scene.valve.coil.turns, scene.loading.final_gap) == (42, pytest.approx(22e-6))
    found = numbers(dom)["release_delay"]
    assert found == pytest.approx(delay(scene, scene.temperature), rel=1e-4)


def test_an_injector_that_never_opens(injector, tmp_path):
    dom = shown(injector, tmp_path, "#ambient=2000000")
    assert "never opens within the pulse of 4 ms: the film holds it" in dom
    assert math.isnan(numbers(dom)["release_delay"])
    assert numbers(dom)["dry_release_delay"] > 0.0


@pytest.fixture(scope="module")
def micromirror(tmp_path_factory):
    """The page with humidity and gap on its grid: four quantities take 15 s."""
    with pytest.MonkeyPatch.context() as patch:
        whole = mirror_page._grid
        patch.setattr(
            mirror_page,
            "_grid",
            lambda scene: tuple(one for one in whole(scene) if one.name in ("humidity", "gap")),
        )
        scene = bundled_device("micromirror")
        path = write_page(scene, tmp_path_factory.mktemp("page") / "m.html")
    path.write_text(path.read_text("utf-8").replace("</body>", PROBE), "utf-8")
    return path


def test_the_page_of_a_micromirror_shows_its_release(micromirror, tmp_path):
    scene = bundled_device("micromirror")
    dom = shown(micromirror, tmp_path)
    mine, law = numbers(dom), tip_law(scene.tip, 0.5)
    assert mine["free_time"] == pytest.approx(release(scene, law, 34.0), rel=1e-9)
    assert mine["alone_time"] == pytest.approx(release(scene, law, None), rel=1e-9)
    assert mine["smallest_pulse"] == pytest.approx(smallest_reset(scene, law).voltage, abs=0.06)
    assert mine["humidity_limit"] == pytest.approx(100.0 * humidity_limit(scene), abs=0.7)
    held = adhesion(scene.tip, 0.5)
    assert mine["meniscus_force"] == pytest.approx(2.0 * held.meniscus_force, rel=1e-6)
    assert mine["van_der_waals_force"] == pytest.approx(2.0 * held.solid_force, rel=1e-6)
    assert mine["preload"] == pytest.approx(landing(scene).preload, rel=1e-6)
    assert validity(dom)["Kelvin radius [m]"] == pytest.approx(held.kelvin_radius, rel=1e-6)
    assert "validity: out of range: Kelvin radius" in dom


def test_the_address_moves_the_micromirror_and_its_file(micromirror, tmp_path):
    moved = "#humidity=0.65&gap=3.5e-10&loading_stiffness=1.3&electrode_gap=0.00000155&reset=29"
    dom = shown(micromirror, tmp_path, moved)
    path = tmp_path / "saved.toml"
    path.write_text(pre(dom, "saved-toml"), "utf-8")
    scene = open_scene(str(path)).scene
    assert (scene.study.humidity, scene.loading.rest_gap) == (0.65, 3.5e-10)
    assert scene.mirror.waveform.reset_voltage == -29.0
    law = tip_law(scene.tip, 0.65)
    mine = numbers(dom)
    expected = release(scene, law, 29.0)
    assert mine["free_time"] == pytest.approx(expected, rel=1e-9, nan_ok=True)
    assert mine["smallest_pulse"] == pytest.approx(smallest_reset(scene, law).voltage, abs=0.2)
    assert mine["adhesion"] == pytest.approx(2.0 * adhesion(scene.tip, 0.65).force, rel=5e-3)
