"""Calls of FMI 2 and FMI 3 as they are in C, by ctypes: nothing shields the FMU from its host.

Runs in a process of its own, which must outlive whatever it asks for; imports nothing of ours.
"""

from __future__ import annotations

import ctypes as c
from pathlib import Path

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
MOST = 1 << 16

Reference = c.c_uint32
_LOG2 = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p)
_LOG3 = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)
_NEW = c.CFUNCTYPE(c.c_void_p, c.c_size_t, c.c_size_t)
_FREE = c.CFUNCTYPE(None, c.c_void_p)


class Callbacks(c.Structure):
    _fields_ = (
        ("logger", _LOG2),
        ("allocate", _NEW),
        ("free", _FREE),
        ("finished", c.c_void_p),
        ("environment", c.c_void_p),
    )


_libc = c.CDLL(None)
_libc.calloc.restype, _libc.calloc.argtypes = c.c_void_p, (c.c_size_t, c.c_size_t)
_libc.free.restype, _libc.free.argtypes = None, (c.c_void_p,)
_KINDS2 = {"real": c.c_double, "integer": c.c_int, "boolean": c.c_int, "string": c.c_char_p}
_KINDS3 = {
    "real": ("Float64", c.c_double),
    "integer": ("Int32", c.c_int32),
    "enumeration": ("Int64", c.c_int64),
    "boolean": ("Boolean", c.c_bool),
    "string": ("String", c.c_char_p),
}


class Library:
    """The library of an unpacked FMU."""

    def __init__(self, spec: dict) -> None:
        self.spec = spec
        self.version = int(spec["version"])
        self.path = Path(spec["library"])
        self.handle = c.CDLL(str(self.path))
        self.keep: list = []  # what the FMU may still point to

    def function(self, name: str, result=c.c_int):
        found = getattr(self.handle, f"fmi{self.version}{name}")
        found.restype, found.argtypes = result, None
        return found

    @property
    def resources(self) -> str:
        folder = Path(self.spec["folder"]) / "resources"
        return folder.as_uri() if self.version == 2 else f"{folder}/"

    def open(self, **changes):
        """Return an instance, or None if there is none."""
        instance = Instance(self, **changes)
        return instance if instance.pointer else None


