"""Is a suite any good: shortcuts, what a decision takes, overfitting, ambiguity, coverage, too easy and impossible.

Small networks imitate the scripted policy on training scenes with less and less of what the task needs (see
`pat3d.policies_eval.policies.inputs`). What they still achieve is what the suite gives away. Everything that takes long
is kept in the folder of the diagnosis, so that an interrupted one goes on where it stopped.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from pat3d.envs.suites.folder import read_document, write_document
from pat3d.envs.suites.suite import Suite
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.findings import HELD_OUT, Shares, judged, verdicts
from pat3d.policies_eval.analysis.statistics import Loss, Rate, episodes_for
from pat3d.policies_eval.analysis.survey import Surveyed, spread, survey
from pat3d.policies_eval.run.episodes import Episode, Setting, episodes_of
from pat3d.policies_eval.run.settings import RolloutSettings
from pat3d.policies_eval.training import KINDS, ROUNDS

PARTS = {
    "train": ("train",),
    "new objects": ("val/object", "test/object"),
    "new layouts": ("val/layout", "test/layout"),
}
"""What the networks are tried on: the splits of each part."""

DIFFERENCES = (0.02, 0.05, 0.10)
"""Of success rates, for which the number of episodes is told."""

OTHER = 1
"""Added to the seed of demonstrations for the episodes that are tried."""

Told = Callable[[str], None]


@dataclass(frozen=True, kw_only=True)
class Extent:
    """How much is looked at and tried."""

    scenes: int = 50
    """That are looked at."""
    demonstrations: int = 60
    """Of the scripted policy on training scenes; 0 for no network."""
    episodes: int = 20
    """In which every network is tried on every part."""
    epochs: int = 80
    rounds: int = 2
    """Of further demonstrations in which the cloned baseline has the hand in turns, half of all; 0 for none."""
    curve: int = 0
    """Further trainings of the baseline, each with a quarter of the demonstrations of the one before."""
    seed: int = 0

    def __post_init__(self) -> None:
        limits = {
            "scenes": (1, 100_000), "demonstrations": (0, 100_000), "episodes": (1, 100_000), "epochs": (1, 10_000),
            "rounds": ROUNDS, "curve": (0, 5),
        }  # fmt: skip
        for name, (low, high) in limits.items():
            if not low <= getattr(self, name) <= high:
                raise EvaluationError(f"{name} is {low} to {high}, not {getattr(self, name)}.")


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """What was found of a suite."""

    suite: str
    checksum: str
    surveyed: tuple[Surveyed, ...]
    rates: dict[str, dict[str, Rate]]
    """By policy ("scripted", "replay", KINDS and "task-N" of N demonstrations) and part."""
    decisions: dict[str, dict[str, int]]
    """Paired episodes that decide a difference, by how alike the policies are and the difference."""
    too_easy: tuple[int, ...]
    """Places of scenes that were done by networks that see neither objects nor words, or by repeating actions."""
    impossible: tuple[int, ...]
    """Places of scenes in which the scripted policy never succeeded."""
    losses: dict[str, Loss]
    """Of the cloned baseline on parts that it was not trained on, against training scenes."""
    carried: tuple[str, ...]
    """The same in words, each with a verdict."""
    findings: tuple[str, ...]
    """What speaks against the suite."""

    def to_json(self) -> dict[str, Any]:
        """As plain JSON data."""
        rates = {name: {part: asdict(rate) for part, rate in found.items()} for name, found in self.rates.items()}
        losses = {part: asdict(one) for part, one in self.losses.items()}
        surveyed = [one.to_json() for one in self.surveyed]
        return {**vars(self), "surveyed": surveyed, "rates": rates, "losses": losses}


def diagnose(
    suite: Suite, out: str | Path, extent: Extent, *, workers: int = 1, device: str = "cpu", tell: Told = print
) -> Diagnosis:
    """Look at a suite and try networks on it; diagnosis.json in `out` says what was found.

    Args:
        suite: a complete one.
        out: folder for what takes long; of another suite's diagnosis it is refused.
        extent: how much.
        workers: processes that do episodes; 0 for this one.
        device: where networks are trained, "cpu" or "cuda".
        tell: told what is being done.

    Raises:
        EvaluationError: `out` holds something else, or nothing can be demonstrated.
    """
    folder = Path(out)
    _claim(folder, suite, extent)
    surveyed = _surveyed(suite, folder, extent, tell)
    shares = Shares()
    if extent.demonstrations:
        fewer = _trained(suite, folder, extent, workers, device, tell, shares)
        for policy in ("scripted", *KINDS, *fewer):
            _tried(suite, folder, extent, policy, workers, tell, shares)
    found = Diagnosis(
        suite=suite.folder.path.name,
        checksum=str(suite.document["checksum"]),
        surveyed=surveyed,
        rates=shares.rates(),
        decisions=decisions(shares.unlike("task", "train")),
        too_easy=shares.done_by("robot", "replay"),
        impossible=shares.never_done_by("scripted"),
        losses={part: lost for part in HELD_OUT if (lost := shares.loss("task", part)) is not None},
        carried=tuple(verdicts(shares).values()),
        findings=judged(surveyed, shares),
    )
    write_document(folder / "diagnosis.json", found.to_json())
    return found


def decisions(repeated: float | None) -> dict[str, dict[str, int]]:
    """Paired episodes that decide differences at 5 % with a power of 80 %, around a success rate of one half.

    Args:
        repeated: share of scenes in which one policy succeeds under one seed and fails under another; None if unknown.
    """
    alike = {"unrelated failures": 0.5} | ({} if repeated is None else {"as alike as two seeds": repeated})
    return {
        name: {f"{100 * effect:.0f} %": episodes_for(max(share, effect), effect) for effect in DIFFERENCES}
        for name, share in alike.items()
    }


def settings_in(suite: Suite, splits: Sequence[str]) -> tuple[Setting, ...]:
    """Scenes, tasks and rooms of splits, those that the suite has."""
    return tuple(
        Setting(scene=str(suite.folder.scene(entry.place)), task=entry.task, room=entry.room, rooms=suite.request.rooms)
        for entry in suite.entries
        if entry.split in splits
    )


def _settings(suite: Suite) -> RolloutSettings:
    request = suite.request
    return RolloutSettings(robot=request.robot, vary=request.vary, max_objects=suite.most_objects)


def place_of(scene: str) -> int:
    """Of a scene's folder in its suite."""
    return int(Path(scene).name)


