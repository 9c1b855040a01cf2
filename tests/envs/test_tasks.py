"""Success is judged on the simulation's state: objects are put where a task wants them, or not."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("robosuite")
pytest.importorskip("gymnasium")

import mujoco

from pat3d.assets.catalogue.lookup import make
from pat3d.envs.grasping.free_space import NARROWEST_BASE
from pat3d.envs.grasping.placement import Needs, place
from pat3d.envs.physics.predicates import pairs_that
from pat3d.envs.physics.snapshot import floors
from pat3d.envs.tasks.registry import TASKS, parse_task, possible_tasks
from pat3d.errors import TaskError
from pat3d.geometry.pose import Pose
from pat3d.layout.predicates import check_relations
from pat3d.scene.model import Relation, Scene, SceneObject
from tests.envs.test_grasp import bar

ALOFT = 0.5


def _teleport(env, name: str, position, quat=None) -> None:
    """Put an object at rest with its frame at `position` [m]."""
    world, data = env.simulation.world, env.simulation.data
    number = world.objects.index(name)
    data.qpos[world.positions[number] : world.positions[number] + 3] = position
    if quat is not None:
        data.qpos[world.positions[number] + 3 : world.positions[number] + 7] = quat
    data.qvel[world.velocities[number] : world.velocities[number] + 6] = 0.0
    mujoco.mj_forward(env.simulation.model, data)
    env.simulation.states.refresh()


def _inside(env, child: str, parent: str) -> bool:
    there = floors(env.simulation.world, [(child, parent)], "in")
    return bool(pairs_that(env.simulation.states.snapshot, there, within=True)[0, 0])


def _on_top(env, child: str, parent: str) -> bool:
    there = floors(env.simulation.world, [(child, parent)], "on")
    return bool(pairs_that(env.simulation.states.snapshot, there, within=False)[0, 0])


def _wait(env, seconds: float):
    """Let time pass without moving the robot; the last step's success and info."""
    action = np.zeros(env.action_space.shape, dtype=np.float32)
    success, info = False, {}
    for _ in range(math.ceil(seconds * env.control_freq)):
        _, _, success, _, info = env.step(action)
        if success:
            break
    return success, info


def _above_floor(env, container: str, height: float):
    state = env.simulation.state
    region = state.scene[container].asset.region("in")
    return state.position(container) + state.rotation(container) @ np.array(region.floor) + [0.0, 0.0, height]


def test_an_apple_that_falls_into_the_bowl_and_comes_to_rest_is_placed(env):
    env.reset(seed=0, options={"task": "place:green apple:blue bowl"})
    assert env.instruction == "put the green apple in the blue bowl"
    _teleport(env, "green apple", _above_floor(env, "blue bowl", 0.02))
    success, info = _wait(env, 0.2)
    assert not success, "resting is judged for half a second"
    success, info = _wait(env, 4.0)
    assert success
    assert info["predicates"] == {"in": True, "released": True, "upright": True}


def test_an_apple_held_above_the_bowl_is_not_in_it(env):
    env.reset(seed=0, options={"task": "place:green apple:blue bowl"})
    _teleport(env, "green apple", _above_floor(env, "blue bowl", 0.15))
    assert not _inside(env, "green apple", "blue bowl")
    _teleport(env, "green apple", _above_floor(env, "blue bowl", 0.01) + [0.15, 0.0, 0.0])
    assert not _inside(env, "green apple", "blue bowl")


def test_a_bowl_upside_down_holds_nothing(env):
    env.reset(seed=0, options={"task": "place:green apple:blue bowl"})
    state = env.simulation.state
    _teleport(env, "blue bowl", [0.0, 0.0, ALOFT], quat=[0.0, 1.0, 0.0, 0.0])
    _teleport(env, "green apple", [0.0, 0.0, ALOFT - 0.06])
    assert state.tilt("blue bowl") == pytest.approx(180.0, abs=0.1)
    assert not _inside(env, "green apple", "blue bowl")
    assert "blue bowl" in state.toppled()


