"""Records: named members that Python writes and the C kernel reads, from one declaration.

A class that derives from `Record` is three things at once: values by name, their order and ranges
in a file of numbers, and the struct of the kernel with the function that reads it. Each kind of
member knows how its value is checked and written here, and its text in C.
"""

from __future__ import annotations

import math
import re
import sys
from abc import ABC, abstractmethod
from enum import IntEnum
from typing import Any, ClassVar, NamedTuple

from attrs import Attribute, field, fields, frozen

from ...errors import DescriptionError

__all__ = [
    "Column",
    "Kind",
    "MOST_NODES",
    "Maybe",
    "Member",
    "Part",
    "Real",
    "Record",
    "Several",
    "Whole",
    "c_name",
    "column",
    "flag",
    "maybe",
    "member_of",
    "non_negative",
    "part",
    "positive",
    "real",
    "several",
    "whole",
]

MOST_NODES = 1_000_000
"""Most nodes of a table; a file that says more was not written here."""


class Kind(ABC):
    """Kind of a member: the range of its values, their numbers in a file, and its text in C."""

    @property
    @abstractmethod
    def expected(self) -> str:
        """Condition on a value, in words that follow "must"."""

    @abstractmethod
    def allows(self, value: Any) -> bool:
        """Whether a value is of this kind and in range."""

    @abstractmethod
    def numbers(self, value: Any) -> list[float]:
        """Numbers of a value, in the order of the file."""

    @abstractmethod
    def declaration(self, name: str) -> str:
        """Member of a struct."""

    @abstractmethod
    def reading(self, name: str) -> str:
        """Statement of C that reads the member from the next numbers into ``to``."""


@frozen
class Real(Kind):
    """A number from `low` to `high`; never nan."""

    low: float = -math.inf
    high: float = math.inf

    @property
    def expected(self) -> str:
        """See `Kind`."""
        return f"be a number from {self.low:g} to {self.high:g}"

    def allows(self, value: Any) -> bool:
        """See `Kind`."""
        return isinstance(value, float) and self.low <= value <= self.high

    def numbers(self, value: Any) -> list[float]:
        """See `Kind`."""
        return [value]

    def declaration(self, name: str) -> str:
        """See `Kind`."""
        return f"double {name};"

    def reading(self, name: str) -> str:
        """See `Kind`."""
        return f"to->{name} = ck_read_real(r, {_c_real(self.low)}, {_c_real(self.high)});"


@frozen
class Whole(Kind):
    """A whole number from `low` to `high`, as a type of Python: int, bool or an enumeration."""

    low: int
    high: int
    type: type[int] = int

    @property
    def expected(self) -> str:
        """See `Kind`."""
        return f"be a {self.type.__name__} from {self.low} to {self.high}"

    def allows(self, value: Any) -> bool:
        """See `Kind`."""
        is_own = isinstance(value, self.type) and isinstance(value, bool) is (self.type is bool)
        return is_own and self.low <= value <= self.high

    def numbers(self, value: Any) -> list[float]:
        """See `Kind`."""
        return [float(value)]

    def declaration(self, name: str) -> str:
        """See `Kind`."""
        return f"int {name};"

    def reading(self, name: str) -> str:
        """See `Kind`."""
        return f"to->{name} = ck_read_whole(r, {self.low}, {self.high});"


@frozen
class Part(Kind):
    """Another record."""

    record: type[Record]

    @property
    def expected(self) -> str:
        """See `Kind`."""
        return f"be a {self.record.__name__}"

    def allows(self, value: Any) -> bool:
        """See `Kind`."""
        return isinstance(value, self.record)

    def numbers(self, value: Any) -> list[float]:
        """See `Kind`."""
        found: list[float] = value.numbers()
        return found

    def declaration(self, name: str) -> str:
        """See `Kind`."""
        return f"{c_name(self.record)} {name};"

    def reading(self, name: str) -> str:
        """See `Kind`."""
        return f"read_{c_name(self.record)[3:]}(r, &to->{name});"


