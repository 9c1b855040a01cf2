"""Descriptions as people write them: what fills a vessel, what is on top, what is only smelled, what a table has."""

import pytest

from pat3d.assets.catalogue import make
from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell

PLANNER = GrammarPlanner()


def _related(prompt: str) -> set[str]:
    return {str(relation) for relation in PLANNER.plan(prompt).relations}


def _named(prompt: str) -> list[str]:
    return [obj.name for obj in PLANNER.plan(prompt).objects]


@pytest.mark.parametrize(
    ("prompt", "vessel", "fillings"),
    [
        ("A cutting board that has a bowl of plums and figs on it.", "bowl", "plum fig"),
        ("There is a tray with a cup of pens and rulers on it.", "cup", "pen ruler"),
        ("A tray with a jar of nuts and bolts and a wrench on it.", "jar", "nut bolt"),
        ("A bench has a box of nails and screws on the left.", "box", "nail screw"),
        ("A kitchen table with a basket of lemons and limes in the middle.", "basket", "lemon lime"),
    ],
)
def test_what_fills_a_vessel_too_is_in_it(prompt, vessel, fillings):
    filled = {f"{each} {n} in {vessel}" for each in fillings.split() for n in (1, 2, 3)}
    assert {each for each in _related(prompt) if f" in {vessel}" in each} == filled


def test_what_has_its_own_article_fills_no_vessel():
    prompt = "A tray with a bowl of plums and a spoon on it."
    assert _related(prompt) == {"bowl on tray", "spoon on tray", *(f"plum {n} in bowl" for n in (1, 2, 3))}


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A box underneath the desk, a laptop on top.", {"laptop on desk"}),
        ("A crate under the table and a scale on top.", {"scale on table"}),
        ("Under the bench is a bucket and on top a drill.", {"drill on bench"}),
        ("A rug under the table and a vase on top.", {"table on rug", "vase on table"}),
        ("On the tray is a plate and on top a bun.", {"plate on tray", "bun on plate"}),
        ("A dresser stands in the corner, on top a lamp.", {"lamp on dresser"}),
        ("A box on the shelf, on top a book and a cup.", {"box on shelf", "book on box", "cup on box"}),
        ("A crate on the floor and a lamp on top.", {"lamp on crate"}),
        ("A crate stands under the table, and a scale on top of it.", {"scale on crate"}),
        ("A book on the table, another on top of it, a mug on top of that.",
         {"book 1 on table", "book 2 on book 1", "mug on book 2"}),
        ("A crate is on the pallet. Another is on top of it.", {"crate 1 on pallet", "crate 2 on crate 1"}),
        ("A wrench in the box, another on it.", {"wrench 1 in box", "wrench 2 on box"}),
    ],
)  # fmt: skip
def test_on_top_is_on_what_is_spoken_of(prompt, relations):
    assert _related(prompt) == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("The tray holds a teapot. Its lid lies beside it, and the sugar bowl is on the other side.",
         {"teapot on tray", "lid on tray", "lid left_of teapot", "sugar bowl on tray", "sugar bowl right_of teapot"}),
        ("The shelf carries a pot and a pan. The lid of the pot lies beside it.",
         {"pot on shelf", "pan on shelf", "lid on shelf", "lid next_to pot"}),
        ("On the tray stands a jar, its lid next to it.", {"jar on tray", "lid on tray", "lid next_to jar"}),
        ("A bench carries a drill. Its battery lies to the left of it.",
         {"drill on bench", "battery on bench", "battery left_of drill"}),
        ("A lamp is next to the sofa and a plant is on the other side.", {"lamp left_of sofa", "plant right_of sofa"}),
    ],
)  # fmt: skip
def test_a_lid_lies_by_what_it_closes(prompt, relations):
    assert _related(prompt) == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A wall clock, a lamp and a book on the table.", {"lamp on table", "book on table"}),
        ("A plate and a wall mirror are on the desk.", {"plate on desk"}),
        ("A wall clock on the table.", {"wall clock on table"}),
    ],
)
def test_what_belongs_on_a_wall_is_on_no_table(prompt, relations):
    assert _related(prompt) == relations


