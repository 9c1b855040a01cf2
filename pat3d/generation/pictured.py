"""From a photograph to a verified scene: what it shows is measured, and made like any other scene.

picture, depth, masks, labels -> assets -> fits -> poses apart -> settling -> verification -> files
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from pat3d.assets import sources
from pat3d.assets.variant import Variant
from pat3d.errors import AssetError, PromptError, SpecError
from pat3d.generation.from_image import request_of_recovered
from pat3d.generation.pipeline import Outcome, make
from pat3d.generation.request import derived_seed
from pat3d.generation.settings import Settings
from pat3d.progress import Clock, CpuBudget, Event, Progress, silent
from pat3d.scene.asset import Asset
from pat3d.scene.folder import check_target
from pat3d.vision.depth import DepthModel
from pat3d.vision.files import (
    Label,
    Labels,
    instances_of,
    like,
    observed,
    read_camera,
    read_depth,
    read_labels,
    read_masks,
    read_picture,
    usual_camera,
)
from pat3d.vision.labelling import Labeller
from pat3d.vision.observation import Observation
from pat3d.vision.recover import recover

PICTURE = "picture.png"
"""In the scene's folder: what the photograph became, side by side."""


@dataclass(frozen=True, kw_only=True)
class Photograph:
    """A photograph and what is known of it, in files."""

    picture: Path
    """PNG or JPEG."""
    masks: Path
    """PNG or .npy with the labels' values, or .npy of one mask an object."""
    depth: Path | None = None
    """.npy in metres, or 16-bit PNG in millimetres; None where a model is to measure it."""
    labels: Path | None = None
    """JSON or YAML, see `pat3d.vision.files.LABELS_SCHEMA`; None where a model is to say what the masks show."""
    camera: Path | None = None
    """JSON or YAML, see `pat3d.vision.files.CAMERA_SCHEMA`; None for what the photograph's own notes say."""


def generate_from_image(
    photograph: Photograph,
    *,
    out: str | os.PathLike[str],
    prompt: str = "",
    settings: Settings | None = None,
    labeller: Labeller | None = None,
    depth_model: DepthModel | None = None,
    progress: Progress = silent,
) -> Outcome:
    """Make the scene that a photograph shows, verify it and write its folder.

    Args:
        photograph: with depth, masks and labels.
        out: folder to write; an earlier scene folder there is replaced once the new one is complete.
        prompt: what the scene is called.
        settings: how to make it.
        labeller: says what the masks show, where no file does.
        depth_model: measures the picture, where no file does.
        progress: told what is going on.

    Raises:
        SpecError: a file cannot be used, or nothing says what the masks show.
        ModelError: the labeller gives no valid answer.
        PromptError: no asset is known for a label.
        LayoutError: the picture does not tell what is level, or an object finds no room.
        SimulationError: the layout cannot be simulated.
        CpuLimitError: the settings' limit is spent.
        ExportError: `out` cannot be written.
    """
    own = settings or Settings()
    folder, clock, budget = check_target(out), Clock(), CpuBudget(own.cpu_limit)
    watched = budget.watching(progress)
    with clock("picture"):
        watched(Event(stage="reading the picture"))
        seen, labels, notes = _read(photograph, labeller, depth_model, watched)
    with clock("assets"):
        assets = _assets(labels, own.seed, watched)
    with clock("fitting"):
        found = recover(seen, assets, progress=watched)
        if not labels.metric:
            found = found.resized({one.name: one.size for one in labels.objects if one.size is not None}, seen)
        found = replace(found, notes=(*notes, *found.notes))
    files = {name: path for name, path in vars(photograph).items() if path is not None}
    request = request_of_recovered(
        found,
        prompt=prompt,
        phrases={one.name: one.name for one in labels.objects},
        record={
            "labels": [asdict(one) for one in labels.objects],
            **({"labelled_by": dict(labeller.record())} if labeller is not None and photograph.labels is None else {}),
            "picture": {name: {"file": path.name, "sha256": _hash(path)} for name, path in files.items()},
        },
    )
    outcome = make(request, folder=folder, settings=own, clock=clock, progress=watched)
    watched(Event(stage="drawing what the picture became"))
    from pat3d.view.preview import save_row
    from pat3d.vision.panels import panels

    save_row(panels(seen, found, outcome.scene), folder / PICTURE)
    return outcome


def _read(
    photograph: Photograph, labeller: Labeller | None, depth_model: DepthModel | None, progress: Progress
) -> tuple[Observation, Labels, list[str]]:
    picture, angle = read_picture(photograph.picture)
    notes: list[str] = []
    values = read_masks(photograph.masks)
    if photograph.depth is not None:
        depth = read_depth(photograph.depth)
    elif depth_model is not None:
        progress(Event(stage="measuring depth", detail=depth_model.name))
        measured = depth_model.measure(picture)
        depth, angle = measured.depth, angle or measured.angle
        notes.append(f"{depth_model.name} has measured the depth")
    else:
        raise SpecError("nothing says how far away things are: give depth, or a model that measures it.")
    if photograph.labels is not None:
        labels = read_labels(photograph.labels)
    elif labeller is not None:
        progress(Event(stage="asking what the masks show"))
        labels = labeller.labels(like(picture, values), values)
    else:
        raise SpecError("nothing says what the masks show: give labels, or a model that looks at them.")
    instances = instances_of(values, labels)
    height, width = depth.shape
    if photograph.camera is not None:
        camera = read_camera(photograph.camera, width, height)
    else:
        camera, note = usual_camera(width, height, angle)
        notes.append(note)
    seen = observed(picture=picture, depth=depth, instances=instances, labels=labels, camera=camera)
    return seen, labels, notes


def _assets(labels: Labels, seed: int, progress: Progress) -> Mapping[str, Asset]:
    """An asset for every label, of its usual size."""
    found: dict[str, Asset] = {}
    for number, label in enumerate(labels.objects):
        progress(Event(stage="making assets", detail=label.name, step=number, steps=len(labels.objects)))
        found[label.name] = _asset(label, seed)
    return found


def _asset(label: Label, seed: int) -> Asset:
    variant = Variant(seed=derived_seed(seed, label.name), colours=label.colours, material=label.material)
    noun, words = label.noun, label.noun.split()
    # "A chipped blue mug" is a mug: of words that nobody knows, the last ones tell what it is.
    for first in range(len(words)):
        try:
            return sources.make(noun, variant)
        except PromptError as error:
            if first == len(words) - 1:
                raise PromptError(f'nothing is known for "{label.name}": {error}') from error
            noun = " ".join(words[first + 1 :])
        except AssetError as error:
            raise AssetError(f'"{label.name}": {error}') from error
    raise SpecError(f'"{label.name}" has no noun.')


def _hash(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise SpecError(f"{path}: cannot be read ({error.strerror or error}).") from error
