"""Scene objects to tables of plain values, and the names of their kinds in files."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import attrs

from ..contact.effects.attraction_laws import ATTRACTION_LAWS
from ..contact.effects.plasticity import HardnessMap
from ..errors import DescriptionError
from ..liquids.liquid import LAWS
from ..scene.effect import Effect, EffectRegistry
from ..scene.interface import Body
from ..scene.loading import CONTACT_LOADINGS, SEPARATION_LOADINGS, SLIDING_LOADINGS, Loading
from ..scene.rough_surfaces import (
    CombinedSurface,
    GaussianRoughness,
    Heights,
    Measured,
    SelfAffineRoughness,
)
from ..scene.surfaces import Flat, Paraboloid, Sphere, Surface, Wave
from ..separation.effects.registry import SEPARATION_EFFECTS
from ..separation.sliding.effects import SLIDING_EFFECTS

__all__ = [
    "ARRAY_FIELDS",
    "ATTRACTION_KINDS",
    "LAW_KINDS",
    "LOADING_KINDS",
    "SEPARATION_EFFECT_KINDS",
    "SURFACE_KINDS",
    "unstructure",
    "with_arrays",
]
from .face_tables import DAMPING_KINDS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[np.float64]]

_SURFACES: tuple[type[Surface], ...] = (
    Flat,
    Sphere,
    Paraboloid,
    Wave,
    GaussianRoughness,
    SelfAffineRoughness,
    Measured,
    Heights,
    CombinedSurface,
)
_LOADINGS: tuple[type[Loading], ...] = (*SEPARATION_LOADINGS, *CONTACT_LOADINGS, *SLIDING_LOADINGS)
SURFACE_KINDS: dict[str, type] = {kind.kind: kind for kind in _SURFACES}
LOADING_KINDS: dict[str, type[Loading]] = {kind.kind: kind for kind in _LOADINGS}
SEPARATION_EFFECT_KINDS: EffectRegistry[Effect] = EffectRegistry(
    SEPARATION_EFFECTS, SLIDING_EFFECTS
)
LAW_KINDS: dict[str, type] = {kind.kind: kind for kind in LAWS}
ATTRACTION_KINDS: dict[str, type] = {kind.kind: kind for kind in ATTRACTION_LAWS}
_TAGS: tuple[tuple[str, Mapping[str, type]], ...] = (
    ("shape", SURFACE_KINDS),
    ("kind", LOADING_KINDS),
    ("law", LAW_KINDS),
    ("law", ATTRACTION_KINDS),
    ("law", DAMPING_KINDS),
)
# Fields that may hold an array, and their alternative in a file.
ARRAY_FIELDS: dict[tuple[type, str], str] = {
    (Heights, "heights"): "save the array as .npy and use Measured(path=..., pixel_size=..., "
    "unit='m', detrend='none'), in a file shape = 'measured'",
    (Heights, "holes"): "fill the holes, save the array as .npy and use Measured(path=...); a map "
    "with holes is kept in Python and in result files",
    (
        HardnessMap,
        "values",
    ): "a scene file holds a uniform hardness; a map is kept in Python and in result files",
}

_ARRAY = "scene-array-"  # prefix of the keys of arrays, which no other array of a result has


def unstructure(value: Any, arrays: Arrays | None = None) -> Any:
    """Convert attrs objects to tables of plain values; defaults are left out.

    Parameters
    ----------
    value : object
        A scene, or a part of one.
    arrays : dict, optional
        Where arrays go, under a key that is made from their content and stands for them in the
        tables. None: arrays are refused.

    Raises
    ------
    DescriptionError
        If there is an array and no place for it; says what to use instead.
    """
    if isinstance(value, Body) and value.solid is None:
        return unstructure(value.surface, arrays)  # a rigid body is written as its surface
    if attrs.has(type(value)):
        table: dict[str, Any] = {}
        for tag, kinds in _TAGS:
            names = [name for name, kind in kinds.items() if type(value) is kind]
            table |= dict.fromkeys([tag], names[0]) if names else {}
        if isinstance(value, Effect):
            table["effect"] = value.name
        for a in attrs.fields(type(value)):
            item = getattr(value, a.name)
            if getattr(item, "ndim", 0):
                table[a.alias] = _put_away(item, type(value), a.name, arrays)
            elif a.init and item is not None and item != a.default:
                table[a.alias] = unstructure(item, arrays)
        return table
    if isinstance(value, tuple | list):
        return [unstructure(item, arrays) for item in value]
    return value


def _put_away(item: Any, kind: type, name: str, arrays: Arrays | None) -> str:
    if arrays is None:
        raise DescriptionError(
            f"{kind.__name__}.{name}",
            f"an array of shape {item.shape}",
            "not be an array, to be written as text",
            hint=ARRAY_FIELDS[kind, name],
        )
    shape = "x".join(map(str, item.shape))
    key = f"{_ARRAY}{shape}-{hashlib.sha256(item.tobytes()).hexdigest()}"
    arrays[key] = item
    return key


def with_arrays(tables: Any, arrays: Mapping[str, Any]) -> Any:
    """Put arrays back into tables, in place of their keys."""
    if isinstance(tables, Mapping):
        return {name: with_arrays(item, arrays) for name, item in tables.items()}
    if isinstance(tables, list):
        return [with_arrays(item, arrays) for item in tables]
    stands_for_one = isinstance(tables, str) and tables.startswith(_ARRAY)
    return arrays.get(tables, tables) if stands_for_one else tables
