"""The words before a head noun: colours, materials, sizes and the rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pat3d.assets.colours import MIXED, find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.measures import Measure, is_measure, read_measure
from pat3d.plan.grammar.words.number_words import ORDINALS
from pat3d.plan.grammar.words.postures import is_posture, read_posture

_COLOURED = frozenset({"colored", "coloured", "color", "colour", "hued"})
_UNNAMED = frozenset({"light", "dark", "pale", "same"})
"""What is said of a colour that is not named: "light-colored"."""
_WHOLE = frozenset({"painted", "tinted", "toned", "hued", "lacquered", "glazed", "enamelled", "enameled", "dyed",
                    "stained", "coated", "washed", "covered", "plated", "upholstered", "furred", "skinned", "shaded",
                    "finished", "tiled", "bodied"})  # fmt: skip
"""Last words of what gives the colour of a whole thing: "red-painted"."""
_FEATURES = frozenset({"eyed", "haired", "cheeked", "nosed", "bearded", "eared", "tailed", "legged", "faced", "lipped"})
"""Last words of what gives the colour of a part of a figure, which is never made in it."""
_MANY = frozenset(
    {"different", "differently", "multi", "various", "brightly", "bright", "assorted", "mixed", "vibrant"}
)
TONES = {"warm": ("red", "orange", "yellow"), "cool": ("blue", "green", "purple")}
"""The colours of what is "warm-coloured"."""
COLOURED = "coloured"
ONE_OF = frozenset({COLOURED, *TONES})
"""The palettes of "coloured" and "warm-coloured", which one thing has one colour of that is not said."""
_MIXED = {**MIXED, COLOURED: MIXED["colorful"], "multicoloured": MIXED["multicolored"],
          "multi-colored": MIXED["multicolored"], "multi-coloured": MIXED["multicolored"],
          "rainbow-colored": MIXED["rainbow"]}  # fmt: skip
_NO_ADJECTIVE = frozenset({"fruit", "cake", "food", "soap", "electronics", "foliage", "bread", "upholstery",
                           "skin"})  # fmt: skip
"""Materials and colours whose name before a noun means a purpose ("fruit bowl", "soap dish", "bread knife")."""
_WORKED = frozenset({"cutter", "clip", "knife", "shredder", "sorter", "punch", "holder", "weight", "cleaner", "chisel",
                     "file", "screw", "stove", "softener"})  # fmt: skip
_HELD = frozenset({("cream", "jug"), ("cream", "pitcher"), ("mustard", "jar"), ("mustard", "pot"), ("olive", "jar"),
                   ("peach", "can")})  # fmt: skip
_COLOUR_FIRST = frozenset({"golden", "bronze", "copper", "gold", "silver"})
_ADJECTIVES = frozenset({
    "soft", "simple", "bright", "modern", "old", "new", "cute", "round", "square", "tall", "short", "long", "wide",
    "thin", "thick", "plain", "clean", "open", "closed", "smooth", "rough", "fresh", "ripe", "vintage", "antique",
    "ancient", "elegant", "warm", "cool", "light", "dark", "calm", "sleek", "quiet", "empty", "full", "heavy", "flat",
    "minimalist", "fluffy", "cozy", "striped", "curved", "sturdy", "rustic", "neat", "tidy", "happy", "sweet",
    "juicy", "slender", "stylish", "functional", "delicate", "intricate", "crisp", "vibrant", "plump", "bold", "hefty",
    "hot", "cold", "wet", "shiny", "dirty", "messy", "tasty", "creamy", "crunchy", "spicy", "salty", "dusty", "rusty",
    "ornate", "pristine", "lush", "quaint", "serene", "retro", "unlit", "splendid", "fragrant", "translucent", "sharp",
    "sour", "bitter", "sticky", "sleepy", "lively", "lovely", "cheerful", "polished", "weathered", "slim", "compact",
    "rectangular", "circular", "triangular", "angular", "irregular", "unique", "opaque", "precise", "exact", "matte",
    "matt", "glossy", "damp", "moist", "cosy", "comfy", "snug", "dim", "uneven", "asleep", "awake", "off-centre",
    "off-center", "slight", "subtle", "nice", "friendly", "homely", "airy", "pretty", "fancy", "classy", "trendy",
    "sunny", "humble", "chic", "ugly", "busy", "contemporary", "peaceful", "welcoming", "inviting", "tranquil",
})  # fmt: skip
TOLD_BY_PLACE = frozenset({*ORDINALS, "last", "leftmost", "rightmost", "middle"})
"""Members of a group named by their place alone: "a ball in the first"."""
_ENDINGS = ("ful", "ish", "ous", "al", "ic", "able", "ible", "less", "ive", "ed", "ing", "ny", "zy", "fy", "ty", "ky")


@dataclass(frozen=True, kw_only=True)
class Modifiers:
    """What the words before a head noun say."""

    colours: tuple[str, ...] = ()
    palette: tuple[str, ...] = ()
    """Colours that the objects of a group take in turn."""
    palette_word: str = ""
    material: str | None = None
    material_word: str = ""
    scale: float = 1.0
    size_word: str = ""
    adjectives: tuple[str, ...] = ()
    stacked: bool = False
    measures: tuple[Measure, ...] = ()
    postures: tuple[str, ...] = ()

    def under(self, outer: Modifiers) -> Modifiers:
        """These, with what `outer` adds ("a colourful stack of books")."""
        return replace(
            self,
            colours=self.colours or outer.colours,
            palette=self.palette or outer.palette,
            palette_word=self.palette_word or outer.palette_word,
            material=self.material or outer.material,
            material_word=self.material_word or outer.material_word,
            adjectives=(*self.adjectives, *outer.adjectives, *((outer.size_word,) if outer.size_word else ())),
            measures=(*self.measures, *outer.measures),
            postures=(*self.postures, *outer.postures),
        )

    def marked_as(self, other: Modifiers) -> Modifiers:
        """These, with the measures and postures of `other`."""
        return replace(self, measures=(*self.measures, *other.measures), postures=(*self.postures, *other.postures))


NO_MODIFIERS = Modifiers()


def read_modifiers(words: Sequence[str], hidden: Sequence[str] = (), head: str = "") -> Modifiers:
    """Sort modifier `words` of `head`; `hidden` are words of the noun's own name, read for colour and material only."""
    colours: list[str] = []
    adjectives: list[str] = []
    palette_word = material_word = size_word = ""
    material: str | None = None
    scale, stacked = 1.0, False
    measures = tuple(read_measure(word) for word in words if is_measure(word))
    postures = tuple(read_posture(word) for word in words if is_posture(word))
    spread = _spread([word for word in words if not is_marked(word)])
    for index, word in enumerate(spread):
        follower = spread[index + 1] if index + 1 < len(spread) else ""
        before = spread[index - 1] if index else ""
        if word in _COLOURED:
            if before in _UNNAMED:
                # "light-colored": of what colour is not said.
                adjectives.append(f"{before}-{word}")
            elif before in TONES:
                palette_word = before
            elif not find_colour(before) and not palette_word:
                palette_word = "colorful" if before in _MANY or before.endswith("ly") else COLOURED
        elif word in _MIXED:
            palette_word = word
        elif word in ("stacked", "piled"):
            stacked = True
        elif (word in _UNNAMED or word.startswith("different")) and follower in _COLOURED:
            continue
        elif word in lexicon.SHADE_WORDS and (find_colour(follower) or _material(follower)):
            adjectives.append(word)
        elif word in lexicon.SIZES and size_word and (scale > 1) != (lexicon.SIZES[word] > 1):
            # "The big and small pumpkins" are not all of either.
            adjectives.append(word)
        elif word in lexicon.SIZES:
            scale *= lexicon.SIZES[word]
            size_word = size_word or word
        elif _is_purpose(word, follower if follower or hidden else head):
            adjectives.append(word)
        elif (found := _material(word)) and word not in _COLOUR_FIRST:
            material, material_word = found, word
        elif colour := find_colour(word):
            colours.append(lexicon.SHADES.get((before, word), colour))
        else:
            adjectives.append(word)
    for word in hidden:
        if _is_purpose(word, head):
            continue
        if (found := _material(word)) and not material:
            material = found
        elif (colour := find_colour(word)) and not colours:
            colours.append(colour)
    return Modifiers(
        colours=tuple(dict.fromkeys(colours)), palette=(_MIXED | TONES).get(palette_word, ()), material=material,
        palette_word=palette_word, material_word=material_word, scale=min(max(scale, 0.1), 10.0), size_word=size_word,
        adjectives=tuple(adjectives), stacked=stacked, measures=measures, postures=postures,
    )  # fmt: skip


