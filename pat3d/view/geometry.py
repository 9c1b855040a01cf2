"""The triangles of a picture: placed meshes with smooth normals and textures, and what view rays see of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.normals import area_vectors, crease_normals, triangle_areas
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import VisualMesh
from pat3d.view.rays import RayScene, unit
from pat3d.view.textures import TextureAtlas


@dataclass(frozen=True, eq=False)
class _Prepared:
    """What a mesh needs for every picture, whatever its pose."""

    normals: NDArray[np.float32]
    """Corner normals, shape (faces, 3, 3)."""
    density: NDArray[np.float32]
    """Texels per metre of every face, shape (faces,)."""


_PREPARED: WeakKeyDictionary[VisualMesh, _Prepared] = WeakKeyDictionary()


def _prepared(mesh: VisualMesh) -> _Prepared:
    """Normals and texel density of `mesh`, computed once: the frames of a video share them."""
    found = _PREPARED.get(mesh)
    if found is None:
        corners = mesh.vertices[mesh.faces]
        area = 2.0 * triangle_areas(corners)
        edge, other = mesh.uv[:, 1] - mesh.uv[:, 0], mesh.uv[:, 2] - mesh.uv[:, 0]
        texels = np.abs(edge[:, 0] * other[:, 1] - edge[:, 1] * other[:, 0]) * mesh.texture[..., 0].size
        density = np.sqrt(texels / np.maximum(area, 1e-18)).astype(np.float32)
        found = _PREPARED[mesh] = _Prepared(crease_normals(mesh.vertices, mesh.faces), density)
    return found


@dataclass(frozen=True, eq=False)
class Hits:
    """Where rays meet triangles; `which` lists the rays that do."""

    which: NDArray[np.int64]
    """Indices of the rays, shape (m,)."""
    item: NDArray[np.int32]
    """Which item was hit, shape (m,)."""
    distance: NDArray[np.float32]
    """[m], shape (m,)."""
    point: NDArray[np.float32]
    """[m], shape (m, 3)."""
    outside: NDArray[np.float32]
    """The point lifted onto the smooth surface that the normals suggest [m], shape (m, 3)."""
    normal: NDArray[np.float32]
    """Smooth unit normal on the viewer's side, shape (m, 3)."""
    flat: NDArray[np.float32]
    """Unit normal of the triangle on the viewer's side, shape (m, 3)."""
    colour: NDArray[np.float32]
    """Linear RGB of the surface, shape (m, 3)."""
    outer: NDArray[np.bool_]
    """Whether the outside of the surface is seen, shape (m,)."""

    def only(self, chosen: NDArray[np.bool_]) -> Hits:
        """Those that are `chosen`, shape (m,)."""
        return Hits(*(getattr(self, one.name)[chosen] for one in fields(self)))

    def behind(self, front: Hits, step: np.float32) -> Hits:
        """These hits of rays that go on `step` [m] behind those of `front`, as hits of the rays of `front`."""
        return replace(self, which=front.which[self.which], distance=front.distance[self.which] + step + self.distance)

    @staticmethod
    def together(several: Sequence[Hits]) -> Hits:
        """All of them."""
        return Hits(*(np.concatenate([getattr(one, each.name) for one in several]) for each in fields(Hits)))


Item = tuple[VisualMesh, Pose] | tuple[VisualMesh, Pose, float]
"""A mesh, where it is, and its opacity [-], which is 1 where it is not said."""


