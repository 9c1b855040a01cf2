"""Nouns left out in a list ("a red, a green and a blue block"), and lists that form one tower."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.chunking.cells import in_the_whole
from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.likes import likes_named, with_noun
from pat3d.plan.grammar.meaning.ones import paralleled
from pat3d.plan.grammar.meaning.parallels import told_alike
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS, Modifiers
from pat3d.plan.grammar.words.vocabulary import Nouns

_SIDES = {"left": "left", "right": "right", "centre": "middle", "on top": "top"}
_HARD = frozenset({"wood", "bamboo", "stone", "glass", "ceramic", "porcelain", "metal", "steel", "iron", "brass",
                   "plastic"})  # fmt: skip
_SOFT = ("sofa", "armchair", "couch", "bed", "rug", "carpet", "plant", "potted plant", "tree", "bag", "handbag",
         "backpack", "rose", "flower", "tulip", "sunflower", "carrot", "banana")  # fmt: skip
_CLOTH = ("towel", "napkin", "blanket", "rug", "pillow", "cushion", "hat", "scarf", "beanie", "glove", "sock", "shirt",
          "curtain", "tablecloth", "mitten", "coat", "jacket", "apron")  # fmt: skip
_ENDS = ("joint", "clause", "there")
_SAID = ("rel", "have", "place", "verb")
"""Chunks by which something is said of what stands before them."""
_LEVELS = {"bottom": 0, "middle": 1, "centre": 1, "top": 2}


def completed(chunks: Sequence[Chunk], nouns: Nouns, known: Collection[Phrase], doubts: list[str]) -> list[Chunk]:
    """`chunks` with every left-out noun in its place, and "a stack of A, B and C" as "A, B and C" in a tower.

    `known` are the phrases of what was named before them; `doubts` takes notes of what is a guess.
    """
    told = _described(_gapped(_full(_one_more(chunks, known, nouns))))
    told = likes_named(paralleled(told, nouns, known), nouns, known)
    return _towers(_levelled(_alike(told_alike(_with_nouns(in_the_whole(told), nouns), nouns, known), nouns, doubts)))


def _one_more(chunks: Sequence[Chunk], known: Collection[Phrase], nouns: Nouns) -> list[Chunk]:
    """`chunks` with "a cup is on the table and one is on the shelf" as "... another is on the shelf".

    Where several were named it may be one of them, so that only a clause built alike tells of another: "a bowl on the
    left holds three figs, one on the right holds a nut".
    """
    made = list(chunks)
    for at in range(1, len(chunks) - 1):
        phrase, follower = chunks[at].phrase, chunks[at + 1]
        if phrase is None or phrase.kind != "pieces" or phrase.words.lower() != "one":
            continue
        if chunks[at - 1].kind not in _ENDS or follower.kind not in _SAID:
            continue
        before = [one.phrase for one in made[:at] if one.phrase is not None]
        named = [one for one in (*before, *known) if one.kind == "object"]
        several = any(one.several or one.each or one.kind in ("pieces", "items") for one in (*before, *known))
        # "A cup and a can, one on the left": one of the two.
        told = chunks[at - 1].kind == "there" or any(one.kind in _SAID for one in chunks[:at])
        if not named or (several and not _does_alike(chunks, at)) or not told or _listed(chunks[:at]):
            continue
        again = any(one.head == "another" for one in before)
        alike = follower.kind in ("place", "verb", *(one.kind for one in chunks[1:2]))
        if chunks[at - 1].text == "," and not (again or alike):
            # "A bookshelf holds a book, one on the top shelf": that book.
            continue
        if chunks[at - 1].text == "," and follower.kind == "have" and not follower.relation.finite:
            # "A vase with a flower, one with red petals"
            continue
        beside = (one.phrase for one, place in pairwise(made[:at]) if place.kind == follower.kind == "place")
        if (like := next((one for one in beside if one is not None and one.kind == "object"), None)) is not None:
            # "A plate with a bun on the left and one on the right"
            said = replace(phrase, modifiers=like.modifiers, other=True)
            made[at] = replace(chunks[at], phrase=with_noun(said, like, nouns))
        else:
            made[at] = replace(chunks[at], phrase=replace(phrase, kind="pronoun", head="another", count=None))
    return made


def _does_alike(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether "one" at chunk `at` stands at another side than what the sentence begins with, and does the same."""
    ours, theirs = chunks[at + 1 : at + 3], chunks[1:3]
    first = chunks[0].phrase
    single = first is not None and first.kind == "object" and not first.several
    sides = len(ours) == 2 and ours[0].kind == theirs[0].kind == "place" and ours[0].text != theirs[0].text
    verbs = [one.link for one in (*ours[1:], *theirs[1:]) if one.link is not None and one.link.finite]
    return single and sides and len(verbs) == 2 and verbs[0] == verbs[1]