@frozen
class Maybe(Part):
    """Another record, or None."""

    @property
    def expected(self) -> str:
        """See `Kind`."""
        return f"be a {self.record.__name__} or None"

    def allows(self, value: Any) -> bool:
        """See `Kind`."""
        return value is None or super().allows(value)

    def numbers(self, value: Any) -> list[float]:
        """See `Kind`."""
        return [0.0] if value is None else [1.0, *super().numbers(value)]

    def declaration(self, name: str) -> str:
        """See `Kind`."""
        return f"int has_{name}; {super().declaration(name)}"

    def reading(self, name: str) -> str:
        """See `Kind`."""
        has = f"to->has_{name}"
        return f"{has} = ck_read_whole(r, 0, 1);\n    if ({has}) {super().reading(name)}"


@frozen
class Several(Kind):
    """A tuple of `least` to `most` members of one kind."""

    kind: Kind
    least: int
    most: int

    @property
    def expected(self) -> str:
        """See `Kind`."""
        return f"be {self.least} to {self.most} in a tuple, where each must {self.kind.expected}"

    def allows(self, value: Any) -> bool:
        """See `Kind`."""
        is_tuple = isinstance(value, tuple) and self.least <= len(value) <= self.most
        return is_tuple and all(map(self.kind.allows, value))

    def numbers(self, value: Any) -> list[float]:
        """See `Kind`."""
        return [float(len(value)), *(x for one in value for x in self.kind.numbers(one))]

    def declaration(self, name: str) -> str:
        """See `Kind`."""
        return f"int n_{name}; {self.kind.declaration(f'{name}[CK_MOST_{name.upper()}]')}"

    def reading(self, name: str) -> str:
        """See `Kind`."""
        count, most = f"to->n_{name}", f"CK_MOST_{name.upper()}"
        each = self.kind.reading(f"{name}[i]")
        return (
            f"{count} = ck_read_whole(r, {self.least}, {most});\n"
            f"    for (i = 0; r->fine && i < {count}; i++) {each}"
        )


@frozen
class Column(Kind):
    """Finite values at the nodes of a record, at least two; all its columns are as long.

    The kernel reads them where they lie in the file. The number of nodes is written once, before
    the first column.
    """

    ascends: bool

    @property
    def expected(self) -> str:
        """See `Kind`."""
        order = "ascending " if self.ascends else ""
        return f"be 2 to {MOST_NODES} finite {order}numbers in a tuple"

    def allows(self, value: Any) -> bool:
        """See `Kind`."""
        if not (isinstance(value, tuple) and 2 <= len(value) <= MOST_NODES):
            return False
        ascends = not self.ascends or all(map(float.__lt__, value[:-1], value[1:]))
        return ascends and all(map(math.isfinite, value))

    def numbers(self, value: Any) -> list[float]:
        """See `Kind`."""
        return [*value]

    def declaration(self, name: str) -> str:
        """See `Kind`."""
        return f"const double *{name};"

    def reading(self, name: str) -> str:
        """See `Kind`."""
        return f"to->{name} = ck_read_column(r, to->n_nodes, {int(self.ascends)});"


class Member(NamedTuple):
    """Name of a member, its kind, and what it is, with its unit."""

    name: str
    kind: Kind
    note: str


_LAYOUT = "layout"


def _check(owner: Record, attribute: Attribute[Any], value: Any) -> None:
    kind, _ = attribute.metadata[_LAYOUT]
    if not kind.allows(value):
        name = f"{type(owner).__name__}.{attribute.name}"
        raise DescriptionError(name, value, kind.expected)


def _member(kind: Kind, note: str) -> Any:
    return field(validator=_check, metadata={_LAYOUT: (kind, note)})


def real(note: str, low: float = -math.inf, high: float = math.inf) -> Any:
    """Member that is a number; infinite only where a bound is."""
    return _member(Real(low, high), note)


def non_negative(note: str) -> Any:
    """Member that is a number from 0 on."""
    return _member(Real(0.0), note)


def positive(note: str) -> Any:
    """Member that is a number above 0."""
    return _member(Real(sys.float_info.min), note)


