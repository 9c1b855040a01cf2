import re
from dataclasses import replace

import pytest

from pat3d.assets import catalogue
from pat3d.errors import LayoutError
from pat3d.generation import sizing
from pat3d.generation.request import objects_of_plan
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_arranged
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import Arrangement, PlannedObject, ScenePlan
from pat3d.progress import silent
from pat3d.scene.model import Relation

CROWDED = "A tray with a teapot, two cups and a plate."


def tray_of(plan):
    return next(one for one in objects_of_plan(plan, 0, silent) if one.name.endswith("tray"))


def test_a_tray_that_is_too_small_for_what_is_on_it_is_made_larger_and_says_so():
    usual = tray_of(GrammarPlanner().plan("A tray with a cup."))
    tray = tray_of(GrammarPlanner().plan(CROWDED))
    factor = tray.asset.size[0] / usual.asset.size[0]
    assert factor > 1.1
    assert f"{factor:.3g} times its usual size" in tray.note
    assert not usual.note


@pytest.mark.parametrize(
    "prompt",
    [
        "A small tray with a teapot, two cups and a plate.",
        "A 35 cm tray with a teapot, two cups and a plate.",
        "A tray with two cups.",
    ],
)
def test_a_tray_of_a_given_size_or_with_room_keeps_its_size(prompt):
    plan = GrammarPlanner().plan(prompt)
    tray = tray_of(plan)
    alone = replace(plan, relations=tuple(rel for rel in plan.relations if not rel.parent.endswith("tray")))
    assert tray.asset.size == pytest.approx(tray_of(alone).asset.size)
    assert not tray.note


@pytest.mark.parametrize(
    ("fits_from", "scale", "expected"),
    [
        (1.0, 1.0, None),
        (1.1, 1.0, 1.15),
        (1.2, 1.0, 1.3),
        (1.5, 1.0, 1.5),
        (1.6, 1.0, 1.7),
        (2.0, 1.0, None),
        (1.2, 0.8, None),
    ],
)
def test_the_smallest_factor_that_lets_things_stand_side_by_side_is_taken(monkeypatch, fits_from, scale, expected):
    """With assets that are mere factors: a load fits from one on. Where none helps, or a size was asked, none is."""
    monkeypatch.setattr(sizing, "_side_by_side", lambda plan, carrier, assets: assets[carrier] >= fits_from)
    tray = PlannedObject(name="tray", noun="tray", scale=scale)
    cups = [PlannedObject(name=name, noun="cup") for name in ("cup 1", "cup 2")]
    relations = tuple(Relation(child=cup.name, kind="on", parent="tray") for cup in cups)
    plan = ScenePlan(prompt="", objects=(tray, *cups), relations=relations)
    found = sizing.enlarged_trays(plan, dict.fromkeys(("tray", "cup 1", "cup 2"), 1.0), lambda name, factor: factor)
    assert found == ({} if expected is None else {"tray": (expected, expected)})


def test_a_tray_is_made_large_enough_for_a_circle_around_something():
    """Five mugs side by side would fit the usual tray; around a teapot they do not."""
    plan = GrammarPlanner().plan("Five mugs in a circle around a teapot on a tray.")
    made = {one.name: one for one in objects_of_plan(plan, 0, silent)}
    assert "times its usual size" in made["tray"].note
    assets = {name: one.asset for name, one in made.items()}
    layout = arrange(assets, plan.relations, seed=0, arrangements=plan.held())
    assert all(found.holds for found in check_arranged(plan.held(), (), assets, layout.poses))
    loose = replace(plan, arrangements=(), relations=tuple(rel for rel in plan.relations if rel.supports))
    assert not tray_of(loose).note


def test_where_no_tray_is_large_enough_the_refusal_says_how_many_fit():
    plan = GrammarPlanner().plan("Fourteen mugs in a circle around a teapot on a tray.")
    assets = {one.name: one.asset for one in objects_of_plan(plan, 0, silent)}
    with pytest.raises(LayoutError, match=r" (\d+) of the 14 that stand so have room") as refused:
        arrange(assets, plan.relations, seed=0, arrangements=plan.held())
    said = re.search(r"(\d+) of the 14", str(refused.value))
    fewer = GrammarPlanner().plan(f"{said[1]} mugs in a circle around a teapot on a tray.")
    assets = {one.name: one.asset for one in objects_of_plan(fewer, 0, silent)}
    arrange(assets, fewer.relations, seed=0, arrangements=fewer.held())


def across(scale=1.0):
    objects = (PlannedObject(name="spoon", noun="spoon"), PlannedObject(name="bowl", noun="bowl", scale=scale))
    return ScenePlan(
        prompt="",
        objects=objects,
        relations=(Relation(child="spoon", kind="on", parent="bowl"),),
        arrangements=(Arrangement(kind="across", objects=("spoon",), of=("bowl",), arranged=True),),
    )


@pytest.mark.parametrize(
    ("span", "scale", "expected"),
    [
        (1.0, 1.0, {}),
        (1.1, 1.0, {"spoon": 1.1}),
        (1.25, 1.0, {"bowl": 0.8}),
        (1.5, 1.0, {"spoon": 1.2, "bowl": 0.8}),
        (2.3, 1.0, {}),
        (1.25, 1.2, {"spoon": 1.3}),
        (1.5, 1.2, {}),
    ],
)
def test_what_lies_across_a_carrier_that_is_too_wide_and_this_carrier_change_as_little_as_will_do(
    monkeypatch, span, scale, expected
):
    """With assets that are mere factors: the spoon has to be `span` times as large as the bowl."""
    monkeypatch.setattr(sizing, "place", lambda name, asset, pose: asset)
    monkeypatch.setattr(sizing, "crossing", lambda spoon, bowl: spoon / bowl >= span - 1e-9 or None)
    found = sizing.crossings(across(scale), {"spoon": 1.0, "bowl": 1.0}, lambda name, factor: factor)
    assert {name: factor for name, (_, factor) in found.items()} == expected


def test_a_bowl_across_which_a_spoon_lies_keeps_its_size_where_it_holds_apples():
    held = (PlannedObject(name="apple", noun="apple"),)
    holding = Relation(child="apple", kind="in", parent="bowl")
    plan = across()
    plan = replace(plan, objects=(*plan.objects, *held), relations=(*plan.relations, holding))
    bowl = catalogue.make("bowl")
    made = {"bowl": bowl, "spoon": catalogue.make("spoon", scale=0.8)}
    assert sizing.crossings(plan, made, lambda name, factor: catalogue.make(name, scale=0.8 * factor)) == {}
    found = sizing.crossings(across(), made, lambda name, factor: catalogue.make(name, scale=factor))
    assert set(found) == {"spoon"}
    assert found["spoon"][0].size[0] > bowl.size[0]
