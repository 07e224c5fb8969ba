"""Sources that a scene states of its data: materials, liquids and their laws, roughness."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs

from ..liquids.liquid import Liquid
from ..scene.effect import Effect
from ..scene.scenes import Scene

__all__ = ["data_sources"]

# Fields of a liquid that make up a property that effects ask for.
_MADE_OF = {"viscosity": ("viscosity", "kinematic_viscosity", "density")}


def data_sources(scene: Any) -> tuple[str, ...]:
    """Return the sources of the data of a scene, each with what it is of.

    Of a liquid those of the properties that the effects ask for; of a device, which has scenes of
    its own, of all. Effects state their own sources.

    Examples
    --------
    >>> import contactkit as ck
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(lower=ck.Body(solid=ck.load_material("dlc")), upper=ck.Flat()),
    ...     window=ck.Window(width=1e-6),
    ...     loading=ck.Pressing(pressure=1e6),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> data_sources(scene)[0][:60]
    'diamond-like carbon: diamond-like carbon overcoat, Table 2.1'
    """
    needs = None
    if isinstance(scene, Scene):
        needs = {need for one in scene.effects for need in one.liquid_needs(scene)}
    parts = [getattr(scene, one.name) for one in attrs.fields(type(scene))]
    return tuple(dict.fromkeys(line for one in parts for line in _stated(one, "", needs)))


def _stated(value: Any, place: str, needs: set[str] | None) -> Iterator[str]:
    """Sources of an object and of what it is made of; `place` is its field in a named object."""
    if isinstance(value, tuple):
        for one in value:
            yield from _stated(one, place, needs)
        return
    if isinstance(value, Effect) or not attrs.has(type(value)):
        return
    own = getattr(value, "name", "")
    name = own if isinstance(own, str) else ""
    source = getattr(value, "source", "")
    if isinstance(source, str) and source.strip():
        yield f"{name or place or _kind(value)}: {' '.join(source.split())}"
    fields = None if needs is None or not isinstance(value, Liquid) else _read(value, needs)
    for one in attrs.fields(type(value)):
        if fields is None or one.name in fields:
            inner = f"{name}, {one.name}" if name else ""
            yield from _stated(getattr(value, one.name), inner, needs)


def _kind(value: Any) -> str:
    return str(getattr(type(value), "kind", type(value).__name__))


def _read(liquid: Liquid, needs: set[str]) -> set[str]:
    """Fields of a liquid that the effects of its scene read."""
    fields = {part for need in needs for part in _MADE_OF.get(need, (need,))}
    if liquid.kinematic_viscosity is None and "density" not in needs:
        fields.discard("density")
    return fields
