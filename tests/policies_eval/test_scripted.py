"""The scripted policy in a world of one moving point: a hand that goes where it is told, and a block it carries.

Nothing but the policy's own decisions is tested here: how high it passes, when it gives up, when it lets go.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.assets import catalogue
from pat3d.assets.shapes import box, join
from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.robots.robot import Gripper
from pat3d.envs.tasks.moves import ABOVE, DROP_HEIGHT, RELEASE, Move, Planner
from pat3d.errors import EnvironmentSetupError
from pat3d.policies_eval.policies import scripted
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from tests.scenes import asset_of, placed, scene_of

WIDTH, HEIGHT, BITE = 0.04, 0.10, 0.05
"""Of the block, and how deep it is between the fingers [m]."""

GRIPPER = Gripper(
    opening=0.08,
    closed=0.0,
    finger_thickness=0.01,
    finger_width=0.02,
    tip=0.01,
    palm=0.06,
    hand=(0.2, 0.06),
    pad=0.02,
    closing_axis=(0.0, 1.0, 0.0),
    open_joints=(0.04, -0.04),
    closed_joints=(0.0, 0.0),
)

GOAL = (0.9, 0.0, 0.0)


@dataclass
class World:
    """The block stands at the origin; the fingers' width and the hand follow commands at constant speeds."""

    hand: np.ndarray
    """[m]"""
    walls: tuple[tuple[float, float], ...] = ()
    """Position along x and height [m]; 2 cm thick and 60 cm wide."""
    wide: float = WIDTH
    """Of the block along y [m]."""
    speed: float = 0.02
    """[m] a step"""
    limit: float = np.inf
    """Beyond this x the hand cannot go [m]."""
    sticky: bool = False
    """What was held stays on a finger."""
    spot: tuple[float, float, float] | None = GOAL
    lean: float = 0.0
    """Of the grasp [rad]."""
    rest: int = 0
    """Looks at what was let go until it is still."""

    def __post_init__(self):
        # Corners of the core are nearer to the hand than those of the whole.
        block = placed("block", asset_of(join(box(WIDTH, self.wide, HEIGHT), box(WIDTH / 2, WIDTH / 2, HEIGHT))))
        walls = [
            placed(f"wall {k}", asset_of(box(0.02, 0.6, height)), (x, 0, 0)) for k, (x, height) in enumerate(self.walls)
        ]
        self.scene = scene_of(block, *walls)
        self.width, self.shift, self.grip = GRIPPER.opening, np.zeros(3), None
        self.command = (self.hand.copy(), -1.0)
        self.touches = lambda name, other: False

    def points(self, name):
        obj = self.scene[name]
        points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])
        return points + (self.shift if name == "block" else 0.0)

    def lowest(self):
        return float(self.points("block")[:, 2].min())

    def centre(self, name):
        return self.points(name).mean(axis=0)

    def step(self):
        (target, fingers), before = self.command, self.hand.copy()
        way = target - self.hand
        self.hand = self.hand + way * min(1.0, self.speed / max(float(np.linalg.norm(way)), 1e-12))
        self.hand[0] = min(self.hand[0], self.limit)
        at_block = np.linalg.norm(self.hand - self.centre("block") - (0, 0, HEIGHT / 2 - BITE + GRIPPER.tip)) < 0.01
        self.width = float(np.clip(self.width - 0.004 * fingers, WIDTH if at_block or self.grip else 0.0, 0.08))
        self.grip = (at_block or self.grip) and self.width <= WIDTH + 1e-9
        if self.grip:
            self.shift = self.shift + self.hand - before

    def still(self, name):
        self.rest -= 1
        return self.rest < 0

    @property
    def env(self):
        state = SimpleNamespace(
            hand=self.hand,
            hand_rotation=np.eye(3),
            points=self.points,
            centre=self.centre,
            start_centre=lambda name: np.array([0.0, 0.0, HEIGHT / 2]),
            touched=lambda name: bool(self.grip) or self.sticky,
            touch=lambda name, other: self.touches(name, other),
            still=self.still,
        )
        simulation = SimpleNamespace(state=state, fingers=np.array([self.width, -self.width]) / 2)
        return SimpleNamespace(
            control="osc",
            robot="",
            task=SimpleNamespace(kind="pick", opening=lambda *_: None),
            scene=self.scene,
            simulation=simulation,
            placement=SimpleNamespace(surface=0.0, grasps={}),
        )


class Servo:
    """Hands the policy's commands to the world."""

    def __init__(self, env):
        self.world = env.world

    def towards(self, position, rotation, fingers):
        self.world.command = (np.array(position), fingers)
        return np.zeros(7, np.float32), float(np.linalg.norm(position - self.world.hand))


