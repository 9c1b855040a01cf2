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
from pat3d.view.rays import RayScene, pinhole_rays, unit
from pat3d.view.textures import nearest_texels

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
    scene: RayScene
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
        row, column = np.divmod(np.arange(width * height), width)
        looking = np.stack([axes[:, 0], axes[:, 1], -axes[:, 2]])
        rays, lengths = pinhole_rays(
            looking, column + 0.5, row + 0.5, width, height, float(self._model.cam_fovy[camera])
        )
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
        hits = body.scene.hits((eye - position) @ rotation, local, nearer=reach[near])
        if not len(hits.which):
            return
        face, which = hits.face, near[hits.which]
        normal = unit(hits.at(body.normals) @ rotation.T)
        facing = -np.einsum("ij,ij->i", normal, rays[which])
        normal *= np.where(facing < 0, -1.0, 1.0)[:, None].astype(np.float32)
        colour = body.colour[face].copy()
        uv = hits.at(body.uv)
        for number in np.unique(body.texture[face]).tolist():
            if number >= 0:
                members = np.flatnonzero(body.texture[face] == number)
                colour[members] *= nearest_texels(self._textures[number], uv[members])
        colours[which] = colour * _light(normal, np.abs(facing))[:, None]
        reach[which], geoms[which] = hits.distance, body.geom[face]

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
        points = np.ascontiguousarray(np.concatenate(corners), dtype=np.float32)
        flat = points.reshape(-1, 3)
        centre = (flat.min(axis=0) + flat.max(axis=0)) / 2.0
        return _Body(
            number=number,
            scene=RayScene(points),
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


def _light(normal: Array, facing: Array) -> Array:
    """Brightness of surfaces with unit `normal`, seen at a slope of `facing`; shape (n,)."""
    sun = np.maximum(normal @ (SUN / np.linalg.norm(SUN)), 0.0)
    sky = 0.5 + 0.5 * normal[:, 2]
    return (0.36 + 0.28 * sky + 0.48 * sun + 0.12 * facing).astype(np.float32)