class Instance:
    """One instance; every status it ever gave is in `statuses`, its messages in `log`."""

    def __init__(self, library: Library, **changes) -> None:
        self.library, self.version = library, library.version
        self.statuses: list[tuple[str, int]] = []
        self.log: list[tuple[int, str, str]] = []
        library.keep.append(self)
        given = {
            "name": b"probe",
            "guid": library.spec["guid"].encode(),
            "logging": True,
            "resources": library.resources.encode(),
            "kind": 1,
            "silent": False,
            "events": False,
        }
        given |= changes
        self.pointer = (self._open2 if self.version == 2 else self._open3)(given)

    def _open2(self, given):
        def hear(_environment, _name, status, category, message):
            self.log.append((status, (category or b"").decode(), (message or b"").decode()))

        logger = _LOG2() if given["silent"] else _LOG2(hear)
        allocate, free = _NEW(lambda n, size: _libc.calloc(n, size)), _FREE(_libc.free)
        self.callbacks = Callbacks(logger, allocate, free, None, None)
        return self.library.function("Instantiate", c.c_void_p)(
            given["name"],
            c.c_int(given["kind"]),
            given["guid"],
            given["resources"],
            c.byref(self.callbacks),
            c.c_int(0),
            c.c_int(given["logging"]),
        )

    def _open3(self, given):
        def hear(_environment, status, category, message):
            self.log.append((status, (category or b"").decode(), (message or b"").decode()))

        self.callbacks = _LOG3() if given["silent"] else _LOG3(hear)
        if given["kind"] == 1:
            name, more = (
                "CoSimulation",
                (
                    c.c_bool(given["events"]),
                    c.c_bool(given["events"]),
                    None,
                    c.c_size_t(0),
                ),
            )
            after = (None, self.callbacks, None)
        else:
            name, more, after = "ModelExchange", (), (None, self.callbacks)
        return self.library.function(f"Instantiate{name}", c.c_void_p)(
            given["name"],
            given["guid"],
            given["resources"],
            c.c_bool(False),
            c.c_bool(given["logging"]),
            *more,
            *after,
        )

    def call(self, name: str, *arguments) -> int:
        """Status of a function, called with just these arguments after the instance."""
        status = self.library.function(name)(c.c_void_p(self.pointer), *arguments)
        self.statuses.append((name, status))
        return status

    # life cycle ------------------------------------------------------------------------------

    def setup(self, start=0.0, stop=None, tolerance=None) -> int:
        self.begin = (start, stop, tolerance)
        if self.version == 3:
            return OK
        return self.call(
            "SetupExperiment",
            c.c_int(tolerance is not None),
            c.c_double(tolerance or 0.0),
            c.c_double(start),
            c.c_int(stop is not None),
            c.c_double(stop or 0.0),
        )

    def enter(self) -> int:
        if self.version == 2:
            return self.call("EnterInitializationMode")
        start, stop, tolerance = getattr(self, "begin", (0.0, None, None))
        return self.call(
            "EnterInitializationMode",
            c.c_bool(tolerance is not None),
            c.c_double(tolerance or 0.0),
            c.c_double(start),
            c.c_bool(stop is not None),
            c.c_double(stop or 0.0),
        )

    def exit(self) -> int:
        return self.call("ExitInitializationMode")

    def terminate(self) -> int:
        return self.call("Terminate")

    def reset(self) -> int:
        return self.call("Reset")

    def free(self) -> None:
        self.library.function("FreeInstance", None)(c.c_void_p(self.pointer))

    def step(self, time: float, length: float) -> int:
        if self.version == 2:
            return self.call("DoStep", c.c_double(time), c.c_double(length), c.c_int(1))
        flags, last = [c.c_bool() for _ in range(3)], c.c_double()
        return self.call(
            "DoStep",
            c.c_double(time),
            c.c_double(length),
            c.c_bool(True),
            *map(c.byref, flags),
            c.byref(last),
        )

    # variables -------------------------------------------------------------------------------

    def _access(self, verb, kind, references, values, count=None):
        """Get or set; `count` says other than the true number of references."""
        n = len(references) if count is None else count
        names = (Reference * max(1, len(references)))(*references)
        if self.version == 2:
            name, size = "Integer" if kind == "enumeration" else kind.capitalize(), ()
        else:
            name, size = _KINDS3[kind][0], (c.c_size_t(n),)
        return self.call(verb + name, names, c.c_size_t(n), values, *size)

    def _array(self, kind, values):
        if self.version == 2:
            one = _KINDS2["integer" if kind == "enumeration" else kind]
        else:
            one = _KINDS3[kind][1]
        return (one * max(1, len(values)))(*values)

    def set(self, kind: str, references: list[int], values: list) -> int:
        return self._access("Set", kind, references, self._array(kind, values))

    def get(self, kind: str, references: list[int]) -> tuple[int, list]:
        nothing = b"" if kind == "string" else 0
        values = self._array(kind, [nothing] * len(references))
        status = self._access("Get", kind, references, values)
        return status, list(values)[: len(references)]

    # states ----------------------------------------------------------------------------------

    def _state(self, name: str) -> str:
        """Write the name of a function as in FMI 2, or as in FMI 3."""
        return name if self.version == 2 else name.replace("FMUs", "FMUS").replace("DeS", "Des")

    def take(self):
        state = c.c_void_p()
        status = self.call(self._state("GetFMUstate"), c.byref(state))
        return status, state

    def restore(self, state) -> int:
        return self.call(self._state("SetFMUstate"), state)

    def drop(self, state) -> int:
        return self.call(self._state("FreeFMUstate"), c.byref(state))

    def write(self, state) -> tuple[int, bytes]:
        size = c.c_size_t()
        status = self.call(self._state("SerializedFMUstateSize"), state, c.byref(size))
        if status != OK or size.value > MOST:
            return status, b""
        room = (c.c_char * size.value)()
        status = self.call(self._state("SerializeFMUstate"), state, room, size)
        return status, bytes(room)

    def read(self, content: bytes):
        state = c.c_void_p()
        room = c.create_string_buffer(content, max(1, len(content)))
        size = c.c_size_t(len(content))
        status = self.call(self._state("DeSerializeFMUstate"), room, size, c.byref(state))
        return status, state
