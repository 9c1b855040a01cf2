"""A renderer of MuJoCo models without any graphics library: one embree scene for every body, rays in its own frame.

Bodies are rigid, so their scenes are built once and a new pose costs nothing. Light is the model's. Observations have
no smooth edges, and shadows where they are asked for: a ray towards the sun from every point that is seen. Films
(`fine`) have both; several rays go through every pixel on the edge of something.

Every surface of see-through things that faces the eye is blended with what is behind it; depth and geoms are those of
the nearest one, and it throws shadows, as in MuJoCo's own renderer.
"""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import ThreadpoolController

from pat3d.envs.rendering.picture import Picture
from pat3d.envs.rendering.surfaces import Body, Surfaces
from pat3d.envs.surroundings.lights import FADES, FLOOR, Lights, sky_of, tint_of
from pat3d.envs.surroundings.skies import looked_up
from pat3d.view.rays import pinhole_rays, unit
from pat3d.view.textures import nearest_texels

Array = NDArray[np.float32]
Numbers = NDArray[np.int32]

TILE = 0.5
"""Side of the floor's tiles [m]."""

LIFTED = 1e-3
"""Points are so far above their surface when they look for the sun [m]."""

GRID = ((0.125, 0.625), (0.375, 0.125), (0.625, 0.875), (0.875, 0.375))
"""Where the rays go through a pixel on an edge, from its corner."""

LAYERS = 8
"""Surfaces of see-through things that a ray passes, at most."""

BEHIND = np.float32(2e-4)
"""How far behind such a surface a ray goes on [m]."""

STEP = 0.03
"""Neighbours whose distances differ by more than this share are on an edge."""


class _Seen(NamedTuple):
    """What rays meet first."""

    reach: Array
    """[m], infinite for the sky, shape (rays,)."""
    geom: Numbers
    """MuJoCo's, -1 for the sky, shape (rays,)."""
    part: Numbers
    """Number of the body among those drawn, -1 for the sky, -2 - k for plane k; shape (rays,)."""
    face: Numbers
    """Of the body, shape (rays,)."""
    weights: Array
    """Of the corners of that face, shape (rays, 3)."""

    def at(self, rays: NDArray[np.int64]) -> _Seen:
        """What some of the rays meet, shape (n,)."""
        return _Seen(self.reach[rays], self.geom[rays], self.part[rays], self.face[rays], self.weights[rays])


