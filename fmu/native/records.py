"""Records in the file of a native FMU: films as tables, rough faces as curves."""

from __future__ import annotations

import sys
from enum import IntEnum
from typing import ClassVar

from attrs import frozen

from .record import (
    Real,
    Record,
    column,
    flag,
    maybe,
    member_of,
    non_negative,
    part,
    positive,
    real,
    several,
    whole,
)

__all__ = [
    "Bodies",
    "Cells",
    "Curve",
    "Faces",
    "Film",
    "FilmTables",
    "Grid",
    "Law",
    "LiquidTable",
    "Matrix",
    "Onset",
    "Piece",
    "PocketSides",
    "PowerCurve",
    "Rate",
    "Ratio",
    "Rheology",
    "RingCavity",
    "Rings",
    "Scale",
    "Scaling",
    "Series",
    "Sides",
    "Stretch",
    "Table",
    "Unloading",
]


class Scale(IntEnum):
    """Parameter that a force is proportional to."""

    FIXED = 0
    SURFACE_TENSION = 1
    VISCOSITY = 2


class Rate(IntEnum):
    """Dependence of a force on the speed; limits of the liquid bound the last one."""

    AT_REST = 0
    PER_SPEED = 1
    LIQUID = 2


@frozen(kw_only=True)
class Piece(Record):
    """A stretch of a table: y over x, quintic Hermite, where y stands for f h^power."""

    low: float = positive("gap at which it begins [m]")
    high: float = positive("gap at which it ends [m]")
    folds: bool = flag("whether x is sqrt(ln(high/h)), not ln h: the slope has no bound there")
    power: int = whole("of the fall that is taken away [-]", 0, 8)
    x: tuple[float, ...] = column("place of a node [-]", ascends=True)
    y: tuple[float, ...] = column("value there")
    slope: tuple[float, ...] = column("dy/dx")
    curve: tuple[float, ...] = column("d2y/dx2")
    derived: ClassVar[tuple[str, ...]] = (
        "double log_end; /* ln(high), where it folds */",
        "const struct ck_cell *cells; /* between the nodes */",
        "int *hint; /* where the last search ended; it saves time and changes nothing */",
    )


@frozen(kw_only=True)
class Table(Record):
    """A function of the gap, of pieces that follow each other; beyond them y stays."""

    stays: bool = flag("whether beyond the last piece the function itself stays")
    pieces: tuple[Piece, ...] = several(Piece, "in the order of their gaps", most=12, least=1)
    checked: ClassVar[bool] = True


@frozen(kw_only=True)
class Law(Record):
    """A force of a film or of its solids, over the parameter it is proportional to.

    What it is at rest [N], or what it is per speed [N.s/m].
    """

    scale: Scale = member_of(Scale, "that parameter")
    rate: Rate = member_of(Rate, "what of it")
    needs_film: bool = flag("whether it ends where the film breaks")
    end: float = positive("gap beyond which there is none [m]")
    release: float = positive("gap at which solids pull off [m]")
    recontact: float = non_negative("gap at which they touch again [m]")
    kinks: tuple[float, ...] = several(Real(0.0), "gaps at which its slope jumps [m]", most=8)
    table: Table = part(Table, "force")


class Scaling(IntEnum):
    """Argument of a rheology where the viscosity at rest is another one: none, speed, stress."""

    NONE = 0
    SPEED = 1
    STRESS = 2


@frozen(kw_only=True)
class Ratio(Record):
    """Logarithm of a ratio of forces over ln h and a speed: quintic splines of even spacing."""

    unit: Table = part(Table, "logarithm of one over the speed that is a unit [m/s], over the gap")
    has_pole: bool = flag("whether that speed is the fastest: r stands for r/(1 - r)")
    fade: float = non_negative("power of the speed that it falls with towards rest [-]")
    end: float = real("logarithm of the fastest speed")
    first_gap: float = real("ln h of the first node")
    per_gap: float = positive("nodes in a unit of ln h")
    gaps: int = whole("of coefficients over ln h, four more than nodes", 10, 1000)
    first_speed: float = real("logarithm of the slowest speed")
    per_speed: float = positive("nodes in a unit of the logarithm of the speed")
    speeds: int = whole("of coefficients over that, four more than nodes", 10, 10_000)
    coefficient: tuple[float, ...] = column("coefficients of the splines, those of a gap together")
    checked: ClassVar[bool] = True


