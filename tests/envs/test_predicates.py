"""Judging many worlds: predicates against their definition written out, and every world as if it were alone."""

from __future__ import annotations

import math

import numpy as np
import pytest

pytest.importorskip("robosuite")
pytest.importorskip("gymnasium")

import mujoco
from scipy.spatial.transform import Rotation

from pat3d.envs.observations import Observer
from pat3d.envs.physics import predicates
from pat3d.envs.physics.predicates import CONTACT_DEPTH, OWNERS, UPRIGHT_DEGREES, pairs_that, upsets
from pat3d.envs.physics.snapshot import REGION_MARGIN, Snapshot, floors
from pat3d.envs.physics.state import SimState, States
from pat3d.envs.tasks.judges import SortJudge
from pat3d.envs.tasks.registry import parse_task

WORLDS = 500
PAIRS = [("green apple", "blue bowl"), ("banana", "blue bowl"), ("red mug", "wooden tray"), ("banana", "red mug")]


class Given(States):
    """Worlds in states that a test makes up."""

    def refresh(self) -> None:
        """There is nothing to read."""

    def put(self, random: np.random.Generator) -> Given:
        """Random poses around the scene's own: upright, leaning and upside down, near and far; random contacts."""
        scene, worlds, model = self.world.scene, self.count, self.world.model
        count = OWNERS + len(scene.objects)
        xpos, xipos = np.zeros((worlds, model.nbody, 3)), np.zeros((worlds, model.nbody, 3))
        xmat, xquat = np.zeros((worlds, model.nbody, 9)), np.zeros((worlds, model.nbody, 4))
        xquat[..., 0] = 1.0
        spread = random.choice([0.003, 0.03, 0.15], size=worlds)
        for obj in scene.objects:
            body, centre = self.world.bodies[obj.name], np.array(obj.asset.mass_properties.centre_of_mass)
            angle = random.choice([0.0, 0.1, 0.5, 0.6, 2.0], size=worlds)
            axis = random.standard_normal((worlds, 3))
            turn = Rotation.from_rotvec(axis * (angle / np.linalg.norm(axis, axis=1))[:, None])
            turn = turn * Rotation.from_quat(obj.pose.quat_wxyz, scalar_first=True)
            # Around where the object is, or around the bowl.
            home = np.where(random.random((worlds, 1)) < 0.5, obj.pose.position, scene["blue bowl"].pose.position)
            xpos[:, body] = home + random.standard_normal((worlds, 3)) * spread[:, None]
            xmat[:, body] = turn.as_matrix().reshape(worlds, 9)
            xquat[:, body] = turn.as_quat(scalar_first=True)
            xipos[:, body] = xpos[:, body] + turn.apply(centre)
        touching = random.random((worlds, count, count)) < 0.3
        self.qpos, self.xquat = random.standard_normal((worlds, model.nq)), xquat
        self.snapshot = Snapshot(
            xpos=xpos,
            xmat=xmat,
            xipos=xipos,
            qvel=random.standard_normal((worlds, model.nv)) * random.choice([1e-3, 0.03, 1.0], size=(worlds, 1)),
            sites=random.standard_normal((worlds, model.nsite, 3)),
            site_xmat=Rotation.random(worlds * model.nsite, random).as_matrix().reshape(worlds, model.nsite, 9),
            touching=touching | touching.transpose(0, 2, 1),
            pinched=random.random((worlds, 2, count)) < 0.5,
            **self._about,
        )
        return self

    def alone(self, number: int) -> Given:
        """One of the worlds."""
        one = Given(self.world, 1)
        own = slice(number, number + 1)
        one.qpos, one.xquat = self.qpos[own].copy(), self.xquat[own].copy()
        kept = {
            name: value[own].copy()
            for name, value in self.snapshot._asdict().items()
            if name not in ("bodies", "dofs", "hand", "surface", "grips")
        }
        one.snapshot = self.snapshot._replace(**kept)
        return one


