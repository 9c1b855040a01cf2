"""Suites made on a Ray cluster of two workers on this machine; skipped where ray is not installed."""

from __future__ import annotations

from importlib.util import find_spec

import pytest

pytest.importorskip("robosuite")

from pat3d.cli.main import main
from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.generate import generate
from pat3d.errors import SuiteError
from tests.envs.suites import SMALL, files_of

MEMORY = 80 * 2**20
"""Of a node's object store [bytes]; scenes are small."""


@pytest.fixture
def cluster():
    """A head without cores and two nodes with one each."""
    pytest.importorskip("ray")
    import ray
    from ray.cluster_utils import Cluster

    made = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "object_store_memory": MEMORY})
    made.workers = [made.add_node(num_cpus=1, object_store_memory=MEMORY) for _ in range(2)]
    yield made
    ray.shutdown()
    made.shutdown()


def test_a_cluster_that_loses_a_worker_midway_makes_the_same_suite_bit_for_bit(cluster, tmp_path):
    """The oracle is a run of one process of this machine; only the log may differ, and the name on the page."""
    generate(str(tmp_path / "here"), SMALL, workers=1)
    lost = []

    def lose_one(status):
        if status.made and status.workers == 2 and not lost:
            lost.append(cluster.workers[0])
            cluster.remove_node(cluster.workers[0], allow_graceful=False)

    there = tmp_path / "there"
    status = generate(str(there), SMALL, workers="auto", ray=cluster.address, tell=lose_one)
    assert lost
    assert status.done == status.total == 4
    assert files_of(there, {"index.html"}) == files_of(tmp_path / "here", {"index.html"})
    assert not SuiteFolder(there).work.exists()


@pytest.mark.parametrize("address", ["127.0.0.1:1", "ray://127.0.0.1:1", "somewhere"])
def test_without_a_cluster_or_without_ray_nothing_is_written(tmp_path, capsys, address):
    assert main(["suite", "generate", str(tmp_path / "new"), "--scenes", "2", "--ray", address]) == 2
    said = capsys.readouterr().err
    assert ("no Ray cluster answers" if find_spec("ray") else "pip install 'pat3d[ray]'") in said
    assert not (tmp_path / "new" / "suite.json").exists()
    with pytest.raises(SuiteError, match="in use by process"), SuiteFolder(tmp_path / "new").locked():
        generate(str(tmp_path / "new"), SMALL, ray=address)
