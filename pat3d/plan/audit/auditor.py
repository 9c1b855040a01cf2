"""Compares what a sentence says on its face with its plan; every difference that no note names becomes one."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.claims import broken
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.places import for_each, parts, shared_out, unplaced, without
from pat3d.plan.audit.text import Find, Mention, read, singulars
from pat3d.plan.audit.words import ARTICLES, DEEDS, HEADLESS, ON_DISHES, ORDINALS, PACKETS, POURED, REPEATS, SILENT
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.relations import carriers_of


def audited(plan: ScenePlan, find: Find, furniture: Collection[str] = ()) -> ScenePlan:
    """`plan` with a note on everything that its prompt says on its face and the plan does not have.

    Args:
        plan: to be compared with its own prompt.
        find: the catalogue noun that a name means, or None.
        furniture: nouns of what stands on the floor by nature, of which nobody says where it is.
    """
    auditor = _Auditor(plan, read(plan.prompt, find), furniture)
    return replace(plan, notes=tuple(dict.fromkeys((*plan.notes, *auditor.differences()))))


class _Auditor(Compared):
    def differences(self) -> list[str]:
        """What the plan lacks or has otherwise, in the order of the prompt."""
        made: list[tuple[int, str]] = []
        for mention in self.said.mentions:
            if find_colour(mention.text) and any(self.has(obj, mention.text) for obj in self.plan.objects):
                continue
            if not mention.owned and not self.of(mention) and not self.named(mention.text):
                made.append((mention.start, f'not in the scene: "{mention.text}"'))
        made += self._miscounted()
        for mention in self.said.mentions:
            for colour in mention.colours:
                own = [obj for obj in self.of(mention) if self.has(obj, colour)]
                if self.of(mention) and not own and not self.named(colour):
                    made.append((mention.start, f'not as said: "{colour}" of "{mention.text}"'))
        for word in self.said.stray:
            if not any(self.has(obj, word) for obj in self.plan.objects) and not self.named(word):
                made.append((self.said.words.index(word), f'not in the scene: "{word}"'))
        made += self._unheard()
        made += [(0, note) for note in (*self._made_as(), *unplaced(self), *shared_out(self))]
        made += [*for_each(self), *parts(self), *without(self)]
        for claim in self.said.claims:
            if (note := broken(self, claim)) is not None:
                made.append((claim.at, note))
        return [note for _, note in sorted(made)]

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
            placed = {claim.at for claim in self.said.claims}
            leads = [{one.lead for one in mentions[:at]} for at in range(len(mentions))]
            known = [mention for mention, before in zip(mentions, leads, strict=True)
                     if mention.new or mention.end in placed or mention.lead not in before]  # fmt: skip
            endless = any(mention.plural and mention.number is None for mention in known)
            endless = endless or bool((REPEATS | ORDINALS) & set(self.said.words)) or self._headless()
            most = max(least, sum(mention.number or 1 for mention in known))
            if not any(least <= count and (endless or count <= most) for count in counts):
                made.append((mentions[-1].start, f'counted otherwise: "{text}", of which there are {min(counts)}'))
        return made

    def _headless(self) -> bool:
        """Whether a phrase without a noun ("the two") names objects."""
        return any(obj.phrase and set(obj.phrase.lower().split()) <= ARTICLES for obj in self.plan.objects)

    def _made_as(self) -> list[str]:
        """Objects that are told of in no word of their phrase, and what is poured or spread and made in its bottle."""
        made: list[str] = []
        for obj in self.plan.objects:
            words = {each for word in re.findall(r"[\w']+", obj.phrase.lower()) for each in (word, *singulars(word))}
            name = set(re.findall(r"[a-z']+", obj.name.lower()))
            carriers = carriers_of(obj.name, self.plan.relations)
            dish = any(other.noun in ON_DISHES for other in self.plan.objects if other.name in carriers)
            if words - ARTICLES and not words & (name | REPEATS | HEADLESS) and obj.phrase.lower() not in self.quoted:
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
        for at, word in enumerate(words):
            if at in named or word in phrases or word in SILENT or not word[0].isalpha():
                continue
            if find_colour(word) or find_material(word) in materials:
                continue
            if not re.search(rf"\b{re.escape(word)}\b", self.quoted) and not (asked and word in DEEDS):
                made.append((at, f'not heard: "{word}"'))
        return made
