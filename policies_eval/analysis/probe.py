"""First actions of a policy beside the scripted policy's, in the same states.

The scripted policy acts, so that the states are those of a task that is being done; the other one is asked in each of
them. Robots start with their joints further from home than in evaluations, so that the hand is tilted about all axes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pat3d.envs.physics.world import CAMERAS
from pat3d.envs.robots.controllers import LARGEST
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.conventions import Compared
from pat3d.policies_eval.policies.policy import EpisodeStart, Policy, PolicyError
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from pat3d.policies_eval.run.episodes import Episode
from pat3d.policies_eval.run.settings import RolloutSettings

START_NOISE = 0.1
"""Of the robot's posture [rad]."""

SIZE = 7
"""Values of an action of one arm with control="osc"."""


def compare_actions(
    policy: Policy, episodes: Sequence[Episode], settings: RolloutSettings, steps: int | None = None
) -> Compared:
    """Ask a policy in the states of scripted episodes.

    Args:
        policy: who is asked.
        episodes: whose tasks the scripted policy does.
        settings: of the environment; control is "osc", and the robot has one arm.
        steps: of each episode at most; None for as many as the scripted policy takes.

    Raises:
        EvaluationError: another control, two arms, or a policy that fails or gives no actions.
    """
    if settings.control != "osc":
        raise EvaluationError(f'actions are compared with control="osc", not "{settings.control}".')
    given: list[Any] = []
    right: list[Any] = []
    frames: dict[str, list[Any]] = {"hand": [], "world": [], "camera": []}
    for episode in episodes:
        env = settings.make_env(episode.scene, episode.task, start_noise=START_NOISE)
        try:
            if len(env.simulation.world.arms) > 1:
                raise EvaluationError("actions are compared for robots of one arm.")
            _ask(env, policy, episode, settings, steps, given, right, frames)
        except PolicyError as error:
            raise EvaluationError(f"the policy failed: {error}") from error
        finally:
            env.close()
    return Compared(
        given=np.array(given),
        right=np.array(right),
        frames={name: np.array(found) for name, found in frames.items()},
        scale=(LARGEST["osc"][0], LARGEST["osc"][3]),
    )


def _ask(
    env: Any,
    policy: Policy,
    episode: Episode,
    settings: RolloutSettings,
    steps: int | None,
    given: list[Any],
    right: list[Any],
    frames: dict[str, list[Any]],
) -> None:
    """One episode."""
    observation, info = env.reset(seed=episode.seed)
    scripted, world = ScriptedPolicy(), env.simulation.world
    told: dict[str, Any] = {
        "instruction": info["instruction"], "task": info["task"], "seed": episode.seed, "robot": settings.robot,
        "control": settings.control, "action_size": SIZE, "control_freq": settings.control_freq,
    }  # fmt: skip
    scripted.reset(EpisodeStart(**told, env=env))
    policy.reset(EpisodeStart(**told, env=env if getattr(policy, "privileged", False) else None))
    data, arm = env.simulation.data, world.arms[0]
    base = env.simulation.model.site(arm.prefix + arm.robot.base_site).id
    hand = env.simulation.model.site(arm.prefix + arm.robot.grip_site).id
    camera = env.simulation.model.camera(CAMERAS[0]).id
    pending: list[Any] = []
    success = broken = False
    for _ in range(steps or env.horizon):
        if not pending:
            pending = list(_numbers(policy.act(observation)))[: settings.replan]
        given.append(pending.pop(0))
        action = scripted.act(observation)
        right.append(np.asarray(action, dtype=np.float64))
        ours = data.site_xmat[base].reshape(3, 3)
        frames["hand"].append(ours.T @ data.site_xmat[hand].reshape(3, 3))
        frames["world"].append(ours.T)
        # x to the right of the picture, y down, z ahead.
        frames["camera"].append(ours.T @ data.cam_xmat[camera].reshape(3, 3) @ np.diag([1.0, -1.0, -1.0]))
        observation, _, success, broken, _ = env.step(action)
        if success or broken:
            return


def _numbers(answer: Any) -> Any:
    """A policy's answer as it is, out of range or not, shape (n, 7)."""
    if hasattr(answer, "detach"):
        answer = answer.detach().cpu().numpy()
    values = np.atleast_2d(np.asarray(answer, dtype=np.float64))
    if values.ndim != 2 or values.shape[1] != SIZE or not len(values):
        raise EvaluationError(
            f"the policy gives actions of shape {np.shape(answer)}; valid are ({SIZE},) and (n, {SIZE})."
        )
    if not np.isfinite(values).all():
        raise EvaluationError("the policy gives actions that hold NaN or infinite values.")
    return values
