"""Exceptions and warnings: each message names the field, the value, what is expected, the cure."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

__all__ = [
    "ContactkitError",
    "ConvergenceError",
    "DescriptionError",
    "InfeasibleError",
    "InstalledKindWarning",
    "MissingExtraError",
    "NotSimulatedError",
    "PlanError",
    "ValidityWarning",
    "nearest",
]


def nearest(name: object, known: Iterable[str]) -> str:
    """Suggest the nearest of the known names, or list them.

    Examples
    --------
    >>> nearest("viscus_force", ["gap", "viscous_force"])
    "did you mean 'viscous_force'?"
    """
    import difflib  # for this alone

    names = list(known)
    close = difflib.get_close_matches(str(name), names, n=1, cutoff=0.55)
    return f"did you mean {close[0]!r}?" if close else f"known: {', '.join(names)}"


class ContactkitError(Exception):
    """Base class of the exceptions of contactkit."""


# Letters of a value and of a name of a field that a message shows, the middle left out: a file may
# hold texts of megabytes, and a message is to fit on a screen with its cure. The longest own field
# has 60.
_LONGEST = 500
_LONGEST_FIELD = 200


def _shown(value: object) -> str:
    """A value as text, the middle of a long one left out."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # an integer of thousands of digits; deep nesting
        text = f"a {type(value).__name__} too large to print"
    return _cut(text, _LONGEST)


def _cut(text: str, longest: int) -> str:
    """A text, the middle of a long one left out."""
    if len(text) <= longest:
        return text
    return f"{text[: longest // 2]} ... {text[-longest // 4 :]}"


class DescriptionError(ContactkitError, ValueError):
    """An invalid number, name or file in a description.

    Parameters
    ----------
    field : str
        The field at fault, as ``Owner.field``.
    value : object
        The value given.
    expected : str
        The requirement, after "must".
    unit : str, optional
        Unit in which the value was read.
    hint : str, optional
        The cure, where one is known.

    Examples
    --------
    >>> print(DescriptionError("Liquid.density", -1.0, "be positive and finite", unit="kg/m3"))
    Liquid.density must be positive and finite [kg/m3], got -1.0
    """

    def __init__(
        self, field: str, value: object, expected: str, *, unit: str = "", hint: str = ""
    ) -> None:
        field = _cut(field, _LONGEST_FIELD)
        self.field, self.value, self.unit, self.hint = field, value, unit, hint
        bracket = f" [{unit}]" if unit else ""
        cure = f"; {hint}" if hint else ""
        self.expected = expected
        super().__init__(f"{field} must {expected}{bracket}, got {_shown(value)}{cure}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the exception by its parts, for transfer between processes."""
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
    """No solution exists: the message names the limit that is exceeded."""


class ConvergenceError(ContactkitError, RuntimeError):
    """A solver did not reach its tolerance; `result` holds the best iterate."""

    def __init__(self, message: str, result: Any = None) -> None:
        super().__init__(message)
        self.result = result


class NotSimulatedError(ContactkitError, LookupError):
    """A quantity of an effect that the scene does not include."""


class MissingExtraError(ContactkitError, ImportError):
    """An optional package is not installed; the message names the extra that installs it."""


class ValidityWarning(UserWarning):
    """A model was used outside the range it was derived for."""


class InstalledKindWarning(UserWarning):
    """A kind that another package declares cannot be used; the message states why."""
