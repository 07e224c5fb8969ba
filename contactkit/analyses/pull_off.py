"""Pull-off curve of a contact under adhesion: approach and separation, jumps and hysteresis."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

import numpy as np
from attrs import field, frozen

from ..arguments import listed
from ..contact.effects.adhesion import Adhesion
from ..contact.plan import ContactPlan
from ..contact.result import ContactResult
from ..contact.solve import solve_unwarned
from ..errors import DescriptionError
from ..scene.curve import Curve
from ..scene.loading import Approach
from ..scene.plan import check_plan
from ..validity import ValidityNumber, note_worst, warn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["AdhesiveBranch", "Jump", "PullOffCurve", "pull_off_curve"]

_PASSING = "pixels across a contact spot"  # which begins and ends in a point on every branch
# Measured on a ball with two ranges of the law, 24 x 24 pixels and seven approaches: 466 and 591
# contacts, two jumps each, a small loop and a large one.
#
# Energy lost over change of load times change of approach, at a jump; that change over the adhesive
# energy, in a step that is too long. 0.3 takes half the contacts and misses both jumps of the small
# loop; 0.03 takes 1.2 to 1.4 times as many, for the same jumps.
_SUDDEN = 0.1
# Energy lost over the adhesive energy, at a jump: what the trapezoidal rule leaves is less. At 1e-2
# the small loop is nearly three times too large, at 1e-4 and 1e-5 8 % smaller for 5 to 10 % more.
_LEAST = 1e-3
_MOST_LEFT = 0.999  # of the pull-off force at the last state: beyond, that may be the largest pull
# Change of load and energy between two paths to one state, where states are not ordered: neighbours
# on one branch differ by more, and what the tolerance of a contact leaves is far less.
_SAME = 1e-3
# Step over the range of the law, where states are not ordered: within a quarter of it the tension
# changes by a fifth, and a path by the middle finds the same state unless there is a jump.
_LONGEST = 0.25
# Change of energy over the adhesive energy, of a loop that is closed: round-off of sums of
# energies.
_CLOSED = 1e-6
# Bound of the error of an extreme by the approaches that is pointed out, over the largest tension.
# For a soft sphere it is 3 to 70 times the error: 6 % where 13 approaches miss 2 %, 4 % where 17
# miss 0.1 %.
_MOST_MISSED = 0.05
_COLUMNS = (
    ("approach", "m"),
    ("load", "N"),
    ("contact_area", "m2"),
    ("attracted_area", "m2"),
    ("elastic_energy", "J"),
    ("adhesive_energy", "J"),
    ("dissipated_energy", "J"),
    ("n_contacts", "-"),
    ("n_applications", "-"),
)
_SCALARS = (
    ("pull_off_force", "N"),
    ("pull_off_approach", "m"),
    ("pull_on_force", "N"),
    ("loop_energy", "J"),
    ("loop_error", "J"),
)


class AdhesiveBranch(NamedTuple):
    """States of one branch in the order they were passed; arrays of shape (n,).

    Attributes
    ----------
    approach, load : ndarray
        Rigid-body approach from first touch [m], and load [N], negative if tensile.
    contact_area, attracted_area : ndarray
        Area in contact, and in contact or apart by less than the range [m2].
    elastic_energy, adhesive_energy : ndarray
        [J]
    dissipated_energy : ndarray
        Energy dissipated since the state before [J], by the trapezoidal rule for the work of the
        load.
    n_contacts, n_applications : ndarray
        Contacts solved, and applications of the operator on the full grid.
    """

    approach: Floats
    load: Floats
    contact_area: Floats
    attracted_area: Floats
    elastic_energy: Floats
    adhesive_energy: Floats
    dissipated_energy: Floats
    n_contacts: NDArray[np.int64]
    n_applications: NDArray[np.int64]


class Jump(NamedTuple):
    """A jump of a contact at an imposed approach.

    It lies between the approaches `before` and `after` [m], in the order they were passed.
    `load_change` [N] and `area_change` [m2] are those across it, `energy_lost` [J] what it
    dissipates.
    """

    branch: Literal["approach", "separation"]
    before: float
    after: float
    load_change: float
    area_change: float
    energy_lost: float


@frozen(eq=False)
class PullOffCurve(Curve):
    """Approach and separation of a contact under adhesion at imposed approaches.

    Attributes
    ----------
    approaching, separating : AdhesiveBranch
        The states; the first one of the separation is the last one of the approach.
    jumps : tuple of Jump
        Jumps in the order they were passed.
    plan : ContactPlan
        What was solved, without its preparation.
    validity : tuple of ValidityNumber
        The worst of each number over all states, but for the pixels across a contact spot; and the
        errors of both extremes by the approaches and the tension at the end of the separation, over
        the pull-off force [-].
    """

    axis: ClassVar[str] = "state"

    approaching: AdhesiveBranch = field(repr=False)
    separating: AdhesiveBranch = field(repr=False)
    jumps: tuple[Jump, ...]
    plan: ContactPlan = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        return self.plan.title

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return tuple(self.plan.cite().splitlines())

    @property
    def parts(self) -> Mapping[str, Any]:
        """See `Curve.parts`."""
        return {name: getattr(self, name) for name in ("approaching", "separating", "jumps")}

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return both branches, one after the other: ``separating`` marks the second."""
        both = (self.approaching, self.separating)
        columns: dict[str, tuple[Any, str]] = {
            name: (np.concatenate([getattr(b, name) for b in both]), unit)
            for name, unit in _COLUMNS
        }
        separating = np.repeat([False, True], [one.load.size for one in both])
        return columns | {"separating": (separating, "-")}

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the whole path, each with its unit."""
        return {name: (getattr(self, name), unit) for name, unit in _SCALARS}

    @property
    def pull_off_force(self) -> float:
        """Largest tensile load of the separation [N]: pull-off under load control."""
        return -float(self.separating.load.min())

    @property
    def pull_off_approach(self) -> float:
        """Approach [m] at the pull-off force; negative: a neck is drawn out."""
        return float(self.separating.approach[int(self.separating.load.argmin())])

    @property
    def pull_on_force(self) -> float:
        """Largest tensile load of the approach [N]: pull-on."""
        return -float(self.approaching.load.min())

    @property
    def jump_in_approach(self) -> float | None:
        """Approach of the first jump on the approach [m]; None if there is none."""
        found = [one.after for one in self.jumps if one.branch == "approach"]
        return found[0] if found else None

    @property
    def loop_energy(self) -> float:
        """Work of the load over approach and separation [J], which hysteresis dissipates.

        By the trapezoidal rule, whose error is about `loop_error`: a loop of less is none, and may
        come out negative.
        """
        return sum(
            float(np.trapezoid(one.load, one.approach))
            for one in (self.approaching, self.separating)
        )

    @property
    def loop_error(self) -> float:
        """Size of the error of `loop_energy` [J]: energy that steps gain, which none can."""
        both = (self.approaching, self.separating)
        return -sum(float(np.minimum(one.dissipated_energy, 0.0).sum()) for one in both)

    @property
    def is_closed(self) -> bool:
        """Whether the separation ends in the state from which the approach began."""
        first, last = self.approaching, self.separating
        energies = [
            float(b.elastic_energy[i] + b.adhesive_energy[i]) for b, i in ((first, 0), (last, -1))
        ]
        scale = float(np.abs(last.adhesive_energy).max())
        return abs(energies[1] - energies[0]) <= _CLOSED * scale

    @property
    def n_applications(self) -> int:
        """Applications of the operator on the full grid, of all states."""
        return int(self.approaching.n_applications.sum() + self.separating.n_applications[1:].sum())


class _State(NamedTuple):
    approach: float
    load: float
    contact_area: float
    attracted_area: float
    elastic_energy: float
    adhesive_energy: float
    n_contacts: int
    n_applications: int
    result: ContactResult

    @property
    def energy(self) -> float:
        return self.elastic_energy + self.adhesive_energy


_Run = Callable[[float, _State | None], _State]


def pull_off_curve(
    plan: ContactPlan, approaches: Sequence[float | str] | Floats, *, n_refinements: int = 6
) -> PullOffCurve:
    r"""Follow a contact under adhesion through an approach and the separation after it.

    Every state starts from the one before, so that the branches are those of a quasi-static path:
    a jump is no failure but an event. A step that loses energy,

    .. math:: E_1 + \tfrac12 (P_1 + P_2) (\delta_2 - \delta_1) - E_2,

    is halved until the loss is that of a jump; the losses of a closed loop add up to the work
    of the load over it.

    Parameters
    ----------
    plan : ContactPlan
        Of a scene with `Adhesion`; its own loading is not looked at.
    approaches : array_like, shape (n,)
        Rigid-body approaches from first touch [m], rising; the separation passes them in reverse
        order. Bodies apart have a negative one.
    n_refinements : int
        How many times a step with a loss is halved at most: a jump is located to the step over
        ``2**n_refinements``.

    Raises
    ------
    NotSimulatedError
        If the scene does not list `Adhesion`.
    DescriptionError
        If the approaches are fewer than two, or do not rise, or `n_refinements` is no whole number.
    ConvergenceError
        If a state does not converge.

    Warns
    -----
    ValidityWarning
        For each number that is out of its range in any of the states.

    Notes
    -----
    Branches do not depend on the steps. In a periodic window on half-spaces, where states are not
    ordered (see `Adhesion`), that takes two to three times the work: a step is halved until it is a
    quarter of the range of the law or less, and the path by its middle leads to the same state,
    to a thousandth of load and energy. Under load control, as with a soft spring or a
    negative `Pressing`, the bodies pull off at `PullOffCurve.pull_off_force` and snap in before the
    jump of the approach.
    The extremes are those of the states; `validity` estimates what they miss, and warns of more
    than 5 %: let the approaches be dense there.

    Examples
    --------
    >>> import math
    >>> import numpy as np
    >>> import contactkit as ck
    >>> rubber = ck.Material(young_modulus=1e6, poisson_ratio=0.5)
    >>> law = ck.ExponentialAttraction(work_of_adhesion=0.05, range=0.5e-6)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=rubber), upper=ck.Body(surface=ck.Paraboloid(radius=100e-6))
    ...     ),
    ...     window=ck.Window(width=50e-6, periodic=False),
    ...     loading=ck.Approach(approach=0.0),
    ...     effects=(ck.HalfSpace(), ck.Adhesion(law=law)),
    ... )
    >>> plan = ck.plan(scene, ck.Accuracy(grid=24, rtol=1e-6))
    >>> curve = ck.pull_off_curve(plan, [-6e-6, -3e-6, *np.linspace(-2e-6, 0.0, 9)])
    >>> f"{curve.pull_off_force / (math.pi * 0.05 * 100e-6):.2f} pi w R", curve.is_closed
    ('1.67 pi w R', True)
    """
    check_plan(plan, ContactPlan)
    adhesion = plan.listed(Adhesion)
    if isinstance(n_refinements, bool) or not isinstance(n_refinements, int) or n_refinements < 0:
        raise DescriptionError(
            "pull_off_curve(n_refinements)", n_refinements, "be a whole number of at least 0"
        )
    levels = _checked(approaches)
    worst: dict[str, ValidityNumber] = {}

    def run(approach: float, before: _State | None) -> _State:
        made = plan.with_loading(Approach(approach=approach))
        result = solve_unwarned(made, start=before.result if before is not None else None)
        note_worst(worst, (one for one in result.validity if one.name != _PASSING))
        return _state(result)

    # A mean plane that is held lifts one place where another is drawn in.
    is_held = plan.grid.periodic and not plan.prepared.solver.uniform_compliance
    longest = _LONGEST * adhesion.law.range if is_held else None
    up, jumps_up = _followed(
        run, run(levels[0], None), levels[1:], "approach", n_refinements, longest
    )
    down, jumps_down = _followed(run, up[-1], levels[-2::-1], "separation", n_refinements, longest)
    jumps = (*jumps_up, *jumps_down)
    found = (*worst.values(), *_between(up, down, jumps), _left(down))
    warn(found)
    return PullOffCurve(_branch(up), _branch(down), jumps, plan.without_preparation(), found)


def _checked(approaches: Sequence[float | str] | Floats) -> list[float]:
    given = listed("pull_off_curve(approaches)", approaches, "m")
    if given.size < 2:
        raise DescriptionError(
            "pull_off_curve(approaches)", approaches, "be two finite numbers or more", unit="m"
        )
    if not np.all(np.diff(given) > 0.0):
        raise DescriptionError(
            "pull_off_curve(approaches)",
            approaches,
            "rise from one to the next",
            unit="m",
            hint="the separation passes them in reverse order by itself",
        )
    return [float(one) for one in given]


def _state(result: ContactResult) -> _State:
    part, work = result.of(Adhesion), result.work
    return _State(
        result.approach,
        result.load,
        part.contact_area,
        part.attracted_area,
        part.elastic_energy,
        part.adhesive_energy,
        part.n_contacts,
        work.n_operator_applications,
        result,
    )


def _left(separating: Sequence[_State]) -> ValidityNumber:
    """How much of the pull-off force still acts where the separation ends."""
    pull_off = -min(one.load for one in separating)
    return ValidityNumber(
        name="tension at the end of the separation",
        value=-separating[-1].load / pull_off if pull_off > 0.0 else None,
        high=_MOST_LEFT,
        detail="over the pull-off force; above, the bodies have not been pulled far enough to show "
        "it: let the approaches begin further apart"
        if pull_off > 0.0
        else "nothing pulls",
    )


def _between(
    up: Sequence[_State], down: Sequence[_State], jumps: Sequence[Jump]
) -> tuple[ValidityNumber, ...]:
    """Whether the approaches are dense enough about the extremes of both branches."""
    deepest = -min(one.load for one in (*up, *down))
    return tuple(
        ValidityNumber(
            name=f"error of the {name} by the approaches",
            value=_missed(states, {one.before for one in jumps if one.branch == branch}) / deepest
            if deepest > 0.0
            else None,
            high=_MOST_MISSED,
            detail="at most, by the states beside it, over the largest tension; above, give more "
            "approaches there"
            if deepest > 0.0
            else "nothing pulls",
            source="straight lines by the states beside, of a convex load",
        )
        for name, branch, states in (
            ("pull-off force", "separation", down),
            ("pull-on force", "approach", up),
        )
    )


def _missed(states: Sequence[_State], before_jumps: set[float]) -> float:
    """Bound of how far the load goes below its least state, if it is convex about that [N].

    Between two states a convex load lies above the straight lines by the two states before them and
    by the two after; where those meet is the least that it may reach. Across a jump and beyond an
    end nothing is known: there it may go on as between the last two states.
    """
    x, p = [one.approach for one in states], [one.load for one in states]
    i = min(range(len(states)), key=p.__getitem__)
    cuts = [k for k, one in enumerate(states) if one.approach in before_jumps]
    first = max((k + 1 for k in cuts if k < i), default=0)
    last = min((k for k in cuts if k >= i), default=len(states) - 1)
    if first == last:
        return abs(p[i])  # nothing beside it says how the load goes on
    return max(_below(x, p, k, first, last) for k in (i - 1, i) if first <= k < last)


def _below(x: list[float], p: list[float], k: int, first: int, last: int) -> float:
    """How far lines by the states beside an interval meet below its lower end [N]."""
    length = x[k + 1] - x[k]
    before = (p[k] - p[k - 1]) / (x[k] - x[k - 1]) if k > first else None
    after = (p[k + 2] - p[k + 1]) / (x[k + 2] - x[k + 1]) if k + 1 < last else None
    least = min(p[k], p[k + 1])
    if before is None or after is None:
        return abs(p[k + 1] - p[k])
    if before * after >= 0.0 or before == after:  # no minimum inside
        return 0.0
    at = (p[k + 1] - p[k] - after * length) / (before - after)  # from x[k]
    return max(0.0, least - (p[k] + before * at))


def _loss(a: _State, b: _State) -> float:
    """Energy lost from a state to the next [J]."""
    return a.energy + 0.5 * (a.load + b.load) * (b.approach - a.approach) - b.energy


def _has_loss(a: _State, b: _State) -> bool:
    """Whether the loss of a step is more than the error of the trapezoidal rule usually is."""
    smooth = abs((b.load - a.load) * (b.approach - a.approach))
    return _loss(a, b) > max(_SUDDEN * smooth, _LEAST * _adhesive(a, b))


def _is_too_long(a: _State, b: _State) -> bool:
    """Whether a step may hide a jump: by its loss, or by a change of the load that may cover it."""
    if max(a.attracted_area, b.attracted_area) == 0.0:
        return False
    change = abs((b.load - a.load) * (b.approach - a.approach))
    return change > _SUDDEN * _adhesive(a, b) or _has_loss(a, b)


def _adhesive(a: _State, b: _State) -> float:
    return max(abs(a.adhesive_energy), abs(b.adhesive_energy))


def _followed(
    run: _Run,
    first: _State,
    approaches: Sequence[float],
    branch: Literal["approach", "separation"],
    n_refinements: int,
    longest: float | None,
) -> tuple[list[_State], list[Jump]]:
    """States of a branch, and its jumps; the maps of all but the last state are given up."""
    states, jumps = [first], list[Jump]()
    for approach in approaches:
        before = states[-1]
        after = run(approach, before)
        between, found = _refined(run, before, after, n_refinements, longest)
        states[-1] = _without_maps(before)
        states += [*map(_without_maps, between[:-1]), between[-1]]
        jumps += [
            Jump(
                branch,
                a.approach,
                b.approach,
                b.load - a.load,
                b.contact_area - a.contact_area,
                _loss(a, b),
            )
            for a, b in found
        ]
    return states, jumps


def _refined(
    run: _Run, a: _State, b: _State, depth: int, longest: float | None, loss: float = 0.0
) -> tuple[list[_State], list[tuple[_State, _State]]]:
    """States between two (with the second), and the pairs of them that a jump separates.

    `loss` is that of the step of twice the length [J]: halving a step leaves the loss of a jump
    as it is, and a quarter or less of the error of the trapezoidal rule. `longest` is None where
    states are ordered. Elsewhere a step is halved until it is at most that long [m] and the path by
    its middle leads to the same state; the state at its end is that of the path.
    """
    if depth <= 0:
        is_jump = _has_loss(a, b) and _loss(a, b) > 0.5 * loss
        return [b], [(a, b)] if is_jump else []
    is_apart, is_long = max(a.attracted_area, b.attracted_area) == 0.0, _is_too_long(a, b)
    if is_apart or (longest is None and not is_long):
        return [b], []
    middle, here = run(0.5 * (a.approach + b.approach), a), _loss(a, b)
    if longest is not None:
        by_middle = run(b.approach, middle)
        is_short = abs(b.approach - a.approach) <= longest and not is_long
        if is_short and _is_same(b, by_middle):
            return [middle, by_middle], []
        b = by_middle
    states, jumps = _refined(run, a, middle, depth - 1, longest, here)
    if longest is not None and not _is_same(middle, states[-1]):
        b = run(b.approach, states[-1])
    more, others = _refined(run, states[-1], b, depth - 1, longest, here)
    return states + more, jumps + others


def _is_same(a: _State, b: _State) -> bool:
    """Whether two states at one approach are the same, to a thousandth of load and energy."""
    is_load = abs(a.load - b.load) <= _SAME * max(abs(a.load), abs(b.load))
    return is_load and abs(a.energy - b.energy) <= _SAME * _adhesive(a, b)


def _without_maps(state: _State) -> _State:
    return state._replace(result=None)  # type: ignore[arg-type]


def _branch(states: Sequence[_State]) -> AdhesiveBranch:
    names = AdhesiveBranch._fields
    losses = [0.0, *(_loss(a, b) for a, b in pairwise(states))]
    columns = {
        name: np.array(
            losses if name == "dissipated_energy" else [getattr(s, name) for s in states]
        )
        for name in names
    }
    for column in columns.values():
        column.flags.writeable = False
    return AdhesiveBranch(**columns)
