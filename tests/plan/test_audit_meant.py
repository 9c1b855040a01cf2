"""What a plan takes a word for, where a person takes it for something else, is said; of a true plan nothing is."""

from dataclasses import replace

import pytest

from pat3d.plan.scene_plan import Arrangement, Posture, ScenePlan
from tests.plan.test_audit_members import notes, plan
from tests.plan.vocabulary import chain

CASES = [
    # Where "in it" ends, and what "holding" is said of.
    ("A jar stands on the shelf holding two pens.", "jar=A jar; shelf=the shelf; pen 1=two pens; pen 2=two pens",
     "jar on shelf; pen 1 in jar; pen 2 in jar", "jar on shelf; pen 1 on shelf; pen 2 on shelf",
     '"holding two pens" is read as said of "shelf"'),
    ("A cup on the bench with an egg in it.", "cup=A cup; bench=the bench; egg=an egg",
     "cup on bench; egg in cup", "cup on bench; egg on bench", '"egg in it" is read as on "bench"'),
    ("The shelf has a box with a ball in it and a hat.", "shelf=The shelf; box=a box; ball=a ball; hat=a hat",
     "box on shelf; ball in box; hat on shelf", "box on shelf; ball in box; hat in box",
     '"a hat" is read as in "box" too'),
    ("A basket (a pear, a lemon) on a table.", "basket=A basket; pear=a pear; lemon=a lemon; table=a table",
     "basket on table; pear in basket; lemon in basket", "basket on table; pear on table; lemon on table",
     '"(a pear, a lemon)" is read as beside "basket"'),
    # What "it" and "the others" mean.
    ("A box stands behind the bench, and a hat is lying on it.", "box=A box; bench=the bench; hat=a hat",
     "box behind bench; hat on box", "box behind bench; hat on bench", '"it" of "on it" is read as "bench"'),
    ("A cup is on the tray, and a second cup is to the right of it.", "cup 1=A cup; cup 2=a second cup; tray=the tray",
     "cup 1 on tray; cup 2 right_of cup 1; cup 2 on tray", "cup 1 on tray; cup 2 right_of tray",
     '"it" of "to the right of it" is not read as the first "cup"'),
    ("Three jars. One of the jars is behind a hat, the others are behind a box.",
     "jar 1=Three jars; jar 2=Three jars; jar 3=Three jars; hat=a hat; box=a box",
     "jar 1 behind hat; jar 2 behind box; jar 3 behind box",
     "jar 1 behind hat; jar 1 behind box; jar 2 behind box; jar 3 behind box",
     '"others ... behind a box" is read as said of all 3'),
    ("A pot is on the shelf next to two jars, one of which is full.",
     "pot=A pot; shelf=the shelf; jar 1=two jars; jar 2=two jars",
     "pot on shelf; pot next_to jar 1; pot next_to jar 2; jar 1 on shelf; jar 2 on shelf",
     "pot on shelf; pot next_to jar 1; jar 1 on shelf", '"next to two jars" is read as said of 1 of the 2'),
    ("A fork and a spoon, which is behind the jar.", "fork=A fork; spoon=a spoon; jar=the jar",
     "spoon behind jar", "spoon behind jar; fork behind jar", '"behind the jar" is read as said of "fork" too'),
    # Which side something is on.
    ("A plate, fork left.", "plate=A plate; fork=fork", "fork left_of plate", "", 'not modelled: "fork left"'),
]  # fmt: skip


@pytest.mark.parametrize(("prompt", "objects", "true", "wrong", "note"), CASES)
def test_what_a_word_is_taken_for_is_said(prompt: str, objects: str, true: str, wrong: str, note: str):
    assert note in notes(plan(prompt, objects, wrong))
    assert note not in notes(plan(prompt, objects, true))


def test_a_thing_beside_both_is_one():
    jars = "jar 1=Two jars; jar 2=Two jars; shelf=a shelf"
    one = plan("Two jars on a shelf and a hat next to both.", f"{jars}; hat=a hat",
               "jar 1 on shelf; jar 2 on shelf; hat next_to jar 1; hat next_to jar 2; hat on shelf")  # fmt: skip
    assert notes(one) == ()
    two = plan(one.prompt, f"{jars}; hat 1=a hat; hat 2=a hat",
               "jar 1 on shelf; jar 2 on shelf; hat 1 next_to jar 1; hat 2 next_to jar 2")  # fmt: skip
    assert 'counted otherwise: "hat", of which there are 2' in notes(two)


