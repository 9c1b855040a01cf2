"""What a plan decides where its sentence is silent: where things are, which of several are meant.

None of this needs to know how the sentence was read: a plan in which likes stand apart, or in which something is
nowhere while the rest is somewhere, has decided that, and a person is to see it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from pat3d.plan.audit.chained import listed_place
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.text import Mention, singulars
from pat3d.plan.audit.words import (
    ARTICLES,
    CLOSED,
    DEEDS,
    ENDS,
    FINITE,
    FLOOR,
    LEADING,
    OPENING,
    ORDINALS,
    PARTS,
    SPLITTING,
    THINGS,
)
from pat3d.plan.scene_plan import Arrangement, PlannedObject
from pat3d.scene.relations import carriers_of

_LYING = frozenset({"rug", "mat", "carpet", "doormat", "bath mat", "blanket"})
"""On the floor is what is on these too."""
_LEAST = {"other": 2, "others": 2, "another": 2, "second": 2, "third": 3}
"""How many there are at least of what a word without a noun is one of."""
_NEAR = frozenset({"on", "at", "in"})
_SIDES = ("side", "end", "corner", "edge")


def unplaced(it: Compared) -> Iterator[str]:
    """Objects of which nothing says where they are, while what is named with them is somewhere."""
    if it.tasks.strip() or it.undone:
        return
    objects = {obj.name: obj for obj in it.plan.objects}
    carrying = any(b in objects and objects[b].noun in it.furniture and kind in ("on", "in") for _, kind, b in it.edges)
    left: list[PlannedObject] = []
    for part in _connected(it):
        furniture = any(objects[name].noun in it.furniture for name in part)
        own = [objects[name] for name in part if not it.above(name)]
        alone = len({objects[name].noun for name in part}) == 1
        adrift = carrying and not furniture and len(own) == len(part)
        left += [obj for obj in own if adrift or (alone and _mate_is_told(it, obj, part))]
    for one, other in _listed_pairs(it):
        known = {obj.name for obj in left}
        if bool(known & {obj.name for obj in one}) != bool(known & {obj.name for obj in other}):
            # What is listed with what is nowhere and is nowhere itself.
            left += [obj for obj in (*one, *other) if obj.name not in known and not it.above(obj.name)
                     and obj.noun not in it.furniture and not any(b == obj.name for _, _, b in it.edges)]  # fmt: skip
    grounded = _on_the_floor(it)
    for phrase in dict.fromkeys(obj.phrase for obj in left if obj.name not in grounded):
        own, whole = ([obj for obj in objs if obj.phrase == phrase] for objs in (left, it.plan.objects))
        beside = any(rel.parent == obj.name and not rel.supports for rel in it.plan.relations for obj in whole)
        carried = any(set(it.above(obj.name)) - {like.name for like in whole} for obj in whole)
        if phrase.lower() not in it.told and (len(own) == len(whole) or (carried and not beside)):
            some = f"{len(own)} of {len(whole)}: where they are" if len(own) < len(whole) else "where"
            told = listed_place(it, own[0]) if len(own) == len(whole) else ""
            yield f'"{phrase}": {told or f"{some} is not said"}; on the ground'


def _on_the_floor(it: Compared) -> set[str]:
    """What is named in a clause that speaks of the floor."""
    words, made = it.said.words, set[str]()
    for at in (at for at, word in enumerate(words) if word in FLOOR):
        cut = max((n for n in range(at) if words[n] in (".", ";")), default=-1)
        stop = next((n for n in range(at, len(words)) if not words[n][0].isalnum()), len(words))
        made |= {obj.name for mention in it.said.mentions if cut < mention.start < stop for obj in it.which(mention)}
    return made


def _listed_pairs(it: Compared) -> list[tuple[list[PlannedObject], list[PlannedObject]]]:
    """What each two names mean that only "and" or a comma joins, from left to right and back."""
    joined = [
        (it.which(one), it.which(other))
        for one, other in pairwise(it.said.mentions)
        if set(it.said.words[one.end : other.first]) - ARTICLES in ({"and"}, {","}, {"and", ","})
    ]
    return [*joined, *reversed(joined)]


def _mate_is_told(it: Compared, obj: PlannedObject, part: set[str]) -> bool:
    """Whether what is listed with `obj` is related to something that `obj` is not."""
    mentions = it.said.mentions
    for one, other in zip(mentions, mentions[1:], strict=False):
        between = set(it.said.words[one.end : other.start])
        own, mates = (one, other) if obj in it.which(one) else (other, one)
        if not between & {"and", ","} or len(between) > 3 + len(other.lead) or obj not in it.which(own):
            continue
        if obj.noun in it.furniture and not (own is other and "the" in between and _is_landmark(it, mates)):
            # Of what stands on the floor by nature nobody says where it is, but "on the table and the rug".
            continue
        names = {mate.name for mate in it.which(mates)} - part
        if any(a in names and (own is other or (kind != "under" and not it.above(b))) for a, kind, b in it.edges):
            return True
    # Of likes told of one by one, and of what something is said to have.
    likes = [like for like in it.plan.objects if like.noun == obj.noun and like.phrase != obj.phrase]
    if any(not it.above(like.name) for like in likes):
        # "A jar with a spoon in it and an empty jar": where the others are.
        return False
    if obj.noun not in it.furniture and any(_had(it, mention) for mention in mentions if obj in it.which(mention)):
        return True
    return any(it.above(like.name) for like in it.plan.objects if like.phrase == obj.phrase)


def _had(it: Compared, mention: Mention) -> bool:
    """Whether "with" or "holding" stands before `mention` in its clause."""
    claims = [claim for claim in it.said.claims if claim.place in ("with", "holding") and claim.at < mention.start]
    between = it.said.words[claims[-1].at : mention.start] if claims else [","]
    return not any(word in OPENING - {"and"} or not word[0].isalnum() for word in between)


def _is_landmark(it: Compared, mention: Mention) -> bool:
    return any(claim.of is mention for claim in it.said.claims)


def parts(it: Compared) -> Iterator[tuple[int, str]]:
    """Parts of things that something is said to be at, and that the plan takes the whole for."""
    words, kinds = it.said.words, {rel.kind for rel in it.plan.relations} | {one.kind for one in it.plan.arrangements}
    for at, word in enumerate(words[:-1]):
        away = word == "side" and words[at - 1] in ("other", "far", "opposite", "near") and not kinds - {"on", "in"}
        if words[at + 1] != "of" or not (away or (word in PARTS and not kinds & PARTS[word])):
            continue
        whole = next((mention for mention in it.said.mentions if at < mention.start <= at + 5), None)
        inside = word == "bottom" and "on" not in words[max(at - 2, 0) : at] and ("in" in kinds or bool(it.plan.task))
        if whole is not None and it.which(whole) and not inside and not re.search(rf"\b{word}\b", it.quoted):
            yield at, f'not modelled: "{word}" of "{whole.text}"'


def opposite(it: Compared) -> Iterator[tuple[int, str]]:
    """Which of the corners something is in: any one will do for the plan."""
    words = it.said.words
    for at in (at for at in range(1, len(words) - 1) if words[at] in ("opposite", "far", "near")):
        part = words[at + 1] if words[at + 1] in _SIDES else "corner"
        told = words[at - 1] in ("the", "a") and words[at + 1] in ("one", "corner", "edge") and part in words
        cornered = any(one.kind in ("in_corner", "at_edge") for one in it.plan.arrangements)
        if told and cornered and not re.search(rf"\b{words[at]}\b", it.quoted):
            yield at, f'not modelled: "{words[at]}" of "{part}": which of them is left open'


def others(it: Compared) -> Iterator[tuple[int, str]]:
    """What "the other", "another" or "the second" is one of, where there is only one of it."""
    words = it.said.words
    leading = {at for mention in it.said.mentions for at in range(mention.first, mention.end)}
    for at, word in enumerate(words):
        least = _LEAST.get(word, 0)
        follower = words[at + 1] if at + 1 < len(words) else "."
        if not least or at in leading or follower in ENDS or words[at - 1] in ("each", "one", "hand"):
            continue
        led = words[at - 1] in _NEAR if word == "another" else words[at - 1] in ("the", "a") and words[at - 2] in _NEAR
        if led and any(words[n - 1 : n + 1] == ["one", part] for n in range(1, at) for part in _SIDES):
            # "A lamp on one side of the bed and a clock on the other"
            continue
        before = [mention for mention in it.said.mentions if mention.end <= at]
        ones = [mention for mention in before if "one" in it.said.words[mention.first : mention.start]]
        named = ones[-1:] if word in ("other", "others") and ones else before
        kinds = [{_called(obj) for obj in it.which(mention)} for mention in named]
        likes = [[obj for obj in it.plan.objects if _called(obj) in names] for names in kinds]
        if word in ORDINALS and (_listed_first(it) >= least or (follower in THINGS and it.ranked_thing(at + 1))):
            # "A cup and a bowl: the second is red"
            continue
        if named and max(map(len, likes)) < least and not re.search(rf"\b{word}\b", it.quoted):
            yield at, f'not as said: "{" ".join(words[max(at - 1, 0) : at + 1])}"; there is one "{named[-1].text}"'


def _listed_first(it: Compared) -> int:
    """How many single things the sentence begins with, joined to a list."""
    count = 0
    for before, mention in pairwise(it.said.mentions):
        if mention.plural or before.plural or not set(it.said.words[before.end : mention.first]) <= {",", "and"}:
            break
        count += 1
    return count + 1


def _called(obj: PlannedObject) -> str:
    """What `obj` is called by: a bowl with fruit is made as a fruit bowl, and is a bowl."""
    return obj.name.rstrip(" 0123456789").split()[-1]


def insides(it: Compared) -> Iterator[tuple[int, str]]:
    """What is said to be in something closed, or taken out of it, and is placed on it."""
    words = it.said.words
    for at, word in enumerate(words):
        led = {"in", "inside", "into", "from", "out", "within"} & set(words[max(at - 4, 0) : at])
        holds = {"holds", "hold", "holding", "contains", "contain", "containing", "full", "filled"} & set(
            words[at + 1 : at + 5]
        )
        # "Take the cells out of the torch": what is no vessel holds nothing.
        out = any(
            mention.end == at + 1
            and words[mention.first - 2 : mention.first] == ["out", "of"]
            and word not in ("shelf", "bookshelf", "rack")
            for mention in it.said.mentions
        )
        if not (out or {word, *singulars(word)} & CLOSED) or not (led or holds):
            continue
        of = {obj.name for obj in it.plan.objects if word in (*obj.phrase.lower().split(), *obj.name.split())}
        above = [rel for rel in it.plan.relations if rel.kind == "on" and rel.parent in of]
        if above and not any(kind == "in" and b in of for _, kind, b in it.edges) and 'inside "' not in it.quoted:
            yield at, f'not arranged: "{above[0].child}" inside "{word}"; it is placed on it'


def carried(it: Compared) -> Iterator[tuple[int, str]]:
    """Where "it" is carried to: in the scene before the task it is not there yet, and it is one thing."""
    words = it.said.words
    for at in (at for at in range(1, len(words)) if words[at] == "it" and words[at - 1] in DEEDS):
        goal = next((mention for mention in it.said.mentions if words[at + 1 : mention.first] == ["to"]), None)
        if goal is None:
            continue
        names = {obj.name for obj in it.which(goal)}
        there = any(rel.supports and rel.parent in names for rel in it.plan.relations)
        claimed = any(claim.of is not None and claim.of.noun == goal.noun for claim in it.said.claims)
        moved = {child for child, to in re.findall(r"place:([^:,]+):([^:,.]+)", it.tasks) if to in names}
        if len(moved) > 1 or (there and not claimed):
            yield at, f'not as said: "{" ".join(words[at - 1 : goal.end])}"'


def the_one(it: Compared) -> Iterator[tuple[int, str]]:
    """What "the one" tells from its like in a clause of its own, where there is no like of it."""
    words = it.said.words
    for at in (at for at in range(2, len(words)) if words[at - 1 : at + 1] == ["the", "one"]):
        stop = words[at - 2]
        cut = max((n for n in range(at - 2) if not words[n][0].isalnum()), default=-1)
        clauses = words[cut + 1 : at - 2], words[at:]
        ends = stop in (";", ".", "while") or (stop == "," and all(FINITE & set(clause) for clause in clauses))
        before = [mention for mention in it.said.mentions if mention.end < at]
        nouns = {mention.noun for mention in before}
        if ends and before and max(sum(obj.noun == noun for obj in it.plan.objects) for noun in nouns) == 1:
            yield at, f'not as said: "{" ".join(words[at - 1 : at + 4])}"; there is one "{before[0].text}"'


def middles(it: Compared) -> Iterator[tuple[int, str]]:
    """What is said to be in the middle and is neither there, nor between others, nor in the middle of a row."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word in ("middle", "centre", "center")):
        start = next((mention for mention in it.said.mentions if mention.end == at - 2), None)
        if words[at - 2 : at] != ["in", "the"] or words[at + 1 : at + 2] == ["of"] or start is None:
            continue
        if any(mention.first <= at < mention.end for mention in it.said.mentions):
            # "the fork in the middle drawer"
            continue
        own = {obj.name for obj in it.which(start)}
        rows = [one for one in it.plan.arrangements if one.kind == "row" and own & set(one.objects)]
        held = {name for one in rows or it.plan.arrangements for name in _middle(one)}
        held |= {name for name in own for kind in ("left_of", "in_front_of") if not rows
                 and any(b == name and k == kind for _, k, b in it.edges)
                 and any(a == name and k == kind for a, k, _ in it.edges)}  # fmt: skip
        owners = {name for one in it.plan.arrangements if own & set(one.objects) for name in one.of}
        told = [mention.start for obj in it.plan.objects if obj.name in owners
                for mention in it.said.mentions if mention.noun == obj.noun]  # fmt: skip
        late = bool(told) and min(told) > at
        held |= {name for name in own if it.above(name) and any(name in it.above(obj.name) for obj in it.plan.objects)}
        if own and (late or not held & own) and words[at] not in it.quoted:
            yield at, f'not as said: "in the {words[at]}" of "{start.text}"'


