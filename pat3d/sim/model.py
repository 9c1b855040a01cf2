"""The static description of one or many worlds of affine bodies.

All worlds live in flat arrays: body b belongs to world `body_world[b]`, and within its world a free
body owns the twelve unknowns from 12 * `body_dof[b]` on. A point with rest position xbar (about the centre of
mass) sits at x = p + xbar_1 a_1 + xbar_2 a_2 + xbar_3 a_3, where q = (p, a_1, a_2, a_3) is the body's state
and a_j are the columns of its affine map (Lan et al. 2022, Affine Body Dynamics).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.assets.asset import Asset, ConvexPart
from pat3d.errors import SimulationError
from pat3d.scene import Pose, Scene

GRAVITY = 9.81
"""[m/s^2], along -z."""

ATTACHMENT_STRETCH = 5.0e-7
"""How far an anchor gives way under the weight of the lighter of the two bodies that it joins [m]."""

FLAT_EDGE = 1e-6
"""Edges whose two faces' normals differ by less than this [rad] are inside a flat facet: no contact needs them."""


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
    """First and past-last vertex, edge and triangle of every part, shape (parts, 6), int."""
    part_pairs: wp.array
    """Parts that can ever touch: same world, different bodies, not both fixed; shape (pairs,), vec2i."""
    anchor_bodies: wp.array
    """The two bodies that share an anchor, shape (anchors,), vec2i."""
    anchor_rest: wp.array
    """Where the anchor is on either, about its centre of mass [m], shape (anchors, 2), vec3d."""
    anchor_stiffness: wp.array
    """[N/m], shape (anchors,), float64."""
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
        model = builder.finalize(device="cpu")
    """

    _bodies: list[dict] = field(default_factory=list)
    _anchors: list[tuple[int, NDArray[np.float64], int, NDArray[np.float64]]] = field(default_factory=list)
    _world: int = 0

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
            corners = part.vertices[part.faces]
            if np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) <= 0:
                raise SimulationError(f'body "{label}" has a part that is flat or inside out.')
        self._bodies.append(
            {
                "world": self._world, "parts": tuple(parts), "mass": mass, "volume": volume,
                "centre": np.asarray(centre, dtype=np.float64), "moment": np.asarray(second_moment, dtype=np.float64),
                "pose": pose, "fixed": fixed, "label": label,
            }
        )  # fmt: skip
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
        self._anchors.append((body_a, points[0] - first["centre"], body_b, points[1] - second["centre"]))

    def finalize(self, device: str = "cpu") -> Model:
        """The model on `device` ("cpu" or "cuda").

        Raises:
            SimulationError: no bodies were added.
        """
        if not self._bodies:
            raise SimulationError("a model needs at least one body.")
        bodies = self._bodies
        worlds = bodies[-1]["world"] + 1
        free_count = np.zeros(worlds, dtype=np.int64)
        weight = np.zeros(worlds)
        dof = np.full(len(bodies), -1, dtype=np.int32)
        vertices, vertex_body, edges, triangles = [], [], [], []
        part_body, ranges = [], []
        base = edge_base = triangle_base = 0
        radius = np.zeros(len(bodies))
        q0 = np.zeros((len(bodies), 4, 3))
        for b, body in enumerate(bodies):
            if not body["fixed"]:
                dof[b] = free_count[body["world"]]
                free_count[body["world"]] += 1
                weight[body["world"]] = max(weight[body["world"]], body["mass"] * GRAVITY)
            pose: Pose = body["pose"]
            q0[b, 0] = pose.apply(body["centre"][None])[0]
            q0[b, 1:] = pose.rotation.T
            for part in body["parts"]:
                rest = part.vertices - body["centre"]
                radius[b] = max(radius[b], np.linalg.norm(rest, axis=1).max())
                sharp = _sharp_edges(part)
                vertices.append(rest)
                vertex_body.append(np.full(len(rest), b, dtype=np.int32))
                edges.append(sharp + base)
                triangles.append(part.faces + base)
                part_body.append(b)
                ranges.append(
                    [
                        base, base + len(rest), edge_base, edge_base + len(sharp),
                        triangle_base, triangle_base + len(part.faces),
                    ]
                )  # fmt: skip
                base += len(rest)
                edge_base += len(sharp)
                triangle_base += len(part.faces)
        anchors = self._anchors
        bearing = [min(bodies[b]["mass"] for b in (one[0], one[2]) if not bodies[b]["fixed"]) for one in anchors]
        owner = np.array(part_body, dtype=np.int32)
        body_world = np.array([body["world"] for body in bodies], dtype=np.int32)

        def array(values, dtype) -> wp.array:
            return wp.array(np.ascontiguousarray(values), dtype=dtype, device=device)

        return Model(
            device=device,
            worlds=worlds,
            body_world=array(body_world, int),
            body_dof=array(dof, int),
            body_mass=array([body["mass"] for body in bodies], wp.float64),
            body_moment=array(np.stack([body["moment"] for body in bodies]), wp.mat33d),
            body_volume=array([body["volume"] for body in bodies], wp.float64),
            vertex_rest=array(np.concatenate(vertices), wp.vec3d),
            vertex_body=array(np.concatenate(vertex_body), int),
            edges=array(np.concatenate(edges).astype(np.int32), wp.vec2i),
            triangles=array(np.concatenate(triangles).astype(np.int32), wp.vec3i),
            part_body=array(owner, int),
            part_ranges=wp.array(np.array(ranges, dtype=np.int32), dtype=int, device=device),
            part_pairs=array(_part_pairs(owner, body_world, dof), wp.vec2i),
            anchor_bodies=array(np.array([(one[0], one[2]) for one in anchors], np.int32).reshape(-1, 2), wp.vec2i),
            anchor_rest=array(np.array([(one[1], one[3]) for one in anchors]).reshape(-1, 2, 3), wp.vec3d),
            anchor_stiffness=array(np.array(bearing) * (GRAVITY / ATTACHMENT_STRETCH), wp.float64),
            free_bodies=free_count,
            world_of=body_world.astype(np.int64),
            is_free=dof >= 0,
            weight=weight,
            body_radius=radius,
            q0=q0,
            labels=tuple(body["label"] for body in bodies),
            centres=np.stack([body["centre"] for body in bodies]),
        )


def poses_from_states(model: Model, q: NDArray[np.float64]) -> list[Pose]:
    """Rigid poses of the bodies' frames nearest to affine states q, shape (bodies, 4, 3)."""
    poses = []
    for state, centre in zip(q, model.centres, strict=True):
        left, _, right = np.linalg.svd(state[1:].T)
        rotation = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
        poses.append(Pose.from_matrix(rotation, state[0] - rotation @ centre))
    return poses


