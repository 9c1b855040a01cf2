"""Edits of a scene at rest: what moves, what does not, what cannot be, and what is written."""

import json
import shutil
from dataclasses import dataclass, replace

import numpy as np
import pytest

import pat3d
from pat3d.check.certificate import certify
from pat3d.check.penetration import penetration
from pat3d.cli.main import main
from pat3d.errors import EditError, LayoutError, PromptError
from pat3d.generation.editing.draft import Draft
from pat3d.generation.editing.resettling import Changes, settled
from pat3d.generation.editing.said import applied
from pat3d.generation.editing.selecting import chosen
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.scene.history import Edit
from pat3d.scene.model import Scene

UNMOVED = 0.1
"""[mm]"""


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@dataclass
class Rest:
    scene: Scene
    changes: Changes


def at_rest(edited):
    """The edited scene at rest, without the verification that `settle` adds."""
    _, scene, changes = settled(edited.draft, edited.before)
    return Rest(scene, changes)


def height(scene, name):
    obj = scene[name]
    return min(float(obj.pose.apply(part.vertices)[:, 2].min()) for part in obj.parts)


@pytest.fixture(scope="module")
def lowered(desk):
    return desk.remove("bottom book").settle()


def test_removing_the_bottom_book_lets_the_stack_down_by_its_thickness_and_moves_nothing_else(desk, lowered):
    bottom = desk.scene["book 1"]
    thickness = 1e3 * float(bottom.asset.size[2])
    assert lowered.changes.removed == ("book 1",)
    for name in ("book 2", "book 3"):
        # The stack stands a barrier's gap higher or lower than it did.
        assert lowered.changes.moved[name].mm == pytest.approx(thickness, abs=0.05)
        assert lowered.changes.moved[name].degrees < 0.01
    others = [one.mm for name, one in lowered.changes.moved.items() if not name.startswith("book")]
    assert max(others) < UNMOVED
    assert height(lowered.scene, "book 2") == pytest.approx(height(desk.scene, "book 1"), abs=2e-5)


def test_an_edited_scene_is_in_equilibrium_and_free_of_intersections(lowered):
    certificate = certify(lowered.scene)
    assert certificate.passed
    assert certificate.worst < 1e-6
    assert penetration(lowered.scene).passed


def test_scenes_are_values_and_edits_change_neither_them_nor_their_files(desk, desk_folder):
    before, poses = files(desk_folder), [obj.pose for obj in desk.scene.objects]
    edited = desk.move("vase", "2 cm back")
    assert [obj.pose for obj in desk.scene.objects] == poses
    assert edited.scene["vase"].pose != desk.scene["vase"].pose
    assert desk.scene.history == ()
    assert edited.scene.history == (Edit(verb="move", said="vase: 2 cm back", objects=("vase",)),)
    assert files(desk_folder) == before


def test_a_mug_is_added_on_top_of_the_stack_and_everything_else_stays(desk):
    done = at_rest(desk.add("a coffee mug on the stack of books"))
    assert done.changes.added == ("coffee mug",)
    assert done.scene.parent("coffee mug") == "book 3"
    top = float(done.scene["book 3"].pose.apply(done.scene["book 3"].parts[0].vertices)[:, 2].max())
    assert height(done.scene, "coffee mug") == pytest.approx(top, abs=1e-3)
    assert max(one.mm for one in done.changes.moved.values()) < UNMOVED
    assert not any("assumed" in note for note in done.changes.notes)


def test_one_of_a_kind_is_named_by_its_number(desk):
    scene = desk.remove("book 3").add("a pen on the book 2").scene
    assert scene.parent("pen") == "book 2"


def test_a_pen_holder_is_no_pen(desk):
    scene = desk.remove("all books").add("a pencil holder on the desk").add("a pen on the desk").scene
    assert chosen(scene, "the pen", GrammarPlanner()) == ("pen",)
    assert chosen(scene, "the pencil holder", GrammarPlanner()) == ("pencil holder",)


def test_a_support_that_did_not_hold_before_is_told_so(desk):
    vase = desk.scene["vase"]
    away = replace(vase, pose=Pose(position=(5.0, 0.0, 1e-5)))
    faulty = replace(desk.scene, objects=tuple(away if obj is vase else obj for obj in desk.scene.objects))
    scene = replace(desk, before=faulty, draft=Draft(scene=faulty))
    with pytest.raises(EditError, match="did not hold before"):
        at_rest(scene.fix("desk"))


