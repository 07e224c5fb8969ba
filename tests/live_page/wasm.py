"""The module of a live page in a WebAssembly runtime, called as ``template/kernel.js`` calls it."""

from __future__ import annotations

import gzip
import importlib.util
import math
from base64 import b64decode

import numpy as np
import pytest

from contactkit.liquids.temperature_table import LiquidTable

NEEDED = ("ziglang", "wasmtime")
MISSING = [name for name in NEEDED if importlib.util.find_spec(name) is None]
needs_runtime = pytest.mark.skipif(
    bool(MISSING), reason=f"{' and '.join(MISSING)} not installed: pip install contactkit[test-all]"
)

COLUMNS = 19  # the last eight are the laws of forces
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

    def fill(self, calls, numbers):
        at = self._call(f"{calls}_room", len(numbers))
        self.calls["memory"].write(self.store, np.array(numbers, dtype="<f8").tobytes(), at)
        if not self._call(f"{calls}_open", len(numbers)):
            raise ValueError(self.said())

    def load(self, numbers, variables=(), force=0.0, rise=0.0, limit=3600.0):
        self.fill("ck_page", numbers)
        self._call("ck_page_reset", force, rise, limit)
        if not all(self._call("ck_page_set", *one) for one in variables):
            raise ValueError(self.said())

    def begin(self, numbers, variables=(), force=0.0, rise=0.0, limit=3600.0):
        self.load(numbers, variables, force, rise, limit)
        if not self._call("ck_page_start"):
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


class Valve(Wasm):
    """The page of an injector, driven as ``template/valve.js`` drives it."""

    def __init__(self, data):
        super().__init__()
        self.data = data
        self.film = unpacked(data["numbers"])[: data["count"]]
        self.drive = unpacked(data["drive"])
        self.start = {one["name"]: one["value"] for one in data["sliders"]}

    def run(self, until_release=True, dry=False, **values):
        """Time of the release [s], nan if there is none within the pulse; rows."""
        now, data = self.start | values, self.data
        film, drive = [*self._liquid(now), *self._tensions(now)], []
        for one in data["sliders"]:
            if now[one["name"]] == one["value"]:
                continue
            for model, reference, offset in one.get("targets", ()):
                chosen = film if model == "film" else drive
                chosen.append((reference, now[one["name"]] + offset))
        references = data["references"]
        if dry:
            film += [(references[name], 0.0) for name in ("dp_inception", "dp_hold")]
            film.append((references["eta"], 1e-15))
        self.fill("ck_valve", self.drive)
        self._call("ck_valve_reset")
        self.load(self.film, film, limit=data["times"]["cycle"])
        if not all(self._call("ck_valve_set", *one) for one in drive):
            raise ValueError(self.said())
        if not self._call("ck_valve_start"):
            raise ValueError(self.said())
        return self._steps(until_release)

    def _liquid(self, now):
        kelvin = now.get("temperature")
        if kelvin == self.start.get("temperature"):
            return []
        liquid = LiquidTable(**self.data["liquid"])
        ratio = {
            name: liquid.at(name, kelvin) / liquid.at(name, self.start["temperature"])
            for name in liquid.logs
        }
        return [
            (one["reference"], one["value"] * ratio[one["name"]]) for one in self.data["properties"]
        ]

    def _tensions(self, now):
        references = self.data["references"]
        if self.data["limit"] < 0:
            return []
        inside = max(now["cavity"], -now["tension"])
        return [
            (references["dp_inception"], now["ambient"] + now["tension"]),
            (references["dp_hold"], now["ambient"] - inside),
        ]

    def _steps(self, until_release):
        times = self.data["times"]
        end = times["pulse"] if until_release else times["cycle"]
        longest = min(self.data["step"], 0.2 * self._call("ck_valve_longest"))
        length = end / math.ceil(end / longest - 1e-9)
        rows, ended = list[np.ndarray](), 0
        while ended == 0:
            ended = self._call("ck_valve_run", length, end, int(until_release))
            count = self._call("ck_valve_count")
            rows.append(self._numbers(self._call("ck_valve_rows"), count * 13).reshape(-1, 13))
        if ended < 0:
            raise ValueError(self.said())
        self._call("ck_page_numbers")
        release = self.rows()[0][2]
        return (release if 0.0 <= release <= times["pulse"] else math.nan), np.concatenate(rows)


def unpacked(text):
    """Numbers that a page carries as text."""
    return np.frombuffer(gzip.decompress(b64decode(text)), dtype="<f8")
