"""Reference suites: the same compositions everywhere, and a copy that is another suite is told."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest

from pat3d.assets.shapes import box
from pat3d.cli.main import main
from pat3d.envs.suites import reference as references
from pat3d.envs.suites.card import card
from pat3d.envs.suites.composition import draft
from pat3d.envs.suites.folder import RECORD, SuiteFolder
from pat3d.envs.suites.reference import REFERENCES, differences, positions, reference, reference_of
from pat3d.envs.suites.request import SPLITS, Request
from pat3d.errors import SuiteError
from pat3d.scene.io import save_scene
from tests.scenes import asset_of, placed, scene_of

V1 = reference("tabletop-v1")


def test_names_with_and_without_pat3d_mean_the_same_and_others_are_answered_with_the_known_ones():
    assert reference("pat3d/tabletop-v1") == V1
    assert V1.name == "pat3d/tabletop-v1"
    with pytest.raises(SuiteError, match=", ".join(REFERENCES)):
        reference("tabletop-v0")


def test_every_composition_of_the_reference_is_drawn_again():
    """A sample of them: the candidate that became the scene is for the task that is published."""
    assert len(V1.scenes) == V1.request.scenes == 100
    for place in range(0, 100, 7):
        made = draft(V1.request, place, V1.scenes[place]["candidate"])
        assert made.task == V1.scenes[place]["task"]
        assert {obj.name for obj in made.plan.objects} == V1.scenes[place]["positions"].keys()


@pytest.mark.slow
def test_scenes_of_the_reference_are_made_again(tmp_path):
    """Two of them, from nothing: their objects stand where they are published to stand."""
    from pat3d.envs.suites.unit import make_unit

    pytest.importorskip("robosuite")
    # Whether an arm can do it depends on what arms are here; where objects come to rest does not.
    request = replace(V1.request, robot="Panda", picture=0)
    folder = SuiteFolder(tmp_path)
    for place in (0, 12):
        expected = V1.scenes[place]
        said = make_unit(folder, request, place, expected["candidate"])
        assert said["reason"] == "", said
        found = positions(folder.scene(place))
        for name, at in expected["positions"].items():
            assert found[name] == pytest.approx(at, abs=references.TOLERANCE)
        assert json.loads((folder.scene(place) / RECORD).read_text())["instruction"] == expected["instruction"]


def test_a_request_is_for_the_reference_whatever_its_length_and_pictures():
    assert reference_of(V1.request) == V1
    assert reference_of(replace(V1.request, scenes=7, picture=0)) == V1
    for other in ({"scenes": 101}, {"seed": 2}, {"objects": (5, 9)}, {"tasks": ("pick",)}, {"stable": True}):
        assert reference_of(replace(V1.request, **other)) is None


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A suite of one scene, and a reference that it is."""
    asset, folder = asset_of(box(0.05, 0.05, 0.05)), SuiteFolder(tmp_path)
    where = folder.scene(0)
    where.mkdir(parents=True)
    save_scene(scene_of(placed("a", asset, (0.1, 0.0, 0.0)), placed("b", asset, (0.3, 0.0, 0.0))), where)
    record = {"candidate": 2, "task": "pick:a", "instruction": "pick up the a", "checksum": "c"}
    (where / RECORD).write_text(json.dumps(record))
    expected = {**record, "positions": positions(where)}

    def against(**changes):
        wanted = replace(V1, scenes=({**expected, **changes},))
        monkeypatch.setattr(references, "reference_of", lambda request: wanted)
        return differences(folder, Request(scenes=1))

    return SimpleNamespace(against=against, positions=expected["positions"])


