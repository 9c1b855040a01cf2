"""Scenes from specifications: the user's meshes, sizes and relations instead of a sentence."""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from pat3d.errors import AssetError, CheckError, ExportError, Pat3dError, PromptError, SpecError
from pat3d.generation.optimize_stage import GIVEN
from pat3d.generation.request import SceneRequest, UnplacedObject, derived_seed, foreign_assets
from pat3d.generation.spec_schema import BUILD_SCHEMA
from pat3d.geometry.pose import Pose
from pat3d.progress import CpuBudget, Event, Progress
from pat3d.scene.arrangements import Arrangement, check_arrangements
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Relation, check_tree
from pat3d.scene.naming import APART
from pat3d.scene.physics import HEAVIEST, LIGHTEST, SETTLING_FRICTION
from pat3d.scene.relations import built_together, check_sides
from pat3d.scene.yaml_source import Source, nearest, read_yaml, validate

SOURCES = ("noun", "mesh", "model")
"""Where an object comes from: one of them."""

MESH_KEYS = ("units", "up", "parts", "threshold", "max_hulls", "decomposition_limit", "thickness")
NOUN_KEYS = ("colour", "colours")
MODEL_KEYS = ("scale", "size", "material")
"""What decides about objects that are made, not about a model, which says it itself."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Spec:
    """A valid specification; its meshes have not been read."""

    source: Source
    relations: tuple[Relation, ...]
    arrangements: tuple[Arrangement, ...] = ()
    poses: Mapping[str, Pose]

    @property
    def objects(self) -> list[dict[str, Any]]:
        """As written."""
        return self.source.document["objects"]

    @property
    def seed(self) -> int:
        """Of the scene."""
        return self.source.document.get("seed", 0)

    @property
    def friction(self) -> float:
        """Coulomb coefficient [-] while settling."""
        return float(self.source.document.get("friction", SETTLING_FRICTION))

    def request(self, budget: CpuBudget | None = None) -> SceneRequest:
        """What to make; decompositions take no more of the processor than `budget` has left."""
        document = self.source.document
        hashes = [_hash(path) if (path := self._file(obj)) is not None else None for obj in self.objects]
        return SceneRequest(
            prompt="",
            names=tuple(obj["name"] for obj in self.objects),
            relations=self.relations,
            arrangements=self.arrangements,
            fingerprint=[
                document["objects"],
                document.get("relations", []),
                hashes,
                *([document["arrangements"]] if "arrangements" in document else []),
                *([foreign] if (foreign := foreign_assets(obj.get("noun", "") for obj in self.objects)) else []),
            ],
            make_objects=partial(self.make_objects, budget=budget or CpuBudget()),
            record={"specification": document},
            adjustable=len(self.poses) < len(self.objects),
            provenance={
                "source": "specification",
                "file": self.source.path.name,
                **({GIVEN: sorted(self.poses)} if self.poses else {}),
            },
        )

    def make_objects(self, seed: int, progress: Progress, budget: CpuBudget) -> tuple[UnplacedObject, ...]:
        """The assets, in the order of the specification."""
        found: list[UnplacedObject] = []
        same: dict[int, tuple[Asset, Asset]] = {}
        models: dict[Path, Asset] = {}
        # Of what carries one thing together, the same noun is the same thing: a pyramid needs cans of one height.
        together = built_together([obj["name"] for obj in self.objects], self.relations)
        for number, obj in enumerate(self.objects):
            progress(Event(stage="making assets", detail=obj["name"], step=number, steps=len(self.objects)))
            name: str = obj["name"]
            own = derived_seed(seed, together.get(name, name))
            try:
                if "model" in obj:
                    made = self._model(obj, models, budget.left)
                else:
                    made = self._import(obj, budget.left) if "mesh" in obj else _from_catalogue(obj, own)
            except (AssetError, PromptError, CheckError, ExportError) as error:
                key = next(one for one in SOURCES if one in obj)
                place = ("objects", number, key)
                raise self.source.error(place, f'"{obj["name"]}": {error}') from error
            # One asset is stored once. What was made is kept beside it, so that its identity is not used again.
            _, asset = same.setdefault(id(made), (made, _timeless(made)))
            mass = asset.mass_properties.mass
            if not LIGHTEST <= mass <= HEAVIEST:
                key = next((key for key in ("mass", "density", "mesh", "model") if key in obj), "noun")
                raise self.source.error(
                    ("objects", number, key),
                    f'"{obj["name"]}" has a mass of {mass:.3g} kg; {LIGHTEST:g} to {HEAVIEST:g} kg can be simulated.',
                )
            found.append(
                UnplacedObject(
                    name=obj["name"],
                    asset=asset,
                    fixed=obj.get("fixed", False),
                    pose=self.poses.get(obj["name"]),
                    posture=obj.get("posture"),
                )
            )
        return tuple(found)

    def _file(self, obj: Mapping[str, Any]) -> Path | None:
        """The file that an object comes from; None for nouns."""
        said = obj.get("mesh", obj.get("model"))
        return None if said is None else self.source.path.parent / os.path.expanduser(said)

    def _model(self, obj: Mapping[str, Any], known: dict[Path, Asset], cpu_limit: float | None) -> Asset:
        """The object of a description, read once, with the mass and the friction that `obj` asks for."""
        from pat3d.importers.scene import import_object

        path = self.source.path.parent / os.path.expanduser(obj["model"])
        if path not in known:
            home = self.source.path.parent.resolve()
            root = home if path.resolve().is_relative_to(home) else None
            known[path] = import_object(path, root=root, cpu_limit=cpu_limit)
        return _weighing(known[path], obj)

    def _import(self, obj: Mapping[str, Any], cpu_limit: float | None) -> Asset:
        from pat3d.assets.mesh.importing import import_mesh

        path = self.source.path.parent / os.path.expanduser(obj["mesh"])
        keys = ("scale", "size", "density", "mass", "friction", "material", *MESH_KEYS)
        # Textures often lie in a folder beside the meshes'; anywhere under the specification is the user's own data.
        home = self.source.path.parent.resolve()
        root = home if path.resolve().is_relative_to(home) else None
        return import_mesh(
            path, texture_root=root, cpu_limit=cpu_limit, **{key: obj[key] for key in keys if key in obj}
        )


def load_spec(path: str | os.PathLike[str]) -> Spec:
    """Read and validate the specification at `path`, without reading its meshes.

    Raises:
        SpecError: it is invalid; the message names line, column and key, and what would be valid.
    """
    source = read_yaml(Path(path))
    validate(source, BUILD_SCHEMA)
    document = source.document
    _check_objects(source, document["objects"], Path(path).parent)
    names = [obj["name"] for obj in document["objects"]]
    relations = _relations(source, names)
    arrangements = _arrangements(source, names, relations)
    poses = {
        obj["name"]: _pose(source, number, obj["pose"])
        for number, obj in enumerate(document["objects"])
        if "pose" in obj
    }
    return Spec(source=source, relations=relations, arrangements=arrangements, poses=poses)


def _relations(source: Source, names: list[str]) -> tuple[Relation, ...]:
    """The relations, one for each of several carriers."""
    found: list[Relation] = []
    for number, entry in enumerate(source.document.get("relations", [])):
        place = ("relations", number)
        _known(source, (*place, "child"), entry["child"], names)
        parents = entry["parent"] if isinstance(entry["parent"], list) else [entry["parent"]]
        for parent in parents:
            _known(source, (*place, "parent"), parent, [*names, GROUND])
        try:
            found += [Relation(child=entry["child"], kind=entry["kind"], parent=parent) for parent in parents]
            check_tree(names, tuple(found))
            check_sides(tuple(found))
        except SpecError as error:
            raise source.error(place, str(error)) from error
    return tuple(found)


def _arrangements(source: Source, names: list[str], relations: tuple[Relation, ...]) -> tuple[Arrangement, ...]:
    found: list[Arrangement] = []
    for number, entry in enumerate(source.document.get("arrangements", [])):
        place = ("arrangements", number)
        for key in ("objects", "of"):
            for at, name in enumerate(entry.get(key, [])):
                _known(source, (*place, key, at), name, names)
        try:
            one = Arrangement(kind=entry["kind"], objects=tuple(entry["objects"]), of=tuple(entry.get("of", [])))
            check_arrangements(names, relations, (one,))
        except SpecError as error:
            raise source.error(place, str(error)) from error
        found.append(one)
    return tuple(found)


def _known(source: Source, place: tuple[str | int, ...], name: str, names: list[str]) -> None:
    if name not in names:
        raise source.error(place, f'there is no object "{name}".{nearest(name, names)}')


def _check_objects(source: Source, objects: list[dict[str, Any]], folder: Path) -> None:
    """What a schema cannot say."""
    from pat3d.assets import catalogue
    from pat3d.assets.sources import source_of

    seen: dict[str, int] = {}
    for number, obj in enumerate(objects):
        name, place = obj["name"], ("objects", number)
        if name in seen:
            raise source.error((*place, "name"), f'"{name}" is also the name of objects[{seen[name]}].')
        if name == GROUND:
            raise source.error((*place, "name"), f'"{GROUND}" is the plane z = 0; choose another name.')
        seen[name] = number
        if sum(key in obj for key in SOURCES) != 1:
            raise source.error(place, f'"{name}" needs either a noun from the catalogue, a mesh file or a model file.')
        for pair in (("mass", "density"), ("size", "scale"), ("size", "units"), ("colour", "colours")):
            if all(key in obj for key in pair):
                raise source.error((*place, pair[1]), f'"{name}": give {pair[0]} or {pair[1]}, not both.')
        foreign = MESH_KEYS if "noun" in obj else NOUN_KEYS
        if "model" in obj:
            foreign = (*MESH_KEYS, *NOUN_KEYS, *MODEL_KEYS)
        wrong = next((key for key in foreign if key in obj), None)
        if wrong:
            other = "meshes" if wrong in MESH_KEYS else "catalogue nouns" if wrong in NOUN_KEYS else "what is no model"
            raise source.error((*place, wrong), f'"{wrong}" is for {other} only.')
        if "noun" in obj:
            if APART in obj["noun"]:
                try:
                    source_of(obj["noun"]).digest(obj["noun"])
                except Pat3dError as error:
                    raise source.error((*place, "noun"), str(error)) from error
            elif catalogue.find(obj["noun"]) is None:
                near = nearest(obj["noun"], catalogue.nearest(obj["noun"])) or " See pat3d catalogue."
                raise source.error((*place, "noun"), f'"{obj["noun"]}" is not in the catalogue.{near}')
            if isinstance(obj.get("size"), list):
                raise source.error((*place, "size"), "the size of a noun is one length, its longest side [m].")
        else:
            key = "mesh" if "mesh" in obj else "model"
            if not (folder / os.path.expanduser(obj[key])).is_file():
                raise source.error((*place, key), f'there is no {key} file "{obj[key]}" in {folder.resolve()}.')


def _pose(source: Source, number: int, entry: Mapping[str, Any]) -> Pose:
    place = ("objects", number, "pose")
    if "yaw_degrees" in entry and "quat_wxyz" in entry:
        raise source.error((*place, "quat_wxyz"), "give yaw_degrees or quat_wxyz, not both.")
    x, y, z = map(float, entry["position"])
    try:
        if "quat_wxyz" in entry:
            return Pose(position=(x, y, z), quat_wxyz=tuple(map(float, entry["quat_wxyz"])))  # type: ignore[arg-type]
        return Pose.from_yaw(math.radians(entry.get("yaw_degrees", 0.0)), (x, y, z))
    except SpecError as error:
        raise source.error(place, str(error)) from error


def _timeless(asset: Asset) -> Asset:
    """`asset` without how long its parts took and whether they were cached, which are no properties of a scene."""
    parts = asset.provenance.get("parts")
    if not isinstance(parts, Mapping):
        return asset
    kept = {key: value for key, value in parts.items() if key not in ("seconds", "cached")}
    return replace(asset, provenance={**asset.provenance, "parts": kept})


def _from_catalogue(obj: Mapping[str, Any], seed: int) -> Asset:
    """An asset of a noun with the size, mass and friction that `obj` asks for."""
    from pat3d.assets import sources
    from pat3d.assets.variant import Variant

    def made(scale: float) -> Asset:
        colours = tuple(obj.get("colours", [obj["colour"]] if "colour" in obj else []))
        variant = Variant(seed=seed, scale=scale, colours=colours, material=obj.get("material"))
        return sources.make(obj["noun"], variant)

    asset = made(float(obj.get("scale", 1.0)))
    if "size" in obj:
        asset = made(float(obj["size"]) / float(asset.size.max()))
    return _weighing(asset, obj)


def _weighing(asset: Asset, obj: Mapping[str, Any]) -> Asset:
    """`asset` with the mass and the friction that `obj` asks for, if any."""
    if not {"mass", "density", "friction"} & obj.keys():
        return asset
    properties, material = asset.mass_properties, asset.material
    mass = obj.get("mass", obj["density"] * properties.volume if "density" in obj else None)
    if mass is not None:
        factor = float(mass) / properties.mass
        inertia = tuple(tuple(factor * value for value in row) for row in properties.inertia)
        properties = replace(properties, mass=float(mass), inertia=inertia)
        material = replace(material, density=float(mass) / properties.volume)
    if "friction" in obj:
        material = replace(material, friction=float(obj["friction"]))
    return replace(asset, mass_properties=properties, material=material)


def _hash(path: Path) -> str:
    """SHA-256 of a file."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise AssetError(f"{path}: cannot be read ({error.strerror or error}). Nothing was written.") from error
