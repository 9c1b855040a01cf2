"""The words between objects, and what they say about who carries, holds or stands beside whom."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.scene_plan import ArrangementKind
from pat3d.scene.relations import RelationKind

Manner = Literal[
    "place", "with", "hold", "flank", "surround", "between", "sides", "gaze", "include", "under", "of", "half", "edge",
    "far", "source", "goal", "than",
]  # fmt: skip

Side = Literal["left", "right", "centre", "back", "front"]


@dataclass(frozen=True, kw_only=True)
class Link:
    """One relation word or phrase."""

    manner: Manner = "place"
    """place: child LINK parent. with, hold, include, of: parent LINK child. The others are named for their words."""
    kind: RelationKind | None = None
    """None where the nouns decide ("with", "holding")."""
    finite: bool = False
    """A verb of the clause: its subject is the clause's."""
    filling: bool = False
    """Read "filled with": a bare plural means many."""
    side: Side | None = None
    """For manner "half": which part of the parent."""
    said: str = ""
    """For manner "than": the comparison, as written; for "half" words that may as well mean beside it; for "edge"
    which; "over" where something may be put over it; "onto" where it is said to come to be on it, and not only "to" it;
    "off" where it was on it, and not in it.
    """
    says: ArrangementKind | None = None
    """What the words say beyond `kind`, which stands in where the layout cannot arrange it."""

    @property
    def inverse(self) -> bool:
        """Whether the objects that follow are the children."""
        return self.manner in ("with", "hold", "include", "of", "flank", "surround")


INSIDE = "inside"
"""What `Link.said` is of what only a thing with an inside has: what it contains."""
OUTSIDE = "outside"
"""What `Link.said` is of what is not in its landmark."""
_BOTH_ENDS = ("either end", "each end", "both ends", "opposite ends", "the ends", "the two ends", "the opposite ends")
_DEPTHS = ("front", "back", "rear", "far", "near", "top", "bottom", "upper", "lower")
WHICH_EDGE = ("left", "right", "outer", *_DEPTHS, "nearest", "farthest",
                 *(f"{one}{join}{other}" for depth in _DEPTHS for side in ("left", "right") for join in (" ", "-")
                   for one, other in ((depth, side), (side, depth))))  # fmt: skip
"""Words before "corner" or "edge", which a scene does not tell apart."""


DRAPED = ("hanging over", "hung over", "draped over", "hanging across", "draped across", "slung across", "slung over")
"""How cloth is on what it hangs down from to both sides."""


