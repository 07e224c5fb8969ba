"""A hard case: why it is hard, a naive method, our method, and the errors of both."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Literal, NamedTuple

from attrs import frozen

from ..._lazy import named
from ...export.report import Report

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
    """One case of the table: `contactkit cost NAME` runs it, as the page and the tests do.

    Parameters
    ----------
    name : str
        Name in the table.
    half : {"contact", "separation"}
        Half of the package that it belongs to.
    title, why : str
        What it is, and what makes it hard.
    naive, ours : str
        The naive method, and what contactkit does in its place.
    judge : str
        What the error is measured against.
    tested : str
        Test that keeps our answer over a range of such cases.
    holds : float
        Bound of our error, on any machine.
    fails : float
        Least error of the naive method, on any machine.
    measured_by : str
        Function of this folder that computes both answers and their errors, ``module:function``.
    """

    name: str
    half: Literal["contact", "separation"]
    title: str
    why: str
    naive: str
    ours: str
    judge: str
    tested: str
    holds: float
    fails: float
    measured_by: str

    def run(self) -> Found:
        """Compute both answers and their errors; some seconds at most."""
        measure: Callable[[], Found] = named(f"{__package__}.{self.measured_by}")
        return measure()

    def cost(self, out: Path | None, progress: Callable[[float], None], error: float) -> Report:
        """Run both methods, and report what they give and their errors; it writes no files."""
        found = self.run()
        progress(1.0)
        naive = "no answer" if found.naive is None else f"error {found.naive:.1e}"
        text = (
            f"{self.title}: {self.why}",
            f"naive       {self.naive}",
            f"            {found.naive_gives}; {naive}",
            f"contactkit  {self.ours}",
            f"            {found.ours_gives}; error {found.ours:.1e}",
            f"error against {self.judge}",
        )
        return Report(
            {"naive / error": (found.naive, "-"), "contactkit / error": (found.ours, "-")},
            "\n".join(text),
        )
