"""An evaluation: episodes, worker processes that do them, and what the parent does when one of them dies.

A failure of what evaluates (the environment, a process outside of the policy) is never a score: it ends the run with an
InfrastructureError, and the folder is not claimed before the first episode has been done.
"""

from __future__ import annotations

import functools
import json
import multiprocessing
import os
import shutil
from collections import Counter, deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from pat3d.errors import EvaluationError, InfrastructureError, Pat3dError
from pat3d.policies_eval.policies.policy import Policy
from pat3d.policies_eval.policies.registry import identity, make_policy, require_known
from pat3d.policies_eval.run.episodes import Episode, checksum
from pat3d.policies_eval.run.manifest import make_manifest, require_same
from pat3d.policies_eval.run.processes import GRACE_SECONDS, POLL_SECONDS, cores, now, serve, thread_limit, told
from pat3d.policies_eval.run.records import Evaluation, RecordFolder, read_manifest, write_text
from pat3d.policies_eval.run.rollout import Result, Runner
from pat3d.policies_eval.run.settings import RolloutSettings

DEATHS = 2
"""Of processes over the same episode, outside of the policy, that end the run."""

MAX_WORKERS = 512

LOOK_AHEAD = 20_000
"""Episodes among which a worker looks for one in the world that it has compiled."""

Report = Callable[[Result, int, int], None]
"""Called with every new result, the number done and the number wanted."""


def evaluate(
    policy: str | Policy,
    episodes: Sequence[Episode],
    out: str | os.PathLike[str],
    *,
    settings: RolloutSettings | None = None,
    source: dict[str, Any] | None = None,
    workers: int = 1,
    worlds: int = 0,
    overwrite: bool = False,
    report: Report | None = None,
    tell: Callable[[str], None] = lambda text: None,
) -> Evaluation:
    """Do the episodes that `out` does not hold yet.

    Args:
        policy: a specification for `make_policy`, or a policy itself, which runs in this process.
        episodes: what to do; those of an earlier run of the same evaluation in `out` are not done again.
        out: folder of the records.
        settings: of the environment.
        source: where the episodes come from, for the manifest.
        workers: processes; 0 runs in this one, where a policy that hangs outside Python cannot be ended. With a device
            they have the policies.
        worlds: most that a device steps together; 0 for as many as `pat3d.policies_eval.run.device` says.
        overwrite: throw away what `out` holds.
        report: is told of every result.
        tell: is told in words what is done on a device.

    Raises:
        EvaluationError: `out` holds another evaluation, or the policy cannot be made.
        InfrastructureError: the environment, or a process outside of the policy, failed.
        ModuleNotFoundError: a package that the environment needs is not installed.
        Pat3dError: an episode that cannot be set up.
    """
    settings, folder = settings or RolloutSettings(), Path(out)
    name = policy if isinstance(policy, str) else f"{type(policy).__module__}:{type(policy).__qualname__}"
    if not isinstance(policy, str) and workers:
        raise EvaluationError("a policy object runs in this process: workers=0; give worker processes its name.")
    if not isinstance(policy, str) and settings.device:
        raise EvaluationError("a policy object does one episode at a time; for a device give its name.")
    if not 0 <= workers <= MAX_WORKERS:
        raise EvaluationError(f"0 to {MAX_WORKERS} workers, not {workers}.")
    if isinstance(policy, str):
        require_known(policy)
    details = identity(policy) if isinstance(policy, str) else {}
    known = source or {"episodes": checksum(episodes)}
    manifest = make_manifest(name, details, settings, known, len(episodes))
    records, claim = _prepare(folder, manifest, overwrite=overwrite)
    going_on = (folder / "manifest.json").exists() and not overwrite
    done = {one.episode.index: one for one in records.read()} if going_on else {}
    for episode in episodes:
        kept = done.get(episode.index)
        if kept is not None and kept.episode != episode:
            raise EvaluationError(f"{folder}: episode {episode.index} there is another one; choose another --out.")
    todo = [episode for episode in episodes if episode.index not in done]
    finished, claimed = len(episodes) - len(todo), False

    def keep(result: Result) -> None:
        nonlocal finished, claimed
        if not claimed:
            claim()
            claimed = True
        records.add(result)
        done[result.episode.index] = result
        finished += 1
        if report is not None:
            report(result, finished, len(episodes))

    try:
        if todo and settings.device:
            _on_device(name, todo, settings, workers, worlds, keep, tell)
        elif todo:
            _on_processors(policy, name, todo, settings, workers, keep)
    except BaseException:
        records.flush()
        raise
    if not todo:
        claim()
    return Evaluation(
        folder=folder,
        manifest=read_manifest(folder),
        results=records.merge(tuple(done[index] for index in sorted(done))),
    )


