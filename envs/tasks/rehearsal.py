"""Whether an arm can do a task: the scripted plan gone through without physics, one move after the other."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pat3d.envs.grasping.placement import Placement, place
from pat3d.envs.physics.simulation import Simulation
from pat3d.envs.physics.world import compose
from pat3d.envs.robots.arms import make_robot
from pat3d.envs.tasks.hands import rehearse_together
from pat3d.envs.tasks.moves import Array, Move, Planner
from pat3d.envs.tasks.pulls import PullPlanner
from pat3d.envs.tasks.push import Push
from pat3d.envs.tasks.strokes import StrokePlanner
from pat3d.envs.tasks.task import Opening, Task
from pat3d.envs.tasks.together import Carry, HandOver
from pat3d.errors import EnvironmentSetupError, TaskError
from pat3d.geometry.pose import Pose
from pat3d.scene.model import GROUND, Scene

SINK = 2e-4
"""What is put down overlaps what carries it by this [m], so that the two touch."""

FALL = 0.004
"""Between the heights at which it is tried [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Workplace:
    """A scene with a robot in front of it, which stands still."""

    scene: Scene
    task: Task
    robot: str
    placement: Placement
    simulation: Simulation


def workplace(scene: Scene, mjcf: Path, task: Task, robot: str) -> Workplace:
    """The scene with the robot where it stands to do a task, at the start.

    Args:
        scene: at rest.
        mjcf: the file of the scene.
        task: that the scene allows.
        robot: name of the arm.

    Raises:
        TaskError: something is out of reach, too wide or too heavy.
    """
    placement = place(scene, robot, task.needs(scene))
    robot = placement.robot or robot
    try:
        simulation = Simulation(compose(scene, mjcf, make_robot(robot), placement), "osc", 20.0, sleep=False)
    except EnvironmentSetupError as error:
        raise TaskError(str(error)) from error
    simulation.reset()
    return Workplace(scene=scene, task=task, robot=robot, placement=placement, simulation=simulation)


def rehearse(scene: Scene, mjcf: Path, task: Task, robot: str) -> Placement:
    """Where the robot stands to do a task, all moves of which are free of obstacles; see `workplace`.

    Raises:
        TaskError: something is out of reach, too wide, too heavy, or in the way, or has no room where it should go.
    """
    return rehearsed(workplace(scene, mjcf, task, robot))


def rehearsed(work: Workplace) -> Placement:
    """The placement in a workplace, once all moves were gone through; its objects are moved by that.

    Raises:
        TaskError: something is in the way, or has no room where it should go.
    """
    if isinstance(work.task, Push):
        return _pushed(work)
    if isinstance(work.task, Carry | HandOver):
        rehearse_together(work, at_once=isinstance(work.task, Carry))
        return work.placement
    robot, simulation, planner = work.robot, work.simulation, Planner(work)
    while True:
        while (opening := work.task.opening(simulation.state, tuple(work.placement.grasps), planner.put)) is not None:
            PullPlanner(work).pull(opening)
            _move_along(simulation, opening)
            planner.put.add(opening.spec)
        if not (goals := planner.goals()):
            break
        again = [goal.name for goal in goals if goal.name in planner.put]
        if again:
            raise TaskError(f'{robot} can put "{again[0]}" where it should go, but it finds no room to stay there.')
        moves = (planner.clear(goal) for goal in goals)
        move = next((move for move in moves if move is not None), None)
        if move is None:
            raise TaskError(_refusal(planner, robot, goals[0].name))
        if move.spot is None:
            break
        _put_down(planner, simulation, move)
        planner.put.add(move.name)
    return work.placement


def _pushed(work: Workplace) -> Placement:
    """The same of a push."""
    planner = StrokePlanner(work)
    if not planner.strokes():
        why = "; ".join(planner.faults)
        raise TaskError(f'{work.robot} finds no strokes that push "{work.task.names[0]}" where it should go: {why}.')
    return work.placement


def _put_down(planner: Planner, simulation: Simulation, move: Move) -> None:
    """Set an object down where it is let go, or further down, as far as there is room."""
    state = simulation.state
    bottom = float(state.points(move.name)[:, 2].min())
    released = planner.resting(move.name, np.asarray(move.spot)) - state.centre(move.name)
    low = float(move.floor) - bottom - SINK
    heights = (*np.arange(low, released[2], FALL), released[2])
    ways = (np.array([released[0], released[1], height]) for height in heights)
    shift = next((way for way in ways if planner.clearance.fits(move.name, way)), released)
    _shift(simulation, move.name, shift)


def _shift(simulation: Simulation, moved: str, shift: Array) -> None:
    """Move an object by `shift` [m], shape (3,), with what is in it."""
    state = simulation.state
    inside = [one for one in simulation.world.objects if one != moved and state.inside(one, moved)]
    for name in (moved, *inside):
        first = int(simulation.world.positions[simulation.world.objects.index(name)])
        simulation.data.qpos[first : first + 3] += shift
    import mujoco

    mujoco.mj_forward(simulation.model, simulation.data)
    simulation.states.refresh()


def _move_along(simulation: Simulation, opening: Opening) -> None:
    """Move a drawer or a door along its way, with what is in it."""
    state, mechanism = simulation.state, opening.mechanism
    holder, at = state.rotation(mechanism.holder), state.position(mechanism.holder)
    before = holder.T @ (state.position(opening.name) - at)
    position, rotation = mechanism.moved(before, holder.T @ state.rotation(opening.name), opening.by)
    first = int(simulation.world.positions[simulation.world.objects.index(opening.name)])
    quat = Pose.from_matrix(holder @ rotation, np.zeros(3)).quat_wxyz
    simulation.data.qpos[first + 3 : first + 7] = quat
    _shift(simulation, opening.name, holder @ (position - before))


def _refusal(planner: Planner, robot: str, name: str) -> str:
    found = planner.obstacles.most_common(1)
    if not found:
        return f'{robot} finds no posture in which to take "{name}" and to put it where it should go.'
    what = "the ground" if found[0][0] == GROUND else f'"{found[0][0]}"'
    return f'{robot} finds no way to move "{name}" on which neither arm nor object is in {what}.'
