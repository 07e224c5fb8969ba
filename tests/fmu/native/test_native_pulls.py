"""Release of random pulls by the C kernel, in one communication step, against LSODA of scipy."""

from __future__ import annotations

import pytest
from native_scenes import HAS_CC
from random_pulls import (
    BEFORE,
    GAP,
    PULL,
    Pulled,
    as_step,
    exact,
    kept,
    pulls,
    scene_of,
    units,
)

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native

REFERENCE = 1e-9  # of LSODA, and of the tables of the kernel


@pytest.fixture(scope="module")
def hosts(shelf):
    """FMUs of a flooded disc and of a film of fixed volume, each loaded once."""

    def make(folder):
        for n in (3, 5):
            scene = scene_of(Pulled(n, 1e-6, 35.0, 0.0, 0.0))
            build_native(scene, folder / f"n{n}.fmu", platforms=[local()], compiler="cc")

    folder = shelf.folder("native pulls", make)
    with Instance(folder / "n3.fmu") as flooded, Instance(folder / "n5.fmu") as of_volume:
        yield {3: flooded, 5: of_volume}


def errors(host, pull, right, rtol):
    """Relative errors of the time of release, and of time and speed where one step ends."""
    loading, (unit, fast, _) = scene_of(pull).loading, units()
    given = {"m": loading.mass, "k_s": loading.stiffness, "h_rel": loading.final_gap, "rtol": rtol}
    end = right.time * unit
    host._slave.reset()
    host.start(given, 2.0 * end)
    host.set(host.references("F_ext"), [PULL])
    host.step(0.0, BEFORE * end)
    gap, found = host.get(host.references("h", "v"))
    host.step(BEFORE * end, (1.1 - BEFORE) * end)
    release = host.get(host.references("t_release"))[0]
    # the error of the gap as a time, and the speed that is right at the gap found
    at, speed, acceleration = right.before
    late = (gap / GAP - at) / speed
    return (
        abs(release / end - 1.0),
        abs(late / (BEFORE * right.time)),
        abs(found / ((speed + acceleration * late) * fast) - 1.0),
    )


CASES = [
    Pulled(3, 8.816e-6, 2.335, 0.0, 0.0),
    Pulled(5, 7.112e-5, 2.177, 0.0, 0.0),
    Pulled(5, 2.411e-6, 1.277, 0.0, 0.8587),
    Pulled(3, 1e-10, 20.0, 0.0, 0.0),
]


@pytest.mark.parametrize("pull", CASES)
def test_the_kernel_releases_to_its_tolerance(pull, hosts):
    right = exact(as_step(pull))
    for rtol in (1e-4, 1e-6, 1e-8):
        release, time, speed = errors(hosts[pull.exponent], pull, right, rtol)
        assert release <= rtol + REFERENCE
        assert time <= rtol + REFERENCE
        assert speed <= 2.0 * rtol + REFERENCE


@pytest.mark.parametrize(
    "every",
    [pytest.param(8, marks=pytest.mark.slow), pytest.param(1, marks=pytest.mark.exhaustive)],
)
def test_a_thousand_releases_of_the_kernel_are_right_to_their_tolerance(hosts, every):
    solved = list(zip(pulls(1000, seed=2), kept("steps"), strict=True))
    for i in (i for i in range(1000) if i // 4 % every == 0):  # all tolerances
        pull, right = solved[i]
        rtol = (1e-4, 1e-6, 1e-8, 1e-10)[i % 4]
        release, time, speed = errors(hosts[pull.exponent], pull, right, rtol)
        assert release <= rtol + REFERENCE, (pull, rtol)
        assert time <= rtol + REFERENCE, (pull, rtol)
        assert speed <= 5.0 * rtol + REFERENCE, (pull, rtol)
