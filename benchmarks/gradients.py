"""Are the simulator's gradients those of central differences?

Each case is differentiated once by the adjoint and, in several random directions, by central differences of rollouts
converged to rounding. The differences span steps h of a factor 1000, extrapolated to fourth order from h and h / 4;
the estimate is the one that agrees best with its neighbour, without looking at the adjoint. Errors are relative to the
root mean square of the case's directional derivatives. `spread` is how far the neighbours disagree: an error below it
is luck, and the differences themselves resolve no more.

Where a contact is made or broken, or changes its closest features (corner, edge, face), anywhere in the rollouts that
a difference compares, or where they differ in a decision (how many steps, where friction is anchored), the map has a
kink inside the difference interval. Such intervals are not used. A direction without usable intervals is reported as
not smooth, and the picture shows what the derivative does there.

python -m benchmarks.gradients [--quick] [--device cuda] [--only WORD] [--memory]
    [--picture benchmarks/pictures/gradients.png]
"""

from __future__ import annotations

import argparse
import math
import time
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import torch
import warp as wp
from numpy.typing import NDArray

from benchmarks.gradient_cases import Case, Outcome, cases, stack
from benchmarks.gradient_plot import save_picture
from pat3d.sim.arrays import Bodies
from pat3d.sim.contact.pairs import Pairs, contact_at
from pat3d.sim.model import Model
from pat3d.sim.recording import Recording
from pat3d.sim.rollouts import rollout
from pat3d.sim.run import SettleOptions
from pat3d.sim.startup import quiet_warp
from pat3d.sim.terms.potential import Potential

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

STEPS = 1.6e-5 * 0.25 ** np.arange(6)
"""h; perturbations are h [m] of positions, 0.2 h of affine entries, and parameters times 1 + 1000 h."""
DIRECTIONS = 3
UNRESOLVED = 1e-2
"""Relative disagreement of neighbouring estimates beyond which a direction counts as not smooth."""
TARGETS = {"step": 1e-6, "frames": 1e-4, "rest": 1e-4}


# Which contacts touch how


@wp.kernel
def _features(
    bodies: Bodies,
    pairs: Pairs,
    d_hat: wp.float64,
    position: wp.array(dtype=wp.vec3d),
    rows: wp.array2d(dtype=int),
):
    pair = wp.tid()
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    if contact.distance < d_hat:
        rows[pair, 0] = bodies.world[contact.body_a] + 1
        for i in range(4):
            rows[pair, 1 + i] = pairs.vertices[pair][i]
        rows[pair, 5] = pairs.kind[pair]
        rows[pair, 6] = contact.free
        if contact.mollifier < wp.float64(1.0):
            rows[pair, 7] = 1


def signatures(model: Model, record: Recording, states: NDArray[np.float64]) -> NDArray[np.uint64]:
    """A number for everything discrete about every step of every world, shape (worlds, 2 steps + 1).

    The closest features of every contact at the end of the step, and the decisions that shaped the step.
    """
    potential = Potential(model)
    mix = np.random.default_rng(0).integers(1, 2**63, size=(4, 8), dtype=np.uint64) | np.uint64(1)
    vertices = len(model.vertex_rest) // model.worlds
    result = np.zeros((model.worlds, 2 * len(record.steps) + 1), dtype=np.uint64)
    for k, state in enumerate(states):
        step = record.steps[max(k - 1, 0)]
        potential.contact.d_hat = step.d_hat
        found = potential.candidates
        found.built = False
        potential.cover(wp.array(np.ascontiguousarray(state), dtype=wp.vec3d, device=model.device))
        rows = wp.zeros((max(found.count, 1), 8), dtype=int, device=model.device)
        wp.launch(
            _features,
            dim=found.count,
            device=model.device,
            inputs=[model.body_arrays, found.pairs, step.d_hat, potential.vertex_positions, rows],
        )
        table = rows.numpy()
        table = table[table[:, 0] > 0].astype(np.int64)
        world = table[:, 0] - 1
        local = np.where(table[:, 1:5] < 0, -1, table[:, 1:5] - vertices * world[:, None]) + 2
        keys = (np.concatenate([local, table[:, 5:]], axis=1).astype(np.uint64) * mix[0, :7]).sum(axis=1)
        keys ^= keys >> np.uint64(31)
        np.add.at(result[:, 2 * k], world, keys * mix[1, 0])
        if k:
            decided = np.stack([step.active, step.sigma.view(np.uint64), step.reference], axis=1).astype(np.uint64)
            # An idle world's other numbers mean nothing.
            result[:, 2 * k - 1] = np.where(step.active, (decided * mix[2, :3]).sum(axis=1), 0)
    return result


