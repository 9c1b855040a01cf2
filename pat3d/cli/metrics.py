"""`pat3d metrics` and `pat3d bench`: the measures of the paper's Table 1, of scenes whoever made them."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.cli.console import console, watch
from pat3d.cli.json_output import JSON
from pat3d.cli.options import command, option, with_verbs
from pat3d.scene.folder import write_json

if TYPE_CHECKING:
    from pat3d.check.metrics.appearance import Appearance, Judge, Score
    from pat3d.check.metrics.subject import Subject
    from pat3d.check.metrics.table import Geometry
    from pat3d.generation.table1 import Entry
    from pat3d.progress import Progress

CLIP = option(
    "--clip", "CLIP score by this model: a folder, or a name that transformers knows", metavar="MODEL", group="pictures"
)
VQA = option(
    "--vqa", "VQA score by the vision-language model that PAT3D_MODEL names", action="store_true", group="pictures"
)
PLAUSIBILITY = option(
    "--plausibility", "how plausible the scene is to that model, 0 to 100", action="store_true", group="pictures"
)


@command(
    option("scenes", "scene folders, GLB files whose nodes are objects, folders of meshes", nargs="+", metavar="SCENE"),
    option("--report", "write everything that was found here, as JSON", metavar="OUT.json"),
    option("--device", "cpu or cuda", default="cpu"),
    CLIP,
    VQA,
    PLAUSIBILITY,
    option("--prompt", "what the scenes are to show, where they do not say", metavar="TEXT", group="pictures"),
    JSON,
    examples="""
    pat3d metrics scenes/mug
    pat3d metrics scenes/mug --clip openai/clip-vit-large-patch14 --vqa --plausibility
    pat3d metrics theirs.glb meshes_of_a_scene --report metrics.json
    """,
    notes="D is the mean path of the vertices until rest, over the scene's diagonal; R the pairs of triangles of "
    "different objects that pass through each other, times edge length over diagonal. Both are 0 for a scene at rest "
    "without intersections.",
)
def metrics(options: argparse.Namespace) -> int:
    """`pat3d metrics`."""
    from pat3d.check.metrics.subject import load_subject
    from pat3d.check.metrics.table import measure, report_of

    subjects = [load_subject(path) for path in options.scenes]
    if options.prompt:
        subjects = [replace(subject, prompt=options.prompt) for subject in subjects]
    with watch(console(stderr=True)) as progress:
        found = [measure(subject, device=options.device, progress=progress) for subject in subjects]
        judge = judging(options, progress)
        seen = [] if judge is None else [judge(subject) for subject in subjects]
    data = report_of(found)
    for row, one in zip(data["scenes"], seen, strict=False):
        row["appearance"] = one.as_dict()
    if options.report:
        write_json(Path(options.report), data)
    if options.json:
        print(json.dumps(data, indent=2, allow_nan=False, ensure_ascii=False))
    else:
        show(found, seen)
    return 0


def show(found: list[Geometry], seen: list[Appearance]) -> None:
    """Print a row for every scene, and how it was found."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("scene", overflow="fold")
    asked = [name for name in ("clip", "vqa", "plausibility") if seen and getattr(seen[0], name) is not None]
    for title in ("objects", "D", "simulated by", "R", "R as delivered", *asked):
        table.add_column(title, justify="right", no_wrap=True)
    for number, one in enumerate(found):
        moved = one.displacement
        table.add_row(
            one.name,
            str(one.objects),
            f"{moved.value:.4f}" if math.isfinite(moved.value) else "exploded",
            f"{moved.engine}, {moved.frames} frames",
            "absent" if one.remeshed is None else f"{one.remeshed.value:.2f}",
            f"{one.delivered.value:.2f}",
            *(_scored(getattr(seen[number], name)) for name in asked),
        )
    target = console()
    target.print(table)
    for one in found:
        moved = one.displacement
        lines = [f"MuJoCo simulated it, because {moved.why}"] if moved.why else []
        lines += [] if moved.at_rest else [f"it was still moving after {moved.frames} frames"]
        lines += [f"R is absent: {one.absent}"] if one.absent else []
        for line in (*lines, *one.notes):
            target.print(f"note  {one.name}: {line}", markup=False)
    for one in seen:
        for name in asked:
            score = getattr(one, name)
            words = f"is absent: {score.absent}" if score.absent else f"by {score.by}"
            target.print(f"note  {one.name}: {name} {words}", markup=False, soft_wrap=True)


