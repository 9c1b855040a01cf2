"""Simulation in the loop: the initial layout whose settled scene says what the relations say.

    found = optimize(assets, relations, layout.poses)
    found.poses0                # the layout to settle from
    found.poses                 # at rest

First the layout as given is settled; if every relation holds, that is the answer. If not, a batch of other layouts
(pat3d.optimize.starts) settles in the worlds of one model. Only if none of them holds, gradients of the semantic loss
through the rollout refine the best few with Adam. The best settled scene wins: most relations that hold, then the least
loss; among scenes in which everything holds, those that can be tilted furthest before their certificate fails come
before those of less loss. If even the best has a small tilt margin, loads are centred on their supports
(pat3d.optimize.tilt_margin).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pat3d.errors import SimulationError, SpecError
from pat3d.geometry.pose import Pose
from pat3d.layout.predicates import check_relations
from pat3d.optimize.loss import SemanticLoss, states
from pat3d.optimize.placement import Placement
from pat3d.optimize.refine import Epoch, refine
from pat3d.optimize.starts import Start, make_starts
from pat3d.optimize.tilt_margin import recentred
from pat3d.optimize.trial import LEAST_TILT, SPARE, Optimized, Trial
from pat3d.scene.asset import Asset
from pat3d.scene.model import Attachment, Relation, Scene, check_tree
from pat3d.scene.physics import MAX_TILT
from pat3d.sim.model import ModelBuilder, poses_from_states
from pat3d.sim.run import SettleOptions
from pat3d.sim.settling import settle

RECENTRINGS = 4
"""Times that loads are centred at most."""
Progress = Callable[[str, int, float], None]
"""Called with the phase ("settling", "settling starts", "epoch"), a step number, and its motion [m] or loss [m^2]."""


@dataclass(frozen=True, kw_only=True)
class OptimizeOptions:
    """Settings of the optimisation."""

    epochs: int = 50
    """Gradient steps at most; 0 for none."""
    learning_rate: float = 1.0e-3
    """Of Adam [m]."""
    every: int = 10
    """Frames between those that the loss is gathered from, besides the last."""
    frames: int = 90
    """Frames of a differentiated rollout at most; what falls has fallen by then, and heaps that creep on only add
    noise."""
    patience: int = 15
    """Epochs without a lower loss that end the gradient steps."""
    starts: int = 6
    """Layouts settled together, the one as given among them; 1 for no global search."""
    refined: int = 2
    """How many of them gradients refine."""
    relayout: bool = True
    """Whether layouts with other seeds may be among the starts."""
    steady: bool = False
    """Whether a layout in which everything holds, but hardly, is improved too."""
    least_tilt: float = 0.0
    """What the verification will ask for [degrees]; with `steady`, at least `trial.LEAST_TILT` is aimed at anyway."""
    seed: int = 0
    """Of the random starts."""
    settle: SettleOptions = field(default_factory=SettleOptions)
    device: str = "cpu"

    def __post_init__(self) -> None:
        limits = {"epochs": 0, "every": 1, "frames": 1, "patience": 1, "starts": 1, "refined": 1, "seed": 0}
        for name, least in limits.items():
            if getattr(self, name) < least:
                raise SpecError(f"{name} must be at least {least}, got {getattr(self, name)}.")
        if not (np.isfinite(self.learning_rate) and self.learning_rate > 0.0):
            raise SpecError(f"learning_rate must be positive, got {self.learning_rate}.")


def optimize(
    assets: Mapping[str, Asset],
    relations: tuple[Relation, ...],
    poses0: Mapping[str, Pose],
    *,
    options: OptimizeOptions | None = None,
    fixed: Collection[str] = (),
    pinned: Collection[str] = (),
    attachments: tuple[Attachment, ...] = (),
    settled: tuple[Mapping[str, Pose], bool] | None = None,
    progress: Progress = lambda *_: None,
) -> Optimized:
    """Find an initial layout near `poses0` (or another one) that settles into what `relations` say.

    Args:
        assets: by object name.
        relations: the scene tree and the lateral relations.
        poses0: intersection-free layout of every object.
        options: settings.
        fixed: objects that never move.
        pinned: objects that settle like others but always start where they are.
        attachments: by which things hang; what hangs moves with its carrier.
        settled: what `poses0` settles into and whether that is at rest, where it is known already.
        progress: told what is going on.

    Returns:
        The best scene found; it may still lack some relations, which it lists.

    Raises:
        SpecError: relations or poses do not fit the assets.
        SimulationError: the layout as given intersects or cannot be simulated.
    """
    options = options or OptimizeOptions()
    check_tree(list(assets), relations)
    missing = [name for name in (*assets, *fixed, *pinned) if name not in poses0]
    if missing:
        raise SpecError(f'"{missing[0]}" has no initial pose. Poses given: {", ".join(poses0)}.')
    placement = Placement(assets, relations, poses0, fixed=fixed, pinned=pinned, attachments=attachments)
    search = _Search(placement, options, progress)
    start = Start(source="layout", poses=placement.poses, balance=0.0, attachments=attachments)
    first = search.trial(start, *settled) if settled else search.settled([start], "settling")[0]
    if options.steady:
        first = search.judged(first)
    done = first.steady if options.steady else first.satisfied
    if done or not placement.movable.any():
        return Optimized(best=first, first=first, skipped=done, trials=(first,), history=())
    return search.run(first)


def optimize_scene(
    scene: Scene,
    *,
    options: OptimizeOptions | None = None,
    pinned: Collection[str] = (),
    at_rest: bool | None = None,
    progress: Progress = lambda *_: None,
) -> Optimized:
    """`optimize` from the initial poses of `scene`, which settles with its own friction.

    Args:
        scene: laid out.
        options: settings.
        pinned: as for `optimize`.
        at_rest: whether the objects' poses are at rest; None where they are not what the layout settles into.
        progress: told what is going on.
    """
    options = options or OptimizeOptions()
    return optimize(
        {obj.name: obj.asset for obj in scene.objects},
        scene.relations,
        {obj.name: obj.initial_pose for obj in scene.objects},
        options=replace(options, settle=replace(options.settle, friction=scene.settling_friction)),
        fixed={obj.name for obj in scene.objects if obj.fixed},
        pinned=pinned,
        attachments=scene.attachments,
        settled=None if at_rest is None else ({obj.name: obj.pose for obj in scene.objects}, at_rest),
        progress=progress,
    )


def scene_after(scene: Scene, trial: Trial) -> Scene:
    """`scene` with the layout and the poses at rest of `trial`."""
    objects = tuple(
        replace(obj, initial_pose=trial.poses0[obj.name], pose=trial.poses[obj.name]) for obj in scene.objects
    )
    return replace(scene, objects=objects, attachments=trial.attachments)


def _result(trials: list[Trial], history: list[Epoch]) -> Optimized:
    best = min(trials, key=lambda trial: trial.rank)
    return Optimized(best=best, first=trials[0], skipped=False, trials=tuple(trials), history=tuple(history))


class _Search:
    def __init__(self, placement: Placement, options: OptimizeOptions, progress: Progress) -> None:
        self.placement, self.options, self.progress = placement, options, progress

    def run(self, first: Trial) -> Optimized:
        """Other starts, then gradients where no start holds."""
        options, placement = self.options, self.placement
        trials = [first, *self._steadied(first)]
        if trials[-1].steady:
            return _result(trials, [])
        starts = make_starts(
            placement, placement.relations, count=options.starts, seed=options.seed, relayout=options.relayout
        )
        trials += [self.judged(trial) for trial in self.settled(starts[1:], "settling starts")]
        history: list[Epoch] = []
        if options.epochs and not any(trial.satisfied for trial in trials):
            for trial in sorted(trials, key=lambda trial: trial.rank)[: options.refined]:
                polished = self._refined(trial, len(history) and history[-1].start + 1, history)
                trials += polished
                if any(one.satisfied for one in polished):
                    break
        trials += self._steadied(min(trials, key=lambda trial: trial.rank))
        return _result(trials, history)

    def settled(self, starts: list[Start], phase: str) -> list[Trial]:
        """What every start settles into; starts that cannot be simulated are left out, unless there is but one."""
        if not starts:
            return []
        builder = ModelBuilder()
        for start in starts:
            builder.new_world()
            builder.add_scene(self.placement.scene(start.poses, start.attachments))
        model = builder.finalize(self.options.device)
        try:
            found = settle(
                model,
                self.options.settle,
                lambda _, step, motion: self.progress(phase, step, motion),
                throw=False,
            )
        except SimulationError:
            if len(starts) == 1:
                raise
            return [trial for start in starts for trial in self._alone(start, phase)]
        count = len(self.placement.names)
        poses = poses_from_states(model, found.q)
        names = self.placement.names
        return [
            self.trial(start, dict(zip(names, poses[w * count : (w + 1) * count], strict=True)), bool(found.at_rest[w]))
            for w, start in enumerate(starts)
        ]

    def _alone(self, start: Start, phase: str) -> list[Trial]:
        try:
            return self.settled([start], phase)
        except SimulationError:
            return []

    def trial(self, start: Start, settled: Mapping[str, Pose], at_rest: bool) -> Trial:
        """`start` with what it settled into."""
        assets, relations = self.placement.assets, self.placement.relations
        poses = {name: (start.poses if name in self.placement.fixed else settled)[name] for name in assets}
        loss = SemanticLoss(assets, relations, start.poses)
        return Trial(
            source=start.source,
            poses0=start.poses,
            poses=poses,
            at_rest=at_rest,
            loss=float(loss(states(assets, poses))),
            results=check_relations(relations, assets, poses, attachments=start.attachments),
            attachments=start.attachments,
            least_tilt=min(max(LEAST_TILT, SPARE * self.options.least_tilt), MAX_TILT),
        )

    def judged(self, trial: Trial) -> Trial:
        """`trial` with its tilt margin, where everything holds in it."""
        if not trial.satisfied:
            return trial
        from pat3d.check.certificate import steadiness

        return replace(trial, tilt_margin=steadiness(self._scene(trial)))

    def _refined(self, trial: Trial, number: int, history: list[Epoch]) -> list[Trial]:
        """Gradient steps from one trial's layout; what its promising iterates settle into."""
        placement = self._at(trial)
        found: list[Trial] = []

        def confirm(poses: Mapping[str, Pose]) -> bool:
            start = Start(source="gradient", poses=poses, balance=0.0, attachments=trial.attachments)
            found.extend(self.judged(one) for one in self._alone(start, "settling"))
            return bool(found) and found[-1].satisfied

        options = self.options
        best = refine(
            placement,
            placement.relations,
            confirm=confirm,
            start=number,
            history=history,
            progress=self.progress,
            epochs=options.epochs,
            learning_rate=options.learning_rate,
            every=options.every,
            patience=options.patience,
            frames=min(options.frames, options.settle.max_frames),
            settings=options.settle,
            device=options.device,
        )
        if not any(one.satisfied for one in found):
            confirm(best)
        return found

    def _steadied(self, trial: Trial) -> list[Trial]:
        """What `trial` becomes when its loads are centred on their supports, for as long as that helps."""
        found: list[Trial] = []
        while trial.satisfied and not trial.steady and len(found) < RECENTRINGS:
            placement = self._at(trial)
            poses0 = recentred(placement, self._scene(trial))
            if poses0 is None:
                break
            start = Start(source="recentred", poses=poses0, balance=0.0, attachments=trial.attachments)
            tried = [self.judged(one) for one in self._alone(start, "settling")]
            found += tried
            if not tried or tried[0].rank >= trial.rank:
                break
            trial = tried[0]
        return found

    def _at(self, trial: Trial) -> Placement:
        """The placement with the layout of `trial`."""
        now = self.placement
        return Placement(
            now.assets, now.relations, trial.poses0, fixed=now.fixed, pinned=now.held, attachments=trial.attachments
        )

    def _scene(self, trial: Trial) -> Scene:
        return self.placement.scene(
            trial.poses0, trial.attachments, poses=trial.poses, friction=self.options.settle.friction
        )
