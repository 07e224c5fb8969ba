"""Reference values of films, and the faces that they are about."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

import contactkit as ck
from contactkit.lubrication import reynolds

DATA = Path(__file__).parents[0] / "data" / "film.json"
CASES = {case["id"]: case for case in json.loads(DATA.read_text())["cases"]}
R = 3.175e-3
OIL = 0.1


def reference(name, value="force"):
    return CASES[name]["values"][value]


def inputs(name):
    return CASES[name]["inputs"]


def strip(length, cells, **more):
    """A strip along x between reservoirs, one cell wide; its width."""
    width = length / (cells - 2)
    shape = ck.Rectangle(length=length, width=4.0 * width, centre=(0.5 * length, 0.0))
    window = (0.0, length, -0.5 * width, 0.5 * width)
    return reynolds.rasterise(shape, cells, window=window, **more), width


def quarter_disc(radius, cells, **more):
    return reynolds.rasterise(
        ck.Disc(radius=radius), cells, window=(0.0, radius, 0.0, radius), **more
    )


def squeeze(face, gap=1e-5, rate=1e-3, **more):
    """A full film of the reference's oil."""
    return reynolds.solve_pressure(reynolds.GridFilm(face=face, viscosity=OIL), gap, rate, **more)


def journal(name, cells, across):
    """A journal bearing cut at its widest gap, half of its length; sweep and gap."""
    given = inputs(name)
    ratio, radius, clearance = given["length_over_diameter"], 0.025, 5e-5
    length, width = 2.0 * math.pi * radius, 2.0 * radius * ratio
    x = (np.arange(cells) - 0.5) * length / (cells - 2)
    y = (np.arange(across + 1) + 0.5) * 0.5 * width / across
    level = np.minimum(np.minimum(x, length - x)[None, :], (0.5 * width - y)[:, None])
    size = (0.5 * width / across, length / (cells - 2))
    face = reynolds.face_from_level(level, size, origin=(float(y[0]), float(x[0])))
    return face, clearance * (1.0 + given["eccentricity"] * np.cos(face.x / radius)) + 0.0 * face.y
