"""The site: live pages, cards of an index, and figures by panel.

Needs the extra ``docs``; CI builds the whole site strictly besides (`make docs`).
"""

import importlib.util
import re
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace

import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.live_page.scene import check_scene

pytest.importorskip("mkdocs")
ImageDraw = pytest.importorskip("PIL.ImageDraw")
Image = pytest.importorskip("PIL.Image")

ROOT = Path(__file__).parents[2]
DOCS, SCRIPTS = ROOT / "docs", ROOT / "docs" / "scripts"
SCENES = sorted((DOCS / "live").glob("*.toml"))


@pytest.fixture(scope="module")
def script():
    """A script of docs/scripts/, imported as mkdocs does."""
    sys.path.insert(0, str(SCRIPTS))

    def load(name):
        spec = importlib.util.spec_from_file_location(name, SCRIPTS / f"{name}.py")
        module = sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    yield load
    sys.path.remove(str(SCRIPTS))


def page_of(source, url):
    return SimpleNamespace(
        file=SimpleNamespace(src_uri=source, dest_uri=f"{url}index.html"), url=url
    )


def test_a_link_to_a_scene_becomes_its_live_page(script):
    page = page_of("physics/viscous.md", "physics/viscous/")
    shown = script("site_live").on_page_markdown(
        "before\n\n[Live: a <film>](../live/oil-film.toml)\n\nsee [it](../live/oil-film.toml).",
        page,
    )
    assert '<iframe src="../../live/oil-film.html" title="Live: a &lt;film&gt;"' in shown
    assert 'href="../../live/oil-film.toml" download' in shown
    assert shown.endswith("see [it](../live/oil-film.toml)."), "a link in a sentence stays one"


def test_scenes_outside_the_docs_get_their_place_in_the_site(script):
    page = page_of("injector.md", "injector/")
    shown = script("site_live").on_page_markdown("[It](../models/a/fuel_injector.toml)", page)
    assert '<iframe src="../live/fuel-injector.html"' in shown


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_each_scene_of_a_live_page_is_one_and_is_shown(script, path):
    scene = open_scene(path).scene
    assert scene.name
    if isinstance(scene, ck.SeparationScene):
        check_scene(scene)
    assert path in script("site_live").shown()


@pytest.mark.slow
def test_a_scene_that_has_no_page_ends_the_build_with_the_reason(script, tmp_path, monkeypatch):
    live = script("site_live")
    monkeypatch.setattr(live, "KEPT", tmp_path / "kept")
    scene = tmp_path / "sliding.toml"
    scene.write_text((ROOT / "contactkit/data/templates/sliding.toml").read_text("utf-8"), "utf-8")
    with pytest.raises(live.PluginError, match=r"no live page of sliding.toml: .*\w{4}"):
        live.built(scene)
    assert not any((tmp_path / "kept").glob("*.html"))


def test_the_answers_beside_live_pages_are_those_of_their_scenes():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        sphere, film = (
            ck.simulate(ck.plan(ck.load_scene(DOCS / "live" / f"{name}.toml")))
            for name in ("humid-sphere", "spool")
        )
    started = (DOCS / "getting-started.md").read_text("utf-8")
    force = re.search(r"prints `([\d.]+) uN`", started)[1]
    assert 1e6 * sphere["meniscus_force"][0] == pytest.approx(float(force), abs=0.005)
    home = (DOCS / "index.md").read_text("utf-8")
    time, peak = re.search(r"free after ([\d.]+) ms, .* at most ([\d.]+) N", home).groups()
    assert 1e3 * film.state.release_time == pytest.approx(float(time), abs=5e-4)
    assert film.state.peak_force == pytest.approx(float(peak), abs=0.05)


def drawn(path, *, frames, bars=(), words=()):
    """A picture with frames, colour bars and words, which are dark rectangles."""
    image = Image.new("RGB", (1200, 600), "white")
    draw = ImageDraw.Draw(image)
    for box in (*frames, *bars):
        draw.rectangle(box, outline="black")
    for box in words:
        draw.rectangle(box, fill="#444")
    image.save(path)
    return path


