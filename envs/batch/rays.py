"""What one pixel of one world shows: the ray tracer of `pat3d.envs.rendering.raytrace` as Warp kernels."""
# Variables of a kernel that change have to be made with their type.
# ruff: noqa: UP018, RUF046
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false, reportReturnType=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAttributeAccessIssue=false
# pyright: reportAssignmentType=false

import warp as wp

from pat3d.envs.rendering.raytrace import BEHIND, LAYERS, LIFTED, TILE
from pat3d.envs.surroundings.lights import FADES, FLOOR

ACROSS, DOWN = 8, 4
"""Pixels of the tile that the threads of one warp draw, whose rays so meet the same bodies."""

NEAR, FAR = wp.constant(FADES[0]), wp.constant(FADES[1])
SIDE = wp.constant(TILE)
ABOVE = wp.constant(LIFTED)
BEYOND = wp.constant(float(BEHIND))
MOST = wp.constant(LAYERS)
LIGHT_TILE, DARK_TILE = wp.constant(wp.vec3(*FLOOR[0])), wp.constant(wp.vec3(*FLOOR[1]))


@wp.struct
class Drawn:
    """What there is to see: bodies and planes of every kind of world, faces of all bodies one after the other."""

    body: wp.array2d[int]
    """MuJoCo's number, -1 beyond the last, shape (kinds, bodies)."""
    mesh: wp.array2d[wp.uint64]
    centre: wp.array2d[wp.vec3]
    radius: wp.array2d[float]
    first: wp.array2d[int]
    """Its first face."""
    geom: wp.array2d[int]
    """Its first geom in `label`."""
    label: wp.array2d[int]
    """What segmentation calls every geom, shape (kinds, geoms)."""
    normals: wp.array[wp.vec3]
    """Of the three corners of every face."""
    uv: wp.array[wp.vec2]
    colour: wp.array[wp.vec3]
    texture: wp.array[int]
    part: wp.array[int]
    """Geom of every face, counted from its body's first."""
    texels: wp.array[wp.vec3]
    image: wp.array[wp.vec3i]
    """First texel, height and width of every texture."""
    planes: wp.array2d[wp.mat33]
    """Axes of planes as columns, zero beyond the last, shape (kinds, planes)."""
    place: wp.array2d[wp.vec3]
    tint: wp.array2d[wp.vec3]
    casts: wp.array2d[int]
    """Whether a body throws shadows, shape (kinds, bodies)."""
    opacity: wp.array2d[float]
    """Of what is seen through, 1 for what is solid, shape (kinds, bodies)."""
    sky: wp.array2d[wp.vec3]
    """Colour of the sky, shape (kinds, 1)."""
    around: wp.array2d[int]
    """The texture of the six pictures around everything, -1 for a sky of one colour, shape (kinds, 1)."""
    harmonics: wp.array2d[wp.vec3]
    """Of the light from everywhere, see `Lights.harmonics`, shape (kinds, 9 or 0)."""
    ambient: wp.array2d[wp.vec3]
    lamp: wp.array2d[wp.vec3]
    towards: wp.array2d[wp.vec3]
    """Unit vectors to the lights that are far away, shape (kinds, lights)."""
    diffuse: wp.array2d[wp.vec3]
    """Zero beyond the last."""
    shading: wp.array2d[int]
    """Whether what a light does not reach lies in the shadow."""
    sun: wp.array2d[int]
    """The light that throws shadows, -1 for none or where shadows are not drawn, shape (kinds, 1)."""


@wp.kernel(enable_backward=False)
def bound(
    drawn: Drawn,
    position: wp.array2d[wp.vec3],
    rotation: wp.array2d[wp.mat33],
    spheres: wp.array2d[wp.vec4],
):
    """Where the sphere around each body is now: middle and square of the radius, which is -1 beyond the last."""
    world, slot = wp.tid()
    kind = world % drawn.body.shape[0]
    body = drawn.body[kind, slot]
    if body < 0:
        spheres[world, slot] = wp.vec4(0.0, 0.0, 0.0, -1.0)
        return
    middle = position[world, body] + rotation[world, body] * drawn.centre[kind, slot]
    reach = drawn.radius[kind, slot]
    spheres[world, slot] = wp.vec4(middle[0], middle[1], middle[2], reach * reach)


@wp.func
def brightness(drawn: Drawn, kind: int, normal: wp.vec3, facing: float, shaded: bool) -> wp.vec3:
    """See `Lights.on`."""
    found = drawn.ambient[kind, 0] + facing * drawn.lamp[kind, 0]
    if drawn.harmonics.shape[1] > 0:
        x, y, z = normal[0], normal[1], normal[2]
        h = drawn.harmonics[kind, 0] + y * drawn.harmonics[kind, 1] + z * drawn.harmonics[kind, 2]
        h += x * drawn.harmonics[kind, 3] + x * y * drawn.harmonics[kind, 4] + y * z * drawn.harmonics[kind, 5]
        h += (3.0 * z * z - 1.0) * drawn.harmonics[kind, 6] + x * z * drawn.harmonics[kind, 7]
        h += (x * x - y * y) * drawn.harmonics[kind, 8]
        found += wp.max(h, wp.vec3(0.0, 0.0, 0.0))
    for number in range(drawn.towards.shape[1]):
        if not (shaded and drawn.shading[kind, number] != 0):
            found += wp.max(wp.dot(normal, drawn.towards[kind, number]), 0.0) * drawn.diffuse[kind, number]
    return found


