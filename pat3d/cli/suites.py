"""`pat3d suite`: the terminal's side of suites."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from pat3d.cli.console import console, verdict
from pat3d.cli.diagnosis import diagnose
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import DEGREES, LEAST_TILT, command, fields, option, values, with_verbs
from pat3d.cli.paraphrasing import paraphrase
from pat3d.cli.suite_progress import counting, making
from pat3d.envs.suites.generate import LIMIT
from pat3d.envs.suites.reference import REFERENCES, reference
from pat3d.envs.suites.request import DEVICES, SPLITS, TASKS, TWO_ARMED, Request, in_split
from pat3d.envs.surroundings.room import KINDS
from pat3d.errors import SuiteError
from pat3d.scene.folder import finite

MAX_EPISODES = 100_000

_WORKERS = option("--workers", "processes; auto for one a core", default="auto")
_FOLDER = option("folder", "suite folder", metavar="OUT")


@command(
    option("folder", "suite folder to write", metavar="OUT"),
    *fields(
        Request,
        {
            "tasks": {"nargs": None, "default": ",".join(Request.tasks), "shown": "pick to unload"},
            "objects": {"nargs": None, "metavar": "N or N-M", "default": "{}-{}".format(*Request.objects)},
            "steps": {"nargs": None, "metavar": "N,N", "default": "", "shown": "2 to 5"},
            "clutter": {"nargs": None, "metavar": "N,N", "default": "", "shown": "as --objects leaves"},
            "visible": {"metavar": "PERCENT"},
            "vary": {"metavar": "METRES"},
            "rooms": {"nargs": None, "metavar": "ROOM,ROOM", "default": "", "shown": "a bare bench"},
            "least_tilt": DEGREES,
            "device": {"choices": DEVICES},
            "picture": {"metavar": "PIXELS"},
        },
        tasks=f"any of {', '.join(TASKS)}; with two arms also {', '.join(TWO_ARMED)}",
        scenes="how many; a larger number makes a suite longer",
        seed="the same seed gives the same suite",
        objects="objects of a scene",
        steps="of chains, whose number is one of these",
        clutter="objects beside those of the task, of which every scene has one number",
        alike="distractors by likeness: of the noun of what is moved in another colour or size, or of its kind",
        visible="of the agent's picture at the start that every object of the task covers at least",
        vary="by which every reset moves the objects along x and y",
        rooms=f"around the bench, drawn for every scene: {', '.join(KINDS)}; all for all of them",
        robot="that must be able to do the tasks",
        least_tilt=LEAST_TILT,
        stable="without scenes in which something rests on its round side, from where it may roll",
        device="where scenes settle; on a GPU, many side by side",
        picture="width of the scenes' pictures; 0 for none",
    ),
    option("--reference", f"a named suite, as it is published: {', '.join(REFERENCES)}", metavar="NAME"),
    _WORKERS,
    option("--ray", "let a Ray cluster work: HOST:PORT, ray://HOST:PORT or auto", metavar="ADDRESS"),
    option(
        "--limit",
        "for one scene; one that takes longer twice is replaced",
        type=float,
        default=LIMIT,
        metavar="SECONDS",
    ),
    JSON,
    summary="make a suite, or what is missing of it",
    examples="""
    pat3d suite generate suites/tabletop --tasks pick,place,stack,sort,unload --scenes 1000 --seed 0 --workers auto
    pat3d suite generate suites/hard --clutter 3,5,8 --alike 2 --visible 0.5 --vary 0.05
    pat3d suite generate suites/chains --tasks chain --steps 4,5 --scenes 100
    pat3d suite generate suites/pushing --tasks push --scenes 100
    pat3d suite generate suites/beside --tasks beside --scenes 100
    pat3d suite generate suites/two-arms --tasks carry,handover --robot panda+panda
    pat3d suite generate suites/homes --rooms kitchen,living_room
    pat3d suite generate suites/tabletop-v1 --reference tabletop-v1 --workers auto
    """,
    notes="Interrupted or killed, the same command goes on where it stopped. The same seed gives the same suite with "
    "any number of workers (on a GPU, to 1e-9 m).",
)
def generate(options: argparse.Namespace) -> int:
    """`pat3d suite generate`."""
    from pat3d.envs.suites.generate import generate
    from pat3d.envs.suites.suite import Suite
    from pat3d.envs.suites.worker_pool import worker_count

    worker_count(options.workers)
    tasks = tuple(name.strip() for name in options.tasks.split(","))
    more = {"tasks": tasks, "objects": _range(options.objects), "steps": _numbers("--steps", options.steps)}
    more |= {"clutter": _numbers("--clutter", options.clutter)}
    more["rooms"] = KINDS if options.rooms == "all" else tuple(filter(None, map(str.strip, options.rooms.split(","))))
    request = Request(**values(Request, options) | more)
    if options.reference:
        request = _of_reference(options.reference, request)
    with making() as tell:
        status = generate(
            options.folder, request, workers=options.workers, limit=options.limit, ray=options.ray, tell=tell
        )
    finished = Suite.open(options.folder)
    if status.made and find_spec("gymnasium"):
        from pat3d.policies_eval.datasets.interface import suite_interface, write_interface

        write_interface(finished.folder.path, suite_interface(finished))
    if options.json:
        return _document(finished)
    _summary(finished)
    if status.made:
        console().print(
            f"\n{status.made} scenes in {status.seconds:.0f} s: {status.per_hour:.0f} an hour with "
            f"{status.workers} workers",
            markup=False,
        )
    return 0


@command(
    _FOLDER,
    option("--quick", "checksums and splits only", action="store_true"),
    _WORKERS,
    JSON,
    summary="verify a suite again: files, splits, stillness in MuJoCo, view",
)
def check(options: argparse.Namespace) -> int:
    """`pat3d suite check`."""
    from pat3d.envs.suites.check import check_suite
    from pat3d.envs.suites.reference import differences, reference_of
    from pat3d.envs.suites.suite import Suite
    from pat3d.envs.suites.worker_pool import worker_count

    suite = Suite.open(options.folder)
    with counting("checking") as tell:
        lines = check_suite(suite, settle=not options.quick, workers=worker_count(options.workers), tell=tell)
    if options.json:
        return _document(suite, lines)
    how = "files and splits"
    if not options.quick:
        how = "files, splits, stillness in MuJoCo" + (" and view" if suite.request.visible else "")
    if not lines:
        console().print(f"pass  {len(suite.entries)} scenes: {how}", markup=False)
        if (of := reference_of(suite.request)) is not None:
            equal = differences(suite.folder, suite.request)[1]
            console().print(f"pass  the scenes of {of.name}, {equal} of {len(suite.entries)} bit for bit", markup=False)
    return verdict(lines)


@command(_FOLDER, JSON, summary="numbers in the terminal; pictures on the page index.html")
def show(options: argparse.Namespace) -> int:
    """`pat3d suite show`."""
    from pat3d.envs.suites.folder import PAGE, write_text
    from pat3d.envs.suites.page import page
    from pat3d.envs.suites.suite import Suite

    suite = Suite.open(options.folder)
    write_text(suite.folder.path / PAGE, page(suite.folder.path.name, suite.document))
    if options.json:
        return _document(suite)
    _summary(suite)
    console().print(f"\n  {suite.folder.path / PAGE}", markup=False, soft_wrap=True)
    return 0


@command(
    _FOLDER,
    option("--split", "of the episodes", default="train"),
    option("--episodes", "scripted demonstrations for the statistics; 0 for none", type=int, default=10),
    option("--cameras", "of every scene, and not of the first one alone", action="store_true"),
    option("--seed", "of the episodes", type=int, default=0),
    JSON,
    summary="write spec.json: what actions and observations mean, cameras, and statistics to normalise with",
    examples="""
    pat3d suite spec suites/tabletop --episodes 50
    pat3d suite spec suites/tabletop --episodes 0 --cameras
    """,
)
def spec(options: argparse.Namespace) -> int:
    """`pat3d suite spec`."""
    from pat3d.envs.suites.suite import Suite
    from pat3d.policies_eval.datasets.interface import (
        cameras_of_scenes,
        suite_interface,
        with_statistics,
        write_interface,
    )

    suite = Suite.open(options.folder)
    interface = suite_interface(suite)
    if options.episodes:
        episodes, settings = _episodes(options, suite)
        interface = with_statistics(
            interface, episodes, settings, lambda text: console(stderr=True).print(text, markup=False, highlight=False)
        )
    if options.cameras:
        with counting("cameras") as tell:
            interface |= {"cameras_of_scenes": cameras_of_scenes(suite, tell)}
    written = write_interface(suite.folder.path, interface)
    if options.json:
        from pat3d.cli.documents import SpecFacts

        print_facts(
            SpecFacts(file=str(written), episodes=options.episodes, scenes=len(suite.entries) if options.cameras else 1)
        )
    else:
        console().print(str(written), markup=False, soft_wrap=True)
    return 0


@command(
    _FOLDER,
    option("--policy", "as pat3d evaluate takes it", required=True, metavar="POLICY"),
    option("--split", "of the episodes", default="train"),
    option("--episodes", "in which the policy is asked", type=int, default=3),
    option("--seed", "of the episodes", type=int, default=0),
    option("--steps", "of an episode at most", type=int, metavar="N", shown="until the task is done"),
    option("--obs", "state, rgb or rgbd", default="state"),
    option("--control", "osc, joint_velocity or joint_position", default="osc"),
    JSON,
    summary="compare a policy's actions with right ones: flipped gripper, Euler angles, degrees, another frame",
    examples="""
    pat3d suite check-policy suites/tabletop --policy ws://127.0.0.1:8000 --obs rgb
    """,
    notes="The scripted policy does the tasks; the other one is asked in the same states, and what it answers is not "
    "done.",
)
def check_policy(options: argparse.Namespace) -> int:
    """`pat3d suite check-policy`: exit code 1 where something looks wrong."""
    from pat3d.envs.suites.suite import Suite
    from pat3d.policies_eval.analysis.conventions import EXPLAINED, examine, resemblance
    from pat3d.policies_eval.analysis.probe import compare_actions
    from pat3d.policies_eval.policies.registry import make_policy

    episodes, settings = _episodes(options, Suite.open(options.folder), obs=options.obs, control=options.control)
    compared = compare_actions(make_policy(options.policy), episodes, settings, options.steps)
    found, alike = examine(compared), resemblance(compared)
    failures = [one.text for one in found]
    if options.json:
        from pat3d.cli.documents import ConventionFacts

        print_facts(ConventionFacts(passed=not failures, failures=failures, explained=finite(alike)))
        return verdict(failures)
    faulty = {one.part for one in found}
    for part, share in alike.items():
        if part not in faulty:
            says = "as it should be" if share > EXPLAINED else "resembles nothing known, so nothing can be said"
            console().print(f"{part}: {says} (explains {100 * max(share, 0.0):.0f} %)", markup=False, highlight=False)
    return verdict(failures)


def _episodes(options: argparse.Namespace, suite: Any, **more: Any) -> tuple[Any, Any]:
    """Episodes of a suite's split and what is the same for all of them."""
    from pat3d.policies_eval.run.episodes import episodes_of
    from pat3d.policies_eval.run.settings import RolloutSettings
    from pat3d.policies_eval.run.suites import suite_settings

    if not 1 <= options.episodes <= MAX_EPISODES:
        raise SuiteError(f"--episodes is 1 to {MAX_EPISODES}, not {options.episodes}.")
    scenes, _ = suite_settings(options.folder, options.split)
    settings = RolloutSettings(robot=suite.request.robot, vary=suite.request.vary, **more)
    return episodes_of(scenes, options.episodes, seed=options.seed), settings


