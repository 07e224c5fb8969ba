r"""Rim of liquid that a fast opening leaves around a cavity on a face, over cell and gap.

While a cavity grows, liquid flows in from the rim alone, and the pressure falls from ambient to
that of the cavity over the width

.. math:: w = \sqrt{\frac{h^3 \Delta p}{6 \eta \dot h}}
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...validity import ValidityNumber

if TYPE_CHECKING:
    from .cavity import FaceCavity

__all__ = ["rim_numbers"]

_CELLS = 1.0
"""Cells in the rim: of the peak force of a rectangle 0.6 cells lose 2 %, 1.2 cells 0.5 %."""
_GAPS = 5.0  # widths of a film over its gap, as of a whole film: Reynolds' equation


def rim_numbers(
    cavity: FaceCavity, path: Sequence[tuple[float, float]]
) -> tuple[ValidityNumber, ...]:
    """Narrowest rim over a cell and over the gap, along gaps [m] and speeds [m/s].

    None of a film that does not cavitate as it opens.

    Examples
    --------
    >>> import contactkit as ck
    >>> oil = ck.Liquid(name="oil", viscosity=0.1)
    >>> face = ck.Flat(planform=ck.Rectangle(length=20e-3, width=10e-3))
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(upper=face, meniscus=ck.Meniscus(liquid=oil)),
    ...     loading=ck.ImposedSpeed(speed=5e-3, initial_gap=10e-6, final_gap=20e-6),
    ...     effects=(ck.ViscousForce(), ck.TensionLimit()),
    ... )
    >>> cavity = ck.plan(scene, ck.Accuracy(film_rtol=1e-2)).film.cavity
    >>> [round(float(number.value), 1) for number in rim_numbers(cavity, [(10e-6, 5e-3)])]
    [0.3, 18.4]
    """
    opening = [(gap, speed) for gap, speed in path if speed > 0.0]
    places = [place for place in opening if cavity.tension(*place) > cavity.strength]
    if not places:
        return ()
    widths = [
        (math.sqrt(gap**3 * cavity.drop / (6.0 * cavity.viscosity * speed)), gap)
        for gap, speed in places
    ]
    cell = max(cavity.grid.face.pixel_size)
    source = "w = sqrt(h^3 dp/(6 eta h'))"
    return (
        ValidityNumber(
            name="rim of liquid over a cell of its grid",
            value=min(width for width, _ in widths) / cell,
            low=_CELLS,
            detail="a film that opens fast keeps liquid in a narrow rim: with 1.2 cells in it "
            "0.5 % of the force are lost, with 0.6 cells 2 %; ask for a smaller Accuracy.film_rtol",
            source=source,
        ),
        ValidityNumber(
            name="rim of liquid over its gap",
            value=min(width / gap for width, gap in widths),
            low=_GAPS,
            detail="lubrication wants a rim much wider than high",
            source=source,
        ),
    )
