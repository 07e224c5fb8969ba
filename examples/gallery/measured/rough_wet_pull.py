"""A rough soft sphere pressed on a film, left at rest and pulled off: contact, film and void."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import deforming
from contactkit.plot import gallery as plot

PAGE = Page(
    name="rough-wet-pull",
    title="A rough, soft sphere on a film: pressed, left alone, pulled off",
    claim="Roughness, film, cavities, contact and deformation act together: without a film as "
    "in a dry contact; with one the suction of a pull presses the asperities harder "
    "before it opens them.",
    verdict="Met: forces of a pull are those of a program that shares no code, within its error; "
    "after a long rest pressures are those of the contact solver. The contact force grows "
    "while the net force is already a pull. No measurement of such a cycle could be "
    "found.",
    choices="R = 5 mm, four wavelengths with an rms of 0.1 um on a square of 0.57 mm flooded at "
    "its edges, E* = 0.354 MPa, 0.1 Pa.s, h = 1 um, 10 um/s: beta = 1. Cycle: 0.2 um rms, "
    "a third of the wavelengths, 30 uN for 3000 s, asperities at 0.2 um, cavities from a "
    "tension of 1.5 kPa.",
    grid="33 x 33 and 65 x 65 cells; errors fall by the square of the cell",
    seeds="phases by a linear congruence from 7",
)
R, GAP, VISCOSITY, SPEED, MODULUS, HALF = 5e-3, 1e-6, 0.1, 1e-5, 353553.39059327386, 2.8284271e-4
# Pull at three times [s] [N] by the first program, on 32 to 128 cells extrapolated; error 2e-4.
TIMES, DRAFTED = (0.05, 0.1, 0.2), (5.682422970371682e-05, 9.348051092e-05, 1.3471438853780e-04)
LOAD, REST, CUTOFF, TENSION = 3e-5, 3e3, 2e-7, 1.5e3
RMS, FINER = 2e-7, 3  # of the cycle: waves shorter than its contact
INSTANTS = 5


def _heights(n: int, rms: float = 1e-7, finer: int = 1) -> Any:
    """Waves of four lengths in eight directions, as the first program has them, or finer [m]."""
    side = 2.0 * HALF
    x = (np.arange(n) - n // 2) * side / n
    state, total, variance = 7, np.zeros((n, n)), 0.0
    for k in range(1, 5):
        for d in range(4):
            state = (1103515245 * state + 12345) % 2**31
            turn = math.pi * (d + (0.5 if k % 2 else 0.0)) / 4.0
            size = k**-1.8
            variance += 0.5 * size**2
            along = math.cos(turn) * x[None, :] + math.sin(turn) * x[:, None]
            total += size * np.cos(2.0 * math.pi * (finer * k / side * along + state / 2**31))
    return -rms / math.sqrt(variance) * total


def _scene(heights: Any, loading: Any, *effects: Any) -> Any:
    n = len(heights)
    rough = ck.Heights(heights=heights, pixel_size=2.0 * HALF / n)
    gel = ck.Material(young_modulus=0.75 * MODULUS, poisson_ratio=0.5)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(solid=gel),
            upper=ck.CombinedSurface(parts=(ck.Paraboloid(radius=R), rough)),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=VISCOSITY)),
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


def _run(scene: Any, **given: Any) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # two grids tell the error here
        return ck.simulate(ck.plan(scene), **given)


def _cycle(n: int) -> Any:
    loading = ck.PressAndPull(press=LOAD, rest=REST, speed=SPEED, initial_gap=GAP, final_gap=5e-6)
    limit = ck.TensionLimit(strength=TENSION, cavity_pressure=101_325.0 - TENSION)
    heights = _heights(n, RMS, FINER)
    return _run(_scene(heights, loading, ck.SolidContact(cutoff=CUTOFF), limit), fields_at=(REST,))


def compute(draft: bool = False) -> dict[str, Any]:
    """Forces of a pull on two grids; a cycle with its sections and maps, and its dry contact."""
    sizes = (17, 33) if draft else (33, 65)
    pull = ck.ImposedSpeed(speed=SPEED, initial_gap=GAP, final_gap=GAP + 0.2 * SPEED)
    data: dict[str, Any] = {}
    for name, n in zip(("coarse", "fine"), sizes, strict=True):
        found = _run(_scene(_heights(n), pull), fields_at=TIMES)
        places = [found["time"].tolist().index(time) for time in TIMES]
        data[f"pull_{name}"] = found["pull"][places]
    found = _cycle(sizes[-1])
    columns = ("time", "gap", "pull", "film_force", "contact_force", "void_volume", "contact_area")
    data |= {name: found[name] for name in columns}
    names = ("energy_error", "liquid_error", "pull_off_force")
    data |= {name: np.array([found.numbers[name]]) for name in names}
    data |= _pictures(found)
    data["wet_solid"] = found.maps(REST).solid_pressure
    dry = ck.ContactScene(
        interface=ck.Interface(
            lower=found.plan.scene.interface.lower, upper=found.plan.scene.interface.upper
        ),
        window=ck.Window(periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(ck.HalfSpace(),),
    )
    data["dry_solid"] = ck.solve(ck.plan(dry)).pressure
    return data


def _pictures(found: Any) -> dict[str, Any]:
    """Sections at five instants of the pull, and the map where void and contact are beside."""
    end = float(found["time"][found["void_volume"].argmax()])
    times = np.linspace(REST, end, INSTANTS)
    parts = [found.section(float(time)) for time in times]
    shown = found.maps(deforming.telling_time(found))
    return {
        "section_x": parts[0].radius,
        "section_gap": np.array([one.gap for one in parts]),
        "section_time": np.array([one.time - REST for one in parts]),
        "regions": deforming.regions_of(shown).filled(0),
        "map_x": shown.x,
        "map_y": shown.y,
        "map_time": np.array([shown.time - REST]),
    }


def draw(data: Data) -> plot.Figure:
    """Loop of the forces, sections of the gap, map of contact, film and void."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    gap = data["gap"] * 1e6
    names = {"pull": "pull", "film_force": "film", "contact_force": "contact"}
    for i, (name, label) in enumerate(names.items()):
        left.plot(gap, data[name] * 1e6, **plot.series(i, marker=""), label=label)
    left.fill(np.append(gap, [gap[-1], gap[0]]), np.append(data["pull"] * 1e6, [0.0, 0.0]), "0.93")
    left.axhline(0.0, color="0.7", lw=0.8)
    left.set(xlabel="gap of the undeformed bodies [µm]", ylabel="force [µN]")
    left.legend(fontsize=8)
    times = data["section_time"]
    for k, time in enumerate(times):
        grey = str(0.75 * (1.0 - k / (len(times) - 1)))
        label = f"{1e3 * time:.0f} ms"
        middle.plot(data["section_x"] * 1e6, data["section_gap"][k] * 1e6, color=grey, label=label)
    middle.axhline(CUTOFF * 1e6, color="0.6", lw=0.8, ls=":")
    middle.set(xlabel="x through the axis [µm]", ylabel="gap [µm]", xlim=(-200, 200), ylim=(0, 4))
    middle.legend(fontsize=8, title="after the rest")
    deforming.draw_regions(right, data["regions"], data["map_x"] * 1e6, data["map_y"] * 1e6)
    right.set(xlabel="x [µm]", ylabel="y [µm]")
    later = f"{1e3 * float(data['map_time'][0]):.0f} ms after the rest"
    plot.letters((left, middle, right), ("loop", "section", later))
    return figure


