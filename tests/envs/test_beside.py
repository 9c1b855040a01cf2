"""Beside one another: what counts, in one world and in many, and that the scripted policy does it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from scipy.spatial.transform import Rotation

from pat3d.assets.shapes import box
from pat3d.envs.physics.predicates import OWNERS, SUPPORT_ROW
from pat3d.envs.physics.snapshot import Snapshot
from pat3d.envs.physics.state import States
from pat3d.envs.tasks.beside import RELATIONS
from pat3d.envs.tasks.beside_judge import Related
from pat3d.envs.tasks.beside_spots import at_rest, spots
from pat3d.envs.tasks.push import bench_at_rest
from pat3d.envs.tasks.registry import parse_task
from pat3d.geometry.pose import Pose
from pat3d.layout.lateral import Box, on_side
from pat3d.layout.predicates import check_relations, relation_holds
from pat3d.scene.model import Relation
from tests.envs.beside_scenes import CUBE, made, on_a_board, on_a_table, put, rest, scripted
from tests.scenes import GAP, asset_of, placed, scene_of

AWAY = {"left_of": (-1, 0), "right_of": (1, 0), "in_front_of": (0, -1), "behind": (0, 1)}
"""Where each side is, for somebody who looks along +y."""


@pytest.fixture(scope="module")
def table():
    return on_a_table()


@pytest.fixture(scope="module")
def boarded():
    return on_a_board()


@pytest.fixture(scope="module")
def env(table, tmp_path_factory):
    env = made(table, "beside:mug:left_of:plate", tmp_path_factory)
    yield env
    env.close()


@pytest.fixture(scope="module")
def on_board(boarded, tmp_path_factory):
    env = made(boarded, "beside:mug:right_of:plate", tmp_path_factory)
    yield env
    env.close()


@pytest.mark.parametrize("relation", RELATIONS)
def test_spots_are_free_and_satisfy_the_scene_s_predicate_with_a_margin(table, relation):
    """A mug that is moved there, or 2 cm beside it, is in the relation and meets nothing."""
    view = at_rest(table, "mug", "plate")
    found = spots(relation, view)
    assert found.free
    assets = {obj.name: obj.asset for obj in table.objects}
    poses = {obj.name: obj.pose for obj in table.objects}
    for spot in found.free:
        for x, y in ((0.0, 0.0), (0.019, 0.0), (-0.019, 0.0), (0.0, 0.019), (0.0, -0.019)):
            now = poses | {"mug": Pose(position=(float(spot[0]) + x, float(spot[1]) + y, GAP))}
            assert relation_holds(Relation(child="mug", kind=relation, parent="plate"), assets, now)
            assert not [one for one in ("plate", "jar") if np.abs(spot - now[one].position[:2]).max() < 0.04]


def test_spots_are_where_their_words_say(table):
    """Left is -x, in front is -y, for a viewer who looks along +y; and the robot faces him."""
    plate = np.array(table["plate"].pose.position[:2])
    for relation, way in AWAY.items():
        for spot in spots(relation, at_rest(table, "mug", "plate")).free:
            assert float((spot - plate) @ way) > 0.08
        assert parse_task(f"beside:mug:{relation}:plate").needs(table).facing
    assert not parse_task("beside:mug:next_to:plate").needs(table).facing


def test_spots_are_on_the_surface_however_it_is_turned():
    """A long board turned by 40 degrees: every corner of the mug is over it, in its own frame."""
    turn = Pose.from_matrix(Rotation.from_euler("z", 40.0, degrees=True).as_matrix(), np.array([0.0, 0.0, GAP]))
    board = placed("board", asset_of(box(0.6, 0.18, 0.02)), pose=turn)
    plate = placed("plate", asset_of(box(0.06, 0.06, 0.03)), (0.0, 0.0, 0.02 + 2 * GAP))
    scene = scene_of(
        placed("mug", CUBE, (0.0, -0.4, GAP)), board, plate,
        relations=(Relation(child="plate", kind="on", parent="board"),),
    )  # fmt: skip
    parse_task("beside:mug:right_of:plate").check(scene)
    for spot in spots("right_of", at_rest(scene, "mug", "plate")).free:
        corners = spot + 0.02 * np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])
        own = corners @ turn.rotation[:2, :2]
        assert (np.abs(own) <= [0.3, 0.09]).all()


def test_a_workbench_reaches_where_something_is_to_be_put(tmp_path_factory):
    wide = asset_of(box(0.04, 0.3, 0.04))
    scene = scene_of(placed("plate", asset_of(box(0.06, 0.06, 0.03)), (0, 0, GAP)), placed("rod", wide, (0.2, 0, GAP)))
    task = parse_task("beside:rod:behind:plate")
    task.check(scene)
    needs = task.needs(scene)
    bench = made(scene, task.spec, tmp_path_factory).placement.bench
    assert bench is not None
    assert (np.array(bench[0]) <= needs.room[0]).all()
    assert (needs.room[1] <= np.array(bench[1])).all()
    usual = bench_at_rest(scene, "rod")
    assert usual is not None
    assert needs.room[1][1] > usual[1][1]


class Worlds(States):
    """Worlds in states that a test makes up: two objects anywhere, turned and leaning, in contact with the ground."""

    def put(self, random: np.random.Generator, names: tuple[str, ...], spread: float) -> Worlds:
        """Random poses of the named objects around the middle [m]; the others stay where they are."""
        scene, worlds, model = self.world.scene, self.count, self.world.model
        count = OWNERS + len(scene.objects)
        arrays: dict[str, Any] = {
            "xpos": np.zeros((worlds, model.nbody, 3)),
            "xmat": np.tile(np.identity(3).ravel(), (worlds, model.nbody, 1)),
            "xipos": np.zeros((worlds, model.nbody, 3)),
            "qvel": random.choice([1e-3, 1.0], size=(worlds, 1), p=[0.8, 0.2]) * np.ones((worlds, model.nv)),
            "sites": np.zeros((worlds, model.nsite, 3)),
            "site_xmat": np.tile(np.identity(3).ravel(), (worlds, model.nsite, 1)),
            "touching": np.zeros((worlds, count, count), dtype=np.bool_),
            "pinched": np.zeros((worlds, 2, count), dtype=np.bool_),
        }
        for obj in scene.objects:
            body, number = self.world.bodies[obj.name], self.numbers[obj.name]
            position = np.tile(np.array(obj.pose.position), (worlds, 1))
            turn = Rotation.from_rotvec(np.zeros((worlds, 3)))
            if obj.name in names:
                flat = random.uniform(-spread, spread, size=(worlds, 2))
                position = np.column_stack([flat, random.choice([GAP, 0.02, 0.12, 0.2], size=worlds)])
                lean = random.standard_normal((worlds, 3)) * random.choice([0.0, 0.3, 1.0], size=(worlds, 1))
                turn = Rotation.from_euler("z", random.uniform(-4, 4, size=(worlds, 1))) * Rotation.from_rotvec(lean)
                self._touch(arrays["touching"], number, random)
            arrays["xpos"][:, body], arrays["xmat"][:, body] = position, turn.as_matrix().reshape(worlds, 9)
            arrays["xipos"][:, body] = position + turn.apply(np.array(obj.asset.mass_properties.centre_of_mass))
        self.snapshot = Snapshot(**arrays, **self._about)
        return self

    def _touch(self, touching: np.ndarray, number: int, random: np.random.Generator) -> None:
        for row, share in ((SUPPORT_ROW, 0.8), (OWNERS - 1, 0.2)):
            holds = random.random(self.count) < share
            touching[:, row, OWNERS + number] = touching[:, OWNERS + number, row] = holds

    def alone(self, number: int) -> Worlds:
        """One of the worlds."""
        one, own = Worlds(self.world, 1), slice(number, number + 1)
        varying = {name: value[own].copy() for name, value in self.snapshot._asdict().items() if name in VARYING}
        one.snapshot = self.snapshot._replace(**varying)
        return one


VARYING = {
    "xpos", "xmat", "xipos", "qvel", "sites", "site_xmat", "touching", "pinched", "start_centre", "start_up",
}  # fmt: skip


def poses_of(states: States, number: int, names: tuple[str, ...]) -> dict[str, Pose]:
    now, bodies = states.snapshot, states.world.bodies
    return {
        name: Pose.from_matrix(now.xmat[number, bodies[name]].reshape(3, 3), now.xpos[number, bodies[name]])
        for name in names
    }


@pytest.mark.parametrize("relation", RELATIONS)
def test_the_judge_of_many_worlds_agrees_with_the_predicate_of_scenes(env, table, relation):
    """The exact predicates that judge scenes when they are made are the oracle, over random poses near and far."""
    pair = ("mug", "plate")
    assets = {name: table[name].asset for name in pair}
    relations = (Relation(child="mug", kind=relation, parent="plate"),)
    seen = []
    for seed, spread in enumerate((0.06, 0.15, 0.35)):
        states = Worlds(env.simulation.world, 300).put(np.random.default_rng(seed), pair, spread)
        ours = Related(states, relation, *pair)
        holds = ours.holds(*ours.boxes()).tolist()
        theirs = [check_relations(relations, assets, poses_of(states, k, pair))[0].holds for k in range(states.count)]
        assert holds == theirs
        seen += theirs
    assert 0.1 < np.mean(seen) < 0.9


def test_outlines_that_directions_do_not_tell_apart_are_looked_at_exactly(env, table):
    """Around the largest gap, and with the centre on the edge of the other, to a hundredth of a millimetre."""
    states = Worlds(env.simulation.world, 1).put(np.random.default_rng(0), (), 0.0)
    ours = Related(states, "next_to", "mug", "plate")
    mug, plate = (states.world.bodies[name] for name in ("mug", "plate"))
    turn = Rotation.from_euler("z", 17.0, degrees=True)
    found = {}
    for edge, sign in ((0.06 + 0.02 + 0.25, 1.0), (0.06, -1.0)):
        for by in (-1e-5, 1e-5):
            here = states.snapshot.xpos[0, plate] + turn.apply([edge + by, 0.0, 0.0])
            now = states.snapshot
            for body in (mug, plate):
                now.xmat[0, body] = turn.as_matrix().ravel()
            now.xpos[0, mug], now.xipos[0, mug] = here, here + [0.0, 0.0, 0.025]
            found[edge, by] = bool(ours.holds(*ours.boxes())[0])
            assert found[edge, by] == (sign * by < 0.0)


def test_every_world_is_judged_as_if_it_were_alone(env):
    """Verdicts of many worlds, over several looks, are those of one world each; in some of them it succeeds."""
    task = parse_task("beside:mug:left_of:plate")
    states = Worlds(env.simulation.world, 200)
    states.put(np.random.default_rng(0), (), 0.0).take_start(states.everyone)
    judge = task.judge(states)
    alone = []
    looks = [states.put(np.random.default_rng(seed), ("mug",), 0.3).snapshot for seed in (1, 2)]
    # The second state lasts.
    for look in (looks[0], looks[1], looks[1]):
        states.snapshot = look
        together = judge.update(np.full(states.count, 0.5))
        for number in range(0, states.count, 7):
            if len(alone) <= number // 7:
                one = states.alone(number)
                alone.append((one, task.judge(one)))
            one, own = alone[number // 7]
            one.snapshot = states.alone(number).snapshot
            single = own.update(np.array([0.5]))
            assert single.of(0, env.scene) == together.of(number, env.scene)
    assert 0 < together.success.sum() < states.count
    assert (together.progress[together.success] == 1.0).all()


@pytest.mark.parametrize("relation", AWAY)
def test_what_rests_in_its_relation_for_half_a_second_is_there(env, relation):
    """On that side of the plate, and on none of the others."""
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    way = 0.15 * np.array(AWAY[relation])
    info = put(env, "mug", (-0.1 + way[0], 0.05 + way[1], GAP))
    is_left = relation == "left_of"
    assert info["predicates"]["there"] is is_left
    assert info["predicates"]["left_of"] is is_left
    assert not info["success"], "it has to rest"
    assert rest(env)["success"] is is_left


def test_progress_grows_on_the_way_and_the_goal_is_beside_the_plate(env):
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    start, goal = env.verdict.progress, np.array(env.verdict.goal)
    assert env.verdict.target == "mug"
    assert goal[0] < -0.1 - 0.06 - 0.02
    assert goal[2] == pytest.approx(0.025, abs=1e-3)
    seen = [start]
    for x in (0.1, -0.0, -0.05):
        seen.append(put(env, "mug", (x, -0.2, GAP))["progress"])
    seen.append(put(env, "mug", (*goal[:2], GAP))["progress"])
    assert seen == sorted(seen)
    assert rest(env)["progress"] == 1.0


def test_what_is_held_in_the_air_or_on_its_side_or_stacked_is_not_there(env):
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    high = put(env, "mug", (-0.25, 0.05, 0.15))["predicates"]
    assert high["left_of"]
    assert not high["same surface"]
    assert not high["there"]
    lying = math.sqrt(0.5)
    info = put(env, "mug", (-0.25, 0.05, 0.02 + GAP), (lying, lying, 0.0, 0.0))["predicates"]
    assert info["left_of"]
    assert not info["upright"]
    assert not info["there"]
    assert not rest(env)["success"]
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    put(env, "lid", (0.22, 0.2, GAP))
    # On the jar, which is left of the plate.
    info = put(env, "mug", (-0.25, -0.2, 0.05 + 2 * GAP))["predicates"]
    assert not info["same surface"]
    assert not rest(env)["success"]


def test_what_the_robot_touches_is_not_let_go(env):
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    put(env, "mug", (-0.25, 0.05, GAP))
    judge = env.task.judge(env.simulation.states)
    now, number = env.simulation.states.snapshot, OWNERS + env.simulation.states.numbers["mug"]
    assert judge.update(np.array([0.5])).success[0]
    now.touching[0, OWNERS - 1, number] = now.touching[0, number, OWNERS - 1] = True
    assert not judge.update(np.array([0.5])).success[0]


def test_a_surface_carries_what_touches_it_as_high_as_the_landmark_stands(env, on_board):
    """Neither what hovers a little above the table or beside the board does, nor a plate that is lifted."""
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    put(env, "mug", (-0.25, 0.05, GAP))
    judge, now = env.task.judge(env.simulation.states), env.simulation.states.snapshot
    assert judge.update(np.zeros(1)).predicates["same surface"][0]
    plate = env.simulation.world.bodies["plate"]
    now.xpos[0, plate, 2] += 0.02
    assert not judge.update(np.zeros(1)).predicates["same surface"][0]
    now.xpos[0, plate, 2] -= 0.02
    number = OWNERS + env.simulation.states.numbers["mug"]
    now.touching[0, SUPPORT_ROW, number] = now.touching[0, number, SUPPORT_ROW] = False
    assert not judge.update(np.zeros(1)).predicates["same surface"][0]
    on_board.reset(seed=0)
    goals = on_board.task.goals(on_board.simulation.state, ("mug",))
    assert [goal.height for goal in goals] == pytest.approx([0.02] * len(goals), abs=1e-3)


def test_a_step_of_a_chain_begins_where_the_landmark_is_then(env):
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    judge = env.task.judge(env.simulation.states)
    assert judge.update(np.zeros(1)).predicates["landmark stays"][0]
    put(env, "plate", (0.0, 0.2, GAP))
    assert not judge.update(np.zeros(1)).predicates["landmark stays"][0]
    judge.begin(np.array([0]))
    assert judge.update(np.zeros(1)).predicates["landmark stays"][0]


def test_moving_the_landmark_instead_does_not_count(env):
    """The plate goes to the right of the mug: the mug is left of it, and nothing is paid for that."""
    env.reset(seed=0, options={"task": "beside:mug:left_of:plate"})
    put(env, "mug", (0.05, -0.28, GAP))
    info = put(env, "plate", (0.25, -0.28, GAP))
    assert info["predicates"]["there"]
    assert not info["predicates"]["landmark stays"]
    assert info["progress"] == 0.0
    assert not rest(env)["success"]
    assert env.reset(seed=0)[1]["predicates"]["landmark stays"], "the next episode begins anew"


def test_on_a_board_the_table_beside_it_is_another_surface(on_board):
    """The plate stands on a board: the mug has to get onto that."""
    on_board.reset(seed=0)
    beside = put(on_board, "mug", (0.25, 0.05, GAP))["predicates"]
    assert beside["right_of"]
    assert not beside["same surface"]
    info = put(on_board, "mug", (0.05, 0.05, 0.02 + 2 * GAP))
    assert info["predicates"]["there"]
    assert rest(on_board)["success"]


CHAIN = "chain:beside:mug:left_of:plate:then:place:lid:plate"


def test_an_earlier_step_that_is_undone_is_not_kept(env):
    env.reset(seed=0, options={"task": CHAIN})
    put(env, "mug", (-0.26, 0.05, GAP))
    info = rest(env, 15)
    assert info["predicates"]["step 1: beside:mug:left_of:plate"]
    info = put(env, "mug", (0.2, 0.05, GAP))
    assert not info["predicates"]["kept"]
    put(env, "lid", (-0.1, 0.05, 0.03 + 2 * GAP))
    assert not rest(env)["success"]
    put(env, "mug", (-0.26, 0.05, GAP))
    assert rest(env)["success"]


def test_left_and_front_are_those_of_the_viewer_at_minus_y():
    """Written out: x and y of unit boxes, without the table of sides."""

    def at(x: float, y: float) -> Box:
        return Box(np.array([x - 0.5, y - 0.5, 0.0]), np.array([x + 0.5, y + 0.5, 1.0]))

    for relation, (x, y) in AWAY.items():
        holds = {other: bool(on_side(other, at(3.0 * x, 3.0 * y), at(0.0, 0.0)).holds) for other in AWAY}
        assert holds == {other: other == relation for other in AWAY}


@pytest.mark.parametrize("relation", ["left_of", "behind"])
def test_the_scripted_policy_puts_it_there(env, relation):
    info = scripted(env, f"beside:mug:{relation}:plate")
    assert info["success"], info
    assert info["predicates"]["upright"]


def test_the_scripted_policy_puts_it_onto_the_board(on_board):
    info = scripted(on_board, "beside:mug:right_of:plate")
    assert info["success"], info


@pytest.mark.slow
def test_the_scripted_policy_does_a_chain_of_it(env):
    info = scripted(env, "chain:beside:mug:left_of:plate:then:place:lid:plate")
    assert info["success"], info
