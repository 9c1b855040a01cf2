"""The layout stage: nothing touches, everything is where its relations say, or a clear refusal."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pat3d.assets import shapes
from pat3d.assets.catalogue import make
from pat3d.errors import LayoutError, SpecError
from pat3d.geometry.pose import Pose
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_relations, relation_holds
from pat3d.scene.relations import GROUND, LATERAL_KINDS, SUPPORT_KINDS, Relation
from tests.layout.things import (
    asset,
    ball,
    block,
    gap_by_manifold,
    mug,
    pen,
    shelf,
    table,
    tree_with_branch,
    vessel,
)

KINDS = LATERAL_KINDS | SUPPORT_KINDS
GAP = 0.002
LEAST = 0.0015
"""The barrier of the simulator reaches 1 mm; layouts stay clear of it."""


def rel(child, kind, parent):
    return Relation(child=child, kind=kind, parent=parent)


def check(assets, relations, layout):
    """Nothing nearer than 1.5 mm, nothing under the ground, every relation holds up to the gap."""
    gap, pair = gap_by_manifold(dict(assets), dict(layout.poses))
    assert gap >= LEAST, (pair, gap)
    for name, pose in layout.poses.items():
        lowest = min(pose.apply(part.vertices)[:, 2].min() for part in assets[name].parts)
        assert lowest >= LEAST, name
    for kinds, touch in (({"hangs_from"}, 1e-3), (KINDS - {"hangs_from"}, GAP + 2e-4)):
        chosen = tuple(relation for relation in relations if relation.kind in kinds)
        results = check_relations(chosen, assets, layout.poses, touch=touch, attachments=layout.attachments)
        assert all(result.holds for result in results), [f"{r.relation}: {r.detail}" for r in results if not r.holds]


@st.composite
def small_scenes(draw):
    """Boxes on boxes, on the ground and in bowls: a random tree of up to eight objects."""
    sizes = st.floats(0.03, 0.12)
    assets, relations = {"table": table()}, []
    for k in range(draw(st.integers(1, 7))):
        kind = draw(st.sampled_from(["box", "ball", "bowl"]))
        name = f"{kind} {k}"
        hosts = [GROUND, "table"]
        if kind == "box":
            # On a box, the box above is no larger: a person stacks that way.
            below = [other for other in assets if other.startswith("box")]
            x, y, z = draw(sizes), draw(sizes), draw(sizes)
            assets[name] = block(x, y, z)
            roomy = [
                other
                for other in below
                if np.all(assets[other].size[:2] >= [x, y]) and not any(r.parent == other for r in relations)
            ]
            parent = draw(st.sampled_from([*hosts, *roomy]))
        else:
            assets[name] = ball(draw(st.floats(0.01, 0.02))) if kind == "ball" else vessel(0.09, 0.07)
            bowls = [other for other in assets if other.startswith("bowl") and other != name]
            parent = draw(st.sampled_from([*hosts, *(bowls if kind == "ball" else [])]))
        if parent != GROUND:
            relations.append(rel(name, "in" if parent.startswith("bowl") else "on", parent))
    return assets, tuple(relations), draw(st.integers(0, 5))


@given(scene=small_scenes())
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_random_trees_are_laid_out_without_contact(scene):
    assets, relations, seed = scene
    check(assets, relations, arrange(assets, relations, seed=seed))


def test_layout_is_a_function_of_its_seed():
    assets = {"table": table(), "mug": mug(), "pen 1": pen(), "pen 2": pen(), "a": block(), "b": block()}
    relations = (
        rel("mug", "on", "table"),
        rel("pen 1", "in", "mug"),
        rel("pen 2", "in", "mug"),
        rel("a", "on", "table"),
        rel("b", "on", "a"),
    )
    first, again, other = (arrange(assets, relations, seed=seed) for seed in (3, 3, 4))
    assert first.poses == again.poses
    assert first.poses != other.poses


def test_a_basket_takes_twelve_balls_within_its_walls():
    assets = {"basket": vessel(0.16, 0.13, wall=0.01), **{f"ball {k}": ball() for k in range(12)}}
    relations = tuple(rel(f"ball {k}", "in", "basket") for k in range(12))
    check(assets, relations, arrange(assets, relations, seed=0))


def test_pens_stand_in_a_mug_with_their_feet_down():
    assets = {"mug": mug(), **{f"pen {k}": pen() for k in range(4)}}
    relations = tuple(rel(f"pen {k}", "in", "mug") for k in range(4))
    layout = arrange(assets, relations, seed=1)
    check(assets, relations, layout)
    for k in range(4):
        axis = layout.poses[f"pen {k}"].rotation[:, 0]
        assert abs(axis[2]) > np.cos(np.radians(50))


def test_tapered_cups_nest():
    """Four cups 0.1 m high with a 20 % taper stand far lower inside one another than on one another."""
    assets = {f"cup {k}": vessel(0.045, 0.1, wall=0.003, taper=0.7, noun="cup") for k in range(4)}
    relations = tuple(rel(f"cup {k + 1}", "on", f"cup {k}") for k in range(3))
    layout = arrange(assets, relations, seed=0)
    check(assets, relations, layout)
    heights = [layout.poses[f"cup {k}"].position[2] for k in range(4)]
    assert np.all(np.diff(heights) < 0.06)


def test_a_tower_of_ten_is_stacked_with_the_gap_between():
    assets = {f"block {k}": block() for k in range(10)}
    relations = tuple(rel(f"block {k + 1}", "on", f"block {k}") for k in range(9))
    layout = arrange(assets, relations, seed=2)
    heights = np.array([layout.poses[f"block {k}"].position[2] for k in range(10)])
    np.testing.assert_allclose(np.diff(heights), 0.06 + GAP, atol=1e-4)
    offsets = np.array([layout.poses[f"block {k}"].position[:2] for k in range(10)])
    assert np.abs(np.diff(offsets, axis=0)).max() <= 0.02 * 0.06 * 1.5


@pytest.mark.parametrize("kind", ["left_of", "right_of", "in_front_of", "behind", "next_to"])
@pytest.mark.parametrize("where", ["table", GROUND])
def test_lateral_relations_hold_in_the_layout(kind, where):
    assets = {"table": table(), "plate": block(0.2, 0.2, 0.02), "cup": block(0.07, 0.07, 0.1), "far": block()}
    support = () if where == GROUND else tuple(rel(name, "on", "table") for name in ("plate", "cup", "far"))
    relations = (*support, rel("cup", kind, "plate"), rel("far", "left_of", "cup"))
    check(assets, relations, arrange(assets, relations, seed=0))


def test_four_chairs_around_a_table_face_it():
    chair = asset("chair", _chair_shape())
    assets = {"table": table(), **{f"chair {k}": chair for k in range(4)}}
    relations = tuple(rel(f"chair {k}", "around", "table") for k in range(4))
    layout = arrange(assets, relations, seed=0)
    check(assets, relations, layout)
    for k in range(4):
        pose = layout.poses[f"chair {k}"]
        front = pose.rotation @ np.array([0.0, -1.0, 0.0])
        towards = -np.array(pose.position)
        assert front[:2] @ towards[:2] > 0.7 * np.linalg.norm(towards[:2])


def test_a_relation_to_something_on_another_support_moves_the_support():
    assets = {"table": table(), "lamp": block(0.1, 0.1, 0.4), "bed": block(1.6, 2.0, 0.5, noun="bed")}
    relations = (rel("lamp", "on", "table"), rel("lamp", "left_of", "bed"))
    check(assets, relations, arrange(assets, relations, seed=0))


def test_shelves_share_their_things_out():
    assets = {"shelf": shelf(), "ball": ball(), "box": block(0.2, 0.15, 0.2, noun="box"), "hat": block(noun="hat")}
    relations = tuple(rel(name, "on", "shelf") for name in ("ball", "box", "hat"))
    layout = arrange(assets, relations, seed=0)
    check(assets, relations, layout)
    assert len({round(layout.poses[name].position[2], 2) for name in ("ball", "box", "hat")}) == 3


def test_a_swing_hangs_under_the_branch():
    swing = asset("swing", _swing_shape())
    assets = {"tree": tree_with_branch(), "swing": swing}
    relations = (rel("swing", "hangs_from", "tree"),)
    layout = arrange(assets, relations, seed=0)
    check(assets, relations, layout)
    top = layout.poses["swing"].position[2] + swing.size[2]
    assert top == pytest.approx(2.4, abs=0.01)


def tree_with_branch_along_y(slope=0.0):
    branch = shapes.box(1.6, 0.12, 0.12).moved(x=0.8).turned("y", -slope).turned("z", 90).moved(z=2.4)
    return asset("tree", shapes.join(shapes.cylinder(0.1, 3.0), branch))


@pytest.mark.parametrize(("slope", "tilt"), [(0.0, 0.0), (4.0, 4.0)])
def test_two_ropes_are_tied_along_the_branch_wherever_it_points(slope, tilt):
    """The swing turns with the branch and follows its slope; its ends are a layout's gap below the branch."""
    swing = make("swing")
    assets = {"tree": tree_with_branch_along_y(slope), "swing": swing}
    relations = (rel("swing", "hangs_from", "tree"),)
    layout = arrange(assets, relations, seed=0)
    check(assets, relations, layout)
    (attachment,) = layout.attachments
    assert (attachment.child, attachment.parent) == ("swing", "tree")
    assert tuple(point for point, _ in attachment.anchors) == swing.anchors
    on_child, on_parent = attachment.ends(layout.poses["swing"], layout.poses["tree"])
    np.testing.assert_allclose(on_child, on_parent, atol=1e-12)
    along = on_child[1] - on_child[0]
    assert abs(along[0]) < 1e-6 * abs(along[1])
    assert np.degrees(np.arctan2(abs(along[2]), abs(along[1]))) == pytest.approx(tilt, abs=0.05)
    assert layout.clearance.min_distance == pytest.approx(GAP, abs=1e-4)
    trunk = layout.poses["tree"].position[1] + assets["tree"].bounds[0, 1] + 0.1
    assert layout.poses["swing"].position[1] - trunk > 0.3