def judging(options: argparse.Namespace, progress: Progress) -> Callable[[Subject], Appearance] | None:
    """What says how well a scene shows its prompt, by the networks that `options` ask for; None where none is."""
    from pat3d.check.metrics.appearance import appearance

    makers: dict[str, Callable[[], tuple[str, Judge]]] = {}
    if options.clip:
        from pat3d.check.metrics.clip import clip_judge

        makers["clip"] = _once(lambda: clip_judge(options.clip))
    if options.vqa or options.plausibility:
        from pat3d.check.metrics.judged import plausibility_judge, vqa_judge

        chat = _once(_chat)
        if options.vqa:
            makers["vqa"] = lambda: vqa_judge(chat())
        if options.plausibility:
            makers["plausibility"] = lambda: plausibility_judge(chat())
    if not makers:
        return None
    return lambda subject: appearance(subject, **makers, progress=progress)


@command(
    option("prompts", "a sentence a line; # begins a comment", metavar="PROMPTS"),
    option("--out", "folder of the scenes and of what was measured; the same command goes on there", required=True),
    option("--paint", "paint every prompt, and make its scene from the picture; needs models", action="store_true"),
    option("--seed", "the same seed gives the same scenes", type=int, default=0),
    option("--device", "cpu or cuda", default="cpu"),
    CLIP,
    VQA,
    PLAUSIBILITY,
    JSON,
    examples="""
    pat3d bench table1 prompts.txt --out table1
    pat3d bench table1 prompts.txt --out painted --paint      from a picture of every prompt, as the paper does
    """,
    notes="Beside the whole method: its layout before settling, no scene tree (every object for itself on the ground), "
    "and no optimisation (the first layout settled, whatever becomes of it). With --paint also the raw layout, of the "
    "objects as they were fitted to the picture; a sentence has none.",
    summary="the paper's Table 1 on your prompts, beside its published rows",
)
def table1(options: argparse.Namespace) -> int:
    """`pat3d bench table1`."""
    from pat3d.cli.photographs import painting_lookers
    from pat3d.generation.many import read_prompts
    from pat3d.generation.settings import Settings
    from pat3d.generation.table1 import PUBLISHED, means
    from pat3d.generation.table1 import table1 as measured

    prompts, entries = read_prompts(options.prompts), []
    judged_by = json.dumps([options.clip, options.vqa, options.plausibility])
    settings = Settings(seed=options.seed, device=options.device)
    lookers = painting_lookers() if options.paint else None
    errors = console(stderr=True)
    with watch(errors) as progress:
        rows = measured(
            prompts,
            options.out,
            settings=settings,
            judge=judging(options, progress),
            judged_by=judged_by,
            lookers=lookers,
            progress=progress,
        )
        for number, found in enumerate(rows, start=1):
            entries += found
            errors.print(f"{number}/{len(prompts)} {found[0].prompt}", markup=False, soft_wrap=True)
    if options.json:
        plain = [vars(one) for one in entries]
        data = {"format": "pat3d-table1", "version": 1, "means": means(entries), "published": PUBLISHED}
        print(json.dumps(_finite({**data, "entries": plain}), indent=2, allow_nan=False, ensure_ascii=False))
    else:
        show_table1(entries)
    return int(any(one.failed for one in entries))


bench = with_verbs(
    table1=table1,
    examples="""
    pat3d bench table1 prompts.txt --out table1
    """,
)


def show_table1(entries: list[Entry]) -> None:
    """Print the means beside the paper's rows, and what is absent."""
    from rich.table import Table

    from pat3d.generation.table1 import COLUMNS, PUBLISHED, means

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("")
    for title in ("CLIP", "VQA", "D", "R", "plausibility"):
        table.add_column(title, justify="right", no_wrap=True)
    for variant, row in means(entries).items():
        table.add_row(f"here: {variant}", *(_value(row[column]) for column in COLUMNS))
    table.add_section()
    for name, values in PUBLISHED.items():
        table.add_row(f"published: {name}", *map(_value, values))
    target = console()
    target.print(table)
    for line in dict.fromkeys(line for one in entries for line in one.absent):
        target.print(f"note  absent: {line}", markup=False, soft_wrap=True)
    for line in dict.fromkeys(f"{one.prompt}: {one.variant}: {one.failed}" for one in entries if one.failed):
        target.print(f"FAIL  {line}", markup=False, soft_wrap=True)


def _once(make: Callable[[], Any]) -> Callable[[], Any]:
    from functools import cache

    return cache(make)


def _chat() -> Any:
    from pat3d.errors import ModelError
    from pat3d.plan.llm.chat import Chat
    from pat3d.plan.llm.settings import load_settings

    try:
        import openai  # noqa: F401
    except ImportError:
        raise ModelError("needs the openai client: pip install 'pat3d[models]'") from None
    return Chat(load_settings())


def _scored(score: Score) -> str:
    return _value(score.value)


def _value(value: float | None) -> str:
    return "absent" if value is None else "burst" if math.isinf(value) else f"{value:.2f}"


def _finite(data: Any) -> Any:
    from pat3d.scene.folder import finite

    return finite(data)
