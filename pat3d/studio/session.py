"""What a studio holds: a scene, what was before, what was undone, what is selected. Every step is a new value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pat3d.errors import EditError
from pat3d.generation.editing.editable import EditableScene, load
from pat3d.geometry.pose import Pose
from pat3d.progress import Progress, silent
from pat3d.scene.folder import read_json
from pat3d.scene.model import Scene
from pat3d.studio import jobs
from pat3d.studio.worker import Run, here

MAX_WORDS = 4000
"""Longest text that is read [characters]."""

MAX_STEPS = 200
"""Steps that can be undone; older ones are forgotten."""

LEAST_MOVE, LEAST_TURN = 5e-5, 0.05
"""Of a gizmo [m], [degrees]; less is a click."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Session:
    """One state of a studio."""

    current: EditableScene
    past: tuple[EditableScene, ...] = ()
    """The latest last."""
    future: tuple[EditableScene, ...] = ()
    """What was undone, the next last."""
    selected: str | None = None
    """Name of an object of the current scene."""

    @staticmethod
    def opened(folder: str | Path) -> Session:
        """The scene in `folder`, which has to stay as it is while the session is used.

        Raises:
            SpecError: there is no scene, or it is damaged.
        """
        return Session(current=load(folder))

    @property
    def scene(self) -> Scene:
        """At rest where nothing waits to be settled, else as it is laid out."""
        return self.current.scene

    @property
    def at_rest(self) -> bool:
        """Whether no edit waits to be settled."""
        return self.current.verified is not None or not self.current.edits

    @property
    def before(self) -> Scene | None:
        """At rest as it was before the edits; None where nothing was edited."""
        return self.current.before if self.current.edits else None

    @property
    def verification(self) -> Mapping[str, Any]:
        """Plain data as in report.json, of the scene as it is; empty while edits wait, or where nobody verified it."""
        if self.current.verified is not None:
            return self.current.verified.verification.as_dict()
        if self.current.edits:
            return {}
        found = read_json(self.current.folder / "report.json").get("verification")
        return found if isinstance(found, dict) else {}

    def select(self, name: str | None) -> Session:
        """With the object `name` selected; with none where it is None.

        Raises:
            EditError: there is no such object.
        """
        if name is not None and name not in _names(self.scene):
            raise EditError(f'there is no "{name}". Objects: {", ".join(_names(self.scene))}.')
        return replace(self, selected=name)

    def edited(self, verb: str, words: str, *, progress: Progress = silent, run: Run = here) -> Session:
        """After one edit, in the words of `pat3d edit`; what is new is selected. `run` does the work.

        Raises:
            EditError: it cannot be, or its words cannot be read.
            PromptError: the words cannot be read.
            LayoutError: there is no room.
        """
        said = words.strip()
        if not said:
            raise EditError(f"say what to {verb}.")
        if len(said) > MAX_WORDS:
            raise EditError(f"the text has {len(said)} characters; at most {MAX_WORDS} are read.")
        made = run(jobs.edited, self.current, verb, said, progress=progress)
        found = self.stepped(jobs.with_assets_of(made, self.current))
        new = [name for name in _names(found.scene) if name not in _names(self.scene)]
        return replace(found, selected=new[0]) if new else found

    def removed(self) -> Session:
        """Without the selected object.

        Raises:
            EditError: nothing is selected, or it is the last object.
        """
        return self.stepped(self.current.remove(self._selected()))

    def dragged(self, pose: Pose) -> Session:
        """With the selected object moved level and turned about the vertical as far as `pose` says, and put down there.

        Its height and its tilt are found by what carries it. The session itself where that is nearly where it is.

        Raises:
            EditError: nothing is selected, or something is in the way.
        """
        name = self._selected()
        here = self.scene[name].pose
        x, y = (there - now for there, now in zip(pose.position[:2], here.position[:2], strict=True))
        turn = _yaw_between(here, pose)
        scene = self.current
        if math.hypot(x, y) >= LEAST_MOVE:
            scene = scene.move(name, _in_words(x, y))
        if abs(turn) >= LEAST_TURN:
            scene = scene.turn(name, f"{turn:.2f} degrees")
        return self if scene is self.current else self.stepped(scene)

    def settled(self, progress: Progress = silent, *, run: Run = here) -> Session:
        """At rest again and verified; a step that can be undone. `run` does the work.

        Raises:
            EditError: it does not come to rest, something topples, or a check fails; the message says why.
            SimulationError: it cannot be simulated.
        """
        made = run(jobs.settled, self.current, progress=progress)
        return self.stepped(jobs.with_assets_of(made, self.current))

    def undone(self) -> Session:
        """As before the last step.

        Raises:
            EditError: there is none.
        """
        if not self.past:
            raise EditError("there is nothing to undo.")
        *past, last = self.past
        return self._with(replace(self, current=last, past=tuple(past), future=(*self.future, self.current)))

    def redone(self) -> Session:
        """With what was undone last done again.

        Raises:
            EditError: there is nothing.
        """
        if not self.future:
            raise EditError("there is nothing to redo.")
        *future, next_one = self.future
        return self._with(replace(self, current=next_one, past=(*self.past, self.current), future=tuple(future)))

    def stepped(self, scene: EditableScene) -> Session:
        """With `scene` as the current one, a step that can be undone."""
        if scene is self.current:
            return self
        return self._with(replace(self, current=scene, past=(*self.past, self.current)[-MAX_STEPS:], future=()))

    def _selected(self) -> str:
        if self.selected is None:
            raise EditError("select an object first: click it, or choose it in the list.")
        return self.selected

    @staticmethod
    def _with(session: Session) -> Session:
        kept = session.selected if session.selected in _names(session.scene) else None
        return replace(session, selected=kept)


def _names(scene: Scene) -> list[str]:
    return [obj.name for obj in scene.objects]


def _in_words(x: float, y: float) -> str:
    """An offset [m] as `pat3d edit` takes it and history keeps it."""
    sideways, along = "left" if x < 0 else "right", "front" if y < 0 else "back"
    return f"{abs(1e3 * x):.3f} mm {sideways} and {abs(1e3 * y):.3f} mm {along}"


def _yaw_between(here: Pose, there: Pose) -> float:
    """Angle about the vertical [degrees] of the rotation from one pose to the other."""
    turned = there.rotation @ here.rotation.T
    return math.degrees(math.atan2(turned[1, 0] - turned[0, 1], turned[0, 0] + turned[1, 1]))
