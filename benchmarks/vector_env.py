"""Steps a second of many worlds on MuJoCo Warp, against MuJoCo on one CPU core in the same run.

    python benchmarks/vector_env.py [--worlds 2048] [--scenes FOLDER ...] [--device cuda]

Physics counts every world's time steps with the controller in them; env.step adds observations, tasks and resets. Last,
what the scripted policy did on the CPU is done again in all worlds, without looking: how many pick the object up?
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import mujoco
import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.envs.env import TabletopEnv
from pat3d.envs.vector import BatchedTabletopEnv
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy

TARGET = 250_000
"""Physics steps a second of 2,048 worlds of a ten-object scene on an H200."""

STEPS = 40
"""Control steps of a measurement."""


def recorded(env: TabletopEnv) -> NDArray[np.float32]:
    """The actions of one scripted episode that succeeded, shape (steps, action size)."""
    observation, _ = env.reset(seed=0)
    policy = ScriptedPolicy()
    policy.reset(
        EpisodeStart(
            instruction=env.instruction,
            task=env.task.spec,
            seed=0,
            robot=env.robot,
            control=env.control,
            action_size=env.simulation.controller.size,
            control_freq=env.control_freq,
            env=env,
        )
    )
    actions: list[NDArray[np.float32]] = []
    for _ in range(400):
        for action in np.atleast_2d(policy.act(observation)):
            actions.append(np.asarray(action, dtype=np.float32))
            observation, _, success, broken, _ = env.step(actions[-1])
            if success:
                return np.array(actions)
            if broken:
                return np.zeros((0, 7), dtype=np.float32)
    return np.zeros((0, 7), dtype=np.float32)


def on_one_core(env: TabletopEnv) -> float:
    """Physics steps a second of MuJoCo with the robot standing still, nothing asleep."""
    env.reset(seed=0)
    simulation = env.simulation
    simulation.controller.set_action(np.zeros(simulation.controller.size))
    begin, count = time.process_time(), 0
    while time.process_time() - begin < 1.0:
        simulation.controller.control()
        mujoco.mj_step2(simulation.model, simulation.data)
        mujoco.mj_step1(simulation.model, simulation.data)
        count += 1
    return count / (time.process_time() - begin)


def measure(folder: str | None, worlds: int, device: str) -> None:
    """Print the lines of one scene."""
    alone = TabletopEnv(folder, sleep=False, start_noise=0.0)
    peer = on_one_core(alone)
    actions = recorded(alone)
    begin = time.perf_counter()
    together: Any = BatchedTabletopEnv(worlds, device=device, scene=folder, task=alone.task, start_noise=0.0)
    physics = together.physics
    model = physics.world.model
    print(
        f"\n{folder or 'shipped scene'}: {len(together.objects)} moving objects, {model.ngeom} geoms, "
        f"{model.nv} degrees of freedom; {alone.task.spec}\n"
        f"ready in {time.perf_counter() - begin:.1f} s, still for 5 s; capacity {physics.capacity}",
        flush=True,
    )
    random = np.random.default_rng(0)
    moves = random.uniform(-0.3, 0.3, (STEPS, worlds, physics.controller.size)).astype(np.float32)
    together.reset(seed=0)
    physics.step(moves[0])
    wp.synchronize()
    begin = time.perf_counter()
    for move in moves:
        physics.step(move)
    wp.synchronize()
    stepping = time.perf_counter() - begin
    rate = STEPS * worlds * physics.substeps / stepping
    iterations = physics.data.solver_niter.numpy()
    print(
        f"physics: {rate:,.0f} steps/s (target {TARGET:,}: {rate / TARGET:.2f} times), one CPU core {peer:,.0f}: "
        f"{rate / peer:.0f} times; {iterations.mean():.1f} iterations of the solver (most {iterations.max()}), "
        f"peaks {physics.peaks}",
        flush=True,
    )
    together.reset(seed=0)
    begin = time.perf_counter()
    for move in moves:
        together.step(move)
    seconds = time.perf_counter() - begin
    rate = STEPS * worlds / seconds
    print(
        f"env.step: {rate:,.0f} control steps/s, {rate * physics.substeps:,.0f} physics steps/s; beside the physics "
        f"{1e3 * (seconds - stepping) / STEPS:.1f} ms a step of all worlds",
        flush=True,
    )
    if len(actions):
        together.reset(seed=0)
        succeeded = np.zeros(worlds, dtype=bool)
        for action in actions:
            succeeded |= together.step(np.broadcast_to(action, (worlds, len(action))))[2]
        print(
            f"scripted actions done again: {succeeded.sum()} of {worlds} worlds succeed, {physics.lost.sum()} lost",
            flush=True,
        )
    place = wp.get_device(device)
    if place.is_cuda:
        print(f"{(place.total_memory - place.free_memory) / 1e9:.1f} GB in use", flush=True)


def main() -> None:
    """Measure scene after scene."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", type=int, default=2048)
    parser.add_argument("--scenes", nargs="+", default=[None], help="scene folders; the shipped scene by default")
    parser.add_argument("--device", default="cuda")
    options = parser.parse_args()
    wp.config.log_level = wp.LOG_WARNING
    for folder in options.scenes:
        measure(folder, options.worlds, options.device)


if __name__ == "__main__":
    main()
