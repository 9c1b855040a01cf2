"""What evaluate, compare, leaderboard, replay and train do on the command line."""

from __future__ import annotations

import argparse
import os
import time
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.cli.console import console
from pat3d.errors import EvaluationError
from pat3d.policies_eval.run.settings import RolloutSettings

if TYPE_CHECKING:
    from pat3d.policies_eval.run.rollout import Result


def add_commands(command: Any) -> None:
    """Add the commands to a command line; `command` makes a parser from a name and a summary."""
    evaluating = command("evaluate", "let a policy do episodes, and report its success rate and failures")
    evaluating.add_argument(
        "--policy",
        required=True,
        metavar="POLICY",
        help="random, scripted, ws://HOST:PORT, package.module:callable, FILE.pt, lerobot:FOLDER",
    )
    _add_episodes(evaluating)
    evaluating.add_argument("--out", required=True, metavar="FOLDER", help="records; an unfinished run goes on there")
    evaluating.add_argument("--workers", default="1", metavar="N", help="processes, or auto: one a core (1)")
    evaluating.add_argument("--overwrite", action="store_true", help="throw away what FOLDER holds")
    evaluating.add_argument(
        "--interval",
        choices=("wilson", "clopper-pearson"),
        default="wilson",
        help="of the success rate, 95 %% (wilson)",
    )
    evaluating.add_argument("--videos", type=int, default=0, metavar="N", help="films for the report (0)")
    evaluating.add_argument("--no-pictures", action="store_true", help="no pictures in the report")
    _add_settings(evaluating)

    comparing = command("compare", "compare two policies on the episodes that both did")
    comparing.add_argument("first", metavar="FOLDER")
    comparing.add_argument("second", metavar="FOLDER")

    ranking = command("leaderboard", "success rates of several evaluations")
    ranking.add_argument("folders", metavar="FOLDER", nargs="+")

    replaying = command("replay", "do recorded episodes again, compare every state, and film them")
    replaying.add_argument("folder", metavar="FOLDER", help="what evaluate wrote")
    replaying.add_argument("--episode", type=int, action="append", metavar="N", help="which one; all by default")
    replaying.add_argument("--video", metavar="FILE", help=".mp4, .gif, or a folder for PNG files")
    replaying.add_argument("--picture", metavar="FILE.png", help="moments of the episode side by side")
    replaying.add_argument("--camera", default="agentview", help="agentview, frontview or wrist (agentview)")
    replaying.add_argument("--size", default="320x240", metavar="WxH", help="of video and moments [pixel] (320x240)")

    training = command("train", "train a small policy on demonstrations of the scripted one")
    _add_episodes(training)
    training.add_argument("--out", required=True, metavar="FILE.pt", help="checkpoint to write")
    training.add_argument("--epochs", type=int, default=200, help="passes over the demonstrations (200)")
    training.add_argument("--noise", type=float, default=0.3, help="of the hand while it demonstrates (0.3)")
    training.add_argument("--demonstrations", metavar="PATH", help="write them too: see pat3d demonstrate --out")

    showing = command("demonstrate", "write demonstrations of the scripted policy, for robomimic or LeRobot")
    _add_episodes(showing)
    showing.add_argument(
        "--out",
        required=True,
        metavar="PATH",
        help="FILE.hdf5 as robomimic reads it, or a new folder: a LeRobotDataset v3.0",
    )
    showing.add_argument("--noise", type=float, default=0.3, help="of the hand while it demonstrates (0.3)")
    _add_settings(showing, ("robot", "obs", "control_freq", "max_steps", "image_size"))


def _add_episodes(to: argparse.ArgumentParser) -> None:
    to.add_argument("--scene", action="append", default=[], metavar="FOLDER", help="scene folder; may be repeated")
    to.add_argument("--task", action="append", default=[], metavar="TASK", help='"pick:red mug"; may be repeated')
    to.add_argument("--suite", metavar="FOLDER", help="scenes and tasks of a suite")
    to.add_argument("--split", default="test", help="of the suite (test)")
    to.add_argument("--episodes", type=int, default=100, help="number of episodes (100)")
    to.add_argument("--seed", type=int, default=0, help="the same seed gives the same episodes (0)")
    to.add_argument(
        "--perturb",
        nargs="+",
        default=[],
        metavar="AXIS=STRENGTH",
        help="pose [m], friction, mass, camera, light, words; all 0 by default",
    )


def _add_settings(to: argparse.ArgumentParser, names: tuple[str, ...] | None = None) -> None:
    """Options for the settings called `names`, or for all."""
    default = RolloutSettings()
    helps = {
        "robot": "Panda, UR5e, Sawyer or IIWA",
        "control": "osc, joint_velocity or joint_position",
        "obs": "state, rgb or rgbd",
        "control_freq": "actions a second",
        "max_steps": "of an episode",
        "image_size": "of observations [pixel]",
        "replan": "actions done of a chunk before the policy is asked again",
        "act_seconds": "a policy that thinks for longer hangs [s]",
    }
    for name in names or helps:
        value = getattr(default, name)
        to.add_argument(f"--{name.replace('_', '-')}", type=type(value), default=value, help=f"{helps[name]} ({value})")
    if names is None:
        to.add_argument("--clip", action="store_true", help="clip actions that are out of range")


