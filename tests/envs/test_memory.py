"""A process that goes through many scenes keeps a few of them, and no more of their files than is said."""

from __future__ import annotations

import gc
import weakref

import pytest

pytest.importorskip("gymnasium")

import mujoco

from pat3d.assets.shapes import box
from pat3d.envs.env import _KEPT_WORLDS, TabletopEnv
from pat3d.envs.physics import memory
from pat3d.envs.physics.memory import COMPILER_CACHE, bound_compiler_cache
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, asset_of, placed, scene_of

SCENES = _KEPT_WORLDS + 4


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


def cubes(number):
    """Two cubes, the second a little further away in every scene."""
    side = asset_of(box(0.04, 0.04, 0.04))
    return scene_of(placed("cube", side, (0.0, 0.0, GAP)), placed("post", side, (0.1 + 0.01 * number, 0.0, GAP)))


@pytest.mark.parametrize("obs", ["state", "rgb"])
def test_scenes_worlds_and_pictures_of_before_are_gone(arm, obs, monkeypatch):
    """As many as the environment says it keeps; every other one's assets, compiled model and state are freed."""
    returned = []
    monkeypatch.setattr("pat3d.envs.env.give_back", lambda: returned.append(1))
    env = TabletopEnv(cubes(0), robot=arm, task="pick:cube", obs=obs, cameras=("agentview",), image_size=(32, 32))
    assets, worlds = [], []
    for number in range(SCENES):
        env.reset(seed=0, options={"scene": cubes(number), "task": "pick:cube"})
        # What judges and grasps ask of a shape is computed once for it.
        env.simulation.state.points("cube")
        assets.append(weakref.ref(env.scene.objects[0].asset))
        worlds.append(weakref.ref(env.simulation.world))
    gc.collect()
    for kept in (assets, worlds):
        assert sum(one() is not None for one in kept) == _KEPT_WORLDS
        assert [one() is not None for one in kept] == [False] * (SCENES - _KEPT_WORLDS) + [True] * _KEPT_WORLDS
    assert len(returned) == SCENES - _KEPT_WORLDS
    env.close()


def test_files_that_the_compiler_keeps_are_bounded_and_a_larger_bound_of_ones_own_is_left(arm):
    cache = mujoco.mj_getCache()
    bound_compiler_cache.cache_clear()
    mujoco.mj_setCacheCapacity(cache, 10 * COMPILER_CACHE)
    env = TabletopEnv(cubes(0), robot=arm, task="pick:cube")
    assert mujoco.mj_getCacheCapacity(cache) == COMPILER_CACHE
    try:
        mujoco.mj_setCacheCapacity(cache, 2 * COMPILER_CACHE)
        env.reset(options={"scene": cubes(1), "task": "pick:cube"})
        assert mujoco.mj_getCacheCapacity(cache) == 2 * COMPILER_CACHE
    finally:
        mujoco.mj_setCacheCapacity(cache, COMPILER_CACHE)
        env.close()


def test_free_memory_is_given_back_where_the_c_library_can(monkeypatch):
    """It is asked to keep no room; other libraries are not asked."""
    asked = []
    monkeypatch.setattr(memory, "_trim", lambda: asked.append)
    memory.give_back()
    assert asked == [0]
    monkeypatch.setattr(memory, "_trim", lambda: None)
    memory.give_back()
    assert asked == [0]
