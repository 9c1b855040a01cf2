"""Scale, place and yaw of an asset from the pixels that show it: what is drawn has to be what is seen.

Every candidate is drawn and judged by the pixels around the mask (`pat3d.vision.window`). The camera sees directions
well and distances badly, so the search is over direction and distance of the middle, the angle that the asset fills,
and yaw: for each of many yaws the first three follow from areas and medians, and the best few are refined by the
simplex method, which does not mind that the judgement has steps, and by Gauss and Newton's, which ends at the least
squares of the ranges (`pat3d.vision.guess`). It begins with a larger sigma, so that what is far off still feels where
it belongs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.optimize import minimize

from pat3d.geometry.rotations import yaw_of
from pat3d.vision.camera import Array, PlacedCamera
from pat3d.vision.caster import Caster, Placement
from pat3d.vision.guess import Guess, polished
from pat3d.vision.observation import Observation
from pat3d.vision.stance import Stance
from pat3d.vision.window import Window

YAWS = 24
"""First guesses."""
TRIED, REFINED = 7, 3
"""Yaws that are refined roughly, the best of the first guesses that are no neighbours; and of those, exactly."""
STARTS = (1.0, 2.2)
"""Sizes of first guesses, over what the mask would say if nothing hid the object."""
BLUR, HALFWAY = 12.0, 3.5
"""Factors on sigma of the rough refinement, and of what comes between it and the exact one."""
RESTARTS = 3
"""Of the simplex method at most, while each makes the cost less by a twentieth."""
COARSE, FINE, SHARP = 400, 1500, 6000
"""Pixels that judge, around a mask that fills a rectangle; the last where two candidates are nearly as good."""
NEARLY = 0.15
"""Difference of costs that noise and few pixels can make."""
ROUGH_STEPS, STEPS = 70, 130
"""Drawings of one refinement."""
UNEXPLAINED = 0.4
"""Cost from which on an object may stand otherwise than upright."""
UPRIGHT = math.cos(math.radians(5.0))
"""What leans by less stands."""
TURNS = 160
"""Orientations that are tried then."""
STOOD_LOSS = 0.1
"""Cost that knowing the height of its support may add to a fit."""
TILT_GAIN = 0.8
"""Cost of a tilted candidate over that of the best upright one, from which on it is believed."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """How an asset explains the pixels of an object."""

    placed: Placement
    tilted: bool
    """Whether it is turned otherwise than about the vertical."""
    cost: float
    """Mean over the mask's pixels beyond what the noise costs, from 0 (explained exactly) to about CAP."""
    overlap: float
    """Of the pixels that asset or mask claim and nothing hides, those that both do [-]."""


def fit(seen: Observation, camera: PlacedCamera, name: str, caster: Caster, *, stance: Stance | None = None) -> Fit:
    """Scale, place and yaw with which `caster`'s mesh explains the pixels of object `name`.

    Where none does, other orientations are tried: pens lean in cups, bananas lie.

    Args:
        seen: what is seen.
        camera: in a frame whose z is up.
        name: of the object.
        caster: its mesh, in a frame whose z is up.
        stance: how it stands, as somebody says; decides between candidates that the pixels leave nearly as good.
    """
    said = stance or Stance()
    coarse, fine = (Window(seen, camera, name, pixels) for pixels in (COARSE, FINE))
    rings = [[_aligned(coarse, caster, start, yaw=2 * math.pi * k / YAWS) for k in range(YAWS)] for start in STARTS]
    firsts = [ring[k] for ring in rings for k in _valleys(_costs(coarse, caster, ring))]
    sharp = Window(seen, camera, name, SHARP)
    best = _judged(sharp, caster, _turned_about(fine, caster, _best(coarse, fine, caster, firsts)))
    tilted = False
    if said.fallen or best[1] > fine.expected + UNEXPLAINED:
        turned = [_aligned(coarse, caster, start, first=one) for one in _orientations() for start in STARTS]
        order = np.argsort(_costs(coarse, caster, turned), kind="stable")
        found = _best(coarse, fine, caster, [turned[k] for k in order[:TRIED]], leans=True)
        leaning = _judged(sharp, caster, found, leans=True)
        most = best[1] + NEARLY if said.fallen else fine.expected + TILT_GAIN * (best[1] - fine.expected)
        if leaning[1] < most:
            best, tilted = _straightened(fine, caster, leaning)
    if not tilted:
        best = _faced(fine, caster, best, said)
    return _fit(fine, caster, *best, tilted=tilted)


