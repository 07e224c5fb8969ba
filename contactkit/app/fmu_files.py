"""FMU files as the command line orders them: of a scene, or of a model by its name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from attrs import frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, PlanError, nearest
from ..export.report import FmuStart
from ..models.library import bundled_scenes
from ..scene.scenes import SeparationScene
from .scenes import Opened, open_scene
from .settings import assignments, with_settings

if TYPE_CHECKING:
    from ..fmu.contents.references import ReferenceRun

__all__ = ["Order", "build_fmu", "build_opened", "check_order"]


_FILMS = ("stiction-mass", "stiction-force")


class Order(NamedTuple):
    """An FMU to build: of what, with which values set, where to, in which form."""

    what: str
    settings: Sequence[str]
    out: Path
    native: bool
    model: str | None
    fmi: str
    reference: bool = False
    wasm: bool = False

    def platforms(self) -> list[str] | None:
        """Platforms to compile for; None for those that can be."""
        from ..fmu.native.build import chosen_platforms
        from ..fmu.native.component import WASM

        return [*chosen_platforms(None), WASM] if self.wasm else None


@frozen
class _Named:
    """A model by its name with start values, as `native_scene` asks for them."""

    start: FmuStart

    def fmu_start(self) -> FmuStart:
        """See `Opened.fmu_start`."""
        return self.start


def check_order(order: Order) -> None:
    """Refuse contradictory options before anything is built.

    Raises
    ------
    PlanError
        With the option to add or to leave out.
    """
    if order.fmi != "2" and not order.native:
        raise PlanError(
            "without --native only FMUs of FMI 2.0 can be built; add --native, or leave out --fmi 3"
        )
    if order.wasm and (order.fmi != "3" or not order.native):
        raise PlanError("--wasm adds a binary to a native FMU of FMI 3.0; add --native --fmi 3")
    if order.model is not None and not order.native:
        raise PlanError(
            f"--model chooses the model of a native FMU; add --native, or build {order.model} by "
            f"its name"
        )
    if (order.what, order.model) == ("stiction-force", "stiction-mass"):
        raise PlanError(
            "stiction-force has no mass, so it cannot be built with --model stiction-mass; build "
            "stiction-mass"
        )
    alone = ("valve-drive", "tip-contact", "contact-stop")
    if order.model not in (None, order.what) and (
        order.what in alone or (order.what in _FILMS and order.model in alone)
    ):
        lacks = "film" if order.what in ("valve-drive", "contact-stop") else order.model
        raise PlanError(
            f"{order.what} has no {lacks}, so it cannot be built with --model {order.model}; leave "
            f"out --model, or give a scene"
        )


def build_fmu(order: Order) -> str:
    """Build an FMU and return what it is, in words.

    Raises
    ------
    DescriptionError, PlanError
        If a value is not possible, or the scene has no such FMU.
    """
    from ..fmu.python.build import FMUS, build

    if order.what not in FMUS:
        return build_opened(order, with_settings(_opened(order.what, FMUS), order.settings))
    if order.reference:
        raise PlanError(
            f"reference results are the motion of a scene under its pull, and {order.what} is a "
            "model: build a separation scene, or leave out --reference"
        )
    given = assignments(order.settings)
    if order.native:
        return _build_native(order, None, given)
    build(order.what, order.out, start=given)
    return order.what


def build_opened(order: Order, opened: Opened) -> str:
    """Build the FMU of an opened scene, whose values are set; `Order.what` is its name.

    Raises
    ------
    DescriptionError, PlanError
        If the scene has no such FMU.
    """
    from ..fmu.python.build import build

    reference = _reference(order, opened) if order.reference else None
    if order.native:
        name = _build_native(order, opened, {})
    else:
        start = opened.fmu_start()
        name = start.name
        build(name, order.out, start=start.values)
    if reference is not None:
        from ..fmu.native.reference import add_reference

        add_reference(order.out, *reference)
    return name


def _reference(order: Order, opened: Opened) -> tuple[SeparationScene, ReferenceRun]:
    """Scene of an FMU and its reference results, before anything is built."""
    from ..fmu.native.reference import reference_run

    scene = getattr(opened, "scene", None)
    if not isinstance(scene, SeparationScene) or order.model not in (None, *_FILMS):
        raise PlanError(
            f"reference results are those of the film of a separation scene, which {order.what} is "
            "not: leave out --reference"
        )
    model = _film_model(order.model) or "stiction-mass"
    accuracy = getattr(opened, "accuracy", Accuracy.standard)
    return scene, reference_run(scene, model, film_rtol=accuracy.film_rtol)


def _opened(what: str, names: Iterable[str]) -> Opened:
    """Open a scene; a name that is neither one nor an FMU gets the nearest of both."""
    if not Path(what).suffix and not Path(what).exists() and what not in bundled_scenes():
        hint = nearest(what, sorted({*names, *bundled_scenes()}))
        expected = "be the name of an FMU or of a scene, or a scene file"
        raise DescriptionError("what", what, expected, hint=hint)
    return open_scene(what)


def _build_native(order: Order, opened: Opened | None, given: Mapping[str, Any]) -> str:
    """Build an FMU in C; `given` are start values of a model that is built by its name."""
    from ..fmu.native.build import build_native, native_scene
    from ..fmu.native.deforming import DEFORMING, exactness_of
    from ..fmu.native.drive import build_native_drive, build_native_stop
    from ..fmu.native.tip import build_native_tip
    from ..models.micromirror.scene import MicromirrorScene
    from ..scene.scenes import ContactScene
    from ..separation.deforming.effects import ElasticBodies

    what, model, fmi = order.what, order.model, _version(order.fmi)
    scene = getattr(opened, "scene", None)
    if "valve-drive" in (what, model):
        values = given if what == "valve-drive" else _drive_start(what, scene)
        build_native_drive(order.out, start=values, fmi=fmi, platforms=order.platforms())
        return f"valve-drive, native, FMI {fmi}.0"
    by_scene = {"contact-stop": ContactScene, "tip-contact": MicromirrorScene}
    if model in by_scene and model != what and not isinstance(scene, by_scene[model]):
        raise PlanError(
            f"{what} is no scene of a {model}; a {by_scene[model].__name__} is, such as "
            f"{'contact-stop' if model == 'contact-stop' else 'micromirror'}; leave out --model"
        )
    if (
        what == "contact-stop"
        or model == "contact-stop"
        or (model is None and isinstance(scene, ContactScene))
    ):
        values = given if opened is None else opened.fmu_start().values
        build_native_stop(order.out, start=values, fmi=fmi, platforms=order.platforms())
        return f"contact-stop, native, FMI {fmi}.0"
    if (
        what == "tip-contact"
        or model == "tip-contact"
        or (model is None and isinstance(scene, MicromirrorScene))
    ):
        values = given if opened is None else opened.fmu_start().values
        build_native_tip(order.out, start=values, fmi=fmi, platforms=order.platforms())
        return f"tip-contact, native, FMI {fmi}.0"
    film_alone = "stiction-force" in (what, model)
    kind: Literal["stiction-mass", "stiction-force"] = (
        "stiction-force" if film_alone else "stiction-mass"
    )
    film, start = native_scene(opened or _Named(FmuStart(what, given)), _film_model(model))
    accuracy: Accuracy = getattr(opened, "accuracy", Accuracy.standard)
    rtol: float | None = accuracy.film_rtol
    if "film_rtol" not in accuracy.given and rtol == Accuracy.standard.film_rtol:
        rtol = None  # nobody asked for it
    build_native(
        film,
        order.out,
        model=kind,
        start=start,
        platforms=order.platforms(),
        fmi=fmi,
        film_rtol=rtol,
    )
    if film.effect(ElasticBodies) is not None:
        own = getattr(film.loading, "mass", None) if kind == "stiction-mass" else None
        how = exactness_of(film, rtol, own).text
        return f"{DEFORMING[kind]}, native, FMI {fmi}.0: {how}"
    return f"{kind}, native, FMI {fmi}.0"


def _version(fmi: str) -> Literal[2, 3]:
    return 3 if fmi == "3" else 2


def _film_model(model: str | None) -> Literal["stiction-mass", "stiction-force"] | None:
    if model == "stiction-force":
        return "stiction-force"
    return None if model is None else "stiction-mass"


def _drive_start(what: str, scene: Any) -> Mapping[str, Any]:
    """Start values of the drive of a scene."""
    from ..models.injector.report.cosimulation import drive_start

    valve = getattr(scene, "valve", None)
    if valve is None:
        raise PlanError(
            f"{what} has no valve; a valve-drive needs a scene with one, such as fuel-injector"
        )
    return drive_start(valve)
