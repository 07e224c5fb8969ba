"""Loadings by the field that is given, for tests that run over all kinds of them."""

from __future__ import annotations

import contactkit as ck

KINDS = {"speed": ck.ImposedSpeed, "force": ck.ImposedForce, "time": ck.ImposedTime}


def imposed(**given):
    """Loading of a separation that imposes a speed, a force or a time."""
    (kind,) = (KINDS[name] for name in KINDS if name in given)
    return kind(**given)


def with_points(scene, n):
    """Accuracy of a curve of some points, for a loading that has one: a motion takes its steps."""
    return ck.Accuracy(points=n) if "points" in scene.reads else None


def pressed(**given):
    """Loading of a contact: a pressure, a force or an approach."""
    return ck.Approach(**given) if "approach" in given else ck.Pressing(**given)
