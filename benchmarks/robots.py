"""Every arm of MuJoCo Menagerie that can be had: Gymnasium's checker, where its hand gets to, and what it picks up.

    python benchmarks/robots.py [--robots panda so101] [--episodes 20] [--objects "red mug" banana]

The scene is the one that ships with the package. The hand is sent to poses up to 0.13 m from its start, each of which
inverse kinematics reach (a pose that they do not is halved), for three seconds each.
"""

from __future__ import annotations

import argparse
import statistics
import time
import warnings

import numpy as np
from gymnasium.utils.env_checker import check_env

from pat3d.envs.env import TabletopEnv
from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.robots.arms import arm_kinematics, measure_gripper
from pat3d.envs.robots.kinematics import PlacedArm
from pat3d.envs.robots.menagerie import ARMS
from pat3d.errors import EnvironmentSetupError, TaskError
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy

SHIFTS = np.array([[0.08, 0.0, 0.0], [0.0, 0.1, 0.05], [-0.05, -0.08, 0.1], [0.0, 0.0, -0.05]])
"""Of the hand from its start [m]."""

SETTLED = 60
"""Control steps for each of them."""

LONGEST = 400
"""Control steps of a pick."""


def main() -> None:
    """Print a row for every robot."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", nargs="+", default=list(ARMS))
    parser.add_argument("--episodes", type=int, default=20)
    parser.add_argument("--objects", nargs="+", default=["red mug"])
    options = parser.parse_args()
    picks = " | ".join(f"picks of the {name}" for name in options.objects)
    print(f"| robot | joints | opens [mm] | check_env | hand from its goal [mm] | {picks} | env.step [ms] |")
    print("| --- " * (6 + len(options.objects)) + "|")
    for robot in options.robots:
        try:
            print(_row(robot, options.objects, options.episodes), flush=True)
        except EnvironmentSetupError as error:
            print(f"| {robot} | {str(error).splitlines()[0][:100]} |", flush=True)


def _row(robot: str, objects: list[str], episodes: int) -> str:
    env = TabletopEnv(robot=robot, task=f"pick:{objects[0]}")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)
    gripper, joints = measure_gripper(env.robot), len(env.simulation.world.robot.arm_joints)
    worst = max(_distance(env, number, shift) for number, shift in enumerate(SHIFTS))
    cells = [robot, str(joints), f"{1e3 * gripper.opening:.0f}", "passes", f"{1e3 * worst:.2f}"]
    times: list[float] = []
    cells += [_picks(robot, name, episodes, times) for name in objects]
    return f"| {' | '.join([*cells, f'{1e3 * statistics.median(times):.1f}' if times else ''])} |"


def _distance(env: TabletopEnv, seed: int, shift: np.ndarray) -> float:
    """From where the hand is sent to where it is three seconds later [m]."""
    env.reset(seed=seed)
    state, servo, place = env.simulation.state, Servo(env), env.placement
    arm = PlacedArm(arm_kinematics(env.robot), place.base_position, place.yaw)
    rotation = state.hand_rotation.copy()
    while arm.solve(goal := state.hand + shift, rotation, env.simulation.arm.copy()) is None:
        shift = shift / 2.0
    for _ in range(SETTLED):
        env.step(servo.towards(goal, rotation, -1.0)[0])
    return float(np.linalg.norm(env.simulation.state.hand - goal))


def _picks(robot: str, name: str, episodes: int, times: list[float]) -> str:
    try:
        env = TabletopEnv(robot=robot, task=f"pick:{name}")
    except TaskError as error:
        return str(error)
    policy, done = ScriptedPolicy(), 0
    for seed in range(episodes):
        observation, _ = env.reset(seed=seed)
        policy.reset(
            EpisodeStart(
                instruction=env.instruction,
                task=env.task.spec,
                seed=seed,
                robot=env.robot,
                control=env.control,
                action_size=env.simulation.controller.size,
                control_freq=env.control_freq,
                env=env,
            )
        )
        success, steps = False, 0
        while not success and steps < LONGEST:
            action = policy.act(observation)
            begun = time.process_time()
            observation, _, success, *_ = env.step(action)
            times.append(time.process_time() - begun)
            steps += 1
        done += success
    return f"{done} of {episodes}"


if __name__ == "__main__":
    main()
