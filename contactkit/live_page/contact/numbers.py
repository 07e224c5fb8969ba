"""Numbers of solved contacts over the load: as a report has them, with the error of the grid."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ...contact.functionals import FUNCTIONALS
from ...units import readable_unit
from ..assembly import readable

if TYPE_CHECKING:
    from ...contact.result import ContactResult
    from ...validity import ValidityNumber
    from .loads import GridErrors

__all__ = ["axis_of", "charts", "numbers_of", "shown_quantity", "validity_of"]

_IMPOSED = {"force": "load", "pressure": "mean pressure"}
_HIGHEST = 1.0  # relative error from which on a band says nothing
_ZERO = "0 on this grid, perhaps not on a finer one"


def shown_quantity(value: float, unit: str) -> str:
    """A quantity as a page prints it."""
    factor, name = readable_unit(value, unit)
    return f"{value / factor:.4g} {readable(name)}".strip()


def numbers_of(result: ContactResult, errors: GridErrors) -> list[dict[str, Any]]:
    """Numbers of a result, those of its report first, each with what its grid does to it."""
    found = []
    for name, (value, unit) in _scalars(result).items():
        error = errors.errors.get(name)
        remark = "" if error is None else _remark(error)
        found.append(
            {
                "name": name,
                "label": _label(name),
                "value": value if math.isfinite(value) else None,
                "unit": unit,
                "text": shown_quantity(value, unit),
                "remark": remark,
            }
        )
    return found


def _scalars(result: ContactResult) -> dict[str, tuple[float, str]]:
    """Numbers of a result, with the mean pressure on the area of contact and the mean gap."""
    found = {name: (float(value), unit) for name, (value, unit) in result.scalars().items()}
    if result.contact_area > 0.0:
        found["mean_contact_pressure"] = (result.load / result.contact_area, "Pa")
    if result.holes is None:  # whose gap is not known
        found["mean_gap"] = (FUNCTIONALS["mean_gap"].value(result), "m")
    return found


def _label(name: str) -> str:
    if name == "mean_contact_pressure":
        return "mean pressure on the contact"
    return name.replace("_", " ")


def _remark(error: float) -> str:
    return f"grid: \u00b1 {100.0 * error:.2g} %" if math.isfinite(error) else _ZERO


def validity_of(numbers: Sequence[ValidityNumber]) -> dict[str, Any]:
    """Numbers of validity that are known, and those that are not with the reason."""

    def bounded(value: float) -> float | None:
        return value if math.isfinite(value) else None

    return {
        "validity": [
            {
                "name": one.name,
                "value": one.value if math.isfinite(one.value) else None,
                "low": bounded(one.low),
                "high": bounded(one.high),
                "detail": one.detail,
            }
            for one in numbers
            if one.value is not None
        ],
        "missing": {one.name: one.detail for one in numbers if one.value is None},
    }


def charts(
    results: Sequence[ContactResult], errors: Sequence[GridErrors]
) -> tuple[list[dict[str, Any]], list[list[float]]]:
    """Curves over the load, and their rows: the load, then value and bounds of each curve.

    Areas are all that the effects have, and so are forces; maxima are those of pressure and stress.
    """
    known = [_scalars(result) for result in results]
    units = {n: u for n, (_, u) in known[0].items() if all(_is_known(n, one) for one in known)}
    wanted = {
        "areas": ("m2", [n for n, unit in units.items() if unit == "m2"]),
        "pressures": ("Pa", ["max_pressure", "mean_contact_pressure"]),
        "maxima of the stress": ("Pa", ["max_von_mises", "max_tension", "max_sigma_xz"]),
        "gap and approach": ("m", ["mean_gap", "approach"]),
        "forces": ("N", [n for n, u in units.items() if u == "N" and n != "load"]),
    }
    axis = results[0].plan.scene.loading.quantity
    rows = [[result.plan.scene.loading.quantity.value] for result in results]
    made = []
    for title, (unit, names) in wanted.items():
        series = []
        for name in names:
            if name not in units or name == axis.name:
                continue
            column = len(rows[0])
            for row, one, error in zip(rows, known, errors, strict=True):
                value, off = one[name][0], error.errors.get(name, 0.0)
                off = abs(value) * (off if off <= _HIGHEST else 0.0)
                row += [value, value - off, value + off]
            series.append({"label": _label(name), "name": name, "column": column})
        if series:
            made.append({"title": title, "unit": unit, "series": series})
    return made, rows


def _is_known(name: str, numbers: dict[str, tuple[float, str]]) -> bool:
    return name in numbers and math.isfinite(numbers[name][0])


def axis_of(result: ContactResult) -> dict[str, str]:
    """Imposed quantity: its field, its name, its unit."""
    name, _, unit = result.plan.scene.loading.quantity
    return {"name": name, "label": _IMPOSED.get(name, _label(name)), "unit": unit}