def test_what_is_moved_takes_along_what_it_carries(desk):
    done = at_rest(desk.move("bowl", "3 cm to the left and 1 cm back"))
    for name in ("bowl", "apple 1", "apple 2"):
        way = np.subtract(done.scene[name].pose.position, desk.scene[name].pose.position)
        assert way[:2] == pytest.approx([-0.03, 0.01], abs=1e-3)
    assert max(done.changes.moved[name].mm for name in ("vase", "desk", "book 1", "book 3")) < UNMOVED


def test_moving_by_words_changes_the_scene_tree(desk):
    done = at_rest(desk.move("vase", "onto the books"))
    assert done.scene.parent("vase") == "book 3"
    assert done.scene.prompt == desk.scene.prompt


def test_a_turn_is_about_the_vertical_through_the_foot(desk):
    done = at_rest(desk.turn("vase", 30))
    turn = done.scene["vase"].pose.rotation @ desk.scene["vase"].pose.rotation.T
    assert np.degrees(np.arctan2(turn[1, 0], turn[0, 0])) == pytest.approx(30.0, abs=0.05)
    assert done.changes.moved["vase"].degrees == pytest.approx(30.0, abs=0.05)


def test_a_larger_vase_weighs_the_cube_and_its_inertia_is_the_fifth_power(desk):
    old = desk.scene["vase"].asset
    scene = desk.scale("vase", "10 % smaller").scene
    new = scene["vase"].asset
    assert new.size == pytest.approx(0.9 * old.size)
    assert new.mass_properties.mass == pytest.approx(0.9**3 * old.mass_properties.mass)
    assert np.array(new.mass_properties.inertia) == pytest.approx(0.9**5 * np.array(old.mass_properties.inertia))
    again = mass_properties(new.visual.vertices, new.visual.faces, mass=new.mass_properties.mass)
    assert np.array(new.mass_properties.inertia) == pytest.approx(np.array(again.inertia), rel=1e-6, abs=1e-12)


def test_what_is_set_reaches_the_asset_and_a_heavier_thing_stays_where_it_is(desk):
    done = at_rest(desk.set("apple 1", mass=0.4, friction=0.7).fix("desk"))
    apple = done.scene["apple 1"].asset
    assert apple.mass_properties.mass == 0.4
    assert apple.material.friction == 0.7
    # Apples of one kind share an asset; only the one that was named is heavier.
    assert done.scene["apple 2"].asset.mass_properties.mass == desk.scene["apple 2"].asset.mass_properties.mass
    assert done.scene["desk"].fixed
    assert max(one.mm for one in done.changes.moved.values()) < UNMOVED


def test_what_is_said_beside_a_material_holds_in_whichever_order(desk):
    for said in ("material=wood, friction=0.6, density=900", "density=900, friction=0.6, material=wood"):
        apple = applied(desk, [("set", f"apple 1: {said}")]).scene["apple 1"].asset
        assert apple.material.name == "wood"
        assert apple.material.friction == 0.6
        assert apple.mass_properties.mass == pytest.approx(900 * apple.mass_properties.volume)


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ("mass=1, density=900", "not both"),
        ("mass=1, mass=2", "twice"),
        ("what=3", "cannot be set"),
        ("mass", "nothing"),
    ],
)
def test_what_cannot_be_set_is_refused(desk, said, message):
    with pytest.raises(EditError, match=message):
        applied(desk, [("set", f"apple 1: {said}")])


def test_a_replacement_stands_where_the_old_one_stood_under_its_own_name(desk):
    done = at_rest(desk.replace("vase", "a plant pot"))
    old, new = desk.scene["vase"].pose.position, done.scene["plant pot"].pose.position
    assert new[:2] == pytest.approx(old[:2], abs=2e-3)
    assert done.scene.parent("plant pot") == desk.scene.parent("vase")
    assert "vase" not in {obj.name for obj in done.scene.objects}


def test_what_lay_in_a_bowl_comes_down_when_the_bowl_is_taken(desk):
    done = at_rest(desk.remove("the bowl"))
    for name in ("apple 1", "apple 2"):
        assert done.scene.parent(name) == "desk"
        assert height(done.scene, name) == pytest.approx(height(done.scene, "vase"), abs=2e-4)


