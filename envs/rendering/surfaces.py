"""What is drawn of a MuJoCo model: triangles of every body in its own frame, with normals, colours and textures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.surroundings.furnishing import SHELL
from pat3d.envs.surroundings.skies import NAME
from pat3d.view.rays import RayScene

Array = NDArray[np.float32]

SHOWN_GROUPS = 3
"""Geoms of groups below this are drawn, as in MuJoCo's own renderer."""


@dataclass(frozen=True, eq=False)
class Body:
    """The drawn surfaces of one body in its own frame."""

    number: int
    corners: Array
    """Of every face [m], shape (faces, 3, 3)."""
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
    casts: bool = True
    """Whether it throws shadows; the shells of a room let the light in."""
    opacity: float = 1.0
    """Below 1 for what is seen through, which is a body of its own here."""

    @cached_property
    def scene(self) -> RayScene:
        """Its triangles for rays traced on the CPU."""
        return RayScene(self.corners)


class Surfaces:
    """The drawn surfaces of one model."""

    def __init__(self, model: Any) -> None:
        import mujoco

        self._mujoco, self._model = mujoco, model
        self.textures: dict[int, Array] = {}
        """Texels in [0, 1], shape (height, width, 3), by MuJoCo's number."""
        shell = np.array([model.geom(geom).name.startswith(SHELL) for geom in range(model.ngeom)])
        opacity = np.array([self._look(geom)[0][3] for geom in range(model.ngeom)])
        groups = [
            (number, False, float(one))
            for number in range(model.nbody)
            for one in np.unique(opacity[(model.geom_bodyid == number) & ~shell])[::-1]
        ]
        # The shells of a room come last: rays that something nearer stopped have less of them to search.
        groups += [(int(number), True, 1.0) for number in np.unique(model.geom_bodyid[shell])]
        self.bodies = [
            body
            for number, shells, one in groups
            for members in ((model.geom_bodyid == number) & (shell == shells) & (shells | (opacity == one)),)
            if (body := self._body(number, members, not shells, one)) is not None
        ]
        plane = int(self._mujoco.mjtGeom.mjGEOM_PLANE)
        self.planes = [
            geom
            for geom in range(model.ngeom)
            if model.geom_type[geom] == plane and model.geom_group[geom] < SHOWN_GROUPS
        ]
        """MuJoCo's geoms that are planes."""
        self.environment = _environment(model)
        """What is around everything, in [0, 1], shape (6, side, side, 3); None for a sky of one colour."""

    def _body(self, number: int, members: NDArray[np.bool_], casts: bool, opacity: float) -> Body | None:
        """The drawn triangles of those geoms of a body that are `members`; None where there are none."""
        model = self._model
        corners, normals, uvs, colours, textures, geoms = [], [], [], [], [], []
        for geom in np.flatnonzero(members).tolist():
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
        return Body(
            number=number,
            corners=points,
            centre=centre,
            radius=float(np.linalg.norm(flat - centre, axis=1).max()),
            normals=np.concatenate(normals).astype(np.float32),
            uv=np.concatenate(uvs).astype(np.float32),
            colour=np.concatenate(colours).astype(np.float32),
            texture=np.concatenate(textures),
            geom=np.concatenate(geoms),
            casts=casts,
            opacity=opacity,
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
        if texture >= 0 and texture not in self.textures:
            start, channels = model.tex_adr[texture], model.tex_nchannel[texture]
            shape = (model.tex_height[texture], model.tex_width[texture], channels)
            texels = model.tex_data[start : start + int(np.prod(shape))].reshape(shape)
            self.textures[texture] = (texels[..., :3] / 255.0).astype(np.float32)
        # A geom's own colour counts only where it was changed from the default grey.
        own = model.geom_rgba[geom]
        return (model.mat_rgba[material] if np.allclose(own, (0.5, 0.5, 0.5, 1.0)) else own), texture


def _environment(model: Any) -> Array | None:
    for number in range(model.ntex):
        if model.texture(number).name == NAME:
            side, channels, start = model.tex_width[number], model.tex_nchannel[number], model.tex_adr[number]
            texels = model.tex_data[start : start + 6 * side * side * channels].reshape(6, side, side, channels)
            return (texels[..., :3] / 255.0).astype(np.float32)
    return None