def _given(env, seed: int) -> Given:
    states = Given(env.simulation.world, WORLDS)
    random = np.random.default_rng(seed)
    states.put(random).take_start(states.everyone)
    return states.put(random)


def _by_definition(states: Given, number: int, child: str, parent: str, kind: str) -> bool:
    """The sentences of the README and of the docstrings, one after the other, with every corner."""
    state = SimState(states, number)
    region = state.scene[parent].asset.region(kind)
    if region is None or state.tilt(parent) > UPRIGHT_DEGREES:
        return False

    def local(points):
        return (points - state.position(parent)) @ state.rotation(parent)

    def over(point) -> bool:
        x, y = np.abs(point[:2] - np.array(region.floor[:2]))
        if region.shape == "disc":
            return math.hypot(x, y) <= region.half_size[0] + REGION_MARGIN
        return x <= region.half_size[0] + REGION_MARGIN and y <= region.half_size[1] + REGION_MARGIN

    points, centre = local(state.points(child)), local(state.centre(child)[None])[0]
    lowest = points[int(np.argmin(points[:, 2]))]
    if kind == "on":
        return state.touch(child, parent) and over(centre) and lowest[2] > region.floor[2] - CONTACT_DEPTH
    below = lowest[2] < region.floor[2] + region.height
    return bool((over(centre) or over(lowest)) and below and centre[2] > region.floor[2] - CONTACT_DEPTH)


@pytest.mark.parametrize("kind", ["in", "on"])
def test_in_and_on_agree_with_their_definition_in_random_poses(env, kind):
    states = _given(env, seed=0)
    found = pairs_that(states.snapshot, floors(states.world, PAIRS, kind), kind == "in")
    wanted = [[_by_definition(states, number, *pair, kind) for pair in PAIRS] for number in range(WORLDS)]
    np.testing.assert_array_equal(found, wanted)
    # The poses decide: neither answer is rare.
    assert 10 < found.sum() < found.size - 10


@pytest.mark.parametrize("disc", [False, True])
def test_an_object_is_over_a_floor_up_to_the_margin_and_not_a_bit_further(env, disc):
    """In contact, and the centre of mass just inside and just outside of the edge: a rectangle's, and a disc's."""
    states = Given(env.simulation.world, 2).put(np.random.default_rng(0))
    scene, now = states.world.scene, states.snapshot
    region = scene["wooden tray"].asset.region("on")
    apple, centre = states.world.bodies["green apple"], scene["green apple"].asset.mass_properties.centre_of_mass
    now.touching[:], now.xmat[:], now.xpos[:] = True, np.eye(3).reshape(9), 0.0
    for number, shift in enumerate((-1e-9, 1e-9)):
        edge = region.floor[0] + region.half_size[0] + REGION_MARGIN + shift
        now.xipos[number, apple] = [edge, region.floor[1], region.floor[2] + 0.05]
    now.xpos[:, apple] = now.xipos[:, apple] - np.array(centre)
    states.take_start(states.everyone)
    floor = floors(states.world, [("green apple", "wooden tray")], "on")._replace(disc=np.array([disc]))
    found = pairs_that(now, floor, False)[:, 0]
    np.testing.assert_array_equal(found, [True, False])


