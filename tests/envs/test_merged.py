"""Worlds with different scenes in one model, with MuJoCo as the judge: what each does is what it does by itself."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest

pytest.importorskip("gymnasium")
pytest.importorskip("warp")

from pat3d.envs.batch.merged import PARKED, _joined, alone, merged
from pat3d.envs.env import choose
from pat3d.envs.physics.simulation import Simulation
from pat3d.envs.physics.world import compose
from pat3d.envs.robots.arms import make_robot
from pat3d.errors import EnvironmentSetupError
from pat3d.exporters import export
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene
from tests.envs.own_arm import own_arm

ALIKE = 1e-5
"""[m], [rad]: vertices of meshes are rounded to 1e-8 m in another frame, so contacts begin or end a time step sooner or
later, which is g dt^2 = 4e-5 m over the contacts of an object."""


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A robot file of one's own."""
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


def _world(scene: Scene, task: str, arm: str, folder):
    return compose(scene, export(scene, ("mjcf",), folder)["mjcf"], make_robot(arm), choose(scene, task, arm)[1])


@pytest.fixture(scope="module")
def worlds(breakfast, arm, tmp_path_factory):
    """The shipped scene; some of its objects, heavier, slippery and elsewhere; two apples."""
    some = [obj for obj in breakfast.objects if obj.name in ("wooden tray", "banana", "red mug")]
    heavy = tuple(
        replace(obj, pose=replace(obj.pose, position=tuple(np.add(obj.pose.position, (0.07, 0.02, 0.0)))))
        for obj in reversed(some)
    )
    apple = breakfast["green apple"]
    low = float(np.concatenate([part.vertices for part in apple.asset.parts])[:, 2].min())
    apples = tuple(replace(apple, name=f"apple {k}", pose=Pose(position=(0.1 * k, 0.0, -low))) for k in range(2))
    scenes = (breakfast, replace(breakfast, objects=heavy, relations=(), attachments=()), Scene(objects=apples))
    tasks = ("pick:red mug", "pick:red mug", "pick:apple 1")
    return [
        _world(scene, task, arm, tmp_path_factory.mktemp("scene")) for scene, task in zip(scenes, tasks, strict=True)
    ]


@pytest.fixture(scope="module")
def together(worlds):
    return merged(worlds)


def _as_kind(together, number):
    """The model of all with the values of one kind, for MuJoCo; the meshes of its library collide with nothing."""
    model = together.library
    added = model.ngeom - together.world.model.ngeom
    first = int(together.world.model.body_geomnum[0])
    # What the library has more stands last among the world's own geoms.
    geoms = np.arange(together.world.model.ngeom)
    geoms[first:] += added
    model.geom_contype[first : first + added] = model.geom_conaffinity[first : first + added] = 0
    for name, values in together.values.items():
        if name == "meaninertia":
            model.stat.meaninertia = values[number]
        else:
            target = getattr(model, name)
            rows = geoms if name.startswith("geom_") else slice(None)
            target[rows] = values[number].reshape(target[rows].shape)
    # What MuJoCo found out when it compiled: frames that are one, and boxes around bodies.
    model.geom_sameframe[:] = model.body_sameframe[:] = model.site_sameframe[:] = 0
    model.bvh_aabb[:, :3], model.bvh_aabb[:, 3:] = 0.0, 10.0 * PARKED
    return model, geoms


@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_world_moves_in_the_common_model_as_in_its_own(together, number):
    """A fifth of a second of falling, sliding and a moving arm."""
    kind = together.kinds[number]
    own = kind.world.model
    model, _ = _as_kind(together, number)
    one, other = mujoco.MjData(own), mujoco.MjData(model)
    start = Simulation(kind.world, "osc", 20.0, sleep=False).data.qpos
    one.qpos[:] = start
    other.qpos[:] = together.home(
        [Simulation(each.world, "osc", 20.0, sleep=False).data.qpos for each in together.kinds]
    )[number]
    other.qpos[kind.positions] = start
    torques = np.random.default_rng(number).uniform(-3.0, 3.0, own.nu)
    touching = 0
    for _ in range(100):
        one.ctrl[:] = other.ctrl[:] = torques
        mujoco.mj_step(own, one)
        mujoco.mj_step(model, other)
        touching = max(touching, one.ncon)
    assert touching >= 4
    np.testing.assert_allclose(other.qpos[kind.positions], one.qpos, atol=ALIKE)
    bodies = np.flatnonzero(kind.bodies)
    np.testing.assert_allclose(other.xipos[kind.bodies[bodies]], one.xipos[bodies], atol=ALIKE)
    robot = kind.sites >= 0
    np.testing.assert_allclose(other.site_xpos[kind.sites[robot]], one.site_xpos[robot], atol=ALIKE)
    assert kind.sites[own.site(kind.world.prefix + kind.world.robot.grip_site).id] >= 0