def middle_ones(it: Compared) -> Iterator[tuple[int, str]]:
    """The middle one of three that are told by their sides, which stands between the others."""
    sides = {side: [one for one in it.said.mentions if side in one.lead] for side in ("left", "middle", "right")}
    if not all(sides.values()) or len({one.noun for each in sides.values() for one in each}) > 1:
        return
    for mention in sides["middle"]:
        own = {obj.name for obj in it.of(mention)}
        rows = any(one.kind in ("row", "between") and own & {*one.objects} for one in it.plan.arrangements)
        between = [
            obj for obj in it.of(mention) if {k for a, k, _ in it.edges if a == obj.name} >= {"left_of", "right_of"}
        ]
        if own and not rows and not between and "middle" not in it.quoted:
            yield mention.start, f'not arranged: "the middle {mention.text}" between the others'


def behind_all(it: Compared) -> Iterator[tuple[int, str]]:
    """What is said to be in the background and is carried by something."""
    words = it.said.words
    for at in range(1, len(words) - 2):
        far = words[at : at + 2] == ["in", "the"] and words[at + 2] in ("background", "foreground", "distance")
        before = [mention for mention in it.said.mentions if mention.end <= at][-2:]
        # "a glass of wine in the background": of the glass
        told = [mention for mention in before if mention.end == at or words[mention.end : mention.end + 1] == ["of"]]
        if far and told and any(it.above(obj.name) for mention in told for obj in it.which(mention)):
            yield at, f'not as said: "{" ".join(words[at : at + 3])}" of "{told[0].text}"'


