"""Load-displacement tables of an end stop, which an FMU carries beside its start values.

Here contacts are solved, with numpy; the FMU gets numbers only. So this module is called by
`contactkit.fmu.python.build` and never imported by a slave.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...errors import DescriptionError
from ...models.end_stop.solve import curve_of_scene

__all__ = ["bake", "default_curve"]

STOP_AREA = 10e-6  # [m2], assumption: a shoulder 0.5 mm wide around the spool of the injector


def default_curve() -> LoadDisplacementCurve:
    """Curve of the scene ``contact-stop`` of this package, for its window."""
    return curve_of_scene("contact-stop")


def bake(name: str, start: dict[str, Any]) -> dict[str, Any]:
    """Take the tables out of what is given to a build, and fill in what follows from them.

    Parameters
    ----------
    name : str
        ``contact-stop``, which has a curve of its own if none is given, ``valve-drive``, whose
        stop is a spring without one, or ``tip-contact``, whose site is rigid without one.
    start : dict
        What is given; loses its ``curve``.

    Returns
    -------
    dict
        The data of the build.

    Raises
    ------
    DescriptionError
        If the curve is none.
    """
    curve = start.pop("curve", None)
    if curve is None and name != "contact-stop":
        return {}
    if curve is None:
        curve = default_curve()
        start.setdefault("scale", STOP_AREA / curve.nominal_area)
    if isinstance(curve, Mapping):
        curve = LoadDisplacementCurve.from_data(curve)
    if not isinstance(curve, LoadDisplacementCurve):
        expected = "be a LoadDisplacementCurve, as contactkit.load_displacement makes it"
        raise DescriptionError("curve", curve, expected)
    return {"curve": curve.to_data()}
