"""Libraries of every platform, read as its loader would: what they hold, need and offer."""

from __future__ import annotations

import re
import struct
from typing import NamedTuple

__all__ = ["Library", "read_library", "slices_of"]


class Library(NamedTuple):
    """A library as it lies in memory from address 0 on.

    `imports` are the cells that want the address of a function, `rebased` those that want the
    place of the library added. `system_version` is the oldest of the system, on Linux of its C
    library, that it is meant for, and `signed` whether it holds a signature of code.
    """

    system: str
    machine: str
    image: bytearray
    exports: dict[str, int]
    imports: dict[str, list[int]]
    rebased: list[int]
    needs: list[str]
    system_version: tuple[int, int] = (0, 0)
    signed: bool = False


def read_library(content, machine=None):
    """Read the content of a file; `machine` chooses among those that share one."""
    if content[:4] == b"\x7fELF":
        return _elf(content)
    if content[:2] == b"MZ":
        return _pe(content)
    parts = [_macho(part) for part in slices_of(content)]
    return next(part for part in parts if machine in (None, part.machine))


def slices_of(content):
    """Files for a Mac within one."""
    if content[:4] == bytes.fromhex("cffaedfe"):
        return [content]
    magic, count = struct.unpack_from(">II", content)
    assert magic == 0xCAFEBABE
    heads = [struct.unpack_from(">5I", content, 8 + 20 * i) for i in range(count)]
    assert all(offset % (1 << align) == 0 for _, _, offset, _, align in heads)
    return [content[offset : offset + size] for _, _, offset, size, _ in heads]


def _text(content, offset):
    return content[offset : content.index(b"\0", offset)].decode()


# Linux ---------------------------------------------------------------------------------------


def _elf(content):
    assert content[4:6] == b"\2\1", "64 bits, little-endian"
    kind, machine = struct.unpack_from("<HH", content, 16)
    assert kind == 3, "a shared library"
    programs, sections = struct.unpack_from("<QQ", content, 32)
    size_program, count_program, size, count = struct.unpack_from("<HHHH", content, 54)
    image = bytearray()
    for i in range(count_program):
        found = struct.unpack_from("<IIQQQQQQ", content, programs + i * size_program)
        if found[0] == 1:  # to be loaded
            _, _, offset, address, _, in_file, in_memory, _ = found
            image.extend(bytes(address + in_memory - len(image)))
            image[address : address + in_file] = content[offset : offset + in_file]
    heads = [struct.unpack_from("<IIQQQQIIQQ", content, sections + i * size) for i in range(count)]
    table = next(head for head in heads if head[1] == 11)  # dynamic symbols
    names = heads[table[6]][4]
    symbols, exports = [], {}
    for at in range(table[4], table[4] + table[5], 24):
        name, info, _, section, value, _ = struct.unpack_from("<IBBHQQ", content, at)
        symbols.append((_text(content, names + name), section, value))
        if section and info >> 4:  # defined, and not local
            exports[symbols[-1][0]] = value
    needs = []
    for head in heads:
        assert head[1] != 19, "packed relocations are not read here"
        if head[1] == 6:
            tags = struct.iter_unpack("<QQ", content[head[4] : head[4] + head[5]])
            needs = [_text(content, names + value) for tag, value in tags if tag == 1]
    imports, rebased = _elf_cells(content, image, heads, symbols)
    machine = {62: "x86_64", 183: "aarch64"}[machine]
    minor = max((int(found) for found in re.findall(rb"GLIBC_2\.(\d+)", content)), default=0)
    return Library("linux", machine, image, exports, imports, rebased, needs, (2, minor))


def _elf_cells(content, image, heads, symbols):
    imports, rebased = {}, []
    for head in heads:
        if head[1] != 4:  # relocations
            continue
        for at in range(head[4], head[4] + head[5], 24):
            cell, info, addend = struct.unpack_from("<QQq", content, at)
            name, section, value = symbols[info >> 32] if info >> 32 else ("", 1, 0)
            if not section:
                imports.setdefault(name, []).append(cell)
                continue
            assert info & 0xFFFFFFFF in (6, 7, 8, 1, 1025, 1026, 1027, 257)
            struct.pack_into("<q", image, cell, value + addend)
            rebased.append(cell)
    return imports, rebased


# Windows -------------------------------------------------------------------------------------


def _pe(content):
    (start,) = struct.unpack_from("<I", content, 0x3C)
    assert content[start : start + 4] == b"PE\0\0"
    machine, count, _, _, _, size, flags = struct.unpack_from("<HHIIIHH", content, start + 4)
    assert machine == 0x8664
    assert flags & 0x2000, "a library"
    head = start + 24
    assert struct.unpack_from("<H", content, head) == (0x20B,)
    (base,) = struct.unpack_from("<Q", content, head + 24)
    (total,) = struct.unpack_from("<I", content, head + 56)
    image = bytearray(total)
    for at in range(head + size, head + size + 40 * count, 40):
        _, address, in_file, offset = struct.unpack_from("<IIII", content, at + 8)
        image[address : address + in_file] = content[offset : offset + in_file]
    places = [struct.unpack_from("<II", content, head + 112 + 8 * i) for i in range(16)]
    assert places[9] == (0, 0), "storage of threads is not set up here"
    imports, needs = _pe_imports(image, places[1][0])
    rebased = _pe_rebased(image, *places[5])
    for cell in rebased:
        (value,) = struct.unpack_from("<Q", image, cell)
        struct.pack_into("<Q", image, cell, value - base)
    exports = _pe_exports(image, places[0][0])
    version = struct.unpack_from("<HH", content, head + 48)
    return Library("windows", "x86_64", image, exports, imports, rebased, needs, version)


