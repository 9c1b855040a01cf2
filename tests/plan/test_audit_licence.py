"""Every relation of a plan is given by a word of its sentence; what points back has something to point to."""

import pytest

from pat3d.plan.scene_plan import Arrangement
from tests.plan.test_audit_places import notes, plan

STOOLS = {"chair 1": "A chair", "chair 2": "A chair", "table": "the table", "hat": "a hat"}


def test_a_support_that_no_word_gives_is_said():
    phrases = {"hat": "A hat", "cap": "a cap", "box": "a box"}
    right = plan("A hat and a cap, which lies on a box.", phrases, "cap on box")
    wrong = plan("A hat and a cap, which lies on a box.", phrases, "cap on box", "hat on box")
    assert 'assumed: "A hat" on "a box"' in notes(wrong)
    assert not any("assumed" in note for note in notes(right))


@pytest.mark.parametrize(
    ("prompt", "edges"),
    [
        ("A bowl of cookies on the edge of a table.", ("cookie in bowl", "bowl on table")),
        ("A bowl with a cookie, a jar and a cup on a table.", ("cookie in bowl", "bowl on table", "jar on table")),
        ("Table: bowl, jar, cookie.", ("bowl on table", "jar on table", "cookie on table")),
        ("A jar is on a table. Beside it is a bowl of cookies.", ("jar on table", "cookie in bowl", "bowl on table")),
    ],
)
def test_what_the_words_give_is_left_alone(prompt, edges):
    phrases = {"cookie": "cookies", "bowl": "A bowl", "jar": "a jar", "cup": "a cup", "table": "a table"}
    named = {name: said for name, said in phrases.items() if name in prompt.lower()}
    edges = (*edges, "jar next_to bowl") if "Beside" in prompt else edges
    assert not any("assumed" in note for note in notes(plan(prompt, named, *edges)))


def test_one_of_them_is_none_of_what_there_is_one_of():
    prompt = "A chair stands on either side of the table, one of them holding a hat."
    sides = ("chair 1 left_of table", "chair 2 right_of table")
    assert any("is not read as said of" in note for note in notes(plan(prompt, STOOLS, *sides, "hat on table")))
    assert not any("hat" in note for note in notes(plan(prompt, STOOLS, *sides, "hat on chair 1")))


def test_both_are_all_of_them():
    prompt = "Two mugs, both holding a spoon."
    phrases = {"mug 1": "Two mugs", "mug 2": "Two mugs", "spoon 1": "a spoon", "spoon 2": "a spoon"}
    one = plan(prompt, {**phrases}, "spoon 1 in mug 1", "spoon 2 in mug 1")
    assert any('"holding a spoon" is not read as said of all "mugs"' in note for note in notes(one))
    assert notes(plan(prompt, phrases, "spoon 1 in mug 1", "spoon 2 in mug 2")) == ()


def test_the_former_is_the_one_named_first():
    prompt = "A jar and a box are on a shelf; the former holds a spoon."
    phrases = {"jar": "A jar", "box": "a box", "shelf": "a shelf", "spoon": "a spoon"}
    placed = ("jar on shelf", "box on shelf")
    assert any("spoon" in note for note in notes(plan(prompt, phrases, *placed, "spoon in box")))
    assert notes(plan(prompt, phrases, *placed, "spoon in jar")) == ()


def test_the_other_needs_two():
    prompt = "Next to one bed is a lamp, next to the other a plant."
    phrases = {"bed 1": "one bed", "lamp": "a lamp", "plant": "a plant"}
    lone = notes(plan(prompt, phrases, "lamp next_to bed 1", "plant next_to bed 1"))
    assert 'not as said: "the other"; there is one "bed"' in lone
    two = plan(prompt, {**phrases, "bed 2": "the other"}, "lamp next_to bed 1", "plant next_to bed 2")
    assert not any("the other" in note for note in notes(two))


def test_what_something_is_with_is_at_that():
    phrases = {"tray": "A tray", "bowl": "a bowl", "lemon": "a lemon", "cup": "a cup"}
    prompt = "A tray has a cup and a bowl with a lemon."
    placed = ("cup on tray", "bowl on tray")
    assert 'not as said: "with a lemon"' in notes(plan(prompt, phrases, *placed, "lemon on tray"))
    assert notes(plan(prompt, phrases, *placed, "lemon in bowl")) == ()


def test_what_is_on_the_floor_is_on_nothing():
    phrases = {"dog": "A dog", "sofa": "a sofa", "ball": "a ball"}
    prompt = "A dog is on a sofa, a ball on the floor in front of it."
    assert any(
        '"on the floor" of "ball"' in note for note in notes(plan(prompt, phrases, "dog on sofa", "ball on sofa"))
    )
    assert not any('of "ball"' in note for note in notes(plan(prompt, phrases, "dog on sofa")))


@pytest.mark.parametrize(("order", "said"), [(("dog", "bird", "rabbit"), False), (("bird", "dog", "rabbit"), True)])
def test_the_middle_of_a_row_is_its_middle(order, said):
    phrases = {"dog": "A dog", "bird": "a bird", "rabbit": "a rabbit"}
    row = Arrangement(kind="row", objects=order, arranged=True)
    told = plan("A dog, a rabbit and a bird in a row, the bird in the middle.", phrases, arrangements=(row,))
    assert any('"in the middle" of "bird"' in note for note in notes(told)) is said


def test_numbers_of_others_excuse_none():
    prompt = "Mugs and spoons, three of each, on a shelf."
    phrases = {**{f"mug {n}": "Mugs" for n in (1, 2, 3)}, **{f"spoon {n}": "spoons" for n in (1, 2, 3)}}
    shelves = {f"shelf {n}": "a shelf" for n in (1, 2)}
    edges = [f"{name} on shelf 1" for name in phrases]
    assert 'counted otherwise: "shelf", of which there are 2' in notes(plan(prompt, {**phrases, **shelves}, *edges))
    one = plan(prompt, {**phrases, "shelf 1": "a shelf"}, *edges)
    assert notes(one) == ()


def test_a_colour_that_both_have_is_of_two():
    phrases = {"lamp 1": "The lamp", "lamp 2": "one", "bed": "the bed"}
    told = plan("The lamp on the bed and one beside it are both red.", phrases, "lamp 1 on bed")
    assert any("red" in note for note in notes(told))


def test_a_note_on_an_object_excuses_no_claim_on_it():
    phrases = {"spoon": "A spoon", "shelf": "a shelf"}
    told = plan("A spoon lies left of a shelf.", phrases, "spoon on shelf")
    assumed = type(told)(prompt=told.prompt, objects=told.objects, relations=told.relations,
                         notes=('"a shelf": wooden planks are fine.',))  # fmt: skip
    assert 'not as said: "left of a shelf"' in notes(assumed)