@pytest.mark.parametrize("number", [0, 1, 2])
def test_what_a_scene_does_not_need_is_far_away_and_stays_there(together, number):
    kind = together.kinds[number]
    model, geoms = _as_kind(together, number)
    data = mujoco.MjData(model)
    for _ in range(50):
        mujoco.mj_step(model, data)
    used = set(kind.geoms[kind.geoms >= 0].tolist())
    spare = [
        geoms[geom]
        for geom in range(together.world.model.ngeom)
        if geom not in used and together.world.model.geom_contype[geom]
    ]
    assert np.linalg.norm(data.geom_xpos[spare], axis=1).min() > PARKED - 1.0
    apart = np.linalg.norm(data.geom_xpos[spare][:, None] - data.geom_xpos[spare][None], axis=2)
    assert apart[np.triu_indices(len(spare), 1)].min() > 1.0
    idle = np.setdiff1d(np.arange(model.nv), kind.dofs)
    assert np.abs(data.qvel[idle]).max(initial=0.0) < 1e-12
    # At least one of the three scenes leaves places empty.
    assert len(spare) or number == 0


def test_who_owns_a_geom_is_said_by_every_scene_s_own_numbers(together):
    for number, kind in enumerate(together.kinds):
        there = np.flatnonzero(kind.geoms >= 0)
        np.testing.assert_array_equal(together.owner[number, kind.geoms[there]], kind.world.owner[there])


def test_a_pose_in_a_frame_is_applied_before_the_frame_s():
    outer, inner = Pose.from_yaw(0.7, (1.0, 2.0, 3.0)), Pose(position=(0.3, 0.0, -0.2), quat_wxyz=(0.8, 0.6, 0.0, 0.0))
    points = np.random.default_rng(0).normal(size=(5, 3))
    np.testing.assert_allclose(_joined(outer, inner).apply(points), outer.apply(inner.apply(points)), atol=1e-12)


def test_copies_of_one_world_need_no_places(worlds):
    one = alone(worlds[0])
    assert one.world.model.ngeom == worlds[0].model.ngeom
    assert merged(worlds[:1]).values == one.values == {}


def test_what_cannot_differ_is_refused_with_what_to_do(worlds):
    other = replace(worlds[1], model=worlds[1].model.__copy__())
    other.model.opt.timestep = 0.001
    with pytest.raises(EnvironmentSetupError, match=r'"red mug".* has another timestep.*async'):
        merged([worlds[0], other])


@pytest.mark.slow
def test_mujoco_warp_steps_all_kinds_as_each_by_itself(worlds):
    """Four control steps with random actions in single precision, contacts softened."""
    pytest.importorskip("mujoco_warp")
    from pat3d.envs.batch.physics import BatchedPhysics, Capacity

    sizes, both = Capacity(contacts=200, rows=1200), merged(worlds)
    together = BatchedPhysics(both, 2 * len(worlds), "osc", 20.0, "cpu", sizes)
    actions = np.random.default_rng(0).uniform(-1.0, 1.0, (4, 2 * len(worlds), together.controller.size))
    for action in actions.astype(np.float32):
        together.step(action)
    positions = together.data.qpos.numpy()
    for number, (kind, world) in enumerate(zip(both.kinds, worlds, strict=True)):
        for row in (number, number + len(worlds)):
            one = BatchedPhysics(alone(world), 1, "osc", 20.0, "cpu", sizes)
            for action in actions.astype(np.float32):
                one.step(action[row : row + 1])
            np.testing.assert_allclose(positions[row][kind.positions], one.data.qpos.numpy()[0], atol=10 * ALIKE)