def _pe_exports(image, at):
    count, functions, names, order = struct.unpack_from("<IIII", image, at + 24)
    found = {}
    for i in range(count):
        (name,) = struct.unpack_from("<I", image, names + 4 * i)
        (which,) = struct.unpack_from("<H", image, order + 2 * i)
        (found[_text(image, name)],) = struct.unpack_from("<I", image, functions + 4 * which)
    return found


def _pe_imports(image, at):
    imports, needs = {}, []
    while True:
        names, _, _, library, cells = struct.unpack_from("<IIIII", image, at)
        if not library:
            return imports, needs
        needs.append(_text(image, library).lower())
        for i in range((len(image) - names) // 8):
            (name,) = struct.unpack_from("<Q", image, names + 8 * i)
            if not name:
                break
            imports.setdefault(_text(image, name + 2), []).append(cells + 8 * i)
        at += 20


def _pe_rebased(image, at, size):
    rebased, end = [], at + size
    while at < end:
        page, length = struct.unpack_from("<II", image, at)
        for (entry,) in struct.iter_unpack("<H", image[at + 8 : at + length]):
            assert entry >> 12 in (0, 10)
            if entry >> 12 == 10:
                rebased.append(page + (entry & 0xFFF))
        at += length
    return rebased


# Macs ----------------------------------------------------------------------------------------


def _macho(content):
    magic, machine, _, kind, count, _, _, _ = struct.unpack_from("<IIIIIIII", content)
    assert (magic, kind) == (0xFEEDFACF, 6), "a library"
    image, segments, needs, signed, at, tables = bytearray(), [], [], False, 32, ()
    version = (99, 0)
    for _ in range(count):
        command, size = struct.unpack_from("<II", content, at)
        assert command != 0x80000034, "chained fixups are not read here"
        if command == 0x19:
            address, in_memory, offset, in_file = struct.unpack_from("<QQQQ", content, at + 24)
            image.extend(bytes(address + in_memory - len(image)))
            image[address : address + in_file] = content[offset : offset + in_file]
            segments.append(address)
        elif command == 0xC:
            (name,) = struct.unpack_from("<I", content, at + 8)
            needs.append(_text(content, at + name))
        elif command == 0x80000022:
            tables = struct.unpack_from("<10I", content, at + 8)
        elif command == 0x32:
            (packed,) = struct.unpack_from("<I", content, at + 12)
            version = packed >> 16, packed >> 8 & 255
        signed |= command == 0x1D
        at += size
    parts = [content[tables[i] : tables[i] + tables[i + 1]] for i in range(0, 10, 2)]
    rebased = [cell for cell, _ in _cells(parts[0], segments, rebases=True)]
    imports = {}
    for part in (parts[1], parts[3]):  # at once, and when first called
        for cell, name in _cells(part, segments, rebases=False):
            imports.setdefault(name.removeprefix("_"), []).append(cell)
    exports = {name.removeprefix("_"): value for name, value in _trie(parts[4])}
    machine = {0x1000007: "x86_64", 0x100000C: "aarch64"}[machine]
    return Library("macos", machine, image, exports, imports, rebased, needs, version, signed)


def _uleb(content, at):
    value = shift = 0
    while True:
        value |= (content[at] & 127) << shift
        shift, at = shift + 7, at + 1
        if content[at - 1] < 128:
            return value, at


def _trie(content, at=0, name=""):
    """Exported names, from a tree of their beginnings, with their addresses."""
    size, at = _uleb(content, at)
    if size:
        flags, place = _uleb(content, at)
        assert flags == 0
        yield name, _uleb(content, place)[0]
    at += size
    count, at = content[at], at + 1
    for _ in range(count):
        end = content.index(b"\0", at)
        child, after = _uleb(content, end + 1)
        yield from _trie(content, child, name + content[at:end].decode())
        at = after


def _cells(content, segments, rebases):
    """Cells of a program of the loader of Macs, which has two languages, and their names."""
    at, cell, name = 0, 0, ""
    while at < len(content):
        code, low = content[at] & 0xF0, content[at] & 15
        at += 1
        count, skip = 0, 8
        if rebases:
            assert code in (0, 0x10, 0x20, 0x30, 0x40, 0x50, 0x60, 0x70, 0x80)
            places, adds, scaled = 0x20, 0x30, 0x40
            if code == 0x50:
                count = low
            elif code in (0x60, 0x80):
                count, at = _uleb(content, at)
            elif code == 0x70:
                count = 1
            more = code in (0x70, 0x80)
        else:
            assert code not in (0x60, 0xD0, 0xE0, 0xF0), "an addend, or threads"
            places, adds, scaled = 0x70, 0x80, None
            if code == 0x20:
                _, at = _uleb(content, at)
            elif code == 0x40:
                end = content.index(b"\0", at)
                name, at = content[at:end].decode(), end + 1
            elif code in (0x90, 0xA0, 0xB0):
                count, skip = 1, 8 + 8 * low * (code == 0xB0)
            elif code == 0xC0:
                count, at = _uleb(content, at)
            more = code in (0xA0, 0xC0)
        if code == places:
            offset, at = _uleb(content, at)
            cell = segments[low] + offset
        elif code == adds:
            offset, at = _uleb(content, at)
            cell = (cell + offset) % 2**64
        elif code == scaled:
            cell += 8 * low
        if more:
            offset, at = _uleb(content, at)
            skip = 8 + offset
        for _ in range(count):
            yield cell, name
            cell += skip
