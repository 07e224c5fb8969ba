"""Integrity of an FMU: it runs the code it was built from, and no other.

All FMUs in one process share Python's table of modules. Their packages therefore carry a hash in
their name; this module makes the hash, and checks it when an FMU is instantiated, which is the
one moment when pythonfmu lets a slave refuse cleanly by raising.
"""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import ContactkitError

__all__ = ["RECORD", "content_hash", "package_name", "verify"]

RECORD = "build.json"


def content_hash(record: Mapping[str, Any], sources: Mapping[str, bytes]) -> str:
    """Hash of all that decides what an FMU computes.

    Parameters
    ----------
    record : mapping
        How it was built: name, start values, versions.
    sources : mapping
        Content of each vendored file, by its path with forward slashes.
    """
    digest = hashlib.sha256(json.dumps(record, sort_keys=True).encode())
    for path in sorted(sources):
        digest.update(f"\0{path}\0{len(sources[path])}\0".encode())
        digest.update(sources[path])
    return digest.hexdigest()


def package_name(build: str) -> str:
    """Name of the package of a build."""
    return f"contactkit_{build[:12]}"


def verify(resources: str, build: str) -> dict[str, Any]:
    """Check the files of an FMU against the hash it was built with.

    Parameters
    ----------
    resources : str
        The FMU's unpacked ``resources`` folder.
    build : str
        The hash in the code that is running.

    Returns
    -------
    dict
        How the FMU was built: what `content_hash` was given.

    Raises
    ------
    ContactkitError
        If a file was changed, added or lost since.
    """
    folder = Path(resources) / package_name(build)
    try:
        record: dict[str, Any] = json.loads((Path(resources) / RECORD).read_bytes())
        sources = {
            path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.py")
        }
    except (OSError, ValueError) as error:
        raise ContactkitError(f"the FMU is incomplete: {error}; build it again") from error
    if content_hash(record, sources) != build:
        raise ContactkitError(
            f"the code in {folder} is not that of build {build[:12]}: it was changed after the "
            "FMU was built; build it again"
        )
    _relocate(folder)
    return record


def _relocate(folder: Path) -> None:
    """Let packages that came from a folder that is gone load the rest of themselves from here.

    Hosts unpack an FMU into a temporary folder each time; Python keeps the modules of the first.
    """
    for name, module in list(sys.modules.items()):
        package, _, rest = name.partition(".")
        if package != folder.name:  # many a module of others makes its attributes when asked
            continue
        paths = getattr(module, "__path__", None)
        if paths and not any(Path(path).exists() for path in paths):
            module.__path__ = [str(folder.joinpath(*filter(None, rest.split("."))))]
