"""Differences of what a scene is prepared to, over one of its parameters.

What is solved for is differentiated by its own equations; only what does not depend on it, such as
heights, compliances, loads and laws of forces, is prepared again at values nearby.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, NamedTuple, TypeVar

from ...errors import ContactkitError, DescriptionError, PlanError
from ..paths import axes, changed, value_at

__all__ = ["Differences", "Parameter", "differences", "parameter"]

T = TypeVar("T")

# Relative step. Differences of fourth order leave 3e-14 of the fifth derivative out, so that laws
# whose digits end at 1e-12 (exact menisci, influence of layers) decide: 1e-9 of the slope is left.
_STEP = 1e-3
# Step of a number without unit that is zero, as a contact angle or a Poisson's ratio may be.
_AT_ZERO = 1e-3
_CENTRAL = ((-2, 1.0 / 12.0), (-1, -8.0 / 12.0), (1, 8.0 / 12.0), (2, -1.0 / 12.0))
_COARSE = ((-1, -0.5), (1, 0.5))
# Of third order, to one side, where the other is refused (a Poisson's ratio of 1/2).
_BACKWARD = ((-3, -2.0 / 6.0), (-2, 9.0 / 6.0), (-1, -18.0 / 6.0), (0, 11.0 / 6.0))
_FORWARD = tuple((-place, -weight) for place, weight in _BACKWARD)


class Parameter(NamedTuple):
    """A number of a scene by its path, its value in SI units, and the unit.

    Paths that have one value are one path, with commas between them.
    """

    path: str
    value: float
    unit: str

    def at(self, value: float) -> dict[str, float]:
        """Another value, by the path of each field."""
        return dict.fromkeys(map(str.strip, self.path.split(",")), value)


class Differences(NamedTuple, Generic[T]):
    """Preparations of a scene at values of a parameter, and the weights of their difference."""

    prepared: tuple[T, ...]
    weights: tuple[float, ...]
    is_one_sided: bool

    def weighted(self, of: Callable[[T], Any]) -> Any:
        """Difference of something of the preparations: a number or an array."""
        pairs = zip(self.prepared, self.weights, strict=True)
        return sum(weight * of(one) for one, weight in pairs)

    def notes(self, path: str) -> tuple[str, ...]:
        """Remark on a slope of one-sided differences, if these are."""
        if not self.is_one_sided:
            return ()
        return (f"{path}: values to one side alone, the others are refused",)


def parameter(scene: Any, accuracy: Any, path: str) -> Parameter:
    """Return a number of a scene by its path.

    Raises
    ------
    DescriptionError
        If the path does not exist, or leads to no number.
    """
    if path == "accuracy" or path.startswith("accuracy."):
        raise DescriptionError("to", path, "be physics of the scene: accuracy has no gradient")
    names = [name.strip() for name in path.split(",")]
    values = [value_at(scene, accuracy, name) for name in names]
    value = values[0]
    if not isinstance(value, float):
        found = type(value).__name__
        raise DescriptionError("to", path, f"lead to a number that may vary; there is a {found}")
    if any(one != value for one in values):
        raise DescriptionError("to", path, "be fields of one value")
    (axis,) = axes(scene, accuracy, {names[0]: [value]})
    return Parameter(path, value, axis.units[0])


def differences(
    scene: Any,
    accuracy: Any,
    given: Parameter,
    prepare: Callable[[Any], T],
    *,
    is_coarse: bool = False,
) -> Differences[T]:
    """Prepare a scene at values of a parameter around its own.

    A coarse difference takes two values instead of four, and leaves 1e-6 of the slope out.

    Raises
    ------
    DescriptionError
        If the parameter is zero, and its unit gives no step.
    ContactkitError
        That of the scene, if it is refused on both sides.
    """
    step = _STEP * abs(given.value)
    if step == 0.0:
        if given.unit not in ("-", "rad"):
            raise DescriptionError(
                "to",
                given.path,
                "not be zero: a difference needs a size to be small against",
                unit=given.unit,
                hint="give it a small value in the scene",
            )
        step = _AT_ZERO
    problem: ContactkitError | None = None
    central = _COARSE if is_coarse else _CENTRAL
    for stencil in (central, _BACKWARD, _FORWARD):
        try:
            made = tuple(
                prepare(changed(scene, accuracy, given.at(given.value + i * step)).scene)
                for i, _ in stencil
            )
        except (DescriptionError, PlanError) as error:
            problem = problem or error
            continue
        weights = tuple(weight / step for _, weight in stencil)
        return Differences(made, weights, stencil is not central)
    assert problem is not None
    raise problem
