"""Connecting to a cluster and what its workers send, with a cluster that is made up: Ray itself plays no part."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import pytest

from pat3d.envs.suites import ray_pool
from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.ray_pool import Cluster, RayPool
from pat3d.errors import SuiteError


class ClusterLostError(Exception):
    """In the place of RayError."""


class WorkerLostError(ClusterLostError):
    """In the place of RayActorError."""


class Ray:
    """As much of the module as is used; remembers what it was asked to do."""

    exceptions = SimpleNamespace(RayError=ClusterLostError, RayActorError=WorkerLostError)

    def __init__(self, connected: bool = False) -> None:
        self.connected, self.told = connected, []
        self.answers: list = []

    def is_initialized(self) -> bool:
        return self.connected

    def init(self, address: str, **_) -> None:
        self.told.append(f"init {address}")

    def shutdown(self) -> None:
        self.told.append("shutdown")

    def cluster_resources(self):
        return {"CPU": 12.0}

    def remote(self, worker):
        return SimpleNamespace(options=lambda **_: SimpleNamespace(remote=self._actor))

    def _actor(self, request):
        return SimpleNamespace(
            prepare=SimpleNamespace(remote=lambda versions: "prepared"),
            make=SimpleNamespace(remote=lambda place, candidate: (place, candidate)),
        )

    def wait(self, asked, num_returns, timeout):
        return asked[:1], asked[1:]

    def get(self, what):
        answer = self.answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer

    def kill(self, actor) -> None:
        self.told.append("kill")


@pytest.fixture
def ray(monkeypatch):
    """The module that `import ray` finds; its cluster's head answers."""
    made = Ray()
    monkeypatch.setitem(sys.modules, "ray", made)
    monkeypatch.setattr(ray_pool, "_knock", lambda address: made.told.append(f"knock {address}"))
    return made


def test_a_cluster_is_connected_to_and_left_again(ray):
    with Cluster("10.0.0.1:6379") as cluster:
        assert cluster.cores == 12
        assert ray.told == ["knock 10.0.0.1:6379", "init 10.0.0.1:6379"]
    assert ray.told[2:] == ["shutdown"]


def test_a_connection_that_was_there_is_used_and_stays(ray):
    """A program that works on a cluster itself would lose it."""
    ray.connected = True
    with Cluster("auto") as cluster:
        assert cluster.cores == 12
    assert ray.told == []


@pytest.mark.parametrize("error", [OSError("refused\nat length"), ValueError("refused"), RuntimeError("refused")])
def test_a_cluster_that_does_not_answer_is_an_error_in_a_line_and_nothing_is_left(ray, monkeypatch, error):
    def refuse(address, **_):
        raise error

    monkeypatch.setattr(ray, "init", refuse)
    with (
        pytest.raises(SuiteError, match=r'no Ray cluster answers at "auto" \(refused\)\. Give HOST:PORT'),
        Cluster("auto"),
    ):
        pass
    assert "shutdown" not in ray.told


@pytest.mark.parametrize("address", ["somewhere", "host:", "host:port", "host:65536", ":-1", "ray://host"])
def test_an_address_without_host_and_port_is_refused_before_anybody_is_asked(address, monkeypatch):
    asked = []
    monkeypatch.setattr(ray_pool.socket, "create_connection", lambda *given, **_: asked.append(given))
    with pytest.raises(ValueError, match="no HOST:PORT"):
        ray_pool._knock(address)
    assert not asked


@pytest.mark.parametrize("address", ["host:6379", "ray://host:6379"])
def test_the_head_of_a_cluster_is_knocked_at(address, monkeypatch):
    asked = []
    connection = SimpleNamespace(close=lambda: asked.append("closed"))
    monkeypatch.setattr(ray_pool.socket, "create_connection", lambda place, timeout: asked.append(place) or connection)
    ray_pool._knock(address)
    assert asked == [("host", 6379), "closed"]
    ray_pool._knock("auto")
    assert len(asked) == 2


@pytest.fixture
def pool(ray, tmp_path):
    """A pool with one worker that is ready and has been given place 3."""
    made = RayPool(SuiteFolder(tmp_path / "suite"), SimpleNamespace(as_dict=dict), SimpleNamespace(ray=ray))
    ray.answers.append(({"ready": True}, {}))
    made.spawn()
    made.answer(1.0)
    assert made.idle() == [0]
    made.assign(0, [(3, 1)])
    return made


SAID = {"place": 3, "candidate": 1}


def test_a_scene_that_arrives_is_put_in_its_folder_with_all_its_files(ray, pool, tmp_path):
    files = {"scenes/000003/scene.json": b"{}", "scenes/000003/meshes/a.obj": b"v", "rejected/000003-00.json": b"no"}
    ray.answers.append((SAID, files))
    answer = pool.answer(1.0)
    assert (answer.worker, answer.units, answer.said) == (0, ((3, 1),), SAID)
    suite = tmp_path / "suite"
    found = {one.relative_to(suite).as_posix(): one.read_bytes() for one in suite.rglob("*") if one.is_file()}
    assert found == files
    assert pool.idle() == [0]


def test_a_scene_that_is_there_stays_as_it_is(ray, pool, tmp_path):
    there = tmp_path / "suite" / "scenes" / "000003" / "scene.json"
    there.parent.mkdir(parents=True)
    there.write_bytes(b"first")
    ray.answers.append((SAID, {"scenes/000003/scene.json": b"second"}))
    pool.answer(1.0)
    assert there.read_bytes() == b"first"


@pytest.mark.parametrize("name", ["../outside", "scenes/../../outside", "/{root}/outside"])
def test_a_worker_that_names_a_file_outside_of_the_suite_writes_nothing(ray, pool, tmp_path, name):
    """Nor does it write what came with it."""
    name = name.format(root=str(tmp_path).lstrip("/"))
    ray.answers.append((SAID, {name: b"evil", "scenes/000003/scene.json": b"{}"}))
    answer = pool.answer(1.0)
    assert answer.said == {"fatal": f'OSError: a worker sent a file named "{name}"'}
    assert not [one for one in tmp_path.rglob("*") if one.is_file()]


def test_a_worker_that_is_lost_ends_and_a_cluster_that_is_lost_is_an_error(ray, pool):
    ray.answers.append(WorkerLostError("the node\nis gone"))
    answer = pool.answer(1.0)
    assert (answer.ended, answer.units) == ("ended (the node is gone)", ((3, 1),))
    assert ray.told == ["kill"]
    assert pool.size == 0
    pool.spawn()
    ray.answers.append(ClusterLostError("no head"))
    with pytest.raises(SuiteError, match="the Ray cluster was lost: no head What is finished is kept"):
        pool.answer(1.0)
