"""What was refused for its wording and is read: it is the same scene as in plain words, and a note has what is not.

Colours that things are "in", verbs that nobody knows, either of two, what is not like another, remarks and talk.
"""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _scene(plan: ScenePlan) -> tuple[list[tuple[str, tuple[str, ...]]], set[str], str | None]:
    things = sorted((obj.name, tuple(obj.colours)) for obj in plan.objects)
    return things, {str(one) for one in plan.relations}, plan.task


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("A jug in red on a bench.", "A red jug on a bench."),
        ("Two stools in oak beside a bench.", "Two oak stools beside a bench."),
        ("Two jugs, one in green and one in white, on a bench.", "A green jug and a white jug on a bench."),
        ("Three bowls in red, green and blue on a bench.", "Three red, green and blue bowls on a bench."),
        ("A basket in brown leather and a lamp in white.", "A brown leather basket and a white lamp."),
        ("The bench is painted in green.", "The bench is green."),
        ("Move the jug in red to the shelf.", "Move the red jug to the shelf."),
        ("A rose in glass on a shelf.", "A rose in a glass on a shelf."),
        ("On the bench you'll find a jug and a bowl.", "On the bench are a jug and a bowl."),
        ("In the box one finds three balls.", "In the box are three balls."),
        ("There's a dog asleep on the rug.", "A dog is on the rug."),
        ("Locate the red jug and put it on the tray.", "Find the red jug and put it on the tray."),
        ("Take hold of the jug by the lamp.", "Grasp the jug by the lamp."),
        ("Toys littering the rug.", "Toys on the rug."),
        ("A jug and, to the right of that, a lamp.", "A jug and a lamp to the right of it."),
        ("I'm hungry, could you hand me the plum on the tray?", "Hand me the plum on the tray."),
        ("Put the plum on either tray.", "Put the plum on one of the two trays."),
        ("Take either of the two plums from the tray.", "Take one of the two plums from the tray."),
    ],
)
def test_is_the_same_scene_as_in_plain_words(said: str, plain: str):
    assert _scene(PLANNER.plan(said)) == _scene(PLANNER.plan(plain))


@pytest.mark.parametrize(
    ("said", "plain", "left_out"),
    [
        ("Shelve the atlas.", "There is the atlas.", '"Shelve the atlas": no task does that.'),
        ("Water the plant on the bench.", "The plant is on the bench.", "no task does that"),
        ("Vacuum the rug, then put the cup on the tray.", "The rug. Put the cup on the tray.", "Vacuum the rug"),
        ("Thread the rope through the ring.", "There is the rope and the ring.", "Thread the rope through the ring"),
        ("Three dolls in a row from the biggest to the smallest.", "Three dolls in a row.", "from the biggest"),
        ("Four jars in a row, from the tallest on the left to the shortest on the right.", "Four jars in a row.",
         "from the tallest on the left to the shortest on the right"),
        ("A tablet on a bench, its screen dark.", "A tablet on a bench.", "its screen dark"),
        ("Lift the jug by its handle.", "Lift the jug.", "by its handle"),
        ("Two jars are on a bench. They aren't full.", "Two jars are on a bench.", "They aren't full"),
        ("Move the plate that was not rinsed into the box.", "Move the plate into the box.", "that was not rinsed"),
        ("Clear the bench of all jars except the red one.", "Clear the bench of all jars.", "except the red one"),
        ("It's tea time: a jug stands on a tray.", "A jug stands on a tray.", "It's tea time"),
        ("Help me set up for a party. Move the jug to the bench.", "Move the jug to the bench.", "set up for a party"),
        ("Be careful with this one: move the jug to the bench.", "Move the jug to the bench.", "Be careful"),
        ("Pick up whichever plum is riper.", "Pick up one of the two plums.", "whichever plum is riper"),
        ("Two jars are on a bench. Its sheen has a quiet rhythm that recalls the rain.", "Two jars are on a bench.",
         "Its sheen has a quiet rhythm"),
        ("A jug is on a bench. The daylight pouring through a nearby window casts a soft glow on the bench.",
         "A jug is on a bench.", "The daylight pouring"),
    ],
)  # fmt: skip
def test_the_rest_is_read_and_a_note_has_what_is_left_out(said: str, plain: str, left_out: str):
    plan = PLANNER.plan(said)
    assert _scene(plan) == _scene(PLANNER.plan(plain))
    assert any(left_out in note for note in plan.notes)


@pytest.mark.parametrize(
    ("said", "levels"),
    [
        ("Four wooden blocks are stacked in a tower: red at the bottom, then green, blue and finally white on top.",
         ["red", "green", "blue", "white"]),
        ("Three crates are piled up, white on top, then red, with blue at the bottom.", ["blue", "red", "white"]),
        ("A stack of four crates: blue at the bottom, green, yellow and red at the top.",
         ["blue", "green", "yellow", "red"]),
    ],
)  # fmt: skip
def test_a_tower_is_told_by_its_colours(said: str, levels: list[str]):
    plan = PLANNER.plan(said)
    colours = {obj.name: "".join(obj.colours) for obj in plan.objects}
    on = {colours[one.parent]: colours[one.child] for one in plan.relations if one.kind == "on"}
    assert on == dict(zip(levels, levels[1:], strict=False))
    materials = {obj.material for obj in plan.objects}
    assert "wooden" not in said or materials == {"wood"}


@pytest.mark.parametrize(
    ("said", "objects", "task"),
    [
        ("Put the fig that's not in the bowl on the tray.", ["bowl", "fig 1", "fig 2", "tray"], "place:fig 2:tray"),
        ("Pick up the plate that isn't on the bench.", ["bench", "plate 1", "plate 2"], "pick:plate 2"),
        ("Lift the cube that is neither red nor blue.", ["blue cube", "cube", "red cube"], "pick:cube"),
        ("Pick up the jug that is not green.", ["green jug", "jug"], "pick:jug"),
    ],
)
def test_what_is_not_like_another_is_one_more(said: str, objects: list[str], task: str):
    plan = PLANNER.plan(said)
    assert sorted(obj.name for obj in plan.objects) == objects
    assert plan.task == task


@pytest.mark.parametrize(
    ("said", "fault"),
    [
        ("Either a hat or a cap is on the bench.", "either"),
        ("Every plate holds an egg, except that one holds a bun.", "except"),
        ("Five of the jars, all but the red one, are here.", "all"),
        ("It is on the bench.", '"it"'),
        ("Unlike the red jug, the blue jug has a lid.", "."),
        ("A jug is on a bench. A bagpipe lies beside it.", "bagpipe"),
    ],
)
def test_what_may_be_more_or_less_is_still_refused(said: str, fault: str):
    with pytest.raises(PromptError, match=fault):
        PLANNER.plan(said)
