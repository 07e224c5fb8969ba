"""The icon of an FMU: a liquid film between two bodies, one of them pulled; as PNG and SVG."""

from __future__ import annotations

from pathlib import Path

__all__ = ["icon_png", "icon_svg"]


def icon_png() -> bytes:
    """Read the icon as PNG, 128 pixels wide."""
    return Path(__file__).with_name("icon.png").read_bytes()


def icon_svg() -> str:
    """Read the icon as SVG, which an HTML page can hold as it is."""
    return Path(__file__).with_name("icon.svg").read_text("utf-8")
