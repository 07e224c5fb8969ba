"""Loads of a page: contacts solved under them, and what the grid does to their numbers."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from attrs import frozen

from ...accuracy import Accuracy
from ...analyses.load_curve import load_curve
from ...contact.discretisation import discretisation_error
from ...contact.result import ContactResult
from ...contact.solve import solve_unwarned
from ...errors import ContactkitError, DescriptionError
from ...planning import plan
from ...scene.loading import Approach, Pressing
from ...scene.scenes import ContactScene

__all__ = ["LOADS", "GridErrors", "grid_errors", "loads_of", "solved"]

Progress = Callable[[float], None]

LOADS = 6
"""Loads of a page, each half of the next: 1/32 of that of the scene to itself."""

_SERIES = {"force": "loads", "pressure": "pressures", "approach": "approaches"}


def loads_of(scene: ContactScene, loads: int | Sequence[float] | None) -> list[float]:
    """Loads, or approaches, of a page in ascending order, with that of the scene among them.

    Parameters
    ----------
    scene : ContactScene
        Its loading says what the numbers are: a force, a mean pressure, an approach.
    loads : int or sequence of float, optional
        How many, each half of the next, or which; `LOADS` of them if not given.

    Raises
    ------
    DescriptionError
        If the number is no count, or a loading of one's own has more than its own load.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Body(solid=ck.Material(young_modulus=210e9, poisson_ratio=0.3))
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(lower=steel), loading=ck.Pressing(force=8.0), effects=()
    ... )
    >>> loads_of(scene, 3), loads_of(scene, [2.0, 10.0])
    ([2.0, 4.0, 8.0], [2.0, 8.0, 10.0])
    """
    own = scene.loading.quantity
    if not isinstance(scene.loading, Pressing | Approach):
        if loads is not None and loads != 1:
            raise DescriptionError("loads", loads, f"be 1 for a loading {scene.loading.kind!r}")
        return [own.value]
    if loads is None or isinstance(loads, int):
        if isinstance(loads, bool) or (loads is not None and loads < 1):
            raise DescriptionError("loads", loads, "be a count of loads, 1 or more")
        # Nothing lies between no load and none; a pull has its approach behind it.
        n = (loads or LOADS) if own.value > 0.0 else 1
        return [own.value / 2.0**i for i in reversed(range(n))]
    return sorted({own.value, *map(float, loads)})


def solved(
    scene: ContactScene, accuracy: Accuracy, loads: Sequence[float], progress: Progress
) -> tuple[ContactResult, ...]:
    """Solve a contact under loads in ascending order; the page says what is out of range.

    Raises
    ------
    PlanError, InfeasibleError, ConvergenceError
        As `plan` and `solve` do, for any of the loads.
    """
    made = plan(scene, accuracy)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if len(loads) == 1:
            return (solve_unwarned(made),)
        series: dict[str, Any] = {_SERIES[scene.loading.quantity.name]: loads}
        return load_curve(made, keep_maps=True, progress=progress, **series).results


@frozen
class GridErrors:
    """Errors of the numbers of a contact by its grid [-], or why they are not known."""

    errors: Mapping[str, float]
    reason: str = ""


def grid_errors(result: ContactResult) -> GridErrors:
    """Estimate what the grid does to the numbers of a contact; see `discretisation_error`."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return GridErrors(discretisation_error(result).errors)
    except ContactkitError as error:
        return GridErrors({}, str(error))
