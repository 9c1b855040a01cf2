"""What descriptions say later on of things that were named: sizes, one of several, what is below them."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _notes(plan: ScenePlan) -> list[str]:
    return [note for note in plan.notes if "worded like nothing" not in note]


def _relations(plan: ScenePlan) -> set[str]:
    return {str(relation) for relation in plan.relations}


@pytest.mark.parametrize(
    ("prompt", "scales"),
    [
        ("a pot and a colander; the pot is big", {"big pot": 1.3, "colander": 1.0}),
        ("A jar and a vase. They are small.", {"small jar": 0.75, "small vase": 0.75}),
        ("A lemon lies beside a cup. It is tiny.", {"tiny lemon": 0.5, "cup": 1.0}),
        ("a tray with two cups, the cups are large", {"tray": 1.0, "large cup 1": 1.3, "large cup 2": 1.3}),
    ],
)
def test_a_size_told_of_a_thing_is_its_size(prompt: str, scales: dict[str, float]):
    plan = PLANNER.plan(prompt)
    assert {obj.name: obj.scale for obj in plan.objects} == scales
    assert plan.task is None
    assert _notes(plan) == []


def test_what_is_smaller_is_made_smaller_than_the_other():
    scale = {obj.noun: obj.scale for obj in PLANNER.plan("a teapot and a wok. the wok is smaller").objects}
    assert scale["wok"] < 0.75
    assert scale["teapot"] == 1.0


def test_what_would_be_absurdly_large_is_noted():
    plan = PLANNER.plan("There are a bed and a mug. The mug is larger.")
    assert _notes(plan) == ['not modelled: "larger" of "a mug", than "a bed"']


@pytest.mark.parametrize("prompt", ["a jug and a pan, the pan is green", "a jug and a pan, and the pan is green"])
def test_a_colour_told_of_one_of_a_list_is_of_that_alone(prompt: str):
    plan = PLANNER.plan(prompt)
    assert {obj.noun: obj.colours for obj in plan.objects} == {"pitcher": (), "pan": ("green",)}
    assert _notes(plan) == []


@pytest.mark.parametrize(
    ("prompt", "objects"),
    [
        ("A clock stands between two table lamps. One lamp is green.", {"clock", "green table lamp", "table lamp"}),
        ("Two floor lamps stand behind a bench. One lamp is blue, the other is red.",
         {"blue floor lamp", "red floor lamp", "bench"}),
        ("Four soup bowls are on a tray. One bowl is yellow.",
         {"yellow soup bowl", "soup bowl 1", "soup bowl 2", "soup bowl 3", "tray"}),
    ],
)  # fmt: skip
def test_one_of_several_may_be_called_by_the_last_word_of_their_name(prompt: str, objects: set[str]):
    assert {obj.name for obj in PLANNER.plan(prompt).objects} == objects


def test_what_stands_on_each_side_carries_its_own():
    plan = PLANNER.plan("A sofa, a side table with a plant on each side of the sofa, and a rug. One table holds a cup.")
    assert {"plant 1 on side table 1", "plant 2 on side table 2", "side table 1 left_of sofa",
            "side table 2 right_of sofa"} <= _relations(plan)  # fmt: skip


@pytest.mark.parametrize(
    ("prompt", "tables", "note"),
    [
        ("A room with a bench, a dining table and a rug. On a dining table in front of the bench stands a jug.", 1,
         '"a dining table" (word 15) is read as the one named before.'),
        ("A jug stands on a table. A fig lies on a table.", 2, '"a table" (word 12) is read as one more.'),
    ],
)  # fmt: skip
def test_furniture_named_again_is_what_carries_nothing_yet(prompt: str, tables: int, note: str):
    plan = PLANNER.plan(prompt)
    assert sum("table" in obj.noun for obj in plan.objects) == tables
    assert note in plan.notes


@pytest.mark.parametrize(
    "prompt",
    ["Steel rack, upper level with three boxes, lower level with a bucket.", "Bookcase: top shelf with a globe.",
     "A cart, upper tier with plants and lower tier with pots."],
)  # fmt: skip
def test_a_bare_level_is_of_the_furniture_before_it(prompt: str):
    plan = PLANNER.plan(prompt)
    first = plan.objects[0].name
    assert all(f"{obj.name} on {first}" in _relations(plan) for obj in plan.objects[1:])
    assert {one.kind for one in plan.arrangements} <= {"on_top_tier", "on_bottom_tier"}
    assert plan.arrangements


@pytest.mark.parametrize(
    ("prompt", "colours", "note"),
    [
        ("a green jug and bowl", {"pitcher": ("green",), "bowl": ("green",)}, ""),
        ("a blue hat and scarf", {"hat": ("blue",), "scarf": ("blue",)}, ""),
        ("a red stapler and clock", {"stapler": ("red",), "clock": ("red",)},
         '"red" of "a red stapler" is read as said of "clock" too.'),
        ("a yellow towel and comb", {"towel": ("yellow",), "comb": ()},
         '"yellow" of "a yellow towel" is not read as said of "comb" too.'),
    ],
)  # fmt: skip
def test_the_colour_of_the_first_of_two_is_shared_where_they_go_together(
    prompt: str, colours: dict[str, tuple[str, ...]], note: str
):
    plan = PLANNER.plan(prompt)
    assert {obj.noun: obj.colours for obj in plan.objects} == colours
    assert _notes(plan) == ([note] if note else [])


@pytest.mark.parametrize(
    "prompt",
    ["a bread knife", "a bread basket", "a paper clip", "a paper shredder", "a cream jug", "two bread boards"],
)
def test_a_noun_in_a_name_is_no_colour_and_no_material(prompt: str):
    obj = PLANNER.plan(prompt).objects[0]
    assert obj.colours == ()
    assert obj.material is None


@pytest.mark.parametrize("prompt", ["a glass jar", "a wooden spoon", "a paper cup", "a plastic knife"])
def test_what_a_thing_is_made_of_is_kept(prompt: str):
    obj = PLANNER.plan(prompt).objects[0]
    assert obj.colours or obj.material


@pytest.mark.parametrize(
    "prompt",
    ["Eight stools around a table, three on each side and one at each end.",
     "A table with six stools, two on each long side and one at either end."],
)  # fmt: skip
def test_shares_at_the_sides_are_no_further_ones(prompt: str):
    plan = PLANNER.plan(prompt)
    assert sum(obj.noun == "stool" for obj in plan.objects) == int("Eight" in prompt) * 2 + 6
    assert any("on each" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A radio, a hat and a camera on a tripod.", {"camera on tripod"}),
        ("A bench holds a bag, a globe and a mug on a coaster.",
         {"bag on bench", "globe on bench", "coaster on bench", "mug on coaster"}),
    ],
)  # fmt: skip
def test_of_a_list_the_last_alone_is_on_what_carries_one(prompt: str, relations: set[str]):
    assert _relations(PLANNER.plan(prompt)) == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A penguin sits on a tree; underneath it sits a dog.", {"penguin on tree", "dog next_to tree"}),
        ("An owl sits on a branch. Below it stands a rabbit.", {"owl on branch", "rabbit next_to branch"}),
    ],
)
def test_what_is_below_it_is_below_the_tree_a_bird_sits_on(prompt: str, relations: set[str]):
    plan = PLANNER.plan(prompt)
    assert _relations(plan) == relations
    assert any(note.startswith("not arranged:") and "under" in note for note in plan.notes)


@pytest.mark.parametrize("these", ["those", "these"])
def test_what_stands_behind_those_is_a_thing_of_its_own(these: str):
    plan = PLANNER.plan(f"Two big crates stand side by side, and on {these} the small one.")
    assert "small crate on big crate 1" in _relations(plan)
    assert sum(obj.noun == "crate" for obj in plan.objects) == 3


@pytest.mark.parametrize(
    "prompt",
    ["A radio stands on a desk. Its cord lies beside it.", "a fan on a shelf, its cable on the floor"],
)
def test_a_part_made_as_a_thing_is_noted(prompt: str):
    plan = PLANNER.plan(prompt)
    assert any(note.startswith('"its c') and "thing of its own" in note.lower() for note in map(str.lower, plan.notes))