def _table() -> dict[tuple[str, ...], Link]:
    links: dict[tuple[str, ...], Link] = {}

    def add(link: Link, *phrases: str) -> None:
        for phrase in phrases:
            links[tuple(phrase.split())] = link

    add(
        Link(kind="on"),
        "on", "atop", "atop of", "on top of", "on top", "upon", "on to", "on the top of", "up on",
    )  # fmt: skip
    add(Link(kind="on", said="over"), "over")
    add(Link(kind="on", says="above"), "above")
    add(Link(kind="in"), "in", "inside", "within", "in the inside of")
    add(
        Link(kind="next_to"),
        "beside", "besides", "alongside of", "next to", "near", "near to", "nearby", "nearby to", "by", "close to",
        "alongside", "adjacent to", "at", "against",
        "in the vicinity of", "in the proximity of",
        "right next to", "to the side of", "on the side of", "on side of", "at the side of", "off to the side of",
        "close by", "with its side to", "across from", "along", "opposite", "opposite to", "among", "amongst",
        "touching",
    )  # fmt: skip
    add(Link(kind="next_to", said=OUTSIDE), "outside", "outside of")
    add(Link(manner="far"), "far from", "far away from", "away from", "furthest from", "farthest from",
        "further from", "farther from",
        "furthest away from", "farthest away from", "further away from", "farther away from")  # fmt: skip
    add(Link(manner="source", kind="on"), "from")
    add(Link(manner="source", kind="on", said="off"), "off", "off of", "from the top of", "from above", "from over",
        "from on top of")  # fmt: skip
    add(Link(manner="source", kind="in"), "out of", "from inside", "from within", "out from")
    add(Link(manner="source", kind="next_to"), "from the base of", "from the foot of", "from beside", "from next to")
    add(Link(manner="goal", kind="on"), "to", "back to", "up to", "over to")
    add(Link(manner="goal", kind="on", said="onto"), "onto", "back onto", "to the top of")
    add(Link(manner="goal", kind="in"), "into", "back into", "inside of")
    add(Link(kind="next_to", manner="goal"), "towards", "toward")
    leaning = ("leaning", "leaned", "leant", "propped", "propped up", "resting", "standing")
    add(Link(kind="next_to", says="leaning_against"), *(f"{word} against" for word in leaning), "leaning on",
        "leaning up against")  # fmt: skip
    add(Link(kind="next_to", says="leaning_against", finite=True), "leans against", "lean against", "leans on",
        "lean on", "rests against", "rest against")  # fmt: skip
    add(Link(kind="on", says="across"), "across", "bridging", "spanning", "straddling", "laid across",
        "lying across", "placed across", "resting across")  # fmt: skip
    add(Link(kind="on", says="across", finite=True), "bridges", "spans", "straddles", "lies across",
        "rests across")  # fmt: skip
    sides: tuple[tuple[Side, RelationKind], ...] = (("left", "left_of"), ("right", "right_of"))
    for side, kind in sides:
        plain = ("to the {} of", "{} of", "{} to", "at the {} of", "to the immediate {} of", "just to the {} of")
        add(Link(kind=kind), *(phrase.format(side) for phrase in plain))
        half = Link(manner="half", side=side, kind=kind)
        add(replace(half, said=f"on the {side} of"), f"on the {side} of")
        add(
            half,
            *(
                f"{word} the {where} of"
                for word in ("on", "at")
                for where in (f"{side} side", f"{side}-hand side", f"far {side}", f"far {side} side")
            ),
        )
        add(half, f"to the {side} side of", f"on {side} of")
    depths: tuple[tuple[Side, RelationKind, tuple[str, ...]], ...] = (
        ("back", "behind", ("back", "rear", "far side", "back side")),
        ("front", "in_front_of", ("front", "near side", "front side")),
    )
    for side, kind, names in depths:
        where = [
            f"{word} the {name} of" for word in ("at", "near", "towards", "toward", "on", "along") for name in names
        ]
        add(Link(manner="half", side=side, kind=kind), *where)
        add(Link(manner="half", side=side, kind=kind, said=f"on the {side} of"), f"on the {side} of")
    add(Link(kind="next_to"), "holding up", "propping up")
    add(Link(kind="next_to", finite=True), "holds up", "hold up", "props up")
    add(Link(kind="left_of"), *(f"{word} one side of" for word in ("on", "to", "at")))
    centre = Link(manner="half", side="centre", kind="on", says="in_middle")
    add(centre, *(f"{word} the {where} of" for word in ("in", "at", "on") for where in ("middle", "center", "centre")))
    add(Link(kind="in_front_of"), "in front of", "in front", "before", "to the front of",
    "in the front of",
        "ahead of")  # fmt: skip
    add(Link(kind="behind"), "hidden by", "hidden behind", "behind", "in back of", "in the back of")
    add(Link(kind="around", finite=True), "surround", "surrounds", "encircle", "encircles")
    add(Link(kind="around"), "around", "all around", "surrounding", "encircling", "circling", "gathered around")
    rings = [f"in a {ring} {word}" for ring in ("circle", "ring") for word in ("around", "surrounding", "round")]
    add(Link(kind="around", says="circle"), *rings, *(f"forming {ring[3:]}" for ring in rings))
    for part in ("edge", "corner", "end", "rim", "border"):
        edge = Link(manner="edge", kind="on", says="in_corner" if part == "corner" else "at_edge")
        told = [
            (which, replace(edge, said=which)) for which in (WHICH_EDGE if part in ("edge", "corner", "end") else ())
        ]
        for near in ("at", "on", "near", "in", "by", "along", "close to"):
            for det in ("the", "a", "one"):
                add(edge, f"{near} {det} {part} of", f"{near} {det} very {part} of")
                for which, one in told:
                    add(one, f"{near} {det} {which} {part} of")
    whichever = ("each", "every", "each of the", "each of the four", "the", "the four", "all four", "all the",
                 "all of the", "all four of the", "opposite", "two")  # fmt: skip
    corners = (f"{near} {which} corner{'' if which in ('each', 'every') else 's'} of"
               for near in ("at", "on", "in") for which in whichever)  # fmt: skip
    add(Link(manner="edge", kind="on", says="in_corners"), *corners)
    add(Link(kind="hangs_from"), "hanging from", "hung from", "suspended from", "dangling from", "hanging off",
        "hung on", "hanging on", "hung off", "hanging down from", "dangling off", "hung up on", "hanging up on",
        "hooked on", "hooked onto", "hooked over")  # fmt: skip
    hanging = ("hangs", "hang", "dangles", "dangle")
    add(Link(kind="hangs_from", finite=True), *(f"{verb} {word}" for verb in hanging for word in ("from", "on", "off")),
        "hang down from", "hangs down from")  # fmt: skip
    for word in DRAPED:
        add(Link(kind="on", said=word), word)
    for verb in ("hangs over", "hang over"):
        add(Link(kind="on", said="hanging over", finite=True), verb)
    add(Link(manner="between", kind="right_of"), "between", "in between")
    add(Link(manner="sides", kind="next_to", said="each"), "on each side of", "at each side of")
    add(Link(manner="sides", kind="next_to"), "on either side of", "on both sides of", "on opposite sides of",
        "at opposite sides of", "on the opposite sides of",
        "at either side of", "on the left and right of", "to the left and right of", "on the left and the right of",
        "to the left and the right of", "at both sides of", "to either side of")  # fmt: skip
    add(Link(manner="sides", kind="on"), *(f"{word} {which} of" for word in ("on", "at") for which in _BOTH_ENDS))
    add(Link(manner="sides", kind="next_to", finite=True), "flank", "flanks")
    add(Link(kind="in", finite=True), "share", "shares")
    add(Link(kind="in", finite=True), "fill", "fills")
    add(Link(kind="on", finite=True), "adorn", "adorns", "occupy", "occupies", "decorates", "graces", "tops")
    add(Link(manner="under", says="under"), "under", "beneath", "below", "underneath", "just beneath")
    add(Link(manner="gaze", says="facing"), "facing", "pointing at", "pointed at", "aimed at", "turned toward",
        "turned towards", "facing toward", "facing towards", "pointing towards", "pointing toward")  # fmt: skip
    add(Link(manner="gaze", says="facing", finite=True), "faces", "points at")
    add(
        Link(manner="gaze"),
        "gazing into", "gazing at", "looking at", "looking into", "looking toward", "looking towards",
        "watching",
        "staring at", "staring into", "gazing toward", "gazing towards", "peering into", "peering at", "studying",
        "reading", "reaching for", "admiring", "eyeing",
    )  # fmt: skip
    add(Link(manner="gaze", finite=True), "gazes into", "gazes at", "looks at", "stares at", "watches")
    add(Link(manner="with"), "with", "featuring", "showing", "including both", "having", "complete with", "adorned by")
    add(Link(manner="with", finite=True), "features", "feature", "has", "have", "shows", "show", "includes", "boasts",
        "displays", "showcases", "depicts")  # fmt: skip
    add(Link(manner="with", kind="on"), "decorated with", "adorned with", "topped with", "topped by", "covered with",
        "occupied by",
        "covered in", "wearing", "set with", "strewn with", "crowned with", "capped with", "decorated by",
        "stacked with", "dotted with", "piled with", "piled high with", "heaped with", "heaped high with",
        "stacked high with", "loaded high with", "littered with", "scattered with", "laid with")  # fmt: skip
    add(Link(manner="with", kind="on", said="over"), "covered by")
    add(Link(manner="with", kind="on", finite=True), "wears")
    add(Link(manner="hold"), "holding", "carrying", "bearing", "supporting", "housing", "laden with",
        "loaded with", "cradling", "hosting", "displaying")  # fmt: skip
    add(Link(manner="hold", finite=True), "holds", "hold", "held", "carries", "carry", "supports",
        "bears", "houses", "support", "hosts")  # fmt: skip
    add(Link(manner="hold", said=INSIDE), "containing")
    add(Link(manner="hold", said=INSIDE, finite=True), "contained", "contains", "contain")
    add(Link(manner="hold", said=INSIDE, filling=True), "filled with", "full of", "filled up with", "brimming with",
        "packed with", "half full of", "half filled with", "half-full of", "half-filled with", "stuffed with",
        "overflowing with")  # fmt: skip
    add(Link(manner="hold", filling=True, finite=True), "overflows with", "overflow with", "brims with", "brim with")
    add(Link(manner="include"), "including", "such as", "namely", "for example", "e.g", "consisting of", "composed of",
        "made up of", "comprising", "like")  # fmt: skip
    add(Link(manner="include", finite=True), "consists of", "consist of", "comprises", "comprise")
    add(Link(manner="flank"), "flanked by", "flanked with", "bordered by", "framed by", "sandwiched between",
        "framed between")  # fmt: skip
    add(Link(manner="surround", kind="around"), "surrounded by", "surrounded with", "encircled by", "ringed by",
        "amid", "amidst", "in the midst of")  # fmt: skip
    add(Link(manner="of"), "of")
    return links


