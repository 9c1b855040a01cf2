"""Whether what opens is open: what has something in it, or is to have it, is; what something is put on is shut."""

from __future__ import annotations

from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.vocabulary import Nouns


def settle(world: World, nouns: Nouns) -> None:
    """Make what holds something, or is to hold it, an open thing: a carton with balls in it is an open box.

    What something is to be put on is shut, though the prompt calls it open: a note says so.
    """
    holders = [edge.parent for edge in world.supports.values() if edge.kind == "in"]
    holders += [item for step in world.steps if step.link and step.link.kind == "in" for item in step.goal]
    for holder in holders:
        group = holder.group
        for closed, opened in (lexicon.OPENED | (lexicon.HOUSES if world.houses(holder) else {})).items():
            noun = nouns.resolve(opened)
            if noun and nouns.own(group.noun) and group.noun == nouns.resolve(closed):
                group.noun = noun
                if closed in lexicon.HOUSES and world.steps:
                    world.note(f'"{group.words}" is made open, as what is in it is reached so.')
    onto = [item for step in world.steps for item in step.goal
            if step.link and (step.link == Link(kind="on") or step.link.said == "onto")]  # fmt: skip
    for group in dict.fromkeys(item.group for item in onto if item not in holders and not item.group.phrase.part):
        for closed in (closed for closed, opened in lexicon.HOUSES.items() if group.noun == nouns.resolve(opened)):
            group.noun = nouns.resolve(closed) or group.noun
            world.note(f'not modelled: "open" of "{group.words}"')
