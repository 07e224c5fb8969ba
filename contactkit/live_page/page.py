"""Live pages: a scene as one HTML file that moves in the browser."""

from __future__ import annotations

import base64
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from ..accuracy import Accuracy
from ..contact.result import ContactResult
from ..errors import DescriptionError
from ..extras import require
from ..files.scenes import write_text
from ..models.injector.scene import InjectorScene
from ..models.micromirror.scene import MicromirrorScene
from ..scene.scenes import ContactScene
from .assembly import assembled, file_name
from .contact.loads import loads_of, solved
from .contact.page import contact_page
from .film_page import film_data
from .fmu_files import PageScene, check_fmu, fmu_files
from .mirror_page import mirror_data
from .module import kernel_module
from .scene import check_scene
from .valve_page import valve_data

__all__ = ["PageScene", "Shown", "live_page", "page_data", "write_page"]

Shown = PageScene | ContactScene | ContactResult | Sequence[ContactResult]
"""What a page shows: a scene, or contacts that are solved already."""
Progress = Callable[[float], None]

_SCRIPTS = ("tables.js", "kernel.js", "chart.js", "page.js", "moved.js")


def write_page(
    what: Shown,
    out: str | PathLike[str],
    *,
    accuracy: Accuracy | None = None,
    loads: int | Sequence[float] | None = None,
    fmu: bool = False,
    progress: Progress | None = None,
) -> Path:
    """Write one HTML file in which a scene moves: no network, no server.

    The page of a separation runs the C kernel of the native FMUs as WebAssembly. What the kernel
    has as a variable is computed as a run of the scene is; geometry, contact angles and humidity
    move through tables over a grid, whose error the page states.

    The page of a contact holds its maps under several loads, and planes of stress where the scene
    lists `SubsurfaceStress`, with sections under the pointer; areas, pressures, gap and forces over
    the load with the error that `discretisation_error` estimates. Where there are more than 256
    pixels along a side, a cell of several pixels keeps the largest pressure, the smallest gap, and
    is in contact if one of its pixels is; the page states what it rounds. Numbers are those of all
    pixels.

    Parameters
    ----------
    what : SeparationScene, ContactScene, ContactResult or sequence of them, or a device
        A film with an imposed force and a mass, or an imposed speed; an `InjectorScene`, the valve
        of an injector with its film, coupled as its two FMUs are; a `MicromirrorScene`, with the
        tips of both sides; a contact, or contacts that are solved already
        (``load_curve(..., keep_maps=True).results``), loads ascending.
    out : path
        The file to write, ``*.html``; whole or not at all.
    accuracy : Accuracy, optional
        How well a scene is solved; `Accuracy.standard` if not given.
    loads : int or sequence of float, optional
        Loads of a contact scene beside its own, in the quantity of its loading; or how many, each
        half of the next. 6 if not given.
    fmu : bool
        Whether the page of a separation or an injector holds its native FMU as it is, to be saved
        from there: some 0.8 MB for all platforms.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    PlanError, InfeasibleError, ConvergenceError
        If a page cannot carry the scene, or a contact cannot be solved, with reason and cure.
    DescriptionError
        If `accuracy`, `loads` or `fmu` are given for what does not use them.
    MissingExtraError
        Of a separation, if ziglang is not installed (``pip install contactkit[native]``).

    Examples
    --------
    >>> import tempfile
    >>> import contactkit as ck
    >>> steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    >>> ball = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=30e-6, periodic=False),
    ...     loading=ck.Pressing(force=0.2),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     page = write_page(ball, f"{folder}/ball.html", accuracy=ck.Accuracy(grid=32), loads=2)
    ...     page.stat().st_size < 100_000
    True
    """
    return write_text(Path(out), live_page(what, accuracy, progress, loads=loads, fmu=fmu))


def live_page(
    what: Shown,
    accuracy: Accuracy | None = None,
    progress: Progress | None = None,
    *,
    loads: int | Sequence[float] | None = None,
    fmu: bool = False,
) -> str:
    """Return the text of a page; see `write_page`."""
    _check_unused(what, accuracy, loads, fmu)
    update = progress or (lambda done: None)
    if isinstance(what, ContactScene):
        wanted = loads_of(what, loads)
        return contact_page(
            solved(what, accuracy or Accuracy.standard, wanted, lambda done: update(0.5 * done)),
            lambda done: update(0.5 + 0.5 * done),
            what.loading.quantity.value,
        )
    if isinstance(what, ContactResult | list | tuple):
        return contact_page([what] if isinstance(what, ContactResult) else what, update)
    # A scene that no page carries, or no FMU, needs no compiler.
    scene = what if isinstance(what, InjectorScene | MicromirrorScene) else check_scene(what)
    if fmu:
        check_fmu(scene)
    require("ziglang", "a live page, whose kernel is compiled to WebAssembly,")
    files = fmu_files(scene, file_name(scene.name, "film")) if fmu else {}
    data = page_data(scene, accuracy, progress)
    data["fmus"] = [
        {"name": name, "content": base64.b64encode(content).decode("ascii")}
        for name, content in files.items()
    ]
    remark = "the kernel runs in this page, and nothing is sent anywhere"
    scripts = (*_SCRIPTS, f"{data['view']}.js")
    return assembled(data, "film.html", scripts, remark, {"kernel": kernel_module()})


def _check_unused(what: object, accuracy: Accuracy | None, loads: object, fmu: bool) -> None:
    """Refuse what the page of a separation, or of a contact, does not use."""
    is_solved, kind = isinstance(what, ContactResult | list | tuple), type(what).__name__
    if loads is not None and not isinstance(what, ContactScene):
        raise DescriptionError("loads", loads, f"be left out for a {kind}: they are of a contact")
    if accuracy is not None and is_solved:
        raise DescriptionError(
            "accuracy", accuracy, "be left out: these contacts are solved already"
        )
    if fmu and (is_solved or isinstance(what, ContactScene)):
        raise DescriptionError("fmu", fmu, f"be left out: a {kind} has no FMU on its page")


def page_data(
    scene: PageScene, accuracy: Accuracy | None = None, progress: Progress | None = None
) -> dict[str, Any]:
    """Return what the scripts of a page read: sliders, numbers of the kernel, tables, words."""
    if isinstance(scene, InjectorScene):
        return valve_data(scene, accuracy, progress)
    if isinstance(scene, MicromirrorScene):
        return mirror_data(scene, accuracy, progress)
    return film_data(scene, accuracy, progress)
