"""The optimisation stage: a scene whose relations broke while settling gets a layout that keeps them.

It needs torch, which is an extra of the package: `generate` and `build` do without where it is missing, and
`pat3d optimize` says how to get it.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.check.verification import relations_at_rest
from pat3d.errors import SpecError
from pat3d.generation.settle_stage import SettledScene, settle_scene
from pat3d.layout.predicates import RelationResult
from pat3d.progress import Event, Progress, silent
from pat3d.scene.model import GROUND, Relation, Scene
from pat3d.scene.versions import versions

if TYPE_CHECKING:
    from pat3d.optimize.optimize import Optimized, OptimizeOptions

GIVEN = "given_poses"
"""Key of a scene's provenance: names of the objects whose initial poses the user chose."""

OPTIMISATION = "optimisation"
"""Key of a scene's provenance: where its initial layout came from, if it was optimised."""

PICTURES = ("loss.png", "before_after.png")

TORCH = "pip install 'pat3d[torch]'"


@dataclass(frozen=True, kw_only=True, eq=False)
class OptimizedScene:
    """A scene after its optimisation."""

    scene: Scene
    """At rest, from the layout that was found; as it was where nothing better was found."""
    settled: SettledScene | None
    """How it settled, with the record and the pictures; None where nothing better was found."""
    found: Optimized
    left_aside: tuple[Relation, ...] = ()
    """Relations that the layout never had, which the verification counts and the optimisation does not."""

    def record(self, *, kept: bool) -> dict[str, Any]:
        """Plain data for report.json; `kept` tells whether the layout that was found is the scene's now."""
        return {"kept": kept, "left_aside": [str(rel) for rel in self.left_aside], **self.found.as_dict()}


def available() -> bool:
    """Whether the optimisation can run here."""
    return find_spec("torch") is not None


def missing() -> SpecError:
    """What to raise where torch is missing."""
    return SpecError(f"the optimisation differentiates through torch, which is not installed: {TORCH}.")


def given_poses(scene: Scene) -> frozenset[str]:
    """Names of the objects of `scene` that stay where the user put them."""
    listed = scene.provenance.get(GIVEN, ())
    names = set(listed) if isinstance(listed, list | tuple) and all(isinstance(one, str) for one in listed) else set()
    return frozenset(obj.name for obj in scene.objects if obj.name in names)


def arranged(scene: Scene) -> frozenset[str]:
    """Names of the objects of `scene` whose places follow from more than relations, and of all that carries them.

    The optimisation knows relations alone: what is arranged, turned or carried by several objects starts where the
    layout put it.
    """
    names = {name for one in scene.arrangements for name in one.names} | {one.object for one in scene.postures}
    several = [obj.name for obj in scene.objects if len(scene.carriers(obj.name)) > 1]
    waiting = [*names, *several]
    while waiting:
        name = waiting.pop()
        names.add(name)
        waiting += [one for one in scene.carriers(name) if one != GROUND and one not in names]
    return frozenset(names)


def lost(scene: Scene, at_rest: tuple[RelationResult, ...]) -> tuple[Relation, ...]:
    """Lateral relations that hold in the layout of `scene` and not in the results `at_rest`."""
    missed = [
        result.relation
        for result in at_rest
        if isinstance(result.relation, Relation) and not result.relation.supports and not result.holds
    ]
    fulfilled = _fulfilled(scene) if missed else set()
    return tuple(rel for rel in missed if rel in fulfilled)