def _claim(folder: Path, suite: Suite, extent: Extent) -> None:
    """Make the folder this diagnosis's, or raise EvaluationError."""
    file = folder / "request.json"
    # JSON has no tuples: compared as it is read back.
    asked = json.loads(json.dumps({"suite": str(suite.document["checksum"]), **asdict(extent)}))
    if file.is_file():
        if read_document(file) != asked:
            raise EvaluationError(f"{folder} holds another diagnosis; choose another --out.")
    elif folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise EvaluationError(f"{folder} holds something else; choose another --out.")
    else:
        folder.mkdir(parents=True, exist_ok=True)
        write_document(file, asked)


def _surveyed(suite: Suite, folder: Path, extent: Extent, tell: Told) -> tuple[Surveyed, ...]:
    file = folder / "survey.json"
    if file.is_file():
        return tuple(map(Surveyed.from_json, read_document(file)["scenes"]))
    chosen = spread(suite.entries, extent.scenes)
    found = survey(suite, chosen, lambda done, of: tell(f"looking at scenes: {done} of {of}"))
    write_document(file, {"scenes": [one.to_json() for one in found]})
    return found


def _trained(
    suite: Suite, folder: Path, extent: Extent, workers: int, device: str, tell: Told, shares: Shares
) -> tuple[str, ...]:
    """Demonstrate, train every network, and repeat the demonstrated actions under other seeds; or what is missing.

    Returns:
        Names of the networks that were trained on fewer demonstrations.
    """
    from pat3d.policies_eval.policies.cloning import save
    from pat3d.policies_eval.train import Training, fit, learn

    repeated = folder / "replay.json"
    if not repeated.is_file():
        settings = _settings(suite)
        episodes = episodes_of(settings_in(suite, PARTS["train"]), extent.demonstrations, seed=extent.seed)
        training = Training(epochs=extent.epochs, seed=extent.seed, device=device)
        shown = learn(
            episodes, training, folder / "task.pt", rounds=extent.rounds, settings=settings, workers=workers, tell=tell
        )

        def trained(name: str, kind: str, demonstrations: Sequence[Any]) -> None:
            network, error = fit(demonstrations, replace(training, sees=kind))
            save(network, folder / f"{name}.pt", {"demonstrations": len(demonstrations), "error": error})
            tell(f'network "{name}": {len(demonstrations)} demonstrations, error {error:.4f}')

        # Those that go by the time learn nothing from hands that were led astray and came back.
        alone = [one for one in shown if not one.learner]
        for kind in KINDS:
            if kind != "task":
                trained(kind, kind, alone)
        fewer = []
        for number in range(1, extent.curve + 1):
            part = shown[:: 4**number]
            fewer.append(f"task-{len(part)}")
            trained(fewer[-1], "task", part)
        known = [(one.episode, one.done) for one in alone[: extent.episodes]]
        done = [
            {"scene": episode.scene, "success": success}
            for (episode, _), success in zip(known, _repeated(known, settings, workers), strict=True)
        ]
        write_document(repeated, {"episodes": done, "fewer": fewer})
    found = read_document(repeated)
    for one in found["episodes"]:
        shares.add("replay", "train", place_of(one["scene"]), success=bool(one["success"]))
    return tuple(found["fewer"])


