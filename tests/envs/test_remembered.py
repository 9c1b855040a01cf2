"""Placements that are remembered: the same to the bit, found by all that they depend on, and searched for once."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.grasping import remembered
from pat3d.envs.grasping.placement import place
from pat3d.envs.grasping.remembered import placed
from pat3d.envs.grasping.standing import Needs
from pat3d.envs.physics.loading import load
from pat3d.errors import TaskError
from tests.envs.own_arm import own_arm

MUG, APPLE = Needs(grasp=("red mug",)), Needs(grasp=("green apple",))


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """The file of an arm, found and measured once."""
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.fixture
def searches(tmp_path, monkeypatch):
    """A cache of one's own, and what was searched for."""
    done: list[tuple[str, Needs]] = []

    def counted(scene, robot, needs):
        done.append((robot, needs))
        return place(scene, robot, needs)

    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(remembered, "place", counted)
    monkeypatch.setattr(remembered, "_known", type(remembered._known)())
    return done


def records(tmp_path):
    return sorted((tmp_path / "cache" / remembered.FOLDER).glob("*.json"))


def test_a_placement_is_searched_for_once_in_a_process_and_in_those_that_come_after(own, searches, tmp_path):
    found = load()
    for robot in (own, f"{own}+{own}"):
        expected = place(found.scene, robot, MUG)
        first = placed(found.scene, found.checksum, robot, MUG)
        again = placed(found.scene, found.checksum, robot, MUG)
        remembered._known.clear()
        later = placed(found.scene, found.checksum, robot, MUG)
        assert expected == first == again == later
        # As tuples, so that it is as frozen as it was.
        assert hash(later.start) == hash(expected.start)
        assert all(isinstance(grasps, tuple) for grasps in later.grasps.values())
    assert len(searches) == 2
    assert len(records(tmp_path)) == 2


def test_another_need_scene_or_arm_is_searched_for_by_itself(own, searches, tmp_path):
    found = load()
    placed(found.scene, found.checksum, own, MUG)
    placed(found.scene, found.checksum, own, APPLE)
    placed(found.scene, "0" * 64, own, MUG)
    placed(replace(found.scene, relations=found.scene.relations[1:]), found.checksum, own, MUG)
    other = tmp_path / "other.xml"
    other.write_text(own_arm().replace('size="0.04"', 'size="0.035"'))
    placed(found.scene, found.checksum, str(other), MUG)
    placed(found.scene, None, own, MUG)
    assert len(searches) == 6
    assert len(records(tmp_path)) == 5


def test_a_changed_arm_of_the_same_name_is_another(own, searches, monkeypatch):
    found = load()
    placed(found.scene, found.checksum, own, MUG)
    monkeypatch.setattr(remembered, "_robot", lambda name: "another model")
    placed(found.scene, found.checksum, own, MUG)
    monkeypatch.setattr(remembered, "_source", lambda: "another search")
    placed(found.scene, found.checksum, own, MUG)
    assert len(searches) == 3


@pytest.mark.parametrize(
    "damage",
    [
        lambda told: "{",
        lambda told: "[]",
        lambda told: json.dumps({**told, "colour": "red"}),
        lambda told: json.dumps({**told, "grasps": {"red mug": [{"position": 3}]}}),
        lambda told: json.dumps({name: value for name, value in told.items() if name != "yaw"}),
        lambda told: json.dumps({**told, "robot": "x" * remembered.MAX_BYTES}),
    ],
)
def test_a_record_that_says_something_else_is_searched_for_again(own, searches, tmp_path, damage):
    found = load()
    first = placed(found.scene, found.checksum, own, MUG)
    (record,) = records(tmp_path)
    record.write_text(damage(json.loads(record.read_text())))
    remembered._known.clear()
    assert placed(found.scene, found.checksum, own, MUG) == first
    assert len(searches) == 2
    assert json.loads(record.read_text())["base_position"] == list(first.base_position)


def test_what_cannot_be_done_is_not_kept(own, searches, tmp_path):
    found = load()
    for _ in range(2):
        with pytest.raises(TaskError):
            placed(found.scene, found.checksum, own, Needs(visit=((9.0, 9.0, 9.0),)))
    assert len(searches) == 2
    assert not records(tmp_path)


def test_a_process_remembers_so_many_and_forgets_the_oldest(own, searches, monkeypatch):
    monkeypatch.setattr(remembered, "KEPT", 2)
    found = load()
    for checksum in ("a", "b", "a", "c"):
        placed(found.scene, checksum, own, MUG)
    kept = set(remembered._known)
    placed(found.scene, "a", own, MUG)
    assert kept == set(remembered._known)
    assert len(searches) == 3
