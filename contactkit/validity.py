"""Numbers that state whether a model is in its range, and the warning if one is not."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable

from attrs import field, frozen

from .errors import ValidityWarning

__all__ = ["ValidityNumber", "note_worst", "warn"]


@frozen(kw_only=True)
class ValidityNumber:
    """The worst value of a number over a run, and the range it should be in.

    `value` is None where the scene does not say what the number needs; `detail` then names it.
    """

    name: str
    value: float | None
    low: float = -math.inf
    high: float = math.inf
    detail: str
    source: str = field(default="", repr=False)

    @property
    def is_valid(self) -> bool | None:
        """Whether the value is in its range; None if it is not known."""
        return None if self.value is None else self.low <= self.value <= self.high

    def _excess(self) -> float:
        """How far the value lies outside its range; negative inside."""
        if self.value is None:
            return -math.inf
        return max(self.value - self.high, self.low - self.value)

    @property
    def bounds(self) -> str:
        """The range as text: at least, at most, or from one to the other."""
        if math.isfinite(self.low) and math.isfinite(self.high):
            return f"{self.low:g} to {self.high:g}"
        return f"at most {self.high:g}" if math.isfinite(self.high) else f"at least {self.low:g}"

    def __str__(self) -> str:
        if self.value is None:
            return f"{self.name}: not evaluated, {self.detail}"
        verdict = "ok" if self.is_valid else "OUT OF RANGE"
        return f"{self.name} = {self.value:.3g} ({self.bounds}): {verdict}; {self.detail}"


def note_worst(worst: dict[str, ValidityNumber], found: Iterable[ValidityNumber]) -> None:
    """Keep the worst of each number, by its name.

    Examples
    --------
    >>> worst = {}
    >>> for value in (0.1, 0.3, 0.2):
    ...     note_worst(worst, [ValidityNumber(name="slope", value=value, high=0.2, detail="small")])
    >>> worst["slope"].value
    0.3
    """
    for one in found:
        kept = worst.get(one.name)
        if kept is None or kept.value is None or one._excess() > kept._excess():
            worst[one.name] = one


def warn(found: Iterable[ValidityNumber], stacklevel: int = 3) -> None:
    """Issue a `ValidityWarning` for each number that is out of its range."""
    for number in found:
        if number.is_valid is False:
            warnings.warn(str(number), ValidityWarning, stacklevel=stacklevel)