def test_on_and_in_agree_with_the_layout_s_predicates_on_the_scene_at_rest(env, breakfast):
    """The exact predicates that judged the scene when it was made are the oracle."""
    env.reset(seed=0, options={"task": "pick:red mug"})
    pairs = [(rel.child, rel.parent) for rel in breakfast.relations if rel.kind == "on"]
    pairs += [("banana", "blue bowl"), ("green apple", "red mug")]
    judged = check_relations(
        tuple(Relation(child=a, kind="on", parent=b) for a, b in pairs),
        {obj.name: obj.asset for obj in breakfast.objects},
        {obj.name: obj.pose for obj in breakfast.objects},
    )
    for (child, parent), result in zip(pairs, judged, strict=True):
        ours = _on_top(env, child, parent) or _inside(env, child, parent)
        assert ours == result.holds, f"{child} on {parent}"


def test_a_lift_counts_only_in_the_hand_and_only_after_a_second(env):
    """The mug hanging in the air without the robot is no pick, however high."""
    env.reset(seed=0, options={"task": "pick:red mug"})
    state = env.simulation.state
    start = state.position("red mug").copy()
    _teleport(env, "red mug", start + [0.0, 0.0, 0.3])
    _, _, success, _, info = env.step(np.zeros(7, dtype=np.float32))
    assert not success
    assert not info["predicates"]["lifted"]


def test_stacking_needs_contact_and_an_upright_base(env):
    env.reset(seed=0, options={"task": "pick:red mug"})
    state = env.simulation.state
    mug, height = state.position("red mug").copy(), float(state.scene["red mug"].asset.size[2])
    _teleport(env, "green apple", mug + [0.0, 0.0, height + 0.05])
    assert not _on_top(env, "green apple", "red mug")
    # The mouth of the mug takes the lower part of the apple.
    for depth in np.arange(0.0, 0.02, 5e-4):
        _teleport(env, "green apple", mug + [0.0, 0.0, height - depth])
        if _on_top(env, "green apple", "red mug"):
            break
    else:
        pytest.fail("the apple does not touch the rim of the mug")


def test_unloading_the_tray_needs_everything_off_it_and_nothing_on_the_floor(env):
    env.reset(seed=0, options={"task": "unload:wooden tray"})
    assert env.instruction == "take everything off the wooden tray"
    spots = {"red mug": (-0.32, -0.1), "green apple": (-0.32, 0.05), "banana": (0.0, -0.26), "blue bowl": (0.33, 0.0)}
    for name, (x, y) in list(spots.items())[:3]:
        _teleport(env, name, [x, y, 0.001])
    success, info = _wait(env, 1.0)
    assert not success
    assert not info["predicates"]["empty"]
    _teleport(env, "blue bowl", [*spots["blue bowl"], 0.001])
    success, info = _wait(env, 4.0)
    assert success, info


def test_what_falls_off_the_workbench_is_reported(env):
    env.reset(seed=0, options={"task": "unload:wooden tray"})
    low, _ = env.placement.bench
    _teleport(env, "red mug", [low[0] - 0.3, 0.0, 0.1])
    _, info = _wait(env, 1.5)
    assert info["fell"] == ["red mug"]
    assert not info["predicates"]["nothing fell"]


def test_a_mug_on_its_side_has_toppled(env):
    env.reset(seed=0, options={"task": "pick:banana"})
    _teleport(env, "red mug", [-0.3, 0.0, 0.06], quat=[math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0])
    _, info = _wait(env, 0.5)
    assert info["toppled"] == ["red mug"]


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("place:green apple:wooden tray", "already"),
        ("place:wooden tray:blue bowl", "stands on"),
        ("place:blue bowl:red mug", "does not fit"),
        ("stack:red mug:red mug", "itself"),
        ("stack:green apple:blue bowl", 'use "place'),
        ("unload:red mug", "empty already"),
        ("retrieve:banana", "nothing stands on or in front"),
        ("sort", "two containers of different colours"),
        ("pick:spoon", "not in the scene"),
    ],
)
def test_tasks_that_make_no_sense_are_refused_with_the_reason(breakfast, spec, message):
    with pytest.raises(TaskError, match=message):
        parse_task(spec).check(breakfast)