class OneMove(Planner):
    """Plans one move of the block, and then nothing; everything else as the real planner does it."""

    def __init__(self, env, spot, lean):
        self._env, self._gripper, self._left, self._lean = env, GRIPPER, [spot], lean
        self.put: set[str] = set()

    def next(self, failures):
        if not self._left:
            return None
        spot = self._left.pop()
        tips = (0.0, 0.0, HEIGHT - BITE)
        at = np.array(tips) + (0.0, 0.0, GRIPPER.tip)
        grasp = Grasp(position=tips, closing=0.0, bite=BITE, score=1.0, width=WIDTH, lean=self._lean)
        up = np.array([0.0, 0.0, HOVER])
        return Move(
            name="block",
            grasp=grasp,
            rotation=np.eye(3),
            before=at + up,
            at=at,
            spot=None if spot is None else np.array(spot),
        )


class Live:
    """The environment as it is now, whenever it is asked for something."""

    def __init__(self, world):
        self.world = world

    def __getattr__(self, name):
        return getattr(self.world.env, name)


class Policy(ScriptedPolicy):
    def _plan(self):
        return OneMove(self._env, self._env.world.spot, self._env.world.lean)


@pytest.fixture
def trace(monkeypatch):
    """Runs the policy in a world until it waits; what was seen after every step."""
    monkeypatch.setattr(scripted, "Servo", Servo)
    monkeypatch.setattr(scripted, "measure_gripper", lambda robot: GRIPPER)

    def run(world, steps=600):
        policy, rows = Policy(), []
        start = EpisodeStart(
            instruction="", task="", seed=0, robot="", control="osc", action_size=7, control_freq=20.0, env=Live(world)
        )
        policy.reset(start)
        while policy._phase != "wait" and len(rows) < steps:
            assert policy.act({}).shape == (7,)
            if policy._phase == "wait":
                break
            world.step()
            row = SimpleNamespace(phase=policy._phase, hand=world.hand.copy(), tip=world.hand[2] - GRIPPER.tip)
            row.width, row.block, row.grip = world.width, world.points("block"), bool(world.grip)
            rows.append(row)
        return rows

    return run


def phases(rows):
    """Phases in their order."""
    return [row.phase for k, row in enumerate(rows) if k == 0 or rows[k - 1].phase != row.phase]


def start(x=-0.5, z=0.1):
    return np.array([x, 0.0, z])


def test_the_block_is_taken_over_a_wall_carried_over_another_and_put_down_where_it_belongs(trace):
    rows = trace(World(start(), walls=((-0.25, 0.3), (0.45, 0.2))))
    assert phases(rows) == [
        *("rise", "across", "hover", "descend", "close", "lift", "carry", "lower", "open", "withdraw", "settle")
    ]
    block = rows[-1].block
    np.testing.assert_allclose(block.mean(axis=0)[:2], GOAL[:2], atol=scripted.EXACT)
    assert block[:, 2].min() == pytest.approx(GOAL[2] + DROP_HEIGHT, abs=scripted.EXACT)
    assert any(row.grip for row in rows)
    assert not rows[-1].grip


@pytest.mark.parametrize("height", [0.01, 0.1, 0.3, 0.6])
def test_an_empty_hand_passes_above_what_is_on_its_way_and_no_lower_than_where_it_comes_down(trace, height):
    rows = trace(World(start(), walls=((-0.25, height),)))
    across = [row for row in rows if row.phase == "across"]
    assert len(across) > 5
    above = [row.tip - height for row in across if abs(row.hand[0] + 0.25) < scripted.HAND_RADIUS]
    assert min(above) > scripted.PASSING - scripted.NEAR
    assert min(row.hand[2] for row in across) >= HEIGHT - BITE + GRIPPER.tip + HOVER - scripted.NEAR
    # As high as needed and no higher.
    lowest_needed = max(height + scripted.PASSING, HEIGHT - BITE + HOVER)
    assert max(row.tip for row in across) <= lowest_needed + 1e-9


def test_a_hand_that_comes_nearer_slowly_arrives_and_one_that_does_not_is_given_up_soon(trace):
    """A step of 1.5 mm is 15 mm in as many as are looked at; 0.1 mm is less than counts as coming nearer."""
    beside, high = -0.09, HEIGHT - BITE + GRIPPER.tip + HOVER
    for speed, arrives in ((1.5e-3, True), (1.2e-3, True), (1e-4, False)):
        rows = trace(World(start(beside, high), speed=speed), steps=60)
        across = [row for row in rows if row.phase == "across"]
        distance = abs(across[-1].hand[0])
        if arrives:
            assert distance < scripted.ON_THE_WAY + 2 * speed
        else:
            assert len(across) == scripted.STUCK_STEPS


