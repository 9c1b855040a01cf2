"""The semantic loss: what a settled scene lacks of its relations, in square metres.

For every object against its direct parent (the paper's Eq. 3 and 4), with the parent's bounding box B seen from above,

    sum over the corners x of the child's box |x_xy - clip(x_xy, B)|^2 / 8

plus how far the centre of mass is outside the parent's footprint, how far the child has sunk below where the layout
put it on its parent, and the residuals of the lateral relations (pat3d.optimize.lateral). A child wider than its
parent counts as inside where its box covers the parent's. The loss is zero exactly where all of that holds with a
margin, and then the predicates of pat3d.layout hold for things that touch.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import torch

from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.layout.predicates import TOUCH
from pat3d.optimize.lateral import beside_loss, ring_loss, side_loss
from pat3d.optimize.outline import Box, Outline, moved, outside
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Relation
from pat3d.scene.relations import SIDES, carriers_of

MARGIN = 1.0e-3
"""By which relations must hold for no loss [m]."""
FLUSH = 1.0e-6
"""Length [m] by which boxes that are flush with each other may stick out."""
LOST = 0.2
"""Share of an object's width beyond which a residual means that it has fallen."""
SINKING = 0.1
"""Share of its height that a child may sink towards its parent while settling."""


def outside_parent(corners: torch.Tensor, parent: Box, counted: torch.Tensor | None = None) -> torch.Tensor:
    """Mean squared horizontal distance [m^2] of box corners to the parent's box seen from above, shape (...).

    Args:
        corners: of the child's box [m], shape (..., 8, 3).
        parent: its parent's bounding box.
        counted: corners that count, shape (..., 8); all by default.
    """
    xy = corners[..., :2]
    extent = xy.amax(dim=-2) - xy.amin(dim=-2)
    spare = torch.relu(extent - parent.size[..., :2])[..., None, :] + FLUSH
    beyond = torch.relu(parent.low[..., None, :2] - spare - xy) + torch.relu(xy - parent.high[..., None, :2] - spare)
    squares = torch.sum(beyond**2, dim=-1)
    return (squares if counted is None else squares * counted).mean(dim=-1)


def sunk(child: Box, parent: Box, least: float) -> torch.Tensor:
    """Squared length [m^2] by which the child's lowest point is less than `least` [m] above its parent's."""
    return torch.relu(least - (child.low - parent.low)[..., 2]) ** 2


def risen(child: Box, parent: Box, most: float) -> torch.Tensor:
    """Squared length [m^2] by which the child's lowest point is more than `most` [m] above its parent's."""
    return torch.relu((child.low - parent.low)[..., 2] - most) ** 2


