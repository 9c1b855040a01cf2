"""What a relation word is said of, by what stands right beside it: a second opinion that needs no grammar.

Only where the words between a name and a relation word are of a kind that leaves no choice is anything returned; of
everything else nothing is claimed.
"""

from __future__ import annotations

import re

from pat3d.assets.colours import find_colour
from pat3d.plan.audit.claims import fronted
from pat3d.plan.audit.compared import KINDS, Compared
from pat3d.plan.audit.text import Claim, Mention
from pat3d.plan.audit.words import ARTICLES, BACKWARD, DEEDS, FINITE, FLOOR, HAS, POSED, PRONOUNS, SILENT

_CHECKED = frozenset({"on", "on top", "in", "beside", "left", "right", "front", "behind", "under", "above", "against"})
"""Places of which one thing is said to be at one other."""
_BACKGROUND = FLOOR | {"wall", "ceiling", "window", "windowsill", "room", "background", "foreground", "distance"}
"""What stands around a scene."""
_JOINTS = ARTICLES | {
    "and", ",", "plus", "also", "of", "some", "exactly", "just", "only", "bunch", "pair", "couple", "few", "set", "on",
    "its", "their", "side", "back",
}  # fmt: skip
"""Words that join names to a list of equals: "a glass of water, a bottle on its side and some pears"."""
_CLAUSE = 6
"""Words of a relative clause before the name that it ends with."""


def misattached(it: Compared, claim: Claim, nowhere: str) -> str | None:
    """That the plan has `claim` of something else than of what stands right beside it, as a note; None where not.

    `nowhere` are the notes on what is nowhere.
    """
    asked = it.tasks.strip() or it.undone
    if not asked and (note := _of_something_else(it, claim)):
        return note
    if asked or claim.place not in _CHECKED or claim.whose or it.excused(claim):
        return None
    if fronted(it, claim):
        return None
    back = claim.of is None
    if back and it.said.words[claim.end - 1] not in BACKWARD:
        return None
    everything = {obj.name for obj in it.plan.objects}
    of = everything if claim.of is None else {obj.name for obj in it.which(claim.of)}
    subjects, all_of_them = said_of(it, claim)
    if back and all_of_them:
        subjects = subjects[-1:]
    if not of or any(it.missing(mention) for mention in subjects):
        return None
    named = [{obj.name for obj in it.which(mention)} - (set() if back else of) for mention in subjects]
    kinds = it.kinds(claim) | ({"between"} if "middle of" in claim.said and len(of) > 1 else set())
    held = [any(a in names and b in of and kind in kinds for a, kind, b in it.edges) for names in named]
    for mention, names, holds in reversed(list(zip(subjects, named, held, strict=True))):
        told = any(obj.phrase.lower() in nowhere for obj in it.which(mention))
        if names and not holds and not told and (all_of_them or not any(held)):
            return f'"{claim.said}" is not read as said of "{mention.text}"'
    landmark = any(each.of is subjects[0] and each.place in _CHECKED for each in it.said.claims) if subjects else False
    if back and landmark and len(held) > 1 and not held[0] and any(held):
        # "A cat lies on a rug beside it": the cat, or the rug.
        return f'"{claim.said}" is read as said of "{subjects[held.index(True)].text}"'
    return None


def _of_something_else(it: Compared, claim: Claim) -> str | None:
    """That `claim` is said of what is no object and read as said of one: "its other half on the napkin"."""
    if claim.of is None or claim.place not in _CHECKED or said_of(it, claim)[0] or not (word := _unknown(it, claim)):
        return None
    of = {obj.name for obj in it.which(claim.of)}
    children = [a for a, kind, b in sorted(it.edges) if kind in KINDS[claim.place] and b in of]
    return f'"{word} {claim.said}" is read as said of "{children[0]}"' if children else None


def said_of(it: Compared, claim: Claim) -> tuple[list[Mention], bool]:
    """The names that stand where what `claim` is said of stands, and whether all of them are; none where it is open."""
    words, at = it.said.words, claim.at
    finite = False
    while at > 0 and words[at - 1] in POSED:
        at -= 1
        finite = finite or words[at] in FINITE
    near = _ending(it, at)
    if near is None and words[at - 1 : at] == [","] and {"both", "all"} & {*words[at : claim.at]}:
        # "A bottle and a can, both standing on a shelf"
        near = _ending(it, at - 1)
    if near is None:
        return _behind(it, claim) if at == claim.at else ([], False)
    leading = next((each for each in it.said.claims if each.of is near and each.at < claim.at), None)
    if finite and "which" in words[max(near.first - _CLAUSE, 0) : near.first]:
        # "A box in which there is a ball is under the desk": of the box.
        return [], False
    if leading is None:
        return listed(it, near), finite
    if not finite and (leading.at == 0 or words[leading.at - 1] in (".", ";", "!", "?")):
        # "On the desk next to the clock is a mug": of the desk, or of the mug.
        return [], False
    before, _ = said_of(it, leading)
    # "A cup on a saucer on a table": of the saucer, or of the cup; of the cup where a verb stands between.
    return (before, False) if finite else ([near, *before], False)