@pytest.mark.parametrize(
    ("prompt", "laid"),
    [
        ("A dining table, six chairs, a runner and two candlesticks.", "runner, candlestick 1, candlestick 2"),
        ("A table, two stools, a tablecloth, a teapot and a floor lamp.", "tablecloth, teapot"),
        ("A coffee table, a sofa and a centerpiece.", "centerpiece"),
        ("A table, four chairs, four plates.", ""),
    ],
)
def test_what_a_table_is_laid_with_is_on_it(prompt, laid):
    plan = PLANNER.plan(prompt)
    assert {rel.child for rel in plan.relations if rel.kind == "on"} == {*filter(None, laid.split(", "))}
    assert any(note.startswith("assumed: ") for note in plan.notes) == bool(laid)


@pytest.mark.parametrize(
    "prompt",
    ["5 screws, 5 nuts, 1 wrench. Tray.", "Cutting board. Three apples, a knife.", "A mug, a plate; one table."],
)
def test_what_a_vessel_by_itself_is_for_is_named(prompt):
    notes = [note for note in PLANNER.plan(prompt).notes if note.endswith("where is not said; on the ground")]
    assert len(notes) == prompt.count(",") + 1
    assert not PLANNER.plan("A tray. A cup is on it.").notes


@pytest.mark.parametrize(
    ("prompt", "named", "note"),
    [
        ("A workbench with a vise. The garage smells like oil, rubber and cardboard.", "workbench, vise",
         "The garage smells like oil, rubber and cardboard"),
        ("The sounds of a piano and a violin fill a room with a sofa and a lamp.", "sofa, lamp", "The sounds of"),
        ("A bowl on a table that tastes like tomatoes and figs.", "bowl, table", "that tastes like tomatoes and figs"),
        ("A soft blanket on a chair feels like a pillow.", "blanket, chair", "feels like a pillow"),
        ("The smell of bread hangs over a table with two plates.", "table, plate 1, plate 2", "The smell of bread"),
        ("A cake on a plate that tastes of lemon, and a fork beside it.", "cake, plate, fork", "that tastes of lemon"),
        ("With the aroma of cookies in the air, a cup stands on the table.", "cup, table", "the aroma of cookies"),
    ],
)  # fmt: skip
def test_what_is_only_sensed_is_no_thing(prompt, named, note):
    assert sorted(_named(prompt)) == sorted(named.split(", "))
    assert any(note in each for each in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Two mugs next to a plate and a spoon.",
         {f"mug {n} next_to {each}" for n in (1, 2) for each in ("plate", "spoon")}),
        ("Two forks beside two plates.", {"fork 1 next_to plate 1", "fork 2 next_to plate 2"}),
        ("Lamps on the left and the right table.",
         {"lamp 1 on table 1", "lamp 2 on table 2", "lamp 3 on table 1", "lamp 4 on table 2",
          "table 2 right_of table 1"}),
        ("A lamp on the left and the right table.",
         {"lamp 1 on table 1", "lamp 2 on table 2", "table 2 right_of table 1"}),
        ("A plant near the left and the right chair.",
         {"plant next_to chair 1", "plant next_to chair 2", "chair 2 right_of chair 1"}),
        ("A stove with a kettle on the left burner and a pan on the right one.", {"kettle on stove", "pan on stove"}),
        ("A stove with a pan on the left burner and a pot on the one behind it.",
         {"pan on stove", "pot on stove", "pot behind pan"}),
        ("A sofa with a cat on the left cushion and a book on the right one.",
         {"cat on cushion 1", "book on cushion 2", "cushion 2 right_of cushion 1"}),
    ],
)  # fmt: skip
def test_several_stand_by_several_as_a_person_reads_it(prompt, relations):
    assert _related(prompt) == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A bowl holds an egg; two are on the table.", {"egg 1 in bowl", "egg 2 on table", "egg 3 on table"}),
        ("A basket contains an apple, two are on the table.",
         {"apple 1 in basket", "apple 2 on table", "apple 3 on table"}),
        ("The tray has a cup on it and two are on the shelf.", {"cup 1 on tray", "cup 2 on shelf", "cup 3 on shelf"}),
        ("A pan contains an egg. One is on the plate.", {"egg 1 in pan", "egg 2 on plate"}),
        ("A cup is on a tray and two are on the shelf.", {"cup 1 on tray", "cup 2 on shelf", "cup 3 on shelf"}),
        ("A table holds a lamp, and another holds a vase.", {"lamp on table 1", "vase on table 2"}),
    ],
)  # fmt: skip
def test_more_are_of_what_was_held(prompt, relations):
    assert _related(prompt) == relations


