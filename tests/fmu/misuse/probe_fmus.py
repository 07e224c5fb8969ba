"""The FMUs that `probe.py` is let loose on: how each is built, and a run it must repeat.

A new FMU joins by being in `contactkit.fmu.python.build.FMUS`; without a run of its own here
it is stepped with its start values as they are.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from itertools import pairwise
from pathlib import Path

import attrs
import fmpy
from drive_faces import rough
from native_scenes import HAS_CC, SCENES

import contactkit as ck
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.drive import build_native_drive, build_native_stop
from contactkit.fmu.native.tip import build_native_tip
from contactkit.fmu.python.build import FMUS, build

HERE = Path(__file__).parent
KINDS = {
    "Real": "real",
    "Float64": "real",
    "Integer": "integer",
    "Int32": "integer",
    "Enumeration": "enumeration",
    "Boolean": "boolean",
}

VOLUME = 1.5834608721796803e-10  # m3: the film of release case E is full at 5 um


def rising(first, last, count, length):
    """Gaps in equal ratios, with the speed that leads to each."""
    gaps = [first * (last / first) ** (k / count) for k in range(count + 1)]
    return [(length, {"h": b, "v": (b - a) / length}) for a, b in pairwise(gaps)]


def lifting(count, length):
    heights = [(-5e-8 + 2e-7 * k / count, 2e-7 / count / length) for k in range(count)]
    return [(length, {"z": z, "vz": v, "az": 0.0}) for z, v in heights]


DROP = {"h0": 5e-6, "h_break": 2e-5, "dp_cav": 1e6}
FLAT = DROP | {"V": VOLUME, "meniscus_law": 4, "rtol": 1e-4}
PULLED = [(2e-4, {"F_ext": 40.0 + k, "dF_ext": 1e4}) for k in range(6)]
OPENED = rising(5e-6, 3e-5, 6, 1e-4)
RUNS = {
    "stiction-mass": (FLAT, PULLED),
    "stiction-force": (FLAT, OPENED),
    "valve-drive": ({"t_delay": 0.0, "n_cycles": 1}, rising(5e-6, 2.6e-5, 6, 2e-5)),
    "contact-stop": ({}, rising(2.6e-5, 2.49e-5, 6, 1e-4)),
    "deforming-mass": ({}, [(2e-3, {"F_ext": 4e-4 + 1e-5 * k, "dF_ext": 1e-2}) for k in range(6)]),
    "deforming-force": ({}, rising(1e-6, 1.5e-6, 6, 1e-2)),
    "tip-contact": ({}, lifting(6, 4e-8)),  # dry: the film of a sphere takes long to prepare
}
"""Start values, and the length and the inputs of every step."""

NATIVE = (
    [
        (model, fmi)
        for model in (
            "stiction-mass",
            "stiction-force",
            "valve-drive",
            "contact-stop",
            "tip-contact",
        )
        for fmi in (2, 3)
    ]
    + [("deforming-force", 2), ("deforming-mass", 3)]  # on rings, and as a spring
    if HAS_CC
    else []
)

PYTHON = list(FMUS)
NATIVES = [f"{model} native {fmi}" for model, fmi in NATIVE]
ALL = PYTHON + NATIVES


def build_one(name: str, folder: Path) -> Path:
    """Build an FMU of `ALL`."""
    out = folder / f"{name.replace(' ', '_')}.fmu"
    if name in FMUS:
        return build(name, out)
    model, _, fmi = name.split()
    more = {"fmi": int(fmi), "platforms": [local()], "compiler": "cc"}
    if model == "valve-drive":
        return build_native_drive(out, curve=rough() if fmi == "2" else None, **more)
    if model == "contact-stop":
        return build_native_stop(out, curve=rough(), **more)
    if model == "tip-contact":
        return build_native_tip(out, curve=rough(1e-8) if fmi == "2" else None, **more)
    if model.startswith("deforming"):
        soft = fmi == "2"
        film = soft_scene(1e5 if soft else 1e9)
        asked = {"film_rtol": 0.02} if soft else {}
        kind = {"deforming-mass": "stiction-mass", "deforming-force": "stiction-force"}[model]
        return build_native(film, out, model=kind, **asked, **more)
    scene = SCENES["drop"]
    effects = (*scene.effects, ck.TensionLimit(strength=1e6, cavity="truncated"))
    scene = attrs.evolve(scene, effects=effects)
    return build_native(scene, out, model=model, **more)


def soft_scene(modulus: float) -> ck.SeparationScene:
    """Sphere that is pulled off a flat that deforms."""
    solid = ck.Material(young_modulus=modulus, poisson_ratio=0.5)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=ck.Flat(radius=5e-4), solid=solid),
            upper=ck.Sphere(radius=5e-3),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1)),
        ),
        loading=ck.ImposedForce(force=4e-4, mass=0.1, initial_gap=1e-6, final_gap=4e-6),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def unpack(path: Path, folder: Path) -> Path:
    with zipfile.ZipFile(path) as packed:
        packed.extractall(folder)
    return folder


def specification(name: str, folder: Path) -> dict:
    """What `probe.py` has to know of an unpacked FMU."""
    found = fmpy.read_model_description(str(folder))
    variables = [
        {
            "name": v.name,
            "reference": v.valueReference,
            "kind": KINDS[v.type],
            "causality": v.causality,
            "start": float(v.start)
            if v.type in ("Real", "Float64") and v.start is not None
            else 0.0,
        }
        for v in found.modelVariables
        if v.causality in ("input", "output", "parameter")
    ]
    model = name.split()[0]
    start, steps = RUNS.get(model, ({}, None))
    names = {v["name"] for v in variables}  # a native FMU has the geometry in its tables
    start = {k: v for k, v in start.items() if k in names}
    if steps is None:
        still = {v["name"]: v["start"] for v in variables if v["causality"] == "input"}
        steps = [(float(found.defaultExperiment.stepSize), still)] * 6
    identifier = found.coSimulation.modelIdentifier
    libraries = [p for p in folder.glob(f"binaries/*/{identifier}.*") if fits(p)]
    return {
        "folder": str(folder),
        "version": found.fmiVersion[0],
        "library": str(libraries[0]),
        "guid": found.guid or found.instantiationToken,
        "variables": variables,
        "start": start,
        "steps": steps,
    }


def fits(path: Path) -> bool:
    """Whether a library is one for this computer."""
    ends = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
    return path.suffix == ends and not ("aarch64" in str(path.parent) and "x86" in local())


def start_probe(spec: dict, folder: Path, *cases: str, **environment: str) -> subprocess.Popen:
    """Start `probe.py` in a process of its own."""
    path = folder / f"spec {'-'.join(cases)[:40]}.json"
    path.write_text(json.dumps(spec))
    program = f"import sys; sys.path.insert(0, {str(HERE)!r}); import probe; probe.main()"
    return subprocess.Popen(
        [sys.executable, "-I", "-c", program, str(path), *cases],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | environment,
    )


def end_probe(process: subprocess.Popen) -> tuple[int, str, dict]:
    """Exit code, last words and findings of a probe."""
    with process:
        try:
            out, said = process.communicate(timeout=240)
        except subprocess.TimeoutExpired:
            process.kill()
            out, said = process.communicate()
            said += "hangs"
    found = json.loads(out) if process.returncode == 0 else {}
    return process.returncode, said[-2000:], found