def stood(seen: Observation, camera: PlacedCamera, name: str, caster: Caster, found: Fit, base: float) -> Fit:
    """`found` again, knowing that the lowest point of the object is at height `base` [m].

    What the ground or a table carries is as far away as they are at that place, which is known better than any depth
    of a small object.
    """
    fine = Window(seen, camera, name, FINE)
    placed = found.placed
    centre = placed.apply(caster.centre[None])[0] - fine.origin
    distance = float(np.linalg.norm(centre))
    # Away from the middle of the mask, in units of the plane that the middle ray is normal to.
    tangent = np.linalg.lstsq(np.column_stack([fine.right, fine.down, -centre / distance]), -fine.middle, rcond=None)[0]
    guess = Guess(
        float(tangent[0]),
        float(tangent[1]),
        distance,
        placed.scale * caster.radius / distance,
        0.0,
        first=placed.rotation,
        base=base,
    )
    best = _settled(fine, caster, _refined(fine, caster, guess))
    if best[1] > found.cost + fine.expected + STOOD_LOSS:
        # Models see small things before a far background too far away; what stands somewhere is there all the same.
        fine.shift_free = True
        best = _settled(fine, caster, _refined(fine, caster, guess))
    return _fit(fine, caster, *best, tilted=found.tilted)


def _fit(window: Window, caster: Caster, guess: Guess, cost: float, *, tilted: bool) -> Fit:
    placed = guess.placed(window, caster)
    drawn = caster.ranges(window.origin, window.rays, placed)
    return Fit(placed=placed, tilted=tilted, cost=max(0.0, cost - window.expected), overlap=window.overlap(drawn))


def _straightened(window: Window, caster: Caster, leaning: tuple[Guess, float]) -> tuple[tuple[Guess, float], bool]:
    """`leaning`, or the upright candidate next to it where it hardly leans; and whether it does."""
    guess, cost = leaning
    rotation = guess.placed(window, caster).rotation
    if rotation[2, 2] < UPRIGHT:
        return leaning, True
    upright = replace(guess, yaw=yaw_of(rotation), pitch=0.0, roll=0.0, first=None)
    found = _settled(window, caster, _refined(window, caster, upright))
    return (found, False) if found[1] < cost + NEARLY else (leaning, True)


def _turned_about(window: Window, caster: Caster, found: list[tuple[Guess, float]]) -> list[tuple[Guess, float]]:
    """`found`, best first, and what becomes of the best after quarter turns, which look alike until the last."""
    best, cost = found[0]
    if cost < window.perfect:
        return found
    quarters = [best.yaw + quarter * math.pi / 2 for quarter in (1, 2, 3)]
    others = [replace(best, yaw=yaw) for yaw in quarters]
    if cost > window.explained:
        # Turned by a quarter, what is longer than wide has another size too: only the mask tells which.
        others += [_aligned(window, caster, start, yaw=yaw) for start in STARTS for yaw in (best.yaw, *quarters)]
    tried = [_sharpened(window, caster, other) for other in others]
    return sorted([*found, *tried], key=lambda one: one[1])


def _judged(
    sharp: Window, caster: Caster, found: list[tuple[Guess, float]], *, leans: bool = False
) -> tuple[Guess, float]:
    """The best of `found`, best first, by more pixels where they are nearly as good as one another."""
    rivals = [one for one, cost in found if cost < found[0][1] + NEARLY]
    if len(rivals) == 1:
        return found[0]
    costs = sorted(((one.cost(sharp, caster), k) for k, one in enumerate(rivals)))
    closest = [rivals[k] for cost, k in costs if cost < costs[0][0] + NEARLY / 3][:2]
    tried = [_refined(sharp, caster, one, leans=leans, steps=ROUGH_STEPS) for one in closest]
    if len(tried) > 1 and sharp.noisy:
        # Between noise and noise, what is not quite at its best is worse than its rival.
        tried = [_settled(sharp, caster, one, leans=leans) for one in tried]
    return min(tried, key=lambda one: one[1])


def _faced(window: Window, caster: Caster, best: tuple[Guess, float], said: Stance) -> tuple[Guess, float]:
    """`best`, or what it becomes after turns by quarters where its front points against what is `said`."""
    if not said.denies(best[0].placed(window, caster).rotation, window.middle):
        return best
    turned = [replace(best[0], yaw=best[0].yaw + quarter * math.pi / 2) for quarter in (1, 2, 3)]
    agreed = [one for one in turned if not said.denies(one.placed(window, caster).rotation, window.middle)]
    tried = [_refined(window, caster, one, steps=ROUGH_STEPS) for one in agreed]
    other = _settled(window, caster, min(tried, key=lambda one: one[1]))
    return other if other[1] < best[0].cost(window, caster) + NEARLY else best


def _costs(window: Window, caster: Caster, guesses: list[Guess]) -> Array:
    return np.array([guess.cost(window, caster, BLUR) for guess in guesses])