def _on_device(
    policy: str,
    todo: Sequence[Episode],
    settings: RolloutSettings,
    workers: int,
    worlds: int,
    keep: Callable[[Result], None],
    tell: Callable[[str], None],
) -> None:
    """Do on a device what can be done there, and the rest as without one."""
    from pat3d.policies_eval.run.device import perform
    from pat3d.policies_eval.run.ensemble import Evaluating

    run = perform(Evaluating(policy), todo, settings, workers=workers, worlds=worlds, tell=tell)
    while True:
        try:
            keep(next(run)[1])
        except StopIteration as end:
            left: dict[int, str] = end.value
            break
    if not left:
        return
    tell(f"{len(left)} episodes are left to MuJoCo on the CPU")

    def keep_left(result: Result) -> None:
        keep(replace(result, left_out=left[result.episode.index]))

    rest = [episode for episode in todo if episode.index in left]
    _on_processors(policy, policy, rest, settings, workers, keep_left)


def _on_processors(
    policy: str | Policy,
    name: str,
    todo: Sequence[Episode],
    settings: RolloutSettings,
    workers: int,
    keep: Callable[[Result], None],
) -> None:
    """Do episodes with MuJoCo, each in one process."""
    if workers == 0:
        _here(policy if not isinstance(policy, str) else make_policy(policy), todo, settings, keep)
    else:
        _Pool(name, settings, min(workers, len(todo))).run(todo, keep)


def _prepare(folder: Path, manifest: dict[str, Any], *, overwrite: bool) -> tuple[RecordFolder, Callable[[], None]]:
    """Where the records go, and what makes the folder this evaluation's; until that is called nothing is written."""
    records = RecordFolder(folder)
    file = folder / "manifest.json"
    if file.exists() and not overwrite:
        old = read_manifest(folder)
        require_same(old, manifest, folder)
        manifest = manifest | {"episodes": max(old["episodes"], manifest["episodes"])}
    elif folder.exists() and not folder.is_dir():
        raise EvaluationError(f"{folder} is no folder.")
    elif folder.exists() and any(folder.iterdir()) and not file.exists():
        raise EvaluationError(f"{folder} holds something else; choose another --out.")

    def claim() -> None:
        if overwrite and file.exists():
            for name in ("episodes.parquet", "report.html"):
                (folder / name).unlink(missing_ok=True)
            for name in ("parts", "media"):
                shutil.rmtree(folder / name, ignore_errors=True)
        write_text(file, json.dumps(manifest, indent=2, sort_keys=True) + "\n")

    return records, claim


def _here(policy: Policy, todo: Sequence[Episode], settings: RolloutSettings, keep: Callable[[Result], None]) -> None:
    runner, queue, about = Runner(settings), deque(todo), ("", "")
    try:
        while queue:
            episode = next_episode(queue, about)
            about = (episode.scene, episode.task)
            try:
                result = runner.run(episode, policy)
            except (Pat3dError, ModuleNotFoundError):
                raise
            except Exception as error:
                raise InfrastructureError(_no_score(episode, told(error))) from error
            keep(result)
    finally:
        runner.close()


@dataclass(eq=False)
class _Worker:
    """One process, and what it is doing."""

    process: Any
    pipe: Connection
    deadline: Any
    """Time by which the policy has to answer, 0 while it is not asked; written by the worker."""
    episode: Episode | None = None
    about: tuple[str, str] = ("", "")
    """Scene and task of its last episode, whose world it has compiled."""
    begun: float = 0.0


def next_episode(queue: deque[Episode], about: tuple[str, str]) -> Episode:
    """Take the first episode of `queue` with the scene and the task in `about` if there is one, else the first."""
    for number, episode in enumerate(islice(queue, LOOK_AHEAD)):
        if (episode.scene, episode.task) == about:
            del queue[number]
            return episode
    return queue.popleft()


