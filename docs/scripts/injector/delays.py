"""Release, closing and refilling of the fuel injector by the monolithic model."""

from __future__ import annotations

import math

from validation_tables import grid

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.models.injector.delays import delay, dry_delay
from contactkit.models.injector.monolithic import simulate as simulate_monolithic
from contactkit.models.injector.scene import InjectorScene
from contactkit.units import celsius


def _milliseconds(delay: float) -> str:
    return "never" if math.isnan(delay) else f"{delay * 1e3:.3f}"


def _degrees(injector: InjectorScene) -> list[str]:
    return [f"{t - celsius(0.0):.0f} °C [ms]" for t in injector.study.temperatures]


def oils_table() -> str:
    """Release delay of the injector for each thing that its oil may do."""
    injector = open_scene("fuel-injector").scene
    oils = {
        "cavitates at 10 bar, cavity at 0 bar (vapour)": {},
        "cavitates at 10 bar, cavity at -4 bar": {"cavity_pressure": -4e5},
        "cavitates at 10 bar and goes on to sustain it": {"cavity_pressure": -math.inf},
        "never cavitates": {"cavitates": False},
    }
    rows = [
        [
            name,
            *(_milliseconds(delay(injector, t, **oil)) for t in injector.study.temperatures),
        ]
        for name, oil in oils.items()
    ]
    dry = _milliseconds(dry_delay(injector))
    return grid(["oil", *_degrees(injector)], [*rows, ["no film (dry)", dry, dry, dry]])


def pressure_table() -> str:
    """Release delay over the pressure around the face [bar], of an oil that cavitates at -9 bar."""
    injector = open_scene("fuel-injector").scene
    rows = []
    for value in (1.01325, 2.0, 3.0, 5.0, 10.0, 12.0, 13.0, 14.0, 15.0, 17.0, 20.0):
        row = [f"{value:.3g} bar"]
        for pressure in (0.0, -math.inf):
            cells = [
                _milliseconds(
                    delay(injector, t, cavity_pressure=pressure, ambient_pressure=value * 1e5)
                )
                for t in injector.study.temperatures
            ]
            row.append(", ".join(cells))
        rows.append(row)
    return grid(["pressure", "vapour [ms]", "sustains it [ms]"], rows)


def closing_table() -> str:
    """Distance from the end cap at which the spool is at the end of each cycle."""
    injector = open_scene("fuel-injector").scene
    profile, rest = injector.valve.profile, injector.loading.rest_gap
    ends = [profile.start_delay + (n + 1) * profile.period for n in range(profile.cycles)]
    head = [f"cycle {n} [µm]" for n in (1, len(ends))]
    rows = []
    for name, pressure in (("vapour", 0.0), ("sustains it", -math.inf)):
        for temperature in injector.study.temperatures:
            made = ck.plan(injector.separation(temperature, cavity_pressure=pressure))
            found = simulate_monolithic(made, injector.valve, ends[-1], rtol=1e-6, times=ends)
            short = [f"{(found.columns['gap'][n] - rest) * 1e6:.2f}" for n in (0, -1)]
            rows.append([f"{name}, {temperature - celsius(0.0):.0f} °C", *short])
    return grid(["cavity", *head], rows)


def refilling_table() -> str:
    """Time in which a cavity of 0.95 of the face fills while the spool rests at the stop.

    ``3 eta R^2 (h - h_b)/(h^3 dp) x^2 (1 - 2 ln x)``, cavitated at h_b = 6 um.
    """
    injector = open_scene("fuel-injector").scene
    rim, gap, begun, x = injector.interface.rim_radius, injector.valve.stop.gap, 6e-6, 0.95
    rows = []
    for temperature in injector.study.temperatures:
        viscosity = injector.interface.meniscus.liquid.at(temperature).viscosity
        times = [
            3.0
            * viscosity
            * rim**2
            * (gap - begun)
            / (gap**3 * drop)
            * x
            * x
            * (1.0 - 2.0 * math.log(x))
            for drop in (101325.0, 1e6)
        ]
        degrees = f"{temperature - celsius(0.0):.0f} °C"
        rows.append([degrees, f"{viscosity:.3g}", *(f"{time * 1e3:.3g}" for time in times)])
    head = ["oil at", "viscosity [Pa·s]", "vapour [ms]", "10 bar [ms]"]
    return grid(head, rows)
