"""Actions to motor torques of many worlds at once: robosuite's controllers as Warp kernels, a thread a world.

They compute what `pat3d.envs.controllers.RobotController` does, in double precision from MuJoCo Warp's single one.
"""

import functools
import math
from typing import Any

import mujoco
import numpy as np
import warp as wp

from pat3d.envs.controllers import part_settings
from pat3d.envs.robots import finger_targets
from pat3d.envs.world import World
from pat3d.errors import EnvironmentSetupError

CONTROLS = ("osc", "joint_position")

NULLSPACE_STIFFNESS = wp.constant(wp.float64(10.0))
"""Of the start posture among those of one hand pose [1/s^2], as in robosuite."""

SMALLEST_PIVOT = wp.constant(wp.float64(1.0e-12))
"""Of a factorisation: in a singular posture the hand's apparent inertia has no inverse."""


@wp.func
def rotation_by(turn: wp.vec3d) -> wp.mat33d:
    """The matrix of a rotation vector [rad]."""
    angle = wp.length(turn)
    if angle < wp.float64(1.0e-12):
        return wp.identity(n=3, dtype=wp.float64)
    return wp.quat_to_matrix(wp.quat_from_axis_angle(turn / angle, angle))


@wp.kernel
def aim_hand(
    action: wp.array2d[wp.float32], scale: wp.array[wp.float64], base: wp.mat33d, site: int,
    site_position: wp.array2d[wp.vec3], site_rotation: wp.array2d[wp.mat33],
    goal_position: wp.array[wp.vec3d], goal_rotation: wp.array[wp.mat33d],
):  # fmt: skip
    """The hand's goal: its present pose, moved by the action along the axes of the robot's base."""
    world = wp.tid()
    shift = wp.vec3d()
    turn = wp.vec3d()
    for k in range(3):
        shift[k] = wp.float64(action[world, k]) * scale[k]
        turn[k] = wp.float64(action[world, 3 + k]) * scale[3 + k]
    goal_position[world] = wp.vec3d(site_position[world, site]) + base * shift
    goal_rotation[world] = base * rotation_by(turn) * wp.transpose(base) * wp.mat33d(site_rotation[world, site])


@wp.kernel
def aim_joints(
    action: wp.array2d[wp.float32], scale: wp.array[wp.float64], positions: wp.array[int],
    qpos: wp.array2d[wp.float32], goal: wp.array2d[wp.float64],
):  # fmt: skip
    """The joints' goal: their present positions, moved by the action."""
    world, joint = wp.tid()
    goal[world, joint] = wp.float64(qpos[world, positions[joint]]) + wp.float64(action[world, joint]) * scale[joint]


@wp.kernel
def move_fingers(
    action: wp.array2d[wp.float32], arm: int, stride: wp.array[wp.float32], middle: wp.array[wp.float32],
    reach: wp.array[wp.float32], actuators: wp.array[int], opening: wp.array2d[wp.float32],
    control: wp.array2d[wp.float32],
):  # fmt: skip
    """Move every finger's target one stride in the direction that the last value of the action says."""
    world, finger = wp.tid()
    told = action[world, arm]
    if told != 0.0:
        opening[world, finger] = wp.clamp(opening[world, finger] + wp.sign(told) * stride[finger], -1.0, 1.0)
    control[world, actuators[finger]] = middle[finger] + reach[finger] * opening[world, finger]


@functools.cache
def cholesky(size: int) -> tuple[Any, Any, wp.Function, wp.Function]:
    """Vectors and matrices of `size` in double precision, and functions that factor and solve with them."""
    vector = wp.types.vector(size, wp.float64)
    matrix = wp.types.matrix((size, size), wp.float64)

    @wp.func
    def factor(a: matrix) -> matrix:
        """Lower triangular L with L L^T = a."""
        lower = matrix()
        for j in range(size):
            pivot = a[j, j]
            for k in range(j):
                pivot -= lower[j, k] * lower[j, k]
            root = wp.sqrt(wp.max(pivot, SMALLEST_PIVOT))
            lower[j, j] = root
            for i in range(j + 1, size):
                value = a[i, j]
                for k in range(j):
                    value -= lower[i, k] * lower[j, k]
                lower[i, j] = value / root
        return lower

    @wp.func
    def solve(lower: matrix, b: vector) -> vector:
        """The solution of L L^T x = b."""
        x = vector()
        for i in range(size):
            value = b[i]
            for k in range(i):
                value -= lower[i, k] * x[k]
            x[i] = value / lower[i, i]
        for back in range(size):
            i = size - 1 - back
            value = x[i]
            for k in range(i + 1, size):
                value -= lower[k, i] * x[k]
            x[i] = value / lower[i, i]
        return x

    return vector, matrix, factor, solve


