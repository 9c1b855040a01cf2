"""Makes a suite: hands units to workers until every place has its scene, then writes what is said about all of them."""

from __future__ import annotations

import json
import math
import time
from collections import deque
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass
from typing import Any

from pat3d.envs.suites.folder import LOG, MANIFEST, SuiteFolder, read_document, write_document
from pat3d.envs.suites.manifest import begin_manifest, finish_manifest
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.worker_pool import Answer, Unit, WorkerPool, worker_count
from pat3d.errors import SuiteError

CANDIDATES = 60
"""Tried for a place before the run gives up."""

DEATHS = 2
"""Of workers over the same unit before it is rejected."""

BLOCK = 64
"""Units that a worker settles together on a GPU, at most."""

LIMIT = 300.0
"""For a unit, unless another limit is given [s]; most take one or two."""

FAILED_STARTS = 3
"""Workers that may end before they are ready."""

_TICK = 0.5
"""Between two looks at the clock [s]."""


@dataclass(frozen=True, kw_only=True)
class Status:
    """How far a run is."""

    done: int
    total: int
    rejected: int
    """Candidates rejected, in earlier runs too."""
    made: int
    """Scenes made by this run."""
    seconds: float
    """Since the first worker of this run was ready [s]; 0 before."""
    workers: int
    note: str = ""

    @property
    def per_hour(self) -> float:
        """Scenes an hour in this run."""
        return 3600.0 * self.made / self.seconds if self.seconds > 0.0 else 0.0

    @property
    def left(self) -> float | None:
        """Time to go [s]; None where it cannot be told yet."""
        return None if not self.made else (self.total - self.done) * self.seconds / self.made


Watcher = Callable[[Status], None]


def generate(
    path: str,
    request: Request,
    *,
    workers: int | str = "auto",
    limit: float = LIMIT,
    ray: str | None = None,
    block: int | None = None,
    tell: Watcher = lambda status: None,
) -> Status:
    """Make the suite `request` in the folder `path`, or what is missing of it.

    Settled on a CPU, the same request gives the same suite bit for bit. On a GPU, scenes of a block settle side by
    side, sums are added in the order of its threads, and poses agree with those of another run to about 1e-9 m.

    Args:
        path: of the suite's folder.
        request: what to make.
        workers: how many; "auto" for one a core, of this machine or of the cluster.
        limit: for one unit [s]; a worker that takes longer is ended, and a unit that did so twice is rejected.
        block: units that a worker settles together; None for 64 on a GPU and one on a CPU.
        ray: address of the Ray cluster whose machines work; None for processes of this one.
        tell: told how far the run is.

    Returns:
        How it ended.

    Raises:
        SuiteError: the folder is in use, holds another suite, a place finds no scene, or there is no such cluster.
        ExportError: it cannot be written.
        EnvironmentSetupError: there is no such robot, or robosuite is not installed.
        SpecError: there is no GPU here, where the request asks for one.
    """
    from pat3d.envs.robots.arms import require_robot
    from pat3d.sim.compilation import device_name

    require_robot(request.robot)
    device_name(request.device)
    if block is not None and block < 1:
        raise SuiteError(f"a block has at least one unit, not {block}.")
    block = block or (1 if request.device == "cpu" else BLOCK)
    if ray is not None and (request.device != "cpu" or block > 1):
        raise SuiteError("a Ray cluster settles scenes on its CPUs, one by one; leave out --ray or --device.")
    if not limit > 0.0:
        raise SuiteError(f"the time limit for a scene must be positive, got {limit:g} s.")
    folder = SuiteFolder(path)
    folder.check_usable()
    with folder.locked():
        folder.clear_work()
        if (folder.path / MANIFEST).exists():
            _check_same(folder, request)
        run = _Run(folder, request, limit, tell, block)
        if run.pending:
            with _connected(ray) as cluster:
                count = worker_count(str(workers), None if cluster is None else max(cluster.cores, 1))
                begin_manifest(folder, request)
                run.work(_pool(folder, request, cluster), count)
        finish_manifest(folder, request)
        folder.clear_work()
    return run.status("")


def _connected(address: str | None) -> Any:
    """The cluster at `address` for as long as a block lasts; None for no address."""
    if address is None:
        return nullcontext()
    from pat3d.envs.suites.ray_pool import Cluster

    return Cluster(address)


def _pool(folder: SuiteFolder, request: Request, cluster: Any) -> WorkerPool:
    if cluster is None:
        from pat3d.envs.suites.local_pool import LocalPool

        return LocalPool(folder, request)
    from pat3d.envs.suites.ray_pool import RayPool

    return RayPool(folder, request, cluster)


def _check_same(folder: SuiteFolder, request: Request) -> None:
    """Raise SuiteError unless the suite in `folder` is of the same request, or a shorter one."""
    where = str(folder.path / MANIFEST)
    document = read_document(folder.path / MANIFEST)
    earlier = Request.from_dict(document.get("request"), where)
    asked, held = {**request.as_dict(), "scenes": earlier.scenes}, earlier.as_dict()
    differ = [name for name in dict.fromkeys((*held, *asked)) if held.get(name) != asked.get(name)]
    if differ:
        said = ", ".join(f"{name} {json.dumps(held[name])}" if name in held else f"no {name}" for name in differ)
        raise SuiteError(f"{folder.path} holds a suite with {said}; ask for the same, or give a new folder.")
    if request.scenes < earlier.scenes:
        raise SuiteError(
            f"{folder.path} holds a suite of {earlier.scenes} scenes; it can be made longer, not shorter. "
            "Give a new folder."
        )
    from pat3d.scene.versions import versions

    found = document.get("versions")
    made_with = found if isinstance(found, dict) else {}
    changed = sorted(name for name, value in versions().items() if made_with.get(name) != value)
    if changed:
        said = ", ".join(f"{name} {made_with.get(name)} (here {versions()[name]})" for name in changed)
        raise SuiteError(f"{folder.path} was begun with {said}; go on with the same versions, or give a new folder.")