def _listed(chunks: Sequence[Chunk]) -> bool:
    """Whether `chunks` tell of two together, of which one may be meant: "a pen and a book are on the desk"."""
    kinds = ["one" if one.text.lower() == "one" else one.kind for one in chunks]
    return any(kinds[n : n + 3] == ["noun", "joint", "noun"] for n in range(len(kinds)))


def _full(chunks: Sequence[Chunk]) -> list[Chunk]:
    """`chunks` with "one bowl is full of figs and another of nuts" as "..., and another is full of nuts"."""
    made = list(chunks)
    for at in range(1, len(chunks) - 1):
        phrase, filled = chunks[at].phrase, next((one for one in chunks[:at] if one.link and one.link.filling), None)
        other = phrase is not None and phrase.head in ("another", "other")
        if filled is not None and other and chunks[at + 1].text == "of":
            verb = Chunk(kind="verb", text="is", words=("is",))
            made = [*chunks[: at + 1], verb, filled, *chunks[at + 2 :]]
    return made


def _gapped(chunks: Sequence[Chunk]) -> list[Chunk]:
    """`chunks` with "the first holds a ball, the second a book" as "..., the second holds a book"."""
    made: list[Chunk] = []
    for at, piece in enumerate(chunks):
        phrase, follower = piece.phrase, chunks[at + 1].phrase if at + 1 < len(chunks) else None
        if piece.link is not None and phrase is None and follower is not None and follower.head == "which":
            # "a bed on which a pillow lies": a clause of its own.
            made += [Chunk(kind="joint", text=",")] if made and made[-1].kind == "noun" else []
        if piece.kind == "place" and piece.text in _SIDES and made and _the_one(made[-1].phrase):
            # "the one in the middle" is the middle one.
            told = replace(made[-1].phrase, modifiers=Modifiers(adjectives=(_SIDES[piece.text],)))  # type: ignore[type-var]
            made[-1], phrase = replace(made[-1], phrase=told), told
        elif made and _told_by_side(piece, made[-1].phrase, [*chunks[: at - 1], *chunks[at + 1 :]]):
            words = made[-1].phrase.modifiers  # type: ignore[union-attr]
            told = replace(words, adjectives=(*words.adjectives, _SIDES[piece.text]))
            phrase = replace(made[-1].phrase, modifiers=told)  # type: ignore[type-var]
            made[-1] = replace(made[-1], phrase=phrase)
        else:
            made.append(piece)
        gap = _told_before(phrase, chunks[:at]) and follower is not None and follower.kind == "object"
        if not gap or not (follower.determined or follower.plural):  # type: ignore[union-attr]
            continue
        links = [(chunks[n].phrase, chunks[n + 1]) for n in range(at - 2, -1, -1)]
        told = (link for one, link in links if _alike_told(one, phrase) and link.kind in ("have", "rel"))
        verbs = (link for _, link in links if link.link is not None and link.link.finite)
        if (link := next(told, None) or next(verbs, None)) is not None:
            made.append(link)
    return made


