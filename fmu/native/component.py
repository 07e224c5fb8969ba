"""The C kernel as a WebAssembly component: the sixth binary of a native FMU of FMI 3.0.

The draft FMI-LS-WASM 0.1.0 asks for a component of the world ``fmi:fmi3/co-simulation-fmu@3.0.0``,
which no C compiler writes. zig compiles the kernel to a core module (``kernel/fmi/fmi3wasm.c`` has
its functions); here it is wrapped: what the world imports and exports is a table of functions with
their types, from which the text of the component is written and encoded by wasmtime.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from ...errors import DescriptionError
from ...extras import require
from ..framework.toolchain import compile_wasm

__all__ = ["WASM", "component", "component_files", "component_text", "kernel_module"]

WASM = "wasm32-wasip2"
"""Name of the platform, and of its folder in an FMU."""

_PAGES = 80  # of 64 KiB: 1 MiB of handles and 2 MiB of stack, of which the grids of films take most
_FLAGS = (
    *("-DCK_COMPONENT", "-DSLOTS=1024u", "-Wl,--import-memory"),
    *(f"-Wl,--initial-memory={_PAGES * 65536}", "-Wl,-z,stack-size=2097152"),
)
_MANIFEST = """<?xml version="1.0" encoding="UTF-8"?>
<fmi3LayeredStandard xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"
  fmi-ls:fmi-ls-name="org.modelica.fmi-ls-wasm" fmi-ls:fmi-ls-version="0.1.0"
  fmi-ls:fmi-ls-description="FMI Layered Standard for WebAssembly"/>
