"""A photograph, seen: its pixels, their depth and the objects they show, from files where there are, else by models.

What models find is kept by its inputs, so that a run that stopped goes on from there, and costs nothing twice.
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SpecError
from pat3d.progress import Event, Progress
from pat3d.scene.cache import cache_root, content_key
from pat3d.scene.replacement import replaced_file
from pat3d.vision.completing import completed
from pat3d.vision.dependencies import Judge
from pat3d.vision.depth import DepthModel, MeasuredDepth
from pat3d.vision.detection import Finder
from pat3d.vision.files import (
    WORKING_SIDE,
    Labels,
    instances_of,
    like,
    observed,
    read_depth,
    read_labels,
    read_masks,
    read_picture,
)
from pat3d.vision.finding import Masks, Sought, find_masks, sought_of
from pat3d.vision.intrinsics import read_camera, usual_camera
from pat3d.vision.labelling import Labeller
from pat3d.vision.listing import Lister
from pat3d.vision.observation import Observation
from pat3d.vision.painting import Painter

Arrays = Mapping[str, NDArray[Any]]


@dataclass(frozen=True, kw_only=True)
class Photograph:
    """A photograph and what is known of it, in files; None where models are to say it."""

    picture: Path | None = None
    """PNG or JPEG; None where it is to be painted."""
    masks: Path | None = None
    """PNG or .npy with the labels' values, or .npy of one mask an object."""
    depth: Path | None = None
    """.npy in metres, or 16-bit PNG in millimetres or as the camera's file says."""
    labels: Path | None = None
    """JSON or YAML, see `pat3d.vision.files.LABELS_SCHEMA`."""
    camera: Path | None = None
    """See `pat3d.vision.intrinsics`; None for what the photograph's own notes or the depth model say."""
    relative: bool = False
    """Whether the depth is right up to a factor, also where the labels do not say so."""

    def files(self) -> dict[str, dict[str, str]]:
        """Name and checksum of every file.

        Raises:
            SpecError: one cannot be read.
        """
        given = {name: path for name, path in vars(self).items() if isinstance(path, Path)}
        return {name: {"file": path.name, "sha256": _hash(path)} for name, path in given.items()}


@dataclass(frozen=True, kw_only=True)
class Lookers:
    """Models, a role each; None where there is none. They are made when they are needed, which takes a while."""

    painter: Callable[[], Painter] | None = None
    lister: Callable[[], Lister] | None = None
    finder: Callable[[], Finder] | None = None
    labeller: Callable[[], Labeller] | None = None
    depth: Callable[[], DepthModel] | None = None
    judge: Callable[[], Judge] | None = None
    completes: bool = False
    """Whether the painter paints away what hides objects, and the finder looks for them again."""


@dataclass(frozen=True, kw_only=True)
class Looked:
    """What is known of a photograph."""

    seen: Observation
    labels: Labels
    picture: NDArray[np.uint8]
    """RGB, as it was given or painted, shape (height, width, 3)."""
    notes: tuple[str, ...]
    record: dict[str, Any]
    """Who said what, and what it has cost; for the report."""


