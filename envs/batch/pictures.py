"""Pictures of many worlds at once: the ray tracer of `pat3d.envs.rendering.raytrace` as a Warp kernel, a thread a ray.

The surfaces, the light and the rays are those of the single environment, so the pictures are too, to `TOLERANCE`.
MuJoCo Warp's own renderer has another light, and knows neither the floor's tiles nor where the sky begins.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, cast

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.envs.batch.rays import ACROSS, DOWN, Drawn, bound, draw
from pat3d.envs.observations import LARGEST_DEPTH, ObservationSpec
from pat3d.envs.physics.world import ROBOT, World
from pat3d.envs.rendering.surfaces import Body, Surfaces
from pat3d.envs.surroundings.lights import Lights, sky_of, tint_of

TOLERANCE = 0.5
"""Mean over a picture by which the colours of the two ray tracers differ [of 255]; rays that graze edges do."""


class _Library:
    """Bodies and textures of all worlds one after the other; what looks the same is there once."""

    def __init__(self) -> None:
        self.meshes: list[wp.Mesh] = []
        self._known: dict[bytes, tuple[wp.Mesh, int]] = {}
        self._images: dict[bytes, int] = {}
        self._texels: list[NDArray[np.float32]] = [np.zeros((1, 3), dtype=np.float32)]
        self._about: list[tuple[int, int, int]] = [(0, 1, 1)]
        self._faces: dict[str, list[NDArray[Any]]] = {}
        self._count = 0

    def add(self, body: Body, textures: dict[int, NDArray[np.float32]]) -> tuple[wp.Mesh, int]:
        """The mesh of a body, and its first face among all."""
        texture = np.full(len(body.texture), -1, dtype=np.int32)
        for number in np.unique(body.texture[body.texture >= 0]).tolist():
            texture[body.texture == number] = self.image(textures[number])
        part = body.geom - body.geom.min()
        looks = (body.corners, body.normals, body.uv, body.colour, texture, part)
        key = b"".join(one.tobytes() for one in looks)
        if key not in self._known:
            points = wp.array(body.corners.reshape(-1, 3), dtype=wp.vec3)
            mesh = wp.Mesh(points=points, indices=wp.array(np.arange(len(points), dtype=np.int32)))
            self.meshes.append(mesh)
            self._known[key] = mesh, self._count
            self._count += len(body.corners)
            for name, values in (
                ("normals", body.normals.reshape(-1, 3)),
                ("uv", body.uv.reshape(-1, 2)),
                ("colour", body.colour),
                ("texture", texture),
                ("part", part),
            ):
                self._faces.setdefault(name, []).append(values)
        return self._known[key]

    def image(self, values: NDArray[np.float32]) -> int:
        key = values.tobytes()
        if key not in self._images:
            self._images[key] = len(self._about)
            self._about.append((sum(map(len, self._texels)), values.shape[0], values.shape[1]))
            self._texels.append(values.reshape(-1, 3))
        return self._images[key]

    def fill(self, drawn: Any) -> None:
        """Put all of it on the present device."""
        kinds = {"normals": wp.vec3, "uv": wp.vec2, "colour": wp.vec3, "texture": int, "part": int}
        for name, kind in kinds.items():
            setattr(drawn, name, wp.array(np.concatenate(self._faces[name]), dtype=kind))
        drawn.texels = wp.array(np.concatenate(self._texels), dtype=wp.vec3)
        drawn.image = wp.array(np.array(self._about, dtype=np.int32), dtype=wp.vec3i)


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
            self._drawn, self._meshes = _drawn(worlds, bodies, spec.shadows)
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


def _drawn(worlds: Sequence[World], bodies: Sequence[NDArray[np.int64]], shadows: bool) -> tuple[Any, list[wp.Mesh]]:
    """The surfaces of all worlds on the present device, and the meshes, which kernels know by number alone."""
    import mujoco

    library, drawn = _Library(), cast(Any, Drawn)()
    rows, planes, labels, skies, lamps, harmonics = [], [], [], [], [], []
    for world, numbers in zip(worlds, bodies, strict=True):
        model, data = world.model, mujoco.MjData(world.model)
        mujoco.mj_forward(model, data)
        surfaces = Surfaces(model)
        rows.append(
            [
                (
                    int(numbers[body.number]),
                    body.centre,
                    body.radius,
                    int(body.geom.min()),
                    mesh.id,
                    first,
                    body.casts,
                    body.opacity,
                )
                for body in surfaces.bodies
                for mesh, first in (library.add(body, surfaces.textures),)
            ]
        )
        planes.append(
            [
                (data.geom_xmat[geom].reshape(3, 3).copy(), data.geom_xpos[geom].copy(), tint_of(model, geom))
                for geom in surfaces.planes
            ]
        )
        labels.append([(label,) for label in np.where(world.owner >= 0, world.owner + 2, world.owner == ROBOT)])
        lights = Lights(model, data)
        cube = surfaces.environment
        around = -1 if cube is None else library.image(cube.reshape(-1, cube.shape[2], 3))
        sun = int(np.argmax(lights.casts)) if shadows and lights.casts.any() else -1
        skies.append([(sky_of(model), around, lights.ambient, lights.lamp, sun)])
        harmonics.append([(one,) for one in (() if lights.harmonics is None else lights.harmonics)])
        lamps.append(list(zip(lights.towards, lights.diffuse, lights.casts, strict=True)))
    library.fill(drawn)
    nowhere = np.zeros(3)
    tables: tuple[tuple[list[Any], tuple[tuple[str, Any, Any], ...]], ...] = (
        (
            rows,
            (
                ("body", int, -1),
                ("centre", wp.vec3, nowhere),
                ("radius", float, 0.0),
                ("geom", int, 0),
                ("mesh", wp.uint64, 0),
                ("first", int, 0),
                ("casts", int, 0),
                ("opacity", float, 1.0),
            ),
        ),
        (planes, (("planes", wp.mat33, np.zeros((3, 3))), ("place", wp.vec3, nowhere), ("tint", wp.vec3, nowhere))),
        (labels, (("label", int, 0),)),
        (
            skies,
            (
                ("sky", wp.vec3, nowhere),
                ("around", int, -1),
                ("ambient", wp.vec3, nowhere),
                ("lamp", wp.vec3, nowhere),
                ("sun", int, -1),
            ),
        ),
        (harmonics, (("harmonics", wp.vec3, nowhere),)),
        (lamps, (("towards", wp.vec3, nowhere), ("diffuse", wp.vec3, nowhere), ("shading", int, 0))),
    )
    for table, columns in tables:
        width = max(map(len, table))
        for column, (name, kind, nothing) in enumerate(columns):
            filled = [[*(one[column] for one in row), *[nothing] * (width - len(row))] for row in table]
            values = wp.array(np.array(filled), dtype=kind, ndim=2) if width else wp.zeros((len(table), 0), dtype=kind)
            setattr(drawn, name, values)
    return drawn, library.meshes