# Two panels with labels at their left; the first has a colour bar beside it.
TWO = {
    "frames": [(100, 50, 420, 450), (700, 50, 1150, 450)],
    "bars": [(430, 50, 450, 450)],
    "words": [(20, 200, 40, 300), (460, 60, 480, 80), (620, 200, 640, 300), (300, 470, 340, 490)],
}


def test_panels_are_cut_between_their_frames(script, tmp_path):
    panels = script("site_panels").panels
    size, found = panels(drawn(tmp_path / "two.png", **TWO))
    assert size == (1200, 600)
    assert [(box.top, box.bottom) for box in found] == [(0, 600)] * 2
    assert found[0].left == 0
    assert 480 < found[0].right == found[1].left < 620, "colour bar left, label right of the cut"
    assert found[1].right == 1200


def test_a_legend_of_all_panels_is_a_strip_of_its_own(script, tmp_path):
    words = [*TWO["words"], (300, 540, 900, 560)]
    _, found = script("site_panels").panels(drawn(tmp_path / "two.png", **TWO | {"words": words}))
    assert len(found) == 3
    assert (found[2].left, found[2].right, found[2].bottom) == (0, 1200, 600)
    assert 490 < found[0].bottom == found[1].bottom == found[2].top < 540


@pytest.mark.parametrize(
    "changed",
    [
        {"frames": TWO["frames"][:1]},
        {"words": [(300, 200, 900, 300)]},  # ink from one frame into the other
        {"frames": [(60, 50, 180, 450), (240, 50, 1150, 450)], "bars": [], "words": []},
    ],
    ids=["one", "joined", "narrow"],
)
def test_what_cannot_be_cut_stays_whole(script, tmp_path, changed):
    _, found = script("site_panels").panels(drawn(tmp_path / "one.png", **TWO | changed))
    assert found == []


def test_an_index_has_cards_where_its_pages_have_figures(script, tmp_path, monkeypatch):
    figures = script("site_figures")
    monkeypatch.setattr(figures, "DOCS", tmp_path)
    folder = tmp_path / "gallery"
    folder.mkdir()
    for name in ("a", "b", "c"):
        (folder / f"{name}.md").write_text(f"# {name}\n\n![what](../{name}.png)\n", "utf-8")
    drawn(tmp_path / "a.png", **TWO)
    drawn(tmp_path / "b.png", **TWO)
    table = "| page | shows |\n|---|---|\n" + "".join(
        f"| [{n}]({n}.md) | {n}{n}. |\n" for n in "abc"
    )
    index = page_of("gallery/index.md", "gallery/")
    shown = figures.on_page_markdown(f"# All\n\n{table}\nend\n", index)
    assert "- [![](../thumbnails/gallery/a.png) **a**](a.md) aa." in shown
    assert "- [**c**](c.md) cc." in shown
    (tmp_path / "b.png").unlink()
    assert figures.on_page_markdown(table, index) == table, "one figure of three: words"


def test_figures_open_large_and_have_their_panels(script, tmp_path, monkeypatch):
    figures = script("site_figures")
    monkeypatch.setattr(figures, "DOCS", tmp_path)
    (tmp_path / "img").mkdir()
    drawn(tmp_path / "img" / "two.png", **TWO)
    page = page_of("films.md", "films/")
    html = '<p><img alt="a &quot;b&quot;" src="../img/two.png" /> to 1e-04, <td>rtol 1e-02</td></p>'
    shown = figures.on_page_content(html, page)
    assert '<a class="figure cut" href="../img/two.png"' in shown
    assert shown.count("<img") == 3
    widths = [float(w) for w in re.findall(r'"width: ([\d.]+)%', shown)]
    assert sum(100 / w for w in widths) == pytest.approx(1.0, abs=1e-4), "panels share the width"
    assert '<span class="whole-number">1e-04</span>' in shown
    assert '<span class="whole-number">rtol 1e-02</span>' in shown
