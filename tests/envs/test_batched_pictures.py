"""Pictures of many worlds are those of the single environment's ray tracer, drawn in Warp on the CPU or a GPU."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

pytest.importorskip("gymnasium")
wp = pytest.importorskip("warp")

from pat3d.envs.batch.pictures import TOLERANCE, BatchedPictures  # noqa: E402
from pat3d.envs.env import TabletopEnv  # noqa: E402
from pat3d.envs.observations import ObservationSpec, pictured  # noqa: E402
from tests.envs.own_arm import own_arm  # noqa: E402

DEVICES = ["cpu", pytest.param("cuda", marks=pytest.mark.skipif(not wp.is_cuda_available(), reason="no GPU"))]
SPEC = ObservationSpec(
    kind="rgbd", cameras=("agentview", "wrist"), height=60, width=90, segmentation=True, max_objects=5
)
"""No side is a multiple of a tile's."""


@pytest.fixture(scope="module")
def envs(tmp_path_factory):
    """The shipped scene with the arm in another posture, and with everything turned, moved and darker."""
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    made = [TabletopEnv(robot=str(path), task=task, start_noise=0.3) for task in ("pick:red mug", "pick:banana")]
    for number, env in enumerate(made):
        env.reset(seed=number)
    data, world = made[1].simulation.data, made[1].simulation.world
    for first in world.positions.tolist():
        data.qpos[first : first + 3] += (0.03, -0.02, 0.05)
        turned = np.array(data.qpos[first + 3 : first + 7]) + (0.1, 0.3, -0.2, 0.1)
        data.qpos[first + 3 : first + 7] = turned / np.linalg.norm(turned)
    mujoco.mj_forward(made[1].simulation.model, data)
    world.model.mat_rgba[:, :3] *= 0.5
    yield made
    for env in made:
        env.close()


def _stacked(envs, worlds: int, device: str):
    """States of MuJoCo as MuJoCo Warp holds them, turn by turn."""
    data = [envs[world % len(envs)].simulation.data for world in range(worlds)]

    def array(name, dtype, shape):
        return wp.array(
            np.stack([np.asarray(getattr(one, name), np.float32).reshape(shape) for one in data]), dtype=dtype
        )

    with wp.ScopedDevice(device):
        return SimpleNamespace(
            nworld=worlds,
            qpos=wp.zeros((worlds, 1)),
            xpos=array("xpos", wp.vec3, (-1, 3)),
            xmat=array("xmat", wp.mat33, (-1, 3, 3)),
            cam_xpos=array("cam_xpos", wp.vec3, (-1, 3)),
            cam_xmat=array("cam_xmat", wp.mat33, (-1, 3, 3)),
        )


@pytest.mark.parametrize("device", DEVICES)
def test_every_world_is_drawn_as_by_itself(envs, device):
    """Colours to TOLERANCE; depth and labels but for rays that graze an edge, one in a thousand."""
    worlds = [env.simulation.world for env in envs]
    model = worlds[0].model
    many = BatchedPictures(
        worlds,
        [np.arange(world.model.nbody) for world in worlds],
        [model.camera(name).id for name in SPEC.cameras],
        SPEC,
        _stacked(envs, 3, device),
    )
    seen = many.take()
    assert set(seen) == set(many.arrays)
    for number in range(3):
        alone = pictured(SPEC, envs[number % 2].pictures)
        assert set(alone) == set(seen)
        for name, expected in alone.items():
            found = seen[name][number]
            assert found.shape == expected.shape
            assert found.dtype == expected.dtype
            if name.endswith("_image"):
                assert np.abs(found.astype(float) - expected).mean() < TOLERANCE
                assert (found == expected).mean() > 0.99
            else:
                assert (np.abs(found.astype(float) - expected) > 1e-3).mean() < 1e-3
    # The two scenes differ, so a world that is drawn in another's place is seen.
    assert np.abs(seen["agentview_image"][0].astype(float) - seen["agentview_image"][1]).mean() > 2 * TOLERANCE
    np.testing.assert_array_equal(seen["agentview_image"][0], seen["agentview_image"][2])


