"""Choice of the parts of a rheology that a film computes, with the size of what is left out.

Each part of a liquid, its viscosity over pressure and that over shear, is tried alone on the
motion that the loading lets expect. One that changes the force by less than `WORTH` anywhere is
left out, and how much it changes is stated. Slip is given with the bodies and always computed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from attrs import field, frozen

from ...errors import PlanError
from ...scene.loading import ImposedForce, ImposedSpeed, ImposedTime
from ..film import balance_speed
from .changes import PARTS, WORTH, film_of, force_change
from .film import RheologicalFilm
from .prepared_film import PreparedFilm
from .validity import rheology_numbers

if TYPE_CHECKING:
    from ...scene.loading import SeparationLoading
    from ...scene.scenes import SeparationScene
    from ...validity import ValidityNumber
    from ..effects.prepared import PreparedScene
    from ..effects.viscous import ViscousForce
    from .face import FaceRheology

__all__ = ["FilmRheology", "film_rheology"]

_GAPS = 17  # of the expected motion: a change of the force is known to a tenth of itself
_TINY = 1e-300  # in place of a force of zero, as of a film without a radius
# Reach of tables beyond the motion that is expected under a force; what lies farther is computed
# directly.
_NEARER, _FARTHER, _FASTER = 0.3, 1.5, 30.0
_EDGE = 1.0 + 1e-9  # rounding of the ends of a motion
_FASTEST = 1e6  # [1/s], where no motion is expected


@frozen(eq=False)
class FilmRheology:
    """Rheology of the film of a scene: what its force computes, and what it leaves out.

    Parameters
    ----------
    computed : tuple of str
        Parts of the liquid that the force computes.
    left_out : tuple of str
        Parts that it does not.
    changes : mapping
        What each part changes the force by, alone, on the expected motion [-].
    film : PreparedFilm, optional
        The film with what is computed. None: it is Newtonian and does not slip.
    """

    computed: tuple[str, ...]
    left_out: tuple[str, ...]
    changes: Mapping[str, float] = field(factory=dict)
    film: PreparedFilm | None = None

    @property
    def is_linear(self) -> bool:
        """Whether the force is proportional to the speed."""
        return not self.computed

    @property
    def notes(self) -> tuple[str, ...]:
        """Parts that are computed and left out, in sentences."""
        words = dict(PARTS)
        found = []
        for name in (*self.computed, *self.left_out):
            what = "computed" if name in self.computed else "left out"
            size = ""
            if name in self.changes:
                size = f": alone it changes the force by {_per_cent(self.changes[name])} at most"
            found.append(f"{words[name]} is {what}{size}")
        return tuple(found)

    def again(self, prepared: PreparedScene[SeparationScene]) -> FilmRheology | None:
        """The same choice for another volume of the liquid, of a prepared scene."""
        return film_rheology(prepared, self.computed)

    def numbers(
        self, prepared: PreparedScene[SeparationScene], path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """Ranges along gaps [m] and speeds [m/s]."""
        return rheology_numbers(prepared, self, path)


def _per_cent(change: float) -> str:
    return f"{100.0 * change:.2g} %"


def film_rheology(
    prepared: PreparedScene[SeparationScene], computed: tuple[str, ...] | None = None
) -> FilmRheology | None:
    """Rheology of the film of a scene; None for a Newtonian liquid that does not slip.

    `computed` are the parts that a film of more liquid computes; None: they are chosen.

    Raises
    ------
    PlanError
        If the film is one that it is not known for: between rough faces, or with a cavity that is
        followed.
    """
    from ..effects.viscous import ViscousForce

    scene = prepared.scene
    viscous, liquid = scene.effect(ViscousForce), scene.meniscus.liquid
    given = tuple(part.name for part in PARTS if getattr(liquid, part.name) is not None)
    if viscous is None or not (given or scene.meniscus.slips):
        return None
    path = _expected(prepared)
    changes = {} if path is None else {one: force_change(prepared, one, path) for one in given}
    if computed is None:
        computed = _computed(viscous, given, changes)
    left = tuple(name for name in given if name not in computed)
    if not computed and not scene.meniscus.slips:
        return FilmRheology((), left, changes)
    _check_film(prepared, computed, changes)
    film = _made(prepared, film_of(prepared, computed), path)
    return FilmRheology(computed, left, changes, film)


def _reach(loading: SeparationLoading) -> tuple[float, float]:
    """Gaps [m] that the tables of a film hold: those of the motion, and more if not imposed."""
    low, high = loading.smallest_gap or 1e-3 * loading.final_gap, loading.final_gap
    if isinstance(loading, ImposedForce):
        low, high = _NEARER * low, _FARTHER * high
    return low / _EDGE, high * _EDGE


def _made(
    prepared: PreparedScene[SeparationScene],
    film: RheologicalFilm | FaceRheology,
    path: list[tuple[float, float]] | None,
) -> PreparedFilm:
    """Film with tables over the motion that is expected, and over more where it is not imposed."""
    loading, reach = prepared.scene.loading, _reach(prepared.scene.loading)
    # On a face an estimate: a search goes to any speed, and solves nothing.
    force = film.force if isinstance(film, RheologicalFilm) else film.bounded_force
    fastest = max((film.shear_per_speed(h) * abs(v) for h, v in path or ()), default=0.0)
    if isinstance(loading, ImposedForce):
        if loading.force > 0.0:  # a liquid that thins opens faster
            for gap in (loading.initial_gap, loading.final_gap):
                speed = balance_speed(partial(force, gap), loading.force)
                fastest = max(fastest, film.shear_per_speed(gap) * speed)
        fastest = _FASTER * (fastest or _FASTEST)
    if not isinstance(film, RheologicalFilm):
        from .face import resolved

        moving = [(gap, speed) for gap, speed in path or () if speed != 0.0]
        some = moving or [(reach[0], _FASTEST / film.shear_per_speed(reach[0]))]
        film = resolved(film, some, prepared.accuracy.film_rtol, fastest)
    return PreparedFilm(film, reach, fastest * _EDGE)


def _computed(
    viscous: ViscousForce, given: tuple[str, ...], changes: Mapping[str, float]
) -> tuple[str, ...]:
    if viscous.rheology == "newtonian" or viscous.takes_printed():
        return ()
    if viscous.rheology == "all":
        return given
    return tuple(name for name in given if not changes.get(name, math.inf) < WORTH)


def _check_film(
    prepared: PreparedScene[SeparationScene],
    computed: tuple[str, ...],
    changes: Mapping[str, float],
) -> None:
    """Refuse films whose flow is not known for such a liquid."""
    from ..face.shape import on_face

    scene, words = prepared.scene, dict(PARTS)
    what = " and ".join([words[name] for name in computed] or ["slip at the walls"])
    sizes = ", ".join(f"{_per_cent(changes[name])}" for name in computed if name in changes)
    size = f" (it changes the force by {sizes})" if sizes else ""
    cure = (
        'ViscousForce(rheology="newtonian") leaves it out'
        if computed
        else "leave the slip lengths of the meniscus out"
    )
    if (scene.interface.has_discs and on_face(scene)) or _is_rough(scene):
        raise PlanError(
            f"ViscousForce knows {what}{size} between smooth faces, not with FineRoughness, a "
            f"relief, or a cavity that is followed: flow factors and cells with a void are those "
            f"of a Newtonian liquid that does not slip; {cure}"
        )


def _is_rough(scene: SeparationScene) -> bool:
    faces = scene.interface.faces
    return any(face.roughness is not None or face.relief is not None for face in faces)


def _expected(prepared: PreparedScene[SeparationScene]) -> list[tuple[float, float]] | None:
    """Gaps [m] and speeds [m/s] that the loading lets expect; None if it says none.

    Under a force those at which a Newtonian film alone balances it, and the initial speed where
    that is higher: inertia and a meniscus only slow an opening.
    """
    loading = prepared.scene.loading
    low = loading.smallest_gap or 1e-3 * loading.final_gap
    step = (loading.final_gap / low) ** (1.0 / (_GAPS - 1))
    gaps = [low * step**i for i in range(_GAPS)]
    if isinstance(loading, ImposedSpeed):
        shaken = loading.vibration
        swing = math.tau * shaken.frequency * shaken.amplitude if shaken is not None else 0.0
        speeds = {loading.speed + swing, loading.speed - swing}
        return [(gap, speed) for gap in gaps for speed in speeds]
    if isinstance(loading, ImposedTime):
        speed = (loading.final_gap - loading.initial_gap) / loading.time
        return [(gap, speed) for gap in gaps]
    if not isinstance(loading, ImposedForce) or (loading.force == loading.initial_speed == 0.0):
        return None
    plain = film_of(prepared, ())
    balance = [loading.force / max(plain.newtonian_force(gap, 1.0), _TINY) for gap in gaps]
    first = loading.initial_speed
    found = [(gap, max(speed, first, key=abs)) for gap, speed in zip(gaps, balance, strict=True)]
    return found if first >= 0.0 else found + [(gap, first) for gap in gaps]