class _Pool:
    """Hands episodes to worker processes, each of which has an environment and a policy of its own."""

    def __init__(self, policy: str, settings: RolloutSettings, count: int) -> None:
        self._policy, self._settings, self._count = policy, settings, count
        # Spawned ones share no threads, locks or graphics contexts with this process.
        self._context = multiprocessing.get_context("spawn")
        self._deaths: Counter[int] = Counter()

    def run(self, todo: Sequence[Episode], keep: Callable[[Result], None]) -> None:
        queue = deque(todo)
        workers = [self._start() for _ in range(self._count)]
        try:
            while queue or any(worker.episode for worker in workers):
                for worker in workers:
                    if worker.episode is None and queue:
                        self._give(worker, queue)
                ready = wait([worker.pipe for worker in workers if worker.episode], timeout=POLL_SECONDS)
                for number, worker in enumerate(workers):
                    if worker.episode is None:
                        continue
                    if worker.pipe in ready:
                        result = self._received(worker)
                        if result is None:
                            queue.appendleft(worker.episode)
                    else:
                        result = self._overdue(worker)
                        if result is None:
                            continue
                    if result is not None:
                        keep(result)
                    worker.episode = None
                    if not worker.process.is_alive():
                        worker.pipe.close()
                        workers[number] = self._start()
        finally:
            for worker in workers:
                self._end(worker)

    def _start(self) -> _Worker:
        here, there = self._context.Pipe()
        deadline = self._context.Value("d", 0.0, lock=False)
        process = self._context.Process(
            target=_work, args=(there, self._policy, self._settings, deadline), daemon=True, name="pat3d-evaluate"
        )
        with thread_limit(max(1, cores() // self._count)):
            process.start()
        there.close()
        return _Worker(process=process, pipe=here, deadline=deadline)

    def _give(self, worker: _Worker, queue: deque[Episode]) -> None:
        worker.episode = next_episode(queue, worker.about)
        worker.about = (worker.episode.scene, worker.episode.task)
        worker.begun = now()
        try:
            worker.pipe.send(worker.episode)
        except OSError:
            # It died while idle; `_received` sees the closed pipe.
            return

    def _received(self, worker: _Worker) -> Result | None:
        """What a worker says, or its death; None where its episode has to be done again."""
        try:
            kind, content = worker.pipe.recv()
        except (EOFError, OSError):
            worker.process.join(GRACE_SECONDS)
            return self._dead(worker, f"the process ended with exit code {worker.process.exitcode}")
        if kind == "missing":
            raise ModuleNotFoundError(f"No module named '{content}'", name=content)
        if kind == "broken":
            raise InfrastructureError(_no_score(worker.episode, content))
        if kind == "error":
            raise EvaluationError(f"episode {worker.episode.index if worker.episode else ''}: {content}")
        return content

    def _overdue(self, worker: _Worker) -> Result | None:
        """The end of a worker whose policy hangs; None while there is time."""
        limit = float(worker.deadline.value)
        if not limit or now() < limit + GRACE_SECONDS:
            return None
        self._end(worker)
        return self._dead(worker, f"hang: no answer within {self._settings.act_seconds:g} s, its process was ended")

    def _dead(self, worker: _Worker, reason: str) -> Result | None:
        """The result of a policy that took its process with it; None where the policy was not asked."""
        if worker.episode is None:
            raise InfrastructureError(_no_score(None, reason))
        if float(worker.deadline.value) == 0.0:
            self._deaths[worker.episode.index] += 1
            if self._deaths[worker.episode.index] >= DEATHS:
                raise InfrastructureError(_no_score(worker.episode, f"{reason}, {DEATHS} times, outside of the policy"))
            return None
        return Result(
            episode=worker.episode,
            outcome="policy_error",
            success=False,
            steps=0,
            reason=reason,
            wall_seconds=now() - worker.begun,
        )

    def _end(self, worker: _Worker) -> None:
        worker.pipe.close()
        if worker.process.is_alive():
            # A worker between episodes ends by itself once its pipe is closed.
            worker.process.join(0.0 if worker.episode else 2.0)
        if worker.process.is_alive():
            worker.process.kill()
        worker.process.join(GRACE_SECONDS)


def _work(pipe: Connection, policy: str, settings: RolloutSettings, deadline: Any) -> None:
    """What a worker process does."""
    runner, made = Runner(settings, deadline=deadline), functools.cache(make_policy)
    serve(pipe, lambda episode: runner.run(episode, made(policy)))


def _no_score(episode: Episode | None, reason: str) -> str:
    which = f"episode {episode.index}" if episode is not None else "a worker"
    return f"{which} could not be done: {reason}. This is no score; see pat3d doctor."
