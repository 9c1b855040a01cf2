"""A server of the Model Context Protocol: other programs plan, make, edit, check, export and look at scenes.

Everything happens in one folder that the user names. Tools say what they take and return in JSON schemas, long ones
report progress and can be cancelled, and an edit or a scene that fails leaves the folder as it was.
"""

from __future__ import annotations

import json
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from mcp.server.mcpserver import Context, Image, MCPServer
from mcp.server.mcpserver.exceptions import ResourceNotFoundError, ToolError
from mcp_types import ToolAnnotations
from pydantic import BaseModel, ConfigDict, Field

from pat3d.errors import Pat3dError
from pat3d.generation.facts import (
    EditedFacts,
    KindFacts,
    OutcomeFacts,
    PlanFacts,
    edited_facts,
    kinds,
    outcome_facts,
    plan_facts,
    scene_facts,
)
from pat3d.generation.settings import MAX_SEED
from pat3d.mcp_server.jobs import Jobs
from pat3d.mcp_server.root import Root
from pat3d.scene.versions import VERSION

if TYPE_CHECKING:
    from pat3d.progress import Progress

INSTRUCTIONS = """\
PAT3D makes manipulation scenes that do not move when a simulator loads them. Read a sentence with plan, make the scene
with generate, change it with edit, look at it with render, and write it for simulators with export. Objects rest on one
another; every scene is verified, in equilibrium and free of intersections, before it is kept. Name scenes by letters,
digits, "-" and "_"."""

SceneName = Annotated[str, Field(description="name of a scene in the folder", max_length=64)]
Formats = Annotated[
    list[Literal["mjcf", "usd", "urdf", "sdf", "html", "glb", "simready"]],
    Field(
        description="mjcf for MuJoCo, usd for Isaac Sim, urdf, sdf for Gazebo, simready for Omniverse; html "
        "and glb to look at",
        min_length=1,
    ),
]
_READS = ToolAnnotations(read_only_hint=True, open_world_hint=False)
_WRITES = ToolAnnotations(read_only_hint=False, destructive_hint=True, open_world_hint=False)


class EditStep(BaseModel):
    """One edit."""

    model_config = ConfigDict(extra="forbid")

    verb: Literal["add", "remove", "move", "turn", "replace", "scale", "set", "fix", "free"]
    words: str = Field(
        max_length=1000,
        description='add: "a coffee mug on the stack of books"; remove: "bottom book"; move: "vase: 10 cm to the '
        'right" or "vase: onto the books"; turn: "laptop: 15 degrees"; replace: "vase: a plant pot"; scale: "bowl: '
        '20 % larger"; set: "mug: mass=0.3, friction=0.5"; fix: "desk"; free: "desk"',
    )


def server(folder: str | Path) -> MCPServer:
    """The server of the scenes in `folder`.

    Raises:
        SpecError: `folder` is not one that scenes can be in.
    """
    root, jobs = Root.at(folder), Jobs()
    made: MCPServer = MCPServer("pat3d", instructions=INSTRUCTIONS, version=VERSION, log_level="WARNING")
    _add_making(made, root, jobs)
    _add_looking(made, root, jobs)
    _add_resources(made, root)
    return made


def _add_making(made: MCPServer, root: Root, jobs: Jobs) -> None:
    @made.tool(annotations=_READS)
    async def plan(
        ctx: Context, sentence: Annotated[str, Field(description="what the scene shows", max_length=4000)]
    ) -> PlanFacts:
        """Say how a sentence is read, and make nothing: objects, relations, and what was assumed or left out."""

        def work(progress: Progress) -> PlanFacts:
            from pat3d.plan.grammar.planner import GrammarPlanner

            return plan_facts(GrammarPlanner().plan(sentence))

        return await jobs.run(ctx, work)

    @made.tool(annotations=_WRITES)
    async def generate(
        ctx: Context,
        sentence: Annotated[str, Field(description="what the scene shows", max_length=4000)],
        name: Annotated[str, Field(description="name of the scene to write; one of that name is replaced")],
        seed: Annotated[int, Field(ge=0, le=MAX_SEED, description="the same seed gives the same scene")] = 0,
        formats: Formats = ["mjcf"],  # noqa: B006
        allow_proxies: Annotated[bool, Field(description="a plain box for what the catalogue lacks")] = False,
    ) -> OutcomeFacts:
        """Make a scene from a sentence: plan it, lay it out, settle it, verify it, and write its folder."""

        def work(progress: Progress) -> OutcomeFacts:
            from pat3d.generation.pipeline import run_prompt
            from pat3d.generation.settings import Settings

            settings = Settings(seed=seed, formats=tuple(formats))
            outcome = run_prompt(
                sentence, out=root.named(name), settings=settings, allow_proxies=allow_proxies, progress=progress
            )
            report = outcome.report
            return outcome_facts(
                outcome.scene,
                folder=name,
                failures=report.failures,
                verification=report.chosen.checked.verification,
                exports=report.exports,
                seconds=report.seconds.get("total"),
                notes=(*report.understood.get("notes", ()), *report.chosen.best.notes),
            )

        return await jobs.run(ctx, work)

    @made.tool(annotations=_WRITES)
    async def edit(
        ctx: Context,
        name: SceneName,
        edits: Annotated[list[EditStep], Field(min_length=1, max_length=50, description="done in this order")],
        out: Annotated[str | None, Field(description="name of the scene to write; NAME is replaced where none")] = None,
    ) -> EditedFacts:
        """Change a scene: it settles from where it was and is verified; an edit that cannot be changes nothing."""

        def work(progress: Progress) -> EditedFacts:
            from pat3d.generation.editing.editable import load
            from pat3d.generation.editing.said import applied

            target = root.named(out if out is not None else name)
            steps = [(step.verb, step.words) for step in edits]
            done = applied(load(root.scene(name)), steps).settle(progress=progress)
            written = done.save(target, progress=progress)
            if done.verified is None:
                raise ToolError("nothing was edited.")
            facts = outcome_facts(
                done.scene,
                folder=target.name,
                failures=written.failures,
                verification=written.verification,
                exports=written.exports,
                seconds=done.verified.clock.seconds["total"],
            )
            return edited_facts(facts, done.edits, done.verified.changes)

        return await jobs.run(ctx, work)