def _spread(words: Sequence[str]) -> list[str]:
    """`words` with hyphenated colours taken apart: "blue-painted" is "blue", "red-and-white" two colours."""
    spread: list[str] = []
    for word in words:
        parts = word.split("-")
        if word in _MIXED or word in lexicon.SIZES or len(parts) == 1:
            spread.append(word)
        elif parts[-1] in _COLOURED:
            known = any(find_colour(part) or part in lexicon.SHADE_WORDS for part in parts[:-1])
            spread += ["colorful"] if parts[0] in _MANY else parts if known else [word]
        elif is_part_colour(word):
            plain = any(find_colour(each) for other in words if other != word for each in other.split("-"))
            own = [part for part in parts if find_colour(part) or part in lexicon.SHADE_WORDS]
            spread += [*(own if not plain and parts[-1] not in _FEATURES else ()), word]
        elif any(find_colour(part) for part in parts):
            spread += [part for part in parts if find_colour(part) or part in lexicon.SHADE_WORDS]
        elif _material(parts[0]) and parts[-1].endswith("ed"):
            spread.append(word)
        else:
            spread.append(word)
    return spread


def _material(word: str) -> str | None:
    return None if word in _NO_ADJECTIVE else find_material(word)


def _is_purpose(word: str, head: str) -> bool:
    """Whether `word` before `head` says what that is for, and not what it is made of: a "paper" clip, a "cream" jug."""
    worked = word in ("paper", "wood", "glass", "fabric", "straw") and head in _WORKED
    return worked or word in _NO_ADJECTIVE or (word, head) in _HELD