class RayTracer:
    """Draws one model."""

    def __init__(self, model: Any) -> None:
        self._model = model
        surfaces = Surfaces(model)
        self._bodies, self._planes, self._textures = surfaces.bodies, surfaces.planes, surfaces.textures
        self._environment = surfaces.environment
        self._panes = [number for number, body in enumerate(self._bodies) if body.opacity < 1.0]

    def draw(
        self,
        data: Any,
        camera: int,
        height: int,
        width: int,
        *,
        depth: bool,
        segmentation: bool,
        fine: bool = False,
        shadows: bool = False,
    ) -> Picture:
        """See Renderer."""
        # Rays times a 3 x 3 matrix are so little work that threads cost more than they save.
        with _pools().limit(limits=1, user_api="blas"):
            return self._draw(
                data, camera, height, width, depth=depth, segmentation=segmentation, fine=fine, shadows=shadows or fine
            )

    def _draw(
        self,
        data: Any,
        camera: int,
        height: int,
        width: int,
        *,
        depth: bool,
        segmentation: bool,
        fine: bool,
        shadows: bool,
    ) -> Picture:
        eye = data.cam_xpos[camera].astype(np.float32)
        axes = data.cam_xmat[camera].reshape(3, 3).astype(np.float32)
        row, column = np.divmod(np.arange(width * height), width)
        looking = np.stack([axes[:, 0], axes[:, 1], -axes[:, 2]])
        view = float(self._model.cam_fovy[camera])
        rays, lengths = pinhole_rays(looking, column + 0.5, row + 0.5, width, height, view)
        seen, colours, shaded = self._look(data, eye, rays, shadows=shadows)
        if fine:
            which = np.flatnonzero(_edges(seen, shaded, height, width))
            total = np.zeros((len(which), 3), dtype=np.float32)
            for x, y in GRID:
                more, _ = pinhole_rays(looking, column[which] + x, row[which] + y, width, height, view)
                total += self._look(data, eye, more, shadows=True)[1].clip(0.0, 1.0)
            colours[which] = total / np.float32(len(GRID))
        image = np.clip(colours * 255.0 + 0.5, 0, 255).astype(np.uint8).reshape(height, width, 3)
        far = self._model.vis.map.zfar * self._model.stat.extent
        return Picture(
            image=image,
            depth=np.minimum(seen.reach / lengths, far).astype(np.float32).reshape(height, width) if depth else None,
            geoms=seen.geom.reshape(height, width) if segmentation else None,
        )

    def close(self) -> None:
        """Free the triangles."""
        self._bodies = []

    def _look(self, data: Any, eye: Array, rays: Array, *, shadows: bool) -> tuple[_Seen, Array, NDArray[np.bool_]]:
        """What rays meet first, the colours there, shape (rays, 3), and which of what is solid lies in the shadow."""
        seen = self._trace(data, eye, rays)
        rows = np.flatnonzero(np.isin(seen.part, self._panes)) if self._panes else np.empty(0, dtype=np.int64)
        if not len(rows):
            return seen, *self._shade(data, eye, rays, seen, shadows=shadows)
        solid, panes = seen.at(np.arange(len(rays))), []
        for _ in range(LAYERS):
            front = solid.at(rows)
            panes.append((rows, front, self._opacity(data, rays[rows], front)))
            behind = self._trace(data, eye, rays[rows], front.reach + BEHIND)
            for one, values in zip(solid, behind, strict=True):
                one[rows] = values
            rows = rows[np.isin(behind.part, self._panes)]
            if not len(rows):
                break
        colours, shaded = self._shade(data, eye, rays, solid, shadows=shadows)
        for rows, front, opacity in reversed(panes):
            own, _ = self._shade(data, eye, rays[rows], front, shadows=shadows)
            under = colours[rows].clip(0.0, 1.0)
            colours[rows] = under + opacity[:, None] * (own.clip(0.0, 1.0) - under)
        return seen, colours, shaded

    def _opacity(self, data: Any, rays: Array, seen: _Seen) -> Array:
        """Opacity of see-through surfaces [-], 0 where they are seen from behind; shape (rays,)."""
        found = np.zeros(len(rays), dtype=np.float32)
        for number in np.unique(seen.part).tolist():
            which = np.flatnonzero(seen.part == number)
            body = self._bodies[number]
            corners = body.corners[seen.face[which]]
            outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            towards = np.einsum("ij,ij->i", outward, rays[which] @ _pose(data, body)[0]) < 0.0
            found[which] = np.where(towards, np.float32(body.opacity), 0.0)
        return found

    def _trace(self, data: Any, eye: Array, rays: Array, start: Array | None = None) -> _Seen:
        """What each ray from `eye`, shape (rays, 3), meets first, beyond `start` [m], shape (rays,), if given."""
        count = len(rays)
        seen = _Seen(
            reach=np.full(count, np.inf, dtype=np.float32),
            geom=np.full(count, -1, dtype=np.int32),
            part=np.full(count, -1, dtype=np.int32),
            face=np.zeros(count, dtype=np.int32),
            weights=np.zeros((count, 3), dtype=np.float32),
        )
        for number, body in enumerate(self._bodies):
            rotation, position = _pose(data, body)
            towards = rotation @ body.centre + position - eye
            along = rays @ towards
            meets = float(towards @ towards) - np.maximum(along, 0.0) ** 2 <= body.radius**2
            # Shells of a room, which come last, are behind all that stands in it.
            near = np.flatnonzero(meets if body.casts else meets & np.isinf(seen.reach))
            if not len(near):
                continue
            local = np.ascontiguousarray(rays[near] @ rotation)
            origin = ((eye - position) @ rotation).astype(np.float32)
            if start is None:
                hits, passed = body.scene.hits(origin, local, nearer=seen.reach[near]), np.float32(0.0)
            else:
                origins = origin + start[near, None] * local
                hits = body.scene.hits(origins, local, nearer=seen.reach[near] - start[near])
                passed = start[near[hits.which]]
            which = near[hits.which]
            seen.reach[which], seen.part[which], seen.face[which] = hits.distance + passed, number, hits.face
            seen.weights[which], seen.geom[which] = hits.weights, body.geom[hits.face]
        for number, geom in enumerate(self._planes):
            axis = data.geom_xmat[geom].reshape(3, 3)[:, 2].astype(np.float32)
            slope = rays @ axis
            with np.errstate(divide="ignore", invalid="ignore"):
                distance = ((data.geom_xpos[geom].astype(np.float32) - eye) @ axis) / slope
            first = 0.0 if start is None else start
            which = np.flatnonzero((slope < -1e-4) & (distance > first) & (distance < seen.reach))
            seen.reach[which], seen.part[which], seen.geom[which] = distance[which], -2 - number, geom
        return seen

    def _shade(
        self, data: Any, eye: Array, rays: Array, seen: _Seen, *, shadows: bool
    ) -> tuple[Array, NDArray[np.bool_]]:
        """Colours of what is seen, shape (rays, 3), and which of it lies in the shadow, shape (rays,)."""
        colours, lights = self._around(rays), Lights(self._model, data)
        shaded = np.zeros(len(rays), dtype=np.bool_)
        for number in np.unique(seen.part).tolist():
            which = np.flatnonzero(seen.part == number)
            if number >= 0:
                body = self._bodies[number]
                rotation, _ = _pose(data, body)
                face, weights = seen.face[which], seen.weights[which]
                normal = unit(np.einsum("ij,ijk->ik", weights, body.normals[face]) @ rotation.T)
                facing = -np.einsum("ij,ij->i", normal, rays[which])
                normal *= np.where(facing < 0, -1.0, 1.0)[:, None].astype(np.float32)
                if shadows:
                    shaded[which] = self._shadows(data, eye, rays[which], seen.reach[which], normal, lights.sun)
                colours[which] = self._paint(body, face, weights) * lights.on(normal, np.abs(facing), shaded[which])
            elif number < -1:
                geom = self._planes[-2 - number]
                axes = data.geom_xmat[geom].reshape(3, 3).astype(np.float32)
                normal = np.tile(axes[:, 2], (len(which), 1))
                if shadows:
                    shaded[which] = self._shadows(data, eye, rays[which], seen.reach[which], normal, lights.sun)
                light = lights.on(normal, np.abs(rays[which] @ axes[:, 2]), shaded[which])
                colours[which] = self._floor(data, geom, eye, rays[which], seen.reach[which], light)
        return colours, shaded

    def _around(self, rays: Array) -> Array:
        """Colours of what is behind everything, shape (rays, 3)."""
        if self._environment is None:
            return np.tile(sky_of(self._model), (len(rays), 1))
        return looked_up(self._environment, rays)

    def _paint(self, body: Body, face: Numbers, weights: Array) -> Array:
        """Colours of faces of a body where they are hit, shape (m, 3)."""
        colour = body.colour[face].copy()
        texture = body.texture[face]
        for number in np.unique(texture).tolist():
            if number >= 0:
                members = np.flatnonzero(texture == number)
                uv = np.einsum("ij,ijk->ik", weights[members], body.uv[face[members]])
                colour[members] *= nearest_texels(self._textures[number], uv)
        return colour

    def _floor(self, data: Any, geom: int, eye: Array, rays: Array, reach: Array, light: Array) -> Array:
        """Colours of a plane where it is hit, shape (m, 3)."""
        axes = data.geom_xmat[geom].reshape(3, 3).astype(np.float32)
        point = (eye + reach[:, None] * rays - data.geom_xpos[geom].astype(np.float32)) @ axes
        tiles = (np.floor(point[:, 0] / TILE) + np.floor(point[:, 1] / TILE)) % 2
        colour = np.where(tiles[:, None] > 0, *np.array(FLOOR, dtype=np.float32)) * tint_of(self._model, geom) * light
        near, far = FADES
        fade = np.clip((reach - near) / (far - near), 0.0, 1.0)[:, None]
        return (colour * (1.0 - fade) + sky_of(self._model) * fade).astype(np.float32)

    def _shadows(
        self, data: Any, eye: Array, rays: Array, reach: Array, normal: Array, sun: Array | None
    ) -> NDArray[np.bool_]:
        """Whether something stands between the `sun` and the points at `reach` [m] along `rays`; they face `normal`."""
        if sun is None:
            return np.zeros(len(rays), dtype=np.bool_)
        # What is turned away from the sun gets no light from it anyway.
        lit = np.flatnonzero(normal @ sun > 0.0)
        points = eye + reach[lit, None] * rays[lit] + LIFTED * normal[lit]
        hidden = np.zeros(len(lit), dtype=np.bool_)
        for body in self._bodies:
            if not body.casts:
                continue
            rotation, position = _pose(data, body)
            away = rotation @ body.centre + position - points
            along = away @ sun
            beside = np.einsum("ij,ij->i", away, away) - np.maximum(along, 0.0) ** 2 <= body.radius**2
            near = np.flatnonzero(beside & ~hidden)
            if len(near):
                origins = np.ascontiguousarray((points[near] - position) @ rotation, dtype=np.float32)
                directions = np.tile(sun @ rotation, (len(near), 1))
                hidden[near] = body.scene.occluded(origins, np.ascontiguousarray(directions))
        found = np.zeros(len(rays), dtype=np.bool_)
        found[lit] = hidden
        return found