def test_a_branch_too_steep_for_two_ropes_is_refused():
    assets = {"tree": tree_with_branch_along_y(25.0), "swing": make("swing")}
    with pytest.raises(LayoutError, match="cannot hang"):
        arrange(assets, (rel("swing", "hangs_from", "tree"),), seed=0)


def test_what_hangs_at_one_point_is_plumb_below_it():
    """An L-shaped block hangs by the middle of its top, turned until its centre of mass is below."""
    bent = asset("bent", shapes.join(shapes.box(0.04, 0.04, 0.3), shapes.box(0.2, 0.04, 0.04).moved(x=0.08)))
    assets = {"tree": tree_with_branch(), "bent": bent}
    layout = arrange(assets, (rel("bent", "hangs_from", "tree"),), seed=0)
    (attachment,) = layout.attachments
    top, _ = attachment.ends(layout.poses["bent"], layout.poses["tree"])
    centre = layout.poses["bent"].apply(np.array([bent.mass_properties.centre_of_mass]))
    np.testing.assert_allclose(centre[0, :2], top[0, :2], atol=1e-9)
    assert centre[0, 2] < top[0, 2] - 0.1


def test_a_bowl_hangs_level_by_two_points_of_its_rim():
    bowl = vessel(0.1, 0.08)
    layout = arrange({"tree": tree_with_branch(), "bowl": bowl}, (rel("bowl", "hangs_from", "tree"),), seed=0)
    assert len(layout.attachments[0].anchors) == 2
    assert layout.poses["bowl"].rotation[2, 2] == pytest.approx(1.0, abs=1e-6)