def test_the_same_suite_is_the_same_bit_for_bit_or_to_a_tenth_of_a_millimetre(copy):
    assert copy.against() == ([], 1)
    assert copy.against(checksum="another machine's") == ([], 0)
    near = {**copy.positions, "b": [0.30009, 0.0, 0.0]}
    assert copy.against(checksum="another machine's", positions=near) == ([], 0)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"positions": {"a": [0.1, 0.0, 0.0], "b": [0.3, 0.0012, 0.0]}}, '"b" is 1.2 mm away'),
        ({"positions": {"a": [0.1, 0.0, 0.0]}}, "other objects"),
        ({"candidate": 0}, "candidate 2 for 0"),
        ({"task": "pick:b"}, "task 'pick:a' for 'pick:b'"),
        ({"instruction": "grab it"}, "instruction"),
    ],
)
def test_another_suite_is_told_by_what_differs(copy, changes, said):
    lines, _ = copy.against(**changes)
    assert len(lines) == 1
    assert said in lines[0]
    assert "scene 0 is not that of pat3d/tabletop-v1" in lines[0]


def test_what_a_reference_decides_cannot_be_asked_for_otherwise(tmp_path, capsys):
    out = str(tmp_path / "s")
    assert main(["suite", "generate", out, "--reference", "tabletop-v1", "--seed", "5"]) == 2
    assert "decides its seed" in capsys.readouterr().err
    assert main(["suite", "generate", out, "--reference", "tabletop-v9"]) == 2
    assert "There are: tabletop-v1" in capsys.readouterr().err
    assert not (tmp_path / "s").exists()


def document(request: Request) -> dict:
    """A suite.json of a training scene and of one that tests objects."""
    scenes = [
        {"split": "train", "kind": "pick", "nouns": ["mug"]},
        {"split": "test/object", "kind": "pick", "nouns": ["lime"]},
    ]
    return {
        "request": request.as_dict(), "scenes": scenes, "checksum": "0123456789abcdef0123",
        "numbers": {"intersections": 0, "largest_drift_mm": 0.1, "largest_turn_degrees": 0.02, "candidates": 5},
        "held_out": {"nouns": {"val": ["plum"], "test": ["lime"]}}, "versions": {"pat3d": "9", "mujoco": "3"},
        "axes": {"stack_height": {"about": "most objects one upon another"}},
    }  # fmt: skip


def test_a_card_says_what_there_is_how_to_make_it_and_how_to_cite_it():
    told = card("mine", document(Request(tasks=("pick",), scenes=2, seed=4, robot="Panda")))
    rows = {line.split("|")[1].strip(): line.split("|")[2].strip() for line in told.splitlines() if line[:2] == "| "}
    assert {split: rows[split] for split in SPLITS} == {
        "train": "1", "val": "0", "test": "1", "val/layout": "0", "val/object": "0", "test/layout": "0",
        "test/object": "1",
    }  # fmt: skip
    for said in (
        "# mine", "--tasks pick --scenes 2 --seed 4 --objects 5-8 --robot Panda", "0.1 mm and 0.02 degrees",
        "license: apache-2.0", "plum (validation); lime (test)", "mine, 2 scenes, checksum 0123456789abcdef, PAT3D 9",
        "stack height: most objects", "What it does not measure",
    ):  # fmt: skip
        assert said in told, said
    assert "Baselines" not in told


def test_the_card_of_a_reference_names_it_with_its_baselines(monkeypatch):
    base = {"policy": "scripted", "obs": "state", "split": "all", "successes": 9, "episodes": 10}
    wanted = replace(V1, baselines=(base,))
    monkeypatch.setattr("pat3d.envs.suites.card.reference_of", lambda request: wanted)
    told = card("copy", document(V1.request))
    assert "# pat3d/tabletop-v1" in told
    assert "pat3d suite generate OUT --reference tabletop-v1\n" in told
    # Wilson's interval of 9 in 10, as tables have it.
    assert "| scripted | all | 90.0 % [59.6, 98.2] of 10 |" in told
    few = card("copy", document(replace(V1.request, scenes=2)))
    assert "# copy" in few
    assert "The first 2 of the 100 scenes of pat3d/tabletop-v1" in few
