# pyright: reportInvalidTypeForm=false

"""Warp structs of what most kernels take of a model: one argument instead of several arrays.

Structs hold what kernels read; where threads add, the array stays an argument of its own. A launch copies the pointers
in a struct, so a recorded launch graph keeps those of the moment it was recorded. Functions take the arrays they need,
not the struct: on a CPU it would be copied in every thread, which costs a contact a tenth of its time.
"""

from __future__ import annotations

from typing import Any

import warp as wp


@wp.struct
class Bodies:
    """Where the unknowns of every body are."""

    world: wp.array(dtype=int)
    """World of every body, shape (bodies,)."""
    dof: wp.array(dtype=int)
    """Index among the free bodies of its world, -1 where fixed, shape (bodies,)."""


@wp.struct
class Vertices:
    """Points of the bodies' surfaces."""

    rest: wp.array(dtype=wp.vec3d)
    """Rest positions about the body's centre of mass [m], shape (vertices,)."""
    body: wp.array(dtype=int)
    """shape (vertices,)."""


@wp.struct
class AttachmentPoints:
    """Points of two bodies that are held together."""

    bodies: wp.array(dtype=wp.vec2i)
    """The two bodies, shape (attachments,)."""
    rest: wp.array2d(dtype=wp.vec3d)
    """Where the point is on either, about its centre of mass [m], shape (attachments, 2)."""
    stiffness: wp.array(dtype=wp.float64)
    """[N/m], shape (attachments,)."""


def filled(struct: Any, **fields: Any) -> Any:
    """An instance of a Warp struct with the given values."""
    instance = struct()
    for name, value in fields.items():
        setattr(instance, name, value)
    return instance
