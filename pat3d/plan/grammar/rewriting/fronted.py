"""What stands before an instruction and says when it is done, or what is not to be done meanwhile.

"After putting the cup on the tray, pick up the spoon" becomes "put the cup on the tray and then pick up the spoon", and
of "without touching the vase, pick up the key" the vase is there, and a note names the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.unmade import base_verb

_FIRST = frozenset({"after", "once", "when"})
_WHEN = frozenset({"after", "before", "during", "at", "for", "by", "until", "in", "when", "every", "each"})
_TIMES = lexicon.MEALS | frozenset({
    "the", "a", "each", "every", "breakfast", "lunch", "dinner", "supper", "brunch", "class", "work", "school",
    "noon", "midnight", "night", "morning", "afternoon", "evening", "day", "today", "tonight", "weekend",
    "bedtime", "party", "meeting", "event", "guests", "arrive", "then", "end", "once", "you", "we", "are", "is",
    "done", "finished", "ready", "time", "my", "your", "our",
})  # fmt: skip
"""Words of "after dinner", "when you are done"."""
_YOU = (("you", "have"), ("you've",), ("you",))
_REFERRING = lexicon.PRONOUNS | {"one", "ones"}
_LEADS = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys()
_PARTICLES = frozenset({"over", "up", "down", "off", "on"})


def in_order(tokens: Sequence[Token], opens: Callable[[int], bool]) -> Sequence[Token]:
    """`tokens` of one sentence with "after doing this, do that" as "do this and then do that".

    Args:
        tokens: end in a stop.
        opens: whether an instruction begins at a token.
    """
    if (turned := _behind(tokens, opens)) is not None:
        return turned
    comma = _comma(tokens)
    if not comma or not (tokens[0].text in _FIRST or tokens[0].text == "before") or not opens(comma + 1):
        return tokens
    at = _deed_at(tokens)
    verb = base_verb(tokens[at].text)
    if verb is None or tokens[at + 1].text not in _LEADS:
        return tokens
    before = [replace(tokens[at], text=verb, start=tokens[0].start), *tokens[at + 1 : comma]]
    after, stop = list(tokens[comma + 1 : -1]), tokens[-1]
    then = [replace(tokens[0], text=word) for word in ("and", "then")]
    if tokens[0].text in _FIRST:
        return [*before, *then, *after, stop]
    # "Before you open the box, put it on the tray": the box was named first.
    told = {token.text for token in after} & _REFERRING
    return tokens if told else [*after, *then, *before, stop]


def _behind(tokens: Sequence[Token], opens: Callable[[int], bool]) -> list[Token] | None:
    """`tokens` with "close the box after putting the egg in it" as "put the egg in the box and then close the box".

    None where nothing is said so.
    """
    leads = {*_LEADS, "it", "them"}
    at = next((n for n in range(2, len(tokens) - 3) if tokens[n].text == "after"
               and tokens[n + 1].text.endswith("ing") and tokens[n + 2].text in leads), 0)  # fmt: skip
    verb = base_verb(tokens[at + 1].text) if at else None
    marked = any(token.mark for token in tokens[:-1])
    if verb is None or marked or not opens(0) or any(token.text in ("and", "then") for token in tokens):
        return None
    told, deed, stop = tokens[:at], [replace(tokens[at + 1], text=verb), *tokens[at + 2 : -1]], tokens[-1]
    then = [replace(tokens[at], text=word) for word in ("and", "then")]
    meant = [n for n, token in enumerate(deed) if token.text in _REFERRING]
    if meant and any(link_at(told, n) for n in range(1, len(told))):
        return None
    if deed[-1].text == "inside":
        deed += told[1:]
    for n in reversed(meant):
        deed[n : n + 1] = told[1:]
    # What is quoted of the second deed begins where it was told.
    then = [replace(word, start=told[0].start, end=told[0].start) for word in then]
    return [*deed, *then, *told, stop]


def forbidden(tokens: Sequence[Token], opens: Callable[[int], bool]) -> tuple[int, list[Token]]:
    """Where the comma behind "without touching the vase," stands, and the vase; 0 where no instruction begins so.

    "After dinner," names nothing.
    """
    comma = _comma(tokens)
    when = tokens[0].text in _WHEN and all(token.text in _TIMES for token in tokens[1:comma])
    if comma and when and opens(comma + 1):
        return comma, []
    deed = comma > 1 and tokens[0].text == "without" and tokens[1].text.endswith("ing") and base_verb(tokens[1].text)
    if not deed or not opens(comma + 1):
        return 0, []
    first = 2 + (tokens[2].text in _PARTICLES)
    named = list(tokens[first:comma])
    return comma, named if named and named[0].text in _LEADS else []


def _comma(tokens: Sequence[Token]) -> int:
    """The comma behind what stands before an instruction; 0 without."""
    return next((at for at in range(2, len(tokens) - 2) if tokens[at].text == ","), 0)


def _deed_at(tokens: Sequence[Token]) -> int:
    """The verb of "after putting the cup", "once you have put the cup"."""
    words = [token.text for token in tokens]
    you = next((len(said) for said in _YOU if tuple(words[1 : 1 + len(said)]) == said), 0)
    return 1 + you
