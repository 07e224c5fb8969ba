"""Cases of a parametrised test that `make test` runs; the others are left to `make test-all`."""

from __future__ import annotations

import pytest

__all__ = ["quick"]


def quick(cases, *chosen):
    """Parameters of all cases, by position: those not chosen are marked as slow."""
    marks = {True: (), False: pytest.mark.slow}
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=marks[i in chosen])
        for i, case in enumerate(cases)
    ]
