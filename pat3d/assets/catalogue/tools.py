"""Hand tools and cans; long ones lie along x on flats, so that nothing rolls."""

from pat3d.assets.catalogue.joinery import (
    STEEL,
    WHITE,
    cut,
    dial,
    disc_top,
    lying,
    padded,
    shelf_top,
    span,
    together,
)
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.colours import COLOURS
from pat3d.assets.shapes import Shape, box, convex, cylinder, join, prism, turned_solid

DARK_STEEL = (112, 116, 124)


@entry("hammer", family="tools", material="steel", colours=("wood", "red", "blue"), synonyms=("claw hammer",))
def hammer(style: Style) -> Build:
    """A claw hammer lying on its side, its handle in the main colour."""
    n, half = style.vary(0.3), 0.0125
    head_x = n / 2 - 0.02
    grip = [(-n / 2, 0.016), (-0.2 * n, 0.014), (0.1 * n, 0.011), (n / 2 - 0.006, 0.011)]
    handle = join(
        *(
            convex(
                [(x, s * w, half + h * half) for x, w in pair for s in (-1, 1) for h in (-1, 1)]
                + [(x, s * 0.5 * w, half + h * half) for x, w in pair for s in (-1, 1) for h in (-1, 1)]
            )
            for pair in zip(grip, grip[1:], strict=False)
        )
    )
    block = box(0.028, 0.05, 2 * half + 0.003).moved(head_x, 0.0)
    face = cylinder(half + 0.0015, 0.035, 12).turned("z", 15).turned("x", 90).moved(head_x, -0.02, half + 0.0015)
    claws = [convex([(head_x + x, y, z) for x, y, z0, z1 in
                     ((-0.013, 0.02, a, b), (0.013, 0.02, a, b), (-0.022, 0.075, c, d), (-0.016, 0.078, c, d))
                     for z in (z0, z1)]) for a, b, c, d in
             ((0.0, half, 0.0, 0.007), (half, 2 * half + 0.003, 2 * half - 0.004, 2 * half + 0.003))]  # fmt: skip
    return Build(parts=((handle, style.colour()), (join(block, face, *claws), DARK_STEEL)), mass=style.vary(0.55))


@entry("screwdriver", family="tools", material="steel", colours=("red", "yellow", "blue", "orange"), accents=("black",),
       synonyms=("screw driver", "phillips screwdriver", "flat screwdriver", "flathead screwdriver"))  # fmt: skip
def screwdriver(style: Style) -> Build:
    """A screwdriver lying on a flat of its fluted handle."""
    r, n = style.vary(0.0145), style.vary(0.2)
    handle = lying(r, 0.46 * n, sides=8).moved(-0.27 * n)
    neck = lying(0.7 * r, 0.06 * n, sides=8).moved(-0.02 * n, 0.0, 0.3 * r)
    shaft = lying(0.003, 0.48 * n, sides=6).moved(0.24 * n, 0.0, r - 0.003)
    tip = convex(
        [(0.47 * n, s * 0.0028, r + h * 0.0028) for s in (-1, 1) for h in (-1, 1)]
        + [(n / 2, s * 0.0035, r + h * 0.0006) for s in (-1, 1) for h in (-1, 1)]
    )
    flutes = [
        box(0.3 * n, 0.003, 0.05).moved(0.0, 0.0, 0.0).turned("x", 60 * k).moved(-0.28 * n, 0.0, r) for k in range(6)
    ]
    return Build(
        parts=((handle, style.colour()), (neck, style.colour(1)), (join(shaft, tip), STEEL)),
        paint=((together(flutes), style.colour(1)),),
        mass=style.vary(0.12),
    )


@entry(
    "wrench",
    family="tools",
    material="steel",
    colours=("steel", "gray"),
    plurals=("wrenches",),
    synonyms=("spanner", "open-end wrench", "combination wrench", "adjustable wrench", "socket wrench", "ratchet"),
)
def wrench(style: Style) -> Build:
    """A combination wrench lying flat: an open jaw, a bar, a ring."""
    n, thick, colour = style.vary(0.2), 0.007, style.colour()
    jaw = [(-0.026, -0.02), (-0.006, -0.025), (0.016, -0.012), (0.02, 0.0), (0.016, 0.012), (-0.006, 0.025),
           (-0.026, 0.02), (-0.026, 0.009), (-0.006, 0.009), (-0.006, -0.009), (-0.026, -0.009)]  # fmt: skip
    head = prism(jaw, thick).turned("z", 15).moved(-n / 2 + 0.026)
    bar = box(n - 0.06, 0.014, thick).moved(0.0)
    ring = cut(cylinder(0.017, thick, 12), cylinder(0.0095, 3 * thick, 6).moved(z=-thick)).moved(n / 2 - 0.017)
    groove = box(n - 0.09, 0.006, 0.02).moved(z=thick - 0.001)
    return Build(
        parts=((join(head, bar, ring), colour),), paint=((groove, style.shade(colour, 0.75)),), mass=style.vary(0.16)
    )