def test_both_are_more_than_one():
    told = plan("Push the fork to the cup, then put both on the tray.", "fork=the fork; cup=the cup; tray=the tray",
                task="place:fork:tray")  # fmt: skip
    assert '"both" is read as "fork" alone' in notes(told)
    both = replace(told, task=chain("place:fork:tray", "place:cup:tray"))
    assert not any('"both"' in note for note in notes(both))


def test_what_is_said_once_of_each_of_several_is_there_for_each():
    prompt = "An egg in a cup on each side of the pot."
    cups = "cup 1=a cup; cup 2=a cup; pot=the pot"
    edges = "egg 1 in cup 1; cup 1 left_of pot; cup 2 right_of pot"
    once = plan(prompt, f"egg 1=An egg; {cups}", edges)
    assert 'counted otherwise: "egg", of which there are 1' in notes(once)
    twice = plan(prompt, f"egg 1=An egg; egg 2=An egg; {cups}", f"{edges}; egg 2 in cup 2")
    assert notes(twice) == ()


def test_what_is_listed_as_one_fruit_for_each_is_there_once():
    prompt = "Two cups each hold one fruit: a lemon and a pear."
    cups = "cup 1=Two cups; cup 2=Two cups"
    told = plan(prompt, f"{cups}; lemon=a lemon; pear=a pear", "lemon in cup 1; pear in cup 2")
    assert notes(told) == ()
    objects = "cup 1=Two cups; cup 2=Two cups; lemon 1=a lemon; lemon 2=a lemon; pear 1=a pear; pear 2=a pear"
    four = plan(prompt, objects, "lemon 1 in cup 1; lemon 2 in cup 2; pear 1 in cup 1; pear 2 in cup 2")
    assert 'counted otherwise: "lemon", of which there are 2' in notes(four)


def turned(name: str) -> ScenePlan:
    told = plan("A pot stands on the bench upside down.", "pot=A pot; bench=the bench", "pot on bench")
    return replace(told, postures=(Posture(object=name, kind="upside_down", said="upside down", arranged=True),))


def test_what_carries_something_is_not_turned_over():
    assert notes(turned("pot")) == ()
    assert notes(turned("bench")) == ('"upside down" is read as said of "bench"',)


def test_one_of_several_that_is_turned_is_one():
    objects = "cup 1=Three cups; cup 2=Three cups; cup 3=Three cups"
    told = plan("Three cups in a stack, the top one upside down.", objects, "cup 2 on cup 1; cup 3 on cup 2",
                turned="cup 1; cup 2; cup 3")  # fmt: skip
    assert 'not as said: "the top one" alone is turned; 3 are' in notes(told)
    assert notes(plan(told.prompt, objects, "cup 2 on cup 1; cup 3 on cup 2", turned="cup 3")) == ()


def test_what_stands_elsewhere_in_a_list_is_in_no_corner():
    prompt = "A pot with a spoon in it, and a jar in the corner of the bench."
    told = plan(prompt, "pot=A pot; spoon=a spoon; jar=a jar; bench=the bench",
                "spoon in pot; pot on bench; jar on bench")  # fmt: skip
    right = Arrangement(kind="in_corner", objects=("jar",), of=("bench",), arranged=True)
    assert notes(replace(told, arrangements=(right,))) == ()
    wrong = replace(right, objects=("pot", "jar"))
    assert notes(replace(told, arrangements=(wrong,))) == ('"in the corner of the bench" is read as said of "pot" too',)


def test_where_a_list_without_a_verb_leaves_something_is_said():
    told = plan("An egg on a plate, and a hat on the table.", "egg=An egg; plate=a plate; hat=a hat; table=the table",
                "egg on plate; hat on table")  # fmt: skip
    assert notes(told) == ('"a plate": where is not said; on the ground',)
    there = plan(told.prompt, "egg=An egg; plate=a plate; hat=a hat; table=the table",
                 "egg on plate; plate on table; hat on table")  # fmt: skip
    assert not any("where is not said" in note for note in notes(there))
