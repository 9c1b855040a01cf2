"""A plan beside its sentence: which objects a name speaks of, how they stand, what notes say of them already."""

from __future__ import annotations

import re
from collections.abc import Collection

from pat3d.assets.colours import find_colour
from pat3d.plan.audit.text import Claim, Mention, Said, singulars
from pat3d.plan.audit.words import FALLEN, FARTHEST, HEADLESS, NUMBERS, ORDINALS, PARTS, SHARED, Place
from pat3d.plan.holders import TIER_HEIGHTS, TIER_PARTS
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.arrangements import TIERS
from pat3d.scene.relations import Relation, carriers_of

_MIRRORED = {"left_of": "right_of", "right_of": "left_of", "in_front_of": "behind", "behind": "in_front_of",
             "next_to": "next_to", "on": "under", "under": "over", "far_from": "far_from",
             "side_by_side": "side_by_side"}  # fmt: skip
_MOVED = re.compile(r"(?:place|stack|pick|beside):([^:,.;]+)")
_ASSUMED = re.compile(r"assumed|which is not said|is read as the scene|several tasks")
"""Notes that say how a thing is made, not that it is missing."""
_OF = re.compile(r'^not modelled: (.*) of "[^"]*"$|^("[^"]*") of "[^"]*" is left out|^.*: (there is only one), so')
"""Notes on a word of a phrase, which say nothing of the rest of it."""


_ABSENT = re.compile(r"not (in the scene|understood|modelled|arranged): |.* is left out|.*(which|how many) is not said")
_QUOTED = re.compile(r'"([^"]*)"')
KINDS: dict[Place, frozenset[str]] = {
    "on": frozenset({"on", "in", "over", "hangs_from", "across", "at_edge", "in_corner", "in_corners", "at_ends",
                     "in_middle", "leaning_against"}),
    "on top": frozenset({"on", "across", "in_middle"}),
    "in": frozenset({"in", "on", "in_corner", "in_corners", "in_middle"}),
    "beside": frozenset({"next_to", "left_of", "right_of", "in_front_of", "behind", "leaning_against", "around",
                         "side_by_side"}),
    "against": frozenset({"leaning_against"}),
    "left": frozenset({"left_of"}),
    "right": frozenset({"right_of"}),
    "front": frozenset({"in_front_of"}),
    "behind": frozenset({"behind"}),
    "under": frozenset({"under"}),
    "above": frozenset({"on", "over", "above", "hangs_from"}),
    "between": frozenset({"between", "right_of", "left_of", "in_front_of", "behind"}),
    "around": frozenset({"around", "circle"}),
    "far": frozenset({"far_from"}),
    "hanging": frozenset({"hangs_from"}),
    "from": frozenset({"on", "in", "hangs_from", "far_from"}),
    "across": frozenset({"across", "on", "left_of", "right_of"}),
    "its left": frozenset({"left_of"}),
    "its right": frozenset({"right_of"}),
}  # fmt: skip

_CALLED = re.compile(r'"the (?:[\w-]+ )*([\w-]+)" is read as "([^"]*)"\.')
"""The note of what a word of "the cup" means that was named by another noun before."""
_LENGTH = re.compile(r"(?:^|\d)(?:[mcd]?m|ft|in|inch|inches|feet|foot|(?:centi|milli)?met(?:er|re)s?)$")
"""The last word of a length."""


def _covered(note: str) -> str:
    """What `note` says is missing or otherwise."""
    found = _OF.match(note)
    return note if found is None else next(part for part in found.groups() if part)


