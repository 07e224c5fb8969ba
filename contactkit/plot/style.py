"""Style of all figures: colours, axes, legends, panel letters, and saving."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

try:
    import matplotlib as mpl
    from cycler import cycler
except ModuleNotFoundError as error:
    from ..extras import missing_extra

    raise missing_extra(error, "contactkit.plot") or error from None
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle
from matplotlib.text import Text
from matplotlib.ticker import EngFormatter, LogLocator, NullFormatter

from ..errors import DescriptionError
from ..files.scenes import write_whole
from ..separation.columns import COLUMNS
from ..separation.effects.adhesion import VanDerWaalsForce
from ..separation.effects.meniscus import MeniscusForce
from ..separation.effects.viscous import ViscousForce

__all__ = [
    "COLORS",
    "SERIES",
    "STYLE",
    "Axes",
    "Figure",
    "ListedColormap",
    "Patch",
    "Rectangle",
    "bars",
    "figure",
    "legend",
    "letters",
    "mosaic",
    "mpl",
    "note",
    "plain_log",
    "prefixed_log",
    "save",
    "save_animation",
    "series",
    "shared_legend",
    "title",
]

SERIES: tuple[tuple[str, Any, str], ...] = (
    ("#000000", "-", "o"),
    ("#0072b2", "--", "s"),
    ("#d55e00", "-.", "^"),
    ("#009e73", ":", "D"),
    ("#cc79a7", (0, (5, 1, 1, 1, 1, 1)), "v"),
    ("#e69f00", (0, (8, 3)), "P"),
    ("#56b4e9", (0, (1, 1)), "X"),
)
"""Colour, line and marker of each series: the colours of Okabe and Ito, told apart by all readers,
and in grey by line and marker."""

COLORS = {
    "gap": COLUMNS["gap"].color or "",
    "speed": COLUMNS["speed"].color or "",
    "pull": COLUMNS["pull"].color or "",
    "meniscus": MeniscusForce.column.color or "",
    "viscous": ViscousForce.column.color or "",
    "solids": VanDerWaalsForce.column.color or "",
    "limit": "#e9c46a",
    "magnet": "#6a4c93",
    "spring": "#8d6b3d",
    "stop": "#444444",
}
"""One colour for each quantity, the same in every figure; effects declare theirs."""

STYLE: Any = {
    "font.size": 10.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "figure.dpi": 110,
    "savefig.dpi": 160,
    "axes.titlelocation": "left",
    "axes.titlesize": 11.0,
    "axes.prop_cycle": cycler(color=[colour for colour, *_ in SERIES]),
    "figure.constrained_layout.use": True,
    "hatch.linewidth": 0.5,
    "svg.hashsalt": "contactkit",  # the same names in a file every time
}

_MICRO = re.compile(r"(?<![\w$\\])u(?=(?:m[23]?|s|N|J|Pa)\b)")
_POWER = re.compile(r"(?<=[µnm]m)[23](?=\])")
_DEGREES = re.compile(r"(?<=\d) deg\b|\bdeg(?=C?\b)")
_UNDATED: dict[str, dict[str, None]] = {
    "png": {"Software": None},
    "pdf": {"CreationDate": None},
    "svg": {"Date": None},
}
"""What a file would otherwise state of the time and the program, by its kind."""


def series(i: int, **more: Any) -> dict[str, Any]:
    """Style of series `i`, as arguments of ``plot``.

    Examples
    --------
    >>> series(1, lw=1.0)
    {'color': '#0072b2', 'ls': '--', 'marker': 's', 'ms': 3.5, 'lw': 1.0}
    """
    colour, line, marker = SERIES[i % len(SERIES)]
    return {"color": colour, "ls": line, "marker": marker, "ms": 3.5} | more


def figure(
    rows: int = 1, columns: int = 1, size: tuple[float, float] = (7.0, 4.5), **grid: Any
) -> tuple[Figure, Any]:
    """Make a figure in the house style, without a window: the figure and its axes."""
    with mpl.rc_context(STYLE):
        made = Figure(figsize=size)
        return made, made.subplots(rows, columns, **grid)


def mosaic(
    panels: Sequence[Sequence[str]], size: tuple[float, float] = (7.0, 4.5), **grid: Any
) -> tuple[Figure, dict[str, Axes]]:
    """Make a figure whose panels span several places: the figure and its axes by name."""
    with mpl.rc_context(STYLE):
        made = Figure(figsize=size)
        return made, made.subplot_mosaic([list(row) for row in panels], **grid)


def save(made: Figure, path: str | Path, **more: Any) -> Path:
    """Write a figure as PNG, PDF or SVG, by its suffix, completely or not at all.

    The same figure gives the same bytes every time.

    Parameters
    ----------
    made : Figure
        The figure; ``ax.figure`` of any axes.
    path : str or Path
        File ending in ``.png``, ``.pdf`` or ``.svg``; PNG if it has no suffix.
    **more
        Further arguments of ``Figure.savefig``, such as ``dpi``.

    Raises
    ------
    DescriptionError
        If the suffix is another one.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> made, ax = figure()
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(made, Path(folder) / "empty.svg").suffix
    '.svg'
    """
    path = Path(path)
    path = path if path.suffix else path.with_suffix(".png")
    kind = path.suffix.lower().removeprefix(".")
    if kind not in _UNDATED:
        raise DescriptionError("save.path", str(path), "end in .png, .pdf or .svg")
    _set_in_print(made)
    with write_whole(path) as temporary, mpl.rc_context(STYLE):
        made.savefig(temporary, format=kind, **({"metadata": _UNDATED[kind]} | more))
    return path


def save_animation(
    made: Figure,
    path: str | Path,
    draw: Callable[[int], Sequence[Any]],
    pictures: int,
    rate: int,
    *,
    first: Sequence[Any],
) -> Path:
    """Write an animation as GIF, completely or not at all.

    Parameters
    ----------
    made : Figure
        The figure.
    path : str or Path
        File ending in ``.gif``.
    draw : callable
        Draws a picture by its number, and returns what it drew.
    pictures : int
        How many there are.
    rate : int
        Pictures a second.
    first : sequence
        What the figure shows already.

    Raises
    ------
    DescriptionError
        If the suffix is another one.
    """
    from matplotlib.animation import FuncAnimation, PillowWriter

    path = Path(path)
    if path.suffix.lower() != ".gif":
        raise DescriptionError("animate.path", str(path), "end in .gif")
    film = FuncAnimation(made, draw, frames=pictures, init_func=lambda: first)
    with write_whole(path) as temporary:
        film.save(temporary, writer=PillowWriter(fps=rate), dpi=72)
    return path


def title(ax: Axes, text: str) -> None:
    """Title of a panel, at its left."""
    ax.set_title(text, loc="left", fontsize=11)


def note(ax: Axes, text: str, height: float, *, below: bool = False) -> None:
    """Small note at the left of a panel, above or below a height of its data."""
    ax.annotate(
        text,
        (0.0, height),
        xycoords=("axes fraction", "data"),
        xytext=(4, -10 if below else 3),
        textcoords="offset points",
        color="0.4",
        fontsize=8,
    )


def legend(ax: Axes, **more: Any) -> None:
    """Legend without a frame."""
    ax.legend(**({"frameon": False, "fontsize": 9} | more))


def shared_legend(made: Figure, ax: Axes) -> None:
    """One legend below all panels, from the curves of one of them, in as many rows as needed."""
    handles, labels = ax.get_legend_handles_labels()
    widest = 0.6 + 0.085 * max(map(len, labels))  # [inch]
    columns = max(1, min(len(labels), int(made.get_figwidth() / widest)))
    made.legend(handles, labels, loc="outside lower center", ncols=columns, frameon=False)


def plain_log(axis: Axis) -> None:
    """Label a logarithmic axis at 1, 2 and 5, without powers of ten."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def prefixed_log(axis: Axis, factor: float, unit: str) -> None:
    """Label a logarithmic axis of many decades by prefixes, such as 10 ns and 1 µs.

    Its data times `factor` are in the unit.
    """
    prefixed = EngFormatter(unit=unit)
    axis.set_major_locator(LogLocator(numticks=5))
    axis.set_major_formatter(lambda x, _: prefixed(x * factor))
    axis.set_minor_formatter(NullFormatter())


