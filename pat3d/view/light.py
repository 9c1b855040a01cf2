"""Lighting of every picture: a soft key light, a fill, ambient occlusion of a bright sky with one bounce, and a ground.

Light is measured so that a white diffuse surface in 1.0 appears white. Sky and bounce light are
gathered with a few rays a pixel. The rays come from one low-discrepancy set dealt to tiles of 8 x 8 pixels (the key
light: 4 x 4), so that averaging over a tile along the surface uses all of the set and leaves no grain.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from pat3d.view.geometry import Geometry
from pat3d.view.tone import decode

TILE_PLACES = 64
"""Pixels of the tile that shares one sample set."""
SKY_RAYS = 4
"""Rays towards sky and neighbours per pixel."""
KEY_RAYS = 8
"""Rays towards the key light per pixel."""

Array = NDArray[np.float32]


def _unit(x: float, y: float, z: float) -> Array:
    vector = np.array([x, y, z])
    return (vector / np.linalg.norm(vector)).astype(np.float32)


@dataclass(frozen=True, eq=False)
class Studio:
    """Lights and backdrop, fixed in the camera's frame so that every view is lit alike."""

    key_direction: Array
    """Unit vector towards the key light, shape (3,)."""
    fill_direction: Array
    """Unit vector towards the fill light, shape (3,)."""
    key: Array
    """Irradiance of a surface that faces the key light, RGB."""
    fill: Array
    """Irradiance of a surface that faces the fill light, RGB; it casts no shadow."""
    zenith: Array
    """Radiance of the sky overhead, RGB."""
    horizon: Array
    """Radiance of the sky at the horizon, RGB."""
    key_spread: float = 0.13
    """Radius of the key light over its distance: the softness of shadows."""

    @staticmethod
    def facing(axes: NDArray[np.float64]) -> Studio:
        """The studio for a camera with rows right, up, forward in `axes`, shape (3, 3)."""
        right = np.array([axes[0, 0], axes[0, 1], 0.0])
        right /= max(float(np.linalg.norm(right)), 1e-9)
        back = np.cross(right, (0.0, 0.0, 1.0))
        key = -0.70 * right + 0.36 * back + np.array([0.0, 0.0, 1.0])
        fill = 0.85 * right + 0.45 * back + np.array([0.0, 0.0, 0.35])
        return Studio(
            key_direction=_unit(*key),
            fill_direction=_unit(*fill),
            key=np.array([1.04, 0.99, 0.91], dtype=np.float32),
            fill=np.array([0.10, 0.11, 0.12], dtype=np.float32),
            zenith=np.array([0.315, 0.33, 0.35], dtype=np.float32),
            horizon=np.array([0.37, 0.375, 0.38], dtype=np.float32),
        )

    def sky(self, height: Array) -> Array:
        """Radiance of the sky towards unit vectors with z = `height`, shape (n,) -> (n, 3)."""
        blend = np.clip(height, 0.0, 1.0)[:, None]
        return (self.horizon + blend * (self.zenith - self.horizon)).astype(np.float32, copy=False)

    @property
    def open_sky(self) -> Array:
        """Irradiance of a horizontal surface under the whole sky, RGB: the mean of `sky` over cosine-weighted rays."""
        return (self.horizon + (2.0 / 3.0) * (self.zenith - self.horizon)).astype(np.float32)


GROUND_COLOUR: Array = decode(np.array([0.945, 0.94, 0.93]))
"""Linear RGB of the lit ground near the scene."""
BACKDROP_COLOUR: Array = decode(np.array([0.865, 0.875, 0.885]))
"""Linear RGB that the ground fades into."""


def backdrop(distance: Array) -> Array:
    """Colour of the unshadowed ground at `distance` from the scene's middle, in scene radii; shape (n,) -> (n, 3)."""
    blend = np.clip((distance - 0.6) / 9.0, 0.0, 1.0)
    blend = (1.0 - (1.0 - blend) ** 3)[:, None]
    return (GROUND_COLOUR + blend * (BACKDROP_COLOUR - GROUND_COLOUR)).astype(np.float32)


