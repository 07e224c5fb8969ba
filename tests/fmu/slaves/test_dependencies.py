"""Declared dependencies: what an output does not list does not move it at the start."""

from __future__ import annotations

import pytest

pytest.importorskip("pythonfmu")

from drive_faces import ball, rough

from contactkit.fmu.slaves.contact_stop import ContactStop
from contactkit.fmu.slaves.stiction_force import StictionForce
from contactkit.fmu.slaves.stiction_mass import StictionMass
from contactkit.fmu.slaves.tip_contact import TipContact, TipLaw
from contactkit.fmu.slaves.valve_drive import ValveDrive

pytestmark = pytest.mark.slow

DROP = {"V": 1.58e-10}
LIMITS = DROP | {"dp_cav": 1e5, "tau_lim": 1e5}
TIP = {"V": 1.3e-24, "profile": TipLaw.ARC}
MET = {"h": 25.5e-6, "v": 0.1}
SPRUNG = {"k_body": 3e8, "d_stop": 5.0, "d_max0": 9e-7}
CASES = {
    "wet, compliant": (TipContact, ball(), TIP | {"z": -1e-8, "d_stop": 1.0}),
    "landed, compliant": (TipContact, ball(), {"z": -1e-8}),
    "free": (TipContact, None, {"z": 1e-8, "vz": 0.1}),
    "landed": (TipContact, None, {"z": -1e-8}),
    "stop": (ContactStop, rough(), MET | SPRUNG),
    "film": (StictionForce, None, DROP | {"h": 6e-6, "v": 1e-3}),
    "film with limits": (StictionForce, None, LIMITS | {"h": 6e-6, "v": 1.0}),
    "mass": (StictionMass, None, DROP | {"v0": 1e-3}),
    "mass with limits": (StictionMass, None, LIMITS | {"v0": 1.0}),
    "mass at rest": (StictionMass, None, DROP | {"h_min": 5e-6}),
    "drive": (ValveDrive, None, MET | {"t_delay": 0.0}),
    "drive with rough faces": (ValveDrive, rough(), MET | {"t_delay": 0.0}),
}


def outputs(slave, curve, values):
    """Outputs at the start; None where the values are refused."""
    made = slave(instance_name="one")
    made.data = {} if curve is None else {"curve": curve.to_data()}
    made.setup_experiment(0.0)
    made.values |= values
    made.enter_initialization_mode()
    made.exit_initialization_mode()
    if made.failure:
        return None
    return {port.name: made.values[port.name] for port in ports(slave, "output")}


def ports(slave, *causalities):
    return [port for port in slave.ports if port.causality in causalities]


def others(port, value):
    """Other values of an input or a parameter: all of a choice, near numbers, any but zero."""
    if port.enumeration is not None:
        return list(port.enumeration)
    if port.kind == "integer":
        return [value + 1]
    return [1.01 * value] if value else [1e-9, 1e-3, 1.0]


WET = pytest.param("wet, compliant", marks=pytest.mark.slow)


@pytest.mark.parametrize("case", [WET if "wet" in case else case for case in CASES])
def test_no_dependency_is_missing(case):
    slave, curve, values = CASES[case]
    first, start = outputs(slave, curve, values), slave.start_values() | values
    moved, lost = set(), set()
    for known in ports(slave, "input", "parameter"):
        for value in others(known, start[known.name]):
            found = outputs(slave, curve, values | {known.name: value})
            for port in ports(slave, "output") if found is not None else ():
                if found[port.name] != first[port.name]:
                    is_listed = port.depends_on is None or known.name in port.depends_on
                    (moved if is_listed else lost).add((port.name, known.name))
    assert lost == set()
    assert len(moved) >= 3
