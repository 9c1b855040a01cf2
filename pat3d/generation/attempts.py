"""Attempts at a scene, each laid out with its own seed, settled and verified; the best is optimised if it fails.

Another layout costs one settling and mends what chance broke. An optimisation costs ten or more and mends what every
layout has in common (weight that is not over its support), so it comes last.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from pat3d.check.verification import Verification, broken, relations_at_rest, verify
from pat3d.errors import CheckError, LayoutError, Pat3dError, SimulationError
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.generation.checkpoints import Workspace
from pat3d.generation.not_yet import beside_steps, with_task_to_do
from pat3d.generation.optimize_stage import OPTIMISATION, available, lost, optimize_scene
from pat3d.generation.request import SceneRequest, UnplacedObject, derived_seed
from pat3d.generation.settle_stage import SettledScene, settle_scene
from pat3d.geometry.pose import Pose
from pat3d.progress import Clock, Event, Progress
from pat3d.scene.arrangements import Arrangement
from pat3d.scene.folder import key_of
from pat3d.scene.model import GROUND, Relation, Scene, SceneObject, parent_of
from pat3d.scene.physics import LEAST_TILT
from pat3d.scene.versions import versions
from pat3d.sim.compilation import prepare

CLEARANCE = 1e-5
"""Gap between a fixed object and the ground [m]."""
FURTHER = 3
"""Attempts more where all that is wrong with one is that something creeps: pens that lean in a cup."""
CREEPING = 2.0
"""How far that may be [mm, degrees]; 1.0 passes."""
STARTS, EPOCHS = 4, 20
"""Layouts and gradient steps of an optimisation at most; `pat3d optimize` takes more."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Checked:
    """A settled scene, exported and checked; it may have failed."""

    scene: Scene
    settled: SettledScene
    verification: Verification
    mjcf: Path
    """Folder of the export that was checked."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Attempt:
    """What came of one layout seed."""

    number: int
    """From 0."""
    layout_seed: int
    scene: Scene | None = None
    """None where no layout was found or it could not be simulated."""
    settled: SettledScene | None = None
    notes: tuple[str, ...] = ()
    """The layout's."""
    inputs: Mapping[str, str] = field(default_factory=dict)
    """Fingerprints of the stages' inputs."""
    broken: tuple[str, ...] = ()
    """Support relations that do not hold at rest."""
    checked: Checked | None = None
    """None where an earlier fault made the checks pointless."""
    error: Pat3dError | None = None

    @property
    def failures(self) -> tuple[str, ...]:
        """What is wrong with it, a line each."""
        if self.error is not None:
            return (str(self.error),)
        lines = self.checked.verification.failures if self.checked is not None else self.broken
        if self.settled is not None and not self.settled.at_rest:
            frames, steps = self.settled.record["frames"], self.settled.record["polish_steps"]
            still = f"settling did not come to rest in {frames} frames and {steps} steps of polish (unbalanced by "
            lines = (still + f"{self.settled.record['residual']:.2g} of a weight).", *lines)
        return lines

    @property
    def lost(self) -> tuple[Relation, ...]:
        """Lateral relations that hold in the layout and not at rest; an optimisation may bring them back."""
        if self.scene is None or self.settled is None:
            return ()
        return lost(self.scene, self.checked.verification.relations if self.checked else relations_at_rest(self.scene))

    @property
    def passed(self) -> bool:
        """Checked, with nothing wrong."""
        return self.checked is not None and not self.failures

    @property
    def creeps(self) -> bool:
        """Checked, with nothing wrong but that objects drift in MuJoCo by a little more than they may."""
        if self.checked is None:
            return False
        mujoco = self.checked.verification.mujoco
        moved, far = mujoco.moved(), mujoco.moved(mm=CREEPING, degrees=CREEPING)
        return not far and 0 < len(moved) == len(self.failures)

    @property
    def rank(self) -> tuple[bool, bool, int, int]:
        """The least is the best attempt."""
        restless = self.settled is None or not self.settled.at_rest
        return self.error is not None, restless, len(self.failures), len(self.lost)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        settling = dict(self.settled.record) if self.settled is not None else None
        return {
            "attempt": self.number + 1,
            "layout_seed": self.layout_seed,
            "passed": self.passed,
            "checked": self.checked is not None,
            "failures": list(self.failures),
            "settling": settling,
            "optimised": self.settled is not None and self.settled.optimisation is not None,
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class ChosenAttempt:
    """The attempt that becomes the scene folder."""

    best: Attempt
    checked: Checked
    tried: tuple[Attempt, ...]
    """All attempts, the best among them."""
    key: str
    """Fingerprint of the request and the settings."""


def request_key(request: SceneRequest, *, seed: int, friction: float, device: str, least_tilt: float) -> str:
    """Fingerprint of everything that decides what comes of a request."""
    return key_of(versions(), request.fingerprint, seed, friction, device, least_tilt)


class Attempts:
    """Makes attempts at one request: layouts with different seeds, each settled and verified."""

    def __init__(
        self,
        request: SceneRequest,
        *,
        seed: int,
        friction: float,
        device: str,
        least_tilt: float = LEAST_TILT,
        workspace: Workspace,
        clock: Clock,
        progress: Progress,
        scratch: Path,
    ) -> None:
        self.request, self.seed, self.friction, self.device = request, seed, friction, device
        self.least_tilt = least_tilt
        self.workspace, self.clock, self.progress, self.scratch = workspace, clock, progress, scratch
        self._objects: tuple[UnplacedObject, ...] = ()
        self._objects_made = False
        self.key = request_key(request, seed=seed, friction=friction, device=device, least_tilt=least_tilt)

    def best_of(self, count: int) -> ChosenAttempt:
        """The first attempt that passes, else the best of `count` with its faults.

        Raises:
            LayoutError: no attempt found a layout.
            SimulationError: no attempt could be simulated.
        """
        tried: list[Attempt] = []
        known = self.workspace.chosen(self.key)
        count = count if self.request.adjustable else 1
        for number in range(count + FURTHER * (count > 1)) if known is None else (known,):
            if number >= count and known is None and not any(attempt.creeps for attempt in tried):
                break
            attempt = self._attempt(number)
            if not attempt.failures:
                attempt = self._checked(attempt)
            tried.append(attempt)
            if attempt.passed:
                break
        best = min(tried, key=lambda attempt: attempt.rank)
        if best.error is not None:
            raise best.error
        place = tried.index(best)
        tried[place] = best = self._checked(self._optimized(best))
        if best.checked is None:
            raise SimulationError("; ".join(best.failures))
        return ChosenAttempt(best=best, checked=best.checked, tried=tuple(tried), key=self.key)

    def first(self) -> Attempt:
        """The first layout, settled, and checked where it came to rest; it may have failed."""
        attempt = self._attempt(0)
        return attempt if attempt.failures else self._judged(attempt)

    def begun(self) -> Attempt:
        """The first layout, not settled yet: its scene, or its error."""
        return self._begun(0)

    def settled(self, attempt: Attempt, settled: SettledScene) -> Attempt:
        """`attempt`, which is `begun`, at rest as somebody else settled it; checked like `first`."""
        attempt = _with_settled(attempt, settled)
        return attempt if attempt.failures else self._judged(attempt)

    def layout(self) -> Scene:
        """The first layout: objects at poses where nothing touches.

        Raises:
            LayoutError: there is none.
        """
        layout_key = key_of(versions(), self.request.fingerprint, self.seed, self.seed)
        return self._laid_out(0, self.seed, {"layout": layout_key})[0]

    def _attempt(self, number: int) -> Attempt:
        attempt = self._begun(number)
        if attempt.scene is None:
            return attempt
        try:
            settled = self._settled(number, attempt.scene, attempt.notes, attempt.inputs)
        except (LayoutError, SimulationError) as error:
            return replace(attempt, scene=None, error=error)
        return _with_settled(attempt, settled)

    def _begun(self, number: int) -> Attempt:
        layout_seed = derived_seed(self.seed, "layout", number) if number else self.seed
        attempt = Attempt(number=number, layout_seed=layout_seed)
        layout_key = key_of(versions(), self.request.fingerprint, self.seed, layout_seed)
        inputs = {"layout": layout_key, "rest": key_of(layout_key, self.friction, self.device, self.least_tilt)}
        try:
            scene, notes = self._laid_out(number, layout_seed, inputs)
        except (LayoutError, SimulationError) as error:
            return replace(attempt, error=error)
        return replace(attempt, scene=scene, notes=notes, inputs=inputs)

    def _laid_out(self, number: int, layout_seed: int, inputs: Mapping[str, str]) -> tuple[Scene, tuple[str, ...]]:
        """The request's objects at poses where nothing touches, and the layout's notes."""
        kept = self.workspace.layout(number, inputs["layout"])
        if kept is not None:
            scene = kept[0]
            own = {key: scene.provenance[key] for key in (OPTIMISATION,) if key in scene.provenance}
            provenance = {**self._provenance(layout_seed), **own}
            own = {"settling_friction": self.friction, "least_tilt": self.least_tilt, "provenance": provenance}
            task = scene.task if beside_steps(self.request.task) else self.request.task
            return replace(scene, **own, task=task), kept[1]
        if not self._objects_made:
            with self.clock("assets"):
                self._objects, self._objects_made = self.request.make_objects(self.seed, self.progress), True
        again = f"attempt {number + 1}" if number else ""
        with self.clock("layout"):
            self.progress(Event(stage="arranging", detail=again))
            place = partial(self._placed, layout_seed)
            scene, notes = with_task_to_do(place, layout_seed, self.request.task, self.request.relations)
        notes = (*(one.note for one in self._objects if one.note), *notes)
        self.workspace.save_layout(number, {"layout": inputs["layout"]}, scene, notes)
        return scene, notes

    def _placed(self, layout_seed: int, seed: int, wishes: tuple[Arrangement, ...]) -> tuple[Scene, tuple[str, ...]]:
        """The objects as `seed` lays them out, by `wishes` as well, and the layout's notes."""
        from pat3d.layout.layout import arrange

        layout = arrange(
            {one.name: one.asset for one in self._objects},
            self.request.relations,
            seed=seed,
            fixed_poses={one.name: one.pose for one in self._objects if one.pose is not None},
            arrangements=(*self.request.arrangements, *wishes),
            postures={one.name: one.posture for one in self._objects if one.posture is not None},
        )
        objects = tuple(_placed(one, layout.poses[one.name], self.request.relations) for one in self._objects)
        scene = Scene(
            objects=objects,
            relations=self.request.relations,
            arrangements=self.request.arrangements,
            attachments=layout.attachments,
            prompt=self.request.prompt,
            task=self.request.task,
            seed=self.seed,
            settling_friction=self.friction,
            least_tilt=self.least_tilt,
            provenance=self._provenance(layout_seed),
        )
        return scene, layout.notes

    def _settled(self, number: int, scene: Scene, notes: tuple[str, ...], inputs: Mapping[str, str]) -> SettledScene:
        kept = self.workspace.settled(number, inputs["rest"], scene)
        if kept is not None:
            return kept
        with self.clock("kernels"):
            device = prepare(self.device, self.progress)
        with self.clock("settling"):
            self.progress(Event(stage="settling", step=0, scene=scene))
            settled = settle_scene(scene, device=device, progress=self.progress)
        self.workspace.save_settled(number, inputs, settled.of(scene), notes, settled)
        return settled

    def _optimized(self, attempt: Attempt) -> Attempt:
        """`attempt` from a better initial layout, where it needs one and there is one."""
        scene, settled = attempt.scene, attempt.settled
        if scene is None or settled is None or settled.optimisation is not None or not available():
            return attempt
        if not attempt.failures and not attempt.lost:
            return attempt
        from pat3d.optimize.optimize import OptimizeOptions

        with self.clock("kernels"):
            device = prepare(self.device, self.progress)
        # Other layouts have been tried by the attempts; what they share is left to balancing and gradients.
        options = OptimizeOptions(
            epochs=EPOCHS,
            starts=STARTS,
            refined=1,
            relayout=False,
            steady=True,
            least_tilt=scene.least_tilt,
            seed=attempt.layout_seed,
            device=device,
        )
        with self.clock("optimising"):
            try:
                done = optimize_scene(scene, options=options, at_rest=settled.at_rest, progress=self.progress)
            except SimulationError:
                return attempt
        # Recorded even where it changed nothing, so that it is not repeated when the run is resumed.
        kept_scene, kept = scene, replace(settled, optimisation=done.record(kept=False))
        if done.settled is not None:
            faults = broken(relations_at_rest(done.scene))
            other = replace(attempt, scene=done.scene, settled=done.settled, broken=faults, checked=None)
            other = self._checked(other) if not other.failures else other
            if other.rank < attempt.rank:
                attempt, kept_scene, kept = other, done.scene, done.settled
        self.workspace.save_settled(attempt.number, attempt.inputs, kept_scene, attempt.notes, kept)
        checked = replace(attempt.checked, settled=kept) if attempt.checked is not None else None
        return replace(attempt, settled=kept, checked=checked)

    def _judged(self, attempt: Attempt) -> Attempt:
        """`attempt`, checked; what an engine refuses to load has failed like what cannot be simulated."""
        try:
            return self._checked(attempt)
        except CheckError as error:
            return replace(attempt, scene=None, error=SimulationError(str(error)))

    def _checked(self, attempt: Attempt) -> Attempt:
        if attempt.checked is not None or attempt.scene is None or attempt.settled is None:
            return attempt
        mjcf = self.scratch / f"mjcf_{attempt.number + 1}{'' if attempt.settled.optimisation is None else '_optimised'}"
        with self.clock("export"):
            path = write_mjcf(attempt.scene, mjcf)
        with self.clock("verification"):
            verification = verify(attempt.scene, path, self.progress)
        checked = Checked(scene=attempt.scene, settled=attempt.settled, verification=verification, mjcf=mjcf)
        return replace(attempt, checked=checked)

    def _provenance(self, layout_seed: int) -> dict[str, Any]:
        return {
            **self.request.provenance,
            "versions": versions(),
            "settings": {"layout_seed": layout_seed, "friction": self.friction, "device": self.device},
        }


def _with_settled(attempt: Attempt, settled: SettledScene) -> Attempt:
    """An attempt whose layout has come to rest; nothing is checked but its relations."""
    if attempt.scene is None:
        return attempt
    scene = settled.of(attempt.scene)
    return replace(attempt, scene=scene, settled=settled, broken=broken(relations_at_rest(scene)))


def _placed(one: UnplacedObject, pose: Pose, relations: tuple[Relation, ...]) -> SceneObject:
    """An object where the layout put it; fixed ones never fall, so they are set down on the ground."""
    if one.fixed and one.pose is None and parent_of(one.name, relations) == GROUND:
        lowest = min(float(pose.apply(part.vertices)[:, 2].min()) for part in one.asset.parts)
        x, y, z = pose.position
        pose = Pose(position=(x, y, z - lowest + CLEARANCE), quat_wxyz=pose.quat_wxyz)
    return SceneObject(
        name=one.name,
        phrase=one.phrase,
        asset=one.asset,
        pose=pose,
        initial_pose=pose,
        fixed=one.fixed,
        posture=one.posture,
    )