def test_given_poses_are_attached_where_they_are_near_enough():
    assets = {"tree": tree_with_branch(), "swing": make("swing")}
    relations = (rel("swing", "hangs_from", "tree"),)
    free = arrange(assets, relations, seed=0)
    again = arrange(assets, relations, seed=0, fixed_poses=free.poses)
    assert again.attachments == free.attachments
    x, y, z = free.poses["swing"].position
    lower = {**free.poses, "swing": Pose(position=(x, y, z - 0.1))}
    assert arrange(assets, relations, seed=0, fixed_poses=lower).attachments == ()


def test_crowded_surface_uses_rows_and_small_gaps():
    """Nine plates of 0.2 m need three rows of 0.6 m and two gaps on a 0.66 m square."""
    assets = {"board": block(0.66, 0.66, 0.05), **{f"plate {k}": block(0.2, 0.2, 0.02) for k in range(9)}}
    relations = tuple(rel(f"plate {k}", "on", "board") for k in range(9))
    check(assets, relations, arrange(assets, relations, seed=0))


def test_long_things_are_turned_to_fit():
    assets = {"board": block(0.2, 0.5, 0.05), "rule 1": block(0.45, 0.05, 0.01), "rule 2": block(0.45, 0.05, 0.01)}
    relations = (rel("rule 1", "on", "board"), rel("rule 2", "on", "board"))
    check(assets, relations, arrange(assets, relations, seed=0))


def test_given_poses_are_kept_exactly_and_avoided():
    assets = {"table": table(), "vase": block(0.1, 0.1, 0.3), "cup": block()}
    relations = (rel("vase", "on", "table"), rel("cup", "on", "table"))
    fixed = {
        "table": Pose(position=(1.0, 2.0, GAP)),
        "vase": Pose.from_yaw(0.4, (1.1, 2.05, 0.74 + 2 * GAP)),
    }
    layout = arrange(assets, relations, seed=0, fixed_poses=fixed)
    assert {name: layout.poses[name] for name in fixed} == fixed
    check(assets, relations, layout)


def test_a_watermelon_in_a_mug_is_refused_with_both_sizes():
    with pytest.raises(LayoutError, match=r'"watermelon" \(0\.\d+ m\) does not fit inside "mug" \(0\.\d+ m wide\)'):
        arrange({"mug": mug(), "watermelon": ball(0.14)}, (rel("watermelon", "in", "mug"),), seed=0)