@wp.func
def behind(drawn: Drawn, kind: int, ray: wp.vec3) -> wp.vec3:
    """See `looked_up`: the colour of what is behind everything."""
    cube = drawn.around[kind, 0]
    if cube < 0:
        return drawn.sky[kind, 0]
    a = wp.vec3(wp.abs(ray[0]), wp.abs(ray[1]), wp.abs(ray[2]))
    # As argmax has it, the first of several that are the greatest.
    most = a[0]
    face = int(0)
    s = ray[1]
    t = -ray[2]
    if ray[0] <= 0.0:
        face = 1
        s = -ray[1]
    if a[1] > most:
        most = a[1]
        face = 5
        s = -ray[0]
        if ray[1] <= 0.0:
            face = 4
            s = ray[0]
    if a[2] > most:
        most = a[2]
        face = 2
        s = ray[0]
        t = -ray[1]
        if ray[2] <= 0.0:
            face = 3
            t = ray[1]
    about = drawn.image[cube]
    side = about[2]
    half = 0.5 * float(side)
    row = wp.clamp(int((t / most + 1.0) * half), 0, side - 1)
    column = wp.clamp(int((s / most + 1.0) * half), 0, side - 1)
    return drawn.texels[about[0] + (face * side + row) * side + column]


@wp.func
def hidden(
    drawn: Drawn,
    spheres: wp.array2d[wp.vec4],
    position: wp.array2d[wp.vec3],
    rotation: wp.array2d[wp.mat33],
    world: int,
    kind: int,
    point: wp.vec3,
    normal: wp.vec3,
) -> bool:
    """Whether something stands between a point and the light that throws shadows; see `RayTracer`."""
    number = drawn.sun[kind, 0]
    if number < 0:
        return False
    sun = drawn.towards[kind, number]
    if wp.dot(normal, sun) <= 0.0:
        return False
    start = point + ABOVE * normal
    for other in range(spheres.shape[1]):
        sphere = spheres[world, other]
        away = wp.vec3(sphere[0], sphere[1], sphere[2]) - start
        along = wp.max(wp.dot(away, sun), 0.0)
        if wp.dot(away, away) - along * along <= sphere[3] and drawn.casts[kind, other] != 0:
            body = drawn.body[kind, other]
            back = wp.transpose(rotation[world, body])
            if wp.mesh_query_ray_anyhit(
                drawn.mesh[kind, other], back * (start - position[world, body]), back * sun, 1.0e10
            ):
                return True
    return False


@wp.func
def texel(drawn: Drawn, texture: int, uv: wp.vec2) -> wp.vec3:
    """See `nearest_texels`."""
    about = drawn.image[texture]
    row = wp.clamp(int((uv[1] - wp.floor(uv[1])) * float(about[1])), 0, about[1] - 1)
    column = wp.clamp(int((uv[0] - wp.floor(uv[0])) * float(about[2])), 0, about[2] - 1)
    return drawn.texels[about[0] + row * about[2] + column]


@wp.func
def byte(value: float) -> wp.uint8:
    """A colour in [0, 1] as 8 bits."""
    return wp.uint8(int(wp.clamp(value * 255.0 + 0.5, 0.0, 255.0)))


