"""Residuals of the lateral relations: how many metres are missing until a relation holds with a margin.

Each condition of pat3d.layout.predicates becomes a length that is zero where it holds by at least the margin; a
relation's loss is the sum of their squares.
"""

from __future__ import annotations

import math

import torch

from pat3d.geometry.polygons import polygon_gap as overlap_aware_gap
from pat3d.layout.lateral import APART, ASIDE, FAR, NEAR, OVERLAPPING
from pat3d.optimize.outline import Box, outside, polygon_gap
from pat3d.scene.relations import SIDES

WIDEST = math.radians(200.0)
"""Largest angle [rad] between neighbours around something."""


def side_loss(kind: str, child: Box, parent: Box, margin: float) -> torch.Tensor:
    """Squared residual [m^2] of left_of, right_of, in_front_of or behind, shape (...)."""
    axis, sign = SIDES[kind]
    across = 1 - axis
    offset = child.centre - parent.centre
    along = sign * offset[..., axis]
    smaller = torch.minimum(child.size, parent.size)[..., axis]
    facing = _overlap(child, parent, across)
    aside = offset[..., across].abs() - ASIDE * along
    return (
        torch.relu(margin - along) ** 2
        + torch.relu(_overlap(child, parent, axis) - OVERLAPPING * smaller + margin) ** 2
        + torch.relu(torch.minimum(-facing, aside) + margin) ** 2
    )


def beside_loss(
    child: Box,
    parent: Box,
    footprints: tuple[torch.Tensor, torch.Tensor],
    centres: tuple[torch.Tensor, torch.Tensor],
    margin: float,
    *,
    reach: float = 1.0,
) -> torch.Tensor:
    """Squared residual [m^2] of next_to (or, with twice the `reach`, around) in one world.

    Args:
        child: bounding box, corners of shape (3,).
        parent: the same of what it stands beside.
        footprints: of both, counter-clockwise, shape (n, 2) each [m].
        centres: of mass of both seen from above [m], shape (2,) each.
        margin: by which everything must hold [m].
        reach: factor on the largest gap.
    """
    limit = torch.maximum(child.size, parent.size)[:2].max().clamp(NEAR, FAR) * reach
    apart = torch.maximum(child.low - parent.high, parent.low - child.high)[2]
    loss = torch.relu(apart - APART + margin) ** 2
    overlapping = overlap_aware_gap(footprints[0].detach().numpy(), footprints[1].detach().numpy()) == 0.0
    if not overlapping:
        loss = loss + torch.relu(polygon_gap(*footprints) - limit + margin) ** 2
    for centre, other in ((centres[0], footprints[1]), (centres[1], footprints[0])):
        loss = loss + torch.relu(margin - outside(centre, other)) ** 2
    return loss


def ring_loss(centre: torch.Tensor, members: list[torch.Tensor], margin: float) -> torch.Tensor:
    """Squared arc [m^2] by which the widest angle between neighbours around `centre` is too wide, in one world.

    Args:
        centre: middle of what is surrounded [m], shape (2,).
        members: middles of what surrounds it [m], shape (2,) each; fewer than three have no widest angle.
        margin: by which it must hold [m].
    """
    if len(members) < 3:
        return torch.zeros((), dtype=torch.float64)
    offsets = torch.stack(members) - centre
    angles = torch.sort(torch.atan2(offsets[:, 1], offsets[:, 0])).values
    widest = torch.cat([angles[1:] - angles[:-1], (angles[0] + 2 * math.pi - angles[-1])[None]]).max()
    radius = torch.linalg.vector_norm(offsets, dim=1).mean()
    return torch.relu(radius * (widest - WIDEST) + margin) ** 2


def _overlap(first: Box, second: Box, axis: int) -> torch.Tensor:
    """How far two boxes overlap along an axis [m]; negative where they are apart."""
    return torch.minimum(first.high, second.high)[..., axis] - torch.maximum(first.low, second.low)[..., axis]
