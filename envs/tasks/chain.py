"""Several things to do one after the other, with memory of what was done."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from pat3d.envs.grasping.placement import Needs
from pat3d.envs.physics.snapshot import Array, Numbers
from pat3d.envs.tasks.beside import Beside
from pat3d.envs.tasks.beside_moved import BesideMoved, in_place
from pat3d.envs.tasks.manipulate import Lift, Pick, Place, Stack
from pat3d.envs.tasks.opening import Close, Open
from pat3d.envs.tasks.paraphrase import in_turn
from pat3d.envs.tasks.task import Goal, Judge, Opening, Task, Verdicts, rests_upon, steps_for
from pat3d.errors import TaskError
from pat3d.scene.model import Scene
from pat3d.scene.task_spec import AND_THEN, CHAIN, STEPS

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States


@dataclass(frozen=True, kw_only=True)
class Chain(Task):
    """Put, stack, or lift and put back one object after the other, in this order; the last step may pick one up.

    Between them drawers and doors may be opened and shut, one of them both.
    """

    kind: ClassVar[str] = CHAIN
    form: ClassVar[str] = "chain:STEP:then:STEP..., as in chain:place:OBJECT:WHERE:then:pick:OBJECT"

    steps: tuple[Task, ...]

    def __post_init__(self) -> None:
        fewest, most = STEPS
        if not fewest <= len(self.steps) <= most:
            raise TaskError(f"a chain has {fewest} to {most} steps, not {len(self.steps)}.")
        for number, step in enumerate(self.steps):
            last = number == len(self.steps) - 1
            if not isinstance(step, Place | Stack | Beside | Lift | Open | Close) and not (
                last and isinstance(step, Pick)
            ):
                raise TaskError(
                    f'"{step.spec}" cannot be step {number + 1}: steps put, stack, lift, open or close, the last may '
                    "pick."
                )
        moved = [step.names[0] for step in self.steps if not isinstance(step, Open | Close)]
        slid = [step.spec for step in self.steps if isinstance(step, Open | Close)]
        if len({*moved, *slid}) < len(self.steps):
            raise TaskError("every step of a chain moves another object.")

    @property
    def spec(self) -> str:
        return f"{self.kind}:{AND_THEN.join(step.spec for step in self.steps)}"

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(name for step in self.steps for name in step.names))

    @property
    def turns(self) -> tuple[Task, ...]:
        """The steps, each knowing what those before it move as far as that matters to it."""
        return in_place(self.steps)

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        said = [step.instruction(scene) for step in self.steps]
        together = [_at_once(scene, group) for group in _grouped(self.steps)]
        # What goes to one place may be told in one breath.
        return in_turn(said) if len(together) == len(said) else (*in_turn(said), *in_turn(together))

    def check(self, scene: Scene) -> None:
        turns = self.turns
        for number, step in enumerate(turns):
            # What an earlier step opens is shut at the start.
            if not any(isinstance(one, Open | Close) and one.names == step.names for one in turns[:number]):
                step.check(scene)
        # What is beside something that is then taken away, with what it stands on or alone, is beside it no longer.
        for step in turns:
            if isinstance(step, Beside):
                since = turns.index(step.mover) + 1 if isinstance(step, BesideMoved) else 0
                away = [one.names[0] for one in turns[since:] if not isinstance(one, Lift)]
                _stays(step.tree(scene), step, away)

    def needs(self, scene: Scene) -> Needs:
        needs = [step.needs(scene) for step in self.turns]
        side = next((one.side for one in needs if one.side is not None), None)
        visits = [(point, side if front is None else front) for one in needs for point, front in one.visits]
        visits = list(dict.fromkeys(visits))
        return Needs(
            grasp=tuple(dict.fromkeys(name for one in needs for name in one.grasp)),
            visit=tuple(point for point, _ in visits),
            fronts=tuple(front for _, front in visits if front is not None),
            room=tuple(dict.fromkeys(point for one in needs for point in one.room)),
            swept=tuple(dict.fromkeys(point for one in needs for point in one.swept)),
            cleared=True,
            push=tuple(dict.fromkeys(name for one in needs for name in one.push)),
            side=side,
        )

    def horizon(self, scene: Scene, control_freq: float) -> int:
        return steps_for(len(self.steps), control_freq)

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        return next((goals for step in self.turns if (goals := step.goals(state, graspable, done))), [])

    def opening(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> Opening | None:
        for step in self.turns:
            if (opening := step.opening(state, graspable, done)) is not None:
                return opening
            if step.goals(state, graspable, done):
                return None
        return None

    def judge(self, states: States) -> Judge:
        return ChainJudge(states, self.turns)


def _stays(scene: Scene, step: Beside, away: list[str]) -> None:
    """Raise TaskError where steps that move `away` take what something is put beside from where it stands."""
    for name in away:
        if name == step.landmark or (name != step.target and rests_upon(scene, step.landmark, name)):
            raise TaskError(f'"{step.spec}" cannot be a step of this chain: another step moves "{name}".')


def _grouped(steps: tuple[Task, ...]) -> list[list[Task]]:
    """Steps, those that follow one another and put something into or onto the same thing in one group."""
    groups: list[list[Task]] = []
    for step in steps:
        last = groups[-1][-1] if groups else None
        if isinstance(step, Place) and isinstance(last, Place) and step.where == last.where:
            groups[-1].append(step)
        else:
            groups.append([step])
    return groups


def _at_once(scene: Scene, group: list[Task]) -> str:
    """The instruction for a group: "put the can and the box in the basket"."""
    first = group[0]
    if len(group) == 1 or not isinstance(first, Place):
        return first.instruction(scene)
    return first.told(scene, [step.names[0] for step in group])[0]


class ChainJudge(Judge):
    """Success when every step was done in its turn, and what the earlier ones put somewhere is there at the end.

    Progress is the share of steps done, and of the next one its own progress.
    """

    def __init__(self, states: States, steps: tuple[Task, ...]) -> None:
        super().__init__(states)
        self._judges = [step.judge(states) for step in steps]
        self._titles = [f"step {number + 1}: {step.spec}" for number, step in enumerate(steps)]
        self._stage = np.zeros(states.count, dtype=np.int64)
        self._undone = {
            number
            for number, step in enumerate(steps)
            if any(isinstance(one, Open | Close) and one.names == step.names for one in steps[number + 1 :])
        }
        """Steps that a later one undoes: what is opened and then shut."""

    def begin(self, worlds: Numbers) -> None:
        super().begin(worlds)
        self._stage[worlds] = 0
        for judge in self._judges:
            judge.begin(worlds)

    def update(self, seconds: Array) -> Verdicts:
        stage, last = self._stage.copy(), len(self._judges) - 1
        # Time passes for the step that is due alone: nothing is done ahead of its turn.
        found = [judge.update(seconds * (stage == number)) for number, judge in enumerate(self._judges)]
        success = np.zeros(self.states.count, dtype=np.bool_)
        kept, done = np.ones_like(success), np.zeros(self.states.count)
        target, goal = found[0].target.copy(), found[0].goal.copy()
        for number, one in enumerate(found):
            due, passed = stage == number, stage > number
            target, goal = np.where(due, one.target, target), np.where(due[:, None], one.goal, goal)
            if number < last:
                # Whether it is in, on or beside its place, whatever has become of the hand since.
                there = next(iter(one.predicates.values())) & one.predicates.get("landmark stays", True)
                there = there | (passed if number in self._undone else False)
                kept &= there | ~passed
                done += passed & there
                self._pass(np.flatnonzero(due & one.success), number + 1)
            else:
                success = due & one.success & kept
            done += np.where(due, one.progress, 0.0)
        passed = {title: self._stage > number for number, title in enumerate(self._titles[:-1])}
        return Verdicts(
            success=success,
            predicates={**passed, self._titles[-1]: success, "kept": kept},
            progress=done / len(found),
            target=target,
            goal=goal,
        )

    def _pass(self, worlds: Numbers, stage: int) -> None:
        """Go on to the next step in `worlds`."""
        self._stage[worlds] = stage
        self._judges[stage].begin(worlds)
