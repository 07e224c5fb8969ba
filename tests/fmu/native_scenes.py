"""Scenes of the tests of native FMUs, and the C compiler that builds them."""

from __future__ import annotations

import importlib.util
import math
import os
import shutil
import subprocess
from pathlib import Path

import pytest

import contactkit as ck

HERE = Path(__file__).parent
CC = os.environ.get("CC", "cc").split()[0]
HAS_CC = shutil.which(CC) is not None and importlib.util.find_spec("fmpy") is not None

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
FACE = ck.Flat(radius=3.175e-3)
FORCES = (ck.MeniscusForce(), ck.ViscousForce())


LOADING = {"gap": 5e-6, "mass": 0.02, "final": 1e-4, "rest": 0.0, "stiffness": 5e3}


def scene(lower=FACE, upper=FACE, angles=(0.2, 0.2), effects=FORCES, **given):
    """Separation of two bodies; `given` are values of `LOADING`, and of the meniscus."""
    pulled = LOADING | {name: given.pop(name) for name in LOADING if name in given}
    liquid = ck.Meniscus(
        liquid=OIL,
        contact_angle_lower=angles[0],
        contact_angle_upper=angles[1],
        **given,
    )
    loading = ck.ImposedForce(
        initial_gap=pulled["gap"],
        final_gap=pulled["final"],
        force=1.0,
        mass=pulled["mass"],
        rest_gap=pulled["rest"],
        stiffness=pulled["stiffness"],
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=lower, upper=upper, meniscus=liquid),
        loading=loading,
        effects=effects,
    )


DROP = math.pi * FACE.radius**2 * 5e-6
SPHERE = {"lower": ck.Flat(), "upper": ck.Sphere(radius=1e-3), "volume": 1e-14, "gap": 1e-7}
SPHERE |= {"mass": 1e-6, "final": 3e-5, "stiffness": 0.0}

SCENES = {
    "flooded": scene(gap=20e-6),
    "drop": scene(volume=DROP),
    "unequal angles": scene(volume=1e-11, angles=(1.0, 2.0)),
    "repelled, many": scene(volume=DROP, angles=(math.pi, math.radians(120.0)), count=3),
    "arc, many": scene(volume=DROP, effects=(ck.MeniscusForce(profile="arc"), FORCES[1]), count=4),
    "sphere": scene(
        **SPHERE, angles=(0.5, 0.7), effects=(*FORCES, ck.TensionLimit(cavity="truncated"))
    ),
    "rewetting": scene(
        volume=DROP,
        rest=4e-6,
        final=8e-4,
        effects=(*FORCES, ck.TensionLimit(strength=1e6, cavity="truncated")),
        rewetting=0.5,
    ),
    "solids": scene(
        volume=DROP,
        gap=1e-6,
        effects=(*FORCES, ck.VanDerWaalsForce(hamaker_constant=1e-19)),
        final=1e-3,
    ),
    "stieber": scene(gap=5e-6, effects=(*FORCES, ck.TensionLimit(strength=1e5, cavity="reynolds"))),
    "shear": scene(gap=1e-7, effects=(*FORCES, ck.ShearLimit(strength=1e5))),
}


TIP = {"lower": ck.Flat(), "upper": ck.Sphere(radius=1e-6), "gap": 1e-10, "mass": 1e-12}
TIP |= {"final": 1e-6, "stiffness": 0.0}
STUCK = ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e9)
SUMMITS = ck.AsperityMenisci(
    asperities=ck.AsperityPopulation(density=1e12, radius=1e-6, rms_height=5e-9),
    profile="thin-film",
    meniscus_height=2e-8,
)
ROUGH = ck.Flat(radius=1e-4)

SCENES |= {
    "humid tip": scene(**TIP, pressure=-1e7),
    "tip that sticks": scene(**TIP, volume=1e-20, effects=(*FORCES, STUCK)),
    "rough": scene(
        lower=ROUGH,
        upper=ROUGH,
        gap=1e-8,
        mass=1e-6,
        final=1e-6,
        stiffness=0.0,
        effects=(SUMMITS,),
    ),
}


RING = ck.Flat(planform=ck.Ring(radius=3.175e-3, hole_radius=1e-3))
PAD = ck.Flat(planform=ck.Rectangle(length=4e-3, width=3e-3), tilt=(1e-3, 0.0))
SCENES |= {
    "ring": scene(lower=ck.Flat(), upper=RING, stiffness=0.0),
    "tilted": scene(lower=ck.Flat(), upper=PAD, effects=(ck.ViscousForce(),), stiffness=0.0),
}


# Degrees, which a liquid repelled by one or both faces ends at as no power of what is left.
ANGLES = [(180, 180), (179.9, 179.9), (120, 60)]


def bare_meniscus(lower, upper):
    """A free meniscus alone, between contact angles [deg]."""
    angles = (math.radians(lower), math.radians(upper))
    free = ck.Flat()
    return scene(
        lower=free,
        upper=free,
        volume=1e-12,
        angles=angles,
        gap=1e-6,
        final=1e-3,
        stiffness=0.0,
        effects=(ck.MeniscusForce(),),
    )


def write_sources(folder):
    """Write the sources of the kernel and the headers of FMI to a folder."""
    from contactkit.fmu.native import sources  # which needs pythonfmu

    sources.write_sources(folder)
    return folder


def compile_c(sources, out, *flags):
    """Compile files with the C compiler of this computer."""
    common = ["-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off"]
    words = [CC, *common, *flags, *map(str, sources), "-o", str(out), "-lm", "-lpthread", "-ldl"]
    subprocess.run(words, check=True, capture_output=True, text=True)
    return out


SANITIZED = ("-g1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


def sanitized_kernel(shelf, sources, fmi):
    """Library of the sources of a version of FMI that ends itself where it errs; compiled once."""
    files = sorted(sources.glob("*.c"))

    def make(folder):
        compile_c(files, folder / "kernel.so", "-fPIC", "-shared", f"-I{sources}", *SANITIZED)

    try:
        return shelf.folder(f"sanitized kernel {fmi}", make) / "kernel.so"
    except subprocess.CalledProcessError as error:
        pytest.skip(f"the compiler has no sanitizers: {error.stderr[:200]}")


def compile_probe(folder):
    """Write the kernel to a folder, and compile a program that asks it for forces."""
    write_sources(folder)
    files = [path for path in folder.glob("*.c") if not path.name.startswith(("fmi2", "fmi3"))]
    compile_c([HERE / "native_probe.c", *files], folder / "probe", f"-I{folder}", "-O0")


def probed(probe, tables, folder, points, parameters):
    """Numbers of the program at gaps and speeds, a column of each.

    Fixed force, its slope, viscous force, its slopes, and the limit; `parameters` are viscosity,
    surface tension, tension and strength.
    """
    import numpy as np

    from contactkit.fmu.native.data import contents_of, data_file
    from contactkit.fmu.native.sources import layout
    from contactkit.fmu.slaves.stiction_mass import PORTS

    start = {port.name: port.start for port in PORTS}
    numbers = contents_of("stiction-mass", PORTS[:1], start, tables).numbers()
    (folder / "film.bin").write_bytes(data_file("g", layout(), numbers))
    said = subprocess.run(
        [str(probe), str(folder), *map(repr, parameters)],
        check=True,
        capture_output=True,
        text=True,
        input="".join(f"{gap!r} {speed!r}\n" for gap, speed in points),
    ).stdout
    return np.array([[float(word) for word in line.split()] for line in said.splitlines()]).T