def whole(note: str, low: int, high: int) -> Any:
    """Member that is a whole number."""
    return _member(Whole(low, high), note)


def flag(note: str) -> Any:
    """Member that is true or false."""
    return _member(Whole(0, 1, bool), note)


def member_of(enumeration: type[IntEnum], note: str) -> Any:
    """Member that is one of an enumeration without gaps."""
    return _member(Whole(min(enumeration), max(enumeration), enumeration), note)


def part(record: type[Record], note: str) -> Any:
    """Member that is another record."""
    return _member(Part(record), note)


def maybe(record: type[Record], note: str) -> Any:
    """Member that is another record, or None."""
    return _member(Maybe(record), note)


def several(of: type[Record] | Kind, note: str, *, most: int, least: int = 0) -> Any:
    """Member that is a tuple of records or of numbers."""
    return _member(Several(of if isinstance(of, Kind) else Part(of), least, most), note)


def column(note: str, *, ascends: bool = False) -> Any:
    """Member that is a tuple of numbers, one for each node of the record."""
    return _member(Column(ascends), note)


@frozen(kw_only=True)
class Record:
    """Values by name, in the order in which a file has them.

    A subclass lists its members as fields made by `real`, `whole`, `part` and the like.

    Raises
    ------
    DescriptionError
        If a value is of the wrong kind or out of range, or two columns differ in length.

    Examples
    --------
    >>> @frozen(kw_only=True)
    ... class Spring(Record):
    ...     '''A spring that is slack below a gap.'''
    ...     stiffness: float = positive("[N/m]")
    ...     ends: tuple[float, ...] = several(Real(0.0), "gaps [m]", most=2)
    >>> Spring(stiffness=2.0, ends=(0.5,)).numbers()
    [2.0, 1.0, 0.5]
    """

    derived: ClassVar[tuple[str, ...]] = ()
    """Members that only the struct of C has; ``ck_made_...`` of the kernel fills them in."""
    checked: ClassVar[bool] = False
    """Whether ``ck_made_...`` of the kernel looks at what was read even so."""

    def __attrs_post_init__(self) -> None:
        lengths = {m.name: len(getattr(self, m.name)) for m in self.columns()}
        if len(set(lengths.values())) > 1:
            name = f"{type(self).__name__}({', '.join(lengths)})"
            raise DescriptionError(name, tuple(lengths.values()), "be equally long")

    @classmethod
    def members(cls) -> tuple[Member, ...]:
        """Members, in the order of the file."""
        return tuple(Member(one.name, *one.metadata[_LAYOUT]) for one in fields(cls))

    @classmethod
    def most(cls, name: str) -> int:
        """Largest number of entries of a member that has several."""
        kinds = (one.kind for one in cls.members() if one.name == name)
        (found,) = (kind.most for kind in kinds if isinstance(kind, Several))
        return found

    @classmethod
    def columns(cls) -> tuple[Member, ...]:
        """Members with a number for each node."""
        return tuple(one for one in cls.members() if isinstance(one.kind, Column))

    @classmethod
    def parts(cls) -> tuple[type[Record], ...]:
        """Records that are members."""
        kinds = (one.kind for one in cls.members())
        inner = (kind.kind if isinstance(kind, Several) else kind for kind in kinds)
        return tuple(kind.record for kind in inner if isinstance(kind, Part))

    def numbers(self) -> list[float]:
        """Return the numbers of all members, in the order of the file."""
        found, columns = list[float](), self.columns()
        for one in self.members():
            if columns and one == columns[0]:
                found.append(float(len(getattr(self, one.name))))
            found += one.kind.numbers(getattr(self, one.name))
        return found


def c_name(record: type) -> str:
    """Name of a class in C.

    Examples
    --------
    >>> class PowerCurve(Record): ...
    >>> c_name(PowerCurve)
    'ck_power_curve'
    """
    return "ck_" + re.sub(r"(?<!^)(?=[A-Z])", "_", record.__name__).lower()


def _c_real(value: float) -> str:
    if math.isinf(value):
        return "HUGE_VAL" if value > 0.0 else "-HUGE_VAL"
    return repr(value)
