"""Cases of a parametrised test that `make test` and `make test-all` run."""

from __future__ import annotations

import pytest

__all__ = ["quick"]


def quick(cases, *chosen, long=None):
    """Parameters of all cases, by position: those not chosen are marked as slow.

    Of these, if any are named as `long`, the others are exhaustive.
    """
    rest = pytest.mark.slow if long is None else pytest.mark.exhaustive
    marks = dict.fromkeys(long or (), pytest.mark.slow) | dict.fromkeys(chosen, ())
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=marks.get(i, rest))
        for i, case in enumerate(cases)
    ]