def test_a_hand_that_something_stops_on_its_way_goes_on_with_the_next_phase(trace):
    rows = trace(World(start(-0.3, 0.2), limit=-0.2), steps=60)
    stopped = [row for row in rows if row.phase == "across" and row.hand[0] == -0.2]
    assert scripted.STUCK_STEPS - 1 <= len(stopped) <= scripted.STUCK_STEPS + 1
    assert "hover" in phases(rows)


@pytest.mark.parametrize("wide", [WIDTH, 0.3, 0.5])
@pytest.mark.parametrize("side", [0.0, 0.2, -0.2])
def test_what_is_carried_passes_above_whatever_is_under_any_of_it(trace, wide, side):
    """A wall 60 cm wide beside the way is in the way of a wide block only."""
    world = World(start(0.0, 0.16), walls=((0.45, 0.25),), wide=wide)
    world.scene = scene_of(
        world.scene["block"], placed("wall 0", world.scene["wall 0"].asset, (0.45, 0.38 * np.sign(side), 0))
    )
    wall = world.points("wall 0")
    rows = [row for row in trace(world) if row.phase in ("lift", "carry")]
    low, high = wall.min(axis=0), wall.max(axis=0)
    clear, over = [], 0
    for row in rows:
        if (row.block.max(axis=0)[:2] > low[:2]).all() and (row.block.min(axis=0)[:2] < high[:2]).all():
            clear.append(row.block[:, 2].min() - high[2])
            over += 1
    assert over > 0 or (side and wide == WIDTH)
    assert not clear or min(clear) > 0.0


@pytest.mark.parametrize("early", [0.003, 0.01])
def test_what_meets_its_place_before_it_was_expected_to_is_not_pushed_further(trace, early):
    """A tray under the spot that is higher than was planned with."""
    spot, speed, top = (0.1, 0.0, 0.0), 0.004, DROP_HEIGHT + early
    world = World(start(0.0, 0.16), speed=speed, spot=spot)
    tray = placed("tray", asset_of(box(0.1, 0.1, 0.001)), spot)
    world.scene, world.touches = scene_of(*world.scene.objects, tray), lambda name, other: world.lowest() <= top
    lower = [row for row in trace(world) if row.phase in ("lower", "open")]
    assert top - speed <= min(row.block[:, 2].min() for row in lower) <= top


def test_what_touches_something_high_above_its_place_is_lowered_all_the_same(trace):
    """It brushes a neighbour all the way down."""
    world = World(start(0.0, 0.16))
    world.touches = lambda name, other: True
    world.scene = scene_of(*world.scene.objects, placed("neighbour", asset_of(box(0.1, 0.1, 0.05)), (2, 2, 0)))
    rows = trace(world)
    assert min(row.block[:, 2].min() for row in rows) < GOAL[2] + DROP_HEIGHT + scripted.NEAR + 1e-9


def test_the_hand_opens_no_wider_than_it_needs_to_let_go(trace):
    opened = [row.width for row in trace(World(start(0.0, 0.16))) if row.phase == "open"]
    assert len(opened) < scripted.OPEN_STEPS
    assert opened[-1] == pytest.approx(WIDTH + RELEASE, abs=0.004 + 1e-9)


def test_a_block_that_sticks_to_a_finger_is_left_after_so_many_steps(trace):
    world = World(start(0.0, 0.16), sticky=True)
    rows = trace(world)
    assert sum(row.phase == "open" for row in rows) == scripted.OPEN_STEPS
    assert "settle" in phases(rows)


def test_the_fingers_are_withdrawn_above_what_they_let_go(trace):
    rows = trace(World(start(0.0, 0.16)))
    last = [row for row in rows if row.phase == "withdraw"][-1]
    assert last.tip > last.block[:, 2].max() - 1e-9
    # Straight up: what stands beside is not swept away.
    sides = [row.hand[:2] for row in rows if row.phase in ("open", "withdraw")]
    assert np.ptp(sides, axis=0).max() < 2 * scripted.EXACT


def test_what_is_to_be_held_is_lifted_until_it_has_risen_and_kept(trace):
    rows = trace(World(start(0.0, 0.16), spot=None), steps=200)
    assert phases(rows)[-1] == "lift"
    rise = rows[-1].block[:, 2].min()
    assert scripted.RISE <= rise <= scripted.HIGHEST_LIFT
    assert rows[-1].grip
    # What is jerked slips.
    heights = np.array([row.tip for row in rows if row.phase == "lift"]) - (HEIGHT - BITE)
    assert (heights <= scripted.LIFT_STEP * np.arange(2, 2 + len(heights)) + 1e-9).all()


