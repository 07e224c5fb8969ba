"""A hard case: why it is hard, a naive method, our method, and the errors of both."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

from attrs import frozen

__all__ = ["Found", "HardCase"]


class Found(NamedTuple):
    """Errors of both methods; `naive` is None where the naive method has no answer.

    `naive_gives` and `ours_gives` are the answers in words. Errors are relative unless the case
    says otherwise.
    """

    naive: float | None
    naive_gives: str
    ours: float
    ours_gives: str


@frozen(kw_only=True)
class HardCase:
    """One row of the page.

    Parameters
    ----------
    key : str
        Name of the case in the data.
    half : {"contact", "separation"}
        Half of the package that it belongs to.
    title, why : str
        What it is, and what makes it hard.
    naive, ours : str
        The naive method, and what contactkit does in its place.
    judge : str
        What the error is measured against.
    tested : str
        Test that keeps our answer.
    holds : float
        Bound of our error, on any machine.
    fails : float
        Least error of the naive method, on any machine.
    run : callable
        Computes both answers and their errors.
    """

    key: str
    half: Literal["contact", "separation"]
    title: str
    why: str
    naive: str
    ours: str
    judge: str
    tested: str
    holds: float
    fails: float
    run: Callable[[], Found]
