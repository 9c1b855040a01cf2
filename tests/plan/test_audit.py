"""An audit names what a plan has otherwise than its sentence says, whatever made the plan; of a true plan nothing."""

from dataclasses import replace

import pytest

from pat3d.plan.audit.auditor import audited
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import Arrangement, PlannedObject, Posture, ScenePlan
from pat3d.scene.relations import Relation
from tests.plan.vocabulary import Table

TABLE = Table()


def find(name: str) -> str | None:
    known = TABLE.find(name)
    return None if known is None else known.noun


def thing(name: str, phrase: str, *colours: str) -> PlannedObject:
    noun = next(word for word in (name.rstrip(" 0123456789"), name.split()[-1]) if find(word))
    return PlannedObject(name=name, noun=noun, phrase=phrase, colours=colours)


def notes(plan: ScenePlan) -> tuple[str, ...]:
    return audited(plan, find).notes


MUGS = ScenePlan(
    prompt="A red mug and a blue bowl are on a table. Two spoons lie to the left of the mug.",
    objects=(
        thing("red mug", "A red mug", "red"), thing("blue bowl", "a blue bowl", "blue"), thing("table", "a table"),
        thing("spoon 1", "Two spoons"), thing("spoon 2", "Two spoons"),
    ),
    relations=(
        Relation(child="red mug", kind="on", parent="table"), Relation(child="blue bowl", kind="on", parent="table"),
        Relation(child="spoon 1", kind="on", parent="table"), Relation(child="spoon 2", kind="on", parent="table"),
        Relation(child="spoon 1", kind="left_of", parent="red mug"),
        Relation(child="spoon 2", kind="left_of", parent="red mug"),
    ),
)  # fmt: skip
"""A true plan."""


def test_of_a_true_plan_nothing_is_said():
    assert notes(MUGS) == ()


def test_what_is_named_and_not_there_is_said():
    relations = tuple(rel for rel in MUGS.relations if "blue bowl" not in (rel.child, rel.parent))
    lacking = replace(MUGS, objects=(MUGS.objects[0], *MUGS.objects[2:]), relations=relations)
    assert notes(lacking) == ('not in the scene: "bowl"',)


def test_one_too_few_and_one_too_many_are_said():
    few = replace(MUGS, objects=MUGS.objects[:-1], relations=tuple(r for r in MUGS.relations if r.child != "spoon 2"))
    assert notes(few) == ('counted otherwise: "spoons", of which there are 1',)
    third = Relation(child="spoon 3", kind="on", parent="table")
    many = replace(MUGS, objects=(*MUGS.objects, thing("spoon 3", "Two spoons")), relations=(*MUGS.relations, third))
    assert notes(many) == ('counted otherwise: "spoons", of which there are 3',)


def test_colours_of_the_wrong_object_are_said():
    mug, bowl, *others = MUGS.objects
    swapped = (replace(mug, colours=("blue",)), replace(bowl, colours=("red",)))
    plain = (replace(mug, name="mug", colours=()), replace(bowl, name="bowl", colours=()))
    relations = tuple(
        replace(rel, child=rel.child.split()[-1] if "mug" in rel.child or "bowl" in rel.child else rel.child,
                parent=rel.parent.split()[-1]) for rel in MUGS.relations
    )  # fmt: skip
    assert notes(replace(MUGS, objects=(*plain, *others), relations=relations)) == (
        'not as said: "red" of "mug"',
        'not as said: "blue" of "bowl"',
    )
    renamed = (replace(swapped[0], name="mug"), replace(swapped[1], name="bowl"))
    assert len(notes(replace(MUGS, objects=(*renamed, *others), relations=relations))) == 2


@pytest.mark.parametrize(("kind", "said"), [("right_of", True), ("behind", True), ("left_of", False)])
def test_the_wrong_side_is_said(kind, said):
    turned = tuple(replace(rel, kind=kind) if rel.kind == "left_of" else rel for rel in MUGS.relations)
    assert notes(replace(MUGS, relations=turned)) == (('not as said: "to the left of the mug"',) if said else ())


