"""`pat3d generate` and `pat3d build`: scenes from sentences and specifications."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.cli.console import console, show_many, show_report, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import DEGREES, LEAST_TILT, command, fields, option, values
from pat3d.cli.reading import (
    ASSETS,
    CRITIC,
    LIBRARIES,
    PLANNER,
    PROXIES,
    critic_of,
    orders_of_options,
    planner_of,
)
from pat3d.errors import SpecError
from pat3d.exporters.formats import FORMATS, VIEWS
from pat3d.generation.settings import DEVICES, Settings
from pat3d.plan.telling import tell

if TYPE_CHECKING:
    from pat3d.generation.pipeline import Outcome

_HELPS = {
    "seed": "the same seed gives the same scene",
    "friction": "friction coefficient while settling",
    "least_tilt": LEAST_TILT,
    "cpu_limit": "processor time that a scene may take, decompositions included, before it is refused",
    "device": "where to simulate",
    "formats": f"{', '.join((*FORMATS, *VIEWS))}, with commas or spaces between",
    "resume": "keep finished stages in FOLDER.partial, and go on from those of an earlier run",
}
_KEYWORDS = {
    "least_tilt": DEGREES,
    "cpu_limit": {"type": float, "metavar": "SECONDS"},
    "device": {"choices": DEVICES},
    "formats": {"metavar": "FORMAT"},
}
_FROM_FILE = {name: {"default": None, "shown": "the file's"} for name in ("seed", "friction")}
PHOTOGRAPHED = ("depth", "masks", "labels", "camera")
PHOTOGRAPH = tuple(
    option(f"--{name}", text, metavar="FILE", group="a photograph instead of a sentence")
    for name, text in {
        "image": "the photograph, PNG or JPEG; PROMPT is then only what the scene is called",
        "depth": ".npy in metres, or 16-bit PNG in millimetres; else the model of PAT3D_DEPTH_MODEL or pat3d.toml",
        "masks": "PNG or .npy whose pixels tell the object, or .npy of one mask an object; else models find them",
        "labels": 'JSON or YAML: {"objects": [{"name": "red mug", "noun": "mug"}, ...]}, in order; else a model tells',
        "camera": 'JSON or YAML: {"angle": 60}, degrees across, or width, height, fx, fy, cx, cy, and depth_per_metre; '
        "or as TUM, ScanNet, Open3D and RealSense write it",
    }.items()
)
PAINT = option(
    "--paint",
    "the model of PAT3D_IMAGE_MODEL or pat3d.toml paints the photograph of PROMPT",
    action="store_true",
    group="a photograph instead of a sentence",
)
RELATIVE = option(
    "--relative-depth",
    "depth is right up to a factor: metres follow from the size of the least occluded object, as labels or a model say",
    action="store_true",
    group="a photograph instead of a sentence",
)
_OUT = option("--out", "scene folder to write; an earlier one is replaced at the end", metavar="FOLDER")

INPAINT = option(
    "--inpaint",
    "that model paints away what hides objects in part, so that they are fitted to their whole outline",
    action="store_true",
    group="a photograph instead of a sentence",
)


@command(
    option("prompt", "what the scene shows", metavar="PROMPT", nargs="?"),
    option(
        "--prompts",
        "a scene for every line of FILE, each in its own folder of --out; those that are there are kept",
        metavar="FILE",
    ),
    PROXIES,
    PLANNER,
    LIBRARIES,
    ASSETS,
    CRITIC,
    *PHOTOGRAPH,
    PAINT,
    INPAINT,
    RELATIVE,
    option("--ask", "on a terminal, ask where the sentence has two readings", action="store_true"),
    _OUT,
    *fields(Settings, _KEYWORDS, **_HELPS),
    JSON,
    examples="""
    pat3d generate "a red mug on a wooden table" --out scenes/mug
    pat3d generate "a bowl of three apples next to a stack of four books" --out scenes/desk --seed 3
    pat3d generate "the YCB drill beside a sugar box on a tray" --libraries ycb --out scenes/drill
    pat3d generate "a teapot dinosaur on a plate" --assets mesh:http://127.0.0.1:8080 --out scenes/tea
    pat3d generate --planner llm --critic "una taza roja sobre la mesa" --out scenes/taza
    pat3d generate "my desk" --image desk.jpg --depth desk.npy --masks desk.png --labels desk.json --out scenes/desk
    pat3d generate "two mugs beside a laptop on a desk" --paint --out scenes/desk      models do all of it
    pat3d generate --prompts prompts.txt --out scenes      one a line; the same command goes on where it stopped
    """,
)
def generate(options: argparse.Namespace) -> int:
    """`pat3d generate`."""
    if options.paint or options.image is not None or any(getattr(options, name) is not None for name in PHOTOGRAPHED):
        return _generate_from_image(options)
    if (options.prompt is None) == (options.prompts is None):
        raise SpecError('give either a sentence, pat3d generate "a red mug on a table", or --prompts FILE.')
    if options.out is None:
        raise SpecError("give the folder to write: --out scenes/NAME.")
    settings = Settings(**values(Settings, options))
    if options.prompts is not None:
        return _generate_many(options, settings)
    planner, critic = planner_of(options), critic_of(options)
    plan = planner.plan(options.prompt)
    console(stderr=True).print(tell(plan), markup=False, soft_wrap=True)
    with watch(console(stderr=True)) as progress:
        common: dict[str, Any] = {
            "out": options.out,
            "settings": settings,
            "allow_proxies": options.allow_proxies,
            "progress": progress,
        }
        if critic is not None:
            from pat3d.generation.criticised import run_criticised

            outcome = run_criticised(options.prompt, planner=planner, critic=critic, plan=plan, **common)
        else:
            from pat3d.generation.pipeline import run_prompt
            from pat3d.plan.scene_plan import Decided

            outcome = run_prompt(options.prompt, planner=Decided(decided=plan, source=planner), **common)
    return _finished(outcome, options)


def _generate_from_image(options: argparse.Namespace) -> int:
    from pat3d.cli.photographs import lookers_of
    from pat3d.generation.pictured import generate_from_image
    from pat3d.vision.looking import Photograph

    if options.out is None:
        raise SpecError("--out missing: give the folder to write, --out scenes/NAME.")
    if (options.image is None) == (not options.paint):
        raise SpecError("give either the photograph, --image FILE, or --paint and a PROMPT to paint it of.")
    if options.paint and not (options.prompt or "").strip():
        raise SpecError('--paint needs a PROMPT: pat3d generate "two mugs on a desk" --paint --out scenes/desk.')
    if options.paint and (options.masks is not None or options.depth is not None):
        raise SpecError("--masks and --depth belong to a photograph that is there already: give it as --image.")
    if options.prompts is not None or options.critic:
        raise SpecError("--image and --paint make one scene of one photograph, without --prompts and --critic.")
    if options.relative_depth and options.depth is None:
        raise SpecError("--relative-depth is about a file: give it as --depth FILE. Models measure in metres.")
    files = {name: Path(value) for name in PHOTOGRAPHED if (value := getattr(options, name)) is not None}
    picture = None if options.image is None else Path(options.image)
    with watch(console(stderr=True)) as progress:
        outcome = generate_from_image(
            Photograph(picture=picture, relative=options.relative_depth, **files),
            out=options.out,
            prompt=options.prompt or "",
            settings=Settings(**values(Settings, options)),
            lookers=lookers_of(options),
            libraries=options.libraries,
            orders=orders_of_options(options),
            progress=progress,
        )
    return _finished(outcome, options)


def _generate_many(options: argparse.Namespace, settings: Settings) -> int:
    from pat3d.generation.many import TABLE, generate_many, read_prompts

    if options.critic:
        raise SpecError("--critic looks at one scene; give a sentence instead of --prompts.")
    prompts, rows = read_prompts(options.prompts), []
    errors = console(stderr=True)
    with watch(errors) as progress:
        scenes = generate_many(
            prompts,
            options.out,
            settings=settings,
            allow_proxies=options.allow_proxies,
            planner=planner_of(options),
            progress=progress,
        )
        for row in scenes:
            rows.append(row)
            how = "there already" if row.kept else row.state
            errors.print(f"{len(rows)}/{len(prompts)} {row.folder}: {how}", markup=False, soft_wrap=True)
    if options.json:
        print_facts(rows)
    else:
        show_many(console(), rows)
        console().print(f"\ntable: {Path(options.out) / TABLE}", markup=False, soft_wrap=True)
    return max(row.exit_code for row in rows)


@command(
    option("spec", "the specification", metavar="SCENE.YAML", nargs="?"),
    option("--schema", "print the JSON schema of specifications and stop", action="store_true"),
    _OUT,
    *fields(Settings, _KEYWORDS | _FROM_FILE, **_HELPS),
    JSON,
    examples="""
    pat3d build scene.yaml --out scenes/mine
    pat3d build --schema > scene.schema.json
    """,
)
def build(options: argparse.Namespace) -> int:
    """`pat3d build`."""
    if options.schema:
        from pat3d.generation.spec_schema import BUILD_SCHEMA

        print(json.dumps(BUILD_SCHEMA, indent=2))
        return 0
    from pat3d.generation.pipeline import run_spec

    if options.spec is None or options.out is None:
        raise SpecError("give the specification and the folder to write: pat3d build scene.yaml --out scenes/NAME.")
    with watch(console(stderr=True)) as progress:
        outcome = run_spec(options.spec, out=options.out, progress=progress, **values(Settings, options))
    return _finished(outcome, options)


def _finished(outcome: Outcome, options: argparse.Namespace) -> int:
    report = outcome.report
    if options.json:
        from pat3d.generation.facts import outcome_facts

        facts = outcome_facts(
            outcome.scene,
            folder=options.out,
            failures=report.failures,
            verification=report.chosen.checked.verification,
            exports=report.exports,
            seconds=report.seconds["total"],
            notes=(*report.understood.get("notes", ()), *report.chosen.best.notes),
        )
        print_facts(facts)
    else:
        show_report(console(), report, Path(options.out))
    return verdict(outcome.report.failures)
