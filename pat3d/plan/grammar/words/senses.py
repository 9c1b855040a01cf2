"""What a word names that means another thing in other company, or what is packed in it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

PACKED = {
    "soup": "tomato soup", "sauce": "tomato sauce", "coffee": "coffee can", "tea": "tea box", "sugar": "sugar box",
    "water": "bottle", "wine": "wine bottle", "beer": "beer bottle", "soda": "soda can", "salt": "salt shaker",
    "jam": "jam jar", "shampoo": "shampoo", "trash": "trash can", "garbage": "trash can", "rubbish": "trash can",
    "tap": "faucet",
}  # fmt: skip
"""What "the soup" is, where it can be put somewhere."""
TWOFOLD = frozenset({"water", "trash", "garbage", "rubbish"})
"""Words that name, as often as what is made of them, another thing that no source has."""
SENSES: dict[str, tuple[tuple[str, str], ...]] = {
    "mouse": (
        ("mouse", "cheese cat trap animal plush toy rabbit bird"),
        ("computer mouse",
         "laptop keyboard monitor computer desk pad pc screen office printer webcam headset headphones "
         "workstation usb wireless speaker tablet"),
    ),
    "glasses": (
        ("glass", "wine water bottle pitcher plate juice milk beer jug drink tray cup bar kitchen dinner napkin bowl"),
        ("sunglasses",
         "desk book newspaper magazine reading nightstand case pair wallet hat beach phone key letter "
         "towel sunscreen"),
    ),
    "tube": (
        ("toothpaste", "towel toothbrush bathroom sink soap"),
        ("test tube", "rack beaker flask pipette lab laboratory petri microscope syringe"),
    ),
    "rack": (
        ("shelf", "book box storage tool"),
        ("test tube rack", "tube beaker flask pipette lab laboratory vial"),
        ("wine rack", "wine bottle"),
        ("dish rack", "plate cup kitchen bowl sink dish mug counter spoon fork"),
    ),
    "bar": (
        ("soap", "towel bathroom sink dish shampoo"),
        ("granola bar", "plate kitchen bowl apple banana drawer snack lunch"),
        ("counter", "bottle glass stool cocktail shaker wine beer whiskey drink pub"),
    ),
    "cushion": (
        ("floor cushion", "floor rug mat"),
        ("pillow", "sofa couch settee loveseat armchair chair bench bed pillow"),
    ),
    "board": (
        ("plank", "hammer nail saw wood block"),
        ("cutting board",
         "cheese kitchen counter knife bread vegetable tomato onion carrot jam croissant meat cleaver lime "
         "garlic"),
    ),
    "pot": (
        ("pot", "kitchen stove pan lid soup ladle burner"),
        ("flower pot", "plant flower soil garden trowel cactus seed watering"),
    ),
    "brush": (
        ("paintbrush", "paint jar can easel palette canvas"),
        ("hairbrush", "comb mirror hair dresser vanity"),
        ("toothbrush", "toothpaste sink"),
    ),
    "washer": (
        ("washing machine", "laundry detergent dryer clothes"),
        ("steel washer", "bolt nut screw nail wrench hardware"),
    ),
    "drumstick": (
        ("chicken leg", "plate dish sauce fries bone"),
        ("drum stick", "drum cymbal tambourine guitar music"),
    ),
    "chicken": (
        ("chicken", "plate dish pan tray"),
        ("hen", "cow pig sheep horse goat farm barn rooster tractor nest"),
    ),
    "nut": (
        ("nut", "bolt screw wrench"),
        ("walnut", "bowl walnut fruit cracker"),
    ),
}  # fmt: skip
"""What a word of several meanings names, and the company that tells it; the first where none does."""


def sense(said: str, company: Collection[str], senses: Sequence[tuple[str, str]]) -> str:
    """Which of `senses` of the word `said` its company tells of; the first where none does."""
    scored = [(len(set(company) & set(about.split())), -rank, noun) for rank, (noun, about) in enumerate(senses)]
    return max(scored)[2] if scored else said
