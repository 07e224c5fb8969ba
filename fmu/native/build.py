"""Writing native FMUs: one C kernel for all models, and the tables of one scene.

Such an FMU needs no Python on the host. Building twice from the same sources with the same
compiler gives the same bytes.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

from attrs import evolve

from ..._version import __version__
from ...errors import DescriptionError, PlanError
from ...scene.scenes import ContactScene, SeparationScene
from ...separation.deforming.effects import ElasticBodies
from ...separation.effects.prepared import prepare_scene
from ..contents.document import license_text
from ..contents.packing import write_archive
from ..contents.terminals import terminal_files
from ..framework.description import Description
from ..framework.ports import Port, Value, find_port, start_value
from ..framework.toolchain import (
    PLATFORMS,
    compile_kernel,
    fmi_headers,
    has_zig,
    join_macs,
    local,
)
from ..slaves.stiction_mass import scene_of
from .component import WASM, component_files
from .data import contents_of, data_file, digest, guid_of
from .deforming import DEFORMING, deforming_film, free_ports
from .description import CATEGORIES, description_files
from .film import FINE, moving, prepared_film
from .models import INDICATORS, native_model
from .page import native_page
from .ports import Model, check_free, native_ports
from .records import Bodies, Faces, FilmTables, LiquidTable
from .sources import kernel_sources, layout

__all__ = [
    "NativeContent",
    "NativeScene",
    "build_native",
    "chosen_platforms",
    "native_about",
    "native_scene",
    "target",
    "write_native",
]

_MASS = {"stiction-mass": "m", "stiction-force": "m_ref"}
_COMPILED: dict[tuple[str, ...], bytes] = {}  # the kernel is the same for all scenes


def build_native(
    scene: SeparationScene,
    out: str | os.PathLike[str],
    *,
    model: Model = "stiction-mass",
    start: Mapping[str, Value | str] | None = None,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
    fmi: Literal[2, 3] = 2,
    film_rtol: float | None = None,
) -> Path:
    """Write an FMU of any scene that runs without Python.

    It is for co-simulation; a ``stiction-force`` of rigid bodies also for model exchange, unless
    its film remembers a cavity (``dp_inception`` above 0).

    Parameters
    ----------
    scene : SeparationScene
        What is there; its forces are tabulated. What it imposes is left out: pull or motion are
        inputs.
    out : path
        The file to write, ``*.fmu``.
    model : {"stiction-mass", "stiction-force"}
        A mass with its film, or the film for a tool that owns the mass. Of a scene with
        `ElasticBodies` they are ``deforming-mass`` and ``deforming-force``; their summary, which is
        that of `deforming.exactness_of`, says which film they hold and how exact it is.
    start : mapping, optional
        Start values by variable; a text carries its unit (``"20 g"``). The mass, ``m`` or
        ``m_ref``, must be among them if the scene has none.
    platforms : sequence of str, optional
        Platforms to compile for, of `toolchain.PLATFORMS`, and ``wasm32-wasip2``, a WebAssembly
        component of FMI 3.0 (FMI-LS-WASM). None: those of `toolchain.PLATFORMS` if ziglang is
        installed, else this computer's.
    compiler : {"auto", "zig", "cc"}
        See `toolchain.compile_kernel`.
    fmi : {2, 3}
        Version of FMI. FMI 3.0 has event mode, with early return at a rupture.
    film_rtol : float, optional
        Error that the grid of a face that is no disc may leave in its force [-], as that of
        `Accuracy`, by default the same. The cost of a step with a cavity grows with the cells,
        of which there are 0.1/film_rtol across the face, or more. Of bodies that deform the error
        of the largest force of a film on rings, which is taken if this is given.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If a name, a start value, a platform or a version is not possible.
    ContactkitError
        If the scene cannot be planned or tabulated, or a compiler is missing.
    """
    place = target(out, fmi)
    if model not in _MASS:
        raise DescriptionError("model", model, "be " + " or ".join(map(repr, _MASS)))
    given = dict(start or {})
    if scene.effect(ElasticBodies) is not None:
        about, content = _deforming(scene, model, given, film_rtol)
        names = chosen_platforms(platforms)
        return write_native(DEFORMING[model], about, content, place, fmi, names, compiler)
    name = _MASS[model]
    mass = _mass(model, given.pop(name)) if name in given else None
    if model == "stiction-force" and "h0" in given:
        given.setdefault("h", given["h0"])
    scene = moving(scene, mass)
    film = prepared_film(scene, FINE if film_rtol is None else evolve(FINE, film_rtol=film_rtol))
    ports = native_ports(film.prepared, film.lowest, model, film.force, film.liquid)
    values: dict[str, Value] = {port.name: port.read(port.start) for port in ports}
    check_free(ports, model, given)
    values |= {name: start_value(ports, name, value) for name, value in given.items()}
    native_model(model).slave.check_start(values)
    about = native_about(model, ports, values, f" ({scene.name})" if scene.name else "")
    content = NativeContent(film.tables, liquid=film.liquid, scene=scene)
    return write_native(model, about, content, place, fmi, chosen_platforms(platforms), compiler)


def _deforming(
    scene: SeparationScene, model: Model, given: Mapping[str, Value | str], film_rtol: float | None
) -> tuple[Description, NativeContent]:
    """Description and content of the FMU of a film between bodies that deform."""
    name = DEFORMING[model]
    mass = _scene_mass(scene, given) if model == "stiction-mass" else None
    film = deforming_film(scene, film_rtol, mass)
    ports = free_ports(film, name)
    values: dict[str, Value] = {port.name: port.read(port.start) for port in ports}
    if mass is not None:
        values["m"] = mass
    elif "h0" in given:
        given = {"h": given["h0"], **given}
    values |= {key: start_value(ports, key, value) for key, value in given.items()}
    native_model(name).slave.check_start(values)
    of = f" of {scene.name}" if scene.name else ""
    about = native_about(name, ports, values, f"{of}; {film.exactness.text}")
    return about, NativeContent(bodies=film.bodies, liquid=film.liquid, scene=scene)


def _scene_mass(scene: SeparationScene, given: Mapping[str, Value | str]) -> float:
    """Mass that a scene has [kg], or that is given.

    Raises
    ------
    DescriptionError
        If there is none.
    """
    if "m" in given:
        return _mass("stiction-mass", given["m"])
    return moving(scene, None).imposed_force.mass or 0.0


def native_about(
    name: str, ports: tuple[Port, ...], start: Mapping[str, Value], more: str = ""
) -> Description:
    """Description of a native FMU, but for its GUID; `more` ends its summary."""
    model = native_model(name)
    return Description(
        identifier=model.identifier,
        guid="",
        tool="contactkit",
        ports=ports,
        start=start,
        summary=model.summary + more,
        log_categories=CATEGORIES,
        experiment=model.slave.experiment,
        version=__version__,
        # A cavity that remembers its history is no continuous state: co-simulation only.
        indicators={} if not model.exchanges or start.get("dp_inception") else INDICATORS,
    )


def target(out: str | os.PathLike[str], fmi: int) -> Path:
    """File to write.

    Raises
    ------
    DescriptionError
        If it is none of an FMU, or there is no such version of FMI.
    """
    if Path(out).suffix != ".fmu":
        raise DescriptionError("out", str(out), "end in .fmu")
    if fmi not in (2, 3):
        raise DescriptionError("fmi", fmi, "be 2 or 3")
    return Path(out)


class NativeContent(NamedTuple):
    """Tables, faces and bodies of the file of a native FMU, and the scene they were made from."""

    tables: FilmTables | None = None
    faces: Faces | None = None
    bodies: Bodies | None = None
    liquid: LiquidTable | None = None
    scene: SeparationScene | None = None
    """For the documentation."""


def write_native(
    model: str,
    about: Description,
    content: NativeContent,
    place: Path,
    fmi: Literal[2, 3],
    platforms: Sequence[str],
    compiler: str,
) -> Path:
    """Write a native FMU of any model.

    Parameters
    ----------
    model : str
        Name of the model.
    about : Description
        What it says; its GUID is made here.
    content : NativeContent
        Tables and faces.
    place : Path
        The file to write.
    fmi, platforms, compiler
        See `build_native`; the platforms by name.
    """
    ports, values = about.ports, about.start
    sources = kernel_sources(fmi) | fmi_headers(fmi)
    records = content.tables, content.faces, content.bodies, content.liquid
    made = contents_of(model, ports, values, *records)
    numbers = made.numbers()
    guid = guid_of(sources, numbers, ports)
    more = about.summary if content.bodies else ""
    page = native_page(content.scene, ports, values, name=model, fmi=str(fmi), summary=more)
    files = {
        **description_files(
            fmi,
            evolve(about, guid=guid),
            sources,
            takes_rate=model in ("stiction-mass", "deforming-mass"),
            gives_rates=model == "valve-drive",
        ),
        "resources/film.bin": data_file(guid, layout(), numbers),
        "documentation/index.html": page.encode(),
        "documentation/licenses/license.txt": _license().encode(),
        **terminal_files(ports, fmi=str(fmi)),
        **{f"sources/{name}": text for name, text in sources.items()},
        **_binaries(about.identifier, fmi, sources, platforms, compiler),
    }
    return write_archive(files, place)


class NativeScene(NamedTuple):
    """Scene whose tables a native FMU holds, and start values of its variables."""

    scene: SeparationScene
    start: Mapping[str, Value | str]


def native_scene(what: Any, model: Model | None = None) -> NativeScene:
    """Scene and start values of what the command line was given.

    Parameters
    ----------
    what : str or Runnable
        Name of an FMU, or an opened scene file.
    model : {"stiction-mass", "stiction-force"}, optional
        Model whose start values are meant, if not that of the FMU of the scene.

    Raises
    ------
    PlanError
        If its FMU has no native form.
    """
    scene = getattr(what, "scene", None)
    if isinstance(scene, SeparationScene):
        return NativeScene(scene, {})
    if isinstance(scene, ContactScene):  # said before hours go into its curve
        raise PlanError(
            "a contact scene makes a contact-stop, which has no film; build it by "
            "contactkit.fmu.native.drive.build_native_stop"
        )
    name, given, film = (what, {}, None) if isinstance(what, str) else what.fmu_start()
    if film is not None:
        return NativeScene(film, {})
    if name == "valve-drive":
        raise PlanError(
            "valve-drive has no native form made of a scene, as it has no film; build it by its "
            "name, or by contactkit.fmu.native.drive.build_native_drive"
        )
    if name not in _MASS:
        raise PlanError(
            f"{name} has no native form as a film in this version, only {' and '.join(_MASS)} "
            "have; build the others by their names, or by contactkit.fmu.native.drive and "
            "contactkit.fmu.native.tip"
        )
    own: Model = "stiction-force" if name == "stiction-force" else "stiction-mass"
    slave = native_model(own).slave
    values = slave.start_values()
    values |= {key: start_value(slave.ports, key, value) for key, value in given.items()}
    if own == "stiction-force":  # the mass is the tool's, and so is the end of the motion
        rest: dict[str, Value] = {"v0": 0.0, "k_s": 0.0, "h_min": 0.0, "h_rel": 20.0 * values["h0"]}
        values |= rest | {"m": values["m_ref"]}
    scene = scene_of(values)
    kept = {port.name for port in native_ports(prepare_scene(scene), 0.0, model or own)}
    start = {key: value for key, value in values.items() if key in kept and key in given}
    return NativeScene(scene, start)


def chosen_platforms(given: Sequence[str] | None) -> list[str]:
    """Platforms to compile for, if these are given; none at all would load nowhere."""
    if given is None:
        return list(PLATFORMS) if has_zig() else [local()]
    if not given:
        raise DescriptionError(
            "platforms", (), "name at least one of " + ", ".join((*PLATFORMS, WASM))
        )
    return list(given)


def _mass(model: Model, value: Value | str) -> float:
    """Mass [kg], of a text with a unit too."""
    name = _MASS[model]
    return float(start_value((find_port(native_model(model).ports, name),), name, value))


def _license() -> str:
    package = sys.modules[(__package__ or "").partition(".")[0]]
    return license_text("contactkit", Path(package.__path__[0]).parent / "LICENSE")


def _binaries(
    identifier: str, fmi: int, sources: Mapping[str, bytes], names: Sequence[str], compiler: str
) -> dict[str, bytes]:
    """Libraries of the platforms, by their path in the FMU."""
    found: dict[str, list[bytes]] = {}
    more = component_files(identifier, fmi, sources) if WASM in names else {}
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        for name, content in sources.items():
            (Path(folder) / name).write_bytes(content)
        for name in dict.fromkeys(name for name in names if name != WASM):
            key = (digest(sources), name, compiler, os.environ.get("CC", ""))
            if key not in _COMPILED:
                library = Path(folder) / f"{name}.library"
                compile_kernel(Path(folder), name, library, compiler)
                _COMPILED[key] = library.read_bytes()
            place = PLATFORMS[name]
            folder_in = place.fmi3 if fmi == 3 else place.fmi2
            path = f"binaries/{folder_in}/{identifier}{place.suffix}"
            found.setdefault(path, []).append(_COMPILED[key])
    joined = {path: one[0] if len(one) == 1 else join_macs(one) for path, one in found.items()}
    return joined | more