def _told_by_side(piece: Chunk, phrase: Phrase | None, others: Sequence[Chunk]) -> bool:
    """Whether `piece` tells `phrase` from its like: "the bowl on the left ..., the one on the right"."""
    if piece.kind != "place" or piece.text not in ("left", "right") or phrase is None or phrase.kind != "object":
        return False
    sides = {one.text for one in others if one.kind == "place"} & {"left", "right"}
    alike = (one.phrase for one in others if one.phrase is not None)
    again = any(_the_one(one) or (one.noun == phrase.noun and one.definite) for one in alike)
    return phrase.definite and not phrase.plural and bool(sides - {piece.text}) and again


def _alike_told(one: Phrase | None, other: Phrase | None) -> bool:
    """Whether both are told from their like in the same way: "the first", "the left cup" and "the right cup"."""
    if one is None or other is None:
        return False
    return one.kind == "pieces" or (one.definite and other.definite and bool(one.noun) and one.noun == other.noun)


def _told_before(phrase: Phrase | None, before: Sequence[Chunk]) -> bool:
    """Whether `phrase` may stand without the verb of a clause before: "the right cup" after "the left cup holds"."""
    if phrase is None or phrase.kind == "pieces":
        return phrase is not None
    return phrase.kind == "object" and any(_alike_told(chunk.phrase, phrase) for chunk in before
                                           if chunk.phrase is not None and chunk.phrase.kind == "object")  # fmt: skip


def _alike(chunks: list[Chunk], nouns: Nouns, doubts: list[str]) -> list[Chunk]:
    """`chunks` with "a white plate and bowl" as "a white plate and a white bowl", and so of a material.

    Of "a red candle and pen" both are red, which `doubts` names as a guess; of "a red cloth and pen" the cloth is.
    """
    for at, (first, joint, second) in enumerate(zip(chunks, chunks[1:], chunks[2:], strict=False)):
        one, other = first.phrase, second.phrase
        if one is None or other is None or not (one.kind == other.kind == "object") or joint.text != "and":
            continue
        told = one.determined and one.count is None and not (other.determined or other.plural or one.plural)
        if not told or other.modifiers != NO_MODIFIERS:
            continue
        words, alike = one.modifiers, _made_alike(one, other, nouns)
        cloth = [nouns.of_class(each.noun, _CLOTH) for each in (one, other)]
        apart = cloth[0] != cloth[1] or nouns.of_class(other.noun, lexicon.FRUIT)
        furniture = all(nouns.of_class(each.noun, lexicon.FLOOR) for each in (one, other))
        if words.colours and not (alike or furniture or all(cloth)):
            how = "not read" if apart else "read"
            doubts.append(f'"{" ".join(words.colours)}" of "{one.words}" is {how} as said of "{other.words}" too.')
        own = replace(NO_MODIFIERS, colours=() if apart else words.colours)
        if words.material_word and words.material in _HARD and alike:
            own = replace(own, material=words.material, material_word=words.material_word)
        chunks[at + 2] = replace(second, phrase=replace(other, modifiers=own))
    return chunks


def _made_alike(one: Phrase, other: Phrase, nouns: Nouns) -> bool:
    """Whether both are furniture with nothing soft, or both things of the table: what one material is said of."""
    named = [one.noun, other.noun]
    if any(nouns.of_class(noun, _SOFT) for noun in named):
        return False
    table = (vessels.HOLLOW, lexicon.DISHES, vessels.BOWLS, vessels.NARROW, vessels.SLENDER)
    ware = all(any(nouns.of_class(noun, each) for each in table) for noun in named)
    return ware or all(nouns.of_class(noun, lexicon.FLOOR) for noun in named)


def _the_one(phrase: Phrase | None) -> bool:
    headless = phrase is not None and phrase.kind == "pieces" and phrase.definite and phrase.modifiers == NO_MODIFIERS
    return headless and phrase.words.lower() in ("the one", "the ones")  # type: ignore[union-attr]


def _level(chunks: Sequence[Chunk], at: int) -> tuple[int, int]:
    """How high the place told at chunk `at` is (0, 1 or 2), and its chunks; no chunks where none is told."""
    piece = chunks[at] if at < len(chunks) else Chunk(kind="joint")
    if piece.kind == "place" and piece.text in ("centre", "on top"):
        return (1 if piece.text == "centre" else 2), 1
    part = chunks[at + 1].phrase if piece.kind == "rel" and at + 1 < len(chunks) else None
    if part is not None and part.kind == "part" and part.said in _LEVELS:
        return _LEVELS[part.said], 2
    return 0, 0