"""

_STATUS = "(result (error $status))"
_REFERENCES = "(list $value-reference)"
_TYPES = {
    "value-reference": "u32",
    "status": '(enum "ok" "warning" "discard" "error" "fatal")',
    "fmu-state": "(list u8)",
    "interval-qualifier": (
        '(enum "interval-not-yet-known" "interval-unchanged" "interval-changed")'
    ),
    "interval-fraction": '(record (field "counter" u64) (field "resolution" u64))',
    "dependency-kind": '(enum "dependent" "constant" "fixed" "tunable" "discrete")',
    "variable-dependency": (
        '(record (field "dependent-value-reference" $value-reference) '
        '(field "element-index-of-dependent" u32) '
        '(field "independent-value-reference" $value-reference) '
        '(field "element-index-of-independent" u32) (field "kind" $dependency-kind))'
    ),
    "discrete-states-info": "(record "
    + " ".join(
        f'(field "{name}" bool)'
        for name in (
            "new-discrete-states-needed",
            "terminate-simulation",
            "nominals-of-continuous-states-changed",
            "values-of-continuous-states-changed",
            "next-event-time-defined",
        )
    )
    + ' (field "next-event-time" f64))',
}
"""Types of the interface ``types``, each of those before it."""

_OWN_TYPES = {
    "do-step-result": (
        '(record (field "last-successful-time" f64) (field "event-handling-needed" bool) '
        '(field "terminate-simulation" bool) (field "early-return" bool))'
    )
}
"""Types of the interface ``co-simulation`` itself."""

_ALL_TYPES = _TYPES | _OWN_TYPES
_USED = tuple(name for name in _TYPES if name != "dependency-kind")
"""Types of ``types`` that ``co-simulation`` uses."""

_PLAIN = {
    **{f"float{n}": f"f{n}" for n in (32, 64)},
    **{f"int{n}": f"s{n}" for n in (8, 16, 32, 64)},
    **{f"uint{n}": f"u{n}" for n in (8, 16, 32, 64)},
    "boolean": "bool",
    "string": "string",
    "binary": "(list u8)",
    "clock": "bool",
}
"""Types of variables."""


def _fallible(kind: str) -> str:
    return f"(result {kind} (error $status))"


def _methods() -> Iterator[tuple[str, Mapping[str, str], str]]:
    """Methods of an instance: name, parameters, result."""
    yield "set-debug-logging", {"logging-on": "bool", "categories": "(list string)"}, "$status"
    times = {"tolerance": "(option f64)", "start-time": "f64", "stop-time": "(option f64)"}
    yield "enter-initialization-mode", times, "$status"
    yield "exit-initialization-mode", {}, "$status"
    yield "enter-event-mode", {}, "$status"
    yield "update-discrete-states", {}, _fallible("$discrete-states-info")
    for name in ("terminate", "reset", "enter-configuration-mode", "exit-configuration-mode"):
        yield name, {}, "$status"
    for name, kind in _PLAIN.items():
        yield f"get-{name}", {"value-references": _REFERENCES}, _fallible(f"(list {kind})")
    for name, kind in _PLAIN.items():
        given = {"value-references": _REFERENCES, "values": f"(list {kind})"}
        yield f"set-{name}", given, "$status"
    yield "get-number-of-variable-dependencies", {"vr": "$value-reference"}, _fallible("u64")
    found = _fallible("(list $variable-dependency)")
    yield "get-variable-dependencies", {"dependent": "$value-reference"}, found
    yield "get-fmu-state", {}, _fallible("$fmu-state")
    yield "set-fmu-state", {"state": "$fmu-state"}, "$status"
    slopes = {"unknowns": _REFERENCES, "knowns": _REFERENCES, "seed": "(list f64)"}
    yield "get-directional-derivative", slopes, _fallible("(list f64)")
    yield "get-adjoint-derivative", slopes, _fallible("(list f64)")
    yield from _clocks()
    yield "evaluate-discrete-states", {}, "$status"
    requests = {"requests": "(list (tuple $value-reference u32))"}
    yield "set-input-derivatives", requests | {"values": "(list f64)"}, "$status"
    yield "get-output-derivatives", requests, _fallible("(list f64)")
    step = {
        "current-communication-point": "f64",
        "communication-step-size": "f64",
        "no-set-fmu-state-prior-to-current-point": "bool",
    }
    yield "do-step", step, _fallible("$do-step-result")
    yield "enter-step-mode", {}, "$status"


def _clocks() -> Iterator[tuple[str, Mapping[str, str], str]]:
    asked, plain = {"value-references": _REFERENCES}, "$interval-fraction"
    for name, kind, more in (
        ("interval-decimal", "f64", True),
        ("interval-fraction", plain, True),
        ("shift-decimal", "f64", False),
        ("shift-fraction", plain, False),
    ):
        each = f"(tuple {kind} $interval-qualifier)" if more else kind
        yield f"get-{name}", asked, _fallible(f"(list {each})")
    for name, given, kind in (
        ("interval-decimal", "intervals", "f64"),
        ("interval-fraction", "intervals", plain),
        ("shift-decimal", "shifts", "f64"),
        ("shift-fraction", "shifts", plain),
    ):
        yield f"set-{name}", asked | {given: f"(list {kind})"}, "$status"


# The text of the component --------------------------------------------------------------------

_TYPE_NAME = re.compile(r"\$([\w-]+)")
_PACKAGE = "fmi:fmi3/{}@3.0.0"
_INSTANCE = "co-simulation-instance"

# What a host gives back is put into memory of the component, which it asks a function for; but the
# functions of the host are there before the kernel is. So the memory is a module of its own, whose
# room for what a host gives is whole pages: that is one file, once.
_ROOM = f"""
  (core module $room-module
    (memory (export "memory") {_PAGES})
    (func (export "room") (param i32 i32 i32 i32) (result i32) (local $at i32)
      (if (i32.eqz (local.get 3)) (then (return (local.get 2))))
      (local.set $at (memory.grow (i32.shr_u (i32.add (local.get 3) (i32.const 65535))
        (i32.const 16))))
      (if (i32.eq (local.get $at) (i32.const -1)) (then (unreachable)))
      (i32.shl (local.get $at) (i32.const 16))))
  (core instance $room (instantiate $room-module))
  (alias core export $room "memory" (core memory $memory))
  (alias core export $room "room" (core func $host-room))"""

# The kernel knows an instance by its place in memory, a host by a handle. What makes one of the
# other belongs to a type whose destructor is the kernel's, and so comes after it.
_HANDLE = """
  (core module $handle-module
    (import "kernel" "instantiate"
      (func $made (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32) (result i32)))
    (import "host" "new" (func $new (param i32) (result i32)))
    (import "room" "memory" (memory 1))
    (func (export "instantiate")
      (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32) (result i32) (local $at i32)
      (local.set $at (call $made (local.get 0) (local.get 1) (local.get 2) (local.get 3)
        (local.get 4) (local.get 5) (local.get 6) (local.get 7) (local.get 8) (local.get 9)))
      (if (i32.load8_u (local.get $at)) (then
        (i32.store offset=4 (local.get $at) (call $new (i32.load offset=4 (local.get $at))))))
      (local.get $at)))"""


def component_text() -> str:
    """Component in the text format of WebAssembly, with an empty module in place of the kernel."""
    parts = [
        "(component",
        _import_types(),
        _import_host(),
        "  (core module $kernel-module)",
        _ROOM,
        _kernel(),
        _HANDLE,
        _handles(),
        _exports(),
        ")",
    ]
    return "\n".join(parts) + "\n"


def _import_types() -> str:
    """Interface ``types``, and its types by their names."""
    lines = [
        f'    (type ${name}-0 {kind}) (export "{name}" (type ${name} (eq ${name}-0)))'
        for name, kind in _TYPES.items()
    ]
    aliases = [f'  (alias export $types "{name}" (type ${name}))' for name in _TYPES]
    name = _PACKAGE.format("types")
    return "\n".join([f'  (import "{name}" (instance $types', *lines, "  ))", *aliases])


def _import_host() -> str:
    """What the component calls of its host: how it logs, and the file of its tables."""
    callbacks, resources = _PACKAGE.format("callbacks"), _PACKAGE.format("resource-dir-callbacks")
    return f"""
  (import "{callbacks}" (instance $callbacks
    (alias outer 1 $status (type $status-0)) (export "status" (type $status (eq $status-0)))
    (export "log-message" (func (param "instance-name" string) (param "status" $status)
      (param "category" string) (param "message" string)))))
  (import "{resources}" (instance $resources
    (export "read-file" (func (param "path" string)
      (result (result (list u8) (error string)))))))"""


def _kernel() -> str:
    """Instance of the kernel, with the functions of the host by what it can hand over."""
    return """
  (core func $log-message (canon lower (func $callbacks "log-message")
    (memory $memory) string-encoding=utf8))
  (core func $read-file (canon lower (func $resources "read-file")
    (memory $memory) (realloc $host-room) string-encoding=utf8))
  (core instance $host (export "log_message" (func $log-message))
    (export "read_file" (func $read-file)))
  (core instance $kernel (instantiate $kernel-module (with "env" (instance $room))
    (with "host" (instance $host))))
  (alias core export $kernel "ck_room" (core func $kernel-room))
  (alias core export $kernel "ck_free" (core func $free))"""


def _handles() -> str:
    """Type of an instance, and the function that makes one."""
    return """
  (type $instance (resource (rep i32) (dtor (core func $free))))
  (core func $new (canon resource.new $instance))
  (core instance $new-host (export "new" (func $new)))
  (alias core export $kernel "ck_instantiate" (core func $made))
  (core instance $new-kernel (export "instantiate" (func $made)))
  (core instance $handles (instantiate $handle-module (with "kernel" (instance $new-kernel))
    (with "host" (instance $new-host)) (with "room" (instance $room))))"""


def _functions() -> dict[str, _Function]:
    """Functions of the interface ``co-simulation`` by their full names."""
    given = {
        **dict.fromkeys(("instance-name", "instantiation-token"), "string"),
        **dict.fromkeys(
            ("visible", "logging-on", "event-mode-used", "early-return-allowed"), "bool"
        ),
        "required-intermediate-variables": _REFERENCES,
    }
    made = _Function("instantiate", given, "(option (own $instance))", "$handles", "instantiate")
    found = {f"[static]{_INSTANCE}.instantiate-co-simulation": made}
    for name, parameters, result in _methods():
        given = {"self": "(borrow $instance)", **parameters}
        found[f"[method]{_INSTANCE}.{name}"] = _Function(
            name, given, result, "$kernel", f"ck_{name}"
        )
    return found


class _Function(NamedTuple):
    """Function of the component: its type, and the function of a core module that it is."""

    name: str
    given: Mapping[str, str]
    result: str
    core: str
    of: str

    def type(self) -> str:
        parameters = "".join(f' (param "{key}" {kind})' for key, kind in self.given.items())
        return f"{parameters} (result {self.result})".lstrip()

    def lift(self) -> str:
        return f"""  (func ${self.name} {self.type()}
    (canon lift (core func {self.core} "{self.of}") (memory $memory)
      (realloc $kernel-room) string-encoding=utf8))"""


def _exports() -> str:
    """Interfaces ``common`` and ``co-simulation``."""
    version = _Function("get-version", {}, "string", "$kernel", "ck_get-version")
    functions = _functions()
    given = [f'    (with "type-{name}" (type ${name}))' for name in _ALL_TYPES]
    given.append('    (with "type-instance" (type $instance))')
    given += [f'    (with "{one.name}" (func ${one.name}))' for one in functions.values()]
    return "\n".join(
        [
            version.lift(),
            '  (instance $common (export "get-version" (func $get-version)))',
            *(f"  (type ${name} {kind})" for name, kind in _OWN_TYPES.items()),
            *(one.lift() for one in functions.values()),
            _named(functions),
            "  (instance $co-simulation (instantiate $named",
            *given,
            "  ))",
            f'  (export "{_PACKAGE.format("common")}" (instance $common))',
            f'  (export "{_PACKAGE.format("co-simulation")}" (instance $co-simulation))',
        ]
    )


def _named(functions: Mapping[str, _Function]) -> str:
    """Component that exports functions with the names of their types, as methods need them."""
    lines = ["  (component $named"]
    for name, kind in _ALL_TYPES.items():
        lines.append(f"    (type ${name}-0 {kind})")
        lines.append(f'    (import "type-{name}" (type ${name} (eq ${name}-0)))')
    lines.append('    (import "type-instance" (type $instance (sub resource)))')
    lines += [
        f'    (import "{one.name}" (func ${one.name} {one.type()}))' for one in functions.values()
    ]
    for name in (*_USED, *_OWN_TYPES):
        lines.append(f"    (type ${name}-1 {_exported(_ALL_TYPES[name])})")
        lines.append(f'    (export ${name}-out "{name}" (type ${name}-1))')
    lines.append(f'    (export $instance-out "{_INSTANCE}" (type $instance))')
    for name, one in functions.items():
        lines.append(f'    (export "{name}" (func ${one.name}) (func {_exported(one.type())}))')
    return "\n".join([*lines, "  )"])


def _exported(kind: str) -> str:
    """Type by the exported names of the types in it; one that has none keeps the imported one."""
    return _TYPE_NAME.sub(lambda m: m[0] if m[1] == "dependency-kind" else f"{m[0]}-out", kind)


# Compiling ------------------------------------------------------------------------------------


def component_files(identifier: str, fmi: int, sources: Mapping[str, bytes]) -> dict[str, bytes]:
    """Component and manifest of the layered standard, by their paths in the FMU.

    Parameters
    ----------
    identifier : str
        Name of the library of the model.
    fmi : int
        Version of FMI.
    sources : mapping of str to bytes
        Those of the kernel with the headers of FMI, by file name.

    Raises
    ------
    DescriptionError
        If the version is not 3.
    MissingExtraError
        If ziglang or wasmtime is not installed.
    ContactkitError
        If the compiler failed.
    """
    if fmi != 3:
        raise DescriptionError(
            "fmi", fmi, f"be 3 for the platform {WASM}", hint="FMI-LS-WASM is for FMI 3.0"
        )
    return {
        f"binaries/{WASM}/{identifier}.wasm": component(kernel_module(sources)),
        "extra/org.modelica.fmi-ls-wasm/manifest.xml": _MANIFEST.encode(),
    }


def kernel_module(sources: Mapping[str, bytes]) -> bytes:
    """Compile the kernel to a core module, which imports its memory and two functions of a host.

    Raises
    ------
    MissingExtraError, ContactkitError
        See `component_files`.
    """
    return compile_wasm(sources, "a WebAssembly component", _FLAGS)


# Encoding -------------------------------------------------------------------------------------

_CORE_MODULE = 1  # section of a component


def component(kernel: bytes) -> bytes:
    """Wrap a core module as a component.

    Raises
    ------
    MissingExtraError
        If wasmtime is not installed.
    """
    require("wasmtime", "a WebAssembly component")
    from wasmtime import wat2wasm

    made = bytes(wat2wasm(component_text()))
    found, place, is_placed = made[:8], 8, False
    while place < len(made):
        kind = made[place]
        size, begin = _number(made, place + 1)
        content, place = made[begin : begin + size], begin + size
        if kind == _CORE_MODULE and not is_placed:  # the first is the empty one of the kernel
            content, is_placed = kernel, True
        found += bytes([kind]) + _encoded(len(content)) + content
    return found


def _number(content: bytes, place: int) -> tuple[int, int]:
    """Number in LEB128 at a place, and the place after it."""
    found = shift = 0
    while True:
        byte = content[place]
        found, shift, place = found | (byte & 0x7F) << shift, shift + 7, place + 1
        if byte < 0x80:
            return found, place


def _encoded(number: int) -> bytes:
    r"""Write a number in LEB128.

    Examples
    --------
    >>> _encoded(300), _number(_encoded(300), 0)
    (b'\xac\x02', (300, 2))
    """
    found = b""
    while number >= 0x80:
        found, number = found + bytes([number & 0x7F | 0x80]), number >> 7
    return found + bytes([number])