@entry(
    "pliers",
    family="tools",
    material="steel",
    colours=("red", "blue", "yellow"),
    synonyms=("pair of pliers", "tongs pliers", "wire cutter", "wire stripper", "wire cutters"),
)
def pliers(style: Style) -> Build:
    """Pliers lying a little open, grips in the main colour."""
    n, thick = style.vary(0.18), 0.012
    jaws, grips = [], []
    beak = ((0.12, -0.004), (0.12, 0.013), (0.3, 0.012), (0.5, 0.004), (0.5, 0.0008))
    for s in (-1, 1):
        jaws.append(convex([(x * n, s * y, z) for x, y in beak for z in (0.0, thick)]))
        line = [(0.1, 0.004), (-0.12, 0.023), (-0.5, 0.026)]
        for (x0, y0), (x1, y1) in zip(line, line[1:], strict=False):
            grips.append(convex([(x * n, s * y + w, z) for x, y in ((x0, y0), (x1, y1)) for w in (-0.0065, 0.0065)
                                 for z in (0.0, thick)]))  # fmt: skip
    pivot = cylinder(0.016, thick, 12).moved(0.13 * n)
    rivet = cylinder(0.006, 0.02).moved(0.13 * n, 0.0, thick - 0.001)
    return Build(
        parts=((join(*jaws, pivot), DARK_STEEL), (join(*grips), style.colour())),
        paint=((rivet, STEEL),),
        mass=style.vary(0.25),
    )


@entry("saw", family="tools", material="steel", colours=("wood", "red", "orange"), synonyms=("handsaw", "hand saw"))
def saw(style: Style) -> Build:
    """A handsaw lying flat, its handle in the main colour."""
    n = style.vary(0.42)
    thick = 0.022
    blade = convex(
        [
            (x, y, z)
            for x, y in ((-0.2 * n, -0.055), (-0.2 * n, 0.05), (0.72 * n, 0.05), (0.72 * n, 0.015))
            for z in (0.0, 0.002)
        ]
    )
    rise = 0.07 / (0.92 * n)
    notch = box(0.005, 0.005, 0.05).turned("z", 45).moved(-0.2 * n, -0.056, -0.01)
    teeth = [notch.moved(0.009 * k, rise * 0.009 * k) for k in range(1, int(0.9 * n / 0.009))]
    edge = ((-0.28, -0.062), (-0.12, -0.05), (-0.12, 0.045), (-0.2, 0.062), (-0.3, 0.055), (-0.33, -0.03))
    handle = convex([(x * n, y, z) for x, y in edge for z in (0.0, thick)])
    hole = cylinder(0.5, 1.0).scaled(0.05, 0.066, 1.0).turned("z", 12).moved(-0.235 * n, 0.0, -0.5)
    inner = Shape(blade.solid - together(teeth).solid, blade.hulls)
    return Build(parts=((inner, STEEL), (cut(handle, hole), style.colour())), mass=style.vary(0.5))


@entry("drill", family="tools", material="plastic", colours=("yellow", "teal", "red", "blue"), accents=("black",),
       synonyms=("power drill", "cordless drill", "electric drill"))  # fmt: skip
def drill(style: Style) -> Build:
    """A cordless drill standing on its battery, pointing left."""
    k, colour, dark = style.vary(1.0), style.colour(), style.colour(1)
    battery = box(0.13 * k, 0.07 * k, 0.045 * k)
    grip = convex(
        [
            (x * k, s * y * k, z * k)
            for s in (-1, 1)
            for x, y, z in ((-0.02, 0.017, 0.04), (0.03, 0.017, 0.04), (-0.025, 0.017, 0.15), (0.02, 0.017, 0.15))
        ]
    )
    body = lying(0.032 * k, 0.13 * k).moved(0.005 * k, 0.0, 0.14 * k)
    chuck = lying(0.024 * k, 0.05 * k, 0.016 * k).turned("z", 180).moved(-0.082 * k, 0.0, 0.148 * k)
    bit = lying(0.003, 0.06 * k, sides=6).moved(-0.13 * k, 0.0, 0.172 * k - 0.003)
    trigger = box(0.014 * k, 0.018 * k, 0.03 * k).moved(-0.027 * k, 0.0, 0.105 * k)
    band = span((0.045 * k, 0.052 * k), (-1.0, 1.0), (0.13 * k, 1.0))
    return Build(
        parts=((join(body, grip), colour), (join(battery, chuck, trigger), dark), (bit, STEEL)),
        paint=((band, dark),),
        mass=style.vary(1.6),
    )


