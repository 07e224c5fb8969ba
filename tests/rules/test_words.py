"""The field's terms: no word of the former private vocabulary in names, prose or messages."""

from __future__ import annotations

import ast
import functools
import io
import re
import subprocess
import tokenize
from fnmatch import fnmatch
from pathlib import Path

import pytest

# Rules of the house, as lint is: 30 s of `make test`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]

# What is searched for (names are split at underscores), and the term to use in its place. "Arc"
# is the name of the circular approximation (`arc_bridge`), "drive" that of the valve's actuator.
TERMS = {
    r"\bways? (out|back|in)\b|\bon (the|its) way (out|back|in)\b": "unloading curve, loading curve",
    r"\bstop curves?\b": "load-displacement curve",
    r"\b(most|largest) (work|impulse)s?\b": "maximum",
    r"\b(lost|spent|recoverable) work\b|\bwork (lost|spent)\b": "dissipated work, elastic work",
    r"\bblows?\b(?!-| up)": "impact",
    r"\bdent(s|ed)?\b": "residual indentation",
    r"\bspr(ings?|ung) back\b": "rebound",
    r"\b(lets?|letting) go\b": "pull-off, detachment, release",
    r"\brejoin(s|ed)?\b": "re-contact",
    r"\b(pressure caps?|capp(ed|ing))\b": "pressure bound",
    r"\b(moving|bare|saturated) pixels?\b|\bpixels? that (may )?moves?\b": "active set",
    r"\blone (map|contact|patch)s?\b|\bfree window\b": "non-periodic (isolated) contact",
    r"\b(a|the|this|that|its|each|what|which|by|of) shares?\b(?! (with|their|its|a|one|the|no)\b)"
    r"|\bshares? of\b": "fraction, ratio",
    r"\bgiven impulse\b": "applied impulse",
    r"\bspent( |$|\b mass)|\bcoast(s|ing|ed)?\b": "at rest; free motion",
    r"\bstr(ode|ides?|iding) over\b": "stepped over",
    r"\btame\b": "non-stiff",
    r"\bat rounding\b": "at round-off",
    r"\bnext to nothing\b": "slowly varying, negligible",
    r"\bhappens?\(|\bfirst mark\b": "apply the event, first event",
    r"\b(outer|inner|newton|after \w+|more|few|of) rounds\b|^rounds$": "iterations",
    r"\bdrag slopes?\b": "damping coefficient",
    r"\b(a|the) bath\b": "flooded (fully immersed)",
    r"\bwaists?\b": "neck radius",
    r"\bbinder\b|\bbinds?\b(?! (mount|to|it|them|a|the))": "limiting end",
    r"\btwins?\b": "symmetric",
    r"^cover$|\bits cover\b|\bthe cover of\b": "coverage",
    r"\bclipp(ed|ing)\b|\bclipped cavity\b": "truncated",
    r"\b(oil|liquid|film) (still )?(can )?bears?\b": "tensile strength of the liquid",
    r"\bdoors?\b": "entry point",
    r"\bnouns?\b": "scene objects",
    r"\b(is|are|was|were|be|been|what is|numbers) (told|said)\b|\bwas asked\b|\bsays so\b"
    r"|\btold (about|of)\b|\btells\b": "reported, stated, evaluated",
    r"\b(bod(y|ies)|surfaces?|solids?|walls?|faces?) (that )?yields?\b": "deforms (elastically)",
    r"\bthat (gives?|give)$|\bsites? that gives?\b": "elastic, compliant",
    r"\bways? of (the master|coupling)\b|\beach way\b": "co-simulation run, coupling scheme",
    r"\btaken back\b|\btakes? back\b": "rolled back",
    r"\b(the )?two sides of the (master|interface)\b": "the coupled subsystems",
    r"\bend-?point (scheme|method|force)": "implicit force coupling",
    r"\bby their error\b": "adaptive steps",
    r"\bfaces of (a|the|its|their) stop\b": "rough end-stop faces",
    r"\bwhole (mirror|system)\b|\bas one system\b": "monolithic model",
    r"\bfilm left\b": "remaining film",
    r"\bplain numbers\b": "floats",
    r"\bfront door\b": "entry point",
    r"\beither way out\b|\bboth ways\b": "in both directions",
    r"\b(way|ways) backs?\b|^(way back|ready ways)$": "unloading curve, unloading branch",
    r"^recoverable$": "elastic",
    r"\b(to|below|within|by) rounding\b": "round-off",
    r"\brigid level\b": "rigid-body approach",
    r"\b(film|viscous) resistance\b|\bresistance of (the|a) (film|liquid)\b"
    r"|\bdrag of (the|a) film\b": "damping coefficient, viscous force",
    r"\bdrives? (a|an|the|its) (FMU|motion|mass|film)\b": "loading, excitation; to step an FMU",
    r"\bboth sides agree\b|\bthe two sides of\b|\bways? of a? ?master\b|^forget$": "subsystems",
    r"\bone system\b(?! structure)": "monolithic model",
    r"\bcounted pixels?\b|\bcorrected at (the|its) edges\b": "pixel count, edge-corrected area",
    r"\bbears? (any|no|a tension|\d+ bar)\b": "tensile limit of the liquid",
    r"\bwithout neighbours\b": "isolated contact",
    r"^told$": "reported, stated",
    r"^(stop|faces) blows?$|^blows?$": "impact",
    r"(?<![a-z])(tears?|tearing|torn|tore|born|births?|heal(s|ed|ing)?)(?![a-z])|\bwhole again\b": (
        "inception, rupture (cavitation), reformation"
    ),
}
# Where one of them is the right word: pattern of the path, phrase, reason.
DELIBERATE: list[tuple[str, str, str]] = [
    ("docs/reference/scene-files.md", '= "clipped"`', "former spelling of a key"),
    ("tests/benchmarks/*", "rounds", "argument of pytest-benchmark"),
    ("contactkit/files/structure.py", '"tear_time"', "former name of a key"),
    ("contactkit/files/structure.py", '"heal_time"', "former name of a key"),
    ("contactkit/files/structure.py", '"n_tears"', "former name of a key"),
    ("contactkit/files/structure.py", '"n_heals"', "former name of a key"),
    ("fmu/framework/ports.py", '"dp_tear"', "former name of a variable"),
    ("docs/reference/*", "former", "former name of a variable"),
    ("tests/*_errors.py", "n_tears", "former name of a key"),
    ("tests/fmu/test_description.py", "dp_tear", "former name of a variable"),
]
# First lines that are a riddle: what the thing is must come first.
RIDDLE = re.compile(r"(What|How|Where|When|Which|Why|That)\b")

