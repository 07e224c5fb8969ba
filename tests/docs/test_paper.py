"""The paper has the form its journal asks for, and no number of its own."""

import re
from pathlib import Path

PAPER = Path(__file__).parents[2] / "docs/paper"
TEXT = (PAPER / "paper.md").read_text("utf-8")
SECTIONS = [
    "Summary",
    "Statement of need",
    "State of the field",
    "Software design",
    "Research impact statement",
    "AI usage disclosure",
    "Acknowledgements",
    "References",
]


def prose():
    """Text below the header, without what scripts wrote."""
    body = TEXT.split("---\n", 2)[2]
    return re.sub(r"<!-- table:.*?<!-- end of table -->", "", body, flags=re.DOTALL)


def test_sections_and_length():
    assert re.findall(r"^# (.*)$", TEXT, re.MULTILINE) == SECTIONS
    assert 750 <= len(TEXT.split("---\n", 2)[2].split()) <= 1750


def test_every_number_is_written_by_a_script():
    # what is left: dates, orders asked for, dimensions
    words = re.sub(r"\[@[^]]*\]|\$10\^\{-8\}\$|30 %|November 2026", "", prose())
    assert not re.findall(r"\d+", words)


def entries(path):
    """Entries of a bibliography by their keys."""
    parts = re.split(r"^(?=@)", path.read_text("utf-8"), flags=re.MULTILINE)[1:]
    found = {re.match(r"@\w+\{(\w+),", part)[1]: part for part in parts}
    assert len(found) == len(parts)
    return found


def test_the_bibliography_beside_the_paper_has_what_it_cites_and_no_more():
    """One file, as the journal sees the folder of the paper alone; shared entries as they are."""
    assert "\nbibliography: paper.bib\n" in TEXT
    found = entries(PAPER / "paper.bib")
    shared = entries(PAPER / "../../contactkit/data/references.bib")
    assert found.keys() == set(re.findall(r"@([a-z0-9]+)", prose()))
    assert found.keys() & shared.keys()
    for key, entry in found.items():
        assert key not in shared or entry.strip() == shared[key].strip()
        assert "  title = {" in entry
        assert "  year = {" in entry
        assert key in shared or "  doi = {10." in entry or "  url = {https://" in entry, key
