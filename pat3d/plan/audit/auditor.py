"""Compares what a sentence says on its face with its plan; every difference that no note names becomes one."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.text import Claim, Find, Mention, Said, read, singulars
from pat3d.plan.audit.words import ARTICLES, DEEDS, ON_DISHES, PACKETS, POURED, REACHING, REPEATS, SILENT, Place
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.relations import carriers_of

_KINDS: dict[Place, frozenset[str]] = {
    "on": frozenset({"on", "in", "hangs_from", "across", "at_edge", "in_corner", "in_middle", "leaning_against"}),
    "on top": frozenset({"on", "across", "in_middle"}),
    "in": frozenset({"in", "on", "in_corner", "in_middle"}),
    "beside": frozenset({"next_to", "left_of", "right_of", "in_front_of", "behind", "leaning_against", "around",
                         "side_by_side"}),
    "left": frozenset({"left_of"}),
    "right": frozenset({"right_of"}),
    "front": frozenset({"in_front_of"}),
    "behind": frozenset({"behind"}),
    "under": frozenset({"under"}),
    "above": frozenset({"on", "above"}),
    "between": frozenset({"between", "right_of", "left_of", "in_front_of", "behind"}),
    "around": frozenset({"around", "circle"}),
    "far": frozenset({"far_from"}),
    "hanging": frozenset({"hangs_from"}),
    "from": frozenset({"on", "in", "hangs_from", "far_from"}),
    "across": frozenset({"across", "on"}),
}  # fmt: skip
_MIRRORED = {"left_of": "right_of", "right_of": "left_of", "in_front_of": "behind", "behind": "in_front_of",
             "next_to": "next_to", "on": "under", "far_from": "far_from", "side_by_side": "side_by_side"}  # fmt: skip
_DOORS = frozenset({"dresser", "cabinet", "fridge", "refrigerator", "microwave", "oven", "toaster oven", "wardrobe",
                    "dishwasher", "washing machine", "dryer"})  # fmt: skip
"""What things are in when they are in it: to be on it is something else."""
_ASSUMED = re.compile(r"assumed|which is not said|is read as the scene|several tasks")
"""Notes that say how a thing is made, not that it is missing."""
_OF = re.compile(r'^not modelled: (.*) of "[^"]*"$|^("[^"]*") of "[^"]*" is left out|^.*: (there is only one), so')
"""Notes on a word of a phrase, which say nothing of the rest of it."""


def audited(plan: ScenePlan, find: Find, furniture: Collection[str] = ()) -> ScenePlan:
    """`plan` with a note on everything that its prompt says on its face and the plan does not have.

    Args:
        plan: to be compared with its own prompt.
        find: the catalogue noun that a name means, or None.
        furniture: nouns of what stands on the floor by nature, of which nobody says where it is.
    """
    auditor = _Auditor(plan, read(plan.prompt, find), furniture)
    return replace(plan, notes=tuple(dict.fromkeys((*plan.notes, *auditor.differences()))))


def _covered(note: str) -> str:
    """What `note` says is missing or otherwise."""
    found = _OF.match(note)
    return note if found is None else next(part for part in found.groups() if part)


class _Auditor:
    def __init__(self, plan: ScenePlan, said: Said, furniture: Collection[str]) -> None:
        self._furniture = frozenset(furniture)
        self._plan = plan
        self._said = said
        told = [note for note in plan.notes if not _ASSUMED.search(note) and "no task does" not in note]
        self._told = " ".join((*map(_covered, told), *plan.set_aside)).lower()
        self._quoted = " ".join((*plan.notes, *plan.set_aside)).lower()
        self._undone = " ".join(note for note in plan.notes if "no task does" in note).lower()
        self._tasks = " ".join((plan.task or "", *(note for note in plan.notes if "several tasks" in note)))
        self._edges: set[tuple[str, str, str]] = set()
        for rel in plan.relations:
            self._edges.add((rel.child, rel.kind, rel.parent))
        for one in plan.arrangements:
            among = one.of or one.objects
            self._edges |= {(a, one.kind, b) for a in one.objects for b in among if a != b}
        self._edges |= {(b, _MIRRORED[kind], a) for a, kind, b in self._edges if kind in _MIRRORED}
        for obj in plan.objects:
            for above in self._above(obj.name)[1:]:
                self._edges.add((obj.name, "on", above))

    def differences(self) -> list[str]:
        """What the plan lacks or has otherwise, in the order of the prompt."""
        made: list[tuple[int, str]] = []
        for mention in self._said.mentions:
            if find_colour(mention.text) and any(self._has(obj, mention.text) for obj in self._plan.objects):
                continue
            if not mention.owned and not self._of(mention) and not self._named(mention.text):
                made.append((mention.start, f'not in the scene: "{mention.text}"'))
        made += self._miscounted()
        for mention in self._said.mentions:
            for colour in mention.colours:
                own = [obj for obj in self._of(mention) if self._has(obj, colour)]
                if self._of(mention) and not own and not self._named(colour):
                    made.append((mention.start, f'not as said: "{colour}" of "{mention.text}"'))
        for word in self._said.stray:
            if not any(self._has(obj, word) for obj in self._plan.objects) and not self._named(word):
                made.append((self._said.words.index(word), f'not in the scene: "{word}"'))
        made += self._unheard()
        made += [(0, note) for note in (*self._made_as(), *self._astray())]
        for claim in self._said.claims:
            if (note := self._broken(claim)) is not None:
                made.append((claim.at, note))
        return [note for _, note in sorted(made)]

    # Objects

    def _of(self, mention: Mention) -> list[PlannedObject]:
        """The objects that `mention` may name."""
        words = {mention.text, *singulars(mention.text)}
        last = mention.text.split()[-1]
        heads = {last, *singulars(last)}
        return [
            obj for obj in self._plan.objects
            if obj.noun == mention.noun
            or any(re.search(rf"\b{re.escape(word)}\b", obj.phrase.lower()) for word in words)
            or (not mention.new and heads & {obj.noun.split()[-1], obj.name.rstrip(" 0123456789").split()[-1]})
        ]  # fmt: skip

    def _named(self, text: str) -> bool:
        """Whether a note names `text` already."""
        return re.search(rf"\b{re.escape(text)}", self._told) is not None

    def _has(self, obj: PlannedObject, colour: str) -> bool:
        wanted = find_colour(colour) or colour
        own = {find_colour(one) or one for one in obj.colours}
        return wanted in own or colour in (obj.material or "") or any(
            colour in word or wanted in word for word in (*obj.adjectives, obj.noun, obj.name)
        )  # fmt: skip

    def _miscounted(self) -> list[tuple[int, str]]:
        made: list[tuple[int, str]] = []
        nouns: dict[str, list[Mention]] = {}
        for mention in self._said.mentions:
            nouns.setdefault(mention.noun, []).append(mention)
        for noun, mentions in nouns.items():
            counts = {sum(obj.noun == noun for obj in self._plan.objects),
                      len({obj.name for mention in mentions for obj in self._of(mention)})} - {0}  # fmt: skip
            text = mentions[-1].text
            if not counts or any(self._named(said) for said in (noun, *(mention.text for mention in mentions))):
                continue
            least = sum(mention.number or 1 for mention in mentions if mention.new)
            placed = {claim.at for claim in self._said.claims}
            leads = [{one.lead for one in mentions[:at]} for at in range(len(mentions))]
            known = [mention for mention, before in zip(mentions, leads, strict=True)
                     if mention.new or mention.end in placed or mention.lead not in before]  # fmt: skip
            endless = any(mention.plural and mention.number is None for mention in known)
            endless = endless or bool(REPEATS & set(self._said.words)) or self._headless()
            most = max(least, sum(mention.number or 1 for mention in known))
            if not any(least <= count and (endless or count <= most) for count in counts):
                made.append((mentions[-1].start, f'counted otherwise: "{text}", of which there are {min(counts)}'))
        return made

    def _astray(self) -> list[str]:
        """Small things of which nothing says where they are, while others of their sentence are carried."""
        tables = {obj.name for obj in self._plan.objects if obj.noun in self._furniture or obj.noun == "tray"}
        carried = {a for a, kind, b in self._edges if kind in ("on", "in") and b in tables}
        if not carried or self._tasks.strip() or self._undone:
            return []
        related = {name for edge in self._edges for name in (edge[0], edge[2])}
        parts = {mention.part for mention in self._said.mentions for obj in self._of(mention) if obj.name in carried}
        told = {obj.noun for obj in self._plan.objects if obj.name in related}
        astray = [obj for obj in self._plan.objects if obj.noun not in told and obj.noun not in self._furniture]
        astray = [obj for obj in astray if any(
            mention.part in parts for mention in self._said.mentions if obj in self._of(mention)
        )]  # fmt: skip
        return [
            f'"{phrase}": where is not said; on the ground'
            for phrase in dict.fromkeys(obj.phrase for obj in astray)
            if phrase.lower() not in self._told
        ]

    def _headless(self) -> bool:
        """Whether a phrase without a noun ("the two") names objects."""
        return any(obj.phrase and set(obj.phrase.lower().split()) <= ARTICLES for obj in self._plan.objects)

    def _made_as(self) -> list[str]:
        """Objects that are told of in no word of their phrase, and what is poured or spread and made in its bottle."""
        made: list[str] = []
        for obj in self._plan.objects:
            words = {each for word in re.findall(r"[\w']+", obj.phrase.lower()) for each in (word, *singulars(word))}
            name = set(re.findall(r"[a-z']+", obj.name.lower()))
            carriers = carriers_of(obj.name, self._plan.relations)
            dish = any(other.noun in ON_DISHES for other in self._plan.objects if other.name in carriers)
            if words - ARTICLES and not words & (name | REPEATS) and obj.phrase.lower() not in self._quoted:
                made.append(f'"{obj.phrase}" is made as a "{obj.noun}"')
            elif obj.noun in POURED and dish and not words & PACKETS:
                made.append(f'"{obj.phrase}" is made as what it comes in')
        return made

    def _unheard(self) -> list[tuple[int, str]]:
        """Words that are in no name, in no phrase of an object and in no note, and mean something."""
        words = self._said.words
        named = {at for mention in (*self._said.mentions, *self._said.compounds)
                 for at in range(mention.start, mention.end)}  # fmt: skip
        told = [text for obj in self._plan.objects for text in (obj.phrase.lower(), obj.name, *obj.adjectives)]
        phrases = {word for text in told for word in re.findall(r"[\w'-]+", text)}
        materials = {obj.material for obj in self._plan.objects if obj.material}
        asked = self._tasks.strip() or self._undone or "is read as the scene" in self._quoted
        made: list[tuple[int, str]] = []
        for at, word in enumerate(words):
            if at in named or word in phrases or word in SILENT or not word[0].isalpha():
                continue
            if find_colour(word) or find_material(word) in materials:
                continue
            if not re.search(rf"\b{re.escape(word)}\b", self._quoted) and not (asked and word in DEEDS):
                made.append((at, f'not heard: "{word}"'))
        return made

    # Relations

    def _above(self, name: str) -> list[str]:
        """What carries object `name`, what carries that, and so on."""
        path = [name]
        while (below := carriers_of(path[-1], self._plan.relations)[0]) in {obj.name for obj in self._plan.objects}:
            path.append(below)
        return path[1:]

    def _broken(self, claim: Claim) -> str | None:
        """What the plan does not have of `claim`."""
        of = [obj.name for obj in self._of(claim.of)] if claim.of is not None else []
        if claim.of is not None and (not of or self._named(claim.of.text)):
            return None
        asked = claim.of is None and (self._tasks.strip() or self._undone)
        if self._named(claim.said) or claim.said in self._undone or asked or any(name in self._tasks for name in of):
            return None
        turned = any(each.kind == "upside_down" for each in self._plan.postures)
        if (turned and claim.place == "above") or not self._holds(claim, self._here(claim), of):
            return f'not as said: "{claim.said}"'
        whose = {obj.name for obj in self._of(claim.whose)} if claim.whose is not None else set()
        if claim.whose is not None and whose and not self._holds(claim, whose, of):
            return f'"{claim.said}" is not read as said of "{claim.whose.text}"'
        return None

    def _here(self, claim: Claim) -> set[str]:
        """The objects that `claim` may be said of: those named with it, and where it is a pronoun's, before it."""
        words = set(self._said.words)
        reach = bool(words & REACHING) or ":" in words
        named = {obj.name for mention in self._said.mentions for obj in self._of(mention)}
        return {obj.name for obj in self._plan.objects if obj.name not in named} | {
            obj.name
            for mention in self._said.mentions
            if mention is not claim.of and (mention.part == claim.part or reach)
            for obj in self._of(mention)
        }

    def _just_before(self, claim: Claim, names: Sequence[str]) -> bool:
        """Whether `names` are what is named right before `claim`, one after the other or by one plural."""
        before = [mention for mention in self._said.mentions if mention.end <= claim.at]
        near = {obj.name for mention in before[-3:] for obj in self._of(mention)}
        child = {obj.name for mention in self._said.mentions if mention.start > claim.at for obj in self._of(mention)}
        return set(names) <= near and not set(names) & child

    def _holds(self, claim: Claim, here: set[str], of: Sequence[str]) -> bool:
        if claim.place == "with":
            owned = any(mention.end == claim.at for mention in self._said.mentions)
            return not owned or any({a, b} & set(of) and {a, b} & here for a, _, b in self._edges)
        if claim.place == "holding":
            return claim.of is None or any(a in of and b in here and kind in ("on", "in") for a, kind, b in self._edges)
        kinds = set(_KINDS[claim.place])
        if claim.of is None and claim.place == "between":
            return any(one.kind == "between" and self._just_before(claim, one.of) for one in self._plan.arrangements)
        if claim.of is None:
            return any(kind in kinds and {a, b} & here for a, kind, b in self._edges)
        if claim.said.startswith(("on the left", "on the right")):
            kinds |= {"on"}
        if claim.of.noun in _DOORS and claim.place == "in":
            kinds -= {"on"}
        return any(a in here and b in of and kind in kinds for a, kind, b in self._edges)
