"""Pictures of placed meshes, ray traced on the CPU without any graphics library.

Embree finds what the rays hit; numpy does the rest. A pixel costs one view ray, and only pixels at
an edge (of an object, a crease, a colour) are refined with more.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SpecError
from pat3d.view import light
from pat3d.view.camera import Camera, frame
from pat3d.view.denoise import smooth
from pat3d.view.geometry import Geometry, Item
from pat3d.view.panes import SHADE, Pane, peeled
from pat3d.view.tone import compress, quantise

Array = NDArray[np.float32]

LARGEST_PICTURE = 8192
"""Longest side of a picture [pixel]."""
_BACKGROUND, _GROUND = -1, 0


def frame_items(items: Sequence[Item], *, aspect: float = 4.0 / 3.0, **options: float) -> Camera:
    """The automatic camera for `items`; `options` are those of `pat3d.view.camera.frame`."""
    _check(items)
    return frame(np.concatenate([pose.apply(mesh.vertices) for mesh, pose, *_ in items]), aspect=aspect, **options)


def render(
    items: Sequence[Item],
    *,
    camera: Camera | None = None,
    width: int = 960,
    height: int = 720,
    samples: int = 8,
    ground: float | None = 0.0,
    seed: int = 0,
) -> NDArray[np.uint8]:
    """Draw meshes at their poses.

    Args:
        items: what to draw: meshes, where they are, and their opacity where they are not solid.
        camera: from where; None frames everything from the front right.
        width: of the picture [pixel].
        height: of the picture [pixel].
        samples: rays for each pixel at an edge; 1 leaves edges jagged.
        ground: height of the ground [m], or None for none.
        seed: of the light samples; the same arguments give the same picture, bit for bit.

    Returns:
        RGB, row 0 at the top, shape (height, width, 3).

    Raises:
        SpecError: there is nothing to draw or a size is out of range.
    """
    _check(items)
    if not (8 <= width <= LARGEST_PICTURE and 8 <= height <= LARGEST_PICTURE and 1 <= samples <= 64):
        raise SpecError(
            f"a picture is 8 to {LARGEST_PICTURE} pixels wide and high with 1 to 64 samples; "
            f"got {width} x {height}, {samples}."
        )
    view = _View(items, camera or frame_items(items, aspect=width / height), width, height, ground)
    row, column = np.divmod(np.arange(width * height, dtype=np.int32), np.int32(width))
    surfaces = view.surfaces(column + np.float32(0.5), row + np.float32(0.5))
    lit = view.lighting(surfaces, light.tile_places(row, column), seed)
    picture = compress(view.colours(surfaces, lit))
    edge = np.flatnonzero(_edges(surfaces, picture, width, height, view.pixel))
    if samples > 1 and len(edge):
        picture[edge] = _refined(view, surfaces, lit, edge, samples)
    return quantise(picture, row, column).reshape(height, width, 3)


def _check(items: Sequence[Item]) -> None:
    if not items:
        raise SpecError("there is nothing to draw: a picture needs at least one mesh.")
    for index, (mesh, *_) in enumerate(items):
        if len(mesh.faces) == 0 or not np.all(np.isfinite(mesh.vertices)):
            raise SpecError(f"mesh {index} of the picture has no triangles or vertices that are not finite.")


@dataclass(frozen=True, eq=False)
class _Surfaces:
    """What each of n view rays sees."""

    what: NDArray[np.int32]
    """-1 background, 0 ground, otherwise 1 + index of the item; shape (n,)."""
    ray: Array
    """View directions, shape (n, 3)."""
    distance: Array
    """[m], shape (n,)."""
    point: Array
    """[m], shape (n, 3)."""
    start: Array
    """Where light rays begin [m], shape (n, 3)."""
    normal: Array
    """Shading normals, shape (n, 3)."""
    colour: Array
    """Linear RGB; of the ground and background as they appear without shadows, shape (n, 3)."""
    panes: tuple[Pane, ...]
    """See-through surfaces before all this, the nearest first."""


class _View:
    """One camera on one set of placed meshes."""

    def __init__(self, items: Sequence[Item], camera: Camera, width: int, height: int, ground: float | None) -> None:
        self.geometry = Geometry(items)
        self.camera, self.width, self.height = camera, width, height
        self.studio = light.Studio.facing(camera.axes)
        self.pixel = 2.0 * math.tan(math.radians(camera.field_of_view) / 2.0) / height
        self.eye = (np.array(camera.position) - self.geometry.origin).astype(np.float32)
        self.ground = None if ground is None else float(ground - self.geometry.origin[2])
        self.gap = np.float32(max(2e-5 * self.geometry.radius, 2e-6 * float(np.linalg.norm(self.eye))))

    def surfaces(self, x: Array, y: Array) -> _Surfaces:
        """What is seen through picture points [pixel], shapes (n,)."""
        ray = self.camera.directions(x, y, self.width, self.height)
        count = len(ray)
        hits, panes = peeled(self.geometry, self.eye, ray, self.pixel)
        what = np.full(count, _BACKGROUND, dtype=np.int32)
        distance = np.full(count, np.inf, dtype=np.float32)
        what[hits.which], distance[hits.which] = hits.item + 1, hits.distance
        point = np.zeros((count, 3), dtype=np.float32)
        normal = np.zeros((count, 3), dtype=np.float32)
        normal[:, 2] = 1.0
        point[hits.which], normal[hits.which] = hits.point, hits.normal
        start = point.copy()
        start[hits.which] = hits.outside + self.gap * hits.flat
        colour = np.empty((count, 3), dtype=np.float32)
        colour[:] = light.BACKDROP_COLOUR
        if self.ground is not None and self.eye[2] > self.ground:
            down = np.flatnonzero(ray[:, 2] < -1e-4)
            reach = (self.ground - self.eye[2]) / ray[down, 2]
            seen = reach < distance[down]
            down, reach = down[seen], reach[seen]
            what[down], distance[down] = _GROUND, reach
            point[down] = self.eye + reach[:, None] * ray[down]
            point[down, 2] = self.ground
            normal[down] = (0.0, 0.0, 1.0)
            start[down] = point[down]
            start[down, 2] += self.gap
            radii = np.hypot(point[down, 0], point[down, 1]) / np.float32(max(self.geometry.radius, 1e-6))
            colour[down] = light.backdrop(radii.astype(np.float32, copy=False))
        seen = what[hits.which] > 0
        colour[hits.which[seen]] = hits.colour[seen]
        return _Surfaces(what, ray, distance, point, start, normal, colour, panes)

    def lighting(self, surfaces: _Surfaces, tile: NDArray[np.int32], seed: int) -> Array:
        """Sky and bounce irradiance RGB and the visible fraction of the key light, smoothed; shape (n, 4)."""
        lit = self._lit_by(self.geometry, surfaces, tile, seed)
        if self.geometry.see_through:
            solid = [self.geometry.items[index] for index in np.flatnonzero(self.geometry.opacity == 1.0).tolist()]
            clear = self._lit_by(Geometry(solid) if solid else None, surfaces, tile, seed)
            lit = (clear + np.float32(SHADE) * (lit - clear)).astype(np.float32, copy=False)
        shape = (self.height, self.width)
        return smooth(
            lit.reshape(*shape, 4),
            surfaces.what.reshape(shape),
            surfaces.point.reshape(*shape, 3),
            surfaces.normal.reshape(*shape, 3),
            (surfaces.distance * np.float32(self.pixel)).reshape(shape),
        ).reshape(-1, 4)

    def _lit_by(self, geometry: Geometry | None, surfaces: _Surfaces, tile: NDArray[np.int32], seed: int) -> Array:
        """Light with `geometry` in its way, or nothing, not smoothed; shape (n, 4)."""
        lit = np.empty((len(tile), 4), dtype=np.float32)
        lit[:, :3], lit[:, 3] = self.studio.open_sky, 1.0
        if geometry is None:
            return lit
        near = np.flatnonzero(self._reached(surfaces))
        moved = (self.geometry.origin - geometry.origin).astype(np.float32)
        start, normal, tiles = surfaces.start[near] + moved, surfaces.normal[near], tile[near]
        ground = None if self.ground is None else self.ground + float(moved[2])
        lit[near, 3] = light.key_visibility(geometry, self.studio, start, normal, tiles, seed)
        face_light = light.bounce(geometry, self.studio)
        lit[near, :3] = light.sky_light(geometry, self.studio, face_light, ground, start, normal, tiles, seed)
        return lit

    def _reached(self, surfaces: _Surfaces) -> NDArray[np.bool_]:
        """Pixels whose light the meshes can change: all of theirs, and the ground around them."""
        reached = surfaces.what > 0
        ground = np.flatnonzero(surfaces.what == _GROUND)
        radius = np.float32(self.geometry.radius)
        offset = surfaces.point[ground]
        distance2 = np.einsum("ij,ij->i", offset, offset)
        along = np.maximum(-offset @ self.studio.key_direction, 0.0)
        beside2 = distance2 - along * along
        shadow = beside2 < (radius * 1.02 + self.studio.key_spread * along) ** 2
        # Beyond six radii the meshes hide less of the sky than a grey level.
        reached[ground] = shadow | (distance2 < (6.0 * radius) ** 2)
        return reached

    def colours(self, surfaces: _Surfaces, lit: Array) -> Array:
        """Light that reaches the camera, linear RGB, shape (n, 3)."""
        studio = self.studio
        colour = surfaces.colour.copy()
        ground = np.flatnonzero(surfaces.what == _GROUND)
        key_up = studio.key * studio.key_direction[2]
        # More than the sky that is hidden is taken away: contacts must read on a ground this bright.
        openness = np.clip(lit[ground, :3] / studio.open_sky, 0.0, 1.1) ** 1.7
        arriving = openness * studio.open_sky + key_up * lit[ground, 3:]
        colour[ground] *= np.minimum(arriving / (studio.open_sky + key_up), 1.05)
        mesh = np.flatnonzero(surfaces.what > 0)
        normal, ray, sky = surfaces.normal[mesh], surfaces.ray[mesh], lit[mesh, :3]
        key = np.maximum(normal @ studio.key_direction, 0.0) * lit[mesh, 3]
        fill = np.maximum(0.25 + 0.75 * (normal @ studio.fill_direction), 0.0)
        openness = np.minimum(sky.mean(axis=1) / studio.open_sky.mean(), 1.0)
        diffuse = sky + key[:, None] * studio.key + (fill * openness)[:, None] * studio.fill
        # A faint varnish: Schlick's reflectance of a sky that is brightest overhead, and a broad highlight of the
        # key light. It gives black things their shape.
        towards = np.einsum("ij,ij->i", normal, ray)
        overhead = ray[:, 2] - 2.0 * towards * normal[:, 2]
        mirror = (0.035 + 0.14 * (1.0 - np.clip(-towards, 0.0, 1.0)) ** 5) * (1.0 + 0.6 * overhead)
        half = studio.key_direction - ray
        half /= np.linalg.norm(half, axis=1)[:, None]
        glint = 0.16 * np.maximum(np.einsum("ij,ij->i", normal, half), 0.0) ** 48 * lit[mesh, 3]
        gloss = (mirror * openness)[:, None] * studio.open_sky + glint[:, None] * studio.key
        colour[mesh] = colour[mesh] * diffuse + gloss
        for pane in reversed(surfaces.panes):
            pane.over(colour, studio)
        return colour


def _edges(surfaces: _Surfaces, picture: Array, width: int, height: int, pixel: float) -> NDArray[np.bool_]:
    """Pixels that differ from a neighbour in object, orientation, depth or colour, shape (n,)."""
    shape = (height, width)
    what, reach = surfaces.what.reshape(shape), (surfaces.distance * np.float32(pixel)).reshape(shape)
    normal, point = surfaces.normal.reshape(*shape, 3), surfaces.point.reshape(*shape, 3)
    shade = np.sqrt(picture).reshape(*shape, 3)
    edge = np.zeros(shape, dtype=bool)
    for axis in (0, 1):
        here = (slice(None),) * axis + (slice(None, -1),)
        there = (slice(None),) * axis + (slice(1, None),)
        n, m, step = normal[here], normal[there], point[there] - point[here]
        differs = what[here] != what[there]
        differs |= n[..., 0] * m[..., 0] + n[..., 1] * m[..., 1] + n[..., 2] * m[..., 2] < 0.9
        away = np.abs(n[..., 0] * step[..., 0] + n[..., 1] * step[..., 1] + n[..., 2] * step[..., 2])
        differs |= (away > 2.0 * reach[here]) & (what[here] > 0)
        contrast = np.abs(shade[here] - shade[there])
        differs |= np.maximum(np.maximum(contrast[..., 0], contrast[..., 1]), contrast[..., 2]) > 0.06
        edge[here] |= differs
        edge[there] |= differs
    return edge.reshape(-1)


def _refined(
    view: _View, surfaces: _Surfaces, lit: Array, edge: NDArray[np.int64], samples: int, batch: int = 1 << 18
) -> Array:
    """Colours of pixels `edge` averaged over `samples` points each, shape (len(edge), 3)."""
    # Points of the plastic-number sequence: evenly spread for any count.
    step = np.array([0.7548776662466927, 0.5698402909980532])
    points = ((0.5 + np.arange(1, samples + 1)[:, None] * step) % 1.0).astype(np.float32)
    mean = np.zeros((len(edge), 3), dtype=np.float32)
    chunk = max(batch // samples, 1)
    for first in range(0, len(edge), chunk):
        pixels = edge[first : first + chunk]
        row, column = np.divmod(pixels.repeat(samples), view.width)
        offset = np.tile(points, (len(pixels), 1))
        fine = view.surfaces((column + offset[:, 0]).astype(np.float32), (row + offset[:, 1]).astype(np.float32))
        known = _nearest_lighting(view, surfaces, lit, fine, row, column)
        colours = compress(view.colours(fine, known))
        mean[first : first + chunk] = colours.reshape(len(pixels), samples, 3).mean(axis=1)
    return mean


def _nearest_lighting(
    view: _View, surfaces: _Surfaces, lit: Array, fine: _Surfaces, row: NDArray[np.int64], column: NDArray[np.int64]
) -> Array:
    """Lighting of fine rays from the most alike of the 3 x 3 pixels around each, shape (n, 4)."""
    best = np.full(len(row), np.inf, dtype=np.float32)
    source = row * view.width + column
    size = fine.distance * np.float32(view.pixel)
    for i in (0, -1, 1):
        for j in (0, -1, 1):
            other = np.clip(row + i, 0, view.height - 1) * view.width + np.clip(column + j, 0, view.width - 1)
            turn = 1.0 - np.einsum("ij,ij->i", fine.normal, surfaces.normal[other])
            step = surfaces.point[other] - fine.point
            apart = np.sqrt(np.einsum("ij,ij->i", step, step)) / size
            penalty = 4.0 * turn + 0.05 * apart + 100.0 * (surfaces.what[other] != fine.what)
            closer = penalty < best
            best[closer], source[closer] = penalty[closer], other[closer]
    return lit[source]
