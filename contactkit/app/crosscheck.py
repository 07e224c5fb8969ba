r"""Reference files beside native FMUs, in the format of the FMI cross-check.

For a model M there are ``M_in.csv``, its inputs, ``M_ref.csv``, what must come out, and
``M_ref.opt``, from when to when and how well. Three releases of a spool of 20 g, pulled by 40 N:

======== ==================================================================================
release_A warm and thick: 20 um, flooded, 10 mPa.s, a pull that is there at once
release_B cold: 5 um, 0.1 Pa.s, volume conserved, a pull that rises with 0.2 ms
release_E as B, with a tensile limit of the liquid of 10 bar
======== ==================================================================================

The references are no runs of the FMU: `models.monolithic` solves the same laws with the exact
pull by other methods. A host that takes ``F_ext`` and ``dF_ext`` at the steps of the table follows
a straight line between them, which in B and E is off by H^2/12 times the change of the rate.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attrs import field, frozen

from ..errors import DescriptionError
from ..files.scenes import write_whole
from ..fmu.contents.packing import no_file
from ..fmu.slaves.stiction_mass import MeniscusLaw, StictionMass, scene_of
from ..scene.scenes import SeparationScene

__all__ = ["CASES", "Case", "write_crosscheck"]

_FORCE, _RISE = 40.0, 2e-4  # N, s
_ROWS = 250  # of a reference, or up to twice as many
_SIGNALS = {
    "h": "gap",
    "v": "speed",
    "F": "film_force",
    "F_m": "meniscus_force",
    "F_v": "viscous_force",
    "J": "viscous_impulse",
    "W": "dissipated_work",
}
_COMMON = {
    "R": 3.175e-3,
    "gamma": 0.03,
    "theta1": 0.2,
    "theta2": 0.2,
    "m": 0.02,
    "k_s": 5e3,
    "h_rel": 1e-4,
    "meniscus_law": MeniscusLaw.PUBLISHED,
}
_COLD = _COMMON | {"h0": 5e-6, "eta": 0.1, "V": math.pi * _COMMON["R"] ** 2 * 5e-6}


@frozen(kw_only=True)
class Case:
    """One release: parameters of a ``stiction-mass``, its pull, and how it is to be stepped.

    Attributes
    ----------
    values : dict
        Parameters that differ from their start values, in SI units.
    rise : float
        Time constant of the pull [s]; 0 for a step.
    stop_time, step : float
        Where to end, and the communication step [s].
    rtol : float
        How far a result may be off, relative to the largest value of its column.
    """

    values: dict[str, Any] = field(repr=False)
    rise: float
    stop_time: float
    step: float
    rtol: float

    def scene(self) -> SeparationScene:
        """Film and mass."""
        return scene_of(StictionMass.start_values() | self.values)

    def pull(self, time: float) -> float:
        """Pull [N] at a time [s]."""
        return -_FORCE * math.expm1(-time / self.rise) if self.rise else _FORCE


CASES: dict[str, Case] = {
    "release_A": Case(
        values=_COMMON | {"h0": 2e-5, "eta": 0.01}, rise=0.0, stop_time=4e-4, step=1e-6, rtol=1e-5
    ),
    "release_B": Case(values=_COLD, rise=_RISE, stop_time=1.26e-2, step=1e-5, rtol=1e-3),
    "release_E": Case(
        values=_COLD | {"dp_cav": 1e6}, rise=_RISE, stop_time=8.2e-4, step=2e-6, rtol=1e-4
    ),
}


def write_crosscheck(
    folder: str | os.PathLike[str],
    *,
    names: Sequence[str] | None = None,
    fmus: bool = True,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
) -> list[Path]:
    """Write reference files, and the native FMUs they belong to.

    Parameters
    ----------
    folder : path
        Where to write; made if it is not there.
    names : sequence of str, optional
        Those of `CASES` to write; all if not given.
    fmus : bool
        Build the FMUs too, which needs a C compiler.
    platforms, compiler : optional
        See `contactkit.fmu.native.build.build_native`.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    DescriptionError
        If there is no such case.
    ContactkitError
        If a file cannot be written, or an FMU cannot be built; its tables are there all the same.
    """
    for name in names or ():
        if name not in CASES:
            raise DescriptionError("case", name, "be one of " + ", ".join(CASES))
    target = Path(folder)
    written = []
    for name in names if names is not None else CASES:
        case = CASES[name]
        for path, text in _tables(name, case).items():
            written.append(_write(target / path, text))
        if fmus:
            from ..fmu.native.build import build_native

            fmu = target / f"{name}.fmu"
            build_native(case.scene(), fmu, platforms=platforms, compiler=compiler)
            written.append(fmu)
    return written


def _tables(name: str, case: Case) -> dict[str, str]:
    """Inputs, reference and options of a case, by the name of the file."""
    import numpy as np

    from ..models.injector.monolithic import simulate
    from ..separation.plan import plan

    count = round(case.stop_time / case.step)
    times = np.linspace(0.0, case.stop_time, count + 1)
    pulls = np.array([case.pull(float(time)) for time in times])
    rates = np.append(np.diff(pulls) / np.diff(times), 0.0)
    rates[-1] = rates[-2]
    found = simulate(plan(case.scene()), case.pull, case.stop_time, rtol=1e-10, times=times)
    kept = slice(None, None, max(1, count // _ROWS))
    columns = [found.columns[curve][kept] for curve in _SIGNALS.values()]
    options = {
        "StartTime": 0.0,
        "StopTime": case.stop_time,
        "StepSize": case.step,
        "RelTol": case.rtol,
    }
    return {
        f"{name}_in.csv": _csv(["time", "F_ext", "dF_ext"], [times, pulls, rates]),
        f"{name}_ref.csv": _csv(["time", *_SIGNALS], [times[kept], *columns]),
        f"{name}_ref.opt": "".join(f"{key}, {value!r}\n" for key, value in options.items()),
    }


def _csv(head: Sequence[str], columns: Sequence[Any]) -> str:
    rows = (",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True))
    return "\n".join([",".join(f'"{name}"' for name in head), *rows]) + "\n"


def _write(path: Path, text: str) -> Path:
    """Write a text, all or nothing."""
    try:
        with write_whole(path) as partial:
            partial.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise no_file(path, error) from error
    return path
