"""The motion of deforming bodies on a map, on two grids, and its result."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ....lubrication.elastohydrodynamic.maps.follow import MapControl
from ....lubrication.elastohydrodynamic.maps.motion import MapMotion, move_map
from ....lubrication.elastohydrodynamic.motion import Phase, with_times
from ....lubrication.elastohydrodynamic.step import StepFailedError
from ....scene.loading import PressAndPull
from ...curve_result import Work
from ..outcome import finished, not_followed, outcome_numbers
from ..result import DeformingResult
from ..validity import map_ranges
from .cells import Cells

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..plan import DeformingPlan
    from .film import MapFilm

    Array = NDArray[np.float64]

__all__ = ["pull_map_apart"]

# Cells and steps are of second order: a run of twice both has four times the error. At the edges
# of cavities and contacts the order is lower, and all of the difference is taken.
_SECOND_ORDER = 3.0
_SAME = 1e-9  # times over the last one that both runs have


def pull_map_apart(
    plan: DeformingPlan, phases: Sequence[Phase], speed: float, fields_at: Sequence[float]
) -> DeformingResult:
    """Run a plan whose film is on a map.

    Parameters
    ----------
    plan : DeformingPlan
        The plan.
    phases : sequence of Phase
        Of its loading.
    speed : float
        A speed that is characteristic [m/s].
    fields_at : sequence of float
        Times [s] whose maps are kept in any case.

    Raises
    ------
    ConvergenceError
        If a step cannot be solved: a gap closes where nothing can touch.
    """
    begun = clock.perf_counter()
    film: Any = plan.film
    loading = plan.scene.loading
    rested = [loading.rest] if isinstance(loading, PressAndPull) else []
    keep = sorted({*fields_at, *rested})
    try:
        coarse = _moved(plan, film.cells.coarser(), 2.0 * plan.change, phases, speed, keep)
        # A step of the fine run ends wherever one of the coarse run does, to be compared.
        both = with_times(phases, coarse.columns["time"][1:])
        motion = _moved(plan, film.cells, plan.change, both, speed, keep)
    except StepFailedError as error:
        raise not_followed(error, "in seconds") from None
    columns = _columns(plan, motion)
    pulled = motion.end_times[0] if rested else 0.0
    numbers = outcome_numbers(plan, motion, columns, pulled) | {
        "trapped_volume": _trapped(film, motion, pulled),
        "force_error": _error(columns, coarse.columns),
        "energy_error": _energy_error(film, columns),
        "liquid_error": _liquid_error(motion),
    }
    counts = motion.counts
    work = Work(counts.steps, counts.rejected, counts.newton, clock.perf_counter() - begun)
    validity = map_ranges(plan, film, motion, columns, numbers)
    return finished(plan, columns, motion.sections, motion.maps, numbers, validity, work)


def _moved(
    plan: DeformingPlan,
    cells: Cells,
    change: float,
    phases: Sequence[Phase],
    speed: float,
    keep: Sequence[float],
) -> MapMotion:
    film: Any = plan.film
    return move_map(
        film.wet_map(cells),
        film.gap,
        phases,
        MapControl(change=change, strength=film.strength),
        speed=speed,
        width=film.width,
        keep=keep,
    )


def _columns(plan: DeformingPlan, motion: MapMotion) -> dict[str, Array]:
    found = dict(motion.columns)
    found["wet_area"] = math.pi * found["rim_radius"] ** 2
    found["meniscus_force"] = np.zeros(len(found["time"]))
    return {name: found[name] for name in plan.columns}


def _error(fine: Mapping[str, Array], coarse: Mapping[str, Array]) -> float:
    """Estimated error of the pull, or of the gap where a force is imposed, over its largest."""
    times, others = fine["time"], coarse["time"]
    place = np.minimum(np.searchsorted(times, others * (1.0 - _SAME)), len(times) - 1)
    common = np.abs(times[place] - others) <= _SAME * others
    off = 0.0
    for name in ("pull", "gap"):
        largest = float(np.abs(fine[name]).max())
        differ = np.abs(fine[name][place] - coarse[name])[common]
        off = max(off, float(differ.max(initial=0.0)) / largest if largest else 0.0)
    is_smooth = not fine["void_volume"].any() and not fine["contact_area"].any()
    return off / _SECOND_ORDER if is_smooth else off


def _energy_error(film: MapFilm, columns: Mapping[str, Array]) -> float:
    """Work that is neither dissipated nor stored in the bodies or in cavities, over the largest."""
    stored = columns["elastic_energy"] - columns["elastic_energy"][0]
    void = columns["void_volume"]
    if void.any():
        stored = stored + film.cavity * void
    missing = columns["work"] - columns["dissipated_energy"] - stored
    largest = max(float(np.abs(columns[name]).max()) for name in ("work", "dissipated_energy"))
    return float(np.abs(missing[-1])) / largest if largest else 0.0


def _liquid_error(motion: MapMotion) -> float:
    """Liquid that is neither in the film nor went through its rim, over that at the start."""
    liquid = motion.columns["liquid_volume"]
    return float(abs(liquid[-1] - liquid[0] - motion.inflow) / liquid[0])


def _trapped(film: MapFilm, motion: MapMotion, pulled: float) -> float:
    """Liquid beyond the throat on the widest path to the rim [m3]: what pressing left.

    Of a dimple that of `run`, and of a rough film also that of valleys.
    """
    from scipy.ndimage import generate_binary_structure, grey_dilation

    k = int(np.abs(motion.maps["time"] - pulled).argmin())
    inside = film.places[2]
    gap = np.where(inside, motion.maps["gap"][k], np.inf)
    padded = np.pad(gap, 1, constant_values=np.inf)
    throat = np.where(np.isinf(padded), np.inf, 0.0)
    beside = generate_binary_structure(2, 1)
    while True:
        wider = np.minimum(padded, grey_dilation(throat, footprint=beside))
        if (wider <= throat).all():
            break
        throat = wider
    held = np.where(inside, motion.maps["liquid"][k] * motion.maps["gap"][k], 0.0)
    dy, dx = film.cells.pixel_size
    beyond = held - np.where(inside, throat[1:-1, 1:-1], 0.0)
    return float(np.maximum(beyond, 0.0).sum(dtype=np.float64)) * dy * dx
