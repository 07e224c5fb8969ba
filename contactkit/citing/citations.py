"""Works, and what each of them is cited for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from attrs import frozen

from ..data.bibliography import Reference, contactkit_itself, references_in

__all__ = ["Citation", "Citations", "citations_of"]


@frozen
class Citation:
    """A work with what it is cited for.

    Attributes
    ----------
    reference : Reference
        The work.
    cited_for : tuple of str
        Sources of equations, methods and data that name it; empty for contactkit itself.
    """

    reference: Reference
    cited_for: tuple[str, ...] = ()

    @property
    def key(self) -> str:
        """Key of the entry in BibTeX."""
        return self.reference.key

    def bibtex(self) -> str:
        """Return the entry of BibTeX."""
        return self.reference.bibtex()

    def __str__(self) -> str:
        uses = "".join(f"\n    for {one}" for one in self.cited_for)
        return f"[{self.key}] {self.reference}{uses}"


@frozen
class Citations:
    """Works to cite: contactkit first, then in the order in which they are named.

    Attributes
    ----------
    works : tuple of Citation
        Each work once.
    others : tuple of str
        Sources that name no work of the bibliography: own formulations and choices, data sheets.
    """

    works: tuple[Citation, ...]
    others: tuple[str, ...] = ()

    @property
    def keys(self) -> tuple[str, ...]:
        r"""Keys of the entries in BibTeX, as ``\cite{...}`` takes them."""
        return tuple(one.key for one in self.works)

    def bibtex(self) -> str:
        """Return the entries of BibTeX, one after another."""
        return "\n".join(one.bibtex() for one in self.works)

    def __len__(self) -> int:
        return len(self.works)

    def __iter__(self) -> Iterator[Citation]:
        return iter(self.works)

    def __str__(self) -> str:
        rest = ["without a published work:", *(f"    {one}" for one in self.others)]
        return "\n".join([*map(str, self.works), *(rest if self.others else [])])


def citations_of(texts: Sequence[str]) -> Citations:
    """Return the works that sources name.

    Parameters
    ----------
    texts : sequence of str
        Sources, each with what it is of: "viscous-force: Stefan 1874, flats".

    Examples
    --------
    >>> found = citations_of(["film: Stefan 1874", "solver: own formulation"])
    >>> found.keys, found.others
    (('contactkit', 'stefan1874'), ('solver: own formulation',))
    """
    uses: dict[Reference, list[str]] = {contactkit_itself(): []}
    others = list[str]()
    for text in dict.fromkeys(texts):
        found = references_in(text)
        for one in found:
            uses.setdefault(one, []).append(text)
        if not found:
            others.append(text)
    works = tuple(Citation(one, tuple(named)) for one, named in uses.items())
    return Citations(works, tuple(others))
