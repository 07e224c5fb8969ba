"""Writing the native FMU ``tip-contact``: film and site of a tip as tables, the tip in C."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from attrs import evolve

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ..contents.end_stop import bake
from ..framework.ports import NATIVE_STEPS, STEP_LIMIT, Port, Value, start_value
from ..slaves.tip_contact import PORTS, TipContact, check_tip, tip_scene
from .build import NativeContent, chosen_platforms, native_about, target, write_native
from .faces import faces_of
from .film import PreparedFilm, free_liquid, prepared_film
from .models import native_model

__all__ = ["build_native_tip", "tip_ports"]


def build_native_tip(
    out: str | os.PathLike[str],
    *,
    start: Mapping[str, Any] | None = None,
    curve: LoadDisplacementCurve | None = None,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
    fmi: Literal[2, 3] = 2,
) -> Path:
    """Write a ``tip-contact`` that runs without Python (co-simulation).

    It has the variables of the Python FMU of that name, but for the parameters that its tables
    hold: radius of the apex, Hamaker constant, volume, contact angles and profile of the meniscus.
    A dry tip has no properties of the liquid, either.

    Parameters
    ----------
    out : path
        The file to write, ``*.fmu``.
    start : mapping, optional
        Start values by variable of the Python FMU, those that the tables hold among them; a text
        carries its unit (``"100 nm"``). As in `build`, a ``curve`` may be among them.
    curve : LoadDisplacementCurve, optional
        Apex and site; a rigid site without one.
    platforms, compiler, fmi
        See `build.build_native`. In FMI 3.0 a step never ends early.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If a name, a start value, the curve, a platform or a version is not possible.
    ContactkitError
        If a force cannot be tabulated, or a compiler is missing.
    """
    place = target(out, fmi)
    given = dict(start or {})
    if curve is not None:
        given["curve"] = curve
    site = bake("tip-contact", given).get("curve")
    values: dict[str, Value] = TipContact.start_values() | {STEP_LIMIT: NATIVE_STEPS}
    values |= {name: start_value(PORTS, name, value) for name, value in given.items()}
    check_tip(values, has_curve=site is not None)
    scene = tip_scene(values)
    film = prepared_film(scene)
    ports = tip_ports(film)
    about = native_about("tip-contact", ports, {port.name: values[port.name] for port in ports})
    faces = None if site is None else faces_of(LoadDisplacementCurve.from_data(site))
    content = NativeContent(film.tables, faces, scene=scene)
    names = chosen_platforms(platforms)
    return write_native("tip-contact", about, content, place, fmi, names, compiler)


def tip_ports(film: PreparedFilm) -> tuple[Port, ...]:
    """Variables of the Python FMU that the tables leave free, and within what they hold."""
    viscosity, surface_tension = free_liquid(film.prepared)
    liquid = {"eta": viscosity, "gamma": surface_tension}
    absent = {name for name, value in liquid.items() if not value}
    there = [port for port in native_model("tip-contact").ports if port.name not in absent]
    names = {port.name for port in there}
    return tuple(_port(port, names, film.lowest) for port in there)


def _port(port: Port, names: set[str], lowest: float) -> Port:
    if port.name == "h0":
        return evolve(port, exclusive=False, minimum=lowest)
    if port.name == STEP_LIMIT:
        return evolve(port, start=NATIVE_STEPS)
    if port.depends_on is None:
        return port
    return evolve(port, depends_on=tuple(name for name in port.depends_on if name in names))
