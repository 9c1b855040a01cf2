"""Is a suite any good: shortcuts, what a decision takes, overfitting, ambiguity, coverage, too easy and impossible.

Small networks imitate the scripted policy on training scenes with less and less of what the task needs (see
`pat3d.policies_eval.policies.inputs`). What they still achieve is what the suite gives away. Everything that takes long
is kept in the folder of the diagnosis, so that an interrupted one goes on where it stopped.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pat3d.envs.suites.folder import read_document, write_document
from pat3d.envs.suites.suite import Suite
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.findings import Shares, judged
from pat3d.policies_eval.analysis.statistics import Rate, episodes_for, wilson
from pat3d.policies_eval.analysis.survey import Surveyed, spread, survey
from pat3d.policies_eval.policies.inputs import KINDS
from pat3d.policies_eval.run.episodes import Episode, Setting, episodes_of
from pat3d.policies_eval.run.settings import RolloutSettings

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
    seed: int = 0

    def __post_init__(self) -> None:
        limits = {
            "scenes": (1, 100_000), "demonstrations": (0, 100_000), "episodes": (1, 100_000), "epochs": (1, 10_000),
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
    """By policy ("scripted", "replay" and KINDS) and part."""
    decisions: dict[str, dict[str, int]]
    """Paired episodes that decide a difference, by how alike the policies are and the difference."""
    too_easy: tuple[int, ...]
    """Places of scenes that were done by networks that see neither objects nor words, or by repeating actions."""
    impossible: tuple[int, ...]
    """Places of scenes in which the scripted policy never succeeded."""
    findings: tuple[str, ...]
    """What speaks against the suite."""

    def to_json(self) -> dict[str, Any]:
        """As plain JSON data."""
        rates = {name: {part: asdict(rate) for part, rate in found.items()} for name, found in self.rates.items()}
        return {**vars(self), "surveyed": [one.to_json() for one in self.surveyed], "rates": rates}


def diagnose(suite: Suite, out: str | Path, extent: Extent, *, workers: int = 1, tell: Told = print) -> Diagnosis:
    """Look at a suite and try networks on it; diagnosis.json in `out` says what was found.

    Args:
        suite: a complete one.
        out: folder for what takes long; of another suite's diagnosis it is refused.
        extent: how much.
        workers: processes that do episodes; 0 for this one.
        tell: told what is being done.

    Raises:
        EvaluationError: `out` holds something else, or nothing can be demonstrated.
    """
    folder = Path(out)
    _claim(folder, suite, extent)
    surveyed = _surveyed(suite, folder, extent, tell)
    shares = Shares()
    if extent.demonstrations:
        _trained(suite, folder, extent, tell, shares)
        for policy in ("scripted", *KINDS):
            for part, splits in PARTS.items():
                _tried(suite, folder, extent, policy, part, splits, workers, tell, shares)
    found = Diagnosis(
        suite=suite.folder.path.name,
        checksum=str(suite.document["checksum"]),
        surveyed=surveyed,
        rates=shares.rates(),
        decisions=decisions(shares.unlike("task", "train")),
        too_easy=shares.done_by("robot", "replay"),
        impossible=shares.never_done_by("scripted"),
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
    """Scenes and tasks of splits, those that the suite has."""
    return tuple(
        Setting(scene=str(suite.folder.scene(entry.place)), task=entry.task)
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


def _trained(suite: Suite, folder: Path, extent: Extent, tell: Told, shares: Shares) -> None:
    """Demonstrate, train every network, and repeat the demonstrated actions under other seeds; or what is missing."""
    from pat3d.policies_eval.datasets.demonstrations import demonstrations
    from pat3d.policies_eval.policies.cloning import save
    from pat3d.policies_eval.train import fit

    repeated = folder / "replay.json"
    if not repeated.is_file():
        settings = _settings(suite)
        episodes = episodes_of(settings_in(suite, PARTS["train"]), extent.demonstrations, seed=extent.seed)
        shown = []
        for one in demonstrations(episodes, settings=settings):
            shown.append(one)
            tell(f"demonstrations: {one.episode.index + 1} of {len(episodes)}, {len(shown)} succeeded")
        for kind in KINDS:
            network, error = fit(shown, epochs=extent.epochs, seed=extent.seed, sees=kind)
            save(network, folder / f"{kind}.pt", {"demonstrations": len(shown), "error": error})
            tell(f'network that sees "{kind}": error {error:.4f}')
        done = [{"scene": one.episode.scene, "success": again(one, settings)} for one in shown[: extent.episodes]]
        write_document(repeated, {"episodes": done})
    for one in read_document(repeated)["episodes"]:
        shares.add("replay", "train", place_of(one["scene"]), success=bool(one["success"]))


def again(demonstration: Any, settings: RolloutSettings) -> bool:
    """Whether the actions of a demonstration succeed in the same scene from another start."""
    from dataclasses import replace

    from pat3d.policies_eval.run.rollout import Runner

    runner = Runner(settings)
    try:
        episode = replace(demonstration.episode, seed=demonstration.episode.seed ^ 0x5EED)
        runner.start(episode)
        for action in demonstration.done:
            _, _, success, broken, _ = runner.env.step(action)
            if success or broken:
                return bool(success)
        return False
    finally:
        runner.close()


def _tried(
    suite: Suite,
    folder: Path,
    extent: Extent,
    policy: str,
    part: str,
    splits: Sequence[str],
    workers: int,
    tell: Told,
    shares: Shares,
) -> None:
    """Episodes of one policy in one part of the suite."""
    from pat3d.policies_eval.policies.registry import make_policy
    from pat3d.policies_eval.run.evaluate import evaluate

    settings = settings_in(suite, splits)
    if not settings:
        return
    # Every scene comes twice, so that what the seed does can be told from what the scene does.
    twice = tuple(one for one in settings[: max(1, extent.episodes // 2)] for _ in range(2))
    episodes: tuple[Episode, ...] = episodes_of(twice, extent.episodes, seed=extent.seed + OTHER)
    name = policy if policy == "scripted" else str(folder / f"{policy}.pt")
    done = evaluate(
        make_policy(name) if workers == 0 else name,
        episodes,
        folder / "episodes" / f"{policy} {part}".replace(" ", "-"),
        settings=_settings(suite),
        workers=workers,
    )
    for one in done.results:
        shares.add(policy, part, place_of(one.episode.scene), success=one.success)
    rate = wilson(sum(one.success for one in done.results), len(done.results))
    tell(f'"{policy}" on {part}: {rate}')
