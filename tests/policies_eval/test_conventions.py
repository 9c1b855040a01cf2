"""What is connected wrongly is recognised on the scripted policy with that fault; nothing is said of honest ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from scipy.spatial.transform import Rotation

from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.conventions import Compared, examine, resemblance
from pat3d.policies_eval.analysis.probe import compare_actions
from pat3d.policies_eval.policies.registry import RandomPolicy
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from pat3d.policies_eval.run.episodes import Episode
from pat3d.policies_eval.run.settings import RolloutSettings
from tests.envs.own_arm import own_arm

EPISODES = [Episode(index=k, scene="", task="pick:red mug", seed=k) for k in range(2)]


@pytest.fixture(scope="module")
def settings(tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return RolloutSettings(robot=str(path))


class Wrapped:
    """The scripted policy, whose answers are changed."""

    privileged = True

    def __init__(self, change) -> None:
        self._policy, self._change = ScriptedPolicy(), change

    def reset(self, episode) -> None:
        self._policy.reset(episode)
        self._env, self._random = episode.env, np.random.default_rng(episode.seed)

    def act(self, observation):
        return self._change(np.array(self._policy.act(observation), dtype=float), self._env, self._random)


def honest(action, env, random):
    return action


def noisy(action, env, random):
    """As demonstrators and regressions are."""
    return np.clip(action + 0.15 * random.standard_normal(7), -1.0, 1.0)


def flipped(action, env, random):
    return np.append(action[:6], -action[6])


def from_zero_to_one(action, env, random):
    return np.append(action[:6], (action[6] + 1.0) / 2.0)


def euler(action, env, random):
    angles = Rotation.from_rotvec(0.5 * action[3:6]).as_euler("xyz")
    return np.concatenate([action[:3], angles / 0.5, action[6:]])


def degrees(action, env, random):
    return np.concatenate([action[:3], np.degrees(0.5 * action[3:6]), action[6:]])


def metres(action, env, random):
    return np.concatenate([0.05 * action[:3], action[3:]])


def in_the_hand(action, env, random):
    base = env.simulation.data.site("robot/pat3d/base").xmat.reshape(3, 3)
    frame = base.T @ env.simulation.state.hand_rotation
    return np.concatenate([frame.T @ action[:3], frame.T @ action[3:6], action[6:]])


def in_the_world(action, env, random):
    base = env.simulation.data.site("robot/pat3d/base").xmat.reshape(3, 3)
    return np.concatenate([base @ action[:3], base @ action[3:6], action[6:]])


FAULTS = [
    (flipped, {("gripper", "flipped")}),
    (from_zero_to_one, {("gripper", "0 to 1, closed")}),
    (euler, {("rotation", "euler")}),
    (degrees, {("rotation", "degrees")}),
    (metres, {("position", "metres")}),
    (in_the_hand, {("position", "hand frame"), ("rotation", "hand frame")}),
    (in_the_world, {("position", "world frame"), ("rotation", "world frame")}),
]


@pytest.fixture(scope="module")
def right(settings):
    """The scripted policy beside itself."""
    return compare_actions(Wrapped(honest), EPISODES, settings)


@pytest.mark.parametrize(("fault", "expected"), FAULTS, ids=[fault.__name__ for fault, _ in FAULTS])
def test_a_fault_is_recognised_by_its_name_and_no_other(settings, fault, expected):
    found = examine(compare_actions(Wrapped(fault), EPISODES, settings))
    assert {(one.part, one.fault) for one in found} == expected


@pytest.mark.parametrize("policy", [honest, noisy])
def test_an_honest_policy_passes(settings, policy):
    compared = compare_actions(Wrapped(policy), EPISODES, settings)
    assert examine(compared) == []
    assert min(resemblance(compared).values()) > 0.3


def test_nothing_is_said_of_a_policy_that_resembles_nothing(settings):
    compared = compare_actions(RandomPolicy(), EPISODES, settings)
    assert examine(compared) == []
    assert max(resemblance(compared).values()) < 0.3


def test_several_faults_at_once_are_several_findings(right):
    given = right.given * [1, 1, 1, 1, 1, 1, -1]
    given[:, :3] *= 0.05
    found = {(one.part, one.fault) for one in examine(replace(right, given=given))}
    assert found == {("gripper", "flipped"), ("position", "metres")}


def test_values_that_are_not_normalised_are_told_with_how_large_they_are(right):
    random = np.random.default_rng(0)
    moves = 40.0 * random.standard_normal((len(right.given), 6))
    found = examine(replace(right, given=np.hstack([moves, right.given[:, 6:]])))
    assert [(one.part, one.fault) for one in found] == [("position", "range"), ("rotation", "range")]
    assert "[-1, 1]" in found[0].text


def test_what_cannot_be_compared_is_refused(settings):
    with pytest.raises(EvaluationError, match="Controls: osc, joint_velocity, joint_position"):
        compare_actions(RandomPolicy(), EPISODES, replace(settings, control="torque"))

    class Short:
        def reset(self, episode): ...

        def act(self, observation):
            return np.zeros(6)

    with pytest.raises(EvaluationError, match=r"shape \(6,\); valid are \(7,\)"):
        compare_actions(Short(), EPISODES, settings)

    class Blind(Short):
        def act(self, observation):
            return observation["agentview_image"]

    with pytest.raises(EvaluationError, match="the policy failed: KeyError: 'agentview_image'"):
        compare_actions(Blind(), EPISODES, settings)


def test_still_actions_say_nothing():
    still = Compared(given=np.zeros((20, 7)), right=np.zeros((20, 7)), frames={}, scale=(0.05, 0.5))
    assert examine(still) == []


class Joints:
    """Moves the joints as the scripted hand does, which is known from the run before; changed by a fault."""

    def __init__(self, known: Compared, change) -> None:
        assert known.joints is not None
        self._answers = iter(change(known.right.copy(), known.joints))

    def reset(self, episode) -> None:
        self.size = episode.action_size

    def act(self, observation):
        answer = next(self._answers)
        assert answer.shape == (self.size,)
        return answer


def scaled(factor):
    return lambda right, joints: np.hstack([factor * right[:, :-1], right[:, -1:]])


JOINT_FAULTS = {
    "joint_position": [
        (scaled(1.0), set()),
        (lambda right, joints: np.hstack([joints, right[:, -1:]]), {("joints", "positions")}),
        (lambda right, joints: np.hstack([np.degrees(joints), right[:, -1:]]), {("joints", "positions in degrees")}),
        (scaled(0.05), {("joints", "radians")}),
        (scaled(-1.0), {("joints", "opposite")}),
        (
            lambda right, joints: np.hstack([right[:, -2::-1], -right[:, -1:]]),
            {("joints", "order"), ("gripper", "flipped")},
        ),
    ],
    "joint_velocity": [
        (scaled(1.0), set()),
        (scaled(0.5 / 20.0), {("joints", "changes")}),
        (scaled(np.degrees(0.5)), {("joints", "degrees")}),
    ],
}


@pytest.mark.slow
@pytest.mark.parametrize("control", sorted(JOINT_FAULTS))
def test_faults_of_actions_of_joints_are_recognised(settings, control):
    asked = replace(settings, control=control)
    joints = len(RandomJoints.known(settings))
    known = compare_actions(RandomJoints(joints + 1), EPISODES[:1], asked)
    assert known.right.shape[1] == joints + 1
    assert np.abs(known.right).max() <= 1.0
    for change, expected in JOINT_FAULTS[control]:
        compared = compare_actions(Joints(known, change), EPISODES[:1], asked)
        np.testing.assert_array_equal(compared.right, known.right)
        assert {(one.part, one.fault) for one in examine(compared)} == expected


class RandomJoints(RandomPolicy):
    """As many values as there are joints."""

    def __init__(self, size: int) -> None:
        self.wanted = size

    def reset(self, episode) -> None:
        assert (episode.action_size, episode.control != "osc") == (self.wanted, True)
        super().reset(episode)

    @staticmethod
    def known(settings) -> tuple[str, ...]:
        """Joints of the arm."""
        from pat3d.envs.robots.arms import make_robot

        return make_robot(settings.robot).arm_joints


def test_of_two_arms_the_one_that_does_the_task_is_compared(settings):
    """The other one holds still, whatever its values would mean."""
    pair = replace(settings, robot=f"{settings.robot}+{settings.robot}")
    compared = compare_actions(RandomPolicy(), EPISODES[:1], pair, 5)
    assert compared.right.shape == compared.given.shape == (5, 7)
    assert np.abs(compared.right).max() > 0.01
