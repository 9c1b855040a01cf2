"""Grasps from the side: on a post under a wide cap, which nothing can be taken from above of."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from pat3d.envs.grasping.grasp import find_grasps, leaning
from pat3d.envs.grasping.leaning import LEANING_PAYLOAD, LEANS, find_leaning_grasps
from pat3d.errors import TaskError
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import MassProperties
from pat3d.scene.model import Scene, SceneObject
from tests.envs.test_grasp import GRIPPER, bar


def mushroom(mass: float = 0.2) -> SceneObject:
    """A post of 2 cm, 20 cm high, on a foot of 8 cm and under a cap of 16 cm."""

    def block(width: float, low: float, high: float):
        return convex_part(np.array([(x, y, z) for x in (-width, width) for y in (-width, width) for z in (low, high)]))

    made = bar("mushroom", (0.16, 0.16, 0.22))
    parts = (block(0.04, 0.0, 0.01), block(0.01, 0.01, 0.2), block(0.08, 0.2, 0.22))
    properties = MassProperties(
        mass=mass,
        volume=6e-4,
        centre_of_mass=(0.0, 0.0, 0.12),
        inertia=((1e-3, 0.0, 0.0), (0.0, 1e-3, 0.0), (0.0, 0.0, 1e-3)),
    )
    return replace(made, asset=replace(made.asset, parts=parts, mass_properties=properties))


def directions(grasps):
    return {round(math.degrees(one.heading)) for one in grasps}


def test_a_post_under_a_cap_is_taken_from_the_side_only():
    scene = Scene(objects=(mushroom(),))
    assert not find_grasps(scene, "mushroom", GRIPPER)
    found = find_leaning_grasps(scene, "mushroom", GRIPPER, count=50)
    # The rim of the cap can be taken too, by fingers above and below it.
    post = [one for one in found if one.position[2] < 0.19]
    assert directions(post) == {0, 90, 180, 270}
    for grasp in found:
        x, y, z = grasp.position
        assert grasp.lean in LEANS
        assert 0.0 < z < 0.22
        # The tips are beside the post; the hand is on the side of the heading, above them.
        back = grasp.turn @ [0.0, 0.0, 1.0]
        assert np.hypot(x, y) < (0.03 if z < 0.19 else 0.1)
        assert back[2] > 0.0
        assert np.allclose(
            back[:2], math.sin(grasp.lean) * np.array([math.cos(grasp.heading), math.sin(grasp.heading)])
        )


def test_a_wall_forbids_the_side_where_it_stands():
    wall = bar("wall", (0.02, 0.6, 0.4), (0.14, 0.0))
    found = find_leaning_grasps(Scene(objects=(mushroom(), wall)), "mushroom", GRIPPER, count=50)
    assert found
    assert not directions(found) & {0, 45, 315}
    assert 180 in directions(found)


def test_leaning_is_a_rotation_towards_the_heading():
    random = np.random.default_rng(0)
    for lean, heading in random.uniform((0.0, -math.pi), (1.5, math.pi), (20, 2)):
        turn = leaning(lean, heading)
        assert np.allclose(turn @ turn.T, np.eye(3))
        assert np.linalg.det(turn) == pytest.approx(1.0)
        up = [math.sin(lean) * math.cos(heading), math.sin(lean) * math.sin(heading), math.cos(lean)]
        assert np.allclose(turn @ [0.0, 0.0, 1.0], up)
    assert np.array_equal(leaning(0.0, 0.3), np.eye(3))


def test_what_is_only_picked_up_may_be_taken_from_the_side_and_what_is_heavy_not():
    pytest.importorskip("robosuite")
    from pat3d.envs.grasping.placement import Needs, place

    grasps = place(Scene(objects=(mushroom(),)), "Panda", Needs(grasp=("mushroom",))).grasps["mushroom"]
    assert all(one.lean for one in grasps)
    for needs in (Needs(grasp=("mushroom",), visit=((0.0, 0.0, 0.3),)), Needs(grasp=("mushroom",), cleared=True)):
        with pytest.raises(TaskError, match="no rim or handle"):
            place(Scene(objects=(mushroom(),)), "Panda", needs)
    with pytest.raises(TaskError, match="no rim or handle"):
        place(Scene(objects=(mushroom(LEANING_PAYLOAD + 0.1),)), "Panda", Needs(grasp=("mushroom",)))
    with pytest.raises(TaskError, match=r"weighs 3\.5 kg, the arm carries 3\.0 kg"):
        place(Scene(objects=(mushroom(3.5),)), "Panda", Needs(grasp=("mushroom",)))


def test_the_way_of_the_hand_is_continuous_and_ends_where_it_should(env):
    from pat3d.envs.grasping.hand_path import HandPath

    env.reset(seed=0)
    state = env.simulation.state
    goal = state.hand + [0.1, 0.05, -0.05], leaning(0.2, env.placement.yaw + math.pi) @ state.hand_rotation
    way = HandPath(env).through([goal])
    assert way is not None
    assert np.linalg.norm(way[-1][0] - goal[0]) < 3e-3
    assert math.acos(min(1.0, (np.trace(way[-1][1] @ goal[1].T) - 1) / 2)) < 0.03
    places = np.array([state.hand, *(position for position, _ in way)])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 0.12
    assert HandPath(env).through([(state.hand + [3.0, 0.0, 0.0], goal[1])]) is None


def test_the_scripted_policy_takes_a_bouquet_by_its_stems(tmp_path):
    """Its flowers are wider than the gripper opens, and cover the stems from above."""
    pytest.importorskip("robosuite")
    from pat3d.assets.catalogue.lookup import make
    from pat3d.geometry.pose import Pose
    from pat3d.policies_eval.policies.scripted import ScriptedPolicy
    from pat3d.policies_eval.run.episodes import Setting, episodes_of
    from pat3d.policies_eval.run.rollout import Runner
    from pat3d.policies_eval.run.settings import RolloutSettings
    from pat3d.scene.io import save_scene

    pose = Pose.from_yaw(0.0, (0.0, 0.0, 0.0))
    bouquet = SceneObject(name="bouquet", asset=make("bouquet"), pose=pose, initial_pose=pose)
    assert not find_grasps(Scene(objects=(bouquet,)), "bouquet", GRIPPER)
    save_scene(Scene(objects=(bouquet,)), tmp_path / "scene")
    runner = Runner(RolloutSettings(max_steps=200))
    (episode,) = episodes_of([Setting(scene=str(tmp_path / "scene"), task="pick:bouquet")], 1)
    result = runner.run(episode, ScriptedPolicy())
    runner.close()
    assert result.outcome == "success"
