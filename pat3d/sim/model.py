"""The static description of one or many worlds of affine bodies.

All worlds live in flat arrays: body b belongs to world `body_world[b]`, and within its world a free
body owns the twelve unknowns from 12 * `body_dof[b]` on. A point with rest position xbar (about the centre of
mass) sits at x = p + xbar_1 a_1 + xbar_2 a_2 + xbar_3 a_3, where q = (p, a_1, a_2, a_3) is the body's state
and a_j are the columns of its affine map (Lan et al. 2022, Affine Body Dynamics).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.errors import SimulationError
from pat3d.geometry.edges import sharp_edges
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.normals import enclosed_volume
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.model import Scene
from pat3d.scene.physics import GRAVITY
from pat3d.sim.arrays import Bodies, Vertices, filled
from pat3d.sim.clusters import ClusteredPart, cluster
from pat3d.sim.startup import quiet_warp

ATTACHMENT_STRETCH = 5.0e-7
"""How far an attachment point gives way under the weight of the lighter of the two bodies that it joins [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Model:
    """Worlds of affine bodies; constant while they move."""

    device: str
    worlds: int
    body_world: wp.array
    """World of every body, shape (bodies,), int."""
    body_dof: wp.array
    """Index of every body among the free bodies of its world, -1 where fixed, shape (bodies,), int."""
    body_mass: wp.array
    """[kg], shape (bodies,), float64."""
    body_moment: wp.array
    """Second moment of mass about the centre of mass [kg m^2], shape (bodies,), mat33d."""
    body_volume: wp.array
    """[m^3], shape (bodies,), float64."""
    vertex_rest: wp.array
    """Rest positions about the body's centre of mass [m], shape (vertices,), vec3d."""
    vertex_body: wp.array
    """shape (vertices,), int."""
    edges: wp.array
    """Vertex indices of edges that are not inside a flat facet, shape (edges,), vec2i."""
    triangles: wp.array
    """Vertex indices, shape (triangles,), vec3i."""
    part_body: wp.array
    """shape (parts,), int."""
    part_ranges: wp.array
    """First and past-last vertex, edge, triangle and cluster of every part, shape (parts, 8), int."""
    cluster_ranges: wp.array
    """First and past-last vertex, edge, triangle and entry of `halo` of every cluster, shape (clusters, 8), int.

    Detailed parts consist of several clusters, others are one.
    """
    halo: wp.array
    """Vertices of other clusters that a cluster's edges and triangles reach, shape (reached,), int."""
    part_pairs: wp.array
    """Parts that can ever touch: same world, different bodies, not both fixed; shape (pairs,), vec2i."""
    attachment_bodies: wp.array
    """The two bodies that share an attachment point, shape (attachments,), vec2i."""
    attachment_rest: wp.array
    """Where the attachment point is on either, about its centre of mass [m], shape (attachments, 2), vec3d."""
    attachment_stiffness: wp.array
    """[N/m], shape (attachments,), float64."""
    free_bodies: NDArray[np.int64]
    """Number of free bodies per world, shape (worlds,)."""
    world_of: NDArray[np.int64]
    """`body_world` on the host, shape (bodies,)."""
    is_free: NDArray[np.bool_]
    """Whether a body has degrees of freedom, shape (bodies,)."""
    weight: NDArray[np.float64]
    """Weight of the heaviest free body per world [N], shape (worlds,)."""
    body_radius: NDArray[np.float64]
    """Largest distance of a body's vertices from its centre of mass [m], shape (bodies,)."""
    q0: NDArray[np.float64]
    """Initial states, shape (bodies, 4, 3)."""
    labels: tuple[str, ...]
    """What error messages call the bodies."""
    centres: NDArray[np.float64]
    """Centres of mass in the frames the bodies were given in [m], shape (bodies, 3)."""

    @property
    def bodies(self) -> int:
        """Number of bodies in all worlds."""
        return len(self.body_world)

    @cached_property
    def body_arrays(self) -> Any:
        """`Bodies`: `body_world` and `body_dof` as kernels take them."""
        return filled(Bodies, world=self.body_world, dof=self.body_dof)

    @cached_property
    def vertex_arrays(self) -> Any:
        """`Vertices`: `vertex_rest` and `vertex_body` as kernels take them."""
        return filled(Vertices, rest=self.vertex_rest, body=self.vertex_body)

    @property
    def unknowns(self) -> int:
        """Unknowns of the largest world."""
        return 12 * int(self.free_bodies.max(initial=0))


@dataclass
class ModelBuilder:
    """Collects bodies and worlds, then makes a `Model`.

    Example:
        builder = ModelBuilder()
        builder.add_asset(asset, pose)
        model = builder.finalize(device="cuda", worlds=256)
    """

    _bodies: list[dict] = field(default_factory=list)
    _attachments: list[tuple[int, NDArray[np.float64], int, NDArray[np.float64]]] = field(default_factory=list)
    _world: int = 0

    @classmethod
    def from_scene(cls, scene: Scene) -> ModelBuilder:
        """A builder that holds the objects of `scene` at their initial poses, and its attachments."""
        builder = cls()
        builder.add_scene(scene)
        return builder

    def new_world(self) -> None:
        """Bodies added from here on belong to the next world."""
        if self._bodies and self._bodies[-1]["world"] == self._world:
            self._world += 1

    def add_asset(self, asset: Asset, pose: Pose, *, fixed: bool = False, label: str | None = None) -> int:
        """Add an asset at a pose of its frame; returns the body's index."""
        properties = asset.mass_properties
        return self.add_body(
            asset.parts,
            mass=properties.mass,
            volume=properties.volume,
            centre=np.array(properties.centre_of_mass),
            second_moment=properties.second_moment,
            pose=pose,
            fixed=fixed,
            label=label or asset.noun,
        )

    def add_scene(self, scene: Scene) -> list[int]:
        """Add the objects of `scene` at their initial poses, and its attachments; returns the bodies' indices."""
        indices = {
            obj.name: self.add_asset(obj.asset, obj.initial_pose, fixed=obj.fixed, label=obj.name)
            for obj in scene.objects
        }
        for one in scene.attachments:
            child, parent = indices[one.child], indices[one.parent]
            if not (scene[one.child].fixed and scene[one.parent].fixed):
                for on_child, on_parent in one.anchors:
                    self.add_attachment(child, np.array(on_child), parent, np.array(on_parent))
        return list(indices.values())

    def add_body(
        self,
        parts: Sequence[ConvexPart],
        *,
        mass: float,
        volume: float,
        centre: NDArray[np.float64],
        second_moment: NDArray[np.float64],
        pose: Pose,
        fixed: bool = False,
        label: str = "body",
    ) -> int:
        """Add a body given by its parts in a frame placed by `pose`; returns its index.

        Args:
            parts: closed convex (or any watertight) surfaces in the body's frame.
            mass: [kg].
            volume: [m^3].
            centre: centre of mass in the body's frame [m], shape (3,).
            second_moment: integral of rho x x^T about the centre of mass [kg m^2], shape (3, 3).
            pose: placement of the body's frame.
            fixed: whether the body never moves.
            label: what error messages call it.

        Raises:
            SimulationError: mass, volume, moment or geometry is not physical.
        """
        if not parts:
            raise SimulationError(f'body "{label}" has no parts.')
        if not all(np.all(np.isfinite(part.vertices)) for part in parts):
            raise SimulationError(f'body "{label}" has vertices that are not finite.')
        if not (np.isfinite(mass) and mass > 0 and np.isfinite(volume) and volume > 0):
            raise SimulationError(f'body "{label}" needs positive mass and volume, got {mass} kg and {volume} m^3.')
        moments = np.linalg.eigvalsh(second_moment)
        if not np.all(np.isfinite(moments)) or moments[0] <= 0:
            raise SimulationError(f'body "{label}": the second moment of mass {moments} must be positive definite.')
        for part in parts:
            if enclosed_volume(part.vertices[part.faces]) <= 0:
                raise SimulationError(f'body "{label}" has a part that is flat or inside out.')
        self._bodies.append(
            {
                "world": self._world,
                "parts": tuple(parts),
                "mass": mass,
                "volume": volume,
                "centre": np.asarray(centre, dtype=np.float64),
                "moment": np.asarray(second_moment, dtype=np.float64),
                "pose": pose,
                "fixed": fixed,
                "label": label,
            }
        )
        return len(self._bodies) - 1

    def add_attachment(
        self, body_a: int, point_a: NDArray[np.float64], body_b: int, point_b: NDArray[np.float64]
    ) -> None:
        """Hold a point of one body and a point of another together, as a ball joint does.

        Two attachments of a pair make a hinge, three hold it fast. Attached bodies still collide with each other:
        points belong where the surfaces are further apart than the barrier reaches, or they push against it.

        Args:
            body_a: index of a body.
            point_a: in the frame that body was given in [m], shape (3,).
            body_b: index of another body of the same world.
            point_b: in that body's frame [m], shape (3,).

        Raises:
            SimulationError: no such bodies, of different worlds or both fixed, or points that are not finite.
        """
        count = len(self._bodies)
        if not (0 <= body_a < count and 0 <= body_b < count and body_a != body_b):
            raise SimulationError(f"an attachment needs two different bodies below {count}, got {body_a} and {body_b}.")
        first, second = self._bodies[body_a], self._bodies[body_b]
        labels = f'"{first["label"]}" and "{second["label"]}"'
        if first["world"] != second["world"]:
            raise SimulationError(f"{labels} are in different worlds and cannot be attached.")
        if first["fixed"] and second["fixed"]:
            raise SimulationError(f"{labels} are both fixed; there is nothing to attach.")
        points = [np.asarray(point, dtype=np.float64) for point in (point_a, point_b)]
        if not all(point.shape == (3,) and np.all(np.isfinite(point)) for point in points):
            raise SimulationError(f"the attachment of {labels} needs points of 3 finite numbers.")
        self._attachments.append((body_a, points[0] - first["centre"], body_b, points[1] - second["centre"]))

    def finalize(self, device: str = "cpu", worlds: int | None = None) -> Model:
        """The model on `device` ("cpu" or "cuda").

        Args:
            device: Warp's name of the device.
            worlds: number of copies of the one world that was built; as built where None.

        Raises:
            SimulationError: no bodies were added, or copies of more than one world are asked for.
        """
        quiet_warp()
        bodies = self._bodies
        if not bodies:
            raise SimulationError("a model needs at least one body.")
        built = bodies[-1]["world"] + 1
        copies = 1 if worlds is None else worlds
        if copies < 1 or (worlds is not None and built > 1):
            raise SimulationError(
                f"only one world can be copied, at least once; got {built} worlds and {worlds} copies."
            )
        fixed = np.array([body["fixed"] for body in bodies])
        mass = np.array([body["mass"] for body in bodies])
        body_world = np.array([body["world"] for body in bodies], dtype=np.int32)
        free_count = np.bincount(body_world[~fixed], minlength=built)
        weight = np.zeros(built)
        np.maximum.at(weight, body_world[~fixed], mass[~fixed] * GRAVITY)
        dof = np.full(len(bodies), -1, dtype=np.int32)
        # Worlds are contiguous, so a free body's index is its rank among all free ones less those of earlier worlds.
        earlier = np.cumsum(free_count) - free_count
        dof[~fixed] = np.arange(free_count.sum()) - earlier[body_world[~fixed]]
        vertices, vertex_body, edges, triangles = [], [], [], []
        part_body, ranges, cluster_ranges, halo = [], [], [], []
        clustered: dict[int, ClusteredPart] = {}
        # Vertices, edges, triangles, entries of the halo and clusters so far.
        bases = np.zeros(5, dtype=np.int64)
        radius = np.zeros(len(bodies))
        q0 = np.zeros((len(bodies), 4, 3))
        for b, body in enumerate(bodies):
            pose: Pose = body["pose"]
            q0[b, 0] = pose.apply(body["centre"][None])[0]
            q0[b, 1:] = pose.rotation.T
            for part in body["parts"]:
                if id(part) not in clustered:
                    clustered[id(part)] = cluster(part.vertices, sharp_edges(part), part.faces)
                found = clustered[id(part)]
                rest = found.vertices - body["centre"]
                radius[b] = max(radius[b], np.linalg.norm(rest, axis=1).max())
                counts = [len(x) for x in (rest, found.edges, found.triangles, found.halo, found.ranges)]
                vertices.append(rest)
                vertex_body.append(np.full(len(rest), b, dtype=np.int32))
                edges.append(found.edges + bases[0])
                triangles.append(found.triangles + bases[0])
                halo.append(found.halo + bases[0])
                part_body.append(b)
                ranges.append(np.stack([bases, bases + counts], axis=1)[[0, 1, 2, 4]].ravel())
                cluster_ranges.append(found.ranges + np.repeat(bases[:4], 2))
                bases += counts
        attached = self._attachments
        bearing = [min(bodies[b]["mass"] for b in (one[0], one[2]) if not bodies[b]["fixed"]) for one in attached]
        owner = np.array(part_body, dtype=np.int32)
        part_pairs = _part_pairs(owner, body_world, dof)
        if copies * max(*bases, len(part_pairs)) > np.iinfo(np.int32).max:
            raise SimulationError(f"{copies} copies of this world have more pairs of parts than can be counted.")

        def array(values, dtype, shift: int | np.integer | NDArray[np.int64] = 0) -> wp.array:
            """One row of `values` for each of every copy, the indices in it raised by `shift` a copy."""
            values = np.asarray(values)
            rise = np.arange(copies).reshape(-1, *[1] * values.ndim) * np.asarray(shift, dtype=values.dtype)
            repeated = np.broadcast_to(values, (copies, *values.shape)) + rise.astype(values.dtype)
            return wp.array(repeated.reshape(-1, *values.shape[1:]), dtype=dtype, device=device)

        def whole(rows, width: int) -> NDArray[np.int32]:
            return np.array(rows, dtype=np.int32).reshape(-1, width)

        return Model(
            device=device,
            worlds=built * copies,
            body_world=array(body_world, int, 1),
            body_dof=array(dof, int),
            body_mass=array(mass, wp.float64),
            body_moment=array(np.stack([body["moment"] for body in bodies]), wp.mat33d),
            body_volume=array([body["volume"] for body in bodies], wp.float64),
            vertex_rest=array(np.concatenate(vertices), wp.vec3d),
            vertex_body=array(np.concatenate(vertex_body), int, len(bodies)),
            edges=array(whole(np.concatenate(edges), 2), wp.vec2i, bases[0]),
            triangles=array(whole(np.concatenate(triangles), 3), wp.vec3i, bases[0]),
            part_body=array(owner, int, len(bodies)),
            part_ranges=array(whole(ranges, 8), int, np.repeat(bases[[0, 1, 2, 4]], 2)),
            cluster_ranges=array(whole(np.concatenate(cluster_ranges), 8), int, np.repeat(bases[:4], 2)),
            halo=array(np.concatenate(halo), int, bases[0]),
            part_pairs=array(part_pairs, wp.vec2i, len(owner)),
            attachment_bodies=array(whole([(one[0], one[2]) for one in attached], 2), wp.vec2i, len(bodies)),
            attachment_rest=array(np.array([(one[1], one[3]) for one in attached]).reshape(-1, 2, 3), wp.vec3d),
            attachment_stiffness=array(np.array(bearing) * (GRAVITY / ATTACHMENT_STRETCH), wp.float64),
            free_bodies=np.tile(free_count, copies),
            world_of=(body_world.astype(np.int64) + np.arange(copies)[:, None]).reshape(-1),
            is_free=np.tile(dof >= 0, copies),
            weight=np.tile(weight, copies),
            body_radius=np.tile(radius, copies),
            q0=np.tile(q0, (copies, 1, 1)),
            labels=tuple(body["label"] for body in bodies) * copies,
            centres=np.tile(np.stack([body["centre"] for body in bodies]), (copies, 1)),
        )


def poses_from_states(model: Model, q: NDArray[np.float64]) -> list[Pose]:
    """Rigid poses of the bodies' frames nearest to affine states q, shape (bodies, 4, 3)."""
    return [Pose.from_affine(state[1:].T, state[0], centre) for state, centre in zip(q, model.centres, strict=True)]


def _part_pairs(owner: NDArray[np.int32], world: NDArray[np.int32], dof: NDArray[np.int32]) -> NDArray[np.int32]:
    """All pairs of parts of different bodies of one world, not both fixed, shape (pairs, 2)."""
    pairs = []
    bounds = np.searchsorted(world[owner], np.arange(int(world.max()) + 2))
    for begin, end in pairwise(bounds):
        first, second = np.triu_indices(end - begin, 1)
        first, second = first + begin, second + begin
        keep = (owner[first] != owner[second]) & ((dof[owner[first]] >= 0) | (dof[owner[second]] >= 0))
        pairs.append(np.stack([first[keep], second[keep]], axis=1))
    return np.concatenate(pairs).astype(np.int32).reshape(-1, 2)
