"""Tables of the liquids of the library and of their temperature laws."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

from device_tables import in_prose
from validation_tables import grid

import contactkit as ck
from contactkit.files.structure import library_names
from contactkit.kinds import TEMPERATURE_LAWS
from contactkit.units import celsius, cSt


def liquid_table() -> str:
    """Viscosity of the liquids of the library over temperature, surface tension, density."""
    at = (-20.0, 20.0, 40.0, 100.0)
    rows = []
    for name in library_names("liquids.toml"):
        liquid = ck.load_liquid(name)
        cells = []
        for degrees in at:
            with warnings.catch_warnings():
                warnings.simplefilter("error", ck.ValidityWarning)
                try:
                    cells.append(f"{liquid.at(celsius(degrees)).viscosity * 1e3:.4g}")  # type: ignore[operator]
                except ck.ValidityWarning:
                    cells.append("-")
        room = liquid.at(celsius(20.0))
        more = f"{room.surface_tension * 1e3:.4g}", f"{room.density:.4g}"  # type: ignore[operator]
        rows.append((f"`{name}`", ", ".join(cells), *more))
    degrees = ", ".join(f"{one:g}" for one in at)
    table = grid(("liquid", "mPa·s", "mN/m", "kg/m³"), rows)
    return f"Viscosity at {degrees} °C; surface tension and density at 20 °C:\n\n{table}"


def liquid_source_table() -> str:
    """Sources of the liquids of the library, with the spread of each number."""
    rows = []
    for name in library_names("liquids.toml"):
        liquid = ck.load_liquid(name)
        viscosity = liquid.viscosity or liquid.kinematic_viscosity
        laws = (viscosity, liquid.density, liquid.surface_tension)
        sources = (in_prose(one.source) for one in laws)  # type: ignore[union-attr]
        rows.append((f"`{name}`", *sources))
    return grid(("liquid", "viscosity", "density", "surface tension"), rows)


def law_table() -> str:
    """Temperature laws against values from other sources."""

    def oil(low: float, high: float) -> Callable[[float], float]:
        kind = TEMPERATURE_LAWS[0]
        made: Any = kind(
            temperature_1=celsius(40.0),
            kinematic_viscosity_1=low * cSt,
            temperature_2=celsius(100.0),
            kinematic_viscosity_2=high * cSt,
        )
        return lambda degrees: float(made(celsius(degrees))) / cSt

    water = ck.load_liquid("water")
    vg46, engine = oil(46.0, 6.8), oil(105.0, 14.2)
    checks: list[tuple[str, float, float]] = [
        ("water, viscosity at 25 degC [mPa.s]", 0.89044, water.at(298.15).viscosity * 1e3),  # type: ignore[operator]
        (
            "water, surface tension at 25 degC [mN/m]",
            71.972,
            water.at(298.15).surface_tension * 1e3,
        ),  # type: ignore[operator]
        ("oil 46/6.8 cSt at -20 degC [cSt]", 4518.0, vg46(-20.0)),
        ("oil 46/6.8 cSt at 0 degC [cSt]", 577.3, vg46(0.0)),
        ("oil 46/6.8 cSt at 20 degC [cSt]", 133.84, vg46(20.0)),
        ("oil 46/6.8 cSt at 80 degC [cSt]", 11.103, vg46(80.0)),
        ("oil 105/14.2 cSt at -20 degC [cSt]", 8375.0, engine(-20.0)),
        ("oil 105/14.2 cSt at 0 degC [cSt]", 1248.3, engine(0.0)),
        ("oil 105/14.2 cSt at 20 degC [cSt]", 305.10, engine(20.0)),
    ]
    rows = [(what, f"{wanted:g}", f"{found:.5g}") for what, wanted, found in checks]
    return grid(("what", "reference", "this code"), rows)
