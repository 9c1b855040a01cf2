"""Compares what a sentence says on its face with its plan; every difference that no note names becomes one."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.claims import broken
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.identity import confused
from pat3d.plan.audit.licence import unsaid
from pat3d.plan.audit.numbers import choices, had_by_each, listed_colours, numbers, rows, shared_colours, sizes, storeys
from pat3d.plan.audit.places import (
    behind_all,
    carried,
    for_each,
    grounded,
    insides,
    middles,
    on_the_other,
    others,
    parts,
    shared_out,
    the_one,
    unplaced,
    without,
)
from pat3d.plan.audit.subjects import misattached
from pat3d.plan.audit.text import Find, Mention, read, singulars
from pat3d.plan.audit.words import (
    ARTICLES,
    BREAKING,
    DEEDS,
    EACH,
    ENDS,
    FORMED,
    HEADLESS,
    NUMBERS,
    ON_DISHES,
    ORDINALS,
    PACKETS,
    POURED,
    REPEATS,
    SHADES,
    SILENT,
    UNCOUNTED,
)
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.arrangements import crossing
from pat3d.scene.relations import carriers_of

_OF_SEVERAL = ARTICLES | HEADLESS | FORMED | {"from", "in", "of", "line", "tower", "column"}
"""Words from "the third book" to what it is one of."""
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


def audited(plan: ScenePlan, find: Find, furniture: Collection[str] = ()) -> ScenePlan:
    """`plan` with a note on everything that its prompt says on its face and the plan does not have.

    Args:
        plan: to be compared with its own prompt.
        find: the catalogue noun that a name means, or None.
        furniture: nouns of what stands on the floor by nature, of which nobody says where it is.
    """
    auditor = _Auditor(plan, read(_without_remarks(plan), find), furniture)
    return replace(plan, notes=tuple(dict.fromkeys((*plan.notes, *auditor.differences()))))


def _shapes(it: Compared) -> frozenset[str]:
    """Words for how things stand that the plan has."""
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    stacked = any(rel.kind == "on" and nouns[rel.child] == nouns.get(rel.parent) for rel in it.plan.relations)
    round_about = {one.kind for one in it.plan.arrangements} & {"circle", "around"}
    lying = any(one.kind == "on_its_side" for one in it.plan.postures)
    heaped = any(len(carriers_of(name, it.plan.relations)) > 1 for name in nouns)
    return (
        frozenset({"pyramid"} if heaped else ())
        | frozenset({"grid"} if crossing([one.objects for one in it.plan.arrangements if one.kind == "row"]) else ())
        | frozenset({"tower", "towers", "piles"} if stacked else ())
        | frozenset({"circle", "ring"} if round_about else ())
        | frozenset({"flat"} if lying else ())
    )


class _Auditor(Compared):
    def differences(self) -> list[str]:
        """What the plan lacks or has otherwise, in the order of the prompt."""
        made: list[tuple[int, str]] = []
        for mention in self.said.mentions:
            if find_colour(mention.text) and any(self.has(obj, mention.text) for obj in self.plan.objects):
                continue
            place = any(claim.of is mention and claim.place not in ("with", "holding") for claim in self.said.claims)
            if (place or not mention.owned) and not self.of(mention) and not self.named(mention.text):
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
        made += self._unheard()
        nowhere = tuple(unplaced(self))
        made += [(0, note) for note in (*self._made_as(), *nowhere, *shared_out(self))]
        made += [
            *for_each(self),
            *grounded(self),
            *behind_all(self),
            *middles(self),
            *others(self),
            *parts(self),
            *the_one(self),
            *without(self),
        ]
        made += [*confused(self), *numbers(self), *rows(self), *choices(self), *sizes(self), *storeys(self)]
        made += [*shared_colours(self), *listed_colours(self), *insides(self), *carried(self), *on_the_other(self)]
        for claim in self.said.claims:
            if (note := broken(self, claim) or misattached(self, claim, " ".join(nowhere).lower())) is not None:
                made.append((claim.at, note))
        found = [note for _, note in sorted(made)]
        return [*found, *unsaid(self, found)]

    def _predicated(self, at: int) -> tuple[int, Collection[PlannedObject]]:
        """Of how many objects the colour at word `at` is said at least, and which may be meant."""
        words = self.said.words[:at]
        while words and (words[-1] in ARTICLES or words[-1] in SHADES):
            words.pop()
        said = self.said.words[len(words) : at]
        several = words[-1:] in (["are"], ["were"]) and ("both" in said or "all" in said)
        landmarks = [claim.of for claim in self.said.claims]
        subject = [mention for mention in self.said.mentions
                   if mention.end == len(words) - 1 and mention not in landmarks]  # fmt: skip
        if several or not subject or words[-1:] not in (["is"], ["was"], ["are"], ["were"]):
            return 2 if several else 1, self.plan.objects
        own, all_of_them = self.which(subject[0]), words[-1] in ("are", "were") and "and" not in words
        least = min(len(own), self._told(subject[0]) or len(own)) if all_of_them else 1
        return least, own or self.plan.objects

    def _told(self, subject: Mention) -> int:
        """How many of `subject` are spoken of at least: "two of the four cups", "the other cups"; 0 for all."""
        before = self.said.words[max(subject.first - 3, 0) : subject.first]
        share = NUMBERS.get(before[0], 0) if before[1:] == ["of", "the"] else 0
        return share or subject.number or int("other" in subject.lead)

    # Objects

    def _miscounted(self) -> list[tuple[int, str]]:
        made: list[tuple[int, str]] = []
        nouns: dict[str, list[Mention]] = {}
        for mention in self.said.mentions:
            nouns.setdefault(mention.noun, []).append(mention)
        for noun, mentions in nouns.items():
            counts = {sum(obj.noun == noun for obj in self.plan.objects),
                      len({obj.name for mention in mentions for obj in self.of(mention)})} - {0}  # fmt: skip
            text = mentions[-1].text
            if not counts or any(self.named(said) for said in (noun, *(mention.text for mention in mentions))):
                continue
            least = sum(mention.number or 1 for mention in mentions if mention.new)
            least = max(least, *(mention.number or 1 for mention in mentions))
            placed = {claim.at for claim in self.said.claims}
            leads = [{one.lead for one in mentions[:at]} for at in range(len(mentions))]
            known = [mention for mention, before in zip(mentions, leads, strict=True)
                     if mention.new or mention.end in placed or mention.lead not in before
                     or not _named_so(mention, mentions[: mentions.index(mention)])]  # fmt: skip
            bare = [mention for mention in mentions if mention.first == mention.start and not mention.plural]
            listed = sum(self.said.words[mention.start - 1] in (",", ":") for mention in bare)
            least = max(least, listed if listed > 1 else 0)
            endless = any(mention.plural and mention.number is None for mention in known)
            endless = endless or self._repeated(mentions) or self._headless()
            endless = endless or any(had_by_each(self, mention) for mention in mentions)
            members = [mention for mention in known if self._member(mention, mentions)]
            # "An apple in one and a pear in the other": one of each.
            endless = endless and not any(self.said.words[m.end : m.end + 2] in (["in", "one"], ["on", "one"]) and
                                          m.number == 1 for m in mentions)  # fmt: skip
            most = max(least, sum(mention.number or 1 for mention in known if mention not in members))
            if not any(least <= count and (endless or count <= most) for count in counts):
                made.append((mentions[-1].start, f'counted otherwise: "{text}", of which there are {min(counts)}'))
        return made

    def _member(self, mention: Mention, mentions: Sequence[Mention]) -> bool:
        """Whether `mention` is one of those that stand behind it: "the third book in a row of five books"."""
        words = self.said.words
        behind = next((other for other in mentions if other.start >= mention.end and (other.number or 1) > 1), None)
        if behind is None or mention.number is not None or not mention.lead & (HEADLESS | ORDINALS):
            return False
        between = words[mention.end : behind.first]
        return "of" in between and set(between) <= _OF_SEVERAL

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

    def _halved(self) -> bool:
        """Whether half of some likes are told from the others by their colour, their posture or what they are on."""
        turned = {one.object for one in self.plan.postures}
        for mention in self.said.mentions:
            names = [obj.name for obj in self.of(mention)]
            for one in ((obj.colours, obj.name in turned, self.above(obj.name)[:1]) for obj in self.of(mention)):
                same = sum(
                    (obj.colours, obj.name in turned, self.above(obj.name)[:1]) == one for obj in self.of(mention)
                )
                if 0 < same * 2 == len(names):
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

    def _unheard(self) -> list[tuple[int, str]]:
        """Words that are in no name, in no phrase of an object and in no note, and mean something."""
        words = self.said.words
        named = {at for mention in (*self.said.mentions, *self.said.compounds)
                 for at in range(mention.start, mention.end)}  # fmt: skip
        told = [text for obj in self.plan.objects for text in (obj.phrase.lower(), obj.name, *obj.adjectives)]
        phrases = {word for text in told for word in re.findall(r"[\w'-]+", text)}
        materials = {obj.material for obj in self.plan.objects if obj.material}
        asked = self.tasks.strip() or self.undone or "is read as the scene" in self.quoted
        made: list[tuple[int, str]] = []
        shapes = _shapes(self)
        for at, word in enumerate(words):
            if (
                at in named
                or phrases & {word, word.removesuffix("er"), word.removesuffix("est"), word[:-3], word[:-4]}
                or word in shapes
                or word in SILENT
                or not word[0].isalpha()
            ):
                continue
            if find_colour(word) or find_material(word) in materials or (word == "half" and self._halved()):
                continue
            if not re.search(rf"\b{re.escape(word)}\b", self.quoted) and not (asked and word in DEEDS):
                made.append((at, f'not heard: "{word}"'))
        return made
