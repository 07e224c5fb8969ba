"""Base class of all results: plan and sources, status, numbers and columns, and a file."""

from __future__ import annotations

import abc
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from attrs import fields

from .._lazy import above
from ..errors import DescriptionError
from ..export.contents import Quantity
from ..validity import ValidityNumber
from .answer import Answer
from .effect import Effect
from .plan import ScenePlan
from .scales import Scaled, Scales

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .gradient import Gradient

__all__ = ["Result"]


class Result(Answer):
    """Result of a plan: curves or maps, numbers, and the part of each effect.

    ``result["gap"]`` is a column by its name, ``result.of(kind)`` what an effect did, and
    ``print(result)`` the status with all numbers.
    """

    __slots__ = ()

    @property
    @abc.abstractmethod
    def plan(self) -> ScenePlan:
        """Plan that was run."""

    @property
    @abc.abstractmethod
    def columns(self) -> Mapping[str, NDArray[Any]]:
        """Curves or maps by their names; read-only arrays."""

    @property
    @abc.abstractmethod
    def validity(self) -> tuple[ValidityNumber, ...]:
        """Whether the models were inside their ranges."""

    @property
    @abc.abstractmethod
    def work(self) -> Any:
        """Cost of the run: a named tuple of counts ``n_...`` and ``seconds``."""

    @property
    def errata(self) -> tuple[Any, ...]:
        """Printed equations that the run takes, each with the right value; none by default."""
        return ()

    @property
    def notes(self) -> tuple[str, ...]:
        """Remarks on the numbers and curves, in sentences; none by default."""
        return ()

    @abc.abstractmethod
    def of(self, kind: Any) -> Any:
        """Return what an effect did; refuse one that the scene does not list."""

    @property
    @abc.abstractmethod
    def scales(self) -> Scales:
        """Reference scales by the SI unit of the quantities that they belong to."""

    def scaled(self, name: str) -> Scaled:
        """Return a column or a number over the scale of its unit, with the name of the scale.

        A quantity whose unit has no scale is returned as it is, with its SI unit.

        Raises
        ------
        DescriptionError
            If there is no such column or number.

        Examples
        --------
        >>> import contactkit as ck
        >>> film = ck.Meniscus(liquid=ck.load_liquid("water"), volume=1e-20)
        >>> scene = ck.SlidingScene(
        ...     interface=ck.Interface(meniscus=film),
        ...     loading=ck.Sliding(gap=5e-9, speed=1e-3),
        ...     effects=(ck.CouetteForce(),),
        ... )
        >>> force, unit = ck.simulate(ck.plan(scene)).scaled("couette_force")
        >>> round(float(force[0]), 12), unit
        (1.0, 'F0')
        """
        import numpy as np

        numbers = self.scalars()
        if name in numbers and name not in self.columns:
            value, unit = np.asarray(numbers[name][0]), numbers[name][1]
        else:
            value, unit = self[name], self.unit(name)
        scale = self.scales.get(unit)
        return Scaled(value, unit) if scale is None else Scaled(value / scale.value, scale.name)

    def dimensionless(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run over their scales, each with the name of its scale.

        Those whose unit has no scale are left out.
        """
        scales = self.scales
        found = {}
        for name, (value, unit) in self.scalars().items():
            if unit == "-":
                found[name] = (value, unit)
            elif unit in scales:
                found[name] = (value / scales[unit].value, scales[unit].name)
        return found

    def has(self, kind: type[Effect]) -> bool:
        """Whether the scene lists an effect."""
        return self.plan.has(kind)

    def _numbers(self) -> dict[str, Quantity]:
        """The numbers of the run as quantities of the whole."""
        numbers = self.scalars().items()
        return {n: Quantity((), v, unit, n.replace("_", " ")) for n, (v, unit) in numbers}

    def _remarks(self) -> dict[str, str]:
        """What was run, how it ended, and the sources of its equations."""
        return {
            "title": self.plan.title,
            "status": self.status,
            "message": self.message,
            "references": self.cite(),
        }

    def cite(self) -> str:
        """Sources of the equations of this run, one to a line."""
        return self.plan.cite()

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column by its name.

        Raises
        ------
        DescriptionError
            If there is no such column; the message lists those that there are.
        NotSimulatedError
            If the run did not simulate it; the message says what to add.
        """
        columns = self.columns
        if name not in columns:
            self._refuse(name)
            cure = self._meant(name)
            raise DescriptionError("column", name, f"be one of {', '.join(columns)}", hint=cure)
        return columns[name]

    @abc.abstractmethod
    def _refuse(self, name: str) -> None:
        """Refuse a column that only another scene has, and name what that would have to list."""

    if not TYPE_CHECKING:  # which knows what a result has; here only the refusal is worded

        def __getattr__(self, name: str) -> NoReturn:
            kind = type(self).__name__
            if name.startswith("__") or hasattr(type(self), name):  # a field that is not set yet
                raise AttributeError(f"{kind} has no attribute {name!r}")
            cure = self._meant(name) or 'a column is result["name"], a number result.scalars()'
            raise AttributeError(f"{kind} has no attribute {name!r}; {cure}")

    def _meant(self, name: str) -> str:
        """Suggest what a result has in place of a name; empty if nothing is near."""
        import difflib  # for this alone

        known = {n: f"result.scalars()[{n!r}]" for n in self.scalars()}
        known |= {n: f"result[{n!r}]" for n in self.columns}
        known |= {n: f"result.{n}" for n in dir(type(self)) if not n.startswith("_")}
        close = difflib.get_close_matches(name, known, n=1, cutoff=0.75)
        return f"did you mean {known[close[0]]}?" if close else ""

    def gradient(self, of: Any, to: str | Sequence[str]) -> Gradient:
        """Return the slopes of a number of the result over parameters of its scene.

        Of a contact by one more solve with the same operator, of a motion by the sensitivities of
        its steps; nothing is run again for each parameter. Pixels in contact stay what they are:
        the slopes hold until one comes into contact or leaves it.

        Parameters
        ----------
        of : str or Functional
            The number: of a contact one of `contact.functionals.FUNCTIONALS`, such as ``load``,
            ``approach`` or ``mean_gap``, or a `Functional` of one's own; of a separation
            ``release_time``, ``release_speed``, ``break_time``, ``peak_force``, ``final_gap`` or an
            impulse.
        to : str or sequence of str
            Dotted paths of numbers of the scene, as in `study`: ``loading.force``,
            ``interface.lower.solid.young_modulus``; and ``heights`` of a contact, the slope over
            the height of each pixel, a map.

        Returns
        -------
        Gradient
            ``gradient["loading.force"]`` is a slope; notes where it is one-sided.

        Raises
        ------
        NotSimulatedError
            If the result has no gradient: of a contact that was unloaded, with coupled friction, a
            film force of its own or a hardness that follows the displacement; of a motion that
            rests on asperities or whose cavity is remembered.
        DescriptionError
            If there is no such number or parameter, or it has no gradient.

        Examples
        --------
        >>> import contactkit as ck
        >>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
        >>> face = ck.Flat(radius=1e-3)
        >>> scene = ck.SeparationScene(
        ...     interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        ...     loading=ck.ImposedForce(force=1.0, mass=1e-3, initial_gap=5e-6, final_gap=2e-5),
        ...     effects=(ck.ViscousForce(),),
        ... )
        >>> gradient = ck.simulate(ck.plan(scene)).gradient(
        ...     "release_time", "interface.meniscus.liquid.viscosity"
        ... )
        >>> round(gradient.relative("interface.meniscus.liquid.viscosity"), 2)
        1.0
        """
        found: Gradient = above("gradient_of")(self, of, to)
        return found

    def save(self, path: str | Path) -> Path:
        """Write the result to an npz file without pickle; `load_result` reads it."""
        written: Path = above("save_result")(self, path)
        return written

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the fields; arrays are read-only again in the copy."""
        kind: Any = type(self)  # an attrs class, as every result is
        return _restored, (kind, [getattr(self, a.name) for a in fields(kind)])


def _restored(kind: type[Result], values: list[Any]) -> Result:
    """Result of its fields, read from a pickle or copied."""
    for value in values:
        _lock(value)
    return kind(*values)


def _lock(value: Any) -> None:
    """Make the arrays in a value read-only, as they were before they were pickled or copied."""
    if getattr(value, "ndim", 0):
        value.flags.writeable = False
    elif isinstance(value, Mapping):
        # Of curves that are computed when they are asked for, those that were.
        for one in getattr(value, "computed", value).values():
            _lock(one)
    elif isinstance(value, tuple):
        for one in value:
            _lock(one)