@functools.cache
def torque_kernels(joints: int) -> tuple[wp.Kernel, wp.Kernel]:
    """The kernels of the operational-space and of the joint-position controller for an arm of so many joints."""
    vector, matrix, factor, solve = cholesky(joints)
    _, six, factor_six, solve_six = cholesky(6)
    jacobian = wp.types.matrix((6, joints), wp.float64)

    @wp.func
    def mass_of(world: int, mass: wp.array2d[wp.float32], place: wp.array2d[int]) -> matrix:
        """The arm's block of the inertia matrix."""
        found = matrix()
        for i in range(joints):
            for j in range(joints):
                if place[i, j] >= 0:
                    found[i, j] = wp.float64(mass[world, place[i, j]])
        return found

    @wp.kernel(module="unique")
    def operational_space(
        gain: wp.float64, damping: wp.float64, start: wp.array2d[wp.float64], goal_position: wp.array[wp.vec3d],
        goal_rotation: wp.array[wp.mat33d], site: int, site_position: wp.array2d[wp.vec3],
        site_rotation: wp.array2d[wp.mat33], joint_anchor: wp.array2d[wp.vec3], joint_axis: wp.array2d[wp.vec3],
        ids: wp.array[int], positions: wp.array[int], velocities: wp.array[int], actuators: wp.array[int],
        limits: wp.array2d[wp.float64], qpos: wp.array2d[wp.float32], qvel: wp.array2d[wp.float32],
        bias: wp.array2d[wp.float32], mass: wp.array2d[wp.float32], place: wp.array2d[int],
        control: wp.array2d[wp.float32],
    ):  # fmt: skip
        """Torques J^T (Lambda (K e - D v)) + bias, and what pulls to the start posture without moving the hand."""
        world = wp.tid()
        hand = wp.vec3d(site_position[world, site])
        turned = wp.mat33d(site_rotation[world, site])
        j = jacobian()
        speed = vector()
        pull = vector()
        for k in range(joints):
            axis = wp.vec3d(joint_axis[world, ids[k]])
            arm = wp.cross(axis, hand - wp.vec3d(joint_anchor[world, ids[k]]))
            for row in range(3):
                j[row, k] = arm[row]
                j[3 + row, k] = axis[row]
            speed[k] = wp.float64(qvel[world, velocities[k]])
            away = start[world, k] - wp.float64(qpos[world, positions[k]])
            pull[k] = NULLSPACE_STIFFNESS * away - wp.float64(2.0) * wp.sqrt(NULLSPACE_STIFFNESS) * speed[k]
        moving = j * speed
        shift = goal_position[world] - hand
        turn = wp.vec3d()
        for column in range(3):
            now = wp.vec3d(turned[0, column], turned[1, column], turned[2, column])
            wanted = wp.vec3d(
                goal_rotation[world][0, column], goal_rotation[world][1, column], goal_rotation[world][2, column]
            )
            turn += wp.float64(0.5) * wp.cross(now, wanted)
        inertia = mass_of(world, mass, place)
        lower = factor(inertia)
        # Columns of M^-1 J^T, and J M^-1 J^T.
        apparent = six()
        for row in range(6):
            wrench_row = vector()
            for k in range(joints):
                wrench_row[k] = j[row, k]
            column_of = j * solve(lower, wrench_row)
            for other in range(6):
                apparent[other, row] = column_of[other]
        linear = wp.mat33d()
        angular = wp.mat33d()
        push = wp.vec3d()
        twist = wp.vec3d()
        for row in range(3):
            push[row] = gain * shift[row] - damping * moving[row]
            twist[row] = gain * turn[row] - damping * moving[3 + row]
            for column in range(3):
                linear[row, column] = apparent[row, column]
                angular[row, column] = apparent[3 + row, 3 + column]
        force = wp.inverse(linear) * push
        torque = wp.inverse(angular) * twist
        # (I - J^T Lambda J M^-1) M pull = M pull - J^T Lambda (J pull)
        blocked = solve_six(factor_six(apparent), j * pull)
        posture = inertia * pull
        for k in range(joints):
            total = posture[k] + wp.float64(bias[world, velocities[k]])
            for row in range(3):
                total += j[row, k] * (force[row] - blocked[row])
                total += j[3 + row, k] * (torque[row] - blocked[3 + row])
            control[world, actuators[k]] = wp.float32(wp.clamp(total, limits[0, k], limits[1, k]))

    @wp.kernel(module="unique")
    def joint_position(
        gain: wp.float64, damping: wp.float64, goal: wp.array2d[wp.float64], positions: wp.array[int],
        velocities: wp.array[int], actuators: wp.array[int], limits: wp.array2d[wp.float64],
        qpos: wp.array2d[wp.float32], qvel: wp.array2d[wp.float32], bias: wp.array2d[wp.float32],
        mass: wp.array2d[wp.float32], place: wp.array2d[int], control: wp.array2d[wp.float32],
    ):  # fmt: skip
        """Torques M (K e - D v) + bias."""
        world = wp.tid()
        pull = vector()
        for k in range(joints):
            away = goal[world, k] - wp.float64(qpos[world, positions[k]])
            pull[k] = gain * away - damping * wp.float64(qvel[world, velocities[k]])
        torque = mass_of(world, mass, place) * pull
        for k in range(joints):
            total = torque[k] + wp.float64(bias[world, velocities[k]])
            control[world, actuators[k]] = wp.float32(wp.clamp(total, limits[0, k], limits[1, k]))

    return operational_space, joint_position


