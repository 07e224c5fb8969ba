"""The C kernel as a WebAssembly module without imports, compiled by zig."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ..fmu.framework.toolchain import compile_wasm
from ..fmu.native.sources import kernel_sources

__all__ = ["kernel_module"]


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
    return compile_wasm(page_sources(), "a live page, whose kernel is compiled to WebAssembly,")
