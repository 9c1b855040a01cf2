"""A scene that is edited, one value after another: `pat3d.load("scenes/desk").remove("bottom book").settle()`."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pat3d.check.verification import Verification, verify
from pat3d.errors import EditError, LayoutError
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.generation.editing import adding, steps
from pat3d.generation.editing.draft import Draft
from pat3d.generation.editing.resettling import Changes, settled
from pat3d.generation.editing.selecting import chosen
from pat3d.generation.editing.words import angle_of, factor_of, offset_of
from pat3d.generation.rewrite import Rewritten, read_folder, rewrite
from pat3d.generation.settle_stage import SettledScene
from pat3d.plan.scene_plan import Planner
from pat3d.progress import Clock, Progress, silent
from pat3d.scene.arrangements import POSTURES
from pat3d.scene.folder import check_target
from pat3d.scene.history import Edit, EditVerb
from pat3d.scene.model import Scene
from pat3d.sim.compilation import prepare

_POSTURE_WORDS = {"upright": "upright", "upside down": "upside_down", "on its side": "on_its_side"}


@dataclass(frozen=True, kw_only=True, eq=False)
class Verified:
    """A scene that came to rest after edits and passed every check."""

    settled: SettledScene
    verification: Verification
    changes: Changes
    clock: Clock
    """Wall time of the stages."""


@dataclass(frozen=True, kw_only=True, eq=False)
class EditableScene:
    """A scene and the edits that are waiting to be settled; every method returns another one and changes nothing.

    Objects are named by name, by place ("the bottom book") or by relation ("the mug on the books").
    """

    folder: Path
    """The scene folder that it came from."""
    before: Scene
    """At rest: where the edits begin."""
    draft: Draft
    edits: tuple[Edit, ...] = ()
    """Since `before`."""
    verified: Verified | None = None
    """Of the scene as it is, where it was settled since the last edit."""
    planner: Planner | None = None
    """Reads words; the offline grammar where None."""

    @property
    def scene(self) -> Scene:
        """The scene: at rest where nothing waits to be settled, else as it is laid out."""
        return replace(self.draft.scene, history=(*self.before.history, *self.edits))

    @property
    def changes(self) -> Changes | None:
        """What the edits changed; None where they are not settled."""
        return None if self.verified is None else self.verified.changes

    def remove(self, what: str) -> EditableScene:
        """Take objects away; what they carried comes down.

        Args:
            what: one or several: "the bottom book", "all apples".

        Raises:
            EditError: no such object, or it is the last.
        """
        names = self._chosen(what, several=True)
        return self._edited("remove", what, names, lambda draft: steps.remove(draft, names))

    def add(self, what: str) -> EditableScene:
        """Add objects: "a coffee mug on the stack of books"; what is named with "the" is there already.

        Raises:
            PromptError: the words cannot be read, or name what cannot be made.
            EditError: they name nothing new, or with "the" what is not there.
            LayoutError: there is no room.
        """
        draft, names = adding.add(self.draft, what, self._planner)
        return self._edited("add", what, names, lambda _: draft)

    def move(self, what: str, where: str) -> EditableScene:
        """Move an object with what it carries: "10 cm to the right", "onto the books", "next to the vase".

        Raises:
            EditError: no such object or place, or something is in the way.
            LayoutError: there is no room.
        """
        (name,) = self._chosen(what)
        offset = offset_of(where)

        def moved(draft: Draft) -> Draft:
            if offset is not None:
                return steps.move(draft, name, *offset)
            return adding.moved_to(draft, name, where, self._planner)

        return self._edited("move", f"{what}: {where}", (name,), moved)

    def turn(self, what: str, how: str | float) -> EditableScene:
        """Turn an object about the vertical, "90 degrees", or lay it "on its side", "upside down" or "upright".

        Args:
            what: one object.
            how: words, or an angle [degrees], counter-clockwise as seen from above.

        Raises:
            EditError: no such object, no angle, or something is in the way.
        """
        (name,) = self._chosen(what)
        kind = _POSTURE_WORDS.get(str(how).strip().lower().replace("_", " "))
        if kind is not None and kind in POSTURES:
            change: Callable[[Draft], Draft] = lambda draft: steps.posture(draft, name, kind)  # type: ignore[arg-type]  # noqa: E731
        else:
            angle = angle_of(str(how))
            change = lambda draft: steps.turn(draft, name, angle)  # noqa: E731
        return self._edited("turn", f"{what}: {how}", (name,), change)

    def replace(self, what: str, by: str) -> EditableScene:
        """Put another object in the place of one.

        Args:
            what: "the vase".
            by: "a plant pot".

        Raises:
            PromptError: `by` cannot be read, or names what cannot be made.
            EditError: no such object, or there is no room.
            LayoutError: there is no room for what it carried.
        """
        (name,) = self._chosen(what)
        draft, _ = adding.replaced(self.draft, name, by, self._planner)
        return self._edited("replace", f"{what}: {by}", (name,), lambda _: draft)

    def scale(self, what: str, size: str | float) -> EditableScene:
        """Make an object larger or smaller: 1.2, "20 % larger", "12 cm" for its longest side.

        Raises:
            EditError: no such object or size, or there is no room.
            LayoutError: there is no room for what it carries.
        """
        (name,) = self._chosen(what)
        factor = factor_of(str(size), float(self.scene[name].asset.size.max()))
        return self._edited("scale", f"{what}: {size}", (name,), lambda draft: steps.resized(draft, name, factor))

    def set(self, what: str, /, **values: Any) -> EditableScene:
        """Give objects another mass [kg], density [kg/m^3], friction [-] or material.

        What is given beside a material holds instead of the material's own, in whichever order.

        Args:
            what: "the mug".
            values: mass=0.3, material="wood".

        Raises:
            EditError: no such object, quantity or value; or both a mass and a density.
            AssetError: no such material.
        """
        names = self._chosen(what, several=True)
        if {"mass", "density"} <= set(values):
            raise EditError(f'"{what}": give its mass or its density, not both.')

        def changed(draft: Draft) -> Draft:
            for name in names:
                for key, value in sorted(values.items(), key=lambda one: one[0] != "material"):
                    draft = steps.set_value(draft, name, key, str(value))
            return draft

        said = ", ".join(f"{key}={value}" for key, value in values.items())
        if not said:
            raise EditError(f'"{what}": say what to set, as in mass=0.3.')
        return self._edited("set", f"{what}: {said}", names, changed)

    def fix(self, what: str) -> EditableScene:
        """Hold objects where they are, in the simulator and in every export.

        Raises:
            EditError: no such object.
        """
        names = self._chosen(what, several=True)
        return self._edited("fix", what, names, lambda draft: _each(draft, names, True))

    def free(self, what: str) -> EditableScene:
        """Let go of objects that are fixed.

        Raises:
            EditError: no such object.
        """
        names = self._chosen(what, several=True)
        return self._edited("free", what, names, lambda draft: _each(draft, names, False))

    def settle(self, *, device: str = "cpu", progress: Progress = silent) -> EditableScene:
        """Bring the edited scene to rest from where it is, and verify it.

        Raises:
            EditError: it does not come to rest, something topples, or a check fails; the message says why.
            SimulationError: it cannot be simulated.
        """
        if self.verified is not None:
            return self
        if not self.edits:
            raise EditError("nothing was edited; there is nothing to settle. Nothing was written.")
        clock = Clock()
        with clock("kernels"):
            name = prepare(device, progress)
        with clock("settling"):
            rest, scene, changes = settled(self.draft, self.before, device=name, progress=progress)
        with tempfile.TemporaryDirectory(prefix="pat3d-edit-") as scratch, clock("verification"):
            verification = verify(scene, write_mjcf(scene, Path(scratch) / "mjcf"), progress)
        if verification.failures:
            first, *others = verification.failures
            more = f" (and {len(others)} more)" if others else ""
            raise EditError(f"the edited scene fails its verification: {first}{more} Nothing was written.")
        verified = Verified(settled=rest, verification=verification, changes=changes, clock=clock)
        return replace(self, draft=Draft(scene=scene), verified=verified)

    def save(self, out: str | os.PathLike[str] | None = None, *, progress: Progress = silent) -> Rewritten:
        """Write the scene folder, with the formats of the one it came from; what waits is settled first.

        Args:
            out: folder to write; the one that it came from where None.
            progress: told what is going on.

        Raises:
            EditError: as of `settle`.
            ExportError: the folder cannot be written.
        """
        target = check_target(out if out is not None else self.folder)
        verified = self.verified
        if verified is None:
            return self.settle(progress=progress).save(target, progress=progress)
        return rewrite(
            self.scene,
            verified.settled,
            source=self.folder,
            target=target,
            clock=verified.clock,
            progress=progress,
            verification=verified.verification,
            more={"edits": {"list": [str(edit) for edit in self.edits], **verified.changes.as_dict()}},
        )

    @property
    def _planner(self) -> Planner:
        if self.planner is not None:
            return self.planner
        from pat3d.plan.grammar.planner import GrammarPlanner

        return GrammarPlanner()

    def _chosen(self, what: str, *, several: bool = False) -> tuple[str, ...]:
        return chosen(self.draft.scene, what, self._planner, several=several)

    def _edited(
        self, verb: EditVerb, said: str, names: tuple[str, ...], change: Callable[[Draft], Draft]
    ) -> EditableScene:
        made = Edit(verb=verb, said=said, objects=names)
        start = self
        if self.verified is not None:
            # What was settled is the scene that further edits begin with.
            start = replace(self, before=self.scene, draft=Draft(scene=self.scene), edits=(), verified=None)
        try:
            draft = change(start.draft)
        except LayoutError as error:
            raise LayoutError(f"{made}: {error}") from error
        return replace(start, draft=draft, edits=(*start.edits, made))


def _each(draft: Draft, names: tuple[str, ...], fixed: bool) -> Draft:
    for name in names:
        draft = steps.set_fixed(draft, name, fixed)
    return draft


def load(folder: str | os.PathLike[str], *, planner: Planner | None = None) -> EditableScene:
    """The scene in `folder`, to be edited.

    Args:
        folder: a scene folder.
        planner: reads the words of edits; the offline grammar where None.

    Raises:
        SpecError: there is no scene, or it is damaged.
    """
    source = Path(folder).expanduser()
    scene = read_folder(source, silent)
    return EditableScene(folder=source, before=scene, draft=Draft(scene=scene), planner=planner)