def _add_looking(made: MCPServer, root: Root, jobs: Jobs) -> None:
    @made.tool(annotations=_READS)
    async def list_scenes() -> list[str]:
        """Names of the scenes in the folder."""
        return root.scenes()

    @made.tool(annotations=_READS)
    async def find_objects(
        ctx: Context,
        words: Annotated[str, Field(description="a noun or part of one; empty for everything", max_length=100)] = "",
    ) -> list[KindFacts]:
        """Search the catalogue of objects that can be made, by noun, synonym or family."""

        def work(progress: Progress) -> list[KindFacts]:
            return kinds(words)

        return await jobs.run(ctx, work)

    @made.tool(annotations=_READS)
    async def check(
        ctx: Context,
        name: SceneName,
        seconds: Annotated[float, Field(gt=0, le=60, description="simulated time in MuJoCo")] = 5.0,
    ) -> OutcomeFacts:
        """Verify a scene folder again: its files, equilibrium, intersections, stillness in MuJoCo, relations."""

        def work(progress: Progress) -> OutcomeFacts:
            from pat3d.check.folder import check_folder

            report = check_folder(root.scene(name), seconds=seconds, progress=progress)
            if report.scene is None:
                raise ToolError(f'"{name}" holds exports without a scene.')
            return outcome_facts(
                report.scene,
                folder=name,
                failures=report.failures,
                verification=report.verification,
                notes=report.notes,
            )

        return await jobs.run(ctx, work)

    @made.tool(annotations=_WRITES)
    async def export(
        ctx: Context,
        name: SceneName,
        formats: Formats,
        out: Annotated[str | None, Field(description="folder to write; NAME-export where none")] = None,
    ) -> dict[str, str]:
        """Write a scene for other programs; returns the main file of every format, relative to the folder."""

        def work(progress: Progress) -> dict[str, str]:
            from pat3d.errors import CheckError
            from pat3d.exporters.compare import parity
            from pat3d.exporters.formats import VIEWS
            from pat3d.exporters.formats import export as write
            from pat3d.scene.io import load_scene

            target = root.named(out if out is not None else f"{name}-export")
            scene = load_scene(root.scene(name))
            paths = write(scene, formats, target, progress=progress)
            wrong = [line for kind, path in paths.items() if kind not in VIEWS for line in parity(scene, path).failures]
            if wrong:
                raise CheckError(wrong[0])
            return {kind: path.relative_to(root.folder).as_posix() for kind, path in paths.items()}

        return await jobs.run(ctx, work)

    @made.tool(annotations=_READS, structured_output=False)
    async def render(
        ctx: Context,
        name: SceneName,
        width: Annotated[int, Field(ge=64, le=1920)] = 640,
        height: Annotated[int, Field(ge=64, le=1440)] = 480,
        azimuth: Annotated[
            float | None, Field(ge=-360, le=360, description="degrees from the front to the right")
        ] = None,
        elevation: Annotated[float, Field(ge=-10, le=89, description="degrees above the horizon")] = 30.0,
    ) -> Image:
        """A picture of a scene at rest, from where most of it is seen or from the direction given."""

        def work(progress: Progress) -> bytes:
            from pat3d.progress import Event
            from pat3d.scene.io import load_scene
            from pat3d.view.preview import save_picture, save_png, scene_items
            from pat3d.view.render import frame_items
            from pat3d.view.render import render as draw

            scene = load_scene(root.scene(name))
            progress(Event(stage="drawing"))
            with tempfile.TemporaryDirectory(prefix="pat3d-mcp-") as scratch:
                path = Path(scratch) / "scene.png"
                if azimuth is None:
                    save_picture(scene, path, width=width, height=height)
                else:
                    items = scene_items(scene)
                    camera = frame_items(items, aspect=width / height, azimuth=azimuth, elevation=elevation)
                    save_png(draw(items, camera=camera, width=width, height=height), path)
                return path.read_bytes()

        return Image(data=await jobs.run(ctx, work), format="png")


def _add_resources(made: MCPServer, root: Root) -> None:
    @made.resource("pat3d://scenes", mime_type="application/json")
    def scenes() -> str:
        """Names of the scenes in the folder."""
        return json.dumps(root.scenes())

    @made.resource("pat3d://scenes/{name}", mime_type="application/json")
    def scene(name: str) -> str:
        """The objects of a scene, where they are and what they rest on."""
        from pat3d.scene.io import load_scene

        return json.dumps(asdict(scene_facts(load_scene(_found(root, name)))))

    @made.resource("pat3d://scenes/{name}/report", mime_type="application/json")
    def report(name: str) -> str:
        """Everything that was found when the scene was made or edited."""
        from pat3d.scene.folder import read_json

        return json.dumps(read_json(_found(root, name) / "report.json"))

    @made.resource("pat3d://scenes/{name}/preview.png", mime_type="image/png")
    def preview(name: str) -> bytes:
        """The initial layout beside the settled scene."""
        path = _found(root, name) / "preview.png"
        if not path.is_file():
            raise ResourceNotFoundError(f'"{name}" has no preview.')
        return path.read_bytes()


def _found(root: Root, name: str) -> Path:
    try:
        return root.scene(name)
    except Pat3dError as error:
        raise ResourceNotFoundError(str(error)) from error
