"""Scenes of the tests of pages of contacts, and a reader of their maps that shares no code."""

from __future__ import annotations

import json
import math
import re
import warnings
from base64 import b64decode
from gzip import decompress
from html import unescape

import numpy as np

import contactkit as ck

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=5e9)
RADIUS, FORCE = 1e-3, 0.2  # [m], [N]


def ball(*effects, young_modulus=210e9, force=FORCE, **more):
    """A rigid ball on steel, an isolated contact."""
    steel = ck.Material(name="steel", young_modulus=young_modulus, poisson_ratio=0.3)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=30e-6, periodic=False),
        loading=ck.Pressing(force=force),
        effects=(ck.HalfSpace(), *effects),
        **({"name": "ball"} | more),
    )


def hertz(young_modulus=210e9, force=FORCE):
    """Contact radius [m], maximum pressure [Pa] and approach [m] of the ball, by hand."""
    modulus = young_modulus / (1.0 - 0.3**2)
    radius = (0.75 * force * RADIUS / modulus) ** (1.0 / 3.0)
    return radius, 1.5 * force / (math.pi * radius**2), radius**2 / RADIUS


def rough(*effects, pressure=2e8, **more):
    """Rough steel under a flat, wetted by a thin film."""
    surface = ck.SelfAffineRoughness(rms=20e-9, hurst=0.8, rolloff=4e-6, cutoff=1e-6, seed=3)
    meniscus = ck.Meniscus(liquid=ck.load_liquid("water"))
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL, surface=surface), meniscus=meniscus),
        window=ck.Window(width=8e-6, periodic=True),
        loading=ck.Pressing(pressure=pressure),
        effects=(
            ck.HalfSpace(),
            ck.HardnessLimit(rule="material"),
            ck.FilmMeniscus(film_thickness=5e-9),
            *effects,
        ),
        **({"name": "rough and wet"} | more),
    )


def solved(scene, accuracy):
    """The contact of a scene, whatever its validity."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ck.solve(ck.plan(scene, accuracy))


class Read:
    """A page as a reader of its HTML has it."""

    def __init__(self, text):
        found = dict(re.findall(r'<script id="(\w+)" type="[\w/]+">(.*?)</script>', text, re.S))
        self.data = json.loads(found["data"])
        self.bytes = {n: decompress(b64decode(found[n])) for n in ("maps", "planes")}

    @property
    def names(self):
        return [one["name"] for one in self.data["views"][0]["surface"]["maps"]]

    def _part(self, name, view):
        """Part of a view that has a map, and the map."""
        parts = (self.data["views"][view][kind] for kind in ("surface", "stress"))
        found = [(part, one) for part in parts if part for one in part["maps"]]
        return next((part, one) for part, one in found if one["name"] == name)

    def map(self, name, load=-1, plane=0, view=0):
        """Values of a map, and half of the step it is rounded to."""
        part, one = self._part(name, view)
        content = self.bytes["planes" if "flags" not in part else "maps"]
        return self._values(content, one["images"][load][plane], part["shape"])

    def top(self, name, load=-1, plane=0, view=0):
        """Largest value of a map, and its place."""
        return self._part(name, view)[1]["images"][load][plane]["top"]

    def flags(self, name, load=-1, view=0):
        surface = self.data["views"][view]["surface"]
        bit = [one["name"] for one in self.data["outlines"]].index(name)
        image = {"start": surface["flags"][load], "bytes": 1}
        return levels(self.bytes["maps"], image, surface["shape"]) >> bit & 1 == 1

    def _values(self, content, image, shape):
        found = levels(content, image, shape)
        none = found == 256 ** image["bytes"] - 1
        values = image["low"] + image["step"] * found
        return np.where(none, math.nan, values), 0.5 * image["step"] * (1.0 + 1e-9)

    def numbers(self, load=-1):
        return {one["name"]: one["value"] for one in self.data["loads"][load]["numbers"]}


def levels(content, image, shape):
    """Levels of a map, written cell by cell as the page's own script does."""
    ny, nx = shape
    size, start = image["bytes"], image["start"]
    planes = [
        np.frombuffer(content, np.uint8, ny * nx, start + i * ny * nx).reshape(ny, nx)
        for i in range(size)
    ]
    found = np.zeros((ny, nx), dtype=int)
    for row in range(ny):
        last = int(found[row - 1, 0]) if row else 0
        for column in range(nx):
            change = sum(int(one[row, column]) << (8 * i) for i, one in enumerate(planes))
            found[row, column] = last = (last + change) % 256**size
    return found


def pre(dom, name):
    """Text that a probe wrote into the page."""
    return unescape(re.search(rf'<pre id="{name}">(.*?)</pre>', dom, re.DOTALL)[1])
