"""FMUs and kernels of a run of the tests: each is built once, by the worker that first wants it."""

from __future__ import annotations

import hashlib
import os
import shutil

try:
    import fcntl
except ImportError:  # Windows: each worker builds for itself
    fcntl = None

from contactkit.fmu.framework import toolchain

__all__ = ["Shelf", "compiled_once"]


class Shelf:
    """Folder that all workers share, where what is made stays until the run ends."""

    def __init__(self, tmp_path_factory):
        root = tmp_path_factory.getbasetemp()
        is_shared = "PYTEST_XDIST_WORKER" in os.environ and fcntl is not None
        self._root = (root.parent if is_shared else root) / "shelf"
        self._root.mkdir(exist_ok=True)

    def folder(self, name, make):
        """Folder that ``make(folder)`` fills, unless another worker has done so."""
        done, parts = self._root / name, self._root / f"{name}.parts"
        with (self._root / f"{name}.lock").open("w") as lock:
            if fcntl:
                fcntl.flock(lock, fcntl.LOCK_EX)
            if not done.exists():
                shutil.rmtree(parts, ignore_errors=True)
                parts.mkdir()
                make(parts)
                parts.rename(done)
        return done

    def __call__(self, build, *what, **given):
        """FMU of ``build(*what, path, **given)``; identified by the `repr` of the arguments."""
        asked = repr((build.__module__, build.__name__, what, sorted(given.items())))
        name = hashlib.sha256(asked.encode()).hexdigest()[:16]
        return self.folder(name, lambda place: build(*what, place / "x.fmu", **given)) / "x.fmu"

    def unpacked(self, path):
        """Folder with the files of an FMU, distinguished by its bytes."""
        import fmpy

        name = "unpacked " + hashlib.sha256(path.read_bytes()).hexdigest()[:16]
        return self.folder(name, lambda place: fmpy.extract(str(path), str(place)))


def compiled_once(shelf):
    """`compile_kernel`, but a kernel that one worker has compiled serves all: it takes 5 s."""

    def compile_once(sources, name, out, compiler="auto"):
        files = [path for path in sorted(sources.iterdir()) if path.suffix in {".c", ".h"}]
        texts = [(path.name, path.read_bytes()) for path in files]
        used = ("zig" if toolchain.has_zig() else "cc") if compiler == "auto" else compiler
        asked = repr((texts, name, used, os.environ.get("CC")))
        kept = shelf.folder(
            "kernel " + hashlib.sha256(asked.encode()).hexdigest()[:16],
            lambda place: toolchain.compile_kernel(sources, name, place / "library", compiler),
        )
        shutil.copy(kept / "library", out)

    return compile_once
