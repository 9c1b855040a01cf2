"""A renderer of MuJoCo models without any graphics library: one embree scene for every body, rays in its own frame.

Bodies are rigid, so their scenes are built once and a new pose costs nothing. Light is a sun, a sky and a lamp at the
camera; there are no shadows.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.rendering.picture import Picture

Array = NDArray[np.float32]

SHOWN_GROUPS = 3
"""Geoms of groups below this are drawn, as in MuJoCo's own renderer."""

SUN = np.array([0.35, -0.45, 0.82], dtype=np.float32)
"""Direction of the light."""

SKY = np.array([0.83, 0.88, 0.93], dtype=np.float32)
TILE = 0.5
"""Side of the floor's tiles [m]."""


@dataclass(frozen=True, eq=False)
class _Body:
    """The drawn surfaces of one body in its own frame."""

    number: int
    scene: Any
    mesh: Any
    """Keeps the triangles alive, to which the scene has no reference of its own."""
    centre: Array
    radius: float
    normals: Array
    """Of every corner, shape (faces, 3, 3)."""
    uv: Array
    """Of every corner, shape (faces, 3, 2)."""
    colour: Array
    """Of every face, in [0, 1], shape (faces, 3)."""
    texture: NDArray[np.int32]
    """Of every face, -1 for none, shape (faces,)."""
    geom: NDArray[np.int32]
    """Of every face, shape (faces,)."""


