"""The words that an audit knows: numbers, relation words, what ends a noun phrase, what says nothing by itself."""

from __future__ import annotations

from typing import Literal

Place = Literal[
    "on", "on top", "in", "beside", "left", "right", "front", "behind", "under", "above", "between", "around", "far",
    "hanging", "holding", "with", "from", "across", "against", "its left", "its right", "side",
]  # fmt: skip
"""What a relation word says; "with" and "holding" of what stands behind it; "side" of nothing."""

NUMBERS = {
    "a": 1, "an": 1, "one": 1, "another": 1, "single": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6,
    "seven": 7, "eight": 8, "nine": 9, "ten": 10, "eleven": 11, "twelve": 12, "dozen": 12, "both": 2,
}  # fmt: skip
SOME = frozenset({"few", "couple", "pair", "several", "many", "number", "lot", "dozen", "set"})
"""Words with which "a" counts nothing."""
IRREGULAR = {
    "mice": "mouse", "knives": "knife", "loaves": "loaf", "shelves": "shelf", "dice": "die", "geese": "goose",
    "cacti": "cactus", "leaves": "leaf", "scarves": "scarf", "bookshelves": "bookshelf", "tvs": "tv",
}  # fmt: skip
SINGLE = frozenset({"flowers", "grapes", "fries", "noodles", "playing cards"})
"""Names that are plural and mean one object."""
UNITS = ("cm", "mm", "centimet", "millimet", "meter", "metre", "inch", "foot", "feet", "ml", "lit", "kg", "gram",
         "degree")  # fmt: skip
"""Beginnings of words after a number that counts nothing."""
UNSURE = frozenset({
    "can", "level", "present", "display", "light", "watch", "wrap", "stick", "plane", "line", "stack", "rest", "square",
    "match", "set", "left", "bunch", "pair", "print", "iron", "folder", "weight", "object", "cross", "ring", "token",
    "throw", "swing", "scale", "stand", "paper", "file", "clip", "slip", "letter", "bolt", "sign", "wheel", "robot",
})  # fmt: skip
"""Names that are other words as often, or parts of a thing."""
NAMES_BEHIND_ARTICLES = frozenset({"can", "swing", "scale", "bolt", "folder", "plane"})
"""Those of them that name a thing where "a" or "the" stands before them."""
GATHERINGS = frozenset({"bunch", "bouquet", "pair", "set", "row", "line", "level", "heap"})
"""Words of which the plural too counts what stands behind it."""
SHADES = frozenset({"dark", "light", "pale", "bright", "deep", "soft", "warm", "cool", "rich", "muted"})
ADJECTIVES = frozenset({
    "small", "large", "big", "little", "tiny", "huge", "round", "square", "tall", "short", "long", "wide", "thin",
    "thick", "old", "new", "empty", "clear", "flat", "wooden", "shiny",
})  # fmt: skip
"""Words between which "and" and a comma join no objects."""
ARTICLES = frozenset({
    "a", "an", "the", "this", "that", "these", "those", "another", "each", "every", "some", "any", "all", "both",
    "its", "their", "my", "your", "his", "her", "our", "no", *NUMBERS,
})  # fmt: skip
ALIKE_IN_PLURAL = frozenset({"sheep", "fish", "deer"})
"""Nouns of which the plural is no other word."""
PRONOUNS = frozenset({"it", "them", "which", "each", "one", "that", "both", "him", "her", "this"})
ORDINALS = frozenset({"second", "third", "fourth", "fifth"})
HEADLESS = ORDINALS | frozenset({
    "first", "last", "left", "right", "middle", "top", "bottom", "upper", "lower",
    "other", "others", "former", "latter", "smaller", "larger", "smallest", "largest", "tallest", "shortest", "bigger",
    "biggest",
})  # fmt: skip
"""Words that name an object of which the noun is not said."""
ENDING = frozenset({"one", "ones", "and", "but", "while", "is", "are", "or"})
"""Words behind which such a word stands alone."""
BACKWARD = frozenset({"it", "them", "him", "her"})
"""Pronouns for something named before."""
THINGS = frozenset({"object", "item", "thing"})
FARTHEST = frozenset({"farthest", "furthest"})
PRECISELY = frozenset({"directly", "immediately", "just", "right", "exactly"})
"""Words before a place that say no more than the place."""
OPENING = frozenset({"and", "but", "while", "then", "there", "where", "also", "is", "are", "lies", "lie",
                     "stands", "stand", "sits", "sit", "rests", "rest"})  # fmt: skip
