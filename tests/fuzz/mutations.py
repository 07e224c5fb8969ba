"""Files made from valid ones: bytes flipped, cut and spliced, and values exchanged for worse ones.

What a checksum or a length protects is changed inside and packed again, so that the change gets
past the container.
"""

from __future__ import annotations

import io
import json
import random
import re
import sqlite3
import zipfile

import numpy as np

_WORSE = [
    "nan",
    "inf",
    "-inf",
    "0",
    "-1",
    "1e308",
    "1e-320",
    "1e400",
    "9" * 25,
    "9" * 5000,
    "0x" + "f" * 3000,
    "true",
    '""',
    '"' + "a" * 3000 + '"',
    "[]",
    "{}",
    "[" * 40 + "]" * 40,
    "[" * 3000 + "]" * 3000,
    "1979-05-27T07:32:00Z",
    "[1, 2, 3]",
    "[[1], [[2]]]",
    "{a = 1}",
    ".".join("a" * 400),
    '"1e999999 nm"',
    '"1 m99999"',
    '"1 m-99999999999"',
    '"1 ' + "m*" * 60 + 'm"',
    '"../../../../etc/passwd"',
    '"/etc/passwd"',
    '"\\u0000"',
    '"\\u001b[31m"',
    '"=cmd|A0"',
    '"rigid"',
    "1_0",
    '"-20 degC"',
]
_STATEMENTS = [
    "ALTER TABLE points ADD COLUMN z REAL AS (hex(zeroblob(400000000)))",
    "ALTER TABLE units ADD COLUMN z DEFAULT 1",
    "CREATE VIEW v AS SELECT * FROM points",
    "CREATE INDEX i ON points (status)",
    "CREATE TABLE photos (a)",
    "DROP TABLE units",
    "UPDATE points SET status = hex(zeroblob(3000000))",
    "UPDATE points SET message = zeroblob(3000000), status = 'failed'",
    "UPDATE points SET place = place - 5, seconds = 'much'",
    "UPDATE header SET value = '[[[' || value",
    "UPDATE units SET unit = zeroblob(5)",
    "INSERT INTO units VALUES ('more', 'm')",
]
_SHAPES = ["(1000000000000,)", "(4, 3)", "()", "(-1,)", "(0, 99999999999999999999)", "[3, 4]"]
_SHAPES += ["(" + "3000000, " * 9 + ")", "(2, 1000000)", "(True, 3)", "(1" + "0" * 400 + ",)"]
_TOKEN = re.compile(r'"[^"\n]*"|[-+]?\d[\w.+-]*|\w+')


def changed(data: bytes, others: list[bytes], dice: random.Random) -> bytes:
    """A file like one that is given, with a few changes; `others` are files to splice in."""
    for _ in range(dice.choice((1, 1, 1, 2, 4))):
        if data[:2] == b"PK" and dice.random() < 0.8:
            data = _repacked(data, others, dice)
        elif data[:15] == b"SQLite format 3" and dice.random() < 0.3:
            data = _stated(data, dice)
        elif data[:6] == b"\x93NUMPY" and dice.random() < 0.6:
            data = _header(data, dice)
        elif dice.random() < 0.5:
            data = _bytes(data, others, dice)
        else:
            data = _tokens(data, dice)
    return data


def _stated(data: bytes, dice: random.Random) -> bytes:
    """A database that a statement of SQL has changed, if it can still be opened."""
    base = sqlite3.connect(":memory:")
    try:
        base.deserialize(data)
        base.executescript(dice.choice(_STATEMENTS))
        return base.serialize()
    except (sqlite3.Error, UnicodeDecodeError):  # the latter from a message about a spoilt name
        return data
    finally:
        base.close()


def _bytes(data: bytes, others: list[bytes], dice: random.Random) -> bytes:
    other = dice.choice(others)
    i, j = sorted(dice.randrange(len(data) + 1) for _ in range(2))
    k = dice.randrange(len(other) + 1)
    what = dice.randrange(6)
    if what == 0 and data:
        flipped = bytearray(data)
        for _ in range(dice.choice((1, 3, 30))):
            flipped[dice.randrange(len(data))] = dice.choice((0, 0xFF, 0x80, dice.randrange(256)))
        return bytes(flipped)
    return {
        1: data[:i],
        2: data[:i] + data[j:],
        3: data[:i] + other[k:],
        4: data[:j] + data[i:],
        5: data[:i] + data[i:j][:200] * dice.choice((2, 100)) + data[j:],
    }.get(what, data)


