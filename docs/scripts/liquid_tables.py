"""Tables of the liquids of the library and of their temperature laws."""

from __future__ import annotations

import warnings

from validation_tables import grid

import contactkit as ck
from contactkit.files.structure import library_names
from contactkit.units import celsius


def liquid_table() -> str:
    """Viscosity of the liquids of the library over temperature, surface tension, density."""
    at = (-20.0, 0.0, 20.0, 40.0, 80.0, 100.0)
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
                    cells.append("outside")
        room = liquid.at(celsius(20.0))
        more = f"{room.surface_tension * 1e3:.4g}", f"{room.density:.5g}"  # type: ignore[operator]
        rows.append((f"`{name}`", *cells, *more))
    head = [f"{degrees:g} °C" for degrees in at]
    return grid(("liquid", *head, "surface tension [mN/m]", "density [kg/m³]"), rows)


def liquid_source_table() -> str:
    """Sources of the liquids of the library, with the spread of each number."""
    rows = []
    for name in library_names("liquids.toml"):
        liquid = ck.load_liquid(name)
        viscosity = liquid.viscosity or liquid.kinematic_viscosity
        laws = (viscosity, liquid.density, liquid.surface_tension)
        rows.append((f"`{name}`", f"{liquid.name}; {liquid.source}", *(one.source for one in laws)))  # type: ignore[union-attr]
    return grid(("liquid", "what", "viscosity", "density", "surface tension"), rows)
