"""What the paper's metrics are measured on: objects with a surface, whoever made them.

A scene folder is taken as it is. Of a GLB or glTF file, every node with triangles is an object; of a folder, every
mesh file. Their surfaces are the delivered ones, and closed copies of them collide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.importing import TO_Z_UP
from pat3d.assets.mesh.load import FORMATS, LoadedMesh, load_mesh, load_objects
from pat3d.assets.mesh.repair import repair
from pat3d.errors import AssetError, SpecError
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import MassProperties, mass_properties
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import VisualMesh
from pat3d.scene.io import load_scene
from pat3d.scene.model import Scene

DENSITY = 1000.0
"""[kg/m^3] of objects that come without a mass."""

MOST_OBJECTS = 500

AIR = 1.0e-5
"""Height of the lowest vertex of foreign objects above the ground, over the scene's diagonal [-]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """One object."""

    name: str
    visual: VisualMesh
    """The delivered surface, whose vertices and triangles are counted."""
    parts: tuple[ConvexPart, ...]
    """What collides: convex parts, or one closed surface."""
    convex: bool
    """Whether `parts` are convex."""
    mass: MassProperties
    pose: Pose = field(default_factory=Pose)
    """Of the frame that all of these are given in."""
    fixed: bool = False

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Of the delivered surface, in the world [m], shape (vertices, 3)."""
        return self.pose.apply(self.visual.vertices)


@dataclass(frozen=True, kw_only=True)
class Joint:
    """A point that two bodies share."""

    bodies: tuple[int, int]
    points: tuple[tuple[float, float, float], tuple[float, float, float]]
    """In the frame of either [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Subject:
    """Objects above the ground at z = 0, z up."""

    name: str
    prompt: str = ""
    """What the objects are meant to show; empty where nobody says."""
    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...] = ()
    notes: tuple[str, ...] = ()
    """What had to be done to the surfaces."""

    @property
    def diagonal(self) -> float:
        """Of the bounding box of all delivered surfaces [m]."""
        corners = np.concatenate([body.vertices for body in self.bodies])
        return float(np.linalg.norm(np.ptp(corners, axis=0)))


def subject_of(scene: Scene, *, initial: bool = False) -> Subject:
    """The objects of a scene where they rest; where they were laid out, if `initial`."""
    bodies = [
        Body(
            name=obj.name,
            visual=obj.asset.visual,
            parts=tuple(obj.asset.parts),
            convex=True,
            mass=obj.asset.mass_properties,
            pose=obj.initial_pose if initial else obj.pose,
            fixed=obj.fixed,
        )
        for obj in scene.objects
    ]
    index = {body.name: number for number, body in enumerate(bodies)}
    joints = [
        Joint(bodies=(index[one.child], index[one.parent]), points=anchors)
        for one in scene.attachments
        for anchors in one.anchors
        if not (scene[one.child].fixed and scene[one.parent].fixed)
    ]
    return Subject(name=scene.prompt, prompt=scene.prompt, bodies=tuple(bodies), joints=tuple(joints))


def load_subject(path: str | Path) -> Subject:
    """A scene folder, a GLB or glTF file whose nodes are objects, or a folder of meshes that share one frame.

    Raises:
        AssetError: a mesh cannot be read.
        SpecError: there is nothing there to measure.
    """
    path = Path(path).expanduser()
    if (path / "scene.json").is_file():
        return replace(subject_of(load_scene(path)), name=path.name)
    if path.is_dir():
        files = sorted(file for file in path.iterdir() if file.suffix.lower().lstrip(".") in FORMATS)
        if not files:
            raise SpecError(f'"{path}" is no scene folder and holds no meshes ({", ".join(FORMATS)}).')
        found = [(file.stem, _upright(load_mesh(file))) for file in files[: MOST_OBJECTS + 1]]
    elif path.suffix.lower() in (".glb", ".gltf"):
        found = [(name, _upright(mesh)) for name, mesh in load_objects(path)]
    else:
        raise SpecError(f'"{path}" is no scene folder, no GLB or glTF file and no folder of meshes.')
    if not 1 <= len(found) <= MOST_OBJECTS:
        raise SpecError(f'"{path}" holds {len(found)} objects; 1 to {MOST_OBJECTS} are measured.')
    return subject_of_meshes(found, name=path.name)


