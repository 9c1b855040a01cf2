"""Names of two nouns that are another thing than either: "an umbrella stand" is no umbrella that stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import JOINERS, link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.measures import is_measure
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import number_of
from pat3d.plan.grammar.words.vocabulary import Nouns

_HEADS = frozenset({"stand", "rest"})
"""Nouns that are verbs of several as well."""
_LIDDED = frozenset({"chest", "trunk", "laptop", "toolbox", "cooler", "hamper", "piano", "freezer"})
"""What has a lid that never comes off."""
_OTHERWISE = frozenset(tuple(name.split()) for name in (
    "bubble wrap", "plastic wrap", "cling wrap", "air conditioner", "vacuum cleaner", "nail clipper",
    "garlic press", "tea bag", "tape gun", "drill bit", "water heater", "cable tie",
))  # fmt: skip
"""Names that end in a noun of another thing: a bubble wrap is no wrap to eat."""
_LABORATORY = frozenset({"microscope", "microscopes", "petri", "pipette", "beaker", "lab", "laboratory", "specimen"})
_SETS = frozenset({"dozen", "couple", "pair", "trio", "hundred", "few"})
_HOLDING = frozenset({"holder", "holders", "dispenser", "caddy"})
"""Nouns of what is named for what it holds."""
_WITH = (["with"], ["holding"], ["for"], ["carrying"], ["containing"], ["holds"], ["of"])
_ONE = frozenset({"a", "an", "one", "the", "this", "that", "another", "my", "your", "our"})
_CAUSING = frozenset({"let", "make", "have", "see", "watch", "should", "must", "can", "will", "does", "lets", "makes"})
"""Verbs behind which that of one thing has no ending: "let a candle stand on a plate"."""
_LISTING = frozenset({"and", "or", ",", "plus"})
_UTENSILS = {"utensils", "cutlery", *lexicon.GENERICS["utensil"], *lexicon.GENERICS["cooking utensil"]}


def compounds(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "umbrella" and "stand" of "an umbrella stand" as one word, which the catalogue has or has not."""
    tokens = _numbered(_in_company(_one_name(_of_owners(tokens, nouns), nouns), nouns), nouns)
    made: list[Token] = []
    first = 0
    for at, token in enumerate(tokens):
        if _is_name(tokens, first, at, nouns):
            made[-1] = replace(made[-1], text=f"{made[-1].text} {token.text}", end=token.end)
        else:
            made.append(token)
        first = at + 1 if token.text == "." else first
    return _in_short(made, nouns)