def test_a_full_container_is_refused_with_what_is_inside():
    assets = {"mug": mug(), **{f"egg {k}": ball(0.022) for k in range(12)}}
    with pytest.raises(LayoutError, match=r'"mug".* is full: no room for "egg'):
        arrange(assets, tuple(rel(f"egg {k}", "in", "mug") for k in range(12)), seed=0)


def test_plates_that_do_not_fit_side_by_side_are_stacked():
    assets = {"stool": block(0.3, 0.3, 0.4), **{f"plate {k}": block(0.25, 0.25, 0.02) for k in range(3)}}
    relations = tuple(rel(f"plate {k}", "on", "stool") for k in range(3))
    layout = arrange(assets, relations, seed=0)
    check(assets, relations, layout)
    assert len({round(layout.poses[f"plate {k}"].position[2], 3) for k in range(3)}) == 3
    assert "piled" in layout.notes[0]


def test_things_are_put_where_the_support_is_and_not_where_its_box_is():
    """An arch-shaped block carries at its two posts only; the boxes end on them and not on the ground."""
    posts = [shapes.box(0.12, 0.12, 0.3).moved(x=side * 0.25) for side in (-1, 1)]
    assets = {
        "gate": asset("gate", shapes.join(shapes.box(0.62, 0.12, 0.05), *posts)),
        "a": block(0.08, 0.08, 0.08),
        "b": block(0.08, 0.08, 0.08),
        "c": block(0.09, 0.09, 0.08),
    }
    relations = tuple(rel(name, "on", "gate") for name in "abc")
    check(assets, relations, arrange(assets, relations, seed=0))


def test_two_trays_beside_each_other_on_a_stool_are_refused():
    assets = {"stool": block(0.3, 0.3, 0.4), "a": block(0.25, 0.25, 0.02), "b": block(0.25, 0.25, 0.02)}
    relations = (rel("a", "on", "stool"), rel("b", "on", "stool"), rel("b", "next_to", "a"))
    with pytest.raises(LayoutError, match=r'"b" \(.*finds no room on "stool" \(0\.30 x 0\.30 m\) beside "a"'):
        arrange(assets, relations, seed=0)


def test_contradicting_sides_are_refused():
    with pytest.raises(LayoutError, match="a left_of b"):
        arrange({"a": block(), "b": block()}, (rel("a", "left_of", "b"), rel("b", "left_of", "a")), seed=0)


def test_intersecting_given_poses_are_refused_by_pair():
    fixed = {"a": Pose(position=(0, 0, GAP)), "b": Pose(position=(0.03, 0, GAP))}
    with pytest.raises(LayoutError, match='"a" and "b" intersect'):
        arrange({"a": block(), "b": block()}, (), seed=0, fixed_poses=fixed)


def test_a_given_pose_under_the_ground_is_refused():
    with pytest.raises(LayoutError, match=r'"a" reaches 10\.0 mm under the ground'):
        arrange({"a": block()}, (), seed=0, fixed_poses={"a": Pose(position=(0, 0, -0.01))})


def test_a_given_pose_on_a_free_support_is_refused():
    assets = {"table": table(), "cup": block()}
    with pytest.raises(LayoutError, match='Give "table" a pose too'):
        arrange(assets, (rel("cup", "on", "table"),), seed=0, fixed_poses={"cup": Pose(position=(0, 0, 0.8))})


def test_unknown_names_are_refused():
    with pytest.raises(SpecError, match="ghost"):
        arrange({"a": block()}, (rel("ghost", "on", "a"),), seed=0)
    with pytest.raises(LayoutError, match="ghost"):
        arrange({"a": block()}, (), seed=0, fixed_poses={"ghost": Pose()})


def test_things_without_a_cavity_carry_on_top_and_say_so():
    assets = {"block": block(0.2, 0.2, 0.1), "ball": ball()}
    layout = arrange(assets, (rel("ball", "in", "block"),), seed=0)
    assert "no cavity" in layout.notes[0]
    assert relation_holds(rel("ball", "on", "block"), assets, layout.poses, touch=2 * GAP)


def _chair_shape():
    seat = shapes.box(0.42, 0.42, 0.45)
    back = shapes.box(0.42, 0.04, 0.45).moved(y=0.19, z=0.45)
    return shapes.join(seat, back)


def _swing_shape():
    seat = shapes.box(0.5, 0.2, 0.03)
    ropes = [shapes.box(0.02, 0.02, 1.6).moved(x=side * 0.22) for side in (-1, 1)]
    bar = shapes.box(0.5, 0.03, 0.03).moved(z=1.6)
    return shapes.join(seat, bar, *ropes)