"""Words after which a clause may begin with a place."""
REACHING = PRONOUNS | {"they", "there", "these", "ones", "former", "latter", "other", "first", "second", "last"}
"""Words that speak of what another sentence has named."""
REPEATS = frozenset({
    "each", "every", "either", "per", "pair", "pairs", "both", "row", "rows", "stack", "stacks", "more", "others",
    "other", "another", "one", "ones", "rest", "half", "most", "x", "times", "pile", "heap", "piles", "rainbow",
    "without",
})  # fmt: skip
"""Words by which there are more of a thing than its name's number says."""
FORMED = frozenset({"row", "rows", "stack", "stacks", "pile", "piles", "heap"})
"""Those of them behind which the number of one such form may stand: "a stack of four books"."""
SHAPES_OF_STACKS = frozenset({"tower", "towers", "stack", "stacks", "pile", "piles", "column", "columns"})
SPLITTING = REPEATS | NUMBERS.keys() - {"a", "an"} | HEADLESS | {"some", "respectively", "remaining", "several"}
"""Words by which likes are told from one another."""
SIDES = frozenset({"left", "right", "front", "back"})
EACH = frozenset({"each", "every", "either"})
GUESTS = frozenset({"place", "setting", "seat", "person", "people", "persons", "guest", "guests", "diner", "diners"})
"""Who has what stands behind "each" on a table, and where they sit."""
ENDS = frozenset({"end", "side", "ends", "sides", "hand"})
CORNERS = frozenset({"corner", "corners"})
PARTS: dict[str, frozenset[str]] = {
    **dict.fromkeys(("edge", "rim", "lip", "border"), frozenset({"at_edge"})),
    "end": frozenset({"at_edge", "at_ends", "left_of", "right_of"}), "corner": frozenset({"in_corner", "in_corners"}),
    **dict.fromkeys(("middle", "center", "centre"), frozenset({"in_middle", "between"})),
    "bottom": frozenset({"under"}), "head": frozenset({"on"}), **dict.fromkeys((
        "foot", "handle", "leg", "arm", "armrest", "spout", "neck", "collar", "zipper", "buckle", "strap", "sleeve",
        "cuff", "heel", "sole", "clasp", "grip", "shaft", "tail", "ear", "nose", "wheel", "stem", "brim", "stopper",
        "horn", "fringe", "hilt"), frozenset()),
}  # fmt: skip
"""Parts of things, and the relations that are at them."""
CLOSED = frozenset({"dresser", "cabinet", "fridge", "refrigerator", "microwave", "oven", "toaster oven", "wardrobe",
                    "dishwasher", "washing machine", "dryer", "drawer", "cupboard", "freezer"})  # fmt: skip
"""What things are in when they are in it: to be on it is something else."""
HOLLOW = frozenset({"bowl", "cup", "mug", "glass", "pot", "pan", "jar", "vase", "basket", "box", "bucket", "bin",
                    "crate", "beaker", "pitcher", "container", "tray", "plate", "jug", "saucepan", "case",
                    "bag"})  # fmt: skip
"""Last words of nouns of what holds things, and looks another when it is empty."""
FLOOR = frozenset({"floor", "ground", "grass", "carpet"})
"""Words that say where something is that nothing carries."""
LEADING = frozenset({
    "is", "are", "was", "were", "in", "turn", "sits", "sit", "stands", "stand", "lies", "lie", "rests", "rest",
    "sitting", "standing", "lying", "resting", "placed", "itself", "also", "has", "have",
})  # fmt: skip
"""Words between a relative pronoun and the relation word."""
FINITE = frozenset({
    "is", "are", "was", "were", "sits", "sit", "stands", "stand", "lies", "lie", "rests", "rest", "hangs", "hang",
    "sat", "stood", "lay",
})  # fmt: skip
"""Verbs that say where the subject of a clause is."""
HAS = frozenset({"has", "have", "holds", "hold", "contains", "contain", "carries", "carry", "supports", "bears"})
"""Verbs that say what the subject of a clause has."""
POSED = FINITE | frozenset({
    "sitting", "standing", "lying", "resting", "placed", "located", "positioned", "situated", "set", "laid", "seated",
    "hanging", "leaning", "perched", "balanced", "displayed", "arranged", "just", "right", "directly", "also",
    "still", "now", "immediately", "neatly", "all", "both", "upright", "open", "closed",
})  # fmt: skip
"""Words between what is somewhere and the word that says where."""
SHARED = frozenset({"split", "divided", "shared", "distributed", "evenly", "equally", "spread"})
"""Words before a "between" that says in what things are."""
FALLEN = frozenset({"fallen", "rolled", "dropped", "slid", "slipped", "spilled", "tumbled", "fell"})
"""Words before "out of" and "off" of what is not there any more."""
SPREAD = frozenset({"strewn", "spread", "scattered", "sprawled", "littered"})
"""Words before an "across" that says on what things are."""
REQUESTS = frozenset({"give", "hand", "pass", "bring", "fetch", "show", "get", "take", "move", "put", "pick"})
"""Words with which something is asked for."""
TOGETHER = tuple(tuple(words.split()) for words in (
    "as well as", "along with", "together with", "in addition to", "instead of", "apart from", "namely", "among them",
    "respectively", "half as many", "twice as many", "the same goes for", "not to mention",
))  # fmt: skip
"""What joins names to the rest of a sentence in more than one way."""
PARTICIPLES = frozenset({"holding", "containing", "carrying", "supporting", "filled", "full", "topped"})
"""Words of holding that are said of what stands right before them."""