# Differences


def measure(case: Case, device: str) -> Outcome:
    """Differentiate a case both ways."""
    begun = time.perf_counter()
    rng = np.random.default_rng(1)
    sizes = STEPS * case.finer
    count = DIRECTIONS if case.by in ("q0", "mass") else 1
    # World 0 is the case itself, then come direction, h, and the sign of the perturbation.
    shifts = np.array([0.0, *(sign * h for _ in range(count) for h in sizes for sign in (1, -1))])
    which = np.array([0, *np.repeat(np.arange(count), 2 * len(sizes))])
    worlds = len(shifts)
    model = case.build().finalize(device, worlds)
    bodies = model.bodies // worlds
    free = model.is_free[:bodies]
    q0 = model.q0.reshape(worlds, bodies, 12).copy()
    mass = model.body_mass.numpy().reshape(worlds, bodies).copy()
    friction, d_hat = np.full(worlds, case.friction), np.full(worlds, SettleOptions().d_hat)
    shape = {"q0": (bodies, 12), "mass": (bodies,)}.get(case.by, ())
    directions = np.ones((count, 1)) if not shape else rng.normal(size=(count, *shape))
    if case.by == "q0":
        directions *= np.where(np.arange(12) < 3, 1.0, 0.2) * free[:, None]
        q0 += shifts[:, None, None] * directions[which]
    elif case.by == "mass":
        directions *= 1000.0 * mass[0] * free
        mass += shifts[:, None] * directions[which]
    else:
        target = friction if case.by == "friction" else d_hat
        directions = directions[:, 0] * 1000.0 * target[0]
        target += shifts * directions[which]
    weights = torch.from_numpy(rng.normal(size=(2, bodies, 12)) * free[:, None])

    def run(model: Model, chosen: slice) -> tuple[torch.Tensor, dict[str, Any], NDArray[np.uint64]]:
        given = {"q0": q0[chosen], "friction": friction[chosen], "mass": mass[chosen], "d_hat": d_hat[chosen][0]}
        tensors: dict[str, Any] = {
            key: torch.tensor(value, requires_grad=key == case.by) for key, value in given.items()
        }
        done = rollout(model, until=case.until, options=SettleOptions(), **tensors)
        middle = done.frames[len(done.frames) // 2]
        losses = (middle * weights[0] + done.q_end * weights[1]).sum(dim=(1, 2))
        record: Any = done.frames.grad_fn
        states = done.frames.detach().numpy().reshape(len(done.frames), -1, 4, 3)
        return losses, tensors, signatures(model, record.record, states)

    if case.by == "d_hat":
        # Worlds of one rollout share it.
        single = case.build().finalize(device)
        runs = [run(single, slice(w, w + 1)) for w in range(worlds)]
        losses = torch.cat([losses for losses, *_ in runs])
        tensors, marks = runs[0][1], np.concatenate([mark for *_, mark in runs])
    else:
        losses, tensors, marks = run(model, slice(None))
    losses[0].backward()
    gradient = tensors[case.by].grad
    gradient = (gradient if case.by == "d_hat" else gradient[0]).numpy()
    analytic = np.array([float((gradient * direction).sum()) for direction in directions])
    values = losses.detach().numpy()
    sides = values[1:].reshape(count, len(sizes), 2)
    smooth = np.all(marks[1:] == marks[0], axis=1).reshape(count, len(sizes), 2).all(axis=2)
    forward, back = (sides[..., 0] - values[0]) / sizes, (values[0] - sides[..., 1]) / sizes
    central = (forward + back) / 2
    fourth = (16 * central[:, 1:] - central[:, :-1]) / 15
    scale = np.sqrt(np.mean(analytic**2))
    errors, steps, spread, one_sided = np.full(count, np.nan), np.full(count, np.nan), 0.0, 0.0
    for d in range(count):
        usable = smooth[d, :-1] & smooth[d, 1:]
        apart = np.where(usable[:-1] & usable[1:], np.abs(np.diff(fourth[d])), np.inf)
        if np.isfinite(apart).any() and apart.min() < UNRESOLVED * scale:
            best = int(np.argmin(apart))
            errors[d], steps[d] = abs(fourth[d, best] - analytic[d]) / scale, sizes[best]
            spread = max(spread, apart[best] / scale)
        else:
            one_sided = max(one_sided, np.abs(forward[d] - back[d]).min() / scale)
    shown = int(np.argmax(np.isnan(errors)))
    return Outcome(
        case=case,
        errors=errors,
        spread=spread,
        steps=steps,
        one_sided=one_sided,
        curve=(sizes, forward[shown] / analytic[shown], back[shown] / analytic[shown]),
        seconds=time.perf_counter() - begun,
        time_steps=marks.shape[1] // 2,
    )


def row(outcome: Outcome) -> str:
    """One line of the table."""
    case = outcome.case
    rough = int(np.isnan(outcome.errors).sum())
    error = f"{np.nanmax(outcome.errors):.1e}" if rough < len(outcome.errors) else "-"
    target = TARGETS[case.kind]
    if rough:
        verdict = f"not smooth in {rough} of {len(outcome.errors)}: sides differ by {outcome.one_sided:.1e}"
    elif np.nanmax(outcome.errors) > target:
        verdict = "ABOVE TARGET"
    else:
        verdict = "ok" if outcome.spread <= target else f"within target, but differences resolve {outcome.spread:.1e}"
    chosen = np.nanmin(outcome.steps) if rough < len(outcome.errors) else math.nan
    until = f"{outcome.time_steps} to rest" if case.until == "rest" else str(case.until)
    return (
        f"{case.name:<34} {case.by:<9} {until:>11} {error:>9} {outcome.spread:>9.1e} "
        f"{chosen:>8.0e} {outcome.seconds:>6.1f}  {verdict}"
    )


def memory(device: str, worlds: int = 64, steps: int = 100) -> None:
    """Print host memory and time of rollouts that keep every state or few, and how far their gradients differ."""
    model = stack(4)().finalize(device, worlds)
    print(f"{worlds} worlds of {model.bodies // worlds} bodies, {steps} steps")
    print(f"{'every':>6} {'kept after forward':>19} {'peak':>9} {'forward':>8} {'backward':>9}  gradients differ")
    first = None
    for every in (1, 10, steps):
        q0 = torch.tensor(model.q0.reshape(worlds, -1, 12), requires_grad=True)
        tracemalloc.start()
        begun = time.perf_counter()
        done = rollout(model, q0, until=steps, every=every)
        ran = time.perf_counter()
        kept = tracemalloc.get_traced_memory()[0]
        done.q_end.square().sum().backward()
        ended, peak = time.perf_counter(), tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        first = q0.grad if first is None else first
        print(
            f"{every:>6} {kept / 2**20:>15.1f} MiB {peak / 2**20:>5.1f} MiB {ran - begun:>6.1f} s {ended - ran:>7.1f} s"
            f"  {float((q0.grad - first).abs().max()):.1e}"
        )


def main() -> None:
    """Measure, print the table, and draw the picture that is asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="a subset, under a minute")
    parser.add_argument("--only", default="", help="cases whose name contains this")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--memory", action="store_true", help="what keeping fewer states saves, instead of the table")
    arguments = parser.parse_args()
    quiet_warp()
    if arguments.memory:
        memory(arguments.device)
        return
    print(f"{'case':<34} {'by':<9} {'steps':>11} {'error':>9} {'spread':>9} {'h':>8} {'s':>6}")
    outcomes = []
    for case in cases():
        if (case.quick or not arguments.quick) and arguments.only in case.name:
            outcomes.append(measure(case, arguments.device))
            print(row(outcomes[-1]), flush=True)
    if arguments.picture:
        save_picture(outcomes, TARGETS, arguments.picture)
    for kind, label in (("step", "single steps"), ("frames", "60 frames"), ("rest", "to rest")):
        group = [outcome for outcome in outcomes if outcome.case.kind == kind]
        errors = np.concatenate([outcome.errors for outcome in group] or [np.array([])])
        if np.isfinite(errors).any():
            print(
                f"{label}: worst {np.nanmax(errors):.1e} (target {TARGETS[kind]:.0e}), "
                f"median {np.nanmedian(errors):.1e}; "
                f"{int(np.isnan(errors).sum())} of {len(errors)} directions not smooth"
            )


if __name__ == "__main__":
    main()
