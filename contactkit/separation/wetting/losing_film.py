"""Forces of a film whose volume falls along the gap: interpolated between films of some volumes."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

from attrs import evolve

from ...numerics.roots import bracketed_root
from ..effects.force_law import ForceLaw
from ..film import Film

__all__ = ["films_of_volume", "lagrange", "losing_film", "volume_nodes"]

_NODES = 5  # Chebyshev's points of the volume: 1e-5 of the force where a third is lost
_KEPT = 4096  # gaps whose weights are kept: every law of the film asks for them
_KEPT_FILMS = 64  # of some steps of a motion: three stages, in some iterations
_NO_LOSS = 1e-12  # of the volume, which changes no force


def volume_nodes(last: float) -> tuple[float, ...]:
    """Volumes over that of the scene [-], from 1 down to the last one; 1 alone if none is lost.

    Examples
    --------
    >>> [round(x, 3) for x in volume_nodes(0.6)]
    [1.0, 0.941, 0.8, 0.659, 0.6]
    """
    if 1.0 - last <= _NO_LOSS:
        return (1.0,)
    middle, half = 0.5 * (1.0 + last), 0.5 * (1.0 - last)
    return tuple(middle + half * math.cos(math.pi * k / (_NODES - 1)) for k in range(_NODES))


def lagrange(nodes: Sequence[float], place: float) -> list[float]:
    """Weights of Lagrange's polynomials of some nodes at a place.

    Examples
    --------
    >>> lagrange((1.0, 0.5, 0.0), 0.5)
    [0.0, 1.0, -0.0]
    """
    found = []
    for i, node in enumerate(nodes):
        others = (other for j, other in enumerate(nodes) if j != i)
        found.append(math.prod((place - other) / (node - other) for other in others))
    return found


class _Volumes(NamedTuple):
    """Films of some volumes, and the volume along the gap."""

    nodes: tuple[float, ...]
    films: tuple[Film, ...]
    fraction: Callable[[float], float]

    @property
    def lengths(self) -> tuple[float, ...]:
        """Length of each film that its gap is over [m or -]: its end, or like the cube root."""
        if all(math.isfinite(film.end) for film in self.films):
            return tuple(film.end for film in self.films)
        return tuple(math.cbrt(node) for node in self.nodes)

    def end(self, part: float) -> float:
        """Gap at which the film of a volume ends [m]."""
        weights = lagrange(self.nodes, part)
        return sum(w * film.end for w, film in zip(weights, self.films, strict=True))

    def places(self) -> Callable[[float], list[tuple[float, float]]]:
        """Weight of each film at a gap, and the gap at which it is as far from its end."""
        lengths = self.lengths

        @lru_cache(maxsize=_KEPT)
        def at(gap: float) -> list[tuple[float, float]]:
            weights = lagrange(self.nodes, self.fraction(gap))
            per_length = gap / sum(map(operator.mul, weights, lengths))
            return [(w, one * per_length) for w, one in zip(weights, lengths, strict=True)]

        return at


def _law(laws: Sequence[ForceLaw], at: Callable[[float], list[tuple[float, float]]]) -> ForceLaw:
    """Law of a force from those of some volumes."""

    def force(gap: float, speed: float) -> float:
        each = zip(laws, at(gap), strict=True)
        return sum(weight * law.force(place, speed) for law, (weight, place) in each)

    return ForceLaw(force, rate=laws[0].rate)


def films_of_volume(whole: Film, films: Sequence[Film], least: float) -> Callable[[float], Film]:
    """Film of any part of the volume of the scene.

    Parameters
    ----------
    whole : Film
        With the volume of the scene.
    films : sequence of Film
        With the volumes of `volume_nodes`, of the least part.
    least : float
        Least part of the volume [-]; of less, the film is that of it.
    """
    volumes = _Volumes(volume_nodes(least), tuple(films), lambda gap: 1.0)
    lengths = volumes.lengths

    @lru_cache(maxsize=_KEPT_FILMS)
    def film_of(part: float) -> Film:
        if part >= 1.0:
            return whole
        weights = lagrange(volumes.nodes, max(part, least))
        length = sum(map(operator.mul, weights, lengths))
        parts = [(w, one / length) for w, one in zip(weights, lengths, strict=True)]
        laws = {
            kind: _of_part([film.laws[kind] for film in films], parts) if kind.needs_film else law
            for kind, law in whole.laws.items()
        }

        def end_at(gap: float, speed: float) -> float:
            each = zip(films, parts, strict=True)
            return sum(w * film.end_at(ratio * gap, speed) for film, (w, ratio) in each)

        end, first = whole.end, parts[0][1]
        return Film(
            MappingProxyType(laws),
            whole.limits,
            volumes.end(max(part, least)) if math.isfinite(end) else end,
            whole.full_gap,
            moving_ends=(end_at,) if whole.moving_ends else (),
            checks=tuple(_scaled(check, first) for check in whole.checks),
        )

    return film_of


def _scaled(check: Callable[[float, float], None], ratio: float) -> Callable[[float, float], None]:
    return lambda gap, speed: check(ratio * gap, speed)


def _of_part(laws: Sequence[ForceLaw], parts: Sequence[tuple[float, float]]) -> ForceLaw:
    """Law of a part of the volume: weight of each law, and the gap it is taken at over the gap."""
    each = [(law.force, weight, ratio) for law, (weight, ratio) in zip(laws, parts, strict=True)]

    def force(gap: float, speed: float) -> float:
        return sum(weight * one(ratio * gap, speed) for one, weight, ratio in each)

    return ForceLaw(force, rate=laws[0].rate, exponent=laws[0].exponent)


def losing_film(
    whole: Film, films: Sequence[Film], fraction: Callable[[float], float], last_gap: float
) -> Film:
    """Film of a volume that falls along the gap.

    Parameters
    ----------
    whole : Film
        With the volume of the scene.
    films : sequence of Film
        With the volumes of `volume_nodes`, of the least that is left.
    fraction : callable
        Volume over that of the scene [-] at a gap [m].
    last_gap : float
        Up to which it is known [m].

    Notes
    -----
    At the same fraction of its end a bridge of another volume has nearly the same shape (the same,
    between flats), so that forces are smooth in the volume, near the end, too. Forces of the solids
    stay as they are.
    """
    if len(films) == 1:
        return evolve(whole, volume_fraction=fraction)
    volumes = _Volumes(volume_nodes(fraction(last_gap)), tuple(films), fraction)
    at = volumes.places()
    laws = {
        kind: _law([film.laws[kind] for film in films], at) if kind.needs_film else law
        for kind, law in whole.laws.items()
    }
    end = whole.end
    if math.isfinite(end):
        end = volumes.end(fraction(last_gap))
        if end < last_gap:
            end = bracketed_root(lambda gap: volumes.end(fraction(gap)) / gap - 1.0, end, last_gap)
    return Film(
        MappingProxyType(laws), whole.limits, end, whole.full_gap, None, volume_fraction=fraction
    )
