"""The file ``resources/film.bin`` of a native FMU: variables and tables, for the C kernel."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Mapping, Sequence
from itertools import pairwise

from ..framework.ports import Port, Value

__all__ = ["IDENTIFIERS", "data_file", "digest", "guid_of", "port_numbers"]

# The same list, in the same order, as in native/model.h.
IDENTIFIERS = (
    "F_ext",
    "dF_ext",
    "h",
    "v",
    "F",
    "F_m",
    "F_v",
    "J",
    "J_m",
    "W",
    "state",
    "limit",
    "t_break",
    "t_release",
    "F_peak",
    "n_break",
    "n_release",
    "m",
    "h0",
    "v0",
    "k_s",
    "h_rel",
    "h_min",
    "h_break",
    "eta",
    "gamma",
    "dp_cav",
    "tau_lim",
    "rtol",
    "c",
    "k",
    "F_mean",
    "coupling_error",
    "H_stable",
    "in_doubt",
    "n_doubt",
    "h_above",
    "h_below",
    "m_ref",
    "exchange",
    "F_mag",
    "F_spring",
    "F_stop",
    "i",
    "u",
    "flux",
    "R_coil",
    "N_turns",
    "A_pole",
    "g_air",
    "g_iron",
    "B_sat",
    "k_spring",
    "F_preload",
    "h_stop",
    "k_stop",
    "d_stop",
    "t_delay",
    "T_period",
    "t_on",
    "U_boost",
    "t_boost",
    "U_hold",
    "U_off",
    "n_cycles",
    "F_el",
    "contact_area",
    "plastic_area",
    "d",
    "d_max",
    "d_res",
    "W_d",
    "n_beyond",
    "h_touch",
    "side",
    "scale",
    "k_body",
    "d_max0",
    "z",
    "vz",
    "az",
    "F_film",
    "W_visc",
    "W_land",
    "t_free",
    "t_land",
    "n_land",
    "F_max",
    "W_plastic",
    "N",
    "h_free",
    "r_cav",
    "V_void",
    "dp_tear",
    "dp_hold",
    "max_steps",
)
_MODELS = ("stiction-mass", "stiction-force", "valve-drive", "contact-stop", "tip-contact")
_TYPES = {"real": 1.0, "integer": 2.0, "enumeration": 4.0, "boolean": 8.0}
_CAUSALITIES = ("input", "output", "parameter")
_MAGIC = b"CKFILM06"


def port_numbers(model: str, ports: Sequence[Port], start: Mapping[str, Value]) -> list[float]:
    """Numbers of the model and the variables of an FMU, as ``native/data.c`` reads them."""
    numbers = [float(_MODELS.index(model)), float(len(ports))]
    for port in ports:
        low, high = port.limits
        numbers += [
            float(IDENTIFIERS.index(port.name)),
            _TYPES[port.kind],
            float(_CAUSALITIES.index(port.causality)),
            float(low),
            float(high),
            float(start[port.name]),
        ]
    return numbers


def digest(sources: Mapping[str, bytes]) -> str:
    """Hash of files and their names."""
    found = hashlib.sha256()
    for name, content in sorted(sources.items()):
        found.update(f"{name}\0{len(content)}\0".encode() + content)
    return found.hexdigest()


def guid_of(sources: Mapping[str, bytes], numbers: Sequence[float], ports: Sequence[Port]) -> str:
    """GUID made from all that decides what the FMU computes and says."""
    said = repr([*numbers]) + repr(ports) + digest(sources)
    build = hashlib.sha256(said.encode()).hexdigest()
    return "-".join(build[i:j] for i, j in pairwise((0, 8, 12, 16, 20, 32)))


def data_file(guid: str, numbers: Sequence[float]) -> bytes:
    """Bytes of the file.

    Examples
    --------
    >>> len(data_file("8c4e810f", [1.0, 2.0]))
    80
    """
    content = struct.pack(f"<{len(numbers)}d", *numbers)
    name = guid.encode().ljust(40, b"\0")
    return _MAGIC + struct.pack("<QQ", _fnv1a(content), len(numbers)) + name + content


def _fnv1a(content: bytes) -> int:
    """Checksum of bytes (FNV-1a, 64 bits)."""
    found = 14695981039346656037
    for byte in content:
        found = ((found ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    return found
