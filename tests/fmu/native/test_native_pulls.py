"""Release of random pulls by the C kernel, in one communication step, against LSODA of scipy."""

from __future__ import annotations

import pytest
from native_scenes import HAS_CC
from random_pulls import GAP, PULL, Pulled, exact, pulls, scene_of, units

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native

REFERENCE = 1e-9  # of LSODA, and of the tables of the kernel


@pytest.fixture(scope="module")
def built(shelf):
    """FMUs of a flooded disc and of a film of fixed volume."""

    def make(folder):
        for n in (3, 5):
            scene = scene_of(Pulled(n, 1e-6, 35.0, 0.0, 0.0))
            build_native(scene, folder / f"n{n}.fmu", platforms=[local()], compiler="cc")

    folder = shelf.folder("native pulls", make)
    return {n: folder / f"n{n}.fmu" for n in (3, 5)}


def errors(path, pull, rtol):
    """Relative errors of the time of release, and of time and speed where one step ends."""
    pull = as_step(pull)
    loading, (time, speed, _) = scene_of(pull).loading, units()
    given = {"m": loading.mass, "k_s": loading.stiffness, "h_rel": loading.final_gap, "rtol": rtol}
    right = exact(pull)
    end = right.time * time
    with Instance(path) as host:
        host.start(given, 2.0 * end)
        host.set(host.references("F_ext"), [PULL])
        host.step(0.0, 0.999 * end)
        gap, found = host.get(host.references("h", "v"))
        host.step(0.999 * end, 0.101 * end)
        release = host.get(host.references("t_release"))[0]
    there = exact(pull, gap / GAP)
    return (
        abs(release / end - 1.0),
        abs(there.time * time / (0.999 * end) - 1.0),
        abs(found / (there.speed * speed) - 1.0),
    )


def as_step(pull):
    """The pull as a step: an FMU has no rise time of its own."""
    return pull._replace(rise=0.0)


CASES = [
    Pulled(3, 8.816e-6, 2.335, 0.0, 0.0),
    Pulled(5, 7.112e-5, 2.177, 0.0, 0.0),
    Pulled(5, 2.411e-6, 1.277, 0.0, 0.8587),
    Pulled(3, 1e-10, 20.0, 0.0, 0.0),
]


@pytest.mark.parametrize("pull", CASES)
def test_the_kernel_releases_to_its_tolerance(pull, built):
    for rtol in (1e-4, 1e-6, 1e-8):
        release, time, speed = errors(built[pull.exponent], pull, rtol)
        assert release <= rtol + REFERENCE
        assert time <= rtol + REFERENCE
        assert speed <= 2.0 * rtol + REFERENCE


@pytest.mark.slow
def test_a_thousand_releases_of_the_kernel_are_right_to_their_tolerance(built):
    for i, pull in enumerate(pulls(1000, seed=2)):
        rtol = (1e-4, 1e-6, 1e-8, 1e-10)[i % 4]
        release, time, speed = errors(built[pull.exponent], pull, rtol)
        assert release <= rtol + REFERENCE, (pull, rtol)
        assert time <= rtol + REFERENCE, (pull, rtol)
        assert speed <= 5.0 * rtol + REFERENCE, (pull, rtol)
