"""The errors contactkit raises: each says what is wrong, with which value, and how to cure it."""

from __future__ import annotations

from typing import Any

__all__ = [
    "ContactkitError",
    "ConvergenceError",
    "DescriptionError",
    "InfeasibleError",
    "NotSimulatedError",
    "PlanError",
    "ValidityWarning",
]


class ContactkitError(Exception):
    """Anything contactkit refuses or cannot do."""


class DescriptionError(ContactkitError, ValueError):
    """A number, a name or a file that describes something impossible.

    Parameters
    ----------
    field : str
        What is wrong, as ``Owner.field``.
    value : object
        What was given.
    expected : str
        What would have been right, after "must".
    unit : str, optional
        The unit the value was read in.
    hint : str, optional
        The cure, where one can be guessed.

    Examples
    --------
    >>> print(DescriptionError("Liquid.density", -1.0, "be positive and finite", unit="kg/m3"))
    Liquid.density must be positive and finite [kg/m3], got -1.0
    """

    def __init__(
        self, field: str, value: object, expected: str, *, unit: str = "", hint: str = ""
    ) -> None:
        self.field, self.value, self.unit, self.hint = field, value, unit, hint
        bracket = f" [{unit}]" if unit else ""
        cure = f"; {hint}" if hint else ""
        self.expected = expected
        super().__init__(f"{field} must {expected}{bracket}, got {value!r}{cure}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Let processes send it: its message is made anew from its parts."""
        return _description_error, (
            self.field,
            self.value,
            self.expected,
            self.unit,
            self.hint,
            self.args,
        )


def _description_error(
    field: str, value: object, expected: str, unit: str, hint: str, args: tuple[Any, ...]
) -> DescriptionError:
    made = DescriptionError(field, value, expected, unit=unit, hint=hint)
    made.args = args
    return made


class PlanError(ContactkitError, ValueError):
    """The effects of a scene do not fit together, or lack something they need."""


class InfeasibleError(PlanError):
    """No answer exists: the message names the limit that is passed."""


class ConvergenceError(ContactkitError, RuntimeError):
    """A solve did not reach its tolerance; `result` holds the best that was found."""

    def __init__(self, message: str, result: Any = None) -> None:
        super().__init__(message)
        self.result = result


class NotSimulatedError(ContactkitError, LookupError):
    """A quantity of an effect that the scene did not call for."""


class ValidityWarning(UserWarning):
    """A model was used outside the range it was derived for."""
