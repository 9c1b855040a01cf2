# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Candidate contact pairs as kernels take them: kinds and vertices of primitives that may touch."""

from __future__ import annotations

import warp as wp

from pat3d.sim.contact.distance import POINT_GROUND, POINT_TRIANGLE, Contact, edge_edge, point_ground, point_triangle


@wp.struct
class Pairs:
    """Candidates, and the vertices that they speak of."""

    size: wp.array(dtype=int)
    """Number of pairs, shape (1,); kernels over the capacity of the buffers end at it."""
    kind: wp.array(dtype=int)
    """POINT_TRIANGLE, EDGE_EDGE or POINT_GROUND, shape (capacity,)."""
    vertices: wp.array(dtype=wp.vec4i)
    """(point, three corners), (two, two ends), or (point, -1, -1, -1), shape (capacity,)."""
    rest: wp.array(dtype=wp.vec3d)
    """Rest positions of all vertices about their centre of mass [m], shape (vertices,)."""
    body: wp.array(dtype=int)
    """Body of every vertex, shape (vertices,)."""


@wp.func
def contact_at(
    kind: int,
    vertices: wp.vec4i,
    position: wp.array(dtype=wp.vec3d),
    rest: wp.array(dtype=wp.vec3d),
    body: wp.array(dtype=int),
) -> Contact:
    """Contact of a candidate at the given positions of all vertices [m]; arguments as in `Pairs`."""
    i = vertices[0]
    j = vertices[1]
    k = vertices[2]
    m = vertices[3]
    contact = Contact()
    if kind == POINT_GROUND:
        contact = point_ground(position[i], rest[i])
        contact.body_b = -1
    elif kind == POINT_TRIANGLE:
        contact = point_triangle(position[i], position[j], position[k], position[m], rest[i], rest[j], rest[k], rest[m])
        contact.body_b = body[j]
    else:
        contact = edge_edge(position[i], position[j], position[k], position[m], rest[i], rest[j], rest[k], rest[m])
        contact.body_b = body[k]
    contact.body_a = body[i]
    return contact
