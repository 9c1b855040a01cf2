"""What is said of an episode, from scripted states: when a thing counts as lost, and what became of it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.policies_eval.run.failures import GETTING_ON, LIFTED, LOST_STEPS, PUSHED, Watcher

FREQUENCY = 20


class State:
    """A mug of the task and a can beside it; the tests say where they are and what the fingers do."""

    def __init__(self):
        self.hand = np.array([0.0, 0.0, 0.5])
        self.places = {"mug": np.array([0.0, 0.0, 0.1]), "can": np.array([0.3, 0.0, 0.1])}
        self.grip = ""
        """"held" between both fingers, "touched" by one, or neither."""

    def centre(self, name):
        return self.places[name]

    def held(self, name):
        return name == "mug" and self.grip == "held"

    def touched(self, name):
        return name == "mug" and self.grip in ("held", "touched")


class Episode:
    def __init__(self):
        self.state = State()
        env = SimpleNamespace(
            simulation=SimpleNamespace(state=self.state),
            task=SimpleNamespace(needs=lambda scene: SimpleNamespace(grasp=("mug",))),
            scene=SimpleNamespace(objects=[SimpleNamespace(name="mug"), SimpleNamespace(name="can")]),
            verdict=SimpleNamespace(progress=0.0),
            control_freq=FREQUENCY,
        )
        self.watcher = Watcher(env)

    def step(self, grip="", rise=0.0, *, progress=0.0, toppled=(), fell=(), touched=(), count=1):
        self.state.grip = grip
        self.state.places["mug"] = np.array([*self.state.places["mug"][:2], 0.1 + rise])
        info = {"progress": progress, "toppled": toppled, "fell": fell, "touched": touched}
        for _ in range(count):
            self.watcher.update(info)
        return self.watcher.events()

    def outcome(self, **said):
        return self.watcher.outcome(**({"success": False, "broken": False} | said))

    def wait(self):
        """Until it no longer counts as getting on."""
        self.step(self.state.grip, self.state.places["mug"][2] - 0.1, count=int(GETTING_ON * FREQUENCY))


@pytest.mark.parametrize(("held_at", "lost"), [(0.01, "slipped"), (0.1, "dropped")])
def test_a_thing_is_lost_after_three_steps_without_a_finger_on_it(held_at, lost):
    for steps in range(6):
        episode = Episode()
        episode.step("held", held_at)
        events = episode.step("", 0.0, count=steps) if steps else episode.watcher.events()
        assert getattr(events, lost) is (steps >= 3), steps
        assert not getattr(events, {"slipped": "dropped", "dropped": "slipped"}[lost])
    assert LOST_STEPS == 3
    episode.wait()
    assert episode.outcome() == lost


def test_a_finger_on_it_keeps_it_and_a_grasp_begins_anew():
    episode = Episode()
    episode.step("held", 0.1)
    episode.step("", 0.1, count=2)
    episode.step("touched", 0.1, count=5)
    episode.step("held", 0.1)
    assert not episode.step("", 0.0, count=2).dropped
    assert episode.step("", 0.0).dropped


@pytest.mark.parametrize(("fall", "dropped"), [(0.4 * LIFTED, False), (0.6 * LIFTED, True)])
def test_what_is_put_down_from_a_hand_s_breadth_is_not_dropped(fall, dropped):
    episode = Episode()
    episode.step("held", 0.1)
    events = episode.step("", 0.1 - fall, count=LOST_STEPS)
    assert (events.dropped, events.slipped) == (dropped, False)


def test_events_are_extremes_of_the_whole_episode():
    episode = Episode()
    episode.step("", 0.0)
    for rise in (0.01, 0.07, 0.03):
        episode.step("held", rise)
    episode.state.hand = np.array([0.0, 0.04, 0.1])
    events = episode.step("", 0.3)
    assert (events.grasped, events.lifted) == (True, True)
    assert events.highest == pytest.approx(0.07)
    assert events.closest == pytest.approx(np.hypot(0.04, 0.3))


@pytest.mark.parametrize("pushed", [0.9 * PUSHED, 1.1 * PUSHED])
def test_what_was_touched_and_moved_far_was_collided_with(pushed):
    episode = Episode()
    episode.state.places["can"] = np.array([0.3 + pushed, 0.0, 0.1])
    assert episode.step().collided == (), "nothing touched it"
    assert episode.step(touched=("can", "mug")).collided == (("can",) if pushed > PUSHED else ())
    episode.wait()
    assert episode.outcome() == ("collided" if pushed > PUSHED else "missed")


def test_the_first_outcome_that_holds_is_told():
    episode = Episode()
    episode.step("held", 0.1, progress=0.5)
    assert episode.outcome() == "timed_out", "getting on"
    episode.step("held", 0.1, progress=0.5, count=int(GETTING_ON * FREQUENCY) - 1)
    assert episode.outcome() == "timed_out"
    episode.step("", 0.0, count=LOST_STEPS)
    assert episode.outcome() == "dropped"
    episode.step(toppled=("mug",))
    assert episode.outcome() == "dropped", "the task's own"
    assert episode.step(fell=("can",), toppled=("mug",)).toppled == ("mug", "can")
    assert episode.outcome() == "toppled"
    assert episode.outcome(success=True) == "success"
    assert episode.outcome(success=True, broken=True) == "simulation_error"
