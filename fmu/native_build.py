"""Writing native FMUs: one C kernel for all scenes, and the tables of one of them.

Such an FMU needs no Python on the host. Building twice from the same sources with the same
compiler gives the same bytes.
"""

from __future__ import annotations

import hashlib
import io
import os
import sys
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..errors import DescriptionError, PlanError
from ..scene import SeparationScene
from ..units import parse_quantity
from .document import license_text
from .native_compile import (
    PLATFORMS,
    compile_kernel,
    fmi_headers,
    has_zig,
    join_macs,
    kernel_sources,
    local,
)
from .native_data import data_file, port_numbers
from .native_film import film_numbers, moving
from .native_page import native_page
from .native_ports import check_start, native_ports
from .ports import Port, Value, find_port
from .stiction_mass import StictionMass, scene_of
from .xml import Description, model_description

__all__ = ["build_native", "native_scene"]

_IDENTIFIER = "stiction_mass"
_COMPILED: dict[tuple[str, ...], bytes] = {}  # the kernel is the same for all scenes
_CATEGORIES = {
    "logEvents": "What happened in the model, such as a release or a rupture.",
    "logStatusWarning": "What is odd, but can be gone on with.",
    "logStatusError": "Why the FMU refuses to go on, and what to do about it.",
    "logAll": "Everything.",
}


def build_native(
    scene: SeparationScene,
    out: str | os.PathLike[str],
    *,
    start: Mapping[str, Value | str] | None = None,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
) -> Path:
    """Write a ``stiction-mass`` of any scene that runs without Python (FMI 2.0, co-simulation).

    Parameters
    ----------
    scene : SeparationScene
        What is there; its forces are tabulated. What it imposes is left out: the pull is an input.
    out : path
        The file to write, ``*.fmu``.
    start : mapping, optional
        Start values by variable; a text carries its unit (``"20 g"``). ``m`` must be among them
        if the scene has no mass.
    platforms : sequence of str, optional
        Platforms to compile for, of `native_compile.PLATFORMS`. None: all if ziglang is
        installed, else this computer's.
    compiler : {"auto", "zig", "cc"}
        See `native_compile.compile_kernel`.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If a name, a start value or a platform is not possible.
    ContactkitError
        If the scene cannot be planned or tabulated, or a compiler is missing.
    """
    target = Path(out)
    if target.suffix != ".fmu":
        raise DescriptionError("out", str(out), "end in .fmu")
    given = dict(start or {})
    mass = _mass(given.pop("m")) if "m" in given else None
    scene = moving(scene, mass)
    film = film_numbers(scene)
    ports = native_ports(scene, film.lowest)
    values: dict[str, Value] = {port.name: port.read(port.start) for port in ports}
    values |= {name: _start_value(ports, name, value) for name, value in given.items()}
    check_start(ports, values)
    names = (
        list(platforms) if platforms is not None else list(PLATFORMS) if has_zig() else [local()]
    )
    sources = kernel_sources() | fmi_headers()
    numbers = port_numbers(ports, values) + film.numbers
    guid = _guid(sources, numbers, ports)
    files = {
        "modelDescription.xml": _description(guid, ports, values, scene, sources),
        "resources/film.bin": data_file(guid, numbers),
        "documentation/index.html": native_page(scene, ports, values).encode(),
        "documentation/licenses/license.txt": _license().encode(),
        **{f"sources/{name}": content for name, content in sources.items()},
        **_binaries(sources, names, compiler),
    }
    return _pack(files, target)


def native_scene(what: Any) -> tuple[SeparationScene, dict[str, Value]]:
    """Scene and start values of what the command line was given.

    Parameters
    ----------
    what : str or Runnable
        Name of an FMU, or an opened scene file.

    Raises
    ------
    PlanError
        If its FMU has no native form.
    """
    scene = getattr(what, "scene", None)
    if isinstance(scene, SeparationScene):
        return scene, {}
    name, given = (what, {}) if isinstance(what, str) else what.fmu_start()
    if name != "stiction-mass":
        raise PlanError(
            f"{name} has no native form in this version, only stiction-mass has; leave out --native"
        )
    values = StictionMass.start_values()
    values |= {key: _start_value(StictionMass.ports, key, value) for key, value in given.items()}
    scene = scene_of(values)
    kept = {port.name for port in native_ports(scene, 0.0)}
    return scene, {key: value for key, value in values.items() if key in kept and key in given}