POURED = frozenset({"soy sauce", "ketchup", "mustard", "mayonnaise", "hot sauce", "honey", "syrup", "vinegar",
                    "milk", "olive oil", "tomato sauce", "peanut butter", "salad dressing", "sugar box",
                    "salt shaker", "milk carton", "juice bottle", "beer bottle", "wine bottle",
                    "cereal box"})  # fmt: skip
ON_DISHES = frozenset({"plate", "bowl", "pan", "frying pan", "saucepan", "pot", "cup", "mug", "glass", "bread",
                       "burger", "pancake", "waffle", "hot dog", "sandwich", "pizza", "fish", "egg",
                       "fruit bowl", "jar", "wine glass", "tumbler", "teacup", "jug", "pitcher"})  # fmt: skip
"""What of something poured is meant to be on, or in."""
PIECES = frozenset({"slice", "piece", "wedge", "chunk"})
UNCOUNTED = frozenset({"luggage", "furniture", "jewelry", "paper", "cloth", "fruit", "equipment", "chalk", "art"})
"""What there are pieces of that are whole."""
PACKETS = frozenset({"bottle", "jar", "can", "box", "carton", "packet", "tube", "shaker", "container", "jug"})


def _relations() -> dict[tuple[str, ...], Place]:
    sides = [f"{word} the {side}{tail}" for word in ("to", "on", "at") for side in ("{}",) for tail in ("", " side")]
    left, right = ([f"{side.format(name)} of" for side in sides] for name in ("left", "right"))
    table: dict[Place, tuple[str, ...]] = {
        "on": ("on", "onto", "upon", "covers", "covering", "adorns", "occupies", "decorates", "graces", "tops"),
        "on top": ("on top of", "atop", "on the top of", "to the top of"),
        "in": ("in", "inside", "within", "into", "inside of", "share", "shares", "fill", "fills"),
        "beside": ("on one side of", "on the other side of", "at one end of", "on each side of", "on either side of",
                   "on both sides of", "beside", "next to", "near to", "near", "by",
                   "close to", "closest to", "nearest to", "nearest", "in the vicinity of", "in the proximity of",
                    "opposite", "among", "outside", "alongside",
                   "adjacent to", "along", "from the base of", "from the foot of", "from beside", "from next to"),
        "against": ("against",),
        "its left": ("to its left", "on its left"),
        "its right": ("to its right", "on its right"),
        "left": ("left of", *left),
        "right": ("right of", *right),
        "front": ("in front of", "before", "to the front of"),
        "behind": ("behind", "in back of"),
        "under": ("under", "beneath", "below", "underneath"),
        "above": ("above", "over"),
        "between": ("between", "in between"),
        "around": ("around", "surrounding"),
        "far": ("far from", "far away from", "away from"),
        "hanging": ("hanging from", "hangs from", "hang from", "hanging on", "hangs on", "suspended from", "hung from"),
        "holding": ("holding", "holds", "hold", "contains", "containing", "contain", "carries", "carry", "carrying",
                    "supports", "supporting", "held", "wearing", "wears", "bearing", "bears", "filled with",
                    "loaded with", "full of", "topped with", "topped by", "covered by", "occupied by"),
        "with": ("with", "has", "have", "surrounded by", "surrounded with", "flanked by", "bordered by"),
        "from": ("from", "from above", "from on top of", "out of", "off", "off of"),
        "across": ("across", "spanning", "bridging"),
        "side": ("on the left", "on the right", "to the left", "to the right", "from left to right", "on one side",
                 "from the left", "from the right",
                 "on the other side", "on the other", "in the middle", "in a row", "on top", "in front",
                 "on either side", "on both sides", "hand over", "hands over", "on top of each other",
                 "next to each other", "beside each other", "on each other"),
    }  # fmt: skip
    return {tuple(words.split()): place for place, phrases in table.items() for words in phrases}


