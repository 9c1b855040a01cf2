"""Episodes on the shipped scene: paired, repeatable, perturbed and judged."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from pat3d.errors import EvaluationError, TaskError
from pat3d.policies_eval.policies.registry import RandomPolicy
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from pat3d.policies_eval.run.episodes import Episode, Setting, episodes_of, settings_of
from pat3d.policies_eval.run.perturb import Perturbation, parse, reworded
from pat3d.policies_eval.run.records import result_of, row_of

MUG = Setting(scene="", task="pick:red mug")
ALL = Perturbation(pose=0.03, friction=0.5, mass=0.5, camera=0.02, light=0.2)


def test_episode_k_is_the_same_however_many_there_are():
    settings = [MUG, Setting(scene="", task="pick:green apple")]
    few, many = episodes_of(settings, 5, seed=3), episodes_of(settings, 50, seed=3)
    assert few == many[:5]
    assert len({one.seed for one in many}) == 50
    assert [one.task for one in few] == [settings[number % 2].task for number in range(5)]
    assert [one.index for one in few] == list(range(5))
    assert episodes_of(settings, 5, seed=4)[0].seed != few[0].seed


def test_an_episode_survives_json():
    one = episodes_of([replace(MUG, axes=(("clutter", "low"),))], 1, perturbation=ALL)[0]
    assert Episode.from_json(json.loads(json.dumps(one.to_json()))) == one


def test_what_is_not_there_is_named():
    with pytest.raises(EvaluationError, match="no scene folder"):
        settings_of(["nowhere"], [])
    with pytest.raises(TaskError, match="red mug"):
        settings_of([], ["pick:octopus"])
    with pytest.raises(EvaluationError, match="Axes: pose"):
        parse(["gravity=1"])
    with pytest.raises(EvaluationError, match=r"0 to 0\.3"):
        parse(["pose=nan"])
    with pytest.raises(EvaluationError, match="episodes"):
        episodes_of([MUG], 0)


def test_the_scripted_policy_picks_the_mug_and_its_actions_do_it_again_bit_for_bit(runner, episode):
    result = runner.run(episode, ScriptedPolicy())
    assert (result.outcome, result.events.grasped, result.events.lifted) == ("success", True, True)
    assert result.events.highest > 0.1
    assert runner.replay(episode, result.actions) == result.state_hash
    changed = result.actions.copy()
    changed[20, 0] += 1e-6
    assert runner.replay(episode, changed) != result.state_hash


def test_every_policy_starts_from_the_same_state(runner, episode):
    perturbed = replace(episode, perturbation=ALL)

    def start():
        observation, _, drawn = runner.start(perturbed)
        return observation, drawn, runner.env.simulation.data.qpos.copy()

    first, drawn, place = start()
    runner.run(replace(episode, seed=5), RandomPolicy())
    again, drawn_again, place_again = start()
    assert drawn == drawn_again
    assert np.array_equal(place, place_again)
    assert all(np.array_equal(first[name], again[name]) for name in first)


def test_a_perturbed_episode_leaves_no_trace(runner, episode):
    """Masses, friction, cameras and derived constants are what they were: the plain episode is the same bit for bit."""
    actions = RandomPolicy()
    before = runner.run(episode, actions).state_hash
    during = runner.run(replace(episode, perturbation=ALL), actions).state_hash
    assert runner.run(episode, actions).state_hash == before != during


def test_a_moved_object_stands_still_where_nothing_is_in_its_way(runner, episode):
    for seed in (1, 2):
        observation, _, drawn = runner.start(replace(episode, seed=seed, perturbation=Perturbation(pose=0.04)))
        x, y, _ = drawn["pose"]["red mug"]
        state = runner.env.simulation.state
        rest = runner.env.scene["red mug"]
        moved = state.centre("red mug") - rest.pose.apply(np.array([rest.asset.mass_properties.centre_of_mass]))[0]
        assert moved[:2] == pytest.approx([x, y], abs=1e-3)
        assert abs(moved[2]) < 1e-3
        assert state.still("red mug")
        assert np.allclose(observation["target"][:3], state.position("red mug"), atol=1e-6)


def test_strengths_bound_what_is_drawn(runner, episode):
    _, _, drawn = runner.start(replace(episode, perturbation=Perturbation(friction=0.5, mass=1.0)))
    assert all(1 / 1.5 <= value <= 1.5 for value in drawn["friction"].values())
    assert all(0.5 <= value <= 2.0 for value in drawn["mass"].values())
    mass = runner.env.simulation.model.body_mass[runner.env.simulation.world.bodies["red mug"]]
    rest = runner.env.scene["red mug"].asset.mass_properties.mass
    assert mass == pytest.approx(rest * drawn["mass"]["red mug"])


def test_words_change_only_where_they_are_asked_to():
    wordings = ("pick up the mug", "grab the mug")
    assert reworded(wordings, Perturbation(), 1) == wordings[0]
    said = {reworded(wordings, Perturbation(words=1.0), seed) for seed in range(60)}
    assert len(said) > 5
    assert wordings[0] not in said
    assert wordings[1] in said
    assert all(any(one in text for one in wordings) for text in said)


def test_a_policy_is_told_the_words_that_are_recorded(runner, episode, monkeypatch):
    told = []

    class Listener(Away):
        def reset(self, start):
            told.append(start.instruction)
            super().reset(start)

    monkeypatch.setattr(runner, "settings", replace(runner.settings, max_steps=2))
    result = runner.run(replace(episode, perturbation=Perturbation(words=1.0)), Listener())
    assert result.instruction == told[0] != "pick up the red mug from the wooden tray"
    assert "red mug" in told[0]


class Clumsy(ScriptedPolicy):
    """Lets go of what it has lifted."""

    def act(self, observation):
        action = super().act(observation)
        if self._phase == "lift" and self._steps > 14:
            action[-1] = -1.0
        return action


class Away:
    """Never gets near anything."""

    def reset(self, episode):
        self.action = np.zeros(episode.action_size)
        self.action[2] = 0.5

    def act(self, observation):
        return self.action


def test_failures_are_counted_from_the_state(runner, episode):
    dropped = runner.run(episode, Clumsy())
    assert dropped.events.dropped
    assert dropped.outcome in ("dropped", "toppled")
    missed = runner.run(episode, Away())
    assert (missed.outcome, missed.events.grasped, missed.events.collided) == ("missed", False, ())
    assert missed.events.closest > 0.05


def test_an_episode_that_was_still_getting_on_timed_out(runner, episode, monkeypatch):
    """The scripted hand stopped on its way; and one that stands still all the time, which has missed."""
    monkeypatch.setattr(runner, "settings", replace(runner.settings, max_steps=25))
    assert runner.run(episode, ScriptedPolicy()).outcome == "timed_out"

    class Still:
        def reset(self, start):
            self.size = start.action_size

        def act(self, observation):
            return np.zeros(self.size)

    monkeypatch.setattr(runner, "settings", replace(runner.settings, max_steps=60))
    assert runner.run(episode, Still()).outcome == "missed"


def test_without_a_limit_an_episode_has_its_task_s_time(runner, episode, monkeypatch):
    monkeypatch.setattr("pat3d.envs.tasks.task.FIRST_MOVE", 0.35)
    monkeypatch.setattr(runner, "settings", replace(runner.settings, max_steps=0))
    assert runner.run(episode, RandomPolicy()).steps == 7


class Loud:
    """Every fourth action, of a chunk of two, is far out of range in two values."""

    def reset(self, start):
        self.count = 0

    def act(self, observation):
        self.count += 1
        chunk = np.zeros((2, 7))
        if self.count % 2 == 0:
            chunk[1, :2] = 1.05, -40.0
        return chunk


def test_actions_out_of_range_are_clipped_and_counted_unless_one_is_strict(runner, episode, monkeypatch):
    monkeypatch.setattr(runner, "settings", replace(runner.settings, max_steps=10))
    result = runner.run(episode, Loud())
    assert (result.outcome != "policy_error", result.steps, result.clipped) == (True, 10, 4)
    assert np.abs(result.actions).max() == 1.0
    assert result_of(row_of(result)).clipped == 4
    older = {name: value for name, value in row_of(result).items() if name != "clipped"}
    assert result_of(older).clipped == 0
    monkeypatch.setattr(runner, "settings", replace(runner.settings, strict=True))
    refused = runner.run(episode, Loud())
    assert (refused.outcome, refused.clipped) == ("policy_error", 0)
    assert "40" in refused.reason
