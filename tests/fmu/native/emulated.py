"""The machine code of any platform, run by an emulated processor.

What is emulated is the processor (by unicorn), and as much of a loader as our libraries need; the
functions they import are those of `emulated_libc`.
"""

from __future__ import annotations

import struct

import unicorn
from emulated_libc import LibC
from unicorn import arm64_const as arm
from unicorn import x86_const as x86

__all__ = ["Machine"]

CODE, STUBS, STACK, HEAP = 0x10000000, 0x20000000, 0x30000000, 0x40000000
STACK_SIZE, HEAP_SIZE, PAGE = 0x100000, 0x4000000, 0x4000


class Intel:
    """The x86-64, and where functions find their arguments."""

    kind = unicorn.UC_ARCH_X86, unicorn.UC_MODE_64
    wholes = (
        x86.UC_X86_REG_RDI,
        x86.UC_X86_REG_RSI,
        x86.UC_X86_REG_RDX,
        x86.UC_X86_REG_RCX,
        x86.UC_X86_REG_R8,
        x86.UC_X86_REG_R9,
    )
    reals = tuple(x86.UC_X86_REG_XMM0 + i for i in range(8))
    stack, counter, result = x86.UC_X86_REG_RSP, x86.UC_X86_REG_RIP, x86.UC_X86_REG_RAX
    leave = b"\xc3"
    above = 8  # bytes on the stack below the arguments: where to return to
    by_place = False  # whether the third argument is in the third register of either kind


class IntelWindows(Intel):
    wholes = (Intel.wholes[3], Intel.wholes[2], *Intel.wholes[4:])
    reals = Intel.reals[:4]
    above = 40
    by_place = True


class Arm:
    kind = unicorn.UC_ARCH_ARM64, unicorn.UC_MODE_ARM
    wholes = tuple(arm.UC_ARM64_REG_X0 + i for i in range(8))
    reals = tuple(arm.UC_ARM64_REG_D0 + i for i in range(8))
    stack, counter, result = arm.UC_ARM64_REG_SP, arm.UC_ARM64_REG_PC, arm.UC_ARM64_REG_X0
    leave = bytes.fromhex("c0035fd6")
    above = 0
    by_place = False


class Places:
    """Where one argument after the other is: a register, or an address in the stack."""

    def __init__(self, kind, stack):
        self.kind, self.below = kind, stack + kind.above
        self.wholes = self.reals = self.stacked = 0

    def next(self, is_real, stacked=False):
        kind = self.kind
        used, registers = (self.reals, kind.reals) if is_real else (self.wholes, kind.wholes)
        if kind.by_place:
            used = self.wholes + self.reals
        if stacked or used >= len(registers):
            self.stacked += 1
            return None, self.below + 8 * (self.stacked - 1)
        self.reals, self.wholes = self.reals + is_real, self.wholes + (not is_real)
        return registers[used], None


class Machine(LibC):
    """A processor with one library loaded; `call` calls a function of it.

    `files` are contents by path, as the library asks for them; `opened` are the paths it did.
    """

    def __init__(self, library, files):
        super().__init__(files)
        self.library, self.top = library, HEAP
        self.kind = IntelWindows if library.system == "windows" else Intel
        if library.machine == "aarch64":
            self.kind = Arm
        self.cpu = unicorn.Uc(*self.kind.kind)
        if self.kind is Arm:
            self.cpu.ctl_set_cpu_model(arm.UC_CPU_ARM64_MAX)  # that of a Mac can more than others
            self.cpu.reg_write(arm.UC_ARM64_REG_CPACR_EL1, 3 << 20)  # it may count with reals
        self.stubs, self.places = [], None
        self._load()

    def _load(self):
        self.cpu.mem_map(CODE, -(-len(self.library.image) // PAGE) * PAGE)
        self.cpu.mem_write(CODE, bytes(self.library.image))
        self.cpu.mem_map(STUBS, PAGE)
        self.cpu.mem_map(STACK, STACK_SIZE)
        self.cpu.mem_map(HEAP, HEAP_SIZE)
        for cell in self.library.rebased:
            self.write(CODE + cell, "<Q", self.read(CODE + cell, "<Q")[0] + CODE)
        self.end = self.stub(None)
        for name, cells in self.library.imports.items():
            address = self.stub(lambda name=name: getattr(self, f"c_{name.strip('_')}")())
            for cell in cells:
                self.write(CODE + cell, "<Q", address)
        self.cpu.hook_add(unicorn.UC_HOOK_CODE, self._outside, begin=STUBS, end=STUBS + PAGE - 1)

    def stub(self, function):
        """Address where the code finds a function in Python."""
        address = STUBS + 16 * len(self.stubs)
        self.cpu.mem_write(address, self.kind.leave)
        self.stubs.append(function)
        return address

    def _outside(self, cpu, address, size, data):
        if address == self.end:
            return
        self.places = Places(self.kind, cpu.reg_read(self.kind.stack))
        found = self.stubs[(address - STUBS) // 16]()
        if isinstance(found, float):
            cpu.reg_write(self.kind.reals[0], int.from_bytes(struct.pack("<d", found), "little"))
        elif found is not None:
            cpu.reg_write(self.kind.result, found % 2**64)

    def whole(self, further=False):
        """Next argument of the function that was called, as a whole number; `further` if it is
        one of any number."""
        return self._argument(False, further)

    def real(self, further=False):
        return struct.unpack("<d", struct.pack("<Q", self._argument(True, further)))[0]

    def _argument(self, is_real, further):
        if self.kind.by_place and further:
            is_real = False  # in both kinds of registers
        apple = self.library.system == "macos" and self.kind is Arm
        register, address = self.places.next(is_real, stacked=further and apple)
        if register is None:
            return self.read(address, "<Q")[0]
        return self.cpu.reg_read(register) % 2**64

    def read(self, address, layout):
        return struct.unpack(layout, self.cpu.mem_read(address, struct.calcsize(layout)))

    def write(self, address, layout, *values):
        self.cpu.mem_write(address, struct.pack(layout, *values))

    def room(self, size):
        """Address of memory that nothing had before."""
        address = self.top
        self.top += 16 * (size // 16 + 2)
        assert self.top <= HEAP + HEAP_SIZE, "the memory is used up"
        return address

    def place(self, content):
        """Address of a copy of bytes."""
        address = self.room(len(content))
        self.cpu.mem_write(address, content)
        return address

    def call(self, function, *values):
        """Call by name, with whole numbers and floats; what it returns, as a whole number."""
        stack = STACK + STACK_SIZE - 0x1000
        stack -= self.kind is not Arm and 8  # as if called
        places = Places(self.kind, stack)
        for value in values:
            is_real = isinstance(value, float)
            content = struct.pack("<d", value) if is_real else struct.pack("<Q", value % 2**64)
            register, address = places.next(is_real)
            if register is None:
                self.cpu.mem_write(address, content)
            else:
                self.cpu.reg_write(register, int.from_bytes(content, "little"))
        if self.kind is Arm:
            self.cpu.reg_write(arm.UC_ARM64_REG_X30, self.end)
        else:
            self.write(stack, "<Q", self.end)
        self.cpu.reg_write(self.kind.stack, stack)
        self.cpu.emu_start(CODE + self.library.exports[function], self.end)
        assert self.cpu.reg_read(self.kind.counter) == self.end
        return self.cpu.reg_read(self.kind.result)
