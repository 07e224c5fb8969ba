"""The meridian of a circular bridge: it encloses the volume, meets the bodies, and is a circle."""

import math

import numpy as np
import pytest

from contactkit.capillary.arc.bridge import arc_bridge
from contactkit.capillary.arc.profile import arc_profile
from contactkit.errors import DescriptionError, InfeasibleError
from contactkit.units import deg

CASES = [
    (0.3, 1.0, 60, 60, 0.0, 0.0),
    (0.3, 1.0, 0, 60, 0.0, 0.0),
    (0.5, 1.0, 120, 60, 0.0, 0.0),  # a straight arc
    (0.4, 1.0, 180, 120, 0.0, 0.0),
    (0.05, 1e-3, 40, 40, 0.0, 1.0),
    (0.02, 1e-2, 120, 120, 1.0, 0.5),
]


def cap(radius, curvature):
    """Volume of the body above its contact circle's plane."""
    if not curvature:
        return 0.0
    big = 1.0 / curvature
    sag = big - math.sqrt(big**2 - radius**2)
    return math.pi * sag**2 * (big - sag / 3.0)


@pytest.mark.parametrize("case", CASES)
def test_the_profile_is_a_circle_of_the_volume_between_the_bodies(case):
    gap, volume, *degrees, below, above = case
    angles = [one * deg for one in degrees]
    r, z = arc_profile(gap, volume, *angles, below, above, count=4001)
    state = arc_bridge(gap, volume, *angles, below, above)
    assert r[0] == pytest.approx(float(state.radius_lower), rel=1e-13)
    assert r[-1] == pytest.approx(float(state.radius_upper), rel=1e-10)
    assert r.min() >= float(state.neck) * (1.0 - 1e-9)
    assert r.max() <= float(state.bulge) * (1.0 + 1e-9)
    inside = math.pi * np.trapezoid(r**2, z)
    assert inside - cap(r[0], below) - cap(r[-1], above) == pytest.approx(volume, rel=1e-6)
    first, middle, last = (np.array([r[i], z[i]]) for i in (0, 2000, 4000))
    for i in (700, 3100):  # every point sees the chord under the angle of its side of the circle
        one = np.array([r[i], z[i]])
        a, b = first - one, last - one
        p, q = first - middle, last - middle
        seen = [math.atan2(u[0] * v[1] - u[1] * v[0], u @ v) for u, v in ((a, b), (p, q))]
        assert seen[0] == pytest.approx(seen[1], abs=1e-6)


def test_a_profile_needs_a_bridge_and_two_points():
    with pytest.raises(InfeasibleError, match="its neck has closed"):
        arc_profile(50e-9, 9.27e-25, math.pi / 3, math.pi / 3)
    with pytest.raises(DescriptionError, match=r"arc_profile\.count"):
        arc_profile(1.0, 1.0, 1.0, 1.0, count=1)