class RayTracer:
    """Draws one model."""

    def __init__(self, model: Any) -> None:
        import mujoco

        self._mujoco = mujoco
        self._model = model
        self._textures: dict[int, Array] = {}
        self._bodies = [body for number in range(model.nbody) if (body := self._body(number)) is not None]
        plane = int(self._mujoco.mjtGeom.mjGEOM_PLANE)
        self._planes = [
            geom
            for geom in range(model.ngeom)
            if model.geom_type[geom] == plane and model.geom_group[geom] < SHOWN_GROUPS
        ]

    def draw(self, data: Any, camera: int, height: int, width: int, *, depth: bool, segmentation: bool) -> Picture:
        """What `camera` sees: with depth and geoms where they are asked for."""
        eye = data.cam_xpos[camera].astype(np.float32)
        axes = data.cam_xmat[camera].reshape(3, 3).astype(np.float32)
        half = np.tan(np.radians(self._model.cam_fovy[camera]) / 2.0)
        x = (np.arange(width) + 0.5 - width / 2.0) * (2.0 * half / height)
        y = (height / 2.0 - np.arange(height) - 0.5) * (2.0 * half / height)
        flat = np.stack(np.broadcast_arrays(x[None, :], y[:, None], np.array([[-1.0]])), axis=-1).reshape(-1, 3)
        lengths = np.linalg.norm(flat, axis=1).astype(np.float32)
        rays = (flat.astype(np.float32) / lengths[:, None]) @ axes.T
        colours = np.tile(SKY, (len(rays), 1))
        reach = np.full(len(rays), np.inf, dtype=np.float32)
        geoms = np.full(len(rays), -1, dtype=np.int32)
        for geom in self._planes:
            self._see_plane(data, geom, eye, rays, reach, colours, geoms)
        for body in self._bodies:
            self._see_body(data, body, eye, rays, reach, colours, geoms)
        image = np.clip(colours * 255.0 + 0.5, 0, 255).astype(np.uint8).reshape(height, width, 3)
        far = self._model.vis.map.zfar * self._model.stat.extent
        return Picture(
            image=image,
            depth=np.minimum(reach / lengths, far).astype(np.float32).reshape(height, width) if depth else None,
            geoms=geoms.reshape(height, width) if segmentation else None,
        )

    def close(self) -> None:
        """Free the triangles."""
        self._bodies = []

    def _see_body(
        self, data: Any, body: _Body, eye: Array, rays: Array, reach: Array, colours: Array, geoms: NDArray[np.int32]
    ) -> None:
        rotation = data.xmat[body.number].reshape(3, 3).astype(np.float32)
        position = data.xpos[body.number].astype(np.float32)
        towards = rotation @ body.centre + position - eye
        along = rays @ towards
        near = np.flatnonzero(float(towards @ towards) - np.maximum(along, 0.0) ** 2 <= body.radius**2)
        if not len(near):
            return
        local = np.ascontiguousarray(rays[near] @ rotation)
        start = np.tile((eye - position) @ rotation, (len(near), 1)).astype(np.float32)
        found = body.scene.run(start, local, output=1)
        hit = np.flatnonzero((found["primID"] >= 0) & (found["tfar"] < reach[near]))
        if not len(hit):
            return
        face, which = found["primID"][hit], near[hit]
        weights = np.stack([1.0 - found["u"][hit] - found["v"][hit], found["u"][hit], found["v"][hit]], axis=1)
        normal = np.einsum("ij,ijk->ik", weights, body.normals[face]) @ rotation.T
        normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-12)[:, None]
        facing = -np.einsum("ij,ij->i", normal, rays[which])
        normal *= np.where(facing < 0, -1.0, 1.0)[:, None].astype(np.float32)
        colour = body.colour[face].copy()
        for number in np.unique(body.texture[face]).tolist():
            if number >= 0:
                members = np.flatnonzero(body.texture[face] == number)
                uv = np.einsum("ij,ijk->ik", weights[members], body.uv[face[members]])
                colour[members] *= self._texel(number, uv)
        colours[which] = colour * _light(normal, np.abs(facing))[:, None]
        reach[which], geoms[which] = found["tfar"][hit], body.geom[face]

    def _see_plane(
        self, data: Any, geom: int, eye: Array, rays: Array, reach: Array, colours: Array, geoms: NDArray[np.int32]
    ) -> None:
        position = data.geom_xpos[geom].astype(np.float32)
        axes = data.geom_xmat[geom].reshape(3, 3).astype(np.float32)
        slope = rays @ axes[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = ((position - eye) @ axes[:, 2]) / slope
        which = np.flatnonzero((slope < -1e-4) & (distance > 0) & (distance < reach))
        point = (eye + distance[which, None] * rays[which] - position) @ axes
        tiles = (np.floor(point[:, 0] / TILE) + np.floor(point[:, 1] / TILE)) % 2
        shade = np.where(tiles > 0, 0.80, 0.74)[:, None] * np.array([1.0, 0.99, 0.96], dtype=np.float32)
        # The floor fades into the sky.
        fade = np.clip(distance[which] / 12.0, 0.0, 1.0)[:, None]
        colours[which] = shade * (1.0 - fade) + SKY * fade
        reach[which], geoms[which] = distance[which], geom

    def _body(self, number: int) -> _Body | None:
        """The drawn triangles of a body; None where there are none."""
        model = self._model
        corners, normals, uvs, colours, textures, geoms = [], [], [], [], [], []
        for geom in np.flatnonzero(model.geom_bodyid == number).tolist():
            if model.geom_group[geom] >= SHOWN_GROUPS:
                continue
            shape = self._triangles(geom)
            colour, texture = self._look(geom)
            if shape is None or colour[3] < 0.1:
                continue
            rotation = np.zeros(9)
            self._mujoco.mju_quat2Mat(rotation, model.geom_quat[geom])
            turned = rotation.reshape(3, 3).T
            corners.append(shape[0] @ turned + model.geom_pos[geom])
            normals.append(shape[1] @ turned)
            uvs.append(shape[2])
            count = len(shape[0])
            colours.append(np.tile(colour[:3], (count, 1)))
            textures.append(np.full(count, texture, dtype=np.int32))
            geoms.append(np.full(count, geom, dtype=np.int32))
        if not corners:
            return None
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        points = np.ascontiguousarray(np.concatenate(corners), dtype=np.float32)
        flat = points.reshape(-1, 3)
        centre = (flat.min(axis=0) + flat.max(axis=0)) / 2.0
        scene = EmbreeScene()
        return _Body(
            number=number,
            scene=scene,
            mesh=TriangleMesh(scene, points),
            centre=centre,
            radius=float(np.linalg.norm(flat - centre, axis=1).max()),
            normals=np.concatenate(normals).astype(np.float32),
            uv=np.concatenate(uvs).astype(np.float32),
            colour=np.concatenate(colours).astype(np.float32),
            texture=np.concatenate(textures),
            geom=np.concatenate(geoms),
        )

    def _triangles(self, geom: int) -> tuple[Any, Any, Any] | None:
        """Corners [m], corner normals and corner uv of a geom in its own frame; None for shapes that are not drawn."""
        model, kinds = self._model, self._mujoco.mjtGeom
        kind, size = model.geom_type[geom], model.geom_size[geom]
        if kind == kinds.mjGEOM_MESH:
            return self._mesh(int(model.geom_dataid[geom]))
        import trimesh

        if kind == kinds.mjGEOM_BOX:
            mesh: Any = trimesh.creation.box(extents=2 * size)
        elif kind == kinds.mjGEOM_CYLINDER:
            mesh = trimesh.creation.cylinder(radius=size[0], height=2 * size[1], sections=48)
        elif kind == kinds.mjGEOM_CAPSULE:
            mesh = trimesh.creation.capsule(radius=size[0], height=2 * size[1])
        elif kind in (kinds.mjGEOM_SPHERE, kinds.mjGEOM_ELLIPSOID):
            mesh = trimesh.creation.icosphere(subdivisions=3)
            mesh.apply_scale(size[0] if kind == kinds.mjGEOM_SPHERE else size)
        else:
            return None
        corners = np.asarray(mesh.vertices)[np.asarray(mesh.faces)]
        return corners, np.repeat(np.asarray(mesh.face_normals)[:, None], 3, axis=1), np.zeros((len(corners), 3, 2))

    def _mesh(self, mesh: int) -> tuple[Any, Any, Any]:
        model = self._model
        faces = slice(model.mesh_faceadr[mesh], model.mesh_faceadr[mesh] + model.mesh_facenum[mesh])
        corners = model.mesh_vert[model.mesh_vertadr[mesh] + model.mesh_face[faces]]
        normals = model.mesh_normal[model.mesh_normaladr[mesh] + model.mesh_facenormal[faces]]
        if model.mesh_texcoordadr[mesh] >= 0:
            uv = model.mesh_texcoord[model.mesh_texcoordadr[mesh] + model.mesh_facetexcoord[faces]]
        else:
            uv = np.zeros((*corners.shape[:2], 2))
        return corners, normals, uv

    def _look(self, geom: int) -> tuple[Array, int]:
        """Colour (RGBA in [0, 1]) and texture, -1 for none, of a geom."""
        model = self._model
        material = int(model.geom_matid[geom])
        if material < 0:
            return model.geom_rgba[geom], -1
        texture = int(model.mat_texid[material][self._mujoco.mjtTextureRole.mjTEXROLE_RGB])
        if texture >= 0 and texture not in self._textures:
            start, channels = model.tex_adr[texture], model.tex_nchannel[texture]
            shape = (model.tex_height[texture], model.tex_width[texture], channels)
            texels = model.tex_data[start : start + int(np.prod(shape))].reshape(shape)
            self._textures[texture] = (texels[..., :3] / 255.0).astype(np.float32)
        # A geom's own colour counts only where it was changed from the default grey.
        own = model.geom_rgba[geom]
        return (model.mat_rgba[material] if np.allclose(own, (0.5, 0.5, 0.5, 1.0)) else own), texture

    def _texel(self, texture: int, uv: Array) -> Array:
        """Nearest texels, shape (n, 3); v is as MuJoCo stores it, from the top of the image."""
        image = self._textures[texture]
        row = np.clip((uv[:, 1] % 1.0) * image.shape[0], 0, image.shape[0] - 1).astype(np.int64)
        column = np.clip((uv[:, 0] % 1.0) * image.shape[1], 0, image.shape[1] - 1).astype(np.int64)
        return image[row, column]


def _light(normal: Array, facing: Array) -> Array:
    """Brightness of surfaces with unit `normal`, seen at a slope of `facing`; shape (n,)."""
    sun = np.maximum(normal @ (SUN / np.linalg.norm(SUN)), 0.0)
    sky = 0.5 + 0.5 * normal[:, 2]
    return (0.36 + 0.28 * sky + 0.48 * sun + 0.12 * facing).astype(np.float32)
