"""Page of solved contacts: what its scripts read, and the bytes of its maps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ...accuracy import Accuracy
from ...contact.effects.base import Attraction
from ...contact.result import ContactResult
from ...errors import DescriptionError
from ...files.scenes import scene_text, unstructure
from ...reading.references import references_from
from ..assembly import assembled, file_name
from .images import COARSE, FINE
from .loads import GridErrors, grid_errors
from .numbers import axis_of, charts, numbers_of, shown_quantity, validity_of
from .views import views_of

if TYPE_CHECKING:
    from ...scene.scenes import ContactScene

__all__ = ["PageOfContact", "contact_page", "page_of"]

Progress = Callable[[float], None]

_SCRIPTS = ("chart.js", "map.js", "contact.js")


class PageOfContact(NamedTuple):
    """Data of the scripts of a page, and the bytes of its maps."""

    data: dict[str, Any]
    images: dict[str, bytes]


def contact_page(
    results: Sequence[ContactResult], progress: Progress, own: float | None = None
) -> str:
    """Return the text of the page of contacts solved under one load or several; see `page_of`."""
    made = page_of(results, progress, own)
    remark = "the page holds solved contacts; nothing is computed elsewhere or sent anywhere"
    return assembled(made.data, "contact.html", _SCRIPTS, remark, made.images)


def page_of(
    results: Sequence[ContactResult], progress: Progress, own: float | None = None
) -> PageOfContact:
    """Return what the scripts of a page read.

    Parameters
    ----------
    results : sequence of ContactResult
        Contacts of the same bodies and effects on the same grid, loads ascending.
    progress : callable
        Called with the fraction that is done.
    own : float, optional
        Load that the page opens with, in the quantity of the loading; the last one if not given.

    Raises
    ------
    DescriptionError
        If there is none, or they are not alike.
    """
    _check_alike(results)
    errors = []
    for i, result in enumerate(results):
        errors.append(grid_errors(result))
        progress(0.5 * (i + 1) / len(results))
    first = results[0]
    shown = len(results) - 1 if own is None else _imposed(results).index(own)
    seen = views_of(results, shown, lambda done: progress(0.5 + 0.5 * done))
    made, rows = charts(results, errors)
    plan, scene = first.plan, first.plan.scene
    tables, reason = _tables(scene, plan.accuracy)
    off = [kind for kind in plan.known_effects if not plan.has(kind)]
    data = {
        "title": scene.name or "Contact",
        "name": file_name(scene.name, "contact"),
        "axis": axis_of(first),
        "own": shown,
        "loads": [_load(*pair) for pair in zip(results, errors, strict=True)],
        "pixel": list(plan.grid.pixel_size),
        "views": seen.views,
        "outlines": seen.outlines,
        "planes": seen.planes,
        "charts": made,
        "rows": rows,
        "levels": {"maps": FINE, "planes": COARSE},
        "held": _held(results, seen.views[0], errors),
        "on": [f"{effect.name}: {effect.summary}" for effect in scene.effects],
        "off": [f"{kind.name}: {kind.summary}" for kind in off],
        "sources": plan.cite().splitlines(),
        "scene": tables,
        "reason": reason,
    }
    return PageOfContact(data, {"maps": seen.maps, "planes": seen.stress})


def _check_alike(results: Sequence[ContactResult]) -> None:
    if not results or not all(isinstance(one, ContactResult) for one in results):
        raise DescriptionError("results", list(results), "be solved contacts, one or more")
    first = results[0].plan
    for one in results[1:]:
        if one.plan.scene.effects != first.scene.effects or one.plan.grid != first.grid:
            raise DescriptionError(
                "results", one.plan.title, "have the effects and the grid of the first"
            )


def _imposed(results: Sequence[ContactResult]) -> list[float]:
    return [result.plan.scene.loading.quantity.value for result in results]


def _load(result: ContactResult, errors: GridErrors) -> dict[str, Any]:
    """What a page writes about one load."""
    _, value, unit = result.plan.scene.loading.quantity
    fraction, peak = result.contact_fraction, shown_quantity(result.max_pressure, "Pa")
    return {
        "value": value,
        "text": shown_quantity(value, unit),
        "outcome": f"{100.0 * fraction:.3g} % of the window in contact, maximum pressure {peak}"
        if fraction > 0.0
        else result.message,
        "is_fine": result.status == "converged",
        "numbers": numbers_of(result, errors),
        **validity_of(result.validity),
    }


# Words ----------------------------------------------------------------------------------------


def _held(
    results: Sequence[ContactResult],
    window: Mapping[str, Any],
    errors: Sequence[GridErrors],
) -> list[str]:
    """What the page rounds and leaves out, in sentences."""
    found = [_cells("Maps", window["surface"], FINE)]
    if window["stress"] is not None:
        found.append(_cells("Stress", window["stress"], COARSE))
    found.append("Numbers, maxima and curves are those of all pixels.")
    if len(results) > 1 and results[0].plan.scene.effect(Attraction) is not None:
        found.append("Each state is that of an approach, from the smaller load before it.")
    reasons = list(dict.fromkeys(one.reason for one in errors if one.reason))
    found += [f"No error of the grid under some loads: {reason}" for reason in reasons]
    return found


def _cells(what: str, made: Mapping[str, Any], levels: int) -> str:
    factor = made["factor"]
    rounded = f"values are rounded to 1/{levels} of the range of each map"
    if factor == 1:
        return f"{what}: one cell for each pixel; {rounded}."
    kept = (
        "its smallest gap, otherwise its largest value, and in contact where one of its pixels is, "
        "so that areas look larger than they are"
        if what == "Maps"
        else "its maximum"
    )
    return f"{what}: cells of {factor} x {factor} pixels, each with {kept}; {rounded}."


def _tables(scene: ContactScene, accuracy: Accuracy) -> tuple[dict[str, Any] | None, str]:
    """Tables of the scene file, or the reason why a file could not hold the scene."""
    try:
        scene_text(scene, "the scene of the page")
        # As found from the working folder: a page that is passed on names no folder of its maker.
        tables: dict[str, Any] = references_from(unstructure(scene), Path("scene.toml"))
    except DescriptionError as error:
        return None, str(error)
    given = {name: getattr(accuracy, name) for name in sorted(accuracy.given)}
    level = {} if accuracy.level == Accuracy.standard.level else {"level": accuracy.level}
    return tables | ({"accuracy": level | given} if level or given else {}), ""