@pytest.mark.parametrize(
    ("verb", "words", "error", "reason"),
    [
        ("move", ("vase", "2 m to the right"), EditError, "only the ground"),
        ("scale", ("bowl", 15.0), EditError, "no room"),
        ("add", ("a bed in the bowl",), LayoutError, "bed"),
        ("add", ("a zorblax on the desk",), PromptError, "zorblax"),
        ("add", ("the vase",), EditError, "nothing new"),
        ("add", ("a mug on the piano",), EditError, "piano"),
        ("add", ("an apple next to the apple 1",), EditError, "apple 1"),
        ("remove", ("teapot",), EditError, "The scene has: book 1"),
        ("move", ("vase", "somewhere nice"), EditError, "Valid: "),
        ("turn", ("vase", "a bit"), EditError, "90 degrees"),
        ("scale", ("vase", "huge"), EditError, "20 % larger"),
    ],
)
def test_an_edit_that_cannot_be_says_why(desk, verb, words, error, reason):
    with pytest.raises(error, match=reason):
        getattr(desk, verb)(*words)


def test_what_is_put_half_over_an_edge_topples_and_is_refused(desk):
    table, vase = desk.scene["desk"].asset.bounds[1][0], desk.scene["vase"]
    # Its middle is beyond the edge, its foot still on the table.
    beyond = table + 0.2 * float(vase.asset.size[0]) - vase.pose.position[0]
    away = desk.remove("bowl").remove("all apples").remove("all books")
    with pytest.raises(EditError, match=r"topple|does not stay|only the ground"):
        at_rest(away.move("vase", f"{100 * beyond:.2f} cm to the right"))


def test_a_relation_that_an_edit_breaks_is_told_and_forgotten(desk):
    beside = desk.remove("all books").remove("the bowl").remove("all apples").add("a green mug to the left of the vase")
    mug, vase = (beside.scene[name].pose.position for name in ("green mug", "vase"))
    assert mug[0] < vase[0]
    rest = at_rest(beside)
    before = replace(beside, before=rest.scene, draft=Draft(scene=rest.scene))
    done = at_rest(before.move("green mug", "12 cm back").move("green mug", "30 cm right"))
    assert any("green mug left_of vase" in line for line in done.changes.broke)
    assert not any(rel.child == "green mug" and rel.kind == "left_of" for rel in done.scene.relations)


def test_a_later_edit_that_breaks_what_an_earlier_one_asks_for_is_refused(desk):
    beside = desk.remove("all books").remove("the bowl").remove("all apples").add("a green mug to the left of the vase")
    moved = beside.move("green mug", "12 cm back").move("green mug", "30 cm right")
    with pytest.raises(EditError, match="asked for"):
        at_rest(moved)


def test_what_is_edited_twice_begins_with_what_was_settled(desk, lowered):
    done = lowered.remove("bottom book")
    assert done.before.history == lowered.scene.history
    assert [str(edit) for edit in done.scene.history] == ['remove "bottom book"'] * 2
    assert at_rest(done).changes.removed == ("book 2",)


@pytest.mark.slow
def test_the_command_writes_a_folder_that_verifies_with_its_history(desk_folder, tmp_path, capfd):
    before = files(desk_folder)
    out = tmp_path / "desk2"
    argv = [
        "edit",
        str(desk_folder),
        "--remove",
        "top book",
        "--add",
        "a mug on the books",
        "--set",
        "mug: mass=0.8",
        "--out",
        str(out),
        "--json",
    ]
    assert main(argv) == 0
    facts = json.loads(capfd.readouterr().out)
    assert facts["removed"] == ["book 3"]
    assert facts["passed"]
    assert files(desk_folder) == before
    document = json.loads((out / "scene.json").read_text())
    assert document["version"] == 2
    assert [entry["verb"] for entry in document["history"]] == ["remove", "add", "set"]
    report = json.loads((out / "report.json").read_text())
    assert report["passed"]
    assert report["edits"]["removed"] == ["book 3"]
    assert main(["check", str(out)]) == 0
    again = pat3d.load(out)
    assert [str(edit) for edit in again.scene.history] == [
        'remove "top book"',
        'add "a mug on the books"',
        'set "mug: mass=0.8"',
    ]
    assert again.scene.parent("mug") == "book 2"
    assert json.loads((desk_folder / "scene.json").read_text())["version"] == 1


def test_a_command_that_cannot_be_done_leaves_every_file_as_it_was(desk_folder, tmp_path, capfd):
    folder = tmp_path / "desk"
    shutil.copytree(desk_folder, folder)
    before = files(tmp_path)
    assert main(["edit", str(folder), "--remove", "book 1", "--move", "vase: 3 m to the left"]) == 2
    assert "only the ground" in capfd.readouterr().err
    assert files(tmp_path) == before
