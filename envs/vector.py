"""The environments behind gymnasium.make_vec("PAT3D-v0"): many copies of one scene on a GPU, processes on CPUs."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, ClassVar

import gymnasium
import numpy as np
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from pat3d.envs.arguments import one_of, whole
from pat3d.envs.config import BatchConfig, configured
from pat3d.envs.env import choose
from pat3d.envs.observations import ObservationSpec, Observer
from pat3d.envs.physics.loading import DEFAULT_TASK, load
from pat3d.envs.physics.world import compose
from pat3d.envs.registration import ENV_ID, MAX_EPISODE_STEPS
from pat3d.envs.reward import dense
from pat3d.envs.robots.arms import default_robot, make_robot
from pat3d.envs.robots.pairs import pair_of, robot_name
from pat3d.envs.suites.selection import Selection
from pat3d.envs.tasks.task import Judge, Verdicts
from pat3d.errors import EnvironmentSetupError

Observations = dict[str, NDArray[np.float32]]

DEVICES = ("auto", "cuda", "cpu")


def make_vector(num_envs: int = 1, device: str = "auto", **kwargs: Any) -> VectorEnv:
    """The entry point of gymnasium.make_vec("PAT3D-v0", num_envs).

    Args:
        num_envs: number of environments.
        device: "cuda" for MuJoCo Warp, "cpu" for a process each, "auto" for a GPU where there is one, MuJoCo Warp is
            installed and the environment is one that it runs: one scene and state observations.
        kwargs: as `pat3d.envs.env.TabletopEnv` takes them; on a GPU as `BatchedTabletopEnv` does.

    Raises:
        EnvironmentSetupError: no such device, or an argument is not valid there; says what is.
    """
    one_of("device", device, DEVICES)
    num_envs = whole("num_envs", num_envs, 1)
    if device == "cuda" or (device == "auto" and _runs_on_gpu(kwargs)):
        return BatchedTabletopEnv(num_envs, device="cuda", **kwargs)
    steps = kwargs.pop("max_episode_steps", MAX_EPISODE_STEPS)

    def one() -> gymnasium.Env[Any, Any]:
        return gymnasium.make(f"pat3d:{ENV_ID}", max_episode_steps=steps, **kwargs)

    return AsyncVectorEnv([one] * num_envs)


def _present(device: str) -> bool:
    import warp as wp

    try:
        wp.get_device(device)
    except (RuntimeError, ValueError):
        return False
    return True


def _runs_on_gpu(kwargs: dict[str, Any]) -> bool:
    import importlib.util

    if importlib.util.find_spec("mujoco_warp") is None or kwargs.get("obs", "state") != "state":
        return False
    several = kwargs.get("suite") is not None and kwargs.get("index") is None
    if (
        several
        or set(kwargs) - {field.name for field in fields(BatchConfig)}
        or kwargs.get("control") == "joint_velocity"
        or pair_of(robot_name(kwargs.get("robot", "")) or default_robot()) is not None
    ):
        return False
    import warp as wp

    return wp.is_cuda_available()


class BatchedTabletopEnv(VectorEnv[Any, Any, Any]):
    """Copies of one scene with one task on MuJoCo Warp; observations are the states of `TabletopEnv`, stacked.

    An environment that ends is reset by the next step, whose action it ignores. `info` holds, an entry for each
    environment: success, progress, lost (the simulation failed), predicates (a dict), and toppled, fell and touched (a
    column for each of `objects`).

    Args:
        num_envs: number of copies.
        device: Warp's name of the device.
        config: all other arguments at once.
        arguments: see BatchConfig, whose fields are the keyword arguments; a suite needs an `index`, and the controls
            are "osc" and "joint_position".

    Raises:
        UnsettledSceneError: the scene moves when MuJoCo or MuJoCo Warp runs it.
        TaskError: the task cannot be done in the scene by this robot; says why.
        EnvironmentSetupError: an argument is not valid, or MuJoCo Warp is missing; says what to do.
    """

    metadata: ClassVar[dict[str, Any]] = {"autoreset_mode": AutoresetMode.NEXT_STEP}  # type: ignore[misc]

    def __init__(
        self, num_envs: int, device: str = "cuda", *, config: BatchConfig | None = None, **arguments: Any
    ) -> None:
        from pat3d.envs.batch.physics import BatchedPhysics, Capacity, capacity_for, require_still
        from pat3d.envs.batch.state import BatchState

        num_envs = whole("num_envs", num_envs, 1)
        config = configured(BatchConfig, config, arguments)
        if pair_of(config.arms) is not None:
            raise EnvironmentSetupError(
                f'on a GPU a robot is one arm, not two ("{config.arms}"); vectorization_mode="async" runs two on CPUs.'
            )
        control, control_freq = config.control, config.control_freq
        chosen = Selection.of(config.suite, config.split, config.index, config.scene, config.task)
        if chosen is not None:
            if config.index is None:
                raise EnvironmentSetupError(
                    "on a GPU all environments have the same scene: give its index in the suite, or use "
                    'vectorization_mode="async".'
                )
            loaded, given = chosen.first()
        else:
            default = DEFAULT_TASK if config.scene is None and config.task is None else config.task
            loaded, given = load(config.scene), default
        self.task, placement = choose(loaded.scene, given, config.arms, loaded.checksum)
        world = compose(loaded.scene, loaded.mjcf, make_robot(config.arms), placement)
        if not _present(device):
            raise EnvironmentSetupError(f'there is no device "{device}" here; vectorization_mode="async" runs on CPUs.')
        sizes = capacity_for(world, control, control_freq) if config.capacity is None else Capacity(*config.capacity)
        require_still(world, loaded.checksum, control, control_freq, device, sizes)
        self.physics = BatchedPhysics(world, num_envs, control, control_freq, device, sizes)
        self.state = BatchState(self.physics)
        self.num_envs, self._reward, self._noise = num_envs, config.reward, config.start_noise
        self._limit = config.max_episode_steps or self.task.horizon(loaded.scene, control_freq)
        self._discount = config.discount
        spec = ObservationSpec(
            kind="state", cameras=("agentview",), height=8, width=8, segmentation=False, max_objects=len(world.objects)
        )
        self.single_observation_space = spec.space(world)
        self.single_action_space = gymnasium.spaces.Box(-1.0, 1.0, (self.physics.controller.size,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._observer = Observer(spec, world)
        self._moving = np.array([self.state.numbers[name] for name in world.objects], dtype=np.int64)
        self._judge: Judge | None = None
        self._verdicts: Verdicts
        self._generators: list[np.random.Generator] = []
        self._ended = np.zeros(num_envs, dtype=bool)
        self._steps = np.zeros(num_envs, dtype=np.int64)
        self._potential = np.zeros(num_envs)

    @property
    def objects(self) -> tuple[str, ...]:
        """Names of the rows of the observation "objects"."""
        return self.physics.world.objects

    @property
    def instruction(self) -> str:
        """The task as one tells it to a person."""
        return self.task.instruction(self.physics.world.scene)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Start an episode in every environment; environment k has seed + k, or the k-th seed of a list."""
        if options:
            raise EnvironmentSetupError(f"no reset options here, got {', '.join(sorted(options))}.")
        if isinstance(seed, list) and len(seed) != self.num_envs:
            raise EnvironmentSetupError(f"{self.num_envs} environments need as many seeds, got {len(seed)}.")
        if seed is not None or not self._generators:
            seeds = (
                seed if isinstance(seed, list) else [None if seed is None else seed + k for k in range(self.num_envs)]
            )
            self._generators = [np.random.default_rng(one) for one in seeds]
        self._start(np.arange(self.num_envs))
        self._judge = self.task.judge(self.state)
        self._verdicts = self._judge.update(np.zeros(self.num_envs))
        self._potential = self._verdicts.progress.copy()
        return self._observations(self.physics.lost), self._info()

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[Observations, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Do an action in every environment."""
        if self._judge is None:
            raise gymnasium.error.ResetNeeded("reset the environments before their first step.")
        values = np.asarray(actions, dtype=np.float32)
        if values.shape != self.action_space.shape or not np.isfinite(values).all():
            raise EnvironmentSetupError(f"actions are finite numbers of shape {self.action_space.shape}.")
        going = ~self._ended
        self.physics.step(np.clip(values, -1.0, 1.0))
        if going.all():
            self.state.refresh()
        else:
            fresh = self._ended.nonzero()[0]
            self._start(fresh)
            self._judge.begin(fresh)
        lost = self.physics.lost
        verdicts = self._judge.update(np.where(going, self.physics.period, 0.0))
        # Nothing can be said of a state that is not finite: what was said last stays.
        self._verdicts = verdicts.unless(self._verdicts, lost) if lost.any() else verdicts
        self._steps[going] += 1
        success = verdicts.success & going & ~lost
        truncated = going & ~success & (lost | (self._steps >= self._limit))
        before, self._potential = self._potential, np.where(lost, 0.0, self._verdicts.progress)
        rewards = success.astype(np.float64)
        if self._reward == "dense":
            rewards = np.where(going, dense(before, self._potential, success, self._discount), 0.0)
        self._ended = success | truncated
        return self._observations(lost), rewards, success, truncated, {**self._info(), "lost": lost}

    def close_extras(self, **kwargs: Any) -> None:
        """Nothing is left open: the device's memory goes with this object."""

    def _start(self, worlds: NDArray[np.int64]) -> None:
        """Begin episodes in `worlds`."""
        count = len(self.physics.world.robot.arm_joints)
        # Three standard deviations at most: a start posture that touches something is no start.
        draws = np.array([self._generators[k].standard_normal(count) for k in worlds.tolist()])
        self.physics.reset(worlds, np.clip(draws, -3.0, 3.0) * self._noise)
        self.physics.restart()
        self.state.refresh()
        self.state.take_start(worlds)
        self._ended[worlds], self._steps[worlds] = False, 0

    def _observations(self, lost: NDArray[np.bool_]) -> Observations:
        seen = self._observer.observe(self.state, self._verdicts)
        if lost.any():
            for values in seen.values():
                values[lost] = np.nan_to_num(values[lost])
        return seen

    def _info(self) -> dict[str, Any]:
        verdicts, (toppled, fell) = self._verdicts, self.state.upsets()
        return {
            "success": verdicts.success,
            "is_success": verdicts.success,
            "progress": verdicts.progress,
            "predicates": dict(verdicts.predicates),
            "toppled": toppled[:, self._moving],
            "fell": fell[:, self._moving],
            "touched": self.state.touched()[:, self._moving],
        }