RELATIONS = _relations()
LONGEST = max(map(len, RELATIONS))
PLACING = frozenset(phrase[-1] for phrase in RELATIONS)
"""Words behind which a landmark stands."""
_WITHIN = (
    frozenset({"left", "right", "front", "top", "full", "side", "end", "row", "middle", "other", "back"}) | ARTICLES
)
"""Words of relation phrases that stand in noun phrases too."""
BREAKING = (
    LEADING | PRONOUNS | frozenset(word for phrase in RELATIONS for word in phrase) | {
        "and", "or", "but", "then", "while", "to", "at", "as", "than", "there", "here", "be", "been", "being",
        "hangs", "hang", "leans", "lean", "put", "place", "move", "take", "pick", "bring", "stack", "where", "who",
        "whose", "what", "when", "not", "without", "except", "like", "including", "of", "'s",
    }
) - _WITHIN  # fmt: skip
"""Words that end a noun phrase to the left of its noun."""

_BUILDING = """
a an the that this these those its their it them they his her my your our some any all both each every either other
another own same which who one ones and or but then while so as also too plus here there where is are was were be been
visible immediately entirely able assist help current present location
being has have had do does of to at by in on with for from into onto up down out off over next side sides row rows line
consists consisting surround surrounds encircle encircles include includes
stack pile top middle center centre edge corner end left right front back first second third last nothing showing
complete featuring including objects items things everything others exactly about well together somewhere what shown
seen should must need i'd give following features color immediate amidst belongs belong leave keep needs need goes go
upside upright head facing
faces face turned turn wearing directly opposite former latter decorated bearing fruit fruits toys tools
vegetables stationery snacks cutlery utensils drinks plush covers rim smallest largest biggest bigger smaller larger
bottom upper topmost leftmost rightmost lower pieces piece very quite just really only please can could you i me we us
would
like several animals want see imagine show create make build corners he she they namely whereas itself themselves
himself herself now still appliances
already image possible you'll littering appreciate locate finally sure certain ensure find finds generate remaining
exist exists
yesterday today currently simply form forms forming appears appear x count slightly except
however moreover furthermore additionally therefore thus hence consequently specifically notably naturally obviously
overall initially meanwhile usual always note notice luckily unfortunately fortunately sadly usually addition
example instance particular general fact
i'm we're you'll i'll i'd we'd let let's love perhaps maybe ought got think thinking imagining picturing envisioning
scene scenario suppose consider someone somebody built children midway halfway spaced whichever start begin proceed
"""
_POSTURES = """
hidden else cover
dangle dangles dangling
sits sit sat sitting stands stand stood standing lies lie lay laid lying laying rests rest rested resting leans lean
leaned leaning hangs hang hung hanging placed put set located positioned situated arranged displayed perched nestled
served scattered spread kept stored wedged tucked
stuck propped planted parked floats organized strewn touching pointing points gazing overflowing held balanced
flank flanks share shares fill fills sandwiched perches split evenly equally divided distributed
stacked piled lined seated found contains holding holds filled full topped surrounded flanked between
"""
_DEEDS = """
moved returned brought carried unload empty organize sort select identify remove retrieve return pack gather clean
bring drop add give turn complete raise prepare ends finish finished done
put place pick take move grab grasp lift stack transfer fetch insert push slide carry get hold use using arm arms hand
robot robotic gripper away back close pass hand relocate reposition shift drag throw putting placing stacking
picking moving taking lifting bringing tidy clear scoop seize extract unhook alone grip firm strip
arrange load collect toss chuck slap plop pop lob fling hurl gather sweep shove nudge deposit stow stash dump cover seal
serve position release hoist heave haul guide ease pull repeat likewise afterwards
"""
SILENT = frozenset(
    (*_BUILDING.split(), *_POSTURES.split(), *(word for phrase in RELATIONS for word in phrase), *NUMBERS)
)
"""Words that build a sentence, and words for places, which are compared with the plan as claims."""
_TOLD_OF = "picks lifts places sets grabs takes moves puts grasps reach ask tell keeping choose"
DEEDS = frozenset(f"{_DEEDS} {_TOLD_OF}".split())
"""Words of a task."""
COMPARING = frozenset({"more", "fewer", "less"})
"""Words between a number and a name that make it a difference."""