def _levelled(chunks: list[Chunk]) -> list[Chunk]:
    """`chunks` with "a red, a blue and a white block, white at the bottom" as "a white, a blue and a red block"."""
    for at in range(3, len(chunks) - 1):
        phrase, before = chunks[at].phrase, chunks[at - 2].phrase
        level, size = _level(chunks, at + 1)
        if phrase is None or before is None or not _colour_alone(phrase) or level == 1 or at + 1 + size < len(chunks):
            continue
        start = at - 2
        while start > 1 and chunks[start - 1].kind == "joint" and chunks[start - 2].kind == "noun":
            start -= 2
        listed = list(range(start, at - 1, 2))
        own = [n for n in listed if chunks[n].named.modifiers.colours == phrase.modifiers.colours]
        if size and chunks[at - 1].kind == "joint" and len(listed) > 1 and len(own) == 1:
            order = [n for n in listed if n != own[0]]
            order.insert(0 if level == 0 else len(order), own[0])
            told = dict(zip(listed, order, strict=True))
            return [chunks[told.get(n, n)] for n in range(at - 1)]
    return chunks


def _described(chunks: Sequence[Chunk]) -> list[Chunk]:
    """`chunks` with "two of them red" in one piece."""
    made: list[Chunk] = []
    for piece in chunks:
        phrase, before = piece.phrase, made[-1].phrase if made else None
        if phrase is not None and before is not None and _bare(before) and _colour_alone(phrase):
            told = replace(phrase.modifiers, adjectives=(*before.modifiers.adjectives, *phrase.modifiers.adjectives))
            whole = replace(before, modifiers=told, words=f"{before.words} {phrase.words}")
            made[-1] = replace(made[-1], phrase=whole, text=whole.words)
        else:
            made.append(piece)
    return made


def _bare(phrase: Phrase) -> bool:
    headless, words = phrase.kind == "pieces" and not phrase.said, phrase.modifiers
    told = phrase.definite and bool(words.adjectives) and words == Modifiers(adjectives=words.adjectives)
    return headless and (told or (phrase.count is not None and words == NO_MODIFIERS))


def _colour_alone(phrase: Phrase) -> bool:
    return phrase.kind == "pieces" and not phrase.said and phrase.count is None and not phrase.determined


def _with_nouns(chunks: list[Chunk], nouns: Nouns) -> list[Chunk]:
    for at in range(len(chunks) - 1, -1, -1):
        phrase = chunks[at].phrase
        if phrase is None or not _headless(phrase):
            continue
        follower, before = _neighbour(chunks, at, 1), _named_before(chunks, at)
        # "A red book, a blue one and a green mug": a book. "A red one, a blue one and a green mug": mugs.
        told = before is not None and before.kind == "object" and _ends_in_one(phrase)
        own = told and before is not None and bool(before.modifiers.colours) == bool(phrase.modifiers.colours)
        if follower is not None and not own and _lends(follower, phrase) and not _tells_apart(chunks, at, follower):
            chunks[at] = replace(chunks[at], phrase=with_noun(phrase, follower, nouns))
        elif (owner := _owner(chunks, at)) is not None and phrase.modifiers.colours:
            chunks[at] = replace(chunks[at], phrase=with_noun(phrase, owner, nouns))
    return chunks


def _headless(phrase: Phrase) -> bool:
    words = phrase.modifiers
    described = words.colours or words.size_word or words.material
    return phrase.kind == "pieces" and phrase.said == "" and phrase.determined and bool(described)


def _neighbour(chunks: Sequence[Chunk], at: int, step: int) -> Phrase | None:
    """The next phrase of the list that chunk `at` belongs to."""
    if not 0 <= at + step < len(chunks) or chunks[at + step].kind != "joint" or not 0 <= at + 2 * step < len(chunks):
        return None
    return chunks[at + 2 * step].phrase


