"""Compiling the C kernel of native FMUs: for every platform with zig, for this one with cc too.

The ``ziglang`` package holds a whole C compiler and the libraries of all platforms.
"""

from __future__ import annotations

import importlib.util
import os
import platform
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from ...errors import ContactkitError, DescriptionError, MissingExtraError
from ...extras import require

__all__ = ["PLATFORMS", "compile_kernel", "compile_wasm", "fmi_headers", "has_zig", "local"]

_FLAGS = (
    "-std=c99",
    "-O3",
    "-DNDEBUG",
    "-fPIC",
    "-fvisibility=hidden",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-shared",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-s",
)
# -Os: the kernel of a page has 156 kB, and a release takes the same time as with -O3, which makes
# 184 kB of it.
_WASM_FLAGS = (
    *("-target", "wasm32-wasi", "-mexec-model=reactor", "-std=c99", "-Os", "-DNDEBUG"),
    *("-ffp-contract=off", "-fno-math-errno", "-fvisibility=hidden", "-s"),
    *("-Wall", "-Wextra", "-Werror"),
)
_HEADERS = {
    2: ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"),
    3: ("fmi3Functions.h", "fmi3FunctionTypes.h", "fmi3PlatformTypes.h"),
}
_WINDOWS = ("heap", "math", "private", "stdio", "string")  # parts of the C library of Windows


class Platform(NamedTuple):
    """A platform: its folders in FMUs of FMI 2 and 3, and zig's names of what goes in."""

    fmi2: str
    fmi3: str
    suffix: str
    target: str


PLATFORMS: dict[str, Platform] = {
    "linux-x86_64": Platform("linux64", "x86_64-linux", ".so", "x86_64-linux-gnu.2.17"),
    "linux-aarch64": Platform("aarch64-linux", "aarch64-linux", ".so", "aarch64-linux-gnu.2.17"),
    "windows-x86_64": Platform("win64", "x86_64-windows", ".dll", "x86_64-windows-gnu"),
    "macos-x86_64": Platform("darwin64", "x86_64-darwin", ".dylib", "x86_64-macos.11.0"),
    "macos-aarch64": Platform("darwin64", "aarch64-darwin", ".dylib", "aarch64-macos.11.0"),
}
"""Every platform there is a target for; in FMI 2 both kinds of Mac share one file."""


def local() -> str:
    """Name of this computer's platform.

    Raises
    ------
    ContactkitError
        If it is not among `PLATFORMS`.
    """
    system = {"linux": "linux", "win32": "windows", "darwin": "macos"}.get(sys.platform, "")
    machine = {"amd64": "x86_64", "arm64": "aarch64"}.get(
        platform.machine().lower(), platform.machine().lower()
    )
    name = f"{system}-{machine}"
    if name not in PLATFORMS:
        raise ContactkitError(
            f"native FMUs are built for {', '.join(PLATFORMS)}, and this is {sys.platform} "
            f"{machine}; name a platform, or compile the sources in an FMU"
        )
    return name


def has_zig() -> bool:
    """Whether the ``ziglang`` package is installed."""
    return importlib.util.find_spec("ziglang") is not None


def fmi_headers(fmi: int = 2) -> dict[str, bytes]:
    """Return the headers of the standard, from the installation of fmpy.

    Raises
    ------
    ContactkitError
        If fmpy is not there, or came without them.
    """
    found = importlib.util.find_spec("fmpy")
    if found is None or found.origin is None:
        raise MissingExtraError(
            "building a native FMU needs fmpy, which is not installed: pip install contactkit[fmu]",
            name="fmpy",
        )
    folder = Path(found.origin).parent / "c-code"
    try:
        return {name: (folder / name).read_bytes() for name in _HEADERS[fmi]}
    except OSError as error:
        raise ContactkitError(
            f"fmpy came without the headers of FMI: {error}; reinstall fmpy"
        ) from error