def grounded(it: Compared) -> Iterator[tuple[int, str]]:
    """What is said to be on the floor and is carried by something."""
    words = it.said.words
    for at in (
        at for at, word in enumerate(words) if word in ("floor", "ground") and words[at - 2 : at] == ["on", "the"]
    ):
        start = at - 2
        while start > 0 and words[start - 1] in LEADING:
            start -= 1
        said = next((mention for mention in it.said.mentions if mention.end == start), None)
        nouns = {obj.name: obj.noun for obj in it.plan.objects}
        if said is None or not (own := it.which(said)):
            continue
        if all({nouns[name] for name in it.above(obj.name)} - _LYING for obj in own):
            yield at, f'not as said: "on the {words[at]}" of "{said.text}"'


def _middle(one: Arrangement) -> Sequence[str]:
    if one.kind == "row":
        return one.objects[(len(one.objects) - 1) // 2 : len(one.objects) // 2 + 1]
    return one.objects if one.kind in ("between", "in_middle") else ()


def _connected(it: Compared) -> list[set[str]]:
    """The objects that relations join, in the order of the plan."""
    parts: list[set[str]] = []
    for obj in it.plan.objects:
        near = {obj.name} | {b for a, _, b in it.edges if a == obj.name} | {a for a, _, b in it.edges if b == obj.name}
        touched = [part for part in parts if part & near]
        parts = [part for part in parts if not part & near] + [near.union(*touched)]
    return [part & {obj.name for obj in it.plan.objects} for part in parts]


def shared_out(it: Compared) -> Iterator[str]:
    """Likes that stand on different things though the sentence tells them by no word from one another."""
    if set(it.said.words) & SPLITTING:
        return
    for phrase in dict.fromkeys(obj.phrase for obj in it.plan.objects):
        names = [obj.name for obj in it.plan.objects if obj.phrase == phrase]
        nouns = {obj.name: obj.noun for obj in it.plan.objects}
        carriers = [carriers_of(name, it.plan.relations)[0] for name in names]
        kinds = {nouns.get(carrier, "the ground") for carrier in carriers if carrier not in names}
        if len(kinds) > 1 and phrase.lower() not in it.told:
            where = " and ".join(f'"{kind}"' for kind in sorted(kinds))
            yield f'"{phrase}" are shared out among {where}; who is where is not said'


def without(it: Compared) -> Iterator[tuple[int, str]]:
    """What is said to be without something that all there are of its kind have."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "without"):
        owner = next((mention for mention in it.said.mentions if mention.end == at), None)
        lacking = next((mention for mention in it.said.mentions if at < mention.start <= at + 3), None)
        if lacking is None:
            owned = [claim.of for claim in it.said.claims if claim.place in ("with", "holding") and claim.at < at]
            lacking = owned[-1] if owned else None
        if owner is None or lacking is None or not it.which(lacking):
            continue
        have = {b for a in it.which(lacking) for b in it.above(a.name)}
        if all(obj.name in have for obj in it.which(owner)):
            what = lacking.text if at < lacking.start else words[at + 1] if words[at + 1 : at + 2] == ["one"] else ""
            yield at, f'not as said: "{f"without {what}".strip()}" of "{owner.text}"'