def is_colour_word(word: str) -> bool:
    """Whether `word` is a colour, alone or in a hyphenated word."""
    return bool(find_colour(word) and word not in _NO_ADJECTIVE) or (
        "-" in word and any(find_colour(part) for part in word.split("-"))
    )


def is_part_colour(word: str) -> bool:
    """Whether `word` gives the colour of a part: "red-handled"; not "red-painted", which is of the whole."""
    *parts, last = word.split("-")
    whole = last in _WHOLE or last in _COLOURED or find_colour(last) is not None
    return any(find_colour(part) for part in parts) and last.endswith("ed") and not whole


def is_marked(word: str) -> bool:
    """Whether `word` is the text of a token that measures or turns an object."""
    return is_measure(word) or is_posture(word)


def is_modifier(word: str) -> bool:
    """Whether `word` is known to describe rather than name."""
    return (
        is_colour_word(word) or word in _MIXED or word in _COLOURED or word in lexicon.SIZES or word in _ADJECTIVES
        or _material(word) is not None or word in lexicon.SHADE_WORDS or is_marked(word)
    )  # fmt: skip


def looks_like_adjective(word: str) -> bool:
    """Whether `word` has an adjective's ending."""
    return word.endswith(_ENDINGS) and word not in lexicon.NOT_VERBS


def telling(run: Sequence[Token]) -> Modifiers | None:
    """What "first", "top one" or "smallest" tells one of several by; None where the run says anything else."""
    word = run[0].text
    one = len(run) == 2 and run[1].text in ("one", "ones")
    if len(run) > 1 and not one:
        return None
    if word in lexicon.SUPERLATIVES:
        size, scale = lexicon.SUPERLATIVES[word]
        return Modifiers(size_word=size, scale=scale)
    places = lexicon.POSITIONS.keys() if one else TOLD_BY_PLACE
    return Modifiers(adjectives=(word,)) if word in places or word in lexicon.LEVELS.keys() - {"top", "bottom"} or (
        one and word in lexicon.LEVELS
    ) else None  # fmt: skip
