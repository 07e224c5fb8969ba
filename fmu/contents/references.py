"""Reference results inside an FMU, as the layered standard FMI-LS-REF 1.0.0-beta.1 has them.

The folder ``extra/org.fmi-standard.fmi-ls-ref`` holds a manifest, a file of experiments in the
format of MA-HS-Experiments (a draft: the schema of the Modelica Association of 2026 is followed),
and of each experiment the stimuli and the reference results as CSV. How far a result may be off is
an annotation, as neither draft has a place for it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from attrs import field, frozen

from ...units import si

__all__ = ["FOLDER", "TOLERANCE_NOTE", "ReferenceRun", "reference_files"]

FOLDER = "extra/org.fmi-standard.fmi-ls-ref/"
"""Folder of the layered standard in an FMU."""

TOLERANCE_NOTE = "org.contactkit.relative-tolerance"
"""Type of the annotation with the tolerance of an experiment."""

_LAYERED = "http://fmi-standard.org/fmi-ls-manifest"
_MANIFEST = {
    "fmi-ls-name": "org.fmi-standard.fmi-ls-ref",
    "fmi-ls-version": "1.0.0-beta.1",
    "fmi-ls-description": (
        "Layered Standard providing information on related files included in an FMU."
    ),
}
_NOTE = """Reference results of this FMU
=============================

The folder extra/org.fmi-standard.fmi-ls-ref holds them as FMI-LS-REF 1.0.0-beta.1 describes.

{name}: {description}.
From 0 to {stop_time!r} s in communication steps of {step!r} s.
Set the stimuli of a row at the start of the step that begins at its time, and hold them.
A result may differ by {tolerance:g} of the largest value of its column.

The check `contactkit fmu check FILE` does this with fmpy.
"""


@frozen(kw_only=True)
class ReferenceRun:
    """An experiment: stimuli of an FMU, and what must come out.

    Attributes
    ----------
    name : str
        Name of the experiment and of its files: letters, digits and ``-``.
    description : str
        What is done, and what the references were computed by.
    stop_time, step : float
        Where it ends, and the communication step [s]; it begins at 0.
    stimuli, references : mapping of str to sequence of float
        Columns by the name of the variable, in its SI unit, and ``time``. A row of the stimuli is
        to be set at the start of the step that begins at its time.
    tolerance : float
        How far a result may be off, relative to the largest value of its column.
    """

    name: str
    description: str
    stop_time: float = field(metadata=si("s"))
    step: float = field(metadata=si("s"))
    stimuli: Mapping[str, Sequence[float]] = field(repr=False)
    references: Mapping[str, Sequence[float]] = field(repr=False)
    tolerance: float = field(metadata=si("-"))


def reference_files(run: ReferenceRun) -> dict[str, bytes]:
    """Files of an experiment by their path in the FMU: manifest, experiment, CSV, and a note.

    Examples
    --------
    >>> rows = {"time": [0.0, 1.0], "u": [2.0, 2.0]}
    >>> run = ReferenceRun(
    ...     name="pull", description="by hand", stop_time=1.0, step=1.0, stimuli=rows,
    ...     references={"time": [0.0, 1.0], "y": [0.0, 4.0]}, tolerance=1e-6,
    ... )
    >>> files = reference_files(run)
    >>> [path.rpartition("/")[2] for path in files]
    ['pull-in.csv', 'pull-ref.csv', 'pull.exp', 'fmi-ls-manifest.xml', 'fmi-ls-ref.txt']
    >>> print(files[FOLDER + "pull-ref.csv"].decode())
    time,y
    0.0,0.0
    1.0,4.0
    <BLANKLINE>
    """
    found = {
        f"{FOLDER}{run.name}-in.csv": _csv(run.stimuli),
        f"{FOLDER}{run.name}-ref.csv": _csv(run.references),
        f"{FOLDER}{run.name}.exp": _experiments(run),
    }
    return {
        **found,
        f"{FOLDER}fmi-ls-manifest.xml": _manifest(run, found),
        "documentation/fmi-ls-ref.txt": _NOTE.format(
            name=run.name,
            description=run.description,
            stop_time=run.stop_time,
            step=run.step,
            tolerance=run.tolerance,
        ).encode(),
    }


def _csv(columns: Mapping[str, Sequence[float]]) -> bytes:
    """Rows of numbers that read back as the same floats."""
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns), *(",".join(repr(float(v)) for v in row) for row in rows)]
    return ("\n".join(lines) + "\n").encode()


def _experiments(run: ReferenceRun) -> bytes:
    """File of experiments, by the schema of MA-HS-Experiments."""
    root = Element("Experiments", name=run.name, description=run.description)
    one = SubElement(root, "Experiment", name=run.name, description=run.description)
    times = {"startTime": "0.0", "stopTime": repr(run.stop_time), "stepSize": repr(run.step)}
    SubElement(one, "TransientSimulation", times)
    SubElement(one, "Stimuli", source=f"{run.name}-in.csv")
    SubElement(one, "References", source=f"{run.name}-ref.csv")
    notes = SubElement(one, "Annotations")
    SubElement(notes, "Annotation", type=TOLERANCE_NOTE).text = repr(run.tolerance)
    return _text(root)


def _manifest(run: ReferenceRun, files: Mapping[str, bytes]) -> bytes:
    """Manifest of the layered standard: every file with its role and its SHA3-256."""
    names = {f"fmi-ls:{key}": value for key, value in _MANIFEST.items()}
    root = Element("fmiReferences", {"xmlns:fmi-ls": _LAYERED, **names})
    kinds = {
        f"{run.name}.exp": ("application/x-ma-hs-experiments", "experiment/smoke-test"),
        f"{run.name}-in.csv": ("text/csv", "other"),
        f"{run.name}-ref.csv": ("text/csv", "result"),
    }
    for name, (kind, role) in kinds.items():
        SubElement(
            root,
            "Related",
            type=kind,
            source=name,
            role=role,
            description=run.description,
            checksum=hashlib.sha3_256(files[FOLDER + name]).hexdigest(),
        )
    return _text(root)


def _text(root: Element) -> bytes:
    indent(root)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"
