"""Long sentences as people write them: lists behind what carries them, landmarks named again in few words."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


def edges(plan: ScenePlan) -> set[str]:
    nouns = {obj.name: obj.noun for obj in plan.objects}
    return {f"{nouns[rel.child]} {rel.kind} {nouns[rel.parent]}" for rel in plan.relations}


def nouns(plan: ScenePlan) -> list[str]:
    return sorted(obj.noun for obj in plan.objects)


@pytest.mark.parametrize(
    ("prompt", "wanted"),
    [
        ("There is a desk on which a laptop, a mug full of pens and a camera are arranged.",
         {"laptop on desk", "mug on desk", "camera on desk", "pen in mug"}),
        ("A table on which a basket, a thermos and a watermelon have been spread out.",
         {"basket on table", "thermos on table", "watermelon on table"}),
        ("There is a desk on which a laptop, a mug and a camera stand.",
         {"laptop on desk", "mug on desk", "camera on desk"}),
        ("A tray in which two apples and a pear lie is on a table.",
         {"apple on tray", "pear on tray", "tray on table"}),
        ("A wooden table, on which a basket and a thermos sit, stands on a rug.",
         {"basket on table", "thermos on table", "table on rug"}),
    ],
)  # fmt: skip
def test_all_of_a_list_stand_on_what_carries_it(planner: GrammarPlanner, prompt: str, wanted: set[str]) -> None:
    assert wanted == edges(planner.plan(prompt))


@pytest.mark.parametrize(
    ("prompt", "wanted"),
    [
        ("On the board, place a lemon, a lime and a knife.",
         {"lemon on cutting board", "lime on cutting board", "knife on cutting board"}),
        ("Put a board on the table. Then, on the board, put a lemon and a knife.",
         {"cutting board on table", "lemon on cutting board", "knife on cutting board"}),
        ("There is a tray. On it place a lemon and a mug.", {"lemon on tray", "mug on tray"}),
        ("Next to the bowl, put two mugs.", {"mug next_to bowl"}),
        ("Behind the bowl, set a mug and a cup.", {"mug behind bowl", "cup behind bowl"}),
    ],
)  # fmt: skip
def test_a_place_before_its_verb_is_where_things_are_put(
    planner: GrammarPlanner, prompt: str, wanted: set[str]
) -> None:
    assert wanted == edges(planner.plan(prompt))


def test_a_place_before_its_verb_is_the_goal_of_what_is_known(planner: GrammarPlanner) -> None:
    assert planner.plan("On the tray, place the lemon.").task == "place:lemon:tray"
    assert planner.plan("In the red bowl, put the lemon and then open the box.").task == "place:lemon:red bowl"
    assert planner.plan("Next put the mug on the plate.").task == "place:mug:plate"


def test_a_later_one_of_a_list_that_is_elsewhere_is_noted(planner: GrammarPlanner) -> None:
    notes = planner.plan("A tray contains four bolts and two stools.").notes
    assert '"stools" is not read as in "tray" like "bolts"' in notes
    assert planner.plan("A tray contains four bolts and two nuts.").notes == ()
    notes = planner.plan("The box contains a mug and a fan stands on it.").notes
    assert not any("fan" in note for note in notes)


def test_the_last_word_of_a_name_names_the_thing_again(planner: GrammarPlanner) -> None:
    plan = planner.plan("A blue yoga mat lies on the floor, with two dumbbells in front of the mat.")
    assert nouns(plan) == ["dumbbell", "dumbbell", "yoga mat"]
    assert edges(plan) == {"dumbbell in_front_of yoga mat"}
    plan = planner.plan("A backpack and a yoga mat stand in a row, with two dumbbells in front of the mat.")
    assert nouns(plan) == ["backpack", "dumbbell", "dumbbell", "yoga mat"]


def test_what_is_on_it_is_on_the_plate_in_the_middle_of_a_table(planner: GrammarPlanner) -> None:
    plan = planner.plan("A plate at the centre of the table with a burger on it.")
    assert edges(plan) == {"plate on table", "burger on plate"}
    plan = planner.plan("A vase in the middle of a table with a cup on it.")
    assert edges(plan) == {"vase on table", "cup on table"}


def test_what_is_named_again_with_its_place_is_the_same(planner: GrammarPlanner) -> None:
    plan = planner.plan("A plate with a burger on it, and a fork to the right of the burger on the same plate.")
    assert nouns(plan) == ["burger", "fork", "plate"]


def test_two_places_of_a_surface_in_one_sentence_do_not_crash(planner: GrammarPlanner) -> None:
    plan = planner.plan("A steel sink is on the left and a dish rack on the right of the counter.")
    assert nouns(plan) == ["counter", "dish rack", "sink"]


@pytest.mark.parametrize(
    ("prompt", "wanted"),
    [
        ("A desk where a monitor stands in the middle and a keyboard lies in front of it.",
         {"monitor on desk", "keyboard on desk", "keyboard in_front_of monitor"}),
        ("There is a wooden table where two plates stand next to a vase.",
         {"plate on table", "vase on table", "plate next_to vase"}),
        ("The image is taken from above and shows a white plate and a fork to the left of the plate.",
         {"fork left_of plate"}),
        ("The photo depicts a cup on a saucer.", {"cup on saucer"}),
        ("Take a look at the tray: it has a bowl and a plate.", {"bowl on tray", "plate on tray"}),
        ("The box should contain an egg.", {"egg in storage box"}),
        ("The left jar should contain two strawberries, the right jar a lime.",
         {"strawberry in jar", "lime in jar", "jar right_of jar"}),
        ("The red cube is the one next to the bowl.", {"cube next_to bowl"}),
        ("A cake is on a cake stand. In front of the stand lie a knife and a fork.",
         {"cake on cake stand", "knife in_front_of cake stand", "fork in_front_of cake stand"}),
    ],
)  # fmt: skip
def test_what_stands_around_a_scene_hides_nothing_of_it(planner: GrammarPlanner, prompt: str, wanted: set[str]) -> None:
    assert wanted == edges(planner.plan(prompt))


def test_where_something_stands_may_tell_only_which_desk_is_meant(planner: GrammarPlanner) -> None:
    plan = planner.plan("The desk where the lamp stands is brown.")
    assert all(obj.noun == "desk" for obj in plan.objects if obj.colours)


def test_the_one_in_the_middle_is_in_the_row(planner: GrammarPlanner) -> None:
    plan = planner.plan(
        "A green mug, a brown mug and a black mug are in a row. The brown mug is the one in the middle."
    )
    assert len(plan.objects) == 3
    assert [each.objects for each in plan.arrangements] == [("green mug", "brown mug", "black mug")]


def test_who_holds_something_is_no_vessel(planner: GrammarPlanner) -> None:
    assert planner.plan("The robot should hold the cup.").task == "pick:cup"


@pytest.mark.parametrize(
    ("prompt", "wanted"),
    [
        ("A lamp glows behind the clock.", {"lamp behind clock"}),
        ("A candle burns between two mugs.", {"mug left_of candle", "mug right_of candle"}),
        ("A book lies on a desk, and a vase towers on the right.",
         {"book on desk", "vase on desk", "vase right_of book"}),
        ("A green desk lamp towers over the book.", {"desk lamp next_to book"}),
        ("A basket overflows with two baguettes.", {"baguette in basket"}),
        ("A bottle stands on the table, its green glass catching the light.", {"bottle on table"}),
        ("A pot is on the stove, its lid lying next to it.", {"pot on stove", "lid on stove", "lid next_to pot"}),
        ("The wooden tray on the left holds two cans and the one on the right, which is made of metal, holds a cup.",
         {"can on tray", "cup on tray", "tray left_of tray"}),
        ("A vase, which is made of glass, stands on a table.", {"vase on table"}),
        ("Two block towers stand on the table.", {"jenga tower on table"}),
    ],
)  # fmt: skip
def test_how_things_look_where_they_stand_changes_nothing(
    planner: GrammarPlanner, prompt: str, wanted: set[str]
) -> None:
    assert wanted == edges(planner.plan(prompt))


def test_what_matches_is_like_a_thing_of_its_sort(planner: GrammarPlanner) -> None:
    plan = planner.plan("A white teapot sits in the middle of a bamboo tray, and four matching teacups surround it.")
    assert {obj.colours for obj in plan.objects if obj.noun == "teacup"} == {("white",)}
    assert {obj.material for obj in plan.objects if obj.noun == "teacup"} == {None}
    plan = planner.plan("A red sofa and two matching armchairs.")
    assert {obj.colours for obj in plan.objects} == {("red",)}


def test_stacks_at_the_ends_stay_stacks(planner: GrammarPlanner) -> None:
    plan = planner.plan("Two stacks of three books stand at either end of a bench.")
    assert nouns(plan) == ["bench"] + 6 * ["book"]


@pytest.mark.parametrize(
    ("prompt", "noun", "count"),
    [
        ("On the table are two cups, a red cup and a blue cup.", "cup", 2),
        ("Two cups, a red cup and a blue cup, are on a tray.", "cup", 2),
        (
            "There are three jars, a red jar on the left, a blue jar in the middle and a green jar on the right.",
            "jar",
            3,
        ),
        ("Two wooden boxes, a large box and a small box, stand on a bench.", "box", 2),
        ("Two cups, a red cup and a can are on the tray.", "cup", 3),
    ],
)
def test_what_is_counted_and_then_told_one_by_one_is_there_once(
    planner: GrammarPlanner, prompt: str, noun: str, count: int
) -> None:
    plan = planner.plan(prompt)
    assert nouns(plan).count(noun) == count
    assert not any("counted otherwise" in note for note in plan.notes)


def test_the_one_on_the_right_is_of_the_kind_of_what_is_on_the_left(planner: GrammarPlanner) -> None:
    plan = planner.plan("The wooden tray on the left holds two cans and the one on the right holds a cup.")
    assert {"can on tray", "cup on tray"} <= edges(plan)
    assert nouns(plan) == ["can", "can", "cup", "tray", "tray"]


def test_what_is_at_the_side_of_something_is_next_to_it(planner: GrammarPlanner) -> None:
    assert edges(planner.plan("A plate with a fork at its side.")) == {"fork next_to plate"}
