"""A host of one native FMU on an emulated processor, for FMI 2 and 3."""

from __future__ import annotations

import struct

from emulated import Machine

__all__ = ["Host"]


class Host:
    """One instance at a time; `heard` is what it said, `machine.opened` the files it asked for."""

    def __init__(self, library, fmi, guid, files):
        self.machine, self.fmi, self.guid = Machine(library, files), fmi, guid
        self.heard, self.instance = [], 0
        self.logger = self.machine.stub(self._hear)
        self.places = {}

    def _hear(self):
        """A message; of FMI 2 it comes with the name of the instance."""
        _, *words = (self.machine.whole() for _ in range(5 if self.fmi == 2 else 4))
        category, message = words[-2:]
        self.heard.append(
            (self.machine.text(category).decode(), self.machine.text(message).decode())
        )

    def text(self, words):
        """Address of a text; bytes are taken as they are."""
        words = words if isinstance(words, bytes) else words.encode()
        return self._place(words + b"\0")

    def _place(self, content):
        if content not in self.places:
            self.places[content] = self.machine.place(content)
        return self.places[content]

    def call(self, name, *values):
        """Status of a function of the instance."""
        return self.machine.call(f"fmi{self.fmi}{name}", self.instance, *values) & 0xFFFFFFFF

    def instantiate(self, location):
        """Whether there is an instance now."""
        name, guid, location = (self.text(words) for words in ("one", self.guid, location))
        if self.fmi == 2:
            callbacks = self._place(struct.pack("<5Q", self.logger, 0, 0, 0, 0))
            given = (name, 1, guid, location, callbacks, 0, 1)
            self.instance = self.machine.call("fmi2Instantiate", *given)
        else:
            given = (name, guid, location, 0, 1, 0, 0, 0, 0, 0, self.logger, 0)
            self.instance = self.machine.call("fmi3InstantiateCoSimulation", *given)
        return self.instance != 0

    def start(self, location, **values):
        """Initialize, with start values by value reference: ``_1=40.0``."""
        assert self.instantiate(location), self.heard
        if self.fmi == 2:
            assert self.call("SetupExperiment", 0, 0.0, 0.0, 0, 0.0) == 0
            assert self.call("EnterInitializationMode") == 0
        else:
            assert self.call("EnterInitializationMode", 0, 0.0, 0.0, 0, 0.0) == 0
        self.set({int(name[1:]): value for name, value in values.items()})
        assert self.call("ExitInitializationMode") == 0, self.heard

    def _values(self, verb, references, address):
        count, size = len(references), () if self.fmi == 2 else (len(references),)
        where = self._place(struct.pack(f"<{count}I", *references))
        name = verb + ("Real" if self.fmi == 2 else "Float64")
        return self.call(name, where, count, address, *size)

    def set(self, values):
        content = struct.pack(f"<{len(values)}d", *values.values())
        assert self._values("Set", list(values), self._place(content)) == 0, self.heard

    def get(self, references):
        address = self._place(bytes(8 * len(references)) + b"outputs")
        assert self._values("Get", references, address) == 0, self.heard
        return self.machine.read(address, f"<{len(references)}d")

    def step(self, time, length):
        if self.fmi == 2:
            return self.call("DoStep", time, length, 1)
        flags, last = self._place(b"\0\0\0flags"), self._place(bytes(8) + b"last")
        return self.call("DoStep", time, length, 1, flags, flags + 1, flags + 2, last)

    def state_call(self, verb):
        return f"{verb}FMU{'s' if self.fmi == 2 else 'S'}tate"

    def free(self):
        """Nothing it took may be left."""
        self.call("FreeInstance")
        assert not self.machine.sizes
        assert not self.machine.streams