@functools.lru_cache(maxsize=1)
def _pools() -> ThreadpoolController:
    """The thread pools of this process, which take a while to find."""
    return ThreadpoolController()


def _pose(data: Any, body: Body) -> tuple[Array, Array]:
    """Rotation and position [m] of a body."""
    return data.xmat[body.number].reshape(3, 3).astype(np.float32), data.xpos[body.number].astype(np.float32)


def _edges(seen: _Seen, shaded: NDArray[np.bool_], height: int, width: int) -> NDArray[np.bool_]:
    """Pixels beside which something else is seen, much nearer or further, or shadow begins; shape (pixels,)."""
    geom, shadow = seen.geom.reshape(height, width), shaded.reshape(height, width)
    reach = np.where(np.isfinite(seen.reach), seen.reach, 0.0).reshape(height, width)
    found = np.zeros((height, width), dtype=np.bool_)
    for here, there in (
        (np.s_[:, :-1], np.s_[:, 1:]),
        (np.s_[:-1], np.s_[1:]),
    ):
        differ = (geom[here] != geom[there]) | (shadow[here] != shadow[there])
        differ |= np.abs(reach[here] - reach[there]) > STEP * np.maximum(reach[here], reach[there])
        found[here] |= differ
        found[there] |= differ
    return found.reshape(-1)