def _extrapolated(data: Data) -> Any:
    coarse, fine = data["pull_coarse"], data["pull_fine"]
    return fine + (fine - coarse) / 3.0


def check(data: Data) -> list[Check]:
    """First program, dry contact, contact under suction, conservation."""
    off = _extrapolated(data) / np.array(DRAFTED) - 1.0
    contact, pull, time = data["contact_force"], data["pull"], data["time"]
    rested = int(np.abs(time - REST).argmin())
    dry, wet = data["dry_solid"], data["wet_solid"]
    differ = float(np.abs(wet - dry).max() / dry.max())
    most = int(contact.argmax())
    return [
        Check(
            "forces of a pull from rest are those of the first program to 0.5 %",
            bool(np.abs(off).max() < 5e-3),
            ", ".join(f"{100 * one:+.2f}" for one in off) + " %",
        ),
        Check(
            "after the rest pressures are those of the dry contact solver to 1 % of the largest",
            differ < 1e-2 and 0.02 < float((dry > 0.0).mean()) < 0.5,
            f"{100 * differ:.2g} %, on {100 * float((dry > 0.0).mean()):.1f} % of the face",
        ),
        Check(
            "the pull presses the asperities by 3 % harder at least, when it exceeds the load",
            bool(contact[most] > 1.03 * contact[rested] and pull[most] > -LOAD),
            f"{1e6 * contact[rested]:.2f} to {1e6 * contact[most]:.2f} µN",
        ),
        Check(
            "contact and void are there at once",
            bool((data["void_volume"] * data["contact_area"]).any()),
            f"void of {1e18 * float(data['void_volume'].max()):.0f} µm³ at most",
        ),
        Check(
            "energies balance to 1 % over the cycle, liquid to 1e-12",
            bool(data["energy_error"][0] < 1e-2 and data["liquid_error"][0] < 1e-12),
            f"{100 * float(data['energy_error'][0]):.2f} %, {float(data['liquid_error'][0]):.0e}",
        ),
    ]


def table(data: Data) -> Table:
    """Pull from rest at three times."""
    found = _extrapolated(data)
    rows = [
        (time, *(1e6 * float(one) for one in values))
        for time, *values in zip(
            TIMES, data["pull_coarse"], data["pull_fine"], found, DRAFTED, strict=True
        )
    ]
    head = ("time [s]", "coarse [µN]", "fine [µN]", "extrapolated [µN]", "first program [µN]")
    return Table(head, rows)


if __name__ == "__main__":
    run_page(__file__)
