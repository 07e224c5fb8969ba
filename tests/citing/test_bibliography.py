"""The bibliography: its entries, their labels, and the texts that name them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from contactkit._version import __version__
from contactkit.data.bibliography import bibliography, contactkit_itself, references_in

ROOT = Path(__file__).parents[2]
BIB = ROOT / "contactkit" / "data" / "references.bib"
NEEDS = {
    "article": {"journal", "year", "volume"},
    "book": {"publisher", "year"},
    "phdthesis": {"school", "year"},
    "techreport": {"institution", "number", "year"},
    "misc": {"url"},
}


def test_every_entry_is_read_and_complete():
    text = BIB.read_text("utf-8")
    heads = re.findall(r"^@\w+\{([\w-]+),", text, re.MULTILINE)
    assert heads == sorted(heads) == list(bibliography())
    for one in bibliography().values():
        assert {"author", "title"} | NEEDS[one.kind] <= set(one.fields), one.key
        assert one.kind == "misc" or re.fullmatch(rf"[a-z]+{one.year}[a-z]?", one.key)
        assert all(v.count("{") == v.count("}") for v in one.fields.values()), one.key


def test_no_entry_is_changed_on_its_way_to_bibtex():
    written = "\n".join(one.bibtex() for one in bibliography().values())
    given = BIB.read_text("utf-8").split("\n\n", 1)[1]
    assert written == given


def test_a_label_finds_its_own_entry_alone():
    for one in bibliography().values():
        if one.year is not None:
            assert references_in(f"equation, {one.label}, section 2") == (one,), one.key


def test_dois_are_dois_and_belong_to_one_work():
    dois = [one.doi for one in bibliography().values() if one.doi]
    assert len(dois) == len(set(dois)) > 30
    assert all(re.fullmatch(r"10\.\d{4,5}/\S+", doi) for doi in dois)


@pytest.mark.parametrize(
    ("text", "keys"),
    [
        ("Gent (1958), 4.5 to 7 MPa", ["gent1958"]),
        ("Kell, J. Chem. Eng. Data 20 (1975) 97, Eq. 16", ["kell1975"]),
        ("IAPWS R1-76(2014); constants", ["iapws2014"]),
        ("Oliver and Pharr, J. Mater. Res. 7 (1992)", ["oliver1992"]),
        ("Aussillous and Quéré 2000", ["aussillous2000"]),
        ("Hintermüller, Ito and Kunisch 2002", ["hintermueller2002"]),
        ("Cattaneo 1938, Mindlin and Deresiewicz 1953", ["cattaneo1938", "mindlin1953"]),
        ("Eq. (3.1) of Cai and Bhushan 2007a", ["cai2007a"]),
        ("Eq. (3.1) of Cai and Bhushan 2007", []),  # which of two
        ("Cai 2008", ["cai2008"]),  # not 2008a
        ("Johnson and Greenwood 1985", []),  # not Johnson 1985
        ("Maugis 1992; Johnson 1997", ["maugis1992"]),
        ("own choice of 1992", []),
        ("", []),
    ],
)
def test_works_are_found_by_names_and_year(text, keys):
    assert [one.key for one in references_in(text)] == keys


def test_contactkit_is_cited_as_its_citation_file_says():
    given = (ROOT / "CITATION.cff").read_text("utf-8")
    one = contactkit_itself()
    assert f'title: "{one.fields["title"]}"' in given
    assert f'repository-code: "{one.fields["url"]}"' in given
    assert one.fields["version"] == __version__
    assert __version__ in one.bibtex()
    assert __version__ in str(one)