@entry("tape measure", family="tools", material="plastic", colours=("yellow", "red", "blue"), accents=("black",),
       synonyms=("measuring tape", "tape rule"))  # fmt: skip
def tape_measure(style: Style) -> Build:
    """A tape measure standing on its base, a little of its tape out."""
    k, colour = style.vary(1.0), style.colour()
    side = [(-0.035, 0.0), (0.035, 0.0), (0.036, 0.035), (0.028, 0.058), (0.01, 0.07), (-0.016, 0.068), (-0.034, 0.046)]
    body = convex([(x * k, y, z * k) for x, z in side for y in (-0.018 * k, 0.018 * k)])
    tongue = box(0.03, 0.02 * k, 0.0012).moved(0.045 * k, 0.0, 0.003)
    hook = box(0.0015, 0.02 * k, 0.0045).moved(0.045 * k + 0.0155)
    label = dial(0.022 * k, 0.1).moved(0.0, -0.017 * k, 0.036 * k)
    inner = dial(0.016 * k, 0.1).moved(0.0, -0.017 * k, 0.036 * k)
    return Build(
        parts=((body, colour), (tongue, COLOURS["yellow"]), (hook, STEEL)),
        paint=((label, style.colour(1)), (inner, WHITE)),
        mass=style.vary(0.25),
    )


@entry("toolbox", family="tools", material="metal", colours=("red", "blue", "gray"), accents=("black",),
       plurals=("toolboxes", "tool boxes", "tool chests"), synonyms=("tool box", "tool chest"))  # fmt: skip
def toolbox(style: Style) -> Build:
    """A closed toolbox with a sloping lid, two latches and a handle."""
    x, y, z = style.vary(0.42), style.vary(0.2), style.vary(0.13)
    colour = style.colour()
    slope = ((0.5, 0.5, z), (0.46, 0.25, z + 0.06))
    lid = convex([(s * a * x, t * b * y, h) for s in (-1, 1) for t in (-1, 1) for a, b, h in slope])
    top = z + 0.06
    posts = [box(0.014, 0.018, 0.035).moved(s * 0.17 * x, 0.0, top - 0.002) for s in (-1, 1)]
    bar = padded(0.34 * x + 0.02, 0.024, 0.02, 0.008).moved(z=top + 0.025)
    latches = [box(0.035, 0.014, 0.045).moved(s * 0.28 * x, -y / 2, z - 0.03) for s in (-1, 1)]
    seam = box(2.0, 2.0, 0.004).moved(z=z - 0.002)
    return Build(
        parts=((join(box(x, y, z), lid), colour), (join(*posts, bar), style.colour(1)), (join(*latches), STEEL)),
        paint=((Shape(seam.solid - join(*latches).solid, ()), style.shade(colour, 0.5)),),
        mass=style.vary(4.0),
    )


@entry("flashlight", family="tools", material="metal", colours=("black", "red", "yellow"), accents=("silver",),
       synonyms=("torch", "flash light"))  # fmt: skip
def flashlight(style: Style) -> Build:
    """A flashlight lying on the flats of its head and tail."""
    r, n, colour = style.vary(0.021), style.vary(0.18), style.colour()
    head = lying(r, 0.2 * n, sides=8).moved(0.4 * n)
    cone = lying(r, 0.1 * n, 0.7 * r, sides=8).turned("z", 180).moved(0.255 * n)
    body = lying(0.7 * r, 0.62 * n, sides=8).moved(-0.09 * n, 0.0, 0.3 * r)
    tail = lying(r, 0.12 * n, sides=8).moved(-0.44 * n)
    lens = span((n / 2 - 0.001, n), (-1.0, 1.0), (-1.0, 1.0))
    rings = [span((t * n, (t + 0.02) * n), (-1.0, 1.0), (-1.0, 1.0)) for t in (0.31, -0.385)]
    switch = box(0.02, 0.01, 0.02).moved(0.1 * n, 0.0, 1.6 * r)
    return Build(
        parts=((join(head, cone, body, tail), colour),),
        paint=((lens, (250, 240, 190)), (join(*rings), style.colour(1)), (switch, COLOURS["red"])),
        mass=style.vary(0.25),
    )


@entry("paint can", family="tools", material="metal", colours=("blue", "red", "yellow", "green"), accents=("steel",),
       synonyms=("can of paint", "paint bucket", "paint tin", "tin of paint"), plurals=("cans of paint",))  # fmt: skip
