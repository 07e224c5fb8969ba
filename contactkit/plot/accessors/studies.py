"""Figures of studies, in memory or in a file, and of a sensitivity, ``study.plot``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from ...studies.columns import StudyColumns
from ...studies.sensitivity import Sensitivity
from ...studies.sobol import SobolIndices
from ..axis_units import axis_label, readable
from ..gradient import sobol_bars
from ..study import study_curves
from ..style import Axes, figure, legend
from ..tornado import tornado
from .base import Figures, registered_figures

__all__ = ["SensitivityFigures", "SobolFigures", "StudyFigures"]


@registered_figures.register(StudyColumns)
class StudyFigures(Figures[StudyColumns]):
    """Figures of the numbers of a study over its parameters."""

    def pictures(self) -> dict[str, Callable[[], Axes]]:
        """See `Figures.pictures`: every number that changes between the points."""
        return {name: partial(self.number, name) for name in self._owner.telling()}

    def number(self, name: str, *, over: str | None = None, ax: Axes | None = None) -> Axes:
        """Draw a number over a parameter, a line for each combination of the others.

        A study with bands is drawn with them.

        Parameters
        ----------
        name : str
            Name of a column, such as ``contact_area``.
        over : str, optional
            Name of the parameter in tables, its path, or the beginning of that; the last one if
            not given.
        ax : Axes, optional
            Where to draw; a new figure if not given.

        Raises
        ------
        DescriptionError
            If there is no such column or parameter.
        """
        study = self._owner
        path = study.path_of(over) if over else study.paths[-1][0]
        unit = study.unit(name)
        factor, shown = readable(unit, study.column(name))
        along, place = _of_parameter(study, path)
        ax = ax if ax is not None else figure()[1]
        curves = [(line.label, line.columns) for line in study.lines(path)]
        panel = (name, axis_label(_spoken(name), shown), factor)
        study_curves(curves, [ax], [panel], (path, axis_label(_spoken(path), place), along))
        if len(curves) > 1:
            legend(ax)
        return ax


@registered_figures.register(Sensitivity)
class SensitivityFigures(Figures[Sensitivity]):
    """Figures of what the assumptions of a scene do to a quantity."""

    def tornado(
        self,
        *,
        most: int = 12,
        names: Mapping[str, str] | None = None,
        missing: str = "no result",
        ax: Axes | None = None,
    ) -> Axes:
        """Draw the quantity over the range of each assumption, the most influential on top.

        Parameters
        ----------
        most : int
            Most assumptions to draw.
        names : mapping, optional
            What to call the assumptions, by path; else the end of the path.
        missing : str
            What it means that there is no result, such as "never released".
        ax : Axes, optional
            Where to draw; a new figure if not given.
        """
        found: Sensitivity = self._owner
        return tornado(found, ax, most=most, names=names, missing=missing)


@registered_figures.register(SobolIndices)
class SobolFigures(Figures[SobolIndices]):
    """Figures of Sobol' indices."""

    def indices(self, *, names: Mapping[str, str] | None = None, ax: Axes | None = None) -> Axes:
        """Draw first-order and total indices with their intervals, the largest on top.

        Parameters
        ----------
        names : mapping, optional
            What to call the assumptions, by path; else the end of the path.
        ax : Axes, optional
            Where to draw; a new figure if not given.
        """
        return sobol_bars(self._owner, ax, names)


def _of_parameter(study: StudyColumns, path: str) -> tuple[float, str]:
    """Factor and name of the unit of a parameter; of one that is no number, none."""
    values = study.column(path)
    return readable(study.unit(path), values) if values.dtype.kind == "f" else (1.0, "-")


def _spoken(path: str) -> str:
    return path.rpartition(".")[2].replace("_", " ")
