"""The icon of an FMU: a film with hollow menisci that holds two bodies, one of them pulled.

Drawn from a few shapes with edges smoothed by their distance, so no picture is kept, nothing
but zlib is needed, and the bytes are the same every time.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Callable
from functools import lru_cache

__all__ = ["icon_png", "icon_svg"]

_SIZE = 128  # pixels; all lengths below are in them, y points down
_STEEL, _DARK, _OIL, _WHITE = (96, 112, 130), (70, 84, 101), (232, 160, 48), (255, 255, 255)
_LEFT, _RIGHT, _ROUND = 12.0, 116.0, 5.0
_UPPER, _LOWER = (12.0, 50.0), (78.0, 116.0)  # heights at which the bodies begin and end
_FILM = (26.0, 102.0)  # ends of the film where it wets the bodies
_HOLLOW = 17.0  # radius of its menisci
_SHAFT, _HEAD = 3.0, 11.0  # half widths of the arrow

_Shape = Callable[[float, float], float]


def _box(left: float, right: float, top: float, bottom: float, radius: float) -> _Shape:
    """Distance from a box with round corners, negative inside."""
    x0, y0 = 0.5 * (left + right), 0.5 * (top + bottom)
    a, b = 0.5 * (right - left) - radius, 0.5 * (bottom - top) - radius

    def distance(x: float, y: float) -> float:
        u, v = abs(x - x0) - a, abs(y - y0) - b
        return math.hypot(max(u, 0.0), max(v, 0.0)) + min(max(u, v), 0.0) - radius

    return distance


def _film() -> _Shape:
    """Distance from the film: a box without two discs that hollow its ends."""
    top, bottom = _UPPER[1], _LOWER[0]
    middle, half = 0.5 * (top + bottom), 0.5 * (bottom - top)
    out = math.sqrt(_HOLLOW**2 - half**2)  # how far the centre of a disc is from its end
    slab = _box(*_FILM, top - 1.0, bottom + 1.0, 0.0)  # goes under the bodies: no seam

    def distance(x: float, y: float) -> float:
        discs = [
            _HOLLOW - math.hypot(x - centre, y - middle)
            for centre in (_FILM[0] - out, _FILM[1] + out)
        ]
        return max(slab(x, y), *discs)

    return distance


def _arrow() -> _Shape:
    """Distance from an arrow upwards on the upper body."""
    middle, (top, bottom) = 0.5 * _SIZE, _UPPER
    tip, neck, foot = top + 5.0, top + 17.0, bottom - 5.0
    shaft = _box(middle - _SHAFT, middle + _SHAFT, neck - 1.0, foot, 1.0)
    slope = _HEAD / (neck - tip)
    along = 1.0 / math.hypot(1.0, slope)

    def distance(x: float, y: float) -> float:
        side = (abs(x - middle) - slope * (y - tip)) * along
        return min(shaft(x, y), max(side, y - neck))

    return distance


@lru_cache(maxsize=1)
def icon_png() -> bytes:
    """Icon as a PNG of 128 by 128 pixels with a transparent background.

    Examples
    --------
    >>> icon_png()[1:4]
    b'PNG'
    """
    shapes = (
        (_film(), _OIL),
        (_box(_LEFT, _RIGHT, *_LOWER, _ROUND), _DARK),
        (_box(_LEFT, _RIGHT, *_UPPER, _ROUND), _STEEL),
        (_arrow(), _WHITE),
    )
    rows = bytearray()
    for j in range(_SIZE):
        rows.append(0)  # no filter
        half = [_pixel(shapes, i + 0.5, j + 0.5) for i in range(_SIZE // 2)]
        rows += b"".join([*half, *reversed(half)])  # both sides are alike
    head = struct.pack(">IIBBBBB", _SIZE, _SIZE, 8, 6, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(bytes(rows), 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(name, content) for name, content in chunks)


def _pixel(shapes: tuple[tuple[_Shape, tuple[int, ...]], ...], x: float, y: float) -> bytes:
    """Red, green, blue and opacity of a pixel, the shapes over each other in their order."""
    colour, opacity = (0.0, 0.0, 0.0), 0.0
    for shape, own in shapes:
        share = min(max(0.5 - shape(x, y), 0.0), 1.0)
        if share > 0.0:
            whole = share + opacity * (1.0 - share)
            mixed = [
                (share * b + opacity * (1.0 - share) * a) / whole
                for a, b in zip(colour, own, strict=True)
            ]
            colour, opacity = (mixed[0], mixed[1], mixed[2]), whole
    return bytes([*(round(part) for part in colour), round(255.0 * opacity)])


def _chunk(name: bytes, content: bytes) -> bytes:
    return (
        struct.pack(">I", len(content))
        + name
        + content
        + struct.pack(">I", zlib.crc32(name + content))
    )


def icon_svg() -> str:
    """Return the same drawing as SVG.

    Examples
    --------
    >>> icon_svg()[:4]
    '<svg'
    """
    (left, right), (top, bottom), middle = _FILM, (_UPPER[1], _LOWER[0]), 0.5 * _SIZE
    tip, neck, foot = _UPPER[0] + 5.0, _UPPER[0] + 17.0, _UPPER[1] - 5.0
    arc = f"A{_HOLLOW:g} {_HOLLOW:g} 0 0 "
    film = f"M{left:g} {top:g}H{right:g}{arc}0 {right:g} {bottom:g}H{left:g}{arc}0 {left:g} {top:g}"
    arrow = (
        f"M{middle:g} {tip:g}L{middle + _HEAD:g} {neck:g}H{middle + _SHAFT:g}V{foot:g}"
        f"H{middle - _SHAFT:g}V{neck:g}H{middle - _HEAD:g}"
    )
    bodies = "".join(
        f'<rect x="{_LEFT:g}" y="{begin:g}" width="{_RIGHT - _LEFT:g}" height="{end - begin:g}" '
        f'rx="{_ROUND:g}" fill="{_hex(colour)}"/>'
        for (begin, end), colour in ((_LOWER, _DARK), (_UPPER, _STEEL))
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_SIZE} {_SIZE}" '
        f'width="{_SIZE}" height="{_SIZE}"><path d="{film}Z" fill="{_hex(_OIL)}"/>{bodies}'
        f'<path d="{arrow}Z" fill="{_hex(_WHITE)}"/></svg>'
    )


def _hex(colour: tuple[int, ...]) -> str:
    return "#" + "".join(f"{part:02x}" for part in colour)