GENERATED = re.compile(r"<!-- table: .*?<!-- end of table -->", re.DOTALL)
KINDS = ("*.py", "*.md", "*.toml", "*.c", "*.h", "*.yml")
LEFT_OUT = ("CHANGELOG.md", "tests/rules/test_words.py")


@functools.cache
def files():
    """Text files of the repository, by their path."""
    listed = subprocess.run(
        ["git", "ls-files", *KINDS], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    names = sorted(set(listed.stdout.splitlines()) - set(LEFT_OUT))
    return [name for name in names if (ROOT / name).is_file()]


def python_texts(source):
    """Names (split at underscores), comments and strings of a module, with their lines."""
    seen = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.NAME:
            if token.string not in seen:
                seen.add(token.string)
                words = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", token.string).lower()
                yield token.start[0], words.replace("_", " ").strip()
        elif token.type in (tokenize.COMMENT, tokenize.STRING):
            yield token.start[0], token.string


def texts(path):
    """Pieces of a file that are searched, with their first lines."""
    source = (ROOT / path).read_text("utf-8")
    if path.endswith(".py"):
        yield from python_texts(source)
    elif path.endswith(".md"):  # generated tables repeat docstrings, which are searched themselves
        yield 1, GENERATED.sub(lambda found: "\n" * found[0].count("\n"), source)
    else:
        yield 1, source


COMPILED = [(re.compile(pattern, re.IGNORECASE), term) for pattern, term in TERMS.items()]
ANY = re.compile("|".join(f"(?:{pattern})" for pattern in TERMS), re.IGNORECASE)


@functools.cache
def matches(text):
    """Former terms in a text: place, phrase, what is around, term. A name is in many files."""
    joined = re.sub(r"\s*\n\s*(?:# )?", " ", text)
    if not ANY.search(joined):
        return []
    return [
        (
            text.find(match[0].split()[0]),
            match[0],
            joined[max(0, match.start() - 60) : match.end() + 60],
            term,
        )
        for pattern, term in COMPILED
        for match in pattern.finditer(joined)
    ]


def found_in(path):
    """Former terms in a file: line, phrase, the term to use."""
    for first, text in texts(path):
        for place, phrase, around, term in matches(text):
            if not is_deliberate(path, around):
                yield first + text[:place].count("\n"), phrase, term


def is_deliberate(path, around):
    """Whether a phrase is one of the deliberate uses."""
    return any(fnmatch(path, where) and text in around for where, text, _ in DELIBERATE)


@pytest.mark.slow
def test_only_terms_of_the_field():
    found = [
        f"{path}:{line}: {phrase!r} -> {term}"
        for path in files()
        for line, phrase, term in found_in(path)
    ]
    assert found == [], "\n".join(found)


def summaries(path):
    """First lines of a module's docstring and of those of its public classes and functions."""
    tree = ast.parse((ROOT / path).read_text("utf-8"))
    public = [n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef | ast.ClassDef)]
    for node in (tree, *(n for n in public if not n.name.startswith("_"))):
        text = ast.get_docstring(node)
        if text:
            yield getattr(node, "lineno", 1), text.splitlines()[0]


def test_first_lines_name_the_thing():
    """A module, class or function is introduced by what it is or does, not by a question."""
    found = [
        f"{path}:{line}: {first}"
        for path in files()
        if path.endswith(".py") and not path.startswith("tests/")
        for line, first in summaries(path)
        if RIDDLE.match(first)
    ]
    assert found == [], "\n".join(found)
