"""How likely one thing stands in a relation to another: what has a cavity, a top, a rim; what is larger.

The one place where attachment and pronouns are decided: every reading is the sum of what its relations cost.
"""

from __future__ import annotations

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.sizes import slips_into, too_large
from pat3d.plan.grammar.words.vocabulary import Nouns

USUAL = 0.34
"""Cost of being had by something below which one thinks of it as on or in its owner."""
_NEUTRAL = 0.35
_SUPPORTING = (
    "cake", "book", "box", "pillow", "radio", "basket", "block", "pizza", "laptop", "pancake", "brick", "crate",
    "suitcase", "notebook", "magazine", "bread", "burger", "sandwich", "cube", "printer", "microwave", "speaker", "can",
    "cylinder", "plank", "cardboard sheet", "towel", "napkin", "steak", "cookie", "waffle", "storage box",
    "wood block", "toy brick", "jenga block", "stack of paper", "dresser", "toolbox", "cracker box",
    "treasure chest", "cardboard box", "paint can", "newspaper", "mouse pad", "scale", "kitchen scale",
    "arch",
)  # fmt: skip
"""Flat enough to carry one thing, besides furniture and dishes."""
_PANS = ("pan", "frying pan", "skillet", "griddle")


_CLOSED_BY_LIDS = ("bottle", "teapot", "kettle", "thermos", "canister", "cookie jar", "water bottle", "can", "carton",
                   "rice cooker", "pressure cooker", "flask", "box", "toolbox", "tube")  # fmt: skip
"""What a lid or a cap is on, besides what is hollow."""
_POTTED, _POTS = ("plant", "potted plant", "cactus"), ("flower pot", "planter", "vase", "pot")
LEAFY = (*_POTTED, "tree", "succulent", "bush")
"""What its leaves give its colour."""
_GROWING = (*LEAFY, "flower", "rose", "tulip", "bouquet", "seed", "trowel")
"""What one thinks of in a flower pot, the first of it planted."""
TOPPED = ("cake", "pie", "pizza", "cupcake", "muffin", "pancake", "waffle", "ice cream", "bread", "donut", "lettuce")
_TOPPINGS = (*lexicon.FRUIT, "strawberry", "blueberry", "raspberry", "blackberry", "tomato", "mushroom", "cheese",
             "egg", "olive", "bell pepper", "onion", "candle", "sausage", "walnut", "almond", "cookie", "cabbage",
             "bacon", "steak", "carrot", "broccoli", "garlic")  # fmt: skip
"""What is on a cake, a pizza, a salad, that is topped with it."""
_FOOD = (*lexicon.MAIN_DISHES, *lexicon.FRUIT, *TOPPED, "cookie", "croissant", "bagel", "egg", "potato", "cheese")
_TABLEWARE = ("fork", "knife", "spoon", "chopsticks", "napkin")
"""What lies beside food, not on it."""
_SOFT = ("bed", "sofa", "armchair", "pillow", "floor cushion", "blanket")
"""Seats on which nobody leaves a cup."""
LARGE = ("cardboard sheet", "suitcase", "dog", "cat", "plant", "guitar", "backpack", "umbrella", "traffic cone",
    "barrel", "tv", "rabbit", "robot", "globe", "drum", "broom", "toy truck", "ladder", "dollhouse", "birdcage",
    "aquarium", "washtub", "log", "shredder", "hose", "toy wagon")  # fmt: skip
"""What may stand on the floor as well as on a table."""


