"""What success is made of, decided on the state of simulations: each predicate once, for one world at a time, compiled.

States of many worlds have the world as the first axis; a single environment is the case of one. Functions without a
`world` loop over all of them. Objects are numbers: their place in the scene.

Where both sides are cheap, conditions are joined with & and |: numba counts references to arrays across branches, which
took a hundred times as long as looking the values up.
"""

from __future__ import annotations

import math

import numpy as np

from pat3d.envs.compiled import compiled
from pat3d.envs.physics.snapshot import Array, Floors, Mask, Numbers, Snapshot
from pat3d.envs.physics.world import FLOOR, ROBOT, SUPPORT

TOPPLED_DEGREES = 30.0
"""An object that turned its upright axis by more than this since the start has toppled."""

UPRIGHT_DEGREES = 30.0
"""A container or a base that leans more than this holds nothing."""

STILL_SPEED = 0.05
"""Slower than this is at rest [m/s]."""

STILL_TURN = 0.5
"""Slower than this is at rest [rad/s]."""

EDGE = 0.01
"""What is this far below the surface of the work is off it [m]."""

DROP = 0.05
"""What touches the floor this far below its start fell there [m]."""

CONTACT_DEPTH = 0.01
"""The lowest point of what stands on a floor is at most this far below it [m]."""

OWNERS = 3
"""Owners of geoms that are no objects come first: object k of the scene has row OWNERS + k of a table of contacts."""

_TOPPLED_COSINE = math.cos(math.radians(TOPPLED_DEGREES))
_UPRIGHT_COSINE = math.cos(math.radians(UPRIGHT_DEGREES))
ROBOT_ROW, SUPPORT_ROW, FLOOR_ROW = OWNERS + ROBOT, OWNERS + SUPPORT, OWNERS + FLOOR
"""Of the robot, the workbench and the floor in a table of contacts."""

NEAR_HAND, NEAR_GRASP, NEAR_GOAL = 0.2, 0.03, 0.25
"""Lengths over which the closeness of the hand to a grasp falls, from afar and close by, and of an object to its goal
[m]."""

LEVER = 0.05
"""What a turn of the hand by a radian counts in its distance from a grasp [m]."""


@compiled
def touched(s: Snapshot, world: int, obj: int) -> bool:
    """Whether the robot touches the object."""
    return s.touching[world, ROBOT_ROW, OWNERS + obj]


@compiled
def touch(s: Snapshot, world: int, first: int, second: int) -> bool:
    """Whether two objects are in contact."""
    return s.touching[world, OWNERS + first, OWNERS + second]


@compiled
def held(s: Snapshot, world: int, obj: int) -> bool:
    """Whether both fingers of an arm press on the object; one arm is the first and the last."""
    row = OWNERS + obj
    first = s.pinched[world, 0, row] & s.pinched[world, 1, row]
    return first | (s.pinched[world, -2, row] & s.pinched[world, -1, row])


@compiled
def grounded(s: Snapshot, world: int, obj: int) -> bool:
    """Whether the object touches the ground of its scene, which is the workbench or the floor."""
    return s.touching[world, SUPPORT_ROW, OWNERS + obj] | s.touching[world, FLOOR_ROW, OWNERS + obj]


@compiled
def still(s: Snapshot, world: int, obj: int) -> bool:
    """Whether the object is at rest."""
    first = max(s.dofs[obj], 0)
    along, about = s.qvel[world, first : first + 3], s.qvel[world, first + 3 : first + 6]
    slow = (_dot(along, along) < STILL_SPEED**2) & (_dot(about, about) < STILL_TURN**2)
    return slow | (s.dofs[obj] < 0)


@compiled
def at_rest(s: Snapshot, world: int, obj: int) -> bool:
    """Whether the robot has let go of the object and it does not move."""
    return still(s, world, obj) & (not touched(s, world, obj))


@compiled
def uprightness(s: Snapshot, world: int, obj: int) -> float:
    """Cosine of the angle between the object's upright direction and that at the start."""
    return _dot(s.xmat[world, s.bodies[obj], 6:], s.start_up[world, obj])


@compiled
def toppled(s: Snapshot, world: int, obj: int) -> bool:
    """Whether the object turned over, or nearly, and is not in the robot's hand."""
    return (uprightness(s, world, obj) < _TOPPLED_COSINE) & (not held(s, world, obj))


@compiled
def fell(s: Snapshot, world: int, obj: int) -> bool:
    """Whether the object dropped from the surface of the work."""
    now, before = s.xipos[world, s.bodies[obj], 2], s.start_centre[world, obj, 2]
    # What stood on the floor from the start, as a table does, never falls.
    off = (now < s.surface) & (s.surface <= before)
    return off | ((before > now + DROP) & s.touching[world, FLOOR_ROW, OWNERS + obj])


