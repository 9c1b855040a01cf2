"""A relation belongs to what it is said of, by the landmarks that are named with it, and to all of them."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A radio with a clock behind it and a vase to the left of the clock.",
         {"clock behind radio", "vase left_of clock"}),
        ("A bucket with a ball beside it and a shoe in front of the ball.",
         {"ball next_to bucket", "shoe in_front_of ball"}),
        ("On the bench there is a jug with a cup to the right of it and a book behind the cup.",
         {"jug on bench", "cup on bench", "book on bench", "cup right_of jug", "book behind cup"}),
        ("A tray with a jug and a spoon beside the jug.", {"jug on tray", "spoon on tray", "spoon next_to jug"}),
        ("A radio on the bench with two jugs on top of it.",
         {"radio on bench", "jug 1 on radio", "jug 2 on radio"}),
        ("A bucket full of balls behind a jug and a shoe.",
         {"bucket behind jug", "bucket behind shoe", *(f"ball {at} in bucket" for at in range(1, 9))}),
        ("A jug on top of a drum with a shoe on the right side of them.", {"jug on drum", "shoe right_of drum"}),
        ("A radio on a chest, with a lamp on the left of them and a stool on the right of them.",
         {"radio on chest", "lamp left_of chest", "stool right_of chest"}),
        ("On the bench is a jar with pens, a clock, a bowl with a bun.",
         {"jar on bench", "clock on bench", "bowl on bench", "bun in bowl",
          *(f"pen {at} in jar" for at in range(1, 4))}),
        ("A jar with cookies, a kettle, a cup on a saucer.",
         {"cup on saucer", *(f"cookie {at} in jar" for at in range(1, 4))}),
        ("A jar with pens, a ruler and a brush.",
         {"ruler in jar", "brush in jar", *(f"pen {at} in jar" for at in range(1, 4))}),
        ("A kettle next to a jug and a tray.", {"kettle next_to jug", "kettle next_to tray"}),
        ("A kettle next to a jug of pens and a tray with a bun.",
         {"kettle next_to jug", "kettle next_to tray", "bun on tray", *(f"pen {at} in jug" for at in range(1, 4))}),
        ("A stool behind a bench and a lamp.", {"stool behind bench", "stool behind lamp"}),
        ("There is a shoe beside the bucket and the drum.", {"shoe next_to bucket", "shoe next_to drum"}),
        ("A tray with a jug next to a radio and a clock.",
         {"jug on tray", "tray next_to radio", "tray next_to clock"}),
        ("A tray with a jug and a saucer which holds a cookie.",
         {"jug on tray", "saucer on tray", "cookie on saucer"}),
        ("Two stools facing each other across a bench.", {"stool 1 left_of bench", "stool 2 right_of bench"}),
        ("Three crates: one of them is behind the other two.", {"crate 1 behind crate 2", "crate 1 behind crate 3"}),
        ("Two white jugs and a green jug stand on a bench. The green jug is left of the other two.",
         {"white jug 1 on bench", "white jug 2 on bench", "green jug on bench", "green jug left_of white jug 1",
          "green jug left_of white jug 2"}),
    ],
)  # fmt: skip
def test_is_said_of_its_own(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "task", "note"),
    [
        ("Pick up the jug and toss it to me.", "pick:jug", 'not modelled: "toss it to me": no task does that.'),
        ("Grab the ball from the crate and throw it over.", "pick:ball", 'not modelled: "throw it over"'),
        ("Pick up the ball and toss it into the crate.", "place:ball:crate", ""),
        ("Pick up the ball and put it beside the crate.", "beside:ball:next_to:crate", ""),
    ],
)
def test_what_is_handed_over_is_picked_up(prompt: str, task: str | None, note: str):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert note in "\n".join(plan.notes)


def test_a_list_behind_a_landmark_is_not_inside():
    notes = PLANNER.plan("A bucket full of balls behind a jug, and a shoe.").notes
    assert '"a shoe": "behind a jug" is not read as said of it; on the ground' in notes


@pytest.mark.parametrize("level", ["top", "middle"])
def test_the_level_of_a_shelf_that_is_named_already_is_a_tier_of_it(level: str):
    plan = PLANNER.plan(f"A shelf with a jug on the {level} shelf.")
    assert [(one.kind, one.objects, one.of) for one in plan.arrangements] == [
        (f"on_{level}_tier", ("jug",), ("shelf",))
    ]
    assert plan.notes == ()