def test_another_has_no_colour_where_two_are_told():
    named = _named("A red box is on the floor. A blue one is beside it. Another is on top of it.")
    assert sorted(named) == ["blue box", "box", "red box"]


@pytest.mark.parametrize(
    ("prompt", "named"),
    [
        ("A friendly and cozy kitchen with a table and two chairs, 8k.", "table, chair 1, chair 2"),
        ("A sleek but rustic lamp on a desk, unreal engine.", "lamp, desk"),
        ("Watercolor of a teapot and two cups.", "teapot, cup 1, cup 2"),
        ("A small café with a table and a chair.", "table, chair"),
        ("Toys everywhere on the floor.", "ball, block, rubber duck"),
        ("A desk with craft supplies: scissors and a pen.", "desk, scissors, pen"),
        ("A stand with a laptop.", "laptop stand, laptop"),
        ("A holder with three pens.", "pen holder, pen 1, pen 2, pen 3"),
        ("A vise with a nut in its jaws.", "vise, nut"),
        ("Like at a usual breakfast: a bowl, a spoon and a glass.", "bowl, spoon, glass"),
        ("Lay two places at the table.", "plate 1, plate 2, fork 1, fork 2, knife 1, knife 2, table"),
        ("An HDMI connector and a soldering station on the bench.", "hdmi connector, soldering station, bench"),
        ("Carrot peelings on a cutting board.", "cutting board"),
    ],
)
def test_ordinary_words_are_not_refused(prompt, named):
    assert sorted(_named(prompt)) == sorted(named.split(", "))


@pytest.mark.parametrize(
    ("prompt", "red"),
    [
        ("Six cups in a row, every second one is red.", 3),
        ("Nine cups stand in a row; every third one is red.", 3),
        ("Four cups in a row, the outer two cups are red.", 2),
    ],
)
def test_every_second_one_and_the_outer_two_are_some_of_them(prompt, red):
    assert [obj.colours for obj in PLANNER.plan(prompt).objects].count(("red",)) == red


def test_a_holder_of_which_nothing_tells_the_kind_is_refused():
    with pytest.raises(PromptError, match="Say which kind"):
        PLANNER.plan("A lamp on a stand.")


def test_the_others_that_stay_are_named_in_a_note():
    plan = PLANNER.plan("Four cups and a plate. Move the plate to the tray, the others stay.")
    assert plan.task == "place:plate:tray"
    assert 'not modelled: "the others stay"' in plan.notes


@pytest.mark.parametrize(
    "prompt",
    [
        "A bookcase with three shelves: the top one holds a globe, the middle one six books, the bottom one a box.",
        "A bookcase with three shelves: the top one with a globe, the middle one with six books, the bottom one with a "
        "box.",
    ],
)
def test_shelves_told_one_by_one_are_of_the_bookcase(prompt):
    plan = PLANNER.plan(prompt)
    assert not plan.notes
    assert "The bookcase has three shelves." in tell(plan)
    assert {each.kind for each in plan.arrangements} >= {"on_top_tier", "on_middle_tier", "on_bottom_tier"}


@pytest.mark.parametrize(
    ("sentence", "young"),
    [
        ("A kitten on a rug and a cat beside the rug.", {"kitten": True, "cat": False}),
        ("Two puppies in a basket.", {"puppy 1": True, "puppy 2": True, "basket": False}),
        ("A dog next to a puppy.", {"dog": False, "puppy": True}),
    ],
)
def test_young_animals_are_made_smaller(sentence, young):
    objects = PLANNER.plan(sentence).objects
    assert {obj.name: "young" in obj.adjectives for obj in objects if obj.name in young} == young
    for noun in {obj.noun for obj in objects if young.get(obj.name)}:
        assert make(noun, adjectives=("young",)).size.max() < 0.85 * make(noun).size.max()
