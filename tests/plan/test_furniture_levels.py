"""What is on one of the levels of a piece of furniture is on that tier of it, or a note names the level."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


def carried(plan: ScenePlan) -> set[tuple[str, str]]:
    return {(rel.child, rel.parent) for rel in plan.relations if rel.supports}


@pytest.mark.parametrize(
    ("prompt", "owner", "things"),
    [
        ("A shelf has two levels. On the lower level are a toy car and a dinosaur. The upper level holds a vase.",
         "shelf", {"toy car", "dinosaur", "vase"}),
        ("A shelf with three tiers. The top tier holds a mug. On the middle tier is a bowl. The last tier holds a can.",
         "shelf", {"mug", "bowl", "can"}),
        ("A bookshelf has three shelves. The top shelf holds a globe. The bottom shelf holds a vase.",
         "bookshelf", {"globe", "vase"}),
        ("The top shelf of the bookshelf holds a globe, the bottom one a vase.", "bookshelf", {"globe", "vase"}),
        ("A tall cart. Its top shelf carries a drill; the shelf below has a toolbox.", "cart", {"drill", "toolbox"}),
        ("A shelf with two rows: the upper holds a globe, the lower holds a vase.", "shelf", {"globe", "vase"}),
        ("A cart with two tiers, the upper holding a drill, the lower a bucket.", "cart", {"drill", "bucket"}),
        ("A shelf with two rows: a mug in the upper row, a can in the lower row.", "shelf", {"mug", "can"}),
        ("A cart with two shelves: the upper one holds a microscope and the lower one holds a bucket.",
         "cart", {"microscope", "bucket"}),
        ("On a cart with two shelves, the upper one holds a microscope and the lower one holds a bucket.",
         "cart", {"microscope", "bucket"}),
        ("A toy shelf made of wood has two levels. The upper level holds a vase.", "shelf", {"vase"}),
        ("The bookshelf next to the desk has two shelves. The upper one holds a cup.", "bookshelf", {"cup"}),
        ("A shelf that has two levels, with a cup on the upper level and a can on the lower one.",
         "shelf", {"cup", "can"}),
    ],
)  # fmt: skip
def test_a_level_is_its_furniture(planner: GrammarPlanner, prompt: str, owner: str, things: set[str]) -> None:
    plan = planner.plan(prompt)
    names = {obj.noun: obj.name for obj in plan.objects}
    assert {(names[thing], names[owner]) for thing in things} == carried(plan)
    told = {name: one.kind for one in plan.arrangements if one.of == (names[owner],) for name in one.objects}
    missing = {names[thing] for thing in things} - set(told)
    # "The last tier", "the shelf below" are not told by their height.
    assert not missing or any("has no parts of its own" in note or '"lower"' in note for note in plan.notes)
    assert set(told.values()) <= {"on_top_tier", "on_middle_tier", "on_bottom_tier"}
    assert told


@pytest.mark.parametrize(
    ("prompt", "count"),
    [
        ("There are two shelves. The top shelf holds a cup and the bottom shelf holds a can.", 2),
        ("The first shelf holds a cup, the second shelf holds a can.", 2),
    ],
)
def test_shelves_that_stand_alone_stay_so(planner: GrammarPlanner, prompt: str, count: int) -> None:
    assert sum(obj.noun == "shelf" for obj in planner.plan(prompt).objects) == count


def test_the_lowest_of_a_stack_on_a_shelf_is_no_level(planner: GrammarPlanner) -> None:
    plan = planner.plan("A shelf stands next to a desk. On the desk is a stack of books, and the bottom one is red.")
    lowest = next(obj for obj in plan.objects if obj.noun == "book" and obj.colours == ("red",))
    assert (lowest.name, "desk") in carried(plan)


def test_a_spirit_level_is_a_thing(planner: GrammarPlanner) -> None:
    plan = planner.plan("A wooden level lies on the shelf.")
    assert {obj.noun for obj in plan.objects} == {"spirit level", "shelf"}


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("A mug on the top shelf and a book on the bottom shelf.",
         {("on_top_tier", ("mug",), "shelf"), ("on_bottom_tier", ("book",), "shelf")}),
        ("The fridge's top shelf holds milk.", {("on_top_tier", ("milk",), "fridge")}),
        ("Two bowls are on the second shelf of the bookcase.", {("on_second_tier", ("bowl 1", "bowl 2"), "bookcase")}),
        ("A coffee table with a vase on the lower shelf.", {("on_bottom_tier", ("vase",), "coffee table")}),
        ("On the top shelf of a bookshelf three books are stacked.", {("on_top_tier", ("book 1",), "bookshelf")}),
        # There is no middle of two, and no third.
        ("A bowl on the middle shelf of the cabinet.", set()),
        ("A vase on the third shelf of the coffee table.", set()),
        ("A shelf with a cup in one corner and a jar in another.", set()),
    ],
)  # fmt: skip
def test_which_tier_is_told(planner: GrammarPlanner, prompt: str, told: set):
    plan = planner.plan(prompt)
    tiers = {(one.kind, one.objects, one.of[0]) for one in plan.arrangements if one.kind.endswith("_tier")}
    assert tiers == told
    assert not any("not modelled" in note for note in plan.notes) or not told


@pytest.mark.parametrize("count", ["two", "three", "5"])
def test_a_shelf_is_made_with_the_boards_that_are_counted(planner: GrammarPlanner, count: str):
    plan = planner.plan(f"A bookcase with {count} shelves.")
    assert plan.objects[0].adjectives == ({"two": "2-tier", "three": "3-tier", "5": "5-tier"}[count],)
    assert plan.notes == ()