def test_a_container_holds_up_to_thirty_degrees(env):
    """The whole scene turned about the bowl by a hair less and a hair more than the angle."""
    states = Given(env.simulation.world, 2).put(np.random.default_rng(0))
    now, scene = states.snapshot, states.world.scene
    for obj in scene.objects:
        body = states.world.bodies[obj.name]
        now.xpos[:, body], now.xmat[:, body] = obj.pose.position, obj.pose.rotation.reshape(9)
        centre = np.array(obj.asset.mass_properties.centre_of_mass)
        now.xipos[:, body] = obj.pose.apply(centre[None])[0]
    bowl, apple = states.world.bodies["blue bowl"], states.world.bodies["green apple"]
    region = scene["blue bowl"].asset.region("in")
    states.take_start(states.everyone)
    for number, degrees in enumerate((UPRIGHT_DEGREES - 1e-6, UPRIGHT_DEGREES + 1e-6)):
        turn = Rotation.from_rotvec([math.radians(degrees), 0.0, 0.0]).as_matrix() @ scene["blue bowl"].pose.rotation
        now.xmat[number, bowl] = turn.reshape(9)
        middle = np.array(region.floor) + [0.0, 0.0, region.height / 2]
        now.xipos[number, apple] = now.xpos[number, bowl] + turn @ middle
    found = pairs_that(now, floors(states.world, [("green apple", "blue bowl")], "in"), True)[:, 0]
    np.testing.assert_array_equal(found, [True, False])


def _judges(states: States):
    for spec in (
        "pick:red mug",
        "place:green apple:blue bowl",
        "place:green apple:wooden tray",
        "stack:banana:red mug",
        "unload:wooden tray",
        "retrieve:wooden tray",
    ):
        yield parse_task(spec).judge(states)
    yield SortJudge(states, {"green apple": "blue bowl", "banana": "red mug"})


def test_many_worlds_are_judged_as_each_of_them_alone(env):
    """Every task, bit for bit, over several steps: what one world does leaves no trace in another."""
    states, seconds = _given(env, seed=1), 0.3
    some = range(0, WORLDS, 50)
    together = list(_judges(states))
    singles = {number: list(_judges(states.alone(number))) for number in some}
    random = np.random.default_rng(2)
    successes = 0
    for step in range(6):
        if step % 3 == 0:
            states.put(random)
        found = [judge.update(np.full(WORLDS, seconds)) for judge in together]
        successes += sum(int(verdicts.success.sum()) for verdicts in found)
        for number in some:
            alone = states.alone(number)
            for judge, verdicts in zip(singles[number], found, strict=True):
                for lift in (judge, getattr(judge, "_lift", judge)):
                    lift.states = alone
                one = judge.update(np.array([seconds])).of(0, states.world.scene)
                assert one == verdicts.of(number, states.world.scene)
    assert successes > 0


def test_an_episode_that_starts_again_forgets_time_and_failures_and_the_others_do_not(env):
    states = Given(env.simulation.world, 2).put(np.random.default_rng(0))
    now, mug = states.snapshot, states.numbers["red mug"]
    states.take_start(states.everyone)
    now.xipos[:, states.bodies[mug], 2] += 0.2
    now.touching[:], now.pinched[:] = True, True
    now.touching[:, predicates.FLOOR_ROW] = False
    judge = parse_task("retrieve:red mug").judge(states)
    assert judge.update(np.full(2, 0.6)).predicates["lifted"].all()
    now.xipos[:, states.bodies[states.numbers["banana"]], 2] -= 0.5
    now.touching[:, predicates.FLOOR_ROW] = True
    after = judge.update(np.full(2, 0.6))
    assert after.predicates["held"].all()
    assert not after.success.any()
    now.xipos[:, states.bodies[states.numbers["banana"]], 2] += 0.5
    judge.begin(np.array([1]))
    again = judge.update(np.full(2, 0.6))
    np.testing.assert_array_equal(again.predicates["held"], [True, False])
    np.testing.assert_array_equal(again.predicates["nothing toppled"], [False, True])


def test_what_toppled_and_fell_is_what_a_single_world_says(env):
    states = _given(env, seed=3)
    turned, dropped = upsets(states.snapshot)
    assert turned.any()
    assert dropped.any()
    names = [obj.name for obj in states.world.scene.objects]
    surface = env.placement.surface - predicates.EDGE
    for number in range(0, WORLDS, 10):
        state = SimState(states, number)
        toppled = [name for name in names if state.tilt(name) > 30.0 and not state.held(name)]
        assert state.named(turned) == toppled
        for name in state.named(dropped):
            fallen = state.start_centre(name)[2] - state.centre(name)[2]
            assert fallen > 0.0
            assert state.centre(name)[2] < surface or fallen > predicates.DROP