@compiled
def inside(s: Snapshot, world: int, f: Floors, pair: int) -> bool:
    """Whether a child lies in the cavity of its parent: over its floor, lowest below the rim, parent upright."""
    child, parent, bottom, reach = f.children[pair], f.parents[pair], f.floor[pair, 2], f.reach[pair]
    rim = bottom + f.height[pair]
    if not f.present[pair] or uprightness(s, world, parent) < _UPRIGHT_COSINE:
        return False
    x, y, z = _in_frame(s, world, parent, s.xipos[world, s.bodies[child]])
    outside = _outside(f, pair, x, y)
    if not z > bottom - CONTACT_DEPTH or outside > reach or z - reach > rim:
        return False
    # Some corner is no higher than the centre of mass.
    if outside <= 0.0 and z < rim:
        return True
    x, y, lowest = _lowest(s, world, f, pair)
    # An object that leans on the rim is inside when its foot is.
    return lowest < rim and (outside <= 0.0 or _outside(f, pair, x, y) <= 0.0)


@compiled
def on_top(s: Snapshot, world: int, f: Floors, pair: int) -> bool:
    """Whether a child stands on its parent: in contact, its centre over the upper floor, parent upright."""
    child, parent = f.children[pair], f.parents[pair]
    if not (f.present[pair] and touch(s, world, child, parent)) or uprightness(s, world, parent) < _UPRIGHT_COSINE:
        return False
    x, y, _ = _in_frame(s, world, parent, s.xipos[world, s.bodies[child]])
    return _outside(f, pair, x, y) <= 0.0 and _lowest(s, world, f, pair)[2] > f.floor[pair, 2] - CONTACT_DEPTH


@compiled
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def supports(s: Snapshot, body: int, corners: Array, directions: Array) -> Array:
    """How far a body reaches along directions [m], from its corners in its own frame, shape (worlds, directions)."""
    found = np.empty((len(s.xpos), len(directions)))
    for world in range(found.shape[0]):
        turn, origin = s.xmat[world, body], s.xpos[world, body]
        for k in range(found.shape[1]):
            d, own = directions[k], np.empty(3)
            for axis in range(3):
                own[axis] = d[0] * turn[axis] + d[1] * turn[3 + axis] + d[2] * turn[6 + axis]
            most = -np.inf
            for corner in range(len(corners)):
                most = max(most, _dot(corners[corner], own))
            found[world, k] = most + _dot(d, origin)
    return found


@compiled
def _in_frame(s, world, obj, point):
    """A point of the world in the frame of an object [m]."""
    turn, origin = s.xmat[world, s.bodies[obj]], s.xpos[world, s.bodies[obj]]
    a, b, c = point[0] - origin[0], point[1] - origin[1], point[2] - origin[2]
    return (
        a * turn[0] + b * turn[3] + c * turn[6],
        a * turn[1] + b * turn[4] + c * turn[7],
        a * turn[2] + b * turn[5] + c * turn[8],
    )


@compiled
def _outside(f, pair, x, y):
    """How far beyond the edge of the floor a point of the parent's frame is [m]; not positive over it."""
    away_x, away_y = abs(x - f.floor[pair, 0]), abs(y - f.floor[pair, 1])
    if f.disc[pair]:
        return math.hypot(away_x, away_y) - f.half[pair, 0]
    return max(away_x - f.half[pair, 0], away_y - f.half[pair, 1])


@compiled
def _lowest(s, world, f, pair):
    """The child's lowest corner in its parent's frame [m]."""
    parent, body = f.parents[pair], s.bodies[f.children[pair]]
    turn, own, origin = s.xmat[world, s.bodies[parent]], s.xmat[world, body], s.xpos[world, body]
    up = np.empty(3)
    for k in range(3):
        up[k] = own[k] * turn[2] + own[3 + k] * turn[5] + own[6 + k] * turn[8]
    best, lowest = f.ends[pair], np.inf
    for corner in range(f.ends[pair], f.ends[pair + 1]):
        height = _dot(f.corners[corner], up)
        if height < lowest:
            best, lowest = corner, height
    point = np.empty(3)
    for k in range(3):
        point[k] = _dot(own[3 * k : 3 * k + 3], f.corners[best]) + origin[k]
    return _in_frame(s, world, parent, point)


@compiled
def upsets(s: Snapshot) -> tuple[Mask, Mask]:
    """Which objects toppled, and which fell, shape (worlds, objects)."""
    shape = s.start_centre.shape[:2]
    turned, dropped = np.empty(shape, np.bool_), np.empty(shape, np.bool_)
    for world in range(shape[0]):
        for obj in range(shape[1]):
            turned[world, obj], dropped[world, obj] = toppled(s, world, obj), fell(s, world, obj)
    return turned, dropped