def _tokens(data: bytes, dice: random.Random) -> bytes:
    """A number, word or text exchanged for a worse one, or for another of the same file."""
    text = data.decode("latin-1")
    found = list(_TOKEN.finditer(text[:200_000]))
    if not found:
        return data
    at = dice.choice(found)
    new = dice.choice(_WORSE) if dice.random() < 0.7 else dice.choice(found)[0]
    return (text[: at.start()] + new + text[at.end() :]).encode("latin-1")


def _header(data: bytes, dice: random.Random) -> bytes:
    """An array that announces another shape or another type than it has."""
    end = 10 + int.from_bytes(data[8:10], "little")
    shape = dice.choice(_SHAPES)
    kind = dice.choice(["<f8", "|O", "<U99999999", "|V0", "<f4", ">i8", "<c16", "|S3", "<M8[s]"])
    kind = dice.choice([f"'{kind}'", "[('a', '<f8')]", "('<f8', (1000000000,))", "'<f8'"])
    order = dice.choice(["True", "False", "1"])
    head = f"{{'descr': {kind}, 'fortran_order': {order}, 'shape': {shape}, }}"
    head = head.ljust(max(end - 11, 0)) + "\n"
    return data[:8] + len(head).to_bytes(2, "little") + head.encode() + data[end:]


def _repacked(data: bytes, others: list[bytes], dice: random.Random) -> bytes:
    """An archive with a member changed, dropped, doubled, renamed or inflated."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            members = [(one.filename, packed.read(one)) for one in packed.infolist()]
    except Exception:  # noqa: BLE001 it is no archive any more
        return _bytes(data, others, dice)
    if not members:
        return data
    i, what = dice.randrange(len(members)), dice.randrange(40)
    name, content = members[i]
    if what == 0:
        del members[i]
    elif what == 1:
        members[i] = (dice.choice(["../x", "/x", "a\\b", "c:x", "a/../b", "x" * 300, "."]), content)
    elif what == 2:
        members[i] = (name, b"\0" * 30_000_000)
    elif what == 3:
        members[i] = (name, dice.choice(members)[1])
    elif name == "header.npy" or "header.npy" in dict(members):
        members = [
            (key, _json_header(one, others, dice) if key == "header.npy" else one)
            for key, one in members
        ]
    else:
        members[i] = (name, changed(content, others, dice))
    return _packed(members, dice)


def _packed(members: list[tuple[str, bytes]], dice: random.Random) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as packed:
        for name, content in dict(members).items():
            info = zipfile.ZipInfo(name)
            info.compress_type = 12 if dice.random() < 0.01 else 8
            info.external_attr = (0o120777 if dice.random() < 0.01 else 0o644) << 16
            packed.writestr(info, content)
    return made.getvalue()


def _json_header(content: bytes, others: list[bytes], dice: random.Random) -> bytes:
    """A header of a result with one value of its JSON text exchanged."""
    try:
        tables = json.loads(str(np.load(io.BytesIO(content))))
        new = json.dumps(exchanged(tables, dice))
    except Exception:  # noqa: BLE001 it has been changed before
        return _bytes(content, others, dice)
    file = io.BytesIO()
    np.save(file, np.array(new))
    return file.getvalue()


_VALUES = [None, True, 0, -1, 1e308, float("nan"), float("inf"), 2**70, "", "x" * 999, "1e9 m"]
_VALUES += [[], {}, [[]], {"array": "pressure"}, {"array": "no"}, {"record": "x"}, {"float": "a"}]
_VALUES += ["../../x", 10**400, [1, 2, 3], {"mapping": 3}, {"tuple": {}}, 1, 3, 1e-300, 1e9]


def exchanged(tables: object, dice: random.Random) -> object:
    """Plain values with one of them, anywhere, exchanged, dropped or moved."""
    places: list[tuple[object, object]] = []

    def walk(value: object) -> None:
        is_table = isinstance(value, dict)
        for key, item in value.items() if is_table else enumerate(value):
            places.append((value, key))
            if isinstance(item, dict | list):
                walk(item)

    walk(tables)
    if not places:
        return tables
    owner, key = dice.choice(places)
    what = dice.randrange(6)
    if what == 0:
        del owner[key]
    elif what == 1:
        one, at = dice.choice(places)
        owner[key] = json.loads(json.dumps(one[at]))
    else:
        owner[key] = dice.choice(_VALUES)
    return json.loads(json.dumps(tables))