@frozen(kw_only=True)
class Stretch(Record):
    """Ratios of the force of a film between gaps at which it has a kink."""

    high: float = positive("gap at which it ends [m]")
    opening: Ratio = part(Ratio, "force over that at the viscosity at rest")
    closing: Ratio | None = maybe(Ratio, "the same while it closes, if that is not the same")
    cavity: Ratio | None = maybe(Ratio, "truncated over full force, from inception on")


@frozen(kw_only=True)
class Rheology(Record):
    """A film whose viscosity follows pressure and shear, over one of the viscosity at rest."""

    scaling: Scaling = member_of(Scaling, "what it is a function of")
    viscosity: float = positive("viscosity at rest that it was made of [Pa.s]")
    stretches: tuple[Stretch, ...] = several(Stretch, "in the order of their gaps", most=4, least=1)


@frozen(kw_only=True)
class Film(Record):
    """A film: its forces, and how far it reaches."""

    end: float = positive("gap at which its laws end [m]")
    breaks: float = positive("gap at which a rule breaks it [m]")
    full_gap: float = real("gap up to which it is full to the rim [m]")
    laws: tuple[Law, ...] = several(Law, "its forces", most=8, least=1)
    shape: Table = part(Table, "square of the radius between flats, height less gap under a sphere")
    rim_square: float = non_negative("square of the rim for a cavity [m2]; 0: it can have none")
    volume: float = non_negative("volume for a cavity [m3]")
    rheology: Rheology | None = maybe(Rheology, "of a liquid that is not Newtonian")


@frozen(kw_only=True)
class Cells(Record):
    """Cells of a film on a grid, in the order in which they are eliminated; a pocket is one."""

    area: tuple[float, ...] = column("area [m2]")
    relief: tuple[float, ...] = column("gap beside the shortest distance of the faces [m]")
    extra: tuple[float, ...] = column("volume that a pocket has besides its gap [m3]")
    rim: tuple[float, ...] = column("conductance to the rim over h^3/(12 eta) [-]")
    excess: tuple[float, ...] = column("fraction of its source beyond the flux there [-]")


@frozen(kw_only=True)
class Sides(Record):
    """Sides between two cells of film, by their numbers from 0."""

    one: tuple[float, ...] = column("a cell")
    other: tuple[float, ...] = column("the other cell")
    geometry: tuple[float, ...] = column("width over the distance of the centres [-]")


@frozen(kw_only=True)
class PocketSides(Record):
    """Sides between a cell of film and a pocket, where the gap of the cell counts."""

    cell: tuple[float, ...] = column("the cell of film")
    pocket: tuple[float, ...] = column("the pocket")
    geometry: tuple[float, ...] = column("conductance over h^3/(12 eta) [-]")
    excess: tuple[float, ...] = column("fraction of its source beyond the flux there [-]")


@frozen(kw_only=True)
class Onset(Record):
    """Highest tension of a full film over its force: straight lines, constant beyond them."""

    depth: float = real("what is added to the gap before its logarithm is taken [m]")
    place: tuple[float, ...] = column("ln of a gap and that", ascends=True)
    ratio: tuple[float, ...] = column("ln of its highest tension over its force, times 1 m2")


@frozen(kw_only=True)
class Grid(Record):
    """A film that cavitates on a face that is no disc: finite volumes, and where it begins."""

    rtol: float = real("error of the force that the grid leaves [-]", sys.float_info.min, 1.0)
    onset: Onset = part(Onset, "its highest tension while it is full")
    cells: Cells = part(Cells, "its cells")
    sides: Sides = part(Sides, "between them")
    pockets: PocketSides | None = maybe(PocketSides, "sides to sealed holes")


@frozen(kw_only=True)
class FilmTables(Record):
    """The film of a scene, and what is left of it after a rupture."""

    is_sphere: bool = flag("whether one body is a sphere")
    sphere_radius: float = positive("its radius [m]")
    menisci: float = positive("number of equal menisci [-]")
    reynolds: bool = flag("whether cavities begin where the pressure has its minimum")
    rewetting: float = real("fraction of the volume that is there after a rupture [-]", 0.0, 1.0)
    films: tuple[Film, ...] = several(Film, "as given, and re-wetted", most=2, least=1)
    grid: Grid | None = maybe(Grid, "of a film that cavitates on a face that is no disc")


