"""Computation of a load-displacement curve: contacts under a series of loads, unloading curves.

Loads or approaches are solved in sequence, downwards, each starting from the solutions before.
Where pixels have yielded, the heights are reduced by the overlap for which plastic flow has made
room; the elastic contact of that surface is the unloading curve.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import evolve

from ...accuracy import Accuracy
from ...arguments import listed
from ...contact.chain import ContactChain, loading_of
from ...contact.effects.base import (
    Attraction,
    Compliance,
    DisplacementTerm,
    LoadHistory,
    LoadTerm,
    PressureBound,
)
from ...contact.effects.plasticity import HardnessLimit
from ...contact.plan import ContactPlan, plan_contact
from ...contact.result import ContactResult
from ...contact.solver.warm_start import MAX_SOLUTIONS
from ...errors import ConvergenceError, DescriptionError, InfeasibleError, PlanError
from ...numerics.monotone_cubic import power_curve
from ...scene.loading import ContactLoading
from ...scene.plan import check_scene
from ...scene.scenes import ContactScene
from ...validity import warn
from .curve import HERTZ, LoadDisplacementCurve, Unloading

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Map = NDArray[np.float64]

__all__ = ["load_displacement"]

Progress = Callable[[float], None]

# Fractions of the distance from the residual to the maximum approach; 1 is known.
_FRACTIONS = (0.01, 0.025, 0.05, 0.09, 0.15, 0.23, 0.33, 0.45, 0.58, 0.72, 0.86)


class _Node(NamedTuple):
    """A point of the loading curve, with its pressure and the overlap of its plastic pixels."""

    approach: float
    force: float
    contact_area: float
    plastic_area: float
    pressure: Map
    overlap: Map | None


def load_displacement(
    scene: ContactScene,
    *,
    loads: Sequence[float | str] | Floats | None = None,
    approaches: Sequence[float | str] | Floats | None = None,
    points: int = 32,
    decades: float = 4.0,
    n_unloadings: int = 12,
    accuracy: Accuracy | None = None,
    progress: Progress | None = None,
) -> LoadDisplacementCurve:
    r"""Force and areas of a contact over its approach, with unloading curves if it is plastic.

    Parameters
    ----------
    scene : ContactScene
        Bodies, window and effects: the compliance and, for plasticity, a `HardnessLimit`.
        Observers are not run. Its loading is the end of the tables, unless `loads` or `approaches`
        are given.
    loads : sequence of float, optional
        Forces on the window at which to solve [N], ascending.
    approaches : sequence of float, optional
        Approaches from first touch at which to solve [m], ascending, instead of loads.
    points : int
        Number of loads if none are given, in a geometric series.
    decades : float
        Decades of force that they span; of an imposed approach two thirds as many.
    n_unloadings : int
        Number of unloading curves at most.
    accuracy : Accuracy, optional
        Grid and tolerance of each contact.
    progress : callable, optional
        Called with the completed fraction.

    Returns
    -------
    LoadDisplacementCurve
        Monotone tables that need no numpy, for the area of the window.

    Raises
    ------
    PlanError
        If the scene has a film or a friction that acts back on the contact.
    InfeasibleError
        If the hardness cannot carry a load, or grows so much with it that plastic spots shrink; or
        if a periodic window is in full contact, where the approach no longer grows.
    DescriptionError
        If a number is impossible.

    Notes
    -----
    The approach counts from first touch of the undeformed surfaces: of points far away in an
    isolated contact, of the mean planes of the deformed surfaces in a periodic window, so that the
    bodies behind it have to be added as a spring in series.

    During unloading no pixel reaches the hardness again, as pressures fall with the approach; so
    unloading is elastic, and reloading leads back along the same curve and then on along the
    loading curve. For a constant hardness the dissipated work is the hardness times the plastic
    volume. A hardness that depends on the load is that at the maximum approach. Left out: pile-up
    around a plastic spot, residual stress, hardening, and time.

    Warns
    -----
    ValidityWarning
        For each number of `ContactResult.validity` out of its range under the largest load.

    Examples
    --------
    Hertz: 4/3 E* sqrt(R) d^1.5.

    >>> import contactkit as ck
    >>> steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=30e-6, periodic=False),
    ...     loading=ck.Pressing(force=0.2),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> curve = load_displacement(scene, points=8, decades=1.0, accuracy=ck.Accuracy(grid=96))
    >>> f"{curve.at(50e-9).force:.4f} N, Hertz {4 / 3 * 2.3077e11 * 1e-3**0.5 * 50e-9**1.5:.4f} N"
    '0.1088 N, Hertz 0.1088 N'
    """
    check_scene(scene, ContactScene)
    scene = _without_observers(scene)
    key, values = _series(scene, loads, approaches, points, decades)
    n_unloadings = _count("n_unloadings", n_unloadings, 1)
    last = evolve(scene, loading=_loading(scene, key, values[-1]))
    plan = plan_contact(last, accuracy)  # refuses the maximum load before any solve
    report = progress or (lambda fraction: None)
    chain, nodes = ContactChain(), list[_Node]()
    for i, value in enumerate(reversed(values)):
        result = chain.solve(plan.with_loading(_loading(scene, key, value)))
        if i == 0:
            warn(result.validity)  # at the largest load; under a light one a spot is a pixel
        if result.load > 0.0:
            nodes.insert(0, _node(result))
        report(0.5 * (i + 1) / len(values))
    if len(nodes) < 2:
        raise InfeasibleError(
            f"only {len(nodes)} of {len(values)} points touch; impose larger loads or approaches"
        )
    for before, node in pairwise(nodes):
        _check_grows(before, node)
    computed = _unloadings(plan, nodes, n_unloadings, report)
    return _tables(plan, nodes, computed, result.approach_datum)


def _without_observers(scene: ContactScene) -> ContactScene:
    """Leave out effects that observe a contact; refuse those that act back on it."""
    kept = tuple(e for e in scene.effects if isinstance(e, Compliance | PressureBound))
    apart = (Attraction, DisplacementTerm, LoadHistory, LoadTerm)
    acting = [e for e in scene.effects if isinstance(e, apart)]
    if acting:
        names = ", ".join(e.name for e in acting)
        raise PlanError(
            "load-displacement curves are of a dry contact without friction, adhesion and loads "
            f"before; leave out {names}"
        )
    return evolve(scene, effects=kept)


def _count(name: str, value: int, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise DescriptionError(
            f"load_displacement({name})", value, f"be a whole number of at least {least}"
        )
    return value


def _series(
    scene: ContactScene,
    loads: Sequence[float | str] | Floats | None,
    approaches: Sequence[float | str] | Floats | None,
    points: int,
    decades: float,
) -> tuple[str, list[float]]:
    """Name of the imposed quantity, and its values."""
    if loads is not None and approaches is not None:
        raise DescriptionError("load_displacement", "both", "be given loads [N] or approaches [m]")
    given = loads if loads is not None else approaches
    if given is not None:
        key, unit = ("force", "N") if loads is not None else ("approach", "m")
        values = listed(f"load_displacement({key})", given, unit).tolist()
        pairs = zip([0.0, *values], values, strict=False)
        if len(values) < 2 or not all(a < b < math.inf for a, b in pairs):
            expected = "be two or more, positive and ascending"
            raise DescriptionError(f"load_displacement({key})", given, expected, unit=unit)
        return key, values
    _count("points", points, 4)
    if not (math.isfinite(decades) and decades > 0.0):
        raise DescriptionError("load_displacement(decades)", decades, "be positive and finite")
    key, last, _ = scene.loading.quantity
    if last <= 0.0:
        where = f"{type(scene.loading).__name__}.{key}"
        raise DescriptionError(where, last, "be positive for a load-displacement curve")
    reach = decades if scene.loading.imposed_approach is None else decades / HERTZ
    return key, [float(x) for x in np.geomspace(last * 10.0**-reach, last, points)]


def _loading(scene: ContactScene, key: str, value: float) -> ContactLoading:
    """Loading of a point: as in the scene, if that imposes the same quantity."""
    if scene.loading.quantity.name == key:
        return evolve(scene.loading, **{key: value})
    return loading_of(key, value)


def _node(result: ContactResult) -> _Node:
    area, overlap = 0.0, None
    if result.has(HardnessLimit) and result.plastic_area > 0.0:
        area, overlap = result.plastic_area, result.of(HardnessLimit).overlap
    return _Node(result.approach, result.load, result.contact_area, area, result.pressure, overlap)


def _check_grows(before: _Node, node: _Node) -> None:
    """Refuse points that no table can join."""
    if node.approach <= before.approach * (1.0 + 1e-9):
        raise InfeasibleError(
            f"at {node.force:.6g} N the approach of {node.approach:.6g} m no longer grows: in "
            "full contact a periodic window has no approach of its own, and flat faces have none "
            "at all; end the loads below that, or use a window that is not periodic"
        )
    if before.overlap is None:
        return
    if node.overlap is None or node.overlap.sum() < 0.999 * before.overlap.sum():
        raise InfeasibleError(
            f"at {node.force:.6g} N the plastic spots are smaller than at {before.force:.6g} "
            "N: the hardness grows with the load, and residual indentations of smaller loads are "
            "lost; use HardnessLimit(rule='material') or ConstantHardness, or end the loads below "
            "that"
        )


def _unloadings(
    plan: ContactPlan, nodes: list[_Node], count: int, report: Progress
) -> tuple[Unloading, ...]:
    """Unloading curves from at most `count` of the plastic points."""
    begins = next((i for i, node in enumerate(nodes) if node.overlap is not None), None)
    if begins is None:
        return ()
    chosen = np.unique(np.linspace(begins, len(nodes) - 1, count).round().astype(int))
    found = []
    for i, at in enumerate(chosen):
        overlap = nodes[at].overlap
        if overlap is not None:
            found.append(_unloading(plan, nodes[at], overlap))
        report(0.5 + 0.5 * (i + 1) / len(chosen))
    return tuple(found)


def _tables(
    plan: ContactPlan, nodes: list[_Node], unloadings: tuple[Unloading, ...], datum: str
) -> LoadDisplacementCurve:
    begins = next((i for i, node in enumerate(nodes) if node.overlap is not None), len(nodes))
    approach, force = [node.approach for node in nodes], [node.force for node in nodes]
    return LoadDisplacementCurve(
        approach=tuple(approach),
        force=tuple(force),
        # As pixel counts, areas may decrease by round-off of a contact condition.
        contact_area=tuple(np.maximum.accumulate([node.contact_area for node in nodes])),
        plastic_area=tuple(np.maximum.accumulate([node.plastic_area for node in nodes])),
        unloading=unloadings,
        elastic_limit=nodes[begins - 1].approach if begins else 0.0,
        nominal_area=plan.grid.area,
        datum=datum,
        error=_error(approach, force),
    )


def _error(approach: list[float], force: list[float]) -> float:
    """Largest relative difference from the table of every other point."""
    if len(approach) < 5:
        return 1.0  # too few points for an estimate
    last = (len(approach) - 1) % 2  # the table of every other point must reach to the end
    coarse = power_curve(approach[last::2], force[last::2], HERTZ)
    pairs = zip(approach[last:], force[last:], strict=True)
    return max(abs(coarse(d)[0] / f - 1.0) for d, f in pairs)


def _unloading(plan: ContactPlan, node: _Node, overlap: Map) -> Unloading:
    """Solve the elastic contact of the surface deformed plastically up to a point."""
    accuracy, heights = plan.accuracy, plan.heights
    deformed = heights - overlap
    touch = float(deformed.max())
    residual = float(heights.max()) - touch
    length, pixel = node.approach - residual, plan.grid.pixel_area
    known, found = [(length - touch, node.pressure)], [(1.0, 1.0, 1.0)]
    for fraction in reversed(_FRACTIONS):
        approach = fraction * length - touch
        solution = plan.prepared.solver.solve(
            plan.prepared.open(deformed),
            rigid_approach=approach,
            rtol=accuracy.rtol,
            start=known,
            max_iterations=accuracy.max_iterations,
            method=accuracy.method,
        )
        if not solution.converged:
            raise ConvergenceError(
                f"the unloading curve from {node.approach:.6g} m is not solved: contact conditions "
                f"are violated by {solution.kkt:.2g} of the rms height; raise "
                "Accuracy.max_iterations or rtol",
                solution,
            )
        p = solution.pressure
        known = [(approach, p), *known][:MAX_SOLUTIONS]
        force = float(p.sum()) * pixel / node.force
        area = float((p > 0.0).sum()) * pixel / node.contact_area
        if not 0.0 < force <= found[-1][1]:
            break  # no contact to the tolerance: below, the power law holds
        found.append((fraction, force, min(area, found[-1][2])))
    if len(found) == 1:
        raise ConvergenceError(
            f"the unloading curve from {node.approach:.6g} m is shorter than the tolerance of the "
            "solver; lower Accuracy.rtol, or begin with larger loads"
        )
    fractions, forces, areas = zip(*reversed(found), strict=True)
    volume = float(overlap.sum()) * pixel
    return Unloading(node.approach, residual, fractions, forces, areas, volume)
