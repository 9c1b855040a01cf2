"""The environment behind gymnasium.make("PAT3D-v0")."""

from __future__ import annotations

import copy
from dataclasses import replace
from typing import Any, ClassVar

import gymnasium
import numpy as np
from numpy.typing import NDArray

from pat3d.envs.config import RENDER_MODES, Source, TabletopConfig, configured
from pat3d.envs.grasping.remembered import placed
from pat3d.envs.grasping.standing import Placement
from pat3d.envs.observations import Observation, ObservationSpec, Observer, pictured
from pat3d.envs.physics.loading import DEFAULT_TASK, LoadedScene, load
from pat3d.envs.physics.memory import give_back
from pat3d.envs.physics.simulation import Simulation
from pat3d.envs.physics.variation import vary
from pat3d.envs.physics.world import compose
from pat3d.envs.rendering.goal import goal_image
from pat3d.envs.rendering.pictures import Pictures
from pat3d.envs.reward import dense
from pat3d.envs.robots.arms import make_robot, require_robot
from pat3d.envs.suites.selection import Selection
from pat3d.envs.surroundings.surroundings import Surroundings
from pat3d.envs.tasks.manipulate import Pick
from pat3d.envs.tasks.registry import parse_task
from pat3d.envs.tasks.task import Judge, Task, Verdict, Verdicts
from pat3d.errors import EnvironmentSetupError, TaskError
from pat3d.scene.model import Scene

_KEPT_WORLDS = 4
"""Compiled scenes an environment keeps for the next time one of them is asked for."""