def test_many_worlds_are_observed_as_each_of_them_alone(env):
    states = _given(env, seed=4)
    observer = Observer(env._spec, states.world)
    judge = SortJudge(states, {"green apple": "blue bowl", "banana": "red mug"})
    seen = observer.observe(states, judge.update(np.zeros(WORLDS)))
    for number in range(0, WORLDS, 50):
        alone = states.alone(number)
        judge = SortJudge(alone, {"green apple": "blue bowl", "banana": "red mug"})
        single = observer.observe(alone, judge.update(np.zeros(1)))
        for name, values in seen.items():
            np.testing.assert_array_equal(values[number], single[name][0])


def test_the_hand_s_orientation_is_that_of_its_site(env):
    """MuJoCo's own conversion of the site's matrix is the oracle; float32 is the observation's precision."""
    random = np.random.default_rng(0)
    env.reset(seed=0, options={"task": "pick:red mug"})
    for _ in range(20):
        observation, *_ = env.step(random.uniform(-1.0, 1.0, 7))
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, env.simulation.state.hand_rotation.reshape(-1))
        quat *= np.sign(quat[np.argmax(np.abs(quat))])
        np.testing.assert_allclose(observation["eef_quat"], quat, atol=1e-7)


def test_a_break_starts_the_second_of_a_lift_anew(env):
    states = Given(env.simulation.world, 1).put(np.random.default_rng(0))
    now, mug = states.snapshot, states.numbers["red mug"]
    states.take_start(states.everyone)
    now.xipos[:, states.bodies[mug], 2] += 0.2
    judge = parse_task("pick:red mug").judge(states)

    def lasts(touching: bool) -> bool:
        now.touching[:] = touching
        return bool(judge.update(np.array([0.6])).success[0])

    assert [lasts(touching) for touching in (True, False, True, True)] == [False, False, False, True]


def test_the_next_object_to_sort_is_the_first_that_is_not_at_home(env):
    states = _given(env, seed=5)
    pairs = {"green apple": "blue bowl", "banana": "red mug", "red mug": "blue bowl"}
    found = SortJudge(states, pairs).update(np.zeros(WORLDS))
    there = pairs_that(states.snapshot, floors(states.world, list(pairs.items()), "in"), True)
    assert len(np.unique(there, axis=0)) > 2, "the poses decide"
    for number in range(WORLDS):
        missing = [name for name, home in zip(pairs, there[number], strict=True) if not home]
        verdict = found.of(number, states.world.scene)
        assert verdict.target == (missing or list(pairs))[0]
        np.testing.assert_array_equal(verdict.goal, SimState(states, number).position(pairs[verdict.target]))


def _resting(env, count: int) -> tuple[Given, int, int]:
    """Worlds in which everything is as in the scene and touches nothing, with the body and the number of the mug."""
    states = Given(env.simulation.world, count).put(np.random.default_rng(0))
    now, scene = states.snapshot, states.world.scene
    for obj in scene.objects:
        body = states.world.bodies[obj.name]
        now.xpos[:, body], now.xmat[:, body] = obj.pose.position, obj.pose.rotation.reshape(9)
        now.xipos[:, body] = obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0]
    now.touching[:], now.pinched[:], now.qvel[:] = False, False, 0.0
    states.take_start(states.everyone)
    return states, states.world.bodies["red mug"], states.numbers["red mug"]