def _in_short(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the stand" as "the nightstand" and "the lid" as "the box lid" behind the name of that.

    "On the lid" behind what is never without is "on the lid of the chest", and "on the lid of which" is "on which".
    """
    made: list[Token] = []
    whole: dict[str, list[str]] = {}
    words = [token.text for token in tokens]
    lidded = ""
    for at, token in enumerate(tokens):
        before = [each.text for each in made[-2:]]
        if token.text in whole and before[-1:] == ["the"] and words[at + 1 : at + 2] != ["of"]:
            made += [replace(token, text=word) for word in whole[token.text]]
            continue
        lidded = token.text if token.text in _LIDDED else lidded
        upon = token.text == "lid" and before == ["on", "the"] and not {"lid", "lids"} & {*words[:at]}
        if upon and words[at + 1 : at + 3] == ["of", "which"]:
            del made[-1]
            continue
        made.append(token)
        if upon and lidded and words[at + 1] != "of":
            made += [replace(token, text=word) for word in ("of", "the", lidded)]
        names = ([*before[len(before) + 1 - size :], token.text] for size in (3, 2, 1) if size <= len(before) + 1)
        if token.text.endswith("stand") and (name := next(filter(nouns.match, names), None)):
            whole |= {"stand": name} if name != ["stand"] else {}
        owner = before[-1:] if words[at + 1 : at + 2] != ["of"] else words[at + 3 : at + 4]
        if token.text == "lid" and nouns.match(owner) and not nouns.match([*owner, "lid"]):
            whole["lid"] = [*owner, "lid"]
    return made


def _of_owners(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "rubik's" and "cube" of "a rubik's cube" as one word, where the catalogue has that name."""
    made: list[Token] = []
    for token in tokens:
        if len(made) > 1 and made[-1].text == "'s" and not token.mark:
            name = f"{made[-2].text}'s {token.text}"
            if nouns.match([name]) is not None:
                made[-2:] = [replace(made[-2], text=name, end=token.end)]
                continue
        made.append(token)
    return made


def _one_name(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "bubble wrap" as one word, "the slides" beside a microscope as such, and "the lighter" of two."""
    made: list[Token] = []
    words = [token.text for token in tokens]
    for at, token in enumerate(tokens):
        joined = at > 0 and any((words[at - 1], one) in _OTHERWISE for one in (token.text, *singulars(token.text)))
        if joined and nouns.match(words[at - 1 : at + 1]) is None:
            made[-1] = replace(made[-1], text=f"{words[at - 1]} {token.text}", end=token.end)
            continue
        if token.text in ("piece", "pieces") and words[at + 1 : at + 3] == ["of", "wood"]:
            made.append(replace(token, text=token.text.replace("piece", "block")))
            continue
        before = nouns.match([made[-1].text]) if token.text == "area" and made else None
        if before is not None and nouns.of_class(before.noun, lexicon.LEVEL) and not before.plural:
            # "A desk area with a lamp"
            continue
        after = words[at + 1 : at + 3]
        weighed = token.text == "lighter" and words[at - 1] in ("the", "a")
        if weighed and ({"heavier", "heavy"} & {*words} or after[:1] in (["one"], ["of"]) or nouns.match(after[:1])):
            # "The lighter one", "the heavier below the lighter"
            made.append(replace(token, text="lightest"))
            continue
        slides = token.text == "slides" and _LABORATORY & {*words} and words[at - 1] not in ("microscope", "glass")
        made += [replace(token, text="microscope"), token] if slides else [token]
    return made


def _in_company(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two pens in a holder" and "a holder with pens" as a pen holder, where the catalogue has that."""
    made: list[Token] = []
    words = [token.text for token in tokens]
    for at, token in enumerate(tokens):
        alone = token.text in _HOLDING and at > 0 and nouns.match(words[at - 1 : at + 1]) is None
        stands = token.text == "stand" and at > 0 and words[at - 1] in _ONE
        alone = alone or (stands and nouns.match(["stand"]) is None)
        stop = next(n for n in range(at, len(words)) if words[n] == "." or (words[n] == "next" and n > at))
        company = [*words[at + 2 : stop], *words[:at]] if words[at + 1 : at + 2] in _WITH else words[:at]
        named_in = [word for word in company if alone and nouns.match([word])]
        held = [one for word in named_in for one in (word, *singulars(word))]
        named = [one for one in held if nouns.match([one, token.text.removesuffix("s")])]
        if alone and token.text == "holder" and not named and _UTENSILS & {*held, *company}:
            named = ["utensil"]
        if alone and named and nouns.match([token.text]) is None:
            made.append(replace(token, text=named[-1]))
        made.append(token)
    return made


def _numbered(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a three drawer dresser" as "a three-drawer dresser", which is one."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        if token.text == "," and made and made[-1].text.endswith(f"-{tokens[at - 1].text}"):
            continue
        one = at > 1 and tokens[at - 2].text in ("a", "an") and number_of(tokens[at - 1].text) > 1
        # "a two door, steel fridge"
        first = at + 1 + (token.text in lexicon.DETACHED and at + 2 < len(tokens) and tokens[at + 1].text == ",")
        end = next(
            (n for n in range(first, len(tokens)) if tokens[n].mark or tokens[n].text in JOINERS | {"of"}), first
        )
        behind = [each.text for each in tokens[first : min(end, first + 3)]]
        named = token.text.isalpha() and bool(behind) and not nouns.match([token.text, behind[0]])
        named = named and any(nouns.match(behind[start:end]) for start in range(3) for end in range(start + 1, 4))
        named = named and not {*behind} & (lexicon.STACK_NOUNS | lexicon.ROWS | lexicon.COLLECTIVES)
        plain = token.text not in lexicon.SIZES and not is_modifier(token.text) and not is_measure(token.text)
        bare = not singulars(token.text) and token.text not in ("of", "more", "other", "and", "to", "or")
        if one and named and plain and bare and not tokens[first].mark and tokens[at - 1].text not in _SETS:
            made[-1] = replace(made[-1], text=f"{made[-1].text}-{token.text}", end=token.end)
        else:
            made.append(token)
    return made


def _is_name(tokens: Sequence[Token], first: int, at: int, nouns: Nouns) -> bool:
    """Whether "stand" at token `at`, in the sentence from token `first`, ends the name of one thing."""
    words = [token.text for token in tokens]
    if words[at] not in _HEADS or at == first:
        return False
    one = nouns.match([words[at - 1]])
    if one is None or one.plural or nouns.match(words[at - 1 : at + 1]):
        return False
    start = at - 1
    while start > first and (is_modifier(words[start - 1]) or nouns.match([words[start - 1]])):
        start -= 1
    lead = start - 1 if start > first and words[start - 1] in _ONE else start
    before = words[lead - 1] if lead > first else ""
    if (lead == start and before not in ("", ",", ":")) or before in _CAUSING:
        # "The cup and plate stand on a tray"
        return False
    which = next((n for n in range(at, first, -1) if words[n] == "which"), 0)
    if which and before in _LISTING and link_at(tokens, which - 1) and not FINITE & {*words[which:at]}:
        # "a desk, on which a teapot and a candle stand"
        return False
    fronted = link_at(tokens, first) > 0
    link = LINKS.get((words[at + 1],))
    if tokens[at + 1].mark or words[at + 1] in ("and", "that", "which") or (link is not None and link.inverse):
        return not fronted or words[at + 1] != "." or bool(FINITE & {*words[first:at]})
    return link_at(tokens, at + 1) > 0 and not fronted and before not in _LISTING
