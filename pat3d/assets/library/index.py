"""Libraries: folders of other people's objects, indexed once, object by object, in parallel; found by name."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from pat3d.assets.library.discover import Found, discover, files_below
from pat3d.assets.library.indexing import called, hashes, index_object
from pat3d.assets.library.metadata import Metadata, metadata_of
from pat3d.assets.library.overrides import read_overrides, settings_for
from pat3d.assets.library.store import (
    VERSION,
    Entry,
    library_folder,
    load_asset,
    read_entry,
    write_entry,
)
from pat3d.errors import AssetError
from pat3d.progress import Event, Progress, silent
from pat3d.scene.asset import Asset
from pat3d.scene.cache import data_root
from pat3d.scene.folder import read_json, write_json
from pat3d.scene.naming import unique_slugs

CPU_LIMIT = 300.0
"""Processor time that one object may take [s]."""


@dataclass(frozen=True, kw_only=True)
class Library:
    """What is indexed of one folder."""

    name: str
    folder: Path
    """The index."""
    source: Path
    """The folder that was indexed."""
    entries: tuple[Entry, ...]
    """Sorted by key."""

    @property
    def ready(self) -> tuple[Entry, ...]:
        """What scenes can be made from."""
        return tuple(entry for entry in self.entries if entry.state == "ready")

    def asset(self, key: str) -> Asset:
        """The asset of object `key`.

        Raises:
            AssetError: there is none, or it is damaged.
        """
        return load_asset(self.folder / "objects" / f"{key}.npz")


def library_names() -> tuple[str, ...]:
    """Every library that is there."""
    root = data_root() / "libraries"
    if not root.is_dir():
        return ()
    return tuple(sorted(one.name for one in root.iterdir() if (one / "library.json").is_file()))


def open_library(name: str) -> Library:
    """The library called `name`, with what is indexed of it so far.

    Raises:
        AssetError: there is none.
    """
    folder = library_folder(name)
    head = read_json(folder / "library.json")
    if "source" not in head:
        known = ", ".join(library_names()) or "none yet; pat3d library add FOLDER --name NAME"
        raise AssetError(f'there is no library "{name}". Known: {known}.')
    entries = [entry for path in sorted((folder / "objects").glob("*.json")) if (entry := read_entry(path))]
    return Library(name=name, folder=folder, source=Path(head["source"]), entries=tuple(entries))


def add_library(
    source: str | os.PathLike[str],
    name: str,
    *,
    licence: str = "",
    workers: int | None = None,
    cpu_limit: float = CPU_LIMIT,
    progress: Progress = silent,
) -> Library:
    """Index the objects below folder `source`; what an earlier run finished and nobody changed stays.

    Nothing is written outside the index. Objects are ready as they are finished, so that a run that is interrupted goes
    on where it was.

    Args:
        source: folder of the objects.
        name: of the library.
        licence: of all objects whose own files name none.
        workers: processes; None for one a core.
        cpu_limit: processor time that one object may take [s].
        progress: told after every object.

    Raises:
        AssetError: `source` is no folder or holds no object, `name` is no name or that of another folder's library.
        SpecError: library.yaml is invalid.
    """
    root, folder = Path(source).expanduser().resolve(), library_folder(name)
    head = read_json(folder / "library.json")
    if head.get("source", str(root)) != str(root):
        raise AssetError(
            f'library "{name}" is of {head["source"]}; choose another name, or pat3d library remove {name} first.'
        )
    licence = licence or str(head.get("licence", ""))
    progress(Event(stage="looking for objects", detail=str(root)))
    found = discover(root, name)
    if not found:
        raise AssetError(
            f"{root} holds no object: OBJ, STL, PLY, OFF, GLB, glTF, DAE, FBX, 3MF, USD, URDF, SDF or MJCF files. "
            "Nothing was written."
        )
    overrides = read_overrides(folder, root)
    objects = folder / "objects"
    objects.mkdir(parents=True, exist_ok=True)
    write_json(folder / "library.json", {"version": VERSION, "source": str(root), "licence": licence})
    said = metadata_of([one.path for one in found], files_below(root), root)
    keys = dict(zip(unique_slugs(_told_apart(found, said, root)).values(), found, strict=True))
    for path in objects.iterdir():
        if path.name.split(".")[0] not in keys:
            path.unlink()
    jobs: dict[str, dict[str, Any]] = {}
    for key, one in keys.items():
        settings, metadata = settings_for(overrides, key), said[one.path]
        if not _fresh(objects / key, one, root, settings, metadata):
            jobs[key] = {
                "found": one, "key": key, "root": root, "library": name, "settings": settings, "licence": licence,
                "metadata": metadata,
                "cache_dir": folder / "cache", "cpu_limit": cpu_limit,
            }  # fmt: skip
    done = len(keys) - len(jobs)
    if done:
        progress(Event(stage="indexing", detail=f"{done} of {len(keys)} are indexed already"))
    for entry in _run(jobs, folder, workers or len(os.sched_getaffinity(0))):
        done += 1
        detail = entry.key if entry.state == "ready" else f"{entry.key} {entry.state}: {entry.reason}"
        progress(Event(stage="indexing", detail=detail, step=done - 1, steps=len(keys)))
    return open_library(name)


def remove_library(name: str) -> Path:
    """Remove the index of library `name`, never its objects; returns the folder that they are in.

    Raises:
        AssetError: there is none.
    """
    library = open_library(name)
    shutil.rmtree(library.folder)
    return library.source


def _told_apart(found: Sequence[Found], said: Mapping[Path, Metadata], root: Path) -> list[str]:
    """A text for every object, all different, whose slug is its key: its name, longer where others have it too."""
    named: dict[str, int] = {}
    texts = []
    for one in found:
        text = " ".join(called(one, said[one.path]))
        named[text] = named.get(text, 0) + 1
        # Names that only differ by what is no letter would be one slug; the path tells them apart in the end.
        texts.append(text if named[text] == 1 else f"{text} {named[text]}")
    if len(set(texts)) < len(texts):
        texts = [str(one.path.relative_to(root)) for one in found]
    return texts


def _fresh(stem: Path, found: Found, root: Path, settings: Mapping[str, Any], metadata: Metadata) -> bool:
    """Whether the index has this object as its files and settings are now."""
    entry = read_entry(stem.with_suffix(".json"))
    if entry is None or entry.path != str(found.path.relative_to(root)):
        return False
    if dict(entry.settings) != dict(settings) or entry.metadata != metadata.digest:
        return False
    if entry.state == "ready" and not stem.with_suffix(".npz").is_file():
        return False
    return hashes([root / name for name in entry.files], root) == entry.files


def _run(jobs: Mapping[str, dict[str, Any]], folder: Path, workers: int) -> Iterator[Entry]:
    """Do `jobs`, in processes where there are several; entries as they are written."""
    if workers == 1 or len(jobs) <= 1:
        for job in jobs.values():
            yield _index(folder, job)
        return
    left, died = dict(jobs), False
    while left:
        # After a process has died nobody knows of which object, so the rest goes one at a time.
        some = dict([next(iter(left.items()))]) if died else left
        for key, entry in _pooled(some, folder, 1 if died else min(workers, len(some))):
            if entry is None and not died:
                died = True
                break
            left.pop(key)
            if entry is None:
                job = jobs[key]
                found: Found = job["found"]
                entry = Entry(
                    key=key, name=" ".join(found.words), path=str(found.path.relative_to(job["root"])),
                    kind=found.kind, state="refused", settings=dict(job["settings"]), metadata=job["metadata"].digest,
                    reason="the process that read it died; the mesh breaks a program that reads or cuts it",
                    files=hashes([found.path], job["root"]),
                )  # fmt: skip
                write_entry(folder, entry, None)
            yield entry


def _pooled(jobs: Mapping[str, dict[str, Any]], folder: Path, workers: int) -> Iterator[tuple[str, Entry | None]]:
    """Key and entry of every job; None for the entry where a process died, after which nothing follows."""
    # Forked processes inherit locks of threads that BLAS and Warp have; spawned ones begin afresh.
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=_one_thread) as pool:
        waiting: dict[Future[Entry], str] = {pool.submit(_index, folder, job): key for key, job in jobs.items()}
        try:
            for future in as_completed(waiting):
                try:
                    yield waiting[future], future.result()
                except BrokenProcessPool:
                    yield waiting[future], None
                    return
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def _one_thread() -> None:
    """One thread a process: there is one process a core already."""
    from threadpoolctl import threadpool_limits

    os.environ["OMP_NUM_THREADS"] = "1"
    threadpool_limits(1)


def _index(folder: Path, job: dict[str, Any]) -> Entry:
    entry, asset = index_object(**job)
    write_entry(folder, entry, asset)
    return entry
