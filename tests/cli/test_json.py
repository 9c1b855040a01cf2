"""What --json prints is one document that follows its schema, and nothing else."""

import dataclasses
import json
from pathlib import Path

import jsonschema
import pytest

from pat3d.assets.shapes import box
from pat3d.cli import documents, evaluation_documents
from pat3d.cli.commands import COMMANDS, find
from pat3d.cli.documents import ForeignFacts
from pat3d.cli.main import main
from pat3d.generation import facts
from pat3d.generation.facts import EditedFacts, ExportFacts, KindFacts, OutcomeFacts, PlanFacts, schema_of
from pat3d.scene.io import save_scene
from pat3d.scene.model import Relation, Scene
from tests.documents import document_of
from tests.scenes import GAP, asset_of, placed

DOCUMENTS = [
    one
    for module in (facts, documents, evaluation_documents)
    for one in vars(module).values()
    if dataclasses.is_dataclass(one) and one.__module__ == module.__name__
]
WITHOUT = {"studio", "mcp"}
"""They serve until they are ended."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("scenes") / "bricks"
    scene = Scene(
        objects=(
            placed("board", asset_of(box(0.3, 0.2, 0.02), noun="board"), (0, 0, GAP)),
            placed("brick", asset_of(box(0.1, 0.06, 0.04), noun="brick"), (0.05, 0, 0.02 + 2 * GAP)),
        ),
        relations=(Relation(child="brick", kind="on", parent="board"),),
    )
    save_scene(scene, path)
    return path


def said(capfd, argv):
    """The exit code and the document of a command."""
    capfd.readouterr()
    code = main([*argv, "--json"])
    return code, json.loads(capfd.readouterr().out)


def commands(found, name):
    """Every command line of a command: its own, or those of its verbs."""
    if not found.verbs:
        yield name, {one.name for one in found.options}
    for verb, one in found.verbs.items():
        yield from commands(one, f"{name} {verb}")


@pytest.mark.parametrize("name", sorted(set(COMMANDS) - WITHOUT))
def test_every_command_has_json(name):
    found = find(name)
    for words, options in commands(found, name):
        assert "--json" in options, words


def valid(document, kind):
    jsonschema.Draft202012Validator(schema_of(kind)).validate(document)


def test_a_plan_is_a_document(capfd):
    code, document = said(capfd, ["plan", "a red mug between two books on a desk"])
    assert code == 0
    valid(document, PlanFacts)
    assert next(obj["name"] for obj in document["objects"]) == "red mug"


def test_a_check_an_edit_and_an_export_are_documents(capfd, folder, tmp_path):
    code, document = said(capfd, ["check", str(folder), "--seconds", "1"])
    valid(document, OutcomeFacts)
    assert (code == 0) == document["passed"]
    assert document["scene"]["objects"][1]["rests_on"] == ["board"]
    out = str(tmp_path / "moved")
    code, document = said(capfd, ["edit", str(folder), "--move", "brick: 2 cm left", "--out", out])
    assert code == 0
    valid(document, EditedFacts)
    assert document["moved"]["brick"]["mm"] == pytest.approx(20.0, abs=0.1)
    code, document = said(capfd, ["export", out, "--formats", "glb", "--out", str(tmp_path / "glb")])
    assert code == 0
    valid(document, ExportFacts)
    assert Path(document["files"]["glb"]).is_file()


def test_the_catalogue_is_a_list_of_kinds(capfd):
    code, document = said(capfd, ["catalogue", "mug"])
    assert code == 0
    assert "mug" in {kind["noun"] for kind in document}
    for kind in document:
        valid(kind, KindFacts)


def test_a_scene_of_somebody_else_is_a_document_before_and_after_it_is_settled(capfd, tmp_path):
    """A block that floats 5 cm above another one."""
    blocks = "".join(
        f'<body name="{name}" pos="0 0 {height}"><freejoint/><geom type="box" size=".05 .05 .05" mass="1"/></body>'
        for name, height in (("below", 0.05), ("above", 0.2))
    )
    path, out = tmp_path / "scene.xml", str(tmp_path / "settled.xml")
    path.write_text(f'<mujoco><worldbody><geom type="plane" size="1 1 1"/>{blocks}</worldbody></mujoco>')
    told = document_of(capfd, ["verify", str(path), "--seconds", "1"], ForeignFacts, code=1)
    assert {one["name"]: one["unbalanced"] > 0.9 for one in told["objects"]} == {"below": False, "above": True}
    assert told["settled"] is None
    told = document_of(capfd, ["verify", str(path), "--seconds", "1", "--settle", out], ForeignFacts)
    assert not told["passed"]
    assert told["settled"]["passed"]
    assert told["settled"]["moved_mm"]["above"] == pytest.approx(50.0, abs=1.0)


def test_a_refusal_prints_no_document(capfd, folder):
    assert main(["edit", str(folder), "--remove", "vase", "--json"]) == 2
    assert capfd.readouterr().out == ""


def test_a_document_with_a_wrong_field_does_not_follow_its_schema():
    with pytest.raises(jsonschema.ValidationError):
        valid({"noun": "mug", "family": "tableware", "also_called": "cup", "material": "ceramic"}, KindFacts)
    with pytest.raises(jsonschema.ValidationError):
        valid({"noun": "mug", "family": "tableware", "also_called": []}, KindFacts)


@pytest.mark.parametrize("kind", DOCUMENTS, ids=lambda kind: kind.__name__)
def test_every_document_and_field_is_described(kind):
    text = (Path(__file__).parents[2] / "docs" / "json.md").read_text(encoding="utf-8")
    assert f"`{kind.__name__}`" in text
    assert [one.name for one in dataclasses.fields(kind) if f"`{one.name}`" not in text] == []