def _mass(value: Value | str) -> float:
    """Mass [kg], of a text with a unit too."""
    port = find_port(StictionMass.ports, "m")
    return float(_start_value((port,), "m", value))


def _start_value(ports: tuple[Port, ...], name: str, value: Value | str) -> Value:
    port = find_port(ports, name)
    if port.causality == "output":
        raise DescriptionError(name, value, "be left to the model, because it is an output")
    if isinstance(value, str) and port.kind == "real":
        return port.read(parse_quantity(value, port.unit, name))
    return port.read(value)


def _digest(sources: Mapping[str, bytes]) -> str:
    digest = hashlib.sha256()
    for name, content in sorted(sources.items()):
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def _guid(sources: Mapping[str, bytes], numbers: Sequence[float], ports: Sequence[Port]) -> str:
    """GUID made from all that decides what the FMU computes and says."""
    said = repr([*numbers]) + repr(ports) + _digest(sources)
    build = hashlib.sha256(said.encode()).hexdigest()
    return "-".join(build[i:j] for i, j in pairwise((0, 8, 12, 16, 20, 32)))


def _description(
    guid: str,
    ports: Sequence[Port],
    values: Mapping[str, Value],
    scene: SeparationScene,
    sources: Mapping[str, bytes],
) -> bytes:
    title = f" ({scene.name})" if scene.name else ""
    root = model_description(
        Description(
            identifier=_IDENTIFIER, guid=guid, tool="contactkit", ports=ports, start=values,
            summary=StictionMass.summary + title, log_categories=_CATEGORIES,
            experiment=StictionMass.experiment,
        )
    )  # fmt: skip
    kind = root.find("CoSimulation")
    assert kind is not None
    kind.attrib |= {
        "needsExecutionTool": "false",
        "canInterpolateInputs": "true",
        "providesDirectionalDerivative": "true",
    }
    files: Element = SubElement(kind, "SourceFiles")
    for name in sorted(sources):
        if name.endswith(".c"):
            SubElement(files, "File", name=name)
    indent(root)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def _license() -> str:
    package = sys.modules[(__package__ or "").partition(".")[0]]
    return license_text("contactkit", Path(package.__path__[0]).parent / "LICENSE")


def _binaries(
    sources: Mapping[str, bytes], names: Sequence[str], compiler: str
) -> dict[str, bytes]:
    """Libraries of the platforms, by their path in the FMU."""
    found: dict[str, list[bytes]] = {}
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        for name, content in sources.items():
            (Path(folder) / name).write_bytes(content)
        for name in dict.fromkeys(names):
            key = (_digest(sources), name, compiler, os.environ.get("CC", ""))
            if key not in _COMPILED:
                library = Path(folder) / f"{name}.library"
                compile_kernel(Path(folder), name, library, compiler)
                _COMPILED[key] = library.read_bytes()
            place = PLATFORMS[name]
            path = f"binaries/{place.fmi2}/{_IDENTIFIER}{place.suffix}"
            found.setdefault(path, []).append(_COMPILED[key])
    return {path: one[0] if len(one) == 1 else join_macs(one) for path, one in found.items()}


def _pack(files: Mapping[str, bytes], target: Path) -> Path:
    """Write an FMU so that equal content gives equal bytes, and never half a file."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for path in sorted(files):
            info = zipfile.ZipInfo(path, date_time=(1980, 1, 1, 0, 0, 0))
            info.compress_type, info.create_system = zipfile.ZIP_DEFLATED, 3
            info.external_attr = 0o100644 << 16
            packed.writestr(info, files[path])
    target.parent.mkdir(parents=True, exist_ok=True)
    handle, partial = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(stream.getvalue())
        Path(partial).chmod(0o644)
        Path(partial).replace(target)
    except BaseException:
        Path(partial).unlink(missing_ok=True)
        raise
    return target
