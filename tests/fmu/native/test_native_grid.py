"""A film on a grid in C against the finite volumes of Python: force, slopes, liquid, tables."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import ClassVar

import attrs
import numpy as np
import pytest
from native_scenes import HAS_CC, OIL, PAD, RING, compile_c, scene, write_sources

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck
from contactkit.fmu.native import grid as native_grid
from contactkit.fmu.native.data import contents_of, data_file
from contactkit.fmu.native.film import FINE, moving, prepared_film
from contactkit.fmu.native.sources import layout
from contactkit.fmu.slaves.stiction_mass import PORTS
from contactkit.scene.column import Column
from contactkit.separation.effects.base import ForceLaw, SeparationForce
from contactkit.separation.face.held_voids import HeldVoids
from contactkit.separation.plan import plan

pytestmark = pytest.mark.slow

DROP = 1e5
COARSE = attrs.evolve(FINE, film_rtol=3e-2)
HOLE = ck.Disc(radius=4e-4, centre=(8e-4, 2e-4))
SQUARE = ck.Rectangle(length=4e-3, width=3e-3)
FACES = {
    "ring": RING,
    "tilted": PAD,
    "sealed": ck.Flat(planform=SQUARE, holes=(ck.SealedHole(shape=HOLE, volume=1e-11),)),
    "recess": ck.Flat(
        planform=SQUARE,
        holes=(ck.Vent(shape=ck.Disc(radius=3e-4, centre=(-1e-3, 0.0))),),
        recesses=(ck.Recess(shape=HOLE, depth=2e-5),),
    ),
}
GAP = 5e-6


@pytest.fixture(scope="module")
def program(shelf):
    def make(folder):
        write_sources(folder)
        files = [path for path in folder.glob("*.c") if not path.name.startswith(("fmi2", "fmi3"))]
        own = Path(__file__).with_name("native_grid.c")
        compile_c([own, *files], folder / "grid", f"-I{folder}")

    return shelf.folder("grid probe", make) / "grid"


@pytest.fixture(scope="module")
def films():
    """Film of a face that cavitates, in Python, and its tables; made once each."""
    made = {}

    def of(name):
        if name not in made:
            limit = ck.TensionLimit(strength=DROP)
            given = scene(
                lower=ck.Flat(),
                upper=FACES[name],
                effects=(ck.ViscousForce(), limit),
                stiffness=0.0,
                gap=GAP,
            )
            given = moving(given, None)
            made[name] = plan(given, COARSE).film.cavity, prepared_film(given, COARSE).tables
        return made[name]

    return of


def asked(program, folder, tables, orders, spoil=None):
    """Numbers that a program answers orders with, line by line; text if it refuses the file."""
    start = {port.name: port.start for port in PORTS}
    numbers = contents_of("stiction-mass", PORTS[:1], start, tables).numbers()
    if spoil is not None:
        spoil(numbers)
    (folder / "film.bin").write_bytes(data_file("g", layout(), numbers))
    words = [str(program), str(folder), str(OIL.viscosity), str(DROP)]
    done = subprocess.run(words, input=orders, capture_output=True, text=True, check=False)
    if done.returncode:
        return done.stdout.strip()
    return [[float(word) for word in line.split()] for line in done.stdout.splitlines()]


def stepped(cavity, gap, end, dt):
    """Liquid of a full film at a gap [m] after a step to another one, in Python."""
    begun = cavity.inception(gap, 0.0)
    return begun, cavity._after(cavity._state(np.array(begun.liquid), gap), gap, end, dt)


@pytest.mark.parametrize("name", FACES)
def test_force_with_voids_and_its_slopes_are_those_of_the_finite_volumes(
    name, program, films, tmp_path
):
    cavity, tables = films(name)
    stages, dt, wide = [5.2e-6, 5.7e-6, 6e-6], 2e-5, 6e-6
    first = f"f {GAP}\ns {GAP} {dt} {stages[0]} {stages[1]} {stages[2]}\nk {wide}\n"
    near, more = wide * 1e-5, 1e-5 * 2e-2
    places = [(wide, 2e-2), (wide, -2e-2), (wide + near, 2e-2), (wide - near, 2e-2)]
    places += [(wide, 2e-2 + more), (wide, 2e-2 - more)]
    lines = "".join(f"h {wide} {gap!r} {speed!r}\n" for gap, speed in places)
    (cells,), found, (void,), at, closing, wider, nearer, faster, slower = asked(
        program, tmp_path, tables, first + lines
    )
    assert cells == len(tables.grid.cells.area)

    begun = cavity.inception(GAP, 0.0)
    known = cavity.stages(begun, (GAP, 0.0), dt, [(gap, 0.0) for gap in stages])
    after = cavity.after_step(begun, known, GAP, stages)
    assert void == pytest.approx(after.void, rel=1e-9)
    assert found[2] == pytest.approx(known.state.void_volume, rel=1e-9)
    assert found[3] == pytest.approx(known.error, rel=1e-6)
    liquid = np.array(after.liquid)
    full = (liquid >= (cavity.grid.relief + wide) * (1.0 - 1e-12)) | ~cavity.grid.face.loaded
    voids = HeldVoids(cavity.grid, cavity._liquid, full)  # without the table of a growing cavity
    for got, speed in ((at, 2e-2), (closing, -2e-2)):
        expected = voids(wide, speed)
        assert got[0] == pytest.approx(expected.force, rel=1e-8)
        assert got[3] == pytest.approx(expected.cavity_area, rel=1e-9)
    assert at[1] == pytest.approx((wider[0] - nearer[0]) / (2.0 * near), rel=1e-5)
    assert at[2] == pytest.approx((faster[0] - slower[0]) / (2.0 * more), rel=1e-5)


@pytest.mark.parametrize("name", FACES)
def test_liquid_is_conserved(name, program, films, tmp_path):
    """What the cells gain has come over the rim: while voids grow, and while they fill."""
    _, tables = films(name)
    orders = f"f {GAP}\n"
    ways = [(5e-6, 8e-6, 3e-5), (8e-6, 7.9e-6, 1e-3), (7.9e-6, 6e-6, 1e-4)]
    for start, end, dt in ways:
        third, two_thirds = start + 0.15 * (end - start), start + 0.65 * (end - start)
        orders += f"s {start} {dt} {third!r} {two_thirds!r} {end}\nk {end}\n"
    said = asked(program, tmp_path, tables, orders)
    volume = sum(tables.grid.cells.area) * GAP
    gains, voids = [line[4:] for line in said[1::2]], [line[0] for line in said[2::2]]
    for gained, inflow in gains:
        assert gained == pytest.approx(inflow, abs=1e-12 * volume)
    assert voids[0] > 0.1 * volume
    assert 0.0 <= voids[2] < voids[1] < voids[0]
    assert max(abs(gained) for gained, _ in gains) > 1e-2 * volume


def places_of(tables):
    """Where the numbers of a grid begin in a file, by name."""
    start = {port.name: port.start for port in PORTS}
    grid = tables.grid
    whole = contents_of("stiction-mass", PORTS[:1], start, tables).numbers()
    # Behind it there are neither faces nor a film of deforming bodies.
    begin = len(whole) - 3 - len(grid.numbers())  # faces, bodies and liquid: none
    assert whole[begin : begin + 1] == [grid.rtol]
    n, m, lines = len(grid.cells.area), len(grid.sides.one), len(grid.onset.place)
    cells = begin + 2 + 1 + 2 * lines
    found = {"rtol": begin, "n": cells} | {
        name: cells + 1 + i * n
        for i, name in enumerate(("area", "relief", "extra", "rim", "excess"))
    }
    sides = cells + 1 + 5 * n
    return found | {"m": sides, "one": sides + 1, "geometry": sides + 1 + 2 * m}


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("one", 0.5),
        ("one", -1.0),
        ("one", 1e6),
        ("area", 0.0),
        ("area", -1e-9),
        ("extra", -1.0),
        ("rim", -1.0),
        ("excess", 9.0),
        ("geometry", 0.0),
        ("geometry", float("nan")),
        ("relief", float("inf")),
        ("rtol", 0.0),
        ("rtol", 2.0),
        ("n", 1.0),
        ("n", 3e4),
        ("m", 7.5),
    ],
)
def test_a_grid_that_makes_no_sense_is_refused(name, value, program, films, tmp_path):
    _, tables = films("ring")

    def spoil(numbers):
        numbers[places_of(tables)[name]] = value

    assert "no sense" in asked(program, tmp_path, tables, "f 5e-6\n", spoil)


def test_a_film_that_no_rim_reaches_is_refused(program, films, tmp_path):
    _, tables = films("ring")
    first = places_of(tables)["rim"]

    def spoil(numbers):
        numbers[first : first + len(tables.grid.cells.area)] = [0.0] * len(tables.grid.cells.area)

    assert "no sense" in asked(program, tmp_path, tables, "f 5e-6\n", spoil)


def test_a_grid_that_is_too_large_is_refused_with_its_cure(films, monkeypatch):
    cavity, _ = films("ring")
    monkeypatch.setattr(native_grid, "MOST_CELLS", 100)
    with pytest.raises(ck.PlanError, match=r"holds 100 cells, this face has 6\d\d .*film_rtol"):
        native_grid.grid_record(cavity, (1e-6, 1e-4))


@attrs.frozen(kw_only=True)
class Stirred(SeparationForce):
    """Force that reads the viscosity, and is not proportional to it."""

    name: ClassVar[str] = "stirred"
    summary: ClassVar[str] = "stirred"
    column: ClassVar[Column] = Column("stirred_force", "N", "stirred")
    needs_film: ClassVar[bool] = False
    sources = ("nobody",)

    def liquid_needs(self, scene):
        return ("viscosity",)

    def prepare(self, prepared):
        return ForceLaw(lambda gap, speed: prepared.liquid.viscosity**2 * speed)


@pytest.mark.parametrize("upper", [RING, ck.Flat(radius=3e-3)], ids=["ring", "disc"])
@pytest.mark.parametrize("limit", [ck.TensionLimit(strength=DROP), ck.ShearLimit(strength=1e5)])
def test_a_viscosity_that_the_tables_fix_goes_with_no_limit(upper, limit):
    if upper is RING and isinstance(limit, ck.ShearLimit):
        pytest.skip("knows discs only")
    effects = (ck.ViscousForce(), limit, Stirred())
    given = scene(lower=ck.Flat(), upper=upper, effects=effects, stiffness=0.0)
    with pytest.raises(ck.PlanError, match=r"Limit has no native form .* the viscosity it reads"):
        prepared_film(moving(given, None), COARSE)
