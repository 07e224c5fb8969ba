"""A guard in C between a host and the library of pythonfmu.

That library trusts its host: an instance freed twice, a resource location with an odd letter or a
forgotten argument end the process, before any code of ours runs. The guard takes its place in an
FMU, checks what the host hands over, and passes it on. It is compiled when the FMU is built; where
there is no compiler the FMU is as pythonfmu made it.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from ....errors import ContactkitError
from ...framework.toolchain import compile_kernel, fmi_headers, has_zig, local

__all__ = ["can_guard", "protect"]

_PLATFORM = "linux-x86_64"  # the one whose loader needs a guard most, and that could be tested
_FOLDER = "binaries/linux64"
_SHARED = ("host.c", "host.h")  # of the native kernel, in fmi


def can_guard() -> bool:
    """Whether there is a compiler for the guard."""
    return importlib.util.find_spec("fmpy") is not None and bool(_compiler())


def protect(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Put the guard into the files of an FMU that pythonfmu made.

    Parameters
    ----------
    files : mapping of str to bytes
        Content of each file of the FMU, by its path.

    Returns
    -------
    dict of str to bytes
        The same with the guard in place of the library for Linux, and the library beside it;
        unchanged where there is no compiler.

    Raises
    ------
    ContactkitError
        If the guard cannot be compiled.
    """
    own = [path for path in files if path.startswith(_FOLDER) and path.endswith(".so")]
    guid = re.search(rb'guid="([^"]*)"', files["modelDescription.xml"])
    if not can_guard() or len(own) != 1 or guid is None:
        return dict(files)
    return {
        **files,
        own[0]: _compiled(_compiler(), os.environ.get("CC", "")),
        f"{_FOLDER}/pythonfmu.so": files[own[0]],
        "resources/guard.txt": guid[1] + b"\n" + files.get("resources/slavemodule.txt", b""),
    }


def _compiler() -> str:
    """Return the compiler to use: the one of this computer if that is right, else zig, if any."""
    try:
        here = local() == _PLATFORM
    except ContactkitError:  # no platform of ours
        here = False
    words = os.environ.get("CC", "cc").split()
    if here and words and shutil.which(words[0]):
        return "cc"
    return "zig" if has_zig() else ""


@cache
def _compiled(compiler: str, _variable: str) -> bytes:
    here = Path(__file__).parent
    kernel = here.parents[1] / "native" / "kernel" / "fmi"
    with tempfile.TemporaryDirectory(prefix="contactkit-") as name:
        folder = Path(name)
        for source in (here / "guard.c", *(kernel / shared for shared in _SHARED)):
            shutil.copy(source, folder)
        for header, content in fmi_headers().items():
            (folder / header).write_bytes(content)
        library = folder / "guard.library"
        compile_kernel(folder, _PLATFORM, library, compiler)
        return library.read_bytes()