def optimize_scene(
    scene: Scene, *, options: OptimizeOptions, at_rest: bool | None = None, progress: Progress = silent
) -> OptimizedScene:
    """Optimise the initial layout of `scene` and settle from the best one.

    Lateral relations that the layout never fulfilled (one object carries the other, things lie as they fit) are left
    aside; arranged objects stay where the layout has them.

    Args:
        scene: laid out.
        options: settings.
        at_rest: whether the poses are at rest; None where they are not what the layout settles into.
        progress: told what is going on.

    Raises:
        SpecError: torch is missing.
        SimulationError: the scene's own layout cannot be simulated.
    """
    if not available():
        raise missing()
    from pat3d.optimize.optimize import optimize_scene, scene_after

    def tell(phase: str, step: int, value: float) -> None:
        if phase == "epoch":
            progress(Event(stage="following the gradient", step=step, steps=options.epochs + 1, loss=value))
        else:
            progress(Event(stage=_PHASES.get(phase, phase), step=step, motion=value))

    fulfilled = _fulfilled(scene)
    wanted = replace(scene, relations=tuple(rel for rel in scene.relations if rel.supports or rel in fulfilled))
    aside = tuple(rel for rel in scene.relations if rel not in wanted.relations)
    found = optimize_scene(
        wanted, options=options, pinned=given_poses(scene) | arranged(scene), at_rest=at_rest, progress=tell
    )
    if not found.improved:
        return OptimizedScene(scene=scene, settled=None, found=found, left_aside=aside)
    after = scene_after(scene, found.best)
    how = {"source": found.best.source, "seed": options.seed, "versions": versions()}
    after = replace(after, provenance={**after.provenance, OPTIMISATION: how})
    settled = settle_scene(after, device=options.device, progress=progress)
    after = settled.of(after)
    if _count_broken(replace(after, relations=wanted.relations)) > len(found.first.broken):
        return OptimizedScene(scene=scene, settled=None, found=found, left_aside=aside)
    progress(Event(stage="drawing the optimisation"))
    pictures = draw(found, scene_after(scene, found.first), after)
    done = OptimizedScene(scene=after, settled=settled, found=found, left_aside=aside)
    return replace(done, settled=replace(settled, optimisation=done.record(kept=True), pictures=pictures))


def _fulfilled(scene: Scene) -> set[Relation]:
    """Relations that hold in the layout of `scene`."""
    layout = replace(scene, objects=tuple(replace(obj, pose=obj.initial_pose) for obj in scene.objects))
    found = relations_at_rest(layout)
    return {result.relation for result in found if result.holds and isinstance(result.relation, Relation)}


def _count_broken(scene: Scene) -> int:
    return sum(not result.holds for result in relations_at_rest(scene))


_PHASES = {"settling": "settling the layout", "settling starts": "settling other layouts"}


def draw(found: Optimized, before: Scene, after: Scene) -> Mapping[str, bytes]:
    """The files of PICTURES: the loss curve, where gradient steps were taken, and both scenes at rest."""
    from pat3d.optimize.plot import save_before_after, save_loss_curve

    with tempfile.TemporaryDirectory(prefix="pat3d-pictures-") as scratch:
        folder = Path(scratch)
        if found.history:
            save_loss_curve(found.history, folder / "loss.png")
        save_before_after(before, after, folder / "before_after.png")
        return {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.name in PICTURES}


def in_words(record: Mapping[str, Any]) -> str:
    """What an optimisation did, from its record in report.json."""
    trials, history = record.get("trials", []), record.get("history", [])
    before = trials[0]["broken"] if trials else 0
    if not record["kept"]:
        text = f"no better layout was found ({_count(before, 'relation')} broken)"
    else:
        text = f"{_count(before, 'relation')} broken before, {len(record.get('broken', []))} after"
        text += f"; loss {record['loss_before']:.2g} -> {record['loss_after']:.2g} m^2"
    if record.get("left_aside"):
        text += f"; {_count(len(record['left_aside']), 'relation')} left aside, which the layout never had"
    text += f"; {_count(len(trials), 'layout')} settled"
    if history:
        text += f", {_count(len(history), 'gradient step')}"
    if record.get("steadiness_degrees") is not None:
        text += f"; endures a tilt of {record['steadiness_degrees']:.2g} degrees"
    return text


def readable(record: Any) -> bool:
    """Whether `record`, read from a file, is a record of an optimisation."""
    try:
        return bool(in_words(record))
    except (AttributeError, IndexError, KeyError, TypeError, ValueError):
        return False


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
