"""Parts of objects: they place nothing, but may carry a colour or name where something sits."""

_NAMES = """
    head top back edge side middle center centre seat lap rim bottom inside handle cover page stripe leg spout dot
    pattern label petal leaf wheel button texture finish design base eye ear tail nose spine trim accent print foot
    paw hand arm armrest shelf drawer mattress corner surface fur body beak front lid frame bristle marking spot
    icing frosting shade tabletop desktop layer end half tip blade knob opening shell stem door compartment switch
    shoulder wing interior sleeve scarf bow ribbon face smile handlebar pocket nozzle skin flesh flap pedal brim
    prong seam strap zipper hinge crust rind stalk fin mane horn whisker crease wick lens dial keyhole slot
    stitching engraving bite residue component earpiece text lettering lace sole logo sticker crack scratch stain
    decal emblem inscription gripper effector yolk condensation droplet underside outline hue highlight reflection
    manipulator hardware tine exterior peel level tier headboard footboard neck jaw
"""
PARTS = frozenset(_NAMES.split())
"""Their names, wherever they stand."""
ENDS = frozenset({"edge", "corner", "end", "tip", "half", "side", "rim"})
"""Parts to which nothing is related: the whole is taken."""
_HAD = """
    antenna antennae antler badge backrest band bezel binding border buckle bumper chimney clasp claw collar crest cuff
    drawstring eyelet fang feather filament flame fretboard fringe gemstone grip hair headlight headrest heel
    hem hilt hood hoof hooves hull jewel keypad lapel latch lever lining mast monogram motif muzzle neck numeral
    peak pendant pistil plume pommel propeller rivet roof rotor ruffle rung saddle shaft shoelace snout spike spoke
    stopper stud tassel thorn tongue tread trigger tusk visor waistband wax windscreen windshield hole topping
    linen sheet linens bedding panel panelling paneling pump upholstery
"""
HAD = frozenset(_HAD.split())
"""Names of parts of what is said to have them: "a belt with a buckle"; by itself each is a thing that no source has."""
_STORED = ("desk", "dresser", "cabinet", "table", "nightstand")
FIXED: dict[str, tuple[str, ...]] = {
    "wheels": ("cart", "chair", "suitcase", "bicycle", "skateboard", "toy car", "toy truck", "toy wagon", "bin", "bed"),
    "keys": ("keyboard", "piano", "calculator", "typewriter"), "strings": ("guitar",), "cap": ("pen", "marker"),
    "screen": ("phone", "tablet", "laptop", "tv"), "eraser": ("pencil",), "drawer": _STORED, "drawers": _STORED,
}  # fmt: skip
"""Things by themselves that are parts of those that are said to have them: "a chair with wheels on it"."""