class Plausible:
    """Costs of relations between catalogue nouns; 0 for the ordinary, 3 for what hardly happens."""

    def __init__(self, nouns: Nouns) -> None:
        self._nouns = nouns

    def is_a(self, noun: str, *tables: tuple[str, ...]) -> bool:
        """Whether `noun` belongs to one of these classes of the lexicon."""
        return any(self._nouns.of_class(noun, table) for table in tables)

    def floor(self, noun: str) -> bool:
        """Whether it stands on the floor by nature."""
        return self.is_a(noun, lexicon.FLOOR)

    def hollow(self, noun: str) -> bool:
        """Whether things go into it from above."""
        return self.is_a(noun, vessels.HOLLOW)

    def closet(self, noun: str) -> bool:
        """Whether things go into it through a door or a drawer."""
        return self.is_a(
            noun, lexicon.STORAGE, vessels.CLOSED, tuple(lexicon.HOUSES.values()), ("drawer", "open drawer")
        )

    def opens(self, noun: str) -> bool:
        """Whether it is a thing to put others into: a vessel, a cupboard, a bag; a desk is first of all a table."""
        flat = self.is_a(noun, ("desk", "cart"))
        inside = self.hollow(noun) or self.is_a(noun, tuple(vessels.OPENED), vessels.HOLDERS)
        return inside or (self.closet(noun) and not flat)

    def level(self, noun: str) -> bool:
        """Whether it has a level top to put things on."""
        return self.is_a(noun, lexicon.LEVEL, lexicon.SEATS, lexicon.DISHES)

    def on(self, child: str, parent: str) -> float:
        """Of `child` resting on `parent`."""
        if self.closes(child, parent):
            return 0.0
        if self.is_a(child, vessels.ON_RIMS):
            return 0.9 if not self.floor(parent) else 0.45
        if (
            self.floor(child)
            and self.is_a(parent, lexicon.THIN)
            and not self.is_a(parent, ("rug", "mat", "carpet", "blanket"))
        ):
            return 2.5
        if self.floor(child) and not self.is_a(child, ("floor cushion", "stool", "chair", "table", "coffee table")):
            return 2.5 if not self.is_a(parent, lexicon.THIN[:3]) else 1.2
        if self.floor(child):
            seated = self.is_a(child, ("floor cushion",)) and self.is_a(parent, lexicon.SEATS)
            return 0.4 if seated or self.is_a(parent, ("rug", "mat", "carpet", "bed")) else 2.0
        if self.is_a(parent, lexicon.BENEATH_CUPS) and self._vessel(child):
            return 0.0
        if self.is_a(parent, lexicon.DISHES) and not self.is_a(parent, ("tray", "placemat")):
            return 0.1 if self._fits_dish(child) else 0.9
        if self.is_a(parent, _SOFT) and self.hollow(child) and not self.is_a(child, vessels.LARGE_VESSELS):
            return 0.7
        if self.level(parent):
            return 0.0
        if self.is_a(parent, _FOOD) and (self.is_a(child, lexicon.DISHES, _TABLEWARE) or self.hollow(child)):
            return 1.5
        if self.is_a(child, lexicon.WORN) and self.is_a(parent, lexicon.FIGURES):
            return 0.2
        if self.is_a(child, lexicon.ON_HEAD):
            return 0.5
        panned = self.is_a(parent, _PANS) and self._fits_dish(child)
        if self.is_a(parent, _SUPPORTING) or self.tops(child, parent) or panned:
            return 0.3
        if self.is_a(parent, lexicon.ROUND, vessels.SLENDER) and child != parent:
            return 2.2
        if self.hollow(parent):
            return 0.9
        return 0.6 if child == parent else 1.1

    def stands_by(self, child: str, parent: str) -> bool:
        """Whether `child` is beside `parent` where it is "on the left side of" it: furniture, a lamp by a bed."""
        by_seat = self.is_a(child, lexicon.BY_A_SEAT) or self.hollow(child)
        return self.floor(child) or (by_seat and self.is_a(parent, _SOFT[:3]))

    def tops(self, child: str, parent: str) -> bool:
        """Whether `child` is what food such as `parent` is topped with or covered in."""
        return self.is_a(parent, TOPPED) and self.is_a(child, _TOPPINGS)

    def closes(self, child: str, parent: str) -> bool:
        """Whether `child` is what closes `parent`: the lid of a jar, the cap of a bottle."""
        if child == "cap":
            return self.is_a(parent, lexicon.PARTS_OF["cap"])
        return self.is_a(child, vessels.ON_RIMS) and (self.hollow(parent) or self.is_a(parent, _CLOSED_BY_LIDS))

    def within(self, child: str, parent: str) -> float:
        """Of `child` being inside `parent`."""
        if self.floor(child):
            return 2.5
        if self.is_a(child, _POTTED) and self.is_a(parent, _POTS):
            return 0.0
        if self.is_a(parent, _POTS[:2]) and not self.is_a(child, _GROWING):
            return 0.7
        if self.hollow(parent):
            if self.is_a(parent, vessels.NARROW):
                if self.is_a(child, vessels.SLENDER):
                    return 0.0
                return 1.6 if self._vessel(child) else 0.2 if slips_into(child, parent) else 0.7
            if child != parent and self.is_a(child, vessels.LARGE_VESSELS, vessels.NOT_IN_VESSEL):
                return 1.6
            if child != parent and self.is_a(parent, vessels.BOWLS):
                return 1.3 if self._vessel(child) or self.is_a(child, lexicon.LEVEL, lexicon.NOT_ON_DISH) else 0.0
            return 0.0
        if self.closet(parent) or self.is_a(parent, tuple(vessels.OPENED), vessels.HOLDERS):
            return 0.3
        if self.level(parent):
            return 0.5 + self.on(child, parent)
        return 2.0 if self.level(child) else 1.7

    def beside(self, child: str, parent: str) -> float:
        """Of the two standing next to each other."""
        if self.floor(child) == self.floor(parent):
            return 0.1
        lone = child if self.floor(parent) else parent
        # "A sink and a toilet in front of a mirror", which hangs or stands there
        return 0.4 if self.is_a(lone, lexicon.BY_A_SEAT, vessels.LARGE_VESSELS, LARGE, ("mirror",)) else 1.4

    def held(self, child: str, kind: str, parent: str) -> float:
        """Of `child` being carried by `parent` in the manner `kind`."""
        if kind == "hangs_from" or self.is_a(parent, lexicon.HOOKED):
            return 2.0 if self.floor(child) else 0.2
        return self.within(child, parent) if kind == "in" else self.on(child, parent)

    def carried(self, child: str, kind: str, parent: str) -> float:
        """Of `child` being carried by `parent`, which may be too small for it."""
        return self.held(child, kind, parent) + too_large(child, parent)

    def relation(self, link: Link, child: str, parent: str) -> float:
        """Of `child` LINK `parent` for a link whose child stands first; also "" for what has no noun."""
        if not child or not parent:
            return _NEUTRAL
        if link.manner == "under" and self.floor(parent) and self.level(parent) and not self.floor(child):
            return 0.1
        if link.manner == "under":
            return min(self.on(parent, child), self.beside(child, parent) + 0.2)
        if link.manner == "edge" or (link.manner == "half" and link.side == "centre"):
            # "in the middle of it": of what has a middle to put things on.
            return self.on(child, parent) if self.level(parent) else 0.6 + self.beside(child, parent)
        if link.manner == "half":
            return min(self.on(child, parent), self.beside(child, parent))
        if link.manner in ("source", "goal"):
            return min(self.on(child, parent), self.within(child, parent))
        if link.kind == "hangs_from" or (link.kind in ("on", "in") and self.is_a(parent, lexicon.HOOKED)):
            return self.held(child, "hangs_from", parent)
        if link.kind == "in":
            return self.within(child, parent)
        slender = self.is_a(child, vessels.SLENDER) and not self.is_a(child, lexicon.LONG)
        if link.says == "across" and self.hollow(parent) and slender:
            # "A spoon across a bowl"; a plank lies across two things.
            return 0.0
        if link.said == "over" and self.is_a(child, vessels.COVERS):
            return min(self.on(child, parent), 0.3)
        if link.kind == "on":
            return self.on(child, parent)
        return self.beside(child, parent)

    def having(self, link: Link, parent: str, child: str) -> float:
        """Of `parent` "with" `child`."""
        if not child or not parent:
            return _NEUTRAL
        if link.manner in ("flank", "surround"):
            return self.beside(child, parent)
        if link.said == "over" and self.is_a(child, vessels.COVERS):
            return 0.0
        if link.kind == "on":
            return self.on(child, parent)
        if self.closes(child, parent):
            return 0.0
        if link.manner == "hold" and self.is_a(parent, lexicon.FIGURES) and not self.floor(child):
            return 0.3
        if self.is_a(child, lexicon.SEATS[-4:]) and self.is_a(parent, lexicon.SEATS[:6]):
            return 0.1
        if self.floor(child):
            return 0.7
        opens = self.hollow(parent) or self.closet(parent)
        opens = opens or self.is_a(parent, tuple(vessels.OPENED), vessels.HOLDERS)
        inside = self.within(child, parent) if opens else 9.0
        cost = min(inside, self.on(child, parent) + (1.0 if self.hollow(parent) else 0.0))
        if link.manner == "hold":
            # What can only be stacked on something is hardly held by it.
            return cost + 0.2 * (inside > cost and not self.level(parent))
        return min(cost, 0.7 if not self.hollow(parent) else cost)

    def _vessel(self, noun: str) -> bool:
        return self.hollow(noun) and not noun.endswith(("spoon", "ladle"))

    def _fits_dish(self, child: str) -> bool:
        return not self.is_a(child, lexicon.NOT_ON_DISH) and not self.hollow(child)

    def fits(self, phrase: Phrase) -> str:
        """The noun by which `phrase` is judged."""
        if phrase.kind != "object":
            return ""
        return phrase.noun or (self._nouns.resolve(phrase.cycle[0]) or "" if phrase.cycle else "")
