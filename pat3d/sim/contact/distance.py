# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Closest points between the primitives of convex polyhedra, as functions of the bodies' affine maps.

A contact is a vector r = x_a - x_b between a point of body a and a point of body b (or the ground).
Both points are affine in their body's q = (p, a_1, a_2, a_3), so with the coefficients
c = (1, xbar_a, -1, -xbar_b) the vector is r = sum_i c_i q_i over the eight vectors of the pair.
The closest points themselves move with parameters beta (barycentric on a face, or positions along edges) that
minimise D = r . r. Differentiating the minimum implicitly gives one formula for every type of pair:

    grad D = 2 c (x) r
    hess D = 2 c c^T (x) I - sum_kl (G^-1)_kl f_k f_l^T,
    f_k = 2 (h_k (x) r + c (x) e_k),  G_kl = 2 e_k . e_l,  e_k = dr/dbeta_k = sum_i h_ki q_i.
"""

from __future__ import annotations

import warp as wp

vec8d = wp.types.vector(length=8, dtype=wp.float64)

POINT_TRIANGLE = wp.constant(0)
EDGE_EDGE = wp.constant(1)
POINT_GROUND = wp.constant(2)

# Relative squared sine under which two edges count as parallel (Li et al. 2020, IPC, section 5.1.5).
PARALLEL = wp.constant(wp.float64(1.0e-3))


@wp.struct
class Contact:
    """One pair of primitives at its closest points."""

    body_a: int
    body_b: int
    """-1 for the ground."""
    coefficients: vec8d
    """c: r = sum_i c_i q_i (the ground's half is zero)."""
    normal: wp.vec3d
    """r / |r|, from b to a."""
    distance: wp.float64
    """|r| [m]"""
    free: int
    """Number of closest-point parameters that are not clamped: 0, 1 or 2."""
    e1: wp.vec3d
    e2: wp.vec3d
    h1: vec8d
    h2: vec8d
    mollifier: wp.float64
    """1, or less for nearly parallel edges."""
    cross: wp.float64
    """|u x v|^2 of two edges [m^4]; 0 where the contact is no pair of edges."""
    threshold: wp.float64
    """|u x v|^2 under which the mollifier acts [m^4]."""
    u: wp.vec3d
    v: wp.vec3d
    rest_u: wp.vec3d
    rest_v: wp.vec3d


@wp.func
def closest_on_triangle(p: wp.vec3d, a: wp.vec3d, b: wp.vec3d, c: wp.vec3d):
    """Barycentric (weight of b, weight of c) of the point of triangle abc closest to p, and its feature.

    The feature is 0 for a corner, 1, 2, 3 for the edges ab, ac, bc and 4 for the face.
    """
    zero = wp.float64(0.0)
    one = wp.float64(1.0)
    ab = b - a
    ac = c - a
    ap = p - a
    d1 = wp.dot(ab, ap)
    d2 = wp.dot(ac, ap)
    if d1 <= zero and d2 <= zero:
        return zero, zero, 0
    bp = p - b
    d3 = wp.dot(ab, bp)
    d4 = wp.dot(ac, bp)
    if d3 >= zero and d4 <= d3:
        return one, zero, 0
    cp = p - c
    d5 = wp.dot(ab, cp)
    d6 = wp.dot(ac, cp)
    if d6 >= zero and d5 <= d6:
        return zero, one, 0
    vc = d1 * d4 - d3 * d2
    if vc <= zero and d1 >= zero and d3 <= zero:
        return d1 / (d1 - d3), zero, 1
    vb = d5 * d2 - d1 * d6
    if vb <= zero and d2 >= zero and d6 <= zero:
        return zero, d2 / (d2 - d6), 2
    va = d3 * d6 - d5 * d4
    if va <= zero and (d4 - d3) >= zero and (d5 - d6) >= zero:
        t = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return one - t, t, 3
    scale = one / (va + vb + vc)
    return vb * scale, vc * scale, 4


@wp.func
def closest_on_edges(p0: wp.vec3d, p1: wp.vec3d, q0: wp.vec3d, q1: wp.vec3d):
    """Parameters (s, t) in [0, 1] of the closest points p0 + s (p1 - p0) and q0 + t (q1 - q0)."""
    zero = wp.float64(0.0)
    one = wp.float64(1.0)
    u = p1 - p0
    v = q1 - q0
    w = p0 - q0
    a = wp.dot(u, u)
    e = wp.dot(v, v)
    f = wp.dot(v, w)
    c = wp.dot(u, w)
    b = wp.dot(u, v)
    determinant = a * e - b * b
    s = zero
    if determinant > wp.float64(1.0e-14) * a * e:
        s = wp.clamp((b * f - c * e) / determinant, zero, one)
    t = (b * s + f) / e
    if t < zero:
        t = zero
        s = wp.clamp(-c / a, zero, one)
    elif t > one:
        t = one
        s = wp.clamp((b - c) / a, zero, one)
    return s, t


@wp.func
def mollify(cross: wp.float64, threshold: wp.float64) -> wp.float64:
    """Weight of a pair of edges with |u x v|^2 = cross: 1 above the threshold, smoothly 0 when parallel."""
    if cross >= threshold:
        return wp.float64(1.0)
    ratio = cross / threshold
    return ratio * (wp.float64(2.0) - ratio)


@wp.func
def point_triangle(
    p: wp.vec3d,
    a: wp.vec3d,
    b: wp.vec3d,
    c: wp.vec3d,
    rest_p: wp.vec3d,
    rest_a: wp.vec3d,
    rest_b: wp.vec3d,
    rest_c: wp.vec3d,
) -> Contact:
    """Contact of a point of body a with a triangle of body b."""
    contact = Contact()
    wb, wc, feature = closest_on_triangle(p, a, b, c)
    ab = rest_b - rest_a
    ac = rest_c - rest_a
    on_b = rest_a + wb * ab + wc * ac
    r = p - (a + wb * (b - a) + wc * (c - a))
    if feature == 1:
        contact.free = 1
        contact.e1 = a - b
        contact.h1 = _second_half(ab)
    elif feature == 2:
        contact.free = 1
        contact.e1 = a - c
        contact.h1 = _second_half(ac)
    elif feature == 3:
        contact.free = 1
        contact.e1 = b - c
        contact.h1 = _second_half(rest_c - rest_b)
    elif feature == 4:
        contact.free = 2
        contact.e1 = a - b
        contact.e2 = a - c
        contact.h1 = _second_half(ab)
        contact.h2 = _second_half(ac)
    contact.mollifier = wp.float64(1.0)
    return _finish(contact, r, rest_p, on_b)


@wp.func
def edge_edge(
    p0: wp.vec3d,
    p1: wp.vec3d,
    q0: wp.vec3d,
    q1: wp.vec3d,
    rest_p0: wp.vec3d,
    rest_p1: wp.vec3d,
    rest_q0: wp.vec3d,
    rest_q1: wp.vec3d,
) -> Contact:
    """Contact of an edge of body a with an edge of body b."""
    zero = wp.float64(0.0)
    one = wp.float64(1.0)
    contact = Contact()
    s, t = closest_on_edges(p0, p1, q0, q1)
    u = p1 - p0
    v = q1 - q0
    rest_u = rest_p1 - rest_p0
    rest_v = rest_q1 - rest_q0
    r = (p0 + s * u) - (q0 + t * v)
    along_u = s > zero and s < one
    along_v = t > zero and t < one
    if along_u:
        contact.free = 1
        contact.e1 = u
        contact.h1 = vec8d(zero, rest_u[0], rest_u[1], rest_u[2], zero, zero, zero, zero)
        if along_v:
            contact.free = 2
            contact.e2 = -v
            contact.h2 = _second_half(rest_v)
    elif along_v:
        contact.free = 1
        contact.e1 = -v
        contact.h1 = _second_half(rest_v)
    cross = wp.cross(u, v)
    contact.u = u
    contact.v = v
    contact.rest_u = rest_u
    contact.rest_v = rest_v
    contact.cross = wp.dot(cross, cross)
    contact.threshold = PARALLEL * wp.dot(rest_u, rest_u) * wp.dot(rest_v, rest_v)
    contact.mollifier = mollify(contact.cross, contact.threshold)
    return _finish(contact, r, rest_p0 + s * rest_u, rest_q0 + t * rest_v)


@wp.func
def point_ground(p: wp.vec3d, rest_p: wp.vec3d) -> Contact:
    """Contact of a point of body a with the plane z = 0."""
    zero = wp.float64(0.0)
    one = wp.float64(1.0)
    contact = Contact()
    contact.coefficients = vec8d(one, rest_p[0], rest_p[1], rest_p[2], zero, zero, zero, zero)
    contact.normal = wp.vec3d(zero, zero, one)
    contact.distance = p[2]
    # The closest ground point follows freely in x and y, as on the face of a triangle.
    contact.free = 2
    contact.e1 = wp.vec3d(one, zero, zero)
    contact.e2 = wp.vec3d(zero, one, zero)
    contact.mollifier = one
    return contact


@wp.func
def _second_half(x: wp.vec3d) -> vec8d:
    zero = wp.float64(0.0)
    return vec8d(zero, zero, zero, zero, zero, -x[0], -x[1], -x[2])


@wp.func
def _finish(contact: Contact, r: wp.vec3d, on_a: wp.vec3d, on_b: wp.vec3d) -> Contact:
    one = wp.float64(1.0)
    contact.coefficients = vec8d(one, on_a[0], on_a[1], on_a[2], -one, -on_b[0], -on_b[1], -on_b[2])
    contact.distance = wp.length(r)
    contact.normal = r / wp.max(contact.distance, wp.float64(1.0e-300))
    return contact
