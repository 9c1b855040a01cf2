"""One object as its files describe it, before it is sized, turned, repaired and cut into convex parts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.importing import UpAxis
from pat3d.assets.mesh.load import MAX_FACES, LoadedMesh
from pat3d.assets.mesh.texture import Patch, pack
from pat3d.errors import AssetError

Points = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Inertial:
    """What a description says of mass; the frame is the file's."""

    mass: float
    """[kg]"""
    centre: Points | None = None
    """Centre of mass [m], shape (3,); None where only the mass is said."""
    inertia: Points | None = None
    """About the centre of mass [kg m^2], shape (3, 3)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """One object in the units and axes of its files."""

    mesh: LoadedMesh
    name: str = ""
    """That the description gives it; empty where it gives none."""
    hulls: tuple[Points, ...] = ()
    """Points of every convex collision shape, each of shape (n, 3); none where the picture is to be decomposed."""
    touched: tuple[Piece, ...] = ()
    """The collision shapes themselves, convex or not."""
    metres: float | None = None
    """[m] of the file's unit, where the format or the file says it."""
    up: UpAxis | None = None
    """Axis that points up, where the format or the file says it."""
    declared: str = ""
    """What says so: "URDF"."""
    inertial: Inertial | None = None
    friction: float | None = None
    """Coulomb coefficient [-] of its collision shapes."""
    files: tuple[Path, ...] = ()
    """Everything that was read."""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Piece:
    """Some triangles of a description, in its frame."""

    vertices: Points
    """Shape (vertices, 3)."""
    faces: NDArray[np.int64]
    """Shape (faces, 3)."""
    patch: Patch
    files: tuple[Path, ...] = field(default=())
    surface: Mapping[str, float] = field(default_factory=dict)
    """Roughness, metallic and opacity [-], as far as the description says."""

    def placed(self, rotation: Points, position: Points, scale: Points | float = 1.0) -> Piece:
        """The piece stretched, turned and moved; a mirror image keeps its outside outside."""
        vertices = (self.vertices * scale) @ rotation.T + position
        mirrored = float(np.prod(np.broadcast_to(scale, 3))) < 0
        return replace(
            self,
            vertices=vertices,
            faces=self.faces[:, ::-1] if mirrored else self.faces,
            patch=self.patch.mirrored() if mirrored else self.patch,
        )


def flat(count: int, rgb: Sequence[float] | Points) -> Patch:
    """The look of `count` faces of one colour in [0, 1]."""
    colour = np.round(np.clip(np.asarray(rgb[:3], dtype=np.float64), 0.0, 1.0) * 255.0).astype(np.uint8)
    return Patch(uv=np.zeros((count, 3, 2)), colours=np.tile(colour, (count, 1)))


def primitive(kind: str, sizes: Sequence[float], rgb: Sequence[float] | Points) -> Piece:
    """A box (full sizes), sphere (radius), ellipsoid (semi-axes), cylinder or capsule (radius, length) at the origin.

    Raises:
        AssetError: an unknown kind, or sizes that are not positive.
    """
    import trimesh

    if not (sizes and np.isfinite(sizes).all() and min(sizes) > 0):
        raise AssetError(f"a {kind} has sizes {list(sizes)}; they must be positive.")
    if kind == "box":
        made = trimesh.creation.box(sizes)
    elif kind == "sphere":
        made = trimesh.creation.icosphere(3, sizes[0])
    elif kind == "ellipsoid":
        made = trimesh.creation.icosphere(3, 1.0)
        made.apply_scale(sizes)
    elif kind == "cylinder":
        made = trimesh.creation.cylinder(sizes[0], sizes[1], sections=48)
    elif kind == "capsule":
        made = trimesh.creation.capsule(sizes[1], sizes[0], count=[24, 24])
    else:
        raise AssetError(f'shapes of type "{kind}" are not read; box, sphere, cylinder, capsule and mesh are.')
    faces = np.asarray(made.faces, dtype=np.int64)
    return Piece(vertices=np.asarray(made.vertices, dtype=np.float64), faces=faces, patch=flat(len(faces), rgb))


def of_mesh(loaded: LoadedMesh) -> Piece:
    """The triangles of a mesh file as a piece."""
    return Piece(
        vertices=loaded.vertices,
        faces=loaded.faces,
        patch=Patch(uv=loaded.uv, image=loaded.texture, maps=loaded.maps),
        files=loaded.files,
        surface=loaded.surface,
    )


def merged(pieces: Sequence[Piece], notes: Sequence[str] = ()) -> LoadedMesh:
    """All pieces as one mesh with one texture.

    Raises:
        AssetError: there are no triangles, or too many.
    """
    count = sum(len(piece.faces) for piece in pieces)
    if not count:
        raise AssetError("the description holds no triangles and no shapes to look at.")
    if count > MAX_FACES:
        raise AssetError(f"{count:,} triangles; at most {MAX_FACES:,} are read. Simplify it first.")
    told = list(notes)
    starts = np.cumsum([0] + [len(piece.vertices) for piece in pieces])
    vertices = np.concatenate([piece.vertices for piece in pieces])
    faces = np.concatenate([piece.faces + start for piece, start in zip(pieces, starts, strict=False)])
    if not np.isfinite(vertices[np.unique(faces)]).all():
        raise AssetError("some vertices are not finite.")
    look = pack([piece.patch for piece in pieces], told)
    files = tuple(dict.fromkeys(path for piece in pieces for path in piece.files))
    surface = max(pieces, key=lambda piece: len(piece.faces)).surface
    return LoadedMesh(
        vertices=vertices,
        faces=faces,
        uv=look.uv,
        texture=look.texture,
        maps=look.maps,
        surface=surface,
        notes=tuple(told),
        files=files,
    )
