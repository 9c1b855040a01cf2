"""Contacts of boxes that cannot be: what MuJoCo Warp's routine makes of faces that lie flat on one another."""
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false, reportReturnType=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAttributeAccessIssue=false
# pyright: reportAssignmentType=false

import warp as wp

BOX = wp.constant(6)
"""MuJoCo's number of the shape."""

PHANTOM = wp.constant(1.0e-4)
"""By which rounding may make a contact deeper than the boxes overlap [m]; ten times what they do at rest."""

NOWHERE = wp.constant(1.0e3)
"""Distance of what is no contact [m]."""


@wp.func
def half_along(size: wp.vec3, rotation: wp.mat33, axis: wp.vec3):
    """How far a box reaches along a unit vector from its middle [m]."""
    own = wp.transpose(rotation) * axis
    return wp.dot(size, wp.vec3(wp.abs(own[0]), wp.abs(own[1]), wp.abs(own[2])))


@wp.kernel
def mend_phantoms(
    count: wp.array[int],
    geoms: wp.array[wp.vec2i],
    frame: wp.array[wp.mat33],
    of_world: wp.array[int],
    shape: wp.array[int],
    size: wp.array2d[wp.vec3],
    position: wp.array2d[wp.vec3],
    rotation: wp.array2d[wp.mat33],
    place: wp.array[wp.vec3],
    distance: wp.array[wp.float32],
):
    """Mend contacts of boxes that are deeper than the boxes overlap along the normal at all.

    Where faces lie flat on one another, rounding to single precision makes MuJoCo Warp's routine take two parallel
    edges for the pair that touches; where those meet is anywhere, up to metres deep, and the far side is without a
    contact. What is mended is a contact under the middle of the smaller box, where there is something below it.
    """
    contact = wp.tid()
    if contact >= count[0]:
        return
    first, second = geoms[contact][0], geoms[contact][1]
    if first < 0 or second < 0 or shape[first] != BOX or shape[second] != BOX:
        return
    world = of_world[contact]
    sizes = world % size.shape[0]
    normal = wp.vec3(frame[contact][0, 0], frame[contact][0, 1], frame[contact][0, 2])
    one = half_along(size[sizes, first], rotation[world, first], normal)
    other = half_along(size[sizes, second], rotation[world, second], normal)
    overlap = one + other - wp.abs(wp.dot(normal, position[world, second] - position[world, first]))
    if -distance[contact] <= overlap + PHANTOM:
        return
    small, large = first, second
    towards = one - 0.5 * overlap
    if one > other:
        small, large = second, first
        towards = 0.5 * overlap - other
    middle = position[world, small] + towards * normal
    inside = wp.transpose(rotation[world, large]) * (middle - position[world, large])
    beyond = wp.max(
        wp.max(wp.abs(inside[0]) - size[sizes, large][0], wp.abs(inside[1]) - size[sizes, large][1]),
        wp.abs(inside[2]) - size[sizes, large][2],
    )
    if beyond > PHANTOM:
        distance[contact] = NOWHERE
    else:
        distance[contact] = -overlap
        place[contact] = middle
