"""`pat3d mcp`, driven by the client of the protocol's own SDK over stdin and stdout."""

import base64
import io
import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Relation, Scene
from tests.scenes import GAP, asset_of, placed

pytest.importorskip("mcp")
anyio = pytest.importorskip("anyio")

REPOSITORY = Path(__file__).parents[2]


def small_scene() -> Scene:
    from pat3d.assets.shapes import box

    return Scene(
        objects=(
            placed("board", asset_of(box(0.3, 0.2, 0.02), noun="board"), (0, 0, GAP)),
            placed("brick", asset_of(box(0.1, 0.06, 0.04), noun="brick"), (0.05, 0, 0.02 + 2 * GAP)),
        ),
        relations=(Relation(child="brick", kind="on", parent="board"),),
        prompt="a brick on a board",
    )


@pytest.fixture(scope="module")
def root(tmp_path_factory):
    folder = tmp_path_factory.mktemp("root")
    save_scene(small_scene(), folder / "bricks")
    return folder


def talk(root, conversation):
    """Run `conversation(client)` with a server of its own in another process."""
    from mcp import Client, StdioServerParameters

    path = os.pathsep.join([str(REPOSITORY), os.environ.get("PYTHONPATH", "")])
    command = StdioServerParameters(
        command=sys.executable,
        args=["-m", "pat3d", "mcp", "--root", str(root)],
        env={**os.environ, "PYTHONPATH": path},
    )

    async def run():
        async with Client(command) as client:
            return await conversation(client)

    return anyio.run(run)


def test_every_tool_says_what_it_takes_and_returns(root):
    async def conversation(client):
        return (await client.list_tools()).tools, (await client.list_resource_templates()).resource_templates

    tools, resources = talk(root, conversation)
    names = {tool.name for tool in tools}
    assert names == {"plan", "generate", "edit", "check", "export", "render", "find_objects", "list_scenes"}
    for tool in tools:
        assert tool.description
        for what in tool.input_schema["properties"].values():
            assert {"type", "anyOf", "$ref"} & set(what)
    edit = next(tool for tool in tools if tool.name == "edit")
    step = edit.input_schema["$defs"]["EditStep"]["properties"]["verb"]["enum"]
    assert {"add", "remove", "move"} <= set(step)
    assert "moved" in edit.output_schema["properties"]
    assert "pat3d://scenes/{name}" in {one.uri_template for one in resources}


def test_scenes_are_planned_edited_checked_exported_and_seen(root):
    """One conversation, as a program has it, from a sentence to a picture."""

    async def conversation(client):
        said = {}
        plan = await client.call_tool("plan", {"sentence": "a red mug on a table"})
        said["plan"] = plan.structured_content
        said["found"] = (await client.call_tool("find_objects", {"words": "mug"})).structured_content
        heard = []

        async def hear(done, total, message):
            heard.append((done, message))

        moved = await client.call_tool(
            "edit",
            {
                "name": "bricks",
                "edits": [
                    {"verb": "move", "words": "brick: 3 cm to the left"},
                    {"verb": "set", "words": "brick: mass=0.5"},
                ],
                "out": "bricks2",
            },
            progress_callback=hear,
        )
        said["edit"], said["heard"], said["error"] = moved.structured_content, heard, moved.is_error
        said["scenes"] = (await client.call_tool("list_scenes", {})).structured_content
        said["check"] = (await client.call_tool("check", {"name": "bricks2", "seconds": 1.0})).structured_content
        said["export"] = (
            await client.call_tool("export", {"name": "bricks2", "formats": ["urdf", "html"]})
        ).structured_content
        said["picture"] = (await client.call_tool("render", {"name": "bricks2", "width": 96, "height": 64})).content
        resource = await client.read_resource("pat3d://scenes/bricks2")
        said["resource"] = json.loads(resource.contents[0].text)
        preview = await client.read_resource("pat3d://scenes/bricks2/preview.png")
        said["preview"] = preview.contents[0].blob
        return said

    said = talk(root, conversation)
    assert [obj["noun"] for obj in said["plan"]["objects"]] == ["mug", "table"]
    assert any(one["noun"] == "mug" for one in said["found"]["result"])
    assert not said["error"]
    edited = said["edit"]
    assert edited["passed"]
    assert edited["moved"]["brick"]["mm"] == pytest.approx(30.0, abs=0.1)
    assert edited["moved"]["board"]["mm"] < 0.1
    steps = [done for done, _ in said["heard"]]
    assert steps == sorted(set(steps))
    assert any("verifying" in message for _, message in said["heard"])
    assert said["scenes"]["result"] == ["bricks", "bricks2"]
    assert said["check"]["passed"]
    assert said["check"]["verification"]["mujoco_seconds"] == 1.0
    assert (root / said["export"]["urdf"]).is_file()
    assert (root / said["export"]["html"]).is_file()
    picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(said["picture"][0].data))))
    assert picture.shape[:2] == (64, 96)
    assert picture.std() > 1.0
    assert said["resource"]["history"] == ['move "brick: 3 cm to the left"', 'set "brick: mass=0.5"']
    assert base64.b64decode(said["preview"]).startswith(b"\x89PNG")
    assert load_scene(root / "bricks2")["brick"].asset.mass_properties.mass == 0.5
    assert load_scene(root / "bricks").history == ()


