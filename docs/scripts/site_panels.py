"""Panels of a figure, found in its picture: for phones, which show one a row.

A panel is an axis box with its labels, and with its colour bar. Boxes are found by their frames,
which are straight lines; a picture is cut where a strip of background runs from edge to edge
between two of them. What cannot be cut so stays whole.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from PIL import Image

LEAST = 230  # pixels of a panel: smaller ones would be enlarged, and blurred
BAR = 0.22  # an upright box narrower than this over its height is a colour bar
TITLE = 8  # pixels: a title is higher, and the uppermost number of an axis is not
WORDS = 20  # pixels: words of a label are closer than that
GUTTER = 5  # pixels: letters of a label are closer than that


@dataclass(frozen=True)
class Box:
    """A rectangle of a picture in pixels; the ends are not part of it."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def width(self) -> int:
        """Columns."""
        return self.right - self.left

    @property
    def height(self) -> int:
        """Rows."""
        return self.bottom - self.top


def panels(path: Path) -> tuple[tuple[int, int], list[Box]]:
    """Size of a picture, and its panels in reading order: none if it is one, or cannot be cut."""
    pixels = np.asarray(opaque(path).convert("L"), dtype=np.int16)
    height, width = pixels.shape
    ink = np.abs(pixels - pixels[0, 0]) > 12
    frames = frames_of(pixels)
    found = [box for row in rows_of(ink, frames) for box in columns_of(ink, frames, row)]
    small = any(box.width < LEAST for box in found)
    return (width, height), [] if len(found) < 2 or small else found


def opaque(path: Path) -> Image.Image:
    """A picture without transparency."""
    with Image.open(path) as image:
        shown = image.convert("RGBA")
    return Image.alpha_composite(Image.new("RGBA", shown.size, "white"), shown).convert("RGB")


def spans(filled: np.ndarray) -> list[tuple[int, int]]:
    """Ranges over which an array of truths is true."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], filled, [False]))))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def frames_of(pixels: np.ndarray) -> list[Box]:
    """Boxes whose left and lower edges are dark lines that meet."""
    dark = pixels < 110
    found: list[Box] = []
    for left in range(pixels.shape[1] - 1):
        for top, bottom in spans(dark[:, left]):
            if bottom - top < 60 or any(
                box.left <= left < box.right and box.top <= top + 3 and box.bottom >= bottom - 3
                for box in found
            ):
                continue
            below = dark[max(bottom - 3, 0) : bottom + 1, left:]
            reach = max(int(np.argmin(np.append(line, False))) for line in below)
            if reach >= 8:
                found.append(Box(left, top, left + reach, bottom))
    return [box for box in found if box.width > BAR * box.height]


def rows_of(ink: np.ndarray, frames: list[Box]) -> list[Box]:
    """The picture cut between frames that lie above each other.

    What stands between two rows is the label of the upper one, then perhaps a title of the lower,
    which is nearer to its frame.
    """
    if not frames:
        return []
    height, width = ink.shape
    filled = ink.any(axis=1)
    has_titles = filled[: min(box.top for box in frames) - TITLE].any()
    gaps = [gap for gap in spans(~filled) if gap[1] - gap[0] >= 2]

    def between_rows(gaps: list[tuple[int, int]]) -> tuple[int, int]:
        return _widest(gaps[-2:]) if has_titles else gaps[-1]

    ends = _cut(gaps, [(box.top, box.bottom) for box in frames], height, between_rows)
    return [Box(0, top, width, bottom) for top, bottom in ends]


def columns_of(ink: np.ndarray, frames: list[Box], row: Box) -> list[Box]:
    """A row cut between frames that lie beside each other.

    A title or a legend that all of them share is a strip of its own, if that lets the row be cut.
    """
    inside = [box for box in frames if row.top <= box.top and box.bottom <= row.bottom]
    if not inside:
        return [row]
    filled = ink[row.top : row.bottom].any(axis=1)
    gaps = [gap for gap in spans(~filled) if gap[1] - gap[0] >= GUTTER]
    middles = [row.top + (first + last) // 2 for first, last in gaps]
    title = [at for at in middles if row.top < at < min(box.top for box in inside)]
    below = [at for at in middles if at > max(box.bottom for box in inside)]
    likely = _legend(ink, inside, [*below, row.bottom])
    legend = sorted(
        below, key=lambda at: -(gaps[middles.index(at)][1] - gaps[middles.index(at)][0])
    )
    beside = [(box.left, box.right) for box in inside]
    best: list[Box] = []
    for top, bottom in (
        *((row.top, at) for at in likely),
        (row.top, row.bottom),
        *((row.top, at) for at in legend),
        *((at, row.bottom) for at in title),
        *((high, low) for high in title for low in legend),
    ):
        clear = ~ink[top:bottom].any(axis=0)
        blank = [(left, right) for left, right in spans(clear) if right - left >= GUTTER]
        found = [Box(left, top, right, bottom) for left, right in _cut(blank, beside, ink.shape[1])]
        if len(found) > max(len(best), 1):
            strips = Box(0, row.top, row.right, top), Box(0, bottom, row.right, row.bottom)
            shared = [box for box in strips if ink[box.top : box.bottom].any()]
            above = [box for box in shared if box.bottom <= top]
            best = [*above, *found, *(box for box in shared if box not in above)]
    return best or [row]


def _legend(ink: np.ndarray, frames: list[Box], ends: list[int]) -> list[int]:
    """Where a legend begins below the labels of the axes, each of which is in the middle of one."""
    for top, bottom in reversed(list(pairwise(ends))):
        filled = ink[top:bottom].any(axis=0)
        words = spans(filled)
        blocks = words[:1]
        for first, last in words[1:]:
            if first - blocks[-1][1] < WORDS:
                blocks[-1] = (blocks[-1][0], last)
            else:
                blocks.append((first, last))
        middles = [(first + last) / 2 for first, last in blocks]
        if middles and all(
            any(abs(at - (box.left + box.right) / 2) < 0.1 * box.width for box in frames)
            for at in middles
        ):
            return [bottom] if ink[bottom : ends[-1]].any() else []
    return []


def _widest(gaps: list[tuple[int, int]]) -> tuple[int, int]:
    return max(gaps, key=lambda gap: gap[1] - gap[0])


def _cut(
    blank: list[tuple[int, int]],
    frames: list[tuple[int, int]],
    end: int,
    choose: Callable[[list[tuple[int, int]]], tuple[int, int]] = _widest,
) -> list[tuple[int, int]]:
    """Cut 0 to end in a gap between each two frames that do not overlap."""
    cuts = [0]
    reached = None
    for first, last in sorted(frames):
        if reached is not None and first >= reached:
            between = [gap for gap in blank if gap[0] >= reached and gap[1] <= first]
            if between:
                start, stop = choose(between)
                cuts.append((start + stop) // 2)
        reached = max(reached or 0, last)
    return list(zip(cuts, [*cuts[1:], end], strict=True))
