"""Every robot of MuJoCo Menagerie that can be had: Gymnasium's checker, where its hands get to, what it picks up.

    python benchmarks/robots.py [--robots panda so101 aloha panda+panda] [--episodes 20] [--objects "red mug" banana]

The scene is the one that ships with the package. The hand is sent to poses up to 0.13 m from its start, each of which
inverse kinematics reach (a pose that they do not is halved), for three seconds each. Of two arms each hand is sent
there while the other holds still; the worst of both counts, and how far the other hand is moved by it.
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
from pat3d.envs.robots.pairs import PAIRS
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
    parser.add_argument("--robots", nargs="+", default=[*ARMS, *PAIRS, "panda+panda"])
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
    arms = env.simulation.world.arms
    grippers = [measure_gripper(arm.robot.name) for arm in arms]
    found = [_distance(env, number, shift, arm.side) for arm in arms for number, shift in enumerate(SHIFTS)]
    worst, moved = np.max(found, axis=0)
    cells = [
        robot,
        ", ".join(str(len(arm.robot.arm_joints)) for arm in arms),
        ", ".join(f"{1e3 * gripper.opening:.0f}" for gripper in grippers),
        "passes",
        f"{1e3 * worst:.2f}" + (f" (the other {1e3 * moved:.2f})" if len(arms) > 1 else ""),
    ]
    times: list[float] = []
    cells += [_picks(robot, name, episodes, times) for name in objects]
    return f"| {' | '.join([*cells, f'{1e3 * statistics.median(times):.1f}' if times else ''])} |"


def _distance(env: TabletopEnv, seed: int, shift: np.ndarray, side: str) -> tuple[float, float]:
    """From where a hand is sent to where it is three seconds later, and how far the other one moved [m]."""
    env.reset(seed=seed)
    servo, world = Servo(env, side), env.simulation.world
    others = [Servo(env, arm.side) for arm in world.arms if arm.side != side]
    before = [other.hand[0] for other in others]
    start, rotation, _ = servo.hand
    mounted, stand = world.arm(side), env.placement
    other = stand.other
    base = stand.base_position if other is None or other.side != side else other.base_position
    arm = PlacedArm(arm_kinematics(mounted.robot.name), base, mounted.yaw)
    posture = env.simulation.posture(side)
    while arm.solve(goal := start + shift, rotation, posture) is None:
        shift = shift / 2.0
    for _ in range(SETTLED):
        env.step(servo.towards(goal, rotation, -1.0)[0])
    pushed = [float(np.linalg.norm(other.hand[0] - was)) for other, was in zip(others, before, strict=True)]
    return float(np.linalg.norm(servo.hand[0] - goal)), max(pushed, default=0.0)


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
