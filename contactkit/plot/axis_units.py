"""Units of axes: those in which a quantity of some size reads best."""

from __future__ import annotations

from ..units import readable_unit

__all__ = ["axis_unit"]


def axis_unit(size: float, unit: str) -> tuple[float, str]:
    """Factor and name of the unit of an axis for a quantity of some size in an SI unit.

    As `units.readable_unit`, with the letters of print.

    Examples
    --------
    >>> axis_unit(2e-5, "m"), axis_unit(0.5, "rad")
    ((1e-06, 'µm'), (0.017453292519943295, '°'))
    """
    factor, name = readable_unit(size, unit)
    if name == "deg":
        return factor, "°"
    return factor, "µ" + name[1:] if name.startswith("u") else name
