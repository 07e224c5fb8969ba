"""The site: its navigation, pages made of other files, signatures and equations of docstrings.

Needs the extra ``docs``; CI builds the whole site strictly besides (`make docs`).
"""

import importlib.util
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import contactkit as ck

pytest.importorskip("griffe")
pytest.importorskip("mkdocs")

ROOT = Path(__file__).parents[2]
SCRIPTS = ROOT / "docs" / "scripts"


@pytest.fixture(scope="module")
def script():
    """A script of docs/scripts/, imported as mkdocs does."""
    sys.path.insert(0, str(SCRIPTS))

    def load(name):
        spec = importlib.util.spec_from_file_location(f"docs_{name}", SCRIPTS / f"{name}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    yield load
    sys.path.remove(str(SCRIPTS))


def test_pages_of_a_folder_follow_the_links_of_its_index(script, tmp_path):
    for name in ("c", "a", "b", "index"):
        (tmp_path / "how-to").mkdir(exist_ok=True)
        (tmp_path / "how-to" / f"{name}.md").write_text("# ?")
    (tmp_path / "how-to" / "index.md").write_text("first [b](b.md), then [a](a.md#there)")
    nav = [{"Home": "index.md"}, {"How-to": "how-to/*.md"}, {"Empty": "none/*.md"}]
    assert script("site_pages").expanded(nav, tmp_path) == [
        {"Home": "index.md"},
        {"How-to": [f"how-to/{name}.md" for name in ("index", "b", "a", "c")]},
    ]


def test_links_of_the_changelog_are_seen_from_its_page(script):
    page = script("site_pages").repository_page("CHANGELOG.md")
    assert "](../errata.md)" in page
    assert "](docs/" not in page


def test_pages_that_words_lead_to_are_there(script):
    site = script("site_pages")
    made = set(site.REPOSITORY.values())
    assert [page for page in site.WORDS if not (ROOT / "docs" / page).exists()] == [
        page for page in site.WORDS if page in made
    ]
    words = " ".join(site.WORDS.values()).split()
    assert len(words) == len(set(words)), "a word leads to one page"


def test_every_public_name_has_a_page(script):
    api = script("api_pages")
    shown = [name for names in api.public_names().values() for name in names]
    assert sorted(shown) == sorted(ck._HOMES)
    for topic, names in api.public_names().items():
        page = api.pages()[f"api/{topic}.md"]
        assert all(f"::: contactkit.{name}\n" in page for name in names)
    with pytest.raises(LookupError, match=r"no topic .* nowhere"):
        api.topic_of("nowhere.module")


def test_what_the_api_lists_is_there(script):
    api = script("api_pages")
    for topic in api.TOPICS:
        for path in topic.more:
            module, _, name = path.rpartition(".")
            assert callable(getattr(importlib.import_module(f"contactkit.{module}"), name)), path
    shown = {name: getattr(ck, name) for name in api.MEMBERS if name in ck._HOMES}
    assert set(api.MEMBERS) - set(shown) == {"GridFilmState"}
    for name, members in api.MEMBERS.items():
        kind = shown.get(name)
        assert [one for one in members if kind and not hasattr(kind, one)] == [], name


def test_an_entry_of_the_api_opens_from_its_sentence(script):
    entry = (
        '<div class="doc doc-object doc-function">\n<h2 id="{0}">{0}</h2><div>{0}(a)</div>'
        '<div class="doc doc-contents first"><p>Does {0}.</p><div>more</div></div></div>\n'
    )
    page = script("api_pages").folded("<h1>Files</h1>" + entry.format("f") + entry.format("g"))
    for name in "fg":
        assert f"</h2><details><summary>Does {name}.</summary><div>{name}(a)</div>" in page
    assert page.count("</details></div>") == page.count("<details>") == 2
    assert page.startswith("<h1>Files</h1><div")


def test_signatures_have_the_defaults_of_attrs(script):
    found = script("docstrings").constructor(ck.Meniscus)
    assert found["liquid"].default is None
    assert found["relative_humidity"].default == "None"
    assert found["contact_angle_lower"].default == "0.0"
    assert found["contact_angle_lower"].annotation == "float"
    assert found["liquid"].kind.value == "keyword-only"
    assert script("docstrings").constructor(ck.Interface)["lower"].default == "Body()"


def test_equations_of_docstrings_are_those_of_markdown(script):
    text = "At ``h`` it is :math:`h^{-3}`:\n\n.. math::\n    F = \\eta\n        v\n\nMore.\n"
    assert script("docstrings").in_markdown(text) == (
        "At `h` it is $h^{-3}$:\n\n$$\nF = \\eta v\n$$\n\nMore.\n"
    )


def test_tables_of_docstrings_are_those_of_markdown(script):
    text = "===  ======\na    b\n===  ======\nh    gap of\n     faces\nr    radius\n===  ======"
    assert script("docstrings").in_markdown(text) == (
        "| a | b |\n| --- | --- |\n| h | gap of faces |\n| r | radius |"
    )


CODE = re.compile(r"^( *)```.*?^\1```|`[^`\n]+`|^(?: *>>>| *\.\.\. ).*$", re.MULTILINE | re.DOTALL)
FORMULA = re.compile(r"\$\$(.+?)\$\$|(?<![\\$])\$(?=\S)([^$\n]+?)(?<=\S)\$", re.DOTALL)
READ = """
const katex = require(process.argv[1]);
const formulas = JSON.parse(require("fs").readFileSync(0));
for (const formula of formulas)
  try { katex.renderToString(formula, {displayMode: true, strict: "ignore"}); }
  catch (error) { console.log(formula + ": " + error.message); }
"""


@pytest.mark.skipif(shutil.which("node") is None, reason="needs node to run KaTeX")
def test_katex_reads_every_formula(script):
    in_markdown = script("docstrings").in_markdown
    texts = [path.read_text("utf-8") for path in (ROOT / "docs").rglob("*.md")]
    for folder in ("contactkit", "fmu", "models"):
        for path in (ROOT / folder).rglob("*.py"):
            texts += [in_markdown(text) for text in path.read_text("utf-8").split('"""')[1::2]]
    found = {a or b for text in texts for a, b in FORMULA.findall(CODE.sub("", text))}
    assert len(found) > 300
    katex = ROOT / "docs" / "assets" / "katex" / "katex.min.js"
    done = subprocess.run(
        ["node", "-e", READ, str(katex)],
        input=json.dumps(sorted(found)),
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == ""
