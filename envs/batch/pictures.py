"""Pictures of many worlds at once: the ray tracer of `pat3d.envs.rendering.raytrace` as a Warp kernel, a thread a ray.

The surfaces, the light and the rays are those of the single environment, so the pictures are too, to `TOLERANCE`.
MuJoCo Warp's own renderer has another light, and knows neither the floor's tiles nor where the sky begins.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.envs.batch.rays import ACROSS, DOWN, Drawn, bound, draw
from pat3d.envs.observations import LARGEST_DEPTH, ObservationSpec
from pat3d.envs.physics.lights import Lights, sky_of, tint_of
from pat3d.envs.physics.world import ROBOT, World
from pat3d.envs.rendering.surfaces import Body, Surfaces

TOLERANCE = 0.5
"""Mean over a picture by which the colours of the two ray tracers differ [of 255]; rays that graze edges do."""


@dataclass(frozen=True, eq=False)
class _Faces:
    """Bodies that look the same are on the device once."""

    mesh: wp.Mesh
    first: int


class BatchedPictures:
    """What cameras see of many worlds, which are copies of one or of several.

    World k looks like `worlds[k % len(worlds)]`.

    Args:
        worlds: the different ones.
        bodies: of each, the number in `data` of every body of its own model.
        cameras: of each, the number in its own model of every camera of `spec`; `data` has them in this order.
        spec: of the observations.
        data: MuJoCo Warp's, of all worlds.
    """

    def __init__(
        self,
        worlds: Sequence[World],
        bodies: Sequence[NDArray[np.int64]],
        cameras: Sequence[int],
        spec: ObservationSpec,
        data: Any,
    ) -> None:
        self._spec, self._data, self._cameras = spec, data, tuple(cameras)
        self._device = data.qpos.device
        with wp.ScopedDevice(self._device):
            self._drawn, self._meshes = _drawn(worlds, bodies)
            count, shape = data.nworld, (spec.height, spec.width)
            self._spheres = wp.zeros((count, self._drawn.body.shape[1]), dtype=wp.vec4)
            self._optics = [_optics(worlds, name, spec.height) for name in spec.cameras]
            self.arrays: dict[str, wp.array] = {}
            """The latest pictures, on the device, by the names of the observations."""
            self._targets = []
            for camera in spec.cameras:
                image = wp.zeros((count, *shape, 3), dtype=wp.uint8)
                depth = wp.zeros((count if spec.kind == "rgbd" else 0, *shape), dtype=float)
                labels = wp.zeros((count if spec.segmentation else 0, *shape), dtype=wp.uint16)
                self._targets.append((image, depth, labels))
                self.arrays[f"{camera}_image"] = image
                if spec.kind == "rgbd":
                    self.arrays[f"{camera}_depth"] = depth
                if spec.segmentation:
                    self.arrays[f"{camera}_segmentation"] = labels

    def draw(self) -> None:
        """Take all pictures of the present positions; they are in `arrays`."""
        data, spec = self._data, self._spec
        pixels = -(-spec.width // ACROSS) * ACROSS * -(-spec.height // DOWN) * DOWN
        with wp.ScopedDevice(self._device):
            wp.launch(bound, self._spheres.shape, [self._drawn, data.xpos, data.xmat, self._spheres])
            for camera, optics, targets in zip(self._cameras, self._optics, self._targets, strict=True):
                wp.launch(
                    draw,
                    (data.nworld, pixels),
                    [
                        self._drawn, self._spheres, data.xpos, data.xmat, data.cam_xpos, data.cam_xmat, camera,
                        *optics, *targets,
                    ],
                )  # fmt: skip

    def take(self) -> dict[str, NDArray[Any]]:
        """The pictures of the present positions, as observations have them, the world first."""
        self.draw()
        seen = {}
        for name, array in self.arrays.items():
            # On a CPU that is the array itself, which the next pictures overwrite.
            values = array.numpy() if self._device.is_cuda else array.numpy().copy()
            if name.endswith("_depth"):
                values = np.clip(values, 0.0, LARGEST_DEPTH)
            seen[name] = values if values.ndim == 4 else values[..., None]
        return seen


def _optics(worlds: Sequence[World], camera: str, height: int) -> tuple[wp.array, wp.array]:
    """Size of a pixel in a picture at distance 1, and the greatest depth [m], of every kind of world."""
    scale, far = [], []
    for world in worlds:
        model = world.model
        angle = float(model.cam_fovy[model.camera(camera).id])
        scale.append(2.0 * math.tan(math.radians(angle) / 2.0) / height)
        far.append(float(model.vis.map.zfar * model.stat.extent))
    return wp.array(scale, dtype=float), wp.array(far, dtype=float)


def _drawn(worlds: Sequence[World], bodies: Sequence[NDArray[np.int64]]) -> tuple[Drawn, list[wp.Mesh]]:
    """The surfaces of all worlds on the present device, and the meshes, which kernels know by number alone."""
    import mujoco

    known: dict[bytes, _Faces] = {}
    images: dict[bytes, int] = {}
    texels: list[NDArray[np.float32]] = []
    about: list[tuple[int, int, int]] = []
    faces: dict[str, list[NDArray[Any]]] = {"normals": [], "uv": [], "colour": [], "texture": [], "part": []}
    count = 0
    rows: list[list[tuple[int, _Faces, Body, int]]] = []
    labels: list[list[int]] = []
    planes: list[list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]]] = []
    for world, numbers in zip(worlds, bodies, strict=True):
        surfaces, row = Surfaces(world.model), []
        for body in surfaces.bodies:
            texture = np.full(len(body.texture), -1, dtype=np.int32)
            for number in np.unique(body.texture[body.texture >= 0]).tolist():
                values = surfaces.textures[number]
                key = values.tobytes()
                if key not in images:
                    images[key] = len(about)
                    about.append((sum(len(one) for one in texels), values.shape[0], values.shape[1]))
                    texels.append(values.reshape(-1, 3))
                texture[body.texture == number] = images[key]
            first = int(body.geom.min())
            looks = (body.corners, body.normals, body.uv, body.colour, texture, body.geom - first)
            key = b"".join(one.tobytes() for one in looks)
            if key not in known:
                points = wp.array(body.corners.reshape(-1, 3), dtype=wp.vec3)
                mesh = wp.Mesh(points=points, indices=wp.array(np.arange(len(points), dtype=np.int32)))
                known[key] = _Faces(mesh, count)
                count += len(body.corners)
                for name, values in (("normals", body.normals), ("uv", body.uv), ("colour", body.colour)):
                    faces[name].append(values.reshape(-1, values.shape[-1]))
                faces["texture"].append(texture)
                faces["part"].append(body.geom - first)
            row.append((int(numbers[body.number]), known[key], body, first))
        rows.append(row)
        labels.append(np.where(world.owner >= 0, world.owner + 2, world.owner == ROBOT).tolist())
        model, data = world.model, mujoco.MjData(world.model)
        mujoco.mj_forward(model, data)
        planes.append(
            [
                (data.geom_xmat[geom].reshape(3, 3).copy(), data.geom_xpos[geom].copy(), tint_of(model, geom))
                for geom in surfaces.planes
            ]
        )
    most, flat = max(map(len, rows)), max(map(len, planes))
    drawn: Any = Drawn()
    drawn.body = _table([[one[0] for one in row] for row in rows], most, -1, int)
    drawn.mesh = _table([[one[1].mesh.id for one in row] for row in rows], most, 0, wp.uint64)
    drawn.centre = _table([[one[2].centre for one in row] for row in rows], most, (0.0,) * 3, wp.vec3)
    drawn.radius = _table([[one[2].radius for one in row] for row in rows], most, 0.0, float)
    drawn.geom = _table([[one[3] for one in row] for row in rows], most, 0, int)
    drawn.label = _table(labels, max(map(len, labels)), 0, int)
    drawn.first = _table([[one[1].first for one in row] for row in rows], most, 0, int)
    drawn.normals = wp.array(np.concatenate(faces["normals"]), dtype=wp.vec3)
    drawn.uv = wp.array(np.concatenate(faces["uv"]), dtype=wp.vec2)
    drawn.colour = wp.array(np.concatenate(faces["colour"]), dtype=wp.vec3)
    drawn.texture = wp.array(np.concatenate(faces["texture"]), dtype=int)
    drawn.part = wp.array(np.concatenate(faces["part"]), dtype=int)
    drawn.texels = wp.array(np.concatenate([*texels, np.zeros((1, 3), np.float32)]), dtype=wp.vec3)
    drawn.image = wp.array(np.array([*about, (0, 1, 1)], dtype=np.int32), dtype=wp.vec3i)
    drawn.planes = _table([[one[0] for one in row] for row in planes], flat, np.zeros((3, 3)), wp.mat33)
    drawn.place = _table([[one[1] for one in row] for row in planes], flat, (0.0,) * 3, wp.vec3)
    drawn.tint = _table([[one[2] for one in row] for row in planes], flat, (0.0,) * 3, wp.vec3)
    model, data = worlds[0].model, mujoco.MjData(worlds[0].model)
    mujoco.mj_forward(model, data)
    lights = Lights(model, data)
    drawn.sky, drawn.ambient, drawn.lamp = wp.vec3(*sky_of(model)), wp.vec3(*lights.ambient), wp.vec3(*lights.lamp)
    drawn.towards = wp.array(lights.towards, dtype=wp.vec3)
    drawn.diffuse = wp.array(lights.diffuse, dtype=wp.vec3)
    return drawn, [one.mesh for one in known.values()]


def _table(rows: Sequence[Sequence[Any]], width: int, nothing: Any, kind: Any) -> wp.array:
    """Rows of different lengths as one array, filled up with `nothing`."""
    filled = np.array([[*row, *[nothing] * (width - len(row))] for row in rows])
    return wp.array(filled, dtype=kind, ndim=2) if width else wp.zeros((len(rows), 0), dtype=kind)
