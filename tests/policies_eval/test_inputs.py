"""What cloned policies see: each kind what it says, and nothing else of the observation."""

from __future__ import annotations

import numpy as np
import pytest

from pat3d.errors import EvaluationError
from pat3d.policies_eval.policies.inputs import CLOCK, KINDS, MAX_WORDS, Inputs, words_of

SAID = "pick up the red mug"


def observation(seed: int = 0) -> dict[str, np.ndarray]:
    random = np.random.default_rng(seed)
    quats = random.standard_normal((5, 4))
    quats /= np.linalg.norm(quats, axis=1, keepdims=True)
    rows = np.concatenate([random.standard_normal((4, 3)), quats[:4]], axis=1)
    rows[3] = 0.0
    return {
        "eef_pos": random.standard_normal(3), "eef_quat": quats[4], "gripper_pos": random.uniform(0, 0.04, 2),
        "objects": rows, "target": np.concatenate([rows[1], random.standard_normal(3)]),
    }  # fmt: skip


def inputs(kind: str) -> Inputs:
    return Inputs.of(kind, [SAID, "put the mug on the tray"], 4)


#                     the hand, the target, an object, an object's row beyond the last, the words, the time
DEPENDS = {
    "task": (True, True, False, False, False, False),
    "objects": (True, False, True, False, False, True),
    "words": (True, False, False, False, True, True),
    "robot": (True, False, False, False, False, True),
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_sees_what_it_says_and_nothing_else(kind):
    made, seen = inputs(kind), observation()
    before = made.see(seen, SAID, 30)
    assert before.shape == (made.size,)
    assert before.dtype == np.float32

    def changed(instruction=SAID, step=30, **values):
        return bool((made.see({**seen, **values}, instruction, step) != before).any())

    objects, beyond = seen["objects"].copy(), seen["objects"].copy()
    objects[2, :3] += 0.1
    beyond[3, :3] += 0.1
    assert (
        changed(eef_pos=seen["eef_pos"] + 0.01),
        changed(target=np.concatenate([seen["target"][:7], [1.0, 2.0, 3.0]])),
        changed(objects=objects),
        changed(objects=beyond),
        changed(instruction="put the mug on the tray"),
        changed(step=31),
    ) == DEPENDS[kind]


def test_the_time_tells_every_moment_until_the_last_hump():
    made, seen = inputs("robot"), observation()
    clocks = [tuple(made.see(seen, SAID, step)[-len(CLOCK) :]) for step in range(CLOCK[-1] + 40)]
    assert len(set(clocks)) == len(clocks)
    assert all(sum(clock) == pytest.approx(1.0, abs=1e-6) for clock in clocks[: CLOCK[-1] + 1])


def test_words_never_heard_are_none():
    made, seen = inputs("words"), observation()
    assert made.vocabulary == ("mug", "on", "pick", "put", "red", "the", "tray", "up")
    assert (made.see(seen, SAID, 0) == made.see(seen, f"{SAID} gently!", 0)).all()
    assert words_of("Pick up, the RED-mug 3!") == ["pick", "up", "the", "red", "mug"]


@pytest.mark.parametrize("kind", KINDS)
def test_inputs_survive_json(kind):
    assert Inputs.from_json(inputs(kind).to_json()) == inputs(kind)
    assert Inputs.from_json(None) == Inputs()


@pytest.mark.parametrize(
    "damage",
    [
        3,
        {},
        {"kind": "x", "vocabulary": [], "rows": 0},
        {"kind": "words", "vocabulary": [1], "rows": 0},
        {"kind": "words", "vocabulary": ["a"] * (MAX_WORDS + 1), "rows": 0},
        {"kind": "robot", "vocabulary": [], "rows": -1},
    ],
)
def test_damaged_inputs_are_errors(damage):
    with pytest.raises(EvaluationError, match="inputs that are none"):
        Inputs.from_json(damage)


def test_two_arms_and_pictures_are_refused():
    with pytest.raises(EvaluationError, match="one arm"):
        inputs("robot").see({**observation(), "left_eef_pos": np.zeros(3)}, SAID, 0)
    with pytest.raises(EvaluationError, match="state observations"):
        inputs("robot").see({"agentview_image": np.zeros(3)}, SAID, 0)