def test_what_touches_the_floor_fell_when_it_is_five_centimetres_below_its_start(env):
    """Still above the surface of the work: alone the floor's touch decides, beyond the drop and not before it."""
    states, body, mug = _resting(env, 4)
    now, floor = states.snapshot, predicates.FLOOR_ROW
    now.start_centre[:, mug, 2] = now.surface + 1.0
    now.xipos[:, body, 2] = now.surface + 1.0 - np.array([0.05 - 1e-9, 0.05 + 1e-9, 0.05 + 1e-9, 0.0])
    now.touching[[0, 1, 3], floor, OWNERS + mug] = now.touching[[0, 1, 3], OWNERS + mug, floor] = True
    np.testing.assert_array_equal(upsets(now)[1][:, mug], [False, True, False, False])


def test_what_is_below_the_surface_of_the_work_fell_unless_it_always_was(env):
    """By a centimetre of slack under the surface, whether it has reached the floor or not."""
    states, body, mug = _resting(env, 3)
    now = states.snapshot
    assert now.surface == env.placement.surface - 0.01
    now.start_centre[:, mug, 2] = now.surface + np.array([0.001, 0.001, -0.001])
    now.xipos[:, body, 2] = now.surface + np.array([1e-9, -1e-9, -0.3])
    np.testing.assert_array_equal(upsets(now)[1][:, mug], [False, True, False])


def test_what_spins_on_the_spot_is_not_at_rest(env):
    """Five centimetres and half a radian a second, a hair less and a hair more, along and about every axis."""
    states, _, mug = _resting(env, 12)
    now, first = states.snapshot, states.snapshot.dofs[mug]
    for axis in range(3):
        for k, shift in enumerate((-1e-9, 1e-9)):
            now.qvel[4 * axis + k, first + axis] = 0.05 + shift
            now.qvel[4 * axis + 2 + k, first + 3 + axis] = 0.5 + shift
    found = [bool(predicates.still(now, number, mug)) for number in range(12)]
    assert found == 6 * [True, False]


def test_progress_of_sorting_is_the_share_at_home_and_how_far_the_next_one_is(env):
    """Two of two at home are all of it; one of two is half, and the way of the other counts for the second half."""
    states, _, _ = _resting(env, 4)
    now, bodies, scene = states.snapshot, states.world.bodies, states.world.scene
    bowl = scene["blue bowl"]
    inside = bowl.pose.apply(np.array([bowl.asset.region("in").floor]) + [0.0, 0.0, 0.02])[0]
    away = inside + [0.6, 0.0, 0.3]

    def put(world: int, name: str, at) -> None:
        shift = at - now.xipos[world, bodies[name]]
        now.xipos[world, bodies[name]] += shift
        now.xpos[world, bodies[name]] += shift

    for world, (apple, banana) in enumerate([(inside, inside), (inside, away), (away, away), (inside, away)]):
        put(world, "green apple", apple)
        put(world, "banana", banana)
    hand = states.hand
    now.sites[:, hand] = [0.0, 0.0, 5.0]
    now.sites[3, hand] = now.xipos[3, bodies["banana"]]
    now.pinched[3, :, OWNERS + states.numbers["banana"]] = True
    judge = SortJudge(states, {"green apple": "blue bowl", "banana": "blue bowl"})
    progress = judge.update(np.zeros(4)).progress

    def begun(world: int, name: str) -> float:
        """A fifth for the hand's nearness, a fifth for the grasp, half for the nearness of the home."""
        centre = now.xipos[world, bodies[name]]
        near = 1.0 - math.tanh(float(np.linalg.norm(centre - now.sites[world, hand])) / 0.2)
        home = 1.0 - math.tanh(float(np.linalg.norm(centre - now.xpos[world, bodies["blue bowl"]])) / 0.25)
        return 0.2 * near + (0.2 if world == 3 else 0.0) + 0.5 * home

    wanted = [1.0, (1 + begun(1, "banana")) / 2, begun(2, "green apple") / 2, (1 + begun(3, "banana")) / 2]
    np.testing.assert_allclose(progress, wanted, atol=1e-12)
    assert progress[2] < progress[1] < progress[3] < 1.0
