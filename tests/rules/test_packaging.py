"""What is shipped: the wheel holds every package and data file, the sdist the repository."""

import importlib.util
import json
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

import contactkit

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
spec = importlib.util.spec_from_file_location("setup_of_contactkit", ROOT / "setup.py")
setup = importlib.util.module_from_spec(spec)
spec.loader.exec_module(setup)
DATA = (".toml", ".json", ".c", ".h", ".html", ".css", ".js", ".png", ".svg", ".typed")


def folder_of(package):
    """Folder of a package in the repository."""
    parent = max((p for p in setup.FOLDERS if f"{package}.".startswith(f"{p}.")), key=len)
    return ROOT / setup.FOLDERS[parent] / package.removeprefix(parent).lstrip(".").replace(".", "/")


def shipped():
    """Files of the packages by their paths in a wheel."""
    return {
        f"{package.replace('.', '/')}/{path.name}"
        for package in setup.packages()
        for path in folder_of(package).iterdir()
        if path.suffix in (".py", *DATA)
    }


def test_every_folder_of_python_files_is_a_package():
    found = {p.parent for top in setup.FOLDERS.values() for p in (ROOT / top).rglob("*.py")}
    assert found == {folder_of(p) for p in setup.packages()}


def test_there_is_one_version():
    version = PROJECT["project"]["version"]
    assert contactkit.__version__ == version
    for name in (".zenodo.json", "codemeta.json"):
        assert json.loads((ROOT / name).read_text("utf-8"))["version"] == version
    for name, pattern in (
        ("CITATION.cff", r"^version: (.*)$"),
        ("conda-recipe/recipe.yaml", r'^  version: "(.*)"$'),
    ):
        assert re.search(pattern, (ROOT / name).read_text("utf-8"), re.M)[1] == version


def test_metadata_of_archives_and_of_the_index_agree():
    project, citation = PROJECT["project"], (ROOT / "CITATION.cff").read_text("utf-8")
    archive = json.loads((ROOT / ".zenodo.json").read_text("utf-8"))
    code = json.loads((ROOT / "codemeta.json").read_text("utf-8"))
    cited = citation.partition("keywords:\n")[2].replace("  - ", "").split("\n")
    assert project["keywords"] == archive["keywords"] == code["keywords"] == cited[:-1]
    authors = [one["name"] for one in project["authors"]]
    assert authors == [one["name"] for one in archive["creators"]]
    assert authors == [one["name"] for one in code["author"]]
    assert authors == re.findall(r'- name: "(.*)"', citation)
    assert archive["license"] == project["license"] == code["license"].rpartition("/")[2]
    assert re.search(r"^license: (.*)$", citation, re.M)[1] == project["license"]
    assert archive["description"] == code["description"]
    abstract = citation.partition("abstract: >-\n")[2].partition("\ntype:")[0]
    assert " ".join(abstract.split()) == archive["description"]
    assert code["runtimePlatform"] == f"Python {project['requires-python']}"
    assert code["codeRepository"] == project["urls"]["Homepage"]


def test_conda_needs_what_pip_needs():
    recipe = (ROOT / "conda-recipe/recipe.yaml").read_text("utf-8")
    run = re.findall(r"^    - (.*)$", recipe.partition("  run:\n")[2].partition("\n\n")[0], re.M)
    pinned = {one.replace(" ", "") for one in run}
    needed = {one.replace(" ", "") for one in PROJECT["project"]["dependencies"]}
    assert pinned == needed | {f"python{PROJECT['project']['requires-python']}"}


def test_links_of_the_readme_hold_on_an_index():
    text = setup.absolute_links((ROOT / "README.md").read_text("utf-8"))
    links = re.findall(r"\]\(([^)]*)\)", text)
    assert links
    for link in links:
        assert link.startswith(("https://", "#")), link
        if path := re.match(rf"({re.escape(setup.HOME)}|{re.escape(setup.FILES)})([^#]*)", link):
            assert (ROOT / path[2]).exists(), link


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A wheel and a source distribution, by the build backend itself."""
    out = tmp_path_factory.mktemp("dist")
    code = (
        "import sys; from setuptools import build_meta as b; out = sys.argv[1]; "
        "b.build_sdist(out); b.build_wheel(out)"
    )
    copy = tmp_path_factory.mktemp("copy") / "source"
    subprocess.run(["git", "clone", "-q", str(ROOT), str(copy)], check=True)
    subprocess.run(
        [sys.executable, "-c", code, str(out)], cwd=copy, check=True, capture_output=True
    )
    return next(out.glob("*.tar.gz")), next(out.glob("*.whl"))


@pytest.mark.slow
def test_wheel_has_every_package_and_data_file(built):
    with zipfile.ZipFile(built[1]) as wheel:
        names = set(wheel.namelist())
    assert shipped() <= names
    assert not {name for name in names if name.startswith(("tests/", "docs/"))}


@pytest.mark.slow
def test_sdist_has_tests_docs_examples_and_changelog(built):
    with tarfile.open(built[0]) as sdist:
        names = {name.partition("/")[2] for name in sdist.getnames()}
    asked = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True
    )
    assert set(asked.stdout.splitlines()) - names == set()