def tile_places(row: NDArray[np.int32], column: NDArray[np.int32]) -> NDArray[np.int32]:
    """Place of pixels in their tile of 8 x 8, 0 to 63; modulo 16 the place in a tile of 4 x 4.

    Neighbours are far apart in the count (the order of a 4 x 4 dither matrix), as they are in what they sample.
    """
    dither = np.array([0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5], dtype=np.int32)
    quarter = (row // 4 % 2) * 2 + column // 4 % 2
    return (quarter * 16 + dither[(row % 4) * 4 + column % 4]).astype(np.int32)


@cache
def sample_set(places: int, rays: int, seed: int) -> Array:
    """A scrambled (0, 2)-sequence dealt to the places of a tile; shape (places, rays, 2), values in [0, 1).

    Every place gets a consecutive block, which is itself evenly spread when `rays` is a power of two.
    """
    count = places * rays
    index = np.arange(count, dtype=np.uint64)
    first, second = np.zeros(count, dtype=np.uint64), np.zeros(count, dtype=np.uint64)
    direction = np.uint64(1 << 31)
    for bit in range(32):
        on = (index >> np.uint64(bit)) & np.uint64(1)
        first ^= on << np.uint64(31 - bit)
        second ^= on * direction
        direction ^= direction >> np.uint64(1)
    scramble = np.random.default_rng(seed).integers(0, 1 << 32, size=2, dtype=np.uint64)
    points = (np.stack([first ^ scramble[0], second ^ scramble[1]], axis=1) + 0.5) / 2.0**32
    return points.reshape(places, rays, 2).astype(np.float32)


def around(direction: Array, local: Array) -> Array:
    """Vectors given in frames whose z axes are `direction`; both of shape (n, 3), in the world's axes afterwards.

    The frame of each unit vector is the branchless one of Duff et al. 2017.
    """
    x, y, z = direction[:, 0], direction[:, 1], direction[:, 2]
    sign = np.where(z >= 0.0, 1.0, -1.0).astype(np.float32)
    a = -1.0 / (sign + z)
    b = x * y * a
    u, v, w = local[:, 0], local[:, 1], local[:, 2]
    out = np.empty_like(direction)
    out[:, 0] = u * (1.0 + sign * x * x * a) + v * b + w * x
    out[:, 1] = u * (sign * b) + v * (sign + y * y * a) + w * y
    out[:, 2] = u * (-sign * x) + v * (-y) + w * z
    return out


def key_visibility(
    geometry: Geometry, studio: Studio, points: Array, normals: Array, tile: NDArray[np.int32], seed: int
) -> Array:
    """Visible fraction of the key light.

    Args:
        geometry: what casts shadows.
        studio: where the light is.
        points: just off the surface [m], shape (n, 3).
        normals: surface normals, shape (n, 3).
        tile: `tile_places` of each pixel, shape (n,).
        seed: of the sample set.
    """
    seen = np.zeros(len(points), dtype=np.float32)
    facing = np.flatnonzero(normals @ studio.key_direction > -0.05)
    samples = sample_set(TILE_PLACES // 4, KEY_RAYS, seed)
    lamp = np.broadcast_to(studio.key_direction, (len(samples), 3))
    for k in range(KEY_RAYS):
        radius = np.sqrt(samples[:, k, 0]) * studio.key_spread
        angle = 2.0 * np.pi * samples[:, k, 1]
        local = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.ones_like(radius)], axis=1)
        rays = around(lamp.astype(np.float32), local.astype(np.float32))
        rays /= np.linalg.norm(rays, axis=1)[:, None]
        seen[facing] += ~geometry.occluded(points[facing], rays[tile[facing] % len(rays)])
    return seen / np.float32(KEY_RAYS)


def sky_light(
    geometry: Geometry,
    studio: Studio,
    face_light: Array,
    ground: float | None,
    points: Array,
    normals: Array,
    tile: NDArray[np.int32],
    seed: int,
) -> Array:
    """Irradiance from the sky and, by one bounce, from the ground and other surfaces.

    Args:
        geometry: what hides the sky.
        studio: the sky.
        face_light: radiance that every triangle sends back, shape (faces, 3).
        ground: height of the ground plane [m] in the geometry's frame, or None.
        points: just off the surface [m], shape (n, 3).
        normals: unit normals, shape (n, 3).
        tile: `tile_places` of each pixel, shape (n,).
        seed: of the sample set.

    Returns:
        RGB, shape (n, 3).
    """
    total = np.zeros((len(points), 3), dtype=np.float32)
    samples = sample_set(TILE_PLACES, SKY_RAYS, seed + 1)
    near = np.float32(max(0.35 * geometry.radius, 1e-6))
    floor_light = GROUND_COLOUR * studio.open_sky * 1.6
    for k in range(SKY_RAYS):
        radius, angle = np.sqrt(samples[:, k, 0]), 2.0 * np.pi * samples[:, k, 1]
        height = np.sqrt(np.maximum(1.0 - radius * radius, 0.0))
        local = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1).astype(np.float32)
        rays = around(normals, local[tile])
        face, _ = geometry.first_faces(points, rays)
        light = studio.sky(rays[:, 2])
        if ground is not None:
            down = np.flatnonzero((face < 0) & (rays[:, 2] < -1e-4))
            # The ground right under an object lies in its shadow; further away it is lit.
            reach = (ground - points[down, 2]) / rays[down, 2] / near
            open_ground = np.clip(0.3 + 0.7 * reach, 0.3, 1.0)[:, None]
            light[down] = floor_light * open_ground
        hit = np.flatnonzero(face >= 0)
        light[hit] = face_light[face[hit]]
        total += light
    return total / np.float32(SKY_RAYS)


def bounce(geometry: Geometry, studio: Studio) -> Array:
    """Radiance that every triangle sends back into the scene, RGB, shape (faces, 3).

    Whether the triangle itself lies in shadow is not known; half of the key light stands for that.
    """
    facing = np.maximum(geometry.face_normals @ studio.key_direction, 0.0)[:, None]
    around_it = studio.open_sky * (0.45 + 0.25 * geometry.face_normals[:, 2:3])
    return (geometry.face_colours * (0.5 * facing * studio.key + around_it)).astype(np.float32)