def test_a_hand_before_its_grasp_waits_until_it_no_longer_moves_fast_but_not_for_ever(trace):
    """One that shot there is looked at again; one that never gets there goes on when patience ends."""
    before = np.array([0.0, 0.0, HEIGHT - BITE + GRIPPER.tip + HOVER])
    rows = trace(World(start(-0.039, before[2]), speed=0.038))
    away = [float(np.linalg.norm(row.hand - before)) for row in rows if row.phase == "hover"]
    assert [one < scripted.ALIGNED for one in away] == [True, True]
    stopped = trace(World(start(-0.3, 0.2), limit=-0.1), steps=200)
    for phase in ("hover", "descend"):
        assert sum(row.phase == phase for row in stopped) == scripted.PATIENCE


@pytest.mark.parametrize("height", [0.0, 0.1, 0.3])
def test_what_is_put_down_comes_from_well_above_its_place_however_high_that_is(trace, height):
    """Nothing is on the way; where the place is low the hand's own way is higher still."""
    rows = trace(World(start(0.0, 0.16), spot=(0.9, 0.0, height)))
    let_go = next(row for row in rows if row.phase == "open").hand[2]
    arrived = [row for row in rows if row.phase == "carry"][-1].hand[2]
    assert arrived - let_go > ABOVE - scripted.NEAR
    if height >= 0.1:
        assert arrived - let_go < ABOVE + scripted.NEAR


@pytest.mark.parametrize("looks", [1, 5, 100])
def test_what_was_let_go_is_waited_for_until_it_is_still_but_not_for_ever(trace, looks):
    rows = trace(World(start(0.0, 0.16), rest=looks))
    waited = [row for row in rows if row.phase == "settle"]
    assert len(waited) == min(looks + 1, scripted.SETTLE_STEPS)
    # The hand stays where it was withdrawn to.
    assert np.ptp([row.hand for row in waited], axis=0).max() < scripted.NEAR


class Path:
    """Stands for the planner of ways of the hand: some places on the way, or none."""

    def __init__(self, places, planned):
        self.places, self.planned = places, planned

    def __call__(self, env):
        return self

    def through(self, goals):
        self.planned.append(goals)
        return None if self.places is None else [(np.array(place), goals[-1][1]) for place in self.places]


def led(monkeypatch, trace, world, places):
    """Rows of the phase before a leaning hand hovers, and how often its way was planned."""
    planned = []
    monkeypatch.setattr(scripted, "HandPath", Path(places, planned))
    rows = trace(world, steps=300)
    return rows, [row for row in rows if row.phase == "over"], planned


WAY = ((-0.2, 0.2, 0.4), (0.0, 0.3, 0.4), (0.1, 0.1, 0.3))


def test_a_leaning_hand_passes_all_places_of_a_way_that_is_planned_once(monkeypatch, trace):
    rows, over, planned = led(monkeypatch, trace, World(start(-0.3, 0.1), lean=0.5), WAY)
    assert phases(rows)[:3] == ["rise", "over", "hover"]
    assert len(planned) == 1
    nearest = [np.linalg.norm([row.hand - np.array(place) for row in over], axis=1) for place in WAY]
    assert max(one.min() for one in nearest) < scripted.ON_THE_WAY + 0.02
    assert np.all(np.diff([int(one.argmin()) for one in nearest]) > 0)
    # The way begins above where the hand comes from and ends there.
    (above, _), (before, _) = planned[0]
    np.testing.assert_array_equal(above[:2], before[:2])
    assert above[2] > before[2]


def test_every_place_of_the_way_that_is_never_reached_is_given_up_when_patience_ends(monkeypatch, trace):
    """One step is the phase's first, or the one in which the place before was passed."""
    _, over, planned = led(monkeypatch, trace, World(start(-0.3, 0.1), limit=-0.3, lean=0.5), WAY)
    assert len(planned) == 1
    assert 3 * (scripted.PATIENCE - 1) <= len(over) <= 3 * (scripted.PATIENCE + 1)


def test_a_leaning_hand_without_a_way_goes_straight_to_where_it_hovers(monkeypatch, trace):
    rows, over, planned = led(monkeypatch, trace, World(start(-0.3, 0.1), lean=0.5), None)
    assert (over, len(planned)) == ([], 1)
    assert phases(rows)[:3] == ["rise", "hover", "descend"]


def test_it_says_that_it_puts_nothing_into_what_is_open_in_front():
    scene = {"microwave": SimpleNamespace(asset=catalogue.make("open microwave", seed=0))}
    task = "chain:pick:mug:then:place:mug:microwave"
    start = EpisodeStart(instruction="", task=task, seed=0, robot="panda", control="osc", action_size=7,
                         control_freq=20.0, env=SimpleNamespace(control="osc", scene=scene))  # fmt: skip
    with pytest.raises(EnvironmentSetupError, match='"microwave" is open in front alone'):
        ScriptedPolicy().reset(start)
