"""XML without a document type, of limited depth.

Entities, which expand to any size or to other files, are declared in a document type. No file of
FMI or SSP has one, so it is refused where it begins, before anything expands.
"""

from __future__ import annotations

from typing import Any
from xml.etree.ElementTree import Element, ParseError, fromstring
from xml.parsers import expat

from ..errors import DescriptionError
from .limits import check_limit

__all__ = ["check_xml", "read_xml"]

_ENCODINGS = ("utf-8", "us-ascii", "iso-8859-1")


def check_xml(content: bytes, where: str) -> None:
    """Refuse XML with a document type, of an unusual encoding, too long or nested too deeply.

    Raises
    ------
    DescriptionError
        Naming the file and what was found.

    Examples
    --------
    >>> check_xml(b"<a><b/></a>", "modelDescription.xml")
    """
    check_limit("TEXT_BYTES", len(content), where)
    depth = 0

    def enter(*_: Any) -> None:
        nonlocal depth
        depth += 1
        check_limit("DEPTH", depth, where)

    def leave(_: str) -> None:
        nonlocal depth
        depth -= 1

    def declared(_version: str, encoding: str | None, _standalone: int) -> None:
        if encoding is not None and encoding.lower() not in _ENCODINGS:
            raise _refused(where, f"be encoded as {_ENCODINGS[0]}", encoding)

    def typed(name: str, *_: Any) -> None:
        raise _refused(where, "have no document type, which may declare entities", name)

    parser = expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler = enter, leave
    parser.XmlDeclHandler, parser.StartDoctypeDeclHandler = declared, typed
    try:
        parser.Parse(content, True)
    except DescriptionError:
        raise
    except (expat.ExpatError, ValueError, LookupError) as error:
        raise _refused(where, "be XML", str(error)) from None


def _refused(where: str, expected: str, found: str) -> DescriptionError:
    return DescriptionError("file", where, expected, hint=f"there is {found[:80]}")


def read_xml(content: bytes, where: str) -> Element:
    """Root of an XML text that `check_xml` does not refuse.

    Examples
    --------
    >>> read_xml(b"<a b='1'/>", "modelDescription.xml").get("b")
    '1'
    """
    check_xml(content, where)
    try:
        return fromstring(content)
    except ParseError as error:  # a prefix without its namespace
        raise _refused(where, "be XML", str(error)) from None