@frozen(kw_only=True)
class LiquidTable(Record):
    """Logarithms of the properties of a liquid at equally spaced temperatures; 0 if it has none."""

    low: float = positive("lowest temperature [K]")
    high: float = positive("highest temperature [K]")
    viscosity: tuple[float, ...] = column("ln of the viscosity over 1 Pa.s")
    surface_tension: tuple[float, ...] = column("ln of the surface tension over 1 N/m")
    checked: ClassVar[bool] = True


@frozen(kw_only=True)
class Curve(Record):
    """A function as a cubic between nodes, which keeps the order of its values."""

    x: tuple[float, ...] = column("place of a node", ascends=True)
    y: tuple[float, ...] = column("value there")
    slope: tuple[float, ...] = column("dy/dx")


@frozen(kw_only=True)
class PowerCurve(Record):
    """A function as a curve of its logarithm over that of x: a power law before its first node."""

    begin: float = positive("first x")
    end: float = positive("last x")
    low: float = positive("value at the first x")
    high: float = positive("value at the last x")
    log: Curve = part(Curve, "ln y over ln x")


@frozen(kw_only=True)
class Unloading(Record):
    """Unloading of rough faces from a maximum approach, over the fraction of its length."""

    end: float = positive("maximum approach [m]")
    force: PowerCurve = part(PowerCurve, "force over that at the maximum approach [-]")
    area: PowerCurve = part(PowerCurve, "area of contact over that there [-]")


@frozen(kw_only=True)
class Faces(Record):
    """Rough faces that are pressed against each other: loading, unloading, losses."""

    limit: float = non_negative("approach up to which all is reversible [m]")
    first: PowerCurve = part(PowerCurve, "force of loading [N] over the approach [m]")
    area: PowerCurve = part(PowerCurve, "area of contact of loading [m2] over the approach [m]")
    plastic: Curve = part(Curve, "area that has yielded [m2] over the maximum approach [m]")
    residual: Curve | None = maybe(Curve, "approach left [m] over the maximum approach [m]")
    dissipated: Curve | None = maybe(Curve, "work dissipated [J] over the maximum approach [m]")
    unloading: tuple[Unloading, ...] = several(
        Unloading, "in the order of their ends; there are losses where there is one", most=64
    )
    checked: ClassVar[bool] = True


@frozen(kw_only=True)
class Series(Record):
    """A film of rigid bodies, in series with the spring that stands for the deforming ones."""

    damping: Table = part(Table, "damping over the viscosity [m]")


@frozen(kw_only=True)
class Matrix(Record):
    """A square matrix, by its rows."""

    entry: tuple[float, ...] = column("a coefficient")


@frozen(kw_only=True)
class RingCavity(Record):
    """Cavities of a film on rings, by the unit of its pressures."""

    tension: float = positive("of a cavity, ambient less its pressure [-]")
    strength: float = positive("tension at which the whole film ruptures [-]")


@frozen(kw_only=True)
class Rings(Record):
    """A film on rings and the displacement under it, by units of radii, gaps and pressures."""

    width: float = positive("unit of radii [m]")
    pressure: float = positive("unit of pressures [Pa]")
    radius: tuple[float, ...] = column("radius of a node [-]", ascends=True)
    relief: tuple[float, ...] = column("gap of the undeformed bodies less that on the axis [-]")
    area: tuple[float, ...] = column("integral of its hat times the radius [-]")
    compliance: Matrix = part(Matrix, "displacement at a node by the pressure at another [-]")
    cavity: RingCavity | None = maybe(RingCavity, "of a film that ruptures")


@frozen(kw_only=True)
class Bodies(Record):
    """Bodies that a film deforms, as a spring in series with it, or with the film on rings."""

    gap: float = positive("gap of the undeformed bodies that units are of [m]")
    stiffness: float = positive("of the spring at that gap [N/m]")
    widens: bool = flag("whether it grows as the root of the gap, as under a sphere")
    ratio: float = positive("displacement over the gap by the film, over that of the spring [-]")
    series: Series | None = maybe(Series, "the spring alone")
    rings: Rings | None = maybe(Rings, "the film on rings")
