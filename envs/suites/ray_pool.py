"""Workers on a Ray cluster.

Its machines need pat3d with the same versions of everything that decides a scene, but no common disk: a worker makes
its unit in a folder of its own and answers with the files, and only the run itself writes to the suite.
"""

from __future__ import annotations

import os
import shutil
import socket
import tempfile
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from pat3d.envs.suites.folder import SuiteFolder, scene_name
from pat3d.envs.suites.local_pool import python_path
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.threads import ONE_THREAD
from pat3d.envs.suites.worker_pool import Unit, WorkerPool
from pat3d.errors import ExportError, Pat3dError, SuiteError
from pat3d.scene.versions import versions

MAX_UNIT_BYTES = 2**30
"""Of a unit's files together."""

_KNOCK_SECONDS = 10.0
"""In which a cluster's head accepts a connection [s]."""


class Cluster:
    """A Ray cluster that this process is connected to while the block lasts."""

    def __init__(self, address: str) -> None:
        self._address, self._own = address, False

    def __enter__(self) -> Cluster:
        try:
            import ray
        except ImportError as error:
            raise SuiteError("--ray needs Ray: pip install 'pat3d[ray]'.") from error
        self.ray = ray
        if self.ray.is_initialized():
            return self
        try:
            _knock(self._address)
            self.ray.init(address=self._address, log_to_driver=False, configure_logging=False)
        except (OSError, ValueError, RuntimeError) as error:
            reason = (str(error).strip() or type(error).__name__).splitlines()[0]
            raise SuiteError(
                f'no Ray cluster answers at "{self._address}" ({reason}). Give HOST:PORT of its head, '
                'ray://HOST:PORT, or "auto" on one of its machines.'
            ) from error
        self._own = True
        return self

    def __exit__(self, *exception: object) -> None:
        if self._own:
            self.ray.shutdown()

    @property
    def cores(self) -> int:
        """Of all its machines."""
        return int(self.ray.cluster_resources().get("CPU", 0))


def _knock(address: str) -> None:
    """Raise OSError or ValueError at once where nobody listens; Ray itself would try for minutes."""
    if address == "auto":
        return
    host, colon, port = address.removeprefix("ray://").rpartition(":")
    if not colon or not port.isdecimal() or int(port) > 65535:
        raise ValueError("no HOST:PORT")
    socket.create_connection((host, int(port)), timeout=_KNOCK_SECONDS).close()


class RayPool(WorkerPool):
    """A Ray actor with one core for every worker."""

    def __init__(self, folder: SuiteFolder, request: Request, cluster: Cluster) -> None:
        super().__init__()
        self._folder, self._request, self._ray = folder, request, cluster.ray
        environment = {**ONE_THREAD, "PYTHONPATH": python_path()}
        self._worker = self._ray.remote(Worker).options(
            num_cpus=1, max_restarts=0, scheduling_strategy="SPREAD", runtime_env={"env_vars": environment}
        )
        self._actors: dict[int, Any] = {}
        self._asked: dict[Any, int] = {}
        """Who is to give which answer."""

    def _start(self, number: int) -> None:
        self._actors[number] = self._worker.remote(self._request.as_dict())
        self._asked[self._actors[number].prepare.remote(versions())] = number

    def _assign(self, number: int, units: Sequence[Unit]) -> None:
        # Blocks are for GPUs, on which clusters do not work.
        (unit,) = units
        self._asked[self._actors[number].make.remote(*unit)] = number

    def _next(self, seconds: float) -> tuple[int, dict[str, Any], str] | None:
        errors = self._ray.exceptions
        try:
            done, _ = self._ray.wait(list(self._asked), num_returns=1, timeout=seconds)
            if not done:
                return None
            number = self._asked.pop(done[0])
            try:
                said, files = self._ray.get(done[0])
            except errors.RayActorError as error:
                # It may only be out of sight; nobody waits for it any more.
                self._ray.kill(self._actors.pop(number))
                return number, {}, f"ended ({' '.join(str(error).split())[:500]})"
        except (OSError, errors.RayError) as error:
            raise SuiteError(
                f"the Ray cluster was lost: {' '.join(str(error).split())[:500]} What is finished is kept; run the "
                "same command again."
            ) from error
        if files:
            try:
                self._arrived(said["place"], files)
            except OSError as error:
                return number, {"fatal": f"{type(error).__name__}: {error}"}, ""
        return number, said, ""

    def _kill(self, number: int) -> None:
        self._ray.kill(self._actors[number])

    def _close(self) -> None:
        for actor in self._actors.values():
            self._ray.kill(actor)

    def _arrived(self, place: int, files: dict[str, bytes]) -> None:
        """Put the files of a unit where they belong: a scene appears by renaming, when all of it is there."""
        fresh = self._folder.work / f"arrived-{scene_name(place)}"
        shutil.rmtree(fresh, ignore_errors=True)
        for name, content in files.items():
            relative = PurePosixPath(name)
            if relative.is_absolute() or ".." in relative.parts:
                raise OSError(f'a worker sent a file named "{name}"')
            (fresh / relative).parent.mkdir(parents=True, exist_ok=True)
            (fresh / relative).write_bytes(content)
        for one in [*fresh.glob("scenes/*"), *fresh.glob("rejected/*")]:
            target = self._folder.path / one.relative_to(fresh)
            target.parent.mkdir(parents=True, exist_ok=True)
            if not target.exists():
                os.replace(one, target)
        shutil.rmtree(fresh, ignore_errors=True)


class Worker:
    """What runs on the cluster."""

    def __init__(self, request: dict[str, Any]) -> None:
        self._request = Request.from_dict(request, "worker")

    def prepare(self, wanted: dict[str, str | None]) -> tuple[dict[str, Any], dict[str, bytes]]:
        """Do what is slow the first time, and refuse versions other than the run's."""
        from pat3d.envs.suites.worker import prepare_for

        differ = [
            f"{name} {versions().get(name)} (here {value})"
            for name, value in wanted.items()
            if versions().get(name) != value
        ]
        if differ:
            return {"fatal": f"{os.uname().nodename} has {', '.join(differ)}; install the same versions there."}, {}
        try:
            prepare_for(self._request)
        except (OSError, MemoryError, Pat3dError) as error:
            return {"fatal": f"{type(error).__name__}: {error}"}, {}
        return {"ready": True}, {}

    def make(self, place: int, candidate: int) -> tuple[dict[str, Any], dict[str, bytes]]:
        """Make a unit; how it went, and its files by their names relative to the suite's folder."""
        from pat3d.envs.suites.unit import make_unit

        with tempfile.TemporaryDirectory(prefix="pat3d-") as scratch:
            try:
                said = make_unit(SuiteFolder(scratch), self._request, place, candidate)
                return said, _files(Path(scratch).resolve())
            except (OSError, MemoryError, Pat3dError) as error:
                return {"fatal": f"{os.uname().nodename}: {type(error).__name__}: {error}"}, {}


def _files(folder: Path) -> dict[str, bytes]:
    paths = sorted(path for part in ("scenes", "rejected") for path in (folder / part).rglob("*") if path.is_file())
    if sum(path.stat().st_size for path in paths) > MAX_UNIT_BYTES:
        raise ExportError(f"a scene of more than {MAX_UNIT_BYTES} bytes is not sent.")
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
