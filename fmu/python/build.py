"""Writing FMU files: `build` makes one, `validate` lets fmpy check it.

An FMU carries the modules it needs under a package name made from their hash, so that several
builds can run in one process. Building twice from the same sources gives the same bytes.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import json
import os
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree.ElementTree import indent, tostring

from ..._version import __version__
from ...errors import ContactkitError, DescriptionError
from ...extras import require
from ...reading.xml_elements import read_xml
from ..contents.document import Page, external_dependencies, index_page, license_text
from ..contents.packing import write_archive
from ..contents.terminals import annotate_terminal, terminal_files
from ..framework.ports import Value, start_value
from .guard import protect
from .integrity import RECORD, content_hash, package_name
from .vendor import Closure, find_closure

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..framework.slave import PortSlave

__all__ = ["FMUS", "build", "validate"]

# name: module in contactkit.fmu, class
FMUS: dict[str, tuple[str, str]] = {
    "stiction-mass": ("slaves.stiction_mass", "StictionMass"),
    "valve-drive": ("slaves.valve_drive", "ValveDrive"),
    "tip-contact": ("slaves.tip_contact", "TipContact"),
    "stiction-force": ("slaves.stiction_force", "StictionForce"),
    "contact-stop": ("slaves.contact_stop", "ContactStop"),
}
# name: module in contactkit.fmu whose `bake` makes tables of what is given beside start values
BAKERS = dict.fromkeys(("contact-stop", "valve-drive", "tip-contact"), "contents.end_stop")

_SCRIPT = '''\
"""Main script of this FMU: contactkit wrote it, pythonfmu loads it."""

from {package}.fmu.python.integrity import verify
from {package}.fmu.slaves.{module} import {class_name} as Model


class {class_name}(Model):
    """The model with the start values of this build."""

    build = {build!r}
    made_with = {version!r}
    baked = {baked!r}

    # The class needs a method of its own: pythonfmu 0.7 gives back a reference to this module's
    # namespace that it never took, each time it instantiates, and only a function renews one.
    def __init__(self, **kwargs):
        record = verify(kwargs["resources"], self.build)
        type(self).data = record["data"]  # tables, under the hash of the build
        super().__init__(**kwargs)
'''

# pythonfmu's builder leaves its traces in sys.path and sys.modules; another process keeps them
_PACK = """\
import sys
from pythonfmu import FmuBuilder
script, dest, documentation, *project_files = sys.argv[1:]
FmuBuilder.build_FMU(script, dest, project_files, documentation)
"""


def build(
    name: str, out: str | os.PathLike[str], *, start: Mapping[str, Any] | None = None
) -> Path:
    """Write an FMU (FMI 2.0, co-simulation).

    Parameters
    ----------
    name : str
        One of `FMUS`.
    out : path
        The file to write, or a folder to write ``<name>.fmu`` to.
    start : mapping, optional
        Start values to bake in, by variable; a text carries its unit (``"2.5 um"``).
        ``contact-stop``, ``valve-drive`` and ``tip-contact`` also take a ``curve``, a
        `LoadDisplacementCurve`; that of ``tip-contact`` is of one tip.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If the name, a variable or a start value is not possible, or two of them contradict
        each other.
    ContactkitError
        If pythonfmu is not installed, or the FMU could not be made.
    """
    slave = _slave_class(name)
    given, data = dict(start or {}), dict[str, Any]()
    if name in BAKERS:
        data = importlib.import_module(f"..{BAKERS[name]}", __package__).bake(name, given)
    baked = {key: start_value(slave.ports, key, value) for key, value in given.items()}
    values = slave.start_values() | baked  # contradictions would only be found by the host
    slave.check_start(values)
    target = Path(out)
    if target.is_dir():
        target /= f"{name}.fmu"
    if target.suffix != ".fmu":
        raise DescriptionError("out", str(out), "end in .fmu or be a folder that exists")
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        fmu = _pack(slave, name, dict(sorted(baked.items())), Path(folder), data)
        with zipfile.ZipFile(fmu) as packed:
            files = {path: packed.read(path) for path in packed.namelist()}
    root = read_xml(files["modelDescription.xml"], "modelDescription.xml")
    annotate_terminal(root, slave.ports)
    indent(root)
    files["modelDescription.xml"] = tostring(root, encoding="utf-8", xml_declaration=True)
    return write_archive(protect(files) | terminal_files(slave.ports), target)


def validate(path: str | os.PathLike[str]) -> list[str]:
    """Problems that fmpy finds in an FMU; none if it is fine."""
    require("fmpy", "checking an FMU")
    from fmpy.validation import validate_fmu

    return [str(problem) for problem in validate_fmu(os.fspath(path))]


def _slave_class(name: str) -> type[PortSlave]:
    if name not in FMUS:
        raise DescriptionError("FMU", name, "be one of " + ", ".join(FMUS))
    require("pythonfmu", "building an FMU")
    module, class_name = FMUS[name]
    slave: type[PortSlave] = getattr(
        importlib.import_module(f"..{module}", __package__), class_name
    )
    return slave


def _pack(
    slave: type[PortSlave],
    name: str,
    baked: Mapping[str, Value],
    folder: Path,
    data: Mapping[str, Any],
) -> Path:
    """Lay out the files of an FMU in a folder and let pythonfmu pack them."""
    closure = find_closure(slave.__module__, f"{__package__}.integrity")
    record = {
        "fmu": name,
        "class": slave.__name__,
        "version": __version__,
        "start": baked,
        "data": data,
        "script": _SCRIPT,
        "requires": sorted(closure.requires),
        "pythonfmu": importlib.metadata.version("pythonfmu"),
        "attrs": importlib.metadata.version("attrs"),
    }
    identity = content_hash(record, closure.sources)
    module = slave.__module__.rpartition(".")[2]
    script = _SCRIPT.format(
        package=package_name(identity),
        module=module,
        class_name=slave.__name__,
        build=identity,
        version=__version__,
        baked=dict(baked),
    )
    main = f"{module}_{identity[:12]}.py"
    files = {f"{package_name(identity)}/{path}": text for path, text in closure.sources.items()}
    files |= {main: script.encode(), RECORD: json.dumps(record, sort_keys=True).encode()}
    _write(folder / "resources", files)
    _write(folder / "documentation", _documentation(slave, name, baked, closure))
    top = sorted({path.partition("/")[0] for path in files} - {main})
    return _run_builder(folder, main, top, name)


def _documentation(
    slave: type[PortSlave], name: str, baked: Mapping[str, Value], closure: Closure
) -> dict[str, bytes]:
    start = slave.start_values() | dict(baked)
    # What is imported only when called for, such as numpy by a sphere, this model does without.
    needed = find_closure(slave.__module__, at_once=True).requires
    requires = closure.requires & needed
    later = closure.requires - needed
    page = Page.of_python(
        requires,
        name=name,
        title=slave.__name__,
        summary=slave.summary,
        ports=slave.ports,
        start=start,
        scene=_scene(slave, start),
    )
    package = sys.modules[(__package__ or "").partition(".")[0]]
    own = Path(package.__path__[0]).parent / "LICENSE"
    return {
        "index.html": index_page(page).encode(),
        "externalDependencies.txt": external_dependencies(requires, later).encode(),
        "licenses/license.txt": license_text("contactkit", own).encode(),
        "licenses/attrs.txt": license_text("attrs").encode(),
        "licenses/pythonfmu.txt": license_text("pythonfmu").encode(),
    }


def _scene(slave: type[PortSlave], start: Mapping[str, Value]) -> SeparationScene | None:
    """Scene that the start values describe, for the documentation, if the model is made of one."""
    scene_of = getattr(sys.modules[slave.__module__], "scene_of", None)
    try:
        return scene_of(start) if scene_of is not None else None
    except ContactkitError:  # they contradict each other; the host may yet set others
        return None


def _write(folder: Path, files: Mapping[str, bytes]) -> None:
    for path, content in files.items():
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)


def _run_builder(folder: Path, main: str, others: list[str], name: str) -> Path:
    resources, fmu = folder / "resources", folder / "raw.fmu"
    arguments = [resources / main, fmu, folder / "documentation", *(resources / o for o in others)]
    settings = {"PYTHONDONTWRITEBYTECODE": "1", "TMPDIR": str(folder), "TEMP": str(folder)}
    done = subprocess.run(
        [sys.executable, "-c", _PACK, *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | settings,
    )
    if done.returncode or not fmu.exists():
        raise ContactkitError(f"pythonfmu could not build {name!r}:\n{done.stderr.strip()}")
    return fmu
