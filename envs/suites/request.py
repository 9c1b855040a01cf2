"""What a suite is made from: its request, and what of it falls on every place in the suite.

A place is decided by the request's seed and its number alone, never by how many scenes there are or who makes them: a
suite can be made longer, and comes out the same with any number of workers.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pat3d.envs.physics.variation import LARGEST
from pat3d.envs.robots.arms import default_robot
from pat3d.envs.robots.pairs import pair_of
from pat3d.envs.suites.sight import LEAST
from pat3d.envs.surroundings.room import BENCH, KINDS, drawn
from pat3d.errors import SpecError, SuiteError
from pat3d.generation.request import derived_seed
from pat3d.scene.model import check_least_tilt
from pat3d.scene.physics import LEAST_TILT

TASKS = (
    "pick",
    "place",
    "stack",
    "sort",
    "unload",
    "retrieve",
    "chain",
    "rearrange",
    "push",
    "beside",
    "open",
    "close",
)
TWO_ARMED = ("carry", "handover")
"""What takes two arms."""

SPLITS = ("train", "val", "test", "val/layout", "val/object", "test/layout", "test/object")
"""What may be asked for; a scene belongs to "train" or to one of those with a slash."""

_CYCLE = 20
_HELD_OUT = {3: "test/object", 8: "val/layout", 13: "test/layout", 18: "val/object"}
"""In every 20 scenes of a task: one for each of the held-out splits, the others for training."""

_STAGGER = 4
"""Places by which the tasks' cycles are shifted, so that small suites have some of every split."""

DEVICES = ("cpu", "cuda")
"""Where scenes may be settled."""

MIN_OBJECTS, MAX_OBJECTS = 4, 16
MOST_ALIKE, MOST_CLUTTER, MOST_STEPS = 3, 10, 5
MOST_VISIBLE = 5.0
"""[%]"""
MAX_SCENES = 1_000_000
MAX_SEED = 2**32 - 1