def _sharp_edges(part: ConvexPart) -> NDArray[np.int32]:
    """Edges of a part whose faces are not coplanar, shape (edges, 2)."""
    corners = part.vertices[part.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.maximum(lengths, 1e-300)
    halves = np.sort(part.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, inverse = np.unique(halves, axis=0, return_inverse=True)
    face = np.repeat(np.arange(len(part.faces)), 3)
    order = np.argsort(inverse.ravel(), kind="stable")
    counts = np.bincount(inverse.ravel(), minlength=len(unique))
    if np.any(counts != 2):
        raise SimulationError("a part's surface is open or not manifold; every edge needs exactly two faces.")
    sides = face[order].reshape(-1, 2)
    angle_sine = np.linalg.norm(np.cross(normals[sides[:, 0]], normals[sides[:, 1]]), axis=1)
    folded = np.einsum("ei,ei->e", normals[sides[:, 0]], normals[sides[:, 1]]) < 0
    return unique[(angle_sine > FLAT_EDGE) | folded].astype(np.int32)


def _part_pairs(owner: NDArray[np.int32], world: NDArray[np.int32], dof: NDArray[np.int32]) -> NDArray[np.int32]:
    """All pairs of parts of different bodies of one world, not both fixed, shape (pairs, 2)."""
    pairs = []
    part_world = world[owner]
    for w in range(int(world.max()) + 1):
        parts = np.flatnonzero(part_world == w)
        first, second = np.triu_indices(len(parts), 1)
        first, second = parts[first], parts[second]
        keep = (owner[first] != owner[second]) & ((dof[owner[first]] >= 0) | (dof[owner[second]] >= 0))
        pairs.append(np.stack([first[keep], second[keep]], axis=1))
    return np.concatenate(pairs).astype(np.int32).reshape(-1, 2)