@dataclass
class _Looking:
    """One photograph being looked at."""

    photograph: Photograph
    lookers: Lookers
    prompt: str
    progress: Progress
    notes: list[str] = field(default_factory=list)
    record: dict[str, Any] = field(default_factory=dict)

    def picture(self) -> tuple[NDArray[np.uint8], float | None]:
        """RGB, and the angle across the longer side [deg] where something says it."""
        if self.photograph.picture is not None:
            return read_picture(self.photograph.picture)
        painter = _needed(self.lookers.painter, "there is no photograph: give one, or a model that paints it.")
        self.progress(Event(stage="painting the photograph"))
        picture = painter.paint(self.prompt)
        self.record["painted_by"] = dict(painter.record())
        return picture, None

    def masks(self, picture: NDArray[np.uint8], given: Labels | None) -> tuple[NDArray[np.int32], Labels | None]:
        """Values of the pixels, and the labels with the values of what was found of them."""
        if self.photograph.masks is not None:
            return read_masks(self.photograph.masks), given
        make = self.lookers.finder
        if make is None:
            raise SpecError("nothing says which pixels show which object: give masks, or models that find them.")
        small = _thumbnail(picture)
        sought = self._sought(small, given)
        finder = make()

        def found() -> tuple[Arrays, dict[str, Any]]:
            masks = find_masks(small, sought, finder, progress=self.progress)
            told = {"phrases": masks.phrases, "scores": masks.scores, "notes": masks.notes}
            return {"values": masks.values}, told

        key = {"found": [asdict(one) for one in sought], "by": finder.name, "version": 1}
        arrays, told = self._kept("found_by", finder.name, {"picture": small}, key, found)
        masks = Masks(
            values=arrays["values"],
            phrases=tuple(told["phrases"]),
            scores=tuple(told["scores"]),
            notes=tuple(told["notes"]),
        )
        self.notes += masks.notes
        self.record["found"] = [
            {"phrase": phrase, "score": round(score, 3)}
            for phrase, score in zip(masks.phrases, masks.scores, strict=True)
        ]
        return masks.values, None if given is None else _matched(given, masks)

    def depth(self, picture: NDArray[np.uint8]) -> tuple[NDArray[np.float32], float | None]:
        """Depth [m], shape (height, width), and the angle that its model says."""
        if self.photograph.depth is not None:
            return read_depth(self.photograph.depth, self.photograph.camera), None
        make = self.lookers.depth
        model = _needed(make, "nothing says how far away things are: give depth, or a model that measures it.")
        self.progress(Event(stage="measuring depth", detail=model.name))

        def measured() -> tuple[Arrays, dict[str, Any]]:
            one = model.measure(picture)
            return {"depth": one.depth}, {"angle": one.angle}

        arrays, told = self._kept("measured_by", model.name, {"picture": picture}, {"depth": model.name}, measured)
        found = MeasuredDepth(depth=arrays["depth"], angle=told["angle"])
        self.notes.append(f"{model.name} has measured the depth")
        return found.depth, found.angle

    def labels(self, picture: NDArray[np.uint8], values: NDArray[np.int32]) -> Labels:
        """What a model says that the masks show."""
        labeller = _needed(
            self.lookers.labeller, "nothing says what the masks show: give labels, or a model that looks at them."
        )
        self.progress(Event(stage="asking what the masks show"))
        labels = labeller.labels(like(picture, values), values)
        self.record["labelled_by"] = dict(labeller.record())
        return labels

    def completed(self, seen: Observation) -> Observation:
        """`seen` with the whole masks of what is hidden in part."""
        painter = _needed(self.lookers.painter, "nothing paints what is hidden: a model has to be named for that.")
        finder = _needed(self.lookers.finder, "nothing finds what was painted: a model has to be named for that.")
        whole, notes = completed(seen, painter, finder, progress=self.progress)
        self.notes += notes
        self.record["completed"] = sorted(whole.whole)
        self.record["painted_by"] = dict(painter.record())
        return whole

    def _sought(self, picture: NDArray[np.uint8], given: Labels | None) -> tuple[Sought, ...]:
        if given is not None:
            return sought_of([one.name for one in given.objects])
        lister = _needed(
            self.lookers.lister, "nothing says what to look for: give labels, or a model that lists what it sees."
        )
        self.progress(Event(stage="asking what is in the picture"))
        return lister.kinds(picture, self.prompt)

    def _kept(
        self,
        role: str,
        name: str,
        shown: Arrays,
        said: Mapping[str, Any],
        make: Callable[[], tuple[Arrays, dict[str, Any]]],
    ) -> tuple[Arrays, dict[str, Any]]:
        """What `make` makes, or what an earlier run made of the same."""
        path = cache_root() / "looked" / f"{content_key(shown, {**said, 'weights': _weights(name)})}.npz"
        kept = _read_record(path)
        if kept is not None:
            self.record[role] = {"model": name, "kept": True}
            return kept
        begin = time.monotonic()
        arrays, told = make()
        self.record[role] = {"model": name, "seconds": round(time.monotonic() - begin, 1)}
        # A cache that cannot be written costs the next run its time, and this one nothing.
        with suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            written: dict[str, Any] = {**arrays, "told": np.array(json.dumps(told))}
            with replaced_file(path) as fresh, fresh.open("wb") as file:
                np.savez_compressed(file, **written)
        return arrays, told