def _unknown(it: Compared, claim: Claim) -> str:
    """The word before `claim` that names what no object is: the half of "its other half on the napkin"."""
    words, at = it.said.words, claim.at
    while at > 0 and words[at - 1] in POSED:
        at -= 1
    word = words[at - 1] if at else "."
    phrases = {part for obj in it.plan.objects for part in (*obj.phrase.lower().split(), *obj.adjectives)}
    plain = word in SILENT - {"half"} or word in DEEDS or word in phrases or not word[0].isalpha()
    named = words[at - 2 : at - 1] in (["its"], ["their"], ["other"], ["the"]) and word not in _BACKGROUND
    told = re.search(rf'[" ]{re.escape(word)}[" ]', it.quoted)
    return "" if plain or told or not named or find_colour(word) else word


def _ending(it: Compared, at: int) -> Mention | None:
    """The name that ends at word `at`, or what it is in: the plate of "a plate of cookies"."""
    words = it.said.words
    ends = {each.end: each for each in it.said.mentions}
    mention = ends.get(at)
    if mention is not None and words[mention.first - 1 : mention.first] == ["without"]:
        return ends.get(mention.first - 1)
    start = mention.first if mention is not None else at - 1
    if words[start - 1 : start] == ["of"]:
        whole = ends.get(start - 1)
        return whole if whole is not None and it.which(whole) else mention
    return mention


def _behind(it: Compared, claim: Claim) -> tuple[list[Mention], bool]:
    """What a clause that begins with `claim` tells of: "next to the bed stand a lamp and a chair"."""
    words, at = it.said.words, claim.end
    if claim.at and (words[claim.at - 1][0].isalnum() or words[claim.at - 1] == ",") and words[claim.at - 1] != "while":
        return [], False
    while at < len(words) and words[at] in POSED | {"there", "'s", "we"}:
        at += 1
    first = next((each for each in it.said.mentions if each.first == at and at > claim.end), None)
    if first is None:
        return [], False
    made = [first]
    for mention in (each for each in it.said.mentions if each.start >= first.end):
        between = it.said.words[made[-1].end : mention.first]
        if not {"and", ","} & set(between) or not set(between) <= _JOINTS:
            break
        made.append(mention)
    return made, len(made) == 1


def row_of(it: Compared, last: Mention, further: frozenset[str] = frozenset()) -> list[Mention]:
    """`last` and every name before it that commas, "and" and words of `further` join to it, whatever leads to them."""
    made = [last]
    for mention in reversed([each for each in it.said.mentions if each.end <= last.first]):
        between = it.said.words[mention.end : made[0].first]
        between = between[2:] if between[:1] == ["of"] else between
        if not between or not set(between) <= _JOINTS | further:
            break
        made.insert(0, mention)
    return made


def listed(it: Compared, last: Mention) -> list[Mention]:
    """`last`, and what commas and "and" join to it, nearest last; of what something has, what has it."""
    made = [last]
    for mention in reversed([each for each in it.said.mentions if each.end <= last.first]):
        between = it.said.words[mention.end : made[0].first]
        between = between[2:] if between[:1] == ["of"] else between
        if between[:1] == ["("] and ")" in between:
            # "Four blocks (red, blue) and a bowl"
            between = between[between.index(")") + 1 :]
        if not set(between) <= _JOINTS:
            break
        leading = next((claim for claim in it.said.claims if claim.of is mention), None)
        if leading is not None and it.said.words[leading.at] in HAS and it.said.words[leading.at - 1] not in PRONOUNS:
            # "A tray holds a cup, and a spoon lies on the mat": a clause of its own.
            return made
        if leading is not None:
            owner = _ending(it, leading.at) if leading.place in ("with", "holding") else None
            return [*(listed(it, owner) if owner is not None else ()), *made]
        made.insert(0, mention)
    return made
