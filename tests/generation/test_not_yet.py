"""What a task is to bring about beside something is not there in the layout: by chance, by wish, or with a note."""

from __future__ import annotations

import pytest

from pat3d.errors import LayoutError
from pat3d.generation.attempts import Attempts
from pat3d.generation.checkpoints import Workspace
from pat3d.generation.not_yet import TRIES, beside_steps, done_already, with_task_to_do
from pat3d.generation.request import request_of
from pat3d.layout.predicates import relation_holds
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.progress import Clock, silent
from pat3d.scene.relations import Relation
from tests.scenes import asset_of, box, placed, scene_of

BLOCK = asset_of(box(0.06, 0.06, 0.06), noun="block")
TASK = "beside:red:left_of:blue"


def beside(x: float, y: float = 0.0):
    """A red block at (x, y) [m] from a blue one."""
    return scene_of(placed("red", BLOCK, (x, y, 0.03)), placed("blue", BLOCK, (0.0, 0.0, 0.03)), task=TASK)


def test_steps_beside_something_are_found_in_chains_and_alone():
    assert beside_steps(TASK) == (("red", "left_of", "blue"),)
    assert beside_steps(f"chain:place:a:b:then:{TASK}") == (("red", "left_of", "blue"),)
    assert beside_steps("place:a:b") == beside_steps("sort") == beside_steps(None) == ()


def test_where_a_landmark_is_before_it_is_moved_does_not_matter():
    assert beside_steps("chain:place:blue:tray:then:beside:red:left_of:blue") == ()
    later = "chain:beside:red:left_of:blue:then:place:blue:tray"
    assert beside_steps(later) == (("red", "left_of", "blue"),)


@pytest.mark.parametrize(("x", "done"), [(-0.15, True), (0.15, False)])
def test_what_is_to_the_left_already_is_not_to_be_put_there(x, done):
    assert bool(done_already(beside(x), beside_steps(TASK))) is done


def test_layouts_are_drawn_until_one_leaves_something_to_do():
    drawn = []

    def place(seed, wishes):
        drawn.append(seed)
        return beside(0.15 if len(drawn) == 3 else -0.15), (f"layout {len(drawn)}",)

    scene, notes = with_task_to_do(place, 7, TASK, ())
    assert (scene.task, notes, drawn[0], len({*drawn})) == (TASK, ("layout 3",), 7, 3)


def test_where_no_layout_leaves_anything_to_do_there_is_no_task_and_a_note():
    drawn = []

    def place(seed, wishes):
        drawn.append(seed)
        return beside(-0.15), ()

    scene, notes = with_task_to_do(place, 7, TASK, ())
    assert scene.task is None
    assert notes == ('the task is left out: every layout tried has "red" to the left of "blue" already.',)
    assert len(drawn) == TRIES


def test_a_task_of_another_kind_takes_the_first_layout():
    scene, _ = with_task_to_do(lambda seed, _: (beside(-0.15), ()), 7, "pick:red", ())
    assert scene.task == TASK


def test_what_is_to_be_next_to_something_is_wished_far_from_it_and_laid_out_all_the_same():
    asked = []

    def place(seed, wishes):
        asked.append([str(wish) for wish in wishes])
        if wishes:
            raise LayoutError("no room")
        return beside(1.0), ()

    with_task_to_do(place, 7, "beside:red:next_to:blue", ())
    assert asked == [["red far_from blue"], []]
    on_two = (Relation(child="red", kind="on", parent="tray"), Relation(child="blue", kind="on", parent="desk"))
    with_task_to_do(
        lambda seed, wishes: (beside(1.0), asked.append(wishes) or ()), 7, "beside:red:next_to:blue", on_two
    )
    assert asked[-1] == ()


@pytest.mark.parametrize("prompt", ["Put the red mug to the left of the blue bowl.", "Put the spoon next to the cup."])
def test_scenes_of_sentences_leave_their_task_to_do(prompt, tmp_path):
    plan = GrammarPlanner().plan(prompt)
    for seed in range(4):
        attempts = Attempts(
            request_of(plan, allow_proxies=False), seed=seed, friction=0.2, device="cpu",
            workspace=Workspace(tmp_path / "unused", keep=False), clock=Clock(), progress=silent, scratch=tmp_path,
        )  # fmt: skip
        scene = attempts.layout()
        ((moved, kind, landmark),) = beside_steps(scene.task)
        assert scene.task == plan.task
        poses = {obj.name: obj.pose for obj in scene.objects}
        assets = {obj.name: obj.asset for obj in scene.objects}
        assert not relation_holds(Relation(child=moved, kind=kind, parent=landmark), assets, poses)
