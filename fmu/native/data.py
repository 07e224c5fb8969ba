"""The file ``resources/film.bin`` of a native FMU: variables, tables and faces, for C."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import ClassVar

from attrs import frozen

from ..framework.ports import Port, Value
from .models import MODELS, VARIABLES, native_model
from .record import Record, maybe, positive, real, several, whole
from .records import Bodies, Faces, FilmTables, LiquidTable

__all__ = [
    "CAUSALITIES",
    "Contents",
    "TYPES",
    "Variable",
    "contents_of",
    "data_file",
    "digest",
    "guid_of",
]

TYPES = {"real": 1, "integer": 2, "enumeration": 4, "boolean": 8}
"""Types of variables as bits: a call of one version of FMI may take several of them."""
CAUSALITIES = ("input", "output", "parameter")
"""Causalities of variables, by their numbers."""


@frozen(kw_only=True)
class Variable(Record):
    """A variable of an FMU; its value reference is its place, from 1."""

    id: int = whole("which one of all there may be", 0, len(VARIABLES) - 1)
    type: int = whole("one bit", 1, max(TYPES.values()))
    causality: int = whole("input, output or parameter", 0, len(CAUSALITIES) - 1)
    low: float = real("smallest value")
    high: float = real("largest value")
    start: float = real("value before anything was set")
    nominal: float = positive("typical size, 1 if none is known")
    checked: ClassVar[bool] = True


@frozen(kw_only=True)
class Contents(Record):
    """Contents of the file of an FMU: its model, its variables, tables, faces and bodies."""

    model: int = whole("which one", 0, len(MODELS) - 1)
    variables: tuple[Variable, ...] = several(
        Variable, "by their value references", most=len(VARIABLES), least=1
    )
    tables: FilmTables | None = maybe(FilmTables, "film of a scene, or of a tip")
    faces: Faces | None = maybe(Faces, "rough faces of an end stop, or of the site of a tip")
    bodies: Bodies | None = maybe(Bodies, "bodies that deform, with their film")
    liquid: LiquidTable | None = maybe(LiquidTable, "over T, where that is a variable")


def contents_of(
    model: str,
    ports: Sequence[Port],
    start: Mapping[str, Value],
    tables: FilmTables | None = None,
    faces: Faces | None = None,
    bodies: Bodies | None = None,
    liquid: LiquidTable | None = None,
) -> Contents:
    """Contents of the file of an FMU.

    Raises
    ------
    DescriptionError
        If the model does not have what is given, or lacks something.
    """
    native_model(model).check(tables, faces, bodies)
    variables = tuple(_variable(port, start[port.name]) for port in ports)
    number = [*MODELS].index(model)
    return Contents(
        model=number,
        variables=variables,
        tables=tables,
        faces=faces,
        bodies=bodies,
        liquid=liquid,
    )


def _variable(port: Port, start: Value) -> Variable:
    low, high = port.limits
    return Variable(
        id=VARIABLES.index(port.name),
        type=TYPES[port.kind],
        causality=CAUSALITIES.index(port.causality),
        low=float(low),
        high=float(high),
        start=float(start),
        nominal=1.0 if port.nominal is None else float(port.nominal),
    )


def digest(sources: Mapping[str, bytes]) -> str:
    """Hash of files and their names."""
    found = hashlib.sha256()
    for name, content in sorted(sources.items()):
        found.update(f"{name}\0{len(content)}\0".encode() + content)
    return found.hexdigest()


def guid_of(sources: Mapping[str, bytes], numbers: Sequence[float], ports: Sequence[Port]) -> str:
    """GUID made from all that decides what the FMU computes and says."""
    said = repr([*numbers]) + repr(ports) + digest(sources)
    build = hashlib.sha256(said.encode()).hexdigest()
    return "-".join(build[i:j] for i, j in pairwise((0, 8, 12, 16, 20, 32)))


def data_file(guid: str, layout: str, numbers: Sequence[float]) -> bytes:
    """Bytes of the file.

    Parameters
    ----------
    guid : str
        GUID of the FMU.
    layout : str
        Eight letters that the kernel knows the order of the numbers by.
    numbers : sequence of float
        Those of its `Contents`.

    Examples
    --------
    >>> len(data_file("8c4e810f", "CK012345", [1.0, 2.0]))
    80
    """
    content = struct.pack(f"<{len(numbers)}d", *numbers)
    name = guid.encode().ljust(40, b"\0")
    return layout.encode() + struct.pack("<QQ", _fnv1a(content), len(numbers)) + name + content


def _fnv1a(content: bytes) -> int:
    """Checksum of bytes (FNV-1a, 64 bits)."""
    found = 14695981039346656037
    for byte in content:
        found = ((found ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    return found
