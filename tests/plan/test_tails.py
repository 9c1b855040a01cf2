"""Clauses and tails that name nothing to be made are named in a note; the rest of their sentence is read."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.grammar.words.unmade import base_verb, is_quality

PLANNER = GrammarPlanner()


def read(sentence):
    plan = PLANNER.plan(sentence)
    objects = ", ".join(obj.name for obj in plan.objects)
    return objects, ", ".join(map(str, plan.relations)), plan.task, plan.notes


@pytest.mark.parametrize(
    ("sentence", "objects", "relations", "noted"),
    [
        ("A kettle on a stove, humming to itself with impatience.", "kettle, stove", "kettle on stove", "impatience"),
        ("A spoon, a fork and, a little aside, a knife.", "spoon, fork, knife", "", "a little aside"),
        ("A pen lies on a notebook that is never closed.", "pen, notebook", "pen on notebook", "that is never closed"),
        ("Four lemons and a teapot completed the still life.", "lemon 1, lemon 2, lemon 3, lemon 4, teapot", "",
         "completed the still life"),
        ("A cat sleeps on a sofa, dreaming of adventures.", "cat, sofa", "cat on sofa", "dreaming of adventures"),
    ],
)  # fmt: skip
def test_a_tail_that_names_nothing_is_set_aside(sentence, objects, relations, noted):
    made, related, _, notes = read(sentence)
    assert (made, related) == (objects, relations)
    assert any(noted in note for note in notes)


@pytest.mark.parametrize(
    ("sentence", "noted"),
    [
        ("The difficulty lies in the tightness of the space.", "difficulty"),
        ("The elegance of the ensemble delights the beholder.", "ensemble"),
    ],
)
def test_a_later_sentence_of_a_quality_is_set_aside(sentence, noted):
    made, related, _, notes = read(f"A plum lies in a bowl. {sentence}")
    assert (made, related) == ("plum, bowl", "plum in bowl")
    assert any(noted in note for note in notes)


@pytest.mark.parametrize(
    ("sentence", "fault"),
    [
        ("A plum in a bowl, guarded by a dragonfly.", "dragonfly"),
        ("A rug held down by a bagpipe.", "bagpipe"),
        ("A mug next to a jar, humming beside a lathe.", "lathe"),
        ("A plum on a stand.", "stand"),
        ("A bucket and an onion peel.", "peel"),
        ("A plum lies in a bowl. A turret delights the eye.", "turret"),
        ("A mug is not on the table.", '"not"'),
    ],
)
def test_a_thing_that_may_be_meant_is_never_set_aside(sentence, fault):
    with pytest.raises(PromptError, match=fault):
        PLANNER.plan(sentence)


@pytest.mark.parametrize(
    "sentence",
    [
        "A red box and, unlike the blue box, glowering, a lid.",
        "There are four boxes of different colors (red, blue, green, and yellow). Pick up each box and place it in a "
        "specific order: red first, then blue, followed by green.",
    ],
)
def test_words_that_may_stand_for_objects_are_not_set_aside_unsaid(sentence):
    try:
        plan = PLANNER.plan(sentence)
    except PromptError:
        return
    boxes = [obj for obj in plan.objects if obj.noun == "box"]
    assert len({colour for box in boxes for colour in box.colours}) >= 2


def test_forms_of_verbs_are_known_and_things_are_no_qualities():
    assert [base_verb(word) for word in ("stirs", "stirring", "stirred", "spun", "navigates", "hurried")] == [
        "stir", "stir", "stir", None, "navigate", "hurry",
    ]  # fmt: skip
    assert is_quality("simplicity")
    assert is_quality("challenges")
    assert not any(map(is_quality, ("cushion", "ornament", "chandelier", "station")))


@pytest.mark.parametrize(
    ("sentence", "objects", "relations", "noted"),
    [
        ("A candle has fallen over next to a vase.", "candle, vase", "candle next_to vase", ""),
        ("A carrot pokes out of a bucket on a bench.", "carrot, bucket, bench", "carrot in bucket, bucket on bench",
         "pokes"),
        ("The only object in the basket is a lemon.", "lemon, basket", "lemon in basket", "object"),
        ("A tray piled high with pears.", "tray, pear 1, pear 2, pear 3", "pear 1 on tray, pear 2 on tray, "
         "pear 3 on tray", "high"),
        ("A cake cut into six slices on a plate.", "cake, plate", "cake on plate", "cut into six slices"),
        ("Behind the kettle hides a lemon.", "kettle, lemon", "lemon behind kettle", "hides"),
        ("A tray with both a mug and teapot on top.", "tray, mug, teapot", "mug on tray, teapot on tray", ""),
        ("Two lanterns were left at the campground.", "lantern 1, lantern 2", "", "campground"),
    ],
)  # fmt: skip
def test_what_happened_is_read_as_what_is_there(sentence, objects, relations, noted):
    made, related, _, notes = read(sentence)
    assert (made, related) == (objects, relations)
    set_aside = PLANNER.plan(sentence).set_aside
    assert any(noted in note for note in (*notes, *set_aside)) or not noted
