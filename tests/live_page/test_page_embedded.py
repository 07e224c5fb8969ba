"""A live page inside another one: it says how tall it is, and what is moved."""

from __future__ import annotations

import json
import re
import subprocess
from html import unescape
from pathlib import Path

import pytest
from test_page_browser import BROWSER, FLAGS, pytestmark  # noqa: F401

import contactkit as ck
from contactkit.live_page.page import write_page

SPOOL = Path(__file__).parents[2] / "docs" / "live" / "spool.toml"
HOST = """<!doctype html><body><iframe src="film.html#force=60" style="width: {}px"></iframe>
<script>addEventListener("message", ({{ source, data }}) => {{
  if (source === document.querySelector("iframe").contentWindow)
    document.body.dataset.got = JSON.stringify(data);
}});</script></body>"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("embedded")
    write_page(ck.load_scene(SPOOL), folder / "film.html")
    return folder


def dom(page, profile, wanted):
    """The page once it has what is wanted; the browser's clock may run out before."""
    for budget in (5_000, 30_000, 120_000, 30_000):
        flags = (*FLAGS, f"--virtual-time-budget={budget}", f"--user-data-dir={profile}")
        done = subprocess.run(
            [BROWSER, *flags, page.as_uri()],
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        if found := re.search(wanted, done.stdout):
            return found
    return pytest.fail(f"not found: {wanted}")


def received(folder, profile, width):
    host = folder / f"host-{width}.html"
    host.write_text(HOST.format(width), "utf-8")
    return json.loads(unescape(dom(host, profile, r'data-got="([^"]*)"')[1]))


def test_the_outer_page_hears_height_and_what_is_moved(folder, tmp_path):
    wide, narrow = received(folder, tmp_path, 800), received(folder, tmp_path, 350)
    assert wide["hash"] == narrow["hash"] == "#force=60"
    # One curve and the sliders in a column; a page alone has five times that.
    assert 500 < narrow["height"] < 1200
    assert 350 < wide["height"] < narrow["height"]


def test_a_page_alone_is_whole(folder, tmp_path):
    html = dom(folder / "film.html", tmp_path, r'<html[^>]*>(?s:.*)data-ready="yes"')[0]
    assert "embedded" not in html[: html.index(">")]
