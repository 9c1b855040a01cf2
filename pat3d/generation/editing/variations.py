"""Other scenes that the same relations describe: other places, other objects of the same kind, other weights."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import ExportError, Pat3dError, SpecError
from pat3d.generation.attempts import request_key
from pat3d.generation.editing.assets import rubbing, scaled, weighing
from pat3d.generation.many import Row, row_of, write_table
from pat3d.generation.pipeline import make
from pat3d.generation.request import SceneRequest, UnplacedObject, derived_seed
from pat3d.generation.rewrite import read_folder
from pat3d.generation.settings import Settings
from pat3d.progress import Clock, Progress, silent
from pat3d.scene.asset import Asset
from pat3d.scene.folder import check_target, read_json
from pat3d.scene.model import Scene, SceneObject
from pat3d.scene.naming import slug

MAX_VARIATIONS = 100_000
MASS_FACTORS, FRICTION_FACTORS = (0.75, 1.33), (0.8, 1.25)
"""Between what a material's mass and friction vary: fillings and surfaces of one material differ by about as much."""


@dataclass(frozen=True, kw_only=True)
class Variety:
    """What is to differ."""

    layout: bool = False
    """Places, within the relations."""
    objects: bool = False
    """Shapes and sizes, of the same nouns and the colours that were asked for."""
    materials: bool = False
    """Masses and friction coefficients."""

    def __post_init__(self) -> None:
        if not (self.layout or self.objects or self.materials):
            raise SpecError("say what is to differ: --layout, --objects same-kind or --materials.")


def vary(
    folder: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    count: int,
    variety: Variety,
    seed: int = 0,
    device: str = Settings.device,
    progress: Progress = silent,
) -> Iterator[Row]:
    """Make `count` scenes like the one in `folder`, each in a folder of its own in `out`; rows come as they are made.

    What an earlier call made is kept. A variation for which there is no room is a row that says so.

    Args:
        folder: a scene folder.
        out: folder of the scenes, with a table of them.
        count: of variations.
        variety: what differs.
        seed: the same seed gives the same variations, whatever their count.
        device: "cpu" or "cuda".
        progress: told what is going on.

    Raises:
        SpecError: there is no scene.
        ExportError: `out` is not a folder that can be written.
    """
    source = Path(folder).expanduser().resolve()
    scene, root = read_folder(source, progress), Path(out).expanduser()
    if root.exists() and not root.is_dir():
        raise ExportError(f"{root} is a file; give a folder for the scenes.")
    rows: list[Row] = []
    for number in range(count):
        name = f"{slug(source.name)}_{number + 1:0{max(3, len(str(count)))}d}"
        request, settings = _request(scene, source, variety, derived_seed(seed, "vary", number), device)
        row = _kept(request, settings, root / name) or _made(request, settings, root / name, progress)
        rows.append(row)
        write_table(rows, root)
        yield row


def _request(scene: Scene, source: Path, variety: Variety, seed: int, device: str) -> tuple[SceneRequest, Settings]:
    layout_seed = scene.provenance.get("settings", {}).get("layout_seed", scene.seed)
    provenance = {"source": "variation", "of": source.name, "seed": seed, "differs": asdict(variety)}
    request = SceneRequest(
        prompt=scene.prompt,
        names=tuple(obj.name for obj in scene.objects),
        relations=scene.relations,
        arrangements=scene.arrangements,
        fingerprint=[read_json(source / "scene.json").get("checksum"), asdict(variety), seed],
        make_objects=lambda _, progress: _objects(scene, variety, seed),
        record={"notes": [f"a variation of {source.name}."]},
        task=scene.task,
        provenance=provenance,
    )
    settings = Settings(
        seed=seed if variety.layout else int(layout_seed),
        friction=scene.settling_friction,
        least_tilt=scene.least_tilt,
        device=device,
    )
    return request, settings


def _kept(request: SceneRequest, settings: Settings, folder: Path) -> Row | None:
    report = read_json(folder / "report.json")
    inputs = report.get("inputs")
    key = request_key(
        request,
        seed=settings.seed,
        friction=settings.friction,
        device=settings.device,
        least_tilt=settings.least_tilt,
    )
    if not (folder / "scene.json").is_file() or not isinstance(inputs, dict) or inputs.get("request") != key:
        return None
    return row_of(request.prompt, folder, report, kept=True)


def _made(request: SceneRequest, settings: Settings, folder: Path, progress: Progress) -> Row:
    clock = Clock()
    try:
        outcome = make(request, folder=check_target(folder), settings=settings, clock=clock, progress=progress)
    except Pat3dError as error:
        return Row(
            prompt=request.prompt,
            folder=folder.name,
            state="refused",
            seconds=clock.seconds["total"],
            message=f"{type(error).__name__}: {error}",
            exit_code=error.exit_code,
        )
    return row_of(request.prompt, folder, outcome.report.as_dict())


def _objects(scene: Scene, variety: Variety, seed: int) -> tuple[UnplacedObject, ...]:
    """The objects of `scene` before they have places; those that share an asset share its variation."""
    varied: dict[int, Asset] = {}
    for obj in scene.objects:
        if id(obj.asset) not in varied:
            varied[id(obj.asset)] = _asset(obj, variety, derived_seed(seed, obj.name))
    return tuple(
        UnplacedObject(
            name=obj.name,
            asset=varied[id(obj.asset)],
            phrase=obj.phrase,
            fixed=obj.fixed,
            posture=obj.posture,
        )
        for obj in scene.objects
    )


def _asset(obj: SceneObject, variety: Variety, seed: int) -> Asset:
    asset = obj.asset
    if variety.objects:
        asset = _same_kind(obj, seed)
    if variety.materials:
        rng = np.random.default_rng([seed, *b"material"])
        asset = weighing(asset, asset.mass_properties.mass * _between(rng, MASS_FACTORS))
        asset = rubbing(asset, asset.material.friction * _between(rng, FRICTION_FACTORS))
    return asset


def _between(rng: np.random.Generator, factors: tuple[float, float]) -> float:
    """A factor, as likely to be so many times more as so many times less."""
    return float(np.exp(rng.uniform(*np.log(factors))))


def _same_kind(obj: SceneObject, seed: int) -> Asset:
    """Another asset from the recipe of the object's own; a mesh of the user's stays what it is."""
    from pat3d.assets import catalogue

    made: dict[str, Any] = dict(obj.asset.provenance)
    if made.get("source") != "catalogue" or catalogue.find(obj.asset.noun) is None:
        return obj.asset
    said = f"{obj.name} {obj.phrase}".casefold()
    asset = catalogue.make(
        obj.asset.noun,
        colours=[colour for colour in made.get("colours", ()) if colour in said],
        material=made.get("material"),
        scale=float(made.get("scale", 1.0)),
        seed=seed,
    )
    edited = made.get("edited", {})
    if "scaled" in edited:
        asset = scaled(asset, float(edited["scaled"]))
    if edited.keys() - {"scaled"}:
        # What the user weighed, or rubbed, stays as heavy and as rough.
        asset = rubbing(weighing(asset, obj.asset.mass_properties.mass), obj.asset.material.friction)
    return asset
