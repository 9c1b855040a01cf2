"""Vessels and what else has an inside: which they are, what goes into them, and what they become opened."""

from __future__ import annotations

HOLLOW = ("egg cup", "wok", "bar caddy", "dustpan", "open toolbox", "open treasure chest", "open cookie jar",
    "colander", "drawer", "open drawer", "drawer organizer", "paper tray", "toy truck", "basket", "bowl", "cup", "mug",
    "vase", "box",
    "pen holder", "bucket", "jar", "pool", "inflatable pool", "pot", "crate", "bin", "glass", "soap dish", "pan",
    "saucepan", "wine glass", "teacup", "planter", "flowerpot", "trash can", "wastebasket", "storage box",
    "pencil case", "pencil cup", "tumbler", "storage bin", "laundry basket", "goblet", "pitcher", "jug", "fish bowl",
    "shopping basket", "toothbrush holder", "utensil holder", "fruit bowl", "mixing bowl", "hamper", "picnic basket",
    "pail", "casserole", "frying pan", "cooking pot", "flower pot", "sink", "dish rack", "measuring cup",
    "measuring spoon", "beaker", "flask", "graduated cylinder", "petri dish", "lunch box", "ice cube tray", "ramekin",
    "mortar", "baking dish", "coffee pot", "creamer", "paper bag", "cube tray", "bathtub", "washtub", "aquarium",
    "tureen", "umbrella stand", "cup holder", "toy wagon")  # fmt: skip
BOWLS = ("bowl", "fruit bowl", "mixing bowl", "fish bowl", "pan", "frying pan", "saucepan", "pot", "cooking pot",
         "soap dish", "casserole")  # fmt: skip
"""Vessels no wider than most other vessels: a list after one never puts a vessel into it."""
LARGE_VESSELS = ("basket", "crate", "box", "bin", "bucket", "pool", "inflatable pool", "laundry basket", "hamper",
    "storage box", "storage bin", "trash can", "wastebasket", "picnic basket", "shopping basket", "planter", "sink",
    "dish rack", "paper bag", "cube tray", "bathtub", "washtub", "aquarium", "toy wagon")  # fmt: skip
NOT_IN_VESSEL = ("lamp", "table lamp", "desk lamp", "floor lamp", "lantern", "fire extinguisher", "monitor",
    "television", "computer", "laptop", "printer", "microwave", "guitar", "globe", "aquarium", "radio", "vase",
    "potted plant", "bag", "handbag", "backpack", "suitcase", "briefcase", "toaster", "blender", "keyboard",
    "coffee machine", "stand mixer", "air fryer", "rice cooker", "toaster oven", "microscope", "game console",
    "telephone", "record player", "dollhouse", "birdcage", "bicycle", "shredder", "soundbar", "open microwave",
    "open toaster oven")  # fmt: skip
"""What a list after a vessel never puts into it: too large, or made to stand by itself."""
WIDER = {"bowl": "fruit bowl"}
"""What a vessel becomes when it holds fruit or more than two things."""
OPENED = {"box": "storage box", "toolbox": "open toolbox", "treasure chest": "open treasure chest",
          "cookie jar": "open cookie jar"}  # fmt: skip
"""What a closed thing becomes when the prompt puts something in it."""
NARROW = ("vase", "cup", "mug", "pen holder", "glass", "jar", "bottle", "toothbrush holder", "utensil holder",
          "beaker", "flask", "graduated cylinder", "umbrella stand")  # fmt: skip
SLENDER = ("pen", "pencil", "ruler", "scissors", "toothbrush", "toothpaste", "razor", "spoon", "fork", "knife",
    "flower", "bouquet", "brush", "straw", "chopstick", "chopsticks", "candle", "wand", "spatula", "whisk", "plant",
    "marker", "comb", "rose", "tulip", "crayon", "paintbrush", "ladle", "screwdriver", "wrench", "sunflower", "daisy",
    "eraser", "hairbrush", "candy cane", "lollipop", "twig", "branch", "stylus", "highlighter", "tongs", "feather",
    "umbrella", "peeler", "pipette", "test tube", "syringe", "chisel", "pizza cutter", "rod", "swab", "drill bit",
    "pestle", "feather duster")  # fmt: skip
"""What a narrow vessel holds; anything else in a list after it stands outside."""
COVERS = ("bowl", "fruit bowl", "mixing bowl", "cup", "mug", "glass", "tumbler", "teacup", "basket", "bucket", "pot",
    "saucepan", "cooking pot", "bin", "colander", "storage box", "crate", "planter", "flowerpot", "flower pot",
    "laundry basket", "pail", "jar", "beaker", "ramekin", "pen holder", "wastebasket", "trash can",
    "cloche")  # fmt: skip
"""Vessels that, upside down, stand around what they cover."""
OPEN_BELOW = ("cloche",)
"""Those of them that are made with their mouth down."""
CLOSED = ("microwave", "fridge", "stove", "toaster oven", "washing machine", "dishwasher", "dryer", "filing cabinet",
          "suitcase", "backpack", "handbag", "briefcase", "drawer organizer",
          "cookie jar", "jam jar", "toaster", "rice cooker", "air fryer")  # fmt: skip
"""What things go into through a door, a drawer or a lid."""
RACKED = ("plate", "saucer")
"""What stands on its edge in a dish rack."""
RACKS = ("wine rack", "test tube rack", "egg carton")
HOLDERS = (*RACKS, "wallet", "bag", "tote bag", "paper tray", "glove", "sock")
"""What has an inside and is no vessel."""
SHUT = ("cabinet", "dresser", "wardrobe")
"""What things are in behind a door or in a drawer, and can stand on too."""
ON_RIMS = ("lid", "pot lid", "cork", "bottle cap")
"""What closes a vessel: on it, never in it."""
