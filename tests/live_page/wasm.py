"""The module of a live page in a WebAssembly runtime, called as ``template/kernel.js`` calls it."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest

NEEDED = ("ziglang", "wasmtime")
MISSING = [name for name in NEEDED if importlib.util.find_spec(name) is None]
needs_runtime = pytest.mark.skipif(
    bool(MISSING), reason=f"{' and '.join(MISSING)} not installed: pip install contactkit[test-all]"
)

COLUMNS = 10
HOW = {-1: "failed", 0: "steps", 1: "released", 2: "stuck", 3: "late"}


class Wasm:
    """An instance of the module."""

    def __init__(self):
        import wasmtime

        from contactkit.live_page.module import kernel_module

        engine = wasmtime.Engine()
        self.module = wasmtime.Module(engine, kernel_module())
        self.store = wasmtime.Store(engine)
        self.calls = wasmtime.Instance(self.store, self.module, []).exports(self.store)
        self._call("_initialize")

    def _call(self, name, *given):
        return self.calls[name](self.store, *given)

    def _numbers(self, first, count):
        found = self.calls["memory"].read(self.store, first, first + 8 * count)
        return np.frombuffer(bytes(found), dtype="<f8")

    def said(self):
        first = self._call("ck_page_said")
        return (
            bytes(self.calls["memory"].read(self.store, first, first + 600))
            .split(b"\0")[0]
            .decode()
        )

    def rows(self):
        count = self._call("ck_page_count")
        return self._numbers(self._call("ck_page_rows"), count * COLUMNS).reshape(-1, COLUMNS)

    def begin(self, numbers, variables=(), force=0.0, rise=0.0, limit=3600.0):
        at = self._call("ck_page_room", len(numbers))
        self.calls["memory"].write(self.store, np.array(numbers, dtype="<f8").tobytes(), at)
        fine = self._call("ck_page_open", len(numbers))
        if fine:
            self._call("ck_page_reset", force, rise, limit)
            fine = all(self._call("ck_page_set", *one) for one in variables)
        if not (fine and self._call("ck_page_start")):
            raise ValueError(self.said())

    def motion(self):
        """How it ended, the numbers by name, and the rows."""
        rows, ended = [self.rows()], 0
        while ended == 0 and self._call("ck_page_numbers") < 20_000:
            ended = self._call("ck_page_step")
            rows.append(self.rows())
        self._call("ck_page_numbers")
        names = ("peak_force", "peak_time", "release_time", "release_speed", "break_time")
        numbers = dict(
            zip((*names, "dissipated_work", "viscous_impulse"), self.rows()[0], strict=False)
        )
        return HOW[ended], numbers | {"n_steps": self.rows()[0][8]}, np.concatenate(rows)

    def at(self, gap, speed):
        self._call("ck_page_at", gap, speed)
        return self.rows()[0]

    def end(self):
        return self._call("ck_page_end")
