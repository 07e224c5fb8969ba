"""Tension of an attraction across the gap, as an unknown of the contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from .unknown import Held, HeldContact, Next, Target, Unknown

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...accuracy import Accuracy
    from ..effects.attraction_laws import TensionLaw

    Map = NDArray[np.float64]

__all__ = ["Tension", "on_branch_of"]

_FINEST = 1e-12  # below, the violation of the contact conditions is round-off
# Tolerance of the last contacts over that of the tension: the tension of the answer is then known
# ten times better than it must agree.
_INNER = 0.1


class Tension(Unknown):
    """Tension [Pa] of the attraction at each pixel (ny, nx); in contact that of a closed gap.

    Parameters
    ----------
    law : TensionLaw
        Tension over the gap.
    shape : (ny, nx)
        Of the window.
    effect : str
        Name of the effect.
    """

    name: ClassVar[str] = "tension"
    measure: ClassVar[str] = "its maximum"
    is_monotonic: ClassVar[bool] = True
    first_rtol = 1e-3
    loosest = 1e-3

    def __init__(self, law: TensionLaw, shape: tuple[int, int], effect: str) -> None:
        self.law, self._shape, self.effect = law, shape, effect
        cure = f"{law.cure}, " if law.cure else ""
        self.cure = (
            f"it is next to a jump of the contact: {cure}change the approach or load a little, or "
            "raise Accuracy.rtol"
        )

    def first(self, target: Target) -> Map:
        """See `Unknown.first`: that of the state to start from, which decides on the branch."""
        known = target.unknowns.get(self.name)
        return known if known is not None else np.zeros(self._shape)

    def hold(self, held: Held, value: Map) -> Held:
        """See `Unknown.hold`."""
        return held._replace(tension=value)

    def renewed(self, contact: HeldContact, rtol: float) -> Next:
        """See `Unknown.renewed`."""
        return Next(self.law.tension(contact.gap))

    def scale(self, contact: HeldContact) -> float:
        """See `Unknown.scale`."""
        return self.law.strength

    def admitted(self, value: Map, found: Map, target: Target) -> Map:
        """See `Unknown.admitted`: momentum may leave the range of the law."""
        return np.clip(value, 0.0, self.law.strength)

    def carries(self, value: Map, target: Target) -> bool:
        """See `Unknown.carries`."""
        load = target.mean_pressure
        return load is None or load >= 0.0 or load + float(value.mean()) > 0.0

    def sensitivity(self, heights: Map) -> float:
        """See `Unknown.sensitivity`.

        A slope much narrower than the range, as the end of a Dugdale law on a stiff film, asks for
        more accurate contacts.
        """
        return max(float(heights.std()) * self.law.steepest / self.law.strength, 1.0)

    def finest(self, accuracy: Accuracy, heights: Map) -> float:
        """See `Unknown.finest`."""
        unit = self.sensitivity(heights)
        return max(min(accuracy.rtol, _INNER * accuracy.outer_rtol / unit), _FINEST)

    def floor(self, accuracy: Accuracy, heights: Map) -> float:
        """See `Unknown.floor`."""
        return 3.0 * self.finest(accuracy, heights) * self.sensitivity(heights)


def on_branch_of(target: Target, values: dict[str, Map]) -> dict[str, Map]:
    """Values near a solution, with the tension that a target starts from: it decides on the branch.

    A contact repeated with another hardness, say, must not start on the other side of its state.
    """
    known = {name: value for name, value in values.items() if name != Tension.name}
    given = target.unknowns.get(Tension.name)
    return known if given is None else {**known, Tension.name: given}
