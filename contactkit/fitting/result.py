"""Result of a fit: values with intervals, verdicts, residuals and the fitted scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, fields, frozen

from .._lazy import above
from ..accuracy import Accuracy
from ..errors import DescriptionError, NotSimulatedError, nearest
from ..scene.answer import Answer
from ..scene.tabular import Contents, Quantity
from ..units import quantity_text
from ..validity import ValidityNumber
from .fitted import FittedCurve, FittedParameter, FitWork, Searched, short_names

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .posterior import Posterior
    from .profile import Profile

    Floats = NDArray[np.float64]

__all__ = ["Fit"]


@frozen(eq=False)
class Fit(Answer):
    """Parameters of a scene from measured curves.

    Attributes
    ----------
    scene : object
        The scene with the fitted values; None of a device that was read from a file.
    accuracy : Accuracy
        Settings of its runs.
    parameters : tuple of FittedParameter
        Those of the scene, then the nuisances.
    curves : tuple of FittedCurve
        Data and model.
    correlation : ndarray, shape (n, n)
        Correlations of the parameters as linearised.
    chi2 : float
        Sum of the squares of all residuals over their noise.
    dof : int
        Data less parameters.
    aicc : float
        Corrected information criterion, for comparisons: `compare_fits`.
    undecided : tuple of str
        Combinations of parameters that these data do not decide, in words.
    validity : tuple of ValidityNumber
        Whether model and noise fit the data, and whether the models of the fitted scene are in
        their ranges.
    sources : tuple of str
        Sources of the equations.
    work : FitWork
        Cost.
    slopes : str
        Of which parameters the derivatives were exact, and of which differences of runs.
    """

    scene: Any = field(repr=False)
    accuracy: Accuracy = field(repr=False)
    parameters: tuple[FittedParameter, ...]
    curves: tuple[FittedCurve, ...] = field(repr=False)
    correlation: Floats = field(repr=False)
    chi2: float
    dof: int
    aicc: float
    undecided: tuple[str, ...] = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    sources: tuple[str, ...] = field(repr=False)
    work: FitWork = field(repr=False)
    has_converged: bool = True
    slopes: str = ""
    searched: Searched | None = field(default=None, repr=False)

    @property
    def status(self) -> str:
        """``decided``, ``not identifiable``, ``misfit`` or ``not converged``."""
        if not self.has_converged:
            return "not converged"
        if self.misfit:
            return "misfit"
        if self.undecided or not all(one.is_decided for one in self.parameters):
            return "not identifiable"
        return "decided"

    @property
    def misfit(self) -> tuple[ValidityNumber, ...]:
        """Numbers by which the model does not reach the data."""
        named = ("chi^2", "runs of signs")
        return tuple(v for v in self.validity if v.is_valid is False and v.name.startswith(named))

    @property
    def message(self) -> str:
        """The same in a sentence, with the cure."""
        n = sum(curve.x.size for curve in self.curves)
        head = f"{len(self.parameters)} parameters from {n} readings"
        open_ones = [one.name for one in self.parameters if not one.is_decided]
        if not self.has_converged:
            return f"{head}: the search did not converge; start nearer, or narrow the ranges"
        if self.misfit:
            return (
                f"{head}: the model does not reach the data ({self.misfit[0].name} = "
                f"{self.misfit[0].value:.3g}); free another parameter, call for the effect that is "
                "missing, or give the noise as large as it is; the intervals do not hold"
            )
        if open_ones or self.undecided:
            which = ", ".join(open_ones) if open_ones else "a combination of parameters"
            return (
                f"{head}: not identifiable from these data: {which}; measure it otherwise (a "
                "Prior), hold it, or add a curve under other conditions"
            )
        return f"{head}, all decided"

    def __getitem__(self, name: str) -> FittedParameter:
        """Return a parameter by its path, or by an end of it that no other has.

        Raises
        ------
        DescriptionError
            If there is none.
        """
        return self.parameters[self.place(name)]

    def place(self, name: str) -> int:
        """Place of a parameter by its path, or by an end of it."""
        names = [one.name for one in self.parameters]
        found = [i for i, one in enumerate(names) if one == name]
        found = found or [i for i, o in enumerate(names) if f".{o}".endswith(f".{name}")]
        if len(found) != 1:
            expected = "be one of the parameters" if not found else "name one parameter"
            raise DescriptionError(
                "parameter", name, expected, hint=nearest(name, short_names(names))
            )
        return found[0]

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return values and ends of the intervals by the ends of their paths, and chi^2."""
        found = dict[str, tuple[float, str]]()
        names = short_names([one.name for one in self.parameters])
        for name, one in zip(names, self.parameters, strict=True):
            ends = {"": one.value, "_low": one.low, "_high": one.high}
            found |= {f"{name}{end}": (value, one.unit) for end, value in ends.items()}
        n = sum(curve.x.size for curve in self.curves)
        found |= {"chi2": (self.chi2, "-"), "n_data": (n, "-"), "dof": (self.dof, "-")}
        found |= {"aicc": (self.aicc, "-")}
        for curve, prefix in zip(self.curves, self._prefixes, strict=True):
            if curve.is_estimated:
                noise = float(np.sqrt(np.mean(curve.noise**2)))
                found[f"{prefix}noise"] = (noise, curve.units[1])
        return found | {"n_runs": (self.work.n_runs, "-")}

    @property
    def _prefixes(self) -> list[str]:
        """Beginnings of the columns of each curve; none of a single one."""
        if len(self.curves) == 1:
            return [""]
        return [f"{curve.name.replace(' ', '_')}_" for curve in self.curves]

    def contents(self) -> Contents:
        """Return a row for each parameter, and the columns of each curve along its own axis."""
        rows = ("parameter",)

        def texts(values: Sequence[str]) -> Quantity:
            return Quantity(rows, np.array(values), "-")

        found = {
            "parameter": texts([one.name for one in self.parameters]),
            "value": Quantity(rows, np.array([one.value for one in self.parameters]), "-"),
            "low": Quantity(rows, np.array([one.low for one in self.parameters]), "-"),
            "high": Quantity(rows, np.array([one.high for one in self.parameters]), "-"),
            "unit": texts([one.unit for one in self.parameters]),
            "verdict": texts([one.verdict for one in self.parameters]),
            "decided_by": texts([one.decided_by for one in self.parameters]),
            "chi2": Quantity((), self.chi2, "-", "chi^2"),
        }
        for curve, prefix in zip(self.curves, self._prefixes, strict=True):
            axis = (f"{prefix}{curve.over.rpartition('.')[2]}",)
            columns = {"measured": curve.measured, "model": curve.model, "noise": curve.noise}
            found[axis[0]] = Quantity(axis, curve.x, curve.units[0], curve.over)
            found |= {
                f"{prefix}{name}": Quantity(
                    axis, values, curve.units[1], f"{curve.quantity}, {name}"
                )
                for name, values in columns.items()
            }
            found[f"{prefix}residual"] = Quantity(axis, curve.residuals, "-", "residual over noise")
        remarks = {"title": self.message, "status": self.status, "references": self.cite()}
        return Contents(rows, found, remarks)

    def unit(self, name: str) -> str:
        """Return the unit of a column or a number.

        Raises
        ------
        DescriptionError
            If there is none of that name.
        """
        known = {n: unit for n, (_, unit) in self.scalars().items()}
        known |= {n: one.unit for n, one in self.contents().quantities.items()}
        if name not in known:
            expected = "be a column or a number"
            raise DescriptionError("column", name, expected, hint=nearest(name, list(known)))
        return known[name]

    def cite(self) -> str:
        """Return the sources of the equations and of the statistics, one to a line."""
        return "\n".join(self.sources)

    def table(self) -> str:
        """Return parameters with intervals, verdicts and what decides them as text."""
        lines = list[str]()
        width = max((len(one.name) for one in self.parameters), default=0)
        for one in self.parameters:
            lines.append(f"  {one.name:{width}s}  {one.text}")
            by = f" by {one.decided_by}" if one.decided_by else ""
            lines.append(f"  {'':{width}s}  {one.verdict}{by}")
        return "\n".join(lines)

    def correlations(self, above: float = 0.9) -> list[str]:
        """Pairs of parameters that are correlated by more than a number, the closest first."""
        n = len(self.parameters)
        pairs = [(i, j) for i in range(n) for j in range(i) if abs(self.correlation[i, j]) > above]
        pairs.sort(key=lambda pair: -abs(self.correlation[pair]))
        names = short_names([one.name for one in self.parameters])
        return [f"{names[j]} and {names[i]}: {self.correlation[i, j]:+.3f}" for i, j in pairs]

    def __str__(self) -> str:
        lines = [self._headline, self.table()]
        lines += [f"  {text}" for text in self.undecided]
        if correlated := self.correlations():
            lines.append(f"  correlations: {'; '.join(correlated)}")
        for curve in self.curves:
            rms = quantity_text(float(np.sqrt(np.mean(curve.noise**2))), curve.units[1])
            how = "estimated" if curve.is_estimated else "given"
            lines.append(
                f"  {curve.name}: {curve.x.size} readings of {curve.quantity}, noise {rms} ({how})"
            )
        lines.append(
            f"  chi^2 = {self.chi2:.4g} for {self.dof} degrees of freedom, AICc = "
            f"{self.aicc:.5g}, {self.work.n_runs} runs"
        )
        if self.slopes:
            lines.append(f"  slopes: {self.slopes}")
        lines += [f"  {v}" for v in self.validity if v.is_valid is False]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """The same in a notebook."""
        from html import escape

        return f"<pre>{escape(str(self))}</pre>"

    def save(self, path: str | Path) -> Path:
        """Write the fit to an npz file without pickle, whole or not at all; `read_fit` reads it."""
        written: Path = above("save_fit")(self, path)
        return written

    def to_toml(self) -> str:
        """Return the fitted scene as a scene file, with values and intervals as comments.

        Raises
        ------
        DescriptionError
            If a file cannot hold the scene whole.
        """
        from ..files.scenes import scene_text

        lines = [f"{one.name} = {one.text}, {one.verdict}" for one in self.parameters]
        head = "".join(f"# {line}\n" for line in (self.message, *lines))
        return f"{head}\n{scene_text(self.scene, 'fitted scene')}"

    def profile(self, name: str, n: int = 15, *, reach: float = 3.0) -> Profile:
        """Profile likelihood of a parameter: least chi^2 over the others, with it held.

        Parameters
        ----------
        name : str
            Parameter, by its path or an end of it.
        n : int
            Values.
        reach : float
            How far to go on both sides, in half lengths of the interval; within the bounds.
        """
        from .profile import profile_of

        return profile_of(self._search(), self.parameters, self.place(name), n, reach)

    def sample(self, n_steps: int = 2000, *, n_walkers: int = 0, seed: int = 0) -> Posterior:
        """Posterior by the affine-invariant ensemble sampler of emcee (extra ``posterior``).

        The ranges are uniform priors, of the logarithm where that was fitted; an estimated noise is
        held at its estimate.

        Parameters
        ----------
        n_steps : int
            Steps of each walker; the first fifth is left out.
        n_walkers : int
            Walkers; four a parameter, and at least 8, if 0.
        seed : int
            Seed of the sampler.

        Raises
        ------
        MissingExtraError
            If emcee is not installed: ``pip install contactkit[posterior]``.
        """
        from .posterior import sampled

        return sampled(self._search(), self.parameters, n_steps, n_walkers, seed)

    def _search(self) -> Searched:
        if self.searched is None:
            raise NotSimulatedError(
                "a fit that was read from a file has no runs to make: call ck.fit again with its "
                "scene, fit.scene, and the data"
            )
        return self.searched

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy what a file holds, without the runs, whose functions stay here."""
        names = [one.name for one in fields(type(self)) if one.name != "searched"]
        return type(self), tuple(getattr(self, name) for name in names)