def _repeated(known: Sequence[tuple[Episode, Any]], settings: RolloutSettings, workers: int) -> list[bool]:
    """`again` for episodes and their actions."""
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    from pat3d.policies_eval.run.processes import thread_limit

    if not workers:
        return [again(episode, actions, settings) for episode, actions in known]
    context = multiprocessing.get_context("spawn")
    with thread_limit(1), ProcessPoolExecutor(min(workers, len(known)), mp_context=context) as pool:
        return list(pool.map(again, *zip(*known, strict=True), [settings] * len(known)))


def again(episode: Episode, actions: Any, settings: RolloutSettings) -> bool:
    """Whether the actions of a demonstration succeed in the same scene from another start.

    Args:
        episode: that was demonstrated.
        actions: that were done, shape (steps, action size).
        settings: of the environment.
    """
    from pat3d.policies_eval.run.rollout import Runner

    runner = Runner(settings)
    try:
        runner.start(replace(episode, seed=episode.seed ^ 0x5EED))
        for action in actions:
            _, _, success, broken, _ = runner.env.step(action)
            if success or broken:
                return bool(success)
        return False
    finally:
        runner.close()


def _tried(suite: Suite, folder: Path, extent: Extent, policy: str, workers: int, tell: Told, shares: Shares) -> None:
    """Episodes of one policy in every part of the suite."""
    from pat3d.policies_eval.policies.registry import make_policy
    from pat3d.policies_eval.run.evaluate import evaluate

    episodes: list[Episode] = []
    part_of: dict[str, str] = {}
    for part, splits in PARTS.items():
        settings = settings_in(suite, splits)
        part_of |= {one.scene: part for one in settings}
        # Every scene comes twice, so that what the seed does can be told from what the scene does.
        twice = tuple(one for one in settings[: max(1, extent.episodes // 2)] for _ in range(2))
        found = episodes_of(twice, extent.episodes, seed=extent.seed + OTHER) if twice else ()
        episodes += [replace(one, index=len(episodes) + one.index) for one in found]
    name = policy if policy == "scripted" else str(folder / f"{policy}.pt")
    done = evaluate(
        make_policy(name) if workers == 0 else name,
        episodes,
        folder / "episodes" / policy,
        settings=_settings(suite),
        workers=workers,
    )
    for one in done.results:
        shares.add(policy, part_of[one.episode.scene], place_of(one.episode.scene), success=one.success)
    for part in PARTS:
        rate = shares.rate(policy, part)
        if rate is not None:
            tell(f'"{policy}" on {part}: {rate}')
