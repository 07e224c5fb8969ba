"""The bibliography: works by their keys, and the works that a text names.

``references.bib`` beside this file holds them, for BibTeX as it is. A text names a work by its
label: family names and year, "Cai and Bhushan 2007a", with the letter that the key ends with.
Between the names and the year a journal may stand, "Gent (1958)", "Kell, J. Chem. Eng. Data 20
(1975)".
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from functools import cached_property, lru_cache
from importlib import resources

from attrs import field, frozen

from .._version import __version__
from ..frozen import FrozenDict

__all__ = ["Reference", "bibliography", "contactkit_itself", "references_in"]

_ENTRY = re.compile(r"@(?P<kind>\w+)\{(?P<key>[\w-]+),\n(?P<fields>.*?)\n\}", re.DOTALL)
_FIELD = re.compile(r"^  (?P<name>\w+) = \{(?P<value>.*)\},$", re.MULTILINE)
_LETTER = re.compile(r"\d{4}(?P<letter>[a-z])$")
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue"})
# Names in full up to this many, as texts of contactkit write them; then "Giacopini et al. 2010".
_NAMES = 3
# A journal, its volume and a page fit between the names and the year; two works do not.
_BETWEEN = 60


@frozen(slots=False)
class Reference:
    """A work of the bibliography.

    Attributes
    ----------
    key : str
        Key of its entry in ``references.bib``.
    kind : str
        Type of the entry: article, book, phdthesis, techreport or misc.
    fields : mapping
        Fields of the entry as BibTeX has them: author, title, journal, year, doi and others.

    Examples
    --------
    >>> one = bibliography()["hintermueller2002"]
    >>> one.label, one.year
    ('Hintermueller, Ito and Kunisch 2002', 2002)
    >>> print(one)
    Hintermüller, M., Ito, K. and Kunisch, K. (2002). The primal-dual active set strategy as a \
semismooth Newton method. SIAM Journal on Optimization 13, 865-888. \
https://doi.org/10.1137/S1052623401383558
    """

    key: str
    kind: str
    fields: Mapping[str, str] = field(repr=False, hash=False)

    @property
    def year(self) -> int | None:
        """Year of publication; None where there is none, as of contactkit."""
        return int(self.fields["year"]) if "year" in self.fields else None

    @property
    def doi(self) -> str:
        """DOI; empty if it is not in the bibliography."""
        return self.fields.get("doi", "")

    @cached_property
    def names(self) -> str:
        """Family names of the authors in ASCII, the first alone "et al." if they are many."""
        families = [one.split(",")[0] for one in _authors(self)]
        families = [_ascii(one.removeprefix("The ").removesuffix(" authors")) for one in families]
        if "shortauthor" in self.fields:
            return self.fields["shortauthor"]
        if len(families) > _NAMES or "others" in families:
            return f"{families[0]} et al."
        return " and ".join(filter(None, [", ".join(families[:-1]), families[-1]]))

    @property
    def label(self) -> str:
        """Names and year by which a text names the work."""
        letter = _LETTER.search(self.key)
        year = f" {self.year}" if self.year else ""
        return f"{self.names}{year}{letter['letter'] if letter else ''}"

    def bibtex(self) -> str:
        """Return the entry of BibTeX."""
        lines = (f"  {name} = {{{value}}},\n" for name, value in self.fields.items())
        return f"@{self.kind}{{{self.key},\n{''.join(lines)}}}\n"

    def place_in(self, text: str) -> int | None:
        """Return the place at which a text names the work; None: nowhere.

        It names it by its label, or a report by its number.

        Examples
        --------
        >>> kell = bibliography()["kell1975"]
        >>> kell.place_in("Kell, J. Chem. Eng. Data 20 (1975) 97"), kell.place_in("Kell")
        (0, None)
        """
        found = self._pattern.search(_ascii(text)) if self.year else None
        return None if found is None else found.start()

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        letter = _LETTER.search(self.key)
        year = rf"\(?{self.year}{letter['letter'] if letter else ''}(?!\w)"
        before = r"(?<![\w-])(?<!and )"
        named = rf"{re.escape(self.names)}(?:,(?:(?! and )[^;:]){{1,{_BETWEEN}}}?)? {year}"
        number = self.fields.get("number")
        numbered = f"|{re.escape(f'{self.names} {number}')}" if number else ""
        return re.compile(f"{before}(?:{named}{numbered})")

    def __str__(self) -> str:
        """The work in a line, for the reader."""
        get = {name: _plain(value) for name, value in self.fields.items()}.get
        authors = _listed([_plain(one) for one in _authors(self)])
        where = get("journal") or get("publisher") or get("school") or get("institution") or ""
        if "number" in self.fields:
            where = f"{where} {get('number')}"
        if "volume" in self.fields:
            where = f"{where} {get('volume')}"
        if "pages" in self.fields:
            where = f"{where}, {get('pages')}"
        if "version" in self.fields:
            where = f"version {get('version')}"
        edition = f", {get('edition')} edition" if "edition" in self.fields else ""
        link = f"https://doi.org/{self.doi}" if self.doi else get("url") or ""
        head = f"{authors} ({self.year})" if self.year else authors
        parts = (head.rstrip("."), f"{get('title')}{edition}", where, link)
        return ". ".join(part for part in parts if part)


@lru_cache(maxsize=1)
def bibliography() -> Mapping[str, Reference]:
    """Return all works by their keys.

    Examples
    --------
    >>> bibliography()["love1929"].doi
    '10.1098/rsta.1929.0009'
    """
    from .. import data

    text = resources.files(data).joinpath("references.bib").read_text("utf-8")
    found = {}
    for entry in _ENTRY.finditer(text):
        fields = {one["name"]: one["value"] for one in _FIELD.finditer(entry["fields"])}
        found[entry["key"]] = Reference(entry["key"], entry["kind"], FrozenDict(fields))
    return FrozenDict(found)


def contactkit_itself() -> Reference:
    """Return the entry of contactkit, with the version in use.

    Examples
    --------
    >>> contactkit_itself().key
    'contactkit'
    """
    one = bibliography()["contactkit"]
    fields = FrozenDict(dict(one.fields) | {"version": __version__})
    return Reference(one.key, one.kind, fields)


def references_in(text: str) -> tuple[Reference, ...]:
    """Return the works that a text names, in its order.

    Examples
    --------
    >>> [one.key for one in references_in("Stefan 1874, flats: Eq. (3.18) of Cai 2008")]
    ['stefan1874', 'cai2008']
    """
    places = ((one.place_in(text), one) for one in bibliography().values())
    found = [(place, one) for place, one in places if place is not None]
    return tuple(one for _, one in sorted(found, key=lambda pair: pair[0]))


def _authors(reference: Reference) -> list[str]:
    """Authors of an entry: ``Family, Given`` each, or a body in braces."""
    return re.split(r" and (?![^{]*\})", reference.fields["author"])


def _listed(authors: list[str]) -> str:
    """Authors as a text: with commas, and "and" before the last."""
    if authors[-1] == "others":
        return f"{', '.join(authors[:-1])} et al."
    return " and ".join(filter(None, [", ".join(authors[:-1]), authors[-1]]))


def _plain(value: str) -> str:
    """A value of BibTeX as a text."""
    return value.replace("{", "").replace("}", "").replace("--", "-")


def _ascii(text: str) -> str:
    """A text without accents, with umlauts as two letters."""
    folded = unicodedata.normalize("NFKD", _plain(text).translate(_UMLAUTS))
    return folded.encode("ascii", "ignore").decode("ascii")
