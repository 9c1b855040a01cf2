"""`pat3d generate --prompts`: a scene for every line, what is done is kept, and a table says what came of each."""

import csv
import json

import pytest

import pat3d
from pat3d.cli.main import main
from pat3d.errors import SpecError
from pat3d.generation import many
from pat3d.generation.many import folder_names, read_prompts

PROMPTS = """\
# small scenes
a ball

a flurble on a table
a wooden block
a ball
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The file, the folder, and what the first run printed."""
    root = tmp_path_factory.mktemp("many")
    (root / "prompts.txt").write_text(PROMPTS)
    code = main(["generate", "--prompts", str(root / "prompts.txt"), "--out", str(root / "scenes")])
    return root, code


def rows(root):
    with (root / "scenes" / "scenes.csv").open() as file:
        return list(csv.DictReader(file))


def test_every_prompt_has_a_scene_or_a_reason_and_the_table_says_so(run):
    root, code = run
    # A prompt that was refused is something for the user to mend.
    assert code == 2
    assert [(row["folder"], row["state"]) for row in rows(root)] == [
        ("a_ball", "verified"),
        ("a_flurble_on_a_table", "refused"),
        ("a_wooden_block", "verified"),
    ]
    assert "flurble" in rows(root)[1]["message"]
    assert {entry.name for entry in (root / "scenes").iterdir()} == {"a_ball", "a_wooden_block", "scenes.csv"}
    assert pat3d.load_scene(root / "scenes" / "a_ball").prompt == "a ball"


def test_the_same_command_again_keeps_what_is_done_and_makes_what_is_missing(run, capfd):
    root, _ = run
    (root / "more.txt").write_text("a wooden block\na ball\na book\n")
    stamps = {path: path.stat().st_mtime_ns for path in (root / "scenes").glob("*/scene.json")}
    assert main(["generate", "--prompts", str(root / "more.txt"), "--out", str(root / "scenes")]) == 0
    told = capfd.readouterr()
    assert told.err.count("there already") == 2
    assert "3 of 3 scenes verified" in told.out
    assert all(path.stat().st_mtime_ns == stamp for path, stamp in stamps.items())
    assert [row["folder"] for row in rows(root)] == ["a_wooden_block", "a_ball", "a_book"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "change",
    [
        ["--seed", "1"],
        *(
            pytest.param(change, marks=pytest.mark.slow)
            for change in (["--friction", "0.3"], ["--formats", "mjcf", "urdf"])
        ),
    ],
)
def test_a_scene_with_other_settings_is_made_anew(run, change, capfd):
    root, _ = run
    (root / "one.txt").write_text("a ball\n")
    assert main(["generate", "--prompts", str(root / "one.txt"), "--out", str(root / "other")]) == 0
    assert main(["generate", "--prompts", str(root / "one.txt"), "--out", str(root / "other"), *change]) == 0
    assert "there already" not in capfd.readouterr().err.splitlines()[-1]
    report = json.loads((root / "other" / "a_ball" / "report.json").read_text())
    assert report["passed"]
    assert set(report["exports"]) >= {"mjcf"}


def test_a_folder_s_name_depends_on_its_prompt_alone():
    long = "a red mug and a blue bowl and a green plate and a white cup on a wooden table"
    few, more = folder_names(["a mug", long]), folder_names(["a cup", long, "a mug", long + " and a spoon", "A mug!"])
    assert {name: more[name] for name in few} == few
    assert len(set(more.values())) == 5
    assert more["A mug!"].startswith("a_mug_")
    assert all(len(name) <= many.MAX_NAME + 7 for name in more.values())


def test_files_that_hold_no_prompts_are_refused(tmp_path, capfd):
    (tmp_path / "empty.txt").write_text("# nothing\n\n")
    (tmp_path / "binary.txt").write_bytes(b"\xff\xfe\x00")
    for name in ("empty.txt", "binary.txt", "none.txt"):
        with pytest.raises(SpecError):
            read_prompts(tmp_path / name)
        assert main(["generate", "--prompts", str(tmp_path / name), "--out", str(tmp_path / "out")]) == 2
        assert name in capfd.readouterr().err
    assert main(["generate", "a mug", "--prompts", "x", "--out", str(tmp_path / "out")]) == 2
    assert main(["generate", "--out", str(tmp_path / "out")]) == 2
    assert not (tmp_path / "out").exists()
