"""The protocol of an energy term of the incremental potential: value and gradient, Hessian, each a list of launches.

A new physical term is a file beside this one whose class has these two methods, and a line in `Potential`: the solver,
the residual, the backward pass and the lists of modules to compile follow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import warp as wp


@dataclass(frozen=True, kw_only=True, eq=False)
class Evaluation:
    """Where terms are evaluated: a state, and the worlds that count."""

    q: wp.array
    """State, shape (bodies, 4), vec3d."""
    position: wp.array
    """Vertex positions at the state [m], shape (vertices,), vec3d."""
    active: wp.array
    """Active mask: nonzero for worlds to evaluate, shape (worlds,), int."""
    at_rest: bool = False
    """Whether the pull of inertia is left out."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Launch:
    """One launch of a kernel."""

    kernel: Any
    dim: int
    inputs: tuple[Any, ...]
    outputs: tuple[Any, ...]

    def __call__(self, device: str) -> None:
        """Launch it."""
        wp.launch(self.kernel, dim=self.dim, inputs=self.inputs, outputs=self.outputs, device=device)


class Term(Protocol):
    """One energy term of every world."""

    def value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """Launches that add the energy [J] to `energy` and its derivative by the state to `gradient`.

        Args:
            at: state and active worlds.
            energy: shape (worlds,), float64.
            gradient: shape (bodies, 4), vec3d [N, N m].
        """
        ...

    def hessian_launches(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> Sequence[Launch]:
        """Launches that add the second derivative, or a positive semidefinite stand-in, to `hessian`.

        Args:
            at: state and active worlds.
            exact: nonzero for worlds that get the derivative itself, shape (worlds,), int.
            hessian: shape (worlds, unknowns, unknowns), float64.
        """
        ...