def test_what_cannot_be_is_said_and_changes_nothing(root, tmp_path):
    before = {path: path.read_bytes() for path in root.rglob("*") if path.is_file()}
    outside = tmp_path / "outside"
    outside.mkdir()
    (root / "link").symlink_to(outside)

    async def conversation(client):
        calls = [
            ("edit", {"name": "bricks", "edits": [{"verb": "remove", "words": "the vase"}]}),
            ("edit", {"name": "bricks", "edits": [{"verb": "move", "words": "brick: 1 m left"}]}),
            ("edit", {"name": "bricks", "edits": [{"verb": "explode", "words": "brick"}]}),
            ("edit", {"name": "nothing", "edits": [{"verb": "remove", "words": "brick"}]}),
            ("check", {"name": "../bricks"}),
            ("generate", {"sentence": "a mug", "name": "/tmp/mug"}),
            ("generate", {"sentence": "a mug", "name": "link"}),
            ("export", {"name": "bricks", "formats": ["urdf"], "out": "../out"}),
            ("export", {"name": "bricks", "formats": ["fbx"]}),
            ("render", {"name": "bricks", "width": 100_000}),
        ]
        found = [await client.call_tool(name, arguments) for name, arguments in calls]
        return [(one.is_error, one.content[0].text) for one in found]

    answers = talk(root, conversation)
    (root / "link").unlink()
    assert all(wrong for wrong, _ in answers)
    texts = [text for _, text in answers]
    assert "The scene has: board, brick" in texts[0]
    assert "only the ground" in texts[1]
    assert "no scene" in texts[3]
    assert all("no scene name" in texts[at] for at in (4, 5, 7))
    assert "leads out" in texts[6]
    after = {path: path.read_bytes() for path in root.rglob("*") if path.is_file()}
    assert after == before
    assert list(outside.iterdir()) == []


def test_a_long_job_is_cancelled_and_leaves_no_scene(root):
    async def conversation(client):
        begun = anyio.Event()

        async def hear(done, total, message):
            begun.set()

        async with anyio.create_task_group() as group:

            async def job():
                arguments = {"sentence": "a stack of eight books and six apples in a bowl on a desk", "name": "long"}
                await client.call_tool("generate", arguments, progress_callback=hear)

            group.start_soon(job)
            await begun.wait()
            group.cancel_scope.cancel()
        # The next job begins when the cancelled one has ended.
        return (await client.call_tool("find_objects", {"words": "mug"})).is_error

    assert talk(root, conversation) is False
    assert not (root / "long").exists()
    assert [path.name for path in root.iterdir() if path.name.startswith(".")] == []
