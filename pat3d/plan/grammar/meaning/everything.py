"""What "everything" and "the things" are, where they are moved or said to be somewhere."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.meaning.entities import Item
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.placing import Placing
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.rewriting.instructions import Clause
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS

_BUT = re.compile(r"\b(?:but|except|excluding|save|apart from|other than)\b")


class Everything(Placing):
    """Finds what is meant by no noun of its own."""

    def __init__(self, world: World, chunks: Sequence[Chunk], maker: Maker, clause: Clause) -> None:
        super().__init__(world, chunks, maker)
        self._clause = clause
        if _BUT.search(clause.said.lower()):
            # "Put everything but the cup in the box", where the cup was named just before.
            self._said.left = list(world.subject)
        self._handled: set[int] = set()
        """Phrases for everything that were put somewhere."""
        self._from: list[Item] = []
        """What everything that is moved is on before."""

    def _is_items(self, heads: Sequence[int]) -> bool:
        """Whether one of `heads` is "everything" or "the things"."""
        phrases = (self._chunks[head].phrase for head in heads)
        return any(phrase is not None and phrase.kind == "items" for phrase in phrases)

    def _everything(self, heads: Sequence[int], goal: list[Item]) -> list[Item]:
        """What "everything" at `heads` is that is moved to `goal`: all that is there, or is on what is said with it."""
        world = self._world
        said = [self._chunks[head].named for head in heads]
        every = all(phrase.words.lower().startswith(("everything", "all", "what")) for phrase in said)
        plain = every and all(phrase.modifiers == NO_MODIFIERS for phrase in said)
        if not plain or not self._is_items(heads) or self._said.ref_all(heads):
            return []
        meant = [item for item in world.items() if item not in (*goal, *self._said.left) and not world.on_floor(item)]
        if self._from:
            meant = [item for item in meant if world.support(item) in self._from]
        meant = [item for item in meant if world.support(item) not in meant]
        if meant:
            self._handled |= set(heads)
            self._said.known.update(dict.fromkeys(heads, meant))
        return meant

    def _of_everything(self, heads: Sequence[int], link: Link, parents: list[Item]) -> bool:
        """Read "Everything is on a table": all that is not yet carried."""
        world = self._world
        if not self._is_items(heads):
            return False
        if self._clause.manner is not None:
            # "Move everything on the table": what was there before.
            self._from += parents
            return any(world.support(item) in parents for item in world.items())
        free = [item for item in world.items() if world.support(item) is None and item not in parents]
        free = [item for item in free if not world.on_floor(item)]
        if free:
            self._handled |= set(heads)
            self._relating.relate(free, link, parents)
        return bool(free)