def test_a_base_that_is_narrow_or_covered_takes_nothing_more():
    scene = Scene(
        objects=(
            bar("pole", (0.01, 0.01, 0.1), (0.3, 0.0)),
            bar("block", (0.1, 0.1, 0.05)),
            bar("lid", (0.1, 0.1, 0.01), (0.0, 0.0)),
            bar("brick", (0.06, 0.1, 0.05), (-0.3, 0.0)),
        ),
        relations=(Relation(child="lid", kind="on", parent="block"),),
    )
    with pytest.raises(TaskError, match="no top wide enough"):
        parse_task("stack:brick:pole").check(scene)
    with pytest.raises(TaskError, match='"lid" stands on "block" already'):
        parse_task("place:brick:block").check(scene)
    parse_task("stack:brick:lid").check(scene)


def test_every_possible_task_can_be_written_down_and_read_again(breakfast):
    tasks = list(possible_tasks(breakfast))
    assert {task.kind for task in tasks} >= {"pick", "place", "unload", "retrieve"}
    for task in tasks:
        assert parse_task(task.spec) == task
        instruction = task.instruction(breakfast)
        assert instruction
        assert instruction == instruction.lower()
    assert set(TASKS) == {
        "pick",
        "lift",
        "place",
        "stack",
        "sort",
        "unload",
        "retrieve",
        "chain",
        "rearrange",
        "push",
        "beside",
        "open",
        "close",
        "carry",
        "handover",
    }


def test_sorting_pairs_objects_with_the_container_of_their_colour(breakfast):
    """A red and a blue bowl, an apple named red and a banana named blue: each has one home."""
    bowl, apple, banana = (breakfast[name] for name in ("blue bowl", "green apple", "banana"))

    def moved(obj, name, x):
        pose = Pose(position=(x, 0.0, 0.0), quat_wxyz=obj.pose.quat_wxyz)
        return replace(obj, name=name, pose=pose, initial_pose=pose)

    scene = Scene(
        objects=(
            moved(bowl, "red bowl", -0.3),
            moved(bowl, "blue bowl", 0.3),
            moved(apple, "red apple", -0.05),
            moved(banana, "blue banana", 0.1),
            moved(apple, "green apple", 0.5),
        )
    )
    task = parse_task("sort")
    task.check(scene)
    assert task.pairs(scene) == {"red apple": "red bowl", "blue banana": "blue bowl"}
    assert set(task.needs(scene).grasp) == {"red apple", "blue banana"}
    assert "red bowl" in task.instruction(scene)


def test_an_object_wider_than_the_gripper_is_refused_with_both_widths(breakfast):
    """The apple is 76 mm wide and round; Sawyer's gripper opens 62 mm. The Panda's opens just far enough."""
    with pytest.raises(TaskError, match=r"76 mm wide .* opens 6\d mm"):
        place(breakfast, "Sawyer", Needs(grasp=("green apple",)))
    assert place(breakfast, "Panda", Needs(grasp=("green apple",))).grasps["green apple"]


def test_an_object_out_of_reach_is_refused_with_the_distance(breakfast):
    """A tray half a metre wide is no obstacle; a room in which a wall of it keeps the robot 2 m away is."""
    tray = breakfast["wooden tray"]
    around = []
    for number in range(24):
        angle = 2 * math.pi * number / 24
        for ring, radius in enumerate((0.55, 0.9, 1.25)):
            pose = Pose(position=(radius * math.cos(angle), radius * math.sin(angle), 0.0))
            around.append(replace(tray, name=f"tray {number} {ring}", pose=pose, initial_pose=pose))
    crowded = Scene(objects=(*breakfast.objects, *around), relations=breakfast.relations)
    with pytest.raises(TaskError, match=r"out of reach|no free place"):
        place(crowded, "Panda", Needs(grasp=("red mug",)))


def _put(noun: str, position, name: str | None = None) -> SceneObject:
    asset, pose = make(noun), Pose(position=position)
    return SceneObject(name=name or noun, phrase=noun, asset=asset, pose=pose, initial_pose=pose)


def test_what_lies_too_deep_in_a_pot_is_refused_for_its_depth_and_not_for_its_width():
    """A strawberry 40 mm wide on the floor of a pot: the rim keeps the hand up. A pepper mill sticks out of it."""
    pot = _put("pot", (0.0, 0.0, 0.0))
    region = pot.asset.region("in")
    floor = np.array(region.floor) + [0.0, 0.0, 1e-4]

    def scene(noun: str) -> Scene:
        return Scene(
            objects=(pot, _put(noun, tuple(floor))), relations=(Relation(child=noun, kind="in", parent="pot"),)
        )

    below = 1e3 * (region.height - make("strawberry").size[2])
    with pytest.raises(TaskError, match=rf'its top is {below:.0f} mm below the rim of "pot"'):
        place(scene("strawberry"), "Panda", Needs(grasp=("strawberry",)))
    assert place(scene("pepper mill"), "Panda", Needs(grasp=("pepper mill",))).grasps["pepper mill"]