def paint_can(style: Style) -> Build:
    """A closed can of paint, its label in the main colour with a drip over the rim."""
    r, z = style.vary(0.085), style.vary(0.19)
    metal, colour = style.colour(1), style.colour()
    can = cylinder(r, z)
    rims = join(cylinder(r + 0.003, 0.008), cylinder(r + 0.003, 0.008).moved(z=z - 0.002))
    label = box(2.0, 2.0, z - 0.05).moved(z=0.02)
    patch = Shape(dial(0.5 * r, 1.0).moved(0.0, -0.6 * r, 0.48 * z).solid, ())
    drips = [
        span((a * r, b * r), (-1.0, 0.0), (h * z, z + 0.1))
        for a, b, h in ((-0.75, -0.5, 0.72), (-0.5, -0.2, 0.86), (-0.2, 0.02, 0.64), (0.02, 0.35, 0.88))
    ]
    lid = cylinder(0.85 * r, 0.1).moved(z=z + 0.005)
    return Build(
        parts=((can, metal), (rims, metal)),
        paint=((label, WHITE), (patch, colour), (together(drips), colour), (lid, colour)),
        regions=(disc_top(r, z + 0.006),),
        mass=style.vary(4.5),
    )


@entry("spray can", family="tools", material="aluminium", colours=("red", "blue", "green", "orange"),
       accents=("white",), synonyms=("spray paint", "aerosol can", "spray paint can", "aerosol"))  # fmt: skip
def spray_can(style: Style) -> Build:
    """A spray can with a domed shoulder and a cap in the main colour."""
    r, z, colour = style.vary(0.033), style.vary(0.14), style.colour()
    can = turned_solid([(0.94 * r, 0.0), (r, 0.004), (r, z), (0.85 * r, z + 0.012), (0.72 * r, z + 0.018)], 12)
    cap = turned_solid([(0.74 * r, z + 0.016), (0.74 * r, z + 0.045), (0.66 * r, z + 0.05)], 12)
    label = box(2.0, 2.0, 0.62 * z).moved(z=0.16 * z)
    band = box(2.0, 2.0, 0.1 * z).moved(z=0.5 * z)
    metal = box(2.0, 2.0, 0.02).moved(z=z)
    return Build(
        parts=((can, colour), (cap, colour)),
        paint=((label, style.shade(colour, 0.85)), (band, style.colour(1)), (metal, STEEL)),
        mass=style.vary(0.35),
    )


@entry(
    "brick",
    family="tools",
    material="ceramic",
    colours=("terracotta", "red", "brown"),
    synonyms=("clay brick", "red brick", "house brick"),
)
def brick(style: Style) -> Build:
    """A brick with three round holes to the eye; contact sees one box."""
    x, y, z = style.vary(0.215, 0.02), style.vary(0.1025, 0.02), style.vary(0.065, 0.02)
    holes = [cylinder(0.018, 0.2).moved(s * 0.28 * x, 0.0, -0.05) for s in (-1, 0, 1)]
    return Build(
        parts=((cut(box(x, y, z), *holes), style.colour()),),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=style.vary(2.3),
    )


@entry("ladder", family="tools", material="aluminium", colours=("silver", "yellow"), accents=("gray",),
       synonyms=("step ladder", "stepladder", "steps"))  # fmt: skip
def ladder(style: Style) -> Build:
    """A folding step ladder of four treads."""
    x, z, colour = style.vary(0.44), style.vary(1.1), style.colour()
    lean = 0.42
    levels = (0.0, 1.0)
    rails = [convex([(s * x / 2 + a, -lean + t * (lean - 0.06) + b, t * z) for a in (-0.012, 0.012) for t in levels
                     for b in (-0.03, 0.03)]) for s in (-1, 1)]  # fmt: skip
    rear = [convex([(s * (x / 2 - 0.03) + a, 0.3 - t * 0.28 + b, t * 0.96 * z) for a in (-0.01, 0.01) for t in levels
                    for b in (-0.015, 0.015)]) for s in (-1, 1)]  # fmt: skip
    treads = [box(x, 0.09, 0.02).moved(0.0, -lean + t * (lean - 0.06), t * z) for t in (0.2, 0.44, 0.68)]
    top = box(x + 0.04, 0.2, 0.03).moved(0.0, -0.02, z - 0.01)
    brace = box(x - 0.05, 0.012, 0.03).moved(0.0, 0.3 - 0.28 * 0.35, 0.35 * 0.96 * z)
    return Build(
        parts=((join(*rails, *treads), colour), (join(top, *rear, brace), style.colour(1))),
        regions=(shelf_top(x / 2 + 0.02, 0.1, z + 0.02, at=(0.0, -0.02)),),
        mass=style.vary(6.5),
    )
