"""Views of a page: the whole window on as many cells as there is room for, and a close-up."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...contact.effects.stress import SubsurfaceStress
from ..assembly import packed
from .images import COARSE, FINE, Image, Images, Region, cell_factor, reduced, top_of
from .maps import Outline, ShownMap, outlines, shown_maps
from .stress import SHOWN, StressMap, places_of, stress_maps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...contact.result import ContactResult
    from .images import Kept

    Map = NDArray[np.float64]

__all__ = ["Views", "views_of"]

Progress = Callable[[float], None]

# Cells along a side of a map at most: the first that leaves the packed maps below the limit. A
# phone shows 340 and a screen 420; 256 cells of a rough contact take 0.15 MB under each load.
_CELLS = (256, 192, 128, 96, 64)
_STRESS_CELLS = (128, 64, 43, 32)
_LARGEST = 1_700_000  # characters of the packed maps of the window
_LARGEST_STRESS = 1_000_000  # and of its stress
_CLOSE = 64  # pixels along a side of the close-up, in which spots of some pixels are seen


class Views(NamedTuple):
    """Data of the scripts about maps, and the bytes of maps and of planes of stress."""

    views: list[dict[str, Any]]
    outlines: list[dict[str, str]]
    planes: list[str]
    maps: bytes
    stress: bytes


def views_of(results: Sequence[ContactResult], own: int, progress: Progress) -> Views:
    """Maps and planes of stress of contacts; the close-up is around the peak of one of them."""
    pixel = results[0].plan.grid.pixel_size
    ny, nx = results[0].pressure.shape
    window = Region(slice(0, ny), slice(0, nx))
    close = _around(results[own].pressure)
    maps, areas = shown_maps(results), outlines(results)
    images, surface = _fitting(
        lambda most, into: _surface(maps, areas, window, pixel, most, into), _CELLS, _LARGEST
    )
    views = [_place("window", window, pixel) | {"surface": surface, "stress": None}]
    planes, labels = Images(), list[str]()
    has_stress = all(result.has(SubsurfaceStress) for result in results)
    stack = list[list[list[dict[str, StressMap]]]]()
    factor = cell_factor((ny, nx), _STRESS_CELLS[0])
    if has_stress:
        places = places_of(results[-1])
        labels = [place.label for place in places]
        for i, result in enumerate(results):
            stack.append(list(stress_maps(result, places, ((window, factor), (close, 1)))))
            progress((i + 1) / len(results))
        planes, views[0]["stress"] = _fitting(
            lambda most, into: _stress(stack, 0, factor, most, into),
            _STRESS_CELLS,
            _LARGEST_STRESS,
        )
    factors = [one["factor"] for one in (surface, views[0]["stress"]) if one]
    if max(factors) > 1 and close.shape != (ny, nx) and results[own].contact.any():
        views.append(
            _place("close-up", close, pixel)
            | {
                "surface": _surface(maps, areas, close, pixel, _CLOSE, images),
                "stress": _stress(stack, 1, 1, _CLOSE, planes) if has_stress else None,
            }
        )
    named = [{"name": one.name, "label": one.label} for one in areas]
    return Views(views, named, labels, images.content, planes.content)


def _around(pressure: Map) -> Region:
    """Pixels around the maximum of the pressure, inside the window."""
    peak = np.unravel_index(int(np.argmax(pressure)), pressure.shape)

    def along(at: int, n: int) -> slice:
        first = min(max(at - _CLOSE // 2, 0), max(n - _CLOSE, 0))
        return slice(first, min(first + _CLOSE, n))

    rows, columns = (along(int(i), n) for i, n in zip(peak, pressure.shape, strict=True))
    return Region(rows, columns)


def _place(name: str, region: Region, pixel: tuple[float, float]) -> dict[str, Any]:
    """Place and size of a view [m]."""
    (ny, nx), (dy, dx) = region.shape, pixel
    x, y = region.columns.start * dx, region.rows.start * dy
    return {"name": name, "x": x, "y": y, "width": nx * dx, "height": ny * dy}


def _fitting(
    make: Callable[[int, Images], dict[str, Any]], cells: Sequence[int], largest: int
) -> tuple[Images, dict[str, Any]]:
    """Maps on the most cells whose bytes, packed, are below a limit; else on the fewest."""
    images, found = Images(), dict[str, Any]()
    for most in cells:
        images = Images()
        found = make(most, images)
        if len(packed(images.content)) < largest:
            break
    return images, found


def _surface(
    maps: Sequence[ShownMap],
    areas: Sequence[Outline],
    region: Region,
    pixel: tuple[float, float],
    most: int,
    images: Images,
) -> dict[str, Any]:
    """Maps over a region and the bits of the outlines."""
    factor = cell_factor(region.shape, most)
    made = _Drawn(region, factor, pixel, images)
    bits = [
        sum(
            (reduced(region.of(one.values[i]), factor, "largest") > 0) * np.uint8(1 << bit)
            for bit, one in enumerate(areas)
        )
        for i in range(len(maps[0].values))
    ]
    return {
        "factor": factor,
        "shape": list(np.shape(bits[0])),
        "maps": [made.map(one) for one in maps],
        "flags": [images.add_flags(np.asarray(one, dtype=np.uint8)) for one in bits],
    }


class _Drawn:
    """Maps of one region, of which those that are alike are kept once."""

    def __init__(
        self, region: Region, factor: int, pixel: tuple[float, float], images: Images
    ) -> None:
        self._region, self._factor, self._pixel, self._images = region, factor, pixel, images
        self._kept: list[tuple[Map, Image]] = []

    def map(self, one: ShownMap) -> dict[str, Any]:
        """Return where a map lies under each load; heights are the same under all of them."""
        return {
            "name": one.name,
            "label": one.label,
            "unit": one.unit,
            "images": [[self._image(values, one.kept)] for values in one.values],
        }

    def _image(self, values: Map, kept: Kept) -> dict[str, Any]:
        cells = reduced(self._region.of(values), self._factor, kept)
        image = next(filter(None, (_scaled(cells, *known) for known in self._kept)), None)
        if image is None:
            image = self._images.add(cells, FINE)
            self._kept.append((cells, image))
        return image._asdict() | {"top": top_of(values, self._region, self._pixel)}


def _scaled(cells: Map, known: Map, image: Image) -> Image | None:
    """Image of a map that is a multiple of one that is kept, such as friction of the pressure."""
    if known is cells or np.array_equal(known, cells, equal_nan=True):
        return image
    most = np.nanmax(np.abs(known), initial=0.0)
    ratio = float(np.nanmax(np.abs(cells), initial=0.0)) / most if most > 0.0 else 0.0
    if ratio <= 0.0 or not np.allclose(cells, ratio * known, 1e-12, 0.0, equal_nan=True):
        return None
    return image._replace(low=ratio * image.low, step=ratio * image.step)


def _stress(
    stack: Sequence[Sequence[Sequence[Mapping[str, StressMap]]]],
    view: int,
    factor: int,
    most: int,
    images: Images,
) -> dict[str, Any]:
    """Measures on the planes of a view under each load; `factor` pixels are a cell already."""
    wider = cell_factor(stack[0][0][view]["tension"].values.shape, most)

    def image(one: StressMap) -> dict[str, Any]:
        cells = reduced(one.values, wider, "largest")
        return images.add(cells, COARSE)._asdict() | {"top": one.top}

    made = [
        {
            "name": name,
            "label": label,
            "unit": "Pa",
            "images": [[image(plane[view][name]) for plane in planes] for planes in stack],
        }
        for name, label in SHOWN.items()
    ]
    shape = reduced(stack[0][0][view]["tension"].values, wider, "largest").shape
    return {"factor": factor * wider, "shape": list(shape), "maps": made}