suite = with_verbs(
    generate=generate,
    check=check,
    show=show,
    spec=spec,
    examples="""
    pat3d suite generate suites/tabletop --tasks pick,place,stack,sort,unload --scenes 1000 --seed 0 --workers auto
    pat3d suite check suites/tabletop
    pat3d suite show suites/tabletop
    pat3d suite spec suites/tabletop
    pat3d suite check-policy suites/tabletop --policy ws://127.0.0.1:8000 --obs rgb
    pat3d suite diagnose suites/tabletop --out diagnosis
    pat3d suite paraphrase suites/tabletop --paraphrases 5
    """,
    diagnose=diagnose,
    paraphrase=paraphrase,
    **{"check-policy": check_policy},
)


def _of_reference(name: str, asked: Request) -> Request:
    """The request of a reference suite, as long as was asked for; nothing else of it may be asked for."""
    wanted, usual = reference(name).request, Request()
    own = replace(asked, scenes=usual.scenes, picture=usual.picture)
    if own != usual:
        differ = [key for key, value in own.as_dict().items() if value != usual.as_dict().get(key)]
        raise SuiteError(f"a reference suite decides its {', '.join(differ)}; leave out what says otherwise.")
    return replace(wanted, scenes=min(asked.scenes, wanted.scenes), picture=asked.picture)


