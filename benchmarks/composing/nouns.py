"""What the sentences are about: catalogue nouns, what is said of such things, and what fits in and on them."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class Noun:
    """A noun of the catalogue and what a person says of such a thing."""

    word: str
    plural: str
    catalogue: frozenset[str]
    """The nouns of the catalogue that a plan may have for it."""
    verb: str
    """How it is where it is: stand or lie."""
    colours: tuple[str, ...]
    materials: tuple[str, ...] = ()
    kinds: frozenset[str] = field(default_factory=frozenset)


COLOURS = ("red", "blue", "green", "yellow", "white", "black", "pink", "purple", "brown", "grey")
MATERIALS = {
    "wooden": "wood", "metal": "metal", "plastic": "plastic", "ceramic": "ceramic", "glass": "glass",
}  # fmt: skip
"""Words for materials, with what the catalogue calls them."""
SIZES = {"small": -1, "tiny": -1, "little": -1, "large": 1, "big": 1, "huge": 1}
_IRREGULAR = {"knife": "knives", "shelf": "shelves", "mouse": "mice", "loaf of bread": "loaves of bread"}
_SAME = {
    "bowl": ("fruit bowl",), "box": ("storage box",), "nightstand": ("bedside table",), "sideboard": ("cabinet",),
    "cabinet": ("open cabinet",), "wardrobe": ("open wardrobe",),
    "trash can": ("bin",), "loaf of bread": ("bread",), "frying pan": ("pan",), "saucepan": ("pot",),
    "alarm clock": ("clock",), "toolbox": ("open toolbox",), "toy robot": ("robot",), "shoe box": ("storage box",),
    "jug": ("pitcher",), "flowerpot": ("flower pot",), "candy bar": ("chocolate bar",),
}  # fmt: skip
"""Other names that the catalogue has for the same thing, open or in its larger size."""
_TABLE = """
stand any ceramic|metal|plastic small vessel cupboard: mug, cup
stand - - small cupboard: glass, wine glass
stand any glass|plastic small tall: bottle, vase, jar
stand any metal small: can, kettle, thermos, trophy, bucket, watering can
stand any ceramic|metal small: teapot, pitcher, candlestick
stand any wooden|plastic small: clock, radio, toy robot, chess pawn, bookend
stand any - small: candle, desk lamp, alarm clock, camera, teddy bear, rubber duck, toaster, speaker
stand - - small: globe, hourglass, salt shaker, pepper mill, wine bottle
lie any metal|plastic|wooden small slim cutlery: spoon, fork
lie any metal|plastic small cutlery: knife
lie any - small slim: pencil, pen, paintbrush, crayon, marker, toothbrush, ruler
lie any - small flat: book, notebook
lie any wooden|metal|plastic small tool: spatula, ladle, screwdriver, hammer, wrench, comb
lie any - small: eraser, stapler, calculator, sponge, hat, shoe, wallet, phone, flashlight, hairbrush
lie any - small round: ball, marble
lie - - small round: tennis ball, golf ball, baseball
lie any wooden|plastic small cube: cube, block, cylinder
lie any wooden small: toy car, toy truck, toy train
lie - - small: key, coin, domino, battery, tape measure, remote control, candy bar
lie red|green|yellow - small food: apple
lie green|yellow - small food: pear
lie - - small food: banana, lemon, lime, peach, plum, kiwi, avocado, mango, tomato, onion, potato, carrot, cucumber
lie white|brown - small food: egg
lie - - small food: walnut, strawberry, donut, muffin, croissant, cookie, bagel, pretzel, waffle, sandwich
stand any wooden|plastic carrier: tray
lie any ceramic|metal|plastic carrier dish: plate
lie - wooden|plastic carrier: cutting board
lie any - carrier cloth: napkin, towel, placemat
stand any ceramic|glass|wooden holder open: bowl
stand any - holder open: basket
stand any wooden|metal|plastic holder open: box, crate
stand any metal|plastic holder open: bucket
stand any metal holder: pot
stand any wooden furniture: table, desk, bench, coffee table, side table
stand - wooden furniture: workbench, counter, dresser, shelf, nightstand, cabinet
stand any wooden floor: chair, stool
stand any - floor: armchair, sofa, floor lamp, wardrobe, piano, ottoman, trash can, suitcase
"""


def _plural(word: str) -> str:
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if word.endswith(("x", "s", "sh", "ch")) or word in ("potato", "tomato"):
        return f"{word}es"
    return f"{word[:-1]}ies" if word.endswith("y") and word[-2] not in "aeou" else f"{word}s"


def _read() -> list[Noun]:
    made: list[Noun] = []
    for line in _TABLE.strip().splitlines():
        head, _, words = line.partition(":")
        verb, colours, materials, *kinds = head.split()
        for word in words.split(","):
            name = word.strip()
            made.append(
                Noun(
                    word=name,
                    plural=_plural(name),
                    catalogue=frozenset({name, *_SAME.get(name, ())}),
                    verb=verb,
                    colours=COLOURS if colours == "any" else () if colours == "-" else tuple(colours.split("|")),
                    materials=() if materials == "-" else tuple(materials.split("|")),
                    kinds=frozenset(kinds),
                )
            )
    return made


NOUNS = tuple(_read())
FITS = {
    "bowl": ("food", "round", "slim"), "basket": ("food", "round", "flat", "tool", "cube"),
    "box": ("food", "round", "flat", "tool", "slim", "cube"), "crate": ("food", "round", "tall", "tool", "cube"),
    "bucket": ("round", "tool", "cube"), "pot": ("cutlery",), "mug": ("slim",), "cup": ("slim",), "jar": ("slim",),
}  # fmt: skip
"""What kinds of things go in what."""
LAID = {
    "tray": ("vessel", "cupboard", "food", "tall", "dish"), "plate": ("food", "cutlery"), "napkin": ("cutlery", "food"),
    "towel": ("tool", "round"), "placemat": ("dish", "vessel", "cupboard"), "cutting board": ("food", "cutlery"),
    "book": ("slim", "vessel"),
}  # fmt: skip
"""What kinds of things lie on what, besides on furniture."""


def of_kind(*kinds: str) -> tuple[Noun, ...]:
    """The nouns that are of one of `kinds`."""
    return tuple(noun for noun in NOUNS if noun.kinds & {*kinds})


def named(word: str) -> Noun:
    """The noun that is `word`."""
    return next(noun for noun in NOUNS if noun.word == word)
