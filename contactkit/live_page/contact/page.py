"""Page of solved contacts: what its scripts read, and the bytes of its maps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...accuracy import Accuracy
from ...contact.effects.base import Attraction
from ...contact.effects.stress import SubsurfaceStress
from ...contact.result import ContactResult
from ...errors import DescriptionError
from ...files.scenes import scene_text, unstructure
from ...reading.references import references_from
from ..assembly import assembled, file_name, packed
from .images import COARSE, FINE, Images, cell_factor, peak_of, reduced
from .loads import GridErrors, grid_errors
from .maps import ShownMap, outlines, shown_maps
from .numbers import axis_of, charts, numbers_of, shown_quantity, validity_of
from .stress import SHOWN, StressMap, places_of, stress_maps

if TYPE_CHECKING:
    from ...scene.scenes import ContactScene

__all__ = ["PageOfContact", "contact_page", "page_of"]

Progress = Callable[[float], None]

_SCRIPTS = ("chart.js", "map.js", "contact.js")
# Cells along a side of a map at most, from the first that leaves the bytes below the limit. A phone
# shows 340, a screen 520; a third of a megabyte is what the maps of a rough contact of 256 cells
# take under one load.
_CELLS = (256, 192, 128, 96, 64)
_STRESS_CELLS = (128, 64, 32)
_LARGEST = 1_300_000  # characters of the packed maps, and again of the packed stress


class PageOfContact(NamedTuple):
    """What the scripts of a page read, and the bytes of its maps."""

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
    surface, maps = _surface(results)
    stress, planes = _stress(results, lambda done: progress(0.5 + 0.5 * done))
    made, rows = charts(results, errors)
    plan, scene = first.plan, first.plan.scene
    (ny, nx), (dy, dx) = plan.grid.shape, plan.grid.pixel_size
    tables, reason = _tables(scene, plan.accuracy)
    off = [kind for kind in plan.known_effects if not plan.has(kind)]
    data = {
        "title": scene.name or "Contact",
        "name": file_name(scene.name, "contact"),
        "axis": axis_of(first),
        "own": len(results) - 1 if own is None else _imposed(results).index(own),
        "loads": [_load(*pair) for pair in zip(results, errors, strict=True)],
        "window": {"width": nx * dx, "height": ny * dy, "pixel": [dy, dx], "pixels": [ny, nx]},
        "surface": surface,
        "stress": stress,
        "charts": made,
        "rows": rows,
        "levels": {"maps": FINE, "planes": COARSE},
        "held": _held(results, surface, stress, errors),
        "on": [f"{effect.name}: {effect.summary}" for effect in scene.effects],
        "off": [f"{kind.name}: {kind.summary}" for kind in off],
        "sources": plan.cite().splitlines(),
        "scene": tables,
        "reason": reason,
    }
    return PageOfContact(data, {"maps": maps, "planes": planes})


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


# Maps -----------------------------------------------------------------------------------------


def _surface(results: Sequence[ContactResult]) -> tuple[dict[str, Any], bytes]:
    """Maps over the window and the bits of outlines, on as many cells as there is room for."""
    maps, areas = shown_maps(results), outlines(results)
    pixel, images = results[0].plan.grid.pixel_size, Images()
    found: dict[str, Any] = {}
    for most in _CELLS:
        factor, images = cell_factor(results[0].pressure.shape, most), Images()
        made = [_of_map(one, factor, pixel, images) for one in maps]
        bits = [
            sum(
                (reduced(one.values[i], factor, "largest") > 0) * np.uint8(1 << bit)
                for bit, one in enumerate(areas)
            )
            for i in range(len(results))
        ]
        found = {
            "factor": factor,
            "shape": list(np.shape(bits[0])),
            "maps": made,
            "outlines": [{"name": one.name, "label": one.label} for one in areas],
            "flags": [images.add_flags(np.asarray(one, dtype=np.uint8)) for one in bits],
        }
        if len(packed(images.content)) < _LARGEST:
            break
    return found, images.content


def _of_map(
    one: ShownMap, factor: int, pixel: tuple[float, float], images: Images
) -> dict[str, Any]:
    """A map under each load; heights, which are the same under all of them, are kept once."""
    kept: dict[int, dict[str, Any]] = {}
    for values in one.values:
        if id(values) not in kept:
            cells = reduced(values, factor, one.kept)
            kept[id(values)] = images.add(cells, FINE)._asdict() | {"top": peak_of(values, pixel)}
    return {
        "name": one.name,
        "label": one.label,
        "unit": one.unit,
        "kept": one.kept,
        "images": [[kept[id(values)]] for values in one.values],
    }


def _stress(
    results: Sequence[ContactResult], progress: Progress
) -> tuple[dict[str, Any] | None, bytes]:
    """Measures of the stress on planes under each load, where the scene lists it."""
    if not all(result.has(SubsurfaceStress) for result in results):
        return None, b""
    places, planes = places_of(results[-1]), list[list[dict[str, StressMap]]]()
    factor = cell_factor(results[0].pressure.shape, _STRESS_CELLS[0])
    for i, result in enumerate(results):
        planes.append(list(stress_maps(result, places, factor)))
        progress((i + 1) / len(results))
    images, found = Images(), dict[str, Any]()
    for most in _STRESS_CELLS:
        wider = cell_factor(planes[0][0]["tension"].values.shape, most)
        images = Images()
        made = [
            {
                "name": name,
                "label": label,
                "unit": "Pa",
                "kept": "largest",
                "images": [
                    [_of_stress(plane[name], wider, images) for plane in of_load]
                    for of_load in planes
                ],
            }
            for name, label in SHOWN.items()
        ]
        shape = reduced(planes[0][0]["tension"].values, wider, "largest").shape
        found = {"factor": factor * wider, "shape": list(shape), "maps": made}
        if len(packed(images.content)) < _LARGEST:
            break
    return found | {"planes": [place.label for place in places]}, images.content


def _of_stress(one: StressMap, wider: int, images: Images) -> dict[str, Any]:
    cells = reduced(one.values, wider, "largest")
    return images.add(cells, COARSE)._asdict() | {"top": one.peak}


# Words ----------------------------------------------------------------------------------------


def _held(
    results: Sequence[ContactResult],
    surface: Mapping[str, Any],
    stress: Mapping[str, Any] | None,
    errors: Sequence[GridErrors],
) -> list[str]:
    """What the page rounds and leaves out, in sentences."""
    found = [_cells("Maps", surface, FINE)]
    if stress is not None:
        found.append(_cells("Stress", stress, COARSE))
    found.append("Numbers, maxima and curves are those of all pixels.")
    if results[0].plan.scene.effect(Attraction) is not None:
        found.append("Each state is that of an approach, from the smaller load before it.")
    reasons = list(dict.fromkeys(one.reason for one in errors if one.reason))
    found += [f"No error of the grid under some loads: {reason}" for reason in reasons]
    return found


def _cells(what: str, made: Mapping[str, Any], levels: int) -> str:
    factor = made["factor"]
    rounded = f"values are rounded to 1/{levels} of the range of each map"
    if factor == 1:
        return f"{what}: one cell for each pixel; {rounded}."
    kept = "its smallest gap and otherwise its largest value" if what == "Maps" else "its maximum"
    return (
        f"{what}: cells of {factor} x {factor} pixels, each with {kept}, and in contact where one "
        f"of its pixels is; {rounded}."
    )


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
