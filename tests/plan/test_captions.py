"""How captions say things: neat rows, rooms with things in them, lists without commas, what there is more of."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _nouns(plan: ScenePlan) -> list[str]:
    return sorted(obj.noun for obj in plan.objects)


def _edges(plan: ScenePlan) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


def _relations(plan: ScenePlan) -> list[str]:
    return sorted(map(str, plan.relations))


@pytest.mark.parametrize(
    ("sentence", "looks"),
    [
        ("A huge, white, heart-shaped table stands next to a bed.", {"huge", "white"}),
        ("A short, furry dog sits next to a plant.", {"short", "furry"}),
        ("A green, oblong dish and a plate are on a tray.", {"green"}),
        ("Large, green, plastic bins stand beside a bench.", {"green", "plastic"}),
        ("A large, flat, grey, rectangular tray is on a table.", {"large", "gray"}),
    ],
)
def test_modifiers_between_commas_describe_one_head(sentence, looks):
    plan = PLANNER.plan(sentence)
    first = plan.objects[0]
    said = {*first.adjectives, *first.phrase.lower().replace(",", "").replace("grey", "gray").split(), first.material}
    assert looks <= said
    assert not any("not understood" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "colours"),
    [
        ("A white, wooden chair stands on a blue, woollen rug.", {"chair": ("white",), "rug": ("blue",)}),
        ("A big, red apple, a small, green pear and a plate.", {"apple": ("red",), "pear": ("green",), "plate": None}),
        ("A mug, red, small pen and a plate.", {"mug": None, "pen": ("red",), "plate": None}),
    ],
)
def test_each_head_keeps_its_own_colour(sentence, colours):
    plan = PLANNER.plan(sentence)
    made = {obj.noun: obj.colours or None for obj in plan.objects}
    assert {noun: made[noun] for noun in colours} == colours


def test_colours_in_a_list_are_still_of_one_thing_each():
    plan = PLANNER.plan("Red, blue, white cups on a table.")
    assert [obj.colours for obj in plan.objects if obj.noun == "cup"] == [("red",), ("blue",), ("white",)]


@pytest.mark.parametrize(
    "sentence",
    [
        "Three toasters are arranged in a neat row on the counter.",
        "Three bottles stand in a tidy line on a shelf.",
        "On the desk there are three cups in a straight row.",
    ],
)
def test_a_neat_row_is_a_row(sentence):
    plan = PLANNER.plan(sentence)
    assert [(one.kind, len(one.objects)) for one in plan.arrangements] == [("row", 3)]


@pytest.mark.parametrize(
    ("sentence", "counts"),
    [
        ("There are more plates than cups in the kitchen.", {"plate": 4, "cup": 3}),
        ("There are more bottles on the shelf than cans.", {"bottle": 4, "can": 3}),
        ("There are fewer red mugs than blue mugs on the tray.", {("red",): 3, ("blue",): 4}),
        ("The tray holds more spoons than forks, and a plate is next to it.", {"spoon": 4, "fork": 3, "plate": 1}),
    ],
)
def test_there_are_more_of_what_outnumbers_the_other(sentence, counts):
    plan = PLANNER.plan(sentence)
    for kind, count in counts.items():
        assert sum(kind in (obj.noun, obj.colours) for obj in plan.objects) == count
    assert sum("assumed." in note for note in plan.notes) >= 2


def test_two_more_than_others_are_counted_from_what_is_assumed_of_these():
    plan = PLANNER.plan("There are two more plates than cups on the table.")
    assert sorted(obj.noun for obj in plan.objects) == ["cup"] * 3 + ["plate"] * 5 + ["table"]
    assert any("cups" in note and "3 assumed" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("a pillow a bed a table and two books", ["bed", "book", "book", "pillow", "table"]),
        ("A mug a plate and a fork.", ["fork", "mug", "plate"]),
        ("a red mug two white plates three forks", ["fork"] * 3 + ["mug"] + ["plate"] * 2),
    ],
)
def test_a_list_without_commas_is_a_list(sentence, nouns):
    assert _nouns(PLANNER.plan(sentence)) == nouns


@pytest.mark.parametrize(
    ("sentence", "relations"),
    [
        ("A living room that has a couch, two tables, and a rug in it.", []),
        ("An office has a desk, a chair and a bed inside it.", []),
        ("A kitchen with a bowl that has an apple in it.", ["apple in bowl"]),
        ("A playroom with a basket with two balls in it.", ["ball 1 in basket", "ball 2 in basket"]),
        ("A box with a pen and a key in it.", ["key in box", "pen in box"]),
    ],
)
def test_what_is_in_a_room_is_in_nothing_else(sentence, relations):
    assert _relations(PLANNER.plan(sentence)) == relations


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("A vase missing red flowers.", ["vase"]),
        ("A shelf lacking books next to a bed.", ["bed", "shelf"]),
        ("A pot lacks a lid.", ["pot"]),
    ],
)
def test_what_is_missing_is_not_there(sentence, nouns):
    assert _nouns(PLANNER.plan(sentence)) == nouns


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("A table creating a cozy mood, and two chairs.", ["chair", "chair", "table"]),
        ("A vase on a shelf, contrasting the wall, and two bowls.", ["bowl", "bowl", "shelf", "vase"]),
        ("A lamp casts a shadow on the wall, and a mug is on the table.", ["lamp", "mug", "table"]),
        ("A lamp on a desk, casting a warm glow and a soft shadow.", ["desk", "lamp"]),
    ],
)
def test_what_is_named_behind_a_remark_on_light_or_mood_is_there(sentence, nouns):
    assert _nouns(PLANNER.plan(sentence)) == nouns


@pytest.mark.parametrize(
    "sentence",
    [
        "Two clocks on a nightstand, each with a remote next to it, allowing the user to adjust the time.",
        "A clock next to a painting.",
        "A chair in front of a table is positioned closer to the observer.",
        "A hotel suite with a glass desk, a sofa, and a bed.",
        "Three apples on a table in a room with sunlight streaming in through the windows.",
    ],
)
def test_captions_are_not_refused_for_their_surroundings(sentence):
    assert PLANNER.plan(sentence).objects


@pytest.mark.parametrize(
    ("sentence", "relation"),
    [
        ("A cup of tea sits on a wooden table, steam rising from the mug's rim.", ("tea cup", "on", "wooden table")),
        ("A mug filled with tea sits on a tray, steam rising from the cup's rim.", ("mug", "on", "tray")),
    ],
)
def test_a_part_of_what_has_another_name_makes_no_second_thing(sentence, relation):
    plan = PLANNER.plan(sentence)
    assert len(plan.objects) == 2
    assert relation in _edges(plan)
    assert any("steam rising" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "relation"),
    [
        ("A plant is next to a wall and a bench.", ("plant", "next_to", "bench")),
        ("A vase in front of a window and a mirror.", ("vase", "in_front_of", "mirror")),
        ("A chair stands beside a bed and the wall.", ("chair", "next_to", "bed")),
        ("A chair next to the wall and a table with a lamp.", ("chair", "next_to", "table")),
    ],
)
def test_what_is_beside_a_wall_and_a_thing_is_beside_the_thing(sentence, relation):
    assert relation in _edges(PLANNER.plan(sentence))


def test_what_is_placed_itself_is_no_landmark_beside_the_wall():
    """The rug on the floor of "a lamp in front of a window and a rug on the floor" is another thing there."""
    plan = PLANNER.plan("A lamp in front of a window and a rug on the floor.")
    assert not {rel for rel in plan.relations if not rel.supports}


@pytest.mark.parametrize(
    ("sentence", "relations"),
    [
        ("Two mugs each with a spoon on a tray.", "mug 1 on tray, mug 2 on tray, spoon 1 in mug 1, spoon 2 in mug 2"),
        ("Two plates each holding a cupcake sit on a counter.",
         "cupcake 1 on plate 1, cupcake 2 on plate 2, plate 1 on counter, plate 2 on counter"),
        ("Two bowls, each on a coaster, on a tray.",
         "bowl 1 on coaster 1, bowl 2 on coaster 2, coaster 1 on tray, coaster 2 on tray"),
        ("Two trays each hold a cup on a saucer.",
         "cup 1 on saucer 1, cup 2 on saucer 2, saucer 1 on tray 1, saucer 2 on tray 2"),
        ("Two mugs, each with a spoon in it, each on a tray.",
         "mug 1 on tray 1, mug 2 on tray 2, spoon 1 in mug 1, spoon 2 in mug 2"),
    ],
)  # fmt: skip
def test_what_all_stand_on_is_there_once(sentence, relations):
    """The tray of "two mugs each with a spoon on a tray" carries both mugs; a coaster each is on the tray too."""
    assert _relations(PLANNER.plan(sentence)) == sorted(relations.split(", "))


@pytest.mark.parametrize(
    "sentence", ["Two cups on a table next to three plates.", "Two lamps on a desk next to five books."]
)
def test_all_of_several_neighbours_are_on_the_table(sentence):
    """Of three plates beside two cups on a table the third is no plate on the ground."""
    plan = PLANNER.plan(sentence)
    carried = {rel.child for rel in plan.relations if rel.kind == "on"}
    assert len(carried) == len(plan.objects) - 1


@pytest.mark.parametrize(
    ("sentence", "noun"),
    [
        ("Two pens in a holder and a lamp on a desk.", "pen holder"),
        ("A toothbrush in a holder on a counter.", "toothbrush holder"),
        ("The candle in the silver holder is red.", "candle holder"),
        ("Two ladles in a steel holder on a bench.", "utensil holder"),
        ("A whisk and a fork are in the holder.", "utensil holder"),
        ("Utensils in a holder next to a kettle.", "utensil holder"),
    ],
)
def test_a_holder_is_named_by_what_is_in_it(sentence, noun):
    assert PLANNER._nouns.resolve(noun) in _nouns(PLANNER.plan(sentence))


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("A three drawer dresser stands next to a bed.", ["bed", "dresser"]),
        ("A two person table with a vase.", ["table", "vase"]),
        ("A 4 door cabinet and a two seat sofa.", ["cabinet", "sofa"]),
        ("A four slice toaster on a counter.", ["counter", "toaster"]),
        ("A four large cups.", ["cup"] * 4),
    ],
)
def test_a_number_of_parts_is_no_number_of_things(sentence, nouns):
    """Of "a three drawer dresser" there is one, and no note says that it is counted otherwise."""
    plan = PLANNER.plan(sentence)
    assert _nouns(plan) == nouns
    assert not any("counted otherwise" in note for note in plan.notes)


@pytest.mark.parametrize(
    "sentence",
    [
        "The image shows a bench with a trophy on it.",
        "The picture depicts a bench, on which there is a trophy.",
        "A photo showing a trophy placed on a bench.",
        "An image depicting a trophy on a bench.",
        "The scene shows a bench. A trophy is visible on the bench.",
        "This photo shows a trophy sitting on a bench.",
    ],
)
def test_what_a_picture_shows_is_all_there_is(sentence: str):
    plan = PLANNER.plan(sentence)
    assert (_nouns(plan), _relations(plan)) == (["bench", "trophy"], ["trophy on bench"])
    assert plan.notes == ()


def test_a_picture_that_is_a_thing_is_one():
    assert "picture" in " ".join(obj.phrase for obj in PLANNER.plan("A picture leans against a bench.").objects).lower()


@pytest.mark.parametrize("place", ["directly behind", "just behind", "right behind", "immediately behind"])
def test_a_place_said_precisely_is_that_place(place: str):
    plan = PLANNER.plan(f"A trophy is on a bench. {place.capitalize()} the trophy, two cans can be seen.")
    assert {"can 1 behind trophy", "can 2 behind trophy", "can 1 on bench"} <= {*_relations(plan)}
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("sentence", "relation"),
    [
        ("There is a bench with a trophy on it. To its left stands a mug.", "mug left_of trophy"),
        ("The image shows a bench with a trophy on it. Two pens lie to its right.", "pen 1 right_of trophy"),
        ("A bench holds a trophy. A mug stands to its left.", "mug left_of trophy"),
        ("There is a bench with a trophy on it. To its left stands a chair.", "chair left_of bench"),
        ("A trophy is on a bench. A mug stands to its left.", "mug left_of trophy"),
    ],
)
def test_to_its_left_is_of_what_the_thing_can_stand_beside(sentence: str, relation: str):
    assert relation in _relations(PLANNER.plan(sentence))


@pytest.mark.parametrize(
    "told",
    ["Both are pink.", "They are pink.", "They are both pink.", "Both of them are pink.", "All of them are pink."],
)
@pytest.mark.parametrize("scene", ["A bench holds a pen and a comb.", "There is a bench with a pen and a comb on it."])
def test_both_are_what_is_there_and_not_what_it_is_on(scene: str, told: str):
    plan = PLANNER.plan(f"{scene} {told}")
    assert sorted(obj.name for obj in plan.objects) == ["bench", "pink comb", "pink pen"]
    assert plan.notes == ()


def test_both_of_two_clauses_are_their_subjects():
    plan = PLANNER.plan("A table is next to a chair. Both are pink.")
    assert sorted(obj.name for obj in plan.objects) == ["pink chair", "pink table"]
