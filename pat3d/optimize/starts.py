"""Where to start from: a batch of different layouts of one scene, screened by statics before anything is simulated.

Candidates are the layout as given, the same with every single child balanced on its parent, random shifts and turns
of those two, and, where asked for, whole layouts with other seeds and with the objects in another order (which
changes who stands where in a crowded container). The best by static balance are kept.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.balance import support_margin
from pat3d.layout.containers import lower
from pat3d.layout.group import Group
from pat3d.layout.layout import arrange
from pat3d.optimize.placement import GAP, Placement
from pat3d.scene.model import GROUND, Attachment, Relation

ENOUGH = 0.1
"""Support margin, as a share of an object's width, beyond which more is not better."""
_GRIDS = ((0.5, 9), (0.09, 5))
"""Half width, as a share of the object's, and number of cells of the grids searched for balance."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Start:
    """One layout to start from."""

    source: str
    """Where it came from: "layout", "balanced", "shifted" or "arranged anew"."""
    poses: Mapping[str, Pose]
    balance: float
    """How far the worst-standing object is from tipping, as a share of its width, at most ENOUGH; negative tips."""
    attachments: tuple[Attachment, ...] = ()
    """What holds the things that hang."""


def make_starts(
    placement: Placement,
    relations: tuple[Relation, ...],
    *,
    count: int,
    seed: int,
    relayout: bool,
) -> list[Start]:
    """At most `count` intersection-free starts, the layout as given first.

    Args:
        placement: the layout as given.
        relations: of its objects.
        count: how many to return.
        seed: of the random ones.
        relayout: whether layouts with other seeds may be among them.
    """
    rng = np.random.default_rng(seed)
    held = placement.attachments
    start = Start(source="layout", poses=placement.poses, balance=balance(placement, placement.poses), attachments=held)
    if count <= 1:
        return [start]
    found: list[Start] = []

    def add(source: str, poses: Mapping[str, Pose], attachments: tuple[Attachment, ...] = held) -> None:
        found.append(Start(source=source, poses=poses, balance=balance(placement, poses), attachments=attachments))

    best = balanced(placement)
    for source, variables in [
        ("balanced", best),
        *(("shifted", best + 0.3 * shifts(placement, rng)) for _ in range(count)),
        *(("shifted", shifts(placement, rng)) for _ in range(count)),
    ]:
        if not np.any(variables):
            continue
        try:
            add(source, placement.project(variables))
        except LayoutError:
            continue
    for k in range(count if relayout else 0):
        # Every second one also takes the objects in another order.
        names = list(placement.names)
        if k % 2:
            rng.shuffle(names)
        given = {name: placement.poses[name] for name in placement.held}
        shuffled = {name: placement.assets[name] for name in names}
        try:
            layout = arrange(shuffled, relations, seed=seed + k + 1, fixed_poses=given)
            add("arranged anew", layout.poses, layout.attachments)
        except LayoutError:
            continue
    found.sort(key=lambda one: -one.balance)
    return [start, *_mixed(found, count - 1)]


def balance(placement: Placement, poses: Mapping[str, Pose]) -> float:
    """The least support margin of any object on another, as a share of its width, at most ENOUGH."""
    groups = placement.groups(poses)
    worst = ENOUGH
    for name, group in groups.items():
        if placement.parent[name] == GROUND or placement.kind.get(name) != "on" or name in placement.fixed:
            continue
        carried = {member.body.name for member in group.members}
        low, high = group.root.low, group.root.high
        others = [
            other.root
            for key, other in groups.items()
            if key not in carried and np.all(other.root.low[:2] < high[:2]) and np.all(other.root.high[:2] > low[:2])
        ]
        worst = min(worst, _share(group, others))
    return worst


def balanced(placement: Placement) -> NDArray[np.float64]:
    """Variables, shape (objects, 3), that put the weight of every only child, with its load, over its support."""
    variables = np.zeros((len(placement.names), 3))
    for name in reversed(placement.order):
        k, above = placement.names.index(name), placement.parent[name]
        siblings = [other for other in placement.names if placement.parent[other] == above]
        if not placement.movable[k] or above == GROUND or placement.kind[name] != "on" or len(siblings) > 1:
            continue
        try:
            groups = placement.groups(placement.project(variables))
        except LayoutError:
            continue
        variables[k, :2] = _best_offset(groups[name], groups[above].root)
    return variables


def shifts(placement: Placement, rng: np.random.Generator) -> NDArray[np.float64]:
    """Random variables, shape (objects, 3): within the parent's box, more often near than far."""
    size = np.array([asset.size[:2] for asset in placement.assets.values()])
    free = np.array(
        [size[placement.names.index(p)] if p != GROUND else np.full(2, 0.2) for p in placement.parent.values()]
    )
    reach = np.minimum(0.5 * size, 0.25 * free) * rng.uniform(0.2, 1.0)
    turn = placement.radius * rng.uniform(0.0, 0.5)
    spread = np.column_stack([reach, turn])
    return np.where(placement.movable[:, None], spread * rng.uniform(-1.0, 1.0, spread.shape), 0.0)


def _best_offset(group: Group, carrier) -> NDArray[np.float64]:
    """Horizontal shift [m], shape (2,), that gives `group` the largest support margin on `carrier`."""
    width = float(group.root.body.asset.size[:2].max())
    best, here = np.zeros(2), _on(group, carrier, np.zeros(2))
    for reach, cells in _GRIDS:
        ticks = reach * width * np.linspace(-1.0, 1.0, cells)
        tries = [best + np.array([x, y]) for x in ticks for y in ticks]
        # Among equals, the nearest to where it was.
        values = [_on(group, carrier, offset) - 1e-3 * float(np.linalg.norm(offset)) for offset in tries]
        k = int(np.argmax(values))
        if values[k] > here:
            best, here = tries[k], values[k]
    return best


def _on(group: Group, carrier, offset: NDArray[np.float64]) -> float:
    """Support margin [m] of `group` shifted by `offset`, shape (2,), on `carrier`; tall perches count as none."""
    origin = group.root.position
    spot = np.array([*(origin[:2] + offset), origin[2]])
    found = lower(
        Group(tuple(member.shifted(-origin) for member in group.members)),
        spot,
        [carrier],
        floor=float(carrier.low[2]),
        gap=GAP,
    )
    if found is None or found.low[2] <= carrier.low[2] + 2 * GAP:
        return -np.inf
    return support_margin(found, [carrier], gap=GAP)


def _share(group: Group, supports: list) -> float:
    if not supports:
        return -1.0
    width = float(group.root.body.asset.size[:2].max())
    return float(np.clip(support_margin(group, supports, gap=GAP) / width, -1.0, ENOUGH))


def _mixed(found: list[Start], count: int) -> list[Start]:
    """The best of every source in turn, best first, so that no source crowds out another."""
    queues: dict[str, list[Start]] = {}
    for one in found:
        queues.setdefault(one.source, []).append(one)
    chosen: list[Start] = []
    while len(chosen) < count and any(queues.values()):
        for queue in queues.values():
            if queue and len(chosen) < count:
                chosen.append(queue.pop(0))
    return chosen
