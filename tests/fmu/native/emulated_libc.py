"""The functions of C and of Windows that our libraries import, in Python.

Mathematics is that of this computer, so what differs from a run without emulation is what the code
of the library itself does. Memory is never given twice, so what is freed twice or not at all shows.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import re
import sys

__all__ = ["LibC"]

_MATH = ctypes.CDLL("ucrtbase" if sys.platform == "win32" else ctypes.util.find_library("m"))
UTF8 = 65001  # code pages of Windows; any other is that of Western Europe here
_FORMAT = re.compile(rb"%%|%[-+ #0]*[0-9]*(?:\.[0-9]+)?([disefg])")


def _mathematics(name, count):
    function = getattr(_MATH, name)
    function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * count
    return lambda machine: function(*[machine.real() for _ in range(count)])


class LibC:
    """Arguments, memory and files are those of a machine: `whole`, `real`, `read`, `room`."""

    def __init__(self, files):
        self.files, self.opened = files, []
        self.streams, self.sizes = {}, {}

    def bytes_at(self, address, size):
        return bytes(self.cpu.mem_read(address, size)) if size else b""

    def text(self, address):
        """Text up to the zero that ends it."""
        size = 0
        while self.cpu.mem_read(address + size, 1) != b"\0":
            size += 1
        return self.bytes_at(address, size)

    def wide_text(self, address):
        size = 0
        while self.read(address + size, "<H")[0]:
            size += 2
        return self.bytes_at(address, size).decode("utf-16-le")

    # memory

    def c_malloc(self):
        size = self.whole()
        address = self.place(b"\xff" * size)  # not a number, whatever it is read as
        self.sizes[address] = size
        return address

    def c_calloc(self):
        size = self.whole() * self.whole()
        address = self.room(size)
        self.sizes[address] = size
        return address

    def c_free(self):
        address = self.whole()
        if address:
            del self.sizes[address]

    def c_memcpy(self):
        to, source, size = self.whole(), self.whole(), self.whole()
        self.cpu.mem_write(to, self.bytes_at(source, size))
        return to

    c_memmove = c_memcpy

    def c_memset(self):
        to, byte, size = self.whole(), self.whole(), self.whole()
        self.cpu.mem_write(to, bytes([byte & 255]) * size)
        return to

    def c_bzero(self):
        to, size = self.whole(), self.whole()
        self.cpu.mem_write(to, bytes(size))

    # texts

    def c_strlen(self):
        return len(self.text(self.whole()))

    def c_strcmp(self):
        one, other = self.text(self.whole()), self.text(self.whole())
        return (one > other) - (one < other)

    def c_strncmp(self):
        one, other = self.text(self.whole()), self.text(self.whole())
        size = self.whole()
        return (one[:size] > other[:size]) - (one[:size] < other[:size])

    def c_snprintf(self):
        to, size, words = self.whole(), self.whole(), self.text(self.whole())
        return self._print(to, size, words, self.whole, self.real)

    def c_stdio_common_vsprintf(self):
        """Of Windows; the last argument is the address of all further ones."""
        options, to, size, words = (self.whole() for _ in range(4))
        assert options == 2, "the length of all of it is wanted, as in C99"
        _, at = self.whole(), self.whole()

        def further(layout):
            nonlocal at
            at += 8
            return self.read(at - 8, layout)[0]

        return self._print(
            to,
            size,
            words=self.text(words),
            whole=lambda _: further("<Q"),
            real=lambda _: further("<d"),
        )

    def _print(self, to, size, words, whole, real):
        def one(found):
            if found[0] == b"%%":
                return b"%"
            if found[1] == b"s":
                return found[0] % self.text(whole(True))
            if found[1] in b"di":
                value = whole(True) % 2**32
                return found[0] % (value - (value >> 31 << 32))
            return found[0] % real(True)

        done = _FORMAT.sub(one, words)
        if size:
            self.cpu.mem_write(to, done[: size - 1] + b"\0")
        return len(done)

    # files

    def _open(self, path):
        self.opened.append(path)
        if path not in self.files:
            return 0
        stream = self.room(8)
        self.streams[stream] = [self.files[path], 0]
        return stream

    def c_fopen(self):
        return self._open(self.text(self.whole()).decode())

    def c_wfopen(self):
        return self._open(self.wide_text(self.whole()))

    def c_MultiByteToWideChar(self):
        page, flags, address, size, to, room = (self.whole() for _ in range(6))
        assert size % 2**32 == 2**32 - 1, "up to its zero"
        words = self.text(address)
        try:
            wide = words.decode("utf-8" if page == UTF8 else "cp1252")
        except UnicodeDecodeError:
            if flags & 8:
                return 0
            wide = words.decode("utf-8", "replace")
        return self._converted(wide.encode("utf-16-le") + b"\0\0", to, room, 2)

    def c_WideCharToMultiByte(self):
        page, _, address, size, to, room = (self.whole() for _ in range(6))
        assert (page, size % 2**32) == (UTF8, 2**32 - 1)
        words = self.wide_text(address)
        return self._converted(words.encode() + b"\0", to, room % 2**32, 1)

    def _converted(self, content, to, room, width):
        if len(content) > width * room:
            return 0
        self.cpu.mem_write(to, content)
        return len(content) // width

    def c_fread(self):
        to, size, count, stream = (self.whole() for _ in range(4))
        content, at = self.streams[stream]
        read = min(count, (len(content) - at) // size)
        self.cpu.mem_write(to, content[at : at + read * size])
        self.streams[stream][1] += read * size
        return read

    def c_fclose(self):
        del self.streams[self.whole()]
        return 0


for _names, _count in (
    ("acos asin atan cbrt ceil cos cosh exp expm1 floor log log1p sin sinh tan tanh", 1),
    ("atan2 fmod hypot pow", 2),
):
    for _name in _names.split():
        setattr(LibC, f"c_{_name}", _mathematics(_name, _count))
