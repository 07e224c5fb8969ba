"""Parts of frozen objects: a mapping that cannot be changed, equality of fields with arrays."""

from __future__ import annotations

from typing import Any, NoReturn, TypeVar

from attrs import cmp_using

__all__ = ["SAME_NUMBERS", "FrozenDict"]

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


def _same(one: Any, other: Any) -> bool:
    import numpy as np

    return one is other or bool(np.array_equal(one, other))


SAME_NUMBERS = cmp_using(eq=_same)
"""Equality of a field that holds an array, ``field(eq=SAME_NUMBERS, hash=False)``.

Without it a class with an array would have to leave out its equality, and then has that of its base
class, by which all of its objects are equal.
"""
