"""Live pages: a scene as one HTML file that computes in the browser."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from .._version import __version__
from ..accuracy import Accuracy
from ..extras import require
from ..files.scenes import write_whole
from ..models.injector.scene import InjectorScene
from ..models.micromirror.scene import MicromirrorScene
from .film_page import file_name, film_data, packed
from .fmu_files import PageScene, fmu_files
from .mirror_page import mirror_data
from .module import kernel_module
from .scene import check_scene
from .valve_page import valve_data

__all__ = ["PageScene", "live_page", "page_data", "write_page"]

Progress = Callable[[float], None]

_SCRIPTS = ("page.css", "tables.js", "kernel.js", "chart.js", "page.js", "moved.js")


def write_page(
    scene: PageScene,
    out: str | PathLike[str],
    *,
    accuracy: Accuracy | None = None,
    fmu: bool = False,
    progress: Progress | None = None,
) -> Path:
    """Write a scene as one HTML file that computes in the browser.

    The page runs the C kernel of the native FMUs as WebAssembly: no network, no server, no script
    from elsewhere. What the kernel has as a variable is computed as a run of the scene is;
    geometry, contact angles and humidity move through tables over a grid, whose error the page
    states.

    Parameters
    ----------
    scene : SeparationScene, InjectorScene or MicromirrorScene
        A film with an imposed force and a mass, or an imposed speed; the valve of an injector with
        its film, coupled as its two FMUs are; a micromirror with the tips of both sides.
    out : path
        The file to write, ``*.html``; whole or not at all.
    accuracy : Accuracy, optional
        Tolerance of the motion, and of the film on a face; `Accuracy.standard` if not given.
    fmu : bool
        Whether the page holds the native FMU of the scene as it is, to be saved from there: some
        0.8 MB for all platforms.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    PlanError
        If a page cannot carry the scene, with the reason and the cure.
    MissingExtraError
        If ziglang is not installed (``pip install contactkit[native]``).
    """
    text = live_page(scene, accuracy, progress, fmu=fmu)
    with write_whole(Path(out)) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return Path(out)


def live_page(
    scene: PageScene,
    accuracy: Accuracy | None = None,
    progress: Progress | None = None,
    *,
    fmu: bool = False,
) -> str:
    """Return the text of the page of a scene; see `write_page`."""
    if not isinstance(scene, InjectorScene | MicromirrorScene):
        check_scene(scene)  # a scene that no page carries needs no compiler
    require("ziglang", "a live page, whose kernel is compiled to WebAssembly,")
    files = fmu_files(scene, file_name(scene.name)) if fmu else {}
    data = page_data(scene, accuracy, progress)
    data["fmus"] = [
        {"name": name, "content": base64.b64encode(content).decode("ascii")}
        for name, content in files.items()
    ]
    folder = Path(__file__).with_name("template")
    made_by = f"contactkit {__version__}"
    parts = {
        "title": escape(data["title"]),
        "generator": escape(made_by),
        "foot": escape(f"{made_by}; the kernel runs in this page, and nothing is sent anywhere"),
        # No text of a scene ends the script that holds it.
        "data": json.dumps(data, allow_nan=False, ensure_ascii=False).replace("<", "\\u003c"),
        "kernel": packed(kernel_module()),
        **{name: (folder / name).read_text("utf-8") for name in _SCRIPTS},
        "view.js": (folder / f"{data['view']}.js").read_text("utf-8"),
    }
    page = (folder / "page.html").read_text("utf-8")
    return re.sub(r"\{\{([\w.]+)\}\}", lambda match: parts[match[1]], page)


def page_data(
    scene: PageScene, accuracy: Accuracy | None = None, progress: Progress | None = None
) -> dict[str, Any]:
    """Return what the scripts of a page read: sliders, numbers of the kernel, tables, words."""
    if isinstance(scene, InjectorScene):
        return valve_data(scene, accuracy, progress)
    if isinstance(scene, MicromirrorScene):
        return mirror_data(scene, accuracy, progress)
    return film_data(scene, accuracy, progress)
