"""Steps a second of many worlds on MuJoCo Warp, against MuJoCo on one CPU core in the same run.

    python benchmarks/vector_env.py [--worlds 2048] [--scenes FOLDER ...] [--suite FOLDER ...] [--device cuda]

Physics counts every world's time steps with the controller in them; env.step adds observations, tasks and resets. What
the scripted policy did on the CPU is done again in all worlds, without looking: how many pick the object up? Pictures
are of one camera in every world, against MuJoCo Warp's own renderer and the single environment's in the same run. The
worlds of a suite have different scenes.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
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

FRAMES_TARGET, SUITE_TARGET = 25_000, 150_000
"""Pictures a second of such worlds, and physics steps a second of worlds with 256 different scenes."""

STEPS = 40
"""Control steps of a measurement."""

SIDE, CAMERA = 128, "agentview"
"""Of pictures [pixel]."""


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
    drawing(folder, worlds, device, alone.task)
    place = wp.get_device(device)
    if place.is_cuda:
        print(f"{(place.total_memory - place.free_memory) / 1e9:.1f} GB in use", flush=True)


def drawing(folder: str | None, worlds: int, device: str, task: Any) -> None:
    """Print how fast the worlds of one scene are drawn."""
    options: dict[str, Any] = {"obs": "rgb", "cameras": (CAMERA,), "image_size": (SIDE, SIDE), "start_noise": 0.0}
    together: Any = BatchedTabletopEnv(worlds, device=device, scene=folder, task=task, **options)
    alone = TabletopEnv(folder, task=task, sleep=False, **options)
    theirs = alone.reset(seed=0)[0][f"{CAMERA}_image"]
    ours = together.reset(seed=0)[0][f"{CAMERA}_image"]
    apart = float(np.abs(theirs.astype(np.float64) - ours[0]).mean())
    print(
        f"pictures of {SIDE} x {SIDE}, {CAMERA}: {apart:.3f} of 255 from the single environment's on average; "
        f"{_rate(lambda: together.pictures.draw(), worlds):,.0f} a second (target {FRAMES_TARGET:,}), brought to the "
        f"CPU {_rate(lambda: together.pictures.take(), worlds):,.0f}, physics and all "
        f"{_rate(lambda: together.step(np.zeros(together.action_space.shape, np.float32)), worlds):,.0f}",
        flush=True,
    )
    print(
        f"MuJoCo Warp's renderer, in its own light: {_rate(_peer(together.physics), worlds):,.0f}; the single "
        f"environment: {_rate(lambda: alone.pictures.take(CAMERA, SIDE, SIDE), 1):,.0f}",
        flush=True,
    )


def _rate(work: Callable[[], Any], count: int, seconds: float = 1.0) -> float:
    """How often `work`, which does something `count` times, does it in a second."""
    work()
    wp.synchronize()
    begin, rounds = time.perf_counter(), 0
    while rounds < 3 or time.perf_counter() - begin < seconds:
        work()
        wp.synchronize()
        rounds += 1
    return rounds * count / (time.perf_counter() - begin)


def _peer(physics: Any) -> Callable[[], Any]:
    """MuJoCo Warp's own renderer of the same camera, textures and all, without shadows."""
    import mujoco_warp

    model = physics.world.model
    with wp.ScopedDevice(physics.device):
        context = mujoco_warp.create_render_context(
            model,
            nworld=physics.worlds,
            cam_res=(SIDE, SIDE),
            render_rgb=True,
            render_depth=False,
            cam_active=[model.camera(number).name == CAMERA for number in range(model.ncam)],
        )

    def work() -> None:
        with wp.ScopedDevice(physics.device):
            mujoco_warp.refit_bvh(physics._model, physics.data, context)
            mujoco_warp.render(physics._model, physics.data, context)

    return work


def different(folder: str, worlds: int, device: str) -> None:
    """Print the lines of a suite whose scenes are all in one batch."""
    begin = time.perf_counter()
    together: Any = BatchedTabletopEnv(worlds, device=device, suite=folder)
    physics = together.physics
    kinds = [len(group.job.world.objects) for group in together.groups]
    print(
        f"\n{folder}: {len(kinds)} different scenes of {min(kinds)} to {max(kinds)} moving objects, "
        f"{physics.world.model.ngeom} geoms, {physics.world.model.nv} degrees of freedom\n"
        f"ready in {time.perf_counter() - begin:.1f} s, still for 5 s; capacity {physics.capacity}",
        flush=True,
    )
    random = np.random.default_rng(0)
    moves = random.uniform(-0.3, 0.3, (STEPS, worlds, physics.controller.size)).astype(np.float32)
    for name, work in (("physics", physics.step), ("env.step", together.step)):
        together.reset(seed=0)
        work(moves[0])
        wp.synchronize()
        begin = time.perf_counter()
        for move in moves:
            work(move)
        wp.synchronize()
        rate = STEPS * worlds * physics.substeps / (time.perf_counter() - begin)
        print(f"{name}: {rate:,.0f} physics steps/s (target {SUITE_TARGET:,}); peaks {physics.peaks}", flush=True)


def main() -> None:
    """Measure scene after scene."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", type=int, default=2048)
    parser.add_argument("--scenes", nargs="*", default=[None], help="scene folders; the shipped scene by default")
    parser.add_argument("--suite", nargs="+", default=[], help="suite folders, whose scenes make one batch")
    parser.add_argument("--device", default="cuda")
    options = parser.parse_args()
    wp.config.log_level = wp.LOG_WARNING
    for folder in options.scenes:
        measure(folder, options.worlds, options.device)
    for folder in options.suite:
        different(folder, options.worlds, options.device)


if __name__ == "__main__":
    main()
