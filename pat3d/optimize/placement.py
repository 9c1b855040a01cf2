"""The variables of the optimisation: where every object stands on its parent, seen from above.

Three lengths per movable object move it along x and y and turn it about its own origin (by an arc at the rim of its
footprint, so that all three are metres); what it carries comes along. `Placement.project` makes the result free of
intersection again by the layout's drop test, parents before children, and checks it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
import torch
from numpy.typing import NDArray

from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.bodies import Body, Placed
from pat3d.layout.clearance import require_clearance
from pat3d.layout.containers import lower
from pat3d.layout.group import Group
from pat3d.optimize.loss import states
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Attachment, Relation, Scene, SceneObject, parent_of
from pat3d.scene.physics import SETTLING_FRICTION

GAP = 0.002
"""Distance kept from what will carry an object [m], as in the layout."""
SHALLOW = 0.005
"""Height [m] by which an object on the ground may be lifted; more would put it on top of another."""


class Placement:
    """A layout and its variables, shape (objects, 3): x [m], y [m] and arc [m]."""

    def __init__(
        self,
        assets: Mapping[str, Asset],
        relations: tuple[Relation, ...],
        poses: Mapping[str, Pose],
        *,
        fixed: Collection[str] = (),
        pinned: Collection[str] = (),
        attachments: tuple[Attachment, ...] = (),
    ) -> None:
        """Prepare the variables.

        Args:
            assets: by object name.
            relations: the scene tree and the lateral relations.
            poses: intersection-free layout of every object.
            fixed: objects that never move.
            pinned: objects that settle like others but start where they are.
            attachments: by which things hang; what hangs moves with its carrier.
        """
        self.assets, self.poses, self.fixed = dict(assets), {name: poses[name] for name in assets}, frozenset(fixed)
        self.relations, self.attachments = relations, attachments
        self.held = self.fixed | frozenset(pinned)
        self.names = list(assets)
        self.parent = {name: parent_of(name, relations) for name in assets}
        self.kind = {rel.child: rel.kind for rel in relations if rel.supports}
        lateral = {rel.child for rel in relations if not rel.supports and rel.parent != GROUND}
        self.movable = np.array(
            [
                name not in self.held
                and self.kind.get(name) != "hangs_from"
                and (self.parent[name] != GROUND or name in lateral)
                for name in assets
            ]
        )
        """Which objects have variables, shape (objects,)."""
        self.radius = np.array([0.5 * float(np.linalg.norm(asset.size[:2])) for asset in assets.values()])
        """Of the footprints [m]; arcs are at this distance."""
        self._bodies = {name: Body(name, asset) for name, asset in assets.items()}
        self._start = self._bodies_at(np.zeros((len(self.names), 3)))
        self.order = self._tree_order()
        self._q = states(self.assets, self.poses)

    def rigid(self, variables: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Planar maps x -> R x + t of every object: R, shape (objects, 2, 2), and t [m], shape (objects, 2)."""
        turned: list[torch.Tensor] = [torch.eye(2, dtype=torch.float64)] * len(self.names)
        shifted: list[torch.Tensor] = [torch.zeros(2, dtype=torch.float64)] * len(self.names)
        index = {name: k for k, name in enumerate(self.names)}
        for name in self.order:
            k = index[name]
            if name in self.held:
                continue
            if self.movable[k]:
                angle = variables[k, 2] / self.radius[k]
                c, s = torch.cos(angle), torch.sin(angle)
                turn = torch.stack([torch.stack([c, -s]), torch.stack([s, c])])
                pivot = torch.tensor(self.poses[name].position[:2], dtype=torch.float64)
                turned[k], shifted[k] = turn, pivot + variables[k, :2] - turn @ pivot
            above = self.parent[name]
            if above != GROUND:
                j = index[above]
                turned[k], shifted[k] = turned[j] @ turned[k], turned[j] @ shifted[k] + shifted[j]
        return torch.stack(turned), torch.stack(shifted)

    def states(self, variables: torch.Tensor, poses: Mapping[str, Pose]) -> torch.Tensor:
        """States, shape (objects, 12), that depend on `variables`; heights [m] are those of the projected `poses`."""
        turn, shift = self.rigid(variables)
        q = self._q.unflatten(-1, (4, 3))
        xy = torch.einsum("bij,bkj->bki", turn, q[..., :2])
        xy = torch.cat([xy[:, :1] + shift[:, None], xy[:, 1:]], dim=1)
        lift = torch.tensor([poses[name].position[2] - self.poses[name].position[2] for name in self.names])
        z = q[..., 2:] + lift[:, None, None] * torch.tensor([1.0, 0.0, 0.0, 0.0])[None, :, None]
        return torch.cat([xy, z.to(torch.float64)], dim=-1).flatten(-2)

    def project(self, variables: NDArray[np.float64], *, gap: float = GAP) -> dict[str, Pose]:
        """Intersection-free poses near `variables`: every object lifted and lowered onto what is under it.

        Raises:
            LayoutError: some object finds no free height, or would have to be lifted off the ground.
        """
        if not np.any(variables):
            return dict(self.poses)
        wanted = self._bodies_at(variables)
        done: dict[str, Placed] = {}
        lift: dict[str, float] = {}
        for name in self.order:
            body, above = wanted[name], self.parent[name]
            if name in self.held or (above == GROUND and not self.movable[self.names.index(name)]):
                done[name], lift[name] = body, 0.0
                continue
            carried = body.shifted(np.array([0.0, 0.0, lift.get(above, 0.0)]))
            if self.kind.get(name) == "hangs_from":
                done[name], lift[name] = carried, lift[above]
                continue
            floor = 0.0 if above == GROUND else float(done[above].low[2])
            if done:
                at_zero = Group((carried.shifted(-carried.position),))
                found = lower(at_zero, carried.position, list(done.values()), floor=floor, gap=gap)
                if found is None:
                    raise LayoutError(f'"{name}" finds no free height over "{above}".')
                carried = found.root
            done[name] = carried
            lift[name] = float(done[name].position[2] - body.position[2])
            if above == GROUND and lift[name] > SHALLOW:
                raise LayoutError(f'"{name}" would stand on another object.')
        require_clearance([done[name] for name in self.names])
        return {name: self.poses[name] if name in self.held else done[name].pose for name in self.names}

    def scene(
        self,
        poses0: Mapping[str, Pose],
        attachments: tuple[Attachment, ...],
        *,
        poses: Mapping[str, Pose] | None = None,
        friction: float = SETTLING_FRICTION,
    ) -> Scene:
        """The objects as a scene laid out at `poses0`, and at rest at `poses`, settled with `friction` [-]."""
        objects = tuple(
            SceneObject(
                name=name,
                asset=asset,
                initial_pose=poses0[name],
                pose=(poses or poses0)[name],
                fixed=name in self.fixed,
            )
            for name, asset in self.assets.items()
        )
        return Scene(objects=objects, relations=self.relations, attachments=attachments, settling_friction=friction)

    def groups(self, poses: Mapping[str, Pose]) -> dict[str, Group]:
        """Every object with everything that it carries, at `poses`."""
        placed = {
            name: self._bodies[name].at(poses[name].rotation, np.array(poses[name].position)) for name in self.names
        }
        carried: dict[str, list[str]] = {name: [name] for name in self.names}
        for name in reversed(self.order):
            if self.parent[name] != GROUND:
                carried[self.parent[name]].extend(carried[name])
        return {name: Group(tuple(placed[one] for one in carried[name])) for name in self.names}

    def _bodies_at(self, variables: NDArray[np.float64]) -> dict[str, Placed]:
        """Every object moved and turned, at its height in the layout."""
        if not np.any(variables):
            return {name: self._bodies[name].at(p.rotation, np.array(p.position)) for name, p in self.poses.items()}
        turn, shift = (part.numpy() for part in self.rigid(torch.from_numpy(variables)))
        found = {}
        for k, name in enumerate(self.names):
            pose = self.poses[name]
            position = np.array([*(turn[k] @ pose.position[:2] + shift[k]), pose.position[2]])
            yaw = yaw_matrix(float(np.arctan2(turn[k][1, 0], turn[k][0, 0])))
            found[name] = self._bodies[name].at(yaw @ pose.rotation, position)
        return found

    def _tree_order(self) -> list[str]:
        """Parents before children; among what is ready, the lowest first, so that heaps are put up from below."""
        order: list[str] = []
        waiting = list(self.names)
        while waiting:
            ready = [name for name in waiting if self.parent[name] == GROUND or self.parent[name] in order]
            chosen = min(ready, key=lambda name: (name not in self.held, float(self._start[name].low[2])))
            order.append(chosen)
            waiting.remove(chosen)
        return order
