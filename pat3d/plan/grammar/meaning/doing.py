"""What an instruction asks for: the steps of a task, and the scene as it is before them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.meaning.account import holds_already, learned
from pat3d.plan.grammar.meaning.attached import beside_each_other, fits, has_room
from pat3d.plan.grammar.meaning.contradictions import refuse_goal
from pat3d.plan.grammar.meaning.counting import multiply
from pat3d.plan.grammar.meaning.distribution import share
from pat3d.plan.grammar.meaning.entities import Item, Step
from pat3d.plan.grammar.meaning.everything import Everything
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.same_colour import by_colour
from pat3d.plan.grammar.meaning.tiers import put_on_tier, tier_of
from pat3d.plan.grammar.meaning.undone import turn_as_found, unstacks
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.rewriting.instructions import SHUTTING, Clause
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import Link
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_SLIDING = frozenset({"slide", "push", "drag", "pull", "nudge", "shove", "shift", "roll", "sweep"})
"""Verbs that leave a thing on what it is on."""
_TAKING_OUT = frozenset({"remove", "get", "take", "retrieve", "grab", "fetch", "pick", "move", "bring", "transfer"})
_SIDEWAYS = re.compile(r"\bto the (?:left|right)(?: (?:on|along|across|over|and|then|by)\b|[,.;]|$)")
_OWN = re.compile(r"\b(?:its|their) own\b|\bof (?:its|their) own\b", re.IGNORECASE)
_STRUCTURES = frozenset({"window", "windows", "windowsill", "sill", "ledge", "wall", "walls", "ceiling", "door",
    "doorway", "corner", "corners", "curtain", "curtains", "wallpaper", "fence", "railing", "entrance",
    "palette"})  # fmt: skip
"""What is never made, though things are said to be on it and in it as well as by it."""
_PARTS = lexicon.ENDS | {"back", "rear", "front", "middle", "center", "centre"}  # of what a thing is slid along


class Doing(Everything):
    """Adds steps to the world."""

    def __init__(self, world: World, chunks: Sequence[Chunk], maker: Maker, clause: Clause) -> None:
        super().__init__(world, chunks, maker, clause)
        self._on_tiers: set[int] = set()
        """Chunks that speak of the tier that something is on."""

    def _note_goal(self, facts: Sequence[tuple]) -> None:
        """Say that "on the tray to the left of the bowl" is read as the tray's place, and "on the base" as no place."""
        for _, at, _, heads, *_ in (fact for fact in facts if fact[0] == "goal"):
            parts = heads and all(self._chunks[head].named.kind == "part" for head in heads)
            if parts and not self._said.ref_all(heads):
                said = " ".join(self._chunks[each].text for each in (at, *heads))
                self._world.note(f'not understood: "{said}": nothing is named that it is a part of')
        goals = {head for fact in facts if fact[0] == "goal" and self._chunks[fact[1]].relation.kind == "on"
                 for head in fact[3]}  # fmt: skip
        for fact in facts:
            link = self._chunks[fact[1]].link if fact[0] == "rel" else None
            aside = link is not None and link.manner == "place" and link.kind in LATERAL_KINDS
            if aside and set(fact[2]) <= goals and self._may_share(fact[2], fact[3]):
                of, place = (" ".join(self._chunks[at].text for at in ats) for ats in (fact[2], (fact[1], *fact[3])))
                self._world.note(f'"{place}" is read as said of "{of}", not of where on it.')

    def _may_share(self, goals: Sequence[int], landmarks: Sequence[int]) -> bool:
        """Whether what `landmarks` mean may stand on what `goals` mean as well as beside it."""
        below, marks = self._said.ref_all(goals)[:1], self._said.ref_all(landmarks)
        return bool(below and marks) and all(has_room(self._world, below[0], mark) for mark in marks)

    def _with_landmarks(self, facts: Sequence[tuple]) -> None:
        """Read a second word on where something is to go: "on the tray, next to the jug" has the jug on the tray."""
        world = self._world
        aims = [fact for fact in facts if fact[0] == "goal" and self._chunks[fact[1]].relation.kind in SUPPORT_KINDS]
        for _, at, heads in (fact for fact in facts if fact[0] == "extra"):
            link, marks = self._chunks[at].link, self._said.ref_all(heads)
            # "Put the cup on the tray next to the jug and the fork on the plate": the jug is on the tray.
            aim = next((aim for aim in reversed(aims) if aim[1] < at), None)
            moved, below = (self._said.ref_all(aim[n])[:1] if aim else [] for n in (2, 3))
            beside = link is not None and (link.manner == "between" or link.kind in LATERAL_KINDS)
            known = beside and bool(marks and moved and below)
            if link is not None and known and all(fits(world, below[0], mark) for mark in marks):
                world.place(marks, world.containment(below[0]), below)
            if link is not None and known and world.support(moved[0]) is below[0]:
                # "Put a cup on a tray, next to a jug" makes it so.
                self._relating.relate(moved, link, marks)
            elif link is not None and known and self._said_of_goal(below[0], link.kind, marks):
                self._relating.relate(below, link, marks)
            else:
                where = " ".join(self._chunks[each].text for each in (at, *heads))
                world.note(f'not modelled: "{where}"')

    def _said_of_goal(self, below: Item, kind: str | None, marks: Sequence[Item]) -> bool:
        """Whether `kind` of `marks` is told of `below` itself, not of where on it."""
        beside = beside_each_other(self._world, below, marks)
        return beside and (kind == "next_to" or not self._world.likely.level(self._world.noun(below)))

    def _ends_on_something(self, facts: Sequence[tuple]) -> bool:
        """Whether what is moved is carried afterwards, so that there is a task whatever else is said of where."""
        links = [self._chunks[fact[1]].link for fact in facts if fact[0] == "goal"]
        aims = [link is not None and link.kind in SUPPORT_KINDS and link.manner in ("place", "goal") for link in links]
        return all(aims)

    def _form(self, at: int, heads: Sequence[int]) -> None:
        """Read "in a row", "stacked": of what is to be moved it says how it is to stand afterwards."""
        phrases = [self._chunks[head].phrase for head in heads]
        # "The forks and spoons side by side"
        led = self._clause.tokens[0].text in lexicon.DEFINITE
        meant = all(
            phrase is not None and (phrase.definite or phrase.kind == "pronoun" or (led and not phrase.determined))
            for phrase in phrases
        )
        abreast = self._clause.manner in ("make", "move") and meant and self._stand_abreast(at, heads)
        if abreast or (self._clause.manner == "stack" and meant and self._chunks[at].text in ("stack", "tower")):
            return
        if self._clause.manner is not None and meant:
            self._world.note(f'not modelled: "{" ".join(self._chunks[at].words)}" in what is to be done')
        else:
            self._formed(at, heads)

    def _effect(
        self, hear: Callable[[int, Sequence[int], Sequence[int]], None], at: int, one: Sequence[int], two: Sequence[int]
    ) -> None:
        """Let chunk `at` have its effect through `hear`; a note names it where it has none."""
        before = learned(self._world)
        hear(at, one, two)
        if learned(self._world) != before or holds_already(
            self._world, self._said.ref_all(one), self._said.ref_all(two)
        ):
            return
        heads = [head for head in (*one, *two) if self._chunks[head].phrase is not None]
        kinds = {self._chunks[head].phrase.kind for head in heads}  # type: ignore[union-attr]
        link = self._chunks[at].link
        told = link is not None and link.manner not in ("include", "gaze", "goal")
        said = " ".join(f'"{self._chunks[head].text}"' for head in two)
        if told and kinds <= {"object", "unknown", "pieces", "pronoun", "part"}:
            self._world.note(f'not understood: "{self._chunks[at].text}" {said}')
        elif link is not None and link.says:
            self._world.note(f'not arranged: "{self._chunks[at].text}" {said}, which is set aside')
        elif link is not None and not link.inverse:
            # "A bicycle in front of the garage", "a mirror on the wall", of which nothing is made
            where = [self._chunks[head].named for head in two]
            unmade = [each for each in where if each.kind == "background" and not each.substance]
            if any(link.kind in LATERAL_KINDS or each.words.split()[-1].lower() in _STRUCTURES for each in unmade):
                places = " and ".join(each.words for each in where)
                self._world.note(f'not modelled: "{self._chunks[at].text.lower()} {places}"')

    def _aimed(self, at: int, child_heads: Sequence[int], parent_heads: Sequence[int]) -> None:
        """Read where something is to go: there it is, where the prompt makes it up; a task, where it speaks of it."""
        link = self._chunks[at].relation
        if all(map(self._said.is_open, (*child_heads, *parent_heads))):
            # "Bring the cup to the plate and set it on it": the first is what is moved.
            self._said.refs_of(child_heads, child=True)
        before, parents = self._world.subject, self._said.refs_of(parent_heads, link, child_heads)
        children = self._said.refs_of(child_heads, link, parent_heads, child=True)
        children = children or self._everything(child_heads, parents)
        if not parent_heads:
            parents = self._topmost([item for item in before if item not in children])
            if link.kind == "in" and children and not parents:
                # "There is a ball next to a box. Put it inside.": in the one thing that holds something.
                hollow = [item for item in self._world.items() if self._world.likely.hollow(self._world.noun(item))]
                parents = hollow if len(hollow) == 1 and hollow[0] not in children else []
            if link.kind == "in" and children and parents:
                # "Take the lid off the pot and put an egg inside": inside the pot.
                parents = self._that_holds(children[0], parents)
        if [self._chunks[head].named.kind for head in parent_heads] == ["pronoun"] and link.kind == "on":
            parents = self._topmost(self._left_behind(parents))
        phrases = [self._chunks[head].phrase for head in child_heads]
        taken = any(chunk.link is not None and chunk.link.manner == "source" for chunk in self._chunks)
        goals = [self._chunks[head].phrase for head in parent_heads]
        # "Put an egg in the microwave", which is there: nothing else is told of.
        alone = self._clause.manner == "make" and not self._said.before and bool(goals)
        into = link.kind == "in" and alone and all(goal and goal.definite and not goal.each for goal in goals)
        goes_on = link.kind in LATERAL_KINDS and bool(children) and {*children} <= {*self._world.makes}
        made_up = (self._clause.manner == "make" and goes_on) or (
            self._clause.manner in ("make", "stack")
            and not (taken or into or self._clause.then or self._world.steps)
            and not any(item.group in self._said.before for item in children)
            and all(
                phrase is not None
                and phrase.determined
                and not phrase.definite
                and (phrase.kind in ("object", "unknown") or phrase.words.lower().startswith(("a ", "an ")))
                and not phrase.superlative.size_word
                for phrase in phrases
            )
        )
        if made_up:
            if self._clause.manner == "stack" and len(children) > 1:
                self._stacked(list(dict.fromkeys(item.group for item in children)), tall=True)
            if children and parents:
                of_all = self._said.speaks_of_each(parent_heads, carrying=True)
                apiece = share(self._world, link, parents, children, all_of=of_all, having=False) == "each"
                if self._said.speaks_of_each(parent_heads) or (of_all and apiece and link.kind in SUPPORT_KINDS):
                    children = multiply(self._world, children, len(parents))
                if self._clause.verb == "lean" and link.manner == "place" and link.kind in ("on", "next_to"):
                    link = Link(kind="next_to", says="leaning_against")
                if len(parent_heads) != 1 or not self._on_tier(children, parent_heads[0], parents):
                    self._relating.relate(children, link, parents)
                self._world.makes += [*children, *parents]
                meant = "." if goes_on else '; with "the" before what is moved it is a task.'
                self._world.note(f'"{self._clause.said}" is read as the scene to make{meant}')
            return
        opened = parents and self._world.is_a(parents[0], tuple(vessels.OPENED), vessels.SHUT, vessels.CLOSED)
        # "Return the pan to the stove": onto it.
        opened = opened and (self._world.houses(parents[0]) or not self._world.is_a(parents[0], ("stove",)))
        level = bool(parents) and self._world.likely.level(self._world.noun(parents[0]))
        floor = bool(parents) and self._world.on_floor(parents[0])
        if link == Link(manner="goal", kind="on") and opened and children and self._clause.verb not in _SLIDING:
            # "Move the ball to the box", "to the open cabinet"
            link = Link(manner="goal", kind="in")
        elif link == Link(manner="goal", kind="on") and self._clause.verb in _SLIDING and level and floor:
            # "Drag the basket over to the bed": beside it.
            self._clause = replace(self._clause, manner="other")
        single = bool(children) and all(phrase and not phrase.definite for phrase in phrases)
        if single and self._said.speaks_of_each(parent_heads):
            # "Place one fig from the box into each of two bowls"
            children = multiply(self._world, children, len(parents))
        own = len(children) > 1 == len(parents) and _OWN.search(self._clause.said)
        if own and self._said.speaks_of_each(child_heads):
            # "Put each of the two apples on its own plate"
            parents = multiply(self._world, parents, len(children))
        moved, goal = (" ".join(self._chunks[head].text for head in heads) for heads in (child_heads, parent_heads))
        part = f"{moved} {self._chunks[at].text} {goal}".strip()
        refuse_goal(self._clause.said, children, parents, moved, goal)
        for head in parent_heads:
            self._note_part(head)
        self._said.not_understood((*child_heads, *parent_heads))
        if self._clause.verb == "hang" and link.kind == "on":
            link = Link(kind="hangs_from")
        if link.manner == "half" and link.side != "centre" and parents and self._world.is_a(parents[0], lexicon.LEVEL):
            self._world.note(f'not modelled: "{self._chunks[at].text} {goal}": no task asks for a side.')
        parts = [phrase for head in parent_heads if (phrase := self._chunks[head].phrase) is not None and phrase.part]
        said, near = self._clause.said.lower(), self._chunks[at].words
        sided = link.kind == "on" and _SIDEWAYS.search(said) is not None
        ends = link.manner == "edge" or link.side is not None or bool(_PARTS & {phrase.part for phrase in parts})
        ends = ends or "along" in near or link.says == "across"
        # "Push the plate to the front of the stove" is to before it.
        ends = ends or (near[-3:] == ("the", "front", "of") and self._world.noun(parents[0]) not in lexicon.HOUSES)
        slid = self._clause.verb in _SLIDING or (self._clause.verb == "move" and sided)
        slid = slid or (bool(parts) and {"other", "opposite"} & {*said.split()})
        if slid and level and (ends or sided or (link.kind == "on" and lexicon.DIRECTIONS & {*said.split()})):
            # "Slide the plate to the edge of the table", "slide it forward on the table": it is on the table.
            children = [item for item in children if not self._world.on_floor(item)]
            if children and all(self._world.support(item) is None for item in children):
                self._relating.relate(children, Link(kind="on"), parents[:1])
            self._clause = replace(self._clause, manner="other")
        self._from_there(children, parents)
        self._out_of_opened(children, parents)
        taken = self._world.steps[-1] if self._world.steps else None
        opened = self._opened() == parents != []
        if opened and taken is not None and taken.manner == "pick" and [*taken.items] == children:
            # "Open the box, pick up the ring and put it in the box": it was not in there.
            for item in children:
                self._world.supports.pop(item, None)
        for item, goal in by_colour(self._world, self._clause.said, children, parents):
            self._step([item], link, [goal])
            children = []
        if children:
            self._step(children, link, parents, part)

    def _left_behind(self, parents: list[Item]) -> list[Item]:
        """The scale where "it" is the bowl that was taken from it: "take the bowl off the scale, put the cup on it"."""
        world, taken = self._world, self._world.steps[-1:]
        held = bool(taken) and taken[0].manner == "pick" and list(taken[0].items) == parents
        below = world.support(parents[0]) if held else None
        hollow = world.likely.hollow
        return [below] if below and hollow(world.noun(parents[0])) and not hollow(world.noun(below)) else parents

    def _topmost(self, parents: list[Item]) -> list[Item]:
        """What carries what is put on the tower that "it" is: the highest of its kind above one of `parents`."""
        world = self._world
        if len(parents) != 1:
            return parents
        while above := [item for item in world.items() if world.support(item) is parents[0]
                        and world.noun(item) == world.noun(parents[0])]:  # fmt: skip
            parents = above[:1]
        return parents

    def _from_there(self, children: list[Item], parents: list[Item]) -> None:
        """Put `children`, which the sentence empties something of, there."""
        world, there = self._world, self._world.emptied[:1]
        free = all(world.support(item) is None and not world.on_floor(item) for item in children)
        if there and children and free and there[0] not in (*children, *parents):
            world.place(children, world.containment(there[0]), there)

    def _done(self, heads: Sequence[int]) -> None:
        children = self._said.refs_of(heads)
        if self._clause.verb in SHUTTING and [self._chunks[head].text.lower() for head in heads] == ["it"]:
            # "Get the spoon from the drawer and close it": the drawer.
            likely, world = self._world.likely, self._world
            below = [world.support(item) for item in children]
            below = [item for item in below if item is not None and likely.closet(world.noun(item))]
            filled = [item for item in (world.steps[-1].goal if world.steps else ()) if likely.closet(world.noun(item))]
            children = below or ((self._opened() or filled) if self._clause.verb != "open" else []) or children
        pronouns = [self._chunks[head].named.kind for head in heads] == ["pronoun"]
        if self._clause.manner == "unload" and pronouns and len(children) == 1:
            # "A jug and a rope are on a cart. Unload it": the cart.
            below = [self._world.support(item) for item in children]
            bare = not any(self._world.support(item) in children for item in self._world.items())
            children = [item for item in below[:1] if item is not None and bare] or children
        self._out_of_opened(children, [])
        said = self._clause.said.lower()
        out = self._clause.manner == "pick" and "out" in said.split() and "out from" not in said
        if out and children and all(self._world.support(item) is None for item in children):
            named = f'"{children[0].group.words}"'
            self._world.note(f'not modelled: "{self._clause.said}": what {named} is taken out of is not said with it.')
        self._said.not_understood(heads)
        # "Pick up the one on the left" is heard where one is.
        told = {item for edge in self._world.laterals for item in (edge.child, edge.parent)}
        for head in heads:
            if any(len(item.group.items) > 1 or item in told for item in self._said.ref(head)):
                self._handled.add(head)
        phrases = [self._chunks[head].phrase for head in heads]
        made_up = all(phrase is not None and phrase.determined and not phrase.definite for phrase in phrases)
        turn_as_found(self._world, self._clause.verb, self._clause.said, children)
        if unstacks(self._world, self._clause.verb, children):
            self._stacked(list(dict.fromkeys(item.group for item in children)), tall=True)
            named = " and ".join(dict.fromkeys(f'"{item.group.words}"' for item in children))
            self._world.note(f'assumed: {named} stacked before "{self._clause.said}"')
        if self._clause.manner == "stack" and made_up:
            self._stacked(list(dict.fromkeys(item.group for item in children)), tall=True)
        elif self._clause.manner != "make" or not made_up:
            self._step(children, None, [])

    def _out_of_opened(self, children: list[Item], goal: list[Item]) -> None:
        """Put `children`, which are taken to `goal`, in what is opened before: "open the box and remove the ring"."""
        opened = self._opened()
        taken = self._clause.verb in _TAKING_OUT and children and len(opened) == 1 and opened[0] not in goal
        if taken and self._may_hold(opened[0], children):
            self._relating.relate(children, Link(kind="in"), opened)

    def _opened(self) -> list[Item]:
        """What was opened last and not shut again."""
        steps = [step for step in self._world.steps if SHUTTING & {*step.said.lower().split()[:1]}]
        return list(steps[-1].items) if steps and steps[-1].said.lower().startswith("open ") else []

    def _may_hold(self, holder: Item, items: Sequence[Item]) -> bool:
        """Whether `holder` is of what things are in, and `items`, which were not told of before, are nowhere yet."""
        world = self._world
        holds = world.likely.hollow(world.noun(holder)) or world.is_a(holder, tuple(vessels.OPENED), vessels.CLOSED)
        holds = holds or world.likely.closet(world.noun(holder))
        new = all(item.group not in self._said.before and item is not holder for item in items)
        new = new and not any(world.is_a(item, vessels.ON_RIMS, lexicon.FLOOR) for item in items)
        return holds and new and all(world.support(item) is None for item in items)

    def _step(self, children: list[Item], link: Link | None, parents: list[Item], part: str = "") -> None:
        manner = self._clause.manner
        if manner is None:
            raise PromptError(f'"{self._clause.said}" tells nobody what to do.')
        if manner == "pick" and len(children) == 1 and children[0].group.multiplied:
            # "Take one apple from each of two bowls"
            children = list(children[0].group.items)
        if self._clause.how and manner in ("unload", "other", "move") and children and not parents:
            # "Clear the desk: put the cups on the tray": from the desk.
            self._world.emptied = children
            return
        said, verb, items, goal = self._clause.said, self._clause.verb, tuple(children), tuple(parents)
        step = Step(manner=manner, said=said, verb=verb, part=part, items=items, link=link, goal=goal)
        self._world.steps.append(step)

    def _on_tier(self, children: list[Item], head: int, owners: list[Item]) -> bool:
        """Whether chunk `head` speaks of a tier of `owners`, on which `children` are put then."""
        put = put_on_tier(self._relating, self._chunks[head], children, owners)
        self._on_tiers |= {head} if put == "told" else set()
        return bool(put)

    def _note_part(self, head: int) -> None:
        phrase = self._chunks[head].phrase
        if tier_of(self._world, self._chunks[head], self._said.ref(head)) is not None:
            return
        parts = lexicon.DRAWERS | lexicon.DETACHED | lexicon.FITTED
        if phrase is not None and phrase.part in parts and phrase.kind == "object":
            self._world.note(f'"{phrase.words}": "{phrase.said}" has no parts of its own and is meant.')
