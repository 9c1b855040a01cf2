"""Some of what a thing holds, told by their number alone: of what it holds, and never more such things."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "holder", "colours"),
    [
        ("A crate holds four cans; three are red.", "crate", {"red": 3}),
        ("A crate holds four cans. Three are red and one is blue.", "crate", {"red": 3, "blue": 1}),
        ("A wardrobe holds five socks, two are red and three are blue.", "wardrobe", {"red": 2, "blue": 3}),
        ("A tray has four mugs on it; two are green and two are white.", "tray", {"green": 2, "white": 2}),
        ("A bowl with six eggs: four are white, two are brown.", "bowl", {"white": 4, "brown": 2}),
        ("A shelf carries three jars; two are green and the other is white.", "shelf", {"green": 2, "white": 1}),
    ],
)
def test_a_number_alone_is_of_what_was_counted(sentence: str, holder: str, colours: dict[str, int]):
    plan = PLANNER.plan(sentence)
    assert sum(obj.name.startswith(holder) for obj in plan.objects) == 1
    for colour, count in colours.items():
        assert sum(colour in obj.colours for obj in plan.objects) == count
    assert plan.notes == ()


def test_a_number_alone_is_of_further_ones_where_nothing_was_counted():
    plan = PLANNER.plan("One jar is on a shelf. Two are below it.")
    assert sum(obj.noun == "jar" for obj in plan.objects) == 3


@pytest.mark.parametrize(
    ("sentence", "beside"),
    [("A chair with a lamp.", True), ("A sofa with a lamp.", True), ("A desk with a lamp.", False)],
)
def test_a_lamp_that_a_seat_is_with_stands_beside_it(sentence: str, beside: bool):
    kinds = {rel.kind for rel in PLANNER.plan(sentence).relations}
    assert kinds == ({"next_to"} if beside else {"on"})


def test_what_is_under_a_desk_on_the_left_is_not_beside_it():
    plan = PLANNER.plan("A bin is under the desk on the left.")
    assert [str(rel) for rel in plan.relations] == []
    assert any("left" in note for note in plan.notes)
