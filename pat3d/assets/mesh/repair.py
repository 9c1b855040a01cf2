"""From any triangle mesh to closed solids with a mass, saying what had to be done for it.

Order of means: the surface as it is; caps on small holes, on cuts between touching pieces, on ends
that reach into another piece and on a missing base; thickness for open shells; a voxel wrap.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import manifold3d
import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.topology import (
    Indices,
    Points,
    Sheets,
    boundary_loops,
    signed_volume,
    split_sheets,
    weld,
    winding_number,
)
from pat3d.assets.mesh.wrap import RESOLUTION, voxel_wrap
from pat3d.errors import AssetError
from pat3d.geometry.normals import area_vectors, triangle_areas

VolumeSource = Literal["closed surface", "hole filled", "thickened shell", "voxel wrap"]

SMALL_HOLE = 0.1
"""Holes up to this fraction of the longest side across are capped."""

WELD = 1e-5
"""Vertices on open edges closer than this fraction of the longest side are joined."""

MAX_SHEETS = 500
MAX_OPEN = 32
"""Pieces, and open shells among them, beyond which a mesh is a soup to be wrapped."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Solid:
    """A closed surface."""

    vertices: Points
    """[m], shape (vertices, 3)."""
    faces: Indices
    """Counter-clockwise from outside, shape (faces, 3)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Repaired:
    """A mesh to look at, and the solid that it bounds."""

    vertices: Points
    """Of the mesh to look at [m], shape (vertices, 3)."""
    faces: Indices
    """Of the mesh to look at, facing outwards, shape (faces, 3)."""
    corners: Indices
    """Corner of the input (3 face + corner) whose texture coordinate each corner takes, shape (faces, 3)."""
    pieces: tuple[Solid, ...]
    """Closed pieces; they may overlap."""
    solid: Solid
    """Their union, holes taken out: the closed surface that has the mass."""
    volume_source: VolumeSource
    watertight: bool
    """Whether the input was closed and manifold without any repair but welding."""
    repairs: tuple[str, ...]


@dataclass
class _Piece:
    vertices: Points
    faces: Indices
    corners: Indices
    loops: list[Indices]
    """Boundary loops as half-edges (3 face + corner)."""
    cut: NDArray[np.bool_]
    """Whether each half-edge was cut from other faces, shape (3 faces,)."""

    def rim(self, loop: Indices) -> Indices:
        """Vertices along a boundary loop."""
        return self.faces.reshape(-1)[loop]


def repair(vertices: Points, faces: Indices, *, thickness: float | None = None) -> Repaired:
    """Close a mesh and find the solid it bounds.

    Args:
        vertices: [m], shape (vertices, 3), finite, z up.
        faces: shape (faces, 3), wound in any way.
        thickness: of open shells [m]; by default 2 % of the longest side and at most 2 mm.

    Raises:
        AssetError: the mesh has no area, or encloses nothing by any means.
    """
    size = float(np.ptp(vertices[np.unique(faces)], axis=0).max()) if len(faces) else 0.0
    if size <= 0.0 or 2.0 * triangle_areas(vertices[faces]).sum() <= 1e-12 * size**2:
        raise AssetError("the mesh has zero area: its triangles are all lines or points.")
    repairs: list[str] = []
    points, welded, joined = weld(vertices, faces, WELD * size)
    if joined:
        repairs.append(f"joined {joined} vertices along cracks")
    kept, welded = _without_repeats(welded, repairs)
    sheets = split_sheets(points, welded)
    corners = 3 * kept[sheets.corners // 3] + sheets.corners % 3
    if sheets.turned:
        repairs.append(f"reversed the winding of {sheets.turned} faces")
    pieces = _pieces(sheets, corners) if sheets.orientable and sheets.label.max() < MAX_SHEETS else []
    watertight = bool(pieces) and not any(piece.loops for piece in pieces) and not sheets.cut.any()
    source: VolumeSource = "closed surface"
    if not watertight and pieces:
        source = _close(pieces, size, thickness, repairs)
        if any(piece.loops for piece in pieces):
            pieces = []
    pieces = _solid_pieces(pieces, size, repairs)
    union = _union(pieces)
    if union is None:
        outer, around = voxel_wrap(points, welded)
        wrapped = Solid(vertices=outer, faces=around)
        repairs.append(f"wrapped the surface in voxels, which adds about {0.6 * size / RESOLUTION * 1e3:.2g} mm")
        return Repaired(
            vertices=sheets.vertices,
            faces=sheets.faces,
            corners=corners,
            pieces=(wrapped,),
            solid=wrapped,
            volume_source="voxel wrap",
            watertight=False,
            repairs=tuple(repairs),
        )
    starts = np.cumsum([0] + [len(piece.vertices) for piece in pieces])
    return Repaired(
        vertices=np.concatenate([piece.vertices for piece in pieces]),
        faces=np.concatenate([piece.faces + start for piece, start in zip(pieces, starts, strict=False)]),
        corners=np.concatenate([piece.corners for piece in pieces]),
        pieces=_nested(pieces),
        solid=union,
        volume_source=source,
        watertight=watertight,
        repairs=tuple(repairs),
    )


def _without_repeats(faces: Indices, repairs: list[str]) -> tuple[Indices, Indices]:
    """Faces with three different vertices, each once, and their numbers."""
    proper = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    if not proper.all():
        repairs.append(f"dropped {int((~proper).sum())} degenerate faces")
    kept = np.flatnonzero(proper)
    first = np.unique(np.sort(faces[kept], axis=1), axis=0, return_index=True)[1]
    if len(first) < len(kept):
        repairs.append(f"dropped {len(kept) - len(first)} duplicate faces")
    kept = kept[np.sort(first)]
    return kept, faces[kept]


def _pieces(sheets: Sheets, corners: Indices) -> list[_Piece]:
    pieces = []
    order = np.argsort(sheets.label, kind="stable")
    for members in np.split(order, np.flatnonzero(np.diff(sheets.label[order])) + 1):
        used, inverse = np.unique(sheets.faces[members], return_inverse=True)
        faces = inverse.reshape(-1, 3)
        pieces.append(
            _Piece(
                sheets.vertices[used], faces, corners[members], boundary_loops(faces), sheets.cut[members].reshape(-1)
            )
        )
    return pieces


def _close(pieces: list[_Piece], size: float, thickness: float | None, repairs: list[str]) -> VolumeSource:
    """Close every piece in place; returns the boldest means that was needed."""
    source: VolumeSource = "closed surface"
    base = min(float(piece.vertices[:, 2].min()) for piece in pieces)
    reasons = {
        "small": "capped {} small holes",
        "cut": "closed {} cuts where pieces meet",
        "base": "closed the open base",
        "inside": "capped {} ends inside another piece",
    }
    done = dict.fromkeys(reasons, 0)
    for allowed in (("cut", "small", "base"), ("inside",)):
        closed = [piece for piece in pieces if not piece.loops]
        for piece in pieces:
            remaining = []
            for loop in piece.loops:
                why = _reason_to_cap(piece, loop, size, base, closed)
                if why is not None and why in allowed:
                    done[why] += 1
                    _cap(piece, loop)
                else:
                    remaining.append(loop)
            piece.loops = remaining
    for why, count in done.items():
        if count:
            repairs.append(reasons[why].format(count))
            source = "hole filled"
    open_pieces = [piece for piece in pieces if piece.loops]
    if 0 < len(open_pieces) <= MAX_OPEN:
        depth = thickness if thickness is not None else min(0.002, 0.02 * size)
        for piece in open_pieces:
            _thicken(piece, depth)
        repairs.append(f"gave {len(open_pieces)} open shells a thickness of {depth * 1e3:.3g} mm, inwards")
        source = "thickened shell"
    return source


def _reason_to_cap(piece: _Piece, loop: Indices, size: float, base: float, closed: list[_Piece]) -> str | None:
    rim = piece.vertices[piece.rim(loop)]
    if piece.cut[loop].all():
        return "cut"
    if np.ptp(rim, axis=0).max() <= SMALL_HOLE * size:
        return "small"
    height = float(np.ptp(piece.vertices[:, 2]))
    if height > 0 and rim[:, 2].max() <= base + 0.02 * height and piece.vertices[:, 2].mean() > base + 0.1 * height:
        return "base"
    sample = rim[:: max(1, len(rim) // 24)]
    for other in closed:
        low, high = other.vertices.min(axis=0), other.vertices.max(axis=0)
        if ((sample < low) | (sample > high)).any(axis=1).mean() > 0.1:
            continue
        if (np.abs(winding_number(sample, other.vertices, other.faces)) > 0.5).mean() >= 0.8:
            return "inside"
    return None


def _cap(piece: _Piece, loop: Indices) -> None:
    """Add faces that close a loop: a flat cap where it is flat, else a fan about its centre."""
    rim, corner = piece.rim(loop), piece.corners.reshape(-1)[loop]
    points = piece.vertices[rim]
    centre = points.mean(axis=0)
    _, spread, axes = np.linalg.svd(points - centre)
    triangles = None
    if len(rim) == 3:
        triangles = np.array([[0, 1, 2]])
    elif spread[2] <= 0.02 * spread[0]:
        flat = (points - centre) @ axes[:2].T
        area = np.sum(flat[:, 0] * np.roll(flat[:, 1], -1) - np.roll(flat[:, 0], -1) * flat[:, 1])
        order = np.arange(len(rim)) if area > 0 else np.arange(len(rim))[::-1]
        triangles = order[np.asarray(manifold3d.triangulate([flat[order]], allow_convex=True), dtype=np.int64)]
        if area < 0:
            triangles = triangles[:, ::-1]
        if len(triangles) != len(rim) - 2:
            triangles = None
    if triangles is None:
        around = np.arange(len(rim))
        triangles = np.stack([around, np.roll(around, -1), np.full(len(rim), len(rim))], axis=1)
        rim, corner = np.append(rim, len(piece.vertices)), np.append(corner, corner[0])
        piece.vertices = np.concatenate([piece.vertices, centre[None]])
    # The cap runs against the boundary, whose half-edges run with the faces.
    triangles = triangles[:, ::-1]
    piece.faces = np.concatenate([piece.faces, rim[triangles]])
    piece.corners = np.concatenate([piece.corners, corner[triangles]])
    piece.cut = np.concatenate([piece.cut, np.zeros(3 * len(triangles), dtype=bool)])


def _thicken(piece: _Piece, depth: float) -> None:
    """Turn an open shell into a wall of `depth` [m]: the shell outside, an offset copy inside."""
    trial = _Piece(piece.vertices, piece.faces, piece.corners, [], piece.cut)
    for loop in piece.loops:
        _cap(trial, loop)
    if signed_volume(trial.vertices, trial.faces) < 0.0:
        _reverse(piece)
    loops = boundary_loops(piece.faces)
    offset = _inward(piece, depth)
    count = len(piece.vertices)
    faces, sources = [piece.faces, piece.faces[:, ::-1] + count], [piece.corners, piece.corners[:, ::-1]]
    flat, flat_corners = piece.faces.reshape(-1), piece.corners.reshape(-1)
    for loop in loops:
        following = np.roll(loop, -1)
        a, b, ca, cb = flat[loop], flat[following], flat_corners[loop], flat_corners[following]
        faces += [np.stack([b, a, a + count], axis=1), np.stack([b, a + count, b + count], axis=1)]
        sources += [np.stack([cb, ca, ca], axis=1), np.stack([cb, ca, cb], axis=1)]
    piece.vertices = np.concatenate([piece.vertices, piece.vertices + offset])
    piece.faces, piece.corners, piece.loops = np.concatenate(faces), np.concatenate(sources), []


def _inward(piece: _Piece, depth: float) -> Points:
    """Offset of every vertex that moves the planes of its faces inwards by `depth` [m], shape (vertices, 3)."""
    corners = piece.vertices[piece.faces]
    weighted = area_vectors(corners)
    areas = np.linalg.norm(weighted, axis=1)
    normals = weighted / np.maximum(areas, 1e-300)[:, None]
    areas = areas + 1e-12 * areas.max()
    matrix, target, total = (
        np.zeros((len(piece.vertices), 3, 3)),
        np.zeros_like(piece.vertices),
        np.zeros(len(piece.vertices)),
    )
    for k in range(3):
        np.add.at(matrix, piece.faces[:, k], areas[:, None, None] * normals[:, :, None] * normals[:, None, :])
        np.add.at(target, piece.faces[:, k], areas[:, None] * normals)
        np.add.at(total, piece.faces[:, k], areas)
    values, axes = np.linalg.eigh(matrix / total[:, None, None])
    # Directions in which the faces hardly differ stay put.
    inverse = np.where(values > 0.02, 1.0 / np.maximum(values, 0.02), 0.0)
    offset = np.einsum("vij,vj,vkj,vk->vi", axes, inverse, axes, target / total[:, None])
    length = np.maximum(np.linalg.norm(offset, axis=1, keepdims=True), 1e-300)
    return -depth * offset * np.minimum(1.0, 3.0 / length)


def _reverse(piece: _Piece) -> None:
    piece.faces, piece.corners = piece.faces[:, ::-1].copy(), piece.corners[:, ::-1].copy()


def _solid_pieces(pieces: list[_Piece], size: float, repairs: list[str]) -> list[_Piece]:
    """Pieces that enclose a volume, largest first, bodies facing outwards and voids inwards."""
    volumes = [signed_volume(piece.vertices, piece.faces) for piece in pieces]
    solid = [k for k in np.argsort(-np.abs(volumes)) if abs(volumes[k]) > 1e-9 * size**3]
    if len(solid) < len(pieces):
        repairs.append(f"dropped {len(pieces) - len(solid)} pieces that enclose nothing")
    result: list[_Piece] = []
    outward: list[bool] = []
    reversed_count = 0
    for k in solid:
        piece, inside_out = pieces[k], volumes[k] < 0
        parent = next((j for j in reversed(range(len(result))) if _contains(result[j], piece)), None)
        # A piece inside another is a void if the two face opposite ways in the file.
        same = parent is None or outward[parent] != inside_out
        body = same if parent is None else _is_body(result[parent]) == same
        if body == inside_out:
            _reverse(piece)
            reversed_count += 1
        result.append(piece)
        outward.append(not inside_out)
    if reversed_count:
        repairs.append(f"turned {reversed_count} inside-out pieces")
    return result


def _is_body(piece: _Piece) -> bool:
    return signed_volume(piece.vertices, piece.faces) > 0


def _contains(outer: _Piece, inner: _Piece) -> bool:
    """Whether `inner` lies within `outer`, judged by a few of its vertices."""
    if (inner.vertices < outer.vertices.min(axis=0)).any() or (inner.vertices > outer.vertices.max(axis=0)).any():
        return False
    sample = inner.vertices[:: max(1, len(inner.vertices) // 8)]
    return bool((np.abs(winding_number(sample, outer.vertices, outer.faces)) > 0.5).all())


def manifold_of(vertices: Points, faces: Indices) -> manifold3d.Manifold | None:
    """The mesh as a manifold3d solid, or None where it is none."""
    solid = manifold3d.Manifold(
        manifold3d.Mesh64(
            # Copies: it takes no array that is read-only, as its own are.
            vert_properties=np.array(vertices, dtype=np.float64, order="C"),
            tri_verts=np.array(faces, dtype=np.uint64, order="C"),
        )
    )
    return None if solid.status() != manifold3d.Error.NoError or solid.is_empty() else solid


def solid_of(manifold: manifold3d.Manifold) -> Solid:
    """The surface of a manifold3d solid."""
    mesh = manifold.to_mesh64()
    return Solid(
        vertices=np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3],
        faces=np.asarray(mesh.tri_verts, dtype=np.int64),
    )


def _union(pieces: list[_Piece]) -> Solid | None:
    """Union of the bodies less the voids; None where a piece is no solid or nothing is left."""
    if not pieces:
        return None
    total = manifold3d.Manifold()
    for piece in pieces:
        body = _is_body(piece)
        solid = manifold_of(piece.vertices, piece.faces if body else piece.faces[:, ::-1])
        if solid is None:
            return None
        total = total + solid if body else total - solid
    if total.is_empty() or total.volume() <= 0:
        return None
    return solid_of(total) if len(pieces) > 1 else Solid(vertices=pieces[0].vertices, faces=pieces[0].faces)


def _nested(pieces: list[_Piece]) -> tuple[Solid, ...]:
    """One closed surface for each body, with the voids in it."""
    bodies = [piece for piece in pieces if _is_body(piece)]
    voids = [piece for piece in pieces if not _is_body(piece)]
    result = []
    for body in bodies:
        solid = manifold_of(body.vertices, body.faces)
        hollow = [void for void in voids if _contains(body, void)]
        if solid is None or not hollow:
            result.append(Solid(vertices=body.vertices, faces=body.faces))
            continue
        for void in hollow:
            inner = manifold_of(void.vertices, void.faces[:, ::-1])
            solid = solid if inner is None else solid - inner
        result.append(solid_of(solid))
    return tuple(result)
