"""Tables of the liquids of the library and of their temperature laws."""

from __future__ import annotations

import warnings

from validation_tables import grid

import contactkit as ck
from contactkit.files.structure import library_names
from contactkit.plot.axis_units import in_prose
from contactkit.units import celsius


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