def compile_kernel(sources: Path, name: str, out: Path, compiler: str = "auto") -> None:
    """Compile the sources in a folder to a shared library.

    Parameters
    ----------
    sources : Path
        Folder with the sources and headers.
    name : str
        One of `PLATFORMS`.
    out : Path
        Library to write.
    compiler : {"auto", "zig", "cc"}
        zig, or the C compiler of this computer (environment variable ``CC``, else ``cc``), which
        compiles for this computer only; or what there is.

    Raises
    ------
    DescriptionError
        If there is no such platform or compiler.
    ContactkitError
        If no compiler is there, or it failed.
    """
    if name not in PLATFORMS:
        raise DescriptionError("platform", name, "be one of " + ", ".join(PLATFORMS))
    if compiler not in ("auto", "zig", "cc"):
        raise DescriptionError("compiler", compiler, "be 'auto', 'zig' or 'cc'")
    files = sorted(path.name for path in sources.glob("*.c"))
    driver = _driver(name, compiler)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        made = Path(folder) / f"kernel{PLATFORMS[name].suffix}"  # some keep the name they had
        more = _more(name, zig="ziglang" in driver)
        done = subprocess.run(
            [*driver, *_FLAGS, *files, "-o", str(made), *more],
            cwd=sources,
            capture_output=True,
            text=True,
            check=False,
            env=os.environ | {"SOURCE_DATE_EPOCH": "315532800", "ZERO_AR_DATE": "1"},
        )
        if done.returncode or not made.exists():
            raise ContactkitError(
                f"the kernel could not be compiled for {name}; set CC to another compiler of C99, "
                f"or pip install contactkit[native]. It said:\n{done.stderr}"
            )
        shutil.copy(made, out)


def compile_wasm(sources: Mapping[str, bytes], purpose: str, more: Sequence[str] = ()) -> bytes:
    """Compile sources to a module of WebAssembly, by zig.

    Parameters
    ----------
    sources : mapping of str to bytes
        Sources and headers by file name.
    purpose : str
        What needs it, for the message where zig is not installed.
    more : sequence of str
        Flags beside those of every module.

    Raises
    ------
    MissingExtraError
        If ziglang is not installed.
    ContactkitError
        If the compiler failed.
    """
    require("ziglang", purpose)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        for name, text in sources.items():
            (Path(folder) / name).write_bytes(text)
        made = Path(folder) / "kernel.wasm"
        files = sorted(name for name in sources if name.endswith(".c"))
        done = subprocess.run(
            [sys.executable, "-m", "ziglang", "cc", *_WASM_FLAGS, *more, *files, "-o", str(made)],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode or not made.exists():
            raise ContactkitError(
                "the kernel could not be compiled to WebAssembly; install the version of ziglang "
                f"that contactkit[native] names. It said:\n{done.stderr}"
            )
        return made.read_bytes()


def _more(name: str, zig: bool) -> list[str]:
    """Return the flags of a platform."""
    if name.startswith("macos"):  # a library for a Mac holds the name it is loaded by
        return [f"-Wl,-install_name,@rpath/kernel{PLATFORMS[name].suffix}"]
    if not (zig and name.startswith("windows")):
        return ["-lm"]
    # zig would first compile 440 files of MinGW, for minutes: kernel/windows.c takes their place
    found = importlib.util.find_spec("ziglang")
    home = Path(found.origin).parent if found and found.origin else Path()
    headers = home / "lib" / "libc" / "include" / "any-windows-any"
    libraries = [f"-lapi-ms-win-crt-{part}-l1-1-0" for part in _WINDOWS]
    return ["-nostdlib", "-isystem", str(headers), "-DCK_BARE_WINDOWS", "-lkernel32", *libraries]


def _driver(name: str, compiler: str) -> list[str]:
    """Return the command of a compiler for a platform."""
    if compiler != "cc" and has_zig():
        return [sys.executable, "-m", "ziglang", "cc", "-target", PLATFORMS[name].target]
    if compiler == "zig" or name != local():
        raise ContactkitError(f"compiling for {name} needs ziglang: pip install contactkit[native]")
    own = os.environ.get("CC", "cc").split()
    if not own or shutil.which(own[0]) is None:
        raise ContactkitError(
            "a native FMU needs a C compiler: set CC, or pip install contactkit[native]"
        )
    return own


def join_macs(libraries: Sequence[bytes]) -> bytes:
    """Join libraries of one kind of Mac each to one for all (a "fat" Mach-O file)."""
    align = 14  # two to this: the page of an arm64 Mac
    head = struct.pack(">II", 0xCAFEBABE, len(libraries))
    offset, places, body = 1 << align, b"", b""
    for library in libraries:
        magic, kind, variant = struct.unpack("<III", library[:12])
        if magic != 0xFEEDFACF:
            raise ContactkitError(
                "the compiler did not write a library for a Mac; pip install contactkit[native], "
                "which compiles for it"
            )
        places += struct.pack(">IIIII", kind, variant, offset + len(body), len(library), align)
        body += library + b"\0" * (-len(library) % (1 << align))
    return (head + places).ljust(1 << align, b"\0") + body
