"""A scene from a sentence, looked at by a critic: what it denies is planned once more, and the better scene is kept."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.errors import LayoutError, ModelError, PromptError, SimulationError
from pat3d.generation.pipeline import Outcome, run_prompt
from pat3d.generation.settings import Settings
from pat3d.plan.llm.critic import Critic, Picture, Question, Verdict
from pat3d.plan.scene_plan import Decided, Planner, ScenePlan
from pat3d.progress import Event, Progress, silent
from pat3d.scene.folder import replacing, write_json
from pat3d.scene.model import Scene
from pat3d.scene.replacement import scratch_folder

if TYPE_CHECKING:
    from pat3d.view.camera import Camera

SIDES = {"from the front": 20.0, "from the left": -70.0, "from the right": 110.0}
"""Captions of the views with the directions of their cameras [deg], from -y towards +x."""
HEIGHTS = (25.0, 65.0)
"""Of the first camera over the horizon, and of one that looks into containers [deg]."""
WIDTH, HEIGHT = 768, 576
"""Of a picture [pixel]."""


def run_criticised(
    prompt: str,
    *,
    out: str | os.PathLike[str],
    settings: Settings,
    planner: Planner,
    critic: Critic,
    allow_proxies: bool = False,
    plan: ScenePlan | None = None,
    progress: Progress = silent,
) -> Outcome:
    """Make the scene of `prompt`, ask `critic` about it, and plan it once more where the critic says no.

    Args:
        prompt: as for `generate`, like `out`, `settings` and `allow_proxies`.
        out: folder to write.
        settings: how to make scenes.
        planner: reads the prompt; only one that can revise is asked again.
        critic: looks at the scenes.
        allow_proxies: let plain boxes stand in.
        plan: what `planner` has made of `prompt` already.
        progress: told what is going on.

    Raises:
        ModelError: the critic's model cannot be used; what was made until then is in `out`.
    """

    def make(decided: ScenePlan, folder: str | os.PathLike[str]) -> Outcome:
        source = Decided(decided=decided, source=planner)
        return run_prompt(
            prompt, out=folder, settings=settings, allow_proxies=allow_proxies, planner=source, progress=progress
        )

    def look(outcome: Outcome) -> dict[str, Any]:
        progress(Event(stage="looking at the scene"))
        return _round(outcome, questions, critic.look(questions, views(outcome.scene)))

    progress(Event(stage="asking what to look for"))
    questions = critic.questions(prompt)
    first_plan = planner.plan(prompt) if plan is None else plan
    kept = make(first_plan, out)
    rounds = [look(kept)]
    faults = [f"{one['question']} No: {one['seen']}" for one in rounds[0]["answers"] if one["answer"] == "no"]
    if faults and hasattr(planner, "revise"):
        folder = kept.folder
        with scratch_folder(folder.parent, f".{folder.name[:40]}-revised-") as scratch:
            try:
                progress(Event(stage="planning again"))
                revising: Any = planner
                second = make(revising.revise(prompt, first_plan, faults), scratch / "scene")
                rounds.append(look(second))
            except (PromptError, ModelError, LayoutError, SimulationError) as error:
                rounds.append({"error": str(error), "kept": False})
            else:
                better = _rank(rounds[1]) > _rank(rounds[0])
                rounds[0]["kept"], rounds[1]["kept"] = not better, better
                kept = _moved(second, folder) if better else kept
    report = replace(kept.report, critic={**critic.record(), "rounds": rounds})
    write_json(kept.folder / "report.json", report.as_dict())
    return replace(kept, report=report)


def views(scene: Scene) -> tuple[Picture, ...]:
    """Pictures of `scene` from all sides, each of which shows everything."""
    from PIL import Image

    from pat3d.view.preview import scene_items
    from pat3d.view.render import frame_items, render

    items = scene_items(scene)
    cameras: list[tuple[str, Camera]] = [
        (caption, frame_items(items, aspect=WIDTH / HEIGHT, azimuth=side, elevation=HEIGHTS[0]))
        for caption, side in SIDES.items()
    ]
    above = frame_items(items, aspect=WIDTH / HEIGHT, azimuth=0.0, elevation=HEIGHTS[1])
    made = []
    for caption, camera in (*cameras, ("from the front and high above", above)):
        file = io.BytesIO()
        Image.fromarray(render(items, camera=camera, width=WIDTH, height=HEIGHT)).save(file, format="PNG")
        made.append(Picture(caption=caption, png=file.getvalue()))
    return tuple(made)


def _round(outcome: Outcome, questions: Sequence[Question], verdicts: Sequence[Verdict]) -> dict[str, Any]:
    """What the critic says of a scene, as the report has it."""
    return {
        "told": outcome.report.understood.get("told", ""),
        "verified": outcome.report.passed,
        "answers": [
            {"question": question.text, "about": question.about, "answer": verdict.answer, "seen": verdict.seen}
            for question, verdict in zip(questions, verdicts, strict=True)
        ],
        "kept": True,
    }


def _rank(found: dict[str, Any]) -> tuple[bool, int]:
    """The better the higher: a verified scene first, then few denials."""
    return found["verified"], -sum(one["answer"] == "no" for one in found["answers"])


def _moved(outcome: Outcome, folder: Path) -> Outcome:
    """`outcome` in the place of the scene in `folder`."""
    with replacing(folder) as fresh:
        for entry in list(outcome.folder.iterdir()):
            entry.rename(fresh / entry.name)
    exports = {name: found.moved(outcome.folder, folder) for name, found in outcome.report.exports.items()}
    return replace(outcome, folder=folder, report=replace(outcome.report, exports=exports))
