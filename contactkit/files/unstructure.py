"""Scene objects to tables of plain values, and the names of their kinds in files."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import attrs

from ..contact.effects.attraction_laws import ATTRACTION_LAWS, AttractionLaw
from ..contact.effects.plasticity import HardnessMap
from ..contact.effects.registry import CONTACT_EFFECTS
from ..errors import DescriptionError
from ..liquids.liquid import LAWS
from ..liquids.temperature_laws import TemperatureLaw
from ..scene.effect import Effect, EffectRegistry
from ..scene.faces import FaceHole, SealedHole, Vent
from ..scene.interface import Body
from ..scene.loading import CONTACT_LOADINGS, SEPARATION_LOADINGS, SLIDING_LOADINGS, Loading
from ..scene.planforms import (
    Difference,
    Disc,
    Ellipse,
    Image,
    Intersection,
    Planform,
    Polygon,
    Rectangle,
    Ring,
    Sector,
    Union,
)
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
    "HOLE_KINDS",
    "LOADING_KINDS",
    "PLANFORM_KINDS",
    "SEPARATION_EFFECT_KINDS",
    "SURFACE_KINDS",
    "unstructure",
    "with_arrays",
]
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
_PLANFORMS: tuple[type[Planform], ...] = (
    Disc,
    Ring,
    Rectangle,
    Ellipse,
    Sector,
    Polygon,
    Image,
    Union,
    Intersection,
    Difference,
)
PLANFORM_KINDS: dict[str, type] = {kind.kind: kind for kind in _PLANFORMS}
HOLE_KINDS: dict[str, type] = {kind.kind: kind for kind in (Vent, SealedHole)}
LOADING_KINDS: dict[str, type[Loading]] = {kind.kind: kind for kind in _LOADINGS}
SEPARATION_EFFECT_KINDS: EffectRegistry[Effect] = EffectRegistry(
    SEPARATION_EFFECTS, SLIDING_EFFECTS
)
LAW_KINDS: dict[str, type] = {kind.kind: kind for kind in LAWS}
ATTRACTION_KINDS: dict[str, type] = {kind.kind: kind for kind in ATTRACTION_LAWS}


class _Family(NamedTuple):
    """A base class, the key in a file that names the kind, the kinds, and the cure for others."""

    base: type
    tag: str
    kinds: Mapping[str, type]
    cure: str


_FAMILIES = (
    _Family(
        Surface,
        "shape",
        SURFACE_KINDS,
        "save its heights as .npy and use Measured(path=..., pixel_size=..., unit='m')",
    ),
    _Family(Loading, "kind", LOADING_KINDS, "use one of these"),
    _Family(
        TemperatureLaw,
        "law",
        LAW_KINDS,
        "use one of these, or the number at the temperature of the scene",
    ),
    _Family(AttractionLaw, "law", ATTRACTION_KINDS, "use one of these"),
    _Family(Planform, "shape", PLANFORM_KINDS, "draw it: Image(coverage=..., pixel_size=...)"),
    _Family(FaceHole, "kind", HOLE_KINDS, "use one of these"),
)
# Fields that may hold an array, and their alternative in a file.
ARRAY_FIELDS: dict[tuple[type, str], str] = {
    (Image, "coverage"): "compose the planform of others; an image is kept in Python and in result "
    "files",
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


def unstructure(value: Any, arrays: Arrays | None = None, *, for_key: bool = False) -> Any:
    """Convert attrs objects to tables of plain values; defaults are left out.

    Parameters
    ----------
    value : object
        A scene, or a part of one.
    arrays : dict, optional
        Where arrays go, under a key that is made from their content and stands for them in the
        tables. None: arrays are refused.
    for_key : bool
        Whether the tables are to tell scenes apart, not to be read: a class of one's own is named.

    Raises
    ------
    DescriptionError
        If there is something that the tables could not hold whole: an array and no place for it, a
        surface, law or effect of one's own, a function; says what to use instead.
    """
    return _Tables(arrays, for_key).of(value, type(value).__name__)


class _Tables(NamedTuple):
    """Conversion of objects to tables; `place` is the path of an object, for messages."""

    arrays: Arrays | None
    for_key: bool

    def of(self, value: Any, place: str) -> Any:
        if isinstance(value, Body) and type(value) is Body and value.solid is None:
            return self.of(value.surface, place)  # a rigid body is written as its surface
        if attrs.has(type(value)):
            return self._table(value, place)
        if isinstance(value, tuple | list):
            return [self.of(item, f"{place}[{i}]") for i, item in enumerate(value)]
        if isinstance(value, Mapping):
            return {str(key): self.of(item, f"{place}.{key}") for key, item in value.items()}
        plain = value.item() if hasattr(value, "dtype") and not value.ndim else value
        if not isinstance(plain, bool | int | float | str):
            hint = "keep the scene in Python, where pickle may hold it"
            raise DescriptionError(place, value, "be a number, a text, or true or false", hint=hint)
        return plain

    def _table(self, value: Any, place: str) -> dict[str, Any]:
        kind = type(value)
        if "__attrs_attrs__" not in vars(kind):
            hint = f"decorate {kind.__name__} with @attrs.frozen(kw_only=True)"
            raise DescriptionError(place, value, "have fields, to be written as a table", hint=hint)
        table = self._tagged(value, place)
        for a in attrs.fields(kind):
            item = getattr(value, a.name)
            if getattr(item, "ndim", 0):
                table[a.alias] = _put_away(item, kind, a.name, self.arrays)
            elif a.init and item is not None and item != a.default:
                table[a.alias] = self.of(item, f"{place}.{a.alias}")
        return table

    def _tagged(self, value: Any, place: str) -> dict[str, Any]:
        """Key and name of the kind of an object, if it is one of several."""
        kind = type(value)
        own = {"class": f"{kind.__module__}.{kind.__qualname__}"} if self.for_key else {}
        if isinstance(value, Effect):
            if any(kind in one for one in (SEPARATION_EFFECT_KINDS, CONTACT_EFFECTS)):
                return {"effect": value.name}
            if own:
                return own
            hint = f"register it first: ck.register_effect({kind.__name__})"
            raise DescriptionError(place, value, "be an effect that files can name", hint=hint)
        for family in _FAMILIES:
            if not isinstance(value, family.base):
                continue
            for name, one in family.kinds.items():
                if one is kind:
                    return {family.tag: name}
            if own:
                return own
            known = ", ".join(one.__name__ for one in family.kinds.values())
            raise DescriptionError(
                place, value, f"be of a kind that files have: {known}", hint=family.cure
            )
        return own


def _put_away(item: Any, kind: type, name: str, arrays: Arrays | None) -> str:
    if arrays is None:
        raise DescriptionError(
            f"{kind.__name__}.{name}",
            f"an array of shape {item.shape}",
            "not be an array, to be written as text",
            hint=ARRAY_FIELDS.get((kind, name), "it is kept in Python and in result files"),
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
