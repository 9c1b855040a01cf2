"""What every task has in common.

A task is plain data that fits any scene with the objects it names. `check` says whether a scene allows it, `needs` what
the robot has to reach, `judge` follows episodes: success is decided on the state of the simulation alone, in all
worlds at once.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pat3d.envs.grasping.placement import Needs
from pat3d.envs.physics.snapshot import Array, Mask, Numbers
from pat3d.envs.tasks.naming import called, spoken
from pat3d.errors import TaskError
from pat3d.scene.model import GROUND, Scene

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States
    from pat3d.envs.tasks.mechanisms import Mechanism


FIRST_MOVE, FURTHER_MOVE = 20.0, 15.0
"""Time for the first object that a task moves, and for each of the others [s]."""


def steps_for(moves: int, control_freq: float) -> int:
    """Control steps in which that many objects can be moved without haste, at `control_freq` actions a second."""
    return math.ceil((FIRST_MOVE + FURTHER_MOVE * max(0, moves - 1)) * control_freq)


@dataclass(frozen=True, kw_only=True)
class Goal:
    """An object that a task wants moved next, and where to."""

    name: str
    where: str | None = None
    """What to put it in or on; "" for somewhere free, None to hold it."""
    on: bool = False
    """Onto the top of `where`, though it has an inside."""
    at: tuple[float, float] | None = None
    """Put it down so that its centre is above this point [m]."""
    height: float | None = None
    """Of the surface there [m]; None for that of the work."""
    shared: bool = False
    """Others belong there too, so that its middle is left free."""


class Opening(NamedTuple):
    """A drawer or a door that a task wants moved along its way next."""

    name: str
    spec: str
    """Of the step that wants it."""
    by: float
    """In the unit of the way; below zero to shut it."""
    mechanism: Mechanism
    """How it moves."""


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """How far an episode is after one control step."""

    success: bool
    predicates: Mapping[str, bool] = field(default_factory=dict)
    """What success is made of, by name."""
    progress: float = 0.0
    """In [0, 1]; the dense reward is made of its differences."""
    target: str = ""
    """The object that the next move is about."""
    goal: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Where that object's centre should get to [m]."""


class Verdicts(NamedTuple):
    """How far the episodes of several worlds are after one control step; the first axis is the world."""

    success: Mask
    predicates: Mapping[str, Mask]
    progress: Array
    target: Numbers
    """Numbers of objects in the scene."""
    goal: Array
    """[m], shape (worlds, 3)."""

    def of(self, world: int, scene: Scene) -> Verdict:
        """That of one world of `scene`."""
        x, y, z = self.goal[world].tolist()
        return Verdict(
            success=bool(self.success[world]),
            predicates={name: bool(holds[world]) for name, holds in self.predicates.items()},
            progress=float(self.progress[world]),
            target=scene.objects[self.target[world]].name,
            goal=(x, y, z),
        )

    def unless(self, other: Verdicts, replaced: Mask) -> Verdicts:
        """These, but those of `other` where `replaced`, shape (worlds,)."""
        return Verdicts(
            success=np.where(replaced, other.success, self.success),
            predicates={
                name: np.where(replaced, other.predicates[name], self.predicates[name]) for name in self.predicates
            },
            progress=np.where(replaced, other.progress, self.progress),
            target=np.where(replaced, other.target, self.target),
            goal=np.where(replaced[:, None], other.goal, self.goal),
        )


class Judge(ABC):
    """Follows an episode in every world of `states`, which start now."""

    def __init__(self, states: States) -> None:
        self.states = states
        self.timer = np.zeros(states.count)
        """For how long what success needs has held in every world [s]."""

    def begin(self, worlds: Numbers) -> None:
        """Forget what was in `worlds`: episodes start there."""
        self.timer[worlds] = 0.0

    @abstractmethod
    def update(self, seconds: Array) -> Verdicts:
        """Judge the present state, `seconds` after the last one (0 right after the reset), shape (worlds,)."""


