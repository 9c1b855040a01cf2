"""A second door: the scene as a native robosuite environment, for people whose tools expect one.

    import robosuite
    import pat3d.envs.robosuite_env
    env = robosuite.make("PAT3DScene", robots="Panda", scene="scenes/desk", task="pick:red mug", use_camera_obs=False)

The world is the same as that of PAT3D-v0: robosuite's arm is attached to the exported MJCF, whose options it steps.
robosuite compiles it anew at every reset unless hard_reset=False.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from pat3d.envs.config import Source
from pat3d.envs.env import choose
from pat3d.envs.physics.loading import DEFAULT_TASK, load
from pat3d.envs.physics.mujoco_state import MujocoState
from pat3d.envs.physics.state import SimState
from pat3d.envs.physics.views import ANGLES
from pat3d.envs.physics.world import furnish, index
from pat3d.envs.reward import dense
from pat3d.envs.robots.arms import make_robot
from pat3d.envs.robots.robosuite_arms import robosuite_module
from pat3d.envs.tasks.task import Judge, Task, Verdict
from pat3d.errors import EnvironmentSetupError

_Base: Any = robosuite_module("environments.manipulation.manipulation_env").ManipulationEnv


class PAT3DScene(_Base):
    """A scene of PAT3D with its task; every other argument is robosuite's own.

    Args:
        robots: one of the arms of PAT3D-v0.
        scene: a scene folder or a pat3d.Scene; None for the one that ships with the package.
        task: as for PAT3D-v0.
        reward_shaping: the dense reward of PAT3D-v0 instead of 1 at success.
        reward_scale: factor on either.
        discount: of the learner, for the dense reward.
        use_object_obs: whether the poses of objects are observed.
        **options: of robosuite's ManipulationEnv.
    """

    def __init__(
        self,
        robots: str = "Panda",
        scene: Source = None,
        task: str | Task | None = None,
        reward_shaping: bool = False,
        reward_scale: float = 1.0,
        discount: float = 0.99,
        use_object_obs: bool = True,
        **options: Any,
    ) -> None:
        if not isinstance(robots, str):
            raise EnvironmentSetupError("PAT3DScene has one robot; give its name.")
        self._robot = make_robot(robots)
        self._loaded = load(scene)
        given = DEFAULT_TASK if scene is None and task is None else task
        self.task, self.placement = choose(self._loaded.scene, given, robots)
        self.reward_shaping, self.reward_scale, self.discount = reward_shaping, reward_scale, discount
        self.use_object_obs = use_object_obs
        self.placement_initializer = None
        """Where robosuite's own tasks draw their objects' places; here the scene says them."""
        self._judge: Judge | None = None
        self._verdict = self._before = Verdict(success=False)
        options.setdefault("gripper_types", self._robot.robosuite.gripper_name)
        super().__init__(robots=robots, base_types="NullMount", **options)

    def reward(self, action: Any = None) -> float:
        """Of the last step: 1 at success, or the dense one with reward_shaping; times reward_scale."""
        now = self._verdict
        if not self.reward_shaping:
            return self.reward_scale * float(now.success)
        # An episode goes on here after success, for which there is one bonus.
        first = now.success and not self._before.success
        return self.reward_scale * float(dense(self._before.progress, now.progress, first, self.discount))

    def _post_action(self, action: Any) -> tuple[float, bool, dict[str, Any]]:
        self._before, self._verdict = self._verdict, self._follow(self.control_timestep)
        reward, done, info = super()._post_action(action)
        return reward, done, {**info, "success": self._verdict.success, "progress": self._verdict.progress}

    def _initialize_sim(self, xml_string: str | None = None) -> None:
        """Attach robosuite's own world, which is the robot alone, to the scene, and compile both as they are.

        Writing the whole as text, as robosuite would, rounds every number to six digits.
        """
        import mujoco

        text = xml_string or self.model.get_xml()
        for processor in self._xml_processors:
            text = processor(text)
        own = mujoco.MjSpec.from_string(text)
        for camera in list(own.cameras):
            if camera.name in ANGLES:
                own.delete(camera)
        for thing in (*own.worldbody.geoms, *own.lights):
            own.delete(thing)
        spec = mujoco.MjSpec.from_file(str(self._loaded.mjcf))
        furnish(spec, self.placement)
        spec.attach(own, prefix="", frame=spec.worldbody.add_frame())
        self.sim = robosuite_module("utils.binding_utils").MjSim(spec.compile())
        self.sim.forward()
        self.initialize_time(self.control_freq)

    def _load_model(self) -> None:
        super()._load_model()
        arm = self.robots[0].robot_model
        arm.set_base_xpos(np.array(self.placement.base_position))
        arm.set_base_ori(np.array([0.0, 0.0, self.placement.yaw]))
        arena = robosuite_module("models.arenas").EmptyArena()
        self.model = robosuite_module("models.tasks").ManipulationTask(mujoco_arena=arena, mujoco_robots=[arm])

    def _setup_references(self) -> None:
        super()._setup_references()
        world = index(self.sim.model._model, self._loaded.scene, self._robot, self.placement, prefix="")
        self.states = MujocoState(world, self.sim.data._data)
        self.state = SimState(self.states)

    def _reset_internal(self) -> None:
        super()._reset_internal()
        self.sim.forward()
        self.states.begin()
        self._judge = self.task.judge(self.states)
        self._before = self._verdict = self._follow(0.0)

    def _follow(self, seconds: float) -> Verdict:
        if self._judge is None:
            return self._verdict
        self.states.refresh()
        return self._judge.update(np.array([seconds])).of(0, self._loaded.scene)

    def _check_success(self) -> bool:
        return self._verdict.success

    def _setup_observables(self) -> Any:
        observables = super()._setup_observables()
        if not self.use_object_obs:
            return observables
        observable = robosuite_module("utils.observables")
        sensor: Any = observable.sensor
        for name in self.state.world.objects:
            slug = name.replace(" ", "_")

            @sensor(modality="object")
            def position(cache: Any, name: str = name) -> Any:
                return np.array(self.state.position(name))

            @sensor(modality="object")
            def orientation(cache: Any, name: str = name) -> Any:
                # Robosuite writes quaternions with the scalar last.
                return np.roll(self.state.quat_wxyz(name), -1)

            for suffix, read in (("pos", position), ("quat", orientation)):
                full = f"{slug}_{suffix}"
                observables[full] = observable.Observable(name=full, sensor=read, sampling_rate=self.control_freq)
        return observables
