"""What stands on what, asked of a model: which pairs, how they are shown, and how the answers make a tree."""

import base64
import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from pat3d.assets.shapes import box
from pat3d.errors import ModelError
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import Body
from pat3d.plan.llm.chat import Chat
from pat3d.plan.llm.settings import ModelSettings
from pat3d.scene.model import GROUND, Relation, parent_of
from pat3d.vision.dependencies import ChatJudge, close_pairs, joined
from pat3d.vision.observation import Observation
from tests.plan.llm_server import said, serving
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

TABLE = asset_of(box(1.0, 0.6, 0.4), noun="table")
BOOK = asset_of(box(0.3, 0.2, 0.05), noun="book")
CUP = asset_of(box(0.08, 0.08, 0.1), noun="cup")
THINGS = {
    "table": (TABLE, Pose.from_yaw(0.0, (0.0, 0.0, 0.0))),
    "book": (BOOK, Pose.from_yaw(0.3, (0.1, 0.0, 0.4))),
    "cup": (CUP, Pose.from_yaw(0.0, (0.1, 0.0, 0.45))),
    "far": (CUP, Pose.from_yaw(0.0, (0.9, 0.0, 0.0))),
}


def on(child, parent, kind="on"):
    return Relation(child=child, kind=kind, parent=parent)


def test_pairs_are_those_of_which_one_is_over_the_other_and_begins_where_it_ends():
    bodies = {
        name: Body(name, asset).at(pose.rotation, np.array(pose.position)) for name, (asset, pose) in THINGS.items()
    }
    assert set(close_pairs(bodies)) == {("cup", "book"), ("book", "table"), ("cup", "table")}
    bodies["cup"] = bodies["cup"].shifted(np.array([0.0, 0.0, 0.3]))
    assert close_pairs(bodies) == [("book", "table")]


def test_a_pair_is_shown_in_two_colours_and_its_answer_becomes_a_relation(tmp_path, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    drawn = see(THINGS, camera_at((0.8, -1.6, 1.4), (0.0, 0.0, 0.3)))
    grey = np.full((*drawn.depth.shape, 3), 100, dtype=np.uint8)
    seen = Observation(
        camera=drawn.camera, depth=drawn.depth, instances=drawn.instances, names=drawn.names, picture=grey
    )
    pairs = [("cup", "book"), ("cup", "table"), ("book", "table")]
    answers = [{"number": 2, "answer": "none"}, {"number": 1, "answer": "first_on_second"}]
    wrong = said({"pairs": answers})
    right = said({"pairs": [*answers, {"number": 3, "answer": "second_in_first"}]})
    with serving(wrong, right) as server:
        settings = ModelSettings(name="eyes", base_url=server.url, retries=0)
        found = ChatJudge(Chat(settings, cache_dir=tmp_path)).judge(seen, pairs)
    assert found == {
        ("cup", "book"): on("cup", "book"),
        ("cup", "table"): None,
        ("book", "table"): on("table", "book", "in"),
    }
    assert "every pair from 1 to 3 once" in server.requests[1]["messages"][-1]["content"]
    parts = server.requests[0]["messages"][1]["content"]
    assert next(part["text"] for part in parts if part["type"] == "text") == 'Pair 1: first "cup", second "book".'
    crop = np.array(Image.open(io.BytesIO(base64.b64decode(parts[2]["image_url"]["url"].partition(",")[2]))))
    red, blue = (crop[..., k].astype(int) - crop[..., 2 - k] > 60 for k in (0, 2))
    # The cup stands on the book, so its middle is higher in the picture.
    assert red.any()
    assert np.nonzero(red)[0].mean() < np.nonzero(blue)[0].mean()
    assert np.count_nonzero(red) < np.count_nonzero(blue)


def test_a_server_that_answers_nothing_valid_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    drawn = see(THINGS, camera_at((0.8, -1.6, 1.4), (0.0, 0.0, 0.3)))
    seen = Observation(
        camera=drawn.camera, depth=drawn.depth, instances=drawn.instances, names=drawn.names,
        picture=np.zeros((*drawn.depth.shape, 3), dtype=np.uint8),
    )  # fmt: skip
    bad = [said({"pairs": [{"number": 1, "answer": "beside"}]})] * 3
    with serving(*bad) as server:
        judge = ChatJudge(Chat(ModelSettings(name="eyes", base_url=server.url, retries=0), cache_dir=tmp_path))
        with pytest.raises(ModelError, match="no valid answer"):
            judge.judge(seen, [("cup", "book")])


def test_the_model_counts_before_the_surfaces_and_differences_are_noted():
    measured = (on("cup", "table"), on("book", "table"))
    tree, notes = joined(measured, {("cup", "book"): on("cup", "book"), ("cup", "table"): None})
    assert set(tree) == {on("cup", "book"), on("book", "table")}
    assert notes == ['the model says "cup on book", the surfaces "cup on table".']
    assert joined(measured, {}) == (measured, [])
    # Of two that are said to carry one object, the one that the surfaces know.
    both = {("cup", "book"): on("cup", "book"), ("cup", "table"): on("cup", "table")}
    assert set(joined(measured, both)[0]) == set(measured)
    # What the model denies, and nothing else carries, stands on the ground.
    assert joined(measured, {("book", "table"): None})[0] == (on("cup", "table"),)


NAMES = ["a", "b", "c", "d"]
PAIRS = st.permutations(NAMES).map(lambda order: tuple(order[:2]))


@given(st.dictionaries(PAIRS, st.sampled_from(["on", "in", "reversed", None]), max_size=8), st.permutations(NAMES))
def test_whatever_is_answered_the_result_is_a_tree(answers, order):
    """No circle, at most one carrier each, and everything ends on the ground."""
    measured = tuple(on(child, parent) for parent, child in zip(order, order[1:], strict=False))
    judged = {
        (first, second): None if kind is None else on(second, first) if kind == "reversed" else on(first, second, kind)
        for (first, second), kind in answers.items()
    }
    tree, _ = joined(measured, judged)
    assert len({rel.child for rel in tree}) == len(tree)
    for name in NAMES:
        steps = 0
        while name != GROUND:
            name, steps = parent_of(name, tree), steps + 1
            assert steps <= len(NAMES)