@dataclass(frozen=True, kw_only=True)
class Task(ABC):
    """Something to do in a scene; its fields are the names of the objects that it is about."""

    kind: ClassVar[str]
    """First word of the task's specification."""
    form: ClassVar[str]
    """How the specification is written, for messages."""
    from_the_side: ClassVar[bool] = False
    """Whether an object that cannot be taken from above may be taken by a hand that comes from the side."""

    @property
    def spec(self) -> str:
        """The text from which `parse_task` makes this task again."""
        return ":".join((self.kind, *(str(getattr(self, one.name)) for one in fields(self))))

    @property
    def names(self) -> tuple[str, ...]:
        """Objects that the specification names, what is moved first."""
        return tuple(str(getattr(self, one.name)) for one in fields(self))

    @abstractmethod
    def wordings(self, scene: Scene) -> tuple[str, ...]:
        """The task as one tells it to a person, in several ways; the first is the usual one."""

    def instruction(self, scene: Scene) -> str:
        """The first of the wordings."""
        return self.wordings(scene)[0]

    @abstractmethod
    def check(self, scene: Scene) -> None:
        """Raise TaskError where the scene lacks an object, or the task is done already."""

    @abstractmethod
    def needs(self, scene: Scene) -> Needs:
        """What the robot has to reach."""

    def targets(self, scene: Scene) -> Mapping[str, tuple[float, float]]:
        """Where objects have to get to on the table, seen from above [m], which a goal picture shows; none for most."""
        return {}

    def horizon(self, scene: Scene, control_freq: float) -> int:
        """Control steps in which the task can be done without haste, at `control_freq` actions a second."""
        return steps_for(len(self.needs(scene).grasp), control_freq)

    @abstractmethod
    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        """Objects to move next in the order of preference; none when nothing is left to do but to wait.

        Args:
            state: the present one.
            graspable: objects that the robot can take, in the order of taking them.
            done: objects that were taken and put down already, which the state alone does not tell.
        """

    def opening(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> Opening | None:
        """The drawer or door to move next, before any of the `goals`; None for most.

        Arguments as of these, and `done` holds the specifications of what was opened or shut already.
        """
        return None

    @abstractmethod
    def judge(self, states: States) -> Judge:
        """A judge of worlds whose episodes start now."""


def movable(scene: Scene, name: str) -> None:
    """Raise TaskError unless `name` is an object of the scene that can move."""
    names = [obj.name for obj in scene.objects if not obj.fixed]
    if name not in names:
        fixed = any(obj.name == name for obj in scene.objects)
        what = "is fixed" if fixed else "is not in the scene"
        raise TaskError(f'"{name}" {what}. Objects that can move: {", ".join(names) or "none"}.')


def present(scene: Scene, name: str) -> None:
    """Raise TaskError unless `name` is an object of the scene."""
    names = [obj.name for obj in scene.objects]
    if name not in names:
        raise TaskError(f'"{name}" is not in the scene. Objects: {", ".join(names)}.')


def children(scene: Scene, parent: str) -> tuple[str, ...]:
    """Objects directly on or in `parent`, in the order of the scene."""
    return tuple(obj.name for obj in scene.objects if parent in scene.carriers(obj.name))


def standing_on(scene: Scene, parent: str) -> tuple[str, ...]:
    """Objects directly on `parent`, not in it, in the order of the scene."""
    on = {rel.child for rel in scene.relations if rel.kind == "on" and rel.parent == parent}
    return tuple(obj.name for obj in scene.objects if obj.name in on)


def rests_upon(scene: Scene, name: str, other: str) -> bool:
    """Whether an object is carried by another, directly or through others."""
    below = [name]
    while below:
        carriers = [one for one in scene.carriers(below.pop()) if one != GROUND]
        if other in carriers:
            return True
        below += carriers
    return False


def origin(scene: Scene, name: str) -> str:
    """Where an object stands, as " from the tray"; nothing for one on the ground, or where its name tells already."""
    parent = scene.parent(name)
    words = None if parent == GROUND else called(scene, parent)
    return "" if words is None or words in spoken(scene, name) else f" from the {words}"


def centre_of_mass(scene: Scene, name: str) -> Array:
    """Of an object at rest [m], shape (3,)."""
    obj = scene[name]
    return obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0]


def point(values: ArrayLike) -> tuple[float, float, float]:
    """Three numbers as plain data."""
    x, y, z = np.asarray(values, dtype=np.float64)
    return float(x), float(y), float(z)


def split(spec: str) -> tuple[str, list[str]]:
    """The kind and the arguments of a specification: "place:red mug:tray" -> "place", ["red mug", "tray"]."""
    kind, *arguments = [part.strip() for part in spec.split(":")]
    return kind, arguments


Parser = Callable[[list[str]], Task]
