"""The desk of the app: its folder, what was opened, and the scene that a form begins with."""

from __future__ import annotations

import atexit
import re
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from attrs import evolve, field, frozen

from ..app.scenes import OpenedScene, open_scene
from ..app.templates import template
from ..contact.effects.elasticity import HalfSpace
from ..errors import ContactkitError, PlanError
from ..files.scenes import write_whole
from ..files.structure import load_material
from ..reading.limits import check_limit
from ..reading.named_files import existing
from ..roughness.height_maps import read_height_map
from ..scene.interface import Body, Interface
from ..scene.loading import Pressing
from ..scene.rough_surfaces import Measured
from ..scene.scenes import ContactScene, SeparationScene
from .form import Choice, choices_of

__all__ = [
    "HALVES",
    "Desk",
    "Dropped",
    "Start",
    "current_desk",
    "is_contact",
    "opened_scene",
    "put_on_desk",
]

HALVES = ("contact", "separation")
"""Kinds of scenes that the app takes, as templates are named."""

_PRESSURE = 1e7  # [Pa], of a map that was dropped; the form has it
_SOLID = "bearing-steel"
_NAME = re.compile(r"[^\w.+-]+")


class Dropped(Protocol):
    """A file that a browser handed over."""

    @property
    def name(self) -> str:
        """Its name there."""

    @property
    def contents(self) -> bytes:
        """Its bytes."""


@frozen
class Desk:
    """A folder for what is dropped and built, which goes with the app, and what was opened with it.

    `opened` is a scene file or a height map on the command line; it stays where it is.
    """

    folder: Path
    opened: Path | str | None = None
    _held: tempfile.TemporaryDirectory[str] | None = field(default=None, repr=False)

    @classmethod
    def new(cls, opened: Path | str | None = None) -> Desk:
        """Return a desk with a temporary folder of its own."""
        held = tempfile.TemporaryDirectory(prefix="contactkit-app-")
        return cls(Path(held.name), opened, held)

    @property
    def half(self) -> str:
        """Half that the app begins with: that of what was opened."""
        given = self.opened
        if given is None or Path(given).suffix.lower() not in ("", ".toml"):
            return HALVES[0]
        return HALVES[0] if is_contact(self.begin(HALVES[0]).scene) else HALVES[1]

    def close(self) -> None:
        """Remove the folder."""
        if self._held is not None:
            self._held.cleanup()

    def keep(self, dropped: Dropped) -> Path:
        """Write a file that was dropped into the folder, under a plain name.

        Raises
        ------
        DescriptionError
            If it is larger than files may be that are read.
        """
        name = _NAME.sub("_", Path(dropped.name.replace("\\\\", "/")).name).lstrip(".") or "file"
        is_scene = name.endswith(".toml")
        check_limit("SCENE_BYTES" if is_scene else "BYTES", len(dropped.contents), name)
        path = self.folder / name
        with write_whole(path) as temporary:
            temporary.write_bytes(dropped.contents)
        return path

    def begin(self, half: str, dropped: Sequence[Dropped] = ()) -> Start:
        """Scene that a form begins with: what was dropped last, else what was opened, else new.

        Parameters
        ----------
        half : {"contact", "separation"}
            Which to begin with where no file says it.
        dropped : sequence
            Files from the browser.
        """
        try:
            source = self.keep(dropped[-1]) if dropped else self.opened
            return Start(opened_scene(source, half))
        except ContactkitError as error:
            return Start(_of_template(half), str(error))


@frozen
class Start:
    """A scene to begin with, and what was wrong with the file that was to give it."""

    scene: OpenedScene
    problem: str = ""

    @property
    def choices(self) -> tuple[Choice, ...]:
        """Choices that a form offers of it."""
        return choices_of(self.scene)


_DESKS: list[Desk] = []


def put_on_desk(opened: Path | str | None) -> Desk:
    """Make the desk of this process: a server has one."""
    _DESKS[:] = [Desk.new(opened)]
    atexit.register(_DESKS[0].close)  # where no server closes it
    return _DESKS[0]


def current_desk() -> Desk:
    """Desk of this process; a new one if it has none, as when the app runs as a program."""
    return _DESKS[0] if _DESKS else put_on_desk(None)


def is_contact(opened: OpenedScene) -> bool:
    """Whether a scene is a contact; the app has no third kind."""
    return isinstance(opened.scene, ContactScene)


def opened_scene(source: Path | str | None, half: str) -> OpenedScene:
    """Scene of a file or a name, a contact of a height map, or a template where there is none.

    Raises
    ------
    ContactkitError
        If there is no such file, or it holds neither a contact nor a separation.
    """
    if source is None:
        return _of_template(half)
    path = Path(source)
    if path.suffix.lower() not in ("", ".toml"):
        return _of_map(path)
    found = open_scene(str(source))
    if not isinstance(found, OpenedScene) or not isinstance(
        found.scene, ContactScene | SeparationScene
    ):
        kind = type(found.scene).__name__
        raise PlanError(
            f"the app takes a contact or a separation, and {path.name} holds a {kind}; contactkit "
            f"run {path.name} --out FOLDER runs it"
        )
    return evolve(found, parameters={})


def _of_template(half: str) -> OpenedScene:
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        path = Path(folder) / f"{half}.toml"
        path.write_text(template(half), encoding="utf-8")
        found = open_scene(str(path))
    assert isinstance(found, OpenedScene)
    return found


def _of_map(path: Path) -> OpenedScene:
    """A rigid flat on a measured surface of steel; holes are masked if the map has some."""
    existing(path, "height map")
    surface = Measured(path=path.resolve(), holes="masked" if _has_holes(path) else "refused")
    scene = ContactScene(
        name=path.stem,
        interface=Interface(lower=Body(surface=surface, solid=load_material(_SOLID))),
        loading=Pressing(pressure=_PRESSURE),
        effects=(HalfSpace(),),
    )
    return OpenedScene(scene)


def _has_holes(path: Path) -> bool:
    """Whether a map has pixels without a height; sizes that it may lack do not matter here."""
    for size, unit in ((None, None), (1.0, "m"), (None, "m"), (1.0, None)):
        try:
            found = read_height_map(path, pixel_size=size, unit=unit, holes=True)
        except ContactkitError:
            continue
        return bool((found.heights != found.heights).any())
    return False
