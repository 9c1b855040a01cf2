"""Moves of the scripted plan, on scenes of boxes in which it is known what is in the way."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from pat3d.envs.grasping.grasp import STEADY, find_grasps, torque
from pat3d.envs.robots.arms import arm_kinematics
from pat3d.errors import TaskError
from pat3d.geometry.hulls import convex_part
from pat3d.scene.model import Relation, Scene, SceneObject
from tests.envs.test_grasp import GRIPPER, bar

pytest.importorskip("robosuite")
pytest.importorskip("gymnasium")


def tower(*names: str) -> Scene:
    """Cubes of 4 cm one upon another, the first on the ground."""
    objects, relations = [], []
    for level, name in enumerate(names):
        cube = bar(name, (0.04, 0.04, 0.04))
        pose = replace(cube.pose, position=(0.0, 0.0, 0.04 * level))
        objects.append(replace(cube, pose=pose, initial_pose=pose))
        if level:
            relations.append(Relation(child=name, kind="on", parent=names[level - 1]))
    return Scene(objects=tuple(objects), relations=tuple(relations))


def rehearsed(scene: Scene, task: str, folder):
    """The placement of a Panda that can do a task in a scene as it stands."""
    from pat3d.envs.tasks.registry import parse_task
    from pat3d.envs.tasks.rehearsal import rehearse
    from pat3d.exporters.mjcf.writer import write_mjcf

    return rehearse(scene, write_mjcf(scene, folder / "mjcf"), parse_task(task), "Panda")


def box_on(scene: Scene, obj: SceneObject, parent: str) -> Scene:
    """The scene with one more object, on another."""
    relation = Relation(child=obj.name, kind="on", parent=parent)
    return replace(scene, objects=(*scene.objects, obj), relations=(*scene.relations, relation))


@pytest.mark.parametrize("offset", [0.0005, 0.0012, 0.002])
def test_the_fingers_close_on_the_middle_of_what_is_between_them(offset):
    """Height maps have cells of 2.5 mm; with 3 mm of play a grasp that is off by one would meet the block's top."""
    width = GRIPPER.opening - 0.003
    made = bar("block", (0.15, width, 0.05))
    # A sheet below the block sticks out further on one side, so that the cells are not those of the block.
    corners = [(x, y, z) for x in (-0.075, 0.075) for y in (-0.1, 0.1 + 2 * offset) for z in (0.0, 0.004)]
    sheet = convex_part(np.array(corners))
    scene = Scene(objects=(replace(made, asset=replace(made.asset, parts=(*made.asset.parts, sheet))),))
    grasps = [one for one in find_grasps(scene, "block", GRIPPER) if abs(math.sin(one.closing)) > 0.999]
    assert grasps
    for grasp in grasps:
        assert grasp.position[1] == pytest.approx(0.0, abs=1e-6)
        assert grasp.width == pytest.approx(width, rel=1e-6)


def test_torque_is_weight_times_the_distance_of_the_grasp():
    (grasp, *_) = find_grasps(Scene(objects=(bar("bar", (0.2, 0.04, 0.05)),)), "bar", GRIPPER)
    x, y, _ = grasp.position
    assert torque(grasp, 2.0, (x + 0.03, y + 0.04, 0.7)) == pytest.approx(2.0 * 9.81 * 0.05)


def test_what_stands_on_another_is_taken_first_and_no_longer_in_the_way():
    from pat3d.envs.grasping.taking import grasps_of
    from pat3d.envs.tasks.registry import parse_task

    scene = tower("bottom", "middle", "top")
    needs = parse_task("retrieve:bottom").needs(scene)
    assert set(needs.grasp) == {"bottom", "middle", "top"}
    grasps = grasps_of(scene, needs.grasp, "Panda", put=False, cleared=True)
    assert list(grasps) == ["top", "middle", "bottom"]
    assert all(grasps.values())


def test_a_wall_that_stays_still_refuses_what_is_cleared_of_everything_else():
    """Nothing but what is taken goes away."""
    from pat3d.envs.grasping.taking import grasps_of

    walls = tuple(
        bar(f"wall {x} {y}", (0.02, 0.2, 0.2) if x else (0.2, 0.02, 0.2), (0.04 * x, 0.04 * y))
        for x, y in ((-1, 0), (1, 0), (0, -1), (0, 1))
    )
    scene = tower("bottom", "top")
    assert list(grasps_of(scene, ("bottom", "top"), "Panda", put=False, cleared=True)) == ["top", "bottom"]
    with pytest.raises(TaskError, match=r'"(top|bottom)" cannot be taken by Panda'):
        grasps_of(replace(scene, objects=(*scene.objects, *walls)), ("bottom", "top"), "Panda", put=False, cleared=True)


