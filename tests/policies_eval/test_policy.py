"""What a policy may answer, and what it is told when it answers something else."""

from __future__ import annotations

import contextlib
import time
from dataclasses import replace

import numpy as np
import pytest

from pat3d.errors import EvaluationError
from pat3d.policies_eval.policies.policy import Policy, PolicyError, checked
from pat3d.policies_eval.policies.registry import make_policy


@pytest.mark.parametrize(
    ("answer", "kind"),
    [
        (np.full(7, np.nan), "not finite"),
        (np.array([0, 0, 0, 0, 0, 0, np.inf]), "not finite"),
        (np.zeros(6), "wrong shape"),
        (np.zeros((0, 7)), "wrong shape"),
        (np.zeros((2, 2, 7)), "wrong shape"),
        (np.zeros((5000, 7)), "wrong shape"),
        (np.full(7, 1.2), "out of range"),
        (None, "no numbers"),
        ("left", "no numbers"),
        ([[1, 2], [3]], "no numbers"),
        (np.zeros(7, dtype=complex), "no numbers"),
        ({"actions": np.zeros(7)}, "no numbers"),
    ],
)
def test_invalid_answers_are_named(answer, kind):
    with pytest.raises(PolicyError) as caught:
        checked(answer, 7, strict=True)
    assert caught.value.kind == kind


def test_valid_answers_are_a_row_or_rows_and_what_is_out_of_range_is_clipped_and_counted():
    assert checked([0.5] * 7, 7).values.shape == (1, 7)
    assert checked(np.full((3, 7), 1.04), 7, strict=True).values.max() == 1.0
    values, clipped = checked([[0.0] * 7, [-9.0, 1.05, 1.0, 0.0, 0.0, 0.0, 0.0]], 7)
    assert values.min() == -1.0
    assert clipped.tolist() == [0, 2]
    with pytest.raises(PolicyError, match="NaN"):
        checked(np.full(7, np.nan), 7)


def wave(observation):
    return np.zeros(7)


class Made:
    def reset(self, episode):
        self.size = episode.action_size

    def act(self, observation):
        return np.zeros(self.size)


def make():
    return Made()


@pytest.mark.parametrize("name", ["wave", "Made", "make"])
def test_a_function_a_class_and_a_factory_are_policies(name):
    assert isinstance(make_policy(f"{__name__}:{name}"), Policy)


@pytest.mark.parametrize(
    "spec", ["nonsense", "no.such.module:make", f"{__name__}:nothing", "../evil.py", "os:sep", "missing.pt"]
)
def test_an_unknown_policy_is_an_error_that_says_what_was_wrong(spec):
    with pytest.raises(EvaluationError):
        make_policy(spec)


class Bad:
    """Fails in one way after a few good actions."""

    def __init__(self, how):
        self.how, self.count = how, 0

    def reset(self, episode):
        if self.how == "reset":
            raise RuntimeError("no weights")

    def act(self, observation):
        self.count += 1
        if self.count < 4:
            return np.zeros(7)
        if self.how == "hang":
            while True:
                with contextlib.suppress(Exception):
                    time.sleep(60.0)
        if self.how == "exit":
            raise SystemExit(3)
        if self.how == "raise":
            raise KeyError("grip")
        return np.full(7, np.nan)


@pytest.mark.parametrize(
    ("how", "words"),
    [("nan", "NaN"), ("raise", "KeyError"), ("hang", "hang"), ("exit", "SystemExit"), ("reset", "no weights")],
)
def test_a_policy_that_fails_is_recorded_with_its_reason(runner, episode, how, words, monkeypatch):
    # Only what hangs for ever is in a hurry, so that a busy machine makes no hang of what is slow.
    monkeypatch.setattr(runner, "settings", replace(runner.settings, act_seconds=0.5 if how == "hang" else 3600.0))
    result = runner.run(episode, Bad(how))
    assert result.outcome == "policy_error"
    assert not result.success
    assert words in result.reason
    assert result.steps == (0 if how == "reset" else 3)
