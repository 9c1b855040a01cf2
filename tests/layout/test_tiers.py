"""Boards of shelves and compartments of what opens in front: where things are put, and when that holds."""

from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets import catalogue
from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_arranged, check_relations
from pat3d.layout.tiers import meant, tiers
from pat3d.plan.grammar.words.lexicon import HOUSES, TIERS
from pat3d.scene.arrangements import Arrangement
from pat3d.scene.relations import Relation

TOUCH = 5e-3
"""The layout leaves gaps of 2 mm."""


def laid(carrier: str, kinds: dict[str, str], *, relation: str = "on", seed: int = 0, things: str = "mug"):
    """A carrier with a thing on every tier of `kinds`, by its name: assets, relations, arrangements, layout."""
    assets = {"carrier": catalogue.make(carrier, seed=seed)}
    assets |= {name: catalogue.make(things, seed=seed) for name in kinds}
    relations = tuple(Relation(child=name, kind=relation, parent="carrier") for name in kinds)  # type: ignore[arg-type]
    told = tuple(Arrangement(kind=kind, objects=(name,), of=("carrier",)) for name, kind in kinds.items())  # type: ignore[arg-type]
    return assets, relations, told, arrange(assets, relations, arrangements=told, seed=seed)


@pytest.mark.parametrize(("noun", "count"), sorted(TIERS.items()))
def test_the_reader_knows_how_many_tiers_there_are(noun: str, count: int):
    made = HOUSES.get(noun, noun)
    heights = [region.floor[2] for region in tiers(catalogue.make(made, seed=0))]
    assert len(heights) == count
    assert heights == sorted(heights)


def test_the_lid_of_a_bookcase_is_no_tier_and_the_top_board_of_a_rack_is_one():
    case, rack = catalogue.make("bookshelf", seed=0), catalogue.make("shelf", seed=0)
    assert tiers(case)[-1].floor[2] < 0.8 * case.size[2]
    assert tiers(rack)[-1].floor[2] == pytest.approx(rack.size[2])
    assert tiers(catalogue.make("table", seed=0)) == ()


@pytest.mark.parametrize("count", [2, 3, 5, 6])
@pytest.mark.parametrize("noun", ["bookshelf", "shelf"])
def test_shelves_have_as_many_tiers_as_they_are_asked_for(noun: str, count: int):
    assert len(tiers(catalogue.make(noun, adjectives=[f"{count}-tier"], seed=1))) == count


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("carrier", "relation"), [("bookshelf", "on"), ("shelf", "on"), ("open wardrobe", "in")])
def test_things_are_on_the_tiers_that_are_said(carrier: str, relation: str, seed: int):
    kinds = {"a": "on_top_tier", "b": "on_second_tier", "c": "on_third_tier", "d": "on_bottom_tier"}
    assets, relations, told, layout = laid(carrier, kinds, relation=relation, seed=seed)
    results = [*check_relations(relations, assets, layout.poses, touch=TOUCH),
               *check_arranged(told, (), assets, layout.poses, touch=TOUCH)]  # fmt: skip
    assert [result.detail for result in results if not result.holds] == []
    heights = [layout.poses[name].position[2] for name in kinds]
    assert heights == sorted(heights, reverse=True)


def test_what_is_on_another_tier_is_found_out():
    assets, _, told, layout = laid("bookshelf", {"a": "on_top_tier", "b": "on_bottom_tier"})
    poses = dict(layout.poses)
    poses["a"], poses["b"] = (replace(poses[one], position=poses[other].position) for one, other in ("ab", "ba"))
    results = check_arranged(told, (), assets, poses, touch=TOUCH)
    assert [(result.holds, result.detail) for result in results] == [
        (False, "on tier 1 of 4 from below"), (False, "on tier 4 of 4 from below"),
    ]  # fmt: skip


def test_of_what_lies_on_its_back_no_tier_is_told():
    assets, _, told, layout = laid("bookshelf", {"a": "on_top_tier"})
    poses = {
        **layout.poses,
        "carrier": Pose(position=(0.0, 0.0, 0.0), quat_wxyz=(np.sqrt(0.5), -np.sqrt(0.5), 0.0, 0.0)),
    }
    assert check_arranged(told, (), assets, poses, touch=TOUCH)[0].detail == "its carrier does not stand upright"


@pytest.mark.parametrize(
    ("carrier", "kind", "things", "message"),
    [
        ("table", "on_top_tier", "mug", '"a" cannot be on the top shelf of "carrier", which has no shelves'),
        ("cart", "on_third_tier", "mug", '"a" cannot be on the third shelf of "carrier", which has 2 shelves'),
        ("bookshelf", "on_bottom_tier", "floor lamp", "finds no room on \"the bottom shelf of carrier\""),
    ],
)  # fmt: skip
def test_what_cannot_be_on_a_tier_is_refused(carrier: str, kind: str, things: str, message: str):
    with pytest.raises(LayoutError, match=message):
        laid(carrier, {"a": kind}, things=things)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("carrier", sorted(HOUSES.values()))
def test_what_is_in_something_that_opens_in_front_is_inside(carrier: str, seed: int):
    assets = {"carrier": catalogue.make(carrier, seed=seed), "cup": catalogue.make("cup", seed=seed),
              "apple": catalogue.make("apple", seed=seed), "plate": catalogue.make("saucer", seed=seed)}  # fmt: skip
    inside = [Relation(child=name, kind="in", parent="carrier") for name in ("cup", "apple")]
    relations = (*inside, Relation(child="plate", kind="on", parent="carrier"))
    layout = arrange(assets, relations, seed=seed)
    assert [one.detail for one in check_relations(relations, assets, layout.poses, touch=TOUCH) if not one.holds] == []
    top = dict(layout.poses) | {"cup": layout.poses["plate"]}
    assert not check_relations(relations[:1], assets, top, touch=TOUCH)[0].holds


def test_the_tiers_of_an_asset_are_what_a_kind_speaks_of():
    case = catalogue.make("bookshelf", seed=0)
    assert meant("on_middle_tier", case) == tiers(case)[1:3]
    assert meant("on_third_tier", catalogue.make("cart", seed=0)) == ()