LINKS = _table()
ACROSS = frozenset({("opposite",), ("opposite", "to"), ("across", "from")})
"""Relations over what lies between, of which no scene has more than that both are near."""
LONGEST_LINK = max(map(len, LINKS))
FINITE = lexicon.COPULAS | lexicon.VERBS | {key[0] for key, link in LINKS.items() if link.finite}
"""Verbs of clauses, the first word of each."""

SIDES: dict[tuple[str, ...], str] = {}
for _word in ("on the", "to the", "at the", "from the", "on its", "to its", "at its", "towards the", "toward the"):
    for _side in ("left", "right"):
        for _tail in ("", " side", " hand side", " end", " half"):
            SIDES[tuple(f"{_word} {_side}{_tail}".split())] = _side
            SIDES[tuple(f"{_word} far {_side}{_tail}".split())] = _side
        SIDES[tuple(f"{_word} {_side}-hand side".split())] = _side
for _word in ("on", "at", "to"):
    for _both in ("opposite sides", "both sides", "either side", "each side", "the left and right"):
        SIDES[tuple(f"{_word} {_both}".split())] = "both"
    for _both in _BOTH_ENDS:
        SIDES[tuple(f"{_word} {_both}".split())] = "ends"
for _phrase in ("in the middle", "in the center", "in the centre", "at the center", "at the centre"):
    SIDES[tuple(_phrase.split())] = "centre"