class SemanticLoss:
    """The semantic loss of one set of objects and relations, as a function of states."""

    def __init__(
        self,
        assets: Mapping[str, Asset],
        relations: tuple[Relation, ...],
        poses0: Mapping[str, Pose],
        *,
        margin: float = MARGIN,
    ) -> None:
        """Prepare the loss.

        Args:
            assets: by object name, in the order of the bodies.
            relations: the scene tree and the lateral relations.
            poses0: the layout; how high it put a child on its parent is where the child should stay.
            margin: by which everything must hold [m].

        Raises:
            SpecError: a relation names an object that is not among the assets.
        """
        for relation in relations:
            for name in (relation.child, relation.parent):
                if name != GROUND and (name not in assets or name not in poses0):
                    raise SpecError(f'relation "{relation}" names "{name}"; the objects are: {", ".join(assets)}.')
        self.margin = margin
        self.index = {name: k for k, name in enumerate(assets)}
        self.outlines = [Outline(asset) for asset in assets.values()]
        self.relations = tuple(rel for rel in relations if rel.parent != GROUND)
        start = states(assets, poses0)
        boxes = [outline.box(q) for outline, q in zip(self.outlines, start, strict=True)]
        self._least: dict[Relation, float] = {}
        self._rim: dict[Relation, float] = {}
        self._lost: dict[Relation, float] = {}
        for rel in self.relations:
            if not rel.supports:
                continue
            child, parent = boxes[self.index[rel.child]], boxes[self.index[rel.parent]]
            lift = float(child.low[2] - parent.low[2])
            self._lost[rel] = (LOST * float(child.size[:2].min())) ** 2
            allowance = min(SINKING * float(child.size[2]) + 5.0 * margin, 0.5 * abs(lift))
            self._least[rel] = lift - allowance if rel.kind != "in" else -margin
            if rel.kind == "on":
                self._least[rel] = max(self._least[rel], TOUCH + margin)
            if rel.kind == "in":
                self._rim[rel] = max(lift + 5.0 * margin, float(parent.size[2]) - margin)

    def __call__(self, q: torch.Tensor) -> torch.Tensor:
        """Loss [m^2] of states `q`, shape (..., bodies, 12); returns shape (...)."""
        terms = list(self.terms(q).values())
        return torch.stack(terms).sum(dim=0) if terms else q.sum(dim=(-1, -2)) * 0.0

    def terms(self, q: torch.Tensor) -> dict[Relation, torch.Tensor]:
        """The loss [m^2] of every relation that can be broken, shape (...) each."""
        boxes = [outline.box(q[..., k, :]) for k, outline in enumerate(self.outlines)]
        return {rel: self._term(rel, q, boxes) for rel in self.relations}

    def lost(self, terms: Mapping[Relation, torch.Tensor]) -> torch.Tensor:
        """Whether any support relation is beyond rescue, given `terms` of shape (...); returns shape (...)."""
        found = [value > self._lost[rel] for rel, value in terms.items() if rel.supports]
        return torch.stack(found).any(dim=0) if found else torch.zeros(0, dtype=torch.bool)

    def _term(self, rel: Relation, q: torch.Tensor, boxes: list[Box]) -> torch.Tensor:
        c, p = self.index[rel.child], self.index[rel.parent]
        child, parent = boxes[c], boxes[p]
        if rel.kind in SIDES:
            return side_loss(rel.kind, child, parent, self.margin)
        if not rel.supports:
            return self._each(q, lambda state: self._beside(rel, state))
        loss = sunk(child, parent, self._least[rel])
        if rel.kind == "hangs_from" or len(carriers_of(rel.child, self.relations)) > 1:
            # What lies on several objects is over none of them as a whole.
            return loss
        corners = moved(self.outlines[c].corners, q[..., c, :])
        counted = None
        if rel.kind == "in":
            # What sticks out over the rim may lean.
            height = corners[..., 2] - parent.low[..., None, 2]
            counted = (height < self._rim[rel]).to(torch.float64).detach()
            loss = loss + risen(child, parent, self._rim[rel])
        return loss + outside_parent(corners, parent, counted) + self._each(q, lambda state: self._off(c, p, state))

    def _off(self, c: int, p: int, q: torch.Tensor) -> torch.Tensor:
        """Squared distance of a child's centre of mass out of its parent's footprint in one world."""
        return torch.relu(outside(q[c, :2], self.outlines[p].footprint(q[p])) + self.margin) ** 2

    def _beside(self, rel: Relation, q: torch.Tensor) -> torch.Tensor:
        pair = (self.index[rel.child], self.index[rel.parent])
        child, parent = (self.outlines[k].box(q[k]) for k in pair)
        footprints = (self.outlines[pair[0]].footprint(q[pair[0]]), self.outlines[pair[1]].footprint(q[pair[1]]))
        centres = (q[pair[0], :2], q[pair[1], :2])
        if rel.kind == "next_to":
            return beside_loss(child, parent, footprints, centres, self.margin)
        names = [other.child for other in self.relations if other.kind == "around" and other.parent == rel.parent]
        members = [self.outlines[self.index[name]].box(q[self.index[name]]).centre[:2] for name in names]
        ring = ring_loss(parent.centre[:2], members, self.margin) / len(names)
        return beside_loss(child, parent, footprints, centres, self.margin, reach=2.0) + ring

    def _each(self, q: torch.Tensor, term) -> torch.Tensor:
        """`term` of every world, shape (...)."""
        flat = q.reshape(-1, *q.shape[-2:])
        return torch.stack([term(state) for state in flat]).reshape(q.shape[:-2])


def states(assets: Mapping[str, Asset], poses: Mapping[str, Pose]) -> torch.Tensor:
    """States of rigid poses, shape (bodies, 12), in the order of the assets."""
    rows = []
    for name, asset in assets.items():
        pose = poses[name]
        centre = pose.apply(np.array([asset.mass_properties.centre_of_mass]))
        rows.append(np.concatenate([centre, pose.rotation.T]).ravel())
    return torch.from_numpy(np.stack(rows))