def test_what_can_only_be_held_far_from_its_middle_is_picked_up_and_not_put_anywhere():
    from pat3d.envs.grasping.taking import grasps_of
    from pat3d.geometry.mass import MassProperties

    made = bar("beam", (0.5, 0.04, 0.05))
    heavy = MassProperties(
        mass=1.2,
        volume=1e-3,
        centre_of_mass=(0.4, 0.0, 0.02),
        inertia=((1e-2, 0.0, 0.0), (0.0, 1e-2, 0.0), (0.0, 0.0, 1e-2)),
    )
    scene = Scene(objects=(replace(made, asset=replace(made.asset, mass_properties=heavy)),))
    assert min(torque(one, 1.2, (0.4, 0.0, 0.02)) for one in find_grasps(scene, "beam", GRIPPER)) > STEADY
    assert grasps_of(scene, ("beam",), "Panda", put=False, cleared=False)["beam"]
    with pytest.raises(TaskError, match=r"1\.2 kg\) cannot be put anywhere by Panda"):
        grasps_of(scene, ("beam",), "Panda", put=True, cleared=False)


def test_the_posture_of_the_arm_is_the_one_its_controller_settles_in(env):
    """Held at a pose for three seconds, the arm has the joint positions that inverse kinematics says."""
    from pat3d.envs.grasping.scripted import Servo

    env.reset(seed=0)
    state, arm = env.simulation.state, arm_kinematics(env.robot)
    c, s = math.cos(env.placement.yaw), math.sin(env.placement.yaw)
    base = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    position, rotation = state.hand + base @ [0.12, -0.2, 0.1], state.hand_rotation.copy()
    start = env.simulation.arm.copy()
    local = base.T @ (position - np.array(env.placement.base_position))
    expected = arm.solve(local, base.T @ rotation, start, start)
    plain = arm.solve(local, base.T @ rotation, start + [0.0, 0.0, 0.5, 0.0, 0.5, 0.0, 0.0])
    servo = Servo(env)
    for _ in range(60):
        env.step(servo.towards(position, rotation, -1.0)[0])
    assert expected is not None
    assert np.abs(env.simulation.arm - expected).max() < 0.06
    assert plain is None or np.abs(env.simulation.arm - plain).max() > 0.2


def test_a_plan_names_what_is_in_its_way(tmp_path):
    """A cube in a shaft that is wide enough for the fingers, not for the hand above them."""
    cube = bar("cube", (0.04, 0.04, 0.04))
    base = bar("base", (0.08, 0.08, 0.03), (0.3, 0.0))
    free = Scene(objects=(cube, base))
    placement = rehearsed(free, "stack:cube:base", tmp_path / "free")
    assert placement.grasps["cube"]
    # A tower on the base, which leaves it no room.
    post = bar("post", (0.07, 0.07, 0.3))
    pose = replace(post.pose, position=(0.3, 0.0, 0.03))
    full = box_on(free, replace(post, pose=pose, initial_pose=pose), "base")
    from pat3d.envs.tasks.registry import parse_task
    from pat3d.envs.tasks.rehearsal import rehearse
    from pat3d.exporters.mjcf.writer import write_mjcf

    with pytest.raises(TaskError, match=r'no way to move "cube".*"post"'):
        rehearse(full, write_mjcf(full, tmp_path / "full"), parse_task("stack:cube:base"), "Panda")


def test_a_rehearsal_goes_through_all_moves_of_a_task(tmp_path):
    rehearsed(tower("bottom", "middle", "top"), "retrieve:bottom", tmp_path)


def test_what_is_put_down_goes_to_a_spot_that_is_free(env):
    from pat3d.envs.grasping.spots import FREE_GAP, free_spots

    env.reset(seed=0, options={"task": "unload:wooden tray"})
    (low, high), state = env.placement.bench, env.simulation.state
    found = free_spots(env, "green apple")
    assert found
    best = found[0]
    assert (best[:2] > low).all()
    assert (best[:2] < high).all()
    for obj in env.scene.objects:
        if obj.name != "green apple":
            cloud = state.points(obj.name)[:, :2]
            gap = np.linalg.norm(np.maximum(np.maximum(cloud.min(axis=0) - best[:2], best[:2] - cloud.max(axis=0)), 0))
            assert gap > FREE_GAP
