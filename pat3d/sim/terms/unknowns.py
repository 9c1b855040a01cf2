# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Where the eight state vectors of a pair of bodies are among the unknowns of their world."""

from __future__ import annotations

import warp as wp


@wp.func
def first_unknown(body: int, dof: wp.array(dtype=int)) -> int:
    """First unknown of a body in its world; -1 where it is fixed or the ground."""
    if body < 0:
        return -1
    if dof[body] < 0:
        return -1
    return 12 * dof[body]


@wp.func
def pair_index(k: int, base_a: int, base_b: int) -> int:
    """First unknown of the k-th of a pair's eight vectors; negative where its body is fixed."""
    if k < 4:
        if base_a < 0:
            return -1
        return base_a + 3 * k
    if base_b < 0:
        return -1
    return base_b + 3 * (k - 4)


@wp.func
def add_block(hessian: wp.array3d(dtype=wp.float64), world: int, row: int, column: int, block: wp.mat33d):
    """Add a block of nine numbers to a Hessian, shape (worlds, unknowns, unknowns)."""
    for r in range(3):
        for s in range(3):
            wp.atomic_add(hessian, world, row + r, column + s, block[r, s])
