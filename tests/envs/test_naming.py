"""Words of instructions: they mean one object, or there are none."""

from __future__ import annotations

import pytest

from pat3d.assets.shapes import box
from pat3d.envs.tasks.naming import called, spoken
from pat3d.envs.tasks.paraphrase import POLITE, WORDINGS, politely
from pat3d.envs.tasks.registry import TASKS, parse_task
from pat3d.scene.model import Relation, Scene
from tests.scenes import asset_of, placed, scene_of

BLOCK = asset_of(box(0.05, 0.05, 0.05))


def scene(*edges: tuple[str, str, str], others: tuple[str, ...] = ()) -> Scene:
    """Blocks by name; what is carried is one block higher than what carries it."""
    relations = tuple(Relation(child=child, kind=kind, parent=parent) for child, kind, parent in edges)
    carriers = {rel.child: rel.parent for rel in relations if rel.supports}
    names = dict.fromkeys((*others, *(name for child, _, parent in edges for name in (parent, child))))

    def height(name: str) -> int:
        return 1 + height(carriers[name]) if name in carriers else 0

    placed_ones = [placed(name, BLOCK, (0.1 * k, 0, 0.05 * height(name))) for k, name in enumerate(names)]
    return scene_of(*placed_ones, relations=relations)


BOOKS = scene(("book 2", "on", "book 1"), ("book 3", "on", "book 2"), ("red mug", "on", "book 3"))
CUPS = scene(("cup 1", "on", "tray"), ("cup 2", "in", "crate"), ("pen", "in", "cup 3"), others=("cup 3",))


@pytest.mark.parametrize(
    ("here", "name", "words"),
    [
        (BOOKS, "red mug", "red mug"),
        (BOOKS, "book 1", "bottom book"),
        (BOOKS, "book 2", "middle book"),
        (BOOKS, "book 3", "top book"),
        (scene(*[(f"book {k + 1}", "on", f"book {k}") for k in range(1, 5)]), "book 2", "second book from the bottom"),
        (CUPS, "cup 1", "cup on the tray"),
        (CUPS, "cup 2", "cup in the crate"),
        (CUPS, "cup 3", "cup with the pen in it"),
        # Of a mug and a red mug either is a mug.
        (scene(others=("mug", "red mug")), "mug", None),
        (scene(others=("mug", "red mug")), "red mug", "red mug"),
        (scene(others=("cup 1", "cup 2")), "cup 2", None),
        # Both are on the tray.
        (scene(("cup 1", "on", "tray"), ("cup 2", "on", "tray")), "cup 1", None),
        # What would tell it apart is itself one of two.
        (scene(("cup 1", "on", "tray 1"), others=("tray 2", "cup 2")), "cup 1", None),
    ],
)
def test_words_mean_one_object_or_there_are_none(here: Scene, name: str, words: str | None):
    assert called(here, name) == words
    assert spoken(here, name) == words or name


def test_no_words_mean_two_objects():
    for here in (BOOKS, CUPS):
        found = [called(here, obj.name) for obj in here.objects]
        assert len(set(found)) == len(found)


@pytest.mark.parametrize(
    ("here", "task", "instruction"),
    [
        (BOOKS, "pick:red mug", "pick up the red mug from the top book"),
        (BOOKS, "retrieve:book 3", "take out the top book from under the red mug without knocking anything over"),
        (CUPS, "pick:cup 1", "pick up the cup on the tray"),
        (CUPS, "place:pen:tray", "put the pen on the tray"),
        (CUPS, "stack:cup 1:cup 2", "stack the cup on the tray on the cup in the crate"),
        (scene(("cup 1", "on", "tray"), ("cup 2", "on", "tray")), "pick:cup 1", "pick up the cup 1 from the tray"),
    ],
)
def test_instructions_use_them(here: Scene, task: str, instruction: str):
    assert parse_task(task).instruction(here) == instruction


TRAY = scene(("cup 1", "on", "tray"), others=("cup 2", "lid"))


@pytest.mark.parametrize(
    ("task", "named"),
    [
        ("pick:cup 1", ("the cup on the tray",)),
        ("place:lid:tray", ("the lid", "the tray")),
        ("stack:lid:cup 1", ("the lid", "the cup on the tray")),
        ("unload:tray", ("the tray",)),
    ],
)
def test_every_wording_names_the_same_objects_in_other_words(task: str, named: tuple[str, ...]):
    wordings = parse_task(task).wordings(TRAY)
    assert wordings[0] == parse_task(task).instruction(TRAY)
    assert len(set(wordings)) == len(wordings) >= 4
    for text in wordings:
        assert all(text.count(words) >= 1 for words in named), text
        assert "{" not in text


def test_no_wording_of_one_task_is_a_wording_of_another():
    """Of tasks that a scene allows side by side: what is said means one of them."""
    tasks = ["pick:cup 1", "pick:lid", "place:lid:tray", "stack:lid:cup 1", "unload:tray", "retrieve:tray"]
    said = [text for task in tasks for text in parse_task(task).wordings(TRAY)]
    assert len(set(said)) == len(said)


@pytest.mark.parametrize("kind", sorted(WORDINGS))
def test_every_kind_of_task_is_said_in_four_ways_at_least(kind: str):
    assert len(set(WORDINGS[kind])) >= 4
    assert len(set(politely("go"))) == len(POLITE)


def test_every_kind_of_task_has_wordings():
    assert {*WORDINGS, "chain"} == set(TASKS)