class BatchedController:
    """Turns actions in [-1, 1] of every world into controls: arm first, the gripper's opening last.

    Args:
        world: with the robot.
        data: MuJoCo Warp's.
        kind: "osc" or "joint_position".

    Raises:
        EnvironmentSetupError: no such kind here.
    """

    def __init__(self, world: World, data: Any, kind: str) -> None:
        if kind not in CONTROLS:
            raise EnvironmentSetupError(
                f'on a GPU there is no control "{kind}". Controls there: {", ".join(CONTROLS)}; others run on CPUs: '
                'gymnasium.make_vec(..., vectorization_mode="async").'
            )
        model, robot, prefix = world.model, world.robot, world.prefix
        self.kind, self._data = kind, data
        self._worlds = data.nworld
        self._device = data.qpos.device
        settings = {**part_settings(kind), **(robot.controller if kind == "osc" else {})}
        if kind == "osc" and not (settings["uncouple_pos_ori"] and settings["input_ref_frame"] == "base"):
            raise EnvironmentSetupError(f"{robot.name}: its controller couples position and orientation.")
        joints = [model.joint(prefix + name) for name in robot.arm_joints]
        count = len(joints)
        self.size = (6 if kind == "osc" else count) + 1
        """Number of values of an action."""
        self._gain = float(settings["kp"])
        self._damping = 2.0 * math.sqrt(self._gain) * float(settings["damping_ratio"])
        arm_actuators = [model.actuator(prefix + name).id for name in robot.arm_actuators]
        self._ids = self._array([joint.id for joint in joints], int)
        self._positions = self._array([int(joint.qposadr[0]) for joint in joints], int)
        dofs = [int(joint.dofadr[0]) for joint in joints]
        self._velocities = self._array(dofs, int)
        self._actuators = self._array(arm_actuators, int)
        self._limits = self._array(model.actuator_ctrlrange[arm_actuators].T, wp.float64)
        self._scale = self._array(np.broadcast_to(np.asarray(settings["output_max"], dtype=np.float64), self.size - 1),
                                  wp.float64)  # fmt: skip
        self._site = int(model.site(prefix + robot.grip_site).id)
        base = mujoco.MjData(model)
        mujoco.mj_kinematics(model, base)
        self._base = wp.mat33d(*base.site_xmat[model.site(prefix + robot.base_site).id])
        self._mass = data.M.reshape((self._worlds, -1))
        self._place = self._array(_places(model, data, dofs), int)
        self._operational, self._joint_position = torque_kernels(count)
        self._action = wp.zeros((self._worlds, self.size), dtype=wp.float32, device=self._device)
        self.start = wp.zeros((self._worlds, count), dtype=wp.float64, device=self._device)
        """The posture that each world's arm keeps to where the hand's pose leaves a choice [rad]."""
        self._goal_position = wp.zeros(self._worlds, dtype=wp.vec3d, device=self._device)
        self._goal_rotation = wp.zeros(self._worlds, dtype=wp.mat33d, device=self._device)
        self._goal = wp.zeros((self._worlds, count), dtype=wp.float64, device=self._device)
        gripper = robot.new_gripper()
        before = np.array(gripper.current_action, dtype=np.float64)
        stride = np.array(gripper.format_action(np.ones(1))) - before
        fingers = len(robot.gripper_actuators)
        middle = finger_targets(model, robot, np.zeros(fingers), prefix)
        self._middle = self._array(middle, wp.float32)
        self._reach = self._array(finger_targets(model, robot, np.ones(fingers), prefix) - middle, wp.float32)
        self._stride = self._array(np.broadcast_to(stride, fingers), wp.float32)
        self._untouched = np.broadcast_to(before, fingers).astype(np.float32)
        self._fingers = self._array([model.actuator(prefix + name).id for name in robot.gripper_actuators], int)
        self._opening = wp.zeros((self._worlds, fingers), dtype=wp.float32, device=self._device)

    def reset(self, worlds: np.ndarray, postures: np.ndarray) -> None:
        """Forget the earlier actions of `worlds`, whose arms are in `postures` [rad], shape (len(worlds), joints)."""
        start, opening = self.start.numpy(), self._opening.numpy()
        start[worlds], opening[worlds] = postures, self._untouched
        self.start.assign(start)
        self._opening.assign(opening)

    def set_action(self, action: np.ndarray) -> None:
        """Take actions, shape (worlds, size), at the start of a control step; positions must be up to date."""
        self._action.assign(np.ascontiguousarray(action, dtype=np.float32))
        data = self._data
        if self.kind == "osc":
            self._launch(aim_hand, self._worlds, [
                self._action, self._scale, self._base, self._site, data.site_xpos, data.site_xmat,
                self._goal_position, self._goal_rotation,
            ])  # fmt: skip
        else:
            self._launch(aim_joints, (self._worlds, self.size - 1),
                         [self._action, self._scale, self._positions, data.qpos, self._goal])  # fmt: skip
        self._launch(move_fingers, (self._worlds, len(self._fingers)), [
            self._action, self.size - 1, self._stride, self._middle, self._reach, self._fingers, self._opening,
            data.ctrl,
        ])  # fmt: skip

    def control(self) -> None:
        """Write the torques of this physics step; positions and velocities must be up to date."""
        data = self._data
        if self.kind == "osc":
            self._launch(self._operational, self._worlds, [
                self._gain, self._damping, self.start, self._goal_position, self._goal_rotation, self._site,
                data.site_xpos, data.site_xmat, data.xanchor, data.xaxis, self._ids, self._positions,
                self._velocities, self._actuators, self._limits, data.qpos, data.qvel, data.qfrc_bias, self._mass,
                self._place, data.ctrl,
            ])  # fmt: skip
        else:
            self._launch(self._joint_position, self._worlds, [
                self._gain, self._damping, self._goal, self._positions, self._velocities, self._actuators, self._limits,
                data.qpos, data.qvel, data.qfrc_bias, self._mass, self._place, data.ctrl,
            ])  # fmt: skip

    def _launch(self, kernel: wp.Kernel, dim: Any, inputs: list[Any]) -> None:
        wp.launch(kernel, dim=dim, inputs=inputs, device=self._device)

    def _array(self, values: Any, dtype: Any) -> wp.array:
        return wp.array(np.ascontiguousarray(values), dtype=dtype, device=self._device)


def _places(model: Any, data: Any, dofs: list[int]) -> np.ndarray:
    """Where each entry of the arm's inertia is in a world's row of `data.M`, -1 where it is zero."""
    if data.M.shape[1] != 1:
        return np.array([[row * data.M.shape[2] + column for column in dofs] for row in dofs], dtype=np.int32)
    places = np.full((len(dofs), len(dofs)), -1, dtype=np.int32)
    for a, row in enumerate(dofs):
        first, count = int(model.M_rowadr[row]), int(model.M_rownnz[row])
        for entry in range(first, first + count):
            column = int(model.M_colind[entry])
            if column in dofs:
                places[a, dofs.index(column)] = places[dofs.index(column), a] = entry
    return places