class _Run:
    """The queue of one run and the workers at it."""

    def __init__(self, folder: SuiteFolder, request: Request, limit: float, tell: Watcher, block: int) -> None:
        self.folder, self.request, self.limit, self.tell, self.block = folder, request, limit, tell, block
        done, rejected = folder.done(), folder.rejected()
        self.pending: deque[Unit] = deque(
            (place, rejected.get(place, 0)) for place in range(request.scenes) if place not in done
        )
        self.done = request.scenes - len(self.pending)
        self.rejected, self.made = sum(rejected.values()), 0
        self._deaths: dict[Unit, int] = {}
        self._alone: set[Unit] = set()
        """Units of blocks over which a worker died: one of them is the reason."""
        self._failed_starts = 0
        self._began: float | None = None
        self._pool: WorkerPool | None = None

    def status(self, note: str) -> Status:
        """How far the run is."""
        seconds = 0.0 if self._began is None else time.perf_counter() - self._began
        return Status(
            done=self.done,
            total=self.request.scenes,
            rejected=self.rejected,
            made=self.made,
            seconds=seconds,
            workers=self._pool.size if self._pool is not None else 0,
            note=note,
        )

    def work(self, pool: WorkerPool, workers: int) -> None:
        """Until nothing is pending."""
        self._check_candidates()
        self._pool = pool
        with pool.closed_at_end():
            # The first one compiles the simulator's kernels where that is needed; the others find them compiled.
            pool.spawn()
            self.tell(self.status("preparing the simulator"))
            while self.pending or pool.busy():
                for worker in pool.idle():
                    if self.pending:
                        pool.assign(worker, self._next_block(workers))
                answer = pool.answer(_TICK)
                if answer is not None:
                    self._take(pool, answer, workers)
                pool.stop_those_over(self.limit)
                self.tell(self.status("" if self._began is not None else "preparing the simulator"))

    def _next_block(self, workers: int) -> list[Unit]:
        """What a worker gets next off the queue: its share, as long as that is no more than a block."""
        units = [self.pending.popleft()]
        most = min(self.block, math.ceil((len(self.pending) + 1) / workers))
        while len(units) < most and self.pending and self._alone.isdisjoint((units[0], self.pending[0])):
            units.append(self.pending.popleft())
        return units

    def _take(self, pool: WorkerPool, answer: Answer, workers: int) -> None:
        if answer.ended:
            self._ended(pool, answer)
        elif "fatal" in answer.said:
            raise SuiteError(
                f"a worker had to stop: {answer.said['fatal']} What is finished is kept; run the same command again."
            )
        elif "ready" in answer.said:
            self._failed_starts = 0
            if self._began is None:
                self._began = time.perf_counter()
                for _ in range(min(workers, len(self.pending)) - 1):
                    pool.spawn()
        elif "place" in answer.said:
            self._log(answer.said)
            if answer.said["reason"]:
                self._again(answer.said["place"], answer.said["candidate"])
            else:
                self.done += 1
                self.made += 1

    def _ended(self, pool: WorkerPool, answer: Answer) -> None:
        """A worker is gone; what it did is done by another, unless that has killed one before."""
        if not answer.units:
            self._failed_starts += 1
            if self._failed_starts >= FAILED_STARTS:
                raise SuiteError(f"workers end before they are ready: the last one {answer.ended}. {answer.last_words}")
        # In reverse, as each goes first in the queue.
        for unit in reversed(answer.units):
            self._left_behind(unit, answer)
        if self.pending:
            pool.spawn()

    def _left_behind(self, unit: Unit, answer: Answer) -> None:
        """Decide about a unit of a worker that is gone."""
        place, candidate = unit
        if place in self.folder.done():
            # It had just put the scene in its place.
            self.done += 1
            self.made += 1
        elif self.folder.rejection(place, candidate).exists():
            self._again(place, candidate)
        elif len(answer.units) > 1:
            # Which of them it died over shows when each is made alone.
            self._alone.add(unit)
            self.pending.appendleft(unit)
        elif self._deaths.setdefault(unit, 0) + 1 < DEATHS:
            self._deaths[unit] += 1
            self.pending.appendleft(unit)
        else:
            message = f"{DEATHS} workers died over it; the last one {answer.ended}. {answer.last_words}"
            document = {
                "place": place,
                "candidate": candidate,
                "split": self.request.split_of(place),
                "kind": self.request.task_of(place),
                "reason": "time limit" if answer.late else "worker",
                "message": message.strip(),
            }
            write_document(self.folder.rejection(place, candidate), document)
            self._again(place, candidate)

    def _again(self, place: int, candidate: int) -> None:
        """Put the next candidate for a place first in the queue."""
        self.rejected += 1
        self.pending.appendleft((place, candidate + 1))
        self._check_candidates()

    def _check_candidates(self) -> None:
        for place, candidate in self.pending:
            if candidate >= CANDIDATES:
                last = read_document(self.folder.rejection(place, candidate - 1))
                raise SuiteError(
                    f"none of {candidate} candidates for scene {place} ({self.request.task_of(place)}, "
                    f"{self.request.split_of(place)}) became one; the last: {last.get('message')}"
                )

    def _log(self, said: dict[str, Any]) -> None:
        with (self.folder.path / LOG).open("a", encoding="utf-8") as file:
            file.write(json.dumps(said) + "\n")
