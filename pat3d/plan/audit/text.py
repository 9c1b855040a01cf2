"""What a sentence says on its face: the things it names, how many, in which colour, and the words between them.

Nothing here parses: a mention is a name of the catalogue, a claim is a relation word with the mention behind it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.deeds import is_deed
from pat3d.plan.audit.plainer import plainer
from pat3d.plan.audit.stacks import singulars
from pat3d.plan.audit.words import (
    ADJECTIVES,
    ALIKE_IN_PLURAL,
    ARTICLES,
    BREAKING,
    COMPARING,
    ENDING,
    ENDS,
    GATHERINGS,
    HEADLESS,
    LEADING,
    LONGEST,
    NAMES_BEHIND_ARTICLES,
    NUMBERS,
    OPENING,
    PARTICIPLES,
    PLACING,
    PRONOUNS,
    RELATIONS,
    SHADES,
    SINGLE,
    SOME,
    UNITS,
    UNSURE,
    Place,
)
from pat3d.plan.english import MISSPELLED, NUMBERED

_WORD = re.compile(r"'s|\d+[.]\d+|[^\W_]+(?:['-][^\W_]+)*|[.;!?\n]+|[,:()]")
_FRAMES = frozenset({"scene", "scenario", "setup", "situation", "environment", "image", "simulation", "room", "kitchen",
    "bathroom", "bedroom", "office", "workshop", "garage", "studio", "classroom", "cafe", "lab"})  # fmt: skip
_STOP = re.compile(r"[.;!?\n]+")
_LONGEST_NAME = 4
_HEADS = PRONOUNS | {"another", "other"}
_OF_ONE = frozenset({"a", "an", "one", "each", "every", "another", "this"})
_WHERE = frozenset(
    {"on", "in", "left", "right", "behind", "beside", "next", "near", "between", "under", "by", "at", "to"}
)
_SINGULAR_VERB = ([], ["is"], ["was"], ["in"], ["on"], ["next"], ["beside"], ["."], [","])  # behind the verb "stands"
_ONE = frozenset({"one", "another"})
_KNOWN = frozenset({"the", "these", "those", "both", "all", "other"})
"""Words before what was named already: "the other two cups"."""
_FAR = 7
"""Words from a relation word to its landmark."""

Find = Callable[[str], str | None]
"""The noun of the catalogue that a name means, or None."""


@dataclass(frozen=True, kw_only=True)
class Mention:
    """A name of the catalogue in the sentence."""

    start: int
    end: int
    """Words of the sentence."""
    text: str
    noun: str
    plural: bool
    first: int = 0
    """The word with which its phrase begins: its article, its number or what describes it."""
    number: int | None = None
    """As said: "two", "a"; None where it is not."""
    new: bool = False
    """Whether it is said so that it names something not named before."""
    lead: frozenset[str] = frozenset()
    """What is said before the name to tell it from its like."""
    owned: bool = False
    """Whether it is something's: "its bed" may be a part of that."""
    colours: tuple[str, ...] = ()
    part: int = 0
    """Of the prompt, cut at full stops and semicolons."""


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A relation word, and what stands behind it."""

    place: Place
    said: str
    """With what stands behind it: "on the table"."""
    at: int
    end: int
    """Words of the sentence."""
    of: Mention | None
    """None for a pronoun."""
    part: int
    whose: tuple[Mention, ...] = ()
    """What it is said of, where what stands right before it leaves no other choice: "which", "one of them"."""
    whole: bool = False
    """Whether it is said of all of `whose`: "both", "each"."""


@dataclass(kw_only=True)
class Said:
    """A sentence on its face."""

    words: list[str]
    mentions: list[Mention] = field(default_factory=list)
    compounds: list[Mention] = field(default_factory=list)
    """Names that only say more of the name behind them: the coffee of a coffee table."""
    claims: list[Claim] = field(default_factory=list)
    stray: list[tuple[int, str]] = field(default_factory=list)
    """Colours that no name stands behind, and which words they are."""


def read(prompt: str, find: Find) -> Said:
    """What `prompt` says on its face."""
    prompt = plainer(prompt, find)
    spelled: list[str] = _WORD.findall(re.sub(r"'s(?!\w)", " 's", prompt))
    said = Said(words=[MISSPELLED.get(word, word) for word in spelled])
    parts = _parts(said.words)
    found = _names(said.words, find)
    taken = {at for start, end, *_ in found for at in range(start, end)}
    for index, (start, end, noun, plural) in enumerate(found):
        head = index + 1 == len(found) or found[index + 1][0] != end
        mention = _mention(said.words, start, end, noun, plural, parts[start], taken)
        (said.mentions if head else said.compounds).append(mention)
    told = {at for mention in (*said.mentions, *said.compounds) for at in range(mention.start, mention.end)}
    coloured = {at for mention in said.mentions for at in _before(said.words, mention.start, told)}
    said.stray = [(at, word) for at, word in enumerate(said.words)
                  if find_colour(word) and at not in told and at not in coloured]  # fmt: skip
    said.claims = _claims(said, parts)
    return said


def _parts(words: Sequence[str]) -> list[int]:
    made, part = [], 0
    for word in words:
        made.append(part)
        part += bool(_STOP.fullmatch(word))
    return made


def _names(words: Sequence[str], find: Find) -> list[tuple[int, int, str, bool]]:
    """Start, end, noun and whether it is a plural, of every longest name."""
    made: list[tuple[int, int, str, bool]] = []
    at = 0
    while at < len(words):
        for size in range(min(_LONGEST_NAME, len(words) - at), 0, -1):
            whole = words[at : at + size]
            formed = whole == ["pyramid"] and {*words[at + 1 : at + 2]} & {"of", "made", "built", "with", "from"}
            formed = formed or whole[0] in SHADES or is_deed(words, at)
            if size == 1 and (_unsure(words, at) or _hue(words, at) or formed):
                continue
            if (
                size > 1
                and whole[-1] == "stands"
                and (
                    words[at + size : at + size + 1] in _SINGULAR_VERB
                    or {*words[at - 1 : at]} & _OF_ONE
                    or {*words[at + size : at + size + 1]} & _WHERE
                )
            ):
                # "The cup in which the pen stands is red", "a plant stands there", "the plant stands left of it"
                continue
            name = find(" ".join(whole))
            single = [found for one in singulars(whole[-1]) if (found := find(" ".join([*whole[:-1], one])))]
            if name or single:
                made.append((at, at + size, name or single[0], bool(single) or name in SINGLE))
                at += size - 1
                break
        at += 1
    return made


def _hue(words: Sequence[str], at: int) -> bool:
    """Whether the fruit at word `at` is the first of some colours: "orange, yellow and green blocks"."""
    last = at
    while find_colour(words[last]):
        behind = next((n for n in (last + 2, last + 3) if n < len(words) and find_colour(words[n])
                       and {*words[last + 1 : n]} <= {",", "and"}), 0)  # fmt: skip
        if not behind:
            break
        last = behind
    return last > at and words[last + 1 : last + 2] != [] and words[last + 1][0].isalnum() and words[last + 1] != "and"


def _unsure(words: Sequence[str], at: int) -> bool:
    """Whether word `at` is another word as often as a name, and no article before it makes it one."""
    word = words[at]
    plain = word in NAMES_BEHIND_ARTICLES and words[at - 1 : at] in (["a"], ["the"])
    weighed = word == "lighter" and "heavier" in words
    return weighed or (word in UNSURE and not plain) or any(one in GATHERINGS for one in singulars(word))


def _mention(
    words: Sequence[str], start: int, end: int, noun: str, plural: bool, part: int, taken: set[int]
) -> Mention:
    ahead = _before(words, start, taken)
    colours = tuple(colour for at in ahead if (colour := find_colour(words[at])) and words[at - 1] not in SHADES)
    lead = {words[at] for at in ahead if not (words[at + 1] == "m" or words[at + 1].startswith(UNITS))}
    number = next((NUMBERS[word] for word in lead if word in NUMBERS), None)
    number = next((int(word) for word in lead if word.isdecimal() and len(word) < 4), number)
    if words[end - 1] in NUMBERED and str(number) in lead:
        number = None  # "the 4 block"
    number = 1 if not plural and {"a", "an"} & {*lead, words[min(ahead, default=start) - 1]} else number  # "a 3 door"
    if words[end : end + 1] == ["("] and words[end + 2 : end + 3] == [")"]:
        # "plates (4)"
        said = words[end + 1]
        number = int(said) if said.isdecimal() and len(said) < 4 else NUMBERS.get(said, number)
    if number == 1 and plural and noun not in SINGLE and singulars(words[end - 1]) and "one" in lead:
        # "the left one pencils": the pencils of the left one.
        number = None
    before = max(min(ahead, default=start) - 2, 0)
    gathered = words[end - 1] in ALIKE_IN_PLURAL and number in (None, 1) and "of" in words[max(start - 2, 0) : start]
    comparing = COMPARING & {*lead, *words[before : before + 2]} and "than" in words[before : end + 5]
    if _elliptic(words, ahead) or SOME & lead or gathered or comparing:
        number, plural = None, True
    return Mention(
        start=start, end=end, first=min(ahead, default=start), text=" ".join(words[start:end]), noun=noun,
        plural=plural, number=number,
        new=number is not None and not _KNOWN & {*lead, words[max(min(ahead, default=start) - 1, 0)]},
        lead=frozenset(lead - ARTICLES), owned=bool({"its", "their"} & lead) and "own" not in lead, colours=colours,
        part=part,
    )  # fmt: skip


def _elliptic(words: Sequence[str], ahead: Sequence[int]) -> bool:
    """Whether the noun is said of more than the words before it: "a red and a blue cup"."""
    at = ahead[-1] - 1 if ahead else -1
    return at > 0 and words[at] in ("and", ",") and words[at - 2] not in ("is", "are") and (
        find_colour(words[at - 1]) is not None or words[at - 1] in ADJECTIVES
    )  # fmt: skip


def _before(words: Sequence[str], start: int, taken: set[int]) -> list[int]:
    """The words that lead to the name at `start`, nearest first, up to its article or number."""
    made: list[int] = []
    at = start - 1
    while at >= 0 and at not in taken and not _breaks(words, at):
        made.append(at)
        if words[at] in ARTICLES:
            break
        at -= 1
    if at in taken and find_colour(words[at]) and words[at + 1] not in ("and", ","):
        # An orange plate.
        made += [at, at - 1] if at and words[at - 1] in ARTICLES else [at]
    while made and (words[made[-1]] in (",", "and")):
        made.pop()
    return made


def _breaks(words: Sequence[str], at: int) -> bool:
    word = words[at]
    if word in (",", "and"):
        # "a red and white mug", "a small, red mug", "a white, delicately painted plate"
        sides = words[max(0, at - 1)], words[at + 1] if at + 1 < len(words) else ""
        told = word == "," and sides[1].endswith(("ly", "ed")) and words[at - 2] in ARTICLES
        return not all(find_colour(side) or find_material(side) or side in ADJECTIVES for side in sides[: 2 - told])
    return word in BREAKING or not word[0].isalnum()


def _size(words: Sequence[str], at: int) -> int:
    """How many words the relation phrase at word `at` has: "on the left", but one in "on the left arm of the sofa"."""
    for size in range(LONGEST, 0, -1):
        place = RELATIONS.get(tuple(words[at : at + size]))
        if words[at : at + 2] == ["in", "which"] and words[at - 1] in _FRAMES:
            # "A scene in which a cup is on a table"
            return 0
        after = words[at + size] if at + size < len(words) else ""
        leads_on = after[:1].isalnum() and (after in ("of", "one") or after not in BREAKING | ARTICLES | OPENING)
        if words[at] == "opposite" and words[at - 1] in ARTICLES:
            continue
        upon = words[at : at + size] == ["on", "the", "other"] and words[at - 1] == "one" and "side" not in words[:at]
        behind = words[at + size + 1] if at + size + 1 < len(words) else "."
        # "On the right one a glass", but not "on the right one glass".
        member = after in ("one", "ones") and (not behind[0].isalnum() or behind in ARTICLES | OPENING)
        if place is not None and not (place == "side" and (leads_on or upon or member)):
            return size
    return 0


def _ends(words: Sequence[str], at: int, start: int) -> bool:
    """Whether no landmark stands behind word `at`: "of" leads on to the whole, "on the rim of a cup"."""
    leads = at > start and (
        words[at] == "'s"
        or words[at - 1] in ("a", "an", "the", "'s")
        or (words[at] == "of" and words[at - 1] not in _HEADS)
    )
    return _breaks(words, at) and not (leads and words[at][0].isalnum() | (words[at] == "'s"))


def _claims(said: Said, parts: Sequence[int]) -> list[Claim]:
    made: list[Claim] = []
    words, at = said.words, 0
    starts = {mention.start: mention for mention in (*said.compounds, *said.mentions)}
    while at < len(words):
        size = _size(words, at)
        if not size:
            at += 1
            continue
        place = RELATIONS[tuple(words[at : at + size])]
        if place == "side":
            at += size
            continue
        end, of, alone = at + size, None, 0
        while end < len(words) and end not in starts and end - at - size < _FAR and not _ends(words, end, at + size):
            if end > at + size and words[end - 1] in HEADLESS | _ONE and words[end] in NUMBERS:
                # "on the other a muffin", "on one a bun", "in the blue one two cubes"
                alone = end
                break
            end += 1
        if end in starts:
            of = starts[end]
            while of not in said.mentions:
                of = starts[of.end]
            end = of.end
        after = words[at + size] if at + size < len(words) else ""
        if of is None:
            behind = words[at + size + 1 : at + size + 2]
            if after == "each" and ENDS & {*behind}:
                # "one on each side": which things there are for that is counted.
                at += size
                continue
            headless = behind in (["a"], ["an"], ["the"])
            more = at + size + 1 < len(words)
            counts = more and after == "one" and not headless and not _breaks(words, at + size + 1)
            end = at + size + (after in PRONOUNS and not counts)
            behind = "".join(words[end + 2 : end + 3])
            headless = after == "the" and place != "between" and set(words[end + 1 : end + 2]) & HEADLESS
            if headless and (not behind[:1].isalpha() or behind in ENDING | NUMBERS.keys()):
                end += 2
            end = max(end + (after == "another"), alone)
        if of is not None or end > at + size or place in ("its left", "its right"):
            text = " ".join(words[at:end])
            whose, whole = _whose(said, at)
            made.append(Claim(place=place, said=text, at=at, end=end, of=of, part=parts[at], whose=whose, whole=whole))
        at += size
    return made


def _whose(said: Said, at: int) -> tuple[tuple[Mention, ...], bool]:
    """The names that the relation word at `at` can only be said of, and whether of all of them."""
    words, back = said.words, at - 1
    owner = tuple(mention for mention in said.mentions if mention.end == at)
    if words[at] in PARTICIPLES and owner:
        return owner, False
    while back > 0 and words[back] in LEADING:
        back -= 1
    before = tuple(mention for mention in said.mentions if mention.end <= back)
    if words[back] in ("them", "which") and back > 1 and words[back - 1] == "of":
        # "Three mugs on a tray, two of which hold spoons"
        return before, words[back - 2] in ("both", "all", "each")
    if words[back] in ("former", "latter"):
        pairs = [pair for pair in pairwise(before) if words[pair[0].end : pair[1].first] == ["and"]]
        return (pairs[-1][words[back] == "latter"],) if pairs else (), False
    if words[back] in ("both", "each") and words[back - 1] not in PLACING:
        return before, True
    if back < 1 or words[back] not in ("which", "that"):
        return (), False
    back -= words[back - 1] == ","
    return tuple(mention for mention in said.mentions if mention.end == back), False