def subject_of_meshes(meshes: Sequence[tuple[str, VisualMesh]], *, name: str = "meshes") -> Subject:
    """Objects given by their surfaces in one frame, z up; the lowest vertex of all is put on the ground.

    Raises:
        AssetError: a surface bounds no solid and cannot be mended.
    """
    corners = np.concatenate([mesh.vertices for _, mesh in meshes])
    lift = AIR * float(np.linalg.norm(np.ptp(corners, axis=0))) - float(corners[:, 2].min())
    bodies, notes = [], []
    for label, mesh in meshes:
        raised = replace(mesh, vertices=mesh.vertices + (0.0, 0.0, lift))
        try:
            made = repair(raised.vertices, raised.faces.astype(np.int64))
        except AssetError as error:
            raise AssetError(f'"{label}" of "{name}": {error}') from error
        if not made.watertight:
            notes.append(f'"{label}" is not closed; it collides as mended ({", ".join(made.repairs)})')
        solid = made.solid
        vertices, faces = np.ascontiguousarray(solid.vertices), np.ascontiguousarray(solid.faces, dtype=np.int32)
        bodies.append(
            Body(
                name=label,
                visual=_welded(raised),
                parts=(ConvexPart(vertices=vertices, faces=faces),),
                convex=_is_convex(vertices, faces),
                mass=mass_properties(vertices, faces, density=DENSITY),
            )
        )
    return Subject(name=name, bodies=tuple(bodies), notes=tuple(notes))


def scaled(subject: Subject, factor: float) -> Subject:
    """`subject` grown by `factor` about the world's origin, its densities kept."""

    def grown(points: Any) -> NDArray[np.float64]:
        return np.asarray(points, dtype=np.float64) * factor

    def body(one: Body) -> Body:
        inertia = np.array(one.mass.inertia) * factor**5
        return replace(
            one,
            visual=replace(one.visual, vertices=grown(one.visual.vertices)),
            parts=tuple(ConvexPart(vertices=grown(part.vertices), faces=part.faces) for part in one.parts),
            mass=MassProperties(
                mass=one.mass.mass * factor**3,
                volume=one.mass.volume * factor**3,
                centre_of_mass=tuple(grown(one.mass.centre_of_mass)),  # type: ignore[arg-type]
                inertia=tuple(tuple(row) for row in inertia),
            ),
            pose=Pose(position=tuple(grown(one.pose.position)), quat_wxyz=one.pose.quat_wxyz),  # type: ignore[arg-type]
        )

    joints = tuple(replace(one, points=tuple(tuple(grown(p)) for p in one.points)) for one in subject.joints)  # type: ignore[arg-type]
    return replace(subject, bodies=tuple(map(body, subject.bodies)), joints=joints)


def _upright(mesh: LoadedMesh) -> VisualMesh:
    """A loaded mesh with z up, in metres, as far as its file says its axes and its unit."""
    vertices = mesh.vertices @ np.array(TO_Z_UP[mesh.up or "z"], dtype=np.float64).T * (mesh.metres or 1.0)
    return VisualMesh(
        vertices=np.ascontiguousarray(vertices),
        faces=np.ascontiguousarray(mesh.faces, dtype=np.int32),
        uv=mesh.uv,
        texture=mesh.texture,
    )


def _welded(mesh: VisualMesh) -> VisualMesh:
    """`mesh` with a vertex for each place: files repeat vertices along the seams of their textures."""
    places, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = index.reshape(-1)[mesh.faces].astype(np.int32)
    keep = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return replace(mesh, vertices=places, faces=faces[keep], uv=mesh.uv[keep])


def _is_convex(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> bool:
    """Whether a closed surface fills its convex hull."""
    from scipy.spatial import ConvexHull

    from pat3d.geometry.normals import enclosed_volume

    return bool(enclosed_volume(vertices[faces]) > (1.0 - 1e-6) * ConvexHull(vertices).volume)
