"""The role of an effect in a sliding: a force along the bodies, over their travel."""

from __future__ import annotations

import abc
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from attrs import frozen

from ...scene.scenes import SlidingScene
from ..effects.base import SeparationEffect

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...scene.scenes import SeparationScene

__all__ = ["SlideLaw", "SlidingForce"]


class SlideLaw(NamedTuple):
    """A tangential force made ready, of all menisci together; arrays of travel [m] go in.

    `force` is called with (travel [m], speed [m/s]) and gives [N]. Called with (travel [m]),
    `impulse` gives the time integral [N.s] of a force that is proportional to speed, and `work`
    the work [J] of one that does not depend on it: no path in time changes either.
    """

    force: Callable[[Any, float], Any]
    impulse: Callable[[Any], Any] | None = None
    work: Callable[[Any], Any] | None = None


@frozen(kw_only=True)
class SlidingForce(SeparationEffect):
    """A force along the bodies of a `SlidingScene`; any number may act."""

    def lacks(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        if isinstance(scene, SlidingScene):
            return self.lacks_in(scene)
        return ("a SlidingScene: it acts along the bodies, not across the gap",)

    def lacks_in(self, scene: SlidingScene) -> tuple[str, ...]:
        """Name what this effect needs and a sliding scene does not give, with units."""
        return ()

    def cites(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `SeparationEffect.cites`."""
        return self.sources

    @abc.abstractmethod
    def prepare(self, scene: SlidingScene, accuracy: Accuracy) -> SlideLaw:
        """Do the work that depends on neither travel nor speed."""
