"""Elements of marimo for the choices and widgets of a form, and their values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

import marimo as mo

from ..plot.axis_units import in_print
from .form import EFFECTS, Choice, Part
from .movers import Mover
from .widgets import Widget

__all__ = ["BETWEEN", "choice_elements", "chosen_of", "field_elements", "values_of"]

BETWEEN = "|"
"""What is between the paths that a slider moves together, in the key of its element."""

_MANY = 8  # choices from which on a list is searched


def choice_elements(choices: Sequence[Choice]) -> Any:
    """A dictionary of elements, by path, for choices."""
    return mo.ui.dictionary({one.path: _of_choice(one) for one in choices})


def _of_choice(choice: Choice) -> Any:
    if choice.path == EFFECTS:
        return mo.ui.multiselect(choice.options, value=list(choice.chosen), label="effects")
    return mo.ui.dropdown(
        choice.options,
        value=choice.chosen,
        label=choice.label,
        searchable=len(choice.options) > _MANY,
        allow_select_none=False,
    )


def chosen_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """Names that are chosen, by path, from the values of `choice_elements`."""
    return {path: tuple(v) if isinstance(v, list) else v for path, v in values.items()}


def field_elements(
    parts: Sequence[Part], texts: Mapping[str, Any], movers: Sequence[Mover] = ()
) -> Any:
    """A dictionary of elements for the widgets of some parts; sliders in place of some.

    Parameters
    ----------
    parts : sequence of Part
        Parts of a form.
    texts : mapping of str to str
        Texts to begin with, by path; those of the widgets where it has none.
    movers : sequence of Mover
        Sliders; their paths are keys, with bars between them.
    """
    moved = {path for mover in movers for path in mover.paths}
    found: dict[str, Any] = {}
    for part in parts:
        for widget in part.widgets:
            slider = next((one for one in movers if one.paths[0] == widget.path), None)
            if slider is not None:
                found[BETWEEN.join(slider.paths)] = _slider(slider)
            elif widget.path not in moved:
                found[widget.path] = _element(widget, texts.get(widget.path, widget.value))
    return mo.ui.dictionary(found)


def _slider(mover: Mover) -> Any:
    unit = "" if mover.unit == "-" else f" [{in_print(mover.unit)}]"
    return mo.ui.slider(
        steps=mover.numbers,
        value=mover.start,
        label=f"{mover.label}{unit}",
        show_value=True,
        debounce=True,
    )


def _element(widget: Widget, text: Any) -> Any:
    label = _label(widget)
    if widget.takes == "flag":
        return mo.ui.checkbox(value=text in (True, "yes"), label=label)
    if widget.takes == "choice":
        shown = str(text) if str(text) in widget.options else widget.options[0]
        names = {option or "not given": option for option in widget.options}
        start = next(name for name, option in names.items() if option == shown)
        return mo.ui.dropdown(names, value=start, label=label, allow_select_none=False)
    hint = widget.default or ("" if widget.is_required else "not given")
    return mo.ui.text(value=str(text), placeholder=hint, label=label)


def _label(widget: Widget) -> str:
    """Name of a field, its help where the pointer rests on it."""
    unit = f" [{widget.unit}]" if widget.unit not in ("", "-") else ""
    said = f"{widget.help} It must {widget.expected}{unit}." if widget.expected else widget.help
    return f'<span title="{escape(said, quote=True)}">{escape(widget.label)}</span>'


def values_of(values: Mapping[str, Any], movers: Sequence[Mover] = ()) -> dict[str, Any]:
    """Texts by path of the values of `field_elements`."""
    found = dict(values)
    for mover in movers:
        number = found.pop(BETWEEN.join(mover.paths))
        found |= dict.fromkeys(mover.paths, mover.text_of(number))
    return found
