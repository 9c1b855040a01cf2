"""Poses that perturbations draw: within their strength, up to it, and taken back."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco")

from pat3d.policies_eval.run import perturb  # noqa: E402
from pat3d.policies_eval.run.perturb import Perturbation, Perturber  # noqa: E402


@pytest.mark.parametrize(("strength", "half_turns"), [(0.02, 0.2), (0.1, 1.0), (0.3, 1.0)])
def test_a_thing_is_moved_and_turned_by_anything_up_to_the_strength(monkeypatch, strength, half_turns):
    """To both sides, and nearly as far as it may be in 200 episodes."""
    drawn = []

    def moved(simulation, scene, name, x, y, yaw):
        drawn.append((name, x, y, yaw))
        return True

    monkeypatch.setattr(perturb, "_moved", moved)
    names = ("mug", "tray", "can")
    scene = SimpleNamespace(
        objects=[SimpleNamespace(name=name) for name in names],
        carriers=lambda name: ("tray",) if name == "can" else (),
    )
    task = SimpleNamespace(needs=lambda scene: SimpleNamespace(grasp=("mug", "tray")))
    env = SimpleNamespace(simulation=None, scene=scene, task=task, restart=lambda: None)
    said = [Perturber(env).apply(Perturbation(pose=strength), seed)["pose"] for seed in range(200)]
    assert [one[1:] for one in drawn] == [tuple(one["mug"]) for one in said]
    assert {one[0] for one in drawn} == {"mug"}, "the tray carries the can"
    bounds = np.array([strength, strength, half_turns * math.pi])
    values = np.array([one[1:] for one in drawn]) / bounds
    assert (np.abs(values) <= 1.0).all()
    assert (values.max(axis=0) > 0.95).all()
    assert (values.min(axis=0) < -0.95).all()


@pytest.mark.parametrize("refused", [0, 5, perturb.TRIES])
def test_a_pose_that_does_not_fit_is_drawn_again_but_not_for_ever(monkeypatch, refused):
    tried = []
    monkeypatch.setattr(perturb, "_moved", lambda *said: tried.append(said[3:]) or len(tried) > refused)
    mug = SimpleNamespace(name="mug")
    env = SimpleNamespace(
        simulation=None,
        scene=SimpleNamespace(objects=[mug], carriers=lambda name: ()),
        task=SimpleNamespace(needs=lambda scene: SimpleNamespace(grasp=("mug",))),
        restart=lambda: None,
    )
    drawn = Perturber(env).apply(Perturbation(pose=0.1), 0)["pose"]
    assert len(tried) == min(refused + 1, perturb.TRIES)
    assert len(set(tried)) == len(tried)
    assert drawn == ({"mug": list(tried[-1])} if refused < perturb.TRIES else {})
