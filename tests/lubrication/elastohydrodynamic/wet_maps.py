"""Faces and bodies of the tests of films on maps."""

import json
import math
from pathlib import Path

import numpy as np

from contactkit.elasticity.isolated_map import isolated_map
from contactkit.elasticity.layer_stack import Layers
from contactkit.lubrication.elastohydrodynamic.drive import Driven, Imposed
from contactkit.lubrication.elastohydrodynamic.maps.follow import MapControl, begun, follow
from contactkit.lubrication.elastohydrodynamic.maps.wet_map import WetMap, at_rest
from contactkit.lubrication.reynolds.face import face_from_level

DATA = Path(__file__).parents[2] / "data/wet.json"
CASES = {case["id"]: case for case in json.loads(DATA.read_text())["cases"]}


def square(n, half):
    """Square face with n cells along a side, one row of reservoir around it, and its x and y."""
    step = 2.0 * half / n
    x = (np.arange(n + 2) - 0.5) * step - half
    level = half - np.maximum(np.abs(x)[None, :], np.abs(x)[:, None])
    return face_from_level(level, step, origin=(x[0], x[0])), x[None, :], x[:, None]


def disc(n, radius):
    """Round face of n cells across."""
    step = 2.0 * radius / n
    x = (np.arange(n + 2) - 0.5) * step - radius
    level = radius - np.hypot(x[None, :], x[:, None])
    return face_from_level(level, step, origin=(x[0], x[0])), x[None, :], x[:, None]


def waves(x, y, given):
    """Sum of cosines with phases of a linear congruence, as the cases state it."""
    state, total, variance = given["seed"], 0.0, 0.0
    for k in range(1, given["waves"] + 1):
        for d in range(4):
            state = (1103515245 * state + 12345) % 2**31
            turn = math.pi * (d + (0.5 if k % 2 else 0.0)) / 4.0
            size = k**-1.8
            variance += size**2 / 2.0
            along = math.cos(turn) * x + math.sin(turn) * y
            phase = 2.0 * math.pi * state / 2**31
            total = total + size * np.cos(2.0 * math.pi * k / given["L"] * along + phase)
    return total * given["rms"] / math.sqrt(variance)


def wet_map(case, n, drive=None, modulus=None, **given):
    """Rough square or smooth disc of a case, n cells across."""
    inputs = case["inputs"]
    modulus = inputs["effective_modulus"] if modulus is None else modulus
    is_rough = "heights" in inputs
    face, x, y = square(n, inputs["half_side"]) if is_rough else disc(n, inputs["rim_radius"])
    shape = (x**2 + y**2) / (2.0 * inputs["radius"])
    if is_rough:
        shape = shape + waves(x, y, inputs["heights"])
    solid = Layers([modulus], [0.0])
    if "layer_thickness" in inputs:
        nu = inputs["layer_poisson"]
        solid = Layers([(1.0 - nu**2) * modulus], [nu], [inputs["layer_thickness"]], "bonded")
    bodies = isolated_map(face.shape, face.pixel_size, solid)
    given.setdefault("cutoff", inputs.get("contact_cutoff", 0.0))
    given.setdefault("floor", -inputs.get("cavity_pressure_below_ambient", math.inf))
    drive = drive or motion(inputs)
    return WetMap(face, shape, inputs["viscosity"], bodies, drive, **given)


def motion(inputs):
    """What moves the bodies of a case from the start."""
    gap, speed = inputs.get("gap", 1e-6), inputs.get("speed", 0.0)
    if "pull" in inputs:
        return Driven(lambda _: inputs["pull"], inputs.get("mass", 0.0))
    if "stiffness" in inputs:
        return Driven(lambda _: 0.0, 0.0, inputs["stiffness"], lambda t: gap + speed * t)
    return Imposed(lambda t: gap + speed * t)


def pulled(wet, times, gap=1e-6, **control):
    """States at times, of bodies at rest before."""
    return follow(wet, begun(at_rest(wet, gap)), [0.0, *times], MapControl(**control))


def pull_at(wet, track, times):
    """Force that resists opening, at times."""
    states = [min(track.states, key=lambda s, t=t: abs(s.time - t)) for t in times]
    return np.array([-wet.thrust(one.fields.total) for one in states])
