"""The C kernel as a WebAssembly module without imports, compiled by zig."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path

from ..errors import ContactkitError
from ..extras import require
from ..fmu.native.sources import kernel_sources

__all__ = ["kernel_module"]

# -Os: 156 kB, and a release takes the same time as with -O3, which makes 184 kB of it.
_FLAGS = (
    *("-target", "wasm32-wasi", "-mexec-model=reactor", "-std=c99", "-Os", "-DNDEBUG"),
    *("-ffp-contract=off", "-fno-math-errno", "-fvisibility=hidden", "-s"),
    *("-Wall", "-Wextra", "-Werror"),
)


def page_sources() -> dict[str, bytes]:
    """Sources of the module by file name: those of a native FMU, with the calls of a page."""
    folder = Path(__file__).with_name("kernel")
    own = {path.name: path.read_bytes() for path in sorted(folder.glob("*.[ch]"))}
    shared = {name: text for name, text in kernel_sources().items() if name != "fmi2.c"}
    return {**shared, **own}


@cache
def kernel_module() -> bytes:
    """Compile the kernel.

    It imports nothing: a page, or any runtime, calls its ``ck_page_...`` and ``ck_valve_...``
    functions.

    Raises
    ------
    MissingExtraError
        If ziglang is not installed.
    ContactkitError
        If the compiler failed.
    """
    require("ziglang", "a live page, whose kernel is compiled to WebAssembly,")
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        sources = page_sources()
        for name, text in sources.items():
            (Path(folder) / name).write_bytes(text)
        compiled = sorted(name for name in sources if name.endswith(".c"))
        made = Path(folder) / "page.wasm"
        done = subprocess.run(
            [sys.executable, "-m", "ziglang", "cc", *_FLAGS, *compiled, "-o", str(made)],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode or not made.exists():
            raise ContactkitError(
                "the kernel of the page could not be compiled to WebAssembly; install the version "
                f"of ziglang that contactkit[native] names. It said:\n{done.stderr}"
            )
        return made.read_bytes()
