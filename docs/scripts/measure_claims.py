"""Measure what statements of chapter 2 of the source come to: blocks of docs/errata.md.

``python docs/scripts/measure_claims.py`` prints them, ``--write`` puts them into the page; a few
minutes. Five structures of two layers on a substrate of 100 GPa; the surface of the source (rms
1 nm, correlation length 0.5 um) on 256 x 256 pixels, eight to its shortest wave; mean of two
surfaces, on windows of 5 um, and of 1.25 um where it is to yield.

Not a study of `contactkit.benchmarks.table`: it compares structures at one setting, so that it has
neither settings to refine nor a reference, and what it finds is physics, not an error of a solver.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping
from statistics import mean

from measured_blocks import measure
from validation_tables import grid

import contactkit as ck
from contactkit.reference import hertz

MODULUS, NM = 100e9, 1e-9
N, SHORTEST, SEEDS = 256, 8.0, (1, 2)  # pixels, pixels per shortest wave
WIDE, NARROW = 5e-6, 1.25e-6  # windows [m]
STRUCTURES = {  # moduli of the two layers over that of the substrate
    "I": (1.0, 1.0),
    "II": (0.5, 0.5),
    "III": (2.0, 2.0),
    "IV": (1.0, 0.5),
    "V": (1.0, 2.0),
}
ACCURACY = ck.Accuracy(grid=N)


def _body(ratios: tuple[float, float], thickness: float, seed: int, width: float) -> ck.Body:
    def material(ratio: float) -> ck.Material:
        return ck.Material(young_modulus=ratio * MODULUS, poisson_ratio=0.3)

    layers = tuple(ck.Layer(material=material(ratio), thickness=thickness) for ratio in ratios)
    rough = ck.GaussianRoughness(
        rms=1.0 * NM, correlation_length=0.5e-6, cutoff=SHORTEST * width / N, seed=seed
    )
    return ck.Body(surface=rough, solid=ck.Stack(layers=layers, substrate=material(1.0)))


def _solved(
    ratios: tuple[float, float],
    thickness: float,
    seed: int,
    pressure: float,
    *effects: object,
    width: float = WIDE,
) -> Mapping[str, float]:
    """Numbers of one contact at a mean pressure over the modulus of the substrate."""
    water = ck.Meniscus(
        liquid=ck.Liquid(name="water", surface_tension=0.07275),
        contact_angle_lower=1.0471975511965976,
        contact_angle_upper=1.0471975511965976,
    )
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=_body(ratios, thickness, seed, width), upper=ck.Flat(), meniscus=water
        ),
        window=ck.Window(width=width),
        loading=ck.Pressing(pressure=pressure * MODULUS),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    with warnings.catch_warnings():  # one meniscus force is as published, the layers are thin
        warnings.simplefilter("ignore", ck.ValidityWarning)
        result = ck.solve(ck.plan(scene, ACCURACY))
    return {name: value for name, (value, _) in result.scalars().items()}


def layers_table() -> str:
    """Pressure, stresses with and without friction and force of the film, over structure I."""
    film, stress = ck.FilmMeniscus(film_thickness=1.0 * NM), ck.SubsurfaceStress()
    friction = ck.FrictionTraction(coefficient=0.5)
    rows = []
    for height in (10.0, 1.0):
        found = {
            name: [
                {
                    "smooth": _solved(ratios, height * NM, seed, 4e-6, film, stress),
                    "rubbed": _solved(ratios, height * NM, seed, 4e-6, friction, stress),
                }
                for seed in SEEDS
            ]
            for name, ratios in STRUCTURES.items()
        }
        for name, runs in found.items():
            cells = [f"{name}, h = {height:g} rms"]
            for which, number in (
                ("smooth", "max_pressure"),
                ("smooth", "contact_area"),
                ("smooth", "max_von_mises"),
                ("smooth", "max_tension"),
                ("rubbed", "max_von_mises"),
                ("rubbed", "max_tension"),
                ("smooth", "meniscus_force"),
            ):
                pairs = zip(runs, found["I"], strict=True)
                ratio = mean(one[which][number] / ref[which][number] for one, ref in pairs)
                cells.append(f"{ratio:.3f}")
            rows.append(cells)
    head = (
        "structure",
        "maximum pressure",
        "contact area",
        "von Mises, mu = 0",
        "tension, mu = 0",
        "von Mises, mu = 0.5",
        "tension, mu = 0.5",
        "film force",
    )
    return grid(head, rows)


def yield_table() -> str:
    """Maximum displacement of a homogeneous body beyond the onset of plastic flow."""
    bound = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=0.05 * MODULUS))
    rows = []
    for pressure in (1e-4, 1e-3, 2e-3, 4e-3, 8e-3):
        runs = [
            _solved((1.0, 1.0), 10.0 * NM, seed, pressure, bound, width=NARROW) for seed in SEEDS
        ]
        rows.append(
            (
                f"{pressure:g}",
                f"{mean(run['max_pressure'] for run in runs) / (0.05 * MODULUS):.3f}",
                f"{100.0 * mean(run['plastic_area'] for run in runs) / NARROW**2:.3f}",
                f"{mean(run['max_displacement'] for run in runs) / NM:.2f}",
            )
        )
    head = ("p/E3", "maximum pressure/H", "plastic area [%]", "maximum displacement [nm]")
    return grid(head, rows)


def hertz_table() -> str:
    """Hertz pressure of the sphere of Fig. 2.3, with the printed radius and a thousand times it."""
    rows = []
    for radius in (13.7e-6, 13.7e-3):
        modulus = 2.0 * 79.2e9 * 1.3 / (1.0 - 0.3**2)  # of G2 and Poisson's ratio 0.3, rigid sphere
        contact = hertz.sphere(load=14.7, radius=radius, modulus=modulus)
        rows.append(
            (
                f"{radius * 1e3:g}",
                f"{contact.contact_radius * 1e6:.1f}",
                f"{contact.peak_pressure / 1e9:.2f}",
            )
        )
    return grid(("R [mm]", "contact radius [um]", "Hertz pressure [GPa]"), rows)


if __name__ == "__main__":
    tables = {"hertz": hertz_table, "yield": yield_table, "layers": layers_table}
    sys.exit(measure(tables, "claims "))
