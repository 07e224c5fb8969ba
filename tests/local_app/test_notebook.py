"""The app as a program, for both halves, and its server on this machine."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import urllib.error
import urllib.request

import pytest

from contactkit.errors import MissingExtraError
from contactkit.local_app.desk import Desk
from contactkit.local_app.form import EFFECTS

# marimo and a server: seconds each.
pytestmark = pytest.mark.slow

REASON = "marimo is not installed: pip install contactkit[app]"


@pytest.fixture
def run():
    """Run the cells with some names set, as widgets would set them; return all names."""
    pytest.importorskip("marimo", reason=REASON)
    from contactkit.local_app.notebook import app

    def with_names(half, **names):
        desk = Desk.new()
        given = {"start": desk.begin(half), "kept": {}, **names}
        _, found = app.run(defs=given)
        desk.close()
        return found

    return with_names


def html(element):
    return element.text


def test_a_film_runs_as_it_is_and_with_other_choices(run):
    first = run("separation")
    assert first["answer"].result.status == "released"
    assert first["sliders"]
    values = {
        "interface.lower.surface.radius": "3.175 mm",
        "interface.upper.surface.radius": "3.175 mm",
        "interface.meniscus.volume": "0.16 mm3",
        "effects.tension-limit.strength": "10 bar",
    }
    chosen = {path: choice for path, choice in first["chosen"].items() if path != EFFECTS}
    chosen[EFFECTS] = ("meniscus-force", "viscous-force", "tension-limit")
    found = run("separation", chosen=chosen, values=values)
    assert found["answer"].result.state.release_time == pytest.approx(0.147849e-3, rel=1e-5)


def test_a_contact_is_solved_when_it_is_asked_for(run):
    chosen = {
        "interface.lower.surface": "flat",
        "interface.lower.solid": "bearing-steel",
        "interface.lower.solid.layers.0": "none",
        "interface.upper.surface": "paraboloid",
        "loading": "pressing",
        EFFECTS: (),
    }
    values = {
        "interface.upper.surface.radius": "1 mm",
        "window.width": "30 um",
        "window.periodic": "no",
        "loading.pressure": "",
        "loading.force": "0.2 N",
        "accuracy.grid": "96",
    }
    asked = {"chosen": chosen, "values": values}
    assert "answer" not in run("contact", **asked)  # nothing is computed by itself
    found = run("contact", **asked, is_asked=True, is_curve_asked=True)
    assert found["problems"] == {}
    modulus = 210e9 / (1.0 - 0.3**2)
    hertz = (6.0 * 0.2 * modulus**2 / (3.141592653589793**3 * 1e-3**2)) ** (1 / 3)
    assert found["answer"].result.max_pressure == pytest.approx(hertz, rel=3e-3)
    assert len(found["curve"].result.area) == 4


def test_mistakes_are_shown_and_nothing_is_solved(run):
    found = run("contact", values={"loading.pressure": "twenty"}, is_asked=True)
    assert list(found["problems"]) == ["loading.pressure"]
    assert "answer" not in found


def test_the_layout_shows_messages_numbers_and_downloads(run):
    from contactkit.local_app import layout

    found = run("separation")
    broken = layout.form(
        found["start"],
        found["picks"],
        found["parts"],
        found["fields"],
        {"loading.stiffness": ["it < must be stiff"], "": ["and the whole"]},
    )
    assert "it &lt; must be stiff" in html(broken)
    assert "and the whole" in html(broken)
    shown = html(layout.answer(found["answer"], found["shown"]))
    assert "released after" in shown
    assert "OUT OF RANGE" in shown
    assert html(layout.downloads(found["made"], found["answer"])).count("<marimo-download") == 3


@pytest.fixture
def server():
    pytest.importorskip("marimo", reason=REASON)
    words = [sys.executable, "-m", "contactkit", "app", "--no-browser"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        address = process.stdout.readline().strip()
        assert address.startswith("http://127.0.0.1:"), process.stderr.read()
        yield process, address
    finally:
        process.kill()
        process.communicate()


def ask(address, **headers):
    """Status, address at the end and headers of an answer."""
    request = urllib.request.Request(address, headers=headers)
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}), Cookies)
    try:
        with opener.open(request, timeout=30) as answer:
            return answer.status, answer.url, answer.headers
    except urllib.error.HTTPError as error:
        return error.code, error.url, error.headers


Cookies = urllib.request.HTTPCookieProcessor


def test_the_server_answers_this_machine_with_its_token_only(server):
    process, address = server
    status, url, headers = ask(address)
    assert status == 200
    assert "login" not in url
    assert "default-src 'self'" in headers["content-security-policy"]
    bare = address.partition("?")[0]
    assert "login" in ask(bare)[1]
    assert "login" in ask(f"{bare}?access_token=guess")[1]
    assert ask(address, Host="example.org")[0] == 421
    assert ask(address, Origin="http://example.org")[0] == 421
    port = re.search(r":(\d+)/", address)[1]
    taken = subprocess.run(
        [sys.executable, "-m", "contactkit", "app", "--no-browser", "--port", port],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert taken.returncode == 2
    assert "--port must be a free port" in taken.stderr
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out.splitlines()[-1]) == (0, "closed")
    assert "Traceback" not in err


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_it_ends_while_a_page_has_a_session():
    """Also where SIGINT was ignored at the start, as by a shell in the background."""
    pytest.importorskip("marimo", reason=REASON)
    from websockets.sync.client import connect

    words = [sys.executable, "-m", "contactkit", "app", "--no-browser"]
    process = subprocess.Popen(
        words,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),
    )
    try:
        address = process.stdout.readline().strip()
        host, token = re.search(r"http://([^/]*)/\?access_token=(.*)", address).groups()
        page = f"ws://{host}/ws?session_id=s_abcdef&access_token={token}"
        with connect(page, proxy=None, open_timeout=30) as opened:
            assert any("completed-run" in str(opened.recv(timeout=60)) for _ in range(300))
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=30) == 0
    finally:
        process.kill()
        process.communicate()


def test_without_marimo_the_extra_is_named(monkeypatch):
    from contactkit.local_app import server

    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with (
        pytest.raises(MissingExtraError, match=r"pip install contactkit\[app\]"),
        server.local_server(),
    ):
        pass