class TabletopEnv(gymnasium.Env[Observation, NDArray[np.float32]]):
    """A robot arm, or two, in front of a verified scene, with a task.

    Actions are in [-1, 1]; see `pat3d.envs.robots.controllers`. Those of two arms are the left one's and then the right
    one's. An episode terminates with success; the time limit of the registration truncates it. The sparse reward is 1
    at success and 0 before; the dense one follows the task's progress in [0, 1], see `pat3d.envs.reward` and the judge
    of each task.

    Args:
        scene: see TabletopConfig, whose fields are the keyword arguments.
        config: all arguments at once, instead.
        arguments: see TabletopConfig.

    Raises:
        UnsettledSceneError: the scene moves when MuJoCo loads it.
        TaskError: the task cannot be done in the scene by this robot; says why.
        SuiteError: no such suite, split or kind of task; says what there is.
        EnvironmentSetupError: an argument is not valid; says what is.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": list(RENDER_MODES), "render_fps": 20}  # type: ignore[misc]

    def __init__(self, scene: Source = None, *, config: TabletopConfig | None = None, **arguments: Any) -> None:
        given = arguments if scene is None else {"scene": scene, **arguments}
        self.config = config = configured(TabletopConfig, config, given)
        self.control, self.reward = config.control, config.reward
        self.control_freq, self.render_mode = config.control_freq, config.render_mode
        self.metadata = {**TabletopEnv.metadata, "render_fps": round(config.control_freq)}  # type: ignore[misc]
        require_robot(config.arms)
        self._kept: dict[tuple[str, str, Surroundings], tuple[Task, Simulation]] = {}
        self._pictures: Pictures | None = None
        self._chosen = Selection.of(config.suite, config.split, config.index, config.scene, config.task)
        self._loaded: LoadedScene
        self._task_given: str | Task | None
        if self._chosen is not None:
            self._loaded, self._task_given = self._chosen.first()
            moving = self._chosen.most_objects
        else:
            self._loaded = load(config.scene)
            self._task_given = DEFAULT_TASK if config.scene is None and config.task is None else config.task
            moving = sum(not obj.fixed for obj in self._loaded.scene.objects)
        height, width = config.image_size
        self._spec = ObservationSpec(
            kind=config.obs,
            cameras=tuple(config.cameras),
            height=height,
            width=width,
            segmentation=config.segmentation,
            goal_image=config.goal_image,
            max_objects=moving if config.max_objects is None else config.max_objects,
            shadows=config.shadows,
        )
        self._enter(self._loaded, self._task_given)
        self._judge: Judge | None = None
        self._verdicts: Verdicts
        self._potential = 0.0
        self._goal: NDArray[np.uint8] | None = None
        self.sent: Observation | None = None
        """Pictures of the present state that were drawn elsewhere, for the observations; None to draw them here."""
        self.observation_space = self._spec.space(self.simulation.world)  # type: ignore[assignment]
        size = self.simulation.controller.size
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (size,), np.float32)

    @property
    def robot(self) -> str:
        """Name of the arm that does the task."""
        return self.placement.robot or self.config.arms

    @property
    def scene(self) -> Scene:
        """The scene at rest."""
        return self._loaded.scene

    @property
    def placement(self) -> Placement:
        """Where the robot stands, and the grasps that are within its reach."""
        return self.simulation.world.placement

    @property
    def instruction(self) -> str:
        """The task as one tells it to a person."""
        return self.task.instruction(self.scene)

    @property
    def horizon(self) -> int:
        """Steps in which the task can be done without haste."""
        return self.task.horizon(self.scene, self.control_freq)

    @property
    def objects(self) -> tuple[str, ...]:
        """Names of the rows of the state's "objects"."""
        return self.simulation.world.objects

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Start an episode.

        Args:
            seed: of the robot's posture, and with `vary` of where the objects are; the same seed gives the same episode
                bit for bit.
            options: "scene" (a folder or a scene) and "task" change what the episode is about, from now on; "index"
                says which scene of the suite this episode is about; "room" which room it is in, from now on.
        """
        super().reset(seed=seed)
        loaded, task = self._wanted(options or {})
        self._enter(loaded, task)
        self._loaded, self._task_given = loaded, task
        count = self.simulation.joints
        # Three standard deviations at most: a start posture that touches something is no start.
        noise = np.clip(self.np_random.standard_normal(count), -3.0, 3.0) * self.config.start_noise
        self.simulation.reset(noise)
        if vary(self.simulation, self.np_random, self.config.vary or 0.0):
            self.simulation.restart()
        observation, info = self._begin()
        return observation, {**info, "placement": self.placement.describe()}

    def restart(self) -> tuple[Observation, dict[str, Any]]:
        """Begin the episode in the present state, after something in the simulation was changed on purpose."""
        self.simulation.restart()
        return self._begin()

    @property
    def scene_checksum(self) -> str:
        """SHA-256 of the files that MuJoCo loaded."""
        return self._loaded.checksum

    @property
    def verdict(self) -> Verdict:
        """How far the episode is, and what the next move is about."""
        return Verdict(success=False) if self._judge is None else self._verdicts.of(0, self.scene)

    def observe(self) -> Observation:
        """What a policy sees of the present state."""
        return self._observation()

    def _begin(self) -> tuple[Observation, dict[str, Any]]:
        self._judge = self.task.judge(self.simulation.states)
        self._verdicts = self._judge.update(np.zeros(1))
        self._potential = float(self._verdicts.progress[0])
        self._goal = goal_image(self, self._spec) if self._spec.goal_image else None
        return self._observation(), self._info()

    def step(self, action: NDArray[np.float32]) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Do one action: observation, reward, terminated (success), truncated (the simulation failed), info."""
        self.simulation.step(self.command(action))
        return self.look()

    def command(self, action: NDArray[np.float32]) -> NDArray[np.float64]:
        """An action as the simulation takes it: finite numbers in [-1, 1], shape (controller.size,)."""
        if self._judge is None:
            raise gymnasium.error.ResetNeeded("reset the environment before its first step.")
        values = np.asarray(action, dtype=np.float64)
        size = self.simulation.controller.size
        if values.shape != (size,) or not np.isfinite(values).all():
            raise EnvironmentSetupError(f"an action is {size} finite numbers, got {action}.")
        return np.minimum(np.maximum(values, -1.0), 1.0)

    def look(self) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """What the control step that the simulation has done came to; as `step` returns it."""
        if self._judge is None:
            raise gymnasium.error.ResetNeeded("reset the environment before its first step.")
        self._verdicts = self._judge.update(self._period)
        broken = self.simulation.broken
        success = bool(self._verdicts.success[0]) and not broken
        before, self._potential = self._potential, 0.0 if broken else float(self._verdicts.progress[0])
        reward = float(success)
        if self.reward == "dense":
            reward = dense(before, self._potential, success, self.config.discount)
        return self._observation(), reward, success, broken, self._info()

    def render(self) -> NDArray[Any] | None:  # type: ignore[override]
        """A picture of the present state: RGB, shape (height, width, 3), or depth [m], shape (height, width)."""
        if self.render_mode is None:
            gymnasium.logger.warn('render needs a mode: gymnasium.make("PAT3D-v0", render_mode="rgb_array").')
            return None
        depth = self.render_mode == "depth_array"
        # Depth is no mean of several rays.
        picture = self.pictures.take(self.config.render_camera, *self.config.render_size, depth=depth, fine=not depth)
        return picture.depth if depth else picture.image

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies and pickles are environments about the same, with the same random numbers to come, before a reset."""
        about = (self._loaded, self._task_given, None if self._chosen is None else self._chosen.current)
        return _again, (self.config, about, self._np_random, self._np_random_seed)

    def __deepcopy__(self, memo: dict[int, Any]) -> TabletopEnv:
        """As `__reduce__` says."""
        made, about = self.__reduce__()
        return made(*copy.deepcopy(about, memo))

    def twin(self, *, own_model: bool) -> TabletopEnv:
        """Another environment about the present scene and task, with a state of its own; it does not compile again.

        Args:
            own_model: copy the compiled model, for those who change it; otherwise the two share it.
        """
        world = self.simulation.world
        if own_model:
            world = replace(world, model=copy.copy(world.model))
        # `copy.copy` goes by `__reduce__`, which makes everything anew.
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__)
        made.simulation = Simulation(world, self.control, self.control_freq, sleep=self.config.sleep)
        key = next(key for key, (_, simulation) in self._kept.items() if simulation is self.simulation)
        made._kept = {key: (self.task, made.simulation)}
        made._pictures, made._judge, made.sent = None, None, None
        made._np_random = None
        return made

    def close(self) -> None:
        """Free the graphics context."""
        if self._pictures is not None:
            self._pictures.close()
            self._pictures = None

    @property
    def pictures(self) -> Pictures:
        """Takes pictures of the present state."""
        if self._pictures is None:
            self._pictures = Pictures(self.simulation)
        return self._pictures

    def _wanted(self, options: dict[str, Any]) -> tuple[LoadedScene, str | Task | None]:
        """What the next episode is about."""
        valid = ("scene", "task", "room") if self._chosen is None else ("index", "room")
        unknown = sorted(set(options) - set(valid))
        if unknown:
            raise EnvironmentSetupError(f'no reset option "{", ".join(unknown)}". Options: {", ".join(valid)}.')
        if "room" in options:
            self.config = replace(self.config, room=options["room"])
        if self._chosen is not None:
            return self._chosen.next(self.np_random, options.get("index"))
        loaded = load(options["scene"]) if "scene" in options else self._loaded
        return loaded, options.get("task", self._task_given)

    def _enter(self, loaded: LoadedScene, task: str | Task | None) -> None:
        """Make `task` in `loaded` what the next episode is about; nothing changes where that is impossible."""
        name = task.spec if isinstance(task, Task) else str(task or "")
        around = self.config.around(loaded)
        key = (loaded.checksum, name, around)
        if key not in self._kept:
            chosen, placement = choose(loaded.scene, task, self.config.arms, loaded.checksum)
            robot = make_robot(placement.robot or self.config.arms)
            world = compose(loaded.scene, loaded.mjcf, robot, placement, around)
            self._kept[key] = (chosen, Simulation(world, self.control, self.control_freq, sleep=self.config.sleep))
            if len(self._kept) > _KEPT_WORLDS:
                del self._kept[next(iter(self._kept))]
                give_back()
        chosen, simulation = self._kept[key]
        observer = Observer(self._spec, simulation.world)
        self.task, self.simulation, self._observer = chosen, simulation, observer
        self._period = np.array([simulation.period])
        self._about = {"task": chosen.spec, "instruction": chosen.instruction(loaded.scene)}
        self.close()

    def _observation(self) -> Observation:
        seen = self._observer.observe(self.simulation.states, self._verdicts)
        observation = {name: values[0] for name, values in seen.items()}
        if self._goal is not None:
            observation["goal_image"] = self._goal
        if self._spec.kind == "state":
            return observation
        return observation | (pictured(self._spec, self.pictures) if self.sent is None else self.sent)

    def _info(self) -> dict[str, Any]:
        state, verdicts = self.simulation.state, self._verdicts
        toppled, fell = state.states.upsets()
        return {
            "success": bool(verdicts.success[0]),
            # As stable-baselines3 and LeRobot call it.
            "is_success": bool(verdicts.success[0]),
            "predicates": {name: bool(holds[0]) for name, holds in verdicts.predicates.items()},
            "progress": float(verdicts.progress[0]),
            "toppled": state.named(toppled),
            "fell": state.named(fell),
            "touched": state.named(state.states.touched()),
            **self._about,
            **({} if self._chosen is None else {"index": self._chosen.current}),
        }


def _again(
    config: TabletopConfig, about: tuple[LoadedScene, str | Task | None, int | None], random: Any, seed: int | None
) -> TabletopEnv:
    """The environment that `TabletopEnv.__reduce__` took apart."""
    made = TabletopEnv(config=config)
    made._loaded, made._task_given, index = about
    if made._chosen is not None and index is not None:
        made._chosen.current = index
    made._enter(made._loaded, made._task_given)
    made._np_random, made._np_random_seed = random, seed
    return made


def choose(scene: Scene, task: str | Task | None, robot: str, checksum: str | None = None) -> tuple[Task, Placement]:
    """The task and where the robot stands for it; without a task the scene's own, else the first possible pick.

    Args:
        scene: at rest.
        task: what to do.
        robot: one arm or two.
        checksum: of the files that MuJoCo loads for the scene, by which a placement is remembered; None to search.
    """
    task = scene.task if task is None else task
    if task is not None:
        if not isinstance(task, Task | str):
            raise EnvironmentSetupError(f'a task is text such as "pick:red mug", or a task, not {type(task).__name__}.')
        chosen = task if isinstance(task, Task) else parse_task(task)
        chosen.check(scene)
        return chosen, placed(scene, checksum, robot, chosen.needs(scene))
    reasons = []
    for obj in scene.objects:
        if obj.fixed:
            continue
        chosen = Pick(target=obj.name)
        try:
            return chosen, placed(scene, checksum, robot, chosen.needs(scene))
        except TaskError as error:
            reasons.append(str(error))
    raise TaskError("nothing in the scene can be picked: " + " ".join(reasons))