class Compared:
    """A plan, what its prompt says on its face, and what the two have to do with each other."""

    def __init__(self, plan: ScenePlan, said: Said, furniture: Collection[str]) -> None:
        """Compare `plan` with `said`; `furniture` are nouns of what stands on the floor by nature."""
        self.furniture = frozenset(furniture)
        self.plan = plan
        self.said = said
        told = [note for note in plan.notes if not _ASSUMED.search(note) and "no task does" not in note]
        self.told = " ".join((*map(_covered, told), *plan.set_aside)).lower()
        self.notes = [_covered(note).lower() for note in told]
        self.absent = [
            quoted
            for note in told
            if _ABSENT.match(note) and "it is placed" not in note
            for quoted in _QUOTED.findall(_covered(note).lower())
        ]
        self.absent += [aside.lower() for aside in plan.set_aside]
        self.quoted = " ".join((*plan.notes, *plan.set_aside)).lower()
        self.undone = " ".join(note for note in plan.notes if "no task does" in note).lower()
        self.tasks = " ".join((plan.task or "", *(note for note in plan.notes if "several tasks" in note)))
        self.moved = {*_MOVED.findall(self.tasks)}
        """What the tasks move."""
        self.called = dict(_CALLED.findall(self.quoted))
        self.edges: set[tuple[str, str, str]] = set()
        for rel in plan.relations:
            self.edges.add((rel.child, rel.kind, rel.parent))
        for one in plan.arrangements:
            among = one.of or one.objects
            self.edges |= {(a, one.kind, b) for a in one.objects for b in among if a != b}
        self.edges |= {(b, _MIRRORED[kind], a) for a, kind, b in self.edges if kind in _MIRRORED}
        for obj in plan.objects:
            for above in self.above(obj.name)[1:]:
                self.edges.add((obj.name, "on", above))

    # Objects

    def of(self, mention: Mention) -> list[PlannedObject]:
        """The objects that `mention` may name."""
        words = {mention.text, *singulars(mention.text)}
        others = {
            one.text
            for one in self.said.mentions
            if one.noun == mention.noun and not words & {one.text, *singulars(one.text)}
        }
        own = [obj for obj in self.plan.objects if obj.phrase.lower().endswith(tuple(words))] if others else []
        if own and any(obj.phrase.lower().endswith(tuple(others)) for obj in self.plan.objects):
            # "A computer next to a laptop", "a hamper and a laundry basket": one noun, two names.
            return own
        last = mention.text.split()[-1]
        called = [obj for obj in self.plan.objects if obj.phrase.lower() == self.called.get(last)]
        if called and not mention.new:
            return called
        heads = {last, *singulars(last)}
        return [
            obj for obj in self.plan.objects
            if obj.noun == mention.noun
            or any(re.search(rf"\b{re.escape(word)}\b", obj.phrase.lower()) for word in words)
            or (mention.text in {one for word in obj.phrase.lower().split() for one in singulars(word)})
            or (not mention.new and heads & {obj.noun.split()[-1], obj.name.rstrip(" 0123456789").split()[-1]})
        ]  # fmt: skip

    @staticmethod
    def headless(obj: PlannedObject) -> bool:
        """Whether the phrase of `obj` has no noun: "the largest", "a short one"."""
        return obj.phrase.lower().split()[-1:] != [] and obj.phrase.lower().split()[-1] in HEADLESS | {"one", "ones"}

    def which(self, mention: Mention) -> list[PlannedObject]:
        """The objects that `mention` may name and that have its colours, where some have; else all that it may name."""
        objects = self.of(mention)
        own = [obj for obj in objects if all(self.has(obj, colour) for colour in mention.colours)]
        return own or objects

    def named(self, text: str) -> bool:
        """Whether a note names `text` already."""
        return re.search(rf"\b{re.escape(text)}", self.told) is not None

    def tiered(self, mention: Mention) -> bool:
        """Whether `mention` is a shelf or a rack of a piece of furniture, on which the plan puts something."""
        return self.tier_at(mention.end - 1)

    def on_tier(self, rel: Relation) -> bool:
        """Whether the plan has the child of `rel` on a tier of its parent, as only words for that have it."""
        told = (one for one in self.plan.arrangements if one.kind in TIERS)
        return rel.supports and any(rel.child in one.objects and rel.parent in one.of for one in told)

    def tier_at(self, at: int) -> bool:
        """Whether the word at `at` is the "shelf" of "the top shelf", where the plan tells tiers of furniture."""
        word, before = "".join(self.said.words[at : at + 1]), self.said.words[max(at - 1, 0)]
        if before not in TIER_HEIGHTS and NUMBERS.get(before, int(before) if before.isdecimal() else 0) < 2:
            return False
        counted = any(adjective.endswith("-tier") for obj in self.plan.objects for adjective in obj.adjectives)
        told = counted or any(one.kind in TIERS for one in self.plan.arrangements)
        return told and bool(TIER_PARTS & {word, *singulars(word)})

    def missing(self, mention: Mention) -> bool:
        """Whether a note says that what `mention` names is not in the scene, or its phrase not understood."""
        return any(re.search(rf"\b{re.escape(mention.text)}", quoted) for quoted in self.absent)

    def excused(self, claim: Claim) -> bool:
        """Whether a note speaks of `claim`: in its own words, or of what it is said of and in which relation."""
        if claim.place in ("holding", "with") and claim.of is not None:
            shelves = [{*one.objects} for one in self.plan.arrangements if one.kind in TIERS]
            if any({obj.name for obj in self.which(claim.of)} <= own for own in shelves):
                return True
        if claim.of is None or self.named(claim.said) or self.missing(claim.of):
            return self.named(claim.said) or claim.of is not None
        words = self.said.words[claim.at : claim.end]
        told = {*words, *(word for kind in KINDS.get(claim.place, ()) for word in kind.split("_"))}
        return any(
            re.search(rf"\b{re.escape(claim.of.text)}", note)
            and told & set(re.findall(r"[a-z']+", _QUOTED.sub(" ", note)))
            for note in self.notes
        )

    def led(self, claim: Claim, words: Collection[str]) -> bool:
        """Whether one of `words` stands right before `claim`."""
        return bool({*self.said.words[max(claim.at - 2, 0) : claim.at]} & {*words})

    def beside_row(self, names: Collection[str]) -> bool:
        """Whether one of `names` stands left or right of a row that it is not in, and so is nearest to an end of it."""
        rows = [one.objects for one in self.plan.arrangements if one.kind == "row"]
        return any(
            kind in ("left_of", "right_of") and a in row and b in names and b not in row
            for row in rows
            for a, kind, b in self.edges
        )

    def ranked_thing(self, at: int) -> bool:
        """Whether word `at` is what a row of unlike things is told by: the object of "the leftmost object"."""
        words = self.said.words
        rank = words[at - 1] in ORDINALS or words[at - 1] in ("leftmost", "rightmost", "last", "middle")
        far = words[at + 1 : at + 4] in (["on", "the", "far"], ["at", "the", "far"]) or bool(
            {*words[at + 1 : at + 2]} & FARTHEST
        )
        nouns = {obj.name: obj.noun for obj in self.plan.objects}
        return (rank or far) and any(
            one.kind == "row" and len({nouns[name] for name in one.objects}) > 1 for one in self.plan.arrangements
        )

    def kinds(self, claim: Claim) -> frozenset[str]:
        """The relations and arrangements of a plan that `claim` may be."""
        kinds = KINDS.get(claim.place, frozenset())
        if claim.place == "beside" and PARTS.keys() & {*self.said.words[claim.at : claim.end]}:
            return kinds | {"at_edge", "at_ends", "in_corner", "on"}
        if "middle" in self.said.words[claim.at : claim.end]:
            return kinds | {"between", "in_middle"}
        if claim.place == "between" and self.led(claim, SHARED):
            return kinds | {"on", "in"}
        if claim.place == "from" and claim.at > 0 and _LENGTH.search(self.said.words[claim.at - 1]):
            return kinds | KINDS["beside"]
        if claim.place == "from" and self.led(claim, FALLEN) and not self.tasks.strip():
            return kinds | KINDS["beside"]
        return kinds

    def has(self, obj: PlannedObject, colour: str) -> bool:
        """Whether `obj` has `colour`, in its name or of its material."""
        wanted = find_colour(colour) or colour
        own = {find_colour(one) or one for one in obj.colours}
        return wanted in own or colour in (obj.material or "") or any(
            colour in word or wanted in word for word in (*obj.adjectives, obj.noun, obj.name)
        )  # fmt: skip

    def support(self, name: str) -> Relation | None:
        """By what object `name` is carried; None on the ground."""
        return next((rel for rel in self.plan.relations if rel.child == name and rel.supports), None)

    def above(self, name: str) -> list[str]:
        """What carries object `name`, what carries that, and so on."""
        path = [name]
        while (below := carriers_of(path[-1], self.plan.relations)[0]) in {obj.name for obj in self.plan.objects}:
            path.append(below)
        return path[1:]