for _phrase in ("on one side", "to one side", "at one side", "on one", "at one end", "on one end"):
    SIDES[tuple(_phrase.split())] = "one"
for _phrase in ("on the other side", "to the other side", "at the other side", "on the other", "on the opposite side",
                "at the other end", "on the other end"):  # fmt: skip
    SIDES[tuple(_phrase.split())] = "other"
"""Places without a landmark ("on the left side"), which only relate objects to each other."""

EACH_OTHER: dict[tuple[str, ...], str] = {
    tuple(words.split()): how
    for how, phrases in {
        "stack": (
            "on top of each other", "on each other", "atop each other", "one on top of the other", "one on another",
            "one on top of another", "on top of one another", "one atop the other", "one atop another", "stacked up",
            "stacked", "piled", "piled up", "in a stack", "in a pile", "in a tower", "in a column", "into a stack",
            "into a tower", "into a pile", "in one stack", "on top of one other", "one above the other",
            "on one another", *(f"nested {within} {other}" for within in ("in", "inside", "within")
                                          for other in ("each other", "one another")),
            "nested one inside the other", "nested one in the other",
        ),
        "row": (
            "in a row", "in a line", "lined up", "in one row", "in a single row", "in a straight line", "into a row",
            "in a single line", "in a horizontal line", "in line", "in one line",
            *(f"in a {how} {line}" for line in ("row", "line")
              for how in ("neat", "tidy", "orderly", "straight", "long", "short", "perfect", "even", "close")),
        ),
        "beside": (
            "next to each other", "beside each other", "near each other", "next to one another", "close together",
        ),
        "side_by_side": ("side by side", "side-by-side"),
        "facing": ("face to face", "face-to-face", "face each other", "face one another"),
        "order": ("from left to right", "left to right", "ordered from left to right"),
        "reverse": ("from right to left", "right to left"),
    }.items()
    for words in phrases
}  # fmt: skip
for _upon in [said for said, how in EACH_OTHER.items() if how == "stack" and {"other", "another"} & {*said}]:
    EACH_OTHER |= {("stacked", *_upon): "stack", ("piled", *_upon): "stack"}
for _line in ("in a row", "in a line", "lined up"):
    for _way, _how in (("from left to right", "order"), ("from right to left", "reverse")):
        EACH_OTHER[tuple(f"{_line} {_way}".split())] = _how
"""Words that arrange the members of one group, or of one list."""
