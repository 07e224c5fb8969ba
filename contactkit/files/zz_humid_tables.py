"""A humidity in the tables of a scene, turned into the pressure of the meniscus it condenses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import attrs

from ..scene.meniscus import Meniscus
from ..scene.scenes import SeparationScene
from ..units import parse_quantity
from .structure import FileError, field_value

__all__ = ["without_humidity"]

_KEY = "relative_humidity"


def without_humidity(tables: Mapping[str, Any], origin: str) -> Mapping[str, Any]:
    """Tables in which ``interface.meniscus.relative_humidity`` has become its ``pressure``.

    Kelvin's equation is taken at the ``temperature`` of the scene; see `Meniscus.from_humidity`.
    What has no such key comes back as it is.

    Parameters
    ----------
    tables : mapping
        As read from a scene file.
    origin : str
        Where they come from, for messages.

    Raises
    ------
    DescriptionError
        If a pressure or a volume stands beside the humidity, or it is not a share.
    InfeasibleError
        At no vapour, where nothing condenses, and at saturation, where all is flooded.

    Examples
    --------
    >>> water = {"name": "water", "density": 998.2, "molar_mass": 0.018015}
    >>> tables = {"interface": {"meniscus": {"liquid": water, "relative_humidity": "50 %"}}}
    >>> f"{without_humidity(tables, 'moist.toml')['interface']['meniscus']['pressure']:.4g}"
    '-9.361e+07'
    """
    interface = tables.get("interface")
    meniscus = interface.get("meniscus") if isinstance(interface, Mapping) else None
    if not isinstance(interface, Mapping) or not isinstance(meniscus, Mapping):
        return tables
    if _KEY not in meniscus:
        return tables
    where = f"  at interface.meniscus.{_KEY}"
    for other in ("volume", "pressure"):
        if other in meniscus:
            raise FileError(origin, f"give {_KEY} or {other}, not both{where}")
    if "liquid" not in meniscus:
        return tables  # what is missing is said with everything else
    temperature = attrs.fields(SeparationScene).temperature.default
    assert temperature is not None  # the room
    if "temperature" in tables:
        temperature = float(field_value(SeparationScene, "temperature", tables["temperature"]))
    share = parse_quantity(meniscus[_KEY], "-", f"{origin}: interface.meniscus.{_KEY}")
    condensed = Meniscus.from_humidity(
        liquid=field_value(Meniscus, "liquid", meniscus["liquid"]),
        relative_humidity=share,
        temperature=temperature,
    )
    left = {key: value for key, value in meniscus.items() if key != _KEY}
    return {
        **tables,
        "interface": {**interface, "meniscus": {**left, "pressure": condensed.pressure}},
    }