def _best(
    coarse: Window, fine: Window, caster: Caster, firsts: list[Guess], *, leans: bool = False
) -> list[tuple[Guess, float]]:
    """`firsts` after refinement, roughly at first, and their costs; the best first."""
    firsts = sorted(firsts, key=lambda guess: guess.cost(coarse, caster, BLUR))[:TRIED]
    rough = [_refined(coarse, caster, guess, leans=leans, steps=ROUGH_STEPS, blur=BLUR) for guess in firsts]
    rough = sorted(rough, key=lambda one: one[1])
    exact: list[tuple[Guess, float]] = []
    for guess, _ in rough:
        exact.append(_sharpened(fine, caster, guess, leans=leans))
        least = min(cost for _, cost in exact)
        if least < fine.perfect or (len(exact) >= REFINED and least < fine.explained):
            break
    exact = sorted(exact, key=lambda one: one[1])
    return [_settled(fine, caster, exact[0], leans=leans), *exact[1:]]


def _sharpened(window: Window, caster: Caster, guess: Guess, *, leans: bool = False) -> tuple[Guess, float]:
    """`guess`, which is roughly right, refined in two steps."""
    near, _ = polished(window, caster, guess, leans=leans, blur=HALFWAY)
    found = polished(window, caster, near, leans=leans)
    if found[1] < window.perfect:
        return found
    if found[1] < window.explained:
        nearer = found[0]
    else:
        nearer, _ = _refined(window, caster, guess, leans=leans, steps=ROUGH_STEPS, blur=HALFWAY)
    return min(found, _refined(window, caster, nearer, leans=leans), key=lambda one: one[1])


@cache
def _orientations() -> tuple[Array, ...]:
    """Turns that are spread evenly, shape (3, 3) each."""
    from scipy.spatial.transform import Rotation

    return tuple(Rotation.random(TURNS, rng=np.random.default_rng(0)).as_matrix())


def _settled(window: Window, caster: Caster, found: tuple[Guess, float], *, leans: bool = False) -> tuple[Guess, float]:
    """What the simplex method comes to when it is started again where it ended."""
    for _ in range(RESTARTS):
        if found[1] < window.perfect:
            break
        again = _refined(window, caster, found[0], leans=leans)
        better = again[1] < 0.95 * found[1]
        found = min(found, again, key=lambda one: one[1])
        if not better:
            break
    return found


def _aligned(window: Window, caster: Caster, start: float, *, yaw: float = 0.0, first: Array | None = None) -> Guess:
    """A first guess at an orientation: the area and the middle of the mask, and its median distance."""
    guess = Guess(0.0, 0.0, window.distance, 0.7 * start * window.angle, yaw, first=first)
    fills, distance = guess.fills, guess.distance
    across = down = 0.0
    for _ in range(5):
        drawn = caster.ranges(window.origin, window.rays, guess.placed(window, caster))
        hit = np.isfinite(drawn) & (window.own | (window.contradicted(drawn) > 0.0))
        both = hit & window.own & np.isfinite(window.range)
        if np.count_nonzero(both) < 3:
            fills *= 1.3
        else:
            ratio = math.sqrt(window.count / np.count_nonzero(hit))
            shift = window.rays[window.own].mean(axis=0) - window.rays[hit].mean(axis=0)
            across, down = across + float(shift @ window.right), down + float(shift @ window.down)
            distance += float(np.median((window.range - drawn)[both]))
            distance = min(max(distance, 0.3 * window.distance), 3.0 * window.distance)
            fills *= min(max(ratio, 0.6), 1.6)
        guess = Guess(across, down, distance, fills, yaw, first=first)
    return guess


def _valleys(costs: Array) -> list[int]:
    """The lowest of a ring of costs, of which none are neighbours."""
    if costs.max() - costs.min() < 0.02 * max(costs.max(), 0.05):
        return [int(np.argmin(costs))]
    chosen: list[int] = []
    for k in np.argsort(costs, kind="stable"):
        if all(min((k - one) % len(costs), (one - k) % len(costs)) > 1 for one in chosen):
            chosen.append(int(k))
        if len(chosen) == TRIED:
            break
    return chosen


def _refined(
    window: Window,
    caster: Caster,
    first: Guess,
    *,
    leans: bool = False,
    steps: int = STEPS,
    blur: float = 1.0,
) -> tuple[Guess, float]:
    """The best near `first`, and its cost."""
    size = first.freedom(leans=leans)
    simplex = np.vstack([np.zeros(size), np.eye(size)]) - 0.3 / size
    found = minimize(
        lambda values: first.moved(values, leans=leans).cost(window, caster, blur),
        np.zeros(size),
        method="Nelder-Mead",
        options={
            "initial_simplex": simplex,
            "maxfev": steps * (2 if leans else 1),
            "xatol": 0.01,
            "fatol": 1e-4,
            "adaptive": True,
        },
    )
    return polished(window, caster, first.moved(found.x, leans=leans), leans=leans, blur=blur)