def _named_before(chunks: Sequence[Chunk], at: int) -> Phrase | None:
    """What the list of chunk `at` names before it and before every "a blue one" that precedes it."""
    while (before := _neighbour(chunks, at, -1)) is not None and _headless(before) and _ends_in_one(before):
        at -= 2
    return before


def _ends_in_one(phrase: Phrase) -> bool:
    return phrase.closing in ("one", "ones")


def _lends(follower: Phrase, phrase: Phrase) -> bool:
    """Whether `follower` has a noun for `phrase`: it is described in the same manner."""
    ours, theirs = phrase.modifiers, follower.modifiers
    alike = (
        bool(ours.colours) == bool(theirs.colours)
        and bool(ours.size_word) == bool(theirs.size_word or set(follower.said.split()) & lexicon.SIZES.keys())
        and (bool(ours.material) == bool(theirs.material) or bool(ours.colours))
    )
    return follower.kind in ("object", "unknown") and follower.determined and alike


def _tells_apart(chunks: Sequence[Chunk], at: int, follower: Phrase) -> bool:
    """Whether the phrase at `at` describes members of a group named before it ("two bars: one white, one beige").

    It does not where `follower` is of another noun: "three lemons and a green and a purple marble".
    """
    while at > 0 and (chunks[at - 1].kind == "joint" or chunks[at - 1].phrase is not None or _includes(chunks[at - 1])):
        at -= 1
        phrase = chunks[at].phrase
        if phrase is not None and not _headless(phrase):
            other = phrase.noun and follower.noun and phrase.noun != follower.noun and chunks[at + 1].text != ":"
            return phrase.plural and not other
    return False


def _includes(piece: Chunk) -> bool:
    return piece.link is not None and piece.link.manner == "include"


def _owner(chunks: Sequence[Chunk], at: int) -> Phrase | None:
    """The object of "a red mug and a blue one": named directly before, and single."""
    phrase = _neighbour(chunks, at, -1)
    ends_in_one = chunks[at].text.lower().split()[-1:] in (["one"], ["ones"])
    if phrase is None or phrase.kind != "object" or phrase.plural or not ends_in_one:
        return None
    behind = chunks[at + 1] if at + 1 < len(chunks) else chunks[at]
    again = [n for n in range(1, at) if chunks[n].kind == behind.kind == "have" and chunks[n].text == behind.text]
    if again and (owner := chunks[again[0] - 1].phrase) is not None and owner.kind == "object":
        # "a white box holding a blue ball and a red one holding a cup": a red box.
        phrase = owner
    return phrase if phrase.modifiers.colours else None


def _towers(chunks: list[Chunk]) -> list[Chunk]:
    """Every "a stack of A, B and C" as "A, B and C" and the word that makes a tower of the three."""
    made: list[Chunk] = []
    at = 0
    while at < len(chunks):
        end = _end_of_stack(chunks, at)
        if end:
            listed = chunks[at + 2 : end]
            made += [*listed, Chunk(kind="form", text="tower", size=sum(piece.kind == "noun" for piece in listed))]
            at = end
        else:
            made.append(chunks[at])
            at += 1
    return made


def _end_of_stack(chunks: Sequence[Chunk], at: int) -> int:
    """The chunk after the list that "a stack of" at chunk `at` is a stack of; 0 where no such list begins there."""
    stack = chunks[at].phrase
    joint = chunks[at + 1].link if at + 1 < len(chunks) else None
    if stack is None or stack.kind != "pieces" or stack.said != "stack" or joint is None or joint.manner != "of":
        return 0
    count, after = 0, at + 2
    while after < len(chunks):
        phrase = chunks[after].phrase
        if phrase is None or phrase.kind not in ("object", "unknown"):
            return 0
        count += 1
        more = after + 1 < len(chunks) and chunks[after + 1].kind == "joint" and "and" not in chunks[after - 1].text
        if not more:
            break
        after += 2
    return after + 1 if count > 1 else 0
