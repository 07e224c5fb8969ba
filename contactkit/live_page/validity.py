"""Numbers of validity for a page: not written down again, but measured on the plan.

Each number of a plan is asked at single gaps and speeds. Where it is a function of the gap times a
power of the speed, and of the properties of the liquid, the page takes the worst of the rows of its
motion from a table over the gap; where that does not give what the plan says of the whole run, the
number is named as one that a page does not have.
"""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, Literal, NamedTuple

from attrs import evolve, frozen

from ..accuracy import Accuracy
from ..liquids.liquid import Liquid
from ..scene.scenes import SeparationScene
from ..separation.effects.base import FilmLimit
from ..separation.effects.viscous import TensionLimit
from ..separation.plan import Plan, plan
from ..validity import ValidityNumber

__all__ = ["POINTS", "Rule", "Rules", "gaps_of", "logs_of", "rules_of"]

_SPEEDS = (1e-6, 1e-3, 1.0)  # [m/s]: a power law of the speed shows over six decades
_FAST = 1e9  # [m/s], at which any film is at its strength
_SAME = 1e-6  # relative, of what counts as a power law
_CLOSE = 0.03  # relative, of a table of the gap: validity is printed with three digits
POINTS = 7  # gaps of a table on each side of that up to which the film is full
_NOTHING = 1e-300  # in place of zero, whose logarithm is no number


@frozen(kw_only=True)
class Rule:
    """A number as the worst along a motion of table(gap) speed^power, times powers of a liquid."""

    name: str
    low: float
    high: float
    detail: str
    worst: Literal["largest", "smallest"]
    speed_power: int
    opening_only: bool
    liquid: Mapping[str, float]
    is_bounded: bool
    """Whether the strength of the liquid bounds it, by a table of its own."""


class Rules(NamedTuple):
    """Numbers of a page, and those it does not have, with the reason."""

    rules: tuple[Rule, ...]
    missing: Mapping[str, str]


def unlimited(scene: SeparationScene) -> SeparationScene:
    """Scene without limits of the liquid."""
    kept = tuple(e for e in scene.effects if not isinstance(e, FilmLimit))
    return evolve(scene, effects=kept)


def _at(made: Plan, gap: float, speed: float) -> dict[str, ValidityNumber]:
    return {one.name: one for one in made.validity([(gap, speed)])}


def rules_of(scene: SeparationScene, accuracy: Accuracy, gap: float) -> Rules:
    """Find out how each number follows the motion and the liquid, at a gap [m]."""
    made = plan(unlimited(scene), accuracy)
    rules, missing = list[Rule](), dict[str, str]()
    limited = plan(scene, accuracy)
    scaled = {name: plan(s, accuracy) for name, s in _scaled_liquids(made).items()}
    for name, one in _at(made, gap, _SPEEDS[0]).items():
        detail = re.sub(r", about [^,;]* of the force", "", one.detail)
        if one.value is None:
            missing[name] = detail
            continue
        values = [_at(made, gap, speed)[name].value or 0.0 for speed in _SPEEDS]
        power = _power(values, _SPEEDS)
        if power is None:
            missing[name] = "it is no power of the speed; contactkit run evaluates it"
            continue
        liquid = {
            key: math.log2((_at(other, gap, _SPEEDS[0])[name].value or 0.0) / values[0])
            for key, other in scaled.items()
            if values[0]
        }
        fast = _at(limited, gap, _FAST)[name].value or 0.0
        rules.append(
            Rule(
                name=name,
                low=one.low,
                high=one.high,
                detail=detail,
                worst="smallest" if math.isfinite(one.low) and one.low >= 0.0 else "largest",
                speed_power=power,
                opening_only=not (_at(made, gap, -_SPEEDS[0])[name].value or 0.0),
                liquid={key: round(x, 9) for key, x in liquid.items() if abs(x) > _SAME},
                is_bounded=fast < 0.999 * values[0] * (_FAST / _SPEEDS[0]) ** power,
            )
        )
    return Rules(tuple(rules), missing)


def _power(values: Sequence[float], speeds: Sequence[float]) -> int | None:
    """Whole power of the speed that values follow; None if none does."""
    if not all(value > 0.0 for value in values):
        return 0 if len(set(values)) == 1 else None
    found = {
        math.log(b / a) / math.log(v / u)
        for (a, b), (u, v) in zip(pairwise(values), pairwise(speeds), strict=True)
    }
    power = round(next(iter(found)))
    return power if all(abs(one - power) < _SAME for one in found) else None


