"""A study on a cluster: the same points, from wherever they are solved."""

from __future__ import annotations

import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import contactkit as ck

pytestmark = [
    pytest.mark.slow,  # a cluster of processes
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

ACCURACY = ck.Accuracy(grid=32, rtol=1e-8)
PRESSURES = [1e7, 2e7, 4e7, 8e7]


def scene(surface=None):
    steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.25e-7)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=steel), upper=ck.Body(surface=surface or rough)),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e7),
        effects=(ck.HalfSpace(), ck.HardnessLimit(rule="material")),
    )


@pytest.fixture(scope="module")
def client():
    """Two processes; what the cluster itself warns of is none of ours."""
    distributed = pytest.importorskip("distributed")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        cluster = distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        )
        client = distributed.Client(cluster)
    yield client
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        client.close()
        cluster.close()


def test_a_cluster_changes_nothing(client, tmp_path):
    vary, fractions = {"loading.pressure": [*PRESSURES, 3e10]}, []
    here = ck.study(scene(), vary, ACCURACY)
    there = ck.study(
        scene(),
        vary,
        ACCURACY,
        client=client,
        keep_maps=True,
        store=tmp_path,
        progress=fractions.append,
    )
    assert [p.status for p in there.points] == ["converged"] * 4 + ["infeasible"]
    for name in ("contact_area", "max_pressure", "approach"):
        assert there.column(name) == pytest.approx(here.column(name), rel=1e-5, nan_ok=True)
    assert there.results[2].load == pytest.approx(4e-5)
    assert fractions == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0])
    assert ck.study(scene(), vary, ACCURACY, store=tmp_path, keep_maps=True).n_solved == 0


def test_a_chain_is_cut_for_the_workers_of_a_cluster(client):
    submitted = []

    class Watched:
        nthreads = staticmethod(client.nthreads)

        def submit(self, function, *arguments):
            submitted.append(arguments)
            return client.submit(function, *arguments)

    study = ck.study(scene(), {"loading.pressure": PRESSURES}, ACCURACY, client=Watched())
    assert len(submitted) == 2
    assert study.column("load") == pytest.approx([p * 1e-12 for p in PRESSURES])


def test_a_large_map_travels_without_a_warning(client):
    """Warnings are errors here, and a cluster has one for large tasks."""
    heights = 1e-9 * np.random.default_rng(1).standard_normal((1200, 1200))
    large = scene(ck.Heights(heights=heights, pixel_size=1e-6 / 1200))
    # above what the hardness bears: nothing is to be solved
    study = ck.study(large, {"loading.pressure": [8e9, 9e9]}, client=client)
    assert [p.status for p in study.points] == ["infeasible"] * 2


def test_anything_that_gives_futures_will_do():
    """A pool of one thread, for one: nothing of a cluster is needed but `submit`."""
    with ThreadPoolExecutor(1) as pool:
        study = ck.study(scene(), {"loading.pressure": PRESSURES}, ACCURACY, client=pool, workers=3)
    assert study.column("load") == pytest.approx([p * 1e-12 for p in PRESSURES])
