"""What stands around a list: "a row of a cup and a jar", "each of two cups on a tray", "has on it", "itself"."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def read(prompt: str) -> tuple[ScenePlan, set[str]]:
    plan = PLANNER.plan(prompt)
    return plan, {str(each) for each in plan.relations if each.supports}


@pytest.mark.parametrize(
    "prompt",
    [
        "A row of a cup, a bowl and a plate on a desk.",
        "On a desk there is a row of a cup, a bowl and a plate.",
        "A desk with a row of a cup, a bowl and a plate on it.",
        "A line of a cup, a bowl, and a plate is on a desk.",
    ],
)
def test_a_row_of_different_things_is_a_row(prompt):
    plan, said = read(prompt)
    assert said == {"cup on desk", "bowl on desk", "plate on desk"}
    assert [(each.kind, each.objects, each.arranged) for each in plan.arrangements] == [
        ("row", ("cup", "bowl", "plate"), True)
    ]


def test_the_names_in_a_row_may_be_words_for_materials():
    plan, _ = read("A row of a glass, a glass bowl and a red wooden box on a desk.")
    assert plan.arrangements[0].objects == ("glass", "glass bowl", "red wooden box")


def test_a_row_of_alike_things_keeps_its_number():
    plan, _ = read("A row of three cups and a plate on a desk.")
    assert plan.arrangements[0].objects == ("cup 1", "cup 2", "cup 3")


@pytest.mark.parametrize("verb", ["are", "stand"])
def test_a_form_ahead_of_its_place_is_heard(verb):
    plan, said = read(f"Side by side on a bench {verb} a white pitcher and a black pen.")
    assert said == {"white pitcher on bench", "black pen on bench"}
    assert [each.kind for each in plan.arrangements] == ["side_by_side"]


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("There is a box holding a cup, and the cup holds a pen.", {"cup in box", "pen in cup"}),
        ("A box holding a red cup and the cup contains a pen.", {"red cup in box", "pen in red cup"}),
        ("There is a table carrying a tray, and the tray carries two mugs.",
         {"tray on table", "mug 1 on tray", "mug 2 on tray"}),
    ],
)  # fmt: skip
def test_what_is_named_again_is_not_in_the_list_once_more(prompt, told):
    plan, said = read(prompt)
    assert said == told
    assert not plan.notes


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("Each of two bowls in a crate holds a plum.",
         {"bowl 1 in crate", "bowl 2 in crate", "plum 1 in bowl 1", "plum 2 in bowl 2"}),
        ("A pen is in each of two cups on a tray.",
         {"cup 1 on tray", "cup 2 on tray", "pen 1 in cup 1", "pen 2 in cup 2"}),
        ("Each of two plates on a desk is red.", {"red plate 1 on desk", "red plate 2 on desk"}),
        ("Each of two cups is on a saucer.", {"cup 1 on saucer 1", "cup 2 on saucer 2"}),
    ],
)  # fmt: skip
def test_what_each_is_told_by_is_there_once(prompt, told):
    plan, said = read(prompt)
    assert said == told
    assert not plan.notes


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("A desk has on it a tray, on which lies an onion, and a peach beside the tray.",
         {"tray on desk", "onion on tray", "peach on desk"}),
        ("A basket has in it two pears.", {"pear 1 in basket", "pear 2 in basket"}),
        ("One mug is in a box on a desk and another is on the desk itself.",
         {"box on desk", "mug 1 in box", "mug 2 on desk"}),
        ("A desk holds not only two mugs but also a jar.", {"mug 1 on desk", "mug 2 on desk", "jar on desk"}),
        ("Not only a mug but a jar is on the shelf.", {"mug on shelf", "jar on shelf"}),
    ],
)  # fmt: skip
def test_what_says_nothing_more_is_left_out(prompt, told):
    _, said = read(prompt)
    assert said == told


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("A ball and a mango are on a dresser and a shelf, respectively.", {"ball on dresser", "mango on shelf"}),
        ("A clock and a ladle are respectively on a desk and a bench.", {"clock on desk", "ladle on bench"}),
        ("Two cups and a plate are in a box and on a tray, respectively.",
         {"cup 1 in box", "cup 2 in box", "plate on tray"}),
        ("A mug, a pen and a fork stand on a table, a desk, and a bench respectively.",
         {"mug on table", "pen on desk", "fork on bench"}),
    ],
)  # fmt: skip
def test_respectively_gives_each_its_place(prompt, told):
    _, said = read(prompt)
    assert said == told


def test_respectively_of_unequal_lists_is_noted():
    plan, _ = read("A cup, a mug and a fork are on a desk and a tray, respectively.")
    assert any("respectively" in note for note in plan.notes)


@pytest.mark.parametrize("rest", ["the remaining ones", "the others"])
def test_the_remaining_ones_are_the_others(rest):
    plan, _ = read(f"On a table there are four mugs, two of which are yellow and {rest} grey.")
    assert sorted(obj.name for obj in plan.objects if obj.noun == "mug") == [
        "gray mug 1", "gray mug 2", "yellow mug 1", "yellow mug 2"]  # fmt: skip


@pytest.mark.parametrize("size", ["larger", "smaller"])
def test_the_other_of_two_holds_what_is_said_of_it(size):
    _, said = read(f"The {size} of two baskets holds a croissant and the other holds a screwdriver.")
    assert said == {f"croissant in {size} basket", "screwdriver in basket"}


@pytest.mark.parametrize(
    ("prompt", "kind", "count"),
    [
        ("Two forks are on a table, one at each end.", "at_ends", 2),
        ("Two red lamps stand on top of a table, one at either end of it.", "at_ends", 2),
        ("Two forks are on a table, at opposite ends.", "at_ends", 2),
        ("A cup and a jar are on a table, one at each end.", "at_ends", 2),
        ("Four books sit atop a table, one in each corner.", "in_corners", 4),
        ("Four candles on a table, one in every corner.", "in_corners", 4),
        ("A coin stands on top of a table, in a corner.", "in_corner", 1),
        ("A coin lies on a table, at the edge.", "at_edge", 1),
    ],
)
def test_a_place_behind_a_comma_is_of_what_carries(prompt, kind, count):
    plan, said = read(prompt)
    assert len(said) == count == len(plan.objects) - 1
    assert [(each.kind, len(each.objects), each.of) for each in plan.arrangements] == [(kind, count, ("table",))]


@pytest.mark.parametrize(
    ("prompt", "counts"),
    [
        ("Two balls and as many hammers as balls are on a towel.", {"ball": 2, "hammer": 2}),
        ("There are three cups on a towel and as many forks as cups.", {"cup": 3, "fork": 3}),
        ("As many forks as cups, namely three, are on a towel.", {"cup": 3, "fork": 3}),
    ],
)
def test_as_many_as_what_is_counted_are_as_many(prompt, counts):
    plan, _ = read(prompt)
    nouns = [obj.noun for obj in plan.objects]
    assert {noun: nouns.count(noun) for noun in counts} == counts
    assert len(nouns) == sum(counts.values()) + 1


@pytest.mark.parametrize(
    ("prompt", "names"),
    [
        ("Three lemons and a red and a blue mug.", ["blue mug", "lemon 1", "lemon 2", "lemon 3", "red mug"]),
        ("4 pens, 2 lemons and a green and a red cube.",
         ["green cube", "lemon 1", "lemon 2", "pen 1", "pen 2", "pen 3", "pen 4", "red cube"]),
        ("Three mugs, a red, a green and a blue one.", ["blue mug", "green mug", "red mug"]),
    ],
)  # fmt: skip
def test_a_noun_that_is_left_out_is_that_of_what_is_described_alike(prompt, names):
    plan, _ = read(prompt)
    assert sorted(obj.name for obj in plan.objects) == names