@compiled
def pairs_that(s: Snapshot, f: Floors, within: bool) -> Mask:
    """Where children are inside their parents, or on top of them, shape (worlds, pairs)."""
    found = np.empty((len(s.xpos), len(f.children)), np.bool_)
    for world in range(found.shape[0]):
        for pair in range(found.shape[1]):
            found[world, pair] = inside(s, world, f, pair) if within else on_top(s, world, f, pair)
    return found


@compiled
def _lasts(timer, world, holds, seconds, needed):
    """Whether a condition has held without a break for long enough; `timer` counts, shape (worlds,)."""
    timer[world] = timer[world] + seconds[world] if holds else 0.0
    # A step of the control period is as fine as time is measured.
    return timer[world] >= needed - 1e-9


@compiled
def _closeness(a, b, scale):
    """1 where two points are the same, falling to nothing over a few `scale` [m] between them."""
    return 1.0 - math.tanh(math.sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2) / scale)


@compiled
def reached(s: Snapshot, world: int, obj: int) -> float:
    """How close the hand is to the nearest grasp of the object, in [0, 1]; to its middle where no grasp is known.

    Half of it is for coming near, the other for the last centimetres, where a hand is between a grasp and none.
    """
    grips, hand, least = s.grips, s.sites[world, s.hand], np.inf
    frame, own = s.site_xmat[world, s.hand], s.xmat[world, s.bodies[obj]]
    x, y, z = _in_frame(s, world, obj, hand)
    approach, closing = np.empty(3), np.empty(3)
    for k in range(3):
        # Rows of the hand's frame times those of the object's: its directions in the object's frame.
        approach[k] = own[k] * frame[2] + own[3 + k] * frame[5] + own[6 + k] * frame[8]
        closing[k] = 0.0
        for row in range(3):
            closing[k] += own[3 * row + k] * _dot(frame[3 * row : 3 * row + 3], grips.axis)
    for k in range(grips.ends[obj], grips.ends[obj + 1]):
        at = grips.position[k]
        away = math.sqrt((x - at[0]) ** 2 + (y - at[1]) ** 2 + (z - at[2]) ** 2)
        for cosine in (_dot(approach, grips.approach[k]), abs(_dot(closing, grips.closing[k]))):
            away += LEVER * math.acos(min(max(cosine, -1.0), 1.0))
        least = min(least, away)
    if least == np.inf:
        return _closeness(hand, s.xipos[world, s.bodies[obj]], NEAR_HAND)
    return 1.0 - 0.5 * (math.tanh(least / NEAR_HAND) + math.tanh(least / NEAR_GRASP))


@compiled
def _approach(s, world, obj, goal):
    """How far the move of an object is, in [0, 1)."""
    centre = s.xipos[world, s.bodies[obj]]
    near = reached(s, world, obj)
    return 0.2 * near + 0.2 * held(s, world, obj) + 0.5 * _closeness(goal, centre, NEAR_GOAL)


@compiled
def judge_lift(
    s: Snapshot, target: int, height: float, needed: float, timer: Array, seconds: Array
) -> tuple[Mask, Mask, Mask, Array, Array]:
    """Whether `target` is grasped, lifted, and has been for long enough; then progress and goal."""
    worlds = len(timer)
    grasped, lifted, done = np.empty(worlds, np.bool_), np.empty(worlds, np.bool_), np.empty(worlds, np.bool_)
    progress, goal = np.empty(worlds), np.empty((worlds, 3))
    for w in range(worlds):
        centre, start = s.xipos[w, s.bodies[target]], s.start_centre[w, target]
        rise, in_touch = centre[2] - start[2], touched(s, w, target)
        grasped[w], lifted[w] = held(s, w, target), rise >= height and in_touch
        done[w] = _lasts(timer, w, lifted[w], seconds, needed)
        goal[w, 0], goal[w, 1], goal[w, 2] = start[0], start[1], start[2] + height
        steps = reached(s, w, target) + grasped[w]
        steps += min(max(rise, 0.0) / height, 1.0) * in_touch + min(timer[w] / needed, 1.0)
        progress[w] = 1.0 if done[w] else steps / 4.0
    return grasped, lifted, done, progress, goal


