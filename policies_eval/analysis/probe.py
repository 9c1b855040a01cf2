"""First actions of a policy beside the scripted policy's, in the same states.

The scripted policy acts, so that the states are those of a task that is being done; the other one is asked in each of
them. Robots start with their joints further from home than in evaluations, so that the hand is tilted about all axes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from pat3d.envs.physics.world import CAMERAS
from pat3d.envs.robots.controllers import LARGEST
from pat3d.errors import EvaluationError, Pat3dError
from pat3d.policies_eval.analysis.conventions import Compared
from pat3d.policies_eval.policies.policy import EpisodeStart, Policy
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from pat3d.policies_eval.run.episodes import Episode
from pat3d.policies_eval.run.settings import RolloutSettings

START_NOISE = 0.1
"""Of the robot's posture [rad]."""

CONTROLS = ("osc", "joint_velocity", "joint_position")


def compare_actions(
    policy: Policy, episodes: Sequence[Episode], settings: RolloutSettings, steps: int | None = None
) -> Compared:
    """Ask a policy in the states of scripted episodes.

    The scripted policy moves the hand. For control of the joints, right is what moves them as they then move. Of two
    arms, the actions of the one that does the task are compared.

    Args:
        policy: who is asked.
        episodes: whose tasks the scripted policy does.
        settings: of the environment that the policy is for.
        steps: of each episode at most; None for as many as the scripted policy takes.

    Raises:
        EvaluationError: another control, or a policy that fails or gives no actions.
    """
    if settings.control not in CONTROLS:
        raise EvaluationError(f'no control "{settings.control}". Controls: {", ".join(CONTROLS)}.')
    asked = _Asked(settings)
    for episode in episodes:
        env = replace(settings, control="osc").make_env(episode.scene, episode.task, start_noise=START_NOISE)
        try:
            asked.ask(env, policy, episode, steps)
        finally:
            env.close()
    largest = LARGEST[settings.control]
    common: dict[str, Any] = {
        "given": np.array(asked.given),
        "frames": {name: np.array(found) for name, found in asked.frames.items()},
        "rate": settings.control_freq,
    }
    right, reached = np.array(asked.right), np.array(asked.reached)
    if settings.control == "osc":
        return Compared(right=right, scale=(largest[0], largest[3]), **common)
    velocity = settings.control == "joint_velocity"
    moved = reached - np.array(asked.joints)
    moved = np.clip(moved * (settings.control_freq if velocity else 1.0) / largest[0], -1.0, 1.0)
    right = np.hstack([moved, right[:, -1:]])
    return Compared(right=right, scale=(largest[0],), joints=reached, velocity=velocity, **common)


class _Asked:
    """What a policy answered, and what would have been right."""

    def __init__(self, settings: RolloutSettings) -> None:
        self._settings = settings
        self.given: list[Any] = []
        self.right: list[Any] = []
        """For control of the hand."""
        self.frames: dict[str, list[Any]] = {"hand": [], "world": [], "camera": []}
        self.joints: list[Any] = []
        """Before every action [rad]."""
        self.reached: list[Any] = []
        """After it [rad]."""

    def ask(self, env: Any, policy: Policy, episode: Episode, steps: int | None) -> None:
        """One episode, which the scripted policy does."""
        observation, info = env.reset(seed=episode.seed)
        scripted, world, simulation = ScriptedPolicy(), env.simulation.world, env.simulation
        working = world.arm(world.placement.side)
        size, own = self._sizes(env)
        told: dict[str, Any] = {
            "instruction": info["instruction"], "task": info["task"], "seed": episode.seed,
            "robot": self._settings.robot, "control_freq": self._settings.control_freq,
        }  # fmt: skip
        whole = simulation.controller.size
        scripted.reset(EpisodeStart(**told, control="osc", action_size=whole, env=env))
        privileged = env if getattr(policy, "privileged", False) else None
        start = EpisodeStart(**told, control=self._settings.control, action_size=size, env=privileged)
        _asked(policy.reset, start)
        data = simulation.data
        base = simulation.model.site(working.prefix + working.robot.base_site).id
        hand = simulation.model.site(working.prefix + working.robot.grip_site).id
        camera = simulation.model.camera(CAMERAS[0]).id
        pending: list[Any] = []
        for _ in range(steps or env.horizon):
            if not pending:
                pending = list(_numbers(_asked(policy.act, observation), size))[: self._settings.replan]
            self.given.append(pending.pop(0)[own])
            action = scripted.act(observation)
            self.right.append(np.asarray(action, dtype=np.float64)[simulation.part()])
            ours = data.site_xmat[base].reshape(3, 3)
            self.frames["hand"].append(ours.T @ data.site_xmat[hand].reshape(3, 3))
            self.frames["world"].append(ours.T.copy())
            # x to the right of the picture, y down, z ahead.
            self.frames["camera"].append(ours.T @ data.cam_xmat[camera].reshape(3, 3) @ np.diag([1.0, -1.0, -1.0]))
            self.joints.append(simulation.arm.copy())
            observation, _, success, broken, _ = env.step(action)
            self.reached.append(simulation.arm.copy())
            if success or broken:
                return

    def _sizes(self, env: Any) -> tuple[int, slice]:
        """Values of a whole action under the policy's control, and where those of the working arm are."""
        if self._settings.control == "osc":
            return env.simulation.controller.size, env.simulation.part()
        at, own = 0, slice(0, 0)
        for arm in env.simulation.world.arms:
            size = len(arm.robot.arm_joints) + 1
            own = slice(at, at + size) if arm.side == env.placement.side else own
            at += size
        return at, own


def _asked(method: Callable[[Any], Any], value: Any) -> Any:
    """What a method of the policy returns; whatever it raises is an EvaluationError."""
    try:
        return method(value)
    except Pat3dError:
        raise
    except Exception as error:
        raise EvaluationError(f"the policy failed: {type(error).__name__}: {error}") from error


def _numbers(answer: Any, size: int) -> Any:
    """A policy's answer as it is, out of range or not, shape (n, size)."""
    if hasattr(answer, "detach"):
        answer = answer.detach().cpu().numpy()
    values = np.atleast_2d(np.asarray(answer, dtype=np.float64))
    if values.ndim != 2 or values.shape[1] != size or not len(values):
        raise EvaluationError(
            f"the policy gives actions of shape {np.shape(answer)}; valid are ({size},) and (n, {size})."
        )
    if not np.isfinite(values).all():
        raise EvaluationError("the policy gives actions that hold NaN or infinite values.")
    return values
