"""From a recipe's coloured shapes to an asset: union, colours, mass, regions, frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import manifold3d
import numpy as np

from pat3d.assets.asset import Asset, Material, Region, VisualMesh
from pat3d.assets.catalogue.registry import RGB, Build
from pat3d.assets.hull import convex_part
from pat3d.assets.mass import mass_properties
from pat3d.assets.seams import close_seams
from pat3d.assets.shapes import Shape
from pat3d.errors import AssetError


def assemble(noun: str, build: Build, *, material: Material, scale: float, provenance: Mapping[str, Any]) -> Asset:
    """Join a recipe's shapes into an asset standing on z = 0 with its footprint centred.

    Raises:
        AssetError: the recipe's solids do not join into a closed mesh.
    """
    union, colour_of = manifold3d.Manifold(), {}
    for shape, colour in build.parts:
        original = shape.solid.as_original()
        colour_of[original.original_id()] = colour
        union = union + original
    if union.status() != manifold3d.Error.NoError or union.is_empty():
        raise AssetError(f'recipe "{noun}" does not join into a solid: {union.status()}.')
    mesh_vertices, faces, colours = _painted(noun, union, colour_of, build.paint)
    points = np.concatenate([hull for shape, _ in build.parts for hull in shape.hulls])
    low, high = points.min(axis=0), points.max(axis=0)
    origin = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    vertices = (mesh_vertices - origin) * scale
    hulls = tuple(convex_part((hull - origin) * scale) for shape, _ in build.parts for hull in shape.hulls)
    size = (high - low) * scale
    regions = tuple(_placed(region, origin, scale) for region in build.regions) or (top_of_box(size),)
    if not any(region.kind == "on" for region in regions):
        regions = (*regions, top_of_box(size))
    density = None if build.mass is not None else material.density
    mass = None if build.mass is None else build.mass * scale**3
    return Asset(
        noun=noun,
        visual=VisualMesh.from_face_colours(vertices, faces, colours),
        parts=hulls,
        mass_properties=mass_properties(vertices, faces, density=density, mass=mass),
        material=material,
        regions=regions,
        provenance=provenance,
    )


def top_of_box(size: np.ndarray) -> Region:
    """The top of a bounding box of `size` [m], shape (3,), as a place to put things on."""
    return Region(
        kind="on",
        shape="rectangle",
        floor=(0.0, 0.0, float(size[2])),
        half_size=(float(size[0]) / 2, float(size[1]) / 2),
    )


def _placed(region: Region, origin: np.ndarray, scale: float) -> Region:
    floor = tuple(float(value) for value in (np.array(region.floor) - origin) * scale)
    return replace(
        region,
        floor=floor,
        half_size=(region.half_size[0] * scale, region.half_size[1] * scale),
        height=region.height * scale,
    )


def _painted(noun: str, union: manifold3d.Manifold, colour_of: dict[int, RGB], paint: tuple[tuple[Shape, RGB], ...]):
    """The surface of `union` with face colours, split along the borders of the painted volumes."""
    pieces: list[tuple[manifold3d.Manifold, RGB | None]] = [(union, None)]
    for shape, colour in paint:
        pieces = [
            half
            for solid, old in pieces
            for half in ((solid - shape.solid, old), (solid ^ shape.solid, colour))
            if not half[0].is_empty()
        ]
    corners, colours = [], []
    for solid, override in pieces:
        mesh = solid.to_mesh64()
        points = np.asarray(mesh.vert_properties)[:, :3]
        triangles = np.asarray(mesh.tri_verts, dtype=np.int64)
        bounds = np.asarray(mesh.run_index) // 3
        for original, start, stop in zip(mesh.run_original_id, bounds, bounds[1:], strict=False):
            # Faces of the painting volumes themselves are the cuts, not the surface.
            if original in colour_of:
                corners.append(points[triangles[start:stop]])
                colours.append(np.tile(np.array(override or colour_of[original], dtype=np.uint8), (stop - start, 1)))
    soup = np.concatenate(corners)
    flat = soup.reshape(-1, 3)
    # Both sides of a cut compute its vertices to rounding; a micrometre joins them.
    _, first, inverse = np.unique(
        np.round(flat / 1e-6).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    faces = inverse.reshape(-1, 3)
    kept = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces, source = close_seams(flat[first], faces[kept].astype(np.int32))
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    if np.any(np.unique(edges, axis=0, return_counts=True)[1] % 2):
        raise AssetError(f'the painted surface of recipe "{noun}" is not closed.')
    return flat[first], faces, np.concatenate(colours)[kept][source]