def _settings_of(options: argparse.Namespace) -> RolloutSettings:
    names = [one.name for one in fields(RolloutSettings)]
    return RolloutSettings(**{name: getattr(options, name) for name in names if hasattr(options, name)})


def episodes_from(options: argparse.Namespace) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """The episodes that a command line asks for, and their source for the manifest."""
    from pat3d.policies_eval.run.episodes import episodes_of, settings_of
    from pat3d.policies_eval.run.perturb import parse

    perturbation = parse(options.perturb)
    source: dict[str, Any] = {"seed": options.seed, "perturbation": perturbation.to_json()}
    if options.suite:
        if options.scene or options.task:
            raise EvaluationError("a suite brings its scenes and tasks; leave out --scene and --task.")
        from pat3d.policies_eval.run.suites import suite_settings

        settings, identity = suite_settings(options.suite, options.split)
        source |= identity
    else:
        settings = settings_of(options.scene, options.task)
        source |= {
            "scenes": sorted({Path(one.scene).name or "shipped scene" for one in settings}),
            "tasks": [s.task for s in settings],
        }
    return episodes_of(settings, options.episodes, seed=options.seed, perturbation=perturbation), source


def evaluate(options: argparse.Namespace) -> int:
    """`pat3d evaluate`."""
    from pat3d.policies_eval.run.evaluate import evaluate as run

    settings = _settings_of(options)
    episodes, source = episodes_from(options)
    workers = _workers(options.workers)
    begun = time.perf_counter()
    errors = console(stderr=True)

    def report(result: Result, done: int, wanted: int) -> None:
        left = (time.perf_counter() - begun) / max(done, 1) * (wanted - done)
        what = f"{result.outcome}{': ' + result.reason if result.reason else ''}"
        errors.print(
            f"{done}/{wanted} {result.episode.task}: {what} ({left:.0f} s to go)", markup=False, soft_wrap=True
        )

    done = run(
        options.policy,
        episodes,
        options.out,
        settings=settings,
        source=source,
        workers=workers,
        overwrite=options.overwrite,
        report=report,
    )
    from pat3d.policies_eval.analysis.report import write_report
    from pat3d.policies_eval.analysis.summary import show_summary, summarise

    summary = summarise(done, options.interval)
    show_summary(console(), summary)
    write_report(done, summary, videos=options.videos, pictures=not options.no_pictures)
    console().print(f"report: {done.folder / 'report.html'}", markup=False, soft_wrap=True)
    return 0


def compare(options: argparse.Namespace) -> int:
    """`pat3d compare`."""
    from pat3d.policies_eval.analysis.compare import compare_evaluations, show_comparison
    from pat3d.policies_eval.run.records import read_evaluation

    found = compare_evaluations(read_evaluation(options.first), read_evaluation(options.second))
    show_comparison(console(), found)
    return 0


def leaderboard(options: argparse.Namespace) -> int:
    """`pat3d leaderboard`."""
    from pat3d.policies_eval.analysis.compare import show_leaderboard
    from pat3d.policies_eval.run.records import read_evaluation

    show_leaderboard(console(), [read_evaluation(folder) for folder in options.folders])
    return 0


def replay(options: argparse.Namespace) -> int:
    """`pat3d replay`: exit code 1 where a state differs from the recorded one."""
    from pat3d.policies_eval.run.records import read_evaluation
    from pat3d.policies_eval.run.replay import replay_episodes

    return replay_episodes(
        read_evaluation(options.folder),
        options.episode,
        video=options.video,
        picture=options.picture,
        camera=options.camera,
        size=_size(options.size),
        target=console(),
    )


def train(options: argparse.Namespace) -> int:
    """`pat3d train`."""
    from pat3d.policies_eval.train import train as run

    episodes, _ = episodes_from(options)
    run(
        episodes,
        options.out,
        epochs=options.epochs,
        seed=options.seed,
        noise=options.noise,
        demonstrations=options.demonstrations,
        target=console(),
    )
    return 0


def demonstrate(options: argparse.Namespace) -> int:
    """`pat3d demonstrate`."""
    from pat3d.policies_eval.datasets.demonstrations import demonstrations
    from pat3d.policies_eval.datasets.files import write_demonstrations

    settings = _settings_of(options)
    episodes, _ = episodes_from(options)
    shown = demonstrations(episodes, noise=options.noise, settings=settings, target=console(stderr=True))
    count = write_demonstrations(shown, options.out, settings)
    console().print(f"{options.out}: {count} demonstrations of {len(episodes)}", markup=False, highlight=False)
    return 0


def _workers(text: str) -> int:
    if text == "auto":
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not text.isdecimal() or not 1 <= int(text) <= 512:
        raise EvaluationError(f'--workers is 1 to 512 or auto, not "{text}".')
    return int(text)


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and 16 <= int(width) <= 4096 and 16 <= int(height) <= 4096):
        raise EvaluationError(f'--size is as in 320x240, 16 to 4096 pixels a side, not "{text}".')
    return int(width), int(height)
