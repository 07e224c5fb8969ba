"""Drives of the bodies: an imposed rigid gap, or forces on a mass with a spring."""

from __future__ import annotations

from collections.abc import Callable

from attrs import frozen

__all__ = ["Drive", "Driven", "Imposed"]


@frozen
class Imposed:
    """An imposed gap of the undeformed bodies over time."""

    gap: Callable[[float], float]


@frozen
class Driven:
    r"""Forces on a mass: :math:`m \ddot z = F(t) + k\,[z_s(t) - z] + 2\pi \int (p + p_c) r\,dr`.

    Parameters
    ----------
    force : callable
        Force that opens the gap, over time.
    mass : float
        0: no inertia.
    stiffness : float
        Of a spring.
    spring_end : callable
        Rigid gap at which the spring is relaxed, over time.
    """

    force: Callable[[float], float]
    mass: float = 0.0
    stiffness: float = 0.0
    spring_end: Callable[[float], float] = lambda _: 0.0


Drive = Imposed | Driven
