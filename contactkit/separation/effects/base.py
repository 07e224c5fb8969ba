r"""The roles a piece of physics may play in a separation, read off the equation of motion.

.. math:: m \ddot h = F_{ext}(t) - k_s (h - h_0) - \sum F(h, \dot h)

An effect holds choices only. `prepare` does once whatever does not depend on gap and speed;
what it returns is called in the loop.
"""

from __future__ import annotations

import abc
from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from attrs import frozen

from ...scene.effect import Effect

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...scene.scenes import SeparationScene

__all__ = [
    "FilmEnd",
    "FilmLimit",
    "ForceLaw",
    "Limiter",
    "SeparationEffect",
    "SeparationForce",
]

Limiter = Callable[[float, float, float], float]
"""Force [N] that is left of a Newtonian force [N]: called with (gap, speed, force)."""


class ForceLaw(NamedTuple):
    """A force made ready: what it is, and where it is not smooth.

    `force` is called with (gap [m], speed [m/s]) and gives [N]. `kinks` are gaps at which its
    slope jumps, `end` the gap beyond which it does not exist (inf: none), and `exponent` gives
    n where the force falls as gap^-n, at a gap. A contact of solids lets go where the gap exceeds
    `release`, and is there again once it has closed to `rejoin`; the law goes on smoothly beyond.
    """

    force: Callable[[float, float], float]
    kinks: tuple[float, ...] = ()
    end: float = float("inf")
    exponent: Callable[[float], float] = lambda gap: 0.0
    impulse: Callable[[float, float], float] | None = None
    """Time integral [N.s] of a force that is proportional to speed, between two gaps."""
    release: float = float("inf")
    rejoin: float = 0.0


@frozen(kw_only=True)
class SeparationEffect(Effect):
    """An effect of a `SeparationScene`."""

    takes_pressure: ClassVar[bool] = False
    """Whether it knows a meniscus of fixed pressure; otherwise the plan refuses that."""

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """Sources of what this choice computes for a scene; all of them, unless it depends."""
        return self.sources

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """Name what this effect needs and `scene` does not give, with units."""
        return ()


@frozen(kw_only=True)
class SeparationForce(SeparationEffect):
    """A force F(h, h') between the bodies; any number may act.

    `column` names its curve, one of `columns.COLUMNS`; a force that does not need the film stays
    when that breaks.
    """

    column: ClassVar[str]
    needs_film: ClassVar[bool] = True

    @abc.abstractmethod
    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """Do the work that depends on neither gap nor speed."""


@frozen(kw_only=True)
class FilmLimit(SeparationEffect):
    """A bound on what the liquid can carry; it lowers the viscous force."""

    @abc.abstractmethod
    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> Limiter:
        """Do the work that depends on neither gap nor speed."""


@frozen(kw_only=True)
class FilmEnd(SeparationEffect):
    """A rule for the gap at which the film breaks; none or one."""

    @abc.abstractmethod
    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> float:
        """Gap at which the film breaks [m]; inf for never."""