def test_the_same_side_said_of_the_other_object_is_the_same():
    turned = tuple(
        Relation(child=rel.parent, kind="right_of", parent=rel.child) if rel.kind == "left_of" else rel
        for rel in MUGS.relations
    )
    assert notes(replace(MUGS, relations=turned)) == ()


def test_a_note_that_names_it_is_enough_and_one_on_another_word_is_not():
    relations = tuple(rel for rel in MUGS.relations if rel.kind != "left_of")
    told = replace(MUGS, relations=relations, notes=('"Two spoons" left_of "A red mug" is left out: no place.',))
    assert notes(told) == told.notes
    other = replace(MUGS, relations=relations, notes=('not modelled: "old" of "A red mug"',))
    assert notes(other) == (*other.notes, 'not as said: "to the left of the mug"')


def test_words_that_a_plan_does_not_have_are_said():
    prompt = MUGS.prompt.replace("Two spoons", "Two stirring spoons")
    assert notes(replace(MUGS, prompt=prompt)) == ('not heard: "stirring"',)


def test_what_is_between_them_is_not_one_of_them():
    objects = (thing("apple", "An apple"), thing("orange", "an orange"), thing("banana", "a banana"))
    told = ScenePlan(prompt="An apple, an orange and, between them, a banana.", objects=objects)
    right = Arrangement(kind="between", objects=("banana",), of=("apple", "orange"), arranged=True)
    wrong = Arrangement(kind="between", objects=("orange",), of=("apple", "banana"), arranged=True)
    assert notes(replace(told, arrangements=(right,))) == ()
    assert notes(replace(told, arrangements=(wrong,))) == ('not as said: "between them"',)


def test_what_a_relative_clause_says_is_said_of_what_stands_before_it():
    objects = (thing("table", "A table"), thing("radio", "a radio"), thing("vase", "a vase"))
    told = ScenePlan(
        prompt="A table carries a radio, which carries a vase.",
        objects=objects,
        relations=(
            Relation(child="radio", kind="on", parent="table"),
            Relation(child="vase", kind="on", parent="radio"),
        ),
    )
    assert notes(told) == ()
    wrong = replace(told, relations=(told.relations[0], Relation(child="vase", kind="on", parent="table")))
    assert notes(wrong) == ('"carries a vase" is not read as said of "radio"',)


def test_what_is_over_something_upside_down_does_not_stand_on_it():
    objects = (thing("cup", "A cup"), thing("ball", "a ball"))
    told = ScenePlan(
        prompt="A cup sits upside down over a ball.",
        objects=objects,
        relations=(Relation(child="cup", kind="on", parent="ball"),),
        postures=(Posture(object="cup", kind="upside_down", said="upside down", arranged=True),),
    )
    assert notes(told) == ('not as said: "over a ball"',)


@pytest.mark.parametrize(
    ("sentence", "named"),
    [
        ("A kettle is in the suitcase.", "inside"),
        ("Retrieve the knife from the suitcase.", "inside"),
        ("A screwdriver is in a hammer.", "inside"),
        ("Move the water to the tray.", '"the water" is made as'),
        ("A fish and soy sauce are in a pan.", '"soy sauce" is made as'),
        ("A glass half full of water beside a full bottle.", '"half"'),
    ],
)
def test_what_a_person_would_read_otherwise_is_named(sentence: str, named: str):
    assert any(named in note for note in GrammarPlanner().plan(sentence).notes)


def test_a_small_thing_of_which_nothing_says_where_it_is_while_others_are_on_a_table_is_said():
    prompt = "A red mug is on a table, and a pen."
    objects = (thing("red mug", "A red mug", "red"), thing("table", "a table"), thing("pen", "a pen"))
    told = ScenePlan(prompt=prompt, objects=objects, relations=(Relation(child="red mug", kind="on", parent="table"),))
    assert audited(told, find, ("table",)).notes == ('"a pen": "on a table" is not read as said of it; on the ground',)
    carried = replace(told, relations=(*told.relations, Relation(child="pen", kind="on", parent="table")))
    assert audited(carried, find, ("table",)).notes == ()
