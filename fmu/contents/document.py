"""The documentation that travels in an FMU: what it is, its variables as a page, the licences."""

from __future__ import annotations

import html
import importlib.metadata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from attrs import field, fields, frozen, has

from ..._version import __version__
from ...errors import ContactkitError
from ...kinds import SEPARATION_EFFECTS
from ...scene.effect import choices
from ...scene.scenes import SeparationScene
from ..framework.ports import Port, Value
from .icon import icon_svg

__all__ = [
    "CONVENTIONS",
    "Page",
    "coupling_note",
    "external_dependencies",
    "index_page",
    "license_text",
]

CONVENTIONS = (
    "All values are in SI units, angles in radians; the unit in the third column is only for "
    "showing. A gap is the distance of the bodies, a speed is positive while it opens the gap; "
    "the sign of each force stands in its description. Times of events are those of the host's "
    "clock, -1 before there was one."
)
_TERMINAL = (
    " The variables that cross the interface are one terminal, flange, in "
    "terminalsAndIcons/terminalsAndIcons.xml."
)

_STEP = "2 sqrt(m/k)"
_NOTES: dict[str, tuple[str, ...]] = {
    "stiction-mass": (
        "The mass is inside, and the film with it: no communication step is too long for them. "
        "Give the pull at the start of a step as F_ext and its rate as dF_ext; then the pull is a "
        "straight line within the step, and the error falls with the square of the step. With "
        "dF_ext left at 0 the pull is held, and the error falls with the step only.",
        f"What is outside still limits the step: a spring or stop of stiffness k to {_STEP}, of "
        "which a tenth is good. Step the tool that pulls first, this FMU last.",
    ),
    "valve-drive": (
        "Set h and v at the start of a step; within it the gap runs on at that speed. F_ext at the "
        "start of the step and dF_ext after it are what a stiction-mass takes, which steps last.",
        f"The stop is stiff: the step must stay below {_STEP} of the mass and k_stop, and a tenth "
        "of that is good. Beyond it an impact on the stop is unstable.",
    ),
    "stiction-force": (
        "The mass is outside. Set h and v at the end of the step to come. A film is a damper c of "
        "5e7 to 3e10 N.s/m: forces exchanged once in a step are stable only below H_stable = m/c, "
        "and beyond it they may look like an answer: a release after one step. Watch in_doubt and "
        "coupling_error, and the log category logCoupling.",
        "Use a master that iterates a step until film and mass agree on the impulse (J, F_mean), "
        "such as contactkit.fmu.master.couple, or take stiction-mass, which has the mass inside "
        "and asks for no small step.",
    ),
    "tip-contact": (
        "Set height, speed and acceleration of the root at the start of a step, and take F_mean, "
        "the mean over it, so that no impulse is lost; a host that cannot repeat its step takes F "
        "at the end of it.",
        "The longest stable step is that of the mass outside on the springs, 2 sqrt(M/(N k)); the "
        "film does not limit it.",
    ),
    "deforming-mass": (
        "The mass is inside, and film and bodies with it: no communication step is too long for "
        "them. Give the pull at the start of a step as F_ext and its rate as dF_ext. h is the gap "
        "of the undeformed bodies, h_axis that of the film.",
        f"What is outside still limits the step: a spring of stiffness k to {_STEP}, of which a "
        "tenth is good.",
    ),
    "deforming-force": (
        "The mass is outside. Set h and v at the end of the step to come: within it the undeformed "
        "bodies move along the parabola that ends so. c and k are the derivatives of F by v and h "
        "over the last step, for a master that solves the coupling by Newton's method; they are "
        "its directional derivatives, too.",
        "Forces exchanged once in a step are stable below m/c with the mass m outside. As the "
        "bodies give way, c falls with the step, from the damping of the film to the stiffness of "
        "the bodies times the step.",
    ),
    "contact-stop": (
        "The force follows the inputs at once. As for any stiff spring the step must stay below "
        f"{_STEP} of the mass outside and the stiffness k that the FMU gives; a tenth is good.",
    ),
}
_EARLY: dict[str, tuple[str, ...]] = {
    "stiction-mass": (
        "A host that uses event mode and allows early return is handed the step back where the "
        "film breaks; t_break holds that time for all others.",
    ),
    "valve-drive": (
        "A host that uses event mode and allows early return is handed the step back where the "
        "voltage switches.",
    ),
}
_ANY = ("A host may step it with any step it accepts, and go back to a saved state.",)


