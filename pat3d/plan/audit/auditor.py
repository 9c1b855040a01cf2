"""Compares what a sentence says on its face with its plan; every difference that no note names becomes one."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.assets.colours import find_colour
from pat3d.plan.audit.adrift import adrift
from pat3d.plan.audit.again import again, between_own, fronted, joined, of_the_counted, one_more
from pat3d.plan.audit.asked import requests
from pat3d.plan.audit.chained import chained
from pat3d.plan.audit.claims import broken
from pat3d.plan.audit.compared import KINDS, Compared
from pat3d.plan.audit.contents import CLOSING, contents
from pat3d.plan.audit.each import for_each, one_each, pairs
from pat3d.plan.audit.identity import confused, side_of
from pat3d.plan.audit.licence import unsaid
from pat3d.plan.audit.listed import apposed, fallen_out, member
from pat3d.plan.audit.matched import matched
from pat3d.plan.audit.meant import meant
from pat3d.plan.audit.members import shares
from pat3d.plan.audit.numbers import choices, had_by_each, listed_colours, numbers, rows, shared_colours, sizes
from pat3d.plan.audit.once import told_once
from pat3d.plan.audit.places import (
    behind_all,
    carried,
    grounded,
    insides,
    middle_ones,
    middles,
    opposite,
    others,
    parts,
    shared_out,
    the_one,
    unplaced,
    without,
)
from pat3d.plan.audit.postured import posed_twice, postured
from pat3d.plan.audit.ranked import ranked
from pat3d.plan.audit.sides import sides
from pat3d.plan.audit.storeys import heights, storeys
from pat3d.plan.audit.subjects import misattached
from pat3d.plan.audit.tallied import tallies
from pat3d.plan.audit.text import Find, Mention, Said, read, singulars
from pat3d.plan.audit.unheard import unheard
from pat3d.plan.audit.unlikely import Cost, unlikely
from pat3d.plan.audit.untried import untried
from pat3d.plan.audit.words import (
    ARTICLES,
    BREAKING,
    EACH,
    ENDS,
    FORMED,
    HEADLESS,
    NUMBERS,
    ON_DISHES,
    ORDINALS,
    PACKETS,
    PIECES,
    PLACING,
    POURED,
    REPEATS,
    SHADES,
    SILENT,
    UNCOUNTED,
    UNSURE,
)
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.relations import carriers_of

_AUDITS = (
    for_each, pairs, one_each, grounded, behind_all, middles, middle_ones, others, parts, the_one, without, requests,
    shares, chained, confused, numbers, rows, choices, sizes, storeys, heights, ranked, matched, shared_colours,
    listed_colours, insides, carried, opposite, contents, meant, postured, sides, again, joined,
    of_the_counted, one_more, fronted, between_own, fallen_out, posed_twice, tallies,
)  # fmt: skip
"""Each yields the words at which a sentence and a plan differ, with the note that says how."""
_REPEATING = REPEATS | ORDINALS | NUMBERS.keys() - {"a", "an"}
_REMARK = re.compile(r'not modelled: "([^"]*)"')
_REMARK_WORDS = 3
_SHARE = 8
"""Words of "one to the left of each"."""
_REACH = 5
"""Words from "a stack" to what it is of."""


def _leads(words: Sequence[str]) -> bool:
    """Whether what stands before a name and `words` is said of the name: "two slices of" bread."""
    return all(word == "of" or (word[0].isalnum() and word not in BREAKING) for word in words)


def _named_so(mention: Mention, before: Sequence[Mention]) -> bool:
    """Whether one of those `before` has the name of `mention`: no hamper is called a laundry basket."""
    named = {name for other in before for name in (other.text, *singulars(other.text))}
    return bool({mention.text, *singulars(mention.text)} & named)


def _without_remarks(plan: ScenePlan) -> str:
    """The prompt without what a note names as a remark that nothing is made of: so it was read."""
    prompt = plan.prompt
    for note in plan.notes:
        found = _REMARK.fullmatch(note)
        if found is None or found[1].count(" ") < _REMARK_WORDS - 1:
            continue
        said = re.escape(found[1])
        prompt = re.sub(rf",\s*{said}\s*,", "", prompt, count=1, flags=re.IGNORECASE)
        before = re.search(rf"(\w+)\s+{said}", prompt, flags=re.IGNORECASE)
        if before is not None and before[1].lower() not in BREAKING:
            prompt = re.sub(rf"\s{said}(?=\W|$)", "", prompt, count=1, flags=re.IGNORECASE)
    return prompt


def audited(
    plan: ScenePlan, find: Find, furniture: Collection[str] = (), cost: Cost = lambda child, kind, parent: 0.0
) -> ScenePlan:
    """`plan` with a note on everything that its prompt says on its face and the plan does not have.

    Args:
        plan: to be compared with its own prompt.
        find: the catalogue noun that a name means, or None.
        furniture: nouns of what stands on the floor by nature, of which nobody says where it is.
        cost: how unlikely it is that a noun is carried so by another.
    """
    said = heard(plan, find)
    auditor = _Auditor(plan, said, furniture)
    found = auditor.differences()
    notes = told_once(auditor, tuple(dict.fromkeys((*plan.notes, *found, *unlikely(auditor, cost, found)))))
    return replace(plan, notes=(*notes, *untried(plan, said, notes)))


def heard(plan: ScenePlan, find: Find) -> Said:
    """What the prompt of `plan` says on its face, without the remarks that a note names; see `audited`."""
    senses = _senses(plan, find)
    return read(_without_remarks(plan), lambda name: find(name) or senses.get(name))


def _senses(plan: ScenePlan, find: Find) -> dict[str, str]:
    """Names that mean something by their company alone, as the plan has them: the computer of a desk."""
    made: dict[str, str] = {}
    for obj in plan.objects:
        phrase, name = obj.phrase.lower().split(), re.sub(r" \d+$", "", obj.name)
        for size in (1, 2):
            said = " ".join(phrase[-size:])
            known = (
                not phrase or phrase[-1] in SILENT | UNSURE | {"toy"} or "of" in said or find(phrase[-1]) is not None
            )
            known = known or any(find(one) is not None for one in singulars(phrase[-1]))
            if len(phrase) >= size and name.split()[-size:] == said.split() and not known:
                made[said] = obj.noun
    return made


class _Auditor(Compared):
    def differences(self) -> list[str]:
        """What the plan lacks or has otherwise, in the order of the prompt."""
        made: list[tuple[int, str]] = []
        for mention in self.said.mentions:
            doubled = self.said.words[mention.start - 1] == mention.text and not mention.plural
            hue = find_colour(mention.text) and any(self.has(obj, mention.text) for obj in self.plan.objects)
            if hue and not (doubled and all(obj.noun != mention.noun for obj in self.plan.objects)):
                continue
            if hue:
                made.append((mention.start, f'not in the scene: "{mention.text}"'))
                continue
            place = any(claim.of is mention and claim.place not in ("with", "holding") for claim in self.said.claims)
            if self._listed(mention) or self.tiered(mention):
                continue
            apart = place or not mention.owned or mention.text in CLOSING
            if apart and not self.of(mention) and not self._is_part(mention):
                made.append((mention.start, f'not in the scene: "{mention.text}"'))
        made += self._miscounted()
        for mention in self.said.mentions:
            for colour in mention.colours:
                own = [obj for obj in self.of(mention) if self.has(obj, colour)]
                if self.of(mention) and not own and not self.named(colour):
                    made.append((mention.start, f'not as said: "{colour}" of "{mention.text}"'))
        for at, word in self.said.stray:
            least, of = self._predicated(at)
            if sum(self.has(obj, word) for obj in of) < least and not self.named(word):
                made.append((at, f'not in the scene: "{word}"' if least == 1 else f'not as said: "{word}" of all'))
        made += unheard(self)
        nowhere = tuple(unplaced(self))
        made += [(0, note) for note in (*self._made_as(), *nowhere, *shared_out(self))]
        for audit in _AUDITS:
            made += audit(self)
        for claim in self.said.claims:
            if (note := broken(self, claim) or misattached(self, claim, " ".join(nowhere).lower())) is not None:
                made.append((claim.at, note))
        found = [note for _, note in sorted(made)]
        found += unsaid(self, found)
        return [*found, *adrift(self, found)]

    def _is_part(self, mention: Mention) -> bool:
        """Whether a note names `mention`, or it is a part of what stands before it: the bed of "a block in its bed"."""
        claim = next((claim for claim in self.said.claims if claim.of is mention), None)
        before = [other for other in self.said.mentions if claim is not None and other.end <= claim.at][-3:]
        if self.named(mention.text):
            return True
        if claim is None or not mention.owned or len(before) < 2:
            return False
        names = [{obj.name for obj in self.which(other)} for other in before]
        return any(a in names[-1] and b in set().union(*names[:-1]) and kind in KINDS.get(claim.place, ())
                   for a, kind, b in self.edges)  # fmt: skip

    def _predicated(self, at: int) -> tuple[int, Collection[PlannedObject]]:
        """Of how many objects the colour at word `at` is said at least, and which may be meant."""
        words = self.said.words[:at]
        while words and (words[-1] in ARTICLES or words[-1] in SHADES):
            words.pop()
        said = self.said.words[len(words) : at]
        several = words[-1:] in (["are"], ["were"]) and ("both" in said or "all" in said)
        landmarks = [claim.of for claim in self.said.claims]
        listed = self.said.words[at + 1 : at + 3]
        if listed[:1] == ["and"] or (listed[:1] == [","] and find_colour(listed[-1])):
            # "The cups are red, yellow and blue."
            return 1, self.plan.objects
        subject = [mention for mention in self.said.mentions
                   if mention.end == len(words) - 1 and mention not in landmarks]  # fmt: skip
        if several or not subject or words[-1:] not in (["is"], ["was"], ["are"], ["were"]):
            return 2 if several else 1, self.plan.objects
        own = self.which(subject[0])
        lead = self.said.words[max(subject[0].first - 3, 0) : subject[0].first]
        lead = [word for word in lead if word != "the"][-2:]
        if lead[1:] == ["of"]:
            # "Half of the eight blocks are red", "two of them"
            return NUMBERS.get(lead[0], 1), own or self.plan.objects
        if words[-1] not in ("are", "were") or "and" in words:
            return 1, own or self.plan.objects
        # "Two cups are red. The other cups are blue."
        told = subject[0].number or int("other" in subject[0].lead) or len(own)
        return min(len(own), told), own or self.plan.objects

    # Objects

    def _miscounted(self) -> list[tuple[int, str]]:
        made: list[tuple[int, str]] = []
        nouns: dict[str, list[Mention]] = {}
        for mention in (one for one in self.said.mentions if not self._listed(one)):
            nouns.setdefault(mention.noun, []).append(mention)
        for noun, mentions in nouns.items():
            counts = {sum(obj.noun == noun for obj in self.plan.objects),
                      len({obj.name for mention in mentions for obj in self.of(mention)})} - {0}  # fmt: skip
            text = mentions[-1].text
            if (
                not counts
                or all(self._packed(mention) for mention in mentions)
                or any(self.named(said) for said in (noun, *(mention.text for mention in mentions)))
            ):
                continue
            texts = {text for mention in mentions for text in (mention.text, *singulars(mention.text))}
            said = sum(obj.noun == noun and any(text in obj.phrase.lower() for text in texts)
                       for obj in self.plan.objects)  # fmt: skip
            counts |= {said} - {0}
            least = sum(
                mention.number or 1
                for mention in mentions
                if mention.new and not self._one_of(mention, mentions) and not apposed(self, mention, mentions)
            )
            least = max(least, *(mention.number or 1 for mention in mentions))
            placed = {claim.at for claim in self.said.claims}
            leads = [{one.lead for one in mentions[:at]} for at in range(len(mentions))]
            known = [
                mention
                for at, (mention, before) in enumerate(zip(mentions, leads, strict=True))
                if mention.new
                or mention.end in placed
                or mention.lead not in before
                or side_of(self, mention)
                or not _named_so(mention, mentions[:at])
            ]
            bare = [mention for mention in mentions if mention.first == mention.start and not mention.plural]
            listed = sum(self.said.words[mention.start - 1] in (",", ":") for mention in bare)
            least = max(least, listed if listed > 1 else 0)
            endless = any(mention.plural and mention.number is None for mention in known)
            endless = endless or self._repeated(mentions) or self._headless()
            endless = endless or any(had_by_each(self, mention) for mention in mentions)
            # "The second crate", where no other is told of
            endless = endless or (len(mentions) == 1 and bool(mentions[0].lead & {*ORDINALS, "first"}))
            # "A candle at both ends", "on all three plates"
            pairs = pairwise(self.said.words)
            endless = endless or any(
                (one == "both" and two in ENDS) or (one in PLACING and two == "all") for one, two in pairs
            )
            members = [mention for mention in known
                       if member(self, mention, mentions) or apposed(self, mention, mentions)]  # fmt: skip
            # "An apple in one and a pear in the other": one of each.
            endless = endless and not any(self.said.words[m.end : m.end + 2] in (["in", "one"], ["on", "one"]) and
                                          m.number == 1 for m in mentions)  # fmt: skip
            most = max(least, sum(mention.number or 1 for mention in known if mention not in members))
            if not any(least <= count and (endless or count <= most) for count in counts):
                made.append((mentions[-1].start, f'counted otherwise: "{text}", of which there are {min(counts)}'))
        return made

    def _one_of(self, mention: Mention, mentions: Sequence[Mention]) -> bool:
        """Whether "a cup", "two cups" may be of those that were named before: the plan says where not.

        "One cup", "every two cups" may be of those of the same sentence, but in a list: "two cups and one cup".
        """
        lead = self.said.words[mention.first - 1 : mention.start]
        single = lead[1:2] in (["one"], ["another"]) and lead[0] != "and"
        before = [other for other in mentions if other.plural and other.start < mention.start]
        before = [other for other in before if single or other.part < mention.part or EACH & {*lead}]
        fewer = any((mention.number or 0) - bool(EACH & {*lead}) < (other.number or 2) for other in before)
        # "Put a pen in every cup: two pens, two cups"
        dealt = bool(self.tasks.strip()) and bool(EACH & {*self.said.words[mention.end : mention.end + 3]})
        return mention.number is not None and (fewer or (dealt and any(other.plural for other in mentions)))

    def _listed(self, mention: Mention) -> bool:
        """Whether what `mention` counts is listed behind it: "three cans: ...", "the tools (a saw and a file)"."""
        words = self.said.words
        if not mention.plural:
            return False
        stop = next((at for at in range(mention.end, len(words)) if words[at] in (":", ".", ";")), len(words))
        behind = words[mention.end : mention.end + 1] == ["("] and ")" in words[mention.end :]
        start, end = mention.end + 1, words.index(")", mention.end) if behind else len(words)
        if not behind and (stop == len(words) or words[stop] != ":" or mention.number is None):
            return False
        if not behind:
            start = stop + 1
            end = next((at for at in range(start, len(words)) if words[at] in (".", ";", ":")), len(words))
        listed = re.split(r" ?, and | ?, | and ", " ".join(words[start:end]))
        heads = [one.split()[-1] for one in listed if one]
        counted = {*words[start:end]} & (NUMBERS.keys() - {"a", "an"})
        alone = not counted and not all(map(find_colour, heads)) and len(heads) > 1
        return alone and not {"one", "ones"} & {*heads} and mention.number in (None, len(heads))

    def _packed(self, mention: Mention) -> bool:
        """Whether what `mention` names is counted in bottles: the soap of "three bottles of soap"."""
        before = self.said.words[max(mention.first - 2, 0) : mention.first]
        return before[1:] == ["of"] and bool({before[0], *singulars(before[0])} & (PACKETS | PIECES | {"bunch"}))

    def _repeated(self, mentions: Sequence[Mention]) -> bool:
        """Whether a word stands there by which there are more of what `mentions` name than their numbers say."""
        words = self.said.words
        leading = {at for mention in self.said.mentions for at in range(mention.first, mention.start)}
        for at, word in enumerate(words):
            after = words[at + 1] if at + 1 < len(words) else "."
            if word not in _REPEATING or (after in ENDS and word not in EACH):
                continue
            near = any(
                at < mention.start <= at + _REACH
                and _leads(words[at + 1 : mention.first])
                and not (mention.number and word in FORMED and words[at - 1] in ("a", "an", "the"))
                for mention in mentions
            )
            if self._shares(at):
                continue
            if word in FORMED and not near:
                # "The book on the stack of four books": a stack of which the number is said.
                continue
            # "three of each" is said of what is named before it, "each has a lid" of what is behind it.
            each = word in EACH | {"both"} and not (words[at - 1] == "of" and not after[0].isalnum())
            if each or (at not in leading and (near or any(mention.start <= at for mention in mentions))):
                return True
        return False

    def _shares(self, at: int) -> bool:
        """Whether word `at` is of ", one in front of each chair": of what is named before, no more of it."""
        words = self.said.words
        start = next((n for n in range(at, max(at - _SHARE, 0), -1) if words[n] == "one" and words[n - 1] == ","), 0)
        told = next((mention for mention in self.said.mentions if start <= mention.start <= at), None)
        return bool(start and EACH & set(words[start : start + _SHARE])) and told is None

    def _headless(self) -> bool:
        """Whether a phrase without a noun ("the two") names objects."""
        return any(obj.phrase and (set(obj.phrase.lower().split()) <= ARTICLES or self.headless(obj))
                   for obj in self.plan.objects)  # fmt: skip

    def _made_as(self) -> list[str]:
        """Objects that are told of in no word of their phrase, and what is poured or spread and made in its bottle."""
        made: list[str] = []
        quoted = " ".join(note for note in self.plan.notes if "no task does" not in note).lower()
        for obj in self.plan.objects:
            words = {each for word in re.findall(r"[\w']+", obj.phrase.lower()) for each in (word, *singulars(word))}
            name = set(re.findall(r"[a-z']+", obj.name.lower()))
            carriers = carriers_of(obj.name, self.plan.relations)
            dish = any(other.noun in ON_DISHES for other in self.plan.objects if other.name in carriers)
            corrected = any(f'"{word}" is read as' in quoted for word in words)
            if (
                words - ARTICLES
                and not corrected
                and not words & (name | REPEATS | HEADLESS)
                and obj.phrase.lower() not in quoted
            ):
                made.append(f'"{obj.phrase}" is made as a "{obj.noun}"')
            elif name & UNCOUNTED and not name & set(obj.noun.split()) and f'"{obj.noun}"' not in quoted:
                # "latte art", "furniture": of what shape is not said.
                made.append(f'"{obj.phrase}" is made as a "{obj.noun}"')
            elif obj.noun in POURED and dish and not words & PACKETS:
                made.append(f'"{obj.phrase}" is made as what it comes in')
        return made
