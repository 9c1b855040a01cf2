"""The simulated world of an environment: the exported scene as it is, with a robot attached, furniture and cameras.

The scene's frame stays the world's, so every pose, contact parameter, inertia and solver option is the one that was
verified. What is added: the robot on its pedestal; for a scene on the ground, the ground's extent becomes the top of a
workbench, with a floor below.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.standing import Placement, Stand
from pat3d.envs.physics.memory import bound_compiler_cache
from pat3d.envs.physics.views import ANGLES, aim
from pat3d.envs.robots.arms import make_robot
from pat3d.envs.robots.assembly import take_options
from pat3d.envs.robots.robot import Robot
from pat3d.envs.surroundings.lights import light_up
from pat3d.envs.surroundings.surroundings import PLAIN, Surroundings
from pat3d.errors import EnvironmentSetupError
from pat3d.exporters.common.objects import GROUND_HALF_THICKNESS, body_names
from pat3d.scene.model import Scene

PREFIX = "robot/"
"""Of every name that belongs to the robot."""

CAMERAS = ("agentview", "frontview", "closeview", "wrist")
"""Of one arm; of two, `cameras_of` says."""

_HIDDEN_GROUP = 4
"""Sites and collision geoms of the robot are drawn only when asked for."""

_SHADOW_REACH = 1.6
"""[m]"""

_TOP_THICKNESS = 0.04
_LEG = 0.03
"""Of the drawn workbench [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Mounted:
    """An arm where it stands in a world."""

    robot: Robot
    prefix: str
    """Before every name that belongs to it."""
    side: str
    """"left" or "right"; nothing for a single arm."""
    yaw: float
    """Direction in which it faces [rad]."""
    start: tuple[float, ...]
    """Joint positions at the start [rad]."""

    @property
    def key(self) -> str:
        """Before the names of its observations and of its camera."""
        return f"{self.side}_" if self.side else ""


@dataclass(frozen=True, kw_only=True, eq=False)
class World:
    """A compiled world and where its parts are."""

    model: Any
    scene: Scene
    robot: Robot
    """The arm that does the task."""
    placement: Placement
    prefix: str
    """Before every name that belongs to that arm."""
    arms: tuple[Mounted, ...]
    """All arms, the left one of two first."""
    objects: tuple[str, ...]
    """Objects that can move, in the order of the scene."""
    bodies: dict[str, int]
    """MuJoCo body of every object of the scene, fixed ones too."""
    positions: NDArray[np.int64]
    """First entry in qpos of every moving object, shape (objects,)."""
    velocities: NDArray[np.int64]
    """First entry in qvel of every moving object, shape (objects,)."""
    owner: NDArray[np.int64]
    """Whose every geom is: index into the scene's objects, or one of ROBOT, SUPPORT, FLOOR; shape (geoms,)."""
    idle: NDArray[np.bool_]
    """Which geoms are of an arm that has nothing to do for the task, shape (geoms,)."""

    def arm(self, side: str) -> Mounted:
        """The arm on one side."""
        return next(one for one in self.arms if one.side == side)


ROBOT, SUPPORT, FLOOR = -1, -2, -3
"""Owners of geoms that are no object's: the robot, what the scene stands on, and the floor below a workbench."""


def without_robot(world: World) -> World:
    """A world as it can be sent to another process: what makes robots cannot; see `with_robot`."""
    nobody: Any = None
    return replace(world, robot=nobody, arms=tuple(replace(arm, robot=nobody) for arm in world.arms))


def with_robot(world: World, robot: Robot) -> World:
    """A world of one arm that `without_robot` made ready to be sent, and that has arrived."""
    return replace(world, robot=robot, arms=tuple(replace(arm, robot=robot) for arm in world.arms))


def compose(scene: Scene, mjcf: Path, robot: Robot, placement: Placement, around: Surroundings = PLAIN) -> World:
    """Attach `robot`, which does the task, and the other arm of two to the scene in the file `mjcf`, in a room.

    Raises:
        EnvironmentSetupError: MuJoCo refuses the scene or the combination; the message is MuJoCo's.
    """
    import mujoco

    bound_compiler_cache()
    try:
        spec = mujoco.MjSpec.from_file(str(mjcf))
        _man(mujoco, spec, robot, placement)
        furnish(spec, placement, around, _extent(scene, placement))
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise EnvironmentSetupError(f"{mjcf}: MuJoCo {mujoco.__version__} refuses the scene: {error}") from error
    return index(model, scene, robot, placement)


def _man(mujoco: Any, spec: Any, robot: Robot, placement: Placement) -> None:
    """Attach all arms of a placement to an MjSpec, with their cameras."""
    for one, where in _mounts(robot, placement):
        _attach(mujoco, spec, one.robot, where, one.prefix)
        spec.camera(one.prefix + one.robot.wrist_camera).name = f"{one.key}wrist"


def without_scene(world: World) -> Any:
    """An MjSpec of the robot and the cameras of a world alone, with that world's options."""
    import mujoco

    spec = mujoco.MjSpec()
    for name in dir(spec.option):
        if not name.startswith("_") and hasattr(world.model.opt, name):
            setattr(spec.option, name, getattr(world.model.opt, name))
    _man(mujoco, spec, world.robot, world.placement)
    for name in ANGLES:
        spec.worldbody.add_camera(name=name)
    return spec


def cameras_of(sides: Sequence[str]) -> tuple[str, ...]:
    """Names of the cameras in a world with arms on these sides."""
    return CAMERAS if len(sides) < 2 else (*CAMERAS[:-1], *(f"{side}_{CAMERAS[-1]}" for side in sides))


def _mounts(robot: Robot, placement: Placement) -> list[tuple[Mounted, Placement | Stand]]:
    """The arms of a placement and where they are bolted, the left one of two first."""
    arms: list[tuple[Mounted, Placement | Stand]] = []
    both = [
        (robot, placement),
        *([] if placement.other is None else [(make_robot(placement.other.robot), placement.other)]),
    ]
    for one, where in sorted(both, key=lambda pair: pair[1].side):
        prefix = f"{PREFIX}{where.side}/" if where.side else PREFIX
        arms.append((Mounted(robot=one, prefix=prefix, side=where.side, yaw=where.yaw, start=where.start), where))
    return arms


def _extent(scene: Scene, placement: Placement) -> NDArray[np.float64]:
    """Points that a room goes around [m], shape (n, 2): the objects, the bases of the arms and the workbench."""
    bases = [placement.base_position, *([] if placement.other is None else [placement.other.base_position])]
    corners = [*(base[:2] for base in bases), *(placement.bench or ())]
    parts = [obj.pose.apply(part.vertices)[:, :2] for obj in scene.objects for part in obj.asset.parts]
    return np.concatenate([np.array(corners, dtype=np.float64), *parts])


def furnish(
    spec: Any, placement: Placement, around: Surroundings = PLAIN, extent: NDArray[np.float64] | None = None
) -> None:
    """Add to the scene's MjSpec what the robot stands on, the workbench where there is one, cameras, and light.

    Args:
        spec: of the scene with the robot.
        placement: of the robot.
        around: the room and the light; a bare bench has no need of the next.
        extent: points that a room goes around [m], shape (n, 2).
    """
    import mujoco

    if placement.bench is not None:
        _bench(mujoco, spec, placement)
    _pedestal(mujoco, spec, placement, placement.base_position, "pedestal")
    if placement.other is not None:
        _pedestal(mujoco, spec, placement, placement.other.base_position, "pedestal/other")
    view = placement.yaw if placement.view is None else placement.view
    light_up(spec, around.put(spec, placement.bench, placement.floor, view, extent))
    for name in ANGLES:
        spec.worldbody.add_camera(name=name)
    # Shadows reach as far as the robot does, not only around the objects.
    spec.visual.map.shadowclip = max(1.0, _SHADOW_REACH / spec.stat.extent)


def _attach(mujoco: Any, spec: Any, robot: Robot, placement: Placement | Stand, prefix: str = PREFIX) -> None:
    child = robot.new_spec()
    for geom in child.geoms:
        if geom.group == 0:
            geom.group = 3
    for site in child.sites:
        site.group = _HIDDEN_GROUP
    # robosuite draws its tool frame with tendons and sites alone; its own camera of the robot is of no use here.
    frame = spec.worldbody.add_frame(
        pos=placement.base_position, quat=[math.cos(placement.yaw / 2), 0.0, 0.0, math.sin(placement.yaw / 2)]
    )
    take_options(child, spec)
    spec.attach(child, prefix=prefix, frame=frame)
    # Some arms' first link turns inside the flange that stands on the pedestal, and would rub on that.
    first = spec.joint(prefix + robot.arm_joints[0]).parent.name
    spec.add_exclude(bodyname1="world", bodyname2=first)


def _bench(mujoco: Any, spec: Any, placement: Placement) -> None:
    """Cut the ground to the top of a workbench and put a floor below it."""
    (low_x, low_y), (high_x, high_y) = placement.bench  # type: ignore[misc]
    centre = [(low_x + high_x) / 2, (low_y + high_y) / 2]
    half = [(high_x - low_x) / 2, (high_y - low_y) / 2]
    ground = spec.geom("ground")
    ground.pos, ground.size = [*centre, ground.pos[2]], [*half, ground.size[2]]
    ground.rgba = [0, 0, 0, 0]
    drawn = spec.geom("ground_visual")
    drawn.pos = [0, 0, placement.floor]
    wood = spec.add_material(name="bench", rgba=[0.90, 0.87, 0.81, 1.0], specular=0.15, shininess=0.2)
    steel = spec.add_material(name="bench/legs", rgba=[0.33, 0.34, 0.36, 1.0], specular=0.3, shininess=0.4)

    def box(name: str, position: list[float], size: list[float], material: Any) -> None:
        spec.worldbody.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=position,
            size=size,
            material=material.name,
            contype=0,
            conaffinity=0,
            group=0,
            mass=0.0,
        )

    # A hair below the plane on which objects rest, so that the two never flicker.
    box("bench/top", [*centre, -_TOP_THICKNESS / 2 - 1e-5], [*half, _TOP_THICKNESS / 2], wood)
    legs = (placement.floor - _TOP_THICKNESS) / 2
    for number, (x, y) in enumerate(((-1, -1), (-1, 1), (1, -1), (1, 1))):
        corner = [centre[0] + x * (half[0] - 2 * _LEG), centre[1] + y * (half[1] - 2 * _LEG)]
        box(f"bench/leg_{number}", [*corner, legs], [_LEG, _LEG, -legs - _TOP_THICKNESS], steel)
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        group=3,
        friction=ground.friction,
        condim=ground.condim,
        solref=ground.solref,
        solimp=ground.solimp,
        pos=[0, 0, placement.floor - GROUND_HALF_THICKNESS],
        size=[5.0, 5.0, GROUND_HALF_THICKNESS],
        rgba=[0, 0, 0, 0],
    )