class Geometry:
    """Placed meshes ready for rays, in a float32 frame whose origin is the middle of the picture's contents."""

    def __init__(self, items: Sequence[Item]) -> None:
        self.items = items
        self.opacity = np.array([item[2] if len(item) > 2 else 1.0 for item in items], dtype=np.float32)
        """Of every item [-], shape (items,)."""
        self.see_through = bool((self.opacity < 1.0).any())
        placed = [pose.apply(mesh.vertices) for mesh, pose, *_ in items]
        self.low = np.min([points.min(axis=0) for points in placed], axis=0)
        self.high = np.max([points.max(axis=0) for points in placed], axis=0)
        self.origin: NDArray[np.float64] = (self.low + self.high) / 2.0
        corners, normals = [], []
        for (mesh, pose, *_), points in zip(items, placed, strict=True):
            corners.append((points - self.origin).astype(np.float32)[mesh.faces])
            normals.append(_prepared(mesh).normals @ pose.rotation.T.astype(np.float32))
        self.corners: NDArray[np.float32] = np.concatenate(corners)
        self._normals: NDArray[np.float32] = np.concatenate(normals)
        self._uv = np.concatenate([mesh.uv for mesh, *_ in items]).astype(np.float32)
        self._density = np.concatenate([_prepared(mesh).density for mesh, *_ in items])
        counts = [len(mesh.faces) for mesh, *_ in items]
        self._item = np.repeat(np.arange(len(items), dtype=np.int32), counts)
        self._atlas = TextureAtlas([mesh.texture for mesh, *_ in items])
        area = area_vectors(self.corners)
        length = np.linalg.norm(area, axis=1)
        self.face_normals: NDArray[np.float32] = area / np.maximum(length, 1e-30)[:, None]
        centre = self._uv.mean(axis=1)
        edge = np.sqrt(length) * self._density
        self.face_colours: NDArray[np.float32] = self._atlas.colour(self._item, centre, edge)
        self._scene = RayScene(self.corners)
        self.occluded, self.first_faces = self._scene.occluded, self._scene.first_faces

    @property
    def radius(self) -> float:
        """Half the diagonal of the bounding box [m]."""
        return float(np.linalg.norm(self.high - self.low) / 2.0)

    def first_items(self, origins: NDArray[np.float32], directions: NDArray[np.float32]) -> NDArray[np.int32]:
        """Index of the item that each ray, shape (n, 3), hits first, -1 for none; shape (n,)."""
        face, _ = self.first_faces(origins, directions)
        return np.where(face >= 0, self._item[face], np.int32(-1))

    def trace(self, origin: NDArray[np.float32], directions: NDArray[np.float32], pixel: float) -> Hits:
        """First hits of rays.

        Args:
            origin: of all of them [m], shape (3,), or of each, shape (n, 3).
            directions: unit vectors, shape (n, 3).
            pixel: angle between neighbouring rays [rad], which chooses the texture's resolution.
        """
        hits = self._scene.hits(origin, directions)
        face, distance, weights = hits.face, hits.distance, hits.weights
        ray = directions[hits.which]
        point = (origin if origin.ndim == 1 else origin[hits.which]) + distance[:, None] * ray
        corner_normals, corners = self._normals[face], self.corners[face]
        normal = unit(hits.at(self._normals))
        flat = self.face_normals[face]
        inside = np.einsum("ij,ij->i", flat, ray) > 0.0
        side = np.where(inside, -1.0, 1.0).astype(np.float32)[:, None]
        # Rays from flat facets to the light would see the facets' own horizon and draw it as a staircase;
        # starting from the tangent planes of the corners hides it.
        lift = np.zeros_like(point)
        for k in range(3):
            depth = np.einsum("ij,ij->i", point - corners[:, k], corner_normals[:, k])[:, None]
            lift -= weights[:, k, None] * np.minimum(depth * side, 0.0) * side * corner_normals[:, k]
        slope = np.maximum(np.abs(np.einsum("ij,ij->i", flat, ray)), 0.1)
        footprint = self._density[face] * distance * np.float32(pixel) / np.sqrt(slope)
        return Hits(
            which=hits.which,
            item=self._item[face],
            distance=distance,
            point=point.astype(np.float32, copy=False),
            outside=(point + lift).astype(np.float32, copy=False),
            normal=normal * side,
            flat=flat * side,
            colour=self._atlas.colour(self._item[face], hits.at(self._uv), footprint),
            outer=~inside,
        )