@pytest.mark.parametrize("device", DEVICES)
def test_what_is_seen_through_is_that_of_the_single_environment(envs, device):
    """In the second world the mug is of glass: what is behind is seen, depth and labels stay."""
    made = [TabletopEnv(robot=envs[0].config.robot, task="pick:red mug") for _ in range(2)]
    for env in made:
        env.reset(seed=0)
    model = made[1].simulation.model
    objects = model.geom_matid[[geom for geom in range(model.ngeom) if "mug" in model.geom(geom).name]]
    model.mat_rgba[objects[objects >= 0], 3] = 0.25
    worlds = [env.simulation.world for env in made]
    cameras = [model.camera(name).id for name in SPEC.cameras]
    bodies = [np.arange(world.model.nbody) for world in worlds]
    seen = BatchedPictures(worlds, bodies, cameras, SPEC, _stacked(made, 2, device)).take()
    for number in range(2):
        for name, expected in pictured(SPEC, made[number].pictures).items():
            found = seen[name][number]
            if name.endswith("_image"):
                assert np.abs(found.astype(float) - expected).mean() < TOLERANCE
                assert (found == expected).mean() > 0.99
            else:
                assert (np.abs(found.astype(float) - expected) > 1e-3).mean() < 1e-3
    for name in ("agentview_depth", "agentview_segmentation"):
        assert (np.abs(seen[name][0].astype(float) - seen[name][1]) > 1e-3).mean() < 1e-3
    solid, clear = (seen["agentview_image"][world].astype(float) for world in range(2))
    mug = seen["agentview_segmentation"][0][..., 0] == 2 + worlds[0].objects.index("red mug")
    assert np.abs(solid - clear)[mug].mean() > 20.0
    assert np.abs(solid - clear)[~mug].max() < 1.5
    for env in made:
        env.close()


@pytest.mark.parametrize("device", DEVICES)
def test_rooms_environments_and_shadows_are_those_of_the_single_environment(envs, device):
    """A kitchen, a bare bench under a clear sky and a bare bench side by side, each in its own light."""
    robot = envs[0].config.robot
    around = ({"room": "kitchen"}, {"environment": "clear"}, {})
    made = [TabletopEnv(robot=robot, task="pick:red mug", **one) for one in around]
    for env in made:
        env.reset(seed=0)
    spec = replace(SPEC, shadows=True)
    worlds = [env.simulation.world for env in made]
    many = BatchedPictures(
        worlds,
        [np.arange(world.model.nbody) for world in worlds],
        [worlds[0].model.camera(name).id for name in spec.cameras],
        spec,
        _stacked(made, 4, device),
    )
    seen = many.take()
    for number in range(4):
        for name, expected in pictured(spec, made[number % 3].pictures).items():
            found = seen[name][number]
            if name.endswith("_image"):
                assert np.abs(found.astype(float) - expected).mean() < TOLERANCE
                assert (found == expected).mean() > 0.99
            else:
                assert (np.abs(found.astype(float) - expected) > 1e-3).mean() < 1e-3
    plain = pictured(SPEC, made[0].pictures)["agentview_image"].astype(float)
    assert np.abs(seen["agentview_image"][0] - plain).mean() > 2 * TOLERANCE, "there are shadows"
    for one, other in ((0, 1), (1, 2), (0, 2)):
        assert np.abs(seen["agentview_image"][one].astype(float) - seen["agentview_image"][other]).mean() > 5.0
    for env in made:
        env.close()


def test_an_observation_is_not_changed_by_the_next_one(envs):
    world = envs[0].simulation.world
    data = _stacked(envs[:1], 1, "cpu")
    spec = ObservationSpec(kind="rgb", cameras=("wrist",), height=16, width=16, segmentation=False, max_objects=5)
    many = BatchedPictures([world], [np.arange(world.model.nbody)], [world.model.camera("wrist").id], spec, data)
    before = many.take()["wrist_image"]
    kept = before.copy()
    data.cam_xpos.assign(data.cam_xpos.numpy() + np.float32(0.2))
    assert not np.array_equal(many.take()["wrist_image"], kept)
    np.testing.assert_array_equal(before, kept)