def coupling_note(name: str, fmi: str = "2") -> tuple[str, ...]:
    """Paragraphs on how to step an FMU with the rest of a system.

    Parameters
    ----------
    name : str
        Name of the FMU.
    fmi : {"2", "3"}
        Version of FMI.

    Examples
    --------
    >>> [len(coupling_note(name)) for name in ("stiction-mass", "another")]
    [2, 1]
    """
    return _NOTES.get(name, _ANY) + (_EARLY.get(name, ()) if fmi == "3" else ())


_STYLE = (
    "body{font:15px sans-serif;margin:2em;max-width:70em}table{border-collapse:collapse}"
    "th,td{border:1px solid #bbb;padding:.3em .6em;text-align:left;vertical-align:top}"
    "svg{float:right;margin:0 0 1em 1em}h2{margin-top:1.6em}"
)
_HEAD = (
    "name",
    "unit",
    "shown in",
    "causality",
    "group",
    "type",
    "start",
    "allowed",
    "description",
)
_PYTHON = (
    "It is run by a Python interpreter on the host computer (3.11 or later), which besides the "
    "files in this FMU needs: {}. A host that is no Python itself has to find a shared library "
    "of Python; see docs/fmu.md of contactkit."
)
_NATIVE = (
    "A C library that needs nothing else. Its sources are in sources/; resources/film.bin holds "
    "the forces as tables over the gap."
)
_WRONG = (
    "Parameters are set before initialization ends. A value that is out of range is refused: "
    "the message in category logStatusError says why, and steps are refused until the FMU is "
    "reset or set back to an earlier state. Outputs keep their last good values. Nothing is ever "
    "nan."
)


@frozen(kw_only=True)
class Page:
    """Contents of the page of an FMU.

    Attributes
    ----------
    name : str
        Of the FMU, such as ``stiction-mass``.
    title, summary : str
        Head line, and what the FMU is.
    ports : sequence of Port
        Its variables.
    start : mapping
        Their start values.
    fmi : {"2", "3"}
        Version of FMI.
    needs : str
        What the host must have, in sentences.
    scene : SeparationScene, optional
        What the FMU was made from, if it was made from a scene.
    """

    name: str
    title: str
    summary: str
    ports: Sequence[Port] = field(repr=False)
    start: Mapping[str, Value] = field(repr=False)
    fmi: str = "2"
    needs: str
    scene: SeparationScene | None = field(default=None, repr=False)

    @classmethod
    def of_python(cls, requires: Iterable[str], **about: Any) -> Page:
        """Page of an FMU that Python runs, with the packages it wants beside its own files."""
        return cls(needs=_PYTHON.format(", ".join(sorted(requires)) or "nothing else"), **about)

    @classmethod
    def of_native(cls, **about: Any) -> Page:
        """Page of an FMU in C."""
        return cls(needs=_NATIVE, **about)


