"""`cite`: the works behind a scene, a plan, a result, a curve, a study or a fit."""

from __future__ import annotations

from typing import Any

from ..errors import DescriptionError
from ..planning import plan
from ..scene.scenes import Scene
from .citations import Citations, citations_of
from .stated import data_sources

__all__ = ["cite"]


def cite(of: Any) -> Citations:
    """Return the works to cite for what was computed.

    They are those of the effects in the choices made, of the numerical methods, and of the data:
    materials, liquids at the properties in use, roughness. contactkit comes first. What rests on no
    published work is listed as such, in ``others``.

    Parameters
    ----------
    of : Scene, plan, Result, Curve, study or Fit
        What to cite for. A scene is planned. A saved curve or study states equations and methods,
        not the data of its scene.

    Returns
    -------
    Citations
        ``print`` shows the works and what each is for, ``bibtex()`` their entries.

    Raises
    ------
    DescriptionError
        If it is none of these.
    PlanError
        If a scene cannot be planned.

    Examples
    --------
    >>> import contactkit as ck
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Flat(radius=1e-3),
    ...         upper=ck.Flat(radius=1e-3),
    ...         meniscus=ck.Meniscus(liquid=ck.load_liquid("water"), volume=1e-11),
    ...     ),
    ...     loading=ck.ImposedSpeed(speed=1e-3, initial_gap=4e-6, final_gap=1e-5),
    ...     effects=(ck.MeniscusForce(),),
    ... )
    >>> found = ck.cite(scene)
    >>> found.keys
    ('contactkit', 'cai2008', 'orr1975', 'iapws2014')
    >>> found.works[-1].cited_for
    ('water, surface_tension: IAPWS R1-76(2014); constants and range are in the law',)
    """
    if isinstance(of, Scene):
        of = plan(of)  # type: ignore[call-overload]
    sources = getattr(of, "cite", None)
    if isinstance(of, type) or not callable(sources):
        raise DescriptionError(
            "of",
            of,
            "be a scene, a plan, a result, a curve, a study or a fit",
            hint="a file is read first: ck.load_scene, ck.load_result or ck.read_curve",
        )
    scene = getattr(getattr(of, "plan", of), "scene", None)
    stated = () if scene is None else data_sources(scene)
    return citations_of([*sources().splitlines(), *stated])