def test_a_neighbour_that_is_in_the_way_is_named_and_one_that_is_not_is_not():
    cube = bar("cube", (0.05, 0.05, 0.05))
    walls = [bar(f"wall {x} {y}", (0.05, 0.05, 0.12), (x * 0.052, y * 0.052)) for x, y in ((-1, 0), (0, 1), (0, -1))]
    last = bar("pillar", (0.05, 0.05, 0.12), (0.052, 0.0))
    far = bar("post", (0.05, 0.05, 0.12), (0.6, 0.0))
    with pytest.raises(TaskError, match="what stands around it leaves no room for the fingers"):
        place(Scene(objects=(cube, *walls, last, far)), "Panda", Needs(grasp=("cube",)))
    ends = [bar(f"end {y}", (0.3, 0.05, 0.12), (0.0, y * 0.052)) for y in (-1, 1)]
    near = [bar("pillar", (0.02, 0.05, 0.12), (0.036, 0.0)), bar("post", (0.05, 0.05, 0.12), (0.6, 0.0))]
    with pytest.raises(TaskError, match='"pillar" leaves no room for the fingers'):
        place(Scene(objects=(bar("cube", (0.05, 0.05, 0.11)), *ends, *near)), "Panda", Needs(grasp=("cube",)))


def test_a_board_with_something_on_it_takes_more_as_long_as_there_is_room():
    def board(size: float, x: float) -> Scene:
        plum = bar("plum", (0.05, 0.05, 0.05), (x, 0.0))
        lifted = Pose(position=(x, 0.0, 0.02), quat_wxyz=plum.pose.quat_wxyz)
        return Scene(
            objects=(
                bar("board", (size, size, 0.02)),
                replace(plum, pose=lifted, initial_pose=lifted),
                bar("cube", (0.05, 0.05, 0.05), (0.5, 0.0)),
            ),
            relations=(Relation(child="plum", kind="on", parent="board"),),
        )

    parse_task("place:cube:board").check(board(0.3, -0.1))
    with pytest.raises(TaskError, match='"plum" stands on "board" already and leaves no room for "cube"'):
        parse_task("place:cube:board").check(board(0.12, 0.0))


def test_what_stands_under_a_shelf_is_refused_because_it_is_covered():
    board, roof = bar("board", (0.4, 0.3, 0.02)), bar("roof", (0.4, 0.3, 0.02))
    above = replace(roof.asset.parts[0], vertices=roof.asset.parts[0].vertices + [0.0, 0.0, 0.4])
    shelf = replace(board, name="shelf", asset=replace(board.asset, parts=(*board.asset.parts, above)))
    cube = bar("cube", (0.05, 0.05, 0.05))
    lifted = replace(cube, pose=Pose(position=(0.0, 0.0, 0.02), quat_wxyz=cube.pose.quat_wxyz))
    scene = Scene(objects=(shelf, lifted), relations=(Relation(child="cube", kind="on", parent="shelf"),))
    with pytest.raises(TaskError, match='it is under a part of "shelf" and cannot be got at from above'):
        place(scene, "Panda", Needs(grasp=("cube",), visit=((0.3, 0.0, 0.2),)))


@pytest.mark.parametrize("base", ["cube", "block", "cylinder", "can", "soda can", "soap", "sponge"])
def test_a_top_with_nothing_on_it_has_room_for_the_widest_that_it_may_carry(base):
    bottom = _put(base, (0.0, 0.0, 0.0))
    widest = 2 * min(bottom.asset.region("on").half_size) / NARROWEST_BASE
    for width in (0.5 * widest, 0.9 * widest, 0.99 * widest):
        scene = Scene(objects=(bottom, bar("brick", (width, width, 0.05), (0.5, 0.0))))
        parse_task(f"stack:brick:{base}").check(scene)
