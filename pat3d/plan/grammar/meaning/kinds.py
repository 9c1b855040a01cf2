"""What "the fruit" and "the tools" speak of where things of that kind were named before: "an apple, a pear and a cup".

Where none was, a few that are usual stand in, see `lexicon.GENERICS`.
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS

_EATING = ("fork", "knife", "spoon", "teaspoon", "chopsticks")
_VEGETABLES = (
    "bell pepper", "broccoli", "cabbage", "carrot", "celery", "chili pepper", "corn", "cucumber", "eggplant", "garlic",
    "ginger", "mushroom", "onion", "potato", "pumpkin", "radish", "sweet potato", "tomato", "pepper", "lettuce",
)  # fmt: skip
_WRITING = ("pencil", "pen", "ruler", "eraser", "marker", "stapler", "scissors", "notebook", "glue stick", "crayon")
KINDS: dict[str, tuple[str, ...]] = {
    "fruit": (
        "apple", "orange", "banana", "lemon", "pear", "avocado", "blueberry", "cherry", "coconut", "fig", "grapes",
        "kiwi", "lime", "mango", "peach", "pineapple", "plum", "pomegranate", "raspberry", "strawberry", "watermelon",
    ),
    "vegetable": _VEGETABLES,
    "veggie": _VEGETABLES,
    "cutlery": _EATING,
    "silverware": _EATING,
    "utensil": (*_EATING, "ladle", "spatula", "whisk", "tongs", "peeler", "grater", "rolling pin"),
    "dish": ("plate", "bowl", "cup", "mug", "saucer", "glass", "teacup", "baking dish", "ramekin"),
    "tool": (
        "hammer", "screwdriver", "wrench", "pliers", "allen key", "axe", "chisel", "clamp", "crowbar", "drill", "saw",
        "hacksaw", "mallet", "multimeter", "putty knife", "spirit level", "tape measure", "utility knife", "flashlight",
    ),
    "toy": (
        "ball", "block", "rubber duck", "teddy bear", "doll", "robot", "toy car", "toy plane", "toy train", "toy truck",
        "toy brick", "toy sailboat", "puzzle cube", "stacking rings", "figurine", "dinosaur", "plush cat", "plush dog",
        "rabbit", "elephant", "giraffe", "panda", "octopus", "domino", "drum",
    ),
    "stationery": _WRITING,
    "office supply": _WRITING,
}  # fmt: skip
"""Catalogue nouns of a kind, by the word for it."""
CALLED: dict[str, tuple[str, ...]] = {
    "cup": ("mug", "teacup", "coffee cup", "tea cup"), "tub": ("bathtub", "washtub"), "book": ("notebook",),
    "bag": ("backpack", "handbag", "suitcase", "shopping bag"), "box": ("crate", "toolbox"), "chair": ("armchair",),
    "plant": ("cactus", "succulent"), "flower": ("rose", "tulip"), "hat": ("cap", "beanie"), "ball": ("basketball",),
    "bottle": ("flask", "thermos"), "knife": ("cleaver",), "pan": ("wok",), "bin": ("wastebasket", "trash can"),
    "shelf": ("bookshelf",), "bird": ("owl", "penguin", "duck", "rubber duck"), "bed": ("crib",),
}  # fmt: skip
"""Catalogue nouns of what "the cup" may be that was named by a narrower word before."""


def called(phrase: Phrase, groups: Sequence[Group]) -> Group | None:
    """What "the tub" of `phrase` is of `groups` where one alone was named that may be called so: "a bathtub"."""
    names = (phrase.said, phrase.head, *singulars(phrase.head))
    nouns = next((CALLED[word] for word in names if word in CALLED), ())
    like = [group for group in groups if group.noun in nouns and not group.replaced
            and {*phrase.modifiers.colours} <= {*group.modifiers.colours}]  # fmt: skip
    plain = len(like) == 1 and phrase.definite and not (phrase.each or phrase.some or phrase.part or phrase.other)
    known = plain and (not like[0].phrase.definite or like[0].noun.endswith(phrase.head))
    return like[0] if known and phrase.several == (len(like[0].items) > 1) else None


def of_kind(phrase: Phrase, groups: Sequence[Group], left: Sequence[Item]) -> list[Item]:
    """The things of `groups` but those of `left` that `phrase` speaks of as a kind; none where it may mean others."""
    kind = next((word for word in (phrase.head, *singulars(phrase.head)) if word in KINDS), None)
    if kind is None or not phrase.cycle or not phrase.definite or phrase.modifiers != NO_MODIFIERS:
        return []
    if any(group.cycle and {*group.cycle} == {*phrase.cycle} for group in groups):
        return []
    named = [item for group in groups if group.noun in KINDS[kind] and not group.replaced for item in group.items]
    named = [item for item in named if item not in left]
    several = phrase.plural or phrase.head in ("fruit", "cutlery", "silverware", "stationery")
    wanted = phrase.count or (len(named) if several else 1)
    return named if len(named) == wanted else []