@compiled
def judge_put(
    s: Snapshot, f: Floors, within: bool, above: float, needed: float, timer: Array, seconds: Array
) -> tuple[Mask, Mask, Mask, Mask, Array, Array]:
    """Whether the child of the only pair is in or on its place, released, the place upright, all of it for long enough.

    Then progress, and the goal, which is `above` the middle of the floor.
    """
    worlds, target, where = len(timer), f.children[0], f.parents[0]
    there, released = np.empty(worlds, np.bool_), np.empty(worlds, np.bool_)
    upright, done = np.empty(worlds, np.bool_), np.empty(worlds, np.bool_)
    progress, goal = np.empty(worlds), np.empty((worlds, 3))
    for w in range(worlds):
        there[w] = inside(s, w, f, 0) if within else on_top(s, w, f, 0)
        released[w], upright[w] = at_rest(s, w, target), not toppled(s, w, where)
        done[w] = _lasts(timer, w, there[w] and released[w] and upright[w], seconds, needed)
        turn, origin = s.xmat[w, s.bodies[where]], s.xpos[w, s.bodies[where]]
        for k in range(3):
            goal[w, k] = origin[k] + _dot(turn[3 * k : 3 * k + 3], f.floor[0])
        goal[w, 2] += above
        centre = s.xipos[w, s.bodies[target]]
        steps = 0.2 * (1.0 if there[w] else reached(s, w, target))
        steps += 0.2 * (there[w] or held(s, w, target)) + 0.2 * (there[w] and released[w])
        steps += 0.4 * (1.0 if there[w] else _closeness(goal[w], centre, NEAR_GOAL))
        progress[w] = 1.0 if done[w] else min(steps, 1.0)
    return there, released, upright, done, progress, goal


@compiled
def judge_sort(
    s: Snapshot, f: Floors, needed: float, timer: Array, seconds: Array
) -> tuple[Mask, Mask, Mask, Array, Numbers, Array]:
    """Which children are in their parents, shape (worlds, pairs), whether all rest, and all of it for long enough.

    Then progress, the next child, and its goal.
    """
    worlds, count = len(timer), len(f.children)
    there, resting, done = np.empty((worlds, count), np.bool_), np.empty(worlds, np.bool_), np.empty(worlds, np.bool_)
    progress, target, goal = np.empty(worlds), np.empty(worlds, np.int64), np.empty((worlds, 3))
    for w in range(worlds):
        resting[w], pending, sorted_ = True, -1, 0
        for pair in range(count):
            there[w, pair] = inside(s, w, f, pair)
            resting[w] = resting[w] and at_rest(s, w, f.children[pair])
            sorted_ += there[w, pair]
            if not there[w, pair] and pending < 0:
                pending = pair
        done[w] = _lasts(timer, w, pending < 0 and resting[w], seconds, needed)
        target[w], goal[w] = f.children[max(pending, 0)], s.xpos[w, s.bodies[f.parents[max(pending, 0)]]]
        begun = _approach(s, w, target[w], goal[w]) if pending >= 0 else 0.0
        progress[w] = 1.0 if done[w] else min((sorted_ + begun) / count, 1.0)
    return there, resting, done, progress, target, goal


@compiled
def judge_unload(
    s: Snapshot, f: Floors, height: float, needed: float, timer: Array, seconds: Array
) -> tuple[Mask, Mask, Mask, Mask, Array, Numbers, Array]:
    """Whether no child is in or at its parent, all rest, none fell, and all of it for long enough.

    Then progress, the highest child that is still there (of all where none is), and its goal, `height` above its start.
    """
    worlds, count = len(timer), len(f.children)
    empty, resting = np.empty(worlds, np.bool_), np.empty(worlds, np.bool_)
    safe, done = np.empty(worlds, np.bool_), np.empty(worlds, np.bool_)
    progress, target, goal = np.empty(worlds), np.empty(worlds, np.int64), np.empty((worlds, 3))
    for w in range(worlds):
        resting[w], remaining, fallen, target[w] = True, 0, 0, f.children[0]
        for pair in range(count):
            child = f.children[pair]
            within = touch(s, w, child, f.parents[pair]) or inside(s, w, f, pair)
            resting[w] = resting[w] and at_rest(s, w, child)
            fallen += fell(s, w, child)
            higher = s.xipos[w, s.bodies[child], 2] > s.xipos[w, s.bodies[target[w]], 2]
            if (within and remaining == 0) or (higher and (within or remaining == 0)):
                target[w] = child
            remaining += within
        empty[w], safe[w] = remaining == 0, fallen == 0
        done[w] = _lasts(timer, w, empty[w] and safe[w] and resting[w], seconds, needed)
        start = s.start_centre[w, target[w]]
        goal[w, 0], goal[w, 1], goal[w, 2] = start[0], start[1], start[2] + height
        begun = 0.0 if empty[w] else _approach(s, w, target[w], goal[w])
        progress[w] = 1.0 if done[w] else min(max((count - remaining - fallen + begun) / count, 0.0), 1.0)
    return empty, resting, safe, done, progress, target, goal


@compiled
def judge_others(s: Snapshot, target: int, sound: Mask) -> None:
    """`sound` becomes False where anything but `target` has toppled or fallen."""
    for world in range(len(sound)):
        for obj in range(len(s.bodies)):
            sound[world] &= (obj == target) | (not (toppled(s, world, obj) | fell(s, world, obj)))
