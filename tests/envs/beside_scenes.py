"""Scenes in which something is put beside something else, and what tests do there."""

from __future__ import annotations

import numpy as np

from pat3d.assets.shapes import box
from pat3d.envs.env import TabletopEnv
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from pat3d.scene.model import Relation, Scene
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, asset_of, placed, scene_of

CUBE = asset_of(box(0.04, 0.04, 0.05))
SLAB = asset_of(box(0.12, 0.1, 0.03))
BOARD = asset_of(box(0.34, 0.3, 0.02))

STILL = np.zeros(7, dtype=np.float32)


def on_a_table() -> Scene:
    """A mug in a corner of the table, a plate, a jar and a lid on the jar."""
    return scene_of(
        placed("mug", CUBE, (0.22, -0.2, GAP)),
        placed("plate", SLAB, (-0.1, 0.05, GAP)),
        placed("jar", CUBE, (-0.25, -0.2, GAP)),
        placed("lid", asset_of(box(0.03, 0.03, 0.02)), (-0.25, -0.2, 0.05 + 2 * GAP)),
        relations=(Relation(child="lid", kind="on", parent="jar"),),
    )


def on_a_board() -> Scene:
    """A mug beside a board on which a plate stands."""
    return scene_of(
        placed("mug", CUBE, (-0.24, 0.05, GAP)),
        placed("board", BOARD, (0.0, 0.0, GAP)),
        placed("plate", asset_of(box(0.06, 0.06, 0.03)), (-0.08, 0.05, 0.02 + 2 * GAP)),
        relations=(Relation(child="plate", kind="on", parent="board"),),
    )


def made(scene, task: str, tmp_path_factory) -> TabletopEnv:
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return TabletopEnv(scene=scene, robot=str(path), task=task)


def put(env, name: str, at: tuple[float, float, float], quat=(1.0, 0.0, 0.0, 0.0)) -> dict:
    """Set an object down with its frame at a point [m] while an episode goes on, and look."""
    import mujoco

    world, data = env.simulation.world, env.simulation.data
    number = env.objects.index(name)
    data.qpos[world.positions[number] : world.positions[number] + 7] = [*at, *quat]
    data.qvel[world.velocities[number] : world.velocities[number] + 6] = 0.0
    mujoco.mj_forward(env.simulation.model, data)
    env.simulation.states.refresh()
    return env.step(STILL)[4]


def rest(env, steps: int = 25) -> dict:
    """Nothing is done until the episode ends, or for so long."""
    for _ in range(steps):
        _, _, success, _, info = env.step(STILL)
        if success:
            break
    return info


def scripted(env, spec: str, seed: int = 1) -> dict:
    """The scripted policy does a task; the last step's info."""
    _, info = env.reset(seed=seed, options={"task": spec})
    policy = ScriptedPolicy()
    policy.reset(
        EpisodeStart(
            instruction=info["instruction"], task=spec, seed=seed, robot=env.robot, control="osc", action_size=7,
            control_freq=20.0, env=env,
        )
    )  # fmt: skip
    for _ in range(env.horizon):
        _, _, success, _, info = env.step(policy.act({}))
        if success:
            break
    return info