def _scaled_liquids(made: Plan) -> dict[str, SeparationScene]:
    """Scenes with a property of the liquid doubled, by its name."""
    scene, state = made.scene, made.prepared.liquid
    if scene.meniscus.has_pressure:
        return {}  # what its temperature moves is in the tables over a grid
    known = {
        name: value
        for name in ("viscosity", "surface_tension", "density")
        if (value := state.given(name)) is not None
    }
    more: dict[str, Any] = {**known, "bulk_modulus": state.given("bulk_modulus")}
    made_of = {
        name: Liquid(**{**more, name: 2.0 * value}, name=name) for name, value in known.items()
    }
    return {
        name: evolve(
            scene,
            interface=evolve(scene.interface, meniscus=evolve(scene.meniscus, liquid=liquid)),
        )
        for name, liquid in made_of.items()
    }


def gaps_of(made: Plan, low: float, high: float) -> list[float]:
    """Gaps of the tables [m], with one where the film leaves the rim of the faces."""
    high = min(high, 0.999 * made.film.end)
    full = min(max(made.film.full_gap, low * 1.02), high / 1.02)
    parts = [
        [a * (b / a) ** (i / (POINTS - 1)) for i in range(POINTS)]
        for a, b in pairwise((low, full, high))
    ]
    return parts[0] + parts[1]


def logs_of(
    scene: SeparationScene, accuracy: Accuracy, rules: Rules, span: tuple[float, float]
) -> list[float]:
    """Logarithms of the gaps, then of each number there at 1 m/s, and of its bound."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        limited = plan(scene, accuracy)
        made = plan(unlimited(scene), accuracy)
    gaps = gaps_of(limited, *span)
    found = [math.log(gap) for gap in gaps]
    slow = [_at(made, gap, _SPEEDS[1]) for gap in gaps]
    fast = [_at(limited, gap, _FAST) for gap in gaps]
    for rule in rules.rules:
        unit = _SPEEDS[1] ** rule.speed_power
        found += [_log((at[rule.name].value or 0.0) / unit) for at in slow]
        if rule.is_bounded:
            found += [_log(at[rule.name].value or 0.0) for at in fast]
    return found


def _log(value: float) -> float:
    return math.log(max(value, _NOTHING))


def strength_of(scene: SeparationScene) -> float:
    """Tension at which the liquid cavitates [Pa]; 0 if it never does."""
    limit = scene.effect(TensionLimit)
    return 0.0 if limit is None else limit.tension


def checked(
    rules: Rules, logs: Sequence[float], path: Any, found: Sequence[ValidityNumber]
) -> Rules:
    """Rules that give what a plan says of a whole run; the others with the reason.

    `path` has the gaps and speeds of the run while the film spans the gap.
    """
    known = {one.name: one.value for one in found}
    kept, missing = list[Rule](), dict(rules.missing)
    for i, rule in enumerate(rules.rules):
        value, right = worst_of(rules, logs, i, path), known.get(rule.name)
        size = abs(right or 0.0)
        if right is None or abs(value - right) > _CLOSE * size + 1e-12:
            missing[rule.name] = "it depends on the whole motion; contactkit run evaluates it"
        else:
            kept.append(rule)
    return Rules(tuple(kept), missing)


def worst_of(rules: Rules, logs: Sequence[float], index: int, path: Any) -> float:
    """Number `index` along pairs of gap and speed; as ``template/tables.js``."""
    count, rule = 2 * POINTS, rules.rules[index]
    at = count * (1 + sum(1 + one.is_bounded for one in rules.rules[:index]))
    worst = 0.0 if rule.worst == "largest" else math.inf
    for gap, speed in path:
        if (rule.opening_only and speed <= 0.0) or (rule.speed_power < 0 and speed == 0.0):
            continue
        value = _between(logs, at, count, gap)
        value *= abs(speed) ** rule.speed_power
        if rule.is_bounded:
            value = min(value, _between(logs, at + count, count, gap))
        worst = max(worst, value) if rule.worst == "largest" else min(worst, value)
    return worst


def _between(logs: Sequence[float], at: int, count: int, gap: float) -> float:
    """Straight line of the logarithms."""
    x, i = math.log(gap), 0
    while i < count - 2 and (x > logs[i + 1] or logs[i + 1] <= logs[i]):
        i += 1
    t = (x - logs[i]) / (logs[i + 1] - logs[i])
    return math.exp(logs[at + i] + t * (logs[at + i + 1] - logs[at + i]))