@dataclass(frozen=True, kw_only=True)
class Request:
    """Everything that decides a suite's content."""

    tasks: tuple[str, ...] = TASKS[:5]
    scenes: int = 100
    seed: int = 0
    objects: tuple[int, int] = (5, 8)
    """Fewest and most objects of a scene; containers count."""
    robot: str = ""
    """That has to be able to reach and take what a task needs; "" for the default one, see
    `pat3d.envs.robots.arms.default_robot`."""
    least_tilt: float = LEAST_TILT
    """Tilt of the ground [degrees], whichever way, that every scene has to stand."""
    stable: bool = False
    """Without scenes in which something rests on its round side, from where it may roll."""
    steps: tuple[int, ...] = ()
    """Numbers of steps that chains have; empty for any from two to five."""
    clutter: tuple[int, ...] = ()
    """Numbers of objects beside those of the task: every scene has one of them, drawn evenly, and more only where its
    structure does. Empty for as many as `objects` leaves."""
    alike: int = 0
    """Among them, distractors by likeness: of the noun of something that is moved in another colour or size, or of its
    kind where it has the colour that it has."""
    visible: float = LEAST
    """Share of the agent's picture at the start [%] that every object of the task covers at least; what hides behind
    others or the robot does not. 0 for suites in which nobody looked."""
    vary: float = 0.0
    """By how much every reset moves the objects along x and y [m], see `pat3d.envs.physics.variation`."""
    rooms: tuple[str, ...] = ()
    """Kinds of rooms, one of which every scene is in, with a look of its own; empty for a bare bench."""
    picture: int = 320
    """Width of the scenes' pictures [pixel]; 0 for none."""
    device: str = "cpu"
    """Where scenes are settled, one of `DEVICES`. On a GPU they settle side by side, and poses agree with those of
    a CPU to about 1e-9 m, not bit for bit."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "robot", self.robot or default_robot())
        unknown = [name for name in self.tasks if name not in (*TASKS, *TWO_ARMED)]
        if unknown or not self.tasks or len(set(self.tasks)) != len(self.tasks):
            what = f'no task "{unknown[0]}"' if unknown else "name each task once, and at least one"
            raise SuiteError(f"{what}. Tasks: {', '.join((*TASKS, *TWO_ARMED))}.")
        together = [name for name in self.tasks if name in TWO_ARMED]
        if together and pair_of(self.robot) is None:
            raise SuiteError(f'"{together[0]}" takes two arms, and {self.robot} is one; as --robot panda+panda.')
        if not 1 <= self.scenes <= MAX_SCENES:
            raise SuiteError(f"a suite has 1 to {MAX_SCENES} scenes, not {self.scenes}.")
        if not 0 <= self.seed <= MAX_SEED:
            raise SuiteError(f"the seed must be a whole number from 0 to {MAX_SEED}, got {self.seed}.")
        fewest, most = self.objects
        if not MIN_OBJECTS <= fewest <= most <= MAX_OBJECTS or most < MIN_OBJECTS + 2:
            raise SuiteError(
                f"scenes have from {MIN_OBJECTS} to {MAX_OBJECTS} objects, and the larger number is at least "
                f"{MIN_OBJECTS + 2}; got {fewest}-{most}."
            )
        if any(not 2 <= one <= MOST_STEPS for one in self.steps) or len(set(self.steps)) != len(self.steps):
            raise SuiteError(f"chains have 2 to {MOST_STEPS} steps, each number once; got {list(self.steps)}.")
        if any(not 0 <= one <= MOST_CLUTTER for one in self.clutter) or len(set(self.clutter)) != len(self.clutter):
            raise SuiteError(f"clutter is 0 to {MOST_CLUTTER} objects, each number once; got {list(self.clutter)}.")
        most_alike = min(MOST_ALIKE, min(self.clutter) if self.clutter else most - MIN_OBJECTS - 2)
        if not 0 <= self.alike <= most_alike:
            raise SuiteError(f"among so few objects 0 to {most_alike} may be alike, not {self.alike}.")
        if not 0.0 <= self.visible <= MOST_VISIBLE:
            raise SuiteError(f"what is visible covers 0 to {MOST_VISIBLE:g} % of the picture, not {self.visible:g}.")
        if not 0.0 <= self.vary <= LARGEST:
            raise SuiteError(f"a reset moves objects by 0 to {LARGEST:g} m, not {self.vary:g}.")
        unknown = [kind for kind in self.rooms if kind not in (BENCH, *KINDS)]
        if unknown or len(set(self.rooms)) != len(self.rooms):
            what = f'no room "{unknown[0]}"' if unknown else "name each room once"
            raise SuiteError(f"{what}. Rooms: {', '.join((BENCH, *KINDS))}; all for all but the first.")
        if self.device not in DEVICES:
            raise SuiteError(f'no device "{self.device}". Devices: {", ".join(DEVICES)}.')
        try:
            check_least_tilt(self.least_tilt)
        except SpecError as error:
            raise SuiteError(str(error)) from error
        if self.picture and not 64 <= self.picture <= 2048:
            raise SuiteError(f"pictures are 64 to 2048 pixels wide, or 0 for none; got {self.picture}.")

    def as_dict(self) -> dict[str, Any]:
        """JSON data."""
        return {
            "tasks": list(self.tasks),
            "scenes": self.scenes,
            "seed": self.seed,
            "objects": list(self.objects),
            "robot": self.robot,
            "picture": self.picture,
            "device": self.device,
            # Suites that ask for no more than all scenes do are named by the same request as ever.
            **({"least_tilt": self.least_tilt} if self.least_tilt != LEAST_TILT else {}),
            **({"stable": True} if self.stable else {}),
            **({"clutter": list(self.clutter)} if self.clutter else {}),
            **({"steps": list(self.steps)} if self.steps else {}),
            **({"rooms": list(self.rooms)} if self.rooms else {}),
            **{name: value for name in ("alike", "visible", "vary") if (value := getattr(self, name))},
        }

    @staticmethod
    def from_dict(data: Any, where: str) -> Request:
        """The request that `as_dict` wrote.

        Raises:
            SuiteError: `data` is something else; the message names `where`.
        """
        good = (
            isinstance(data, Mapping)
            and _strings(data.get("tasks"))
            and all(_whole(data.get(name)) for name in ("scenes", "seed", "picture"))
            and isinstance(data.get("objects"), list)
            and len(data["objects"]) == 2
            and all(map(_whole, data["objects"]))
            and isinstance(data.get("robot"), str)
            and isinstance(data.get("device", "cpu"), str)
            and isinstance(data.get("least_tilt", LEAST_TILT), int | float)
            and isinstance(data.get("stable", False), bool)
            and all(isinstance(data.get(name, []), list) for name in ("clutter", "steps"))
            and _strings(data.get("rooms", []))
            and all(map(_whole, [*data.get("clutter", []), *data.get("steps", []), data.get("alike", 0)]))
            and all(isinstance(data.get(name, 0.0), int | float) for name in ("visible", "vary"))
        )
        if not good:
            raise SuiteError(f"{where}: the suite's request is damaged: {json.dumps(data)[:200]}")
        return Request(
            tasks=tuple(data["tasks"]),
            scenes=data["scenes"],
            seed=data["seed"],
            objects=(data["objects"][0], data["objects"][1]),
            robot=data["robot"],
            picture=data["picture"],
            device=data.get("device", "cpu"),
            least_tilt=float(data.get("least_tilt", LEAST_TILT)),
            stable=data.get("stable", False),
            steps=tuple(data.get("steps", ())),
            clutter=tuple(data.get("clutter", ())),
            rooms=tuple(data.get("rooms", ())),
            alike=data.get("alike", 0),
            visible=float(data.get("visible", 0.0)),
            vary=float(data.get("vary", 0.0)),
        )

    def task_of(self, place: int) -> str:
        """The kind of task at a place of the suite, from 0."""
        return self.tasks[place % len(self.tasks)]

    def clutter_of(self, place: int) -> int | None:
        """Objects beside those of the task at a place of the suite; None for as many as `objects` leaves."""
        return self.clutter[derived_seed(self.seed, "clutter", place) % len(self.clutter)] if self.clutter else None

    def room_of(self, place: int) -> str:
        """The room that a place of the suite is in."""
        return str(drawn(self.rooms, derived_seed(self.seed, "room", place))) if self.rooms else BENCH

    def split_of(self, place: int) -> str:
        """The split of a place of the suite, from 0."""
        turn, number = divmod(place, len(self.tasks))
        return _HELD_OUT.get((turn + _STAGGER * number) % _CYCLE, "train")


def check_split(split: str | None) -> None:
    """Raise SuiteError unless `split` is None or the name of one."""
    if split is not None and split not in SPLITS:
        raise SuiteError(f'no split "{split}". Splits: {", ".join(SPLITS)}.')


def in_split(own: str, asked: str | None) -> bool:
    """Whether a scene of split `own` belongs to the split `asked` for; None asks for all."""
    return asked is None or own == asked or own.startswith(f"{asked}/")


def _whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _strings(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str) and all(isinstance(one, str) for one in value)
