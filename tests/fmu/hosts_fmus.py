"""The release cases as FMUs, Python and native, for every host; and hosts that may be missing."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path

from attrs import evolve

from contactkit.benchmarks.releases import release_cases, release_scene
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.python import build as building

HERE = Path(__file__).parent
CASES = release_cases()


def values(name):
    """Start values of a case for `stiction-mass`, with or without its spring."""
    case = CASES[name]["case"]
    found = {key: case[key] for key in ("m", "h0", "k_s", "h_rel", "R", "eta", "gamma", "V")}
    found |= {"dp_cav": case["dp_cav"], "theta1": case["theta"], "theta2": case["theta"]}
    return found | {"meniscus_law": "PUBLISHED"}


def reference(name):
    return CASES[name]["values"]["t_rel"]


def python_fmu(folder, model, name, **changes):
    """FMU of a case; `changes` replace its start values."""
    slave = building._slave_class(model)
    known = {port.name for port in slave.ports if port.causality != "output"}
    start = {key: value for key, value in (values(name) | changes).items() if key in known}
    return building.build(model, folder / f"{model}-{name}.fmu", start=start)


def native_fmu(folder, model, name, fmi=2, **changes):
    """The same without Python: of the scene of the case, `changes` as for `python_fmu`."""
    built, start = release_scene(name), dict(changes)
    if "k_s" in start:
        built = evolve(built, loading=evolve(built.loading, stiffness=start.pop("k_s")))
    out = folder / f"{model}-{name}-native-{fmi}.fmu"
    here = {"platforms": [local()], "compiler": "cc"}
    return build_native(built, out, model=model, fmi=fmi, start=start, **here)


def _load(module):
    """Import a file of tests as if it lay in contactkit/fmu."""
    name = f"contactkit.fmu.slaves.{module}"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, HERE / f"{module}.py")
        sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])


def helper_fmu(folder, class_name, name):
    """One of `hosts_slaves`, with the values of a case."""
    module = "hosts_slaves"
    _load(module)
    case, key = CASES[name]["case"], class_name.lower()
    building.FMUS[key] = (f"slaves.{module}", class_name)
    try:
        start = {"F0": case["F0"], "tau": case["tau"], "k": case["k_s"], "h0": case["h0"]}
        if class_name == "Body":
            start |= {"m": case["m"], "h_rel": case["h_rel"]}
        return building.build(key, folder / f"{key}-{name}.fmu", start=start)
    finally:
        del building.FMUS[key]


class Cases:
    """FMUs of the release cases; kinds are helper, python, native 2, native 3."""

    def __init__(self, shelf):
        self._shelf = shelf

    def __call__(self, kind, model, name="A", **changes):
        def make(folder):
            if kind == "helper":
                built = helper_fmu(folder, model, name)
            elif kind == "python":
                built = python_fmu(folder, model, name, **changes)
            else:
                built = native_fmu(folder, model, name, int(kind[-1]), **changes)
            built.rename(folder / "x.fmu")

        key = re.sub(r"\W+", "-", f"case {kind} {model} {name} {changes}")
        return self._shelf.folder(key, make) / "x.fmu"


__all__ = ["CASES", "HERE", "Cases", "native_fmu", "reference", "values"]