@wp.kernel(enable_backward=False)
def draw(
    drawn: Drawn,
    spheres: wp.array2d[wp.vec4],
    position: wp.array2d[wp.vec3],
    rotation: wp.array2d[wp.mat33],
    eyes: wp.array2d[wp.vec3],
    views: wp.array2d[wp.mat33],
    camera: int,
    scale: wp.array[float],
    farthest: wp.array[float],
    image: wp.array4d[wp.uint8],
    depth: wp.array3d[float],
    labels: wp.array3d[wp.uint16],
):
    """Colour, depth and label of one pixel; depth and labels may have no worlds."""
    world, pixel = wp.tid()
    height, width = image.shape[1], image.shape[2]
    tiles = (width + ACROSS - 1) / ACROSS
    tile, inside = pixel / (ACROSS * DOWN), pixel % (ACROSS * DOWN)
    column = (tile % tiles) * ACROSS + inside % ACROSS
    row = (tile / tiles) * DOWN + inside / ACROSS
    if row >= height or column >= width:
        return
    kind = world % drawn.body.shape[0]
    eye = eyes[world, camera]
    view = views[world, camera]
    across = (float(column) + 0.5 - 0.5 * float(width)) * scale[kind]
    up = (0.5 * float(height) - float(row) - 0.5) * scale[kind]
    length = wp.sqrt(1.0 + across * across + up * up)
    ray = view * (wp.vec3(across, up, -1.0) / length)

    # What was passed lets so much of the light behind it through.
    through = float(1.0)
    total = wp.vec3(0.0, 0.0, 0.0)
    start = float(0.0)
    nearest = float(-1.0)
    label = int(0)
    layer = int(0)
    while layer <= MOST:
        reach = float(1.0e10)
        slot = int(-1)
        face = int(0)
        u = float(0.0)
        v = float(0.0)
        outward = wp.vec3(0.0, 0.0, 0.0)
        for number in range(spheres.shape[1]):
            sphere = spheres[world, number]
            away = wp.vec3(sphere[0], sphere[1], sphere[2]) - eye
            along = wp.max(wp.dot(away, ray), 0.0)
            # Shells of a room, which come last, are behind all that stands in it.
            behind_all = drawn.casts[kind, number] == 0 and slot >= 0
            if wp.dot(away, away) - along * along <= sphere[3] and not behind_all:
                body = drawn.body[kind, number]
                back = wp.transpose(rotation[world, body])
                origin = back * (eye + start * ray - position[world, body])
                hit = wp.mesh_query_ray(drawn.mesh[kind, number], origin, back * ray, reach - start)
                if hit.result:
                    reach = hit.t + start
                    slot = number
                    face = hit.face
                    u = hit.u
                    v = hit.v
                    outward = rotation[world, body] * hit.normal
        plane = int(-1)
        for number in range(drawn.planes.shape[1]):
            axes = drawn.planes[kind, number]
            axis = wp.vec3(axes[0, 2], axes[1, 2], axes[2, 2])
            slope = wp.dot(ray, axis)
            if slope < -1.0e-4:
                distance = wp.dot(drawn.place[kind, number] - eye, axis) / slope
                if distance > start and distance < reach:
                    reach = distance
                    plane = number

        colour = drawn.sky[kind, 0]
        opacity = float(1.0)
        named = int(0)
        if plane >= 0:
            axes = drawn.planes[kind, plane]
            point = wp.transpose(axes) * (eye + reach * ray - drawn.place[kind, plane])
            odd = (int(wp.floor(point[0] / SIDE)) + int(wp.floor(point[1] / SIDE))) & 1
            axis = wp.vec3(axes[0, 2], axes[1, 2], axes[2, 2])
            tiled = DARK_TILE
            if odd != 0:
                tiled = LIGHT_TILE
            shaded = hidden(drawn, spheres, position, rotation, world, kind, eye + reach * ray, axis)
            light = brightness(drawn, kind, axis, wp.abs(wp.dot(ray, axis)), shaded)
            fade = wp.clamp((reach - NEAR) / (FAR - NEAR), 0.0, 1.0)
            own = wp.cw_mul(wp.cw_mul(tiled, drawn.tint[kind, plane]), light)
            colour = own * (1.0 - fade) + drawn.sky[kind, 0] * fade
        elif slot >= 0:
            one = drawn.first[kind, slot] + face
            w = 1.0 - u - v
            body = drawn.body[kind, slot]
            mixed = u * drawn.normals[3 * one] + v * drawn.normals[3 * one + 1] + w * drawn.normals[3 * one + 2]
            normal = wp.normalize(rotation[world, body] * mixed)
            facing = -wp.dot(normal, ray)
            if facing < 0.0:
                normal = -normal
            own = drawn.colour[one]
            texture = drawn.texture[one]
            if texture >= 0:
                uv = u * drawn.uv[3 * one] + v * drawn.uv[3 * one + 1] + w * drawn.uv[3 * one + 2]
                own = wp.cw_mul(own, texel(drawn, texture, uv))
            shaded = hidden(drawn, spheres, position, rotation, world, kind, eye + reach * ray, normal)
            colour = wp.cw_mul(own, brightness(drawn, kind, normal, wp.abs(facing), shaded))
            named = drawn.label[kind, drawn.geom[kind, slot] + drawn.part[one]]
            opacity = drawn.opacity[kind, slot]
        else:
            colour = behind(drawn, kind, ray)
        if layer == 0:
            nearest = reach
            label = named
        pane = opacity < 1.0 and layer < MOST
        share = float(1.0)
        if pane:
            share = opacity
            if wp.dot(outward, ray) >= 0.0:
                share = 0.0
        clipped = wp.vec3(wp.clamp(colour[0], 0.0, 1.0), wp.clamp(colour[1], 0.0, 1.0), wp.clamp(colour[2], 0.0, 1.0))
        total += through * share * clipped
        through = through * (1.0 - share)
        start = reach + BEYOND
        layer += 1
        if not pane:
            break
    for channel in range(3):
        image[world, row, column, channel] = byte(total[channel])
    if depth.shape[0] > 0:
        depth[world, row, column] = wp.min(nearest / length, farthest[kind])
    if labels.shape[0] > 0:
        labels[world, row, column] = wp.uint16(label)