def index_page(about: Page) -> str:
    """HTML page of an FMU: conventions, variables, scene, stepping, sources."""
    title = html.escape(about.title)
    variables = [_cells(port, about.start[port.name]) for port in about.ports]
    parts = [
        f"<h1>{title}</h1>",
        _text(about.summary),
        _text(f"FMI {about.fmi}.0 for co-simulation, written by contactkit {__version__}."),
        _text(about.needs),
        "<h2>Conventions</h2>",
        _text(CONVENTIONS + (_TERMINAL if about.fmi == "3" else "")),
        "<h2>Variables</h2>",
        _table(_HEAD, variables),
        "<h2>How to couple it</h2>",
        *map(_text, coupling_note(about.name, about.fmi)),
        "<h2>When something is wrong</h2>",
        _text(_WRONG),
        *(_scene(about.scene) if about.scene is not None else ()),
        "<h2>How to cite</h2>",
        _text(_cite(about)),
    ]
    body = "\n".join(parts)
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{title}</title><style>{_STYLE}</style></head>
<body>
{icon_svg()}
{body}
</body>
</html>
"""


def external_dependencies(requires: Iterable[str], sometimes: Iterable[str] = ()) -> str:
    """Text of ``documentation/externalDependencies.txt`` of an FMU that Python runs.

    Examples
    --------
    >>> print(external_dependencies(["numpy"]).splitlines()[2])
    - the Python packages: numpy
    """
    packages = ", ".join(sorted(requires)) or "none beside the standard library and this FMU"
    more = ", ".join(sorted(sometimes))
    return (
        "This FMU needs on the host computer:\n"
        "- Python 3.11 or later, with its shared library (python3.dll on Windows)\n"
        f"- the Python packages: {packages}\n"
        + (f"- for a liquid on anything but two flats also: {more}\n" if more else "")
        + "- on Linux glibc 2.32 or later; in a host that is no Python the FMU looks for the\n"
        "  shared library of Python itself if it was built where a C compiler is (another one may\n"
        "  be named in CONTACTKIT_LIBPYTHON); else load it first, for instance by\n"
        "  LD_PRELOAD=libpython3.11.so.1.0\n"
    )


def _scene(scene: SeparationScene) -> Iterator[str]:
    """What the FMU was made from, and what is left out."""
    yield "<h2>The scene</h2>"
    yield _text(f"Made from {scene.name or 'the start values above'}. What acts:")
    yield _list(choices(effect) for effect in scene.effects)
    yield _text("What is left out:")
    has_it = {type(effect) for effect in scene.effects}
    yield _list(kind.summary for kind in SEPARATION_EFFECTS if kind not in has_it)
    yield _text("Between which bodies, and with which liquid:")
    yield _table(("what", "value", "unit"), _rows(scene.interface))
    yield "<h2>Sources of the equations</h2>"
    yield _list(f"{e.name}: {source}" for e in scene.effects for source in e.cites(scene))


def _rows(part: Any, place: str = "") -> Iterator[tuple[str, str, str]]:
    """Name, value and unit of every field of a scene object and of those in it."""
    for one in fields(type(part)):
        value, name = getattr(part, one.name), f"{place}{one.name}"
        if value is None or value == "":
            continue
        if has(type(value)):
            yield name, type(value).__name__, ""
            yield from _rows(value, f"{name}.")
        else:
            unit = one.metadata.get("unit", "-")
            yield name, str(value), "" if unit == "-" else str(unit)


def _cite(about: Page) -> str:
    sources = ", and the sources of the equations above" if about.scene is not None else ""
    return (
        f"contactkit {__version__} (BSD-3-Clause), FMU {about.name}, with the GUID in "
        f"modelDescription.xml, which is a hash of all that decides what it computes{sources}."
    )


def _text(text: str) -> str:
    return f"<p>{html.escape(text)}</p>"


def _list(lines: Iterable[str]) -> str:
    return "<ul>" + "".join(f"<li>{html.escape(line)}</li>" for line in lines) + "</ul>"


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    return "\n".join(
        ["<table>", _row(head, "th"), *(_row(cells, "td") for cells in rows), "</table>"]
    )


def _row(cells: Iterable[str], tag: str) -> str:
    return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"


def _cells(port: Port, start: Value) -> list[str]:
    shown = port.enumeration(int(start)).name if port.enumeration else str(start).lower()
    allowed = port.expectation.removeprefix("be ")
    is_output = port.causality == "output"
    return [
        port.name,
        "" if port.unit == "-" else port.unit,
        port.display_unit or "",
        port.causality,
        port.group,
        port.kind,
        "" if is_output else shown,
        "" if is_output and port.enumeration is None else allowed,
        port.label,
    ]


def license_text(distribution: str, beside: Path | None = None) -> str:
    """Licence of an installed distribution.

    Parameters
    ----------
    distribution : str
        Its name, as pip knows it.
    beside : Path, optional
        Where the text lies if the distribution is not installed but run from its sources.

    Raises
    ------
    ContactkitError
        If there is none: code must not be passed on without it.
    """
    try:
        files = importlib.metadata.files(distribution) or []
    except importlib.metadata.PackageNotFoundError:
        files = []
    for path in files:
        if path.name.upper().startswith(("LICENSE", "LICENCE")):
            return path.read_text(encoding="utf-8")
    if beside is not None and beside.exists():
        return beside.read_text(encoding="utf-8")
    raise ContactkitError(f"no licence of {distribution!r} found; reinstall {distribution}")
