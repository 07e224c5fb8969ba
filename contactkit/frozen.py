"""A mapping that cannot be changed, but be copied and sent to another process."""

from __future__ import annotations

from typing import Any, NoReturn, TypeVar

__all__ = ["FrozenDict"]

_K = TypeVar("_K")
_V = TypeVar("_V")


class FrozenDict(dict[_K, _V]):
    """A dictionary that refuses to be changed.

    Unlike a ``mappingproxy`` it can be pickled and deep-copied.

    Examples
    --------
    >>> FrozenDict(gap=1e-9)["gap"] = 0.0
    Traceback (most recent call last):
    TypeError: a result cannot be changed; take dict(...) of it
    """

    __slots__ = ()

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("a result cannot be changed; take dict(...) of it")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self),)
