"""Figures of policy evaluation: the scripted, the random and a cloned policy, overhead, and replay.

    python benchmarks/evaluate.py --parts objects clutter random clone replay [--objects 40] [--out FOLDER]

objects: every graspable object of the catalogue alone; clutter: every object that can be picked in scenes from prompts;
both with the scripted policy. random: the random policy on the same cluttered episodes. clone: a cloned policy and the
scripted one where the shipped scene's mug stands elsewhere than in the demonstrations. replay: all of these episodes
again, bit for bit. Overhead is what is neither physics nor the policy.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from pat3d.assets.catalogue.registry import entries, make
from pat3d.envs.env import choose
from pat3d.envs.loading import load
from pat3d.errors import Pat3dError
from pat3d.policies_eval.episodes import Setting, episodes_of
from pat3d.policies_eval.evaluate import evaluate
from pat3d.policies_eval.perturb import Perturbation
from pat3d.policies_eval.records import Evaluation, read_evaluation
from pat3d.policies_eval.replay import Replayer
from pat3d.policies_eval.rollout import Result
from pat3d.policies_eval.summary import summarise
from pat3d.policies_eval.train import train
from pat3d.scene import Pose, Scene, SceneObject
from pat3d.scene_io import load_scene, save_scene

PARTS = ("objects", "clutter", "random", "clone", "replay")
LAYOUTS = Perturbation(pose=0.04)
"""Where the mug stands: other draws for training than for testing."""


def main() -> None:
    """Run the parts that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--objects", type=int, default=40, help="of the catalogue, evenly spread over it")
    parser.add_argument("--prompts", default=str(Path(__file__).with_name("prompts.txt")), help="one a line")
    parser.add_argument("--scenes", type=int, default=8, help="cluttered scenes")
    parser.add_argument("--episodes", type=int, default=1, help="of every object")
    parser.add_argument("--demonstrations", type=int, default=100)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--out", default=None, help="folder of scenes and records; an unfinished run goes on there")
    options = parser.parse_args()
    work = Path(options.out or tempfile.mkdtemp(prefix="pat3d-evaluate-"))
    done: list[Evaluation] = []

    def run(name: str, policy: str, settings: list[Setting], count: int, perturbation: Perturbation | None = None):
        episodes = episodes_of(settings, count, perturbation=perturbation)
        found = evaluate(policy, episodes, work / name, workers=options.workers, report=_tell)
        summary = summarise(found)
        whole = max(sum(summary.seconds.values()), 1e-9)
        print(f"{name}: success {summary.rate}; outcomes {summary.outcomes}; "
              f"overhead {100 * summary.seconds['overhead'] / whole:.2f} % of {whole:.0f} s", flush=True)  # fmt: skip
        done.append(found)

    if "objects" in options.parts:
        settings = _single(work / "scenes", options.objects)
        run("objects", "scripted", settings, len(settings) * options.episodes)
    if {"clutter", "random"} & set(options.parts):
        settings = _cluttered(work / "scenes", options.prompts, options.scenes)
        if "clutter" in options.parts:
            run("clutter", "scripted", settings, len(settings) * options.episodes)
        if "random" in options.parts:
            run("random", "random", settings, len(settings) * options.episodes)
    if "clone" in options.parts:
        mug = [Setting(scene="", task="pick:red mug")]
        if not (work / "cloned.pt").is_file():
            train(episodes_of(mug, options.demonstrations, seed=1, perturbation=LAYOUTS), work / "cloned.pt")
        for name, policy in (("layouts_scripted", "scripted"), ("layouts_cloned", str(work / "cloned.pt"))):
            run(name, policy, mug, 20 * options.episodes, LAYOUTS)
    if "replay" in options.parts:
        names = ("objects", "clutter", "random", "layouts_scripted", "layouts_cloned")
        found = [read_evaluation(work / name) for name in names if (work / name / "manifest.json").is_file()]
        same = [Replayer(one).same(result) for one in found for result in one.results if result.state_hash]
        print(f"replay: {sum(same)} of {len(same)} episodes equal, bit for bit")


def _single(folder: Path, count: int) -> list[Setting]:
    """One scene for each of `count` objects that can be picked when they stand alone."""
    found, nouns = [], [one.noun for one in entries()]
    # A stride that shares no factor with any such number visits every family early.
    for number in range(len(nouns)):
        noun = nouns[(number * 37) % len(nouns)]
        place = folder / "single" / noun.replace(" ", "_")
        task = f"pick:{noun}"
        try:
            if not (place / "scene.json").is_file():
                pose = Pose.from_yaw(0.0, (0.0, 0.0, 0.0))
                scene = Scene(objects=(SceneObject(name=noun, asset=make(noun), pose=pose, initial_pose=pose),))
                choose(scene, task, "Panda")
                save_scene(scene, place)
            load(place)
        except Pat3dError as error:
            print(f"left out: {noun}: {str(error)[:110]}", flush=True)
            continue
        found.append(Setting(scene=str(place), task=task))
        if len(found) == count:
            break
    print(f"{len(found)} objects", flush=True)
    return found


def _cluttered(folder: Path, prompts: str, count: int) -> list[Setting]:
    """Every object that can be picked in scenes of at least four objects."""
    from pat3d.pipeline import generate

    found, scenes = [], 0
    lines = [line for line in Path(prompts).read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
    for number, prompt in enumerate(lines):
        place = folder / f"clutter_{number:02d}"
        try:
            if not (place / "scene.json").is_file():
                generate(prompt, out=place)
            scene = load_scene(place)
            load(place)
        except Pat3dError as error:
            print(f"left out: {prompt[:60]}: {str(error)[:100]}", flush=True)
            continue
        tasks = []
        for obj in scene.objects:
            try:
                tasks.append(choose(scene, f"pick:{obj.name}", "Panda")[0].spec)
            except Pat3dError as error:
                print(f"  no task: {str(error)[:110]}", flush=True)
        if len(scene.objects) < 4 or not tasks:
            continue
        found += [Setting(scene=str(place), task=task) for task in tasks]
        scenes += 1
        if scenes == count:
            break
    print(f"{scenes} scenes, {len(found)} tasks", flush=True)
    return found


def _tell(result: Result, done: int, wanted: int) -> None:
    print(f"  {done}/{wanted} {result.episode.task}: {result.outcome} {result.reason} ({result.steps} steps, "
          f"{result.wall_seconds:.1f} s)", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
