"""Figures of policy evaluation: the scripted, the random and a cloned policy, replay, overhead, and several workers.

    python benchmarks/evaluate.py [--parts PART ...] [--workers 8] [--out FOLDER]

objects: objects of the catalogue alone, each turned in several ways, with the scripted policy. clutter: scenes of eight
to twelve objects from `pat3d suite`, an object of each to pick. tasks: scenes of a suite for every other kind of task.
random: the random policy on the same cluttered episodes. clone: a network trained on demonstrations, and the scripted
policy, where the shipped scene's mug stands elsewhere than in the demonstrations. replay: a hundred of these episodes
again, bit for bit. overhead: what is neither physics, rendering nor policy, of the shipped scene's episodes in one
process, imports and reading the scene left out; and what reading a scene takes. workers: episodes a second with eight
processes against one, start-up left out.

A run that was killed goes on where it stopped when it is given the same --out. Every part prints its row of the table
at once; all rows are in table.md. In CPU seconds about: objects 1.5 for each refused object, 3 for a scene and 1 for an
episode; clutter 5 for a scene and 1 for an episode; random 4 for an episode; clone 200 in all, 60 of them in one
process; replay 100; overhead 30; workers 25 in one process and 8 times that in eight.
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

if __name__ in ("__main__", "__mp_main__"):
    # Before numerical libraries start their threads.
    for _library in ("OMP", "OPENBLAS", "MKL", "NUMEXPR", "NUMBA", "BLIS"):
        os.environ[f"{_library}_NUM_THREADS"] = "1"

from evaluate_scenes import replayed, single, spread

from pat3d.assets.catalogue.lookup import entries
from pat3d.policies_eval.analysis.statistics import wilson
from pat3d.policies_eval.analysis.summary import summarise
from pat3d.policies_eval.datasets.demonstrations import demonstrate
from pat3d.policies_eval.run.episodes import Episode, Setting, episodes_of
from pat3d.policies_eval.run.evaluate import evaluate
from pat3d.policies_eval.run.perturb import Perturbation
from pat3d.policies_eval.run.records import Evaluation, read_evaluation
from pat3d.policies_eval.run.rollout import Result
from pat3d.policies_eval.run.suites import suite_settings
from pat3d.policies_eval.train import fit
from pat3d.policies_eval.training import Training

PARTS = ("objects", "clutter", "tasks", "random", "clone", "replay", "overhead", "workers")

LAYOUTS = Perturbation(pose=0.04)
"""Where the mug stands: other draws for training than for testing."""

MUG = Setting(scene="", task="pick:red mug")

CLUTTER = (8, 12)
"""Fewest and most objects of a cluttered scene."""

KINDS = ("sort", "retrieve", "place", "stack", "unload")
"""Of tasks, picks aside."""

SEVERAL = 8
"""Workers that are compared with one."""


class Benchmark:
    """The parts, what they are asked for, and the table."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.options = options
        self.work = Path(options.out or tempfile.mkdtemp(prefix="pat3d-evaluate-"))
        self.work.mkdir(parents=True, exist_ok=True)
        self.begun = time.perf_counter()

    def run(self) -> None:
        """Do the parts that are asked for."""
        say("| what | measured | target |")
        say("| --- | ---: | ---: |")
        for part in self.options.parts:
            getattr(self, part)()
            say(f"  ({part} done after {time.perf_counter() - self.begun:.0f} s)")

    def objects(self) -> None:
        """Single-object pick over the catalogue."""
        nouns = [one.noun for one in entries()]
        # A stride that shares no factor with any such number visits every family early.
        nouns = [nouns[(number * 37) % len(nouns)] for number in range(len(nouns))]
        if self.options.objects:
            nouns = nouns[: self.options.objects]
        settings, refused = single(self.work / "single", nouns, self.options.layouts, self.options.workers)
        self._keep("refused", refused)
        found = self._evaluate("objects", "scripted", settings, len(settings) * self.options.episodes)
        by_object: dict[str, list[bool]] = {}
        for one in found.results:
            by_object.setdefault(one.episode.task.partition(":")[2], []).append(one.success)
        never = sorted(name for name, went in by_object.items() if not any(went))
        self.row(f"scripted, single-object pick, {len(by_object)} objects", rate(found), ">= 90 % of >= 40 objects")
        always = sum(all(went) for went in by_object.values())
        self.row("objects picked every time", f"{always} of {len(by_object)}", "")
        say(f"  never picked: {', '.join(never) or 'none'}")
        say(f"  no scene of {len(refused)} of {len(nouns)} nouns: {kinds(refused)}")

    def clutter(self) -> None:
        """Pick in clutter."""
        settings = self._cluttered()
        found = self._evaluate("clutter", "scripted", settings, len(settings) * self.options.episodes)
        self.row(f"scripted, cluttered pick, {len(settings)} scenes", rate(found), ">= 75 %")

    def tasks(self) -> None:
        """Every kind of task but pick, in scenes of a suite."""
        from pat3d.envs.suites.generate import generate
        from pat3d.envs.suites.request import Request

        folder, each = self.work / "tasks_suite", self.options.each
        request = Request(tasks=KINDS, scenes=each * len(KINDS), seed=33, picture=0)
        if not (folder / "suite.json").is_file():
            generate(str(folder), request, workers=self.options.workers)
        settings = sorted(suite_settings(str(folder), None)[0], key=lambda one: one.scene)
        found = self._evaluate("tasks", "scripted", settings, len(settings))
        for kind in KINDS:
            went = [one.success for one in found.results if one.episode.task.startswith(kind)]
            self.row(f"scripted, {kind}, {len(went)} scenes", str(wilson(sum(went), len(went))), "")

    def random(self) -> None:
        """The same with random actions."""
        settings = self._cluttered()
        found = self._evaluate("random", "random", settings, len(settings) * self.options.episodes)
        self.row("random, the same scenes", rate(found), "< 2 %")

    def clone(self) -> None:
        """A cloned policy against the scripted one on held-out layouts."""
        from pat3d.policies_eval.policies.cloning import save

        file = self.work / "cloned.pt"
        if not file.is_file():
            begun, cpu = time.perf_counter(), time.process_time()
            episodes = episodes_of([MUG], self.options.demonstrations, seed=1, perturbation=LAYOUTS)
            shown = demonstrate(episodes, workers=self.options.workers)
            network, error = fit(shown, Training(epochs=200))
            save(network, file, {"demonstrations": len(shown), "epochs": 200, "error": error, "seed": 0})
            say(
                f"  trained on {len(shown)} demonstrations in {time.perf_counter() - begun:.0f} s, "
                f"{time.process_time() - cpu:.0f} CPU seconds in this process"
            )
        count, rates = self.options.held_out, {}
        for name, policy in (("layouts_scripted", "scripted"), ("layouts_cloned", str(file))):
            found = self._evaluate(name, policy, [MUG], count, LAYOUTS)
            rates[name] = rate(found)
        self.row("scripted, held-out layouts of one task", rates["layouts_scripted"], "")
        self.row("cloned, the same episodes", rates["layouts_cloned"], "> half of scripted")

    def replay(self) -> None:
        """Recorded episodes again."""
        names = ("objects", "clutter", "random", "layouts_scripted", "layouts_cloned")
        chosen: list[tuple[str, int]] = []
        for name in names:
            if (self.work / name / "manifest.json").is_file():
                results = [one for one in read_evaluation(self.work / name).results if one.state_hash]
                chosen += [(name, one.episode.index) for one in results]
        if not chosen:
            say("  nothing to replay: give --out with objects, clutter or clone done")
            return
        step = max(1, len(chosen) // self.options.replays)
        chosen = chosen[::step][: self.options.replays]
        jobs = [(str(self.work / name), [index]) for name, index in chosen]
        same = sum(answer[0] for _, answer in spread(replayed, jobs, self.options.workers))
        self.row("episodes that replay bit for bit", f"{same} of {len(jobs)}", f"{len(jobs)} of {len(jobs)}")

    def overhead(self) -> None:
        """Processor time of an evaluation in this process, and what physics and the policy have of it."""
        kept = self._kept("overhead")
        if kept is None:
            # Imports and compilation are done once in a process.
            self._evaluate("overhead_warm", "scripted", [MUG], 1, workers=0, overwrite=True)
            clock = Clock()
            with clock.watching():
                begun = time.process_time()
                found = self._evaluate("overhead", "scripted", [MUG], self.options.timed, workers=0, overwrite=True)
                spent = time.process_time() - begun
            kept = self._keep("overhead", {"spent": spent, "episodes": len(found.results), **clock.seconds})
        spent, setup = kept["spent"] - kept["setup"], kept["setup"]
        strict = spent - kept["physics"] - kept["start"] - kept["rendering"] - kept["policy"]
        own = spent - kept["physics"] - kept["environment"] - kept["policy"]
        shares = [f"{100 * seconds / spent:.1f} %" for seconds in (strict, own)]
        self.row("neither physics, rendering nor policy, share of processor time", shares[0], "< 5 %")
        self.row("neither physics, environment nor policy", shares[1], "")
        told = ", ".join(f"{name} {100 * kept[name] / spent:.1f} %" for name in Clock.NAMES if name != "setup")
        say(f"  {kept['episodes']} episodes in {spent:.1f} s: {told}")
        self.row("reading a scene and placing the robot, once for each scene [s]", f"{setup:.2f}", "")

    def workers(self) -> None:
        """Episodes a second with several workers and with one."""
        rates = {}
        for count in (1, min(SEVERAL, self.options.workers)):
            name = f"workers_{count}"
            kept = self._kept(name)
            if kept is None:
                ends: list[float] = []
                self._evaluate(
                    name,
                    "scripted",
                    [MUG],
                    self.options.timed * count + count,
                    LAYOUTS,
                    workers=count,
                    ends=ends,
                    overwrite=True,
                )
                # Every worker's first episode carries its start.
                kept = self._keep(name, {"seconds": ends[-1] - ends[count - 1], "episodes": len(ends) - count})
            rates[count] = kept["episodes"] / kept["seconds"]
            say(f"  {count} workers: {kept['episodes']} episodes in {kept['seconds']:.1f} s, {rates[count]:.2f} a s")
        several = max(rates)
        self.row(
            f"{several} workers against one, episodes a second", f"{rates[several] / rates[1]:.2f} times", ">= 6 times"
        )

    def row(self, what: str, measured: str, target: str) -> None:
        """Print a row of the table, and keep it."""
        line = f"| {what} | {measured} | {target} |"
        say(line)
        file = self.work / "table.md"
        rows = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
        rows = [old for old in rows if not old.startswith(f"| {what} |")]
        file.write_text("\n".join([*rows, line]) + "\n", encoding="utf-8")

    def _cluttered(self) -> list[Setting]:
        """Scenes of eight to twelve objects, with an object to pick each; those of a suite, which are verified."""
        from pat3d.envs.suites.generate import generate
        from pat3d.envs.suites.request import Request

        folder = self.work / "suite"
        request = Request(tasks=("pick",), scenes=self.options.scenes, objects=CLUTTER, picture=0)
        if not (folder / "suite.json").is_file():
            generate(str(folder), request, workers=self.options.workers)
        return sorted(suite_settings(str(folder), None)[0], key=lambda one: one.scene)

    def _evaluate(
        self,
        name: str,
        policy: str,
        settings: list[Setting],
        count: int,
        perturbation: Perturbation | None = None,
        *,
        workers: int | None = None,
        ends: list[float] | None = None,
        overwrite: bool = False,
    ) -> Evaluation:
        episodes: tuple[Episode, ...] = episodes_of(settings, count, perturbation=perturbation)

        def report(result: Result, done: int, wanted: int) -> None:
            if ends is not None:
                ends.append(time.perf_counter())
            if not result.success and policy != "random":
                say(
                    f"  {name} {done}/{wanted} {result.episode.task} in {Path(result.episode.scene).name}: "
                    f"{result.outcome} {result.reason} ({result.steps} steps, {result.wall_seconds:.1f} s)"
                )

        workers = self.options.workers if workers is None else workers
        found = evaluate(policy, episodes, self.work / name, workers=workers, overwrite=overwrite, report=report)
        say(f"  {name}: {summarise(found).outcomes}")
        return found

    def _kept(self, name: str) -> Any:
        file = self.work / f"{name}.json"
        return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else None

    def _keep(self, name: str, found: Any) -> Any:
        (self.work / f"{name}.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        return found


class Clock:
    """Seconds inside physics, pictures, the policy, and making an environment.

    Physics has the controllers in it, which write torques at every step. The environment has pictures and the starts of
    episodes in it, and observations and the judging of the task.
    """

    NAMES = ("physics", "start", "rendering", "environment", "policy", "setup")

    def __init__(self) -> None:
        self.seconds = dict.fromkeys(self.NAMES, 0.0)

    def watching(self) -> Any:
        """A context in which they are timed."""
        from contextlib import ExitStack
        from unittest.mock import patch

        from pat3d.envs.env import TabletopEnv
        from pat3d.envs.physics.simulation import Simulation
        from pat3d.envs.rendering.pictures import Pictures
        from pat3d.policies_eval.policies.scripted import ScriptedPolicy
        from pat3d.policies_eval.run.settings import RolloutSettings

        stack = ExitStack()
        for name, owner, method in (
            ("physics", Simulation, "step"),
            ("start", Simulation, "reset"),
            ("rendering", Pictures, "take"),
            ("policy", ScriptedPolicy, "reset"),
            ("policy", ScriptedPolicy, "act"),
            ("setup", RolloutSettings, "make_env"),
            ("environment", TabletopEnv, "command"),
            ("environment", TabletopEnv, "look"),
            ("environment", TabletopEnv, "reset"),
        ):
            stack.enter_context(patch.object(owner, method, self._timed(name, getattr(owner, method))))
        return stack

    def _timed(self, name: str, method: Callable[..., Any]) -> Callable[..., Any]:
        def timed(*values: Any, **more: Any) -> Any:
            begun = time.process_time()
            try:
                return method(*values, **more)
            finally:
                self.seconds[name] += time.process_time() - begun

        return timed


def rate(found: Evaluation) -> str:
    """Success rate of an evaluation with its 95 % interval."""
    return str(wilson(sum(one.success for one in found.results), len(found.results)))


def kinds(refused: dict[str, str]) -> str:
    """How many objects were refused for what reason."""
    reasons = {
        "does not stay still": "moves when set down",
        "at its narrowest": "no place to grasp",
        "mm high": "too flat",
        "too heavy": "too heavy for the arm",
        "out of reach": "out of reach",
        "no free place": "no place for the robot",
    }
    counted = Counter(
        next((short for part, short in reasons.items() if part in message), message[:60])
        for message in refused.values()
    )
    return ", ".join(f"{count} {what}" for what, count in counted.most_common())


def say(text: str) -> None:
    """Print at once, also into a pipe."""
    print(text, flush=True)


def main() -> None:
    """Run the parts that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--workers", type=int, default=1, help="processes (1)")
    parser.add_argument("--out", help="folder of scenes and records; an unfinished run goes on there")
    parser.add_argument("--objects", type=int, default=0, help="nouns of the catalogue that are tried; 0 for all (0)")
    parser.add_argument("--layouts", type=int, default=3, help="scenes of every object, each turned otherwise (3)")
    parser.add_argument("--scenes", type=int, default=100, help="cluttered scenes (100)")
    parser.add_argument("--each", type=int, default=20, help="scenes of every other kind of task (20)")
    parser.add_argument("--episodes", type=int, default=1, help="in every scene (1)")
    parser.add_argument("--demonstrations", type=int, default=100, help="for the cloned policy (100)")
    parser.add_argument("--held-out", type=int, default=100, help="layouts to test it on (100)")
    parser.add_argument("--replays", type=int, default=100, help="episodes that are replayed (100)")
    parser.add_argument("--timed", type=int, default=40, help="episodes of a worker that are timed (40)")
    Benchmark(parser.parse_args()).run()


if __name__ == "__main__":
    main()
