"""What is in a room: "a living room that has two sofas, a table and a rug in it" has the rug in the room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Nouns

_HAVING = lexicon.HAVING | {"featuring", "features", "having"}
_INNER = (("in", "it"), ("inside", "it"), ("inside", "of", "it"))
_WHERE = (("where",), ("in", "which"), ("wherein",))
ROOMS = frozenset({"room", "kitchen", "bathroom", "bedroom", "office", "workshop", "garage", "garden", "studio",
    "classroom", "library", "cafe", "restaurant", "nursery", "playroom", "laboratory", "lab", "workspace", "lounge",
    "study", "den", "pantry", "attic", "basement", "hallway", "lobby", "warehouse", "factory", "store", "supermarket",
    "shop", "bakery", "cafeteria", "gym", "shed", "cellar", "workcell", "apartment", "house", "home"})  # fmt: skip
_SCENES = frozenset({"scene", "picture", "image", "photo", "setup", "arrangement", "setting"})
_HARDLY = 1.0
"""Cost of being inside from which on nobody thinks of it: a plant in a trash can."""
_SHORTEST = 3
"""Words of the shortest sentence that begins with "a room has"."""


def where_it_is(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a kitchen where a pot is on a stove" as "in a kitchen, a pot ..."; a scene is no place."""
    words = [token.text for token in tokens]
    named = (n for n in range(1, min(len(words) - 3, 9)) if words[n] in ROOMS | _SCENES and _where(words, n + 1))
    at = next(named, 0)
    article = next((n for n in range(at - 1, max(at - 4, -1), -1) if words[n] in ("a", "an", "the", "this")), -1)
    opening = all(word in lexicon.COMMANDS or word in ("there", "is") for word in words[: max(article, 0)])
    if not at or article < 0 or not opening:
        return list(tokens)
    there = at + 1 + _where(words, at + 1)
    if words[at] in _SCENES:
        return list(tokens[there:])
    lead = replace(tokens[article], text="in", end=tokens[article].start)
    return [lead, *tokens[article : at + 1], replace(tokens[at + 1], text=",", mark=True), *tokens[there:]]


def _where(words: Sequence[str], at: int) -> int:
    """How many words at `at` are "where" or "in which"; 0 without."""
    return next((len(said) for said in _WHERE if tuple(words[at : at + len(said)]) == said), 0)


def in_rooms(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence without the "in it" of what a room has; a vessel that it has may be meant as well."""
    words = [token.text for token in tokens]
    having = [at for at, word in enumerate(words) if word in _HAVING]
    inner = [(at, at + len(said)) for at in range(len(words)) for said in _INNER
             if tuple(words[at : at + len(said)]) == said]  # fmt: skip
    if len(having) != 1 or len(inner) != 1 or having[0] > inner[0][0] or len(words) < _SHORTEST:
        return list(tokens)
    (start, end), first = inner[0], having[0]
    room = words[first - 1 - (words[first - 1] in lexicon.RELATIVES)] if first else ""
    likely = Plausible(nouns)
    last = max((at for at in range(first, start) if words[at] == "and"), default=start)
    # "A sink, a toilet and a mug in it": of two that are named before, no mug is in the farther one.
    before = max((at for at in range(first, last - 1) if words[at] == ","), default=first)
    inside, near = nouns.longest(words[last:start]), nouns.longest(words[before:last])
    child = inside[0].noun if inside is not None else ""
    hollow = near is not None and likely.hollow(near[0].noun) and likely.within(child, near[0].noun) < _HARDLY
    said_of_room = room in lexicon.BACKGROUND and not hollow and tokens[end].mark
    return [*tokens[:start], *tokens[end:]] if said_of_room else list(tokens)