def _pedestal(mujoco: Any, spec: Any, placement: Placement, base: tuple[float, float, float], name: str) -> None:
    x, y, top = base
    height = top - placement.floor
    if height < 1e-3:
        return
    spec.worldbody.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_CYLINDER,
        pos=[x, y, placement.floor + height / 2],
        size=[placement.pedestal_radius, height / 2, 0],
        rgba=[0.25, 0.26, 0.28, 1.0],
        group=0,
    )


def index(model: Any, scene: Scene, robot: Robot, placement: Placement, prefix: str = PREFIX) -> World:
    """Where the parts of a compiled world are; its fixed cameras are placed to show them.

    Args:
        model: MuJoCo's.
        scene: whose MJCF is in it.
        robot: that is in it and does the task.
        placement: of the robot.
        prefix: before every name of the robot; robosuite's own worlds have none.
    """
    starts = prefix or robot.owned
    arms = tuple(one for one, _ in _mounts(robot, placement))
    if prefix != PREFIX:
        arms = (replace(arms[0], prefix=prefix),)
    working = next(one for one in arms if one.side == placement.side)
    other = next((one.prefix for one in arms if one is not working), None)
    idle = np.zeros(model.ngeom, dtype=np.bool_)
    names = body_names(scene)
    bodies = {obj.name: int(model.body(names[obj.name]).id) for obj in scene.objects}
    moving = tuple(obj.name for obj in scene.objects if not obj.fixed)
    joints = [model.joint(names[name]) for name in moving]
    order = {body: number for number, body in enumerate(bodies.values())}
    owner = np.full(model.ngeom, SUPPORT, dtype=np.int64)
    for geom in range(model.ngeom):
        body, name = int(model.geom_bodyid[geom]), model.geom(geom).name
        if body in order:
            owner[geom] = order[body]
        elif model.body(body).name.startswith(starts) or name.startswith("pedestal"):
            owner[geom] = ROBOT
            idle[geom] = other is not None and (model.body(body).name.startswith(other) or name == "pedestal/other")
        elif name == "floor" or (name == "ground" and placement.host is not None):
            owner[geom] = FLOOR
    posture = {
        arm.prefix + joint: value
        for arm in arms
        for joint, value in zip(
            (*arm.robot.arm_joints, *arm.robot.gripper_joints), (*arm.start, *arm.robot.gripper_home), strict=True
        )
    }
    hands = [arm.prefix + arm.robot.grip_site for arm in arms]
    aim(model, scene, placement, owner == ROBOT, posture, hands)
    return World(
        model=model,
        scene=scene,
        robot=robot,
        placement=placement,
        prefix=working.prefix,
        arms=arms,
        objects=moving,
        bodies=bodies,
        positions=np.array([int(joint.qposadr[0]) for joint in joints], dtype=np.int64),
        velocities=np.array([int(joint.dofadr[0]) for joint in joints], dtype=np.int64),
        owner=owner,
        idle=idle,
    )
