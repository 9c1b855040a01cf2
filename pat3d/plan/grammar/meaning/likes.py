"""One more of a kind: "a tall vase and a short one" names two vases, "the smaller box on the larger one" two boxes.

A phrase that ends in "one" speaks of a member where several were named without what it is told by, and names something
new where what was named is told otherwise.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from pat3d.assets.materials import find_material
from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.entities import Item
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.modifiers import Modifiers, is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

SHAPES = lexicon.HONOURED - {
    "lit", "burning", "flickering", "landscape", "striped", "open", "opened", "closed", "shut"
}  # fmt: skip
"""Adjectives of measure that a thing is told from its like by."""
_VESSELS = ("cup", "mug", "glass", "bowl", "jar", "bottle", "box", "can", "carton", "pot", "tin")
_COMPARED = frozenset({"larger", "bigger", "smaller", "taller", "shorter"})


def likes_named(chunks: Sequence[Chunk], nouns: Nouns, known: Collection[Phrase]) -> list[Chunk]:
    """`chunks` with "a short one" as "a short vase" where a vase was named, there or among the `known`."""
    made = list(chunks)
    for at, piece in enumerate(chunks):
        phrase = piece.phrase
        if phrase is None or phrase.kind != "pieces" or phrase.said or not _told(phrase):
            continue
        told = [(n, one.phrase) for n, one in enumerate(made[:at]) if one.phrase is not None]
        before = [(n, one) for n, one in told if one.kind == "object" and not one.cycle]
        like = _known_like(phrase, before, known) if phrase.definite else _new_like(phrase, before, made[:at], known)
        if like is None:
            continue
        n, one = like
        whole = with_noun(replace(phrase, modifiers=measured(phrase.modifiers)), one, nouns)
        made[at] = replace(piece, phrase=whole)
        if n is not None and phrase.definite:
            made[n] = replace(made[n], phrase=replace(one, modifiers=measured(one.modifiers)))
    return made


def vessels_meant(chunks: Sequence[Chunk], known: Collection[Phrase]) -> list[Chunk]:
    """`chunks` with "the coffee" as the cup where a cup of coffee or a coffee cup was named, and no coffee besides."""
    made = list(chunks)
    for at, piece in enumerate(chunks):
        phrase = piece.phrase
        if phrase is None or phrase.words.lower() != f"the {phrase.head}" or phrase.head not in lexicon.SUBSTANCES:
            continue
        inside = any(one.link is not None and one.link.kind == "in" for one in chunks[at + 1 : at + 3])
        before = [*known, *(one.phrase for one in made[:at] if one.phrase is not None)]
        itself = any(one.noun == phrase.noun and one.substance != phrase.head for one in before if phrase.noun)
        held = [one for one in before if one.kind == "object" and not one.several and _holds(one, phrase.head)]
        if held and not itself and not inside and len({one.noun for one in held}) == 1:
            meant = replace(held[-1], words=phrase.words, definite=True, number=phrase.number)
            made[at] = replace(piece, phrase=meant)
    return made


def _holds(vessel: Phrase, stuff: str) -> bool:
    """Whether `vessel` is called by the `stuff` in it: "a cup of coffee", "a coffee cup"."""
    named = (f"{one} {vessel.said.split()[-1]}" for one in (stuff, stuff.removesuffix("s")))
    return vessel.substance == stuff or (vessel.said.endswith(_VESSELS) and vessel.said in named)


def with_noun(phrase: Phrase, owner: Phrase, nouns: Nouns) -> Phrase:
    """`phrase`, which has no noun, with the noun of `owner`: the box of "a small box" for "a big one"."""
    words = owner.said.split()
    while len(words) > 1 and is_modifier(words[0]) and nouns.match(words[1:]):
        if find_material(words[0]) and not phrase.modifiers.material:
            # "A blue rubber duck and a green one": a rubber duck.
            break
        words = words[1:]
    found = nouns.match(words) if words != owner.said.split() else None
    noun, said = (found.noun, found.said) if found else (owner.noun, owner.said)
    plural = phrase.words.lower().endswith(" ones") if phrase.count is None else phrase.count > 1
    return replace(phrase, kind=owner.kind, noun=noun, said=said, head=owner.head, cycle=owner.cycle, plural=plural)


def _told(phrase: Phrase) -> bool:
    """Whether `phrase` describes: "a short one", "the largest", and not "one", "the red one", "the first one"."""
    words = phrase.modifiers
    ends = phrase.words.lower().split()[-1:] in (["one"], ["ones"]) or phrase.head in lexicon.SUPERLATIVES
    where = {*words.adjectives} & (lexicon.POSITIONS.keys() | lexicon.LEVELS.keys())
    return ends and not words.colours and not where and bool(_property(words)) and phrase.superlative == Modifiers()


def _property(words: Modifiers) -> str:
    """By what `words` tell a thing from its like: its size, its material, its looks; nothing where they do not."""
    if words.size_word or {lexicon.SUPERLATIVES.get(word, (word, 1.0))[0] for word in words.adjectives} & SHAPES:
        return "size"
    if {*words.adjectives} & lexicon.SUPERLATIVES.keys():
        return "size"
    return "material" if words.material else "looks" if words.adjectives or words.postures else ""


def _value(words: Modifiers) -> set[str]:
    """The size, the material or the looks that `words` give, superlatives as their adjectives."""
    named = {words.size_word, words.material, *words.adjectives, *words.postures}
    return {lexicon.SUPERLATIVES.get(word, (word, 1.0))[0] for word in named if word}


def _new_like(
    phrase: Phrase, before: Sequence[tuple[int, Phrase]], chunks: Sequence[Chunk], known: Collection[Phrase]
) -> tuple[int, Phrase] | None:
    """What "a short one" behind `chunks` is one more of; None where it is one of what was named, or cannot be told."""
    kind, value = _property(phrase.modifiers), _value(phrase.modifiers)
    alike = [(n, one) for n, one in before if _property(one.modifiers) == kind]
    last = before[-1] if before else (0, phrase)
    if (
        last[1].several
        and last[0] == len(chunks) - 2
        and chunks[-1].text == "and"
        and not _value(last[1].modifiers) & value
    ):
        # "Two red jars and a tall one": three jars.
        return last
    if not alike and (known or any(one.several for _, one in before)):
        return None
    # "On a tray are a cup and a small one": no tray; "a cup stands on a tray, and a small one ...": no tray either.
    free = [(n, one) for n, one in before if not n or chunks[n - 1].kind != "rel"]
    listed = [(n, one) for n, one in free[-1:] if n == len(chunks) - 2 and chunks[-1].kind == "joint"]
    n, one = next(iter([*reversed(alike), *listed, *free, *before]), (0, None))
    if one is None or (one.several and (not _property(one.modifiers) or _value(one.modifiers) & value)):
        return None
    return n, one


def _known_like(
    phrase: Phrase, before: Sequence[tuple[int, Phrase]], known: Collection[Phrase]
) -> tuple[int | None, Phrase] | None:
    """What "the larger one" is told from, where of its kind there is nothing but what is told by its size too.

    "The dirty one" after "a dirty plate" is that plate.
    """
    kind, value = _property(phrase.modifiers), _value(phrase.modifiers)
    named: list[tuple[int | None, Phrase]] = [*((None, one) for one in known), *before]
    same = [(n, one) for n, one in named if _property(one.modifiers) == kind and _value(one.modifiers) & value]
    if same and kind != "size":
        return same[-1]
    told = [(n, one) for n, one in named if one.definite and _apart(kind, value, one.modifiers)]
    if not told:
        return None
    n, one = told[-1]
    alike = [other for _, other in named if other.noun == one.noun]
    return (n, one) if all(_apart(kind, value, other.modifiers) for other in alike) else None


def _apart(kind: str, value: set[str], words: Modifiers) -> bool:
    """Whether `words` give another size or material than `value`, or the opposite looks: "clean" and "dirty"."""
    if _property(words) != kind or _value(words) & value:
        return False
    return kind != "looks" or any(pair & value and pair & _value(words) for pair in lexicon.OPPOSITES)


def compared_anew(phrase: Phrase, likes: Sequence[Item]) -> bool:
    """Whether `phrase` is "the bigger ring" behind "put the ring on the peg": another than the only one of `likes`."""
    compared = {phrase.modifiers.size_word, *phrase.modifiers.adjectives} & _COMPARED
    if not compared or phrase.plural or len(likes) != 1:
        return False
    own = (likes[0].group.modifiers, likes[0].told)
    return not any(words.size_word or words.adjectives for words in own)


def measured(words: Modifiers) -> Modifiers:
    """`words` with "largest" as a size and "tallest" as "tall"."""
    told = [lexicon.SUPERLATIVES[word] for word in (*words.adjectives, words.size_word) if word in lexicon.SUPERLATIVES]
    kept = tuple(word for word in words.adjectives if word not in lexicon.SUPERLATIVES)
    size = words.size_word if words.size_word not in lexicon.SUPERLATIVES else ""
    scale = words.scale
    for word, factor in told:
        if word in lexicon.SIZES:
            size, scale = word, factor
        else:
            kept = (*kept, word)
    if size and size not in lexicon.SIZES:
        # "The tallest" is tall as the catalogue makes what is tall.
        size, kept = "", (*kept, size)
    return replace(words, size_word=size, scale=scale, adjectives=tuple(dict.fromkeys(kept)))


def oppositely_sized(name: str, scale: float) -> bool:
    """Whether `name` says a size, and `scale` is of the other: "the large bowl" has a name of its own."""
    return " " in name and (lexicon.SIZES.get(name.split()[0], 1.0) - 1.0) * (scale - 1.0) < 0.0