def look(photograph: Photograph, lookers: Lookers, *, prompt: str, progress: Progress) -> Looked:
    """See a photograph.

    Args:
        photograph: what files say of it.
        lookers: models for what they do not say.
        prompt: what it shows, in words; may be empty where there is a picture.
        progress: told what is going on.

    Raises:
        SpecError: a file cannot be used, or neither a file nor a model says something that is needed.
        ModelError: a model gives no valid answer.
    """
    looking = _Looking(photograph, lookers, prompt, progress)
    picture, angle = looking.picture()
    given = None if photograph.labels is None else read_labels(photograph.labels)
    values, labels = looking.masks(picture, given)
    depth, measured = looking.depth(picture)
    if labels is None:
        labels = looking.labels(picture, values)
    if photograph.relative:
        labels = replace(labels, metric=False)
        if all(one.size is None for one in labels.objects):
            raise SpecError("depth that is right up to a factor needs the size of at least one object in the labels.")
    instances = instances_of(values, labels)
    height, width = depth.shape
    if photograph.camera is not None:
        camera = read_camera(photograph.camera, width, height)
    else:
        camera, note = usual_camera(width, height, angle or measured)
        looking.notes.append(note)
    seen = observed(picture=picture, depth=depth, instances=instances, labels=labels, camera=camera)
    if lookers.completes:
        seen = looking.completed(seen)
    return Looked(
        seen=seen,
        labels=labels,
        picture=picture,
        notes=tuple(looking.notes),
        record=looking.record,
    )


def _matched(labels: Labels, masks: Masks) -> Labels:
    """Those of `labels` that were found, with their values; of several alike, the first is the leftmost."""
    left = list(enumerate(masks.phrases, start=1))
    kept = []
    for one in labels.objects:
        phrase = sought_of([one.name])[0].phrase
        number = next((number for number, found in left if found == phrase), None)
        if number is not None:
            left.remove((number, phrase))
            kept.append(replace(one, value=number))
    least = labels.least_occluded if any(one.name == labels.least_occluded for one in kept) else None
    return replace(labels, objects=tuple(kept), least_occluded=least)


def _thumbnail(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """`picture`, at most as large as what is measured of it."""
    from PIL import Image

    image = Image.fromarray(picture)
    longest = max(image.size)
    if longest <= WORKING_SIDE:
        return picture
    size = tuple(max(1, round(side * WORKING_SIDE / longest)) for side in image.size)
    return np.array(image.resize((size[0], size[1]), Image.Resampling.LANCZOS))


def _needed(make: Callable[[], Any] | None, otherwise: str) -> Any:
    if make is None:
        raise SpecError(otherwise)
    return make()


def _read_record(path: Path) -> tuple[Arrays, dict[str, Any]] | None:
    """What `_Looking._kept` has written at `path`; None where there is nothing, or it is damaged."""
    try:
        with np.load(path, allow_pickle=False) as data:
            return {key: data[key] for key in data.files if key != "told"}, json.loads(str(data["told"]))
    except Exception:
        # A damaged archive raises whatever its damage happens to hit (zip, zlib, header, missing key).
        return None


def _weights(name: str) -> list[tuple[str, int, int]]:
    """Size and time of the weights of models in folders; those of the hub have one meaning a name."""
    found = [path for part in name.split(" and ") for path in sorted(Path(part).glob("*.safetensors"))]
    return [(path.name, path.stat().st_size, path.stat().st_mtime_ns) for path in found]


def _hash(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise SpecError(f"{path}: cannot be read ({error.strerror or error}).") from error
