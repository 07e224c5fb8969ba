"""Sliders of a separation: the quantities and ranges of its live page, as texts with a unit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from attrs import frozen

from ..errors import ContactkitError
from ..liquids.temperature_table import liquid_table
from ..live_page.scene import check_scene, kernel_scene
from ..live_page.sliders import Slider, family_sliders, sliders_of
from .form import Made, Part

__all__ = ["Mover", "movers_of"]

_STEPS = 40  # on each side of the start, so that a step of a decade is some 6 %
_UNITS = {"°C": "degC"}


@frozen(kw_only=True)
class Mover:
    """A slider: the fields that it moves together, and its numbers in a unit that reads well.

    `start` is the number that it begins with, `text` the text of the scene for it.
    """

    paths: tuple[str, ...]
    label: str
    unit: str
    numbers: tuple[float, ...]
    start: float
    text: str

    def text_of(self, number: float) -> str:
        """Text of a scene file for a number of the slider."""
        if number == self.start:
            return self.text
        return f"{number:g}" if self.unit == "-" else f"{number:g} {self.unit}"


def movers_of(made: Made, parts: Sequence[Part], typed: Mapping[str, str]) -> tuple[Mover, ...]:
    """Sliders of a separation; none of a scene that a live page cannot carry.

    Parameters
    ----------
    made : Made
        The scene in the middle of the ranges.
    parts : sequence of Part
        Its form; a quantity without a widget there has no slider.
    typed : mapping of str to str
        Texts of the form by path, where they differ from those it began with.
    """
    texts = {widget.path: widget.value for part in parts for widget in part.widgets} | dict(typed)
    if made.opened is None:
        return ()
    try:
        kernel = kernel_scene(check_scene(made.opened.scene), made.opened.accuracy)
        table = liquid_table(kernel.scene.meniscus.liquid)
        found = (*sliders_of(kernel, table), *family_sliders(kernel, table))
    except ContactkitError:  # the form has a box for each field all the same
        return ()
    return tuple(
        _mover(slider, texts[slider.paths[0]])
        for slider in found
        if slider.paths[0] in texts and slider.low < slider.value < slider.high
    )


def _mover(slider: Slider, text: str) -> Mover:
    first, middle, last = map(slider.place, (slider.low, slider.value, slider.high))
    places = [i / _STEPS for i in range(_STEPS + 1)]
    spread = [*(first + (middle - first) * f for f in places)]
    spread += [middle + (last - middle) * f for f in places[1:]]
    start = _number(slider, slider.value, 12)
    numbers = {_number(slider, slider.value_at(place), 3) for place in spread}
    return Mover(
        paths=slider.paths,
        label=slider.label,
        unit=_UNITS.get(slider.unit, slider.unit),
        numbers=tuple(sorted(numbers | {start})),
        start=start,
        text=text,
    )


def _number(slider: Slider, value: float, digits: int) -> float:
    return float(f"{(value - slider.shift) / slider.factor:.{digits}g}")