def _document(suite: Any, failures: Sequence[str] = ()) -> int:
    """Print the suite as JSON; returns the exit code."""
    from pat3d.cli.documents import suite_facts

    print_facts(suite_facts(suite, failures))
    return verdict(failures)


def _range(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,4})(?:-(\d{1,4}))?", text.strip())
    if match is None:
        raise SuiteError(f'--objects is a number or a range such as 5-8, not "{text}".')
    return int(match[1]), int(match[2] or match[1])


def _numbers(name: str, text: str) -> tuple[int, ...]:
    if not re.fullmatch(r"(\d{1,3}(,\d{1,3})*)?", text.replace(" ", "")):
        raise SuiteError(f'{name} is numbers such as 3,5, not "{text}".')
    return tuple(int(one) for one in text.split(",") if one.strip())


def _summary(suite: Any) -> None:
    """Tables of splits, axes and rejections."""
    from rich.table import Table

    target, document = console(), suite.document
    kinds = document["request"]["tasks"]
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("split")
    for kind in (*kinds, "all"):
        table.add_column(kind, justify="right")
    for split in SPLITS:
        own = [one.kind for one in suite.entries if in_split(one.split, split)]
        table.add_row(split, *(str(own.count(kind)) for kind in kinds), str(len(own)))
    target.print(table)
    target.print()
    for axis, told in document["axes"].items():
        counts = ", ".join(f"{value}: {count}" for value, count in told["scenes"].items())
        target.print(f"{axis:13s} {counts}", markup=False)
    found = document["numbers"]
    settled = found["settled_in_mujoco"]
    target.print(
        f"\n{found['scenes']} scenes from {found['candidates']} candidates; {settled['passed']} of {settled['of']} "
        f"settled ones stay still in MuJoCo, {found['intersections']} intersections; at most "
        f"{found['largest_drift_mm']:.2g} mm and {found['largest_turn_degrees']:.2g} degrees in the suite",
        markup=False,
    )
    for reason, count in sorted(found["rejected"].items(), key=lambda item: -item[1]):
        example = next(one["message"] for one in document["rejected"] if one["reason"] == reason)
        target.print(f"  rejected  {count:4d}  {reason}: {example}", markup=False, overflow="ellipsis", no_wrap=True)