def letters(axes: Iterable[Axes], titles: Sequence[str] | None = None) -> None:
    """Number panels (a), (b) ... and name them; they keep their titles if none are given."""
    panels = list(axes)
    names = [ax.get_title(loc="left") for ax in panels] if titles is None else titles
    for i, (ax, text) in enumerate(zip(panels, names, strict=True)):
        ax.set_title(f"({chr(97 + i)}) {text}".rstrip(), loc="left", fontsize=10)


def _set_in_print(made: Figure) -> None:
    """Write units in all texts of a figure with µ and °: labels may come from tables in ASCII."""
    for text in made.findobj(Text):
        given = text.get_text()
        changed = _POWER.sub(lambda found: "²³"[int(found[0]) - 2], _MICRO.sub("µ", given))
        changed = _DEGREES.sub("°", changed)
        if changed != given:
            text.set_text(changed)


def bars(names: Sequence[str], values: Sequence[float], ax: Axes, label: str) -> Axes:
    """Draw a bar for each of some names, from the top down."""
    places = list(range(len(names)))
    ax.barh(places, values, color=COLORS["gap"], height=0.6)
    ax.set_yticks(places, names)
    ax.invert_yaxis()
    ax.set_xlabel(label)
    ax.grid(visible=False, axis="y")
    return ax
